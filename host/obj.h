/* Wavefront OBJ reader: vertex positions and faces; everything else is ignored.
 *
 * Faces: v, v/vt, v//vn or v/vt/vn, positive (from 1) or negative (from the last one so far); polygons of any size
 * become fans from their first corner. A vertex may carry more numbers (w, colour), which are checked to be numbers and
 * dropped.
 */
#ifndef OBJ_H
#define OBJ_H

#include "problem.h"

#include <stddef.h>
#include <stdint.h>

typedef struct obj_mesh {
    double (*positions)[3];
    uint32_t (*triangles)[3];
    size_t position_count, triangle_count;
} obj_mesh;

/* Read a file; obj_free() it afterwards, also after an error. 0, or -1 and the problem. */
int obj_read(obj_mesh *mesh, const char *path, problem *why);

/* The same from memory: `size` bytes followed by a zero byte; `file` is for messages. */
int obj_parse(obj_mesh *mesh, const char *file, const char *bytes, size_t size, problem *why);

void obj_free(obj_mesh *mesh);

#endif
