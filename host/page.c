#include "page.h"

#include "file.h"
#include "gnomon.h"
#include "markup.h"
#include "memory.h"
#include "page_crop.h"
#include "page_parts.h"
#include "page_picture.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Pixels; without compression a quarter of the bytes. */
enum { WIDEST_PICTURE = 640, WIDEST_BMP = 320 };

/* ---- what the page is about ------------------------------------------------------------------------------------- */

static int ascending(const void *a, const void *b)
{
    double p = *(const double *)a, q = *(const double *)b;
    return (p > q) - (p < q);
}

/* Numbers above 0, each once, ascending. Returns how many. */
static size_t distinct(double *numbers, size_t count)
{
    size_t kept = 0;
    qsort(numbers, count, sizeof *numbers, ascending);
    for (size_t i = 0; i < count; i++)
        if (numbers[i] > 0 && (!kept || numbers[i] != numbers[kept - 1]))
            numbers[kept++] = numbers[i];
    return kept;
}

static void find_budgets(page *p)
{
    size_t count = p->input->row_count;
    double *maps = memory_take(count, sizeof *maps);
    p->budgets = memory_take(count, sizeof *p->budgets);
    for (size_t i = 0; i < count; i++) {
        p->budgets[i] = p->input->rows[i].budget > 0 ? p->input->rows[i].budget : 0;
        maps[i] = p->input->rows[i].map > 0 ? p->input->rows[i].map : 0;
    }
    p->budget_count = distinct(p->budgets, count);
    size_t map_count = distinct(maps, count);
    p->middle_map = map_count ? maps[map_count / 2] : 0;
    free(maps);
}

static int by_error(const void *a, const void *b)
{
    const sweep_row *p = *(const sweep_row *const *)a, *q = *(const sweep_row *const *)b;
    if (isnan(p->error) != isnan(q->error))
        return isnan(p->error) - isnan(q->error);
    if (p->error < q->error || p->error > q->error)
        return p->error < q->error ? -1 : 1;
    return p < q ? -1 : 1;
}

/* scene 0: all. */
static page_rows rows_of(const page_input *in, const char *scene)
{
    page_rows rows = {memory_take(in->row_count, sizeof *rows.rows), 0, INFINITY};
    for (size_t i = 0; i < in->row_count; i++)
        if (!scene || strcmp(in->rows[i].scene, scene) == 0) {
            rows.rows[rows.count++] = &in->rows[i];
            rows.least_depth = fmin(rows.least_depth, in->rows[i].depth_bits);
        }
    qsort(rows.rows, rows.count, sizeof *rows.rows, by_error);
    return rows;
}

/* ---- the worst places ------------------------------------------------------------------------------------------- */

/* Is it one of those that are shown: the largest map for the middle budget, at the least depth, or without a map? */
static int shows_crop(const page *p, const page_rows *rows, const sweep_row *row)
{
    if (row->depth_bits != rows->least_depth || isnan(row->error))
        return 0;
    if (row->map == 0)
        return 1;
    return p->budget_count ? row->budget == p->budgets[p->budget_count / 2] : row->map == p->middle_map;
}

static void write_crop_caption(const page *p, const sweep_row *row, const page_crop *crop)
{
    fputs("<figcaption>", p->stream);
    page_write_choice(p, row);
    fprintf(p->stream, ": %s", page_error(row->error).text);
    if (crop->wrong)
        fprintf(p->stream, "; here %llu of %u, at %u, %u", (unsigned long long)crop->wrong, crop->width * crop->height,
                crop->x, crop->y);
    fputs("</figcaption></figure>\n", p->stream);
}

static int write_crop(const page *p, const page_scene *scene, const sweep_row *row, problem *why)
{
    uint8_t *mask = p->input->mask(p->input->context, scene, row, why);
    if (!mask)
        return -1;
    page_crop crop = page_crop_make(mask, scene->truth);
    free(mask);
    fputs("<figure><img alt=\"mask and difference\" src=\"", p->stream);
    int result = page_picture_write(p->stream, &crop.picture, p->path, why);
    fprintf(p->stream, "\" width=\"%u\" height=\"%u\">\n", crop.picture.width, crop.picture.height);
    image_free(&crop.picture);
    write_crop_caption(p, row, &crop);
    return result;
}

static int write_crops(const page *p, const page_scene *scene, const page_rows *rows, problem *why)
{
    if (!p->input->mask || !scene->truth)
        return 0;
    fputs("<h3>The worst place of each chain</h3>\n<p class=\"small\">", p->stream);
    if (p->budget_count)
        fprintf(p->stream, "With the largest map for %s", plot_bytes(p->budgets[p->budget_count / 2]).text);
    else
        fprintf(p->stream, "With a map of %.0f \xc3\x97 %.0f", p->middle_map, p->middle_map);
    fprintf(p->stream,
            ": the %d \xc3\x97 %d pixels with the most wrong ones, the mask to the left, to the right its difference "
            "from the truth. Chains that err least come first.</p>\n<div class=\"crops\">\n",
            PAGE_CROP_WIDTH, PAGE_CROP_HEIGHT);
    for (size_t i = 0; i < rows->count; i++)
        if (shows_crop(p, rows, rows->rows[i]) && write_crop(p, scene, rows->rows[i], why))
            return -1;
    fputs("</div>\n", p->stream);
    return 0;
}

/* ---- a scene ---------------------------------------------------------------------------------------------------- */

static int write_picture(const page *p, const page_scene *scene, problem *why)
{
    if (!scene->picture)
        return 0;
    image small = page_picture_shrink(scene->picture, page_picture_is_png() ? WIDEST_PICTURE : WIDEST_BMP);
    fputs("<img class=\"picture\" alt=\"", p->stream);
    markup_text(p->stream, scene->name);
    fputs("\" src=\"", p->stream);
    int result = page_picture_write(p->stream, &small, p->path, why);
    fprintf(p->stream, "\" width=\"%u\" height=\"%u\">\n", small.width, small.height);
    image_free(&small);
    return result;
}

static advice_cost cost_of(const page_rows *rows)
{
    return advice_best_known(&(advice_rows){rows->rows, rows->count, ADVICE_NO_COST});
}

/* Its cost is its own: the model may know no instructions of its light. */
static int write_scene(const page *whole, size_t number, problem *why)
{
    page own = *whole, *p = &own;
    const page_scene *scene = &p->input->scenes[number];
    page_rows rows = rows_of(p->input, scene->name);
    own.cost = cost_of(&rows);
    uint8_t *on_front = memory_take(rows.count, 1);
    fprintf(p->stream, "<section id=\"scene%zu\">\n<h2>", number + 1);
    markup_text(p->stream, scene->name);
    fputs("</h2>\n", p->stream);
    fputs("<div class=\"lead\">\n", p->stream);
    int result = write_picture(p, scene, why);
    if (!result) {
        page_write_advice(p, &rows);
        fputs("</div>\n", p->stream);
        page_write_plots(p, &rows, scene->name, on_front);
        page_write_depths(p, &rows);
        result = write_crops(p, scene, &rows, why);
    }
    if (!result) {
        fprintf(p->stream, "<h3>All %zu rows</h3>\n", rows.count);
        page_write_table(p, &rows, on_front, number + 1);
        fputs("</section>\n", p->stream);
    }
    free(on_front);
    free(rows.rows);
    return result;
}

/* ---- head and tail ---------------------------------------------------------------------------------------------- */

/* The policy makes a browser refuse what the page never asks for; the empty icon keeps it from looking for one. */
static void write_head(const page *p, const char *title)
{
    fputs("<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n"
          "<meta name=\"viewport\" content=\"width=device-width,initial-scale=1\">\n"
          "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none';img-src data:;"
          "style-src 'unsafe-inline';script-src 'unsafe-inline'\">\n<link rel=\"icon\" href=\"data:,\">\n<title>",
          p->stream);
    markup_text(p->stream, title);
    fputs("</title>\n<style>\n", p->stream);
    page_write_style(p->stream);
    plot_write_style(p->stream);
    fprintf(p->stream, ".all:not(:checked)~.box :is(td,th):nth-child(n+%d){display:none}\n</style></head>\n<body>\n",
            p->main_count + 3);
    plot_write_shapes(p->stream);
}

static void write_links(const page *p)
{
    fputs("<nav><ul>", p->stream);
    if (p->input->scene_count > 1 && p->budget_count)
        fputs("<li><a href=\"#all\">all scenes</a></li>\n", p->stream);
    for (size_t i = 0; i < p->input->scene_count; i++) {
        fprintf(p->stream, "<li><a href=\"#scene%zu\">", i + 1);
        markup_text(p->stream, p->input->scenes[i].name);
        fputs("</a></li>\n", p->stream);
    }
    fputs("<li><a href=\"#about\">columns and chains</a></li></ul></nav>\n", p->stream);
}

static const char *const costs[] = {
    [ADVICE_INSTRUCTIONS] =
        "Instructions are those of a Cortex-M4, by the cost model, over the pixels that see a surface.",
    [ADVICE_HOST_RATIO] = "Times are of the machine that made this page, over that of the chain constant.",
    [ADVICE_NO_COST] = "",
};

static void write_introduction(const page *p, const char *title)
{
    fputs("<h1>", p->stream);
    markup_text(p->stream, title);
    fprintf(p->stream, "</h1>\n<p class=\"small\">gnomon %s, bits version %d.", GN_VERSION, GN_BITS_VERSION);
    if (p->input->command) {
        fputs(" Made by <code>", p->stream);
        markup_text(p->stream, p->input->command);
        fputs("</code>", p->stream);
    }
    fputs("</p>\n<p>Shadows of each chain of choices, compared pixel by pixel with the exact truth: how many of the "
          "pixels that see a surface are lit where they should be in shadow, or in shadow where they should be lit. ",
          p->stream);
    markup_text(p->stream, p->input->cost ? p->input->cost : costs[p->cost]);
    fputs("</p>\n", p->stream);
    write_links(p);
}

static void write_key(FILE *s, const char *colour, const char *meaning)
{
    fprintf(s, "<li><span class=\"key\" style=\"background:%s\"></span>%s</li>\n", colour, meaning);
}

/* Colours as in comparison_picture. */
static void write_reading(const page *p)
{
    fputs("<h3>How to read the pictures</h3>\n<p class=\"small\">Plots: less is better both ways. The staircase is the "
          "front: to its left and below it there is nothing. Numbered and named, also in the list below the plot, are "
          "its points that err at least a tenth less than the one before. Upright dashed lines are the budgets. Drawn "
          "are all rows of the least depth; of greater depths those on the front that err at least a tenth less than "
          "all of the least depth at up to a tenth more bytes or cost.",
          p->stream);
    if (!page_picture_is_png())
        fputs(" The pictures are small, as there is no OpenImageIO to compress them.", p->stream);
    fputs("</p>\n", p->stream);
    page_write_legend(p);
    fputs("<p class=\"small\">Differences:</p>\n<ul class=\"legend\">\n", p->stream);
    write_key(p->stream, "rgb(220,30,30)", "false shadow");
    write_key(p->stream, "rgb(40,80,255)", "false light");
    write_key(p->stream, "rgb(190,190,190)", "rightly lit");
    write_key(p->stream, "rgb(90,90,90)", "rightly in shadow");
    write_key(p->stream, "rgb(220,40,220)", "a surface in one mask only");
    write_key(p->stream, "rgb(20,20,20)", "no surface");
    fputs("</ul>\n", p->stream);
}

/* Each chain once, with the options of its first row. */
static void write_chains(const page *p)
{
    const page_input *in = p->input;
    fputs("<h3>Chains, as options of gnomon render</h3>\n<dl class=\"chains\">\n", p->stream);
    for (size_t i = 0; i < in->row_count; i++) {
        size_t k = 0;
        while (k < i && strcmp(in->rows[k].chain, in->rows[i].chain) != 0)
            k++;
        if (k < i)
            continue;
        fputs("<dt>", p->stream);
        markup_text(p->stream, in->rows[i].chain);
        fputs("</dt><dd><code>", p->stream);
        markup_text(p->stream, in->rows[i].options);
        fputs("</code></dd>\n", p->stream);
    }
    fputs("</dl>\n", p->stream);
}

static void write_about(const page *p)
{
    fputs("<section id=\"about\">\n<h2>Columns and chains</h2>\n", p->stream);
    page_write_columns(p);
    write_chains(p);
    fputs("</section>\n", p->stream);
}

/* ---- the whole -------------------------------------------------------------------------------------------------- */

static int write_page(page *p, problem *why)
{
    const char *title = p->input->title ? p->input->title : "Shadows: error against bytes and instructions";
    write_head(p, title);
    write_introduction(p, title);
    write_reading(p);
    if (p->input->scene_count > 1 && p->budget_count)
        page_write_means(p);
    for (size_t i = 0; i < p->input->scene_count; i++)
        if (write_scene(p, i, why))
            return -1;
    write_about(p);
    fputs("<script>\n", p->stream);
    page_write_script(p->stream);
    fputs("</script>\n</body></html>\n", p->stream);
    return 0;
}

int page_write(const char *path, const page_input *input, problem *why)
{
    file_output output;
    if (file_output_open(&output, path, why))
        return -1;
    page p = {.stream = output.stream, .path = path, .input = input};
    page_rows all = rows_of(input, 0);
    p.cost = cost_of(&all);
    free(all.rows);
    find_budgets(&p);
    page_find_columns(&p);
    int result = write_page(&p, why);
    free(p.budgets);
    if (result) {
        file_output_abandon(&output);
        return -1;
    }
    return file_output_finish(&output, why);
}
