/* Pictures of silhouette maps made by hand: every pixel is the grey, red or orange worked out beside it. */
#include "core/tap.h"
#include "silhouette_picture.h"

#include <string.h>

enum { GREY = 0, RED, ORANGE, OTHER, NO_POINT = 0x88 };

#define NO_SURFACE ((gn_depth)0xffffffffu)

typedef struct place {
    uint32_t x, y;
} place;

static const uint8_t *pixel_of(const image *im, uint32_t x, uint32_t y)
{
    return (const uint8_t *)im->samples + 3 * ((size_t)y * im->width + x);
}

static int kind_of(const image *im, uint32_t x, uint32_t y)
{
    const uint8_t *p = pixel_of(im, x, y);
    if (p[0] == p[1] && p[1] == p[2])
        return GREY;
    return p[0] == 255 && p[1] == 0 && p[2] == 0 ? RED : p[0] == 255 && p[1] == 128 && p[2] == 0 ? ORANGE : OTHER;
}

static int count_of(const image *im, int kind)
{
    int count = 0;
    for (uint32_t y = 0; y < im->height; y++)
        for (uint32_t x = 0; x < im->width; x++)
            count += kind_of(im, x, y) == kind;
    return count;
}

/* Are these pixels of the kind, and no others? */
static int are_all(const image *im, int kind, const place *pixels, int count)
{
    int good = count_of(im, kind) == count && count_of(im, OTHER) == 0;
    if (!good)
        note("%d of kind %d, expected %d; %d of no kind", count_of(im, kind), kind, count, count_of(im, OTHER));
    for (int i = 0; i < count; i++)
        if (kind_of(im, pixels[i].x, pixels[i].y) != kind) {
            note("pixel %u, %u is of kind %d, expected %d", (unsigned)pixels[i].x, (unsigned)pixels[i].y,
                 kind_of(im, pixels[i].x, pixels[i].y), kind);
            good = 0;
        }
    return good;
}

/* Red: the 3 x 3 pixels about each of the points, which do not touch, and nothing else. */
static int dots_are(const image *im, const place *points, int count)
{
    place pixels[36];
    for (int i = 0; i < 9 * count; i++) {
        pixels[i].x = points[i / 9].x + (uint32_t)(i % 3) - 1;
        pixels[i].y = points[i / 9].y + (uint32_t)(i / 3 % 3) - 1;
    }
    return are_all(im, RED, pixels, 9 * count);
}

/* ---- sizes and depths ------------------------------------------------------------------------------------------ */

static void blocks(void)
{
    static const uint32_t sizes[][3] = {{2, 2, 16},      {128, 128, 16}, {128, 129, 15}, {256, 64, 8},   {64, 257, 7},
                                        {1024, 1024, 2}, {2048, 3, 1},   {3, 2049, 1},   {4096, 4096, 1}};
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
        uint32_t got = silhouette_picture_block(sizes[i][0], sizes[i][1]);
        ok(got == sizes[i][2], "a_map_of_%u_x_%u_has_blocks_of_%u", (unsigned)sizes[i][0], (unsigned)sizes[i][1],
           (unsigned)sizes[i][2]);
    }
}

/* 10 is the nearest and 40 the farthest: 224 - 192 (z - 10) / 30. */
static void greys(void)
{
    static const gn_depth depths[6] = {10, 20, 30, 40, NO_SURFACE, 11};
    static const uint8_t expected[6] = {224, 160, 96, 32, 0, 218}, none[2] = {NO_POINT, NO_POINT};
    image im = silhouette_picture(depths, 3, 2, none, 2);
    int good = im.width == 48 && im.height == 32 && im.channels == 3 && im.sample == IMAGE_U8;
    for (uint32_t y = 0; good && y < 32; y++)
        for (uint32_t x = 0; x < 48; x++)
            good = good && kind_of(&im, x, y) == GREY && *pixel_of(&im, x, y) == expected[y / 16 * 3 + x / 16];
    ok(good, "a_depth_is_a_block_grey_by_its_place_between_nearest_and_farthest");
    image_free(&im);
}

/* The four greys of a map of 2 x 2. */
static int greys_are(const gn_depth depths[4], const uint8_t expected[4])
{
    static const uint8_t none[1] = {NO_POINT};
    image im = silhouette_picture(depths, 2, 2, none, 1);
    int good = count_of(&im, GREY) == 32 * 32;
    for (uint32_t i = 0; i < 4; i++)
        good = good && *pixel_of(&im, 16 * (i % 2) + 3, 16 * (i / 2) + 12) == expected[i];
    image_free(&im);
    return good;
}

static void depths_at_the_limits(void)
{
    const gn_depth whole[4] = {0, NO_SURFACE - 1, NO_SURFACE, NO_SURFACE / 2};
    const gn_depth level[4] = {7, 7, 7, NO_SURFACE}, empty[4] = {NO_SURFACE, NO_SURFACE, NO_SURFACE, NO_SURFACE};
    ok(greys_are(whole, (const uint8_t[]){224, 32, 0, 128}), "the_whole_range_of_depths_goes_from_224_to_32");
    ok(greys_are(level, (const uint8_t[]){224, 224, 224, 0}), "one_depth_alone_is_bright");
    ok(greys_are(empty, (const uint8_t[]){0, 0, 0, 0}), "a_map_without_a_surface_is_black");
}

/* ---- points and lines ------------------------------------------------------------------------------------------ */

static const gn_depth flat[12] = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12};

/* Blocks of 16: a pixel is 1/16 texel, and the first cell's corner is at pixel 8. */
static void one_point(void)
{
    static const uint8_t cells[10] = {0x4c, NO_POINT, 0, 0, 0, NO_POINT, NO_POINT, 0, 0, 0}; /* x 12, y 4 */
    static const uint8_t corners[2][1] = {{0x00}, {0xff}};
    static const place point[1] = {{20, 12}}, first[1] = {{8, 8}}, last[1] = {{23, 23}};
    image im = silhouette_picture(flat, 3, 3, cells, 5);
    ok(dots_are(&im, point, 1) && count_of(&im, ORANGE) == 0,
       "a_point_is_a_dot_at_its_place_in_the_cell_and_a_centre_and_what_lies_behind_a_row_are_none");
    image_free(&im);
    im = silhouette_picture(flat, 2, 2, corners[0], 1);
    ok(dots_are(&im, first, 1), "the_first_place_of_a_cell_is_the_centre_of_its_first_texel");
    image_free(&im);
    im = silhouette_picture(flat, 2, 2, corners[1], 1);
    ok(dots_are(&im, last, 1), "the_last_is_a_sixteenth_before_that_of_the_fourth_texel");
    image_free(&im);
}

static void lines(void)
{
    static const uint8_t across[2] = {0x4c, 0xa2}, down[2] = {0x48, 0x83}, corner[4] = {0x4c, NO_POINT, NO_POINT, 0x11};
    /* (12, 4) and (2, 10) of the next cell; the ends of the line lie below the dots */
    static const place across_points[2] = {{20, 12}, {26, 18}};
    static const place across_line[3] = {{22, 14}, {23, 15}, {24, 16}};
    /* (8, 4) and (3, 8) of the one below: 5 columns in 20 rows, half-way ones towards the end */
    static const place down_points[2] = {{16, 12}, {11, 32}};
    static const place down_line[17] = {{15, 14}, {15, 15}, {15, 16}, {15, 17}, {14, 18}, {14, 19},
                                        {14, 20}, {14, 21}, {13, 22}, {13, 23}, {13, 24}, {13, 25},
                                        {12, 26}, {12, 27}, {12, 28}, {12, 29}, {11, 30}};
    static const place corner_points[2] = {{20, 12}, {25, 25}};
    image im = silhouette_picture(flat, 3, 2, across, 2);
    ok(dots_are(&im, across_points, 2) && are_all(&im, ORANGE, across_line, 3),
       "points_of_cells_side_by_side_are_joined");
    image_free(&im);
    im = silhouette_picture(flat, 2, 3, down, 1);
    ok(dots_are(&im, down_points, 2) && are_all(&im, ORANGE, down_line, 17), "and_those_one_above_the_other");
    image_free(&im);
    im = silhouette_picture(flat, 3, 3, corner, 2);
    ok(dots_are(&im, corner_points, 2) && count_of(&im, ORANGE) == 0, "cells_that_meet_at_a_corner_are_not");
    image_free(&im);
}

enum { WIDE = 4096 };

/* Blocks of 8 pixels have lines, those of 7 have points of one pixel. */
static void small_blocks(void)
{
    static gn_depth depths[2 * WIDE];
    static uint8_t cells[WIDE];
    /* blocks of 8: 8 (8 + 6) / 16 = 7, 8 (8 + 4) / 16 = 6; the next cell: 8 + 8 (8 + 10) / 16 = 17, 6 */
    static const place of_eight[2] = {{7, 6}, {17, 6}};
    static const place line_of_eight[7] = {{9, 6}, {10, 6}, {11, 6}, {12, 6}, {13, 6}, {14, 6}, {15, 6}};
    /* blocks of 7: 7 (8 + 6) / 16 = 6.1, 7 (8 + 4) / 16 = 5.25; 7 + 7 (8 + 10) / 16 = 14.9 */
    static const place of_seven[2] = {{6, 5}, {14, 5}};
    /* blocks of 1: 23 / 16 + 4094 = 4095, 8 / 16 = 0; 15 / 16 = 0, 16 / 16 = 1 */
    static const place of_one[2] = {{WIDE - 1, 0}, {0, 1}};
    memset(cells, NO_POINT, sizeof cells);
    cells[0] = 0x46;
    cells[1] = 0x4a;
    image im = silhouette_picture(depths, 256, 2, cells, WIDE);
    ok(im.width == 2048 && dots_are(&im, of_eight, 2) && are_all(&im, ORANGE, line_of_eight, 7),
       "blocks_of_8_pixels_have_dots_and_lines");
    image_free(&im);
    im = silhouette_picture(depths, 257, 2, cells, WIDE);
    ok(im.width == 7 * 257 && are_all(&im, RED, of_seven, 2) && count_of(&im, ORANGE) == 0,
       "smaller_ones_have_points_of_a_pixel_and_no_lines");
    image_free(&im);
    cells[0] = 0x87;
    cells[1] = NO_POINT;
    cells[WIDE - 2] = 0x0f;
    im = silhouette_picture(depths, WIDE, 2, cells, WIDE);
    ok(im.width == WIDE && im.height == 2 && are_all(&im, RED, of_one, 2), "the_widest_map_has_a_pixel_a_texel");
    image_free(&im);
}

int main(void)
{
    blocks();
    greys();
    depths_at_the_limits();
    one_point();
    lines();
    small_blocks();
    return tap_done();
}
