/* What a frame costs a small machine, for methods to be compared by. */
#ifndef AUTOMATIC_COST_H
#define AUTOMATIC_COST_H

#include "gnomon.h"

/* Instructions of a Cortex-M4 a pixel of the image, all passes, by docs/performance.md: to tell methods apart, within a
 * fifth or so. */
double automatic_cost(const gn_settings *settings, const gn_plan *plan, const gn_statistics *statistics);

#endif
