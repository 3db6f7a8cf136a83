/* The honest rival: the constant bias, in texels, with which this scene errs least at this map and depth. */
#ifndef SWEEP_BIAS_H
#define SWEEP_BIAS_H

#include "problem.h"

/* How many pixels are wrong with that bias. 0, or -1 and the problem. */
typedef int (*sweep_bias_try)(void *user, double texels, double *wrong, problem *why);

/* Search powers of two from 1/8 to 32 texels, on beyond the ends as long as it gets better (to 1/1024 and 4096), then
 * about the best of them in halves, quarters and eighths of an octave. Of equals the least bias. */
int sweep_bias_search(double *texels, sweep_bias_try measure, void *user, problem *why);

#endif
