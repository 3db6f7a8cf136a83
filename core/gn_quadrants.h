/* The four texels about a cell of a silhouette map, and the skewed quadrants between them (gn_quadrants.c). */
#ifndef GN_QUADRANTS_H
#define GN_QUADRANTS_H

#include "gn_around.h"
#include "gn_silhouette_map.h"
#include "gn_unequal_cells.h"

/* Whether a place has four texels about it. */
GN_INLINE int gn_has_cell(const gn_lookup *l, uint32_t u, uint32_t v)
{
    return u >> l->bits < l->last_column && v >> l->bits < l->last_row;
}

/* The texels of a place's cell that shadow a plane: 1 upper left, + 2 upper right, + 4 lower left, + 8 lower right. */
GN_INLINE uint32_t gn_find_corners(const gn_lookup *l, uint32_t u, uint32_t v, const gn_wide_plane *plane)
{
    uint32_t column = u >> l->bits, row = v >> l->bits;
    const gn_depth *above = l->map + row * l->stride + column, *below = above + l->stride;
    int64_t z = gn_wide_depth(plane, (int32_t)column, (int32_t)row), z_below = z + plane->dy;
    uint32_t dark = (uint32_t)(gn_cut(gn_saturate(z)) > above[0]);
    dark |= (uint32_t)(gn_cut(gn_saturate(z + plane->dx)) > above[1]) << 1;
    dark |= (uint32_t)(gn_cut(gn_saturate(z_below)) > below[0]) << 2;
    dark |= (uint32_t)(gn_cut(gn_saturate(z_below + plane->dx)) > below[1]) << 3;
    return dark;
}

/* Do the texels about point i disagree on a plane? Then *dark has the corners, else the shares of a single texel. */
GN_INLINE int gn_disagree(const gn_lookup *l, gn_points *points, int32_t i, const gn_wide_plane *plane, uint32_t *dark)
{
    uint32_t u = points->u[i], v = points->v[i];
    if (GN_UNLIKELY(!gn_has_cell(l, u, v))) {
        *dark = gn_sample_nearest(l, points, i, plane);
        return 0;
    }
    *dark = gn_find_corners(l, u, v, plane);
    if (*dark == 0 || *dark == 15) {
        *dark = *dark ? GN_DARK : 0;
        return 0;
    }
#if GN_STATISTICS
    points->reconstructed[i] = 1;
#endif
    return 1;
}

/* The point of a cell, by its index in the map; above and left of the first cell there is none. */
GN_INLINE uint32_t gn_cell_at(const gn_lookup *l, int32_t at)
{
    return at < 0 ? GN_CELL_CENTRE : l->silhouettes[at];
}

/* The texel in whose quadrant a place lies: 1 right, + 2 below. A place on a line is right of it, or below, as a place
 * half-way between two texels is the next one's. */
GN_INLINE uint32_t gn_find_quadrant(const gn_lookup *l, uint32_t u, uint32_t v)
{
    if (GN_UNLIKELY(l->columns != 0))
        return l->grid->cells->find_quadrant(l, u, v);
    int32_t width = (int32_t)l->last_column + 1, at = (int32_t)(v >> l->bits) * width + (int32_t)(u >> l->bits);
    uint32_t mask = ((uint32_t)1 << l->bits) - 1, to_sixteenths = l->bits - 4;
    uint32_t point = l->silhouettes[at], other;
    int32_t px = (int32_t)(point & 15), py = (int32_t)(point >> 4);
    int32_t x = (int32_t)(u & mask) - (int32_t)((uint32_t)px << to_sixteenths);
    int32_t y = (int32_t)(v & mask) - (int32_t)((uint32_t)py << to_sixteenths);
    int right = x >= 0;
    other = gn_cell_at(l, right ? at + 1 : at - 1);
    int32_t dx = (int32_t)(other & 15) - px + (right ? 16 : -16), dy = (int32_t)(other >> 4) - py;
    int32_t side = dx * y - dy * x;
    int below = right ? side >= 0 : side <= 0;
    if (below ? y <= 0 : y >= 0)
        return (uint32_t)right | (uint32_t)below << 1; /* the line down or up does not come here */
    other = gn_cell_at(l, below ? at + width : at - width);
    dx = (int32_t)(other & 15) - px;
    dy = (int32_t)(other >> 4) - py + (below ? 16 : -16);
    side = dy * x - dx * y;
    right = below ? side >= 0 : side <= 0;
    return (uint32_t)right | (uint32_t)below << 1;
}

#endif
