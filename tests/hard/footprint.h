/* Which errors are the texel's, and which the method's own.
 *
 * A shadow map answers for the centres of its texels. The best that any method can do with one texel a pixel and no
 * filter is to give the truth at that centre, moved along the light onto the receiver's own plane: where this differs
 * from the truth at the pixel's point the error is the texel's, and only a larger map helps. Every other error is the
 * method's own: acne, a bias too large, a leak.
 *
 * Worked out in double precision by plain ray casting over all triangles; shares nothing with core/ or host/truth.c but
 * the packed integers, so that it is also a second opinion on the truth. Vertices are snapped to 1/256 texel and light
 * coordinates of pixels err by about as much (docs/number-formats.md), so centres are tried 1/32 texel to either side,
 * and a point within 1/32 texel of a border is tried in both texels.
 */
#ifndef FOOTPRINT_H
#define FOOTPRINT_H

#include "packed.h"

typedef struct footprint_triangle {
    double corner[3][3], normal[3]; /* not of unit length */
} footprint_triangle;

typedef struct footprint {
    const packed_scene *packed;
    footprint_triangle *triangles;
    size_t triangle_count;
    uint32_t map_width, map_height;
    uint8_t *answers;  /* a pixel each, see footprint_answers_differ; made when first asked for */
    int32_t *receiver; /* number of the triangle that a pixel sees; -1: none */
    double (*points)[3];
    uint8_t *mask; /* 0 shadowed, 254 lit, 255 no surface */
} footprint;

/* Cast a ray through every pixel of the scene's image and one to the light: mask, receiver, points. */
void footprint_make(footprint *f, const packed_scene *packed);
void footprint_free(footprint *f);

/* Is some answer among the texel centres that pixel may be compared at, on its receiver's plane, not `truth`? */
int footprint_differs(footprint *f, size_t pixel, uint8_t truth);

/* The same of all texels at most `radius` columns and rows from that. Worked out anew each time. */
int footprint_differs_about(const footprint *f, size_t pixel, uint8_t truth, int radius);

/* May a shadow test at this pixel be decided on a plane that the light sees edge-on (within 2^-24)? Then its depth at
 * another place means nothing. */
int footprint_is_edge_on(const footprint *f, size_t pixel);

/* The width of a texel at a point, in world integers. */
double footprint_texel(const footprint *f, const double point[3]);

#endif
