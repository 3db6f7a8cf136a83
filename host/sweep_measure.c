#include "sweep_measure.h"

#include "comparison.h"
#include "cost_model.h"
#include "lane.h"
#include "sweep_bias.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct measurement {
    sweep_cell *cell;
    const sweep_scene *scene;
    const char *image_text;
    sweep_choice choice;
    problem *why;
} measurement;

/* ---- errors ---------------------------------------------------------------------------------------------------- */

static comparison compare(const sweep_scene *scene, const uint8_t *mask)
{
    comparison_input input = {scene->width, scene->height, mask, scene->truth, 0, COMPARISON_EDGE_BAND};
    comparison c;
    comparison_make(&c, &input);
    return c;
}

/* Nothing is wrong about nothing: without a surface the columns stay empty. */
static void fill_errors(sweep_row *row, const comparison *c)
{
    const comparison_figures *f = &c->all;
    if (!f->surface)
        return;
    row->false_shadow = comparison_percent(f, f->false_shadow.pixels);
    row->false_light = comparison_percent(f, f->false_light.pixels);
    row->error = comparison_percent(f, f->together.pixels);
    row->edge_band = comparison_percent(f, f->together.in_edge_band);
    row->interior = comparison_percent(f, f->together.in_interior);
    row->mean_absolute_error = 100 * f->mean_absolute_error;
}

/* ---- the search for the best bias ------------------------------------------------------------------------------ */

/* Wrong pixels alone: no distances. */
static double count_wrong(const sweep_scene *scene, const uint8_t *mask)
{
    enum { LIT = 127, NOTHING = 255 };
    size_t wrong = 0, count = (size_t)scene->width * scene->height;
    for (size_t i = 0; i < count; i++)
        wrong += mask[i] != NOTHING && scene->truth[i] != NOTHING && (mask[i] >= LIT) != (scene->truth[i] >= LIT);
    return (double)wrong;
}

static int try_bias(void *user, double texels, double *wrong, problem *why)
{
    measurement *m = user;
    lane_frame f;
    sweep_choice_make(&m->choice, m->cell->chain, m->cell->map, m->image_text, texels);
    if (lane_find(m->cell->depth_bits, 0)->render(&f, &m->scene->packed, m->choice.values, 0, why))
        return -1;
    *wrong = count_wrong(m->scene, f.mask);
    lane_frame_free(&f);
    return 0;
}

static int choose_bias(measurement *m)
{
    const sweep_chain *chain = m->cell->chain;
    double texels = NAN;
    if (chain->searches_bias && sweep_bias_search(&texels, try_bias, m, m->why))
        return -1;
    sweep_choice_make(&m->choice, chain, m->cell->map, m->image_text, texels);
    if (m->choice.values[RENDER_BIAS]) /* as many digits as the options have, a `t` behind them */
        m->cell->row.bias = strtod(m->choice.values[RENDER_BIAS], 0);
    return 0;
}

/* ---- what it takes --------------------------------------------------------------------------------------------- */

static void fill_bytes(sweep_row *row, const gn_plan *plan)
{
    row->resident_bytes = (double)sweep_resident_bytes(plan);
    row->peak_bytes = (double)plan->bytes;
}

static int is_one_of(const char *word, const char *a, const char *b)
{
    return word && (strcmp(word, a) == 0 || strcmp(word, b) == 0);
}

/* The model of Sen et al. 2003, section 4: a shadow map reads 4 bytes a pixel; near a silhouette 3 points of 8 bytes
 * more; a fragment of a shadow volume takes 5.5. It says nothing of filters, virtual samples alone, or of smooth
 * borders. */
static void fill_model(sweep_row *row, const measurement *m, const gn_statistics *s)
{
    const double depth = 4, points = 3 * 8, fragment = 5.5;
    const char *const *values = m->choice.values;
    int silhouettes = strcmp(values[RENDER_METHOD], "silhouette") == 0;
    if (silhouettes && s->pixels_shaded)
        row->p_percent = 100 * (double)s->pixels_silhouette / (double)s->pixels_shaded;
    if (!sweep_chain_has_map(m->cell->chain)) {
        if (s->camera_fragments)
            row->overdraw = (double)s->volume_fragments / (double)s->camera_fragments;
        row->bandwidth = fragment * row->overdraw / depth;
    } else if (silhouettes && !is_one_of(values[RENDER_RECONSTRUCT], "silhouette-smooth", "crossing")) {
        row->bandwidth = (depth + points * row->p_percent / 100) / depth;
    } else if (!silhouettes && !values[RENDER_RECEIVER] && strcmp(values[RENDER_METHOD], "adaptive") != 0) {
        row->bandwidth = 1;
    }
}

static int has_cascade(const measurement *m)
{
    return sweep_chain_has_map(m->cell->chain) &&
           (m->choice.values[RENDER_RECEIVER] || is_one_of(m->choice.values[RENDER_METHOD], "adaptive", "silhouette"));
}

static void fill_counts(sweep_row *row, const measurement *m, const gn_statistics *s)
{
    row->pixels = (double)s->pixels_shaded;
    row->tested = (double)s->pixels_tested;
    if (sweep_chain_has_map(m->cell->chain)) {
        row->triangles = (double)s->light_triangles;
        row->texels = (double)s->light_texels;
    }
    if (has_cascade(m)) {
        row->outside = (double)s->pixels_outside;
        row->agreed = (double)s->pixels_agreed;
        row->virtual_pixels = (double)s->pixels_virtual;
        row->fractional = (double)s->pixels_fractional;
        row->silhouette = (double)s->pixels_silhouette;
    }
    fill_model(row, m, s);
}

static void fill_operations(sweep_row *row, uint64_t operations[LANE_PASSES][LANE_OPERATIONS])
{
    double sums[LANE_OPERATIONS] = {0};
    for (int pass = 0; pass < LANE_PASSES; pass++)
        for (int kind = 0; kind < LANE_OPERATIONS; kind++)
            sums[kind] += (double)operations[pass][kind];
    row->multiplies = sums[LANE_MULTIPLY];
    row->divides = sums[LANE_DIVIDE];
    row->adds = sums[LANE_ADD];
    row->loads = sums[LANE_LOAD];
    row->stores = sums[LANE_STORE];
    row->others = sums[LANE_OTHER];
}

/* To what the model was not fitted to, it says nothing, and the columns stay empty. */
static int fill_instructions(sweep_row *row, const measurement *m, const lane_frame *f,
                             const uint64_t operations[LANE_PASSES][LANE_OPERATIONS])
{
    packed_scene packed = m->scene->packed; /* its edges are there: nothing of it is written */
    gn_settings settings;
    problem unused;
    double instructions[LANE_PASSES];
    if (render_options_read(&settings, &packed, m->choice.values, m->why))
        return -1;
    if (cost_model_m4(instructions, &settings, &f->plan, &f->statistics, operations, packed.light.kind, &unused))
        return 0;
    row->m4_view = instructions[LANE_VIEW];
    row->m4_light = instructions[LANE_LIGHT];
    row->m4_camera = instructions[LANE_CAMERA];
    if (f->statistics.pixels_shaded)
        row->m4_pixel = (row->m4_view + row->m4_light + row->m4_camera) / (double)f->statistics.pixels_shaded;
    return 0;
}

/* f: of the lane that does not count. */
static int fill_cost(sweep_row *row, const measurement *m, const lane_frame *f)
{
    const lane *counting = lane_find(m->cell->depth_bits, 1);
    lane_frame counted;
    if (!counting)
        return fill_instructions(row, m, f, 0);
    if (counting->measure(&counted, &m->scene->packed, m->choice.values, 1, m->why))
        return -1;
    fill_operations(row, counted.operations);
    return fill_instructions(row, m, f, (const uint64_t(*)[LANE_OPERATIONS])counted.operations);
}

/* ---- host time ------------------------------------------------------------------------------------------------- */

/* Shadow volumes have no map to be compared at. */
enum { MAP_FOR_VOLUMES = 512 };

/* A round is so many frames of the one and of the other, of which the first finds its memory untouched. Short frames
 * are disturbed more, and cost less to repeat. */
enum { FRAMES = 2, MOST_ROUNDS = 6 };
static const double enough_seconds = 0.25;

static double seconds_of(const lane_frame *f)
{
    double sum = 0;
    for (int pass = 0; pass < LANE_PASSES; pass++)
        sum += f->seconds[pass];
    return sum;
}

static int take_time(const measurement *m, const char *const values[], double *least, double *sum)
{
    lane_frame f;
    if (lane_find(m->cell->depth_bits, 0)->measure(&f, &m->scene->packed, values, FRAMES, m->why))
        return -1;
    *least = fmin(*least, seconds_of(&f));
    *sum += FRAMES * seconds_of(&f);
    return 0;
}

static int fill_time(sweep_row *row, const measurement *m)
{
    double own = HUGE_VAL, constant = HUGE_VAL, sum = 0;
    sweep_choice reference;
    const sweep_cell *cell = m->cell;
    if (cell->chain == &sweep_chains[0]) {
        row->host_ratio = 1;
        return 0;
    }
    sweep_choice_make(&reference, &sweep_chains[0], cell->map ? cell->map : MAP_FOR_VOLUMES, m->image_text, 0);
    for (int round = 0; round < MOST_ROUNDS && sum < enough_seconds; round++)
        if (take_time(m, reference.values, &constant, &sum) || take_time(m, m->choice.values, &own, &sum))
            return -1;
    row->host_ratio = own / constant;
    return 0;
}

/* ---- all of it ------------------------------------------------------------------------------------------------- */

static void fill_names(sweep_row *row, const measurement *m)
{
    const sweep_cell *cell = m->cell;
    snprintf(row->scene, sizeof row->scene, "%s", m->scene->name);
    snprintf(row->chain, sizeof row->chain, "%s", cell->chain->name);
    snprintf(row->key, sizeof row->key, "%s", cell->key);
    sweep_choice_text(&m->choice, row->options, sizeof row->options);
    row->depth_bits = cell->depth_bits;
    row->map = cell->map;
    row->budget = cell->budget;
}

int sweep_measure(sweep_cell *cell, const char *image_text, problem *why)
{
    measurement m = {.cell = cell, .scene = cell->scene, .image_text = image_text, .why = why};
    lane_frame f;
    sweep_row *row = &cell->row;
    *row = sweep_row_empty();
    if (choose_bias(&m) || lane_find(cell->depth_bits, 0)->render(&f, &m.scene->packed, m.choice.values, 1, why))
        return -1;
    comparison c = compare(m.scene, f.mask);
    fill_names(row, &m);
    fill_errors(row, &c);
    fill_bytes(row, &f.plan);
    fill_counts(row, &m, &f.statistics);
    int result = fill_cost(row, &m, &f) || fill_time(row, &m) ? -1 : 0;
    lane_frame_free(&f);
    return result;
}

uint8_t *sweep_mask(const sweep_scene *scene, const sweep_row *row, const char *image_text, problem *why)
{
    sweep_choice choice;
    lane_frame f;
    const sweep_chain *chain = sweep_chain_find(row->chain, strlen(row->chain));
    sweep_choice_make(&choice, chain, (unsigned)row->map, image_text, row->bias);
    return lane_find((int)row->depth_bits, 0)->render(&f, &scene->packed, choice.values, 0, why) ? 0 : f.mask;
}
