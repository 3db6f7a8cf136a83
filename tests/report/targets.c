/* The report on small targets: errors of every chain on this machine, beside what was counted on the targets.
 *
 *     targets COUNTS FLASH SCENE... --csv FILE [--page FILE] [--model yes]
 *
 * COUNTS: a folder of TARGET.count, what port/report/report.c printed and the plugin counted of it, for each target of
 * which there is one. FLASH: of TARGET.flash (port/report/flash.sh) and TARGET.version, the first line of what the
 * compiler says about itself. SCENE: the files of the same scenes; their frames are rendered here, and compared with
 * the exact truth, which is kept in FLASH.
 *
 * The CSV: for each target a line `# TARGET: VERSION`; the names of the columns; a row a scene, map and chain. Errors
 * are per cent of the pixels that see a surface, bytes those of the plan on the first target that has one;
 * TARGET_pixel: instructions of all passes over `pixels`. What was not counted is empty. The page is that of a sweep
 * (host/page.h). --model: what host/cost_model.h makes of the frames that were counted on the Cortex-M4, as a line
 * `model FRAMES frames, MEAN % mean error, WORST % worst`. Exit status 2: an input is missing, or does not fit the
 * others. */
#include "comparison.h"
#include "cost_model.h"
#include "file.h"
#include "lane.h"
#include "memory.h"
#include "sweep_page.h"

#include "../../port/report/chains.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { TARGETS = 4, NAME = 64 };

static const char *const target_names[TARGETS] = {"cortex-m4", "cortex-m0", "rv32imc", "rv32i"};

/* Beside the row of a sweep, which has no place for more than one target. */
typedef struct target_figures {
    double passes[LANE_PASSES], bytes, flash;
} target_figures;

static sweep_plan plan;
static target_figures (*figures)[TARGETS]; /* of each cell of the plan */
static char versions[TARGETS][256];
static const char image_size[] = "160x120";

static void fail(const char *which, const char *what)
{
    fprintf(stderr, "targets: %s: %s\n", which, what);
    exit(2);
}

/* ---- counts ------------------------------------------------------------------------------------------------------ */

static size_t find_cell(const char *scene, const char *by, const char *size, int map)
{
    for (size_t i = 0; i < plan.count && strcmp(size, image_size) == 0; i++) {
        const sweep_cell *c = &plan.cells[i];
        if ((int)c->map == map && strcmp(c->chain->name, by) == 0 && strcmp(c->scene->name, scene) == 0)
            return i;
    }
    fail(scene, "counted, but no frame of the report");
    return 0;
}

/* The n-th case is the n-th region. */
static void read_counts(FILE *in, int target, const char *path)
{
    enum { MOST_CASES = 4096 };
    static double *places[MOST_CASES];
    char line[512], scene[NAME], by[NAME], size[NAME], pass[NAME];
    int map, cases = 0, regions = 0, region;
    unsigned long long number;
    while (fgets(line, sizeof line, in)) {
        if (sscanf(line, "case %63s %63s %63s %d %63s", scene, by, size, &map, pass) == 5) {
            int which = *pass == 'v' ? LANE_VIEW : *pass == 'l' ? LANE_LIGHT : LANE_CAMERA;
            if (cases == MOST_CASES)
                fail(path, "too many cases");
            places[cases++] = &figures[find_cell(scene, by, size, map)][target].passes[which];
        } else if (sscanf(line, "plan %63s %63s %63s %d bytes %llu", scene, by, size, &map, &number) == 5) {
            figures[find_cell(scene, by, size, map)][target].bytes = (double)number;
        } else if (sscanf(line, "region %d instructions %llu", &region, &number) == 2 && region == regions &&
                   region < cases) {
            *places[regions++] = (double)number;
        }
    }
    if (!cases || cases != regions)
        fail(path, "expected a region for every case");
}

/* 0: there is none. */
static FILE *open_input(const char *folder, int target, const char *end, char path[1024])
{
    snprintf(path, 1024, "%s/%s%s", folder, target_names[target], end);
    return fopen(path, "r");
}

static void read_flash(FILE *in, int target)
{
    char line[256], by[NAME];
    double bytes;
    while (fgets(line, sizeof line, in))
        if (sscanf(line, "flash %63s %lf", by, &bytes) == 2)
            for (size_t i = 0; i < plan.count; i++)
                if (strcmp(plan.cells[i].chain->name, by) == 0)
                    figures[i][target].flash = bytes;
}

static void read_target(const char *counts, const char *flash, int target)
{
    char path[1024];
    FILE *in = open_input(counts, target, ".count", path);
    if (!in)
        return;
    read_counts(in, target, path);
    fclose(in);
    if (!(in = open_input(flash, target, ".flash", path)))
        fail(path, "cannot be read");
    read_flash(in, target);
    fclose(in);
    if (!(in = open_input(flash, target, ".version", path)) || !fgets(versions[target], sizeof versions[target], in))
        fail(path, "cannot be read");
    versions[target][strcspn(versions[target], "\n")] = 0;
    fclose(in);
}

/* ---- errors ------------------------------------------------------------------------------------------------------ */

static void compare(sweep_row *row, const sweep_scene *scene, const uint8_t *mask)
{
    comparison c;
    comparison_input input = {scene->width, scene->height, mask, scene->truth, 0, COMPARISON_EDGE_BAND};
    comparison_make(&c, &input);
    const comparison_figures *f = &c.all;
    row->false_shadow = comparison_percent(f, f->false_shadow.pixels);
    row->false_light = comparison_percent(f, f->false_light.pixels);
    row->error = comparison_percent(f, f->together.pixels);
    row->edge_band = comparison_percent(f, f->together.in_edge_band);
    row->interior = comparison_percent(f, f->together.in_interior);
    row->mean_absolute_error = 100 * f->mean_absolute_error;
}

/* What is rendered here must be what the firmware renders. */
static void check_settings(const sweep_cell *cell, const sweep_choice *choice)
{
    problem why;
    gn_settings here, there;
    packed_scene own = cell->scene->packed; /* edges are there, so nothing of it is written */
    uint32_t i = 0;
    while (i < chain_count && strcmp(chains[i].name, cell->chain->name) != 0)
        i++;
    if (i == chain_count)
        fail(cell->chain->name, "no such chain in port/report/chains.c");
    if (render_options_read(&here, &own, choice->values, &why))
        fail(cell->chain->name, why.text);
    there = chain_settings(&chains[i], here.width, here.height, here.map_width);
    if (here.shadow != there.shadow || here.receiver != there.receiver || here.reconstruction != there.reconstruction ||
        here.fit != there.fit || here.warp != there.warp || here.cull != there.cull || here.layers != there.layers ||
        here.surface != there.surface || here.slope != there.slope || here.bias.unit != there.bias.unit ||
        here.bias.value != there.bias.value || here.map_height != there.map_height ||
        here.fit_depth != there.fit_depth || here.smoothing != there.smoothing)
        fail(cell->chain->name, "other settings in port/report/chains.c");
}

static void measure(sweep_cell *cell)
{
    problem why;
    lane_frame f;
    sweep_choice choice;
    sweep_row *row = &cell->row;
    if (cell->reason)
        fail(cell->scene->name, cell->reason);
    *row = sweep_row_empty();
    sweep_choice_make(&choice, cell->chain, cell->map, image_size, 0);
    check_settings(cell, &choice);
    if (lane_find(16, 0)->render(&f, &cell->scene->packed, choice.values, 1, &why))
        fail(cell->chain->name, why.text);
    snprintf(row->scene, sizeof row->scene, "%s", cell->scene->name);
    snprintf(row->chain, sizeof row->chain, "%s", cell->chain->name);
    sweep_choice_text(&choice, row->options, sizeof row->options);
    row->depth_bits = 16;
    row->map = cell->map;
    row->resident_bytes = (double)sweep_resident_bytes(&f.plan);
    row->pixels = (double)f.statistics.pixels_shaded;
    compare(row, cell->scene, f.mask);
    lane_frame_free(&f);
    cell->is_done = 1;
}

/* Bytes are those of the first target that has any; all have pointers of 32 bits. */
static void take_figures(size_t i)
{
    const target_figures *of = figures[i];
    sweep_row *row = &plan.cells[i].row;
    for (int t = 0; t < TARGETS; t++) {
        if (!of[t].bytes)
            continue;
        if (row->peak_bytes > 0 && row->peak_bytes != of[t].bytes)
            fail(row->scene, "a plan has other bytes on other targets");
        row->peak_bytes = of[t].bytes;
    }
    if (of[0].passes[LANE_CAMERA] == 0)
        return;
    row->m4_view = of[0].passes[LANE_VIEW];
    row->m4_light = of[0].passes[LANE_LIGHT];
    row->m4_camera = of[0].passes[LANE_CAMERA];
    row->m4_pixel = (row->m4_view + row->m4_light + row->m4_camera) / row->pixels;
}

/* ---- the cost model ---------------------------------------------------------------------------------------------- */

static double predict(const sweep_cell *cell)
{
    problem why;
    double passes[LANE_PASSES], sum = 0;
    gn_settings settings;
    lane_frame plain, counting;
    const lane_frame *counted = &counting;
    sweep_choice choice;
    packed_scene own = cell->scene->packed; /* edges are there, so nothing of it is written */
    sweep_choice_make(&choice, cell->chain, cell->map, image_size, 0);
    if (!lane_find(16, 1))
        fail("model", "no lane that counts operations");
    if (render_options_read(&settings, &own, choice.values, &why) ||
        lane_find(16, 0)->measure(&plain, &own, choice.values, 1, &why) ||
        lane_find(16, 1)->measure(&counting, &own, choice.values, 1, &why) ||
        cost_model_m4(passes, &settings, &plain.plan, &plain.statistics, counted->operations, own.light.kind, &why))
        fail(cell->scene->name, why.text);
    for (int pass = 0; pass < LANE_PASSES; pass++)
        sum += passes[pass];
    return sum;
}

static void check_model(void)
{
    int frames = 0;
    double sum = 0, worst = 0;
    for (size_t i = 0; i < plan.count; i++) {
        const sweep_row *row = &plan.cells[i].row;
        if (isnan(row->m4_pixel))
            continue;
        double error = 100 * fabs(predict(&plan.cells[i]) / (row->m4_pixel * row->pixels) - 1);
        frames++;
        sum += error;
        worst = fmax(worst, error);
    }
    printf("model %d frames, %.2f %% mean error, %.2f %% worst\n", frames, sum / frames, worst);
}

/* ---- what comes of it -------------------------------------------------------------------------------------------- */

static void write_names(FILE *out)
{
    for (int t = 0; t < TARGETS; t++)
        if (*versions[t])
            fprintf(out, "# %s: %s\n", target_names[t], versions[t]);
    fprintf(out, "scene,chain,map,false_shadow,false_light,error,edge_band,interior,mean_absolute_error,resident_bytes,"
                 "bytes,pixels");
    for (int t = 0; t < TARGETS; t++)
        fprintf(out, ",%s_view,%s_light,%s_camera,%s_pixel,%s_flash", target_names[t], target_names[t], target_names[t],
                target_names[t], target_names[t]);
    fprintf(out, "\n");
}

static void write_target(FILE *out, const target_figures *f, double pixels)
{
    const double *passes = f->passes;
    if (passes[LANE_CAMERA] > 0)
        fprintf(out, ",%.0f,%.0f,%.0f,%.1f", passes[LANE_VIEW], passes[LANE_LIGHT], passes[LANE_CAMERA],
                (passes[LANE_VIEW] + passes[LANE_LIGHT] + passes[LANE_CAMERA]) / pixels);
    else
        fprintf(out, ",,,,");
    fprintf(out, f->flash > 0 ? ",%.0f" : ",", f->flash);
}

static void write_row(FILE *out, size_t i)
{
    const sweep_row *r = &plan.cells[i].row;
    fprintf(out, "%s,%s,%.0f,%.4f,%.4f,%.4f,%.4f,%.4f,%.4f,%.0f,", r->scene, r->chain, r->map, r->false_shadow,
            r->false_light, r->error, r->edge_band, r->interior, r->mean_absolute_error, r->resident_bytes);
    if (r->peak_bytes > 0)
        fprintf(out, "%.0f", r->peak_bytes);
    fprintf(out, ",%.0f", r->pixels);
    for (int t = 0; t < TARGETS; t++)
        write_target(out, &figures[i][t], r->pixels);
    fprintf(out, "\n");
}

static void write_csv(const char *path)
{
    problem why;
    file_output output;
    if (file_output_open(&output, path, &why))
        fail("csv", why.text);
    write_names(output.stream);
    for (size_t i = 0; i < plan.count; i++)
        write_row(output.stream, i);
    if (file_output_finish(&output, &why))
        fail("csv", why.text);
}

/* Every chain but the one whose bias is found by search: a firmware could not. */
static void read_request(sweep_request *request)
{
    static char methods[2048];
    problem why;
    size_t used = 0;
    for (int i = 0; i < SWEEP_CHAINS; i++)
        if (!sweep_chains[i].searches_bias)
            used +=
                (size_t)snprintf(methods + used, sizeof methods - used, "%s%s", used ? "," : "", sweep_chains[i].name);
    const sweep_request_values values = {methods, "64,128", "none", "16", image_size, "1"};
    if (sweep_request_read(request, &values, &why))
        fail("request", why.text);
}

static const char *option_of(int argc, char **argv, const char *name)
{
    for (int i = 1; i + 1 < argc; i++)
        if (strcmp(argv[i], name) == 0)
            return argv[i + 1];
    return 0;
}

int main(int argc, char **argv)
{
    problem why;
    sweep_request request;
    const char *csv = option_of(argc, argv, "--csv"), *page = option_of(argc, argv, "--page");
    int scene_count = 0;
    while (3 + scene_count < argc && strncmp(argv[3 + scene_count], "--", 2) != 0)
        scene_count++;
    if (!scene_count || !csv)
        fail("usage", "targets COUNTS FLASH SCENE... --csv FILE [--page FILE]");
    sweep_scene *scenes = memory_take((size_t)scene_count, sizeof *scenes);
    read_request(&request);
    if (sweep_scenes_read(scenes, scene_count, (const char *const *)argv + 3, request.image, &why) ||
        sweep_plan_make(&plan, &request, scenes, scene_count, &why))
        fail("scenes", why.text);
    figures = memory_take(plan.count, sizeof *figures);
    for (int i = 0; i < scene_count; i++)
        if (sweep_scene_truth(&scenes[i], argv[2], 2, &why))
            fail("truth", why.text);
    for (int t = 0; t < TARGETS; t++)
        read_target(argv[1], argv[2], t);
    for (size_t i = 0; i < plan.count; i++) {
        measure(&plan.cells[i]);
        take_figures(i);
    }
    write_csv(csv);
    if (page &&
        sweep_page_write(page, &plan, scenes, scene_count, "make report",
                         "Instructions are those of a Cortex-M4, counted under QEMU, over the pixels that see a "
                         "surface; of other targets in targets.csv and README.md.",
                         1, &why))
        fail("page", why.text);
    if (option_of(argc, argv, "--model"))
        check_model();
    return 0;
}
