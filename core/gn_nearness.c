#include "gn_nearness.h"

void gn_make_eye(gn_eye *eye, const gn_camera *camera, int32_t width, int32_t height)
{
    for (int i = 0; i < 3; i++) {
        eye->position[i] = camera->eye[i];
        eye->right[i] = camera->right[i];
        eye->up[i] = camera->up[i];
        eye->forward[i] = camera->forward[i];
    }
    eye->perspective = camera->projection == GN_PERSPECTIVE;
    eye->width = width;
    eye->height = height;
    eye->width_bits = (uint8_t)gn_bits_for((uint32_t)width);
    eye->height_bits = (uint8_t)gn_bits_for((uint32_t)height);
    eye->near_depth = camera->near_depth;
    gn_wide over_height = gn_wide_reciprocal(gn_widen(height, 0));
    if (eye->perspective) {
        /* axes are Q2.30: 2^60 near 2^-30; a pixel is 2 tan / height wide at w = 1, tan is Q8.24 */
        eye->unit = gn_widen(camera->near_depth, 30);
        eye->step = gn_wide_multiply(gn_wide_multiply(eye->unit, gn_widen(camera->tan_half, -23)), over_height);
    } else {
        eye->unit = gn_widen(-1, 62); /* -2^32, and 2^30 of forward */
        eye->step = gn_wide_multiply(gn_widen(camera->half_height, 33), over_height);
    }
}

static int32_t larger(int32_t a, int32_t b)
{
    return a > b ? a : b;
}

void gn_make_nearness(gn_nearness *plane, const gn_eye *eye, const int64_t n[3], gn_wide distance)
{
    gn_wide forward = gn_wide_dot(n, eye->forward);
    gn_wide above = eye->perspective ? forward : distance, below = eye->perspective ? distance : forward;
    plane->base = -GN_NEAREST;
    plane->dx = plane->dy = 0;
    plane->shift = 0;
    if (below.m == 0)
        return;
    gn_wide inverse = gn_wide_reciprocal(below);
    gn_wide scaled = gn_wide_multiply(eye->step, inverse);
    gn_wide base = gn_wide_multiply(gn_wide_multiply(eye->unit, above), inverse);
    gn_wide dx = gn_wide_multiply(gn_wide_dot(n, eye->right), scaled);
    gn_wide dy = gn_wide_negate(gn_wide_multiply(gn_wide_dot(n, eye->up), scaled));
    /* half the image to either side of the middle; three terms, below 2^62 together */
    int32_t bits = larger(gn_wide_bits(base),
                          larger(gn_wide_bits(dx) + eye->width_bits - 1, gn_wide_bits(dy) + eye->height_bits - 1)) +
                   2;
    int32_t shift = larger(bits - 62, 0);
    if (shift > 62) /* as good as edge-on */
        return;
    plane->shift = (uint8_t)shift;
    plane->dx = gn_wide_round(dx, shift);
    plane->dy = gn_wide_round(dy, shift);
    plane->base =
        gn_wide_round(base, shift) - gn_floor_shift_64((eye->width - 1) * plane->dx + (eye->height - 1) * plane->dy, 1);
}

gn_reach gn_empty_reach(void)
{
    gn_reach reach = {GN_NEAREST, -GN_NEAREST};
    return reach;
}

static void take_in(gn_reach *reach, int64_t nearness)
{
    reach->low = nearness < reach->low ? nearness : reach->low;
    reach->high = nearness > reach->high ? nearness : reach->high;
}

static int64_t dot(const int32_t a[3], const int32_t b[3])
{
    return gn_multiply(a[0], b[0]) + gn_multiply(a[1], b[1]) + gn_multiply(a[2], b[2]);
}

void gn_reach_depth(gn_reach *reach, const gn_eye *eye, gn_wide w)
{
    if (!eye->perspective) {
        w.e += 2;
        take_in(reach, -gn_wide_round(w, 0));
    } else if (w.m <= 0) {
        take_in(reach, GN_NEAREST); /* the part before the eye begins at its plane */
    } else {
        take_in(reach, gn_wide_round(gn_wide_multiply(gn_wide_reciprocal(w), gn_widen(eye->near_depth, 90)), 0));
    }
}

void gn_reach_point(gn_reach *reach, const gn_eye *eye, const int32_t point[3])
{
    int32_t apart[3] = {point[0] - eye->position[0], point[1] - eye->position[1], point[2] - eye->position[2]};
    gn_reach_depth(reach, eye, gn_widen(dot(apart, eye->forward), 0));
}

void gn_reach_ray(gn_reach *reach, const gn_eye *eye, const int32_t direction[3])
{
    int64_t w = dot(direction, eye->forward);
    if (w > 0)
        take_in(reach, eye->perspective ? 0 : -GN_NEAREST);
    else if (w < 0)
        take_in(reach, GN_NEAREST);
}
