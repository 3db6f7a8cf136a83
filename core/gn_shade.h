/* What every shadow test of a row begins with: from Q to W, linear expressions of the view stepped along the row, and a
 * spot light's division. gn_shade.c says what they mean. */
#ifndef GN_SHADE_H
#define GN_SHADE_H

#include "gn_context.h"

/* W = 2^(61 - shift) / Q of a row, in place. */
void gn_row_of_w(uint32_t *q, int32_t count, uint32_t shift);

/* near / |point - light| in 2^-30 from near / w, and u, v in 2^-30 of the map. */
uint32_t gn_over_distance(uint32_t nearness, uint32_t u, uint32_t v, uint32_t tan_squared);

/* floor(w b / 2^32), b signed. */
GN_INLINE uint32_t gn_w_product(uint32_t w, uint32_t b)
{
    return (uint32_t)gn_multiply_high((int32_t)w, (int32_t)b);
}

/* The value of a linear expression at the start of a row. */
typedef struct gn_runner {
    uint32_t a, b, a_dx, b_dx;
} gn_runner;

GN_INLINE gn_runner gn_start_row(const gn_linear *l, int32_t x, int32_t y)
{
    gn_runner r;
    r.a = l->a + (uint32_t)x * l->a_dx + (uint32_t)y * l->a_dy;
    r.b = l->b + (uint32_t)x * l->b_dx + (uint32_t)y * l->b_dy;
    r.a_dx = l->a_dx;
    r.b_dx = l->b_dx;
    return r;
}

GN_INLINE uint32_t gn_step(gn_runner *r, uint32_t w)
{
    uint32_t value = r->a + gn_w_product(w, r->b);
    r->a += r->a_dx;
    r->b += r->b_dx;
    return value;
}

/* The texel of a place u or v along one axis, held to the border. */
GN_INLINE uint32_t gn_hold(uint32_t place, uint32_t bits, uint32_t last)
{
    uint32_t texel = place >> bits;
    return GN_UNLIKELY(texel > last) ? (place >> 31 ? 0 : last) : texel;
}

#define GN_NO_INDEX 0xffffffffu /* in loops that find indices: not yet */

/* The index in the map of texel number row width + column, modulo 2^32 and at most last. Where a light's box holds
 * every vertex it still may not hold every point: those of triangles that the camera sees all but edge-on lie anywhere
 * along their rays, and a pixel without a surface has any place. They take some texel, the same on every machine; where
 * rows are not padded the number is the index. */
GN_INLINE uint32_t gn_index(uint32_t column, uint32_t row, uint32_t width, uint32_t stride, uint32_t last)
{
    uint32_t number = row * width + column;
    number = number > last ? last : number;
    return GN_ROW_PADDING ? number / width * stride + number % width : number;
}

/* A depth with bits fraction bits, in units of 1/65536, as the light pass cuts it. */
GN_INLINE uint32_t gn_cut_raw(uint32_t z, uint32_t bits)
{
    return GN_DEPTH_BITS == 16 ? z >> bits : z << (16 - bits);
}

/* Lit where a depth that was cut is at most what the map holds: then the result is not negative. */
GN_INLINE uint32_t gn_compare(uint32_t z, gn_depth stored)
{
    return GN_DEPTH_BITS == 16 ? stored - z : z <= stored ? 0 : 0x80000000u;
}

/* Outside a directional light's box, that is lit; behind it, that is compared at the far end of the range. u, v, z as
 * gn_shading has them; width, height: columns and rows of the light's view. */
GN_INLINE int gn_outside_box(uint32_t bits, uint32_t width, uint32_t height, uint32_t u, uint32_t v, uint32_t z)
{
    return u >> bits >= width || v >> bits >= height || z >> 31;
}

GN_INLINE uint32_t gn_hold_depth(uint32_t z, uint32_t bits)
{
    return z >> (16 + bits) ? (0x10000u << bits) - 1 : z;
}

/* Outside a spot light's frustum, by (X + W) / 2, (Y + W) / 2 and W. */
GN_INLINE int gn_outside_frustum(const gn_shading *s, uint32_t left, uint32_t top, uint32_t w)
{
    return w - s->near_w > s->far_w - s->near_w || left >= w || top >= w;
}

/* u, v and near / w in 2^-30, from (X + W) / 2, (Y + W) / 2 and W; returns the last. */
GN_INLINE uint32_t gn_divide_place(const gn_shading *s, uint32_t *left, uint32_t *top, uint32_t w)
{
    unsigned k = gn_leading_zeros(w);
    uint32_t r = gn_reciprocal(w << k);
    *left = (uint32_t)(gn_multiply_u(*left << k, r) >> 32);
    *top = (uint32_t)(gn_multiply_u(*top << k, r) >> 32);
    uint32_t nearness = (uint32_t)(gn_multiply_u(s->near_w << k, r) >> 32);
    return nearness > 1u << 30 ? 1u << 30 : nearness;
}

/* Depth as the light pass steps it, 32 bits, from near / w in 2^-30. In short ranges the reciprocal's error exceeds the
 * guard. */
GN_INLINE uint32_t gn_spot_depth(const gn_view *light, uint32_t nearness)
{
    uint32_t z =
        GN_DEPTH_GUARD + (uint32_t)(gn_multiply_u(light->depth_scale, (1u << 30) - nearness) >> light->depth_shift);
    return 2 * (z > 0x7fffffffu ? 0x7fffffffu : z);
}

#endif
