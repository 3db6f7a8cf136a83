/* Colours and mask of a row of which some pixels are partly lit: c (ambient + (1 - ambient) max(N.L, 0) lit), rounded
 * once. Fully lit and unlit pixels get the same colours as without fractions. */
#include "gn_cascade.h"
#include "gn_lambert.h"

/* The colour of a triangle at a cosine in 2^-16, lit by a fraction of 254. */
static uint32_t blend(const gn_context *context, uint32_t triangle, uint32_t cosine, uint32_t fraction)
{
    uint32_t part = (cosine * fraction + 127) / 254;
    return gn_pack(context->scene->objects[triangle >> context->triangle_bits].colour, gn_intensity(context, part),
                   context->settings.format);
}

/* N.L of a pixel in 2^-16, at most 1. */
static uint32_t cosine_of(const gn_context *context, const gn_colour_pair *pair, uint32_t nearness)
{
    if (context->light.kind == GN_DIRECTIONAL)
        return pair->distance;
    uint64_t product = gn_multiply_u(pair->distance, nearness) >> pair->distance_shift;
    return product > 0x10000u ? 0x10000u : (uint32_t)product;
}

uint32_t gn_colour_fractions(const gn_context *context, gn_worker *worker, const uint32_t *lit,
                             const uint32_t *triangle, int32_t count, void *colour, uint8_t *mask, uint32_t *tested)
{
    uint8_t format = context->settings.format;
    uint8_t *out = colour;
    for (int32_t i = 0; i < count; i++) {
        const gn_colour_pair *pair = gn_find_pair(context, worker, triangle[i]);
        uint32_t fraction = pair->faces_light ? worker->fraction[i] : 0, value = fraction ? pair->lit : pair->unlit;
        if (mask)
            mask[i] = triangle[i] == GN_NO_TRIANGLE ? 255 : (uint8_t)fraction;
        if (!out)
            continue;
        if (fraction && (fraction < 254 || context->light.kind == GN_SPOT))
            value = blend(context, triangle[i], cosine_of(context, pair, lit[i]), fraction);
        out = gn_write_pixel(out, value, format);
    }
    return gn_count_seen(context, worker, triangle, count, tested);
}
