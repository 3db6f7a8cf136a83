/* Looking at the triangles in a region's bins. */
#ifndef GN_BINS_H
#define GN_BINS_H

#include "gn_context.h"

typedef void gn_visit(void *state, uint32_t object, uint32_t triangle);

/* Call visit, an inline function, for every triangle that may cover a row of the window: two neighbouring bins a level,
 * or all triangles where the image is one band. */
GN_INLINE void gn_visit_region(const gn_context *context, const gn_window *window, gn_visit *visit, void *state)
{
    if (!context->bin_count) {
        for (uint32_t o = 0; o < context->scene->object_count; o++)
            for (uint32_t i = 0; i < context->scene->objects[o].mesh->triangle_count; i++)
                visit(state, o, i);
        return;
    }
    uint32_t band = (uint32_t)window->row0 / context->plan.region_height, first_bin = 0;
    uint32_t mask = ((uint32_t)1 << context->triangle_bits) - 1;
    for (uint32_t level = 0; level < context->bin_levels; level++) {
        uint32_t bin = band >> level, from = context->bin_first[first_bin + (bin ? bin - 1 : 0)];
        uint32_t to = context->bin_first[first_bin + bin + 1];
        for (uint32_t i = from; i < to; i++) {
            uint32_t identifier = context->bin_items[i];
            visit(state, identifier >> context->triangle_bits, identifier & mask);
        }
        first_bin += ((context->bands - 1) >> level) + 1;
    }
}

#endif
