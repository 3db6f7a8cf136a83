/* The minimal shadow frustum (MSF, Stamminger & Drettakis 2002): the smallest rectangle, at any angle, about what the
 * camera sees of the light's plane. Sums: 16 KiB, the extent of the samples in each of 4096 columns of the plane. */
#include "gn_hull.h"
#include "gn_parameterisation.h"

static uint64_t bytes(const gn_settings *settings)
{
    (void)settings;
    return GN_HULL_COLUMNS * sizeof(gn_extent);
}

static void clear(const gn_settings *settings, void *sums)
{
    (void)settings;
    gn_clear_extents(sums);
}

static void add(const gn_context *context, void *sums, const gn_points *points, const uint32_t *w)
{
    uint32_t bits = gn_point_bits(context);
    (void)w;
    for (int32_t i = 0; i < points->count; i++)
        if (points->u[i] != GN_NOWHERE)
            gn_add_extent(sums, gn_share(points->u[i], bits), gn_share(points->v[i], bits));
}

static void merge(const gn_settings *settings, void *sums, const void *other)
{
    (void)settings;
    gn_merge_extents(sums, other);
}

static void end(gn_context *context, void *sums)
{
    gn_rectangle r;
    if (gn_find_rectangle(&r, sums))
        gn_set_rectangle(context, &r);
    else /* nothing is seen */
        gn_whole_plane(&context->fitting->rectangle, &context->fitting->light);
}

const gn_fit gn_minimal_frustum = {&gn_fit_and_warp, {bytes, clear, add, merge, end}};
