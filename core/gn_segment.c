#include "gn_segment.h"

#include "gn_grid.h"

enum { HALF = 128 };

int gn_make_segment(gn_segment *segment, const gn_vertex *a, const gn_vertex *b)
{
    int swap = b->y < a->y || (b->y == a->y && b->x < a->x);
    if (swap) {
        const gn_vertex *v = a;
        a = b;
        b = v;
    }
    segment->x = a->x - HALF;
    segment->y = a->y - HALF;
    segment->dx = b->x - a->x;
    segment->dy = b->y - a->y;
    segment->z = a->depth;
    segment->dz = (int32_t)(b->depth - a->depth);
    return swap;
}

GN_COLD int32_t gn_find_centre_before(const gn_axis *axis, int32_t place)
{
    int32_t texel = gn_floor_shift(place, 8);
    return axis->first + gn_find_step(axis->places + axis->first, axis->end - axis->first, texel, -1);
}

/* The cells about an axis' places [from, to]: between two centres each. */
static GN_NOINLINE void find_cells(const gn_axis *axis, int32_t from, int32_t to, int32_t *first, int32_t *last)
{
    *first = gn_centre_before(axis, from - 1);
    *last = gn_centre_before(axis, to);
    *first = *first < axis->first ? axis->first : *first;
    *last = *last < axis->end - 1 ? *last : axis->end - 2;
}

void gn_segment_rows(const gn_segment *segment, const gn_axis *rows, int32_t *first, int32_t *last)
{
    find_cells(rows, segment->y, segment->y + segment->dy, first, last);
}

/* One for all: a division where it is called from costs flash. */
GN_NOINLINE int32_t gn_segment_share(int32_t d, int32_t t, int32_t length, int *rest)
{
    uint32_t size = d < 0 ? 0u - (uint32_t)d : (uint32_t)d;
    uint64_t n = gn_multiply_u((uint32_t)t, size);
    uint32_t quotient = n >> 32 ? gn_divide(n, (uint32_t)length) : (uint32_t)n / (uint32_t)length;
    *rest = (uint32_t)n != quotient * (uint32_t)length;
    return d < 0 ? -(int32_t)quotient - *rest : (int32_t)quotient;
}

/* floor of x at a height, t below the upper end, 0 <= t <= dy != 0, and whether it is more than its floor. */
static int32_t x_at(const gn_segment *s, int32_t t, int *rest)
{
    return s->x + gn_segment_share(s->dx, t, s->dy, rest);
}

void gn_segment_columns(const gn_segment *segment, const gn_cells *cells, int32_t row, int32_t *first, int32_t *last)
{
    int rest_above = 0, rest_below = 0;
    int32_t top = gn_centre(&cells->rows, row) - segment->y, bottom = gn_centre(&cells->rows, row + 1) - segment->y;
    int32_t above = top <= 0 ? segment->x : x_at(segment, top, &rest_above);
    int32_t below = bottom >= segment->dy ? segment->x + segment->dx : x_at(segment, bottom, &rest_below);
    int rightwards = segment->dx >= 0;
    int32_t left = rightwards ? above + rest_above : below + rest_below, right = rightwards ? below : above;
    find_cells(&cells->columns, left, right, first, last);
}

static int is_inside(const gn_cell *cell, int32_t x, int32_t y)
{
    return x >= 0 && x <= 256 * cell->width && y >= 0 && y <= 256 * cell->height;
}

/* The way n / d to a crossing, in 2^-32: 0 if the segment does not reach it. */
static int find_way(int32_t n, int32_t d, uint32_t *way)
{
    if (d < 0) {
        n = -n;
        d = -d;
    }
    if (n < 0 || n >= d)
        return 0;
    *way = gn_divide((uint64_t)(uint32_t)n << 32, (uint32_t)d);
    return 1;
}

/* n / d in 32 bits, d >= 0: what find_way needs of it. Of a d beyond 31 bits the last ones are left out. */
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

/* The ways n / d to where the diagonals are crossed: x / width = y / height and x / width + y / height = 256. x, y: of
 * the segment's upper end, from the cell's corner. All below 2^37. */
static GN_COLD void find_ways(const gn_segment *s, const gn_cell *cell, int32_t x, int32_t y, int32_t n[2],
                              int32_t d[2])
{
    int64_t across = gn_multiply(x, cell->height), down = gn_multiply(y, cell->width);
    int64_t run = gn_multiply(s->dx, cell->height), fall = gn_multiply(s->dy, cell->width);
    narrow(down - across, run - fall, &n[0], &d[0]);
    narrow(gn_multiply(256 * cell->width, cell->height) - across - down, run + fall, &n[1], &d[1]);
}

/* A share of d, rounded down: d way / 2^32. */
static int32_t share(int32_t d, uint32_t way)
{
    return (int32_t)gn_floor_shift_64(gn_multiply(d, (int32_t)(way >> 1)), 31);
}

/* In 1/256 of a cell's side, rounded down and held in the cell. */
static int32_t part_of(int32_t v, int32_t side)
{
    v = v < 0 ? 0 : v > 256 * side ? 256 * side : v;
    return side == 1 ? v : v / side;
}

void gn_segment_in_cell(const gn_segment *s, const gn_cell *cell, gn_segment_point *point)
{
    int32_t x = s->x - cell->x, y = s->y - cell->y, width = cell->width, height = cell->height;
    int upper = is_inside(cell, x, y), lower = is_inside(cell, x + s->dx, y + s->dy);
    if (upper && (!lower || s->dz >= 0)) {
        point->z = s->z;
    } else if (lower) {
        x += s->dx;
        y += s->dy;
        point->z = s->z + (uint32_t)s->dz;
    } else {
        /* A crossing of a diagonal counts where it is in the cell, but for rounding. */
        int32_t n[2] = {y - x, 256 - x - y}, d[2] = {s->dx - s->dy, s->dx + s->dy};
        uint32_t way[2] = {0, 0};
        int valid[2];
        if (GN_UNLIKELY(width + height != 2))
            find_ways(s, cell, x, y, n, d);
        for (int i = 0; i < 2; i++) {
            valid[i] = find_way(n[i], d[i], &way[i]);
            int32_t at = x + share(s->dx, way[i]);
            valid[i] = valid[i] && at >= -width && at < 257 * width;
        }
        uint32_t middle = valid[0] && valid[1] ? (way[0] >> 1) + (way[1] >> 1) : valid[0] ? way[0] : way[1];
        x += share(s->dx, middle);
        y += share(s->dy, middle);
        point->z = s->z + (uint32_t)share(s->dz, middle);
    }
    point->x = part_of(x, width);
    point->y = part_of(y, height);
}
