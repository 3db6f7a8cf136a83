#include "sweep_bias.h"

#include <math.h>

/* Biases count in eighths of an octave from 1 texel. */
enum { OCTAVE = 8, FIRST = -3 * OCTAVE, LAST = 5 * OCTAVE, LEAST = -10 * OCTAVE, MOST = 12 * OCTAVE };

typedef struct search {
    sweep_bias_try measure;
    void *user;
    problem *why;
    int best;
    double wrong; /* of the best */
    int failed;
} search;

static double texels_of(int eighths)
{
    return exp2(eighths / (double)OCTAVE);
}

/* 1: better than all before. */
static int try_bias(search *s, int eighths)
{
    double wrong;
    if (s->failed || s->measure(s->user, texels_of(eighths), &wrong, s->why)) {
        s->failed = 1;
        return 0;
    }
    if (wrong > s->wrong || (wrong == s->wrong && eighths > s->best))
        return 0;
    s->best = eighths;
    s->wrong = wrong;
    return 1;
}

int sweep_bias_search(double *texels, sweep_bias_try measure, void *user, problem *why)
{
    search s = {.measure = measure, .user = user, .why = why, .wrong = HUGE_VAL};
    for (int at = FIRST; at <= LAST; at += OCTAVE)
        try_bias(&s, at);
    for (int at = FIRST - OCTAVE; s.best == at + OCTAVE && at >= LEAST; at -= OCTAVE)
        try_bias(&s, at);
    for (int at = LAST + OCTAVE; s.best == at - OCTAVE && at <= MOST; at += OCTAVE)
        try_bias(&s, at);
    for (int step = OCTAVE / 2; step; step /= 2) {
        int middle = s.best;
        try_bias(&s, middle - step);
        try_bias(&s, middle + step);
    }
    *texels = texels_of(s.best);
    return s.failed ? -1 : 0;
}
