/* What a sweep says in the end: JSON, the page, a few lines.
 */
#ifndef SWEEP_REPORT_H
#define SWEEP_REPORT_H

#include "sweep_plan.h"

#include <stdio.h>

/* The scenes, the rows, and what was left out. 0, or -1 and the problem. */
int sweep_report_json(const sweep_plan *plan, const sweep_scene *scenes, int scene_count, const char *path,
                      problem *why);

/* For each scene and budget what the page says to take: what errs least within it. */
void sweep_report_best(FILE *stream, const sweep_plan *plan, const sweep_request *request, const sweep_scene *scenes,
                       int scene_count);

/* What is left out, a line for each reason and scene. */
void sweep_report_left_out(FILE *stream, const sweep_plan *plan);

#endif
