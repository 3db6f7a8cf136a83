/* Depth ranges that span what the camera sees (settings.fit_depth), of directional lights with a fit.
 *
 * The light's box is as deep as what is seen, with a margin at both ends. Casters between it and the light are not cut
 * off: their depths are clamped at the near end, texel by texel, and so are those beyond the far end. What is seen
 * lies a margin behind a clamped caster, and so in its shadow.
 *
 * A triangle with a corner beyond an end is clipped at the guard band alone. Its plane, 64 bits wide, is that of its
 * unclamped corners, from the nearest one and cut by so many bits that 31 are left: where its texels lie within the
 * range they hold their own depths, and as a receiver it has the same plane, bit for bit. */
#include "gn_clip.h"
#include "gn_insert.h"
#include "gn_parameterisation.h"

/* ---- the range --------------------------------------------------------------------------------------------------- */

/* How far the eye is from the farther end of [low, high) along the light, world units; 0: its distance is no matter. */
static int64_t reach_of_eye(const gn_context *context, int32_t low, int32_t high)
{
    const gn_camera *camera = &context->camera;
    int64_t eye = 0;
    if (camera->projection != GN_PERSPECTIVE)
        return 0;
    for (int i = 0; i < 3; i++)
        eye += gn_multiply(context->light.forward[i], camera->eye[i]);
    eye = gn_floor_shift_64(eye, 30);
    int64_t before = eye - low, behind = high - eye;
    return before > behind ? before : behind;
}

/* Margin at both ends of a range, world units: 1/32 of it, as wide as four texels, which is what a plane at 45 degrees
 * rises within the texels that filters compare, and the bias. */
static int32_t find_margin(const gn_context *context, int32_t range)
{
    const gn_light *light = &context->light;
    uint32_t across = gn_divide((uint64_t)(uint32_t)light->box_width << 2, context->settings.map_width);
    uint32_t down = gn_divide((uint64_t)(uint32_t)light->box_height << 2, context->settings.map_height);
    uint32_t bias = (uint32_t)(gn_multiply_u(gn_make_bias(context, &context->settings.bias), (uint32_t)range) >> 32);
    return (range >> 5) + (int32_t)(across > down ? across : down) + (int32_t)bias + 2;
}

/* World units from the near end of a box to a depth in units of z, of which there are 2^32 - 2^16 in the box. */
static int32_t from_near_end(uint32_t z, int32_t depth)
{
    uint32_t units = z < 2 * GN_DEPTH_GUARD ? 0 : z - 2 * GN_DEPTH_GUARD;
    uint64_t product = gn_multiply_u(units, (uint32_t)depth); /* below 2^60; over 2^32 - 2^16 it is 2^-16 more */
    return (int32_t)((product + (product >> 16)) >> 32);
}

void gn_fit_depth(gn_context *context)
{
    gn_fitting *fitting = context->fitting;
    const gn_depth_extent *seen = &fitting->seen_depths;
    gn_light *light = &context->light;
    gn_view *view = &context->light_view;
    *light = fitting->light;
    fitting->box_depth = 0;
    if (light->kind != GN_DIRECTIONAL || seen->low > seen->high ||
        gn_make_fitted_view(view, light, &fitting->rectangle, GN_FINE, GN_FINE) != GN_OK)
        return;
    int32_t whole = light->box_depth, own_z = light->box_z;
    int32_t low = own_z + from_near_end(seen->low, whole), high = own_z + from_near_end(seen->high, whole) + 1;
    context->texels_across = (uint32_t)context->settings.map_width << 8;
    context->texels_down = (uint32_t)context->settings.map_height << 8;
    light->box_depth = high - low;
    int64_t depth = (int64_t)high - low + 2 * (int64_t)find_margin(context, high - low);
    /* not so small that Z needs more than 41 bits, or that a point's depth, good to 2^-18 of its distance from the eye,
     * errs by more than 2^-16 of the range */
    int64_t least = whole >> 10, far_off = reach_of_eye(context, low, high) >> 2;
    least = least < far_off ? far_off : least;
    depth = depth < least ? least : depth;
    depth = depth < 64 ? 64 : depth;
    if (depth >= whole)
        return;
    light->box_z = low - (((int32_t)depth - (high - low)) >> 1);
    light->box_depth = (int32_t)depth;
    if (gn_make_light_view(view, light, GN_FINE, GN_FINE) != GN_OK ||
        gn_make_shading(context, fitting->largest_w) != GN_OK)
        return;
    fitting->box_z = light->box_z;
    fitting->box_depth = light->box_depth;
}

/* ---- triangles --------------------------------------------------------------------------------------------------- */

static int make_clamped_plane(gn_wide_plane *plane, gn_polygon *polygon, const gn_view *view, const gn_place corner[3],
                              int64_t *error)
{
    gn_place place[3];
    int64_t nearest = corner[0].c[2], farthest = nearest;
    uint32_t shift = 0;
    for (int i = 1; i < 3; i++) {
        int64_t z = corner[i].c[2];
        nearest = z < nearest ? z : nearest;
        farthest = z > farthest ? z : farthest;
    }
    while ((farthest - nearest) >> shift >> 31)
        shift++;
    for (int i = 0; i < 3; i++) {
        place[i] = corner[i];
        place[i].c[2] = gn_floor_shift_64(corner[i].c[2] - nearest, shift);
    }
    gn_clip_triangle(polygon, view, place);
    *error = shift ? (int64_t)2 << shift : 0;
    if (polygon->area == 0)
        return 0;
    const gn_vertex *r1 = &polygon->v[polygon->reference], *r2 = r1 + 1;
    int turned = polygon->area < 0;
    int sheer = gn_make_far_plane(plane, &polygon->v[0], turned ? r2 : r1, turned ? r1 : r2, polygon->area, shift);
    plane->base += 2 * nearest;
    /* corners as warps of vertices alone take them */
    for (int32_t i = 0; i < polygon->count; i++) {
        int64_t z = nearest + ((int64_t)polygon->v[i].depth << shift);
        z = z < view->near_w ? view->near_w : z;
        polygon->v[i].depth = (uint32_t)(z > view->far_w ? view->far_w : z);
    }
    return sheer;
}

GN_INLINE void insert_span(const void *state, int32_t row, int32_t left, int32_t right)
{
    const gn_layer_target *t = state;
    GN_TALLY(t->tally->centres += (uint32_t)(right - left);)
    for (; left < right; left++)
        gn_insert_wide(t, row * t->stride + left, gn_wide_depth(&t->steep_plane, left, row), t->rise);
}

static void insert(const gn_context *context, gn_layer_target *t, const gn_object *object, uint32_t triangle,
                   int culled, const gn_window *window)
{
    gn_place corner[3];
    gn_polygon polygon;
    gn_rows rows;
    int64_t error;
    gn_triangle_places(&context->light_view, object, triangle, corner);
    (void)make_clamped_plane(&t->steep_plane, &polygon, &context->light_view, corner, &error);
    if (polygon.area == 0 || (polygon.area > 0 ? 1 : -1) == culled)
        return;
    t->rise = gn_saturate(gn_rise(t->steep_plane.dx, t->steep_plane.dy));
    t->steep = 1;
    for (int32_t i = 1; i + 1 < polygon.count; i++) {
        if (!gn_find_piece(&rows, &polygon, i, window))
            continue;
        GN_TALLY(t->tally->triangles++;)
        if (t->grid)
            t->grid->walk(t, &rows);
        else
            gn_walk(&rows, window, rows.cut, insert_span, t);
    }
    t->steep = 0;
}

/* ---- the light pass ---------------------------------------------------------------------------------------------- */

gn_status gn_use_fitted_depth(gn_context *context)
{
    gn_fitting *fitting = context->fitting;
    const gn_view *view = &context->light_view;
    context->light.box_z = fitting->box_z;
    context->light.box_depth = fitting->box_depth;
    gn_status status =
        gn_make_light_view(&context->light_view, &context->light, view->half_width >> 7, view->half_height >> 7);
    context->light_view.endless = 1;
    context->insert_clamped = insert;
    fitting->clamped_plane = make_clamped_plane;
    return status;
}
