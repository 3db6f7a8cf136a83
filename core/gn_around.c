#include "gn_around.h"

uint32_t gn_look_at_border(const gn_lookup *l, uint32_t u, uint32_t v, uint32_t z)
{
    const gn_depth *above =
        l->map + gn_first_of_two(v, l->last_row, l->bits) * l->stride + gn_first_of_two(u, l->last_column, l->bits);
    return gn_agree(above, above + l->stride, z) ? GN_OPEN : 0;
}

uint32_t gn_look_beyond(const gn_lookup *l, uint32_t column, uint32_t row, uint32_t z)
{
    uint32_t width = l->last_column + 1, first = row * width + column, last = gn_last_footprint(l);
    gn_depth texel[4];
    first = first > last ? last : first;
    for (uint32_t k = 0; k < 4; k++)
        texel[k] = l->map[gn_index(first + k % 2, k / 2, width, l->stride, 0xffffffffu)];
    return gn_agree(texel, texel + 2, z);
}

void gn_vote_around(const gn_lookup *lookup, gn_points *points)
{
    const gn_lookup l = *lookup;
    for (int32_t i = 0; i < points->count; i++) {
        uint32_t u = points->u[i], z = points->z[i], vote;
        if (GN_UNLIKELY(u == GN_NOWHERE))
            vote = gn_dark_nowhere(lookup, z);
        else
            vote = gn_look(&l, u, points->v[i], gn_cut(z));
        gn_vote_is(points, i, vote, GN_DARK);
    }
}

uint32_t gn_sample_nearest(const gn_lookup *l, gn_points *points, int32_t i, const gn_wide_plane *plane)
{
    uint32_t column = gn_texel(points->u[i], l->last_column, l->bits);
    uint32_t row = gn_texel(points->v[i], l->last_row, l->bits);
    uint32_t z = gn_cut(gn_saturate(gn_wide_depth(plane, (int32_t)column, (int32_t)row)));
    return z <= l->map[row * l->stride + column] ? 0 : GN_DARK;
}

void gn_settle(const gn_reconstruction *how, const gn_lookup *lookup, gn_points *points)
{
    for (int32_t n = 0; n < points->open_count; n++) {
        int32_t i = points->open[n];
        gn_wide_plane level = {points->z[i], 0, 0};
        points->dark[i] = how->sample(lookup, points, i, &level);
    }
}

void gn_vote_nearest(const gn_lookup *l, gn_points *points)
{
    for (int32_t i = 0; i < points->count; i++) {
        if (points->u[i] == GN_NOWHERE) { /* and no v */
            points->dark[i] = gn_dark_nowhere(l, points->z[i]);
            continue;
        }
        uint32_t column = gn_texel(points->u[i], l->last_column, l->bits);
        uint32_t row = gn_texel(points->v[i], l->last_row, l->bits);
        points->dark[i] = gn_cut(points->z[i]) <= l->map[row * l->stride + column] ? 0 : GN_DARK;
    }
}
