/* gnomon compare on masks of a few pixels, against counts done by hand. */
#include "sandbox.h"

/* Sixteen pixels: two of no surface in both, one in each alone; 12 seen in truth and mask, 13 in truth. */
static const char truth[] = "P5\n8 2\n255\n\0\0\0\0\0\0\376\376\376\376\376\376\377\377\377\376";
static const char mask[] = "P5\n8 2\n255\n\0\0\0\0\376\177\0\176\376\376\376\376\377\377\0\377";
enum { MASK_SIZE = 27 };

static int compare(const char *const options[])
{
    const char *arguments[9] = {sandbox_path("in-mask.pgm"), sandbox_path("in-truth.pgm"), 0};
    for (int i = 0; options[i] && i < 6; i++)
        arguments[2 + i] = options[i];
    return sandbox_run(command_compare, arguments);
}

static void read_output(const char *name, char *text, size_t size)
{
    FILE *file = fopen(sandbox_path(name), "rb");
    size_t got = file ? fread(text, 1, size - 1, file) : 0;
    text[got] = 0;
    if (file)
        fclose(file);
}

static void counts(void)
{
    char text[2000];
    const char *options[] = {"--json", sandbox_path("in.json"), "--max-coverage", "100", 0};
    ok(compare(options) == EXIT_DIFFERS, "masks_that_differ_give_status_1");
    read_output("in.json", text, sizeof text);
    static const char *const expected[] = {
        "\"surface_pixels\": 13,", "\"truly_lit\": 7,",        "\"truly_shadowed\": 6,",         "\"false_shadow\": 2,",
        "\"false_light\": 2,",     "\"coverage_differs\": 2,", "\"error_percent\": 30.7692308,", "\"equal\": false"};
    for (size_t i = 0; i < sizeof expected / sizeof *expected; i++)
        if (!ok(strstr(text, expected[i]) != 0, "json_says_%s", expected[i]))
            note("%s", text);
}

static void limits(void)
{
    const char *loose[] = {"--max-error", "30.8", "--max-coverage", "15.4", 0};
    const char *tight[] = {"--max-error", "30.7", "--max-coverage", "15.4", 0};
    const char *coverage[] = {"--max-error", "30.8", "--max-coverage", "15.3", 0};
    ok(compare(loose) == EXIT_DONE, "an_error_within_the_limits_gives_status_0");
    ok(compare(tight) == EXIT_DIFFERS, "an_error_above_the_limit_gives_status_1");
    ok(compare(coverage) == EXIT_DIFFERS, "a_coverage_above_the_limit_gives_status_1");
}

static void the_difference_picture(void)
{
    char text[200];
    const char *options[] = {"--difference", sandbox_path("in-difference.ppm"), 0};
    compare(options);
    FILE *file = fopen(sandbox_path("in-difference.ppm"), "rb");
    size_t size = file ? fread(text, 1, sizeof text, file) : 0;
    if (file)
        fclose(file);
    const uint8_t *p = (const uint8_t *)text + 11;
    ok(size == 11 + 48 && memcmp(text, "P6\n8 2\n255\n", 11) == 0, "the_difference_is_a_ppm_of_the_same_size");
    ok(p[3 * 4 + 2] > p[3 * 4] && p[3 * 5 + 2] > p[3 * 5], "false_light_is_blue");
    ok(p[3 * 6] > p[3 * 6 + 2] && p[3 * 7] > p[3 * 7 + 2], "false_shadow_is_red");
    ok(p[0] == p[1] && p[1] == p[2] && p[24] == p[25] && p[24] > p[0] && p[36] < p[0],
       "agreement_is_grey_and_no_surface_dark");
}

static void senseless_comparisons(void)
{
    static const char *const none[] = {0}, *const allow[] = {"--allow-vacuous", 0};
    sandbox_write("in-mask.pgm", "P5\n2 1\n255\n\376\376", 13);
    sandbox_write("in-truth.pgm", "P5\n2 1\n255\n\376\376", 13);
    ok(compare(none) == EXIT_BAD_INPUT && strstr(sandbox_message, "no shadowed pixel"),
       "a_truth_without_shadow_is_refused");
    ok(compare(allow) == EXIT_DONE, "unless_it_is_allowed");
    sandbox_write("in-truth.pgm", "P5\n2 1\n255\n\0\0", 13);
    ok(compare(none) == EXIT_BAD_INPUT && strstr(sandbox_message, "no lit pixel"), "a_truth_without_light_is_refused");
    sandbox_write("in-truth.pgm", "P5\n2 1\n255\n\377\377", 13);
    ok(compare(none) == EXIT_BAD_INPUT && strstr(sandbox_message, "no lit and no shadowed"),
       "a_truth_without_surface_is_refused");
    sandbox_write("in-truth.pgm", "P5\n1 1\n255\n\0", 12);
    ok(compare(none) == EXIT_BAD_INPUT && strstr(sandbox_message, "expected the same size"),
       "masks_of_two_sizes_are_refused");
}

static void bad_usage(void)
{
    static const char *const cases[][4] = {
        {"--max-error", 0},     {"--max-error", "many", 0}, {"--max-error", "-1", 0},
        {"--max-error=101", 0}, {"--nonsense", 0},          {"third.pgm", 0},
        {"--json", 0},          {"--allow-vacuous=yes", 0}, {"--difference", "nowhere/at/all.ppm", 0},
    };
    sandbox_write("in-mask.pgm", mask, MASK_SIZE);
    sandbox_write("in-truth.pgm", truth, MASK_SIZE);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        ok(compare(cases[i]) == EXIT_BAD_INPUT && strstr(sandbox_message, "expected"),
           "compare_with_%s_%s_is_bad_usage", cases[i][0], cases[i][1] ? cases[i][1] : "alone");
}

int main(void)
{
    sandbox_open();
    sandbox_write("in-mask.pgm", mask, MASK_SIZE);
    sandbox_write("in-truth.pgm", truth, MASK_SIZE);
    counts();
    limits();
    the_difference_picture();
    senseless_comparisons();
    bad_usage();
    sandbox_close();
    return tap_done();
}
