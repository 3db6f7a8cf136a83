/* Candidates rendered on the scene itself, in the image's full size, and compared with its exact truth. */
#ifndef AUTOMATIC_TRIAL_H
#define AUTOMATIC_TRIAL_H

#include "automatic_chain.h"
#include "truth.h"

typedef struct automatic_result {
    automatic_candidate candidate;
    uint64_t bytes;  /* resident */
    uint64_t wrong;  /* pixels: false shadow and false light */
    double error;    /* the same, % of the pixels that see a surface */
    double expected; /* the same by the tables */
    double cost;     /* instructions of a Cortex-M4 over the pixels that see a surface */
    gn_statistics statistics;
} automatic_result;

typedef struct automatic_trial {
    const packed_scene *packed;
    const automatic_scene *scene;
    gn_settings base;
    truth truth;
    automatic_result *results; /* each candidate once */
    size_t count, capacity;
} automatic_trial;

/* Cast the truth, with so many threads. automatic_trial_close() it, also after an error. 0, or -1 and the problem. */
int automatic_trial_open(automatic_trial *t, const packed_scene *packed, const automatic_scene *scene,
                         const gn_settings *base, int workers, problem *why);
void automatic_trial_close(automatic_trial *t);

/* Try the candidate, or recall it. Its number in results, which may move; -1 and the problem. */
long automatic_try(automatic_trial *t, const automatic_candidate *candidate, problem *why);

/* Render it and set what is wrong, its cost and its statistics. exact 0: nothing is compared. share: of the light's
 * plane that the map covers, set where a view pass finds it; 0: not wanted. 0, or -1 and the problem. */
int automatic_render(const automatic_candidate *candidate, const packed_scene *packed, const gn_settings *base,
                     const truth *exact, automatic_result *result, double *share, problem *why);

#endif
