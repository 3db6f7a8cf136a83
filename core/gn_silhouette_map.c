#include "gn_silhouette_map.h"

#include "gn_cascade.h"
#include "gn_clip.h"
#include "gn_segment.h"
#include "gn_silhouette.h"

/* How far a point may lie behind the depths about it, of 2^32: what snapping and cutting leave of a silhouette on the
 * surface that it borders. */
#define POINT_ERROR 0x10000u

/* How far behind an edge a texel may lie and still be its caster's, or in line with it: so many texels at 45 degrees.
 * Found by measurement (docs/accuracy.md). */
enum { REACH = 4 };

/* ---- planning ---------------------------------------------------------------------------------------------------- */

static gn_status check(const gn_scene *scene)
{
    for (uint32_t o = 0; o < scene->object_count; o++) {
        const gn_mesh *mesh = scene->objects[o].mesh;
        /* instances of one mesh mostly follow each other: check it once */
        if (!mesh->edges || (o && mesh == scene->objects[o - 1].mesh))
            continue;
        gn_status status = gn_check_edges(mesh);
        if (status != GN_OK)
            return status;
    }
    return GN_OK;
}

static uint64_t lay_out_head(gn_context *context, uint64_t used, const gn_scene *scene, const gn_settings *settings)
{
    uint8_t *base = (uint8_t *)context;
    uint64_t bytes = (uint64_t)settings->map_width * settings->map_height;
    (void)scene;
    gn_drawn *drawn = gn_take(base, &used, sizeof *drawn);
    uint8_t *map = gn_take(base, &used, bytes);
    if (context) {
        context->drawn = drawn;
        drawn->map = map;
        drawn->map_bytes = (uint32_t)bytes;
        drawn->count = 0;
    }
    return used;
}

/* Of a region, without padding. */
static uint64_t region_texels(const gn_plan *plan, const gn_settings *settings)
{
    return (uint64_t)plan->map_rows * settings->map_width;
}

static uint64_t lay_out_light(gn_context *context, uint64_t used, const gn_plan *plan, const gn_settings *settings)
{
    uint8_t *base = context ? context->shared : 0;
    uint64_t stride = settings->map_width + GN_ROW_PADDING, rows = plan->light_regions > 1 ? settings->workers : 0;
    gn_depth *keys = gn_take(base, &used, settings->workers * region_texels(plan, settings) * sizeof *keys);
    gn_depth *row = gn_take(base, &used, rows * stride * sizeof *row);
    uint8_t *facings = gn_take(base, &used, ((uint64_t)plan->triangles + 3) / 4);
    uint32_t *chosen = gn_take(base, &used, ((uint64_t)plan->edges + 31) / 32 * sizeof *chosen);
    if (context) {
        context->drawn->keys = keys;
        context->drawn->row = row;
        context->drawn->facings = facings;
        context->drawn->chosen = chosen;
    }
    return used;
}

/* ---- which edges ------------------------------------------------------------------------------------------------- */

/* Mark the edges of all meshes that have a winding. Of a mesh without edges every triangle's count. */
static void choose_edges(gn_context *context)
{
    gn_drawn *drawn = context->drawn;
    uint32_t first_triangle = 0, number = 0;
    for (uint32_t i = 0; i < (context->plan.edges + 31) / 32; i++)
        drawn->chosen[i] = 0;
    drawn->count = 0;
    for (uint32_t o = 0; o < context->scene->object_count; o++) {
        const gn_mesh *mesh = context->scene->objects[o].mesh;
        for (uint32_t e = 0; mesh->edges && e < mesh->edge_count; e++, number++) {
            uint32_t ends[2];
            if (gn_edge_winding(mesh, &mesh->edges[e], drawn->facings, first_triangle, ends) == 0)
                continue;
            drawn->chosen[number >> 5] |= 1u << (number & 31);
            drawn->count++;
        }
        drawn->count += mesh->edges ? 0 : 3 * mesh->triangle_count;
        first_triangle += mesh->triangle_count;
    }
}

static gn_status begin(gn_context *context)
{
    static const gn_bias reach = {GN_BIAS_TEXELS, REACH << 16};
    context->drawn->reach = gn_make_bias(context, &reach);
    gn_status status = gn_find_facings(context->scene, &context->light, context->drawn->facings, 0);
    if (status == GN_OK)
        choose_edges(context);
    return status;
}

/* ---- drawing ----------------------------------------------------------------------------------------------------- */

typedef struct canvas {
    uint8_t *map;           /* of the region's first row */
    gn_depth *keys;         /* the same: rank of the points in map */
    uint32_t reach;         /* how far behind an edge a texel still belongs to it, of 2^32 */
    const gn_depth *texels; /* the same; rows are stride long */
    const gn_depth *beyond; /* the row after the region */
    int32_t width;          /* of the map */
    int32_t stride;
    int32_t first, end, last; /* rows of cells of the region, [first, end); the last row that texels has */
} canvas;

/* An edge as it is drawn into cells. */
typedef struct stroke {
    gn_segment segment;
    int32_t dx, dy; /* the segment's way, or its opposite: what casts the shadow lies where dx y < dy x */
} stroke;

/* Depths of a cell's four texels as the light pass stores them, upper left, upper right, lower left, lower right. row:
 * from the region's first. */
static void find_texels(const canvas *c, int32_t column, int32_t row, gn_depth texel[4])
{
    const gn_depth *above = c->texels + row * c->stride + column;
    const gn_depth *below = row < c->last ? above + c->stride : c->beyond + column;
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

/* Does the edge separate the texels about it: one that it shadows, or what casts the shadow itself, from one far
 * behind? x, y: of the segment's upper end, from the upper left texel. */
static int separates(const stroke *s, const gn_depth texel[4], int32_t x, int32_t y, uint32_t limit)
{
    int64_t side = gn_multiply(s->dy, x) - gn_multiply(s->dx, y); /* of the upper left texel: < 0 behind the caster */
    int64_t across = -256 * (int64_t)s->dy, down = 256 * (int64_t)s->dx;
    int near_caster = 0, far_off = 0;
    for (int i = 0; i < 4; i++) {
        int64_t of_texel = side + (i & 1 ? across : 0) + (i & 2 ? down : 0);
        int is_far = (uint32_t)texel[i] << (32 - GN_DEPTH_BITS) > limit;
        near_caster |= of_texel < 0 && !is_far;
        far_off |= of_texel > 0 && is_far;
    }
    return near_caster && far_off;
}

/* The 4 bits of an offset, in 1/16 texel, to the nearest. */
static uint32_t round_offset(int32_t v)
{
    uint32_t offset = (uint32_t)(v + 8) >> 4;
    return offset > 15 ? 15 : offset;
}

/* Which of several points in a cell stays: the smallest. Points of edges that separate come first, then what is nearer
 * to the light. */
static gn_depth rank(uint32_t z, int separating)
{
    uint32_t key = z >> 1 | (separating ? 0 : 0x80000000u);
    gn_depth depth = (gn_depth)gn_cut(key);
    return depth == GN_FARTHEST ? (gn_depth)(depth - 1) : depth;
}

static void draw_cell(const canvas *c, const stroke *s, int32_t column, int32_t row)
{
    gn_segment_point p;
    gn_depth texel[4];
    gn_segment_in_cell(&s->segment, column, row, &p);
    uint32_t z = 2 * p.z, limit = z + c->reach < z ? 0xffffffffu : z + c->reach;
    int32_t x = s->segment.x - 256 * column, y = s->segment.y - 256 * row;
    row -= c->first;
    find_texels(c, column, row, texel);
    if (is_hidden(texel, z))
        return;
    int32_t at = row * c->width + column;
    gn_depth key = rank(z, separates(s, texel, x, y, limit));
    uint8_t point = (uint8_t)(round_offset(p.y) << 4 | round_offset(p.x));
    if (key < c->keys[at] || (key == c->keys[at] && point < c->map[at])) {
        c->keys[at] = key;
        c->map[at] = point;
    }
}

/* winding: of gn_edge_winding, for the way from a to b. */
static void draw_segment(const canvas *c, const gn_vertex *a, const gn_vertex *b, int32_t winding)
{
    stroke s;
    int32_t row, last;
    int swap = gn_make_segment(&s.segment, a, b), turn = (winding < 0) != swap;
    s.dx = turn ? -s.segment.dx : s.segment.dx;
    s.dy = turn ? -s.segment.dy : s.segment.dy;
    gn_segment_rows(&s.segment, &row, &last);
    row = row < c->first ? c->first : row;
    last = last < c->end ? last : c->end - 1;
    for (; row <= last; row++) {
        int32_t column, last_column;
        gn_segment_columns(&s.segment, row, &column, &last_column);
        column = column < 0 ? 0 : column;
        last_column = last_column < c->width - 2 ? last_column : c->width - 2;
        for (; column <= last_column; column++)
            draw_cell(c, &s, column, row);
    }
}

/* An edge with an end beyond the planes or the guard band: clipped as its triangles are. */
static GN_COLD void draw_clipped(const gn_context *context, const canvas *c, const gn_object *object,
                                 const uint32_t ends[2], int32_t winding)
{
    const gn_view *view = &context->light_view;
    gn_place place[2];
    gn_vertex v[2];
    for (int i = 0; i < 2; i++) {
        int32_t world[3];
        (void)gn_world_position(object, ends[i], world);
        (void)gn_view_place(view, world, &place[i]);
    }
    for (int plane = 0; plane < GN_CLIP_PLANES; plane++) {
        int64_t da = gn_plane_distance(view, &place[0], plane), db = gn_plane_distance(view, &place[1], plane);
        if ((da < 0 && db <= 0) || (db < 0 && da <= 0))
            return;
        if (da < 0 || db < 0)
            place[da < 0 ? 0 : 1] = gn_plane_crossing(view, &place[0], &place[1], da, db, plane);
    }
    for (int i = 0; i < 2; i++)
        gn_view_project_inside(view, &place[i], &v[i]);
    draw_segment(c, &v[0], &v[1], winding);
}

static void draw_edge(const gn_context *context, const canvas *c, uint32_t object_index, const uint32_t ends[2],
                      int32_t winding)
{
    const gn_vertex *vertices = context->vertices + context->objects[object_index].first_vertex;
    const gn_vertex *a = vertices + ends[0], *b = vertices + ends[1];
    if (GN_LIKELY(a->depth && b->depth))
        draw_segment(c, a, b, winding);
    else
        draw_clipped(context, c, &context->scene->objects[object_index], ends, winding);
}

static void draw_triangles(const gn_context *context, const canvas *c, uint32_t object_index)
{
    const gn_mesh *mesh = context->scene->objects[object_index].mesh;
    for (uint32_t t = 0; t < mesh->triangle_count; t++) {
        uint32_t index[4], number = context->objects[object_index].first_triangle + t;
        int32_t winding = gn_facing_sign(gn_facing_of(context->drawn->facings, number));
        gn_triangle_indices(mesh, t, index);
        index[3] = index[0];
        for (int i = 0; winding && i < 3; i++)
            draw_edge(context, c, object_index, index + i, winding);
    }
}

static void draw_chosen(const gn_context *context, const canvas *c)
{
    uint32_t number = 0;
    for (uint32_t o = 0; o < context->scene->object_count; o++) {
        const gn_mesh *mesh = context->scene->objects[o].mesh;
        if (!mesh->edges) {
            draw_triangles(context, c, o);
            continue;
        }
        for (uint32_t e = 0; e < mesh->edge_count; e++, number++) {
            uint32_t ends[2], word = context->drawn->chosen[number >> 5];
            if (word == 0) { /* usually: on to the next word's first edge, or the next mesh's */
                uint32_t rest = 31 - (number & 31), left = mesh->edge_count - 1 - e;
                rest = rest < left ? rest : left;
                e += rest;
                number += rest;
                continue;
            }
            if (!(word >> (number & 31) & 1))
                continue;
            int32_t winding = gn_edge_winding(mesh, &mesh->edges[e], context->drawn->facings,
                                              context->objects[o].first_triangle, ends);
            draw_edge(context, c, o, ends, winding);
        }
    }
}

static void draw(gn_context *context, uint32_t region, uint32_t worker)
{
    const gn_settings *settings = &context->settings;
    gn_drawn *drawn = context->drawn;
    int32_t width = settings->map_width, height = settings->map_height, rows = context->plan.map_rows;
    int32_t first = (int32_t)region * rows, end = first + rows < height ? first + rows : height;
    uint32_t stride = context->map_stride;
    canvas c;
    c.map = drawn->map + first * width;
    c.reach = drawn->reach;
    c.keys = drawn->keys + worker * region_texels(&context->plan, settings);
    c.texels = context->map + (size_t)first * stride;
    c.beyond = 0;
    c.width = width;
    c.stride = (int32_t)stride;
    c.first = first;
    c.end = end < height ? end : height - 1;
    c.last = end - first - 1;
    if (end < height) {
        gn_depth *row = drawn->row + worker * stride;
        gn_nearest_row(context, worker, end, row);
        c.beyond = row;
    }
    for (int32_t i = 0; i < (end - first) * width; i++) {
        c.map[i] = GN_CELL_CENTRE;
        c.keys[i] = GN_FARTHEST;
    }
    draw_chosen(context, &c);
#if GN_STATISTICS
    for (int32_t i = 0; i < (end - first) * width; i++)
        context->workers[worker].statistics.silhouette_texels += c.keys[i] != GN_FARTHEST;
#endif
}

const gn_drawing gn_draw_silhouettes = {check, lay_out_head, lay_out_light, begin, draw};

const uint8_t *gn_silhouette_map(const gn_context *context, uint32_t *stride)
{
    if (!context || !context->drawn)
        return 0;
    *stride = context->settings.map_width;
    return context->drawn->map;
}
