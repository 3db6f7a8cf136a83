#include "gn_segment.h"

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

void gn_segment_rows(const gn_segment *segment, int32_t *first, int32_t *last)
{
    *first = gn_floor_shift(segment->y - 1, 8);
    *last = gn_floor_shift(segment->y + segment->dy, 8);
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

void gn_segment_columns(const gn_segment *segment, int32_t row, int32_t *first, int32_t *last)
{
    int rest_above = 0, rest_below = 0;
    int32_t top = 256 * row - segment->y, bottom = top + 256;
    int32_t above = top <= 0 ? segment->x : x_at(segment, top, &rest_above);
    int32_t below = bottom >= segment->dy ? segment->x + segment->dx : x_at(segment, bottom, &rest_below);
    int rightwards = segment->dx >= 0;
    int32_t left = rightwards ? above + rest_above : below + rest_below, right = rightwards ? below : above;
    *first = gn_floor_shift(left - 1, 8);
    *last = gn_floor_shift(right, 8);
}

static int is_inside(int32_t x, int32_t y)
{
    return x >= 0 && x <= 256 && y >= 0 && y <= 256;
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

/* A share of d, rounded down: d way / 2^32. */
static int32_t share(int32_t d, uint32_t way)
{
    return (int32_t)gn_floor_shift_64(gn_multiply(d, (int32_t)(way >> 1)), 31);
}

static int32_t hold(int32_t v)
{
    return v < 0 ? 0 : v > 256 ? 256 : v;
}

void gn_segment_in_cell(const gn_segment *s, int32_t column, int32_t row, gn_segment_point *point)
{
    int32_t x = s->x - 256 * column, y = s->y - 256 * row;
    int upper = is_inside(x, y), lower = is_inside(x + s->dx, y + s->dy);
    if (upper && (!lower || s->dz >= 0)) {
        point->x = hold(x);
        point->y = hold(y);
        point->z = s->z;
        return;
    }
    if (lower) {
        point->x = hold(x + s->dx);
        point->y = hold(y + s->dy);
        point->z = s->z + (uint32_t)s->dz;
        return;
    }
    /* The diagonals are x = y and x + y = 256. A crossing counts where it is in the cell, but for rounding. */
    uint32_t way[2] = {0, 0};
    int32_t across[2] = {0, 0};
    int valid[2];
    valid[0] = find_way(y - x, s->dx - s->dy, &way[0]);
    valid[1] = find_way(256 - x - y, s->dx + s->dy, &way[1]);
    for (int i = 0; i < 2; i++) {
        across[i] = x + share(s->dx, way[i]);
        valid[i] = valid[i] && across[i] >= -1 && across[i] <= 256;
    }
    uint32_t middle = valid[0] && valid[1] ? (way[0] >> 1) + (way[1] >> 1) : valid[0] ? way[0] : way[1];
    point->x = hold(x + share(s->dx, middle));
    point->y = hold(y + share(s->dy, middle));
    point->z = s->z + (uint32_t)share(s->dz, middle);
}
