/* Faces of shadow volumes: polygons with corners at infinity, clipped and projected.
 *
 * Clipping goes as in gn_clip.h, in the same order and with the same crossings, so that a side and the cap that it
 * hangs from cover the same pixels along their edge, and two sides the same along theirs. There is no far plane. */
#ifndef GN_FACE_H
#define GN_FACE_H

#include "gn_clip.h"

/* A polygon before projection: finite corners are places; those at infinity directions, any length. */
typedef struct gn_face {
    gn_place place[GN_CLIP_VERTICES];
    uint8_t infinite[GN_CLIP_VERTICES];
    int32_t count;
} gn_face;

typedef struct gn_outline {
    gn_vertex v[GN_CLIP_VERTICES];
    int32_t count;
} gn_outline;

/* One end of a side: its place, and the way on from there, away from the light. */
typedef struct gn_corner {
    int32_t world[3]; /* not of the corner of a cut */
    gn_place place;
    int32_t away[3];    /* |.| <= 2^30 */
    gn_place direction; /* of away */
} gn_corner;

void gn_add_corner(gn_face *f, const gn_place *place, uint8_t infinite);

/* Clip and project. Perspective faces end at the camera's near plane: nothing before it is seen. */
void gn_project_face(const gn_view *view, const gn_face *f, gn_outline *out);

/* A direction as a place at infinity, |d| <= 2^30: 29 bits, in an affine view 40. */
gn_place gn_place_direction(const gn_view *view, const int32_t d[3]);

void gn_set_corner(gn_corner *c, const gn_view *view, const gn_light *light, const int32_t world[3]);

/* The side over the edge from a to b of a cap: seen from outside the volume its corners run b, a, a at infinity, b at
 * infinity; all light of the sun meets in one point there. */
void gn_make_side(gn_outline *o, const gn_view *view, const gn_light *light, const gn_corner *a, const gn_corner *b);

/* Its part of the lid, from the light's axis. An orthographic camera sees all of infinity in one point. */
void gn_make_lid(gn_outline *o, const gn_view *view, const gn_place *axis, const gn_corner *a, const gn_corner *b);

#endif
