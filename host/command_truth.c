/* gnomon truth: the exact answer for every pixel. */
#include "commands.h"
#include "file.h"
#include "frame.h"
#include "image.h"
#include "json.h"
#include "options.h"
#include "packed.h"
#include "truth.h"

#include <inttypes.h>
#include <stdio.h>

const char truth_summary[] = "cast exact rays: which pixels are truly lit, which shadowed";

enum { MASK_FILE, NEAR_FILE, TIES_FILE, JSON_FILE, SIZE, WORKERS, HELP, OPTION_COUNT };

static const option table[OPTION_COUNT] = {
    {"--mask", "FILE", "8-bit grey: 0 shadowed, 254 lit, 255 no surface"},
    {"--near", "FILE",
     "8-bit grey: 255 where the answer is another 1/256 pixel left, right,\n"
     "above or below of the centre, or hangs on a tie; else 0. Five times\n"
     "the work"},
    {"--ties", "FILE",
     "pixels whose answer hangs on a tie. FILE.txt: a line each, X Y REASON,\n"
     "from the upper left corner (0 0); any other file: a picture, 255 there,\n"
     "else 0"},
    {"--json", "FILE", "the counts as JSON, ties also by reason"},
    {"--size", "WxH", "the image's size, each from 1 to 4096; default: the scene's"},
    {"--workers", "N", "threads, 1 to 64; default 1; never changes the result"},
    {"--help", 0, "this text"},
};

typedef struct request {
    const char *scene;
    const char *values[OPTION_COUNT];
    long size[2];
    long workers;
    packed_scene packed;
    truth truth;
    double seconds;
    problem why;
} request;

static void help(void)
{
    puts(
        "usage: gnomon truth SCENE [options]\n\n"
        "Cast rays through SCENE (.scene or .gno) as it is after rounding to integers, and say of every pixel whether\n"
        "the point that its centre sees is lit. All decisions are exact; no map, no bias, nothing of the renderer is\n"
        "used. Prints counts; per cents are of the pixels that see a surface.\n");
    options_help(table, OPTION_COUNT, stdout);
    puts("\nReasons of ties, and how they are settled (of several the first is named):\n"
         "  eye-edge       the ray passes through an edge or corner of what it sees: it is seen\n"
         "  eye-depth      two triangles at one depth: the first in the scene is seen\n"
         "  eye-plane      a point on the camera's near or far plane: it is seen\n"
         "  light-side     the light is in the plane of what is seen: shadowed\n"
         "  light-frustum  a point on the boundary of the light's frustum: it is inside\n"
         "  shadow-touch   another triangle passes through the point: it does not shadow it\n"
         "  shadow-edge    an edge or corner is in the way: as if the point were moved by (e, e^2, e^3), e > 0 "
         "infinitely\n"
         "                 small, so that nothing slips through a closed mesh\n"
         "  shadow-near    something is in the way just on the light's near plane: shadowed\n"
         "  shadow-within  the way runs along within the plane of a triangle: not shadowed by it\n"
         "\nExit status: 0 done, 2 bad usage or input, or an output cannot be written (no file is left half-written; "
         "those\n"
         "written before it stay).");
}

/* ---- outputs --------------------------------------------------------------------------------------------------- */

static int is_list(const char *path)
{
    return file_has_extension(path, ".txt");
}

static int check_outputs(request *r)
{
    const char **values = r->values;
    for (int i = MASK_FILE; i <= TIES_FILE; i++)
        if (values[i] && !(i == TIES_FILE && is_list(values[i])) && image_can_write(values[i], 1, IMAGE_U8, &r->why))
            return -1;
    if (values[TIES_FILE] && is_list(values[TIES_FILE]) && file_can_write(values[TIES_FILE], &r->why))
        return -1;
    if (values[JSON_FILE] && file_can_write(values[JSON_FILE], &r->why))
        return -1;
    return file_check_distinct(values + MASK_FILE, JSON_FILE - MASK_FILE + 1, &r->scene, 1, &r->why);
}

static int write_picture(request *r, const char *path, uint8_t *pixels)
{
    image im = {r->truth.width, r->truth.height, 1, IMAGE_U8, pixels};
    return image_write(&im, path, &r->why);
}

static int write_tie_picture(request *r, const char *path)
{
    image im = image_make(r->truth.width, r->truth.height, 1, IMAGE_U8);
    size_t count = image_sample_count(&im);
    for (size_t i = 0; i < count; i++)
        ((uint8_t *)im.samples)[i] = r->truth.ties[i] ? 255 : 0;
    int result = image_write(&im, path, &r->why);
    image_free(&im);
    return result;
}

static int write_tie_list(request *r, const char *path)
{
    file_output output;
    const truth *t = &r->truth;
    if (file_output_open(&output, path, &r->why))
        return -1;
    for (uint32_t y = 0; y < t->height; y++)
        for (uint32_t x = 0; x < t->width; x++) {
            int reason = t->reasons[(size_t)y * t->width + x];
            if (reason)
                fprintf(output.stream, "%" PRIu32 " %" PRIu32 " %s\n", x, y, truth_reason_names[reason]);
        }
    return file_output_finish(&output, &r->why);
}

static void write_reasons(json *j, const truth *t)
{
    uint64_t counts[TRUTH_REASON_COUNT] = {0};
    size_t pixels = (size_t)t->width * t->height;
    for (size_t i = 0; i < pixels; i++)
        counts[t->reasons[i]]++;
    json_open(j, "ties_by_reason");
    for (int i = TRUTH_NO_TIE + 1; i < TRUTH_REASON_COUNT; i++)
        json_integer(j, truth_reason_names[i], (int64_t)counts[i]);
    json_close(j);
}

static int write_json(request *r, const char *path)
{
    file_output output;
    const truth *t = &r->truth;
    if (file_output_open(&output, path, &r->why))
        return -1;
    json w = {.stream = output.stream};
    json_open(&w, 0);
    json_string(&w, "scene", r->scene);
    json_integer(&w, "width", t->width);
    json_integer(&w, "height", t->height);
    json_integer(&w, "triangles", (int64_t)t->triangles);
    json_integer(&w, "surface_pixels", (int64_t)t->surface);
    json_integer(&w, "lit", (int64_t)t->lit);
    json_integer(&w, "shadowed", (int64_t)t->shadowed);
    json_integer(&w, "ties", (int64_t)t->tie_count);
    write_reasons(&w, t);
    if (t->near)
        json_integer(&w, "near", (int64_t)t->near_count);
    json_integer(&w, "exact_decisions", (int64_t)t->exact_decisions);
    json_number(&w, "seconds", r->seconds);
    json_close(&w);
    return file_output_finish(&output, &r->why);
}

static int write_outputs(request *r)
{
    const char **values = r->values;
    if (values[MASK_FILE] && write_picture(r, values[MASK_FILE], r->truth.mask))
        return -1;
    if (values[NEAR_FILE] && write_picture(r, values[NEAR_FILE], r->truth.near))
        return -1;
    if (values[TIES_FILE] &&
        (is_list(values[TIES_FILE]) ? write_tie_list(r, values[TIES_FILE]) : write_tie_picture(r, values[TIES_FILE])))
        return -1;
    return values[JSON_FILE] ? write_json(r, values[JSON_FILE]) : 0;
}

static double percent(const truth *t, uint64_t count)
{
    return t->surface ? 100.0 * (double)count / (double)t->surface : 0;
}

static void print(const truth *t)
{
    printf("surface %" PRIu64 " pixels, lit %" PRIu64 " (%.4f %%), shadowed %" PRIu64 " (%.4f %%)\n", t->surface,
           t->lit, percent(t, t->lit), t->shadowed, percent(t, t->shadowed));
    printf("ties %" PRIu64 " (%.4f %%)", t->tie_count, percent(t, t->tie_count));
    if (t->near)
        printf(", near %" PRIu64 " (%.4f %%)", t->near_count, percent(t, t->near_count));
    puts("");
}

/* ---- the command ----------------------------------------------------------------------------------------------- */

static int cast(request *r)
{
    const char **values = r->values;
    r->workers = 1;
    if ((values[SIZE] && option_size("--size", values[SIZE], 0, GN_MAX_SIZE, r->size, &r->why)) ||
        (values[WORKERS] && option_number("--workers", values[WORKERS], 1, 64, &r->workers, &r->why)) ||
        check_outputs(r) || packed_read(&r->packed, r->scene, 0, &r->why))
        return -1;
    if (!values[SIZE]) {
        r->size[0] = r->packed.settings.width;
        r->size[1] = r->packed.settings.height;
    }
    double start = frame_clock();
    if (truth_make(&r->truth, &r->packed, (uint32_t)r->size[0], (uint32_t)r->size[1], (int)r->workers,
                   values[NEAR_FILE] != 0, &r->why))
        return -1;
    r->seconds = frame_clock() - start;
    if (write_outputs(r))
        return -1;
    print(&r->truth);
    return 0;
}

int command_truth(int argc, char **argv)
{
    request r = {.scene = 0};
    command_line line;
    int result = options_parse(table, OPTION_COUNT, argc, argv, r.values, &line, &r.why);
    if (!result && r.values[HELP]) {
        help();
        return EXIT_DONE;
    }
    if (!result && line.place_count != 1)
        result = problem_of_usage(&r.why, "%d scenes; expected one (gnomon truth --help)", line.place_count);
    if (!result) {
        r.scene = line.places[0];
        result = cast(&r);
    }
    if (result)
        fprintf(stderr, "%s\n", r.why.text);
    truth_free(&r.truth);
    packed_free(&r.packed);
    return result ? EXIT_BAD_INPUT : EXIT_DONE;
}
