#include "gn_crossing_map.h"

#include "gn_cascade.h"

enum { TO_RIGHT = 0, TO_BELOW = 4 }; /* bits of a texel's byte */

/* Where a segment crosses the line through a row or a column of centres. */
typedef struct crossing {
    int32_t t, length;   /* the way from the segment's upper end, and to its lower one, across such lines */
    const gn_axis *axis; /* of the centres along the line */
    int32_t place;       /* along the line, rounded down */
    int32_t before;      /* the last texel that lies before it */
} crossing;

/* from, d: the segment's upper end and extent along the line. goes_after: a centre that it meets lies before it. */
static void find_crossing(crossing *x, const gn_axis *axis, int32_t from, int32_t d, int goes_after)
{
    int rest;
    x->axis = axis;
    x->place = from + gn_segment_share(d, x->t, x->length, &rest);
    x->before = gn_centre_before(axis, x->place - !(rest || goes_after));
}

/* From the texel before it. */
static uint32_t code_of(const crossing *x)
{
    uint32_t side = (uint32_t)gn_step_after(x->axis, x->before);
    uint32_t way = (uint32_t)(x->place - gn_centre(x->axis, x->before)) + 8 * side;
    uint32_t code = (side == 1 ? way : way / side) >> 4;
    return code < 1 ? 1 : code > 15 ? 15 : code;
}

/* node: the byte of the texel before the crossing. depth: of the texels before and after it. */
static void put(const gn_stroke *s, const crossing *x, uint8_t *node, unsigned side, const gn_depth depth[2],
                int caster_is_after)
{
    uint32_t near = depth[caster_is_after] & ~1u, far = depth[!caster_is_after] & ~1u;
    if (near >= far)
        return;
    uint32_t code = code_of(x), old = (uint32_t)*node >> side & 15;
    if (old && (caster_is_after ? old <= code : old >= code))
        return;
    int rest;
    uint32_t z = s->segment.z + (uint32_t)gn_segment_share(s->segment.dz, x->t, x->length, &rest);
    if (z < far << (32 - GN_DEPTH_BITS) >> 1)
        *node = (uint8_t)((*node & ~(15u << side)) | code << side);
}

static int32_t least(int32_t a, int32_t b)
{
    return a < b ? a : b;
}

static int32_t largest(int32_t a, int32_t b)
{
    return a > b ? a : b;
}

/* The first line at or beyond a place; lines [first_line(a), first_line(b)) are crossed from a to b > a. */
static int32_t first_line(const gn_axis *axis, int32_t place)
{
    return gn_centre_before(axis, place - 1) + 1;
}

static void cross_rows(const gn_canvas *c, const gn_stroke *stroke)
{
    const gn_segment *s = &stroke->segment;
    const gn_axis *rows = &c->cells.rows;
    int32_t row = largest(first_line(rows, s->y), c->first), end = least(first_line(rows, s->y + s->dy), c->end);
    for (; row < end; row++) {
        crossing x = {gn_centre(rows, row) - s->y, s->dy, 0, 0, 0};
        find_crossing(&x, &c->cells.columns, s->x, s->dx, 0);
        if (x.before < 0 || x.before > c->width - 2)
            continue;
        put(stroke, &x, c->map + (row - c->first) * c->width + x.before, TO_RIGHT, gn_canvas_row(c, row) + x.before,
            stroke->dy > 0);
    }
}

/* The columns of centres that are crossed within the region's rows, and a few beside them. */
static void find_columns(const gn_canvas *c, const gn_segment *s, int32_t *column, int32_t *end)
{
    const gn_axis *columns = &c->cells.columns, *rows = &c->cells.rows;
    int32_t top = gn_centre(rows, rows->first) - s->y, bottom = gn_centre(rows, rows->end - 1) - s->y;
    int32_t from = s->x, to = s->x + s->dx;
    int rest;
    *column = *end = 0;
    if (top > s->dy || bottom < 0)
        return;
    if (bottom < s->dy)
        to = s->x + gn_segment_share(s->dx, bottom, s->dy, &rest) + (s->dx > 0);
    if (top > 0)
        from = s->x + gn_segment_share(s->dx, top, s->dy, &rest) + (s->dx < 0);
    *column = largest(first_line(columns, least(from, to)), 0);
    *end = least(first_line(columns, largest(from, to)), c->width);
}

static void cross_columns(const gn_canvas *c, const gn_stroke *stroke)
{
    const gn_segment *s = &stroke->segment;
    int32_t column, end;
    find_columns(c, s, &column, &end);
    for (; column < end; column++) {
        int32_t t = gn_centre(&c->cells.columns, column) - s->x;
        crossing x = {t < 0 ? -t : t, s->dx < 0 ? -s->dx : s->dx, 0, 0, 0};
        find_crossing(&x, &c->cells.rows, s->y, s->dy, s->dx > 0 && s->dy > 0);
        if (x.before < c->first || x.before > c->cells.rows.end - 2)
            continue;
        gn_depth depth[2] = {gn_canvas_row(c, x.before)[column], gn_canvas_row(c, x.before + 1)[column]};
        put(stroke, &x, c->map + (x.before - c->first) * c->width + column, TO_BELOW, depth, stroke->dx < 0);
    }
}

static void draw_stroke(const gn_canvas *c, const gn_stroke *s)
{
    cross_rows(c, s);
    cross_columns(c, s);
}

static void draw(gn_context *context, uint32_t region, uint32_t worker)
{
    gn_canvas c;
    gn_begin_canvas(context, region, worker, &c);
    c.draw = draw_stroke;
    int32_t count = (c.end - c.first) * c.width;
    for (int32_t i = 0; i < count; i++)
        c.map[i] = 0;
    gn_draw_silhouette_edges(context, &c);
#if GN_STATISTICS
    for (int32_t i = 0; i < count; i++)
        context->workers[worker].statistics.silhouette_texels += c.map[i] != 0;
#endif
}

const gn_drawing gn_draw_crossings = {
    gn_check_drawing, gn_lay_out_drawn, gn_lay_out_drawing, gn_begin_drawing, draw, 0};

const uint8_t *gn_crossing_map(const gn_context *context, uint32_t *stride)
{
    if (!context || context->phase < GN_PHASE_LIGHT || gn_find_drawing(&context->settings) != &gn_draw_crossings)
        return 0;
    *stride = context->settings.map_width;
    return context->drawn->map;
}
