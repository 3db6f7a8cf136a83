#include "sweep_plan.h"

#include "lane.h"
#include "memory.h"
#include "stage_hash.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

size_t sweep_resident_bytes(const gn_plan *plan)
{
    return plan->map_bytes + plan->silhouette_bytes + plan->warp_bytes;
}

void sweep_cell_leave_out(sweep_cell *cell, const char *reason)
{
    static const char prefix[] = "gnomon: "; /* of a problem with a command line, which this is not */
    if (strncmp(reason, prefix, strlen(prefix)) == 0)
        reason += strlen(prefix);
    cell->reason = memory_take(strlen(reason) + 1, 1);
    memcpy(cell->reason, reason, strlen(reason));
}

/* ---- the largest map of a budget ------------------------------------------------------------------------------- */

enum { SMALLEST_MAP = 2 };

typedef struct fitting {
    const sweep_cell *cell;
    const char *image_text;
    problem why; /* of the latest that failed */
} fitting;

/* Of a map of that size; -1: it makes no sense. */
static double resident_bytes(fitting *f, uint32_t map)
{
    sweep_choice choice;
    gn_plan plan;
    sweep_choice_make(&choice, f->cell->chain, map, f->image_text, 1);
    if (lane_find(f->cell->depth_bits, 0)->plan(&plan, &f->cell->scene->packed, choice.values, &f->why))
        return -1;
    return (double)sweep_resident_bytes(&plan);
}

static int fits(fitting *f, uint32_t map)
{
    double bytes = map > GN_MAX_SIZE ? -1 : resident_bytes(f, map);
    return bytes >= 0 && bytes <= f->cell->budget;
}

/* From a guess outwards, in steps that double, then by halves: a plan looks at every triangle. 0: not even the smallest
 * fits. */
static uint32_t largest_map(fitting *f, uint32_t guess)
{
    uint32_t low = guess, high = guess + 1, step = 1;
    if (fits(f, guess)) {
        for (; fits(f, high); step *= 2) {
            low = high;
            high += step;
        }
    } else {
        for (high = low; !fits(f, low); step *= 2) {
            if (low == SMALLEST_MAP)
                return 0;
            high = low;
            low = low > SMALLEST_MAP + step ? low - step : SMALLEST_MAP;
        }
    }
    while (high - low > 1) {
        uint32_t middle = low + (high - low) / 2;
        *(fits(f, middle) ? &low : &high) = middle;
    }
    return low;
}

/* Bytes grow about with the square of the side. */
static uint32_t guess_map(fitting *f)
{
    enum { SAMPLE = 256 };
    double bytes = resident_bytes(f, SAMPLE), guess = bytes > 0 ? SAMPLE * sqrt(f->cell->budget / bytes) : SAMPLE;
    return guess < SMALLEST_MAP ? SMALLEST_MAP : guess > GN_MAX_SIZE ? GN_MAX_SIZE : (uint32_t)guess;
}

/* Set the map of a cell with a budget, or leave it out. */
static void fit_map(sweep_cell *cell, const char *image_text)
{
    fitting f = {.cell = cell, .image_text = image_text};
    char reason[200];
    cell->map = largest_map(&f, guess_map(&f));
    if (cell->map)
        return;
    double least = resident_bytes(&f, SMALLEST_MAP);
    if (least < 0) {
        sweep_cell_leave_out(cell, f.why.text);
        return;
    }
    snprintf(reason, sizeof reason, "no map fits %" PRIu32 " bytes: the smallest, %d x %d, takes %.0f", cell->budget,
             SMALLEST_MAP, SMALLEST_MAP, least);
    sweep_cell_leave_out(cell, reason);
}

/* ---- cells ----------------------------------------------------------------------------------------------------- */

static stage_hash hash_text(stage_hash hash, const char *string)
{
    for (; *string; string++)
        hash = stage_hash_u8(hash, (uint8_t)*string);
    return stage_hash_u8(hash, 0);
}

/* The operations that a build counts are columns, so a build without them makes other rows. */
static void make_key(sweep_cell *cell, const char *image_text)
{
    char options[256];
    sweep_choice choice;
    sweep_choice_make(&choice, cell->chain, cell->map, image_text, 0);
    sweep_choice_text(&choice, options, sizeof options);
    stage_hash hash = hash_text(hash_text(stage_hash_init(), cell->scene->name), cell->chain->name);
    hash = hash_text(hash, options);
    hash = stage_hash_u32(hash, (uint32_t)cell->scene->hash);
    hash = stage_hash_u32(hash, (uint32_t)(cell->scene->hash >> 32));
    hash = stage_hash_u32(stage_hash_u32(hash, cell->map), cell->budget);
    hash = stage_hash_u8(hash, (uint8_t)cell->depth_bits);
    hash = stage_hash_u8(hash, lane_find(cell->depth_bits, 1) != 0);
    stage_hash_text(hash, cell->key);
}

static size_t find_twin(const sweep_plan *plan, size_t index)
{
    const sweep_cell *cell = &plan->cells[index];
    for (size_t i = index; i-- > 0 && plan->cells[i].scene == cell->scene;)
        if (plan->cells[i].chain == cell->chain && plan->cells[i].depth_bits == cell->depth_bits &&
            plan->cells[i].map == cell->map && !plan->cells[i].reason)
            return plan->cells[i].twin;
    return index;
}

static void add_cell(sweep_plan *plan, const sweep_scene *scene, const sweep_chain *chain, int depth_bits, long map,
                     long budget)
{
    plan->cells = memory_grow(plan->cells, &plan->capacity, plan->count + 1, sizeof *plan->cells);
    sweep_cell *cell = &plan->cells[plan->count];
    *cell = (sweep_cell){.scene = scene,
                         .chain = chain,
                         .depth_bits = depth_bits,
                         .map = (uint32_t)map,
                         .budget = (uint32_t)budget,
                         .twin = plan->count};
    const char *refused = sweep_chain_refuses(chain, scene->packed.light.kind);
    if (refused)
        sweep_cell_leave_out(cell, refused);
    else if (budget)
        fit_map(cell, plan->image_text);
    make_key(cell, plan->image_text);
    if (!cell->reason)
        cell->twin = find_twin(plan, plan->count);
    plan->count++;
}

static void add_chains(sweep_plan *plan, const sweep_request *r, const sweep_scene *scene, int depth_bits, long map,
                       long budget)
{
    for (int i = 0; i < r->chain_count; i++)
        if (sweep_chain_has_map(r->chains[i]))
            add_cell(plan, scene, r->chains[i], depth_bits, map, budget);
}

/* Shadow volumes come last, and once: their bits have no depth. */
static void add_scene(sweep_plan *plan, const sweep_request *r, const sweep_scene *scene)
{
    for (int d = 0; d < r->depth_count; d++) {
        for (int m = 0; m < r->map_count; m++)
            add_chains(plan, r, scene, r->depths[d], r->maps[m], 0);
        for (int b = 0; b < r->budget_count; b++)
            add_chains(plan, r, scene, r->depths[d], 0, r->budgets[b]);
    }
    for (int i = 0; i < r->chain_count; i++)
        if (!sweep_chain_has_map(r->chains[i]))
            add_cell(plan, scene, r->chains[i], r->depths[0], 0, 0);
}

/* ---- checks ---------------------------------------------------------------------------------------------------- */

static int check_budget(const sweep_plan *plan, long budget, problem *why)
{
    const sweep_cell *first = 0;
    for (size_t i = 0; i < plan->count; i++) {
        const sweep_cell *cell = &plan->cells[i];
        if (cell->budget != (uint32_t)budget)
            continue;
        if (!cell->reason)
            return 0;
        first = first ? first : cell;
    }
    return first ? problem_of_usage(why, "--budgets: %s by %s; expected more", first->reason, first->chain->name) : 0;
}

static int check_lanes(const sweep_request *r, problem *why)
{
    for (int d = 0; d < r->depth_count; d++)
        if (!lane_find(r->depths[d], 0))
            return problem_of_usage(why, "this program has no core of %d bits of depth; expected another of --depths",
                                    r->depths[d]);
    return 0;
}

int sweep_plan_make(sweep_plan *plan, const sweep_request *request, const sweep_scene *scenes, int scene_count,
                    problem *why)
{
    *plan = (sweep_plan){.image_text = request->image_text};
    if (check_lanes(request, why))
        return -1;
    for (int i = 0; i < scene_count; i++)
        add_scene(plan, request, &scenes[i]);
    for (int b = 0; b < request->budget_count; b++)
        if (check_budget(plan, request->budgets[b], why))
            return -1;
    return 0;
}

void sweep_plan_free(sweep_plan *plan)
{
    for (size_t i = 0; i < plan->count; i++)
        free(plan->cells[i].reason);
    free(plan->cells);
}
