/* The shadow test of a row of pixels: from (x, y, Q) to light space by linear expressions of the view, then one
 * look-up.
 *
 * For a perspective camera at E a visible point is P = E + w d(x, y), with d affine in the pixel and w ~ 1/Q. A light
 * coordinate of a directional light is affine in P, hence a + w b(x, y) with a constant and b affine: the same for
 * every triangle, so shading needs no record of the triangle. An orthographic camera stores linear depth and swaps the
 * parts: a(x, y) + Q b. A spot light takes the same three expressions and one more reciprocal; its depth is affine in
 * that reciprocal. Error bounds: docs/number-formats.md.
 *
 * Cost: one reciprocal and three high products a pixel (spot: two and six). Lit where z <= stored: ties are lit. */
#include "gn_shade.h"

/* W = 2^(61 - shift) / Q, at most 2^31: Q is at least 2^(30 - shift), which is what a pixel without a surface holds. */
void gn_row_of_w(uint32_t *q, int32_t count, uint32_t shift)
{
    for (int32_t i = 0; i < count; i++) {
        unsigned k = gn_leading_zeros(q[i]);
        q[i] = gn_reciprocal(q[i] << k) >> (1 + shift - k);
    }
}

/* What a row's look-up needs, kept in registers. */
typedef struct lookup {
    const gn_depth *map;
    uint32_t width, height, stride, last, position_bits, depth_bits;
} lookup;

GN_INLINE lookup make_lookup(const gn_context *context)
{
    uint32_t width = context->settings.map_width, height = context->settings.map_height;
    lookup l = {context->map,
                width,
                height,
                context->map_stride,
                width * height - 1,
                context->shading.position_bits,
                context->shading.depth_bits};
    return l;
}

/* The texel's index. */
GN_INLINE uint32_t find_texel(const lookup *l, uint32_t u, uint32_t v)
{
    uint32_t column = u >> l->position_bits, row = v >> l->position_bits;
    if (GN_ROW_PADDING && GN_LIKELY(column < l->width && row < l->height))
        return row * l->stride + column;
    return gn_index(column, row, l->width, l->stride, l->last);
}

/* A light's box that need not hold every point. */
GN_INLINE uint32_t test_box(const lookup *l, uint32_t u, uint32_t v, uint32_t depth)
{
    return gn_outside_box(l->position_bits, l->width, l->height, u, v, depth) ? 0 : gn_hold_depth(depth, l->depth_bits);
}

/* Any camera, any box. */
static void shade_directional(const gn_context *context, uint32_t *q, int32_t x, int32_t y, int32_t count)
{
    const gn_linear *c = context->shading.coordinate;
    gn_runner u = gn_start_row(&c[0], x, y), v = gn_start_row(&c[1], x, y), z = gn_start_row(&c[2], x, y);
    lookup l = make_lookup(context);
    for (int32_t i = 0; i < count; i++) {
        uint32_t w = q[i], depth = gn_step(&z, w), column = gn_step(&u, w), row = gn_step(&v, w);
        if (!context->shading.trusted)
            depth = test_box(&l, column, row, depth);
        q[i] = gn_compare(gn_cut_raw(depth, l.depth_bits), l.map[find_texel(&l, column, row)]);
    }
}

/* Perspective, and every point of the scene inside the box: the common case, with only what it needs. */
#if GN_VECTOR
/* In stages over short blocks, so that all but the look-up itself runs in vectors. */
static void shade_trusted(const gn_context *context, uint32_t *q, int32_t x, int32_t y, int32_t count)
{
    enum { BLOCK = 128 };
    uint32_t texel[BLOCK], depth[BLOCK];
    const gn_linear *c = context->shading.coordinate;
    lookup l = make_lookup(context);
    for (int32_t from = 0; from < count; from += BLOCK, q += BLOCK) {
        int32_t n = count - from < BLOCK ? count - from : BLOCK;
        gn_runner u = gn_start_row(&c[0], x + from, y), v = gn_start_row(&c[1], x + from, y),
                  z = gn_start_row(&c[2], x + from, y);
        for (int32_t i = 0; i < n; i++) {
            uint32_t w = q[i], step = (uint32_t)i;
            uint32_t column = (u.a + gn_w_product(w, u.b + step * u.b_dx)) >> l.position_bits;
            uint32_t row = (v.a + gn_w_product(w, v.b + step * v.b_dx)) >> l.position_bits;
            texel[i] = column < l.width && row < l.height ? row * l.stride + column : GN_NO_INDEX;
            depth[i] = z.a + gn_w_product(w, z.b + step * z.b_dx);
        }
        for (int32_t i = 0; i < n; i++) {
            if (GN_UNLIKELY(texel[i] == GN_NO_INDEX)) {
                uint32_t place_u = u.a + gn_w_product(q[i], u.b + (uint32_t)i * u.b_dx);
                texel[i] = find_texel(&l, place_u, v.a + gn_w_product(q[i], v.b + (uint32_t)i * v.b_dx));
            }
            q[i] = gn_compare(gn_cut_raw(depth[i], l.depth_bits), l.map[texel[i]]);
        }
    }
}
#else
static void shade_trusted(const gn_context *context, uint32_t *q, int32_t x, int32_t y, int32_t count)
{
    const gn_linear *c = context->shading.coordinate;
    gn_runner u = gn_start_row(&c[0], x, y), v = gn_start_row(&c[1], x, y), z = gn_start_row(&c[2], x, y);
    lookup l = make_lookup(context);
    for (uint32_t *end = q + count; q != end; q++) {
        uint32_t w = *q, texel = find_texel(&l, u.a + gn_w_product(w, u.b), v.a + gn_w_product(w, v.b));
        *q = gn_compare(gn_cut_raw(z.a + gn_w_product(w, z.b), l.depth_bits), l.map[texel]);
        u.b += u.b_dx;
        v.b += v.b_dx;
        z.b += z.b_dx;
    }
}
#endif

/* 1 / sqrt(i / 64) for i = 16 .. 64, 14 fraction bits: 2^14 sqrt(64 / i), rounded. */
static const uint16_t inverse_root[49] = {32768, 31790, 30894, 30070, 29309, 28602, 27945, 27330, 26755, 26214,
                                          25705, 25225, 24770, 24339, 23930, 23541, 23170, 22817, 22479, 22155,
                                          21845, 21548, 21263, 20988, 20724, 20470, 20225, 19988, 19760, 19539,
                                          19326, 19119, 18919, 18725, 18536, 18354, 18176, 18004, 17837, 17674,
                                          17515, 17361, 17211, 17064, 16921, 16782, 16646, 16514, 16384};

/* near / |point - light| in 2^-30: nearness / sqrt(s), s = 1 + tan^2 (x^2 + y^2) with x, y in -1 .. 1 across the map.
 * The root is interpolated between 48 values; relative error 2^-11. */
uint32_t gn_over_distance(uint32_t nearness, uint32_t u, uint32_t v, uint32_t tan_squared)
{
    int32_t x = (int32_t)(u >> 14) - (1 << 15), y = (int32_t)(v >> 14) - (1 << 15);
    uint32_t squared = (uint32_t)(x * x) + (uint32_t)(y * y); /* 2^30 = 1 */
    uint32_t s = (1u << 18) + ((uint32_t)(gn_multiply_u(squared, tan_squared) >> 32) << 1);
    unsigned even = gn_leading_zeros(s) & ~1u;
    s <<= even; /* in [2^30, 2^32), that is 2^(32 + even - 14) s / 2^18 */
    const uint16_t *root = &inverse_root[(s >> 26) - 16];
    uint32_t inverse = root[0] - (((uint32_t)(root[0] - root[1]) * (s >> 10 & 0xffffu)) >> 16);
    return (uint32_t)(gn_multiply_u(nearness, inverse) >> (21 - even / 2));
}

static void shade_spot(const gn_context *context, uint32_t *q, int32_t x, int32_t y, int32_t count)
{
    const gn_shading *s = &context->shading;
    const gn_view *light = &context->light_view;
    gn_runner u = gn_start_row(&s->coordinate[0], x, y), v = gn_start_row(&s->coordinate[1], x, y),
              d = gn_start_row(&s->coordinate[2], x, y);
    uint32_t width = context->settings.map_width, height = context->settings.map_height;
    for (int32_t i = 0; i < count; i++) {
        uint32_t w = q[i], left = gn_step(&u, w), top = gn_step(&v, w), distance = gn_step(&d, w);
        q[i] = 0x80000000u;
        if (gn_outside_frustum(s, left, top, distance))
            continue; /* unlit */
        uint32_t nearness = gn_divide_place(s, &left, &top, distance);
        uint32_t column = (uint32_t)(gn_multiply_u(left, width << 2) >> 32);
        uint32_t row = (uint32_t)(gn_multiply_u(top, height << 2) >> 32);
        column = column >= width ? width - 1 : column;
        row = row >= height ? height - 1 : row;
        uint32_t z = gn_spot_depth(light, nearness);
        if ((gn_depth)(z >> (32 - GN_DEPTH_BITS)) > context->map[row * context->map_stride + column])
            continue;
        q[i] = gn_over_distance(nearness, left, top, context->tan_squared);
    }
}

void gn_shade_row(const gn_context *context, uint32_t *q, int32_t x, int32_t y, int32_t count)
{
    int perspective = !context->camera_view.affine;
    if (perspective)
        gn_row_of_w(q, count, context->shading.w_shift);
    if (context->light.kind == GN_SPOT)
        shade_spot(context, q, x, y, count);
    else if (perspective && context->shading.trusted)
        shade_trusted(context, q, x, y, count);
    else
        shade_directional(context, q, x, y, count);
}

void gn_falloff_row(const gn_context *context, uint32_t *q, int32_t x, int32_t y, int32_t count)
{
    const gn_shading *s = &context->shading;
    if (!context->camera_view.affine)
        gn_row_of_w(q, count, s->w_shift);
    gn_runner u = gn_start_row(&s->coordinate[0], x, y), v = gn_start_row(&s->coordinate[1], x, y),
              d = gn_start_row(&s->coordinate[2], x, y);
    for (int32_t i = 0; i < count; i++) {
        uint32_t w = q[i], left = gn_step(&u, w), top = gn_step(&v, w), distance = gn_step(&d, w);
        /* what rounding moves out of the frustum, and pixels without a surface */
        distance = distance - s->near_w > s->far_w - s->near_w ? s->near_w : distance;
        left = left > distance ? distance : left;
        top = top > distance ? distance : top;
        uint32_t nearness = gn_divide_place(s, &left, &top, distance);
        q[i] = gn_over_distance(nearness, left, top, context->tan_squared);
    }
}
