/* What shadow volumes keep in a context's block (gn_volumes.c), laid out by gn_plan.c. */
#ifndef GN_VOLUMES_H
#define GN_VOLUMES_H

#include "gn_nearness.h"
#include "gn_silhouette.h"

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
    gn_view view; /* the camera's, without a far plane: faces behind every visible point count */
    uint8_t *facings;
    gn_silhouette *silhouettes;
    uint32_t silhouette_count, edge_bits;
    uint32_t crossing; /* triangles that the light's near plane cuts */
    uint16_t outside;  /* with what a pixel's count begins */
    gn_volumes_worker *workers;
} gn_volumes;

#endif
