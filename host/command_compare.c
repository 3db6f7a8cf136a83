/* gnomon compare: false shadow and false light of a mask against the truth. */
#include "commands.h"
#include "comparison.h"
#include "file.h"
#include "image.h"
#include "json.h"
#include "options.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

const char compare_summary[] = "compare a shadow mask with the truth: false shadow, false light";

enum { NEAR, EDGE_BAND, MAX_ERROR, MAX_COVERAGE, ALLOW_VACUOUS, DIFFERENCE, JSON, HELP, OPTION_COUNT };

/* More than the diagonal of the largest image. */
enum { WIDEST_EDGE_BAND = 6000 };

static const option table[OPTION_COUNT] = {
    {"--near", "FILE",
     "8-bit grey of the same size, as gnomon truth --near writes it: 255 where the\n"
     "truth is near a tie (it differs within 1/256 pixel), else 0. All figures are\n"
     "given once more without these pixels, and the limits below apply to those"},
    {"--edge-band", "PIXELS",
     "wrong pixels at most so far from the true shadow edge count as its edge band,\n"
     "all others as interior; default 2"},
    {"--max-error", "E", "per cent of false shadow and false light together that still counts as\nequal; default 0"},
    {"--max-coverage", "C",
     "per cent of pixels that see a surface in one mask only, as above; default 1.\n"
     "Where TRUTH sees none, one such pixel is a difference"},
    {"--allow-vacuous", 0, "accept a truth without a lit or without a shadowed pixel"},
    {"--difference", "FILE",
     "picture: false shadow red, false light blue, surface in one mask only\n"
     "magenta, any of these near a tie yellow, agreement light or dark grey,\n"
     "no surface nearly black"},
    {"--json", "FILE", "the figures as JSON"},
    {"--help", 0, "this text"},
};

static void help(void)
{
    puts(
        "usage: gnomon compare MASK TRUTH [options]\n\n"
        "Compare two masks (8-bit grey: 0 to 126 shadowed, 127 to 254 lit, 255 no surface) pixel by pixel.\n\n"
        "  false shadow  lit in TRUTH, shadowed in MASK\n"
        "  false light   shadowed in TRUTH, lit in MASK\n\n"
        "Per cents are of the pixels that see a surface in TRUTH. Pixels that see a surface in one mask only are\n"
        "counted apart. The mean absolute error is that of the lit fraction (value / 254) where both see a surface.\n\n"
        "Distances are in pixels, from the centre of a wrong pixel to the nearest point of the true shadow edge: the\n"
        "points half-way between two neighbours of which one is lit, one shadowed in TRUTH. 95 %: the least distance\n"
        "that 95 % of the wrong pixels do not exceed (nearest rank).\n");
    options_help(table, OPTION_COUNT, stdout);
    puts("\nExit status: 0 equal within the limits, 1 different, 2 bad usage or input, or nothing to compare.");
}

/* ---- JSON ------------------------------------------------------------------------------------------------------- */

/* accuracy.sh reads the members of the outermost object by name, one a line. */
static void write_distances(json *w, const char *name, const comparison_figures *f, const comparison_errors *e)
{
    json_open(w, name);
    json_integer(w, "in_edge_band", (int64_t)e->in_edge_band);
    json_integer(w, "in_interior", (int64_t)e->in_interior);
    json_number(w, "in_edge_band_percent", comparison_percent(f, e->in_edge_band));
    json_number(w, "in_interior_percent", comparison_percent(f, e->in_interior));
    json_number(w, "mean", e->mean);
    json_number(w, "percentile_95", e->percentile_95);
    json_number(w, "worst", e->worst);
    json_number(w, "worst_x", isnan(e->worst) ? NAN : e->worst_x);
    json_number(w, "worst_y", isnan(e->worst) ? NAN : e->worst_y);
    json_close(w);
}

static void write_figures(json *w, const comparison_figures *f)
{
    json_integer(w, "surface_pixels", (int64_t)f->surface);
    json_integer(w, "truly_lit", (int64_t)f->lit);
    json_integer(w, "truly_shadowed", (int64_t)f->shadowed);
    json_integer(w, "surface_in_edge_band", (int64_t)f->in_edge_band);
    json_integer(w, "false_shadow", (int64_t)f->false_shadow.pixels);
    json_integer(w, "false_light", (int64_t)f->false_light.pixels);
    json_number(w, "false_shadow_percent", comparison_percent(f, f->false_shadow.pixels));
    json_number(w, "false_light_percent", comparison_percent(f, f->false_light.pixels));
    json_number(w, "error_percent", comparison_percent(f, f->together.pixels));
    json_number(w, "mean_absolute_error", f->mean_absolute_error);
    json_integer(w, "coverage_differs", (int64_t)f->coverage);
    json_number(w, "coverage_differs_percent", comparison_percent(f, f->coverage));
    write_distances(w, "false_shadow_to_edge", f, &f->false_shadow);
    write_distances(w, "false_light_to_edge", f, &f->false_light);
    write_distances(w, "error_to_edge", f, &f->together);
}

static void write_near(json *w, const comparison *c)
{
    const comparison_figures *all = &c->all, *rest = &c->not_near;
    json_open(w, "near");
    json_integer(w, "surface_pixels", (int64_t)(all->surface - rest->surface));
    json_integer(w, "false_shadow", (int64_t)(all->false_shadow.pixels - rest->false_shadow.pixels));
    json_integer(w, "false_light", (int64_t)(all->false_light.pixels - rest->false_light.pixels));
    json_integer(w, "coverage_differs", (int64_t)(all->coverage - rest->coverage));
    json_close(w);
    json_open(w, "not_near");
    write_figures(w, rest);
    json_close(w);
}

static int write_json(const char *path, const comparison *c, int equal, problem *why)
{
    file_output output;
    if (file_output_open(&output, path, why))
        return -1;
    json w = {.stream = output.stream};
    json_open(&w, 0);
    json_number(&w, "edge_band", c->edge_band);
    json_boolean(&w, "truth_has_edge", c->has_edge);
    write_figures(&w, &c->all);
    if (c->has_near)
        write_near(&w, c);
    json_boolean(&w, "equal", equal);
    json_close(&w);
    return file_output_finish(&output, why);
}

/* ---- text ------------------------------------------------------------------------------------------------------- */

static void print_errors(const char *name, const comparison *c, const comparison_figures *f, const comparison_errors *e)
{
    printf("  %-12s %10" PRIu64 " %8.4f %%  %10" PRIu64 " %8.4f %%", name, e->in_edge_band,
           comparison_percent(f, e->in_edge_band), e->in_interior, comparison_percent(f, e->in_interior));
    if (!c->has_edge)
        printf("  %8s %8s %8s\n", "no edge", "-", "-");
    else if (!e->pixels)
        printf("  %8s %8s %8s\n", "-", "-", "-");
    else
        printf("  %8.3f %8.3f %8.3f at %" PRIu32 ", %" PRIu32 "\n", e->mean, e->percentile_95, e->worst, e->worst_x,
               e->worst_y);
}

/* pictures.sh shows the second line. */
static void print_figures(const comparison *c, const comparison_figures *f)
{
    printf("surface %" PRIu64 " pixels, truly lit %" PRIu64 ", truly shadowed %" PRIu64 "\n", f->surface, f->lit,
           f->shadowed);
    printf("false shadow %" PRIu64 " (%.4f %%), false light %" PRIu64 " (%.4f %%), together %.4f %%\n",
           f->false_shadow.pixels, comparison_percent(f, f->false_shadow.pixels), f->false_light.pixels,
           comparison_percent(f, f->false_light.pixels), comparison_percent(f, f->together.pixels));
    printf("surface in one mask only %" PRIu64 " (%.4f %%)\n", f->coverage, comparison_percent(f, f->coverage));
    if (isnan(f->mean_absolute_error))
        puts("mean absolute error: no pixel sees a surface in both");
    else
        printf("mean absolute error %.6f\n", f->mean_absolute_error);
    printf("distance from the true shadow edge in pixels; edge band: to %g, %" PRIu64 " pixels of the surface\n",
           c->edge_band, f->in_edge_band);
    printf("  %12s %21s  %21s  %8s %8s %8s\n", "", "edge band", "interior", "mean", "95 %", "worst");
    print_errors("false shadow", c, f, &f->false_shadow);
    print_errors("false light", c, f, &f->false_light);
    print_errors("together", c, f, &f->together);
}

static void print(const comparison *c)
{
    const comparison_figures *all = &c->all, *rest = &c->not_near;
    print_figures(c, all);
    if (!c->has_near)
        return;
    printf("\nnear a tie: %" PRIu64 " pixels that see a surface; of the above, false shadow %" PRIu64
           ", false light %" PRIu64 ",\nsurface in one mask only %" PRIu64 ". Without them:\n\n",
           all->surface - rest->surface, all->false_shadow.pixels - rest->false_shadow.pixels,
           all->false_light.pixels - rest->false_light.pixels, all->coverage - rest->coverage);
    print_figures(c, rest);
}

/* ---- input ------------------------------------------------------------------------------------------------------ */

/* What is not given stays as it is. */
static int read_limit(const char *name, const char *value, double most, double *number, problem *why)
{
    return value ? option_decimal(name, value, 0, most, number, why) : 0;
}

typedef struct request {
    const char *mask, *truth, *near, *difference, *json; /* files; the last three may be 0 */
    double edge_band, max_error, max_coverage;           /* pixels, per cent, per cent */
    int allow_vacuous;
} request;

static int read_request(request *r, const command_line *line, const char *const values[], problem *why)
{
    if (line->place_count != 2)
        return problem_of_usage(why, "%d masks; expected MASK and TRUTH (gnomon compare --help)", line->place_count);
    *r = (request){.mask = line->places[0],
                   .truth = line->places[1],
                   .near = values[NEAR],
                   .difference = values[DIFFERENCE],
                   .json = values[JSON],
                   .edge_band = COMPARISON_EDGE_BAND,
                   .max_coverage = 1,
                   .allow_vacuous = values[ALLOW_VACUOUS] != 0};
    if (read_limit("--edge-band", values[EDGE_BAND], WIDEST_EDGE_BAND, &r->edge_band, why) ||
        read_limit("--max-error", values[MAX_ERROR], 100, &r->max_error, why) ||
        read_limit("--max-coverage", values[MAX_COVERAGE], 100, &r->max_coverage, why))
        return -1;
    const char *const inputs[] = {r->mask, r->truth, r->near}, *const outputs[] = {r->difference, r->json};
    if ((r->difference && image_can_write(r->difference, 3, IMAGE_U8, why)) ||
        (r->json && file_can_write(r->json, why)))
        return -1;
    return file_check_distinct(outputs, 2, inputs, 3, why);
}

typedef struct images {
    image mask, truth, near;
} images;

static int check_size(const image *im, const char *path, const image *truth, problem *why)
{
    if (im->width == truth->width && im->height == truth->height)
        return 0;
    return problem_in(why, path, "is %u x %u pixels, the truth %u x %u; expected the same size", im->width, im->height,
                      truth->width, truth->height);
}

/* A mask given by mistake has other values. */
static int check_near_values(const image *near, const char *path, problem *why)
{
    const uint8_t *samples = near->samples;
    for (size_t i = 0; i < image_sample_count(near); i++)
        if (samples[i] != 0 && samples[i] != 255)
            return problem_in(why, path, "has %u at pixel %u, %u; expected 255, near a tie, or 0, not near", samples[i],
                              (unsigned)(i % near->width), (unsigned)(i / near->width));
    return 0;
}

static int read_images(images *im, const request *r, problem *why)
{
    if (image_read_mask(&im->mask, r->mask, why) || image_read_mask(&im->truth, r->truth, why) ||
        check_size(&im->mask, r->mask, &im->truth, why))
        return -1;
    if (!r->near)
        return 0;
    return image_read_mask(&im->near, r->near, why) || check_size(&im->near, r->near, &im->truth, why) ||
                   check_near_values(&im->near, r->near, why)
               ? -1
               : 0;
}

/* What the limits apply to must hold something to be wrong about. */
static int check_sense(const request *r, const comparison *c, problem *why)
{
    const comparison_figures *f = &c->not_near;
    if (r->allow_vacuous || (f->lit && f->shadowed))
        return 0;
    return problem_in(why, r->truth,
                      "has no %s pixel%s, so that nothing is compared; expected both kinds, or --allow-vacuous",
                      !f->surface ? "lit and no shadowed"
                      : f->lit    ? "shadowed"
                                  : "lit",
                      c->has_near ? " that is not near a tie" : "");
}

static int write_difference(const char *path, const comparison_input *input, problem *why)
{
    image picture = comparison_picture(input);
    int result = image_write(&picture, path, why);
    image_free(&picture);
    return result;
}

static int compare(const request *r, const images *im, problem *why)
{
    comparison_input input = {im->truth.width,   im->truth.height, im->mask.samples,
                              im->truth.samples, im->near.samples, r->edge_band};
    comparison c;
    comparison_make(&c, &input);
    if (check_sense(r, &c, why))
        return EXIT_BAD_INPUT;
    const comparison_figures *f = &c.not_near;
    /* No per cent can be given where the truth sees nothing: one pixel that the mask sees is too many. */
    int equal = (f->surface || !f->coverage) && comparison_percent(f, f->together.pixels) <= r->max_error &&
                comparison_percent(f, f->coverage) <= r->max_coverage;
    if ((r->difference && write_difference(r->difference, &input, why)) ||
        (r->json && write_json(r->json, &c, equal, why)))
        return EXIT_BAD_INPUT;
    print(&c);
    return equal ? EXIT_DONE : EXIT_DIFFERS;
}

int command_compare(int argc, char **argv)
{
    const char *values[OPTION_COUNT];
    command_line line;
    problem why;
    request r;
    images im = {0};
    int status = EXIT_BAD_INPUT;
    if (options_parse(table, OPTION_COUNT, argc, argv, values, &line, &why) == 0) {
        if (values[HELP]) {
            help();
            return EXIT_DONE;
        }
        if (read_request(&r, &line, values, &why) == 0 && read_images(&im, &r, &why) == 0)
            status = compare(&r, &im, &why);
    }
    if (status == EXIT_BAD_INPUT)
        fprintf(stderr, "%s\n", why.text);
    image_free(&im.mask);
    image_free(&im.truth);
    image_free(&im.near);
    return status;
}
