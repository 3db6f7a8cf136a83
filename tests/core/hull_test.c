/* Smallest rectangles against slow twins in integers of 128 bits that know neither columns nor chains: one tries the
 * direction between any two corners of the samples' cells; the other, for large sets, wraps the hull as a gift (Jarvis
 * 1973) and tries its edges. Sets are of all kinds: few or many samples, in a line, a column or a row, on lattices full
 * of ties, at the ends of the range, circles, turned boxes, and the convex polygon with the most corners.
 * Cases: 6000 small sets and 1 large one for each 60 of them, or GNOMON_CASES. */
#include "gn_hull.h"
#include "tap.h"

#include <math.h>
#include <string.h>

#define ONE ((int32_t)1 << 30) /* Q2.30 */
#define SIDE 65536             /* of the plane, in the units of this file */
#define CELL_WIDTH 16          /* 4096 columns */
#define CELL_HEIGHT 2          /* 32768 rows */
#define SMALL_MAX 12
#define LARGE_MAX 40000

__extension__ typedef __int128 exact;

struct point {
    int64_t x, y;
};

static uint64_t random_state = 7;
static gn_extent extents[GN_HULL_COLUMNS], partial[GN_HULL_COLUMNS], again[GN_HULL_COLUMNS];
static struct point samples[LARGE_MAX], corners[4 * LARGE_MAX], hull[4 * LARGE_MAX];
static int sample_count, corner_count, hull_count;

static int64_t between(int64_t low, int64_t high)
{
    return low + (int64_t)(tap_random(&random_state) % ((uint64_t)(high - low) + 1));
}

static int64_t held(int64_t v)
{
    return v < 0 ? 0 : v >= SIDE ? SIDE - 1 : v;
}

/* Samples beyond the plane go to its border. */
static void add(int64_t x, int64_t y)
{
    struct point p = {held(x), held(y)};
    if (sample_count < LARGE_MAX)
        samples[sample_count++] = p;
}

/* Somewhere in [x, x + 1) x [y, y + 1), but always there. */
static void add_to(gn_extent to[GN_HULL_COLUMNS], struct point p)
{
    uint64_t state = (uint64_t)(p.x * SIDE + p.y), place = tap_random(&state);
    gn_add_extent(to, (uint32_t)(p.x << 14 | (int64_t)(place & 0x3fff)),
                  (uint32_t)(p.y << 14 | (int64_t)(place >> 50)));
}

static int find(gn_rectangle *rectangle)
{
    gn_clear_extents(extents);
    for (int i = 0; i < sample_count; i++)
        add_to(extents, samples[i]);
    return gn_find_rectangle(rectangle, extents);
}

/* ---- twins ------------------------------------------------------------------------------------------------------- */

static void set_corners(void)
{
    corner_count = 0;
    for (int i = 0; i < sample_count; i++) {
        for (int k = 0; k < 4; k++) {
            struct point p = {(samples[i].x / CELL_WIDTH + (k & 1)) * CELL_WIDTH,
                              (samples[i].y / CELL_HEIGHT + (k >> 1)) * CELL_HEIGHT};
            corners[corner_count++] = p;
        }
    }
}

static exact cross(struct point a, struct point b)
{
    return (exact)a.x * b.y - (exact)a.y * b.x;
}

static struct point minus(struct point a, struct point b)
{
    struct point difference = {a.x - b.x, a.y - b.y};
    return difference;
}

static void widen(exact *low, exact *high, exact v)
{
    *low = v < *low ? v : *low;
    *high = v > *high ? v : *high;
}

/* The best direction so far, x > 0 and y >= 0; its rectangle's area is n / d. */
struct smallest {
    struct point direction;
    exact n, d;
    int shared; /* another direction has the same area */
};

static void try_direction(struct smallest *best, struct point d, const struct point *points, int count)
{
    if (d.x == 0 && d.y == 0)
        return;
    while (d.x <= 0 || d.y < 0) {
        struct point turned = {d.y, -d.x};
        d = turned;
    }
    exact most = (exact)1 << 40, low[2] = {most, most}, high[2] = {-most, -most};
    for (int i = 0; i < count; i++) {
        exact along = (exact)points[i].x * d.x + (exact)points[i].y * d.y, across = cross(d, points[i]);
        widen(&low[0], &high[0], along);
        widen(&low[1], &high[1], across);
    }
    struct smallest found = {d, (high[0] - low[0]) * (high[1] - low[1]), (exact)d.x * d.x + (exact)d.y * d.y, 0};
    exact smaller = best->d ? found.n * best->d - best->n * found.d : -1;
    if (smaller == 0 && cross(d, best->direction) != 0) {
        best->shared = 1;
        if (cross(d, best->direction) > 0)
            best->direction = d;
    } else if (smaller < 0) {
        *best = found;
    }
}

static struct smallest smallest_of_all_pairs(void)
{
    struct smallest best = {{0, 0}, 0, 0, 0};
    for (int i = 0; i < corner_count; i++) {
        for (int k = 0; k < i; k++)
            try_direction(&best, minus(corners[i], corners[k]), corners, corner_count);
    }
    return best;
}

/* From the lowest corner, the leftmost of those, go on to the one that leaves all others on the left; of several in a
 * line to the farthest. */
static void wrap_hull(void)
{
    struct point at = corners[0];
    for (int i = 1; i < corner_count; i++) {
        if (corners[i].y < at.y || (corners[i].y == at.y && corners[i].x < at.x))
            at = corners[i];
    }
    hull_count = 0;
    do {
        hull[hull_count++] = at;
        struct point way = {0, 0};
        for (int i = 0; i < corner_count; i++) {
            struct point other = minus(corners[i], at);
            exact side = cross(way, other), farther = (exact)other.x * other.x + (exact)other.y * other.y -
                                                      ((exact)way.x * way.x + (exact)way.y * way.y);
            if (side < 0 || (side == 0 && farther > 0))
                way = other;
        }
        at.x += way.x;
        at.y += way.y;
    } while (at.x != hull[0].x || at.y != hull[0].y);
}

static struct smallest smallest_of_the_hull(void)
{
    struct smallest best = {{0, 0}, 0, 0, 0};
    wrap_hull();
    for (int i = 0; i < hull_count; i++)
        try_direction(&best, minus(hull[(i + 1) % hull_count], hull[i]), hull, hull_count);
    return best;
}

/* ---- what is promised of a rectangle ----------------------------------------------------------------------------- */

struct tally {
    uint64_t sets, angle, bounds, outside; /* sets, and those where something is wrong */
    uint64_t left, straight, right, half;  /* turned counterclockwise, not at all, clockwise, by 45 degrees */
    uint64_t shared;                       /* with several smallest rectangles */
    long double error;                     /* of cosine and sine, in 2^-30 */
};

static exact dot(struct point p, gn_q2_30 x, gn_q2_30 y)
{
    return (exact)p.x * x + (exact)p.y * y;
}

/* floor(v / 2^16): from Q2.30 in units to 2^-30 of the side. */
static exact floor_place(exact v)
{
    exact unit = (exact)1 << 16;
    return v < 0 ? -((-v + unit - 1) / unit) : v / unit;
}

static int bounds_are_exact(const gn_rectangle *r)
{
    gn_q2_30 axes[2][2] = {{r->cosine, r->sine}, {-r->sine, r->cosine}};
    for (int k = 0; k < 2; k++) {
        exact low = dot(corners[0], axes[k][0], axes[k][1]), high = low;
        for (int i = 1; i < corner_count; i++)
            widen(&low, &high, dot(corners[i], axes[k][0], axes[k][1]));
        if (r->low[k] != floor_place(low) || (exact)r->low[k] + r->size[k] != -floor_place(-high))
            return 0;
    }
    return 1;
}

/* Each sample's own unit square. */
static int contains_every_sample(const gn_rectangle *r)
{
    gn_q2_30 axes[2][2] = {{r->cosine, r->sine}, {-r->sine, r->cosine}};
    for (int i = 0; i < 4 * sample_count; i++) {
        struct point p = {samples[i / 4].x + (i & 1), samples[i / 4].y + (i >> 1 & 1)};
        for (int k = 0; k < 2; k++) {
            exact place = dot(p, axes[k][0], axes[k][1]) - (exact)r->low[k] * SIDE;
            if (place < 0 || place > (exact)r->size[k] * SIDE)
                return 0;
        }
    }
    return 1;
}

/* Steeper than 45 degrees: the same rectangle by its other side. */
static struct point axis_of(struct point direction)
{
    struct point other = {direction.y, -direction.x};
    return direction.y > direction.x ? other : direction;
}

static void check(struct tally *tally, struct smallest (*twin)(void), const char *kind)
{
    gn_rectangle r;
    tally->sets++;
    if (!find(&r)) {
        tally->angle++;
        note("%s: no rectangle", kind);
        return;
    }
    set_corners();
    struct smallest best = twin();
    struct point axis = axis_of(best.direction);
    long double length = hypotl((long double)axis.x, (long double)axis.y);
    long double cosine = (long double)axis.x / length * ONE, sine = (long double)axis.y / length * ONE;
    long double error = fmaxl(fabsl((long double)r.cosine - cosine), fabsl((long double)r.sine - sine));
    if (error > 0.75L && tally->angle++ < 3)
        note("%s, %d samples: got axis %ld %ld, expected %.2Lf %.2Lf", kind, sample_count, (long)r.cosine, (long)r.sine,
             cosine, sine);
    tally->error = fmaxl(tally->error, error);
    if (!bounds_are_exact(&r) && tally->bounds++ < 3)
        note("%s, %d samples: from %ld %ld, %ld by %ld", kind, sample_count, (long)r.low[0], (long)r.low[1],
             (long)r.size[0], (long)r.size[1]);
    tally->outside += !contains_every_sample(&r);
    tally->left += r.sine > 0;
    tally->straight += r.sine == 0;
    tally->right += r.sine < 0;
    tally->half += r.sine == r.cosine;
    tally->shared += (uint64_t)best.shared;
}

static void report(const struct tally *tally, const char *sets)
{
    ok(tally->angle == 0, "the_smallest_rectangle_of_%s_is_found", sets);
    ok(tally->bounds == 0, "bounds_of_%s_are_those_of_their_cells_rounded_outward", sets);
    ok(tally->outside == 0, "rectangles_of_%s_contain_every_sample", sets);
    note(
        "%lu sets: %lu turned left (%lu by 45 degrees), %lu right, %lu straight; %lu with several smallest ones; error "
        "of the axis %.3Lf / 2^30",
        (unsigned long)tally->sets, (unsigned long)tally->left, (unsigned long)tally->half, (unsigned long)tally->right,
        (unsigned long)tally->straight, (unsigned long)tally->shared, tally->error);
}

/* ---- small sets -------------------------------------------------------------------------------------------------- */

enum { ANYWHERE, NEAR, LATTICE, LINE, COLUMN, ROW, ENDS, SMALL_KINDS };
static const char *const small_kinds[SMALL_KINDS] = {"anywhere", "near", "lattice", "line", "column", "row", "ends"};

static void small_set(int kind)
{
    int64_t x = between(0, SIDE - 1), y = between(0, SIDE - 1), size = INT64_C(1) << between(0, 12);
    struct point way = {between(-6, 6), between(-6, 6)};
    sample_count = 0;
    for (int64_t n = between(1, SMALL_MAX); n > 0; n--) {
        switch (kind) {
        case ANYWHERE:
            add(between(0, SIDE - 1), between(0, SIDE - 1));
            break;
        case NEAR:
            add(x + between(-size, size), y + between(-size, size));
            break;
        case LATTICE: /* of squares, so that cells' corners are often as far apart along u as along v */
            add(32768 + between(-3, 3) * CELL_WIDTH * size / 16, 32768 + between(-3, 3) * CELL_WIDTH * size / 16);
            break;
        case LINE: {
            int64_t step = between(-40, 40);
            add(x + step * CELL_WIDTH * way.x, y + step * CELL_WIDTH * way.y);
            break;
        }
        case COLUMN:
            add(x, between(0, SIDE - 1));
            break;
        case ROW:
            add(between(0, SIDE - 1), y);
            break;
        case ENDS:
            add(between(0, 1) ? between(0, 2) * 8 : SIDE - 1 - between(0, 2) * 8,
                between(0, 1) ? between(0, 4) : SIDE - 1 - between(0, 4));
            break;
        }
    }
}

static void small_sets(uint64_t cases)
{
    struct tally tally = {0};
    for (uint64_t i = 0; i < cases; i++) {
        int kind = (int)(i % SMALL_KINDS);
        small_set(kind);
        check(&tally, smallest_of_all_pairs, small_kinds[kind]);
    }
    report(&tally, "small_sets");
    ok(tally.left && tally.straight && tally.right && tally.half && tally.shared,
       "small_sets_turn_either_way_by_45_degrees_and_not_at_all_and_some_have_several_smallest_rectangles");
}

/* ---- large sets -------------------------------------------------------------------------------------------------- */

enum { CLOUD, CIRCLE, BOX, FULL, NOISY, POLYGON, LARGE_KINDS };
static const char *const large_kinds[LARGE_KINDS] = {"cloud", "circle", "box", "full", "noisy", "polygon"};

static int64_t greatest_divisor(int64_t a, int64_t b)
{
    return b ? greatest_divisor(b, a % b) : a;
}

/* The corners of a convex polygon, each in a cell of its own, whose edges are the shortest with whole cells along u and
 * v: nearly as many as fit into the plane. */
static void polygon(void)
{
    enum { COLUMNS = 13, ROWS = 108 };
    static struct point edges[4 * (COLUMNS + 1) * (ROWS + 1)];
    int count = 0;
    for (int64_t x = -COLUMNS; x <= COLUMNS; x++) {
        for (int64_t y = -ROWS; y <= ROWS; y++) {
            if (llabs(x) * 8 + llabs(y) <= ROWS && greatest_divisor(llabs(x), llabs(y)) == 1) {
                /* by angle, from -180 degrees on */
                int i = count++;
                struct point edge = {x, y};
                int lower = y < 0 || (y == 0 && x > 0);
                for (; i > 0; i--) {
                    int other = edges[i - 1].y < 0 || (edges[i - 1].y == 0 && edges[i - 1].x > 0);
                    if (other > lower || (other == lower && cross(edges[i - 1], edge) > 0))
                        break;
                    edges[i] = edges[i - 1];
                }
                edges[i] = edge;
            }
        }
    }
    /* Left and down first: from the upper end to the left one it is as far as the edges with x < 0, y <= 0 go. */
    struct point at = {0, 0};
    for (int i = 0; i < count; i++) {
        at.x -= edges[i].x < 0 && edges[i].y <= 0 ? edges[i].x : 0;
        at.y += edges[i].y > 0 ? edges[i].y : 0;
    }
    for (int i = 0; i < count; i++) {
        add(at.x * CELL_WIDTH, at.y * CELL_HEIGHT);
        at.x += edges[i].x;
        at.y += edges[i].y;
    }
}

static void large_set(int kind)
{
    double angle = (double)between(0, 6283) / 1000, radius = (double)between(500, 32768);
    int64_t n = between(200, 5000);
    double x = (double)between(20000, 45000), y = (double)between(20000, 45000);
    sample_count = 0;
    switch (kind) {
    case CLOUD:
        for (; n > 0; n--)
            add(between(0, SIDE - 1), between(0, SIDE - 1));
        break;
    case CIRCLE:
        for (int i = 0; i < 8192; i++)
            add((int64_t)(32768 + radius * cos(i * 0.000767)), (int64_t)(32768 + radius * sin(i * 0.000767)));
        break;
    case BOX:
        for (; n > 0; n--) {
            double along = (double)between(-16000, 16000), across = (double)between(-5000, 5000);
            add((int64_t)(x + cos(angle) * along - sin(angle) * across),
                (int64_t)(y + sin(angle) * along + cos(angle) * across));
        }
        break;
    case FULL:
        for (int64_t u = 0; u < SIDE; u += CELL_WIDTH) {
            add(u, 0);
            add(u + CELL_WIDTH - 1, SIDE - 1);
        }
        break;
    case NOISY: /* a band that fills all columns */
        for (int64_t u = 0; u < SIDE; u += between(1, CELL_WIDTH))
            add(u, (int64_t)(y + sin(angle) * ((double)u - 32768) * 0.7) + between(-300, 300));
        break;
    case POLYGON:
        polygon();
        break;
    }
}

static void large_sets(uint64_t cases)
{
    struct tally tally = {0};
    int most = 0;
    for (uint64_t i = 0; i < cases || i < LARGE_KINDS; i++) {
        int kind = (int)(i % LARGE_KINDS);
        if (i >= LARGE_KINDS && (kind == FULL || kind == POLYGON))
            continue; /* always the same */
        large_set(kind);
        check(&tally, smallest_of_the_hull, large_kinds[kind]);
        most = hull_count > most ? hull_count : most;
    }
    report(&tally, "large_sets");
    note("up to %d corners", most);
    ok(most > 1750, "more_than_1750_corners_fit");
}

/* ---- order ------------------------------------------------------------------------------------------------------- */

static void order_does_not_matter(uint64_t cases)
{
    uint64_t bad = 0;
    for (uint64_t i = 0; i < cases; i++) {
        gn_rectangle r = {0}, other = {0};
        if (i % 2)
            large_set(i % 4 == 1 ? CLOUD : BOX);
        else
            small_set((int)(i / 2 % SMALL_KINDS));
        int workers = (int)between(1, 4);
        find(&r);
        for (int k = sample_count - 1; k > 0; k--) {
            int64_t from = between(0, k);
            struct point p = samples[k];
            samples[k] = samples[from];
            samples[from] = p;
        }
        gn_clear_extents(again);
        for (int worker = 0; worker < workers; worker++) {
            gn_clear_extents(partial);
            for (int k = worker; k < sample_count; k += workers)
                add_to(partial, samples[k]);
            gn_merge_extents(again, partial);
        }
        bad += !gn_find_rectangle(&other, again) || memcmp(&r, &other, sizeof r) != 0;
    }
    ok(bad == 0, "order_of_samples_and_their_split_among_workers_do_not_matter");
}

/* ---- by hand ----------------------------------------------------------------------------------------------------- */

/* Sides in units, which are 2^14 of the rectangle's. */
static int is_upright(const gn_rectangle *r, int32_t left, int32_t top, int32_t width, int32_t height)
{
    const int32_t unit = 1 << 14;
    int good = r->cosine == ONE && r->sine == 0 && r->low[0] == left * unit && r->low[1] == top * unit &&
               r->size[0] == width * unit && r->size[1] == height * unit;
    if (!good)
        note("got axis %ld %ld, from %ld %ld, %ld by %ld", (long)r->cosine, (long)r->sine, (long)r->low[0],
             (long)r->low[1], (long)r->size[0], (long)r->size[1]);
    return good;
}

static void rectangles_made_by_hand(void)
{
    gn_rectangle r = {12345, 0, {0, 0}, {0, 0}};
    sample_count = 0;
    ok(find(&r) == 0 && r.cosine == 12345, "no_samples_have_no_rectangle");

    add(100, 201);
    find(&r);
    ok(is_upright(&r, 96, 200, 16, 2), "one_sample_is_its_cell");

    add(SIDE, SIDE);
    add(0, SIDE);
    add(0, 0);
    add(SIDE, 0);
    find(&r);
    ok(is_upright(&r, 0, 0, SIDE, SIDE), "the_full_plane_is_not_turned_and_no_larger");

    sample_count = 0;
    for (int x = 0; x < SIDE; x += 8)
        add(x, 5000);
    find(&r);
    ok(is_upright(&r, 0, 5000, SIDE, 2), "one_row");

    sample_count = 0;
    for (int y = 0; y < SIDE; y += 2)
        add(31, y);
    find(&r);
    ok(is_upright(&r, 16, 0, 16, SIDE), "one_column");

    /* Along the diagonal the hull is from (0, 0) to (65536, 65522), across from (16, 0) to (0, 2): (131058, -16 to 2)
     * over the root of 2; upright it would be larger. Times 2^14 / 2^30 times 759250125, that is round(2^30 / sqrt(2)):
     * 1518338056.7, -185363.8 and 23170.5. */
    sample_count = 0;
    for (int x = 0; x < SIDE; x += 16)
        add(x, x);
    find(&r);
    ok(r.cosine == 759250125 && r.sine == 759250125 && r.low[0] == 0 && r.size[0] == 1518338057 &&
           r.low[1] == -185364 && r.size[1] == 185364 + 23171,
       "the_diagonal_is_at_45_degrees");

    sample_count = 0;
    for (int x = 0; x < SIDE; x += 16)
        add(SIDE - 16 - x, x);
    find(&r);
    ok(r.cosine == 759250125 && r.sine == 759250125, "the_other_diagonal_is_at_45_degrees_too_not_at_minus_45");

    /* Edges along (3, 4), and thus at 53.1 degrees: by its other side at -36.9. 4/5 and 3/5 of 2^30. */
    sample_count = 0;
    for (int k = 0; k < 1000; k++)
        add(48 * k, 64 * k);
    find(&r);
    ok(r.cosine == 858993459 && r.sine == -644245094, "a_steep_line_is_turned_back");
}

int main(int argc, char **argv)
{
    uint64_t cases = tap_cases(argc, argv, 6000);
    rectangles_made_by_hand();
    small_sets(cases);
    large_sets(cases / 60);
    order_does_not_matter(cases / 10);
    return tap_done();
}
