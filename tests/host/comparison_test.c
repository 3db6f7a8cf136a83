/* A mask against the truth: figures worked out by hand, and against the obvious way on random masks. */
#include "comparison.h"
#include "core/tap.h"

#include <math.h>
#include <string.h>
#include <time.h>

enum { MOST_PIXELS = 400 };

/* Letters for a mask: L lit, S shadowed, a blank no surface. */
static const uint8_t *letters(uint8_t *mask, const char *text)
{
    for (size_t i = 0; text[i]; i++)
        mask[i] = text[i] == 'L' ? 254 : text[i] == 'S' ? 0 : 255;
    return mask;
}

static int close_to(double got, double expected)
{
    return fabs(got - expected) <= 1e-12 * (1 + fabs(expected));
}

/* Equal as a whole, NAN to NAN. */
static int same(double got, double expected)
{
    return isnan(expected) ? isnan(got) : close_to(got, expected);
}

static int errors_are(const char *what, const comparison_errors *got, const comparison_errors *expected)
{
    int where = isnan(expected->worst) || (got->worst_x == expected->worst_x && got->worst_y == expected->worst_y);
    int good = got->pixels == expected->pixels && got->in_edge_band == expected->in_edge_band &&
               got->in_interior == expected->in_interior && same(got->mean, expected->mean) &&
               same(got->percentile_95, expected->percentile_95) && same(got->worst, expected->worst) && where;
    const comparison_errors *both[2] = {got, expected};
    for (int i = 0; !good && i < 2; i++)
        note("%s, %s: %d pixels, %d + %d, mean %.17g, 95 %% %.17g, worst %.17g at %u, %u", what, i ? "expected" : "got",
             (int)both[i]->pixels, (int)both[i]->in_edge_band, (int)both[i]->in_interior, both[i]->mean,
             both[i]->percentile_95, both[i]->worst, both[i]->worst_x, both[i]->worst_y);
    return good;
}

/* Upper left a lit and a shadowed block, side by side; below them a lit row; the edge runs down the blocks' border and
 * right along the row. The shadowed block's right side borders on no surface: no edge. */
static const char hand_truth[] = "LLLSSS "
                                 "LLLSSS "
                                 "LLLSSS "
                                 "LLLLLLL";
static const char hand_mask[] = "SLSSSL "
                                "LLLSLSL"
                                "LL SSS "
                                "SLLLLLS";

static comparison_input hand_input(uint8_t masks[2][28])
{
    return (comparison_input){7, 4, letters(masks[0], hand_mask), letters(masks[1], hand_truth), 0, 2};
}

static void by_hand(void)
{
    uint8_t masks[2][28];
    comparison_input input = hand_input(masks);
    comparison c;
    comparison_make(&c, &input);
    const comparison_figures *f = &c.all;
    ok(f->surface == 25 && f->lit == 16 && f->shadowed == 9, "truly_lit_and_truly_shadowed_pixels_are_counted");
    ok(f->coverage == 2, "a_surface_in_one_mask_only_is_counted_apart");
    ok(f->in_edge_band == 20, "the_edge_band_is_as_wide_as_by_hand");
    /* (0, 0) 5/2 left of (2.5, 0); (2, 0) 1/2; (0, 3) from (2.5, 2); (6, 3) from (5, 2.5). */
    comparison_errors shadow = {4, 2, 2, 0, sqrt(7.25), sqrt(7.25), 0, 3};
    shadow.mean = (2.5 + 0.5 + sqrt(7.25) + sqrt(1.25)) / 4;
    ok(errors_are("false shadow", &f->false_shadow, &shadow), "false_shadow_and_its_distances_are_as_by_hand");
    /* (5, 0) is 5/2 from (2.5, 0) and from (5, 2.5), (4, 1) 3/2 from both. */
    comparison_errors light = {2, 1, 1, 2, 2.5, 2.5, 5, 0};
    ok(errors_are("false light", &f->false_light, &light), "false_light_and_its_distances_are_as_by_hand");
    comparison_errors together = {6, 3, 3, (4 * shadow.mean + 4) / 6, sqrt(7.25), sqrt(7.25), 0, 3};
    ok(errors_are("together", &f->together, &together), "both_together_are_as_by_hand");
    ok(close_to(comparison_percent(f, f->false_shadow.pixels), 16), "per_cents_are_of_the_surface_in_truth");
    /* 6 wrong of the 24 that see a surface in both. */
    ok(close_to(f->mean_absolute_error, 0.25), "the_mean_absolute_error_of_a_hard_mask_is_its_share_of_wrong_pixels");
    ok(c.has_edge && !c.has_near && memcmp(&c.all, &c.not_near, sizeof c.all) == 0,
       "without_a_near_mask_all_pixels_are_decided");
}

static void near_pixels(void)
{
    uint8_t masks[2][28], near[28] = {0};
    comparison_input input = hand_input(masks);
    comparison before, c;
    comparison_make(&before, &input);
    near[0] = 255;       /* false shadow */
    near[5] = 255;       /* false light */
    near[13] = 255;      /* no surface in truth, one in the mask */
    near[8] = 255;       /* lit in both */
    near[3 * 7 + 6] = 1; /* any value but 0 counts: false shadow */
    input.near = near;
    comparison_make(&c, &input);
    const comparison_figures *f = &c.not_near;
    ok(c.has_near && memcmp(&c.all, &before.all, sizeof c.all) == 0, "a_near_mask_does_not_change_the_figures_of_all");
    ok(f->surface == 21 && f->lit == 13 && f->shadowed == 8 && f->coverage == 1,
       "near_pixels_leave_both_numbers_of_a_per_cent");
    comparison_errors shadow = {2, 1, 1, (0.5 + sqrt(7.25)) / 2, sqrt(7.25), sqrt(7.25), 0, 3};
    comparison_errors light = {1, 1, 0, 1.5, 1.5, 1.5, 4, 1};
    ok(errors_are("false shadow", &f->false_shadow, &shadow) && errors_are("false light", &f->false_light, &light),
       "errors_without_near_pixels_are_as_by_hand");
    ok(close_to(f->mean_absolute_error, 3.0 / 20), "the_mean_absolute_error_is_without_them_too");
}

/* A row: one shadowed pixel, then lit ones; the n pixels after it are false shadow, 0.5, 1.5, ... pixels away. */
static void nearest_rank(void)
{
    static const struct {
        int wrong;
        double expected;
    } cases[] = {{1, 0.5}, {2, 1.5}, {19, 18.5}, {20, 18.5}, {21, 19.5}, {40, 37.5}, {100, 94.5}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        uint8_t mask[128], truth[128];
        memset(truth, 254, sizeof truth);
        memset(mask, 254, sizeof mask);
        truth[0] = 0;
        memset(mask, 0, (size_t)cases[i].wrong + 1);
        comparison_input input = {128, 1, mask, truth, 0, 2};
        comparison c;
        comparison_make(&c, &input);
        double got = c.all.false_shadow.percentile_95;
        if (!ok(same(got, cases[i].expected), "95_per_cent_of_%d_is_by_nearest_rank", cases[i].wrong))
            note("got %g, expected %g", got, cases[i].expected);
    }
}

static void the_edge_band(void)
{
    static const struct {
        double band;
        unsigned inside;
    } cases[] = {{0, 0}, {0.49, 0}, {0.5, 1}, {1.49, 1}, {1.5, 2}, {2, 2}, {2.5, 3}, {6000, 7}, {1e300, 7}};
    uint8_t masks[2][8];
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        comparison_input input = {8, 1, letters(masks[0], "SSSSSSSS"), letters(masks[1], "SLLLLLLL"), 0, cases[i].band};
        comparison c;
        comparison_make(&c, &input);
        ok(c.all.false_shadow.in_edge_band == cases[i].inside && c.all.false_shadow.in_interior == 7 - cases[i].inside,
           "an_edge_band_of_%g_holds_what_is_at_most_so_far", cases[i].band);
    }
}

static void no_edge(void)
{
    uint8_t masks[2][4];
    static const char *const truths[] = {"LLLL", "L SS", "    "};
    for (int i = 0; i < 3; i++) {
        comparison_input input = {4, 1, letters(masks[0], "SSSL"), letters(masks[1], truths[i]), 0, 6000};
        comparison c;
        comparison_make(&c, &input);
        const comparison_errors *e = &c.all.together;
        ok(!c.has_edge && e->in_edge_band == 0 && e->in_interior == e->pixels && isnan(e->mean) &&
               isnan(e->percentile_95) && isnan(e->worst) && c.all.in_edge_band == 0,
           "the_truth_'%s'_has_no_shadow_edge_and_no_distances", truths[i]);
    }
}

static void filtered_values(void)
{
    /* 127 of 254 off twice, 2 once, 252 once, 0 once; the last two do not see a surface in both. */
    static const uint8_t mask[7] = {127, 127, 252, 252, 64, 255, 9}, truth[7] = {0, 254, 254, 0, 64, 254, 255};
    comparison_input input = {7, 1, mask, truth, 0, 2};
    comparison c;
    comparison_make(&c, &input);
    ok(close_to(c.all.mean_absolute_error, (127 + 127 + 2 + 252) / (254.0 * 5)),
       "the_mean_absolute_error_is_of_the_lit_fraction");
    ok(c.all.false_light.pixels == 2 && c.all.false_shadow.pixels == 0, "a_half_lit_pixel_is_lit");
    input.mask = truth + 6;
    input.width = 1;
    comparison_make(&c, &input);
    ok(isnan(c.all.mean_absolute_error), "without_a_surface_in_both_there_is_no_mean");
}

static void the_picture(void)
{
    /* lit, shadowed, false shadow, false light, mask only, truth only, nothing; the same near a tie. */
    uint8_t masks[2][14], near[14] = {0};
    memset(near + 7, 255, 7);
    comparison_input input = {7, 2, letters(masks[0], "LSSLL  LSSLL  "), letters(masks[1], "LSLS L LSLS L "), near, 2};
    static const uint8_t expected[14][3] = {
        {190, 190, 190}, {90, 90, 90}, {220, 30, 30},  {40, 80, 255},  {220, 40, 220}, {220, 40, 220}, {20, 20, 20},
        {190, 190, 190}, {90, 90, 90}, {240, 220, 40}, {240, 220, 40}, {240, 220, 40}, {240, 220, 40}, {20, 20, 20}};
    image picture = comparison_picture(&input);
    ok(picture.width == 7 && picture.height == 2 && memcmp(picture.samples, expected, sizeof expected) == 0,
       "the_picture_shows_red_blue_magenta_and_yellow_for_ties");
    image_free(&picture);
}

/* ---- the obvious way --------------------------------------------------------------------------------------------- */

static int lit(uint8_t value)
{
    return value >= 127;
}

static double plain_distance(const comparison_input *in, int x, int y)
{
    double nearest = HUGE_VAL;
    int width = (int)in->width, height = (int)in->height;
    for (int i = 0; i < width * height; i++)
        for (int direction = 0; direction < 2; direction++) {
            int u = i % width, v = i / width, beside = direction ? i + width : i + 1;
            if (direction ? v + 1 == height : u + 1 == width)
                continue;
            uint8_t a = in->truth[i], b = in->truth[beside];
            if (a == 255 || b == 255 || lit(a) == lit(b))
                continue;
            nearest = fmin(nearest, hypot(direction ? u - x : u + 0.5 - x, direction ? v + 0.5 - y : v - y));
        }
    return nearest;
}

static int ascending(const void *a, const void *b)
{
    double first = *(const double *)a, second = *(const double *)b;
    return (first > second) - (first < second);
}

static comparison_errors plain_errors(const comparison_input *in, int without_near, int shadows, int lights)
{
    double distances[MOST_PIXELS], sum = 0;
    comparison_errors e = {.mean = NAN, .percentile_95 = NAN, .worst = NAN};
    for (uint32_t i = 0; i < in->width * in->height; i++) {
        if ((without_near && in->near[i]) || in->mask[i] == 255 || in->truth[i] == 255 ||
            lit(in->mask[i]) == lit(in->truth[i]) || !(lit(in->truth[i]) ? shadows : lights))
            continue;
        double d = plain_distance(in, (int)(i % in->width), (int)(i / in->width));
        if (e.pixels == 0 || d > e.worst + 1e-9) {
            e.worst = d;
            e.worst_x = i % in->width;
            e.worst_y = i / in->width;
        }
        e.in_edge_band += d <= in->edge_band;
        sum += d;
        distances[e.pixels++] = d;
    }
    e.in_interior = e.pixels - e.in_edge_band;
    if (isinf(e.worst))
        e.worst = NAN;
    if (isnan(e.worst))
        return e;
    qsort(distances, e.pixels, sizeof *distances, ascending);
    e.mean = sum / (double)e.pixels;
    e.percentile_95 = distances[(size_t)ceil((double)e.pixels * 95 / 100) - 1];
    return e;
}

static int matches_plain(const comparison_input *in)
{
    comparison c;
    comparison_make(&c, in);
    int good = 1;
    for (int without_near = 0; without_near < 2; without_near++) {
        const comparison_figures *f = without_near ? &c.not_near : &c.all;
        comparison_errors shadow = plain_errors(in, without_near, 1, 0), light = plain_errors(in, without_near, 0, 1),
                          both = plain_errors(in, without_near, 1, 1);
        good &= errors_are("false shadow", &f->false_shadow, &shadow) &&
                errors_are("false light", &f->false_light, &light) && errors_are("together", &f->together, &both);
    }
    return good;
}

static void random_masks(uint64_t cases)
{
    uint64_t seed = 7, failed = 0, with_edge = 0;
    for (uint64_t n = 0; n < cases && !failed; n++) {
        uint8_t mask[MOST_PIXELS], truth[MOST_PIXELS], near[MOST_PIXELS];
        uint32_t width = 1 + (uint32_t)(tap_random(&seed) % 20), height = 1 + (uint32_t)(tap_random(&seed) % 20);
        uint64_t rarity = 2 + tap_random(&seed) % 40; /* of shadows */
        for (uint32_t i = 0; i < width * height; i++) {
            truth[i] = tap_random(&seed) % 9 == 0 ? 255 : tap_random(&seed) % rarity ? 254 : 0;
            mask[i] = tap_random(&seed) % 9 == 0 ? 255 : tap_random(&seed) % 3 ? truth[i] : tap_random(&seed) & 255;
            near[i] = tap_random(&seed) % 5 == 0 ? 255 : 0;
        }
        comparison_input input = {width, height, mask, truth, near, (double)(tap_random(&seed) % 9) / 2};
        with_edge += plain_distance(&input, 0, 0) < HUGE_VAL;
        failed = !matches_plain(&input);
    }
    ok(!failed && with_edge > cases / 2, "random_masks_are_counted_as_by_the_obvious_way");
}

/* Upright stripes of 64 pixels, the first lit, the last shadowed, and a mask that is lit throughout. All but the last
 * shadowed stripe have an edge on both sides: distances up to 31.5, mean 16; the last up to 63.5, mean 32. */
static void the_largest_image(void)
{
    enum { SIDE = 4096, STRIPE = 64 };
    size_t count = (size_t)SIDE * SIDE;
    uint8_t *mask = malloc(count), *truth = malloc(count);
    if (!mask || !truth)
        exit(1);
    memset(mask, 254, count);
    for (size_t i = 0; i < count; i++)
        truth[i] = i / STRIPE % 2 ? 0 : 254;
    comparison_input input = {SIDE, SIDE, mask, truth, 0, 2};
    comparison c;
    clock_t start = clock();
    comparison_make(&c, &input);
    note("4096 x 4096 pixels: %.2f s", (double)(clock() - start) / CLOCKS_PER_SEC);
    /* A row's 2048 errors: 63 at 0.5, 1.5, ... 31.5 each, then one at a time. The 1946th, counted as one of all rows,
     * is among the 31 x 63 = 1953 up to 30.5. In the band: 2 x 31 stripes' sides and one, 2 pixels each. */
    comparison_errors expected = {count / 2, 126 * SIDE, count / 2 - 126 * SIDE, (31 * 16 + 32) / 32.0, 30.5, 63.5,
                                  SIDE - 1,  0};
    ok(errors_are("false light", &c.all.false_light, &expected) && c.all.false_shadow.pixels == 0,
       "the_largest_image_is_counted_right");
    free(mask);
    free(truth);
}

int main(int argc, char **argv)
{
    by_hand();
    near_pixels();
    nearest_rank();
    the_edge_band();
    no_edge();
    filtered_values();
    the_picture();
    random_masks(tap_cases(argc, argv, 500));
    the_largest_image();
    return tap_done();
}
