/* gnomon compare: false shadow and false light of a mask against the truth. */
#include "commands.h"
#include "file.h"
#include "image.h"
#include "json.h"
#include "options.h"
#include "text.h"

#include <stdio.h>
#include <string.h>

const char compare_summary[] = "compare a shadow mask with the truth: false shadow, false light";

enum { DIFFERENCE, JSON, MAX_ERROR, MAX_COVERAGE, ALLOW_VACUOUS, HELP, OPTION_COUNT };

static const option table[OPTION_COUNT] = {
    {"--difference", "FILE",
     "picture: false shadow red, false light blue, surface in one mask only\n"
     "yellow, agreement light or dark grey, no surface nearly black"},
    {"--json", "FILE", "the figures as JSON"},
    {"--max-error", "E", "per cent of false shadow and false light together that still counts as\nequal; default 0"},
    {"--max-coverage", "C", "per cent of pixels that see a surface in one mask only, as above; default 1"},
    {"--allow-vacuous", 0, "accept a truth without a lit or without a shadowed pixel"},
    {"--help", 0, "this text"},
};

static void help(void)
{
    puts("usage: gnomon compare MASK TRUTH [options]\n\n"
         "Compare two masks (8-bit grey: 0 to 126 shadowed, 127 to 254 lit, 255 no surface) pixel by pixel. False "
         "shadow:\n"
         "lit in TRUTH, shadowed in MASK. False light: shadowed in TRUTH, lit in MASK. Per cents are of the pixels "
         "that see\n"
         "a surface in TRUTH. Pixels that see a surface in one mask only are counted apart.\n");
    options_help(table, OPTION_COUNT, stdout);
    puts("\nExit status: 0 equal within the limits, 1 different, 2 bad usage or input, or nothing to compare.");
}

enum { NO_SURFACE = 255, LIT_FROM = 127 };

typedef enum kind { SHADOWED, LIT, NOTHING } kind;

static kind kind_of(uint8_t value)
{
    return value == NO_SURFACE ? NOTHING : value >= LIT_FROM ? LIT : SHADOWED;
}

typedef struct comparison {
    unsigned long surface, lit, shadowed; /* in truth */
    unsigned long false_shadow, false_light;
    unsigned long coverage; /* surface in one mask only */
} comparison;

static comparison compare_masks(const image *mask, const image *truth)
{
    comparison c = {0};
    size_t count = image_sample_count(mask);
    const uint8_t *a = mask->samples, *b = truth->samples;
    for (size_t i = 0; i < count; i++) {
        kind got = kind_of(a[i]), expected = kind_of(b[i]);
        c.surface += expected != NOTHING;
        c.lit += expected == LIT;
        c.shadowed += expected == SHADOWED;
        c.coverage += (got == NOTHING) != (expected == NOTHING);
        c.false_shadow += expected == LIT && got == SHADOWED;
        c.false_light += expected == SHADOWED && got == LIT;
    }
    return c;
}

static double percent(const comparison *c, unsigned long count)
{
    return c->surface ? 100.0 * (double)count / (double)c->surface : 0;
}

static const uint8_t *difference_colour(kind got, kind expected)
{
    static const uint8_t red[3] = {220, 30, 30}, blue[3] = {40, 80, 255}, yellow[3] = {240, 220, 40};
    static const uint8_t light_grey[3] = {190, 190, 190}, dark_grey[3] = {90, 90, 90}, dark[3] = {20, 20, 20};
    if ((got == NOTHING) != (expected == NOTHING))
        return yellow;
    if (got != expected)
        return got == SHADOWED ? red : blue;
    return got == NOTHING ? dark : got == LIT ? light_grey : dark_grey;
}

static int write_difference(const char *path, const image *mask, const image *truth, problem *why)
{
    image im = image_make(mask->width, mask->height, 3, IMAGE_U8);
    size_t count = (size_t)im.width * im.height;
    for (size_t i = 0; i < count; i++)
        memcpy((uint8_t *)im.samples + 3 * i,
               difference_colour(kind_of(((const uint8_t *)mask->samples)[i]),
                                 kind_of(((const uint8_t *)truth->samples)[i])),
               3);
    int result = image_write(&im, path, why);
    image_free(&im);
    return result;
}

static int write_json(const char *path, const comparison *c, int equal, problem *why)
{
    file_output output;
    if (file_output_open(&output, path, why))
        return -1;
    json w = {.stream = output.stream};
    json_open(&w, 0);
    json_integer(&w, "surface_pixels", (int64_t)c->surface);
    json_integer(&w, "truly_lit", (int64_t)c->lit);
    json_integer(&w, "truly_shadowed", (int64_t)c->shadowed);
    json_integer(&w, "false_shadow", (int64_t)c->false_shadow);
    json_integer(&w, "false_light", (int64_t)c->false_light);
    json_number(&w, "false_shadow_percent", percent(c, c->false_shadow));
    json_number(&w, "false_light_percent", percent(c, c->false_light));
    json_number(&w, "error_percent", percent(c, c->false_shadow + c->false_light));
    json_integer(&w, "coverage_differs", (int64_t)c->coverage);
    json_number(&w, "coverage_differs_percent", percent(c, c->coverage));
    json_boolean(&w, "equal", equal);
    json_close(&w);
    return file_output_finish(&output, why);
}

static void print(const comparison *c)
{
    printf("surface %lu pixels, truly lit %lu, truly shadowed %lu\n", c->surface, c->lit, c->shadowed);
    printf("false shadow %lu (%.4f %%), false light %lu (%.4f %%), together %.4f %%\n", c->false_shadow,
           percent(c, c->false_shadow), c->false_light, percent(c, c->false_light),
           percent(c, c->false_shadow + c->false_light));
    printf("surface in one mask only %lu (%.4f %%)\n", c->coverage, percent(c, c->coverage));
}

static int read_limit(const char *name, const char *value, double *limit, problem *why)
{
    if (value && (word_number((word){value, strlen(value)}, limit) || *limit < 0 || *limit > 100))
        return problem_of_usage(why, "%s %s; expected a number from 0 to 100", name, value);
    return 0;
}

static int check_sense(const comparison *c, const char *truth, int allow_vacuous, problem *why)
{
    if (allow_vacuous || (c->lit && c->shadowed))
        return 0;
    return problem_in(why, truth,
                      "has no %s pixel, so that nothing is compared; expected both kinds, or --allow-vacuous",
                      !c->surface ? "lit and no shadowed"
                      : c->lit    ? "shadowed"
                                  : "lit");
}

static int compare(const command_line *line, const char *const values[], image images[2], problem *why)
{
    double max_error = 0, max_coverage = 1;
    if (read_limit("--max-error", values[MAX_ERROR], &max_error, why) ||
        read_limit("--max-coverage", values[MAX_COVERAGE], &max_coverage, why) ||
        (values[DIFFERENCE] && image_can_write(values[DIFFERENCE], 3, IMAGE_U8, why)) ||
        (values[JSON] && file_can_write(values[JSON], why)) || image_read_mask(&images[0], line->places[0], why) ||
        image_read_mask(&images[1], line->places[1], why))
        return EXIT_BAD_INPUT;
    if (images[0].width != images[1].width || images[0].height != images[1].height) {
        problem_in(why, line->places[0], "is %u x %u pixels, the truth %u x %u; expected the same size",
                   images[0].width, images[0].height, images[1].width, images[1].height);
        return EXIT_BAD_INPUT;
    }
    comparison c = compare_masks(&images[0], &images[1]);
    if (check_sense(&c, line->places[1], values[ALLOW_VACUOUS] != 0, why))
        return EXIT_BAD_INPUT;
    int equal = percent(&c, c.false_shadow + c.false_light) <= max_error && percent(&c, c.coverage) <= max_coverage;
    if ((values[DIFFERENCE] && write_difference(values[DIFFERENCE], &images[0], &images[1], why)) ||
        (values[JSON] && write_json(values[JSON], &c, equal, why)))
        return EXIT_BAD_INPUT;
    print(&c);
    return equal ? EXIT_DONE : EXIT_DIFFERS;
}

int command_compare(int argc, char **argv)
{
    const char *values[OPTION_COUNT];
    command_line line;
    problem why;
    image images[2] = {{0}, {0}};
    int status = EXIT_BAD_INPUT;
    if (options_parse(table, OPTION_COUNT, argc, argv, values, &line, &why) == 0) {
        if (values[HELP]) {
            help();
            return EXIT_DONE;
        }
        if (line.place_count == 2)
            status = compare(&line, values, images, &why);
        else
            problem_of_usage(&why, "%d masks; expected MASK and TRUTH (gnomon compare --help)", line.place_count);
    }
    if (status == EXIT_BAD_INPUT)
        fprintf(stderr, "%s\n", why.text);
    image_free(&images[0]);
    image_free(&images[1]);
    return status;
}
