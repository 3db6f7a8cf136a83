/* Virtual samples (Wang & Molnar 1994, 3.2 and 3.4): the receiver's own plane, sampled where the map has samples.
 *
 * gn_virtual follows the paper's rule of three: texels vote with the point's depth; all lit: lit; all shadowed:
 * shadowed; else each texel that counts is compared with the depth of the plane at the texel's centre. Only these last
 * pixels need a plane. gn_virtual_always asks the plane at once: dearer, and right for every lone plane.
 *
 * With no reconstruction the four texels about the point vote and the one that holds it counts. Their votes take
 * the point to be nearer by the error of its depth, so that a level plane, where all five depths are one, is not
 * shadowed by its own rounding. */
#include "gn_cascade.h"

enum { OPEN = 1, WHOLE = 2 }; /* shares of one texel, so that there is a number for not knowing yet */

/* Whether four texels agree on a depth. */
GN_INLINE uint32_t agree(const gn_depth *above, const gn_depth *below, uint32_t depth)
{
    uint32_t z = gn_cut(depth);
    if (z <= above[0])
        return z <= above[1] && z <= below[0] && z <= below[1] ? WHOLE : OPEN;
    z = gn_cut(depth < GN_POINT_ERROR ? 0 : depth - GN_POINT_ERROR);
    return z > above[0] && z > above[1] && z > below[0] && z > below[1] ? 0 : OPEN;
}

/* At the border the four texels nearest to the point vote. */
static GN_NOINLINE uint32_t vote_at_border(const gn_lookup *l, uint32_t u, uint32_t v, uint32_t z)
{
    if (u == GN_NOWHERE)
        return gn_lit_nowhere(l, z);
    uint32_t half = (uint32_t)1 << (l->bits - 1), column = u < half ? 0 : (u - half) >> l->bits,
             row = v < half ? 0 : (v - half) >> l->bits;
    column = column < l->last_column ? column : l->last_column - 1;
    row = row < l->last_row ? row : l->last_row - 1;
    const gn_depth *texel = l->map + row * l->stride + column;
    return agree(texel, texel + l->stride, z);
}

static void vote_around(const gn_lookup *lookup, gn_points *points)
{
    const gn_lookup l = *lookup;
    uint32_t half = (uint32_t)1 << (l.bits - 1);
    for (int32_t i = 0; i < points->count; i++) {
        uint32_t u = points->u[i], v = points->v[i], z = points->z[i];
        uint32_t column = (u - half) >> l.bits, row = (v - half) >> l.bits;
        if (GN_UNLIKELY(column >= l.last_column || row >= l.last_row)) {
            points->lit[i] = vote_at_border(lookup, u, v, z);
            continue;
        }
        const gn_depth *texel = l.map + row * l.stride + column;
        points->lit[i] = agree(texel, texel + l.stride, z);
    }
}

static uint32_t sample_nearest(const gn_lookup *l, const gn_points *points, int32_t i, const gn_receiver_plane *plane)
{
    uint32_t column = points->u[i] >> l->bits, row = points->v[i] >> l->bits;
    column = column > l->last_column ? l->last_column : column;
    row = row > l->last_row ? l->last_row : row;
    return gn_cut(gn_saturate(gn_wide_depth(&plane->plane, (int32_t)column, (int32_t)row))) <=
                   l->map[row * l->stride + column]
               ? WHOLE
               : 0;
}

static const gn_reconstruction nearest = {gn_cascade_row, vote_around, sample_nearest, 0, WHOLE, 4, 1};

static void resample_point(const gn_context *context, gn_worker *worker, const gn_lookup *lookup, gn_points *points,
                           gn_sample *sample, int32_t i)
{
    points->lit[i] = 0;
    if (points->triangle[i] == GN_NO_TRIANGLE)
        return;
    const gn_receiver_plane *plane = gn_find_plane(context, worker, points->triangle[i]);
    if (!plane->faces_light)
        return;
    gn_receiver_plane level = {{points->z[i], 0, 0}, 0, 1, 1};
    points->lit[i] = sample(lookup, points, i, plane->exists ? plane : &level);
#if GN_STATISTICS
    points->stage[i] = GN_RESAMPLED;
#endif
}

static void resample_open(const gn_context *context, gn_worker *worker, const gn_lookup *lookup, gn_points *points,
                          gn_sample *sample)
{
    for (int32_t i = 0; i < points->count; i++)
        if (points->lit[i] != 0 && points->lit[i] != lookup->whole)
            resample_point(context, worker, lookup, points, sample, i);
}

static void resample_all(const gn_context *context, gn_worker *worker, const gn_lookup *lookup, gn_points *points,
                         gn_sample *sample)
{
    for (int32_t i = 0; i < points->count; i++)
        if (points->u[i] == GN_NOWHERE)
            points->lit[i] = gn_lit_nowhere(lookup, points->z[i]);
        else
            resample_point(context, worker, lookup, points, sample, i);
}

const gn_receiver gn_virtual = {gn_cascade_row, 0, resample_open, &nearest, 1};
const gn_receiver gn_virtual_always = {gn_cascade_row, 0, resample_all, &nearest, 0};
