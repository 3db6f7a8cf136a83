/* The rectangle of the minimal shadow frustum (MSF): the smallest one, at any angle, about the visible samples' places
 * in the light plane. It has a side along an edge of their convex hull (Freeman and Shapira 1975), so it is enough to
 * turn a rectangle once about the hull, from edge to edge (rotating calipers, Toussaint 1983). The hull is that of the
 * lowest and the highest sample of each of 4096 columns (monotone chain, Andrew 1979).
 *
 * Samples count as whole cells, one column wide and one row high: conservative. The hull of the cells is that of their
 * lower left corners plus one cell, so chains are made of those corners alone, and each caliper adds the corner of the
 * cell that it touches.
 *
 * The hull falls into two chains. Seen after half a turn, the upper one is a lower one too, and the margin above it
 * takes the place of the margin below: there is code for lower chains only, and each looks at the plane from its side.
 * The words are for y upward.
 *
 * Numbers are exact integers, and lengths here in rows: a coordinate is in [0, 2^15], an edge (x, y) has
 * |x|, |y| < 2^15, an extent of a rectangle times the edge's length is below 2^15 (|x| + |y|) < 2^31. Areas, two of
 * those over x^2 + y^2, are compared by products of 93 bits.
 *
 * Memory: the caller's extents, in which the chains are built, and 350 bytes of stack. Cost: linear in the columns and
 * in the corners, 1800 at most; 500,000 instructions on Cortex-M4 where samples fill all columns, 900,000 for a circle
 * as wide as the plane. */
#include "gn_hull.h"

#define SIDE GN_HULL_ROWS                   /* of the plane */
#define CELL_WIDTH (SIDE / GN_HULL_COLUMNS) /* its height is 1 */
#define LINK 0x8000u                        /* margin: the chain leaves the column out */
#define ROW_BITS 15                         /* fraction bits of a row in gn_rectangle: 2^30 is the side */

typedef struct point {
    int32_t x, y;
} point;

/* The lower chain of the hull, seen with the plane's own axes (mirror 0) or turned by half a turn (mirror
 * GN_HULL_COLUMNS - 1). Its corners' margins stay in their columns. A column after a corner that is not itself a corner
 * holds LINK + the column of the next corner; no other column is ever read. */
struct chain {
    gn_extent *extents;
    int32_t mirror;
    int32_t first, last; /* column of its first and its last corner */
};

static uint16_t *margin(const struct chain *chain, int32_t column)
{
    return &chain->extents[column ^ chain->mirror].margin[chain->mirror != 0];
}

/* Lower left corner of the lowest sample in a column. */
static point corner(const struct chain *chain, int32_t column)
{
    point p = {column * CELL_WIDTH, *margin(chain, column)};
    return p;
}

/* The corner after column < last. */
static int32_t next_corner(const struct chain *chain, int32_t column)
{
    uint32_t entry = *margin(chain, column + 1);
    return entry & LINK ? (int32_t)(entry - LINK) : column + 1;
}

static point minus(point a, point b)
{
    point difference = {a.x - b.x, a.y - b.y};
    return difference;
}

/* a x b > 0: b points to the left of a. |a|, |b| < 2^15 by component, a.x, b.x >= 0: each product is in +-2^30. */
static int turns_left(point a, point b)
{
    return a.x * b.y > a.y * b.x;
}

/* Keep of the columns those whose lowest corner is a corner of the hull, collinear ones not among them. 0: there are no
 * samples. */
static int build_chain(struct chain *chain)
{
    int32_t column = GN_HULL_COLUMNS - 1;
    while (column >= 0 && *margin(chain, column) >= LINK)
        column--;
    if (column < 0)
        return 0;
    chain->first = chain->last = column;
    while (--column >= 0) {
        if (*margin(chain, column) >= LINK)
            continue;
        point p = corner(chain, column);
        int32_t next = chain->first;
        while (next != chain->last) {
            int32_t after = next_corner(chain, next);
            if (turns_left(minus(corner(chain, next), p), minus(corner(chain, after), p)))
                break;
            next = after;
        }
        if (next != column + 1)
            *margin(chain, column + 1) = (uint16_t)(LINK + (uint32_t)next);
        chain->first = column;
    }
    return 1;
}

/* One side of the rectangle as it turns by a quarter: on a chain's falling part the left side, on its rising part the
 * lower one, as the chain sees them. */
struct caliper {
    const struct chain *chain;
    int rising;
    int32_t column;
    point touched;   /* where the side touches the hull */
    point direction; /* of the rectangle's lower side once this side lies along the next edge; (0, 1): at the end */
};

/* Touch the corner in this column and look along the edge that begins there. */
static void touch(struct caliper *caliper, int32_t column)
{
    const struct chain *chain = caliper->chain;
    point at = corner(chain, column), end = {0, 1};
    caliper->column = column;
    caliper->touched = at;
    if (caliper->rising)
        caliper->touched.x += CELL_WIDTH;
    caliper->direction = end;
    if (column == chain->last)
        return;
    point edge = minus(corner(chain, next_corner(chain, column)), at);
    if (caliper->rising) {
        caliper->direction = edge;
    } else if (edge.y < 0) {
        caliper->direction.x = -edge.y;
        caliper->direction.y = edge.x;
    }
}

static void advance(struct caliper *caliper)
{
    touch(caliper, next_corner(caliper->chain, caliper->column));
}

/* Touch the upright plane: with the left side, or with the lower one, at the right end of what it touches. */
static void begin(struct caliper *caliper, const struct chain *chain, int rising)
{
    caliper->chain = chain;
    caliper->rising = rising;
    touch(caliper, chain->first);
    while (rising && caliper->direction.y <= 0) /* at the end it is 1 */
        advance(caliper);
}

/* n / d, n < 2^62, 0 < d < 2^31. */
struct area {
    uint64_t n;
    uint32_t d;
};

static int is_smaller(const struct area *a, const struct area *b)
{
    uint64_t low_a = gn_multiply_u((uint32_t)a->n, b->d), low_b = gn_multiply_u((uint32_t)b->n, a->d);
    uint64_t high_a = gn_multiply_u((uint32_t)(a->n >> 32), b->d) + (low_a >> 32);
    uint64_t high_b = gn_multiply_u((uint32_t)(b->n >> 32), a->d) + (low_b >> 32);
    return high_a != high_b ? high_a < high_b : (uint32_t)low_a < (uint32_t)low_b;
}

/* From the touched point a of one chain to b of the other, which sees the plane turned, along (x, y), times its length.
 * Partial sums may wrap; the result, in (0, 2^31), does not. */
static uint32_t extent(point a, point b, int32_t x, int32_t y)
{
    uint32_t across = (uint32_t)(SIDE - a.x - b.x), up = (uint32_t)(SIDE - a.y - b.y);
    return across * (uint32_t)x + up * (uint32_t)y;
}

/* Of the rectangle whose lower side points along d. */
static struct area area_along(const struct caliper calipers[4], point d)
{
    uint32_t along = extent(calipers[0].touched, calipers[2].touched, d.x, d.y);
    uint32_t across = extent(calipers[1].touched, calipers[3].touched, -d.y, d.x);
    GN_ASSERT(along < UINT32_C(1) << 31 && across < UINT32_C(1) << 31);
    struct area area = {gn_multiply_u(along, across), (uint32_t)(d.x * d.x) + (uint32_t)(d.y * d.y)};
    return area;
}

/* Direction of the lower side of the smallest rectangle: x > 0, y >= 0. */
static point find_direction(const struct chain chains[2])
{
    struct caliper calipers[4]; /* left and lower side, and what chain 1 sees as such: right and upper side */
    for (int i = 0; i < 4; i++)
        begin(&calipers[i], &chains[i / 2], i & 1);
    point best = {1, 0};
    struct area least = area_along(calipers, best);
    for (;;) {
        struct caliper *first = calipers; /* that has to turn least to its next edge */
        for (int i = 1; i < 4; i++) {
            if (turns_left(calipers[i].direction, first->direction))
                first = &calipers[i];
        }
        point direction = first->direction;
        if (direction.x == 0)
            return best;
        advance(first);
        struct area area = area_along(calipers, direction);
        if (is_smaller(&area, &least)) { /* at the same area the one that was met first stays */
            least = area;
            best = direction;
        }
    }
}

/* x / |d| in Q2.30, 0 <= x <= |d| < 2^16; length = round(|d| 2^n), in [2^31, 2^32). Within 0.75 / 2^30 and at most 1:
 * the length is within 2^-32 of itself, and no less than the whole number x 2^n. */
static gn_q2_30 part_of_length(int32_t x, unsigned n, uint32_t length)
{
    return (gn_q2_30)gn_divide(((uint64_t)((uint32_t)x) << (n + 30)) + length / 2, length);
}

static void set_axis(gn_rectangle *rectangle, point d)
{
    uint64_t square = (uint32_t)(d.x * d.x) + (uint32_t)(d.y * d.y); /* below 2^31 */
    unsigned n = gn_leading_zeros_64(square) / 2;
    square <<= 2 * n;
    uint32_t length = gn_square_root(square);
    if (square - gn_multiply_u(length, length) > length)
        length++; /* nearest, and below 2^32: the square is at most 2^64 - 2^34 */
    gn_q2_30 x = part_of_length(d.x, n, length), y = part_of_length(d.y, n, length);
    int steep = d.y > d.x;
    rectangle->cosine = steep ? y : x; /* back by a quarter turn: (y, -x) */
    rectangle->sine = steep ? -x : y;
}

/* Widen [low, high], Q2.30 in rows, to the cell at p, along (x, y). */
static void contain(int64_t *low, int64_t *high, point p, gn_q2_30 x, gn_q2_30 y)
{
    int64_t start = gn_multiply(p.x, x) + gn_multiply(p.y, y), end = start;
    *(x < 0 ? &start : &end) += gn_multiply(CELL_WIDTH, x);
    *(y < 0 ? &start : &end) += y;
    if (start < *low)
        *low = start;
    if (end > *high)
        *high = end;
}

/* Set low and size by the rounded axis: every corner of the hull counts, since another than the one that the caliper
 * touches may now lie further out. */
static void set_bounds(gn_rectangle *rectangle, const struct chain chains[2])
{
    int64_t low[2] = {INT64_MAX, INT64_MAX}, high[2] = {INT64_MIN, INT64_MIN};
    for (int i = 0; i < 2; i++) {
        const struct chain *chain = &chains[i];
        for (int32_t column = chain->first;; column = next_corner(chain, column)) {
            point p = corner(chain, column);
            if (chain->mirror) {
                p.x = SIDE - CELL_WIDTH - p.x;
                p.y = SIDE - 1 - p.y;
            }
            contain(&low[0], &high[0], p, rectangle->cosine, rectangle->sine);
            contain(&low[1], &high[1], p, -rectangle->sine, rectangle->cosine);
            if (column == chain->last)
                break;
        }
    }
    const unsigned drop = 30 - ROW_BITS;
    for (int k = 0; k < 2; k++) {
        rectangle->low[k] = (int32_t)gn_floor_shift_64(low[k], drop);
        rectangle->size[k] = (int32_t)-gn_floor_shift_64(-high[k], drop) - rectangle->low[k];
    }
}

int gn_find_rectangle(gn_rectangle *rectangle, gn_extent extents[GN_HULL_COLUMNS])
{
    struct chain chains[2] = {{extents, 0, 0, 0}, {extents, GN_HULL_COLUMNS - 1, 0, 0}};
    if (!build_chain(&chains[0]))
        return 0;
    build_chain(&chains[1]);
    set_axis(rectangle, find_direction(chains));
    set_bounds(rectangle, chains);
    return 1;
}

void gn_clear_extents(gn_extent extents[GN_HULL_COLUMNS])
{
    for (int32_t column = 0; column < GN_HULL_COLUMNS; column++)
        extents[column].margin[0] = extents[column].margin[1] = UINT16_MAX;
}

void gn_merge_extents(gn_extent to[GN_HULL_COLUMNS], const gn_extent from[GN_HULL_COLUMNS])
{
    for (int32_t column = 0; column < GN_HULL_COLUMNS; column++) {
        for (int k = 0; k < 2; k++) {
            if (from[column].margin[k] < to[column].margin[k])
                to[column].margin[k] = from[column].margin[k];
        }
    }
}
