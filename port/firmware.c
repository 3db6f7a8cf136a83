/* The golden firmware: renders every golden scene by several methods and prints one hash a stage, so that compilers,
 * word sizes and byte orders can be compared. The scenes are packed once, on the build host, and lie in flash.
 *
 *     hash SCENE METHOD STAGE HASH          stages: warp and silhouettes where there are, layers, map, mask, colour;
 *                                           shadow volumes and point lights with one map at a time: mask, colour;
 *                                           axes: cameras and lights set up here
 *     cost SCENE METHOD view N light N camera N    instructions, where the port counts them; 0 without a view pass
 *     memory plan N stack N                 bytes: of the largest context, and of stack at its deepest
 *
 * Each method runs twice, with the plan's regions and with small ones of our own, which the view pass takes from the
 * last to the first, as does a point light its faces: equal hashes are required. Exit status 0: every stage ran, every
 * method made light and shadow, those that filter, and no other, fractions, those with silhouettes a map that holds
 * some, those with a warp texels that lie unevenly, and those with six maps casters on several of them. */
#include "gnomon.h"
#include "methods.h"
#include "port.h"
#include "print.h"
#include "stage_hash.h"

#include "fence.h"
#include "lshape.h"
#include "pins.h"
#include "pipes.h"
#include "table.h"
#include "torus2.h"

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

#define COUNT(array) (sizeof(array) / sizeof *(array))

static uint64_t memory[144 * 1024]; /* six maps of the build that trades memory for speed take most of it */

/* Whole planes, put together from regions, so that hashes do not depend on how the work was cut. */
static gn_depth layers[2][MAP * MAP];
static gn_depth map[MAP * MAP];
static uint8_t mask[WIDTH * HEIGHT];
static uint16_t colour[WIDTH * HEIGHT][3]; /* r, g, b; or one RGB565 value and two zeros */

enum { WARP_STAGE, LAYERS_STAGE, MAP_STAGE, SILHOUETTES_STAGE, MASK_STAGE, COLOUR_STAGE, STAGES };
enum { FACES = 6, LEAST_FACES = 4 }; /* of a point light; of them, how many must hold casters */
static const char *const stage_names[STAGES] = {"warp", "layers", "map", "silhouettes", "mask", "colour"};

typedef struct result {
    stage_hash stages[STAGES];
    uint32_t view_instructions, light_instructions, camera_instructions;
    size_t plan_bytes;
    int light_and_shadow;
    int fractions;
    uint32_t silhouettes; /* bytes of their map that hold some */
    uint32_t uneven;      /* texels that do not lie where those of a uniform map do */
    uint32_t faces;       /* of a point light that hold casters */
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

static gn_model moved_model; /* of the last object, where it is staged as moved */

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

/* The regions of a light pass in steps, so that the layers can be seen before they are resolved. */
static gn_status light_regions(gn_context *context, uint32_t regions, uint32_t *instructions)
{
    gn_status status = GN_OK;
    for (uint32_t region = 0; status == GN_OK && region < regions; region++) {
        uint32_t start = port_instructions();
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

static void clear_planes(void)
{
    for (uint32_t i = 0; i < MAP * MAP; i++)
        layers[0][i] = layers[1][i] = map[i] = 0;
}

static gn_status render_map(result *out, gn_context *context, const gn_plan *plan, const golden_scene *golden)
{
    clear_planes();
    uint32_t start = port_instructions();
    gn_status status = gn_light_begin(context, golden->light);
    out->light_instructions = port_instructions() - start;
    if (status == GN_OK)
        status = light_regions(context, plan->light_regions, &out->light_instructions);
    out->stages[LAYERS_STAGE] = hash_depths(hash_depths(stage_hash_init(), layers[0]), layers[1]);
    out->stages[MAP_STAGE] = hash_depths(stage_hash_init(), map);
    out->stages[SILHOUETTES_STAGE] = hash_silhouettes(context, &out->silhouettes);
    return status;
}

/* One of a point light's maps; planes of a face without casters stay zero. hashes: of the stages from layers on. */
static gn_status render_face(result *out, gn_context *context, const golden_scene *golden, uint32_t face,
                             stage_hash hashes[STAGES])
{
    uint32_t regions = 0, silhouettes = 0, start = port_instructions();
    gn_status status = gn_light_face(context, golden->light, face, &regions);
    out->light_instructions += port_instructions() - start;
    clear_planes();
    if (status == GN_OK)
        status = light_regions(context, regions, &out->light_instructions);
    hashes[LAYERS_STAGE] = hash_depths(hash_depths(stage_hash_init(), layers[0]), layers[1]);
    hashes[MAP_STAGE] = hash_depths(stage_hash_init(), map);
    hashes[SILHOUETTES_STAGE] = regions ? hash_silhouettes(context, &silhouettes) : stage_hash_init();
    out->silhouettes += silhouettes;
    out->faces += regions > 0;
    return status;
}

/* All six, from the first to the last or backwards; a stage's hash is that of its hashes of the faces. */
static gn_status render_faces(result *out, gn_context *context, const golden_scene *golden, int backwards)
{
    static stage_hash hashes[FACES][STAGES];
    gn_status status = GN_OK;
    out->light_instructions = out->silhouettes = out->faces = 0;
    for (uint32_t i = 0; status == GN_OK && i < FACES; i++) {
        uint32_t face = backwards ? FACES - 1 - i : i;
        status = render_face(out, context, golden, face, hashes[face]);
    }
    for (int stage = LAYERS_STAGE; stage <= SILHOUETTES_STAGE; stage++) {
        out->stages[stage] = stage_hash_init();
        for (uint32_t face = 0; face < FACES; face++) {
            stage_hash hash = hashes[face][stage];
            out->stages[stage] = stage_hash_u32(out->stages[stage], (uint32_t)(hash >> 32));
            out->stages[stage] = stage_hash_u32(out->stages[stage], (uint32_t)hash);
        }
    }
    return status;
}

static gn_status find_volumes(result *out, gn_context *context, const golden_scene *golden)
{
    uint32_t start = port_instructions();
    gn_status status = gn_volumes_light(context, golden->light);
    out->light_instructions = port_instructions() - start;
    return status;
}

/* What comes before the image and stays; of a point light with one map at a time: nothing. */
/* A light pass with the last object elsewhere: its layers without that object stay, and the next pass inserts it. */
static gn_status keep_casters(gn_context *context, const golden_scene *golden)
{
    const gn_model here = moved_model;
    moved_model.t[1] += golden->light->box_width >> 3;
    moved_model.t[0] -= golden->camera->half_height >> 3;
    gn_status status = gn_light_pass(context, golden->light);
    moved_model = here;
    return status;
}

static gn_status see_light(result *out, gn_context *context, const gn_plan *plan, const golden_scene *golden,
                           const method *by, int small_regions)
{
    out->light_instructions = 0;
    if (by->casters && keep_casters(context, golden) != GN_OK)
        return GN_NOT_READY;
    if (by->shadow == GN_SHADOW_VOLUMES)
        return find_volumes(out, context, golden);
    if (by->faces == &gn_six_faces)
        return render_faces(out, context, golden, small_regions);
    return by->faces ? GN_OK : render_map(out, context, plan, golden);
}

static gn_status see_image(gn_context *context, const golden_scene *golden, const method *by)
{
    gn_format format = by->format;
    if (by->shadow == GN_SHADOW_VOLUMES)
        return gn_volumes_pass(context, golden->camera, keep_pixels, &format);
    if (by->faces == &gn_one_face)
        return gn_point_pass(context, golden->light, golden->camera, keep_pixels, &format);
    return gn_camera_pass(context, golden->camera, keep_pixels, &format);
}

static void render(result *out, const golden_scene *golden, const method *by, int small_regions)
{
    gn_settings settings = settings_of(by, small_regions);
    settings.static_objects = by->casters ? golden->scene->object_count - 1 : 0;
    gn_plan plan;
    gn_context *context;

    gn_status status = gn_make_plan(&plan, golden->scene, &settings);
    if (status != GN_OK)
        fail("plan", golden, by, status);
    status = gn_init(&context, golden->scene, &settings, memory, sizeof memory);
    if (status != GN_OK)
        fail("init", golden, by, status);
    out->plan_bytes = plan.bytes;

    out->view_instructions = 0;
    if (has_view(by))
        status = see_view(out, context, &plan, golden, small_regions);
    if (status != GN_OK)
        fail("view", golden, by, status);

    status = see_light(out, context, &plan, golden, by, small_regions);
    if (status != GN_OK)
        fail("light", golden, by, status);

    uint32_t start = port_instructions();
    status = see_image(context, golden, by);
    if (status != GN_OK)
        fail("camera", golden, by, status);
    out->camera_instructions = port_instructions() - start;
    look_at_mask(out);
    out->stages[MASK_STAGE] = hash_bytes(stage_hash_init(), mask, WIDTH * HEIGHT);
    out->stages[COLOUR_STAGE] = hash_colour(stage_hash_init(), by->format);
}

/* What a scene consists of that is not as it was packed. */
enum { MOST_OBJECTS = 4 };
static gn_object staged_objects[MOST_OBJECTS];
static gn_mesh soup;
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

/* The box of a light from above says how large the scene is. */
static gn_status light_from_above(gn_light *sun, const gn_scene *scene)
{
    static const int32_t down[3] = {0, -1, 0};
    gn_status status = gn_directional_light(sun, down, 0);
    return status == GN_OK ? gn_fit_light(sun, scene) : status;
}

static void move(const golden_scene *golden, const method *by, gn_object *last)
{
    static const int32_t axis[3] = {1, 3, 2};
    gn_light sun = {0};
    last->model = &moved_model;
    gn_model_identity(&moved_model);
    int status = gn_model_scale(&moved_model, -32768, 32768, 32768);
    status |= gn_model_rotate(&moved_model, axis, GN_DEGREES(25));
    status |= light_from_above(&sun, golden->scene);
    status |= gn_orthographic(&staged_camera, sun.box_width / 4, golden->camera->near_depth, golden->camera->far_depth);
    if (status != GN_OK)
        fail("move", golden, by, status);
    if (staged_light.kind == GN_SPOT)
        staged_light.near_depth += (staged_light.far_depth - staged_light.near_depth) / 4;
}

/* A lamp somewhat below the scene's top. Behind: long shadows towards the camera; within: shadows on most faces. */
static void hang_lamp(const golden_scene *golden, const method *by)
{
    gn_light sun = {0};
    int32_t position[3];
    int status = light_from_above(&sun, golden->scene);
    int32_t sixteenths_u = by->staging == LAMP_WITHIN ? 7 : 6, sixteenths_v = by->staging == LAMP_WITHIN ? 6 : 4;
    int64_t u = sun.box_u + sun.box_width / 16 * sixteenths_u, v = sun.box_v + sun.box_height / 16 * sixteenths_v;
    int64_t z = sun.box_z + sun.box_depth / 8;
    for (int i = 0; i < 3; i++)
        position[i] = (int32_t)((u * sun.right[i] + v * sun.up[i] + z * sun.forward[i]) / (1 << 30));
    int32_t reach = sun.box_width + sun.box_depth;
    status |= gn_point_light(&staged_light, position, reach / 64, reach);
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
    else if (by->staging == SOUP)
        take_edges_away(last);
    else
        hang_lamp(packed, by);
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
    if (stage == WARP_STAGE)
        return has_view(by);
    if (stage == SILHOUETTES_STAGE)
        return has_silhouettes(by);
    return stage >= MASK_STAGE || (by->shadow != GN_SHADOW_VOLUMES && by->faces != &gn_one_face);
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
    if (by->faces == &gn_six_faces && whole.faces < LEAST_FACES)
        fail("too-few-faces", &golden, by, -(int)whole.faces);
    write_cost_line(golden.name, by->name, &whole);
    return whole.plan_bytes > parts.plan_bytes ? whole.plan_bytes : parts.plan_bytes;
}

/* What tests pixels in a way of its own does so in four scenes: the other two would double the time of slow targets. */
static int is_left_out(const golden_scene *golden, const method *by)
{
    return golden->many_triangles &&
           (by->receiver || by->reconstruction || by->surface == GN_SLOPE || has_view(by) || by->faces);
}

int main(void)
{
    size_t most_bytes = 0;
    for (size_t s = 0; s < COUNT(scenes); s++) {
        write_hash_line(scenes[s].name, "set-up", "axes", hash_axes(&scenes[s]));
        for (size_t m = 0; m < method_count; m++) {
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
