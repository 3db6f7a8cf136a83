/* Bins: which triangles a band of regions has to look at.
 *
 * Each triangle goes into one bin: a bin of level k spans 2^k bands of regions and takes the triangles that span
 * 2^(k-1) + 1 to 2^k of them and start inside it; so a region reads two neighbouring bins a level. Memory: 4 bytes a
 * triangle and a bin, whatever the camera sees. */
#include "gn_clip.h"
#include "gn_context.h"

void gn_count_bins(const gn_plan *plan, const gn_settings *settings, uint32_t *bands, uint32_t *levels, uint32_t *bins)
{
    uint32_t n = ((uint32_t)settings->height + plan->region_height - 1) / plan->region_height;
    *bands = n;
    *levels = 0;
    *bins = 0;
    if (n == 1)
        return; /* one band: every triangle is looked at once anyway */
    uint32_t span;
    do {
        span = 1u << *levels;
        *bins += ((n - 1) >> *levels) + 1;
        ++*levels;
    } while (span < n);
}

/* The bin of screen rows [top, bottom). */
static int32_t bin_of_rows(const gn_context *context, int32_t top, int32_t bottom)
{
    if (top >= bottom || bottom <= 0 || top >= context->settings.height)
        return -1;
    top = top < 0 ? 0 : top;
    bottom = bottom > context->settings.height ? context->settings.height : bottom;
    uint32_t first = (uint32_t)top / context->plan.region_height;
    uint32_t last = (uint32_t)(bottom - 1) / context->plan.region_height, level = 0, bin = 0;
    while (last - first >= 1u << level) {
        bin += ((context->bands - 1) >> level) + 1;
        level++;
    }
    return (int32_t)(bin + (first >> level));
}

/* -1: not on the screen. */
static int32_t bin_of_triangle(const gn_context *context, const gn_view *view, uint32_t object_index, uint32_t triangle)
{
    const gn_object *object = &context->scene->objects[object_index];
    const gn_object_state *state = &context->objects[object_index];
    const gn_vertex *vertices = context->vertices + state->first_vertex;
    gn_window screen = {0, 0, context->settings.width, context->settings.height};
    uint32_t index[3];
    gn_triangle_indices(object->mesh, triangle, index);
    const gn_vertex *v0 = vertices + index[0], *v1 = vertices + index[1], *v2 = vertices + index[2];
    if (state->clips && (v0->depth == 0 || v1->depth == 0 || v2->depth == 0)) {
        gn_place corner[3];
        gn_polygon polygon;
        gn_triangle_places(view, object, triangle, corner);
        gn_clip_triangle(&polygon, view, corner);
        if (polygon.area == 0)
            return -1;
        int32_t top = polygon.v[0].y, bottom = top;
        for (int32_t i = 1; i < polygon.count; i++) {
            top = polygon.v[i].y < top ? polygon.v[i].y : top;
            bottom = polygon.v[i].y > bottom ? polygon.v[i].y : bottom;
        }
        return bin_of_rows(context, gn_first_centre(top), gn_first_centre(bottom));
    }
    gn_rows rows;
    int64_t area = gn_area(v0, v1, v2);
    if (area == 0 || !gn_find_rows(&rows, v0, area > 0 ? v1 : v2, area > 0 ? v2 : v1, &screen))
        return -1;
    return bin_of_rows(context, rows.row, rows.bottom);
}

/* Counting sort: count, sum up, then place from the back, so that each bin holds its triangles in order. */
gn_status gn_make_bins(gn_context *context, const gn_view *view)
{
    const gn_scene *scene = context->scene;
    uint32_t *first = context->bin_first, sum = 0;
    if (!context->bin_count)
        return GN_OK;
    for (uint32_t i = 0; i <= context->bin_count; i++)
        first[i] = 0;
    for (uint32_t o = 0; o < scene->object_count; o++) {
        for (uint32_t i = 0; i < scene->objects[o].mesh->triangle_count; i++) {
            int32_t bin = bin_of_triangle(context, view, o, i);
            if (bin >= 0)
                first[bin]++;
        }
    }
    for (uint32_t i = 0; i <= context->bin_count; i++) {
        sum += first[i];
        first[i] = sum;
    }
    for (uint32_t o = scene->object_count; o-- > 0;) {
        for (uint32_t i = scene->objects[o].mesh->triangle_count; i-- > 0;) {
            int32_t bin = bin_of_triangle(context, view, o, i);
            if (bin >= 0)
                context->bin_items[--first[bin]] = o << context->triangle_bits | i;
        }
    }
    return GN_OK;
}
