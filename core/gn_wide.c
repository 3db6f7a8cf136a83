#include "gn_wide.h"

static const int64_t MOST = (int64_t)1 << 62;

gn_wide gn_widen(int64_t v, int32_t e)
{
    gn_wide a = {0, 0};
    if (v == 0)
        return a;
    uint64_t magnitude = (uint64_t)(v < 0 ? ~v : v); /* -2^k as 2^k - 1: its mantissa is then -2^62 */
    int32_t bits = magnitude ? 64 - (int32_t)gn_leading_zeros_64(magnitude) : 0;
    a.m = bits > 62 ? gn_floor_shift_64(v, 1) : v * ((int64_t)1 << (62 - bits));
    a.e = e + bits - 62;
    return a;
}

gn_wide gn_wide_dot(const int64_t n[3], const int32_t v[3])
{
    int64_t high = 0, low = 0; /* high 2^31 + low */
    for (int i = 0; i < 3; i++) {
        high += gn_multiply((int32_t)gn_floor_shift_64(n[i], 31), v[i]);
        low += gn_multiply((int32_t)(n[i] & 0x7fffffff), v[i]);
    }
    high += gn_floor_shift_64(low, 31);
    low &= 0x7fffffff;
    uint64_t magnitude = (uint64_t)(high < 0 ? ~high : high);
    int32_t room = magnitude ? (int32_t)gn_leading_zeros_64(magnitude) - 2 : 62; /* to fill 62 bits */
    if (room >= 31)
        return gn_widen(high * ((int64_t)1 << 31) + low, 0);
    return gn_widen(high * ((int64_t)1 << room) + (low >> (31 - room)), 31 - room);
}

/* floor(a b / 2^62), |a|, |b| <= 2^62, in halves of 31 bits. 2^62 itself would not fit one: it is taken as 2^62 - 1. */
static int64_t multiply_high(int64_t a, int64_t b)
{
    a = a == MOST ? MOST - 1 : a;
    b = b == MOST ? MOST - 1 : b;
    int32_t ah = (int32_t)gn_floor_shift_64(a, 31), al = (int32_t)(a & 0x7fffffff);
    int32_t bh = (int32_t)gn_floor_shift_64(b, 31), bl = (int32_t)(b & 0x7fffffff);
    int64_t middle = gn_multiply(ah, bl) + gn_floor_shift_64(gn_multiply(al, bl), 31); /* >= -2^62 */
    middle = gn_floor_shift_64(middle, 1) + gn_floor_shift_64(gn_multiply(al, bh), 1);
    return gn_multiply(ah, bh) + gn_floor_shift_64(middle, 30);
}

gn_wide gn_wide_multiply(gn_wide a, gn_wide b)
{
    return gn_widen(multiply_high(a.m, b.m), a.e + b.e + 62);
}

gn_wide gn_wide_add(gn_wide a, gn_wide b)
{
    if (a.m == 0)
        return b;
    if (b.m == 0)
        return a;
    if (a.e < b.e) {
        gn_wide t = a;
        a = b;
        b = t;
    }
    int32_t apart = a.e - b.e;
    if (apart > 62)
        return a;
    /* one bit of the larger one makes room for the sum */
    return gn_widen(gn_floor_shift_64(a.m, 1) + gn_floor_shift_64(gn_floor_shift_64(b.m, (unsigned)apart), 1), a.e + 1);
}

gn_wide gn_wide_negate(gn_wide a)
{
    a.m = -a.m;
    return a;
}

gn_wide gn_wide_reciprocal(gn_wide a)
{
    GN_ASSERT(a.m != 0);
    int64_t m = a.m < 0 ? -a.m : a.m;
    m = m == MOST ? MOST - 1 : m;
    /* 2^123 / m: 31 bits, then a Newton step, r (2 - m r) */
    int64_t r = (int64_t)gn_reciprocal_exact((uint32_t)(m >> 30)) << 30;
    int64_t error = (MOST >> 1) - multiply_high(m, r);
    r += 2 * multiply_high(r, error);
    return gn_widen(a.m < 0 ? -r : r, -123 - a.e);
}

int32_t gn_wide_bits(gn_wide a)
{
    return a.m ? a.e + 62 : -10000;
}

int64_t gn_wide_round(gn_wide a, int32_t e)
{
    int32_t shift = e - a.e;
    if (a.m == 0 || shift > 63)
        return 0;
    if (shift < 0)
        return a.m < 0 ? -MOST : MOST;
    if (shift == 0)
        return a.m;
    return gn_floor_shift_64(gn_floor_shift_64(a.m, (unsigned)(shift - 1)) + 1, 1);
}
