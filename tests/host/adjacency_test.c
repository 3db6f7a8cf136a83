/* Edges of meshes: small ones against pairs written down by hand, random ones against the rules of adjacency.h applied
 * to one half-edge at a time. */
#include "adjacency.h"
#include "packed.h"
#include "procedural.h"
#include "sandbox.h"

enum { OPEN = -1, SAME = 1 << 20, MOST_TRIANGLES = 64, MOST_VERTICES = 64 };

/* A mesh's corners and where they stand; 16 or 32 bits an index. */
typedef struct shape {
    int32_t vertices[MOST_VERTICES][3];
    uint16_t narrow[3 * MOST_TRIANGLES];
    uint32_t wide[3 * MOST_TRIANGLES];
    gn_mesh mesh;
} shape;

static shape s;
static adjacency_counts counts;

static void start(void)
{
    free((void *)(uintptr_t)s.mesh.edges);
    memset(&s, 0, sizeof s);
    s.mesh.vertices = (const int32_t(*)[3])s.vertices;
    s.mesh.indices = s.narrow;
    s.mesh.index_size = 2;
}

static uint32_t vertex(int32_t x, int32_t y, int32_t z)
{
    int32_t *v = s.vertices[s.mesh.vertex_count];
    v[0] = x, v[1] = y, v[2] = z;
    return s.mesh.vertex_count++;
}

/* `count` vertices on a curve without three in a line: where they stand does not matter, only that they differ. */
static void vertices(int count)
{
    for (int32_t i = 0; i < count; i++)
        vertex(i, i * i, i * i * i);
}

static void triangle(uint32_t a, uint32_t b, uint32_t c)
{
    uint32_t corners[3] = {a, b, c};
    for (int i = 0; i < 3; i++) {
        s.wide[3 * s.mesh.triangle_count + (uint32_t)i] = corners[i];
        s.narrow[3 * s.mesh.triangle_count + (uint32_t)i] = (uint16_t)corners[i];
    }
    s.mesh.triangle_count++;
}

static void quadrilateral(uint32_t a, uint32_t b, uint32_t c, uint32_t d)
{
    triangle(a, b, c);
    triangle(a, c, d);
}

/* Eight corners, counter-clockwise from outside. */
static void box(int32_t x, int32_t y, int32_t z)
{
    uint32_t v = s.mesh.vertex_count;
    for (int i = 0; i < 8; i++)
        vertex(x + (i & 1), y + (i >> 1 & 1), z + (i >> 2));
    quadrilateral(v, v + 2, v + 3, v + 1);
    quadrilateral(v + 4, v + 5, v + 7, v + 6);
    quadrilateral(v, v + 1, v + 5, v + 4);
    quadrilateral(v + 2, v + 6, v + 7, v + 3);
    quadrilateral(v, v + 4, v + 6, v + 2);
    quadrilateral(v + 1, v + 3, v + 7, v + 5);
}

static void make(void)
{
    free((void *)(uintptr_t)s.mesh.edges);
    counts = adjacency_make(&s.mesh);
}

/* Are the edges these, in this order? Pairs of half-edges; OPEN, and SAME added for the same direction. */
static int edges_are(const int32_t (*expected)[2], uint32_t count)
{
    make();
    int good = s.mesh.edge_count == count;
    for (uint32_t i = 0; i < s.mesh.edge_count && i < count; i++) {
        uint32_t first = (uint32_t)expected[i][0], second = (uint32_t)expected[i][1];
        if (expected[i][1] == OPEN)
            second = GN_NO_HALF_EDGE;
        else if (expected[i][1] & SAME)
            second = (second & ~(uint32_t)SAME) | GN_SAME_DIRECTION;
        if (s.mesh.edges[i].half[0] == first && s.mesh.edges[i].half[1] == second)
            continue;
        note("edge %u is %u 0x%x, expected %u 0x%x", (unsigned)i, (unsigned)s.mesh.edges[i].half[0],
             (unsigned)s.mesh.edges[i].half[1], (unsigned)first, (unsigned)second);
        good = 0;
    }
    if (s.mesh.edge_count != count)
        note("%u edges, expected %u", (unsigned)s.mesh.edge_count, (unsigned)count);
    return good;
}

#define EDGES_ARE(...) edges_are((const int32_t[][2]){__VA_ARGS__}, sizeof((int32_t[][2]){__VA_ARGS__}) / 8)

static int counts_are(uint32_t open, uint32_t same_direction, uint32_t non_manifold, uint32_t left_out)
{
    if (counts.open == open && counts.same_direction == same_direction && counts.non_manifold == non_manifold &&
        counts.left_out == left_out)
        return 1;
    note("%u open, %u of the same direction, %u non-manifold, %u left out; expected %u %u %u %u", (unsigned)counts.open,
         (unsigned)counts.same_direction, (unsigned)counts.non_manifold, (unsigned)counts.left_out, (unsigned)open,
         (unsigned)same_direction, (unsigned)non_manifold, (unsigned)left_out);
    return 0;
}

/* ---- the rules, one half-edge at a time ------------------------------------------------------------------------ */

static const int32_t *place(const gn_mesh *mesh, uint32_t corner)
{
    return mesh->vertices[mesh->index_size == 2 ? ((const uint16_t *)mesh->indices)[corner]
                                                : ((const uint32_t *)mesh->indices)[corner]];
}

static int equal(const int32_t a[3], const int32_t b[3])
{
    return memcmp(a, b, 3 * sizeof *a) == 0;
}

static int takes_part(const gn_mesh *mesh, uint32_t half)
{
    const int32_t *a = place(mesh, half / 3 * 3), *b = place(mesh, half / 3 * 3 + 1),
                  *c = place(mesh, half / 3 * 3 + 2);
    return !equal(a, b) && !equal(b, c) && !equal(c, a);
}

static int runs(const gn_mesh *mesh, uint32_t half, const int32_t from[3], const int32_t to[3])
{
    return takes_part(mesh, half) && equal(place(mesh, half), from) &&
           equal(place(mesh, half / 3 * 3 + (half + 1) % 3), to);
}

/* What must stand beside a half-edge that takes part: the flag with its partner's number, or GN_NO_HALF_EDGE. */
static uint32_t partner(const gn_mesh *mesh, uint32_t half)
{
    const int32_t *from = place(mesh, half), *to = place(mesh, half / 3 * 3 + (half + 1) % 3);
    uint32_t same[3 * MOST_TRIANGLES], opposite[3 * MOST_TRIANGLES], same_count = 0, opposite_count = 0, rank = 0;
    for (uint32_t h = 0; h < 3 * mesh->triangle_count; h++)
        if (runs(mesh, h, from, to)) {
            rank += h < half;
            same[same_count++] = h;
        } else if (runs(mesh, h, to, from)) {
            opposite[opposite_count++] = h;
        }
    if (rank < opposite_count)
        return opposite[rank];
    uint32_t beside = opposite_count + ((rank - opposite_count) ^ 1);
    return beside < same_count ? same[beside] | GN_SAME_DIRECTION : GN_NO_HALF_EDGE;
}

/* The edges that the rules ask for are exactly those that are there, in the promised order. */
static int follows_the_rules(const gn_mesh *mesh)
{
    uint32_t next = 0;
    for (uint32_t h = 0; h < 3 * mesh->triangle_count; h++) {
        uint32_t second = takes_part(mesh, h) ? partner(mesh, h) : 0;
        if (!takes_part(mesh, h) || (second != GN_NO_HALF_EDGE && (second & ~GN_SAME_DIRECTION) < h))
            continue;
        if (next >= mesh->edge_count || mesh->edges[next].half[0] != h || mesh->edges[next].half[1] != second) {
            note("edge %u of %u is not %u 0x%x", (unsigned)next, (unsigned)mesh->edge_count, (unsigned)h,
                 (unsigned)second);
            return 0;
        }
        next++;
    }
    return next == mesh->edge_count;
}

/* ---- tests ----------------------------------------------------------------------------------------------------- */

static void closed_solids(void)
{
    start();
    vertices(4);
    triangle(0, 2, 1);
    triangle(0, 1, 3);
    triangle(1, 2, 3);
    triangle(0, 3, 2);
    ok(EDGES_ARE({0, 11}, {1, 6}, {2, 3}, {4, 8}, {5, 9}, {7, 10}) && counts_are(0, 0, 0, 0),
       "a_tetrahedron_has_six_pairs");
    start();
    box(0, 0, 0);
    make();
    ok(s.mesh.edge_count == 18 && counts_are(0, 0, 0, 0) && follows_the_rules(&s.mesh), "a_box_has_eighteen_pairs");
    start();
    triangle(vertex(0, 0, 0), vertex(0, 2, 0), vertex(2, 0, 0));
    triangle(vertex(0, 0, 0), vertex(2, 0, 0), vertex(0, 0, 2));
    triangle(vertex(2, 0, 0), vertex(0, 2, 0), vertex(0, 0, 2));
    triangle(vertex(0, 0, 0), vertex(0, 0, 2), vertex(0, 2, 0));
    ok(EDGES_ARE({0, 11}, {1, 6}, {2, 3}, {4, 8}, {5, 9}, {7, 10}) && counts_are(0, 0, 0, 0),
       "vertices_at_one_position_are_one");
}

static void sheets(void)
{
    start();
    vertices(4);
    triangle(0, 1, 2);
    ok(EDGES_ARE({0, OPEN}, {1, OPEN}, {2, OPEN}) && counts_are(3, 0, 0, 0), "a_triangle_has_three_open_edges");
    triangle(2, 1, 3);
    ok(EDGES_ARE({0, OPEN}, {1, 3}, {2, OPEN}, {4, OPEN}, {5, OPEN}) && counts_are(4, 0, 0, 0),
       "an_open_sheet_has_its_border_open");
    start();
    vertices(4);
    triangle(0, 1, 2);
    triangle(1, 2, 3);
    ok(EDGES_ARE({0, OPEN}, {1, 3 | SAME}, {2, OPEN}, {4, OPEN}, {5, OPEN}) && counts_are(4, 1, 0, 0),
       "triangles_of_opposite_winding_are_paired_in_the_same_direction");
    start();
    vertices(3);
    triangle(0, 1, 2);
    triangle(1, 2, 0);
    ok(EDGES_ARE({0, 5 | SAME}, {1, 3 | SAME}, {2, 4 | SAME}) && counts_are(0, 3, 0, 0),
       "a_triangle_that_stands_twice_is_paired_with_itself_in_the_same_direction");
    start();
    vertices(3);
    triangle(0, 1, 2);
    triangle(2, 1, 0);
    ok(EDGES_ARE({0, 4}, {1, 3}, {2, 5}) && counts_are(0, 0, 0, 0), "a_triangle_and_its_back_are_closed");
}

/* Five triangles 0 1 2, 1 2 3 ... around the strip, every second one turned round so that neighbours agree; with an odd
 * number of half turns the last one cannot agree with the first. */
static void moebius_strip(void)
{
    start();
    vertices(5);
    triangle(0, 1, 2);
    triangle(2, 1, 3);
    triangle(2, 3, 4);
    triangle(4, 3, 0);
    triangle(4, 0, 1);
    ok(EDGES_ARE({0, 13 | SAME}, {1, 3}, {2, OPEN}, {4, OPEN}, {5, 6}, {7, 9}, {8, OPEN}, {10, OPEN}, {11, 12},
                 {14, OPEN}) &&
           counts_are(5, 1, 0, 0),
       "a_moebius_strip_has_one_edge_of_the_same_direction");
}

static void non_manifold_edges(void)
{
    start();
    vertices(6);
    triangle(0, 1, 2);
    triangle(0, 1, 3);
    triangle(1, 0, 4);
    ok(EDGES_ARE({0, 6}, {1, OPEN}, {2, OPEN}, {3, OPEN}, {4, OPEN}, {5, OPEN}, {7, OPEN}, {8, OPEN}) &&
           counts_are(7, 0, 1, 0),
       "of_three_triangles_on_an_edge_the_first_of_each_direction_make_a_pair");
    s.mesh.triangle_count = 2;
    triangle(0, 1, 4);
    ok(EDGES_ARE({0, 3 | SAME}, {1, OPEN}, {2, OPEN}, {4, OPEN}, {5, OPEN}, {6, OPEN}, {7, OPEN}, {8, OPEN}) &&
           counts_are(7, 1, 1, 0),
       "of_three_in_one_direction_the_last_stays_open");
    triangle(1, 0, 5);
    make();
    ok(s.mesh.edges[0].half[1] == 9 && s.mesh.edges[3].half[0] == 3 &&
           s.mesh.edges[3].half[1] == (6 | GN_SAME_DIRECTION) && counts_are(8, 1, 1, 0),
       "opposite_directions_go_before_the_same_one");
    start();
    box(0, 0, 0);
    box(1, 1, 0);
    make();
    ok(s.mesh.edge_count == 36 && counts_are(0, 0, 1, 0) && follows_the_rules(&s.mesh),
       "two_boxes_that_share_an_edge_have_pairs_of_opposite_directions");
}

static void degenerate_triangles(void)
{
    start();
    vertices(4);
    triangle(0, 1, 2);
    triangle(1, 1, 2);
    triangle(2, 1, vertex(1, 1, 1));
    triangle(2, 1, 3);
    ok(EDGES_ARE({0, OPEN}, {1, 9}, {2, OPEN}, {10, OPEN}, {11, OPEN}) && counts_are(4, 0, 0, 2),
       "triangles_with_two_corners_at_one_place_are_left_out");
    start();
    triangle(vertex(0, 0, 0), vertex(1, 1, 1), vertex(3, 3, 3));
    ok(EDGES_ARE({0, OPEN}, {1, OPEN}, {2, OPEN}) && counts_are(3, 0, 0, 0),
       "a_triangle_with_three_corners_in_a_line_is_not");
    start();
    vertices(2);
    triangle(0, 0, 1);
    make();
    ok(s.mesh.edges && s.mesh.edge_count == 0 && counts_are(0, 0, 0, 1), "a_mesh_may_have_no_edges_at_all");
}

static void make_random(uint64_t *state)
{
    start();
    uint64_t random = tap_random(state);
    uint32_t corners = 3 + (uint32_t)(random % 20), side = 1 + (uint32_t)(random >> 32) % 4;
    for (uint32_t i = 0; i < corners; i++) {
        uint64_t at = tap_random(state);
        vertex((int32_t)(at % side) - 1, (int32_t)((at >> 16) % side), (int32_t)((at >> 32) % side));
    }
    for (uint64_t i = random >> 8 & 31; i < MOST_TRIANGLES / 2; i++) {
        uint64_t at = tap_random(state);
        triangle((uint32_t)(at % corners), (uint32_t)((at >> 16) % corners), (uint32_t)((at >> 32) % corners));
    }
    if (random >> 40 & 1) {
        s.mesh.indices = s.wide;
        s.mesh.index_size = 4;
    }
}

static void random_meshes(uint64_t cases)
{
    uint64_t state = 1, pairs = 0, same = 0, open = 0, left_out = 0, wrong = 0;
    for (uint64_t i = 0; i < cases && !wrong; i++) {
        make_random(&state);
        make();
        wrong += !follows_the_rules(&s.mesh);
        if (wrong)
            note("case %llu", (unsigned long long)i);
        pairs += s.mesh.edge_count, same += counts.same_direction, open += counts.open, left_out += counts.left_out;
    }
    note("%llu pairs, %llu of them of the same direction, %llu open; %llu triangles left out",
         (unsigned long long)pairs, (unsigned long long)same, (unsigned long long)open, (unsigned long long)left_out);
    ok(!wrong && same && open && left_out && pairs > same + open, "random_meshes_follow_the_rules");
}

/* Of a scene; its edges are made by packed_make_edges. */
static int closed_meshes_without_open_edges(const packed_scene *packed)
{
    int closed = 0;
    for (uint32_t i = 0; i < packed->mesh_count; i++) {
        const gn_mesh *mesh = &packed->meshes[i];
        closed += mesh->closed;
        for (uint32_t e = 0; mesh->closed && e < mesh->edge_count; e++)
            if (mesh->edges[e].half[1] >= GN_SAME_DIRECTION) {
                note("edge %u of mesh %u has 0x%x", (unsigned)e, (unsigned)i, (unsigned)mesh->edges[e].half[1]);
                return -1;
            }
        if (!mesh->edges || (mesh->closed && 2 * mesh->edge_count > 3 * mesh->triangle_count))
            return -1;
    }
    return closed;
}

static void procedural_meshes(void)
{
    char name[64];
    problem why;
    packed_scene packed;
    int closed = 0, good = 1;
    for (int i = 0; i < procedural_count && good; i++) {
        snprintf(name, sizeof name, "%s.scene", procedural_names[i]);
        good = procedural_write(procedural_names[i], sandbox_folder) == 0 &&
               packed_read(&packed, sandbox_path(name), 0, &why) == 0 && packed_make_edges(&packed, 0, &why) == 0;
        int found = good ? closed_meshes_without_open_edges(&packed) : -1;
        good = found >= 0;
        closed += found;
        if (!good)
            note("%s", name);
        packed_free(&packed);
    }
    ok(good && closed == 19, "closed_procedural_meshes_have_pairs_of_opposite_directions_alone");
}

int main(int argc, char **argv)
{
    sandbox_open();
    closed_solids();
    sheets();
    moebius_strip();
    non_manifold_edges();
    degenerate_triangles();
    random_meshes(tap_cases(argc, argv, 20000));
    procedural_meshes();
    start();
    sandbox_close();
    return tap_done();
}
