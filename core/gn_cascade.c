/* The cascade of a row, in blocks: points, votes, virtual samples, what is written. See gn_cascade.h. */
#include "gn_cascade.h"
#include "gn_drawing.h"

/* What stands for no receiver. */
static const gn_receiver the_point = {gn_cascade_row, 0, 0, 0, 0, 0, 1};

static const gn_receiver *find_receiver(const gn_context *context)
{
    return context->settings.receiver ? context->settings.receiver : &the_point;
}

static const gn_reconstruction *find_reconstruction(const gn_context *context)
{
    const gn_reconstruction *how = context->settings.reconstruction;
    return how ? how : find_receiver(context)->nearest;
}

static gn_lookup make_lookup(const gn_context *context, gn_worker *worker, const gn_reconstruction *how)
{
    gn_lookup l = {context->map,
                   context->map_stride,
                   context->settings.map_width - 1u,
                   context->settings.map_height * (context->point_light ? gn_map_count(&context->settings) : 1) - 1u,
                   gn_point_bits(context),
                   context->light.kind != GN_SPOT && !context->grid && context->shading.trusted == GN_WELL_INSIDE,
                   how->whole,
                   context->drawn ? context->drawn->map : 0,
                   context->grid ? context->grid->columns : 0,
                   context->grid ? context->grid->rows : 0,
                   how,
                   context->grid,
                   context,
                   worker};
    return l;
}

/* Of the lit shares k: floor((254 k + n / 2) / n). */
static uint8_t fraction(uint32_t dark, uint32_t n)
{
    return (uint8_t)(dark == 0 ? 254 : dark == n ? 0 : (254 * (n - dark) + n / 2) / n);
}

/* Shadowed: negative. Where the light is a spot, q holds how near it is. */
static void write_nearest(const gn_points *points, uint32_t *q)
{
    for (int32_t i = 0; i < points->count; i++)
        q[i] |= points->dark[i];
}

static void write_open(const gn_points *points, uint32_t *q)
{
    for (int32_t n = 0; n < points->open_count; n++)
        q[points->open[n]] |= points->dark[points->open[n]];
}

static void write_fractions(const gn_points *points, uint32_t whole, uint8_t *out)
{
    for (int32_t i = 0; i < points->count; i++)
        out[i] = fraction(points->dark[i], whole);
}

#if GN_STATISTICS
/* Of pixels that are turned to the light. */
static void count_stages(const gn_context *context, gn_worker *worker, const gn_points *points,
                         const gn_reconstruction *how)
{
    gn_statistics *s = &worker->statistics;
    for (int32_t i = 0; i < points->count; i++) {
        if (points->triangle[i] == GN_NO_TRIANGLE || !gn_find_pair(context, worker, points->triangle[i])->faces_light)
            continue;
        if (context->point_light && points->u[i] == GN_NOWHERE && points->z[i] == 0)
            continue; /* on a face whose turn it is not */
        int outside = points->u[i] == GN_NOWHERE, resampled = points->resampled[i];
        int reconstructed = points->reconstructed[i],
            fractional = how->whole != GN_DARK && points->dark[i] > 0 && points->dark[i] < how->whole;
        uint32_t voted = !outside && find_receiver(context)->votes;
        s->pixels_outside += (uint32_t)outside;
        s->pixels_agreed += (uint32_t)(!outside && !resampled && !fractional && !reconstructed);
        s->pixels_virtual += (uint32_t)resampled;
        s->pixels_fractional += (uint32_t)fractional;
        s->pixels_silhouette += (uint32_t)reconstructed;
        s->texels_read += voted * how->votes + (resampled || reconstructed ? how->samples : 0);
        s->virtual_samples += resampled ? how->samples : 0;
    }
}
#endif

static gn_vote_at_once *find_short_cut(const gn_context *context)
{
    const gn_receiver *receiver = find_receiver(context);
    const gn_shading *s = &context->shading;
    if (!receiver->nearest || find_reconstruction(context)->vote != receiver->nearest->vote || context->fitting)
        return 0;
    if (context->light.kind == GN_SPOT)
        return context->point_light ? 0 : receiver->spotlit;
    int needs_no_test = !context->camera_view.affine && s->trusted == GN_WELL_INSIDE && s->position_bits >= 8;
    return needs_no_test ? receiver->sunlit : 0;
}

/* Points and votes one after the other. */
static void vote(const gn_context *context, gn_worker *worker, const gn_reconstruction *how, const gn_lookup *lookup,
                 gn_points *points, uint32_t *q)
{
    const gn_receiver *receiver = find_receiver(context);
    gn_find_points(context, points, q);
    if (context->grid)
        context->grid->place(lookup, points);
    if (receiver->prepare)
        receiver->prepare(context, worker, points);
    if (receiver->votes)
        how->vote(lookup, points);
    if (context->grid && context->grid->doubt && receiver->votes && receiver->resample)
        context->grid->doubt(lookup, points);
}

void gn_cascade_row(gn_context *context, gn_worker *worker, uint32_t from, int32_t x, int32_t y, int32_t count)
{
    const gn_receiver *receiver = find_receiver(context);
    const gn_reconstruction *how = find_reconstruction(context);
    gn_vote_at_once *at_once = find_short_cut(context);
    int in_place = how->whole == GN_DARK && context->light.kind != GN_SPOT;
    gn_lookup lookup = make_lookup(context, worker, how);
    uint32_t *q = worker->q + from;
    gn_points points;
    if (!context->camera_view.affine)
        gn_row_of_w(q, count, context->shading.w_shift);
    points.x = x;
    points.y = y;
    gn_start_points(context, &points);
    for (int32_t done = 0; done < count; done += GN_BLOCK, q += GN_BLOCK) {
        points.triangle = worker->triangle + from + done;
        points.x = x + done;
        points.count = count - done < GN_BLOCK ? count - done : GN_BLOCK;
        points.open_count = 0;
        points.dark = in_place ? q : points.shares;
#if GN_STATISTICS
        for (int32_t i = 0; i < points.count; i++)
            points.u[i] = points.resampled[i] = points.reconstructed[i] = 0;
#endif
        if (at_once)
            at_once(context, &lookup, &points, q);
        else
            vote(context, worker, how, &lookup, &points, q);
        if (receiver->resample && (points.open_count || !receiver->votes))
            receiver->resample(context, worker, &lookup, &points, context->grid ? context->grid->sample : how->sample);
        else if (how->settle)
            how->settle(how, &lookup, &points);
#if GN_STATISTICS
        count_stages(context, worker, &points, how);
#endif
        if (how->whole != GN_DARK)
            write_fractions(&points, how->whole, worker->fraction + done);
        else if (at_once && !in_place)
            write_open(&points, q);
        else if (!in_place)
            write_nearest(&points, q);
    }
}
