/* Clipping at the near and far planes and at a guard band, before projection.
 *
 * A point where an edge crosses a plane is computed from the edge's ends in a canonical order (by their coordinates),
 * so neighbours that share the edge share the point: clipped meshes stay watertight. A clipped triangle is a fan of
 * pieces; all of them keep one plane, that of the largest piece. Slow path: not reached by triangles inside the guard
 * band. */
#ifndef GN_CLIP_H
#define GN_CLIP_H

#include "gn_view.h"

#define GN_CLIP_PLANES 6   /* near, far, then the guard band's four sides */
#define GN_CLIP_VERTICES 9 /* three, and one for each of the planes */

typedef struct gn_polygon {
    gn_vertex v[GN_CLIP_VERTICES];
    int32_t count;     /* 0, or 3 to 9 */
    int32_t reference; /* the fan's piece (v[0], v[reference], v[reference + 1]) of largest area */
    int64_t area;      /* of that piece; 0: nothing to draw */
} gn_polygon;

/* Distance to a plane, positive inside; |.| < 2^45. */
int64_t gn_plane_distance(const gn_view *view, const gn_place *p, int plane);

/* The point between a and b at distance 0. da and db have opposite signs or one is 0; not both. */
gn_place gn_plane_crossing(const gn_view *view, const gn_place *a, const gn_place *b, int64_t da, int64_t db,
                           int plane);

void gn_clip_triangle(gn_polygon *polygon, const gn_view *view, const gn_place corner[3]);

/* The rows of the fan's piece (v[0], v[i], v[i + 1]) inside a window; 0 if there are none, or if snapping turned it
 * over. */
int gn_find_piece(gn_rows *rows, const gn_polygon *polygon, int32_t i, const gn_window *window);

/* The depth plane of all pieces, area != 0; steep ones are flat. The polygon's other corners were snapped, so where the
 * plane is steep and ends in the near or far plane they lie beyond the range: then it is moved back into it, or flat,
 * so that it does not wrap over the polygon. At v[0] it is within the range. */
void gn_make_clipped_plane(gn_depth_plane *plane, const gn_polygon *polygon);

/* For Q: where the plane leaves the corners' range by more than a sixteenth of it, the triangle is all but
 * edge-on: its farthest Q; where it falls below the least Q of a surface, it is moved up. */
void gn_fit_q_plane(gn_q_plane *plane, const gn_polygon *polygon, uint32_t least);

#endif
