/* Sine, cosine and tangent by one polynomial: sin(pi/2 x) = x (c0 - t (c1 - t (c2 - t (c3 - t (c4 - t c5))))), t = x^2,
 * 0 <= x <= 1. The coefficients are minimax (Remez exchange) among those whose sum is 1, so that a quarter turn is
 * exactly 1; what they leave is 2^-35.9 (c0 is one unit less, the mean of what truncation adds). All steps together:
 * |error| < 1.15 / 2^30, over all 2^32 angles.
 *
 * Sine is exactly odd, cosine exactly even, and both exactly symmetric about the quarter turns.
 * Memory: 24 bytes of constants. Cost: seven 32 x 32 -> 64 bit products and no division; 50 instructions on Cortex-M4,
 * 285 on Cortex-M0. */
#include "gn_trigonometry.h"
#include "gn_fixed.h"

#define ONE (UINT32_C(1) << 30) /* Q2.30 */

/* c5 in Q0.36, then one fraction bit less each: a product with t (Q1.31) loses just that bit in its upper half. */
static const uint32_t coefficients[6] = {234719, 5504797, 80429523, 684554093, 2774394651, 3373259425};

gn_q2_30 gn_sine(gn_angle angle)
{
    /* Both halves of a half turn are the same curve; x, Q1.31, is the way from its nearer end in quarter turns. */
    uint32_t x = angle << 1;
    if (x >> 31)
        x = 0 - x;
    uint32_t t = (uint32_t)(gn_multiply_u(x, x) >> 31);
    uint32_t sum = coefficients[0];
    for (int i = 1; i < 6; i++)
        sum = coefficients[i] - (uint32_t)(gn_multiply_u(t, sum) >> 32);
    int32_t sine = (int32_t)((gn_multiply_u(x, sum) + (UINT32_C(1) << 31)) >> 32);
    return angle >> 31 ? -sine : sine;
}

gn_q2_30 gn_cosine(gn_angle angle)
{
    return gn_sine(angle + ONE);
}

gn_status gn_tangent(gn_q8_24 *tangent, gn_angle angle)
{
    if (angle < GN_DEGREES(1) / 4 || angle > GN_DEGREES(178) / 2)
        return GN_OUT_OF_RANGE;
    uint32_t sine = (uint32_t)gn_sine(angle), cosine = (uint32_t)gn_cosine(angle);
    *tangent = gn_divide(((uint64_t)sine << 24) + cosine / 2, cosine);
    return GN_OK;
}
