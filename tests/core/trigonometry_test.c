/* Sine, cosine and tangent against the C library in long double. Cases: 2 * 10^6 of each, or GNOMON_CASES. */
#include "gn_trigonometry.h"
#include "tap.h"

#include <math.h>

#define ONE ((int32_t)1 << 30)

static uint64_t random_state = 1;

static long double radians(gn_angle angle)
{
    return ldexpl((long double)angle, -31) * acosl(-1.0L);
}

/* First the neighbours of the eighths of a turn, then random angles. */
static gn_angle some_angle(uint64_t i)
{
    return i < 8 * 64 ? (gn_angle)((i >> 6) << 29) + (gn_angle)(i & 63) - 32 : (gn_angle)tap_random(&random_state);
}

static void show(unsigned *failures, const char *function, gn_angle angle, int64_t got, long double expected)
{
    if ((*failures)++ < 5)
        note("%s(0x%08lx): got %lld, expected %.3Lf", function, (unsigned long)angle, (long long)got, expected);
}

/* The header promises 2^-29 (2 units); the polynomial's comment 1.15 units. */
static void sine_and_cosine_keep_their_bound(uint64_t cases)
{
    unsigned failures = 0;
    long double worst = 0;
    for (uint64_t i = 0; i < cases; i++) {
        gn_angle angle = some_angle(i);
        long double sine = ONE * sinl(radians(angle)), cosine = ONE * cosl(radians(angle));
        long double sine_error = fabsl(gn_sine(angle) - sine), cosine_error = fabsl(gn_cosine(angle) - cosine);
        worst = fmaxl(worst, fmaxl(sine_error, cosine_error));
        if (!(sine_error <= 1.15L))
            show(&failures, "gn_sine", angle, gn_sine(angle), sine);
        if (!(cosine_error <= 1.15L))
            show(&failures, "gn_cosine", angle, gn_cosine(angle), cosine);
    }
    note("largest error of sine and cosine: %.4Lf / 2^30", worst);
    ok(!failures, "sine and cosine are within 1.15 / 2^30, in %llu cases", (unsigned long long)cases);
}

static void symmetries_are_exact(uint64_t cases)
{
    unsigned failures = 0;
    for (uint64_t i = 0; i < cases; i++) {
        gn_angle angle = some_angle(i), half = UINT32_C(1) << 31;
        gn_q2_30 sine = gn_sine(angle), cosine = gn_cosine(angle);
        if (gn_sine(0 - angle) != -sine || gn_sine(half - angle) != sine || gn_sine(half + angle) != -sine)
            show(&failures, "gn_sine of the mirrored angle", angle, gn_sine(0 - angle), -sine);
        if (gn_cosine(0 - angle) != cosine || gn_cosine(half - angle) != -cosine || gn_cosine(half + angle) != -cosine)
            show(&failures, "gn_cosine of the mirrored angle", angle, gn_cosine(0 - angle), cosine);
        if (sine < -ONE || sine > ONE)
            show(&failures, "gn_sine beyond 1", angle, sine, ONE);
    }
    ok(!failures, "sine is odd, cosine even, both symmetric about quarter turns and never beyond 1");
}

static void quarter_turns_are_exact(void)
{
    static const int32_t expected[5] = {0, ONE, 0, -ONE, 0};
    for (uint32_t i = 0; i < 4; i++) {
        gn_angle angle = i << 30;
        if (!ok(gn_sine(angle) == expected[i] && gn_cosine(angle) == expected[i + 1], "%lu degrees are exact",
                90ul * i))
            note("got %ld, %ld; expected %ld, %ld", (long)gn_sine(angle), (long)gn_cosine(angle), (long)expected[i],
                 (long)expected[i + 1]);
    }
}

static void degrees_are_rounded_to_nearest(void)
{
    unsigned failures = 0;
    for (uint32_t d = 0; d < 360; d++) {
        int64_t error = (int64_t)GN_DEGREES(d) * 360 - ((int64_t)d << 32);
        if (error < -180 || error > 180)
            show(&failures, "GN_DEGREES", d, (int64_t)GN_DEGREES(d), ldexpl(d / 360.0L, 32));
    }
    ok(!failures, "whole degrees are rounded to nearest");
}

static const gn_angle least = GN_DEGREES(1) / 4, most = GN_DEGREES(178) / 2;

static void tangent_keeps_its_bound(uint64_t cases)
{
    unsigned failures = 0;
    long double worst = 0;
    for (uint64_t i = 0; i < cases; i++) {
        uint32_t range = most - least + 1;
        gn_angle angle = i == 0 ? least : i == 1 ? most : least + (uint32_t)tap_random(&random_state) % range;
        if (i & 1 && i > 1) /* small and large angles, of each size alike */
            angle = i & 2 ? least + ((angle - least) >> (i >> 2 & 31)) : most - ((angle - least) >> (i >> 2 & 31));
        gn_q8_24 got = 0;
        gn_status status = gn_tangent(&got, angle);
        long double expected = ldexpl(tanl(radians(angle)), 24);
        long double error = fabsl(got - expected), bound = 0.52L + expected * powl(2, -23.8L);
        worst = fmaxl(worst, error / bound);
        if (status != GN_OK || !(error <= bound))
            show(&failures, "gn_tangent", angle, got, expected);
    }
    note("largest error of the tangent: %.4Lf of its bound", worst);
    ok(!failures, "the tangent is within 0.52 / 2^24 and 2^-23.8 of itself, in %llu cases", (unsigned long long)cases);
}

static void tangent_refuses_other_angles(void)
{
    static const gn_angle outside[] = {
        0,         1, GN_DEGREES(1) / 4 - 1, GN_DEGREES(178) / 2 + 1, GN_DEGREES(90), GN_DEGREES(180), GN_DEGREES(225),
        UINT32_MAX};
    for (unsigned i = 0; i < sizeof outside / sizeof outside[0]; i++) {
        gn_q8_24 tangent = 12345;
        gn_status status = gn_tangent(&tangent, outside[i]);
        if (!ok(status == GN_OUT_OF_RANGE && tangent == 12345, "no tangent of the angle 0x%08lx, nothing written",
                (unsigned long)outside[i]))
            note("got status %d, value %lu", (int)status, (unsigned long)tangent);
    }
}

int main(int argc, char **argv)
{
    uint64_t cases = tap_cases(argc, argv, 2000000);
    sine_and_cosine_keep_their_bound(cases);
    symmetries_are_exact(cases);
    quarter_turns_are_exact();
    degrees_are_rounded_to_nearest();
    tangent_keeps_its_bound(cases);
    tangent_refuses_other_angles();
    return tap_done();
}
