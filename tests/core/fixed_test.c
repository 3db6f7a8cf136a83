/* Every fixed-point primitive against 128-bit arithmetic, in two builds of the same sources: as this machine compiles
 * them, and as a small core does that has no 64-bit product, no wide divider, no compiler built-ins, and whose compiler
 * shifts zeros into negative numbers. Needs a compiler with 128-bit integers (64-bit hosts). Cases per primitive: 10^7,
 * or GNOMON_CASES=100000000. */
#include "gn_fixed.h"
#include "tap.h"

__extension__ typedef __int128 exact;
__extension__ typedef unsigned __int128 exact_u;

struct primitives {
    const char *name;
    int32_t (*floor_shift)(int32_t v, unsigned n);
    int64_t (*floor_shift_64)(int64_t v, unsigned n);
    unsigned (*leading_zeros)(uint32_t v);
    unsigned (*leading_zeros_64)(uint64_t v);
    uint64_t (*multiply_u)(uint32_t a, uint32_t b);
    int64_t (*multiply)(int32_t a, int32_t b);
    int32_t (*multiply_high)(int32_t a, int32_t b);
    uint32_t (*divide)(uint64_t n, uint32_t d);
    uint32_t (*reciprocal_exact)(uint32_t d);
    uint32_t (*reciprocal)(uint32_t d);
    uint32_t (*square_root)(uint64_t v);
    uint32_t (*seed)(uint32_t i);
};

/* The primitives under the names that they have where this stands. */
#define PRIMITIVES(build)                                                                                              \
    static int32_t build##_floor_shift(int32_t v, unsigned n)                                                          \
    {                                                                                                                  \
        return gn_floor_shift(v, n);                                                                                   \
    }                                                                                                                  \
    static int64_t build##_floor_shift_64(int64_t v, unsigned n)                                                       \
    {                                                                                                                  \
        return gn_floor_shift_64(v, n);                                                                                \
    }                                                                                                                  \
    static unsigned build##_leading_zeros(uint32_t v)                                                                  \
    {                                                                                                                  \
        return gn_leading_zeros(v);                                                                                    \
    }                                                                                                                  \
    static unsigned build##_leading_zeros_64(uint64_t v)                                                               \
    {                                                                                                                  \
        return gn_leading_zeros_64(v);                                                                                 \
    }                                                                                                                  \
    static uint64_t build##_multiply_u(uint32_t a, uint32_t b)                                                         \
    {                                                                                                                  \
        return gn_multiply_u(a, b);                                                                                    \
    }                                                                                                                  \
    static int64_t build##_multiply(int32_t a, int32_t b)                                                              \
    {                                                                                                                  \
        return gn_multiply(a, b);                                                                                      \
    }                                                                                                                  \
    static int32_t build##_multiply_high(int32_t a, int32_t b)                                                         \
    {                                                                                                                  \
        return gn_multiply_high(a, b);                                                                                 \
    }                                                                                                                  \
    static uint32_t build##_divide(uint64_t n, uint32_t d)                                                             \
    {                                                                                                                  \
        return gn_divide(n, d);                                                                                        \
    }                                                                                                                  \
    static uint32_t build##_reciprocal_exact(uint32_t d)                                                               \
    {                                                                                                                  \
        return gn_reciprocal_exact(d);                                                                                 \
    }                                                                                                                  \
    static uint32_t build##_reciprocal(uint32_t d)                                                                     \
    {                                                                                                                  \
        return gn_reciprocal(d);                                                                                       \
    }                                                                                                                  \
    static uint32_t build##_square_root(uint64_t v)                                                                    \
    {                                                                                                                  \
        return gn_square_root(v);                                                                                      \
    }                                                                                                                  \
    static uint32_t build##_seed(uint32_t i)                                                                           \
    {                                                                                                                  \
        return gn_reciprocal_seed[i];                                                                                  \
    }                                                                                                                  \
    static const struct primitives build = {#build,                                                                    \
                                            build##_floor_shift,                                                       \
                                            build##_floor_shift_64,                                                    \
                                            build##_leading_zeros,                                                     \
                                            build##_leading_zeros_64,                                                  \
                                            build##_multiply_u,                                                        \
                                            build##_multiply,                                                          \
                                            build##_multiply_high,                                                     \
                                            build##_divide,                                                            \
                                            build##_reciprocal_exact,                                                  \
                                            build##_reciprocal,                                                        \
                                            build##_square_root,                                                       \
                                            build##_seed};

PRIMITIVES(this_machine)

/* The sources a second time, under other names. */
#undef GN_FIXED_H
#undef GN_INLINE
#undef GN_NOINLINE
#undef GN_COLD
#undef GN_LIKELY
#undef GN_UNLIKELY
#undef GN_WIDE_DIVIDE
#undef GN_SLOW_MULTIPLY
#undef GN_ARITHMETIC_SHIFT
#undef gn_multiply
#undef gn_multiply_u
#undef __GNUC__ /* no built-ins */
#define GN_WIDE_DIVIDE 0
#define GN_SLOW_MULTIPLY 1
#define GN_ARITHMETIC_SHIFT 0
#define gn_clamp second_clamp
#define gn_bits_for second_bits_for
#define gn_floor_shift second_floor_shift
#define gn_floor_shift_64 second_floor_shift_64
#define gn_leading_zeros second_leading_zeros
#define gn_leading_zeros_64 second_leading_zeros_64
#define gn_multiply_u_slow second_multiply_u_slow
#define gn_multiply_slow second_multiply_slow
#define gn_multiply_high second_multiply_high
#define gn_divide second_divide
#define gn_reciprocal_exact second_reciprocal_exact
#define gn_reciprocal second_reciprocal
#define gn_seed second_seed
#define gn_reciprocal_seed second_reciprocal_seed
#define gn_square_root second_square_root
#include "gn_fixed.c"

PRIMITIVES(small_core)

/* ---- cases ----------------------------------------------------------------------------------------------------- */

static uint64_t random_state;

static const uint32_t edges[] = {0,          1,          2,          3,          255,        256,        0x7fff,
                                 0x8000,     0x8001,     0xfffe,     0xffff,     0x10000,    0x10001,    0x7fff0000,
                                 0x7fff8000, 0x7fffffff, 0x80000000, 0x80000001, 0x8000ffff, 0xffff0000, 0xffff0001,
                                 0xffff7fff, 0xffff8000, 0xffff8001, 0xfffeffff, 0xfffffffe, 0xffffffff};
enum { EDGES = sizeof edges / sizeof edges[0] };

/* 32 bits, of every length alike, and their complements. */
static uint32_t random_32(void)
{
    uint64_t r = tap_random(&random_state);
    uint32_t v = (uint32_t)r >> (r >> 32 & 31);
    return r >> 63 ? ~v : v;
}

static uint64_t random_64(void)
{
    uint64_t r = tap_random(&random_state);
    uint64_t v = tap_random(&random_state) >> (r & 63);
    return r >> 63 ? ~v : v;
}

/* First all pairs of edges, then random pairs. */
static void pair(uint64_t i, uint32_t *a, uint32_t *b)
{
    *a = i < EDGES * EDGES ? edges[i / EDGES] : random_32();
    *b = i < EDGES * EDGES ? edges[i % EDGES] : random_32();
}

/* Count a failure and show the first few. */
static int failed(unsigned *failures, const struct primitives *p, const char *what, uint64_t a, uint64_t b, int64_t got,
                  int64_t expected)
{
    if ((*failures)++ < 5)
        note("%s: %s(0x%llx, 0x%llx): got %lld, expected %lld", p->name, what, (unsigned long long)a,
             (unsigned long long)b, (long long)got, (long long)expected);
    return 0;
}

/* ---- promises -------------------------------------------------------------------------------------------------- */

/* floor(v / 2^n) without a shift of v. */
static exact floor_quotient(exact v, unsigned n)
{
    exact unit = (exact)1 << n, rest = v % unit;
    return (v - (rest < 0 ? rest + unit : rest)) / unit;
}

static void shifts_round_down(const struct primitives *p, uint64_t cases)
{
    unsigned failures = 0;
    for (uint64_t i = 0; i < cases; i++) {
        uint64_t v = i < 64 * EDGES ? (uint64_t)edges[i / 64] << 32 | edges[i / 64] : random_64();
        unsigned n = (unsigned)(i & 63);
        int64_t got = p->floor_shift_64((int64_t)v, n), expected = (int64_t)floor_quotient((int64_t)v, n);
        if (got != expected)
            failed(&failures, p, "gn_floor_shift_64", v, n, got, expected);
        n &= 31;
        got = p->floor_shift((int32_t)v, n);
        expected = (int64_t)floor_quotient((int32_t)v, n);
        if (got != expected)
            failed(&failures, p, "gn_floor_shift", v, n, got, expected);
    }
    ok(!failures, "%s: shifts round down", p->name);
}

static void leading_zeros_are_counted(const struct primitives *p, uint64_t cases)
{
    unsigned failures = 0;
    for (uint64_t i = 0; i < cases; i++) {
        uint64_t v = i < 64 ? UINT64_C(1) << i : random_64() | 1;
        uint32_t w = (uint32_t)(v >> 32) | (uint32_t)v;
        unsigned n = p->leading_zeros_64(v), expected = 0;
        while (!(v << expected >> 63))
            expected++;
        if (n != expected)
            failed(&failures, p, "gn_leading_zeros_64", v, 0, n, expected);
        n = p->leading_zeros(w);
        for (expected = 0; !(w << expected >> 31); expected++)
            ;
        if (n != expected)
            failed(&failures, p, "gn_leading_zeros", w, 0, n, expected);
    }
    ok(!failures, "%s: leading zeros are counted", p->name);
}

static void products_are_exact(const struct primitives *p, uint64_t cases)
{
    unsigned failures = 0;
    for (uint64_t i = 0; i < cases; i++) {
        uint32_t a, b;
        pair(i, &a, &b);
        exact_u expected_u = (exact_u)a * b;
        exact expected = (exact)(int32_t)a * (int32_t)b;
        uint64_t got_u = p->multiply_u(a, b);
        int64_t got = p->multiply((int32_t)a, (int32_t)b);
        if (got_u != expected_u)
            failed(&failures, p, "gn_multiply_u", a, b, (int64_t)got_u, (int64_t)expected_u);
        if (got != expected)
            failed(&failures, p, "gn_multiply", a, b, got, (int64_t)expected);
    }
    ok(!failures, "%s: products are exact, signed and unsigned, in %llu cases", p->name, (unsigned long long)cases);
}

static void high_products_round_down(const struct primitives *p, uint64_t cases)
{
    unsigned failures = 0;
    for (uint64_t i = 0; i < cases; i++) {
        uint32_t a, b;
        pair(i, &a, &b);
        int64_t expected = (int64_t)floor_quotient((exact)(int32_t)a * (int32_t)b, 32);
        int32_t got = p->multiply_high((int32_t)a, (int32_t)b);
        if (got != expected)
            failed(&failures, p, "gn_multiply_high", a, b, got, expected);
    }
    ok(!failures, "%s: upper halves of products round down", p->name);
}

static void quotients_round_down(const struct primitives *p, uint64_t cases)
{
    unsigned failures = 0;
    for (uint64_t i = 0; i < cases; i++) {
        uint32_t quotient, d;
        pair(i, &quotient, &d);
        if (!d)
            continue;
        uint32_t rests[3] = {0, d - 1, random_32() % d};
        for (int k = 0; k < 3; k++) {
            exact_u n = (exact_u)quotient * d + rests[k];
            uint32_t got = p->divide((uint64_t)n, d);
            if (n >> 64 || got != quotient)
                failed(&failures, p, "gn_divide", (uint64_t)n, d, got, quotient);
        }
    }
    ok(!failures, "%s: quotients round down, in %llu cases, each with the smallest, the largest and a random rest",
       p->name, (unsigned long long)cases);
}

static void exact_reciprocals_round_down(const struct primitives *p, uint64_t cases)
{
    unsigned failures = 0;
    for (uint64_t i = 0; i < cases; i++) {
        uint32_t d = UINT32_C(0x80000000) | (i < EDGES ? edges[i] : random_32());
        uint64_t got = p->reciprocal_exact(d), expected = (uint64_t)INT64_MAX / d;
        if (got != expected || got >> 31 != 1)
            failed(&failures, p, "gn_reciprocal_exact", d, 0, (int64_t)got, (int64_t)expected);
    }
    ok(!failures, "%s: exact reciprocals round down", p->name);
}

/* The result depends on d / 512 alone, so both ends of each interval of 512 bound the error of all 2^31 arguments. */
static void reciprocals_keep_their_bound(const struct primitives *p)
{
    unsigned failures = 0;
    double low = 0, high = 0;
    uint32_t least = UINT32_MAX, most = 0;
    const exact one = (exact)1 << 62;
    for (uint32_t i = UINT32_C(1) << 22; i < UINT32_C(1) << 23; i++) {
        for (int end = 0; end < 2; end++) {
            uint32_t d = i << 9 | (end ? 511u : 0), got = p->reciprocal(d);
            exact error = (exact)got * d - one;
            double relative = (double)error / (double)one;
            low = relative < low ? relative : low;
            high = relative > high ? relative : high;
            least = got < least ? got : least;
            most = got > most ? got : most;
            if (error < -((exact)1 << 44) || error > (exact)1 << 41)
                failed(&failures, p, "gn_reciprocal", d, 0, got, (int64_t)(one / d));
        }
    }
    note("%s: gn_reciprocal: relative error %.3g to %.3g, values %lu to %lu", p->name, low, high, (unsigned long)least,
         (unsigned long)most);
    ok(!failures, "%s: reciprocals are within -2^-18 and 2^-21, for every divisor", p->name);
    ok(least > (UINT32_C(1) << 30) - 1024 && most < UINT32_C(1) << 31, "%s: reciprocals keep their range", p->name);
}

static void seeds_are_reciprocals(const struct primitives *p)
{
    unsigned failures = 0;
    for (uint32_t i = 0; i < 256; i++) {
        uint32_t twice = 513 + 2 * i, expected = ((UINT32_C(1) << 26) / twice + 1) / 2; /* round(2^24 / (256.5 + i)) */
        uint32_t got = p->seed(i);
        if (got != expected)
            failed(&failures, p, "gn_reciprocal_seed", i, 0, got, expected);
    }
    ok(!failures, "%s: seeds are rounded reciprocals of the middles of their intervals", p->name);
}

static void check_square_root(const struct primitives *p, unsigned *failures, uint64_t v)
{
    exact_u got = p->square_root(v);
    if (got * got > v || (got + 1) * (got + 1) <= v)
        failed(failures, p, "gn_square_root", v, 0, (int64_t)got, -1);
}

static void square_roots_round_down(const struct primitives *p, uint64_t cases)
{
    unsigned failures = 0;
    for (uint64_t i = 0; i < cases; i++) {
        uint64_t root = i < EDGES ? edges[i] : random_32();
        check_square_root(p, &failures, root * root);
        check_square_root(p, &failures, root * root - 1); /* 0 - 1: the largest argument */
        check_square_root(p, &failures, random_64());
    }
    ok(!failures, "%s: square roots round down", p->name);
}

int main(int argc, char **argv)
{
    uint64_t cases = tap_cases(argc, argv, 10000000);
    const struct primitives *builds[2] = {&this_machine, &small_core};
    for (int i = 0; i < 2; i++) {
        const struct primitives *p = builds[i];
        random_state = 1;
        shifts_round_down(p, cases / 10);
        leading_zeros_are_counted(p, cases / 10);
        products_are_exact(p, cases);
        high_products_round_down(p, cases / 10);
        quotients_round_down(p, cases);
        exact_reciprocals_round_down(p, cases / 10);
        reciprocals_keep_their_bound(p);
        seeds_are_reciprocals(p);
        square_roots_round_down(p, cases / 20);
    }
    return tap_done();
}
