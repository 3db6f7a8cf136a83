#include "gn_view.h"

/* A row for (axis . P - twice_centre / 2) scale, where axis is Q2.30 and scale is positive. 0 if it does not fit. */
static int make_row(gn_row *row, const gn_q2_30 axis[3], int64_t twice_centre, gn_scaled scale)
{
    /* scale = (k / 2^30) 2^(30 + e): k in [2^29, 2^30) keeps m below 2^30 for unit axes. */
    int64_t k = scale.m >> 1;
    int32_t shift = -(scale.e + 1);
    if (scale.m <= 0 || shift < 0 || shift > 62)
        return 0;
    for (int i = 0; i < 3; i++)
        row->m[i] = (int32_t)gn_floor_shift_64(gn_multiply(axis[i], (int32_t)k) + (1 << 29), 30);
    int64_t half = shift ? (int64_t)1 << (shift - 1) : 0;
    row->offset = half - gn_floor_shift_64(twice_centre * k, 1);
    row->shift = (uint8_t)shift;
    return 1;
}

/* A row for axis . (P - eye) scale. */
static int make_row_from(gn_row *row, const gn_q2_30 axis[3], const int32_t eye[3], gn_scaled scale)
{
    if (!make_row(row, axis, 0, scale))
        return 0;
    for (int i = 0; i < 3; i++)
        row->offset -= gn_multiply(row->m[i], eye[i]);
    return 1;
}

static void negate_row(gn_row *row)
{
    int64_t half = row->shift ? (int64_t)1 << (row->shift - 1) : 0;
    for (int i = 0; i < 3; i++)
        row->m[i] = -row->m[i];
    row->offset = 2 * half - row->offset;
}

static int in_range(const int32_t v[3], int32_t limit)
{
    for (int i = 0; i < 3; i++)
        if (v[i] < -limit || v[i] > limit)
            return 0;
    return 1;
}

/* Axes as gn_look_at makes them: components of unit vectors, a few units of rounding allowed. */
static int are_axes(const gn_q2_30 right[3], const gn_q2_30 up[3], const gn_q2_30 forward[3])
{
    int32_t limit = (1 << 30) + 16;
    return in_range(right, limit) && in_range(up, limit) && in_range(forward, limit);
}

static int32_t largest_component(const int32_t v[3])
{
    int32_t largest = 0;
    for (int i = 0; i < 3; i++) {
        int32_t m = v[i] < 0 ? -v[i] : v[i];
        largest = m > largest ? m : largest;
    }
    return largest;
}

static void set_size(gn_view *view, int32_t width, int32_t height)
{
    int32_t larger = width > height ? width : height;
    view->half_width = 128 * width;
    view->half_height = 128 * height;
    view->centre_x = 128 * width;
    view->centre_y = 128 * height;
    view->endless = 0;
    view->guard = GN_MAX_COORDINATE / (128 * larger);
    if (view->guard > 7)
        view->guard = 7;
}

/* Perspective from eye along the axes; tan_x, tan_y: half the opening. */
static gn_status make_projective(gn_view *view, const int32_t eye[3], const gn_q2_30 right[3], const gn_q2_30 up[3],
                                 const gn_q2_30 forward[3], gn_scaled tan_x, gn_scaled tan_y, int32_t near_depth,
                                 int32_t far_depth)
{
    gn_scaled one = gn_scale(1, 0);
    if (!in_range(eye, GN_EYE_MAX) || near_depth <= 0 || far_depth <= near_depth || far_depth > (1 << 28) ||
        ((far_depth - 1) >> 20) >= near_depth)
        return GN_OUT_OF_RANGE;
    /* |P - eye| <= sqrt(3) (2^24 + |eye|): scale so that it stays below 2^30. */
    int32_t reach = GN_WORLD_MAX + largest_component(eye), bits = 29 - 1;
    while (reach >> 1) {
        reach >>= 1;
        bits--;
    }
    /* X, Y, W are in the proportion 1/tan_x : 1/tan_y : 1, the largest of them with factor 1. */
    gn_scaled smallest = tan_x;
    if (gn_scaled_add(tan_y, gn_scaled_negate(smallest)).m < 0)
        smallest = tan_y;
    if (gn_scaled_add(one, gn_scaled_negate(smallest)).m < 0)
        smallest = one;
    gn_scaled scale = gn_scaled_shift(smallest, bits);
    if (!make_row_from(&view->row[0], right, eye, gn_scaled_divide(scale, tan_x)) ||
        !make_row_from(&view->row[1], up, eye, gn_scaled_divide(scale, tan_y)) ||
        !make_row_from(&view->row[2], forward, eye, scale))
        return GN_OUT_OF_RANGE;
    negate_row(&view->row[1]);
    view->affine = 0;
    view->unit = scale;
    int64_t near_w = gn_scaled_round(gn_scaled_multiply(scale, gn_scale(near_depth, 0)), 0);
    int64_t far_w = gn_scaled_round(gn_scaled_multiply(scale, gn_scale(far_depth, 0)), 0);
    if (near_w < 64)
        return GN_OUT_OF_RANGE;
    if (far_w > 0x7fffffff)
        far_w = 0x7fffffff;
    view->near_w = (int32_t)near_w;
    view->far_w = (int32_t)far_w;
    return far_w > near_w ? GN_OK : GN_OUT_OF_RANGE;
}

gn_status gn_make_camera_view(gn_view *view, const gn_camera *camera, int32_t width, int32_t height)
{
    set_size(view, width, height);
    view->post_projective_depth = 0;
    if (!are_axes(camera->right, camera->up, camera->forward))
        return GN_OUT_OF_RANGE;
    if (camera->projection == GN_PERSPECTIVE) {
        if (camera->tan_half < (1u << 16) || camera->tan_half > (64u << 24))
            return GN_OUT_OF_RANGE;
        gn_scaled tan_y = gn_scale(camera->tan_half, -24);
        gn_scaled tan_x = gn_scaled_multiply(tan_y, gn_scaled_divide(gn_scale(width, 0), gn_scale(height, 0)));
        return make_projective(view, camera->eye, camera->right, camera->up, camera->forward, tan_x, tan_y,
                               camera->near_depth, camera->far_depth);
    }
    if (camera->projection != GN_ORTHOGRAPHIC)
        return GN_BAD_ARGUMENT;
    int32_t near_depth = camera->near_depth, far_depth = camera->far_depth;
    if (!in_range(camera->eye, GN_EYE_MAX) || camera->half_height < 1 || camera->half_height > (1 << 26) ||
        near_depth < -(1 << 28) || far_depth > (1 << 28) || far_depth < -(1 << 28) + 64 || near_depth > far_depth - 64)
        return GN_OUT_OF_RANGE;
    view->affine = 1;
    /* Q = 2^30 (far - w) / (far - near), within [2^10, 2^30]: greater is nearer, and 0 is kept for clipping. */
    gn_scaled pixel = gn_scaled_divide(gn_scale(view->half_height, 0), gn_scale(camera->half_height, 0));
    gn_scaled depth = gn_scaled_divide(gn_scale((1 << 30) - (1 << 10), 0), gn_scale(far_depth - near_depth, 0));
    gn_row *w = &view->row[2];
    if (!make_row_from(&view->row[0], camera->right, camera->eye, pixel) ||
        !make_row_from(&view->row[1], camera->up, camera->eye, pixel) ||
        !make_row(w, camera->forward, 2 * (int64_t)far_depth, depth))
        return GN_OUT_OF_RANGE;
    for (int i = 0; i < 3; i++)
        w->offset -= gn_multiply(w->m[i], camera->eye[i]);
    negate_row(&view->row[1]);
    negate_row(w);
    view->near_w = 1 << 10; /* the range of stored depth, added in gn_view_place */
    view->far_w = 1 << 30;
    return GN_OK;
}

gn_status gn_make_light_view(gn_view *view, const gn_light *light, int32_t width, int32_t height)
{
    set_size(view, width, height);
    if (!are_axes(light->right, light->up, light->forward))
        return GN_OUT_OF_RANGE;
    if (light->kind == GN_SPOT) {
        if (light->tan_half < (1u << 16) || light->tan_half > (64u << 24))
            return GN_OUT_OF_RANGE;
        gn_scaled tangent = gn_scale(light->tan_half, -24);
        gn_status status = make_projective(view, light->position, light->right, light->up, light->forward, tangent,
                                           tangent, light->near_depth, light->far_depth);
        if (status != GN_OK)
            return status;
        /* z = f / (f - n) (1 - n / w) of the span. */
        gn_scaled far_w = gn_scale(view->far_w, 0), range = gn_scale((int64_t)view->far_w - view->near_w, 0);
        gn_scaled scale = gn_scaled_multiply(gn_scaled_divide(far_w, range), gn_scale(GN_DEPTH_SPAN, -30));
        /* below 2^11, so that two units of Q stay within the guard */
        if (gn_scaled_bits(scale) > 11)
            return GN_OUT_OF_RANGE;
        view->post_projective_depth = 1;
        view->depth_scale = (uint32_t)scale.m;
        view->depth_shift = (uint8_t)-scale.e;
        return GN_OK;
    }
    if (light->kind != GN_DIRECTIONAL)
        return light->kind == GN_POINT ? GN_UNSUPPORTED : GN_BAD_ARGUMENT;
    view->affine = 1;
    view->post_projective_depth = 0;
    int32_t limit = 1 << 28;
    if (light->box_width < 64 || light->box_height < 64 || light->box_depth < 64 || light->box_width > limit ||
        light->box_height > limit || light->box_depth > limit || light->box_u < -limit || light->box_u > limit ||
        light->box_v < -limit || light->box_v > limit || light->box_z < -limit || light->box_z > limit)
        return GN_OUT_OF_RANGE;
    gn_scaled x = gn_scaled_divide(gn_scale(256 * width, 0), gn_scale(light->box_width, 0));
    gn_scaled y = gn_scaled_divide(gn_scale(256 * height, 0), gn_scale(light->box_height, 0));
    gn_scaled z = gn_scaled_divide(gn_scale(GN_DEPTH_SPAN, 0), gn_scale(light->box_depth, 0));
    if (!make_row(&view->row[0], light->right, 2 * (int64_t)light->box_u + light->box_width, x) ||
        !make_row(&view->row[1], light->up, 2 * (int64_t)light->box_v + light->box_height, y) ||
        !make_row(&view->row[2], light->forward, 2 * (int64_t)light->box_z, z))
        return GN_OUT_OF_RANGE;
    negate_row(&view->row[1]);
    view->near_w = GN_DEPTH_GUARD;
    view->far_w = (int32_t)(0x80000000u - GN_DEPTH_GUARD);
    return GN_OK;
}

gn_status gn_view_place(const gn_view *view, const int32_t world[3], gn_place *place)
{
    for (int i = 0; i < 3; i++)
        place->c[i] = gn_apply_row(&view->row[i], world);
    if (!view->affine)
        return GN_OK;
    int64_t limit = (int64_t)1 << 44;
    place->c[2] += view->near_w;
    for (int i = 0; i < 3; i++)
        if (place->c[i] < -limit || place->c[i] > limit)
            return GN_OUT_OF_RANGE;
    return GN_OK;
}

/* Outside what is projected without clipping? */
static int outside(const gn_view *view, const gn_place *place)
{
    int64_t x = place->c[0], y = place->c[1], w = place->c[2];
    if (w < view->near_w || w > view->far_w)
        return 1;
    int64_t reach = view->affine ? GN_MAX_COORDINATE : gn_multiply(view->guard, (int32_t)w);
    return x < -reach || x > reach || y < -reach || y > reach;
}

/* centre + (v / W) half, W given by its reciprocal r 2^(k - 62): the ratio has 27 fraction bits. */
GN_INLINE int32_t project(int32_t v, uint32_t r, unsigned k, int32_t half, int32_t centre)
{
    int32_t ratio = (int32_t)gn_floor_shift_64(gn_multiply(v, (int32_t)r), 35 - k);
    return centre + (int32_t)gn_floor_shift_64(gn_multiply(ratio, half) + (1 << 26), 27);
}

void gn_view_project_inside(const gn_view *view, const gn_place *place, gn_vertex *vertex)
{
    if (view->affine) {
        vertex->x = view->centre_x + (int32_t)place->c[0];
        vertex->y = view->centre_y + (int32_t)place->c[1];
        vertex->depth = (uint32_t)place->c[2];
        return;
    }
    uint32_t w = (uint32_t)place->c[2];
    unsigned k = gn_leading_zeros(w);
    uint32_t r = gn_reciprocal_exact(w << k) >> 1;
    vertex->x = project((int32_t)place->c[0], r, k, view->half_width, view->centre_x);
    vertex->y = project((int32_t)place->c[1], r, k, view->half_height, view->centre_y);
    uint32_t q = (uint32_t)(gn_multiply_u((uint32_t)view->near_w, r) >> (32 - k));
    vertex->depth = q;
    if (view->post_projective_depth)
        vertex->depth =
            GN_DEPTH_GUARD + (uint32_t)(gn_multiply_u(view->depth_scale, (1u << 30) - q) >> view->depth_shift);
}

void gn_view_project(const gn_view *view, const gn_place *place, gn_vertex *vertex)
{
    if (outside(view, place)) {
        vertex->x = vertex->y = 0;
        vertex->depth = 0;
        return;
    }
    gn_view_project_inside(view, place, vertex);
}
