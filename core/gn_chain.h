/* The left and the right side of a triangle, found at any row: what gn_walk steps from row to row. Each is one edge or
 * two that meet in a middle vertex. Cost: a row two divisions of 32 bits. */
#ifndef GN_CHAIN_H
#define GN_CHAIN_H

#include "gn_raster.h"

/* An edge from its upper vertex down. */
typedef struct gn_side {
    const gn_vertex *upper;
    int32_t quotient;
    uint32_t rest, height; /* height 0: no row's centre lies beside it */
} gn_side;

typedef struct gn_chain {
    gn_side part[2];
    int32_t middle; /* the first row of part[1] */
} gn_chain;

GN_INLINE gn_side gn_make_side(const gn_vertex *upper, const gn_vertex *lower)
{
    gn_side s = {upper, 0, 0, 0};
    if (lower->y <= upper->y)
        return s;
    int32_t dx = lower->x - upper->x;
    uint32_t width = dx < 0 ? 0u - (uint32_t)dx : (uint32_t)dx;
    s.height = (uint32_t)(lower->y - upper->y);
    s.quotient = (int32_t)(width / s.height);
    s.rest = width - (uint32_t)s.quotient * s.height;
    if (dx < 0) { /* floor and its remainder, which is never negative */
        s.quotient = -s.quotient;
        if (s.rest) {
            s.quotient--;
            s.rest = s.height - s.rest;
        }
    }
    return s;
}

GN_INLINE void gn_make_chains(gn_chain *left, gn_chain *right, const gn_rows *rows)
{
    left->part[0] = gn_make_side(rows->top, rows->last);
    left->part[1] = gn_make_side(rows->last, rows->next);
    left->middle = rows->row_last;
    right->part[0] = gn_make_side(rows->top, rows->next);
    right->part[1] = gn_make_side(rows->next, rows->last);
    right->middle = rows->row_next;
}

/* The first column whose centre is at or right of the chain, at the centre of a row of the triangle: exactly gn_edge's
 * x. The ceiling of n / d is floor((n - 1) / d) + 1. */
GN_INLINE int32_t gn_chain_at(const gn_chain *chain, int32_t row)
{
    const gn_side *s = &chain->part[row >= chain->middle];
    uint32_t t = (uint32_t)(256 * row + 128 - s->upper->y);
    uint64_t n = gn_multiply_u(t, s->rest) + s->height - 1;
    uint32_t share = GN_LIKELY(n >> 32 == 0) ? (uint32_t)n / s->height : gn_divide(n, s->height);
    uint32_t u = (uint32_t)(s->upper->x - 129 + (int32_t)t * s->quotient) + share;
    return gn_floor_shift((int32_t)u, 8) + 1;
}

#endif
