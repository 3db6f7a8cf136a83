/* Scaled integers with 62 bits, for planes that must be good to a fraction of a pixel at any slope (gn_nearness.c):
 * m 2^e. Dot products are exact before they are cut; a product or reciprocal errs by 2^-59 of itself, a sum
 * by that of its larger term. Set-up only. */
#ifndef GN_WIDE_H
#define GN_WIDE_H

#include "gn_fixed.h"

typedef struct gn_wide {
    int64_t m; /* 0, or 2^61 <= |m| <= 2^62 */
    int32_t e;
} gn_wide;

/* v 2^e, |v| < 2^63. */
gn_wide gn_widen(int64_t v, int32_t e);

/* n . v, cut toward minus infinity: |n| <= 2^61, |v| <= 2^30. */
gn_wide gn_wide_dot(const int64_t n[3], const int32_t v[3]);

gn_wide gn_wide_multiply(gn_wide a, gn_wide b);
gn_wide gn_wide_add(gn_wide a, gn_wide b);
gn_wide gn_wide_negate(gn_wide a);

/* 1 / a, a != 0. */
gn_wide gn_wide_reciprocal(gn_wide a);

/* n with 2^(n-1) <= |a| <= 2^n; -10000 for 0. */
int32_t gn_wide_bits(gn_wide a);

/* round(a / 2^e), half up; held within +-2^62. */
int64_t gn_wide_round(gn_wide a, int32_t e);

#endif
