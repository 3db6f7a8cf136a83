#include "builder.h"

#include "memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double pi = 3.14159265358979323846;

void build_begin(builder *b)
{
    memset(b, 0, sizeof *b);
    b->unit = BUILD_METRE;
    b->width = 160;
    b->height = 120;
    b->map_width = b->map_height = 64;
    b->bias = (gn_bias){GN_BIAS_TEXELS, 2 << 16};
}

/* ---- meshes ---------------------------------------------------------------------------------------------------- */

static void begin_mesh(builder *b, int closed, gn_rgb colour)
{
    b->meshes = memory_grow(b->meshes, &b->mesh_room, b->mesh_count + 1, sizeof *b->meshes);
    b->meshes[b->mesh_count++] = (build_mesh){.closed = closed, .colour = colour};
}

void build_solid(builder *b, uint8_t red, uint8_t green, uint8_t blue)
{
    begin_mesh(b, 1, (gn_rgb){red, green, blue});
}

void build_sheet(builder *b, uint8_t red, uint8_t green, uint8_t blue)
{
    begin_mesh(b, 0, (gn_rgb){red, green, blue});
}

static build_mesh *latest(builder *b)
{
    return &b->meshes[b->mesh_count - 1];
}

size_t build_vertex_count(const builder *b)
{
    return b->meshes[b->mesh_count - 1].vertex_count;
}

uint32_t build_vertex(builder *b, double x, double y, double z)
{
    build_mesh *m = latest(b);
    m->vertices = memory_grow(m->vertices, &m->vertex_room, m->vertex_count + 1, sizeof *m->vertices);
    double *v = m->vertices[m->vertex_count];
    v[0] = x, v[1] = y, v[2] = z;
    return (uint32_t)m->vertex_count++;
}

void build_triangle(builder *b, uint32_t v0, uint32_t v1, uint32_t v2)
{
    build_mesh *m = latest(b);
    m->triangles = memory_grow(m->triangles, &m->triangle_room, m->triangle_count + 1, sizeof *m->triangles);
    uint32_t *t = m->triangles[m->triangle_count++];
    t[0] = v0, t[1] = v1, t[2] = v2;
}

void build_quad(builder *b, const double corners[4][3])
{
    uint32_t first = (uint32_t)build_vertex_count(b);
    for (int i = 0; i < 4; i++)
        build_vertex(b, corners[i][0], corners[i][1], corners[i][2]);
    build_triangle(b, first, first + 1, first + 2);
    build_triangle(b, first, first + 2, first + 3);
}

void build_level(builder *b, double x0, double x1, double y, double z0, double z1)
{
    const double corners[4][3] = {{x0, y, z1}, {x1, y, z1}, {x1, y, z0}, {x0, y, z0}};
    build_quad(b, corners);
}

void build_floor(builder *b, double half_width, double half_depth)
{
    build_solid(b, 200, 200, 190);
    build_box(b, -half_width, half_width, -0.5, 0, -half_depth, half_depth);
}

void build_prism(builder *b, const double (*outline)[2], int corners, double z0, double z1)
{
    uint32_t first = (uint32_t)build_vertex_count(b), n = (uint32_t)corners;
    for (int i = 0; i < corners; i++)
        build_vertex(b, outline[i][0], outline[i][1], z1);
    for (int i = 0; i < corners; i++)
        build_vertex(b, outline[i][0], outline[i][1], z0);
    for (uint32_t i = 1; i + 1 < n; i++) {
        build_triangle(b, first, first + i, first + i + 1);
        build_triangle(b, first + n, first + n + i + 1, first + n + i);
    }
    for (uint32_t i = 0; i < n; i++) {
        uint32_t next = (i + 1) % n;
        build_triangle(b, first + i, first + n + i, first + n + next);
        build_triangle(b, first + i, first + n + next, first + next);
    }
}

void build_box(builder *b, double x0, double x1, double y0, double y1, double z0, double z1)
{
    const double outline[4][2] = {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
    build_prism(b, outline, 4, z0, z1);
}

void build_sphere(builder *b, double x, double y, double z, double radius, int bands, int sides)
{
    uint32_t bottom = build_vertex(b, x, y - radius, z), n = (uint32_t)sides;
    for (int i = 1; i < bands; i++)
        for (int k = 0; k < sides; k++) {
            double down = pi * i / bands, round = 2 * pi * k / sides;
            build_vertex(b, x + radius * sin(down) * cos(round), y - radius * cos(down),
                         z - radius * sin(down) * sin(round));
        }
    uint32_t top = build_vertex(b, x, y + radius, z);
    for (uint32_t k = 0; k < n; k++) {
        uint32_t next = (k + 1) % n, last = bottom + 1 + (uint32_t)(bands - 2) * n;
        build_triangle(b, bottom, bottom + 1 + next, bottom + 1 + k);
        build_triangle(b, top, last + k, last + next);
        for (uint32_t i = 0; i + 2 < (uint32_t)bands; i++) {
            uint32_t low = bottom + 1 + i * n, high = low + n;
            build_triangle(b, low + k, low + next, high + next);
            build_triangle(b, low + k, high + next, high + k);
        }
    }
}

void build_turn(builder *b, size_t first, int axis, double degrees, double x, double y, double z)
{
    build_mesh *m = latest(b);
    const double about[3] = {x, y, z};
    double sine = sin(degrees * pi / 180), cosine = cos(degrees * pi / 180);
    int i = (axis + 1) % 3, k = (axis + 2) % 3;
    for (size_t v = first; v < m->vertex_count; v++) {
        double p = m->vertices[v][i] - about[i], q = m->vertices[v][k] - about[k];
        m->vertices[v][i] = about[i] + cosine * p - sine * q;
        m->vertices[v][k] = about[k] + sine * p + cosine * q;
    }
}

void build_invert(builder *b)
{
    build_mesh *m = latest(b);
    for (size_t t = 0; t < m->triangle_count; t++) {
        uint32_t second = m->triangles[t][1];
        m->triangles[t][1] = m->triangles[t][2];
        m->triangles[t][2] = second;
    }
}

/* ---- cameras and lights ---------------------------------------------------------------------------------------- */

static int32_t to_integer(double value)
{
    double rounded = round(value);
    return rounded > INT32_MAX ? INT32_MAX : rounded < INT32_MIN ? INT32_MIN : (int32_t)rounded;
}

static void to_world(const builder *b, const double metres[3], int32_t world[3])
{
    for (int i = 0; i < 3; i++)
        world[i] = to_integer(metres[i] * b->unit + b->origin[i]);
}

static int32_t length_of(const builder *b, double metres)
{
    return to_integer(metres * b->unit);
}

/* Directions have no unit: 2^26 is as exact as the core's ranges allow with room to spare. */
static void to_direction(const double v[3], int32_t direction[3])
{
    double largest = fmax(fabs(v[0]), fmax(fabs(v[1]), fabs(v[2])));
    for (int i = 0; i < 3; i++)
        direction[i] = to_integer(ldexp(v[i] / largest, 26));
}

static gn_angle to_angle(double degrees)
{
    return (gn_angle)(int64_t)llround(degrees / 360 * 4294967296.0);
}

static void keep_status(builder *b, gn_status status)
{
    if (b->status == GN_OK)
        b->status = status;
}

static void look(builder *b, const double eye[3], const double target[3], const double up[3])
{
    int32_t e[3], t[3], u[3];
    to_world(b, eye, e);
    to_world(b, target, t);
    to_direction(up, u);
    keep_status(b, gn_look_at(&b->camera, e, t, u));
}

/* Deep enough for every scene here: orthographic depth is linear and its planes need no care. */
static void make_orthographic(builder *b, double half_height)
{
    int32_t reach = length_of(b, 16);
    keep_status(b, gn_orthographic(&b->camera, length_of(b, half_height), -reach, reach));
}

void build_camera_above(builder *b, double x, double z, double half_height)
{
    const double eye[3] = {x, 4, z}, target[3] = {x, 0, z}, up[3] = {0, 0, -1};
    look(b, eye, target, up);
    make_orthographic(b, half_height);
}

void build_camera_orthographic(builder *b, const double eye[3], const double target[3], double half_height)
{
    const double up[3] = {0, 1, 0};
    look(b, eye, target, up);
    make_orthographic(b, half_height);
}

void build_camera_perspective(builder *b, const double eye[3], const double target[3], double degrees,
                              double near_depth, double far_depth)
{
    const double up[3] = {0, 1, 0};
    look(b, eye, target, up);
    keep_status(b, gn_perspective(&b->camera, to_angle(degrees), length_of(b, near_depth), length_of(b, far_depth)));
}

void build_sun(builder *b, double x, double y, double z)
{
    const double v[3] = {x, y, z};
    int32_t direction[3];
    to_direction(v, direction);
    keep_status(b, gn_directional_light(&b->light, direction, 0));
    b->fit_light = 1;
}

void build_sun_box(builder *b, double u, double v, double width, double height, double z, double depth)
{
    b->fit_light = 0;
    b->light.box_u = length_of(b, u - width / 2);
    b->light.box_v = length_of(b, v - height / 2);
    b->light.box_z = length_of(b, z);
    b->light.box_width = length_of(b, width);
    b->light.box_height = length_of(b, height);
    b->light.box_depth = length_of(b, depth);
}

void build_low_sun(builder *b, double degrees)
{
    build_sun(b, cos(degrees * pi / 180), -sin(degrees * pi / 180), 0);
    build_sun_box(b, 0, 0, 4, 4, -4, 8);
}

void build_noon(builder *b)
{
    build_sun(b, 0, -1, 0);
    build_sun_box(b, 0, 0, 4, 4, -4, 8);
}

void build_view_from_above(builder *b, double sun_degrees)
{
    build_camera_above(b, 0, 0, 1.25);
    build_low_sun(b, sun_degrees);
}

void build_spot(builder *b, const double position[3], const double target[3], double degrees, double near_depth,
                double far_depth)
{
    int32_t p[3], t[3];
    to_world(b, position, p);
    to_world(b, target, t);
    b->fit_light = 0;
    keep_status(
        b, gn_spot_light(&b->light, p, t, 0, to_angle(degrees), length_of(b, near_depth), length_of(b, far_depth)));
}

/* ---- integers -------------------------------------------------------------------------------------------------- */

static void round_mesh(const builder *b, const build_mesh *from, gn_mesh *to)
{
    int32_t(*vertices)[3] = memory_take(from->vertex_count, sizeof *vertices);
    uint32_t *indices = memory_take(3 * from->triangle_count, sizeof *indices);
    for (size_t v = 0; v < from->vertex_count; v++)
        to_world(b, from->vertices[v], vertices[v]);
    for (size_t i = 0; i < 3 * from->triangle_count; i++)
        indices[i] = from->triangles[i / 3][i % 3];
    to->vertices = (const int32_t(*)[3])vertices;
    to->indices = indices;
    to->vertex_count = (uint32_t)from->vertex_count;
    to->triangle_count = (uint32_t)from->triangle_count;
    to->index_size = 4;
    to->closed = (uint8_t)from->closed;
}

int build_finish(builder *b, packed_scene *packed)
{
    memset(packed, 0, sizeof *packed);
    packed->meshes = memory_take(b->mesh_count, sizeof *packed->meshes);
    packed->objects = memory_take(b->mesh_count, sizeof *packed->objects);
    packed->mesh_count = (uint32_t)b->mesh_count;
    for (size_t i = 0; i < b->mesh_count; i++) {
        round_mesh(b, &b->meshes[i], &packed->meshes[i]);
        packed->objects[i] = (gn_object){.mesh = &packed->meshes[i], .colour = b->meshes[i].colour};
    }
    packed->scene.objects = packed->objects;
    packed->scene.object_count = packed->mesh_count;
    packed->scene.background = (gn_rgb){40, 44, 52};
    packed->scene.ambient = 19661; /* 0.3 */
    if (b->fit_light)
        keep_status(b, gn_fit_light(&b->light, &packed->scene));
    packed->camera = b->camera;
    packed->light = b->light;
    packed->settings = gn_default_settings(b->width, b->height, b->map_width);
    packed->settings.map_height = b->map_height;
    packed->settings.bias = b->bias;
    packed->largest_rounding = -1;
    return b->status == GN_OK ? 0 : -1;
}

void build_free(builder *b)
{
    for (size_t i = 0; i < b->mesh_count; i++) {
        free(b->meshes[i].vertices);
        free(b->meshes[i].triangles);
    }
    free(b->meshes);
    memset(b, 0, sizeof *b);
}
