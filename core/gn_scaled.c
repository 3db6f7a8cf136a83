#include "gn_scaled.h"

gn_scaled gn_scale(int64_t v, int32_t e)
{
    gn_scaled a = {0, 0};
    if (v == 0)
        return a;
    uint64_t magnitude = v < 0 ? 0u - (uint64_t)v : (uint64_t)v;
    int32_t excess = 33 - (int32_t)gn_leading_zeros_64(magnitude);
    if (excess > 0) {
        a.m = (int32_t)gn_floor_shift_64(v, (unsigned)excess);
    } else {
        int32_t m = (int32_t)(magnitude << -excess);
        a.m = v < 0 ? -m : m;
    }
    a.e = e + excess;
    return a;
}

gn_scaled gn_scaled_multiply(gn_scaled a, gn_scaled b)
{
    return gn_scale(gn_multiply(a.m, b.m), a.e + b.e);
}

gn_scaled gn_scaled_divide(gn_scaled a, gn_scaled b)
{
    GN_ASSERT(b.m != 0);
    uint32_t n = a.m < 0 ? 0u - (uint32_t)a.m : (uint32_t)a.m;
    uint32_t d = b.m < 0 ? 0u - (uint32_t)b.m : (uint32_t)b.m;
    if (n == 0)
        return a;
    /* n / d lies in (1/4, 4): 30 fraction bits fit 32. */
    int64_t q = gn_divide((uint64_t)n << 30, d);
    return gn_scale((a.m < 0) != (b.m < 0) ? -q : q, a.e - b.e - 30);
}

gn_scaled gn_scaled_add(gn_scaled a, gn_scaled b)
{
    if (a.m == 0)
        return b;
    if (b.m == 0)
        return a;
    if (a.e < b.e) {
        gn_scaled t = a;
        a = b;
        b = t;
    }
    int32_t apart = a.e - b.e;
    if (apart > 31)
        return a;
    /* The larger one with 31 bits more, less what the difference uses. */
    int64_t sum = a.m * ((int64_t)1 << apart) + b.m;
    return gn_scale(sum, b.e);
}

gn_scaled gn_scaled_negate(gn_scaled a)
{
    return gn_scale(-(int64_t)a.m, a.e);
}

gn_scaled gn_scaled_magnitude(gn_scaled a)
{
    return a.m < 0 ? gn_scaled_negate(a) : a;
}

int32_t gn_scaled_bits(gn_scaled a)
{
    return a.m ? a.e + 31 : -1000;
}

int64_t gn_scaled_round(gn_scaled a, int32_t e)
{
    int32_t shift = a.e - e;
    if (shift >= 0) {
        GN_ASSERT(shift <= 31 || a.m == 0);
        return a.m ? a.m * ((int64_t)1 << shift) : 0;
    }
    if (shift < -32)
        return 0;
    return gn_floor_shift_64(gn_floor_shift_64((int64_t)a.m, (unsigned)(-shift - 1)) + 1, 1);
}
