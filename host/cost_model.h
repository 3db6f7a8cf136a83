/* How many instructions a frame takes a Cortex-M4, from what a lane counted of it on this machine: operations (lane.h)
 * and gn_statistics, times coefficients that were fitted to frames counted under QEMU (tests/report/cost_fit.c, `make
 * cost-model`). How well it predicts scenes that it was not fitted to: docs/performance.md.
 *
 * Operations carry most of it. Features say where a loop's operations cost more or less than the mean of all: sums of
 * 64 bits are one operation and two instructions, for instance. Without operations, where no lane counts them, features
 * alone have to do, and errors are six times as large.
 */
#ifndef COST_MODEL_H
#define COST_MODEL_H

#include "lane.h"

/* instructions: of the view pass (0 without one), the light pass, the camera pass. settings: with objects of this
 * program's own core, whose addresses are compared; what says how shadows are made, and the sizes of image and map.
 * plan, statistics: of a frame by a lane that does not count; operations: of the same frame by one that does, or 0.
 * light_kind: gn_light_kind.
 * 0, or -1 and the problem: a point light without operations or with one map at a time, or a warp of vertices alone. */
int cost_model_m4(double instructions[LANE_PASSES], const gn_settings *settings, const gn_plan *plan,
                  const gn_statistics *statistics, const uint64_t operations[LANE_PASSES][LANE_OPERATIONS],
                  int light_kind, problem *why);

/* ---- for the fit ------------------------------------------------------------------------------------------------- */

/* Passes that have coefficients of their own. */
typedef enum cost_job {
    COST_VIEW,
    COST_LIGHT,
    COST_CAMERA,
    COST_VOLUMES_LIGHT,
    COST_VOLUMES_CAMERA,
    COST_JOBS
} cost_job;

enum { COST_MOST_FEATURES = 64 };

/* What a job's instructions hang on: always the same names in the same order, many of them 0 in any one frame. The
 * first `sums` have coefficients that are not negative. */
typedef struct cost_features {
    int count, sums;
    const char *name[COST_MOST_FEATURES];
    double value[COST_MOST_FEATURES];
} cost_features;

/* Of the pass, with its operations or, where they are 0, without. */
cost_job cost_model_features(cost_features *features, lane_pass pass, const gn_settings *settings, const gn_plan *plan,
                             const gn_statistics *statistics, const uint64_t operations[LANE_OPERATIONS],
                             int light_kind);

typedef struct cost_coefficient {
    const char *name;
    double instructions;
} cost_coefficient;

/* cost_model_table.c: a row a feature; [0] without operations, [1] with them. */
extern const cost_coefficient *const cost_model_table[2][COST_JOBS];

#endif
