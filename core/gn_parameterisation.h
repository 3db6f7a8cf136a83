/* Fits and warps: from what the camera sees to where the texels of the map lie (docs/parameterisations.md).
 *
 * The light's plane is its box or its frustum. Places on it count in 2^-30 of its larger side from the upper left
 * corner. A fit finds the rectangle that the map covers, in one round of the view pass; a warp then finds where in that
 * rectangle the texels lie, in one round or two. What the samples of a round are summed up in does not depend on their
 * order; each worker has its own sums, and they are merged. */
#ifndef GN_PARAMETERISATION_H
#define GN_PARAMETERISATION_H

#include "gn_cascade.h"

#define GN_WHOLE ((int32_t)1 << 30) /* a side */

typedef struct gn_parameterisation gn_parameterisation;

/* The hooks of what has a fit or a warp, one set for all. */
struct gn_parameterisation {
    /* Of gn_make_plan, when all else is planned: settings that make no sense; rounds and bytes. head: what stays. */
    gn_status (*plan)(gn_plan *plan, const gn_settings *settings, uint64_t head);
    /* Take from the block, beginning at used, what stays, and return the sum. With a null context count alone. */
    uint64_t (*lay_out_head)(gn_context *context, uint64_t used, const gn_settings *settings);
};

/* One round of the view pass. Sums are the worker's own. Of a block's points those that see a surface within the
 * light's reach have u that is not GN_NOWHERE; w: their W, of perspective cameras. */
typedef struct gn_round {
    uint64_t (*bytes)(const gn_settings *settings);
    void (*clear)(const gn_settings *settings, void *sums);
    void (*add)(const gn_context *context, void *sums, const gn_points *points, const uint32_t *w);
    void (*merge)(const gn_settings *settings, void *sums, const void *other);
    /* From all sums to the fit or the tables. */
    void (*end)(gn_context *context, void *sums);
} gn_round;

struct gn_fit {
    const gn_parameterisation *hooks;
    gn_round round;
};

struct gn_warp {
    const gn_parameterisation *hooks;
    uint64_t (*table_bytes)(const gn_settings *settings);
    void (*lay_out)(gn_context *context, uint16_t *tables); /* the grid */
    const gn_round *rounds;
    uint8_t round_count;
    uint8_t bent; /* non-orthogonal: cells have no straight sides */
};

/* The least and the largest of some depths. */
typedef struct gn_depth_extent {
    uint32_t low, high;
} gn_depth_extent;

/* How far a neighbour that was clamped may be off by that, units of z: Z are cut by 2^10 units at most where the scene
 * lies in the light's box, and gradients err by 2^-29 of what the plane rises over a triangle, 2^42. */
#define GN_CLAMPED_ERROR ((1 << 11) + (1 << 13))

/* The plane of a triangle with a corner beyond the depths of a view, and its polygon on the map, whose area is 0 where
 * it has none. *error: how far off its corners may be, units of z. 1: too steep, it is flat. */
struct gn_polygon;
typedef int gn_clamped_plane(gn_wide_plane *plane, struct gn_polygon *polygon, const gn_view *view,
                             const gn_place corner[3], int64_t *error);

#define GN_SEEN_AND_KEPT 2 /* gn_static_casters.c: and layers on its warp are kept */

struct gn_fitting {
    gn_rectangle rectangle;
    gn_grid grid;
    uint16_t *columns, *rows;                    /* the grid's, as they are made: or across and down */
    uint8_t fitted;                              /* 0: the rectangle is the whole plane */
    uint8_t *sums;                               /* view pass: of worker 0; the others' follow */
    uint64_t sums_bytes;                         /* of one worker */
    uint8_t round;                               /* view pass: which */
    uint8_t seen;                                /* a view pass has ended: 1, or GN_SEEN_AND_KEPT */
    gn_status (*make_view)(gn_context *context); /* the light's, for the light pass */
    /* Fitted depth: the light's box along the light, world units; a depth of 0: its own. What the camera sees, units of
     * z of the light's own box; low > high: nothing. The plane of a triangle with a corner beyond (gn_fit_depth.c). */
    int32_t box_z, box_depth;
    gn_depth_extent seen_depths;
    gn_clamped_plane *clamped_plane;
    /* Spot lights: from a place in the rectangle to the one on the whole plane, both in 2^-30; 0: it is not on it. */
    int (*find_place)(const gn_fitting *fitting, uint32_t *left, uint32_t *top);
    /* of the view pass: */
    gn_light light;
    int32_t largest_w; /* of all vertices in the camera's view */
    uint32_t reach[2]; /* what lies at or beyond these places is not on the light's plane; 2^-30 of the view's sides */
};

/* Of settings with a shadow map; 0: neither fit nor warp. */
const gn_parameterisation *gn_find_parameterisation(const gn_settings *settings);

/* The hooks. */
extern const gn_parameterisation gn_fit_and_warp;

/* gn_fit.c: a light's view of the rectangle, width x height. Directional: *light becomes the one whose box it is. */
gn_status gn_make_fitted_view(gn_view *view, gn_light *light, const gn_rectangle *rectangle, int32_t width,
                              int32_t height);
/* Make a rectangle that holds all places the map's: a texel more on each side. */
void gn_set_rectangle(gn_context *context, const gn_rectangle *found);
int gn_find_place_on_plane(const gn_fitting *fitting, uint32_t *left, uint32_t *top);

/* gn_fit_depth.c: the box along the light from seen_depths, when the rectangle is found; use it for the light pass. */
void gn_fit_depth(gn_context *context);
gn_status gn_use_fitted_depth(gn_context *context);

/* The whole plane of a light. */
void gn_whole_plane(gn_rectangle *rectangle, const gn_light *light);

/* The band of a fine row. */
GN_INLINE int32_t gn_band(const gn_grid *grid, int32_t fine_row)
{
    return (int32_t)((uint32_t)(fine_row * grid->height) >> GN_FINE_BITS);
}

/* The texel of a warped map at (column, row): its fine column and row. */
void gn_find_fine(const gn_grid *grid, int32_t column, int32_t row, int32_t fine[2]);

/* The two neighbours in a table that a place lay between last: nearby places mostly do too. Begin with all 0. */
typedef struct gn_interval {
    const uint16_t *table;
    int32_t texel;         /* the left one's number; at the left border 0 */
    uint32_t start, reach; /* in places; reach 2^31: up to the right border */
    uint32_t place, width; /* of its start in texels; in fine texels */
} gn_interval;

void gn_find_interval(gn_interval *interval, const uint16_t *table, int32_t count, uint32_t place, uint32_t bits);

/* From a place in fine texels to one in texels, both from the first centre. Beyond the outermost centres the map ends
 * half a texel further. */
GN_INLINE uint32_t gn_find_grid_place(gn_interval *interval, const uint16_t *table, int32_t count, uint32_t place,
                                      uint32_t bits)
{
    if (interval->table != table || place - interval->start >= interval->reach)
        gn_find_interval(interval, table, count, place, bits);
    return interval->place + (place - interval->start) / interval->width;
}

/* A point's place on the light's view, 2^-30 of its sides, both being GN_FINE texels. */
GN_INLINE uint32_t gn_share(uint32_t place, uint32_t bits)
{
    return (place + ((uint32_t)1 << (bits - 1))) << (30 - GN_FINE_BITS - bits);
}

/* The bin of a place on the rectangle, in 2^-30 of its side. */
GN_INLINE uint32_t gn_bin(uint32_t share, uint32_t bins)
{
    return (uint32_t)(gn_multiply_u(share, bins) >> 30);
}

#endif
