/* Which triangles of a mesh share an edge: the pairs of half-edges that shadow volumes and silhouette maps walk along
 * (gn_mesh_edge).
 *
 * Two half-edges lie on one edge if their ends stand at the same two places after quantisation, whatever the numbers of
 * their vertices. On each edge, half-edges taken in the order of their numbers:
 *
 * - the first of one direction is paired with the first of the other, the second with the second, and so on;
 * - what is left runs in one direction: paired first with second, third with fourth, with GN_SAME_DIRECTION;
 * - a last one without a partner is open (GN_NO_HALF_EDGE).
 *
 * So a mesh that is closed has pairs of opposite directions alone, also where more than two triangles meet at an edge.
 * Which of those triangles belong together in space is not asked: volumes count the same with any such pairing;
 * whether a silhouette map has that edge may hang on it.
 *
 * Triangles with two corners at one place have no part in this: their half-edges are in no pair. Edges are in the order
 * of half[0], which is less than the number in half[1].
 */
#ifndef ADJACENCY_H
#define ADJACENCY_H

#include "gnomon.h"

/* The numbers of half-edges are below GN_SAME_DIRECTION, and none with that bit set is GN_NO_HALF_EDGE. */
#define ADJACENCY_MOST_TRIANGLES (0x7fffffffu / 3)

typedef struct adjacency_counts {
    uint32_t open;           /* pairs that lack their second half-edge */
    uint32_t same_direction; /* pairs of triangles of opposite winding */
    uint32_t non_manifold;   /* edges with more than two triangles; each is several pairs */
    uint32_t left_out;       /* triangles with two corners at one place */
} adjacency_counts;

/* Set edges (on the heap, never 0) and edge_count of a mesh of at most ADJACENCY_MOST_TRIANGLES, whose indices are
 * good. Time O(n log n), 0.1 s for 262,000 triangles; memory 20 bytes a vertex and 48 a triangle, and what qsort takes,
 * besides the result: 8 bytes an edge, about 12 a triangle. */
adjacency_counts adjacency_make(gn_mesh *mesh);

/* The vertex at a corner: corner 3 t + i of triangle t is where its half-edge 3 t + i starts. */
uint32_t adjacency_vertex(const gn_mesh *mesh, uint32_t corner);

/* The corner where a half-edge ends. */
uint32_t adjacency_end(uint32_t half_edge);

#endif
