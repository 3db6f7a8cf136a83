/* The four texels about a place on the map: whether they agree on a depth. */
#ifndef GN_AROUND_H
#define GN_AROUND_H

#include "gn_cascade.h"

#define GN_OPEN 1u /* they do not */

/* Whether four texels agree on a depth that was cut: lit (0), shadowed (GN_DARK) or GN_OPEN. */
GN_INLINE uint32_t gn_agree(const gn_depth *above, const gn_depth *below, uint32_t z)
{
    if (z <= above[0])
        return z <= above[1] && z <= below[0] && z <= below[1] ? 0 : GN_OPEN;
    return z > above[1] && z > below[0] && z > below[1] ? GN_DARK : GN_OPEN;
}

/* The greatest number of a footprint's first texel; rows are as long as the map is wide. */
GN_INLINE uint32_t gn_last_footprint(const gn_lookup *l)
{
    return (l->last_column + 1) * l->last_row - 2;
}

/* At the border: the four texels that are nearest lie to one side of a place in the outer half texel and cannot tell
 * that it is shadowed: a convex surface may be behind all of them. */
uint32_t gn_look_at_border(const gn_lookup *l, uint32_t u, uint32_t v, uint32_t z);

/* Where no point should be: gn_index's texels, from a number on that has three more after it. */
uint32_t gn_look_beyond(const gn_lookup *l, uint32_t column, uint32_t row, uint32_t z);

/* Whether the four texels at a place agree on a depth that was cut. */
GN_INLINE uint32_t gn_look(const gn_lookup *l, uint32_t u, uint32_t v, uint32_t z)
{
    uint32_t column = u >> l->bits, row = v >> l->bits;
    const gn_depth *above = l->map + row * l->stride + column;
    if (GN_UNLIKELY(column >= l->last_column || row >= l->last_row))
        return l->inside ? gn_look_beyond(l, column, row, z) : gn_look_at_border(l, u, v, z);
    return gn_agree(above, above + l->stride, z);
}

/* The votes of these four; and of the one that holds a point. */
gn_vote gn_vote_around, gn_vote_nearest;

/* Settles open points: each is sampled with its own depth. */
void gn_settle(const gn_reconstruction *how, const gn_lookup *lookup, gn_points *points);

/* The comparison of the texel that holds a point with the plane's depth at its centre. */
gn_sample gn_sample_nearest;

#endif
