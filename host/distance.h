/* How far each pixel is from an edge between pixels: the exact Euclidean distance transform of Meijster, Roerdink &
 * Hesselink, "A General Algorithm for Computing Distance Transforms in Linear Time", ISMM 2000.
 *
 * The points of an edge lie half-way between the centres of two neighbouring pixels, one point for each pair of the
 * four directions. The distance of a pixel is the one from its centre to the nearest point: 1/2 for the pixels of the
 * pair itself, sqrt(5)/2 beside them, 3/2 behind them. On the grid of half pixels all of it is whole numbers, so
 * nothing is rounded: what is kept is (2 distance)^2, at most 2 x 8190^2 < 2^27.
 */
#ifndef DISTANCE_H
#define DISTANCE_H

#include <stdint.h>

/* What lies beside a pixel; both may. */
enum { DISTANCE_EDGE_RIGHT = 1, DISTANCE_EDGE_BELOW = 2 };

/* (2 distance)^2 where there is no edge at all. */
#define DISTANCE_NONE UINT32_MAX

/* For each pixel the square of twice its distance to the nearest edge, in squared pixels. edges: the points between
 * each pixel and its right and lower neighbours; in the last column and row those outside of the image are left out.
 * Rows from the top, width x height of each, both 1 to 4096. Returns whether there is an edge.
 *
 * Takes 4 more bytes a pixel; time in proportion to the number of pixels, whatever they hold. */
int distance_to_edges(uint32_t *squared, const uint8_t *edges, uint32_t width, uint32_t height);

#endif
