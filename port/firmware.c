/* The golden firmware: renders every golden scene by several methods and prints one hash a stage, so that compilers,
 * word sizes and byte orders can be compared. The scenes are packed once, on the build host, and lie in flash.
 *
 *     hash SCENE METHOD STAGE HASH          stages: warp and silhouettes where there are, layers, map, mask, colour;
 *                                           shadow volumes, point lights: mask, colour; axes: cameras and lights set up
 * here cost SCENE METHOD view N light N camera N    instructions, where the port counts them; 0 without a view pass
 *     memory plan N stack N                 bytes: of the largest context, and of stack at its deepest
 *
 * Each method runs twice, with the plan's regions and with small ones of our own, which the view pass takes from the
 * last to the first: equal hashes are required. Exit status 0: every stage ran, every method made light and shadow,
 * those that filter, and no other, fractions, those with silhouettes a map that holds some, and those with a warp
 * texels that lie unevenly. */
#include "gnomon.h"
#include "port.h"
#include "print.h"
#include "stage_hash.h"

#include "fence.h"
#include "lshape.h"
#include "pins.h"
#include "pipes.h"
#include "table.h"
#include "torus2.h"

enum { WIDTH = 160, HEIGHT = 120, MAP = 128 };

typedef struct golden_scene {
    const char *name;
    const gn_scene *scene;
    const gn_camera *camera;
    const gn_light *light;
    int many_triangles;
} golden_scene;

static const golden_scene scenes[] = {
    {"lshape", &lshape_scene, &lshape_camera, &lshape_light, 0},
    {"torus2", &torus2_scene, &torus2_camera, &torus2_light, 0},
    {"table", &table_scene, &table_camera, &table_light, 0},
    {"pipes", &pipes_scene, &pipes_camera, &pipes_light, 1},
    {"pins", &pins_scene, &pins_camera, &pins_light, 1},
    {"fence", &fence_scene, &fence_camera, &fence_light, 0},
};

/* A scene as it was packed; or MOVED: seen by an orthographic camera, its last object turned and mirrored by a model
 * matrix, and a spot light's near plane pushed into it; or SOUP: its last object's mesh without edges; or LAMP: under a
 * point light. */
typedef enum staging { AS_PACKED, MOVED, SOUP, LAMP } staging;

typedef struct method {
    const char *name;
    gn_surface surface;
    gn_cull cull;
    gn_layers layers;
    gn_format format;
    gn_bias bias;
    gn_q16_16 slope;
    const gn_receiver *receiver;
    const gn_reconstruction *reconstruction;
    const gn_fit *fit;
    const gn_warp *warp;
    const gn_faces *faces;
    gn_q16_16 smoothing;
    uint8_t fit_depth;
    gn_shadow shadow;
    staging staging;
} method;

/* Biases: two texels, parts of the light's depth range; slopes: one and two; twice the usual smoothing. */
#define TEXELS_2                                                                                                       \
    {                                                                                                                  \
        GN_BIAS_TEXELS, 2 << 16                                                                                        \
    }
#define RANGE_50TH                                                                                                     \
    {                                                                                                                  \
        GN_BIAS_RANGE, 0xffffffffu / 50                                                                                \
    }
#define RANGE_2000TH                                                                                                   \
    {                                                                                                                  \
        GN_BIAS_RANGE, 0xffffffffu / 2000                                                                              \
    }
enum { SLOPE_1 = 1 << 16, SLOPE_2 = 2 << 16, SMOOTHING_2 = 2 << 16 };

/* Every virtual surface, receiver, reconstruction, fit and kind of warp, over maps that each must be right for, in both
 * staging. */
static const method methods[] = {
    {.name = "constant", .cull = GN_CULL_NONE, .layers = GN_LAYERS_FIRST, .format = GN_RGB888, .bias = RANGE_50TH},
    {.name = "midpoint", .surface = GN_MIDPOINT, .cull = GN_CULL_NONE, .layers = GN_LAYERS_TWO, .format = GN_RGB565},
    {.name = "dual",
     .surface = GN_DUAL,
     .cull = GN_CULL_BACK,
     .layers = GN_LAYERS_TWO,
     .format = GN_RGB888,
     .bias = TEXELS_2},
    {.name = "second-front",
     .surface = GN_SECOND,
     .cull = GN_CULL_FRONT,
     .layers = GN_LAYERS_FIRST,
     .format = GN_RGB888},
    {.name = "second-two", .surface = GN_SECOND, .cull = GN_CULL_NONE, .layers = GN_LAYERS_TWO, .format = GN_RGB565},
    {.name = "mixed",
     .surface = GN_MIXED,
     .cull = GN_CULL_NONE,
     .layers = GN_LAYERS_TWO,
     .format = GN_RGB888,
     .bias = TEXELS_2},
    {.name = "slope", .surface = GN_SLOPE, .format = GN_RGB888, .bias = RANGE_2000TH, .slope = SLOPE_2},
    {.name = "virtual", .surface = GN_SECOND, .format = GN_RGB888, .receiver = &gn_virtual},
    {.name = "always-moved",
     .surface = GN_MIXED,
     .format = GN_RGB565,
     .bias = TEXELS_2,
     .receiver = &gn_virtual_always,
     .staging = MOVED},
    {.name = "plane-bias", .format = GN_RGB888, .bias = RANGE_2000TH, .slope = SLOPE_1, .receiver = &gn_plane_bias},
    {.name = "bilinear",
     .surface = GN_DUAL,
     .format = GN_RGB565,
     .bias = TEXELS_2,
     .receiver = &gn_virtual,
     .reconstruction = &gn_bilinear},
    {.name = "jitter", .format = GN_RGB888, .bias = RANGE_50TH, .reconstruction = &gn_jitter_4x4},
    {.name = "jitter-moved",
     .surface = GN_SECOND,
     .format = GN_RGB888,
     .receiver = &gn_virtual,
     .reconstruction = &gn_jitter_4x4,
     .staging = MOVED},
    {.name = "pcf3", .format = GN_RGB565, .bias = RANGE_2000TH, .receiver = &gn_virtual, .reconstruction = &gn_box_3x3},
    {.name = "pcf5", .surface = GN_SECOND, .format = GN_RGB888, .receiver = &gn_virtual, .reconstruction = &gn_box_5x5},
    {.name = "pcf7-moved",
     .format = GN_RGB565,
     .bias = RANGE_2000TH,
     .slope = SLOPE_1,
     .receiver = &gn_plane_bias,
     .reconstruction = &gn_box_7x7,
     .staging = MOVED},
    {.name = "silhouette",
     .surface = GN_MIXED,
     .format = GN_RGB888,
     .bias = TEXELS_2,
     .receiver = &gn_virtual,
     .reconstruction = &gn_silhouettes},
    {.name = "silhouette-moved",
     .surface = GN_SECOND,
     .format = GN_RGB565,
     .reconstruction = &gn_silhouettes,
     .staging = MOVED},
    {.name = "silhouette-soup",
     .surface = GN_DUAL,
     .format = GN_RGB888,
     .bias = TEXELS_2,
     .receiver = &gn_virtual_always,
     .reconstruction = &gn_silhouettes,
     .staging = SOUP},
    {.name = "smooth",
     .surface = GN_SECOND,
     .format = GN_RGB565,
     .receiver = &gn_virtual,
     .reconstruction = &gn_silhouettes_smooth},
    {.name = "crossing-moved",
     .surface = GN_MIXED,
     .format = GN_RGB888,
     .bias = TEXELS_2,
     .receiver = &gn_virtual,
     .reconstruction = &gn_crossings,
     .staging = MOVED},
    {.name = "dv", .surface = GN_SECOND, .format = GN_RGB888, .receiver = &gn_virtual, .fit = &gn_desired_view},
    {.name = "msf-moved",
     .surface = GN_MIXED,
     .format = GN_RGB565,
     .bias = TEXELS_2,
     .receiver = &gn_virtual,
     .fit = &gn_minimal_frustum,
     .fit_depth = 1,
     .staging = MOVED},
    {.name = "dv-rectilinear",
     .surface = GN_DUAL,
     .format = GN_RGB565,
     .bias = TEXELS_2,
     .receiver = &gn_virtual,
     .reconstruction = &gn_box_3x3,
     .fit = &gn_desired_view,
     .warp = &gn_rectilinear,
     .smoothing = SMOOTHING_2},
    {.name = "msf-distance",
     .format = GN_RGB888,
     .bias = RANGE_2000TH,
     .slope = SLOPE_1,
     .receiver = &gn_plane_bias,
     .fit = &gn_minimal_frustum,
     .warp = &gn_rectilinear_distance},
    {.name = "dv-nonorthogonal",
     .surface = GN_SECOND,
     .format = GN_RGB888,
     .receiver = &gn_virtual,
     .fit = &gn_desired_view,
     .warp = &gn_nonorthogonal},
    {.name = "warped-silhouette",
     .surface = GN_MIXED,
     .format = GN_RGB888,
     .bias = TEXELS_2,
     .receiver = &gn_virtual,
     .reconstruction = &gn_silhouettes,
     .fit = &gn_minimal_frustum,
     .warp = &gn_rectilinear},
    {.name = "vertices", .format = GN_RGB565, .bias = RANGE_50TH, .warp = &gn_nonorthogonal_vertices},
    {.name = "point",
     .surface = GN_MIXED,
     .format = GN_RGB888,
     .bias = TEXELS_2,
     .receiver = &gn_virtual,
     .reconstruction = &gn_silhouettes,
     .faces = &gn_six_faces,
     .staging = LAMP},
    {.name = "point-one",
     .surface = GN_DUAL,
     .format = GN_RGB565,
     .bias = TEXELS_2,
     .receiver = &gn_virtual,
     .reconstruction = &gn_box_3x3,
     .faces = &gn_one_face,
     .staging = LAMP},
    {.name = "volumes", .format = GN_RGB888, .shadow = GN_SHADOW_VOLUMES},
    {.name = "volumes-moved", .format = GN_RGB565, .shadow = GN_SHADOW_VOLUMES, .staging = MOVED},
};

#define COUNT(array) (sizeof(array) / sizeof *(array))

static uint64_t memory[100 * 1024];

/* Whole planes, put together from regions, so that hashes do not depend on how the work was cut. */
static gn_depth layers[2][MAP * MAP];
static gn_depth map[MAP * MAP];
static uint8_t mask[WIDTH * HEIGHT];
static uint16_t colour[WIDTH * HEIGHT][3]; /* r, g, b; or one RGB565 value and two zeros */

enum { WARP_STAGE, LAYERS_STAGE, MAP_STAGE, SILHOUETTES_STAGE, MASK_STAGE, COLOUR_STAGE, STAGES };
static const char *const stage_names[STAGES] = {"warp", "layers", "map", "silhouettes", "mask", "colour"};

typedef struct result {
    stage_hash stages[STAGES];
    uint32_t view_instructions, light_instructions, camera_instructions;
    size_t plan_bytes;
    int light_and_shadow;
    int fractions;
    uint32_t silhouettes; /* bytes of their map that hold some */
    uint32_t uneven;      /* texels that do not lie where those of a uniform map do */
} result;

static void write_field(const char *text)
{
    port_write(text);
    port_write(" ");
}

static void fail(const char *what, const golden_scene *golden, const method *by, int status)
{
    write_field("error");
    write_field(golden->name);
    write_field(by->name);
    write_field(what);
    write_decimal((uint32_t)-status);
    port_write("\n");
    port_exit(1);
}

/* Copy what gn_layer gives of one region into its place in a whole plane. Planes that do not exist stay zero. */
static void keep_layer(gn_depth *plane, const gn_context *context, uint32_t layer, uint32_t region)
{
    uint32_t first_row, rows, stride;
    const gn_depth *depths = gn_layer(context, layer, region, 0, &first_row, &rows, &stride);
    if (!depths)
        return;
    for (uint32_t y = 0; y < rows; y++) {
        for (uint32_t x = 0; x < MAP; x++)
            plane[(first_row + y) * MAP + x] = depths[y * stride + x];
    }
}

static int keep_pixels(void *user, const gn_pixels *p)
{
    const gn_format *format = user;
    const uint8_t *rgb888 = p->colour;
    const uint16_t *rgb565 = p->colour;
    uint32_t from = 0;
    for (uint32_t y = p->y; y < (uint32_t)p->y + p->height; y++) {
        for (uint32_t x = p->x; x < (uint32_t)p->x + p->width; x++, from++) {
            uint32_t to = y * WIDTH + x;
            mask[to] = p->mask[from];
            if (*format == GN_RGB888) {
                for (uint32_t channel = 0; channel < 3; channel++)
                    colour[to][channel] = rgb888[3 * from + channel];
            } else {
                colour[to][0] = rgb565[from];
            }
        }
    }
    return 0;
}

static stage_hash hash_depths(stage_hash hash, const gn_depth *depths)
{
    for (uint32_t i = 0; i < MAP * MAP; i++)
        hash = GN_DEPTH_BITS == 16 ? stage_hash_u16(hash, (uint16_t)depths[i]) : stage_hash_u32(hash, depths[i]);
    return hash;
}

static stage_hash hash_colour(stage_hash hash, gn_format format)
{
    for (uint32_t i = 0; i < WIDTH * HEIGHT; i++) {
        if (format == GN_RGB565) {
            hash = stage_hash_u16(hash, colour[i][0]);
            continue;
        }
        for (uint32_t channel = 0; channel < 3; channel++)
            hash = stage_hash_u8(hash, (uint8_t)colour[i][channel]);
    }
    return hash;
}

static stage_hash hash_bytes(stage_hash hash, const uint8_t *bytes, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++)
        hash = stage_hash_u8(hash, bytes[i]);
    return hash;
}

/* The cells of a silhouette map, one less than texels each way, or a crossing map; neither: no byte. *some: how many
 * bytes say more than that there is nothing. */
static stage_hash hash_silhouettes(const gn_context *context, uint32_t *some)
{
    stage_hash hash = stage_hash_init();
    uint32_t stride = 0;
    const uint8_t *bytes = gn_silhouette_map(context, &stride);
    uint32_t size = bytes ? MAP - 1 : MAP, nothing = bytes ? 0x88 : 0;
    bytes = bytes ? bytes : gn_crossing_map(context, &stride);
    *some = 0;
    for (uint32_t y = 0; bytes && y < size; y++) {
        hash = hash_bytes(hash, bytes + y * stride, size);
        for (uint32_t x = 0; x < size; x++)
            *some += bytes[y * stride + x] != nothing;
    }
    return hash;
}

static stage_hash hash_rectangle(stage_hash hash, const gn_context *context)
{
    gn_rectangle r;
    if (gn_get_rectangle(context, &r) != GN_OK)
        return hash;
    const int32_t numbers[6] = {r.cosine, r.sine, r.low[0], r.low[1], r.size[0], r.size[1]};
    for (int i = 0; i < 6; i++)
        hash = stage_hash_u32(hash, (uint32_t)numbers[i]);
    return hash;
}

/* Is the place that of a texel's centre in a uniform map, but for 2^-12 of a side? */
static int is_even(uint32_t place, uint32_t number)
{
    uint32_t way = (uint32_t)((((uint64_t)2 * number + 1) << 31) / MAP) - place + (1 << 20);
    return way < 1 << 21;
}

/* What the map covers and where its texels lie, after a view pass. */
static stage_hash hash_warp(const gn_context *context, uint32_t *uneven)
{
    stage_hash hash = hash_rectangle(stage_hash_init(), context);
    *uneven = 0;
    for (uint32_t y = 0; y < MAP; y++)
        for (uint32_t x = 0; x < MAP; x++) {
            uint32_t place[2] = {0, 0};
            gn_texel_place(context, x, y, place);
            hash = stage_hash_u32(stage_hash_u32(hash, place[0]), place[1]);
            *uneven += !is_even(place[0], x) || !is_even(place[1], y);
        }
    return hash;
}

/* What a mask must hold for its hash to say anything. */
static void look_at_mask(result *out)
{
    uint32_t lit = 0, shadowed = 0, empty = 0;
    for (uint32_t i = 0; i < WIDTH * HEIGHT; i++) {
        lit += mask[i] == 254;
        shadowed += mask[i] == 0;
        empty += mask[i] == 255;
    }
    out->light_and_shadow = lit && shadowed;
    out->fractions = lit + shadowed + empty < WIDTH * HEIGHT;
}

static int has_view(const method *by)
{
    return by->fit || by->warp;
}

static gn_status view_in_steps(gn_context *context, const gn_plan *plan, const golden_scene *golden)
{
    gn_status status = gn_view_begin(context, golden->camera, golden->light);
    for (uint32_t round = 0; status == GN_OK && round < plan->view_rounds; round++) {
        for (uint32_t region = plan->camera_regions; status == GN_OK && region-- > 0;)
            status = gn_view_region(context, region, 0);
        if (status == GN_OK)
            status = gn_view_end(context);
    }
    return status;
}

static gn_status see_view(result *out, gn_context *context, const gn_plan *plan, const golden_scene *golden,
                          int in_steps)
{
    uint32_t start = port_instructions();
    gn_status status =
        in_steps ? view_in_steps(context, plan, golden) : gn_view_pass(context, golden->camera, golden->light);
    out->view_instructions = port_instructions() - start;
    if (status == GN_OK)
        out->stages[WARP_STAGE] = hash_warp(context, &out->uneven);
    return status;
}

/* The light pass in steps, so that the layers can be seen before they are resolved. */
static gn_status light_pass(gn_context *context, const gn_plan *plan, const gn_light *light, uint32_t *instructions)
{
    uint32_t start = port_instructions();
    gn_status status = gn_light_begin(context, light);
    *instructions = port_instructions() - start;
    for (uint32_t region = 0; status == GN_OK && region < plan->light_regions; region++) {
        start = port_instructions();
        status = gn_light_layers(context, region, 0);
        *instructions += port_instructions() - start;
        if (status != GN_OK)
            break;
        keep_layer(layers[0], context, 0, region);
        keep_layer(layers[1], context, 1, region);
        start = port_instructions();
        status = gn_light_resolve(context, region, 0);
        *instructions += port_instructions() - start;
        keep_layer(map, context, 0, region);
    }
    return status;
}

static gn_settings settings_of(const method *by, int small_regions)
{
    gn_settings settings = gn_default_settings(WIDTH, HEIGHT, by->faces ? MAP / 2 : MAP); /* six of them */
    settings.shadow = (uint8_t)by->shadow;
    settings.surface = (uint8_t)by->surface;
    settings.cull = (uint8_t)by->cull;
    settings.layers = (uint8_t)by->layers;
    settings.format = (uint8_t)by->format;
    settings.bias = by->bias;
    settings.slope = by->slope;
    settings.receiver = by->receiver;
    settings.reconstruction = by->reconstruction;
    settings.fit = by->fit;
    settings.warp = by->warp;
    settings.faces = by->faces;
    settings.smoothing = by->smoothing;
    settings.fit_depth = by->fit_depth;
    settings.mask = 1;
    if (small_regions) {
        settings.map_rows = 24;
        settings.region_width = 48;
        settings.region_height = 16;
    }
    return settings;
}

static gn_status render_map(result *out, gn_context *context, const gn_plan *plan, const golden_scene *golden)
{
    for (uint32_t i = 0; i < MAP * MAP; i++)
        layers[0][i] = layers[1][i] = map[i] = 0;
    gn_status status = light_pass(context, plan, golden->light, &out->light_instructions);
    out->stages[LAYERS_STAGE] = hash_depths(hash_depths(stage_hash_init(), layers[0]), layers[1]);
    out->stages[MAP_STAGE] = hash_depths(stage_hash_init(), map);
    out->stages[SILHOUETTES_STAGE] = hash_silhouettes(context, &out->silhouettes);
    return status;
}

static gn_status find_volumes(result *out, gn_context *context, const golden_scene *golden)
{
    uint32_t start = port_instructions();
    gn_status status = gn_volumes_light(context, golden->light);
    out->light_instructions = port_instructions() - start;
    return status;
}

/* Six maps that stay, or, in one pass, the faces that are needed; of one map at a time always that. */
static gn_status render_point_light(result *out, gn_context *context, const golden_scene *golden, gn_format *format,
                                    int in_one)
{
    uint32_t start = port_instructions();
    out->light_instructions = 0;
    gn_status status = in_one ? GN_OK : gn_light_faces(context, golden->light);
    if (!in_one)
        out->light_instructions = port_instructions() - start;
    if (status == GN_OK)
        status = in_one ? gn_point_pass(context, golden->light, golden->camera, keep_pixels, format)
                        : gn_camera_pass(context, golden->camera, keep_pixels, format);
    out->camera_instructions = port_instructions() - start - out->light_instructions;
    return status;
}

static void hash_picture(result *out, gn_format format)
{
    look_at_mask(out);
    out->stages[MASK_STAGE] = hash_bytes(stage_hash_init(), mask, WIDTH * HEIGHT);
    out->stages[COLOUR_STAGE] = hash_colour(stage_hash_init(), format);
}

static void render(result *out, const golden_scene *golden, const method *by, int small_regions)
{
    gn_settings settings = settings_of(by, small_regions);
    gn_plan plan;
    gn_context *context;
    gn_format format = by->format;
    int volumes = by->shadow == GN_SHADOW_VOLUMES;

    gn_status status = gn_make_plan(&plan, golden->scene, &settings);
    if (status != GN_OK)
        fail("plan", golden, by, status);
    status = gn_init(&context, golden->scene, &settings, memory, sizeof memory);
    if (status != GN_OK)
        fail("init", golden, by, status);
    out->plan_bytes = plan.bytes;

    out->view_instructions = 0;
    if (by->faces) {
        status = render_point_light(out, context, golden, &format, small_regions || by->faces == &gn_one_face);
        if (status != GN_OK)
            fail("point light", golden, by, status);
        hash_picture(out, format);
        return;
    }
    if (has_view(by))
        status = see_view(out, context, &plan, golden, small_regions);
    if (status != GN_OK)
        fail("view", golden, by, status);

    status = volumes ? find_volumes(out, context, golden) : render_map(out, context, &plan, golden);
    if (status != GN_OK)
        fail("light", golden, by, status);

    uint32_t start = port_instructions();
    status = volumes ? gn_volumes_pass(context, golden->camera, keep_pixels, &format)
                     : gn_camera_pass(context, golden->camera, keep_pixels, &format);
    if (status != GN_OK)
        fail("camera", golden, by, status);
    out->camera_instructions = port_instructions() - start;
    hash_picture(out, format);
}

/* What a scene consists of that is not as it was packed. */
enum { MOST_OBJECTS = 4 };
static gn_object staged_objects[MOST_OBJECTS];
static gn_mesh soup;
static gn_model moved_model;
static gn_scene staged_scene;
static gn_camera staged_camera;
static gn_light staged_light;

/* Returns the last object. */
static gn_object *copy_scene(const golden_scene *golden, const method *by)
{
    staged_scene = *golden->scene;
    staged_camera = *golden->camera;
    staged_light = *golden->light;
    if (staged_scene.object_count < 1 || staged_scene.object_count > MOST_OBJECTS)
        fail("objects", golden, by, GN_TOO_MANY);
    for (uint32_t i = 0; i < staged_scene.object_count; i++)
        staged_objects[i] = golden->scene->objects[i];
    staged_scene.objects = staged_objects;
    return &staged_objects[staged_scene.object_count - 1];
}

static void take_edges_away(gn_object *object)
{
    soup = *object->mesh;
    soup.edges = 0;
    soup.edge_count = 0;
    object->mesh = &soup;
}

static void move(const golden_scene *golden, const method *by, gn_object *last)
{
    static const int32_t axis[3] = {1, 3, 2}, down[3] = {0, -1, 0};
    gn_light sun = {0};
    last->model = &moved_model;
    gn_model_identity(&moved_model);
    int status = gn_model_scale(&moved_model, -32768, 32768, 32768);
    status |= gn_model_rotate(&moved_model, axis, GN_DEGREES(25));
    /* the box of a light from above says how large the scene is */
    status |= gn_directional_light(&sun, down, 0);
    status |= gn_fit_light(&sun, golden->scene);
    status |= gn_orthographic(&staged_camera, sun.box_width / 4, golden->camera->near_depth, golden->camera->far_depth);
    if (status != GN_OK)
        fail("move", golden, by, status);
    if (staged_light.kind == GN_SPOT)
        staged_light.near_depth += (staged_light.far_depth - staged_light.near_depth) / 4;
}

/* A point light above the scene, beside its middle. */
static void light_lamp(const golden_scene *golden, const method *by)
{
    static const int32_t down[3] = {0, -1, 0}, south[3] = {0, 0, -1};
    gn_light sun = {0};
    int status = gn_directional_light(&sun, down, south);
    status |= gn_fit_light(&sun, golden->scene);
    /* right is +x or -x, up is -z, forward is -y */
    int32_t middle_u = sun.box_u + sun.box_width / 2, middle_v = sun.box_v + sun.box_height / 2;
    int32_t position[3] = {sun.right[0] > 0 ? middle_u : -middle_u, -sun.box_z, -middle_v};
    position[0] += sun.box_width / 8;
    position[1] += sun.box_depth / 2;
    status |= gn_point_light(&staged_light, position, sun.box_width / 256, 2 * sun.box_width);
    if (status != GN_OK)
        fail("lamp", golden, by, status);
}

static golden_scene stage(const golden_scene *packed, const method *by)
{
    golden_scene staged = {packed->name, &staged_scene, &staged_camera, &staged_light, packed->many_triangles};
    if (by->staging == AS_PACKED)
        return *packed;
    gn_object *last = copy_scene(packed, by);
    if (by->staging == MOVED)
        move(packed, by, last);
    else if (by->staging == LAMP)
        light_lamp(packed, by);
    else
        take_edges_away(last);
    return staged;
}

static void write_hash_line(const char *scene, const char *by, const char *stage, stage_hash hash)
{
    char digits[17];
    write_field("hash");
    write_field(scene);
    write_field(by);
    write_field(stage);
    stage_hash_text(hash, digits);
    port_write(digits);
    port_write("\n");
}

static void write_cost_line(const char *scene, const char *by, const result *r)
{
    write_field("cost");
    write_field(scene);
    write_field(by);
    write_field("view");
    write_decimal(r->view_instructions);
    port_write(" light ");
    write_decimal(r->light_instructions);
    port_write(" camera ");
    write_decimal(r->camera_instructions);
    port_write("\n");
}

/* Not inlined: dozens of copies in one function would want kilobytes of stack. */
static __attribute__((noinline)) stage_hash hash_number(stage_hash hash, uint32_t value)
{
    return stage_hash_u32(hash, value);
}

static stage_hash hash_vector(stage_hash hash, const int32_t v[3])
{
    for (int i = 0; i < 3; i++)
        hash = hash_number(hash, (uint32_t)v[i]);
    return hash;
}

static stage_hash hash_camera(stage_hash hash, const gn_camera *c)
{
    hash = hash_vector(hash_vector(hash_vector(hash_vector(hash, c->eye), c->right), c->up), c->forward);
    return hash_number(hash_number(hash_number(hash, c->tan_half), (uint32_t)c->near_depth), (uint32_t)c->far_depth);
}

static stage_hash hash_light_axes(stage_hash hash, const gn_light *l)
{
    return hash_vector(hash_vector(hash_vector(hash, l->right), l->up), l->forward);
}

/* Everything that turns angles and directions into cameras, lights and matrices, on a path round the scene. */
static stage_hash hash_axes(const golden_scene *golden)
{
    static const int32_t target[3] = {1000, -2000, 500}, up[3] = {0, 1, 0};
    stage_hash hash = stage_hash_init();
    for (uint32_t step = 0; step < 16; step++) {
        gn_angle angle = step * 0x0fedcba9u;
        const int32_t eye[3] = {gn_sine(angle) / 64, gn_cosine(angle) / 128 + 3, (int32_t)step * 60000 - 500000};
        gn_camera camera = {0};
        gn_light sun = {0}, lamp = {0};
        gn_model model;
        gn_model_identity(&model);
        int status = gn_look_at(&camera, eye, target, up);
        status |= gn_perspective(&camera, GN_DEGREES(20) + step * 0x04000000u, 1000, 1 << 24);
        status |= gn_directional_light(&sun, eye, 0);
        status |= gn_fit_light(&sun, golden->scene);
        status |= gn_spot_light(&lamp, eye, target, 0, GN_DEGREES(30) + step * 0x03000000u, 500, 1 << 24);
        status |= gn_model_scale(&model, 65536 / 3, 70000, 65536);
        status |= gn_model_rotate(&model, eye, angle);
        status |= gn_model_translate(&model, 5, -7, (int32_t)step);
        hash = hash_camera(hash_number(hash, (uint32_t)status), &camera);
        hash = hash_light_axes(hash_light_axes(hash, &sun), &lamp);
        hash = hash_number(hash_number(hash, lamp.tan_half), model.shift);
        const int32_t box[6] = {sun.box_u, sun.box_v, sun.box_z, sun.box_width, sun.box_height, sun.box_depth};
        hash = hash_vector(hash_vector(hash, box), box + 3);
        for (int row = 0; row < 3; row++)
            hash = hash_vector(hash, model.m[row]);
        hash = hash_vector(hash, model.t);
    }
    return hash;
}

static int has_silhouettes(const method *by)
{
    const gn_reconstruction *how = by->reconstruction;
    return how && (how == &gn_silhouettes || how == &gn_silhouettes_smooth || how == &gn_crossings);
}

static int has_stage(const method *by, int stage)
{
    if (by->faces)
        return stage >= MASK_STAGE;
    if (stage == WARP_STAGE)
        return has_view(by);
    if (stage == SILHOUETTES_STAGE)
        return has_silhouettes(by);
    return stage >= MASK_STAGE || by->shadow != GN_SHADOW_VOLUMES;
}

static int has_fractions(const method *by)
{
    return by->reconstruction && (!has_silhouettes(by) || by->reconstruction == &gn_silhouettes_smooth);
}

/* Returns the bytes of the larger plan. */
static size_t render_method(const golden_scene *packed, const method *by)
{
    static result whole, parts;
    golden_scene golden = stage(packed, by);
    render(&whole, &golden, by, 0);
    render(&parts, &golden, by, 1);
    for (int stage = 0; stage < STAGES; stage++) {
        if (!has_stage(by, stage))
            continue;
        write_hash_line(golden.name, by->name, stage_names[stage], whole.stages[stage]);
        if (whole.stages[stage] != parts.stages[stage])
            fail("small-regions-differ", &golden, by, -stage);
    }
    if (!whole.light_and_shadow)
        fail("no-light-or-no-shadow", &golden, by, 0);
    if (whole.fractions != has_fractions(by))
        fail("fractions-not-as-the-method-has-them", &golden, by, -whole.fractions);
    if (has_stage(by, SILHOUETTES_STAGE) && !whole.silhouettes)
        fail("no-silhouette", &golden, by, 0);
    if (by->warp && !whole.uneven)
        fail("no-warp", &golden, by, 0);
    write_cost_line(golden.name, by->name, &whole);
    return whole.plan_bytes > parts.plan_bytes ? whole.plan_bytes : parts.plan_bytes;
}

/* What tests pixels in a way of its own does so in four scenes: the other two would double the time of slow targets. */
static int is_left_out(const golden_scene *golden, const method *by)
{
    return golden->many_triangles && (by->receiver || by->reconstruction || by->surface == GN_SLOPE || has_view(by));
}

int main(void)
{
    size_t most_bytes = 0;
    for (size_t s = 0; s < COUNT(scenes); s++) {
        write_hash_line(scenes[s].name, "set-up", "axes", hash_axes(&scenes[s]));
        for (size_t m = 0; m < COUNT(methods); m++) {
            if (is_left_out(&scenes[s], &methods[m]))
                continue;
            size_t bytes = render_method(&scenes[s], &methods[m]);
            most_bytes = bytes > most_bytes ? bytes : most_bytes;
        }
    }
    port_write("memory plan ");
    write_decimal((uint32_t)most_bytes);
    port_write(" stack ");
    write_decimal(port_stack_used());
    port_write("\n");
    return 0;
}
