/* Percentage-closer filtering by a 4 x 4 jitter matrix (Reeves et al. 1987; Weiskopf & Ertl 2003, section 5): about the
 * point lie 4 x 4 cells as large as texels, and in each cell one place counts, with the texel that holds it. Where
 * in the cell, a fixed matrix says, turned by the pixel's place modulo 4: what bands would be becomes grain.
 * The texels of the border stand for those beyond it. Cost: 16 comparisons, and the places of their texels. */
#include "gn_cascade.h"

enum { CELLS = 4, WHOLE = CELLS * CELLS };

/* Bayer's ordered dither: neighbours are far apart in value; every pixel uses all 16. In 1/16 cell, + 1/32. */
static const uint8_t matrix[CELLS][CELLS] = {{0, 8, 2, 10}, {12, 4, 14, 6}, {3, 11, 1, 9}, {15, 7, 13, 5}};

/* The texel of a place along one axis: cells begin two texels before the point. */
GN_INLINE uint32_t texel_at(uint32_t u, uint32_t cell, uint32_t sixteenths, uint32_t last, uint32_t bits)
{
    uint32_t half = (uint32_t)1 << (bits - 1), start = (uint32_t)CELLS / 2 << bits;
    return gn_hold(u + half - start + (cell << bits) + ((2 * sixteenths + 1) << (bits - 5)), bits, last);
}

/* The shadowed places by a plane, or, where that is 0, by one depth. */
GN_INLINE uint32_t count_dark(const gn_lookup *l, gn_points *points, int32_t i, const gn_wide_plane *plane)
{
    uint32_t x = (uint32_t)(points->x + i), y = (uint32_t)points->y, z = gn_cut(points->z[i]), dark = 0;
    for (uint32_t k = 0; k < WHOLE; k++) {
        uint32_t cell_x = k % CELLS, cell_y = k / CELLS, turned_x = (cell_x + x) % CELLS,
                 turned_y = (cell_y + y) % CELLS;
        uint32_t column = texel_at(points->u[i], cell_x, matrix[turned_y][turned_x], l->last_column, l->bits);
        uint32_t row = texel_at(points->v[i], cell_y, matrix[turned_x][(turned_y + 2) % CELLS], l->last_row, l->bits);
        if (plane)
            z = gn_cut(gn_saturate(gn_wide_depth(plane, (int32_t)(l->columns ? l->columns[column] : column),
                                                 (int32_t)(l->columns ? l->rows[row] : row))));
        dark += z > l->map[row * l->stride + column];
    }
    return dark;
}

static void vote(const gn_lookup *lookup, gn_points *points)
{
    for (int32_t i = 0; i < points->count; i++)
        gn_vote_is(points, i,
                   points->u[i] == GN_NOWHERE ? gn_dark_nowhere(lookup, points->z[i])
                                              : count_dark(lookup, points, i, 0),
                   WHOLE);
}

static uint32_t sample(const gn_lookup *l, gn_points *points, int32_t i, const gn_wide_plane *plane)
{
    return count_dark(l, points, i, plane);
}

const gn_reconstruction gn_jitter_4x4 = {gn_cascade_row, vote, sample, gn_colour_fractions, WHOLE, 16, 16, 0, 0};
