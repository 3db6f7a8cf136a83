/* Runs the hard cases: TAP for `make test`, or the table and the pictures of docs/stability.md.
 *
 *     hard [--short] [CASE...]           promises, one a line
 *     hard --table [CASE...]             rows of the table, in Markdown
 *     hard --pictures FOLDER [CASE...]   CASE.ppm: what a method gives, and its difference from the truth
 *     hard --write FOLDER [CASE...]      CASE.gno: the scenes, for `gnomon render`
 */
#include "hard.h"

#include "image.h"
#include "memory.h"
#include "pack.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef enum mode { MODE_TEST, MODE_TABLE, MODE_PICTURES, MODE_WRITE } mode;

static struct {
    mode mode;
    const char *folder;
    int is_short;
    unsigned tests, failures;
} run;

int hard_is_short(void)
{
    return run.is_short;
}

int promise(hard_row *row, int condition, const char *reason, const char *name, ...)
{
    va_list arguments;
    *(condition ? &row->met : &row->unmet) += 1;
    run.tests++;
    run.failures += !condition && !reason;
    if (run.mode != MODE_TEST)
        return condition;
    printf("%s %u - ", condition ? "ok" : "not ok", run.tests);
    va_start(arguments, name);
    vprintf(name, arguments);
    va_end(arguments);
    if (reason)
        printf(" # TODO %s", reason);
    printf("\n");
    fflush(stdout);
    if (!condition && !reason && getenv("TAP_STOP"))
        exit(1);
    return condition;
}

void say(const char *format, ...)
{
    va_list arguments;
    FILE *out = run.mode == MODE_TEST ? stdout : stderr;
    fprintf(out, "# ");
    va_start(arguments, format);
    vfprintf(out, format, arguments);
    va_end(arguments);
    fprintf(out, "\n");
}

/* ---- one case -------------------------------------------------------------------------------------------------- */

static int within(double value, double least, double most)
{
    return value >= least && value <= most;
}

static void check_outcome(hard_row *row, int method)
{
    outcome *o = &row->outcomes[method];
    const hard_case *c = row->about;
    const expectation *e = &c->methods[method];
    double shadow = percent_of(row, method == COLUMN_VOLUMES ? o->false_shadow : o->own_shadow);
    double light = percent_of(row, method == COLUMN_VOLUMES ? o->false_light : o->own_light);
    o->met = within(shadow, e->shadow_least, e->shadow_most) && within(light, e->light_least, e->light_most);
    if (!promise(row, o->met, e->unmet, "%s_%s_errs_as_derived", c->name, method_names[method]))
        say("of its own: false shadow %.3f %%, expected %g to %g; false light %.3f %%, expected %g to %g", shadow,
            e->shadow_least, e->shadow_most, light, e->light_least, e->light_most);
    if (!promise(row, o->coverage == 0, 0, "%s_%s_sees_the_surfaces_of_the_truth", c->name, method_names[method]))
        say("%llu pixels see a surface in one mask alone", (unsigned long long)o->coverage);
}

/* Wrong, right with mixed and virtual samples alone, and with one truth at the centres of all texels within one of the
 * pixel's own. */
static size_t spoilt_pixels(hard_row *row, const outcome *o)
{
    const uint8_t *without = row->outcomes[COLUMN_MIXED_VIRTUAL].mask, *right = row->truth.mask;
    size_t spoilt = 0;
    for (size_t i = 0; i < (size_t)row->truth.width * row->truth.height; i++)
        spoilt += !row->near[i] && o->mask[i] != right[i] && without[i] == right[i] &&
                  !footprint_differs_about(&row->footprint, i, right[i], 1);
    return spoilt;
}

/* Silhouettes and crossings choose among the samples of the four texels about a point, so they cannot spoil what lies
 * farther than a texel from a border. Near it they may cut off the corners of a shadow, half a texel each: there are
 * eight of them at most in a picture, and a texel is at most 18 pixels of a floor in a sun 30 degrees high: 0.4 % of
 * 19200. Cases with larger texels say how much in `worse`. */
static void check_borders(hard_row *row)
{
    const hard_case *c = row->about;
    const outcome *without = &row->outcomes[COLUMN_MIXED_VIRTUAL];
    gn_settings settings = method_settings(&row->packed, COLUMN_MIXED_VIRTUAL, c->flags);
    double worse = c->worse > 0 ? c->worse : 0.4;
    if (!without->ran)
        row_measure(row, COLUMN_MIXED_VIRTUAL, &settings);
    for (int method = COLUMN_SILHOUETTES; method < COLUMN_ALL; method++) {
        const outcome *o = &row->outcomes[method];
        settings = method_settings(&row->packed, method, c->flags);
        row_measure(row, method, &settings);
        if (!promise(row, o->ran && without->ran, 0, "%s_%s_renders", c->name, method_names[method])) {
            say("%s", o->refusal);
            continue;
        }
        double most = without->shadow_percent + without->light_percent + worse;
        size_t spoilt = spoilt_pixels(row, o);
        if (!promise(row, spoilt == 0, 0, "%s_%s_spoils_nothing_within_surfaces", c->name, method_names[method]))
            say("%zu pixels are wrong, right without, and a texel from all borders", spoilt);
        if (!promise(row, o->shadow_percent + o->light_percent <= most, 0, "%s_%s_is_not_worse_than_without", c->name,
                     method_names[method]))
            say("%.3f %% false shadow, %.3f %% false light, expected at most %.3f %% in all", o->shadow_percent,
                o->light_percent, most);
        promise(row, o->coverage == 0, 0, "%s_%s_sees_the_surfaces_of_the_truth", c->name, method_names[method]);
    }
}

static void run_methods(hard_row *row)
{
    int last = row->about->flags & WITH_RECEIVERS ? COLUMN_RECEIVERS_END : COLUMN_COUNT;
    for (int method = 0; method < last; method++) {
        gn_settings settings = method_settings(&row->packed, method, row->about->flags);
        row_measure(row, method, &settings);
        if (row->outcomes[method].ran)
            check_outcome(row, method);
        else if (!promise(row, 0, 0, "%s_%s_renders", row->about->name, method_names[method]))
            say("%s", row->outcomes[method].refusal);
    }
}

static void run_case(hard_row *row)
{
    const hard_case *c = row->about;
    if (c->run) {
        c->run(row);
    } else if (!row_begin(row, c->build, 1)) {
        run_methods(row);
        check_borders(row);
        if (c->check)
            c->check(row);
    }
    row_end(row);
}

/* ---- the table ------------------------------------------------------------------------------------------------- */

static const char *const column_names[COLUMN_ALL] = {"constant",        "midpoint",    "dual",     "second depth",
                                                     "mixed",           "auto",        "volumes",  "second + virtual",
                                                     "mixed + virtual", "adaptive",    "slope",    "plane bias",
                                                     "auto + pcf5",     "silhouettes", "crossings"};

static void print_cell(const hard_row *row, int method)
{
    const outcome *o = &row->outcomes[method];
    if (!o->ran) {
        printf(" - |");
        return;
    }
    int own = method == COLUMN_VOLUMES ? o->false_shadow + o->false_light > 0 : o->own_shadow + o->own_light > 0;
    const char *mark = own ? "**" : "";
    printf(" %s%.1f + %.1f%s |", mark, o->shadow_percent, o->light_percent, mark);
}

/* Promises of which the case says that they do not hold today, and that did not. */
static int known_to_fail(const hard_row *row)
{
    int count = 0;
    for (int method = 0; method < COLUMN_RECEIVERS_END; method++) {
        const outcome *o = &row->outcomes[method];
        count += o->ran && !o->met && row->about->methods[method].unmet;
    }
    return count;
}

static void print_row(const hard_row *row)
{
    const hard_case *c = row->about;
    printf("| %s%s%s%s | %s%s%s |", c->title, c->source ? " (" : "", c->source ? c->source : "", c->source ? ")" : "",
           c->expected, row->remark[0] ? " " : "", row->remark);
    for (int method = 0; method < COLUMN_COUNT; method++)
        print_cell(row, method);
    printf(" %s", c->advice);
    for (int method = 0; row->unmet && method < COLUMN_RECEIVERS_END; method++)
        if (row->outcomes[method].ran && !row->outcomes[method].met && c->methods[method].unmet)
            printf(" **Not met**, %s: %s.", column_names[method], c->methods[method].unmet);
    printf("%s |\n", row->unmet > known_to_fail(row) ? " **Not met.**" : "");
}

static void print_head(int first, int last, const char *end)
{
    printf("\n| case | expected |");
    for (int method = first; method < last; method++)
        printf(" %s |", column_names[method]);
    printf("%s\n|---|---|", end);
    for (int method = first; method < last; method++)
        printf("---|");
    printf("%s\n", *end ? "---|" : "");
}

/* A group's second table is kept until its first one is done. */
static struct {
    hard_row *rows[100];
    int count;
} receivers;

static void print_receivers(void)
{
    if (receivers.count == 0)
        return;
    printf("\nWith virtual samples, and with their rivals:\n");
    print_head(COLUMN_SECOND_VIRTUAL, COLUMN_ALL, "");
    for (int i = 0; i < receivers.count; i++) {
        const hard_row *row = receivers.rows[i];
        printf("| %s | %s |", row->about->title, row->about->receivers);
        for (int method = COLUMN_SECOND_VIRTUAL; method < COLUMN_ALL; method++)
            print_cell(row, method);
        printf("\n");
        free(receivers.rows[i]);
    }
    receivers.count = 0;
}

static void print_group(const char *group)
{
    print_receivers();
    printf("\n## %s\n", group);
    print_head(0, COLUMN_COUNT, " what to know |");
}

/* ---- pictures and scenes --------------------------------------------------------------------------------------- */

static int write_image(const image *picture, const char *name, const char *kind)
{
    char path[1000];
    problem why;
    snprintf(path, sizeof path, "%s/%s%s.ppm", run.folder, name, kind);
    if (!image_write(picture, path, &why))
        return 0;
    say("%s", why.text);
    return 1;
}

static int write_pictures(hard_row *row)
{
    const hard_case *c = row->about;
    int failed = row_begin(row, c->build, 0);
    outcome *o = &row->outcomes[c->picture - 1];
    gn_settings settings = method_settings(&row->packed, c->picture - 1, c->flags);
    image colours = {.width = settings.width, .height = settings.height, .channels = 3, .sample = IMAGE_U8};
    problem why;
    if (!failed && method_render(&row->packed, &settings, &o->mask, (uint8_t **)&colours.samples, &why)) {
        say("%s", why.text);
        failed = 1;
    }
    if (!failed) {
        image difference = comparison_picture(&(comparison_input){settings.width, settings.height, o->mask,
                                                                  row->truth.mask, row->near, COMPARISON_EDGE_BAND});
        failed = write_image(&colours, c->name, "") || write_image(&difference, c->name, ".difference");
        image_free(&difference);
    }
    image_free(&colours);
    row_end(row);
    return failed;
}

static int write_scene(hard_row *row)
{
    char path[1000];
    problem why;
    builder b;
    build_begin(&b);
    row->about->build(&b);
    int failed = build_finish(&b, &row->packed);
    snprintf(path, sizeof path, "%s/%s.gno", run.folder, row->about->name);
    if (!failed && pack_write(&row->packed, path, &why)) {
        say("%s", why.text);
        failed = 1;
    }
    build_free(&b);
    packed_free(&row->packed);
    return failed;
}

/* ---- the program ----------------------------------------------------------------------------------------------- */

static int is_asked_for(const hard_case *c, int names, char **name)
{
    for (int i = 0; i < names; i++)
        if (strcmp(name[i], c->name) == 0)
            return 1;
    return names == 0;
}

static int do_case(const hard_case *c)
{
    hard_row *row = memory_take(1, sizeof *row);
    int failed = 0;
    row->about = c;
    if (run.mode == MODE_PICTURES)
        failed = c->picture ? write_pictures(row) : 0;
    else if (run.mode == MODE_WRITE)
        failed = c->build ? write_scene(row) : 0;
    else
        run_case(row);
    if (run.mode == MODE_TABLE)
        print_row(row);
    if (run.mode == MODE_TABLE && c->flags & WITH_RECEIVERS && receivers.count < (int)COUNT(receivers.rows))
        receivers.rows[receivers.count++] = row;
    else
        free(row);
    return failed;
}

static int do_cases(int names, char **name)
{
    const hard_list *lists[] = {&papers_cases, &light_cases, &geometry_cases, &silhouette_cases,
                                &number_cases, &file_cases,  &sweep_cases};
    const char *group = "";
    int failed = 0, done = 0;
    for (size_t l = 0; l < sizeof lists / sizeof *lists; l++)
        for (size_t i = 0; i < lists[l]->count; i++) {
            const hard_case *c = &lists[l]->cases[i];
            if (!is_asked_for(c, names, name) || (run.is_short && c->flags & LONG))
                continue;
            if (run.mode == MODE_TABLE && strcmp(group, c->group) != 0)
                print_group(group = c->group);
            failed |= do_case(c);
            done++;
        }
    print_receivers();
    if (!done)
        say("no such case");
    return failed || !done;
}

static int usage(void)
{
    fputs("usage: hard [--short] [--table | --pictures FOLDER | --write FOLDER] [CASE...]\n", stderr);
    return 2;
}

int main(int argc, char **argv)
{
#if defined GN_CHECKED || defined __SANITIZE_ADDRESS__
    run.is_short = 1;
#endif
    int i = 1;
    for (; i < argc && argv[i][0] == '-'; i++) {
        int takes_folder = !strcmp(argv[i], "--pictures") || !strcmp(argv[i], "--write");
        if (takes_folder && i + 1 == argc)
            return usage();
        if (!strcmp(argv[i], "--short"))
            run.is_short = 1;
        else if (!strcmp(argv[i], "--table"))
            run.mode = MODE_TABLE;
        else if (takes_folder)
            run.mode = argv[i][2] == 'p' ? MODE_PICTURES : MODE_WRITE;
        else
            return usage();
        if (takes_folder)
            run.folder = argv[++i];
    }
    int failed = do_cases(argc - i, argv + i);
    if (run.mode != MODE_TEST)
        return failed ? 2 : 0;
    printf("1..%u\n", run.tests);
    if (run.failures)
        say("%u of %u failed", run.failures, run.tests);
    return failed || run.failures != 0;
}
