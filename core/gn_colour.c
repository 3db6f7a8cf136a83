/* The colours and the mask of a row. Runs of one triangle share its pair of colours, made when a region first sees the
 * triangle (gn_lambert.c) and kept in a small cache; a spot-lit pixel takes one product more. */
#include "gn_lambert.h"

void gn_clear_colours(gn_worker *worker)
{
    for (uint32_t i = 0; i < GN_COLOUR_CACHE; i++)
        worker->colours[i].triangle = GN_NO_TRIANGLE;
}

GN_NOINLINE const gn_colour_pair *gn_find_pair(const gn_context *context, gn_worker *worker, uint32_t triangle)
{
    gn_colour_pair *pair = &worker->colours[triangle & (GN_COLOUR_CACHE - 1)];
    if (pair->triangle != triangle || triangle == GN_NO_TRIANGLE)
        gn_make_pair(context, pair, triangle);
    return pair;
}

/* Runs of one triangle share its pair. */
GN_INLINE void colour_directional(const gn_context *context, gn_worker *worker, const uint32_t *lit,
                                  const uint32_t *triangle, int32_t count, uint8_t *out, uint8_t format)
{
    uint32_t last = triangle[0];
    const gn_colour_pair *pair = gn_find_pair(context, worker, last);
    uint32_t bright = pair->lit, dark = pair->unlit;
    for (int32_t i = 0; i < count; i++) {
        if (triangle[i] != last) {
            last = triangle[i];
            pair = gn_find_pair(context, worker, last);
            bright = pair->lit;
            dark = pair->unlit;
        }
        out = gn_write_pixel(out, (int32_t)lit[i] >= 0 ? bright : dark, format);
    }
}

static void colour_spot(const gn_context *context, gn_worker *worker, const uint32_t *lit, const uint32_t *triangle,
                        int32_t count, uint8_t *out, uint8_t format)
{
    uint32_t last = triangle[0];
    const gn_colour_pair *pair = gn_find_pair(context, worker, last);
    for (int32_t i = 0; i < count; i++) {
        if (triangle[i] != last) {
            last = triangle[i];
            pair = gn_find_pair(context, worker, last);
        }
        uint32_t colour = pair->unlit;
        if ((int32_t)lit[i] >= 0 && pair->faces_light) {
            uint64_t product = gn_multiply_u(pair->distance, lit[i]) >> pair->distance_shift;
            uint32_t cosine = product > 0x10000u ? 0x10000u : (uint32_t)product;
            colour = gn_pack(context->scene->objects[last >> context->triangle_bits].colour,
                             gn_intensity(context, cosine), format);
        }
        out = gn_write_pixel(out, colour, format);
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
            bright = gn_find_pair(context, worker, last)->faces_light ? 254 : 0;
        }
        mask[i] = last == GN_NO_TRIANGLE ? 255 : (int32_t)lit[i] >= 0 ? bright : 0;
    }
}

uint32_t gn_count_seen(const gn_context *context, gn_worker *worker, const uint32_t *triangle, int32_t count,
                       uint32_t *tested)
{
    uint32_t seen = 0;
#if GN_STATISTICS
    uint32_t last = GN_NO_TRIANGLE;
    uint8_t faces = 0;
    for (int32_t i = 0; i < count; i++) {
        if (triangle[i] == GN_NO_TRIANGLE)
            continue;
        if (triangle[i] != last) {
            last = triangle[i];
            faces = gn_find_pair(context, worker, last)->faces_light;
        }
        seen++;
        *tested += faces;
    }
#else
    (void)context, (void)worker, (void)triangle, (void)count;
    *tested = 0;
#endif
    return seen;
}

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
    return gn_count_seen(context, worker, triangle, count, tested);
}
