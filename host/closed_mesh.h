/* Is a mesh closed? After merging corners at equal positions every edge must be used equally often in both directions.
 * More than two triangles on an edge (a non-manifold edge) are allowed and counted.
 */
#ifndef CLOSED_MESH_H
#define CLOSED_MESH_H

#include "obj.h"

typedef struct closed_mesh_check {
    int closed;
    double from[3], to[3];  /* ends of one edge that is not balanced */
    long forward, backward; /* how often it is used from -> to and to -> from */
    size_t non_manifold;    /* edges with more than two triangles */
    double volume;          /* signed, in cubic units of the file: negative means inside out */
} closed_mesh_check;

/* Time O(n log n), memory 12 bytes a vertex and 36 a triangle. */
closed_mesh_check check_closed_mesh(const obj_mesh *mesh);

#endif
