/* Crossing maps (core/gn_crossing_map.h). The reconstruction against lines between crossings by cross products, on
 * random bytes and texels; where borders meet from cell to cell. Straight edges of any direction, of one mesh with
 * edges and of loose triangles: no pixel farther from the edge than a crossing is rounded may be wrong, with every
 * receiver. The whole map against a slow twin: every edge with every side between two texels, in rationals of 128 bits,
 * the caster's side by where its triangle lies; and the same map whatever the order of triangles, objects, regions and
 * workers, and whatever the surface. Half of all maps are warped: their columns and rows are of any width. Cases: 1000
 * scenes, or GNOMON_CASES. */
#include "gn_cascade.h"
#include "gn_drawing.h"
#include "mesh_edges.h"
#include "warped.h"

__extension__ typedef __int128 exact;

static int64_t magnitude(int64_t v)
{
    return v < 0 ? -v : v;
}

static int64_t floor_divide(int64_t n, int64_t d)
{
    int64_t q = n / d;
    return q - (n - q * d < 0);
}

/* ---- the reconstruction ------------------------------------------------------------------------------------------ */

enum { MOST_SIDE = 7, PADDING = 3 };

/* A map made by hand: crossings, which of the texels shadow a plane, and that plane. */
typedef struct patch {
    int32_t width, height, bits;
    uint8_t bytes[MOST_SIDE * MOST_SIDE];
    uint8_t dark[MOST_SIDE * MOST_SIDE];
    gn_depth texels[MOST_SIDE * (MOST_SIDE + PADDING)];
    gn_wide_plane plane;
    gn_lookup lookup;
} patch;

static void random_patch(patch *p)
{
    p->width = between(2, MOST_SIDE);
    p->height = between(2, MOST_SIDE);
    p->bits = between(8, 18);
    p->plane.base = (int64_t)1 << 31;
    p->plane.dx = between(0, 1) ? between(-(1 << 24), 1 << 24) : 0;
    p->plane.dy = between(0, 1) ? between(-(1 << 24), 1 << 24) : 0;
    for (int32_t row = 0; row < p->height; row++)
        for (int32_t column = 0; column < p->width; column++) {
            int dark = between(0, 1);
            int64_t z = p->plane.base + column * p->plane.dx + row * p->plane.dy;
            p->bytes[row * p->width + column] = (uint8_t)between(0, 255);
            p->dark[row * p->width + column] = (uint8_t)dark;
            /* the plane's depth, which is lit, or one unit less, which is not */
            p->texels[row * (p->width + PADDING) + column] =
                (gn_depth)((gn_depth)(z >> (32 - GN_DEPTH_BITS)) - (gn_depth)dark);
        }
    gn_lookup l = {.map = p->texels,
                   .stride = (uint32_t)(p->width + PADDING),
                   .last_column = (uint32_t)p->width - 1,
                   .last_row = (uint32_t)p->height - 1,
                   .bits = (uint32_t)p->bits,
                   .whole = gn_crossings.whole,
                   .silhouettes = p->bytes};
    p->lookup = l;
}

typedef struct vector {
    int64_t x, y;
} vector;

static vector apart(vector a, vector b)
{
    vector v = {a.x - b.x, a.y - b.y};
    return v;
}

static int64_t cross(vector a, vector b)
{
    return a.x * b.y - a.y * b.x;
}

/* Corners of a cell in clockwise order from the upper left one: their places in texels. Side i runs from corner i to
 * the next one. */
static const vector corners[4] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};

static int dark_at(const patch *p, int32_t column, int32_t row, int corner)
{
    const vector *v = &corners[corner & 3];
    return p->dark[(row + v->y) * p->width + column + v->x];
}

/* In 1/16 texel from the left, or from above. */
static int64_t code_at(const patch *p, int32_t column, int32_t row, int below)
{
    int byte = p->bytes[row * p->width + column], code = below ? byte / 16 : byte % 16;
    return code ? code : 8;
}

/* The crossing of a side, from the cell's upper left corner, in 2^-bits / 16 texel. */
static vector crossing_of(const patch *p, int32_t column, int32_t row, int side)
{
    int64_t one = (int64_t)1 << p->bits;
    vector v = {side == 1 ? 16 : 0, side == 2 ? 16 : 0};
    if (side % 2 == 0)
        v.x = code_at(p, column, row + (side == 2), 0);
    else
        v.y = code_at(p, column + (side == 1), row, 1);
    v.x *= one;
    v.y *= one;
    return v;
}

/* In order, three places turn right (1), left (-1), or lie on a line (0). */
static int turn(vector a, vector b, vector c)
{
    int64_t side = cross(apart(b, a), apart(c, a));
    return (side > 0) - (side < 0);
}

static vector corner_place(const patch *p, int corner)
{
    int64_t scale = (int64_t)16 << p->bits;
    vector v = {corners[corner].x * scale, corners[corner].y * scale};
    return v;
}

/* Is a place in the triangle between a corner and the crossings of its two sides? On the line: yes, but for the upper
 * left corner: what is right of a line, or below it, has the line. */
static int is_cut_off(const patch *p, int32_t column, int32_t row, int corner, vector place)
{
    vector a = crossing_of(p, column, row, (corner + 3) % 4), b = crossing_of(p, column, row, corner);
    int side = turn(a, b, place);
    return side == 0 ? corner != 0 : side == turn(a, b, corner_place(p, corner));
}

/* Is the place shadowed? In 2^-bits texel from the cell's upper left corner. *how: sides that differ. */
static int is_dark(const patch *p, int32_t column, int32_t row, vector place, int *how)
{
    int side[4], count = 0;
    vector scaled = {16 * place.x, 16 * place.y};
    for (int i = 0; i < 4; i++)
        if (dark_at(p, column, row, i) != dark_at(p, column, row, i + 1))
            side[count++] = i;
    *how = count;
    if (count == 0)
        return dark_at(p, column, row, 0);
    if (count == 4) { /* lit corners are cut off */
        for (int i = 0; i < 4; i++)
            if (!dark_at(p, column, row, i) && is_cut_off(p, column, row, i, scaled))
                return 0;
        return 1;
    }
    if (side[1] != side[0] + 2) { /* sides about one corner */
        int odd = side[0] == 0 && side[1] == 3 ? 0 : side[1];
        return dark_at(p, column, row, is_cut_off(p, column, row, odd, scaled) ? odd : odd + 2);
    }
    /* from the top down, or from right to left */
    int beyond = turn(crossing_of(p, column, row, side[0]), crossing_of(p, column, row, side[1]), scaled);
    if (side[0] == 0)
        return dark_at(p, column, row, beyond <= 0 ? 1 : 0);
    return dark_at(p, column, row, beyond <= 0 ? 2 : 0);
}

static gn_points points;

static uint32_t sample_at(const patch *p, int64_t u, int64_t v)
{
    points.u[0] = (uint32_t)u;
    points.v[0] = (uint32_t)v;
#if GN_STATISTICS
    points.reconstructed[0] = 0;
#endif
    return gn_crossings.sample(&p->lookup, &points, 0, &p->plane);
}

/* Anywhere in the cell, or on a line between two crossings, or beside one. */
static vector random_place(const patch *p, int32_t column, int32_t row)
{
    int64_t one = (int64_t)1 << p->bits, part = between(0, 16);
    vector place = {between(0, one - 1), between(0, one - 1)};
    if (between(0, 1) == 0)
        return place;
    int from = between(0, 3);
    vector a = crossing_of(p, column, row, from), b = crossing_of(p, column, row, (from + between(1, 3)) % 4);
    place.x = floor_divide(16 * a.x + part * (b.x - a.x), 256);
    place.y = floor_divide(16 * a.y + part * (b.y - a.y), 256);
    if (between(0, 1)) {
        place.x += between(-1, 1);
        place.y += between(-1, 1);
    }
    place.x = place.x < 0 ? 0 : place.x < one ? place.x : one - 1;
    place.y = place.y < 0 ? 0 : place.y < one ? place.y : one - 1;
    return place;
}

static void places_are_beyond_the_lines_between_crossings(uint64_t cases)
{
    static patch p;
    uint64_t seen[5] = {0}, shadowed = 0;
    unsigned failures = 0;
    for (uint64_t n = 0; n < cases && failures < 5; n++) {
        if (n % 8 == 0)
            random_patch(&p);
        int how, counted = 1;
        int32_t column = between(0, p.width - 2), row = between(0, p.height - 2);
        vector place = random_place(&p, column, row);
        int expected = is_dark(&p, column, row, place, &how);
        uint32_t got = sample_at(&p, ((int64_t)column << p.bits) + place.x, ((int64_t)row << p.bits) + place.y);
#if GN_STATISTICS
        counted = points.reconstructed[0] == (how != 0);
#endif
        seen[how]++;
        shadowed += how && expected;
        if ((got != (expected ? GN_DARK : 0) || !counted) && failures++ < 5)
            note("map %dx%d, %d bits, cell (%d, %d), place (%ld, %ld), %d sides differ: got %lx, expected %s%s",
                 (int)p.width, (int)p.height, (int)p.bits, (int)column, (int)row, (long)place.x, (long)place.y, how,
                 (unsigned long)got, expected ? "shadowed" : "lit", counted ? "" : "; miscounted");
    }
    ok(!failures, "places are beyond the lines between crossings: %llu places of random maps",
       (unsigned long long)cases);
    ok(seen[0] > cases / 16 && seen[2] > cases / 2 && seen[4] > cases / 16 && shadowed > cases / 4 &&
           shadowed < 3 * cases / 4,
       "of them %llu where texels agree, %llu where two sides differ, %llu where four do; %llu shadowed",
       (unsigned long long)seen[0], (unsigned long long)seen[2], (unsigned long long)seen[4],
       (unsigned long long)shadowed);
}

/* Beyond the centres of the outer texels there is no cell: the nearest texel's answer. */
static void places_beyond_the_cells_are_the_nearest_texels(uint64_t cases)
{
    static patch p;
    uint64_t dark = 0;
    unsigned failures = 0;
    for (uint64_t n = 0; n < cases && failures < 5; n++) {
        if (n % 8 == 0)
            random_patch(&p);
        int64_t one = (int64_t)1 << p.bits, half = one / 2;
        int64_t u = between(-half, p.width * one - half - 1), v = between(-half, p.height * one - half - 1);
        if (between(0, 1))
            u = between(0, 1) ? between(-half, -1) : between((p.width - 1) * one, p.width * one - half - 1);
        else
            v = between(0, 1) ? between(-half, -1) : between((p.height - 1) * one, p.height * one - half - 1);
        int64_t column = floor_divide(u + half, one), row = floor_divide(v + half, one);
        uint32_t got = sample_at(&p, u, v), expected = p.dark[row * p.width + column] ? GN_DARK : 0;
        dark += expected != 0;
        if (got != expected && failures++ < 5)
            note("map %dx%d, %d bits, place (%ld, %ld): got %lx, expected %lx", (int)p.width, (int)p.height,
                 (int)p.bits, (long)u, (long)v, (unsigned long)got, (unsigned long)expected);
    }
    ok(!failures && dark > cases / 4 && dark < cases - cases / 4,
       "places beyond the cells are the nearest texel's: %llu of %llu shadowed", (unsigned long long)dark,
       (unsigned long long)cases);
}

/* The first place on a row or column of places of a cell that has the answer of the last. */
static int64_t find_split(const patch *p, int64_t u, int64_t v, int down)
{
    int64_t low = 0, high = ((int64_t)1 << p->bits) - 1;
    uint32_t last = sample_at(p, u + (down ? 0 : high), v + (down ? high : 0));
    while (low < high) {
        int64_t middle = (low + high) / 2;
        if (sample_at(p, u + (down ? 0 : middle), v + (down ? middle : 0)) == last)
            high = middle;
        else
            low = middle + 1;
    }
    return low;
}

/* Along a side between two cells: in the cell below, or right, the border is at the crossing; in the other one it is
 * where its line comes within a place of the side, and lines rise 15 in 1 at most. */
static void borders_meet_on_sides(uint64_t cases)
{
    static patch p;
    uint64_t sides = 0;
    unsigned failures = 0;
    for (uint64_t n = 0; n < cases && failures < 5; n++) {
        random_patch(&p);
        int64_t one = (int64_t)1 << p.bits;
        for (int32_t row = 0; row < p.height - 1; row++)
            for (int32_t column = 0; column < p.width - 1; column++)
                for (int down = 0; down < 2; down++) {
                    int32_t other = (row + down) * p.width + column + !down;
                    if ((down ? column : row) == 0 || p.dark[row * p.width + column] == p.dark[other])
                        continue;
                    int64_t u = column * one, v = row * one, at = code_at(&p, column, row, down) * one / 16;
                    int64_t here = find_split(&p, u, v, down), there = find_split(&p, u - down, v - !down, down);
                    sides++;
                    if ((here != at || magnitude(there - at) > 16) && failures++ < 5)
                        note("the side %s texel (%d, %d), %d bits: parted at %ld, and in the cell before at %ld, "
                             "expected %ld",
                             down ? "below" : "right of", (int)column, (int)row, (int)p.bits, (long)here, (long)there,
                             (long)at);
                }
    }
    ok(!failures && sides > 4 * cases, "borders meet on the sides between cells, at their crossings: %llu sides",
       (unsigned long long)sides);
}

/* ---- meshes with edges ------------------------------------------------------------------------------------------- */

static void drop_edges(shape *s)
{
    free(edges_of(s));
    s->mesh.edges = 0;
    s->mesh.edge_count = 0;
}

static void free_shape(shape *s)
{
    drop_edges(s);
    shape_free(s);
}

/* ---- random scenes ----------------------------------------------------------------------------------------------- */

enum { MOST_OBJECTS = 6, DEEPEST = 60000 };

typedef struct world {
    shape shapes[MOST_OBJECTS];
    gn_object objects[MOST_OBJECTS];
    gn_scene scene;
    gn_light light;
    gn_settings settings;
    int32_t across, up; /* the map's size, world units */
    tables grid;        /* with settings.warp */
} world;

/* A coordinate about the map: anywhere, on texels' centres, on their borders. */
static int32_t random_coordinate(int32_t size)
{
    int32_t v = between(-600, size + 600), how = between(0, 3);
    return how == 0 ? (v & ~255) + 128 : how == 1 ? v & ~127 : v;
}

/* A height: any, or one of few, and the next unit. */
static int32_t random_height(void)
{
    int32_t z = between(0, DEEPEST);
    return -(between(0, 1) ? z - z % 6000 + between(0, 1) : z);
}

static void random_shape(shape *s, const world *w)
{
    int how = between(0, 3);
    *s = shape_new(how < 2);
    if (how == 0) {
        int32_t low[3], high[3];
        for (int i = 0; i < 3; i++) {
            int32_t a = i == 2 ? random_height() : random_coordinate(i ? w->up : w->across);
            int32_t b = i == 2 ? random_height() : random_coordinate(i ? w->up : w->across);
            low[i] = a < b ? a : b;
            high[i] = a < b ? b : a + (a == b);
        }
        add_box(s, low, high);
        return;
    }
    /* a tetrahedron; a strip of triangles; loose ones */
    int count = how == 1 ? 4 : between(3, 9);
    for (int i = 0; i < count; i++)
        add_vertex(s, random_coordinate(w->across), random_coordinate(w->up), random_height());
    if (how == 1) {
        add_triangle(s, 0, 1, 2);
        add_triangle(s, 0, 3, 1);
        add_triangle(s, 1, 3, 2);
        add_triangle(s, 2, 3, 0);
    } else {
        for (uint32_t i = 0; i + 2 < (uint32_t)count; i++)
            add_triangle(s, i, i + 1 + i % 2 * (uint32_t)(how == 2), i + 2 - i % 2 * (uint32_t)(how == 2));
    }
}

static void random_world(world *w)
{
    memset(w, 0, sizeof *w);
    int warped = between(0, 1); /* of powers of two: a world unit is so many fine texels */
    int32_t width = warped ? 8 << between(0, 1) : between(2, 24), height = warped ? 8 << between(0, 1) : between(2, 24);
    w->across = 256 * width;
    w->up = 256 * height;
    w->light = grid_light((uint32_t)width, (uint32_t)height);
    w->scene.objects = w->objects;
    w->scene.object_count = (uint32_t)between(1, MOST_OBJECTS);
    for (uint32_t i = 0; i < w->scene.object_count; i++) {
        if (i == 0 && between(0, 1)) { /* a ground */
            w->shapes[i] = shape_new(0);
            if (warped) /* within the guard band: clipped edges are rounded */
                add_level(&w->shapes[i], -2000, -2000, w->across + 2000, w->up + 2000, -65000, 1);
            else
                add_level(&w->shapes[i], -9000, -9000, 20000, 20000, -65000, 1);
        } else {
            random_shape(&w->shapes[i], w);
        }
        if (between(0, 2))
            make_edges(&w->shapes[i]);
        w->objects[i].mesh = &w->shapes[i].mesh;
    }
    w->settings = gn_default_settings(8, 8, (uint16_t)width);
    w->settings.map_height = (uint16_t)height;
    w->settings.format = GN_NO_COLOUR;
    w->settings.reconstruction = &gn_crossings;
    w->settings.surface = GN_CONSTANT;
    w->settings.cull = GN_CULL_NONE;
    w->settings.layers = GN_LAYERS_FIRST;
    w->settings.warp = warped ? &gn_rectilinear : 0;
    random_tables(&w->grid, &w->settings);
}

static void free_world(world *w)
{
    for (uint32_t i = 0; i < w->scene.object_count; i++)
        free_shape(&w->shapes[i]);
}

/* ---- the map by a slow twin -------------------------------------------------------------------------------------- */

/* On the map: 1/256 texel from the centre of texel (0, 0), y down, of a warped map in fine texels; z: 32 bits. */
typedef struct spot {
    int64_t x, y, z;
} spot;

static spot spot_of(const world *w, const shape *s, uint32_t half)
{
    const int32_t *v = corner_of(s, half);
    int64_t times_x = w->settings.warp ? 256 * GN_FINE / w->across : 1;
    int64_t times_y = w->settings.warp ? 256 * GN_FINE / w->up : 1;
    spot p = {times_x * v[0] - 128, times_y * (w->up - v[1]) - 128, -65536 * (int64_t)v[2] + 32768};
    return p;
}

/* 1 counter-clockwise from above, -1 clockwise, 0 edge-on. */
static int facing(const shape *s, uint32_t triangle)
{
    const int32_t *a = corner_of(s, 3 * triangle), *b = corner_of(s, 3 * triangle + 1);
    const int32_t *c = corner_of(s, 3 * triangle + 2);
    int64_t area = (int64_t)(b[0] - a[0]) * (c[1] - a[1]) - (int64_t)(c[0] - a[0]) * (b[1] - a[1]);
    return (area > 0) - (area < 0);
}

typedef struct twin {
    const world *w;
    const gn_depth *depths; /* nearest; width long rows */
    int32_t width, height;
    uint8_t bytes[24 * 24];
    uint64_t edges, written, hidden, lost, ties;
} twin;

/* Where the centre of a column or row lies, as spots do. */
static int64_t centre_at(const twin *t, int32_t i, int of_row)
{
    const tables *grid = &t->w->grid;
    return 256 * (int64_t)(!t->w->settings.warp ? i : of_row ? grid->rows[i] : grid->columns[i]);
}

/* One edge and one side between two texels: from (i, j) to the right or down. across: what runs along the side, 1/256
 * texel. The edge meets a texel's centre: the centre is a little to the right, and far less down. */
static void try_side(twin *t, spot a, spot b, spot third, int32_t i, int32_t j, int down)
{
    int64_t line = centre_at(t, down ? i : j, !down), start = centre_at(t, down ? j : i, down);
    int64_t side = centre_at(t, (down ? j : i) + 1, down) - start;
    int64_t a_line = down ? a.x : a.y, b_line = down ? b.x : b.y, a_along = down ? a.y : a.x,
            b_along = down ? b.y : b.x;
    if ((a_line <= line) == (b_line <= line))
        return;
    /* along the side n / d, d > 0, from its first centre */
    exact d = b_line - a_line, n = (exact)(a_along - start) * d + (exact)(b_along - a_along) * (line - a_line);
    exact z = (exact)a.z * d + (exact)(b.z - a.z) * (line - a_line);
    if (d < 0) {
        d = -d;
        n = -n;
        z = -z;
    }
    int falls = down && (b.x - a.x > 0) == (b.y - a.y > 0) && a.y != b.y; /* to the right the edge is lower */
    t->ties += n == 0 || n == side * d;
    if (falls ? n < 0 || n >= side * d : n <= 0 || n > side * d)
        return;
    int64_t code = (int64_t)((2 * 16 * n + side * d) / (2 * side * d)); /* floor(16 p + 1/2) */
    code = code < 1 ? 1 : code > 15 ? 15 : code;
    /* which of the two is where the triangle lies: compared across the edge's line, half-way from crossing to centre */
    exact of_third = (exact)(b.x - a.x) * (third.y - a.y) - (exact)(b.y - a.y) * (third.x - a.x);
    exact of_next = down ? (exact)(b.x - a.x) : -(exact)(b.y - a.y); /* what a step along the side adds */
    int near_is_next = (of_third > 0) == (of_next > 0);
    gn_depth here = t->depths[j * t->width + i], next = t->depths[(j + down) * t->width + i + !down];
    uint32_t near = (near_is_next ? next : here) & ~1u, far = (near_is_next ? here : next) & ~1u;
    if (near >= far)
        return;
    if (z >= (exact)((uint64_t)far << (32 - GN_DEPTH_BITS)) * d) {
        t->hidden++;
        return;
    }
    uint8_t *byte = &t->bytes[j * t->width + i];
    int old = down ? *byte >> 4 : *byte & 15;
    t->written++;
    t->lost += old && old != code;
    if (!old || (near_is_next ? code < old : code > old)) /* nearest to the farther one */
        *byte = (uint8_t)(down ? (*byte & 15) | code << 4 : (*byte & 240) | code);
}

static void try_edge(twin *t, const shape *s, uint32_t half)
{
    spot a = spot_of(t->w, s, half), b = spot_of(t->w, s, next_corner(half));
    spot third = spot_of(t->w, s, next_corner(next_corner(half)));
    t->edges++;
    for (int32_t j = 0; j < t->height; j++)
        for (int32_t i = 0; i < t->width; i++) {
            if (i + 1 < t->width)
                try_side(t, a, b, third, i, j, 0);
            if (j + 1 < t->height)
                try_side(t, a, b, third, i, j, 1);
        }
}

/* By a triangle that is not seen edge-on. */
static void try_edges(twin *t, const shape *s)
{
    for (uint32_t e = 0; e < s->mesh.edge_count; e++) {
        uint32_t half = s->mesh.edges[e].half[0], other = s->mesh.edges[e].half[1];
        int way = facing(s, half / 3), sum = way;
        if (other != GN_NO_HALF_EDGE) {
            int same = (other & GN_SAME_DIRECTION) != 0, its = facing(s, (other & ~GN_SAME_DIRECTION) / 3);
            sum += same ? its : -its;
        }
        if (sum)
            try_edge(t, s, way ? half : other & ~GN_SAME_DIRECTION);
    }
    for (uint32_t half = 0; !s->mesh.edges && half < 3 * s->mesh.triangle_count; half++)
        if (facing(s, half / 3))
            try_edge(t, s, half);
}

/* The view pass of a warped map, and its tables. */
static gn_status warp_world(frame *f, const world *w)
{
    static const int32_t up[3] = {0, 1, 0};
    int32_t eye[3] = {w->across / 2, w->up / 2, 6000}, target[3] = {w->across / 2, w->up / 2, 0};
    gn_camera camera;
    gn_status status = gn_look_at(&camera, eye, target, up);
    if (status != GN_OK || !w->settings.warp)
        return status;
    status = gn_perspective(&camera, GN_DEGREES(50), 400, 1 << 20);
    return status == GN_OK ? warp_frame(f, &w->light, &camera, &w->grid) : status;
}

/* The nearest depths, by a light pass that draws nothing else. */
static gn_status find_depths(const world *w, gn_depth *depths)
{
    frame f;
    gn_settings settings = w->settings;
    settings.reconstruction = 0;
    gn_status status = frame_start(&f, &w->scene, &settings);
    if (status == GN_OK)
        status = warp_world(&f, w);
    if (status == GN_OK)
        status = gn_light_pass(f.context, &w->light);
    for (uint32_t i = 0; status == GN_OK && i < (uint32_t)settings.map_width * settings.map_height; i++)
        depths[i] = texel_at(f.context, i % settings.map_width, i / settings.map_width);
    return f.block && !frame_end(&f) ? GN_TOO_SMALL : status;
}

/* ---- maps are those of the twin, in any order -------------------------------------------------------------------- */

static void swap_triangles(shape *s, uint32_t a, uint32_t b)
{
    for (uint32_t i = 0; i < 3; i++) {
        uint32_t swap = s->indices[3 * a + i];
        s->indices[3 * a + i] = s->indices[3 * b + i];
        s->indices[3 * b + i] = swap;
    }
}

/* Another order of objects, triangles, edges, regions, workers, and another surface. */
static void stir(world *w)
{
    static const gn_receiver *const receivers[] = {0, &gn_plane_bias, &gn_virtual, &gn_virtual_always};
    for (uint32_t i = 0; i < w->scene.object_count; i++) {
        shape *s = &w->shapes[i];
        int edges = s->mesh.edges != 0;
        drop_edges(s);
        for (uint32_t n = 0; n < s->mesh.triangle_count; n++)
            swap_triangles(s, n, (uint32_t)between(n, s->mesh.triangle_count - 1));
        if (edges)
            make_edges(s);
        uint32_t other = (uint32_t)between(i, w->scene.object_count - 1);
        gn_object swap = w->objects[i];
        w->objects[i] = w->objects[other];
        w->objects[other] = swap;
    }
    w->settings.map_rows = (uint16_t)between(1, w->settings.map_height);
    w->settings.workers = (uint8_t)between(1, 3);
    w->settings.surface = (uint8_t)between(GN_CONSTANT, GN_SLOPE);
    w->settings.layers = GN_LAYERS_AUTO;
    w->settings.cull = GN_CULL_NONE;
    w->settings.receiver = receivers[between(0, 3)];
    if (w->settings.surface == GN_SECOND)
        w->settings.layers = GN_LAYERS_TWO;
}

/* The light pass in steps: regions in turn from a random one on, each on a random worker. */
static gn_status light_in_steps(frame *f, const gn_light *light)
{
    gn_status status = gn_light_begin(f->context, light);
    uint32_t regions = f->plan.light_regions, from = (uint32_t)between(0, regions - 1);
    for (uint32_t i = 0; status == GN_OK && i < regions; i++) {
        uint32_t worker = (uint32_t)between(0, f->settings.workers - 1), region = (from + i) % regions;
        status = gn_light_layers(f->context, region, worker);
        if (status == GN_OK)
            status = gn_light_resolve(f->context, region, worker);
    }
    return status;
}

typedef struct map_count {
    unsigned failures;
    uint64_t maps, regions;
} map_count;

static void compare_map(const world *w, const twin *t, uint64_t n, const char *order, map_count *count)
{
    frame f;
    uint32_t stride = 0;
    uint64_t crossed = 0;
    gn_status status = frame_start(&f, &w->scene, &w->settings);
    if (status == GN_OK)
        status = warp_world(&f, w);
    if (status == GN_OK)
        status = light_in_steps(&f, &w->light);
    const uint8_t *map = status == GN_OK ? gn_crossing_map(f.context, &stride) : 0;
    int32_t wrong = map ? -1 : 0;
    for (int32_t i = 0; map && i < t->width * t->height; i++) {
        uint8_t got = map[(uint32_t)(i / t->width) * stride + (uint32_t)(i % t->width)];
        crossed += got != 0;
        if (got != t->bytes[i] && wrong < 0) {
            wrong = i;
            if (count->failures < 5)
                note("scene %llu, %s, %smap %dx%d, surface %d, %d rows: texel (%d, %d): %02x, expected %02x",
                     (unsigned long long)n, order, w->settings.warp ? "warped " : "", (int)t->width, (int)t->height,
                     (int)w->settings.surface, (int)w->settings.map_rows, (int)(i % t->width), (int)(i / t->width), got,
                     t->bytes[i]);
        }
    }
    if (!map && count->failures < 5)
        note("scene %llu, %s: status %d", (unsigned long long)n, order, (int)status);
    int counted = 1;
    if (map) {
        gn_statistics statistics;
        gn_get_statistics(f.context, &statistics);
        counted = statistics.silhouette_edges == t->edges;
#if GN_STATISTICS
        counted = counted && statistics.silhouette_texels == crossed;
#endif
        if (!counted && count->failures < 5)
            note("scene %llu, %s: %llu edges, %llu texels; expected %llu, %llu", (unsigned long long)n, order,
                 (unsigned long long)statistics.silhouette_edges, (unsigned long long)statistics.silhouette_texels,
                 (unsigned long long)t->edges, (unsigned long long)crossed);
        count->regions += f.plan.light_regions;
    }
    int planned = f.plan.silhouette_bytes == (size_t)t->width * (size_t)t->height;
    int intact = !f.block || frame_end(&f);
    count->maps++;
    count->failures += !map || wrong >= 0 || !counted || !intact || !planned;
}

static void maps_are_the_twins_in_any_order(uint64_t cases)
{
    map_count count = {0};
    uint64_t edges = 0, written = 0, hidden = 0, lost = 0, ties = 0, on_warped = 0;
    for (uint64_t n = 0; n < cases && count.failures < 5; n++) {
        static gn_depth depths[24 * 24];
        static twin t;
        world w;
        random_world(&w);
        memset(&t, 0, sizeof t);
        t.w = &w;
        t.depths = depths;
        t.width = w.settings.map_width;
        t.height = w.settings.map_height;
        gn_status status = find_depths(&w, depths);
        if (status != GN_OK && count.failures++ < 5)
            note("scene %llu: status %d", (unsigned long long)n, (int)status);
        for (uint32_t i = 0; i < w.scene.object_count; i++)
            try_edges(&t, &w.shapes[i]);
        compare_map(&w, &t, n, "as made", &count);
        /* pairs of more than two triangles on an edge may change with their order, and their sums with them */
        stir(&w);
        uint64_t before = t.written;
        on_warped += w.settings.warp ? before : 0;
        memset(t.bytes, 0, sizeof t.bytes);
        t.edges = t.written = 0;
        for (uint32_t i = 0; i < w.scene.object_count; i++)
            try_edges(&t, &w.shapes[i]);
        compare_map(&w, &t, n, "stirred", &count);
        edges += t.edges;
        written += before;
        hidden += t.hidden;
        lost += t.lost;
        ties += t.ties;
        free_world(&w);
    }
    ok(!count.failures,
       "every byte is the twin's, as made and in another order of objects, triangles, regions and workers: %llu maps, "
       "%llu regions, %llu edges",
       (unsigned long long)count.maps, (unsigned long long)count.regions, (unsigned long long)edges);
    ok(written > 20 * cases && hidden > cases && lost > cases && ties > cases && on_warped > 10 * cases &&
           on_warped < written - 10 * cases,
       "%llu crossings, %llu of them on warped maps; %llu behind the texel beyond, %llu more than one on a side, %llu "
       "through centres",
       (unsigned long long)written, (unsigned long long)on_warped, (unsigned long long)hidden, (unsigned long long)lost,
       (unsigned long long)ties);
}

/* ---- straight edges ---------------------------------------------------------------------------------------------- */

enum { IMAGE = 64, EYE = -30000, GROUND = -55000, MOST_PIECES = 24 };

typedef struct edge_scene {
    shape ground, caster;
    gn_object objects[2];
    gn_scene scene;
    gn_light light;
    gn_camera camera;
    gn_settings settings;
    int64_t x, y, a, b; /* on the edge, and its direction; the caster is left of it */
    int32_t eye[2], pixel, texels;
    tables grid; /* with settings.warp */
} edge_scene;

static void random_direction(int64_t *a, int64_t *b)
{
    static const int8_t plain[8][2] = {{1, 0}, {0, 1}, {1, 1}, {1, -1}, {2, 1}, {1, 2}, {-3, 1}, {16, 15}};
    int how = between(0, 1), sign = between(0, 1) ? 1 : -1;
    if (how == 0) {
        const int8_t *d = plain[between(0, 7)];
        *a = sign * d[0];
        *b = sign * d[1];
        return;
    }
    do {
        *a = between(-100, 100);
        *b = between(-100, 100);
    } while (*a == 0 && *b == 0);
}

/* All with enough bias that the ground is not shadowed by its own texels: that is another test's. */
static void choose_test(gn_settings *s)
{
    static const struct {
        uint8_t surface, unit;
        uint32_t bias;
        const gn_receiver *receiver;
    } tests[] = {{GN_CONSTANT, GN_BIAS_WORLD, 300, 0},
                 {GN_CONSTANT, GN_BIAS_WORLD, 200, &gn_virtual},
                 {GN_MIXED, GN_BIAS_TEXELS, 2 << 16, &gn_virtual},
                 {GN_DUAL, GN_BIAS_TEXELS, 2 << 16, &gn_virtual_always},
                 {GN_CONSTANT, GN_BIAS_WORLD, 300, &gn_plane_bias}};
    int i = between(0, 4);
    s->surface = tests[i].surface;
    s->bias.unit = tests[i].unit;
    s->bias.value = tests[i].bias;
    s->receiver = tests[i].receiver;
    s->slope = 2 << 16;
}

/* Half the plane in shadow: a fan from a far point over pieces of one straight edge, slanted; with edges, or loose
 * triangles. Some edges leave the guard band and are clipped. */
static gn_status build_edge(edge_scene *e, int loose)
{
    static const int32_t up[3] = {0, 1, 0};
    memset(e, 0, sizeof *e);
    int32_t texels = between(12, 48), pieces = between(1, MOST_PIECES), step = between(1, 6) * 128;
    int far = between(0, 3) == 0;
    e->texels = texels;
    e->x = between(256 * 3, 256 * (texels - 3));
    e->y = between(256 * 3, 256 * (texels - 3));
    if (between(0, 2) == 0) {
        e->x = (e->x & ~255) + 128;
        e->y = (e->y & ~255) + 128;
    }
    random_direction(&e->a, &e->b);
    int64_t longest = magnitude(e->a) > magnitude(e->b) ? magnitude(e->a) : magnitude(e->b);
    int64_t most = ((int64_t)1 << (far ? 22 : 17)) / longest, along = step / longest + 1;
    e->ground = shape_new(0);
    e->caster = shape_new(0);
    add_level(&e->ground, -(1 << 17), -(1 << 17), 1 << 17, 1 << 17, GROUND, 1);
    int32_t level = between(-15000, -3000);
    for (int32_t i = 0; i <= pieces; i++) {
        int64_t k = i == 0 ? -most : i == pieces ? most : (i - pieces / 2) * along;
        add_vertex(&e->caster, (int32_t)(e->x + k * e->a), (int32_t)(e->y + k * e->b), level + between(-1500, 1500));
    }
    uint32_t apex = add_vertex(&e->caster, (int32_t)(e->x - most * e->b), (int32_t)(e->y + most * e->a),
                               level + between(-1500, 1500));
    for (uint32_t i = 0; i < (uint32_t)pieces; i++)
        add_triangle(&e->caster, i, i + 1, apex);
    if (!loose) {
        make_edges(&e->caster);
        make_edges(&e->ground);
    }
    e->light = grid_light((uint32_t)texels, (uint32_t)texels);
    e->eye[0] = (int32_t)e->x + between(-256, 256);
    e->eye[1] = (int32_t)e->y + between(-256, 256);
    e->pixel = between(1, 20);
    e->objects[0].mesh = &e->ground.mesh;
    e->objects[1].mesh = &e->caster.mesh;
    e->scene.objects = e->objects;
    e->scene.object_count = 2;
    e->settings = gn_default_settings(IMAGE, IMAGE, (uint16_t)texels);
    choose_test(&e->settings);
    e->settings.format = GN_NO_COLOUR;
    e->settings.mask = 1;
    e->settings.reconstruction = &gn_crossings;
    e->settings.warp = between(0, 1) ? &gn_rectilinear : 0;
    random_tables(&e->grid, &e->settings);
    int32_t eye[3] = {e->eye[0], e->eye[1], EYE}, target[3] = {e->eye[0], e->eye[1], EYE - 1000};
    gn_status status = gn_look_at(&e->camera, eye, target, up);
    return status == GN_OK ? gn_orthographic(&e->camera, e->pixel * (IMAGE / 2), 1, 60000) : status;
}

typedef struct edge_count {
    unsigned failures;
    uint64_t lit, shadowed, skipped;
    int64_t worst, worst_warped; /* 1/4096 texel */
} edge_count;

/* The width, or height, of the cell that holds a place of a warped map, 1/256 fine texel, where it may be the next
 * one's the larger of both; 0: there is none. */
static int64_t find_width(const edge_scene *e, const uint16_t *places, int64_t at)
{
    int64_t width = 0;
    for (int32_t i = 0; i + 1 < e->texels; i++) {
        int64_t from = 256 * (int64_t)places[i] + 128, to = 256 * (int64_t)places[i + 1] + 128;
        if (at >= from - 2 && at <= to + 2 && (to - from) / 256 > width)
            width = (to - from) / 256;
    }
    return at < 256 * (int64_t)places[0] + 128 || at > 256 * (int64_t)places[e->texels - 1] + 128 ? 0 : width;
}

/* A crossing is off by 1/16 of its side, so a line between two is nowhere farther from the edge than that along one of
 * the axes; a clipped edge by the rounding of its ends more, and a pixel's place is rounded along both axes. All in
 * 1/256 texel: 16, 1 and 1. On a warped map a place is rounded twice, and vertices by half of 1/256 fine texel. Returns
 * the pixels that are wrong and farther. */
static uint64_t judge_edge(const edge_scene *e, const frame *f, edge_count *count)
{
    uint64_t wrong = 0;
    const int64_t size = 512 * e->texels; /* twice the map's */
    for (int i = 0; i < IMAGE * IMAGE; i++) {
        /* twice the place on the ground */
        int64_t x = 2 * (int64_t)e->eye[0] + (int64_t)(2 * (i % IMAGE) + 1 - IMAGE) * e->pixel;
        int64_t y = 2 * (int64_t)e->eye[1] - (int64_t)(2 * (i / IMAGE) + 1 - IMAGE) * e->pixel;
        int64_t width = 1, height = 1, fine = e->settings.warp ? GN_FINE : e->texels;
        if (e->settings.warp) {
            width = find_width(e, e->grid.columns, floor_divide(x * GN_FINE * 256, size));
            height = find_width(e, e->grid.rows, floor_divide((size - y) * GN_FINE * 256, size));
        } else if (x < 256 || y < 256 || x >= size - 256 || y >= size - 256) {
            width = 0;
        }
        if (!width || !height) { /* beyond the cells */
            count->skipped++;
            continue;
        }
        int64_t side = e->a * (y - 2 * e->y) - e->b * (x - 2 * e->x);
        int expected = side > 0 ? 0 : 254, got = f->mask[i];
        count->lit += got == 254;
        count->shadowed += got == 0;
        if (got == expected)
            continue;
        int64_t across = magnitude(e->b) * width, down = magnitude(e->a) * height;
        int64_t larger = across > down ? across : down;
        int64_t distance = (magnitude(side) * fine * 8 + larger * e->texels - 1) / (larger * e->texels); /* 1/4096 */
        int64_t limit = 2 * (17 * larger + (e->settings.warp ? 3 : 1) * (across + down)) * e->texels;
        int64_t *worst = e->settings.warp ? &count->worst_warped : &count->worst;
        *worst = distance > *worst ? distance : *worst;
        wrong += magnitude(side) * fine > limit;
    }
    return wrong;
}

static void straight_edges_are_where_they_are(uint64_t cases, int loose)
{
    edge_count count = {0}, plain = {0};
    uint64_t beyond_without = 0, decided = 0;
    for (uint64_t n = 0; n < cases && count.failures < 5; n++) {
        edge_scene e;
        frame f;
        memset(&f, 0, sizeof f);
        gn_status status = build_edge(&e, loose);
        if (status == GN_OK)
            status = frame_start(&f, &e.scene, &e.settings);
        if (status == GN_OK && e.settings.warp)
            status = warp_frame(&f, &e.light, &e.camera, &e.grid);
        if (status == GN_OK)
            status = frame_render(&f, &e.light, &e.camera);
        uint64_t wrong = status == GN_OK ? judge_edge(&e, &f, &count) : 0;
        if ((status != GN_OK || wrong) && count.failures++ < 5)
            note("edge %llu: status %d, through (%ld, %ld) along (%ld, %ld), map %d, %d units a pixel, surface %d: "
                 "%llu pixels wrong",
                 (unsigned long long)n, (int)status, (long)e.x, (long)e.y, (long)e.a, (long)e.b, (int)e.texels,
                 (int)e.pixel, (int)e.settings.surface, (unsigned long long)wrong);
        if (status == GN_OK) {
            gn_statistics statistics;
            gn_get_statistics(f.context, &statistics);
            decided += statistics.pixels_silhouette;
            count.failures += statistics.pixels_silhouette > statistics.pixels_tested;
        }
        count.failures += f.block && !frame_end(&f);
        e.settings.reconstruction = 0;
        e.settings.warp = 0;
        memset(&f, 0, sizeof f);
        if (status == GN_OK && n % 8 == 0 && frame_start(&f, &e.scene, &e.settings) == GN_OK &&
            frame_render(&f, &e.light, &e.camera) == GN_OK)
            beyond_without += judge_edge(&e, &f, &plain);
        count.failures += f.block && !frame_end(&f);
        free_shape(&e.ground);
        free_shape(&e.caster);
    }
    ok(!count.failures,
       "straight edges of %s: no pixel beyond 1/16 texel and rounding, %ld/4096 at most (%ld without crossings), "
       "on warped maps %ld/4096 of a cell",
       loose ? "loose triangles" : "a mesh", (long)count.worst, (long)plain.worst, (long)count.worst_warped);
    ok(count.lit > 500 * cases && count.shadowed > 500 * cases && beyond_without > 10 * cases && count.worst > 128 &&
           count.worst_warped > 128 && (!GN_STATISTICS || decided > 100 * cases),
       "%llu pixels lit, %llu shadowed, %llu decided by crossings; without them %llu are wrong",
       (unsigned long long)count.lit, (unsigned long long)count.shadowed, (unsigned long long)decided,
       (unsigned long long)beyond_without);
}

/* ---- memory, statuses, other maps -------------------------------------------------------------------------------- */

static void no_depth_is_kept_with_a_crossing(void)
{
    world w;
    gn_plan plain, crossings, silhouettes;
    random_world(&w);
    w.settings.warp = 0;
    w.settings.map_width = 64;
    w.settings.map_height = 32;
    w.settings.map_rows = 16;
    w.settings.workers = 2;
    int planned = gn_make_plan(&crossings, &w.scene, &w.settings) == GN_OK;
    w.settings.reconstruction = &gn_silhouettes;
    planned = planned && gn_make_plan(&silhouettes, &w.scene, &w.settings) == GN_OK;
    w.settings.reconstruction = 0;
    planned = planned && gn_make_plan(&plain, &w.scene, &w.settings) == GN_OK;
    /* a byte a texel, a row of 64 depths and padding a worker, 2 bits a triangle, a bit an edge, 64 for what says so */
    size_t most = 64 * 32 + 2 * (64 + GN_ROW_PADDING) * sizeof(gn_depth) + plain.triangles / 4 + plain.edges / 8 + 128;
    ok(planned && crossings.silhouette_bytes == 64 * 32 && crossings.light_bytes > plain.light_bytes + 64 * 32 &&
           crossings.light_bytes <= plain.light_bytes + most,
       "the light pass needs %lu bytes for crossings, at most %lu",
       (unsigned long)(crossings.light_bytes - plain.light_bytes), (unsigned long)most);
    ok(planned && silhouettes.light_bytes == crossings.light_bytes + 2 * 64 * 16 * sizeof(gn_depth),
       "silhouettes need a depth a texel of a region and worker more");
    free_world(&w);
}

static void maps_are_asked_for_by_their_kind(void)
{
    world w;
    frame f;
    uint32_t stride = 77;
    random_world(&w);
    w.settings.warp = 0;
    int good = frame_start(&f, &w.scene, &w.settings) == GN_OK && !gn_crossing_map(f.context, &stride) &&
               gn_light_pass(f.context, &w.light) == GN_OK && gn_crossing_map(f.context, &stride) &&
               stride == w.settings.map_width && !gn_silhouette_map(f.context, &stride);
    good = frame_end(&f) && good;
    ok(good, "a context with crossings has no silhouette map");
    w.settings.reconstruction = &gn_silhouettes;
    good = frame_start(&f, &w.scene, &w.settings) == GN_OK && gn_light_pass(f.context, &w.light) == GN_OK &&
           gn_silhouette_map(f.context, &stride) && !gn_crossing_map(f.context, &stride);
    good = frame_end(&f) && good;
    w.settings.reconstruction = 0;
    good = frame_start(&f, &w.scene, &w.settings) == GN_OK && !gn_crossing_map(f.context, &stride) &&
           !gn_crossing_map(0, &stride) && good;
    good = frame_end(&f) && good;
    ok(good, "and one with silhouettes, or neither, no map of crossings");
    free_world(&w);
}

static void wrong_edges_are_refused(void)
{
    gn_plan plan;
    world w;
    memset(&w, 0, sizeof w);
    int32_t low[3] = {0, 0, -9}, high[3] = {900, 900, -1};
    w.shapes[0] = shape_new(1);
    add_box(&w.shapes[0], low, high);
    make_edges(&w.shapes[0]);
    w.objects[0].mesh = &w.shapes[0].mesh;
    w.scene.objects = w.objects;
    w.scene.object_count = 1;
    gn_settings settings = gn_default_settings(8, 8, 8);
    settings.reconstruction = &gn_crossings;
    ok(w.shapes[0].mesh.edge_count == 18 && gn_make_plan(&plan, &w.scene, &settings) == GN_OK && plan.edges == 18,
       "a box has 18 edges");
    w.shapes[0].mesh.edge_count--;
    ok(gn_make_plan(&plan, &w.scene, &settings) == GN_BAD_MESH, "too few edges are refused");
    free_world(&w);
}

int main(int argc, char **argv)
{
    uint64_t cases = tap_cases(argc, argv, 1000);
    places_are_beyond_the_lines_between_crossings(500 * cases);
    places_beyond_the_cells_are_the_nearest_texels(50 * cases);
    borders_meet_on_sides(cases);
    maps_are_the_twins_in_any_order(2 * cases);
    straight_edges_are_where_they_are(cases, 0);
    straight_edges_are_where_they_are(cases, 1);
    no_depth_is_kept_with_a_crossing();
    maps_are_asked_for_by_their_kind();
    wrong_edges_are_refused();
    return tap_done();
}
