#include "distance.h"

#include "memory.h"

#include <stdlib.h>

/* In units of half a pixel the centres are at even places (2x, 2y). An edge's point is at (2x + 1, 2y), to the right of
 * a centre, or at (2x, 2y + 1), below it. So the rows of pixels need columns at all places 0 ... 2 width - 2: odd ones
 * hold the points to the right, even ones those below. */

enum { FAR = UINT16_MAX }; /* no point in this column; what can be there is at most 8190 */

/* First phase, downwards: half pixels from each place of a row of pixels to the nearest point of its column that is not
 * below. */
static void go_down(uint16_t *columns, const uint8_t *edges, uint32_t width, uint32_t height)
{
    size_t places = 2 * (size_t)width - 1;
    for (uint32_t y = 0; y < height; y++) {
        uint16_t *row = columns + y * places;
        const uint16_t *above = y ? row - places : 0;
        const uint8_t *here = edges + (size_t)y * width, *upper = y ? here - width : 0;
        for (size_t u = 0; u < places; u++) {
            int below_above = !(u & 1) && upper && (upper[u / 2] & DISTANCE_EDGE_BELOW);
            int right = (u & 1) && (here[u / 2] & DISTANCE_EDGE_RIGHT);
            int farther = !above || above[u] == FAR ? FAR : above[u] + 2;
            row[u] = (uint16_t)(right ? 0 : below_above ? 1 : farther);
        }
    }
}

/* Upwards: the points below as well. */
static void go_up(uint16_t *columns, const uint8_t *edges, uint32_t width, uint32_t height)
{
    size_t places = 2 * (size_t)width - 1;
    for (uint32_t y = height - 1; y-- > 0;) {
        uint16_t *row = columns + y * places;
        const uint16_t *lower = row + places;
        const uint8_t *here = edges + (size_t)y * width;
        for (size_t u = 0; u < places; u++) {
            int farther = !(u & 1) && (here[u / 2] & DISTANCE_EDGE_BELOW) ? 1 : lower[u] == FAR ? FAR : lower[u] + 2;
            if (farther < row[u])
                row[u] = (uint16_t)farther;
        }
    }
}

/* A column whose point is the nearest one from place `from` on, up to where the next one takes over. */
typedef struct owner {
    int32_t column, from;
} owner;

static int32_t square_of(int32_t place, int32_t column, const uint16_t *row)
{
    int32_t along = place - column, across = row[column];
    return along * along + across * across;
}

/* The last place at which the left column is no farther than the right one (Meijster's Sep). It is asked only where the
 * left one is no farther at some place >= 0: the numerator is not negative. */
static int32_t last_place(int32_t left, int32_t right, const uint16_t *row)
{
    int32_t a = row[left], b = row[right];
    return (right * right - left * left + b * b - a * a) / (2 * (right - left));
}

/* Second phase, for a row of pixels: the lower envelope of its columns' parabolas. Returns how many columns own a
 * part of it. */
static int envelope(owner *owners, const uint16_t *row, int32_t places)
{
    int count = 0;
    for (int32_t u = 0; u < places; u++) {
        if (row[u] == FAR)
            continue;
        while (count && square_of(owners[count - 1].from, u, row) <
                            square_of(owners[count - 1].from, owners[count - 1].column, row))
            count--;
        int32_t from = count ? last_place(owners[count - 1].column, u, row) + 1 : 0;
        if (from < places)
            owners[count++] = (owner){u, from};
    }
    return count;
}

static void read_envelope(uint32_t *squared, const owner *owners, int count, const uint16_t *row, uint32_t width)
{
    for (uint32_t x = width; x-- > 0;) {
        int32_t place = 2 * (int32_t)x;
        while (count && owners[count - 1].from > place)
            count--;
        squared[x] = count ? (uint32_t)square_of(place, owners[count - 1].column, row) : DISTANCE_NONE;
    }
}

int distance_to_edges(uint32_t *squared, const uint8_t *edges, uint32_t width, uint32_t height)
{
    size_t places = 2 * (size_t)width - 1;
    uint16_t *columns = memory_take(places * height, sizeof *columns);
    owner *owners = memory_take(places, sizeof *owners);
    go_down(columns, edges, width, height);
    go_up(columns, edges, width, height);
    for (uint32_t y = 0; y < height; y++) {
        const uint16_t *row = columns + y * places;
        int count = envelope(owners, row, (int32_t)places);
        read_envelope(squared + (size_t)y * width, owners, count, row, width);
    }
    free(owners);
    free(columns);
    return squared[0] != DISTANCE_NONE;
}
