#include "page_advice.h"

#include <math.h>
#include <string.h>

double advice_cost_of(const sweep_row *row, advice_cost cost)
{
    return cost == ADVICE_INSTRUCTIONS ? row->m4_pixel : cost == ADVICE_HOST_RATIO ? row->host_ratio : NAN;
}

static int is_known(const advice_rows *of, advice_cost cost)
{
    for (size_t i = 0; i < of->count; i++)
        if (advice_cost_of(of->rows[i], cost) > 0)
            return 1;
    return 0;
}

advice_cost advice_best_known(const advice_rows *of)
{
    return is_known(of, ADVICE_INSTRUCTIONS) ? ADVICE_INSTRUCTIONS
           : is_known(of, ADVICE_HOST_RATIO) ? ADVICE_HOST_RATIO
                                             : ADVICE_NO_COST;
}

/* -1, 0, 1; what is not known comes last. */
static int compare(double a, double b)
{
    if (isnan(a) || isnan(b))
        return isnan(a) - isnan(b);
    return (a > b) - (a < b);
}

static int is_map_within(const sweep_row *row, double bytes)
{
    return row->map > 0 && row->resident_bytes <= bytes && !isnan(row->error);
}

static int errs_less(const sweep_row *a, const sweep_row *b, advice_cost cost)
{
    int order = compare(a->error, b->error);
    if (!order)
        order = compare(advice_cost_of(a, cost), advice_cost_of(b, cost));
    if (!order)
        order = compare(a->resident_bytes, b->resident_bytes);
    return order < 0;
}

const sweep_row *advice_best(const advice_rows *of, double bytes)
{
    const sweep_row *best = 0;
    for (size_t i = 0; i < of->count; i++)
        if (is_map_within(of->rows[i], bytes) && (!best || errs_less(of->rows[i], best, of->cost)))
            best = of->rows[i];
    return best;
}

const sweep_row *advice_cheaper(const advice_rows *of, double bytes, const sweep_row *best)
{
    const sweep_row *cheapest = 0;
    double least = 0.8 * advice_cost_of(best, of->cost);
    for (size_t i = 0; i < of->count; i++) {
        const sweep_row *row = of->rows[i];
        double cost = advice_cost_of(row, of->cost);
        if (!is_map_within(row, bytes) || !(row->error <= 1.25 * best->error + 0.05) || !(cost <= least))
            continue;
        if (!cheapest || cost < least || errs_less(row, cheapest, of->cost)) {
            cheapest = row;
            least = cost;
        }
    }
    return cheapest;
}

const sweep_row *advice_avoid(const advice_rows *of, double budget, const sweep_row *best)
{
    const sweep_row *worst = 0;
    double cost = advice_cost_of(best, of->cost);
    for (size_t i = 0; i < of->count; i++) {
        const sweep_row *row = of->rows[i];
        if (row->map > 0 && row->budget == budget && advice_cost_of(row, of->cost) >= cost &&
            row->error >= 2 * best->error && row->error > 0 && (!worst || row->error > worst->error))
            worst = row;
    }
    return worst;
}

const sweep_row *advice_usual(const advice_rows *of, double budget, const sweep_row *best)
{
    for (size_t i = 0; i < of->count; i++) {
        const sweep_row *row = of->rows[i];
        if (strcmp(row->chain, "constant") == 0 && row->budget == budget && row->depth_bits == best->depth_bits &&
            row->map > 0 && !isnan(row->error))
            return row == best ? 0 : row;
    }
    return 0;
}

const sweep_row *advice_without_map(const advice_rows *of)
{
    const sweep_row *best = 0;
    for (size_t i = 0; i < of->count; i++)
        if (of->rows[i]->map == 0 && !isnan(of->rows[i]->error) && (!best || errs_less(of->rows[i], best, of->cost)))
            best = of->rows[i];
    return best;
}
