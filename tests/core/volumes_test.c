/* Shadow volumes where random scenes hardly ever go: sides and surfaces seen all but edge-on, whose nearness at a
 * pixel's centre lies far outside that of their corners; edges between a triangle that a spot light's near plane cuts
 * and one that it does not; a triangle in that plane. Each scene is made so that all pixels of its first object have
 * one answer. Cases: 4000 scenes of a kind, or GNOMON_CASES. */
#include "scenes.h"

#include <math.h>

typedef long double real;

enum { SIDE = 64, MOST_EDGES = 600 };

/* ---- edges ----------------------------------------------------------------------------------------------------- */

typedef struct edges {
    gn_mesh_edge list[MOST_EDGES];
} edges;

static uint32_t half_edge_end(const shape *s, uint32_t half, int end)
{
    return s->indices[end ? half - half % 3 + (half + 1) % 3 : half];
}

/* The edges of a shape in which no edge has more than two triangles and all wind alike. */
static void add_edges(shape *s, edges *e)
{
    uint32_t count = 0;
    for (uint32_t a = 0; a < 3 * s->mesh.triangle_count; a++) {
        uint32_t other = GN_NO_HALF_EDGE;
        for (uint32_t b = 0; b < 3 * s->mesh.triangle_count; b++)
            if (half_edge_end(s, b, 0) == half_edge_end(s, a, 1) && half_edge_end(s, b, 1) == half_edge_end(s, a, 0))
                other = b;
        if (other > a && count < MOST_EDGES) {
            e->list[count].half[0] = a;
            e->list[count++].half[1] = other;
        }
    }
    s->mesh.edges = e->list;
    s->mesh.edge_count = count;
}

/* ---- frames ---------------------------------------------------------------------------------------------------- */

/* Two objects: red, whose pixels are asked for, and blue. */
typedef struct stage {
    shape shapes[2];
    edges edges[2];
    gn_object objects[2];
    gn_scene scene;
    gn_camera camera;
    gn_light light;
    frame f;
} stage;

static void begin(stage *s)
{
    memset(s, 0, sizeof *s);
    for (int i = 0; i < 2; i++) {
        s->shapes[i] = shape_new(0);
        s->objects[i].mesh = &s->shapes[i].mesh;
    }
    s->objects[0].colour.r = 255;
    s->objects[1].colour.b = 255;
    s->scene.objects = s->objects;
    s->scene.object_count = 2;
    s->scene.ambient = 32768;
}

/* The first object's pixels are painted red, lit or not. */
static gn_status render(stage *s)
{
    gn_settings settings = gn_default_settings(SIDE, SIDE, SIDE);
    settings.shadow = GN_SHADOW_VOLUMES;
    settings.mask = 1;
    for (int i = 0; i < 2; i++)
        add_edges(&s->shapes[i], &s->edges[i]);
    gn_status status = frame_start(&s->f, &s->scene, &settings);
    if (status == GN_OK)
        status = gn_volumes_light(s->f.context, &s->light);
    return status == GN_OK ? gn_volumes_pass(s->f.context, &s->camera, frame_flush, &s->f) : status;
}

static int is_red(const stage *s, size_t pixel)
{
    return s->f.colour[3 * pixel] > 0;
}

static void end(stage *s)
{
    if (s->f.block)
        frame_end(&s->f);
    for (int i = 0; i < 2; i++)
        shape_free(&s->shapes[i]);
}

typedef struct answer {
    uint64_t scenes, red, wrong;
} answer;

/* A red pixel is lit. */
static void take_in_pixel(answer *a, const stage *s, uint64_t n, size_t pixel)
{
    a->red++;
    if (s->f.mask[pixel] != 254 && a->wrong++ < 5)
        note("scene %llu, pixel (%u, %u): shadowed", (unsigned long long)n, (unsigned)(pixel % SIDE),
             (unsigned)(pixel / SIDE));
}

/* All red pixels are. */
static void take_in(answer *a, const stage *s, uint64_t n)
{
    a->scenes++;
    for (size_t i = 0; i < SIDE * SIDE; i++)
        if (is_red(s, i))
            take_in_pixel(a, s, n, i);
}

static void report(const char *what, const answer *a, uint64_t allowed, uint64_t cases)
{
    ok(a->wrong <= allowed, "%s: %llu of %llu pixels are not", what, (unsigned long long)a->wrong,
       (unsigned long long)a->red);
    ok(a->scenes > cases * 9 / 10 && a->red > cases, "in %llu scenes", (unsigned long long)a->scenes);
}

/* Render from the eye into the scene, turned by any angle about the view. light: what making the light returned. */
static gn_status see(stage *s, gn_status light, const int32_t eye[3], const int32_t target[3])
{
    if (light != GN_OK)
        return light;
    int32_t up[3] = {between(-1000, 1000), between(1, 1000), 0};
    gn_status status = gn_look_at(&s->camera, eye, target, up);
    if (status == GN_OK)
        status = gn_perspective(&s->camera, GN_DEGREES(40), 1000, 1 << 24);
    return status == GN_OK ? render(s) : status;
}

/* ---- edge-on --------------------------------------------------------------------------------------------------- */

/* A triangle above the view, its shadow volume below, away from the eye. One side of it lies in the plane x = 0, at
 * depths of 1 to 3 million, and the eye beside that plane so closely that the side is at most 1/128 of a pixel wide. A
 * plate before all of that is lit. One pixel in ten million may be wrong: such sides are drawn as narrow as snapping
 * leaves them, or not at all. */
static void what_is_before_a_side_seen_edge_on_is_lit(uint64_t cases)
{
    answer a = {0, 0, 0};
    for (uint64_t n = 0; n < cases; n++) {
        stage s;
        begin(&s);
        int32_t height = between(100000, 500000), direction[3] = {0, -1000, between(-300, 0)};
        int32_t beside = between(5, 120), eye[3] = {between(0, 1) ? beside : -beside, 0, 0};
        int32_t target[3] = {between(-200000, 200000), between(-100000, -1000), -1000000};
        const int32_t corner[4][3] = {{-600000, -290000, -660000},
                                      {600000, -290000, -660000},
                                      {600000, 40000, -990000},
                                      {-600000, 40000, -990000}};
        add_quad(&s.shapes[0], corner[0], corner[1], corner[2], corner[3]);
        add_vertex(&s.shapes[1], 0, height, -1000000);
        add_vertex(&s.shapes[1], 0, height, -3000000);
        add_vertex(&s.shapes[1], between(0, 1) ? 1500000 : -1500000, height, -2000000);
        add_triangle(&s.shapes[1], 0, 1, 2);
        if (see(&s, gn_directional_light(&s.light, direction, 0), eye, target) == GN_OK)
            take_in(&a, &s, n);
        end(&s);
    }
    report("what is before a side seen edge-on is lit", &a, a.red / 10000000, cases);
}

/* A triangle in a plane that the eye is beside so closely that it is as narrow; behind it the shadow of a roof over all
 * that is farther than 3.1 million. */
static void what_is_seen_edge_on_before_a_shadow_is_lit(uint64_t cases)
{
    answer a = {0, 0, 0};
    for (uint64_t n = 0; n < cases; n++) {
        stage s;
        begin(&s);
        static const int32_t direction[3] = {-100, -1000, 0};
        int32_t eye[3] = {between(5, 150), 0, 0};
        int32_t target[3] = {between(-200000, 200000), between(-100000, 100000), -1000000};
        const int32_t roof[4][3] = {{-8000000, 7000000, -3100000},
                                    {8000000, 7000000, -3100000},
                                    {8000000, 7000000, -16000000},
                                    {-8000000, 7000000, -16000000}};
        add_vertex(&s.shapes[0], 0, between(-300000, 0), -1000000);
        add_vertex(&s.shapes[0], 0, between(100000, 300000), -1000000);
        add_vertex(&s.shapes[0], 0, between(-900000, 900000), -3000000);
        add_triangle(&s.shapes[0], 0, 1, 2);
        add_quad(&s.shapes[1], roof[0], roof[1], roof[2], roof[3]);
        if (see(&s, gn_directional_light(&s.light, direction, 0), eye, target) == GN_OK)
            take_in(&a, &s, n);
        end(&s);
    }
    report("what is seen edge-on before a shadow is lit", &a, 0, cases / 20);
}

/* ---- the near plane of a spot light ---------------------------------------------------------------------------- */

/* A level floor in irregular triangles, on a grid of 9 x 9 corners. */
static void add_floor(shape *s)
{
    enum { CORNERS = 9, STEP = 100000, JITTER = 30000 };
    for (int row = 0; row < CORNERS; row++)
        for (int column = 0; column < CORNERS; column++)
            add_vertex(s, (column - CORNERS / 2) * STEP + between(-JITTER, JITTER), 0,
                       -row * STEP + between(-JITTER, JITTER));
    for (uint32_t row = 0; row + 1 < CORNERS; row++)
        for (uint32_t i = row * CORNERS; i + 1 < (row + 1) * CORNERS; i++) {
            add_triangle(s, i, i + 1, i + CORNERS);
            add_triangle(s, i + 1, i + CORNERS + 1, i + CORNERS);
        }
}

static real along(const int32_t axis[3], const real v[3])
{
    return ldexpl(axis[0] * v[0] + axis[1] * v[1] + axis[2] * v[2], -30);
}

/* Where the centre of a pixel sees the floor, which lies below the eye: is it inside the light's frustum, and how far
 * from its planes, as a part of the distance? */
static int sees_the_frustum(const stage *s, size_t pixel)
{
    const gn_camera *c = &s->camera;
    const gn_light *l = &s->light;
    real tangent = ldexpl(c->tan_half, -24), d[3], v[3];
    real x = tangent * (2 * ((real)(pixel % SIDE) + 0.5L) / SIDE - 1);
    real y = tangent * (1 - 2 * ((real)(pixel / SIDE) + 0.5L) / SIDE);
    for (int i = 0; i < 3; i++)
        d[i] = ldexpl(c->forward[i] + x * c->right[i] + y * c->up[i], -30);
    if (d[1] >= 0)
        return 0;
    for (int i = 0; i < 3; i++)
        v[i] = c->eye[i] - d[i] * c->eye[1] / d[1] - l->position[i];
    real w = along(l->forward, v), most = 0.99L * w * ldexpl(l->tan_half, -24);
    return w > 1.01L * l->near_depth && w < 0.99L * l->far_depth && fabsl(along(l->right, v)) < most &&
           fabsl(along(l->up, v)) < most;
}

/* Beyond the near plane, inside the frustum, nothing is in the way. One pixel in a million may be wrong: two sides over
 * one edge, each with a plane of its own, may find another order where both are all but edge-on. */
static void a_floor_that_the_near_plane_cuts_is_lit_beyond_it(uint64_t cases)
{
    answer a = {0, 0, 0};
    for (uint64_t n = 0; n < cases; n++) {
        stage s;
        begin(&s);
        int32_t position[3] = {between(-100000, 100000), between(100000, 300000), between(0, 100000)};
        int32_t aim[3] = {between(-200000, 200000), 0, -400000};
        int32_t eye[3] = {between(-400000, 400000), between(100000, 600000), between(0, 400000)};
        int32_t target[3] = {between(-200000, 200000), 0, between(-600000, -200000)};
        add_floor(&s.shapes[0]);
        add_level(&s.shapes[1], 3000000, 3000000, 3000001, 3000001, 0, 1);
        gn_status status = gn_spot_light(&s.light, position, aim, 0, GN_DEGREES(100), between(200000, 500000), 1 << 22);
        status = see(&s, status, eye, target);
        a.scenes += status == GN_OK;
        for (size_t i = 0; status == GN_OK && i < SIDE * SIDE; i++)
            if (is_red(&s, i) && sees_the_frustum(&s, i))
                take_in_pixel(&a, &s, n, i);
        end(&s);
    }
    report("a floor that the near plane cuts is lit beyond it", &a, a.red / 1000000, cases);
}

/* On the plane counts as beyond it: the triangle's shadow is that of the same one a unit farther. */
static void a_triangle_in_the_near_plane_casts(void)
{
    static const int32_t position[3] = {0, 100000, 0}, below[3] = {0, 0, 0}, z_up[3] = {0, 0, 1};
    static const int32_t eye[3] = {150000, 90000, 0};
    for (int lower = -1; lower < 2; lower++) {
        static const char *const names[] = {"before", "in", "beyond"};
        uint64_t lit = 0, shadowed = 0;
        stage s;
        begin(&s);
        const int32_t floor[4][3] = {{-90000, 0, -90000}, {-90000, 0, 90000}, {90000, 0, 90000}, {90000, 0, -90000}};
        add_quad(&s.shapes[0], floor[0], floor[1], floor[2], floor[3]);
        add_vertex(&s.shapes[1], -10000, 80000 - lower, -10000);
        add_vertex(&s.shapes[1], 10000, 80000 - lower, -10000);
        add_vertex(&s.shapes[1], 0, 80000 - lower, 10000);
        add_triangle(&s.shapes[1], 0, 1, 2);
        gn_status status = gn_spot_light(&s.light, position, below, z_up, GN_DEGREES(90), 20000, 1 << 20);
        if (status == GN_OK)
            status = gn_look_at(&s.camera, eye, below, z_up);
        if (status == GN_OK)
            status = gn_perspective(&s.camera, GN_DEGREES(70), 1000, 1 << 20);
        if (status == GN_OK)
            status = render(&s);
        for (size_t i = 0; status == GN_OK && i < SIDE * SIDE; i++) {
            lit += is_red(&s, i) && s.f.mask[i] == 254;
            shadowed += is_red(&s, i) && s.f.mask[i] == 0;
        }
        if (!ok(status == GN_OK && lit > 50 && (lower < 0 ? shadowed == 0 : shadowed > 50),
                "a triangle %s the near plane casts %s", names[lower + 1], lower < 0 ? "nothing" : "a shadow"))
            note("status %d, %llu lit, %llu shadowed", (int)status, (unsigned long long)lit,
                 (unsigned long long)shadowed);
        end(&s);
    }
}

int main(int argc, char **argv)
{
    uint64_t cases = tap_cases(argc, argv, 4000);
    a_triangle_in_the_near_plane_casts();
    what_is_before_a_side_seen_edge_on_is_lit(cases);
    what_is_seen_edge_on_before_a_shadow_is_lit(cases);
    a_floor_that_the_near_plane_cuts_is_lit_beyond_it(cases / 8);
    return tap_done();
}
