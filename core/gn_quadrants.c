/* Reconstruction by a silhouette map (Sen et al. 2003, 3.2, figure 5).
 *
 * The place lies in a cell between four texels. Where their comparisons differ, a silhouette passes through the cell.
 * The lines from the cell's point to the points of its four neighbours cut it into four skewed quadrants, and the place
 * takes the answer of the texel in its quadrant. A line leaves the cell where it enters the neighbour, whose own line
 * goes on from there: borders of shadows are continuous. Without silhouettes all points are centres, the quadrants are
 * quarters, and the answer is the nearest texel's.
 *
 * Of the paper's eight regions and five points the place asks for two lines and three points: the line to the side,
 * left or right, on which it lies of the point, says whether it is above or below; then the line up or down, where it
 * reaches the place's height, whether it is left or right. Both tests are exact. */
#include "gn_quadrants.h"

/* Beyond a map's cells they are as wide, or as high, as the outermost. */
GN_COLD uint32_t gn_find_quadrant_on_grid(const gn_lookup *l, uint32_t u, uint32_t v)
{
    const uint16_t *const centres[2] = {l->columns, l->rows};
    const uint32_t cell[2] = {u >> l->bits, v >> l->bits}, last[2] = {l->last_column - 1, l->last_row - 1};
    const int32_t step[2] = {1, (int32_t)l->last_column + 1}, at = (int32_t)cell[1] * step[1] + (int32_t)cell[0];
    uint32_t mask = ((uint32_t)1 << l->bits) - 1, to_sixteenths = l->bits - 4, point = l->silhouettes[at];
    const int32_t p[2] = {(int32_t)(point & 15), (int32_t)(point >> 4)};
    /* from the point, in 2^-bits of the cell's width and height */
    const int32_t way[2] = {(int32_t)(u & mask) - (int32_t)((uint32_t)p[0] << to_sixteenths),
                            (int32_t)(v & mask) - (int32_t)((uint32_t)p[1] << to_sixteenths)};
    int forth[2] = {way[0] >= 0, 0};
    for (int k = 0; k < 2; k++) {
        uint32_t other = gn_cell_at(l, forth[k] ? at + step[k] : at - step[k]);
        uint32_t next = forth[k] ? cell[k] + (cell[k] < last[k]) : cell[k] - (cell[k] > 0);
        int32_t to = (int32_t)(k ? other >> 4 : other & 15), aside = (int32_t)(k ? other & 15 : other >> 4) - p[!k];
        int32_t width = centres[k][cell[k] + 1] - centres[k][cell[k]], beyond = centres[k][next + 1] - centres[k][next];
        /* along the axis in 1/16 fine texel; across it the shares of one height are as good */
        int32_t along = forth[k] ? (16 - p[k]) * width + to * beyond : (to - 16) * beyond - p[k] * width;
        int64_t side = gn_multiply(along, way[!k]) - gn_multiply(aside * width, way[k]);
        forth[!k] = forth[k] ? side >= 0 : side <= 0;
        if (k == 0 && (forth[1] ? way[1] <= 0 : way[1] >= 0))
            break; /* the line down or up does not come here */
    }
    return (uint32_t)forth[0] | (uint32_t)forth[1] << 1;
}

static uint32_t sample(const gn_lookup *l, gn_points *points, int32_t i, const gn_wide_plane *plane)
{
    uint32_t dark;
    if (!gn_disagree(l, points, i, plane, &dark))
        return dark;
    return dark >> gn_find_quadrant(l, points->u[i], points->v[i]) & 1 ? GN_DARK : 0;
}

const gn_reconstruction gn_silhouettes = {gn_cascade_row, gn_vote_around,      sample, gn_colour_row, GN_DARK, 4, 4,
                                          gn_settle,      &gn_draw_silhouettes};
