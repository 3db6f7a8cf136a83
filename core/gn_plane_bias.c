/* Receiver-plane bias: the point is compared as if it lay nearer to the light by settings.slope times h, the most that
 * its own plane rises within half a texel of it, h = (|dz/du| + |dz/dv|) / 2. A rival of virtual samples that needs
 * the same plane at every pixel, and a factor that somebody chooses: 1 for the nearest texel, more for wider filters.
 * On a warped map the texel is as large as its neighbours lie apart, in the mean of both sides. */
#include "gn_around.h"

/* slope rise in units of z. */
static uint32_t bias_of(int64_t rise, uint32_t slope)
{
    uint64_t bias = gn_multiply_u(gn_saturate(rise), slope) >> 16;
    return bias >> 32 ? 0xffffffffu : (uint32_t)bias;
}

/* Twice the size of a texel along one axis, in fine texels; at the border by the one neighbour that there is. */
static int64_t twice_size(const uint16_t *centres, uint32_t texel, uint32_t last)
{
    if (texel == 0 || texel == last)
        return 2 * (texel ? centres[last] - centres[last - 1] : centres[1] - centres[0]);
    return centres[texel + 1] - centres[texel - 1];
}

/* What a plane of fine texels rises within half a texel. */
static int64_t rise_on_grid(const gn_context *context, const gn_wide_plane *plane, uint32_t u, uint32_t v)
{
    const gn_grid *grid = context->grid;
    uint32_t bits = gn_point_bits(context);
    uint32_t last_column = context->settings.map_width - 1u, last_row = context->settings.map_height - 1u;
    return gn_rise(plane->dx * twice_size(grid->columns, gn_texel(u, last_column, bits), last_column),
                   plane->dy * twice_size(grid->rows, gn_texel(v, last_row, bits), last_row)) /
           2;
}

static void move_nearer(const gn_context *context, gn_worker *worker, gn_points *points)
{
    uint32_t last = GN_NO_TRIANGLE, last_face = 0, bias = 0;
    const int many_faces = context->point_light, on_grid = context->grid != 0;
    for (int32_t i = 0; i < points->count; i++) {
        if (points->triangle[i] == GN_NO_TRIANGLE || points->u[i] == GN_NOWHERE)
            continue;
        uint32_t face = many_faces ? gn_face_of(context, points, i) : 0;
        if (points->triangle[i] != last || face != last_face || on_grid) {
            last = points->triangle[i];
            last_face = face;
            const gn_wide_plane *plane = &gn_find_plane(context, worker, last, face)->plane;
            int64_t rise =
                on_grid ? rise_on_grid(context, plane, points->u[i], points->v[i]) : gn_rise(plane->dx, plane->dy);
            bias = bias_of(rise, (uint32_t)context->settings.slope);
        }
        points->z[i] = points->z[i] > bias ? points->z[i] - bias : 0;
    }
}

static const gn_reconstruction nearest = {gn_cascade_row, gn_vote_nearest, 0, 0, GN_DARK, 1, 0, 0, 0};
const gn_receiver gn_plane_bias = {gn_cascade_row, move_nearer, 0, 0, 0, &nearest, 1};
