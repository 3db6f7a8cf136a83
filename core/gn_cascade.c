/* The cascade of a row, in blocks: points, votes, virtual samples, what is written. See gn_cascade.h. */
#include "gn_cascade.h"
#include "gn_shade.h"

static gn_lookup make_lookup(const gn_context *context, const gn_reconstruction *how)
{
    gn_lookup l = {context->map,
                   context->map_stride,
                   context->settings.map_width - 1u,
                   context->settings.map_height - 1u,
                   gn_point_bits(context),
                   how->whole};
    return l;
}

/* floor((254 k + n / 2) / n). */
static uint8_t fraction(uint32_t k, uint32_t n)
{
    return (uint8_t)(k == 0 ? 0 : k == n ? 254 : (254 * k + n / 2) / n);
}

/* Shadowed: negative. */
static void write_nearest(const gn_context *context, const gn_points *points, uint32_t *q)
{
    uint32_t keep = context->light.kind == GN_SPOT ? 0xffffffffu : 0;
    for (int32_t i = 0; i < points->count; i++)
        q[i] = points->lit[i] ? q[i] & keep : 0x80000000u;
}

static void write_fractions(const gn_points *points, uint32_t whole, uint8_t *out)
{
    for (int32_t i = 0; i < points->count; i++)
        out[i] = fraction(points->lit[i], whole);
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
        uint32_t stage = points->stage[i], voted = points->u[i] == GN_NOWHERE ? 0 : how->votes;
        uint32_t resampled = stage == GN_RESAMPLED ? how->samples : 0;
        s->pixels_outside += points->u[i] == GN_NOWHERE;
        s->pixels_fractional += points->lit[i] > 0 && points->lit[i] < how->whole;
        s->pixels_agreed += points->u[i] != GN_NOWHERE && stage == GN_AGREED;
        s->pixels_virtual += stage == GN_RESAMPLED;
        s->texels_read += voted + resampled;
        s->virtual_samples += resampled;
    }
}
#endif

void gn_cascade_row(gn_context *context, gn_worker *worker, uint32_t from, int32_t x, int32_t y, int32_t count)
{
    const gn_receiver *receiver = context->settings.receiver;
    const gn_reconstruction *how = context->settings.reconstruction;
    how = how ? how : receiver->nearest;
    gn_lookup lookup = make_lookup(context, how);
    uint32_t *q = worker->q + from;
    gn_points points;
    if (!context->camera_view.affine)
        gn_row_of_w(q, count, context->shading.w_shift);
    for (int32_t done = 0; done < count; done += GN_BLOCK, q += GN_BLOCK) {
        points.triangle = worker->triangle + from + done;
        points.x = x + done;
        points.y = y;
        points.count = count - done < GN_BLOCK ? count - done : GN_BLOCK;
        gn_find_points(context, &points, q);
        if (receiver && receiver->prepare)
            receiver->prepare(context, worker, &points);
        if (!receiver || receiver->votes)
            how->vote(&lookup, &points);
#if GN_STATISTICS
        for (int32_t i = 0; i < points.count; i++)
            points.stage[i] = GN_AGREED;
#endif
        if (receiver && receiver->resample)
            receiver->resample(context, worker, &lookup, &points, how->sample);
        write_nearest(context, &points, q);
        if (how->colour)
            write_fractions(&points, how->whole, worker->fraction + done);
#if GN_STATISTICS
        count_stages(context, worker, &points, how);
#endif
    }
}
