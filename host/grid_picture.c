#include "grid_picture.h"

#include "depth_picture.h"

#include <math.h>

enum { MOST_LINES = 64 };

static const uint8_t column_colour[3] = {255, 128, 0}, row_colour[3] = {0, 128, 255}, frame_colour[3] = {255, 0, 0};

typedef struct grid {
    const gn_rectangle *rectangle;
    uint32_t (*places)[2];
    uint32_t columns, rows;
    double side; /* of the plane, the longer one, in pixels */
} grid;

void grid_picture_size(const gn_light *light, uint16_t size[2])
{
    int directional = light->kind == GN_DIRECTIONAL;
    int64_t sides[2] = {directional ? light->box_width : 1, directional ? light->box_height : 1};
    int64_t longer = sides[0] > sides[1] ? sides[0] : sides[1];
    for (int i = 0; i < 2; i++) {
        int64_t pixels = (GRID_PICTURE_SIDE * sides[i] + longer / 2) / longer;
        size[i] = (uint16_t)(pixels < 1 ? 1 : pixels);
    }
}

/* Across and down: shares of the rectangle's sides. */
static pixel pixel_of(const grid *g, double across, double down)
{
    const gn_rectangle *r = g->rectangle;
    double along = (r->low[0] + across * r->size[0]) * g->side, beside = (r->low[1] + down * r->size[1]) * g->side;
    double x = ldexp(along * r->cosine - beside * r->sine, -60), y = ldexp(along * r->sine + beside * r->cosine, -60);
    return (pixel){(int32_t)floor(x), (int32_t)floor(y)};
}

static pixel centre_of(const grid *g, uint32_t column, uint32_t row)
{
    const uint32_t *place = g->places[(size_t)row * g->columns + column];
    return pixel_of(g, ldexp(place[0], -32), ldexp(place[1], -32));
}

/* The number of the line after this one: the next whose number is a multiple of the step, or the last. */
static uint32_t next_line(uint32_t number, uint32_t count)
{
    uint32_t step = (count + MOST_LINES - 1) / MOST_LINES, next = number + step;
    return number + 1 < count && next >= count ? count - 1 : next;
}

static void draw_column(image *im, const grid *g, uint32_t column)
{
    for (uint32_t row = 1; row < g->rows; row++)
        depth_picture_line(im, centre_of(g, column, row - 1), centre_of(g, column, row), column_colour);
}

static void draw_row(image *im, const grid *g, uint32_t row)
{
    for (uint32_t column = 1; column < g->columns; column++)
        depth_picture_line(im, centre_of(g, column - 1, row), centre_of(g, column, row), row_colour);
}

static void draw_frame(image *im, const grid *g)
{
    static const double corners[5][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0, 0}};
    for (int i = 0; i < 4; i++)
        depth_picture_line(im, pixel_of(g, corners[i][0], corners[i][1]),
                           pixel_of(g, corners[i + 1][0], corners[i + 1][1]), frame_colour);
}

image grid_picture(const gn_depth *depths, uint32_t width, uint32_t height, const gn_rectangle *rectangle,
                   uint32_t (*places)[2], uint32_t columns, uint32_t rows)
{
    grid g = {rectangle, places, columns, rows, width > height ? width : height};
    image im = depth_picture(depths, width, height, 1);
    for (uint32_t column = 0; column < columns; column = next_line(column, columns))
        draw_column(&im, &g, column);
    for (uint32_t row = 0; row < rows; row = next_line(row, rows))
        draw_row(&im, &g, row);
    draw_frame(&im, &g);
    return im;
}
