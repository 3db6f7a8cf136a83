/* gnomon compare on masks of a few pixels, against counts done by hand: what it says, writes and refuses. The figures
 * themselves are the subject of comparison_test.c. */
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

static size_t read_difference(char *text, size_t room)
{
    FILE *file = fopen(sandbox_path("in-difference.ppm"), "rb");
    size_t size = file ? fread(text, 1, room, file) : 0;
    if (file)
        fclose(file);
    return size;
}

static void the_difference_picture(void)
{
    char text[200];
    const char *options[] = {"--difference", sandbox_path("in-difference.ppm"), 0};
    compare(options);
    size_t size = read_difference(text, sizeof text);
    const uint8_t *p = (const uint8_t *)text + 11;
    ok(size == 11 + 48 && memcmp(text, "P6\n8 2\n255\n", 11) == 0, "the_difference_is_a_ppm_of_the_same_size");
    ok(p[3 * 4 + 2] > p[3 * 4] && p[3 * 5 + 2] > p[3 * 5], "false_light_is_blue");
    ok(p[3 * 6] > p[3 * 6 + 2] && p[3 * 7] > p[3 * 7 + 2], "false_shadow_is_red");
    ok(p[0] == p[1] && p[1] == p[2] && p[24] == p[25] && p[24] > p[0] && p[36] < p[0],
       "agreement_is_grey_and_no_surface_dark");
    ok(p[42] > p[43] && p[44] > p[43] && p[45] > p[46] && p[47] > p[46], "a_surface_in_one_mask_only_is_magenta");
}

/* ---- near a tie ------------------------------------------------------------------------------------------------- */

/* In truth S L L L L . L S: edges at 0.5 and 6.5. In the mask S S L L S L L L. Near a tie: the false shadow at the edge
 * and the surface that is in the mask only. */
static const char row_truth[] = "P5\n8 1\n255\n\0\376\376\376\376\377\376\0";
static const char row_mask[] = "P5\n8 1\n255\n\0\0\376\376\0\376\376\376";
static const char row_near[] = "P5\n8 1\n255\n\0\377\0\0\0\377\0\0";
enum { ROW_SIZE = 19 };

static void write_row(void)
{
    sandbox_write("in-mask.pgm", row_mask, ROW_SIZE);
    sandbox_write("in-truth.pgm", row_truth, ROW_SIZE);
    sandbox_write("in-near.pgm", row_near, ROW_SIZE);
}

static const char row_json[] = "{\n"
                               "  \"edge_band\": 2,\n"
                               "  \"truth_has_edge\": true,\n"
                               "  \"surface_pixels\": 7,\n"
                               "  \"truly_lit\": 5,\n"
                               "  \"truly_shadowed\": 2,\n"
                               "  \"surface_in_edge_band\": 5,\n"
                               "  \"false_shadow\": 2,\n"
                               "  \"false_light\": 1,\n"
                               "  \"false_shadow_percent\": 28.5714286,\n"
                               "  \"false_light_percent\": 14.2857143,\n"
                               "  \"error_percent\": 42.8571429,\n"
                               "  \"mean_absolute_error\": 0.428571429,\n"
                               "  \"coverage_differs\": 1,\n"
                               "  \"coverage_differs_percent\": 14.2857143,\n"
                               "  \"false_shadow_to_edge\": {\n"
                               "    \"in_edge_band\": 1,\n"
                               "    \"in_interior\": 1,\n"
                               "    \"in_edge_band_percent\": 14.2857143,\n"
                               "    \"in_interior_percent\": 14.2857143,\n"
                               "    \"mean\": 1.5,\n"
                               "    \"percentile_95\": 2.5,\n"
                               "    \"worst\": 2.5,\n"
                               "    \"worst_x\": 4,\n"
                               "    \"worst_y\": 0\n"
                               "  },\n"
                               "  \"false_light_to_edge\": {\n"
                               "    \"in_edge_band\": 1,\n"
                               "    \"in_interior\": 0,\n"
                               "    \"in_edge_band_percent\": 14.2857143,\n"
                               "    \"in_interior_percent\": 0,\n"
                               "    \"mean\": 0.5,\n"
                               "    \"percentile_95\": 0.5,\n"
                               "    \"worst\": 0.5,\n"
                               "    \"worst_x\": 7,\n"
                               "    \"worst_y\": 0\n"
                               "  },\n"
                               "  \"error_to_edge\": {\n"
                               "    \"in_edge_band\": 2,\n"
                               "    \"in_interior\": 1,\n"
                               "    \"in_edge_band_percent\": 28.5714286,\n"
                               "    \"in_interior_percent\": 14.2857143,\n"
                               "    \"mean\": 1.16666667,\n"
                               "    \"percentile_95\": 2.5,\n"
                               "    \"worst\": 2.5,\n"
                               "    \"worst_x\": 4,\n"
                               "    \"worst_y\": 0\n"
                               "  },\n";

static const char row_json_near[] = "  \"near\": {\n"
                                    "    \"surface_pixels\": 1,\n"
                                    "    \"false_shadow\": 1,\n"
                                    "    \"false_light\": 0,\n"
                                    "    \"coverage_differs\": 1\n"
                                    "  },\n"
                                    "  \"not_near\": {\n"
                                    "    \"surface_pixels\": 6,\n"
                                    "    \"truly_lit\": 4,\n"
                                    "    \"truly_shadowed\": 2,\n"
                                    "    \"surface_in_edge_band\": 4,\n"
                                    "    \"false_shadow\": 1,\n"
                                    "    \"false_light\": 1,\n"
                                    "    \"false_shadow_percent\": 16.6666667,\n"
                                    "    \"false_light_percent\": 16.6666667,\n"
                                    "    \"error_percent\": 33.3333333,\n"
                                    "    \"mean_absolute_error\": 0.333333333,\n"
                                    "    \"coverage_differs\": 0,\n"
                                    "    \"coverage_differs_percent\": 0,\n"
                                    "    \"false_shadow_to_edge\": {\n"
                                    "      \"in_edge_band\": 0,\n"
                                    "      \"in_interior\": 1,\n"
                                    "      \"in_edge_band_percent\": 0,\n"
                                    "      \"in_interior_percent\": 16.6666667,\n"
                                    "      \"mean\": 2.5,\n";

static void what_is_written(void)
{
    char text[6000];
    size_t start = sizeof row_json - 1;
    write_row();
    const char *alone[] = {"--json", sandbox_path("in.json"), 0};
    compare(alone);
    read_output("in.json", text, sizeof text);
    if (!ok(strncmp(text, row_json, start) == 0 && strcmp(text + start, "  \"equal\": false\n}\n") == 0,
            "json_holds_all_figures"))
        note("%s", text);
    const char *with[] = {"--json", sandbox_path("in.json"), "--near", sandbox_path("in-near.pgm"), 0};
    compare(with);
    read_output("in.json", text, sizeof text);
    if (!ok(strncmp(text, row_json, start) == 0 &&
                strncmp(text + start, row_json_near, sizeof row_json_near - 1) == 0 &&
                strstr(text, "  },\n  \"equal\": false\n}\n"),
            "and_with_a_near_mask_those_near_and_not_near_a_tie"))
        note("%s", text);
}

static void what_is_printed(void)
{
    char text[4000];
    const char *options[] = {"--near", sandbox_path("in-near.pgm"), 0};
    static const char start[] =
        "surface 7 pixels, truly lit 5, truly shadowed 2\n"
        "false shadow 2 (28.5714 %), false light 1 (14.2857 %), together 42.8571 %\n"
        "surface in one mask only 1 (14.2857 %)\n"
        "mean absolute error 0.428571\n"
        "distance from the true shadow edge in pixels; edge band: to 2, 5 pixels of the surface\n"
        "                           edge band               interior      mean     95 %    worst\n"
        "  false shadow          1  14.2857 %           1  14.2857 %     1.500    2.500    2.500 at 4, 0\n"
        "  false light           1  14.2857 %           0   0.0000 %     0.500    0.500    0.500 at 7, 0\n"
        "  together              2  28.5714 %           1  14.2857 %     1.167    2.500    2.500 at 4, 0\n"
        "\n"
        "near a tie: 1 pixels that see a surface; of the above, false shadow 1, false light 0,\n"
        "surface in one mask only 1. Without them:\n"
        "\n"
        "surface 6 pixels, truly lit 4, truly shadowed 2\n"
        "false shadow 1 (16.6667 %), false light 1 (16.6667 %), together 33.3333 %\n";
    compare(options);
    read_output("in-output", text, sizeof text);
    if (!ok(strncmp(text, start, sizeof start - 1) == 0, "the_text_says_the_same"))
        note("%s", text);
}

static int compare_near(const char *max_error, const char *max_coverage)
{
    const char *options[] = {
        "--near", sandbox_path("in-near.pgm"), "--max-error", max_error, "--max-coverage", max_coverage, 0};
    return compare(options);
}

static void limits_leave_out_near_pixels(void)
{
    static const char *const alone[] = {"--max-error", "33.4", "--max-coverage", "100", 0};
    ok(compare(alone) == EXIT_DIFFERS, "without_a_near_mask_the_limits_are_for_all_pixels");
    ok(compare_near("33.4", "0") == EXIT_DONE, "with_one_they_are_for_those_not_near");
    ok(compare_near("33.3", "0") == EXIT_DIFFERS, "which_can_still_exceed_them");
}

static void ties_are_yellow(void)
{
    char text[11 + 24 + 1];
    const char *options[] = {"--difference", sandbox_path("in-difference.ppm"), "--near", sandbox_path("in-near.pgm"),
                             0};
    compare(options);
    size_t size = read_difference(text, sizeof text);
    const uint8_t *p = (const uint8_t *)text + 11;
    ok(size == 11 + 24 && p[3] > p[5] && p[4] > p[5] && memcmp(p + 3, p + 15, 3) == 0 && p[12] > 2 * p[13],
       "what_differs_near_a_tie_is_yellow_in_the_picture");
}

static void the_edge_band(void)
{
    char text[4000];
    const char *options[] = {"--json", sandbox_path("in.json"), "--edge-band", "2.5", 0};
    compare(options);
    read_output("in.json", text, sizeof text);
    ok(strstr(text, "\"edge_band\": 2.5,") && strstr(text, "\"surface_in_edge_band\": 7,") &&
           strstr(text, "\"in_edge_band\": 2,\n    \"in_interior\": 0,"),
       "the_edge_band_is_as_wide_as_asked_for");
}

static void no_edge(void)
{
    char text[4000];
    const char *options[] = {"--json", sandbox_path("in.json"), "--allow-vacuous", 0};
    sandbox_write("in-mask.pgm", "P5\n2 1\n255\n\0\376", 13);
    sandbox_write("in-truth.pgm", "P5\n2 1\n255\n\376\376", 13);
    compare(options);
    read_output("in.json", text, sizeof text);
    ok(strstr(text, "\"truth_has_edge\": false,") && strstr(text, "\"in_edge_band\": 0,\n    \"in_interior\": 1,") &&
           strstr(text, "\"mean\": null,\n    \"percentile_95\": null,\n    \"worst\": null,\n"
                        "    \"worst_x\": null,\n    \"worst_y\": null\n"),
       "without_an_edge_json_has_no_distances");
    read_output("in-output", text, sizeof text);
    ok(strstr(text, "no edge") != 0, "and_the_text_says_so");
}

static int compare_bad_near(void)
{
    const char *options[] = {"--near",       sandbox_path("in-bad.pgm"), "--json", sandbox_path("out.json"),
                             "--difference", sandbox_path("out.ppm"),    0};
    return compare(options);
}

/* Each is refused with the file's name, and nothing is written. */
static void bad_near_masks(void)
{
    static const struct {
        const char *promise, *bytes;
        size_t size;
        const char *what;
    } cases[] = {
        {"of_another_size", "P5\n7 1\n255\n\0\0\0\0\0\0\0", 18,
         "is 7 x 1 pixels, the truth 8 x 1; expected the same size"},
        {"turned_round", "P5\n1 8\n255\n\0\0\0\0\0\0\0\0", 19,
         "is 1 x 8 pixels, the truth 8 x 1; expected the same size"},
        {"that_is_a_shadow_mask", row_truth, ROW_SIZE, "has 254 at pixel 1, 0; expected 255, near a tie, or 0"},
        {"of_16_bits", "P5\n1 1\n65535\n\0\0", 15, "more than 8 bits"},
    };
    write_row();
    ok(sandbox_refused(compare_bad_near(), "in-bad.pgm", "", "cannot be opened"), "a_missing_near_mask_is_refused");
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        sandbox_write("in-bad.pgm", cases[i].bytes, cases[i].size);
        ok(sandbox_refused(compare_bad_near(), "in-bad.pgm", "", cases[i].what), "a_near_mask_%s_is_refused",
           cases[i].promise);
    }
}

/* Of two shadowed pixels both are near a tie. */
static void nothing_but_ties(void)
{
    sandbox_write("in-near.pgm", "P5\n8 1\n255\n\377\0\0\0\0\0\0\377", ROW_SIZE);
    const char *alone[] = {"--near", sandbox_path("in-near.pgm"), 0};
    ok(sandbox_refused(compare(alone), "in-truth.pgm", "", "no shadowed pixel that is not near a tie"),
       "a_truth_whose_shadows_are_all_near_a_tie_is_refused");
    const char *allowed[] = {"--near", sandbox_path("in-near.pgm"), "--allow-vacuous", 0};
    ok(compare(allowed) == EXIT_DIFFERS, "unless_that_is_allowed");
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

/* Per cents of no surface cannot exceed a limit: the count must. */
static void a_truth_without_surface(void)
{
    static const char *const allow[] = {"--allow-vacuous", 0};
    static const char *const loose[] = {"--allow-vacuous", "--max-coverage", "100", 0};
    char text[4000];
    const char *options[] = {"--allow-vacuous", "--json", sandbox_path("in.json"), 0};
    sandbox_write("in-mask.pgm", "P5\n4 1\n255\n\376\376\0\0", 15);
    sandbox_write("in-truth.pgm", "P5\n4 1\n255\n\377\377\377\377", 15);
    ok(compare(options) == EXIT_DIFFERS, "a_mask_with_a_surface_differs_from_a_truth_without");
    read_output("in.json", text, sizeof text);
    ok(strstr(text, "\"coverage_differs\": 4,") && strstr(text, "\"equal\": false"), "and_json_says_so");
    ok(compare(loose) == EXIT_DIFFERS, "whatever_the_limit");
    sandbox_write("in-mask.pgm", "P5\n4 1\n255\n\377\377\377\377", 15);
    ok(compare(allow) == EXIT_DONE, "two_masks_without_surface_are_equal");
    sandbox_write("in-mask.pgm", row_mask, ROW_SIZE);
    sandbox_write("in-truth.pgm", "P5\n8 1\n255\n\0\377\377\377\377\377\377\377", ROW_SIZE);
    sandbox_write("in-near.pgm", "P5\n8 1\n255\n\377\0\0\0\0\0\0\0", ROW_SIZE);
    const char *near[] = {"--near", sandbox_path("in-near.pgm"), "--allow-vacuous", 0};
    ok(compare(near) == EXIT_DIFFERS, "also_where_all_surface_of_the_truth_is_near_a_tie");
}

/* Refused with the file's name; all inputs are as they were. */
static void files_that_are_named_twice(void)
{
    char text[40] = "", spelled[600];
    write_row();
    snprintf(spelled, sizeof spelled, "%s/./out.ppm", sandbox_folder);
    const char *twice[] = {"--difference", sandbox_path("out.ppm"), "--json", sandbox_path("out.ppm"), 0};
    ok(sandbox_refused(compare(twice), "out.ppm", "", "two outputs at once"), "one_file_for_two_outputs_is_refused");
    const char *otherwise[] = {"--difference", spelled, "--json", sandbox_path("out.ppm"), 0};
    ok(sandbox_refused(compare(otherwise), "out.ppm", "", "two outputs at once"), "however_it_is_spelled");
    static const char *const inputs[] = {"in-mask.pgm", "in-truth.pgm", "in-near.pgm"};
    for (int i = 0; i < 3; i++) {
        const char *over[] = {"--near", sandbox_path("in-near.pgm"), "--json", sandbox_path(inputs[i]), 0};
        ok(sandbox_refused(compare(over), inputs[i], "", "would be overwritten"), "json_over_%s_is_refused", inputs[i]);
        read_output(inputs[i], text, sizeof text);
        ok(memcmp(text, "P5\n", 3) == 0, "and_it_is_as_it_was");
    }
    ok(symlink(sandbox_path("in-truth.pgm"), sandbox_path("in-link.json")) == 0, "a_link_to_the_truth_is_made");
    const char *link[] = {"--json", sandbox_path("in-link.json"), 0};
    ok(sandbox_refused(compare(link), "in-link.json", "", "would be overwritten"), "json_over_the_link_is_refused");
    const char *device[] = {"--difference", sandbox_path("in.ppm"), "--json", "/dev/null", 0};
    ok(compare(device) == EXIT_DIFFERS, "a_device_and_a_file_are_two");
}

static void bad_usage(void)
{
    static const char *const cases[][4] = {
        {"--max-error", 0},     {"--max-error", "many", 0}, {"--max-error", "-1", 0},
        {"--max-error=101", 0}, {"--nonsense", 0},          {"third.pgm", 0},
        {"--json", 0},          {"--allow-vacuous=yes", 0}, {"--difference", "nowhere/at/all.ppm", 0},
        {"--near", 0},          {"--edge-band", 0},         {"--edge-band", "wide", 0},
        {"--edge-band=-1", 0},  {"--edge-band", "6001", 0}, {"--edge-band", "nan", 0},
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
    what_is_written();
    what_is_printed();
    limits_leave_out_near_pixels();
    ties_are_yellow();
    the_edge_band();
    bad_near_masks();
    nothing_but_ties();
    no_edge();
    senseless_comparisons();
    a_truth_without_surface();
    files_that_are_named_twice();
    bad_usage();
    sandbox_close();
    return tap_done();
}
