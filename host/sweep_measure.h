/* One row of a sweep measured: what the mask errs, what it took.
 *
 * Time on this machine is the processor time of the thread, least of several frames, over that of the chain `constant`
 * at the same size and depth, whose frames alternate with the chain's own: what slows down the machine slows down both.
 */
#ifndef SWEEP_MEASURE_H
#define SWEEP_MEASURE_H

#include "sweep_plan.h"

/* Fill cell->row; image_text: sweep_request.image_text. Touches nothing but the cell: any number of threads may measure
 * cells of their own. 0, or -1 and the problem: what makes no sense together. */
int sweep_measure(sweep_cell *cell, const char *image_text, problem *why);

/* The mask of a row once more, width x height of the scene; free() it. 0 and the problem. */
uint8_t *sweep_mask(const sweep_scene *scene, const sweep_row *row, const char *image_text, problem *why);

#endif
