#include "depth_picture.h"

#include <stdlib.h>

enum { BRIGHTEST = 224, DARKEST = 32 };

#define NO_SURFACE ((gn_depth)0xffffffffu)

void depth_picture_dot(image *im, pixel at, const uint8_t colour[3])
{
    if (at.x < 0 || at.y < 0 || at.x >= (int32_t)im->width || at.y >= (int32_t)im->height)
        return;
    uint8_t *sample = (uint8_t *)im->samples + 3 * ((size_t)at.y * im->width + (size_t)at.x);
    for (int i = 0; i < 3; i++)
        sample[i] = colour[i];
}

image depth_picture(const gn_depth *depths, uint32_t columns, uint32_t rows, uint32_t block)
{
    image im = image_make(block * columns, block * rows, 3, IMAGE_U8);
    gn_depth nearest = NO_SURFACE, farthest = 0;
    for (size_t i = 0; i < (size_t)columns * rows; i++) {
        if (depths[i] < nearest)
            nearest = depths[i];
        if (depths[i] != NO_SURFACE && depths[i] > farthest)
            farthest = depths[i];
    }
    uint64_t range = farthest > nearest ? (uint64_t)farthest - nearest : 1;
    for (uint32_t y = 0; y < im.height; y++)
        for (uint32_t x = 0; x < im.width; x++) {
            gn_depth depth = depths[(size_t)(y / block) * columns + x / block];
            uint64_t darker =
                depth == NO_SURFACE ? BRIGHTEST : (BRIGHTEST - DARKEST) * (uint64_t)(depth - nearest) / range;
            uint8_t grey = (uint8_t)(BRIGHTEST - darker);
            depth_picture_dot(&im, (pixel){(int32_t)x, (int32_t)y}, (const uint8_t[]){grey, grey, grey});
        }
    return im;
}

static int32_t along(int32_t from, int32_t to, int32_t step, int32_t steps)
{
    int32_t way = (2 * step * abs(to - from) + steps) / (2 * steps);
    return to < from ? from - way : from + way;
}

void depth_picture_line(image *im, pixel from, pixel to, const uint8_t colour[3])
{
    int32_t across = abs(to.x - from.x), down = abs(to.y - from.y), steps = across > down ? across : down;
    depth_picture_dot(im, from, colour);
    for (int32_t i = 1; i <= steps; i++)
        depth_picture_dot(im, (pixel){along(from.x, to.x, i, steps), along(from.y, to.y, i, steps)}, colour);
}
