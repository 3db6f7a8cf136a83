#include "silhouette_picture.h"

#include "depth_picture.h"

enum { LONGEST_SIDE = 2048, LARGEST_BLOCK = 16, LEAST_WITH_LINES = 8, NO_POINT = 0x88 };

static const uint8_t dot_colour[3] = {255, 0, 0}, line_colour[3] = {255, 128, 0};

typedef struct cells {
    const uint8_t *bytes;
    uint32_t stride, columns, rows;
    int32_t block;
} cells;

uint32_t silhouette_picture_block(uint32_t width, uint32_t height)
{
    uint32_t block = LONGEST_SIDE / (width > height ? width : height);
    return block < 1 ? 1 : block > LARGEST_BLOCK ? LARGEST_BLOCK : block;
}

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

static void draw_lines(image *im, const cells *c)
{
    pixel here, beside;
    for (uint32_t row = 0; row < c->rows; row++)
        for (uint32_t column = 0; column < c->columns; column++) {
            if (!find_point(c, column, row, &here))
                continue;
            if (find_point(c, column + 1, row, &beside))
                depth_picture_line(im, here, beside, line_colour);
            if (find_point(c, column, row + 1, &beside))
                depth_picture_line(im, here, beside, line_colour);
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
                depth_picture_dot(im, (pixel){point.x + reach * (i % 3 - 1), point.y + reach * (i / 3 - 1)},
                                  dot_colour);
}

image silhouette_picture(const gn_depth *depths, uint32_t width, uint32_t height, const uint8_t *map, uint32_t stride)
{
    uint32_t block = silhouette_picture_block(width, height);
    image im = depth_picture(depths, width, height, block);
    cells c = {map, stride, width - 1, height - 1, (int32_t)block};
    if (block >= LEAST_WITH_LINES)
        draw_lines(&im, &c);
    draw_points(&im, &c);
    return im;
}
