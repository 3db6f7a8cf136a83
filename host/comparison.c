#include "comparison.h"

#include "distance.h"
#include "memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { NO_SURFACE = 255, FULLY_LIT = 254, LIT_FROM = 127 };

typedef enum kind { SHADOWED, LIT, NOTHING } kind;

static kind kind_of(uint8_t value)
{
    return value == NO_SURFACE ? NOTHING : value >= LIT_FROM ? LIT : SHADOWED;
}

static int is_edge(kind a, kind b)
{
    return a != b && a != NOTHING && b != NOTHING;
}

static void find_edges(uint8_t *edges, const uint8_t *truth, uint32_t width, uint32_t height)
{
    for (uint32_t y = 0; y < height; y++, edges += width, truth += width)
        for (uint32_t x = 0; x < width; x++) {
            kind here = kind_of(truth[x]);
            int right = x + 1 < width && is_edge(here, kind_of(truth[x + 1]));
            int below = y + 1 < height && is_edge(here, kind_of(truth[x + width]));
            edges[x] = (uint8_t)((right ? DISTANCE_EDGE_RIGHT : 0) | (below ? DISTANCE_EDGE_BELOW : 0));
        }
}

/* The rank-th smallest, from 1, in linear time: the upper half of it by counting upper halves, then the lower half by
 * counting those of the values that share the upper one. */
static uint32_t at_rank(const uint32_t *values, size_t count, size_t rank)
{
    enum { BUCKETS = 1 << 16 };
    size_t *buckets = memory_take(BUCKETS, sizeof *buckets);
    uint32_t upper = 0, lower = 0;
    for (size_t i = 0; i < count; i++)
        buckets[values[i] >> 16]++;
    for (; buckets[upper] < rank; upper++)
        rank -= buckets[upper];
    memset(buckets, 0, BUCKETS * sizeof *buckets);
    for (size_t i = 0; i < count; i++)
        if (values[i] >> 16 == upper)
            buckets[values[i] & 0xffff]++;
    for (; buckets[lower] < rank; lower++)
        rank -= buckets[lower];
    free(buckets);
    return upper << 16 | lower;
}

static double in_pixels(uint32_t squared)
{
    return sqrt((double)squared) / 2;
}

/* The pixels that some figures are of. */
typedef struct pixels {
    const comparison_input *in;
    const uint32_t *squared; /* distances from the edge (distance.h) */
    int has_edge, leave_out_near;
    uint32_t band; /* the largest squared distance of the edge band */
} pixels;

static int is_left_out(const pixels *p, size_t i)
{
    return p->leave_out_near && p->in->near[i];
}

/* Squared distances of wrong pixels, and the first of the farthest. */
typedef struct distances {
    uint32_t *squared;
    size_t count, worst; /* worst: a pixel's index */
    uint32_t worst_squared;
} distances;

/* Of the wrong pixels that are of this kind in truth. */
static distances collect(const pixels *p, kind of_truth, uint32_t *squared)
{
    distances d = {.squared = squared};
    size_t count = (size_t)p->in->width * p->in->height;
    for (size_t i = 0; i < count; i++) {
        kind got = kind_of(p->in->mask[i]);
        if (kind_of(p->in->truth[i]) != of_truth || got == of_truth || got == NOTHING || is_left_out(p, i))
            continue;
        squared[d.count++] = p->squared[i];
        if (p->squared[i] > d.worst_squared) {
            d.worst_squared = p->squared[i];
            d.worst = i;
        }
    }
    return d;
}

/* Both, where the second's block follows the first's. */
static distances joined(const distances *a, const distances *b)
{
    distances both = *a;
    both.count += b->count;
    if (b->worst_squared > a->worst_squared || (b->worst_squared == a->worst_squared && b->worst < a->worst)) {
        both.worst_squared = b->worst_squared;
        both.worst = b->worst;
    }
    return both;
}

static comparison_errors errors_of(const pixels *p, const distances *d)
{
    comparison_errors e = {.pixels = d->count, .mean = NAN, .percentile_95 = NAN, .worst = NAN};
    double sum = 0;
    for (size_t i = 0; i < d->count; i++) {
        e.in_edge_band += d->squared[i] <= p->band;
        sum += in_pixels(d->squared[i]);
    }
    e.in_interior = e.pixels - e.in_edge_band;
    if (!p->has_edge || !d->count)
        return e;
    e.mean = sum / (double)d->count;
    e.percentile_95 = in_pixels(at_rank(d->squared, d->count, d->count - d->count / 20));
    e.worst = in_pixels(d->worst_squared);
    e.worst_x = (uint32_t)(d->worst % p->in->width);
    e.worst_y = (uint32_t)(d->worst / p->in->width);
    return e;
}

static void count_pixels(comparison_figures *f, const pixels *p)
{
    uint64_t in_both = 0, difference = 0;
    size_t count = (size_t)p->in->width * p->in->height;
    for (size_t i = 0; i < count; i++) {
        if (is_left_out(p, i))
            continue;
        kind got = kind_of(p->in->mask[i]), expected = kind_of(p->in->truth[i]);
        f->coverage += (got == NOTHING) != (expected == NOTHING);
        if (expected == NOTHING)
            continue;
        f->surface++;
        f->lit += expected == LIT;
        f->shadowed += expected == SHADOWED;
        f->in_edge_band += p->squared[i] <= p->band;
        if (got == NOTHING)
            continue;
        in_both++;
        difference += (uint64_t)abs(p->in->mask[i] - p->in->truth[i]);
    }
    f->mean_absolute_error = in_both ? (double)difference / FULLY_LIT / (double)in_both : NAN;
}

static comparison_figures figures_of(const pixels *p)
{
    comparison_figures f = {0};
    count_pixels(&f, p);
    uint32_t *wrong = memory_take(f.surface, sizeof *wrong);
    distances shadow = collect(p, LIT, wrong), light = collect(p, SHADOWED, wrong + shadow.count);
    distances both = joined(&shadow, &light);
    f.false_shadow = errors_of(p, &shadow);
    f.false_light = errors_of(p, &light);
    f.together = errors_of(p, &both);
    free(wrong);
    return f;
}

static uint32_t squared_band(double edge_band)
{
    double squared = floor(4 * edge_band * edge_band);
    return squared < DISTANCE_NONE ? (uint32_t)squared : DISTANCE_NONE - 1;
}

void comparison_make(comparison *c, const comparison_input *input)
{
    size_t count = (size_t)input->width * input->height;
    uint8_t *edges = memory_take(count, sizeof *edges);
    uint32_t *squared = memory_take(count, sizeof *squared);
    find_edges(edges, input->truth, input->width, input->height);
    pixels p = {.in = input, .squared = squared, .band = squared_band(input->edge_band)};
    p.has_edge = distance_to_edges(squared, edges, input->width, input->height);
    free(edges);
    *c = (comparison){.has_edge = p.has_edge, .has_near = input->near != 0, .edge_band = input->edge_band};
    c->all = figures_of(&p);
    p.leave_out_near = c->has_near;
    c->not_near = c->has_near ? figures_of(&p) : c->all;
    free(squared);
}

double comparison_percent(const comparison_figures *f, uint64_t count)
{
    return f->surface ? 100.0 * (double)count / (double)f->surface : 0;
}

static const uint8_t *colour_of(kind got, kind expected, int near)
{
    static const uint8_t red[3] = {220, 30, 30}, blue[3] = {40, 80, 255}, magenta[3] = {220, 40, 220};
    static const uint8_t yellow[3] = {240, 220, 40};
    static const uint8_t light_grey[3] = {190, 190, 190}, dark_grey[3] = {90, 90, 90}, dark[3] = {20, 20, 20};
    if (got == expected)
        return got == NOTHING ? dark : got == LIT ? light_grey : dark_grey;
    if (near)
        return yellow;
    if (got == NOTHING || expected == NOTHING)
        return magenta;
    return got == SHADOWED ? red : blue;
}

image comparison_picture(const comparison_input *input)
{
    image picture = image_make(input->width, input->height, 3, IMAGE_U8);
    uint8_t *samples = picture.samples;
    size_t count = (size_t)input->width * input->height;
    for (size_t i = 0; i < count; i++)
        memcpy(samples + 3 * i,
               colour_of(kind_of(input->mask[i]), kind_of(input->truth[i]), input->near && input->near[i]), 3);
    return picture;
}
