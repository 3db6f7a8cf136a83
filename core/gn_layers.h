/* Depth layers as the light pass draws them: what a triangle is inserted into, and how. */
#ifndef GN_LAYERS_H
#define GN_LAYERS_H

#include "gn_context.h"
#include "gn_grid.h"
#include "gn_tally.h"

#define GN_DEPTH_SHIFT (32 - GN_DEPTH_BITS)

typedef enum gn_insertion {
    GN_INSERT_FIRST,
    GN_INSERT_TWO,
    GN_INSERT_TWICE,
    GN_INSERT_MARKED,
    GN_INSERT_RISING
} gn_insertion;

typedef struct gn_layer_target {
    gn_depth *first;       /* of the map's first row */
    gn_depth *second;      /* of the region's first row; 0: the first layer alone */
    int32_t second_offset; /* texels from the map's first row to the region's */
    int32_t stride;
    gn_depth_plane plane;
    uint32_t open; /* 1: mark as open (mixed) */
    uint32_t rise; /* h of the plane, units of z (slope) */
    int steep;     /* too steep for plane: the other one */
    gn_wide_plane steep_plane;
    gn_insertion how;
    uint32_t object, object_end; /* what is drawn of the scene: [object, object_end) */
    const gn_grid *grid;         /* of a warped map; 0: texels lie evenly */
    int32_t row, end;            /* grid: rows of texels that may be written, [row, end) */
#if GN_VECTOR_16
    gn_u32x16 lanes; /* the plane's step to each of 16 texels */
#endif
    GN_TALLY(gn_tally *tally;)
} gn_layer_target;

/* gn_light_pass.c: the target's objects into the rows [row, end) of the map. */
void gn_draw_rows(const gn_context *context, gn_layer_target *t, uint32_t row, uint32_t end);

/* The depths are stepped in 32 bits and cut to the stored width: 16-bit layers are the upper half of 32-bit ones. */
GN_INLINE uint32_t gn_start_depth(const gn_layer_target *t, int32_t row, int32_t left)
{
    return t->plane.base + (uint32_t)row * t->plane.dy + (uint32_t)left * t->plane.dx;
}

GN_INLINE void gn_insert_first(gn_depth *z1, gn_depth v)
{
    if (v < *z1)
        *z1 = v;
}

GN_INLINE void gn_insert_two(gn_depth *z1, gn_depth *z2, gn_depth v)
{
    if (v < *z2) { /* usually not */
        gn_depth nearest = *z1;
        if (v < nearest) {
            *z2 = nearest;
            *z1 = v;
        } else {
            *z2 = v;
        }
    }
}

GN_INLINE void gn_insert_twice(gn_depth *z1, gn_depth *z2, gn_depth v)
{
    if (v < *z2) {
        *z2 = v;
        if (v < *z1)
            *z1 = v;
    }
}

GN_INLINE gn_depth gn_cut_layer(uint32_t z, gn_insertion how, uint32_t open)
{
    z >>= GN_DEPTH_SHIFT;
    return (gn_depth)(how == GN_INSERT_MARKED ? (z & ~1u) | open : z);
}

/* z + h, held within the range. */
GN_INLINE uint32_t gn_risen(uint32_t z, uint32_t rise)
{
    uint32_t sum = z + rise;
    return sum < rise ? 0xffffffffu : sum;
}

#endif
