#include "silhouette_picture.h"

#include <stdlib.h>

enum { LONGEST_SIDE = 2048, LARGEST_BLOCK = 16, LEAST_WITH_LINES = 8, NO_POINT = 0x88, BRIGHTEST = 224, DARKEST = 32 };

#define NO_SURFACE ((gn_depth)0xffffffffu)

static const uint8_t dot_colour[3] = {255, 0, 0}, line_colour[3] = {255, 128, 0};

typedef struct cells {
    const uint8_t *bytes;
    uint32_t stride, columns, rows;
    int32_t block;
} cells;

typedef struct pixel {
    int32_t x, y;
} pixel;

uint32_t silhouette_picture_block(uint32_t width, uint32_t height)
{
    uint32_t block = LONGEST_SIDE / (width > height ? width : height);
    return block < 1 ? 1 : block > LARGEST_BLOCK ? LARGEST_BLOCK : block;
}

static void draw(image *im, pixel p, const uint8_t colour[3])
{
    uint8_t *at = (uint8_t *)im->samples + 3 * ((size_t)p.y * im->width + (size_t)p.x);
    for (int i = 0; i < 3; i++)
        at[i] = colour[i];
}

/* ---- depths ---------------------------------------------------------------------------------------------------- */

static void draw_depths(image *im, const gn_depth *depths, uint32_t columns, uint32_t rows)
{
    gn_depth nearest = NO_SURFACE, farthest = 0;
    uint32_t block = im->width / columns;
    for (size_t i = 0; i < (size_t)columns * rows; i++) {
        if (depths[i] < nearest)
            nearest = depths[i];
        if (depths[i] != NO_SURFACE && depths[i] > farthest)
            farthest = depths[i];
    }
    uint64_t range = farthest > nearest ? (uint64_t)farthest - nearest : 1;
    for (uint32_t y = 0; y < im->height; y++)
        for (uint32_t x = 0; x < im->width; x++) {
            gn_depth depth = depths[(size_t)(y / block) * columns + x / block];
            uint64_t darker =
                depth == NO_SURFACE ? BRIGHTEST : (BRIGHTEST - DARKEST) * (uint64_t)(depth - nearest) / range;
            uint8_t grey = (uint8_t)(BRIGHTEST - darker);
            draw(im, (pixel){(int32_t)x, (int32_t)y}, (const uint8_t[]){grey, grey, grey});
        }
}

/* ---- points ---------------------------------------------------------------------------------------------------- */

/* The cell's point, if there is one in a cell of that place. */
static int find_point(const cells *c, uint32_t column, uint32_t row, pixel *point)
{
    if (column >= c->columns || row >= c->rows)
        return 0;
    uint8_t byte = c->bytes[(size_t)row * c->stride + column];
    /* from the centre of a block, half of one from its corner */
    point->x = (int32_t)column * c->block + c->block * (8 + (byte & 15)) / 16;
    point->y = (int32_t)row * c->block + c->block * (8 + (byte >> 4)) / 16;
    return byte != NO_POINT;
}

/* The pixel nearest to `step` of `steps` on the way; of two as near, the one towards the end. */
static int32_t along(int32_t from, int32_t to, int32_t step, int32_t steps)
{
    int32_t way = (2 * step * abs(to - from) + steps) / (2 * steps);
    return to < from ? from - way : from + way;
}

static void draw_line(image *im, pixel from, pixel to)
{
    int32_t across = abs(to.x - from.x), down = abs(to.y - from.y), steps = across > down ? across : down;
    for (int32_t i = 1; i < steps; i++)
        draw(im, (pixel){along(from.x, to.x, i, steps), along(from.y, to.y, i, steps)}, line_colour);
}

static void draw_lines(image *im, const cells *c)
{
    pixel here, beside;
    for (uint32_t row = 0; row < c->rows; row++)
        for (uint32_t column = 0; column < c->columns; column++) {
            if (!find_point(c, column, row, &here))
                continue;
            if (find_point(c, column + 1, row, &beside))
                draw_line(im, here, beside);
            if (find_point(c, column, row + 1, &beside))
                draw_line(im, here, beside);
        }
}

/* A dot of 3 x 3 pixels, of one where blocks are small. It lies within the picture: cells end at the centres of the
 * outer blocks. */
static void draw_points(image *im, const cells *c)
{
    pixel point;
    int32_t reach = c->block >= LEAST_WITH_LINES;
    for (uint32_t row = 0; row < c->rows; row++)
        for (uint32_t column = 0; column < c->columns; column++)
            for (int32_t i = 0; i < 9 && find_point(c, column, row, &point); i++)
                draw(im, (pixel){point.x + reach * (i % 3 - 1), point.y + reach * (i / 3 - 1)}, dot_colour);
}

image silhouette_picture(const gn_depth *depths, uint32_t width, uint32_t height, const uint8_t *map, uint32_t stride)
{
    uint32_t block = silhouette_picture_block(width, height);
    image im = image_make(block * width, block * height, 3, IMAGE_U8);
    cells c = {map, stride, width - 1, height - 1, (int32_t)block};
    draw_depths(&im, depths, width, height);
    if (block >= LEAST_WITH_LINES)
        draw_lines(&im, &c);
    draw_points(&im, &c);
    return im;
}
