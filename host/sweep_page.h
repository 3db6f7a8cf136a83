/* The page of a sweep: its rows, and a picture of each scene.
 */
#ifndef SWEEP_PAGE_H
#define SWEEP_PAGE_H

#include "sweep_plan.h"

/* command: as typed. cost: page_input.cost. 0, or -1 and the problem. */
int sweep_page_write(const char *path, const sweep_plan *plan, const sweep_scene *scenes, int scene_count,
                     const char *command, const char *cost, int workers, problem *why);

#endif
