/* Warps of vertices alone, as hardware does that draws straight edges between them: what Milet et al. 2015 (Algorithm
 * 1, section 4.1) and Rosen 2012 had to work with. For comparison: between the corners of a large triangle the warp
 * bends, and the triangle does not.
 *
 * The corners of each triangle are moved to where the warp takes them on the map, and it is drawn there as on a uniform
 * map. All else is that of the exact warp. */
#include "gn_insert.h"
#include "gn_warps.h"

static int32_t move(const uint16_t *table, int32_t count, int32_t x)
{
    gn_interval interval = {0};
    return (int32_t)gn_find_grid_place(&interval, table, count, (uint32_t)(x - 128), 8) + 128;
}

static gn_vertex move_rectilinear(const gn_grid *grid, const gn_vertex *v)
{
    gn_vertex moved = {move(grid->columns, grid->width, v->x), move(grid->rows, grid->height, v->y), v->depth};
    return moved;
}

static gn_vertex move_bent(const gn_grid *grid, const gn_vertex *v)
{
    gn_interval interval = {0};
    uint32_t u = (uint32_t)(v->x - 128), column = gn_find_bent_column(grid, &u, (uint32_t)(v->y - 128), 8, &interval);
    gn_vertex moved = {(int32_t)u + 128, move(grid->down + column * (uint32_t)grid->height, grid->height, v->y),
                       v->depth};
    return moved;
}

GN_INLINE void insert_span(const void *state, int32_t row, int32_t left, int32_t right)
{
    const gn_layer_target *t = state;
    GN_TALLY(t->tally->centres += (uint32_t)(right - left);)
    for (; left < right; left++) {
        uint32_t z = gn_start_depth(t, row, left);
        if (t->steep)
            z = gn_saturate(gn_wide_depth(&t->steep_plane, left, row));
        gn_insert(t, row * t->stride + left, z, t->rise);
    }
}

static void walk(const gn_layer_target *t, const gn_rows *fine,
                 gn_vertex (*move_one)(const gn_grid *, const gn_vertex *))
{
    gn_vertex v0 = move_one(t->grid, fine->top), v1 = move_one(t->grid, fine->next), v2 = move_one(t->grid, fine->last);
    gn_window window = {0, t->row, t->grid->width, t->end};
    gn_rows rows;
    gn_layer_target moved = *t;
    int64_t area = gn_area(&v0, &v1, &v2);
    if (area == 0)
        return;
    const gn_vertex *second = area > 0 ? &v1 : &v2, *third = area > 0 ? &v2 : &v1;
    if (!gn_find_rows(&rows, &v0, second, third, &window))
        return;
    moved.steep = gn_make_depth_plane(&moved.plane, &v0, second, third, area);
    if (moved.steep)
        (void)gn_make_steep_plane(&moved.steep_plane, &v0, second, third, area);
    moved.rise = moved.steep ? gn_saturate(gn_rise(moved.steep_plane.dx, moved.steep_plane.dy))
                             : (uint32_t)gn_rise((int32_t)moved.plane.dx, (int32_t)moved.plane.dy);
    gn_walk(&rows, &window, rows.cut, insert_span, &moved);
}

static void walk_rectilinear(const gn_layer_target *t, const gn_rows *rows)
{
    walk(t, rows, move_rectilinear);
}

static void walk_bent(const gn_layer_target *t, const gn_rows *rows)
{
    walk(t, rows, move_bent);
}

/* The rows of texels are kept, and no triangle is left out. */
static void aim(gn_layer_target *t, gn_window *window)
{
    t->row = window->row0;
    t->end = window->row1;
    window->row0 = window->column0 = -(1 << 13);
    window->row1 = window->column1 = 1 << 13;
}

static void lay_out_rectilinear(gn_context *context, uint16_t *tables)
{
    gn_lay_out_rectilinear(context, tables);
    context->fitting->grid.aim = aim;
    context->fitting->grid.walk = walk_rectilinear;
}

static void lay_out_bent(gn_context *context, uint16_t *tables)
{
    gn_lay_out_nonorthogonal(context, tables);
    context->fitting->grid.aim = aim;
    context->fitting->grid.walk = walk_bent;
}

const gn_warp gn_rectilinear_vertices = {
    &gn_fit_and_warp, gn_rectilinear_bytes, lay_out_rectilinear, &gn_round_of_counts, 1, 0};
const gn_warp gn_nonorthogonal_vertices = {
    &gn_fit_and_warp, gn_nonorthogonal_bytes, lay_out_bent, gn_rounds_of_bands, 2, 1};
