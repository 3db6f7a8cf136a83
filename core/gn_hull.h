/* The smallest rectangle about samples of a plane, at any angle. See gn_hull.c. */
#ifndef GN_HULL_H
#define GN_HULL_H

#include "gn_fixed.h"
#include "gnomon.h"

#define GN_HULL_COLUMNS 4096 /* of the plane: a column is 1/4096 of its side wide */
#define GN_HULL_ROWS 32768

/* Rows without a sample in one column: [0] before its first one, [1] after its last. In a column without samples both
 * are at least GN_HULL_ROWS. */
typedef struct gn_extent {
    uint16_t margin[2];
} gn_extent;

/* Forget all samples. */
void gn_clear_extents(gn_extent extents[GN_HULL_COLUMNS]);

/* Add a sample at (x, y), each below 2^30, in 2^-30 of the plane's side. */
GN_INLINE void gn_add_extent(gn_extent extents[GN_HULL_COLUMNS], uint32_t x, uint32_t y)
{
    GN_ASSERT(x >> 30 == 0 && y >> 30 == 0);
    uint16_t *margin = extents[x / ((UINT32_C(1) << 30) / GN_HULL_COLUMNS)].margin;
    uint32_t before = y / ((UINT32_C(1) << 30) / GN_HULL_ROWS), after = GN_HULL_ROWS - 1 - before;
    if (before < margin[0])
        margin[0] = (uint16_t)before;
    if (after < margin[1])
        margin[1] = (uint16_t)after;
}

/* Add all samples of another worker. */
void gn_merge_extents(gn_extent to[GN_HULL_COLUMNS], const gn_extent from[GN_HULL_COLUMNS]);

/* Find the rectangle of least area about the cells, of a column by a row, that hold samples; of several, the one a side
 * of which is met first on the way from the x to the y axis. Its angle, in (-45, 45] degrees, is exact but for the
 * rounding of cosine and sine, each within 0.75 / 2^30; the cells lie in the rectangle with these, rounded outward.
 * Overwrites the extents. Returns 0, with nothing written, where there are no samples; else 1. */
int gn_find_rectangle(gn_rectangle *rectangle, gn_extent extents[GN_HULL_COLUMNS]);

#endif
