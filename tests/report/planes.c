/* Planes of receivers, by the matrices of Wang & Molnar 1994, section 3.4 and figure 11, beside those that gnomon makes
 * of a triangle's corners: a section of docs/papers.md.
 *
 *     planes SCENE [options of gnomon render]
 *
 * For every pixel that is turned to the light and lies on the map: its plane in the world, T = (n, -n P) from the
 * triangle's normal and a corner; in the light's screen ((M_PL M_L)^-1)^T T, in double precision, by a matrix that is
 * made of the light's numbers alone; z at the centre of the texel that holds the pixel, -(a x + b y + d) / c. The same
 * of gnomon's plane. On standard output: pixels; how far the two lie apart, on the mean and at most, in units of the
 * map; and the most of what a plane says of its own error. Spot and directional lights, no fit or warp. Exit status: 0
 * done, 1 two lie farther apart than the plane says, 2 bad usage or input. */
#include "frame.h"
#include "gn_cascade.h"
#include "render_options.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const option table[] = {RENDER_OPTIONS};
enum { OPTION_COUNT = sizeof table / sizeof *table };

typedef long double matrix[4][4];

/* What the wrapped receiver reads and writes: its callbacks carry no pointer of ours, and there is one worker. */
static struct {
    matrix transform; /* of planes, from the world to the light's screen */
    uint64_t pixels, beyond, steep;
    double sum, most, most_share; /* units of the map; of what a plane says of its error */
} seen;

/* ---- matrices -------------------------------------------------------------------------------------------------- */

static long double dot(const gn_q2_30 axis[3], int i)
{
    return ldexpl(axis[i], -30);
}

/* A row: along an axis, less what it is at an origin, times a factor. */
static void set_row(long double row[4], const gn_q2_30 axis[3], long double origin, long double factor)
{
    for (int i = 0; i < 3; i++)
        row[i] = dot(axis, i) * factor;
    row[3] = -origin * factor;
}

static long double at_position(const gn_light *light, const gn_q2_30 axis[3])
{
    long double sum = 0;
    for (int i = 0; i < 3; i++)
        sum += dot(axis, i) * light->position[i];
    return sum;
}

/* From the world to texels from the map's corner, and depth 0 to 1. */
static void make_directional(matrix m, const gn_light *light, int width, int height)
{
    set_row(m[0], light->right, light->box_u, (long double)width / light->box_width);
    set_row(m[1], light->up, (long double)light->box_v + light->box_height, -(long double)height / light->box_height);
    set_row(m[2], light->forward, light->box_z, 1.0L / light->box_depth);
    m[3][3] = 1;
}

static void make_spot(matrix m, const gn_light *light, int width, int height)
{
    long double tangent = ldexpl(light->tan_half, -24), near = light->near_depth, far = light->far_depth;
    set_row(m[3], light->forward, at_position(light, light->forward), 1);
    set_row(m[0], light->right, at_position(light, light->right), width / tangent / 2);
    set_row(m[1], light->up, at_position(light, light->up), -height / tangent / 2);
    for (int i = 0; i < 4; i++) {
        m[0][i] += m[3][i] * width / 2;
        m[1][i] += m[3][i] * height / 2;
        m[2][i] = m[3][i] * far / (far - near); /* (1 - near / w) far / (far - near), times w */
    }
    m[2][3] -= near * far / (far - near);
}

static void swap_rows(matrix m, int a, int b)
{
    for (int i = 0; i < 4; i++) {
        long double kept = m[a][i];
        m[a][i] = m[b][i];
        m[b][i] = kept;
    }
}

/* Gauss and Jordan, by the largest pivot. */
static void invert(matrix m, matrix out)
{
    for (int i = 0; i < 16; i++)
        out[i / 4][i % 4] = i / 4 == i % 4;
    for (int k = 0; k < 4; k++) {
        int pivot = k;
        for (int i = k + 1; i < 4; i++)
            pivot = fabsl(m[i][k]) > fabsl(m[pivot][k]) ? i : pivot;
        swap_rows(m, k, pivot);
        swap_rows(out, k, pivot);
        for (int i = 0; i < 4; i++) {
            long double factor = i == k ? 1 - 1 / m[k][k] : m[i][k] / m[k][k];
            for (int c = 0; c < 4; c++) {
                out[i][c] -= factor * out[k][c];
                m[i][c] -= factor * m[k][c];
            }
        }
    }
}

static void make_transform(const gn_light *light, int width, int height)
{
    matrix m = {{0}}, inverse;
    if (light->kind == GN_SPOT)
        make_spot(m, light, width, height);
    else
        make_directional(m, light, width, height);
    invert(m, inverse);
    for (int i = 0; i < 16; i++)
        seen.transform[i / 4][i % 4] = inverse[i % 4][i / 4];
}

/* ---- planes ---------------------------------------------------------------------------------------------------- */

/* Depth of a triangle's plane at the centre of a texel, in units of 2^-32 of the range, as vertices of the light pass
 * have it: GN_DEPTH_GUARD away from both ends. */
static double depth_by_matrices(const gn_context *context, uint32_t triangle, uint32_t column, uint32_t row)
{
    const gn_object *object = &context->scene->objects[triangle >> context->triangle_bits];
    int32_t world[3][3];
    int64_t normal[3];
    long double plane[4] = {0}, light[4] = {0};
    (void)gn_triangle_world(object, triangle & (((uint32_t)1 << context->triangle_bits) - 1), world);
    gn_normal(normal, world);
    for (int i = 0; i < 3; i++) {
        plane[i] = normal[i];
        plane[3] -= plane[i] * world[0][i];
    }
    for (int i = 0; i < 16; i++)
        light[i / 4] += seen.transform[i / 4][i % 4] * plane[i % 4];
    long double z = -(light[0] * (column + .5L) + light[1] * (row + .5L) + light[3]) / light[2];
    return (double)(2 * (GN_DEPTH_GUARD + z * GN_DEPTH_SPAN));
}

static void compare_planes(const gn_context *context, gn_worker *worker, gn_points *points)
{
    uint32_t bits = gn_point_bits(context);
    for (int32_t i = 0; i < points->count; i++) {
        if (points->triangle[i] == GN_NO_TRIANGLE || points->u[i] == GN_NOWHERE)
            continue;
        const gn_receiver_plane *plane = gn_find_plane(context, worker, points->triangle[i], 0);
        if (!plane->faces_light || !plane->exists)
            continue;
        if (plane->slack >> 32) { /* too steep for 64 bits: it says that it knows nothing */
            seen.steep++;
            continue;
        }
        uint32_t column = gn_texel(points->u[i], context->settings.map_width - 1u, bits);
        uint32_t row = gn_texel(points->v[i], context->settings.map_height - 1u, bits);
        double own = (double)gn_wide_depth(&plane->plane, (int32_t)column, (int32_t)row);
        double apart = fabs(own - depth_by_matrices(context, points->triangle[i], column, row));
        seen.pixels++;
        seen.beyond += apart > (double)plane->slack;
        seen.sum += ldexp(apart, GN_DEPTH_BITS - 32);
        seen.most = fmax(seen.most, ldexp(apart, GN_DEPTH_BITS - 32));
        seen.most_share = fmax(seen.most_share, apart / (double)plane->slack);
    }
}

/* ---- the program ----------------------------------------------------------------------------------------------- */

typedef struct job {
    packed_scene packed;
    gn_settings settings;
    frame frame;
    problem why;
} job;

static int run(job *j, const char *scene, const char *const values[])
{
    gn_receiver wrapped = gn_virtual;
    if (packed_read(&j->packed, scene, 0, &j->why) || render_options_read(&j->settings, &j->packed, values, &j->why))
        return -1;
    if (j->packed.light.kind == GN_POINT || j->settings.fit || j->settings.warp)
        return problem_in(&j->why, scene, "expected a directional or spot light, and a map neither fitted nor warped");
    make_transform(&j->packed.light, j->settings.map_width, j->settings.map_height);
    wrapped.prepare = compare_planes;
    wrapped.sunlit = wrapped.spotlit = 0; /* short cuts, past prepare */
    j->settings.receiver = &wrapped;
    j->settings.reconstruction = 0;
    j->settings.mask = 1;
    j->settings.format = GN_NO_COLOUR;
    return frame_open(&j->frame, &j->packed.scene, &j->settings, 0, &j->why) ||
                   frame_light_pass(&j->frame, &j->packed.light, &j->why) ||
                   frame_camera_pass(&j->frame, &j->packed.camera, &j->why)
               ? -1
               : 0;
}

int main(int argc, char **argv)
{
    const char *values[OPTION_COUNT];
    command_line line;
    job j;
    memset(&j, 0, sizeof j);
    int result = options_parse(table, OPTION_COUNT, argc - 1, argv + 1, values, &line, &j.why);
    if (!result && line.place_count != 1)
        result = problem_of_usage(&j.why, "%d scenes; expected SCENE [options of gnomon render]", line.place_count);
    if (!result)
        result = run(&j, line.places[0], values);
    if (result)
        fprintf(stderr, "%s\n", j.why.text);
    else
        printf("%llu pixels, %llu more of planes too steep; apart %.4f units of the map on the mean, %.3f at most; at "
               "most "
               "%.3f of what the plane says; beyond that %llu\n",
               (unsigned long long)seen.pixels, (unsigned long long)seen.steep,
               seen.pixels ? seen.sum / (double)seen.pixels : 0, seen.most, seen.most_share,
               (unsigned long long)seen.beyond);
    frame_close(&j.frame);
    packed_free(&j.packed);
    return result ? 2 : seen.beyond != 0;
}
