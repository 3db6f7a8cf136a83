/* Casters that stand still: what the light pass makes of them is kept, and the others are inserted into it.
 *
 * The layers are the two smallest depths of all triangles over a texel, as a multiset (with GN_SLOPE the smallest of
 * each of two), before they are resolved. So those of some triangles may stay, and those of the rest may come later:
 *     layers(static and moving) = insert(layers(static), moving)
 * bit for bit, whatever the surface. Resolved maps would merge by min where one layer is all there is, and not with
 * two: the second depth may be of one, the first of the other.
 *
 * What is kept holds for a view of the light, a warp and the models of the static objects. All of it is compared when a
 * light pass begins, by value; where anything differs the static objects are drawn again, region by region, and kept
 * anew. So no picture depends on what was kept. A warp's tables are not compared: any view pass counts as another warp.
 *
 * Cost of a light pass: the map copied in place of cleared, the moving objects' vertices and triangles, a comparison of
 * models; when drawn anew a copy of the map more. Silhouettes and crossings need all vertices and all edges, as ever.
 * Memory: the map once more, with two layers twice, and 56 bytes for each static object that has a model. */
#include "gn_layers.h"
#include "gn_parameterisation.h"
#include "gn_point_light.h"

#define NOTHING 0xffffffffu /* as count: what no scene has */

/* A static object's model when it was drawn. */
typedef struct placing {
    uint32_t object;
    gn_model model;
} placing;

/* Of a map, or a face of a point light. */
typedef struct kept_map {
    gn_view view;
    uint8_t inside; /* gn_inside of the static objects */
    uint8_t empty;  /* point lights: 1: no static object reaches the face */
} kept_map;

/* What stands in the block behind the map. */
typedef struct kept {
    kept_map *maps;
    uint8_t *drawn;     /* a byte a region, map after map: 1: its layers are kept */
    gn_depth *layer[2]; /* as the map; [1]: with two layers */
    placing *placings;
    uint32_t room, count; /* of placings */
    uint8_t reused;       /* of the latest map: 1: its static objects are not drawn */
} kept;

/* ---- where it lies ----------------------------------------------------------------------------------------------- */

static gn_depth *first_map(const gn_context *context)
{
    return context->point ? context->point->map : context->map;
}

/* Everything but the placings, which lie at the end. Returns their place; with base 0 counts alone. */
static uint64_t lay_out(uint8_t *base, kept *k, const gn_plan *plan, const gn_settings *settings)
{
    uint64_t used = 0;
    uint32_t maps = gn_map_count(settings);
    (void)gn_take(base, &used, plan->map_bytes);
    (void)gn_take(base, &used, sizeof *k);
    k->maps = gn_take(base, &used, maps * sizeof *k->maps);
    k->drawn = gn_take(base, &used, (uint64_t)maps * plan->light_regions);
    for (int i = 0; i < 1 + gn_has_second(plan, settings); i++)
        k->layer[i] = gn_take(base, &used, plan->map_bytes);
    return used;
}

static kept *find_kept(const gn_context *context)
{
    uint64_t used = 0;
    uint8_t *base = (uint8_t *)first_map(context);
    (void)gn_take(base, &used, context->plan.map_bytes);
    return gn_take(base, &used, sizeof(kept));
}

static gn_status make_plan(gn_plan *plan, const gn_scene *scene, const gn_settings *settings)
{
    kept none;
    uint64_t models = 0;
    if (settings->static_objects > scene->object_count)
        return GN_OUT_OF_RANGE;
    if (settings->shadow == GN_SHADOW_VOLUMES)
        return GN_OK;
    if (settings->faces && gn_map_count(settings) == 1)
        return GN_UNSUPPORTED;
    for (uint32_t i = 0; i < settings->static_objects; i++)
        models += scene->objects[i].model != 0;
    uint64_t bytes = lay_out(0, &none, plan, settings) + models * sizeof(placing) - plan->map_bytes;
    if (bytes > SIZE_MAX - plan->map_bytes)
        return GN_TOO_MANY;
    plan->static_bytes = (size_t)bytes;
    return GN_OK;
}

/* ---- what it was drawn from -------------------------------------------------------------------------------------- */

static int same_row(const gn_row *a, const gn_row *b)
{
    return a->offset == b->offset && a->m[0] == b->m[0] && a->m[1] == b->m[1] && a->m[2] == b->m[2] &&
           a->shift == b->shift;
}

/* Of lights, on one map: all else follows from these and the map's size. */
static int same_view(const gn_view *a, const gn_view *b)
{
    int same = a->affine == b->affine && a->endless == b->endless && a->near_w == b->near_w && a->far_w == b->far_w;
    for (int i = 0; i < 3; i++)
        same &= same_row(&a->row[i], &b->row[i]);
    return same;
}

static int same_model(const gn_model *a, const gn_model *b)
{
    int same = a->shift == b->shift;
    for (int i = 0; i < 3; i++) {
        same &= a->t[i] == b->t[i];
        for (int j = 0; j < 3; j++)
            same &= a->m[i][j] == b->m[i][j];
    }
    return same;
}

/* Do the static objects stand as they were drawn? An object may have got a model, or lost it. */
static int stand_still(const gn_context *context, const kept *k)
{
    uint32_t count = 0;
    for (uint32_t i = 0; k->count != NOTHING && i < context->settings.static_objects; i++) {
        const gn_model *model = context->scene->objects[i].model;
        if (!model)
            continue;
        if (count >= k->count || k->placings[count].object != i || !same_model(&k->placings[count].model, model))
            return 0;
        count++;
    }
    return count == k->count;
}

/* Objects that have got a model since the plan was made may not have room: then nothing is the same the next time. */
static void note_models(const gn_context *context, kept *k)
{
    k->count = 0;
    for (uint32_t i = 0; i < context->settings.static_objects; i++) {
        const gn_model *model = context->scene->objects[i].model;
        if (!model)
            continue;
        if (k->count < k->room) {
            k->placings[k->count].object = i;
            k->placings[k->count].model = *model;
        }
        k->count++;
    }
    k->count = k->count > k->room ? NOTHING : k->count;
}

static uint32_t map_number(const gn_context *context)
{
    size_t texels = (size_t)context->settings.map_height * context->map_stride;
    return (uint32_t)((size_t)(context->map - first_map(context)) / texels);
}

static uint8_t *drawn_of(const gn_context *context, const kept *k)
{
    return k->drawn + map_number(context) * context->plan.light_regions;
}

static void forget(uint8_t *drawn, uint32_t regions)
{
    for (uint32_t i = 0; i < regions; i++)
        drawn[i] = 0;
}

static int all_drawn(const uint8_t *drawn, uint32_t regions)
{
    uint32_t count = 0;
    while (count < regions && drawn[count])
        count++;
    return count == regions;
}

/* ---- the light pass ---------------------------------------------------------------------------------------------- */

/* Transform some of the scene's objects alone. */
static gn_status transform(gn_context *context, uint32_t first, uint32_t end, int *inside)
{
    const gn_scene *whole = context->scene;
    gn_object_state *states = context->objects;
    gn_scene part = *whole;
    int32_t largest_w;
    *inside = GN_WELL_INSIDE;
    if (first == end)
        return GN_OK;
    part.objects += first;
    part.object_count = end - first;
    context->scene = &part;
    context->objects += first;
    gn_status status = gn_transform_scene(context, &context->light_view, &largest_w, inside);
    context->scene = whole;
    context->objects = states;
    return status;
}

/* Is what is kept of the latest map what would be drawn now? If not, forget it. */
static int check_kept(gn_context *context, kept *k)
{
    uint32_t regions = context->plan.light_regions, maps = gn_map_count(&context->settings);
    uint8_t *base = (uint8_t *)first_map(context);
    if (!context->keeps) {
        uint64_t used = lay_out(base, k, &context->plan, &context->settings);
        k->placings = (placing *)(void *)(base + (size_t)used);
        k->room = (uint32_t)((context->plan.map_bytes + context->plan.static_bytes - (size_t)used) / sizeof(placing));
        k->count = NOTHING;
        context->keeps = 1;
    }
    if (!stand_still(context, k)) {
        forget(k->drawn, maps * regions);
        for (uint32_t i = 0; i < maps; i++)
            k->maps[i].empty = 0;
        note_models(context, k);
    }
    kept_map *map = &k->maps[map_number(context)];
    uint8_t *drawn = drawn_of(context, k);
    if ((map->empty || all_drawn(drawn, regions)) && same_view(&map->view, &context->light_view) &&
        (!context->grid || context->fitting->seen == GN_SEEN_AND_KEPT))
        return 1;
    forget(drawn, regions);
    map->empty = 0;
    map->view = context->light_view;
    if (context->fitting)
        context->fitting->seen = GN_SEEN_AND_KEPT;
    return 0;
}

static gn_status begin(gn_context *context, int *inside)
{
    kept *k = find_kept(context);
    uint32_t count = context->settings.static_objects;
    int still = GN_WELL_INSIDE;
    gn_status status = GN_OK;
    k->reused = (uint8_t)check_kept(context, k);
    kept_map *map = &k->maps[map_number(context)];
    if (!k->reused || gn_find_drawing(&context->settings)) {
        status = transform(context, 0, count, &still);
        map->inside = (uint8_t)still;
    }
    if (status == GN_OK)
        status = transform(context, count, context->scene->object_count, inside);
    *inside = map->inside < *inside ? map->inside : *inside;
    return status;
}

/* Depths that are copied at once: in words, where a machine can, though they are aligned as depths are. */
enum { BLOCK = 16 };
typedef struct block {
    gn_depth depths[BLOCK];
} block;

static void copy(gn_depth *to, const gn_depth *from, size_t count)
{
    for (; count >= BLOCK; count -= BLOCK, to += BLOCK, from += BLOCK)
        *(block *)to = *(const block *)from;
    for (; count; count--)
        *to++ = *from++;
}

static void clear(gn_depth *layer, size_t count)
{
    for (size_t i = 0; i < count; i++)
        layer[i] = GN_FARTHEST;
}

/* Texels from the first map's first row to a row of the latest map. */
static size_t place_of(const gn_context *context, uint32_t row)
{
    return (size_t)(context->map - first_map(context)) + (size_t)row * context->map_stride;
}

static void start(gn_context *context, gn_layer_target *t, uint32_t row, uint32_t end)
{
    kept *k = find_kept(context);
    size_t from = place_of(context, row), count = (size_t)(end - row) * context->map_stride;
    gn_depth *to[2] = {context->map + (size_t)row * context->map_stride, t->second};
    int layers = t->second ? 2 : 1, empty = k->maps[map_number(context)].empty;
    for (int i = 0; i < layers; i++) {
        if (k->reused && !empty)
            copy(to[i], k->layer[i] + from, count);
        else
            clear(to[i], count);
    }
    if (!k->reused) {
        t->object_end = context->settings.static_objects;
        gn_draw_rows(context, t, row, end);
        for (int i = 0; i < layers; i++)
            copy(k->layer[i] + from, to[i], count);
        drawn_of(context, k)[row / context->plan.map_rows] = 1;
    }
    t->object = context->settings.static_objects;
    t->object_end = context->scene->object_count;
}

/* The marks of mixed surfaces stay: who asks for the row leaves out their bit. */
static void start_row(gn_context *context, gn_layer_target *t, uint32_t row)
{
    kept *k = find_kept(context);
    if (!k->reused)
        return;
    if (!k->maps[map_number(context)].empty)
        copy(t->first, k->layer[0] + place_of(context, row), context->map_stride);
    t->object = context->settings.static_objects;
}

static int reach(gn_context *context, gn_covers *covers)
{
    kept *k = find_kept(context);
    kept_map *map = &k->maps[map_number(context)];
    uint32_t count = context->settings.static_objects;
    if (!k->reused)
        map->empty = !covers(context, 0, count);
    return !map->empty || covers(context, count, context->scene->object_count);
}

const gn_casters gn_static_casters = {make_plan, begin, start, start_row, reach};
