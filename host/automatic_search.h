/* Which candidates are tried, and which of them is taken.
 *
 * Taken is, of all that were tried: with a budget of bytes alone the one that errs least; of error alone the one of
 * fewest bytes that errs within it; with both the cheapest that keeps both; where none does, the one that errs least.
 * Equals: the cheaper, then the smaller.
 */
#ifndef AUTOMATIC_SEARCH_H
#define AUTOMATIC_SEARCH_H

#include "automatic_trial.h"

typedef struct automatic_budget {
    uint64_t bytes; /* resident; 0: any number */
    double error;   /* % of the pixels that see a surface; below 0: any */
} automatic_budget;

typedef struct automatic_choice {
    automatic_result taken;
    automatic_result next; /* the best with another test or placement; expected only where nothing is tried */
    int has_next, keeps;   /* keeps: within both budgets */
    size_t tried;
} automatic_choice;

/* The order of results under the budget: below 0, a comes before b. */
int automatic_compare(const automatic_budget *budget, const automatic_result *a, const automatic_result *b);

/* 0, or -1 and the problem: a budget that no map fits. */
int automatic_search(automatic_choice *choice, automatic_trial *trial, const automatic_budget *budget, problem *why);

/* The same by the tables alone: nothing is rendered, maps are square. */
int automatic_guess(automatic_choice *choice, const automatic_scene *scene, const packed_scene *packed,
                    const gn_settings *base, const automatic_budget *budget, problem *why);

/* Resident bytes of the smallest map. */
uint64_t automatic_least_bytes(const packed_scene *packed, const gn_settings *base);

#endif
