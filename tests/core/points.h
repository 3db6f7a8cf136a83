/* A pixel's point in light space by definition (docs/number-formats.md): what the stages of the camera pass find in
 * blocks, in place, or in one with a vote, here one pixel at a time in 64 bits. */
#ifndef POINTS_H
#define POINTS_H

#include "gn_shade.h"
#include "tap.h"

typedef enum where { BESIDE_LIT, BESIDE_SHADOWED, ON_MAP } where;

typedef struct point {
    where where;
    int64_t u, v; /* texels with bits fraction bits */
    int bits;
    uint32_t z; /* 32 bits */
    int beside; /* 1: on its ray but not on its triangle, and beyond the depths of a box that holds all vertices */
} point;

/* a + floor(w b / 2^32), a and b being affine in the pixel, modulo 2^32. */
static uint32_t expression_at(const gn_linear *l, int32_t x, int32_t y, uint32_t w)
{
    uint32_t a = l->a + (uint32_t)x * l->a_dx + (uint32_t)y * l->a_dy;
    uint32_t b = l->b + (uint32_t)x * l->b_dx + (uint32_t)y * l->b_dy;
    int64_t product = (int64_t)(int32_t)w * (int32_t)b, quotient = product / 4294967296;
    quotient -= product < quotient * 4294967296;
    return a + (uint32_t)quotient;
}

/* Columns (or rows) that points count in: the map's, or a warped map's fine ones. */
static int64_t fine_size(const gn_context *context, int32_t size)
{
    return context->grid ? GN_FINE : size;
}

static point find_spot_point(const gn_context *context, const uint32_t value[3])
{
    const gn_shading *s = &context->shading;
    point p = {BESIDE_SHADOWED, 0, 0, 18, 0, 0};
    uint32_t left = value[0], top = value[1];
    if (value[2] < s->near_w || value[2] > s->far_w || left >= value[2] || top >= value[2])
        return p;
    uint32_t nearness = gn_divide_place(s, &left, &top, value[2]);
    p.where = ON_MAP; /* its width and height are 2^30 */
    p.u = (int64_t)((uint64_t)left * (uint64_t)fine_size(context, context->settings.map_width) / 4096);
    p.v = (int64_t)((uint64_t)top * (uint64_t)fine_size(context, context->settings.map_height) / 4096);
    uint64_t behind = ((UINT64_C(1) << 30) - nearness) * context->light_view.depth_scale;
    uint64_t z = GN_DEPTH_GUARD + (behind >> context->light_view.depth_shift);
    p.z = z > 0x7fffffff ? 0xfffffffeu : (uint32_t)(2 * z);
    return p;
}

static point find_sun_point(const gn_context *context, const uint32_t value[3])
{
    const gn_shading *s = &context->shading;
    const gn_settings *settings = &context->settings;
    point p = {ON_MAP, 0, 0, s->position_bits < 8 ? 8 : s->position_bits, 0, 0};
    uint64_t range = UINT64_C(65536) << s->depth_bits, z = value[2];
    for (int i = 0; i < 2; i++) {
        /* negative: where no box is tested, rounding may bring it before the map */
        int64_t place = value[i] >> 31 ? (int64_t)value[i] - 4294967296 : value[i];
        *(i ? &p.v : &p.u) = place * ((int64_t)1 << (p.bits - s->position_bits));
    }
    p.beside = s->trusted && z >= range;
    if (!s->trusted) {
        if (p.u < 0 || p.v < 0 || value[2] >> 31 || p.u >= fine_size(context, settings->map_width) << p.bits ||
            p.v >= fine_size(context, settings->map_height) << p.bits)
            p.where = BESIDE_LIT;
        else if (z >= range) /* behind the box */
            z = range - 1;
    }
    p.z = (uint32_t)(z << (16 - s->depth_bits));
    return p;
}

/* The point of pixel (x, y) whose Q is q. */
static TAP_UNUSED point find_point(const gn_context *context, int32_t x, int32_t y, uint32_t q)
{
    uint32_t w = q, value[3];
    if (!context->camera_view.affine)
        gn_row_of_w(&w, 1, context->shading.w_shift);
    for (int i = 0; i < 3; i++)
        value[i] = expression_at(&context->shading.coordinate[i], x, y, w);
    return context->light.kind == GN_SPOT ? find_spot_point(context, value) : find_sun_point(context, value);
}

#endif
