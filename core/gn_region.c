/* Regions of the image: where they lie, and what is written of them. Shared by shadow maps and shadow volumes. */
#include "gn_cascade.h"

gn_status gn_begin_regions(gn_context *context, const gn_camera *camera, int32_t *largest_w)
{
    int inside;
    gn_lay_out_camera(context, &context->plan, &context->settings);
    context->camera = *camera;
    gn_status status =
        gn_make_camera_view(&context->camera_view, camera, context->settings.width, context->settings.height);
    if (status == GN_OK)
        status = gn_transform_scene(context, &context->camera_view, largest_w, &inside);
    for (uint32_t i = 0; i < context->settings.workers; i++) {
        gn_worker *worker = &context->workers[i];
        gn_clear_colours(worker);
        for (uint32_t p = 0; worker->planes && p < GN_COLOUR_CACHE; p++)
            worker->planes[p].triangle = GN_NO_TRIANGLE;
    }
    return status;
}

gn_status gn_find_region(const gn_context *context, uint32_t region, uint32_t worker, gn_phase phase, void **colour,
                         uint8_t *mask, gn_pixels *pixels, gn_window *window)
{
    if (!context || !pixels || worker >= context->settings.workers || region >= context->plan.camera_regions)
        return GN_BAD_ARGUMENT;
    if (context->phase != phase)
        return GN_NOT_READY;
    const gn_settings *settings = &context->settings;
    const gn_plan *plan = &context->plan;
    uint32_t columns = ((uint32_t)settings->width + plan->region_width - 1) / plan->region_width;
    uint32_t x = region % columns * plan->region_width, y = region / columns * plan->region_height;
    uint32_t width = settings->width - x, height = settings->height - y;
    width = width > plan->region_width ? plan->region_width : width;
    height = height > plan->region_height ? plan->region_height : height;
    if (settings->format == GN_NO_COLOUR)
        *colour = 0;
    if (settings->format == GN_RGB565 && (uintptr_t)*colour % 2)
        return GN_MISALIGNED;
    pixels->x = (uint16_t)x;
    pixels->y = (uint16_t)y;
    pixels->width = (uint16_t)width;
    pixels->height = (uint16_t)height;
    pixels->colour = *colour;
    pixels->mask = mask;
    window->column0 = (int32_t)x;
    window->row0 = (int32_t)y;
    window->column1 = (int32_t)(x + width);
    window->row1 = (int32_t)(y + height);
    return GN_OK;
}

void gn_colour_region_row(const gn_context *context, gn_worker *worker, void *colour, uint8_t *mask, uint32_t row,
                          uint32_t width)
{
    const gn_reconstruction *how = context->settings.reconstruction;
    gn_colour_shader *shade = how ? how->colour : gn_colour_row;
    uint32_t from = row * width, pixel_bytes = context->settings.format == GN_RGB888 ? 3 : 2, tested = 0;
    uint32_t seen = shade(context, worker, worker->q + from, worker->triangle + from, (int32_t)width,
                          colour ? (uint8_t *)colour + (size_t)from * pixel_bytes : 0, mask ? mask + from : 0, &tested);
#if GN_STATISTICS
    worker->statistics.pixels_shaded += seen;
    worker->statistics.pixels_tested += tested;
#else
    (void)seen;
#endif
}
