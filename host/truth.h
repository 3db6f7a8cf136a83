/* The exact answer for every pixel, by casting rays through the quantised scene: what is lit, what is shadowed.
 *
 * Shares nothing with core/ but the packed integers. The truth of a pixel: its centre sees a point of a surface; the
 * point is lit when camera and light are on the same side of its triangle's plane and no other triangle blocks the
 * segment from the point to the light's near plane (directional: to infinity), and, for a spot light, when it lies
 * inside its frustum (docs/design.md). A point light is six such frustums: near and far bound max(|x|, |y|, |z|).
 */
#ifndef TRUTH_H
#define TRUTH_H

#include "packed.h"
#include "problem.h"

typedef struct truth {
    uint32_t width, height;
    uint8_t *mask; /* 0 shadowed, 254 lit, 255 no surface */
    uint8_t *ties; /* 1: the answer hangs on an exact tie (a determinant that is zero) */
    uint8_t *near; /* 255: the answer differs at one of the four points 1/256 pixel left, right, above, below; else 0.
                    * The array is 0 unless asked for */
    uint64_t surface, lit, shadowed, tie_count, near_count;
} truth;

/* Cast. width, height: of the image, instead of the scene's own. workers: threads, 1 to 64. truth_free() it, also after
 * an error. 0, or -1 and the problem. */
int truth_make(truth *t, const packed_scene *packed, uint32_t width, uint32_t height, int workers, int with_near,
               problem *why);

void truth_free(truth *t);

#endif
