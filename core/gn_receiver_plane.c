/* A receiver's plane in light space: that of the triangle which a pixel sees, with the linear expression that the light
 * pass steps (invariant 5: no triangle shadows itself).
 *
 * The corners are projected again when a plane is first needed, by the functions that the light pass used, so vertices
 * need not be kept between the passes; a small cache keeps what neighbouring pixels ask for. Clipped triangles have one
 * plane for all pieces, as in the light pass.
 *
 * The light pass evaluates its planes modulo 2^32, at texels where the depth is in range. Beyond its triangle a plane
 * leaves the range, so here the base is widened: the depth at the first corner is in range, and so known.
 *
 * Cost: on a Cortex-M4 about 1,400 instructions a plane. Memory: 40 bytes an entry. */
#include "gn_cascade.h"
#include "gn_clip.h"
#include "gn_parameterisation.h"
#include "gn_point_light.h"

static int32_t length(const gn_vertex *a, const gn_vertex *b)
{
    int32_t x = a->x - b->x, y = a->y - b->y;
    return (x < 0 ? -x : x) + (y < 0 ? -y : y);
}

/* How far planes of neighbours in one flat wall may lie apart where their depths are compared, units of z.
 *
 * Corners are snapped by up to 1/512 texel along both axes, so a plane errs by up to h/256 at its corners, h being what
 * it rises within half a texel, and so does the depth that a neighbour stored. At a centre outside the triangle this
 * one errs by h/256 times the sum of its barycentric weights' magnitudes. A centre lies within half a texel of a point
 * of the triangle along both axes, so that sum is at most 1 + 256 (E1 + E2) / A: E1, E2 the longest sides, |x| + |y|, A
 * twice the area. More than h itself no centre differs from the point. What arithmetic adds is below 2^15. */
static int64_t slack_of(const gn_wide_plane *plane, const gn_vertex *v0, const gn_vertex *v1, const gn_vertex *v2,
                        int64_t area, int64_t error)
{
    int64_t h = gn_rise(plane->dx, plane->dy);
    int32_t a = length(v0, v1), b = length(v1, v2), c = length(v2, v0), least = a < b ? a : b;
    uint32_t sides = (uint32_t)(a + b + c - (c < least ? c : least)), weight = 256;
    uint64_t twice = (uint64_t)(area < 0 ? -area : area);
    if (twice >> 32)
        weight = 1;
    else if (sides < twice)
        weight = gn_divide((uint64_t)sides << 8, (uint32_t)twice) + 1;
    return GN_PLANE_ERROR + ((h >> 8) + error) * (int64_t)(2 + weight);
}

static void widen(gn_wide_plane *out, const gn_depth_plane *plane, const gn_vertex *first)
{
    out->dx = (int32_t)plane->dx;
    out->dy = (int32_t)plane->dy;
    int64_t from_first = gn_rise_from(first, (int32_t)plane->dx, (int32_t)plane->dy);
    out->base = (int64_t)(uint64_t)(plane->base - (uint32_t)from_first) + from_first;
}

static int place_corners(gn_place corner[3], const gn_view *view, int32_t world[3][3])
{
    for (int i = 0; i < 3; i++)
        if (gn_view_place(view, world[i], &corner[i]) != GN_OK)
            return 0; /* a model has left the light's reach since the light pass */
    return 1;
}

static GN_NOINLINE void make_plane(const gn_context *context, gn_receiver_plane *out, uint32_t triangle, uint32_t face)
{
    const gn_object *object = &context->scene->objects[triangle >> context->triangle_bits];
    const gn_view *view = context->point_light ? &context->point->views[face] : &context->light_view;
    int32_t world[3][3];
    int64_t normal[3];
    gn_place corner[3];
    gn_vertex v[3];
    gn_depth_plane plane;
    out->triangle = triangle;
    out->face = (uint8_t)face;
    out->exists = out->faces_light = 0;
    out->plane.dx = out->plane.dy = 0;
    out->slack = 0;
    (void)gn_triangle_world(object, triangle & (((uint32_t)1 << context->triangle_bits) - 1), world);
    gn_normal(normal, world);
    if (!gn_seen_lit(context, normal, world[0]))
        return;
    out->faces_light = 1;
    if (!place_corners(corner, view, world))
        return;
    for (int i = 0; i < 3; i++)
        gn_view_project(view, &corner[i], &v[i]);
    if (v[0].depth && v[1].depth && v[2].depth) {
        int64_t area = gn_area(&v[0], &v[1], &v[2]);
        const gn_vertex *second = &v[area > 0 ? 1 : 2], *third = &v[area > 0 ? 2 : 1];
        if (area == 0)
            return;
        int sheer = 0;
        if (gn_make_depth_plane(&plane, &v[0], second, third, area))
            sheer = gn_make_steep_plane(&out->plane, &v[0], second, third, area);
        else
            widen(&out->plane, &plane, &v[0]);
        /* one that is too steep even for 64 bits knows nothing of its depth: no virtual sample shadows it */
        out->slack = sheer ? (int64_t)1 << 32 : slack_of(&out->plane, &v[0], &v[1], &v[2], area, 0);
    } else {
        gn_polygon polygon;
        int64_t error = 0;
        int sheer = 0;
        if (view->endless) {
            sheer = context->fitting->clamped_plane(&out->plane, &polygon, view, corner, &error);
        } else {
            gn_clip_triangle(&polygon, view, corner);
            if (polygon.area)
                gn_make_clipped_plane(&plane, &polygon);
        }
        if (polygon.area == 0)
            return;
        if (!view->endless)
            widen(&out->plane, &plane, &polygon.v[0]);
        const gn_vertex *piece = &polygon.v[polygon.reference];
        out->slack =
            sheer ? (int64_t)1 << 32 : slack_of(&out->plane, &polygon.v[0], piece, piece + 1, polygon.area, error);
    }
    out->slack += view->endless ? GN_CLAMPED_ERROR : 0; /* of a neighbour */
    if (context->point_light)
        out->plane.base -= gn_face_row(context, face) * out->plane.dy;
    out->exists = 1;
}

uint32_t gn_face_of(const gn_context *context, const gn_points *points, int32_t i)
{
    if (!context->point_light)
        return 0;
    uint32_t row = (points->v[i] + (1u << (GN_FACE_BITS - 1))) >> GN_FACE_BITS, face = context->point->first;
    for (; row >= context->settings.map_height; row -= context->settings.map_height)
        face++;
    return face;
}

const gn_receiver_plane *gn_find_plane(const gn_context *context, gn_worker *worker, uint32_t triangle, uint32_t face)
{
    gn_receiver_plane *plane = &worker->planes[(triangle ^ 9 * face) & (GN_COLOUR_CACHE - 1)];
    if (plane->triangle != triangle || plane->face != face)
        make_plane(context, plane, triangle, face);
    return plane;
}
