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

static uint32_t sample(const gn_lookup *l, gn_points *points, int32_t i, const gn_wide_plane *plane)
{
    uint32_t dark;
    if (!gn_disagree(l, points, i, plane, &dark))
        return dark;
    return dark >> gn_find_quadrant(l, points->u[i], points->v[i]) & 1 ? GN_DARK : 0;
}

const gn_reconstruction gn_silhouettes = {gn_cascade_row, gn_vote_around,      sample, gn_colour_row, GN_DARK, 4, 4,
                                          gn_settle,      &gn_draw_silhouettes};
