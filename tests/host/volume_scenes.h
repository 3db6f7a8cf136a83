/* Random scenes for tests of shadow volumes: each from a seed alone, with what makes counting hard.
 *
 * Closed boxes, tetrahedra and tori, open triangles and sheets, fans of several triangles at one edge, solids turned
 * inside out, mirrored models, triangles without area, all of them placed so that they run through each other; upright
 * on a coarse grid (where ties are common) or turned anyhow; worlds from hundreds of units to millions. Cameras and
 * spot lights stand anywhere, also inside solids, with near planes that cut what is there; casters lie behind the
 * camera and beyond its far plane. */
#ifndef VOLUME_SCENES_H
#define VOLUME_SCENES_H

#include "adjacency.h"
#include "core/tap.h"
#include "packed.h"

#include <string.h>

enum {
    VOLUME_MOST_MESHES = 6,
    VOLUME_MOST_VERTICES = 400,
    VOLUME_MOST_TRIANGLES = 400,
    VOLUME_MOST_SIZE = 64 /* of the image, each side */
};

typedef struct volume_mesh {
    int32_t vertices[VOLUME_MOST_VERTICES][3];
    uint32_t indices[VOLUME_MOST_TRIANGLES][3];
    uint16_t short_indices[VOLUME_MOST_TRIANGLES][3];
    gn_mesh mesh;
    gn_model model;
} volume_mesh;

typedef struct volume_scene {
    uint64_t random;
    int32_t size; /* of the world: things lie within about +-size */
    int32_t grid; /* not 0: all coordinates are multiples of it */
    int inside;   /* the camera stands where a solid is */
    volume_mesh meshes[VOLUME_MOST_MESHES];
    gn_object objects[VOLUME_MOST_MESHES];
    packed_scene packed;
} volume_scene;

/* least to most, both included. One number a statement or declarator: the order of arguments is open, and a seed makes
 * the same scene with every compiler. */
static int32_t volume_between(volume_scene *s, int64_t least, int64_t most)
{
    return (int32_t)(least + (int64_t)(tap_random(&s->random) % ((uint64_t)(most - least) + 1)));
}

/* One in n. */
static int volume_one_in(volume_scene *s, int32_t n)
{
    return volume_between(s, 1, n) == 1;
}

static int32_t volume_on_grid(const volume_scene *s, int32_t v)
{
    return s->grid ? v / s->grid * s->grid : v;
}

/* ---- shapes ---------------------------------------------------------------------------------------------------- */

static uint32_t volume_vertex(volume_mesh *m, int32_t x, int32_t y, int32_t z)
{
    int32_t *v = m->vertices[m->mesh.vertex_count];
    v[0] = x, v[1] = y, v[2] = z;
    return m->mesh.vertex_count++;
}

static void volume_triangle(volume_mesh *m, uint32_t a, uint32_t b, uint32_t c)
{
    uint32_t *t = m->indices[m->mesh.triangle_count++];
    t[0] = a, t[1] = b, t[2] = c;
}

static void volume_place(volume_scene *s, int32_t place[3], int32_t reach)
{
    for (int i = 0; i < 3; i++)
        place[i] = volume_on_grid(s, volume_between(s, -reach, reach));
}

static uint32_t volume_random_vertex(volume_scene *s, volume_mesh *m, const int32_t about[3], int32_t reach)
{
    int32_t p[3];
    for (int i = 0; i < 3; i++)
        p[i] = volume_on_grid(s, about[i] + volume_between(s, -reach, reach));
    return volume_vertex(m, p[0], p[1], p[2]);
}

static void volume_add_box(volume_scene *s, volume_mesh *m, const int32_t middle[3], int32_t reach)
{
    static const uint8_t face[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                                       {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
    uint32_t first = m->mesh.vertex_count;
    int32_t half[3];
    for (int i = 0; i < 3; i++) {
        half[i] = volume_on_grid(s, volume_between(s, reach / 4, reach));
        half[i] += half[i] ? 0 : s->grid + 1;
    }
    for (int i = 0; i < 8; i++)
        volume_vertex(m, middle[0] + (i & 1 ? half[0] : -half[0]), middle[1] + (i & 2 ? half[1] : -half[1]),
                      middle[2] + (i & 4 ? half[2] : -half[2]));
    for (int i = 0; i < 6; i++) {
        volume_triangle(m, first + face[i][0], first + face[i][1], first + face[i][2]);
        volume_triangle(m, first + face[i][0], first + face[i][2], first + face[i][3]);
    }
}

/* Inside out as often as not. */
static void volume_add_tetrahedron(volume_scene *s, volume_mesh *m, const int32_t middle[3], int32_t reach)
{
    uint32_t first = m->mesh.vertex_count;
    for (int i = 0; i < 4; i++)
        volume_random_vertex(s, m, middle, reach);
    volume_triangle(m, first, first + 1, first + 2);
    volume_triangle(m, first, first + 2, first + 3);
    volume_triangle(m, first, first + 3, first + 1);
    volume_triangle(m, first + 1, first + 3, first + 2);
}

static void volume_add_torus(volume_scene *s, volume_mesh *m, const int32_t middle[3], int32_t reach)
{
    uint32_t first = m->mesh.vertex_count, round = (uint32_t)volume_between(s, 3, 7), along = 3;
    int axis = volume_between(s, 0, 2);
    for (uint32_t i = 0; i < round; i++)
        for (uint32_t k = 0; k < along; k++) {
            gn_angle turn = (gn_angle)(((uint64_t)i << 32) / round), tilt = (gn_angle)(((uint64_t)k << 32) / along);
            int64_t radius = (int64_t)reach / 3 * 2 + (((int64_t)reach / 3 * gn_cosine(tilt)) >> 30), p[3];
            p[axis] = ((int64_t)reach / 3 * gn_sine(tilt)) >> 30;
            p[(axis + 1) % 3] = (radius * gn_cosine(turn)) >> 30;
            p[(axis + 2) % 3] = (radius * gn_sine(turn)) >> 30;
            volume_vertex(m, middle[0] + (int32_t)p[0], middle[1] + (int32_t)p[1], middle[2] + (int32_t)p[2]);
        }
    for (uint32_t i = 0; i < round; i++)
        for (uint32_t k = 0; k < along; k++) {
            uint32_t a = first + i * along + k, b = first + (i + 1) % round * along + k;
            uint32_t c = first + (i + 1) % round * along + (k + 1) % along, d = first + i * along + (k + 1) % along;
            volume_triangle(m, a, b, c);
            volume_triangle(m, a, c, d);
        }
}

/* Several triangles at one edge, of either winding. */
static void volume_add_fan(volume_scene *s, volume_mesh *m, const int32_t middle[3], int32_t reach)
{
    uint32_t a = volume_random_vertex(s, m, middle, reach), b = volume_random_vertex(s, m, middle, reach);
    for (int32_t i = volume_between(s, 1, 5); i > 0; i--) {
        uint32_t c = volume_random_vertex(s, m, middle, reach);
        if (volume_one_in(s, 2))
            volume_triangle(m, a, b, c);
        else
            volume_triangle(m, b, a, c);
    }
}

/* A sheet of 2 x 2 bent quads, open. */
static void volume_add_sheet(volume_scene *s, volume_mesh *m, const int32_t middle[3], int32_t reach)
{
    uint32_t first = m->mesh.vertex_count;
    int axis = volume_between(s, 0, 2), flat = volume_one_in(s, 2);
    for (uint32_t i = 0; i < 9; i++) {
        int32_t p[3];
        p[axis] = middle[axis] + (flat ? 0 : volume_on_grid(s, volume_between(s, -reach / 4, reach / 4)));
        p[(axis + 1) % 3] = middle[(axis + 1) % 3] + ((int32_t)(i % 3) - 1) * volume_on_grid(s, reach);
        p[(axis + 2) % 3] = middle[(axis + 2) % 3] + ((int32_t)(i / 3) - 1) * volume_on_grid(s, reach);
        volume_vertex(m, p[0], p[1], p[2]);
    }
    for (uint32_t i = 0; i < 4; i++) {
        uint32_t a = first + i % 2 + 3 * (i / 2);
        volume_triangle(m, a, a + 1, a + 4);
        volume_triangle(m, a, a + 4, a + 3);
    }
}

/* No area: two corners in one place, or three in one line. */
static void volume_add_nothing(volume_scene *s, volume_mesh *m, const int32_t middle[3], int32_t reach)
{
    uint32_t a = volume_random_vertex(s, m, middle, reach), b = volume_random_vertex(s, m, middle, reach);
    const int32_t *p = m->vertices[a], *q = m->vertices[b];
    uint32_t c = volume_vertex(m, 2 * q[0] - p[0], 2 * q[1] - p[1], 2 * q[2] - p[2]);
    volume_triangle(m, a, b, volume_one_in(s, 2) ? b : c);
}

static void volume_add_shape(volume_scene *s, volume_mesh *m, const int32_t middle[3], int32_t reach)
{
    switch (volume_between(s, 0, 9)) {
    case 0:
    case 1:
    case 2:
        volume_add_box(s, m, middle, reach);
        break;
    case 3:
    case 4:
        volume_add_tetrahedron(s, m, middle, reach);
        break;
    case 5:
        volume_add_torus(s, m, middle, reach);
        break;
    case 6:
        volume_add_fan(s, m, middle, reach);
        break;
    case 7:
    case 8:
        volume_add_sheet(s, m, middle, reach);
        break;
    default:
        volume_add_fan(s, m, middle, reach);
        volume_add_nothing(s, m, middle, reach);
    }
}

/* ---- objects --------------------------------------------------------------------------------------------------- */

/* Turned, scaled, mirrored or as it is. The reach of things is at most 7 sizes before, and a model does not enlarge. */
static void volume_choose_model(volume_scene *s, volume_mesh *m, gn_object *object)
{
    if (s->grid || volume_one_in(s, 3))
        return;
    int32_t axis[3];
    for (int i = 0; i < 3; i++)
        axis[i] = volume_between(s, 1, 100);
    gn_model_identity(&m->model);
    if (volume_one_in(s, 2)) {
        int32_t height = volume_between(s, 30000, 65536), width = volume_one_in(s, 2) ? -65536 : 65536;
        gn_model_scale(&m->model, width, height, 65536);
    }
    gn_model_rotate(&m->model, axis, (gn_angle)tap_random(&s->random));
    gn_model_translate(&m->model, volume_between(s, -s->size / 4, s->size / 4), 0, 0);
    object->model = &m->model;
}

static void volume_add_object(volume_scene *s)
{
    uint32_t number = s->packed.mesh_count++;
    volume_mesh *m = &s->meshes[number];
    gn_object *object = &s->objects[number];
    for (int32_t shapes = volume_between(s, 1, 3); shapes > 0; shapes--) {
        int32_t middle[3];
        volume_place(s, middle, s->size);
        volume_add_shape(s, m, middle, volume_between(s, s->size / 12 + 1, s->size / 2));
    }
    m->mesh.vertices = (const int32_t(*)[3])m->vertices;
    m->mesh.index_size = volume_one_in(s, 2) ? 2 : 4;
    for (uint32_t i = 0; i < 3 * m->mesh.triangle_count; i++)
        m->short_indices[i / 3][i % 3] = (uint16_t)m->indices[i / 3][i % 3];
    m->mesh.indices = m->mesh.index_size == 2 ? (const void *)m->short_indices : m->indices;
    adjacency_make(&m->mesh);
    object->mesh = &m->mesh;
    volume_choose_model(s, m, object);
}

/* A large sheet that shadows fall on. */
static void volume_add_floor(volume_scene *s)
{
    uint32_t number = s->packed.mesh_count++;
    volume_mesh *m = &s->meshes[number];
    int32_t r = 2 * s->size, y = volume_on_grid(s, -s->size), tilt = s->grid ? 0 : volume_between(s, -r / 4, r / 4);
    uint32_t first = volume_vertex(m, -r, y, -r);
    volume_vertex(m, -r, y + tilt, r);
    volume_vertex(m, r, y + tilt, r);
    volume_vertex(m, r, y, -r);
    volume_triangle(m, first, first + 1, first + 2);
    volume_triangle(m, first, first + 2, first + 3);
    m->mesh.vertices = (const int32_t(*)[3])m->vertices;
    m->mesh.indices = m->indices;
    m->mesh.index_size = 4;
    adjacency_make(&m->mesh);
    s->objects[number].mesh = &m->mesh;
}

/* ---- cameras and lights ---------------------------------------------------------------------------------------- */

/* Where the first solid is, or anywhere. */
static void volume_stand(volume_scene *s, int32_t place[3], int inside)
{
    volume_place(s, place, volume_one_in(s, 2) ? s->size : 3 * s->size);
    if (!inside)
        return;
    const gn_mesh *mesh = s->objects[s->packed.mesh_count - 1].mesh;
    for (int i = 0; i < 3; i++) {
        int64_t sum = 0;
        for (uint32_t v = 0; v < mesh->vertex_count && v < 8; v++)
            sum += mesh->vertices[v][i];
        place[i] = (int32_t)(sum / (mesh->vertex_count < 8 ? mesh->vertex_count : 8));
    }
}

/* The least near depth that the core takes: 16 / min(1, tan x, tan y), more for a far eye. */
static int32_t volume_least_near(const int32_t eye[3], double tangent)
{
    double reach = 1, least = 16 / (tangent < 1 ? tangent : 1);
    for (int i = 0; i < 3; i++) {
        double v = eye[i] < 0 ? -(double)eye[i] : eye[i];
        reach = v / GN_WORLD_MAX > reach ? v / GN_WORLD_MAX : reach;
    }
    return (int32_t)(least * 2 * reach) + 1;
}

static int volume_aim_camera(volume_scene *s)
{
    gn_camera *c = &s->packed.camera;
    int32_t eye[3], target[3], up[3] = {0, 1, 0}, size = s->size;
    s->inside = volume_one_in(s, 4);
    volume_stand(s, eye, s->inside);
    volume_place(s, target, size / 2);
    if (!s->grid)
        up[0] = volume_between(s, -3, 3);
    if (gn_look_at(c, eye, target, up) != GN_OK)
        return 0;
    if (volume_one_in(s, 4)) {
        int32_t near_depth = volume_between(s, -3 * (int64_t)size, size / 2);
        int32_t depth = volume_between(s, size + 64, 8 * (int64_t)size);
        int32_t half_height = volume_between(s, size / 4, 3 * (int64_t)size);
        return gn_orthographic(c, half_height, near_depth, near_depth + depth) == GN_OK;
    }
    gn_angle opening = (gn_angle)GN_DEGREES(10) + (gn_angle)(tap_random(&s->random) % GN_DEGREES(120));
    if (gn_perspective(c, opening, 1000, 10000) != GN_OK)
        return 0;
    double aspect = (double)s->packed.settings.width / s->packed.settings.height, tangent = c->tan_half / 16777216.0;
    int32_t least = volume_least_near(eye, aspect < 1 ? tangent * aspect : tangent), near_depth = least;
    if (volume_one_in(s, 2))
        near_depth += volume_between(s, 0, size / 2);
    int64_t far_depth = volume_one_in(s, 3) ? near_depth + volume_between(s, size / 4, 3 * (int64_t)size)
                                            : near_depth + 12 * (int64_t)size;
    if (far_depth > (int64_t)near_depth << 19)
        far_depth = (int64_t)near_depth << 19;
    if (far_depth > 1 << 28)
        far_depth = 1 << 28;
    return gn_perspective(c, opening, near_depth, (int32_t)far_depth) == GN_OK;
}

static int volume_aim_light(volume_scene *s)
{
    gn_light *light = &s->packed.light;
    int32_t size = s->size, position[3], target[3];
    memset(light, 0, sizeof *light);
    if (volume_one_in(s, 2)) {
        int32_t direction[3];
        for (int i = 0; i < 3; i++)
            direction[i] = s->grid ? volume_between(s, -2, 2) : volume_between(s, -1000000, 1000000);
        if (volume_one_in(s, 2) && direction[1] > 0)
            direction[1] = -direction[1];
        return gn_directional_light(light, direction, 0) == GN_OK && gn_fit_light(light, &s->packed.scene) == GN_OK;
    }
    volume_stand(s, position, volume_one_in(s, 8));
    if (volume_one_in(s, 2))
        position[1] = 2 * size;
    volume_place(s, target, size / 2);
    gn_angle opening = (gn_angle)GN_DEGREES(20) + (gn_angle)(tap_random(&s->random) % GN_DEGREES(130));
    if (gn_spot_light(light, position, target, 0, opening, 1000, 10000) != GN_OK)
        return 0;
    int32_t near_depth = volume_least_near(position, light->tan_half / 16777216.0);
    near_depth = near_depth < size / 50 ? size / 50 : near_depth;
    if (volume_one_in(s, 2))
        near_depth += volume_between(s, 0, size);
    int64_t far_depth = near_depth + volume_between(s, size, 8 * (int64_t)size);
    if (far_depth > 1 << 28)
        far_depth = 1 << 28;
    return gn_spot_light(light, position, target, 0, opening, near_depth, (int32_t)far_depth) == GN_OK;
}

/* ---- scenes ---------------------------------------------------------------------------------------------------- */

static TAP_UNUSED void volume_scene_free(volume_scene *s)
{
    for (uint32_t i = 0; i < s->packed.mesh_count; i++)
        free((void *)(uintptr_t)s->meshes[i].mesh.edges);
    s->packed.mesh_count = 0;
}

/* 0 where camera or light came out impossible: take the next seed. Free it all the same. */
static TAP_UNUSED int volume_scene_make(volume_scene *s, uint64_t seed)
{
    memset(s, 0, sizeof *s);
    s->random = seed * UINT64_C(0x2545f4914f6cdd1d) + 1;
    s->size = volume_between(s, 64, 127);
    s->size *= 1 << volume_between(s, 2, 15);
    s->grid = volume_one_in(s, 4) ? s->size / 8 : 0;
    uint16_t height = (uint16_t)volume_between(s, 1, VOLUME_MOST_SIZE);
    uint16_t width = (uint16_t)volume_between(s, 1, VOLUME_MOST_SIZE);
    s->packed.settings = gn_default_settings(width, height, 16);
    s->packed.settings.format = GN_NO_COLOUR;
    s->packed.settings.mask = 1;
    s->packed.settings.shadow = GN_SHADOW_VOLUMES;
    s->packed.objects = s->objects;
    s->packed.scene.objects = s->objects;
    if (!volume_one_in(s, 4))
        volume_add_floor(s);
    for (int32_t objects = volume_between(s, 1, 4); objects > 0; objects--)
        volume_add_object(s);
    s->packed.scene.object_count = s->packed.mesh_count;
    return volume_aim_camera(s) && volume_aim_light(s);
}

#endif
