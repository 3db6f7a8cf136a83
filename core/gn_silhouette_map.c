#include "gn_silhouette_map.h"

#include "gn_cascade.h"

/* How far a point may lie behind the depths about it, of 2^32: what snapping and cutting leave of a silhouette on the
 * surface that it borders. */
#define POINT_ERROR 0x10000u

/* How far behind an edge a texel may lie and still be its caster's, or in line with it: so many texels at 45 degrees,
 * as large as those about the edge. Found by measurement (docs/accuracy.md). */
enum { REACH = 4 };

/* The end of the depths before an empty texel's. */
#define LAST (((uint32_t)GN_FARTHEST << (32 - GN_DEPTH_BITS)) - 1)

/* ---- planning ---------------------------------------------------------------------------------------------------- */

/* Of a region, without padding. */
static uint64_t region_texels(const gn_plan *plan, const gn_settings *settings)
{
    return (uint64_t)plan->map_rows * settings->map_width;
}

static uint64_t lay_out_light(gn_context *context, uint64_t used, const gn_plan *plan, const gn_settings *settings)
{
    uint8_t *base = context ? context->shared : 0;
    gn_depth *keys = gn_take(base, &used, settings->workers * region_texels(plan, settings) * sizeof *keys);
    if (context)
        context->drawn->keys = keys;
    return gn_lay_out_drawing(context, used, plan, settings);
}

static gn_status begin(gn_context *context)
{
    static const gn_bias reach = {GN_BIAS_TEXELS, REACH << 16};
    context->drawn->reach = gn_make_bias(context, &reach);
    return gn_begin_drawing(context);
}

/* ---- drawing ----------------------------------------------------------------------------------------------------- */

/* Depths of a cell's four texels as the light pass stores them, upper left, upper right, lower left, lower right. */
static void find_texels(const gn_canvas *c, int32_t column, int32_t row, gn_depth texel[4])
{
    const gn_depth *above = gn_canvas_row(c, row) + column, *below = gn_canvas_row(c, row + 1) + column;
    texel[0] = above[0], texel[1] = above[1];
    texel[2] = below[0], texel[3] = below[1];
}

/* Is a point behind all four texels of its cell? */
static int is_hidden(const gn_depth texel[4], uint32_t z)
{
    gn_depth farthest = texel[0];
    for (int i = 1; i < 4; i++)
        farthest = texel[i] > farthest ? texel[i] : farthest;
    /* the far end of the unit in which depths are stored; with the mark of mixed surfaces, of two */
    uint32_t end = ((uint32_t)farthest << (32 - GN_DEPTH_BITS)) | ((2u << (32 - GN_DEPTH_BITS)) - 1);
    return z > end && z - end > POINT_ERROR;
}

/* The texels of a cell, a bit each, on the caster's side of an edge, and on the other; one on its line is on neither.
 */
static void find_sides(const gn_stroke *s, const gn_cell *cell, uint32_t *caster, uint32_t *other)
{
    int32_t x = s->segment.x - cell->x, y = s->segment.y - cell->y;
    int64_t across = gn_multiply(s->dy, 256 * cell->width), down = gn_multiply(s->dx, 256 * cell->height);
    int64_t side = gn_multiply(s->dy, x) - gn_multiply(s->dx, y); /* of the upper left texel: < 0 the caster's */
    *caster = *other = 0;
    for (int i = 0; i < 4; i++) {
        *caster |= (uint32_t)(side < 0) << i;
        *other |= (uint32_t)(side > 0) << i;
        side += i == 1 ? across + down : -across; /* on to the next: to the right, or to the row below */
    }
}

/* The texels of a cell, a bit each, that are farther than a limit, marked as mixed surfaces do or not. */
static uint32_t find_far(const gn_depth texel[4], uint32_t limit)
{
    uint32_t far_off = 0;
    for (int i = 0; i < 4; i++)
        far_off |= (uint32_t)((uint32_t)(texel[i] | 1) << (32 - GN_DEPTH_BITS) > limit) << i;
    return far_off;
}

/* The square of the distance from a point to the nearest of some texels of its cell, at most 2^17, as if the cell were
 * a square. */
static uint32_t distance_to(const gn_segment_point *p, uint32_t texels)
{
    uint32_t least = 1u << 17;
    for (int i = 0; i < 4; i++) {
        int32_t x = p->x - (i & 1 ? 256 : 0), y = p->y - (i & 2 ? 256 : 0);
        uint32_t squared = (uint32_t)(x * x + y * y);
        least = texels >> i & 1 && squared < least ? squared : least;
    }
    return least;
}

/* The 4 bits of an offset, in 1/16 of the cell's side, to the nearest. */
static uint32_t round_offset(int32_t v)
{
    uint32_t offset = (uint32_t)(v + 8) >> 4;
    return offset > 15 ? 15 : offset;
}

/* Which of several points in a cell stays: the least. */
static gn_depth rank(uint32_t key)
{
    gn_depth depth = (gn_depth)gn_cut(key);
    return depth == GN_FARTHEST ? (gn_depth)(depth - 1) : depth;
}

/* An edge separates the texels about it where one on its caster's side is no farther than the edge, and one on the
 * other is far behind. Those that do come first, then what is nearer to the light. Where neighbours are not known, most
 * edges lie within a surface: only those that separate are drawn, and the outermost comes first, nearest to what it
 * uncovers. */
static void draw_cell(const gn_canvas *c, const gn_stroke *s, int32_t column, int32_t row)
{
    gn_segment_point p;
    gn_depth texel[4];
    uint32_t caster = 0, other = 0;
    gn_cell cell = gn_cell_between(&c->cells, column, row);
    gn_segment_in_cell(&s->segment, &cell, &p);
    uint32_t z = 2 * p.z;
    uint64_t far_limit = z + (gn_multiply_u(c->reach, (uint32_t)(cell.width + cell.height)) >> 1);
    uint32_t limit = far_limit > LAST ? LAST : (uint32_t)far_limit;
    find_texels(c, column, row, texel);
    if (is_hidden(texel, z))
        return;
    uint32_t far_off = find_far(texel, limit);
    if (far_off && far_off != 15) /* else nothing separates them */
        find_sides(s, &cell, &caster, &other);
    int separates = (caster & ~far_off) && (other & far_off);
    if (s->alone && !separates)
        return;
    int32_t at = (row - c->first) * c->width + column;
    gn_depth key = rank(s->alone ? distance_to(&p, other & far_off) << 13 : z >> 1 | (separates ? 0 : 0x80000000u));
    uint8_t point = (uint8_t)(round_offset(p.y) << 4 | round_offset(p.x));
    if (key < c->keys[at] || (key == c->keys[at] && point < c->map[at])) {
        c->keys[at] = key;
        c->map[at] = point;
    }
}

static void draw_stroke(const gn_canvas *c, const gn_stroke *s)
{
    int32_t row, last;
    gn_segment_rows(&s->segment, &c->cells.rows, &row, &last);
    for (; row <= last; row++) {
        int32_t column, last_column;
        gn_segment_columns(&s->segment, &c->cells, row, &column, &last_column);
        for (; column <= last_column; column++)
            draw_cell(c, s, column, row);
    }
}

/* The reach in a cell of one fine texel: that of a texel of the mean size, width / GN_FINE of it. */
static uint32_t reach_of(const gn_context *context)
{
    uint32_t width = context->settings.map_width, height = context->settings.map_height;
    if (!context->grid)
        return context->drawn->reach;
    return gn_divide(gn_multiply_u(context->drawn->reach, 2 * width * height), GN_FINE * (width + height));
}

static void draw(gn_context *context, uint32_t region, uint32_t worker)
{
    gn_canvas c;
    gn_begin_canvas(context, region, worker, &c);
    c.draw = draw_stroke;
    c.reach = reach_of(context);
    c.keys = context->drawn->keys + worker * region_texels(&context->plan, &context->settings);
    int32_t count = (c.end - c.first) * c.width;
    uint8_t *map = c.map; /* bytes may alias the canvas */
    gn_depth *keys = c.keys;
    for (int32_t i = 0; i < count; i++) {
        map[i] = GN_CELL_CENTRE;
        keys[i] = GN_FARTHEST;
    }
    gn_draw_silhouette_edges(context, &c);
#if GN_STATISTICS
    for (int32_t i = 0; i < count; i++)
        context->workers[worker].statistics.silhouette_texels += c.keys[i] != GN_FARTHEST;
#endif
}

const gn_drawing gn_draw_silhouettes = {gn_check_drawing, gn_lay_out_drawn, lay_out_light, begin, draw, GN_CELL_CENTRE};

const uint8_t *gn_silhouette_map(const gn_context *context, uint32_t *stride)
{
    if (!context || context->phase < GN_PHASE_LIGHT || gn_find_drawing(&context->settings) != &gn_draw_silhouettes)
        return 0;
    *stride = context->settings.map_width;
    return context->drawn->map;
}
