/* Facings and silhouettes of shadow volumes: facings against integers of 128 bits, windings against the sum over all
 * half-edges at a place, for closed, open, doubled and mirrored meshes; which edges a mesh must have; the statuses of
 * the volumes' functions out of order; a shadow worked out by hand; and that nothing is written outside the block.
 * Cases: 100000 triangles, or GNOMON_CASES; meshes and frames take their part of that. */
#include "gn_silhouette.h"
#include "gn_volumes.h"
#include "scenes.h"

__extension__ typedef __int128 exact;

/* ---- edges, paired one half-edge after the other ----------------------------------------------------------------- */

static void corner(const gn_mesh *mesh, uint32_t half, int32_t place[3])
{
    const uint32_t *index = mesh->indices;
    memcpy(place, mesh->vertices[index[half]], 3 * sizeof *place);
}

static uint32_t next_corner(uint32_t half)
{
    return half % 3 == 2 ? half - 2 : half + 1;
}

static int same_place(const int32_t a[3], const int32_t b[3])
{
    return a[0] == b[0] && a[1] == b[1] && a[2] == b[2];
}

/* 1: the same way, -1: the other way, 0: not on one edge. */
static int together(const gn_mesh *mesh, uint32_t p, uint32_t q)
{
    int32_t a[2][3], b[2][3];
    corner(mesh, p, a[0]);
    corner(mesh, next_corner(p), a[1]);
    corner(mesh, q, b[0]);
    corner(mesh, next_corner(q), b[1]);
    return same_place(a[0], b[0]) && same_place(a[1], b[1])   ? 1
           : same_place(a[0], b[1]) && same_place(a[1], b[0]) ? -1
                                                              : 0;
}

static int is_point(const gn_mesh *mesh, uint32_t triangle)
{
    for (uint32_t i = 0; i < 3; i++) {
        int32_t a[3], b[3];
        corner(mesh, 3 * triangle + i, a);
        corner(mesh, next_corner(3 * triangle + i), b);
        if (same_place(a, b))
            return 1;
    }
    return 0;
}

/* The first of what is left with the next that runs the other way, else with the next that runs the same way: as good
 * a pairing as any. */
static gn_mesh_edge *pair_edges(gn_mesh *mesh)
{
    uint32_t halves = 3 * mesh->triangle_count;
    gn_mesh_edge *edges = grown(0, (halves + 1) * sizeof *edges);
    uint8_t *taken = grown(0, halves + 1);
    memset(taken, 0, halves + 1);
    mesh->edge_count = 0;
    for (uint32_t p = 0; p < halves; p++) {
        uint32_t partner = GN_NO_HALF_EDGE;
        if (taken[p] || is_point(mesh, p / 3))
            continue;
        for (int way = -1; way <= 1 && partner == GN_NO_HALF_EDGE; way += 2)
            for (uint32_t q = p + 1; q < halves && partner == GN_NO_HALF_EDGE; q++)
                if (!taken[q] && !is_point(mesh, q / 3) && together(mesh, p, q) == way) {
                    partner = way > 0 ? q | GN_SAME_DIRECTION : q;
                    taken[q] = 1;
                }
        edges[mesh->edge_count].half[0] = p;
        edges[mesh->edge_count++].half[1] = partner;
    }
    free(taken);
    mesh->edges = edges;
    return edges;
}

static void free_edges(shape *s)
{
    free((void *)(uintptr_t)s->mesh.edges);
    s->mesh.edges = 0;
    shape_free(s);
}

/* ---- facing ------------------------------------------------------------------------------------------------------ */

static int sign_of(exact v)
{
    return (v > 0) - (v < 0);
}

/* Of (b - a) x (c - a) . (to the light). */
static int exact_side(const gn_light *light, int32_t world[3][3])
{
    exact volume = 0;
    for (int i = 0; i < 3; i++) {
        int j = (i + 1) % 3, k = (i + 2) % 3;
        exact n = (exact)(world[1][j] - world[0][j]) * (world[2][k] - world[0][k]) -
                  (exact)(world[1][k] - world[0][k]) * (world[2][j] - world[0][j]);
        volume += n * (light->kind == GN_SPOT ? light->position[i] - world[0][i] : -light->forward[i]);
    }
    return sign_of(volume);
}

static gn_facing exact_facing(const gn_light *light, int32_t world[3][3])
{
    int side = exact_side(light, world), beyond = 0;
    if (side == 0)
        return GN_CASTS_NOTHING;
    for (int v = 0; v < 3 && light->kind == GN_SPOT; v++) {
        exact w = -(exact)light->near_depth * (1 << 30);
        for (int i = 0; i < 3; i++)
            w += (exact)(world[v][i] - light->position[i]) * light->forward[i];
        beyond += w >= 0;
    }
    if (light->kind == GN_SPOT && beyond < 3)
        return beyond ? GN_CROSSES_NEAR : GN_CASTS_NOTHING;
    return side > 0 ? GN_FACES_LIGHT : GN_FACES_AWAY;
}

static gn_light random_light(int64_t reach)
{
    gn_light light;
    int32_t from[3], to[3];
    gn_status status;
    memset(&light, 0, sizeof light);
    do {
        for (int i = 0; i < 3; i++) {
            from[i] = between(-reach, reach);
            to[i] = between(-reach, reach);
        }
        if (between(0, 1))
            status = gn_directional_light(&light, to, 0);
        else
            status = gn_spot_light(&light, from, to, 0, GN_DEGREES(90), between(64, 64 + reach / 2), 1 << 28);
    } while (status != GN_OK);
    return light;
}

/* In the plane of the light, or one step of a coordinate beside it. */
static void turn_edge_on(gn_light *light, int32_t world[3][3])
{
    int32_t s = between(-8, 8), t = between(-8, 8), step = between(-1, 1), axis = between(0, 2);
    for (int i = 0; i < 3; i++) {
        int32_t along = world[1][i] - world[0][i], across = world[2][i] - world[0][i];
        if (light->kind == GN_SPOT)
            light->position[i] = world[0][i] + s * along + t * across;
        else
            light->forward[i] = s * along + t * across;
    }
    if (light->kind == GN_SPOT)
        light->position[axis] += step;
    else
        light->forward[axis] += step;
}

typedef struct facing_tally {
    uint64_t facings[4], edge_on, bad;
} facing_tally;

static void check_facing(facing_tally *c, const gn_light *light, int32_t world[3][3])
{
    static const uint32_t indices[3] = {0, 1, 2};
    gn_mesh mesh;
    gn_object object;
    gn_scene scene;
    uint8_t facings[1] = {0xff};
    uint32_t crossing;
    memset(&mesh, 0, sizeof mesh);
    memset(&object, 0, sizeof object);
    memset(&scene, 0, sizeof scene);
    mesh.vertices = (const int32_t(*)[3])world;
    mesh.indices = indices;
    mesh.vertex_count = 3;
    mesh.triangle_count = 1;
    mesh.index_size = 4;
    object.mesh = &mesh;
    scene.objects = &object;
    scene.object_count = 1;
    gn_facing expected = exact_facing(light, world);
    int good = gn_find_facings(&scene, light, facings, &crossing) == GN_OK && gn_facing_of(facings, 0) == expected &&
               crossing == (expected == GN_CROSSES_NEAR) && gn_light_side(light, world) == exact_side(light, world);
    c->facings[expected]++;
    c->edge_on += exact_side(light, world) == 0;
    if (good || c->bad++ > 4)
        return;
    note("facing %d, expected %d: light kind %d", (int)gn_facing_of(facings, 0), (int)expected, light->kind);
    for (int v = 0; v < 3; v++)
        note("    (%ld %ld %ld)", (long)world[v][0], (long)world[v][1], (long)world[v][2]);
}

static void facings_are_exact(uint64_t cases)
{
    facing_tally c = {{0, 0, 0, 0}, 0, 0};
    for (uint64_t i = 0; i < cases; i++) {
        int32_t world[3][3], reach = 1 << between(2, 24);
        gn_light light = random_light(4 * (int64_t)reach);
        for (int v = 0; v < 9; v++)
            world[v / 3][v % 3] = between(-reach, reach);
        if (reach <= 1 << 20 && between(0, 1)) /* 17 edges stay within what a light may be */
            turn_edge_on(&light, world);
        check_facing(&c, &light, world);
    }
    note("facings: %llu nothing (%llu edge-on), %llu to the light, %llu away, %llu across its near plane",
         (unsigned long long)c.facings[0], (unsigned long long)c.edge_on, (unsigned long long)c.facings[1],
         (unsigned long long)c.facings[2], (unsigned long long)c.facings[3]);
    ok(c.bad == 0, "facings_are_those_of_exact_arithmetic_edge_on_or_not");
    ok(cases < 1000 || (c.edge_on && c.facings[0] > c.edge_on && c.facings[1] && c.facings[2] && c.facings[3]),
       "all_facings_were_among_them");
}

/* A spot light straight above: its near plane is at 900. */
static void corners_on_the_near_plane_are_beyond_it(void)
{
    static const int32_t position[3] = {0, 0, 1000}, target[3] = {0, 0, 0};
    static const int32_t heights[4][3] = {{900, 900, 900}, {900, 900, 901}, {901, 901, 900}, {901, 901, 901}};
    static const gn_facing expected[4] = {GN_FACES_LIGHT, GN_CROSSES_NEAR, GN_CROSSES_NEAR, GN_CASTS_NOTHING};
    facing_tally c = {{0, 0, 0, 0}, 0, 0};
    gn_light light;
    memset(&light, 0, sizeof light);
    int good = gn_spot_light(&light, position, target, 0, GN_DEGREES(60), 100, 5000) == GN_OK;
    for (int i = 0; i < 4; i++) {
        int32_t world[3][3] = {{0, 0, heights[i][0]}, {50, 0, heights[i][1]}, {0, 50, heights[i][2]}};
        good &= exact_facing(&light, world) == expected[i];
        check_facing(&c, &light, world);
    }
    ok(good && c.bad == 0, "corners_on_the_near_plane_of_a_spot_light_are_beyond_it");
}

/* ---- meshes ------------------------------------------------------------------------------------------------------ */

static void random_box(shape *s)
{
    int32_t low[3], high[3];
    for (int i = 0; i < 3; i++) {
        low[i] = between(-1000, 900);
        high[i] = low[i] + between(1, 500);
    }
    add_box(s, low, high);
}

/* One number a declarator: the order of arguments is open. */
static void add_random_vertex(shape *s, int32_t reach)
{
    int32_t x = between(-reach, reach), y = between(-reach, reach), z = between(-reach, reach);
    add_vertex(s, x, y, z);
}

static void add_random_triangle(shape *s, uint32_t first, int32_t last)
{
    uint32_t a = first + (uint32_t)between(0, last), b = first + (uint32_t)between(0, last),
             c = first + (uint32_t)between(0, last);
    add_triangle(s, a, b, c);
}

/* Boxes, triangles of anything at few places, some twice, some without area: edges of every kind. */
static shape random_shape(void)
{
    shape s = shape_new(0);
    if (between(0, 2))
        random_box(&s);
    uint32_t first = s.mesh.vertex_count;
    for (int i = 0; i < 6; i++)
        add_random_vertex(&s, 3);
    for (int32_t i = between(0, 12); i > 0; i--)
        add_random_triangle(&s, first, 5);
    if (s.mesh.triangle_count == 0)
        random_box(&s);
    pair_edges(&s.mesh);
    return s;
}

enum { MOST_OBJECTS = 5 };

typedef struct crowd {
    shape shapes[MOST_OBJECTS];
    gn_model models[MOST_OBJECTS];
    gn_object objects[MOST_OBJECTS];
    gn_scene scene;
    uint32_t triangles, edges;
} crowd;

static void random_crowd(crowd *c)
{
    memset(c, 0, sizeof *c);
    c->scene.objects = c->objects;
    c->scene.object_count = (uint32_t)between(1, MOST_OBJECTS);
    for (uint32_t i = 0; i < c->scene.object_count; i++) {
        c->shapes[i] = random_shape();
        c->objects[i].mesh = &c->shapes[i].mesh;
        c->triangles += c->shapes[i].mesh.triangle_count;
        c->edges += c->shapes[i].mesh.edge_count;
        if (between(0, 1))
            continue;
        int32_t y = between(-3, 3), z = between(-3, 3), axis[3] = {1, y, z};
        int32_t width = between(0, 1) ? 65536 : -65536, depth = between(0, 3) ? 65536 : 0;
        gn_model_identity(&c->models[i]);
        gn_model_scale(&c->models[i], width, 65536, depth);
        gn_model_rotate(&c->models[i], axis, (gn_angle)tap_random(&random_state));
        c->objects[i].model = &c->models[i];
    }
}

static void free_crowd(crowd *c)
{
    for (uint32_t i = 0; i < c->scene.object_count; i++)
        free_edges(&c->shapes[i]);
}

/* ---- facings of a scene ------------------------------------------------------------------------------------------ */

static void world_triangle(const gn_object *object, uint32_t triangle, int32_t world[3][3])
{
    uint32_t index[3];
    gn_triangle_indices(object->mesh, triangle, index);
    for (int i = 0; i < 3; i++)
        (void)gn_world_position(object, index[i], world[i]);
}

static void facings_stand_in_two_bits_a_triangle(uint64_t cases)
{
    uint64_t bad = 0, beyond = 0;
    for (uint64_t i = 0; i < cases; i++) {
        crowd c;
        uint8_t facings[256];
        uint32_t crossing, number = 0, expected_crossing = 0;
        random_crowd(&c);
        gn_light light = random_light(2000);
        memset(facings, 0xa5, sizeof facings); /* what was there before plays no part */
        bad += gn_find_facings(&c.scene, &light, facings, &crossing) != GN_OK;
        for (uint32_t o = 0; o < c.scene.object_count; o++)
            for (uint32_t t = 0; t < c.objects[o].mesh->triangle_count; t++, number++) {
                int32_t world[3][3];
                world_triangle(&c.objects[o], t, world);
                gn_facing expected = exact_facing(&light, world);
                bad += gn_facing_of(facings, number) != expected;
                expected_crossing += expected == GN_CROSSES_NEAR;
            }
        bad += crossing != expected_crossing;
        for (uint32_t k = (number + 3) / 4; k < sizeof facings; k++)
            beyond += facings[k] != 0xa5;
        free_crowd(&c);
    }
    ok(bad == 0, "facings_of_objects_follow_each_other_two_bits_a_triangle");
    ok(beyond == 0, "no_byte_beyond_the_last_triangle_is_written");
}

/* ---- winding ----------------------------------------------------------------------------------------------------- */

/* Over all half-edges between the two places, +1 from the first to the second: what the volumes of single triangles
 * leave there. */
static int32_t sum_between(const gn_mesh *mesh, const uint8_t *facings, uint32_t first, const int32_t from[3],
                           const int32_t to[3])
{
    int32_t sum = 0;
    for (uint32_t half = 0; half < 3 * mesh->triangle_count; half++) {
        int32_t a[3], b[3], sign = gn_facing_sign(gn_facing_of(facings, first + half / 3));
        corner(mesh, half, a);
        corner(mesh, next_corner(half), b);
        sum += same_place(a, from) && same_place(b, to) ? sign : same_place(a, to) && same_place(b, from) ? -sign : 0;
    }
    return sum;
}

/* The same over the edges. */
static int32_t winding_between(const gn_mesh *mesh, const uint8_t *facings, uint32_t first, const int32_t from[3],
                               const int32_t to[3])
{
    int32_t sum = 0;
    for (uint32_t e = 0; e < mesh->edge_count; e++) {
        uint32_t ends[2];
        int32_t winding = gn_edge_winding(mesh, &mesh->edges[e], facings, first, ends);
        const int32_t *a = mesh->vertices[ends[0]], *b = mesh->vertices[ends[1]];
        sum += same_place(a, from) && same_place(b, to)   ? winding
               : same_place(a, to) && same_place(b, from) ? -winding
                                                          : 0;
    }
    return sum;
}

typedef struct winding_tally {
    uint64_t bad, open, same_direction, several, by_size[3];
} winding_tally;

static void check_windings(winding_tally *c, const gn_mesh *mesh, const uint8_t *facings, uint32_t first)
{
    for (uint32_t e = 0; e < mesh->edge_count; e++) {
        uint32_t ends[2], half = mesh->edges[e].half[0], count = 0;
        int32_t from[3], to[3], winding = gn_edge_winding(mesh, &mesh->edges[e], facings, first, ends);
        corner(mesh, half, from);
        corner(mesh, next_corner(half), to);
        c->bad += !same_place(from, mesh->vertices[ends[0]]) || !same_place(to, mesh->vertices[ends[1]]);
        c->bad += sum_between(mesh, facings, first, from, to) != winding_between(mesh, facings, first, from, to);
        c->bad += winding < -2 || winding > 2;
        c->by_size[winding < 0 ? -winding : winding]++;
        for (uint32_t other = 0; other < mesh->edge_count; other++)
            count += together(mesh, half, mesh->edges[other].half[0]) != 0;
        c->several += count > 1;
        c->open += mesh->edges[e].half[1] == GN_NO_HALF_EDGE;
        c->same_direction += mesh->edges[e].half[1] != GN_NO_HALF_EDGE && (mesh->edges[e].half[1] & GN_SAME_DIRECTION);
    }
}

/* All edges of some winding, in order, and no other. */
static int list_is_complete(const crowd *c, const uint8_t *facings)
{
    enum { EDGE_BITS = 12, MOST = 4096 };
    static gn_silhouette list[MOST];
    uint32_t count, at = 0, first = 0;
    if (gn_list_silhouettes(&c->scene, facings, EDGE_BITS, list, &count) != GN_OK)
        return 0;
    for (uint32_t o = 0; o < c->scene.object_count; o++) {
        const gn_mesh *mesh = c->objects[o].mesh;
        for (uint32_t e = 0; e < mesh->edge_count; e++) {
            uint32_t ends[2];
            if (gn_edge_winding(mesh, &mesh->edges[e], facings, first, ends) == 0)
                continue;
            if (at >= count || list[at++].edge != (o << EDGE_BITS | e))
                return 0;
        }
        first += mesh->triangle_count;
    }
    return at == count;
}

static void windings_are_what_single_volumes_leave(uint64_t cases)
{
    winding_tally tally = {0, 0, 0, 0, {0, 0, 0}};
    uint64_t incomplete = 0;
    for (uint64_t i = 0; i < cases; i++) {
        crowd c;
        uint8_t facings[256];
        uint32_t crossing, first = 0;
        random_crowd(&c);
        gn_light light = random_light(2000);
        (void)gn_find_facings(&c.scene, &light, facings, &crossing);
        for (uint32_t o = 0; o < c.scene.object_count; o++) {
            check_windings(&tally, c.objects[o].mesh, facings, first);
            first += c.objects[o].mesh->triangle_count;
        }
        incomplete += !list_is_complete(&c, facings);
        free_crowd(&c);
    }
    note("edges: %llu of winding 0, %llu of 1, %llu of 2; %llu open, %llu of one direction, %llu shared by several",
         (unsigned long long)tally.by_size[0], (unsigned long long)tally.by_size[1],
         (unsigned long long)tally.by_size[2], (unsigned long long)tally.open, (unsigned long long)tally.same_direction,
         (unsigned long long)tally.several);
    ok(tally.bad == 0, "windings_sum_up_to_those_of_the_triangles_own_volumes");
    ok(incomplete == 0, "silhouettes_are_all_edges_of_some_winding_in_order");
    ok(cases < 100 || (tally.by_size[0] && tally.by_size[1] && tally.by_size[2] && tally.open && tally.same_direction &&
                       tally.several),
       "edges_of_all_kinds_were_among_them");
}

/* As many sides begin at a place as end there, or a volume would not be closed. Triangles across the near plane, which
 * stand for themselves, are kept out by a directional light. */
static void silhouettes_of_solids_are_closed(uint64_t cases)
{
    uint64_t bad = 0, seen = 0;
    for (uint64_t i = 0; i < cases; i++) {
        uint8_t facings[16];
        uint32_t crossing;
        shape s = shape_new(1);
        gn_object object;
        gn_scene scene;
        memset(&object, 0, sizeof object);
        memset(&scene, 0, sizeof scene);
        random_box(&s);
        pair_edges(&s.mesh);
        object.mesh = &s.mesh;
        scene.objects = &object;
        scene.object_count = 1;
        gn_light light = random_light(2000);
        light.kind = GN_DIRECTIONAL;
        (void)gn_find_facings(&scene, &light, facings, &crossing);
        int32_t sums[8] = {0};
        for (uint32_t e = 0; e < s.mesh.edge_count; e++) {
            uint32_t ends[2];
            int32_t winding = gn_edge_winding(&s.mesh, &s.mesh.edges[e], facings, 0, ends);
            sums[ends[0]] += winding;
            sums[ends[1]] -= winding;
            seen += winding != 0;
        }
        for (int v = 0; v < 8; v++)
            bad += sums[v] != 0;
        bad += s.mesh.edge_count != 18;
        free_edges(&s);
    }
    ok(bad == 0 && seen, "silhouettes_of_closed_meshes_are_closed");
}

/* A box seen from above and from one side: four silhouette edges of its top and bottom, done by hand. */
static void windings_done_by_hand(void)
{
    static const int32_t low[3] = {0, 0, 0}, high[3] = {10, 10, 10};
    uint8_t facings[16];
    uint32_t crossing, count;
    gn_silhouette list[64];
    shape s = shape_new(1);
    gn_object object;
    gn_scene scene;
    gn_light light = grid_light(4, 4); /* straight down: the box's four sides are edge-on */
    memset(&object, 0, sizeof object);
    memset(&scene, 0, sizeof scene);
    add_box(&s, low, high);
    pair_edges(&s.mesh);
    object.mesh = &s.mesh;
    scene.objects = &object;
    scene.object_count = 1;
    (void)gn_find_facings(&scene, &light, facings, &crossing);
    int good = gn_list_silhouettes(&scene, facings, 8, list, &count) == GN_OK;
    ok(good && crossing == 0 && count == 8,
       "of_a_box_lit_from_straight_above_the_top_and_bottom_cast_and_have_four_edges_each");
    int ones = 1;
    for (uint32_t i = 0; good && i < count; i++) {
        uint32_t ends[2];
        int32_t winding = gn_edge_winding(&s.mesh, &s.mesh.edges[list[i].edge], facings, 0, ends);
        ones &= winding == 1 || winding == -1;
    }
    ok(ones, "each_with_a_winding_of_one");
    light.forward[0] = 1 << 29; /* a little along x: two of its sides turn, too */
    (void)gn_find_facings(&scene, &light, facings, &crossing);
    good = gn_list_silhouettes(&scene, facings, 8, list, &count) == GN_OK;
    uint32_t twos = 0;
    for (uint32_t i = 0; good && i < count; i++) {
        uint32_t ends[2];
        int32_t winding = gn_edge_winding(&s.mesh, &s.mesh.edges[list[i].edge], facings, 0, ends);
        twos += winding == 2 || winding == -2;
    }
    ok(good && twos == 2 && count == 10, "lit_askew_two_of_its_edges_have_a_winding_of_two");
    free_edges(&s);
}

/* x to -x, by the model and by the light: facings turn round. */
static void mirrored_models_turn_facings_round(uint64_t cases)
{
    uint64_t bad = 0, seen = 0;
    for (uint64_t i = 0; i < cases; i++) {
        uint8_t plain[64], mirrored[64];
        uint32_t crossing;
        shape s = random_shape();
        gn_model model;
        gn_object object;
        gn_scene scene;
        memset(&object, 0, sizeof object);
        memset(&scene, 0, sizeof scene);
        object.mesh = &s.mesh;
        scene.objects = &object;
        scene.object_count = 1;
        gn_light light = random_light(2000);
        (void)gn_find_facings(&scene, &light, plain, &crossing);
        gn_model_identity(&model);
        (void)gn_model_scale(&model, -65536, 65536, 65536);
        object.model = &model;
        light.forward[0] = -light.forward[0];
        light.position[0] = -light.position[0];
        (void)gn_find_facings(&scene, &light, mirrored, &crossing);
        for (uint32_t t = 0; t < s.mesh.triangle_count; t++) {
            gn_facing before = gn_facing_of(plain, t), after = gn_facing_of(mirrored, t);
            bad += before == GN_FACES_LIGHT  ? after != GN_FACES_AWAY
                   : before == GN_FACES_AWAY ? after != GN_FACES_LIGHT
                                             : after != before;
            seen += gn_facing_sign(before) != 0;
        }
        free_edges(&s);
    }
    ok(bad == 0 && seen, "a_mirrored_model_under_a_mirrored_light_faces_the_other_way");
}

/* ---- a frame with volumes ---------------------------------------------------------------------------------------- */

/* A level square of 1024 at height 512 over a floor of 4096, seen from straight above by 64 x 64 pixels: 64 units each,
 * x to the right, y up; light comes down along x at 45 degrees. */
typedef struct stage {
    shape floor, square;
    gn_object objects[2];
    gn_scene scene;
    gn_settings settings;
    gn_camera camera;
    gn_light light;
} stage;

static void set_stage(stage *s)
{
    static const int32_t eye[3] = {2048, 2048, 4096}, target[3] = {2048, 2048, 0}, up[3] = {0, 1, 0};
    static const int32_t down[3] = {1, 0, -1};
    memset(s, 0, sizeof *s);
    s->floor = shape_new(0);
    s->square = shape_new(0);
    add_level(&s->floor, 0, 0, 4096, 4096, 0, 1);
    add_level(&s->square, 1024, 1024, 2048, 2048, 512, 1);
    pair_edges(&s->floor.mesh);
    pair_edges(&s->square.mesh);
    s->objects[0].mesh = &s->floor.mesh;
    s->objects[1].mesh = &s->square.mesh;
    s->scene.objects = s->objects;
    s->scene.object_count = 2;
    s->settings = gn_default_settings(64, 64, 16);
    s->settings.shadow = GN_SHADOW_VOLUMES;
    s->settings.mask = 1;
    (void)gn_look_at(&s->camera, eye, target, up);
    (void)gn_orthographic(&s->camera, 2048, 1, 8192);
    (void)gn_directional_light(&s->light, down, 0);
    (void)gn_fit_light(&s->light, &s->scene);
}

static void strike_stage(stage *s)
{
    free_edges(&s->floor);
    free_edges(&s->square);
}

static gn_status render_volumes(frame *f, const gn_light *light, const gn_camera *camera)
{
    gn_status status = gn_volumes_light(f->context, light);
    return status == GN_OK ? gn_volumes_pass(f->context, camera, frame_flush, f) : status;
}

static void a_square_shadows_what_light_carries_it_to(void)
{
    stage s;
    frame f;
    uint64_t lit = 0, shadowed = 0, wrong = 0;
    set_stage(&s);
    gn_status status = frame_start(&f, &s.scene, &s.settings);
    if (status == GN_OK)
        status = render_volumes(&f, &s.light, &s.camera);
    for (int32_t row = 0; status == GN_OK && row < 64; row++)
        for (int32_t column = 0; column < 64; column++) {
            /* what stands between 1024 and 2048 falls 512 further along x; the square itself hides half of that */
            int32_t x = 64 * column + 32, y = 4096 - 64 * row - 32;
            int under = x > 2048 && x < 2560 && y > 1024 && y < 2048;
            wrong += f.mask[64 * row + column] != (under ? 0 : 254);
        }
    if (status == GN_OK)
        count_mask(&f, &lit, &shadowed);
    ok(status == GN_OK && wrong == 0, "a_square_shadows_what_light_carries_it_to");
    ok(shadowed == 128 && lit == 4096 - 128, "of_4096_pixels_128_are_shadowed");
    ok(frame_end(&f), "nothing_outside_the_block_is_written");
    strike_stage(&s);
}

/* ---- edges that a mesh must have --------------------------------------------------------------------------------- */

/* What gn_volumes_light says of the stage with other edges on its square. */
static gn_status status_with(stage *s, const gn_mesh_edge *edges, uint32_t count)
{
    frame f;
    gn_mesh_edge *right = (gn_mesh_edge *)(uintptr_t)s->square.mesh.edges;
    uint32_t right_count = s->square.mesh.edge_count;
    s->square.mesh.edges = edges;
    s->square.mesh.edge_count = count;
    gn_status status = frame_start(&f, &s->scene, &s->settings);
    if (status == GN_OK)
        status = gn_volumes_light(f.context, &s->light);
    if (!frame_end(&f))
        status = GN_OK;
    s->square.mesh.edges = right;
    s->square.mesh.edge_count = right_count;
    return status;
}

static void wrong_edges_are_refused(void)
{
    stage s;
    gn_mesh_edge edges[8];
    set_stage(&s);
    uint32_t count = s.square.mesh.edge_count, inner = 0; /* the one that both triangles share */
    memcpy(edges, s.square.mesh.edges, count * sizeof *edges);
    while (inner + 1 < count && edges[inner].half[1] == GN_NO_HALF_EDGE)
        inner++;
    ok(count == 5 && status_with(&s, edges, count) == GN_OK, "a_square_has_five_edges");
    ok(status_with(&s, edges, count - 1) == GN_BAD_MESH, "a_lost_edge_is_refused");
    ok(status_with(&s, 0, 0) == GN_UNSUPPORTED, "a_mesh_without_edges_is_refused");
    ok(status_with(&s, edges, 0) == GN_BAD_MESH, "edges_of_which_there_are_none_are_refused");
    gn_mesh_edge right = edges[inner];
    edges[inner].half[0] = 6;
    ok(status_with(&s, edges, count) == GN_BAD_MESH, "a_first_half_edge_beyond_the_triangles_is_refused");
    edges[inner].half[0] = right.half[0] | GN_SAME_DIRECTION;
    ok(status_with(&s, edges, count) == GN_BAD_MESH, "so_is_one_with_a_mark_that_belongs_to_the_second");
    edges[inner] = right;
    uint32_t open = inner ? 0 : 1, half = edges[open].half[0];
    edges[open].half[0] = 6;
    ok(edges[open].half[1] == GN_NO_HALF_EDGE && status_with(&s, edges, count) == GN_BAD_MESH,
       "also_where_the_edge_is_open");
    edges[open].half[0] = half;
    edges[inner].half[1] = 6;
    ok(status_with(&s, edges, count) == GN_BAD_MESH, "a_second_half_edge_beyond_the_triangles_is_refused");
    edges[inner].half[1] = 6 | GN_SAME_DIRECTION;
    ok(status_with(&s, edges, count) == GN_BAD_MESH, "also_with_the_mark_of_one_direction");
    edges[inner].half[1] = right.half[1] | GN_SAME_DIRECTION;
    ok(status_with(&s, edges, count) == GN_BAD_MESH, "a_wrong_direction_is_refused");
    edges[inner].half[1] = right.half[1] == 3 ? 4 : 3;
    ok(status_with(&s, edges, count) == GN_BAD_MESH, "half_edges_of_different_places_are_refused");
    edges[inner].half[1] = GN_NO_HALF_EDGE;
    ok(status_with(&s, edges, count) == GN_BAD_MESH, "an_edge_that_lost_its_second_triangle_is_refused");
    edges[inner] = right;
    edges[count] = edges[0];
    ok(status_with(&s, edges, count + 1) == GN_BAD_MESH, "an_edge_too_many_is_refused");
    strike_stage(&s);
}

/* Triangles with two corners in one place: with or without their half-edges. */
static void points_may_be_left_out(void)
{
    stage s;
    frame f;
    set_stage(&s);
    free((void *)(uintptr_t)s.square.mesh.edges);
    add_triangle(&s.square, 0, 1, 1);
    gn_mesh_edge *edges = pair_edges(&s.square.mesh);
    uint32_t count = s.square.mesh.edge_count;
    gn_status without = frame_start(&f, &s.scene, &s.settings);
    without = without == GN_OK ? render_volumes(&f, &s.light, &s.camera) : without;
    int intact = frame_end(&f);
    for (uint32_t i = 0; i < 3; i++) {
        edges[count + i].half[0] = 6 + i;
        edges[count + i].half[1] = GN_NO_HALF_EDGE;
    }
    gn_status with = status_with(&s, edges, count + 3);
    ok(without == GN_OK && with == GN_OK && intact, "half_edges_of_triangles_that_are_points_may_be_left_out");
    ok(status_with(&s, edges, count + 1) == GN_BAD_MESH, "but_not_in_part");
    strike_stage(&s);
}

/* ---- statuses ---------------------------------------------------------------------------------------------------- */

static int stop(void *user, const gn_pixels *pixels)
{
    (void)user;
    (void)pixels;
    return 1;
}

static void volumes_keep_their_order(void)
{
    stage s;
    frame f;
    gn_pixels pixels;
    static uint8_t colour[3 * 64 * 64], mask[64 * 64];
    set_stage(&s);
    ok(frame_start(&f, &s.scene, &s.settings) == GN_OK, "a_context_for_volumes_is_made");
    gn_context *c = f.context;
    ok(gn_volumes_begin(c, &s.camera) == GN_NOT_READY && gn_volumes_pass(c, &s.camera, frame_flush, &f) == GN_NOT_READY,
       "a_camera_before_the_light_is_not_ready");
    ok(gn_volumes_region(c, 0, 0, colour, mask, &pixels) == GN_NOT_READY, "nor_is_a_region");
    ok(gn_volumes_light(c, &s.light) == GN_OK && gn_volumes_region(c, 0, 0, colour, mask, &pixels) == GN_NOT_READY,
       "a_region_before_the_camera_is_not_ready");
    ok(gn_volumes_begin(c, &s.camera) == GN_OK && gn_volumes_region(c, 0, 0, colour, mask, &pixels) == GN_OK &&
           gn_volumes_begin(c, &s.camera) == GN_OK,
       "light_camera_region_and_a_camera_again_is_in_order");
    ok(gn_volumes_region(c, f.plan.camera_regions, 0, colour, mask, &pixels) == GN_BAD_ARGUMENT &&
           gn_volumes_region(c, 0, 1, colour, mask, &pixels) == GN_BAD_ARGUMENT &&
           gn_volumes_region(c, 0, 0, colour, mask, 0) == GN_BAD_ARGUMENT,
       "regions_and_workers_that_do_not_exist_are_bad_arguments");
    ok(gn_volumes_light(c, &s.light) == GN_OK && gn_volumes_region(c, 0, 0, colour, mask, &pixels) == GN_NOT_READY,
       "a_new_light_ends_the_camera_pass");
    ok(gn_volumes_light(0, &s.light) == GN_BAD_ARGUMENT && gn_volumes_light(c, 0) == GN_BAD_ARGUMENT &&
           gn_volumes_begin(0, &s.camera) == GN_BAD_ARGUMENT && gn_volumes_begin(c, 0) == GN_BAD_ARGUMENT &&
           gn_volumes_pass(c, &s.camera, 0, 0) == GN_BAD_ARGUMENT,
       "null_pointers_are_bad_arguments");
    ok(gn_volumes_pass(c, &s.camera, stop, 0) == GN_STOPPED && gn_volumes_pass(c, &s.camera, frame_flush, &f) == GN_OK,
       "a_frame_may_be_stopped_and_done_again");
    ok(gn_light_begin(c, &s.light) == GN_UNSUPPORTED && gn_light_pass(c, &s.light) == GN_UNSUPPORTED &&
           gn_camera_begin(c, &s.camera) == GN_UNSUPPORTED &&
           gn_camera_pass(c, &s.camera, frame_flush, &f) == GN_UNSUPPORTED,
       "passes_of_shadow_maps_are_unsupported_with_volumes");
    ok(gn_camera_region(c, 0, 0, colour, mask, &pixels) == GN_NOT_READY && gn_light_layers(c, 0, 0) != GN_OK &&
           gn_light_resolve(c, 0, 0) != GN_OK,
       "their_regions_are_refused");
    ok(frame_end(&f), "nothing_outside_the_block_is_written_by_any_of_these");
    s.settings.shadow = GN_SHADOW_MAP;
    ok(frame_start(&f, &s.scene, &s.settings) == GN_OK && gn_light_pass(f.context, &s.light) == GN_OK &&
           gn_volumes_light(f.context, &s.light) == GN_UNSUPPORTED &&
           gn_volumes_begin(f.context, &s.camera) == GN_UNSUPPORTED &&
           gn_volumes_pass(f.context, &s.camera, frame_flush, &f) == GN_UNSUPPORTED &&
           gn_volumes_region(f.context, 0, 0, colour, mask, &pixels) == GN_NOT_READY &&
           gn_camera_pass(f.context, &s.camera, frame_flush, &f) == GN_OK,
       "volumes_are_unsupported_with_shadow_maps_and_disturb_none");
    ok(frame_end(&f), "nor_here_is_anything_outside_the_block_written");
    strike_stage(&s);
}

/* What a light that is refused leaves is no light. */
static void check_refused(frame *f, const stage *s, const gn_light *light, gn_status expected, const char *name)
{
    gn_status before = gn_volumes_light(f->context, &s->light), status = gn_volumes_light(f->context, light);
    ok(before == GN_OK && status == expected && gn_volumes_begin(f->context, &s->camera) == GN_NOT_READY, "%s", name);
}

static void lights_and_cameras_out_of_range_are_refused(void)
{
    static const int32_t from[3] = {2048, 2048, 2000}, to[3] = {2048, 2048, 0};
    stage s;
    frame f;
    gn_light light;
    set_stage(&s);
    ok(frame_start(&f, &s.scene, &s.settings) == GN_OK, "a_context_is_made");
    light = s.light;
    light.kind = 3;
    check_refused(&f, &s, &light, GN_BAD_ARGUMENT, "an_unknown_kind_of_light_is_a_bad_argument");
    light.kind = GN_POINT;
    check_refused(&f, &s, &light, GN_UNSUPPORTED, "a_point_light_casts_no_volumes");
    light = s.light;
    light.forward[1] = (1 << 30) + 17;
    check_refused(&f, &s, &light, GN_OUT_OF_RANGE, "an_axis_longer_than_one_is_out_of_range");
    light.forward[1] = INT32_MIN;
    check_refused(&f, &s, &light, GN_OUT_OF_RANGE, "also_the_other_way");
    (void)gn_spot_light(&light, from, to, 0, GN_DEGREES(60), 100, 4000);
    light.near_depth = 0;
    check_refused(&f, &s, &light, GN_OUT_OF_RANGE, "a_spot_light_with_a_near_plane_of_0_is_out_of_range");
    light.near_depth = 100;
    light.position[2] = GN_EYE_MAX + 1;
    check_refused(&f, &s, &light, GN_OUT_OF_RANGE, "so_is_one_beyond_the_places_of_eyes");
    light.position[2] = from[2];
    ok(gn_volumes_light(f.context, &light) == GN_OK, "the_same_within_its_ranges_is_not");
    gn_camera camera = s.camera;
    camera.half_height = 0;
    ok(gn_volumes_begin(f.context, &camera) == GN_OUT_OF_RANGE && gn_volumes_begin(f.context, &s.camera) == GN_OK,
       "a_camera_out_of_range_is_refused_and_another_taken");
    ok(frame_end(&f), "nothing_outside_the_block_is_written_by_what_is_refused");
    gn_model model;
    gn_model_identity(&model);
    (void)gn_model_translate(&model, GN_WORLD_MAX, 0, 0);
    s.objects[1].model = &model;
    ok(frame_start(&f, &s.scene, &s.settings) == GN_OK && gn_volumes_light(f.context, &s.light) == GN_OUT_OF_RANGE,
       "a_model_that_moves_a_caster_out_of_the_world_is_out_of_range");
    ok(frame_end(&f), "and_writes_nothing_outside");
    strike_stage(&s);
}

/* ---- frames of every shape --------------------------------------------------------------------------------------- */

static gn_status random_camera(gn_camera *camera, const gn_settings *settings)
{
    static const int32_t up[3] = {0, 0, 1};
    static const int32_t target[3] = {1, 2, 3};
    int32_t x = between(-2000, 2000), y = between(-2000, 2000), z = between(-2000, 2000), eye[3] = {x, y, z};
    gn_status status = gn_look_at(camera, eye, target, up);
    if (status != GN_OK)
        return status;
    int32_t near_depth = 64 * settings->height / settings->width + 64;
    return between(0, 1) ? gn_perspective(camera, GN_DEGREES(60), near_depth, near_depth + 10000)
                         : gn_orthographic(camera, between(100, 2000), -2000, 8000);
}

static void random_settings(gn_settings *settings)
{
    uint16_t width = (uint16_t)between(1, 40), height = (uint16_t)between(1, 40);
    *settings = gn_default_settings(width, height, 16);
    settings->shadow = GN_SHADOW_VOLUMES;
    settings->mask = (uint8_t)between(0, 1);
    settings->format = (uint8_t)between(0, 2);
    settings->region_width = (uint16_t)between(0, 12);
    settings->region_height = (uint16_t)between(0, 12);
    settings->workers = (uint8_t)between(1, 3);
}

static void nothing_outside_the_block_is_written(uint64_t cases)
{
    uint64_t bad = 0, outside = 0, done = 0;
    for (uint64_t i = 0; i < cases; i++) {
        crowd c;
        frame f;
        gn_settings settings;
        gn_camera camera;
        random_crowd(&c);
        random_settings(&settings);
        memset(&camera, 0, sizeof camera);
        gn_light light = random_light(2000);
        gn_status status = frame_start(&f, &c.scene, &settings);
        if (status == GN_OK && random_camera(&camera, &settings) == GN_OK) {
            status = render_volumes(&f, &light, &camera);
            done += status == GN_OK;
        }
        bad += status != GN_OK && status != GN_OUT_OF_RANGE;
        outside += !frame_end(&f);
        free_crowd(&c);
    }
    note("%llu frames rendered", (unsigned long long)done);
    ok(bad == 0 && done >= cases / 2, "frames_of_any_shape_and_regions_are_rendered");
    ok(outside == 0, "nothing_outside_their_blocks_is_written");
}

int main(int argc, char **argv)
{
    uint64_t cases = tap_cases(argc, argv, 100000);
    facings_are_exact(cases);
    corners_on_the_near_plane_are_beyond_it();
    facings_stand_in_two_bits_a_triangle(cases / 50 + 1);
    windings_done_by_hand();
    windings_are_what_single_volumes_leave(cases / 100 + 1);
    silhouettes_of_solids_are_closed(cases / 100 + 1);
    mirrored_models_turn_facings_round(cases / 100 + 1);
    a_square_shadows_what_light_carries_it_to();
    wrong_edges_are_refused();
    points_may_be_left_out();
    volumes_keep_their_order();
    lights_and_cameras_out_of_range_are_refused();
    nothing_outside_the_block_is_written(cases / 50 + 1);
    return tap_done();
}
