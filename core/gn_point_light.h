/* Point lights: six square maps, one a face of a cube about the light, from the one light pass and the one shadow test.
 *
 * A face is a spot light along an axis of the world. Its frustum is wider than 90 degrees by a border of whole texels,
 * as many as the reconstruction reads beyond the point's own: so the casters behind a cube's edge are on the maps of
 * both sides, and votes, filters, virtual samples and silhouettes across it read true depths. The six maps lie one
 * below the other, and the shadow test knows them as one map: a place on it says which face it is on, and no place is
 * so near to the end of a face that a texel of another one is read.
 *
 * A pixel's face is that of the largest of |x|, |y|, |z| of its point as seen from the light; of equal ones the first,
 * so there is no crack and no overlap, whatever the faces' own rounding. x, y and z are linear expressions of the view
 * in one unit, w of the face is one of them, and so distances and colours do not jump either.
 *
 * Limit: casters are cut at the near plane of the face, and so a border's casters before its own cube are missing from
 * the neighbour's border: |x| <= near < |x| N / (N - 2 border). It concerns points less than a border from a cube's
 * edge.
 *
 * Cost: as a spot light; a pixel takes three comparisons more. Memory: six maps (or one, gn_point_pass.c), 720 bytes.
 */
#ifndef GN_POINT_LIGHT_H
#define GN_POINT_LIGHT_H

#include "gn_cascade.h"

#define GN_FACES 6
#define GN_NO_FACE 7 /* of a pixel whose point the light does not reach */

typedef struct gn_point {
    gn_view views[GN_FACES]; /* +x, -x, +y, -y, +z, -z */
    gn_depth *map;           /* of the first face; context->map is the latest one's */
    uint8_t *drawn_map;      /* the same of gn_drawn */
    uint32_t scale[2];       /* texels of the map's half over the tangent, 18 fraction bits: u and v of a ratio of 1 */
    uint8_t first;           /* the face that lies first in memory: 0, or of one the one */
    uint8_t latest;          /* the face that was begun last */
    uint8_t done;            /* a bit a face: drawn */
    /* gn_point_pass.c, with one map: */
    uint8_t *elsewhere; /* of a row: 1: not decided by the face that is in memory */
    uint8_t *lit;       /* of all regions, one after the other: a bit a pixel, or a byte where there are fractions */
} gn_point;

/* The rows of the map above a face. */
GN_INLINE int64_t gn_face_row(const gn_context *context, uint32_t face)
{
    return (int64_t)(face - context->point->first) * context->settings.map_height;
}

/* Take the state and set it up, as gn_faces.lay_out. */
uint64_t gn_lay_out_point(gn_context *context, uint64_t used, const gn_settings *settings);

/* Get ready for a light: views of all faces, no face drawn. GN_UNSUPPORTED: not a point light, no settings.faces,
 * shadow volumes, a fit or a warp, or a map too small for its border. */
gn_status gn_begin_point_light(gn_context *context, const gn_light *light);

/* gn_light_face after that; its regions; leave a face that lights nothing in view without a map. */
gn_status gn_begin_face(gn_context *context, uint32_t face, uint32_t *regions);
gn_status gn_draw_regions(gn_context *context, uint32_t regions);
void gn_skip_face(gn_context *context, uint32_t face);

/* Make a face's maps those of context. */
void gn_choose_face(gn_context *context, uint32_t face);

/* gn_camera_begin, whatever faces are drawn. */
gn_status gn_begin_point_camera(gn_context *context, const gn_camera *camera);

/* A point by its face: the coordinate along the face's axis and those along the two axes that follow, as seen from the
 * light, and their magnitudes. */
typedef struct gn_face_place {
    uint32_t face, axis;
    uint32_t next, last;
    uint32_t magnitude[3];
} gn_face_place;

GN_INLINE uint32_t gn_face_magnitude(uint32_t v)
{
    return v >> 31 ? 0 - v : v;
}

/* The face of a point at x, y, z from the light; GN_NO_FACE: beyond near or far. */
GN_INLINE gn_face_place gn_find_face(const gn_shading *s, uint32_t x, uint32_t y, uint32_t z)
{
    uint32_t mx = gn_face_magnitude(x), my = gn_face_magnitude(y), mz = gn_face_magnitude(z);
    gn_face_place p = {0, x, y, z, {mx, my, mz}};
    if (my > mx && my >= mz) {
        gn_face_place q = {2, y, z, x, {my, mz, mx}};
        p = q;
    } else if (mz > mx) {
        gn_face_place q = {4, z, x, y, {mz, mx, my}};
        p = q;
    }
    p.face = p.magnitude[0] - s->near_w > s->far_w - s->near_w ? GN_NO_FACE : p.face + (p.axis >> 31);
    return p;
}

/* gn_find_points of the faces that are in memory; points of other faces that the light reaches lie nowhere, z 0. */
void gn_find_face_points(const gn_context *context, gn_points *points, uint32_t *q);

#endif
