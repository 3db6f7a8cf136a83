/* Shadow volumes (Crow 1977): the sample-exact method, without a map.
 *
 * Every triangle that the light does not see edge-on casts a volume: itself (the cap), a side over each of its edges,
 * away from the light to infinity, and for a spot light a lid at infinity. A pixel's point is shadowed where a volume
 * holds it. Sides of neighbours that face the light alike cancel, so sides are drawn over silhouette edges only, with
 * their winding (gn_silhouette.h); caps are all triangles, closed or open, so neither a camera nor a light inside a
 * solid, nor a solid inside out, is a special case. The frustum of a spot light is one more volume, of a great
 * negative winding, and a pixel's count then begins with it: what lies outside is shadowed.
 *
 * Counting is z-fail: faces behind the visible point, +1 where they turn away from the camera, -1 where they turn to
 * it; what the near plane cuts off is before every point and never missed. Nothing is cut at the far plane. A cap is
 * behind the visible point of every pixel that it covers, or is the point's own triangle: no comparison (but with the
 * near plane of an orthographic camera, which cuts nothing here). A lid is at infinity: no comparison. It is drawn as a
 * fan from the light's axis over the silhouette edges.
 * Sides compare nearness (gn_nearness.h), held to the range of their corners: of the point, on its triangle's plane,
 * and of the side. A side over an edge of the point's own triangle is always behind: it lies on the other side of the
 * triangle's plane from light and camera. (Without that rule a pixel that snapping has moved past the edge could find
 * the two planes in the wrong order.) Coverage is that of the snapped corners, the same for both faces at an edge:
 * counts are closed.
 *
 * Memory: per pixel of a region and worker 10 bytes beside visibility's 8. Counts are modulo 2^16: 16,384 volumes
 * may hold a point. Cost: a side is set up once for every region that its rows touch. */
#include "gn_volumes.h"

#include "gn_bins.h"

/* The rows that an outline covers, added to those of a silhouette. */
static void add_rows(gn_silhouette *s, const gn_outline *o, int32_t height)
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

/* A silhouette's edge in the world. */
static int32_t find_edge(const gn_context *context, const gn_silhouette *s, int32_t world[2][3], uint32_t own[2])
{
    const gn_volumes *volumes = context->volumes;
    uint32_t number = s->edge >> volumes->edge_bits, ends[2];
    const gn_object *object = &context->scene->objects[number];
    const gn_mesh_edge *edge = &object->mesh->edges[s->edge & (((uint32_t)1 << volumes->edge_bits) - 1)];
    const gn_object_state *state = &context->objects[number];
    int32_t winding = gn_edge_winding(object->mesh, edge, volumes->facings, state->first_triangle, ends);
    (void)gn_world_position(object, ends[0], world[0]);
    (void)gn_world_position(object, ends[1], world[1]);
    uint32_t first = edge->half[0] / 3, second = (edge->half[1] & ~GN_SAME_DIRECTION) / 3;
    second = edge->half[1] == GN_NO_HALF_EDGE ? first : second;
    own[0] = number << context->triangle_bits | first;
    own[1] = number << context->triangle_bits | second;
    /* a neighbour that casts on its own has a side here, too: the two must find the same pixels */
    if (gn_facing_of(volumes->facings, first + state->first_triangle) == GN_CROSSES_NEAR ||
        gn_facing_of(volumes->facings, second + state->first_triangle) == GN_CROSSES_NEAR)
        own[0] = own[1] = GN_NO_TRIANGLE;
    return winding;
}

void gn_count_side(gn_volume_region *r, const gn_corner *a, const gn_corner *b, int32_t winding, const gn_reach *reach)
{
    const gn_light *light = &r->context->light;
    const gn_view *view = &r->volumes->view;
    const gn_eye *eye = &r->volumes->eye;
    int spot = light->kind == GN_SPOT;
    int32_t along[3], apart[3];
    int64_t n[3];
    gn_outline o;
    for (int i = 0; i < 3; i++) {
        along[i] = spot ? b->away[i] : b->world[i] - a->world[i];
        apart[i] = (spot ? light->position[i] : a->world[i]) - eye->position[i];
    }
    gn_cross(n, a->away, along);
    gn_make_side(&o, view, light, a, b);
    gn_set_plane(&r->target, eye, n, gn_wide_dot(n, apart), reach);
    gn_count_outline(&r->target, &o, winding, r->window, GN_COMPARED);
    if (!spot || view->affine)
        return;
    gn_make_lid(&o, view, &r->volumes->axis, a, b);
    gn_count_outline(&r->target, &o, winding, r->window, GN_BEHIND);
}

static GN_NOINLINE void draw_silhouette(gn_volume_region *r, const gn_silhouette *s)
{
    int32_t world[2][3];
    gn_corner ends[2];
    gn_reach reach = gn_empty_reach();
    int32_t winding = find_edge(r->context, s, world, r->target.own);
    for (int i = 0; i < 2; i++) {
        gn_set_corner(&ends[i], &r->volumes->view, &r->context->light, world[i]);
        gn_reach_point(&reach, &r->volumes->eye, world[i]);
        gn_reach_ray(&reach, &r->volumes->eye, ends[i].away);
    }
    gn_count_side(r, &ends[0], &ends[1], winding, &reach);
}

static void draw_silhouettes(gn_volume_region *r)
{
    const gn_silhouette *s = r->volumes->silhouettes, *end = s + r->volumes->silhouette_count;
    int32_t first = r->window->row0, last = r->window->row1 - 1;
    for (; s != end; s++)
        if (s->first_row <= last && s->last_row >= first)
            draw_silhouette(r, s);
}

/* ---- caps ------------------------------------------------------------------------------------------------------ */

void gn_count_cap(gn_volume_region *r, gn_face *cap, uint32_t identifier, int32_t world[3][3], int32_t winding)
{
    const gn_eye *eye = &r->volumes->eye;
    gn_outline o;
    gn_project_face(&r->volumes->view, cap, &o);
    if (eye->perspective) {
        gn_count_outline(&r->target, &o, winding, r->window, GN_BEHIND);
        return;
    }
    gn_reach reach = gn_empty_reach();
    int32_t apart[3];
    int64_t n[3];
    for (int i = 0; i < 3; i++) {
        gn_reach_point(&reach, eye, world[i]);
        apart[i] = world[0][i] - eye->position[i];
    }
    gn_normal(n, world);
    gn_set_plane(&r->target, eye, n, gn_wide_dot(n, apart), &reach);
    r->target.own[0] = identifier;
    r->target.limit = 1 - r->context->camera.near_depth * ((int64_t)1 << 32);
    gn_count_outline(&r->target, &o, winding, r->window, GN_BEYOND);
}

static GN_NOINLINE void draw_clipped_cap(gn_volume_region *r, uint32_t number, uint32_t triangle, int32_t winding)
{
    int32_t world[3][3];
    gn_face cap;
    cap.count = 0;
    (void)gn_triangle_world(&r->context->scene->objects[number], triangle, world);
    for (int i = 0; i < 3; i++) {
        gn_place place;
        (void)gn_view_place(&r->volumes->view, world[i], &place);
        gn_add_corner(&cap, &place, 0);
    }
    gn_count_cap(r, &cap, number << r->context->triangle_bits | triangle, world, winding);
}

GN_INLINE void draw_cap(void *user, uint32_t number, uint32_t triangle)
{
    gn_volume_region *r = user;
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
        draw_clipped_cap(r, number, triangle, winding);
    else
        gn_count_piece(&r->target, v0, v1, v2, winding, r->window, GN_BEHIND);
}

static GN_NOINLINE void draw_caps(gn_volume_region *r)
{
    gn_visit_region(r->context, r->window, draw_cap, r);
}

/* ---- the visible points ---------------------------------------------------------------------------------------- */

static GN_NOINLINE void set_seen_plane(const gn_context *context, gn_seen_plane *seen, uint32_t identifier)
{
    const gn_eye *eye = &context->volumes->eye;
    int32_t world[3][3], apart[3];
    int64_t n[3];
    seen->triangle = identifier;
    seen->counts = 0;
    if (identifier == GN_NO_TRIANGLE)
        return;
    const gn_object *object = &context->scene->objects[identifier >> context->triangle_bits];
    (void)gn_triangle_world(object, identifier & (((uint32_t)1 << context->triangle_bits) - 1), world);
    gn_normal(n, world);
    if (!gn_seen_lit(context, n, world[0]))
        return;
    seen->counts = 1;
    seen->reach = gn_empty_reach();
    for (int i = 0; i < 3; i++) {
        gn_reach_point(&seen->reach, eye, world[i]);
        apart[i] = world[0][i] - eye->position[i];
    }
    gn_make_nearness(&seen->plane, eye, n, gn_wide_dot(n, apart));
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
        value = gn_clamp(value, gn_floor_shift_64(seen->reach.low, shift), gn_floor_shift_64(seen->reach.high, shift));
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
    context->phase = GN_PHASE_NONE;
    context->light = *light;
    if (light->kind != GN_SPOT && light->kind != GN_DIRECTIONAL)
        return light->kind == GN_POINT ? GN_UNSUPPORTED : GN_BAD_ARGUMENT;
    gn_status status = GN_OK;
    if (light->kind == GN_SPOT)
        status =
            gn_make_light_view(&context->light_view, light, context->settings.map_width, context->settings.map_height);
    for (int i = 0; i < 3; i++)
        if (light->forward[i] > (1 << 30) + 16 || light->forward[i] < -(1 << 30) - 16)
            status = GN_OUT_OF_RANGE;
    if (status == GN_OK)
        status = gn_find_facings(context->scene, light, volumes->facings, &volumes->crossing);
    if (status == GN_OK)
        status = gn_list_silhouettes(context->scene, volumes->facings, volumes->edge_bits, volumes->silhouettes,
                                     &volumes->silhouette_count);
    if (status != GN_OK)
        return status;
    context->tan_squared = (uint32_t)(gn_multiply_u(light->tan_half, light->tan_half) >> 29);
    context->phase = GN_PHASE_VOLUMES_LIGHT;
    return GN_OK;
}

/* Rows of every silhouette's faces. */
static void find_rows(gn_context *context)
{
    gn_volumes *volumes = context->volumes;
    const gn_light *light = &context->light;
    volumes->axis = gn_place_direction(&volumes->view, light->forward);
    volumes->outside = light->kind == GN_SPOT ? GN_FRUSTUM_WINDING : 0;
    if (light->kind == GN_SPOT && volumes->view.affine && volumes->crossing)
        volumes->outside = (uint16_t)(volumes->outside + gn_cut_lids_along_view(context));
    for (uint32_t i = 0; i < volumes->silhouette_count; i++) {
        gn_silhouette *s = &volumes->silhouettes[i];
        int32_t world[2][3];
        uint32_t own[2];
        gn_corner ends[2];
        gn_outline o;
        s->first_row = 0xffff;
        s->last_row = 0;
        int32_t winding = find_edge(context, s, world, own);
        for (int k = 0; k < 2; k++)
            gn_set_corner(&ends[k], &volumes->view, light, world[k]);
        gn_make_side(&o, &volumes->view, light, &ends[0], &ends[1]);
        add_rows(s, &o, context->settings.height);
        if (light->kind != GN_SPOT)
            continue;
        if (volumes->view.affine) {
            volumes->outside = (uint16_t)(volumes->outside + gn_lid_along_view(context, &ends[0], &ends[1], winding));
            continue;
        }
        gn_make_lid(&o, &volumes->view, &volumes->axis, &ends[0], &ends[1]);
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
    int32_t largest_w;
    gn_status status = gn_begin_regions(context, camera, &largest_w);
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
    for (uint32_t i = 0; i < context->settings.workers; i++)
        for (uint32_t k = 0; k < GN_COLOUR_CACHE; k++)
            volumes->workers[i].planes[k].triangle = GN_NO_TRIANGLE;
    context->phase = GN_PHASE_VOLUMES;
    return GN_OK;
}

static void count_volumes(gn_context *context, uint32_t worker, const gn_window *window)
{
    gn_volumes *volumes = context->volumes;
    gn_volumes_worker *w = &volumes->workers[worker];
    gn_volume_region r;
    r.context = context;
    r.volumes = volumes;
    r.window = window;
    r.target.count = w->count;
    r.target.point = w->point;
    r.target.triangle = context->workers[worker].triangle;
    r.target.stride = window->column1 - window->column0;
    r.target.row0 = window->row0;
    r.target.column0 = window->column0;
    GN_TALLY(gn_tally tally = {0}; r.target.tally = &tally;)
    for (int32_t i = 0; i < r.target.stride * (window->row1 - window->row0); i++)
        w->count[i] = volumes->outside;
    draw_caps(&r);
    draw_silhouettes(&r);
    gn_count_cut_volumes(&r);
    if (context->light.kind == GN_SPOT)
        gn_count_frustum(&r);
    GN_TALLY(context->workers[worker].statistics.volume_faces += tally.triangles;)
    GN_TALLY(context->workers[worker].statistics.volume_fragments += gn_tally_centres(&tally);)
}

gn_status gn_volumes_region(gn_context *context, uint32_t number, uint32_t worker, void *colour, uint8_t *mask,
                            gn_pixels *pixels)
{
    gn_window window;
    gn_status status = gn_find_region(context, number, worker, GN_PHASE_VOLUMES, &colour, mask, pixels, &window);
    if (status != GN_OK)
        return status;
    gn_worker *w = &context->workers[worker];
    gn_volumes_worker *v = &context->volumes->workers[worker];
    int32_t width = pixels->width;
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
    return status == GN_OK ? gn_flush_regions(context, gn_volumes_region, flush, user) : status;
}
