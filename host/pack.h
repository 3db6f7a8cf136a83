/* The .gno file: a packed scene as one block of little-endian bytes, for the simulator and for firmware that reads
 * scenes at run time. Everything is checked when it is read.
 *
 *     offset  bytes
 *          0      4  "GNOM"
 *          4      4  version: 4
 *          8      4  bytes of the whole file
 *         12      4  CRC-32 (IEEE 802.3) of everything from byte 16 on
 *         16      8  image width, image height, map width, map height: 16 bits each
 *         24      4  scale (signed): a world unit of the scene file is 2^scale integers
 *         28      2  ambient, 0 to 65535
 *         30      4  background r, g, b; 1 if a method follows, 0 if not (then bytes 34 to 55 are 0)
 *         34      6  cull, layers, surface, unit of the bias, shadow; receiver: 0 point, 1 plane-bias, 2 virtual,
 *                    3 virtual-always
 *         40      8  bias; slope (32 bits each)
 *         48      4  reconstruction: 0 nearest, 1 bilinear, 2 jitter4x4, 3 pcf3, 4 pcf5, 5 pcf7, 6 silhouette,
 *                    7 silhouette-smooth, 8 crossing; fit: 0 none, 1 dv, 2 msf; warp: 0 none, 1 rectilinear,
 *                    2 rectilinear-distance, 3 nonorthogonal, 4 rectilinear-vertices, 5 nonorthogonal-vertices;
 *                    1 if the depth is fitted too (0 without a fit)
 *         52      4  smoothing (16.16 bits; 0: 1; 0 without a warp)
 *         56     68  camera: projection, three zero bytes; eye, right, up, forward (3 x 32 bits each); tan_half,
 *                    half_height, near_depth, far_depth (32 bits each)
 *        124     88  light: kind: 0 directional, 1 spot, 2 point; faces of a point light in memory: 1 six, 2 one (else
 *                    0); two zero bytes; right, up, forward (3 x 32 bits each); box_u, box_v, box_z,
 *                    box_width, box_height, box_depth; position (3 x 32 bits); tan_half, near_depth, far_depth
 *        212      8  number of meshes, number of objects
 *        220         meshes: vertex count, triangle count (32 bits each), bytes an index, closed, two zero bytes, edge
 *                    count (32 bits); then the vertices (3 x 32 bits each), the indices (3 a triangle), zero bytes up
 *                    to a multiple of 4, the edges (gn_mesh_edge: 2 x 32 bits each)
 *                    objects: number of the mesh (32 bits), r, g, b, a zero byte
 *
 * An edge count of 0: the mesh has no edges in the file. Else they are all there: each half-edge once, but those of
 * triangles with two corners at one place, which stand in none; both half-edges of an edge have their ends at the same
 * two places and run as GN_SAME_DIRECTION says. The order of edges is free, and so is which half-edges are paired.
 * A file that lacks edges is good whatever its method; who renders it with shadow volumes or silhouettes makes them.
 */
#ifndef PACK_H
#define PACK_H

#include "packed.h"

/* Do the bytes start like a .gno file? */
int pack_is_packed(const uint8_t *bytes, size_t size);

/* Read a .gno file from memory; `file` is for messages. packed_free() it, also after an error. 0, or -1 and the
 * problem. */
int pack_parse(packed_scene *packed, const char *file, const uint8_t *bytes, size_t size, problem *why);

/* Write a .gno file; edges where the meshes have them. 0, or -1 and the problem. */
int pack_write(const packed_scene *packed, const char *path, problem *why);

/* Write the scene as a C header: static const arrays and NAME_scene, NAME_camera, NAME_light and NAME_settings, where
 * NAME is the header's name without its extension, as a C identifier; edges where the meshes have them. `source` is for
 * its comment. */
int pack_write_header(const packed_scene *packed, const char *path, const char *source, problem *why);

#endif
