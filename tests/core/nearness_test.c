/* Nearness of planes, pixel by pixel, against the plane equation evaluated anew: products of vectors in integers of 128
 * bits, the rest in long double (64 bits on the machines that run this), where it errs by less than 2^-58 of the terms.
 * Every slope, up to planes that the eye sees edge-on; perspective and orthographic; images up to 4096 x 4096. The
 * bound of each value is derived below. Cases: 300000 planes, or GNOMON_CASES. */
#include "gn_context.h"
#include "gn_nearness.h"
#include "tap.h"

#include <string.h>

__extension__ typedef __int128 exact;
typedef long double real;

static uint64_t random_state = 21;

static int64_t between(int64_t low, int64_t high)
{
    return low + (int64_t)(tap_random(&random_state) % ((uint64_t)(high - low) + 1));
}

static real magnitude(real v)
{
    return v < 0 ? -v : v;
}

/* ---- cameras --------------------------------------------------------------------------------------------------- */

typedef struct view {
    gn_camera camera;
    int32_t width, height;
    gn_eye eye;
} view;

static void random_place(int32_t place[3], int64_t reach)
{
    for (int i = 0; i < 3; i++)
        place[i] = (int32_t)between(-reach, reach);
}

/* Sizes and depths of every order, extremes among them. */
static int32_t random_size(void)
{
    static const int32_t extremes[] = {1, 2, 4095, 4096};
    return between(0, 3) ? (int32_t)between(1, (int64_t)1 << between(0, 12)) : extremes[between(0, 3)];
}

static view random_view(void)
{
    view v;
    int32_t eye[3], target[3], up[3];
    memset(&v, 0, sizeof v);
    do {
        random_place(eye, (int64_t)1 << between(1, 27));
        random_place(target, (int64_t)1 << between(1, 27));
        random_place(up, 100);
    } while (gn_look_at(&v.camera, eye, target, up) != GN_OK);
    v.camera.near_depth = (int32_t)between(16, (int64_t)1 << between(5, 28));
    v.camera.tan_half = (uint32_t)between(1 << 16, (int64_t)1 << between(17, 30));
    v.camera.half_height = (int32_t)between(1, (int64_t)1 << between(0, 26));
    v.camera.projection = between(0, 1) ? GN_PERSPECTIVE : GN_ORTHOGRAPHIC;
    v.width = random_size();
    v.height = random_size();
    gn_make_eye(&v.eye, &v.camera, v.width, v.height);
    return v;
}

static void show_view(const view *v)
{
    const gn_camera *c = &v->camera;
    note("    camera %d at (%ld %ld %ld), %ld x %ld, near %ld, tangent %.9g, half height %ld", c->projection,
         (long)c->eye[0], (long)c->eye[1], (long)c->eye[2], (long)v->width, (long)v->height, (long)c->near_depth,
         c->tan_half / 16777216.0, (long)c->half_height);
}

/* ---- planes ---------------------------------------------------------------------------------------------------- */

typedef struct plane {
    int64_t n[3];
    int32_t from[3]; /* a point on it, seen from the eye */
} plane;

static real dot(const int64_t n[3], const int32_t v[3])
{
    exact sum = 0;
    for (int i = 0; i < 3; i++)
        sum += (exact)n[i] * v[i];
    return (real)sum;
}

/* Of a triangle; of a volume's side, which runs through two ways from the light; anything within range. */
static plane random_plane(const view *v)
{
    plane p;
    int32_t a[3], b[3];
    int kind = (int)between(0, 4);
    int64_t reach = (int64_t)1 << between(2, kind == 0 ? 25 : 30);
    random_place(p.from, (int64_t)1 << between(1, 28));
    random_place(a, reach);
    random_place(b, reach);
    if (kind == 1) /* through the eye, but for what a step of a corner turns it */
        for (int i = 0; i < 3; i++)
            a[i] = p.from[i] + (int32_t)between(-1, 1);
    if (kind == 2) /* orthographic: along the view, but for as little */
        for (int i = 0; i < 3; i++) {
            a[i] = v->camera.forward[i] / (1 << between(0, 20));
            a[i] += (int32_t)between(-1, 1);
        }
    gn_cross(p.n, a, b);
    for (int i = 0; kind == 3 && i < 3; i++) {
        p.n[i] = between(-((int64_t)1 << 61), (int64_t)1 << 61);
        p.n[i] /= (int64_t)1 << between(0, 60);
    }
    return p;
}

static void show_plane(const plane *p)
{
    note("    normal (%lld %lld %lld), from the eye (%ld %ld %ld)", (long long)p->n[0], (long long)p->n[1],
         (long long)p->n[2], (long)p->from[0], (long)p->from[1], (long)p->from[2]);
}

/* What it should be: terms in the middle of the image, and a pixel to the right and below. */
typedef struct terms {
    int edge_on;
    real base, dx, dy;
} terms;

static terms find_terms(const view *v, const plane *p)
{
    const gn_camera *c = &v->camera;
    real forward = dot(p->n, c->forward), right = dot(p->n, c->right), up = dot(p->n, c->up);
    real distance = dot(p->n, p->from), two_30 = 1 << 30;
    terms t = {0, 0, 0, 0};
    if (c->projection == GN_PERSPECTIVE) {
        real one = two_30 * c->near_depth, pixel = 2 * (real)c->tan_half / (1 << 24) / v->height;
        t.edge_on = distance == 0;
        t.base = one * forward / distance;
        t.dx = one * pixel * right / distance;
        t.dy = -one * pixel * up / distance;
    } else {
        /* w of the plane's point on the ray through the middle, in 2^-32; and what a pixel aside adds to it */
        real pixel = 2 * (real)c->half_height / v->height;
        t.edge_on = forward == 0;
        t.base = -4 * two_30 * distance / forward * two_30;
        t.dx = 4 * two_30 * pixel * right / forward;
        t.dy = -4 * two_30 * pixel * up / forward;
    }
    return t;
}

/* ---- the bound ------------------------------------------------------------------------------------------------- */

/* Errors of the operations (tests/core/wide_test.c) in units of 2^-62: product 6.04, reciprocal 8, product of
 * vectors 2. base: two products, a reciprocal, two products of vectors; dx and dy: five, two, and two. And what long
 * double adds: up to ten roundings, 2^-63 or less each. */
static const real base_units = 2 * 6.04L + 8 + 2 * 2 + 5, slope_units = 5 * 6.04L + 2 * 8 + 2 * 2 + 5;

static real unit(void)
{
    return 1.0L / (real)((int64_t)1 << 62);
}

/* Of the value at (across, below) pixels from the middle. Three roundings to the last bit: base, and the halves of the
 * image that are taken from it, and of each slope half a bit a pixel. */
static real bound_of(const terms *t, real across, real below, unsigned shift)
{
    real bit = 1;
    for (unsigned i = 0; i < shift; i++)
        bit *= 2;
    across = magnitude(across);
    below = magnitude(below);
    return unit() * (base_units * magnitude(t->base) +
                     slope_units * (magnitude(t->dx) * across + magnitude(t->dy) * below)) +
           bit * (1 + (across + below) / 2);
}

typedef struct tally {
    uint64_t planes, bad, beyond, edge_on, steep, plain, of_eye[2];
    real worst; /* of the bound */
} tally;

static void check_pixel(tally *c, const view *v, const plane *p, const terms *t, const gn_nearness *got, int32_t x,
                        int32_t y)
{
    int64_t value = got->base + x * got->dx + y * got->dy, limit = (int64_t)1 << 62;
    real across = x - (v->width - 1) / 2.0L, below = y - (v->height - 1) / 2.0L, scaled = (real)value;
    for (unsigned i = 0; i < got->shift; i++)
        scaled *= 2;
    real error = magnitude(scaled - (t->base + across * t->dx + below * t->dy));
    real bound = bound_of(t, across, below, got->shift);
    c->worst = error / bound > c->worst ? error / bound : c->worst;
    c->beyond += value > limit || value < -limit;
    if (error <= bound || c->bad++ > 4)
        return;
    note("    pixel %ld %ld: %.20Lg, expected %.20Lg within %.3Lg (2^%u)", (long)x, (long)y, scaled,
         t->base + across * t->dx + below * t->dy, bound, got->shift);
    show_view(v);
    show_plane(p);
}

/* 2^125 is where the block exponent ends: it takes a corner of the volume less than 2^-60 of the world beside a plane
 * through the eye, or as little a slope; values are then held, and any order will do. */
static int is_in_range(const view *v, const terms *t)
{
    real most = magnitude(t->base), x = magnitude(t->dx) * v->width, y = magnitude(t->dy) * v->height;
    most = x > most ? x : most;
    most = y > most ? y : most;
    return most < 1e36L; /* 2^119.6 */
}

static void check_plane(tally *c, const view *v, const plane *p)
{
    gn_nearness got;
    terms t = find_terms(v, p);
    gn_make_nearness(&got, &v->eye, p->n, gn_wide_dot(p->n, p->from));
    c->planes++;
    if (t.edge_on) {
        c->edge_on++;
        c->bad += got.base != -GN_NEAREST || got.dx || got.dy || got.shift;
        return;
    }
    if (!is_in_range(v, &t))
        return;
    c->of_eye[v->camera.projection]++;
    c->steep += got.shift > 0;
    c->plain += got.shift == 0;
    int32_t right = v->width - 1, bottom = v->height - 1;
    check_pixel(c, v, p, &t, &got, 0, 0);
    check_pixel(c, v, p, &t, &got, right, 0);
    check_pixel(c, v, p, &t, &got, 0, bottom);
    check_pixel(c, v, p, &t, &got, right, bottom);
    for (int i = 0; i < 4; i++) {
        int32_t x = (int32_t)between(0, right), y = (int32_t)between(0, bottom);
        check_pixel(c, v, p, &t, &got, x, y);
    }
}

static void planes_keep_their_bounds(uint64_t cases)
{
    tally c = {0, 0, 0, 0, 0, 0, {0, 0}, 0};
    for (uint64_t i = 0; i < cases; i++) {
        view v = random_view();
        for (int k = 0; k < 4; k++) {
            plane p = random_plane(&v);
            check_plane(&c, &v, &p);
        }
    }
    note("planes: %llu perspective, %llu orthographic, %llu edge-on; %llu with a block exponent; worst error %.3Lf of "
         "its bound",
         (unsigned long long)c.of_eye[0], (unsigned long long)c.of_eye[1], (unsigned long long)c.edge_on,
         (unsigned long long)c.steep, c.worst);
    ok(c.bad == 0, "nearness_of_a_plane_keeps_its_bound_at_every_pixel");
    ok(c.beyond == 0, "values_stay_within_2_to_62_all_over_the_image");
    ok(cases < 100 || (c.of_eye[0] && c.of_eye[1] && c.edge_on && c.steep && c.plain),
       "planes_of_all_slopes_were_among_them");
}

/* A wall at w = 512 and a floor 512 below the eye, seen with a tangent of 1 by 512 x 512 pixels. */
static void planes_done_by_hand(void)
{
    view v;
    gn_nearness got;
    static const int32_t at[3] = {0, 512, -512};
    static const int64_t wall[3] = {0, 0, 1}, floor_[3] = {0, -1, 0}, across[3] = {1, 0, 0};
    memset(&v, 0, sizeof v);
    v.camera.right[0] = 1 << 30;
    v.camera.up[1] = 1 << 30;
    v.camera.forward[2] = -(1 << 30);
    v.camera.tan_half = 1 << 24;
    v.camera.near_depth = 16;
    gn_make_eye(&v.eye, &v.camera, 512, 512);
    gn_make_nearness(&got, &v.eye, wall, gn_wide_dot(wall, at));
    int64_t value = got.base + 100 * got.dx + 7 * got.dy, expected = (int64_t)1 << 55;
    ok(got.shift == 0 && value > expected - 2048 && value < expected + 2048, "a_wall_at_32_near_depths_is_at_2_to_55");
    /* 1/w of the level plane below: y of the ray over 512; 2^60 16 / 512 / 256 a row, from the middle downward */
    gn_make_nearness(&got, &v.eye, floor_, gn_wide_dot(floor_, (int32_t[3]){0, -512, 0}));
    value = got.base + 100 * got.dx + 384 * got.dy;
    expected = ((int64_t)1 << 47) / 2 * 257; /* row 384 is 128.5 rows below the middle */
    ok(got.dx == 0 && value > expected - 2048 && value < expected + 2048, "a_floor_is_nearer_row_by_row");
    gn_make_nearness(&got, &v.eye, across, gn_wide_dot(across, at));
    ok(got.base == -GN_NEAREST && got.dx == 0 && got.dy == 0, "a_plane_through_the_eye_has_the_least_nearness");
    v.camera.projection = GN_ORTHOGRAPHIC;
    v.camera.half_height = 512;
    gn_make_eye(&v.eye, &v.camera, 512, 512);
    gn_make_nearness(&got, &v.eye, wall, gn_wide_dot(wall, at));
    value = got.base + 100 * got.dx + 7 * got.dy;
    expected = -((int64_t)1 << 41);
    ok(value > expected - 2 && value < expected + 2, "without_perspective_nearness_is_minus_depth_in_2_to_minus_32");
}

/* The steepest that numbers within their ranges allow: nothing overflows (sanitized builds see it). */
static void planes_all_but_edge_on_do_not_overflow(uint64_t cases)
{
    uint64_t held = 0, wrong = 0;
    for (uint64_t i = 0; i < cases; i++) {
        view v = random_view();
        plane p = random_plane(&v);
        if (between(0, 3) == 0) { /* the most that a camera can make of it */
            v.camera.near_depth = 1 << 28;
            v.camera.tan_half = 64u << 24;
            v.camera.half_height = 1 << 26;
            v.width = 4096;
            v.height = (int32_t)between(1, 2);
            gn_make_eye(&v.eye, &v.camera, v.width, v.height);
        }
        for (int k = 0; k < 3; k++)
            p.from[k] = (int32_t)between(-1, 1);
        if (between(0, 1)) { /* 1 from the eye, along the longest of normals */
            p.n[0] = (int64_t)1 << between(20, 61);
            p.n[0] -= between(0, 1);
            p.n[1] = between(0, 1) - p.n[0];
            p.from[0] = p.from[1] = 1;
            p.from[2] = 0;
        }
        gn_nearness got;
        gn_make_nearness(&got, &v.eye, p.n, gn_wide_dot(p.n, p.from));
        int32_t right = v.width - 1, bottom = v.height - 1;
        for (int corner = 0; corner < 4; corner++) {
            int64_t value = got.base + (corner & 1 ? right : 0) * got.dx + (corner & 2 ? bottom : 0) * got.dy;
            wrong += value > GN_NEAREST || value < -GN_NEAREST;
        }
        held += got.shift > 40;
    }
    note("%llu planes with a block exponent above 40", (unsigned long long)held);
    ok(wrong == 0, "planes_all_but_edge_on_stay_within_2_to_62");
}

/* ---- reach ----------------------------------------------------------------------------------------------------- */

/* A range that has taken in this alone. */
static gn_reach reach_of(const view *v, const int32_t place[3], int is_ray)
{
    gn_reach reach = gn_empty_reach();
    if (is_ray)
        gn_reach_ray(&reach, &v->eye, place);
    else
        gn_reach_point(&reach, &v->eye, place);
    return reach;
}

static exact depth_of(const view *v, const int32_t place[3])
{
    exact w = 0;
    for (int i = 0; i < 3; i++)
        w += (exact)(place[i] - v->camera.eye[i]) * v->camera.forward[i];
    return w;
}

static int point_is_taken_in(const view *v, const int32_t place[3])
{
    gn_reach got = reach_of(v, place, 0);
    exact w = depth_of(v, place);
    if (got.low != got.high)
        return 0;
    if (v->camera.projection == GN_ORTHOGRAPHIC) { /* -2^32 w, w with 30 bits */
        exact expected = -4 * w;
        expected = expected > GN_NEAREST ? GN_NEAREST : expected < -GN_NEAREST ? -GN_NEAREST : expected;
        return got.low == expected;
    }
    real expected = w > 0 ? (real)v->camera.near_depth * (1 << 30) * (real)((int64_t)1 << 60) / (real)w : 1e30L;
    if (expected >= (real)GN_NEAREST) /* held, or within an error of being so */
        return got.low <= GN_NEAREST && (real)got.low >= (real)GN_NEAREST * (1 - 16 * unit());
    /* a reciprocal, a product, a rounding */
    return magnitude((real)got.low - expected) <= expected * unit() * (8 + 6.04L + 2) + 1;
}

static void points_and_rays_are_taken_in(uint64_t cases)
{
    uint64_t bad_points = 0, bad_rays = 0, bad_ranges = 0, behind = 0, before = 0;
    for (uint64_t i = 0; i < cases; i++) {
        view v = random_view();
        int32_t place[3], way[3];
        random_place(place, (int64_t)1 << between(1, 27));
        random_place(way, (int64_t)1 << between(1, 30));
        if (!point_is_taken_in(&v, place) && bad_points++ < 4) {
            note("    point (%ld %ld %ld)", (long)place[0], (long)place[1], (long)place[2]);
            show_view(&v);
        }
        exact along = 0;
        for (int k = 0; k < 3; k++)
            along += (exact)way[k] * v.camera.forward[k];
        int perspective = v.camera.projection == GN_PERSPECTIVE;
        int64_t end = along > 0 ? (perspective ? 0 : -GN_NEAREST) : GN_NEAREST;
        gn_reach ray = reach_of(&v, way, 1), point = reach_of(&v, place, 0), both = point;
        bad_rays += along == 0 ? ray.low != GN_NEAREST || ray.high != -GN_NEAREST : ray.low != end || ray.high != end;
        gn_reach_ray(&both, &v.eye, way);
        bad_ranges += both.low != (ray.low < point.low ? ray.low : point.low) ||
                      both.high != (ray.high > point.high ? ray.high : point.high);
        behind += depth_of(&v, place) <= 0;
        before += depth_of(&v, place) > 0;
    }
    ok(bad_points == 0, "points_before_and_behind_the_eye_are_taken_in_at_their_nearness");
    ok(bad_rays == 0, "rays_end_at_infinity_or_behind_the_eye");
    ok(bad_ranges == 0, "a_range_holds_what_it_has_taken_in_and_no_more");
    ok(cases < 100 || (behind && before), "points_on_both_sides_of_the_eye_were_among_them");
    /* a ray across the view stays at its point's depth */
    view v = random_view();
    int32_t across[3] = {0, 0, 0};
    gn_reach ray = reach_of(&v, across, 1);
    ok(ray.low == GN_NEAREST && ray.high == -GN_NEAREST, "a_ray_across_the_view_adds_nothing");
}

int main(int argc, char **argv)
{
    uint64_t cases = tap_cases(argc, argv, 300000) / 4 + 1;
    planes_done_by_hand();
    planes_keep_their_bounds(cases);
    planes_all_but_edge_on_do_not_overflow(cases);
    points_and_rays_are_taken_in(cases);
    return tap_done();
}
