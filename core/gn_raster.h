/* Raster: a triangle as three edges and linear expressions, and one walk over its spans for both passes.
 *
 * In the manner of PixelFlow everything on a triangle is a linear expression A x + B y + C, stepped by forward
 * differences. Coordinates count 1/256 pixel; the centre of column i lies at 256 i + 128; y points down. A span holds
 * the columns [left, right) whose centres lie between two edges, with the same ceiling at both ends, and a triangle
 * the rows [top, bottom) by the same rule: that is the top-left rule, and a shared edge, always evaluated from its
 * upper vertex, gives each centre to exactly one side. Formats, bounds: docs/number-formats.md.
 *
 * Cost: two 32-bit divisions an edge, one wide division a triangle. Not here: clipping (gn_clip.h), what a span does
 * (gn_light_pass.c, gn_visibility.c). */
#ifndef GN_RASTER_H
#define GN_RASTER_H

#include "gn_fixed.h"
#include "gn_vector.h"

/* A projected vertex. |x|, |y| < 2^21. depth: light pass: Z, 31 bits; camera pass: Q, 30 bits, greater is nearer;
 * 0: the vertex cannot be projected and its triangles must be clipped. */
typedef struct gn_vertex {
    int32_t x, y;
    uint32_t depth;
} gn_vertex;

/* The rows and columns that may be written: [row0, row1) x [column0, column1). */
typedef struct gn_window {
    int32_t column0, row0, column1, row1;
} gn_window;

/* First row (or column) whose centre is at or beyond v. */
GN_INLINE int32_t gn_first_centre(int32_t v)
{
    return gn_floor_shift(v + 127, 8);
}

/* Twice the area, in 1/256 pixel squared: positive where v0, v1, v2 run clockwise on the screen. |A| < 2^43. */
GN_INLINE int64_t gn_area(const gn_vertex *v0, const gn_vertex *v1, const gn_vertex *v2)
{
    return gn_multiply(v1->x - v0->x, v2->y - v0->y) + gn_multiply(v0->x - v2->x, v1->y - v0->y);
}

/* ---- linear expressions ---------------------------------------------------------------------------------------- */

/* Depth in the light pass, modulo 2^32: z(i, j) = base + i dx + j dy, twice the vertices' Z. */
typedef struct gn_depth_plane {
    uint32_t base, dx, dy;
} gn_depth_plane;

/* The same in 64 bits, without wrapping: for planes that are too steep for 32, and beyond a plane's triangle. */
typedef struct gn_wide_plane {
    int64_t base, dx, dy;
} gn_wide_plane;

/* Its value at a texel, held within the range of depths. */
GN_INLINE uint32_t gn_saturate(int64_t z)
{
    return (uint32_t)((uint64_t)z >> 32) == 0 ? (uint32_t)z : z < 0 ? 0 : 0xffffffffu;
}

/* Modulo 2^64: the value fits, a base far from it need not. */
GN_INLINE int64_t gn_wide_depth(const gn_wide_plane *plane, int32_t column, int32_t row)
{
    return (int64_t)((uint64_t)plane->base + (uint64_t)(int64_t)column * (uint64_t)plane->dx +
                     (uint64_t)(int64_t)row * (uint64_t)plane->dy);
}

/* h: what a plane rises within half a texel, (|dx| + |dy|) / 2. */
GN_INLINE int64_t gn_rise(int64_t dx, int64_t dy)
{
    return ((dx < 0 ? -dx : dx) + (dy < 0 ? -dy : dy)) / 2;
}

/* What a plane of these gradients rises from a vertex to the centre of texel (0, 0). */
GN_INLINE int64_t gn_rise_from(const gn_vertex *v, int32_t dx, int32_t dy)
{
    return gn_floor_shift_64(gn_multiply(128 - v->x, dx) + gn_multiply(128 - v->y, dy), 8);
}

/* Q in the camera pass, with 32 fraction bits, modulo 2^64: Q(i, j) = floor((base + i dx + j dy) / 2^32). */
typedef struct gn_q_plane {
    uint64_t base, dx, dy;
} gn_q_plane;

/* The plane through three vertices with gradients g = 512 N / A, relative error 2^-29, + 1/2. Where a gradient reaches
 * 2^30, a quarter of the depth range in one texel, *plane is constant, the farthest vertex's, and the result is 1: then
 * gn_make_steep_plane has the plane itself. The vertices run clockwise; area: theirs, not 0, its sign is ignored. */
int gn_make_depth_plane(gn_depth_plane *plane, const gn_vertex *v0, const gn_vertex *v1, const gn_vertex *v2,
                        int64_t area);

/* The same for steep ones, up to the whole range in 1/256 texel, which is what vertices are snapped to; beyond, z is
 * constant, the farthest vertex's, and the result is 1. */
int gn_make_steep_plane(gn_wide_plane *plane, const gn_vertex *v0, const gn_vertex *v1, const gn_vertex *v2,
                        int64_t area);

/* The same for vertices whose Z count 2^shift units, shift <= 14: gradients below 2^48, so that z is below 2^62 at
 * every texel of a map of 4096. Beyond, z is constant, the farthest vertex's, and the result is 1. */
int gn_make_far_plane(gn_wide_plane *plane, const gn_vertex *v0, const gn_vertex *v1, const gn_vertex *v2, int64_t area,
                      uint32_t shift);

/* The same for Q: gradients with 32 fraction bits, relative error 2^-29; too steep: constant, the farthest Q. */
void gn_make_q_plane(gn_q_plane *plane, const gn_vertex *v0, const gn_vertex *v1, const gn_vertex *v2, int64_t area);

/* ---- edges ----------------------------------------------------------------------------------------------------- */

/* The first column at or right of an edge, row by row: x = ceil((X - 128) / 256) exactly, in 32 bits. error counts
 * 1/(256 dy) columns past column x - 1, less 256 dy + 1: in [-256 dy, 0). */
typedef struct gn_edge {
    int32_t x, error;
    int32_t step, error_step, denominator;
} gn_edge;

/* The edge from its upper vertex down to the lower one, at a row whose centre is at or below the upper vertex and not
 * below the lower one. The ceiling of n / d is floor((n - 1) / d) + 1: so both divisions are floors. */
GN_INLINE void gn_edge_start(gn_edge *edge, const gn_vertex *upper, const gn_vertex *lower, int32_t row)
{
    int32_t dx = lower->x - upper->x;
    uint32_t dy = (uint32_t)(lower->y - upper->y), t = (uint32_t)(256 * row + 128 - upper->y);
    uint32_t width = dx < 0 ? 0u - (uint32_t)dx : (uint32_t)dx;
    uint32_t quotient = width / dy, s = width - quotient * dy;
    int32_t q = (int32_t)quotient;
    if (dx < 0) { /* floor and its remainder, which is never negative */
        q = -q;
        if (s) {
            q--;
            s = dy - s;
        }
    }
    uint32_t p, m = t * s + dy - 1;
    if (GN_LIKELY(t < 2047)) { /* t s + dy < 2^32 */
        p = m / dy;
    } else {
        p = gn_divide(gn_multiply_u(t, s) + dy - 1, dy);
    }
    m -= p * dy;
    uint32_t u = (uint32_t)(upper->x - 129 + (int32_t)t * q) + p;
    edge->denominator = (int32_t)(dy << 8);
    edge->x = gn_floor_shift((int32_t)u, 8) + 1;
    edge->error = (int32_t)((u & 255u) * dy + m) - edge->denominator;
    edge->step = q;
    edge->error_step = (int32_t)(s << 8);
}

GN_INLINE void gn_edge_step(gn_edge *edge)
{
    edge->x += edge->step;
    edge->error += edge->error_step;
    if (edge->error >= 0) {
        edge->error -= edge->denominator;
        edge->x++;
    }
}

/* ---- the walk -------------------------------------------------------------------------------------------------- */

/* What to do with a span: columns [left, right) of a row, left < right. */
typedef void gn_span(const void *state, int32_t row, int32_t left, int32_t right);

/* A clockwise triangle (area > 0) that may have centres inside a window: rotated so that the top vertex comes first
 * (the next one is then on the right chain, the last on the left), with the first rows of the vertices, and the rows
 * [row, bottom) inside the window. */
typedef struct gn_rows {
    const gn_vertex *top, *next, *last;
    int32_t row, row_next, row_last, bottom;
    int32_t cut; /* columns reach beyond the window */
} gn_rows;

/* 0 if the triangle's box holds no centre inside the window. */
GN_INLINE int gn_find_rows(gn_rows *rows, const gn_vertex *v0, const gn_vertex *v1, const gn_vertex *v2,
                           const gn_window *window)
{
    rows->top = v0, rows->next = v1, rows->last = v2;
    int32_t top = v0->y, next = v1->y, last = v2->y;
    if (next < top && next <= last) {
        rows->top = v1, rows->next = v2, rows->last = v0;
        top = v1->y, next = v2->y, last = v0->y;
    } else if (last < top) {
        rows->top = v2, rows->next = v0, rows->last = v1;
        top = v2->y, next = v0->y, last = v1->y;
    }
    int32_t row = gn_first_centre(top), row_next = gn_first_centre(next), row_last = gn_first_centre(last);
    int32_t bottom = row_next < row_last ? row_last : row_next;
    row = row < window->row0 ? window->row0 : row;
    bottom = bottom > window->row1 ? window->row1 : bottom;
    if (row >= bottom)
        return 0;
    rows->row = row;
    rows->row_next = row_next;
    rows->row_last = row_last;
    rows->bottom = bottom;
    int32_t left = v0->x < v1->x ? v0->x : v1->x, right = v0->x < v1->x ? v1->x : v0->x;
    left = gn_first_centre(v2->x < left ? v2->x : left);
    right = gn_first_centre(v2->x > right ? v2->x : right);
    rows->cut = left < window->column0 || right > window->column1;
    return left < right && right > window->column0 && left < window->column1;
}

/* Call span for every row of the triangle inside the window. span must be an inline function; cut: rows->cut, or 0
 * where that is known. */
GN_INLINE void gn_walk(const gn_rows *rows, const gn_window *window, int32_t cut, gn_span *span, const void *state)
{
    const gn_vertex *top = rows->top, *next = rows->next, *last = rows->last;
    int32_t row = rows->row, row_next = rows->row_next, row_last = rows->row_last, bottom = rows->bottom;
    /* Each chain has one edge or two; the chain that reaches its middle vertex first changes edges there. */
    gn_edge left = {0, 0, 0, 0, 0}, right = left;
    const gn_vertex *left_from = top, *left_to = last, *right_from = top, *right_to = next;
    int32_t end = bottom;
    if (row >= row_last)
        left_from = last, left_to = next;
    else
        end = row_last < end ? row_last : end;
    if (row >= row_next)
        right_from = next, right_to = last;
    else
        end = row_next < end ? row_next : end;
    for (;;) {
        if (left_from)
            gn_edge_start(&left, left_from, left_to, row);
        if (right_from)
            gn_edge_start(&right, right_from, right_to, row);
        do {
            int32_t l = left.x, r = right.x;
            if (GN_UNLIKELY(cut)) {
                l = l < window->column0 ? window->column0 : l;
                r = r > window->column1 ? window->column1 : r;
            }
            if (l < r)
                span(state, row, l, r);
            gn_edge_step(&left);
            gn_edge_step(&right);
        } while (++row < end);
        if (row >= bottom)
            return;
        left_from = right_from = 0;
        if (row_next < row_last)
            right_from = next, right_to = last;
        else
            left_from = last, left_to = next;
        end = bottom;
    }
}

#if GN_VECTOR
/* ---- tiny triangles, hosts only -------------------------------------------------------------------------------- */

/* Sixteen or eight pixels from a column on: negative lanes are outside the triangle. */
typedef void gn_tiny_span_16(const void *state, int32_t row, int32_t column, gn_i32x16 outside);
typedef void gn_tiny_span_8(const void *state, int32_t row, int32_t column, gn_i32x8 outside);

/* One side's edge function at the centre (column, row), less the tie that top and left edges win, divided by 256: its
 * steps of 256 a column and a row leave only the floor to matter. All of it fits 32 bits in a box of 16 x 16 pixels. */
GN_INLINE int32_t gn_tiny_edge(const gn_vertex *from, const gn_vertex *to, int32_t column, int32_t row, int32_t *dx,
                               int32_t *dy)
{
    *dx = to->x - from->x;
    *dy = to->y - from->y;
    int32_t tie = *dy < 0 || (*dy == 0 && *dx > 0) ? 0 : 1;
    return gn_floor_shift(*dx * (256 * row + 128 - from->y) - *dy * (256 * column + 128 - from->x) - tie, 8);
}

/* The box of a triangle in pixels, cut to the window; 0 if it is wider than most columns or taller than 16 rows. */
GN_INLINE int gn_tiny_box(const gn_rows *rows, const gn_window *window, int32_t most, gn_window *box)
{
    const gn_vertex *v0 = rows->top, *v1 = rows->next, *v2 = rows->last;
    int32_t left = v0->x < v1->x ? v0->x : v1->x, right = v0->x < v1->x ? v1->x : v0->x;
    left = v2->x < left ? v2->x : left;
    right = v2->x > right ? v2->x : right;
    if (right - left > 256 * most || v1->y - v0->y > 256 * 16 || v2->y - v0->y > 256 * 16)
        return 0;
    box->column0 = gn_first_centre(left);
    box->column1 = gn_first_centre(right);
    box->row0 = rows->row;
    box->row1 = rows->bottom;
    box->column0 = box->column0 < window->column0 ? window->column0 : box->column0;
    return box->column1 <= window->column1 && box->column1 - box->column0 <= most;
}

#define GN_TINY_WALK(name, lanes, ...)                                                                                 \
    GN_INLINE int name(const gn_rows *rows, const gn_window *window, gn_tiny_span_##lanes *span, const void *state)    \
    {                                                                                                                  \
        static const gn_i32x##lanes lane = {__VA_ARGS__};                                                              \
        const gn_vertex *v0 = rows->top, *v1 = rows->next, *v2 = rows->last;                                           \
        gn_window box;                                                                                                 \
        int32_t dx0, dy0, dx1, dy1, dx2, dy2;                                                                          \
        if (!gn_tiny_box(rows, window, lanes, &box))                                                                   \
            return 0;                                                                                                  \
        gn_i32x##lanes e0 = gn_tiny_edge(v0, v1, box.column0, box.row0, &dx0, &dy0) - lane * dy0;                      \
        gn_i32x##lanes e1 = gn_tiny_edge(v1, v2, box.column0, box.row0, &dx1, &dy1) - lane * dy1;                      \
        gn_i32x##lanes e2 = gn_tiny_edge(v2, v0, box.column0, box.row0, &dx2, &dy2) - lane * dy2;                      \
        for (int32_t row = box.row0; row < box.row1; row++, e0 += dx0, e1 += dx1, e2 += dx2)                           \
            span(state, row, box.column0, e0 | e1 | e2);                                                               \
        return 1;                                                                                                      \
    }

/* Walk a clockwise triangle by its edge functions, a vector a row, if it is small enough; 0 if not. The same pixels as
 * gn_walk, without its divisions. */
GN_TINY_WALK(gn_walk_tiny_16, 16, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15)
GN_TINY_WALK(gn_walk_tiny_8, 8, 0, 1, 2, 3, 4, 5, 6, 7)
#endif

#endif
