/* The constants of a pair of camera and light, from which gn_shade.c finds a pixel's place in light space. */
#include "gn_context.h"

/* A world function before rounding: at the centre of the image, and its steps. */
typedef struct affine {
    gn_scaled centre, dx, dy;
} affine;

typedef struct expression {
    affine a, b;
} expression;

/* Smallest n with |v| <= 2^n all over the image. */
static int32_t extent_bits(const affine *v, const gn_settings *settings)
{
    gn_scaled x = gn_scaled_multiply(gn_scaled_magnitude(v->dx), gn_scale(settings->width, -1));
    gn_scaled y = gn_scaled_multiply(gn_scaled_magnitude(v->dy), gn_scale(settings->height, -1));
    return gn_scaled_bits(gn_scaled_add(gn_scaled_magnitude(v->centre), gn_scaled_add(x, y)));
}

static gn_scaled along(const gn_row *row, const gn_q2_30 axis[3])
{
    int64_t dot = gn_multiply(row->m[0], axis[0]) + gn_multiply(row->m[1], axis[1]) + gn_multiply(row->m[2], axis[2]);
    return gn_scale(dot, -30 - row->shift);
}

/* (row + origin) 2^exponent as a function of pixel and W. */
static expression make_expression(const gn_context *context, const gn_row *row, int64_t origin, int32_t exponent,
                                  gn_scaled w_unit)
{
    const gn_camera *camera = &context->camera;
    gn_scaled height = gn_scale(context->settings.height, 0);
    int64_t half = row->shift ? (int64_t)1 << (row->shift - 1) : 0;
    int64_t at_eye = row->offset - half + gn_multiply(row->m[0], camera->eye[0]) +
                     gn_multiply(row->m[1], camera->eye[1]) + gn_multiply(row->m[2], camera->eye[2]);
    gn_scaled zero = {0, 0};
    gn_scaled base = gn_scaled_shift(gn_scaled_add(gn_scale(at_eye, -row->shift), gn_scale(origin, 0)), exponent);
    gn_scaled forward = gn_scaled_shift(along(row, camera->forward), exponent);
    gn_scaled right = gn_scaled_shift(along(row, camera->right), exponent);
    gn_scaled up = gn_scaled_shift(along(row, camera->up), exponent);
    expression e = {{base, zero, zero}, {zero, zero, zero}};
    if (camera->projection == GN_PERSPECTIVE) {
        /* a pixel is 2 tan / height wide and high at w = 1 */
        gn_scaled pixel = gn_scaled_multiply(gn_scaled_divide(gn_scale(camera->tan_half, -23), height), w_unit);
        e.b.centre = gn_scaled_multiply(forward, w_unit);
        e.b.dx = gn_scaled_multiply(right, pixel);
        e.b.dy = gn_scaled_negate(gn_scaled_multiply(up, pixel));
    } else {
        gn_scaled pixel = gn_scaled_divide(gn_scale(camera->half_height, 1), height);
        gn_scaled far_depth = gn_scaled_add(gn_scale(camera->far_depth, 0), gn_scaled_shift(w_unit, 10));
        e.a.centre = gn_scaled_add(base, gn_scaled_multiply(forward, far_depth));
        e.a.dx = gn_scaled_multiply(right, pixel);
        e.a.dy = gn_scaled_negate(gn_scaled_multiply(up, pixel));
        e.b.centre = gn_scaled_negate(gn_scaled_multiply(forward, w_unit));
    }
    return e;
}

static gn_scaled half_sum(gn_scaled x, gn_scaled y)
{
    return gn_scaled_shift(gn_scaled_add(x, y), -1);
}

static void half_sum_affine(affine *x, const affine *y)
{
    x->centre = half_sum(x->centre, y->centre);
    x->dx = half_sum(x->dx, y->dx);
    x->dy = half_sum(x->dy, y->dy);
}

/* Most fraction bits with |a| <= 2^30 and |b| 2^32 <= 2^30 over the image. */
static int32_t fraction_bits(const expression *e, const gn_settings *settings, int32_t most)
{
    int32_t a = 30 - extent_bits(&e->a, settings);
    int32_t b = -2 - extent_bits(&e->b, settings);
    most = a < most ? a : most;
    return b < most ? b : most;
}

/* Steps are rounded once; the value is exact at the centre of the image, so steps err by half the image at most. */
static uint32_t round_affine(const affine *v, int32_t exponent, const gn_settings *settings, uint32_t *step_x,
                             uint32_t *step_y)
{
    int64_t x = gn_scaled_round(v->dx, exponent), y = gn_scaled_round(v->dy, exponent);
    *step_x = (uint32_t)x;
    *step_y = (uint32_t)y;
    int64_t to_corner = x * (settings->width - 1) + y * (settings->height - 1);
    return (uint32_t)(gn_scaled_round(v->centre, exponent) - gn_floor_shift_64(to_corner, 1));
}

static gn_linear round_expression(const expression *e, int32_t bits, const gn_settings *settings)
{
    gn_linear l;
    l.a = round_affine(&e->a, -bits, settings, &l.a_dx, &l.a_dy);
    l.b = round_affine(&e->b, -bits - 32, settings, &l.b_dx, &l.b_dy);
    return l;
}

/* World units a unit of W: perspective: near 2^w_shift / 2^31; orthographic: of Q. */
static gn_scaled make_w_unit(gn_context *context, int32_t largest_w)
{
    const gn_view *view = &context->camera_view;
    gn_shading *shading = &context->shading;
    shading->w_shift = 0;
    shading->nothing = 1; /* every surface has Q >= 2^10 */
    if (view->affine) {
        int32_t range = context->camera.far_depth - context->camera.near_depth;
        return gn_scaled_divide(gn_scale(range, 0), gn_scale((1 << 30) - (1 << 10), 0));
    }
    /* W stays below 2^31 up to the farthest visible point, with 1/64 to spare for the rounding of Q. */
    int64_t farthest = largest_w < view->far_w ? largest_w : view->far_w;
    farthest += farthest / 64 + 1;
    while ((int64_t)view->near_w << shading->w_shift <= farthest)
        shading->w_shift++;
    /* below every Q of a surface by 1/64, and W = 2^31 */
    shading->nothing = 1u << (30 - shading->w_shift);
    return gn_scaled_divide(gn_scale(view->near_w, shading->w_shift - 31), view->unit);
}

void gn_set_farthest(gn_context *context, int32_t largest_w)
{
    (void)make_w_unit(context, largest_w);
}

gn_status gn_make_shading(gn_context *context, int32_t largest_w)
{
    const gn_view *light = &context->light_view;
    const gn_settings *settings = &context->settings;
    gn_shading *shading = &context->shading;
    gn_scaled w_unit = make_w_unit(context, largest_w);
    expression e[3];
    shading->trusted = context->light_trusted;
    if (light->affine) {
        e[0] = make_expression(context, &light->row[0], light->centre_x, -8, w_unit);
        e[1] = make_expression(context, &light->row[1], light->centre_y, -8, w_unit);
        e[2] = make_expression(context, &light->row[2], light->near_w, -15, w_unit);
        int32_t position = fraction_bits(&e[1], settings, fraction_bits(&e[0], settings, 18));
        int32_t depth = fraction_bits(&e[2], settings, 14);
        if (position < 0 || depth < 0)
            return GN_OUT_OF_RANGE;
        shading->position_bits = (uint8_t)position;
        shading->depth_bits = (uint8_t)depth;
        shading->coordinate[0] = round_expression(&e[0], position, settings);
        shading->coordinate[1] = round_expression(&e[1], position, settings);
        shading->coordinate[2] = round_expression(&e[2], depth, settings);
        return GN_OK;
    }
    e[2] = make_expression(context, &light->row[2], 0, 0, w_unit);
    for (int i = 0; i < 2; i++) {
        e[i] = make_expression(context, &light->row[i], 0, 0, w_unit);
        half_sum_affine(&e[i].a, &e[2].a);
        half_sum_affine(&e[i].b, &e[2].b);
    }
    int32_t bits = 8;
    for (int i = 0; i < 3; i++)
        bits = fraction_bits(&e[i], settings, bits);
    for (int i = 0; i < 3; i++)
        shading->coordinate[i] = round_expression(&e[i], bits, settings);
    int64_t near_w = gn_scaled_round(gn_scale(light->near_w, 0), -bits);
    int64_t far_w = gn_scaled_round(gn_scale(light->far_w, 0), -bits);
    if (near_w < 1 || near_w > 0x7fffffff)
        return GN_OUT_OF_RANGE;
    shading->near_w = (uint32_t)near_w;
    far_w += far_w / (1 << 17) + 1; /* a surface in the far plane is inside: w has 18 good bits */
    shading->far_w = far_w > 0x7fffffff ? 0x7fffffffu : (uint32_t)far_w;
    return GN_OK;
}
