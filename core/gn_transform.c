/* From meshes to vertices on a view: model matrix, view, projection; and the fit of a directional light. */
#include "gn_context.h"

gn_status gn_world_position(const gn_object *object, uint32_t vertex, int32_t world[3])
{
    const int32_t *v = object->mesh->vertices[vertex];
    const gn_model *model = object->model;
    if (!model) {
        for (int i = 0; i < 3; i++)
            world[i] = v[i];
        return GN_OK;
    }
    gn_status status = GN_OK;
    int64_t half = model->shift ? (int64_t)1 << (model->shift - 1) : 0;
    for (int i = 0; i < 3; i++) {
        int64_t sum = gn_multiply(model->m[i][0], v[0]) + gn_multiply(model->m[i][1], v[1]) +
                      gn_multiply(model->m[i][2], v[2]) + half;
        sum = gn_floor_shift_64(sum, model->shift) + model->t[i];
        if (sum < -GN_WORLD_MAX || sum > GN_WORLD_MAX) {
            status = GN_OUT_OF_RANGE;
            sum = 0;
        }
        world[i] = (int32_t)sum;
    }
    return status;
}

int gn_dot_sign(const int64_t n[3], const int32_t v[3])
{
    int64_t high = 0, low = 0;
    for (int i = 0; i < 3; i++) {
        high += gn_multiply((int32_t)gn_floor_shift_64(n[i], 31), v[i]);
        low += gn_multiply((int32_t)(n[i] & 0x7fffffff), v[i]);
    }
    high += gn_floor_shift_64(low, 31);
    return high < 0 ? -1 : high > 0 || (low & 0x7fffffff) ? 1 : 0;
}

void gn_cross(int64_t n[3], const int32_t a[3], const int32_t b[3])
{
    n[0] = gn_multiply(a[1], b[2]) - gn_multiply(a[2], b[1]);
    n[1] = gn_multiply(a[2], b[0]) - gn_multiply(a[0], b[2]);
    n[2] = gn_multiply(a[0], b[1]) - gn_multiply(a[1], b[0]);
}

gn_status gn_triangle_world(const gn_object *object, uint32_t triangle, int32_t world[3][3])
{
    gn_status status = GN_OK;
    uint32_t index[3];
    gn_triangle_indices(object->mesh, triangle, index);
    for (int i = 0; i < 3; i++)
        if (gn_world_position(object, index[i], world[i]) != GN_OK)
            status = GN_OUT_OF_RANGE;
    return status;
}

void gn_normal(int64_t n[3], int32_t world[3][3])
{
    int32_t edge[2][3];
    for (int i = 0; i < 3; i++) {
        edge[0][i] = world[1][i] - world[0][i];
        edge[1][i] = world[2][i] - world[0][i];
    }
    gn_cross(n, edge[0], edge[1]);
}

void gn_to_light(int32_t to_light[3], const gn_light *light, const int32_t point[3])
{
    for (int i = 0; i < 3; i++)
        to_light[i] = light->kind == GN_SPOT ? light->position[i] - point[i] : -light->forward[i];
}

int gn_seen_lit(const gn_context *context, const int64_t n[3], const int32_t point[3])
{
    const gn_camera *camera = &context->camera;
    int32_t to_light[3], to_camera[3];
    gn_to_light(to_light, &context->light, point);
    for (int i = 0; i < 3; i++)
        to_camera[i] = camera->projection == GN_PERSPECTIVE ? camera->eye[i] - point[i] : -camera->forward[i];
    int side = gn_dot_sign(n, to_light);
    return side && side == gn_dot_sign(n, to_camera);
}

gn_status gn_check_model(const gn_model *model)
{
    if (model->shift > 62)
        return GN_OUT_OF_RANGE;
    for (int i = 0; i < 3; i++) {
        if (model->t[i] < -(1 << 30) || model->t[i] > (1 << 30))
            return GN_OUT_OF_RANGE;
        for (int j = 0; j < 3; j++)
            if (model->m[i][j] < -(1 << 30) || model->m[i][j] > (1 << 30))
                return GN_OUT_OF_RANGE;
    }
    return GN_OK;
}

/* Does the model turn front into back? The sign of its determinant, exactly. */
static int mirrors(const gn_model *model)
{
    int64_t n[3];
    gn_cross(n, model->m[0], model->m[1]);
    return gn_dot_sign(n, model->m[2]) < 0;
}

gn_status gn_transform_scene(gn_context *context, const gn_view *view, int32_t *largest_w, int *inside)
{
    int32_t right = 2 * view->half_width, bottom = 2 * view->half_height;
    uint32_t spare_width = right > 2 * GN_SPARE ? (uint32_t)(right - 2 * GN_SPARE) : 0;
    uint32_t spare_height = bottom > 2 * GN_SPARE ? (uint32_t)(bottom - 2 * GN_SPARE) : 0;
    *largest_w = 0;
    *inside = GN_WELL_INSIDE;
    for (uint32_t i = 0; i < context->scene->object_count; i++) {
        const gn_object *object = &context->scene->objects[i];
        gn_object_state *state = &context->objects[i];
        gn_vertex *vertex = context->vertices + state->first_vertex;
        state->mirrored = 0;
        state->clips = 0;
        if (object->model) {
            if (gn_check_model(object->model) != GN_OK)
                return GN_OUT_OF_RANGE;
            state->mirrored = (uint8_t)mirrors(object->model);
            *inside = GN_NOT_INSIDE;
        }
        for (uint32_t v = 0; v < object->mesh->vertex_count; v++, vertex++) {
            int32_t world[3];
            gn_place place;
            gn_status status = gn_world_position(object, v, world);
            if (status == GN_OK)
                status = gn_view_place(view, world, &place);
            if (status != GN_OK)
                return status;
            gn_view_project(view, &place, vertex);
            if (!view->affine && place.c[2] > *largest_w)
                *largest_w = (int32_t)place.c[2];
            if (vertex->depth == 0)
                state->clips = 1;
            if (GN_LIKELY((uint32_t)(vertex->x - GN_SPARE) < spare_width &&
                          (uint32_t)(vertex->y - GN_SPARE) < spare_height && vertex->depth >= GN_SPARE_DEPTH))
                continue;
            int in = vertex->depth && vertex->x >= 0 && vertex->y >= 0 && vertex->x < right && vertex->y < bottom;
            *inside = in && *inside ? GN_INSIDE : GN_NOT_INSIDE;
        }
    }
    return GN_OK;
}

void gn_triangle_places(const gn_view *view, const gn_object *object, uint32_t triangle, gn_place corner[3])
{
    int32_t world[3][3];
    (void)gn_triangle_world(object, triangle, world);
    for (int i = 0; i < 3; i++)
        (void)gn_view_place(view, world[i], &corner[i]);
}

static int in_world(const int32_t p[3])
{
    for (int i = 0; i < 3; i++)
        if (p[i] < -GN_WORLD_MAX || p[i] > GN_WORLD_MAX)
            return 0;
    return 1;
}

gn_status gn_fit_light(gn_light *light, const gn_scene *scene)
{
    if (!light || !scene || (scene->object_count && !scene->objects))
        return GN_BAD_ARGUMENT;
    const gn_q2_30 *axis[3] = {light->right, light->up, light->forward};
    int64_t low[3] = {INT64_MAX, INT64_MAX, INT64_MAX}, high[3] = {INT64_MIN, INT64_MIN, INT64_MIN};
    for (uint32_t i = 0; i < scene->object_count; i++) {
        const gn_object *object = &scene->objects[i];
        if (!object->mesh || (object->mesh->vertex_count && !object->mesh->vertices))
            return GN_BAD_ARGUMENT;
        if (object->model && gn_check_model(object->model) != GN_OK)
            return GN_OUT_OF_RANGE;
        for (uint32_t v = 0; v < object->mesh->vertex_count; v++) {
            int32_t world[3];
            if (gn_world_position(object, v, world) != GN_OK || !in_world(world))
                return GN_OUT_OF_RANGE;
            for (int a = 0; a < 3; a++) {
                int64_t d = gn_multiply(axis[a][0], world[0]) + gn_multiply(axis[a][1], world[1]) +
                            gn_multiply(axis[a][2], world[2]);
                low[a] = d < low[a] ? d : low[a];
                high[a] = d > high[a] ? d : high[a];
            }
        }
    }
    int32_t centre2[3], size[3]; /* twice the centre, and 1.02 x the extent, world units */
    for (int a = 0; a < 3; a++) {
        if (low[a] > high[a]) { /* no vertices: any box, the world's serves every camera */
            low[a] = -(int64_t)GN_WORLD_MAX * (1 << 30);
            high[a] = (int64_t)GN_WORLD_MAX * (1 << 30);
        }
        int64_t extent = gn_floor_shift_64(high[a] - low[a], 30) + 1;
        centre2[a] = (int32_t)gn_floor_shift_64(low[a] + high[a], 30);
        size[a] = (int32_t)((extent * 102 + 50) / 100);
        size[a] = size[a] < 64 ? 64 : size[a];
    }
    int32_t square = size[0] > size[1] ? size[0] : size[1];
    /* a scene that the light sees flat: deep enough that the eye's depth still fits the formats */
    size[2] = size[2] < square >> 8 ? square >> 8 : size[2];
    light->box_width = light->box_height = square;
    light->box_depth = size[2];
    light->box_u = gn_floor_shift(centre2[0] - square, 1);
    light->box_v = gn_floor_shift(centre2[1] - square, 1);
    light->box_z = gn_floor_shift(centre2[2] - size[2], 1);
    return GN_OK;
}
