/* Tangent for the fields of view of cameras and spot lights; gn_sine and gn_cosine are in gnomon.h. */
#ifndef GN_TRIGONOMETRY_H
#define GN_TRIGONOMETRY_H

#include "gnomon.h"

/* tan(angle) in Q8.24: |error| <= 0.52 / 2^24 + 2^-23.8 tan(angle): the format's rounding, and what sine and cosine
 * leave. angle: 1/4 to 89 degrees (GN_DEGREES(1) / 4 to GN_DEGREES(178) / 2, which halves the ends that gnomon.h states
 * for whole fields of view), else GN_OUT_OF_RANGE and *tangent as it was. Cost: a sine, a cosine, a 64 / 32 bit
 * division. */
gn_status gn_tangent(gn_q8_24 *tangent, gn_angle angle);

#endif
