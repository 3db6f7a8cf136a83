/* The public interface: plan, init, passes, and what they promise about memory, order and status. Images are compared
 * with the image of the plainest settings. Cases: 400 random settings, or GNOMON_CASES. */
#include "gn_cascade.h"
#include "scenes.h"

#include <pthread.h>
#include <stdint.h>
#include <sys/mman.h>

static uint64_t lit, shadowed; /* of all images compared */

/* ---- a scene with a shadow ------------------------------------------------------------------------------------- */

typedef struct courtyard {
    shape ground, box, sheet;
    gn_model model;
    gn_object objects[4];
    gn_scene scene;
    gn_light sun, spot;
    gn_camera camera;
} courtyard;

static const int32_t up[3] = {0, 1, 0};

enum { UNIT = 256 }; /* of length: uses most of the world's range */

/* Two boxes, one of them by a model matrix, and a slanted sheet over a floor. closed: without floor and sheet. */
static void build(courtyard *c, int closed)
{
    int32_t low[3] = {-1000 * UNIT, 0, -1000 * UNIT}, high[3] = {1000 * UNIT, 1800 * UNIT, 900 * UNIT};
    int32_t p0[3] = {1500 * UNIT, 500 * UNIT, -2500 * UNIT}, p1[3] = {3500 * UNIT, 700 * UNIT, -2500 * UNIT},
            p2[3] = {3500 * UNIT, 2600 * UNIT, -500 * UNIT}, p3[3] = {1500 * UNIT, 2500 * UNIT, -500 * UNIT};
    int32_t g0[3] = {-6000 * UNIT, 0, -6000 * UNIT}, g1[3] = {-6000 * UNIT, 0, 6000 * UNIT},
            g2[3] = {6000 * UNIT, 0, 6000 * UNIT}, g3[3] = {6000 * UNIT, 0, -6000 * UNIT};
    int32_t direction[3] = {30, -50, -20}, eye[3] = {7000 * UNIT, 6000 * UNIT, 9000 * UNIT},
            target[3] = {0, 500 * UNIT, 0}, lamp[3] = {-5000 * UNIT, 9000 * UNIT, 4000 * UNIT};
    int32_t axis[3] = {1, 2, 3};
    memset(c, 0, sizeof *c);
    c->ground = shape_new(closed);
    c->box = shape_new(1);
    c->sheet = shape_new(0);
    if (closed) {
        int32_t deep[3] = {-6000 * UNIT, -800 * UNIT, -6000 * UNIT}, top[3] = {6000 * UNIT, 0, 6000 * UNIT};
        add_box(&c->ground, deep, top);
    } else {
        add_quad(&c->ground, g0, g1, g2, g3);
    }
    add_box(&c->box, low, high);
    add_quad(&c->sheet, p0, p1, p2, p3);
    gn_model_identity(&c->model);
    gn_model_scale(&c->model, 1 << 15, 3 << 15, -1 * (1 << 15)); /* mirrored */
    gn_model_rotate(&c->model, axis, GN_DEGREES(33));
    gn_model_translate(&c->model, -3000 * UNIT, 1500 * UNIT, 1000 * UNIT);
    gn_object objects[4] = {{&c->ground.mesh, 0, {200, 180, 160}},
                            {&c->box.mesh, 0, {250, 40, 40}},
                            {&c->box.mesh, &c->model, {40, 250, 40}},
                            {&c->sheet.mesh, 0, {40, 40, 250}}};
    memcpy(c->objects, objects, sizeof objects);
    c->scene.objects = c->objects;
    c->scene.object_count = closed ? 3 : 4;
    c->scene.background.b = 90;
    c->scene.ambient = 20000;
    gn_status status = gn_directional_light(&c->sun, direction, 0);
    if (status == GN_OK)
        status = gn_fit_light(&c->sun, &c->scene);
    if (status == GN_OK)
        status = gn_spot_light(&c->spot, lamp, target, 0, GN_DEGREES(70), 1000 * UNIT, 30000 * UNIT);
    if (status == GN_OK)
        status = gn_look_at(&c->camera, eye, target, up);
    if (status == GN_OK)
        status = gn_perspective(&c->camera, GN_DEGREES(45), 500 * UNIT, 60000 * UNIT);
    if (status != GN_OK)
        ok(0, "the scene is set up: status %d", (int)status);
}

static void demolish(courtyard *c)
{
    shape_free(&c->ground);
    shape_free(&c->box);
    shape_free(&c->sheet);
}

static gn_settings plain_settings(void)
{
    gn_settings s = gn_default_settings(50, 40, 64);
    s.surface = GN_CONSTANT;
    s.mask = 1;
    return s;
}

/* Do two frames show the same? Prints the first pixel that differs. */
static int same_image(const char *what, const frame *got, const frame *expected)
{
    size_t bytes = pixel_bytes(got);
    for (size_t i = 0; i < mask_bytes(expected); i++) {
        if (got->mask[i] != expected->mask[i] || memcmp(got->colour + i * bytes, expected->colour + i * bytes, bytes)) {
            note("%s: pixel (%u, %u): got mask %u, colour %u..., expected mask %u, colour %u...", what,
                 (unsigned)(i % expected->settings.width), (unsigned)(i / expected->settings.width),
                 (unsigned)got->mask[i], (unsigned)got->colour[i * bytes], (unsigned)expected->mask[i],
                 (unsigned)expected->colour[i * bytes]);
            return 0;
        }
    }
    return 1;
}

/* The image of the plainest way through the interface. */
static gn_status render_plain(frame *f, const courtyard *c, const gn_settings *s, const gn_light *light)
{
    gn_status status = frame_start(f, &c->scene, s);
    if (status == GN_OK)
        status = frame_render(f, light, &c->camera);
    count_mask(f, &lit, &shadowed);
    return status;
}

/* ---- status codes ---------------------------------------------------------------------------------------------- */

static int status_is(const char *what, gn_status got, gn_status expected)
{
    int good = ok(got == expected, "%s", what);
    if (!good)
        note("got status %d, expected %d", (int)got, (int)expected);
    return good;
}

static gn_status plan_of(const courtyard *c, const gn_settings *s)
{
    gn_plan plan;
    gn_plan untouched;
    memset(&plan, 0x77, sizeof plan);
    untouched = plan;
    gn_status status = gn_make_plan(&plan, &c->scene, s);
    if (status != GN_OK && memcmp(&plan, &untouched, sizeof plan))
        ok(0, "a plan that is refused is not written");
    return status;
}

static void bad_settings_are_refused(const courtyard *c)
{
    gn_settings s = plain_settings();
    status_is("these settings are good", plan_of(c, &s), GN_OK);
#define REFUSED(change, status)                                                                                        \
    do {                                                                                                               \
        s = plain_settings();                                                                                          \
        change;                                                                                                        \
        status_is(#change " is " #status, plan_of(c, &s), status);                                                     \
    } while (0)
    REFUSED(s.width = 0, GN_OUT_OF_RANGE);
    REFUSED(s.height = 0, GN_OUT_OF_RANGE);
    REFUSED(s.width = GN_MAX_SIZE + 1, GN_OUT_OF_RANGE);
    REFUSED(s.height = GN_MAX_SIZE + 1, GN_OUT_OF_RANGE);
    REFUSED(s.map_width = 0, GN_OUT_OF_RANGE);
    REFUSED(s.map_height = 0, GN_OUT_OF_RANGE);
    REFUSED(s.map_width = GN_MAX_SIZE + 1, GN_OUT_OF_RANGE);
    REFUSED(s.map_height = GN_MAX_SIZE + 1, GN_OUT_OF_RANGE);
    REFUSED(s.map_rows = GN_MAX_SIZE + 1, GN_OUT_OF_RANGE);
    REFUSED(s.region_width = GN_MAX_SIZE + 1, GN_OUT_OF_RANGE);
    REFUSED(s.region_height = GN_MAX_SIZE + 1, GN_OUT_OF_RANGE);
    REFUSED(s.workers = 0, GN_OUT_OF_RANGE);
    REFUSED(s.workers = 65, GN_OUT_OF_RANGE);
    REFUSED(s.cull = GN_CULL_FRONT + 1, GN_BAD_ARGUMENT);
    REFUSED(s.layers = GN_LAYERS_TWO + 1, GN_BAD_ARGUMENT);
    REFUSED(s.surface = GN_SLOPE + 1, GN_BAD_ARGUMENT);
    REFUSED(s.format = GN_RGB565 + 1, GN_BAD_ARGUMENT);
    REFUSED(s.mask = 2, GN_BAD_ARGUMENT);
    REFUSED(s.bias.unit = GN_BIAS_RANGE + 1, GN_BAD_ARGUMENT);
    REFUSED((s.bias.unit = GN_BIAS_WORLD, s.bias.value = (1u << 28) + 1), GN_OUT_OF_RANGE);
    REFUSED(s.slope = -1, GN_OUT_OF_RANGE);
    REFUSED(s.slope = (64 << 16) + 1, GN_OUT_OF_RANGE);
    /* combinations without sense */
    REFUSED((s.surface = GN_CONSTANT, s.layers = GN_LAYERS_TWO), GN_UNSUPPORTED);
    REFUSED((s.surface = GN_MIDPOINT, s.layers = GN_LAYERS_FIRST), GN_UNSUPPORTED);
    REFUSED((s.surface = GN_DUAL, s.layers = GN_LAYERS_FIRST), GN_UNSUPPORTED);
    REFUSED((s.surface = GN_MIXED, s.layers = GN_LAYERS_FIRST), GN_UNSUPPORTED);
    REFUSED((s.surface = GN_MIXED, s.cull = GN_CULL_BACK), GN_UNSUPPORTED);
    REFUSED((s.surface = GN_DUAL, s.cull = GN_CULL_FRONT), GN_UNSUPPORTED);
    REFUSED((s.surface = GN_SECOND, s.layers = GN_LAYERS_TWO, s.cull = GN_CULL_FRONT), GN_UNSUPPORTED);
    REFUSED((s.surface = GN_SECOND, s.layers = GN_LAYERS_FIRST, s.cull = GN_CULL_NONE), GN_UNSUPPORTED);
    REFUSED((s.surface = GN_SLOPE, s.layers = GN_LAYERS_TWO), GN_UNSUPPORTED);
    /* what stands about a point needs two texels each way */
    REFUSED((s.receiver = &gn_virtual, s.map_width = 1), GN_UNSUPPORTED);
    REFUSED((s.receiver = &gn_virtual_always, s.map_height = 1), GN_UNSUPPORTED);
    REFUSED((s.receiver = &gn_plane_bias, s.map_width = s.map_height = 1), GN_UNSUPPORTED);
    REFUSED((s.reconstruction = &gn_bilinear, s.map_width = 1), GN_UNSUPPORTED);
    REFUSED((s.reconstruction = &gn_box_7x7, s.map_height = 1), GN_UNSUPPORTED);
    REFUSED((s.receiver = &gn_virtual, s.reconstruction = &gn_jitter_4x4, s.map_width = s.map_height = 2), GN_OK);
    /* ends of the ranges */
    REFUSED((s.surface = GN_SLOPE, s.slope = 64 << 16), GN_OK);
    REFUSED((s.surface = GN_SLOPE, s.cull = GN_CULL_FRONT), GN_OK);
    REFUSED((s.receiver = &gn_virtual, s.reconstruction = &gn_box_3x3, s.width = s.height = GN_MAX_SIZE), GN_OK);
    REFUSED((s.width = s.height = s.map_width = s.map_height = 1, s.workers = 64), GN_OK);
    REFUSED((s.width = s.height = s.map_width = s.map_height = GN_MAX_SIZE), GN_OK);
    REFUSED((s.region_width = s.region_height = s.map_rows = GN_MAX_SIZE), GN_OK);
    REFUSED((s.bias.unit = GN_BIAS_WORLD, s.bias.value = 1u << 28), GN_OK);
#undef REFUSED
}

/* Scenes that are wrong in one place. */
static void bad_scenes_are_refused(courtyard *c)
{
    gn_settings s = plain_settings();
    gn_plan plan;
    gn_context *context;
    uint64_t block[8] = {0};
    const gn_object *objects = c->scene.objects;
    static uint32_t odd[4];

    status_is("no plan", gn_make_plan(0, &c->scene, &s), GN_BAD_ARGUMENT);
    status_is("no scene", gn_make_plan(&plan, 0, &s), GN_BAD_ARGUMENT);
    status_is("no settings", gn_make_plan(&plan, &c->scene, 0), GN_BAD_ARGUMENT);
    status_is("init without a context", gn_init(0, &c->scene, &s, block, sizeof block), GN_BAD_ARGUMENT);
    status_is("init without memory", gn_init(&context, &c->scene, &s, 0, 1000000), GN_BAD_ARGUMENT);
    status_is("init with bad settings", (s.width = 0, gn_init(&context, &c->scene, &s, block, 1000000)),
              GN_OUT_OF_RANGE);
    s = plain_settings();

#define REFUSED(what, place, bad, status)                                                                              \
    do {                                                                                                               \
        __typeof__(place) good = place;                                                                                \
        place = bad;                                                                                                   \
        status_is(what, plan_of(c, &s), status);                                                                       \
        place = good;                                                                                                  \
    } while (0)
    c->scene.objects = 0;
    status_is("no objects, but a count of them", plan_of(c, &s), GN_BAD_ARGUMENT);
    c->scene.objects = objects;
    REFUSED("an object without a mesh", c->objects[1].mesh, 0, GN_BAD_ARGUMENT);
    REFUSED("a mesh without vertices", c->ground.mesh.vertices, 0, GN_BAD_ARGUMENT);
    REFUSED("a mesh without indices", c->ground.mesh.indices, 0, GN_BAD_ARGUMENT);
    REFUSED("an index size of 0", c->ground.mesh.index_size, 0, GN_BAD_MESH);
    REFUSED("an index size of 3", c->ground.mesh.index_size, 3, GN_BAD_MESH);
    REFUSED("indices that are not aligned", c->ground.mesh.indices, (const void *)((const uint8_t *)odd + 2),
            GN_BAD_MESH);
    REFUSED("an index beyond the vertices", c->ground.indices[3], 4, GN_BAD_MESH);
    REFUSED("a vertex count that leaves out the last", c->box.mesh.vertex_count, 7, GN_BAD_MESH);
    REFUSED("2^28 vertices", c->ground.mesh.vertex_count, 1u << 28, GN_TOO_MANY);
    REFUSED("2^28 triangles", c->ground.mesh.triangle_count, 1u << 28, GN_TOO_MANY);
    REFUSED("a vertex beyond the world", c->ground.vertices[2][1], GN_WORLD_MAX + 1, GN_OUT_OF_RANGE);
    REFUSED("a vertex beyond the world, negative", c->ground.vertices[0][2], -GN_WORLD_MAX - 1, GN_OUT_OF_RANGE);
    REFUSED("a vertex at the end of the world", c->ground.vertices[2][1], GN_WORLD_MAX, GN_OK);
    REFUSED("a model with a shift of 63", c->model.shift, 63, GN_OUT_OF_RANGE);
    REFUSED("a model with an element beyond 2^30", c->model.m[1][1], (1 << 30) + 1, GN_OUT_OF_RANGE);

    /* a model that takes vertices out of the world shows when they are moved */
    frame f;
    gn_light light = c->sun;
    gn_status status = frame_start(&f, &c->scene, &s);
    c->model.t[0] += 2 * GN_WORLD_MAX;
    status_is("a model that leaves the world, when planned", status, GN_OK);
    status_is("a model that leaves the world, in the light pass", gn_light_pass(f.context, &light), GN_OUT_OF_RANGE);
    status_is("a model that leaves the world, in the fit", gn_fit_light(&light, &c->scene), GN_OUT_OF_RANGE);
    status_is("a camera after a light pass that failed", gn_camera_begin(f.context, &c->camera), GN_NOT_READY);
    c->model.t[0] -= 2 * GN_WORLD_MAX;
    status_is("back in the world", frame_render(&f, &light, &c->camera), GN_OK);
    c->model.t[0] += 2 * GN_WORLD_MAX;
    status_is("a model that leaves the world, in the camera pass", gn_camera_begin(f.context, &c->camera),
              GN_OUT_OF_RANGE);
    status_is("a region after a camera that failed", gn_camera_region(f.context, 0, 0, 0, 0, &(gn_pixels){0}),
              GN_NOT_READY);
    c->model.t[0] -= 2 * GN_WORLD_MAX;
    frame_end(&f);
#undef REFUSED
}

/* 2^32 identifiers: objects x the largest mesh's triangles, each rounded up to a power of two. */
static void identifiers_that_do_not_fit_are_refused(void)
{
    enum { MANY = 70000 };
    static uint16_t indices[3 * MANY];
    int32_t vertex[1][3] = {{0, 0, 0}};
    gn_mesh big = {(const int32_t(*)[3])vertex, indices, 1, MANY, 2, 0, 0, 0};
    gn_mesh small = {(const int32_t(*)[3])vertex, indices, 1, 1, 2, 0, 0, 0};
    gn_object *objects = grown(0, 40000 * sizeof *objects);
    gn_scene scene;
    gn_plan plan;
    gn_settings s = plain_settings();
    memset(objects, 0, 40000 * sizeof *objects);
    memset(&scene, 0, sizeof scene);
    for (int i = 0; i < 40000; i++)
        objects[i].mesh = &small;
    objects[7].mesh = &big; /* 17 bits */
    scene.objects = objects;
    scene.object_count = 32767; /* 15 bits, and one identifier to spare */
    status_is("32767 objects of up to 70000 triangles fit", gn_make_plan(&plan, &scene, &s), GN_OK);
    scene.object_count = 32768;
    status_is("32768 objects of up to 70000 triangles do not", gn_make_plan(&plan, &scene, &s), GN_TOO_MANY);
    for (int i = 0; i < 4000; i++)
        objects[i].mesh = &big;
    scene.object_count = 4000;
    status_is("280 million triangles do not", gn_make_plan(&plan, &scene, &s), GN_TOO_MANY);
    free(objects);
}

static void steps_out_of_order_are_refused(const courtyard *c)
{
    gn_settings s = plain_settings();
    gn_pixels pixels;
    frame f;
    uint8_t colour[50 * 40 * 3], mask[50 * 40];
    s.map_rows = 10;
    s.region_height = 10;
    gn_light bad_light = c->sun;
    gn_camera bad_camera = c->camera;
    bad_light.box_width = 0;
    bad_camera.tan_half = 0;
    frame_start(&f, &c->scene, &s);
    status_is("layers before begin", gn_light_layers(f.context, 0, 0), GN_NOT_READY);
    status_is("resolve before begin", gn_light_resolve(f.context, 0, 0), GN_NOT_READY);
    status_is("a camera before any light", gn_camera_begin(f.context, &c->camera), GN_NOT_READY);
    status_is("a camera pass before any light", gn_camera_pass(f.context, &c->camera, frame_flush, &f), GN_NOT_READY);
    status_is("a camera region before begin", gn_camera_region(f.context, 0, 0, colour, mask, &pixels), GN_NOT_READY);
    status_is("no light", gn_light_begin(f.context, 0), GN_BAD_ARGUMENT);
    status_is("no context for a light", gn_light_begin(0, &c->sun), GN_BAD_ARGUMENT);
    status_is("no context for a light pass", gn_light_pass(0, &c->sun), GN_BAD_ARGUMENT);
    status_is("no context for layers", gn_light_layers(0, 0, 0), GN_BAD_ARGUMENT);
    status_is("no context to resolve", gn_light_resolve(0, 0, 0), GN_BAD_ARGUMENT);
    status_is("no context for a camera", gn_camera_begin(0, &c->camera), GN_BAD_ARGUMENT);
    status_is("no context for a camera pass", gn_camera_pass(0, &c->camera, frame_flush, &f), GN_BAD_ARGUMENT);
    status_is("no context for a region", gn_camera_region(0, 0, 0, colour, mask, &pixels), GN_BAD_ARGUMENT);
    status_is("a light that is not possible", gn_light_begin(f.context, &bad_light), GN_OUT_OF_RANGE);
    status_is("layers after a light that is not possible", gn_light_layers(f.context, 0, 0), GN_NOT_READY);
    status_is("begin", gn_light_begin(f.context, &c->sun), GN_OK);
    status_is("to resolve what has no layers yet", gn_light_resolve(f.context, 0, 0), GN_NOT_READY);
    status_is("a camera before all light regions are done", gn_camera_begin(f.context, &c->camera), GN_NOT_READY);
    status_is("a light region that does not exist", gn_light_layers(f.context, f.plan.light_regions, 0),
              GN_BAD_ARGUMENT);
    status_is("a worker that does not exist", gn_light_layers(f.context, 0, 1), GN_BAD_ARGUMENT);
    status_is("to resolve a region that does not exist", gn_light_resolve(f.context, f.plan.light_regions, 0),
              GN_BAD_ARGUMENT);
    for (uint32_t i = 0; i < f.plan.light_regions; i++)
        if (gn_light_layers(f.context, i, 0) != GN_OK || gn_light_resolve(f.context, i, 0) != GN_OK)
            ok(0, "light region %u", (unsigned)i);
    status_is("to resolve twice", gn_light_resolve(f.context, 3, 0), GN_NOT_READY);
    status_is("layers once more", gn_light_layers(f.context, 3, 0), GN_OK);
    status_is("a camera before they are resolved", gn_camera_begin(f.context, &c->camera), GN_NOT_READY);
    status_is("to resolve them", gn_light_resolve(f.context, 3, 0), GN_OK);
    uint32_t first, rows, stride;
    ok(gn_layer(f.context, 0, f.plan.light_regions - 1, 0, &first, &rows, &stride) && first == 60 && rows == 4,
       "the last region is cut off by the map");
    ok(!gn_layer(f.context, 1, 0, 0, &first, &rows, &stride), "there is no second layer with one");
    ok(!gn_layer(f.context, 2, 0, 0, &first, &rows, &stride) && !gn_layer(0, 0, 0, 0, &first, &rows, &stride) &&
           !gn_layer(f.context, 0, 99, 0, &first, &rows, &stride) &&
           !gn_layer(f.context, 0, 0, 1, &first, &rows, &stride),
       "there are no layers of other regions, workers, contexts");
    status_is("no camera", gn_camera_begin(f.context, 0), GN_BAD_ARGUMENT);
    status_is("no flush", gn_camera_pass(f.context, &c->camera, 0, 0), GN_BAD_ARGUMENT);
    status_is("a camera that is not possible", gn_camera_begin(f.context, &bad_camera), GN_OUT_OF_RANGE);
    status_is("a camera after it", gn_camera_begin(f.context, &c->camera), GN_OK);
    status_is("layers after the light pass has ended", gn_light_layers(f.context, 0, 0), GN_NOT_READY);
    status_is("a camera region that does not exist",
              gn_camera_region(f.context, f.plan.camera_regions, 0, colour, mask, &pixels), GN_BAD_ARGUMENT);
    status_is("a camera worker that does not exist", gn_camera_region(f.context, 0, 1, colour, mask, &pixels),
              GN_BAD_ARGUMENT);
    status_is("no place for the description", gn_camera_region(f.context, 0, 0, colour, mask, 0), GN_BAD_ARGUMENT);
    s.format = GN_RGB565;
    frame half;
    frame_start(&half, &c->scene, &s);
    status_is("a frame of 16-bit colours", frame_render(&half, &c->sun, &c->camera), GN_OK);
    status_is("16-bit colours at an odd address",
              gn_camera_region(half.context, 0, 0, colour + (1 ^ ((uintptr_t)colour & 1)), mask, &pixels),
              GN_MISALIGNED);
    status_is("a light that fails after a good frame", gn_light_begin(half.context, &bad_light), GN_OUT_OF_RANGE);
    status_is("a region after it", gn_camera_region(half.context, 0, 0, 0, mask, &pixels), GN_NOT_READY);
    status_is("a camera after that", gn_camera_begin(half.context, &c->camera), GN_NOT_READY);
    frame_end(&half);
    status_is("neither colour nor mask wanted", gn_camera_region(f.context, 0, 0, 0, 0, &pixels), GN_OK);
    ok(!pixels.colour && !pixels.mask && pixels.width == 50 && pixels.height == 10, "but described");
    status_is("a new light ends the camera", gn_light_begin(f.context, &c->sun), GN_OK);
    status_is("a region with a light that is not done", gn_camera_region(f.context, 0, 0, colour, mask, &pixels),
              GN_NOT_READY);
    frame_end(&f);
}

/* ---- memory ---------------------------------------------------------------------------------------------------- */

static void blocks_too_small_or_misaligned_are_refused(const courtyard *c)
{
    gn_settings s = plain_settings();
    gn_plan plan;
    gn_context *context = 0;
    status_is("planned", gn_make_plan(&plan, &c->scene, &s), GN_OK);
    uint8_t *block = grown(0, plan.bytes + 16);
    memset(block, 0x11, plan.bytes + 16);
    status_is("one byte too small", gn_init(&context, &c->scene, &s, block, plan.bytes - 1), GN_TOO_SMALL);
    status_is("nothing at all", gn_init(&context, &c->scene, &s, block, 0), GN_TOO_SMALL);
    for (int i = 1; i < GN_ALIGNMENT; i++)
        status_is("misaligned", gn_init(&context, &c->scene, &s, block + i, plan.bytes + 8), GN_MISALIGNED);
    int untouched = !context;
    for (size_t i = 0; i < plan.bytes + 16; i++)
        untouched &= block[i] == 0x11;
    ok(untouched, "a block that is refused is not written");
    status_is("as planned", gn_init(&context, &c->scene, &s, block + 8, plan.bytes), GN_OK);
    ok((uint8_t *)context == block + 8, "the context is the block");
    ok(plan.bytes == (plan.light_bytes > plan.camera_bytes ? plan.light_bytes : plan.camera_bytes) &&
           plan.map_bytes >= 64 * 64 * sizeof(gn_depth) && plan.map_bytes < plan.light_bytes &&
           plan.triangles == 2 + 12 + 12 + 2 && plan.vertices == 4 + 8 + 8 + 4 && plan.light_regions == 1 &&
           plan.camera_regions == 1,
       "the plan counts bytes, triangles, vertices, regions");
    free(block);
}

/* Settings that may not change the image. */
static gn_settings without_effect(gn_settings s)
{
    s.region_width = (uint16_t)between(0, s.width + 3);
    s.region_height = (uint16_t)between(0, s.height + 3);
    s.map_rows = (uint16_t)between(0, s.map_height + 3);
    s.workers = (uint8_t)between(1, 5);
    return s;
}

/* All that a pixel may be tested with; 0 is the point, and the nearest texel. */
static const gn_receiver *const receivers[] = {0, &gn_plane_bias, &gn_virtual, &gn_virtual_always};
static const gn_reconstruction *const reconstructions[] = {
    0, &gn_bilinear, &gn_jitter_4x4, &gn_box_3x3, &gn_box_5x5, &gn_box_7x7, &gn_silhouettes, &gn_silhouettes_smooth};

static gn_settings random_settings(void)
{
    static const uint8_t surfaces[] = {GN_CONSTANT, GN_MIDPOINT, GN_DUAL, GN_SECOND, GN_MIXED, GN_SLOPE};
    gn_settings s = gn_default_settings((uint16_t)between(1, 70), (uint16_t)between(1, 50), 1);
    s.map_width = (uint16_t)between(1, 90);
    s.map_height = (uint16_t)between(1, 90);
    s.surface = surfaces[between(0, 5)];
    s.slope = between(0, 3 << 16);
    if (s.map_width > 1 && s.map_height > 1) {
        s.receiver = receivers[between(0, 3)];
        s.reconstruction = reconstructions[between(0, 7)];
    }
    s.format = (uint8_t)between(GN_NO_COLOUR, GN_RGB565);
    s.mask = 1;
    s.bias.unit = (uint8_t)between(GN_BIAS_WORLD, GN_BIAS_RANGE);
    s.bias.value = s.bias.unit == GN_BIAS_TEXELS ? 1 << 16 : s.bias.unit == GN_BIAS_WORLD ? 50 * UNIT : 1 << 24;
    return s;
}

static void images_do_not_depend_on_regions_and_memory_is_kept(const courtyard *c, uint64_t cases)
{
    unsigned failures = 0;
    uint64_t with_receiver = 0, with_reconstruction = 0, partly = 0;
    for (uint64_t n = 0; n < cases && failures < 5; n++) {
        gn_settings s = random_settings(), other = without_effect(s);
        const gn_light *light = between(0, 1) ? &c->sun : &c->spot;
        frame a, b;
        gn_status status = render_plain(&a, c, &s, light);
        if (status == GN_OK)
            status = render_plain(&b, c, &other, light);
        if (status != GN_OK && failures++ < 5)
            note("case %llu: status %d", (unsigned long long)n, (int)status);
        with_receiver += s.receiver != 0;
        with_reconstruction += s.reconstruction != 0;
        for (size_t i = 0; status == GN_OK && i < mask_bytes(&a); i++)
            partly += a.mask[i] > 0 && a.mask[i] < 254;
        if (status == GN_OK && !same_image("regions", &b, &a)) {
            failures++;
            note("case %llu: image %ux%u, map %ux%u, surface %u, regions %ux%u, %u rows of the map",
                 (unsigned long long)n, (unsigned)s.width, (unsigned)s.height, (unsigned)s.map_width,
                 (unsigned)s.map_height, (unsigned)s.surface, (unsigned)b.plan.region_width,
                 (unsigned)b.plan.region_height, (unsigned)b.plan.map_rows);
        }
        uint32_t across = (s.width + b.plan.region_width - 1u) / b.plan.region_width;
        uint32_t down = (s.height + b.plan.region_height - 1u) / b.plan.region_height;
        if (status == GN_OK && (b.regions != (int)b.plan.camera_regions || across * down != b.plan.camera_regions)) {
            failures++;
            note("case %llu: %d regions flushed, %u planned", (unsigned long long)n, b.regions,
                 (unsigned)b.plan.camera_regions);
        }
        int intact = frame_end(&a);
        if (status == GN_OK && !(frame_end(&b) && intact)) {
            failures++;
            note("case %llu: something outside the block was written", (unsigned long long)n);
        }
    }
    ok(!failures, "images do not depend on regions or workers; nothing outside the block is written: %llu settings",
       (unsigned long long)cases);
    ok(with_receiver > cases / 2 && with_reconstruction > cases / 2 && partly > 10 * cases,
       "%llu of them with a receiver, %llu with a reconstruction; %llu pixels were partly lit",
       (unsigned long long)with_receiver, (unsigned long long)with_reconstruction, (unsigned long long)partly);
}

static void odd_sizes_work(const courtyard *c)
{
    static const uint16_t sizes[][4] = {/* image, map */
                                        {1, 1, 1, 1},     {1, 1, 64, 64},  {50, 40, 1, 1},   {64, 1, 4096, 1},
                                        {1, 64, 1, 4096}, {7, 3, 4095, 3}, {4096, 2, 32, 5}, {3, 4096, 5, 32},
                                        {40, 30, 2, 2},   {40, 30, 3, 2},  {2, 5, 4096, 2},  {300, 3, 2, 4095}};
    static const uint16_t regions[][2] = {{0, 0}, {1, 1}, {7, 3}, {4096, 4096}};
    for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; i++) {
        unsigned failures = 0;
        frame plain;
        gn_settings s = gn_default_settings(sizes[i][0], sizes[i][1], 1);
        s.map_width = sizes[i][2];
        s.map_height = sizes[i][3];
        s.mask = 1;
        if (s.map_width > 1 && s.map_height > 1) {
            s.receiver = receivers[1 + i % 3];
            s.reconstruction = reconstructions[i / 4 % 8];
        }
        gn_status status = render_plain(&plain, c, &s, &c->sun);
        failures += status != GN_OK;
        for (size_t r = 0; r < sizeof regions / sizeof regions[0]; r++) {
            frame f;
            s.region_width = regions[r][0];
            s.region_height = regions[r][1];
            s.map_rows = regions[r][1];
            failures += render_plain(&f, c, &s, &c->sun) != GN_OK || !same_image("regions", &f, &plain);
            failures += !frame_end(&f);
        }
        ok(!failures, "image %ux%u, map %ux%u, in regions of 1x1, 7x3 and all", (unsigned)sizes[i][0],
           (unsigned)sizes[i][1], (unsigned)sizes[i][2], (unsigned)sizes[i][3]);
        frame_end(&plain);
    }
}

static void empty_scenes_show_the_background(const courtyard *c)
{
    gn_mesh nothing = {0, 0, 0, 0, 2, 1, 0, 0};
    gn_object object = {&nothing, 0, {1, 2, 3}};
    for (int objects = 0; objects < 2; objects++) {
        for (int format = GN_NO_COLOUR; format <= GN_RGB565; format++) {
            gn_scene scene;
            frame f;
            gn_settings s = plain_settings();
            memset(&scene, 0, sizeof scene);
            scene.objects = objects ? &object : 0;
            scene.object_count = (uint32_t)objects;
            scene.background.r = 255;
            scene.background.g = 128;
            scene.background.b = 7;
            s.format = (uint8_t)format;
            s.surface = GN_SECOND;
            s.region_height = 7;
            gn_status status = frame_start(&f, &scene, &s);
            if (status == GN_OK)
                status = frame_render(&f, &c->sun, &c->camera);
            int good = status == GN_OK;
            /* RGB565 by hand: 31, 128 x 63 / 255 = 31.6, 7 x 31 / 255 = 0.85 */
            uint16_t packed = 31 << 11 | 32 << 5 | 1;
            for (size_t i = 0; good && i < mask_bytes(&f); i++) {
                good &= f.mask[i] == 255;
                if (format == GN_RGB888)
                    good &= f.colour[3 * i] == 255 && f.colour[3 * i + 1] == 128 && f.colour[3 * i + 2] == 7;
                if (format == GN_RGB565)
                    good &= !memcmp(f.colour + 2 * i, &packed, 2);
            }
            good &= frame_end(&f);
            ok(good, "%s: background only, format %d", objects ? "no triangles" : "no objects", format);
        }
    }
}

/* ---- same scene, other ways ------------------------------------------------------------------------------------ */

static void index_sizes_give_the_same_image(const courtyard *c)
{
    uint16_t indices[3][36];
    gn_mesh meshes[3] = {c->ground.mesh, c->box.mesh, c->sheet.mesh};
    gn_object objects[4];
    gn_scene scene = c->scene;
    frame a, b;
    gn_settings s = plain_settings();
    for (int m = 0; m < 3; m++) {
        for (uint32_t i = 0; i < 3 * meshes[m].triangle_count; i++)
            indices[m][i] = (uint16_t)((const uint32_t *)meshes[m].indices)[i];
        meshes[m].indices = indices[m];
        meshes[m].index_size = 2;
    }
    memcpy(objects, c->objects, sizeof objects);
    objects[0].mesh = &meshes[0];
    objects[1].mesh = objects[2].mesh = &meshes[1];
    objects[3].mesh = &meshes[2];
    scene.objects = objects;
    int good = render_plain(&a, c, &s, &c->sun) == GN_OK && frame_start(&b, &scene, &s) == GN_OK &&
               frame_render(&b, &c->sun, &c->camera) == GN_OK && same_image("16-bit indices", &b, &a);
    good &= a.plan.bytes == b.plan.bytes;
    good &= frame_end(&a);
    ok(good && frame_end(&b), "16-bit and 32-bit indices give the same image");
}

/* The scene and all that it points to may lie in flash. */
static void scenes_are_never_written(const courtyard *c)
{
    enum { PAGE = 1 << 16 };
    void *pages;
    frame a, b;
    gn_settings s = plain_settings();
    if (posix_memalign(&pages, PAGE, PAGE))
        abort();
    uint8_t *memory = pages, *free_from = memory;
    memset(memory, 0, PAGE);
#define PUT(type, from, count)                                                                                         \
    memcpy(free_from, from, (count) * sizeof(type)), free_from += ((count) * sizeof(type) + 7) / 8 * 8
    gn_object objects[4];
    memcpy(objects, c->objects, sizeof objects);
    for (int i = 0; i < 4; i++) {
        gn_mesh mesh = *objects[i].mesh;
        const void *at = free_from;
        PUT(int32_t, mesh.vertices, 3 * mesh.vertex_count);
        mesh.vertices = (const int32_t(*)[3])at;
        at = free_from;
        PUT(uint32_t, mesh.indices, 3 * mesh.triangle_count);
        mesh.indices = at;
        objects[i].mesh = (const gn_mesh *)(void *)free_from;
        PUT(gn_mesh, &mesh, 1);
        if (objects[i].model) {
            at = free_from;
            PUT(gn_model, objects[i].model, 1);
            objects[i].model = at;
        }
    }
    gn_scene scene = c->scene;
    scene.objects = (const gn_object *)(void *)free_from;
    PUT(gn_object, objects, 4);
    const gn_scene *stored = (const gn_scene *)(void *)free_from;
    PUT(gn_scene, &scene, 1);
    const gn_light *light = (const gn_light *)(void *)free_from;
    PUT(gn_light, &c->spot, 1);
    const gn_camera *camera = (const gn_camera *)(void *)free_from;
    PUT(gn_camera, &c->camera, 1);
    const gn_settings *settings = (const gn_settings *)(void *)free_from;
    PUT(gn_settings, &s, 1);
#undef PUT
    if (mprotect(memory, PAGE, PROT_READ))
        ok(0, "mprotect");
    int good = render_plain(&a, c, &s, &c->spot) == GN_OK && frame_start(&b, stored, settings) == GN_OK &&
               frame_render(&b, light, camera) == GN_OK && same_image("read-only scene", &b, &a);
    good &= frame_end(&a);
    ok(good && frame_end(&b), "scene, settings, light and camera in read-only memory give the same image");
    if (!mprotect(memory, PAGE, PROT_READ | PROT_WRITE))
        free(pages);
}

static void contexts_do_not_share_anything(const courtyard *c, const courtyard *other)
{
    frame plain[2], step[2];
    const courtyard *scene[2] = {c, other};
    const gn_light *light[2] = {&c->sun, &other->spot};
    gn_settings s[2];
    int good = 1;
    for (int i = 0; i < 2; i++) {
        s[i] = plain_settings();
        s[i].surface = i ? GN_SECOND : GN_DUAL;
        s[i].map_rows = 9;
        s[i].region_height = 7;
        good &= render_plain(&plain[i], scene[i], &s[i], light[i]) == GN_OK;
        good &= frame_start(&step[i], &scene[i]->scene, &s[i]) == GN_OK;
    }
    for (int i = 0; i < 2; i++)
        good &= gn_light_begin(step[i].context, light[i]) == GN_OK;
    for (uint32_t r = 0; good && r < step[0].plan.light_regions; r++) {
        for (int i = 0; i < 2; i++)
            good &= gn_light_layers(step[i].context, r, 0) == GN_OK;
        for (int i = 0; i < 2; i++)
            good &= gn_light_resolve(step[i].context, r, 0) == GN_OK;
    }
    for (int i = 0; i < 2; i++)
        good &= gn_camera_begin(step[i].context, &scene[i]->camera) == GN_OK;
    for (uint32_t r = 0; good && r < step[0].plan.camera_regions; r++) {
        for (int i = 0; i < 2; i++) {
            static uint8_t colour[50 * 40 * 3], mask[50 * 40];
            gn_pixels pixels;
            good &= gn_camera_region(step[i].context, r, 0, colour, mask, &pixels) == GN_OK;
            frame_flush(&step[i], &pixels);
        }
    }
    for (int i = 0; i < 2; i++) {
        good = good && same_image("interleaved", &step[i], &plain[i]);
        good &= frame_end(&plain[i]);
        good &= frame_end(&step[i]);
    }
    ok(good, "two contexts, step by step in turn, give the images of whole passes");
}

static void steps_in_any_order_equal_whole_passes(const courtyard *c, const gn_receiver *receiver,
                                                  const gn_reconstruction *reconstruction, const char *name)
{
    frame plain, step;
    gn_settings s = plain_settings();
    s.surface = GN_MIDPOINT;
    s.receiver = receiver;
    s.reconstruction = reconstruction;
    s.map_rows = 5;
    s.region_width = 11;
    s.region_height = 6;
    s.workers = 3;
    int good = render_plain(&plain, c, &s, &c->spot) == GN_OK && frame_start(&step, &c->scene, &s) == GN_OK &&
               gn_light_begin(step.context, &c->spot) == GN_OK;
    for (uint32_t r = step.plan.light_regions; good && r-- > 0;)
        good &= gn_light_layers(step.context, r, r % 3) == GN_OK && gn_light_resolve(step.context, r, r % 3) == GN_OK;
    good = good && gn_camera_begin(step.context, &c->camera) == GN_OK;
    for (uint32_t r = step.plan.camera_regions; good && r-- > 0;) {
        uint8_t colour[11 * 6 * 3], mask[11 * 6];
        gn_pixels pixels;
        good &= gn_camera_region(step.context, r, r % 3, colour, mask, &pixels) == GN_OK;
        frame_flush(&step, &pixels);
    }
    good = good && same_image("steps", &step, &plain);
    good &= frame_end(&plain);
    ok(good && frame_end(&step), "regions backwards on three workers equal whole passes: %s", name);
}

static void a_stopped_frame_leaves_the_context_good(const courtyard *c)
{
    frame plain, stopped;
    gn_settings s = plain_settings();
    s.region_height = 8; /* 5 regions */
    int good = render_plain(&plain, c, &s, &c->sun) == GN_OK && frame_start(&stopped, &c->scene, &s) == GN_OK &&
               gn_light_pass(stopped.context, &c->sun) == GN_OK;
    for (int after = 1; good && after <= 5; after++) {
        stopped.stop_after = after;
        stopped.regions = 0;
        good &= gn_camera_pass(stopped.context, &c->camera, frame_flush, &stopped) == GN_STOPPED;
        good &= stopped.regions == after;
    }
    stopped.stop_after = 0;
    memset(stopped.colour, 0, colour_bytes(&stopped));
    good = good && gn_camera_pass(stopped.context, &c->camera, frame_flush, &stopped) == GN_OK &&
           same_image("after a stop", &stopped, &plain);
    good &= frame_end(&plain);
    ok(good && frame_end(&stopped), "a flush may stop a frame after any region; the next frame is right");
}

/* Cameras on all sides: the sheet and the floor are seen from above, behind and below. */
static void one_light_pass_serves_many_cameras(const courtyard *c, const gn_receiver *receiver, const char *name)
{
    static const int32_t eyes[6][3] = {{7000, 6000, 9000},  {4000, 6500, 9000},  {1000, 7000, 9000},
                                       {-2000, 7500, 9000}, {2500, 9000, -9000}, {2500, -3000, -2000}};
    frame fresh, kept;
    gn_settings s = plain_settings();
    s.receiver = receiver;
    int good = frame_start(&kept, &c->scene, &s) == GN_OK && gn_light_pass(kept.context, &c->sun) == GN_OK;
    for (int i = 0; good && i < 6; i++) {
        courtyard view = *c;
        int32_t eye[3] = {eyes[i][0] * UNIT, eyes[i][1] * UNIT, eyes[i][2] * UNIT}, target[3] = {0, 500 * UNIT, 0};
        good &= gn_look_at(&view.camera, eye, target, up) == GN_OK;
        if (i == 3)
            good &= gn_orthographic(&view.camera, 5000 * UNIT, -20000 * UNIT, 40000 * UNIT) == GN_OK;
        good = good && gn_camera_pass(kept.context, &view.camera, frame_flush, &kept) == GN_OK &&
               render_plain(&fresh, &view, &s, &c->sun) == GN_OK && same_image("another camera", &kept, &fresh);
        good &= frame_end(&fresh);
    }
    ok(good && frame_end(&kept), "one light pass serves many cameras: %s", name);
}

static void one_context_serves_many_lights(const courtyard *c, const gn_receiver *receiver, const char *name)
{
    frame fresh, kept;
    gn_settings s = plain_settings();
    s.receiver = receiver;
    int good = frame_start(&kept, &c->scene, &s) == GN_OK;
    for (int i = 0; good && i < 6; i++) {
        gn_light light = c->spot;
        int32_t direction[3] = {30 * (i - 2), i == 3 ? 50 : -50, 20 * (i % 3) - 20};
        if (i % 2 == 1)
            good &= gn_directional_light(&light, direction, 0) == GN_OK && gn_fit_light(&light, &c->scene) == GN_OK;
        good = good && frame_render(&kept, &light, &c->camera) == GN_OK &&
               render_plain(&fresh, c, &s, &light) == GN_OK && same_image("another light", &kept, &fresh);
        good &= frame_end(&fresh);
    }
    ok(good && frame_end(&kept), "one context serves many lights: %s", name);
}

/* A floor whose model moves between the passes, to where the light's formats do not reach: its planes are gone, its
 * pixels are tested by their points. */
static void planes_out_of_reach_are_level(const courtyard *c)
{
    int good = 1;
    for (size_t r = 1; good && r < sizeof receivers / sizeof receivers[0]; r++) {
        for (size_t h = 0; good && h < sizeof reconstructions / sizeof reconstructions[0]; h++) {
            frame f;
            gn_model model;
            courtyard moved = *c;
            gn_settings s = plain_settings();
            uint64_t seen = 0;
            s.receiver = receivers[r];
            s.reconstruction = reconstructions[h];
            gn_model_identity(&model);
            moved.objects[0].model = &model;
            moved.scene.objects = moved.objects;
            moved.scene.object_count = 1;
            moved.sun.box_depth = 1024; /* 2^31 units of depth: 2^44, the most, is 2^23 units of the world away */
            moved.sun.box_z = -512;
            good &= gn_perspective(&moved.camera, GN_DEGREES(45), 500 * UNIT, 20000 * UNIT) == GN_OK;
            good &= frame_start(&f, &moved.scene, &s) == GN_OK && gn_light_pass(f.context, &moved.sun) == GN_OK;
            /* so large that corners are out of reach, and the middle is where it was */
            good = good && gn_model_scale(&model, 8 << 16, 1 << 16, 8 << 16) == GN_OK;
            good = good && gn_camera_pass(f.context, &moved.camera, frame_flush, &f) == GN_OK;
            const gn_receiver_plane *plane = good ? gn_find_plane(f.context, &f.context->workers[0], 0, 0) : 0;
            good = good && plane->faces_light && !plane->exists;
            for (size_t i = 0; good && i < mask_bytes(&f); i++)
                seen += f.mask[i] != 255;
            good &= seen > 100;
            good &= frame_end(&f);
        }
    }
    ok(good, "a model may leave the light's reach between the passes");
}

/* Equal depth everywhere: a large sheet and many small ones in one plane. The object named first is seen, however the
 * regions meet them. */
static void the_lower_identifier_wins_a_tie(void)
{
    unsigned failures = 0;
    for (int small_first = 0; small_first < 2; small_first++) {
        shape large = shape_new(0), small = shape_new(0);
        gn_object objects[2] = {{&large.mesh, 0, {200, 0, 0}}, {&small.mesh, 0, {0, 200, 0}}};
        gn_object swapped[2] = {objects[1], objects[0]};
        gn_scene scene = {small_first ? swapped : objects, 2, {0, 0, 0}, 65535};
        gn_light light = grid_light(16, 16);
        gn_camera camera;
        int32_t eye[3] = {2048, 2048, 5000}, target[3] = {2048, 2048, 0};
        add_level(&large, -9000, -9000, 9000, 9000, -100, 1);
        for (int i = 0; i < 16; i++)
            add_level(&small, 256 * (i % 4) * 4, 256 * (i / 4) * 4, 256 * (i % 4) * 4 + 700, 256 * (i / 4) * 4 + 700,
                      -100, 1);
        memset(&camera, 0, sizeof camera);
        if (gn_look_at(&camera, eye, target, up) != GN_OK || gn_orthographic(&camera, 2048, 0, 20000) != GN_OK)
            failures++;
        for (int height = 0; height < 33; height++) {
            frame f;
            gn_settings s = gn_default_settings(32, 32, 16);
            s.region_height = (uint16_t)height;
            uint64_t reds = 0, greens = 0;
            if (frame_start(&f, &scene, &s) != GN_OK || frame_render(&f, &light, &camera) != GN_OK)
                failures++;
            for (int i = 0; i < 32 * 32; i++) {
                reds += f.colour[3 * i] == 200 && f.colour[3 * i + 1] == 0;
                greens += f.colour[3 * i] == 0 && f.colour[3 * i + 1] == 200;
            }
            /* 700 of 1024 units are 5.47 pixels: 5 or 6 centres */
            int good = small_first ? greens >= 16 * 25 && greens <= 16 * 36 && reds + greens == 1024 : reds == 1024;
            if (!good && failures++ < 3)
                note("%s first, regions of %d rows: %llu pixels of the large one, %llu of the small ones",
                     small_first ? "small" : "large", height, (unsigned long long)reds, (unsigned long long)greens);
            failures += !frame_end(&f);
        }
        shape_free(&large);
        shape_free(&small);
    }
    ok(!failures, "at equal depth the object named first is seen, whatever the regions");
}

/* Vectors write back what lies behind a span: never into a row that another worker may own. */
static void rows_are_padded_for_vectors(const courtyard *c)
{
    frame f;
    gn_settings s = plain_settings();
    s.workers = 2;
    frame_start(&f, &c->scene, &s);
    gn_status status = frame_render(&f, &c->sun, &c->camera);
    uint32_t pixels = (uint32_t)f.plan.region_width * f.plan.region_height;
    const gn_worker *w = f.context->workers;
    ok(status == GN_OK && f.context->map_stride >= s.map_width + (uint32_t)GN_ROW_PADDING &&
           w[0].triangle >= w[0].q + pixels + GN_ROW_PADDING && w[1].q >= w[0].triangle + pixels + GN_ROW_PADDING,
       "rows are padded by %d for vectors", GN_ROW_PADDING);
    frame_end(&f);
}

/* ---- threads --------------------------------------------------------------------------------------------------- */

typedef struct job {
    frame *f;
    uint32_t worker;
    int camera;
    gn_status status;
} job;

static void *run(void *argument)
{
    job *j = argument;
    frame *f = j->f;
    uint32_t regions = j->camera ? f->plan.camera_regions : f->plan.light_regions, workers = f->settings.workers;
    for (uint32_t r = j->worker; r < regions && j->status == GN_OK; r += workers) {
        uint8_t colour[64 * 64 * 3], mask[64 * 64];
        gn_pixels p;
        if (!j->camera) {
            j->status = gn_light_layers(f->context, r, j->worker);
            if (j->status == GN_OK)
                j->status = gn_light_resolve(f->context, r, j->worker);
            continue;
        }
        j->status = gn_camera_region(f->context, r, j->worker, colour, mask, &p);
        for (size_t row = 0; j->status == GN_OK && row < p.height; row++) {
            size_t to = (p.y + row) * f->settings.width + p.x;
            memcpy(f->colour + 3 * to, colour + 3 * row * p.width, 3 * (size_t)p.width);
            memcpy(f->mask + to, mask + row * p.width, p.width);
        }
    }
    return 0;
}

static gn_status run_on_threads(frame *f, int camera)
{
    pthread_t threads[8];
    job jobs[8];
    gn_status status = GN_OK;
    for (uint32_t i = 0; i < f->settings.workers; i++) {
        job j = {f, i, camera, GN_OK};
        jobs[i] = j;
        if (pthread_create(&threads[i], 0, run, &jobs[i]))
            abort();
    }
    for (uint32_t i = 0; i < f->settings.workers; i++) {
        pthread_join(threads[i], 0);
        status = jobs[i].status != GN_OK ? jobs[i].status : status;
    }
    return status;
}

static void workers_on_threads_equal_one(const courtyard *c)
{
    static const uint8_t surfaces[] = {GN_CONSTANT, GN_SECOND, GN_MIXED};
    int good = 1;
    for (int i = 0; good && i < 32; i++) {
        frame plain, threads;
        gn_settings s = plain_settings();
        const gn_light *light = i & 1 ? &c->sun : &c->spot;
        s.surface = surfaces[i % 3];
        s.receiver = receivers[i % 4];
        s.reconstruction = reconstructions[i / 4 % 8];
        good &= render_plain(&plain, c, &s, light) == GN_OK;
        s.workers = (uint8_t)between(2, 8);
        s.map_rows = (uint16_t)between(1, 20);
        s.region_width = (uint16_t)between(3, 40);
        s.region_height = (uint16_t)between(1, 10);
        good = good && frame_start(&threads, &c->scene, &s) == GN_OK &&
               gn_light_begin(threads.context, light) == GN_OK && run_on_threads(&threads, 0) == GN_OK &&
               gn_camera_begin(threads.context, &c->camera) == GN_OK && run_on_threads(&threads, 1) == GN_OK &&
               same_image("threads", &threads, &plain);
        good &= frame_end(&plain);
        good &= frame_end(&threads);
    }
    ok(good, "regions on up to eight threads give the image of one");
}

/* ---- the plan's choices ---------------------------------------------------------------------------------------- */

static void plan_takes_the_cheapest_layers(const courtyard *open, const courtyard *closed)
{
    static const struct {
        const char *name;
        uint8_t surface, layers, cull, expect_layers, expect_cull, closed;
    } cases[] = {
        {"second, all closed: one back layer", GN_SECOND, 0, 0, GN_LAYERS_FIRST, GN_CULL_FRONT, 1},
        {"second, some open: two", GN_SECOND, 0, 0, GN_LAYERS_TWO, GN_CULL_NONE, 0},
        {"second, one layer asked for: the back layer", GN_SECOND, GN_LAYERS_FIRST, 0, GN_LAYERS_FIRST, GN_CULL_FRONT,
         0},
        {"second, front culled: one layer", GN_SECOND, 0, GN_CULL_FRONT, GN_LAYERS_FIRST, GN_CULL_FRONT, 0},
        {"second, two asked for, all closed", GN_SECOND, GN_LAYERS_TWO, 0, GN_LAYERS_TWO, GN_CULL_NONE, 1},
        {"second, not culled, all closed: two", GN_SECOND, 0, GN_CULL_NONE, GN_LAYERS_TWO, GN_CULL_NONE, 1},
        {"constant: one", GN_CONSTANT, 0, 0, GN_LAYERS_FIRST, GN_CULL_NONE, 1},
        {"midpoint: two", GN_MIDPOINT, 0, 0, GN_LAYERS_TWO, GN_CULL_NONE, 1},
        {"dual: two, back culled", GN_DUAL, 0, 0, GN_LAYERS_TWO, GN_CULL_BACK, 1},
        {"mixed: two, not culled", GN_MIXED, 0, 0, GN_LAYERS_TWO, GN_CULL_NONE, 0},
        {"slope: one", GN_SLOPE, 0, 0, GN_LAYERS_FIRST, GN_CULL_NONE, 1},
        {"slope, back culled: one", GN_SLOPE, 0, GN_CULL_BACK, GN_LAYERS_FIRST, GN_CULL_BACK, 0},
    };
    gn_plan plan;
    gn_settings s = plain_settings();
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        s.surface = cases[i].surface;
        s.layers = cases[i].layers;
        s.cull = cases[i].cull;
        gn_status status = gn_make_plan(&plan, cases[i].closed ? &closed->scene : &open->scene, &s);
        if (!ok(status == GN_OK && plan.layers == cases[i].expect_layers && plan.cull == cases[i].expect_cull,
                "the plan for %s", cases[i].name))
            note("got status %d, layers %u, cull %u; expected %u, %u", (int)status, (unsigned)plan.layers,
                 (unsigned)plan.cull, (unsigned)cases[i].expect_layers, (unsigned)cases[i].expect_cull);
    }
    gn_plan one, two;
    s = plain_settings();
    s.surface = GN_SECOND;
    s.map_width = s.map_height = 256;
    gn_make_plan(&one, &closed->scene, &s);
    s.layers = GN_LAYERS_TWO;
    gn_make_plan(&two, &closed->scene, &s);
    ok(two.light_bytes == one.light_bytes + one.map_bytes && two.map_bytes == one.map_bytes,
       "a second layer costs as much as the map");
    s.map_rows = 16;
    gn_make_plan(&two, &closed->scene, &s);
    ok(two.light_bytes - one.light_bytes - one.map_bytes / 16 <= 64 /* a byte a region */,
       "in regions of 16 of 256 rows a sixteenth of it");
    s.workers = 3;
    gn_plan three;
    gn_make_plan(&three, &closed->scene, &s);
    ok(three.light_bytes >= two.light_bytes + 2 * (one.map_bytes / 16), "and as much for each worker");
    s.mask = 0;
    s.format = GN_NO_COLOUR;
    gn_make_plan(&two, &closed->scene, &s);
    ok(two.camera_bytes == three.camera_bytes - 50 * 40 * 4, "colour and mask that are not wanted cost nothing");
    s.receiver = &gn_virtual;
    gn_make_plan(&three, &closed->scene, &s);
    ok(three.camera_bytes == two.camera_bytes + 3 * GN_COLOUR_CACHE * sizeof(gn_receiver_plane) &&
           three.light_bytes == two.light_bytes,
       "a receiver costs a cache of planes for each worker");
    s.receiver = 0;
    s.reconstruction = &gn_box_5x5;
    gn_make_plan(&three, &closed->scene, &s);
    ok(three.camera_bytes == two.camera_bytes + 3 * 56 && three.light_bytes == two.light_bytes,
       "a reconstruction costs a byte a pixel of a row for each worker, aligned");
    s = plain_settings();
    gn_make_plan(&one, &closed->scene, &s);
    s.surface = GN_SLOPE;
    gn_make_plan(&two, &closed->scene, &s);
    ok(two.light_bytes == one.light_bytes + one.map_bytes && two.map_bytes == one.map_bytes,
       "the accumulator of slopes costs as much as the map");
}

static void statistics_add_up(const courtyard *c)
{
    frame f;
    gn_statistics n;
    gn_settings s = plain_settings();
    uint64_t seen = 0;
    frame_start(&f, &c->scene, &s);
    gn_get_statistics(f.context, &n);
    ok(!n.light_triangles && !n.camera_fragments && !n.pixels_shaded, "statistics begin at 0");
    gn_status status = frame_render(&f, &c->sun, &c->camera);
    for (size_t i = 0; i < mask_bytes(&f); i++)
        seen += f.mask[i] != 255;
    gn_get_statistics(f.context, &n);
    ok(status == GN_OK && n.map_bytes == f.plan.map_bytes, "statistics know the map");
#if GN_STATISTICS
    ok(n.pixels_shaded == seen && n.pixels_tested <= seen && n.pixels_tested > 0 && n.camera_fragments >= seen &&
           n.light_triangles > 0 && n.light_triangles <= f.plan.triangles && n.light_texels > 0,
       "statistics count the pixels that see a surface");
#else
    ok(!n.pixels_shaded && !n.light_texels, "without GN_STATISTICS they stay 0");
#endif
    frame_end(&f);
}

int main(int argc, char **argv)
{
    uint64_t cases = tap_cases(argc, argv, 400);
    courtyard open, closed;
    build(&open, 0);
    build(&closed, 1);
    bad_settings_are_refused(&open);
    bad_scenes_are_refused(&open);
    identifiers_that_do_not_fit_are_refused();
    steps_out_of_order_are_refused(&open);
    blocks_too_small_or_misaligned_are_refused(&open);
    images_do_not_depend_on_regions_and_memory_is_kept(&open, cases);
    odd_sizes_work(&open);
    empty_scenes_show_the_background(&open);
    index_sizes_give_the_same_image(&open);
    scenes_are_never_written(&open);
    contexts_do_not_share_anything(&open, &closed);
    steps_in_any_order_equal_whole_passes(&open, 0, 0, "the point, nearest");
    steps_in_any_order_equal_whole_passes(&open, &gn_virtual, 0, "virtual samples, nearest");
    steps_in_any_order_equal_whole_passes(&open, &gn_virtual_always, &gn_jitter_4x4, "virtual samples, 4x4 jitter");
    steps_in_any_order_equal_whole_passes(&open, &gn_plane_bias, &gn_bilinear, "plane bias, bilinear");
    steps_in_any_order_equal_whole_passes(&open, &gn_virtual, &gn_silhouettes, "virtual samples, silhouettes");
    steps_in_any_order_equal_whole_passes(&open, 0, &gn_silhouettes_smooth, "the point, smooth silhouettes");
    a_stopped_frame_leaves_the_context_good(&open);
    one_light_pass_serves_many_cameras(&open, 0, "the point");
    one_light_pass_serves_many_cameras(&open, &gn_virtual, "virtual samples");
    one_light_pass_serves_many_cameras(&open, &gn_plane_bias, "plane bias");
    one_context_serves_many_lights(&open, 0, "the point");
    one_context_serves_many_lights(&open, &gn_virtual, "virtual samples");
    planes_out_of_reach_are_level(&open);
    the_lower_identifier_wins_a_tie();
    rows_are_padded_for_vectors(&open);
    workers_on_threads_equal_one(&open);
    plan_takes_the_cheapest_layers(&open, &closed);
    statistics_add_up(&open);
    ok(lit > 10000 && shadowed > 10000, "%llu lit and %llu shadowed pixels were met", (unsigned long long)lit,
       (unsigned long long)shadowed);
    demolish(&open);
    demolish(&closed);
    return tap_done();
}
