/* Receiver-plane bias: the point is compared as if it lay nearer to the light by settings.slope times h, the most that
 * its own plane rises within half a texel of it, h = (|dz/du| + |dz/dv|) / 2. A rival of virtual samples that needs
 * the same plane at every pixel, and a factor that somebody chooses: 1 for the nearest texel, more for wider filters.
 */
#include "gn_cascade.h"

/* slope h in units of z. */
static uint32_t bias_of(const gn_wide_plane *plane, uint32_t slope)
{
    uint64_t bias = gn_multiply_u(gn_saturate(gn_rise(plane->dx, plane->dy)), slope) >> 16;
    return bias >> 32 ? 0xffffffffu : (uint32_t)bias;
}

static void move_nearer(const gn_context *context, gn_worker *worker, gn_points *points)
{
    uint32_t last = GN_NO_TRIANGLE, bias = 0;
    for (int32_t i = 0; i < points->count; i++) {
        if (points->triangle[i] == GN_NO_TRIANGLE || points->u[i] == GN_NOWHERE)
            continue;
        if (points->triangle[i] != last) {
            last = points->triangle[i];
            bias = bias_of(&gn_find_plane(context, worker, last)->plane, (uint32_t)context->settings.slope);
        }
        points->z[i] = points->z[i] > bias ? points->z[i] - bias : 0;
    }
}

static void vote_nearest(const gn_lookup *l, gn_points *points)
{
    for (int32_t i = 0; i < points->count; i++) {
        uint32_t column = gn_texel(points->u[i], l->last_column, l->bits);
        uint32_t row = gn_texel(points->v[i], l->last_row, l->bits);
        if (points->u[i] == GN_NOWHERE)
            points->dark[i] = gn_dark_nowhere(l, points->z[i]);
        else
            points->dark[i] = gn_cut(points->z[i]) <= l->map[row * l->stride + column] ? 0 : GN_DARK;
    }
}

static const gn_reconstruction nearest = {gn_cascade_row, vote_nearest, 0, 0, GN_DARK, 1, 0, 0, 0};
const gn_receiver gn_plane_bias = {gn_cascade_row, move_nearer, 0, 0, 0, &nearest, 1};
