/* The camera pass: region by region visibility, the shadow test, colours; then the region is flushed. */
#include "gn_cascade.h"

gn_status gn_camera_begin(gn_context *context, const gn_camera *camera)
{
    if (!context || !camera)
        return GN_BAD_ARGUMENT;
    if (context->volumes)
        return GN_UNSUPPORTED;
    if (context->point_light)
        return context->settings.faces->camera_begin(context, camera);
    if (context->phase < GN_PHASE_LIGHT)
        return GN_NOT_READY;
    for (uint32_t i = 0; i < context->plan.light_regions; i++)
        if (context->progress[i] != GN_REGION_DONE)
            return GN_NOT_READY;
    context->phase = GN_PHASE_CAMERA_FAILED; /* until all is well: the light pass's part is overwritten from here */
    int32_t largest_w;
    gn_status status = gn_begin_regions(context, camera, &largest_w);
    if (status == GN_OK)
        status = gn_make_shading(context, largest_w);
    if (status == GN_OK)
        status = gn_make_bins(context, &context->camera_view);
    if (status != GN_OK)
        return status;
    context->phase = GN_PHASE_CAMERA;
    return GN_OK;
}

gn_status gn_camera_region(gn_context *context, uint32_t region, uint32_t worker, void *colour, uint8_t *mask,
                           gn_pixels *pixels)
{
    gn_window window;
    gn_status status = gn_find_region(context, region, worker, GN_PHASE_CAMERA, &colour, mask, pixels, &window);
    if (status != GN_OK)
        return status;
    gn_worker *w = &context->workers[worker];
    uint32_t width = pixels->width;
    gn_rasterise_region(context, w, &window);
    const gn_receiver *receiver = context->settings.receiver;
    const gn_reconstruction *how = context->settings.reconstruction;
    gn_row_shader *cascade = how ? how->shade : receiver ? receiver->shade : 0;
    for (uint32_t row = 0; row < pixels->height; row++) {
        int32_t y = window.row0 + (int32_t)row;
        if (cascade)
            cascade(context, w, row * width, window.column0, y, (int32_t)width);
        else
            gn_shade_row(context, w->q + row * width, window.column0, y, (int32_t)width);
        gn_colour_region_row(context, w, colour, mask, row, width);
    }
    return GN_OK;
}

gn_status gn_camera_pass(gn_context *context, const gn_camera *camera, gn_flush flush, void *user)
{
    if (!flush)
        return GN_BAD_ARGUMENT;
    gn_status status = gn_camera_begin(context, camera);
    return status == GN_OK ? gn_flush_regions(context, gn_camera_region, flush, user) : status;
}
