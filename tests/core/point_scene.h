/* A scene about a point light, for tests of core and host: a sphere with holes, boxes on all sides, a large turned
 * room. */
#ifndef POINT_SCENE_H
#define POINT_SCENE_H

#include "mesh_edges.h"
#include "scenes.h"

#include <math.h>

typedef long double real;

enum { WIDTH = 96, HEIGHT = 72, MAP = 48, FACES = 6 };

static TAP_UNUSED const gn_reconstruction *const reconstructions[] = {
    0,           &gn_bilinear,    &gn_jitter_4x4,         &gn_box_3x3,   &gn_box_5x5,
    &gn_box_7x7, &gn_silhouettes, &gn_silhouettes_smooth, &gn_crossings,
};
static TAP_UNUSED const gn_receiver *const receivers[] = {0, &gn_plane_bias, &gn_virtual, &gn_virtual_always};
enum { RECONSTRUCTIONS = 9, RECEIVERS = 4 };

/* ---- scenes ------------------------------------------------------------------------------------------------------ */

/* A sphere about the light with holes, and boxes on all sides of it within a large room that is turned. */
typedef struct stage {
    shape sphere, boxes, room;
    gn_model model;
    gn_object objects[3];
    gn_scene scene;
    gn_light light;
    gn_settings settings;
} stage;

enum { CENTRE = 40000, REACH = 1 << 20 };
static const int32_t centre[3] = {CENTRE, -CENTRE, CENTRE / 2};

/* Squares of a grid of latitude and longitude, every third one left out. */
static void add_sphere(shape *s, int32_t radius, int steps)
{
    real turn = 2 * acosl(-1.0L);
    for (int i = 0; i <= steps; i++)
        for (int k = 0; k < 2 * steps; k++) {
            real a = turn / 2 * i / steps, b = turn * k / (2 * steps);
            add_vertex(s, centre[0] + (int32_t)(radius * sinl(a) * cosl(b)), centre[1] + (int32_t)(radius * cosl(a)),
                       centre[2] + (int32_t)(radius * sinl(a) * sinl(b)));
        }
    for (int i = 0; i < steps; i++)
        for (int k = 0; k < 2 * steps; k++) {
            uint32_t row = (uint32_t)(2 * steps), next = (uint32_t)((k + 1) % (2 * steps));
            uint32_t a = (uint32_t)i * row + (uint32_t)k, b = (uint32_t)i * row + next;
            if ((i + k) % 3 == 0)
                continue;
            add_triangle(s, a, b, b + row);
            add_triangle(s, a, b + row, a + row);
        }
}

static TAP_UNUSED void set_stage(stage *s)
{
    static const int32_t low[3] = {-REACH, -REACH, -REACH}, high[3] = {REACH, REACH, REACH}, axis[3] = {3, -5, 4};
    memset(s, 0, sizeof *s);
    s->sphere = shape_new(0);
    s->boxes = shape_new(1);
    s->room = shape_new(0);
    add_sphere(&s->sphere, REACH / 8, 7);
    for (int i = 0; i < 24; i++) {
        int32_t a[3], b[3];
        for (int k = 0; k < 3; k++) {
            a[k] = between(-REACH / 2, REACH / 2);
            b[k] = a[k] + between(REACH / 64, REACH / 8);
        }
        add_box(&s->boxes, a, b);
    }
    add_box(&s->room, low, high);
    gn_model_identity(&s->model);
    (void)gn_model_rotate(&s->model, axis, GN_DEGREES(33));
    s->objects[0] = (gn_object){&s->sphere.mesh, 0, {200, 200, 200}};
    s->objects[1] = (gn_object){&s->boxes.mesh, 0, {90, 220, 250}};
    s->objects[2] = (gn_object){&s->room.mesh, &s->model, {250, 240, 230}};
    make_edges(&s->sphere);
    make_edges(&s->boxes);
    s->scene.objects = s->objects;
    s->scene.object_count = 3;
    s->scene.ambient = 9000;
    (void)gn_point_light(&s->light, centre, REACH / 16, 4 * REACH);
    s->settings = gn_default_settings(WIDTH, HEIGHT, MAP);
    s->settings.surface = GN_MIXED;
    s->settings.bias.value = 2 << 16;
    s->settings.receiver = &gn_virtual;
    s->settings.mask = 1;
    s->settings.workers = 3;
    s->settings.faces = &gn_six_faces;
}

static TAP_UNUSED void free_stage(stage *s)
{
    free(edges_of(&s->sphere));
    free(edges_of(&s->boxes));
    shape_free(&s->sphere);
    shape_free(&s->boxes);
    shape_free(&s->room);
}

static TAP_UNUSED void set_camera(gn_camera *camera, int which)
{
    static const int32_t eyes[5][3] = {{REACH / 2, REACH / 3, REACH / 5},
                                       {-REACH / 2, -REACH / 2, REACH / 2},
                                       {CENTRE, -CENTRE, CENTRE / 2}, /* in the light */
                                       {REACH / 9, REACH * 3 / 4, -REACH / 2},
                                       {REACH / 2, -REACH / 3, -REACH / 3}};
    static const int32_t targets[5][3] = {
        {0, 0, 0}, {REACH, REACH / 7, 0}, {-REACH, REACH, REACH}, {0, -REACH, 0}, {-REACH, REACH / 9, REACH}};
    static const int32_t up[3] = {1, 9, 2};
    memset(camera, 0, sizeof *camera);
    (void)gn_look_at(camera, eyes[which], targets[which], up);
    if (which == 3)
        (void)gn_orthographic(camera, REACH * 2 / 3, -REACH, 4 * REACH);
    else
        (void)gn_perspective(camera, GN_DEGREES(95), REACH / 200, 8 * REACH);
}

/* Both passes of a point light, in the way that settings.faces has. */
static TAP_UNUSED gn_status render(frame *f, const stage *s, const gn_settings *settings, const gn_camera *camera)
{
    gn_status status = frame_start(f, &s->scene, settings);
    if (status == GN_OK && settings->faces == &gn_one_face)
        return gn_point_pass(f->context, &s->light, camera, frame_flush, f);
    if (status == GN_OK)
        status = gn_light_faces(f->context, &s->light);
    return status == GN_OK ? gn_camera_pass(f->context, camera, frame_flush, f) : status;
}

static TAP_UNUSED int same_pictures(const frame *a, const frame *b)
{
    return memcmp(a->mask, b->mask, mask_bytes(a)) == 0 && memcmp(a->colour, b->colour, colour_bytes(a)) == 0;
}

/* ---- rays and faces ---------------------------------------------------------------------------------------------- */

/* The face of a point as seen from the light by the definition, and its two ratios along right and down of its map;
 * *margin: by how much the largest magnitude exceeds the next. */
static TAP_UNUSED int face_of(const real v[3], real ratio[2], real *margin)
{
    int axis = 0;
    for (int i = 1; i < 3; i++)
        axis = fabsl(v[i]) > fabsl(v[axis]) ? i : axis;
    int next = (axis + 1) % 3, last = (axis + 2) % 3;
    real m = fabsl(v[axis]);
    *margin = m - fmaxl(fabsl(v[next]), fabsl(v[last]));
    ratio[0] = (v[axis] > 0 ? -v[next] : v[next]) / m;
    ratio[1] = -v[last] / m;
    return 2 * axis + (v[axis] < 0);
}

/* Where a ray meets a triangle, in multiples of its direction; 0: nowhere. *beside: how far inside. */
static TAP_UNUSED real meet(int32_t world[3][3], const int32_t from[3], const real d[3], real *inside)
{
    real e[2][3], o[3], p[3], q[3];
    for (int i = 0; i < 3; i++) {
        e[0][i] = world[1][i] - world[0][i];
        e[1][i] = world[2][i] - world[0][i];
        o[i] = from[i] - world[0][i];
    }
    for (int i = 0; i < 3; i++) {
        int j = (i + 1) % 3, k = (i + 2) % 3;
        p[i] = d[j] * e[1][k] - d[k] * e[1][j];
        q[i] = o[j] * e[0][k] - o[k] * e[0][j];
    }
    real determinant = e[0][0] * p[0] + e[0][1] * p[1] + e[0][2] * p[2];
    if (determinant == 0)
        return 0;
    real u = (o[0] * p[0] + o[1] * p[1] + o[2] * p[2]) / determinant;
    real v = (d[0] * q[0] + d[1] * q[1] + d[2] * q[2]) / determinant;
    *inside = fminl(fminl(u, v), 1 - u - v);
    return (e[1][0] * q[0] + e[1][1] * q[1] + e[1][2] * q[2]) / determinant;
}

#endif
