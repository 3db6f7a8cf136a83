/* Rectilinear grids: columns and rows of unequal width (Rosen 2012), evaluated exactly.
 *
 * Light pass: of a triangle's fine rows only those are walked that hold texels, and of a span only the columns that do.
 * An edge is found in each row anew, by one division, exactly where the walk over all rows would be. A plane's depth at
 * a texel is base + column dx + row dy of its fine column and row.
 *
 * Cost on a Cortex-M4: docs/performance.md. Memory: two bytes a column and a row. */
#include "gn_chain.h"
#include "gn_insert.h"
#include "gn_unequal_cells.h"
#include "gn_warp_table.h"
#include "gn_warps.h"

void gn_find_fine(const gn_grid *grid, int32_t column, int32_t row, int32_t fine[2])
{
    if (grid->columns) {
        fine[0] = grid->columns[column];
        fine[1] = grid->rows[row];
        return;
    }
    fine[1] = grid->down[column * grid->height + row];
    fine[0] = grid->across[gn_band(grid, fine[1]) * grid->width + column];
}

/* ---- light pass -------------------------------------------------------------------------------------------------- */

/* Twice the width of a texel, which reaches half-way to its neighbours. */
GN_INLINE uint64_t width_at(const uint16_t *table, int32_t count, int32_t i)
{
    int32_t before = i > 0 ? i - 1 : 0, after = i + 1 < count ? i + 1 : i;
    return after > before ? (uint64_t)(table[after] - table[before]) << (after - before == 1) : 2;
}

static uint32_t rise_at(const gn_layer_target *t, int32_t column, int32_t row)
{
    const gn_grid *grid = t->grid;
    int64_t dx = t->steep ? t->steep_plane.dx : (int32_t)t->plane.dx;
    int64_t dy = t->steep ? t->steep_plane.dy : (int32_t)t->plane.dy;
    uint64_t x = (uint64_t)(dx < 0 ? -dx : dx), y = (uint64_t)(dy < 0 ? -dy : dy);
    uint64_t rise = x * width_at(grid->columns, grid->width, column) + y * width_at(grid->rows, grid->height, row);
    return rise >> 34 ? 0xffffffffu : (uint32_t)(rise >> 2);
}

/* The columns [left, right) of a row, one way of insertion. */
GN_INLINE void insert_columns(const gn_layer_target *t, int32_t row, int32_t left, int32_t right, gn_insertion how)
{
    const uint16_t *column = t->grid->columns + left, *end = t->grid->columns + right;
    int32_t at = row * t->stride + left;
    uint32_t start = gn_start_depth(t, t->grid->rows[row], 0), dx = t->plane.dx, open = t->open;
    gn_depth *z1 = t->first + at, *z2 = how == GN_INSERT_FIRST ? 0 : t->second + (at - t->second_offset);
    for (; column != end; column++) {
        gn_depth v = gn_cut_layer(start + *column * dx, how, open);
        if (how == GN_INSERT_FIRST)
            gn_insert_first(z1, v);
        else if (how == GN_INSERT_TWICE)
            gn_insert_twice(z1, z2++, v);
        else
            gn_insert_two(z1, z2++, v);
        z1++;
    }
}

static GN_COLD void insert_steep_columns(const gn_layer_target *t, int32_t row, int32_t left, int32_t right)
{
    int32_t fine_row = t->grid->rows[row];
    for (; left < right; left++)
        gn_insert_wide(t, row * t->stride + left, gn_wide_depth(&t->steep_plane, t->grid->columns[left], fine_row),
                       rise_at(t, left, row));
}

static void insert_rising_columns(const gn_layer_target *t, int32_t row, int32_t left, int32_t right)
{
    uint32_t start = gn_start_depth(t, t->grid->rows[row], 0);
    for (; left < right; left++)
        gn_insert(t, row * t->stride + left, start + t->grid->columns[left] * t->plane.dx, rise_at(t, left, row));
}

static void insert_span(const gn_layer_target *t, int32_t row, int32_t left, int32_t right)
{
    GN_TALLY(t->tally->centres += (uint32_t)(right - left);)
    if (GN_UNLIKELY(t->steep))
        insert_steep_columns(t, row, left, right);
    else if (t->how == GN_INSERT_FIRST)
        insert_columns(t, row, left, right, GN_INSERT_FIRST);
    else if (t->how == GN_INSERT_TWO)
        insert_columns(t, row, left, right, GN_INSERT_TWO);
    else if (t->how == GN_INSERT_TWICE)
        insert_columns(t, row, left, right, GN_INSERT_TWICE);
    else if (t->how == GN_INSERT_MARKED)
        insert_columns(t, row, left, right, GN_INSERT_MARKED);
    else
        insert_rising_columns(t, row, left, right);
}

/* Where a search for a fine column or row begins: where it would be on a uniform map. */
GN_INLINE int32_t guess(int32_t fine, int32_t count)
{
    int32_t at = fine < 0 ? 0 : (int32_t)((uint32_t)fine * (uint32_t)count >> GN_FINE_BITS);
    return at < count ? at : count - 1;
}

static void walk(const gn_layer_target *t, const gn_rows *rows)
{
    const gn_grid *grid = t->grid;
    int32_t row = gn_find_step(grid->rows, grid->height, rows->row - 1, guess(rows->row, grid->height)) + 1;
    row = row < t->row ? t->row : row;
    if (row >= t->end || grid->rows[row] >= rows->bottom)
        return; /* between two rows */
    int32_t left = guess(gn_floor_shift(rows->top->x, 8), grid->width), right = left;
    gn_chain from, to;
    gn_make_chains(&from, &to, rows);
    for (; row < t->end && grid->rows[row] < rows->bottom; row++) {
        int32_t fine_row = grid->rows[row], fine_left = gn_chain_at(&from, fine_row);
        int32_t fine_right = gn_chain_at(&to, fine_row);
        if (fine_left >= fine_right)
            continue;
        left = gn_find_step(grid->columns, grid->width, fine_left - 1, left) + 1;
        right = gn_find_step(grid->columns, grid->width, fine_right - 1, right > left ? right : left) + 1;
        if (left < right)
            insert_span(t, row, left, right);
    }
}

static void aim(gn_layer_target *t, gn_window *window)
{
    const gn_grid *grid = t->grid;
    t->row = window->row0;
    t->end = window->row1;
    window->row0 = grid->rows[t->row];
    window->row1 = grid->rows[t->end - 1] + 1;
    window->column0 = grid->columns[0];
    window->column1 = grid->columns[grid->width - 1] + 1;
}

/* ---- camera pass ------------------------------------------------------------------------------------------------- */

void gn_find_interval(gn_interval *interval, const uint16_t *table, int32_t count, uint32_t place, uint32_t bits)
{
    int32_t fine = gn_floor_shift((int32_t)place, bits), i = gn_find_step(table, count, fine, interval->texel);
    gn_interval at = {table, i < 0 ? 0 : i, 0, (uint32_t)1 << 31, (uint32_t)i << bits, 1};
    at.start = (uint32_t)table[at.texel] << bits;
    if (i < 0) { /* whole texels further left, so that the quotient's floor is that of a number that is not negative */
        at.width = 2u * table[0] + 1;
        at.reach = at.width << bits;
        uint32_t texels = (at.start - place - 1) / at.reach + 1;
        at.start -= texels * at.reach;
        at.place = 0u - (texels << bits);
    } else if (i + 1 < count) {
        at.width = (uint32_t)(table[i + 1] - table[i]);
        at.reach = at.width << bits;
    } else {
        at.width = 2u * (GN_FINE - table[i]) - 1;
    }
    *interval = at;
}

static void place(const gn_lookup *lookup, gn_points *points)
{
    const gn_grid *grid = lookup->grid;
    gn_interval column = {0}, row = {0};
    for (int32_t i = 0; i < points->count; i++)
        if (points->u[i] != GN_NOWHERE)
            points->u[i] = gn_find_grid_place(&column, grid->columns, grid->width, points->u[i], lookup->bits);
    for (int32_t i = 0; i < points->count; i++)
        if (points->u[i] != GN_NOWHERE)
            points->v[i] = gn_find_grid_place(&row, grid->rows, grid->height, points->v[i], lookup->bits);
}

/* The texel at or before a place of those that have a next one. */
static int32_t first_of_two(uint32_t place, uint32_t last, uint32_t bits)
{
    return last ? (int32_t)gn_first_of_two(place, last, bits) : 0;
}

int64_t gn_wide_slack(const gn_lookup *l, const gn_points *points, int32_t i, int32_t width)
{
    const gn_receiver_plane *plane = gn_find_plane(l->context, l->worker, points->triangle[i], 0);
    int64_t rise = gn_rise(plane->plane.dx, plane->plane.dy) >> 8, more = plane->slack - GN_PLANE_ERROR - 2 * rise;
    more -= l->context->light_view.endless ? GN_CLAMPED_ERROR : 0;
    return plane->exists && more > 0 ? more * (width - 1) : 0;
}

/* Reconstructions that compare at most the four texels about a point get a plane that has the true depths there, at
 * their own numbers; others read the grid. */
static uint32_t sample(const gn_lookup *l, gn_points *points, int32_t i, const gn_wide_plane *plane)
{
    const gn_grid *grid = l->grid;
    int32_t column = first_of_two(points->u[i], l->last_column, l->bits);
    int32_t row = first_of_two(points->v[i], l->last_row, l->bits);
    int32_t width = grid->columns[column + 1] - grid->columns[column], height = grid->rows[row + 1] - grid->rows[row];
    gn_wide_plane local = *plane;
    local.base -= gn_wide_slack(l, points, i, width > height ? width : height);
    if (l->how->samples <= 4) {
        local.base = gn_wide_depth(&local, grid->columns[column], grid->rows[row]);
        local.dx *= width;
        local.dy *= height;
        local.base = gn_wide_depth(&local, -column, -row);
    }
    return l->how->sample(l, points, i, &local);
}

/* ---- tables ------------------------------------------------------------------------------------------------------ */

uint64_t gn_rectilinear_bytes(const gn_settings *settings)
{
    return 2 * ((uint64_t)settings->map_width + settings->map_height);
}

uint64_t gn_rectilinear_sums(const gn_settings *s)
{
    return 4 * (gn_warp_lines(s) + 2 * (uint64_t)(s->map_width > s->map_height ? s->map_width : s->map_height));
}

void gn_end_rectilinear(gn_context *context, uint32_t *importance)
{
    const gn_settings *s = &context->settings;
    gn_q16_16 smoothing = s->smoothing ? s->smoothing : 1 << 16;
    uint32_t *rows = importance + s->map_width, *scratch = rows + s->map_height;
    gn_smooth_importance(importance, s->map_width, smoothing, scratch);
    gn_smooth_importance(rows, s->map_height, smoothing, scratch);
    gn_place_texels(context->fitting->columns, s->map_width, importance, s->map_width);
    gn_place_texels(context->fitting->rows, s->map_height, rows, s->map_height);
}

void gn_lay_out_rectilinear(gn_context *context, uint16_t *tables)
{
    gn_grid *grid = &context->fitting->grid;
    context->fitting->columns = tables;
    context->fitting->rows = tables + context->settings.map_width;
    grid->columns = context->fitting->columns;
    grid->rows = context->fitting->rows;
    grid->aim = aim;
    grid->walk = walk;
    grid->place = place;
    grid->cells = &gn_rectilinear_cells;
    grid->sample = sample;
    context->grid = grid;
}
