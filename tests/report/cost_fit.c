/* Fits the cost model of host/cost_model.c to frames counted under QEMU, or says how well it predicts scenes that it
 * was not fitted to.
 *
 *     cost_fit COUNTS SCENE...                       writes host/cost_model_table.c to standard output
 *     cost_fit COUNTS SCENE... --validate GROUP...   writes errors
 *     cost_fit COUNTS SCENE... --check               errors of the table that is linked, no fit
 *
 * COUNTS: what port/report/calibrate.c printed and the plugin counted of it (`case SCENE CHAIN WxH MAP PASS`, `region K
 * instructions N`). SCENE: the files of the same scenes; their frames are rendered here by the lane of 16 bits and by
 * the one that counts operations. GROUP: names of scenes with commas between them, which are left out together: the
 * model is fitted to all others and predicts these. A line: mean and worst error in per cent, of the view, light and
 * camera pass and of the frame, with operations and without.
 *
 * Least squares of relative errors. Sums of costs are not negative; corrections of operations may be, and are held
 * near 0 where frames say nothing about them. Exit status 2: an input is missing or does not fit the others. */
#include "cost_model.h"
#include "memory.h"
#include "sweep_chains.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_FRAMES = 8192, MOST_CASES = LANE_PASSES * MOST_FRAMES, NAME = 64 };

typedef struct counted_frame {
    char scene[NAME], chain[NAME], size[NAME];
    int map, light_kind, rendered;
    gn_settings settings;
    lane_frame frame;
    double counted[LANE_PASSES]; /* 0: no such pass */
} counted_frame;

static counted_frame *frames;
static int frame_count;

static void fail(const char *which, const char *what)
{
    fprintf(stderr, "cost_fit: %s: %s\n", which, what);
    exit(2);
}

/* ---- what was counted, and the same frames here ------------------------------------------------------------------ */

static int is_frame(const counted_frame *f, const char *scene, const char *by, const char *size, int map)
{
    return f->map == map && strcmp(f->size, size) == 0 && strcmp(f->chain, by) == 0 && strcmp(f->scene, scene) == 0;
}

/* Passes of a frame follow each other. */
static counted_frame *take_frame(const char *scene, const char *by, const char *size, int map)
{
    counted_frame *f = &frames[frame_count - 1];
    if (frame_count && is_frame(f, scene, by, size, map))
        return f;
    if (frame_count == MOST_FRAMES)
        fail(scene, "too many frames");
    f = &frames[frame_count++];
    snprintf(f->scene, NAME, "%s", scene);
    snprintf(f->chain, NAME, "%s", by);
    snprintf(f->size, NAME, "%s", size);
    f->map = map;
    return f;
}

/* The n-th case is the n-th region. */
static void read_counts(const char *path)
{
    static double *places[MOST_CASES];
    char line[512], scene[NAME], by[NAME], size[NAME], pass[NAME];
    int map, cases = 0, regions = 0, region;
    unsigned long long count;
    FILE *in = fopen(path, "r");
    if (!in)
        fail(path, "cannot be read");
    while (fgets(line, sizeof line, in)) {
        if (sscanf(line, "case %63s %63s %63s %d %63s", scene, by, size, &map, pass) == 5) {
            int which = *pass == 'v' ? LANE_VIEW : *pass == 'l' ? LANE_LIGHT : LANE_CAMERA;
            if (cases == MOST_CASES)
                fail(path, "too many cases");
            places[cases++] = &take_frame(scene, by, size, map)->counted[which];
        } else if (sscanf(line, "region %d instructions %llu", &region, &count) == 2 && region == regions &&
                   region < cases) {
            *places[regions++] = (double)count;
        }
    }
    fclose(in);
    if (!cases || cases != regions)
        fail(path, "expected a region for every case");
}

static void render(counted_frame *f, const packed_scene *packed)
{
    problem why;
    lane_frame operations;
    packed_scene own = *packed;
    sweep_choice choice;
    const sweep_chain *by = sweep_chain_find(f->chain, strlen(f->chain));
    const lane *plain = lane_find(16, 0), *counting = lane_find(16, 1);
    if (!by || !plain || !counting)
        fail(f->chain, by ? "no lane that counts operations" : "no such chain");
    sweep_choice_make(&choice, by, (unsigned)f->map, f->size, 0);
    if (render_options_read(&f->settings, &own, choice.values, &why) ||
        plain->measure(&f->frame, packed, choice.values, 1, &why) ||
        counting->measure(&operations, packed, choice.values, 1, &why))
        fail(f->scene, why.text);
    memcpy(f->frame.operations, operations.operations, sizeof f->frame.operations);
    f->light_kind = packed->light.kind;
    f->rendered = 1;
}

/* The file's name without folder and ending. */
static int is_named(const char *path, const char *scene)
{
    const char *base = strrchr(path, '/');
    base = base ? base + 1 : path;
    return strcspn(base, ".") == strlen(scene) && strncmp(base, scene, strlen(scene)) == 0;
}

static void render_scene(const char *path)
{
    problem why;
    packed_scene packed;
    if (packed_read(&packed, path, 0, &why) || packed_make_edges(&packed, 0, &why))
        fail(path, why.text);
    for (int i = 0; i < frame_count; i++)
        if (is_named(path, frames[i].scene))
            render(&frames[i], &packed);
    packed_free(&packed);
}

/* ---- least squares ----------------------------------------------------------------------------------------------- */

typedef struct fit {
    int count, sums;
    const char *name[COST_MOST_FEATURES];
    double product[COST_MOST_FEATURES][COST_MOST_FEATURES], target[COST_MOST_FEATURES];
    double x[COST_MOST_FEATURES];
} fit;

/* The fits of all jobs, without operations and with them. */
typedef struct model {
    fit fits[2][COST_JOBS];
} model;

static cost_job features_of(cost_features *features, const counted_frame *f, int pass, int with_operations)
{
    return cost_model_features(features, (lane_pass)pass, &f->settings, &f->frame.plan, &f->frame.statistics,
                               with_operations ? f->frame.operations[pass] : 0, f->light_kind);
}

/* Both sides over what was counted, so that a per cent counts alike in small frames and large ones. */
static void add_pass(model *m, const counted_frame *f, int pass, int with_operations)
{
    cost_features features;
    cost_job job = features_of(&features, f, pass, with_operations);
    fit *e = &m->fits[with_operations][job];
    e->count = features.count;
    e->sums = features.sums;
    for (int i = 0; i < e->count; i++) {
        double of_row = features.value[i] / f->counted[pass];
        e->name[i] = features.name[i];
        e->target[i] += of_row;
        for (int j = 0; j < e->count; j++)
            e->product[i][j] += of_row * features.value[j] / f->counted[pass];
    }
}

/* One coefficient after the other, to the least sum of squares that it can give. What is left of slow convergence are
 * coefficients that can stand for one another. */
static void solve(fit *e)
{
    enum { SWEEPS = 4000 };
    const double hold = 1e-3; /* of corrections */
    for (int sweep = 0; sweep < SWEEPS; sweep++)
        for (int i = 0; i < e->count; i++) {
            double rest = e->target[i];
            if (e->product[i][i] == 0)
                continue;
            for (int j = 0; j < e->count; j++)
                rest -= j == i ? 0 : e->product[i][j] * e->x[j];
            e->x[i] = rest / (e->product[i][i] * (i < e->sums ? 1 : 1 + hold));
            if (i < e->sums && rest < 0)
                e->x[i] = 0;
        }
}

/* Is the scene one of a list with commas? */
static int is_in(const char *list, const char *scene)
{
    size_t length = strlen(scene);
    for (const char *at = list; (at = strstr(at, scene)) != 0; at += length)
        if ((at == list || at[-1] == ',') && (at[length] == 0 || at[length] == ','))
            return 1;
    return 0;
}

static void fit_without(model *m, const char *left_out)
{
    memset(m, 0, sizeof *m);
    for (int i = 0; i < frame_count; i++)
        for (int pass = 0; pass < LANE_PASSES; pass++)
            if (frames[i].counted[pass] > 0 && !is_in(left_out, frames[i].scene)) {
                add_pass(m, &frames[i], pass, 0);
                add_pass(m, &frames[i], pass, 1);
            }
    for (int job = 0; job < COST_JOBS; job++) {
        solve(&m->fits[0][job]);
        solve(&m->fits[1][job]);
    }
}

/* ---- what comes of it -------------------------------------------------------------------------------------------- */

static const char *const job_names[COST_JOBS] = {"view", "light", "camera", "volumes_light", "volumes_camera"};

static void write_list(const fit *e, const char *name, int with_operations)
{
    printf("static const cost_coefficient %s%s[] = {\n", name, with_operations ? "_by_operations" : "");
    for (int i = 0; i < e->count; i++)
        printf("    {\"%s\", %.5g},\n", e->name[i], e->x[i]);
    printf("};\n\n");
}

static void write_table(void)
{
    static model m;
    fit_without(&m, "");
    printf(
        "/* Written by tests/report/cost_fit.c (`make cost-model`): instructions of a Cortex-M4 for one of each. */\n"
        "#include \"cost_model.h\"\n\n/* clang-format off */\n");
    for (int job = 0; job < COST_JOBS; job++) {
        write_list(&m.fits[0][job], job_names[job], 0);
        write_list(&m.fits[1][job], job_names[job], 1);
    }
    printf("const cost_coefficient *const cost_model_table[2][COST_JOBS] = {\n"
           "    {view, light, camera, volumes_light, volumes_camera},\n"
           "    {view_by_operations, light_by_operations, camera_by_operations, volumes_light_by_operations,\n"
           "     volumes_camera_by_operations},\n};\n");
}

typedef struct errors {
    int count;
    double sum, worst;
    const counted_frame *at;
} errors;

enum { WHOLE_FRAME = LANE_PASSES };

static void add_error(errors *e, const counted_frame *f, double predicted, double counted)
{
    double error = 100 * fabs(predicted / counted - 1);
    e->count++;
    e->sum += error;
    if (error > e->worst) {
        e->worst = error;
        e->at = f;
    }
}

static void add_errors(errors of[LANE_PASSES + 1], const counted_frame *f, const double predicted[LANE_PASSES])
{
    double sum = 0, counted = 0;
    for (int pass = 0; pass < LANE_PASSES; pass++) {
        if (f->counted[pass] == 0)
            continue;
        add_error(&of[pass], f, predicted[pass], f->counted[pass]);
        sum += predicted[pass];
        counted += f->counted[pass];
    }
    add_error(&of[WHOLE_FRAME], f, sum, counted);
}

static void write_errors(const char *what, const errors of[LANE_PASSES + 1])
{
    static const char *const names[LANE_PASSES + 1] = {"view", "light", "camera", "frame"};
    printf("%-20s", what);
    for (int i = 0; i <= LANE_PASSES; i++)
        if (of[i].count)
            printf("  %s %.1f %.1f", names[i], of[i].sum / of[i].count, of[i].worst);
    if (of[WHOLE_FRAME].at)
        printf("  worst frame: %s %s %s %d", of[WHOLE_FRAME].at->scene, of[WHOLE_FRAME].at->chain,
               of[WHOLE_FRAME].at->size, of[WHOLE_FRAME].at->map);
    printf("\n");
}

static double predict(const model *m, const counted_frame *f, int pass, int with_operations)
{
    cost_features features;
    const fit *e = &m->fits[with_operations][features_of(&features, f, pass, with_operations)];
    double sum = 0;
    for (int i = 0; i < features.count; i++)
        sum += features.value[i] * e->x[i];
    return sum > 0 ? sum : 0;
}

static void validate(char **groups, int group_count, int with_operations)
{
    static model m;
    errors all[LANE_PASSES + 1] = {{0, 0, 0, 0}};
    printf("%s\n", with_operations ? "with operations" : "without");
    for (int g = 0; g < group_count; g++) {
        errors of[LANE_PASSES + 1] = {{0, 0, 0, 0}};
        fit_without(&m, groups[g]);
        for (int i = 0; i < frame_count; i++) {
            double predicted[LANE_PASSES] = {0};
            if (!is_in(groups[g], frames[i].scene))
                continue;
            for (int pass = 0; pass < LANE_PASSES; pass++)
                predicted[pass] = frames[i].counted[pass] > 0 ? predict(&m, &frames[i], pass, with_operations) : 0;
            add_errors(of, &frames[i], predicted);
            add_errors(all, &frames[i], predicted);
        }
        write_errors(groups[g], of);
    }
    write_errors("all", all);
}

static void check(int with_operations)
{
    problem why;
    errors all[LANE_PASSES + 1] = {{0, 0, 0, 0}};
    for (int i = 0; i < frame_count; i++) {
        const counted_frame *f = &frames[i];
        double predicted[LANE_PASSES];
        if (cost_model_m4(predicted, &f->settings, &f->frame.plan, &f->frame.statistics,
                          with_operations ? f->frame.operations : 0, f->light_kind, &why))
            fail(f->scene, why.text);
        add_errors(all, f, predicted);
    }
    write_errors(with_operations ? "with operations" : "without", all);
}

int main(int argc, char **argv)
{
    int scenes_end = 2;
    frames = memory_take(MOST_FRAMES, sizeof *frames);
    memset(frames, 0, MOST_FRAMES * sizeof *frames);
    while (scenes_end < argc && strncmp(argv[scenes_end], "--", 2) != 0)
        scenes_end++;
    if (scenes_end < 3)
        fail("usage", "cost_fit COUNTS SCENE... [--validate GROUP... | --check]");
    read_counts(argv[1]);
    for (int i = 2; i < scenes_end; i++)
        render_scene(argv[i]);
    for (int i = 0; i < frame_count; i++)
        if (!frames[i].rendered)
            fail(frames[i].scene, "counted, but there is no such SCENE");
    if (scenes_end == argc) {
        write_table();
    } else if (strcmp(argv[scenes_end], "--check") == 0) {
        check(1);
        check(0);
    } else {
        validate(argv + scenes_end + 1, argc - scenes_end - 1, 1);
        validate(argv + scenes_end + 1, argc - scenes_end - 1, 0);
    }
    return 0;
}
