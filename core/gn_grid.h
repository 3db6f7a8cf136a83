/* The grid of a warped map: where its texels lie.
 *
 * A warped map is some of the texels of a uniform map of GN_FINE x GN_FINE over the same rectangle of the light's
 * plane: those in some of its columns and rows. So the top-left rule, planes and virtual samples are those of a uniform
 * map, bit for bit, at unequal steps. In the camera pass a point's place in fine texels becomes one in texels, linear
 * between the centres of neighbours: votes, filters and cells work as on a uniform map. */
#ifndef GN_GRID_H
#define GN_GRID_H

#include "gn_raster.h"

#define GN_FINE_BITS 12
#define GN_FINE (1 << GN_FINE_BITS) /* at least GN_MAX_SIZE: texels lie in fine ones of their own */

typedef struct gn_grid gn_grid;
struct gn_layer_target;
struct gn_lookup;
struct gn_unequal_cells;
struct gn_points;

struct gn_grid {
    /* rectilinear, else 0: the fine column (row) at whose centre each column (row) of texels lies, strictly increasing
     */
    const uint16_t *columns, *rows;
    /* non-orthogonal, else 0: fine column of texel column i in band b of GN_FINE / height fine rows, at [b width + i];
     * fine row of texel row j in texel column i, at [i height + j] */
    const uint16_t *across, *down;
    int32_t width, height;                /* texels */
    const struct gn_unequal_cells *cells; /* rectilinear: gn_rectilinear_cells */

    /* Light pass: have a target, whose rows are those of *window, keep these, and turn the window into fine texels;
     * insert a clockwise triangle whose plane is set. */
    void (*aim)(struct gn_layer_target *t, gn_window *window);
    void (*walk)(const struct gn_layer_target *t, const gn_rows *rows);
    /* Camera pass: from places in fine texels to places in texels. */
    void (*place)(const struct gn_lookup *lookup, struct gn_points *points);
    /* Open the points again of whose votes nothing follows before virtual samples; 0: none. */
    void (*doubt)(const struct gn_lookup *lookup, struct gn_points *points);
    /* gn_sample, by a plane in fine texels. */
    uint32_t (*sample)(const struct gn_lookup *lookup, struct gn_points *points, int32_t i, const gn_wide_plane *plane);
};

/* The last of count strictly increasing numbers that is at most v; -1: none. from: where to begin. */
GN_INLINE int32_t gn_find_step(const uint16_t *table, int32_t count, int32_t v, int32_t from)
{
    int32_t low = -1, high = count;                                /* table[low] <= v < table[high] */
    for (int32_t step = 1; from >= 0 && from < count; step *= 2) { /* neighbours of the last place are near */
        if (table[from] <= v) {
            low = from;
            if (high < count)
                break;
            from += step;
        } else {
            high = from;
            if (low >= 0)
                break;
            from -= step;
        }
    }
    while (high - low > 1) {
        int32_t middle = (low + high) >> 1;
        if (table[middle] <= v)
            low = middle;
        else
            high = middle;
    }
    return low;
}

#endif
