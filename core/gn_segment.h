/* A segment over the cells of a silhouette map: every cell that it touches, and a point of it in each (Sen et al. 2003,
 * 3.1, figure 4).
 *
 * A cell lies between the centres of four texels; cell (0, 0) between those of texels (0, 0) and (1, 1). Coordinates
 * count 1/256 texel from the centre of texel (0, 0); of a warped map (gn_grid.h) they count 1/256 fine texel from the
 * centre of the first fine one, and cells are of unequal widths and heights. Cells are closed: a segment along a border
 * is in the cells on both sides, through a corner in all four. The paper enlarges the cells for that, as its arithmetic
 * rounds; here the segment is found in each row of cells as quotients with remainders, exactly, and the cells that it
 * visits are 4-connected.
 *
 * The point is an end of the segment where one lies in the cell, of two the nearer to the light; else where the segment
 * crosses the cell's diagonals, of two crossings the middle. It is the same whichever end comes first. */
#ifndef GN_SEGMENT_H
#define GN_SEGMENT_H

#include "gn_raster.h"

/* The centres of columns or rows of texels, numbers [first, end): at 256 places[i], strictly increasing; where places
 * is 0, at 256 i. */
typedef struct gn_unequal_cells gn_unequal_cells;
typedef struct gn_axis {
    const uint16_t *places;
    int32_t first, end;
    const gn_unequal_cells *unequal; /* gn_unequal_cells.h, where there are places; else 0 */
} gn_axis;

typedef struct gn_cells {
    gn_axis columns, rows;
} gn_cells;

/* One of them: the upper left corner, width and height in texels, 1 unless the map is warped. */
typedef struct gn_cell {
    int32_t x, y;
    int32_t width, height;
    const gn_unequal_cells *unequal;
} gn_cell;

typedef struct gn_segment {
    int32_t x, y; /* of the upper end, of two at one height the left one */
    int32_t dx, dy;
    uint32_t z; /* Z of gn_vertex, 31 bits */
    int32_t dz;
} gn_segment;

/* A point of the segment in a cell: 0 .. 256 from its upper left corner, in 1/256 of its width and height, and Z. */
typedef struct gn_segment_point {
    int32_t x, y;
    uint32_t z;
} gn_segment_point;

/* The ways n / d from a segment's upper end to where it crosses a cell's two diagonals: no ways where that is not in
 * [0, 1). */
typedef struct gn_ways {
    int32_t n[2], d[2];
} gn_ways;

/* From two vertices on the map. Returns 1 where b is the upper end. */
int gn_make_segment(gn_segment *segment, const gn_vertex *a, const gn_vertex *b);

/* A share of dx, dy or dz: floor(d t / length), 0 <= t <= length; *rest: whether the quotient is more than its floor.
 */
int32_t gn_segment_share(int32_t d, int32_t t, int32_t length, int *rest);

GN_INLINE int32_t gn_centre(const gn_axis *axis, int32_t i)
{
    return 256 * (axis->places ? axis->places[i] : i);
}

/* Texels from one centre to the next. */
GN_INLINE int32_t gn_step_after(const gn_axis *axis, int32_t i)
{
    return axis->places ? axis->places[i + 1] - axis->places[i] : 1;
}

/* The last centre at or before a place. Along unequal steps first - 1 stands for all before the first; along equal ones
 * the centres go on both ways. Cost: a bisection. */
int32_t gn_centre_before(const gn_axis *axis, int32_t place);

GN_INLINE gn_cell gn_cell_between(const gn_cells *cells, int32_t column, int32_t row)
{
    gn_cell cell = {gn_centre(&cells->columns, column), gn_centre(&cells->rows, row),
                    gn_step_after(&cells->columns, column), gn_step_after(&cells->rows, row), cells->columns.unequal};
    return cell;
}

/* The rows of cells that it touches, [*first, *last], of those that there are: none where *first > *last. */
void gn_segment_rows(const gn_segment *segment, const gn_axis *rows, int32_t *first, int32_t *last);

/* The columns of cells that it touches in one of these rows. */
void gn_segment_columns(const gn_segment *segment, const gn_cells *cells, int32_t row, int32_t *first, int32_t *last);

/* The point in a cell that it touches. */
void gn_segment_in_cell(const gn_segment *segment, const gn_cell *cell, gn_segment_point *point);

#endif
