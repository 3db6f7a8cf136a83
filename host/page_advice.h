/* What to take and what to avoid, from rows of a sweep. */
#ifndef PAGE_ADVICE_H
#define PAGE_ADVICE_H

#include "sweep_row.h"

/* Which number of a row is its cost. */
typedef enum advice_cost { ADVICE_INSTRUCTIONS, ADVICE_HOST_RATIO, ADVICE_NO_COST } advice_cost;

/* Rows of one scene. */
typedef struct advice_rows {
    const sweep_row *const *rows;
    size_t count;
    advice_cost cost;
} advice_rows;

/* NAN where it is not known. */
double advice_cost_of(const sweep_row *row, advice_cost cost);

/* The cost that some row has: instructions rather than time. */
advice_cost advice_best_known(const advice_rows *of);

/* The row with a map of at most that many resident bytes that errs least; of equal ones the cheapest, then the
 * smallest, then the first. 0: there is none. */
const sweep_row *advice_best(const advice_rows *of, double bytes);

/* Nearly as good as `best` for less: the cheapest row of at most that many bytes that errs at most a quarter more, plus
 * 0.05 % of the pixels, at four fifths of the cost or less. 0: there is none, or no cost is known. */
const sweep_row *advice_cheaper(const advice_rows *of, double bytes, const sweep_row *best);

/* Of the largest maps for this budget (sweep_row.budget) the one that errs most, and at least twice as much as `best`,
 * though it costs as much as that or more. 0: there is none, or no cost is known. */
const sweep_row *advice_avoid(const advice_rows *of, double budget, const sweep_row *best);

/* What is usually taken, a constant bias: the chain `constant` with the largest map for this budget at the depth of
 * `best`. 0: there is none, or it is `best`. */
const sweep_row *advice_usual(const advice_rows *of, double budget, const sweep_row *best);

/* The row without a map (shadow volumes) that errs least. 0: there is none. */
const sweep_row *advice_without_map(const advice_rows *of);

#endif
