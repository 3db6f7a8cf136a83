/* The worst place of a mask: a small window of it, and beside it the difference from the truth. */
#ifndef PAGE_CROP_H
#define PAGE_CROP_H

#include "image.h"

enum { PAGE_CROP_WIDTH = 64, PAGE_CROP_HEIGHT = 48, PAGE_CROP_GAP = 2 };

typedef struct page_crop {
    uint32_t x, y, width, height; /* of the window in the mask */
    uint64_t wrong;               /* pixels in it: false shadow, false light */
    image picture;                /* the mask, a white gap, the difference (comparison_picture) */
} page_crop;

/* The window with the most wrong pixels, of such windows the highest one, then the leftmost. mask and truth (8-bit
 * grey): of one size. image_free() the picture. */
page_crop page_crop_make(const uint8_t *mask, const image *truth);

#endif
