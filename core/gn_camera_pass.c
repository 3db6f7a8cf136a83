/* The camera pass: region by region visibility, the shadow test, colours; then the region is flushed. */
#include "gn_context.h"

gn_status gn_camera_begin(gn_context *context, const gn_camera *camera)
{
    if (!context || !camera)
        return GN_BAD_ARGUMENT;
    if (context->phase == GN_PHASE_NONE)
        return GN_NOT_READY;
    for (uint32_t i = 0; i < context->plan.light_regions; i++)
        if (context->progress[i] != GN_REGION_DONE)
            return GN_NOT_READY;
    context->phase = GN_PHASE_CAMERA_FAILED; /* until all is well: the light pass's part is overwritten from here */
    gn_lay_out_camera(context, &context->plan, &context->settings);
    context->camera = *camera;
    int32_t largest_w;
    int inside;
    gn_status status =
        gn_make_camera_view(&context->camera_view, camera, context->settings.width, context->settings.height);
    if (status == GN_OK)
        status = gn_transform_scene(context, &context->camera_view, &largest_w, &inside);
    if (status == GN_OK)
        status = gn_make_shading(context, largest_w);
    if (status == GN_OK)
        status = gn_make_bins(context);
    if (status != GN_OK)
        return status;
    for (uint32_t i = 0; i < context->settings.workers; i++)
        gn_clear_colours(&context->workers[i]);
    context->phase = GN_PHASE_CAMERA;
    return GN_OK;
}

gn_status gn_camera_region(gn_context *context, uint32_t region, uint32_t worker, void *colour, uint8_t *mask,
                           gn_pixels *pixels)
{
    if (!context || !pixels || worker >= context->settings.workers || region >= context->plan.camera_regions)
        return GN_BAD_ARGUMENT;
    if (context->phase != GN_PHASE_CAMERA)
        return GN_NOT_READY;
    const gn_settings *settings = &context->settings;
    uint32_t columns = ((uint32_t)settings->width + context->plan.region_width - 1) / context->plan.region_width;
    uint32_t x = region % columns * context->plan.region_width, y = region / columns * context->plan.region_height;
    uint32_t width = settings->width - x, height = settings->height - y;
    width = width > context->plan.region_width ? context->plan.region_width : width;
    height = height > context->plan.region_height ? context->plan.region_height : height;

    gn_worker *w = &context->workers[worker];
    gn_window window = {(int32_t)x, (int32_t)y, (int32_t)(x + width), (int32_t)(y + height)};
    uint32_t pixel_bytes = settings->format == GN_RGB888 ? 3 : 2;
    if (settings->format == GN_NO_COLOUR)
        colour = 0;
    if (settings->format == GN_RGB565 && (uintptr_t)colour % 2)
        return GN_MISALIGNED;
    gn_rasterise_region(context, w, &window);
    for (uint32_t row = 0; row < height; row++) {
        uint32_t *q = w->q + row * width, tested = 0;
        gn_shade_row(context, q, (int32_t)x, (int32_t)(y + row), (int32_t)width);
        uint32_t seen = gn_colour_row(context, w, q, w->triangle + row * width, (int32_t)width,
                                      colour ? (uint8_t *)colour + (size_t)row * width * pixel_bytes : 0,
                                      mask ? mask + row * width : 0, &tested);
#if GN_STATISTICS
        w->statistics.pixels_shaded += seen;
        w->statistics.pixels_tested += tested;
#else
        (void)seen;
#endif
    }
    pixels->x = (uint16_t)x;
    pixels->y = (uint16_t)y;
    pixels->width = (uint16_t)width;
    pixels->height = (uint16_t)height;
    pixels->colour = colour;
    pixels->mask = mask;
    return GN_OK;
}

gn_status gn_camera_pass(gn_context *context, const gn_camera *camera, gn_flush flush, void *user)
{
    if (!flush)
        return GN_BAD_ARGUMENT;
    gn_status status = gn_camera_begin(context, camera);
    for (uint32_t i = 0; status == GN_OK && i < context->plan.camera_regions; i++) {
        gn_pixels pixels;
        status = gn_camera_region(context, i, 0, context->colour_buffer, context->mask_buffer, &pixels);
        if (status == GN_OK && flush(user, &pixels))
            status = GN_STOPPED;
    }
    return status;
}
