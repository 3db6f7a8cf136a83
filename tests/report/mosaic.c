/* Cut pictures, enlarge them without smoothing, and put them side by side: for the pages of docs/.
 *
 *     mosaic OUT COLUMNS PICTURE[@WIDTHxHEIGHT+X+Y[*TIMES]]...
 *
 * Pictures of 8 bits, grey or colour, in rows of COLUMNS, 4 white pixels between them; in a row all have one height, in
 * a column one width. Behind an @: the part that is cut out, and how many times larger it becomes. Exit status: 0 done,
 * 2 bad usage or input. */
#include "image.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { GAP = 4, MOST = 64 };

/* A part of a picture, as it is asked for. */
typedef struct part {
    char path[1024];
    uint32_t width, height, x, y, times; /* width 0: all of it */
} part;

static int read_part(part *p, const char *argument, problem *why)
{
    char rest;
    p->width = p->height = p->x = p->y = 0;
    p->times = 1;
    snprintf(p->path, sizeof p->path, "%s", argument);
    char *at = strrchr(p->path, '@');
    if (!at)
        return 0;
    *at++ = 0;
    int found = sscanf(at, "%ux%u+%u+%u*%u%c", &p->width, &p->height, &p->x, &p->y, &p->times, &rest);
    if ((found != 4 && found != 5) || !p->width || !p->height || p->width > 4096 || p->height > 4096 || p->x > 4096 ||
        p->y > 4096 || p->times < 1 || p->times > 32)
        return problem_of_usage(why, "part '%s' of %s; expected @WIDTHxHEIGHT+X+Y or @WIDTHxHEIGHT+X+Y*TIMES", at,
                                p->path);
    return 0;
}

/* In colour. */
static int cut(image *out, const part *p, problem *why)
{
    image im;
    if (image_read(&im, p->path, why))
        return -1;
    uint32_t width = p->width ? p->width : im.width, height = p->height ? p->height : im.height;
    if (im.sample != IMAGE_U8 || p->x + width > im.width || p->y + height > im.height) {
        image_free(&im);
        return problem_in(why, p->path, "is %u x %u; expected 8 bits a channel, and the part %ux%u+%u+%u within",
                          im.width, im.height, width, height, p->x, p->y);
    }
    *out = image_make(width * p->times, height * p->times, 3, IMAGE_U8);
    const uint8_t *from = im.samples;
    uint8_t *to = out->samples;
    for (uint32_t y = 0; y < out->height; y++)
        for (uint32_t x = 0; x < out->width; x++, to += 3) {
            size_t pixel = (size_t)(p->y + y / p->times) * im.width + p->x + x / p->times;
            for (uint32_t c = 0; c < 3; c++)
                to[c] = from[pixel * im.channels + (im.channels == 3 ? c : 0)];
        }
    image_free(&im);
    return 0;
}

static void place(image *sheet, const image *im, uint32_t x, uint32_t y)
{
    for (uint32_t row = 0; row < im->height; row++)
        memcpy((uint8_t *)sheet->samples + 3 * ((size_t)(y + row) * sheet->width + x),
               (const uint8_t *)im->samples + 3 * (size_t)row * im->width, 3 * (size_t)im->width);
}

static int is_grid(const image *images, uint32_t count, uint32_t columns)
{
    for (uint32_t i = 0; i < count; i++)
        if (images[i].width != images[i % columns].width || images[i].height != images[i / columns * columns].height)
            return 0;
    return 1;
}

static image lay_out(const image *images, uint32_t count, uint32_t columns)
{
    uint32_t width = 0, height = 0, x = 0, y = 0;
    for (uint32_t i = 0; i < columns && i < count; i++)
        width += images[i].width + (i ? GAP : 0);
    for (uint32_t i = 0; i < count; i += columns)
        height += images[i].height + (i ? GAP : 0);
    image sheet = image_make(width, height, 3, IMAGE_U8);
    memset(sheet.samples, 255, image_sample_count(&sheet));
    for (uint32_t i = 0; i < count; i++) {
        place(&sheet, &images[i], x, y);
        x += images[i].width + GAP;
        if ((i + 1) % columns == 0) {
            x = 0;
            y += images[i].height + GAP;
        }
    }
    return sheet;
}

static int join(const char *out, uint32_t columns, char **arguments, uint32_t count, problem *why)
{
    image images[MOST] = {{0}};
    part p;
    int result = 0;
    for (uint32_t i = 0; i < count && !result; i++)
        result = read_part(&p, arguments[i], why) || cut(&images[i], &p, why) ? -1 : 0;
    if (!result && !is_grid(images, count, columns))
        result =
            problem_of_usage(why, "%s: the parts differ in size; expected one height a row, one width a column", out);
    if (!result) {
        image sheet = lay_out(images, count, columns);
        result = image_write(&sheet, out, why);
        image_free(&sheet);
    }
    for (uint32_t i = 0; i < count; i++)
        image_free(&images[i]);
    return result;
}

int main(int argc, char **argv)
{
    problem why;
    char *end = 0;
    long columns = argc > 3 ? strtol(argv[2], &end, 10) : 0;
    if (columns < 1 || columns > MOST || *end || argc - 3 > MOST) {
        fprintf(stderr, "usage: mosaic OUT COLUMNS PICTURE[@WIDTHxHEIGHT+X+Y[*TIMES]]... (1 to %d)\n", MOST);
        return 2;
    }
    if (join(argv[1], (uint32_t)columns, argv + 3, (uint32_t)(argc - 3), &why)) {
        fprintf(stderr, "%s\n", why.text);
        return 2;
    }
    return 0;
}
