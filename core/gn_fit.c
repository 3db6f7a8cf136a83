/* Fits: the rectangle of a light's plane that a map covers, and the light's view of it.
 *
 * Desired view (DV, Rosen 2012): the bounds of the places that the camera sees. A texel more on each side, so that
 * every point has texels about it. */
#include "gn_parameterisation.h"

/* The least side of a rectangle: beyond, more texels tell nothing that vertices, snapped to integers, know. */
#define LEAST_SIDE (GN_WHOLE >> 10)

/* ---- planes ------------------------------------------------------------------------------------------------------ */

static int32_t larger_side(const gn_light *light)
{
    return light->box_width > light->box_height ? light->box_width : light->box_height;
}

void gn_whole_plane(gn_rectangle *r, const gn_light *light)
{
    gn_rectangle whole = {GN_WHOLE, 0, {0, 0}, {GN_WHOLE, GN_WHOLE}};
    *r = whole;
    if (light->kind == GN_SPOT)
        return;
    uint32_t side = (uint32_t)larger_side(light);
    r->size[0] = (int32_t)gn_divide((uint64_t)(uint32_t)light->box_width << 30, side);
    r->size[1] = (int32_t)gn_divide((uint64_t)(uint32_t)light->box_height << 30, side);
}

/* (a cosine + b sine), |a|, |b| <= 2^30. */
static int64_t turn(int32_t a, int32_t b, gn_q2_30 cosine, gn_q2_30 sine)
{
    return gn_multiply(a, cosine) + gn_multiply(b, sine);
}

static int32_t turned(int32_t a, int32_t b, gn_q2_30 cosine, gn_q2_30 sine)
{
    return (int32_t)gn_floor_shift_64(turn(a, b, cosine, sine) + (1 << 29), 30);
}

/* The box of a directional light becomes the rectangle, its axes turn with it; what lies along the light stays. */
static void fit_box(gn_light *light, const gn_rectangle *r)
{
    int32_t side = larger_side(light), left = light->box_u, top = light->box_v + light->box_height;
    for (int i = 0; i < 3; i++) {
        int32_t right = light->right[i], up = light->up[i];
        light->right[i] = turned(right, up, r->cosine, -r->sine);
        light->up[i] = turned(up, right, r->cosine, r->sine);
    }
    /* of the rectangle's upper left corner, 30 fraction bits */
    int64_t u = turn(left, top, r->cosine, -r->sine) + gn_multiply(r->low[0], side);
    int64_t v = turn(top, left, r->cosine, r->sine) - gn_multiply(r->low[1], side);
    int64_t end_u = u + gn_multiply(r->size[0], side), end_v = v - gn_multiply(r->size[1], side);
    light->box_u = (int32_t)gn_floor_shift_64(u, 30);
    light->box_v = (int32_t)gn_floor_shift_64(end_v, 30);
    light->box_width = (int32_t)gn_floor_shift_64(end_u + GN_WHOLE - 1, 30) - light->box_u;
    light->box_height = (int32_t)gn_floor_shift_64(v + GN_WHOLE - 1, 30) - light->box_v;
    light->box_width = light->box_width < 64 ? 64 : light->box_width;
    light->box_height = light->box_height < 64 ? 64 : light->box_height;
}

/* (along / tangent + forward centre) / half, centre and half in 2^-30: a direction whose product with a point is its
 * place in the rectangle, -1 to 1, times its depth. */
static void make_skew_axis(gn_scaled axis[3], const int32_t along[3], const gn_q2_30 forward[3], gn_scaled tangent,
                           int64_t centre, int32_t half)
{
    gn_scaled side = gn_scale(half, -30), to = gn_scale(centre, -30);
    for (int i = 0; i < 3; i++) {
        gn_scaled part = gn_scaled_add(gn_scaled_divide(gn_scale(along[i], -30), tangent),
                                       gn_scaled_multiply(gn_scale(forward[i], -30), to));
        axis[i] = gn_scaled_divide(part, side);
    }
}

/* The part of a spot light's frustum above the rectangle, as a light whose axes are neither of one length nor upright
 * on each other, but none longer than 1: the tangent makes up for it. GN_OUT_OF_RANGE: too narrow. */
static gn_status fit_frustum(gn_light *light, const gn_rectangle *r)
{
    gn_scaled tangent = gn_scale(light->tan_half, -24), axis[2][3];
    int32_t across[3], up[3], bits = -1000;
    for (int i = 0; i < 3; i++) {
        across[i] = turned(light->right[i], light->up[i], r->cosine, -r->sine);
        up[i] = turned(light->up[i], light->right[i], r->cosine, r->sine);
    }
    /* the centre, in -1 .. 1 of the frustum from its axis; the plane goes from 0 to 1 */
    int64_t centre_x = 2 * (int64_t)r->low[0] + r->size[0] - r->cosine - r->sine;
    int64_t centre_y = 2 * (int64_t)r->low[1] + r->size[1] - r->cosine + r->sine;
    make_skew_axis(axis[0], across, light->forward, tangent, -centre_x, r->size[0]);
    make_skew_axis(axis[1], up, light->forward, tangent, centre_y, r->size[1]);
    for (int i = 0; i < 3; i++) {
        int32_t a = gn_scaled_bits(axis[0][i]), b = gn_scaled_bits(axis[1][i]);
        bits = a > bits ? a : bits;
        bits = b > bits ? b : bits;
    }
    bits++; /* of three components the sum of squares is below 4 */
    if (bits > 8 || bits < -6)
        return GN_OUT_OF_RANGE;
    light->tan_half = (gn_q8_24)1 << (24 - bits);
    for (int i = 0; i < 3; i++) {
        light->right[i] = (int32_t)gn_scaled_round(axis[0][i], bits - 30);
        light->up[i] = (int32_t)gn_scaled_round(axis[1][i], bits - 30);
    }
    return GN_OK;
}

gn_status gn_make_fitted_view(gn_view *view, gn_light *light, const gn_rectangle *r, int32_t width, int32_t height)
{
    gn_light fitted = *light;
    if (light->kind == GN_DIRECTIONAL) {
        fit_box(light, r);
        return gn_make_light_view(view, light, width, height);
    }
    if (r->sine != 0 || r->low[0] != 0 || r->low[1] != 0 || r->size[0] != GN_WHOLE || r->size[1] != GN_WHOLE) {
        gn_status status = fit_frustum(&fitted, r);
        if (status != GN_OK)
            return status;
    }
    return gn_make_light_view(view, &fitted, width, height);
}

int gn_find_place_on_plane(const gn_fitting *fitting, uint32_t *left, uint32_t *top)
{
    const gn_rectangle *r = &fitting->rectangle;
    if (!fitting->fitted)
        return 1;
    int32_t x = r->low[0] + (int32_t)gn_floor_shift_64(gn_multiply((int32_t)*left, r->size[0]), 30);
    int32_t y = r->low[1] + (int32_t)gn_floor_shift_64(gn_multiply((int32_t)*top, r->size[1]), 30);
    *left = (uint32_t)turned(x, y, r->cosine, -r->sine);
    *top = (uint32_t)turned(y, x, r->cosine, r->sine);
    return *left < GN_WHOLE && *top < GN_WHOLE;
}

/* ---- bounds ------------------------------------------------------------------------------------------------------ */

/* A side [low, low + size) with a texel more at each end, of small maps an eighth, and no less than the least. At most
 * the plane's diagonal, so it stays below 2^31. */
static void widen_side(int32_t *low, int32_t *size, uint32_t texels)
{
    int32_t wide = *size < LEAST_SIDE ? LEAST_SIDE : *size;
    wide += texels < 10 ? wide >> 2 : (int32_t)gn_divide((uint64_t)(uint32_t)wide * 2, texels - 2) + 1;
    *low -= (wide - *size) >> 1;
    *size = wide;
}

/* Whether the formats hold the light's view of a rectangle, and places on it that the camera sees. */
static int fits(gn_context *context, const gn_rectangle *r)
{
    gn_light light = context->fitting->light;
    return gn_make_fitted_view(&context->light_view, &light, r, GN_FINE, GN_FINE) == GN_OK &&
           gn_make_shading(context, context->fitting->largest_w) == GN_OK;
}

void gn_set_rectangle(gn_context *context, const gn_rectangle *found)
{
    gn_fitting *fitting = context->fitting;
    gn_rectangle r = *found;
    widen_side(&r.low[0], &r.size[0], context->settings.map_width);
    widen_side(&r.low[1], &r.size[1], context->settings.map_height);
    fitting->fitted = 1;
    while (!fits(context, &r)) { /* too narrow: twice the narrower side, to both sides alike */
        int narrower = r.size[1] < r.size[0];
        if (r.size[narrower] > GN_WHOLE / 2) {
            gn_whole_plane(&r, &fitting->light);
            fitting->fitted = 0;
            break;
        }
        r.low[narrower] -= r.size[narrower] / 2;
        r.size[narrower] *= 2;
    }
    fitting->rectangle = r;
}

typedef struct bounds {
    uint32_t low[2], high[2];
} bounds;

static uint64_t bounds_bytes(const gn_settings *settings)
{
    (void)settings;
    return sizeof(bounds);
}

static void clear_bounds(const gn_settings *settings, void *sums)
{
    bounds none = {{GN_WHOLE, GN_WHOLE}, {0, 0}};
    (void)settings;
    *(bounds *)sums = none;
}

static void add_bounds(const gn_context *context, void *sums, const gn_points *points, const uint32_t *w)
{
    bounds b = *(bounds *)sums;
    uint32_t bits = gn_point_bits(context);
    (void)w;
    for (int32_t i = 0; i < points->count; i++) {
        if (points->u[i] == GN_NOWHERE)
            continue;
        uint32_t x = gn_share(points->u[i], bits), y = gn_share(points->v[i], bits);
        b.low[0] = x < b.low[0] ? x : b.low[0];
        b.low[1] = y < b.low[1] ? y : b.low[1];
        b.high[0] = x > b.high[0] ? x : b.high[0];
        b.high[1] = y > b.high[1] ? y : b.high[1];
    }
    *(bounds *)sums = b;
}

static void merge_bounds(const gn_settings *settings, void *sums, const void *other)
{
    bounds *b = sums;
    const bounds *c = other;
    (void)settings;
    for (int i = 0; i < 2; i++) {
        b->low[i] = c->low[i] < b->low[i] ? c->low[i] : b->low[i];
        b->high[i] = c->high[i] > b->high[i] ? c->high[i] : b->high[i];
    }
}

static void end_bounds(gn_context *context, void *sums)
{
    const bounds *b = sums;
    gn_rectangle r = {GN_WHOLE, 0, {0, 0}, {0, 0}};
    if (b->low[0] > b->high[0]) { /* nothing is seen */
        gn_whole_plane(&context->fitting->rectangle, &context->fitting->light);
        return;
    }
    for (int i = 0; i < 2; i++) {
        r.low[i] = (int32_t)b->low[i];
        r.size[i] = (int32_t)(b->high[i] - b->low[i]) + 1;
    }
    gn_set_rectangle(context, &r);
}

const gn_fit gn_desired_view = {&gn_fit_and_warp, {bounds_bytes, clear_bounds, add_bounds, merge_bounds, end_bounds}};
