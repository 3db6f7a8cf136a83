#include "markup.h"
#include "memory.h"
#include "page_parts.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Always shown, after the chain; the others where they are asked for. */
static const char *const main_columns[] = {"depth_bits",     "map",      "error",     "false_shadow", "false_light",
                                           "resident_bytes", "m4_pixel", "host_ratio"};
enum { MAIN_COLUMNS = sizeof main_columns / sizeof *main_columns };

/* Said elsewhere: the scene in the heading, the options under the chains. */
static const char *const left_out[] = {"scene", "chain", "options", "key"};
enum { LEFT_OUT = sizeof left_out / sizeof *left_out };

/* ---- columns ---------------------------------------------------------------------------------------------------- */

static int is_one_of(const char *name, const char *const names[], int count)
{
    for (int i = 0; i < count; i++)
        if (strcmp(name, names[i]) == 0)
            return 1;
    return 0;
}

static int holds_something(const page_input *in, const sweep_column *column)
{
    for (size_t i = 0; i < in->row_count; i++)
        if (column->kind == SWEEP_TEXT ? *sweep_row_text(&in->rows[i], column) != 0
                                       : !isnan(sweep_row_number(&in->rows[i], column)))
            return 1;
    return 0;
}

static void take_column(page *p, int number)
{
    if (holds_something(p->input, &sweep_columns[number]))
        p->columns[p->column_count++] = number;
}

void page_find_columns(page *p)
{
    for (int i = 0; i < MAIN_COLUMNS; i++)
        take_column(p, (int)(sweep_column_find(main_columns[i], strlen(main_columns[i])) - sweep_columns));
    p->main_count = p->column_count;
    for (int i = 0; i < SWEEP_COLUMNS; i++)
        if (!is_one_of(sweep_columns[i].name, main_columns, MAIN_COLUMNS) &&
            !is_one_of(sweep_columns[i].name, left_out, LEFT_OUT))
            take_column(p, i);
}

/* Underscores as blanks, so that a narrow column's name may be broken. */
static void write_name(FILE *s, const char *name)
{
    for (; *name; name++)
        putc(*name == '_' ? ' ' : *name, s);
}

void page_write_columns(const page *p)
{
    fputs("<dl class=\"columns\">\n", p->stream);
    for (int i = 0; i < p->column_count; i++) {
        const sweep_column *c = &sweep_columns[p->columns[i]];
        fputs("<dt>", p->stream);
        write_name(p->stream, c->name);
        fputs("</dt><dd>", p->stream);
        markup_text(p->stream, c->unit);
        fputs(*c->unit ? "; " : "", p->stream);
        markup_text(p->stream, c->meaning);
        fputs("</dd>\n", p->stream);
    }
    fputs(
        "<dt>front</dt><dd>B: on the front of bytes: no other row has at most these resident bytes and this error, and "
        "less of one; C: on that of cost. Rows of greater depths take part as in the plots</dd></dl>\n",
        p->stream);
}

/* ---- rows ------------------------------------------------------------------------------------------------------- */

static void write_head(FILE *s, const char *name, int is_number, int sorted)
{
    fprintf(s, "<th scope=\"col\" data-kind=\"%s\"%s><button type=\"button\">", is_number ? "number" : "text",
            sorted ? " aria-sort=\"ascending\"" : "");
    write_name(s, name);
    fputs("</button></th>", s);
}

/* What is not known is an empty cell. */
static void write_cell(FILE *s, const sweep_row *row, const sweep_column *column)
{
    double number = column->kind == SWEEP_TEXT ? NAN : sweep_row_number(row, column);
    fputs("<td>", s);
    if (column->kind == SWEEP_TEXT)
        markup_text(s, sweep_row_text(row, column));
    else if (column->kind == SWEEP_COUNT && !isnan(number))
        fprintf(s, "%.0f", number);
    else
        fputs(plot_number(number).text, s);
    fputs("</td>", s);
}

static void write_row(const page *p, const sweep_row *row, uint8_t on_front)
{
    static const char *const fronts[] = {"", "B", "C", "B C"};
    fprintf(p->stream, "<tr%s><th scope=\"row\">", on_front ? " class=\"f\"" : "");
    markup_text(p->stream, row->chain);
    fprintf(p->stream, "</th><td>%s</td>", fronts[on_front & 3]);
    for (int i = 0; i < p->column_count; i++)
        write_cell(p->stream, row, &sweep_columns[p->columns[i]]);
    fputs("</tr>\n", p->stream);
}

static void write_switches(const page *p, size_t number)
{
    fprintf(p->stream,
            "<input type=\"checkbox\" id=\"all%zu\" class=\"all\"><label for=\"all%zu\">all %d columns</label>\n"
            "<input type=\"checkbox\" id=\"fronts%zu\" class=\"fronts\"><label for=\"fronts%zu\">the fronts "
            "alone</label>\n",
            number, number, p->column_count + 2, number, number);
}

void page_write_table(const page *p, const page_rows *rows, const uint8_t *on_front, size_t number)
{
    fputs("<div class=\"rows\">\n", p->stream);
    write_switches(p, number);
    fputs("<div class=\"box\" tabindex=\"0\"><table class=\"sort\">\n<thead><tr>", p->stream);
    write_head(p->stream, "chain", 0, 0);
    write_head(p->stream, "front", 0, 0);
    for (int i = 0; i < p->column_count; i++) {
        const sweep_column *c = &sweep_columns[p->columns[i]];
        write_head(p->stream, c->name, c->kind != SWEEP_TEXT, strcmp(c->name, "error") == 0);
    }
    fputs("</tr></thead>\n<tbody>\n", p->stream);
    for (size_t i = 0; i < rows->count; i++)
        write_row(p, rows->rows[i], on_front[i]);
    fputs("</tbody></table></div>\n</div>\n", p->stream);
}

/* ---- means ------------------------------------------------------------------------------------------------------ */

/* A chain at one depth, over all scenes that have rows for the budget, and see a surface. */
typedef struct mean {
    const sweep_row *row; /* one of its rows, for the names */
    double error, cost;   /* NAN: not in every scene, or not known */
} mean;

static int same_chain(const sweep_row *a, const sweep_row *b)
{
    return a->depth_bits == b->depth_bits && strcmp(a->chain, b->chain) == 0;
}

/* like 0: any chain that errs by a known number. */
static const sweep_row *find_row(const page *p, const char *scene, const sweep_row *like, double budget)
{
    for (size_t i = 0; i < p->input->row_count; i++) {
        const sweep_row *row = &p->input->rows[i];
        if (row->budget == budget && strcmp(row->scene, scene) == 0 &&
            (like ? same_chain(row, like) : !isnan(row->error)))
            return row;
    }
    return 0;
}

static mean make_mean(const page *p, const sweep_row *like, double budget)
{
    mean m = {like, 0, 0};
    double count = 0;
    for (size_t i = 0; i < p->input->scene_count; i++) {
        const char *scene = p->input->scenes[i].name;
        const sweep_row *row = find_row(p, scene, like, budget);
        if (!find_row(p, scene, 0, budget))
            continue;
        m.error += row ? row->error : NAN;
        m.cost += row ? advice_cost_of(row, p->cost) : NAN;
        count++;
    }
    m.error /= count;
    m.cost /= count;
    return m;
}

static int by_error(const void *a, const void *b)
{
    const mean *p = a, *q = b;
    if (isnan(p->error) || isnan(q->error))
        return isnan(p->error) - isnan(q->error);
    if (p->error != q->error)
        return p->error < q->error ? -1 : 1;
    return p->row < q->row ? -1 : 1;
}

/* Of every chain and depth that has rows for budgets, one row; those first that err least at the middle budget. */
static size_t find_chains(const page *p, mean **chains)
{
    size_t count = 0, capacity = 0;
    *chains = 0;
    for (size_t i = 0; i < p->input->row_count; i++) {
        const sweep_row *row = &p->input->rows[i];
        size_t k = 0;
        while (k < count && !same_chain((*chains)[k].row, row))
            k++;
        if (k < count || !row->budget)
            continue;
        *chains = memory_grow(*chains, &capacity, count + 1, sizeof **chains);
        (*chains)[count++] = make_mean(p, row, p->budgets[p->budget_count / 2]);
    }
    if (count)
        qsort(*chains, count, sizeof **chains, by_error);
    return count;
}

static void write_best_means(const page *p, const mean *chains, size_t count)
{
    fputs("<ul class=\"advice\">\n", p->stream);
    for (size_t b = 0; b < p->budget_count; b++) {
        mean best = {0, NAN, NAN};
        for (size_t i = 0; i < count; i++) {
            mean m = make_mean(p, chains[i].row, p->budgets[b]);
            if (!isnan(m.error) && (!best.row || m.error < best.error))
                best = m;
        }
        if (!best.row)
            continue;
        fprintf(p->stream, "<li>For %s: <b>", plot_bytes(p->budgets[b]).text);
        markup_text(p->stream, best.row->chain);
        fprintf(p->stream, "</b>, %.0f bits: %s wrong in the mean%s</li>\n", best.row->depth_bits,
                page_error(best.error).text, page_at_cost(p, best.cost).text);
    }
    fputs("</ul>\n", p->stream);
}

static void write_mean_cell(FILE *s, double number)
{
    fprintf(s, "<td>%s</td>", isnan(number) ? "" : plot_number(number).text);
}

static void write_mean_rows(const page *p, const mean *chains, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        fputs("<tr><th scope=\"row\">", p->stream);
        markup_text(p->stream, chains[i].row->chain);
        fprintf(p->stream, "</th><td>%.0f</td>", chains[i].row->depth_bits);
        for (size_t b = 0; b < p->budget_count; b++)
            write_mean_cell(p->stream, make_mean(p, chains[i].row, p->budgets[b]).error);
        for (size_t b = 0; p->cost != ADVICE_NO_COST && b < p->budget_count; b++)
            write_mean_cell(p->stream, make_mean(p, chains[i].row, p->budgets[b]).cost);
        fputs("</tr>\n", p->stream);
    }
}

static void write_mean_heads(const page *p, const char *what, int sorted)
{
    for (size_t b = 0; b < p->budget_count; b++) {
        char name[80];
        snprintf(name, sizeof name, "%.30s, %.30s", what, plot_bytes(p->budgets[b]).text);
        write_head(p->stream, name, 1, sorted && b == p->budget_count / 2);
    }
}

void page_write_means(const page *p)
{
    mean *chains;
    size_t count = find_chains(p, &chains);
    fprintf(p->stream, "<section id=\"all\">\n<h2>All %zu scenes</h2>\n", p->input->scene_count);
    fputs("<p>Means over the scenes with a surface of the largest maps that fit each budget; chains that not every "
          "scene has are left "
          "out of the "
          "choice.</p>\n",
          p->stream);
    write_best_means(p, chains, count);
    fputs("<div class=\"rows\"><div class=\"box\" tabindex=\"0\"><table class=\"sort\">\n<thead><tr>", p->stream);
    write_head(p->stream, "chain", 0, 0);
    write_head(p->stream, "depth_bits", 1, 0);
    write_mean_heads(p, "error %", 1);
    if (p->cost != ADVICE_NO_COST)
        write_mean_heads(p, p->cost == ADVICE_INSTRUCTIONS ? "instructions a pixel" : "time", 0);
    fputs("</tr></thead>\n<tbody>\n", p->stream);
    write_mean_rows(p, chains, count);
    fputs("</tbody></table></div></div>\n</section>\n", p->stream);
    free(chains);
}
