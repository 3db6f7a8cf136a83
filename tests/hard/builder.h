/* Scenes in memory, built in metres from a few shapes: what the hard cases are made of.
 *
 * Coordinates are doubles in metres, y up; build_finish() multiplies them by `unit` (world integers a metre), adds
 * `origin` (world integers) and rounds, half away from zero. Cameras and lights are made by the core's public
 * functions alone. A call that the core refuses leaves its status in `status`, and the scene is not to be used.
 */
#ifndef BUILDER_H
#define BUILDER_H

#include "packed.h"

enum { BUILD_METRE = 1 << 16 }; /* world integers a metre, unless a case says otherwise */

typedef struct build_mesh {
    double (*vertices)[3];
    uint32_t (*triangles)[3];
    size_t vertex_count, triangle_count, vertex_room, triangle_room;
    int closed;
    gn_rgb colour;
} build_mesh;

typedef struct builder {
    double unit;
    int32_t origin[3];
    build_mesh *meshes;
    size_t mesh_count, mesh_room;
    gn_camera camera;
    gn_light light;
    int fit_light; /* 1: build_finish fits the box of a directional light */
    uint16_t width, height, map_width, map_height;
    gn_bias bias; /* of constant, dual and mixed; not of auto */
    gn_status status;
} builder;

/* An empty scene: image 160 x 120, map 64 x 64, bias 2 texels. */
void build_begin(builder *b);

/* What follows goes into a new mesh. */
void build_solid(builder *b, uint8_t red, uint8_t green, uint8_t blue);
void build_sheet(builder *b, uint8_t red, uint8_t green, uint8_t blue);

/* Into the latest mesh. */
uint32_t build_vertex(builder *b, double x, double y, double z);
void build_triangle(builder *b, uint32_t v0, uint32_t v1, uint32_t v2);

/* Two triangles v0 v1 v2, v0 v2 v3, of new vertices: counter-clockwise where that is the order. */
void build_quad(builder *b, const double corners[4][3]);

/* A closed box, counter-clockwise from outside. */
void build_box(builder *b, double x0, double x1, double y0, double y1, double z0, double z1);

/* A closed prism along z over a convex outline of (x, y), counter-clockwise seen from +z. */
void build_prism(builder *b, const double (*outline)[2], int corners, double z0, double z1);

/* A closed sphere of bands x sides facets, its axis upright. */
void build_sphere(builder *b, double x, double y, double z, double radius, int bands, int sides);

/* A level rectangle of two triangles, counter-clockwise from above. */
void build_level(builder *b, double x0, double x1, double y, double z0, double z1);

/* A light grey slab 0.5 m thick about the origin, its top y = 0: a new mesh, solid. */
void build_floor(builder *b, double half_width, double half_depth);

/* Turn the latest mesh's vertices from number `first` on about an axis (0 x, 1 y, 2 z) through a point, right-handed.
 */
void build_turn(builder *b, size_t first, int axis, double degrees, double x, double y, double z);
size_t build_vertex_count(const builder *b); /* of the latest mesh */

/* Turn the latest mesh inside out. */
void build_invert(builder *b);

/* An orthographic camera straight above (x, z), up on the image = -z; half_height in metres. */
void build_camera_above(builder *b, double x, double z, double half_height);
void build_camera_orthographic(builder *b, const double eye[3], const double target[3], double half_height);
void build_camera_perspective(builder *b, const double eye[3], const double target[3], double degrees,
                              double near_depth, double far_depth);

/* A directional light. Its box: width x height metres about (u, v), depth from z on, along the light's own axes. */
void build_sun(builder *b, double x, double y, double z);
void build_sun_box(builder *b, double u, double v, double width, double height, double z, double depth);

/* A sun that travels along +x and down, `degrees` above the horizon: u is +z, v = x sin + y cos, z = x cos - y sin. The
 * box is 4 m x 4 m about the origin and 8 m deep: with a map of 64 a texel is 1/16 m, its centres at odd multiples of
 * 1/32 m. */
void build_low_sun(builder *b, double degrees);

/* A sun straight overhead, with a box of that size. */
void build_noon(builder *b);

/* A camera above the origin that sees 10/3 m x 5/2 m, 48 pixels a metre, and a low sun. */
void build_view_from_above(builder *b, double sun_degrees);

void build_spot(builder *b, const double position[3], const double target[3], double degrees, double near_depth,
                double far_depth);

/* Round everything; packed_free(), also after an error. 0, or -1 and the status in b->status. */
int build_finish(builder *b, packed_scene *packed);

void build_free(builder *b);

#endif
