/* For tests of fits and warps: random tables of a warped map, and cameras and lights that see a scene. */
#ifndef WARPS_H
#define WARPS_H

#include "gn_parameterisation.h"
#include "scenes.h"

/* What the tables of a map may look like: even, anywhere, all together at one end but for one, about the middle. */
typedef enum spread { EVEN, ANYWHERE, AT_FIRST, AT_LAST, ABOUT_MIDDLE, SPREADS } spread;

/* count strictly increasing numbers below GN_FINE. */
static TAP_UNUSED void make_table(uint16_t *table, int32_t count, spread how)
{
    static uint8_t taken[GN_FINE];
    int32_t n = 0;
    memset(taken, 0, sizeof taken);
    for (int32_t i = 0; i < count; i++) {
        int32_t at = how == EVEN ? (2 * i + 1) * GN_FINE / (2 * count) : i;
        if (how == AT_FIRST && i > 0 && i == count - 1)
            at = between(i, GN_FINE - 1);
        if (how == AT_LAST)
            at = GN_FINE - 1 - i;
        if (how == AT_LAST && i > 0 && i == count - 1)
            at = between(0, GN_FINE - 1 - i);
        if (how == ABOUT_MIDDLE)
            at = (GN_FINE - count) / 2 + i;
        while (how == ANYWHERE && taken[at = between(0, GN_FINE - 1)])
            continue;
        taken[at] = 1;
    }
    for (int32_t at = 0; at < GN_FINE; at++)
        if (taken[at])
            table[n++] = (uint16_t)at;
    if (n != count)
        abort();
}

static TAP_UNUSED spread random_spread(void)
{
    return (spread)(between(0, 1) ? ANYWHERE : between(0, SPREADS - 1));
}

/* Instead of what a view pass has found. */
static TAP_UNUSED void set_tables(gn_context *context)
{
    gn_fitting *fitting = context->fitting;
    int32_t width = context->settings.map_width, height = context->settings.map_height;
    if (context->grid->columns) {
        make_table(fitting->columns, width, random_spread());
        make_table(fitting->rows, height, random_spread());
        return;
    }
    for (int32_t band = 0; band < height; band++)
        make_table(fitting->columns + band * width, width, random_spread());
    for (int32_t column = 0; column < width; column++)
        make_table(fitting->rows + column * height, height, random_spread());
}

/* The fine column and row of a texel, by definition: a texel of a non-orthogonal map lies in the row that its column
 * has for it, and there in the column that the row's band has for it. */
static TAP_UNUSED void fine_place(const gn_context *context, int32_t column, int32_t row, int32_t fine[2])
{
    const gn_fitting *f = context->fitting;
    int32_t width = context->settings.map_width, height = context->settings.map_height, band = 0;
    if (context->grid->columns) {
        fine[0] = f->columns[column];
        fine[1] = f->rows[row];
        return;
    }
    fine[1] = f->rows[column * height + row];
    while ((int64_t)(band + 1) * GN_FINE <= (int64_t)fine[1] * height) /* band b: [b, b + 1) GN_FINE / height */
        band++;
    fine[0] = f->columns[band * width + column];
}

/* Are all of a map's tables strictly increasing and below GN_FINE? */
static TAP_UNUSED int tables_are_monotone(const gn_context *context)
{
    const gn_fitting *f = context->fitting;
    int32_t width = context->settings.map_width, height = context->settings.map_height;
    int32_t lines = context->grid->columns ? 1 : height, good = 1;
    for (int32_t line = 0; line < lines; line++)
        for (int32_t i = 0; i < width; i++)
            good &= f->columns[line * width + i] < GN_FINE &&
                    (i == 0 || f->columns[line * width + i] > f->columns[line * width + i - 1]);
    lines = context->grid->columns ? 1 : width;
    for (int32_t line = 0; line < lines; line++)
        for (int32_t i = 0; i < height; i++)
            good &= f->rows[line * height + i] < GN_FINE &&
                    (i == 0 || f->rows[line * height + i] > f->rows[line * height + i - 1]);
    return good;
}

static const gn_warp *const warps[] = {&gn_rectilinear, &gn_rectilinear_distance, &gn_nonorthogonal};
static const gn_fit *const fits[] = {0, &gn_desired_view, &gn_minimal_frustum};

static TAP_UNUSED const char *warp_name(const gn_warp *warp)
{
    return !warp                       ? "uniform"
           : warp == &gn_rectilinear   ? "rectilinear"
           : warp == &gn_nonorthogonal ? "non-orthogonal"
                                       : "rectilinear by distance";
}

static TAP_UNUSED const char *fit_name(const gn_fit *fit)
{
    return !fit ? "no fit" : fit == &gn_desired_view ? "desired view" : "minimal frustum";
}

/* A camera that looks down z on [x, x + size] x [y, y + size], upright; the image is square. */
static TAP_UNUSED gn_status camera_above(gn_camera *camera, int32_t x, int32_t y, int32_t size)
{
    int32_t eye[3] = {x + size / 2, y + size / 2, 1000}, target[3] = {x + size / 2, y + size / 2, 0}, up[3] = {0, 1, 0};
    gn_status status = gn_look_at(camera, eye, target, up);
    return status == GN_OK ? gn_orthographic(camera, size / 2, 0, 1 << 20) : status;
}

/* A camera about a scene of a radius of about 1000 about the origin, of either projection, that sees some of it. */
static TAP_UNUSED gn_status random_camera(gn_camera *camera)
{
    int32_t eye[3], target[3], up[3] = {0, 0, 1};
    gn_status status;
    do {
        for (int i = 0; i < 3; i++) {
            eye[i] = between(-4000, 4000);
            target[i] = between(-500, 500);
        }
        eye[2] = between(200, 4000);
        status = gn_look_at(camera, eye, target, up);
    } while (status != GN_OK);
    return between(0, 2) ? gn_perspective(camera, GN_DEGREES(between(15, 90)), between(150, 300), 1 << 16)
                         : gn_orthographic(camera, between(100, 1500), -10000, 1 << 15);
}

/* A light above that scene. */
static TAP_UNUSED gn_status random_light_above(gn_light *light, const gn_scene *scene, int spot)
{
    int32_t position[3], target[3], direction[3];
    for (int i = 0; i < 3; i++) {
        position[i] = between(-2000, 2000);
        target[i] = between(-300, 300);
        direction[i] = between(-1000, 1000);
    }
    position[2] = between(1500, 5000);
    direction[2] = between(-1000, -300);
    memset(light, 0, sizeof *light);
    if (spot)
        return gn_spot_light(light, position, target, 0, GN_DEGREES(between(20, 110)), between(100, 800),
                             between(6000, 12000));
    gn_status status = gn_directional_light(light, direction, 0);
    return status == GN_OK ? gn_fit_light(light, scene) : status;
}

#endif
