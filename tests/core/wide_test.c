/* Scaled integers with 62 bits against integers of 128: each operation's exact result, or its error against a bound
 * that is derived here from its steps. Numbers are of all sizes, with powers of two, extremes and ties among them.
 * Cases: 2000000 of each operation, or GNOMON_CASES. */
#include "gn_wide.h"
#include "tap.h"

__extension__ typedef __int128 exact;

static const int64_t most = (int64_t)1 << 62;

static uint64_t random_state = 11;

static int64_t between(int64_t low, int64_t high)
{
    return low + (int64_t)(tap_random(&random_state) % ((uint64_t)(high - low) + 1));
}

static exact magnitude(exact v)
{
    return v < 0 ? -v : v;
}

static exact power(int32_t n)
{
    return (exact)1 << n;
}

/* floor(v / 2^n). */
static exact floor_power(exact v, int32_t n)
{
    return v < 0 ? -((-v + power(n) - 1) / power(n)) : v / power(n);
}

/* Of up to `bits` bits; every other one at or next to a power of two, or 0. */
static int64_t random_integer(int32_t bits)
{
    int32_t size = (int32_t)between(0, bits);
    int64_t limit = (int64_t)power(size < 63 ? size : 62), v = between(0, limit);
    if (between(0, 1))
        v = limit + between(-2, 0);
    if (size == 63)
        v = INT64_MAX - between(0, 2);
    return between(0, 1) ? v : -v;
}

/* Of any size, as the operations leave them: also with -2^62 and 2^62. */
static gn_wide random_wide(void)
{
    int64_t v = random_integer(63);
    gn_wide a = gn_widen(v, (int32_t)between(-400, 400));
    if (a.m && between(0, 7) == 0)
        a.m = a.m < 0 ? most : -most; /* what negation and rounding make of powers of two */
    return a;
}

static int is_normal(gn_wide a)
{
    return a.m ? magnitude(a.m) >= power(61) && magnitude(a.m) <= power(62) : a.e == 0;
}

static void show(const char *name, gn_wide a)
{
    note("    %s = %lld 2^%ld", name, (long long)a.m, (long)a.e);
}

/* |v| / |of| in units of 2^-62: how the worst error is told. */
static double in_units(exact v, exact of)
{
    return (double)magnitude(v) / (double)magnitude(of) * 4611686018427387904.0;
}

/* ---- making ---------------------------------------------------------------------------------------------------- */

static int makes(int64_t v, int32_t e)
{
    gn_wide a = gn_widen(v, e);
    int32_t shift = a.e - e;
    int good = is_normal(a);
    if (v == 0)
        return good && a.m == 0;
    /* exact, but that 63 bits lose their last one, downward */
    good = good && shift <= 1 && (shift == 1 ? a.m == floor_power(v, 1) : (exact)v == (exact)a.m / power(-shift));
    return good && (shift >= 0 || a.m % (int64_t)power(-shift) == 0) && (shift < 1 || magnitude(v) >= power(62));
}

static void numbers_are_made_exactly(uint64_t cases)
{
    uint64_t bad = 0;
    for (uint64_t i = 0; i < cases; i++) {
        int64_t v = random_integer(63);
        if (!makes(v, (int32_t)between(-400, 400)) && bad++ < 5)
            show("a", gn_widen(v, 0));
    }
    static const int64_t extremes[] = {0, 1, -1, 2, -2, 3, -3, INT64_MAX, -INT64_MAX};
    for (unsigned i = 0; i < sizeof extremes / sizeof *extremes; i++)
        bad += !makes(extremes[i], 0);
    for (int32_t n = 0; n < 63; n++)
        for (int32_t d = -1; d <= 1; d++)
            bad += !makes((int64_t)(power(n) + d), -7) + !makes((int64_t) - (power(n) + d), -7);
    ok(bad == 0, "numbers_of_up_to_62_bits_are_made_exactly_and_of_63_cut_by_one_bit");
    gn_wide a = gn_widen(-1, 0), b = gn_widen(1, 0);
    ok(a.m == -most && a.e == -62 && b.m == most / 2 && b.e == -61, "one_and_minus_one_are_made_as_done_by_hand");
}

/* ---- products of vectors --------------------------------------------------------------------------------------- */

/* The exact sum, cut toward minus infinity to the 62 bits of a normal number. */
static int dot_is_cut(const int64_t n[3], const int32_t v[3])
{
    exact sum = 0;
    for (int i = 0; i < 3; i++)
        sum += (exact)n[i] * v[i];
    gn_wide a = gn_wide_dot(n, v);
    if (sum == 0 || a.m == 0)
        return sum == 0 && a.m == 0 && a.e == 0;
    return is_normal(a) && (a.e > 0 ? a.m == floor_power(sum, a.e) : sum * power(-a.e) == a.m);
}

static void show_dot(const int64_t n[3], const int32_t v[3])
{
    note("    (%lld %lld %lld) . (%ld %ld %ld)", (long long)n[0], (long long)n[1], (long long)n[2], (long)v[0],
         (long)v[1], (long)v[2]);
}

static void products_of_vectors_are_exact_before_they_are_cut(uint64_t cases)
{
    uint64_t bad = 0, cancelled = 0;
    for (uint64_t i = 0; i < cases; i++) {
        int64_t n[3];
        int32_t v[3];
        for (int k = 0; k < 3; k++) {
            n[k] = random_integer(61);
            v[k] = (int32_t)random_integer(30);
        }
        if (between(0, 3) == 0) { /* nearly perpendicular: what is left is small */
            n[0] = (int64_t)v[1] * (1 << 30) + between(-1, 1);
            n[1] = -(int64_t)v[0] * (1 << 30);
            n[2] = between(-1, 1);
            cancelled++;
        }
        if (!dot_is_cut(n, v) && bad++ < 5)
            show_dot(n, v);
    }
    ok(bad == 0, "products_of_vectors_are_exact_and_then_cut_toward_minus_infinity");
    ok(cancelled > cases / 8 || cases < 100, "also_where_their_terms_cancel");
    int good = 1;
    for (int signs = 0; signs < 64; signs++) {
        int64_t n[3];
        int32_t v[3];
        for (int k = 0; k < 3; k++) {
            n[k] = signs >> k & 1 ? most / 2 : -most / 2;
            v[k] = signs >> (3 + k) & 1 ? 1 << 30 : -(1 << 30);
        }
        good &= dot_is_cut(n, v);
    }
    ok(good, "also_at_the_ends_of_their_ranges");
}

/* ---- multiplication, sum, reciprocal --------------------------------------------------------------------------- */

/* The product of halves errs downward by less than 1 + 2^-29 of 2^62, and is at least 2^60; 2^62 is taken for 2^62 - 1,
 * 2^-62 of each factor: below 1.51 2^-60 together, 6.04 in units of 2^-62. */
#define MULTIPLY_UNITS 6.04

/* Three losses of at most 1, 1/2 and 1/2 of 2^62 in halves of it: below 3 of the larger term's last bit, which is at
 * least 2^61 of these. Of the term, not of the sum: where terms cancel nothing may be left. */
#define ADD_UNITS 6.0

/* A seed within 2^-31, squared by the Newton step: 1; its two products 2 and 4, upward or downward; 2^62 taken for
 * 2^62 - 1: 1. */
#define RECIPROCAL_UNITS 8.0

static double multiply_error(gn_wide a, gn_wide b)
{
    gn_wide p = gn_wide_multiply(a, b);
    if (a.m == 0 || b.m == 0 || p.m == 0)
        return p.m == 0 && (a.m == 0 || b.m == 0) ? 0 : 1e9;
    exact product = (exact)a.m * b.m;
    int32_t apart = p.e - a.e - b.e;
    if (!is_normal(p) || apart < 58 || apart > 64)
        return 1e9;
    return in_units((exact)p.m * power(apart) - product, product);
}

/* Exactly in units of the smaller term's last bit; where these do not fit the larger term must come back. */
static double add_error(gn_wide a, gn_wide b)
{
    gn_wide sum = gn_wide_add(a, b);
    if (a.m == 0 || b.m == 0) {
        gn_wide other = a.m ? a : b;
        return sum.m == other.m && sum.e == other.e ? 0 : 1e9;
    }
    gn_wide large = a.e < b.e ? b : a, small = a.e < b.e ? a : b;
    int32_t apart = large.e - small.e, left = sum.e - small.e;
    if (!is_normal(sum))
        return 1e9;
    if (apart > 62) /* the whole of the smaller one is lost: at most 2^-62 */
        return sum.m == large.m && sum.e == large.e ? in_units(small.m, large.m) / (double)power(63) : 1e9;
    exact expected = (exact)large.m * power(apart) + small.m;
    if (sum.m == 0)
        return in_units(expected, (exact)large.m * power(apart));
    exact got = left < 0 ? (exact)sum.m / power(-left > 62 ? 62 : -left) : (exact)sum.m * power(left);
    return left > 64 ? 1e9 : in_units(got - expected, (exact)large.m * power(apart));
}

static double reciprocal_error(gn_wide a)
{
    gn_wide r = gn_wide_reciprocal(a);
    exact product = (exact)a.m * r.m;
    int32_t one = -(a.e + r.e);
    if (!is_normal(r) || product <= 0 || one < 120 || one > 124)
        return 1e9;
    return in_units(product - power(one), power(one));
}

typedef struct worst {
    double units;
    gn_wide a, b;
} worst;

static void keep_worst(worst *w, double units, gn_wide a, gn_wide b)
{
    if (units <= w->units)
        return;
    w->units = units;
    w->a = a;
    w->b = b;
}

/* Less than the bound: the promise is 2^-59, which is 8 units. */
static void report(const worst *w, double bound, const char *name)
{
    note("%s: worst error %.3f 2^-62, bound %.2f", name, w->units, bound);
    if (!ok(w->units < bound, "%s", name)) {
        show("a", w->a);
        show("b", w->b);
    }
}

/* b near -a or near it, so that the sum loses its upper bits. */
static gn_wide near_opposite(gn_wide a)
{
    gn_wide b = gn_wide_negate(a);
    if (b.m && magnitude(b.m) > power(61) + 4 && magnitude(b.m) < power(62) - 4)
        b.m += between(-3, 3);
    b.e += (int32_t)between(-1, 1);
    return b;
}

static void operations_keep_their_bounds(uint64_t cases)
{
    worst multiply = {0, {0, 0}, {0, 0}}, add = multiply, reciprocal = multiply;
    uint64_t not_normal = 0;
    for (uint64_t i = 0; i < cases; i++) {
        gn_wide a = random_wide(), b = random_wide();
        keep_worst(&multiply, multiply_error(a, b), a, b);
        if (a.m && b.m) /* else sums are rarely of the same size */
            b.e = between(0, 1) ? a.e + (int32_t)between(-66, 66) : b.e;
        if (between(0, 7) == 0)
            b = near_opposite(a);
        keep_worst(&add, add_error(a, b), a, b);
        not_normal += !is_normal(gn_wide_negate(a));
        if (a.m)
            keep_worst(&reciprocal, reciprocal_error(a), a, a);
    }
    report(&multiply, MULTIPLY_UNITS, "products_err_by_less_than_2_to_minus_59_of_themselves");
    report(&add, ADD_UNITS, "sums_err_by_less_than_2_to_minus_59_of_the_larger_term");
    report(&reciprocal, RECIPROCAL_UNITS, "reciprocals_err_by_less_than_2_to_minus_59_of_themselves");
    ok(not_normal == 0, "negation_leaves_normal_numbers");
}

/* Seeds at every step of the divisor's upper bits, from both ends of a step. */
static void reciprocals_of_extremes_keep_their_bound(void)
{
    worst reciprocal = {0, {0, 0}, {0, 0}};
    for (int64_t high = 0; high < 1 << 16; high++)
        for (int64_t low = -2; low <= 2; low++)
            for (int sign = -1; sign <= 1; sign += 2) {
                int64_t m = most / 2 + (high << 45) + low;
                gn_wide a = {sign * (m < most / 2 ? most / 2 : m), (int32_t)(high % 200 - 100)};
                keep_worst(&reciprocal, reciprocal_error(a), a, a);
            }
    for (int sign = -1; sign <= 1; sign += 2)
        for (int64_t m = most - 3; m <= most; m++) {
            gn_wide a = {sign * m, 3};
            keep_worst(&reciprocal, reciprocal_error(a), a, a);
        }
    report(&reciprocal, RECIPROCAL_UNITS, "reciprocals_at_steps_of_their_seed_and_at_2_to_62_keep_it_too");
}

/* ---- rounding -------------------------------------------------------------------------------------------------- */

/* floor(m 2^-shift + 1/2), within +-2^62. */
static int64_t rounded(int64_t m, int32_t shift)
{
    if (m == 0 || shift > 64)
        return 0;
    if (shift <= 0) {
        exact v = -shift > 60 ? (m < 0 ? -power(122) : power(122)) : (exact)m * power(-shift);
        return (int64_t)(v > most ? (exact)most : v < -most ? (exact)-most : v);
    }
    return (int64_t)floor_power(2 * (exact)m + power(shift), shift + 1);
}

static void rounding_is_exact(uint64_t cases)
{
    uint64_t bad = 0, ties = 0, held = 0;
    for (uint64_t i = 0; i < cases; i++) {
        gn_wide a = random_wide();
        int32_t shift = (int32_t)between(-4, 66);
        if (a.m && shift > 0 && shift < 62 && between(0, 3) == 0) { /* a half exactly, or next to it */
            a.m = (a.m / (int64_t)power(shift)) * (int64_t)power(shift) + (int64_t)power(shift - 1) + between(-1, 1);
            ties++;
        }
        held += shift < 0;
        int64_t got = gn_wide_round(a, a.e + shift), expected = rounded(a.m, shift);
        if (got != expected && bad++ < 5) {
            show("a", a);
            note("    shifted by %ld: %lld, expected %lld", (long)shift, (long long)got, (long long)expected);
        }
    }
    ok(bad == 0, "rounding_is_to_nearest_halves_up_and_held_within_2_to_62");
    ok((ties && held) || cases < 100, "halves_and_numbers_beyond_the_range_were_among_them");
    gn_wide half = {most / 2, -62}, minus_half = {-most / 2, -62}, limit = {most, 0}, huge = {most / 2, 900};
    ok(gn_wide_round(half, 0) == 1 && gn_wide_round(minus_half, 0) == 0 && gn_wide_round(limit, 0) == most &&
           gn_wide_round(limit, 63) == 1 && gn_wide_round(limit, 64) == 0 && gn_wide_round(huge, -900) == most &&
           gn_wide_round(gn_wide_negate(huge), 0) == -most && gn_wide_round(huge, 2000) == 0,
       "rounding_done_by_hand");
}

static void sizes_are_bounds(uint64_t cases)
{
    uint64_t bad = 0;
    for (uint64_t i = 0; i < cases; i++) {
        gn_wide a = random_wide();
        int32_t n = gn_wide_bits(a) - a.e;
        /* |m| <= 2^n, and at most one bit too many, where |m| is 2^61 */
        bad += a.m ? n < 61 || n > 62 || magnitude(a.m) > power(n) || magnitude(a.m) < power(n - 1)
                   : gn_wide_bits(a) != -10000;
    }
    ok(bad == 0, "sizes_in_bits_bound_a_number_from_above_and_twice_it_from_below");
}

int main(int argc, char **argv)
{
    uint64_t cases = tap_cases(argc, argv, 2000000);
    numbers_are_made_exactly(cases);
    products_of_vectors_are_exact_before_they_are_cut(cases);
    operations_keep_their_bounds(cases);
    reciprocals_of_extremes_keep_their_bound();
    rounding_is_exact(cases);
    sizes_are_bounds(cases);
    return tap_done();
}
