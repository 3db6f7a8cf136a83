/* The skewed quadrants of a silhouette map's cell (Sen et al. 2003, figure 5) by angles: the eight regions between the
 * lines from a cell's point to the points of its four neighbours and to its corners. */
#ifndef QUADRANTS_H
#define QUADRANTS_H

#include "tap.h"

typedef struct vector {
    int64_t x, y;
} vector;

static int64_t cross(vector a, vector b)
{
    return a.x * b.y - a.y * b.x;
}

static vector apart(vector a, vector b)
{
    vector v = {a.x - b.x, a.y - b.y};
    return v;
}

/* Strictly between two rays that are less than half a turn apart, clockwise. */
static int is_between(vector from, vector v, vector to)
{
    return cross(from, v) > 0 && cross(v, to) > 0;
}

static int is_on(vector ray, vector v)
{
    return cross(ray, v) == 0 && ray.x * v.x + ray.y * v.y > 0;
}

/* Widths of the cell before, of the cell and of the one after it, and so of heights. */
typedef struct cell_sizes {
    int64_t width[3], height[3];
} cell_sizes;

/* The quadrant of a place, 1 right + 2 below. cells: the bytes of the cell itself and of those right of it, below it,
 * left of it and above it. x, y: in 2^-bits texel from the cell's upper left corner. On the lines left and right a
 * place is the lower texel's, on those up and down the right one's, in the point the lower right one's; *line: whether
 * it is on one. Lines are straight where the cells are as wide and high as their sizes. */
static int find_region_of(const uint8_t cells[5], const cell_sizes *sizes, int bits, int64_t x, int64_t y, int *line)
{
    static const int8_t across[4] = {1, 0, -1, 0}, down[4] = {0, 1, 0, -1};
    static const int8_t quadrants[4] = {3, 2, 0, 1}; /* behind the lines right, down, left, up */
    static const int8_t on_line[4] = {3, 3, 2, 1};
    int64_t width = sizes->width[1], height = sizes->height[1];
    vector at = {width * (cells[0] & 15), height * (cells[0] >> 4)}, v, ray[5], corner[4];
    v.x = width * x - (at.x << (bits - 4));
    v.y = height * y - (at.y << (bits - 4));
    for (int i = 0; i < 4; i++) {
        vector neighbour = {sizes->width[1 + across[i]] * (cells[i + 1] & 15),
                            sizes->height[1 + down[i]] * (cells[i + 1] >> 4)};
        vector to = {16 * width * (quadrants[i] & 1), 16 * height * (quadrants[i] >> 1)};
        neighbour.x += 16 * (across[i] < 0 ? -sizes->width[0] : across[i] * width);
        neighbour.y += 16 * (down[i] < 0 ? -sizes->height[0] : down[i] * height);
        ray[i] = apart(neighbour, at);
        corner[i] = apart(to, at);
    }
    ray[4] = ray[0];
    *line = 1;
    if (v.x == 0 && v.y == 0)
        return 3;
    for (int i = 0; i < 4; i++)
        if (is_on(ray[i], v))
            return on_line[i];
    *line = 0;
    for (int i = 0; i < 4; i++)
        if (is_between(ray[i], v, corner[i]) || is_on(corner[i], v) || is_between(corner[i], v, ray[i + 1]))
            return quadrants[i];
    return -1;
}

/* The same of cells of one size. */
static TAP_UNUSED int find_region(const uint8_t cells[5], int bits, int64_t x, int64_t y, int *line)
{
    static const cell_sizes even = {{1, 1, 1}, {1, 1, 1}};
    return find_region_of(cells, &even, bits, x, y, line);
}

/* One of the four places about one, whose answers a smooth border counts: a turned square of 1/8 texel, held in the
 * cell. */
static TAP_UNUSED vector find_one_of_four(int i, int bits, int64_t x, int64_t y)
{
    int64_t one = (int64_t)1 << bits, wide = one / 8, narrow = wide / 3;
    const vector moves[4] = {{-narrow, -wide}, {wide, -narrow}, {narrow, wide}, {-wide, narrow}};
    vector place = {x + moves[i].x, y + moves[i].y};
    place.x = place.x < 0 ? 0 : place.x < one ? place.x : one - 1;
    place.y = place.y < 0 ? 0 : place.y < one ? place.y : one - 1;
    return place;
}

#endif
