/* Cases of static casters: the pins and the ball that rolls towards them. The light pass of a frame, over all; with
 * what stands kept, the first time and every other one. */
#include "bench.h"

#include "port.h"
#include "print.h"

/* The mesh of the golden scene, as host/procedural_scenes.c makes it: eleven pins, then a ball. */
enum { PIN_TRIANGLES = 11 * 450, PIN_VERTICES = 11 * 227, BALL_TRIANGLES = 624, BALL_VERTICES = 314 };

enum { LANE_AND_PINS = 2, STEP = 1 << 18 /* of the ball, world units a frame */ };

static uint16_t ball_indices[3 * BALL_TRIANGLES];
static gn_mesh pins_mesh, ball_mesh;
static gn_model ball_model;
static gn_object objects[LANE_AND_PINS + 1];

/* Lane and pins as they are, the ball as a mesh of its own. */
static gn_scene split_pins(void)
{
    const gn_scene *whole = golden[PINS].scene;
    const gn_mesh *mesh = whole->objects[1].mesh;
    require(mesh->triangle_count == PIN_TRIANGLES + BALL_TRIANGLES, "triangles of pins and ball");
    require(mesh->vertex_count == PIN_VERTICES + BALL_VERTICES && mesh->index_size == 2, "vertices of pins and ball");
    const uint16_t *indices = (const uint16_t *)mesh->indices + 3 * PIN_TRIANGLES;
    for (int i = 0; i < 3 * BALL_TRIANGLES; i++)
        ball_indices[i] = (uint16_t)(indices[i] - PIN_VERTICES);
    pins_mesh = ball_mesh = *mesh;
    pins_mesh.triangle_count = PIN_TRIANGLES;
    pins_mesh.vertex_count = PIN_VERTICES;
    ball_mesh.vertices += PIN_VERTICES;
    ball_mesh.indices = ball_indices;
    ball_mesh.triangle_count = BALL_TRIANGLES;
    ball_mesh.vertex_count = BALL_VERTICES;
    pins_mesh.edges = ball_mesh.edges = 0;
    pins_mesh.edge_count = ball_mesh.edge_count = 0;
    objects[0] = whole->objects[0];
    objects[1] = whole->objects[1];
    objects[1].mesh = &pins_mesh;
    objects[2] = whole->objects[1];
    objects[2].mesh = &ball_mesh;
    objects[2].model = &ball_model;
    return scene_of(objects, LANE_AND_PINS + 1);
}

static void measure_pass(const char *name, const char *suffix, uint32_t number)
{
    require(gn_model_translate(&ball_model, 0, 0, -STEP) == GN_OK, "the ball rolls");
    write_case(name, suffix, number);
    mark_begin();
    gn_status status = gn_light_pass(context, golden[PINS].light);
    mark_end();
    require(status == GN_OK, "light pass");
}

static void measure_surface(const char *name, gn_surface surface, const gn_scene *scene, uint16_t map)
{
    gn_plan plan;
    gn_settings settings = gn_default_settings(16, 16, map);
    settings.surface = (uint8_t)surface;
    settings.bias.value = 2 << 16;
    gn_model_identity(&ball_model);
    prepare(scene, &settings, &plan);
    measure_pass(name, "-all-", map);
    settings.casters = &gn_static_casters;
    settings.static_objects = LANE_AND_PINS;
    prepare(scene, &settings, &plan);
    measure_pass(name, "-anew-", map);
    measure_pass(name, "-kept-", map);
}

void measure_casters(void)
{
    gn_scene scene = split_pins();
    for (uint16_t map = 128; map <= 256; map = (uint16_t)(2 * map)) {
        measure_surface("ball-second", GN_SECOND, &scene, map);
        measure_surface("ball-mixed", GN_MIXED, &scene, map);
    }
}
