/* One page of HTML about rows of a sweep: what to take for which budget, plots of error against bytes and against cost
 * with their fronts, the worst places of every chain, and all rows as a table.
 *
 * The page holds everything: pictures as data, plots as SVG, a script of a few lines without which only the table
 * cannot be sorted. It asks for nothing from anywhere, bears no date, and the same input gives the same bytes.
 */
#ifndef PAGE_H
#define PAGE_H

#include "image.h"
#include "sweep_row.h"

typedef struct page_scene {
    const char *name;     /* as in sweep_row.scene */
    const image *picture; /* 8 bits, three channels; 0: none */
    const image *truth;   /* 8-bit grey mask (comparison.h); 0: none, and no worst places */
} page_scene;

typedef struct page_input {
    const char *title;   /* 0: one for a sweep */
    const char *command; /* that made the rows, as typed; 0: not said */
    const char *cost;    /* what m4_pixel is and where from; 0: by the cost model */
    const page_scene *scenes;
    size_t scene_count; /* in the order of the page; rows of other scenes are left out */
    const sweep_row *rows;
    size_t row_count;
    /* The mask of a row once more, as wide and high as the scene's truth; free() it. 0 and the problem ends the page.
     * Asked for one row a chain and scene, one after the other. 0: no worst places. */
    uint8_t *(*mask)(void *context, const page_scene *scene, const sweep_row *row, problem *why);
    void *context; /* for mask */
} page_input;

/* To a temporary name, then renamed. 0, or -1 and the problem. */
int page_write(const char *path, const page_input *input, problem *why);

#endif
