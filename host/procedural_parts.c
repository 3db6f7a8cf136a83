/* Solids, tubes and sheets for procedural scenes. See procedural_parts.h. */
#include "procedural_parts.h"

#include <assert.h>
#include <math.h>
#include <stdlib.h>

/* ---- meshes that grow ------------------------------------------------------------------------------------------ */

/* Make room for one more element of size bytes. Returns the block, perhaps moved, or 0 with the old block untouched. */
static void *with_room(void *block, size_t count, size_t *room, size_t size)
{
    if (count < *room)
        return block;
    size_t more = *room ? *room * 2 : 64;
    void *moved = realloc(block, more * size);
    if (moved)
        *room = more;
    return moved;
}

static void add_vertex(part_mesh *m, part_point p)
{
    part_point *vertices = with_room(m->vertices, m->vertex_count, &m->vertex_room, sizeof *vertices);
    if (!vertices) {
        m->failed = 1;
        return;
    }
    m->vertices = vertices;
    vertices[m->vertex_count++] = p;
}

/* a, b, c count from the first vertex of the part, which is the newest one. */
static void add_triangle(part_mesh *m, int a, int b, int c)
{
    int(*triangles)[3] = with_room(m->triangles, m->triangle_count, &m->triangle_room, sizeof *triangles);
    if (!triangles || !m->part_count) {
        m->failed = 1;
        return;
    }
    m->triangles = triangles;
    int first = (int)m->parts[m->part_count - 1].vertex;
    int *corners = triangles[m->triangle_count++];
    corners[0] = first + a;
    corners[1] = first + b;
    corners[2] = first + c;
}

/* Two triangles: a, b, c and a, c, d. */
static void add_quadrilateral(part_mesh *m, int a, int b, int c, int d)
{
    add_triangle(m, a, b, c);
    add_triangle(m, a, c, d);
}

static part begin(part_mesh *m)
{
    part p = {m, {m->vertex_count, m->triangle_count}, {0, 0}};
    part_start *parts = with_room(m->parts, m->part_count, &m->part_room, sizeof *parts);
    if (parts) {
        m->parts = parts;
        parts[m->part_count++] = p.start;
    } else {
        m->failed = 1;
    }
    return p;
}

static part end(part p)
{
    p.end.vertex = p.mesh->vertex_count;
    p.end.triangle = p.mesh->triangle_count;
    return p;
}

void part_mesh_free(part_mesh *mesh)
{
    static const part_mesh empty;
    free(mesh->vertices);
    free(mesh->triangles);
    free(mesh->parts);
    *mesh = empty;
}

/* ---- vectors --------------------------------------------------------------------------------------------------- */

part_point part_minus(part_point a, part_point b)
{
    return (part_point){a.x - b.x, a.y - b.y, a.z - b.z};
}

part_point part_cross(part_point a, part_point b)
{
    return (part_point){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

double part_dot(part_point a, part_point b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

part_point part_unit(part_point a)
{
    double length = sqrt(part_dot(a, a));
    if (length == 0)
        length = 1;
    return (part_point){a.x / length, a.y / length, a.z / length};
}

double part_radians(double degrees)
{
    return degrees * (PART_PI / 180.0);
}

/* Angle k of n around a full turn. */
static double turn(int k, int n)
{
    return 2 * PART_PI * k / n;
}

/* ---- solids ---------------------------------------------------------------------------------------------------- */

/* End a closed part: turn all its triangles round if its signed volume says that they face inwards. */
static part end_solid(part p)
{
    p = end(p);
    if (p.mesh->failed)
        return p;
    double volume = 0; /* times 6 */
    for (size_t i = p.start.triangle; i < p.end.triangle; i++) {
        const int *t = p.mesh->triangles[i];
        part_point a = p.mesh->vertices[t[0]], b = p.mesh->vertices[t[1]], c = p.mesh->vertices[t[2]];
        volume += a.x * (b.y * c.z - b.z * c.y) - a.y * (b.x * c.z - b.z * c.x) + a.z * (b.x * c.y - b.y * c.x);
    }
    for (size_t i = p.start.triangle; volume < 0 && i < p.end.triangle; i++) {
        int *t = p.mesh->triangles[i], second = t[1];
        t[1] = t[2];
        t[2] = second;
    }
    return p;
}

part part_box(part_mesh *mesh, double x0, double x1, double y0, double y1, double z0, double z1)
{
    part p = begin(mesh);
    for (int i = 0; i < 8; i++)
        add_vertex(mesh, (part_point){i & 4 ? x1 : x0, i & 2 ? y1 : y0, i & 1 ? z1 : z0});
    add_quadrilateral(mesh, 0, 1, 3, 2);
    add_quadrilateral(mesh, 4, 6, 7, 5);
    add_quadrilateral(mesh, 0, 4, 5, 1);
    add_quadrilateral(mesh, 2, 3, 7, 6);
    add_quadrilateral(mesh, 0, 2, 6, 4);
    add_quadrilateral(mesh, 1, 5, 7, 3);
    return end_solid(p);
}

/* Side i of a prism whose n lower corners come first, then the n upper ones. */
static void add_side(part_mesh *mesh, int i, int n)
{
    int j = (i + 1) % n;
    add_quadrilateral(mesh, i, j, n + j, n + i);
}

/* Sides and caps over the 2n vertices that are there already. */
static part end_prism(part p, int n)
{
    for (int i = 0; i < n; i++)
        add_side(p.mesh, i, n);
    for (int i = 1; i < n - 1; i++) {
        add_triangle(p.mesh, 0, i + 1, i);
        add_triangle(p.mesh, n, n + i, n + i + 1);
    }
    return end_solid(p);
}

static void add_outline(part_mesh *mesh, const part_corner *outline, int corners, double y)
{
    for (int i = 0; i < corners; i++)
        add_vertex(mesh, (part_point){outline[i].x, y, outline[i].z});
}

part part_prism(part_mesh *mesh, const part_corner *outline, int corners, double y0, double y1)
{
    part p = begin(mesh);
    add_outline(mesh, outline, corners, y0);
    add_outline(mesh, outline, corners, y1);
    return end_prism(p, corners);
}

part part_prism_along_z(part_mesh *mesh, const part_corner *outline, int corners, double z0, double z1)
{
    part p = begin(mesh);
    for (int i = 0; i < corners; i++)
        add_vertex(mesh, (part_point){outline[i].x, outline[i].z, z0});
    for (int i = 0; i < corners; i++)
        add_vertex(mesh, (part_point){outline[i].x, outline[i].z, z1});
    return end_prism(p, corners);
}

part part_wheel(part_mesh *mesh, const part_corner *outline, int corners, double y0, double y1)
{
    part p = begin(mesh);
    int n = corners, low = 2 * n, high = 2 * n + 1;
    add_outline(mesh, outline, n, y0);
    add_outline(mesh, outline, n, y1);
    add_vertex(mesh, (part_point){0, y0, 0});
    add_vertex(mesh, (part_point){0, y1, 0});
    for (int i = 0; i < n; i++) {
        int j = (i + 1) % n;
        add_side(mesh, i, n);
        add_triangle(mesh, low, j, i);
        add_triangle(mesh, high, n + i, n + j);
    }
    return end_solid(p);
}

/* The triangles between ring a, whose first vertex is first, and ring b above it; a pole has one vertex instead. */
static void add_band(part_mesh *mesh, int first, int a_is_pole, int b_is_pole, int sides)
{
    int next = first + (a_is_pole ? 1 : sides);
    for (int k = 0; k < sides; k++) {
        int l = (k + 1) % sides;
        int ak = first + (a_is_pole ? 0 : k), al = first + (a_is_pole ? 0 : l);
        int bk = next + (b_is_pole ? 0 : k), bl = next + (b_is_pole ? 0 : l);
        if (!a_is_pole)
            add_triangle(mesh, ak, al, bl);
        if (!b_is_pole)
            add_triangle(mesh, ak, bl, bk);
    }
}

part part_lathe(part_mesh *mesh, const part_ring *profile, int rings, int sides)
{
    part p = begin(mesh);
    for (int i = 0; i < rings; i++) {
        double r = profile[i].radius, y = profile[i].y;
        if (r == 0)
            add_vertex(mesh, (part_point){0, y, 0});
        for (int k = 0; r != 0 && k < sides; k++)
            add_vertex(mesh, (part_point){r * cos(turn(k, sides)), y, r * sin(turn(k, sides))});
    }
    int first = 0;
    for (int i = 0; i + 1 < rings; i++) {
        int is_pole = profile[i].radius == 0;
        add_band(mesh, first, is_pole, profile[i + 1].radius == 0, sides);
        first += is_pole ? 1 : sides;
    }
    return end_solid(p);
}

part part_sphere(part_mesh *mesh, double radius, int sides, int bands)
{
    part_ring profile[PART_PATH_ROOM + 1];
    assert(bands <= PART_PATH_ROOM);
    for (int i = 0; i <= bands; i++) {
        double latitude = PART_PI * i / bands;
        profile[i].radius = i == 0 || i == bands ? 0 : radius * sin(latitude); /* sin(pi) is not 0 */
        profile[i].y = -radius * cos(latitude);
    }
    return part_lathe(mesh, profile, bands + 1, sides);
}

part part_cylinder(part_mesh *mesh, double radius, double y0, double y1, int sides)
{
    const part_ring profile[] = {{0, y0}, {radius, y0}, {radius, y1}, {0, y1}};
    return part_lathe(mesh, profile, 4, sides);
}

part part_cone(part_mesh *mesh, double radius, double y0, double y1, int sides)
{
    const part_ring profile[] = {{0, y0}, {radius, y0}, {0, y1}};
    return part_lathe(mesh, profile, 3, sides);
}

part part_torus(part_mesh *mesh, double radius, double thickness, int sides, int bands)
{
    part p = begin(mesh);
    for (int i = 0; i < sides; i++)
        for (int j = 0; j < bands; j++) {
            double a = turn(i, sides), b = turn(j, bands), r = radius + thickness * cos(b);
            add_vertex(mesh, (part_point){r * cos(a), thickness * sin(b), r * sin(a)});
        }
    for (int i = 0; i < sides; i++)
        for (int j = 0; j < bands; j++) {
            int here = i * bands, there = (i + 1) % sides * bands, k = (j + 1) % bands;
            add_quadrilateral(mesh, here + j, there + j, there + k, here + k);
        }
    return end_solid(p);
}

/* ---- tubes ----------------------------------------------------------------------------------------------------- */

/* The direction of the path at point i: from the point before to the point after, where there is one. */
static part_point direction(const part_path *path, int i)
{
    int before = i > 0 ? i - 1 : 0, after = i + 1 < path->count ? i + 1 : i;
    return part_unit(part_minus(path->points[after], path->points[before]));
}

static void add_circle(part_mesh *mesh, part_point p, part_point x, part_point y, double radius, int sides)
{
    for (int k = 0; k < sides; k++) {
        double c = radius * cos(turn(k, sides)), s = radius * sin(turn(k, sides));
        add_vertex(mesh, (part_point){p.x + c * x.x + s * y.x, p.y + c * x.y + s * y.y, p.z + c * x.z + s * y.z});
    }
}

/* Circles carried along the path without twist: each takes its x axis from the one before, made perpendicular again. */
part part_tube(part_mesh *mesh, const part_path *path, double radius, int sides)
{
    static const part_point off_axis = {0.31, 0.83, 0.47}; /* parallel to no segment of any scene */
    part p = begin(mesh);
    int n = sides, circles = path->count;
    part_point x = {0, 0, 0};
    for (int i = 0; i < circles; i++) {
        part_point d = direction(path, i);
        double k = part_dot(x, d);
        x = part_unit(i == 0 ? part_cross(off_axis, d) : (part_point){x.x - k * d.x, x.y - k * d.y, x.z - k * d.z});
        add_circle(mesh, path->points[i], x, part_cross(d, x), radius, n);
    }
    for (int i = 0; i + 1 < circles; i++)
        for (int k = 0; k < n; k++) {
            int l = (k + 1) % n;
            add_quadrilateral(mesh, i * n + k, i * n + l, (i + 1) * n + l, (i + 1) * n + k);
        }
    add_vertex(mesh, path->points[0]);
    add_vertex(mesh, path->points[circles - 1]);
    for (int k = 0; k < n; k++) {
        int l = (k + 1) % n, last = (circles - 1) * n;
        add_triangle(mesh, circles * n, l, k);
        add_triangle(mesh, circles * n + 1, last + k, last + l);
    }
    return end_solid(p);
}

static double parabola(double from, double corner, double to, double t)
{
    return (1 - t) * (1 - t) * from + 2 * t * (1 - t) * corner + t * t * to;
}

part_path part_rounded(const part_path *path, double radius, int steps)
{
    part_path out = {.count = 0};
    assert(path->count >= 2 && 2 + (path->count - 2) * (steps + 1) <= PART_PATH_ROOM);
    out.points[out.count++] = path->points[0];
    for (int i = 1; i + 1 < path->count; i++) {
        part_point b = path->points[i];
        part_point from = part_unit(part_minus(path->points[i - 1], b));
        part_point to = part_unit(part_minus(path->points[i + 1], b));
        from = (part_point){b.x + radius * from.x, b.y + radius * from.y, b.z + radius * from.z};
        to = (part_point){b.x + radius * to.x, b.y + radius * to.y, b.z + radius * to.z};
        for (int k = 0; k <= steps; k++) {
            double t = (double)k / steps;
            out.points[out.count++] = (part_point){parabola(from.x, b.x, to.x, t), parabola(from.y, b.y, to.y, t),
                                                   parabola(from.z, b.z, to.z, t)};
        }
    }
    out.points[out.count++] = path->points[path->count - 1];
    return out;
}

/* ---- sheets ---------------------------------------------------------------------------------------------------- */

/* The grid's triangles, over (nu + 1) (nv + 1) vertices of which v runs fastest. */
static part end_sheet(part p, int nu, int nv)
{
    for (int i = 0; i < nu; i++)
        for (int j = 0; j < nv; j++) {
            int here = i * (nv + 1) + j, there = here + nv + 1;
            add_quadrilateral(p.mesh, here, there, there + 1, here + 1);
        }
    return end(p);
}

part part_sheet(part_mesh *mesh, part_surface *surface, int nu, int nv)
{
    part p = begin(mesh);
    for (int i = 0; i <= nu; i++)
        for (int j = 0; j <= nv; j++)
            add_vertex(mesh, surface((double)i / nu, (double)j / nv));
    return end_sheet(p, nu, nv);
}

part part_rectangle(part_mesh *mesh, part_point corner, part_point u, part_point v, int nu, int nv)
{
    part p = begin(mesh);
    for (int i = 0; i <= nu; i++)
        for (int j = 0; j <= nv; j++) {
            double s = (double)i / nu, t = (double)j / nv;
            add_vertex(mesh, (part_point){corner.x + u.x * s + v.x * t, corner.y + u.y * s + v.y * t,
                                          corner.z + u.z * s + v.z * t});
        }
    return end_sheet(p, nu, nv);
}

/* ---- movers ---------------------------------------------------------------------------------------------------- */

part part_translate(part p, double x, double y, double z)
{
    for (size_t i = p.start.vertex; i < p.end.vertex; i++) {
        part_point *v = &p.mesh->vertices[i];
        *v = (part_point){v->x + x, v->y + y, v->z + z};
    }
    return p;
}

part part_scale(part p, double factor)
{
    for (size_t i = p.start.vertex; i < p.end.vertex; i++) {
        part_point *v = &p.mesh->vertices[i];
        *v = (part_point){v->x * factor, v->y * factor, v->z * factor};
    }
    return p;
}

part part_rotate_x(part p, double degrees)
{
    double c = cos(part_radians(degrees)), s = sin(part_radians(degrees));
    for (size_t i = p.start.vertex; i < p.end.vertex; i++) {
        part_point *v = &p.mesh->vertices[i];
        *v = (part_point){v->x, c * v->y - s * v->z, s * v->y + c * v->z};
    }
    return p;
}

part part_rotate_y(part p, double degrees)
{
    double c = cos(part_radians(degrees)), s = sin(part_radians(degrees));
    for (size_t i = p.start.vertex; i < p.end.vertex; i++) {
        part_point *v = &p.mesh->vertices[i];
        *v = (part_point){c * v->x + s * v->z, v->y, -s * v->x + c * v->z};
    }
    return p;
}

part part_rotate_z(part p, double degrees)
{
    double c = cos(part_radians(degrees)), s = sin(part_radians(degrees));
    for (size_t i = p.start.vertex; i < p.end.vertex; i++) {
        part_point *v = &p.mesh->vertices[i];
        *v = (part_point){c * v->x - s * v->y, s * v->x + c * v->y, v->z};
    }
    return p;
}
