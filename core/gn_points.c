/* The points of a block of pixels in light space: place on the map and depth, for any camera and light. What gn_shade.c
 * does in one go for the nearest texel, up to the look-up.
 *
 * Points outside a directional light's box are lit, outside a spot light's frustum shadowed; neither has a texel. */
#include "gn_cascade.h"
#include "gn_parameterisation.h"

/* Never below 8, so that a place within a texel has a meaning; spot lights have all there is. */
uint32_t gn_point_bits(const gn_context *context)
{
    if (context->light.kind == GN_SPOT)
        return context->point_light ? GN_FACE_BITS : 18;
    return context->shading.position_bits < 8 ? 8 : context->shading.position_bits;
}

/* Of the light's view: of the map, or a warped map's fine ones. */
static uint32_t columns_of(const gn_context *context)
{
    return (uint32_t)context->light_view.half_width >> 7;
}

static uint32_t rows_of(const gn_context *context)
{
    return (uint32_t)context->light_view.half_height >> 7;
}

/* A box that need not hold every point; u and v are less by half a texel. */
static void test_box(const gn_context *context, gn_points *points, uint32_t half)
{
    uint32_t bits = context->shading.depth_bits, width = columns_of(context), height = rows_of(context);
    for (int32_t i = 0; i < points->count; i++) {
        int outside = gn_outside_box(context->shading.position_bits, width, height, points->u[i] + half,
                                     points->v[i] + half, points->z[i]);
        points->u[i] = outside ? GN_NOWHERE : points->u[i];
        points->z[i] = outside ? 0 : gn_hold_depth(points->z[i], bits) << (16u - bits);
    }
}

/* Views so large that a place has fewer bits than 8. */
static void widen(gn_points *points, uint32_t shift, uint32_t half)
{
    for (int32_t i = 0; i < points->count; i++) {
        points->u[i] = points->u[i] == GN_NOWHERE ? GN_NOWHERE : (points->u[i] << shift) - half;
        points->v[i] = (points->v[i] << shift) - half;
    }
}

/* Half a texel in the bits of u and v; 0 where widen takes it away. */
static uint32_t half_texel(const gn_context *context)
{
    uint32_t bits = gn_point_bits(context);
    return bits == context->shading.position_bits ? (uint32_t)1 << (bits - 1) : 0;
}

static void find_directional(const gn_context *context, gn_points *points, const uint32_t *q)
{
    const gn_shading *s = &context->shading;
    int32_t count = points->count;
    uint32_t bits = gn_point_bits(context), depth_shift = s->trusted ? 16u - s->depth_bits : 0;
    gn_runner u = points->row[0], v = points->row[1], z = points->row[2];
    if (context->camera_view.affine) {
        for (int32_t i = 0; i < count; i++) {
            points->u[i] = gn_step(&u, q[i]);
            points->v[i] = gn_step(&v, q[i]);
            points->z[i] = gn_step(&z, q[i]) << depth_shift;
        }
    } else {
        for (int32_t i = 0; i < count; i++) { /* only b varies over the image */
            uint32_t w = q[i], step = (uint32_t)i;
            points->u[i] = u.a + gn_w_product(w, u.b + step * u.b_dx);
            points->v[i] = v.a + gn_w_product(w, v.b + step * v.b_dx);
            points->z[i] = (z.a + gn_w_product(w, z.b + step * z.b_dx)) << depth_shift;
        }
    }
    if (!s->trusted)
        test_box(context, points, half_texel(context));
    if (bits != s->position_bits)
        widen(points, bits - s->position_bits, (uint32_t)1 << (bits - 1));
}

static void find_spot(const gn_context *context, gn_points *points, uint32_t *q)
{
    const gn_shading *s = &context->shading;
    const gn_view *light = &context->light_view;
    gn_runner u = points->row[0], v = points->row[1], d = points->row[2];
    const uint32_t width = columns_of(context), height = rows_of(context);
    for (int32_t i = 0; i < points->count; i++) {
        uint32_t w = q[i], left = gn_step(&u, w), top = gn_step(&v, w), distance = gn_step(&d, w);
        q[i] = 0;
        points->u[i] = GN_NOWHERE;
        points->z[i] = 0xffffffffu;
        if (gn_outside_frustum(s, left, top, distance))
            continue; /* unlit */
        uint32_t nearness = gn_divide_place(s, &left, &top, distance);
        uint32_t u_on_map = (uint32_t)(gn_multiply_u(left, width) >> 12) - GN_SPOT_HALF;
        uint32_t v_on_map = (uint32_t)(gn_multiply_u(top, height) >> 12) - GN_SPOT_HALF;
        if (context->fitting && !context->fitting->find_place(context->fitting, &left, &top))
            continue;
        points->u[i] = u_on_map;
        points->v[i] = v_on_map;
        points->z[i] = gn_spot_depth(light, nearness);
        q[i] = gn_over_distance(nearness, left, top, context->tan_squared);
    }
}

void gn_start_points(const gn_context *context, gn_points *points)
{
    for (int i = 0; i < 3; i++)
        points->row[i] = gn_start_row(&context->shading.coordinate[i], points->x, points->y);
    if (context->light.kind == GN_SPOT)
        return;
    points->row[0].a -= half_texel(context);
    points->row[1].a -= half_texel(context);
}

void gn_find_points(const gn_context *context, gn_points *points, uint32_t *q)
{
    if (context->point_light)
        context->settings.faces->find_points(context, points, q);
    else if (context->light.kind == GN_SPOT)
        find_spot(context, points, q);
    else
        find_directional(context, points, q);
    gn_end_block(points);
}
