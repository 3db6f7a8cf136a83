/* Cameras, lights and model matrices against long double, and every status code that gnomon.h names for them.
 * Cases: 200000 views and 200000 models, or GNOMON_CASES. */
#include "gn_trigonometry.h"
#include "tap.h"

#include <math.h>
#include <string.h>

#define ONE ((int32_t)1 << 30)
#define BEYOND (GN_EYE_MAX + 1)
#define DEPTH_MAX ((int32_t)1 << 28)
#define MODEL_MAX ((int32_t)1 << 30)

typedef long double real;
typedef const int32_t *vector;

static uint64_t random_state = 1;

/* -2^bits to 2^bits */
static int32_t random_within(unsigned bits)
{
    uint64_t span = (UINT64_C(2) << bits) + 1;
    return (int32_t)(tap_random(&random_state) % span) - ((int32_t)1 << bits);
}

static void random_vector(int32_t v[3], unsigned bits)
{
    for (int i = 0; i < 3; i++)
        v[i] = random_within(bits);
}

static real dot(const real a[3], const real b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void cross(real out[3], const real a[3], const real b[3])
{
    for (int i = 0; i < 3; i++) {
        int j = (i + 1) % 3, k = (i + 2) % 3;
        out[i] = a[j] * b[k] - a[k] * b[j];
    }
}

/* 0 where v = 0 */
static int normalise(real v[3])
{
    real length = sqrtl(dot(v, v));
    if (length == 0)
        return 0;
    for (int i = 0; i < 3; i++)
        v[i] /= length;
    return 1;
}

static void from_q2_30(real out[3], const gn_q2_30 v[3])
{
    for (int i = 0; i < 3; i++)
        out[i] = ldexpl(v[i], -30);
}

/* ---- axes ------------------------------------------------------------------------------------------------------ */

/* right, up, forward */
struct axes {
    real axis[3][3];
};

/* 0 where there are none. The products of the first cross product, at most 2^55, are exact in 64 bits of mantissa. */
static int expected_axes(struct axes *axes, const int32_t direction[3], const int32_t up[3])
{
    real d[3], u[3];
    for (int i = 0; i < 3; i++) {
        d[i] = axes->axis[2][i] = direction[i];
        u[i] = up[i];
    }
    cross(axes->axis[0], d, u);
    if (!normalise(axes->axis[2]) || !normalise(axes->axis[0]))
        return 0;
    cross(axes->axis[1], axes->axis[0], axes->axis[2]);
    return 1;
}

/* Largest errors so far, in 2^-30; component: of right and up. */
struct axes_errors {
    real component, forward, length, orthogonality;
    int32_t largest;
};

static void measure_axes(struct axes_errors *errors, const gn_q2_30 right[3], const gn_q2_30 up[3],
                         const gn_q2_30 forward[3], const struct axes *expected)
{
    const gn_q2_30 *integers[3] = {right, up, forward};
    struct axes got;
    for (int i = 0; i < 3; i++) {
        from_q2_30(got.axis[i], integers[i]);
        for (int k = 0; k < 3; k++) {
            real *worst = i == 2 ? &errors->forward : &errors->component;
            *worst = fmaxl(*worst, fabsl(got.axis[i][k] - expected->axis[i][k]) * ONE);
            int32_t size = abs(integers[i][k]);
            errors->largest = size > errors->largest ? size : errors->largest;
        }
        errors->length = fmaxl(errors->length, fabsl(sqrtl(dot(got.axis[i], got.axis[i])) - 1) * ONE);
    }
    for (int i = 0; i < 3; i++)
        errors->orthogonality = fmaxl(errors->orthogonality, fabsl(dot(got.axis[i], got.axis[(i + 1) % 3])) * ONE);
}

/* Components and lengths within 2^-28, forward within 2^-30, dot products within 2^-29, no component beyond 1. */
static int axes_are_good(const struct axes_errors *errors)
{
    return errors->component <= 4 && errors->forward <= 1 && errors->length <= 4 && errors->orthogonality <= 2 &&
           errors->largest <= ONE;
}

static void show_view(const char *function, const int32_t eye[3], const int32_t target[3], const int32_t up[3],
                      gn_status status)
{
    note("%s: eye %ld %ld %ld, target %ld %ld %ld, up %ld %ld %ld: status %d", function, (long)eye[0], (long)eye[1],
         (long)eye[2], (long)target[0], (long)target[1], (long)target[2], (long)up[0], (long)up[1], (long)up[2],
         (int)status);
}

/* A view of some kind: near or far, along axes, with an up vector that is any, small, or nearly parallel to the view.
 */
static void random_view(uint64_t i, int32_t eye[3], int32_t target[3], int32_t up[3])
{
    unsigned kind = (unsigned)(i % 8), size = (unsigned)(tap_random(&random_state) % 28);
    random_vector(eye, size);
    random_vector(target, size);
    random_vector(up, (unsigned)(tap_random(&random_state) % 28));
    if (kind == 1) { /* a small step far away */
        random_vector(eye, 26);
        random_vector(target, 4);
        for (int k = 0; k < 3; k++)
            target[k] += eye[k];
    } else if (kind == 2 || kind == 3) { /* up nearly, or exactly, along the view */
        for (int k = 0; k < 3; k++)
            up[k] = (target[k] - eye[k]) / (kind == 2 ? 2 : -3) + (int32_t)(tap_random(&random_state) % 3) - 1;
    } else if (kind == 4) { /* the corners of the range */
        for (int k = 0; k < 3; k++) {
            eye[k] = tap_random(&random_state) & 1 ? GN_EYE_MAX : -GN_EYE_MAX;
            target[k] = tap_random(&random_state) & 1 ? -eye[k] : random_within(27);
            up[k] = tap_random(&random_state) & 1 ? GN_EYE_MAX : random_within(1);
        }
    } else if (kind == 5) { /* +y up, views along axes */
        up[0] = up[2] = 0;
        up[1] = 1;
        target[0] = eye[0];
    }
    for (int k = 0; k < 3; k++)
        if (abs(up[k]) > GN_EYE_MAX)
            up[k] = 0;
}

static void cameras_look_where_they_should(uint64_t cases)
{
    struct axes_errors worst = {0, 0, 0, 0, 0};
    unsigned failures = 0, refused = 0, good = 0;
    for (uint64_t i = 0; i < cases; i++) {
        int32_t eye[3], target[3], up[3], direction[3];
        struct axes expected;
        gn_camera camera;
        random_view(i, eye, target, up);
        for (int k = 0; k < 3; k++)
            direction[k] = target[k] - eye[k];
        int possible = expected_axes(&expected, direction, up);
        gn_status status = gn_look_at(&camera, eye, target, up);
        struct axes_errors errors = {0, 0, 0, 0, 0};
        if (possible && status == GN_OK) {
            measure_axes(&errors, camera.right, camera.up, camera.forward, &expected);
            measure_axes(&worst, camera.right, camera.up, camera.forward, &expected);
            good++;
        }
        refused += !possible;
        if (status != (possible ? GN_OK : GN_OUT_OF_RANGE) || !axes_are_good(&errors) ||
            (possible && memcmp(camera.eye, eye, sizeof eye))) {
            if (failures++ < 5) {
                show_view("gn_look_at", eye, target, up, status);
                note("expected status %d; component %.2Lf, forward %.2Lf, length %.2Lf, orthogonality %.2Lf (in 2^-30)",
                     possible ? GN_OK : GN_OUT_OF_RANGE, errors.component, errors.forward, errors.length,
                     errors.orthogonality);
            }
        }
    }
    note("largest errors in 2^-30: component %.3Lf, forward %.3Lf, length %.3Lf, orthogonality %.3Lf; %u good, %u "
         "impossible",
         worst.component, worst.forward, worst.length, worst.orthogonality, good, refused);
    ok(!failures, "camera axes are within 2^-28, orthogonal within 2^-29, in %llu views", (unsigned long long)cases);
    ok(good > cases / 2 && refused > 0, "possible and impossible views were tried");
}

static void lights_look_where_they_should(uint64_t cases)
{
    struct axes_errors worst = {0, 0, 0, 0, 0};
    unsigned failures = 0, vertical = 0;
    for (uint64_t i = 0; i < cases; i++) {
        int32_t position[3], target[3], up[3], direction[3];
        struct axes expected;
        gn_light directional, spot;
        random_view(i / 4, position, target, up);
        for (int k = 0; k < 3; k++) {
            position[k] /= 2;
            target[k] /= 2;
        }
        if (i & 1) /* nearly vertical */
            target[1] = position[1] + (i & 2 ? -1 : 1) * (int32_t)(tap_random(&random_state) % ((uint32_t)1 << 26));
        for (int k = 0; k < 3; k++) {
            if (i & 1 && k != 1)
                target[k] = position[k] + (target[1] - position[1]) / (1 + (int32_t)(tap_random(&random_state) & 63));
            if (abs(target[k]) > GN_EYE_MAX)
                target[k] = 0;
            direction[k] = target[k] - position[k];
        }
        real d[3] = {direction[0], direction[1], direction[2]};
        int possible = normalise(d), is_vertical = fabsl(d[1]) > 0.999L;
        if (fabsl(fabsl(d[1]) - 0.999L) < 1e-8L)
            continue;
        up[0] = 0;
        up[1] = !is_vertical;
        up[2] = is_vertical;
        vertical += (unsigned)is_vertical;
        possible = possible && expected_axes(&expected, direction, up);
        gn_status status = gn_directional_light(&directional, direction, 0),
                  spot_status = gn_spot_light(&spot, position, target, 0, GN_DEGREES(60), 1, 2);
        struct axes_errors errors = {0, 0, 0, 0, 0};
        if (possible && status == GN_OK && spot_status == GN_OK) {
            measure_axes(&errors, directional.right, directional.up, directional.forward, &expected);
            measure_axes(&errors, spot.right, spot.up, spot.forward, &expected);
            measure_axes(&worst, spot.right, spot.up, spot.forward, &expected);
        }
        if (status != (possible ? GN_OK : GN_OUT_OF_RANGE) || spot_status != status || !axes_are_good(&errors)) {
            if (failures++ < 5) {
                show_view("lights", position, target, up, status);
                note("component %.2Lf, forward %.2Lf, length %.2Lf, orthogonality %.2Lf (in 2^-30)", errors.component,
                     errors.forward, errors.length, errors.orthogonality);
            }
        }
    }
    note("largest errors in 2^-30: component %.3Lf, forward %.3Lf, length %.3Lf, orthogonality %.3Lf", worst.component,
         worst.forward, worst.length, worst.orthogonality);
    ok(!failures, "light axes are within 2^-28, up is +y, or +z where |y| exceeds 0.999, in %llu lights",
       (unsigned long long)cases);
    ok(vertical > cases / 100 && vertical < cases, "both default up vectors were tried");
}

static int same(const char *what, vector got, int32_t x, int32_t y, int32_t z)
{
    if (got[0] == x && got[1] == y && got[2] == z)
        return 1;
    note("%s: got %ld %ld %ld, expected %ld %ld %ld", what, (long)got[0], (long)got[1], (long)got[2], (long)x, (long)y,
         (long)z);
    return 0;
}

static void views_done_by_hand(void)
{
    static const int32_t eye[3] = {0, 0, 10}, origin[3] = {0, 0, 0}, y[3] = {0, 1, 0}, slope[3] = {3, 4, 0},
                         z[3] = {0, 0, 1}, down[3] = {0, -7, 0};
    gn_camera camera;
    gn_light light;
    gn_look_at(&camera, eye, origin, y);
    int good = same("right", camera.right, ONE, 0, 0);
    good &= same("up", camera.up, 0, ONE, 0);
    good &= same("forward", camera.forward, 0, 0, -ONE);
    ok(good, "looking along -z, right is +x and up is +y, exactly");

    gn_look_at(&camera, origin, slope, z);
    good = same("forward", camera.forward, 644245094, 858993459, 0); /* 0.6, 0.8 */
    good &= same("right", camera.right, 858993459, -644245094, 0);
    good &= same("up", camera.up, 0, 0, ONE);
    ok(good, "a 3-4-5 triangle is rounded to nearest");

    gn_directional_light(&light, down, 0);
    good = same("forward", light.forward, 0, -ONE, 0);
    good &= same("right", light.right, -ONE, 0, 0);
    good &= same("up", light.up, 0, 0, ONE);
    ok(good, "light straight down has +z up");

    gn_light given;
    gn_directional_light(&light, slope, 0);
    gn_directional_light(&given, slope, y);
    ok(!memcmp(&light, &given, sizeof light), "the default up vector equals the same one given");
    gn_directional_light(&given, slope, z);
    ok(memcmp(&light, &given, sizeof light) != 0, "a given up vector is used");
}

/* ---- status codes ---------------------------------------------------------------------------------------------- */

/* A structure that is full of 0xa5, to see what was written. */
#define FILL(object) memset(&(object), 0xa5, sizeof(object))

static int untouched(const void *object, size_t bytes)
{
    const unsigned char *byte = object;
    for (size_t i = 0; i < bytes; i++)
        if (byte[i] != 0xa5)
            return 0;
    return 1;
}

/* One call that must return `expected` and leave `object` alone. */
#define REFUSES(object, call, expected)                                                                                \
    do {                                                                                                               \
        FILL(object);                                                                                                  \
        gn_status status_ = (call);                                                                                    \
        if (!ok(status_ == (expected) && untouched(&(object), sizeof(object)), "%s is %s, nothing written", #call,     \
                #expected))                                                                                            \
            note("got status %d, expected %d; written: %d", (int)status_, (int)(expected),                             \
                 !untouched(&(object), sizeof(object)));                                                               \
    } while (0)

static const int32_t zero[3] = {0, 0, 0}, forward[3] = {0, 0, -5}, back[3] = {0, 0, 9}, up_y[3] = {0, 1, 0},
                     beyond[3] = {0, BEYOND, 0}, beyond_low[3] = {0, 0, -BEYOND}, least[3] = {INT32_MIN, 0, 0},
                     edge[3] = {GN_EYE_MAX, -GN_EYE_MAX, GN_EYE_MAX};

static void cameras_refuse_what_they_cannot_do(void)
{
    gn_camera camera;
    ok(gn_look_at(0, zero, forward, up_y) == GN_BAD_ARGUMENT, "gn_look_at without a camera is GN_BAD_ARGUMENT");
    REFUSES(camera, gn_look_at(&camera, 0, forward, up_y), GN_BAD_ARGUMENT);
    REFUSES(camera, gn_look_at(&camera, zero, 0, up_y), GN_BAD_ARGUMENT);
    REFUSES(camera, gn_look_at(&camera, zero, forward, 0), GN_BAD_ARGUMENT);
    REFUSES(camera, gn_look_at(&camera, forward, forward, up_y), GN_OUT_OF_RANGE);
    REFUSES(camera, gn_look_at(&camera, zero, forward, back), GN_OUT_OF_RANGE);
    REFUSES(camera, gn_look_at(&camera, zero, forward, zero), GN_OUT_OF_RANGE);
    REFUSES(camera, gn_look_at(&camera, beyond, forward, up_y), GN_OUT_OF_RANGE);
    REFUSES(camera, gn_look_at(&camera, zero, beyond_low, up_y), GN_OUT_OF_RANGE);
    REFUSES(camera, gn_look_at(&camera, zero, forward, beyond), GN_OUT_OF_RANGE);
    REFUSES(camera, gn_look_at(&camera, zero, forward, least), GN_OUT_OF_RANGE);
    ok(gn_look_at(&camera, edge, zero, up_y) == GN_OK && gn_look_at(&camera, zero, edge, up_y) == GN_OK &&
           gn_look_at(&camera, zero, forward, edge) == GN_OK,
       "gn_look_at takes coordinates of GN_EYE_MAX");

    ok(gn_perspective(0, GN_DEGREES(40), 1, 2) == GN_BAD_ARGUMENT,
       "gn_perspective without a camera is GN_BAD_ARGUMENT");
    REFUSES(camera, gn_perspective(&camera, GN_DEGREES(1) / 2 - 1, 1, 2), GN_OUT_OF_RANGE);
    REFUSES(camera, gn_perspective(&camera, GN_DEGREES(178) + 1, 1, 2), GN_OUT_OF_RANGE);
    REFUSES(camera, gn_perspective(&camera, GN_DEGREES(180), 1, 2), GN_OUT_OF_RANGE);
    REFUSES(camera, gn_perspective(&camera, 0, 1, 2), GN_OUT_OF_RANGE);
    REFUSES(camera, gn_perspective(&camera, GN_DEGREES(40), 0, 2), GN_OUT_OF_RANGE);
    REFUSES(camera, gn_perspective(&camera, GN_DEGREES(40), -1, 2), GN_OUT_OF_RANGE);
    REFUSES(camera, gn_perspective(&camera, GN_DEGREES(40), 2, 2), GN_OUT_OF_RANGE);
    REFUSES(camera, gn_perspective(&camera, GN_DEGREES(40), 3, 2), GN_OUT_OF_RANGE);
    REFUSES(camera, gn_perspective(&camera, GN_DEGREES(40), 1, DEPTH_MAX + 1), GN_OUT_OF_RANGE);

    ok(gn_orthographic(0, 1, 1, 2) == GN_BAD_ARGUMENT, "gn_orthographic without a camera is GN_BAD_ARGUMENT");
    REFUSES(camera, gn_orthographic(&camera, 0, 1, 2), GN_OUT_OF_RANGE);
    REFUSES(camera, gn_orthographic(&camera, -1, 1, 2), GN_OUT_OF_RANGE);
    REFUSES(camera, gn_orthographic(&camera, (1 << 26) + 1, 1, 2), GN_OUT_OF_RANGE);
    REFUSES(camera, gn_orthographic(&camera, 1, 2, 2), GN_OUT_OF_RANGE);
    REFUSES(camera, gn_orthographic(&camera, 1, -1, -2), GN_OUT_OF_RANGE);
    REFUSES(camera, gn_orthographic(&camera, 1, -DEPTH_MAX - 1, 2), GN_OUT_OF_RANGE);
    REFUSES(camera, gn_orthographic(&camera, 1, 1, DEPTH_MAX + 1), GN_OUT_OF_RANGE);
}

static void lights_refuse_what_they_cannot_do(void)
{
    gn_light light;
    ok(gn_directional_light(0, forward, 0) == GN_BAD_ARGUMENT,
       "gn_directional_light without a light is GN_BAD_ARGUMENT");
    REFUSES(light, gn_directional_light(&light, 0, 0), GN_BAD_ARGUMENT);
    REFUSES(light, gn_directional_light(&light, zero, 0), GN_OUT_OF_RANGE);
    REFUSES(light, gn_directional_light(&light, beyond, 0), GN_OUT_OF_RANGE);
    REFUSES(light, gn_directional_light(&light, forward, beyond), GN_OUT_OF_RANGE);
    REFUSES(light, gn_directional_light(&light, forward, back), GN_OUT_OF_RANGE);
    REFUSES(light, gn_directional_light(&light, forward, zero), GN_OUT_OF_RANGE);
    ok(gn_directional_light(&light, edge, edge) == GN_OUT_OF_RANGE && gn_directional_light(&light, edge, up_y) == GN_OK,
       "gn_directional_light takes coordinates of GN_EYE_MAX");

    const gn_angle fovy = GN_DEGREES(40);
    ok(gn_spot_light(0, zero, forward, 0, fovy, 1, 2) == GN_BAD_ARGUMENT,
       "gn_spot_light without a light is GN_BAD_ARGUMENT");
    REFUSES(light, gn_spot_light(&light, 0, forward, 0, fovy, 1, 2), GN_BAD_ARGUMENT);
    REFUSES(light, gn_spot_light(&light, zero, 0, 0, fovy, 1, 2), GN_BAD_ARGUMENT);
    REFUSES(light, gn_spot_light(&light, forward, forward, 0, fovy, 1, 2), GN_OUT_OF_RANGE);
    REFUSES(light, gn_spot_light(&light, beyond, forward, 0, fovy, 1, 2), GN_OUT_OF_RANGE);
    REFUSES(light, gn_spot_light(&light, zero, beyond, 0, fovy, 1, 2), GN_OUT_OF_RANGE);
    REFUSES(light, gn_spot_light(&light, zero, forward, beyond, fovy, 1, 2), GN_OUT_OF_RANGE);
    REFUSES(light, gn_spot_light(&light, zero, forward, back, fovy, 1, 2), GN_OUT_OF_RANGE);
    REFUSES(light, gn_spot_light(&light, zero, forward, 0, GN_DEGREES(1) / 2 - 1, 1, 2), GN_OUT_OF_RANGE);
    REFUSES(light, gn_spot_light(&light, zero, forward, 0, GN_DEGREES(178) + 1, 1, 2), GN_OUT_OF_RANGE);
    REFUSES(light, gn_spot_light(&light, zero, forward, 0, fovy, 0, 2), GN_OUT_OF_RANGE);
    REFUSES(light, gn_spot_light(&light, zero, forward, 0, fovy, 2, 2), GN_OUT_OF_RANGE);
    REFUSES(light, gn_spot_light(&light, zero, forward, 0, fovy, 1, DEPTH_MAX + 1), GN_OUT_OF_RANGE);
}

static void fields_are_as_asked(void)
{
    gn_camera camera, before;
    FILL(camera);
    before = camera;
    gn_look_at(&camera, edge, forward, up_y);
    memcpy(camera.eye, before.eye, sizeof before.eye);
    memcpy(camera.right, before.right, 3 * sizeof before.right);
    ok(untouched(&camera, sizeof camera), "gn_look_at touches eye and axes only");

    gn_q8_24 tangent;
    gn_tangent(&tangent, GN_DEGREES(30));
    ok(gn_perspective(&camera, GN_DEGREES(60), 3, DEPTH_MAX) == GN_OK && camera.projection == GN_PERSPECTIVE &&
           camera.tan_half == tangent && camera.near_depth == 3 && camera.far_depth == DEPTH_MAX,
       "gn_perspective sets tan(fovy / 2), near and far");
    ok(gn_perspective(&camera, GN_DEGREES(1) / 2, 1, 2) == GN_OK &&
           gn_perspective(&camera, GN_DEGREES(178), 1, 2) == GN_OK,
       "gn_perspective takes 1/2 and 178 degrees");
    ok(gn_orthographic(&camera, 1 << 26, -DEPTH_MAX, 0) == GN_OK && camera.projection == GN_ORTHOGRAPHIC &&
           camera.half_height == 1 << 26 && camera.near_depth == -DEPTH_MAX && camera.far_depth == 0,
       "gn_orthographic sets half the height, near and far");

    gn_light light;
    FILL(light);
    ok(gn_spot_light(&light, edge, forward, 0, GN_DEGREES(60), 3, DEPTH_MAX) == GN_OK && light.kind == GN_SPOT &&
           same("position", light.position, edge[0], edge[1], edge[2]) && light.tan_half == tangent &&
           light.near_depth == 3 && light.far_depth == DEPTH_MAX && light.box_width == 0,
       "gn_spot_light sets position, tan(fovy / 2), near and far");
    gn_light moved = light;
    ok(gn_spot_light(&moved, moved.position, forward, moved.up, GN_DEGREES(60), 3, DEPTH_MAX) == GN_OUT_OF_RANGE &&
           gn_spot_light(&moved, moved.position, forward, 0, GN_DEGREES(60), 3, DEPTH_MAX) == GN_OK &&
           !memcmp(&moved, &light, sizeof light),
       "the position of a spot light may be its own");
    FILL(light);
    ok(gn_directional_light(&light, forward, 0) == GN_OK && light.kind == GN_DIRECTIONAL && light.box_width == 0 &&
           light.box_height == 0 && light.box_depth == 0,
       "gn_directional_light leaves the box empty");
}

/* ---- models ---------------------------------------------------------------------------------------------------- */

/* A model matrix as real numbers: world = m v + t. */
struct real_model {
    real m[3][3], t[3];
};

static const struct real_model real_identity = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {0, 0, 0}};

static void real_compose(struct real_model *model, real a[3][3])
{
    struct real_model before = *model;
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++)
            model->m[i][j] = a[i][0] * before.m[0][j] + a[i][1] * before.m[1][j] + a[i][2] * before.m[2][j];
        model->t[i] = dot(a[i], before.t);
    }
}

static void real_scale(struct real_model *model, const gn_q16_16 factors[3])
{
    real a[3][3] = {{0}};
    for (int i = 0; i < 3; i++)
        a[i][i] = ldexpl(factors[i], -16);
    real_compose(model, a);
}

/* By the vectors' definition: what is along the axis stays, the rest turns towards axis x rest. */
static void real_rotate(struct real_model *model, const int32_t axis[3], gn_angle angle)
{
    real n[3] = {axis[0], axis[1], axis[2]}, a[3][3], turn = ldexpl(angle, -31) * acosl(-1.0L);
    normalise(n);
    for (int j = 0; j < 3; j++) {
        real e[3] = {j == 0, j == 1, j == 2}, side[3];
        cross(side, n, e);
        for (int i = 0; i < 3; i++) {
            real along = dot(n, e) * n[i];
            a[i][j] = along + (e[i] - along) * cosl(turn) + side[i] * sinl(turn);
        }
    }
    real_compose(model, a);
}

static real norm(const struct real_model *model)
{
    real sum = 0;
    for (int i = 0; i < 3; i++)
        sum += dot(model->m[i], model->m[i]);
    return sqrtl(sum);
}

/* The largest error of an element of m, as a fraction of the whole matrix. */
static real model_error(const gn_model *got, const struct real_model *expected)
{
    real worst = 0;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            worst = fmaxl(worst, fabsl(ldexpl(got->m[i][j], -(int)got->shift) - expected->m[i][j]));
    return worst / norm(expected);
}

/* As many bits as fit: the largest element in (2^29, 2^30], or the largest shift. */
static int mantissa_is_full(const gn_model *model)
{
    int32_t largest = 0;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            largest = abs(model->m[i][j]) > largest ? abs(model->m[i][j]) : largest;
    return model->shift <= 62 && largest <= ONE && (largest > ONE / 2 || model->shift == 62);
}

static void show_model(const gn_model *model)
{
    for (int i = 0; i < 3; i++)
        note("  %11ld %11ld %11ld  %11ld", (long)model->m[i][0], (long)model->m[i][1], (long)model->m[i][2],
             (long)model->t[i]);
    note("  shift %u", model->shift);
}

static void random_factors(gn_q16_16 factors[3], unsigned bits)
{
    for (int i = 0; i < 3; i++)
        do
            factors[i] = random_within(bits);
        while (!factors[i]);
}

static void chains_keep_their_bits(uint64_t cases)
{
    unsigned failures = 0, steps = 0;
    real worst = 0;
    for (uint64_t i = 0; i < cases / 8; i++) {
        gn_model model;
        struct real_model expected = real_identity;
        gn_model_identity(&model);
        for (int step = 1; step <= 8; step++, steps++) {
            gn_status status;
            if (tap_random(&random_state) & 1) {
                gn_q16_16 factors[3];
                random_factors(factors, 18);
                status = gn_model_scale(&model, factors[0], factors[1], factors[2]);
                real_scale(&expected, factors);
            } else {
                int32_t axis[3];
                random_vector(axis, 1 + (unsigned)(tap_random(&random_state) % 29));
                axis[0] += !(axis[0] | axis[1] | axis[2]);
                gn_angle angle = (gn_angle)tap_random(&random_state);
                status = gn_model_rotate(&model, axis, angle);
                real_rotate(&expected, axis, angle);
            }
            /* A small matrix may come out of large ones; its error is measured against what it came from. */
            real error = model_error(&model, &expected);
            if (step == 1)
                worst = fmaxl(worst, error);
            if (status != GN_OK || !mantissa_is_full(&model) || (step == 1 && !(error <= ldexpl(1, -27)))) {
                if (failures++ < 3) {
                    note("step %d: status %d, relative error %.3Lg", step, (int)status, error);
                    show_model(&model);
                }
                break;
            }
        }
    }
    note("largest error of one step: %.3Lf / 2^30 of the matrix; %u steps", worst * ONE, steps);
    ok(!failures, "one step is within 2^-27, and chains of eight keep as many bits as fit");
}

/* What a scene file asks for: factors of 1/16 to 16, any axis, any angle, any place; vertices to GN_WORLD_MAX / 16. */
static void scale_rotate_translate_agrees(uint64_t cases)
{
    unsigned failures = 0;
    real worst = 0, worst_matrix = 0;
    for (uint64_t i = 0; i < cases; i++) {
        gn_model model;
        struct real_model expected = real_identity;
        gn_q16_16 factors[3];
        int32_t axis[3], by[3], vertex[3];
        gn_angle angle = (gn_angle)tap_random(&random_state);
        for (int k = 0; k < 3; k++) {
            factors[k] = 4096 + (int32_t)(tap_random(&random_state) % (1048576 - 4096));
            if (tap_random(&random_state) & 1)
                factors[k] = -factors[k];
        }
        random_vector(axis, 27);
        axis[1] |= 1;
        random_vector(by, 24);
        random_vector(vertex, 20);
        gn_model_identity(&model);
        gn_status status = gn_model_scale(&model, factors[0], factors[1], factors[2]);
        if (status == GN_OK)
            status = gn_model_rotate(&model, axis, angle);
        if (status == GN_OK)
            status = gn_model_translate(&model, by[0], by[1], by[2]);
        real_scale(&expected, factors);
        real_rotate(&expected, axis, angle);
        real error = model_error(&model, &expected), distance = 0;
        worst_matrix = fmaxl(worst_matrix, error);
        for (int k = 0; k < 3; k++) {
            real v[3] = {vertex[0], vertex[1], vertex[2]}, exact = dot(expected.m[k], v) + by[k], sum = 0;
            for (int j = 0; j < 3; j++)
                sum += (real)model.m[k][j] * vertex[j]; /* exact: below 2^53 */
            real world = floorl(ldexpl(sum, -(int)model.shift) + 0.5L) + model.t[k];
            distance = fmaxl(distance, fabsl(world - exact));
        }
        worst = fmaxl(worst, distance);
        if (status != GN_OK || !mantissa_is_full(&model) || !(error <= ldexpl(1, -27)) || !(distance <= 0.75L)) {
            if (failures++ < 3) {
                note("status %d; factors %ld %ld %ld, axis %ld %ld %ld, angle 0x%08lx; a vertex is off by %.3Lf",
                     (int)status, (long)factors[0], (long)factors[1], (long)factors[2], (long)axis[0], (long)axis[1],
                     (long)axis[2], (unsigned long)angle, distance);
                show_model(&model);
            }
        }
    }
    note("largest error: %.3Lf / 2^30 of the matrix; a vertex is off by at most %.4Lf units", worst_matrix * ONE,
         worst);
    ok(!failures, "scale, rotate, translate: within 2^-27 of the matrix, vertices within 3/4 unit, in %llu models",
       (unsigned long long)cases);
}

static void order_is_scale_rotate_translate(void)
{
    static const int32_t z[3] = {0, 0, 1};
    gn_model model, expected = {{{0, -ONE, 0}, {ONE / 2, 0, 0}, {0, 0, ONE / 4}}, {10, 20, 30}, 28};
    gn_model_identity(&model);
    gn_model_scale(&model, 2 << 16, 4 << 16, 1 << 16);
    gn_model_rotate(&model, z, GN_DEGREES(90));
    gn_model_translate(&model, 10, 20, 30);
    if (!ok(!memcmp(&model, &expected, offsetof(gn_model, shift) + 1), "each call acts after what is there already"))
        show_model(&model);
    gn_model_rotate(&model, z, GN_DEGREES(90));
    gn_model_scale(&model, 1 << 15, 1 << 16, -1 * (1 << 16));
    if (!ok(same("t", model.t, -10, 10, -30), "rotation and scale move the translation too"))
        show_model(&model);
}

static void quarter_turns_are_exact(void)
{
    gn_model identity;
    gn_model_identity(&identity);
    for (int k = 0; k < 3; k++) {
        int32_t axis[3] = {0, 0, 0}, j = (k + 1) % 3, i = (k + 2) % 3;
        gn_model model = identity;
        axis[k] = 3;
        gn_model_rotate(&model, axis, UINT32_C(1) << 30);
        int good = model.shift == 30 && model.m[k][k] == ONE && model.m[i][j] == ONE && model.m[j][i] == -ONE &&
                   model.m[i][i] == 0 && model.m[j][j] == 0;
        for (int turn = 1; turn < 4; turn++)
            gn_model_rotate(&model, axis, UINT32_C(1) << 30);
        if (!ok(good && !memcmp(&model, &identity, offsetof(gn_model, shift) + 1),
                "a quarter turn about %c is exact and right-handed, four are none", "xyz"[k]))
            show_model(&model);
    }
}

static void models_refuse_what_they_cannot_do(void)
{
    static const int32_t x[3] = {1, 0, 0};
    gn_model model, before;
    gn_model_identity(0); /* does nothing */
    ok(gn_model_scale(0, 1, 1, 1) == GN_BAD_ARGUMENT && gn_model_rotate(0, x, 0) == GN_BAD_ARGUMENT &&
           gn_model_translate(0, 0, 0, 0) == GN_BAD_ARGUMENT,
       "no model is GN_BAD_ARGUMENT");
    REFUSES(model, gn_model_rotate(&model, 0, 0), GN_BAD_ARGUMENT);
    REFUSES(model, gn_model_rotate(&model, zero, 0), GN_OUT_OF_RANGE);
    REFUSES(model, gn_model_scale(&model, 1, 1, 1), GN_OUT_OF_RANGE); /* 0xa5...: not a model */
    REFUSES(model, gn_model_translate(&model, 1, 1, 1), GN_OUT_OF_RANGE);

    gn_model_identity(&model);
    gn_status status = GN_OK;
    int calls = 0;
    for (; status == GN_OK && calls < 100; calls++) {
        before = model;
        status = gn_model_scale(&model, INT32_MAX, INT32_MIN, INT32_MAX);
    }
    /* Identity has shift 30; a factor of 2^15 takes 15 of it. */
    ok(status == GN_OUT_OF_RANGE && calls == 3 && !memcmp(&model, &before, sizeof model),
       "a matrix that grows beyond 2^30 is GN_OUT_OF_RANGE, nothing written");

    gn_model_identity(&model);
    for (calls = 0, status = GN_OK; status == GN_OK && calls < 8; calls++)
        status = gn_model_scale(&model, 1, -1, 1);
    ok(status == GN_OK && model.shift == 62 && !model.m[0][0] && !model.m[2][2],
       "a matrix that shrinks below 2^-62 becomes zero, with status GN_OK");

    gn_model_identity(&model);
    for (calls = 0; calls < 33; calls++)
        status = gn_model_scale(&model, 1 << 15, 1 << 15, 1 << 15);
    ok(status == GN_OK && model.shift == 62 && model.m[1][1] == ONE / 2, "halving gives up bits only at a shift of 62");

    gn_model_identity(&model);
    for (calls = 0, status = GN_OK; status == GN_OK && calls < 100; calls++)
        status = gn_model_scale(&model, 2 << 16, 2 << 16, 2 << 16);
    ok(calls == 31 && model.shift == 0 && model.m[1][1] == ONE, "doubling ends at a shift of 0");

    gn_model_identity(&model);
    ok(gn_model_scale(&model, 0, 1 << 16, 1 << 16) == GN_OK && model.m[0][0] == 0 && model.m[1][1] == ONE &&
           gn_model_scale(&model, 0, 0, 0) == GN_OK && model.m[1][1] == 0,
       "a scale of 0 flattens");

    gn_model_identity(&model);
    ok(gn_model_translate(&model, MODEL_MAX, -MODEL_MAX, 0) == GN_OK, "translations to 2^30 are taken");
    before = model;
    ok(gn_model_translate(&model, 1, 0, 0) == GN_OUT_OF_RANGE &&
           gn_model_translate(&model, 0, -1, 0) == GN_OUT_OF_RANGE &&
           gn_model_translate(&model, 0, 0, INT32_MIN) == GN_OUT_OF_RANGE &&
           gn_model_scale(&model, 65537, 1, 1) == GN_OUT_OF_RANGE && !memcmp(&model, &before, sizeof model),
       "translations beyond 2^30 are GN_OUT_OF_RANGE, nothing written");

    gn_model_identity(&model);
    model.shift = 63;
    ok(gn_model_scale(&model, 65536, 65536, 65536) == GN_OUT_OF_RANGE, "a model with a shift of 63 is GN_OUT_OF_RANGE");
    gn_model_identity(&model);
    model.m[1][2] = -ONE - 1;
    ok(gn_model_rotate(&model, x, 1) == GN_OUT_OF_RANGE, "a model with an element beyond 2^30 is GN_OUT_OF_RANGE");
}

int main(int argc, char **argv)
{
    uint64_t cases = tap_cases(argc, argv, 200000);
    cameras_look_where_they_should(cases);
    lights_look_where_they_should(cases);
    views_done_by_hand();
    cameras_refuse_what_they_cannot_do();
    lights_refuse_what_they_cannot_do();
    fields_are_as_asked();
    chains_keep_their_bits(cases);
    scale_rotate_translate_agrees(cases);
    order_is_scale_rotate_translate();
    quarter_turns_are_exact();
    models_refuse_what_they_cannot_do();
    return tap_done();
}
