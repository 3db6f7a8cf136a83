#include "quantise.h"

#include "closed_mesh.h"
#include "memory.h"
#include "obj.h"
#include "text.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { WORLD_BITS = 24, LEAST_WORLD_BITS = 22, EYE_BITS = 27, HEIGHT_BITS = 26, DEPTH_BITS = 28 };

typedef struct source {
    const scene_file *scene;
    obj_mesh *meshes; /* one a mesh line, in world units after its transform */
    problem *why;
    int scale;
} source;

#define WRONG(s, line, ...) problem_at((s)->why, (s)->scene->path, line, __VA_ARGS__)

/* ---- meshes ---------------------------------------------------------------------------------------------------- */

/* Rows of: scale, then rotate about the axis by Rodrigues' formula. Exactly the scale where there is no rotation. */
static void transform_of(const scene_mesh *mesh, double m[3][3])
{
    gn_angle angle = (gn_angle)(int64_t)llround(mesh->degrees / 360 * 4294967296.0);
    double sine = ldexp(gn_sine(angle), -30), cosine = ldexp(gn_cosine(angle), -30);
    const double *axis = mesh->axis;
    double length = sqrt(axis[0] * axis[0] + axis[1] * axis[1] + axis[2] * axis[2]);
    double n[3] = {axis[0] / length, axis[1] / length, axis[2] / length};
    double cross[3][3] = {{0, -n[2], n[1]}, {n[2], 0, -n[0]}, {-n[1], n[0], 0}};
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++) {
            double rotation = (i == k ? cosine : 0) + sine * cross[i][k] + (1 - cosine) * n[i] * n[k];
            m[i][k] = (mesh->degrees == 0 ? i == k : rotation) * mesh->scale[k];
        }
}

/* Into world units; a mirrored mesh has its corners swapped so that it stays counter-clockwise from outside. */
static void transform(obj_mesh *obj, const scene_mesh *mesh)
{
    double m[3][3];
    transform_of(mesh, m);
    for (size_t v = 0; v < obj->position_count; v++) {
        double p[3] = {obj->positions[v][0], obj->positions[v][1], obj->positions[v][2]};
        for (int i = 0; i < 3; i++)
            obj->positions[v][i] = m[i][0] * p[0] + m[i][1] * p[1] + m[i][2] * p[2] + mesh->translate[i];
    }
    if (mesh->scale[0] * mesh->scale[1] * mesh->scale[2] > 0)
        return;
    for (size_t t = 0; t < obj->triangle_count; t++) {
        uint32_t second = obj->triangles[t][1];
        obj->triangles[t][1] = obj->triangles[t][2];
        obj->triangles[t][2] = second;
    }
}

static int check_closed(const source *s, const scene_mesh *mesh, const obj_mesh *obj, int verbose)
{
    closed_mesh_check check = check_closed_mesh(obj);
    if (!check.closed)
        return WRONG(
            s, mesh->line,
            "mesh %s is not closed: its edge from %g %g %g to %g %g %g is used %ld times that way and %ld times "
            "the other; expected equally often, or 'surface open'",
            mesh->path, check.from[0], check.from[1], check.from[2], check.to[0], check.to[1], check.to[2],
            check.forward, check.backward);
    if (verbose && check.non_manifold)
        fprintf(stderr, "%s:%ld: notice: mesh %s has %zu edges with more than two triangles\n", s->scene->path,
                mesh->line, mesh->path, check.non_manifold);
    if (verbose && check.volume < 0)
        fprintf(stderr, "%s:%ld: notice: mesh %s seems to be inside out (its signed volume is %g)\n", s->scene->path,
                mesh->line, mesh->path, check.volume);
    return 0;
}

static int read_meshes(source *s, int verbose)
{
    for (size_t i = 0; i < s->scene->mesh_count; i++) {
        const scene_mesh *mesh = &s->scene->meshes[i];
        FILE *probe = fopen(mesh->path, "rb");
        if (!probe)
            return WRONG(s, mesh->line,
                         "mesh %s cannot be opened; expected an OBJ file, its path relative to the scene file",
                         mesh->path);
        fclose(probe);
        if (obj_read(&s->meshes[i], mesh->path, s->why))
            return -1;
        if (mesh->closed && check_closed(s, mesh, &s->meshes[i], verbose))
            return -1;
        transform(&s->meshes[i], mesh);
    }
    return 0;
}

/* ---- the scale ------------------------------------------------------------------------------------------------- */

static double largest_of(const double *numbers, size_t count)
{
    double largest = 0;
    for (size_t i = 0; i < count; i++)
        largest = fmax(largest, fabs(numbers[i]));
    return largest;
}

/* The largest k with number x 2^k <= 2^bits, for number > 0. */
static int largest_scale(double number, int bits)
{
    int exponent;
    double fraction = frexp(number, &exponent); /* number = fraction x 2^exponent, fraction in [1/2, 1) */
    return bits - exponent + (fraction == 0.5);
}

/* Lower the scale so that a number of the line fits `bits`; refuse where the vertices would keep fewer than 22 bits. */
static int make_fit(source *s, long line, const char *what, double number, int bits, double largest_vertex)
{
    int least = largest_scale(largest_vertex, LEAST_WORLD_BITS);
    int scale = number > 0 ? largest_scale(number, bits) : s->scale;
    if (scale < least)
        return WRONG(s, line,
                     "%s %g is too large for a scene whose largest vertex coordinate is %g; expected at most %g", what,
                     number, largest_vertex, ldexp(1, bits - least));
    if (scale < s->scale)
        s->scale = scale;
    return 0;
}

static int choose_scale(source *s)
{
    const scene_camera *camera = &s->scene->camera;
    const scene_light *light = &s->scene->light;
    double largest = 0;
    for (size_t i = 0; i < s->scene->mesh_count; i++)
        largest = fmax(largest, largest_of((const double *)s->meshes[i].positions, 3 * s->meshes[i].position_count));
    if (largest < 1e-30 || largest > 1e30)
        return problem_in(s->why, s->scene->path, "the largest vertex coordinate is %g; expected 1e-30 to 1e30",
                          largest);
    s->scale = largest_scale(largest, WORLD_BITS);
    if (make_fit(s, camera->line, "the camera's eye coordinate", largest_of(camera->eye, 3), EYE_BITS, largest) ||
        make_fit(s, camera->line, "the camera's target coordinate", largest_of(camera->target, 3), EYE_BITS, largest))
        return -1;
    if (camera->orthographic &&
        make_fit(s, camera->line, "half the camera's height", camera->height / 2, HEIGHT_BITS, largest))
        return -1;
    if ((light->spot || light->point) &&
        make_fit(s, light->line, "the light's position coordinate", largest_of(light->position, 3), EYE_BITS, largest))
        return -1;
    if (light->spot &&
        make_fit(s, light->line, "the light's target coordinate", largest_of(light->target, 3), EYE_BITS, largest))
        return -1;
    return 0;
}

/* ---- rounding -------------------------------------------------------------------------------------------------- */

static int32_t rounded(const source *s, double number)
{
    return (int32_t)llround(ldexp(number, s->scale));
}

static void rounded_point(const source *s, int32_t out[3], const double point[3])
{
    for (int i = 0; i < 3; i++)
        out[i] = rounded(s, point[i]);
}

/* A direction of any length as integers of 27 bits. */
static void rounded_direction(int32_t out[3], const double direction[3])
{
    int scale = largest_scale(largest_of(direction, 3), EYE_BITS);
    for (int i = 0; i < 3; i++)
        out[i] = (int32_t)llround(ldexp(direction[i], scale));
}

static int32_t rounded_depth(const source *s, double depth)
{
    double limit = ldexp(1, DEPTH_BITS), scaled = ldexp(depth, s->scale);
    return (int32_t)llround(fmin(fmax(scaled, -limit), limit));
}

/* Near and far planes: clamped to the core's range, and never equal. */
static int rounded_planes(const source *s, long line, double near_depth, double far_depth, int32_t *near_out,
                          int32_t *far_out)
{
    *near_out = rounded_depth(s, near_depth);
    *far_out = rounded_depth(s, far_depth);
    if (near_depth > 0 && *near_out < 1)
        *near_out = 1;
    if (*near_out < *far_out)
        return 0;
    return WRONG(s, line, "near %g and far %g are the same after rounding to %g; expected more distance between them",
                 near_depth, far_depth, ldexp(1, -s->scale));
}

/* What the core asks of a perspective near plane: at least 64 view units (docs/number-formats.md), and far / near <=
 * 2^20. least_tangent: the smaller one of the two half openings. */
static int check_perspective(const source *s, long line, const int32_t eye[3], double least_tangent, int32_t near_depth,
                             int32_t far_depth)
{
    int32_t reach = 0;
    for (int i = 0; i < 3; i++)
        reach = abs(eye[i]) > reach ? abs(eye[i]) : reach;
    double unit = ldexp(fmin(1, least_tangent), 28 - (int)floor(log2((double)reach + GN_WORLD_MAX)));
    double least = fmax(64.5 / unit, far_depth / 1048576.0);
    if (near_depth >= least)
        return 0;
    return WRONG(s, line, "near %g is too small for a scene of this size and far %g; expected at least %g",
                 ldexp(near_depth, -s->scale), ldexp(far_depth, -s->scale), ldexp(ceil(least), -s->scale));
}

static double half_tangent(double fovy)
{
    return tan(fovy * (3.14159265358979323846 / 360));
}

static gn_angle rounded_angle(double degrees)
{
    return (gn_angle)llround(degrees / 360 * 4294967296.0);
}

static void pack_mesh(gn_mesh *out, const source *s, size_t index, double *largest_rounding)
{
    const obj_mesh *obj = &s->meshes[index];
    int32_t(*vertices)[3] = memory_take(obj->position_count, sizeof *vertices);
    int narrow = obj->position_count <= 65536;
    void *indices = memory_take(3 * obj->triangle_count, narrow ? 2 : 4);
    for (size_t v = 0; v < obj->position_count; v++)
        for (int i = 0; i < 3; i++) {
            vertices[v][i] = rounded(s, obj->positions[v][i]);
            *largest_rounding = fmax(*largest_rounding, fabs(ldexp(vertices[v][i], -s->scale) - obj->positions[v][i]));
        }
    for (size_t i = 0; i < 3 * obj->triangle_count; i++) {
        uint32_t vertex = obj->triangles[i / 3][i % 3];
        if (narrow)
            ((uint16_t *)indices)[i] = (uint16_t)vertex;
        else
            ((uint32_t *)indices)[i] = vertex;
    }
    *out = (gn_mesh){.vertices = (const int32_t(*)[3])vertices,
                     .indices = indices,
                     .vertex_count = (uint32_t)obj->position_count,
                     .triangle_count = (uint32_t)obj->triangle_count,
                     .index_size = narrow ? 2 : 4,
                     .closed = (uint8_t)s->scene->meshes[index].closed};
}

static uint8_t rounded_colour(double c)
{
    return (uint8_t)floor(c * 255 + 0.5);
}

static void pack_objects(packed_scene *packed, const source *s)
{
    size_t count = s->scene->mesh_count;
    packed->meshes = memory_take(count, sizeof *packed->meshes);
    packed->objects = memory_take(count, sizeof *packed->objects);
    packed->mesh_count = (uint32_t)count;
    for (size_t i = 0; i < count; i++) {
        const double *color = s->scene->meshes[i].color;
        pack_mesh(&packed->meshes[i], s, i, &packed->largest_rounding);
        packed->objects[i].mesh = &packed->meshes[i];
        packed->objects[i].colour =
            (gn_rgb){rounded_colour(color[0]), rounded_colour(color[1]), rounded_colour(color[2])};
    }
    packed->scene.objects = packed->objects;
    packed->scene.object_count = (uint32_t)count;
    packed->scene.ambient = (uint16_t)floor(s->scene->ambient * 65535 + 0.5);
}

static int pack_camera(packed_scene *packed, const source *s)
{
    const scene_camera *camera = &s->scene->camera;
    int32_t eye[3], target[3], up[3], near_depth, far_depth;
    rounded_point(s, eye, camera->eye);
    rounded_point(s, target, camera->target);
    rounded_direction(up, camera->up);
    if (rounded_planes(s, camera->line, camera->near_depth, camera->far_depth, &near_depth, &far_depth))
        return -1;
    double tangent = half_tangent(camera->fovy), aspect = (double)s->scene->width / s->scene->height;
    if (!camera->orthographic &&
        check_perspective(s, camera->line, eye, tangent * fmin(1, aspect), near_depth, far_depth))
        return -1;
    gn_status status = gn_look_at(&packed->camera, eye, target, up);
    if (status != GN_OK)
        return WRONG(
            s, camera->line,
            "the camera's eye and target are too close, or up is parallel to the view; expected two points more "
            "than %g apart",
            ldexp(1, -s->scale));
    int32_t half_height = rounded(s, camera->height / 2);
    status = camera->orthographic
                 ? gn_orthographic(&packed->camera, half_height > 0 ? half_height : 1, near_depth, far_depth)
                 : gn_perspective(&packed->camera, rounded_angle(camera->fovy), near_depth, far_depth);
    if (status != GN_OK)
        return WRONG(s, camera->line,
                     "the core refuses the camera (status %d); expected other near, far, fovy or height", (int)status);
    return 0;
}

/* Six frustums of 90 degrees: what the core will ask of each. */
static int pack_point_light(packed_scene *packed, const source *s)
{
    const scene_light *light = &s->scene->light;
    int32_t position[3], near_depth, far_depth;
    rounded_point(s, position, light->position);
    if (rounded_planes(s, light->line, light->near_depth, light->far_depth, &near_depth, &far_depth) ||
        check_perspective(s, light->line, position, 1, near_depth, far_depth))
        return -1;
    packed->settings.faces = &gn_six_faces;
    return gn_point_light(&packed->light, position, near_depth, far_depth) == GN_OK
               ? 0
               : WRONG(s, light->line, "the core refuses the light; expected another place or range");
}

static int pack_light(packed_scene *packed, const source *s)
{
    const scene_light *light = &s->scene->light;
    int32_t up[3], direction[3], position[3], target[3], near_depth, far_depth;
    gn_status status;
    if (light->point)
        return pack_point_light(packed, s);
    if (light->has_up)
        rounded_direction(up, light->up);
    if (light->spot) {
        rounded_point(s, position, light->position);
        rounded_point(s, target, light->target);
        if (rounded_planes(s, light->line, light->near_depth, light->far_depth, &near_depth, &far_depth))
            return -1;
        if (check_perspective(s, light->line, position, half_tangent(light->fovy), near_depth, far_depth))
            return -1;
        status = gn_spot_light(&packed->light, position, target, light->has_up ? up : 0, rounded_angle(light->fovy),
                               near_depth, far_depth);
    } else {
        rounded_direction(direction, light->direction);
        status = gn_directional_light(&packed->light, direction, light->has_up ? up : 0);
        if (status == GN_OK)
            status = gn_fit_light(&packed->light, &packed->scene);
    }
    if (status != GN_OK)
        return WRONG(s, light->line,
                     "the core refuses the light (status %d); expected another place, direction or range", (int)status);
    return 0;
}

int quantise(packed_scene *packed, const scene_file *scene, int verbose, problem *why)
{
    source s = {.scene = scene, .why = why};
    memset(packed, 0, sizeof *packed);
    s.meshes = memory_take(scene->mesh_count, sizeof *s.meshes);
    int result = read_meshes(&s, verbose) || choose_scale(&s) ? -1 : 0;
    if (!result) {
        packed->scale = s.scale;
        pack_objects(packed, &s);
        packed->settings =
            gn_default_settings((uint16_t)scene->width, (uint16_t)scene->height, (uint16_t)scene->map_width);
        packed->settings.map_height = (uint16_t)scene->map_height;
        result = pack_camera(packed, &s) || pack_light(packed, &s) ? -1 : 0;
    }
    for (size_t i = 0; i < scene->mesh_count; i++)
        obj_free(&s.meshes[i]);
    free(s.meshes);
    return result;
}

int quantise_bias(gn_bias *bias, const char *string, int scale, problem *why)
{
    size_t length = strlen(string);
    char unit = length ? string[length - 1] : 0;
    word number = {string, length - (unit == 't' || unit == 'r')};
    double value, most, largest = 4294967295.0;
    if (!length || word_number(number, &value) || value < 0)
        return problem_of_usage(
            why,
            "bias '%s'; expected a number of 0 or more, alone (world units) or followed by t (texels) "
            "or r (units of the light's depth range)",
            string);
    if (unit == 't') {
        bias->unit = GN_BIAS_TEXELS;
        value = ldexp(value, 16);
        most = 65536;
    } else if (unit == 'r') {
        bias->unit = GN_BIAS_RANGE;
        value = ldexp(value, 32);
        most = 1;
    } else {
        bias->unit = GN_BIAS_WORLD;
        value = ldexp(value, scale);
        most = ldexp(1, DEPTH_BITS - scale);
        largest = ldexp(1, DEPTH_BITS);
    }
    if (value > largest)
        return problem_of_usage(why, "bias '%s' is too large; expected less than %g%.1s", string, most,
                                unit == 't' || unit == 'r' ? &unit : "");
    bias->value = (uint32_t)floor(value + 0.5);
    return 0;
}
