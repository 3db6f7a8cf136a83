/* Bilinear percentage-closer filtering: the four texels about the point, each comparison weighted by the point's place
 * between their centres, in 1/256 (Reeves et al. 1987; Weiskopf & Ertl 2003, section 5). Beyond the outermost centres
 * the map goes on as it ends. Cost: four comparisons, and weights only where they disagree. */
#include "gn_cascade.h"

enum { WHOLE = 1 << 16 };

typedef struct tent {
    const gn_depth *above, *below; /* two texels each */
    uint32_t column, row;          /* of the first */
    uint32_t x, y;                 /* weight of the second column and row, 0 to 256 */
} tent;

/* The weight of the second texel along one axis. */
GN_INLINE uint32_t weight(uint32_t place, uint32_t last, uint32_t bits)
{
    if (GN_LIKELY(place >> bits < last))
        return place >> (bits - 8) & 255u;
    return place >> 31 ? 0 : 256;
}

GN_INLINE tent make_tent(const gn_lookup *l, uint32_t u, uint32_t v)
{
    tent t;
    t.column = gn_first_of_two(u, l->last_column, l->bits);
    t.row = gn_first_of_two(v, l->last_row, l->bits);
    t.x = weight(u, l->last_column, l->bits);
    t.y = weight(v, l->last_row, l->bits);
    t.above = l->map + t.row * l->stride + t.column;
    t.below = t.above + l->stride;
    return t;
}

/* The shadowed shares, of four comparisons. */
GN_INLINE uint32_t weigh(const tent *t, int above0, int above1, int below0, int below1)
{
    uint32_t above = (above0 ? 256 - t->x : 0) + (above1 ? t->x : 0);
    uint32_t below = (below0 ? 256 - t->x : 0) + (below1 ? t->x : 0);
    return above * (256 - t->y) + below * t->y;
}

static void vote(const gn_lookup *lookup, gn_points *points)
{
    const gn_lookup l = *lookup;
    for (int32_t i = 0; i < points->count; i++) {
        uint32_t z = points->z[i];
        if (points->u[i] == GN_NOWHERE) {
            points->dark[i] = gn_dark_nowhere(&l, z);
            continue;
        }
        tent t = make_tent(&l, points->u[i], points->v[i]);
        z = gn_cut(z);
        int a = z > t.above[0], b = z > t.above[1], c = z > t.below[0], d = z > t.below[1];
        if ((a | b | c | d) == (a & b & c & d))
            points->dark[i] = a ? WHOLE : 0;
        else
            gn_vote_is(points, i, weigh(&t, a, b, c, d), WHOLE);
    }
}

static uint32_t sample(const gn_lookup *l, gn_points *points, int32_t i, const gn_wide_plane *plane)
{
    tent t = make_tent(l, points->u[i], points->v[i]);
    int64_t above = gn_wide_depth(plane, (int32_t)t.column, (int32_t)t.row), below = above + plane->dy;
    return weigh(&t, gn_cut(gn_saturate(above)) > t.above[0], gn_cut(gn_saturate(above + plane->dx)) > t.above[1],
                 gn_cut(gn_saturate(below)) > t.below[0], gn_cut(gn_saturate(below + plane->dx)) > t.below[1]);
}

const gn_reconstruction gn_bilinear = {gn_cascade_row, vote, sample, gn_colour_fractions, WHOLE, 4, 4, 0, 0};
