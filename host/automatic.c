#include "automatic.h"

#include "automatic_search.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ---- options --------------------------------------------------------------------------------------------------- */

/* Bytes, or with K or M behind it 2^10 or 2^20 of them. */
static int read_bytes(const char *value, uint64_t *bytes, problem *why)
{
    char *end;
    int digit = value[0] >= '0' && value[0] <= '9';
    unsigned long long number = strtoull(value, &end, 10);
    int shift = *end == 'K' ? 10 : *end == 'M' ? 20 : 0;
    if (!digit || end[shift != 0] || number < 1 || number > (1ull << 32) >> shift)
        return problem_of_usage(
            why, "--budget-bytes %s; expected a whole number of bytes from 1 to 4096M, or of K or M", value);
    *bytes = number << shift;
    return 0;
}

static int read_budget(automatic_budget *budget, const char *const values[], problem *why)
{
    budget->bytes = 0;
    budget->error = -1;
    if (values[RENDER_BUDGET_BYTES] && read_bytes(values[RENDER_BUDGET_BYTES], &budget->bytes, why))
        return -1;
    return values[RENDER_BUDGET_ERROR]
               ? option_decimal("--budget-error", values[RENDER_BUDGET_ERROR], 0, 100, &budget->error, why)
               : 0;
}

/* A budget chooses what these options name. */
static int refuse_others(const packed_scene *packed, const char *const values[], const char *budget, problem *why)
{
    static const option names[RENDER_OPTION_COUNT] = {RENDER_OPTIONS};
    static const int chosen[] = {RENDER_PARAMETERISE, RENDER_SMOOTHING,   RENDER_FIT_DEPTH, RENDER_CULL,
                                 RENDER_LAYERS,       RENDER_SURFACE,     RENDER_BIAS,      RENDER_SLOPE,
                                 RENDER_RECEIVER,     RENDER_RECONSTRUCT, RENDER_MAP};
    const char *method = values[RENDER_METHOD];
    if (method ? strcmp(method, "auto") != 0 : packed->has_method)
        return problem_of_usage(why, "%s with %s; expected --method auto", budget,
                                method ? method : "the method of the file");
    for (size_t i = 0; i < sizeof chosen / sizeof *chosen; i++)
        if (values[chosen[i]])
            return problem_of_usage(why, "%s with %s, which the budget is to choose; expected one of the two", budget,
                                    names[chosen[i]].name);
    return 0;
}

/* ---- what is said ---------------------------------------------------------------------------------------------- */

static void bytes_text(uint64_t bytes, char *text, size_t size)
{
    if (bytes < 1024)
        snprintf(text, size, "%d bytes", (int)bytes);
    else if (bytes < 1 << 20)
        snprintf(text, size, "%.1f KiB", (double)bytes / 1024);
    else
        snprintf(text, size, "%.1f MiB", (double)bytes / (1 << 20));
}

static void result_text(const automatic_result *r, char *text, size_t size)
{
    char candidate[96], bytes[24], map[32] = "";
    automatic_candidate_text(&r->candidate, candidate, sizeof candidate);
    bytes_text(r->bytes, bytes, sizeof bytes);
    if (r->candidate.width)
        snprintf(map, sizeof map, ", map %d x %d", r->candidate.width, r->candidate.height);
    snprintf(text, size, "%s%s, %s", candidate, map, bytes);
}

static void budget_text(const automatic_budget *budget, char *text, size_t size)
{
    char bytes[24];
    bytes_text(budget->bytes, bytes, sizeof bytes);
    if (budget->bytes && budget->error >= 0)
        snprintf(text, size, "%s and %g %%", bytes, budget->error);
    else if (budget->bytes)
        snprintf(text, size, "%s", bytes);
    else
        snprintf(text, size, "%g %%", budget->error);
}

/* What the taken one errs, and what is known of its cost. */
static void say_figures(const automatic_choice *choice)
{
    const automatic_result *r = &choice->taken;
    if (!choice->tried)
        fprintf(stderr, "tables expect %.2g %% wrong, not tried", r->expected);
    else
        fprintf(stderr, "%.3g %% wrong on this view", r->error);
    if (choice->tried && r->candidate.width && r->wrong)
        fprintf(stderr, " (tables expected %.2g)", r->expected);
    if (r->cost > 0)
        fprintf(stderr, ", %.0f instructions a pixel", r->cost);
}

static void say(const automatic_choice *choice, const automatic_scene *scene, const automatic_budget *budget)
{
    char result[192], within[64], contents[160];
    const char *why = budget->error < 0 || !choice->keeps ? "least error" : budget->bytes ? "cheapest" : "fewest bytes";
    result_text(&choice->taken, result, sizeof result);
    budget_text(budget, within, sizeof within);
    automatic_scene_text(scene, contents, sizeof contents);
    fprintf(stderr, "auto: %s%s: ", choice->keeps ? "" : "nothing keeps the budget; ", result);
    say_figures(choice);
    fprintf(stderr, "; %s for %s, %s", why, within, contents);
    if (choice->tried)
        fprintf(stderr, ", %u tried", (unsigned)choice->tried);
    if (choice->has_next) {
        result_text(&choice->next, result, sizeof result);
        fprintf(stderr, "; next: %s: %.3g %%", result, choice->next.error);
    }
    fputs("\n", stderr);
}

/* ---- the choice ------------------------------------------------------------------------------------------------ */

static int choose_by_trial(automatic_choice *choice, const packed_scene *packed, const automatic_scene *scene,
                           const gn_settings *base, int workers, const automatic_budget *budget, problem *why)
{
    automatic_trial trial;
    int result = automatic_trial_open(&trial, packed, scene, base, workers, why) ||
                 automatic_search(choice, &trial, budget, why);
    automatic_trial_close(&trial);
    return result ? -1 : 0;
}

/* How the work is cut shall not change the choice, and costs hang on it. */
static void use_usual_work(gn_settings *settings)
{
    settings->workers = 1;
    settings->region_width = 0;
    settings->region_height = 0;
    settings->map_rows = 0;
}

int automatic_options_read(gn_settings *settings, packed_scene *packed, const char *const values[], problem *why)
{
    const char *first = values[RENDER_BUDGET_BYTES] ? "--budget-bytes" : "--budget-error";
    automatic_budget budget;
    automatic_scene scene;
    automatic_choice choice;
    gn_settings base = *settings;
    use_usual_work(&base);
    if (!values[RENDER_BUDGET_BYTES] && !values[RENDER_BUDGET_ERROR])
        return values[RENDER_NO_TRIAL]
                   ? problem_of_usage(why, "--no-trial, but nothing is to be chosen; expected a budget")
                   : 0;
    if (refuse_others(packed, values, first, why) || read_budget(&budget, values, why) ||
        packed_make_edges(packed, 0, why) || automatic_scene_make(&scene, packed, &base, why) ||
        (values[RENDER_NO_TRIAL] ? automatic_guess(&choice, &scene, packed, &base, &budget, why)
                                 : choose_by_trial(&choice, packed, &scene, &base, settings->workers, &budget, why)))
        return -1;
    say(&choice, &scene, &budget);
    *settings = automatic_settings(&choice.taken.candidate, settings);
    return 0;
}
