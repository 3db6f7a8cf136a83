/* A view: how world coordinates become vertices on the screen of a camera or on the map of a light.
 *
 * Affine views (orthographic camera, directional light) go from the world to 1/256 pixel in one step: the crop is part
 * of the rows, so nothing is lost to an intermediate rounding. Projective views (perspective camera, spot light) go to
 * view units X, Y, W, |.| <= 2^30, with |X| <= W and |Y| <= W inside the frustum, and divide by one exact reciprocal.
 */
#ifndef GN_VIEW_H
#define GN_VIEW_H

#include "gn_raster.h"
#include "gn_scaled.h"
#include "gnomon.h"

#define GN_MAX_COORDINATE (1 << 20) /* of vertices from the centre of the screen, 1/256 pixel */
#define GN_DEPTH_GUARD (1 << 14)    /* Z lies in [guard, 2^31 - guard], so that z cannot wrap */
#define GN_DEPTH_SPAN (0x80000000u - 2 * GN_DEPTH_GUARD)

/* floor((m P + offset) / 2^shift) */
typedef struct gn_row {
    int64_t offset;
    int32_t m[3];
    uint8_t shift;
} gn_row;

typedef struct gn_view {
    gn_row row[3]; /* affine: x, y (1/256 pixel from the centre), depth; projective: X, Y, W */
    int32_t centre_x, centre_y;
    /* projective: */
    uint8_t affine, post_projective_depth;
    uint8_t endless;                 /* no far plane; affine: no near plane either. Clipping alone asks */
    int32_t half_width, half_height; /* 128 pixels: 1/256 pixel at the border */
    int32_t near_w, far_w;           /* view units */
    int32_t guard;                   /* |X| <= guard W is projected, the rest clipped: 2 to 7 */
    gn_scaled unit;                  /* view units a world unit along W */
    uint32_t depth_scale;            /* post-projective: Z = guard + floor(scale (2^30 - Q) / 2^shift) */
    uint8_t depth_shift;
} gn_view;

/* GN_OUT_OF_RANGE where a number of the camera or light is outside its stated range. */
gn_status gn_make_camera_view(gn_view *view, const gn_camera *camera, int32_t width, int32_t height);
gn_status gn_make_light_view(gn_view *view, const gn_light *light, int32_t width, int32_t height);

GN_INLINE int64_t gn_apply_row(const gn_row *row, const int32_t p[3])
{
    int64_t sum =
        row->offset + gn_multiply(row->m[0], p[0]) + gn_multiply(row->m[1], p[1]) + gn_multiply(row->m[2], p[2]);
    return gn_floor_shift_64(sum, row->shift);
}

/* The place of a world position before division and clipping: affine x, y, depth, |.| <= 2^44; or X, Y, W, |.| <= 2^30.
 */
typedef struct gn_place {
    int64_t c[3];
} gn_place;

/* GN_OUT_OF_RANGE where an affine view magnifies the position beyond 2^44. */
gn_status gn_view_place(const gn_view *view, const int32_t world[3], gn_place *place);

/* Project; depth 0 where the place is outside the near and far planes or the guard band. */
void gn_view_project(const gn_view *view, const gn_place *place, gn_vertex *vertex);

/* The same for a place that is known to be inside, as clipping leaves it. */
void gn_view_project_inside(const gn_view *view, const gn_place *place, gn_vertex *vertex);

#endif
