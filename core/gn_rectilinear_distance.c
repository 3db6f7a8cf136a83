/* The rectilinear warp that is driven by distance to the eye (Rosen 2012): a column or a row of texels is as important
 * as its nearest sample is near. An orthographic camera is equally far from everything. Sums: eight bytes a column and
 * a row. */
#include "gn_rectilinear.h"
#include "gn_warp_table.h"

static uint64_t words(const gn_settings *s)
{
    return (uint64_t)s->map_width + s->map_height;
}

static uint64_t bytes(const gn_settings *s)
{
    return 12 * words(s) + 4 * gn_warp_scratch(s);
}

static void clear(const gn_settings *s, void *sums)
{
    uint64_t *least = sums;
    for (uint32_t i = 0; i < words(s); i++)
        least[i] = UINT64_MAX;
}

/* How far a pixel is from the image's centre, as a tangent with 12 fraction bits, squared. Pixels count from the centre
 * in halves. */
static uint64_t tangent_squared(const gn_camera *camera, const gn_settings *s, int32_t halves)
{
    uint32_t step = camera->tan_half / s->height;
    uint32_t tangent = (uint32_t)(gn_multiply_u((uint32_t)(halves < 0 ? -halves : halves), step) >> 12);
    return gn_multiply_u(tangent, tangent);
}

/* 1 + tangent^2 of a pixel's ray, 24 fraction bits less those that leave 19 bits for the corner's. */
static uint32_t ray_squared(const gn_context *context, int32_t x, int32_t y, unsigned shift)
{
    const gn_settings *s = &context->settings;
    uint64_t squared = (1u << 24) + tangent_squared(&context->camera, s, 2 * x + 1 - s->width) +
                       tangent_squared(&context->camera, s, 2 * y + 1 - s->height);
    return (uint32_t)(squared >> shift);
}

static unsigned find_shift(const gn_context *context)
{
    const gn_settings *s = &context->settings;
    uint64_t corner =
        (1u << 24) + tangent_squared(&context->camera, s, s->width) + tangent_squared(&context->camera, s, s->height);
    unsigned shift = 0;
    while (corner >> shift >= 1u << 19)
        shift++;
    return shift;
}

static void add(const gn_context *context, void *sums, const gn_points *points, const uint32_t *w)
{
    uint32_t bits = gn_point_bits(context), width = context->settings.map_width, height = context->settings.map_height;
    uint64_t *columns = sums, *rows = columns + width;
    int perspective = !context->camera_view.affine;
    unsigned shift = perspective ? find_shift(context) : 0;
    for (int32_t i = 0; i < points->count; i++) {
        uint64_t squared = 1;
        if (points->u[i] == GN_NOWHERE)
            continue;
        if (perspective) /* below 2^63 */
            squared = (gn_multiply_u(w[i], w[i]) >> 18) * ray_squared(context, points->x + i, points->y, shift);
        uint64_t *column = &columns[gn_bin(gn_share(points->u[i], bits), width)];
        uint64_t *row = &rows[gn_bin(gn_share(points->v[i], bits), height)];
        *column = squared < *column ? squared : *column;
        *row = squared < *row ? squared : *row;
    }
}

static void merge(const gn_settings *s, void *sums, const void *other)
{
    uint64_t *least = sums;
    const uint64_t *also = other;
    for (uint32_t i = 0; i < words(s); i++)
        least[i] = also[i] < least[i] ? also[i] : least[i];
}

static void end(gn_context *context, void *sums)
{
    const gn_settings *s = &context->settings;
    const uint64_t *least = sums;
    uint32_t *distance = (uint32_t *)sums + 2 * words(s);
    uint32_t *scratch = distance + words(s);
    for (uint32_t i = 0; i < words(s); i++) {
        uint32_t root = least[i] == UINT64_MAX ? 0xffffffffu : gn_square_root(least[i]);
        distance[i] = root ? root : 1;
    }
    gn_importance_of_distances(distance, s->map_width);
    gn_importance_of_distances(distance + s->map_width, s->map_height);
    gn_end_rectilinear(context, distance, scratch);
}

static const gn_round round = {bytes, clear, add, merge, end};
const gn_warp gn_rectilinear_distance = {&gn_fit_and_warp, gn_rectilinear_bytes, gn_lay_out_rectilinear, &round, 1, 0};
