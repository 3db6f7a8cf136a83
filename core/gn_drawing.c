#include "gn_drawing.h"

#include "gn_clip.h"
#include "gn_grid.h"
#include "gn_silhouette.h"

/* ---- planning ---------------------------------------------------------------------------------------------------- */

gn_status gn_check_drawing(const gn_scene *scene)
{
    for (uint32_t o = 0; o < scene->object_count; o++) {
        const gn_mesh *mesh = scene->objects[o].mesh;
        /* instances of one mesh mostly follow each other: check it once */
        if ((!mesh->edges && !mesh->edge_count) || (o && mesh == scene->objects[o - 1].mesh))
            continue;
        gn_status status = gn_check_edges(mesh);
        if (status != GN_OK)
            return status;
    }
    return GN_OK;
}

uint64_t gn_lay_out_drawn(gn_context *context, uint64_t used, const gn_settings *settings)
{
    uint8_t *base = (uint8_t *)context;
    uint64_t bytes = (uint64_t)settings->map_width * settings->map_height * gn_map_count(settings);
    gn_drawn *drawn = gn_take(base, &used, sizeof *drawn);
    uint8_t *map = gn_take(base, &used, bytes);
    if (context) {
        context->drawn = drawn;
        drawn->map = map;
        drawn->count = 0;
    }
    return used;
}

uint64_t gn_lay_out_drawing(gn_context *context, uint64_t used, const gn_plan *plan, const gn_settings *settings)
{
    uint8_t *base = context ? context->shared : 0;
    uint64_t stride = settings->map_width + GN_ROW_PADDING, rows = plan->light_regions > 1 ? settings->workers : 0;
    gn_depth *row = gn_take(base, &used, rows * stride * sizeof *row);
    uint8_t *facings = gn_take(base, &used, ((uint64_t)plan->triangles + 3) / 4);
    uint32_t *chosen = gn_take(base, &used, ((uint64_t)plan->edges + 31) / 32 * sizeof *chosen);
    if (context) {
        context->drawn->row = row;
        context->drawn->facings = facings;
        context->drawn->chosen = chosen;
    }
    return used;
}

/* ---- which edges ------------------------------------------------------------------------------------------------- */

/* Mark the edges of all meshes that have a winding. Of a mesh without edges those of every triangle count that is not
 * seen edge-on. */
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
            if (gn_edge_winding(mesh, &mesh->edges[e], drawn->facings, first_triangle, 0) == 0)
                continue;
            drawn->chosen[number >> 5] |= 1u << (number & 31);
            drawn->count++;
        }
        for (uint32_t t = 0; !mesh->edges && t < mesh->triangle_count; t++)
            drawn->count += gn_facing_of(drawn->facings, first_triangle + t) == GN_CASTS_NOTHING ? 0 : 3;
        first_triangle += mesh->triangle_count;
    }
}

gn_status gn_begin_drawing(gn_context *context)
{
    gn_status status = gn_find_facings(context->scene, &context->light, context->drawn->facings, 0);
    if (status == GN_OK)
        choose_edges(context);
    return status;
}

/* ---- drawing ----------------------------------------------------------------------------------------------------- */

void gn_begin_canvas(gn_context *context, uint32_t region, uint32_t worker, gn_canvas *c)
{
    const gn_settings *settings = &context->settings;
    gn_drawn *drawn = context->drawn;
    int32_t width = settings->map_width, height = settings->map_height, rows = context->plan.map_rows;
    int32_t first = (int32_t)region * rows, end = first + rows < height ? first + rows : height;
    uint32_t stride = context->map_stride;
    const gn_grid *grid = context->grid;
    const gn_unequal_cells *unequal = grid ? grid->cells : 0;
    gn_cells cells = {{grid ? grid->columns : 0, 0, width, unequal},
                      {grid ? grid->rows : 0, first, end + (end < height), unequal}};
    c->map = drawn->map + first * width;
    c->texels = context->map + (size_t)first * stride;
    c->beyond = 0;
    c->width = width;
    c->stride = (int32_t)stride;
    c->first = first;
    c->end = end;
    c->cells = cells;
    if (end < height) {
        gn_depth *row = drawn->row + worker * stride;
        gn_nearest_row(context, worker, end, row);
        c->beyond = row;
    }
}

typedef struct edge {
    uint32_t ends[2]; /* vertices of the mesh */
    int32_t winding;  /* of gn_edge_winding, for the way from the first to the second */
    int alone;        /* gn_stroke */
} edge;

static void draw_segment(const gn_canvas *c, const gn_vertex *a, const gn_vertex *b, const edge *e)
{
    gn_stroke s;
    int swap = gn_make_segment(&s.segment, a, b), turn = (e->winding < 0) != swap;
    s.alone = e->alone;
    s.dx = turn ? -s.segment.dx : s.segment.dx;
    s.dy = turn ? -s.segment.dy : s.segment.dy;
    c->draw(c, &s);
}

/* Of a fitted depth range: what is nearer than its end is drawn there, what is farther is not drawn. */
static GN_COLD void draw_clamped(const gn_canvas *c, const gn_view *view, gn_place place[2], const edge *e)
{
    gn_vertex v[3];
    int64_t before[2], behind[2];
    for (int i = 0; i < 2; i++) {
        before[i] = place[i].c[2];
        behind[i] = view->far_w - place[i].c[2];
    }
    if (behind[0] <= 0 && behind[1] <= 0)
        return;
    if (behind[0] < 0 || behind[1] < 0) {
        int out = behind[1] < 0;
        place[out] = gn_plane_crossing(view, &place[0], &place[1], behind[0], behind[1], 1);
        before[out] = place[out].c[2];
    }
    gn_place middle = place[1];
    if ((before[0] < 0 && before[1] > 0) || (before[0] > 0 && before[1] < 0))
        middle = gn_plane_crossing(view, &place[0], &place[1], before[0], before[1], 2);
    const gn_place *way[3] = {&place[0], &middle, &place[1]};
    for (int i = 0; i < 3; i++) {
        gn_place held = *way[i];
        held.c[2] = held.c[2] < 0 ? 0 : held.c[2];
        gn_view_project_inside(view, &held, &v[i]);
    }
    draw_segment(c, &v[0], &v[1], e);
    if (v[1].x != v[2].x || v[1].y != v[2].y)
        draw_segment(c, &v[1], &v[2], e);
}

/* An edge with an end beyond the planes or the guard band: clipped as its triangles are. */
static GN_COLD void draw_clipped(const gn_context *context, const gn_canvas *c, const gn_object *object, const edge *e)
{
    const gn_view *view = &context->light_view;
    gn_place place[2];
    gn_vertex v[2];
    for (int i = 0; i < 2; i++) {
        int32_t world[3];
        (void)gn_world_position(object, e->ends[i], world);
        (void)gn_view_place(view, world, &place[i]);
    }
    for (int plane = 0; plane < GN_CLIP_PLANES; plane++) {
        int64_t da = gn_plane_distance(view, &place[0], plane), db = gn_plane_distance(view, &place[1], plane);
        if ((da < 0 && db <= 0) || (db < 0 && da <= 0))
            return;
        if (da < 0 || db < 0)
            place[da < 0 ? 0 : 1] = gn_plane_crossing(view, &place[0], &place[1], da, db, plane);
    }
    if (view->endless) {
        draw_clamped(c, view, place, e);
        return;
    }
    for (int i = 0; i < 2; i++)
        gn_view_project_inside(view, &place[i], &v[i]);
    draw_segment(c, &v[0], &v[1], e);
}

static void draw_edge(const gn_context *context, const gn_canvas *c, uint32_t object_index, const edge *e)
{
    const gn_vertex *vertices = context->vertices + context->objects[object_index].first_vertex;
    const gn_vertex *a = vertices + e->ends[0], *b = vertices + e->ends[1];
    if (GN_LIKELY(a->depth && b->depth))
        draw_segment(c, a, b, e);
    else
        draw_clipped(context, c, &context->scene->objects[object_index], e);
}

static void draw_triangles(const gn_context *context, const gn_canvas *c, uint32_t object_index)
{
    const gn_mesh *mesh = context->scene->objects[object_index].mesh;
    for (uint32_t t = 0; t < mesh->triangle_count; t++) {
        uint32_t index[3], number = context->objects[object_index].first_triangle + t;
        edge e = {{0, 0}, gn_facing_sign(gn_facing_of(context->drawn->facings, number)), 1};
        gn_triangle_indices(mesh, t, index);
        for (int i = 0; e.winding && i < 3; i++) {
            e.ends[0] = index[i];
            e.ends[1] = index[i == 2 ? 0 : i + 1];
            draw_edge(context, c, object_index, &e);
        }
    }
}

void gn_draw_silhouette_edges(const gn_context *context, const gn_canvas *c)
{
    uint32_t number = 0;
    for (uint32_t o = 0; o < context->scene->object_count; o++) {
        const gn_mesh *mesh = context->scene->objects[o].mesh;
        if (!mesh->edges) {
            draw_triangles(context, c, o);
            continue;
        }
        for (uint32_t e = 0; e < mesh->edge_count; e++, number++) {
            edge chosen = {{0, 0}, 0, 0};
            uint32_t word = context->drawn->chosen[number >> 5];
            if (word == 0) { /* usually: on to the next word's first edge, or the next mesh's */
                uint32_t rest = 31 - (number & 31), left = mesh->edge_count - 1 - e;
                rest = rest < left ? rest : left;
                e += rest;
                number += rest;
                continue;
            }
            if (!(word >> (number & 31) & 1))
                continue;
            chosen.winding = gn_edge_winding(mesh, &mesh->edges[e], context->drawn->facings,
                                             context->objects[o].first_triangle, chosen.ends);
            draw_edge(context, c, o, &chosen);
        }
    }
}
