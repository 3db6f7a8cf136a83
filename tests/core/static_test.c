/* Static casters: layers that are kept and those of what moves make the maps of one light pass over all objects, bit
 * for bit, frame after frame, whatever moves between them; and what is kept is drawn again where it has to be, and
 * nowhere else. The twin is a context without gn_static_casters that draws every frame from nothing; what a frame may
 * cost is counted by that and by a third one, of a scene that holds the moving objects alone.
 *
 * First layers and maps of small random scenes, then whole pictures of scenes with boxes by every chain of receiver,
 * reconstruction, fit and warp, then point lights. Cases: 800 scenes of 5 frames, a third as many pictures, or
 * GNOMON_CASES. */
#include "gn_cascade.h"
#include "mesh_edges.h"
#include "orders.h"
#include "point_scene.h"
#include "warps.h"

enum { FRAMES = 5 };

static uint64_t triangles_drawn(const frame *f)
{
    gn_statistics s;
    gn_get_statistics(f->context, &s);
    return s.light_triangles;
}

static uint64_t texels_drawn(const frame *f)
{
    gn_statistics s;
    gn_get_statistics(f->context, &s);
    return s.light_texels;
}

/* ---- what happens between frames --------------------------------------------------------------------------------- */

/* Which of a scene's objects stand still, and whether all that they cast depends on is what it was. */
typedef struct events {
    gn_object *objects;
    gn_model *models; /* one for each object, used or not */
    uint32_t count, still;
    int same;
} events;

/* By 1 to reach units in some direction: never where it was. */
static void push(gn_model *model, int32_t reach)
{
    model->t[between(0, 2)] += between(1, reach) * (between(0, 1) ? 1 : -1);
}

/* Turned, mirrored, or pushed by one unit. */
static void change(gn_model *model, int32_t reach)
{
    static const int32_t axis[3] = {0, 0, 1};
    int how = between(0, 3);
    for (int i = 0; how == 0 && i < 3; i++)
        model->m[0][i] = -model->m[0][i];
    if (how == 1)
        (void)gn_model_rotate(model, axis, GN_DEGREES(90));
    if (how > 1)
        push(model, how == 2 ? 1 : reach);
}

/* Static objects with a model. Where there are more than when the plan was made they are drawn in every frame. */
static uint32_t static_models(const events *e)
{
    uint32_t models = 0;
    for (uint32_t i = 0; i < e->still; i++)
        models += e->objects[i].model != 0;
    return models;
}

static void move_what_moves(events *e, int32_t reach)
{
    for (uint32_t i = e->still; i < e->count; i++)
        if (e->objects[i].model && between(0, 2))
            change(&e->models[i], reach);
}

/* A static object gets a model, or loses it, or it is changed, or is the next one's now. */
static void move_what_stands(events *e, int32_t reach)
{
    uint32_t i;
    if (!e->still)
        return;
    i = (uint32_t)between(0, e->still - 1);
    e->same = 0;
    uint32_t next = i + 1 < e->still ? i + 1 : 0;
    if (e->objects[i].model && !e->objects[next].model && between(0, 1)) {
        e->models[next] = e->models[i];
        e->objects[next].model = &e->models[next];
        e->objects[i].model = 0;
    } else if (e->objects[i].model && between(0, 3)) {
        change(&e->models[i], reach);
    } else if (e->objects[i].model) {
        e->objects[i].model = 0;
    } else {
        push(&e->models[i], reach);
        e->objects[i].model = &e->models[i];
    }
}

/* An object leaves the world: light passes are refused. */
enum { BEYOND = 1 << 26 };

static void exile(events *e)
{
    uint32_t i = (uint32_t)between(0, e->count - 1);
    if (!e->objects[i].model)
        return;
    e->models[i].t[0] = BEYOND;
    e->same &= i >= e->still;
}

static void return_exiles(events *e)
{
    for (uint32_t i = 0; i < e->count; i++) {
        if (e->models[i].t[0] != BEYOND)
            continue;
        e->models[i].t[0] = 0;
        e->same &= i >= e->still;
    }
}

/* ---- layers and maps --------------------------------------------------------------------------------------------- */

/* A scene on the map of grid_light: depths of a few levels, corners on half texels, so that ties are common. */
static void make_scene(random_scene *r, int32_t width, int32_t height)
{
    memset(r, 0, sizeof *r);
    r->scene.objects = r->objects;
    r->scene.object_count = (uint32_t)between(1, MOST_OBJECTS);
    for (uint32_t o = 0; o < r->scene.object_count; o++) {
        shape *s = &r->shapes[o];
        *s = shape_new(between(0, 1));
        int vertices = between(3, 12), triangles = between(1, 12);
        for (int i = 0; i < vertices; i++)
            add_vertex(s, 128 * between(-4, 2 * width + 4), 128 * between(-4, 2 * height + 4), -1000 * between(1, 9));
        for (int i = 0; i < triangles; i++)
            add_triangle(s, (uint32_t)between(0, vertices - 1), (uint32_t)between(0, vertices - 1),
                         (uint32_t)between(0, vertices - 1));
        r->objects[o].mesh = &s->mesh;
        gn_model_identity(&r->models[o]);
        if (between(0, 2))
            r->objects[o].model = &r->models[o];
    }
}

static gn_settings random_settings(int32_t width, int32_t height)
{
    static const uint8_t choice[][3] = {
        {GN_CONSTANT, GN_LAYERS_FIRST, GN_CULL_NONE}, {GN_CONSTANT, GN_LAYERS_FIRST, GN_CULL_BACK},
        {GN_MIDPOINT, GN_LAYERS_TWO, GN_CULL_NONE},   {GN_MIDPOINT, GN_LAYERS_TWO, GN_CULL_BACK},
        {GN_DUAL, GN_LAYERS_TWO, GN_CULL_BACK},       {GN_SECOND, GN_LAYERS_TWO, GN_CULL_NONE},
        {GN_SECOND, GN_LAYERS_FIRST, GN_CULL_FRONT},  {GN_MIXED, GN_LAYERS_TWO, GN_CULL_NONE},
        {GN_SLOPE, GN_LAYERS_FIRST, GN_CULL_NONE},    {GN_SLOPE, GN_LAYERS_AUTO, GN_CULL_FRONT},
    };
    const uint8_t *c = choice[between(0, sizeof choice / sizeof choice[0] - 1)];
    gn_settings s = gn_default_settings(8, 8, 1);
    s.map_width = (uint16_t)width;
    s.map_height = (uint16_t)height;
    s.surface = c[0];
    s.layers = c[1];
    s.cull = c[2];
    s.map_rows = (uint16_t)between(0, height);
    s.workers = (uint8_t)between(1, 4);
    s.bias.unit = GN_BIAS_WORLD;
    s.bias.value = (uint32_t)between(0, 300);
    s.slope = between(0, 4 << 16);
    return s;
}

/* The light of the grid, or one that cuts into the scene: a spot light within it. */
static gn_light random_light(int32_t width, int32_t height)
{
    gn_light light = grid_light((uint32_t)width, (uint32_t)height);
    if (between(0, 1))
        return light;
    const int32_t position[3] = {128 * width, 128 * height, between(-4500, 3000)};
    const int32_t target[3] = {between(0, 256 * width), between(0, 256 * height), -10000};
    (void)gn_spot_light(&light, position, target, 0, GN_DEGREES(between(40, 100)), 500, 20000);
    return light;
}

/* Another light: by one of its numbers, or of the other kind. */
static void change_light(gn_light *light, int32_t width, int32_t height)
{
    gn_light before = *light;
    int32_t *const numbers[2][4] = {{&light->box_u, &light->box_v, &light->box_z, &light->box_depth},
                                    {&light->position[0], &light->position[2], &light->near_depth, &light->far_depth}};
    if (between(0, 3)) {
        *numbers[light->kind == GN_SPOT][between(0, 3)] += 100;
    } else {
        do
            *light = random_light(width, height);
        while (light->kind == before.kind);
    }
}

/* The twins: that keeps layers, that draws all, and that draws the moving objects alone. */
typedef struct twins {
    frame kept, all, moving;
    gn_scene moving_scene;
} twins;

static gn_status twins_start(twins *t, const gn_scene *scene, const gn_settings *settings, uint32_t still)
{
    gn_settings s = *settings;
    memset(t, 0, sizeof *t);
    gn_status status = frame_start(&t->all, scene, &s);
    t->moving_scene = *scene;
    t->moving_scene.objects += still;
    t->moving_scene.object_count -= still;
    s.layers = t->all.plan.layers; /* of closed objects alone others might be chosen */
    s.cull = t->all.plan.cull;
    if (status == GN_OK)
        status = frame_start(&t->moving, &t->moving_scene, &s);
    s.casters = &gn_static_casters;
    s.static_objects = still;
    return status == GN_OK ? frame_start(&t->kept, scene, &s) : status;
}

static int twins_end(twins *t)
{
    int intact = frame_end(&t->kept);
    intact &= frame_end(&t->all);
    return frame_end(&t->moving) && intact;
}

typedef struct tally {
    unsigned failures;
    uint64_t frames, reused, drawn, spared, covered, two, refused;
} tally;

static void fail(tally *count, uint64_t n, int number, const gn_settings *s, const char *what)
{
    if (count->failures++ < 5)
        note("case %llu, frame %d: %s; surface %d, cull %d, %d rows a region, %d workers", (unsigned long long)n,
             number, what, (int)s->surface, (int)s->cull, (int)s->map_rows, (int)s->workers);
}

static int same_rows(const gn_depth *a, const gn_depth *b, uint32_t rows, uint32_t stride, uint32_t width)
{
    for (uint32_t row = 0; row < rows; row++)
        if (memcmp(a + row * stride, b + row * stride, width * sizeof *a))
            return 0;
    return 1;
}

/* All regions of both, in any order, layer by layer. */
static gn_status compare_layers(twins *t, tally *count, uint64_t n, int number)
{
    gn_context *a = t->kept.context, *b = t->all.context;
    gn_status status = GN_OK;
    uint32_t regions = t->all.plan.light_regions, from = (uint32_t)between(0, regions - 1);
    for (uint32_t i = 0; status == GN_OK && i < regions; i++) {
        uint32_t region = (from + i) % regions, worker = (uint32_t)between(0, t->all.settings.workers - 1);
        uint32_t first, rows, stride;
        status = gn_light_layers(a, region, worker);
        if (status == GN_OK)
            status = gn_light_layers(b, region, worker);
        for (uint32_t layer = 0; status == GN_OK && layer < 2; layer++) {
            const gn_depth *got = gn_layer(a, layer, region, worker, &first, &rows, &stride);
            const gn_depth *expected = gn_layer(b, layer, region, worker, &first, &rows, &stride);
            if (!expected)
                continue;
            if (!same_rows(got, expected, rows, stride, t->all.settings.map_width))
                fail(count, n, number, &t->all.settings,
                     layer ? "the second layer differs" : "the first layer differs");
            for (uint32_t k = 0; k < rows * stride; k++)
                *(layer ? &count->two : &count->covered) +=
                    k % stride < t->all.settings.map_width && expected[k] != (gn_depth)0xffffffffu;
        }
        if (status == GN_OK)
            status = gn_light_resolve(a, region, worker);
        if (status == GN_OK)
            status = gn_light_resolve(b, region, worker);
    }
    return status;
}

/* A pass that ends before its last region. */
static void interrupt(frame *f, const gn_light *light)
{
    if (gn_light_begin(f->context, light) != GN_OK)
        return;
    uint32_t regions = (uint32_t)between(0, f->plan.light_regions - 1);
    for (uint32_t i = 0; i < regions; i++)
        (void)gn_light_layers(f->context, i, 0);
}

static gn_status compare_maps(twins *t, const gn_light *light, tally *count, uint64_t n, int number)
{
    const gn_settings *s = &t->all.settings;
    gn_status status, expected = gn_light_begin(t->all.context, light);
    int threads = between(0, 7) == 0;
    if (threads && expected == GN_OK)
        expected = gn_light_pass(t->all.context, light);
    status =
        threads ? light_pass_on_threads(t->kept.context, light, s->workers) : gn_light_begin(t->kept.context, light);
    if (status != expected)
        fail(count, n, number, s, "the statuses differ");
    if (!threads && status == GN_OK && expected == GN_OK)
        status = compare_layers(t, count, n, number);
    if (status != GN_OK)
        return status;
    if (!same_rows(t->kept.context->map, t->all.context->map, s->map_height, t->all.context->map_stride, s->map_width))
        fail(count, n, number, s, "the maps differ");
    if (t->kept.context->light_trusted != t->all.context->light_trusted)
        fail(count, n, number, s, "one knows all points to be within the light's box, the other does not");
    return GN_OK;
}

/* A pass over all costs what one without kept layers does; one that reuses them costs what the moving objects do. */
static void compare_costs(const uint64_t before[6], const twins *t, int reuses, tally *count, uint64_t n, int number)
{
    const frame *as = reuses ? &t->moving : &t->all;
    uint64_t triangles = triangles_drawn(&t->kept) - before[0], texels = texels_drawn(&t->kept) - before[1];
    if (triangles != triangles_drawn(as) - before[reuses ? 4 : 2] ||
        texels != texels_drawn(as) - before[reuses ? 5 : 3])
        fail(count, n, number, &t->all.settings,
             reuses ? "static objects are drawn again" : "they are not drawn again");
    count->frames++;
    count->reused += (uint64_t)reuses;
    count->drawn += triangles;
    count->spared += triangles_drawn(&t->all) - before[2] - triangles;
}

static void note_costs(uint64_t costs[6], const twins *t)
{
    const frame *frames[3] = {&t->kept, &t->all, &t->moving};
    for (int i = 0; i < 3; i++) {
        costs[2 * i] = triangles_drawn(frames[i]);
        costs[2 * i + 1] = texels_drawn(frames[i]);
    }
}

/* The camera pass uses the vertices' memory. */
static void look(frame *f, int32_t width)
{
    gn_camera camera;
    if (camera_above(&camera, 0, 0, 256 * width) == GN_OK)
        (void)gn_camera_pass(f->context, &camera, frame_flush, f);
}

static void layers_of_one_scene(uint64_t n, tally *count)
{
    random_scene r;
    twins t;
    int32_t width = between(1, 40), height = between(1, 40);
    gn_settings settings = random_settings(width, height);
    gn_light light = random_light(width, height);
    make_scene(&r, width, height);
    events e = {r.objects, r.models, r.scene.object_count, (uint32_t)between(0, r.scene.object_count), 0};
    uint32_t room = static_models(&e);
    gn_status status = twins_start(&t, &r.scene, &settings, e.still);
    for (int number = 0; status == GN_OK && number < FRAMES; number++) {
        uint64_t before[6];
        int reuses = e.same && static_models(&e) <= room;
        if (between(0, 3) == 0)
            interrupt(&t.kept, &light);
        note_costs(before, &t);
        if (compare_maps(&t, &light, count, n, number) == GN_OK && gn_light_pass(t.moving.context, &light) == GN_OK) {
            compare_costs(before, &t, reuses, count, n, number);
            e.same = 1;
        } else {
            count->refused++;
            e.same = reuses;
        }
        return_exiles(&e);
        if (between(0, 1))
            look(&t.kept, width);
        if (between(0, 1))
            move_what_moves(&e, 3000);
        if (between(0, 4) == 0) {
            change_light(&light, width, height);
            e.same = 0;
        }
        if (between(0, 4) == 0)
            move_what_stands(&e, 3000);
        if (between(0, 9) == 0)
            exile(&e);
    }
    if (!twins_end(&t))
        fail(count, n, 0, &settings, "something outside the block was written");
    for (int i = 0; i < MOST_OBJECTS; i++)
        shape_free(&r.shapes[i]);
}

/* ---- pictures by every chain ------------------------------------------------------------------------------------- */

enum { BOXES = 6, LEVELS = 2, OBJECTS = BOXES + LEVELS };

/* A floor, a level without edges above it, and boxes with edges: some of each stand still. */
typedef struct yard {
    shape shapes[OBJECTS];
    gn_model models[OBJECTS];
    gn_object objects[OBJECTS];
    gn_scene scene;
} yard;

static void make_yard(yard *y)
{
    memset(y, 0, sizeof *y);
    y->shapes[0] = shape_new(0);
    add_level(&y->shapes[0], -1000, -1000, 1000, 1000, 0, 1);
    y->shapes[1] = shape_new(0);
    add_level(&y->shapes[1], between(-600, 0), between(-600, 0), between(100, 600), between(100, 600), 500, 1);
    for (int i = LEVELS; i < OBJECTS; i++) {
        int32_t low[3] = {between(-900, 600), between(-900, 600), between(-50, 300)}, high[3];
        for (int k = 0; k < 3; k++)
            high[k] = low[k] + between(40, 500);
        y->shapes[i] = shape_new(between(0, 3) != 0);
        add_box(&y->shapes[i], low, high);
        make_edges(&y->shapes[i]);
    }
    for (int i = 0; i < OBJECTS; i++) {
        gn_object object = {&y->shapes[i].mesh, i && between(0, 3) ? &y->models[i] : 0, {200, 180, 160}};
        gn_model_identity(&y->models[i]);
        y->objects[i] = object;
    }
    y->scene.objects = y->objects;
    y->scene.object_count = OBJECTS;
    y->scene.ambient = 9000;
}

static void free_yard(yard *y)
{
    for (int i = 0; i < OBJECTS; i++) {
        if (i >= LEVELS)
            free(edges_of(&y->shapes[i]));
        shape_free(&y->shapes[i]);
    }
}

/* Any chain, most of which make sense. */
static gn_settings random_chain(void)
{
    static const gn_warp *const all_warps[] = {&gn_rectilinear, &gn_rectilinear_distance, &gn_nonorthogonal,
                                               &gn_rectilinear_vertices};
    gn_settings s = gn_default_settings(48, 36, (uint16_t)between(20, 72));
    s.map_height = (uint16_t)between(20, 72);
    s.surface = (uint8_t)between(GN_CONSTANT, GN_SLOPE);
    s.bias.value = 2 << 16;
    s.slope = 2 << 16;
    s.map_rows = (uint16_t)(between(0, 1) ? between(3, 30) : 0);
    s.mask = 1;
    s.receiver = receivers[between(0, RECEIVERS - 1)];
    s.reconstruction = reconstructions[between(0, RECONSTRUCTIONS - 1)];
    s.fit = between(0, 1) ? fits[between(0, 2)] : 0;
    s.warp = between(0, 2) ? 0 : all_warps[between(0, 3)];
    s.fit_depth = (uint8_t)(s.fit && between(0, 1));
    return s;
}

static int same_drawn_maps(const frame *a, const frame *b)
{
    uint32_t stride = 0;
    const uint8_t *got = gn_silhouette_map(a->context, &stride), *expected = gn_silhouette_map(b->context, &stride);
    got = got ? got : gn_crossing_map(a->context, &stride);
    expected = expected ? expected : gn_crossing_map(b->context, &stride);
    return got && expected ? !memcmp(got, expected, (size_t)stride * b->settings.map_height) : got == expected;
}

typedef struct shot {
    gn_light light;
    gn_camera camera;
    int spot, looked; /* the view pass was done by camera and light */
} shot;

/* Both twins: what the camera sees, if it is asked, the map, and the picture. */
static gn_status take(twins *t, const shot *s, int view, tally *count, uint64_t n, int number)
{
    frame *pair[2] = {&t->kept, &t->all};
    gn_status status[2] = {GN_OK, GN_OK};
    for (int i = 0; i < 2; i++) {
        if (view)
            status[i] = gn_view_pass(pair[i]->context, &s->camera, &s->light);
        if (status[i] == GN_OK)
            status[i] = gn_light_pass(pair[i]->context, &s->light);
    }
    if (status[0] != status[1])
        fail(count, n, number, &t->all.settings, "the statuses differ");
    if (status[0] != GN_OK || status[1] != GN_OK)
        return status[1];
    if (!same_rows(t->kept.context->map, t->all.context->map, t->all.settings.map_height, t->all.context->map_stride,
                   t->all.settings.map_width))
        fail(count, n, number, &t->all.settings, "the maps differ");
    if (!same_drawn_maps(&t->kept, &t->all))
        fail(count, n, number, &t->all.settings, "the maps of silhouettes or crossings differ");
    for (int i = 0; i < 2; i++)
        status[i] = gn_camera_pass(pair[i]->context, &s->camera, frame_flush, pair[i]);
    if (status[0] != status[1])
        fail(count, n, number, &t->all.settings, "the statuses of the camera pass differ");
    if (status[0] == GN_OK && status[1] == GN_OK && !same_pictures(&t->kept, &t->all))
        fail(count, n, number, &t->all.settings, "the pictures differ");
    return status[1];
}

typedef struct pixels {
    uint64_t lit, shadowed, chains, drawings, warped, spots;
} pixels;

static void pictures_of_one_scene(uint64_t n, tally *count, pixels *seen)
{
    yard y;
    twins t;
    shot s;
    make_yard(&y);
    events e = {y.objects, y.models, OBJECTS, (uint32_t)between(0, OBJECTS), 0};
    gn_settings settings = random_chain();
    uint32_t room = static_models(&e);
    int view = 1, bound = settings.fit || settings.warp;
    memset(&s, 0, sizeof s);
    s.spot = between(0, 2) == 0;
    gn_status status = twins_start(&t, &y.scene, &settings, e.still);
    if (status == GN_OK &&
        (random_camera(&s.camera) != GN_OK || random_light_above(&s.light, &y.scene, s.spot) != GN_OK))
        status = GN_STOPPED;
    seen->chains += status == GN_OK;
    seen->spots += status == GN_OK && s.spot;
    seen->drawings += status == GN_OK && settings.reconstruction && settings.reconstruction->drawing;
    seen->warped += status == GN_OK && bound;
    for (int number = 0; status == GN_OK && number < FRAMES; number++) {
        uint64_t before[6];
        int reuses = e.same && static_models(&e) <= room && !(view && settings.warp);
        note_costs(before, &t);
        if (take(&t, &s, bound && view, count, n, number) == GN_OK) {
            count_mask(&t.all, &seen->lit, &seen->shadowed);
            if (!bound && gn_light_pass(t.moving.context, &s.light) == GN_OK)
                compare_costs(before, &t, reuses, count, n, number);
            else if (bound && !reuses && !e.same)
                compare_costs(before, &t, 0, count, n, number);
            e.same = 1;
        } else {
            count->refused++;
            status = GN_STOPPED;
        }
        view = between(0, 1);
        move_what_moves(&e, 200);
        if (between(0, 3) == 0)
            move_what_stands(&e, 100);
        if (view && between(0, 1) && random_camera(&s.camera) != GN_OK)
            status = GN_STOPPED;
        if (view && between(0, 3) == 0) {
            s.light.box_depth += 16;                  /* of directional lights */
            s.light.position[2] += 10;                /* of spot lights */
            e.same &= settings.fit && !settings.warp; /* a fit may find the same box, of any light */
        }
    }
    if (!twins_end(&t))
        fail(count, n, 0, &settings, "something outside the block was written");
    free_yard(&y);
}

/* ---- point lights ------------------------------------------------------------------------------------------------ */

/* The faces' maps that a pass has drawn, all or one, and what was drawn beside them. */
static int same_faces(const twins *t)
{
    const gn_settings *s = &t->all.settings;
    return same_rows(t->kept.context->map, t->all.context->map, s->map_height, t->all.context->map_stride,
                     s->map_width) &&
           same_drawn_maps(&t->kept, &t->all);
}

static gn_status draw_face(frame *f, const gn_light *light, uint32_t face)
{
    uint32_t regions = 0;
    gn_status status = gn_light_face(f->context, light, face, &regions);
    for (uint32_t i = 0; status == GN_OK && i < regions; i++) {
        status = gn_light_layers(f->context, i, i % f->settings.workers);
        if (status == GN_OK)
            status = gn_light_resolve(f->context, i, i % f->settings.workers);
    }
    return status;
}

typedef enum knowledge { STALE, SAME, UNKNOWN } knowledge;

/* Some faces, or all. same: whether what is kept of each is good. */
static void draw_faces(twins *t, const gn_light *light, knowledge same[FACES], int all, tally *count, uint64_t n,
                       int number)
{
    uint32_t from = (uint32_t)between(0, FACES - 1), faces = all ? FACES : (uint32_t)between(1, FACES - 1);
    for (uint32_t i = 0; i < faces; i++) {
        uint32_t face = (from + i) % FACES;
        uint64_t before[6];
        note_costs(before, t);
        if (draw_face(&t->kept, light, face) != GN_OK || draw_face(&t->all, light, face) != GN_OK ||
            draw_face(&t->moving, light, face) != GN_OK)
            fail(count, n, number, &t->all.settings, "a face is refused");
        else if (!same_faces(t))
            fail(count, n, number, &t->all.settings, "the maps of a face differ");
        else if (same[face] != UNKNOWN)
            compare_costs(before, t, same[face] == SAME, count, n, number);
        same[face] = SAME;
    }
}

/* Light and camera pass of both; steps: by faces, or in one. */
static void take_point(twins *t, const gn_light *light, const gn_camera *camera, int steps, tally *count, uint64_t n,
                       int number)
{
    frame *pair[2] = {&t->kept, &t->all};
    gn_status status[2];
    for (int i = 0; i < 2; i++)
        status[i] = steps ? gn_camera_pass(pair[i]->context, camera, frame_flush, pair[i])
                          : gn_point_pass(pair[i]->context, light, camera, frame_flush, pair[i]);
    if (status[0] != GN_OK || status[1] != GN_OK)
        fail(count, n, number, &t->all.settings, "a picture is refused");
    else if (!same_pictures(&t->kept, &t->all))
        fail(count, n, number, &t->all.settings, "the pictures differ");
}

static void faces_of_one_scene(uint64_t n, tally *count, pixels *seen)
{
    stage st;
    twins t;
    gn_model models[3];
    knowledge same[FACES] = {STALE, STALE, STALE, STALE, STALE, STALE};
    gn_camera camera;
    set_stage(&st);
    gn_object order[3] = {st.objects[2], st.objects[1], st.objects[0]};
    for (int i = 0; i < 3; i++) {
        gn_model_identity(&models[i]);
        st.objects[i] = order[i];
        if (i)
            st.objects[i].model = &models[i];
    }
    models[0] = st.model;
    st.objects[0].model = &models[0];
    events e = {st.objects, models, 3, (uint32_t)between(0, 3), 0};
    st.settings.map_rows = (uint16_t)(between(0, 1) ? between(5, MAP) : 0);
    st.settings.surface = (uint8_t)between(GN_CONSTANT, GN_SLOPE);
    st.settings.reconstruction = reconstructions[between(0, RECONSTRUCTIONS - 1)];
    gn_status status = twins_start(&t, &st.scene, &st.settings, e.still);
    if (status != GN_OK)
        fail(count, n, 0, &st.settings, "the plan is refused");
    for (int number = 0; status == GN_OK && number < FRAMES; number++) {
        int how = between(0, 2); /* some faces; all and a picture; all that the picture needs */
        set_camera(&camera, between(0, 4));
        e.same = 1;
        if (how < 2)
            draw_faces(&t, &st.light, same, how == 1, count, n, number);
        for (int face = 0; how == 2 && face < FACES; face++)
            same[face] = same[face] == STALE ? UNKNOWN : same[face];
        if (how)
            take_point(&t, &st.light, &camera, how == 1, count, n, number);
        if (how)
            count_mask(&t.all, &seen->lit, &seen->shadowed);
        if (between(0, 1))
            move_what_moves(&e, REACH / 8);
        if (between(0, 4) == 0)
            move_what_stands(&e, REACH / 8);
        if (between(0, 4) == 0) {
            st.light.position[between(0, 2)] += 1000;
            e.same = 0;
        }
        for (int face = 0; !e.same && face < FACES; face++)
            same[face] = STALE;
    }
    if (!twins_end(&t))
        fail(count, n, 0, &st.settings, "something outside the block was written");
    free_stage(&st);
}

/* ---- by hand ----------------------------------------------------------------------------------------------------- */

/* Levels over a map of one texel: one that stands still at a depth of 300, another one anywhere. */
typedef struct two_levels {
    shape shapes[2];
    gn_model model;
    gn_object objects[2];
    gn_scene scene;
} two_levels;

static void make_levels(two_levels *l)
{
    memset(l, 0, sizeof *l);
    for (int i = 0; i < 2; i++) {
        gn_object object = {&l->shapes[i].mesh, i ? &l->model : 0, {200, 200, 200}};
        l->shapes[i] = shape_new(0);
        add_level(&l->shapes[i], -256, -256, 512, 512, i ? 0 : -300, 1);
        l->objects[i] = object;
    }
    gn_model_identity(&l->model);
    l->scene.objects = l->objects;
    l->scene.object_count = 2;
}

static void free_levels(two_levels *l)
{
    shape_free(&l->shapes[0]);
    shape_free(&l->shapes[1]);
}

static void depths_by_hand(void)
{
    /* the moving level's depth, and those of the map; second: an open level is a solid of its own; the midpoint of one
     * level twice is itself */
    static const uint32_t moves[4] = {100, 400, 200, 300}, constant[4] = {100, 300, 200, 300};
    static const uint32_t midpoint[4] = {200, 350, 250, 300};
    static const struct {
        uint8_t surface;
        const uint32_t *expected;
    } by[3] = {{GN_CONSTANT, constant}, {GN_MIDPOINT, midpoint}, {GN_SECOND, constant}};
    int good = 1;
    for (int i = 0; i < 3; i++) {
        two_levels l;
        frame f;
        gn_light light = grid_light(1, 1);
        gn_settings settings = gn_default_settings(4, 4, 1);
        settings.surface = by[i].surface;
        settings.casters = &gn_static_casters;
        settings.static_objects = 1;
        make_levels(&l);
        gn_status status = frame_start(&f, &l.scene, &settings);
        for (int k = 0; status == GN_OK && k < 4; k++) {
            l.model.t[2] = -(int32_t)moves[k];
            status = gn_light_pass(f.context, &light);
            good &= status == GN_OK && texel_at(f.context, 0, 0) == grid_depth(by[i].expected[k]);
        }
        good &= status == GN_OK;
        frame_end(&f);
        free_levels(&l);
    }
    ok(good, "the depths of a level that stands and one that moves are those worked out by hand");
}

/* ---- what is promised -------------------------------------------------------------------------------------------- */

static void plans_say_what_is_kept(void)
{
    yard y;
    gn_plan without, with, moved;
    gn_settings s = gn_default_settings(64, 48, 100);
    int good = 1;
    make_yard(&y);
    for (int i = 0; i < OBJECTS; i++)
        y.objects[i].model = 0;
    for (int layers = 1; layers <= 2; layers++) {
        s.surface = layers == 1 ? GN_CONSTANT : GN_MIDPOINT;
        s.casters = 0;
        s.static_objects = OBJECTS;
        good &= gn_make_plan(&without, &y.scene, &s) == GN_OK && without.static_bytes == 0;
        s.casters = &gn_static_casters;
        good &= gn_make_plan(&with, &y.scene, &s) == GN_OK;
        size_t rest = with.static_bytes - (size_t)layers * with.map_bytes;
        good &= rest < 512 && with.map_bytes == without.map_bytes;
        good &=
            with.bytes >= without.bytes + with.static_bytes - 8 && with.bytes <= without.bytes + with.static_bytes + 8;
        y.objects[1].model = &y.models[1];
        y.objects[2].model = &y.models[2];
        good &= gn_make_plan(&moved, &y.scene, &s) == GN_OK && moved.static_bytes == with.static_bytes + 2 * 56;
        y.objects[1].model = y.objects[2].model = 0;
    }
    ok(good, "a plan has the bytes of a layer or two more, and of each model that stands still; without, none");
    s.static_objects = OBJECTS + 1;
    good = gn_make_plan(&with, &y.scene, &s) == GN_OUT_OF_RANGE;
    s.static_objects = OBJECTS;
    s.faces = &gn_one_face;
    good &= gn_make_plan(&with, &y.scene, &s) == GN_UNSUPPORTED;
    y.scene.objects += LEVELS; /* those with edges */
    y.scene.object_count = s.static_objects = BOXES;
    s.faces = 0;
    s.shadow = GN_SHADOW_VOLUMES;
    good &= gn_make_plan(&with, &y.scene, &s) == GN_OK && with.static_bytes == 0;
    ok(good, "more objects than there are and one face at a time are refused; volumes keep nothing");
    free_yard(&y);
}

/* Triangles of a light pass, after a view pass by a camera (0: none). */
static uint64_t cost_of(frame *f, const gn_camera *camera, const gn_light *light)
{
    uint64_t before = triangles_drawn(f);
    if (camera && gn_view_pass(f->context, camera, light) != GN_OK)
        return 0;
    return gn_light_pass(f->context, light) == GN_OK ? triangles_drawn(f) - before : 0xffff;
}

/* All objects stand still: a pass draws nothing, or all. */
static void view_passes_count(void)
{
    yard y;
    gn_camera camera, other;
    gn_light light;
    int good = 1;
    make_yard(&y);
    good &= camera_above(&camera, -500, -500, 1000) == GN_OK && camera_above(&other, -200, -500, 1000) == GN_OK;
    good &= random_light_above(&light, &y.scene, 0) == GN_OK;
    for (int warped = 0; warped < 2; warped++) {
        gn_settings s = gn_default_settings(64, 64, 64);
        frame f;
        s.fit = &gn_desired_view;
        s.warp = warped ? &gn_rectilinear : 0;
        s.casters = &gn_static_casters;
        s.static_objects = OBJECTS;
        good &= frame_start(&f, &y.scene, &s) == GN_OK;
        good &= cost_of(&f, &camera, &light) > 0;
        good &= cost_of(&f, 0, &light) == 0;
        good &= (cost_of(&f, &camera, &light) > 0) == warped; /* the same rectangle; tables are not compared */
        good &= cost_of(&f, &other, &light) > 0;
        good &= cost_of(&f, 0, &light) == 0;
        frame_end(&f);
    }
    free_yard(&y);
    ok(good, "after a view pass that finds another rectangle, or any with a warp, static objects are drawn again");
}

/* A level in the shadow of a roof as wide as the light's box; after the light pass it moves out of the box, beside the
 * map's right end, and is lit there, as what lies beyond the box is. */
static void models_may_move_between_the_passes(void)
{
    int good = 1;
    for (int kept = 0; kept < 2; kept++) {
        two_levels l;
        frame f;
        gn_camera camera;
        gn_light light = grid_light(8, 8);
        gn_settings settings = gn_default_settings(4, 4, 8);
        settings.surface = GN_CONSTANT;
        settings.mask = 1;
        settings.casters = kept ? &gn_static_casters : 0;
        settings.static_objects = 1;
        make_levels(&l);
        shape_free(&l.shapes[0]);
        l.shapes[0] = shape_new(0);
        add_level(&l.shapes[0], 100, 100, 1948, 1948, -100, 1);
        l.model.t[0] = l.model.t[1] = 512;
        l.model.t[2] = -200;
        gn_status status = frame_start(&f, &l.scene, &settings);
        for (int moved = 0; status == GN_OK && moved < 2; moved++) {
            uint64_t lit = 0, shadowed = 0;
            status = gn_light_pass(f.context, &light);
            l.model.t[0] = moved ? 2048 + 512 : 512;
            if (status == GN_OK)
                status = camera_above(&camera, l.model.t[0], 512, 256);
            if (status == GN_OK) /* below the roof */
                status = gn_orthographic(&camera, 128, 1150, 1 << 20);
            if (status == GN_OK)
                status = gn_camera_pass(f.context, &camera, frame_flush, &f);
            count_mask(&f, &lit, &shadowed);
            good &= status == GN_OK && (moved ? lit : shadowed) == 16;
        }
        good &= frame_end(&f);
        free_levels(&l);
    }
    ok(good, "an object that has left the light's box since the light pass is lit");
}

static void note_counts(const tally *count)
{
    note("%llu frames, %llu with kept layers, %llu refused; %llu triangles drawn, %llu not drawn again",
         (unsigned long long)count->frames, (unsigned long long)count->reused, (unsigned long long)count->refused,
         (unsigned long long)count->drawn, (unsigned long long)count->spared);
}

static void layers_are_those_of_one_pass(uint64_t cases)
{
    tally count;
    memset(&count, 0, sizeof count);
    for (uint64_t n = 0; n < cases && count.failures < 5; n++)
        layers_of_one_scene(n, &count);
    note_counts(&count);
    ok(!count.failures, "layers and maps are those of one pass over all objects, in %llu scenes",
       (unsigned long long)cases);
    ok(count.reused > 2 * cases && count.refused > cases / 20 && count.spared > 10 * cases &&
           count.covered > 100 * cases && count.two > 50 * cases,
       "%llu texels with a depth, %llu with two", (unsigned long long)count.covered, (unsigned long long)count.two);
}

/* Until five have failed. */
static void run_scenes(void (*run)(uint64_t n, tally *count, pixels *seen), uint64_t cases, tally *count, pixels *seen)
{
    memset(count, 0, sizeof *count);
    memset(seen, 0, sizeof *seen);
    for (uint64_t n = 0; n < cases && count->failures < 5; n++)
        run(n, count, seen);
    note_counts(count);
}

static void pictures_are_those_of_one_pass(uint64_t cases)
{
    tally count;
    pixels seen;
    run_scenes(pictures_of_one_scene, cases, &count, &seen);
    ok(!count.failures, "so are pictures and silhouettes by every chain, in %llu scenes", (unsigned long long)cases);
    ok(seen.lit > 500 * cases && seen.shadowed > 200 * cases && seen.chains > cases * 8 / 10 &&
           seen.drawings > cases / 8 && seen.warped > cases / 5 && seen.spots > cases / 8 && count.reused > cases / 2,
       "%llu lit and %llu shadowed pixels; %llu of the chains draw silhouettes, %llu fit or warp, %llu by spot lights",
       (unsigned long long)seen.lit, (unsigned long long)seen.shadowed, (unsigned long long)seen.drawings,
       (unsigned long long)seen.warped, (unsigned long long)seen.spots);
}

static void faces_are_those_of_one_pass(uint64_t cases)
{
    tally count;
    pixels seen;
    run_scenes(faces_of_one_scene, cases, &count, &seen);
    ok(!count.failures, "so are the faces of point lights, some or all, in %llu scenes", (unsigned long long)cases);
    ok(seen.lit > 1000 * cases && seen.shadowed > 1000 * cases && count.reused > cases,
       "%llu lit and %llu shadowed pixels", (unsigned long long)seen.lit, (unsigned long long)seen.shadowed);
}

int main(int argc, char **argv)
{
    uint64_t cases = tap_cases(argc, argv, 800);
    depths_by_hand();
    plans_say_what_is_kept();
    view_passes_count();
    models_may_move_between_the_passes();
    layers_are_those_of_one_pass(cases);
    pictures_are_those_of_one_pass(cases / 3);
    faces_are_those_of_one_pass(cases / 15);
    return tap_done();
}
