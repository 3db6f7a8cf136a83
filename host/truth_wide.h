/* Integers of up to 352 bits, for determinants whose sign double precision cannot tell.
 *
 * Sign and magnitude, in limbs of 32 bits, as long as the number needs: short numbers multiply quickly. No result of
 * this program needs more than 323 bits (truth_line.c has the sum); one that would not fit stops it (assert).
 */
#ifndef TRUTH_WIDE_H
#define TRUTH_WIDE_H

#include <stdint.h>

enum { WIDE_LIMBS = 11 };

typedef struct wide {
    int sign;   /* -1, 0, 1 */
    int length; /* limbs in use: the last of them is not 0; 0 for zero */
    uint32_t limb[WIDE_LIMBS];
} wide;

wide wide_of(int64_t number);
wide wide_negate(wide a);
wide wide_add(wide a, wide b);
wide wide_subtract(wide a, wide b);
wide wide_multiply(wide a, wide b);

/* -1, 0, 1: a < b, a = b, a > b. */
int wide_compare(wide a, wide b);

/* The nearest doubles are not promised: relative error at most 2^-50. */
double wide_to_double(wide a);

wide wide_dot(const wide a[3], const wide b[3]);

#endif
