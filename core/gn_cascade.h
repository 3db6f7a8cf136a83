/* The cascade of the shadow test: what receivers and reconstructions are made of (docs/shadow-test.md).
 *
 * A row is tested in blocks of points in light space. Texels vote with the point's own depth; where they disagree, a
 * receiver that has virtual samples compares again; what is then known of a pixel is how many of its reconstruction's
 * shares are lit. Comparisons are weighted, never depths. Lit where z <= stored, at every stage: a plane that lies
 * exactly on the stored depth does not shadow itself. Wang & Molnar's figure 10 has < for virtual samples; then every
 * open plane would.
 *
 * Memory: 17 bytes a point of the block on the stack; 40 bytes an entry of the cache of planes; a byte a pixel of a
 * region's row where there are fractions. */
#ifndef GN_CASCADE_H
#define GN_CASCADE_H

#include "gn_shade.h"

/* Points of a block, at most 256. Trades stack against the cost of starting a block; never changes a pixel. */
#ifndef GN_BLOCK
#define GN_BLOCK 96
#endif
#if GN_BLOCK < 1 || GN_BLOCK > 256
#error "GN_BLOCK must be 1 to 256"
#endif

#define GN_NOWHERE 0x80000000u /* u of a point that the map does not hold: z 0 lit, else, the farthest, shadowed */

/* The map as points see it, kept in registers. */
typedef struct gn_lookup {
    const gn_depth *map;
    uint32_t stride;
    uint32_t last_column, last_row;
    uint32_t bits;                  /* fraction bits of u and v, 8 to 18 */
    uint32_t inside;                /* 1: no point lies at the border, but for what gn_index says */
    uint32_t whole;                 /* shares of the reconstruction */
    const uint8_t *silhouettes;     /* the silhouette or crossing map; 0 without */
    const uint16_t *columns, *rows; /* of gn_grid, where the map is warped: the plane of a receiver is in fine texels */
    const gn_reconstruction *how;
    const gn_grid *grid; /* 0: the map is uniform */
    const gn_context *context;
    gn_worker *worker;
} gn_lookup;

/* The shadowed shares of a point that lies nowhere on the map. */
GN_INLINE uint32_t gn_dark_nowhere(const gn_lookup *lookup, uint32_t z)
{
    return z ? lookup->whole : 0;
}

/* The texel that holds a place u or v. */
GN_INLINE uint32_t gn_texel(uint32_t place, uint32_t last, uint32_t bits)
{
    return gn_hold(place + ((uint32_t)1 << (bits - 1)), bits, last);
}

/* The first of the two texels about a place u or v; at the border the last ones. */
GN_INLINE uint32_t gn_first_of_two(uint32_t place, uint32_t last, uint32_t bits)
{
    uint32_t texel = place >> bits;
    return GN_LIKELY(texel < last) ? texel : place >> 31 ? 0 : last - 1;
}

/* The usual error of a point's depth, of 2^32; more for far eyes and planes seen edge-on (docs/number-formats.md). By
 * so much nearer it votes where virtual samples may follow, so that a level plane, where all depths are one, is not
 * shadowed by its own rounding. */
#define GN_POINT_ERROR 0x10000u

/* The one share of a single texel: what a shadowed pixel's q becomes. */
#define GN_DARK 0x80000000u

typedef struct gn_points {
    uint32_t u[GN_BLOCK], v[GN_BLOCK]; /* in texels, from the centre of the first one, modulo 2^32; or GN_NOWHERE */
    uint32_t z[GN_BLOCK];              /* as the light pass steps it, 32 bits */
    uint32_t *dark;                    /* shares that are shadowed, 0 to whole: q itself, or these: */
    uint32_t shares[GN_BLOCK];
    const uint32_t *triangle; /* that the pixels see */
    int32_t x, y, count;      /* pixels (x + i, y) */
    gn_runner row[3];         /* the view's expressions at pixel (x, y); directional: u, v as above */
    int32_t open_count;       /* points on which the texels disagree, and their numbers */
    uint8_t open[GN_BLOCK];
#if GN_STATISTICS
    uint8_t resampled[GN_BLOCK];     /* 1: decided by virtual samples */
    uint8_t reconstructed[GN_BLOCK]; /* 1: decided by the silhouette map */
#endif
} gn_points;

/* The plane of a triangle. At the centre of a texel that the triangle covers, its depth is the one that the light pass
 * inserted there, bit for bit. */
typedef struct gn_receiver_plane {
    gn_wide_plane plane;
    int64_t slack; /* how much nearer its neighbour in one flat wall may be stored, units of z */
    uint32_t triangle;
    uint8_t face;        /* of a point light, else 0 */
    uint8_t exists;      /* 0: the light sees the triangle edge-on, or not at all */
    uint8_t faces_light; /* camera and light are on the same side: else it is shadowed whatever the map says */
} gn_receiver_plane;

/* Of a plane by its own rounding, units of z (docs/number-formats.md). */
#define GN_PLANE_ERROR 0x8000

/* Take the view's expressions to the next block. */
GN_INLINE void gn_end_block(gn_points *points)
{
    for (int k = 0; k < 3; k++) {
        points->row[k].a += (uint32_t)points->count * points->row[k].a_dx;
        points->row[k].b += (uint32_t)points->count * points->row[k].b_dx;
    }
}

/* Half a texel of a spot light's u and v; fraction bits of a point light's, whose six maps lie below each other. */
#define GN_SPOT_HALF ((uint32_t)1 << 17)
#define GN_FACE_BITS 16

/* What a vote found of point i. */
GN_INLINE void gn_vote_is(gn_points *points, int32_t i, uint32_t dark, uint32_t whole)
{
    points->dark[i] = dark;
    if (dark != 0 && dark != whole)
        points->open[points->open_count++] = (uint8_t)i;
}

typedef void gn_row_shader(gn_context *context, gn_worker *worker, uint32_t from, int32_t x, int32_t y, int32_t count);
typedef void gn_vote_at_once(const gn_context *context, const gn_lookup *lookup, gn_points *points, uint32_t *q);
typedef void gn_vote(const gn_lookup *lookup, gn_points *points);
typedef uint32_t gn_sample(const gn_lookup *lookup, gn_points *points, int32_t i, const gn_wide_plane *plane);

struct gn_receiver {
    gn_row_shader *shade; /* gn_cascade_row */
    /* before the votes, and after them; any may be 0 */
    void (*prepare)(const gn_context *context, gn_worker *worker, gn_points *points);
    void (*resample)(const gn_context *context, gn_worker *worker, const gn_lookup *lookup, gn_points *points,
                     gn_sample *sample);
    /* Points and votes of the nearest texel in one, where that is faster, else 0: for a perspective camera and a
     * directional light whose box needs no test; for spot lights. q: 0 lit (spot: near / distance), GN_DARK. */
    gn_vote_at_once *sunlit, *spotlit;
    const gn_reconstruction *nearest; /* what stands for no reconstruction */
    uint8_t votes;                    /* 0: resample decides every point */
};

struct gn_reconstruction {
    gn_row_shader *shade;     /* gn_cascade_row */
    gn_vote *vote;            /* sets dark of all points by their own depth, and says which are open */
    gn_sample *sample;        /* the shadowed shares of a point, by a plane */
    gn_colour_shader *colour; /* gn_colour_fractions, or gn_colour_row where whole is GN_DARK */
    uint32_t whole;           /* shares: at most 2^16, or GN_DARK */
    uint8_t votes, samples;   /* depths that vote and sample compare */
    /* Decides open points where a receiver has no resample; 0: they stay as they are. */
    void (*settle)(const gn_reconstruction *how, const gn_lookup *lookup, gn_points *points);
    const gn_drawing *drawing; /* what the light pass draws for it beside depths; 0: nothing */
};

/* gn_plan.c: what the light pass draws beside depths, or 0. */
const gn_drawing *gn_find_drawing(const gn_settings *settings);

/* Test count pixels of a row, from worker->q[from] on: what gn_shade_row does, with the settings' receiver and
 * reconstruction; worker->fraction: the lit parts of 254. */
void gn_cascade_row(gn_context *context, gn_worker *worker, uint32_t from, int32_t x, int32_t y, int32_t count);

/* gn_points.c: begin a row at points->x, y; the points of its next block of pixels, from W in q. Spot: q becomes near /
 * distance, Q2.30. Leaves points->row at the end of the block. */
void gn_start_points(const gn_context *context, gn_points *points);
void gn_find_points(const gn_context *context, gn_points *points, uint32_t *q);
uint32_t gn_point_bits(const gn_context *context);

/* gn_receiver_plane.c: the plane of the triangle that a pixel sees, from the worker's cache; the face of a point
 * light that point i, which lies on the map, is on. */
const gn_receiver_plane *gn_find_plane(const gn_context *context, gn_worker *worker, uint32_t triangle, uint32_t face);
uint32_t gn_face_of(const gn_context *context, const gn_points *points, int32_t i);

/* gn_fraction.c: as gn_colour_row, with the worker's fractions. */
gn_colour_shader gn_colour_fractions;

/* As the light pass cuts depths. */
GN_INLINE uint32_t gn_cut(uint32_t z)
{
    return z >> (32 - GN_DEPTH_BITS);
}

#endif
