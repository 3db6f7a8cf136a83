#include "markup.h"
#include "memory.h"
#include "page_parts.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct note {
    char text[256];
} note;

/* Chains that are drawn as lines, at the least depth: the common choices, and one of each idea beyond them. */
static const char *const lines[PLOT_LINES] = {"constant", "constant-best", "mixed+virtual", "silhouette"};

/* ---- shapes ----------------------------------------------------------------------------------------------------- */

static const struct {
    const char *words[4]; /* one of them in the chain's name */
    plot_shape shape;
    const char *meaning;
} families[] = {
    {{"volumes"}, PLOT_STAR, "shadow volumes, no map"},
    {{"crossing"}, PLOT_HEXAGON, "a map of crossings"},
    {{"silhouette"}, PLOT_TRIANGLE_UP, "silhouette map"},
    {{"bilinear", "jitter", "pcf"}, PLOT_TRIANGLE_DOWN, "filters"},
    {{"virtual"}, PLOT_DIAMOND, "two layers and virtual samples"},
    {{"midpoint", "dual", "second-depth", "mixed"}, PLOT_SQUARE, "two layers"},
    {{""}, PLOT_CIRCLE, "one layer and a bias"},
};
enum { FAMILIES = sizeof families / sizeof *families };

/* The last family takes what no other one does. */
static plot_shape shape_of(const char *chain)
{
    for (int i = 0; i < FAMILIES; i++)
        for (int k = 0; k < 4 && families[i].words[k]; k++)
            if (strstr(chain, families[i].words[k]))
                return families[i].shape;
    return PLOT_CIRCLE;
}

static int is_parameterised(const sweep_row *row)
{
    const char *option = strstr(row->options, "--parameterise ");
    return option && strncmp(option + strlen("--parameterise "), "uniform", 7) != 0;
}

void page_write_legend(const page *p)
{
    fputs("<ul class=\"legend\">\n", p->stream);
    for (int i = FAMILIES - 1; i >= 0; i--) {
        fputs("<li>", p->stream);
        plot_write_sample(p->stream, families[i].shape, 0);
        fprintf(p->stream, " %s</li>\n", families[i].meaning);
    }
    fputs("<li>", p->stream);
    plot_write_sample(p->stream, PLOT_DIAMOND, 1);
    fputs(" filled: fitted or warped to the view</li>\n", p->stream);
    for (size_t i = 0; i < PLOT_LINES; i++) {
        fputs("<li>", p->stream);
        plot_write_line_sample(p->stream, i);
        fprintf(p->stream, " %s at all maps</li>\n", lines[i]);
    }
    fputs("</ul>\n", p->stream);
}

/* ---- points ----------------------------------------------------------------------------------------------------- */

static note describe(const page *p, const sweep_row *row)
{
    note n;
    int length = snprintf(n.text, sizeof n.text, "%s", row->chain);
    if (row->map > 0)
        length += snprintf(n.text + length, sizeof n.text - (size_t)length, ", map %.0f, %.0f bits", row->map,
                           row->depth_bits);
    length += snprintf(n.text + length, sizeof n.text - (size_t)length, ": %s", page_error(row->error).text);
    if (row->map > 0)
        length +=
            snprintf(n.text + length, sizeof n.text - (size_t)length, ", %s", plot_bytes(row->resident_bytes).text);
    snprintf(n.text + length, sizeof n.text - (size_t)length, "%s", page_at_cost(p, advice_cost_of(row, p->cost)).text);
    return n;
}

typedef struct scatter {
    plot_point *points; /* one a row */
    note *notes;
    char (*names)[64]; /* with the depth, where it is not the least */
    size_t *front, *named;
    size_t front_count, named_count;
} scatter;

/* Of the rows of greater depths those stay that err at least a tenth less than all of the least depth that cost up to
 * a tenth more: the others would only cover rows that say the same. */
static void hide_depths(scatter *s, const page_rows *rows)
{
    for (size_t i = 0; i < rows->count; i++) {
        double least = INFINITY;
        if (rows->rows[i]->depth_bits == rows->least_depth)
            continue;
        for (size_t k = 0; k < rows->count; k++)
            if (rows->rows[k]->depth_bits == rows->least_depth && s->points[k].x <= 1.1 * s->points[i].x)
                least = fmin(least, s->points[k].y);
        if (!(s->points[i].y <= 0.9 * least))
            s->points[i].x = NAN;
    }
}

static void find_front(scatter *s, const page_rows *rows)
{
    uint8_t *on_front = memory_take(rows->count, 1);
    s->front_count = plot_front(s->front, s->points, rows->count);
    s->named_count = plot_named(s->named, s->front, s->front_count, s->points);
    for (size_t i = 0; i < s->front_count; i++)
        on_front[s->front[i]] = 1;
    for (size_t i = 0; i < rows->count; i++)
        if (!on_front[i] && rows->rows[i]->depth_bits != rows->least_depth)
            s->points[i].x = NAN;
    free(on_front);
}

/* x: of bytes without a map NAN, so that it is not drawn. */
static scatter make_scatter(const page *p, const page_rows *rows, int of_bytes)
{
    size_t count = rows->count;
    scatter s = {.points = memory_take(count, sizeof *s.points),
                 .notes = memory_take(count, sizeof *s.notes),
                 .names = memory_take(count, sizeof *s.names),
                 .front = memory_take(count, sizeof *s.front),
                 .named = memory_take(count, sizeof *s.named)};
    for (size_t i = 0; i < count; i++) {
        const sweep_row *row = rows->rows[i];
        double x = !of_bytes ? advice_cost_of(row, p->cost) : row->map > 0 ? row->resident_bytes : NAN;
        s.notes[i] = describe(p, row);
        if (row->depth_bits == rows->least_depth || row->map == 0)
            snprintf(s.names[i], sizeof s.names[i], "%s", row->chain);
        else
            snprintf(s.names[i], sizeof s.names[i], "%s, %.0f bits", row->chain, row->depth_bits);
        s.points[i] =
            (plot_point){x, row->error, shape_of(row->chain), is_parameterised(row), s.names[i], s.notes[i].text};
    }
    hide_depths(&s, rows);
    find_front(&s, rows);
    return s;
}

static void free_scatter(scatter *s)
{
    free(s->points);
    free(s->notes);
    free(s->names);
    free(s->front);
    free(s->named);
}

/* ---- lines ------------------------------------------------------------------------------------------------------ */

/* Of the chain at the least depth, by the map's size. room: for a point a row. */
static size_t line_points(size_t *room, const page_rows *rows, const char *chain)
{
    size_t count = 0;
    for (size_t i = 0; i < rows->count; i++) {
        const sweep_row *row = rows->rows[i];
        if (strcmp(row->chain, chain) != 0 || row->depth_bits != rows->least_depth)
            continue;
        size_t at = count++;
        for (; at && rows->rows[room[at - 1]]->map > row->map; at--)
            room[at] = room[at - 1];
        room[at] = i;
    }
    return count;
}

/* ---- the plots -------------------------------------------------------------------------------------------------- */

/* A chain's name, which a line may end in after a slash. */
static void write_breakable(FILE *stream, const char *name)
{
    char piece[64];
    for (size_t length; *name; name += length) {
        length = strcspn(name, "/");
        length += name[length] == '/';
        snprintf(piece, sizeof piece, "%.*s", (int)length, name);
        markup_text(stream, piece);
        fputs(name[length] ? "<wbr>" : "", stream);
    }
}

static void write_name_row(const page *p, const sweep_row *row, const char *name, size_t number)
{
    double cost = advice_cost_of(row, p->cost);
    fprintf(p->stream, "<tr><td>%zu</td><th scope=\"row\">", number);
    write_breakable(p->stream, name);
    if (row->map > 0)
        fprintf(p->stream, "</th><td>%.0f</td><td>%s</td><td>%s</td>", row->map, plot_number(row->error).text,
                plot_bytes(row->resident_bytes).text);
    else
        fprintf(p->stream, "</th><td></td><td>%s</td><td></td>", plot_number(row->error).text);
    fprintf(p->stream, "<td>%s</td></tr>\n", isnan(cost) ? "" : plot_number(cost).text);
}

static void write_names(const page *p, const page_rows *rows, const scatter *s)
{
    fprintf(p->stream,
            "<table class=\"front\"><thead><tr><th></th><th scope=\"col\">on the front</th><th scope=\"col\">map</th>"
            "<th scope=\"col\">wrong, %%</th><th scope=\"col\">resident</th>"
            "<th scope=\"col\">%s</th></tr></thead>\n<tbody>\n",
            p->cost == ADVICE_INSTRUCTIONS ? "instr. a pixel"
            : p->cost == ADVICE_HOST_RATIO ? "time"
                                           : "");
    for (size_t i = 0; i < s->named_count; i++)
        write_name_row(p, rows->rows[s->named[i]], s->names[s->named[i]], i + 1);
    fputs("</tbody></table>\n", p->stream);
}

static void write_figure(const page *p, const page_rows *rows, plot *of, const scatter *s)
{
    plot_line drawn[PLOT_LINES];
    size_t *points = memory_take(PLOT_LINES * rows->count, sizeof *points);
    for (size_t i = 0; i < PLOT_LINES; i++) {
        size_t *room = points + i * rows->count;
        drawn[i] = (plot_line){lines[i], room, line_points(room, rows, lines[i])};
    }
    of->points = s->points;
    of->point_count = rows->count;
    of->lines = drawn;
    of->line_count = PLOT_LINES;
    of->y_name = "wrong pixels, %";
    fputs("<figure>\n", p->stream);
    plot_write(p->stream, of);
    write_names(p, rows, s);
    fputs("</figure>\n", p->stream);
    free(points);
}

static void note_front(const scatter *s, uint8_t *on_front, uint8_t bit)
{
    for (size_t i = 0; i < s->front_count; i++)
        on_front[s->front[i]] |= bit;
}

static void write_against_bytes(const page *p, const page_rows *rows, const char *scene, uint8_t *on_front)
{
    char title[128], level[128];
    scatter s = make_scatter(p, rows, 1);
    const advice_rows choices = {rows->rows, rows->count, p->cost};
    const sweep_row *volumes = advice_without_map(&choices);
    plot of = {.title = title,
               .x_name = "resident bytes",
               .x_axis = PLOT_BYTES,
               .marks = p->budgets,
               .mark_count = p->budget_count};
    snprintf(title, sizeof title, "Wrong pixels against resident bytes, %.64s", scene);
    if (volumes) {
        snprintf(level, sizeof level, "%s, no map: %s", volumes->chain, page_error(volumes->error).text);
        of.level = volumes->error;
        of.level_name = level;
    }
    note_front(&s, on_front, 1);
    write_figure(p, rows, &of, &s);
    free_scatter(&s);
}

static void write_against_cost(const page *p, const page_rows *rows, const char *scene, uint8_t *on_front)
{
    char title[128];
    scatter s = make_scatter(p, rows, 0);
    plot of = {.title = title,
               .x_name = p->cost == ADVICE_INSTRUCTIONS ? "instructions a pixel" : "time over that of constant",
               .x_axis = PLOT_DECIMAL};
    snprintf(title, sizeof title, "Wrong pixels against %s, %.64s", of.x_name, scene);
    note_front(&s, on_front, 2);
    write_figure(p, rows, &of, &s);
    free_scatter(&s);
}

void page_write_plots(const page *p, const page_rows *rows, const char *scene, uint8_t *on_front)
{
    fputs("<div class=\"plots\">\n", p->stream);
    write_against_bytes(p, rows, scene, on_front);
    if (p->cost != ADVICE_NO_COST)
        write_against_cost(p, rows, scene, on_front);
    fputs("</div>\n", p->stream);
}
