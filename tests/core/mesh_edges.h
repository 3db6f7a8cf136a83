/* Edges of the shapes of scenes.h: half-edges paired by the places of their ends. */
#ifndef MESH_EDGES_H
#define MESH_EDGES_H

#include "scenes.h"

static TAP_UNUSED int same_place(const int32_t a[3], const int32_t b[3])
{
    return a[0] == b[0] && a[1] == b[1] && a[2] == b[2];
}

static const int32_t *corner_of(const shape *s, uint32_t half)
{
    return s->vertices[s->indices[half]];
}

static uint32_t next_corner(uint32_t half)
{
    return half % 3 == 2 ? half - 2 : half + 1;
}

/* 1: the same way, -1: the other way, 0: not on one edge. */
static int together(const shape *s, uint32_t p, uint32_t q)
{
    const int32_t *a = corner_of(s, p), *b = corner_of(s, next_corner(p));
    const int32_t *c = corner_of(s, q), *d = corner_of(s, next_corner(q));
    return same_place(a, c) && same_place(b, d) ? 1 : same_place(a, d) && same_place(b, c) ? -1 : 0;
}

static TAP_UNUSED int is_point(const shape *s, uint32_t triangle)
{
    const int32_t *a = corner_of(s, 3 * triangle), *b = corner_of(s, 3 * triangle + 1);
    const int32_t *c = corner_of(s, 3 * triangle + 2);
    return same_place(a, b) || same_place(b, c) || same_place(c, a);
}

/* Pair each half-edge with the next that runs the other way, else with the next that runs the same way. */
static void make_edges(shape *s)
{
    uint32_t halves = 3 * s->mesh.triangle_count;
    gn_mesh_edge *edges = grown(0, (halves + 1) * sizeof *edges);
    uint8_t *taken = grown(0, halves + 1);
    memset(taken, 0, halves + 1);
    s->mesh.edge_count = 0;
    for (uint32_t p = 0; p < halves; p++) {
        uint32_t partner = GN_NO_HALF_EDGE;
        if (taken[p] || is_point(s, p / 3))
            continue;
        for (int way = -1; way <= 1 && partner == GN_NO_HALF_EDGE; way += 2)
            for (uint32_t q = p + 1; q < halves && partner == GN_NO_HALF_EDGE; q++)
                if (!taken[q] && !is_point(s, q / 3) && together(s, p, q) == way) {
                    partner = way > 0 ? q | GN_SAME_DIRECTION : q;
                    taken[q] = 1;
                }
        edges[s->mesh.edge_count].half[0] = p;
        edges[s->mesh.edge_count++].half[1] = partner;
    }
    free(taken);
    s->mesh.edges = edges;
}

static TAP_UNUSED gn_mesh_edge *edges_of(const shape *s)
{
    return (gn_mesh_edge *)(uintptr_t)s->mesh.edges;
}

#endif
