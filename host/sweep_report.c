#include "sweep_report.h"

#include "choices.h"
#include "file.h"
#include "memory.h"
#include "page_advice.h"
#include "sweep_csv.h"

#include <stdlib.h>
#include <string.h>

/* ---- JSON ------------------------------------------------------------------------------------------------------ */

static const char *light_word(const sweep_scene *s)
{
    static const char *const words[] = {"directional", "spot", "point"};
    return words[s->packed.light.kind];
}

static void write_scene(json *j, const sweep_scene *s)
{
    json_open_item(j);
    json_string(j, "name", s->name);
    json_string(j, "file", s->path);
    json_string(j, "light", light_word(s));
    json_integer(j, "width", s->width);
    json_integer(j, "height", s->height);
    json_integer(j, "triangles", (int64_t)packed_triangle_count(&s->packed));
    json_integer(j, "surface_pixels", (int64_t)s->surface);
    json_integer(j, "truly_lit", (int64_t)s->lit);
    json_integer(j, "truly_shadowed", (int64_t)s->shadowed);
    json_close(j);
}

static void write_left_out(json *j, const sweep_cell *c)
{
    json_open_item(j);
    json_string(j, "scene", c->scene->name);
    json_string(j, "chain", c->chain->name);
    json_integer(j, "depth_bits", c->depth_bits);
    json_integer(j, "map", c->map);
    json_integer(j, "budget", c->budget);
    json_string(j, "reason", c->reason);
    json_close(j);
}

static void write_columns(json *j)
{
    json_open_list(j, "columns");
    for (int i = 0; i < SWEEP_COLUMNS; i++) {
        json_open_item(j);
        json_string(j, "name", sweep_columns[i].name);
        json_string(j, "unit", sweep_columns[i].unit);
        json_string(j, "meaning", sweep_columns[i].meaning);
        json_close(j);
    }
    json_close_list(j);
}

int sweep_report_json(const sweep_plan *plan, const sweep_scene *scenes, int scene_count, const char *path,
                      problem *why)
{
    file_output output;
    if (file_output_open(&output, path, why))
        return -1;
    json j = {.stream = output.stream};
    json_open(&j, 0);
    json_string(&j, "version", GN_VERSION);
    json_integer(&j, "bits_version", GN_BITS_VERSION);
    write_columns(&j);
    json_open_list(&j, "scenes");
    for (int i = 0; i < scene_count; i++)
        write_scene(&j, &scenes[i]);
    json_close_list(&j);
    json_open_list(&j, "left_out");
    for (size_t i = 0; i < plan->count; i++)
        if (plan->cells[i].reason)
            write_left_out(&j, &plan->cells[i]);
    json_close_list(&j);
    json_open_list(&j, "rows");
    for (size_t i = 0; i < plan->count; i++)
        if (plan->cells[i].is_done) {
            json_open_item(&j);
            sweep_json_write(&j, &plan->cells[i].row);
            json_close(&j);
        }
    json_close_list(&j);
    json_close(&j);
    return file_output_finish(&output, why);
}

/* ---- lines ----------------------------------------------------------------------------------------------------- */

/* Of the scene; the result has room for all. */
static size_t take_rows(const sweep_row **rows, const sweep_plan *plan, const sweep_scene *scene)
{
    size_t count = 0;
    for (size_t i = 0; i < plan->count; i++)
        if (plan->cells[i].is_done && plan->cells[i].scene == scene)
            rows[count++] = &plan->cells[i].row;
    return count;
}

void sweep_report_best(FILE *stream, const sweep_plan *plan, const sweep_request *request, const sweep_scene *scenes,
                       int scene_count)
{
    const sweep_row **rows = memory_take(plan->count, sizeof *rows);
    for (int i = 0; i < scene_count; i++) {
        advice_rows of = {rows, take_rows(rows, plan, &scenes[i]), ADVICE_NO_COST};
        of.cost = advice_best_known(&of);
        for (int b = 0; b < request->budget_count; b++) {
            const sweep_row *best = advice_best(&of, (double)request->budgets[b]);
            if (best)
                fprintf(stream, "%s, %ld bytes: %s, map %.0f, %.0f bits: %.3f %% wrong\n", scenes[i].name,
                        request->budgets[b], best->chain, best->map, best->depth_bits, best->error);
        }
    }
    free(rows);
}

static int is_first_of_its_reason(const sweep_plan *plan, size_t index)
{
    const sweep_cell *c = &plan->cells[index];
    for (size_t i = 0; i < index; i++)
        if (plan->cells[i].reason && plan->cells[i].scene == c->scene && strcmp(plan->cells[i].reason, c->reason) == 0)
            return 0;
    return 1;
}

void sweep_report_left_out(FILE *stream, const sweep_plan *plan)
{
    for (size_t i = 0; i < plan->count; i++) {
        const sweep_cell *c = &plan->cells[i];
        unsigned rows = 0;
        if (!c->reason || !is_first_of_its_reason(plan, i))
            continue;
        for (size_t k = i; k < plan->count; k++)
            rows += plan->cells[k].reason && plan->cells[k].scene == c->scene &&
                    strcmp(plan->cells[k].reason, c->reason) == 0;
        fprintf(stream, "%s: %u rows left out: %s\n", c->scene->name, rows, c->reason);
    }
}
