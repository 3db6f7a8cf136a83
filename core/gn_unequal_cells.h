/* Cells of unequal width and height, between the texels of a rectilinear grid: what silhouette and crossing maps need
 * for them beyond what serves cells of one texel. Linked only with such grids. */
#ifndef GN_UNEQUAL_CELLS_H
#define GN_UNEQUAL_CELLS_H

#include "gn_segment.h"

struct gn_lookup;
struct gn_unequal_cells {
    /* gn_centre_before, by a texel: the last of the axis' centres at or before it; first - 1: none. A bisection. */
    int32_t (*centre_before)(const gn_axis *axis, int32_t texel);
    /* The ways from a segment's upper end to the diagonals of a cell. x, y: of that end, from the cell's corner. */
    void (*find_ways)(gn_ways *ways, const gn_segment *segment, const gn_cell *cell, int32_t x, int32_t y);
    /* gn_find_quadrant: lines are straight on the light's plane. */
    uint32_t (*find_quadrant)(const struct gn_lookup *lookup, uint32_t u, uint32_t v);
};

extern const gn_unequal_cells gn_rectilinear_cells;

#endif
