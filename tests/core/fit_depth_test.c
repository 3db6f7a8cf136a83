/* Depth ranges that span what the camera sees. Random scenes of triangles up to thousands of ranges above the fitted
 * box and through its ends: every pixel, whatever surface, receiver and reconstruction, is what an exact ray to the
 * light says, but near borders; and the same whatever the order of triangles, regions and workers. Lone triangles of
 * any attitude: each texel holds the depth of the triangle's own plane, held within the range, and the receiver's plane
 * is that depth, bit for bit. The range, by hand. What the option is worth: thin gaps under a tower. Cases: 300 scenes
 * and 100 times as many triangles, or GNOMON_CASES. */
#include "gn_cascade.h"
#include "gn_drawing.h"
#include "gn_silhouette_map.h"
#include "scenes.h"
#include "warped.h"

#include <math.h>

enum { WIDTH = 48, HEIGHT = 36, TRIANGLES = 12, MAP = 256, SMALL_MAP = 64 };

typedef struct vector {
    double c[3];
} vector;

/* ---- rays ------------------------------------------------------------------------------------------------------- */

/* A triangle seen from above: where the light, which shines down z, crosses its plane at (x, y). */
typedef struct facet {
    vector v[3];
    double nx, ny, nz;
} facet;

static facet facet_of(const gn_mesh *mesh, uint32_t triangle)
{
    facet f;
    uint32_t index[3];
    gn_triangle_indices(mesh, triangle, index);
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++)
            f.v[i].c[k] = mesh->vertices[index[i]][k];
    double a[3], b[3];
    for (int k = 0; k < 3; k++) {
        a[k] = f.v[1].c[k] - f.v[0].c[k];
        b[k] = f.v[2].c[k] - f.v[0].c[k];
    }
    f.nx = a[1] * b[2] - a[2] * b[1];
    f.ny = a[2] * b[0] - a[0] * b[2];
    f.nz = a[0] * b[1] - a[1] * b[0];
    return f;
}

/* Distance of (x, y) inside the triangle from its nearest side; negative outside. */
static double depth_inside(const facet *f, double x, double y)
{
    double least = INFINITY, turn = f->nz < 0 ? -1 : 1;
    for (int i = 0; i < 3; i++) {
        const vector *a = &f->v[i], *b = &f->v[i == 2 ? 0 : i + 1];
        double dx = b->c[0] - a->c[0], dy = b->c[1] - a->c[1], length = hypot(dx, dy);
        double side = length > 0 ? turn * (dx * (y - a->c[1]) - dy * (x - a->c[0])) / length : -INFINITY;
        least = side < least ? side : least;
    }
    return least;
}

/* The distance of (x, y) from the nearest side of a triangle, from either side of it. */
static double distance_from_sides(const facet *f, double x, double y)
{
    double least = INFINITY;
    for (int i = 0; i < 3; i++) {
        const vector *a = &f->v[i], *b = &f->v[i == 2 ? 0 : i + 1];
        double dx = b->c[0] - a->c[0], dy = b->c[1] - a->c[1], square = dx * dx + dy * dy;
        double t = square > 0 ? ((x - a->c[0]) * dx + (y - a->c[1]) * dy) / square : 0;
        t = t < 0 ? 0 : t > 1 ? 1 : t;
        double d = hypot(x - a->c[0] - t * dx, y - a->c[1] - t * dy);
        least = d < least ? d : least;
    }
    return least;
}

static double height_at(const facet *f, double x, double y)
{
    return f->v[0].c[2] - (f->nx * (x - f->v[0].c[0]) + f->ny * (y - f->v[0].c[1])) / f->nz;
}

/* The triangle that a pixel's ray meets first; -1: none. */
static int seen_at(const gn_camera *camera, const facet *facets, int count, double x, double y, vector *at)
{
    double tangent = camera->tan_half / 16777216.0, nearest = INFINITY;
    double across = (2 * x / WIDTH - 1) * tangent * WIDTH / HEIGHT, up = (1 - 2 * y / HEIGHT) * tangent, way[3];
    int found = -1;
    for (int k = 0; k < 3; k++)
        way[k] = (camera->forward[k] + across * camera->right[k] + up * camera->up[k]) / (1 << 30);
    for (int i = 0; i < count; i++) {
        const facet *f = &facets[i];
        double along = f->nx * way[0] + f->ny * way[1] + f->nz * way[2], t = 0;
        const double *v = f->v[0].c;
        if (along == 0)
            continue;
        t = (f->nx * (v[0] - camera->eye[0]) + f->ny * (v[1] - camera->eye[1]) + f->nz * (v[2] - camera->eye[2])) /
            along;
        if (t <= camera->near_depth || t >= nearest)
            continue;
        /* inside, on the plane on which the triangle is largest */
        double p[3], inside = 1;
        for (int k = 0; k < 3; k++)
            p[k] = camera->eye[k] + t * way[k];
        for (int s = 0; s < 3; s++) {
            const double *a = f->v[s].c, *b = f->v[s == 2 ? 0 : s + 1].c;
            double e[3] = {b[0] - a[0], b[1] - a[1], b[2] - a[2]}, q[3] = {p[0] - a[0], p[1] - a[1], p[2] - a[2]};
            double side = f->nx * (e[1] * q[2] - e[2] * q[1]) + f->ny * (e[2] * q[0] - e[0] * q[2]) +
                          f->nz * (e[0] * q[1] - e[1] * q[0]);
            inside = side < 0 ? 0 : inside;
        }
        if (inside == 0)
            continue;
        nearest = t;
        found = i;
        for (int k = 0; k < 3; k++)
            at->c[k] = p[k];
    }
    return found;
}

typedef enum truth { UNKNOWN, LIT, SHADOWED } truth;

/* texel: of the map, world units. Unknown: within reach texels of a border, or so near to another level surface, by
 * gap texels, that a bias matters. */
static truth truth_at(const gn_camera *camera, const facet *facets, int count, int x, int y, double texel, double reach,
                      double gap)
{
    vector at, beside;
    int seen = seen_at(camera, facets, count, x + 0.5, y + 0.5, &at), dark = 0;
    for (int i = 0; i < 4; i++)
        if (seen_at(camera, facets, count, x + 0.5 + (i & 1 ? 0.6 : -0.6), y + 0.5 + (i & 2 ? 0.6 : -0.6), &beside) !=
            seen)
            return UNKNOWN;
    if (seen < 0)
        return UNKNOWN;
    if (fabs(facets[seen].nx) + fabs(facets[seen].ny) > 2 * fabs(facets[seen].nz))
        return UNKNOWN; /* it falls away within the texel that holds its border */
    for (int i = 0; i < count; i++) {
        const facet *f = &facets[i];
        if (i == seen)
            continue;
        if (distance_from_sides(f, at.c[0], at.c[1]) < reach * texel)
            return UNKNOWN;
        if (depth_inside(f, at.c[0], at.c[1]) <= 0)
            continue;
        double above = height_at(f, at.c[0], at.c[1]) - at.c[2];
        double steep = (fabs(f->nx) + fabs(f->ny)) / fabs(f->nz);
        if (fabs(above) < (gap + reach * steep) * texel)
            return UNKNOWN;
        dark |= above > 0;
    }
    return dark ? SHADOWED : LIT;
}

/* ---- scenes ------------------------------------------------------------------------------------------------------ */

static void add_facet(shape *s, int32_t (*v)[3])
{
    uint32_t i = add_vertex(s, v[0][0], v[0][1], v[0][2]);
    add_vertex(s, v[1][0], v[1][1], v[1][2]);
    add_vertex(s, v[2][0], v[2][1], v[2][2]);
    add_triangle(s, i, i + 1, i + 2);
}

/* A sloping ground of 2^13 units squared about the origin, low plates above it, and casters far above what is seen;
 * some reach from just above the ground to where others end. */
static shape random_scene(int turned)
{
    shape s = shape_new(0);
    int32_t half = 1 << 12, slope = between(-1000, 1000);
    int32_t corner[4][3] = {{-half, -half, -slope}, {half, -half, -slope}, {half, half, slope}, {-half, half, slope}};
    int32_t facets[TRIANGLES][3][3];
    for (int i = 0; i < TRIANGLES; i++) {
        int kind = i < 2 ? 0 : i < 4 ? 1 : between(2, 3);
        int32_t x = between(-3000, 3000), y = between(-3000, 3000), size = between(600, 3000);
        for (int v = 0; v < 3; v++) {
            facets[i][v][0] = x + between(-size, size);
            facets[i][v][1] = y + between(-size, size);
            facets[i][v][2] = kind == 1   ? 1100 + 500 * (i - 2)
                              : kind == 2 ? 1 << between(14, 23)
                              : v         ? 1 << between(14, 22)
                                          : between(3500, 6000);
        }
        for (int v = 0; kind == 0 && v < 3; v++)
            memcpy(facets[i][v], corner[v ? v + i : 0], sizeof facets[i][v]);
    }
    for (int i = 0; i < TRIANGLES; i++)
        add_facet(&s, facets[turned ? TRIANGLES - 1 - i : i]);
    return s;
}

static gn_light light_above(void)
{
    gn_light light;
    static const int32_t down[3] = {0, 0, -1}, north[3] = {0, 1, 0};
    (void)gn_directional_light(&light, down, north);
    return light;
}

static gn_light box_light(int32_t height)
{
    gn_light light = light_above();
    light.box_u = light.box_v = -(1 << 17);
    light.box_width = light.box_height = 1 << 18;
    light.box_z = -height;
    light.box_depth = height + 1024;
    return light;
}

static gn_camera random_camera(void)
{
    gn_camera camera;
    int32_t eye[3] = {between(-3000, 3000), between(-9000, -7000), between(5000, 7000)};
    int32_t target[3] = {between(-800, 800), between(-1000, 1000), 0}, up[3] = {0, 0, 1};
    (void)gn_look_at(&camera, eye, target, up);
    (void)gn_perspective(&camera, GN_DEGREES(40), 200, 40000);
    return camera;
}

static const gn_reconstruction *const reconstructions[] = {
    0, &gn_bilinear, &gn_jitter_4x4, &gn_box_3x3, &gn_box_7x7, &gn_silhouettes, &gn_silhouettes_smooth, &gn_crossings};
static const gn_receiver *const receivers[] = {0, &gn_plane_bias, &gn_virtual, &gn_virtual_always};
static const gn_warp *const warps[] = {&gn_rectilinear, &gn_rectilinear_distance, &gn_nonorthogonal};
static const uint8_t surfaces[] = {GN_CONSTANT, GN_MIDPOINT, GN_DUAL, GN_SECOND, GN_MIXED};

static gn_settings random_settings(void)
{
    gn_settings s = gn_default_settings(WIDTH, HEIGHT, MAP);
    s.mask = 1;
    s.format = GN_NO_COLOUR;
    s.surface = surfaces[between(0, 4)];
    s.receiver = receivers[between(0, 3)];
    s.reconstruction = reconstructions[between(0, 7)];
    s.bias.unit = GN_BIAS_TEXELS;
    s.bias.value = s.surface == GN_MIDPOINT ? 0 : 4 << 16;
    s.slope = 1 << 16;
    s.fit = between(0, 1) ? &gn_desired_view : &gn_minimal_frustum;
    s.fit_depth = 1;
    if (between(0, 1)) { /* texels of any width: a nearest one, and a plane that is asked at once */
        s.warp = warps[between(0, 2)];
        s.smoothing = 4 << 16;
        s.receiver = &gn_virtual_always;
        s.reconstruction = 0;
    }
    return s;
}

/* The view pass in steps, from the last region to the first, on all workers in turn; the light pass likewise. */
static gn_status render_in_steps(frame *f, const gn_light *light, const gn_camera *camera)
{
    gn_status status = gn_view_begin(f->context, camera, light);
    uint32_t workers = f->settings.workers;
    for (uint32_t round = 0; status == GN_OK && round < f->plan.view_rounds; round++) {
        for (uint32_t i = f->plan.camera_regions; status == GN_OK && i--;)
            status = gn_view_region(f->context, i, i % workers);
        if (status == GN_OK)
            status = gn_view_end(f->context);
    }
    if (status == GN_OK)
        status = gn_light_begin(f->context, light);
    for (uint32_t i = f->plan.light_regions; status == GN_OK && i--;) {
        status = gn_light_layers(f->context, i, i % workers);
        if (status == GN_OK)
            status = gn_light_resolve(f->context, i, i % workers);
    }
    return status == GN_OK ? gn_camera_pass(f->context, camera, frame_flush, f) : status;
}

static gn_status render(frame *f, const gn_light *light, const gn_camera *camera)
{
    gn_status status = gn_view_pass(f->context, camera, light);
    return status == GN_OK ? frame_render(f, light, camera) : status;
}

/* ---- against rays ------------------------------------------------------------------------------------------------ */

typedef struct counts {
    uint64_t pixels, lit, shadowed, wrong, frames, clamped, through, far_off, warped;
} counts;

static void note_pixel(const frame *f, uint64_t n, int x, int y, truth expected)
{
    note("scene %llu, pixel (%d, %d): %s, mask %u; surface %u, bias %ld, %s%s, %s", (unsigned long long)n, x, y,
         expected == LIT ? "lit" : "shadowed", (unsigned)f->mask[y * WIDTH + x], (unsigned)f->settings.surface,
         (long)f->settings.bias.value, f->settings.receiver ? "receiver " : "point",
         f->settings.receiver == &gn_plane_bias ? "plane bias"
         : f->settings.receiver                 ? "virtual"
                                                : "",
         f->settings.reconstruction ? "reconstruction" : "nearest");
}

/* The most that neighbours of the map lie apart, world units. */
static double widest_texel(const gn_context *context)
{
    double widest = 0, size[2] = {context->light.box_width, context->light.box_height};
    for (uint32_t i = 0; i + 1 < MAP; i++)
        for (uint32_t j = 0; j + 1 < MAP; j++) {
            uint32_t here[2], next[2];
            for (uint32_t k = 0; k < 2; k++) {
                (void)gn_texel_place(context, i, j, here);
                (void)gn_texel_place(context, i + k, j + 1 - k, next);
                for (int m = 0; m < 2; m++) {
                    double apart = fabs((double)next[m] - here[m]) * size[m] / 4294967296.0;
                    widest = apart > widest ? apart : widest;
                }
            }
        }
    return widest;
}

static void compare_with_rays(const frame *f, const gn_camera *camera, const facet *facets, uint64_t n, counts *c)
{
    const gn_light *light = &f->context->light;
    double texel = widest_texel(f->context);
    int warped = f->settings.warp != 0;
    double top = -light->box_z;
    c->frames++;
    for (int i = 0; i < TRIANGLES; i++) {
        int above = 0;
        for (int v = 0; v < 3; v++) {
            above += facets[i].v[v].c[2] > top;
            c->far_off += facets[i].v[v].c[2] > top + 200.0 * light->box_depth;
        }
        c->clamped += above == 3;
        c->through += above % 3 != 0;
    }
    for (int y = 0; y < HEIGHT; y++)
        for (int x = 0; x < WIDTH; x++) {
            truth expected = truth_at(camera, facets, TRIANGLES, x, y, texel, warped ? 2 : 6, warped ? 4 : 12);
            if (expected == UNKNOWN)
                continue;
            uint8_t value = expected == LIT ? 254 : 0;
            c->pixels++;
            c->warped += warped && value == 0;
            c->lit += value == 254;
            c->shadowed += value == 0;
            if (f->mask[y * WIDTH + x] != value && c->wrong++ < 8)
                note_pixel(f, n, x, y, expected);
        }
}

static void test_rays(uint64_t cases)
{
    counts c = {0};
    uint64_t differ = 0, bad = 0, moved = 0;
    gn_light above = light_above();
    for (uint64_t n = 0; n < cases; n++) {
        uint64_t seed = random_state;
        shape s = random_scene(0);
        uint64_t after = random_state;
        random_state = seed;
        shape turned = random_scene(1);
        random_state = after;
        gn_object object[2] = {{.mesh = &s.mesh}, {.mesh = &turned.mesh}};
        gn_scene scene[2] = {{.objects = &object[0], .object_count = 1}, {.objects = &object[1], .object_count = 1}};
        gn_settings settings = random_settings();
        gn_camera camera = random_camera();
        gn_light light = above;
        facet facets[TRIANGLES];
        frame f, g;
        for (uint32_t i = 0; i < TRIANGLES; i++)
            facets[i] = facet_of(&s.mesh, i);
        bad += gn_fit_light(&light, &scene[0]) != GN_OK;
        bad += frame_start(&f, &scene[0], &settings) != GN_OK || render(&f, &light, &camera) != GN_OK;
        compare_with_rays(&f, &camera, facets, n, &c);
        moved += f.context->light.box_depth < light.box_depth;
        /* the same in another order, small regions and several workers */
        settings.region_width = 16;
        settings.region_height = 8;
        settings.map_rows = 5;
        settings.workers = 3;
        bad += frame_start(&g, &scene[1], &settings) != GN_OK || render_in_steps(&g, &light, &camera) != GN_OK;
        differ += memcmp(f.mask, g.mask, mask_bytes(&f)) != 0;
        bad += !frame_end(&f);
        bad += !frame_end(&g);
        shape_free(&s);
        shape_free(&turned);
    }
    ok(!bad && moved == c.frames, "%llu frames are rendered, all with less depth than the scene has",
       (unsigned long long)c.frames);
    ok(!c.wrong && c.lit > 50 * cases && c.shadowed > 20 * cases && c.warped > 5 * cases,
       "%llu pixels away from borders are what rays say, %llu lit, %llu shadowed, %llu of them on warped maps",
       (unsigned long long)c.pixels, (unsigned long long)c.lit, (unsigned long long)c.shadowed,
       (unsigned long long)c.warped);
    ok(c.clamped > cases && c.through > cases / 2 && c.far_off > 2 * cases,
       "%llu triangles above the range, %llu through its ends, %llu corners 200 ranges away",
       (unsigned long long)c.clamped, (unsigned long long)c.through, (unsigned long long)c.far_off);
    ok(!differ, "the same whatever the order of triangles, regions and workers");
}

/* ---- lifted ------------------------------------------------------------------------------------------------------ */

/* What is above the range shadows alike however high it is, and however steep: casters that lie level just above it,
 * and the same seen from the light with each corner at a height of its own, make one map, one silhouette map and one
 * mask. */
static void test_lifted(uint64_t cases)
{
    uint64_t bad = 0, differ = 0, drawn = 0, drawn_without = 0, lit = 0, shadowed = 0;
    for (uint64_t n = 0; n < cases; n++) {
        gn_settings settings = random_settings();
        gn_camera camera = random_camera();
        gn_light light = box_light(1 << 22);
        int32_t casters[4][3][3];
        frame f[3]; /* level; lifted; level, without the option */
        shape s[2] = {shape_new(0), shape_new(0)};
        settings.surface = settings.surface == GN_MIXED ? GN_CONSTANT : settings.surface; /* level ones mark one way */
        for (int lifted = 0; lifted < 2; lifted++) {
            add_level(&s[lifted], -4096, -4096, 4096, 4096, 0, 1);
            for (int i = 0; i < 4; i++) {
                for (int v = 0; v < 3; v++) {
                    for (int k = 0; k < 2 && !lifted; k++)
                        casters[i][v][k] = between(-3000, 3000);
                    casters[i][v][2] = lifted ? 1 << between(16, 22) : 1 << 15;
                }
                add_facet(&s[lifted], casters[i]);
            }
            gn_object object = {.mesh = &s[lifted].mesh};
            gn_scene scene = {.objects = &object, .object_count = 1};
            bad += frame_start(&f[lifted], &scene, &settings) != GN_OK || render(&f[lifted], &light, &camera) != GN_OK;
            if (lifted)
                continue;
            settings.fit_depth = 0;
            bad += frame_start(&f[2], &scene, &settings) != GN_OK || render(&f[2], &light, &camera) != GN_OK;
            settings.fit_depth = 1;
        }
        bad += f[0].context->light.box_z != f[1].context->light.box_z || f[0].context->light.box_z < -(1 << 15);
        for (uint32_t i = 0; i < MAP * MAP; i++) {
            differ += texel_at(f[0].context, i % MAP, i / MAP) != texel_at(f[1].context, i % MAP, i / MAP);
            if (!f[0].context->drawn)
                continue;
            uint8_t nothing = settings.reconstruction == &gn_crossings ? 0 : GN_CELL_CENTRE;
            differ += f[0].context->drawn->map[i] != f[1].context->drawn->map[i];
            drawn += f[0].context->drawn->map[i] != nothing;
            drawn_without += f[2].context->drawn->map[i] != nothing;
        }
        differ += memcmp(f[0].mask, f[1].mask, mask_bytes(&f[0])) != 0;
        count_mask(&f[0], &lit, &shadowed);
        for (int i = 0; i < 3; i++)
            bad += !frame_end(&f[i]);
        shape_free(&s[0]);
        shape_free(&s[1]);
    }
    ok(!bad && !differ && lit > 100 * cases && shadowed > 100 * cases && drawn > 10 * cases &&
           drawn > drawn_without - drawn_without / 20,
       "casters above the range shadow alike however high they are: %llu pixels lit, %llu shadowed, %llu cells "
       "drawn, without the option %llu",
       (unsigned long long)lit, (unsigned long long)shadowed, (unsigned long long)drawn,
       (unsigned long long)drawn_without);
}

/* ---- one triangle ------------------------------------------------------------------------------------------------ */

/* Where the box of the light is: 2^14 wide at the origin, deep from -0 down; the fitted range is a part of it. */
static void test_planes(uint64_t cases)
{
    int32_t vertices[3][3];
    uint16_t indices[3] = {0, 1, 2};
    gn_mesh mesh = {0};
    uint64_t left_out = 0;
    mesh.vertices = (const int32_t(*)[3])vertices;
    mesh.indices = indices;
    mesh.vertex_count = 3;
    mesh.triangle_count = 1;
    mesh.index_size = 2;
    gn_object object = {.mesh = &mesh};
    gn_scene scene = {.objects = &object, .object_count = 1};
    gn_light light = light_above();
    light.box_u = light.box_v = 0;
    light.box_width = light.box_height = 1 << 14;
    light.box_z = -(1 << 23);
    light.box_depth = 1 << 24;
    uint64_t texels = 0, wrong = 0, unequal = 0, near_end = 0, far_end = 0, between_ends = 0, bad = 0, flat = 0;
    for (uint64_t n = 0; n < cases; n++) {
        gn_settings s = gn_default_settings(8, 8, SMALL_MAP);
        tables t;
        gn_camera camera = {.projection = GN_ORTHOGRAPHIC};
        frame f;
        int warped = between(0, 1), how = between(0, 3);
        int32_t depth = 1 << between(14, 22), place = between(-(1 << 22), 1 << 22);
        double width = warped ? (double)(1 << 14) / GN_FINE : (double)(1 << 14) / SMALL_MAP;
        for (int i = 0; i < 3; i++) {
            int32_t reach = how == 3 ? 1 << 20 : 1 << 13;
            vertices[i][0] = between(8192 - reach, 8192 + reach);
            vertices[i][1] = between(8192 - reach, 8192 + reach);
            vertices[i][2] = how == 0 ? between(-(1 << 23), 1 << 23) : -place - depth / 2 + between(-depth, depth);
        }
        s.receiver = &gn_virtual;
        s.surface = GN_CONSTANT;
        s.cull = (uint8_t)between(GN_CULL_NONE, GN_CULL_FRONT);
        mesh.closed = (uint8_t)between(0, 1);
        s.fit = &gn_desired_view;
        s.fit_depth = 1;
        s.warp = warped ? &gn_rectilinear : 0;
        s.map_rows = 16;
        random_tables(&t, &s);
        memcpy(camera.right, light.right, sizeof camera.right);
        memcpy(camera.up, light.up, sizeof camera.up);
        memcpy(camera.forward, light.forward, sizeof camera.forward);
        camera.half_height = 1 << 14;
        camera.near_depth = -(1 << 24);
        camera.far_depth = 1 << 24;
        facet v = facet_of(&mesh, 0);
        if (v.nz == 0)
            continue;
        int culled = mesh.closed && s.cull == (v.nz > 0 ? GN_CULL_FRONT : GN_CULL_BACK);
        left_out += (uint64_t)culled;
        bad += frame_start(&f, &scene, &s) != GN_OK || gn_view_pass(f.context, &camera, &light) != GN_OK;
        gn_whole_plane(&f.context->fitting->rectangle, &light);
        f.context->fitting->fitted = 0;
        f.context->fitting->box_z = place;
        f.context->fitting->box_depth = depth;
        if (warped) {
            memcpy(f.context->fitting->columns, t.columns, SMALL_MAP * sizeof *t.columns);
            memcpy(f.context->fitting->rows, t.rows, SMALL_MAP * sizeof *t.rows);
        }
        bad += gn_light_begin(f.context, &light) != GN_OK;
        for (uint32_t i = 0; i < f.plan.light_regions; i++)
            bad += gn_light_layers(f.context, i, 0) != GN_OK;
        gn_receiver_plane planes[GN_COLOUR_CACHE];
        gn_worker worker = f.context->workers[0];
        for (int i = 0; i < GN_COLOUR_CACHE; i++)
            planes[i].triangle = GN_NO_TRIANGLE;
        worker.planes = planes;
        const gn_receiver_plane *plane = gn_find_plane(f.context, &worker, 0, 0);
        double unit = depth / ((double)GN_DEPTH_SPAN * 2); /* world units a unit of z */
        double rise_x = -v.nx / v.nz, rise_y = -v.ny / v.nz;
        for (int j = 0; j < SMALL_MAP; j++)
            for (int i = 0; i < SMALL_MAP; i++) {
                gn_depth stored = texel_at(f.context, (uint32_t)i, (uint32_t)j);
                int32_t column = warped ? t.columns[i] : i, row = warped ? t.rows[j] : j;
                double x = (column + 0.5) * width, y = (1 << 14) - (row + 0.5) * width;
                double inside = depth_inside(&v, x, y);
                if (culled || inside < -width / 32) {
                    wrong += stored != GN_FARTHEST;
                    continue;
                }
                if (inside < width / 32)
                    continue;
                double z = (-height_at(&v, x, y) - place) / unit + 2.0 * GN_DEPTH_GUARD;
                /* corners are snapped to 1/512 texel and the triangle is no narrower than what is inside of it */
                double slack = (fabs(rise_x) + fabs(rise_y)) * width / unit / 64 + 70000;
                double low = z - slack, high = z + slack;
                uint32_t least = gn_saturate(low < -1e15 ? -1 : (int64_t)low);
                uint32_t most = gn_saturate(high > 1e15 ? (int64_t)1 << 40 : (int64_t)high);
                texels++;
                near_end += most == 0;
                far_end += least == 0xffffffffu;
                between_ends += least > 0 && most < 0xffffffffu;
                int sheer = plane->plane.dx == 0 && plane->plane.dy == 0 && rise_x + rise_y != 0;
                flat += sheer;
                if (!sheer && (stored < least >> (32 - GN_DEPTH_BITS) || stored > most >> (32 - GN_DEPTH_BITS)) &&
                    wrong++ < 8)
                    note("triangle %llu, texel (%d, %d): %lu, expected %lu to %lu", (unsigned long long)n, i, j,
                         (unsigned long)stored, (unsigned long)(least >> (32 - GN_DEPTH_BITS)),
                         (unsigned long)(most >> (32 - GN_DEPTH_BITS)));
                uint32_t own = gn_saturate(gn_wide_depth(&plane->plane, column, row)) >> (32 - GN_DEPTH_BITS);
                unequal += plane->exists && own != stored;
                bad += !plane->exists && fabs(v.nz) > 1e6;
            }
        bad += !frame_end(&f);
    }
    ok(!bad && left_out > cases / 8, "%llu lone triangles are drawn or, %llu, left out", (unsigned long long)cases,
       (unsigned long long)left_out);
    ok(!wrong && 1000 * flat < texels && texels > 100 * cases && near_end > 10 * cases && far_end > 10 * cases &&
           between_ends > 10 * cases,
       "%llu texels hold the plane's depth or the range's end: %llu near, %llu far, %llu between, %llu flat",
       (unsigned long long)texels, (unsigned long long)near_end, (unsigned long long)far_end,
       (unsigned long long)between_ends, (unsigned long long)flat);
    ok(!unequal, "the receiver's plane is what is stored, bit for bit");
}

/* ---- the range, by hand ------------------------------------------------------------------------------------------ */

static void add_tower(shape *s, int32_t height)
{
    int32_t low[3] = {100000, 0, 0}, high[3] = {100200, 200, height};
    add_box(s, low, high);
}

/* The fitted box of a scene; 0: none. */
static int box_of(const shape *s, const gn_settings *settings, const gn_light *light, const gn_camera *camera,
                  gn_light *fitted)
{
    gn_object object = {.mesh = &s->mesh};
    gn_scene scene = {.objects = &object, .object_count = 1};
    frame f;
    int good = frame_start(&f, &scene, settings) == GN_OK && render(&f, light, camera) == GN_OK;
    *fitted = f.context->light;
    return frame_end(&f) && good;
}

static int about(int32_t value, double expected, double slack)
{
    if (fabs(value - expected) <= slack)
        return 1;
    note("%ld, expected %.1f +- %.1f", (long)value, expected, slack);
    return 0;
}

static gn_camera camera_above(int32_t half_height, int32_t eye_height)
{
    gn_camera camera;
    int32_t eye[3] = {0, 0, eye_height}, target[3] = {0, 0, 0}, up[3] = {0, 1, 0};
    (void)gn_look_at(&camera, eye, target, up);
    (void)(half_height ? gn_orthographic(&camera, half_height, 1, 1 << 16)
                       : gn_perspective(&camera, GN_DEGREES(40), 200, 1 << 18));
    return camera;
}

static void test_range(void)
{
    gn_settings s = gn_default_settings(WIDTH, HEIGHT, MAP);
    gn_light fitted;
    s.surface = GN_CONSTANT;
    s.bias.unit = GN_BIAS_TEXELS;
    s.bias.value = 4 << 16;
    s.fit = &gn_desired_view;
    s.fit_depth = 1;
    /* A ground that rises 1024 over 8192 units: 4096 of them are seen in 36 rows, from centre to centre */
    shape slope = shape_new(0);
    int32_t a[3] = {-8192, -4096, 0}, b[3] = {8192, -4096, 0}, c[3] = {8192, 4096, 1024}, d[3] = {-8192, 4096, 1024};
    add_quad(&slope, a, b, c, d);
    add_tower(&slope, 1 << 18);
    gn_camera camera = camera_above(2048, 1 << 15);
    gn_light light = box_light(1 << 18);
    double high = 35 * 4096.0 / 36, wide = 47 * 4096.0 / 36, range = high / 8;
    double texel_u = wide / (MAP - 2), texel_v = high / (MAP - 2);
    double margin = range / 32 + 4 * texel_u + 4 * (texel_u + texel_v) / 2 + 2;
    int good = box_of(&slope, &s, &light, &camera, &fitted);
    ok(good && about(fitted.box_depth, range + 2 * margin, 12) && about(fitted.box_z, -512 - range / 2 - margin, 8),
       "the range is what is seen, and at both ends 1/32 of it, four texels and the bias");
    /* A level ground: a 1024th of the light's depth, or a quarter of the way to the eye */
    shape level = shape_new(0);
    add_level(&level, -8192, -8192, 8192, 8192, 0, 1);
    add_tower(&level, 1 << 23);
    light = box_light(1 << 23);
    good = box_of(&level, &s, &light, &camera, &fitted);
    ok(good && about(fitted.box_depth, ((1 << 23) + 1024) / 1024, 1) && about(fitted.box_z, -(1 << 12), 4),
       "a level ground's is a 1024th of the light's");
    light = box_light(1 << 20);
    camera = camera_above(0, 1 << 14);
    good = box_of(&level, &s, &light, &camera, &fitted);
    ok(good && about(fitted.box_depth, 1 << 12, 2), "or a quarter of the eye's distance along the light");
    /* More than the light has: its own, and triangles are clipped */
    light = box_light(1 << 11);
    good = box_of(&level, &s, &light, &camera, &fitted);
    ok(good && fitted.box_z == light.box_z && fitted.box_depth == light.box_depth, "never more than the light's own");
    shape_free(&slope);
    shape_free(&level);
}

/* ---- slopes ------------------------------------------------------------------------------------------------------ */

/* GN_SLOPE stores twice what lies half a texel's rise below the nearest surface, less that. A caster far above the
 * range, which rises 100 texels a texel, has risen to no place within it. */
static void test_slope(void)
{
    uint64_t lit = 0, shadowed = 0, wrong = 0;
    int good = 1;
    for (int warped = 0; warped < 2; warped++) {
        shape s = shape_new(0);
        gn_object object = {.mesh = &s.mesh};
        gn_scene scene = {.objects = &object, .object_count = 1};
        gn_settings settings = gn_default_settings(WIDTH, HEIGHT, MAP);
        gn_camera camera = random_camera();
        gn_light light = box_light(1 << 22);
        int32_t a[3] = {-4096, -4096, 100000}, b[3] = {0, -4096, 500000}, c[3] = {0, 4096, 500000};
        int32_t d[3] = {-4096, 4096, 100000};
        frame f;
        add_level(&s, -4096, -4096, 4096, 4096, 0, 1);
        add_quad(&s, a, b, c, d);
        settings.mask = 1;
        settings.format = GN_NO_COLOUR;
        settings.surface = GN_SLOPE;
        settings.slope = 2 << 16;
        settings.bias.unit = GN_BIAS_TEXELS;
        settings.bias.value = 1 << 16;
        settings.fit = &gn_desired_view;
        settings.warp = warped ? &gn_rectilinear : 0;
        settings.fit_depth = 1;
        good &= frame_start(&f, &scene, &settings) == GN_OK && render(&f, &light, &camera) == GN_OK;
        facet ground = facet_of(&s.mesh, 0), other = facet_of(&s.mesh, 1);
        double texel = widest_texel(f.context);
        for (int y = 0; y < HEIGHT; y++)
            for (int x = 0; x < WIDTH; x++) {
                vector at;
                const facet both[2] = {ground, other};
                if (seen_at(&camera, both, 2, x + 0.5, y + 0.5, &at) < 0 || fabs(at.c[0]) < 2 * texel ||
                    at.c[0] < -4096 + 2 * texel || fabs(at.c[1]) > 4096 - 2 * texel)
                    continue;
                lit += at.c[0] > 0;
                shadowed += at.c[0] < 0;
                wrong += f.mask[y * WIDTH + x] != (at.c[0] < 0 ? 0 : 254);
            }
        good &= frame_end(&f);
        shape_free(&s);
    }
    ok(good && !wrong && lit > 500 && shadowed > 500,
       "slopes: a steep caster above the range shadows: %llu pixels lit, %llu shadowed, %llu wrong",
       (unsigned long long)lit, (unsigned long long)shadowed, (unsigned long long)wrong);
}

/* ---- spot lights ------------------------------------------------------------------------------------------------- */

static void test_spot(void)
{
    shape s = shape_new(0);
    gn_object object = {.mesh = &s.mesh};
    gn_scene scene = {.objects = &object, .object_count = 1};
    gn_settings settings = gn_default_settings(WIDTH, HEIGHT, MAP);
    gn_camera camera = random_camera();
    gn_light light;
    int32_t position[3] = {0, 1000, 20000}, target[3] = {0, 0, 0};
    frame f[2];
    uint64_t lit = 0, shadowed = 0;
    int good = gn_spot_light(&light, position, target, 0, GN_DEGREES(40), 2000, 30000) == GN_OK;
    add_level(&s, -4096, -4096, 4096, 4096, 0, 1);
    add_level(&s, -1000, -1000, 1000, 1000, 12000, 1);
    light.box_depth = light.box_width = light.box_height = 1 << 20; /* of another light: not read */
    settings.mask = 1;
    settings.format = GN_NO_COLOUR;
    settings.surface = GN_CONSTANT;
    settings.receiver = &gn_virtual;
    settings.fit = &gn_minimal_frustum;
    for (int with = 0; with < 2; with++) {
        settings.fit_depth = (uint8_t)with;
        good &= frame_start(&f[with], &scene, &settings) == GN_OK && render(&f[with], &light, &camera) == GN_OK;
    }
    count_mask(&f[0], &lit, &shadowed);
    good &= memcmp(f[0].mask, f[1].mask, mask_bytes(&f[0])) == 0;
    for (uint32_t i = 0; i < MAP * MAP; i++)
        good &= texel_at(f[0].context, i % MAP, i / MAP) == texel_at(f[1].context, i % MAP, i / MAP);
    ok(good && frame_end(&f[0]) && frame_end(&f[1]) && lit > 50 && shadowed > 10,
       "under a spot light the option says nothing: %llu pixels lit, %llu shadowed", (unsigned long long)lit,
       (unsigned long long)shadowed);
    shape_free(&s);
}

/* ---- what it is worth -------------------------------------------------------------------------------------------- */

/* Level plates two to four texels above a level ground, and a tower so high that 16 bits of its height are as much, and
 * so is the error that virtual samples take points to have, of any bits. */
static void test_worth(uint64_t cases)
{
    uint64_t wrong[2] = {0, 0}, pixels = 0, lit = 0, bad = 0;
    for (uint64_t n = 0; n < cases; n++) {
        shape s = shape_new(0);
        facet facets[14];
        add_level(&s, -8000, -8000, 8000, 8000, 0, 1);
        add_level(&s, -2000, -2000, between(-1000, 0), 2000, between(100, 140), 1);
        add_level(&s, between(500, 1000), -2000, 2000, 2000, between(100, 140), 1);
        for (uint32_t i = 0; i < 6; i++)
            facets[i] = facet_of(&s.mesh, i);
        add_tower(&s, (1 << 23) - 1);
        gn_object object = {.mesh = &s.mesh};
        gn_scene scene = {.objects = &object, .object_count = 1};
        gn_settings settings = random_settings();
        gn_camera camera; /* from the side, so that it sees under the plates */
        gn_light light = box_light(1 << 23);
        int32_t eye[3] = {between(-500, 500), -6000, between(500, 900)}, target[3] = {0, -2000, 60}, up[3] = {0, 0, 1};
        settings.surface = GN_CONSTANT;
        settings.receiver = &gn_virtual;
        settings.reconstruction = 0;
        settings.warp = 0;
        settings.bias.value = 1 << 16;
        bad += gn_look_at(&camera, eye, target, up) != GN_OK ||
               gn_perspective(&camera, GN_DEGREES(12), 200, 40000) != GN_OK;
        for (int with = 0; with < 2; with++) {
            frame f;
            settings.fit_depth = (uint8_t)with;
            bad += frame_start(&f, &scene, &settings) != GN_OK || render(&f, &light, &camera) != GN_OK;
            double texel = (double)f.context->light.box_width / MAP, other = (double)f.context->light.box_height / MAP;
            texel = texel > other ? texel : other;
            for (int y = 0; y < HEIGHT; y++)
                for (int x = 0; x < WIDTH; x++) {
                    truth expected = truth_at(&camera, facets, 6, x, y, texel, 2, 2);
                    uint8_t value = f.mask[y * WIDTH + x];
                    if (expected == UNKNOWN)
                        continue;
                    pixels += (uint64_t)with * (expected == SHADOWED);
                    lit += (uint64_t)with * (expected == LIT);
                    wrong[with] += value != (expected == LIT ? 254 : 0);
                }
            bad += !frame_end(&f);
        }
        shape_free(&s);
    }
    ok(!bad && !wrong[1] && lit > cases && pixels > cases && (wrong[0] > pixels / 4),
       "of %llu shadowed pixels and %llu lit ones under a tower %llu are wrong, with a fitted range %llu",
       (unsigned long long)pixels, (unsigned long long)lit, (unsigned long long)wrong[0], (unsigned long long)wrong[1]);
}

int main(int argc, char **argv)
{
    uint64_t cases = tap_cases(argc, argv, 300);
    test_rays(cases);
    test_lifted(cases);
    test_planes(100 * cases);
    test_range();
    test_slope();
    test_spot();
    test_worth(cases);
    return tap_done();
}
