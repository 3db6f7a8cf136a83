/* The cascade of the shadow test: what receivers and reconstructions are made of (docs/shadow-test.md).
 *
 * A row is tested in blocks of points in light space. Texels vote with the point's own depth; where they disagree, a
 * receiver that has virtual samples compares again; what is then known of a pixel is how many of its reconstruction's
 * shares are lit. Comparisons are weighted, never depths. Lit where z <= stored, at every stage: a plane that lies
 * exactly on the stored depth does not shadow itself. Wang & Molnar's figure 10 has < for virtual samples; then every
 * open plane would.
 *
 * Memory: 16 bytes a point of the block on the stack; 32 bytes an entry of the cache of planes; a byte a pixel of a
 * region's row where there are fractions. */
#ifndef GN_CASCADE_H
#define GN_CASCADE_H

#include "gn_context.h"

/* Points of a block. Trades stack against the cost of starting a block; never changes a pixel. */
#ifndef GN_BLOCK
#define GN_BLOCK (GN_VECTOR ? 128 : 32)
#endif

#define GN_NOWHERE 0xffffffffu /* u of a point that the map does not hold: z 0 lit, else shadowed */

/* The map as points see it, kept in registers. */
typedef struct gn_lookup {
    const gn_depth *map;
    uint32_t stride;
    uint32_t last_column, last_row;
    uint32_t bits;  /* fraction bits of u and v, 8 to 18 */
    uint32_t whole; /* shares of the reconstruction */
} gn_lookup;

/* What a point is lit by that lies nowhere on the map. */
GN_INLINE uint32_t gn_lit_nowhere(const gn_lookup *lookup, uint32_t z)
{
    return z ? 0 : lookup->whole;
}

/* The error of a point's depth, of 2^32, where rounding alone makes it (docs/number-formats.md). */
#define GN_POINT_ERROR 0x10000u

typedef enum gn_stage { GN_OUTSIDE, GN_AGREED, GN_RESAMPLED } gn_stage;

typedef struct gn_points {
    uint32_t u[GN_BLOCK], v[GN_BLOCK]; /* in texels; < 2^31, or GN_NOWHERE */
    uint32_t z[GN_BLOCK];              /* as the light pass steps it, 32 bits */
    uint32_t lit[GN_BLOCK];            /* shares that are lit, 0 to whole */
    const uint32_t *triangle;          /* that the pixels see */
    int32_t x, y, count;               /* pixels (x + i, y) */
#if GN_STATISTICS
    uint8_t stage[GN_BLOCK]; /* gn_stage that decided */
#endif
} gn_points;

/* The plane of a triangle. At the centre of a texel that the triangle covers, its depth is the one that the light pass
 * inserted there, bit for bit. */
typedef struct gn_receiver_plane {
    gn_wide_plane plane;
    uint32_t triangle;
    uint8_t exists;      /* 0: the light sees the triangle edge-on, or not at all */
    uint8_t faces_light; /* camera and light are on the same side: else it is shadowed whatever the map says */
} gn_receiver_plane;

typedef void gn_row_shader(gn_context *context, gn_worker *worker, uint32_t from, int32_t x, int32_t y, int32_t count);
typedef void gn_vote(const gn_lookup *lookup, gn_points *points);
typedef uint32_t gn_sample(const gn_lookup *lookup, const gn_points *points, int32_t i, const gn_receiver_plane *plane);

struct gn_receiver {
    gn_row_shader *shade; /* gn_cascade_row */
    /* before the votes, and after them; either may be 0 */
    void (*prepare)(const gn_context *context, gn_worker *worker, gn_points *points);
    void (*resample)(const gn_context *context, gn_worker *worker, const gn_lookup *lookup, gn_points *points,
                     gn_sample *sample);
    const gn_reconstruction *nearest; /* what stands for no reconstruction */
    uint8_t votes;                    /* 0: resample decides every point */
};

struct gn_reconstruction {
    gn_row_shader *shade;     /* gn_cascade_row */
    gn_vote *vote;            /* sets lit of all points, by their own depth; more than 0 and less than whole: open */
    gn_sample *sample;        /* the lit shares of a point, by its plane */
    gn_colour_shader *colour; /* of fractions; 0: there are none */
    uint32_t whole;           /* shares, at most 2^16 */
    uint8_t votes, samples;   /* depths that vote and sample compare */
};

/* Test count pixels of a row, from worker->q[from] on: what gn_shade_row does, with the settings' receiver and
 * reconstruction; worker->fraction: the lit parts of 254. */
void gn_cascade_row(gn_context *context, gn_worker *worker, uint32_t from, int32_t x, int32_t y, int32_t count);

/* gn_points.c: the points of a block of pixels, from W in q. Spot: q becomes near / distance, Q2.30. */
void gn_find_points(const gn_context *context, gn_points *points, uint32_t *q);
uint32_t gn_point_bits(const gn_context *context);

/* gn_receiver_plane.c: the plane of the triangle that a pixel sees, from the worker's cache. Two roundings of a plane
 * are possible, by the light pass and here: they are one function. */
const gn_receiver_plane *gn_find_plane(const gn_context *context, gn_worker *worker, uint32_t triangle);

/* gn_fraction.c: as gn_colour_row, with the worker's fractions. */
gn_colour_shader gn_colour_fractions;

/* As the light pass cuts depths. */
GN_INLINE uint32_t gn_cut(uint32_t z)
{
    return z >> (32 - GN_DEPTH_BITS);
}

#endif
