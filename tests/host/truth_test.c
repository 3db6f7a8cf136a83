/* The exact truth: wide integers, signs in double precision against exact ones, images against brute force in other
 * formulas, shadows worked out by hand, ties made on purpose. */
#include "core/tap.h"
#include "packed.h"
#include "truth.h"
#include "truth_trace.h"
#include "truth_wide.h"

#include <math.h>
#include <string.h>

static uint64_t state = 1;

/* least to most, both included. */
static int32_t between(int32_t least, int32_t most)
{
    return least + (int32_t)(tap_random(&state) % ((uint64_t)((int64_t)most - least) + 1));
}

/* ---- wide integers against arithmetic modulo primes ------------------------------------------------------------ */

static uint64_t residue(wide a, uint64_t prime)
{
    uint64_t r = 0;
    for (int i = a.length - 1; i >= 0; i--)
        r = ((r << 32) + a.limb[i]) % prime; /* r < 2^31 */
    return a.sign < 0 && r ? prime - r : r;
}

/* Of any length up to `limbs`, often with limbs of all zeros or ones, where carries run far. */
static wide random_wide(int limbs)
{
    wide a = {.sign = tap_random(&state) & 1 ? 1 : -1, .length = between(0, limbs)};
    for (int i = 0; i < a.length; i++) {
        uint64_t r = tap_random(&state);
        a.limb[i] = r % 3 == 0 ? 0 : r % 3 == 1 ? UINT32_MAX : (uint32_t)(r >> 32);
    }
    while (a.length && !a.limb[a.length - 1])
        a.length--;
    if (!a.length)
        a.sign = 0;
    return a;
}

/* Bits of the magnitude; 0 for zero. */
static int wide_bits(wide a)
{
    int bits = 32 * a.length;
    if (!bits)
        return 0;
    for (uint32_t top = a.limb[a.length - 1]; !(top >> 31); top <<= 1)
        bits--;
    return bits;
}

static int is_normal(wide a)
{
    return a.length ? a.sign * a.sign == 1 && a.limb[a.length - 1] : a.sign == 0;
}

static int wide_case_holds(wide a, wide b)
{
    static const uint64_t primes[] = {2147483647, 2147483629, 2147483587};
    wide sum = wide_add(a, b), difference = wide_subtract(a, b), product = wide_multiply(a, b);
    int good = is_normal(sum) && is_normal(difference) && is_normal(product);
    for (int i = 0; i < 3; i++) {
        uint64_t p = primes[i], x = residue(a, p), y = residue(b, p);
        good = good && residue(sum, p) == (x + y) % p && residue(difference, p) == (x + p - y) % p &&
               residue(product, p) == x * y % p;
    }
    int bits = wide_bits(a) + wide_bits(b), got = wide_bits(product);
    good = good && (a.sign && b.sign ? got == bits || got == bits - 1 : got == 0) && product.sign == a.sign * b.sign;
    return good && wide_compare(a, b) == difference.sign && wide_compare(b, a) == -difference.sign &&
           wide_compare(a, a) == 0 && wide_compare(wide_negate(wide_negate(a)), a) == 0;
}

static void wide_integers(uint64_t cases)
{
    uint64_t bad = 0, bad_doubles = 0;
    for (uint64_t i = 0; i < cases; i++) {
        wide a = random_wide(5), b = i % 16 ? random_wide(5) : a;
        if (!wide_case_holds(a, b) && bad++ < 5)
            note("case %llu: lengths %d and %d", (unsigned long long)i, a.length, b.length);
        double expected = 0;
        for (int k = 0; k < a.length; k++) /* from the lowest limb: another order than wide_to_double's */
            expected += ldexp(a.limb[k], 32 * k);
        bad_doubles += !(fabs(wide_to_double(a) - a.sign * expected) <= ldexp(expected, -50));
    }
    ok(bad == 0, "wide_sums_products_and_orders_are_right_modulo_three_primes");
    ok(bad_doubles == 0, "wide_integers_become_doubles_with_an_error_below_2_to_minus_50");
    int64_t numbers[] = {0, 1, -1, INT32_MAX, INT32_MIN, (int64_t)1 << 32, INT64_MAX, INT64_MIN};
    int good = 1;
    for (int i = 0; i < 8; i++)
        for (int k = 0; k < 8; k++)
            good = good && wide_compare(wide_of(numbers[i]), wide_of(numbers[k])) ==
                               (numbers[i] > numbers[k]) - (numbers[i] < numbers[k]);
    ok(good, "wide_integers_are_ordered_like_those_of_64_bits");
    ok(wide_bits(wide_of(0)) == 0 && wide_bits(wide_of(1)) == 1 && wide_bits(wide_of(INT64_MIN)) == 64 &&
           wide_bits(wide_multiply(wide_of(INT64_MIN), wide_of(-2))) == 65,
       "bits_are_counted");
}

/* ---- scenes ---------------------------------------------------------------------------------------------------- */

enum { MOST_VERTICES = 4000, MOST_TRIANGLES = 4000 };

typedef struct scene {
    int32_t vertices[MOST_VERTICES][3];
    uint16_t indices[MOST_TRIANGLES][3];
    gn_mesh mesh;
    gn_object object;
    packed_scene packed;
} scene;

static scene world; /* most tests need one at a time */

static void scene_start(scene *s)
{
    memset(s, 0, sizeof *s);
    s->mesh = (gn_mesh){.vertices = (const int32_t(*)[3])s->vertices, .indices = s->indices, .index_size = 2};
    s->object.mesh = &s->mesh;
    s->packed.objects = &s->object;
    s->packed.scene = (gn_scene){.objects = &s->object, .object_count = 1};
}

static uint16_t add_vertex(scene *s, int32_t x, int32_t y, int32_t z)
{
    int32_t v[3] = {x, y, z};
    memcpy(s->vertices[s->mesh.vertex_count], v, sizeof v);
    return (uint16_t)s->mesh.vertex_count++;
}

static void add_triangle(scene *s, uint16_t a, uint16_t b, uint16_t c)
{
    uint16_t i[3] = {a, b, c};
    memcpy(s->indices[s->mesh.triangle_count++], i, sizeof i);
}

/* Corners in turn. */
static void add_quad(scene *s, const int32_t a[3], const int32_t b[3], const int32_t c[3], const int32_t d[3])
{
    uint16_t v0 = add_vertex(s, a[0], a[1], a[2]), v1 = add_vertex(s, b[0], b[1], b[2]);
    uint16_t v2 = add_vertex(s, c[0], c[1], c[2]), v3 = add_vertex(s, d[0], d[1], d[2]);
    add_triangle(s, v0, v1, v2);
    add_triangle(s, v0, v2, v3);
}

/* A level rectangle: x0 to x1, z0 to z1 at y. */
static void add_level(scene *s, int32_t y, int32_t x0, int32_t x1, int32_t z0, int32_t z1)
{
    add_quad(s, (int32_t[]){x0, y, z0}, (int32_t[]){x0, y, z1}, (int32_t[]){x1, y, z1}, (int32_t[]){x1, y, z0});
}

/* An upright rectangle at x. */
static void add_wall(scene *s, int32_t x, int32_t y0, int32_t y1, int32_t z0, int32_t z1)
{
    add_quad(s, (int32_t[]){x, y0, z0}, (int32_t[]){x, y1, z0}, (int32_t[]){x, y1, z1}, (int32_t[]){x, y0, z1});
}

enum { ONE = 1 << 30 };

static void set_axes(gn_q2_30 to[3], int32_t x, int32_t y, int32_t z)
{
    to[0] = x;
    to[1] = y;
    to[2] = z;
}

/* Orthographic from above: right is +x, up is -z; the image is 2 half_height high. */
static void look_down(scene *s, int32_t x, int32_t y, int32_t z, int32_t half_height)
{
    gn_camera *c = &s->packed.camera;
    *c = (gn_camera){.projection = GN_ORTHOGRAPHIC, .half_height = half_height, .near_depth = 1, .far_depth = 1 << 28};
    set_axes(c->eye, x, y, z);
    set_axes(c->right, ONE, 0, 0);
    set_axes(c->up, 0, 0, -ONE);
    set_axes(c->forward, 0, -ONE, 0);
}

/* Directions need no length of 1: only their proportions count for a directional light. */
static void shine(scene *s, int32_t x, int32_t y, int32_t z)
{
    s->packed.light.kind = GN_DIRECTIONAL;
    set_axes(s->packed.light.forward, x, y, z);
}

/* A spot light that looks down, with a tangent of 1. */
static void shine_down_from(scene *s, int32_t x, int32_t y, int32_t z, int32_t near_depth, int32_t far_depth)
{
    gn_light *l = &s->packed.light;
    *l = (gn_light){.kind = GN_SPOT, .tan_half = 1 << 24, .near_depth = near_depth, .far_depth = far_depth};
    set_axes(l->position, x, y, z);
    set_axes(l->right, ONE, 0, 0);
    set_axes(l->up, 0, 0, -ONE);
    set_axes(l->forward, 0, -ONE, 0);
}

static void shine_all_round(scene *s, int32_t x, int32_t y, int32_t z, int32_t near_depth, int32_t far_depth)
{
    gn_light *l = &s->packed.light;
    *l = (gn_light){.near_depth = near_depth, .far_depth = far_depth};
    set_axes(l->position, x, y, z);
    s->packed.light.kind = GN_POINT;
}

/* Cast; 0 and a note where it is refused. */
static int cast(truth *t, const scene *s, uint32_t width, uint32_t height, int workers, int with_near)
{
    problem why;
    int good = truth_make(t, &s->packed, width, height, workers, with_near, &why) == 0;
    if (!good)
        note("%s", why.text);
    return good;
}

/* ---- double precision against exact signs ---------------------------------------------------------------------- */

static void random_corners(truth_triangle *t, int32_t size, int32_t step)
{
    for (int i = 0; i < 9; i++)
        t->corner[i / 3][i % 3] = between(-size, size) * step;
    float extent = 0;
    for (int i = 0; i < 9; i++)
        extent = fmaxf(extent, (float)abs(t->corner[(i / 3 + 1) % 3][i % 3] - t->corner[i / 3][i % 3]));
    t->extent = extent * 1.000001f;
}

static int has_area(const truth_triangle *t)
{
    int64_t n[3];
    truth_normal(t, n);
    return n[0] || n[1] || n[2];
}

typedef struct filter_counts {
    uint64_t cases, zeros, exact, differ;
} filter_counts;

static void count_answer(filter_counts *c, int quick, int exact, const char *what)
{
    c->cases++;
    if (quick != exact && c->differ++ < 5)
        note("%s: %d, exactly %d", what, quick, exact);
}

/* All questions about one pixel and two triangles, with and without double precision. */
static void compare_signs(filter_counts *c, const truth_view *quick, const truth_view *exact,
                          const truth_triangle triangles[2], const truth_plane *plane, int32_t x, int32_t y)
{
    const truth_view *views[2] = {quick, exact};
    truth_line eye[2], way[2];
    truth_point point[2];
    truth_hit hit[2][2];
    truth_meeting meeting[2][2];
    int signs[2][3], seen[2] = {0, 0};
    for (int t = 0; t < 2; t++) {
        for (int k = 0; k < 2; k++) {
            if (t == 0)
                truth_eye_line(&eye[k], views[k], x, y);
            meeting[t][k] = truth_line_meets(&eye[k], &triangles[t], signs[k]);
            seen[t] = meeting[t][k] == TRUTH_MEETS || meeting[t][k] == TRUTH_TOUCHES;
            if (seen[t])
                hit[t][k] = truth_make_hit(&eye[k], &triangles[t], signs[k]);
        }
        count_answer(c, (int)meeting[t][0], (int)meeting[t][1], "meeting");
        c->zeros += meeting[t][1] == TRUTH_TOUCHES;
        if (seen[t])
            count_answer(c, hit[t][0].side, hit[t][1].side, "side of a hit");
    }
    if (seen[0] && seen[1])
        count_answer(c, truth_compare_hits(&eye[0], &hit[0][0], &hit[1][0]),
                     truth_compare_hits(&eye[1], &hit[0][1], &hit[1][1]), "order of hits");
    if (seen[0]) {
        const gn_camera *camera = &quick->camera;
        int got[2][6] = {{0}};
        for (int k = 0; k < 2; k++) {
            truth_hit_point(&point[k], &eye[k], &hit[0][k]);
            truth_light_line(&way[k], &point[k]);
            int *g = got[k];
            g[0] = truth_compare_depth(&eye[k], &hit[0][k], camera->forward, camera->eye, camera->near_depth);
            g[1] = truth_side_of_point(&point[k], &triangles[1]);
            g[2] = truth_side_of_plane(&point[k], plane, quick->light.position);
            g[3] = truth_farthest_axis(&point[k], quick->light.position, &g[4]);
            meeting[1][k] = truth_line_meets(&way[k], &triangles[1], signs[k]);
            if (meeting[1][k] == TRUTH_MEETS || meeting[1][k] == TRUTH_TOUCHES) {
                truth_hit blocker = truth_make_hit(&way[k], &triangles[1], signs[k]);
                if (quick->light_kind != TRUTH_DIRECTIONAL)
                    g[5] = truth_compare_depth(&way[k], &blocker, quick->light.forward, quick->light.position,
                                               quick->light.near_depth);
            }
        }
        static const char *const names[] = {"depth", "side of point", "side of plane",
                                            "axis",  "sign of axis",  "depth from light"};
        for (int i = 0; i < 6; i++)
            count_answer(c, got[0][i], got[1][i], names[i]);
        c->zeros += (uint64_t)(!got[1][0] + !got[1][1] + !got[1][2]);
        count_answer(c, (int)meeting[1][0], (int)meeting[1][1], "meeting of light");
        c->zeros += meeting[1][1] == TRUTH_TOUCHES;
        c->exact += way[0].exact_decisions;
    }
    c->exact += eye[0].exact_decisions;
}

static void random_axes(gn_q2_30 right[3], gn_q2_30 up[3], gn_q2_30 forward[3], int32_t eye[3], int32_t reach,
                        int plain)
{
    static const int32_t origin[3];
    gn_camera c;
    do
        for (int k = 0; k < 3; k++)
            eye[k] = plain ? (k == 1) * between(1, 8) * (reach / 8) : between(-reach, reach);
    while (gn_look_at(&c, eye, origin, (int32_t[]){plain, !plain, 0}) != GN_OK);
    memcpy(right, c.right, sizeof c.right);
    memcpy(up, c.up, sizeof c.up);
    memcpy(forward, c.forward, sizeof c.forward);
}

/* x, z: -across to across; y: least to most; times a unit. One number a statement: the order of arguments is open. */
static void random_place(int32_t out[3], int32_t across, int32_t least, int32_t most, int32_t unit)
{
    for (int k = 0; k < 3; k++)
        out[k] = unit * (k == 1 ? between(least, most) : between(-across, across));
}

/* plain: upright axes and round numbers, so that ties are common. */
static truth_view random_view(int32_t reach, int plain)
{
    truth_view v = {.width = 32, .height = 32, .reach = reach};
    gn_camera *c = &v.camera;
    if (!plain) {
        v.width = between(1, 4096);
        v.height = between(1, 4096);
    }
    random_axes(c->right, c->up, c->forward, c->eye, plain ? reach : 2 * reach, plain);
    c->projection = (uint8_t)between(0, 1);
    c->tan_half = plain ? 1 << 24 : (gn_q8_24)between(1 << 22, 1 << 25);
    c->half_height = plain ? reach : between(reach / 2 + 1, 2 * reach);
    c->near_depth = plain ? reach / 8 : between(1, reach);
    c->far_depth = 1 << 28;
    random_axes(v.light.right, v.light.up, v.light.forward, v.light.position, plain ? reach : 2 * reach, plain);
    if (plain && between(0, 1))
        random_place(v.light.forward, 2, -1, -1, 1 << 28);
    v.light.near_depth = plain ? reach / 16 + 1 : between(1, reach);
    v.light.far_depth = 1 << 28;
    v.light.tan_half = 1 << 24;
    v.light_kind = (truth_light_kind)between(0, 2);
    return v;
}

static filter_counts filter_cases(uint64_t cases, int plain)
{
    filter_counts c = {0};
    for (uint64_t i = 0; i < cases; i++) {
        static const int32_t sizes[] = {1 << 24, 1 << 20, 1 << 12, 64};
        int32_t size = plain ? 8 : sizes[i % 4], step = plain ? 1 << 4 * (i % 5) : 1;
        truth_view quick = random_view(size * step, plain), exact;
        truth_triangle triangles[2];
        truth_plane plane;
        do {
            random_corners(&triangles[0], size, step);
            random_corners(&triangles[1], size, step);
        } while (!has_area(&triangles[0]) || !has_area(&triangles[1]));
        if (i % 8 == 7) /* two that share an edge */
            memcpy(triangles[1].corner[0], triangles[0].corner[0], 2 * sizeof triangles[0].corner[0]);
        if (!has_area(&triangles[1]))
            continue;
        if (i % 8 == 7) {
            float largest = triangles[0].extent;
            triangles[1].extent = fmaxf(largest, 2.1f * (float)(size * step));
        }
        for (int k = 0; k < 3; k++)
            plane.normal[k] =
                (int64_t)quick.light.tan_half * quick.light.forward[k] + (int64_t)(1 << 24) * quick.light.right[k];
        plane.offset = 0;
        exact = quick;
        exact.exact_only = 1;
        for (int n = 0; n < 8; n++) {
            int32_t x = between(0, 256 * quick.width), y = between(0, 256 * quick.height);
            if (plain) {
                x = x / 1024 * 1024;
                y = y / 1024 * 1024;
            }
            compare_signs(&c, &quick, &exact, triangles, &plane, x, y);
        }
    }
    return c;
}

static void filters(uint64_t cases)
{
    filter_counts random = filter_cases(cases, 0), plain = filter_cases(cases, 1);
    ok(random.differ == 0 && random.cases > 10 * cases, "signs_of_random_lines_are_those_of_exact_arithmetic");
    ok(plain.differ == 0 && plain.cases > 10 * cases, "signs_of_degenerate_lines_are_those_of_exact_arithmetic");
    if (!ok(plain.zeros > cases / 4 && plain.exact > cases / 2,
            "degenerate_lines_have_zeros_that_only_exact_arithmetic_finds"))
        note("%llu zeros, %llu exact decisions", (unsigned long long)plain.zeros, (unsigned long long)plain.exact);
    if (!ok(random.exact * 100 < random.cases, "random_lines_hardly_need_exact_arithmetic"))
        note("%llu of %llu", (unsigned long long)random.exact, (unsigned long long)random.cases);
}

/* ---- the widths that truth_line.c promises --------------------------------------------------------------------- */

static int most_bits(const wide v[3])
{
    int most = 0;
    for (int k = 0; k < 3; k++)
        most = wide_bits(v[k]) > most ? wide_bits(v[k]) : most;
    return most;
}

typedef struct widths {
    int origin, divisor, direction, way, edge, numerator, denominator, light;
} widths;

static int more(int a, int b)
{
    return a > b ? a : b;
}

static void measure_widths(widths *w, int kind, int light_kind, uint64_t tries)
{
    enum { AXIS = (1 << 30) + 16, WORLD = 1 << 24, EYE = 1 << 27 };
    for (uint64_t i = 0; i < tries; i++) {
        truth_view view = {.width = 4096, .height = i & 1 ? 4096 : 1, .reach = WORLD, .exact_only = 1};
        gn_camera *c = &view.camera;
        gn_light *l = &view.light;
        truth_triangle t[2];
        truth_line eye, way;
        truth_point point;
        int signs[3] = {1, 1, 1}, ignored[3];
        c->projection = (uint8_t)kind;
        c->tan_half = 64u << 24;
        c->half_height = 1 << 26;
        view.light_kind = (truth_light_kind)light_kind;
        for (int k = 0; k < 3; k++) {
            c->eye[k] = between(0, 1) ? EYE : -EYE;
            c->right[k] = between(0, 1) ? AXIS : -AXIS;
            c->up[k] = between(0, 1) ? AXIS : -AXIS;
            c->forward[k] = between(0, 1) ? AXIS : -AXIS;
            l->forward[k] = between(0, 1) ? AXIS : -AXIS;
            l->position[k] = between(0, 1) ? EYE : -EYE;
        }
        for (int n = 0; n < 2; n++)
            do
                random_corners(&t[n], 1, WORLD);
            while (!has_area(&t[n]));
        int32_t x = between(0, 1) * 4096 * 256, y = between(0, 1) * view.height * 256;
        truth_eye_line(&eye, &view, x, y);
        truth_line_meets(&eye, &t[0], ignored);
        w->origin = more(w->origin, most_bits(eye.exact.origin));
        w->divisor = more(w->divisor, wide_bits(eye.exact.divisor));
        w->direction = more(w->direction, most_bits(eye.exact.direction));
        /* Only what is hit has a point; the rest would be far outside of its triangle. */
        if (truth_line_meets(&eye, &t[0], signs) != TRUTH_MEETS)
            continue;
        truth_hit hit = truth_make_hit(&eye, &t[0], signs);
        truth_hit_point(&point, &eye, &hit);
        truth_light_line(&way, &point);
        if (truth_line_meets(&way, &t[1], ignored) == TRUTH_MEETS) {
            truth_hit blocker = truth_make_hit(&way, &t[1], ignored);
            truth_compare_depth(&way, &blocker, l->forward, l->position, 1 << 28);
        }
        truth_passes_within(&way, &t[1]);
        w->way = more(w->way, more(most_bits(way.exact.origin), most_bits(way.exact.direction)));
        w->numerator = more(w->numerator, most_bits(point.numerator));
        w->denominator = more(w->denominator, wide_bits(point.denominator));
        w->light++;
    }
}

static void bit_widths(uint64_t cases)
{
    for (int light = TRUTH_DIRECTIONAL; light <= TRUTH_POINT; light++) {
        widths p = {0}, o = {0};
        measure_widths(&p, GN_PERSPECTIVE, light, cases);
        measure_widths(&o, GN_ORTHOGRAPHIC, light, cases);
        int good = p.origin <= 28 && p.divisor == 1 && p.direction <= 81 && o.origin <= 78 && o.divisor <= 50 &&
                   o.direction <= 31 && more(p.numerator, o.numerator) <= 158 &&
                   more(p.denominator, o.denominator) <= 134 && more(p.way, o.way) <= 162 && p.light && o.light;
        if (!ok(good, "the_largest_numbers_keep_to_the_promised_bits_with_light_of_kind_%d", light))
            note("perspective %d %d %d, point %d %d, way %d; orthographic %d %d %d, point %d %d, way %d", p.origin,
                 p.divisor, p.direction, p.numerator, p.denominator, p.way, o.origin, o.divisor, o.direction,
                 o.numerator, o.denominator, o.way);
    }
}

/* ---- brute force in other formulas ----------------------------------------------------------------------------- */

/* Moeller & Trumbore 1997 in rationals: point = (origin + s direction) / divisor = corner + (u a + v b) / (divisor
 * slope), every triangle tried. */
typedef struct meeting_point {
    wide slope, u, v, s; /* slope > 0; s over slope */
} meeting_point;

static wide product_of_three(const wide a[3], const wide b[3], const wide c[3])
{
    wide sum = wide_of(0);
    for (int k = 0; k < 3; k++) {
        wide cross =
            wide_subtract(wide_multiply(b[(k + 1) % 3], c[(k + 2) % 3]), wide_multiply(b[(k + 2) % 3], c[(k + 1) % 3]));
        sum = wide_add(sum, wide_multiply(a[k], cross));
    }
    return sum;
}

/* 1 inside, 0 on an edge, -1 outside or edge-on. */
static int solve(meeting_point *m, const int32_t corner[3][3], const exact_line *line)
{
    wide a[3], b[3], t[3];
    for (int k = 0; k < 3; k++) {
        a[k] = wide_of((int64_t)corner[1][k] - corner[0][k]);
        b[k] = wide_of((int64_t)corner[2][k] - corner[0][k]);
        t[k] = wide_subtract(line->origin[k], wide_multiply(line->divisor, wide_of(corner[0][k])));
    }
    m->slope = product_of_three(a, line->direction, b);
    m->u = product_of_three(t, line->direction, b);
    m->v = product_of_three(line->direction, t, a);
    m->s = product_of_three(b, t, a);
    if (m->slope.sign == 0)
        return -1;
    if (m->slope.sign < 0) {
        m->slope = wide_negate(m->slope);
        m->u = wide_negate(m->u);
        m->v = wide_negate(m->v);
        m->s = wide_negate(m->s);
    }
    int rest = wide_compare(wide_multiply(m->slope, line->divisor), wide_add(m->u, m->v));
    int least = m->u.sign < m->v.sign ? m->u.sign : m->v.sign;
    return rest < least ? rest : least;
}

typedef struct oracle {
    const scene *s;
    uint32_t width, height;
    int tie;
} oracle;

static void corners_of(const scene *s, uint32_t t, int32_t out[3][3])
{
    for (int c = 0; c < 3; c++)
        memcpy(out[c], s->vertices[s->indices[t][c]], sizeof out[c]);
}

static exact_line oracle_eye(const oracle *o, uint32_t i, uint32_t j)
{
    const gn_camera *c = &o->s->packed.camera;
    int64_t x = 2 * (int64_t)i + 1 - o->width, y = (int64_t)o->height - 2 * (int64_t)j - 1, h = o->height;
    exact_line line = {.divisor = wide_of(c->projection ? h << 30 : 1)};
    for (int k = 0; k < 3; k++) {
        wide across = wide_of(x * c->right[k] + y * c->up[k]);
        if (c->projection) {
            line.origin[k] = wide_add(wide_multiply(line.divisor, wide_of(c->eye[k])),
                                      wide_multiply(across, wide_of(c->half_height)));
            line.direction[k] = wide_of(c->forward[k]);
        } else {
            line.origin[k] = wide_of(c->eye[k]);
            line.direction[k] = wide_add(wide_multiply(across, wide_of(c->tan_half)),
                                         wide_multiply(wide_of(h << 24), wide_of(c->forward[k])));
        }
    }
    return line;
}

/* axis . (point - place) in 2^-30, times the point's divisor; point over divisor. */
static wide depth_of(const wide point[3], wide divisor, const int32_t axis[3], const int32_t place[3])
{
    wide sum = wide_of(0);
    for (int k = 0; k < 3; k++)
        sum = wide_add(
            sum, wide_multiply(wide_of(axis[k]), wide_subtract(point[k], wide_multiply(divisor, wide_of(place[k])))));
    return sum;
}

static int compare_scaled(wide depth, wide divisor, int64_t limit)
{
    return wide_compare(depth, wide_multiply(divisor, wide_multiply(wide_of(limit), wide_of(ONE))));
}

static wide magnitude(wide a)
{
    a.sign *= a.sign;
    return a;
}

/* Inside the light's frustum; *w: depth and its axis. */
static int oracle_frustum(oracle *o, const wide point[3], wide divisor, int32_t axis[3])
{
    const gn_light *l = &o->s->packed.light;
    int right = 1, up = 1;
    memcpy(axis, l->forward, sizeof l->forward);
    if (o->s->packed.light.kind == GN_POINT) {
        wide farthest = wide_of(0);
        for (int k = 0; k < 3; k++) {
            int32_t unit[3] = {0, 0, 0};
            unit[k] = ONE;
            wide depth = depth_of(point, divisor, unit, l->position);
            if (wide_compare(magnitude(depth), farthest) > 0) {
                farthest = magnitude(depth);
                memset(axis, 0, 3 * sizeof *axis);
                axis[k] = depth.sign * ONE;
            }
        }
    }
    wide w = depth_of(point, divisor, axis, l->position);
    if (o->s->packed.light.kind != GN_POINT) {
        wide reach = wide_multiply(w, wide_of(l->tan_half));
        right = wide_compare(
            reach, wide_multiply(magnitude(depth_of(point, divisor, l->right, l->position)), wide_of(1 << 24)));
        up = wide_compare(reach,
                          wide_multiply(magnitude(depth_of(point, divisor, l->up, l->position)), wide_of(1 << 24)));
    }
    int near_side = compare_scaled(w, divisor, l->near_depth), far_side = -compare_scaled(w, divisor, l->far_depth);
    o->tie |= !near_side || !far_side || !right || !up;
    return near_side >= 0 && far_side >= 0 && right >= 0 && up >= 0;
}

/* Does something block the way from the point? */
static int oracle_blocked(oracle *o, uint32_t own, const wide point[3], wide divisor, const int32_t axis[3])
{
    const gn_light *l = &o->s->packed.light;
    int directional = o->s->packed.light.kind != GN_POINT && l->kind == GN_DIRECTIONAL, blocked = 0;
    exact_line line = {.divisor = divisor};
    for (int k = 0; k < 3; k++) {
        line.origin[k] = point[k];
        line.direction[k] = directional ? wide_of(-(int64_t)l->forward[k])
                                        : wide_subtract(wide_multiply(divisor, wide_of(l->position[k])), point[k]);
    }
    for (uint32_t t = 0; t < o->s->mesh.triangle_count; t++) {
        meeting_point m;
        int32_t corner[3][3];
        corners_of(o->s, t, corner);
        int inside = t == own ? -1 : solve(&m, (const int32_t(*)[3])corner, &line);
        if (inside < 0)
            continue;
        int after = m.s.sign, before = 1;
        if (!directional && after > 0) {
            /* s goes from 0 to 1 at the light: w of what is met, axis . (point - light) (1 - s). */
            wide rest = wide_subtract(m.slope, m.s);
            before = rest.sign;
            wide w = wide_multiply(depth_of(point, divisor, axis, l->position), rest);
            if (before > 0)
                before = wide_compare(
                    w, wide_multiply(m.slope,
                                     wide_multiply(divisor, wide_multiply(wide_of(l->near_depth), wide_of(ONE)))));
        }
        if (after >= 0 && before >= 0 && (!inside || !after || !before))
            o->tie = 1;
        blocked |= inside > 0 && after > 0 && before > 0;
    }
    return blocked;
}

static int oracle_side(const int32_t corner[3][3], const int32_t v[3], int from_corner)
{
    wide a[3], b[3], c[3];
    for (int k = 0; k < 3; k++) {
        a[k] = wide_of((int64_t)corner[1][k] - corner[0][k]);
        b[k] = wide_of((int64_t)corner[2][k] - corner[0][k]);
        c[k] = wide_of(from_corner ? (int64_t)v[k] - corner[0][k] : -(int64_t)v[k]);
    }
    return product_of_three(c, a, b).sign;
}

/* The mask's value; o->tie: perhaps on a tie, and then perhaps another. */
static uint8_t oracle_answer(oracle *o, uint32_t i, uint32_t j)
{
    const gn_camera *camera = &o->s->packed.camera;
    const gn_light *l = &o->s->packed.light;
    exact_line eye = oracle_eye(o, i, j);
    meeting_point best = {.slope = wide_of(0)};
    wide seen[3], divisor = wide_of(1);
    uint32_t own = UINT32_MAX;
    int32_t corner[3][3], axis[3];
    o->tie = 0;
    for (uint32_t t = 0; t < o->s->mesh.triangle_count; t++) {
        meeting_point m;
        wide point[3];
        corners_of(o->s, t, corner);
        int inside = solve(&m, (const int32_t(*)[3])corner, &eye);
        if (inside < 0)
            continue;
        wide d = wide_multiply(eye.divisor, m.slope);
        for (int k = 0; k < 3; k++)
            point[k] = wide_add(wide_multiply(d, wide_of(corner[0][k])),
                                wide_add(wide_multiply(m.u, wide_of((int64_t)corner[1][k] - corner[0][k])),
                                         wide_multiply(m.v, wide_of((int64_t)corner[2][k] - corner[0][k]))));
        wide w = depth_of(point, d, camera->forward, camera->eye);
        int near_side = compare_scaled(w, d, camera->near_depth), far_side = -compare_scaled(w, d, camera->far_depth);
        if (near_side < 0 || far_side < 0)
            continue;
        int order =
            own == UINT32_MAX ? -1 : wide_compare(wide_multiply(m.s, best.slope), wide_multiply(best.s, m.slope));
        if (order > 0)
            continue;
        o->tie = order == 0 ? 1 : !inside || !near_side || !far_side;
        if (order == 0)
            continue;
        own = t;
        best = m;
        divisor = d;
        memcpy(seen, point, sizeof seen);
    }
    if (own == UINT32_MAX)
        return 255;
    corners_of(o->s, own, corner);
    const int32_t(*plane)[3] = (const int32_t(*)[3])corner;
    int directional = o->s->packed.light.kind != GN_POINT && l->kind == GN_DIRECTIONAL;
    int camera_side = camera->projection ? oracle_side(plane, camera->forward, 0) : oracle_side(plane, camera->eye, 1);
    int light_side = directional ? oracle_side(plane, l->forward, 0) : oracle_side(plane, l->position, 1);
    o->tie |= light_side == 0;
    if (camera_side * light_side < 0)
        return 0;
    memset(axis, 0, sizeof axis);
    if (!directional && !oracle_frustum(o, seen, divisor, axis))
        return 0;
    return oracle_blocked(o, own, seen, divisor, axis) || !light_side ? 0 : 254;
}

/* A floor and triangles above it. plain: corners on a coarse grid, so that ties are common. */
static void random_scene(scene *s, uint64_t number, int plain)
{
    int32_t unit = plain ? 1 << 12 : 1;
    int32_t size = (1 << 15) / unit;
    scene_start(s);
    add_level(s, -size * unit, -5 * size * unit, 5 * size * unit, -5 * size * unit, 5 * size * unit);
    for (int t = 0; t < 24; t++) {
        uint16_t v[3];
        int32_t c[3], near_by = t % 3 ? size / 2 : size;
        for (int k = 0; k < 3; k++)
            c[k] = between(-size / 2, size / 2);
        for (int i = 0; i < 3; i++) {
            int32_t at[3];
            random_place(at, near_by, -near_by, near_by, 1);
            v[i] = add_vertex(s, (c[0] + at[0]) * unit, (c[1] + at[1]) * unit, (c[2] + at[2]) * unit);
        }
        add_triangle(s, v[0], v[1], v[2]);
    }
    truth_view v = random_view(1 << 16, plain);
    s->packed.camera = v.camera;
    s->packed.camera.eye[1] = abs(v.camera.eye[1]) + 1024;
    s->packed.camera.projection = (uint8_t)(number & 1);
    s->packed.camera.near_depth = plain ? 1 << 12 : 1 << 13;
    gn_look_at(&s->packed.camera, s->packed.camera.eye, (int32_t[]){0, 0, 0}, (int32_t[]){0, 0, 1});
    s->packed.camera.half_height = 3 << 15;
    s->packed.camera.tan_half = 1 << 24;
    s->packed.light = v.light;
    int kind = (int)(number / 2 % 3);
    if (kind == 0) {
        int32_t way[3];
        random_place(way, 2, -1, -1, 1 << 28);
        shine(s, way[0], way[1], way[2]);
    } else {
        int32_t at[3];
        random_place(at, 4, 5, 12, 1 << 12);
        shine_down_from(s, at[0], at[1], at[2], 3 << 12, 1 << 17);
        s->packed.light.tan_half = 3 << 23;
        if (kind == 2)
            shine_all_round(s, at[0], at[1], at[2], 1 << 12, 3 << 15);
    }
}

typedef struct brute_counts {
    uint64_t pixels, lit, shadowed, empty, ties, oracle_ties, differ, exact_differ, missed_ties;
} brute_counts;

static void compare_with_brute_force(brute_counts *c, const scene *s, uint64_t number)
{
    enum { WIDTH = 20, HEIGHT = 16 };
    truth t;
    truth_scene exact;
    problem why;
    truth_memory memory = {0};
    oracle o = {.s = s, .width = WIDTH, .height = HEIGHT};
    if (!cast(&t, s, WIDTH, HEIGHT, 1, 0) || truth_scene_open(&exact, &s->packed, WIDTH, HEIGHT, &why)) {
        c->differ++;
        return;
    }
    exact.view.exact_only = 1;
    for (uint32_t i = 0; i < WIDTH * HEIGHT; i++) {
        uint32_t x = i % WIDTH, y = i / WIDTH;
        uint8_t expected = oracle_answer(&o, x, y);
        truth_answer exactly = truth_trace(&exact, (int32_t)x * 256 + 128, (int32_t)y * 256 + 128, &memory);
        c->pixels++;
        c->lit += expected == 254;
        c->shadowed += expected == 0;
        c->empty += expected == 255;
        c->ties += t.ties[i];
        c->oracle_ties += (uint64_t)o.tie;
        /* The oracle knows no rules for ties, and sees some that do not matter. */
        if (!t.ties[i] && t.mask[i] != expected && c->differ++ < 5)
            note("scene %llu, pixel %u %u: got %d, expected %d", (unsigned long long)number, x, y, t.mask[i], expected);
        if ((exactly.mask != t.mask[i] || (int)exactly.reason != t.reasons[i]) && c->exact_differ++ < 5)
            note("scene %llu, pixel %u %u: got %d (%s), exact arithmetic alone gives %d (%s)",
                 (unsigned long long)number, x, y, t.mask[i], truth_reason_names[t.reasons[i]], exactly.mask,
                 truth_reason_names[exactly.reason]);
        /* What is lit has met no blocker that would have made its ties idle. */
        if (o.tie && expected == 254 && !t.ties[i] && c->missed_ties++ < 5)
            note("scene %llu, pixel %u %u: a tie is not marked", (unsigned long long)number, x, y);
    }
    truth_scene_close(&exact);
    truth_free(&t);
}

static void brute_force(uint64_t scenes)
{
    for (int plain = 0; plain < 2; plain++) {
        brute_counts c = {0};
        const char *kind = plain ? "coarse" : "random";
        for (uint64_t i = 0; i < scenes; i++) {
            random_scene(&world, i, plain);
            compare_with_brute_force(&c, &world, i);
        }
        ok(c.differ == 0 && c.lit * 20 > c.pixels && c.shadowed * 20 > c.pixels && (plain || c.empty),
           "every_pixel_of_%s_scenes_is_that_of_brute_force", kind);
        ok(c.exact_differ == 0, "%s_scenes_are_the_same_without_double_precision", kind);
        ok(c.missed_ties == 0, "no_tie_of_a_lit_pixel_of_%s_scenes_goes_unmarked", kind);
        note("%llu pixels, %llu lit, %llu shadowed, %llu ties, %llu for brute force", (unsigned long long)c.pixels,
             (unsigned long long)c.lit, (unsigned long long)c.shadowed, (unsigned long long)c.ties,
             (unsigned long long)c.oracle_ties);
        if (plain)
            ok(c.ties * 50 > c.pixels, "coarse_scenes_have_many_ties");
        else
            ok(c.ties * 1000 < c.pixels, "random_scenes_have_hardly_any_ties");
    }
}

/* ---- shadows worked out by hand -------------------------------------------------------------------------------- */

/* A picture from above of 64 x 48 pixels, a pixel 1000 units, the origin between the pixels 31, 32 and 23, 24. */
enum { ACROSS = 64, DOWN = 48, UNITS = 1000 };

typedef uint8_t (*expectation)(int64_t x, int64_t z); /* of the floor at a pixel's centre */

static void check_picture(const scene *s, expectation expected, const char *name)
{
    truth t;
    uint64_t wrong = 0, lit = 0, shadowed = 0;
    if (!cast(&t, s, ACROSS, DOWN, 1, 0)) {
        ok(0, "%s", name);
        return;
    }
    for (int i = 0; i < ACROSS * DOWN; i++) {
        int64_t x = (2 * (i % ACROSS) + 1 - ACROSS) * UNITS / 2, z = (2 * (i / ACROSS) + 1 - DOWN) * UNITS / 2;
        uint8_t value = expected(x, z);
        lit += value == 254;
        shadowed += value == 0;
        if (t.mask[i] != value && wrong++ < 5)
            note("pixel %d %d: got %d, expected %d", i % ACROSS, i / ACROSS, t.mask[i], value);
    }
    ok(wrong == 0 && lit && shadowed && t.lit == lit && t.shadowed == shadowed && t.tie_count == 0, "%s", name);
    truth_free(&t);
}

static void floor_seen_from_above(scene *s)
{
    scene_start(s);
    look_down(s, 0, 1000000, 0, DOWN * UNITS / 2);
    add_level(s, 0, -29800, 29800, -21800, 21800);
}

static int is_between(int64_t number, int64_t least, int64_t most)
{
    return least <= number && number <= most;
}

static int on_floor(int64_t x, int64_t z)
{
    return is_between(x, -29800, 29800) && is_between(z, -21800, 21800);
}

/* Light falls at 45 degrees towards +x: what is 15,100 high has its shadow as far to the right. */
static uint8_t sun_expected(int64_t x, int64_t z)
{
    if (!on_floor(x, z))
        return 255;
    return is_between(x, -9800 + 15100, 2300 + 15100) && is_between(z, -5200, 7900) ? 0 : 254;
}

static void sun(void)
{
    floor_seen_from_above(&world);
    add_level(&world, 15100, -9800, 2300, -5200, 7900);
    shine(&world, 1 << 29, -(1 << 29), 0);
    check_picture(&world, sun_expected, "a_square_under_the_sun_has_the_shadow_worked_out_by_hand");
}

/* The caster at half the light's height: twice as large. The frustum, tangent 1, is |x|, |z| <= 20,300 on the floor. */
static uint8_t spot_expected(int64_t x, int64_t z)
{
    if (!on_floor(x, z))
        return 255;
    if (is_between(x, -3900, 4200) && is_between(z, -2300, 5300))
        return 254; /* the caster itself */
    if (!is_between(x, -20300, 20300) || !is_between(z, -20300, 20300))
        return 0;
    return is_between(x, -2 * 3900, 2 * 4200) && is_between(z, -2 * 2300, 2 * 5300) ? 0 : 254;
}

static void spot(void)
{
    floor_seen_from_above(&world);
    add_level(&world, 10150, -3900, 4200, -2300, 5300);
    shine_down_from(&world, 0, 20300, 0, 700, 30000);
    check_picture(&world, spot_expected, "a_square_under_a_spot_light_has_the_shadow_worked_out_by_hand");
}

/* Far is 24,300: what lies beyond it in x or z is dark. */
static uint8_t point_expected(int64_t x, int64_t z)
{
    if (!on_floor(x, z))
        return 255;
    if (is_between(x, -3900, 4200) && is_between(z, -2300, 5300))
        return 254;
    if (!is_between(x, -24300, 24300))
        return 0;
    return is_between(x, -2 * 3900, 2 * 4200) && is_between(z, -2 * 2300, 2 * 5300) ? 0 : 254;
}

static void point(void)
{
    floor_seen_from_above(&world);
    add_level(&world, 10150, -3900, 4200, -2300, 5300);
    shine_all_round(&world, 0, 20300, 0, 700, 24300);
    check_picture(&world, point_expected, "a_square_under_a_point_light_has_the_shadow_worked_out_by_hand");
}

/* A wall at x = 4,100 from y = 3,100 to 19,100 under a light at 20,300 whose near plane is at y = 12,300. The way from
 * the floor's (x, 0, z) to the light passes the wall at y = 20,300 (1 - 4,100 / x), z' = z 4,100 / x. */
static uint8_t cut_expected(int64_t x, int64_t z)
{
    int64_t y = 20300 * (x - 4100); /* times x */
    if (!on_floor(x, z))
        return 255;
    if (!is_between(x, -20300, 20300) || !is_between(z, -20300, 20300))
        return 0;
    return x > 4100 && is_between(y, 3100 * x, 12300 * x) && is_between(z * 4100, -3300 * x, 5700 * x) ? 0 : 254;
}

/* The same for a point light: it cuts at the cube |x|, |y|, |z| = 8,000. On the part of the wall between light and
 * floor the largest of the three is y, as long as |z'| < 8,000. */
static void cut_caster(void)
{
    floor_seen_from_above(&world);
    add_wall(&world, 4100, 3100, 19100, -3300, 5700);
    shine_down_from(&world, 0, 20300, 0, 8000, 30000);
    check_picture(&world, cut_expected, "a_caster_across_a_spot_lights_near_plane_casts_with_its_part_beyond");
    floor_seen_from_above(&world);
    add_level(&world, 12400, -3900, 4200, -2300, 5300);
    shine_down_from(&world, 0, 20300, 0, 8000, 30000);
    truth t;
    if (ok(cast(&t, &world, ACROSS, DOWN, 1, 0), "a_caster_before_the_near_plane_is_cast"))
        /* The floor's frustum alone; what is seen of the caster lies before near, and is dark. */
        ok(t.mask[24 * ACROSS + 32] == 0 && t.mask[24 * ACROSS + 40] == 254,
           "a_caster_before_the_near_plane_casts_nothing");
    truth_free(&t);
}

static void add_box(scene *s, int32_t half)
{
    for (int k = 0; k < 3; k++)
        for (int side = -1; side <= 1; side += 2) {
            int32_t c[4][3];
            for (int i = 0; i < 4; i++) {
                c[i][k] = side * half;
                c[i][(k + 1) % 3] = i == 1 || i == 2 ? half : -half;
                c[i][(k + 2) % 3] = i >= 2 ? half : -half;
            }
            add_quad(s, c[0], c[1], c[2], c[3]);
        }
}

static void inside_a_box(void)
{
    truth t;
    scene_start(&world);
    add_box(&world, 50000);
    int32_t eye[3] = {11003, -7001, 3007}, target[3] = {-20011, 9002, 30001};
    gn_look_at(&world.packed.camera, eye, target, (int32_t[]){0, 1, 0});
    world.packed.camera.tan_half = 2 << 24;
    world.packed.camera.near_depth = 16;
    world.packed.camera.far_depth = 1 << 24;
    shine(&world, 300000003, -700000001, 200000007);
    ok(cast(&t, &world, 64, 48, 1, 0) && t.lit == 0 && t.shadowed == 64 * 48, "no_sun_gets_into_a_closed_box");
    truth_free(&t);
    shine_all_round(&world, 1009, 2003, -3001, 16, 60000);
    ok(cast(&t, &world, 64, 48, 1, 0) && t.lit + t.tie_count >= 64 * 48 && t.tie_count < 64,
       "a_point_light_in_a_box_lights_all_of_it");
    truth_free(&t);
    shine_all_round(&world, 1009, 2003, -3001, 16, 50000);
    ok(cast(&t, &world, 64, 48, 1, 0) && t.lit > 0 && t.shadowed > 0, "but_not_beyond_its_far_distance");
    truth_free(&t);
}

/* The same meshes mirrored in x by a model, light and camera too: the picture is mirrored. A model of half the size of
 * a mesh of twice the size changes nothing, with its own rounding. */
static void models(void)
{
    static const gn_model mirror = {{{-(1 << 20), 0, 0}, {0, 1 << 20, 0}, {0, 0, 1 << 20}}, {0, 0, 0}, 20};
    static const gn_model halve = {{{1 << 20, 0, 0}, {0, 1 << 20, 0}, {0, 0, 1 << 20}}, {7, 0, -3}, 21};
    truth plain, changed;
    uint64_t differ = 0;
    random_scene(&world, 0, 0);
    look_down(&world, 0, 1 << 20, 0, 1 << 16);
    shine(&world, 301 << 18, -(702 << 18), 203 << 18);
    int good = cast(&plain, &world, 40, 30, 1, 0);
    world.object.model = &mirror;
    world.packed.light.forward[0] *= -1;
    good = good && cast(&changed, &world, 40, 30, 1, 0);
    for (int i = 0; good && i < 40 * 30; i++)
        differ += plain.mask[i] != changed.mask[i / 40 * 40 + 39 - i % 40];
    if (!ok(good && differ == 0 && plain.lit > 50 && plain.shadowed > 50, "a_mirrored_scene_has_the_mirrored_truth"))
        note("%llu pixels differ, %llu lit, %llu shadowed", (unsigned long long)differ, (unsigned long long)plain.lit,
             (unsigned long long)plain.shadowed);
    truth_free(&changed);
    world.packed.light.forward[0] *= -1;
    world.object.model = &halve;
    for (uint32_t v = 0; v < world.mesh.vertex_count; v++) {
        /* floor((2 n - 1) / 2 + 1/2) = n, and so for 2 n. */
        world.vertices[v][0] = 2 * (world.vertices[v][0] - 7) - (int32_t)(v & 1);
        world.vertices[v][1] = 2 * world.vertices[v][1] - (int32_t)(v >> 1 & 1);
        world.vertices[v][2] = 2 * (world.vertices[v][2] + 3) - (int32_t)(v >> 2 & 1);
    }
    ok(cast(&changed, &world, 40, 30, 1, 0) && memcmp(plain.mask, changed.mask, 40 * 30) == 0,
       "models_round_half_up_and_then_move");
    truth_free(&changed);
    truth_free(&plain);
}

/* ---- ties ------------------------------------------------------------------------------------------------------ */

/* One pixel that looks straight down at x, z. */
static void expect_tie(scene *s, int32_t x, int32_t z, truth_reason reason, uint8_t mask, const char *name)
{
    truth t;
    look_down(s, x, 1 << 20, z, 100);
    int good = cast(&t, s, 1, 1, 1, 1);
    int right = good && t.reasons[0] == (uint8_t)reason && t.mask[0] == mask && t.ties[0] == (reason != TRUTH_NO_TIE) &&
                t.tie_count == (reason != TRUTH_NO_TIE) && (reason == TRUTH_NO_TIE || t.near[0] == 255);
    if (!ok(right, "%s", name) && good)
        note("got %s, mask %d; expected %s, %d", truth_reason_names[t.reasons[0]], t.mask[0],
             truth_reason_names[reason], mask);
    truth_free(&t);
}

static void start_ties(scene *s)
{
    scene_start(s);
    add_level(s, 0, -1000, 1000, -1000, 1000); /* its diagonal is x = z */
    shine(s, 0, -(1 << 29), 0);
}

static void eye_ties(void)
{
    scene *s = &world;
    start_ties(s);
    expect_tie(s, 300, 300, TRUTH_EYE_EDGE, 254, "a_ray_through_a_shared_edge_is_an_eye_edge_and_seen");
    expect_tie(s, 1000, 1000, TRUTH_EYE_EDGE, 254, "a_ray_through_a_corner_is_an_eye_edge_and_seen");
    expect_tie(s, -1000, 400, TRUTH_EYE_EDGE, 254, "a_ray_through_a_border_is_an_eye_edge_and_seen");
    expect_tie(s, 1001, 400, TRUTH_NO_TIE, 255, "a_ray_beside_it_is_none");
    expect_tie(s, 300, 400, TRUTH_NO_TIE, 254, "a_ray_inside_is_none");
    add_level(s, 0, 200, 400, 300, 500);
    expect_tie(s, 310, 450, TRUTH_EYE_DEPTH, 254, "two_surfaces_in_one_place_are_an_eye_depth");
    start_ties(s);
    look_down(s, 0, 1 << 20, 0, 100);
    s->packed.camera.near_depth = 1 << 20;
    truth t;
    ok(cast(&t, s, 2, 1, 1, 0) && t.mask[0] == 254 && t.reasons[0] == TRUTH_EYE_PLANE, "a_surface_on_near_is_seen");
    truth_free(&t);
    s->packed.camera.near_depth = 1;
    s->packed.camera.far_depth = 1 << 20;
    ok(cast(&t, s, 2, 1, 1, 0) && t.mask[0] == 254 && t.reasons[0] == TRUTH_EYE_PLANE, "a_surface_on_far_is_seen");
    truth_free(&t);
    s->packed.camera.far_depth--;
    ok(cast(&t, s, 2, 1, 1, 0) && t.mask[0] == 255 && t.tie_count == 0, "a_surface_beyond_far_is_not");
    truth_free(&t);
}

/* floor(+-2001 / 2 + 1/2) = 1001, -1000, and one more from the model's move. */
static void model_rounding(void)
{
    static const gn_model halve = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {1, 0, 0}, 1};
    scene_start(&world);
    add_level(&world, 0, -2001, 2001, -2001, 2001);
    world.object.model = &halve;
    shine(&world, 0, -(1 << 29), 0);
    expect_tie(&world, 1002, 400, TRUTH_EYE_EDGE, 254, "a_models_half_units_are_rounded_up");
    expect_tie(&world, -999, 400, TRUTH_EYE_EDGE, 254, "negative_ones_too");
}

/* A slope that rises towards -x, dark under light from there, crosses the floor, which is not, at x = 400. Three pixels
 * at x = 380, 400, 420: the first one sees the slope, and what was seen last is tried first. */
static void first_in_the_scene(void)
{
    static const int32_t slope[4][3] = {{500, -100, -900}, {500, -100, 900}, {300, 100, 900}, {300, 100, -900}};
    for (int slope_first = 0; slope_first < 2; slope_first++) {
        truth t;
        scene_start(&world);
        if (slope_first)
            add_quad(&world, slope[0], slope[1], slope[2], slope[3]);
        add_level(&world, 0, -1000, 1000, -1000, 1000);
        if (!slope_first)
            add_quad(&world, slope[0], slope[1], slope[2], slope[3]);
        shine(&world, 1 << 29, -(1 << 28), 0);
        look_down(&world, 400, 1 << 20, -500, 10);
        int good = cast(&t, &world, 3, 1, 1, 0);
        ok(good && t.mask[0] == 0 && t.mask[1] == (slope_first ? 0 : 254) && t.reasons[1] == TRUTH_EYE_DEPTH,
           "where_two_surfaces_cross_the_%s_is_seen_as_it_comes_first", slope_first ? "slope" : "floor");
        truth_free(&t);
    }
}

static void light_ties(void)
{
    scene *s = &world;
    start_ties(s);
    shine(s, 1 << 29, 0, 1 << 20);
    expect_tie(s, 300, 400, TRUTH_LIGHT_SIDE, 0, "a_light_in_the_surfaces_plane_is_a_light_side_and_leaves_it_dark");
    add_wall(s, -500, -100, 100, -1000, 1000);
    expect_tie(s, 300, 400, TRUTH_NO_TIE, 0, "unless_something_is_in_its_way_anyway");
    start_ties(s);
    shine_down_from(s, 0, 700, 0, 10, 2000);
    expect_tie(s, 700, 300, TRUTH_LIGHT_FRUSTUM, 254, "the_frustums_side_is_a_light_frustum_and_lit");
    expect_tie(s, 701, 300, TRUTH_NO_TIE, 0, "beside_it_is_dark");
    shine_down_from(s, 0, 700, 0, 10, 700);
    expect_tie(s, 200, 300, TRUTH_LIGHT_FRUSTUM, 254, "the_far_plane_is_a_light_frustum_and_lit");
    shine_down_from(s, 0, 700, 0, 700, 2000);
    expect_tie(s, 200, 300, TRUTH_LIGHT_FRUSTUM, 254, "the_near_plane_is_a_light_frustum_and_lit");
    shine_down_from(s, 0, 700, 0, 701, 2000);
    expect_tie(s, 200, 300, TRUTH_NO_TIE, 0, "what_lies_before_near_is_dark");
    shine_all_round(s, 0, 700, 0, 10, 900);
    expect_tie(s, 900, 300, TRUTH_LIGHT_FRUSTUM, 254, "a_point_lights_far_cube_is_a_light_frustum_and_lit");
    expect_tie(s, 901, 300, TRUTH_NO_TIE, 0, "beyond_it_is_dark");
    expect_tie(s, 700, 300, TRUTH_NO_TIE, 254, "between_two_faces_of_a_point_light_is_no_tie");
}

static void shadow_ties(void)
{
    scene *s = &world;
    start_ties(s);
    add_quad(s, (int32_t[]){300, -100, -900}, (int32_t[]){300, -100, 900}, (int32_t[]){500, 100, 900},
             (int32_t[]){500, 100, -900}); /* slants up through the floor at x = 400 */
    shine(s, -(1 << 29), -(1 << 29), 0);   /* along it: light comes from +x */
    expect_tie(s, 399, 130, TRUTH_NO_TIE, 254, "light_that_passes_below_a_slant_is_no_tie");
    start_ties(s);
    add_quad(s, (int32_t[]){500, -100, -900}, (int32_t[]){500, -100, 900}, (int32_t[]){300, 100, 900},
             (int32_t[]){300, 100, -900});
    shine(s, -(1 << 29), -(1 << 29), 0);
    expect_tie(s, 400, 130, TRUTH_EYE_DEPTH, 254, "a_surface_through_the_point_does_not_shadow_it");
    start_ties(s);
    add_wall(s, 400, -900, 0, -900, 900); /* below the floor, up to it */
    shine(s, -(1 << 29), -(1 << 29), 0);
    expect_tie(s, 400, 130, TRUTH_SHADOW_TOUCH, 254, "a_wall_that_ends_at_the_point_does_not_shadow_it");
    start_ties(s);
    add_level(s, 500, 100, 500, 100, 700); /* its diagonal from 100, 100 to 500, 700 */
    shine(s, 1 << 29, -(1 << 29), 0);
    expect_tie(s, 800, 400, TRUTH_SHADOW_EDGE, 0, "light_through_a_shared_edge_is_blocked");
    expect_tie(s, 790, 400, TRUTH_NO_TIE, 0, "light_beside_it_is_blocked_without_a_tie");
    expect_tie(s, 1000, 410, TRUTH_EYE_EDGE, 254, "the_eyes_tie_is_named_before_the_shadows");
    expect_tie(s, 600, 410, TRUTH_SHADOW_EDGE, 0, "a_border_in_the_way_is_settled_by_the_moved_point");
    expect_tie(s, 800, 100, TRUTH_SHADOW_EDGE, 0, "a_border_along_x_too");
    expect_tie(s, 800, 700, TRUTH_SHADOW_EDGE, 254, "the_opposite_one_lets_light_pass");
    add_level(s, 400, 100, 500, 100, 700);
    expect_tie(s, 800, 400, TRUTH_NO_TIE, 0, "an_edge_in_the_way_with_something_else_behind_is_no_tie");
    start_ties(s);
    add_level(s, 300, -200, 200, -100, 300);
    shine_down_from(s, 0, 700, 0, 400, 2000);
    expect_tie(s, -300, 211, TRUTH_SHADOW_NEAR, 0, "a_caster_in_the_near_plane_casts");
    shine_down_from(s, 0, 700, 0, 401, 2000);
    expect_tie(s, -300, 211, TRUTH_NO_TIE, 254, "a_caster_just_before_it_does_not");
    start_ties(s);
    add_wall(s, 300, 100, 400, -500, 700);
    expect_tie(s, 301, 155, TRUTH_NO_TIE, 254, "light_beside_a_wall_along_it_is_no_tie");
    start_ties(s);
    add_wall(s, 300, -400, -100, -500, 700);
    expect_tie(s, 300, 155, TRUTH_NO_TIE, 254, "a_wall_along_the_light_but_beyond_the_point_is_no_tie");
    start_ties(s);
    add_quad(s, (int32_t[]){600, 1400, -500}, (int32_t[]){600, 1400, 700}, (int32_t[]){900, 1750, 700},
             (int32_t[]){900, 1750, -500});
    shine_down_from(s, 0, 700, 0, 10, 2000); /* in a plane with the way from -600, 0, but behind the light */
    expect_tie(s, -600, 155, TRUTH_NO_TIE, 254, "a_wall_behind_the_light_is_no_tie");
    start_ties(s);
    add_wall(s, 300, 100, 400, -500, 700);
    look_down(s, 300, 50, 155, 100); /* from below the wall: the eye would see its upper edge */
    s->packed.camera.near_depth = 1;
    truth t;
    ok(cast(&t, s, 1, 1, 1, 0) && t.mask[0] == 254 && t.reasons[0] == TRUTH_SHADOW_WITHIN,
       "light_within_the_plane_of_a_wall_is_a_shadow_within_and_passes");
    truth_free(&t);
}

/* A level grid of 12 x 12 cells above the floor, and light that takes every pixel's way through a corner, an edge or a
 * diagonal of it: nothing slips through. */
static void watertight(void)
{
    enum { CELLS = 12, CELL = 64 };
    static const int32_t lights[4][3] = {{0, -1, 0}, {1, -1, 0}, {1, -2, -1}, {-3, -4, 2}};
    uint64_t slipped = 0, ties = 0, pixels = 0;
    for (int l = 0; l < 8; l++) {
        truth t;
        scene_start(&world);
        add_level(&world, 0, -4000, 4000, -4000, 4000);
        for (int i = 0; i <= CELLS; i++)
            for (int k = 0; k <= CELLS; k++)
                add_vertex(&world, CELL * (i - CELLS / 2), 256, CELL * (k - CELLS / 2));
        for (int i = 0; i < CELLS; i++)
            for (int k = 0; k < CELLS; k++) {
                uint16_t a = (uint16_t)(4 + i * (CELLS + 1) + k), b = (uint16_t)(a + 1), c = (uint16_t)(a + CELLS + 1),
                         d = (uint16_t)(c + 1);
                add_triangle(&world, a, (i + k) & 1 ? d : b, c);
                add_triangle(&world, (i + k) & 1 ? a : b, (i + k) & 1 ? b : c, d);
            }
        int spot_light = l >= 4;
        const int32_t *way = lights[l % 4];
        /* Straight below the grid's inner corners, edges and diagonals: seen from between grid and floor. */
        int32_t shift_x = spot_light ? 0 : way[0] * (256 / way[1]) * -1,
                shift_z = spot_light ? 0 : way[2] * (256 / way[1]) * -1;
        look_down(&world, shift_x, 200, shift_z, spot_light ? CELL * 9 : CELL * 11 / 2);
        if (spot_light)
            shine_down_from(&world, 0, 512 + 256 * (l - 4), 0, 64, 4096);
        else
            shine(&world, way[0] * (1 << 24), way[1] * (1 << 24), way[2] * (1 << 24));
        int size = spot_light ? 36 : 22; /* steps of half a cell, or a quarter on the grid */
        if (!cast(&t, &world, (uint32_t)size, (uint32_t)size, 1, 0)) {
            slipped++;
            continue;
        }
        for (int i = 0; i < size * size; i++) {
            /* Of a spot light's picture only what is surely below the grid. */
            pixels++;
            int column = 2 * (i % size) + 1 - size, row = 2 * (i / size) + 1 - size;
            if (spot_light && (abs(column) > 22 || abs(row) > 22))
                continue;
            ties += t.ties[i];
            slipped += t.mask[i] != 0;
        }
        truth_free(&t);
    }
    if (!ok(slipped == 0 && ties * 20 > pixels, "nothing_slips_through_the_edges_of_a_grid"))
        note("%llu pixels lit, %llu ties", (unsigned long long)slipped, (unsigned long long)ties);
}

/* ---- near, workers, refusals ----------------------------------------------------------------------------------- */

/* Pixels of 65,536 units, so 1/256 is 256. Under light straight from above the caster's border is its shadow's. */
static void near_pixels(void)
{
    enum { PIXEL_UNITS = 1 << 16 };
    static const struct {
        int32_t edge;
        int near_pixel;
    } cases[] = {{200, 1}, {-200, 1}, {255, 1}, {257, 0}, {-257, 0}, {3000, 0}};
    int good = 1;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        truth t;
        scene_start(&world);
        add_level(&world, 0, -(1 << 23), 1 << 23, -(1 << 23), (1 << 23) - 3);
        /* 45 degrees towards +x, 2^20 high: what ends at x here ends at x + 2^20 on the floor. */
        add_level(&world, 1 << 20, -(1 << 22), PIXEL_UNITS / 2 + cases[i].edge, -(1 << 22), 1 << 22);
        look_down(&world, 1 << 20, 1 << 19, 0, 8 * PIXEL_UNITS); /* below the caster */
        shine(&world, 1 << 29, -(1 << 29), 0);
        if (!cast(&t, &world, 16, 16, 2, 1)) {
            good = 0;
            continue;
        }
        /* Pixel 8's centre is half a pixel right of the eye. */
        uint64_t wrong = 0;
        for (int p = 0; p < 256; p++) {
            int expected = t.ties[p] || (p % 16 == 8 && cases[i].near_pixel);
            uint8_t mask = p % 16 < 8 || (p % 16 == 8 && cases[i].edge > 0) ? 0 : 254;
            wrong += (t.near[p] == 255) != expected || t.mask[p] != mask;
        }
        if (wrong || t.tie_count > 16 || t.near_count < (cases[i].near_pixel ? 16u : 0u)) {
            note("edge %d: %llu pixels wrong, %llu near, %llu ties", cases[i].edge, (unsigned long long)wrong,
                 (unsigned long long)t.near_count, (unsigned long long)t.tie_count);
            good = 0;
        }
        truth_free(&t);
    }
    ok(good, "near_marks_what_changes_within_a_256th_of_a_pixel_and_no_more");
}

static void workers(void)
{
    truth one, three;
    uint64_t near_pixels_seen = 0;
    int good = 1;
    for (uint64_t i = 0; i < 6; i++) {
        random_scene(&world, i, (int)(i & 1));
        good = good && cast(&one, &world, 45, 31, 1, 1) && cast(&three, &world, 45, 31, 3, 1);
        good = good && memcmp(one.mask, three.mask, 45 * 31) == 0 && memcmp(one.near, three.near, 45 * 31) == 0 &&
               memcmp(one.reasons, three.reasons, 45 * 31) == 0 && memcmp(one.ties, three.ties, 45 * 31) == 0 &&
               one.lit == three.lit && one.near_count == three.near_count && one.tie_count == three.tie_count &&
               one.exact_decisions == three.exact_decisions && one.lit + one.shadowed == one.surface;
        near_pixels_seen += one.near_count;
        truth_free(&one);
        truth_free(&three);
    }
    ok(good && near_pixels_seen, "three_workers_give_what_one_gives");
}

static void refusals(void)
{
    truth t;
    problem why = {""};
    random_scene(&world, 0, 0);
    ok(truth_make(&t, &world.packed, 0, 5, 1, 0, &why) == -1 && strstr(why.text, "expected"), "no_width_is_refused");
    truth_free(&t);
    ok(truth_make(&t, &world.packed, 5, 5, 65, 0, &why) == -1 && strstr(why.text, "expected"),
       "65_workers_are_refused");
    truth_free(&t);
    world.indices[3][1] = (uint16_t)world.mesh.vertex_count;
    ok(truth_make(&t, &world.packed, 5, 5, 1, 0, &why) == -1 && strstr(why.text, "triangle 3 "),
       "an_index_beyond_the_mesh_is_refused");
    truth_free(&t);
    world.indices[3][1] = 0;
    world.vertices[5][2] = (1 << 24) + 1;
    ok(truth_make(&t, &world.packed, 5, 5, 1, 0, &why) == -1 && strstr(why.text, "object 0 "),
       "a_vertex_beyond_the_range_is_refused");
    truth_free(&t);
    world.vertices[5][2] = 1 << 24;
    ok(truth_make(&t, &world.packed, 5, 5, 1, 0, &why) == 0, "one_at_its_end_is_not");
    truth_free(&t);
    world.packed.camera.eye[0] = (1 << 27) + 1;
    ok(truth_make(&t, &world.packed, 5, 5, 1, 0, &why) == -1 && strstr(why.text, "camera"),
       "a_camera_out_of_range_is_refused");
    truth_free(&t);
    world.packed.camera.eye[0] = 0;
    shine_all_round(&world, 0, 0, 0, 0, 9);
    ok(truth_make(&t, &world.packed, 5, 5, 1, 0, &why) == -1 && strstr(why.text, "light"),
       "a_light_out_of_range_is_refused");
    truth_free(&t);
    scene_start(&world);
    look_down(&world, 0, 0, 0, 10);
    shine(&world, 0, -ONE, 0);
    ok(truth_make(&t, &world.packed, 5, 5, 1, 1, &why) == 0 && t.surface == 0 && t.near_count == 0,
       "a_scene_of_nothing_has_no_surface");
    truth_free(&t);
}

/* The sizes at which the hierarchy changes its shape, also with all triangles in one place. */
static void hierarchies(void)
{
    int good = 1;
    for (int count = 1; count < 80 && good; count += count < 12 ? 1 : 23)
        for (int stacked = 0; stacked < 2; stacked++) {
            truth t;
            scene_start(&world);
            for (int i = 0; i < count; i++)
                add_level(&world, stacked ? 0 : -i, stacked ? 0 : 1000 * i, stacked ? 1000 : 1000 * i + 700, 0, 1000);
            look_down(&world, count * 500, 1000, 501, 400);
            shine(&world, 0, -ONE, 0);
            world.packed.camera.half_height = 50;
            good = good && cast(&t, &world, (uint32_t)(10 * count), 1, 1, 0);
            for (int i = 0; good && i < 10 * count; i++) {
                int x = count * 500 + (2 * i + 1 - 10 * count) * 50;
                int inside = stacked ? x <= 1000 : x % 1000 <= 700;
                good = (t.mask[i] == 254) == inside && (t.mask[i] == 255) == !inside;
            }
            truth_free(&t);
        }
    ok(good, "hierarchies_of_any_size_find_every_triangle");
}

int main(int argc, char **argv)
{
    uint64_t cases = tap_cases(argc, argv, 2000);
    wide_integers(20 * cases);
    filters(cases);
    bit_widths(cases);
    brute_force(cases / 60 + 6);
    sun();
    spot();
    point();
    cut_caster();
    inside_a_box();
    models();
    eye_ties();
    first_in_the_scene();
    model_rounding();
    light_ties();
    shadow_ties();
    watertight();
    near_pixels();
    workers();
    refusals();
    hierarchies();
    return tap_done();
}
