/* The smallest rectangle about samples of a plane, at any angle. See gn_hull.c. */
#ifndef GN_HULL_H
#define GN_HULL_H

#include "gn_fixed.h"
#include "gnomon.h"

#define GN_HULL_COLUMNS 4096 /* of 16 units: a unit is 1/65536 of the plane's side, along both axes */
#define GN_HULL_ROWS 32768   /* of 2 units */

/* Rows without a sample in one column: [0] below its lowest one, [1] above its highest. In a column without samples
 * both are at least GN_HULL_ROWS. */
typedef struct gn_extent {
    uint16_t margin[2];
} gn_extent;

/* The points p with low <= p . (axis, perpendicular) <= high, where axis = (cosine, sine) and perpendicular =
 * (-sine, cosine): the axis is the plane's first one turned counterclockwise by an angle in (-45, 45] degrees.
 * low, high: 1/256 of a unit, in +-2^24.5. */
typedef struct gn_rectangle {
    gn_q2_30 cosine, sine;
    int32_t low[2], high[2]; /* along the axis, along the perpendicular */
} gn_rectangle;

/* Forget all samples. */
void gn_clear_extents(gn_extent extents[GN_HULL_COLUMNS]);

/* Add a sample in [u, u + 1) x [v, v + 1) units; u, v < 65536. */
GN_INLINE void gn_add_extent(gn_extent extents[GN_HULL_COLUMNS], uint32_t u, uint32_t v)
{
    GN_ASSERT(u < 65536 && v < 65536);
    uint16_t *margin = extents[u / (65536 / GN_HULL_COLUMNS)].margin;
    uint32_t below = v / (65536 / GN_HULL_ROWS), above = GN_HULL_ROWS - 1 - below;
    if (below < margin[0])
        margin[0] = (uint16_t)below;
    if (above < margin[1])
        margin[1] = (uint16_t)above;
}

/* Add all samples of another worker. */
void gn_merge_extents(gn_extent to[GN_HULL_COLUMNS], const gn_extent from[GN_HULL_COLUMNS]);

/* Find the rectangle of least area about the cells of 16 x 2 units that hold samples; of several, the one whose axis or
 * perpendicular is met first when turning counterclockwise from the plane's first axis. The angle is exact but for the
 * rounding of cosine and sine, each within 0.75 / 2^30; the cells lie in the rectangle with these, rounded outward.
 * Overwrites the extents. Returns 0, with nothing written, where there are no samples; else 1. */
int gn_find_rectangle(gn_rectangle *rectangle, gn_extent extents[GN_HULL_COLUMNS]);

#endif
