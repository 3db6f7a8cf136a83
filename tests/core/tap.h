/* Test Anything Protocol, as little as prove needs: ok() once a promise, note() for what went wrong, and
 * `return tap_done();` at the end of main. A test's random numbers come from a fixed seed: the same command runs the
 * same cases.
 *
 * Counts: the environment's GNOMON_CASES, else the program's first argument, else what the test asks for, or a fifth of
 * that in the build that looks for mistakes: it takes five times as long, and one case of a kind shows them. With
 * TAP_STOP in the environment the first broken promise is the last one tried. */
#ifndef TAP_H
#define TAP_H

#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

#if defined __GNUC__
#define TAP_PRINTF(text, first) __attribute__((format(printf, text, first), unused))
#define TAP_UNUSED __attribute__((unused))
#else
#define TAP_PRINTF(text, first)
#define TAP_UNUSED
#endif

/* How much slower the build that looks for mistakes is. */
#if defined __SANITIZE_ADDRESS__ || (defined GN_CHECKED && GN_CHECKED)
enum { TAP_SLOWER = 5 };
#else
enum { TAP_SLOWER = 1 };
#endif

static unsigned tap_tests, tap_failures;

/* Report one promise under its name. Returns condition. */
static TAP_PRINTF(2, 3) int ok(int condition, const char *name, ...)
{
    va_list arguments;
    tap_tests++;
    tap_failures += !condition;
    printf("%s %u - ", condition ? "ok" : "not ok", tap_tests);
    va_start(arguments, name);
    vprintf(name, arguments);
    va_end(arguments);
    printf("\n");
    fflush(stdout);
    if (!condition && getenv("TAP_STOP"))
        exit(1);
    return condition;
}

/* Print a diagnostic line. */
static TAP_PRINTF(1, 2) void note(const char *format, ...)
{
    va_list arguments;
    printf("# ");
    va_start(arguments, format);
    vprintf(format, arguments);
    va_end(arguments);
    printf("\n");
}

/* Print the plan; the program's exit status. */
static TAP_UNUSED int tap_done(void)
{
    printf("1..%u\n", tap_tests);
    if (tap_failures)
        note("%u of %u failed", tap_failures, tap_tests);
    return tap_failures != 0;
}

/* How many random cases to run. */
static TAP_UNUSED uint64_t tap_cases(int argc, char **argv, uint64_t otherwise)
{
    const char *text = getenv("GNOMON_CASES");
    if (!text && argc > 1)
        text = argv[1];
    return text && *text ? strtoull(text, 0, 10) : (otherwise + TAP_SLOWER - 1) / TAP_SLOWER;
}

/* splitmix64 (Steele, Lea & Flood 2014): 64 random bits. */
static TAP_UNUSED uint64_t tap_random(uint64_t *state)
{
    uint64_t z = *state += UINT64_C(0x9e3779b97f4a7c15);
    z = (z ^ (z >> 30)) * UINT64_C(0xbf58476d1ce4e5b9);
    z = (z ^ (z >> 27)) * UINT64_C(0x94d049bb133111eb);
    return z ^ (z >> 31);
}

#endif
