/* What the pictures of maps share: depths as grey, and lines over them. */
#ifndef DEPTH_PICTURE_H
#define DEPTH_PICTURE_H

#include "gnomon.h"
#include "image.h"

typedef struct pixel {
    int32_t x, y;
} pixel;

/* 8-bit colour, a block of `block` x `block` pixels a depth: 224 the nearest of the map down to 32 the farthest, 0
 * where there is no surface. image_free() it. */
image depth_picture(const gn_depth *depths, uint32_t columns, uint32_t rows, uint32_t block);

/* Nothing where the pixel is not of the picture. */
void depth_picture_dot(image *im, pixel at, const uint8_t colour[3]);

/* Both ends included. Of two pixels as near to the line, the one towards its end. */
void depth_picture_line(image *im, pixel from, pixel to, const uint8_t colour[3]);

#endif
