/* What a counting lane's core adds up: included before every file of core/ (Makefile), where count_operations.awk has
 * each basic block call lane_count once. Threads count for themselves. */
#ifndef LANE_COUNTER_H
#define LANE_COUNTER_H

#include <stdint.h>

enum { LANE_COUNTERS = 6 }; /* in the order of lane_operation */

extern __thread uint64_t lane_counters[LANE_COUNTERS];

/* `used`: nothing calls it yet. */
static inline __attribute__((always_inline, used)) void lane_count(uint64_t multiplies, uint64_t divides, uint64_t adds,
                                                                   uint64_t loads, uint64_t stores, uint64_t others)
{
    lane_counters[0] += multiplies;
    lane_counters[1] += divides;
    lane_counters[2] += adds;
    lane_counters[3] += loads;
    lane_counters[4] += stores;
    lane_counters[5] += others;
}

#endif
