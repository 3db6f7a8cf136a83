/* gnomon bench: how long the passes take. */
#include "automatic.h"
#include "choices.h"
#include "commands.h"
#include "file.h"
#include "frame.h"
#include "json.h"
#include "memory.h"
#include "progress.h"
#include "render_options.h"
#include "settings_report.h"

#include <stdio.h>
#include <stdlib.h>

const char bench_summary[] = "measure the passes of a scene";

enum { WORK = RENDER_OPTION_COUNT, BENCH_HEAD = WORK + WORK_OPTION_COUNT, RUNS, JSON, HELP, OPTION_COUNT };

static const option table[OPTION_COUNT] = {
    RENDER_OPTIONS,
    WORK_OPTIONS,
    {0, 0, "How it is measured:"},
    {"--runs", "N", "frames that are counted, 1 to 10000; default 21 (three more come before)"},
    {"--json", "FILE", "the figures as JSON"},
    {"--help", 0, "this text"},
};

static void help(void)
{
    puts(
        "usage: gnomon bench SCENE [options]\n\n"
        "Render SCENE many times and print the median and the least time of each pass in milliseconds. A machine "
        "under\n"
        "other load shows in the distance between the two: compare least times then, and always within one run. "
        "Without\n"
        "--region the camera pass works on whole rows of 65536 pixels or more, which suits this machine rather than a\n"
        "small one.\n");
    options_help(table, OPTION_COUNT, stdout);
    puts("\nExit status: 0 done, 2 bad usage or input.");
}

typedef struct times {
    double *view, *light, *camera, *frame; /* milliseconds */
    int count;
} times;

static int by_size(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return x < y ? -1 : x > y;
}

/* The middle one of sorted times, or the mean of the middle two. */
static double median(const double *sorted, int count)
{
    return (sorted[(count - 1) / 2] + sorted[count / 2]) / 2;
}

static int measure(frame *f, const packed_scene *packed, times *t, problem *why)
{
    enum { WARM_UP = 3 };
    progress p = progress_start("bench");
    for (int i = -WARM_UP; i < t->count; i++) {
        if (frame_view_pass(f, &packed->camera, &packed->light, why) || frame_light_pass(f, &packed->light, why) ||
            frame_camera_pass(f, &packed->camera, why))
            return -1;
        progress_show(&p, (unsigned)(i + WARM_UP), (unsigned)(t->count + WARM_UP));
        if (i < 0)
            continue;
        t->view[i] = 1e3 * f->view_seconds;
        t->light[i] = 1e3 * f->light_seconds;
        t->camera[i] = 1e3 * f->camera_seconds;
        t->frame[i] = t->view[i] + t->light[i] + t->camera[i];
    }
    progress_end(&p);
    qsort(t->view, (size_t)t->count, sizeof *t->view, by_size);
    qsort(t->light, (size_t)t->count, sizeof *t->light, by_size);
    qsort(t->camera, (size_t)t->count, sizeof *t->camera, by_size);
    qsort(t->frame, (size_t)t->count, sizeof *t->frame, by_size);
    return 0;
}

static void print(const frame *f, int scale, const times *t)
{
    const gn_settings *s = &f->settings;
    printf("image %d x %d, %u triangles, shadow %s", s->width, s->height, (unsigned)f->plan.triangles,
           choices_shadow.all[s->shadow].word);
    if (s->shadow == GN_SHADOW_MAP) {
        printf(" %d x %d, ", s->map_width, s->map_height);
        settings_report_text(stdout, s, &f->plan, scale);
    }
    printf(", region %d x %d, workers %d, runs %d\n", f->plan.region_width, f->plan.region_height, s->workers,
           t->count);
    printf("pass      median ms   least ms\n");
    if (choices_use_view(s))
        printf("view     %10.3f %10.3f\n", median(t->view, t->count), t->view[0]);
    printf("light    %10.3f %10.3f\n", median(t->light, t->count), t->light[0]);
    printf("camera   %10.3f %10.3f\n", median(t->camera, t->count), t->camera[0]);
    printf("frame    %10.3f %10.3f\n", median(t->frame, t->count), t->frame[0]);
}

static void write_pass(json *w, const char *name, const double *sorted, int count)
{
    json_open(w, name);
    json_number(w, "median_ms", median(sorted, count));
    json_number(w, "least_ms", sorted[0]);
    json_close(w);
}

static int write_json(const char *path, const char *scene, const frame *f, int scale, const times *t, problem *why)
{
    file_output output;
    if (file_output_open(&output, path, why))
        return -1;
    json w = {.stream = output.stream};
    json_open(&w, 0);
    json_string(&w, "scene", scene);
    json_integer(&w, "width", f->settings.width);
    json_integer(&w, "height", f->settings.height);
    json_integer(&w, "triangles", f->plan.triangles);
    settings_report_json(&w, &f->settings, &f->plan, scale);
    json_integer(&w, "region_width", f->plan.region_width);
    json_integer(&w, "region_height", f->plan.region_height);
    json_integer(&w, "workers", f->settings.workers);
    json_integer(&w, "runs", t->count);
    if (choices_use_view(&f->settings))
        write_pass(&w, "view", t->view, t->count);
    write_pass(&w, "light", t->light, t->count);
    write_pass(&w, "camera", t->camera, t->count);
    write_pass(&w, "frame", t->frame, t->count);
    json_close(&w);
    return file_output_finish(&output, why);
}

static void use_large_regions(gn_settings *settings)
{
    int rows = 65536 / settings->width + 1;
    settings->region_width = settings->width;
    settings->region_height = (uint16_t)(rows < settings->height ? rows : settings->height);
}

static int bench(packed_scene *packed, frame *f, times *t, const char *scene, const char *const values[], problem *why)
{
    long runs = 21;
    gn_settings settings;
    if ((values[RUNS] && option_number("--runs", values[RUNS], 1, 10000, &runs, why)) ||
        (values[JSON] && file_can_write(values[JSON], why)) || file_check_distinct(values + JSON, 1, &scene, 1, why) ||
        packed_read(packed, scene, 0, why) || render_options_read(&settings, packed, values, why) ||
        work_options_read(&settings, values + WORK, why) || automatic_options_read(&settings, packed, values, why))
        return -1;
    if (!settings.region_width)
        use_large_regions(&settings);
    t->count = (int)runs;
    t->view = memory_take((size_t)runs, sizeof *t->view);
    t->light = memory_take((size_t)runs, sizeof *t->light);
    t->camera = memory_take((size_t)runs, sizeof *t->camera);
    t->frame = memory_take((size_t)runs, sizeof *t->frame);
    if (frame_open(f, &packed->scene, &settings, 0, why) || measure(f, packed, t, why))
        return -1;
    print(f, packed->scale, t);
    return values[JSON] ? write_json(values[JSON], scene, f, packed->scale, t, why) : 0;
}

int command_bench(int argc, char **argv)
{
    const char *values[OPTION_COUNT];
    command_line line;
    problem why;
    packed_scene packed = {.mesh_count = 0};
    frame f = {.context = 0};
    times t = {0};
    int result = options_parse(table, OPTION_COUNT, argc, argv, values, &line, &why);
    if (!result && values[HELP]) {
        help();
        return EXIT_DONE;
    }
    if (!result && line.place_count != 1)
        result = problem_of_usage(&why, "%d scenes; expected one (gnomon bench --help)", line.place_count);
    if (!result)
        result = bench(&packed, &f, &t, line.places[0], values, &why);
    if (result)
        fprintf(stderr, "%s\n", why.text);
    free(t.view);
    free(t.light);
    free(t.camera);
    free(t.frame);
    frame_close(&f);
    packed_free(&packed);
    return result ? EXIT_BAD_INPUT : EXIT_DONE;
}
