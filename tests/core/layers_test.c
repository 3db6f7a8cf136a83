/* The two layers are the two nearest depths of all triangles over a texel's centre, as a multiset; nothing else about
 * the scene's order, regions or workers matters. Brute force: every triangle at every texel, by edge functions and
 * planes in 64 and 128 bits from the vertices as projected, all depths of a texel sorted; beside them the least depth
 * plus half a texel of its slope. Then every virtual surface and every unit of bias, worked out by hand. Cases: 8000
 * scenes, or GNOMON_CASES. */
#include "gn_clip.h"
#include "orders.h"
#include "scenes.h"

#include <pthread.h>

__extension__ typedef __int128 exact;
__extension__ typedef unsigned __int128 exact_u;

#define EMPTY ((gn_depth)0xffffffffu)

/* ---- brute force ----------------------------------------------------------------------------------------------- */

static exact magnitude(exact v)
{
    return v < 0 ? -v : v;
}

static exact floor_shift(exact v, int n)
{
    exact unit = (exact)1 << n, rest = v % unit;
    return (v - (rest < 0 ? rest + unit : rest)) / unit;
}

static uint64_t leading_32(exact_u v, int *exponent)
{
    for (*exponent = 0; v >> 32; ++*exponent)
        v >>= 1;
    for (; !(v >> 31); --*exponent)
        v <<= 1;
    return (uint64_t)v;
}

/* round(512 n / A) as gn_raster.h defines it; enormous where it may reach 2^40. */
static exact gradient(exact n, exact area)
{
    int n_exponent, a_exponent;
    if (n == 0)
        return 0;
    uint64_t a = leading_32((exact_u)magnitude(area), &a_exponent), m = leading_32((exact_u)magnitude(n), &n_exponent);
    exact g = (exact)(((exact_u)m * ((uint64_t)INT64_MAX / a)) >> 32);
    int exponent = n_exponent - a_exponent - 31 + 9;
    if (exponent >= 0)
        g = exponent > 8 ? (exact)1 << 100 : g << exponent; /* the quotient has 32 bits */
    else
        g = exponent < -40 ? 0 : (g + ((exact)1 << (-exponent - 1))) >> -exponent;
    return (n < 0) != (area < 0) ? -g : g;
}

/* A triangle's depths without wrapping: base + column gx + row gy. The first vertex of v anchors the plane. */
typedef struct plane {
    exact base, gx, gy;
} plane;

static plane plane_of(const gn_vertex *const v[3])
{
    exact dx1 = v[1]->x - v[0]->x, dy1 = v[1]->y - v[0]->y, dz1 = (exact)v[1]->depth - v[0]->depth;
    exact dx2 = v[2]->x - v[0]->x, dy2 = v[2]->y - v[0]->y, dz2 = (exact)v[2]->depth - v[0]->depth;
    exact area = dx1 * dy2 - dx2 * dy1;
    plane p = {0, gradient(dz1 * dy2 - dz2 * dy1, area), gradient(dz2 * dx1 - dz1 * dx2, area)};
    if (magnitude(p.gx) >> 40 || magnitude(p.gy) >> 40) { /* the whole range in 1/256 texel: the farthest vertex */
        for (int i = 0; i < 3; i++)
            p.base = 2 * (exact)v[i]->depth > p.base ? 2 * (exact)v[i]->depth : p.base;
        p.gx = p.gy = 0;
        return p;
    }
    p.base = 2 * (exact)v[0]->depth + floor_shift((128 - (exact)v[0]->x) * p.gx + (128 - (exact)v[0]->y) * p.gy, 8);
    return p;
}

static uint32_t held(exact z)
{
    return z < 0 ? 0 : z > 0xffffffff ? 0xffffffffu : (uint32_t)z;
}

static uint32_t depth_at(const plane *p, int32_t column, int32_t row)
{
    return held(p->base + column * p->gx + row * p->gy);
}

/* Farther by what the plane rises within half a texel. */
static uint32_t risen_at(const plane *p, int32_t column, int32_t row)
{
    exact half = (magnitude(p->gx) + magnitude(p->gy)) / 2;
    return held((exact)depth_at(p, column, row) + held(half));
}

static int64_t area_of(const gn_vertex *const v[3])
{
    return (int64_t)(v[1]->x - v[0]->x) * (v[2]->y - v[0]->y) - (int64_t)(v[2]->x - v[0]->x) * (v[1]->y - v[0]->y);
}

/* The top-left rule for either orientation: a centre on an edge belongs to the side whose interior lies right of a
 * left edge or below a top edge. */
static int owns(const gn_vertex *const corner[3], int32_t column, int32_t row)
{
    const gn_vertex *v[3] = {corner[0], corner[1], corner[2]};
    int64_t px = 256 * (int64_t)column + 128, py = 256 * (int64_t)row + 128;
    if (area_of(v) < 0) {
        v[1] = corner[2];
        v[2] = corner[1];
    }
    for (int i = 0; i < 3; i++) {
        const gn_vertex *a = v[i], *b = v[(i + 1) % 3];
        int64_t dx = b->x - a->x, dy = b->y - a->y, e = dx * (py - a->y) - dy * (px - a->x);
        if (e < 0 || (e == 0 && !(dy < 0 || (dy == 0 && dx > 0))))
            return 0;
    }
    return 1;
}

/* least: of depths with half a texel's slope. */
typedef struct texel {
    gn_depth z1, z2, least;
} texel;

static void insert(texel *t, gn_depth v)
{
    if (v < t->z1) {
        t->z2 = t->z1;
        t->z1 = v;
    } else if (v < t->z2) {
        t->z2 = v;
    }
}

/* -1: back faces, 1: front faces are left out. On the map, y down, a face turned to the light runs counter-clockwise:
 * its area is negative. */
static int is_culled(const gn_context *context, const gn_object *object, int64_t area)
{
    int front = area < 0;
    if (!object->mesh->closed)
        return 0;
    if (object->model) {
        const int32_t(*m)[3] = object->model->m;
        exact determinant = 0;
        for (int i = 0; i < 3; i++)
            determinant += (exact)m[0][i] * ((exact)m[1][(i + 1) % 3] * m[2][(i + 2) % 3] -
                                             (exact)m[1][(i + 2) % 3] * m[2][(i + 1) % 3]);
        front ^= determinant < 0;
    }
    return context->plan.cull == GN_CULL_BACK ? !front : context->plan.cull == GN_CULL_FRONT ? front : 0;
}

static gn_depth least(gn_depth a, gn_depth b)
{
    return a < b ? a : b;
}

/* Both layers of a map, from the vertices of the light pass that has begun. Returns the number of steep triangles. */
static uint64_t find_layers(const gn_context *context, texel *layers)
{
    uint64_t steep = 0;
    const gn_settings *s = &context->settings;
    for (int32_t i = 0; i < s->map_width * s->map_height; i++)
        layers[i].z1 = layers[i].z2 = layers[i].least = EMPTY;
    for (uint32_t o = 0; o < context->scene->object_count; o++) {
        const gn_object *object = &context->scene->objects[o];
        const gn_vertex *vertices = context->vertices + context->objects[o].first_vertex;
        for (uint32_t t = 0; t < object->mesh->triangle_count; t++) {
            uint32_t index[3];
            gn_triangle_indices(object->mesh, t, index);
            const gn_vertex *v[3] = {vertices + index[0], vertices + index[1], vertices + index[2]};
            int64_t area = area_of(v);
            if (area == 0 || is_culled(context, object, area))
                continue;
            plane p = plane_of(v);
            steep += magnitude(p.gx) >> 30 || magnitude(p.gy) >> 30;
            for (int32_t row = 0; row < s->map_height; row++) {
                for (int32_t column = 0; column < s->map_width; column++) {
                    if (!owns(v, column, row))
                        continue;
                    gn_depth z = (gn_depth)(depth_at(&p, column, row) >> (32 - GN_DEPTH_BITS));
                    if (s->surface == GN_MIXED)
                        z = (gn_depth)((z | 1) - object->mesh->closed);
                    texel *at = &layers[row * s->map_width + column];
                    insert(at, z);
                    at->least = least(at->least, (gn_depth)(risen_at(&p, column, row) >> (32 - GN_DEPTH_BITS)));
                    if (s->surface == GN_SECOND && context->plan.layers == GN_LAYERS_TWO && !object->mesh->closed)
                        insert(at, z);
                }
            }
        }
    }
    return steep;
}

static gn_depth farther_by(gn_depth z, uint64_t bias)
{
    return (gn_depth)(bias > (uint64_t)EMPTY - z ? EMPTY : z + bias);
}

/* The virtual surface of the two layers, as gnomon.h has it. */
static gn_depth surface_of(const gn_context *context, texel t)
{
    gn_depth bias = (gn_depth)(context->bias >> (32 - GN_DEPTH_BITS));
    gn_depth half = (gn_depth)(((uint64_t)t.z2 - t.z1) / 2);
    switch (context->settings.surface) {
    case GN_CONSTANT:
        return farther_by(t.z1, bias);
    case GN_MIDPOINT:
        return (gn_depth)(t.z1 + half);
    case GN_DUAL:
        return (gn_depth)(t.z1 + least(half, bias));
    case GN_SECOND:
        return farther_by(context->plan.layers == GN_LAYERS_TWO ? t.z2 : t.z1, bias);
    case GN_SLOPE:
        return farther_by(t.z1, (uint64_t)((exact)(t.least - t.z1) * context->settings.slope / 65536) + bias);
    default:
        return t.z1 & 1 ? (gn_depth)(t.z1 + least(half, bias)) : (gn_depth)(t.z2 | 1);
    }
}

/* ---- random scenes --------------------------------------------------------------------------------------------- */

/* Depths come from a few levels and corners from half texels, so that equal depths and centres on edges are common. */
static void make_scene(random_scene *r, int32_t width, int32_t height)
{
    int objects = between(1, MOST_OBJECTS), snapped = between(0, 1);
    memset(r, 0, sizeof *r);
    for (int o = 0; o < objects; o++) {
        shape *s = &r->shapes[o];
        *s = shape_new(between(0, 1));
        int vertices = between(3, 12), triangles = between(1, 12), reach = between(0, 2) ? 300 : 3000;
        int32_t x = between(0, 256 * width), y = between(0, 256 * height);
        for (int i = 0; i < vertices; i++) {
            int32_t step = snapped ? 128 : 1, z = between(0, 1) ? 100 * between(1, 5) : between(0, 65535);
            add_vertex(s, (x + between(-reach, reach)) / step * step, (y + between(-reach, reach)) / step * step, -z);
        }
        for (int i = 0; i < triangles; i++)
            add_triangle(s, (uint32_t)between(0, vertices - 1), (uint32_t)between(0, vertices - 1),
                         (uint32_t)between(0, vertices - 1));
        r->objects[o].mesh = &s->mesh;
        if (between(0, 2) == 0) { /* mirrored in x about the middle of the map */
            gn_model_identity(&r->models[o]);
            r->models[o].m[0][0] = -r->models[o].m[0][0];
            r->models[o].t[0] = 256 * width;
            r->objects[o].model = &r->models[o];
        }
    }
    r->scene.objects = r->objects;
    r->scene.object_count = (uint32_t)objects;
}

static void free_scene(random_scene *r)
{
    for (int i = 0; i < MOST_OBJECTS; i++)
        shape_free(&r->shapes[i]);
}

static const char *const surface_names[] = {"constant", "midpoint", "dual", "second", "mixed", "slope"};

static void note_case(uint64_t n, const gn_context *c)
{
    note("scene %llu: surface %s, %s, cull %d, map %dx%d, %d rows a region", (unsigned long long)n,
         surface_names[c->settings.surface], c->plan.layers == GN_LAYERS_TWO ? "two layers" : "one layer",
         (int)c->plan.cull, (int)c->settings.map_width, (int)c->settings.map_height, (int)c->plan.map_rows);
}

typedef struct tally {
    unsigned failures;
    uint64_t covered, empty, ties, two, steep, sloped;
} tally;

/* One scene: each region's layers, then its part of the map. */
static void compare_scene(uint64_t n, tally *count)
{
    static texel expected[64 * 64];
    random_scene r;
    frame f;
    int32_t width = between(1, 40), height = between(1, 40);
    gn_settings settings = random_layers(LAYER_CHOICES, 4, width, height);
    gn_light light = grid_light((uint32_t)width, (uint32_t)height);
    make_scene(&r, width, height);
    gn_status status = frame_start(&f, &r.scene, &settings);
    if (status == GN_OK)
        status = gn_light_begin(f.context, &light);
    if (!(status == GN_OK) && count->failures++ < 5)
        note("scene %llu: status %d", (unsigned long long)n, (int)status);
    if (status == GN_OK)
        count->steep += find_layers(f.context, expected);
    for (uint32_t region = 0; status == GN_OK && region < f.plan.light_regions; region++) {
        uint32_t first, rows, stride;
        status = gn_light_layers(f.context, region, 0);
        int slope = settings.surface == GN_SLOPE;
        for (uint32_t layer = 0; layer < (slope || f.plan.layers == GN_LAYERS_TWO ? 2u : 1u); layer++) {
            const gn_depth *got = gn_layer(f.context, layer, region, 0, &first, &rows, &stride);
            for (uint32_t i = 0; i < rows * (uint32_t)width; i++) {
                uint32_t column = i % (uint32_t)width, row = i / (uint32_t)width;
                texel e = expected[(first + row) * (uint32_t)width + column];
                gn_depth z = layer ? slope ? e.least : e.z2 : e.z1;
                count->covered += e.z1 != EMPTY;
                count->empty += e.z1 == EMPTY;
                count->ties += layer && !slope && e.z1 != EMPTY && e.z1 == e.z2;
                count->two += layer && !slope && e.z2 != EMPTY;
                count->sloped += layer && slope && e.least != e.z1;
                if (got[row * stride + column] != z && count->failures++ < 5) {
                    note_case(n, f.context);
                    note("layer %u, texel (%u, %u): got %lu, expected %lu", (unsigned)layer + 1, (unsigned)column,
                         (unsigned)(first + row), (unsigned long)got[row * stride + column], (unsigned long)z);
                }
            }
        }
        if (status == GN_OK)
            status = gn_light_resolve(f.context, region, 0);
    }
    for (int32_t i = 0; status == GN_OK && i < width * height; i++) {
        gn_depth got = texel_at(f.context, (uint32_t)(i % width), (uint32_t)(i / width));
        gn_depth z = surface_of(f.context, expected[i]);
        if (got != z && count->failures++ < 5) {
            note_case(n, f.context);
            note("map, texel (%d, %d): got %lu, expected %lu of z1 %lu, z2 %lu, least %lu, bias %lu, slope %ld / 65536",
                 (int)(i % width), (int)(i / width), (unsigned long)got, (unsigned long)z,
                 (unsigned long)expected[i].z1, (unsigned long)expected[i].z2, (unsigned long)expected[i].least,
                 (unsigned long)f.context->bias, (long)settings.slope);
        }
    }
    count->failures += status != GN_OK;
    if (!frame_end(&f) && count->failures++ < 5)
        note("scene %llu: wrote outside its block", (unsigned long long)n);
    free_scene(&r);
}

static void layers_are_the_two_nearest(uint64_t cases)
{
    tally count;
    memset(&count, 0, sizeof count);
    for (uint64_t n = 0; n < cases && count.failures < 5; n++)
        compare_scene(n, &count);
    ok(!count.failures, "layers and maps equal brute force, in %llu scenes", (unsigned long long)cases);
    ok(count.covered > 10000 && count.empty > 10000 && count.ties > 500 && count.two > 5000 && count.steep > 1000 &&
           count.sloped > 5000,
       "%llu covered and %llu empty texels, %llu with two layers, %llu of them ties, %llu with a slope; %llu steep "
       "triangles",
       (unsigned long long)count.covered, (unsigned long long)count.empty, (unsigned long long)count.two,
       (unsigned long long)count.ties, (unsigned long long)count.sloped, (unsigned long long)count.steep);
}

/* Rounding may turn over a piece of a clipped triangle; it may not make a texel meet the triangle twice. */
static void clipped_triangles_count_once(uint64_t cases)
{
    uint64_t covered = 0, twice = 0, clipped = 0;
    for (uint64_t n = 0; n < cases; n++) {
        shape s = shape_new(0);
        gn_object object = {&s.mesh, 0, {0, 0, 0}};
        gn_scene scene = {&object, 1, {0, 0, 0}, 0};
        gn_light light;
        frame f;
        int32_t position[3] = {0, 0, 0}, target[3] = {between(-50, 50), between(-50, 50), -100};
        gn_settings settings = gn_default_settings(4, 4, 64);
        settings.surface = GN_MIDPOINT;
        uint32_t reach = 1u << between(12, 22);
        for (int i = 0; i < 3; i++)
            add_vertex(&s, between(-(int64_t)reach, reach), between(-(int64_t)reach, reach),
                       between(-(int64_t)reach, reach));
        add_triangle(&s, 0, 1, 2);
        gn_status status =
            gn_spot_light(&light, position, target, 0, GN_DEGREES(between(20, 120)), 1 << between(8, 18), 1 << 21);
        if (status == GN_OK)
            status = frame_start(&f, &scene, &settings);
        if (status == GN_OK)
            status = gn_light_begin(f.context, &light);
        if (status == GN_OK)
            status = gn_light_layers(f.context, 0, 0);
        uint32_t first, rows, stride;
        const gn_depth *z1 = status == GN_OK ? gn_layer(f.context, 0, 0, 0, &first, &rows, &stride) : 0;
        const gn_depth *z2 = status == GN_OK ? gn_layer(f.context, 1, 0, 0, &first, &rows, &stride) : 0;
        for (uint32_t i = 0; z1 && i < 64 * 64; i++) {
            uint32_t at = i / 64 * stride + i % 64;
            covered += z1[at] != EMPTY;
            if (z2[at] != EMPTY && twice++ < 3)
                note("case %llu, texel (%u, %u): covered twice", (unsigned long long)n, (unsigned)i % 64,
                     (unsigned)i / 64);
        }
        clipped += status == GN_OK && f.context->objects[0].clips;
        if (f.block)
            frame_end(&f);
        shape_free(&s);
    }
    ok(!twice, "clipped triangles count once: %llu texels, %llu of them twice", (unsigned long long)covered,
       (unsigned long long)twice);
    ok(clipped > cases / 2 && covered > cases, "%llu triangles were clipped", (unsigned long long)clipped);
}

/* ---- order, regions, workers ----------------------------------------------------------------------------------- */

static uint64_t hash_map(const gn_context *context)
{
    uint64_t h = 1;
    for (uint32_t row = 0; row < context->settings.map_height; row++)
        for (uint32_t column = 0; column < context->settings.map_width; column++)
            h = (h ^ texel_at(context, column, row)) * UINT64_C(0x100000001b3);
    return h;
}

static void maps_do_not_depend_on_order_regions_workers(uint64_t cases)
{
    static const char *const what[] = {"the order of triangles and objects", "the height of regions", "workers",
                                       "a second pass"};
    unsigned failures[4] = {0};
    uint64_t different = 0, last = 0;
    for (uint64_t n = 0; n < cases; n++) {
        random_scene r;
        int32_t width = between(1, 40), height = between(1, 40);
        gn_settings settings = random_layers(LAYER_CHOICES, 4, width, height);
        gn_light light = grid_light((uint32_t)width, (uint32_t)height);
        make_scene(&r, width, height);
        uint64_t hash[5];
        for (int variant = 0; variant < 5; variant++) {
            gn_settings s = settings;
            frame f;
            if (variant == 1)
                shuffle(&r);
            if (variant == 2)
                s.map_rows = (uint16_t)between(1, height);
            if (variant == 3) {
                s.map_rows = (uint16_t)between(1, 5);
                s.workers = (uint8_t)between(2, 4);
            }
            gn_status status = frame_start(&f, &r.scene, &s);
            if (status == GN_OK)
                status = variant == 3 ? light_pass_on_threads(f.context, &light, s.workers)
                                      : gn_light_pass(f.context, &light);
            if (variant == 4 && status == GN_OK) /* the map holds no trace of the last pass */
                status = gn_light_pass(f.context, &light);
            hash[variant] = status == GN_OK ? hash_map(f.context) : (uint64_t)variant;
            if (status == GN_OK && variant && hash[variant] != hash[0] && failures[variant - 1]++ < 2) {
                note_case(n, f.context);
                note("the map depends on %s", what[variant - 1]);
            }
            if (status != GN_OK && failures[0]++ < 3)
                note("scene %llu: status %d", (unsigned long long)n, (int)status);
            failures[3] += !frame_end(&f);
        }
        different += hash[0] != last;
        last = hash[0];
        free_scene(&r);
    }
    for (int i = 0; i < 4; i++)
        ok(!failures[i], "maps do not depend on %s, in %llu scenes", what[i], (unsigned long long)cases);
    ok(different > cases * 9 / 10, "nearly all maps differ");
}

/* ---- by hand --------------------------------------------------------------------------------------------------- */

typedef struct level {
    int depth;
    char kind; /* 'o': open, 'f': closed, turned to the light; 'b': closed, turned away */
} level;

typedef struct by_hand {
    const char *name;
    uint8_t surface, layers, cull;
    uint32_t bias; /* units of depth, of 65535 */
    level levels[4];
    int expected[2]; /* in half units of depth, 16-bit; 32-bit: see half_depth. -1: empty */
} by_hand;

#define AUTO GN_LAYERS_AUTO, GN_CULL_AUTO
#define NO_CULL GN_LAYERS_AUTO, GN_CULL_NONE

/* expected: the depth in whole units, and 1 where half a unit more is lost in 16 bits and kept in 32. */
static const by_hand cases_by_hand[] = {
    {"constant: z1 + b", GN_CONSTANT, NO_CULL, 7, {{100, 'o'}, {200, 'o'}}, {107, 0}},
    {"constant, no bias", GN_CONSTANT, NO_CULL, 0, {{200, 'f'}, {100, 'b'}}, {100, 0}},
    {"constant: nothing there", GN_CONSTANT, NO_CULL, 7, {{0, 0}}, {-1, 0}},
    {"constant: saturates at the end of the range", GN_CONSTANT, NO_CULL, 100, {{65500, 'o'}}, {-1, 0}},
    {"constant: back faces culled", GN_CONSTANT, GN_LAYERS_AUTO, GN_CULL_BACK, 0, {{100, 'b'}, {200, 'f'}}, {200, 0}},
    {"constant: front faces culled", GN_CONSTANT, GN_LAYERS_AUTO, GN_CULL_FRONT, 0, {{100, 'f'}, {200, 'b'}}, {200, 0}},
    {"constant: open ones are never culled",
     GN_CONSTANT,
     GN_LAYERS_AUTO,
     GN_CULL_FRONT,
     0,
     {{100, 'o'}, {200, 'b'}},
     {100, 0}},
    {"midpoint", GN_MIDPOINT, NO_CULL, 0, {{100, 'o'}, {200, 'o'}}, {150, 0}},
    {"midpoint: half a unit is cut", GN_MIDPOINT, NO_CULL, 0, {{100, 'o'}, {201, 'o'}}, {150, 1}},
    {"midpoint of three", GN_MIDPOINT, NO_CULL, 0, {{300, 'o'}, {100, 'f'}, {200, 'b'}}, {150, 0}},
    {"midpoint of a tie", GN_MIDPOINT, NO_CULL, 0, {{100, 'o'}, {100, 'o'}, {200, 'o'}}, {100, 0}},
    {"midpoint: nothing there", GN_MIDPOINT, NO_CULL, 0, {{0, 0}}, {-1, 0}},
    {"midpoint with back faces culled",
     GN_MIDPOINT,
     GN_LAYERS_AUTO,
     GN_CULL_BACK,
     0,
     {{100, 'f'}, {110, 'b'}, {200, 'f'}},
     {150, 0}},
    {"dual: the bias is less than half the gap", GN_DUAL, NO_CULL, 7, {{100, 'o'}, {200, 'o'}}, {107, 0}},
    {"dual: half the gap is less than the bias", GN_DUAL, NO_CULL, 70, {{100, 'o'}, {200, 'o'}}, {150, 0}},
    {"dual: equal", GN_DUAL, NO_CULL, 50, {{100, 'o'}, {200, 'o'}}, {150, 0}},
    {"dual: one layer keeps the bias", GN_DUAL, NO_CULL, 70, {{100, 'o'}}, {170, 0}},
    {"dual: near the end half the gap is less", GN_DUAL, NO_CULL, 200, {{65435, 'o'}}, {65485, 0}},
    {"dual: nothing there", GN_DUAL, NO_CULL, 7, {{0, 0}}, {-1, 0}},
    {"dual culls back faces of itself", GN_DUAL, AUTO, 70, {{100, 'f'}, {110, 'b'}, {400, 'f'}}, {170, 0}},
    {"second: z2 + b of closed meshes",
     GN_SECOND,
     GN_LAYERS_TWO,
     GN_CULL_NONE,
     9,
     {{200, 'b'}, {100, 'f'}, {300, 'f'}},
     {209, 0}},
    {"second: an open one is a solid of its own",
     GN_SECOND,
     GN_LAYERS_TWO,
     GN_CULL_NONE,
     9,
     {{100, 'o'}, {200, 'b'}},
     {109, 0}},
    {"second: an open one behind a closed front",
     GN_SECOND,
     GN_LAYERS_TWO,
     GN_CULL_NONE,
     9,
     {{100, 'f'}, {150, 'o'}, {200, 'b'}},
     {159, 0}},
    {"second: an open one behind both",
     GN_SECOND,
     GN_LAYERS_TWO,
     GN_CULL_NONE,
     9,
     {{100, 'f'}, {350, 'o'}, {200, 'b'}},
     {209, 0}},
    {"second: a tie counts twice",
     GN_SECOND,
     GN_LAYERS_TWO,
     GN_CULL_NONE,
     9,
     {{100, 'f'}, {100, 'f'}, {200, 'b'}},
     {109, 0}},
    {"second: one closed layer leaves nothing", GN_SECOND, GN_LAYERS_TWO, GN_CULL_NONE, 9, {{100, 'f'}}, {-1, 0}},
    {"second: nothing there", GN_SECOND, GN_LAYERS_TWO, GN_CULL_NONE, 9, {{9, 0}}, {-1, 0}},
    {"second: the back layer",
     GN_SECOND,
     GN_LAYERS_FIRST,
     GN_CULL_FRONT,
     9,
     {{100, 'f'}, {200, 'b'}, {300, 'f'}},
     {209, 0}},
    {"second: the back layer keeps open ones",
     GN_SECOND,
     GN_LAYERS_FIRST,
     GN_CULL_FRONT,
     9,
     {{100, 'f'}, {150, 'o'}, {200, 'b'}},
     {159, 0}},
    {"second of closed meshes chooses the back layer",
     GN_SECOND,
     AUTO,
     9,
     {{100, 'b'}, {50, 'f'}, {60, 'f'}},
     {109, 0}},
    {"second of a scene with an open mesh chooses two",
     GN_SECOND,
     AUTO,
     9,
     {{100, 'b'}, {50, 'f'}, {60, 'f'}, {900, 'o'}},
     {69, 0}},
    {"second: no bias", GN_SECOND, GN_LAYERS_TWO, GN_CULL_NONE, 0, {{200, 'b'}, {100, 'f'}, {300, 'f'}}, {200, 0}},
    {"second: the back layer without a bias", GN_SECOND, AUTO, 0, {{200, 'b'}, {100, 'f'}}, {200, 0}},
    {"second: saturates at the end of the range", GN_SECOND, GN_LAYERS_TWO, GN_CULL_NONE, 100, {{65500, 'o'}}, {-1, 0}},
    {"second: the back layer saturates", GN_SECOND, AUTO, 100, {{65500, 'b'}}, {-1, 0}},
    {"slope of what is level: z1 + b", GN_SLOPE, NO_CULL, 7, {{100, 'o'}, {200, 'o'}}, {107, 0}},
    {"slope: nothing there", GN_SLOPE, NO_CULL, 7, {{0, 0}}, {-1, 0}},
    {"slope: saturates at the end of the range", GN_SLOPE, NO_CULL, 100, {{65500, 'o'}}, {-1, 0}},
    {"slope: back faces culled", GN_SLOPE, GN_LAYERS_AUTO, GN_CULL_BACK, 0, {{100, 'b'}, {200, 'f'}}, {200, 0}},
    {"slope: front faces culled", GN_SLOPE, GN_LAYERS_AUTO, GN_CULL_FRONT, 0, {{100, 'f'}, {200, 'b'}}, {200, 0}},
};

/* Other ways to the same map: in y the other way round; both x and y; levels so large that they are clipped. */
typedef enum variant { PLAIN, MIRRORED, TURNED, CLIPPED, CLIPPED_MIRRORED, VARIANTS } variant;

static void render_by_hand(const by_hand *c, variant how)
{
    static const char *const variant_names[VARIANTS] = {"", ", mirrored", ", turned", ", clipped",
                                                        ", clipped and mirrored"};
    shape shapes[4];
    gn_object objects[4];
    gn_model model;
    gn_scene scene;
    frame f;
    int mirrored = how == MIRRORED || how == CLIPPED_MIRRORED, clipped = how == CLIPPED || how == CLIPPED_MIRRORED;
    int32_t least = clipped ? -(1 << 22) : -300, most = clipped ? 1 << 22 : 2000;
    memset(objects, 0, sizeof objects);
    memset(&scene, 0, sizeof scene);
    gn_model_identity(&model);
    model.m[1][1] = -model.m[1][1];
    model.t[1] = 1024;
    if (how == TURNED) {
        model.m[0][0] = -model.m[0][0];
        model.t[0] = 1024;
    }
    for (int i = 0; i < 4; i++) {
        shapes[i] = shape_new(c->levels[i].kind != 'o');
        if (!c->levels[i].kind)
            continue;
        add_level(&shapes[i], least, least, most, most, -c->levels[i].depth, (c->levels[i].kind != 'b') ^ mirrored);
        if (mirrored) /* order as if unmirrored, in a mesh that the model mirrors */
            for (uint32_t k = 0; k < 2; k++) {
                uint32_t index = shapes[i].indices[3 * k];
                shapes[i].indices[3 * k] = shapes[i].indices[3 * k + 1];
                shapes[i].indices[3 * k + 1] = index;
            }
        objects[scene.object_count].model = mirrored || how == TURNED ? &model : 0;
        objects[scene.object_count++].mesh = &shapes[i].mesh;
    }
    scene.objects = objects;
    gn_settings s = gn_default_settings(4, 4, 4);
    gn_light light = grid_light(4, 4);
    s.surface = c->surface;
    s.layers = c->layers;
    s.cull = c->cull;
    s.bias.unit = GN_BIAS_WORLD;
    s.bias.value = c->bias;
    s.slope = 3 << 15; /* of GN_SLOPE alone */
    gn_status status = frame_start(&f, &scene, &s);
    if (status == GN_OK)
        status = gn_light_pass(f.context, &light);
    gn_depth expected = EMPTY;
    if (c->expected[0] >= 0)
        expected =
            (gn_depth)(grid_depth((uint32_t)c->expected[0]) + (GN_DEPTH_BITS == 32 ? 32768 * c->expected[1] : 0));
    /* an empty second layer is not at the end of the range but at the end of the format */
    int near_end = c->surface == GN_DUAL && c->expected[0] == 65485;
    if (near_end)
        expected = (gn_depth)(grid_depth(65435) + (EMPTY - grid_depth(65435)) / 2);
    int good = status == GN_OK;
    for (uint32_t i = 0; good && i < 16; i++) {
        gn_depth got = texel_at(f.context, i % 4, i / 4);
        if (got != expected) {
            note("texel (%u, %u): got %lu, expected %lu", (unsigned)i % 4, (unsigned)i / 4, (unsigned long)got,
                 (unsigned long)expected);
            good = 0;
        }
    }
    good &= frame_end(&f);
    if (!ok(good, "%s%s", c->name, variant_names[how]))
        note("status %d", (int)status);
    for (int i = 0; i < 4; i++)
        shape_free(&shapes[i]);
}

static void surfaces_by_hand(void)
{
    for (size_t i = 0; i < sizeof cases_by_hand / sizeof cases_by_hand[0]; i++)
        for (int how = 0; how < VARIANTS; how++)
            render_by_hand(&cases_by_hand[i], (variant)how);
}

/* One texel of a map of two layers, for cases that depend on the format's own units: depths are set by distances in a
 * box of 65535 units, marks take the lowest bit. */
static void mixed_by_hand(void)
{
    static const struct {
        const char *name;
        level levels[3];
        uint32_t bias, z1, z2; /* units; the nearest layer and the next, of which the expected value is made */
        char expect;           /* '2': z2, 'd': dual, 'h': midpoint, 'e': empty */
        char open1, open2;     /* marks */
    } cases[] = {
        {"mixed: second depth where the nearest is closed",
         {{100, 'f'}, {200, 'b'}, {50000, 'o'}},
         9,
         100,
         200,
         '2',
         0,
         0},
        {"mixed: open second layer", {{100, 'f'}, {200, 'o'}, {300, 'b'}}, 9, 100, 200, '2', 0, 1},
        {"mixed: dual where the nearest is open, bias", {{100, 'o'}, {200, 'f'}, {300, 'b'}}, 9, 100, 200, 'd', 1, 0},
        {"mixed: dual where the nearest is open, half the gap",
         {{100, 'o'}, {110, 'o'}, {300, 'b'}},
         9,
         100,
         110,
         'h',
         1,
         1},
        {"mixed: closed wins a tie", {{100, 'o'}, {100, 'f'}, {200, 'b'}}, 9, 100, 100, '2', 0, 1},
        {"mixed: closed wins a tie, the other order", {{100, 'f'}, {100, 'o'}, {200, 'b'}}, 9, 100, 100, '2', 0, 1},
        {"mixed: nothing there", {{0, 0}}, 9, 0, 0, 'e', 0, 0},
    };
    for (size_t n = 0; n < sizeof cases / sizeof cases[0]; n++) {
        shape shapes[3];
        gn_object objects[3];
        gn_scene scene;
        frame f;
        memset(objects, 0, sizeof objects);
        memset(&scene, 0, sizeof scene);
        for (int i = 0; i < 3; i++) {
            shapes[i] = shape_new(cases[n].levels[i].kind != 'o');
            if (!cases[n].levels[i].kind)
                continue;
            add_level(&shapes[i], -300, -300, 2000, 2000, -cases[n].levels[i].depth, cases[n].levels[i].kind != 'b');
            objects[scene.object_count++].mesh = &shapes[i].mesh;
        }
        scene.objects = objects;
        gn_settings s = gn_default_settings(4, 4, 4);
        gn_light light = grid_light(4, 4);
        s.surface = GN_MIXED;
        s.bias.unit = GN_BIAS_WORLD;
        s.bias.value = cases[n].bias;
        gn_status status = frame_start(&f, &scene, &s);
        if (status == GN_OK)
            status = gn_light_pass(f.context, &light);
        gn_depth got = status == GN_OK ? texel_at(f.context, 1, 2) : 0, expected = EMPTY;
        uint32_t z1 = (grid_depth(cases[n].z1) & ~1u) + (uint32_t)cases[n].open1;
        uint32_t z2 = (grid_depth(cases[n].z2) & ~1u) + (uint32_t)cases[n].open2;
        if (cases[n].expect == '2')
            expected = (gn_depth)(z2 | 1); /* what lies in its unit is lit */
        if (cases[n].expect == 'd')
            expected = (gn_depth)(z1 + grid_bias(cases[n].bias));
        if (cases[n].expect == 'h')
            expected = (gn_depth)(z1 + (z2 - z1) / 2);
        if (!ok(got == expected && frame_end(&f), "%s", cases[n].name))
            note("status %d, got %lu, expected %lu", (int)status, (unsigned long)got, (unsigned long)expected);
        for (int i = 0; i < 3; i++)
            shape_free(&shapes[i]);
    }
}

/* Depths of an inclined plane, exactly: 16 units of depth a texel in x, -32 in y. */
static void inclined_planes_by_hand(void)
{
    shape s = shape_new(0);
    gn_object object;
    gn_scene scene;
    frame f;
    memset(&object, 0, sizeof object);
    memset(&scene, 0, sizeof scene);
    /* corners on texel borders, a power of two of 16 texels: the gradients are exact in binary */
    int32_t a[3] = {0, 0, -10000}, b[3] = {4096, 0, -10256}, c[3] = {4096, 4096, -9744}, d[3] = {0, 4096, -9488};
    add_quad(&s, a, b, c, d);
    object.mesh = &s.mesh;
    scene.objects = &object;
    scene.object_count = 1;
    gn_settings settings = gn_default_settings(4, 4, 16);
    gn_light light = grid_light(16, 16);
    settings.surface = GN_CONSTANT;
    settings.bias.value = 0;
    gn_status status = frame_start(&f, &scene, &settings);
    if (status == GN_OK)
        status = gn_light_pass(f.context, &light);
    unsigned failures = status != GN_OK;
    for (uint32_t i = 0; i < 256 && status == GN_OK; i++) {
        uint32_t column = i % 16, row = i / 16;
        /* at the centre; y = 0 is the last row's lower border. In half units: 32 column + 16, - 64 (15 - row) - 32 */
        uint32_t half_units = 20000 + 32 * column + 16 - 64 * (15 - row) - 32;
        uint32_t expected = half_units * 32768 + 32768;
        gn_depth got = texel_at(f.context, column, row);
        if (got != (gn_depth)(expected >> (32 - GN_DEPTH_BITS)) && failures++ < 3)
            note("texel (%u, %u): got %lu, expected %lu", (unsigned)column, (unsigned)row, (unsigned long)got,
                 (unsigned long)(expected >> (32 - GN_DEPTH_BITS)));
    }
    ok(!failures && frame_end(&f), "depths of an inclined plane, by hand");
    shape_free(&s);
}

/* The same plane, whose h is 24 units, and a level one that cuts through it: m is the lesser of z + 24 and the level
 * one's depth. */
static void slopes_by_hand(void)
{
    static const struct {
        gn_q16_16 slope;
        uint32_t bias;
    } cases[] = {{0, 0}, {0, 5}, {1 << 15, 0}, {1 << 16, 0}, {3 << 15, 0}, {2 << 16, 3}, {64 << 16, 0}, {1, 0}};
    for (size_t n = 0; n < sizeof cases / sizeof cases[0]; n++) {
        shape incline = shape_new(0), wall = shape_new(0);
        gn_object objects[2] = {{&incline.mesh, 0, {0, 0, 0}}, {&wall.mesh, 0, {0, 0, 0}}};
        gn_scene scene = {objects, 2, {0, 0, 0}, 0};
        frame f;
        /* 16 units of depth a texel in x, 32 in y: in half units 2 x 10000 + 32 column + 16 + 64 row + 32, y = 0 below
         */
        int32_t a[3] = {0, 0, -10512}, b[3] = {4096, 0, -10768}, c[3] = {4096, 4096, -10256}, d[3] = {0, 4096, -10000};
        enum { LEVEL = 10400 };
        add_quad(&incline, a, b, c, d);
        add_level(&wall, 0, 0, 4096, 4096, -LEVEL, 1);
        gn_settings settings = gn_default_settings(4, 4, 16);
        gn_light light = grid_light(16, 16);
        settings.surface = GN_SLOPE;
        settings.bias.unit = GN_BIAS_WORLD;
        settings.bias.value = cases[n].bias;
        settings.slope = cases[n].slope;
        gn_status status = frame_start(&f, &scene, &settings);
        if (status == GN_OK)
            status = gn_light_pass(f.context, &light);
        unsigned failures = status != GN_OK, by_level = 0, by_incline = 0, behind = 0;
        for (uint32_t i = 0; i < 256 && status == GN_OK; i++) {
            uint32_t column = i % 16, row = i / 16;
            uint64_t unit = 65536, slant = 10000 * unit + (16 * column + 8 + 32 * row + 16) * unit + 32768;
            uint64_t level_depth = LEVEL * unit + 32768, z1 = slant < level_depth ? slant : level_depth;
            uint64_t m = slant + 24 * unit < level_depth ? slant + 24 * unit : level_depth;
            z1 >>= 32 - GN_DEPTH_BITS;
            m >>= 32 - GN_DEPTH_BITS;
            by_incline += m != z1 && m != level_depth >> (32 - GN_DEPTH_BITS);
            by_level += m != z1 && m == level_depth >> (32 - GN_DEPTH_BITS);
            behind += m == z1;
            uint64_t expected =
                z1 + (m - z1) * (uint32_t)cases[n].slope / 65536 + (cases[n].bias * unit >> (32 - GN_DEPTH_BITS));
            gn_depth got = texel_at(f.context, column, row);
            if (got != expected && failures++ < 3)
                note("texel (%u, %u): got %lu, expected %lu of z1 %lu, m %lu", (unsigned)column, (unsigned)row,
                     (unsigned long)got, (unsigned long)expected, (unsigned long)z1, (unsigned long)m);
        }
        ok(!failures && by_level && by_incline && behind && frame_end(&f),
           "slope %ld / 65536, bias %lu, by hand: m by the slope in %u texels, by the level plane in %u, and z1 in %u",
           (long)cases[n].slope, (unsigned long)cases[n].bias, by_incline, by_level, behind);
        shape_free(&incline);
        shape_free(&wall);
    }
}

/* The bias in units of a 32-bit depth for a light; 0 on failure. */
static uint32_t bias_of(const gn_light *light, uint16_t width, uint16_t height, uint8_t unit, uint32_t value)
{
    gn_scene scene;
    frame f;
    memset(&scene, 0, sizeof scene);
    gn_settings s = gn_default_settings(4, 4, 4);
    s.map_width = width;
    s.map_height = height;
    s.surface = GN_CONSTANT;
    s.bias.unit = unit;
    s.bias.value = value;
    gn_status status = frame_start(&f, &scene, &s);
    if (status == GN_OK)
        status = gn_light_begin(f.context, light);
    uint32_t bias = status == GN_OK ? f.context->bias : 0;
    if (status != GN_OK)
        note("status %d", (int)status);
    frame_end(&f);
    return bias;
}

static void bias_is(const char *name, uint32_t got, double expected)
{
    double error = got - expected;
    error = error < 0 ? -error : error;
    /* a handful of roundings of 2^-29 each */
    if (!ok(error <= 1 + expected / (1 << 26), "bias: %s", name))
        note("got %lu, expected %.2f", (unsigned long)got, expected);
}

static void bias_units_by_hand(void)
{
    gn_light box = grid_light(64, 64), spot;
    int32_t position[3] = {0, 0, 0}, target[3] = {0, 0, -1};
    double span = 4294967296.0 - 65536; /* of the stored range, 2 GN_DEPTH_SPAN */
    bias_is("none", bias_of(&box, 64, 64, GN_BIAS_WORLD, 0), 0);
    bias_is("world units of a directional light", bias_of(&box, 64, 64, GN_BIAS_WORLD, 3), 3 * 65536.0);
    bias_is("a texel is 256 units wide", bias_of(&box, 64, 64, GN_BIAS_TEXELS, 2 << 16), 2 * 256 * 65536.0);
    bias_is("half a texel", bias_of(&box, 64, 64, GN_BIAS_TEXELS, 1 << 15), 128 * 65536.0);
    bias_is("the mean of a texel's width and height", bias_of(&box, 64, 32, GN_BIAS_TEXELS, 1 << 16), 384 * 65536.0);
    bias_is("half the range", bias_of(&box, 64, 64, GN_BIAS_RANGE, 0x80000000u), span / 2);
    bias_is("0.02 of the range", bias_of(&box, 64, 64, GN_BIAS_RANGE, 85899346), 0.02 * span);
    bias_is("more than the range saturates", bias_of(&box, 64, 64, GN_BIAS_WORLD, 70000), 4294967295.0);
    bias_is("the most world units saturate", bias_of(&box, 64, 64, GN_BIAS_WORLD, 1u << 28), 4294967295.0);
    bias_is("the most texels saturate", bias_of(&box, 1, 1, GN_BIAS_TEXELS, 0xffffffffu), 4294967295.0);
    /* at w = sqrt(n f) a world unit is 1/(f - n) of the range */
    gn_spot_light(&spot, position, target, 0, GN_DEGREES(90), 16, 16 + 32768);
    bias_is("world units of a spot light", bias_of(&spot, 64, 64, GN_BIAS_WORLD, 3), 3 * span / 32768);
    bias_is("half the range of a spot light", bias_of(&spot, 64, 64, GN_BIAS_RANGE, 0x80000000u), span / 2);
    /* n = 16, f = 1024: w = 128, a texel of 64 at 90 degrees is 2 x 128 / 64 = 4 wide there */
    gn_spot_light(&spot, position, target, 0, GN_DEGREES(90), 16, 1024);
    bias_is("texels of a spot light", bias_of(&spot, 64, 64, GN_BIAS_TEXELS, 2 << 16), 8 * span / 1008);
    bias_is("the mean of both axes, spot", bias_of(&spot, 64, 32, GN_BIAS_TEXELS, 2 << 16), 12 * span / 1008);
}

int main(int argc, char **argv)
{
    uint64_t cases = tap_cases(argc, argv, 8000);
    surfaces_by_hand();
    mixed_by_hand();
    inclined_planes_by_hand();
    slopes_by_hand();
    bias_units_by_hand();
    layers_are_the_two_nearest(cases);
    clipped_triangles_count_once(2 * cases);
    maps_do_not_depend_on_order_regions_workers(cases / 3);
    return tap_done();
}
