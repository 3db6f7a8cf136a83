#include "gn_segment.h"

#include "gn_unequal_cells.h"

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

int32_t gn_centre_before(const gn_axis *axis, int32_t place)
{
    int32_t texel = gn_floor_shift(place, 8);
    return GN_UNLIKELY(axis->unequal != 0) ? axis->unequal->centre_before(axis, texel) : texel;
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

/* A share of d, rounded down: d way / 2^32. */
static int32_t share(int32_t d, uint32_t way)
{
    return (int32_t)gn_floor_shift_64(gn_multiply(d, (int32_t)(way >> 1)), 31);
}

/* The way n / d to a crossing, in 2^-32: 0 where the segment does not reach it, or beyond the cell but for rounding. */
GN_INLINE int find_crossing(const gn_segment *s, int32_t x, int32_t width, int32_t n, int32_t d, uint32_t *way)
{
    if (d < 0) {
        n = -n;
        d = -d;
    }
    if (n < 0 || n >= d)
        return 0;
    *way = gn_divide((uint64_t)(uint32_t)n << 32, (uint32_t)d);
    int32_t at = x + share(s->dx, *way);
    return at >= -width && at < 257 * width;
}

/* In 1/256 of a cell's side, rounded down and held in the cell. */
static int32_t part_of(int32_t v, int32_t side)
{
    v = v < 0 ? 0 : v > 256 * side ? 256 * side : v;
    return v / side;
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
        gn_ways w = {{y - x, 256 - x - y}, {s->dx - s->dy, s->dx + s->dy}}; /* to x = y and x + y = 256 */
        uint32_t one = 0, other = 0;
        if (GN_UNLIKELY(cell->unequal != 0)) {
            gn_ways unequal;
            cell->unequal->find_ways(&unequal, s, cell, x, y);
            w = unequal;
        }
        int crosses_one = find_crossing(s, x, width, w.n[0], w.d[0], &one);
        int crosses_other = find_crossing(s, x, width, w.n[1], w.d[1], &other);
        uint32_t middle = !crosses_one ? other : !crosses_other ? one : (one >> 1) + (other >> 1);
        x += share(s->dx, middle);
        y += share(s->dy, middle);
        point->z = s->z + (uint32_t)share(s->dz, middle);
    }
    point->x = part_of(x, width);
    point->y = part_of(y, height);
}
