#include "closed_mesh.h"

#include "memory.h"

#include <stdlib.h>
#include <string.h>

typedef struct edge {
    uint32_t low, high; /* merged vertices, low < high */
    int32_t direction;  /* +1: from low to high */
} edge;

typedef struct numbered {
    double position[3];
    uint32_t vertex;
} numbered;

static int by_position(const void *a, const void *b)
{
    const numbered *p = a, *q = b;
    for (int i = 0; i < 3; i++)
        if (p->position[i] != q->position[i])
            return p->position[i] < q->position[i] ? -1 : 1;
    return p->vertex < q->vertex ? -1 : p->vertex > q->vertex;
}

static int same_position(const numbered *a, const numbered *b)
{
    return a->position[0] == b->position[0] && a->position[1] == b->position[1] && a->position[2] == b->position[2];
}

/* For each vertex the lowest-numbered one at the same position. */
static uint32_t *merge_vertices(const obj_mesh *mesh)
{
    size_t count = mesh->position_count;
    numbered *sorted = memory_take(count, sizeof *sorted);
    uint32_t *merged = memory_take(count, sizeof *merged);
    for (size_t i = 0; i < count; i++) {
        memcpy(sorted[i].position, mesh->positions[i], sizeof sorted[i].position);
        sorted[i].vertex = (uint32_t)i;
    }
    qsort(sorted, count, sizeof *sorted, by_position);
    for (size_t i = 0, first = 0; i < count; i++) {
        if (!same_position(&sorted[i], &sorted[first]))
            first = i;
        merged[sorted[i].vertex] = sorted[first].vertex;
    }
    free(sorted);
    return merged;
}

static int by_ends(const void *a, const void *b)
{
    const edge *p = a, *q = b;
    if (p->low != q->low)
        return p->low < q->low ? -1 : 1;
    return p->high < q->high ? -1 : p->high > q->high;
}

/* Every edge of every triangle but those between merged corners, sorted by their ends. */
static edge *collect_edges(const obj_mesh *mesh, size_t *count)
{
    uint32_t *merged = merge_vertices(mesh);
    edge *edges = memory_take(3 * mesh->triangle_count, sizeof *edges);
    *count = 0;
    for (size_t t = 0; t < mesh->triangle_count; t++)
        for (int i = 0; i < 3; i++) {
            uint32_t a = merged[mesh->triangles[t][i]], b = merged[mesh->triangles[t][(i + 1) % 3]];
            if (a < b)
                edges[(*count)++] = (edge){a, b, 1};
            else if (a > b)
                edges[(*count)++] = (edge){b, a, -1};
        }
    free(merged);
    qsort(edges, *count, sizeof *edges, by_ends);
    return edges;
}

/* Six times the signed volume between the triangle and the first vertex. */
static double volume_below(const obj_mesh *mesh, const uint32_t triangle[3])
{
    double v[3][3];
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++)
            v[i][k] = mesh->positions[triangle[i]][k] - mesh->positions[0][k];
    return v[0][0] * (v[1][1] * v[2][2] - v[1][2] * v[2][1]) + v[0][1] * (v[1][2] * v[2][0] - v[1][0] * v[2][2]) +
           v[0][2] * (v[1][0] * v[2][1] - v[1][1] * v[2][0]);
}

closed_mesh_check check_closed_mesh(const obj_mesh *mesh)
{
    closed_mesh_check check = {.closed = 1};
    size_t count;
    edge *edges = collect_edges(mesh, &count);
    for (size_t i = 0, next; i < count; i = next) {
        long uses[2] = {0, 0};
        for (next = i; next < count && by_ends(&edges[i], &edges[next]) == 0; next++)
            uses[edges[next].direction < 0]++;
        if (uses[0] != uses[1] && check.closed) {
            check.closed = 0;
            check.forward = uses[0];
            check.backward = uses[1];
            memcpy(check.from, mesh->positions[edges[i].low], sizeof check.from);
            memcpy(check.to, mesh->positions[edges[i].high], sizeof check.to);
        }
        check.non_manifold += uses[0] + uses[1] > 2;
    }
    for (size_t t = 0; t < mesh->triangle_count; t++)
        check.volume += volume_below(mesh, mesh->triangles[t]) / 6;
    free(edges);
    return check;
}
