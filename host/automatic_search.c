#include "automatic_search.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Where no bytes are named: 2048 x 2048 texels with silhouettes. */
#define MOST_BYTES ((uint64_t)2048 * 2048 * (sizeof(gn_depth) + 1))

/* What is tried first: a pair of test and placement from which the tables expect at most this many times the least
 * error, and at most so many. */
#define WORTH_A_TRIAL 2.5
enum { MOST_FIRST = 14, COMBINATIONS = AUTOMATIC_TESTS * AUTOMATIC_MEASURED_PLACEMENTS, MOST_ROUNDS = 3, LEADERS = 4 };

/* Maps with fewer texels a side are of no use where shadow volumes fit. */
enum { LEAST_SIDE = 16 };

/* Bytes are found to this ratio. */
#define FINENESS 1.03

/* So much less is searched anew; so many times the errors are hardly more. */
#define LESS 0.8
#define HARDLY_MORE 1.25

typedef struct search {
    automatic_trial *t;
    automatic_budget budget;
    problem *why;
    int failed;
} search;

/* ---- which is better ------------------------------------------------------------------------------------------- */

static int keeps(const automatic_budget *b, const automatic_result *r)
{
    return (!b->bytes || r->bytes <= b->bytes) && (b->error < 0 || r->error <= b->error);
}

static int by_number(double a, double b)
{
    return a < b ? -1 : a > b;
}

int automatic_compare(const automatic_budget *budget, const automatic_result *a, const automatic_result *b)
{
    int a_keeps = keeps(budget, a), b_keeps = keeps(budget, b);
    int by_error = by_number(a->error, b->error), by_cost = by_number(a->cost, b->cost),
        by_bytes = by_number((double)a->bytes, (double)b->bytes);
    if (a_keeps != b_keeps)
        return b_keeps - a_keeps;
    if (!a_keeps || budget->error < 0)
        return by_error ? by_error : by_cost ? by_cost : by_bytes;
    if (!budget->bytes)
        return by_bytes ? by_bytes : by_cost ? by_cost : by_error;
    return by_cost ? by_cost : by_bytes ? by_bytes : by_error;
}

static int is_other(const automatic_candidate *a, const automatic_candidate *b)
{
    return a->test != b->test || a->placement != b->placement;
}

static void choose(automatic_choice *choice, const automatic_budget *budget, const automatic_result *results,
                   size_t count)
{
    size_t best = 0;
    memset(choice, 0, sizeof *choice);
    for (size_t i = 1; i < count; i++)
        if (automatic_compare(budget, &results[i], &results[best]) < 0)
            best = i;
    choice->taken = results[best];
    choice->keeps = keeps(budget, &results[best]);
    choice->tried = count;
    for (size_t i = 0; i < count; i++)
        if (is_other(&results[i].candidate, &choice->taken.candidate) &&
            (!choice->has_next || automatic_compare(budget, &results[i], &choice->next) < 0)) {
            choice->next = results[i];
            choice->has_next = 1;
        }
}

/* ---- trials ---------------------------------------------------------------------------------------------------- */

/* One layer where solids alone cast. Whether flat meshes cast is seen in a trial; without one they are taken to. */
static uint8_t usual_surface(const automatic_scene *scene, int is_tried)
{
    return automatic_surface_suits(AUTOMATIC_SECOND, scene) && (is_tried || !scene->flat) ? AUTOMATIC_SECOND
                                                                                          : AUTOMATIC_MIXED;
}

/* The candidate at its map's largest size of that shape; a point light's maps are square. Its error; HUGE_VAL where it
 * is not tried. */
static double try_at(search *s, automatic_candidate candidate, int shape, uint64_t bytes)
{
    if (s->failed || shape < 0 || shape >= AUTOMATIC_SHAPES ||
        (s->t->scene->light == GN_POINT && shape != AUTOMATIC_SQUARE) ||
        !automatic_placement_suits(candidate.placement, s->t->scene) ||
        !automatic_surface_suits(candidate.surface, s->t->scene) ||
        !automatic_fill(&candidate, shape, bytes, s->t->packed, &s->t->base))
        return HUGE_VAL;
    long number = automatic_try(s->t, &candidate, s->why);
    s->failed = number < 0;
    return s->failed ? HUGE_VAL : s->t->results[number].error;
}

static int shape_of(const automatic_candidate *candidate)
{
    int best = AUTOMATIC_SQUARE;
    double wanted = log2((double)candidate->width / candidate->height), off = 100;
    for (int shape = 0; shape < AUTOMATIC_SHAPES; shape++) {
        double distance = fabs(automatic_shape(shape) - wanted);
        if (distance < off) {
            off = distance;
            best = shape;
        }
    }
    return best;
}

/* Of all results within these bytes the one that errs least. */
static const automatic_result *least_error(const search *s, uint64_t bytes)
{
    const automatic_budget within = {bytes, -1};
    const automatic_result *best = 0;
    for (size_t i = 0; i < s->t->count; i++) {
        const automatic_result *r = &s->t->results[i];
        if (r->bytes <= bytes && (!best || automatic_compare(&within, r, best) < 0))
            best = r;
    }
    return best;
}

typedef struct prospect {
    automatic_candidate candidate;
    double expected;
} prospect;

static int by_expected(const void *a, const void *b)
{
    const prospect *p = a, *q = b;
    int order = by_number(p->expected, q->expected);
    return order ? order : memcmp(&p->candidate, &q->candidate, sizeof p->candidate);
}

/* Pairs of test and placement at these bytes, the best expected first. */
static int list_prospects(prospect list[COMBINATIONS], const automatic_scene *scene, const packed_scene *packed,
                          const gn_settings *base, int is_tried, uint64_t bytes)
{
    int count = 0;
    for (int i = 0; i < COMBINATIONS; i++) {
        prospect p;
        memset(&p, 0, sizeof p);
        p.candidate.surface = usual_surface(scene, is_tried);
        p.candidate.test = (uint8_t)(i / AUTOMATIC_MEASURED_PLACEMENTS);
        p.candidate.placement = (uint8_t)(i % AUTOMATIC_MEASURED_PLACEMENTS);
        if (!automatic_placement_suits(p.candidate.placement, scene) ||
            !automatic_fill(&p.candidate, AUTOMATIC_SQUARE, bytes, packed, base))
            continue;
        p.expected = automatic_expected_error(&p.candidate, scene);
        list[count++] = p;
    }
    qsort(list, (size_t)count, sizeof *list, by_expected);
    return count;
}

/* ---- least error within bytes ---------------------------------------------------------------------------------- */

/* The smallest map of all: enough where nothing casts a shadow that is seen, or nothing is lit. */
static void try_least(search *s)
{
    automatic_candidate least = {AUTOMATIC_NEAREST, AUTOMATIC_POINT, AUTOMATIC_UNIFORM, 1, 1};
    try_at(s, least, AUTOMATIC_SQUARE, automatic_least_bytes(s->t->packed, &s->t->base));
}

static void try_prospects(search *s, uint64_t bytes, int most)
{
    prospect list[COMBINATIONS];
    int count = list_prospects(list, s->t->scene, s->t->packed, &s->t->base, 1, bytes);
    for (int i = 0; i < count && i < most && list[i].expected <= WORTH_A_TRIAL * list[0].expected; i++)
        try_at(s, list[i].candidate, AUTOMATIC_SQUARE, bytes);
}

/* Candidates of the results within these bytes that come first by the order of `budget`, each kind once. */
static int list_leaders(const search *s, const automatic_budget *budget, automatic_candidate leaders[LEADERS])
{
    int count = 0;
    for (; count < LEADERS; count++) {
        const automatic_result *best = 0;
        for (size_t i = 0; i < s->t->count; i++) {
            const automatic_result *r = &s->t->results[i];
            int is_new = keeps(budget, r);
            for (int k = 0; k < count; k++)
                is_new = is_new && is_other(&r->candidate, &leaders[k]);
            if (is_new && (!best || automatic_compare(budget, r, best) < 0))
                best = r;
        }
        if (!best)
            return count;
        leaders[count] = best->candidate;
    }
    return count;
}

/* Change one choice of the best at a time. */
static void vary_surface(search *s, uint64_t bytes)
{
    automatic_candidate best = least_error(s, bytes)->candidate, c = best;
    for (c.surface = 0; c.surface < AUTOMATIC_SURFACES; c.surface++)
        try_at(s, c, shape_of(&best), bytes);
}

static void vary_test(search *s, uint64_t bytes)
{
    automatic_candidate best = least_error(s, bytes)->candidate, c = best;
    for (c.test = AUTOMATIC_SILHOUETTE; c.test < AUTOMATIC_TESTS; c.test++)
        try_at(s, c, shape_of(&best), bytes);
}

static void vary_placement(search *s, uint64_t bytes)
{
    automatic_candidate best = least_error(s, bytes)->candidate, c = best;
    for (c.placement = 0; c.placement < AUTOMATIC_PLACEMENTS; c.placement++)
        try_at(s, c, shape_of(&best), bytes);
}

static void vary_shape(search *s, uint64_t bytes)
{
    automatic_candidate best = least_error(s, bytes)->candidate;
    for (int shape = shape_of(&best) - 2; shape <= shape_of(&best) + 2; shape++)
        try_at(s, best, shape, bytes);
}

/* All shapes of the two best: errors over the shape have more than one valley, and it changes them most. */
static void try_shapes(search *s, uint64_t bytes)
{
    enum { STARTS = 2 };
    const automatic_budget within = {bytes, -1};
    automatic_candidate leaders[LEADERS];
    int count = list_leaders(s, &within, leaders);
    for (int i = 0; i < count && i < STARTS; i++)
        for (int shape = 0; shape < AUTOMATIC_SHAPES; shape++)
            try_at(s, leaders[i], shape, bytes);
}

static void search_bytes(search *s, uint64_t bytes, int most_first)
{
    uint64_t before = UINT64_MAX;
    try_prospects(s, bytes, most_first);
    try_shapes(s, bytes);
    for (int round = 0; round < MOST_ROUNDS && !s->failed && least_error(s, bytes)->wrong < before; round++) {
        before = least_error(s, bytes)->wrong;
        if (!before)
            return;
        vary_surface(s, bytes);
        vary_test(s, bytes);
        vary_shape(s, bytes);
        vary_placement(s, bytes);
    }
}

/* Where errors no longer fall with the size of the map, a smaller one may serve better: as long as the best at half the
 * bytes errs hardly more. */
static void search_smaller(search *s, uint64_t bytes)
{
    while (!s->failed && bytes > 2 * automatic_least_bytes(s->t->packed, &s->t->base)) {
        automatic_result best = *least_error(s, bytes);
        bytes /= 2;
        try_at(s, best.candidate, shape_of(&best.candidate), bytes);
        if (s->failed || (double)least_error(s, bytes)->wrong > HARDLY_MORE * (double)best.wrong)
            return;
        search_bytes(s, bytes, MOST_FIRST);
    }
}

/* Less than search_bytes, where only the size matters. */
static void look_around(search *s, uint64_t bytes)
{
    enum { FEW = 4 };
    try_prospects(s, bytes, FEW);
    if (!s->failed && least_error(s, bytes)) {
        vary_shape(s, bytes);
        vary_test(s, bytes);
    }
}

/* ---- fewest bytes within an error ------------------------------------------------------------------------------ */

static int meets(const search *s, uint64_t bytes)
{
    const automatic_result *best = least_error(s, bytes);
    return best && best->error <= s->budget.error;
}

/* Between `low` bytes, with which the candidates do not meet the error, and `high`, with which one does: the fewest
 * with which one does. */
static uint64_t shrink(search *s, uint64_t low, uint64_t high, const automatic_candidate candidates[], int count)
{
    while (!s->failed && (double)high > FINENESS * (double)low) {
        uint64_t middle = (uint64_t)sqrt((double)low * (double)high);
        double error = HUGE_VAL;
        if (middle <= low)
            break;
        for (int i = 0; i < count; i++)
            error = fmin(error, try_at(s, candidates[i], shape_of(&candidates[i]), middle));
        if (error <= s->budget.error)
            high = middle;
        else
            low = middle;
    }
    return high;
}

static uint64_t shrink_leaders(search *s, uint64_t low, uint64_t high)
{
    const automatic_budget within = {high, -1};
    automatic_candidate leaders[LEADERS];
    return shrink(s, low, high, leaders, list_leaders(s, &within, leaders));
}

/* Where the tables expect the error: the least of all pairs. */
static uint64_t expected_bytes(const search *s)
{
    prospect list[COMBINATIONS];
    uint64_t bytes = 1024;
    while (bytes < MOST_BYTES && list_prospects(list, s->t->scene, s->t->packed, &s->t->base, 1, bytes) &&
           list[0].expected > s->budget.error)
        bytes *= 2;
    return bytes < MOST_BYTES ? bytes : MOST_BYTES;
}

/* From sizes on either side of the error to the one between them. There the best may be others: until a fifth less is
 * too little for all. */
static void search_error(search *s)
{
    enum { STEP = 4, FEW = 6 };
    uint64_t least = automatic_least_bytes(s->t->packed, &s->t->base), high = expected_bytes(s), low = high;
    look_around(s, high);
    for (; !s->failed && !meets(s, high) && high < MOST_BYTES; look_around(s, high)) {
        low = high;
        high = high * STEP < MOST_BYTES ? high * STEP : MOST_BYTES;
    }
    while (!s->failed && meets(s, low) && low > least) {
        high = low;
        low = low / STEP > least ? low / STEP : least;
        look_around(s, low);
    }
    if (s->failed || !meets(s, high))
        return;
    high = shrink_leaders(s, low, high);
    uint64_t less = high;
    while (!s->failed && meets(s, less) && less > least) {
        high = less;
        less = (uint64_t)(LESS * (double)high);
        search_bytes(s, less, FEW);
    }
    shrink_leaders(s, less, high);
}

/* ---- cheapest within both -------------------------------------------------------------------------------------- */

/* Every pair of test and placement in maps of this shape. */
static void try_all(search *s, int shape)
{
    for (int i = 0; i < COMBINATIONS; i++) {
        automatic_candidate c = {usual_surface(s->t->scene, 1), (uint8_t)(i / AUTOMATIC_MEASURED_PLACEMENTS),
                                 (uint8_t)(i % AUTOMATIC_MEASURED_PLACEMENTS), 0, 0};
        try_at(s, c, shape, s->budget.bytes);
        c.surface = AUTOMATIC_NEAREST;
        if (c.test == AUTOMATIC_POINT)
            try_at(s, c, shape, s->budget.bytes);
    }
}

/* Everything once at the largest size, then the cheapest of what keeps the budgets with other surfaces and with smaller
 * maps. */
static void search_cost(search *s)
{
    uint64_t most = s->budget.bytes, low = automatic_least_bytes(s->t->packed, &s->t->base);
    automatic_candidate leaders[LEADERS];
    try_all(s, AUTOMATIC_SQUARE);
    if (s->failed)
        return;
    vary_shape(s, most);
    try_all(s, shape_of(&least_error(s, most)->candidate));
    if (!meets(s, most))
        search_bytes(s, most, MOST_FIRST);
    int count = s->failed ? 0 : list_leaders(s, &s->budget, leaders);
    for (int i = 0; i < count; i++) {
        automatic_candidate c = leaders[i];
        for (c.surface = 0; c.surface < AUTOMATIC_SURFACES; c.surface++)
            try_at(s, c, shape_of(&leaders[i]), most);
    }
    count = s->failed ? 0 : list_leaders(s, &s->budget, leaders);
    for (int i = 0; i < count; i++)
        shrink(s, low, most, &leaders[i], 1);
}

/* ---- the search ------------------------------------------------------------------------------------------------ */

uint64_t automatic_least_bytes(const packed_scene *packed, const gn_settings *base)
{
    automatic_candidate least = {AUTOMATIC_NEAREST, AUTOMATIC_POINT, AUTOMATIC_UNIFORM, 1, 1};
    while (least.width < GN_MAX_SIZE && !automatic_bytes(&least, packed, base))
        least.height = ++least.width;
    return automatic_bytes(&least, packed, base);
}

static const automatic_candidate volumes = {0, 0, 0, 0, 0};

/* Shadow volumes are exact, and have no map: for where no map keeps the budgets, or none of use fits. */
static int are_volumes_due(const automatic_choice *so_far, const automatic_scene *scene, const packed_scene *packed,
                           const gn_settings *base, const automatic_budget *budget)
{
    automatic_candidate largest = {usual_surface(scene, 1), AUTOMATIC_VIRTUAL, AUTOMATIC_UNIFORM, 0, 0};
    uint64_t bytes = scene->light == GN_POINT ? 0 : automatic_bytes(&volumes, packed, base);
    if (!bytes || (budget->bytes && bytes > budget->bytes) || so_far->taken.error == 0)
        return 0;
    int is_of_use = !budget->bytes || (automatic_fill(&largest, AUTOMATIC_SQUARE, budget->bytes, packed, base) &&
                                       largest.width >= LEAST_SIDE);
    return !so_far->keeps || !is_of_use;
}

static int refuse_bytes(const automatic_budget *budget, uint64_t least, problem *why)
{
    if (!budget->bytes || budget->bytes >= least)
        return 0;
    return problem_of_usage(why, "--budget-bytes %llu, less than any map; expected %llu or more",
                            (unsigned long long)budget->bytes, (unsigned long long)least);
}

int automatic_search(automatic_choice *choice, automatic_trial *trial, const automatic_budget *budget, problem *why)
{
    search s = {.t = trial, .budget = *budget, .why = why};
    if (refuse_bytes(budget, automatic_least_bytes(trial->packed, &trial->base), why))
        return -1;
    try_least(&s);
    if (s.failed)
        return -1;
    if (!trial->count)
        return problem_of_usage(why, "the core refuses every map of the scene; expected one that it takes");
    if (trial->results[0].wrong) {
        if (!budget->bytes)
            search_error(&s);
        else if (budget->error >= 0)
            search_cost(&s);
        else {
            search_bytes(&s, budget->bytes, MOST_FIRST);
            search_smaller(&s, budget->bytes);
        }
    }
    choose(choice, budget, trial->results, trial->count);
    if (!s.failed && are_volumes_due(choice, trial->scene, trial->packed, &trial->base, budget)) {
        s.failed = automatic_try(trial, &volumes, why) < 0;
        choose(choice, budget, trial->results, trial->count);
    }
    return s.failed ? -1 : 0;
}

/* ---- by the tables alone --------------------------------------------------------------------------------------- */

/* The smallest map from which the tables expect no more than the error; the candidate as it is where none is smaller.
 */
static void shrink_to(automatic_candidate *candidate, double error, const automatic_scene *scene, uint64_t high,
                      const packed_scene *packed, const gn_settings *base)
{
    uint64_t low = 1;
    while (high - low > 1 && (double)high > FINENESS * (double)low) {
        uint64_t middle = (uint64_t)sqrt((double)low * (double)high);
        automatic_candidate c = *candidate;
        if (middle <= low)
            return;
        if (automatic_fill(&c, AUTOMATIC_SQUARE, middle, packed, base) &&
            automatic_expected_error(&c, scene) <= error) {
            *candidate = c;
            high = middle;
        } else
            low = middle;
    }
}

int automatic_guess(automatic_choice *choice, const automatic_scene *scene, const packed_scene *packed,
                    const gn_settings *base, const automatic_budget *budget, problem *why)
{
    uint64_t most = budget->bytes ? budget->bytes : MOST_BYTES;
    prospect list[COMBINATIONS];
    automatic_result results[COMBINATIONS];
    if (refuse_bytes(budget, automatic_least_bytes(packed, base), why))
        return -1;
    int count = list_prospects(list, scene, packed, base, 0, most);
    memset(results, 0, sizeof results);
    for (int i = 0; i < count; i++) {
        automatic_result *r = &results[i];
        r->candidate = list[i].candidate;
        if (budget->error >= 0)
            shrink_to(&r->candidate, budget->error, scene, most, packed, base);
        r->bytes = automatic_bytes(&r->candidate, packed, base);
        r->error = r->expected = automatic_expected_error(&r->candidate, scene);
        r->cost = automatic_expected_cost(&r->candidate);
    }
    if (!count)
        return problem_of_usage(why, "--budget-bytes %llu, less than any map that the tables know; expected more",
                                (unsigned long long)budget->bytes);
    choose(choice, budget, results, (size_t)count);
    choice->tried = 0;
    if (are_volumes_due(choice, scene, packed, base, budget)) {
        choice->taken = (automatic_result){.candidate = volumes, .bytes = automatic_bytes(&volumes, packed, base)};
        choice->keeps = 1;
    }
    return 0;
}
