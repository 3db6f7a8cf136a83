#include "markup.h"
#include "page_parts.h"

#include <math.h>
#include <string.h>

/* That lines do not end at. */
#define BLANK "\xc2\xa0"

plot_text page_error(double error)
{
    plot_text t, number = plot_number(error);
    if (error > 0)
        snprintf(t.text, sizeof t.text, "%.30s" BLANK "%%", number.text);
    else
        snprintf(t.text, sizeof t.text, "no pixel");
    return t;
}

plot_text page_at_cost(const page *p, double cost)
{
    plot_text t = {""}, number = plot_number(cost);
    if (p->cost == ADVICE_INSTRUCTIONS && *number.text)
        snprintf(t.text, sizeof t.text, " at %.30s instructions a pixel", number.text);
    else if (*number.text)
        snprintf(t.text, sizeof t.text, " at %.30s times constant", number.text);
    return t;
}

/* Was its bias searched for, so that the chain's name does not say it? */
static int has_own_bias(const sweep_row *row)
{
    return strstr(row->chain, "-best") && !isnan(row->bias);
}

void page_write_choice(const page *p, const sweep_row *row)
{
    fputs("<b>", p->stream);
    markup_text(p->stream, row->chain);
    fputs("</b>", p->stream);
    if (row->map == 0)
        return;
    fprintf(p->stream, " (map" BLANK "%.0f" BLANK "\xc3\x97" BLANK "%.0f, %.0f" BLANK "bits", row->map, row->map,
            row->depth_bits);
    if (has_own_bias(row))
        fprintf(p->stream, ", bias of %s" BLANK "texels", plot_number(row->bias).text);
    fputs(")", p->stream);
}

/* ---- advice ----------------------------------------------------------------------------------------------------- */

static void write_wrong(const page *p, const sweep_row *row)
{
    fprintf(p->stream, "%s wrong%s", page_error(row->error).text, page_at_cost(p, advice_cost_of(row, p->cost)).text);
}

/* A sentence about a row, if there is one. */
static void write_other(const page *p, const char *start, const sweep_row *row, const char *middle)
{
    if (!row)
        return;
    fputs(start, p->stream);
    page_write_choice(p, row);
    fputs(middle, p->stream);
    write_wrong(p, row);
    fputs(".", p->stream);
}

static void write_budget(const page *p, const advice_rows *of, double budget)
{
    const sweep_row *best = advice_best(of, budget);
    if (!best)
        return;
    if (isfinite(budget))
        fprintf(p->stream, "<li>For %s take ", plot_bytes(budget).text);
    else
        fputs("<li>Take ", p->stream);
    write_other(p, "", best, ": ");
    write_other(p, " Nearly as good for less: ", advice_cheaper(of, budget, best), ", ");
    write_other(p, " Avoid ", advice_avoid(of, budget, best), ": no cheaper, and ");
    write_other(p, " To compare: ", advice_usual(of, budget, best), ", ");
    fputs("</li>\n", p->stream);
}

static void write_without_map(const page *p, const advice_rows *of)
{
    const sweep_row *row = advice_without_map(of);
    if (!row)
        return;
    fputs("<li>Without a map: ", p->stream);
    page_write_choice(p, row);
    fputs(", ", p->stream);
    write_wrong(p, row);
    if (!isnan(row->peak_bytes))
        fprintf(p->stream, ", %s of memory in all", plot_bytes(row->peak_bytes).text);
    fputs(".</li>\n", p->stream);
}

void page_write_advice(const page *p, const page_rows *rows)
{
    advice_rows of = {rows->rows, rows->count, p->cost};
    fputs("<ul class=\"advice\">\n", p->stream);
    for (size_t i = 0; i < p->budget_count; i++)
        write_budget(p, &of, p->budgets[i]);
    if (!p->budget_count)
        write_budget(p, &of, INFINITY);
    write_without_map(p, &of);
    fputs("</ul>\n", p->stream);
}

/* ---- depths ----------------------------------------------------------------------------------------------------- */

/* The same chain and map at the scene's least depth; a budget gives each depth a map of its own. 0: none. */
static const sweep_row *at_least_depth(const page_rows *rows, const sweep_row *row)
{
    for (size_t i = 0; i < rows->count; i++)
        if (rows->rows[i]->depth_bits == rows->least_depth && rows->rows[i]->map == row->map &&
            strcmp(rows->rows[i]->chain, row->chain) == 0)
            return rows->rows[i];
    return 0;
}

void page_write_depths(const page *p, const page_rows *rows)
{
    double sum = 0, most = -1;
    int count = 0;
    const sweep_row *where = 0;
    for (size_t i = 0; i < rows->count; i++) {
        const sweep_row *row = rows->rows[i], *other = at_least_depth(rows, row);
        if (row->depth_bits == rows->least_depth || !other || isnan(row->error) || isnan(other->error))
            continue;
        double change = row->error - other->error;
        sum += change;
        count++;
        if (fabs(change) > most) {
            most = fabs(change);
            where = row;
        }
    }
    if (!where)
        return;
    fprintf(p->stream,
            "<p class=\"small\">%.0f bits of depth instead of %.0f, at the same map and so for more bytes, change the "
            "wrong pixels by %+.4f percentage points in the mean of %d pairs, by %.4f at most (",
            where->depth_bits, rows->least_depth, sum / count, count, most);
    markup_text(p->stream, where->chain);
    if (where->map > 0)
        fprintf(p->stream, ", map" BLANK "%.0f" BLANK "\xc3\x97" BLANK "%.0f", where->map, where->map);
    fputs(").</p>\n", p->stream);
}
