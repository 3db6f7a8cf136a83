/* A point light in one pass: which faces light something in view, their maps, and the image; with one map at a time
 * or six. See gn_point_light.h.
 *
 * With one map the image is gone through once to learn which faces are needed, and then once for each of them: what a
 * face decides is kept, a bit a pixel (a byte where there are fractions of light), and the last one colours.
 *
 * Cost: visibility twice, with one map once more for each needed face but one. */
#include "gn_drawing.h"
#include "gn_point_light.h"

/* ---- what is in view --------------------------------------------------------------------------------------------- */

/* The faces that light something in a row, a bit each. W is in q. */
static uint32_t find_faces(const gn_context *context, gn_worker *worker, uint32_t from, int32_t column, int32_t row,
                           int32_t count)
{
    const gn_shading *s = &context->shading;
    const uint32_t *w = worker->q + from, *triangle = worker->triangle + from;
    gn_runner axis[3] = {gn_start_row(&s->coordinate[0], column, row), gn_start_row(&s->coordinate[1], column, row),
                         gn_start_row(&s->coordinate[2], column, row)};
    uint32_t found = 0;
    for (int32_t i = 0; i < count; i++) {
        uint32_t x = gn_step(&axis[0], w[i]), y = gn_step(&axis[1], w[i]), z = gn_step(&axis[2], w[i]);
        uint32_t face = 1u << gn_find_face(s, x, y, z).face;
        if (triangle[i] != GN_NO_TRIANGLE && !(found & face) && gn_find_pair(context, worker, triangle[i])->faces_light)
            found |= face;
    }
    return found & ((1u << GN_FACES) - 1);
}

/* The faces that light something in view. */
static gn_status look(gn_context *context, const gn_camera *camera, uint32_t *found)
{
    gn_worker *worker = context->workers;
    *found = 0;
    gn_status status = gn_begin_point_camera(context, camera);
    for (uint32_t i = 0; status == GN_OK && i < context->plan.camera_regions; i++) {
        gn_pixels pixels;
        gn_window window;
        void *colour = 0;
        status = gn_find_region(context, i, 0, GN_PHASE_CAMERA, &colour, 0, &pixels, &window);
        gn_rasterise_region(context, worker, &window);
        for (int32_t row = 0; row < pixels.height; row++) {
            uint32_t from = (uint32_t)row * pixels.width;
            if (!context->camera_view.affine)
                gn_row_of_w(worker->q + from, pixels.width, context->shading.w_shift);
            *found |= find_faces(context, worker, from, window.column0, window.row0 + row, pixels.width);
        }
    }
    return status;
}

/* ---- one map at a time ------------------------------------------------------------------------------------------- */

static int has_fractions(const gn_settings *settings)
{
    return settings->reconstruction && settings->reconstruction->whole != GN_DARK;
}

/* Bytes of a region's lit part. */
static uint64_t lit_bytes(const gn_plan *plan, const gn_settings *settings)
{
    uint64_t pixels = (uint64_t)plan->region_width * plan->region_height;
    return has_fractions(settings) ? pixels : (pixels + 7) / 8;
}

static uint64_t lay_out(gn_context *context, uint64_t used, const gn_plan *plan, const gn_settings *settings)
{
    uint8_t *base = (uint8_t *)context;
    used = gn_lay_out_point(context, used, settings);
    if (settings->shadow == GN_SHADOW_VOLUMES)
        return used;
    uint8_t *elsewhere = gn_take(base, &used, plan->region_width);
    uint8_t *lit = gn_take(base, &used, plan->camera_regions * lit_bytes(plan, settings));
    if (context) {
        context->point->elsewhere = elsewhere;
        context->point->lit = lit;
    }
    return used;
}

static gn_status refuse_camera(gn_context *context, const gn_camera *camera)
{
    (void)context, (void)camera;
    return GN_NOT_READY;
}

/* As gn_find_face_points; and which of the points another face decides: they lie nowhere, and z is 0. */
static void find_points(const gn_context *context, gn_points *points, uint32_t *q)
{
    gn_find_face_points(context, points, q);
    uint8_t *elsewhere = context->point->elsewhere + points->x % context->plan.region_width;
    for (int32_t i = 0; i < points->count; i++)
        elsewhere[i] = points->u[i] == GN_NOWHERE && points->z[i] == 0;
}

/* Keep what this face decided of a row's pixels, and take what others did: the lit parts of 254. */
static void merge_fractions(const gn_context *context, uint8_t *fraction, uint8_t *lit, int32_t count)
{
    for (int32_t i = 0; i < count; i++)
        if (context->point->elsewhere[i])
            fraction[i] = lit[i];
        else
            lit[i] = fraction[i];
}

/* The same with a bit a pixel, from a bit on, and q that is negative where a pixel is shadowed. */
static void merge_bits(const gn_context *context, uint32_t *q, uint8_t *lit, uint32_t bit, int32_t count)
{
    for (int32_t i = 0; i < count; i++, bit++) {
        uint8_t *byte = &lit[bit / 8], one = (uint8_t)(1u << bit % 8);
        if (context->point->elsewhere[i])
            q[i] |= *byte & one ? 0 : GN_DARK;
        else if (q[i] >> 31)
            *byte &= (uint8_t)~one;
        else
            *byte |= one;
    }
}

/* Test a region's pixels by the map of the face that is in memory; the last time they are coloured as well. */
static gn_status test_region(gn_context *context, uint32_t region, int last, void *colour, uint8_t *mask,
                             gn_pixels *pixels)
{
    gn_window window;
    gn_worker *worker = context->workers;
    gn_status status = gn_find_region(context, region, 0, GN_PHASE_CAMERA, &colour, mask, pixels, &window);
    if (status != GN_OK)
        return status;
    const gn_settings *settings = &context->settings;
    gn_row_shader *shade = settings->reconstruction ? settings->reconstruction->shade : settings->receiver->shade;
    uint8_t *lit = context->point->lit + region * lit_bytes(&context->plan, settings);
    uint32_t width = pixels->width;
    gn_rasterise_region(context, worker, &window);
    for (uint32_t row = 0, from = 0; row < pixels->height; row++, from += width) {
        shade(context, worker, from, window.column0, window.row0 + (int32_t)row, (int32_t)width);
        if (has_fractions(settings))
            merge_fractions(context, worker->fraction, lit + from, (int32_t)width);
        else
            merge_bits(context, worker->q + from, lit, from, (int32_t)width);
        if (last)
            gn_colour_region_row(context, worker, colour, mask, row, width);
    }
    return GN_OK;
}

static gn_status test_and_flush(gn_context *context, const gn_camera *camera, int last, gn_flush flush, void *user)
{
    gn_status status = gn_begin_point_camera(context, camera);
    for (uint32_t i = 0; status == GN_OK && i < context->plan.camera_regions; i++) {
        gn_pixels pixels;
        status = test_region(context, i, last, context->colour_buffer, context->mask_buffer, &pixels);
        if (status == GN_OK && last && flush(user, &pixels))
            status = GN_STOPPED;
    }
    return status;
}

/* needed: a bit a face. */
static gn_status draw_one_by_one(gn_context *context, uint32_t needed, const gn_camera *camera, gn_flush flush,
                                 void *user)
{
    gn_point *point = context->point;
    int coloured = 0;
    gn_status status = GN_OK;
    uint64_t bytes = context->plan.camera_regions * lit_bytes(&context->plan, &context->settings);
    for (uint64_t i = 0; i < bytes; i++)
        point->lit[i] = has_fractions(&context->settings) ? 254 : 255; /* what faces without casters light */
    for (uint32_t face = 0; status == GN_OK && face < GN_FACES; face++) {
        uint32_t regions = 0;
        if (needed >> face & 1)
            status = gn_begin_face(context, face, &regions);
        else
            gn_skip_face(context, face);
        if (!regions)
            continue;
        status = gn_draw_regions(context, regions);
        coloured = needed >> face == 1; /* the last one */
        if (status == GN_OK)
            status = test_and_flush(context, camera, coloured, flush, user);
    }
    if (status != GN_OK || coloured)
        return status;
    point->first = GN_NO_FACE;
    return test_and_flush(context, camera, 1, flush, user);
}

const gn_faces gn_one_face = {1, lay_out, refuse_camera, find_points};

/* ---- the pass ---------------------------------------------------------------------------------------------------- */

static gn_status draw_all(gn_context *context, uint32_t needed, const gn_camera *camera, gn_flush flush, void *user)
{
    gn_status status = GN_OK;
    for (uint32_t face = 0; status == GN_OK && face < GN_FACES; face++) {
        uint32_t regions = 0;
        if (needed >> face & 1)
            status = gn_begin_face(context, face, &regions);
        else
            gn_skip_face(context, face);
        if (status == GN_OK)
            status = gn_draw_regions(context, regions);
    }
    if (status != GN_OK)
        return status;
    gn_choose_face(context, 0);
    status = gn_begin_point_camera(context, camera);
    return status == GN_OK ? gn_flush_regions(context, gn_camera_region, flush, user) : status;
}

gn_status gn_point_pass(gn_context *context, const gn_light *light, const gn_camera *camera, gn_flush flush, void *user)
{
    if (!context || !light || !camera || !flush || light->kind != GN_POINT)
        return GN_BAD_ARGUMENT;
    uint32_t needed;
    gn_status status = gn_begin_point_light(context, light);
    if (status == GN_OK)
        status = look(context, camera, &needed);
    if (status == GN_OK && gn_map_count(&context->settings) == 1)
        status = draw_one_by_one(context, needed, camera, flush, user);
    else if (status == GN_OK)
        status = draw_all(context, needed, camera, flush, user);
    context->phase = GN_PHASE_NONE;
    context->point_light = 0;
    return status;
}
