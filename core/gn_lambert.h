/* Intensity and packing of a colour, shared by the two colours of a triangle and by spot-lit pixels. */
#ifndef GN_LAMBERT_H
#define GN_LAMBERT_H

#include "gn_context.h"

/* ambient + (1 - ambient) cosine, all 2^16 = 1. */
uint32_t gn_intensity(const gn_context *context, uint32_t cosine);

/* A colour at an intensity, as it is written to the image. */
uint32_t gn_pack(gn_rgb c, uint32_t intensity, uint8_t format);

#endif
