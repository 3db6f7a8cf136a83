#include "automatic_trial.h"

#include "automatic_cost.h"
#include "choices.h"
#include "frame.h"
#include "memory.h"
#include "warp_report.h"

#include <stdlib.h>
#include <string.h>

enum { LIT_FROM = 127, NO_SURFACE = 255 };

int automatic_trial_open(automatic_trial *t, const packed_scene *packed, const automatic_scene *scene,
                         const gn_settings *base, int workers, problem *why)
{
    memset(t, 0, sizeof *t);
    t->packed = packed;
    t->scene = scene;
    t->base = *base;
    return truth_make(&t->truth, packed, base->width, base->height, workers, 0, why);
}

void automatic_trial_close(automatic_trial *t)
{
    truth_free(&t->truth);
    free(t->results);
    memset(t, 0, sizeof *t);
}

static uint64_t count_wrong(const uint8_t *mask, const truth *exact)
{
    size_t pixels = (size_t)exact->width * exact->height;
    uint64_t wrong = 0;
    for (size_t i = 0; i < pixels; i++)
        wrong += mask[i] != NO_SURFACE && exact->mask[i] != NO_SURFACE &&
                 (mask[i] >= LIT_FROM) != (exact->mask[i] >= LIT_FROM);
    return wrong;
}

static int run_passes(frame *f, const packed_scene *packed, double *share, problem *why)
{
    uint32_t place[1][2] = {{0, 0}};
    if (frame_view_pass(f, &packed->camera, &packed->light, why) || frame_light_pass(f, &packed->light, why) ||
        frame_camera_pass(f, &packed->camera, why))
        return -1;
    if (share && choices_use_view(&f->settings))
        *share = warp_report_make(&f->rectangle, &packed->light, place, 1, 1).share;
    return 0;
}

/* Regions as a firmware has them. Each sets up anew what crosses it, above all the sides of volumes, of which the
 * simulator would have one region. */
static void use_small_regions(gn_settings *settings, const packed_scene *packed)
{
    gn_plan plan;
    if (gn_make_plan(&plan, &packed->scene, settings) != GN_OK)
        return; /* frame_open says what is wrong */
    settings->region_width = plan.region_width;
    settings->region_height = plan.region_height;
}

int automatic_render(const automatic_candidate *candidate, const packed_scene *packed, const gn_settings *base,
                     const truth *exact, automatic_result *result, double *share, problem *why)
{
    frame f;
    gn_settings settings = automatic_settings(candidate, base);
    settings.mask = 1;
    settings.format = GN_NO_COLOUR;
    use_small_regions(&settings, packed);
    int failed = frame_open(&f, &packed->scene, &settings, 0, why) || run_passes(&f, packed, share, why);
    if (!failed) {
        gn_get_statistics(f.context, &result->statistics);
        result->wrong = exact ? count_wrong(f.mask, exact) : 0;
        result->cost = automatic_cost(&f.settings, &f.plan, &result->statistics, packed->light.kind);
    }
    frame_close(&f);
    return failed ? -1 : 0;
}

static int is_same(const automatic_candidate *a, const automatic_candidate *b)
{
    return a->surface == b->surface && a->test == b->test && a->placement == b->placement && a->width == b->width &&
           a->height == b->height;
}

long automatic_try(automatic_trial *t, const automatic_candidate *candidate, problem *why)
{
    for (size_t i = 0; i < t->count; i++)
        if (is_same(&t->results[i].candidate, candidate))
            return (long)i;
    automatic_result result = {.candidate = *candidate};
    if (automatic_render(candidate, t->packed, &t->base, &t->truth, &result, 0, why))
        return -1;
    result.bytes = automatic_bytes(candidate, t->packed, &t->base);
    result.error = t->truth.surface ? 100.0 * (double)result.wrong / (double)t->truth.surface : 0;
    result.expected = automatic_expected_error(candidate, t->scene);
    t->results = memory_grow(t->results, &t->capacity, t->count + 1, sizeof *t->results);
    t->results[t->count] = result;
    return (long)t->count++;
}
