/* The non-orthogonal warp (Milet, Navratil & Zemcik 2015, section 3): in each band of the light's plane a function of
 * its own says how its samples go into columns of texels, then in each column one how they go into rows.
 *
 * The texel in column i and row j lies at the fine row down[i][j], and there at the fine column that its band has for
 * column i: the inverse of the paper's equation 6, exactly. The light pass evaluates each texel there. It need not be
 * straight above or left of its neighbours, so cells between four texels have no sides, and what needs them is refused.
 *
 * Sums: two bytes a texel, of a column's or band's share of the view, held at 65535. Memory: four bytes a texel. */
#include "gn_around.h"
#include "gn_chain.h"
#include "gn_insert.h"
#include "gn_warp_table.h"
#include "gn_warps.h"

/* ---- light pass -------------------------------------------------------------------------------------------------- */

/* Where texels of one band may be covered: fine rows [row, end), fine columns [left, right); in all of these rows
 * columns [inner_left, inner_right) are, as a triangle's sides bulge outward. */
typedef struct band {
    int32_t row, end, left, right, inner_left, inner_right;
} band;

static band make_band(const gn_grid *grid, const gn_rows *rows, const gn_chain *from, const gn_chain *to,
                      int32_t number)
{
    band b = {0, 0, 0, 0, 0, 0};
    uint32_t height = (uint32_t)grid->height;
    b.row = (int32_t)((((uint32_t)number << GN_FINE_BITS) + height - 1) / height);
    b.end = (int32_t)((((uint32_t)(number + 1) << GN_FINE_BITS) + height - 1) / height);
    b.row = b.row < rows->row ? rows->row : b.row;
    b.end = b.end > rows->bottom ? rows->bottom : b.end;
    if (b.row >= b.end)
        return b;
    int32_t first = gn_chain_at(from, b.row), last = gn_chain_at(from, b.end - 1);
    b.left = first < last ? first : last;
    b.inner_left = first < last ? last : first;
    if (from->middle >= b.row && from->middle <= b.end) /* the middle vertex is the farthest */
        b.left = gn_first_centre(rows->last->x) < b.left ? gn_first_centre(rows->last->x) : b.left;
    first = gn_chain_at(to, b.row), last = gn_chain_at(to, b.end - 1);
    b.right = first > last ? first : last;
    b.inner_right = first > last ? last : first;
    if (to->middle >= b.row && to->middle <= b.end)
        b.right = gn_first_centre(rows->next->x) > b.right ? gn_first_centre(rows->next->x) : b.right;
    return b;
}

/* *hint: the texel's row where the search begins, and where it ended. */
static void insert_column(const gn_layer_target *t, const gn_chain *from, const gn_chain *to, const band *b,
                          int32_t column, int32_t fine_column, int32_t *hint)
{
    const gn_grid *grid = t->grid;
    const uint16_t *down = grid->down + column * grid->height;
    int32_t row = gn_find_step(down, grid->height, b->row - 1, *hint) + 1;
    int inner = fine_column >= b->inner_left && fine_column < b->inner_right;
    *hint = row < grid->height ? row : row - 1;
    for (row = row < t->row ? t->row : row; row < t->end && down[row] < b->end; row++) {
        int32_t fine_row = down[row];
        if (!inner && (fine_column < gn_chain_at(from, fine_row) || fine_column >= gn_chain_at(to, fine_row)))
            continue;
        uint32_t z = gn_start_depth(t, fine_row, fine_column);
        if (GN_UNLIKELY(t->steep))
            z = gn_saturate(gn_wide_depth(&t->steep_plane, fine_column, fine_row));
        GN_TALLY(t->tally->centres++;)
        gn_insert(t, row * t->stride + column, z, 0);
    }
}

static void walk(const gn_layer_target *t, const gn_rows *rows)
{
    const gn_grid *grid = t->grid;
    int32_t last = gn_band(grid, rows->bottom - 1), hint = gn_band(grid, rows->row), start = grid->width >> 1;
    gn_chain from, to;
    gn_make_chains(&from, &to, rows);
    for (int32_t number = gn_band(grid, rows->row); number <= last; number++) {
        const uint16_t *across = grid->across + number * grid->width;
        band b = make_band(grid, rows, &from, &to, number);
        if (b.row >= b.end)
            continue;
        int32_t column = gn_find_step(across, grid->width, b.left - 1, start) + 1;
        start = column < grid->width ? column : column - 1;
        for (; column < grid->width && across[column] < b.right; column++)
            insert_column(t, &from, &to, &b, column, across[column], &hint);
    }
}

/* A region's rows of texels lie between the least fine row of its first one and the greatest of its last. */
static void aim(gn_layer_target *t, gn_window *window)
{
    const gn_grid *grid = t->grid;
    t->row = window->row0;
    t->end = window->row1;
    window->row0 = window->column1 = GN_FINE;
    window->row1 = window->column0 = 0;
    for (int32_t column = 0; column < grid->width; column++) {
        const uint16_t *down = grid->down + column * grid->height;
        int32_t first = down[t->row], end = down[t->end - 1] + 1;
        window->row0 = first < window->row0 ? first : window->row0;
        window->row1 = end > window->row1 ? end : window->row1;
    }
}

/* ---- camera pass ------------------------------------------------------------------------------------------------- */

uint32_t gn_find_bent_column(const gn_grid *grid, uint32_t *u, uint32_t v, uint32_t bits, gn_interval *interval)
{
    const uint16_t *across = grid->across + gn_band(grid, (int32_t)gn_texel(v, GN_FINE - 1, bits)) * grid->width;
    *u = gn_find_grid_place(interval, across, grid->width, *u, bits);
    return gn_texel(*u, (uint32_t)grid->width - 1, bits);
}

static void place(const gn_lookup *l, gn_points *points)
{
    const gn_grid *grid = l->grid;
    gn_interval between_columns = {0}, between_rows = {0};
    for (int32_t i = 0; i < points->count; i++) {
        if (points->u[i] == GN_NOWHERE)
            continue;
        uint32_t column = gn_find_bent_column(grid, &points->u[i], points->v[i], l->bits, &between_columns);
        points->v[i] = gn_find_grid_place(&between_rows, grid->down + column * (uint32_t)grid->height, grid->height,
                                          points->v[i], l->bits);
    }
}

/* The four texels about a place between texels need not lie about the point: all may be nearer to the light than a
 * plane is at the point, and none of them shadow it. So that they all vote for shadow is not the end of it. */
static void doubt(const gn_lookup *l, gn_points *points)
{
    (void)l;
    points->open_count = 0;
    for (int32_t i = 0; i < points->count; i++)
        if (points->u[i] != GN_NOWHERE && points->dark[i])
            points->open[points->open_count++] = (uint8_t)i;
}

/* How far texels lie apart about one, in fine texels, along the axis where it is more. */
static int32_t find_spread(const gn_grid *grid, int32_t column, int32_t row)
{
    int32_t before = column > 0 ? column - 1 : 0, after = column + 1 < grid->width ? column + 1 : column;
    int32_t above = row > 0 ? row - 1 : 0, below = row + 1 < grid->height ? row + 1 : row;
    int32_t at[4][2], spread = 1;
    gn_find_fine(grid, before, row, at[0]);
    gn_find_fine(grid, after, row, at[1]);
    gn_find_fine(grid, column, above, at[2]);
    gn_find_fine(grid, column, below, at[3]);
    for (int i = 0; i < 4; i += 2) {
        for (int axis = 0; axis < 2; axis++) {
            int32_t apart = at[i][axis] - at[i + 1][axis];
            apart = apart < 0 ? -apart : apart;
            spread = apart > spread ? apart : spread;
        }
    }
    return spread;
}

/* Does a texel shadow a plane where the texel lies? */
static int is_dark(const gn_lookup *l, const gn_points *points, int32_t i, const gn_wide_plane *plane, int32_t column,
                   int32_t row)
{
    int32_t fine[2];
    gn_find_fine(l->grid, column, row, fine);
    int64_t depth = gn_wide_depth(plane, fine[0], fine[1]);
    depth -= gn_wide_slack(l, points, i, find_spread(l->grid, column, row));
    return gn_cut(gn_saturate(depth)) > l->map[(uint32_t)row * l->stride + (uint32_t)column];
}

/* The texel that holds the point decides. Where all four about it have voted for shadow, any of them will do. */
static uint32_t sample(const gn_lookup *l, gn_points *points, int32_t i, const gn_wide_plane *plane)
{
    int32_t column = (int32_t)gn_texel(points->u[i], l->last_column, l->bits);
    int32_t row = (int32_t)gn_texel(points->v[i], l->last_row, l->bits);
    if (is_dark(l, points, i, plane, column, row))
        return GN_DARK;
    if (!l->context->settings.receiver->votes || points->dark[i] != GN_DARK)
        return 0;
    column = (int32_t)gn_first_of_two(points->u[i], l->last_column, l->bits);
    row = (int32_t)gn_first_of_two(points->v[i], l->last_row, l->bits);
    for (int32_t k = 0; k < 4; k++)
        if (is_dark(l, points, i, plane, column + (k & 1), row + (k >> 1)))
            return GN_DARK;
    return 0;
}

/* ---- view pass --------------------------------------------------------------------------------------------------- */

static uint64_t texels(const gn_settings *s)
{
    return (uint64_t)s->map_width * s->map_height;
}

uint64_t gn_nonorthogonal_bytes(const gn_settings *s)
{
    return 4 * texels(s);
}

static uint64_t bytes(const gn_settings *s)
{
    return 2 * (texels(s) + (texels(s) & 1)) +
           8 * (uint64_t)(s->map_width > s->map_height ? s->map_width : s->map_height);
}

static void clear(const gn_settings *s, void *sums)
{
    uint16_t *count = sums;
    for (uint32_t i = 0; i < texels(s); i++)
        count[i] = 0;
}

static void merge(const gn_settings *s, void *sums, const void *other)
{
    uint16_t *count = sums;
    const uint16_t *more = other;
    for (uint32_t i = 0; i < texels(s); i++)
        count[i] = (uint16_t)(count[i] + more[i] > 65535 ? 65535 : count[i] + more[i]);
}

GN_INLINE void count_one(uint16_t *count)
{
    *count = (uint16_t)(*count + (*count < 65535));
}

/* Of each band, by columns. */
static void add_across(const gn_context *context, void *sums, const gn_points *points, const uint32_t *w)
{
    uint32_t bits = gn_point_bits(context), width = context->settings.map_width;
    uint16_t *count = sums;
    (void)w;
    for (int32_t i = 0; i < points->count; i++) {
        if (points->u[i] == GN_NOWHERE)
            continue;
        int32_t line = gn_band(context->grid, (int32_t)gn_texel(points->v[i], GN_FINE - 1, bits));
        count_one(&count[(uint32_t)line * width + gn_bin(gn_share(points->u[i], bits), width)]);
    }
}

/* Of each column, once the bands are bent, by bands. */
static void add_down(const gn_context *context, void *sums, const gn_points *points, const uint32_t *w)
{
    uint32_t bits = gn_point_bits(context), height = context->settings.map_height;
    uint16_t *count = sums;
    gn_interval between = {0};
    (void)w;
    for (int32_t i = 0; i < points->count; i++) {
        uint32_t u = points->u[i];
        if (u == GN_NOWHERE)
            continue;
        uint32_t column = gn_find_bent_column(context->grid, &u, points->v[i], bits, &between);
        count_one(&count[column * height + gn_bin(gn_share(points->v[i], bits), height)]);
    }
}

/* What follows the sums, for bending. */
static uint32_t *scratch_of(const gn_settings *s, void *sums)
{
    return (uint32_t *)sums + (size_t)((texels(s) + 1) / 2);
}

static gn_q16_16 smoothing_of(const gn_settings *s)
{
    return s->smoothing ? s->smoothing : 1 << 16;
}

static void end_across(gn_context *context, void *sums)
{
    const gn_settings *s = &context->settings;
    gn_bend_lines(context->fitting->columns, s->map_width, sums, s->map_height, s->map_width, smoothing_of(s),
                  scratch_of(s, sums));
}

static void end_down(gn_context *context, void *sums)
{
    const gn_settings *s = &context->settings;
    gn_bend_lines(context->fitting->rows, s->map_height, sums, s->map_width, s->map_height, smoothing_of(s),
                  scratch_of(s, sums));
}

void gn_lay_out_nonorthogonal(gn_context *context, uint16_t *tables)
{
    gn_fitting *fitting = context->fitting;
    fitting->columns = tables;
    fitting->rows = tables + (size_t)texels(&context->settings);
    fitting->grid.across = fitting->columns;
    fitting->grid.down = fitting->rows;
    fitting->grid.aim = aim;
    fitting->grid.walk = walk;
    fitting->grid.place = place;
    fitting->grid.sample = sample;
    fitting->grid.doubt = doubt;
    context->grid = &fitting->grid;
}

const gn_round gn_rounds_of_bands[2] = {{bytes, clear, add_across, merge, end_across},
                                        {bytes, clear, add_down, merge, end_down}};
const gn_warp gn_nonorthogonal = {
    &gn_fit_and_warp, gn_nonorthogonal_bytes, gn_lay_out_nonorthogonal, gn_rounds_of_bands, 2, 1};
