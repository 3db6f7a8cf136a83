/* Projection against long double: random cameras, lights and vertices of all sizes; the flags of the near and far
 * planes and of the guard band; every field's range. Stated bounds, all in the units of the result: a row (view units,
 * 1/256 pixel of affine views, depth of affine views): 1/2 + sum |P| / 2^(shift + 1) + 2^-28 of the largest term, P
 * relative to the eye where there is one; division: 1/2 + half / 2^27 (1 + |X / W| / 8) of 1/256 pixel, where half is
 * 128 x the image's side; Q: two units of 2^30; Z of spot lights: one unit, two of Q's, and 2^-28 of itself. Cases:
 * 200000, or GNOMON_CASES. */
#include "gn_view.h"
#include "scenes.h"

#include <math.h>

typedef long double real;

static real dot(const int32_t axis[3], const real v[3])
{
    return ldexpl(axis[0] * v[0] + axis[1] * v[1] + axis[2] * v[2], -30);
}

static real spread(const real v[3])
{
    return fabsl(v[0]) + fabsl(v[1]) + fabsl(v[2]);
}

/* Log-uniform. */
static int32_t sized(int low_bits, int high_bits)
{
    int bits = between(low_bits, high_bits);
    int32_t v = between((int64_t)1 << (bits - 1), ((int64_t)1 << bits) - 1);
    return v;
}

static int32_t either(int32_t v)
{
    return between(0, 1) ? v : -v;
}

static void random_point(int32_t p[3], int most_bits)
{
    int bits = between(4, most_bits);
    for (int i = 0; i < 3; i++)
        p[i] = either(sized(1, bits));
}

typedef struct worst {
    real row, x, q, depth, pixel;
    uint64_t projected, refused, cameras, flagged_near, flagged_far, flagged_side;
    unsigned failures;
} worst;

static void wrong(worst *w, uint64_t n, const char *what, real got, real expected, real bound)
{
    if (w->failures++ < 5)
        note("case %llu, %s: got %.0Lf, expected %.3Lf within %.3Lf", (unsigned long long)n, what, got, expected,
             bound);
}

static void check(worst *w, uint64_t n, const char *what, real got, real expected, real bound, real *most)
{
    real error = fabsl(got - expected);
    if (error / bound > *most)
        *most = error / bound;
    if (!(error <= bound))
        wrong(w, n, what, got, expected, bound);
}

static real row_bound(const gn_row *row, const real p[3], real largest)
{
    return 0.5L + ldexpl(spread(p), -row->shift - 1) + ldexpl(largest, -28);
}

/* ---- projective views ------------------------------------------------------------------------------------------ */

typedef struct frustum {
    int32_t eye[3];
    const gn_q2_30 *right, *up, *forward;
    real tan_x, tan_y, near_depth, far_depth;
} frustum;

static void check_projective(worst *w, uint64_t n, const gn_view *view, const frustum *f, int32_t width, int32_t height)
{
    real smallest = fminl(1, fminl(f->tan_x, f->tan_y)), unit = ldexpl(view->unit.m, view->unit.e);
    for (int i = 0; i < 8; i++) {
        int32_t p[3];
        gn_place place;
        gn_vertex v;
        random_point(p, 24);
        if (between(0, 1)) /* somewhere before the eye, where things are seen */
            for (int k = 0; k < 3; k++) {
                real t = f->near_depth * expl(logl(f->far_depth / f->near_depth) * between(0, 1000) / 1000.0L);
                real x = t * f->tan_x * between(-1500, 1500) / 1000, y = t * f->tan_y * between(-1500, 1500) / 1000;
                for (int a = 0; a < 3; a++) {
                    real c = f->eye[a] + ldexpl(t * f->forward[a] + x * f->right[a] + y * f->up[a], -30);
                    p[a] = c > GN_WORLD_MAX ? GN_WORLD_MAX : c < -GN_WORLD_MAX ? -GN_WORLD_MAX : (int32_t)c;
                }
            }
        if (gn_view_place(view, p, &place) != GN_OK) {
            wrong(w, n, "status of gn_view_place", -1, 0, 0);
            continue;
        }
        real relative[3] = {(real)p[0] - f->eye[0], (real)p[1] - f->eye[1], (real)p[2] - f->eye[2]};
        /* by the view's own unit: what it is does not matter, only that all three share it */
        real expected[3] = {dot(f->right, relative) / f->tan_x * unit, -dot(f->up, relative) / f->tan_y * unit,
                            dot(f->forward, relative) * unit};
        static const char *const names[3] = {"X", "Y", "W"};
        for (int a = 0; a < 3; a++) {
            real size = spread(relative) * unit / (a == 0 ? f->tan_x : a == 1 ? f->tan_y : 1);
            check(w, n, names[a], place.c[a], expected[a], row_bound(&view->row[a], relative, size), &w->row);
            if (fabsl(expected[a]) > 2147483000.0L)
                wrong(w, n, "a view unit beyond 31 bits", expected[a], 0, 2147483648.0L);
        }
        real margin = row_bound(&view->row[2], relative, spread(relative) * unit) + 1;
        int is_near = expected[2]<f->near_depth * unit - margin, is_far = expected[2]> f->far_depth * unit + margin;
        int surely_inside = expected[2] > f->near_depth * unit + margin && expected[2] < f->far_depth * unit - margin &&
                            fabsl(expected[0]) < view->guard * expected[2] - 8 * margin / smallest &&
                            fabsl(expected[1]) < view->guard * expected[2] - 8 * margin / smallest;
        int is_aside = fabsl(expected[0]) > view->guard * expected[2] + 8 * margin / smallest ||
                       fabsl(expected[1]) > view->guard * expected[2] + 8 * margin / smallest;
        gn_view_project(view, &place, &v);
        w->flagged_near += v.depth == 0 && is_near;
        w->flagged_far += v.depth == 0 && is_far;
        w->flagged_side += v.depth == 0 && is_aside && !is_near && !is_far;
        if ((is_near || is_far || is_aside) && v.depth)
            wrong(w, n, "depth of a vertex outside", v.depth, 0, 0);
        if (surely_inside && !v.depth)
            wrong(w, n, "depth of a vertex inside", 0, expected[2], 0);
        if (!v.depth)
            continue;
        w->projected++;
        real ratio_x = (real)place.c[0] / place.c[2], ratio_y = (real)place.c[1] / place.c[2];
        check(w, n, "x of X / W", v.x, 128.0L * width * (1 + ratio_x),
              0.5L + ldexpl(128.0L * width, -27) * (1 + fabsl(ratio_x) / 8), &w->x);
        check(w, n, "y of Y / W", v.y, 128.0L * height * (1 + ratio_y),
              0.5L + ldexpl(128.0L * height, -27) * (1 + fabsl(ratio_y) / 8), &w->x);
        if (labs(v.x - 128 * width) > GN_MAX_COORDINATE || labs(v.y - 128 * height) > GN_MAX_COORDINATE)
            wrong(w, n, "a coordinate beyond the guard band", v.x, v.y, GN_MAX_COORDINATE);
        real q = ldexpl((real)view->near_w / place.c[2], 30);
        if (view->post_projective_depth) {
            real far_w = view->far_w, scale = (real)GN_DEPTH_SPAN * far_w / (far_w - view->near_w);
            real z = GN_DEPTH_GUARD + scale * (1 - (real)view->near_w / place.c[2]);
            check(w, n, "Z", v.depth, z, 1 + 2 * ldexpl(scale, -30) + ldexpl(z, -28), &w->depth);
            /* two units of Q may reach into the guard, a quarter of it at most */
            if (v.depth < GN_DEPTH_GUARD || v.depth > 0x80000000u - GN_DEPTH_GUARD + 2 * ldexpl(scale, -30) ||
                v.depth > 0x80000000u - GN_DEPTH_GUARD * 3 / 4)
                wrong(w, n, "a depth in the guard", v.depth, z, 0);
        } else {
            check(w, n, "Q", v.depth, q, 2, &w->q);
            if (v.depth > 1u << 30 || v.depth < 1u << 9)
                wrong(w, n, "Q out of its range", v.depth, q, 0);
        }
        /* all of it, where the vertex is far enough for its view units to say where it is */
        if (place.c[2] >= 1 << 24) {
            real x = 128.0L * width * (1 + expected[0] / expected[2]);
            real error = fabsl(v.x - x);
            w->pixel = fmaxl(w->pixel, error);
            if (!(error <= 0.75L))
                wrong(w, n, "x from world to screen", v.x, x, 0.75L);
        }
    }
}

static int random_axes(gn_camera *camera, int most_bits)
{
    int32_t eye[3], target[3], up[3];
    random_point(eye, most_bits);
    random_point(target, most_bits);
    random_point(up, 20);
    return gn_look_at(camera, eye, target, up) == GN_OK;
}

static void projective_views_keep_their_bounds(uint64_t cases)
{
    worst w;
    memset(&w, 0, sizeof w);
    for (uint64_t n = 0; n < cases / 8 && w.failures < 5; n++) {
        gn_camera camera;
        gn_light light;
        gn_view view;
        frustum f;
        memset(&camera, 0, sizeof camera);
        memset(&light, 0, sizeof light);
        int32_t width = between(0, 3) ? sized(1, 12) : 4096, height = between(0, 3) ? sized(1, 12) : 4096;
        if (!random_axes(&camera, n & 1 ? 27 : 24))
            continue;
        camera.tan_half = (uint32_t)sized(18, 30);
        camera.near_depth = sized(4, 24);
        int ratio = between(1, 20);
        int64_t far_depth = (int64_t)camera.near_depth * ((int64_t)1 << ratio) -
                            (between(0, 1) ? 0 : between(0, camera.near_depth - 1));
        camera.far_depth = far_depth > 1 << 28 ? 1 << 28 : (int32_t)far_depth;
        for (int a = 0; a < 3; a++)
            f.eye[a] = camera.eye[a];
        f.right = camera.right, f.up = camera.up, f.forward = camera.forward;
        f.tan_y = ldexpl(camera.tan_half, -24);
        f.near_depth = camera.near_depth, f.far_depth = camera.far_depth;
        gn_status status;
        if (n & 2) {
            memcpy(light.right, camera.right, sizeof light.right);
            memcpy(light.up, camera.up, sizeof light.up);
            memcpy(light.forward, camera.forward, sizeof light.forward);
            memcpy(light.position, camera.eye, sizeof light.position);
            light.kind = GN_SPOT;
            light.tan_half = camera.tan_half;
            light.near_depth = camera.near_depth;
            light.far_depth = camera.far_depth;
            f.tan_x = f.tan_y;
            status = gn_make_light_view(&view, &light, width, height);
        } else {
            f.tan_x = f.tan_y * width / height;
            status = gn_make_camera_view(&view, &camera, width, height);
        }
        if (status == GN_OUT_OF_RANGE && n & 2 && camera.far_depth - camera.near_depth <= camera.far_depth / 1000)
            continue;          /* a spot light's range thinner than 1/1024 of its far end */
        if (status != GN_OK) { /* only where the near plane comes to less than 64 view units */
            real smallest = fminl(1, fminl(f.tan_x, f.tan_y)), reach = 16777216;
            for (int a = 0; a < 3; a++)
                reach = fmaxl(reach, 16777216.0L + fabsl((real)f.eye[a]));
            /* 2^28 over the next power of two below reach */
            if (status != GN_OUT_OF_RANGE || camera.near_depth * smallest * 268435456.0L / reach > 65)
                wrong(&w, n, "status", status, 0, 0);
            w.refused++;
            continue;
        }
        w.cameras++;
        check_projective(&w, n, &view, &f, width, height);
    }
    ok(!w.failures, "projective views keep their bounds: %llu cameras and spot lights, %llu vertices projected",
       (unsigned long long)w.cameras, (unsigned long long)w.projected);
    ok(w.projected > cases / 20 && w.flagged_near > cases / 20 && w.flagged_far > cases / 100 &&
           w.flagged_side > cases / 100,
       "%llu vertices flagged before the near plane, %llu behind the far one, %llu beside the guard band",
       (unsigned long long)w.flagged_near, (unsigned long long)w.flagged_far, (unsigned long long)w.flagged_side);
    note(
        "largest errors, of their bounds: rows %.4Lf, division %.4Lf, Q %.4Lf, Z %.4Lf; world to screen %.4Lf of 1/256 "
        "pixel; %llu refused",
        w.row, w.x, w.q, w.depth, w.pixel, (unsigned long long)w.refused);
}

/* ---- affine views ---------------------------------------------------------------------------------------------- */

static void affine_views_keep_their_bounds(uint64_t cases)
{
    worst w;
    memset(&w, 0, sizeof w);
    uint64_t beyond = 0;
    for (uint64_t n = 0; n < cases / 8 && w.failures < 5; n++) {
        gn_camera camera;
        gn_light light;
        gn_view view;
        memset(&camera, 0, sizeof camera);
        memset(&light, 0, sizeof light);
        int32_t width = between(0, 3) ? sized(1, 12) : 4096, height = between(0, 3) ? sized(1, 12) : 4096;
        real scale[3], centre[3], origin[3] = {128.0L * width, 128.0L * height, 0};
        const gn_q2_30 *axis[3] = {camera.right, camera.up, camera.forward};
        real from[3] = {0, 0, 0};
        gn_status status;
        if (!random_axes(&camera, n & 1 ? 27 : 24))
            continue;
        if (n & 2) {
            memcpy(light.right, camera.right, sizeof light.right);
            memcpy(light.up, camera.up, sizeof light.up);
            memcpy(light.forward, camera.forward, sizeof light.forward);
            light.kind = GN_DIRECTIONAL;
            int bits = between(8, 25);
            light.box_width = sized(bits, bits + 3);
            light.box_height = sized(bits, bits + 3);
            light.box_depth = sized(bits, bits + 3);
            light.box_u = either(sized(1, 25));
            light.box_v = either(sized(1, 25));
            light.box_z = either(sized(1, 25));
            status = gn_make_light_view(&view, &light, width, height);
            scale[0] = 256.0L * width / light.box_width;
            scale[1] = -256.0L * height / light.box_height;
            scale[2] = (real)GN_DEPTH_SPAN / light.box_depth;
            centre[0] = light.box_u + light.box_width / 2.0L;
            centre[1] = light.box_v + light.box_height / 2.0L;
            centre[2] = light.box_z;
            origin[2] = GN_DEPTH_GUARD;
        } else {
            for (int a = 0; a < 3; a++)
                from[a] = camera.eye[a];
            camera.projection = GN_ORTHOGRAPHIC;
            camera.half_height = sized(7, 25);
            camera.near_depth = either(sized(1, 24));
            camera.far_depth = camera.near_depth + sized(7, 25);
            status = gn_make_camera_view(&view, &camera, width, height);
            scale[0] = 128.0L * height / camera.half_height;
            scale[1] = -scale[0];
            scale[2] = -(real)((1 << 30) - (1 << 10)) / ((real)camera.far_depth - camera.near_depth);
            centre[0] = centre[1] = 0;
            centre[2] = camera.far_depth;
            origin[2] = 1 << 10;
        }
        if (status != GN_OK) {
            wrong(&w, n, "status", status, 0, 0);
            continue;
        }
        w.cameras++;
        for (int i = 0; i < 8; i++) {
            int32_t p[3];
            gn_place place;
            gn_vertex v;
            real c[3], bound[3];
            random_point(p, 24);
            real u = centre[0] + origin[0] / scale[0] * between(-1500, 1500) / 1000;
            real up = centre[1] + origin[1] / scale[1] * between(-1500, 1500) / 1000;
            real z = centre[2] + ldexpl(1, 31) / scale[2] * (n & 2 ? 1 : 0.5L) * between(-100, 1100) / 1000;
            for (int a = 0; a < 3 && between(0, 3); a++) {
                real x = from[a] + ldexpl(u * axis[0][a] + up * axis[1][a] + z * axis[2][a], -30);
                p[a] = x > GN_WORLD_MAX ? GN_WORLD_MAX : x < -GN_WORLD_MAX ? -GN_WORLD_MAX : (int32_t)x;
            }
            real relative[3] = {p[0] - from[0], p[1] - from[1], p[2] - from[2]};
            status = gn_view_place(&view, p, &place);
            for (int a = 0; a < 3; a++) {
                c[a] = (dot(axis[a], relative) - centre[a]) * scale[a];
                real size = fabsl(scale[a]) * (spread(relative) + fabsl(centre[a]));
                bound[a] = row_bound(&view.row[a], relative, size);
            }
            real limit = ldexpl(1, 44);
            if (status != GN_OK) {
                beyond++;
                if (status != GN_OUT_OF_RANGE || (fabsl(c[0]) < limit - bound[0] && fabsl(c[1]) < limit - bound[1] &&
                                                  fabsl(c[2] + origin[2]) < limit - bound[2]))
                    wrong(&w, n, "status of gn_view_place", status, 0, 0);
                continue;
            }
            for (int a = 0; a < 3; a++)
                if (fabsl(c[a] + (a == 2 ? origin[2] : 0)) > limit + bound[a])
                    wrong(&w, n, "a place beyond 2^44", place.c[a], c[a], 0);
            gn_view_project(&view, &place, &v);
            real depth = origin[2] + c[2], band = GN_MAX_COORDINATE;
            int is_near = depth<view.near_w - bound[2], is_far = depth> view.far_w + bound[2];
            int is_aside = fabsl(c[0]) > band + bound[0] || fabsl(c[1]) > band + bound[1];
            int inside = depth > view.near_w + bound[2] && depth < view.far_w - bound[2] &&
                         fabsl(c[0]) < band - bound[0] && fabsl(c[1]) < band - bound[1];
            w.flagged_near += v.depth == 0 && is_near;
            w.flagged_far += v.depth == 0 && is_far;
            w.flagged_side += v.depth == 0 && is_aside && !is_near && !is_far;
            if ((is_near || is_far || is_aside) && v.depth)
                wrong(&w, n, "depth of a vertex outside", v.depth, depth, 0);
            if (inside && !v.depth)
                wrong(&w, n, "depth of a vertex inside", v.depth, depth, 0);
            if (!v.depth)
                continue;
            w.projected++;
            check(&w, n, "x", v.x, origin[0] + c[0], bound[0], &w.x);
            check(&w, n, "y", v.y, origin[1] + c[1], bound[1], &w.x);
            check(&w, n, "depth", v.depth, depth, bound[2], &w.depth);
            if (bound[0] < 0.75L)
                w.pixel = fmaxl(w.pixel, fabsl(v.x - origin[0] - c[0]));
            if (n & 2 && (v.depth < GN_DEPTH_GUARD || v.depth > 0x80000000u - GN_DEPTH_GUARD))
                wrong(&w, n, "a depth in the guard", v.depth, depth, 0);
            if (!(n & 2) && (v.depth < 1u << 10 || v.depth > 1u << 30))
                wrong(&w, n, "Q out of its range", v.depth, depth, 0);
        }
    }
    ok(!w.failures, "affine views keep their bounds: %llu cameras and lights, %llu vertices projected",
       (unsigned long long)w.cameras, (unsigned long long)w.projected);
    ok(w.projected > cases / 20 && w.flagged_near > cases / 100 && w.flagged_far > cases / 100 &&
           w.flagged_side > cases / 100 && beyond > 10,
       "%llu vertices flagged before the near plane, %llu behind the far one, %llu beside the guard band, %llu beyond "
       "2^44",
       (unsigned long long)w.flagged_near, (unsigned long long)w.flagged_far, (unsigned long long)w.flagged_side,
       (unsigned long long)beyond);
    note("largest errors, of their bounds: x, y %.4Lf, depth %.4Lf; x, where the bound is below 3/4: %.4Lf of 1/256 "
         "pixel",
         w.x, w.depth, w.pixel);
}

/* ---- by hand --------------------------------------------------------------------------------------------------- */

static gn_camera forward_camera(void)
{
    gn_camera c;
    memset(&c, 0, sizeof c);
    c.right[0] = 1 << 30;
    c.up[1] = 1 << 30;
    c.forward[2] = -(1 << 30);
    c.tan_half = 1 << 24;
    c.half_height = 1000;
    c.near_depth = 1000;
    c.far_depth = 1000000;
    return c;
}

static gn_light forward_light(gn_light_kind kind)
{
    gn_light l = grid_light(64, 64);
    l.kind = (uint8_t)kind;
    l.tan_half = 1 << 24;
    l.near_depth = 1000;
    l.far_depth = 1000000;
    return l;
}

static void vertex_is(const char *what, const gn_view *view, int32_t x, int32_t y, int32_t z, int32_t expected_x,
                      int32_t expected_y, uint32_t least, uint32_t most)
{
    int32_t p[3] = {x, y, z};
    gn_place place;
    gn_vertex v;
    gn_status status = gn_view_place(view, p, &place);
    gn_view_project(view, &place, &v);
    if (!ok(status == GN_OK && v.x == expected_x && v.y == expected_y && v.depth >= least && v.depth <= most, "%s",
            what))
        note("got status %d, x %ld, y %ld, depth %lu; expected %ld, %ld, %lu to %lu", (int)status, (long)v.x, (long)v.y,
             (unsigned long)v.depth, (long)expected_x, (long)expected_y, (unsigned long)least, (unsigned long)most);
}

static void vertices_by_hand(void)
{
    gn_view view;
    gn_camera camera = forward_camera();
    gn_light light = forward_light(GN_SPOT);
    /* 90 degrees, 128 x 64 pixels: at a distance of 4000 a unit is 32 pixels / 4000 = 8192/4000 of 1/256 pixel */
    gn_make_camera_view(&view, &camera, 128, 64);
    vertex_is("straight ahead is the middle", &view, 0, 0, -4000, 128 * 128, 128 * 64, (1 << 28) - 2, 1 << 28);
    vertex_is("right and up", &view, 2000, 1000, -4000, 128 * 128 + 4096, 128 * 64 - 2048, (1 << 28) - 2, 1 << 28);
    vertex_is("the lower left corner", &view, -8000, -4000, -4000, 0, 256 * 64, (1 << 28) - 2, 1 << 28);
    vertex_is("the near plane is inside", &view, 0, 0, -1000, 128 * 128, 128 * 64, (1 << 30) - 2, 1 << 30);
    vertex_is("the far plane is inside", &view, 0, 0, -1000000, 128 * 128, 128 * 64, 1073740, 1073742);
    vertex_is("before the near plane", &view, 0, 0, -999, 0, 0, 0, 0);
    vertex_is("behind the far plane", &view, 0, 0, -1000001, 0, 0, 0, 0);
    vertex_is("behind the eye", &view, 5, 6, 3000, 0, 0, 0, 0);
    /* the guard band is 7 times the image's half */
    vertex_is("inside the guard band", &view, 55900, 0, -4000, 128 * 128 + 114483, 128 * 64, (1 << 28) - 2, 1 << 28);
    vertex_is("outside the guard band", &view, 56100, 0, -4000, 0, 0, 0, 0);
    camera.projection = GN_ORTHOGRAPHIC;
    camera.near_depth = -1000000;
    gn_make_camera_view(&view, &camera, 128, 64);
    /* half a height of 1000 is 32 pixels */
    vertex_is("orthographic: right and up", &view, 500, 250, 0, 128 * 128 + 4096, 128 * 64 - 2048, (1 << 29) + 510,
              (1 << 29) + 514);
    vertex_is("orthographic: the near plane", &view, 0, 0, 1000000, 128 * 128, 128 * 64, (1 << 30) - 4, 1 << 30);
    vertex_is("orthographic: the far plane", &view, 0, 0, -1000000, 128 * 128, 128 * 64, 1 << 10, (1 << 10) + 4);
    vertex_is("orthographic: behind the far plane", &view, 0, 0, -1000010, 0, 0, 0, 0);
    gn_make_light_view(&view, &light, 64, 64);
    /* f / (f - n) (1 - n / w) = 1000/999 x 3/4 */
    vertex_is("spot: depth", &view, 2000, 1000, -4000, 8192 + 4096, 8192 - 2048, 1612198000 + GN_DEPTH_GUARD - 1000000,
              1612198000 + GN_DEPTH_GUARD + 1000000);
    vertex_is("spot: the near plane", &view, 0, 0, -1000, 8192, 8192, GN_DEPTH_GUARD, GN_DEPTH_GUARD + 8);
    vertex_is("spot: the far plane", &view, 0, 0, -1000000, 8192, 8192, 0x80000000u - GN_DEPTH_GUARD - 16,
              0x80000000u - GN_DEPTH_GUARD);
    light.kind = GN_DIRECTIONAL;
    gn_make_light_view(&view, &light, 64, 64);
    vertex_is("directional: a unit is 1/256 texel, 2^15 of depth", &view, 100, 200, -300, 100, 64 * 256 - 200,
              GN_DEPTH_GUARD + 300 * 32768u, GN_DEPTH_GUARD + 300 * 32768u);
    vertex_is("directional: the end of the range", &view, 0, 0, -65535, 0, 64 * 256, 0x80000000u - GN_DEPTH_GUARD,
              0x80000000u - GN_DEPTH_GUARD);
    vertex_is("directional: behind it", &view, 0, 0, -65536, 0, 0, 0, 0);
}

static void ranges_are_checked(void)
{
    gn_view view;
    gn_camera camera;
    gn_light light;
#define CAMERA(change, expected)                                                                                       \
    do {                                                                                                               \
        camera = forward_camera();                                                                                     \
        change;                                                                                                        \
        gn_status got = gn_make_camera_view(&view, &camera, 64, 64);                                                   \
        if (!ok(got == expected, "camera: " #change " is " #expected))                                                 \
            note("got %d", (int)got);                                                                                  \
    } while (0)
#define LIGHT(of, change, expected)                                                                                    \
    do {                                                                                                               \
        light = forward_light(of);                                                                                     \
        change;                                                                                                        \
        gn_status got = gn_make_light_view(&view, &light, 64, 64);                                                     \
        if (!ok(got == expected, "light: " #change " is " #expected))                                                  \
            note("got %d", (int)got);                                                                                  \
    } while (0)
    CAMERA((void)0, GN_OK);
    CAMERA(camera.projection = 2, GN_BAD_ARGUMENT);
    for (int i = 0; i < 3; i++) {
        CAMERA(camera.right[i] = INT32_MIN, GN_OUT_OF_RANGE);
        CAMERA(camera.up[i] = (1 << 30) + 1000, GN_OUT_OF_RANGE);
        CAMERA(camera.forward[i] = -(1 << 30) - 1000, GN_OUT_OF_RANGE);
        LIGHT(GN_SPOT, light.right[i] = INT32_MAX, GN_OUT_OF_RANGE);
        LIGHT(GN_DIRECTIONAL, light.up[i] = INT32_MAX, GN_OUT_OF_RANGE);
        LIGHT(GN_DIRECTIONAL, light.forward[i] = INT32_MIN, GN_OUT_OF_RANGE);
    }
    CAMERA(camera.tan_half = (1 << 16) - 1, GN_OUT_OF_RANGE);
    CAMERA((camera.tan_half = 1 << 16, camera.near_depth = 100000), GN_OK);
    CAMERA(camera.tan_half = 64u << 24, GN_OK);
    CAMERA(camera.tan_half = (64u << 24) + 1, GN_OUT_OF_RANGE);
    CAMERA(camera.near_depth = 0, GN_OUT_OF_RANGE);
    CAMERA(camera.near_depth = -1, GN_OUT_OF_RANGE);
    CAMERA(camera.far_depth = 1000, GN_OUT_OF_RANGE);
    CAMERA(camera.far_depth = 1 << 28, GN_OK);
    CAMERA(camera.far_depth = (1 << 28) + 1, GN_OUT_OF_RANGE);
    CAMERA((camera.near_depth = 256, camera.far_depth = 1 << 28), GN_OK); /* far / near = 2^20 */
    CAMERA((camera.near_depth = 255, camera.far_depth = 1 << 28), GN_OUT_OF_RANGE);
    for (int i = 0; i < 3; i++) {
        CAMERA(camera.eye[i] = GN_EYE_MAX, GN_OK);
        CAMERA(camera.eye[i] = GN_EYE_MAX + 1, GN_OUT_OF_RANGE);
        CAMERA(camera.eye[i] = -GN_EYE_MAX - 1, GN_OUT_OF_RANGE);
        CAMERA((camera.projection = GN_ORTHOGRAPHIC, camera.eye[i] = GN_EYE_MAX + 1), GN_OUT_OF_RANGE);
        LIGHT(GN_SPOT, light.position[i] = -GN_EYE_MAX, GN_OK);
        LIGHT(GN_SPOT, light.position[i] = -GN_EYE_MAX - 1, GN_OUT_OF_RANGE);
    }
#define ORTHOGRAPHIC(change, expected) CAMERA((camera.projection = GN_ORTHOGRAPHIC, change), expected)
    ORTHOGRAPHIC(camera.half_height = 0, GN_OUT_OF_RANGE);
    ORTHOGRAPHIC(camera.half_height = -1, GN_OUT_OF_RANGE);
    ORTHOGRAPHIC(camera.half_height = 1, GN_OK);
    ORTHOGRAPHIC(camera.half_height = 1 << 26, GN_OK);
    ORTHOGRAPHIC(camera.half_height = (1 << 26) + 1, GN_OUT_OF_RANGE);
    ORTHOGRAPHIC(camera.near_depth = -(1 << 28), GN_OK);
    ORTHOGRAPHIC(camera.near_depth = -(1 << 28) - 1, GN_OUT_OF_RANGE);
    ORTHOGRAPHIC(camera.far_depth = (1 << 28) + 1, GN_OUT_OF_RANGE);
    ORTHOGRAPHIC(camera.far_depth = 1063, GN_OUT_OF_RANGE);
    ORTHOGRAPHIC(camera.far_depth = 1064, GN_OK);
    LIGHT(GN_SPOT, (void)0, GN_OK);
    LIGHT(GN_SPOT, light.kind = GN_POINT, GN_UNSUPPORTED); /* six views */
    LIGHT(GN_SPOT, light.kind = 3, GN_BAD_ARGUMENT);
    LIGHT(GN_SPOT, light.tan_half = (1 << 16) - 1, GN_OUT_OF_RANGE);
    LIGHT(GN_SPOT, light.tan_half = (64u << 24) + 1, GN_OUT_OF_RANGE);
    LIGHT(GN_SPOT, light.near_depth = 0, GN_OUT_OF_RANGE);
    LIGHT(GN_SPOT, light.far_depth = light.near_depth, GN_OUT_OF_RANGE);
    LIGHT(GN_SPOT, light.far_depth = (1 << 28) + 1, GN_OUT_OF_RANGE);
    LIGHT(GN_SPOT, (light.near_depth = 255, light.far_depth = 1 << 28), GN_OUT_OF_RANGE);
    LIGHT(GN_SPOT, (light.near_depth = 1000000, light.far_depth = 1001100), GN_OK); /* far / (far - near) < 1024 */
    LIGHT(GN_SPOT, (light.near_depth = 1000000, light.far_depth = 1000900), GN_OUT_OF_RANGE);
    LIGHT(GN_DIRECTIONAL, (void)0, GN_OK);
#define BOX(field, low, high)                                                                                          \
    LIGHT(GN_DIRECTIONAL, light.field = low - 1, GN_OUT_OF_RANGE);                                                     \
    LIGHT(GN_DIRECTIONAL, light.field = low, GN_OK);                                                                   \
    LIGHT(GN_DIRECTIONAL, light.field = high, GN_OK);                                                                  \
    LIGHT(GN_DIRECTIONAL, light.field = high + 1, GN_OUT_OF_RANGE)
    BOX(box_width, 64, (1 << 28));
    BOX(box_height, 64, (1 << 28));
    BOX(box_depth, 64, (1 << 28));
    BOX(box_u, -(1 << 28), (1 << 28));
    BOX(box_v, -(1 << 28), (1 << 28));
    BOX(box_z, -(1 << 28), (1 << 28));
}

/* ---- models and boxes ------------------------------------------------------------------------------------------ */

__extension__ typedef __int128 exact;

/* floor((m v + half) / 2^shift) + t: half is what rounds to nearest, the larger one at a tie. */
static void models_place_to_the_nearest_unit(uint64_t cases)
{
    uint64_t failures = 0, placed = 0, refused = 0;
    for (uint64_t n = 0; n < cases; n++) {
        gn_model model;
        int32_t v[1][3], world[3];
        gn_mesh mesh = {0};
        gn_object object = {&mesh, &model, {0, 0, 0}};
        int beyond = 0;
        model.shift = (uint8_t)(between(0, 3) ? between(24, 36) : between(0, 62));
        int32_t most = between(0, 1) ? 1 << 30 : 1 << between(0, 30);
        for (int i = 0; i < 3; i++) {
            v[0][i] = between(-GN_WORLD_MAX, GN_WORLD_MAX);
            model.t[i] = between(-GN_WORLD_MAX, GN_WORLD_MAX);
            for (int k = 0; k < 3; k++)
                model.m[i][k] = between(-most, most);
        }
        mesh.vertices = (const int32_t(*)[3])v;
        mesh.vertex_count = 1;
        gn_status status = gn_world_position(&object, 0, world);
        for (int i = 0; i < 3; i++) {
            exact divisor = (exact)1 << model.shift, doubled = divisor;
            for (int k = 0; k < 3; k++)
                doubled += 2 * (exact)model.m[i][k] * v[0][k];
            exact expected = doubled / (2 * divisor) - (doubled % (2 * divisor) < 0) + model.t[i];
            int out = expected < -GN_WORLD_MAX || expected > GN_WORLD_MAX;
            beyond |= out;
            failures += world[i] != (out ? 0 : expected);
        }
        failures += status != (beyond ? GN_OUT_OF_RANGE : GN_OK);
        placed += !beyond;
        refused += (uint64_t)beyond;
    }
    ok(!failures, "models place vertices to the nearest unit");
    ok(placed > cases / 10 && refused > cases / 10, "%llu vertices placed, %llu refused", (unsigned long long)placed,
       (unsigned long long)refused);
}

/* Along each axis: 1 % of the extent to either side of the scene; the map is square. */
static void boxes_hold_the_scene(uint64_t cases)
{
    uint64_t failures = 0;
    for (uint64_t n = 0; n < cases / 100 && failures < 5; n++) {
        shape s = shape_new(0);
        gn_object object = {&s.mesh, 0, {0, 0, 0}};
        gn_scene scene = {&object, 1, {0, 0, 0}, 0};
        gn_light light;
        int32_t direction[3] = {between(-1000, 1000), between(-1000, 1000), between(1, 1000)};
        int32_t reach = 1 << between(10, 24);
        real low[3] = {HUGE_VALL, HUGE_VALL, HUGE_VALL}, high[3] = {-HUGE_VALL, -HUGE_VALL, -HUGE_VALL};
        gn_status status = gn_directional_light(&light, direction, 0);
        const gn_q2_30 *axes[3] = {light.right, light.up, light.forward};
        for (int v = between(3, 8); v > 0; v--) {
            int32_t p[3] = {between(-reach, reach), between(-reach, reach), between(-reach, reach)};
            add_vertex(&s, p[0], p[1], p[2]);
            for (int a = 0; a < 3; a++) {
                real along = ldexpl((real)axes[a][0] * p[0] + (real)axes[a][1] * p[1] + (real)axes[a][2] * p[2], -30);
                low[a] = fminl(low[a], along);
                high[a] = fmaxl(high[a], along);
            }
        }
        if (status == GN_OK)
            status = gn_fit_light(&light, &scene);
        real square = fmaxl(high[0] - low[0], high[1] - low[1]);
        real extent[3] = {square, square, fmaxl(high[2] - low[2], square / 256)};
        real start[3] = {light.box_u, light.box_v, light.box_z};
        real size[3] = {light.box_width, light.box_height, light.box_depth};
        for (int a = 0; a < 3; a++) {
            int good = status == GN_OK && fabsl(size[a] - 1.02L * extent[a]) <= 4 &&
                       fabsl(start[a] + size[a] / 2 - (low[a] + high[a]) / 2) <= 2;
            if (!good && failures++ < 5)
                note("case %llu, axis %d: status %d, from %.1Lf, size %.1Lf; the scene from %.1Lf to %.1Lf",
                     (unsigned long long)n, a, (int)status, start[a], size[a], low[a], high[a]);
        }
        shape_free(&s);
    }
    ok(!failures, "a fitted box holds the scene in its middle");
}

int main(int argc, char **argv)
{
    uint64_t cases = tap_cases(argc, argv, 200000);
    vertices_by_hand();
    models_place_to_the_nearest_unit(cases);
    boxes_hold_the_scene(cases);
    ranges_are_checked();
    projective_views_keep_their_bounds(cases);
    affine_views_keep_their_bounds(cases);
    return tap_done();
}
