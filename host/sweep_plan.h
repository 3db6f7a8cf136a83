/* The rows of a sweep before they are measured: scenes x depths x maps x chains, in the order in which they stand in
 * the end, and what is left out, and why.
 */
#ifndef SWEEP_PLAN_H
#define SWEEP_PLAN_H

#include "sweep_request.h"
#include "sweep_row.h"
#include "sweep_scene.h"

typedef struct sweep_cell {
    const sweep_scene *scene;
    const sweep_chain *chain;
    int depth_bits;
    uint32_t map;    /* 0: the chain has none */
    uint32_t budget; /* bytes; 0: a size that was asked for */
    size_t twin;     /* an earlier cell that differs in the budget alone; its own place where there is none */
    char key[20];    /* sweep_row.key */
    int is_done;
    sweep_row row; /* once it is done */
    char *reason;  /* why it is left out; 0: it is not */
} sweep_cell;

typedef struct sweep_plan {
    sweep_cell *cells;
    size_t count, capacity;
    const char *image_text; /* sweep_request.image_text */
} sweep_plan;

/* request and scenes outlive the plan; sweep_plan_free() it, also after an error. 0, or -1 and the problem: among
 * others a budget that no map of any chain and scene fits. */
int sweep_plan_make(sweep_plan *plan, const sweep_request *request, const sweep_scene *scenes, int scene_count,
                    problem *why);

void sweep_plan_free(sweep_plan *plan);

/* Leave a cell out. reason: as a problem has it. */
void sweep_cell_leave_out(sweep_cell *cell, const char *reason);

/* Bytes that stay between the passes: the map, silhouettes or crossings, and where the texels of a warp lie. */
size_t sweep_resident_bytes(const gn_plan *plan);

#endif
