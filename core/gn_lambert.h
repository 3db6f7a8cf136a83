/* Intensity and packing of a colour, shared by the two colours of a triangle and by spot-lit pixels. */
#ifndef GN_LAMBERT_H
#define GN_LAMBERT_H

#include "gn_context.h"

/* ambient + (1 - ambient) cosine, all 2^16 = 1. */
GN_INLINE uint32_t gn_intensity(const gn_context *context, uint32_t cosine)
{
    uint32_t ambient = context->scene->ambient + (context->scene->ambient >> 15u);
    cosine = cosine > 0x10000u ? 0x10000u : cosine;
    return ambient + (uint32_t)((gn_multiply_u(0x10000u - ambient, cosine) + 0x8000u) >> 16);
}

/* A colour at an intensity, as it is written to the image. */
GN_INLINE uint32_t gn_pack(gn_rgb c, uint32_t intensity, uint8_t format)
{
    uint32_t r = c.r * intensity, g = c.g * intensity, b = c.b * intensity;
    if (format == GN_RGB565) {
        uint32_t half = 255u << 15, one = 255u << 16;
        return ((r * 31 + half) / one) << 11 | ((g * 63 + half) / one) << 5 | (b * 31 + half) / one;
    }
    return (r + 0x8000u) >> 16 | ((g + 0x8000u) >> 16) << 8 | ((b + 0x8000u) >> 16) << 16;
}

#endif
