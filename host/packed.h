/* A scene with everything in integers, as the core takes it: what the quantiser makes of a scene file, and what a .gno
 * file holds.
 */
#ifndef PACKED_H
#define PACKED_H

#include "gnomon.h"
#include "problem.h"

typedef struct packed_scene {
    gn_scene scene; /* of objects[], which point into meshes[] */
    gn_object *objects;
    gn_mesh *meshes; /* their vertices, indices and edges are on the heap */
    uint32_t mesh_count;
    gn_camera camera;
    gn_light light;
    gn_settings settings; /* image and map size; faces of a point light; how shadows are made where has_method */
    int has_method;
    int scale;               /* one world unit of the scene file is 2^scale integers */
    double largest_rounding; /* of a vertex, in world units of the scene file; below 0: not known (.gno) */
} packed_scene;

/* Read a .scene file with its meshes, or a .gno file (told apart by what they hold). verbose: notices about meshes on
 * standard error. packed_free() it afterwards, also after an error. 0, or -1 and the problem. */
int packed_read(packed_scene *packed, const char *path, int verbose, problem *why);

/* Make the edges of all meshes that have none, for shadow volumes and silhouettes (adjacency.h). verbose: notices about
 * open edges and the like on standard error. 0, or -1 and the problem: a mesh of more than 715 million triangles. */
int packed_make_edges(packed_scene *packed, int verbose, problem *why);

/* Forget the edges of all meshes. */
void packed_drop_edges(packed_scene *packed);

void packed_free(packed_scene *packed);

/* Vertices and triangles of all objects. */
uint64_t packed_vertex_count(const packed_scene *packed);
uint64_t packed_triangle_count(const packed_scene *packed);

#endif
