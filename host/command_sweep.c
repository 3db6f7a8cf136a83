/* gnomon sweep: every method at every size on scenes of one's own: what it errs, what it costs. */
#include "commands.h"
#include "file.h"
#include "memory.h"
#include "options.h"
#include "sweep_page.h"
#include "sweep_report.h"
#include "sweep_work.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

const char sweep_summary[] = "measure all methods at all sizes: error, bytes, operations, time";

enum { OUTPUT, HEAD_ROWS, METHODS, MAPS, BUDGETS, DEPTHS, SIZE, HEAD_WORK, WORKERS, HELP, OPTION_COUNT };

static const option table[OPTION_COUNT] = {
    {"-o", "FOLDER",
     "where to write: sweep.csv, sweep.json, index.html, and the scenes' truths;\n"
     "made if it is missing (its parent must exist)"},
    {0, 0, "What is measured:"},
    {"--methods", "LIST", "chains of the list below, with commas; default all"},
    {"--maps", "LIST", "sides of maps in texels, or none; default 64,128,256,512,1024"},
    {"--budgets", "LIST",
     "bytes that stay between passes (K: 1024, M: 1048576), or none: each chain\n"
     "gets the largest square map that fits; default 32K,128K,512K"},
    {"--depths", "LIST", "bits of a stored depth: 16, 32 or 16,32 (the default)"},
    {"--size", "WxH", "the image's size, each from 1 to 4096; default: the scenes' own"},
    {0, 0, "How the work is done (changes nothing but the column host_ratio):"},
    {"--workers", "N", "rows that are measured at a time, 1 to 64; default: as many as processors"},
    {"--help", 0, "this text"},
};

static void help(void)
{
    puts("usage: gnomon sweep SCENE... -o FOLDER [options]\n\n"
         "Measure every chain of methods on every SCENE (.scene or .gno) at every size: how many pixels are wrong\n"
         "against the exact truth, in bytes, operations, instructions and time. docs/sweep.md says what each column "
         "is.\n"
         "Ctrl-C stops after the rows that are begun; the same command with the same folder goes on from there.\n");
    options_help(table, OPTION_COUNT, stdout);
    puts("\nChains:");
    for (int i = 0; i < SWEEP_CHAINS; i++)
        printf("  %s\n", sweep_chains[i].name);
    puts("\nExit status: 0 done, 2 bad usage or input, 128 + N stopped by signal N (130: Ctrl-C).");
}

typedef struct job {
    const char *values[OPTION_COUNT];
    command_line line;
    sweep_request request;
    sweep_scene *scenes;
    sweep_plan plan;
    sweep_journal journal;
    char *csv, *json, *page;
    char *command; /* as it may be typed; 0: not known */
    int stopped;   /* by a signal: its number; else 0 */
    problem why;
} job;

static int read_arguments(job *j)
{
    const char **v = j->values;
    const sweep_request_values values = {v[METHODS], v[MAPS], v[BUDGETS], v[DEPTHS], v[SIZE], v[WORKERS]};
    if (!j->line.place_count)
        return problem_of_usage(&j->why, "no scene; expected SCENE... -o FOLDER (gnomon sweep --help)");
    if (!v[OUTPUT] || !*v[OUTPUT])
        return problem_of_usage(&j->why, "no folder; expected -o FOLDER");
    return sweep_request_read(&j->request, &values, &j->why);
}

static int make_folder(job *j)
{
    const char *folder = j->values[OUTPUT];
    if (mkdir(folder, 0777) != 0 && errno != EEXIST)
        return problem_in(&j->why, folder, "cannot be made: %s; expected a folder whose parent exists",
                          strerror(errno));
    j->csv = sweep_path(folder, "sweep", ".csv");
    j->json = sweep_path(folder, "sweep", ".json");
    j->page = sweep_path(folder, "index", ".html");
    const char *const files[] = {j->csv, j->json, j->page};
    for (int i = 0; i < 3; i++)
        if (file_can_write(files[i], &j->why))
            return -1;
    return 0;
}

static int cast_truths(job *j)
{
    for (int i = 0; i < j->line.place_count && !sweep_interrupted(); i++)
        if (sweep_scene_truth(&j->scenes[i], j->values[OUTPUT], (int)j->request.workers, &j->why))
            return -1;
    return 0;
}

static size_t count_rows(const sweep_plan *plan, int done)
{
    size_t rows = 0;
    for (size_t i = 0; i < plan->count; i++)
        rows += done ? plan->cells[i].is_done : !plan->cells[i].reason;
    return rows;
}

/* Rows that are measured stay in the journal, whatever comes between. */
static int measure(job *j)
{
    size_t taken;
    if (sweep_journal_open(&j->journal, &j->plan, &taken, j->csv, &j->why))
        return -1;
    if (taken)
        fprintf(stderr, "gnomon: %zu of %zu rows were measured before\n", taken, count_rows(&j->plan, 0));
    return cast_truths(j) || sweep_work(&j->plan, &j->journal, (int)j->request.workers, &j->why) ? -1 : 0;
}

static int report(job *j)
{
    int count = j->line.place_count;
    if (sweep_journal_finish(&j->journal, &j->plan, &j->why) ||
        sweep_report_json(&j->plan, j->scenes, count, j->json, &j->why) ||
        sweep_page_write(j->page, &j->plan, j->scenes, count, j->command, 0, (int)j->request.workers, &j->why))
        return -1;
    sweep_report_left_out(stderr, &j->plan);
    printf("%zu rows in %s, %s and %s\n", count_rows(&j->plan, 1), j->csv, j->json, j->page);
    sweep_report_best(stdout, &j->plan, &j->request, j->scenes, count);
    return 0;
}

static int sweep(job *j)
{
    int count = j->line.place_count;
    if (read_arguments(j))
        return -1;
    j->scenes = memory_take((size_t)count, sizeof *j->scenes);
    if (sweep_scenes_read(j->scenes, count, j->line.places, j->request.image, &j->why) ||
        sweep_plan_make(&j->plan, &j->request, j->scenes, count, &j->why) || make_folder(j))
        return -1;
    sweep_catch_signals();
    if (measure(j))
        return -1;
    j->stopped = sweep_interrupted();
    if (!j->stopped)
        return report(j);
    fprintf(stderr, "gnomon: stopped with %zu of %zu rows in %s; the same command goes on from there\n",
            count_rows(&j->plan, 1), count_rows(&j->plan, 0), j->csv);
    return 0;
}

static void release(job *j)
{
    sweep_journal_close(&j->journal);
    sweep_plan_free(&j->plan);
    if (j->scenes)
        sweep_scenes_free(j->scenes, j->line.place_count);
    free(j->scenes);
    free(j->csv);
    free(j->json);
    free(j->page);
    free(j->command);
}

/* As a shell takes it. */
static void write_word(FILE *stream, const char *word)
{
    static const char plain[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+=./:,@%";
    if (*word && !word[strspn(word, plain)]) {
        fputs(word, stream);
        return;
    }
    putc('\'', stream);
    for (; *word; word++)
        if (*word == '\'')
            fputs("'\\''", stream);
        else
            putc(*word, stream);
    putc('\'', stream);
}

/* free() it; 0: there is no memory. */
static char *join(int argc, char **argv)
{
    char *command = 0;
    size_t size = 0;
    FILE *stream = open_memstream(&command, &size);
    if (!stream)
        return 0;
    fputs("gnomon sweep", stream);
    for (int i = 0; i < argc; i++) {
        putc(' ', stream);
        write_word(stream, argv[i]);
    }
    fclose(stream);
    return command;
}

int command_sweep(int argc, char **argv)
{
    enum { OF_SIGNALS = 128 };
    job j = {.command = join(argc, argv)};
    int result = options_parse(table, OPTION_COUNT, argc, argv, j.values, &j.line, &j.why);
    int helps = !result && j.values[HELP];
    if (helps)
        help();
    else if (!result)
        result = sweep(&j);
    if (result)
        fprintf(stderr, "%s\n", j.why.text);
    release(&j);
    return result ? EXIT_BAD_INPUT : j.stopped ? OF_SIGNALS + j.stopped : EXIT_DONE;
}
