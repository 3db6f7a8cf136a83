/* What a spot light adds to shadow volumes: triangles that its near plane cuts, its frustum, and its lid where an
 * orthographic camera looks at infinity. */
#include "gn_volumes.h"

/* ---- triangles that the near plane of a spot light cuts -------------------------------------------------------- */

/* The part beyond the plane, three or four corners. */
typedef struct cut {
    int32_t world[3][3]; /* of the whole triangle */
    gn_corner corners[4];
    int32_t count, winding;
} cut;

/* Where the edge crosses the plane: the same for both triangles on it. */
static void set_cut(gn_corner *c, const gn_view *view, const gn_corner *a, const gn_corner *b, int64_t da, int64_t db)
{
    c->place = gn_plane_crossing(view, &a->place, &b->place, da, db, GN_CLIP_PLANES);
    gn_wide to_a = gn_widen(da < 0 ? -da : da, 0), to_b = gn_widen(db < 0 ? -db : db, 0), sum[3];
    int32_t bits = 0;
    for (int i = 0; i < 3; i++) {
        sum[i] = gn_wide_add(gn_wide_multiply(gn_widen(a->away[i], 0), to_b),
                             gn_wide_multiply(gn_widen(b->away[i], 0), to_a));
        bits = gn_wide_bits(sum[i]) > bits ? gn_wide_bits(sum[i]) : bits;
    }
    for (int i = 0; i < 3; i++)
        c->away[i] = (int32_t)gn_wide_round(sum[i], bits - 30);
    c->direction = gn_place_direction(view, c->away);
}

static void find_cut(cut *out, const gn_context *context, const gn_object *object, uint32_t triangle)
{
    const gn_view *view = &context->volumes->view;
    const gn_light *light = &context->light;
    gn_corner corners[3];
    int64_t d[3];
    (void)gn_triangle_world(object, triangle, out->world);
    for (int i = 0; i < 3; i++) {
        gn_set_corner(&corners[i], view, light, out->world[i]);
        d[i] = gn_beyond_near(light, out->world[i]);
    }
    out->winding = gn_light_side(light, out->world);
    out->count = 0;
    for (int i = 0; i < 3; i++) {
        int next = i < 2 ? i + 1 : 0;
        if (d[i] >= 0)
            out->corners[out->count++] = corners[i];
        if ((d[i] > 0 && d[next] < 0) || (d[i] < 0 && d[next] > 0))
            set_cut(&out->corners[out->count++], view, &corners[i], &corners[next], d[i], d[next]);
    }
}

static void draw_cut_volume(gn_volume_region *r, uint32_t number, uint32_t triangle)
{
    const gn_eye *eye = &r->volumes->eye;
    gn_reach reach = gn_empty_reach();
    cut c = {.count = 0};
    gn_face cap;
    find_cut(&c, r->context, &r->context->scene->objects[number], triangle);
    cap.count = 0;
    for (int32_t i = 0; i < c.count; i++) {
        gn_add_corner(&cap, &c.corners[i].place, 0);
        gn_reach_ray(&reach, eye, c.corners[i].away);
    }
    for (int i = 0; i < 3; i++)
        gn_reach_point(&reach, eye, c.world[i]);
    gn_count_cap(r, &cap, number << r->context->triangle_bits | triangle, c.world, c.winding);
    r->target.own[0] = r->target.own[1] = GN_NO_TRIANGLE;
    for (int32_t i = 0; i < c.count; i++)
        gn_count_side(r, &c.corners[i], &c.corners[i + 1 < c.count ? i + 1 : 0], c.winding, &reach);
}

void gn_count_cut_volumes(gn_volume_region *r)
{
    const gn_scene *scene = r->context->scene;
    for (uint32_t o = 0; r->volumes->crossing && o < scene->object_count; o++)
        for (uint32_t t = 0; t < scene->objects[o].mesh->triangle_count; t++)
            if (gn_facing_of(r->volumes->facings, r->context->objects[o].first_triangle + t) == GN_CROSSES_NEAR)
                draw_cut_volume(r, o, t);
}

/* ---- the frustum of a spot light ------------------------------------------------------------------------------- */

/* m . P of one of its corners P: bit 0 right, bit 1 above, bit 2 far. |m| <= 2^30. */
static gn_wide along_corner(const int32_t m[3], const gn_light *light, int which)
{
    const int64_t n[3] = {m[0], m[1], m[2]};
    gn_wide tangent = gn_widen(light->tan_half, -24);
    gn_wide depth = gn_widen(which & 4 ? light->far_depth : light->near_depth, -30);
    gn_wide right = gn_wide_multiply(gn_wide_dot(n, light->right), tangent);
    gn_wide up = gn_wide_multiply(gn_wide_dot(n, light->up), tangent);
    gn_wide sum = gn_wide_add(gn_wide_dot(n, light->forward), which & 1 ? right : gn_wide_negate(right));
    sum = gn_wide_multiply(gn_wide_add(sum, which & 2 ? up : gn_wide_negate(up)), depth);
    return gn_wide_add(sum, gn_wide_dot(n, light->position));
}

static gn_place frustum_corner(const gn_view *view, const gn_light *light, int which)
{
    gn_place p;
    for (int i = 0; i < 3; i++) {
        const gn_row *row = &view->row[i];
        p.c[i] = gn_wide_round(gn_wide_add(along_corner(row->m, light, which), gn_widen(row->offset, 0)), row->shift);
    }
    return p;
}

/* How far it is along the camera's forward, in 2^-30 units. */
static gn_wide corner_depth(const gn_eye *eye, const gn_light *light, int which)
{
    int64_t at_eye = 0;
    for (int i = 0; i < 3; i++)
        at_eye += gn_multiply(eye->forward[i], eye->position[i]);
    return gn_wide_add(along_corner(eye->forward, light, which), gn_widen(-at_eye, 0));
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

void gn_count_frustum(gn_volume_region *r)
{
    static const uint8_t corners[6][4] = {{0, 1, 3, 2}, {6, 7, 5, 4}, {1, 5, 7, 3},
                                          {4, 0, 2, 6}, {2, 3, 7, 6}, {1, 0, 4, 5}};
    const gn_light *light = &r->context->light;
    const gn_view *view = &r->volumes->view;
    const gn_eye *eye = &r->volumes->eye;
    int32_t apart[3];
    r->target.own[0] = r->target.own[1] = GN_NO_TRIANGLE;
    for (int i = 0; i < 3; i++)
        apart[i] = light->position[i] - eye->position[i];
    for (int which = 0; which < 6; which++) {
        gn_face f;
        gn_outline o;
        gn_reach reach = gn_empty_reach();
        int64_t n[3], offset = frustum_plane(n, light, which);
        f.count = 0;
        for (int i = 0; i < 4; i++) {
            gn_place p = frustum_corner(view, light, corners[which][i]);
            gn_add_corner(&f, &p, 0);
            gn_reach_depth(&reach, eye, corner_depth(eye, light, corners[which][i]));
        }
        gn_project_face(view, &f, &o);
        gn_set_plane(&r->target, eye, n, gn_wide_add(gn_wide_dot(n, apart), gn_widen(offset, 0)), &reach);
        gn_count_outline(&r->target, &o, -GN_FRUSTUM_WINDING, r->window, GN_COMPARED);
    }
}

/* ---- the lid, seen by an orthographic camera ------------------------------------------------------------------- */

/* The way from p to q on the screen, by their directions as they are drawn: 1, -1, or 0. Products of 80 bits. */
static int turn(const gn_place *p, const gn_place *q)
{
    int64_t xh = gn_floor_shift_64(q->c[0], 20), xl = q->c[0] & 0xfffff;
    int64_t yh = gn_floor_shift_64(q->c[1], 20), yl = q->c[1] & 0xfffff;
    int64_t low = p->c[0] * yl - p->c[1] * xl, high = p->c[0] * yh - p->c[1] * xh + gn_floor_shift_64(low, 20);
    return high < 0 ? -1 : high > 0 || (low & 0xfffff) ? 1 : 0;
}

uint32_t gn_lid_along_view(const gn_context *context, const gn_corner *a, const gn_corner *b, int32_t winding)
{
    const int32_t *forward = context->camera.forward, *axis = context->light.forward;
    const gn_place *centre = &context->volumes->axis;
    int first = turn(&b->direction, &a->direction), second = turn(&a->direction, centre),
        third = turn(centre, &b->direction);
    if (first != second || second != third)
        return 0;
    int64_t along = 0; /* the cone, not its mirror image: all its directions go with the axis */
    for (int i = 0; i < 3; i++)
        along += gn_multiply(axis[i], forward[i]);
    return along > 0 ? (uint32_t)(first > 0 ? winding : -winding) : 0; /* y points down: clockwise turns away */
}

uint32_t gn_cut_lids_along_view(const gn_context *context)
{
    const gn_scene *scene = context->scene;
    uint32_t sum = 0;
    for (uint32_t o = 0; o < scene->object_count; o++)
        for (uint32_t t = 0; t < scene->objects[o].mesh->triangle_count; t++) {
            cut c = {.count = 0};
            if (gn_facing_of(context->volumes->facings, context->objects[o].first_triangle + t) != GN_CROSSES_NEAR)
                continue;
            find_cut(&c, context, &scene->objects[o], t);
            for (int32_t i = 0; i < c.count; i++)
                sum += gn_lid_along_view(context, &c.corners[i], &c.corners[i + 1 < c.count ? i + 1 : 0], c.winding);
        }
    return sum;
}
