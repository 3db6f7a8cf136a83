/* The points of a block of pixels in light space: place on the map and depth, for any camera and light. What gn_shade.c
 * does in one go for the nearest texel, up to the look-up.
 *
 * Points outside a directional light's box are lit, outside a spot light's frustum shadowed; neither has a texel. */
#include "gn_cascade.h"
#include "gn_shade.h"

/* Never below 8, so that a place within a texel has a meaning; spot lights have all there is. */
uint32_t gn_point_bits(const gn_context *context)
{
    if (context->light.kind == GN_SPOT)
        return 18;
    return context->shading.position_bits < 8 ? 8 : context->shading.position_bits;
}

static void find_directional(const gn_context *context, gn_points *points, const uint32_t *q)
{
    const gn_shading *s = &context->shading;
    const gn_linear *c = s->coordinate;
    int32_t x = points->x, y = points->y, count = points->count;
    uint32_t depth_shift = 16u - s->depth_bits;
    gn_runner u = gn_start_row(&c[0], x, y), v = gn_start_row(&c[1], x, y), z = gn_start_row(&c[2], x, y);
    if (context->camera_view.affine) {
        for (int32_t i = 0; i < count; i++) {
            points->u[i] = gn_step(&u, q[i]);
            points->v[i] = gn_step(&v, q[i]);
            points->z[i] = gn_step(&z, q[i]);
        }
    } else {
        for (int32_t i = 0; i < count; i++) { /* only b varies over the image */
            uint32_t w = q[i], step = (uint32_t)i;
            points->u[i] = u.a + gn_w_product(w, u.b + step * u.b_dx);
            points->v[i] = v.a + gn_w_product(w, v.b + step * v.b_dx);
            points->z[i] = z.a + gn_w_product(w, z.b + step * z.b_dx);
        }
    }
    if (!s->trusted) {
        for (int32_t i = 0; i < count; i++) {
            uint32_t limit = 0x10000u << s->depth_bits;
            if (points->u[i] >> s->position_bits >= context->settings.map_width ||
                points->v[i] >> s->position_bits >= context->settings.map_height || points->z[i] >> 31) {
                points->u[i] = GN_NOWHERE;
                points->z[i] = 0;
            } else if (points->z[i] >= limit) { /* behind the box: compared at the far end of the range */
                points->z[i] = limit - 1;
            }
        }
    }
    uint32_t shift = gn_point_bits(context) - s->position_bits;
    for (int32_t i = 0; i < count; i++)
        points->z[i] <<= depth_shift;
    for (int32_t i = 0; shift && i < count; i++) {
        points->u[i] = points->u[i] == GN_NOWHERE ? GN_NOWHERE : points->u[i] << shift;
        points->v[i] <<= shift;
    }
}

static void find_spot(const gn_context *context, gn_points *points, uint32_t *q)
{
    const gn_shading *s = &context->shading;
    const gn_view *light = &context->light_view;
    int32_t x = points->x, y = points->y;
    gn_runner u = gn_start_row(&s->coordinate[0], x, y), v = gn_start_row(&s->coordinate[1], x, y),
              d = gn_start_row(&s->coordinate[2], x, y);
    uint32_t width = context->settings.map_width, height = context->settings.map_height;
    for (int32_t i = 0; i < points->count; i++) {
        uint32_t w = q[i], left = gn_step(&u, w), top = gn_step(&v, w), distance = gn_step(&d, w);
        q[i] = 0;
        points->u[i] = GN_NOWHERE;
        points->z[i] = 1;
        if (distance - s->near_w > s->far_w - s->near_w || left >= distance || top >= distance)
            continue; /* outside the frustum: unlit */
        uint32_t nearness = gn_divide_place(s, &left, &top, distance);
        uint32_t z =
            GN_DEPTH_GUARD + (uint32_t)(gn_multiply_u(light->depth_scale, (1u << 30) - nearness) >> light->depth_shift);
        points->u[i] = (uint32_t)(gn_multiply_u(left, width) >> 12);
        points->v[i] = (uint32_t)(gn_multiply_u(top, height) >> 12);
        points->z[i] = 2 * (z > 0x7fffffffu ? 0x7fffffffu : z);
        q[i] = gn_over_distance(nearness, left, top, context->tan_squared);
    }
}

void gn_find_points(const gn_context *context, gn_points *points, uint32_t *q)
{
    if (context->light.kind == GN_SPOT)
        find_spot(context, points, q);
    else
        find_directional(context, points, q);
}
