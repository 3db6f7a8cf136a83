/* The light pass: nearest and second nearest depth a texel, in one walk, then one virtual surface.
 *
 * z1 and z2 are the two smallest depths of all triangles that cover the texel's centre, as a multiset: equal depths
 * count twice. Both are minima, so the layers do not depend on the order of triangles, on regions or on workers.
 *     h = max(z1, v);  z1 = min(z1, v);  z2 = min(z2, h)
 * Culling follows from the mark of the mesh alone: closed meshes may lose their back or front faces, open ones never.
 * For second depth a triangle of an open mesh is inserted twice: a solid of zero thickness (Wang & Molnar 1994, 3.3).
 * For mixed the lowest bit of a depth marks it as open, so at equal depth the closed one is the nearer.
 * For slope the second layer is an accumulator, the least v + h: h is what the triangle rises within half a texel.
 *
 * An empty layer holds the largest value. Cost: a texel 8 instructions on a Cortex-M4, two layers 14 at most.
 * Memory: map, 12 bytes a vertex, the second layer of one region a worker. */
#include "gn_cascade.h"
#include "gn_clip.h"
#include "gn_drawing.h"
#include "gn_layers.h"
#include "gn_parameterisation.h"

/* ---- spans ----------------------------------------------------------------------------------------------------- */

/* A triangle that is too steep for 32 bits covers few texels: one by one, and any way of insertion. */
static GN_COLD void insert_steep_span(const gn_layer_target *t, int32_t row, int32_t left, int32_t right)
{
    int64_t depth = gn_wide_depth(&t->steep_plane, left, row);
    for (int32_t at = row * t->stride + left; left < right; left++, at++, depth += t->steep_plane.dx) {
        uint32_t z = gn_saturate(depth);
        gn_depth *z1 = t->first + at, v = gn_cut_layer(z, t->how, t->open), old = *z1;
        gn_insert_first(z1, v);
        if (t->how == GN_INSERT_FIRST)
            continue;
        if (t->how == GN_INSERT_RISING)
            v = gn_cut_layer(gn_risen(z, t->rise), t->how, t->open);
        else if (t->how != GN_INSERT_TWICE && v < old)
            v = old;
        gn_insert_first(t->second + (at - t->second_offset), v);
    }
}

#if !GN_VECTOR_16
GN_INLINE void insert_span(const gn_layer_target *t, int32_t at, int32_t count, uint32_t z, gn_insertion how)
{
    gn_depth *z1 = t->first + at, *end = z1 + count;
    uint32_t dx = t->plane.dx, open = t->open, rise = t->rise;
    if (how == GN_INSERT_FIRST) {
        do {
            gn_insert_first(z1, gn_cut_layer(z, how, open));
            z += dx;
        } while (++z1 != end);
        return;
    }
    gn_depth *z2 = t->second + (at - t->second_offset);
    do {
        gn_depth v = gn_cut_layer(z, how, open);
        if (how == GN_INSERT_RISING) {
            gn_insert_first(z1, v);
            gn_insert_first(z2, gn_cut_layer(gn_risen(z, rise), how, open));
        } else if (how == GN_INSERT_TWICE) {
            gn_insert_twice(z1, z2, v);
        } else {
            gn_insert_two(z1, z2, v);
        }
        z1++;
        z2++;
        z += dx;
    } while (z1 != end);
}
#else
/* min(a, b) of 16 lanes. */
GN_INLINE gn_depthx16 nearer(gn_depthx16 a, gn_depthx16 b)
{
    gn_depthx16 less = (gn_depthx16)(a < b);
    return (a & less) | (b & ~less);
}

GN_INLINE gn_depthx16 farther(gn_depthx16 a, gn_depthx16 b)
{
    gn_depthx16 less = (gn_depthx16)(a < b);
    return (b & less) | (a & ~less);
}

GN_INLINE gn_depthx16 cut_lanes(gn_u32x16 z)
{
#if GN_DEPTH_BITS == 16
    return __builtin_convertvector(z >> 16, gn_u16x16);
#else
    return z;
#endif
}

/* Insert 16 depths; lanes that are all ones in far insert the farthest depth, which changes nothing. */
GN_INLINE void insert_lanes(const gn_layer_target *t, int32_t at, gn_u32x16 depth, gn_depthx16 far, gn_insertion how)
{
    gn_depthx16 v = cut_lanes(depth);
    if (how == GN_INSERT_MARKED)
        v = (v & (gn_depth)~1u) | (gn_depth)t->open;
    v |= far;
    gn_depthx16 *first = (gn_depthx16 *)(void *)(t->first + at), old = *first;
    *first = nearer(v, old);
    if (how == GN_INSERT_RISING) {
        gn_depthx16 *least = (gn_depthx16 *)(void *)(t->second + (at - t->second_offset));
        gn_u32x16 sum = depth + t->rise;
        *least = nearer(*least, cut_lanes(sum | (gn_u32x16)(sum < t->rise)) | far);
    } else if (how != GN_INSERT_FIRST) {
        gn_depthx16 *second = (gn_depthx16 *)(void *)(t->second + (at - t->second_offset));
        *second = nearer(*second, how == GN_INSERT_TWICE ? v : farther(v, old));
    }
}

/* 16 texels at a time, beginning at the left end. */
GN_INLINE void insert_span(const gn_layer_target *t, int32_t at, int32_t count, uint32_t z, gn_insertion how)
{
    static const gn_depthx16 lane = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};
    gn_u32x16 depth = t->lanes + z;
    gn_depthx16 all = {0};
    for (; count >= 16; count -= 16, at += 16, depth += t->plane.dx * 16)
        insert_lanes(t, at, depth, all, how);
    if (count)
        insert_lanes(t, at, depth, (gn_depthx16)(lane >= (gn_depth)count), how);
}
#endif

#define SPAN(name, how)                                                                                                \
    GN_INLINE void name(const void *state, int32_t row, int32_t left, int32_t right)                                   \
    {                                                                                                                  \
        const gn_layer_target *t = state;                                                                              \
        GN_TALLY(t->tally->centres += (uint32_t)(right - left);)                                                       \
        insert_span(t, row * t->stride + left, right - left, gn_start_depth(t, row, left), how);                       \
    }
SPAN(span_first, GN_INSERT_FIRST)

#if GN_VECTOR_16
GN_INLINE void span_steep(const void *state, int32_t row, int32_t left, int32_t right)
{
    const gn_layer_target *t = state;
    GN_TALLY(t->tally->centres += (uint32_t)(right - left);)
    insert_steep_span(t, row, left, right);
}
SPAN(span_two, GN_INSERT_TWO)
SPAN(span_twice, GN_INSERT_TWICE)
SPAN(span_marked, GN_INSERT_MARKED)
SPAN(span_rising, GN_INSERT_RISING)

#define TINY(name, how)                                                                                                \
    GN_INLINE void name(const void *state, int32_t row, int32_t column, gn_i32x16 outside)                             \
    {                                                                                                                  \
        const gn_layer_target *t = state;                                                                              \
        GN_TALLY(t->tally->lanes_16 -= outside >= 0;)                                                                  \
        gn_depthx16 far = cut_lanes((gn_u32x16)(outside < 0));                                                         \
        insert_lanes(t, row * t->stride + column, t->lanes + gn_start_depth(t, row, column), far, how);                \
    }
TINY(tiny_first, GN_INSERT_FIRST)
TINY(tiny_two, GN_INSERT_TWO)
TINY(tiny_twice, GN_INSERT_TWICE)
TINY(tiny_marked, GN_INSERT_MARKED)
TINY(tiny_rising, GN_INSERT_RISING)
#else
/* Flash before time: all ways of insertion share one walk, and choose by span; only the first layer has one of its own.
 */
GN_INLINE void span_any(const void *state, int32_t row, int32_t left, int32_t right)
{
    const gn_layer_target *t = state;
    int32_t at = row * t->stride + left, count = right - left;
    uint32_t z = gn_start_depth(t, row, left);
    GN_TALLY(t->tally->centres += (uint32_t)count;)
    if (GN_UNLIKELY(t->steep))
        insert_steep_span(t, row, left, right);
    else if (t->how == GN_INSERT_FIRST)
        insert_span(t, at, count, z, GN_INSERT_FIRST);
    else if (t->how == GN_INSERT_TWO)
        insert_span(t, at, count, z, GN_INSERT_TWO);
    else if (t->how == GN_INSERT_TWICE)
        insert_span(t, at, count, z, GN_INSERT_TWICE);
    else if (t->how == GN_INSERT_MARKED)
        insert_span(t, at, count, z, GN_INSERT_MARKED);
    else
        insert_span(t, at, count, z, GN_INSERT_RISING);
}
#endif

/* ---- triangles ------------------------------------------------------------------------------------------------- */

#if GN_VECTOR_16
#define WALK(name, span, tiny)                                                                                         \
    static GN_NOINLINE void name(const gn_layer_target *t, const gn_rows *rows, const gn_window *window)               \
    {                                                                                                                  \
        if (!gn_walk_tiny_16(rows, window, tiny, t))                                                                   \
            gn_walk(rows, window, rows->cut, span, t);                                                                 \
    }
WALK(walk_first, span_first, tiny_first)
WALK(walk_two, span_two, tiny_two)
WALK(walk_twice, span_twice, tiny_twice)
WALK(walk_marked, span_marked, tiny_marked)
WALK(walk_rising, span_rising, tiny_rising)

static void walk_any(const gn_layer_target *t, const gn_rows *rows, const gn_window *window)
{
    if (t->steep)
        gn_walk(rows, window, rows->cut, span_steep, t);
    else if (t->how == GN_INSERT_TWO)
        walk_two(t, rows, window);
    else if (t->how == GN_INSERT_TWICE)
        walk_twice(t, rows, window);
    else if (t->how == GN_INSERT_MARKED)
        walk_marked(t, rows, window);
    else
        walk_rising(t, rows, window);
}
#else
static GN_NOINLINE void walk_any(const gn_layer_target *t, const gn_rows *rows, const gn_window *window)
{
    gn_walk(rows, window, rows->cut, span_any, t);
}

static GN_NOINLINE void walk_first(const gn_layer_target *t, const gn_rows *rows, const gn_window *window)
{
    if (GN_UNLIKELY(rows->cut))
        walk_any(t, rows, window);
    else
        gn_walk(rows, window, 0, span_first, t);
}
#endif

/* Which orientation is left out: 1 clockwise on the map (back faces), -1 counter-clockwise (front), 0 none. */
static int culled_sign(const gn_context *context, uint32_t object)
{
    if (!context->scene->objects[object].mesh->closed || context->plan.cull == GN_CULL_NONE)
        return 0;
    int sign = context->plan.cull == GN_CULL_BACK ? 1 : -1;
    return context->objects[object].mirrored ? -sign : sign;
}

static gn_insertion choose_insertion(const gn_context *context, const gn_mesh *mesh)
{
    if (context->settings.surface == GN_SLOPE)
        return GN_INSERT_RISING;
    if (context->settings.surface == GN_MIXED)
        return GN_INSERT_MARKED;
    return context->settings.surface == GN_SECOND && !mesh->closed ? GN_INSERT_TWICE : GN_INSERT_TWO;
}

static void set_lanes(gn_layer_target *t)
{
#if GN_VECTOR_16
    static const gn_u32x16 lane = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};
    t->lanes = lane * t->plane.dx;
#else
    (void)t;
#endif
}

/* One clockwise triangle whose plane is set. */
GN_INLINE void insert(gn_layer_target *t, const gn_rows *rows, const gn_window *window)
{
    if (GN_UNLIKELY(t->grid != 0)) {
        t->grid->walk(t, rows);
    } else if (t->how == GN_INSERT_FIRST) {
        walk_first(t, rows, window);
    } else {
        if (t->how == GN_INSERT_RISING)
            t->rise = (uint32_t)gn_rise((int32_t)t->plane.dx, (int32_t)t->plane.dy);
        walk_any(t, rows, window);
    }
    GN_TALLY(t->tally->triangles++;)
}

/* One whose plane is too steep for 32 bits. */
static GN_COLD void insert_steep(gn_layer_target *t, const gn_mesh *mesh, const gn_vertex *vertices, uint32_t triangle,
                                 const gn_rows *rows, const gn_window *window)
{
    uint32_t index[3];
    gn_triangle_indices(mesh, triangle, index);
    const gn_vertex *v0 = vertices + index[0], *v1 = vertices + index[1], *v2 = vertices + index[2];
    int64_t area = gn_area(v0, v1, v2);
    (void)gn_make_steep_plane(&t->steep_plane, v0, area > 0 ? v1 : v2, area > 0 ? v2 : v1, area);
    t->rise = gn_saturate(gn_rise(t->steep_plane.dx, t->steep_plane.dy));
    t->steep = 1;
    set_lanes(t);
    if (t->grid)
        t->grid->walk(t, rows);
    else
        walk_any(t, rows, window);
    t->steep = 0;
    GN_TALLY(t->tally->triangles++;)
}

/* A triangle with a corner beyond the planes or the guard band. */
static GN_COLD void insert_clipped(const gn_context *context, gn_layer_target *t, const gn_object *object,
                                   uint32_t triangle, int culled, const gn_window *window)
{
    gn_place corner[3];
    gn_polygon polygon;
    gn_rows rows;
    if (context->insert_clamped) {
        context->insert_clamped(context, t, object, triangle, culled, window);
        return;
    }
    gn_triangle_places(&context->light_view, object, triangle, corner);
    gn_clip_triangle(&polygon, &context->light_view, corner);
    if (polygon.area == 0 || (polygon.area > 0 ? 1 : -1) == culled)
        return;
    gn_make_clipped_plane(&t->plane, &polygon);
    set_lanes(t);
    for (int32_t i = 1; i + 1 < polygon.count; i++)
        if (gn_find_piece(&rows, &polygon, i, window))
            insert(t, &rows, window);
}

static void insert_mesh(const gn_context *context, gn_layer_target *t, uint32_t object_index, const gn_window *window)
{
    const gn_object *object = &context->scene->objects[object_index];
    const gn_mesh *mesh = object->mesh;
    const gn_vertex *vertices = context->vertices + context->objects[object_index].first_vertex;
    int culled = culled_sign(context, object_index), clips = context->objects[object_index].clips;
    uint32_t count = mesh->triangle_count, flip = culled > 0 ? 0 : 0x80000000u;
    t->how = t->second ? choose_insertion(context, mesh) : GN_INSERT_FIRST;
    for (uint32_t i = 0; i < count; i++) {
        uint32_t index[3];
        gn_triangle_indices(mesh, i, index);
        const gn_vertex *v0 = vertices + index[0], *v1 = vertices + index[1], *v2 = vertices + index[2];
        if (clips && (v0->depth == 0 || v1->depth == 0 || v2->depth == 0)) {
            insert_clipped(context, t, object, i, culled, window);
            continue;
        }
        int64_t area = gn_area(v0, v1, v2);
        /* the usual reject, by the sign alone: areas of the culled sign (and 0, where that is positive) */
        if (culled && (int32_t)((uint32_t)((uint64_t)area >> 32) ^ flip) >= 0)
            continue;
        if (area == 0)
            continue;
        if (area < 0) {
            const gn_vertex *v = v1;
            v1 = v2;
            v2 = v;
        }
        gn_rows rows;
        if (!gn_find_rows(&rows, v0, v1, v2, window))
            continue;
        if (GN_UNLIKELY(gn_make_depth_plane(&t->plane, v0, v1, v2, area))) {
            insert_steep(t, mesh, vertices, i, &rows, window);
            continue;
        }
        set_lanes(t);
        insert(t, &rows, window);
    }
}

/* ---- resolve --------------------------------------------------------------------------------------------------- */

GN_INLINE gn_depth add_saturated(gn_depth z, uint64_t bias)
{
    uint32_t room = GN_FARTHEST - (uint32_t)z;
    return room < bias ? GN_FARTHEST : (gn_depth)(z + bias);
}

/* z1 + min((z2 - z1) / 2, bias): Weiskopf & Ertl, eq. 2; with the largest bias: the midpoint. z2 >= z1. */
GN_INLINE gn_depth dual(gn_depth z1, gn_depth z2, gn_depth bias)
{
    gn_depth half = (gn_depth)((gn_depth)(z2 - z1) >> 1);
    return (gn_depth)(z1 + (half < bias ? half : bias));
}

gn_status gn_light_resolve(gn_context *context, uint32_t region, uint32_t worker)
{
    uint32_t first_row, rows, stride;
    if (!gn_layer(context, 0, region, worker, &first_row, &rows, &stride))
        return GN_BAD_ARGUMENT;
    if (context->phase != GN_PHASE_LIGHT || context->progress[region] != GN_REGION_LAYERS)
        return GN_NOT_READY;
    gn_depth *z1 = context->map + (size_t)first_row * stride;
    const gn_depth *z2 = context->workers[worker].second;
    size_t count = (size_t)rows * stride;
    gn_depth bias = (gn_depth)(context->bias >> GN_DEPTH_SHIFT);
    switch (context->settings.surface) {
    case GN_CONSTANT:
    case GN_SECOND:
        z2 = context->plan.layers == GN_LAYERS_TWO ? z2 : z1;
        for (size_t i = 0; (bias || z2 != z1) && i < count; i++)
            z1[i] = add_saturated(z2[i], bias);
        break;
    case GN_MIDPOINT:
        bias = GN_FARTHEST;
        /* fall through */
    case GN_DUAL:
        for (size_t i = 0; i < count; i++)
            z1[i] = dual(z1[i], z2[i], bias);
        break;
    case GN_SLOPE: /* z2 is the accumulator */
        for (size_t i = 0; i < count; i++) {
            uint64_t rise = gn_multiply_u((uint32_t)z2[i] - z1[i], (uint32_t)context->settings.slope) >> 16;
            z1[i] = add_saturated(z1[i], rise + bias);
        }
        break;
    default: /* GN_MIXED: an empty texel holds the largest value, whose lowest bit is set; dual keeps it. A second depth
              * gets the bit back that its mark took: what lies in its own unit is lit, as with the other surfaces */
        for (size_t i = 0; i < count; i++)
            z1[i] = z1[i] & 1 ? dual(z1[i], z2[i], bias) : (gn_depth)(z2[i] | 1);
    }
    context->progress[region] = GN_REGION_DONE;
    return GN_OK;
}

/* ---- the pass -------------------------------------------------------------------------------------------------- */

gn_status gn_light_begin(gn_context *context, const gn_light *light)
{
    if (!context || !light)
        return GN_BAD_ARGUMENT;
    if (context->volumes)
        return GN_UNSUPPORTED;
    context->phase = GN_PHASE_NONE;
    context->point_light = 0;
    gn_lay_out_light(context, &context->plan, &context->settings);
    context->light = *light;
    context->texels_across = (uint32_t)context->settings.map_width << 8;
    context->texels_down = (uint32_t)context->settings.map_height << 8;
    gn_status status = context->fitting ? context->fitting->make_view(context)
                                        : gn_make_light_view(&context->light_view, light, context->settings.map_width,
                                                             context->settings.map_height);
    const gn_casters *casters = context->settings.casters;
    int32_t largest_w;
    int inside;
    if (status == GN_OK)
        status = casters ? casters->begin(context, &inside)
                         : gn_transform_scene(context, &context->light_view, &largest_w, &inside);
    if (status != GN_OK)
        return status;
    context->light_trusted = (uint8_t)(light->kind == GN_DIRECTIONAL ? inside : GN_NOT_INSIDE);
    const gn_drawing *drawing = gn_find_drawing(&context->settings);
    if (drawing)
        status = drawing->begin(context);
    if (status != GN_OK)
        return status;
    context->bias = gn_make_bias(context, &context->settings.bias);
    context->tan_squared = (uint32_t)(gn_multiply_u(light->tan_half, light->tan_half) >> 29);
    for (uint32_t i = 0; i < context->plan.light_regions; i++)
        context->progress[i] = GN_REGION_UNTOUCHED;
    context->phase = GN_PHASE_LIGHT;
    return GN_OK;
}

static void clear(gn_depth *layer, size_t count)
{
    for (size_t i = 0; i < count; i++)
        layer[i] = GN_FARTHEST;
}

GN_NOINLINE void gn_draw_rows(const gn_context *context, gn_layer_target *t, uint32_t row, uint32_t end)
{
    gn_window window = {0, (int32_t)row, context->settings.map_width, (int32_t)end};
    t->steep = 0;
    t->grid = context->grid;
    if (t->grid)
        t->grid->aim(t, &window);
    for (uint32_t i = t->object; i < t->object_end; i++) {
        t->open = !context->scene->objects[i].mesh->closed;
        insert_mesh(context, t, i, &window);
    }
}

#if GN_STATISTICS
static void add_tally(gn_worker *worker, const gn_tally *tally)
{
    worker->statistics.light_triangles += tally->triangles;
    worker->statistics.light_texels += gn_tally_centres(tally);
}
#endif

gn_status gn_light_layers(gn_context *context, uint32_t region, uint32_t worker)
{
    uint32_t first_row, rows, stride;
    if (!gn_layer(context, 0, region, worker, &first_row, &rows, &stride))
        return GN_BAD_ARGUMENT;
    if (context->phase != GN_PHASE_LIGHT)
        return GN_NOT_READY;
    gn_worker *w = &context->workers[worker];
    gn_layer_target t;
    t.first = context->map;
    t.second = w->second;
    t.second_offset = (int32_t)(first_row * stride);
    t.stride = (int32_t)stride;
    t.object = 0;
    t.object_end = context->scene->object_count;
    GN_TALLY(gn_tally tally = {0}; t.tally = &tally;)
    const gn_casters *casters = context->settings.casters;
    if (casters) {
        casters->start(context, &t, first_row, first_row + rows);
    } else {
        clear(context->map + (size_t)first_row * stride, (size_t)rows * stride);
        if (t.second)
            clear(t.second, (size_t)rows * stride);
    }
    gn_draw_rows(context, &t, first_row, first_row + rows);
    GN_TALLY(add_tally(w, &tally);)
    const gn_drawing *drawing = gn_find_drawing(&context->settings);
    if (drawing)
        drawing->draw(context, region, worker);
    context->progress[region] = GN_REGION_LAYERS;
    return GN_OK;
}

void gn_nearest_row(gn_context *context, uint32_t worker, int32_t row, gn_depth *depths)
{
    gn_layer_target t;
    t.first = depths;
    t.second = 0;
    t.second_offset = 0;
    t.stride = 0; /* all rows are one */
    t.object = 0;
    t.object_end = context->scene->object_count;
    clear(depths, context->map_stride);
    GN_TALLY(gn_tally tally = {0}; t.tally = &tally;)
    const gn_casters *casters = context->settings.casters;
    if (casters)
        casters->start_row(context, &t, (uint32_t)row);
    gn_draw_rows(context, &t, (uint32_t)row, (uint32_t)row + 1);
    (void)worker;
    GN_TALLY(add_tally(&context->workers[worker], &tally);)
}

const gn_depth *gn_layer(const gn_context *context, uint32_t layer, uint32_t region, uint32_t worker,
                         uint32_t *first_row, uint32_t *rows, uint32_t *stride)
{
    if (!context || region >= context->plan.light_regions || worker >= context->settings.workers || layer > 1 ||
        (layer == 1 && !gn_has_second(&context->plan, &context->settings)))
        return 0;
    uint32_t first = region * context->plan.map_rows, height = context->settings.map_height;
    *first_row = first;
    *rows = first + context->plan.map_rows > height ? height - first : context->plan.map_rows;
    *stride = context->map_stride;
    return layer ? context->workers[worker].second : context->map + (size_t)first * *stride;
}

gn_status gn_light_pass(gn_context *context, const gn_light *light)
{
    gn_status status = gn_light_begin(context, light);
    for (uint32_t i = 0; status == GN_OK && i < context->plan.light_regions; i++) {
        status = gn_light_layers(context, i, 0);
        if (status == GN_OK)
            status = gn_light_resolve(context, i, 0);
    }
    return status;
}
