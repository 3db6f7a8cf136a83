/* What shadow volumes keep in a context's block (gn_volumes.c), laid out by gn_plan.c. */
#ifndef GN_VOLUMES_H
#define GN_VOLUMES_H

#include "gn_silhouette.h"
#include "gn_volume_count.h"

/* The plane of a triangle in view, kept per worker: a direct-mapped cache like that of colours, as large. */
typedef struct gn_seen_plane {
    gn_nearness plane;
    gn_reach reach;
    uint32_t triangle;
    uint8_t counts; /* camera and light are on the same side: else it is shadowed without counting */
} gn_seen_plane;

typedef struct gn_volumes_worker {
    int64_t *point;  /* nearness of the visible point of each pixel of a region */
    uint16_t *count; /* of volumes that hold it, modulo 2^16 */
    gn_seen_plane *planes;
} gn_volumes_worker;

typedef struct gn_volumes {
    gn_eye eye;
    gn_view view;  /* the camera's, without a far plane: faces behind every visible point count */
    gn_place axis; /* of the light's forward, at infinity */
    uint8_t *facings;
    gn_silhouette *silhouettes;
    uint32_t silhouette_count, edge_bits;
    uint32_t crossing; /* triangles that the light's near plane cuts */
    uint16_t outside;  /* with what a pixel's count begins */
    gn_volumes_worker *workers;
} gn_volumes;

/* What the frustum of a spot light counts: more than casters can cancel, however snapping has turned their faces. */
#define GN_FRUSTUM_WINDING 0x4000

/* A region at work. */
typedef struct gn_volume_region {
    const gn_context *context;
    const gn_volumes *volumes;
    const gn_window *window;
    gn_volume_target target;
} gn_volume_region;

/* A side between two corners, and its part of the lid. reach: of what it hangs from and of both ways on. */
void gn_count_side(gn_volume_region *r, const gn_corner *a, const gn_corner *b, int32_t winding, const gn_reach *reach);

/* A cap that is clipped, a polygon: behind the visible point wherever it is seen at all. An orthographic camera's near
 * plane does not clip it, so there the part beyond that plane counts. world: of the whole triangle. */
void gn_count_cap(gn_volume_region *r, gn_face *cap, uint32_t identifier, int32_t world[3][3], int32_t winding);

/* gn_volumes_spot.c: volumes of triangles that the near plane of a spot light cuts; the frustum; and how often the
 * part of a lid over the edge from a to b covers the one direction in which an orthographic
 * camera looks, and the same of all cut triangles. */
void gn_count_cut_volumes(gn_volume_region *r);
void gn_count_frustum(gn_volume_region *r);
uint32_t gn_lid_along_view(const gn_context *context, const gn_corner *a, const gn_corner *b, int32_t winding);
uint32_t gn_cut_lids_along_view(const gn_context *context);

#endif
