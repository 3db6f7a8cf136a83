/* Counting what a pass covers, where GN_STATISTICS asks for it; otherwise nothing of this is compiled. */
#ifndef GN_TALLY_H
#define GN_TALLY_H

#include "gn_fixed.h"
#include "gn_vector.h"

#if GN_STATISTICS
#define GN_TALLY(statement) statement

typedef struct gn_tally {
    uint64_t triangles, centres;
#if GN_VECTOR
    gn_i32x16 lanes_16; /* centres of tiny triangles, by lane */
    gn_i32x8 lanes_8;
#endif
} gn_tally;

/* All centres covered. */
static inline uint64_t gn_tally_centres(const gn_tally *tally)
{
    uint64_t sum = tally->centres;
#if GN_VECTOR
    for (int i = 0; i < 16; i++)
        sum += (uint32_t)tally->lanes_16[i];
    for (int i = 0; i < 8; i++)
        sum += (uint32_t)tally->lanes_8[i];
#endif
    return sum;
}
#else
#define GN_TALLY(statement)
#endif

#endif
