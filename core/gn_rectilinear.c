/* The rectilinear warp that is driven by how many samples of the view a column and a row of texels has: texels go where
 * the pixels are. Sums: four bytes a column and a row. */
#include "gn_warp_table.h"
#include "gn_warps.h"

static void clear(const gn_settings *s, void *sums)
{
    uint32_t *count = sums;
    for (uint32_t i = 0; i < gn_warp_lines(s); i++)
        count[i] = 0;
}

static void add(const gn_context *context, void *sums, const gn_points *points, const uint32_t *w)
{
    uint32_t bits = gn_point_bits(context), width = context->settings.map_width, height = context->settings.map_height;
    uint32_t *columns = sums, *rows = columns + width;
    (void)w;
    for (int32_t i = 0; i < points->count; i++) {
        if (points->u[i] == GN_NOWHERE)
            continue;
        columns[gn_bin(gn_share(points->u[i], bits), width)]++;
        rows[gn_bin(gn_share(points->v[i], bits), height)]++;
    }
}

static void merge(const gn_settings *s, void *sums, const void *other)
{
    uint32_t *count = sums;
    const uint32_t *more = other;
    for (uint32_t i = 0; i < gn_warp_lines(s); i++)
        count[i] += more[i];
}

static void end(gn_context *context, void *sums)
{
    const gn_settings *s = &context->settings;
    uint32_t *count = sums;
    gn_importance_of_counts(count, s->map_width);
    gn_importance_of_counts(count + s->map_width, s->map_height);
    gn_end_rectilinear(context, count);
}

const gn_round gn_round_of_counts = {gn_rectilinear_sums, clear, add, merge, end};
const gn_warp gn_rectilinear = {
    &gn_fit_and_warp, gn_rectilinear_bytes, gn_lay_out_rectilinear, &gn_round_of_counts, 1, 0};
