/* Reconstruction by a silhouette map (Sen et al. 2003, 3.2, figure 5).
 *
 * The place lies in a cell between four texels. Where their comparisons differ, a silhouette passes through the cell.
 * The lines from the cell's point to the points of its four neighbours cut it into four skewed quadrants, and the place
 * takes the answer of the texel in its quadrant. A line leaves the cell where it enters the neighbour, whose own line
 * goes on from there: borders of shadows are continuous. Without silhouettes all points are centres, the quadrants are
 * quarters, and the answer is the nearest texel's.
 *
 * Of the paper's eight regions and five points the place asks for two lines and three points: the line to the side, left
 * or right, on which it lies of the point, says whether it is above or below; then the line up or down, where it
 * reaches the place's height, whether it is left or right. Both tests are exact. */
#include "gn_around.h"
#include "gn_silhouette_map.h"

/* The point of a cell, by its index in the map; above and left of the first cell there is none. */
GN_INLINE uint32_t cell_at(const gn_lookup *l, int32_t at)
{
    return at < 0 ? GN_CELL_CENTRE : l->silhouettes[at];
}

/* The texel in whose quadrant a place lies: 1 right, + 2 below. x, y: within the cell, bits fraction bits. */
static uint32_t find_quadrant(const gn_lookup *l, uint32_t column, uint32_t row, uint32_t u, uint32_t v)
{
    int32_t width = (int32_t)l->last_column + 1, at = (int32_t)row * width + (int32_t)column;
    uint32_t mask = ((uint32_t)1 << l->bits) - 1, to_sixteenths = l->bits - 4;
    uint32_t point = l->silhouettes[at], other;
    int32_t px = (int32_t)(point & 15), py = (int32_t)(point >> 4);
    int32_t x = (int32_t)(u & mask) - (int32_t)((uint32_t)px << to_sixteenths);
    int32_t y = (int32_t)(v & mask) - (int32_t)((uint32_t)py << to_sixteenths);
    int right = x >= 0;
    other = cell_at(l, right ? at + 1 : at - 1);
    int32_t dx = (int32_t)(other & 15) - px + (right ? 16 : -16), dy = (int32_t)(other >> 4) - py;
    int32_t side = dx * y - dy * x;
    int below = right ? side > 0 : side < 0;
    if (below ? y <= 0 : y >= 0)
        return (uint32_t)right | (uint32_t)below << 1; /* the line down or up does not come here */
    other = cell_at(l, below ? at + width : at - width);
    dx = (int32_t)(other & 15) - px;
    dy = (int32_t)(other >> 4) - py + (below ? 16 : -16);
    side = dy * x - dx * y;
    right = below ? side >= 0 : side <= 0;
    return (uint32_t)right | (uint32_t)below << 1;
}

static uint32_t sample(const gn_lookup *l, gn_points *points, int32_t i, const gn_wide_plane *plane)
{
    uint32_t u = points->u[i], v = points->v[i], column = u >> l->bits, row = v >> l->bits;
    if (GN_UNLIKELY(column >= l->last_column || row >= l->last_row))
        return gn_sample_nearest(l, points, i, plane);
    const gn_depth *above = l->map + row * l->stride + column, *below = above + l->stride;
    int64_t z = gn_wide_depth(plane, (int32_t)column, (int32_t)row), z_below = z + plane->dy;
    uint32_t dark = (uint32_t)(gn_cut(gn_saturate(z)) > above[0]);
    dark |= (uint32_t)(gn_cut(gn_saturate(z + plane->dx)) > above[1]) << 1;
    dark |= (uint32_t)(gn_cut(gn_saturate(z_below)) > below[0]) << 2;
    dark |= (uint32_t)(gn_cut(gn_saturate(z_below + plane->dx)) > below[1]) << 3;
    if (dark == 0 || dark == 15)
        return dark ? GN_DARK : 0;
#if GN_STATISTICS
    points->reconstructed[i] = 1;
#endif
    return dark >> find_quadrant(l, column, row, u, v) & 1 ? GN_DARK : 0;
}

const gn_reconstruction gn_silhouettes = {gn_cascade_row, gn_vote_around, sample, gn_colour_row, GN_DARK, 4, 4, 1,
                                          &gn_draw_silhouettes};
