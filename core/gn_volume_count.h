/* Counting: what the faces of shadow volumes add to the pixels of a region. */
#ifndef GN_VOLUME_COUNT_H
#define GN_VOLUME_COUNT_H

#include "gn_face.h"
#include "gn_nearness.h"
#include "gn_tally.h"

typedef struct gn_volume_target {
    uint16_t *count;
    const int64_t *point;
    const uint32_t *triangle;
    int32_t stride, row0, column0;
    uint32_t weight; /* what a covered pixel gains, modulo 2^16 */
    uint32_t own[2]; /* the triangles on a side's edge, or a cap itself: behind their points */
    gn_nearness plane;
    gn_reach reach; /* in units of the plane's value */
    int64_t limit;  /* GN_BEYOND: nearness */
    GN_TALLY(gn_tally *tally;)
} gn_volume_target;

/* Where a face counts: in every pixel that it covers; where it is behind the visible point; or where it is beyond a
 * limit, whatever the point. */
typedef enum gn_depth_rule { GN_BEHIND, GN_COMPARED, GN_BEYOND } gn_depth_rule;

/* One triangle of a face: it counts as it turns on the screen, +winding where it turns away. */
void gn_count_piece(gn_volume_target *t, const gn_vertex *v0, const gn_vertex *v1, const gn_vertex *v2, int32_t winding,
                    const gn_window *window, gn_depth_rule by);

void gn_count_outline(gn_volume_target *t, const gn_outline *o, int32_t winding, const gn_window *window,
                      gn_depth_rule by);

/* Set the plane that pixels are compared with: normal n, and n . (V - eye) for any V on it. */
void gn_set_plane(gn_volume_target *t, const gn_eye *eye, const int64_t n[3], gn_wide distance, const gn_reach *reach);

#endif
