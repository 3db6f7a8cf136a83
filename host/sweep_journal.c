#include "sweep_journal.h"

#include "file.h"
#include "sweep_csv.h"

#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* ---- what is there already ------------------------------------------------------------------------------------- */

static sweep_cell *find_cell(sweep_plan *plan, const sweep_row *row)
{
    for (size_t i = 0; i < plan->count; i++)
        if (!plan->cells[i].reason && strcmp(plan->cells[i].key, row->key) == 0)
            return &plan->cells[i];
    return 0;
}

/* Is it a row of the plan but for its key? */
static int has_names_of_a_cell(const sweep_plan *plan, const sweep_row *row)
{
    for (size_t i = 0; i < plan->count; i++) {
        const sweep_cell *c = &plan->cells[i];
        if (strcmp(c->scene->name, row->scene) == 0 && strcmp(c->chain->name, row->chain) == 0 &&
            c->depth_bits == (int)row->depth_bits && c->map == row->map && c->budget == row->budget)
            return 1;
    }
    return 0;
}

static int refuse(const sweep_plan *plan, const sweep_row *row, const char *path, long line, problem *why)
{
    if (has_names_of_a_cell(plan, row))
        return problem_at(why, path, line,
                          "scene %s, chain %s was measured with another content of the scene, image size or version of "
                          "gnomon; expected the same, or a folder without a sweep",
                          row->scene, row->chain);
    return problem_at(why, path, line,
                      "scene %s, chain %s, map %.0f is no row of this sweep; expected the scenes and options that the "
                      "folder's sweep began with, or more, or a folder without a sweep",
                      row->scene, row->chain, row->map);
}

static void take_row(sweep_cell *cell, const sweep_row *row, size_t *taken)
{
    *taken += !cell->is_done;
    cell->row = *row;
    cell->is_done = 1;
}

/* Killed between the lines of twins: one stands for the other. */
static void take_twins(sweep_plan *plan, size_t *taken)
{
    for (size_t i = 0; i < plan->count; i++) {
        sweep_cell *cell = &plan->cells[i], *twin = &plan->cells[cell->twin];
        if (cell->is_done || !twin->is_done)
            continue;
        take_row(cell, &twin->row, taken);
        cell->row.budget = cell->budget;
        memcpy(cell->row.key, cell->key, sizeof cell->key);
    }
}

static int take_rows(sweep_plan *plan, size_t *taken, const char *path, problem *why)
{
    sweep_row *rows;
    size_t count;
    int result = 0;
    if (sweep_csv_read(&rows, &count, path, why))
        return -1;
    for (size_t i = 0; i < count && !result; i++) {
        sweep_cell *cell = find_cell(plan, &rows[i]);
        if (cell)
            take_row(cell, &rows[i], taken);
        else
            result = refuse(plan, &rows[i], path, (long)i + 2, why);
    }
    free(rows);
    take_twins(plan, taken);
    return result;
}

/* ---- opening --------------------------------------------------------------------------------------------------- */

/* The names as this program writes them; free() them. */
static char *first_line(void)
{
    char *line = 0;
    size_t size = 0;
    FILE *stream = open_memstream(&line, &size);
    if (stream) {
        sweep_csv_write_names(stream);
        fclose(stream);
    }
    return line;
}

/* Rows are appended under the first line, so that must be ours, or the start of ours where it is cut. *size: of the
 * lines that are complete. */
static int check_file(const char *path, size_t *size, problem *why)
{
    file_content content;
    char *names = first_line();
    size_t length = names ? strlen(names) : 0;
    int result = file_read(&content, path, why);
    for (*size = result ? 0 : content.size; *size && content.bytes[*size - 1] != '\n';)
        --*size;
    if (!result && (!names || memcmp(content.bytes, names, content.size < length ? content.size : length) != 0))
        result = problem_at(why, path, 1,
                            "has other columns than this version of gnomon sweep writes; expected a folder without a "
                            "sweep of another version");
    free(names);
    free(content.bytes);
    return result;
}

static int fail(const char *path, problem *why)
{
    return problem_in(why, path, "cannot be written: %s; expected a place that can be written", strerror(errno));
}

/* Two sweeps at once would end with the rows of the one that ends last. A file system may have no locks: then nobody
 * holds one. */
static int hold(const sweep_journal *journal, problem *why)
{
    struct flock whole = {.l_type = F_WRLCK, .l_whence = SEEK_SET};
    if (fcntl(fileno(journal->stream), F_SETLK, &whole) == 0 || (errno != EAGAIN && errno != EACCES))
        return 0;
    return problem_in(why, journal->path, "is being written by another gnomon sweep; expected it to end before");
}

int sweep_journal_open(sweep_journal *journal, sweep_plan *plan, size_t *taken, const char *path, problem *why)
{
    size_t size = 0;
    *taken = 0;
    *journal = (sweep_journal){fopen(path, "ab"), path};
    if (!journal->stream)
        return fail(path, why);
    /* held anew after it is read: whoever closes a file lets go of it, though it is open elsewhere */
    if (hold(journal, why) || check_file(path, &size, why) || (size && take_rows(plan, taken, path, why)) ||
        hold(journal, why))
        return -1;
    if (ftruncate(fileno(journal->stream), (off_t)size) != 0)
        return fail(path, why);
    if (!size)
        sweep_csv_write_names(journal->stream);
    return fflush(journal->stream) ? fail(path, why) : 0;
}

/* ---- writing --------------------------------------------------------------------------------------------------- */

int sweep_journal_append(sweep_journal *journal, sweep_plan *plan, size_t cell, problem *why)
{
    size_t unused = 0;
    plan->cells[cell].is_done = 1;
    take_twins(plan, &unused);
    for (size_t i = cell; i < plan->count; i++)
        if (plan->cells[i].twin == cell)
            sweep_csv_write(journal->stream, &plan->cells[i].row);
    return fflush(journal->stream) ? fail(journal->path, why) : 0;
}

void sweep_journal_close(sweep_journal *journal)
{
    if (journal->stream)
        fclose(journal->stream);
    journal->stream = 0;
}

int sweep_journal_finish(sweep_journal *journal, const sweep_plan *plan, problem *why)
{
    file_output output;
    if (file_output_open(&output, journal->path, why))
        return -1;
    sweep_csv_write_names(output.stream);
    for (size_t i = 0; i < plan->count; i++)
        if (plan->cells[i].is_done)
            sweep_csv_write(output.stream, &plan->cells[i].row);
    int result = file_output_finish(&output, why);
    sweep_journal_close(journal); /* held until its place is taken */
    return result;
}
