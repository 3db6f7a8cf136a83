/* Six resident maps of a point light; and what a face is. See gn_point_light.h. */
#include "gn_point_light.h"

#include "gn_around.h"
#include "gn_drawing.h"

/* ---- faces ------------------------------------------------------------------------------------------------------- */

/* Texels beyond a face on each side: one more than a reconstruction of n x n texels reads beyond the point's own. */
static uint32_t border_of(const gn_settings *settings)
{
    const gn_reconstruction *how = settings->reconstruction;
    uint32_t border = 1, texels = !how ? 1 : how->votes > how->samples ? how->votes : how->samples;
    if (settings->receiver && texels < 4)
        texels = 4; /* virtual samples ask the four about the point first */
    while ((2 * border - 1) * (2 * border - 1) < texels)
        border++;
    return border;
}

/* The tangent of half a face's opening, 24 fraction bits; 0 where the map is too small. */
static uint32_t find_tangent(const gn_settings *settings)
{
    uint32_t width = settings->map_width, height = settings->map_height, least = width < height ? width : height;
    uint32_t border = 2 * border_of(settings);
    return least > border ? gn_divide((uint64_t)least << 24, least - border) : 0;
}

/* The spot light of a face: forward along an axis, up along the one before it, and right x up = -forward. */
static void make_face(gn_light *face, const gn_light *light, uint32_t number, uint32_t tangent)
{
    gn_light empty = {0};
    uint32_t axis = number / 2, next = axis < 2 ? axis + 1 : 0, one = 1u << 30;
    int32_t sign = number & 1 ? -1 : 1;
    *face = empty;
    face->kind = GN_SPOT;
    face->forward[axis] = sign * (int32_t)one;
    face->right[next] = -sign * (int32_t)one;
    face->up[3 - axis - next] = (int32_t)one;
    for (int i = 0; i < 3; i++)
        face->position[i] = light->position[i];
    face->tan_half = tangent;
    face->near_depth = light->near_depth;
    face->far_depth = light->far_depth;
}

gn_status gn_begin_point_light(gn_context *context, const gn_light *light)
{
    const gn_settings *settings = &context->settings;
    uint32_t tangent = find_tangent(settings);
    if (light->kind != GN_POINT || !context->point || settings->fit || settings->warp || !tangent)
        return GN_UNSUPPORTED;
    gn_point *point = context->point;
    gn_status status = GN_OK;
    context->phase = GN_PHASE_NONE;
    context->point_light = 0;
    for (uint32_t i = 0; status == GN_OK && i < GN_FACES; i++) {
        make_face(&context->light, light, i, tangent);
        status = gn_make_light_view(&point->views[i], &context->light, settings->map_width, settings->map_height);
    }
    if (status != GN_OK)
        return status;
    context->light_view = point->views[0];
    point->scale[0] = gn_divide((uint64_t)settings->map_width << 41, tangent);
    point->scale[1] = gn_divide((uint64_t)settings->map_height << 41, tangent);
    point->latest = 0;
    point->done = 0;
    context->point_light = 1;
    return GN_OK;
}

/* ---- which faces have casters ------------------------------------------------------------------------------------ */

/* The sides of the frustum that a vertex is beyond, a bit each. */
static uint32_t sides_beyond(const gn_view *view, const gn_object *object, const gn_vertex *vertex, uint32_t index)
{
    int32_t world[3];
    gn_place p;
    if (vertex->depth)
        return (uint32_t)(vertex->x < 0) | (uint32_t)(vertex->x > 2 * view->half_width) << 1 |
               (uint32_t)(vertex->y < 0) << 2 | (uint32_t)(vertex->y > 2 * view->half_height) << 3;
    (void)gn_world_position(object, index, world);
    (void)gn_view_place(view, world, &p);
    int64_t x = p.c[0], y = p.c[1], w = p.c[2];
    return (uint32_t)(x < -w) | (uint32_t)(x > w) << 1 | (uint32_t)(y < -w) << 2 | (uint32_t)(y > w) << 3 |
           (uint32_t)(w < view->near_w) << 4 | (uint32_t)(w > view->far_w) << 5;
}

static int covers(const gn_context *context, uint32_t first, uint32_t end)
{
    for (uint32_t o = first; o < end; o++) {
        const gn_object *object = &context->scene->objects[o];
        const gn_vertex *vertices = context->vertices + context->objects[o].first_vertex;
        for (uint32_t t = 0; t < object->mesh->triangle_count; t++) {
            uint32_t index[3], beyond = 63;
            gn_triangle_indices(object->mesh, t, index);
            for (int i = 0; beyond && i < 3; i++)
                beyond &= sides_beyond(&context->light_view, object, &vertices[index[i]], index[i]);
            if (!beyond)
                return 1;
        }
    }
    return 0;
}

/* May a triangle cover a texel of the latest face? */
static int has_casters(gn_context *context)
{
    const gn_casters *casters = context->settings.casters;
    return casters ? casters->reach(context, covers) : covers(context, 0, context->scene->object_count);
}

/* ---- the light pass ---------------------------------------------------------------------------------------------- */

void gn_choose_face(gn_context *context, uint32_t face)
{
    gn_point *point = context->point;
    if (gn_map_count(&context->settings) == 1)
        point->first = (uint8_t)face;
    uint32_t row = (uint32_t)gn_face_row(context, face);
    context->map = point->map + (size_t)row * context->map_stride;
    if (context->drawn)
        context->drawn->map = point->drawn_map + (size_t)row * context->settings.map_width;
}

/* A map on which all is lit. */
static void clear_face(gn_context *context)
{
    const gn_drawing *drawing = gn_find_drawing(&context->settings);
    size_t rows = context->settings.map_height, texels = rows * context->map_stride;
    for (size_t i = 0; i < texels; i++)
        context->map[i] = GN_FARTHEST;
    for (size_t i = 0; drawing && i < rows * context->settings.map_width; i++)
        context->drawn->map[i] = drawing->empty;
    for (uint32_t i = 0; i < context->plan.light_regions; i++)
        context->progress[i] = GN_REGION_DONE;
}

/* Note whether all regions of the latest face have been drawn. */
static void close_face(gn_context *context)
{
    uint32_t missing = 0;
    for (uint32_t i = 0; i < context->plan.light_regions; i++)
        missing += context->progress[i] != GN_REGION_DONE;
    if (context->phase == GN_PHASE_LIGHT && !missing)
        context->point->done |= (uint8_t)(1u << context->point->latest);
}

static void count_face(gn_context *context, int drawn)
{
#if GN_STATISTICS
    context->workers[0].statistics.faces_drawn += (uint64_t)drawn;
    context->workers[0].statistics.faces_skipped += (uint64_t)!drawn;
#else
    (void)context, (void)drawn;
#endif
}

gn_status gn_begin_face(gn_context *context, uint32_t face, uint32_t *regions)
{
    gn_point *point = context->point;
    gn_light light;
    make_face(&light, &context->light, face, context->light.tan_half);
    gn_choose_face(context, face);
    gn_status status = gn_light_begin(context, &light);
    if (status != GN_OK)
        return status;
    context->point_light = 1;
    point->latest = (uint8_t)face;
    point->done &= (uint8_t) ~(1u << face);
    int drawn = has_casters(context);
    if (!drawn)
        clear_face(context);
    count_face(context, drawn);
    *regions = drawn ? context->plan.light_regions : 0;
    return GN_OK;
}

gn_status gn_draw_regions(gn_context *context, uint32_t regions)
{
    gn_status status = GN_OK;
    for (uint32_t i = 0; status == GN_OK && i < regions; i++) {
        status = gn_light_layers(context, i, 0);
        if (status == GN_OK)
            status = gn_light_resolve(context, i, 0);
    }
    return status;
}

void gn_skip_face(gn_context *context, uint32_t face)
{
    gn_choose_face(context, face);
    clear_face(context);
    count_face(context, 0);
}

/* Is it the light whose faces have been drawn so far? */
static int is_same_light(const gn_context *context, const gn_light *light)
{
    const gn_light *face = &context->light;
    int same = context->point_light && context->phase != GN_PHASE_NONE && face->near_depth == light->near_depth &&
               face->far_depth == light->far_depth;
    for (int i = 0; i < 3; i++)
        same &= face->position[i] == light->position[i];
    return same;
}

gn_status gn_light_face(gn_context *context, const gn_light *light, uint32_t face, uint32_t *regions)
{
    if (!context || !light || !regions || face >= GN_FACES || light->kind != GN_POINT)
        return GN_BAD_ARGUMENT;
    if (gn_map_count(&context->settings) != GN_FACES)
        return GN_UNSUPPORTED;
    gn_status status = GN_OK;
    if (is_same_light(context, light))
        close_face(context);
    else
        status = gn_begin_point_light(context, light);
    return status == GN_OK ? gn_begin_face(context, face, regions) : status;
}

gn_status gn_light_faces(gn_context *context, const gn_light *light)
{
    if (!context || !light || light->kind != GN_POINT)
        return GN_BAD_ARGUMENT;
    if (gn_map_count(&context->settings) != GN_FACES)
        return GN_UNSUPPORTED;
    gn_status status = gn_begin_point_light(context, light);
    for (uint32_t face = 0; status == GN_OK && face < GN_FACES; face++) {
        uint32_t regions = 0;
        status = gn_begin_face(context, face, &regions);
        if (status == GN_OK)
            status = gn_draw_regions(context, regions);
        close_face(context);
    }
    return status;
}

/* ---- the camera pass --------------------------------------------------------------------------------------------- */

/* 2 x - z, exactly. */
static gn_row twice_less(const gn_row *x, const gn_row *z)
{
    gn_row row = *x;
    for (int i = 0; i < 3; i++)
        row.m[i] = 2 * x->m[i] - z->m[i];
    row.offset = 2 * x->offset - z->offset;
    return row;
}

/* A view of all faces at once: x, y and z from the light, in the unit of w; nothing else of the views differs. Of a
 * spot light gn_make_shading takes (X + W) / 2, (Y + W) / 2 and W. Of 2 x - z, 2 y - z and z these are x, y and z. */
static void set_axes(gn_context *context)
{
    const gn_view *views = context->point->views;
    const gn_row *x = &views[0].row[2], *y = &views[2].row[2], *z = &views[4].row[2];
    context->light_view.row[0] = twice_less(x, z);
    context->light_view.row[1] = twice_less(y, z);
    context->light_view.row[2] = *z;
}

gn_status gn_begin_point_camera(gn_context *context, const gn_camera *camera)
{
    int32_t largest_w;
    context->phase = GN_PHASE_CAMERA_FAILED; /* as in gn_camera_begin */
    set_axes(context);
    gn_status status = gn_begin_regions(context, camera, &largest_w);
    if (status == GN_OK)
        status = gn_make_shading(context, largest_w);
    if (status == GN_OK)
        status = gn_make_bins(context, &context->camera_view);
    if (status == GN_OK)
        context->phase = GN_PHASE_CAMERA;
    return status;
}

static gn_status begin_camera(gn_context *context, const gn_camera *camera)
{
    close_face(context);
    if (context->phase == GN_PHASE_NONE || context->point->done != (1 << GN_FACES) - 1)
        return GN_NOT_READY;
    gn_choose_face(context, 0);
    return gn_begin_point_camera(context, camera);
}

/* Texels from the centre of a face to a ratio of its w, 2^30 = 1. */
GN_INLINE uint32_t across(uint32_t ratio, uint32_t scale, uint32_t negative)
{
    uint32_t way = (uint32_t)(gn_multiply_u(ratio, scale) >> 32);
    return negative ? 0 - way : way;
}

void gn_find_face_points(const gn_context *context, gn_points *points, uint32_t *q)
{
    const gn_shading *s = &context->shading;
    const gn_point *point = context->point;
    const uint32_t half = 1u << (GN_FACE_BITS - 1), count = gn_map_count(&context->settings);
    const uint32_t centre_u = (context->settings.map_width - 1) * half, height = context->settings.map_height;
    gn_runner x = points->row[0], y = points->row[1], z = points->row[2];
    for (int32_t i = 0; i < points->count; i++) {
        uint32_t w = q[i], along_x = gn_step(&x, w), along_y = gn_step(&y, w);
        gn_face_place p = gn_find_face(s, along_x, along_y, gn_step(&z, w));
        uint32_t face = p.face, below = face - point->first;
        q[i] = 0;
        points->u[i] = GN_NOWHERE;
        points->z[i] = 0xffffffffu;
        if (face == GN_NO_FACE)
            continue; /* unlit */
        uint32_t right = p.magnitude[1], down = p.magnitude[2];
        uint32_t nearness = gn_divide_place(s, &right, &down, p.magnitude[0]);
        /* the tangent is 1; the direction of u and v says nothing for the distance */
        q[i] = gn_over_distance(nearness, (1u << 29) + right / 2, (1u << 29) + down / 2, 1u << 19);
        points->z[i] = 0;
        if (below >= count)
            continue; /* on a face that is not in memory */
        /* right is the next axis towards minus (of faces towards minus: plus), down the last one towards minus */
        points->u[i] = centre_u + across(right, point->scale[0], (p.next >> 31) ^ (face & 1) ^ 1);
        points->v[i] =
            (height - 1) * half + across(down, point->scale[1], p.last >> 31 ^ 1) + (below * height << GN_FACE_BITS);
        points->z[i] = gn_spot_depth(&context->light_view, nearness);
    }
}

/* ---- the choice -------------------------------------------------------------------------------------------------- */

static void shade_nearest(gn_context *context, gn_worker *worker, uint32_t from, int32_t x, int32_t y, int32_t count)
{
    if (context->point_light)
        gn_cascade_row(context, worker, from, x, y, count);
    else
        gn_shade_row(context, worker->q + from, x, y, count);
}

/* What stands for neither receiver nor reconstruction. */
static const gn_reconstruction nearest = {shade_nearest, gn_vote_nearest, 0, gn_colour_row, GN_DARK, 1, 1, 0, 0};

uint64_t gn_lay_out_point(gn_context *context, uint64_t used, const gn_settings *settings)
{
    if (settings->shadow == GN_SHADOW_VOLUMES)
        return used;
    gn_point *point = gn_take((uint8_t *)context, &used, sizeof *point);
    if (context) {
        gn_point empty = {0};
        *point = empty;
        point->map = context->map;
        point->drawn_map = context->drawn ? context->drawn->map : 0;
        context->point = point;
        if (!settings->receiver && !settings->reconstruction)
            context->settings.reconstruction = &nearest;
    }
    return used;
}

static uint64_t lay_out(gn_context *context, uint64_t used, const gn_plan *plan, const gn_settings *settings)
{
    (void)plan;
    return gn_lay_out_point(context, used, settings);
}

const gn_faces gn_six_faces = {GN_FACES, lay_out, begin_camera, gn_find_face_points};
