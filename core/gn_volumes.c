/* Shadow volumes (Crow 1977): the sample-exact method, without a map.
 *
 * Every triangle that the light does not see edge-on casts a volume: itself (the cap), a side over each of its edges,
 * away from the light to infinity, and for a spot light a lid at infinity. A pixel's point is shadowed where a volume
 * holds it. Sides of neighbours that face the light alike cancel, so sides are drawn over silhouette edges only, with
 * their winding (gn_silhouette.h); caps are all triangles, closed or open, so neither a camera nor a light inside a
 * solid, nor a solid inside out, is a special case. The frustum of a spot light is one more volume, of winding -1, and
 * a pixel's count then begins with 1: what lies outside is shadowed.
 *
 * Counting is z-fail: faces behind the visible point, +1 where they turn away from the camera, -1 where they turn to
 * it; what the near plane cuts off is before every point and never missed. Nothing is cut at the far plane. A cap is
 * behind the visible point of every pixel that it covers, or is the point's own triangle: no comparison. A lid is at
 * infinity: no comparison. It is drawn as a fan from the light's axis over the silhouette edges.
 * Sides compare nearness (gn_nearness.h), held to the range of their corners: of the point, on its triangle's plane,
 * and of the side. A side over an edge of the point's own triangle is always behind: it lies on the other side of the
 * triangle's plane from light and camera. (Without that rule a pixel that snapping has moved past the edge could find
 * the two planes in the wrong order.) Coverage is that of the snapped corners, the same for both faces at an edge: counts are closed.
 *
 * Memory: per pixel of a region and worker 10 bytes beside visibility's 8. Counts are modulo 2^16, so 65,536 volumes
 * over one point would be none. Cost: a side is set up once for every region that its rows touch. */
#include "gn_volumes.h"

#include "gn_bins.h"
#include "gn_clip.h"
#include "gn_tally.h"

typedef struct target {
    uint16_t *count;
    const int64_t *point;
    const uint32_t *triangle;
    int32_t stride, row0, column0;
    uint32_t weight; /* what a covered pixel gains, modulo 2^16 */
    uint32_t own[2]; /* the triangles on a side's edge: it is behind their points */
    gn_nearness plane;
    gn_reach reach; /* in units of the plane's value */
    GN_TALLY(gn_tally *tally;)
} target;

GN_INLINE int64_t clamp(int64_t v, int64_t low, int64_t high)
{
    return v < low ? low : v > high ? high : v;
}

/* ---- spans ----------------------------------------------------------------------------------------------------- */

GN_INLINE void span_behind(const void *state, int32_t row, int32_t left, int32_t right)
{
    const target *t = state;
    uint16_t *count = t->count + (row - t->row0) * t->stride - t->column0;
    GN_TALLY(t->tally->centres += (uint32_t)(right - left);)
    for (int32_t x = left; x < right; x++)
        count[x] = (uint16_t)(count[x] + t->weight);
}

GN_INLINE void span_compared(const void *state, int32_t row, int32_t left, int32_t right, unsigned shift)
{
    const target *t = state;
    int32_t at = (row - t->row0) * t->stride - t->column0;
    uint16_t *count = t->count + at;
    const int64_t *point = t->point + at;
    const uint32_t *triangle = t->triangle + at;
    int64_t dx = t->plane.dx, value = t->plane.base + row * t->plane.dy + left * dx, low = t->reach.low,
            high = t->reach.high;
    uint32_t weight = t->weight, own0 = t->own[0], own1 = t->own[1];
    GN_TALLY(t->tally->centres += (uint32_t)(right - left);)
    for (int32_t x = left; x < right; x++, value += dx)
        if (clamp(value, low, high) < gn_floor_shift_64(point[x], shift) || triangle[x] == own0 || triangle[x] == own1)
            count[x] = (uint16_t)(count[x] + weight);
}

GN_INLINE void span_plain(const void *state, int32_t row, int32_t left, int32_t right)
{
    span_compared(state, row, left, right, 0);
}

GN_INLINE void span_steep(const void *state, int32_t row, int32_t left, int32_t right)
{
    span_compared(state, row, left, right, ((const target *)state)->plane.shift);
}

/* ---- faces ----------------------------------------------------------------------------------------------------- */

typedef enum kind { BEHIND, COMPARED } kind;

static GN_NOINLINE void walk_face(const target *t, const gn_rows *rows, const gn_window *window, kind by)
{
    if (by == BEHIND)
        gn_walk(rows, window, rows->cut, span_behind, t);
    else if (t->plane.shift == 0)
        gn_walk(rows, window, rows->cut, span_plain, t);
    else
        gn_walk(rows, window, rows->cut, span_steep, t);
}

/* One triangle of a face: it counts as it turns on the screen. */
static void draw_piece(target *t, const gn_vertex *v0, const gn_vertex *v1, const gn_vertex *v2, int32_t winding,
                       const gn_window *window, kind by)
{
    gn_rows rows;
    int64_t area = gn_area(v0, v1, v2);
    if (area == 0 || !gn_find_rows(&rows, v0, area > 0 ? v1 : v2, area > 0 ? v2 : v1, window))
        return;
    t->weight = (uint32_t)(area > 0 ? winding : -winding);
    walk_face(t, &rows, window, by);
    GN_TALLY(t->tally->triangles++;)
}

/* A polygon before projection: finite corners are places; those at infinity directions, any length. */
typedef struct face {
    gn_place place[GN_CLIP_VERTICES];
    uint8_t infinite[GN_CLIP_VERTICES];
    int32_t count;
} face;

typedef struct outline {
    gn_vertex v[GN_CLIP_VERTICES];
    int32_t count;
} outline;

static int64_t distance(const gn_view *view, const face *f, int32_t i, int plane)
{
    const gn_place *p = &f->place[i];
    if (!f->infinite[i])
        return gn_plane_distance(view, p, plane);
    /* what is constant in a distance does not count at infinity */
    if (plane == 0)
        return p->c[2];
    if (!view->affine)
        return gn_plane_distance(view, p, plane);
    int64_t c = p->c[(plane - 2) >> 1];
    return plane & 1 ? c : -c;
}

/* a + s d at distance 0, s = |from_a| / |from_d|. Perspective: scaled down where it would not fit. */
static gn_place ray_crossing(const gn_view *view, const gn_place *a, const gn_place *d, int64_t from_a, int64_t from_d,
                             int plane)
{
    gn_place p;
    gn_wide s = gn_wide_multiply(gn_widen(from_a < 0 ? -from_a : from_a, 0),
                                 gn_wide_reciprocal(gn_widen(from_d < 0 ? -from_d : from_d, 0)));
    gn_wide sum[3];
    int32_t bits = 0;
    for (int i = 0; i < 3; i++) {
        sum[i] = gn_wide_add(gn_widen(a->c[i], 0), gn_wide_multiply(s, gn_widen(d->c[i], 0)));
        bits = gn_wide_bits(sum[i]) > bits ? gn_wide_bits(sum[i]) : bits;
    }
    if (plane == 0)
        sum[2] = gn_widen(view->near_w, 0);
    int64_t most = (int64_t)1 << 44;
    int32_t excess = bits > 40 && !view->affine ? bits - 40 : 0;
    for (int i = 0; i < 3; i++)
        p.c[i] = clamp(gn_wide_round(sum[i], excess), -most, most);
    return p;
}

static void keep(face *f, const gn_place *place, uint8_t infinite)
{
    if (f->count == GN_CLIP_VERTICES) /* a convex polygon gains at most one vertex a plane, rounding aside */
        return;
    f->place[f->count] = *place;
    f->infinite[f->count++] = infinite;
}

static void clip_face(const gn_view *view, const face *in, face *out, int plane)
{
    out->count = 0;
    for (int32_t i = 0; i < in->count; i++) {
        int32_t next = i + 1 < in->count ? i + 1 : 0;
        int64_t da = distance(view, in, i, plane), db = distance(view, in, next, plane);
        const gn_place *a = &in->place[i], *b = &in->place[next];
        if (da >= 0)
            keep(out, a, in->infinite[i]);
        if (!((da > 0 && db < 0) || (da < 0 && db > 0)))
            continue;
        gn_place p;
        if (in->infinite[i] == in->infinite[next])
            p = gn_plane_crossing(view, a, b, da, db, in->infinite[i] ? GN_CLIP_PLANES : plane);
        else if (in->infinite[i])
            p = ray_crossing(view, b, a, db, da, plane);
        else
            p = ray_crossing(view, a, b, da, db, plane);
        keep(out, &p, in->infinite[i] && in->infinite[next]);
    }
}

/* Places beyond 30 bits, which only perspective faces have, keep their proportions. */
static void shorten(gn_place *p)
{
    int64_t limit = (int64_t)1 << 30;
    while (p->c[0] > limit || p->c[0] < -limit || p->c[1] > limit || p->c[1] < -limit || p->c[2] > limit)
        for (int i = 0; i < 3; i++)
            p->c[i] = gn_floor_shift_64(p->c[i] + 1, 1);
    p->c[2] = p->c[2] < 1 ? 1 : p->c[2];
}

/* Clip and project. The near plane is that of the camera: nothing before it is seen. */
static void project_face(const gn_view *view, const face *f, outline *out)
{
    face clipped[2];
    int from = 0;
    out->count = 0;
    clipped[0] = *f;
    for (int plane = 0; plane < GN_CLIP_PLANES && clipped[from].count >= 3; plane++) {
        if (plane == 1 || (plane == 0 && view->affine))
            continue;
        clip_face(view, &clipped[from], &clipped[from ^ 1], plane);
        from ^= 1;
    }
    face *last = &clipped[from];
    for (int32_t i = 0; last->count >= 3 && i < last->count; i++) {
        if (view->affine && last->infinite[i])
            continue; /* along the view: no place on the screen */
        if (!view->affine)
            shorten(&last->place[i]);
        gn_view_project_inside(view, &last->place[i], &out->v[out->count++]);
    }
}

static void draw_outline(target *t, const outline *o, int32_t winding, const gn_window *window, kind by)
{
    for (int32_t i = 1; i + 1 < o->count; i++)
        draw_piece(t, &o->v[0], &o->v[i], &o->v[i + 1], winding, window, by);
}

/* The rows that an outline covers, added to those of a silhouette. */
static void add_rows(gn_silhouette *s, const outline *o, int32_t height)
{
    for (int32_t i = 0; o->count >= 3 && i < o->count; i++) {
        int32_t above = gn_first_centre(o->v[i].y) - 1, below = above + 1;
        above = above < 0 ? 0 : above;
        below = below > height - 1 ? height - 1 : below;
        s->first_row = (int32_t)s->first_row > below ? (uint16_t)(below < 0 ? 0 : below) : s->first_row;
        s->last_row = (int32_t)s->last_row < above ? (uint16_t)(above > height - 1 ? height - 1 : above) : s->last_row;
    }
}

/* ---- sides and lids -------------------------------------------------------------------------------------------- */

/* One end of a side: its place, and the way on from there, away from the light. */
typedef struct corner {
    gn_place place;
    int32_t away[3];    /* |.| <= 2^30 */
    gn_place direction; /* of away */
} corner;

static gn_place place_direction(const gn_view *view, const int32_t d[3])
{
    gn_wide sum[3];
    int32_t bits = -10000;
    gn_place p;
    for (int i = 0; i < 3; i++) {
        const gn_row *row = &view->row[i];
        sum[i] = gn_widen(gn_multiply(row->m[0], d[0]) + gn_multiply(row->m[1], d[1]) + gn_multiply(row->m[2], d[2]),
                          -row->shift);
        bits = gn_wide_bits(sum[i]) > bits && (i < 2 || !view->affine) ? gn_wide_bits(sum[i]) : bits;
    }
    for (int i = 0; i < 3; i++)
        p.c[i] = i < 2 || !view->affine ? gn_wide_round(sum[i], bits - 29) : 0;
    return p;
}

static void set_corner(corner *c, const gn_view *view, const gn_light *light, const int32_t world[3])
{
    (void)gn_view_place(view, world, &c->place);
    for (int i = 0; i < 3; i++)
        c->away[i] = light->kind == GN_SPOT ? world[i] - light->position[i] : light->forward[i];
    c->direction = place_direction(view, c->away);
}

static void add_corner(face *f, const gn_place *place, uint8_t infinite)
{
    f->place[f->count] = *place;
    f->infinite[f->count++] = infinite;
}

/* The side over the edge from a to b of a cap: seen from outside the volume its corners run b, a, a at infinity, b at
 * infinity; all light of the sun meets in one point there. */
static void make_side(outline *o, const gn_view *view, const gn_light *light, const corner *a, const corner *b)
{
    face f;
    f.count = 0;
    add_corner(&f, &b->place, 0);
    add_corner(&f, &a->place, 0);
    add_corner(&f, &a->direction, 1);
    if (light->kind == GN_SPOT)
        add_corner(&f, &b->direction, 1);
    project_face(view, &f, o);
}

/* Its part of the lid, from the light's axis. An orthographic camera sees all of infinity in one point. */
static void make_lid(outline *o, const gn_view *view, const gn_place *axis, const corner *a, const corner *b)
{
    face f;
    f.count = 0;
    add_corner(&f, &b->direction, 1);
    add_corner(&f, &a->direction, 1);
    add_corner(&f, axis, 1);
    project_face(view, &f, o);
}

/* The plane of a side: through the light and both ends. from: any point on it. */
static void set_plane(target *t, const gn_eye *eye, const int64_t n[3], const int32_t from[3], const gn_reach *reach)
{
    int32_t apart[3] = {from[0] - eye->position[0], from[1] - eye->position[1], from[2] - eye->position[2]};
    gn_make_nearness(&t->plane, eye, n, gn_wide_dot(n, apart));
    t->reach.low = gn_floor_shift_64(reach->low, t->plane.shift);
    t->reach.high = gn_floor_shift_64(reach->high, t->plane.shift);
}

typedef struct region {
    const gn_context *context;
    const gn_volumes *volumes;
    const gn_window *window;
    gn_place axis; /* of the light's forward, at infinity */
    target t;
} region;

/* A silhouette's edge in the world. */
static int32_t find_edge(const gn_context *context, const gn_silhouette *s, int32_t world[2][3], uint32_t own[2])
{
    const gn_volumes *volumes = context->volumes;
    uint32_t number = s->edge >> volumes->edge_bits, ends[2];
    const gn_object *object = &context->scene->objects[number];
    const gn_mesh_edge *edge = &object->mesh->edges[s->edge & (((uint32_t)1 << volumes->edge_bits) - 1)];
    int32_t winding =
        gn_edge_winding(object->mesh, edge, volumes->facings, context->objects[number].first_triangle, ends);
    (void)gn_world_position(object, ends[0], world[0]);
    (void)gn_world_position(object, ends[1], world[1]);
    own[0] = number << context->triangle_bits | edge->half[0] / 3;
    own[1] = own[0];
    if (edge->half[1] != GN_NO_HALF_EDGE)
        own[1] = number << context->triangle_bits | (edge->half[1] & ~GN_SAME_DIRECTION) / 3;
    return winding;
}

static void draw_silhouette(region *r, const gn_silhouette *s)
{
    const gn_light *light = &r->context->light;
    const gn_view *view = &r->volumes->view;
    const gn_eye *eye = &r->volumes->eye;
    int32_t world[2][3], along[3];
    int64_t n[3];
    corner ends[2];
    outline side, lid;
    int32_t winding = find_edge(r->context, s, world, r->t.own);
    gn_reach reach = gn_empty_reach();
    for (int i = 0; i < 2; i++) {
        set_corner(&ends[i], view, light, world[i]);
        gn_reach_point(&reach, eye, world[i]);
        gn_reach_ray(&reach, eye, ends[i].away);
    }
    make_side(&side, view, light, &ends[0], &ends[1]);
    for (int i = 0; i < 3; i++)
        along[i] = light->kind == GN_SPOT ? ends[1].away[i] : world[1][i] - world[0][i];
    gn_cross(n, ends[0].away, along);
    set_plane(&r->t, eye, n, world[0], &reach);
    draw_outline(&r->t, &side, winding, r->window, COMPARED);
    if (light->kind != GN_SPOT || view->affine)
        return;
    make_lid(&lid, view, &r->axis, &ends[0], &ends[1]);
    draw_outline(&r->t, &lid, winding, r->window, BEHIND);
}

static void draw_silhouettes(region *r)
{
    const gn_silhouette *s = r->volumes->silhouettes, *end = s + r->volumes->silhouette_count;
    int32_t first = r->window->row0, last = r->window->row1 - 1;
    for (; s != end; s++)
        if (s->first_row <= last && s->last_row >= first)
            draw_silhouette(r, s);
}

/* ---- caps ------------------------------------------------------------------------------------------------------ */

static GN_NOINLINE void draw_clipped_cap(region *r, const gn_object *object, const uint32_t index[3], int32_t winding)
{
    gn_place place[3];
    face f;
    outline o;
    gn_triangle_places(&r->volumes->view, object, index, place);
    f.count = 0;
    for (int i = 0; i < 3; i++)
        add_corner(&f, &place[i], 0);
    project_face(&r->volumes->view, &f, &o);
    draw_outline(&r->t, &o, winding, r->window, BEHIND);
}

GN_INLINE void draw_cap(void *user, uint32_t number, uint32_t triangle)
{
    region *r = user;
    const gn_context *context = r->context;
    uint32_t index[3];
    const gn_object *object = &context->scene->objects[number];
    const gn_object_state *state = &context->objects[number];
    int32_t winding = gn_facing_sign(gn_facing_of(r->volumes->facings, state->first_triangle + triangle));
    if (winding == 0)
        return;
    gn_triangle_indices(object->mesh, triangle, index);
    const gn_vertex *vertices = context->vertices + state->first_vertex;
    const gn_vertex *v0 = vertices + index[0], *v1 = vertices + index[1], *v2 = vertices + index[2];
    if (state->clips && (v0->depth == 0 || v1->depth == 0 || v2->depth == 0))
        draw_clipped_cap(r, object, index, winding);
    else
        draw_piece(&r->t, v0, v1, v2, winding, r->window, BEHIND);
}

static GN_NOINLINE void draw_caps(region *r)
{
    gn_visit_region(r->context, r->window, draw_cap, r);
}

/* ---- triangles that the near plane of a spot light cuts -------------------------------------------------------- */

/* The part beyond the plane, three or four corners. */
typedef struct cut {
    corner corners[4];
    int32_t count;
} cut;

static int64_t beyond_near(const gn_light *light, const int32_t world[3])
{
    int64_t w = 0;
    for (int i = 0; i < 3; i++)
        w += gn_multiply(world[i] - light->position[i], light->forward[i]);
    return w - gn_multiply(light->near_depth, 1 << 30);
}

static int32_t bits_of(int64_t v)
{
    return v ? 64 - (int32_t)gn_leading_zeros_64((uint64_t)(v < 0 ? ~v : v) | 1) : 0;
}

/* Where the edge crosses the plane: the same for both triangles on it. */
static void set_cut(corner *c, const gn_view *view, const corner *a, const corner *b, int64_t da, int64_t db)
{
    c->place = gn_plane_crossing(view, &a->place, &b->place, da, db, GN_CLIP_PLANES);
    int64_t to_a = da < 0 ? -da : da, to_b = db < 0 ? -db : db, sum[3];
    while ((to_a | to_b) >> 31) {
        to_a >>= 1;
        to_b >>= 1;
    }
    int32_t bits = 0;
    for (int i = 0; i < 3; i++) {
        sum[i] = gn_multiply(a->away[i], (int32_t)to_b) + gn_multiply(b->away[i], (int32_t)to_a);
        bits = bits_of(sum[i]) > bits ? bits_of(sum[i]) : bits;
    }
    for (int i = 0; i < 3; i++)
        c->away[i] = (int32_t)(bits > 30 ? gn_floor_shift_64(sum[i], (unsigned)(bits - 30))
                                         : sum[i] * ((int64_t)1 << (30 - bits)));
    c->direction = place_direction(view, c->away);
}

static void cut_at_near(cut *out, const gn_view *view, const gn_light *light, int32_t world[3][3])
{
    corner corners[3];
    int64_t d[3];
    out->count = 0;
    for (int i = 0; i < 3; i++) {
        set_corner(&corners[i], view, light, world[i]);
        d[i] = beyond_near(light, world[i]);
    }
    for (int i = 0; i < 3; i++) {
        int next = i < 2 ? i + 1 : 0;
        if (d[i] >= 0)
            out->corners[out->count++] = corners[i];
        if ((d[i] > 0 && d[next] < 0) || (d[i] < 0 && d[next] > 0))
            set_cut(&out->corners[out->count++], view, &corners[i], &corners[next], d[i], d[next]);
    }
}

static void draw_cut_volume(region *r, uint32_t number, uint32_t triangle)
{
    const gn_object *object = &r->context->scene->objects[number];
    const gn_light *light = &r->context->light;
    const gn_view *view = &r->volumes->view;
    const gn_eye *eye = &r->volumes->eye;
    gn_reach reach = gn_empty_reach();
    int32_t world[3][3];
    uint32_t index[3];
    cut c;
    face cap;
    outline o;
    gn_triangle_indices(object->mesh, triangle, index);
    for (int i = 0; i < 3; i++)
        (void)gn_world_position(object, index[i], world[i]);
    int32_t winding = gn_light_side(light, world);
    r->t.own[0] = r->t.own[1] = number << r->context->triangle_bits | triangle;
    cut_at_near(&c, view, light, world);
    cap.count = 0;
    for (int32_t i = 0; i < c.count; i++)
        add_corner(&cap, &c.corners[i].place, 0);
    project_face(view, &cap, &o);
    draw_outline(&r->t, &o, winding, r->window, BEHIND);
    for (int i = 0; i < 3; i++)
        gn_reach_point(&reach, eye, world[i]);
    for (int32_t i = 0; i < c.count; i++)
        gn_reach_ray(&reach, eye, c.corners[i].away);
    for (int32_t i = 0; i < c.count; i++) {
        const corner *a = &c.corners[i], *b = &c.corners[i + 1 < c.count ? i + 1 : 0];
        int64_t n[3];
        gn_cross(n, a->away, b->away);
        make_side(&o, view, light, a, b);
        set_plane(&r->t, eye, n, light->position, &reach);
        draw_outline(&r->t, &o, winding, r->window, COMPARED);
        if (view->affine)
            continue;
        make_lid(&o, view, &r->axis, a, b);
        draw_outline(&r->t, &o, winding, r->window, BEHIND);
    }
}

static void draw_cut_volumes(region *r)
{
    const gn_scene *scene = r->context->scene;
    for (uint32_t o = 0; r->volumes->crossing && o < scene->object_count; o++)
        for (uint32_t t = 0; t < scene->objects[o].mesh->triangle_count; t++)
            if (gn_facing_of(r->volumes->facings, r->context->objects[o].first_triangle + t) == GN_CROSSES_NEAR)
                draw_cut_volume(r, o, t);
}

/* ---- the frustum of a spot light ------------------------------------------------------------------------------- */

/* Its corners: bit 0 right, bit 1 above, bit 2 far. */
static gn_place frustum_corner(const gn_view *view, const gn_light *light, int which)
{
    gn_place p;
    gn_wide tangent = gn_widen(light->tan_half, -24);
    gn_wide depth = gn_widen(which & 4 ? light->far_depth : light->near_depth, -30);
    for (int i = 0; i < 3; i++) {
        const gn_row *row = &view->row[i];
        const int64_t m[3] = {row->m[0], row->m[1], row->m[2]};
        gn_wide right = gn_wide_multiply(gn_wide_dot(m, light->right), tangent);
        gn_wide up = gn_wide_multiply(gn_wide_dot(m, light->up), tangent);
        gn_wide sum = gn_wide_add(gn_wide_dot(m, light->forward), which & 1 ? right : gn_wide_negate(right));
        sum = gn_wide_multiply(gn_wide_add(sum, which & 2 ? up : gn_wide_negate(up)), depth);
        sum = gn_wide_add(sum, gn_widen(row->offset, 0));
        sum = gn_wide_add(sum, gn_wide_dot(m, light->position));
        p.c[i] = gn_wide_round(sum, row->shift);
    }
    return p;
}

/* Its planes, normals outward: near, far, right, left, above, below; and the distance of each from the light, times
 * the normal's length. */
static int64_t frustum_plane(int64_t n[3], const gn_light *light, int which)
{
    const gn_q2_30 *axis = which < 4 ? light->right : light->up;
    for (int i = 0; i < 3; i++) {
        n[i] = which == 0 ? -(int64_t)light->forward[i] : light->forward[i];
        if (which >= 2) {
            int64_t across = axis[i] * (int64_t)(1 << 24);
            n[i] = (which & 1 ? -across : across) - gn_multiply(light->forward[i], (int32_t)light->tan_half);
        }
    }
    return which == 0   ? -gn_multiply(light->near_depth, 1 << 30)
           : which == 1 ? gn_multiply(light->far_depth, 1 << 30)
                        : 0;
}

static void draw_frustum(region *r)
{
    static const uint8_t corners[6][4] = {{0, 1, 3, 2}, {6, 7, 5, 4}, {1, 5, 7, 3},
                                          {4, 0, 2, 6}, {2, 3, 7, 6}, {1, 0, 4, 5}};
    const gn_light *light = &r->context->light;
    const gn_eye *eye = &r->volumes->eye;
    gn_reach everywhere = {-GN_NEAREST, GN_NEAREST};
    int32_t apart[3];
    r->t.own[0] = r->t.own[1] = GN_NO_TRIANGLE;
    for (int i = 0; i < 3; i++)
        apart[i] = light->position[i] - eye->position[i];
    for (int which = 0; which < 6; which++) {
        face f;
        outline o;
        int64_t n[3], offset = frustum_plane(n, light, which);
        f.count = 0;
        for (int i = 0; i < 4; i++) {
            gn_place p = frustum_corner(&r->volumes->view, light, corners[which][i]);
            add_corner(&f, &p, 0);
        }
        project_face(&r->volumes->view, &f, &o);
        gn_make_nearness(&r->t.plane, eye, n, gn_wide_add(gn_wide_dot(n, apart), gn_widen(offset, 0)));
        r->t.reach = everywhere;
        draw_outline(&r->t, &o, -1, r->window, COMPARED);
    }
}

/* ---- the visible points ---------------------------------------------------------------------------------------- */

static void set_seen_plane(const gn_context *context, gn_seen_plane *seen, uint32_t identifier)
{
    const gn_volumes *volumes = context->volumes;
    const gn_camera *camera = &context->camera;
    int32_t world[3][3], edge[2][3], to_camera[3];
    int64_t n[3];
    uint32_t index[3];
    seen->triangle = identifier;
    seen->counts = 0;
    if (identifier == GN_NO_TRIANGLE)
        return;
    const gn_object *object = &context->scene->objects[identifier >> context->triangle_bits];
    gn_triangle_indices(object->mesh, identifier & (((uint32_t)1 << context->triangle_bits) - 1), index);
    seen->reach = gn_empty_reach();
    for (int i = 0; i < 3; i++) {
        (void)gn_world_position(object, index[i], world[i]);
        gn_reach_point(&seen->reach, &volumes->eye, world[i]);
    }
    for (int i = 0; i < 3; i++) {
        edge[0][i] = world[1][i] - world[0][i];
        edge[1][i] = world[2][i] - world[0][i];
        to_camera[i] = camera->projection == GN_PERSPECTIVE ? camera->eye[i] - world[0][i] : -camera->forward[i];
    }
    gn_cross(n, edge[0], edge[1]);
    int side = gn_light_side(&context->light, world);
    if (side == 0 || side != gn_dot_sign(n, to_camera))
        return;
    seen->counts = 1;
    int32_t apart[3];
    for (int i = 0; i < 3; i++)
        apart[i] = world[0][i] - camera->eye[i];
    gn_make_nearness(&seen->plane, &volumes->eye, n, gn_wide_dot(n, apart));
}

/* Nearness of the points of a row; below every face where nothing is counted. */
static void find_points(const gn_context *context, gn_volumes_worker *worker, const uint32_t *triangle, int64_t *point,
                        int32_t x, int32_t y, int32_t count)
{
    const gn_seen_plane *seen = 0;
    for (int32_t i = 0; i < count; i++) {
        if (i == 0 || triangle[i] != triangle[i - 1]) {
            gn_seen_plane *entry = &worker->planes[triangle[i] & (GN_COLOUR_CACHE - 1)];
            if (entry->triangle != triangle[i] || triangle[i] == GN_NO_TRIANGLE)
                set_seen_plane(context, entry, triangle[i]);
            seen = entry;
        }
        if (!seen->counts) {
            point[i] = -2 * GN_NEAREST;
            continue;
        }
        unsigned shift = seen->plane.shift;
        int64_t value = seen->plane.base + (x + i) * seen->plane.dx + y * seen->plane.dy;
        value = clamp(value, gn_floor_shift_64(seen->reach.low, shift), gn_floor_shift_64(seen->reach.high, shift));
        point[i] = value * ((int64_t)1 << shift);
    }
}

/* ---- the interface --------------------------------------------------------------------------------------------- */

gn_status gn_volumes_light(gn_context *context, const gn_light *light)
{
    if (!context || !light)
        return GN_BAD_ARGUMENT;
    if (!context->volumes)
        return GN_UNSUPPORTED;
    gn_volumes *volumes = context->volumes;
    uint32_t casting;
    context->phase = GN_PHASE_NONE;
    context->light = *light;
    if (light->kind != GN_SPOT && light->kind != GN_DIRECTIONAL)
        return GN_BAD_ARGUMENT;
    gn_status status = GN_OK;
    if (light->kind == GN_SPOT)
        status =
            gn_make_light_view(&context->light_view, light, context->settings.map_width, context->settings.map_height);
    for (int i = 0; i < 3; i++)
        if (light->forward[i] > (1 << 30) + 16 || light->forward[i] < -(1 << 30) - 16)
            status = GN_OUT_OF_RANGE;
    if (status == GN_OK)
        status = gn_find_facings(context->scene, light, volumes->facings, &casting, &volumes->crossing);
    if (status == GN_OK)
        status = gn_list_silhouettes(context->scene, volumes->facings, volumes->edge_bits, volumes->silhouettes,
                                     &volumes->silhouette_count);
    if (status != GN_OK)
        return status;
    context->tan_squared = (uint32_t)(gn_multiply_u(light->tan_half, light->tan_half) >> 29);
    context->phase = GN_PHASE_VOLUMES_LIGHT;
    return GN_OK;
}

/* p before q, so that a tie of three directions is settled the same way from both sides. */
static int precedes(const int32_t p[3], const int32_t q[3])
{
    for (int i = 0; i < 3; i++)
        if (p[i] != q[i])
            return p[i] < q[i];
    return 0;
}

/* The way from p to q about d. */
static int turn(const int32_t p[3], const int32_t q[3], const int32_t d[3])
{
    int64_t n[3];
    gn_cross(n, p, q);
    int sign = gn_dot_sign(n, d);
    return sign ? sign : precedes(p, q) ? 1 : -1;
}

/* How often a part of the lid covers the one direction in which an orthographic camera looks. */
static uint32_t lid_along_view(const gn_context *context, const int32_t a[3], const int32_t b[3], int32_t winding)
{
    const int32_t *forward = context->camera.forward, *axis = context->light.forward;
    int first = turn(b, a, forward), second = turn(a, axis, forward), third = turn(axis, b, forward);
    if (first != second || second != third)
        return 0;
    int64_t along = 0; /* the cone, not its mirror image */
    for (int i = 0; i < 3; i++)
        along += gn_multiply(axis[i], forward[i]);
    return along > 0 ? (uint32_t)(first > 0 ? -winding : winding) : 0;
}

/* Rows of every silhouette's faces. */
static void find_rows(gn_context *context)
{
    gn_volumes *volumes = context->volumes;
    const gn_light *light = &context->light;
    gn_place axis = place_direction(&volumes->view, light->forward);
    volumes->outside = light->kind == GN_SPOT;
    for (uint32_t i = 0; i < volumes->silhouette_count; i++) {
        gn_silhouette *s = &volumes->silhouettes[i];
        int32_t world[2][3];
        uint32_t own[2];
        corner ends[2];
        outline o;
        s->first_row = 0xffff;
        s->last_row = 0;
        int32_t winding = find_edge(context, s, world, own);
        for (int k = 0; k < 2; k++)
            set_corner(&ends[k], &volumes->view, light, world[k]);
        make_side(&o, &volumes->view, light, &ends[0], &ends[1]);
        add_rows(s, &o, context->settings.height);
        if (light->kind != GN_SPOT)
            continue;
        if (volumes->view.affine) {
            volumes->outside =
                (uint16_t)(volumes->outside + lid_along_view(context, ends[0].away, ends[1].away, winding));
            continue;
        }
        make_lid(&o, &volumes->view, &axis, &ends[0], &ends[1]);
        add_rows(s, &o, context->settings.height);
    }
}

gn_status gn_volumes_begin(gn_context *context, const gn_camera *camera)
{
    if (!context || !camera)
        return GN_BAD_ARGUMENT;
    if (!context->volumes)
        return GN_UNSUPPORTED;
    if (context->phase != GN_PHASE_VOLUMES_LIGHT && context->phase != GN_PHASE_VOLUMES)
        return GN_NOT_READY;
    gn_volumes *volumes = context->volumes;
    context->phase = GN_PHASE_VOLUMES_LIGHT;
    gn_lay_out_camera(context, &context->plan, &context->settings);
    context->camera = *camera;
    int32_t largest_w;
    int inside;
    gn_status status =
        gn_make_camera_view(&context->camera_view, camera, context->settings.width, context->settings.height);
    if (status == GN_OK)
        status = gn_transform_scene(context, &context->camera_view, &largest_w, &inside);
    if (status != GN_OK)
        return status;
    volumes->view = context->camera_view;
    volumes->view.endless = 1;
    gn_make_eye(&volumes->eye, camera, context->settings.width, context->settings.height);
    if (context->light.kind == GN_SPOT)
        status = gn_make_shading(context, largest_w);
    else
        gn_set_farthest(context, largest_w);
    if (status == GN_OK)
        status = gn_make_bins(context, &volumes->view);
    if (status != GN_OK)
        return status;
    find_rows(context);
    for (uint32_t i = 0; i < context->settings.workers; i++) {
        gn_clear_colours(&context->workers[i]);
        for (uint32_t k = 0; k < GN_COLOUR_CACHE; k++)
            volumes->workers[i].planes[k].triangle = GN_NO_TRIANGLE;
    }
    context->phase = GN_PHASE_VOLUMES;
    return GN_OK;
}

static void count_volumes(gn_context *context, uint32_t worker, const gn_window *window)
{
    gn_volumes *volumes = context->volumes;
    gn_volumes_worker *w = &volumes->workers[worker];
    region r;
    r.context = context;
    r.volumes = volumes;
    r.window = window;
    r.axis = place_direction(&volumes->view, context->light.forward);
    r.t.count = w->count;
    r.t.point = w->point;
    r.t.triangle = context->workers[worker].triangle;
    r.t.stride = window->column1 - window->column0;
    r.t.row0 = window->row0;
    r.t.column0 = window->column0;
    GN_TALLY(gn_tally tally = {0}; r.t.tally = &tally;)
    for (int32_t i = 0; i < r.t.stride * (window->row1 - window->row0); i++)
        w->count[i] = volumes->outside;
    draw_caps(&r);
    draw_silhouettes(&r);
    draw_cut_volumes(&r);
    if (context->light.kind == GN_SPOT)
        draw_frustum(&r);
    GN_TALLY(context->workers[worker].statistics.volume_faces += tally.triangles;)
    GN_TALLY(context->workers[worker].statistics.volume_fragments += gn_tally_centres(&tally);)
}

gn_status gn_volumes_region(gn_context *context, uint32_t number, uint32_t worker, void *colour, uint8_t *mask,
                            gn_pixels *pixels)
{
    gn_window window;
    gn_status status = gn_find_region(context, number, worker, GN_PHASE_VOLUMES, colour, mask, pixels, &window);
    if (status != GN_OK)
        return status;
    gn_worker *w = &context->workers[worker];
    gn_volumes_worker *v = &context->volumes->workers[worker];
    int32_t width = pixels->width;
    if (context->settings.format == GN_NO_COLOUR)
        colour = 0;
    gn_rasterise_region(context, w, &window);
    for (int32_t row = 0; row < pixels->height; row++)
        find_points(context, v, w->triangle + row * width, v->point + row * width, window.column0, window.row0 + row,
                    width);
    count_volumes(context, worker, &window);
    for (int32_t row = 0; row < pixels->height; row++) {
        uint32_t *lit = w->q + row * width;
        if (context->light.kind == GN_SPOT)
            gn_falloff_row(context, lit, window.column0, window.row0 + row, width);
        for (int32_t i = 0; i < width; i++)
            if (v->count[row * width + i])
                lit[i] = 0x80000000u;
        gn_colour_region_row(context, w, colour, mask, (uint32_t)row, pixels->width);
    }
    return GN_OK;
}

gn_status gn_volumes_pass(gn_context *context, const gn_camera *camera, gn_flush flush, void *user)
{
    if (!flush)
        return GN_BAD_ARGUMENT;
    gn_status status = gn_volumes_begin(context, camera);
    for (uint32_t i = 0; status == GN_OK && i < context->plan.camera_regions; i++) {
        gn_pixels pixels;
        status = gn_volumes_region(context, i, 0, context->colour_buffer, context->mask_buffer, &pixels);
        if (status == GN_OK && flush(user, &pixels))
            status = GN_STOPPED;
    }
    return status;
}
