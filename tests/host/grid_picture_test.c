/* Pictures of grids made by hand: every line is where it was worked out beside it. */
#include "core/tap.h"
#include "grid_picture.h"

enum { UNIT = 1 << 30, WIDTH = 64, HEIGHT = 32 };
enum { GREY = 0, ORANGE, BLUE, RED, OTHER };

static const gn_depth flat[WIDTH * HEIGHT];

static int kind_of(const image *im, uint32_t x, uint32_t y)
{
    const uint8_t *p = (const uint8_t *)im->samples + 3 * ((size_t)y * im->width + x);
    if (p[0] == 224 && p[1] == 224 && p[2] == 224)
        return GREY;
    if (p[0] == 255)
        return p[2] != 0 ? OTHER : p[1] == 128 ? ORANGE : p[1] == 0 ? RED : OTHER;
    return p[0] == 0 && p[1] == 128 && p[2] == 255 ? BLUE : OTHER;
}

/* How many pixels of the kind there are from (x0, y0) to (x1, y1), both included. */
static int count_in(const image *im, int kind, uint32_t x0, uint32_t y0, uint32_t x1, uint32_t y1)
{
    int count = 0;
    for (uint32_t y = y0; y <= y1; y++)
        for (uint32_t x = x0; x <= x1; x++)
            count += kind_of(im, x, y) == kind;
    return count;
}

/* Are there as many pixels of this kind in the whole picture? */
static int count_is(const image *im, int kind, int expected)
{
    int count = count_in(im, kind, 0, 0, im->width - 1, im->height - 1);
    if (count != expected)
        note("%d pixels of kind %d, expected %d", count, kind, expected);
    return count == expected;
}

static uint32_t share(double of)
{
    return (uint32_t)(of * 4294967296.0);
}

/* Two columns and two rows over the middle of a plane of 64 x 32 pixels: half as wide, from a quarter on. */
static void a_grid(void)
{
    const gn_rectangle r = {UNIT, 0, {UNIT / 4, UNIT / 8}, {UNIT / 2, UNIT / 4}}; /* x 16 to 48, y 8 to 24 */
    /* columns at 16 + 32 / 8 = 20 and 16 + 32 3/4 = 40; rows at 8 + 16 / 4 = 12 and 8 + 16 7/8 = 22 */
    uint32_t places[4][2] = {{share(0.125), share(0.25)},
                             {share(0.75), share(0.25)},
                             {share(0.125), share(0.875)},
                             {share(0.75), share(0.875)}};
    image im = grid_picture(flat, WIDTH, HEIGHT, &r, places, 2, 2);
    ok(im.width == WIDTH && im.height == HEIGHT && im.channels == 3 && count_is(&im, OTHER, 0),
       "a_picture_has_a_pixel_a_depth");
    /* rows lie over columns where they cross */
    ok(count_is(&im, ORANGE, 18) && count_in(&im, ORANGE, 20, 13, 20, 21) == 9 &&
           count_in(&im, ORANGE, 40, 13, 40, 21) == 9,
       "columns_run_through_the_centres_of_their_texels_from_the_first_row_to_the_last");
    ok(count_is(&im, BLUE, 42) && count_in(&im, BLUE, 20, 12, 40, 12) == 21 &&
           count_in(&im, BLUE, 20, 22, 40, 22) == 21,
       "and_so_do_rows");
    ok(count_is(&im, RED, 2 * 33 + 2 * 15) && count_in(&im, RED, 16, 8, 48, 8) == 33 &&
           count_in(&im, RED, 16, 24, 48, 24) == 33 && count_in(&im, RED, 16, 9, 16, 23) == 15 &&
           count_in(&im, RED, 48, 9, 48, 23) == 15,
       "a_frame_is_where_the_map_ends");
    image_free(&im);
}

/* The rows of the rectangle run down and its columns to the left: x is 1/2 - down / 4, y is 1/16 + across / 4. */
static void a_quarter_turn(void)
{
    const gn_rectangle r = {0, UNIT, {UNIT / 16, -UNIT / 2}, {UNIT / 4, UNIT / 4}}; /* y 4 to 20, x 32 to 16 */
    /* two columns of texels, at y 4 + 16 / 4 = 8 and 4 + 16 / 2 = 12, one row at x 32 - 16 / 4 = 28 */
    uint32_t places[2][2] = {{share(0.25), share(0.25)}, {share(0.5), share(0.25)}};
    image im = grid_picture(flat, WIDTH, HEIGHT, &r, places, 2, 1);
    ok(count_is(&im, BLUE, 5) && count_in(&im, BLUE, 28, 8, 28, 12) == 5 && count_is(&im, ORANGE, 0),
       "a_turned_row_runs_down");
    ok(count_is(&im, RED, 2 * 17 + 2 * 15) && count_in(&im, RED, 16, 4, 32, 20) == 2 * 17 + 2 * 15,
       "a_turned_frame_lies_about_it");
    image_free(&im);
}

/* A rectangle of the plane's size, an eighth of its longer side above and to the left of it. */
static void beyond_the_plane(void)
{
    const gn_rectangle r = {UNIT, 0, {-UNIT / 8, -UNIT / 8}, {UNIT - 1, UNIT / 2}};
    uint32_t places[4][2] = {{0, share(0.5)}, {share(0.5), share(0.5)}, {0, share(0.75)}, {share(0.5), share(0.75)}};
    /* a column at x -8 and one a little before 24, rows at y 8 and 16 */
    image im = grid_picture(flat, WIDTH, HEIGHT, &r, places, 2, 2);
    ok(count_is(&im, BLUE, 2 * 24) && count_in(&im, BLUE, 0, 8, 23, 8) == 24 && count_is(&im, ORANGE, 7),
       "lines_end_at_the_planes_borders");
    /* its right and its lower side: x 55, y 24 */
    ok(count_is(&im, RED, 25 + 55), "and_so_does_the_frame");
    image_free(&im);
}

/* Of 131 columns every third and the last: 0, 3, ..., 129, 130. */
static void many_columns(void)
{
    enum { COLUMNS = 131, SIDE = 393 };
    static gn_depth wide[SIDE * 4];
    static uint32_t places[2 * COLUMNS][2];
    const gn_rectangle r = {UNIT, 0, {0, 0}, {UNIT - 1, UNIT / 100}};
    int good = 1;
    for (uint32_t i = 0; i < 2 * COLUMNS; i++) {
        places[i][0] = share((i % COLUMNS + 0.5) / COLUMNS);
        places[i][1] = share(i / COLUMNS ? 0.9 : 0.1);
    }
    image im = grid_picture(wide, SIDE, 4, &r, places, COLUMNS, 2);
    for (uint32_t i = 0; i < COLUMNS; i++) /* the centre of a column of 3 pixels; rows are the first and the last */
        good = good && (kind_of(&im, 3 * i + 1, 1) == ORANGE) == (i % 3 == 0 || i == COLUMNS - 1);
    ok(good && count_in(&im, ORANGE, 0, 1, SIDE - 1, 1) == 45, "of_many_columns_some_and_the_last_are_drawn");
    image_free(&im);
}

static void sizes(void)
{
    static const struct {
        gn_light light;
        uint16_t width, height;
    } cases[] = {
        {{.kind = GN_DIRECTIONAL, .box_width = 2000, .box_height = 500}, 1024, 256},
        {{.kind = GN_DIRECTIONAL, .box_width = 300, .box_height = 400}, 768, 1024},
        {{.kind = GN_DIRECTIONAL, .box_width = 1 << 28, .box_height = 1}, 1024, 1},
        {{.kind = GN_SPOT}, 1024, 1024},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        uint16_t size[2];
        grid_picture_size(&cases[i].light, size);
        ok(size[0] == cases[i].width && size[1] == cases[i].height, "a_plane_of_%d_x_%d_has_%d_x_%d_pixels",
           (int)cases[i].light.box_width, (int)cases[i].light.box_height, cases[i].width, cases[i].height);
    }
}

int main(void)
{
    a_grid();
    a_quarter_turn();
    beyond_the_plane();
    many_columns();
    sizes();
    return tap_done();
}
