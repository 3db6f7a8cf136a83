/* Images in memory and in files: PGM and PPM (8 and 16 bits, binary, big-endian samples as the formats demand), PFM
 * (32-bit floats, bottom row first), and with OpenImageIO whatever it knows (PNG, EXR, TIFF, ...). The extension
 * decides.
 */
#ifndef IMAGE_H
#define IMAGE_H

#include "problem.h"

#include <stddef.h>
#include <stdint.h>

typedef enum image_sample { IMAGE_U8 = 1, IMAGE_U16 = 2, IMAGE_F32 = 4 } image_sample; /* bytes a sample */

typedef struct image {
    uint32_t width, height, channels; /* channels: 1 grey, 3 red, green, blue */
    image_sample sample;
    void *samples; /* rows from the top, packed, native byte order */
} image;

/* A black image; image_free() it. */
image image_make(uint32_t width, uint32_t height, uint32_t channels, image_sample sample);
void image_free(image *im);

static inline size_t image_sample_count(const image *im)
{
    return (size_t)im->width * im->height * im->channels;
}

/* Can an image of this kind be written under this name? Asked before long work. 0, or -1 and the problem. */
int image_can_write(const char *path, uint32_t channels, image_sample sample, problem *why);

/* Write to a temporary name, then rename. 0, or -1 and the problem. */
int image_write(const image *im, const char *path, problem *why);

/* Read 8- or 16-bit images of 1 or 3 channels, each side 1 to 4096. image_free() it. 0, or -1 and the problem. */
int image_read(image *im, const char *path, problem *why);

/* PGM or PPM from memory; `file` is for messages. */
int image_parse_netpbm(image *im, const char *file, const uint8_t *bytes, size_t size, problem *why);

/* Read an image as a mask: 8-bit grey (or three equal channels), 255 no surface. */
int image_read_mask(image *im, const char *path, problem *why);

#endif
