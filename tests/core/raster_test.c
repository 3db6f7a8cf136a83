/* The raster covers every pixel centre exactly once where triangles share edges: fragments counted over random meshes
 * and held against the top-left rule in 64-bit edge functions. Half of the meshes have vertices on pixel centres, so
 * that centres lie on edges and corners. Meshes: a triangle split again and again at integer points inside it or on its
 * border, which is a partition whatever the slivers. Cases: 4000 meshes, or GNOMON_CASES. */
#if defined __GNUC__ && !defined GN_VECTOR
#define GN_VECTOR 1 /* the tiny walks, in every build: the compiler lowers what the machine lacks */
#pragma GCC diagnostic ignored "-Wpsabi"
#endif
#include "gn_clip.h"
#include "tap.h"

#include <string.h>

static uint64_t random_state = 1;

static int32_t between(int32_t low, int32_t high)
{
    return low + (int32_t)(tap_random(&random_state) % (uint64_t)((int64_t)high - low + 1));
}

typedef struct triangle {
    gn_vertex v[3];
} triangle;

static int64_t area_of(const triangle *t)
{
    const gn_vertex *v = t->v;
    return (int64_t)(v[1].x - v[0].x) * (v[2].y - v[0].y) - (int64_t)(v[2].x - v[0].x) * (v[1].y - v[0].y);
}

static void show(const triangle *t)
{
    note("triangle (%d, %d) (%d, %d) (%d, %d), 1/256 pixel", (int)t->v[0].x, (int)t->v[0].y, (int)t->v[1].x,
         (int)t->v[1].y, (int)t->v[2].x, (int)t->v[2].y);
}

static triangle clockwise(triangle t)
{
    if (area_of(&t) < 0) {
        gn_vertex v = t.v[1];
        t.v[1] = t.v[2];
        t.v[2] = v;
    }
    return t;
}

/* ---- the rule, in 64 bits -------------------------------------------------------------------------------------- */

/* Does a clockwise triangle own the centre of (column, row)? Centres on top and left edges are inside. */
static int owns(const triangle *t, int32_t column, int32_t row)
{
    int64_t px = 256 * (int64_t)column + 128, py = 256 * (int64_t)row + 128;
    for (int i = 0; i < 3; i++) {
        const gn_vertex *a = &t->v[i], *b = &t->v[(i + 1) % 3];
        int64_t dx = b->x - a->x, dy = b->y - a->y, e = dx * (py - a->y) - dy * (px - a->x);
        int top_or_left = dy < 0 || (dy == 0 && dx > 0);
        if (e < 0 || (e == 0 && !top_or_left))
            return 0;
    }
    return 1;
}

static int64_t ceiling(int64_t n, int64_t d)
{
    int64_t q = n / d;
    return q + (n % d > 0);
}

/* The columns [*left, *right) that the rule gives a clockwise triangle on a row: each edge leaves a half-line. */
static void span_of(const triangle *t, int32_t row, int64_t *left, int64_t *right)
{
    int64_t py = 256 * (int64_t)row + 128;
    *left = -100000, *right = 100000;
    for (int i = 0; i < 3; i++) {
        const gn_vertex *a = &t->v[i], *b = &t->v[(i + 1) % 3];
        int64_t dx = b->x - a->x, dy = b->y - a->y;
        if (dy == 0) {
            int64_t e = dx * (py - a->y);
            if (e < 0 || (e == 0 && dx < 0))
                *right = *left;
            continue;
        }
        /* 256 c + 128 >= x for left edges, < x for right ones: both are c >= or < ceil((x - 128) / 256) */
        int64_t d = dy < 0 ? -dy : dy, n = (a->x - 128) * d + (dy < 0 ? -dx : dx) * (py - a->y);
        int64_t column = ceiling(n, 256 * d);
        if (dy < 0)
            *left = column > *left ? column : *left;
        else
            *right = column < *right ? column : *right;
    }
}

/* ---- fragments of the walks ------------------------------------------------------------------------------------ */

typedef struct counter {
    int32_t *count; /* of window pixels, row by row */
    gn_window whole, window;
    int32_t sign;
    int64_t *fragments;
    int *outside; /* a span left the window or its order */
} counter;

static void count_pixel(const counter *c, int32_t row, int32_t column)
{
    if (row < c->window.row0 || row >= c->window.row1 || column < c->window.column0 || column >= c->window.column1) {
        *c->outside = 1;
        return;
    }
    ++*c->fragments;
    if (c->count)
        c->count[(row - c->whole.row0) * (c->whole.column1 - c->whole.column0) + column - c->whole.column0] += c->sign;
}

GN_INLINE void count_span(const void *state, int32_t row, int32_t left, int32_t right)
{
    const counter *c = state;
    if (left >= right)
        *c->outside = 1;
    for (int32_t column = left; column < right; column++)
        count_pixel(c, row, column);
}

#if GN_VECTOR
GN_INLINE void count_tiny_16(const void *state, int32_t row, int32_t column, gn_i32x16 outside)
{
    for (int32_t i = 0; i < 16; i++)
        if (outside[i] >= 0)
            count_pixel(state, row, column + i);
}

GN_INLINE void count_tiny_8(const void *state, int32_t row, int32_t column, gn_i32x8 outside)
{
    for (int32_t i = 0; i < 8; i++)
        if (outside[i] >= 0)
            count_pixel(state, row, column + i);
}
#endif

typedef enum walk { SPANS, SPANS_ALWAYS_CUT, TINY_16, TINY_8, WALKS } walk;
static const char *const walk_names[] = {"gn_walk", "gn_walk, always cut", "gn_walk_tiny_16", "gn_walk_tiny_8"};

/* The walk's name is a promise for triangles of any size: the tiny ones leave larger ones to gn_walk. *tiny counts what
 * they took. */
static void walk_triangle(const counter *c, const triangle *t, walk how, uint64_t *tiny)
{
    gn_rows rows;
    int taken = 0;
    if (!gn_find_rows(&rows, &t->v[0], &t->v[1], &t->v[2], &c->window))
        return;
#if GN_VECTOR
    if (how == TINY_16)
        taken = gn_walk_tiny_16(&rows, &c->window, count_tiny_16, c);
    if (how == TINY_8)
        taken = gn_walk_tiny_8(&rows, &c->window, count_tiny_8, c);
#endif
    *tiny += (uint64_t)taken;
    if (!taken)
        gn_walk(&rows, &c->window, how == SPANS_ALWAYS_CUT ? 1 : rows.cut, count_span, c);
}

/* ---- meshes ---------------------------------------------------------------------------------------------------- */

enum { MOST = 400 };

typedef struct mesh {
    triangle root, t[MOST];
    int count;
} mesh;

static gn_vertex snapped(int64_t x, int64_t y, int half_pixels)
{
    gn_vertex v = {(int32_t)x, (int32_t)y, 0};
    if (half_pixels) {
        v.x = v.x / 128 * 128;
        v.y = v.y / 128 * 128;
    }
    return v;
}

/* A clockwise triangle within +-reach of (x, y), split at points of its triangles. */
static void make_mesh(mesh *m, int32_t x, int32_t y, int32_t reach, int splits)
{
    int half_pixels = between(0, 1);
    do {
        for (int i = 0; i < 3; i++)
            m->root.v[i] = snapped(x + between(-reach, reach), y + between(-reach, reach), half_pixels);
        if (between(0, 7) == 0) /* a sliver */
            m->root.v[2] = snapped(m->root.v[1].x + between(-300, 300), m->root.v[1].y + between(-300, 300), 0);
    } while (area_of(&m->root) == 0);
    m->root = clockwise(m->root);
    m->t[0] = m->root;
    m->count = 1;
    for (int i = 0; i < splits && m->count + 2 <= MOST; i++) {
        triangle *t = &m->t[between(0, m->count - 1)], old = *t;
        int32_t a = between(0, 1000), b = between(0, 1000 - a);
        if (between(0, 3) == 0)
            b = 1000 - a; /* on an edge, or nearly */
        int64_t px =
            old.v[0].x + ((int64_t)a * (old.v[1].x - old.v[0].x) + (int64_t)b * (old.v[2].x - old.v[0].x)) / 1000;
        int64_t py =
            old.v[0].y + ((int64_t)a * (old.v[1].y - old.v[0].y) + (int64_t)b * (old.v[2].y - old.v[0].y)) / 1000;
        gn_vertex p = snapped(px, py, half_pixels);
        triangle part[3] = {{{old.v[0], old.v[1], p}}, {{old.v[1], old.v[2], p}}, {{old.v[2], old.v[0], p}}};
        if (area_of(&part[0]) < 0 || area_of(&part[1]) < 0 || area_of(&part[2]) < 0)
            continue; /* rounded to the outside */
        *t = part[0];
        m->t[m->count++] = part[1];
        m->t[m->count++] = part[2];
    }
}

/* ---- promises -------------------------------------------------------------------------------------------------- */

enum { SIZE = 64 };

/* Windows cut the screen in regions, which may not change a pixel. */
static int cut_in_regions(gn_window *regions, const gn_window *screen, int cut)
{
    int count = 0;
    int32_t width = cut ? between(1, SIZE) : SIZE, height = cut ? between(1, SIZE) : SIZE;
    for (int32_t y = screen->row0; y < screen->row1; y += height)
        for (int32_t x = screen->column0; x < screen->column1; x += width) {
            gn_window r = {x, y, x + width < screen->column1 ? x + width : screen->column1,
                           y + height < screen->row1 ? y + height : screen->row1};
            if (count < 64)
                regions[count++] = r;
            else
                regions[63] = *screen; /* too many: never reached with the sizes below */
        }
    return count;
}

static void shared_edges_cover_each_centre_once(uint64_t cases)
{
    static int32_t count[SIZE * SIZE];
    static mesh m;
    uint64_t covered = 0, empty = 0, on_edge = 0, tiny[WALKS] = {0};
    unsigned failures = 0;
    for (uint64_t n = 0; n < cases && failures < 5; n++) {
        int32_t reach = 256 << between(0, 8); /* 1 pixel to beyond the guard band of a small screen */
        make_mesh(&m, between(0, 256 * SIZE), between(0, 256 * SIZE), reach, between(0, 60));
        walk how = (walk)(n % WALKS);
        gn_window screen = {0, 0, SIZE, SIZE}, regions[64];
        int64_t fragments = 0;
        int outside = 0, region_count = 0;
        do
            region_count = cut_in_regions(regions, &screen, (int)(n / WALKS & 1));
        while (region_count >= 63);
        memset(count, 0, sizeof count);
        for (int i = 0; i < m.count; i++) {
            if (area_of(&m.t[i]) == 0)
                continue;
            for (int r = 0; r < region_count; r++) {
                counter c = {count, screen, regions[r], 1, &fragments, &outside};
                walk_triangle(&c, &m.t[i], how, &tiny[how]);
            }
        }
        for (int32_t row = 0; row < SIZE; row++) {
            for (int32_t column = 0; column < SIZE; column++) {
                int expected = owns(&m.root, column, row), got = count[row * SIZE + column];
                covered += (uint64_t)expected;
                empty += !expected;
                if (got != expected && failures++ < 5) {
                    note("mesh %llu, %s, pixel (%d, %d): covered %d times, expected %d", (unsigned long long)n,
                         walk_names[how], (int)column, (int)row, got, expected);
                    show(&m.root);
                    for (int i = 0; i < m.count; i++)
                        if (area_of(&m.t[i]) && owns(&m.t[i], column, row))
                            show(&m.t[i]);
                }
            }
        }
        if (outside && failures++ < 5) {
            note("mesh %llu, %s: a span outside its window, or empty", (unsigned long long)n, walk_names[how]);
            show(&m.root);
        }
        for (int i = 0; i < m.count; i++)
            on_edge += m.t[i].v[0].x % 256 == 128 && m.t[i].v[0].y % 256 == 128;
    }
    ok(!failures, "every centre is covered once by meshes with shared edges, in %llu meshes",
       (unsigned long long)cases);
    ok(covered > 1000 && empty > 1000 && on_edge > 100, "covered and empty centres and corners on centres were met");
#if GN_VECTOR
    ok(tiny[TINY_16] > 100 && tiny[TINY_8] > 100, "the walks for tiny triangles took some");
#endif
    note("%llu covered, %llu empty centres; %llu corners on centres; tiny: %llu, %llu", (unsigned long long)covered,
         (unsigned long long)empty, (unsigned long long)on_edge, (unsigned long long)tiny[TINY_16],
         (unsigned long long)tiny[TINY_8]);
}

/* Spans of one triangle against half-lines, row by row. */
typedef struct expectation {
    const triangle *t;
    gn_window window;
    int32_t next_row; /* rows before it are done */
    uint64_t spans;
    unsigned failures;
} expectation;

static void expected_span(const expectation *e, int32_t row, int64_t *left, int64_t *right)
{
    span_of(e->t, row, left, right);
    *left = *left < e->window.column0 ? e->window.column0 : *left;
    *right = *right > e->window.column1 ? e->window.column1 : *right;
}

static void no_spans_before(expectation *e, int32_t row)
{
    for (; e->next_row < row; e->next_row++) {
        int64_t left, right;
        expected_span(e, e->next_row, &left, &right);
        if (left < right && e->failures++ < 3) {
            note("row %d: no span, expected [%lld, %lld)", (int)e->next_row, (long long)left, (long long)right);
            show(e->t);
        }
    }
}

GN_INLINE void compare_span(const void *state, int32_t row, int32_t left, int32_t right)
{
    expectation *e = *(expectation *const *)state;
    int64_t l, r;
    no_spans_before(e, row);
    expected_span(e, row, &l, &r);
    e->spans++;
    if ((row != e->next_row || l != left || r != right) && e->failures++ < 3) {
        note("row %d: span [%d, %d), expected [%lld, %lld)", (int)row, (int)left, (int)right, (long long)l,
             (long long)r);
        show(e->t);
    }
    e->next_row = row + 1;
}

/* Maps of 4096 x 4096, vertices as far as 2^20 from its centre. */
static void spans_are_exact_to_the_limits(uint64_t cases)
{
    static mesh m;
    const int32_t size = 4096, centre = 128 * size, limit = 1 << 20;
    uint64_t spans = 0, at_limit = 0;
    unsigned failures = 0;
    for (uint64_t n = 0; n < cases && failures < 5; n++) {
        make_mesh(&m, centre, centre, limit, 0);
        triangle t = m.root;
        for (int i = 0; i < 3; i++) { /* corners of the range, and the same row or column again */
            int what = between(0, 9);
            if (what == 0)
                t.v[i].x = centre + (between(0, 1) ? limit : -limit);
            if (what <= 1)
                t.v[i].y = centre + (between(0, 1) ? limit : -limit);
            if (what == 2)
                t.v[i].y = t.v[(i + 1) % 3].y + between(-1, 1);
            if (what == 3)
                t.v[i].x = t.v[(i + 1) % 3].x + between(-1, 1);
            at_limit += t.v[i].x == centre + limit || t.v[i].x == centre - limit;
            if (t.v[i].x > centre + limit || t.v[i].x < centre - limit)
                t.v[i].x = centre;
            if (t.v[i].y > centre + limit || t.v[i].y < centre - limit)
                t.v[i].y = centre;
        }
        if (area_of(&t) == 0)
            continue;
        t = clockwise(t);
        gn_window window = {0, 0, size, size};
        if (n & 1) {
            window.column0 = between(0, size - 1);
            window.column1 = between(window.column0 + 1, size);
            window.row0 = between(0, size - 1);
            window.row1 = between(window.row0 + 1, window.row0 + 300 < size ? window.row0 + 300 : size);
        }
        expectation e = {&t, window, window.row0, 0, 0}, *state = &e;
        gn_rows rows;
        if (gn_find_rows(&rows, &t.v[0], &t.v[1], &t.v[2], &window))
            gn_walk(&rows, &window, rows.cut, compare_span, &state);
        no_spans_before(&e, window.row1);
        spans += e.spans;
        failures += e.failures;
    }
    ok(!failures, "spans are exact on maps of 4096 with vertices 2^20 from the centre, in %llu triangles",
       (unsigned long long)cases);
    ok(spans > 10000 && at_limit > 10, "%llu spans were met, %llu vertices at the limit", (unsigned long long)spans,
       (unsigned long long)at_limit);
}

static void the_reference_agrees_with_itself(void)
{
    static mesh m;
    unsigned failures = 0;
    for (int n = 0; n < 300; n++) {
        make_mesh(&m, 256 * 16, 256 * 16, 256 * between(1, 30), 0);
        for (int32_t row = 0; row < 32; row++) {
            int64_t left, right;
            span_of(&m.root, row, &left, &right);
            for (int32_t column = 0; column < 32; column++)
                failures += owns(&m.root, column, row) != (column >= left && column < right);
        }
    }
    ok(!failures, "edge functions and half-lines are the same rule");
}

/* By hand: a square of two pixels whose corners are centres owns its upper left quarter only. */
static void a_square_on_centres_owns_top_and_left(void)
{
    int32_t count[16] = {0}, expected[16] = {0};
    int64_t fragments = 0;
    int outside = 0;
    uint64_t tiny = 0;
    gn_window screen = {0, 0, 4, 4};
    gn_vertex a = {128, 128, 0}, b = {640, 128, 0}, c = {640, 640, 0}, d = {128, 640, 0};
    triangle halves[2] = {{{a, b, c}}, {{a, c, d}}};
    expected[0] = expected[1] = expected[4] = expected[5] = 1;
    for (int how = 0; how < WALKS; how++) {
        memset(count, 0, sizeof count);
        for (int i = 0; i < 2; i++) {
            counter k = {count, screen, screen, 1, &fragments, &outside};
            walk_triangle(&k, &halves[i], (walk)how, &tiny);
        }
        ok(!memcmp(count, expected, sizeof count) && !outside, "%s: a square on centres owns its top and left",
           walk_names[how]);
    }
}

static void degenerate_triangles_have_no_area(void)
{
    unsigned failures = 0;
    for (int i = 0; i < 1000; i++) {
        int32_t x = between(-1048576, 1048576), y = between(-1048576, 1048576);
        int32_t dx = between(-1000, 1000), dy = between(-1000, 1000), k = between(-1000, 1000);
        gn_vertex a = {x, y, 0}, b = {x + dx, y + dy, 0}, c = {x + k * dx, y + k * dy, 0};
        failures += gn_area(&a, &b, &c) != 0 || gn_area(&a, &a, &b) != 0 || gn_area(&a, &b, &b) != 0;
    }
    ok(!failures, "edge-on and collapsed triangles have an area of exactly 0");
    gn_vertex a = {0, 0, 0}, b = {100, 0, 0}, c = {100, 100, 0}, far = {-(1 << 21) + 1, 0, 0},
              right = {(1 << 21) - 1, 0, 0}, below = {0, (1 << 21) - 1, 0};
    ok(gn_area(&a, &b, &c) == 10000 && gn_area(&a, &c, &b) == -10000, "clockwise on the screen is a positive area");
    ok(gn_area(&far, &right, &below) == INT64_C(4194302) * 2097151, "the largest areas do not overflow");
}

/* ---- clipped triangles ----------------------------------------------------------------------------------------- */

typedef struct clip_counter {
    gn_view view;
    int32_t signed_count[SIZE * SIZE]; /* pieces of the fan: clockwise +1, else -1 */
    int32_t drawn[SIZE * SIZE];        /* as the passes draw them: pieces turned over by rounding are left out */
    int32_t cap[SIZE * SIZE];          /* what closes the mesh in the near and far planes */
    uint32_t near_depth, far_depth;    /* as projected in these planes */
    uint64_t clipped, pieces, turned;
} clip_counter;

static void add_triangle(int32_t *count, const gn_vertex *a, const gn_vertex *b, const gn_vertex *c, int32_t sign)
{
    triangle t = {{*a, *b, *c}};
    int64_t fragments = 0, area = area_of(&t);
    int outside = 0;
    uint64_t tiny = 0;
    gn_window screen = {0, 0, SIZE, SIZE};
    counter k = {count, screen, screen, area > 0 ? sign : -sign, &fragments, &outside};
    if (area == 0)
        return;
    t = clockwise(t);
    walk_triangle(&k, &t, SPANS, &tiny);
}

static uint32_t depth_in_plane(const gn_view *view, int32_t w)
{
    gn_place p = {{0, 0, 0}};
    gn_vertex v;
    p.c[2] = w;
    gn_view_project_inside(view, &p, &v);
    return v.depth;
}

static void add_clipped(clip_counter *k, const gn_place corner[3])
{
    gn_vertex v[3];
    gn_polygon polygon;
    int needs = 0;
    for (int i = 0; i < 3; i++) {
        gn_view_project(&k->view, &corner[i], &v[i]);
        needs |= v[i].depth == 0;
    }
    if (!needs) {
        add_triangle(k->signed_count, &v[0], &v[1], &v[2], 1);
        add_triangle(k->drawn, &v[0], &v[1], &v[2], gn_area(&v[0], &v[1], &v[2]) > 0 ? 1 : -1);
        return;
    }
    k->clipped++;
    gn_clip_triangle(&polygon, &k->view, corner);
    for (int32_t i = 1; i + 1 < polygon.count; i++) {
        const gn_vertex *a = &polygon.v[0], *b = &polygon.v[i], *c = &polygon.v[i + 1];
        int64_t area = gn_area(a, b, c);
        k->pieces++;
        add_triangle(k->signed_count, a, b, c, 1);
        if (area && polygon.area && (area > 0) == (polygon.area > 0))
            add_triangle(k->drawn, a, b, c, area > 0 ? 1 : -1);
        else if (area)
            k->turned++;
    }
    /* Edges in the near and far planes belong to no neighbour: close them towards the screen's corner. */
    gn_vertex apex = {0, 0, 0};
    for (int32_t i = 0; i < polygon.count; i++) {
        const gn_vertex *a = &polygon.v[i], *b = &polygon.v[(i + 1) % polygon.count];
        if ((a->depth == k->near_depth && b->depth == k->near_depth) ||
            (a->depth == k->far_depth && b->depth == k->far_depth))
            add_triangle(k->cap, &apex, b, a, 1);
    }
}

static gn_camera random_camera(int orthographic, int32_t near_depth, int32_t far_depth)
{
    gn_camera camera;
    int32_t eye[3], target[3], up[3] = {0, 1, 0};
    memset(&camera, 0, sizeof camera);
    do {
        for (int i = 0; i < 3; i++) {
            eye[i] = between(-20000, 20000);
            target[i] = between(-20000, 20000);
        }
    } while (gn_look_at(&camera, eye, target, up) != GN_OK);
    gn_status status = orthographic ? gn_orthographic(&camera, between(300, 30000), near_depth, far_depth)
                                    : gn_perspective(&camera, GN_DEGREES(between(5, 150)), near_depth, far_depth);
    if (status != GN_OK)
        note("no camera: %d", (int)status);
    return camera;
}

/* Between the near and the far plane, on the screen or as far as four times the guard band. */
static gn_place beyond_the_guard_band(const gn_view *view)
{
    gn_place p;
    p.c[2] = between(view->near_w, view->far_w);
    int64_t reach = view->affine ? 4 * GN_MAX_COORDINATE : 4 * (int64_t)view->guard * p.c[2];
    reach = reach > (1 << 30) ? 1 << 30 : reach;
    reach >>= between(0, 5);
    p.c[0] = between((int32_t)-reach, (int32_t)reach);
    p.c[1] = between((int32_t)-reach, (int32_t)reach);
    return p;
}

/* On either side of the near and the far plane, where no edge between them leaves the guard band. */
static gn_place beyond_near_and_far(const gn_view *view)
{
    gn_place p;
    int64_t reach = view->affine ? GN_MAX_COORDINATE : (int64_t)view->guard * view->near_w;
    reach >>= between(0, 3);
    p.c[0] = between((int32_t)-reach, (int32_t)reach);
    p.c[1] = between((int32_t)-reach, (int32_t)reach);
    p.c[2] = between(0, 1) ? between(view->near_w / 2, 2 * view->near_w) : between(-(1 << 29), 1 << 29);
    return p;
}

/* Closed meshes have as many clockwise as counter-clockwise fragments everywhere, once what the near and far planes
 * opened is closed again. A crack or an overlap along any edge, clipped or not, would show as a count other than 0. */
static void clipped_closed_meshes_have_no_cracks(uint64_t cases)
{
    static const int faces[8][3] = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4},
                                    {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
    static clip_counter k;
    uint64_t clipped = 0, pieces = 0, turned = 0, covered = 0;
    unsigned failures = 0;
    for (uint64_t n = 0; n < cases && failures < 5; n++) {
        memset(&k, 0, sizeof k);
        int orthographic = n % 4 == 3;
        gn_camera camera = random_camera(orthographic, between(500, 5000), between(8000, 30000));
        gn_status status = gn_make_camera_view(&k.view, &camera, SIZE, SIZE);
        gn_place place[6];
        k.near_depth = depth_in_plane(&k.view, k.view.near_w);
        k.far_depth = depth_in_plane(&k.view, k.view.far_w);
        for (int i = 0; i < 6; i++)
            place[i] = n & 1 ? beyond_near_and_far(&k.view) : beyond_the_guard_band(&k.view);
        if (status != GN_OK) {
            note("mesh %llu: status %d", (unsigned long long)n, (int)status);
            failures++;
            continue;
        }
        for (int i = 0; i < 8; i++) {
            gn_place corner[3] = {place[faces[i][0]], place[faces[i][1]], place[faces[i][2]]};
            add_clipped(&k, corner);
        }
        for (int i = 0; i < SIZE * SIZE; i++) {
            covered += k.drawn[i] != 0;
            if (k.signed_count[i] + k.cap[i] != 0 && failures++ < 5)
                note("mesh %llu, %s camera, pixel (%d, %d): %d more clockwise than other fragments, expected %d",
                     (unsigned long long)n, orthographic ? "orthographic" : "perspective", i % SIZE, i / SIZE,
                     (int)k.signed_count[i], -(int)k.cap[i]);
        }
        clipped += k.clipped;
        pieces += k.pieces;
        turned += k.turned;
    }
    ok(!failures, "clipped closed meshes have neither cracks nor overlaps, in %llu meshes", (unsigned long long)cases);
    ok(clipped > cases && covered > 1000, "%llu triangles were clipped, to %llu pieces (%llu turned over by rounding)",
       (unsigned long long)clipped, (unsigned long long)pieces, (unsigned long long)turned);
}

/* A floor of many triangles under a camera that looks down at it: through the near plane, the far plane and the guard
 * band. All of the image lies inside the floor, so each centre sees it once. */
static void a_clipped_floor_covers_each_centre_once(uint64_t cases)
{
    static clip_counter k;
    static mesh m;
    uint64_t clipped = 0, turned = 0;
    unsigned failures = 0;
    for (uint64_t n = 0; n < cases && failures < 5; n++) {
        memset(&k, 0, sizeof k);
        /* eye high above, small field of view, tilted: no horizon; a floor far larger than what is seen */
        int32_t height = between(2000, 20000), tilt = between(-height, height);
        int32_t eye[3] = {between(-9999, 9999), height, between(-9999, 9999)};
        int32_t target[3] = {eye[0] + tilt / 2, 0, eye[2] + tilt}, up[3] = {1, 0, 0};
        gn_camera camera;
        memset(&camera, 0, sizeof camera);
        gn_status status = gn_look_at(&camera, eye, target, up);
        if (status == GN_OK)
            status = gn_perspective(&camera, GN_DEGREES(between(5, 30)), between(500, 1500), 1000000);
        if (status == GN_OK)
            status = gn_make_camera_view(&k.view, &camera, SIZE, SIZE);
        make_mesh(&m, 0, 0, 30000, 0);
        m.root.v[0].x = -4000000, m.root.v[0].y = -3000000;
        m.root.v[1].x = 4000000, m.root.v[1].y = -3000000;
        m.root.v[2].x = 0, m.root.v[2].y = 5000000;
        m.t[0] = m.root;
        int wanted = between(1, 120);
        while (m.count < wanted) { /* split strictly inside, mostly near the middle; z is v.y */
            triangle *t = &m.t[between(0, m.count - 1)], old = *t;
            int64_t a = between(1, 998), b = between(1, 999 - (int32_t)a);
            gn_vertex p = {
                (int32_t)(old.v[0].x + (a * (old.v[1].x - old.v[0].x) + b * (old.v[2].x - old.v[0].x)) / 1000),
                (int32_t)(old.v[0].y + (a * (old.v[1].y - old.v[0].y) + b * (old.v[2].y - old.v[0].y)) / 1000), 0};
            triangle part[3] = {{{old.v[0], old.v[1], p}}, {{old.v[1], old.v[2], p}}, {{old.v[2], old.v[0], p}}};
            if (area_of(&part[0]) <= 0 || area_of(&part[1]) <= 0 || area_of(&part[2]) <= 0) {
                wanted--;
                continue;
            }
            *t = part[0];
            m.t[m.count++] = part[1];
            m.t[m.count++] = part[2];
        }
        for (int i = 0; i < m.count && status == GN_OK; i++) {
            gn_place corner[3];
            for (int j = 0; j < 3; j++) {
                int32_t world[3] = {m.t[i].v[j].x, 0, m.t[i].v[j].y};
                if (status == GN_OK)
                    status = gn_view_place(&k.view, world, &corner[j]);
            }
            add_clipped(&k, corner);
        }
        if (status != GN_OK) {
            note("floor %llu: status %d", (unsigned long long)n, (int)status);
            failures++;
            continue;
        }
        int32_t facing = k.signed_count[0];
        for (int i = 0; i < SIZE * SIZE; i++)
            if ((k.signed_count[i] != facing || (facing != 1 && facing != -1) || k.drawn[i] < 1) && failures++ < 5)
                note("floor %llu, pixel (%d, %d): %d fragments counted by orientation, expected 1 or -1; %d drawn",
                     (unsigned long long)n, i % SIZE, i / SIZE, (int)k.signed_count[i], (int)k.drawn[i]);
        clipped += k.clipped;
        turned += k.turned;
    }
    ok(!failures, "a clipped floor covers each centre once, in %llu floors", (unsigned long long)cases);
    ok(clipped > cases, "%llu triangles were clipped (%llu pieces turned over by rounding)",
       (unsigned long long)clipped, (unsigned long long)turned);
}

int main(int argc, char **argv)
{
    uint64_t cases = tap_cases(argc, argv, 4000);
    the_reference_agrees_with_itself();
    a_square_on_centres_owns_top_and_left();
    degenerate_triangles_have_no_area();
    shared_edges_cover_each_centre_once(cases);
    spans_are_exact_to_the_limits(cases);
    clipped_closed_meshes_have_no_cracks(cases);
    a_clipped_floor_covers_each_centre_once(cases / 8);
    return tap_done();
}
