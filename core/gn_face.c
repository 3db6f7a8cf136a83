#include "gn_face.h"

#include "gn_wide.h"

static int64_t distance(const gn_view *view, const gn_face *f, int32_t i, int plane)
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
        p.c[i] = gn_clamp(gn_wide_round(sum[i], excess), -most, most);
    return p;
}

static int is_far(const gn_place *p)
{
    int64_t most = (int64_t)1 << 44;
    for (int i = 0; i < 3; i++)
        if (p->c[i] > most || p->c[i] < -most)
            return 1;
    return 0;
}

/* gn_plane_crossing for places beyond 2^44, as only a spot light's frustum has them in an affine view. */
static gn_place far_crossing(const gn_place *a, const gn_place *b, int64_t da, int64_t db)
{
    gn_place p;
    gn_wide from_a = gn_widen(da < 0 ? -da : da, 0), from_b = gn_widen(db < 0 ? -db : db, 0);
    gn_wide whole = gn_wide_reciprocal(gn_wide_add(from_a, from_b));
    for (int i = 0; i < 3; i++)
        p.c[i] = gn_wide_round(gn_wide_add(gn_wide_multiply(gn_widen(a->c[i], 0), gn_wide_multiply(from_b, whole)),
                                           gn_wide_multiply(gn_widen(b->c[i], 0), gn_wide_multiply(from_a, whole))),
                               0);
    return p;
}

static void keep(gn_face *f, const gn_place *place, uint8_t infinite)
{
    if (f->count == GN_CLIP_VERTICES) /* a convex polygon gains at most one vertex a plane, rounding aside */
        return;
    f->place[f->count] = *place;
    f->infinite[f->count++] = infinite;
}

static void clip_face(const gn_view *view, const gn_face *in, gn_face *out, int plane)
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
        if (is_far(a) || is_far(b))
            p = far_crossing(a, b, da, db);
        else if (in->infinite[i] == in->infinite[next])
            p = gn_plane_crossing(view, a, b, da, db, in->infinite[i] ? GN_CLIP_PLANES : plane);
        else if (in->infinite[i])
            p = ray_crossing(view, b, a, db, da, plane);
        else
            p = ray_crossing(view, a, b, da, db, plane);
        keep(out, &p, in->infinite[i] && in->infinite[next]);
    }
}

/* Places beyond 30 bits, which only perspective faces have, keep their proportions, rounding aside. */
static void shorten(const gn_view *view, gn_place *p)
{
    int64_t limit = (int64_t)1 << 30;
    while (p->c[0] > limit || p->c[0] < -limit || p->c[1] > limit || p->c[1] < -limit || p->c[2] > limit)
        for (int i = 0; i < 3; i++)
            p->c[i] = gn_floor_shift_64(p->c[i] + 1, 1);
    p->c[2] = p->c[2] < 1 ? 1 : p->c[2];
    /* Clipping left |x| <= guard w; where w is but a few units rounding may leave more than can be projected. */
    int64_t reach = (view->guard + 1) * p->c[2];
    p->c[0] = gn_clamp(p->c[0], -reach, reach);
    p->c[1] = gn_clamp(p->c[1], -reach, reach);
}

/* Some corner lies beyond the plane: else clipping there changes nothing. */
static int is_cut(const gn_view *view, const gn_face *f, int plane)
{
    for (int32_t i = 0; i < f->count; i++)
        if (distance(view, f, i, plane) < 0)
            return 1;
    return 0;
}

/* All corners lie inside all planes, as mostly they do. */
static int is_inside(const gn_view *view, const gn_face *f)
{
    for (int32_t i = 0; i < f->count; i++) {
        const int64_t *c = f->place[i].c;
        int64_t reach = view->guard * c[2];
        if (view->affine || c[2] < (f->infinite[i] ? 0 : view->near_w) || c[0] > reach || c[0] < -reach ||
            c[1] > reach || c[1] < -reach)
            return 0;
    }
    return 1;
}

void gn_project_face(const gn_view *view, const gn_face *f, gn_outline *out)
{
    gn_face clipped[2];
    const gn_face *last = f;
    int to = 0;
    int planes = is_inside(view, f) ? 0 : GN_CLIP_PLANES;
    out->count = 0;
    for (int plane = 0; plane < planes && last->count >= 3; plane++) {
        /* nothing ends at the far plane, nor what an orthographic camera sees at the near plane: it is compared */
        if (plane == 1 || (plane == 0 && view->affine) || !is_cut(view, last, plane))
            continue;
        clip_face(view, last, &clipped[to], plane);
        last = &clipped[to];
        to ^= 1;
    }
    for (int32_t i = 0; last->count >= 3 && i < last->count; i++) {
        gn_place place = last->place[i];
        if (view->affine && last->infinite[i])
            continue; /* rounding left no direction */
        if (!view->affine)
            shorten(view, &place);
        gn_view_project_inside(view, &place, &out->v[out->count++]);
    }
}

gn_place gn_place_direction(const gn_view *view, const int32_t d[3])
{
    gn_wide sum[3];
    int32_t bits = -10000, parts = view->affine ? 2 : 3;
    gn_place p = {{0, 0, 0}};
    for (int i = 0; i < 3; i++) {
        const gn_row *row = &view->row[i];
        sum[i] = gn_widen(gn_multiply(row->m[0], d[0]) + gn_multiply(row->m[1], d[1]) + gn_multiply(row->m[2], d[2]),
                          -row->shift);
    }
    if (view->affine) {
        /* As if the view were turned by 2^-30, the rounding of its axes: two directions in one plane with the view, one
         * to either side of it, would be opposite on the screen, and rounding would choose the half that a side between
         * them covers. */
        gn_wide turned = sum[2];
        turned.e += view->row[2].shift - view->row[0].shift - 30;
        sum[0] = gn_wide_add(sum[0], turned);
        sum[1] = gn_wide_add(sum[1], gn_wide_multiply(turned, gn_widen(40503, -16)));
    }
    for (int i = 0; i < parts; i++)
        bits = gn_wide_bits(sum[i]) > bits ? gn_wide_bits(sum[i]) : bits;
    for (int i = 0; i < parts; i++)
        p.c[i] = gn_wide_round(sum[i], bits - (view->affine ? 40 : 29));
    return p;
}

void gn_set_corner(gn_corner *c, const gn_view *view, const gn_light *light, const int32_t world[3])
{
    (void)gn_view_place(view, world, &c->place);
    for (int i = 0; i < 3; i++) {
        c->world[i] = world[i];
        c->away[i] = light->kind == GN_SPOT ? world[i] - light->position[i] : light->forward[i];
    }
    c->direction = gn_place_direction(view, c->away);
}

void gn_add_corner(gn_face *f, const gn_place *place, uint8_t infinite)
{
    f->place[f->count] = *place;
    f->infinite[f->count++] = infinite;
}

void gn_make_side(gn_outline *o, const gn_view *view, const gn_light *light, const gn_corner *a, const gn_corner *b)
{
    gn_face f;
    f.count = 0;
    gn_add_corner(&f, &b->place, 0);
    gn_add_corner(&f, &a->place, 0);
    gn_add_corner(&f, &a->direction, 1);
    if (light->kind == GN_SPOT)
        gn_add_corner(&f, &b->direction, 1);
    gn_project_face(view, &f, o);
}

void gn_make_lid(gn_outline *o, const gn_view *view, const gn_place *axis, const gn_corner *a, const gn_corner *b)
{
    gn_face f;
    f.count = 0;
    gn_add_corner(&f, &b->direction, 1);
    gn_add_corner(&f, &a->direction, 1);
    gn_add_corner(&f, axis, 1);
    gn_project_face(view, &f, o);
}
