/* Cameras, lights and model matrices, as the application sets them up.
 *
 * Axes of a view along d with up vector u: F = d / |d|, R = (d x u) / |d x u|, up' = R x F, which makes R x up' = -F.
 * The first cross product is taken of the caller's integers, exactly, so an up vector however close to the view loses
 * nothing. Axes are Q2.30: each component is within 2^-28 of the exact one (forward: 2^-30), each length within 2^-28
 * of 1, each two axes' dot product within 2^-29 of 0.
 *
 * Model matrices: m is composed exactly in 64 bits and rounded once a call; t is rounded to whole world units a call,
 * so scale and rotate before you translate.
 *
 * No function here writes its result unless it returns GN_OK; vectors may be parts of the structure that is written.
 * Cost: a square root and 3 divisions an axis, 2800 instructions a view on Cortex-M4, 8300 on Cortex-M0; nothing here
 * is called per vertex or pixel. */
#include "gn_fixed.h"
#include "gn_trigonometry.h"
#include "gnomon.h"

#define ONE ((int32_t)1 << 30)             /* Q2.30 */
#define DEPTH_MAX ((int32_t)1 << 28)       /* of near and far, either sign */
#define HALF_HEIGHT_MAX ((int32_t)1 << 26) /* orthographic */
#define MODEL_MAX ((int32_t)1 << 30)       /* of |m| and |t| */
#define SHIFT_MAX 62
#define NEARLY_VERTICAL 1072668082 /* floor(0.999 2^30) */

struct axes {
    gn_q2_30 right[3], up[3], forward[3];
};

static void copy_vector(int32_t to[3], const int32_t from[3])
{
    for (int i = 0; i < 3; i++)
        to[i] = from[i];
}

/* Is each |v| <= limit? */
static int within(const int32_t v[3], int32_t limit)
{
    for (int i = 0; i < 3; i++) {
        if (v[i] < -limit || v[i] > limit)
            return 0;
    }
    return 1;
}

static uint64_t magnitude(int64_t v)
{
    return v < 0 ? 0 - (uint64_t)v : (uint64_t)v;
}

/* floor(v / 2^n + 1/2), 0 <= n <= 62, |v| < 2^63 - 2^61. */
static int64_t round_shift(int64_t v, unsigned n)
{
    return gn_floor_shift_64(v + (int64_t)((UINT64_C(1) << n) >> 1), n);
}

/* out = a x b, |a| |b| < 2^62 by component. */
static void cross(int64_t out[3], const int32_t a[3], const int32_t b[3])
{
    for (int i = 0; i < 3; i++) {
        int j = i < 2 ? i + 1 : 0, k = 3 - i - j;
        out[i] = gn_multiply(a[j], b[k]) - gn_multiply(a[k], b[j]);
    }
}

/* unit = v / |v|, |v| < 2^61 by component; 0, with nothing written, where v = 0. The components keep all their bits, so
 * what is lost beyond rounding to nearest (2^-31) lies along v: the length is known to 1.37 / 2^30 of itself. */
static int normalise(gn_q2_30 unit[3], const int64_t v[3])
{
    uint64_t n[3], all = 0, square = 0;
    for (int i = 0; i < 3; i++) {
        n[i] = magnitude(v[i]);
        all |= n[i];
    }
    if (!all)
        return 0;
    GN_ASSERT(all >> 61 == 0);
    unsigned shift = gn_leading_zeros_64(all) - 3; /* the largest is then in [2^60, 2^61) */
    for (int i = 0; i < 3; i++) {
        n[i] <<= shift;
        uint32_t high = (uint32_t)((n[i] + (UINT32_C(1) << 29)) >> 30); /* at most 2^31 */
        square += gn_multiply_u(high, high);
    }
    uint32_t length = gn_square_root(square); /* in [2^30, 2^31.8] */
    if (square - gn_multiply_u(length, length) > length)
        length++; /* nearest */
    for (int i = 0; i < 3; i++) {
        /* At most 1: the length is no less than this component's own upper half, which is rounded to nearest. */
        uint32_t component = gn_divide(n[i] + length / 2, length);
        GN_ASSERT(component <= (uint32_t)ONE);
        unit[i] = v[i] < 0 ? -(int32_t)component : (int32_t)component;
    }
    return 1;
}

/* Look along direction, |.| <= 2^28; up: |.| <= 2^27, or 0 for the default of lights. */
static gn_status set_axes(struct axes *axes, const int32_t direction[3], const int32_t up[3])
{
    int64_t v[3] = {direction[0], direction[1], direction[2]};
    if (!normalise(axes->forward, v))
        return GN_OUT_OF_RANGE;
    int vertical = magnitude(axes->forward[1]) > NEARLY_VERTICAL;
    int32_t default_up[3] = {0, !vertical, vertical};
    cross(v, direction, up ? up : default_up);
    if (!normalise(axes->right, v))
        return GN_OUT_OF_RANGE;
    cross(v, axes->right, axes->forward);
    normalise(axes->up, v);
    return GN_OK;
}

/* The same from eye to target. */
static gn_status set_axes_towards(struct axes *axes, const int32_t eye[3], const int32_t target[3], const int32_t up[3])
{
    int32_t direction[3];
    if (!within(eye, GN_EYE_MAX) || !within(target, GN_EYE_MAX) || (up && !within(up, GN_EYE_MAX)))
        return GN_OUT_OF_RANGE;
    for (int i = 0; i < 3; i++)
        direction[i] = target[i] - eye[i];
    return set_axes(axes, direction, up);
}

gn_status gn_look_at(gn_camera *camera, const int32_t eye[3], const int32_t target[3], const int32_t up[3])
{
    struct axes axes;
    if (!camera || !eye || !target || !up)
        return GN_BAD_ARGUMENT;
    gn_status status = set_axes_towards(&axes, eye, target, up);
    if (status != GN_OK)
        return status;
    copy_vector(camera->eye, eye);
    copy_vector(camera->right, axes.right);
    copy_vector(camera->up, axes.up);
    copy_vector(camera->forward, axes.forward);
    return GN_OK;
}

static int depths_are_good(int32_t near_depth, int32_t far_depth, int32_t smallest)
{
    return near_depth >= smallest && near_depth < far_depth && far_depth <= DEPTH_MAX;
}

gn_status gn_perspective(gn_camera *camera, gn_angle fovy, int32_t near_depth, int32_t far_depth)
{
    if (!camera)
        return GN_BAD_ARGUMENT;
    if (!depths_are_good(near_depth, far_depth, 1) || gn_tangent(&camera->tan_half, fovy / 2) != GN_OK)
        return GN_OUT_OF_RANGE;
    camera->projection = GN_PERSPECTIVE;
    camera->half_height = 0;
    camera->near_depth = near_depth;
    camera->far_depth = far_depth;
    return GN_OK;
}

gn_status gn_orthographic(gn_camera *camera, int32_t half_height, int32_t near_depth, int32_t far_depth)
{
    if (!camera)
        return GN_BAD_ARGUMENT;
    if (!depths_are_good(near_depth, far_depth, -DEPTH_MAX) || near_depth > far_depth - 64 || half_height < 1 ||
        half_height > HALF_HEIGHT_MAX)
        return GN_OUT_OF_RANGE;
    camera->projection = GN_ORTHOGRAPHIC;
    camera->tan_half = 0;
    camera->half_height = half_height;
    camera->near_depth = near_depth;
    camera->far_depth = far_depth;
    return GN_OK;
}

/* An otherwise empty light with these axes. */
static void begin_light(gn_light *light, gn_light_kind kind, const struct axes *axes)
{
    *light = (gn_light){0};
    light->kind = (uint8_t)kind;
    copy_vector(light->right, axes->right);
    copy_vector(light->up, axes->up);
    copy_vector(light->forward, axes->forward);
}

gn_status gn_directional_light(gn_light *light, const int32_t direction[3], const int32_t up[3])
{
    struct axes axes;
    if (!light || !direction)
        return GN_BAD_ARGUMENT;
    if (!within(direction, GN_EYE_MAX) || (up && !within(up, GN_EYE_MAX)))
        return GN_OUT_OF_RANGE;
    gn_status status = set_axes(&axes, direction, up);
    if (status != GN_OK)
        return status;
    begin_light(light, GN_DIRECTIONAL, &axes);
    return GN_OK;
}

gn_status gn_spot_light(gn_light *light, const int32_t position[3], const int32_t target[3], const int32_t up[3],
                        gn_angle fovy, int32_t near_depth, int32_t far_depth)
{
    struct axes axes;
    gn_q8_24 tan_half;
    if (!light || !position || !target)
        return GN_BAD_ARGUMENT;
    if (!depths_are_good(near_depth, far_depth, 1) || gn_tangent(&tan_half, fovy / 2) != GN_OK)
        return GN_OUT_OF_RANGE;
    gn_status status = set_axes_towards(&axes, position, target, up);
    if (status != GN_OK)
        return status;
    int32_t place[3]; /* position may point into *light */
    copy_vector(place, position);
    begin_light(light, GN_SPOT, &axes);
    copy_vector(light->position, place);
    light->tan_half = tan_half;
    light->near_depth = near_depth;
    light->far_depth = far_depth;
    return GN_OK;
}

gn_status gn_point_light(gn_light *light, const int32_t position[3], int32_t near_depth, int32_t far_depth)
{
    static const struct axes none;
    if (!light || !position)
        return GN_BAD_ARGUMENT;
    if (!within(position, GN_EYE_MAX) || !depths_are_good(near_depth, far_depth, 1))
        return GN_OUT_OF_RANGE;
    int32_t place[3]; /* position may point into *light */
    copy_vector(place, position);
    begin_light(light, GN_POINT, &none);
    copy_vector(light->position, place);
    light->near_depth = near_depth;
    light->far_depth = far_depth;
    return GN_OK;
}

void gn_model_identity(gn_model *model)
{
    if (!model)
        return;
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++)
            model->m[i][j] = i == j ? ONE : 0;
        model->t[i] = 0;
    }
    model->shift = 30;
}

/* Does model keep to gnomon.h, and t to +-MODEL_MAX? */
static int model_is_good(const gn_model *model)
{
    return within(model->m[0], MODEL_MAX) && within(model->m[1], MODEL_MAX) && within(model->m[2], MODEL_MAX) &&
           within(model->t, MODEL_MAX) && model->shift <= SHIFT_MAX;
}

/* model = a / 2^fraction after model. The new m is rounded to nearest, with the shift that brings its largest element
 * into (2^29, 2^30], or with SHIFT_MAX. No row of |a| may add to more than 2^31.8. GN_OUT_OF_RANGE: not with any shift,
 * or t beyond MODEL_MAX. */
static gn_status compose(gn_model *model, int32_t a[3][3], int fraction)
{
    int64_t m[3][3], t[3];
    uint64_t largest = 1;
    if (!model_is_good(model))
        return GN_OUT_OF_RANGE;
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++) {
            m[i][j] = 0;
            for (int k = 0; k < 3; k++)
                m[i][j] += gn_multiply(a[i][k], model->m[k][j]);
            if (magnitude(m[i][j]) > largest)
                largest = magnitude(m[i][j]);
        }
        t[i] = 0;
        for (int k = 0; k < 3; k++)
            t[i] += gn_multiply(a[i][k], model->t[k]);
        t[i] = round_shift(t[i], (unsigned)fraction);
        if (t[i] < -MODEL_MAX || t[i] > MODEL_MAX)
            return GN_OUT_OF_RANGE;
    }
    int drop = 33 - (int)gn_leading_zeros_64(2 * largest - 1); /* least with largest <= 2^(30 + drop) */
    int shift = model->shift + fraction - drop;
    if (shift < 0)
        return GN_OUT_OF_RANGE;
    if (shift > SHIFT_MAX) {
        drop += shift - SHIFT_MAX;
        shift = SHIFT_MAX;
    }
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++)
            model->m[i][j] =
                (int32_t)(drop < 0 ? m[i][j] * ((int64_t)1 << -drop) : round_shift(m[i][j], (unsigned)drop));
        model->t[i] = (int32_t)t[i];
    }
    model->shift = (uint8_t)shift;
    return GN_OK;
}

gn_status gn_model_scale(gn_model *model, gn_q16_16 x, gn_q16_16 y, gn_q16_16 z)
{
    int32_t a[3][3] = {{x, 0, 0}, {0, y, 0}, {0, 0, z}};
    if (!model)
        return GN_BAD_ARGUMENT;
    return compose(model, a, 16);
}

/* Rodrigues: a = n n^T + c (1 - n n^T) + s [n]x; each element within 2^-27 of the exact one. Quarter turns about the
 * coordinate axes are exact. */
gn_status gn_model_rotate(gn_model *model, const int32_t axis[3], gn_angle angle)
{
    int32_t a[3][3];
    gn_q2_30 n[3];
    if (!model || !axis)
        return GN_BAD_ARGUMENT;
    int64_t v[3] = {axis[0], axis[1], axis[2]};
    if (!normalise(n, v))
        return GN_OUT_OF_RANGE;
    gn_q2_30 sine = gn_sine(angle), cosine = gn_cosine(angle);
    for (int i = 0; i < 3; i++) {
        int next = i < 2 ? i + 1 : 0;
        for (int j = 0; j < 3; j++) {
            int32_t product = (int32_t)round_shift(gn_multiply(n[i], n[j]), 30);
            int64_t turned = gn_multiply(cosine, (i == j ? ONE : 0) - product);
            if (i != j)
                turned += gn_multiply(j == next ? -sine : sine, n[3 - i - j]);
            a[i][j] = product + (int32_t)round_shift(turned, 30);
        }
    }
    return compose(model, a, 30);
}

gn_status gn_model_translate(gn_model *model, int32_t x, int32_t y, int32_t z)
{
    const int32_t by[3] = {x, y, z};
    if (!model)
        return GN_BAD_ARGUMENT;
    if (!model_is_good(model))
        return GN_OUT_OF_RANGE;
    for (int i = 0; i < 3; i++) {
        int64_t t = (int64_t)model->t[i] + by[i];
        if (t < -MODEL_MAX || t > MODEL_MAX)
            return GN_OUT_OF_RANGE;
    }
    for (int i = 0; i < 3; i++)
        model->t[i] += by[i];
    return GN_OK;
}
