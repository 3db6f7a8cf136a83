#include "gn_volume_count.h"

/* ---- spans ----------------------------------------------------------------------------------------------------- */

GN_INLINE void span_behind(const void *state, int32_t row, int32_t left, int32_t right)
{
    const gn_volume_target *t = state;
    uint16_t *count = t->count + ((row - t->row0) * t->stride + left - t->column0), *end = count + (right - left);
    GN_TALLY(t->tally->centres += (uint32_t)(right - left);)
    do
        *count = (uint16_t)(*count + t->weight);
    while (++count != end);
}

/* max(low, min(value, high)) < point */
GN_INLINE int is_behind(int64_t value, int64_t low, int64_t high, int64_t point)
{
    return low < point && (value < point || high < point);
}

GN_INLINE void span_compared(const void *state, int32_t row, int32_t left, int32_t right, unsigned shift)
{
    const gn_volume_target *t = state;
    int32_t at = (row - t->row0) * t->stride + left - t->column0, pixels = right - left;
    uint16_t *count = t->count + at;
    const int64_t *point = t->point + at;
    const uint32_t *triangle = t->triangle + at;
    int64_t dx = t->plane.dx, value = t->plane.base + row * t->plane.dy + left * dx, low = t->reach.low,
            high = t->reach.high;
    uint32_t weight = t->weight, own0 = t->own[0], own1 = t->own[1];
    GN_TALLY(t->tally->centres += (uint32_t)pixels;)
    for (int32_t i = 0; i < pixels; i++, value += dx)
        if (is_behind(value, low, high, gn_floor_shift_64(point[i], shift)) || triangle[i] == own0 ||
            triangle[i] == own1)
            count[i] = (uint16_t)(count[i] + weight);
}

GN_INLINE void span_plain(const void *state, int32_t row, int32_t left, int32_t right)
{
    span_compared(state, row, left, right, 0);
}

GN_INLINE void span_steep(const void *state, int32_t row, int32_t left, int32_t right)
{
    span_compared(state, row, left, right, ((const gn_volume_target *)state)->plane.shift);
}

GN_INLINE void span_beyond(const void *state, int32_t row, int32_t left, int32_t right)
{
    const gn_volume_target *t = state;
    int32_t at = (row - t->row0) * t->stride + left - t->column0;
    uint16_t *count = t->count + at;
    const uint32_t *triangle = t->triangle + at;
    int64_t value = t->plane.base + row * t->plane.dy + left * t->plane.dx;
    int64_t limit = gn_floor_shift_64(t->limit, t->plane.shift) + (t->plane.shift > 0);
    GN_TALLY(t->tally->centres += (uint32_t)(right - left);)
    for (int32_t i = 0; i < right - left; i++, value += t->plane.dx)
        if (is_behind(value, t->reach.low, t->reach.high, limit) || triangle[i] == t->own[0])
            count[i] = (uint16_t)(count[i] + t->weight);
}

/* ---- faces ----------------------------------------------------------------------------------------------------- */

static GN_NOINLINE void walk_face(const gn_volume_target *t, const gn_rows *rows, const gn_window *window,
                                  gn_depth_rule by)
{
    if (by == GN_BEHIND)
        gn_walk(rows, window, rows->cut, span_behind, t);
    else if (by == GN_BEYOND)
        gn_walk(rows, window, rows->cut, span_beyond, t);
    else if (t->plane.shift == 0)
        gn_walk(rows, window, rows->cut, span_plain, t);
    else
        gn_walk(rows, window, rows->cut, span_steep, t);
}

void gn_count_piece(gn_volume_target *t, const gn_vertex *v0, const gn_vertex *v1, const gn_vertex *v2, int32_t winding,
                    const gn_window *window, gn_depth_rule by)
{
    gn_rows rows;
    int64_t area = gn_area(v0, v1, v2);
    if (area == 0 || !gn_find_rows(&rows, v0, area > 0 ? v1 : v2, area > 0 ? v2 : v1, window))
        return;
    t->weight = (uint32_t)(area > 0 ? winding : -winding);
    walk_face(t, &rows, window, by);
    GN_TALLY(t->tally->triangles++;)
}

void gn_count_outline(gn_volume_target *t, const gn_outline *o, int32_t winding, const gn_window *window,
                      gn_depth_rule by)
{
    for (int32_t i = 1; i + 1 < o->count; i++)
        gn_count_piece(t, &o->v[0], &o->v[i], &o->v[i + 1], winding, window, by);
}

void gn_set_plane(gn_volume_target *t, const gn_eye *eye, const int64_t n[3], gn_wide distance, const gn_reach *reach)
{
    gn_make_nearness(&t->plane, eye, n, distance);
    t->reach.low = gn_floor_shift_64(reach->low, t->plane.shift);
    t->reach.high = gn_floor_shift_64(reach->high, t->plane.shift);
}
