/* Images inside of a page, as data: URIs. */
#ifndef PAGE_PICTURE_H
#define PAGE_PICTURE_H

#include "image.h"

#include <stdio.h>

/* PNG where OpenImageIO is there, else BMP, which every browser shows and which needs no compression: of up to 256
 * colours a byte a pixel, else three. im: 8 bits, three channels. beside: a file in whose folder a temporary one is
 * written. 0, or -1 and the problem. */
int page_picture_write(FILE *stream, const image *im, const char *beside, problem *why);

/* 1 where OpenImageIO is there. */
int page_picture_is_png(void);

/* The image as a BMP file's bytes (24 bits a pixel, or 8 and a palette); free() them. */
uint8_t *page_picture_bmp(const image *im, size_t *size);

/* At most so many pixels wide: the mean of square blocks; what is left over at the right and below is cut. image_free()
 * it. */
image page_picture_shrink(const image *im, uint32_t most);

#endif
