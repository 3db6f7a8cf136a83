/* Colours: flat Lambert shading with ambient light, two-sided, and the mask.
 *
 * colour = c (ambient + (1 - ambient) max(N.L, 0) lit). A triangle is lit where camera and light are on the same side
 * of its plane, decided exactly; otherwise it is shadowed before any look-up counts. With a directional light a
 * triangle has two colours, lit and unlit, made when a region first sees it and kept in a small cache. With a spot
 * light N.L = h / |point - light|, h being the light's distance from the plane: one product a pixel. */
#include "gn_context.h"

void gn_clear_colours(gn_worker *worker)
{
    for (uint32_t i = 0; i < GN_COLOUR_CACHE; i++)
        worker->colours[i].triangle = GN_NO_TRIANGLE;
}

/* Sign of n . v, exactly: |n| < 2^53, |v| <= 2^30. */
static int dot_sign(const int64_t n[3], const int32_t v[3])
{
    int64_t high = 0, low = 0;
    for (int i = 0; i < 3; i++) {
        high += gn_floor_shift_64(n[i], 26) * v[i];
        low += (n[i] & 0x3ffffff) * v[i];
    }
    high += gn_floor_shift_64(low, 26);
    return high < 0 ? -1 : high > 0 || (low & 0x3ffffff) ? 1 : 0;
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

/* ambient + (1 - ambient) cosine, all 2^16 = 1. */
GN_INLINE uint32_t intensity(const gn_context *context, uint32_t cosine)
{
    uint32_t ambient = context->scene->ambient + (context->scene->ambient >> 15u);
    cosine = cosine > 0x10000u ? 0x10000u : cosine;
    return ambient + (uint32_t)((gn_multiply_u(0x10000u - ambient, cosine) + 0x8000u) >> 16);
}

/* A colour at an intensity, as it is written to the image. */
GN_INLINE uint32_t pack(gn_rgb c, uint32_t intensity, uint8_t format)
{
    uint32_t r = c.r * intensity, g = c.g * intensity, b = c.b * intensity;
    if (format == GN_RGB565) {
        uint32_t half = 255u << 15, one = 255u << 16;
        return ((r * 31 + half) / one) << 11 | ((g * 63 + half) / one) << 5 | (b * 31 + half) / one;
    }
    return (r + 0x8000u) >> 16 | ((g + 0x8000u) >> 16) << 8 | ((b + 0x8000u) >> 16) << 16;
}

static void make_pair(const gn_context *context, gn_colour_pair *pair, uint32_t triangle)
{
    uint8_t format = context->settings.format;
    pair->triangle = triangle;
    pair->distance = 0;
    pair->distance_shift = 0;
    pair->faces_light = 0;
    if (triangle == GN_NO_TRIANGLE) {
        pair->lit = pair->unlit = pack(context->scene->background, 0x10000u, format);
        return;
    }
    const gn_object *object = &context->scene->objects[triangle >> context->triangle_bits];
    const gn_light *light = &context->light;
    const gn_camera *camera = &context->camera;
    uint32_t index[3];
    int32_t p[3][3], to_camera[3], to_light[3], unit[3];
    int64_t n[3];
    gn_triangle_indices(object->mesh, triangle & (((uint32_t)1 << context->triangle_bits) - 1), index);
    for (int i = 0; i < 3; i++)
        (void)gn_world_position(object, index[i], p[i]);
    for (int i = 0; i < 3; i++) {
        int j = i < 2 ? i + 1 : 0, k = 3 - i - j;
        n[i] = gn_multiply(p[1][j] - p[0][j], p[2][k] - p[0][k]) - gn_multiply(p[1][k] - p[0][k], p[2][j] - p[0][j]);
        to_camera[i] = camera->projection == GN_PERSPECTIVE ? camera->eye[i] - p[0][i] : -camera->forward[i];
        to_light[i] = light->kind == GN_SPOT ? light->position[i] - p[0][i] : -light->forward[i];
    }
    pair->lit = pair->unlit = pack(object->colour, intensity(context, 0), format);
    int side = dot_sign(n, to_light);
    if (side == 0 || side != dot_sign(n, to_camera))
        return;
    pair->faces_light = 1;
    normalise(unit, n);
    uint32_t length = gn_square_root(magnitude_dot(unit, unit));
    uint64_t dot = magnitude_dot(unit, to_light);
    if (light->kind == GN_DIRECTIONAL) {
        uint32_t cosine = gn_divide(dot >> 14, length);
        pair->lit = pack(object->colour, intensity(context, cosine), format);
        return;
    }
    /* h / near = distance 2^(-18 - shift) near / |point - light| in 2^-30 */
    gn_scaled h = gn_scaled_divide(gn_scale((int64_t)dot, 0),
                                   gn_scaled_multiply(gn_scale(length, 0), gn_scale(light->near_depth, 0)));
    if (h.m == 0 || h.e + 18 < -31)
        return;
    pair->distance = (uint32_t)h.m;
    pair->distance_shift = h.e + 18 > 0 ? 0 : (uint8_t)(-18 - h.e);
}

GN_INLINE const gn_colour_pair *find_pair(const gn_context *context, gn_worker *worker, uint32_t triangle)
{
    gn_colour_pair *pair = &worker->colours[triangle & (GN_COLOUR_CACHE - 1)];
    if (pair->triangle != triangle || triangle == GN_NO_TRIANGLE)
        make_pair(context, pair, triangle);
    return pair;
}

GN_INLINE void write_pixel(uint8_t *out, uint32_t colour, uint8_t format)
{
    if (format == GN_RGB565) {
        *(uint16_t *)(void *)out = (uint16_t)colour;
    } else {
        out[0] = (uint8_t)colour;
        out[1] = (uint8_t)(colour >> 8);
        out[2] = (uint8_t)(colour >> 16);
    }
}

/* Runs of one triangle share its pair. */
GN_INLINE void colour_directional(const gn_context *context, gn_worker *worker, const uint32_t *lit,
                                  const uint32_t *triangle, int32_t count, uint8_t *out, uint8_t format)
{
    uint32_t last = triangle[0], bytes = format == GN_RGB565 ? 2 : 3;
    const gn_colour_pair *pair = find_pair(context, worker, last);
    uint32_t bright = pair->lit, dark = pair->unlit;
    for (int32_t i = 0; i < count; i++, out += bytes) {
        if (triangle[i] != last) {
            last = triangle[i];
            pair = find_pair(context, worker, last);
            bright = pair->lit;
            dark = pair->unlit;
        }
        write_pixel(out, lit[i] ? bright : dark, format);
    }
}

static void colour_spot(const gn_context *context, gn_worker *worker, const uint32_t *lit, const uint32_t *triangle,
                        int32_t count, uint8_t *out, uint8_t format)
{
    uint32_t last = triangle[0], bytes = format == GN_RGB565 ? 2 : 3;
    const gn_colour_pair *pair = find_pair(context, worker, last);
    for (int32_t i = 0; i < count; i++, out += bytes) {
        if (triangle[i] != last) {
            last = triangle[i];
            pair = find_pair(context, worker, last);
        }
        uint32_t colour = pair->unlit;
        if (lit[i] && pair->faces_light) {
            uint32_t cosine = (uint32_t)(gn_multiply_u(pair->distance, lit[i]) >> 32) >> pair->distance_shift;
            colour = pack(context->scene->objects[last >> context->triangle_bits].colour, intensity(context, cosine),
                          format);
        }
        write_pixel(out, colour, format);
    }
}

static void mask_row(const gn_context *context, gn_worker *worker, const uint32_t *lit, const uint32_t *triangle,
                     int32_t count, uint8_t *mask)
{
    uint32_t last = triangle[0];
    uint8_t bright = 0;
    for (int32_t i = 0; i < count; i++) {
        if (i == 0 || triangle[i] != last) {
            last = triangle[i];
            bright = find_pair(context, worker, last)->faces_light ? 254 : 0;
        }
        mask[i] = last == GN_NO_TRIANGLE ? 255 : lit[i] ? bright : 0;
    }
}

#if GN_STATISTICS
static uint32_t count_seen(const gn_context *context, gn_worker *worker, const uint32_t *triangle, int32_t count,
                           uint32_t *tested)
{
    uint32_t seen = 0, last = GN_NO_TRIANGLE;
    uint8_t faces = 0;
    for (int32_t i = 0; i < count; i++) {
        if (triangle[i] == GN_NO_TRIANGLE)
            continue;
        if (triangle[i] != last) {
            last = triangle[i];
            faces = find_pair(context, worker, last)->faces_light;
        }
        seen++;
        *tested += faces;
    }
    return seen;
}
#endif

uint32_t gn_colour_row(const gn_context *context, gn_worker *worker, const uint32_t *lit, const uint32_t *triangle,
                       int32_t count, void *colour, uint8_t *mask, uint32_t *tested)
{
    uint8_t format = context->settings.format;
    if (colour && context->light.kind == GN_SPOT)
        colour_spot(context, worker, lit, triangle, count, colour, format);
    else if (colour && format == GN_RGB888)
        colour_directional(context, worker, lit, triangle, count, colour, GN_RGB888);
    else if (colour)
        colour_directional(context, worker, lit, triangle, count, colour, GN_RGB565);
    if (mask)
        mask_row(context, worker, lit, triangle, count, mask);
#if GN_STATISTICS
    return count_seen(context, worker, triangle, count, tested);
#else
    *tested = 0;
    return 0;
#endif
}
