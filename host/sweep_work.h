/* The rows of a sweep measured by several threads, one row each at a time, in the order of the plan. What is measured
 * is in the journal at once. SIGINT, SIGTERM and SIGHUP let the rows that are begun end and stop the rest; a second one
 * stops at once.
 */
#ifndef SWEEP_WORK_H
#define SWEEP_WORK_H

#include "sweep_journal.h"

/* From now on signals are kept for sweep_interrupted(). */
void sweep_catch_signals(void);

/* The number of the signal that came; 0: none. */
int sweep_interrupted(void);

/* Measure what is not done and not left out; cells that make no sense are left out. Shows progress on a terminal. 0
 * also where a signal stopped it, or -1 and the problem. */
int sweep_work(sweep_plan *plan, sweep_journal *journal, int workers, problem *why);

#endif
