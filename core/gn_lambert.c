/* The two colours of a triangle, lit and unlit: flat Lambert shading with ambient light, two-sided.
 *
 * colour = c (ambient + (1 - ambient) max(N.L, 0) lit). A triangle is lit where camera and light are on the same side
 * of its plane, decided exactly; otherwise it is shadowed before any look-up counts. For a spot light only what is
 * constant on the plane is made here: h, the light's distance from it, of N.L = h / |point - light|. */
#include "gn_lambert.h"

uint32_t gn_intensity(const gn_context *context, uint32_t cosine)
{
    uint32_t ambient = context->scene->ambient + (context->scene->ambient >> 15u);
    cosine = cosine > 0x10000u ? 0x10000u : cosine;
    return ambient + (uint32_t)((gn_multiply_u(0x10000u - ambient, cosine) + 0x8000u) >> 16);
}

uint32_t gn_pack(gn_rgb c, uint32_t intensity, uint8_t format)
{
    uint32_t r = c.r * intensity, g = c.g * intensity, b = c.b * intensity;
    if (format == GN_RGB565) {
        uint32_t half = 255u << 15, one = 255u << 16;
        return ((r * 31 + half) / one) << 11 | ((g * 63 + half) / one) << 5 | (b * 31 + half) / one;
    }
    return (r + 0x8000u) >> 16 | ((g + 0x8000u) >> 16) << 8 | ((b + 0x8000u) >> 16) << 16;
}

/* n scaled to components below 2^30, the largest at least 2^29. n != 0. */
static void normalise(int32_t out[3], const int64_t n[3])
{
    uint64_t largest = 0;
    for (int i = 0; i < 3; i++) {
        uint64_t m = n[i] < 0 ? 0u - (uint64_t)n[i] : (uint64_t)n[i];
        largest = m > largest ? m : largest;
    }
    int32_t excess = 34 - (int32_t)gn_leading_zeros_64(largest);
    for (int i = 0; i < 3; i++)
        out[i] = (int32_t)(excess > 0 ? gn_floor_shift_64(n[i], (unsigned)excess) : n[i] * ((int64_t)1 << -excess));
}

GN_INLINE uint64_t magnitude_dot(const int32_t n[3], const int32_t v[3])
{
    int64_t dot = gn_multiply(n[0], v[0]) + gn_multiply(n[1], v[1]) + gn_multiply(n[2], v[2]);
    return dot < 0 ? 0u - (uint64_t)dot : (uint64_t)dot;
}

void gn_make_pair(const gn_context *context, gn_colour_pair *pair, uint32_t triangle)
{
    uint8_t format = context->settings.format;
    pair->triangle = triangle;
    pair->distance = 0;
    pair->distance_shift = 0;
    pair->faces_light = 0;
    if (triangle == GN_NO_TRIANGLE) {
        pair->lit = pair->unlit = gn_pack(context->scene->background, 0x10000u, format);
        return;
    }
    const gn_object *object = &context->scene->objects[triangle >> context->triangle_bits];
    const gn_light *light = &context->light;
    int32_t world[3][3], to_light[3], unit[3];
    int64_t n[3];
    (void)gn_triangle_world(object, triangle & (((uint32_t)1 << context->triangle_bits) - 1), world);
    gn_normal(n, world);
    pair->lit = pair->unlit = gn_pack(object->colour, gn_intensity(context, 0), format);
    if (!gn_seen_lit(context, n, world[0]))
        return;
    gn_to_light(to_light, light, world[0]);
    pair->faces_light = 1;
    normalise(unit, n);
    uint32_t length = gn_square_root(magnitude_dot(unit, unit));
    uint64_t dot = magnitude_dot(unit, to_light);
    if (light->kind == GN_DIRECTIONAL) {
        uint32_t cosine = gn_divide(dot >> 14, length);
        pair->lit = gn_pack(object->colour, gn_intensity(context, cosine), format);
        pair->distance = cosine > 0x10000u ? 0x10000u : cosine;
        return;
    }
    /* N.L = h / near times near / |point - light|: of 2^-30 into 2^-16 */
    gn_scaled h = gn_scaled_divide(gn_scale((int64_t)dot, 0),
                                   gn_scaled_multiply(gn_scale(length, 0), gn_scale(light->near_depth, 0)));
    if (h.m == 0 || h.e < 14 - 63)
        return;
    GN_ASSERT(h.e <= 14); /* h <= 2^29, near >= 1 */
    pair->distance = (uint32_t)h.m;
    pair->distance_shift = (uint8_t)(14 - h.e);
}
