/* Fixed-point primitives. Each operation stands here once, with its exact result; every variant for small cores gives
 * the same bits (tests/core/fixed_test.c holds them against 128-bit arithmetic). */
#ifndef GN_FIXED_H
#define GN_FIXED_H

#include <stdint.h>

/* GN_CHECKED 1: broken internal promises trap. */
#if defined GN_CHECKED && GN_CHECKED
#define GN_ASSERT(condition) ((condition) ? (void)0 : __builtin_trap())
#else
#define GN_ASSERT(condition) ((void)0)
#endif

#if defined __GNUC__
#define GN_INLINE static inline __attribute__((always_inline))
#define GN_NOINLINE __attribute__((noinline))
#define GN_COLD __attribute__((noinline, cold)) /* seldom called: small before fast */
#define GN_LIKELY(condition) __builtin_expect(!!(condition), 1)
#define GN_UNLIKELY(condition) __builtin_expect(!!(condition), 0)
#else
#define GN_INLINE static inline
#define GN_NOINLINE
#define GN_COLD
#define GN_LIKELY(condition) (condition)
#define GN_UNLIKELY(condition) (condition)
#endif

/* GN_WIDE_DIVIDE 1: the machine divides 64 by 64 bits itself. Changes speed only. */
#ifndef GN_WIDE_DIVIDE
#if UINTPTR_MAX > 0xffffffffu
#define GN_WIDE_DIVIDE 1
#else
#define GN_WIDE_DIVIDE 0
#endif
#endif

/* GN_SLOW_MULTIPLY 1: no 32 x 32 -> 64 bit multiplier (Cortex-M0, RISC-V without M); 64-bit products are made of
 * 16-bit ones, and of one 32-bit product where both factors are short. Changes speed only. */
#ifndef GN_SLOW_MULTIPLY
#if defined __ARM_ARCH_6M__ || defined __ARM_ARCH_8M_BASE__
#define GN_SLOW_MULTIPLY 1
#else
#define GN_SLOW_MULTIPLY 0
#endif
#endif

/* GN_ARITHMETIC_SHIFT 1: >> of a negative number rounds down, as nearly every compiler has it. Changes speed only. */
#ifndef GN_ARITHMETIC_SHIFT
#define GN_ARITHMETIC_SHIFT ((-1 >> 1) == -1)
#endif

/* floor(v / 2^n), 0 <= n < width. The one place that asks what >> does to negative numbers. */
#if GN_ARITHMETIC_SHIFT
GN_INLINE int32_t gn_floor_shift(int32_t v, unsigned n)
{
    return v >> n;
}
GN_INLINE int64_t gn_floor_shift_64(int64_t v, unsigned n)
{
    return v >> n;
}
#else
GN_INLINE int32_t gn_floor_shift(int32_t v, unsigned n)
{
    return v < 0 ? ~(~v >> n) : v >> n;
}
GN_INLINE int64_t gn_floor_shift_64(int64_t v, unsigned n)
{
    return v < 0 ? ~(~v >> n) : v >> n;
}
#endif

/* v held between low and high. */
GN_INLINE int64_t gn_clamp(int64_t v, int64_t low, int64_t high)
{
    return v < low ? low : v > high ? high : v;
}

/* Number of leading zero bits; v != 0. */
GN_INLINE unsigned gn_leading_zeros(uint32_t v)
{
    GN_ASSERT(v != 0);
#if defined __GNUC__
    return (unsigned)__builtin_clz(v) - (unsigned)(sizeof(unsigned) * 8 - 32);
#else
    unsigned n = 0;
    for (; !(v & 0x80000000u); v <<= 1)
        n++;
    return n;
#endif
}

GN_INLINE unsigned gn_leading_zeros_64(uint64_t v)
{
    uint32_t high = (uint32_t)(v >> 32);
    return high ? gn_leading_zeros(high) : 32 + gn_leading_zeros((uint32_t)v);
}

/* Smallest n with 2^n >= count; 32 at most. */
GN_INLINE uint32_t gn_bits_for(uint32_t count)
{
    return count > 1 ? 32 - gn_leading_zeros(count - 1) : 0;
}

/* a b, exactly. */
#if GN_SLOW_MULTIPLY
uint64_t gn_multiply_u_slow(uint32_t a, uint32_t b);
int64_t gn_multiply_slow(int32_t a, int32_t b);
#define gn_multiply_u gn_multiply_u_slow
#define gn_multiply gn_multiply_slow
#else
GN_INLINE uint64_t gn_multiply_u(uint32_t a, uint32_t b)
{
    return (uint64_t)a * b;
}
GN_INLINE int64_t gn_multiply(int32_t a, int32_t b)
{
    return (int64_t)a * b;
}
#endif

/* floor(a b / 2^32). */
GN_INLINE int32_t gn_multiply_high(int32_t a, int32_t b)
{
    return (int32_t)gn_floor_shift_64(gn_multiply(a, b), 32);
}

/* floor(n / d) where the quotient fits 32 bits: n / 2^32 < d. */
#if GN_WIDE_DIVIDE
GN_INLINE uint32_t gn_divide(uint64_t n, uint32_t d)
{
    GN_ASSERT((n >> 32) < d);
    return (uint32_t)(n / d);
}
#else
uint32_t gn_divide(uint64_t n, uint32_t d);
#endif

/* floor(sqrt(v)). */
uint32_t gn_square_root(uint64_t v);

/* 32 bits wide where a vector unit may gather it. */
#if UINTPTR_MAX > 0xffffffffu
typedef uint32_t gn_seed;
#else
typedef uint16_t gn_seed;
#endif

/* About 2^62 / d for 2^31 <= d < 2^32, in (2^30 - 2^10, 2^31): relative error -2^-18 to 2^-21, without a wide
 * product or a divider. One Newton step on a 16-bit seed from a table: r = s - s (s d - 1). */
extern const gn_seed gn_reciprocal_seed[256];
GN_INLINE uint32_t gn_reciprocal(uint32_t d)
{
    uint32_t seed = gn_reciprocal_seed[(d >> 23) & 255];
    /* The product is 2^38 (1 + e) with |e| < 2^-9; modulo 2^32 there remains 2^38 e, signed. */
    int32_t error = (int32_t)((d >> 9) * seed);
    return (seed << 15) - (uint32_t)gn_floor_shift((int32_t)seed * gn_floor_shift(error, 14), 9);
}

/* floor((2^63 - 1) / d) for 2^31 <= d < 2^32: in [2^31, 2^32). */
#if GN_WIDE_DIVIDE
GN_INLINE uint32_t gn_reciprocal_exact(uint32_t d)
{
    return gn_divide(UINT64_C(0x7fffffffffffffff), d);
}
#else
uint32_t gn_reciprocal_exact(uint32_t d);
#endif

#endif
