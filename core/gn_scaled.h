/* Scaled integers for the constants of a view: m 2^e with 31 bits of m. Used in set-up only, where ranges are wide and
 * few; every operation rounds toward minus infinity, relative error 2^-29. */
#ifndef GN_SCALED_H
#define GN_SCALED_H

#include "gn_fixed.h"

typedef struct gn_scaled {
    int32_t m; /* 0, or 2^30 <= |m| < 2^31 (for negative m: <= 2^31) */
    int32_t e;
} gn_scaled;

/* v 2^e. */
gn_scaled gn_scale(int64_t v, int32_t e);
gn_scaled gn_scaled_multiply(gn_scaled a, gn_scaled b);
/* b != 0. */
gn_scaled gn_scaled_divide(gn_scaled a, gn_scaled b);
gn_scaled gn_scaled_add(gn_scaled a, gn_scaled b);
gn_scaled gn_scaled_negate(gn_scaled a);
gn_scaled gn_scaled_magnitude(gn_scaled a);

/* a 2^n. */
GN_INLINE gn_scaled gn_scaled_shift(gn_scaled a, int32_t n)
{
    a.e += n;
    return a;
}

/* Smallest n with |a| <= 2^n; -1000 for 0. */
int32_t gn_scaled_bits(gn_scaled a);

/* round(a / 2^e), half up; the result must fit 62 bits. */
int64_t gn_scaled_round(gn_scaled a, int32_t e);

#endif
