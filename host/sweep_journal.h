/* The journal of a sweep, which is its CSV: a row is appended as soon as it is measured, in whatever order; a line that
 * a killed sweep left cut is dropped. In the end the file is written anew in the order of the plan.
 */
#ifndef SWEEP_JOURNAL_H
#define SWEEP_JOURNAL_H

#include "sweep_plan.h"

#include <stdio.h>

typedef struct sweep_journal {
    FILE *stream;
    const char *path;
} sweep_journal;

/* Take the rows that are there already into the plan's cells, and open the file for more; path outlives the journal.
 * *taken: how many. 0, or -1 and the problem: among others rows that the plan does not have, of another scene, another
 * version or other options, and another sweep that has it open. */
int sweep_journal_open(sweep_journal *journal, sweep_plan *plan, size_t *taken, const char *path, problem *why);

/* Append the cell's row and those of its twins, which are done with it. 0, or -1 and the problem. */
int sweep_journal_append(sweep_journal *journal, sweep_plan *plan, size_t cell, problem *why);

void sweep_journal_close(sweep_journal *journal);

/* All rows that are done, in the order of the plan, in place of the journal, which is closed. 0, or -1 and the problem.
 */
int sweep_journal_finish(sweep_journal *journal, const sweep_plan *plan, problem *why);

#endif
