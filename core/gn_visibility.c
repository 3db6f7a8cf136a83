/* Visibility: for each pixel of a region the nearest triangle and its Q.
 *
 * Q is about 1/w, affine over a triangle and greater where nearer: it is the depth buffer itself, and all that shading
 * needs to find the point in space (gn_shade.c). The greater Q wins; at equal Q the lower triangle identifier: the
 * result does not depend on the order in which a region meets its triangles.
 *
 * A region looks only at the triangles in its bins (gn_bins.c). Memory: 8 bytes a pixel of the region and worker. */
#include "gn_bins.h"
#include "gn_clip.h"
#include "gn_tally.h"

typedef struct target {
    uint32_t *q, *triangle; /* of the region's first row */
    int32_t stride, row0, column0;
    gn_q_plane plane;
    uint32_t identifier;
#if GN_VECTOR
    gn_u64x8 lanes; /* the plane's step to each of 8 pixels */
#endif
    GN_TALLY(gn_tally *tally;)
} target;

#if GN_VECTOR
/* Draw 8 pixels but those whose lane in keep is all ones. */
GN_INLINE void draw_lanes(const target *t, int32_t at, gn_u64x8 value, gn_u32x8 keep)
{
    gn_u32x8 *q = (gn_u32x8 *)(void *)(t->q + at), *triangle = (gn_u32x8 *)(void *)(t->triangle + at);
    gn_u32x8 nearness = __builtin_convertvector(value >> 32, gn_u32x8), old = *q, other = *triangle;
    gn_u32x8 wins = (gn_u32x8)(nearness > old) | ((gn_u32x8)(nearness == old) & (gn_u32x8)(t->identifier < other));
    wins &= ~keep;
    *q = (nearness & wins) | (old & ~wins);
    *triangle = (t->identifier & wins) | (other & ~wins);
}

GN_INLINE uint64_t start_value(const target *t, int32_t row, int32_t left)
{
    return t->plane.base + (uint64_t)(uint32_t)row * t->plane.dy + (uint64_t)(uint32_t)left * t->plane.dx;
}

/* 8 pixels at a time, beginning at the left end. */
GN_INLINE void span_visible(const void *state, int32_t row, int32_t left, int32_t right)
{
    static const gn_u32x8 lane = {0, 1, 2, 3, 4, 5, 6, 7};
    const target *t = state;
    int32_t at = (row - t->row0) * t->stride + left - t->column0, count = right - left;
    GN_TALLY(t->tally->centres += (uint32_t)count;)
    gn_u64x8 value = t->lanes + start_value(t, row, left);
    gn_u32x8 none = {0};
    for (; count >= 8; count -= 8, at += 8, value += t->plane.dx * 8)
        draw_lanes(t, at, value, none);
    if (count)
        draw_lanes(t, at, value, (gn_u32x8)(lane >= (uint32_t)count));
}

GN_INLINE void tiny_visible(const void *state, int32_t row, int32_t column, gn_i32x8 outside)
{
    const target *t = state;
    int32_t at = (row - t->row0) * t->stride + column - t->column0;
    GN_TALLY(t->tally->lanes_8 -= outside >= 0;)
    draw_lanes(t, at, t->lanes + start_value(t, row, column), (gn_u32x8)(outside < 0));
}
#else
GN_INLINE void span_visible(const void *state, int32_t row, int32_t left, int32_t right)
{
    const target *t = state;
    int32_t at = (row - t->row0) * t->stride + left - t->column0;
    GN_TALLY(t->tally->centres += (uint32_t)(right - left);)
    uint32_t *q = t->q + at, *triangle = t->triangle + at, *end = q + (right - left), identifier = t->identifier;
    uint64_t value = t->plane.base + (uint64_t)(uint32_t)row * t->plane.dy + (uint64_t)(uint32_t)left * t->plane.dx;
    uint64_t dx = t->plane.dx;
    do {
        uint32_t nearness = (uint32_t)(value >> 32);
        if (nearness >= *q && (nearness > *q || identifier < *triangle)) {
            *q = nearness;
            *triangle = identifier;
        }
        value += dx;
        triangle++;
    } while (++q != end);
}
#endif

static GN_NOINLINE void walk_visible(const target *t, const gn_rows *rows, const gn_window *window)
{
#if GN_VECTOR
    if (gn_walk_tiny_8(rows, window, tiny_visible, t))
        return;
#endif
    gn_walk(rows, window, rows->cut, span_visible, t);
}

/* Draw a triangle whose plane is set. */
static void draw(target *t, const gn_rows *rows, const gn_window *window)
{
#if GN_VECTOR
    static const gn_u64x8 lane = {0, 1, 2, 3, 4, 5, 6, 7};
    t->lanes = lane * t->plane.dx;
#endif
    walk_visible(t, rows, window);
    GN_TALLY(t->tally->triangles++;)
}

static GN_COLD void draw_clipped(const gn_context *context, target *t, const gn_object *object, uint32_t triangle,
                                 const gn_window *window)
{
    gn_place corner[3];
    gn_polygon polygon;
    gn_rows rows;
    gn_triangle_places(&context->camera_view, object, triangle, corner);
    gn_clip_triangle(&polygon, &context->camera_view, corner);
    if (polygon.area == 0)
        return;
    const gn_vertex *v = polygon.v;
    const gn_vertex *r1 = &v[polygon.reference], *r2 = r1 + 1;
    gn_make_q_plane(&t->plane, &v[0], polygon.area > 0 ? r1 : r2, polygon.area > 0 ? r2 : r1, polygon.area);
    gn_fit_q_plane(&t->plane, &polygon, context->shading.nothing + 1);
    for (int32_t i = 1; i + 1 < polygon.count; i++)
        if (gn_find_piece(&rows, &polygon, i, window))
            draw(t, &rows, window);
}

static void draw_triangle(const gn_context *context, target *t, uint32_t object_index, uint32_t triangle,
                          const gn_window *window)
{
    const gn_object *object = &context->scene->objects[object_index];
    const gn_object_state *state = &context->objects[object_index];
    const gn_vertex *vertices = context->vertices + state->first_vertex;
    uint32_t index[3];
    gn_triangle_indices(object->mesh, triangle, index);
    const gn_vertex *v0 = vertices + index[0], *v1 = vertices + index[1], *v2 = vertices + index[2];
    t->identifier = object_index << context->triangle_bits | triangle;
    if (state->clips && (v0->depth == 0 || v1->depth == 0 || v2->depth == 0)) {
        draw_clipped(context, t, object, triangle, window);
        return;
    }
    gn_rows rows;
    int64_t area = gn_area(v0, v1, v2);
    if (area < 0) {
        const gn_vertex *v = v1;
        v1 = v2;
        v2 = v;
    }
    if (area == 0 || !gn_find_rows(&rows, v0, v1, v2, window))
        return;
    gn_make_q_plane(&t->plane, v0, v1, v2, area);
    draw(t, &rows, window);
}

static void clear(uint32_t *plane, uint32_t count, uint32_t value)
{
    for (; count >= 4; count -= 4, plane += 4)
        plane[0] = plane[1] = plane[2] = plane[3] = value;
    while (count--)
        *plane++ = value;
}

typedef struct visitor {
    const gn_context *context;
    const gn_window *window;
    target *t;
} visitor;

GN_INLINE void visit(void *state, uint32_t object, uint32_t triangle)
{
    const visitor *v = state;
    draw_triangle(v->context, v->t, object, triangle, v->window);
}

void gn_rasterise_region(gn_context *context, gn_worker *worker, const gn_window *window)
{
    target t;
    t.q = worker->q;
    t.triangle = worker->triangle;
    t.stride = window->column1 - window->column0;
    t.row0 = window->row0;
    t.column0 = window->column0;
    uint32_t count = (uint32_t)(t.stride * (window->row1 - window->row0));
    clear(t.q, count, context->shading.nothing);
    clear(t.triangle, count, GN_NO_TRIANGLE);
    GN_TALLY(gn_tally tally = {0}; t.tally = &tally;)
    visitor v = {context, window, &t};
    gn_visit_region(context, window, visit, &v);
    GN_TALLY(worker->statistics.camera_triangles += tally.triangles;)
    GN_TALLY(worker->statistics.camera_fragments += gn_tally_centres(&tally);)
}
