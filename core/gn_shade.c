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
#include "gn_context.h"

/* ---- constants of a pair of camera and light ------------------------------------------------------------------- */

/* A world function before rounding: at the centre of the image, and its steps. */
typedef struct expression {
    gn_scaled a, a_dx, a_dy, b, b_dx, b_dy;
} expression;

static gn_scaled half_extent(gn_scaled centre, gn_scaled dx, gn_scaled dy, const gn_settings *settings)
{
    gn_scaled x = gn_scaled_multiply(gn_scaled_magnitude(dx), gn_scale(settings->width, -1));
    gn_scaled y = gn_scaled_multiply(gn_scaled_magnitude(dy), gn_scale(settings->height, -1));
    return gn_scaled_add(gn_scaled_magnitude(centre), gn_scaled_add(x, y));
}

static gn_scaled along(const gn_row *row, const gn_q2_30 axis[3])
{
    int64_t dot = gn_multiply(row->m[0], axis[0]) + gn_multiply(row->m[1], axis[1]) + gn_multiply(row->m[2], axis[2]);
    return gn_scale(dot, -30 - row->shift);
}

/* (row + origin) 2^exponent as a function of pixel and W. */
static expression make_expression(const gn_context *context, const gn_row *row, int64_t origin, int32_t exponent,
                                  gn_scaled w_unit)
{
    const gn_camera *camera = &context->camera;
    gn_scaled height = gn_scale(context->settings.height, 0);
    int64_t half = row->shift ? (int64_t)1 << (row->shift - 1) : 0;
    int64_t at_eye = row->offset - half + gn_multiply(row->m[0], camera->eye[0]) +
                     gn_multiply(row->m[1], camera->eye[1]) + gn_multiply(row->m[2], camera->eye[2]);
    gn_scaled zero = {0, 0}, factor = gn_scale(1, exponent);
    gn_scaled base = gn_scaled_multiply(gn_scaled_add(gn_scale(at_eye, -row->shift), gn_scale(origin, 0)), factor);
    gn_scaled forward = gn_scaled_multiply(along(row, camera->forward), factor);
    gn_scaled right = gn_scaled_multiply(along(row, camera->right), factor);
    gn_scaled up = gn_scaled_multiply(along(row, camera->up), factor);
    expression e = {base, zero, zero, zero, zero, zero};
    if (camera->projection == GN_PERSPECTIVE) {
        /* a pixel is 2 tan / height wide and high at w = 1 */
        gn_scaled pixel = gn_scaled_multiply(gn_scaled_divide(gn_scale(camera->tan_half, -23), height), w_unit);
        e.b = gn_scaled_multiply(forward, w_unit);
        e.b_dx = gn_scaled_multiply(right, pixel);
        e.b_dy = gn_scaled_negate(gn_scaled_multiply(up, pixel));
    } else {
        gn_scaled pixel = gn_scaled_divide(gn_scale(camera->half_height, 1), height);
        gn_scaled far_depth =
            gn_scaled_add(gn_scale(camera->far_depth, 0), gn_scaled_multiply(w_unit, gn_scale(1, 10)));
        e.a = gn_scaled_add(base, gn_scaled_multiply(forward, far_depth));
        e.a_dx = gn_scaled_multiply(right, pixel);
        e.a_dy = gn_scaled_negate(gn_scaled_multiply(up, pixel));
        e.b = gn_scaled_negate(gn_scaled_multiply(forward, w_unit));
    }
    return e;
}

static expression half_sum(expression x, expression y)
{
    gn_scaled half = gn_scale(1, -1);
    expression e;
    e.a = gn_scaled_multiply(gn_scaled_add(x.a, y.a), half);
    e.a_dx = gn_scaled_multiply(gn_scaled_add(x.a_dx, y.a_dx), half);
    e.a_dy = gn_scaled_multiply(gn_scaled_add(x.a_dy, y.a_dy), half);
    e.b = gn_scaled_multiply(gn_scaled_add(x.b, y.b), half);
    e.b_dx = gn_scaled_multiply(gn_scaled_add(x.b_dx, y.b_dx), half);
    e.b_dy = gn_scaled_multiply(gn_scaled_add(x.b_dy, y.b_dy), half);
    return e;
}

/* Most fraction bits with |a| <= 2^30 and |b| 2^32 <= 2^30 over the image. */
static int32_t fraction_bits(const expression *e, const gn_settings *settings, int32_t most)
{
    int32_t a = 30 - gn_scaled_bits(half_extent(e->a, e->a_dx, e->a_dy, settings));
    int32_t b = -2 - gn_scaled_bits(half_extent(e->b, e->b_dx, e->b_dy, settings));
    most = a < most ? a : most;
    return b < most ? b : most;
}

/* Steps are rounded once; the value is exact at the centre of the image, so steps err by half the image at most. */
static uint32_t round_affine(gn_scaled centre, gn_scaled dx, gn_scaled dy, int32_t exponent,
                             const gn_settings *settings, uint32_t *step_x, uint32_t *step_y)
{
    int64_t x = gn_scaled_round(dx, exponent), y = gn_scaled_round(dy, exponent);
    *step_x = (uint32_t)x;
    *step_y = (uint32_t)y;
    int64_t to_corner = x * (settings->width - 1) + y * (settings->height - 1);
    return (uint32_t)(gn_scaled_round(centre, exponent) - gn_floor_shift_64(to_corner, 1));
}

static gn_linear round_expression(const expression *e, int32_t bits, const gn_settings *settings)
{
    gn_linear l;
    l.a = round_affine(e->a, e->a_dx, e->a_dy, -bits, settings, &l.a_dx, &l.a_dy);
    l.b = round_affine(e->b, e->b_dx, e->b_dy, -bits - 32, settings, &l.b_dx, &l.b_dy);
    return l;
}

/* World units a unit of W: perspective: near 2^w_shift / 2^31; orthographic: of Q. */
static gn_scaled make_w_unit(gn_context *context, int32_t largest_w)
{
    const gn_view *view = &context->camera_view;
    gn_shading *shading = &context->shading;
    shading->w_shift = 0;
    if (view->affine) {
        int32_t range = context->camera.far_depth - context->camera.near_depth;
        return gn_scaled_divide(gn_scale(range, 0), gn_scale((1 << 30) - (1 << 10), 0));
    }
    /* W stays below 2^31 up to the farthest visible point, with 1/64 to spare for the rounding of Q. */
    int64_t farthest = largest_w < view->far_w ? largest_w : view->far_w;
    farthest += farthest / 64 + 1;
    while ((int64_t)view->near_w << shading->w_shift <= farthest)
        shading->w_shift++;
    return gn_scaled_divide(gn_scale(view->near_w, shading->w_shift - 31), view->unit);
}

gn_status gn_make_shading(gn_context *context, int32_t largest_w)
{
    const gn_view *light = &context->light_view;
    const gn_settings *settings = &context->settings;
    gn_shading *shading = &context->shading;
    gn_scaled w_unit = make_w_unit(context, largest_w);
    expression e[3];
    shading->trusted = context->light_trusted;
    if (light->affine) {
        e[0] = make_expression(context, &light->row[0], light->centre_x, -8, w_unit);
        e[1] = make_expression(context, &light->row[1], light->centre_y, -8, w_unit);
        e[2] = make_expression(context, &light->row[2], light->near_w, -15, w_unit);
        int32_t position = fraction_bits(&e[1], settings, fraction_bits(&e[0], settings, 18));
        int32_t depth = fraction_bits(&e[2], settings, 14);
        if (position < 0 || depth < 0)
            return GN_OUT_OF_RANGE;
        shading->position_bits = (uint8_t)position;
        shading->depth_bits = (uint8_t)depth;
        shading->coordinate[0] = round_expression(&e[0], position, settings);
        shading->coordinate[1] = round_expression(&e[1], position, settings);
        shading->coordinate[2] = round_expression(&e[2], depth, settings);
        return GN_OK;
    }
    e[2] = make_expression(context, &light->row[2], 0, 0, w_unit);
    e[0] = half_sum(make_expression(context, &light->row[0], 0, 0, w_unit), e[2]);
    e[1] = half_sum(make_expression(context, &light->row[1], 0, 0, w_unit), e[2]);
    int32_t bits = 8;
    for (int i = 0; i < 3; i++)
        bits = fraction_bits(&e[i], settings, bits);
    for (int i = 0; i < 3; i++)
        shading->coordinate[i] = round_expression(&e[i], bits, settings);
    int64_t near_w = gn_scaled_round(gn_scale(light->near_w, 0), -bits);
    int64_t far_w = gn_scaled_round(gn_scale(light->far_w, 0), -bits);
    if (near_w < 1 || near_w > 0x7fffffff)
        return GN_OUT_OF_RANGE;
    shading->near_w = (uint32_t)near_w;
    shading->far_w = far_w > 0x7fffffff ? 0x7fffffffu : (uint32_t)far_w;
    return GN_OK;
}

void gn_make_falloff(gn_context *context)
{
    gn_scaled tangent = gn_scale(context->light.kind == GN_SPOT ? context->light.tan_half : 0, -24);
    gn_scaled squared = gn_scaled_multiply(tangent, tangent);
    for (int32_t i = 0; i < GN_FALLOFF_STEPS + 2; i++) {
        gn_scaled s = gn_scaled_add(gn_scale(1, 0), gn_scaled_multiply(squared, gn_scale(2 * i, -6)));
        uint64_t inverse = (uint64_t)gn_scaled_round(gn_scaled_divide(gn_scale(1, 60), s), 0);
        context->falloff[i] = (uint16_t)(gn_square_root(inverse) >> 15);
    }
}

/* ---- rows ------------------------------------------------------------------------------------------------------ */

/* W = 2^(61 - shift) / Q, below 2^31 for every surface; without a surface (Q = 1) any value. */
static void row_of_w(uint32_t *q, int32_t count, uint32_t shift)
{
    for (int32_t i = 0; i < count; i++) {
        unsigned k = gn_leading_zeros(q[i]);
        q[i] = gn_reciprocal(q[i] << k) >> ((1 + shift - k) & 31u);
    }
}

GN_INLINE uint32_t product(uint32_t w, uint32_t b)
{
    return (uint32_t)gn_multiply_high((int32_t)w, (int32_t)b);
}

/* The value of a linear expression at the start of a row. */
typedef struct runner {
    uint32_t a, b, a_dx, b_dx;
} runner;

GN_INLINE runner start(const gn_linear *l, int32_t x, int32_t y)
{
    runner r;
    r.a = l->a + (uint32_t)x * l->a_dx + (uint32_t)y * l->a_dy;
    r.b = l->b + (uint32_t)x * l->b_dx + (uint32_t)y * l->b_dy;
    r.a_dx = l->a_dx;
    r.b_dx = l->b_dx;
    return r;
}

/* One of a and b is constant along the row: which one is known where this is inlined. */
GN_INLINE uint32_t next(runner *r, uint32_t w, int orthographic)
{
    uint32_t value = r->a + product(w, r->b);
    if (orthographic)
        r->a += r->a_dx;
    else
        r->b += r->b_dx;
    return value;
}

/* The value at the i-th pixel after the start. */
GN_INLINE uint32_t at(const runner *r, int32_t i, uint32_t w, int orthographic)
{
    if (orthographic)
        return r->a + (uint32_t)i * r->a_dx + product(w, r->b);
    return r->a + product(w, r->b + (uint32_t)i * r->b_dx);
}

/* Depth in units of 1/65536 with bits fraction bits, cut as the light pass cuts it. */
GN_INLINE gn_depth cut_depth(uint32_t z, uint32_t bits)
{
#if GN_DEPTH_BITS == 16
    return (gn_depth)(z >> bits);
#else
    return z << (16 - bits);
#endif
}

/* What a row's look-up needs, kept in registers. */
typedef struct lookup {
    const gn_depth *map;
    uint32_t stride, last_column, last_row, position_bits, depth_bits;
} lookup;

GN_INLINE lookup make_lookup(const gn_context *context)
{
    lookup l = {context->map,
                context->map_stride,
                context->settings.map_width - 1u,
                context->settings.map_height - 1u,
                context->shading.position_bits,
                context->shading.depth_bits};
    return l;
}

/* The texel's index. *lit: 1 where an untrusted point lies outside the box: lit; behind it: compared at the far end. */
GN_INLINE uint32_t find_texel(const lookup *l, uint32_t u, uint32_t v, uint32_t *depth, uint32_t *lit, int trusted)
{
    uint32_t column = u >> l->position_bits, row = v >> l->position_bits;
    *lit = 0;
    if (!trusted) {
        *lit = (column > l->last_column) | (row > l->last_row) | (*depth >> 31);
        *depth = *depth >> (16 + l->depth_bits) ? (0x10000u << l->depth_bits) - 1 : *depth;
    }
    /* Inside the box this changes nothing; it keeps pixels without a surface inside the map. */
    column = column > l->last_column ? l->last_column : column;
    row = row > l->last_row ? l->last_row : row;
    return row * l->stride + column;
}

#if GN_VECTOR
/* In stages over short blocks, so that all but the look-up itself runs in vectors. */
GN_INLINE void shade_directional(const gn_context *context, uint32_t *q, int32_t x, int32_t y, int32_t count,
                                 int orthographic, int trusted)
{
    enum { BLOCK = 128 };
    uint32_t texel[BLOCK], depth[BLOCK];
    const gn_linear *c = context->shading.coordinate;
    lookup l = make_lookup(context);
    for (int32_t from = 0; from < count; from += BLOCK, q += BLOCK) {
        int32_t n = count - from < BLOCK ? count - from : BLOCK;
        runner u = start(&c[0], x + from, y), v = start(&c[1], x + from, y), z = start(&c[2], x + from, y);
        for (int32_t i = 0; i < n; i++) {
            uint32_t w = q[i], d = at(&z, i, w, orthographic), lit;
            texel[i] = find_texel(&l, at(&u, i, w, orthographic), at(&v, i, w, orthographic), &d, &lit, trusted);
            depth[i] = cut_depth(d, l.depth_bits);
            q[i] = lit;
        }
        for (int32_t i = 0; i < n; i++)
            q[i] |= depth[i] <= l.map[texel[i]];
    }
}
#else
GN_INLINE void shade_directional(const gn_context *context, uint32_t *q, int32_t x, int32_t y, int32_t count,
                                 int orthographic, int trusted)
{
    const gn_linear *c = context->shading.coordinate;
    runner u = start(&c[0], x, y), v = start(&c[1], x, y), z = start(&c[2], x, y);
    lookup l = make_lookup(context);
    for (int32_t i = 0; i < count; i++) {
        uint32_t w = q[i], lit, depth = next(&z, w, orthographic), column = next(&u, w, orthographic);
        uint32_t texel = find_texel(&l, column, next(&v, w, orthographic), &depth, &lit, trusted);
        q[i] = lit | (cut_depth(depth, l.depth_bits) <= l.map[texel]);
    }
}
#endif

GN_INLINE void shade_spot(const gn_context *context, uint32_t *q, int32_t x, int32_t y, int32_t count, int orthographic)
{
    const gn_shading *s = &context->shading;
    const gn_view *light = &context->light_view;
    runner u = start(&s->coordinate[0], x, y), v = start(&s->coordinate[1], x, y), d = start(&s->coordinate[2], x, y);
    uint32_t width = context->settings.map_width, height = context->settings.map_height;
    for (int32_t i = 0; i < count; i++) {
        uint32_t w = q[i];
        uint32_t left = next(&u, w, orthographic), top = next(&v, w, orthographic),
                 distance = next(&d, w, orthographic);
        q[i] = 0;
        if (distance - s->near_w > s->far_w - s->near_w || left >= distance || top >= distance)
            continue; /* outside the frustum: unlit */
        unsigned k = gn_leading_zeros(distance);
        uint32_t r = gn_reciprocal(distance << k);
        /* u, v and near / w in 2^-30 */
        left = (uint32_t)(gn_multiply_u(left << k, r) >> 32);
        top = (uint32_t)(gn_multiply_u(top << k, r) >> 32);
        uint32_t nearness = (uint32_t)(gn_multiply_u(s->near_w << k, r) >> 32);
        nearness = nearness > 1u << 30 ? 1u << 30 : nearness;
        uint32_t column = (uint32_t)(gn_multiply_u(left, width << 2) >> 32);
        uint32_t row = (uint32_t)(gn_multiply_u(top, height << 2) >> 32);
        column = column >= width ? width - 1 : column;
        row = row >= height ? height - 1 : row;
        uint32_t z =
            GN_DEPTH_GUARD + (uint32_t)(gn_multiply_u(light->depth_scale, (1u << 30) - nearness) >> light->depth_shift);
        if ((gn_depth)((2 * z) >> (32 - GN_DEPTH_BITS)) > context->map[row * context->map_stride + column])
            continue;
        /* near / |point - light| = near / w / sqrt(1 + tan^2 (u^2 + v^2)) */
        int32_t du = (int32_t)(left >> 14) - (1 << 15), dv = (int32_t)(top >> 14) - (1 << 15);
        uint32_t squared = (uint32_t)(du * du) + (uint32_t)(dv * dv);
        const uint16_t *f = &context->falloff[squared >> 25];
        uint32_t falloff = f[0] - (((uint32_t)(f[0] - f[1]) * (squared >> 10 & 0x7fffu)) >> 15);
        q[i] = (uint32_t)(gn_multiply_u(nearness, falloff) >> 15) | 1u;
    }
}

void gn_shade_row(const gn_context *context, uint32_t *q, int32_t x, int32_t y, int32_t count)
{
    int orthographic = context->camera_view.affine;
    if (!orthographic)
        row_of_w(q, count, context->shading.w_shift);
    if (context->light.kind == GN_SPOT) {
        if (orthographic)
            shade_spot(context, q, x, y, count, 1);
        else
            shade_spot(context, q, x, y, count, 0);
    } else if (context->shading.trusted) {
        if (orthographic)
            shade_directional(context, q, x, y, count, 1, 1);
        else
            shade_directional(context, q, x, y, count, 0, 1);
    } else {
        if (orthographic)
            shade_directional(context, q, x, y, count, 1, 0);
        else
            shade_directional(context, q, x, y, count, 0, 0);
    }
}
