/* The exact answer for every pixel, by casting lines through the quantised scene: what is lit, what is shadowed.
 *
 * Shares nothing with core/ but the packed integers. The truth of a pixel: its centre sees a point of a surface; the
 * point is lit when camera and light are on the same side of its triangle's plane and no other triangle blocks the
 * segment from the point to the light's near plane (directional: to infinity), and, for a spot light, when it lies
 * inside its frustum (docs/design.md). A point light is six such frustums: near and far bound max(|x|, |y|, |z|).
 *
 * Nothing is rounded: lines are rational, and every decision is the sign of a determinant of integers (truth_line.h).
 * What such a sign leaves open, because it is 0, is a tie: decided by a rule, and marked.
 *
 *     truth.c          the image, its workers, near pixels
 *     truth_trace.[ch] one point of the image: sight, passage of light, ties
 *     truth_scene.c    world triangles, ranges, the light's frustum
 *     truth_bvh.[ch]   which triangles a line may meet
 *     truth_line.[ch]  lines, points, signs: doubles with bounds, then exact
 *     truth_wide.[ch]  integers of up to 352 bits
 */
#ifndef TRUTH_H
#define TRUTH_H

#include "packed.h"
#include "problem.h"

/* What a pixel's answer hangs on, where it hangs on a tie, and how the tie is settled. Of several the first counts. */
typedef enum truth_reason {
    TRUTH_NO_TIE = 0,
    TRUTH_EYE_EDGE,      /* the eye ray passes through an edge or corner of what it sees: it is hit */
    TRUTH_EYE_DEPTH,     /* two triangles are seen at one depth: the one that comes first in the scene is */
    TRUTH_EYE_PLANE,     /* the point is on the camera's near or far plane: it is seen */
    TRUTH_LIGHT_SIDE,    /* the light is in the plane of what is seen: shadowed */
    TRUTH_LIGHT_FRUSTUM, /* the point is on the boundary of the light's frustum: it is inside */
    TRUTH_SHADOW_TOUCH,  /* another triangle passes through the point: it does not shadow it */
    TRUTH_SHADOW_EDGE,   /* the way to the light passes through an edge or corner: shadowed if a point that is moved
                          * by (e, e^2, e^3), e > 0 infinitely small, were */
    TRUTH_SHADOW_NEAR,   /* the way is blocked just on the light's near plane: shadowed */
    TRUTH_SHADOW_WITHIN, /* the way lies within the plane of a triangle that it touches: not shadowed by it */
    TRUTH_REASON_COUNT
} truth_reason;

/* One word for each, as in `gnomon truth --ties`. */
extern const char *const truth_reason_names[TRUTH_REASON_COUNT];

typedef struct truth {
    uint32_t width, height;
    uint8_t *mask;    /* 0 shadowed, 254 lit, 255 no surface */
    uint8_t *ties;    /* 1: the answer hangs on an exact tie (a determinant that is zero) */
    uint8_t *reasons; /* truth_reason of each pixel */
    uint8_t *near;    /* 255: the answer differs at one of the four points 1/256 pixel left, right, above, below, or
                       * hangs on a tie; else 0. The array is 0 unless asked for */
    uint64_t surface, lit, shadowed, tie_count, near_count; /* pixels; ties and near also where nothing is seen */
    uint64_t exact_decisions;                               /* how often double precision was not enough */
    uint64_t triangles;                                     /* of some area */
} truth;

/* Cast. width, height: of the image, instead of the scene's own. workers: threads, 1 to 64; they change no answer.
 * Shows progress on a terminal. truth_free() it, also after an error. 0, or -1 and the problem (numbers out of the
 * ranges of gnomon.h). */
int truth_make(truth *t, const packed_scene *packed, uint32_t width, uint32_t height, int workers, int with_near,
               problem *why);

void truth_free(truth *t);

#endif
