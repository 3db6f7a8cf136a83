#include "footprint.h"

#include "memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- vectors --------------------------------------------------------------------------------------------------- */

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void minus(double out[3], const double a[3], const double b[3])
{
    for (int i = 0; i < 3; i++)
        out[i] = a[i] - b[i];
}

static void cross(double out[3], const double a[3], const double b[3])
{
    out[0] = a[1] * b[2] - a[2] * b[1];
    out[1] = a[2] * b[0] - a[0] * b[2];
    out[2] = a[0] * b[1] - a[1] * b[0];
}

/* out = a + t b */
static void along(double out[3], const double a[3], double t, const double b[3])
{
    for (int i = 0; i < 3; i++)
        out[i] = a[i] + t * b[i];
}

static void unit_axis(double out[3], const gn_q2_30 axis[3])
{
    for (int i = 0; i < 3; i++)
        out[i] = ldexp(axis[i], -30);
}

/* ---- rays ------------------------------------------------------------------------------------------------------ */

/* Where the ray from + t way meets the triangle; NAN where it does not. */
static double meet(const footprint_triangle *t, const double from[3], const double way[3])
{
    double facing = dot(t->normal, way), to[3], side[3], edge[3];
    if (facing == 0)
        return NAN;
    for (int i = 0; i < 3; i++) {
        minus(to, t->corner[i], from);
        minus(edge, t->corner[(i + 1) % 3], t->corner[i]);
        cross(side, to, edge); /* the plane through the ray's start and the edge */
        if (dot(side, way) * facing < 0)
            return NAN;
    }
    minus(to, t->corner[0], from);
    return dot(t->normal, to) / facing;
}

/* From the eye (or the image plane) through a place on the image, in pixels. */
static void camera_ray(const footprint *f, double x, double y, double from[3], double way[3])
{
    const gn_camera *c = &f->packed->camera;
    double width = f->packed->settings.width, height = f->packed->settings.height, right[3], up[3];
    double half = c->projection == GN_PERSPECTIVE ? ldexp(c->tan_half, -24) : c->half_height;
    double across = (2 * x - width) / height * half, upwards = (1 - 2 * y / height) * half;
    unit_axis(right, c->right);
    unit_axis(up, c->up);
    unit_axis(way, c->forward);
    for (int i = 0; i < 3; i++) {
        double aside = across * right[i] + upwards * up[i];
        from[i] = c->eye[i] + (c->projection == GN_PERSPECTIVE ? 0 : aside);
        way[i] += c->projection == GN_PERSPECTIVE ? aside : 0;
    }
}

/* The way from a point to the light, 1 at the light (spot) or of unit length. */
static void to_light(const footprint *f, const double point[3], double way[3])
{
    const gn_light *light = &f->packed->light;
    unit_axis(way, light->forward);
    for (int i = 0; i < 3; i++)
        way[i] = light->kind == GN_DIRECTIONAL ? -way[i] : light->position[i] - point[i];
}

/* Is the segment from point to the light (spot: to its near plane) blocked by a triangle other than `receiver`, more
 * than `least` world integers away? */
static int is_blocked(const footprint *f, const double point[3], int32_t receiver, double least)
{
    const gn_light *light = &f->packed->light;
    double way[3], forward[3], end = INFINITY;
    to_light(f, point, way);
    if (light->kind == GN_SPOT) {
        unit_axis(forward, light->forward);
        double w = -dot(way, forward); /* depth of the point */
        end = 1 - light->near_depth / w;
        least /= sqrt(dot(way, way));
    }
    for (size_t i = 0; i < f->triangle_count; i++) {
        if ((int32_t)i == receiver)
            continue;
        double t = meet(&f->triangles[i], point, way);
        if (t > least && t < end)
            return 1;
    }
    return 0;
}

/* A point on a triangle is found to 1e-6 or better. */
static const double rounding_of_points = 1e-3;

/* The plane of a receiver, extended over its neighbours of one flat face, is off by the rounding of their corners. */
static const double rounding_of_faces = 2;

static int in_frustum(const footprint *f, const double point[3])
{
    const gn_light *light = &f->packed->light;
    if (light->kind == GN_DIRECTIONAL)
        return 1;
    double axis[3], from[3], place[3] = {light->position[0], light->position[1], light->position[2]};
    minus(from, point, place);
    unit_axis(axis, light->forward);
    double w = dot(axis, from), reach = w * ldexp(light->tan_half, -24);
    unit_axis(axis, light->right);
    double u = fabs(dot(axis, from));
    unit_axis(axis, light->up);
    double v = fabs(dot(axis, from));
    return w >= light->near_depth && w <= light->far_depth && u <= reach && v <= reach;
}

/* ---- the image ------------------------------------------------------------------------------------------------- */

static void see(footprint *f, size_t pixel, double x, double y)
{
    const gn_camera *c = &f->packed->camera;
    double from[3], way[3], light[3], nearest = INFINITY;
    camera_ray(f, x, y, from, way);
    f->receiver[pixel] = -1;
    f->mask[pixel] = 255;
    for (size_t i = 0; i < f->triangle_count; i++) {
        double t = meet(&f->triangles[i], from, way);
        if (t >= c->near_depth && t <= c->far_depth && t < nearest) {
            nearest = t;
            f->receiver[pixel] = (int32_t)i;
        }
    }
    if (f->receiver[pixel] < 0)
        return;
    double *point = f->points[pixel];
    const footprint_triangle *t = &f->triangles[f->receiver[pixel]];
    along(point, from, nearest, way);
    to_light(f, point, light);
    int same_side = dot(t->normal, light) * dot(t->normal, way) < 0;
    f->mask[pixel] =
        same_side && in_frustum(f, point) && !is_blocked(f, point, f->receiver[pixel], rounding_of_points) ? 254 : 0;
}

static void take_triangles(footprint *f)
{
    for (uint32_t m = 0; m < f->packed->mesh_count; m++)
        f->triangle_count += f->packed->meshes[m].triangle_count;
    f->triangles = memory_take(f->triangle_count, sizeof *f->triangles);
    footprint_triangle *t = f->triangles;
    for (uint32_t m = 0; m < f->packed->mesh_count; m++) {
        const gn_mesh *mesh = &f->packed->meshes[m];
        const uint32_t *wide = mesh->index_size == 4 ? mesh->indices : 0;
        const uint16_t *narrow = mesh->index_size == 2 ? mesh->indices : 0;
        for (uint32_t i = 0; i < mesh->triangle_count; i++, t++) {
            double first[3], second[3];
            for (uint32_t k = 0; k < 9; k++) {
                uint32_t index = wide ? wide[3 * i + k / 3] : narrow[3 * i + k / 3];
                t->corner[k / 3][k % 3] = mesh->vertices[index][k % 3];
            }
            minus(first, t->corner[1], t->corner[0]);
            minus(second, t->corner[2], t->corner[0]);
            cross(t->normal, first, second);
        }
    }
}

void footprint_make(footprint *f, const packed_scene *packed)
{
    uint32_t width = packed->settings.width, height = packed->settings.height;
    size_t count = (size_t)width * height;
    memset(f, 0, sizeof *f);
    f->packed = packed;
    f->map_width = packed->settings.map_width;
    f->map_height = packed->settings.map_height;
    f->answers = memory_take(count, 1);
    f->mask = memory_take(count, 1);
    f->receiver = memory_take(count, sizeof *f->receiver);
    f->points = memory_take(count, sizeof *f->points);
    take_triangles(f);
    for (size_t i = 0; i < count; i++)
        see(f, i, (double)(i % width) + 0.5, (double)(i / width) + 0.5);
}

void footprint_free(footprint *f)
{
    free(f->answers);
    free(f->mask);
    free(f->receiver);
    free(f->points);
    free(f->triangles);
    memset(f, 0, sizeof *f);
}

/* ---- texels ---------------------------------------------------------------------------------------------------- */

/* A light's map: a place in texels from its top left corner, and the ray of light through such a place. */
typedef struct map_frame {
    double right[3], up[3], forward[3], place[3];
    double width, height; /* of the box, or 2 tan: at distance 1 */
} map_frame;

static map_frame frame_of(const footprint *f)
{
    const gn_light *light = &f->packed->light;
    map_frame m;
    unit_axis(m.right, light->right);
    unit_axis(m.up, light->up);
    unit_axis(m.forward, light->forward);
    for (int i = 0; i < 3; i++)
        m.place[i] = light->position[i];
    m.width = light->kind == GN_DIRECTIONAL ? light->box_width : ldexp(light->tan_half, -23);
    m.height = light->kind == GN_DIRECTIONAL ? light->box_height : ldexp(light->tan_half, -23);
    return m;
}

static void texel_place(const footprint *f, const map_frame *m, const double point[3], double place[2])
{
    const gn_light *light = &f->packed->light;
    double from[3], u, v;
    if (light->kind == GN_DIRECTIONAL) {
        u = dot(m->right, point) - light->box_u;
        v = dot(m->up, point) - light->box_v;
    } else {
        minus(from, point, m->place);
        double w = dot(m->forward, from);
        u = dot(m->right, from) / w + m->width / 2;
        v = dot(m->up, from) / w + m->height / 2;
    }
    place[0] = u / m->width * f->map_width;
    place[1] = (1 - v / m->height) * f->map_height;
}

/* A point on the ray of light through a place, and the way that light travels there. */
static void texel_ray(const footprint *f, const map_frame *m, const double place[2], double from[3], double way[3])
{
    const gn_light *light = &f->packed->light;
    double u = place[0] / f->map_width * m->width, v = (1 - place[1] / f->map_height) * m->height;
    int directional = light->kind == GN_DIRECTIONAL;
    u += directional ? light->box_u : -m->width / 2;
    v += directional ? light->box_v : -m->height / 2;
    for (int i = 0; i < 3; i++) {
        double aside = u * m->right[i] + v * m->up[i];
        from[i] = directional ? aside : m->place[i];
        way[i] = m->forward[i] + (directional ? 0 : aside);
    }
}

static int centre_differs(const footprint *f, const map_frame *m, int32_t receiver, const double place[2],
                          uint8_t truth)
{
    double from[3], way[3], to[3], point[3];
    const footprint_triangle *t = &f->triangles[receiver];
    texel_ray(f, m, place, from, way);
    minus(to, t->corner[0], from);
    double facing = dot(t->normal, way), distance = dot(t->normal, to) / facing;
    if (facing == 0 || (f->packed->light.kind == GN_SPOT && distance <= f->packed->light.near_depth))
        return 1;
    along(point, from, distance, way);
    return (is_blocked(f, point, receiver, rounding_of_faces) ? 0 : 254) != truth;
}

/* Columns (or rows) that a coordinate may fall into; clamped to the map. */
static int centres_of(double coordinate, uint32_t count, double centres[2])
{
    const double slack = 1.0 / 32;
    int found = 0;
    for (int i = -1; i <= 1; i += 2) {
        double texel = fmin(fmax(floor(coordinate + i * slack), 0), count - 1.0) + 0.5;
        if (!found || centres[0] != texel)
            centres[found++] = texel;
    }
    return found;
}

int footprint_differs(footprint *f, size_t pixel, uint8_t truth)
{
    enum { UNKNOWN, SAME, DIFFERENT };
    if (f->answers[pixel] != UNKNOWN)
        return f->answers[pixel] == DIFFERENT;
    const double slack = 1.0 / 32;
    map_frame m = frame_of(f);
    double place[2], columns[2], rows[2];
    texel_place(f, &m, f->points[pixel], place);
    int different = 0, column_count = centres_of(place[0], f->map_width, columns),
        row_count = centres_of(place[1], f->map_height, rows);
    for (int i = 0; i < column_count * row_count * 9 && !different; i++) {
        int step = i / 9, x = i % 3 - 1, y = i / 3 % 3 - 1;
        const double centre[2] = {columns[step % column_count] + x * slack, rows[step / column_count] + y * slack};
        different = centre_differs(f, &m, f->receiver[pixel], centre, truth);
    }
    f->answers[pixel] = different ? DIFFERENT : SAME;
    return different;
}

int footprint_differs_about(const footprint *f, size_t pixel, uint8_t truth, int radius)
{
    const double slack = 1.0 / 32;
    map_frame m = frame_of(f);
    double place[2];
    texel_place(f, &m, f->points[pixel], place);
    int first_column = (int)floor(place[0] - slack) - radius, last_column = (int)floor(place[0] + slack) + radius;
    int first_row = (int)floor(place[1] - slack) - radius, last_row = (int)floor(place[1] + slack) + radius;
    for (int row = first_row; row <= last_row; row++)
        for (int column = first_column; column <= last_column; column++)
            for (int i = 0; i < 9; i++) {
                const double centre[2] = {column + 0.5 + (i % 3 - 1) * slack, row + 0.5 + (i / 3 - 1) * slack};
                if (centre_differs(f, &m, f->receiver[pixel], centre, truth))
                    return 1;
            }
    return 0;
}

int footprint_is_edge_on(const footprint *f, size_t pixel)
{
    double way[3];
    const double *normal = f->triangles[f->receiver[pixel]].normal;
    to_light(f, f->points[pixel], way);
    return fabs(dot(normal, way)) < ldexp(sqrt(dot(normal, normal) * dot(way, way)), -24);
}

double footprint_texel(const footprint *f, const double point[3])
{
    map_frame m = frame_of(f);
    double from[3];
    minus(from, point, m.place);
    double scale = f->packed->light.kind == GN_DIRECTIONAL ? 1 : dot(m.forward, from);
    return scale * fmax(m.width / f->map_width, m.height / f->map_height);
}
