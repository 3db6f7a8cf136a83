/* What a frame costs a small machine, for candidates to be compared by. */
#ifndef AUTOMATIC_COST_H
#define AUTOMATIC_COST_H

#include "gnomon.h"

/* Instructions of a Cortex-M4, all passes, over the pixels that see a surface: by the cost model from what was counted
 * (cost_model.h), for point lights, which it does not know, by the figures of docs/performance.md, to a third or so.
 * light_kind: gn_light_kind. */
double automatic_cost(const gn_settings *settings, const gn_plan *plan, const gn_statistics *statistics,
                      int light_kind);

#endif
