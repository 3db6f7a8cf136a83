#include "adjacency.h"

#include "memory.h"

#include <stdlib.h>
#include <string.h>

uint32_t adjacency_vertex(const gn_mesh *mesh, uint32_t corner)
{
    return mesh->index_size == 2 ? ((const uint16_t *)mesh->indices)[corner]
                                 : ((const uint32_t *)mesh->indices)[corner];
}

uint32_t adjacency_end(uint32_t half_edge)
{
    return half_edge % 3 == 2 ? half_edge - 2 : half_edge + 1;
}

/* ---- places ---------------------------------------------------------------------------------------------------- */

typedef struct numbered {
    int32_t position[3];
    uint32_t vertex;
} numbered;

static int by_position(const void *a, const void *b)
{
    const numbered *p = a, *q = b;
    for (int i = 0; i < 3; i++)
        if (p->position[i] != q->position[i])
            return p->position[i] < q->position[i] ? -1 : 1;
    return 0;
}

/* For each vertex the number of its place: equal where the positions are, and nowhere else. */
static uint32_t *number_places(const gn_mesh *mesh)
{
    numbered *sorted = memory_take(mesh->vertex_count, sizeof *sorted);
    uint32_t *places = memory_take(mesh->vertex_count, sizeof *places);
    for (uint32_t v = 0; v < mesh->vertex_count; v++) {
        memcpy(sorted[v].position, mesh->vertices[v], sizeof sorted[v].position);
        sorted[v].vertex = v;
    }
    qsort(sorted, mesh->vertex_count, sizeof *sorted, by_position);
    for (uint32_t i = 0, place = 0; i < mesh->vertex_count; i++) {
        place += i && by_position(&sorted[i - 1], &sorted[i]) != 0;
        places[sorted[i].vertex] = place;
    }
    free(sorted);
    return places;
}

/* ---- half-edges ------------------------------------------------------------------------------------------------ */

typedef struct half_edge {
    uint32_t low, high; /* the places of its ends, low < high */
    uint32_t number;    /* with GN_SAME_DIRECTION where it runs from high to low: sorts behind those of the other way */
} half_edge;

static int by_ends_and_direction(const void *a, const void *b)
{
    const half_edge *p = a, *q = b;
    if (p->low != q->low)
        return p->low < q->low ? -1 : 1;
    if (p->high != q->high)
        return p->high < q->high ? -1 : 1;
    return p->number < q->number ? -1 : p->number > q->number;
}

static half_edge half_edge_between(uint32_t from, uint32_t to, uint32_t number)
{
    return from < to ? (half_edge){from, to, number} : (half_edge){to, from, number | GN_SAME_DIRECTION};
}

/* Those of all triangles with three places, sorted: each edge's together, one direction after the other. */
static half_edge *collect_half_edges(const gn_mesh *mesh, size_t *count)
{
    uint32_t *places = number_places(mesh);
    half_edge *halves = memory_take(3 * (size_t)mesh->triangle_count, sizeof *halves);
    *count = 0;
    for (uint32_t first = 0; first < 3 * mesh->triangle_count; first += 3) {
        uint32_t p[3];
        for (uint32_t i = 0; i < 3; i++)
            p[i] = places[adjacency_vertex(mesh, first + i)];
        if (p[0] == p[1] || p[1] == p[2] || p[2] == p[0])
            continue;
        for (uint32_t i = 0; i < 3; i++)
            halves[(*count)++] = half_edge_between(p[i], p[(i + 1) % 3], first + i);
    }
    free(places);
    qsort(halves, *count, sizeof *halves, by_ends_and_direction);
    return halves;
}

/* ---- pairs ----------------------------------------------------------------------------------------------------- */

static uint32_t number_of(const half_edge *half)
{
    return half->number & ~GN_SAME_DIRECTION;
}

/* Make a pair: said at the lower number alone, so that it is listed once. */
static void pair(uint32_t *second, uint32_t a, uint32_t b, uint32_t direction)
{
    second[a < b ? a : b] = (a < b ? b : a) | direction;
}

/* All half-edges of one edge: `forward` of them in one direction, then `backward` in the other. */
static void pair_edge(uint32_t *second, const half_edge *halves, size_t forward, size_t backward)
{
    size_t opposite = forward < backward ? forward : backward;
    for (size_t i = 0; i < opposite; i++)
        pair(second, number_of(&halves[i]), number_of(&halves[forward + i]), 0);
    const half_edge *rest = halves + (forward > backward ? opposite : forward + opposite);
    size_t left = forward + backward - 2 * opposite;
    for (; left >= 2; left -= 2, rest += 2)
        pair(second, number_of(&rest[0]), number_of(&rest[1]), GN_SAME_DIRECTION);
    if (left)
        second[number_of(rest)] = GN_NO_HALF_EDGE;
}

/* second[h]: what stands beside half-edge h in its pair, where h is the lower number; h itself where h is no pair's
 * first. */
static void pair_all(uint32_t *second, const half_edge *halves, size_t count, adjacency_counts *counts)
{
    for (size_t i = 0, next; i < count; i = next) {
        size_t forward = 0;
        for (next = i; next < count && halves[next].low == halves[i].low && halves[next].high == halves[i].high; next++)
            forward += halves[next].number < GN_SAME_DIRECTION;
        pair_edge(second, halves + i, forward, next - i - forward);
        counts->non_manifold += next - i > 2;
    }
}

static void count_pair(adjacency_counts *counts, uint32_t second)
{
    counts->open += second == GN_NO_HALF_EDGE;
    counts->same_direction += second != GN_NO_HALF_EDGE && second >= GN_SAME_DIRECTION;
}

adjacency_counts adjacency_make(gn_mesh *mesh)
{
    adjacency_counts counts = {0};
    uint32_t corners = 3 * mesh->triangle_count, pairs = 0;
    size_t count;
    half_edge *halves = collect_half_edges(mesh, &count);
    uint32_t *second = memory_take(corners, sizeof *second);
    for (uint32_t h = 0; h < corners; h++)
        second[h] = h;
    pair_all(second, halves, count, &counts);
    free(halves);
    for (uint32_t h = 0; h < corners; h++)
        pairs += second[h] != h;
    gn_mesh_edge *edges = memory_take(pairs, sizeof *edges);
    for (uint32_t h = 0, next = 0; h < corners; h++)
        if (second[h] != h) {
            edges[next++] = (gn_mesh_edge){{h, second[h]}};
            count_pair(&counts, second[h]);
        }
    free(second);
    counts.left_out = mesh->triangle_count - (uint32_t)(count / 3);
    mesh->edges = edges;
    mesh->edge_count = pairs;
    return counts;
}
