#include "gn_clip.h"

int64_t gn_plane_distance(const gn_view *view, const gn_place *p, int plane)
{
    int64_t w = p->c[2];
    if (plane < 2 && view->endless && (view->affine || plane == 1))
        return 1;
    if (plane == 0)
        return w - view->near_w;
    if (plane == 1)
        return view->far_w - w;
    int64_t reach = view->affine ? GN_MAX_COORDINATE : view->guard * w;
    int64_t c = p->c[(plane - 2) >> 1];
    return plane & 1 ? reach + c : reach - c;
}

static int precedes(const gn_place *a, const gn_place *b)
{
    for (int i = 0; i < 3; i++)
        if (a->c[i] != b->c[i])
            return a->c[i] < b->c[i];
    return 0;
}

gn_place gn_plane_crossing(const gn_view *view, const gn_place *a, const gn_place *b, int64_t da, int64_t db, int plane)
{
    if (precedes(b, a)) {
        const gn_place *p = a;
        int64_t d = da;
        a = b, b = p;
        da = db, db = d;
    }
    uint64_t from_a = (uint64_t)(da < 0 ? -da : da), from_b = (uint64_t)(db < 0 ? -db : db);
    while ((from_a + from_b) >> 31) {
        from_a >>= 1;
        from_b >>= 1;
    }
    uint32_t t = gn_divide(from_a << 32, (uint32_t)(from_a + from_b) + 1); /* t / 2^32 of the way from a to b */
    gn_place p;
    for (int i = 0; i < 3; i++) {
        int64_t apart = b->c[i] - a->c[i], high = gn_floor_shift_64(apart, 16), low = apart & 0xffff;
        p.c[i] = a->c[i] + gn_floor_shift_64(high * t + gn_floor_shift_64(low * t, 16), 16);
    }
    if (plane == 0)
        p.c[2] = view->near_w;
    if (plane == 1)
        p.c[2] = view->far_w;
    return p;
}

static int32_t clip_at(const gn_view *view, const gn_place *in, int32_t count, gn_place *out, int plane)
{
    int32_t n = 0;
    for (int32_t i = 0; i < count; i++) {
        const gn_place *a = &in[i], *b = &in[i + 1 < count ? i + 1 : 0];
        int64_t da = gn_plane_distance(view, a, plane), db = gn_plane_distance(view, b, plane);
        /* A convex polygon gains at most one vertex a plane; rounding must not make it more. */
        if (da >= 0 && n < GN_CLIP_VERTICES)
            out[n++] = *a;
        if (((da > 0 && db < 0) || (da < 0 && db > 0)) && n < GN_CLIP_VERTICES)
            out[n++] = gn_plane_crossing(view, a, b, da, db, plane);
    }
    return n;
}

void gn_clip_triangle(gn_polygon *polygon, const gn_view *view, const gn_place corner[3])
{
    gn_place buffer[2][GN_CLIP_VERTICES];
    int32_t count = 3, from = 0;
    polygon->count = 0;
    polygon->area = 0;
    polygon->reference = 1;
    for (int i = 0; i < 3; i++)
        buffer[0][i] = corner[i];
    for (int plane = 0; plane < GN_CLIP_PLANES && count >= 3; plane++, from ^= 1)
        count = clip_at(view, buffer[from], count, buffer[from ^ 1], plane);
    if (count < 3)
        return;
    for (int32_t i = 0; i < count; i++)
        gn_view_project_inside(view, &buffer[from][i], &polygon->v[i]);
    polygon->count = count;
    for (int32_t i = 1; i + 1 < count; i++) {
        int64_t area = gn_area(&polygon->v[0], &polygon->v[i], &polygon->v[i + 1]);
        int64_t largest = polygon->area < 0 ? -polygon->area : polygon->area;
        if ((area < 0 ? -area : area) > largest) {
            polygon->area = area;
            polygon->reference = i;
        }
    }
}

int gn_find_piece(gn_rows *rows, const gn_polygon *polygon, int32_t i, const gn_window *window)
{
    const gn_vertex *v = polygon->v;
    int64_t area = gn_area(&v[0], &v[i], &v[i + 1]);
    if (area == 0 || (area > 0) != (polygon->area > 0))
        return 0;
    return gn_find_rows(rows, &v[0], area > 0 ? &v[i] : &v[i + 1], area > 0 ? &v[i + 1] : &v[i], window);
}

static void fit_depth_plane(gn_depth_plane *plane, const gn_polygon *polygon)
{
    const gn_vertex *v = polygon->v;
    const int64_t least = GN_DEPTH_GUARD, most = ((int64_t)1 << 32) - GN_DEPTH_GUARD;
    int64_t low = most, high = least;
    uint32_t farthest = 0;
    for (int32_t i = 0; i < polygon->count; i++) {
        int64_t z = 2 * (int64_t)v[0].depth;
        if (plane->dx | plane->dy)
            z += gn_floor_shift_64(
                gn_multiply(v[i].x - v[0].x, (int32_t)plane->dx) + gn_multiply(v[i].y - v[0].y, (int32_t)plane->dy), 8);
        low = z < low ? z : low;
        high = z > high ? z : high;
        farthest = v[i].depth > farthest ? v[i].depth : farthest;
    }
    if (high - low > most - least) {
        plane->dx = plane->dy = 0;
        plane->base = 2 * farthest;
    } else if (low < least) {
        plane->base += (uint32_t)(least - low);
    } else if (high > most) {
        plane->base -= (uint32_t)(high - most);
    }
}

void gn_make_clipped_plane(gn_depth_plane *plane, const gn_polygon *polygon)
{
    const gn_vertex *v = polygon->v, *r1 = &v[polygon->reference], *r2 = r1 + 1;
    (void)gn_make_depth_plane(plane, &v[0], polygon->area > 0 ? r1 : r2, polygon->area > 0 ? r2 : r1, polygon->area);
    fit_depth_plane(plane, polygon);
}

void gn_fit_q_plane(gn_q_plane *plane, const gn_polygon *polygon, uint32_t least)
{
    const gn_vertex *v = polygon->v;
    /* gradients with 10 fraction bits a pixel: products below 2^62 */
    int64_t gx = gn_floor_shift_64((int64_t)plane->dx, 22), gy = gn_floor_shift_64((int64_t)plane->dy, 22);
    int64_t low = v[0].depth, high = low, plane_low = low, plane_high = low;
    for (int32_t i = 1; i < polygon->count; i++) {
        int64_t depth = v[i].depth;
        int64_t q = v[0].depth + gn_floor_shift_64((v[i].x - v[0].x) * gx + (v[i].y - v[0].y) * gy, 18);
        low = depth < low ? depth : low;
        high = depth > high ? depth : high;
        plane_low = q < plane_low ? q : plane_low;
        plane_high = q > plane_high ? q : plane_high;
    }
    int64_t margin = gn_floor_shift_64(high - low, 4) + 256;
    if (plane_low < low - margin || plane_high > high + margin) {
        plane->dx = plane->dy = 0;
        plane->base = (uint64_t)low << 32;
    } else if (plane_low < least) {
        plane->base += (uint64_t)(least - plane_low) << 32;
    }
}
