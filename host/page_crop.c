#include "page_crop.h"

#include "comparison.h"
#include "memory.h"

#include <stdlib.h>
#include <string.h>

/* The truth's values (comparison.h). */
enum { LIT_FROM = 127, NO_SURFACE = 255 };

static int is_wrong(uint8_t mask, uint8_t truth)
{
    return mask != NO_SURFACE && truth != NO_SURFACE && (mask >= LIT_FROM) != (truth >= LIT_FROM);
}

/* sums[y * (width + 1) + x]: wrong pixels above and to the left of the corner (x, y). */
static uint32_t *make_sums(const uint8_t *mask, const image *truth)
{
    const uint8_t *true_values = truth->samples;
    size_t stride = (size_t)truth->width + 1;
    uint32_t *sums = memory_take(stride * (truth->height + 1), sizeof *sums);
    for (uint32_t y = 0; y < truth->height; y++) {
        uint32_t in_row = 0;
        for (uint32_t x = 0; x < truth->width; x++) {
            size_t i = (size_t)y * truth->width + x;
            in_row += (uint32_t)is_wrong(mask[i], true_values[i]);
            sums[(y + 1) * stride + x + 1] = sums[y * stride + x + 1] + in_row;
        }
    }
    return sums;
}

static void find_worst(page_crop *c, const uint8_t *mask, const image *truth)
{
    size_t stride = (size_t)truth->width + 1;
    uint32_t *sums = make_sums(mask, truth);
    for (uint32_t y = 0; y + c->height <= truth->height; y++)
        for (uint32_t x = 0; x + c->width <= truth->width; x++) {
            const uint32_t *above = sums + y * stride + x, *below = above + c->height * stride;
            uint32_t wrong = below[c->width] - below[0] - above[c->width] + above[0];
            if (wrong > c->wrong) {
                c->wrong = wrong;
                c->x = x;
                c->y = y;
            }
        }
    free(sums);
}

/* Shadow grey, so that it differs from no surface, which is as in the difference; in steps of 4, so that a palette has
 * room for all. */
static void put_grey(uint8_t *to, uint8_t value)
{
    memset(to, value == NO_SURFACE ? 20 : value >= NO_SURFACE - 4 ? 255 : 64 + value * 3 / 4 / 4 * 4, 3);
}

static image draw(const page_crop *c, const uint8_t *mask, const image *difference)
{
    image im = image_make(2 * c->width + PAGE_CROP_GAP, c->height, 3, IMAGE_U8);
    for (uint32_t y = 0; y < c->height; y++) {
        uint8_t *to = (uint8_t *)im.samples + (size_t)3 * im.width * y;
        size_t from = (size_t)(c->y + y) * difference->width + c->x;
        for (uint32_t x = 0; x < c->width; x++, to += 3)
            put_grey(to, mask[from + x]);
        memset(to, 255, 3 * PAGE_CROP_GAP);
        memcpy(to + 3 * PAGE_CROP_GAP, (const uint8_t *)difference->samples + 3 * from, (size_t)3 * c->width);
    }
    return im;
}

page_crop page_crop_make(const uint8_t *mask, const image *truth)
{
    page_crop c = {.width = truth->width < PAGE_CROP_WIDTH ? truth->width : PAGE_CROP_WIDTH,
                   .height = truth->height < PAGE_CROP_HEIGHT ? truth->height : PAGE_CROP_HEIGHT};
    comparison_input input = {truth->width, truth->height, mask, truth->samples, 0, COMPARISON_EDGE_BAND};
    find_worst(&c, mask, truth);
    image difference = comparison_picture(&input);
    c.picture = draw(&c, mask, &difference);
    image_free(&difference);
    return c;
}
