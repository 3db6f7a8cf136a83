#include "gn_unequal_cells.h"

#include "gn_grid.h"
#include "gn_quadrants.h"

static int32_t centre_before(const gn_axis *axis, int32_t texel)
{
    return axis->first + gn_find_step(axis->places + axis->first, axis->end - axis->first, texel, -1);
}

/* n / d in 32 bits, d >= 0. Where that is no way, nothing but so much is kept; of a d beyond 31 bits the last ones are
 * left out. */
static void narrow(int64_t n, int64_t d, int32_t *short_n, int32_t *short_d)
{
    if (d < 0) {
        n = -n;
        d = -d;
    }
    n = n < 0 ? -1 : n < d ? n : d;
    for (; d >> 31; d >>= 1)
        n = gn_floor_shift_64(n, 1);
    *short_n = (int32_t)n;
    *short_d = (int32_t)d;
}

/* The diagonals of a cell of any size: x / width = y / height and x / width + y / height = 256. x, y: of the segment's
 * upper end, from the cell's corner. All below 2^37. */
static void find_ways(gn_ways *w, const gn_segment *s, const gn_cell *cell, int32_t x, int32_t y)
{
    int64_t across = gn_multiply(x, cell->height), down = gn_multiply(y, cell->width);
    int64_t run = gn_multiply(s->dx, cell->height), fall = gn_multiply(s->dy, cell->width);
    narrow(down - across, run - fall, &w->n[0], &w->d[0]);
    narrow(gn_multiply(256 * cell->width, cell->height) - across - down, run + fall, &w->n[1], &w->d[1]);
}

/* Beyond a map's cells they are as wide, or as high, as the outermost. */
static uint32_t find_quadrant(const gn_lookup *l, uint32_t u, uint32_t v)
{
    const uint16_t *const centres[2] = {l->columns, l->rows};
    const uint32_t cell[2] = {u >> l->bits, v >> l->bits}, last[2] = {l->last_column - 1, l->last_row - 1};
    const int32_t step[2] = {1, (int32_t)l->last_column + 1}, at = (int32_t)cell[1] * step[1] + (int32_t)cell[0];
    uint32_t mask = ((uint32_t)1 << l->bits) - 1, to_sixteenths = l->bits - 4, point = l->silhouettes[at];
    const int32_t p[2] = {(int32_t)(point & 15), (int32_t)(point >> 4)};
    /* from the point, in 2^-bits of the cell's width and height */
    const int32_t way[2] = {(int32_t)(u & mask) - (int32_t)((uint32_t)p[0] << to_sixteenths),
                            (int32_t)(v & mask) - (int32_t)((uint32_t)p[1] << to_sixteenths)};
    int forth[2] = {way[0] >= 0, 0};
    for (int k = 0; k < 2; k++) {
        uint32_t other = gn_cell_at(l, forth[k] ? at + step[k] : at - step[k]);
        uint32_t next = forth[k] ? cell[k] + (cell[k] < last[k]) : cell[k] - (cell[k] > 0);
        int32_t to = (int32_t)(k ? other >> 4 : other & 15), aside = (int32_t)(k ? other & 15 : other >> 4) - p[!k];
        int32_t width = centres[k][cell[k] + 1] - centres[k][cell[k]], beyond = centres[k][next + 1] - centres[k][next];
        /* along the axis in 1/16 fine texel; across it the shares of one height are as good */
        int32_t along = forth[k] ? (16 - p[k]) * width + to * beyond : (to - 16) * beyond - p[k] * width;
        int64_t side = gn_multiply(along, way[!k]) - gn_multiply(aside * width, way[k]);
        forth[!k] = forth[k] ? side >= 0 : side <= 0;
        if (k == 0 && (forth[1] ? way[1] <= 0 : way[1] >= 0))
            break; /* the line down or up does not come here */
    }
    return (uint32_t)forth[0] | (uint32_t)forth[1] << 1;
}

const gn_unequal_cells gn_rectilinear_cells = {centre_before, find_ways, find_quadrant};
