/* What the parts of a page share. */
#ifndef PAGE_PARTS_H
#define PAGE_PARTS_H

#include "page.h"
#include "page_advice.h"
#include "plot.h"

#include <stdio.h>

typedef struct page {
    FILE *stream;
    const char *path; /* of the page */
    const page_input *input;
    advice_cost cost;
    double *budgets; /* ascending, bytes */
    size_t budget_count;
    double middle_map; /* where there are no budgets: the middle one of the maps' sizes */
    int columns[SWEEP_COLUMNS];
    int column_count, main_count; /* of the table: all, and those that are always shown */
} page;

/* Rows of one scene, those that err least first. */
typedef struct page_rows {
    const sweep_row **rows;
    size_t count;
    double least_depth; /* bits */
} page_rows;

/* ---- page_text.c: numbers and sentences -------------------------------------------------------------------------- */

/* "1.23 %", or "no pixel" */
plot_text page_error(double error);

/* "at 61 instructions a pixel", "at 1.4 times the time of constant", or nothing. */
plot_text page_at_cost(const page *p, double cost);

/* "silhouette msf+rectilinear (map 181 x 181, 16 bits)", and the bias where it was searched for. */
void page_write_choice(const page *p, const sweep_row *row);

/* For each budget what to take, what is nearly as good for less, what to avoid, what a constant bias does; then what
 * there is without a map. */
void page_write_advice(const page *p, const page_rows *rows);

/* What 32 bits of depth change against 16 at the same maps. */
void page_write_depths(const page *p, const page_rows *rows);

/* ---- page_plots.c ------------------------------------------------------------------------------------------------ */

/* Error against resident bytes, and against cost where it is known, each with the names of its front. on_front: a byte
 * a row, 1 on the first front, 2 on the second, 3 on both. */
void page_write_plots(const page *p, const page_rows *rows, const char *scene, uint8_t *on_front);

/* What the shapes and lines mean. */
void page_write_legend(const page *p);

/* ---- page_table.c ------------------------------------------------------------------------------------------------ */

/* Which columns the page has: those that hold something, the main ones first. */
void page_find_columns(page *p);

/* number: of the table on the page. */
void page_write_table(const page *p, const page_rows *rows, const uint8_t *on_front, size_t number);

/* What the columns mean. */
void page_write_columns(const page *p);

/* Over all scenes: chains and their mean errors at each budget. */
void page_write_means(const page *p);

/* ---- page_style.c ------------------------------------------------------------------------------------------------ */

void page_write_style(FILE *stream);
void page_write_script(FILE *stream);

#endif
