/* What the core costs, in instructions: each case prints `case NAME` and runs once between mark_begin and mark_end,
 * where count_plugin.c counts. table.awk takes differences of cases, so that everything but the thing in question
 * cancels. All cases use the public interface alone. */
#include "gnomon.h"
#include "port.h"
#include "print.h"

#include "fence.h"
#include "lshape.h"
#include "pins.h"
#include "pipes.h"
#include "table.h"
#include "torus2.h"

void mark_begin(void);
void mark_end(void);

__attribute__((noinline)) void mark_begin(void)
{
    __asm__ volatile("");
}

__attribute__((noinline)) void mark_end(void)
{
    __asm__ volatile("");
}

static uint64_t memory[128 * 1024];
static gn_context *context;

static void require(int condition, const char *what)
{
    if (!condition) {
        port_write("failed: ");
        port_write(what);
        port_write("\n");
        port_exit(1);
    }
}

static void write_case(const char *name, const char *suffix, uint32_t number)
{
    port_write("case ");
    port_write(name);
    port_write(suffix);
    write_decimal(number);
    port_write("\n");
}

static const gn_rgb grey = {200, 180, 160};

static gn_scene scene_of(const gn_object *objects, uint32_t count)
{
    const gn_scene scene = {objects, count, {10, 20, 30}, 65535 / 5};
    return scene;
}

static void prepare(const gn_scene *scene, const gn_settings *settings, gn_plan *plan)
{
    require(gn_make_plan(plan, scene, settings) == GN_OK, "plan");
    require(gn_init(&context, scene, settings, memory, sizeof memory) == GN_OK, "init");
}

/* ---- light pass ------------------------------------------------------------------------------------------------ */

enum {
    MAP = 320,
    TEXEL = 4096,           /* world units */
    HALF = MAP / 2 * TEXEL, /* the map covers +-HALF in x and y */
    DEPTH = 1 << 20,        /* and +-DEPTH in z; the light looks along -z */
    QUADS = 8
};

static void light_along_minus_z(gn_light *light)
{
    static const int32_t direction[3] = {0, 0, -1};
    require(gn_directional_light(light, direction, 0) == GN_OK, "light");
    light->box_u = light->box_v = -HALF;
    light->box_width = light->box_height = 2 * HALF;
    light->box_z = -DEPTH;
    light->box_depth = 2 * DEPTH;
}

/* GN_CONSTANT: one layer, GN_DUAL: two, GN_SLOPE: one and what slopes accumulate. */
static gn_settings light_settings(gn_surface surface)
{
    gn_settings settings = gn_default_settings(16, 16, MAP);
    settings.surface = (uint8_t)surface;
    settings.slope = 2 << 16;
    settings.cull = GN_CULL_NONE;
    settings.bias.unit = GN_BIAS_RANGE;
    settings.bias.value = 1u << 20;
    return settings;
}

static void measure_light_pass_of(const gn_scene *scene, const gn_settings *settings, const gn_light *light)
{
    gn_plan plan;
    prepare(scene, settings, &plan);
    mark_begin();
    gn_status status = gn_light_pass(context, light);
    mark_end();
    require(status == GN_OK, "light pass");
}

static void measure_light_pass(const gn_scene *scene, const gn_settings *settings)
{
    gn_light light;
    light_along_minus_z(&light);
    measure_light_pass_of(scene, settings, &light);
}

static const uint16_t quad_indices[][3] = {{0, 1, 2}, {0, 2, 3}};
static const int32_t wide_quad[4][3] = {
    {-HALF, -HALF, 0}, {HALF, -HALF, 4000}, {HALF, HALF, 9000}, {-HALF, HALF, 5000}};
static const int32_t narrow_quad[4][3] = {{-HALF, -HALF, 0}, {0, -HALF, 2000}, {0, HALF, 7000}, {-HALF, HALF, 5000}};
static const gn_mesh wide_mesh = {wide_quad, quad_indices, 4, 2, sizeof(uint16_t), 0, 0, 0};
static const gn_mesh narrow_mesh = {narrow_quad, quad_indices, 4, 2, sizeof(uint16_t), 0, 0, 0};

/* Quads over all or half of the map's columns, in front of or behind one another: every texel of the last ones is
 * nearer than all before (pass) or farther (fail). */
static void measure_texels(const char *name, const gn_mesh *mesh, gn_surface surface, int pass)
{
    static gn_model models[QUADS];
    static gn_object objects[QUADS];
    for (int i = 0; i < QUADS; i++) {
        gn_model_identity(&models[i]);
        require(gn_model_translate(&models[i], 0, 0, (pass ? 50000 : -50000) * (i - QUADS / 2)) == GN_OK, "model");
        objects[i].mesh = mesh;
        objects[i].model = &models[i];
        objects[i].colour = grey;
    }
    gn_settings settings = light_settings(surface);
    for (uint32_t count = QUADS / 2; count <= QUADS; count += QUADS / 2) {
        gn_scene scene = scene_of(objects, count);
        write_case(name, pass ? "-pass-" : "-fail-", count);
        measure_light_pass(&scene, &settings);
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
static void measure_small_triangles(const char *name, gn_surface surface, int back_faces)
{
    gn_settings settings = light_settings(surface);
    gn_mesh mesh = small_mesh(small_indices[back_faces], VERTICES, 0);
    gn_object object = {&mesh, 0, {0, 0, 0}};
    if (back_faces) {
        mesh.closed = 1;
        settings.cull = GN_CULL_BACK;
    }
    for (uint32_t count = TRIANGLES / 2; count <= TRIANGLES; count += TRIANGLES / 2) {
        mesh.triangle_count = count;
        gn_scene scene = scene_of(&object, 1);
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
static const int32_t receiver[4][3] = {
    {-13000, -10000, -18500}, {13000, -10000, -21500}, {13000, 10000, -20500}, {-13000, 10000, -17500}};
static const int32_t occluder[4][3] = {
    {-20500, -3000, 10000}, {-7500, -3000, 10000}, {-7500, 18000, 10000}, {-20500, 18000, 10000}};
static const gn_mesh receiver_mesh = {receiver, quad_indices, 4, 2, sizeof(uint16_t), 0, 0, 0};
static const gn_mesh occluder_mesh = {occluder, quad_indices, 4, 2, sizeof(uint16_t), 0, 0, 0};
static const gn_object room[] = {{&receiver_mesh, 0, {200, 180, 160}}, {&occluder_mesh, 0, {90, 90, 90}}};

typedef struct view {
    const char *name;
    int orthographic, spot;
    gn_format format;
} view;

static const view views[] = {
    {"perspective-directional-rgb888", 0, 0, GN_RGB888}, {"perspective-directional-rgb565", 0, 0, GN_RGB565},
    {"perspective-spot-rgb888", 0, 1, GN_RGB888},        {"orthographic-directional-rgb888", 1, 0, GN_RGB888},
    {"orthographic-spot-rgb888", 1, 1, GN_RGB888},
};

static void set_up_view(const view *v, const gn_scene *scene, gn_camera *camera, gn_light *light)
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

static uint32_t lit, shadowed, empty;

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

static int discard(void *user, const gn_pixels *p)
{
    (void)user;
    (void)p;
    return 0;
}

/* What the pixels of a whole view are. */
static void look_at_view(const gn_scene *scene, const gn_settings *settings, const gn_camera *camera,
                         const gn_light *light)
{
    gn_settings masks = *settings;
    gn_plan plan;
    masks.mask = 1;
    prepare(scene, &masks, &plan);
    lit = shadowed = empty = 0;
    require(gn_light_pass(context, light) == GN_OK, "light pass");
    require(gn_camera_pass(context, camera, count_mask, 0) == GN_OK, "camera pass");
}

/* A camera pass over what the light pass has left. */
static void measure_camera_pass(const gn_scene *scene, const gn_settings *settings, const gn_camera *camera,
                                const gn_light *light)
{
    gn_plan plan;
    prepare(scene, settings, &plan);
    require(gn_light_pass(context, light) == GN_OK, "light pass");
    mark_begin();
    gn_status status = gn_camera_pass(context, camera, discard, 0);
    mark_end();
    require(status == GN_OK, "camera pass");
}

/* The room in two sizes. */
static gn_settings room_settings(const view *v, uint16_t width, uint32_t bias_texels)
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

/* What a pixel is compared with and how, over second depth, or what goes with a bias. */
typedef struct test {
    const char *name; /* between hyphens */
    gn_surface surface;
    const gn_receiver *receiver;
    const gn_reconstruction *reconstruction;
} test;

static const test tests[] = {
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

#define COUNT(array) (sizeof(array) / sizeof *(array))

static const struct {
    const char *name;
    const gn_scene *scene;
    const gn_camera *camera;
    const gn_light *light;
} golden[] = {
    {"lshape", &lshape_scene, &lshape_camera, &lshape_light}, {"torus2", &torus2_scene, &torus2_camera, &torus2_light},
    {"table", &table_scene, &table_camera, &table_light},     {"pipes", &pipes_scene, &pipes_camera, &pipes_light},
    {"pins", &pins_scene, &pins_camera, &pins_light},         {"fence", &fence_scene, &fence_camera, &fence_light},
};

/* Whole camera passes of the golden scenes: vertices, bins, visibility, shadow test, colours. */
static void measure_golden_frames(void)
{
    for (unsigned i = 0; i < COUNT(tests); i++) {
        gn_settings settings = gn_default_settings(160, 120, 128);
        settings.surface = (uint8_t)tests[i].surface;
        settings.bias.unit = GN_BIAS_RANGE;
        settings.bias.value = tests[i].surface == GN_CONSTANT ? 0xffffffffu / 2000 : 0;
        settings.slope = 1 << 16;
        settings.receiver = tests[i].receiver;
        settings.reconstruction = tests[i].reconstruction;
        for (unsigned g = 0; g < COUNT(golden); g++) {
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
    for (unsigned i = 0; i < COUNT(tests); i++) {
        measure_agreement(&views[0], "lit-sun", 0, &tests[i]);
        measure_agreement(&views[0], "dark-sun", 1, &tests[i]);
        if (i > 1)
            continue; /* the rest costs the same whatever the light */
        measure_agreement(&views[2], "lit-spot", 0, &tests[i]);
        measure_agreement(&views[2], "dark-spot", 1, &tests[i]);
    }
}

/* ---- shadow volumes -------------------------------------------------------------------------------------------- */

static gn_settings volume_settings(uint16_t width, uint16_t height)
{
    gn_settings settings = gn_default_settings(width, height, 1);
    settings.shadow = GN_SHADOW_VOLUMES;
    return settings;
}

static void measure_volumes(const gn_scene *scene, const gn_settings *settings, const gn_camera *camera,
                            const gn_light *light)
{
    gn_plan plan;
    prepare(scene, settings, &plan);
    require(gn_volumes_light(context, light) == GN_OK, "volumes' light");
    mark_begin();
    gn_status status = gn_volumes_pass(context, camera, discard, 0);
    mark_end();
    require(status == GN_OK, "volumes' pass");
}

/* Two triangles over corners 0 1 2 and 0 2 3. */
static const gn_mesh_edge quad_edges[] = {
    {{0, GN_NO_HALF_EDGE}}, {{1, GN_NO_HALF_EDGE}}, {{2, 3}}, {{4, GN_NO_HALF_EDGE}}, {{5, GN_NO_HALF_EDGE}}};

static gn_mesh quad_with_edges(const int32_t corners[4][3])
{
    const gn_mesh mesh = {(const int32_t(*)[3])corners, quad_indices, 4, 2, sizeof(uint16_t), 0, quad_edges, 5};
    return mesh;
}

/* A whole frame of a golden scene. By a map: measure_golden_frames. */
static void measure_frame(const char *name, const gn_scene *scene, const gn_camera *camera, const gn_light *light)
{
    gn_settings settings = volume_settings(160, 120);
    write_case(name, "-volumes-", 160);
    measure_volumes(scene, &settings, camera, light);
}

/* An orthographic camera along -z; light as given. 7000 world units are half the image's height. */
enum { HALF_HEIGHT = 7000, HALF_WIDTH = HALF_HEIGHT / 3 * 4 + 10 };

static void set_up_along_minus_z(gn_camera *camera, gn_light *light, const int32_t direction[3])
{
    static const int32_t eye[3] = {0, 0, 0}, ahead[3] = {0, 0, -20000}, up[3] = {0, 1, 0};
    require(gn_look_at(camera, eye, ahead, up) == GN_OK, "look at");
    require(gn_orthographic(camera, HALF_HEIGHT, 1000, 80000) == GN_OK, "camera");
    require(gn_directional_light(light, direction, 0) == GN_OK, "sun");
}

/* A receiver, and quads that the camera sees edge-on, at the image's left end or in its middle: each casts two sides,
 * which cover all that is right of it, before or behind the points of the receiver. */
static void measure_side_fragments(int behind)
{
    static const int32_t sun[3] = {1, 0, -1};
    static gn_model models[QUADS];
    gn_mesh ground = quad_with_edges(receiver), fin;
    gn_object objects[QUADS + 1] = {{&ground, 0, {200, 180, 160}}};
    gn_settings settings = volume_settings(320, 240);
    gn_camera camera;
    gn_light light;
    set_up_along_minus_z(&camera, &light, sun);
    for (int wide = 0; wide < 2; wide++) {
        int32_t x = wide ? -HALF_WIDTH : 0, z = behind ? -40000 : -4000;
        const int32_t corners[4][3] = {{x, -9000, z}, {x, 9000, z}, {x, 9000, z + 2000}, {x, -9000, z + 2000}};
        fin = quad_with_edges(corners);
        for (int i = 0; i < QUADS; i++) {
            gn_model_identity(&models[i]);
            require(gn_model_translate(&models[i], 0, 0, 100 * i) == GN_OK, "model");
            objects[i + 1].mesh = &fin;
            objects[i + 1].model = &models[i];
            objects[i + 1].colour = grey;
        }
        for (uint32_t count = QUADS / 2; count <= QUADS; count += QUADS / 2) {
            gn_scene scene = scene_of(objects, count + 1);
            write_case(wide ? "side-wide" : "side-narrow", behind ? "-behind-" : "-before-", count);
            measure_volumes(&scene, &settings, &camera, &light);
        }
    }
}

/* Quads behind a receiver, over all or half of the columns, and a spot light in the camera's eye, so that sides have no
 * area and each quad covers a pixel twice, with its cap and with its lid: by volumes, and by a map for what the
 * triangles cost without them. */
static void measure_cap_fragments(void)
{
    static const int32_t eye[3] = {0, 0, 0}, ahead[3] = {0, 0, -20000}, up[3] = {0, 1, 0};
    static gn_model models[QUADS];
    gn_mesh ground = quad_with_edges(receiver), cap;
    gn_object objects[QUADS + 1] = {{&ground, 0, {200, 180, 160}}};
    gn_camera camera;
    gn_light light;
    require(gn_look_at(&camera, eye, ahead, up) == GN_OK, "look at");
    require(gn_perspective(&camera, GN_DEGREES(38), 1000, 80000) == GN_OK, "camera");
    require(gn_spot_light(&light, eye, ahead, 0, GN_DEGREES(90), 1000, 80000) == GN_OK, "light");
    for (int wide = 0; wide < 2; wide++) {
        int32_t right = wide ? 30000 : 0;
        const int32_t corners[4][3] = {
            {-30000, -20000, -40000}, {right, -20000, -40000}, {right, 20000, -40000}, {-30000, 20000, -40000}};
        cap = quad_with_edges(corners);
        for (int i = 0; i < QUADS; i++) {
            gn_model_identity(&models[i]);
            require(gn_model_translate(&models[i], 0, 0, 100 * i) == GN_OK, "model");
            objects[i + 1].mesh = &cap;
            objects[i + 1].model = &models[i];
            objects[i + 1].colour = grey;
        }
        for (uint32_t count = QUADS / 2; count <= QUADS; count += QUADS / 2) {
            gn_scene scene = scene_of(objects, count + 1);
            gn_settings settings = volume_settings(320, 240);
            write_case(wide ? "cap-wide" : "cap-narrow", "-volumes-", count);
            measure_volumes(&scene, &settings, &camera, &light);
            settings.shadow = GN_SHADOW_MAP;
            write_case(wide ? "cap-wide" : "cap-narrow", "-map-", count);
            measure_camera_pass(&scene, &settings, &camera, &light);
        }
    }
}

/* A flat grid of quads, each of two triangles. Its edges twice: as they are, and as if every triangle stood alone,
 * whose sides cancel in pairs: the same shadow from many more silhouette edges. */
enum {
    GRID = 8,
    GRID_TRIANGLES = 2 * GRID * GRID,
    GRID_SHARED = 3 * GRID * GRID - 2 * GRID, /* edges of two triangles */
    GRID_EDGES = 3 * GRID_TRIANGLES - GRID_SHARED
};

static int32_t grid_vertices[(GRID + 1) * (GRID + 1)][3];
static uint16_t grid_indices[GRID_TRIANGLES][3];
static gn_mesh_edge shared_edges[GRID_EDGES], lone_edges[3 * GRID_TRIANGLES];

/* The half-edge between the same vertices as another one, run the other way. */
static uint32_t opposite_half_edge(uint32_t half)
{
    const uint16_t *t = grid_indices[half / 3];
    uint16_t from = t[half % 3], to = t[(half + 1) % 3];
    for (uint32_t other = 0; other < 3 * GRID_TRIANGLES; other++) {
        const uint16_t *o = grid_indices[other / 3];
        if (o[other % 3] == to && o[(other + 1) % 3] == from)
            return other;
    }
    return GN_NO_HALF_EDGE;
}

static void make_grid(int32_t x, int32_t z, int32_t cell)
{
    for (int32_t i = 0; i < (GRID + 1) * (GRID + 1); i++) {
        grid_vertices[i][0] = x + (i % (GRID + 1) - GRID / 2) * cell;
        grid_vertices[i][1] = (i / (GRID + 1) - GRID / 2) * cell;
        grid_vertices[i][2] = z;
    }
    for (uint16_t i = 0; i < GRID * GRID; i++) {
        uint16_t corner = (uint16_t)(i / GRID * (GRID + 1) + i % GRID);
        const uint16_t quad[4] = {corner, (uint16_t)(corner + 1), (uint16_t)(corner + GRID + 2),
                                  (uint16_t)(corner + GRID + 1)};
        for (int k = 0; k < 6; k++)
            grid_indices[2 * i + k / 3][k % 3] = quad[quad_indices[k / 3][k % 3]];
    }
    uint32_t count = 0;
    for (uint32_t half = 0; half < 3 * GRID_TRIANGLES; half++) {
        uint32_t other = opposite_half_edge(half);
        lone_edges[half].half[0] = half;
        lone_edges[half].half[1] = GN_NO_HALF_EDGE;
        if (other > half) {
            require(count < GRID_EDGES, "edges of the grid");
            shared_edges[count].half[0] = half;
            shared_edges[count++].half[1] = other;
        }
    }
    require(count == GRID_EDGES, "edges of the grid");
}

static gn_mesh grid_mesh(int lone)
{
    const gn_mesh mesh = {(const int32_t(*)[3])grid_vertices,
                          grid_indices,
                          (GRID + 1) * (GRID + 1),
                          GRID_TRIANGLES,
                          sizeof(uint16_t),
                          0,
                          lone ? lone_edges : shared_edges,
                          lone ? 3 * GRID_TRIANGLES : GRID_EDGES};
    return mesh;
}

/* Edges of a few pixels, their sides within the screen, leaving it, or not on it at all. One region: a side is set up
 * once for its rows and once to be drawn. */
static void measure_silhouettes(const char *name, const int32_t direction[3], int spot, int32_t x)
{
    static const int32_t eye[3] = {0, 0, 0}, ahead[3] = {0, 0, -20000}, up[3] = {0, 1, 0};
    gn_settings settings = volume_settings(160, 120);
    gn_camera camera;
    gn_light light;
    settings.region_height = 120;
    require(gn_look_at(&camera, eye, ahead, up) == GN_OK, "look at");
    require(gn_perspective(&camera, GN_DEGREES(38), 1000, 40000) == GN_OK, "camera");
    require(spot ? gn_spot_light(&light, direction, ahead, 0, GN_DEGREES(80), 2000, 80000) == GN_OK
                 : gn_directional_light(&light, direction, 0) == GN_OK,
            "light");
    make_grid(x, -10000, 60);
    for (int lone = 0; lone < 2; lone++) {
        gn_mesh mesh = grid_mesh(lone);
        const gn_object object = {&mesh, 0, {200, 180, 160}};
        gn_scene scene = scene_of(&object, 1);
        write_case(name, "-", lone ? 3 * GRID_TRIANGLES : 3 * GRID_TRIANGLES - 2 * GRID_SHARED);
        measure_volumes(&scene, &settings, &camera, &light);
    }
}

/* Facing, check of the edges, silhouettes: one grid, then two. */
static void measure_volumes_light(const char *name, int spot)
{
    static const int32_t direction[3] = {1, 1, -400}, lamp[3] = {300, 200, 5000}, ahead[3] = {0, 0, -20000};
    gn_mesh meshes[2] = {grid_mesh(0), grid_mesh(0)};
    const gn_object objects[2] = {{&meshes[0], 0, {200, 180, 160}}, {&meshes[1], 0, {200, 180, 160}}};
    gn_settings settings = volume_settings(160, 120);
    gn_light light;
    gn_plan plan;
    require(spot ? gn_spot_light(&light, lamp, ahead, 0, GN_DEGREES(80), 2000, 80000) == GN_OK
                 : gn_directional_light(&light, direction, 0) == GN_OK,
            "light");
    for (uint32_t count = 1; count <= 2; count++) {
        gn_scene scene = scene_of(objects, count);
        prepare(&scene, &settings, &plan);
        write_case(name, "-", count * GRID_TRIANGLES);
        mark_begin();
        gn_status status = gn_volumes_light(context, &light);
        mark_end();
        require(status == GN_OK, "volumes' light");
    }
}

/* Planes of receivers: a level grid of 128 triangles, and two triangles over the same pixels. gn_virtual_always asks
 * for the plane of every pixel, and finds it in the cache as long as no two triangles of a row of the image share an
 * entry; with points alone the same triangles cost what they cost otherwise. */
static void measure_planes(const char *name, const view *v)
{
    enum { CELL_OF_GRID = 800, END = GRID / 2 * CELL_OF_GRID, Z = -10000 };
    static const int32_t corners[4][3] = {{-END, -END, Z}, {END, -END, Z}, {END, END, Z}, {-END, END, Z}};
    gn_camera camera;
    gn_light light;
    make_grid(0, Z, CELL_OF_GRID);
    for (int whole = 0; whole < 2; whole++) {
        gn_mesh mesh = whole ? quad_with_edges(corners) : grid_mesh(0);
        const gn_object object = {&mesh, 0, {200, 180, 160}};
        gn_scene scene = scene_of(&object, 1);
        set_up_view(v, &scene, &camera, &light);
        for (int always = 0; always < 2; always++) {
            gn_settings settings = room_settings(v, 160, 2);
            settings.receiver = always ? &gn_virtual_always : 0;
            write_case(name, always ? "-virtual-" : "-point-", mesh.triangle_count);
            measure_camera_pass(&scene, &settings, &camera, &light);
        }
    }
}

/* ---- silhouette maps ------------------------------------------------------------------------------------------- */

/* All that the camera sees lies between the centres of four texels, and an edge of the occluder among them: the two on
 * the left are shadowed for every pixel. Its point is right of the middle, so that silhouettes shadow more. */
static void measure_one_cell(void)
{
    enum { TEXELS = 8, SIDE = 24000, ACROSS = TEXELS / 2 * SIDE, NEAREST = -40000 };
    static const int32_t corners[4][3] = {
        {-80000, -80000, 10000}, {1000, -80000, 10000}, {7000, 80000, 10000}, {-80000, 80000, 10000}};
    gn_mesh edge = quad_with_edges(corners), ground = quad_with_edges(receiver);
    const gn_object objects[] = {{&ground, 0, {200, 180, 160}}, {&edge, 0, {90, 90, 90}}};
    gn_scene scene = scene_of(objects, COUNT(objects));
    gn_camera camera;
    gn_light light;
    set_up_view(&views[0], &scene, &camera, &light);
    light_along_minus_z(&light);
    light.box_u = light.box_v = -ACROSS;
    light.box_width = light.box_height = 2 * ACROSS;
    light.box_z = NEAREST;
    light.box_depth = -2 * NEAREST;
    for (unsigned i = 0; i < COUNT(tests); i++) {
        const gn_reconstruction *how = tests[i].reconstruction;
        int silhouettes = how == &gn_silhouettes || how == &gn_silhouettes_smooth || how == &gn_crossings;
        if (!silhouettes && (how || (tests[i].receiver && tests[i].receiver != &gn_virtual)))
            continue;
        for (uint16_t width = 160; width <= 320; width = (uint16_t)(width + 160)) {
            gn_settings settings = room_settings(&views[0], width, 0);
            settings.map_width = settings.map_height = TEXELS;
            settings.receiver = tests[i].receiver;
            settings.reconstruction = how;
            look_at_view(&scene, &settings, &camera, &light);
            require(lit && (silhouettes ? shadowed > 2 * lit : shadowed < 2 * lit), "a border where it belongs");
            write_case("open-sun", tests[i].name, width);
            measure_camera_pass(&scene, &settings, &camera, &light);
        }
    }
}

/* Edges of so many texels, of the grid as it is and of its triangles as if each stood alone: 352 more silhouettes in
 * the same cells. Vertices lie 0.3 texel from the centres of texels, both ways. */
static void measure_drawn_edges(const char *name, const gn_reconstruction *how, int32_t texels)
{
    gn_settings settings = light_settings(GN_MIXED);
    settings.bias.unit = GN_BIAS_TEXELS;
    settings.reconstruction = how;
    make_grid(TEXEL * 8 / 10, 0, texels * TEXEL);
    for (int32_t i = 0; i < (GRID + 1) * (GRID + 1); i++)
        grid_vertices[i][1] += TEXEL * 8 / 10;
    for (int lone = 0; lone < 2; lone++) {
        gn_mesh mesh = grid_mesh(lone);
        const gn_object object = {&mesh, 0, {200, 180, 160}};
        gn_scene scene = scene_of(&object, 1);
        write_case(name, "-", lone ? 3 * GRID_TRIANGLES : 3 * GRID_TRIANGLES - 2 * GRID_SHARED);
        measure_light_pass(&scene, &settings);
    }
}

/* A grid that the light sees edge-on: no edge is a silhouette. One, or two; as it is, and with an edge for each side of
 * each triangle. */
static void measure_edges_looked_at(void)
{
    static const int32_t direction[3] = {1, 0, 0};
    make_grid(0, 0, 600);
    for (int lone = 0; lone < 2; lone++) {
        gn_mesh meshes[2] = {grid_mesh(lone), grid_mesh(lone)};
        const gn_object objects[2] = {{&meshes[0], 0, {200, 180, 160}}, {&meshes[1], 0, {200, 180, 160}}};
        for (int silhouettes = 0; silhouettes < 2; silhouettes++) {
            gn_settings settings = light_settings(GN_MIXED);
            settings.bias.unit = GN_BIAS_TEXELS;
            settings.reconstruction = silhouettes ? &gn_silhouettes : 0;
            for (uint32_t count = 1; count <= 2; count++) {
                gn_scene scene = scene_of(objects, count);
                gn_light light;
                require(gn_directional_light(&light, direction, 0) == GN_OK, "light");
                require(gn_fit_light(&light, &scene) == GN_OK, "fit");
                write_case(lone ? "edge-on-lone" : "edge-on", silhouettes ? "-silhouette-" : "-plain-",
                           count * GRID_TRIANGLES);
                measure_light_pass_of(&scene, &settings, &light);
            }
        }
    }
}

/* Light passes of the golden scenes, mixed, without silhouettes and with, map 128. */
static void measure_golden_light_passes(void)
{
    static const struct {
        const char *name;
        const gn_reconstruction *reconstruction;
    } with[] = {{"-light-plain-", 0}, {"-light-silhouette-", &gn_silhouettes}, {"-light-crossing-", &gn_crossings}};
    for (unsigned i = 0; i < COUNT(with); i++) {
        gn_settings settings = gn_default_settings(160, 120, 128);
        settings.surface = GN_MIXED;
        settings.bias.value = 2 << 16;
        settings.reconstruction = with[i].reconstruction;
        for (unsigned g = 0; g < COUNT(golden); g++) {
            write_case(golden[g].name, with[i].name, 128);
            measure_light_pass_of(golden[g].scene, &settings, golden[g].light);
        }
    }
}

static void measure_all_volumes(void)
{
    static const int32_t ahead[3] = {1, 1, -400}, across[3] = {4, 0, -1}, lamp[3] = {300, 200, 5000};
    measure_frame("lshape", &lshape_scene, &lshape_camera, &lshape_light);
    measure_frame("pins", &pins_scene, &pins_camera, &pins_light);
    measure_side_fragments(0);
    measure_side_fragments(1);
    measure_cap_fragments();
    measure_silhouettes("sides-off", across, 0, 100000);
    measure_silhouettes("sides-within", ahead, 0, 0);
    measure_silhouettes("sides-leaving", across, 0, 4300);
    measure_silhouettes("sides-spot", lamp, 1, 0);
    measure_volumes_light("facing-sun", 0);
    measure_volumes_light("facing-spot", 1);
}

int main(void)
{
    for (int pass = 1; pass >= 0; pass--) {
        measure_texels("one-wide", &wide_mesh, GN_CONSTANT, pass);
        measure_texels("one-narrow", &narrow_mesh, GN_CONSTANT, pass);
        measure_texels("two-wide", &wide_mesh, GN_DUAL, pass);
        measure_texels("two-narrow", &narrow_mesh, GN_DUAL, pass);
        measure_texels("slope-wide", &wide_mesh, GN_SLOPE, pass);
        measure_texels("slope-narrow", &narrow_mesh, GN_SLOPE, pass);
    }
    measure_map("one-map", GN_CONSTANT, 0);
    measure_map("two-map", GN_DUAL, 0);
    measure_map("slope-map", GN_SLOPE, 0);
    measure_map("silhouette-map", GN_DUAL, &gn_silhouettes);
    make_small_triangles();
    measure_small_triangles("one-small", GN_CONSTANT, 0);
    measure_small_triangles("two-small", GN_DUAL, 0);
    measure_small_triangles("slope-small", GN_SLOPE, 0);
    measure_small_triangles("rejected", GN_CONSTANT, 1);
    measure_vertices();
    for (unsigned i = 0; i < sizeof views / sizeof *views; i++)
        measure_pixels(&views[i]);
    measure_golden_frames();
    measure_all_agreements();
    measure_planes("planes-sun", &views[0]);
    measure_planes("planes-spot", &views[2]);
    measure_one_cell();
    measure_drawn_edges("drawn-short", &gn_silhouettes, 1);
    measure_drawn_edges("drawn-long", &gn_silhouettes, 16);
    measure_drawn_edges("crossing-short", &gn_crossings, 1);
    measure_drawn_edges("crossing-long", &gn_crossings, 16);
    measure_edges_looked_at();
    measure_golden_light_passes();
    measure_all_volumes();
    return 0;
}
