/* The view pass: what the camera sees, seen from the light. Visibility region by region as in the camera pass, then
 * each visible point's place on the light's plane; sums of these are all that is kept. A round for the fit, then those
 * of the warp, whose places count within the fitted rectangle.
 *
 * Memory: what the camera pass needs for visibility, and the sums, in the place of the map, which is lost. */
#include "gn_around.h"
#include "gn_bins.h"
#include "gn_parameterisation.h"

/* What stands for neither receiver nor reconstruction: gn_shade.c knows nothing of fits and warps. */
static const gn_reconstruction nearest = {gn_cascade_row, gn_vote_nearest, 0, gn_colour_row, GN_DARK, 1, 0, 0, 0};

/* ---- planning ---------------------------------------------------------------------------------------------------- */

static gn_status check(const gn_settings *s)
{
    const gn_warp *warp = s->warp;
    if (s->smoothing && (s->smoothing < (1 << 10) || s->smoothing > (64 << 16)))
        return GN_OUT_OF_RANGE;
    if (s->fit_depth > 1)
        return GN_BAD_ARGUMENT;
    if (warp && warp->bent &&
        (s->reconstruction || s->surface == GN_SLOPE || (s->receiver && s->receiver->votes && !s->receiver->resample)))
        return GN_UNSUPPORTED;
    return GN_OK;
}

/* Bytes of the sums of one worker. */
static uint64_t count_sums(const gn_settings *s)
{
    uint64_t most = s->fit ? s->fit->round.bytes(s) : 0;
    for (int i = 0; s->warp && i < s->warp->round_count; i++) {
        uint64_t bytes = s->warp->rounds[i].bytes(s);
        most = bytes > most ? bytes : most;
    }
    most += s->fit && s->fit_depth ? sizeof(gn_depth_extent) : 0;
    return (most + GN_ALIGNMENT - 1) / GN_ALIGNMENT * GN_ALIGNMENT;
}

static gn_status make_view(gn_context *context);

static uint64_t lay_out_head(gn_context *context, uint64_t used, const gn_settings *s)
{
    uint8_t *base = (uint8_t *)context;
    gn_fitting *fitting = gn_take(base, &used, sizeof *fitting);
    uint16_t *tables = gn_take(base, &used, s->warp ? s->warp->table_bytes(s) : 0);
    if (context) {
        gn_fitting none = {0};
        *fitting = none;
        context->fitting = fitting;
        fitting->find_place = gn_find_place_on_plane;
        fitting->make_view = make_view;
        fitting->grid.width = s->map_width;
        fitting->grid.height = s->map_height;
        if (s->warp)
            s->warp->lay_out(context, tables);
        if (!s->receiver && !s->reconstruction)
            context->settings.reconstruction = &nearest;
    }
    return used;
}

/* The sums lie where the map will be, if that is large enough, else behind all else. */
static uint64_t lay_out_view(gn_context *context, const gn_plan *plan, const gn_settings *settings)
{
    gn_settings s = *settings;
    s.format = GN_NO_COLOUR;
    s.mask = 0;
    s.receiver = 0;
    s.reconstruction = 0;
    uint64_t used = gn_lay_out_camera(context, plan, &s), bytes = count_sums(&s);
    uint8_t *sums = context ? (uint8_t *)context->map : 0;
    if (bytes * s.workers > plan->map_bytes)
        sums = gn_take(context ? context->shared : 0, &used, bytes * s.workers);
    if (context) {
        context->fitting->sums = sums;
        context->fitting->sums_bytes = bytes;
    }
    return used;
}

static gn_status make_plan(gn_plan *plan, const gn_settings *s, uint64_t head)
{
    gn_status status = check(s);
    uint64_t bytes = head + lay_out_view(0, plan, s);
    if (status != GN_OK)
        return status;
    if (bytes > SIZE_MAX)
        return GN_TOO_MANY;
    plan->view_bytes = (size_t)bytes;
    plan->bytes = plan->view_bytes > plan->bytes ? plan->view_bytes : plan->bytes;
    plan->view_rounds = (uint8_t)((s->fit ? 1 : 0) + (s->warp ? s->warp->round_count : 0));
    plan->warp_bytes = s->warp ? (size_t)s->warp->table_bytes(s) : 0;
    return GN_OK;
}

static gn_status make_view(gn_context *context)
{
    gn_fitting *fitting = context->fitting;
    int32_t width = context->settings.map_width, height = context->settings.map_height;
    if (!fitting->seen)
        return GN_NOT_READY;
    if (context->light.kind == GN_SPOT) {
        context->texels_across =
            gn_divide((uint64_t)context->texels_across << 30, (uint32_t)fitting->rectangle.size[0]);
        context->texels_down = gn_divide((uint64_t)context->texels_down << 30, (uint32_t)fitting->rectangle.size[1]);
    }
    gn_status status = gn_make_fitted_view(&context->light_view, &context->light, &fitting->rectangle,
                                           context->grid ? GN_FINE : width, context->grid ? GN_FINE : height);
    context->insert_clamped = 0;
    return status == GN_OK && fitting->box_depth ? gn_use_fitted_depth(context) : status;
}

const gn_parameterisation gn_fit_and_warp = {make_plan, lay_out_head};

/* ---- rounds ------------------------------------------------------------------------------------------------------ */

static const gn_round *find_round(const gn_context *context)
{
    const gn_settings *s = &context->settings;
    uint32_t round = context->fitting->round;
    if (s->fit && round == 0)
        return &s->fit->round;
    return &s->warp->rounds[round - (s->fit ? 1 : 0)];
}

static uint8_t *sums_of(const gn_fitting *fitting, uint32_t worker)
{
    return fitting->sums + (size_t)(worker * fitting->sums_bytes);
}

/* Of fitted depth: behind all else that the fit's round sums up; 0 in other rounds. */
static gn_depth_extent *depths_of(const gn_context *context, uint32_t worker)
{
    if (!context->settings.fit_depth || !context->settings.fit || context->fitting->round)
        return 0;
    return (gn_depth_extent *)(void *)sums_of(context->fitting, worker + 1) - 1;
}

static void add_depths(gn_depth_extent *sum, uint32_t low, uint32_t high)
{
    sum->low = low < sum->low ? low : sum->low;
    sum->high = high > sum->high ? high : sum->high;
}

/* From the light's view of the rectangle to shading, and empty sums. */
static gn_status begin_round(gn_context *context)
{
    gn_fitting *fitting = context->fitting;
    context->light = fitting->light;
    gn_status status =
        gn_make_fitted_view(&context->light_view, &context->light, &fitting->rectangle, GN_FINE, GN_FINE);
    if (status != GN_OK)
        return status;
    context->light_trusted = GN_NOT_INSIDE;
    status = gn_make_shading(context, fitting->largest_w);
    for (uint32_t i = 0; status == GN_OK && i < context->settings.workers; i++) {
        gn_depth_extent none = {0xffffffffu, 0}, *depths = depths_of(context, i);
        find_round(context)->clear(&context->settings, sums_of(fitting, i));
        if (depths)
            *depths = none;
    }
    return status;
}

gn_status gn_view_begin(gn_context *context, const gn_camera *camera, const gn_light *light)
{
    if (!context || !camera || !light)
        return GN_BAD_ARGUMENT;
    gn_fitting *fitting = context->fitting;
    if (!fitting)
        return GN_UNSUPPORTED;
    context->phase = GN_PHASE_NONE;
    fitting->seen = 0;
    fitting->fitted = 0;
    fitting->box_depth = 0;
    fitting->round = 0;
    fitting->light = *light;
    (void)lay_out_view(context, &context->plan, &context->settings);
    context->camera = *camera;
    int inside;
    gn_status status = gn_make_light_view(&context->light_view, light, GN_FINE, GN_FINE);
    if (status == GN_OK)
        status = gn_make_camera_view(&context->camera_view, camera, context->settings.width, context->settings.height);
    if (status == GN_OK)
        status = gn_transform_scene(context, &context->camera_view, &fitting->largest_w, &inside);
    if (status == GN_OK)
        status = gn_make_bins(context, &context->camera_view);
    if (status != GN_OK)
        return status;
    gn_whole_plane(&fitting->rectangle, light);
    for (int i = 0; i < 2; i++) {
        fitting->reach[i] = context->settings.fit ? (uint32_t)fitting->rectangle.size[i] : GN_WHOLE;
        if (context->settings.fit) /* places count in one unit along both axes */
            fitting->rectangle.size[i] = GN_WHOLE;
    }
    status = begin_round(context);
    if (status == GN_OK)
        context->phase = GN_PHASE_VIEW;
    return status;
}

static void gather_row(const gn_context *context, gn_worker *worker, uint32_t number, uint32_t from, int32_t x,
                       int32_t y, int32_t count)
{
    void *sums = sums_of(context->fitting, number);
    gn_depth_extent *depths = depths_of(context, number);
    const gn_round *round = find_round(context);
    uint32_t *q = worker->q + from, w[GN_BLOCK], bits = gn_point_bits(context);
    const uint32_t *reach = context->fitting->reach;
    gn_points points;
    if (!context->camera_view.affine)
        gn_row_of_w(q, count, context->shading.w_shift);
    points.x = x;
    points.y = y;
    gn_start_points(context, &points);
    for (int32_t done = 0; done < count; done += GN_BLOCK, q += GN_BLOCK) {
        points.triangle = worker->triangle + from + done;
        points.x = x + done;
        points.count = count - done < GN_BLOCK ? count - done : GN_BLOCK;
        for (int32_t i = 0; context->light.kind == GN_SPOT && i < points.count; i++)
            w[i] = q[i]; /* finding a spot light's points changes q */
        gn_find_points(context, &points, q);
        for (int32_t i = 0; i < points.count; i++)
            if (points.triangle[i] == GN_NO_TRIANGLE || gn_share(points.u[i], bits) >= reach[0] ||
                gn_share(points.v[i], bits) >= reach[1])
                points.u[i] = GN_NOWHERE;
#if GN_STATISTICS
        for (int32_t i = 0; context->fitting->round == 0 && i < points.count; i++)
            worker->statistics.view_samples += points.u[i] != GN_NOWHERE;
#endif
        for (int32_t i = 0; depths && i < points.count; i++)
            if (points.u[i] != GN_NOWHERE)
                add_depths(depths, points.z[i], points.z[i]);
        round->add(context, sums, &points, context->light.kind == GN_SPOT ? w : q);
    }
}

gn_status gn_view_region(gn_context *context, uint32_t region, uint32_t worker)
{
    gn_window window;
    gn_pixels pixels;
    void *none = 0;
    if (context && !context->fitting)
        return GN_UNSUPPORTED;
    gn_status status = gn_find_region(context, region, worker, GN_PHASE_VIEW, &none, 0, &pixels, &window);
    if (status != GN_OK)
        return status;
    gn_worker *w = &context->workers[worker];
#if GN_STATISTICS
    gn_statistics before = w->statistics; /* these count the camera pass */
#endif
    gn_rasterise_region(context, w, &window);
    for (uint32_t row = 0; row < pixels.height; row++)
        gather_row(context, w, worker, row * pixels.width, window.column0, window.row0 + (int32_t)row, pixels.width);
#if GN_STATISTICS
    before.view_samples = w->statistics.view_samples;
    w->statistics = before;
#endif
    return GN_OK;
}

gn_status gn_view_end(gn_context *context)
{
    if (!context)
        return GN_BAD_ARGUMENT;
    gn_fitting *fitting = context->fitting;
    if (!fitting)
        return GN_UNSUPPORTED;
    if (context->phase != GN_PHASE_VIEW)
        return GN_NOT_READY;
    const gn_round *round = find_round(context);
    for (uint32_t i = 1; i < context->settings.workers; i++)
        round->merge(&context->settings, sums_of(fitting, 0), sums_of(fitting, i));
    gn_depth_extent *depths = depths_of(context, 0);
    for (uint32_t i = 1; depths && i < context->settings.workers; i++)
        add_depths(depths, depths_of(context, i)->low, depths_of(context, i)->high);
    if (depths)
        fitting->seen_depths = *depths;
    round->end(context, sums_of(fitting, 0));
    if (depths)
        gn_fit_depth(context);
    context->phase = GN_PHASE_NONE;
    fitting->round++;
    fitting->reach[0] = fitting->reach[1] = GN_WHOLE;
    if (fitting->round == context->plan.view_rounds) {
        fitting->seen = 1;
        return GN_OK;
    }
    gn_status status = begin_round(context);
    if (status == GN_OK)
        context->phase = GN_PHASE_VIEW;
    return status;
}

gn_status gn_view_pass(gn_context *context, const gn_camera *camera, const gn_light *light)
{
    gn_status status = gn_view_begin(context, camera, light);
    for (uint32_t round = 0; status == GN_OK && round < context->plan.view_rounds; round++) {
        for (uint32_t i = 0; status == GN_OK && i < context->plan.camera_regions; i++)
            status = gn_view_region(context, i, 0);
        if (status == GN_OK)
            status = gn_view_end(context);
    }
    return status;
}

/* ---- what was found ---------------------------------------------------------------------------------------------- */

gn_status gn_get_rectangle(const gn_context *context, gn_rectangle *rectangle)
{
    if (!context || !rectangle)
        return GN_BAD_ARGUMENT;
    if (!context->fitting)
        return GN_UNSUPPORTED;
    if (!context->fitting->seen)
        return GN_NOT_READY;
    *rectangle = context->fitting->rectangle;
    return GN_OK;
}

int gn_texel_place(const gn_context *context, uint32_t column, uint32_t row, uint32_t place[2])
{
    const gn_settings *s = &context->settings;
    if (!context->fitting || !context->fitting->seen || column >= s->map_width || row >= s->map_height)
        return 0;
    if (context->grid) {
        int32_t fine[2];
        gn_find_fine(context->grid, (int32_t)column, (int32_t)row, fine);
        for (int i = 0; i < 2; i++)
            place[i] = ((uint32_t)(2 * fine[i] + 1)) << (31 - GN_FINE_BITS);
        return 1;
    }
    place[0] = gn_divide((uint64_t)(2 * column + 1) << 31, s->map_width);
    place[1] = gn_divide((uint64_t)(2 * row + 1) << 31, s->map_height);
    return 1;
}
