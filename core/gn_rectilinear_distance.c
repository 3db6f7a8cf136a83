/* The rectilinear warp that is driven by distance to the eye (Rosen 2012): a column or a row of texels is as important
 * as its nearest sample is near. Distance is depth along the view, by which pixels shrink; an orthographic camera is
 * equally far from everything. Sums: four bytes a column and a row. */
#include "gn_warp_table.h"
#include "gn_warps.h"

static void clear(const gn_settings *s, void *sums)
{
    uint32_t *least = sums;
    for (uint32_t i = 0; i < gn_warp_lines(s); i++)
        least[i] = UINT32_MAX;
}

static void add(const gn_context *context, void *sums, const gn_points *points, const uint32_t *w)
{
    uint32_t bits = gn_point_bits(context), width = context->settings.map_width, height = context->settings.map_height;
    uint32_t *columns = sums, *rows = columns + width;
    int perspective = !context->camera_view.affine;
    for (int32_t i = 0; i < points->count; i++) {
        if (points->u[i] == GN_NOWHERE)
            continue;
        uint32_t distance = perspective ? w[i] : 1;
        uint32_t *column = &columns[gn_bin(gn_share(points->u[i], bits), width)];
        uint32_t *row = &rows[gn_bin(gn_share(points->v[i], bits), height)];
        *column = distance < *column ? distance : *column;
        *row = distance < *row ? distance : *row;
    }
}

static void merge(const gn_settings *s, void *sums, const void *other)
{
    uint32_t *least = sums;
    const uint32_t *also = other;
    for (uint32_t i = 0; i < gn_warp_lines(s); i++)
        least[i] = also[i] < least[i] ? also[i] : least[i];
}

/* A fit's border has no samples: it is as important as what lies beside it, or it would all but vanish. */
static void keep_border(const gn_context *context, uint32_t *importance, uint32_t count)
{
    if (!context->settings.fit || count < 3)
        return;
    importance[0] = importance[0] > importance[1] ? importance[0] : importance[1];
    importance += count - 2;
    importance[1] = importance[1] > importance[0] ? importance[1] : importance[0];
}

static void end(gn_context *context, void *sums)
{
    const gn_settings *s = &context->settings;
    uint32_t *distance = sums;
    gn_importance_of_distances(distance, s->map_width);
    gn_importance_of_distances(distance + s->map_width, s->map_height);
    keep_border(context, distance, s->map_width);
    keep_border(context, distance + s->map_width, s->map_height);
    gn_end_rectilinear(context, distance);
}

static const gn_round round = {gn_rectilinear_sums, clear, add, merge, end};
const gn_warp gn_rectilinear_distance = {&gn_fit_and_warp, gn_rectilinear_bytes, gn_lay_out_rectilinear, &round, 1, 0};
