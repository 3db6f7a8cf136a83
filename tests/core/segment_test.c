/* Segments over the cells of a silhouette map. Which cells: every cell about a segment by separating axes, in exact
 * integers. Which point: the rule of Sen et al. 2003, 3.1 (an end in the cell; else where the diagonals are crossed, of
 * two crossings the middle) in rationals of 128 bits. All pairs of places where rounding or a border may matter, then
 * segments of every length up to the whole guard band; the same on cells of unequal width and height; and on wide cells
 * of one size, where everything is what it is on cells of one texel. Cases: 400000 random segments, or
 * GNOMON_CASES. */
#include "gn_unequal_cells.h"
#include "tap.h"

#include <string.h>

__extension__ typedef __int128 exact;

enum { HALF = 128, CELL = 256, REACH = 1 << 21 };

static uint64_t random_state = 11;

static int32_t between(int64_t low, int64_t high)
{
    return (int32_t)(low + (int64_t)(tap_random(&random_state) % ((uint64_t)(high - low) + 1)));
}

/* ---- cells by separating axes ------------------------------------------------------------------------------------ */

/* Cells of one texel, everywhere. */
static const gn_cells even = {{0, -20000, 20000, 0}, {0, -20000, 20000, 0}};

/* A cell, in 1/256 texel. */
typedef struct box {
    int64_t left, top, right, bottom;
} box;

static int64_t centre_of(const gn_axis *axis, int64_t i)
{
    return CELL * (axis->places ? (int64_t)axis->places[i] : i);
}

static box box_of(const gn_cells *cells, int64_t column, int64_t row)
{
    box b = {centre_of(&cells->columns, column), centre_of(&cells->rows, row), centre_of(&cells->columns, column + 1),
             centre_of(&cells->rows, row + 1)};
    return b;
}

static int has_cell(const gn_axis *axis, int64_t i)
{
    return i >= axis->first && i + 1 < axis->end;
}

/* A segment as the test knows it: places from the centre of texel (0, 0). */
typedef struct line {
    int64_t x[2], y[2];
    uint32_t z[2];
} line;

static line line_of(const gn_vertex *a, const gn_vertex *b)
{
    line l = {{a->x - HALF, b->x - HALF}, {a->y - HALF, b->y - HALF}, {a->depth, b->depth}};
    return l;
}

/* Does the segment touch the closed cell? Two convex sets do unless an axis parts them: of the cell x and y,
 * of the segment its normal. */
static int touches(const line *l, const box *b)
{
    if ((l->x[0] < b->left && l->x[1] < b->left) || (l->x[0] > b->right && l->x[1] > b->right) ||
        (l->y[0] < b->top && l->y[1] < b->top) || (l->y[0] > b->bottom && l->y[1] > b->bottom))
        return 0;
    int before = 0, behind = 0;
    for (int i = 0; i < 4; i++) {
        int64_t x = i & 1 ? b->right : b->left, y = i & 2 ? b->bottom : b->top;
        int64_t side = (l->x[1] - l->x[0]) * (y - l->y[0]) - (l->y[1] - l->y[0]) * (x - l->x[0]);
        before += side < 0;
        behind += side > 0;
    }
    return before < 4 && behind < 4;
}

static int64_t least(int64_t a, int64_t b)
{
    return a < b ? a : b;
}

static int64_t floor_divide(int64_t n, int64_t d)
{
    int64_t q = n / d;
    return q - (n - q * d < 0);
}

typedef struct tally {
    unsigned failures;
    uint64_t segments, cells, empty, upper, lower, nearer, crossings, middles, corners, undecided;
} tally;

static void note_line(const line *l)
{
    note("(%ld, %ld) z %lu to (%ld, %ld) z %lu", (long)l->x[0], (long)l->y[0], (unsigned long)l->z[0], (long)l->x[1],
         (long)l->y[1], (unsigned long)l->z[1]);
}

static int failed(tally *count, const line *l)
{
    if (count->failures++ >= 5)
        return 0;
    note_line(l);
    return 1;
}

static void check_cell(const gn_cells *cells, const line *l, int32_t column, int32_t row, const int32_t columns[2],
                       tally *count)
{
    box b = box_of(cells, column, row);
    int expected = touches(l, &b), got = column >= columns[0] && column <= columns[1];
    count->cells += (uint64_t)expected;
    count->empty += (uint64_t)!expected;
    if (expected != got && failed(count, l))
        note("    cell (%d, %d): %s, expected %s; columns %d to %d", (int)column, (int)row,
             got ? "visited" : "not visited", expected ? "touched" : "not touched", (int)columns[0], (int)columns[1]);
}

/* One row: the columns that it says, and about its ends those that it does not say; of a table's cells all. */
static void check_row(const gn_cells *cells, const gn_segment *segment, const line *l, int32_t row, int32_t columns[2],
                      tally *count)
{
    const gn_axis *axis = &cells->columns;
    gn_segment_columns(segment, cells, row, &columns[0], &columns[1]);
    if (axis->places) {
        for (int32_t column = axis->first; has_cell(axis, column); column++)
            check_cell(cells, l, column, row, columns, count);
        return;
    }
    for (int end = 0; end < 2; end++)
        for (int32_t column = columns[end] - 3; column <= columns[end] + 3; column++)
            check_cell(cells, l, column, row, columns, count);
}

/* ---- the point by the paper's rule ------------------------------------------------------------------------------- */

/* What 2^-32 of the way, halved, may lack of a place: rounding down, and the ways' own. */
#define WAY_ERROR 128 /* 1/128 of 1/256 texel */
enum { Z_ERROR = 3 }; /* units of 2^31 */

/* n / d of the way, d > 0. Large cells leave out the last bits of a d beyond 31: up to a unit of n and of d, which have
 * 30 bits then at least: 2^-29 of the way, of which a segment is at most 2^22 long and 2^31 deep. */
typedef struct way {
    exact n, d;
    int short_of_bits;
} way;

/* Where the segment crosses a diagonal of the cell: 1 in the cell, -1 within two units outside it, where rounding may
 * decide. In shares of the cell's width and height the diagonals are x = y and x + y = 256. */
static int find_crossing(const line *l, const box *b, int diagonal, way *w)
{
    int64_t width = (b->right - b->left) / CELL, height = (b->bottom - b->top) / CELL;
    int64_t x = (l->x[0] - b->left) * height, y = (l->y[0] - b->top) * width, dx = (l->x[1] - l->x[0]) * height,
            dy = (l->y[1] - l->y[0]) * width;
    w->n = diagonal ? CELL * width * height - x - y : y - x;
    w->d = diagonal ? dx + dy : dx - dy;
    if (w->d < 0) {
        w->n = -w->n;
        w->d = -w->d;
    }
    w->short_of_bits = w->d >> 31 != 0;
    if (w->d == 0 || w->n < 0 || w->n > w->d)
        return 0;
    exact across = x * w->d + dx * w->n, side = width * height * w->d; /* x d at the crossing; d, as x */
    if (across >= 0 && across <= CELL * side)
        return 1;
    return across >= -2 * side && across <= (CELL + 2) * side ? -1 : 0;
}

/* Is got, in 1/256 of a side, within (-1 - 1/WAY_ERROR, 1/WAY_ERROR] of from + by w, held to the cell? */
static int is_near(int64_t got, int64_t from, int64_t by, int64_t side, const way *w)
{
    exact place = WAY_ERROR * (from * w->d + by * w->n), unit = WAY_ERROR * w->d * side;
    exact error = (1 + w->short_of_bits) * w->d;
    if (got == 0 && place <= unit)
        return 1;
    if (got == CELL && place >= CELL * unit - error)
        return 1;
    exact beyond = got * unit - place;
    return beyond > -unit - error && beyond <= error;
}

static int is_at(const line *l, const box *b, const gn_segment_point *p, const way *w)
{
    exact z = l->z[0] * w->d + ((int64_t)l->z[1] - l->z[0]) * w->n, beyond = p->z * w->d - z;
    int error = Z_ERROR + 4 * w->short_of_bits;
    return is_near(p->x, l->x[0] - b->left, l->x[1] - l->x[0], (b->right - b->left) / CELL, w) &&
           is_near(p->y, l->y[0] - b->top, l->y[1] - l->y[0], (b->bottom - b->top) / CELL, w) &&
           beyond > -error * w->d && beyond < error * w->d;
}

static int is_in_cell(const line *l, int end, const box *b)
{
    return l->x[end] >= b->left && l->x[end] <= b->right && l->y[end] >= b->top && l->y[end] <= b->bottom;
}

/* Of two ends in the cell the nearer, at equal depth the upper, of two at one height the left one; else a crossing, or
 * the middle of two. */
static int is_the_papers(const line *l, const box *b, const gn_segment_point *p, tally *count)
{
    int first = l->y[1] < l->y[0] || (l->y[1] == l->y[0] && l->x[1] < l->x[0]); /* the upper end */
    int inside[2] = {is_in_cell(l, first, b), is_in_cell(l, !first, b)};
    if (inside[0] || inside[1]) {
        int lower = !inside[0] || (inside[1] && l->z[!first] < l->z[first]), end = lower ? !first : first;
        int64_t x = CELL * (l->x[end] - b->left) / (b->right - b->left);
        int64_t y = CELL * (l->y[end] - b->top) / (b->bottom - b->top);
        count->upper += (uint64_t)!lower;
        count->lower += (uint64_t)lower;
        count->nearer += inside[0] && inside[1] && l->z[0] != l->z[1];
        count->corners += x % CELL == 0 && y % CELL == 0;
        return p->x == x && p->y == y && p->z == l->z[end];
    }
    way w[3];
    int found[2] = {find_crossing(l, b, 0, &w[0]), find_crossing(l, b, 1, &w[1])};
    w[2].n = w[0].n * w[1].d + w[1].n * w[0].d;
    w[2].d = 2 * w[0].d * w[1].d;
    w[2].short_of_bits = w[0].short_of_bits || w[1].short_of_bits;
    count->crossings += (found[0] != 0) + (found[1] != 0) == 1;
    count->middles += found[0] && found[1];
    count->undecided += found[0] < 0 || found[1] < 0;
    if (found[0] == 0 && found[1] == 0)
        return 0;
    return (found[0] && found[1] && is_at(l, b, p, &w[2])) || (found[0] && found[1] <= 0 && is_at(l, b, p, &w[0])) ||
           (found[1] && found[0] <= 0 && is_at(l, b, p, &w[1]));
}

/* The point is in the cell, and no farther from the segment's line, along x and y, than by what it was rounded down:
 * 1/256 of the cell's width and height. */
static int is_on_segment(const line *l, const box *b, const gn_segment_point *p)
{
    int64_t dx = l->x[1] - l->x[0], dy = l->y[1] - l->y[0];
    int64_t width = (b->right - b->left) / CELL, height = (b->bottom - b->top) / CELL;
    int64_t side = dx * (p->y * height + b->top - l->y[0]) - dy * (p->x * width + b->left - l->x[0]);
    int64_t reach = (dx < 0 ? -dx : dx) * height + (dy < 0 ? -dy : dy) * width;
    side = side < 0 ? -side : side;
    return p->x >= 0 && p->x <= CELL && p->y >= 0 && p->y <= CELL && side * WAY_ERROR <= reach * (WAY_ERROR + 1);
}

static void find_point(const gn_cells *cells, const gn_segment *segment, int32_t column, int32_t row,
                       gn_segment_point *p)
{
    gn_cell cell = gn_cell_between(cells, column, row);
    gn_segment_in_cell(segment, &cell, p);
}

static void check_point(const gn_cells *cells, const gn_segment *segment, const gn_segment *swapped, const line *l,
                        int32_t column, int32_t row, tally *count)
{
    gn_segment_point p, q;
    box b = box_of(cells, column, row);
    find_point(cells, segment, column, row, &p);
    find_point(cells, swapped, column, row, &q);
    int same = p.x == q.x && p.y == q.y && p.z == q.z;
    int papers = is_the_papers(l, &b, &p, count), on = is_on_segment(l, &b, &p);
    if ((!same || !papers || !on) && failed(count, l))
        note("    cell (%d, %d): point (%d, %d), z %lu; %s%s%s", (int)column, (int)row, (int)p.x, (int)p.y,
             (unsigned long)p.z, same ? "" : "another the other way round; ", papers ? "" : "not the paper's; ",
             on ? "" : "not in the cell or not on the segment");
}

/* ---- a segment --------------------------------------------------------------------------------------------------- */

enum { MOST_ROWS = 40 };

/* The first and the last row of cells that a segment touches, of those that there are. */
static void find_rows(const gn_axis *axis, const line *l, int64_t rows[2])
{
    int64_t top = least(l->y[0], l->y[1]), bottom = l->y[0] + l->y[1] - top;
    rows[0] = floor_divide(top - 1, CELL); /* its last place is at or below the top */
    rows[1] = floor_divide(bottom, CELL);  /* its first one at or above the bottom */
    if (!axis->places)
        return;
    for (rows[0] = axis->first; has_cell(axis, rows[0]) && centre_of(axis, rows[0] + 1) < top; rows[0]++)
        ;
    for (rows[1] = axis->end - 2; rows[1] >= axis->first && centre_of(axis, rows[1]) > bottom; rows[1]--)
        ;
}

/* All rows of a short segment, and of a long one the first, the last and some between. */
static void check_segment(const gn_cells *cells, const gn_vertex *a, const gn_vertex *b, tally *count)
{
    gn_segment segment, swapped;
    line l = line_of(a, b);
    int32_t rows[2], before[2] = {0, 0};
    int64_t expected[2];
    gn_make_segment(&segment, a, b);
    gn_make_segment(&swapped, b, a);
    gn_segment_rows(&segment, &cells->rows, &rows[0], &rows[1]);
    count->segments++;
    find_rows(&cells->rows, &l, expected);
    if ((rows[0] != expected[0] || rows[1] != expected[1]) && (rows[0] <= rows[1] || expected[0] <= expected[1]) &&
        failed(count, &l))
        note("    rows %d to %d, expected %ld to %ld", (int)rows[0], (int)rows[1], (long)expected[0],
             (long)expected[1]);
    int follows = 0; /* before holds the row above's columns */
    for (int32_t row = rows[0]; row <= rows[1]; row++) {
        int32_t columns[2];
        check_row(cells, &segment, &l, row, columns, count);
        /* a table's cells end where a segment may go on */
        int none = cells->columns.places && columns[1] < columns[0];
        if (!none && (columns[1] < columns[0] || (follows && (columns[0] > before[1] || columns[1] < before[0]))) &&
            failed(count, &l))
            note("    row %d: columns %d to %d do not continue %d to %d", (int)row, (int)columns[0], (int)columns[1],
                 (int)before[0], (int)before[1]);
        memcpy(before, columns, sizeof before);
        follows = !none;
        if (none)
            continue;
        check_point(cells, &segment, &swapped, &l, columns[0], row, count);
        check_point(cells, &segment, &swapped, &l, columns[1], row, count);
        check_point(cells, &segment, &swapped, &l, between(columns[0], columns[1]), row, count);
        if (row - rows[0] >= MOST_ROWS / 2 && rows[1] - row >= MOST_ROWS / 2) {
            row = between(row, rows[1] - 2);
            follows = 0;
        }
    }
}

/* ---- which segments ---------------------------------------------------------------------------------------------- */

static gn_vertex vertex_at(int32_t x, int32_t y)
{
    gn_vertex v = {x + HALF, y + HALF, (uint32_t)between(1, 0x7fffffff)};
    return v;
}

/* About a cell's borders, its corners and its middle. */
static const int16_t places[] = {-261, -256, -252, -5,  -4,  -3,  -1,  0,   1,   3,   4,   5,   60,  127, 128,
                                 129,  196,  251,  252, 253, 255, 256, 257, 259, 260, 261, 384, 508, 512, 516};
enum { PLACES = sizeof places / sizeof places[0] };

static void every_pair_of_special_places(int every)
{
    tally count = {0};
    for (int i = 0; i < PLACES * PLACES; i++)
        for (int j = i % every; j <= i; j += every) {
            gn_vertex a = vertex_at(places[i % PLACES], places[i / PLACES]);
            gn_vertex b = vertex_at(places[j % PLACES], places[j / PLACES]);
            check_segment(&even, &a, &b, &count);
        }
    ok(!count.failures, "segments between places on and about borders: %llu, with %llu cells at the ends of their rows",
       (unsigned long long)count.segments, (unsigned long long)count.cells);
    ok(count.segments > 10000 && count.empty > count.segments && count.upper > 1000 && count.lower > 1000 &&
           count.nearer > 1000 && count.corners > 1000 && count.crossings > 1000 && count.middles > 1000,
       "%llu points at the upper end, %llu at the lower, %llu of two the nearer, %llu in a corner; %llu at a "
       "crossing, %llu between two, %llu of these by a hair",
       (unsigned long long)count.upper, (unsigned long long)count.lower, (unsigned long long)count.nearer,
       (unsigned long long)count.corners, (unsigned long long)count.crossings, (unsigned long long)count.middles,
       (unsigned long long)count.undecided);
}

static int32_t inside(int64_t v)
{
    return (int32_t)(v < 1 - REACH ? 1 - REACH : v >= REACH ? REACH - 1 : v);
}

/* A coordinate that now and then lies on or about a border of cells. */
static int32_t random_coordinate(int64_t reach)
{
    int32_t v = between(-reach, reach);
    int how = between(0, 7);
    return how == 0   ? v & ~(CELL - 1)
           : how == 1 ? (v & ~(CELL - 1)) + between(-3, 3)
           : how == 2 ? (v & ~(CELL - 1)) + between(-1, 1)
                      : v;
}

/* From one place by every length: level, upright, diagonal, through corners, or anyhow. */
static void random_segment(gn_vertex *a, gn_vertex *b)
{
    int64_t length = between(0, ((int64_t)1 << between(0, 22)) - 1);
    int32_t x = random_coordinate(between(0, 3) ? 4096 : REACH), y = random_coordinate(between(0, 3) ? 4096 : REACH);
    int64_t dx = between(-length, length), dy = between(-length, length);
    int how = between(0, 9);
    dx = how == 0 || how == 1 ? 0 : how == 2 ? length : dx;
    dy = how == 3 || how == 1 ? 0 : how == 2 ? (between(0, 1) ? length : -length) : dy;
    if (how == 4) { /* from corner to corner, and beyond: through others */
        x &= ~(CELL - 1);
        y &= ~(CELL - 1);
        dx = CELL * (int64_t)between(-9, 9) * between(1, 9);
        dy = CELL * (int64_t)between(-9, 9) * between(1, 9);
    }
    *a = vertex_at(0, 0);
    *b = vertex_at(0, 0);
    a->x = inside(x + HALF);
    a->y = inside(y + HALF);
    b->x = inside(x + dx + HALF);
    b->y = inside(y + dy + HALF);
    if (between(0, 7) == 0)
        b->depth = a->depth;
}

static void random_segments(uint64_t cases)
{
    tally count = {0};
    for (uint64_t n = 0; n < cases && count.failures < 5; n++) {
        gn_vertex a, b;
        random_segment(&a, &b);
        check_segment(&even, &a, &b, &count);
    }
    ok(!count.failures, "segments of all lengths: %llu, with %llu cells at the ends of their rows",
       (unsigned long long)count.segments, (unsigned long long)count.cells);
    ok(count.empty > cases && count.upper > cases / 4 && count.lower > cases / 4 && count.nearer > cases / 50 &&
           count.corners > cases / 100 && count.crossings > cases / 4 && count.middles > cases / 4,
       "%llu points at the upper end, %llu at the lower, %llu of two the nearer, %llu in a corner; %llu at a "
       "crossing, %llu between two, %llu of these by a hair",
       (unsigned long long)count.upper, (unsigned long long)count.lower, (unsigned long long)count.nearer,
       (unsigned long long)count.corners, (unsigned long long)count.crossings, (unsigned long long)count.middles,
       (unsigned long long)count.undecided);
}

/* ---- cells of unequal width and height --------------------------------------------------------------------------- */

enum { MOST_CENTRES = 40, WIDEST = 700 };

typedef struct table {
    uint16_t places[2][MOST_CENTRES];
    gn_cells cells;
} table;

/* Steps of one texel, of a few, of any number. */
static gn_axis random_axis(uint16_t centres[MOST_CENTRES])
{
    gn_axis axis = {centres, 0, between(2, MOST_CENTRES), &gn_rectilinear_cells};
    int32_t at = between(0, 1) ? between(0, 9) : between(0, 2000), most = between(0, 2) ? between(1, 12) : WIDEST;
    for (int32_t i = 0; i < axis.end; i++) {
        centres[i] = (uint16_t)at;
        at += between(0, 2) ? between(1, between(0, 7) ? most : WIDEST) : 1;
        at = at < 8192 ? at : 8191;
    }
    /* what was held at the end is left out */
    while (axis.end > 2 && centres[axis.end - 1] == 8191)
        axis.end--;
    axis.first = between(0, 3) ? 0 : between(0, axis.end - 2); /* as a region's rows */
    return axis;
}

/* On a centre, about one, anywhere, far outside. */
static int32_t random_place(const gn_axis *axis)
{
    int64_t first = centre_of(axis, 0), last = centre_of(axis, axis->end - 1), out = (last - first) / 3 + 300;
    int32_t centre = (int32_t)centre_of(axis, between(0, axis->end - 1)), how = between(0, 7);
    int32_t v = how < 2    ? centre
                : how == 2 ? centre + between(-3, 3)
                : how < 7  ? between(first - out, last + out)
                           : between(-REACH, REACH);
    return inside(v + HALF) - HALF;
}

static void random_segment_on(const gn_cells *cells, gn_vertex *a, gn_vertex *b)
{
    int how = between(0, 15);
    *a = vertex_at(random_place(&cells->columns), random_place(&cells->rows));
    *b = vertex_at(random_place(&cells->columns), random_place(&cells->rows));
    if (how == 0)
        b->x = a->x;
    if (how == 1)
        b->y = a->y;
    if (how < 6 && how > 2) { /* short */
        b->x = inside(a->x + between(-600, 600));
        b->y = inside(a->y + between(-600, 600));
    }
}

static void random_segments_on_tables(uint64_t cases)
{
    static table t;
    tally count = {0};
    uint64_t narrow = 0, uneven = 0;
    for (uint64_t n = 0; n < cases && count.failures < 5; n++) {
        gn_vertex a, b;
        if (n % 16 == 0) {
            t.cells.columns = random_axis(t.places[0]);
            t.cells.rows = random_axis(t.places[1]);
            int32_t width = gn_step_after(&t.cells.columns, 0), height = gn_step_after(&t.cells.rows, 0);
            narrow += width == 1 || height == 1;
            uneven += width > 50 * height || height > 50 * width;
        }
        random_segment_on(&t.cells, &a, &b);
        check_segment(&t.cells, &a, &b, &count);
    }
    ok(!count.failures, "segments over cells of unequal width and height: %llu, with %llu cells",
       (unsigned long long)count.segments, (unsigned long long)count.cells);
    ok(count.empty > cases && count.upper > cases / 4 && count.lower > cases / 4 && count.nearer > cases / 50 &&
           count.corners > cases / 50 && count.crossings > cases / 4 && count.middles > cases / 4 &&
           narrow > cases / 100 && uneven > cases / 400,
       "%llu points at the upper end, %llu at the lower, %llu of two the nearer, %llu in a corner; %llu at a crossing, "
       "%llu between two, %llu of these by a hair; %llu tables that begin with a cell of one texel, %llu with one of 1 "
       "to 50",
       (unsigned long long)count.upper, (unsigned long long)count.lower, (unsigned long long)count.nearer,
       (unsigned long long)count.corners, (unsigned long long)count.crossings, (unsigned long long)count.middles,
       (unsigned long long)count.undecided, (unsigned long long)narrow, (unsigned long long)uneven);
}

/* Cells as many texels wide and high as each other, and the segment as much longer: ways are the same quotients, and
 * shares of a side are rounded down once. */
static void wide_cells_are_like_small_ones(uint64_t cases)
{
    static table t;
    unsigned failures = 0;
    uint64_t points = 0;
    for (uint64_t n = 0; n < cases && failures < 5; n++) {
        int32_t count = between(2, MOST_CENTRES), times = between(1, 16), start = between(0, 99);
        const gn_cells small = {{0, 0, count, 0}, {0, 0, count, 0}};
        const gn_cells wide = {{t.places[0], 0, count, &gn_rectilinear_cells},
                               {t.places[0], 0, count, &gn_rectilinear_cells}};
        gn_vertex v[2][2];
        gn_segment segment[2];
        int32_t rows[2][2], columns[2][2];
        for (int32_t i = 0; i < count; i++)
            t.places[0][i] = (uint16_t)(times * i + start);
        for (int i = 0; i < 2; i++) {
            int64_t out = between(0, 7) ? 256 * count + 600 : REACH / 16 - 30000;
            int32_t x = between(-out, out), y = between(-out, out);
            v[0][i] = vertex_at(x, y);
            v[1][i] = vertex_at(times * x + 256 * start, times * y + 256 * start);
            v[1][i].depth = v[0][i].depth;
        }
        for (int i = 0; i < 2; i++) {
            gn_make_segment(&segment[i], &v[i][0], &v[i][1]);
            gn_segment_rows(&segment[i], i ? &wide.rows : &small.rows, &rows[i][0], &rows[i][1]);
        }
        int same = rows[0][0] > rows[0][1] ? rows[1][0] > rows[1][1] : memcmp(rows[0], rows[1], sizeof rows[0]) == 0;
        for (int32_t row = rows[0][0]; same && row <= rows[0][1]; row++) {
            gn_segment_columns(&segment[0], &small, row, &columns[0][0], &columns[0][1]);
            gn_segment_columns(&segment[1], &wide, row, &columns[1][0], &columns[1][1]);
            same = columns[0][0] > columns[0][1] ? columns[1][0] > columns[1][1]
                                                 : memcmp(columns[0], columns[1], sizeof columns[0]) == 0;
            for (int32_t column = columns[0][0]; same && column <= columns[0][1]; column++) {
                gn_segment_point p[2];
                find_point(&small, &segment[0], column, row, &p[0]);
                find_point(&wide, &segment[1], column, row, &p[1]);
                same = p[0].x == p[1].x && p[0].y == p[1].y && p[0].z == p[1].z;
                points++;
            }
        }
        if (!same && failures++ < 5)
            note("(%d, %d) to (%d, %d): not the same %d times as large", (int)v[0][0].x, (int)v[0][0].y, (int)v[0][1].x,
                 (int)v[0][1].y, (int)times);
    }
    ok(!failures && points > cases, "cells of many texels are like cells of one: %llu points",
       (unsigned long long)points);
}

/* ---- by hand ----------------------------------------------------------------------------------------------------- */

typedef struct by_hand {
    const char *what;
    int32_t x[2], y[2];
    int32_t column, row;
    int32_t px, py;
    uint32_t pz; /* from z 1000 to 2000 */
} by_hand;

static const by_hand by_hands[] = {
    {"across: the diagonals at 64 and 192, the middle of them", {-1024, 1024}, {64, 64}, 0, 0, 128, 64, 1562},
    {"down: the same", {64, 64}, {-1024, 1024}, 0, 0, 64, 128, 1562},
    {"through the middle: both diagonals at once", {-512, 768}, {-128, 384}, 0, 0, 128, 128, 1500},
    {"along a diagonal: where the other one is", {-512, 768}, {-512, 768}, 0, 0, 128, 128, 1500},
    {"off a corner: one diagonal, x = y = 32", {-192, 256}, {256, -192}, 0, 0, 32, 32, 1500},
    {"an end in the cell", {10, 2000}, {20, 3000}, 0, 0, 10, 20, 1000},
    {"both ends in the cell: the nearer", {10, 200}, {20, 30}, 0, 0, 10, 20, 1000},
    {"an end at a corner of the cell", {0, -2000}, {256, 2000}, 0, 0, 0, 256, 1000},
};

static void points_by_hand(void)
{
    for (size_t i = 0; i < sizeof by_hands / sizeof by_hands[0]; i++) {
        const by_hand *h = &by_hands[i];
        gn_vertex a = {h->x[0] + HALF, h->y[0] + HALF, 1000}, b = {h->x[1] + HALF, h->y[1] + HALF, 2000};
        gn_segment segment;
        gn_segment_point p;
        gn_make_segment(&segment, &a, &b);
        find_point(&even, &segment, h->column, h->row, &p);
        /* rounded down, as is the way */
        int good =
            p.x <= h->px && p.x >= h->px - 1 && p.y <= h->py && p.y >= h->py - 1 && p.z + 1 >= h->pz && p.z <= h->pz;
        if (!ok(good, "by hand: %s", h->what))
            note("got (%d, %d), z %u; expected (%d, %d), z %u, or one less", (int)p.x, (int)p.y, (unsigned)p.z,
                 (int)h->px, (int)h->py, (unsigned)h->pz);
    }
}

int main(int argc, char **argv)
{
    uint64_t cases = tap_cases(argc, argv, 400000);
    int every = TAP_SLOWER > 1 ? 4 : 1;
    points_by_hand();
    every_pair_of_special_places(every);
    random_segments(cases);
    random_segments_on_tables(cases / 2);
    wide_cells_are_like_small_ones(cases / 8);
    return tap_done();
}
