/* The inner loops with vectors and without write the same layers, the same Q and triangles, the same answers of the
 * shadow test, with one texel and with virtual samples. The library holds one of the two; the other is compiled here
 * from the same sources, under other names, and works on the library's own contexts. Cases: 6000 scenes, or
 * GNOMON_CASES. */
#include "gn_vector.h"

enum { LIBRARY_HAS_VECTORS = GN_VECTOR };
#undef GN_VECTOR
#undef GN_VECTOR_16
#undef GN_ROW_PADDING
#undef GN_VECTOR_H
/* gn_vector.h once more, now with the other choice. What it types is the same in both, and guarded by this file. */
#if defined __GNUC__ && defined __AVX2__
#define GN_VECTOR 0
#define GN_VECTOR_16 0
#else
#define GN_VECTOR 1
#define GN_VECTOR_16 1
#pragma GCC diagnostic ignored "-Wpsabi"
#endif
#include "scenes.h"

/* The cascade is in blocks of its own, which change no pixel. */
#define GN_BLOCK 7

/* The light pass. */
#define gn_draw_rows twin_draw_rows
#define gn_nearest_row twin_nearest_row
#define gn_light_begin twin_light_begin
#define gn_light_pass twin_light_pass
#define gn_light_layers twin_light_layers
#define gn_light_resolve twin_light_resolve
#define gn_layer twin_layer
void gn_nearest_row(gn_context *context, uint32_t worker, int32_t row, gn_depth *depths);
gn_status gn_light_begin(gn_context *context, const gn_light *light);
gn_status gn_light_pass(gn_context *context, const gn_light *light);
gn_status gn_light_layers(gn_context *context, uint32_t region, uint32_t worker);
gn_status gn_light_resolve(gn_context *context, uint32_t region, uint32_t worker);
const gn_depth *gn_layer(const gn_context *context, uint32_t layer, uint32_t region, uint32_t worker,
                         uint32_t *first_row, uint32_t *rows, uint32_t *stride);
#include "gn_light_pass.c"
#undef gn_draw_rows
#undef gn_nearest_row
#undef gn_light_begin
#undef gn_light_pass
#undef gn_light_layers
#undef gn_light_resolve
#undef gn_layer
#undef count_triangle

/* Visibility: its own target, its own spans. */
#define target visible_target
#define clear clear_visible
#define count_span count_visible_span
#define count_triangle count_visible_triangle
#define gn_rasterise_region twin_rasterise_region
void gn_rasterise_region(gn_context *context, gn_worker *worker, const gn_window *window);
#include "gn_visibility.c"
#undef target
#undef clear
#undef count_span
#undef gn_rasterise_region

/* The cascade, with votes of its own where there are no vectors. */
#include "gn_cascade.h"
#define make_lookup make_cascade_lookup
#define test_box test_box_of_points
#define compare compare_vote
#define gn_point_bits twin_point_bits
#define gn_start_points twin_start_points
#define gn_find_points twin_find_points
#define gn_cascade_row twin_cascade_row
#define gn_virtual twin_virtual
#define gn_virtual_always twin_virtual_always
#define gn_vote_around twin_vote_around
#define gn_vote_nearest twin_vote_nearest
#define gn_sample_nearest twin_sample_nearest
#define gn_settle twin_settle
#define gn_look_at_border twin_look_at_border
#define gn_look_beyond twin_look_beyond
#define gn_silhouettes twin_silhouettes
uint32_t gn_point_bits(const gn_context *context);
void gn_start_points(const gn_context *context, gn_points *points);
void gn_find_points(const gn_context *context, gn_points *points, uint32_t *q);
void gn_cascade_row(gn_context *context, gn_worker *worker, uint32_t from, int32_t x, int32_t y, int32_t count);
#include "gn_around.c"
#include "gn_cascade.c"
#include "gn_points.c"
#include "gn_virtual.c"
#define sample sample_quadrant
#include "gn_quadrants.c"
#undef sample
#undef make_lookup
#undef test_box
#undef compare
#undef gn_point_bits
#undef gn_start_points
#undef gn_find_points
#undef gn_cascade_row
#undef gn_virtual
#undef gn_virtual_always
#undef gn_vote_around
#undef gn_sample_nearest
#undef gn_settle
#undef gn_look_at_border
#undef gn_look_beyond
#undef gn_silhouettes
#undef OUTSIDE

/* The shadow test. */
#define gn_shade_row twin_shade_row
#define gn_falloff_row twin_falloff_row
#define gn_row_of_w twin_row_of_w
#define gn_over_distance twin_over_distance
void gn_shade_row(const gn_context *context, uint32_t *q, int32_t x, int32_t y, int32_t count);
void gn_falloff_row(const gn_context *context, uint32_t *q, int32_t x, int32_t y, int32_t count);
void gn_row_of_w(uint32_t *q, int32_t count, uint32_t shift);
uint32_t gn_over_distance(uint32_t nearness, uint32_t u, uint32_t v, uint32_t tan_squared);
#include "gn_shade.c"
#undef gn_shade_row
#undef gn_falloff_row
#undef gn_row_of_w
#undef gn_over_distance

/* ---- scenes ---------------------------------------------------------------------------------------------------- */

enum { MOST_OBJECTS = 3, SLACK = 256 };

typedef struct random_scene {
    shape shapes[MOST_OBJECTS];
    gn_object objects[MOST_OBJECTS];
    gn_scene scene;
} random_scene;

static void make_scene(random_scene *r)
{
    memset(r, 0, sizeof *r);
    r->scene.object_count = (uint32_t)between(1, MOST_OBJECTS);
    r->scene.objects = r->objects;
    for (uint32_t o = 0; o < r->scene.object_count; o++) {
        shape *s = &r->shapes[o];
        int reach = 30 << between(0, 8), vertices = between(3, 40), triangles = between(1, 60);
        *s = shape_new(between(0, 1));
        for (int i = 0; i < vertices; i++) {
            int32_t z = between(0, 1) ? 500 * between(-4, 4) : between(-4000, 4000);
            add_vertex(s, between(-reach, reach), between(-reach, reach), z);
        }
        for (int i = 0; i < triangles; i++)
            add_triangle(s, (uint32_t)between(0, vertices - 1), (uint32_t)between(0, vertices - 1),
                         (uint32_t)between(0, vertices - 1));
        r->objects[o].mesh = &s->mesh;
        r->objects[o].colour.r = (uint8_t)between(0, 255);
    }
}

static gn_settings random_settings(void)
{
    static const uint8_t surfaces[] = {GN_CONSTANT, GN_MIDPOINT, GN_DUAL, GN_SECOND, GN_MIXED, GN_SLOPE};
    gn_settings s = gn_default_settings((uint16_t)between(1, 60), (uint16_t)between(1, 40), 1);
    s.map_width = (uint16_t)between(1, 150);
    s.map_height = (uint16_t)between(1, 60);
    s.map_rows = (uint16_t)between(0, s.map_height);
    s.region_width = (uint16_t)between(0, s.width);
    s.region_height = (uint16_t)between(0, s.height);
    s.surface = surfaces[between(0, 5)];
    s.slope = between(0, 4 << 16);
    if (s.map_width > 1 && s.map_height > 1) {
        s.receiver = &gn_virtual;
        s.reconstruction = between(0, 1) ? &gn_silhouettes : 0;
    }
    s.cull = s.surface == GN_CONSTANT || s.surface == GN_SLOPE ? (uint8_t)between(GN_CULL_NONE, GN_CULL_FRONT)
                                                               : GN_CULL_NONE;
    if (s.surface == GN_SECOND)
        s.cull = (uint8_t)(between(0, 1) ? GN_CULL_NONE : GN_CULL_FRONT);
    return s;
}

static gn_status random_views(gn_light *light, gn_camera *camera, const gn_scene *scene)
{
    int32_t eye[3], target_point[3] = {between(-500, 500), between(-500, 500), between(-500, 500)}, up[3] = {0, 1, 0};
    int32_t position[3], direction[3];
    gn_status status;
    for (int i = 0; i < 3; i++) {
        eye[i] = between(-9000, 9000);
        position[i] = between(-9000, 9000);
        direction[i] = between(-100, 100);
    }
    memset(camera, 0, sizeof *camera);
    memset(light, 0, sizeof *light);
    status = gn_look_at(camera, eye, target_point, up);
    if (status == GN_OK)
        status = between(0, 2) ? gn_perspective(camera, GN_DEGREES(between(10, 120)), between(100, 3000), 40000)
                               : gn_orthographic(camera, between(500, 9000), -20000, 30000);
    if (status != GN_OK)
        return status;
    if (between(0, 1))
        return gn_spot_light(light, position, target_point, 0, GN_DEGREES(between(20, 120)), between(100, 3000), 40000);
    status = gn_directional_light(light, direction, 0);
    if (status == GN_OK)
        status = gn_fit_light(light, scene);
    if (between(0, 2) == 0 && status == GN_OK) { /* a box that leaves points out */
        light->box_width = light->box_width / 2 + 64;
        light->box_depth = light->box_depth / 2 + 64;
    }
    return status;
}

/* ---- comparisons ----------------------------------------------------------------------------------------------- */

typedef struct tally {
    unsigned failures;
    uint64_t scenes, texels, pixels, lit, shadowed, spots, trusted, orthographic;
    uint64_t steep, rising, virtual_lit, virtual_shadowed;
} tally;

static void differs(tally *count, uint64_t n, const char *what, uint32_t column, uint32_t row, uint32_t library,
                    uint32_t twin)
{
    if (count->failures++ < 5)
        note("scene %llu, %s at (%u, %u): %s %lu, %s %lu", (unsigned long long)n, what, (unsigned)column, (unsigned)row,
             LIBRARY_HAS_VECTORS ? "vectors" : "scalar", (unsigned long)library,
             LIBRARY_HAS_VECTORS ? "scalar" : "vectors", (unsigned long)twin);
}

/* Padding belongs to nobody: compare what the map has. */
static void compare_layers(tally *count, uint64_t n, gn_context *context, gn_depth *kept)
{
    for (uint32_t region = 0; region < context->plan.light_regions; region++) {
        uint32_t first, rows, stride, width = context->settings.map_width;
        for (int pass = 0; pass < 2; pass++) {
            if ((pass ? twin_light_layers(context, region, 0) : gn_light_layers(context, region, 0)) != GN_OK)
                count->failures++;
            for (uint32_t layer = 0; layer < 2; layer++) {
                const gn_depth *z = gn_layer(context, layer, region, 0, &first, &rows, &stride);
                gn_depth *copy = kept + layer * 150 * 60;
                for (uint32_t i = 0; z && i < rows * width; i++) {
                    gn_depth v = z[i / width * stride + i % width];
                    if (pass && copy[i] != v)
                        differs(count, n, layer ? "second layer" : "first layer", i % width, first + i / width, copy[i],
                                v);
                    copy[i] = v;
                    count->texels += pass && v != GN_FARTHEST;
                }
            }
        }
        if (gn_light_resolve(context, region, 0) != GN_OK)
            count->failures++;
    }
}

/* Triangles too steep for 32 bits, of the light pass that has begun. */
static uint64_t count_steep(const gn_context *context)
{
    uint64_t steep = 0;
    for (uint32_t o = 0; o < context->scene->object_count; o++) {
        const gn_mesh *mesh = context->scene->objects[o].mesh;
        const gn_vertex *v = context->vertices + context->objects[o].first_vertex;
        for (uint32_t t = 0; t < mesh->triangle_count; t++) {
            uint32_t index[3];
            gn_depth_plane plane;
            gn_triangle_indices(mesh, t, index);
            const gn_vertex *v0 = &v[index[0]], *v1 = &v[index[1]], *v2 = &v[index[2]];
            int64_t area = v0->depth && v1->depth && v2->depth ? gn_area(v0, v1, v2) : 0;
            steep += area && gn_make_depth_plane(&plane, v0, area > 0 ? v1 : v2, area > 0 ? v2 : v1, area);
        }
    }
    return steep;
}

/* The same context with rows of the map as long as the other code wants them; what the map is, is for the caller to
 * free. */
static gn_context packed_otherwise(const gn_context *context)
{
    gn_context other = *context;
    uint32_t width = context->settings.map_width, height = context->settings.map_height;
    other.map_stride = width + GN_ROW_PADDING;
    other.map = grown(0, ((size_t)other.map_stride * height + SLACK) * sizeof *other.map);
    for (uint32_t row = 0; row < height; row++)
        memcpy(other.map + row * other.map_stride, context->map + row * context->map_stride, width * sizeof *other.map);
    if (other.settings.receiver)
        other.settings.receiver = &twin_virtual;
    if (other.settings.reconstruction)
        other.settings.reconstruction = &twin_silhouettes;
    return other;
}

/* One row by virtual samples, from what visibility left in the worker's Q. */
static void compare_cascade(tally *count, uint64_t n, gn_context *context, gn_context *other, uint32_t from, int32_t x,
                            int32_t y, int32_t across)
{
    static uint32_t kept[60];
    gn_worker *w = &context->workers[0];
    uint32_t *q = w->q + from, library[60];
    memcpy(kept, q, (size_t)across * 4);
    gn_cascade_row(context, w, from, x, y, across);
    memcpy(library, q, (size_t)across * 4);
    memcpy(q, kept, (size_t)across * 4);
    twin_cascade_row(other, w, from, x, y, across);
    for (int32_t i = 0; i < across; i++) {
        if (w->triangle[from + (uint32_t)i] == GN_NO_TRIANGLE)
            continue;
        /* a directional light asks for the sign alone */
        uint32_t apart = library[i] ^ q[i];
        if (context->light.kind == GN_SPOT ? apart != 0 : apart >> 31)
            differs(count, n, "virtual samples", (uint32_t)(x + i), (uint32_t)y, library[i], q[i]);
        count->virtual_lit += !(library[i] >> 31);
        count->virtual_shadowed += library[i] >> 31;
    }
    memcpy(q, kept, (size_t)across * 4);
}

static void compare_regions(tally *count, uint64_t n, gn_context *context, uint32_t *kept)
{
    const gn_plan *plan = &context->plan;
    gn_worker *w = &context->workers[0];
    gn_context other = packed_otherwise(context);
    int32_t width = context->settings.width, height = context->settings.height;
    for (int32_t y = 0; y < height; y += plan->region_height) {
        for (int32_t x = 0; x < width; x += plan->region_width) {
            gn_window window = {x, y, x + plan->region_width < width ? x + plan->region_width : width,
                                y + plan->region_height < height ? y + plan->region_height : height};
            int32_t across = window.column1 - x, pixels = across * (window.row1 - y);
            uint32_t *q = kept, *triangle = kept + 60 * 40, *shaded = kept + 2 * 60 * 40;
            gn_rasterise_region(context, w, &window);
            memcpy(q, w->q, (size_t)pixels * 4);
            memcpy(triangle, w->triangle, (size_t)pixels * 4);
            twin_rasterise_region(context, w, &window);
            for (int32_t i = 0; i < pixels; i++) {
                uint32_t column = (uint32_t)(x + i % across), row = (uint32_t)(y + i / across);
                if (q[i] != w->q[i])
                    differs(count, n, "Q", column, row, q[i], w->q[i]);
                if (triangle[i] != w->triangle[i])
                    differs(count, n, "triangle", column, row, triangle[i], w->triangle[i]);
                count->pixels += triangle[i] != GN_NO_TRIANGLE;
            }
            memcpy(shaded, q, (size_t)pixels * 4);
            for (int32_t row = 0; row < window.row1 - y; row++) {
                uint32_t *library = q + row * across, *twin = shaded + row * across;
                if (context->settings.receiver)
                    compare_cascade(count, n, context, &other, (uint32_t)(row * across), x, y + row, across);
                gn_shade_row(context, library, x, y + row, across);
                twin_shade_row(&other, twin, x, y + row, across);
                for (int32_t i = 0; i < across; i++) {
                    int seen = triangle[row * across + i] != GN_NO_TRIANGLE;
                    if (library[i] != twin[i])
                        differs(count, n, "shadow test", (uint32_t)(x + i), (uint32_t)(y + row), library[i], twin[i]);
                    count->lit += seen && !(library[i] >> 31);
                    count->shadowed += seen && library[i] >> 31;
                }
            }
        }
    }
    free(other.map);
}

static void compare_scene(tally *count, uint64_t n)
{
    static gn_depth kept_layers[2 * 150 * 60];
    static uint32_t kept_pixels[3 * 60 * 40];
    random_scene r;
    gn_light light;
    gn_camera camera;
    gn_plan plan;
    gn_context *context;
    gn_settings settings = random_settings();
    make_scene(&r);
    gn_status status = random_views(&light, &camera, &r.scene);
    if (status == GN_OK)
        status = gn_make_plan(&plan, &r.scene, &settings);
    if (status != GN_OK) {
        for (int i = 0; i < MOST_OBJECTS; i++)
            shape_free(&r.shapes[i]);
        return;
    }
    /* room for what a vector writes back behind the last row, where the library's rows have no padding */
    void *block = grown(0, plan.bytes + SLACK);
    memset(block, 0, plan.bytes + SLACK);
    status = gn_init(&context, &r.scene, &settings, block, plan.bytes + SLACK);
    if (status == GN_OK)
        status = gn_light_begin(context, &light);
    if (status == GN_OK) {
        compare_layers(count, n, context, kept_layers);
        count->steep += count_steep(context);
        count->rising += settings.surface == GN_SLOPE;
        status = gn_camera_begin(context, &camera);
    }
    if (status == GN_OK) {
        compare_regions(count, n, context, kept_pixels);
        count->scenes++;
        count->spots += light.kind == GN_SPOT;
        count->trusted += context->shading.trusted && !context->camera_view.affine;
        count->orthographic += context->camera_view.affine;
    }
    free(block);
    for (int i = 0; i < MOST_OBJECTS; i++)
        shape_free(&r.shapes[i]);
}

int main(int argc, char **argv)
{
    uint64_t cases = tap_cases(argc, argv, 6000);
    tally count;
    memset(&count, 0, sizeof count);
    for (uint64_t n = 0; n < cases && count.failures < 5; n++)
        compare_scene(&count, n);
    ok(!count.failures, "loops with and without vectors agree bit for bit, in %llu scenes",
       (unsigned long long)count.scenes);
    ok(count.scenes > cases * 3 / 4 && count.lit > 1000 && count.shadowed > 1000 && count.texels > 100000 &&
           count.virtual_lit > 1000 && count.virtual_shadowed > 1000 && count.steep > cases / 4 &&
           count.rising > cases / 20 && count.spots > cases / 20 && count.trusted > cases / 20 &&
           count.orthographic > cases / 20,
       "%llu texels, %llu pixels, %llu of them lit and %llu shadowed; by virtual samples %llu and %llu",
       (unsigned long long)count.texels, (unsigned long long)count.pixels, (unsigned long long)count.lit,
       (unsigned long long)count.shadowed, (unsigned long long)count.virtual_lit,
       (unsigned long long)count.virtual_shadowed);
    note("the library works %s vectors; %llu spot lights, %llu boxes around everything, %llu orthographic cameras, "
         "%llu surfaces with slope, %llu steep triangles",
         LIBRARY_HAS_VECTORS ? "with" : "without", (unsigned long long)count.spots, (unsigned long long)count.trusted,
         (unsigned long long)count.orthographic, (unsigned long long)count.rising, (unsigned long long)count.steep);
    return tap_done();
}
