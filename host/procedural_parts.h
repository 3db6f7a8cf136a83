/* The parts that procedural scenes are made of: solids, tubes and sheets, appended to a mesh and then moved.
 *
 * A maker appends one part to the mesh and returns a handle to it; a mover changes that part's vertices and returns the
 * same handle, so that calls nest as they are read: part_translate(part_rotate_y(part_box(m, ...), 30), 1, 0, 2).
 * Solids are closed and counter-clockwise from outside; sheets are open. When memory runs out the mesh is marked as
 * failed, and all that follows is harmless: test failed once, at the end.
 *
 * Cost: 24 bytes a vertex, 12 a triangle, up to twice that while an array grows.
 * Every sum is written in the order in which gen.py evaluates it, for equal bits: do not simplify. Its sum() is that of
 * Python before 3.12, from left to right (later ones compensate the rounding). */
#ifndef PROCEDURAL_PARTS_H
#define PROCEDURAL_PARTS_H

#include <stddef.h>

#if defined __clang__
#pragma STDC FP_CONTRACT OFF /* as -ffp-contract=off, which gcc with -std=c99 implies */
#endif

#define PART_PI 3.14159265358979323846
#define PART_PATH_ROOM 64

typedef struct part_point {
    double x, y, z;
} part_point;

typedef struct part_corner { /* of a prism's outline: (x, z) where it stands upright, (x, y) where it lies along z */
    double x, z;
} part_corner;

typedef struct part_ring { /* of a solid of revolution about y */
    double radius, y;
} part_ring;

typedef struct part_path {
    part_point points[PART_PATH_ROOM];
    int count;
} part_path;

typedef struct part_start {
    size_t vertex, triangle;
} part_start;

/* Start with all zero; end with part_mesh_free. */
typedef struct part_mesh {
    part_point *vertices;
    int (*triangles)[3]; /* indices into vertices, of the whole mesh */
    part_start *parts;   /* where each part begins */
    size_t vertex_count, triangle_count, part_count;
    size_t vertex_room, triangle_room, part_room;
    int failed; /* 1: out of memory, the mesh is incomplete */
} part_mesh;

typedef struct part { /* the vertices and triangles from start up to end */
    part_mesh *mesh;
    part_start start, end;
} part;

typedef part_point part_surface(double u, double v); /* u and v in [0, 1] */

void part_mesh_free(part_mesh *mesh);

/* Vectors and angles. part_unit of the null vector is the null vector. */
part_point part_minus(part_point a, part_point b);
part_point part_cross(part_point a, part_point b);
double part_dot(part_point a, part_point b);
part_point part_unit(part_point a);
double part_radians(double degrees);

/* Solids. Counts of corners, rings, sides and points are at least those of a solid: 3, 3, 3, 2. Prisms are capped by
 * fans from corner 0, a wheel by fans from the y axis. A profile runs from one pole to the other: its first and last
 * radius are 0. A sphere has at most PART_PATH_ROOM bands; the thickness of a torus is the radius of its tube. */
part part_box(part_mesh *mesh, double x0, double x1, double y0, double y1, double z0, double z1);
part part_prism(part_mesh *mesh, const part_corner *outline, int corners, double y0, double y1);
part part_prism_along_z(part_mesh *mesh, const part_corner *outline, int corners, double z0, double z1);
part part_wheel(part_mesh *mesh, const part_corner *outline, int corners, double y0, double y1);
part part_lathe(part_mesh *mesh, const part_ring *profile, int rings, int sides);
part part_sphere(part_mesh *mesh, double radius, int sides, int bands);
part part_cylinder(part_mesh *mesh, double radius, double y0, double y1, int sides);
part part_cone(part_mesh *mesh, double radius, double y0, double y1, int sides);
part part_torus(part_mesh *mesh, double radius, double thickness, int sides, int bands);
part part_tube(part_mesh *mesh, const part_path *path, double radius, int sides);

/* The path with its inner corners replaced by parabolas that begin and end at distance radius from the corner.
 * 2 + (count - 2) (steps + 1) points, at most PART_PATH_ROOM. */
part_path part_rounded(const part_path *path, double radius, int steps);

/* Sheets of nu x nv quadrilaterals over the unit square. A rectangle is corner + s u + t v, s and t in [0, 1]. */
part part_sheet(part_mesh *mesh, part_surface *surface, int nu, int nv);
part part_rectangle(part_mesh *mesh, part_point corner, part_point u, part_point v, int nu, int nv);

/* Movers. Angles in degrees, right-handed: 90 about x takes y to z, about y z to x, about z x to y. */
part part_translate(part p, double x, double y, double z);
part part_scale(part p, double factor);
part part_rotate_x(part p, double degrees);
part part_rotate_y(part p, double degrees);
part part_rotate_z(part p, double degrees);

#endif
