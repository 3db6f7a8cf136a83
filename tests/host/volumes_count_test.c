/* Shadow volumes counted once more, pixel by pixel and without any of the method's economies: equal, not nearly.
 *
 * Here every triangle casts a volume of its own: cap, three sides, lid. No edges of meshes, no silhouettes, no windings
 * of two, no bins, no rows, no regions, no spans, no steps, no caches: every face is held against every pixel of the
 * image by edge functions and the top-left rule, every plane is evaluated by multiplication. What is visible, too, is
 * found over all triangles. Shared with the core are the snapped primitives that are counted over: places and
 * projection, clipping (gn_project_face, gn_clip_triangle), the outlines of sides and lids, planes of nearness and of
 * Q, and the corners of what a spot light's near plane cuts.
 *
 * Sides of neighbours must cancel here. They do where both are counted alike: so a side is behind the points of both
 * triangles on its edge, of its own and of its neighbour, and its plane is made from the edge in one direction, that of
 * the lower half-edge. Neighbours are found by the rule of adjacency.h over all half-edges of the mesh.
 *
 * volumes_count_test CASES SEED: so many random scenes (volume_scenes.h) from that seed on. */
#include "frame.h"
#include "gn_context.h"
#include "volume_scenes.h"

/* The corners of cut triangles and of the frustum are static there. */
#define gn_count_cut_volumes twin_count_cut_volumes
#define gn_count_frustum twin_count_frustum
#define gn_lid_along_view twin_lid_along_view
#define gn_cut_lids_along_view twin_cut_lids_along_view
#include "gn_volumes_spot.c"

__extension__ typedef __int128 exact;

enum { MOST_PIXELS = VOLUME_MOST_SIZE * VOLUME_MOST_SIZE, MOST_NUMBERS = VOLUME_MOST_MESHES * VOLUME_MOST_TRIANGLES };

/* ---- triangles --------------------------------------------------------------------------------------------------- */

typedef struct caster {
    uint32_t identifier;
    int32_t world[3][3];
    gn_vertex projected[3];
    int winding;           /* the way its corners run as the light sees them; 0: it casts nothing */
    int crosses;           /* the light's near plane */
    uint32_t neighbour[3]; /* over each half-edge, its number among the casters; its own where there is none */
    int reversed[3];       /* the neighbour's half-edge is the lower one, and runs the other way */
} caster;

typedef struct bench {
    const volume_scene *scene;
    const gn_context *context; /* of the core, after its passes: for triangle_bits and the depth of nothing */
    gn_view camera_view, view; /* the second without a far plane */
    gn_eye eye;
    gn_place axis;
    int32_t width, height;
    caster casters[MOST_NUMBERS];
    uint32_t caster_count;
    uint32_t q[MOST_PIXELS], seen[MOST_PIXELS]; /* identifiers */
    int64_t point[MOST_PIXELS];
    uint8_t counts[MOST_PIXELS]; /* camera and light are on one side of what is seen */
    uint32_t count[MOST_PIXELS];
} bench;

static bench b;

/* Corners beyond the light's near plane. */
static int beyond_near_plane(const gn_light *light, int32_t world[3][3])
{
    int count = 0;
    for (int v = 0; v < 3; v++) {
        int64_t w = -(int64_t)light->near_depth * (1 << 30);
        for (int i = 0; i < 3; i++)
            w += (int64_t)(world[v][i] - light->position[i]) * light->forward[i];
        count += w >= 0;
    }
    return count;
}

static void set_caster(caster *c, const gn_object *object, uint32_t triangle)
{
    const gn_light *light = &b.scene->packed.light;
    gn_place place;
    for (uint32_t i = 0; i < 3; i++) {
        (void)gn_world_position(object, adjacency_vertex(object->mesh, 3 * triangle + i), c->world[i]);
        (void)gn_view_place(&b.camera_view, c->world[i], &place);
        gn_view_project(&b.camera_view, &place, &c->projected[i]);
    }
    c->winding = gn_light_side(light, c->world);
    int beyond = light->kind == GN_SPOT ? beyond_near_plane(light, c->world) : 3;
    c->crosses = c->winding && beyond > 0 && beyond < 3;
    if (beyond == 0)
        c->winding = 0;
}

/* Where a half-edge starts. */
static const int32_t *start_of(const gn_mesh *mesh, uint32_t half)
{
    return mesh->vertices[adjacency_vertex(mesh, half)];
}

static int same_place(const int32_t p[3], const int32_t q[3])
{
    return p[0] == q[0] && p[1] == q[1] && p[2] == q[2];
}

/* 1: the same two places in the same direction, -1: in the other, 0: not the same. */
static int together(const gn_mesh *mesh, uint32_t p, uint32_t q)
{
    const int32_t *from = start_of(mesh, p), *to = start_of(mesh, adjacency_end(p));
    const int32_t *other_from = start_of(mesh, q), *other_to = start_of(mesh, adjacency_end(q));
    return same_place(from, other_from) && same_place(to, other_to)   ? 1
           : same_place(from, other_to) && same_place(to, other_from) ? -1
                                                                      : 0;
}

static int is_point(const gn_mesh *mesh, uint32_t triangle)
{
    const int32_t *p = start_of(mesh, 3 * triangle), *q = start_of(mesh, 3 * triangle + 1),
                  *r = start_of(mesh, 3 * triangle + 2);
    return same_place(p, q) || same_place(q, r) || same_place(r, p);
}

/* The n-th of one direction and the n-th of the other belong together; what one direction has more of, in twos. */
static uint32_t partner_of(const gn_mesh *mesh, uint32_t half)
{
    uint32_t rank = 0, alike = 0, others = 0, found = GN_NO_HALF_EDGE;
    uint32_t halves = 3 * mesh->triangle_count;
    for (uint32_t q = 0; q < halves; q++) {
        int way = is_point(mesh, q / 3) ? 0 : together(mesh, half, q);
        rank += way > 0 && q < half;
        alike += way > 0;
        others += way < 0;
    }
    int wanted = rank < others ? -1 : 1;
    uint32_t at = rank < others ? rank : others + ((rank - others) ^ 1), number = 0;
    if (wanted > 0 && at >= alike)
        return found;
    for (uint32_t q = 0; q < halves && found == GN_NO_HALF_EDGE; q++)
        if (!is_point(mesh, q / 3) && together(mesh, half, q) == wanted && number++ == at)
            found = q;
    return found;
}

static void find_neighbours(const gn_mesh *mesh, uint32_t first)
{
    for (uint32_t half = 0; half < 3 * mesh->triangle_count; half++) {
        caster *c = &b.casters[first + half / 3];
        uint32_t partner = is_point(mesh, half / 3) ? GN_NO_HALF_EDGE : partner_of(mesh, half), edge = half % 3;
        c->neighbour[edge] = first + (partner == GN_NO_HALF_EDGE ? half : partner) / 3;
        c->reversed[edge] = partner != GN_NO_HALF_EDGE && partner < half && together(mesh, half, partner) < 0;
    }
}

static void set_casters(void)
{
    b.caster_count = 0;
    for (uint32_t o = 0; o < b.scene->packed.scene.object_count; o++) {
        const gn_object *object = &b.scene->objects[o];
        uint32_t first = b.caster_count;
        for (uint32_t t = 0; t < object->mesh->triangle_count; t++) {
            caster *c = &b.casters[b.caster_count++];
            c->identifier = o << b.context->triangle_bits | t;
            set_caster(c, object, t);
        }
        find_neighbours(object->mesh, first);
    }
}

/* ---- coverage ---------------------------------------------------------------------------------------------------- */

/* One edge of a clockwise triangle and the centre of a pixel: on its side, or on it where it is a top or left edge. */
static int holds(const gn_vertex *from, const gn_vertex *to, int64_t x, int64_t y)
{
    int64_t dx = to->x - from->x, dy = to->y - from->y, e = dx * (y - from->y) - dy * (x - from->x);
    return e > 0 || (e == 0 && (dy < 0 || (dy == 0 && dx > 0)));
}

static int64_t area_of(const gn_vertex *p, const gn_vertex *q, const gn_vertex *r)
{
    return (int64_t)(q->x - p->x) * (r->y - p->y) - (int64_t)(r->x - p->x) * (q->y - p->y);
}

/* 1: the triangle covers the pixel and runs clockwise, -1: counter-clockwise, 0: it does not cover it. */
static int covers(const gn_vertex *p, const gn_vertex *q, const gn_vertex *r, int32_t pixel_x, int32_t pixel_y)
{
    int64_t area = area_of(p, q, r), x = 256 * (int64_t)pixel_x + 128, y = 256 * (int64_t)pixel_y + 128;
    if (area < 0) {
        const gn_vertex *other = q;
        q = r;
        r = other;
    }
    return area && holds(p, q, x, y) && holds(q, r, x, y) && holds(r, p, x, y) ? area > 0 ? 1 : -1 : 0;
}

/* How often a polygon goes round the pixel, clockwise. */
static int turns_round(const gn_outline *o, int32_t x, int32_t y)
{
    int sum = 0;
    for (int32_t i = 1; i + 1 < o->count; i++)
        sum += covers(&o->v[0], &o->v[i], &o->v[i + 1], x, y);
    return sum;
}

/* ---- what is visible --------------------------------------------------------------------------------------------- */

static void see_piece(const gn_vertex *p, const gn_vertex *q, const gn_vertex *r, const gn_q_plane *plane,
                      uint32_t identifier)
{
    for (int32_t y = 0; y < b.height; y++)
        for (int32_t x = 0; x < b.width; x++) {
            int32_t at = y * b.width + x;
            if (!covers(p, q, r, x, y))
                continue;
            uint32_t depth =
                (uint32_t)((plane->base + (uint64_t)(uint32_t)x * plane->dx + (uint64_t)(uint32_t)y * plane->dy) >> 32);
            if (depth < b.q[at] || (depth == b.q[at] && identifier > b.seen[at]))
                continue;
            b.q[at] = depth;
            b.seen[at] = identifier;
        }
}

static void see_clipped(const caster *c)
{
    gn_place corner[3];
    gn_polygon polygon;
    gn_q_plane plane;
    for (int i = 0; i < 3; i++)
        (void)gn_view_place(&b.camera_view, c->world[i], &corner[i]);
    gn_clip_triangle(&polygon, &b.camera_view, corner);
    if (polygon.area == 0)
        return;
    const gn_vertex *v = polygon.v, *r1 = &v[polygon.reference], *r2 = r1 + 1;
    gn_make_q_plane(&plane, &v[0], polygon.area > 0 ? r1 : r2, polygon.area > 0 ? r2 : r1, polygon.area);
    gn_fit_q_plane(&plane, &polygon, b.context->shading.nothing + 1);
    for (int32_t i = 1; i + 1 < polygon.count; i++)
        if ((area_of(&v[0], &v[i], &v[i + 1]) > 0) == (polygon.area > 0))
            see_piece(&v[0], &v[i], &v[i + 1], &plane, c->identifier);
}

static void see(const caster *c)
{
    const gn_vertex *v = c->projected;
    gn_q_plane plane;
    if (v[0].depth == 0 || v[1].depth == 0 || v[2].depth == 0) {
        see_clipped(c);
        return;
    }
    int64_t area = area_of(&v[0], &v[1], &v[2]);
    if (area == 0)
        return;
    gn_make_q_plane(&plane, &v[0], area > 0 ? &v[1] : &v[2], area > 0 ? &v[2] : &v[1], area);
    see_piece(&v[0], &v[1], &v[2], &plane, c->identifier);
}

/* ---- points and planes ------------------------------------------------------------------------------------------- */

typedef struct compared {
    gn_nearness plane;
    int64_t low, high; /* of the face's corners, in units of the plane's value */
} compared;

static int64_t shifted(int64_t v, unsigned shift)
{
    return v >= 0 ? v >> shift : ~(~v >> shift);
}

static compared compared_plane(const int64_t n[3], gn_wide distance, const gn_reach *reach)
{
    compared c;
    gn_make_nearness(&c.plane, &b.eye, n, distance);
    c.low = shifted(reach->low, c.plane.shift);
    c.high = shifted(reach->high, c.plane.shift);
    return c;
}

static int64_t value_at(const compared *c, int32_t x, int32_t y)
{
    int64_t value = c->plane.base + x * c->plane.dx + y * c->plane.dy;
    value = value > c->high ? c->high : value;
    return value < c->low ? c->low : value;
}

static gn_wide distance_from_eye(const int64_t n[3], const int32_t place[3])
{
    int32_t apart[3];
    for (int i = 0; i < 3; i++)
        apart[i] = place[i] - b.eye.position[i];
    return gn_wide_dot(n, apart);
}

static compared triangle_plane(const caster *c, int64_t n[3])
{
    int32_t edges[2][3];
    gn_reach reach = gn_empty_reach();
    for (int i = 0; i < 3; i++) {
        edges[0][i] = c->world[1][i] - c->world[0][i];
        edges[1][i] = c->world[2][i] - c->world[0][i];
        gn_reach_point(&reach, &b.eye, c->world[i]);
    }
    gn_cross(n, edges[0], edges[1]);
    return compared_plane(n, distance_from_eye(n, c->world[0]), &reach);
}

/* The points of all pixels that show this triangle. */
static void set_points(const caster *c)
{
    const gn_camera *camera = &b.scene->packed.camera;
    int64_t n[3];
    int32_t to_camera[3];
    compared plane = triangle_plane(c, n);
    for (int i = 0; i < 3; i++)
        to_camera[i] = camera->projection == GN_PERSPECTIVE ? camera->eye[i] - c->world[0][i] : -camera->forward[i];
    int side = gn_light_side(&b.scene->packed.light, (int32_t(*)[3])(uintptr_t)c->world);
    int counts = side != 0 && side == gn_dot_sign(n, to_camera);
    for (int32_t at = 0; at < b.width * b.height; at++)
        if (b.seen[at] == c->identifier) {
            b.point[at] = value_at(&plane, at % b.width, at / b.width) * ((int64_t)1 << plane.plane.shift);
            b.counts[at] = (uint8_t)counts;
        }
}

static void find_points(void)
{
    for (int32_t at = 0; at < b.width * b.height; at++) {
        b.q[at] = b.context->shading.nothing;
        b.seen[at] = GN_NO_TRIANGLE;
        b.point[at] = 0;
        b.counts[at] = 0;
    }
    for (uint32_t i = 0; i < b.caster_count; i++)
        see(&b.casters[i]);
    for (uint32_t i = 0; i < b.caster_count; i++)
        set_points(&b.casters[i]);
}

/* ---- faces ------------------------------------------------------------------------------------------------------- */

/* A face: behind all points (plane 0), or compared with them; always behind the points of its own triangles. */
static void count_face(const gn_outline *o, int32_t winding, const compared *plane, uint32_t own0, uint32_t own1)
{
    for (int32_t at = 0; at < b.width * b.height; at++) {
        int32_t x = at % b.width, y = at / b.width;
        int turns = b.counts[at] ? turns_round(o, x, y) : 0;
        if (turns && (!plane || b.seen[at] == own0 || b.seen[at] == own1 ||
                      value_at(plane, x, y) < shifted(b.point[at], plane->plane.shift)))
            b.count[at] += (uint32_t)(turns * winding);
    }
}

/* A cap is at or behind every visible point that it covers, but for what lies before the near plane. Perspective cuts
 * that off; without perspective it is told by the cap's own plane. */
static void count_cap(const caster *c, const gn_outline *o, int clipped)
{
    int64_t n[3], near_plane = -(int64_t)b.scene->packed.camera.near_depth * ((int64_t)1 << 32);
    compared plane = triangle_plane(c, n);
    for (int32_t at = 0; at < b.width * b.height; at++) {
        int32_t x = at % b.width, y = at / b.width;
        int turns = b.counts[at] ? turns_round(o, x, y) : 0;
        if (turns && (!clipped || b.eye.perspective || b.seen[at] == c->identifier ||
                      value_at(&plane, x, y) < shifted(near_plane + 1, plane.plane.shift) + (plane.plane.shift > 0)))
            b.count[at] += (uint32_t)(turns * c->winding);
    }
}

static void count_whole_cap(const caster *c)
{
    const gn_vertex *v = c->projected;
    gn_outline o;
    int clipped = v[0].depth == 0 || v[1].depth == 0 || v[2].depth == 0;
    o.count = 3;
    for (int i = 0; i < 3; i++)
        o.v[i] = v[i];
    if (clipped) {
        gn_face f;
        f.count = 0;
        for (int i = 0; i < 3; i++) {
            gn_place place;
            (void)gn_view_place(&b.view, c->world[i], &place);
            gn_add_corner(&f, &place, 0);
        }
        gn_project_face(&b.view, &f, &o);
    }
    count_cap(c, &o, clipped);
}

static void count_lid(const gn_corner *from, const gn_corner *to, int winding)
{
    gn_outline o;
    if (b.scene->packed.light.kind != GN_SPOT || b.view.affine)
        return;
    gn_make_lid(&o, &b.view, &b.axis, from, to);
    count_face(&o, winding, 0, GN_NO_TRIANGLE, GN_NO_TRIANGLE);
}

/* The side over one edge, and its part of the lid. */
static void count_side(const caster *c, int edge)
{
    const gn_light *light = &b.scene->packed.light;
    const caster *other = &b.casters[c->neighbour[edge]];
    const int32_t *place[2] = {c->world[edge], c->world[(edge + 1) % 3]};
    int first = c->reversed[edge]; /* the plane is made in the lower half-edge's direction */
    gn_corner ends[2];
    gn_outline o;
    gn_reach reach = gn_empty_reach();
    int32_t along[3];
    int64_t n[3];
    for (int i = 0; i < 2; i++) {
        gn_set_corner(&ends[i], &b.view, light, place[i]);
        gn_reach_point(&reach, &b.eye, place[i]);
        gn_reach_ray(&reach, &b.eye, ends[i].away);
    }
    for (int i = 0; i < 3; i++)
        along[i] = light->kind == GN_SPOT ? ends[!first].away[i] : place[!first][i] - place[first][i];
    gn_cross(n, ends[first].away, along);
    compared plane = compared_plane(n, distance_from_eye(n, place[first]), &reach);
    /* a neighbour that the near plane cuts has a side of its own making here, which is always compared */
    int alone = other->crosses;
    gn_make_side(&o, &b.view, light, &ends[0], &ends[1]);
    count_face(&o, c->winding, &plane, alone ? GN_NO_TRIANGLE : c->identifier,
               alone ? GN_NO_TRIANGLE : other->identifier);
    count_lid(&ends[0], &ends[1], c->winding);
}

/* What is left of a triangle beyond the light's near plane, a polygon of three or four corners. */
static void count_cut(const caster *c)
{
    const gn_light *light = &b.scene->packed.light;
    uint32_t mask = ((uint32_t)1 << b.context->triangle_bits) - 1;
    cut part = {.count = 0};
    gn_face f;
    gn_outline o;
    gn_reach reach = gn_empty_reach();
    find_cut(&part, b.context, &b.scene->objects[c->identifier >> b.context->triangle_bits], c->identifier & mask);
    f.count = 0;
    for (int32_t i = 0; i < part.count; i++)
        gn_add_corner(&f, &part.corners[i].place, 0);
    gn_project_face(&b.view, &f, &o);
    count_cap(c, &o, 1);
    for (int i = 0; i < 3; i++)
        gn_reach_point(&reach, &b.eye, c->world[i]);
    for (int32_t i = 0; i < part.count; i++)
        gn_reach_ray(&reach, &b.eye, part.corners[i].away);
    for (int32_t i = 0; i < part.count; i++) {
        const gn_corner *from = &part.corners[i], *to = &part.corners[(i + 1) % part.count];
        int64_t n[3];
        gn_cross(n, from->away, to->away);
        compared plane = compared_plane(n, distance_from_eye(n, light->position), &reach);
        gn_make_side(&o, &b.view, light, from, to);
        count_face(&o, c->winding, &plane, GN_NO_TRIANGLE, GN_NO_TRIANGLE);
        count_lid(from, to, c->winding);
    }
}

static void count_frustum_of_light(void)
{
    static const uint8_t corners[6][4] = {{0, 1, 3, 2}, {6, 7, 5, 4}, {1, 5, 7, 3},
                                          {4, 0, 2, 6}, {2, 3, 7, 6}, {1, 0, 4, 5}};
    const gn_light *light = &b.scene->packed.light;
    for (int which = 0; which < 6; which++) {
        gn_face f;
        gn_outline o;
        gn_reach reach = gn_empty_reach();
        int64_t n[3], offset = frustum_plane(n, light, which);
        f.count = 0;
        for (int i = 0; i < 4; i++) {
            gn_place p = frustum_corner(&b.view, light, corners[which][i]);
            gn_add_corner(&f, &p, 0);
            gn_reach_depth(&reach, &b.eye, corner_depth(&b.eye, light, corners[which][i]));
        }
        gn_project_face(&b.view, &f, &o);
        compared plane =
            compared_plane(n, gn_wide_add(distance_from_eye(n, light->position), gn_widen(offset, 0)), &reach);
        count_face(&o, -GN_FRUSTUM_WINDING, &plane, GN_NO_TRIANGLE, GN_NO_TRIANGLE);
    }
}

/* ---- where counting begins --------------------------------------------------------------------------------------- */

/* Which way q lies from p, about where the view's direction stands on the screen. */
static int turn_between(const gn_place *p, const gn_place *q)
{
    exact product = (exact)p->c[0] * q->c[1] - (exact)p->c[1] * q->c[0];
    return (product > 0) - (product < 0);
}

/* 1 or -1 if the direction in which an orthographic camera looks lies within three corners at infinity, by the way they
 * run. */
static int surrounds_view(const gn_place *p, const gn_place *q, const gn_place *r)
{
    int first = turn_between(p, q);
    return turn_between(q, r) == first && turn_between(r, p) == first ? first : 0;
}

/* Over a single volume: its lid is the polygon of its corners at infinity, here a fan from its first corner and not
 * from the light's axis. */
static uint32_t lid_before_view(const gn_corner *corners, int32_t count, int winding)
{
    const gn_light *light = &b.scene->packed.light;
    int64_t along = 0;
    int sum = 0;
    for (int i = 0; i < 3; i++)
        along += (int64_t)light->forward[i] * b.eye.forward[i];
    for (int32_t i = 1; i + 1 < count; i++)
        sum += surrounds_view(&corners[0].direction, &corners[i].direction, &corners[i + 1].direction);
    return along > 0 ? (uint32_t)(-sum * winding) : 0;
}

static uint32_t count_outside(void)
{
    const gn_light *light = &b.scene->packed.light;
    uint32_t sum = light->kind == GN_SPOT ? GN_FRUSTUM_WINDING : 0;
    for (uint32_t i = 0; light->kind == GN_SPOT && b.view.affine && i < b.caster_count; i++) {
        const caster *c = &b.casters[i];
        cut part = {.count = 3};
        if (c->crosses)
            find_cut(&part, b.context, &b.scene->objects[c->identifier >> b.context->triangle_bits],
                     c->identifier & (((uint32_t)1 << b.context->triangle_bits) - 1));
        else
            for (int k = 0; k < 3; k++)
                gn_set_corner(&part.corners[k], &b.view, light, c->world[k]);
        sum += c->winding ? lid_before_view(part.corners, part.count, c->winding) : 0;
    }
    return sum;
}

static void count_all(void)
{
    uint32_t outside = count_outside();
    for (int32_t at = 0; at < b.width * b.height; at++)
        b.count[at] = outside;
    for (uint32_t i = 0; i < b.caster_count; i++) {
        const caster *c = &b.casters[i];
        if (c->crosses)
            count_cut(c);
        else if (c->winding) {
            count_whole_cap(c);
            for (int edge = 0; edge < 3; edge++)
                count_side(c, edge);
        }
    }
    if (b.scene->packed.light.kind == GN_SPOT)
        count_frustum_of_light();
}

/* ---- against the core -------------------------------------------------------------------------------------------- */

typedef struct tally {
    uint64_t scenes, skipped, refused, pixels, counted, nonzero, lit;
    uint64_t bad_seen, bad_counts, bad_masks, bad_regions;
    uint64_t views[2][2], several, inside, crossing, clipped;
} tally;

static int render(frame *f, const volume_scene *s, const gn_settings *settings, problem *why)
{
    return frame_open(f, &s->packed.scene, settings, 0, why) || frame_light_pass(f, &s->packed.light, why) ||
                   frame_camera_pass(f, &s->packed.camera, why)
               ? -1
               : 0;
}

static void set_bench(const volume_scene *s, const frame *f)
{
    const gn_camera *camera = &s->packed.camera;
    b.scene = s;
    b.context = f->context;
    b.width = f->settings.width;
    b.height = f->settings.height;
    (void)gn_make_camera_view(&b.camera_view, camera, b.width, b.height);
    b.view = b.camera_view;
    b.view.endless = 1;
    gn_make_eye(&b.eye, camera, b.width, b.height);
    b.axis = gn_place_direction(&b.view, s->packed.light.forward);
}

static void show(uint64_t seed, int32_t at, const char *what, unsigned long got, unsigned long expected)
{
    note("seed %llu, pixel %ld %ld: %s %lu, expected %lu; run: volumes_count_test 1 %llu", (unsigned long long)seed,
         (long)(at % b.width), (long)(at / b.width), what, got, expected, (unsigned long long)seed);
}

/* Counts and what is visible, of a frame in one region. */
static void compare_counts(tally *t, const frame *f, uint64_t seed)
{
    uint64_t bad = 0;
    for (int32_t at = 0; at < b.width * b.height; at++) {
        uint32_t seen = f->context->workers[0].triangle[at];
        uint16_t count = f->context->volumes->workers[0].count[at], expected = (uint16_t)b.count[at];
        uint8_t mask = b.seen[at] == GN_NO_TRIANGLE ? 255 : b.counts[at] && expected == 0 ? 254 : 0;
        t->pixels++;
        t->counted += b.counts[at];
        t->nonzero += b.counts[at] && expected != 0;
        t->several += b.counts[at] && expected > 2 && expected < GN_FRUSTUM_WINDING;
        t->lit += mask == 254;
        if (seen != b.seen[at] && t->bad_seen++ + bad++ < 3)
            show(seed, at, "triangle", seen, b.seen[at]);
        else if (b.counts[at] && count != expected && t->bad_counts++ + bad++ < 3)
            show(seed, at, "count", count, expected);
        if (f->mask[at] != mask && t->bad_masks++ + bad++ < 3)
            show(seed, at, "mask", f->mask[at], mask);
    }
}

/* The same image in regions of any size on several workers. */
static void compare_regions(tally *t, volume_scene *s, const frame *whole, uint64_t seed)
{
    gn_settings settings = whole->settings;
    frame f;
    problem why;
    settings.region_width = (uint16_t)volume_between(s, 1, settings.width);
    settings.region_height = (uint16_t)volume_between(s, 1, settings.height);
    settings.workers = (uint8_t)volume_between(s, 1, 3);
    int same = render(&f, s, &settings, &why) == 0 &&
               memcmp(f.mask, whole->mask, (size_t)settings.width * settings.height) == 0;
    if (!same && t->bad_regions++ < 4)
        note("seed %llu: regions of %u x %u on %u workers; run: volumes_count_test 1 %llu", (unsigned long long)seed,
             settings.region_width, settings.region_height, settings.workers, (unsigned long long)seed);
    frame_close(&f);
}

static void run_scene(tally *t, uint64_t seed)
{
    static volume_scene s;
    frame f = {0};
    problem why;
    if (volume_scene_make(&s, seed)) {
        gn_settings settings = s.packed.settings;
        settings.width = settings.width > 40 ? 40 : settings.width; /* every face visits every pixel */
        settings.height = settings.height > 40 ? 40 : settings.height;
        settings.region_width = settings.width;
        settings.region_height = settings.height;
        if (render(&f, &s, &settings, &why) == 0) {
            set_bench(&s, &f);
            set_casters();
            find_points();
            count_all();
            compare_counts(t, &f, seed);
            compare_regions(t, &s, &f, seed);
            t->scenes++;
            t->views[s.packed.camera.projection == GN_ORTHOGRAPHIC][s.packed.light.kind == GN_SPOT]++;
            t->inside += (uint64_t)s.inside;
            t->crossing += f.context->volumes->crossing;
            for (uint32_t i = 0; i < b.caster_count; i++)
                t->clipped += b.casters[i].projected[0].depth == 0;
        } else if (t->refused++ < 5) {
            note("seed %llu: %s", (unsigned long long)seed, why.text);
        }
        frame_close(&f);
    } else {
        t->skipped++;
    }
    volume_scene_free(&s);
}

int main(int argc, char **argv)
{
    tally t = {0};
    uint64_t count = tap_cases(argc, argv, 1500), first = argc > 2 ? strtoull(argv[2], 0, 10) : 1;
    double start = frame_clock();
    for (uint64_t seed = first; seed < first + count; seed++)
        run_scene(&t, seed);
    note("%llu scenes (%llu skipped) in %.1f s; %llu pixels, %llu of them counted: %llu lit, %llu in volumes, %llu in "
         "more "
         "than two",
         (unsigned long long)t.scenes, (unsigned long long)t.skipped, frame_clock() - start,
         (unsigned long long)t.pixels, (unsigned long long)t.counted, (unsigned long long)t.lit,
         (unsigned long long)t.nonzero, (unsigned long long)t.several);
    note(
        "perspective: %llu directional, %llu spot; orthographic: %llu, %llu; camera in a solid: %llu; triangles cut by "
        "the light's near plane: %llu, clipped by the camera: %llu",
        (unsigned long long)t.views[0][0], (unsigned long long)t.views[0][1], (unsigned long long)t.views[1][0],
        (unsigned long long)t.views[1][1], (unsigned long long)t.inside, (unsigned long long)t.crossing,
        (unsigned long long)t.clipped);
    note("different: %llu triangles in view, %llu counts, %llu of the mask", (unsigned long long)t.bad_seen,
         (unsigned long long)t.bad_counts, (unsigned long long)t.bad_masks);
    ok(t.refused == 0, "the_core_takes_all_scenes");
    ok(t.bad_seen == 0, "the_visible_triangle_is_that_of_a_search_over_all");
    ok(t.bad_counts == 0, "counts_are_those_of_every_triangles_own_volume");
    ok(t.bad_masks == 0, "a_pixel_is_lit_where_that_count_is_zero_and_nowhere_else");
    ok(t.bad_regions == 0, "regions_and_workers_change_no_pixel");
    if (count >= 100)
        ok(t.lit && t.nonzero && t.several && t.views[0][0] && t.views[0][1] && t.views[1][0] && t.views[1][1] &&
               t.inside && t.crossing && t.clipped,
           "all_kinds_of_cameras_lights_and_clipping_were_among_them");
    return tap_done();
}
