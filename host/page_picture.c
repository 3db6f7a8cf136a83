#include "page_picture.h"

#include "file.h"
#include "markup.h"
#include "memory.h"
#include "oiio.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* ---- BMP (BITMAPFILEHEADER, BITMAPINFOHEADER): little-endian, rows from below, padded to 4 bytes ----------------- */

enum { BMP_HEADERS = 54, BMP_PALETTE = 256 };

typedef struct palette {
    uint8_t colours[BMP_PALETTE][3];
    int count;
} palette;

/* Its number, a new one where there is room, or -1. */
static int colour_number(palette *p, const uint8_t *colour)
{
    for (int i = 0; i < p->count; i++)
        if (memcmp(p->colours[i], colour, 3) == 0)
            return i;
    if (p->count == BMP_PALETTE)
        return -1;
    memcpy(p->colours[p->count], colour, 3);
    return p->count++;
}

static int fits_palette(palette *p, const image *im)
{
    const uint8_t *samples = im->samples;
    size_t count = image_sample_count(im);
    for (size_t i = 0; i < count; i += 3)
        if (colour_number(p, samples + i) < 0)
            return 0;
    return 1;
}

static void put_number(uint8_t *to, size_t number, int bytes)
{
    for (int i = 0; i < bytes; i++)
        to[i] = (uint8_t)(number >> 8 * i);
}

static void put_headers(uint8_t *to, const image *im, size_t size, size_t samples_at, int bytes_a_pixel)
{
    memcpy(to, "BM", 2);
    put_number(to + 2, size, 4);
    put_number(to + 10, samples_at, 4);
    put_number(to + 14, 40, 4); /* of the second header */
    put_number(to + 18, im->width, 4);
    put_number(to + 22, im->height, 4);
    put_number(to + 26, 1, 2); /* planes */
    put_number(to + 28, 8 * (size_t)bytes_a_pixel, 2);
}

static void put_row(uint8_t *to, const uint8_t *from, uint32_t width, palette *p)
{
    for (uint32_t x = 0; x < width; x++, from += 3)
        if (p) {
            to[x] = (uint8_t)colour_number(p, from);
        } else { /* blue first */
            to[3 * x] = from[2];
            to[3 * x + 1] = from[1];
            to[3 * x + 2] = from[0];
        }
}

uint8_t *page_picture_bmp(const image *im, size_t *size)
{
    palette p = {.count = 0};
    int few = fits_palette(&p, im), bytes_a_pixel = few ? 1 : 3;
    size_t samples_at = BMP_HEADERS + (few ? 4 * BMP_PALETTE : 0);
    size_t row = ((size_t)im->width * (size_t)bytes_a_pixel + 3) / 4 * 4;
    *size = samples_at + row * im->height;
    uint8_t *bytes = memory_take(*size, 1);
    put_headers(bytes, im, *size, samples_at, bytes_a_pixel);
    for (int i = 0; few && i < p.count; i++) {
        uint8_t *entry = bytes + BMP_HEADERS + 4 * i;
        entry[0] = p.colours[i][2];
        entry[1] = p.colours[i][1];
        entry[2] = p.colours[i][0];
    }
    for (uint32_t y = 0; y < im->height; y++)
        put_row(bytes + samples_at + row * (im->height - 1 - y),
                (const uint8_t *)im->samples + (size_t)3 * im->width * y, im->width, few ? &p : 0);
    return bytes;
}

/* ---- PNG -------------------------------------------------------------------------------------------------------- */

/* The library writes files: a temporary one, of which nothing stays. */
static int make_png(file_content *png, const image *im, const char *beside, problem *why)
{
    size_t room = strlen(beside) + 8;
    char *name = memory_take(room, 1);
    file_output place;
    snprintf(name, room, "%s.png", beside);
    int result = file_output_name(&place, name, why);
    free(name);
    if (result)
        return -1;
    result = image_write(im, place.temporary, why) || file_read(png, place.temporary, why) ? -1 : 0;
    unlink(place.temporary);
    file_output_abandon(&place);
    return result;
}

int page_picture_is_png(void)
{
    return oiio_open() != 0;
}

int page_picture_write(FILE *stream, const image *im, const char *beside, problem *why)
{
    file_content file = {0, 0};
    if (!page_picture_is_png())
        file.bytes = page_picture_bmp(im, &file.size);
    else if (make_png(&file, im, beside, why))
        return -1;
    fprintf(stream, "data:image/%s;base64,", page_picture_is_png() ? "png" : "bmp");
    markup_base64(stream, file.bytes, file.size);
    free(file.bytes);
    return 0;
}

/* ---- size ------------------------------------------------------------------------------------------------------- */

static uint8_t block_mean(const image *im, uint32_t x, uint32_t y, uint32_t channel, uint32_t block)
{
    const uint8_t *samples = im->samples;
    uint32_t sum = 0;
    for (uint32_t row = y * block; row < (y + 1) * block; row++)
        for (uint32_t column = x * block; column < (x + 1) * block; column++)
            sum += samples[((size_t)row * im->width + column) * im->channels + channel];
    return (uint8_t)((sum + block * block / 2) / (block * block));
}

image page_picture_shrink(const image *im, uint32_t most)
{
    uint32_t block = (im->width + most - 1) / most;
    if (block > im->height)
        block = im->height;
    image small = image_make(im->width / block, im->height / block, im->channels, IMAGE_U8);
    uint8_t *to = small.samples;
    for (uint32_t y = 0; y < small.height; y++)
        for (uint32_t x = 0; x < small.width; x++)
            for (uint32_t c = 0; c < small.channels; c++)
                *to++ = block_mean(im, x, y, c, block);
    return small;
}
