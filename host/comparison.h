/* A shadow mask compared with the truth: how much is wrong, in which direction, and how far from a true shadow edge.
 *
 * Masks are 8-bit grey, rows from the top: 0 to 126 shadowed, 127 to 254 lit, 255 no surface. A pixel is wrong where
 * both masks see a surface and one says lit, the other shadowed. False shadow: lit in truth, shadowed in the mask.
 * False light: shadowed in truth, lit in the mask.
 *
 * The true shadow edge runs between neighbouring pixels (left and right, or above and below) of which one is lit, one
 * shadowed in truth; a border of a surface with nothing behind it is none. Its points are half-way between the two
 * centres, and a pixel's distance is the one from its centre to the nearest point, exact (distance.h): wrong pixels at
 * the edge itself are 0.5 pixels away. The edge band holds the pixels at most so and so far, the interior the rest.
 *
 * Pixels near a tie of the truth (truth.h) may go either way by a rounding: all figures stand once with and once
 * without them. Without them means in both numbers of a per cent; the edge stays that of the whole truth.
 */
#ifndef COMPARISON_H
#define COMPARISON_H

#include "image.h"

#include <stdint.h>

/* Two pixels on either side of an upright or level edge: room for what rounding and the snapping of vertices can move
 * an edge. What lies farther is a texel larger than that, acne, or a leak. */
#define COMPARISON_EDGE_BAND 2.0

typedef struct comparison_input {
    uint32_t width, height; /* 1 to 4096 */
    const uint8_t *mask, *truth;
    const uint8_t *near; /* not 0: near a tie; the array is 0 if it is not known */
    double edge_band;    /* pixels, 0 or more */
} comparison_input;

/* Wrong pixels. The distances are NAN where there are none or the truth has no edge; then all are in the interior. */
typedef struct comparison_errors {
    uint64_t pixels, in_edge_band, in_interior;
    double mean, percentile_95, worst; /* pixels from the edge; 95 % by nearest rank: the ceil(0.95 n)-th of n */
    uint32_t worst_x, worst_y;         /* the first such pixel in order of rows; if `worst` is a number */
} comparison_errors;

typedef struct comparison_figures {
    uint64_t surface, lit, shadowed; /* in truth */
    uint64_t in_edge_band;           /* of `surface` */
    uint64_t coverage;               /* a surface in one mask only */
    comparison_errors false_shadow, false_light, together;
    double mean_absolute_error; /* of the lit fraction (value / 254), 0 to 1; NAN if no pixel is a surface in both */
} comparison_figures;

typedef struct comparison {
    int has_edge, has_near;
    double edge_band;
    comparison_figures all, not_near; /* the same where has_near is 0 */
} comparison;

/* Compare. Takes at most 9 bytes a pixel while it works. */
void comparison_make(comparison *c, const comparison_input *input);

/* count in per cent of the pixels that see a surface in truth; 0 if none does, whatever the count: who sets a limit
 * looks at f->surface first. */
double comparison_percent(const comparison_figures *f, uint64_t count);

/* The difference in colours: false shadow red, false light blue; a surface in one mask only magenta; any of these near
 * a tie yellow; agreement light grey (lit) or dark grey (shadowed), nothing in both nearly black. image_free() it. */
image comparison_picture(const comparison_input *input);

#endif
