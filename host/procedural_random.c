/* The Mersenne Twister MT19937 (Matsumoto & Nishimura, ACM TOMACS 8(1), 1998), seeded and read as CPython's
 * Modules/_randommodule.c and Lib/random.py do it. 2.5 KB of state. Not for secrets. */
#include "procedural_random.h"

#include <math.h>

#define MIDDLE 397
#define TWO_PI 6.283185307179586476925

static uint32_t mixed(uint32_t word)
{
    return word ^ (word >> 30);
}

/* init_by_array() of the 2002 reference code. All sums and products are modulo 2^32. */
void twister_seed(twister *t, const uint32_t *key, int digits)
{
    uint32_t *s = t->state;
    s[0] = 19650218u;
    for (int i = 1; i < TWISTER_WORDS; i++)
        s[i] = 1812433253u * mixed(s[i - 1]) + (uint32_t)i;

    int i = 1, j = 0;
    for (int k = digits > TWISTER_WORDS ? digits : TWISTER_WORDS; k > 0; k--) {
        s[i] = (s[i] ^ (mixed(s[i - 1]) * 1664525u)) + key[j] + (uint32_t)j;
        if (++j == digits)
            j = 0;
        if (++i == TWISTER_WORDS) {
            s[0] = s[TWISTER_WORDS - 1];
            i = 1;
        }
    }
    for (int k = TWISTER_WORDS - 1; k > 0; k--) {
        s[i] = (s[i] ^ (mixed(s[i - 1]) * 1566083941u)) - (uint32_t)i;
        if (++i == TWISTER_WORDS) {
            s[0] = s[TWISTER_WORDS - 1];
            i = 1;
        }
    }
    s[0] = 0x80000000u;
    t->next = TWISTER_WORDS;
    t->spare_is_set = 0;
}

static void twist(twister *t)
{
    uint32_t *s = t->state;
    for (int i = 0; i < TWISTER_WORDS; i++) {
        uint32_t joined = (s[i] & 0x80000000u) | (s[(i + 1) % TWISTER_WORDS] & 0x7fffffffu);
        s[i] = s[(i + MIDDLE) % TWISTER_WORDS] ^ (joined >> 1) ^ (joined & 1 ? 0x9908b0dfu : 0);
    }
    t->next = 0;
}

static uint32_t word(twister *t)
{
    if (t->next == TWISTER_WORDS)
        twist(t);
    uint32_t y = t->state[t->next++];
    y ^= y >> 11;
    y ^= (y << 7) & 0x9d2c5680u;
    y ^= (y << 15) & 0xefc60000u;
    return y ^ (y >> 18);
}

double twister_unit(twister *t)
{
    uint32_t high = word(t) >> 5, low = word(t) >> 6;
    return (high * 67108864.0 + low) * (1.0 / 9007199254740992.0);
}

double twister_uniform(twister *t, double low, double high)
{
    return low + (high - low) * twister_unit(t);
}

double twister_gauss(twister *t, double mean, double deviation)
{
    double z = t->spare;
    if (!t->spare_is_set) {
        double angle = twister_unit(t) * TWO_PI;
        double radius = sqrt(-2.0 * log(1.0 - twister_unit(t)));
        z = cos(angle) * radius;
        t->spare = sin(angle) * radius;
    }
    t->spare_is_set = !t->spare_is_set;
    return mean + z * deviation;
}

/* Draws of as many bits as n itself has, until one is below n: CPython's way, so n = 2^k draws k + 1 bits. */
int twister_below(twister *t, int n)
{
    int bits = 0;
    while (n >> bits)
        bits++;
    uint32_t drawn;
    do {
        drawn = word(t) >> (32 - bits);
    } while (drawn >= (uint32_t)n);
    return (int)drawn;
}

int twister_between(twister *t, int low, int high)
{
    return low + twister_below(t, high - low + 1);
}
