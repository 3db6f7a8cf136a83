/* CPython's random.Random, as far as the scenes use it: the same seed gives the numbers of Python 3.2 and later. */
#ifndef PROCEDURAL_RANDOM_H
#define PROCEDURAL_RANDOM_H

#include <stdint.h>

#if defined __clang__
#pragma STDC FP_CONTRACT OFF /* as -ffp-contract=off, which gcc with -std=c99 implies */
#endif

#define TWISTER_WORDS 624

typedef struct twister {
    uint32_t state[TWISTER_WORDS];
    int next;         /* first word of state not yet drawn, 0 to TWISTER_WORDS */
    double spare;     /* the second number of a Gaussian pair */
    int spare_is_set; /* 0 or 1 */
} twister;

/* Random(n): the key is |n| in 32-bit digits, lowest first, at least one; a key of other digits is as good. */
void twister_seed(twister *t, const uint32_t *key, int digits);

double twister_unit(twister *t);                                 /* random(): [0, 1), a multiple of 2^-53 */
double twister_uniform(twister *t, double low, double high);     /* uniform(low, high) */
double twister_gauss(twister *t, double mean, double deviation); /* gauss(mean, deviation), drawn in pairs */
int twister_below(twister *t, int n);                            /* choice(range(n)): 0 to n-1, 1 <= n < 2^30 */
int twister_between(twister *t, int low, int high);              /* randint(low, high), both included */

#endif
