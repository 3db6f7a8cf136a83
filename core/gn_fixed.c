/* Out-of-line fixed-point primitives: wide division, square root, wide products for small cores. */
#include "gn_fixed.h"

/* round(2^15 / x) at the middle of the interval: x = (256.5 + i) / 512. */
const gn_seed gn_reciprocal_seed[256] = {
    65408, 65154, 64902, 64652, 64404, 64158, 63913, 63671, 63430, 63191, 62954, 62719, 62485, 62253, 62023, 61795,
    61568, 61343, 61119, 60897, 60677, 60458, 60241, 60026, 59812, 59599, 59388, 59179, 58971, 58764, 58559, 58356,
    58153, 57952, 57753, 57555, 57358, 57163, 56968, 56776, 56584, 56394, 56205, 56017, 55831, 55646, 55462, 55279,
    55098, 54917, 54738, 54560, 54383, 54207, 54033, 53859, 53687, 53516, 53346, 53177, 53009, 52842, 52676, 52511,
    52347, 52184, 52022, 51862, 51702, 51543, 51385, 51228, 51072, 50917, 50763, 50610, 50458, 50306, 50156, 50007,
    49858, 49710, 49563, 49417, 49272, 49128, 48985, 48842, 48700, 48559, 48419, 48280, 48141, 48003, 47867, 47730,
    47595, 47460, 47326, 47193, 47061, 46929, 46798, 46668, 46539, 46410, 46282, 46155, 46028, 45902, 45777, 45652,
    45528, 45405, 45283, 45161, 45040, 44919, 44799, 44680, 44561, 44443, 44326, 44209, 44093, 43977, 43862, 43748,
    43634, 43521, 43408, 43296, 43185, 43074, 42963, 42854, 42744, 42636, 42528, 42420, 42313, 42207, 42101, 41996,
    41891, 41786, 41683, 41579, 41476, 41374, 41272, 41171, 41070, 40970, 40870, 40771, 40672, 40574, 40476, 40378,
    40281, 40185, 40089, 39993, 39898, 39804, 39709, 39616, 39522, 39429, 39337, 39245, 39153, 39062, 38971, 38881,
    38791, 38702, 38613, 38524, 38436, 38348, 38260, 38173, 38087, 38000, 37915, 37829, 37744, 37659, 37575, 37491,
    37407, 37324, 37241, 37159, 37077, 36995, 36914, 36833, 36752, 36672, 36592, 36512, 36433, 36354, 36275, 36197,
    36119, 36041, 35964, 35887, 35810, 35734, 35658, 35583, 35507, 35432, 35358, 35283, 35209, 35136, 35062, 34989,
    34916, 34844, 34771, 34700, 34628, 34557, 34486, 34415, 34344, 34274, 34204, 34135, 34065, 33996, 33928, 33859,
    33791, 33723, 33655, 33588, 33521, 33454, 33387, 33321, 33255, 33189, 33124, 33059, 32994, 32929, 32864, 32800,
};

#if !GN_WIDE_DIVIDE
/* Schoolbook division in 16-bit digits (Knuth D): two 32-bit divisions, each corrected at most twice. */
uint32_t gn_divide(uint64_t n, uint32_t d)
{
    GN_ASSERT((n >> 32) < d);
    unsigned shift = gn_leading_zeros(d);
    uint32_t divisor = d << shift, high = divisor >> 16, low = divisor & 0xffffu;
    uint64_t dividend = n << shift;
    uint32_t rest = (uint32_t)(dividend >> 32), next = (uint32_t)dividend;

    uint32_t digit1 = rest / high, r = rest - digit1 * high;
    while (digit1 >> 16 || digit1 * low > ((r << 16) | (next >> 16))) {
        digit1--;
        r += high;
        if (r >> 16)
            break;
    }
    rest = (rest << 16) + (next >> 16) - digit1 * divisor;
    uint32_t digit0 = rest / high;
    r = rest - digit0 * high;
    while (digit0 >> 16 || digit0 * low > ((r << 16) | (next & 0xffffu))) {
        digit0--;
        r += high;
        if (r >> 16)
            break;
    }
    return (digit1 << 16) + digit0;
}

/* One more Newton step on the short reciprocal, r (2 - d r / 2^62), then the exact remainder. */
uint32_t gn_reciprocal_exact(uint32_t d)
{
    GN_ASSERT(d >> 31);
    uint32_t r = gn_reciprocal(d);
    /* 2^62 - d r is at most 2^44 + 2^41 in magnitude; its upper 32 bits are below 2^13 and 2^20 of it are kept */
    int64_t error = (int64_t)((UINT64_C(1) << 62) - gn_multiply_u(d, r));
    int32_t step = (int32_t)gn_floor_shift_64(gn_multiply((int32_t)r, (int32_t)gn_floor_shift_64(error, 14)), 47);
    uint32_t q = 2 * r + (uint32_t)step;
    int64_t rest = (int64_t)(UINT64_C(0x7fffffffffffffff) - gn_multiply_u(q, d));
    while (rest < 0) {
        q--;
        rest += d;
    }
    while (rest >= d) {
        q++;
        rest -= d;
    }
    return q;
}
#endif

#if GN_WIDE_DIVIDE
/* Newton's iteration from above: it falls until it is the floor. */
uint32_t gn_square_root(uint64_t v)
{
    if (v == 0)
        return 0;
    uint64_t root = UINT64_C(1) << ((65 - gn_leading_zeros_64(v)) / 2), next;
    root = root > 0xffffffffu ? 0xffffffffu : root;
    while ((next = (root + v / root) >> 1) < root)
        root = next;
    return (uint32_t)root;
}
#else
/* A binary digit a turn. */
uint32_t gn_square_root(uint64_t v)
{
    uint64_t root = 0, bit = UINT64_C(1) << 62;
    if (v == 0)
        return 0;
    bit >>= gn_leading_zeros_64(v) & ~1u;
    for (; bit; bit >>= 2) {
        if (v >= root + bit) {
            v -= root + bit;
            root = (root >> 1) + bit;
        } else {
            root >>= 1;
        }
    }
    return (uint32_t)root;
}
#endif

#if GN_SLOW_MULTIPLY
uint64_t gn_multiply_u_slow(uint32_t a, uint32_t b)
{
    uint32_t al = a & 0xffffu, ah = a >> 16, bl = b & 0xffffu, bh = b >> 16;
    if (!(ah | bh))
        return al * bl;
    uint32_t low = al * bl, m1 = ah * bl, m2 = al * bh, high = ah * bh;
    uint32_t middle = m1 + (low >> 16); /* at most 2^32 - 2^17 + 1 + 2^16 - 1: fits */
    uint32_t sum = middle + m2;
    high += (sum >> 16) + (sum < m2 ? 0x10000u : 0);
    return ((uint64_t)high << 32) | ((sum << 16) | (low & 0xffffu));
}

int64_t gn_multiply_slow(int32_t a, int32_t b)
{
    if (a == (int16_t)a && b == (int16_t)b)
        return a * b;
    uint64_t p = gn_multiply_u_slow((uint32_t)a, (uint32_t)b);
    uint32_t high = (uint32_t)(p >> 32);
    high -= (a < 0 ? (uint32_t)b : 0) + (b < 0 ? (uint32_t)a : 0);
    return (int64_t)(((uint64_t)high << 32) | (uint32_t)p);
}
#endif
