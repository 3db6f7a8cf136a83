#include "sweep_request.h"

#include "gnomon.h"
#include "options.h"
#include "text.h"

#include <stdio.h>
#include <string.h>
#include <unistd.h>

/* ---- lists of numbers ------------------------------------------------------------------------------------------ */

typedef struct list {
    const char *name; /* of the option */
    long *numbers;
    int *count;
    long least, most;
    int takes_units; /* K: 1024, M: 1024 K */
} list;

static int refuse_number(const list *l, word w, problem *why)
{
    return problem_of_usage(why, "%s: '%s'; expected whole numbers from %ld to %ld%s with commas between them, or none",
                            l->name, word_shown(w).text, l->least, l->most,
                            l->takes_units ? " (K: 1024, M: 1048576)" : "");
}

static int read_number(const list *l, word w, long *number, problem *why)
{
    long unit = 1;
    char last = w.length ? w.start[w.length - 1] : 0;
    word digits = w;
    if (l->takes_units && (last == 'K' || last == 'M')) {
        unit = last == 'K' ? 1024 : 1024L * 1024;
        digits.length--;
    }
    if (word_integer(digits, number) || *number < 1 || *number > l->most / unit || *number * unit < l->least)
        return refuse_number(l, w, why);
    *number *= unit;
    return 0;
}

/* In its place by size. */
static int insert(const list *l, long number, problem *why)
{
    int at = *l->count;
    if (at == SWEEP_MOST_SIZES)
        return problem_of_usage(why, "%s has more numbers than %d; expected fewer", l->name, SWEEP_MOST_SIZES);
    for (; at > 0 && l->numbers[at - 1] >= number; at--) {
        if (l->numbers[at - 1] == number)
            return problem_of_usage(why, "%s has %ld twice; expected every number once", l->name, number);
        l->numbers[at] = l->numbers[at - 1];
    }
    l->numbers[at] = number;
    ++*l->count;
    return 0;
}

static int read_list(const list *l, const char *value, problem *why)
{
    long number;
    *l->count = 0;
    if (strcmp(value, "none") == 0)
        return 0;
    for (const char *at = value;; at++) {
        word w = {at, strcspn(at, ",")};
        if (read_number(l, w, &number, why) || insert(l, number, why))
            return -1;
        at += w.length;
        if (!*at)
            return 0;
    }
}

/* ---- the other lists ------------------------------------------------------------------------------------------- */

static int read_depths(sweep_request *r, const char *value, problem *why)
{
    static const struct {
        const char *text;
        int count, depths[2];
    } known[] = {{"16", 1, {16, 0}}, {"32", 1, {32, 0}}, {"16,32", 2, {16, 32}}};
    for (size_t i = 0; i < sizeof known / sizeof *known; i++)
        if (strcmp(value, known[i].text) == 0) {
            r->depth_count = known[i].count;
            memcpy(r->depths, known[i].depths, sizeof r->depths);
            return 0;
        }
    return problem_of_usage(why, "--depths %s; expected 16, 32 or 16,32", value);
}

static int refuse_chain(word w, problem *why)
{
    char names[900] = "";
    size_t used = 0;
    for (int i = 0; i < SWEEP_CHAINS && used < sizeof names; i++)
        used += (size_t)snprintf(names + used, sizeof names - used, "%s%s", i ? ", " : "", sweep_chains[i].name);
    return problem_of_usage(why, "--methods: unknown chain '%s'; expected of these, with commas between them: %s",
                            word_shown(w).text, names);
}

/* Whatever their order: rows come in that of the table. */
static int read_chains(sweep_request *r, const char *value, problem *why)
{
    char wanted[SWEEP_CHAINS] = {0};
    for (const char *at = value;; at++) {
        word w = {at, strcspn(at, ",")};
        const sweep_chain *chain = sweep_chain_find(w.start, w.length);
        if (!chain)
            return refuse_chain(w, why);
        if (wanted[chain - sweep_chains]++)
            return problem_of_usage(why, "--methods has %s twice; expected every chain once", chain->name);
        at += w.length;
        if (!*at)
            break;
    }
    r->chain_count = 0;
    for (int i = 0; i < SWEEP_CHAINS; i++)
        if (wanted[i])
            r->chains[r->chain_count++] = &sweep_chains[i];
    return 0;
}

/* ---- all of it ------------------------------------------------------------------------------------------------- */

static void use_defaults(sweep_request *r)
{
    static const long maps[] = {64, 128, 256, 512, 1024}, budgets[] = {32 * 1024, 128 * 1024, 512 * 1024};
    long processors = sysconf(_SC_NPROCESSORS_ONLN);
    memset(r, 0, sizeof *r);
    for (r->chain_count = 0; r->chain_count < SWEEP_CHAINS; r->chain_count++)
        r->chains[r->chain_count] = &sweep_chains[r->chain_count];
    r->depths[0] = 16;
    r->depths[1] = 32;
    r->depth_count = 2;
    memcpy(r->maps, maps, sizeof maps);
    memcpy(r->budgets, budgets, sizeof budgets);
    r->map_count = sizeof maps / sizeof *maps;
    r->budget_count = sizeof budgets / sizeof *budgets;
    r->workers = processors < 1 ? 1 : processors > 64 ? 64 : processors;
}

static int has_map_chains(const sweep_request *r)
{
    for (int i = 0; i < r->chain_count; i++)
        if (sweep_chain_has_map(r->chains[i]))
            return 1;
    return 0;
}

int sweep_request_read(sweep_request *request, const sweep_request_values *values, problem *why)
{
    use_defaults(request);
    const list maps = {"--maps", request->maps, &request->map_count, 2, GN_MAX_SIZE, 0},
               budgets = {"--budgets", request->budgets, &request->budget_count, 1, 1L << 30, 1};
    if ((values->methods && read_chains(request, values->methods, why)) ||
        (values->maps && read_list(&maps, values->maps, why)) ||
        (values->budgets && read_list(&budgets, values->budgets, why)) ||
        (values->depths && read_depths(request, values->depths, why)) ||
        (values->size && option_size("--size", values->size, 0, GN_MAX_SIZE, request->image, why)) ||
        (values->workers && option_number("--workers", values->workers, 1, 64, &request->workers, why)))
        return -1;
    if (values->size)
        snprintf(request->image_text, sizeof request->image_text, "%ldx%ld", request->image[0], request->image[1]);
    if (has_map_chains(request) && !request->map_count && !request->budget_count)
        return problem_of_usage(why, "--maps none and --budgets none leave no map; expected sizes, bytes, or both");
    return 0;
}
