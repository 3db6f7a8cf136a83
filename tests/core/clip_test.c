/* Clipping: where an edge crosses a plane does not depend on who asks, and lies where it should; clipped polygons stay
 * inside the planes, keep corners that lie in one, and find their largest piece; planes of Q do not fall below what a
 * surface has. Cases: 200000 edges and triangles, or GNOMON_CASES. */
#include "gn_clip.h"
#include "scenes.h"

__extension__ typedef __int128 exact;

/* |v| < 2^bits for some number of bits. */
static int64_t sized(int most_bits)
{
    int64_t v = (int64_t)(tap_random(&random_state) & ~(UINT64_MAX << between(1, most_bits)));
    return between(0, 1) ? v : -v;
}

/* ---- crossings ------------------------------------------------------------------------------------------------- */

static exact distance(int64_t a, int64_t b)
{
    return a < b ? (exact)b - a : (exact)a - b;
}

/* 31 bits of the way, two floors, and one unit more in the divisor, which is as much as the distances are rounded. */
static int is_where_it_should_be(const gn_place *p, const gn_place *a, const gn_place *b, int64_t da, int64_t db)
{
    exact whole = distance(da, db), from_a = distance(da, 0);
    for (int i = 0; i < 3; i++) {
        exact along = ((exact)b->c[i] - a->c[i]) * from_a, apart = (exact)(p->c[i] - a->c[i]) * whole - along;
        apart = apart < 0 ? -apart : apart;
        exact edge = distance(a->c[i], b->c[i]);
        if (apart > whole * (2 + edge / (1 << 28)) + edge)
            return 0;
    }
    return 1;
}

static void crossings_do_not_depend_on_who_asks(uint64_t cases)
{
    uint64_t different = 0, elsewhere = 0, beside = 0;
    gn_view view;
    memset(&view, 0, sizeof view);
    for (uint64_t n = 0; n < cases; n++) {
        gn_place a, b;
        int bits = between(0, 1) ? 30 : 44, plane = between(0, GN_CLIP_PLANES);
        for (int i = 0; i < 3; i++) {
            a.c[i] = sized(bits);
            b.c[i] = between(0, 7) ? sized(bits) : a.c[i]; /* equal coordinates: the order is the next one's */
        }
        int64_t da = sized(45), db = sized(45);
        da = da < 0 ? -da : da + 1;
        db = db < 0 ? db : -db - 1;
        view.near_w = between(64, 1 << 30);
        view.far_w = between(view.near_w, 0x7fffffff);
        gn_place p = gn_plane_crossing(&view, &a, &b, da, db, plane),
                 q = gn_plane_crossing(&view, &b, &a, db, da, plane);
        different += p.c[0] != q.c[0] || p.c[1] != q.c[1] || p.c[2] != q.c[2];
        if (plane < 2)
            beside += p.c[2] != (plane ? view.far_w : view.near_w);
        else
            elsewhere += !is_where_it_should_be(&p, &a, &b, da, db);
    }
    ok(!different, "a crossing is the same from both ends: %llu edges", (unsigned long long)cases);
    ok(!elsewhere, "it divides the edge as the distances say");
    ok(!beside, "it lies in the near or far plane to the bit");
}

/* ---- polygons -------------------------------------------------------------------------------------------------- */

/* A random view of a kind: 0 perspective, 1 orthographic, 2 spot light, 3 directional light. */
static gn_status random_view(gn_view *view, int kind, int32_t width, int32_t height)
{
    static const int32_t up[3] = {0, 1, 0};
    int32_t eye[3] = {between(-1000, 1000), between(-1000, 1000), between(-1000, 1000)};
    int32_t target[3] = {eye[0] + between(-500, 500), eye[1] + between(-500, 500), eye[2] - 1000};
    gn_camera camera;
    gn_light light;
    memset(&camera, 0, sizeof camera);
    if (kind == 3) {
        gn_status status = gn_directional_light(&light, eye[0] | eye[1] | eye[2] ? eye : up, 0);
        light.box_u = light.box_v = light.box_z = -between(100, 3000);
        light.box_width = light.box_height = light.box_depth = between(200, 6000);
        return status == GN_OK ? gn_make_light_view(view, &light, width, height) : status;
    }
    int32_t near_depth = between(10, 300), far_depth = between(2000, 100000);
    if (kind == 2) {
        gn_status status = gn_spot_light(&light, eye, target, 0, GN_DEGREES(between(20, 120)), near_depth, far_depth);
        return status == GN_OK ? gn_make_light_view(view, &light, width, height) : status;
    }
    gn_status status = gn_look_at(&camera, eye, target, up);
    if (status == GN_OK && kind == 0)
        status = gn_perspective(&camera, GN_DEGREES(between(20, 120)), near_depth, far_depth);
    else if (status == GN_OK)
        status = gn_orthographic(&camera, between(100, 2000), near_depth, far_depth);
    return status == GN_OK ? gn_make_camera_view(view, &camera, width, height) : status;
}

static int64_t magnitude(int64_t v)
{
    return v < 0 ? -v : v;
}

/* Every corner: within the range of depths, but for two units of Q that a spot light may magnify by 2^11; and within
 * the guard band but for what rounding of a crossing moves it: two view units of at least 64 in W. */
static int stays_inside(const gn_view *view, const gn_polygon *polygon, int kind)
{
    int32_t reach_x = view->affine ? GN_MAX_COORDINATE : view->guard * view->half_width;
    int32_t reach_y = view->affine ? GN_MAX_COORDINATE : view->guard * view->half_height;
    int32_t slack_x = 2 + reach_x / 32, slack_y = 2 + reach_y / 32;
    uint32_t least = kind < 2 ? 1 : GN_DEPTH_GUARD, most = kind < 2 ? 1u << 30 : 0x80000000u - GN_DEPTH_GUARD;
    most += kind == 2 ? 1 << 12 : 1;
    for (int32_t i = 0; i < polygon->count; i++) {
        const gn_vertex *v = &polygon->v[i];
        if (magnitude(v->x - view->centre_x) > reach_x + slack_x ||
            magnitude(v->y - view->centre_y) > reach_y + slack_y || v->depth < least || v->depth > most)
            return 0;
    }
    return 1;
}

static int has_its_largest_piece(const gn_polygon *polygon)
{
    const gn_vertex *v = polygon->v;
    int64_t largest = 0;
    for (int32_t i = 1; i + 1 < polygon->count; i++) {
        int64_t area = magnitude(gn_area(&v[0], &v[i], &v[i + 1]));
        largest = area > largest ? area : largest;
    }
    return magnitude(polygon->area) == largest &&
           (!largest || polygon->area == gn_area(&v[0], &v[polygon->reference], &v[polygon->reference + 1]));
}

static void polygons_stay_inside(uint64_t cases)
{
    uint64_t clipped[4] = {0, 0, 0, 0}, outside = 0, wrong_piece = 0, refused = 0;
    for (uint64_t n = 0; n < cases; n++) {
        gn_view view;
        gn_place corner[3];
        gn_polygon polygon;
        int kind = between(0, 3);
        gn_status status = random_view(&view, kind, between(16, 640), between(16, 640));
        for (int i = 0; i < 3 && status == GN_OK; i++) {
            int32_t reach = 1 << between(8, 22);
            int32_t p[3] = {between(-reach, reach), between(-reach, reach), between(-reach, reach)};
            status = gn_view_place(&view, p, &corner[i]);
        }
        if (status != GN_OK) {
            refused++;
            continue;
        }
        gn_clip_triangle(&polygon, &view, corner);
        clipped[kind] += polygon.count > 3;
        outside += !stays_inside(&view, &polygon, kind);
        wrong_piece += !has_its_largest_piece(&polygon);
    }
    ok(!outside, "clipped polygons lie within the guard band and the depths");
    ok(!wrong_piece, "the largest piece is found");
    ok(clipped[0] > cases / 50 && clipped[1] > cases / 50 && clipped[2] > cases / 50 && clipped[3] > cases / 50 &&
           refused < cases / 10,
       "%llu, %llu, %llu and %llu were cut, by kind of view; %llu refused", (unsigned long long)clipped[0],
       (unsigned long long)clipped[1], (unsigned long long)clipped[2], (unsigned long long)clipped[3],
       (unsigned long long)refused);
}

/* One corner in the near plane, one inside, one far to the right: cut there alone, between the last two and the last
 * and the first, four corners are left, the first where it was. */
static void a_corner_in_a_plane_is_kept(void)
{
    gn_camera camera;
    gn_view view;
    gn_polygon polygon;
    static const int32_t eye[3] = {0, 0, 0}, target[3] = {0, 0, -1}, up[3] = {0, 1, 0};
    memset(&camera, 0, sizeof camera);
    gn_status status = gn_look_at(&camera, eye, target, up);
    if (status == GN_OK)
        status = gn_perspective(&camera, GN_DEGREES(90), 1000, 100000);
    if (status == GN_OK)
        status = gn_make_camera_view(&view, &camera, 64, 64);
    const gn_place corner[3] = {{{0, 0, view.near_w}},
                                {{0, 2 * (int64_t)view.near_w, 4 * (int64_t)view.near_w}},
                                {{64 * (int64_t)view.near_w, 0, 4 * (int64_t)view.near_w}}};
    gn_clip_triangle(&polygon, &view, corner);
    /* 3/32 of a right angle's tangent down in the middle, the guard band at 7 */
    ok(status == GN_OK && polygon.count == 4, "a corner in the near plane is kept: %d corners", (int)polygon.count);
    ok(polygon.v[0].x == 32 * 256 && polygon.v[0].y == 32 * 256 && polygon.v[1].x == 32 * 256 &&
           polygon.v[1].y == 48 * 256,
       "it and the one inside stay where they were");
}

/* ---- planes of Q ----------------------------------------------------------------------------------------------- */

typedef struct lowest {
    gn_q_plane plane;
    uint64_t ends, below;
    uint32_t least;
} lowest;

GN_INLINE void check_least(const void *state, int32_t row, int32_t left, int32_t right)
{
    lowest *l = *(lowest *const *)state;
    int32_t ends[2] = {left, right - 1};
    for (int i = 0; i < 2; i++) {
        uint64_t q = l->plane.base + (uint64_t)ends[i] * l->plane.dx + (uint64_t)row * l->plane.dy;
        l->ends++;
        l->below += (uint32_t)(q >> 32) + 64 < l->least || q >> 63;
    }
}

/* A clipped triangle ends in the far plane, whose Q is the least that a surface may have. The bound of 64 units is for
 * the gradients, which the fit takes with 10 fraction bits over 2^13 pixels at most. */
static void planes_of_clipped_triangles_keep_the_least_q(uint64_t cases)
{
    lowest l, *state = &l;
    uint64_t polygons = 0, moved = 0;
    memset(&l, 0, sizeof l);
    for (uint64_t n = 0; n < cases; n++) {
        gn_view view;
        gn_place corner[3];
        gn_polygon polygon;
        int kind = between(0, 1);
        gn_status status = random_view(&view, kind, 512, 512);
        for (int i = 0; i < 3 && status == GN_OK; i++) {
            int32_t p[3] = {between(-400000, 400000), between(-400000, 400000), between(-400000, 20000)};
            status = gn_view_place(&view, p, &corner[i]);
        }
        if (status != GN_OK)
            continue;
        gn_clip_triangle(&polygon, &view, corner);
        if (!polygon.area)
            continue;
        const gn_vertex *v = polygon.v, *r1 = &v[polygon.reference], *r2 = r1 + 1;
        gn_window image = {0, 0, 512, 512};
        /* of the far plane, less the 64th that gn_shading.c leaves */
        uint32_t far_q = (uint32_t)(((uint64_t)view.near_w << 30) / (uint32_t)view.far_w);
        l.least = kind ? 1 << 10 : far_q - far_q / 64;
        polygons++;
        gn_make_q_plane(&l.plane, &v[0], polygon.area > 0 ? r1 : r2, polygon.area > 0 ? r2 : r1, polygon.area);
        uint64_t base = l.plane.base;
        gn_fit_q_plane(&l.plane, &polygon, l.least);
        moved += l.plane.base != base;
        for (int i = 1; i + 1 < polygon.count; i++) {
            int64_t area = gn_area(&v[0], &v[i], &v[i + 1]);
            gn_rows rows;
            if (area && (area > 0) == (polygon.area > 0) &&
                gn_find_rows(&rows, &v[0], area > 0 ? &v[i] : &v[i + 1], area > 0 ? &v[i + 1] : &v[i], &image))
                gn_walk(&rows, &image, rows.cut, check_least, &state);
        }
    }
    ok(!l.below, "no pixel of a clipped triangle falls below the least Q: %llu ends of rows, %llu do",
       (unsigned long long)l.ends, (unsigned long long)l.below);
    ok(polygons > cases / 10 && moved > 10, "%llu of %llu triangles were moved", (unsigned long long)moved,
       (unsigned long long)polygons);
}

int main(int argc, char **argv)
{
    uint64_t cases = tap_cases(argc, argv, 200000);
    crossings_do_not_depend_on_who_asks(cases);
    a_corner_in_a_plane_is_kept();
    polygons_stay_inside(cases);
    planes_of_clipped_triangles_keep_the_least_q(cases / 4);
    return tap_done();
}
