/* Percentage-closer filtering over a box: N x N texels about the one that holds the point, alike (Reeves et al. 1987).
 * The texels of the border stand for those beyond it; those of a warped map count alike, whatever their size. Cost: N x
 * N comparisons. */
#include "gn_cascade.h"

/* The part of a box along one axis that lies on the map, and how often its ends count for what lies beyond. */
typedef struct side {
    uint32_t first, last;
    uint32_t before, beyond;
} side;

GN_INLINE side make_side(uint32_t u, uint32_t end, uint32_t bits, uint32_t radius)
{
    uint32_t texel = gn_texel(u, end, bits);
    side s = {0, end, 0, 0};
    if (texel >= radius)
        s.first = texel - radius;
    else
        s.before = radius - texel;
    if (texel + radius <= end)
        s.last = texel + radius;
    else
        s.beyond = texel + radius - end;
    return s;
}

/* The shadowed texels of a box by a plane, or, where that is 0, by one depth. */
GN_INLINE uint32_t count_dark(const gn_lookup *l, uint32_t u, uint32_t v, uint32_t z, const gn_wide_plane *plane,
                              uint32_t radius)
{
    side across = make_side(u, l->last_column, l->bits, radius), down = make_side(v, l->last_row, l->bits, radius);
    const gn_depth *line = l->map + down.first * l->stride;
    int64_t start = plane ? gn_wide_depth(plane, (int32_t)across.first, (int32_t)down.first) : 0;
    uint32_t dark = 0;
    z = gn_cut(z);
    for (uint32_t row = down.first; row <= down.last; row++, line += l->stride) {
        const gn_depth *texel = line + across.first, *end = line + across.last;
        int64_t depth = start;
        uint32_t in_row = 0, is = 0;
        for (; texel <= end; texel++) {
            if (plane) {
                z = gn_cut(gn_saturate(depth));
                depth += plane->dx;
            }
            is = z > *texel;
            in_row += texel == line + across.first ? is * (1 + across.before) : is;
        }
        in_row += is * across.beyond;
        dark += in_row * (1 + (row == down.first ? down.before : 0) + (row == down.last ? down.beyond : 0));
        if (plane)
            start += plane->dy;
    }
    return dark;
}

GN_INLINE void vote(const gn_lookup *lookup, gn_points *points, uint32_t radius)
{
    const gn_lookup l = *lookup;
    for (int32_t i = 0; i < points->count; i++) {
        uint32_t z = points->z[i];
        gn_vote_is(points, i,
                   points->u[i] == GN_NOWHERE ? gn_dark_nowhere(&l, z)
                                              : count_dark(&l, points->u[i], points->v[i], z, 0, radius),
                   l.whole);
    }
}

/* By a plane of a warped map's fine texels. */
static uint32_t count_dark_on_grid(const gn_lookup *l, uint32_t u, uint32_t v, const gn_wide_plane *plane,
                                   int32_t radius)
{
    int32_t last_column = (int32_t)l->last_column, last_row = (int32_t)l->last_row;
    int32_t column = (int32_t)gn_texel(u, l->last_column, l->bits), row = (int32_t)gn_texel(v, l->last_row, l->bits);
    uint32_t dark = 0;
    for (int32_t y = row - radius; y <= row + radius; y++)
        for (int32_t x = column - radius; x <= column + radius; x++) {
            int32_t i = x < 0 ? 0 : x < last_column ? x : last_column, j = y < 0 ? 0 : y < last_row ? y : last_row;
            uint32_t z = gn_saturate(gn_wide_depth(plane, l->columns[i], l->rows[j]));
            dark += gn_cut(z) > l->map[(uint32_t)j * l->stride + (uint32_t)i];
        }
    return dark;
}

static void vote_any(const gn_lookup *lookup, gn_points *points)
{
    vote(lookup, points, lookup->whole == 9 ? 1 : lookup->whole == 25 ? 2 : 3);
}

static uint32_t sample(const gn_lookup *l, gn_points *points, int32_t i, const gn_wide_plane *plane)
{
    uint32_t radius = l->whole == 9 ? 1 : l->whole == 25 ? 2 : 3;
    if (l->columns)
        return count_dark_on_grid(l, points->u[i], points->v[i], plane, (int32_t)radius);
    return count_dark(l, points->u[i], points->v[i], 0, plane, radius);
}

const gn_reconstruction gn_box_3x3 = {gn_cascade_row, vote_any, sample, gn_colour_fractions, 9, 9, 9, 0, 0};
const gn_reconstruction gn_box_5x5 = {gn_cascade_row, vote_any, sample, gn_colour_fractions, 25, 25, 25, 0, 0};
const gn_reconstruction gn_box_7x7 = {gn_cascade_row, vote_any, sample, gn_colour_fractions, 49, 49, 49, 0, 0};
