/* The nearest texel: the one that holds the point decides, by the point's own depth. What gn_shade.c does in one go
 * where neither a fit nor a warp stands between the light's plane and the map. */
#include "gn_parameterisation.h"

static void vote(const gn_lookup *l, gn_points *points)
{
    for (int32_t i = 0; i < points->count; i++) {
        if (points->u[i] == GN_NOWHERE) {
            points->dark[i] = gn_dark_nowhere(l, points->z[i]);
            continue;
        }
        uint32_t column = gn_texel(points->u[i], l->last_column, l->bits);
        uint32_t row = gn_texel(points->v[i], l->last_row, l->bits);
        points->dark[i] = gn_cut(points->z[i]) <= l->map[row * l->stride + column] ? 0 : GN_DARK;
    }
}

const gn_reconstruction gn_nearest = {gn_cascade_row, vote, 0, gn_colour_row, GN_DARK, 1, 0, 0, 0};
