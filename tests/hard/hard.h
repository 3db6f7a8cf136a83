/* The hard cases: scenes that are known to break shadow maps, each with an outcome that was worked out by hand.
 *
 * A case is a scene in memory (builder.h). Its truth (host/truth.h) is checked first against arithmetic done by hand,
 * where the case has a closed form of its shadow, and against a second ray caster (footprint.h). Then every method
 * renders it. A pixel that is wrong, is not near a tie of the truth, and is not explained by the texel (footprint.h) is
 * an error of the method's own: of these each case says how many there must be, from geometry, never from what the
 * program gave. Where nothing is said there must be none.
 *
 * The same cases make the table of docs/stability.md and its pictures.
 */
#ifndef HARD_H
#define HARD_H

#include "builder.h"
#include "comparison.h"
#include "footprint.h"
#include "frame.h"
#include "truth.h"

#define COUNT(array) (sizeof(array) / sizeof *(array))

/* What a case is rendered with: columns of the table. Those up to COLUMN_VOLUMES every case has; those with virtual
 * samples and their rivals only where the case is about what they change (WITH_RECEIVERS). Every case that has a scene
 * is rendered with silhouettes and crossings as well, over mixed and virtual samples (check_borders). */
enum column {
    COLUMN_CONSTANT,
    COLUMN_MIDPOINT,
    COLUMN_DUAL,
    COLUMN_SECOND,
    COLUMN_MIXED,
    COLUMN_AUTO,
    COLUMN_VOLUMES,
    COLUMN_SECOND_VIRTUAL,
    COLUMN_MIXED_VIRTUAL,
    COLUMN_ADAPTIVE,
    COLUMN_SLOPE,
    COLUMN_PLANE_BIAS,
    COLUMN_FILTER,      /* auto, 5 x 5 texels */
    COLUMN_SILHOUETTES, /* mixed, virtual samples, silhouettes */
    COLUMN_CROSSINGS,   /* the same with crossings */
    COLUMN_ALL,
    COLUMN_COUNT = COLUMN_SECOND_VIRTUAL,     /* of those that every case has */
    COLUMN_RECEIVERS_END = COLUMN_SILHOUETTES /* of those of WITH_RECEIVERS */
};

enum { FILTER_RADIUS = 2 };

extern const char *const method_names[COLUMN_ALL];

/* Own errors in per cent of the pixels that see a surface, at least and at most; all zero: none. Of volumes: errors of
 * any kind that are not near a tie. */
typedef struct expectation {
    double shadow_least, shadow_most, light_least, light_most;
    const char *unmet; /* why the promise does not hold today; 0: it must */
} expectation;

/* Nothing is derived for this method. */
#define ANYTHING                                                                                                       \
    {                                                                                                                  \
        0, 100, 0, 100, 0                                                                                              \
    }
#define SHADOW(least, most)                                                                                            \
    {                                                                                                                  \
        least, most, 0, 0, 0                                                                                           \
    }
#define LIGHT(least, most)                                                                                             \
    {                                                                                                                  \
        0, 0, least, most, 0                                                                                           \
    }

typedef struct outcome {
    int ran; /* 0: the method does not exist yet, or the core refused */
    int met;
    char refusal[160];
    uint8_t *mask;
    uint64_t false_shadow, false_light, own_shadow, own_light, coverage; /* pixels; coverage: not near a tie */
    double shadow_percent, light_percent; /* false shadow and light, of the pixels that see a surface */
} outcome;

struct hard_case;

typedef struct hard_row {
    const struct hard_case *about;
    packed_scene packed;
    footprint footprint;
    truth truth;
    double unit; /* world integers a metre */
    int32_t origin[3];
    uint8_t *near; /* near a tie, or on one */
    outcome outcomes[COLUMN_ALL];
    int met, unmet;   /* promises kept and broken */
    char remark[400]; /* figures of this run for the table */
} hard_row;

enum { BY_HAND_SHADOWED = 0, BY_HAND_LIT = 254, BY_HAND_UNSAID = 1 };

/* Arithmetic done by hand: is a value strictly within a range, what a point is. */
static inline int in(double value, double low, double high)
{
    return value > low && value < high;
}

static inline int lit_unless(int shadowed)
{
    return shadowed ? BY_HAND_SHADOWED : BY_HAND_LIT;
}

/* Flags of a case. */
enum {
    NO_SHADOW = 1,      /* truly no shadowed pixel: `expected` says why */
    NO_LIGHT = 2,       /* truly no lit pixel */
    LONG = 4,           /* not in the short list that the slower builds run */
    CULL_BACK = 8,      /* midpoint: with back faces culled */
    CULL_NONE = 16,     /* dual: without culling */
    COUNT_TIES = 32,    /* pixels on an exact tie of the truth count as well: the case is about them */
    WITH_RECEIVERS = 64 /* run the columns up to COLUMN_RECEIVERS_END, too */
};

typedef struct hard_case {
    const char *name; /* of the TAP lines and files */
    const char *group, *source;
    const char *title, *expected, *advice; /* of the table */
    void (*build)(builder *b);
    int (*by_hand)(const double point[3]); /* metres -> BY_HAND_...: from a closed form */
    void (*check)(hard_row *row);          /* promises beyond those of the methods */
    void (*run)(hard_row *row);            /* in place of build: a sweep that fills the row itself */
    unsigned flags;
    int picture;           /* method of the picture, + 1; 0: none */
    const char *receivers; /* WITH_RECEIVERS: what is expected of those columns */
    double worse; /* check_borders: per cent that silhouettes and crossings may err more than without; 0: as derived */
    expectation methods[COLUMN_RECEIVERS_END];
} hard_case;

typedef struct hard_list {
    const hard_case *cases;
    size_t count;
} hard_list;

extern const hard_list papers_cases, light_cases, geometry_cases, silhouette_cases, number_cases, file_cases,
    sweep_cases;

/* Count a promise, and report it as a line of TAP unless a table is being made. reason: not 0 where it is known not to
 * hold: then it is a TODO. Returns condition. */
int promise(hard_row *row, int condition, const char *reason, const char *name, ...)
    __attribute__((format(printf, 4, 5)));

/* A diagnostic line after a promise that was broken. */
void say(const char *format, ...) __attribute__((format(printf, 1, 2)));

/* Is this the short list, for builds that run ten times slower? */
int hard_is_short(void);

/* ---- measuring (measure.c) --------------------------------------------------------------------------------------- */

/* The settings of a column for a scene: those of `gnomon render --method`, with the case's own bias where it is in
 * texels. Mask on, no colour. */
gn_settings method_settings(const packed_scene *packed, int method, unsigned flags);

/* Render; the mask (width x height) is on the heap. 0, or -1 and the problem. colour: not 0: the colours, 3 bytes a
 * pixel. */
int method_render(packed_scene *packed, const gn_settings *settings, uint8_t **mask, uint8_t **colour, problem *why);

/* Compare o->mask, which the method gave, with the row's truth. Of a filter every pixel counts as wrong that is not
 * wholly lit or wholly shadowed as in the truth, and as its own where the truth is the same at all centres it weighs.
 * Silhouettes and crossings choose among the four texels about a point: their own is what is wrong where the truth is
 * the same at all centres within a texel. */
void measure(hard_row *row, outcome *o, int method);

double percent_of(const hard_row *row, uint64_t count);

/* Build the scene, make the truth and check it. 0, or -1: a promise was broken, nothing can be measured. */
int row_begin(hard_row *row, void (*build)(builder *b), int with_near);

/* The same of the scene that row->packed, row->unit and row->origin hold already. with_checks: check the truth. */
int row_begin_packed(hard_row *row, int with_near, int with_checks);

/* Render with one method and measure. */
void row_measure(hard_row *row, int method, const gn_settings *settings);

/* Free what an outcome holds, and clear it. */
void row_forget(outcome *o);

/* Add figures to what the table says is expected. */
void row_remark(hard_row *row, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* Free the scene, the truth and the masks; figures stay. */
void row_end(hard_row *row);

#endif
