/* The distance transform against the obvious way: from every pixel to every point of the edges. */
#include "core/tap.h"
#include "distance.h"

#include <string.h>

enum { MOST_SIDE = 24, MOST_PIXELS = MOST_SIDE * MOST_SIDE };

/* In half pixels. */
static uint32_t squared_to(uint32_t x, uint32_t y, uint32_t edge_x, uint32_t edge_y)
{
    int32_t across = (int32_t)(2 * x) - (int32_t)edge_x, down = (int32_t)(2 * y) - (int32_t)edge_y;
    return (uint32_t)(across * across + down * down);
}

static uint32_t least(uint32_t a, uint32_t b)
{
    return a < b ? a : b;
}

static uint32_t plain_distance(uint32_t x, uint32_t y, const uint8_t *edges, uint32_t width, uint32_t height)
{
    uint32_t nearest = DISTANCE_NONE;
    for (uint32_t v = 0; v < height; v++)
        for (uint32_t u = 0; u < width; u++) {
            uint8_t edge = edges[v * width + u];
            if ((edge & DISTANCE_EDGE_RIGHT) && u + 1 < width)
                nearest = least(nearest, squared_to(x, y, 2 * u + 1, 2 * v));
            if ((edge & DISTANCE_EDGE_BELOW) && v + 1 < height)
                nearest = least(nearest, squared_to(x, y, 2 * u, 2 * v + 1));
        }
    return nearest;
}

static int matches_plain(const uint8_t *edges, uint32_t width, uint32_t height)
{
    uint32_t squared[MOST_PIXELS];
    int has_edge = distance_to_edges(squared, edges, width, height), expected_edge = 0;
    for (uint32_t y = 0; y < height; y++)
        for (uint32_t x = 0; x < width; x++) {
            uint32_t expected = plain_distance(x, y, edges, width, height);
            expected_edge |= expected != DISTANCE_NONE;
            if (squared[y * width + x] != expected) {
                note("%u x %u, pixel %u, %u: got %u, expected %u", width, height, x, y, squared[y * width + x],
                     expected);
                return 0;
            }
        }
    if (has_edge != expected_edge)
        note("%u x %u: says %d of whether there is an edge", width, height, has_edge);
    return has_edge == expected_edge;
}

/* One in `rarity` pixels has an edge on each of its two sides; what is set outside of the image must not count. */
static void draw(uint8_t *edges, uint32_t count, uint64_t rarity, uint64_t *seed)
{
    for (uint32_t i = 0; i < count; i++)
        edges[i] = (uint8_t)((tap_random(seed) % rarity == 0 ? DISTANCE_EDGE_RIGHT : 0) |
                             (tap_random(seed) % rarity == 0 ? DISTANCE_EDGE_BELOW : 0));
}

static void random_edges(uint64_t cases)
{
    static const struct {
        const char *promise;
        uint32_t least_width, most_width, least_height, most_height;
    } shapes[] = {
        {"any_shape", 1, MOST_SIDE, 1, MOST_SIDE},
        {"a_row", 1, MOST_PIXELS, 1, 1},
        {"a_column", 1, 1, 1, MOST_PIXELS},
        {"one_pixel", 1, 1, 1, 1},
    };
    static const uint64_t rarities[] = {1, 2, 10, 100, 1000};
    for (size_t i = 0; i < sizeof shapes / sizeof *shapes; i++) {
        uint64_t seed = i, failed = 0;
        for (uint64_t n = 0; n < cases && !failed; n++) {
            uint8_t edges[MOST_PIXELS];
            uint32_t width = shapes[i].least_width +
                             (uint32_t)(tap_random(&seed) % (shapes[i].most_width - shapes[i].least_width + 1));
            uint32_t height = shapes[i].least_height +
                              (uint32_t)(tap_random(&seed) % (shapes[i].most_height - shapes[i].least_height + 1));
            draw(edges, width * height, rarities[n % 5], &seed);
            failed = !matches_plain(edges, width, height);
        }
        ok(!failed, "distances_in_%s_are_those_of_the_obvious_way", shapes[i].promise);
    }
}

static void no_edge(void)
{
    uint8_t edges[12] = {0};
    uint32_t squared[12];
    int all = !distance_to_edges(squared, edges, 4, 3);
    for (int i = 0; i < 12; i++)
        all &= squared[i] == DISTANCE_NONE;
    ok(all, "without_an_edge_there_is_no_distance");
}

/* Right of the middle pixel, 3 x 3, by hand: the point is at (3, 2) in half pixels. */
static void by_hand(void)
{
    static const uint8_t edges[9] = {0, 0, 0, 0, DISTANCE_EDGE_RIGHT, 0, 0, 0, 0};
    static const uint32_t expected[9] = {13, 5, 5, 9, 1, 1, 13, 5, 5};
    uint32_t squared[9];
    ok(distance_to_edges(squared, edges, 3, 3) && memcmp(squared, expected, sizeof expected) == 0,
       "distances_are_half_a_pixel_beside_the_edge_and_exact_elsewhere");
}

/* The longest distances that can be: an edge in one corner of the largest image. */
static void the_largest_image(void)
{
    enum { SIDE = 4096 };
    size_t count = (size_t)SIDE * SIDE, wrong = 0;
    uint8_t *edges = calloc(count, 1);
    uint32_t *squared = malloc(count * sizeof *squared);
    if (!edges || !squared)
        exit(1);
    edges[0] = DISTANCE_EDGE_RIGHT;
    distance_to_edges(squared, edges, SIDE, SIDE);
    for (uint32_t y = 0; y < SIDE; y++)
        for (uint32_t x = 0; x < SIDE; x++)
            wrong += squared[(size_t)y * SIDE + x] != squared_to(x, y, 1, 0);
    ok(!wrong, "the_largest_image_has_exact_distances_up_to_its_far_corner");
    free(edges);
    free(squared);
}

int main(int argc, char **argv)
{
    by_hand();
    no_edge();
    random_edges(tap_cases(argc, argv, 1000));
    the_largest_image();
    return tap_done();
}
