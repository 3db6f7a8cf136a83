/* Cases of meshes with edges: shadow volumes, silhouette maps, planes of receivers over the same grid. */
#include "bench.h"

/* ---- shadow volumes -------------------------------------------------------------------------------------------- */

static gn_settings volume_settings(uint16_t width, uint16_t height)
{
    gn_settings settings = gn_default_settings(width, height, 1);
    settings.shadow = GN_SHADOW_VOLUMES;
    return settings;
}

static void measure_volumes_pass(const gn_scene *scene, const gn_settings *settings, const gn_camera *camera,
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
static void measure_frame(const golden_scene *g)
{
    gn_settings settings = volume_settings(160, 120);
    write_case(g->name, "-volumes-", 160);
    measure_volumes_pass(g->scene, &settings, g->camera, g->light);
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
            measure_volumes_pass(&scene, &settings, &camera, &light);
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
            measure_volumes_pass(&scene, &settings, &camera, &light);
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
        measure_volumes_pass(&scene, &settings, &camera, &light);
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
void measure_planes(const char *name, const view *v)
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
    for (unsigned i = 0; i < TESTS; i++) {
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
        for (unsigned g = 0; g < GOLDEN_SCENES; g++) {
            write_case(golden[g].name, with[i].name, 128);
            measure_light_pass_of(golden[g].scene, &settings, golden[g].light);
        }
    }
}

void measure_silhouette_maps(void)
{
    measure_one_cell();
    measure_drawn_edges("drawn-short", &gn_silhouettes, 1);
    measure_drawn_edges("drawn-long", &gn_silhouettes, 16);
    measure_drawn_edges("crossing-short", &gn_crossings, 1);
    measure_drawn_edges("crossing-long", &gn_crossings, 16);
    measure_edges_looked_at();
    measure_golden_light_passes();
}

void measure_volumes(void)
{
    static const int32_t ahead[3] = {1, 1, -400}, across[3] = {4, 0, -1}, lamp[3] = {300, 200, 5000};
    measure_frame(&golden[LSHAPE]);
    measure_frame(&golden[PINS]);
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
