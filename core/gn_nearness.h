/* Nearness: how near the eye a plane is, pixel by pixel, for shadow volumes.
 *
 * A plane n . (X - V) = 0 seen through a pixel lies at 1/w = (n . d) / (n . (V - E)), where d is affine in the pixel:
 * so nearness is a linear expression, like Q. Q comes from corners snapped to the screen, and is good where a triangle
 * is; a volume's faces meet surfaces at any slope, and their crossing must be right to 1/256 pixel. So nearness comes
 * from the world's own integers, with 60 bits and a block exponent a plane, and is exact to 2^-48 of its range
 * or better.
 *
 * Perspective: 2^60 near / w. Orthographic: -2^32 w. Greater is nearer. */
#ifndef GN_NEARNESS_H
#define GN_NEARNESS_H

#include "gn_wide.h"
#include "gnomon.h"

#define GN_NEAREST ((int64_t)1 << 62)

typedef struct gn_eye {
    int32_t position[3];
    gn_q2_30 right[3], up[3], forward[3];
    uint8_t perspective;
    uint8_t width_bits, height_bits; /* 2^bits >= size */
    int32_t width, height, near_depth;
    gn_wide unit; /* nearness, where the quotient of the two dot products is 1 */
    gn_wide step; /* and of a pixel's width in it */
} gn_eye;

/* value(i, j) = base + i dx + j dy, within +-2^62 all over the image; nearness is value 2^shift. */
typedef struct gn_nearness {
    int64_t base, dx, dy;
    uint8_t shift; /* 0 to 62: the steeper the plane, the greater */
} gn_nearness;

/* The range of nearness of the corners of a face: what rounding of their places moves beyond it is held. */
typedef struct gn_reach {
    int64_t low, high;
} gn_reach;

void gn_make_eye(gn_eye *eye, const gn_camera *camera, int32_t width, int32_t height);

/* Nearness of the plane with normal n, |n| <= 2^61, and n . (V - position) for any V on it. Seen edge-on: the least. */
void gn_make_nearness(gn_nearness *plane, const gn_eye *eye, const int64_t n[3], gn_wide distance);

gn_reach gn_empty_reach(void);

/* Take in a point at depth w along forward, in 2^-30 units; a point, |.| <= GN_EYE_MAX; or the end of a ray from such a
 * point along direction, |.| <= 2^30. */
void gn_reach_depth(gn_reach *reach, const gn_eye *eye, gn_wide w);
void gn_reach_point(gn_reach *reach, const gn_eye *eye, const int32_t point[3]);
void gn_reach_ray(gn_reach *reach, const gn_eye *eye, const int32_t direction[3]);

#endif
