/* From packed integers to the triangles, camera and light that lines are cast through. World vertices are made here
 * anew, by the formula in gnomon.h, with none of the core's functions. */
#include "truth_trace.h"

#include "memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- ranges: the bounds of truth_line.c rest on them ----------------------------------------------------------- */

static int within(const int32_t *numbers, int count, int32_t limit)
{
    for (int i = 0; i < count; i++)
        if (numbers[i] < -limit || numbers[i] > limit)
            return 0;
    return 1;
}

static int are_axes(const gn_q2_30 right[3], const gn_q2_30 up[3], const gn_q2_30 forward[3])
{
    int32_t limit = (1 << 30) + 16;
    return within(right, 3, limit) && within(up, 3, limit) && within(forward, 3, limit);
}

static int are_depths(int32_t near_depth, int32_t far_depth, int perspective)
{
    int32_t limit = 1 << 28;
    return near_depth >= (perspective ? 1 : -limit) && near_depth < far_depth && far_depth <= limit;
}

static int is_tangent(gn_q8_24 tangent)
{
    return tangent >= 1 && tangent <= 64 << 24;
}

static int check_camera(const gn_camera *c, problem *why)
{
    int perspective = c->projection == GN_PERSPECTIVE;
    if (within(c->eye, 3, GN_EYE_MAX) && are_axes(c->right, c->up, c->forward) &&
        are_depths(c->near_depth, c->far_depth, perspective) &&
        (perspective ? is_tangent(c->tan_half) : c->half_height >= 1 && c->half_height <= 1 << 26))
        return 0;
    return problem_of_usage(why, "the camera is out of range; expected what gn_camera in gnomon.h allows");
}

static int check_light(const truth_view *view, problem *why)
{
    const gn_light *l = &view->light;
    int has_axes = view->light_kind != TRUTH_POINT, has_place = view->light_kind != TRUTH_DIRECTIONAL;
    if ((!has_axes || are_axes(l->right, l->up, l->forward)) &&
        (!has_place || (within(l->position, 3, GN_EYE_MAX) && are_depths(l->near_depth, l->far_depth, 1))) &&
        (view->light_kind != TRUTH_SPOT || is_tangent(l->tan_half)))
        return 0;
    return problem_of_usage(why, "the light is out of range; expected what gn_light in gnomon.h allows");
}

/* ---- vertices -------------------------------------------------------------------------------------------------- */

static int64_t floor_shift(int64_t number, int shift)
{
    int64_t below = number < 0;
    return ((number ^ -below) >> shift) ^ -below;
}

/* floor((m v + 2^(shift-1)) / 2^shift) + t; 0 if the place is out of range. */
static int place_vertex(int32_t out[3], const int32_t v[3], const gn_model *model)
{
    for (int i = 0; i < 3; i++) {
        int64_t sum = model && model->shift ? (int64_t)1 << (model->shift - 1) : 0;
        if (!model) {
            out[i] = v[i];
            continue;
        }
        for (int k = 0; k < 3; k++)
            sum += (int64_t)model->m[i][k] * v[k];
        sum = floor_shift(sum, model->shift) + model->t[i];
        if (sum < -GN_WORLD_MAX || sum > GN_WORLD_MAX)
            return 0;
        out[i] = (int32_t)sum;
    }
    return within(out, 3, GN_WORLD_MAX);
}

static int check_model(const gn_model *m)
{
    return !m || (within(&m->m[0][0], 9, 1 << 30) && within(m->t, 3, 1 << 30) && m->shift <= 62);
}

static int place_vertices(int32_t (*out)[3], const gn_object *object, uint32_t number, problem *why)
{
    const gn_mesh *mesh = object->mesh;
    int good = check_model(object->model);
    for (uint32_t v = 0; good && v < mesh->vertex_count; v++)
        good = within(mesh->vertices[v], 3, GN_WORLD_MAX) && place_vertex(out[v], mesh->vertices[v], object->model);
    if (good)
        return 0;
    return problem_of_usage(why, "object %u has a vertex beyond 2^24, or a model out of range; expected less", number);
}

/* ---- triangles ------------------------------------------------------------------------------------------------- */

static uint32_t index_of(const gn_mesh *mesh, size_t i)
{
    return mesh->index_size == 2 ? ((const uint16_t *)mesh->indices)[i] : ((const uint32_t *)mesh->indices)[i];
}

static void measure(truth_triangle *triangle, double *reach)
{
    int32_t extent = 0;
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++) {
            int32_t edge = abs(triangle->corner[(i + 1) % 3][k] - triangle->corner[i][k]);
            extent = edge > extent ? edge : extent;
            *reach = fmax(*reach, abs(triangle->corner[i][k]));
        }
    triangle->extent = (float)extent * 1.000001f;
}

static int has_area(const truth_triangle *triangle)
{
    int64_t normal[3];
    truth_normal(triangle, normal);
    return normal[0] || normal[1] || normal[2];
}

/* Append an object's triangles; *number counts all of them, those without area too. */
static int add_object(truth_scene *scene, uint32_t *count, uint32_t *number, const gn_object *object,
                      const int32_t (*vertices)[3], problem *why)
{
    const gn_mesh *mesh = object->mesh;
    for (uint32_t t = 0; t < mesh->triangle_count; t++, ++*number) {
        truth_triangle *triangle = &scene->triangles[*count];
        for (size_t c = 0; c < 3; c++) {
            uint32_t v = index_of(mesh, 3 * (size_t)t + c);
            if (v >= mesh->vertex_count)
                return problem_of_usage(why, "triangle %u has an index beyond its mesh; expected less than %u", *number,
                                        mesh->vertex_count);
            memcpy(triangle->corner[c], vertices[v], sizeof triangle->corner[c]);
        }
        triangle->number = *number;
        measure(triangle, &scene->view.reach);
        *count += (uint32_t)has_area(triangle);
    }
    return 0;
}

static int add_objects(truth_scene *scene, uint32_t *count, const packed_scene *packed, problem *why)
{
    uint32_t number = 0;
    int result = 0;
    for (uint32_t i = 0; !result && i < packed->scene.object_count; i++) {
        const gn_object *object = &packed->scene.objects[i];
        int32_t(*vertices)[3] = memory_take(object->mesh->vertex_count, sizeof *vertices);
        result = place_vertices(vertices, object, i, why) ||
                         add_object(scene, count, &number, object, (const int32_t(*)[3])vertices, why)
                     ? -1
                     : 0;
        free(vertices);
    }
    return result;
}

/* ---- the light's frustum --------------------------------------------------------------------------------------- */

/* near <= w <= far; |right . v|, |up . v| <= tangent w: tangent forward +- right 2^24 is a normal that points inwards.
 */
static void make_spot_planes(truth_scene *scene)
{
    const gn_light *l = &scene->view.light;
    const gn_q2_30 *across[2] = {l->right, l->up};
    scene->plane_count = 6;
    for (int k = 0; k < 3; k++) {
        scene->planes[0].normal[k] = l->forward[k];
        scene->planes[1].normal[k] = -(int64_t)l->forward[k];
        for (int i = 0; i < 4; i++)
            scene->planes[2 + i].normal[k] =
                (int64_t)l->tan_half * l->forward[k] + (int64_t)(i % 2 ? -(1 << 24) : 1 << 24) * across[i / 2][k];
    }
    scene->planes[0].offset = (int64_t)l->near_depth * (1 << 30);
    scene->planes[1].offset = (int64_t)l->far_depth * -(1 << 30);
}

int truth_scene_open(truth_scene *scene, const packed_scene *packed, uint32_t width, uint32_t height, problem *why)
{
    uint32_t count = 0;
    uint64_t triangles = packed_triangle_count(packed);
    memset(scene, 0, sizeof *scene);
    truth_view *view = &scene->view;
    view->camera = packed->camera;
    view->light = packed->light;
    view->light_kind = packed->light.kind == GN_POINT  ? TRUTH_POINT
                       : packed->light.kind == GN_SPOT ? TRUTH_SPOT
                                                       : TRUTH_DIRECTIONAL;
    view->width = (int32_t)width;
    view->height = (int32_t)height;
    view->reach = 1;
    if (width < 1 || width > GN_MAX_SIZE || height < 1 || height > GN_MAX_SIZE)
        return problem_of_usage(why, "an image of %u x %u; expected 1 to %d each side", width, height, GN_MAX_SIZE);
    if (triangles >= UINT32_MAX / 4)
        return problem_of_usage(why, "too many triangles; expected less than 2^30");
    if (check_camera(&view->camera, why) || check_light(view, why))
        return -1;
    if (view->light_kind == TRUTH_SPOT)
        make_spot_planes(scene);
    scene->triangles = memory_take(triangles + 1, sizeof *scene->triangles);
    if (add_objects(scene, &count, packed, why))
        return -1;
    bvh_build(&scene->tree, scene->triangles, count);
    return 0;
}

void truth_scene_close(truth_scene *scene)
{
    bvh_free(&scene->tree);
    free(scene->triangles);
    memset(scene, 0, sizeof *scene);
}
