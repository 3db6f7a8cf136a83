/* Depth and Q planes of random triangles against exact rationals in 128 bits: gradients, values at every kind of
 * covered centre, steep planes in 64 bits, the rule for all but edge-on triangles, and the definition bit for bit.
 * Vertices lie up to 2^20 from the centre of a map of 4096, the worst that either pass may hand over. Cases: 300000, or
 * GNOMON_CASES. */
#include "gn_clip.h"
#include "tap.h"

#include <string.h>

__extension__ typedef __int128 exact;
__extension__ typedef unsigned __int128 exact_u;
typedef long double real;

static uint64_t random_state = 2;

static int64_t between(int64_t low, int64_t high)
{
    return low + (int64_t)(tap_random(&random_state) % ((uint64_t)(high - low) + 1));
}

static exact magnitude(exact v)
{
    return v < 0 ? -v : v;
}

/* A clockwise triangle and its exact gradients a 1/256 pixel, numerators over area. */
typedef struct triangle {
    gn_vertex v[3];
    exact area, nx, ny;
} triangle;

static void show(const triangle *t)
{
    for (int i = 0; i < 3; i++)
        note("    vertex %d: x %ld, y %ld (1/256 pixel), depth %lu", i, (long)t->v[i].x, (long)t->v[i].y,
             (unsigned long)t->v[i].depth);
}

static void find_gradients(triangle *t)
{
    const gn_vertex *v = t->v;
    exact dx1 = v[1].x - v[0].x, dy1 = v[1].y - v[0].y, dz1 = (exact)v[1].depth - v[0].depth;
    exact dx2 = v[2].x - v[0].x, dy2 = v[2].y - v[0].y, dz2 = (exact)v[2].depth - v[0].depth;
    t->area = dx1 * dy2 - dx2 * dy1;
    t->nx = dz1 * dy2 - dz2 * dy1;
    t->ny = dz2 * dx1 - dz1 * dx2;
}

/* Of every size from 1/16 pixel to the whole guard band; slivers, level and flat ones; depths within [low, high]. */
static triangle random_triangle(int64_t low, int64_t high)
{
    const int64_t centre = 128 * 4096, limit = GN_MAX_COORDINATE;
    triangle t;
    do {
        int64_t reach = (int64_t)16 << between(0, 17), x = between(-limit, limit), y = between(-limit, limit);
        int64_t span = (high - low) >> between(0, 30), base = between(low, high - span);
        for (int i = 0; i < 3; i++) {
            int64_t vx = x + between(-reach, reach), vy = y + between(-reach, reach);
            vx = vx < -limit ? -limit : vx > limit ? limit : vx;
            vy = vy < -limit ? -limit : vy > limit ? limit : vy;
            t.v[i].x = (int32_t)(centre + vx);
            t.v[i].y = (int32_t)(centre + vy);
            t.v[i].depth = (uint32_t)between(base, base + span);
            if (between(0, 15) == 0)
                t.v[i].depth = (uint32_t)(between(0, 1) ? low : high);
        }
        if (between(0, 3) == 0) { /* a sliver: the last vertex near the line through the others */
            int64_t k = between(0, 1000);
            t.v[2].x = (int32_t)(t.v[0].x + (t.v[1].x - t.v[0].x) * k / 1000 + between(-2, 2));
            t.v[2].y = (int32_t)(t.v[0].y + (t.v[1].y - t.v[0].y) * k / 1000 + between(-2, 2));
            if (between(0, 1)) /* in depth as well */
                t.v[2].depth = (uint32_t)(t.v[0].depth + ((int64_t)t.v[1].depth - t.v[0].depth) * k / 1000);
        }
        for (int i = 0; i < 3; i++) {
            t.v[i].x = t.v[i].x > centre + limit ? (int32_t)(centre + limit) : t.v[i].x;
            t.v[i].x = t.v[i].x < centre - limit ? (int32_t)(centre - limit) : t.v[i].x;
            t.v[i].y = t.v[i].y > centre + limit ? (int32_t)(centre + limit) : t.v[i].y;
            t.v[i].y = t.v[i].y < centre - limit ? (int32_t)(centre - limit) : t.v[i].y;
        }
        find_gradients(&t);
        if (t.area < 0) {
            gn_vertex v = t.v[1];
            t.v[1] = t.v[2];
            t.v[2] = v;
            find_gradients(&t);
        }
    } while (t.area == 0);
    return t;
}

/* Keep the leftmost, rightmost, highest and lowest covered centres and some between: a plane errs most there. */
enum { SAMPLES = 64 };
typedef struct samples {
    int32_t column[SAMPLES], row[SAMPLES];
    int count;
} samples;

GN_INLINE void collect(const void *state, int32_t row, int32_t left, int32_t right)
{
    samples *s = *(samples *const *)state;
    int32_t ends[2] = {left, right - 1};
    for (int i = 0; i < 2; i++) {
        int at = s->count < SAMPLES ? s->count++ : (int)between(2, SAMPLES - 1);
        s->column[at] = ends[i];
        s->row[at] = row;
    }
}

static void find_samples(samples *s, const triangle *t)
{
    gn_window map = {0, 0, 4096, 4096};
    gn_rows rows;
    s->count = 0;
    if (gn_find_rows(&rows, &t->v[0], &t->v[1], &t->v[2], &map)) {
        if (rows.bottom - rows.row > 200) { /* the middle of tall ones tells nothing new */
            gn_window parts[2] = {{0, rows.row, 4096, rows.row + 20}, {0, rows.bottom - 20, 4096, rows.bottom}};
            for (int i = 0; i < 2; i++)
                if (gn_find_rows(&rows, &t->v[0], &t->v[1], &t->v[2], &parts[i]))
                    gn_walk(&rows, &parts[i], 1, collect, &s);
            return;
        }
        gn_walk(&rows, &map, rows.cut, collect, &s);
    }
}

/* The most significant 32 bits of v as mantissa 2^exponent. */
static uint64_t leading_32(exact_u v, int *exponent)
{
    *exponent = 0;
    while (v >> 32) {
        v >>= 1;
        ++*exponent;
    }
    while (!(v >> 31)) {
        v <<= 1;
        --*exponent;
    }
    return (uint64_t)v;
}

/* The definition: leading 32 bits of |n| times floor((2^63 - 1) / leading 32 bits of A), the product cut to its upper
 * 32 bits: q 2^*exponent. */
static uint64_t quotient(exact n, exact area, int *exponent)
{
    int n_exponent, a_exponent;
    uint64_t a = leading_32((exact_u)area, &a_exponent);
    uint64_t reciprocal = (uint64_t)INT64_MAX / a;
    uint64_t m = leading_32((exact_u)magnitude(n), &n_exponent);
    *exponent = n_exponent - a_exponent - 63 + 32;
    return (uint64_t)(((exact_u)m * reciprocal) >> 32);
}

/* round(q 2^(exponent + 9)), as wide as it comes; half up. */
static exact defined_depth_gradient(exact n, exact area)
{
    int exponent;
    if (n == 0)
        return 0;
    exact g = (exact)quotient(n, area, &exponent);
    exponent += 9;
    if (exponent >= 0)
        g = exponent > 60 ? (exact)1 << 100 : g << exponent;
    else
        g = exponent < -40 ? 0 : (g + ((exact)1 << (-exponent - 1))) >> -exponent;
    return n < 0 ? -g : g;
}

static exact defined_q_gradient(exact n, exact area)
{
    int exponent;
    if (n == 0)
        return 0;
    exact g = (exact)quotient(n, area, &exponent);
    exponent += 32;
    g = exponent >= 0 ? g << exponent : exponent < -40 ? 0 : g >> -exponent;
    return n < 0 ? -g : g;
}

static int32_t as_signed(uint32_t v)
{
    return v & 0x80000000u ? -(int32_t)(~v) - 1 : (int32_t)v;
}

static exact floor_shift(exact v, int n)
{
    exact unit = (exact)1 << n, rest = v % unit;
    return (v - (rest < 0 ? rest + unit : rest)) / unit;
}

static void depth_planes_keep_their_bounds(uint64_t cases)
{
    uint64_t flat = 0, centres = 0;
    unsigned failures = 0;
    real worst_gradient = 0, worst_depth = 0, worst_units = 0;
    for (uint64_t n = 0; n < cases && failures < 5; n++) {
        triangle t = random_triangle(GN_DEPTH_GUARD, 0x80000000 - GN_DEPTH_GUARD);
        gn_depth_plane plane;
        samples s;
        int got_steep = gn_make_depth_plane(&plane, &t.v[0], &t.v[1], &t.v[2], (int64_t)t.area);
        int32_t g[2] = {as_signed(plane.dx), as_signed(plane.dy)};
        exact numerator[2] = {512 * t.nx, 512 * t.ny};
        exact d[2] = {defined_depth_gradient(t.nx, t.area), defined_depth_gradient(t.ny, t.area)};
        int steep = magnitude(d[0]) >> 30 || magnitude(d[1]) >> 30;
        if (got_steep != steep && failures++ < 5) {
            note("case %llu: steep is %d, gradients by definition %lld %lld, expected %d", (unsigned long long)n,
                 got_steep, (long long)d[0], (long long)d[1], steep);
            show(&t);
        }
        if (steep) {
            uint32_t farthest = 0;
            for (int i = 0; i < 3; i++)
                farthest = t.v[i].depth > farthest ? t.v[i].depth : farthest;
            /* the exact gradient is that steep too, within the quotient's error */
            real steepest = 0;
            for (int i = 0; i < 2; i++)
                steepest = (real)magnitude(numerator[i]) / (real)t.area > steepest
                               ? (real)magnitude(numerator[i]) / (real)t.area
                               : steepest;
            flat++;
            if ((plane.dx || plane.dy || plane.base != 2 * farthest || steepest < 1073741820.0L) && failures++ < 5) {
                note("case %llu, steep (%.1Lf a pixel): got base %lu, gradient %ld %ld; expected %lu, 0, 0",
                     (unsigned long long)n, steepest, (unsigned long)plane.base, (long)g[0], (long)g[1],
                     (unsigned long)(2 * farthest));
                show(&t);
            }
            continue;
        }
        exact moved = (128 - (exact)t.v[0].x) * d[0] + (128 - (exact)t.v[0].y) * d[1];
        uint32_t base = (uint32_t)(exact_u)(2 * (exact)t.v[0].depth + floor_shift(moved, 8));
        if ((g[0] != d[0] || g[1] != d[1] || plane.base != base) && failures++ < 5) {
            note("case %llu: got base %lu, gradient %ld %ld; by definition %lu, %lld %lld", (unsigned long long)n,
                 (unsigned long)plane.base, (long)g[0], (long)g[1], (unsigned long)base, (long long)d[0],
                 (long long)d[1]);
            show(&t);
        }
        real bound[2];
        for (int i = 0; i < 2; i++) {
            /* |g - exact| A <= (1/2 + |exact| 2^-29) A */
            real error = (real)magnitude((exact)g[i] * t.area - numerator[i]) / (real)t.area;
            bound[i] = 0.5L + (real)magnitude(numerator[i]) / (real)t.area / (1 << 29);
            if (error / bound[i] > worst_gradient)
                worst_gradient = error / bound[i];
            if (!(error <= bound[i]) && failures++ < 5) {
                note("case %llu: gradient %d is %ld, %.3Lf off, at most %.3Lf allowed", (unsigned long long)n, i,
                     (long)g[i], error, bound[i]);
                show(&t);
            }
        }
        find_samples(&s, &t);
        for (int i = 0; i < s.count; i++) {
            uint32_t z = plane.base + (uint32_t)s.column[i] * plane.dx + (uint32_t)s.row[i] * plane.dy;
            exact px = 256 * (exact)s.column[i] + 128 - t.v[0].x, py = 256 * (exact)s.row[i] + 128 - t.v[0].y;
            exact above = 2 * (t.nx * px + t.ny * py); /* z - 2 Z0, times the area */
            exact off = ((exact)z - 2 * (exact)t.v[0].depth) * t.area - above;
            real error = (real)magnitude(off) / (real)t.area;
            real allowed = (real)magnitude(px) / 256 * bound[0] + (real)magnitude(py) / 256 * bound[1] + 1;
            centres++;
            worst_depth = error / allowed > worst_depth ? error / allowed : worst_depth;
            worst_units = error > worst_units ? error : worst_units;
            if ((!(error <= allowed) || !(error < 2 * GN_DEPTH_GUARD)) && failures++ < 5) {
                note("case %llu, centre (%d, %d): depth %lu is %.2Lf units off, at most %.2Lf allowed",
                     (unsigned long long)n, (int)s.column[i], (int)s.row[i], (unsigned long)z, error, allowed);
                show(&t);
            }
        }
    }
    ok(!failures, "depth planes: gradients, depths and the definition, in %llu triangles", (unsigned long long)cases);
    ok(flat > cases / 1000 && centres > cases, "%llu were too steep, %llu centres were met", (unsigned long long)flat,
       (unsigned long long)centres);
    note("largest errors: gradient %.4Lf, depth %.4Lf of their bounds; depth %.1Lf of the guard's 32768 units",
         worst_gradient, worst_depth, worst_units);
}

/* ---- steep planes ---------------------------------------------------------------------------------------------- */

/* Of little extent and much depth: from 1/256 pixel up, and slivers of any length. */
static triangle steep_triangle(void)
{
    const int64_t low = GN_DEPTH_GUARD, high = 0x80000000 - GN_DEPTH_GUARD, centre = 128 * 4096;
    triangle t;
    do {
        int64_t reach = (int64_t)1 << between(0, 12), x = centre + between(-(1 << 19), 1 << 19),
                y = centre + between(-(1 << 19), 1 << 19), k = between(0, 1000);
        for (int i = 0; i < 3; i++) {
            t.v[i].x = (int32_t)(x + between(-reach, reach));
            t.v[i].y = (int32_t)(y + between(-reach, reach));
            t.v[i].depth = (uint32_t)(between(0, 3) ? between(low, high) : between(0, 1) ? low : high);
        }
        if (between(0, 1)) { /* almost seen edge-on */
            t.v[2].x = (int32_t)(t.v[0].x + (t.v[1].x - t.v[0].x) * k / 1000 + between(-1, 1));
            t.v[2].y = (int32_t)(t.v[0].y + (t.v[1].y - t.v[0].y) * k / 1000 + between(-1, 1));
        }
        find_gradients(&t);
        if (t.area < 0) {
            gn_vertex v = t.v[1];
            t.v[1] = t.v[2];
            t.v[2] = v;
            find_gradients(&t);
        }
    } while (t.area == 0);
    return t;
}

/* The definition: q 2^(exponent + 9), rounded half up where that is a fraction. *sheer: 2^40 may be reached. */
static exact defined_steep_gradient(exact n, exact area, int *sheer)
{
    int exponent;
    if (n == 0)
        return 0;
    exact g = (exact)quotient(n, area, &exponent);
    exponent += 9;
    if (exponent > 8) /* q < 2^32 */
        *sheer = 1;
    else if (exponent >= 0)
        g <<= exponent;
    else
        g = exponent < -40 ? 0 : (g + ((exact)1 << (-exponent - 1))) >> -exponent;
    return n < 0 ? -g : g;
}

typedef struct steep_count {
    unsigned failures;
    uint64_t steep, sheer, centres, beyond;
    real worst_gradient, worst_depth;
} steep_count;

/* Depths at covered centres are within the corners' range, give or take the gradients' error; beside the triangle they
 * go on without wrapping, up to the most that a map's other end can ask for. */
static void check_steep_depths(const triangle *t, const gn_wide_plane *plane, const real bound[2], uint64_t n,
                               steep_count *count)
{
    samples s;
    find_samples(&s, t);
    for (int i = 0; i < s.count + 4; i++) {
        int32_t corner = 4095 * (i & 1), other = 4095 * (i >> 1 & 1);
        int32_t column = i < s.count ? s.column[i] : corner, row = i < s.count ? s.row[i] : other;
        exact px = 256 * (exact)column + 128 - t->v[0].x, py = 256 * (exact)row + 128 - t->v[0].y;
        exact value = plane->base + (exact)column * plane->dx + (exact)row * plane->dy;
        exact held = value < 0 ? 0 : value > 0xffffffff ? 0xffffffff : value;
        exact off = (value - 2 * (exact)t->v[0].depth) * t->area - 2 * (t->nx * px + t->ny * py);
        real error = (real)magnitude(off) / (real)t->area;
        real allowed = (real)magnitude(px) / 256 * bound[0] + (real)magnitude(py) / 256 * bound[1] + 1;
        count->centres += i < s.count;
        count->beyond += held != value;
        if (error / allowed > count->worst_depth)
            count->worst_depth = error / allowed;
        if ((!(error <= allowed) || gn_wide_depth(plane, column, row) != (int64_t)value ||
             gn_saturate(gn_wide_depth(plane, column, row)) != (uint32_t)held) &&
            count->failures++ < 5) {
            note("case %llu, %s (%d, %d): depth %lld, held %lu, is %.2Lf units off, at most %.2Lf allowed",
                 (unsigned long long)n, i < s.count ? "covered centre" : "the map's corner", (int)column, (int)row,
                 (long long)gn_wide_depth(plane, column, row),
                 (unsigned long)gn_saturate(gn_wide_depth(plane, column, row)), error, allowed);
            show(t);
        }
    }
}

static void steep_planes_keep_their_bounds(uint64_t cases)
{
    steep_count count;
    memset(&count, 0, sizeof count);
    for (uint64_t n = 0; n < cases && count.failures < 5; n++) {
        triangle t = steep_triangle();
        gn_depth_plane narrow;
        gn_wide_plane plane, same;
        if (!gn_make_depth_plane(&narrow, &t.v[0], &t.v[1], &t.v[2], (int64_t)t.area))
            continue;
        gn_make_steep_plane(&plane, &t.v[0], &t.v[1], &t.v[2], (int64_t)t.area);
        gn_make_steep_plane(&same, &t.v[0], &t.v[1], &t.v[2], -(int64_t)t.area);
        int sheer = 0;
        exact d[2] = {defined_steep_gradient(t.nx, t.area, &sheer), defined_steep_gradient(t.ny, t.area, &sheer)};
        exact numerator[2] = {512 * t.nx, 512 * t.ny};
        exact base =
            2 * (exact)t.v[0].depth + floor_shift((128 - (exact)t.v[0].x) * d[0] + (128 - (exact)t.v[0].y) * d[1], 8);
        count.steep++;
        count.sheer += sheer != 0;
        if (sheer) {
            d[0] = d[1] = 0;
            base = 0;
            for (int i = 0; i < 3; i++)
                base = 2 * (exact)t.v[i].depth > base ? 2 * (exact)t.v[i].depth : base;
        }
        if ((plane.dx != d[0] || plane.dy != d[1] || plane.base != base || same.dx != plane.dx || same.dy != plane.dy ||
             same.base != plane.base) &&
            count.failures++ < 5) {
            note("case %llu: got base %lld, gradient %lld %lld; by definition %lld, %lld %lld", (unsigned long long)n,
                 (long long)plane.base, (long long)plane.dx, (long long)plane.dy, (long long)base, (long long)d[0],
                 (long long)d[1]);
            show(&t);
        }
        real bound[2], steepest = 0;
        for (int i = 0; i < 2; i++) {
            exact g = i ? plane.dy : plane.dx;
            real slope = (real)magnitude(numerator[i]) / (real)t.area;
            real error = (real)magnitude(g * t.area - numerator[i]) / (real)t.area;
            steepest = slope > steepest ? slope : steepest;
            bound[i] = 0.5L + slope / (1 << 29);
            if (sheer)
                continue;
            if (error / bound[i] > count.worst_gradient)
                count.worst_gradient = error / bound[i];
            if (!(error <= bound[i]) && count.failures++ < 5) {
                note("case %llu: gradient %d is %lld, %.3Lf off, at most %.3Lf allowed", (unsigned long long)n, i,
                     (long long)g, error, bound[i]);
                show(&t);
            }
        }
        /* flat only beyond the whole range in 1/256 pixel, or within a factor of 2 of it */
        if (sheer && steepest < 549755813888.0L * (1 - 1e-8L) && count.failures++ < 5) {
            note("case %llu: flat, but the gradient is %.1Lf", (unsigned long long)n, steepest);
            show(&t);
        }
        if (!sheer)
            check_steep_depths(&t, &plane, bound, n, &count);
    }
    ok(!count.failures, "steep planes: gradients, depths, saturation and the definition, in %llu triangles",
       (unsigned long long)count.steep);
    ok(count.steep > cases / 8 && count.sheer > cases / 500 && count.centres > cases / 8 && count.beyond > cases / 8,
       "%llu were flat, %llu centres were met, %llu depths lay beyond the range", (unsigned long long)count.sheer,
       (unsigned long long)count.centres, (unsigned long long)count.beyond);
    note("largest errors: gradient %.4Lf, depth %.4Lf of their bounds", count.worst_gradient, count.worst_depth);
}

static void q_planes_keep_their_bounds(uint64_t cases)
{
    uint64_t flat = 0, centres = 0, below = 0;
    unsigned failures = 0;
    real worst_gradient = 0, worst_q = 0, worst_units = 0;
    for (uint64_t n = 0; n < cases && failures < 5; n++) {
        triangle t = random_triangle(1 << 10, 1 << 30);
        gn_q_plane plane;
        samples s;
        gn_make_q_plane(&plane, &t.v[0], &t.v[1], &t.v[2], (int64_t)t.area);
        exact d[2] = {defined_q_gradient(t.nx, t.area), defined_q_gradient(t.ny, t.area)};
        exact numerator[2] = {t.nx, t.ny};
        if (magnitude(d[0]) >> 54 || magnitude(d[1]) >> 54) {
            uint32_t farthest = UINT32_MAX;
            for (int i = 0; i < 3; i++)
                farthest = t.v[i].depth < farthest ? t.v[i].depth : farthest;
            flat++;
            if ((plane.dx || plane.dy || plane.base != (uint64_t)farthest << 32) && failures++ < 5) {
                note("case %llu, steep: got base 0x%llx; expected 0x%lx00000000 and no gradient", (unsigned long long)n,
                     (unsigned long long)plane.base, (unsigned long)farthest);
                show(&t);
            }
            continue;
        }
        uint64_t base =
            (uint64_t)(((exact)t.v[0].depth << 32) + (128 - (exact)t.v[0].x) * d[0] + (128 - (exact)t.v[0].y) * d[1]);
        if ((plane.dx != (uint64_t)(256 * d[0]) || plane.dy != (uint64_t)(256 * d[1]) || plane.base != base) &&
            failures++ < 5) {
            note("case %llu: got 0x%llx 0x%llx 0x%llx; by definition 0x%llx 0x%llx 0x%llx", (unsigned long long)n,
                 (unsigned long long)plane.base, (unsigned long long)plane.dx, (unsigned long long)plane.dy,
                 (unsigned long long)base, (unsigned long long)(256 * d[0]), (unsigned long long)(256 * d[1]));
            show(&t);
        }
        real bound[2]; /* Q a 1/256 pixel */
        for (int i = 0; i < 2; i++) {
            real slope = (real)magnitude(numerator[i]) / (real)t.area;
            real error = (real)d[i] / 4294967296.0L - (real)numerator[i] / (real)t.area;
            error = error < 0 ? -error : error;
            bound[i] = slope / (1 << 29) + 1 / 4294967296.0L;
            worst_gradient = error / bound[i] > worst_gradient ? error / bound[i] : worst_gradient;
            if (!(error <= bound[i]) && failures++ < 5) {
                note("case %llu: gradient %d is off by %.3Lg, at most %.3Lg allowed", (unsigned long long)n, i, error,
                     bound[i]);
                show(&t);
            }
        }
        find_samples(&s, &t);
        for (int i = 0; i < s.count; i++) {
            uint64_t value = plane.base + (uint64_t)s.column[i] * plane.dx + (uint64_t)s.row[i] * plane.dy;
            uint32_t q = (uint32_t)(value >> 32);
            exact px = 256 * (exact)s.column[i] + 128 - t.v[0].x, py = 256 * (exact)s.row[i] + 128 - t.v[0].y;
            real expected = t.v[0].depth + ((real)(t.nx * px + t.ny * py)) / (real)t.area;
            real error = q - expected;
            error = error < 0 ? -error : error;
            real allowed = (real)magnitude(px) * bound[0] + (real)magnitude(py) * bound[1] + 1.01L;
            centres++;
            if (expected < allowed) { /* the stated bound does not keep it from wrapping */
                below++;
                continue;
            }
            worst_q = error / allowed > worst_q ? error / allowed : worst_q;
            worst_units = error > worst_units ? error : worst_units;
            if (!(error <= allowed) && failures++ < 5) {
                note("case %llu, centre (%d, %d): Q %lu, expected %.2Lf, at most %.2Lf off", (unsigned long long)n,
                     (int)s.column[i], (int)s.row[i], (unsigned long)q, expected, allowed);
                show(&t);
            }
        }
    }
    ok(!failures, "Q planes: gradients, values and the definition, in %llu triangles", (unsigned long long)cases);
    ok(flat > cases / 2000 && centres > cases, "%llu were too steep, %llu centres were met", (unsigned long long)flat,
       (unsigned long long)centres);
    note("largest errors: gradient %.4Lf, Q %.4Lf of their bounds; Q %.1Lf units of 2^30; %llu centres of long slivers "
         "may wrap below 0",
         worst_gradient, worst_q, worst_units, (unsigned long long)below);
}

/* ---- clipped triangles ----------------------------------------------------------------------------------------- */

typedef struct range {
    gn_depth_plane plane;
    uint64_t fragments, wrapped;
} range;

GN_INLINE void check_range(const void *state, int32_t row, int32_t left, int32_t right)
{
    range *r = *(range *const *)state;
    int32_t ends[2] = {left, right - 1};
    for (int i = 0; i < 2; i++) {
        uint32_t z = r->plane.base + (uint32_t)ends[i] * r->plane.dx + (uint32_t)row * r->plane.dy;
        r->fragments++;
        r->wrapped += z < GN_DEPTH_GUARD / 2 || z > 0xffffffffu - GN_DEPTH_GUARD / 2;
    }
}

/* A clipped triangle keeps one plane, and its new corners, snapped to 1/256 pixel, do not lie on it: where it is steep
 * they are off by more than the guard. All of it must stay within the range. */
static void planes_of_clipped_triangles_do_not_wrap(uint64_t cases)
{
    range r, *state = &r;
    uint64_t polygons = 0, moved = 0;
    unsigned failures = 0;
    memset(&r, 0, sizeof r);
    for (uint64_t n = 0; n < cases && failures < 5; n++) {
        gn_light light;
        gn_view view;
        gn_place corner[3];
        gn_polygon polygon;
        int32_t eye[3] = {0, 1 << 16, 0}, target[3] = {0, 0, -1000000};
        target[0] = (int32_t)between(-1000000, 1000000);
        target[1] = (int32_t)between(-20000, 70000);
        int32_t near_depth = (1 << 22) >> between(1, 18), far_depth = (int32_t)between(1 << 21, 1 << 22);
        near_depth = near_depth < 64 ? 64 : near_depth;
        memset(&light, 0, sizeof light);
        gn_status status = gn_spot_light(&light, eye, target, 0, GN_DEGREES(60), near_depth, far_depth + near_depth);
        if (status == GN_OK)
            status = gn_make_light_view(&view, &light, 512, 512);
        for (int i = 0; i < 3 && status == GN_OK; i++) {
            int32_t p[3] = {(int32_t)between(-8000000, 8000000), (int32_t)between(-4000000, 4000000),
                            (int32_t)between(-8000000, 2000000)};
            status = gn_view_place(&view, p, &corner[i]);
        }
        if (status != GN_OK) {
            failures++;
            note("case %llu: status %d", (unsigned long long)n, (int)status);
            continue;
        }
        gn_clip_triangle(&polygon, &view, corner);
        if (!polygon.area)
            continue;
        const gn_vertex *v = polygon.v, *r1 = &v[polygon.reference], *r2 = r1 + 1;
        gn_window map = {0, 0, 512, 512};
        uint64_t wrapped = r.wrapped;
        polygons++;
        gn_depth_plane unmoved;
        gn_make_depth_plane(&unmoved, &v[0], polygon.area > 0 ? r1 : r2, polygon.area > 0 ? r2 : r1, polygon.area);
        gn_make_clipped_plane(&r.plane, &polygon);
        moved += r.plane.base != unmoved.base;
        for (int i = 1; i + 1 < polygon.count; i++) {
            int64_t area = gn_area(&v[0], &v[i], &v[i + 1]);
            gn_rows rows;
            if (area && (area > 0) == (polygon.area > 0) &&
                gn_find_rows(&rows, &v[0], area > 0 ? &v[i] : &v[i + 1], area > 0 ? &v[i + 1] : &v[i], &map))
                gn_walk(&rows, &map, rows.cut, check_range, &state);
        }
        if (r.wrapped != wrapped && failures++ < 5)
            note("case %llu: a triangle clipped to %d corners, gradients %ld, %ld, leaves the range at %llu ends of "
                 "rows",
                 (unsigned long long)n, (int)polygon.count, (long)as_signed(r.plane.dx), (long)as_signed(r.plane.dy),
                 (unsigned long long)(r.wrapped - wrapped));
    }
    ok(!failures, "planes of clipped triangles do not wrap, in %llu triangles", (unsigned long long)polygons);
    ok(polygons > cases / 10 && r.fragments > cases && moved > 0, "%llu of them were moved into the range",
       (unsigned long long)moved);
}

/* By hand: a right triangle of 16 pixels, rising by 2^20 of Z a pixel in x, 2^18 in y. */
static void planes_done_by_hand(void)
{
    uint32_t z = 1u << 29, dx = 1u << 20, dy = 1u << 18;
    gn_vertex a = {0, 0, z}, b = {4096, 0, z + 16 * dx}, c = {0, 4096, z + 16 * dy};
    gn_depth_plane plane;
    gn_q_plane q;
    gn_make_depth_plane(&plane, &a, &b, &c, 4096 * 4096);
    ok(plane.dx == 2 * dx && plane.dy == 2 * dy && plane.base == 2 * z + dx + dy,
       "a depth plane by hand: gradients are twice Z's, the base is half a pixel in");
    gn_make_q_plane(&q, &a, &b, &c, 4096 * 4096);
    /* the reciprocal of a power of two is one unit short, which leaves relative 2^-31 */
    uint64_t short_x = ((uint64_t)dx << 32) - q.dx, short_y = ((uint64_t)dy << 32) - q.dy;
    uint64_t short_base = ((uint64_t)(2 * z + dx + dy) << 31) - q.base;
    ok(short_x <= (uint64_t)dx << 3 && short_y <= (uint64_t)dy << 3 && short_base <= (uint64_t)(dx + dy) << 2,
       "a Q plane by hand, within 2^-29");
    c.depth = a.depth = b.depth = z;
    gn_make_depth_plane(&plane, &a, &b, &c, 4096 * 4096);
    ok(plane.dx == 0 && plane.dy == 0 && plane.base == 2 * z, "a level plane is exact");
    /* a quarter of the depth range in one texel: 2^30 in units of z, 2^29 of Z */
    gn_vertex e = {0, 0, 1u << 29}, f = {256, 0, 1u << 30}, g = {0, 256, 1u << 29};
    gn_make_depth_plane(&plane, &e, &f, &g, 65536);
    ok(plane.dx == 0 && plane.dy == 0 && plane.base == 1u << 31,
       "a gradient of 2^30 is too steep: the farthest vertex");
    f.depth -= 2;
    gn_make_depth_plane(&plane, &e, &f, &g, 65536);
    ok(plane.dx == (1u << 30) - 4 && plane.dy == 0, "a gradient of 2^30 - 4 is not");
    /* the same two as steep planes, half a pixel in from 2^30 */
    gn_wide_plane wide;
    gn_make_steep_plane(&wide, &e, &f, &g, 65536);
    ok(wide.dx == (1 << 30) - 4 && wide.dy == 0 && wide.base == (1 << 30) + (1 << 29) - 2,
       "a plane that is not steep is the same in 64 bits");
    f.depth += 2;
    gn_make_steep_plane(&wide, &e, &f, &g, 65536);
    ok(wide.dx == 1 << 30 && wide.dy == 0 && wide.base == (1 << 30) + (1 << 29), "a gradient of 2^30, in 64 bits");
    ok(gn_wide_depth(&wide, 2, 7) == INT64_C(7) << 29 && gn_saturate(gn_wide_depth(&wide, 2, 7)) == 7u << 29 &&
           gn_saturate(gn_wide_depth(&wide, 3, 7)) == 0xffffffffu && gn_saturate(gn_wide_depth(&wide, -2, 7)) == 0,
       "it is held at both ends of the range");
    /* 2^29 of Z in 1/256 pixel: 2^38 a pixel, short by what the reciprocal of a power of two is, 2^-31 */
    f.x = 1;
    gn_make_steep_plane(&wide, &e, &f, &g, 256);
    ok(wide.dx == (INT64_C(1) << 38) - 128 && wide.dy == 0, "a gradient of 2^38");
    /* the whole range across half of 1/256 pixel */
    gn_vertex low = {0, 0, GN_DEPTH_GUARD}, high = {1, 1, 0x80000000u - GN_DEPTH_GUARD},
              also_low = {1, 2, GN_DEPTH_GUARD};
    gn_make_steep_plane(&wide, &low, &high, &also_low, 1);
    ok(wide.dx == 0 && wide.dy == 0 && wide.base == (INT64_C(1) << 32) - 2 * GN_DEPTH_GUARD,
       "a gradient of almost 2^41 is flat: the farthest vertex");
    ok(gn_saturate(-1) == 0 && gn_saturate(0) == 0 && gn_saturate(0xffffffff) == 0xffffffffu &&
           gn_saturate(INT64_C(1) << 32) == 0xffffffffu && gn_saturate(INT64_MAX) == 0xffffffffu &&
           gn_saturate(INT64_MIN) == 0,
       "saturation, by hand");
    const int64_t whole = INT64_C(1) << 32;
    ok(gn_saturate(gn_rise(3, -4)) == 3 && gn_saturate(gn_rise(-1, 0)) == 0 &&
           gn_saturate(gn_rise(whole, -whole)) == 0xffffffffu && gn_saturate(gn_rise(-whole, whole - 1)) == 0xffffffffu,
       "half a pixel's rise is cut, and held, by hand");
}

int main(int argc, char **argv)
{
    uint64_t cases = tap_cases(argc, argv, 300000);
    planes_done_by_hand();
    depth_planes_keep_their_bounds(cases);
    steep_planes_keep_their_bounds(cases);
    q_planes_keep_their_bounds(cases);
    planes_of_clipped_triangles_do_not_wrap(cases / 3);
    return tap_done();
}
