/* What the core costs, in instructions: each case prints `case NAME` and runs once between mark_begin and mark_end,
 * where count_plugin.c counts. table.awk takes differences of cases, so that everything but the thing in question
 * cancels. All cases use the public interface alone. */
#include "bench.h"

#include "port.h"
#include "print.h"

#include "fence.h"
#include "lshape.h"
#include "pins.h"
#include "pipes.h"
#include "table.h"
#include "torus2.h"

__attribute__((noinline)) void mark_begin(void)
{
    __asm__ volatile("");
}

__attribute__((noinline)) void mark_end(void)
{
    __asm__ volatile("");
}

static uint64_t memory[128 * 1024];
gn_context *context;

void require(int condition, const char *what)
{
    if (!condition) {
        port_write("failed: ");
        port_write(what);
        port_write("\n");
        port_exit(1);
    }
}

void write_case(const char *name, const char *suffix, uint32_t number)
{
    port_write("case ");
    port_write(name);
    port_write(suffix);
    write_decimal(number);
    port_write("\n");
}

const gn_rgb grey = {200, 180, 160};

gn_scene scene_of(const gn_object *objects, uint32_t count)
{
    const gn_scene scene = {objects, count, {10, 20, 30}, 65535 / 5};
    return scene;
}

void prepare(const gn_scene *scene, const gn_settings *settings, gn_plan *plan)
{
    require(gn_make_plan(plan, scene, settings) == GN_OK, "plan");
    require(gn_init(&context, scene, settings, memory, sizeof memory) == GN_OK, "init");
}

/* ---- light pass ------------------------------------------------------------------------------------------------ */

void light_along_minus_z(gn_light *light)
{
    static const int32_t direction[3] = {0, 0, -1};
    require(gn_directional_light(light, direction, 0) == GN_OK, "light");
    light->box_u = light->box_v = -HALF;
    light->box_width = light->box_height = 2 * HALF;
    light->box_z = -DEPTH;
    light->box_depth = 2 * DEPTH;
}

/* GN_CONSTANT: one layer, GN_DUAL: two, GN_SLOPE: one and what slopes accumulate. */
gn_settings light_settings(gn_surface surface)
{
    gn_settings settings = gn_default_settings(16, 16, MAP);
    settings.surface = (uint8_t)surface;
    settings.slope = 2 << 16;
    settings.cull = GN_CULL_NONE;
    settings.bias.unit = GN_BIAS_RANGE;
    settings.bias.value = 1u << 20;
    return settings;
}

/* All of the light's plane, evenly. */
static void look_along_minus_z(gn_camera *camera)
{
    static const int32_t eye[3] = {0, 0, DEPTH}, ahead[3] = {0, 0, 0}, up[3] = {0, 1, 0};
    require(gn_look_at(camera, eye, ahead, up) == GN_OK, "look at");
    require(gn_orthographic(camera, HALF, 0, 2 * DEPTH) == GN_OK, "camera");
}

void measure_light_pass_of(const gn_scene *scene, const gn_settings *settings, const gn_light *light)
{
    gn_plan plan;
    prepare(scene, settings, &plan);
    if (plan.view_rounds) {
        gn_camera camera;
        look_along_minus_z(&camera);
        require(gn_view_pass(context, &camera, light) == GN_OK, "view pass");
    }
    mark_begin();
    gn_status status = gn_light_pass(context, light);
    mark_end();
    require(status == GN_OK, "light pass");
}

void measure_light_pass(const gn_scene *scene, const gn_settings *settings)
{
    gn_light light;
    light_along_minus_z(&light);
    measure_light_pass_of(scene, settings, &light);
}

const uint16_t quad_indices[2][3] = {{0, 1, 2}, {0, 2, 3}};
static const int32_t wide_quad[4][3] = {
    {-HALF, -HALF, 0}, {HALF, -HALF, 4000}, {HALF, HALF, 9000}, {-HALF, HALF, 5000}};
static const int32_t narrow_quad[4][3] = {{-HALF, -HALF, 0}, {0, -HALF, 2000}, {0, HALF, 7000}, {-HALF, HALF, 5000}};
static const gn_mesh wide_mesh = {wide_quad, quad_indices, 4, 2, sizeof(uint16_t), 0, 0, 0};
static const gn_mesh narrow_mesh = {narrow_quad, quad_indices, 4, 2, sizeof(uint16_t), 0, 0, 0};

static void put(gn_model *model, int32_t z)
{
    gn_model_identity(model);
    require(gn_model_translate(model, 0, 0, z) == GN_OK, "model");
}

/* Quads over all or half of the map's columns, in front of or behind one another: every texel of the last ones is
 * nearer than all before (pass) or farther (fail). */
static void measure_texels(const char *name, const gn_mesh *mesh, const gn_settings *settings, int pass)
{
    static gn_model models[QUADS + 1];
    static gn_object objects[QUADS + 1] = {{&wide_mesh, models, {0, 0, 0}}}; /* a floor, for the view pass */
    put(&models[0], -DEPTH / 2);
    for (int i = 0; i < QUADS; i++) {
        put(&models[i + 1], (pass ? 50000 : -50000) * (i - QUADS / 2));
        objects[i + 1].mesh = mesh;
        objects[i + 1].model = &models[i + 1];
        objects[i + 1].colour = grey;
    }
    for (uint32_t count = QUADS / 2; count <= QUADS; count += QUADS / 2) {
        gn_scene scene = scene_of(objects, 1 + count);
        write_case(name, pass ? "-pass-" : "-fail-", count);
        measure_light_pass(&scene, settings);
    }
}

/* The map alone: clear and resolve, by its size. The one triangle is too small for any texel. */
static void measure_map(const char *name, gn_surface surface, const gn_reconstruction *reconstruction)
{
    static const int32_t speck[3][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    static const gn_mesh mesh = {speck, quad_indices, 3, 1, sizeof(uint16_t), 0, 0, 0};
    static const gn_object object = {&mesh, 0, {0, 0, 0}};
    gn_scene scene = scene_of(&object, 1);
    gn_settings settings = light_settings(surface);
    settings.reconstruction = reconstruction;
    for (uint16_t rows = MAP / 2; rows <= MAP; rows = (uint16_t)(rows + MAP / 2)) {
        settings.map_height = rows;
        write_case(name, "-", rows);
        measure_light_pass(&scene, &settings);
    }
}

/* Small triangles: right-angled, legs of 4 texels (8 texels of area), turned by sixteenths of a circle, at random
 * places within a texel, one in each cell of a grid. Counter-clockwise as the light sees them. */
enum { TRIANGLES = 128, GRID_COLUMNS = 16, CELL = MAP / GRID_COLUMNS, VERTICES = 3 * TRIANGLES };

static int32_t small_vertices[2 * VERTICES][3];
static uint16_t small_indices[2][TRIANGLES][3]; /* front faces, back faces */

static uint32_t random_number(void)
{
    static uint32_t state = 12345;
    state = state * 1664525u + 1013904223u;
    return state >> 8;
}

/* floor(value x 4 texels) of a Q2.30 value. */
static int32_t leg(gn_q2_30 value)
{
    return value / ((1 << 30) / (4 * TEXEL));
}

static void make_small_triangles(void)
{
    for (uint16_t t = 0; t < TRIANGLES; t++) {
        gn_angle angle = (gn_angle)t << 28;
        int32_t dx = leg(gn_cosine(angle)), dy = leg(gn_sine(angle));
        int32_t x = (t % GRID_COLUMNS * CELL + CELL / 2) * TEXEL - HALF + (int32_t)(random_number() % TEXEL);
        int32_t y = (t / GRID_COLUMNS * CELL + CELL / 2) * TEXEL - HALF + (int32_t)(random_number() % TEXEL);
        const int32_t corners[3][3] = {{x, y, 0}, {x + dx, y + dy, 3000}, {x - dy, y + dx, -2000}};
        for (int corner = 0; corner < 3; corner++) {
            uint16_t index = (uint16_t)(3 * t + corner);
            small_indices[0][t][corner] = index;
            small_indices[1][t][2 - corner] = index;
            for (int axis = 0; axis < 3; axis++)
                small_vertices[index][axis] = small_vertices[VERTICES + index][axis] = corners[corner][axis];
        }
    }
}

static gn_mesh small_mesh(const void *indices, uint32_t vertex_count, uint32_t triangle_count)
{
    const gn_mesh mesh = {
        (const int32_t(*)[3])small_vertices, indices, vertex_count, triangle_count, sizeof(uint16_t), 0, 0, 0};
    return mesh;
}

/* The same vertices, half or all of the triangles. */
static void measure_small_triangles(const char *name, gn_settings settings, int back_faces)
{
    static gn_model below;
    gn_mesh mesh = small_mesh(small_indices[back_faces], VERTICES, 0);
    gn_object objects[2] = {{&mesh, 0, {0, 0, 0}}, {&wide_mesh, &below, {0, 0, 0}}}; /* a floor, for the view pass */
    put(&below, -DEPTH / 2);
    if (back_faces) {
        mesh.closed = 1;
        settings.cull = GN_CULL_BACK;
    }
    for (uint32_t count = TRIANGLES / 2; count <= TRIANGLES; count += TRIANGLES / 2) {
        mesh.triangle_count = count;
        gn_scene scene = scene_of(objects, 2);
        write_case(name, "-", count);
        measure_light_pass(&scene, &settings);
    }
}

/* The same triangles, some or twice as many vertices. */
static void measure_vertices(void)
{
    gn_settings settings = light_settings(GN_CONSTANT);
    for (uint32_t count = VERTICES; count <= 2 * VERTICES; count += VERTICES) {
        gn_mesh mesh = small_mesh(small_indices[0], count, TRIANGLES);
        gn_object object = {&mesh, 0, {0, 0, 0}};
        gn_scene scene = scene_of(&object, 1);
        write_case("vertices", "-", count);
        measure_light_pass(&scene, &settings);
    }
}

/* ---- camera pass ----------------------------------------------------------------------------------------------- */

/* A tilted receiver that overfills the image, and behind the camera an occluder that shadows about its left half. */
const int32_t receiver[4][3] = {
    {-13000, -10000, -18500}, {13000, -10000, -21500}, {13000, 10000, -20500}, {-13000, 10000, -17500}};
static const int32_t occluder[4][3] = {
    {-20500, -3000, 10000}, {-7500, -3000, 10000}, {-7500, 18000, 10000}, {-20500, 18000, 10000}};
static const gn_mesh receiver_mesh = {receiver, quad_indices, 4, 2, sizeof(uint16_t), 0, 0, 0};
static const gn_mesh occluder_mesh = {occluder, quad_indices, 4, 2, sizeof(uint16_t), 0, 0, 0};
const gn_object room[2] = {{&receiver_mesh, 0, {200, 180, 160}}, {&occluder_mesh, 0, {90, 90, 90}}};

const view views[VIEWS] = {
    {"perspective-directional-rgb888", 0, 0, GN_RGB888}, {"perspective-directional-rgb565", 0, 0, GN_RGB565},
    {"perspective-spot-rgb888", 0, 1, GN_RGB888},        {"orthographic-directional-rgb888", 1, 0, GN_RGB888},
    {"orthographic-spot-rgb888", 1, 1, GN_RGB888},
};

void set_up_view(const view *v, const gn_scene *scene, gn_camera *camera, gn_light *light)
{
    static const int32_t eye[3] = {0, 0, 0}, ahead[3] = {0, 0, -20000}, up[3] = {0, 1, 0};
    static const int32_t sun[3] = {1, -1, -4}, lamp[3] = {-10000, 10000, 20000};
    gn_status status = gn_look_at(camera, eye, ahead, up);
    require(status == GN_OK, "look at");
    status = v->orthographic ? gn_orthographic(camera, 7000, 1000, 40000)
                             : gn_perspective(camera, GN_DEGREES(38), 1000, 40000);
    require(status == GN_OK, "camera");
    if (v->spot) {
        status = gn_spot_light(light, lamp, ahead, 0, GN_DEGREES(80), 5000, 80000);
    } else {
        status = gn_directional_light(light, sun, 0);
        require(status == GN_OK && gn_fit_light(light, scene) == GN_OK, "sun");
    }
    require(status == GN_OK, "light");
}

uint32_t lit, shadowed;
static uint32_t empty;

static int count_mask(void *user, const gn_pixels *p)
{
    (void)user;
    for (uint32_t i = 0; i < (uint32_t)p->width * p->height; i++) {
        lit += p->mask[i] == 254;
        shadowed += p->mask[i] == 0;
        empty += p->mask[i] == 255;
    }
    return 0;
}

int discard(void *user, const gn_pixels *p)
{
    (void)user;
    (void)p;
    return 0;
}

/* What the pixels of a whole view are. */
void look_at_view(const gn_scene *scene, const gn_settings *settings, const gn_camera *camera, const gn_light *light)
{
    gn_settings masks = *settings;
    gn_plan plan;
    masks.mask = 1;
    prepare(scene, &masks, &plan);
    lit = shadowed = empty = 0;
    require(!plan.view_rounds || gn_view_pass(context, camera, light) == GN_OK, "view pass");
    require(gn_light_pass(context, light) == GN_OK, "light pass");
    require(gn_camera_pass(context, camera, count_mask, 0) == GN_OK, "camera pass");
}

/* A camera pass over what the light pass has left. */
void measure_camera_pass(const gn_scene *scene, const gn_settings *settings, const gn_camera *camera,
                         const gn_light *light)
{
    gn_plan plan;
    prepare(scene, settings, &plan);
    require(!plan.view_rounds || gn_view_pass(context, camera, light) == GN_OK, "view pass");
    require(gn_light_pass(context, light) == GN_OK, "light pass");
    mark_begin();
    gn_status status = gn_camera_pass(context, camera, discard, 0);
    mark_end();
    require(status == GN_OK, "camera pass");
}

/* The room in two sizes. */
gn_settings room_settings(const view *v, uint16_t width, uint32_t bias_texels)
{
    gn_settings settings = gn_default_settings(width, (uint16_t)(width / 4 * 3), 128);
    settings.surface = GN_CONSTANT;
    settings.bias.unit = GN_BIAS_TEXELS;
    settings.bias.value = bias_texels << 16;
    settings.format = (uint8_t)v->format;
    return settings;
}

static void measure_pixels(const view *v)
{
    gn_scene scene = scene_of(room, 2);
    gn_camera camera;
    gn_light light;
    set_up_view(v, &scene, &camera, &light);
    for (uint16_t width = 160; width <= 320; width = (uint16_t)(width + 160)) {
        gn_settings settings = room_settings(v, width, 2);
        look_at_view(&scene, &settings, &camera, &light);
        require(lit > shadowed / 4 && shadowed > lit / 4 && empty == 0, "a full view with light and shadow");
        write_case(v->name, "-", width);
        measure_camera_pass(&scene, &settings, &camera, &light);
    }
}

/* ---- receivers and reconstructions ------------------------------------------------------------------------------- */

const test tests[TESTS] = {
    {"-point-", GN_SECOND, 0, 0},
    {"-virtual-", GN_SECOND, &gn_virtual, 0},
    {"-virtual-always-", GN_SECOND, &gn_virtual_always, 0},
    {"-plane-bias-", GN_CONSTANT, &gn_plane_bias, 0},
    {"-bilinear-", GN_SECOND, 0, &gn_bilinear},
    {"-bilinear-virtual-", GN_SECOND, &gn_virtual, &gn_bilinear},
    {"-jitter4x4-", GN_SECOND, 0, &gn_jitter_4x4},
    {"-jitter4x4-virtual-", GN_SECOND, &gn_virtual, &gn_jitter_4x4},
    {"-pcf3-", GN_SECOND, 0, &gn_box_3x3},
    {"-pcf5-", GN_SECOND, 0, &gn_box_5x5},
    {"-pcf5-virtual-", GN_SECOND, &gn_virtual, &gn_box_5x5},
    {"-pcf7-", GN_SECOND, 0, &gn_box_7x7},
    {"-silhouette-", GN_SECOND, 0, &gn_silhouettes},
    {"-silhouette-virtual-", GN_SECOND, &gn_virtual, &gn_silhouettes},
    {"-smooth-virtual-", GN_SECOND, &gn_virtual, &gn_silhouettes_smooth},
    {"-crossing-virtual-", GN_SECOND, &gn_virtual, &gn_crossings},
};

const golden_scene golden[GOLDEN_SCENES] = {
    {"lshape", &lshape_scene, &lshape_camera, &lshape_light}, {"torus2", &torus2_scene, &torus2_camera, &torus2_light},
    {"table", &table_scene, &table_camera, &table_light},     {"pipes", &pipes_scene, &pipes_camera, &pipes_light},
    {"pins", &pins_scene, &pins_camera, &pins_light},         {"fence", &fence_scene, &fence_camera, &fence_light},
};

/* Whole camera passes of the golden scenes: vertices, bins, visibility, shadow test, colours. */
static void measure_golden_frames(void)
{
    for (unsigned i = 0; i < TESTS; i++) {
        gn_settings settings = gn_default_settings(160, 120, 128);
        settings.surface = (uint8_t)tests[i].surface;
        settings.bias.unit = GN_BIAS_RANGE;
        settings.bias.value = tests[i].surface == GN_CONSTANT ? 0xffffffffu / 2000 : 0;
        settings.slope = 1 << 16;
        settings.receiver = tests[i].receiver;
        settings.reconstruction = tests[i].reconstruction;
        for (unsigned g = 0; g < GOLDEN_SCENES; g++) {
            write_case(golden[g].name, tests[i].name, 160);
            measure_camera_pass(golden[g].scene, &settings, golden[g].camera, golden[g].light);
        }
    }
}

/* The room's receiver, all lit or all shadowed: every texel agrees with every other. */
static const int32_t blind[4][3] = {
    {-24000, -6000, 10000}, {9000, -6000, 10000}, {9000, 22000, 10000}, {-24000, 22000, 10000}};
static const gn_mesh blind_mesh = {blind, quad_indices, 4, 2, sizeof(uint16_t), 0, 0, 0};
static const gn_object dark_room[] = {{&receiver_mesh, 0, {200, 180, 160}}, {&blind_mesh, 0, {90, 90, 90}}};

static void measure_agreement(const view *v, const char *name, int dark, const test *by)
{
    gn_scene scene = scene_of(dark ? dark_room : room, dark ? 2 : 1);
    gn_camera camera;
    gn_light light;
    set_up_view(v, &scene, &camera, &light);
    for (uint16_t width = 160; width <= 320; width = (uint16_t)(width + 160)) {
        /* a bias of more than the receiver rises within the widest filter */
        gn_settings settings = room_settings(v, width, 8);
        settings.receiver = by->receiver;
        settings.reconstruction = by->reconstruction;
        look_at_view(&scene, &settings, &camera, &light);
        require((dark ? shadowed : lit) == (uint32_t)settings.width * settings.height, "a view of one kind");
        write_case(name, by->name, width);
        measure_camera_pass(&scene, &settings, &camera, &light);
    }
}

static void measure_all_agreements(void)
{
    for (unsigned i = 0; i < TESTS; i++) {
        measure_agreement(&views[0], "lit-sun", 0, &tests[i]);
        measure_agreement(&views[0], "dark-sun", 1, &tests[i]);
        if (i > 1)
            continue; /* the rest costs the same whatever the light */
        measure_agreement(&views[2], "lit-spot", 0, &tests[i]);
        measure_agreement(&views[2], "dark-spot", 1, &tests[i]);
    }
}

/* Fills of maps of one surface, even or warped. */
static void measure_fills(const char *wide, const char *narrow, const gn_settings *settings)
{
    for (int pass = 1; pass >= 0; pass--) {
        measure_texels(wide, &wide_mesh, settings, pass);
        measure_texels(narrow, &narrow_mesh, settings, pass);
    }
}

static void measure_uniform_fills(void)
{
    const gn_settings one = light_settings(GN_CONSTANT), two = light_settings(GN_DUAL),
                      slope = light_settings(GN_SLOPE);
    measure_fills("one-wide", "one-narrow", &one);
    measure_fills("two-wide", "two-narrow", &two);
    measure_fills("slope-wide", "slope-narrow", &slope);
    make_small_triangles();
    measure_small_triangles("one-small", one, 0);
    measure_small_triangles("two-small", two, 0);
    measure_small_triangles("slope-small", slope, 0);
    measure_small_triangles("rejected", one, 1);
}

/* The tables are those of an even view: about even, so that triangles have as many texels as on the uniform map. */
static void measure_warped_fills(void)
{
    gn_settings s = light_settings(GN_CONSTANT);
    s.width = s.height = MAP / 4;
    s.warp = &gn_rectilinear;
    measure_fills("rectilinear-one-wide", "rectilinear-one-narrow", &s);
    measure_small_triangles("rectilinear-one-small", s, 0);
    s.surface = GN_DUAL;
    measure_fills("rectilinear-two-wide", "rectilinear-two-narrow", &s);
    measure_small_triangles("rectilinear-two-small", s, 0);
    s.warp = &gn_nonorthogonal;
    measure_fills("nonorthogonal-two-wide", "nonorthogonal-two-narrow", &s);
    measure_small_triangles("nonorthogonal-two-small", s, 0);
    s.surface = GN_CONSTANT;
    measure_fills("nonorthogonal-one-wide", "nonorthogonal-one-narrow", &s);
    measure_small_triangles("nonorthogonal-one-small", s, 0);
}

int main(void)
{
    measure_uniform_fills();
    measure_map("one-map", GN_CONSTANT, 0);
    measure_map("two-map", GN_DUAL, 0);
    measure_map("slope-map", GN_SLOPE, 0);
    measure_map("silhouette-map", GN_DUAL, &gn_silhouettes);
    measure_vertices();
    for (unsigned i = 0; i < VIEWS; i++)
        measure_pixels(&views[i]);
    measure_golden_frames();
    measure_all_agreements();
    measure_planes("planes-sun", &views[0]);
    measure_planes("planes-spot", &views[2]);
    measure_silhouette_maps();
    measure_volumes();
    measure_warped_fills();
    measure_warps();
    measure_casters();
    return 0;
}
