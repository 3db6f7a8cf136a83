/* Virtual samples (Wang & Molnar 1994, 3.2 and 3.4): the receiver's own plane, sampled where the map has samples.
 *
 * gn_virtual follows the paper's rule of three: texels vote with the point's depth; all lit: lit; all shadowed:
 * shadowed; else each texel that counts is compared with the depth of the plane at the texel's centre. Only these last
 * pixels need a plane. gn_virtual_always asks the plane at once: dearer, and right for every lone plane.
 *
 * With no reconstruction the four texels about the point vote and the one that holds it counts. Their votes take
 * the point to be nearer by the error of its depth, so that a level plane, where all five depths are one, is not
 * shadowed by its own rounding. */
#include "gn_around.h"

static void move_nearer(const gn_context *context, gn_worker *worker, gn_points *points)
{
    (void)context, (void)worker;
    for (int32_t i = 0; i < points->count; i++)
        points->z[i] = points->z[i] > GN_POINT_ERROR ? points->z[i] - GN_POINT_ERROR : 0;
}

/* The place of a pixel whose W was w. */
static GN_NOINLINE void open_point(const gn_context *context, gn_points *points, uint32_t i, uint32_t w, uint32_t bits)
{
    const gn_shading *s = &context->shading;
    uint32_t place[3];
    for (int k = 0; k < 3; k++) {
        gn_runner r = gn_start_row(&s->coordinate[k], points->x + (int32_t)i, points->y);
        place[k] = gn_step(&r, w);
    }
    points->u[i] = place[0] - ((uint32_t)1 << (bits - 1));
    points->v[i] = place[1] - ((uint32_t)1 << (bits - 1));
    points->z[i] = (place[2] << (16u - s->depth_bits)) - GN_POINT_ERROR;
}

#if GN_VECTOR
/* In vectors: the index of the first of the four texels about each pixel in points->z, its depth in points->v; then the
 * votes. The index of a place where no point should be is found again. */
static void vote_by_footprints(const gn_lookup *lookup, gn_points *points, uint32_t *q, uint32_t depth_bits)
{
    const gn_lookup l = *lookup;
    gn_runner u = points->row[0], v = points->row[1], z = points->row[2];
    int32_t count = points->count;
    z.a -= GN_POINT_ERROR >> (16 - depth_bits);
    for (int32_t i = 0; i < count; i++) {
        uint32_t w = q[i], step = (uint32_t)i, column = (u.a + gn_w_product(w, u.b + step * u.b_dx)) >> l.bits;
        uint32_t row = (v.a + gn_w_product(w, v.b + step * v.b_dx)) >> l.bits;
        points->z[i] = column < l.last_column && row < l.last_row ? row * l.stride + column : GN_NO_INDEX;
        points->v[i] = gn_cut_raw(z.a + gn_w_product(w, z.b + step * z.b_dx), depth_bits);
    }
    for (int32_t i = 0; i < count; i++) {
        const gn_depth *texel = l.map + points->z[i];
        uint32_t vote;
        if (GN_UNLIKELY(points->z[i] == GN_NO_INDEX)) {
            uint32_t column = (u.a + gn_w_product(q[i], u.b + (uint32_t)i * u.b_dx)) >> l.bits;
            uint32_t row = (v.a + gn_w_product(q[i], v.b + (uint32_t)i * v.b_dx)) >> l.bits;
            vote = gn_look_beyond(&l, column, row, points->v[i]);
        } else {
            vote = gn_agree(texel, texel + l.stride, points->v[i]);
        }
        if (vote == GN_OPEN)
            points->open[points->open_count++] = (uint8_t)i;
        else
            q[i] = vote;
    }
    gn_end_block(points);
}
#else
/* The number of the first of the four texels about each pixel, in points->z; rows are not padded. */
static GN_NOINLINE void find_footprints(const gn_lookup *lookup, gn_points *points, const uint32_t *q)
{
    gn_runner u = points->row[0], v = points->row[1];
    const uint32_t bits = lookup->bits, width = lookup->stride, last = gn_last_footprint(lookup);
    uint32_t *out = points->z, *end = out + points->count;
    do {
        uint32_t w = *q++, column = (u.a + gn_w_product(w, u.b)) >> bits;
        uint32_t number = ((v.a + gn_w_product(w, v.b)) >> bits) * width + column;
        u.b += u.b_dx;
        v.b += v.b_dx;
        *out++ = number > last ? last : number;
    } while (out != end);
    points->row[0].b = u.b;
    points->row[1].b = v.b;
}

/* Votes by the footprints in points->z. */
static GN_NOINLINE void vote_by_numbers(const gn_lookup *lookup, gn_points *points, uint32_t *q, uint32_t depth_bits)
{
    const uint32_t below = lookup->stride, across = below + 1, dx = points->row[2].b_dx;
    const uint32_t a = points->row[2].a - (GN_POINT_ERROR >> (16 - depth_bits));
    const gn_depth *map = lookup->map;
    const uint32_t *first = points->z;
    uint32_t b = points->row[2].b, *end = q + points->count;
    points->row[2].b = b + (uint32_t)points->count * dx;
    do {
        uint32_t depth = gn_cut_raw(a + gn_w_product(*q++, b), depth_bits);
        const gn_depth *texel = map + *first++;
        uint32_t vote = gn_compare(depth, texel[0]);
        b += dx;
        int open = (int32_t)vote >= 0 ? depth > texel[1] || depth > texel[below] || depth > texel[across]
                                      : depth <= texel[1] || depth <= texel[below] || depth <= texel[across];
        if (GN_UNLIKELY(open))
            points->open[points->open_count++] = (uint8_t)(points->count - 1 - (end - q));
        else
            q[-1] = vote;
    } while (q != end);
}

static void vote_by_footprints(const gn_lookup *lookup, gn_points *points, uint32_t *q, uint32_t depth_bits)
{
    find_footprints(lookup, points, q);
    vote_by_numbers(lookup, points, q, depth_bits);
}
#endif

/* A perspective camera, and a directional light whose box holds every point well inside: the common case. */
static void vote_sunlit(const gn_context *context, const gn_lookup *lookup, gn_points *points, uint32_t *q)
{
    vote_by_footprints(lookup, points, q, context->shading.depth_bits);
    for (int32_t n = 0; n < points->open_count; n++)
        open_point(context, points, points->open[n], q[points->open[n]], lookup->bits);
}

/* As gn_shade.c does it, with four texels for one. */
static void vote_spotlit(const gn_context *context, const gn_lookup *lookup, gn_points *points, uint32_t *q)
{
    const gn_shading *s = &context->shading;
    const gn_view *light = &context->light_view;
    gn_runner u = points->row[0], v = points->row[1], d = points->row[2];
    const uint32_t width = lookup->last_column + 1, height = lookup->last_row + 1;
    for (int32_t i = 0; i < points->count; i++) {
        uint32_t w = q[i], left = gn_step(&u, w), top = gn_step(&v, w), distance = gn_step(&d, w);
        q[i] = GN_DARK;
        if (gn_outside_frustum(s, left, top, distance)) {
            points->u[i] = GN_NOWHERE;
            continue; /* unlit */
        }
        uint32_t nearness = gn_divide_place(s, &left, &top, distance);
        uint32_t place_u = (uint32_t)(gn_multiply_u(left, width) >> 12) - GN_SPOT_HALF;
        uint32_t place_v = (uint32_t)(gn_multiply_u(top, height) >> 12) - GN_SPOT_HALF;
        uint32_t z = gn_spot_depth(light, nearness);
        z = z > GN_POINT_ERROR ? z - GN_POINT_ERROR : 0;
        uint32_t vote = gn_look(lookup, place_u, place_v, gn_cut(z));
        if (vote == GN_DARK)
            continue;
        q[i] = gn_over_distance(nearness, left, top, context->tan_squared);
        if (vote == GN_OPEN) {
            points->u[i] = place_u;
            points->v[i] = place_v;
            points->z[i] = z;
            points->open[points->open_count++] = (uint8_t)i;
        }
    }
    gn_end_block(points);
}

static const gn_reconstruction nearest = {gn_cascade_row, gn_vote_around, gn_sample_nearest, 0, GN_DARK, 4, 1, 0, 0};

/* The shadowed shares of a point, by virtual samples. Where there is no plane, its own depth is level. */
static uint32_t resample(const gn_context *context, gn_worker *worker, const gn_lookup *lookup, gn_points *points,
                         gn_sample *sample, int32_t i)
{
    if (points->triangle[i] == GN_NO_TRIANGLE)
        return 0;
    const gn_receiver_plane *plane =
        gn_find_plane(context, worker, points->triangle[i], gn_face_of(context, points, i));
    if (!plane->faces_light)
        return lookup->whole;
    gn_wide_plane nearer = {points->z[i], 0, 0};
    if (plane->exists) {
        nearer = plane->plane;
        nearer.base -= plane->slack;
    }
#if GN_STATISTICS
    points->resampled[i] = 1;
#endif
    return sample(lookup, points, i, &nearer);
}

static void resample_open(const gn_context *context, gn_worker *worker, const gn_lookup *lookup, gn_points *points,
                          gn_sample *sample)
{
    for (int32_t n = 0; n < points->open_count; n++) {
        int32_t i = points->open[n];
        points->dark[i] = resample(context, worker, lookup, points, sample, i);
    }
}

static void resample_all(const gn_context *context, gn_worker *worker, const gn_lookup *lookup, gn_points *points,
                         gn_sample *sample)
{
    for (int32_t i = 0; i < points->count; i++)
        points->dark[i] = points->u[i] == GN_NOWHERE ? gn_dark_nowhere(lookup, points->z[i])
                                                     : resample(context, worker, lookup, points, sample, i);
}

const gn_receiver gn_virtual = {gn_cascade_row, move_nearer, resample_open, vote_sunlit, vote_spotlit, &nearest, 1};
const gn_receiver gn_virtual_always = {gn_cascade_row, 0, resample_all, 0, 0, &nearest, 0};
