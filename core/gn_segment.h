/* A segment over the cells of a silhouette map: every cell that it touches, and a point of it in each (Sen et al. 2003,
 * 3.1, figure 4).
 *
 * A cell lies between the centres of four texels; cell (0, 0) between those of texels (0, 0) and (1, 1). Coordinates
 * count 1/256 texel from the centre of texel (0, 0). Cells are closed: a segment along a border is in the cells on both
 * sides, through a corner in all four. The paper enlarges the cells for that, as its arithmetic rounds; here the
 * segment is found in each row of cells as quotients with remainders, exactly, and the cells that it visits are
 * 4-connected.
 *
 * The point is an end of the segment where one lies in the cell, of two the nearer to the light; else where the segment
 * crosses the cell's diagonals, of two crossings the middle. It is the same whichever end comes first. */
#ifndef GN_SEGMENT_H
#define GN_SEGMENT_H

#include "gn_raster.h"

typedef struct gn_segment {
    int32_t x, y; /* of the upper end, of two at one height the left one */
    int32_t dx, dy;
    uint32_t z; /* Z of gn_vertex, 31 bits */
    int32_t dz;
} gn_segment;

/* A point of the segment in a cell: within the cell, 0 .. 256 from its upper left corner, and Z. */
typedef struct gn_segment_point {
    int32_t x, y;
    uint32_t z;
} gn_segment_point;

/* From two vertices on the map. Returns 1 where b is the upper end. */
int gn_make_segment(gn_segment *segment, const gn_vertex *a, const gn_vertex *b);

/* A share of dx, dy or dz: floor(d t / length), 0 <= t <= length; *rest: whether the quotient is more than its floor.
 */
int32_t gn_segment_share(int32_t d, int32_t t, int32_t length, int *rest);

/* The rows of cells that it touches, [*first, *last]. */
void gn_segment_rows(const gn_segment *segment, int32_t *first, int32_t *last);

/* The columns of cells that it touches in one of these rows. */
void gn_segment_columns(const gn_segment *segment, int32_t row, int32_t *first, int32_t *last);

/* The point in a cell that it touches. */
void gn_segment_in_cell(const gn_segment *segment, int32_t column, int32_t row, gn_segment_point *point);

#endif
