/* Silhouette maps (Sen et al. 2003). The reconstruction against figure 5 of the paper, eight regions by angles, on
 * random bytes; where lines cross from cell to cell. Straight edges of any direction, seen from above: no pixel farther
 * from the edge than an offset is rounded may be wrong. The whole map against a slow twin: every edge in every cell,
 * facings in 128 bits, cells by separating axes; and the same map whatever the order of triangles, edges, objects,
 * regions and workers. What is hidden, clipped, without edges, by hand. Cases: 8000, or GNOMON_CASES.
 */
#include "gn_cascade.h"
#include "gn_clip.h"
#include "gn_unequal_cells.h"
#include "mesh_edges.h"
#include "quadrants.h"
#include "warped.h"

__extension__ typedef __int128 exact;

enum { CENTRE = 0x88 };

static int64_t floor_divide(int64_t n, int64_t d)
{
    int64_t q = n / d;
    return q - (n - q * d < 0);
}

static int64_t magnitude(int64_t v)
{
    return v < 0 ? -v : v;
}

/* ---- the paper's figure 5 ---------------------------------------------------------------------------------------- */

enum { MOST_SIDE = 7, PADDING = 3 };

/* A map made by hand: points of cells, which of the texels shadow a plane, and that plane. */
typedef struct patch {
    int32_t width, height, bits;
    uint8_t cells[MOST_SIDE * MOST_SIDE];
    uint8_t dark[MOST_SIDE * MOST_SIDE];
    gn_depth texels[MOST_SIDE * (MOST_SIDE + PADDING)];
    gn_wide_plane plane;
    uint16_t columns[MOST_SIDE], rows[MOST_SIDE]; /* where texels lie, of warped maps */
    int warped;
    gn_grid grid;
    gn_lookup lookup;
} patch;

static void set_lookup(patch *p)
{
    gn_lookup l = {.map = p->texels,
                   .stride = (uint32_t)(p->width + PADDING),
                   .last_column = (uint32_t)p->width - 1,
                   .last_row = (uint32_t)p->height - 1,
                   .bits = (uint32_t)p->bits,
                   .whole = gn_silhouettes.whole,
                   .silhouettes = p->cells,
                   .columns = p->warped ? p->columns : 0,
                   .rows = p->warped ? p->rows : 0,
                   .grid = p->warped ? &p->grid : 0};
    p->grid.cells = &gn_rectilinear_cells;
    p->lookup = l;
}

/* Texels hold the plane's depth, which is lit, or one unit less, which is not. */
static void set_texel(patch *p, int32_t column, int32_t row, int dark)
{
    int64_t z = p->plane.base + column * p->plane.dx + row * p->plane.dy;
    p->dark[row * p->width + column] = (uint8_t)dark;
    p->texels[row * (p->width + PADDING) + column] = (gn_depth)((gn_depth)(z >> (32 - GN_DEPTH_BITS)) - (gn_depth)dark);
}

/* Cells of one fine texel, of powers of two, and of any width. */
static void random_places(uint16_t *places, int32_t count)
{
    int32_t at = between(0, 9);
    for (int32_t i = 0; i < count; i++) {
        int how = between(0, 3);
        places[i] = (uint16_t)at;
        at += how == 0 ? 1 : how == 1 ? 1 << between(0, 9) : between(1, how == 2 ? 9 : 560);
    }
}

static void random_patch(patch *p)
{
    p->warped = between(0, 1);
    random_places(p->columns, MOST_SIDE);
    random_places(p->rows, MOST_SIDE);
    p->width = between(2, MOST_SIDE);
    p->height = between(2, MOST_SIDE);
    p->bits = between(8, 18);
    p->plane.base = (int64_t)1 << 31;
    p->plane.dx = between(0, 1) ? between(-(1 << 24), 1 << 24) : 0;
    p->plane.dy = between(0, 1) ? between(-(1 << 24), 1 << 24) : 0;
    for (int32_t row = 0; row < p->height; row++)
        for (int32_t column = 0; column < p->width; column++) {
            int cell = column + 1 < p->width && row + 1 < p->height;
            p->cells[row * p->width + column] = (uint8_t)(cell && between(0, 4) ? (uint64_t)between(0, 255) : CENTRE);
            set_texel(p, column, row, between(0, 1));
        }
    set_lookup(p);
}

/* Width or height of a cell in fine texels; beyond the map's cells that of the outermost. */
static int64_t size_of(const patch *p, const uint16_t *places, int32_t cell, int32_t count)
{
    cell = cell < 0 ? 0 : cell < count - 1 ? cell : count - 2;
    return p->warped ? places[cell + 1] - places[cell] : 1;
}

static int64_t width_of(const patch *p, int32_t column)
{
    return size_of(p, p->columns, column, p->width);
}

static int64_t height_of(const patch *p, int32_t row)
{
    return size_of(p, p->rows, row, p->height);
}

/* The byte of a cell. Beyond the map there are centres. */
static uint8_t byte_of(const patch *p, int32_t column, int32_t row)
{
    int beyond = column < 0 || row < 0 || column >= p->width - 1 || row >= p->height - 1;
    return beyond ? CENTRE : p->cells[row * p->width + column];
}

/* The point of a neighbour from the upper left corner of a cell, in 1/16 texel, of warped maps in 1/16 fine texel. */
static vector point_from(const patch *p, int32_t column, int32_t row, int32_t across, int32_t down)
{
    uint8_t byte = byte_of(p, column + across, row + down);
    int64_t left = across > 0 ? width_of(p, column) : across < 0 ? -width_of(p, column - 1) : 0;
    int64_t top = down > 0 ? height_of(p, row) : down < 0 ? -height_of(p, row - 1) : 0;
    vector v = {16 * left + width_of(p, column + across) * (byte & 15),
                16 * top + height_of(p, row + down) * (byte >> 4)};
    return v;
}

/* The quadrant of a place in a cell. */
static int find_quadrant(const patch *p, int32_t column, int32_t row, int64_t x, int64_t y, int *line)
{
    uint8_t cells[5];
    cell_sizes sizes;
    for (int i = 0; i < 5; i++)
        cells[i] = byte_of(p, column + (i == 1) - (i == 3), row + (i == 2) - (i == 4));
    for (int i = 0; i < 3; i++) {
        sizes.width[i] = width_of(p, column + i - 1);
        sizes.height[i] = height_of(p, row + i - 1);
    }
    return find_region_of(cells, &sizes, p->bits, x, y, line);
}

/* A place in a cell: anywhere, on a line, or about one. */
static vector random_place(const patch *p, int32_t column, int32_t row)
{
    int64_t one = (int64_t)1 << p->bits, side = between(0, 3);
    vector place = {between(0, one - 1), between(0, one - 1)};
    if (between(0, 2) == 0)
        return place;
    vector from = point_from(p, column, row, 0, 0);
    vector to = point_from(p, column, row, side == 0 ? 1 : side == 2 ? -1 : 0, side == 1 ? 1 : side == 3 ? -1 : 0);
    int64_t part = between(0, 16), unit = (int64_t)1 << (p->bits - 8);
    place.x = floor_divide((16 * from.x + part * (to.x - from.x)) * unit, width_of(p, column));
    place.y = floor_divide((16 * from.y + part * (to.y - from.y)) * unit, height_of(p, row));
    if (between(0, 1)) {
        place.x += between(-1, 1);
        place.y += between(-1, 1);
    }
    place.x = place.x < 0 ? 0 : place.x < one ? place.x : one - 1;
    place.y = place.y < 0 ? 0 : place.y < one ? place.y : one - 1;
    return place;
}

static gn_points points;

static uint32_t sample_at(const gn_reconstruction *how, const patch *p, int32_t column, int32_t row, vector place)
{
    points.u[0] = (uint32_t)(((int64_t)column << p->bits) + place.x);
    points.v[0] = (uint32_t)(((int64_t)row << p->bits) + place.y);
#if GN_STATISTICS
    points.reconstructed[0] = 0;
#endif
    return how->sample(&p->lookup, &points, 0, &p->plane);
}

/* A place and its answer, by whatever texels. */
static int dark_of(const patch *p, int32_t column, int32_t row, int quadrant)
{
    return p->dark[(row + (quadrant >> 1)) * p->width + column + (quadrant & 1)];
}

static int all_alike(const patch *p, int32_t column, int32_t row)
{
    int sum = 0;
    for (int i = 0; i < 4; i++)
        sum += dark_of(p, column, row, i);
    return sum == 0 || sum == 4;
}

/* How many of four places about this one are shadowed. */
static uint32_t smooth_of(const patch *p, int32_t column, int32_t row, vector place)
{
    uint32_t sum = 0;
    for (int i = 0; i < 4; i++) {
        int line;
        vector one = find_one_of_four(i, p->bits, place.x, place.y);
        sum += (uint32_t)dark_of(p, column, row, find_quadrant(p, column, row, one.x, one.y, &line));
    }
    return sum;
}

static void quadrants_are_figure_5(uint64_t cases)
{
    static patch p;
    uint64_t seen[4] = {0}, on_lines = 0, open = 0, partly = 0, warped = 0, on_warped = 0;
    unsigned failures = 0;
    for (uint64_t n = 0; n < cases && failures < 5; n++) {
        int line;
        if (n % 8 == 0)
            random_patch(&p);
        int32_t column = between(0, p.width - 2), row = between(0, p.height - 2);
        vector place = random_place(&p, column, row);
        int region = find_quadrant(&p, column, row, place.x, place.y, &line), alike = all_alike(&p, column, row);
        uint32_t got = sample_at(&gn_silhouettes, &p, column, row, place);
        uint32_t expected = region >= 0 && dark_of(&p, column, row, region) ? GN_DARK : 0;
        int counted = 1;
#if GN_STATISTICS
        counted = points.reconstructed[0] == !alike;
#endif
        if ((region < 0 || got != expected || !counted) && failures++ < 5)
            note("map %dx%d, %d bits, cell (%d, %d), place (%ld, %ld): got %lx, expected %lx of quadrant %d%s%s",
                 (int)p.width, (int)p.height, (int)p.bits, (int)column, (int)row, (long)place.x, (long)place.y,
                 (unsigned long)got, (unsigned long)expected, region, line ? " on a line" : "",
                 counted ? "" : "; miscounted");
        uint32_t smooth = sample_at(&gn_silhouettes_smooth, &p, column, row, place);
        uint32_t of_four = smooth_of(&p, column, row, place);
        if (smooth != of_four && failures++ < 5)
            note("map %dx%d, %d bits, cell (%d, %d), place (%ld, %ld): smooth %lu, expected %lu of 4", (int)p.width,
                 (int)p.height, (int)p.bits, (int)column, (int)row, (long)place.x, (long)place.y, (unsigned long)smooth,
                 (unsigned long)of_four);
        if (region >= 0)
            seen[region]++;
        on_lines += (uint64_t)line;
        warped += (uint64_t)p.warped;
        on_warped += (uint64_t)(p.warped && line);
        open += (uint64_t)!alike;
        partly += of_four > 0 && of_four < 4;
    }
    ok(!failures, "quadrants are figure 5's eight regions, by angles: %llu places, %llu in cells whose texels differ",
       (unsigned long long)cases, (unsigned long long)open);
    ok(seen[0] > cases / 10 && seen[1] > cases / 10 && seen[2] > cases / 10 && seen[3] > cases / 10 &&
           on_lines > cases / 10 && open > cases / 2 && partly > cases / 10 && warped > cases / 4 &&
           on_warped > cases / 50,
       "%llu, %llu, %llu, %llu in the four quadrants; %llu on a line; %llu smoothed; %llu on warped maps, %llu of them "
       "on a line",
       (unsigned long long)seen[0], (unsigned long long)seen[1], (unsigned long long)seen[2],
       (unsigned long long)seen[3], (unsigned long long)on_lines, (unsigned long long)partly,
       (unsigned long long)warped, (unsigned long long)on_warped);
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
        int64_t one = (int64_t)1 << p.bits;
        int64_t u = between(-one / 2, p.width * one - one / 2 - 1), v = between(-one / 2, p.height * one - one / 2 - 1);
        if (between(0, 1))
            u = between(0, 1) ? between(-one / 2, -1) : between((p.width - 1) * one, p.width * one - one / 2 - 1);
        else
            v = between(0, 1) ? between(-one / 2, -1) : between((p.height - 1) * one, p.height * one - one / 2 - 1);
        int64_t column = floor_divide(u + one / 2, one), row = floor_divide(v + one / 2, one);
        vector place = {u, v};
        uint32_t got = sample_at(&gn_silhouettes, &p, 0, 0, place);
        uint32_t expected = p.dark[row * p.width + column] ? GN_DARK : 0;
        dark += expected != 0;
        if (got != expected && failures++ < 5)
            note("map %dx%d, %d bits, place (%ld, %ld): got %lx, expected %lx", (int)p.width, (int)p.height,
                 (int)p.bits, (long)u, (long)v, (unsigned long)got, (unsigned long)expected);
    }
    ok(!failures && dark > cases / 4 && dark < cases - cases / 4,
       "places beyond the cells are the nearest texel's: %llu of %llu shadowed", (unsigned long long)dark,
       (unsigned long long)cases);
}

/* ---- from cell to cell ------------------------------------------------------------------------------------------- */

/* The first of the places along a column (or row) of places that is below (or right of) the line between the points of
 * two cells, as the reconstruction has it in one of them. */
static int64_t find_split(patch *p, int32_t column, int32_t row, int64_t along, int down)
{
    int64_t low = 0, high = (int64_t)1 << p->bits; /* all before low are not, all from high on are */
    for (int i = 0; i < 4; i++)
        set_texel(p, column + (i & 1), row + (i >> 1), down ? i >> 1 : i & 1);
    while (low < high) {
        int64_t middle = (low + high) / 2;
        vector place = {down ? along : middle, down ? middle : along};
        if (sample_at(&gn_silhouettes, p, column, row, place))
            high = middle;
        else
            low = middle + 1;
    }
    return low;
}

/* On each side between two cells: the last places of the one and the first of the other are parted where the line
 * between their points is. */
static void check_sides(patch *p, uint64_t *sides, uint64_t *slanted, unsigned *failures)
{
    int64_t one = (int64_t)1 << p->bits;
    for (int32_t row = 0; row < p->height - 1; row++)
        for (int32_t column = 0; column < p->width - 1; column++)
            for (int down = 0; down < 2; down++) {
                /* with down the side is upright, between a cell and its right neighbour */
                int32_t across = down, below = !down;
                if (column + across >= p->width - 1 || row + below >= p->height - 1)
                    continue;
                vector from = point_from(p, column, row, 0, 0), to = point_from(p, column, row, across, below);
                int64_t run = down ? to.x - from.x : to.y - from.y, rise = down ? to.y - from.y : to.x - from.x;
                int64_t start = down ? from.x : from.y, at = down ? from.y : from.x;
                int64_t expected[2], got[2];
                /* of the cell, towards the neighbour and along the side, where both are alike */
                int64_t size = down ? width_of(p, column) : height_of(p, row);
                int64_t length = down ? height_of(p, row) : width_of(p, column);
                for (int i = 0; i < 2; i++) {
                    /* in 1/16 of a place's unit: at + rise (place - start) / run, the first place beyond; a place on
                     * the line is below it, or right of it */
                    int64_t n = (16 * (one - 1 + i) * size - start * one) * rise + at * one * run;
                    expected[i] = -floor_divide(-n, 16 * run * length);
                    expected[i] = expected[i] < one ? expected[i] : one;
                    got[i] = find_split(p, column + (i ? across : 0), row + (i ? below : 0), i ? 0 : one - 1, down);
                }
                ++*sides;
                *slanted += rise != 0;
                if ((got[0] != expected[0] || got[1] != expected[1]) && (*failures)++ < 5)
                    note("side %s cell (%d, %d), points (%ld, %ld) and (%ld, %ld): parted at %ld and %ld of %ld, "
                         "expected %ld and %ld",
                         down ? "right of" : "below", (int)column, (int)row, (long)from.x, (long)from.y, (long)to.x,
                         (long)to.y, (long)got[0], (long)got[1], (long)one, (long)expected[0], (long)expected[1]);
            }
}

static void borders_go_on_in_the_next_cell(uint64_t cases)
{
    static patch p;
    uint64_t sides = 0, slanted = 0;
    unsigned failures = 0;
    for (uint64_t n = 0; n < cases && failures < 5; n++) {
        random_patch(&p);
        check_sides(&p, &sides, &slanted, &failures);
    }
    ok(!failures && sides > 4 * cases && slanted > sides / 2,
       "borders meet on the sides between cells, to a place of the finest: %llu sides of random maps, %llu of lines at "
       "an angle",
       (unsigned long long)sides, (unsigned long long)slanted);
}

/* ---- meshes with edges ------------------------------------------------------------------------------------------- */

static void free_shape(shape *s)
{
    free(edges_of(s));
    shape_free(s);
}

/* ---- straight edges ---------------------------------------------------------------------------------------------- */

/* An offset is rounded to the nearest 1/16, but the last half of them to 15/16; the point is rounded down to 1/256
 * texel before; a place on the map to 1/256 as well. On a warped map a place is rounded once more from fine texels to
 * texels, and vertices, which are not in whole parts of a fine texel, by half of 1/256. */
enum { SIXTEENTH = 16, ROUNDING = 2, ROUNDING_WARPED = 2, IMAGE = 96, MOST_POINTS = 44 };

typedef struct edge_scene {
    shape ground, caster;
    gn_object objects[2];
    gn_scene scene;
    gn_light light;
    gn_camera camera;
    gn_settings settings;
    int64_t x, y, a, b;    /* on the edge's shadow on the ground, and its direction; the caster is left of it */
    int32_t eye[2], pixel; /* where the camera stands; the width of a pixel on the ground */
    int32_t width;         /* of the map on the ground */
    int32_t rounding;      /* 1/256 texel */
    tables grid;           /* with settings.warp */
    int far, test;         /* clipped; of the ways to test a pixel */
} edge_scene;

/* A solid or a sheet over a polygon that is a fan from its last point, seen counter-clockwise from above. */
static void add_prism(shape *s, const int64_t (*p)[2], const int32_t *top, int count, int32_t thickness)
{
    uint32_t first = s->mesh.vertex_count, n = (uint32_t)count;
    for (int side = 0; side < (thickness ? 2 : 1); side++)
        for (int i = 0; i < count; i++)
            add_vertex(s, (int32_t)p[i][0], (int32_t)p[i][1], top[i] - side * thickness);
    for (uint32_t i = 0; i + 2 < n; i++) {
        add_triangle(s, first + n - 1, first + i, first + i + 1);
        if (thickness)
            add_triangle(s, first + 2 * n - 1, first + n + i + 1, first + n + i);
    }
    for (uint32_t i = 0; thickness && i < n; i++) {
        uint32_t j = (i + 1) % n;
        add_triangle(s, first + i, first + n + i, first + n + j);
        add_triangle(s, first + i, first + n + j, first + j);
    }
}

static void random_direction(int64_t *a, int64_t *b)
{
    static const int8_t plain[8][2] = {{1, 0}, {0, 1}, {1, 1}, {1, -1}, {2, 1}, {1, 2}, {-3, 1}, {16, 15}};
    int how = between(0, 2), sign = between(0, 1) ? 1 : -1;
    if (how == 0) {
        const int8_t *d = plain[between(0, 7)];
        *a = sign * d[0];
        *b = sign * d[1];
        return;
    }
    do {
        *a = how == 1 ? between(-20, 20) : between(-300, 300);
        *b = how == 1 ? between(-20, 20) : between(-300, 300);
    } while (*a == 0 && *b == 0);
}

/* A place on the map: anywhere, on a texel's border or through its corner or centre. */
static int32_t random_on_map(int32_t texels)
{
    int32_t v = between(256 * 3, 256 * (texels - 3)), how = between(0, 4);
    return how == 0 ? v & ~255 : how == 1 ? (v & ~255) + 128 : how == 2 ? (v & ~15) + 8 : v;
}

/* In order, each once. Returns how many are left. */
static int sort(int64_t *v, int count)
{
    int left = 0;
    for (int i = 1; i < count; i++)
        for (int j = i; j > 0 && v[j] < v[j - 1]; j--) {
            int64_t swap = v[j];
            v[j] = v[j - 1];
            v[j - 1] = swap;
        }
    for (int i = 0; i < count; i++)
        if (i == 0 || v[i] != v[left - 1])
            v[left++] = v[i];
    return left;
}

static gn_status look_down(gn_camera *camera, int32_t x, int32_t y, int32_t z, int32_t half_height, int32_t far_depth)
{
    static const int32_t up[3] = {0, 1, 0};
    int32_t eye[3] = {x, y, z}, target[3] = {x, y, z - 1000};
    gn_status status = gn_look_at(camera, eye, target, up);
    return status == GN_OK ? gn_orthographic(camera, half_height, 1, far_depth) : status;
}

enum { EYE = -30000, GROUND = -55000, LAMP = 1000 };

/* All with enough bias that a slanted ground is not shadowed by its own texels: that is another test's. */
static int choose_test(gn_settings *s)
{
    static const struct {
        uint8_t surface, unit;
        uint32_t bias;
        const gn_receiver *receiver;
    } tests[] = {{GN_CONSTANT, GN_BIAS_WORLD, 1500, 0},
                 {GN_CONSTANT, GN_BIAS_WORLD, 200, &gn_virtual},
                 {GN_MIXED, GN_BIAS_TEXELS, 2 << 16, &gn_virtual},
                 {GN_DUAL, GN_BIAS_TEXELS, 2 << 16, &gn_virtual},
                 {GN_SECOND, GN_BIAS_WORLD, 0, &gn_virtual_always},
                 {GN_CONSTANT, GN_BIAS_WORLD, 300, &gn_plane_bias}};
    int i = between(0, 5);
    s->surface = tests[i].surface;
    s->bias.unit = tests[i].unit;
    s->bias.value = tests[i].bias;
    s->receiver = tests[i].receiver;
    s->slope = 2 << 16;
    s->layers = i == 4 ? GN_LAYERS_TWO : GN_LAYERS_AUTO;
    return i;
}

/* The caster over the place (x, y): its edge in many collinear pieces, that begin and end anywhere, or a long one; now
 * and then one that leaves the guard band. Returns a place on the edge, from (x, y) in its direction. */
static int64_t add_caster(edge_scene *e, int32_t texels, int32_t x, int32_t y, int spot)
{
    int64_t place[MOST_POINTS], outline[MOST_POINTS + 1][2], reach = 8 * 256 * texels;
    int32_t top[MOST_POINTS + 1], level = between(-15000, -1000);
    int count = between(0, 2) ? between(2, MOST_POINTS) : 2;
    int64_t longest = magnitude(e->a) > magnitude(e->b) ? magnitude(e->a) : magnitude(e->b);
    int64_t most = (e->far ? (int64_t)1 << 22 : reach) / longest;
    for (int i = 0; i < count; i++)
        place[i] = i == 0 ? -most : i == 1 ? most : between(-reach / 8, reach / 8) / longest;
    count = sort(place, count);
    for (int i = 0; i < count; i++) {
        outline[i][0] = x + place[i] * e->a;
        outline[i][1] = y + place[i] * e->b;
    }
    outline[count][0] = x - most * e->b;
    outline[count][1] = y + most * e->a;
    for (int i = 0; i <= count; i++)
        top[i] = spot ? 0 : level + between(-1000, 1000);
    add_prism(&e->caster, (const int64_t(*)[2])outline, top, count + 1, e->caster.mesh.closed ? between(1, 3000) : 0);
    make_edges(&e->caster);
    int64_t piece = place[between(0, count - 1)];
    return magnitude(piece) > reach / 8 / longest ? 0 : piece;
}

/* A ground that rises by so much from the middle to its sides. */
static void add_ground(edge_scene *e, int32_t z, int32_t across, int32_t along)
{
    const int32_t all = 1 << 17;
    int32_t corner[4][3] = {{-all, -all, z - across - along},
                            {all, -all, z + across - along},
                            {all, all, z + across + along},
                            {-all, all, z - across + along}};
    add_quad(&e->ground, corner[0], corner[1], corner[2], corner[3]);
    make_edges(&e->ground);
}

static gn_status light_by_sun(edge_scene *e, int32_t texels)
{
    int32_t x = random_on_map(texels), y = random_on_map(texels);
    e->far = between(0, 3) == 0;
    e->rounding = ROUNDING + (e->far ? 1 : 0);
    e->caster = shape_new(between(0, 1));
    int64_t piece = add_caster(e, texels, x, y, 0);
    /* receivers other than the point know the plane that it lies in; but that its depths differ by no more than the
     * bias from one texel to the next, or all of them may vote a point of it dark */
    int32_t slant = !e->settings.receiver ? 0
                    : e->settings.warp    ? (e->test == 5 ? 0 : 500)
                                          : 8000,
            across = between(-slant, slant);
    add_ground(e, GROUND, across, between(-slant, slant));
    e->x = x;
    e->y = y;
    e->eye[0] = (int32_t)(x + piece * e->a + between(-256, 256));
    e->eye[1] = (int32_t)(y + piece * e->b + between(-256, 256));
    e->pixel = between(1, 20);
    e->width = 256 * texels;
    e->light = grid_light((uint32_t)texels, (uint32_t)texels);
    return look_down(&e->camera, e->eye[0], e->eye[1], EYE, e->pixel * (IMAGE / 2), 60000);
}

/* The lamp hangs over the middle of the map. The ground is so many times as far from it as the sheet, and all is so
 * many times as large there. Sheets only: a solid's lower rim would shadow beyond its upper one. */
static gn_status light_by_lamp(edge_scene *e, int32_t texels)
{
    int32_t middle = 128 * texels, x = random_on_map(texels) - middle, y = random_on_map(texels) - middle;
    int32_t times = between(2, 4), to_caster = middle + 200, floor = LAMP - times * to_caster;
    int32_t position[3] = {0, 0, LAMP}, target[3] = {0, 0, 0};
    e->rounding = ROUNDING;
    e->caster = shape_new(0);
    e->settings.bias.value /= 16; /* its depths are closer together */
    (void)add_caster(e, texels, x, y, 1);
    for (uint32_t i = 0; i < e->caster.mesh.vertex_count; i++)
        e->caster.vertices[i][2] = LAMP - to_caster;
    add_ground(e, floor, 0, 0);
    e->x = (int64_t)times * x;
    e->y = (int64_t)times * y;
    e->eye[0] = (int32_t)(e->x + times * (int64_t)between(-256, 256));
    e->eye[1] = (int32_t)(e->y + times * (int64_t)between(-256, 256));
    e->pixel = between(times, 20 * times);
    e->width = 2 * times * to_caster;
    gn_status status = look_down(&e->camera, e->eye[0], e->eye[1], floor + 50, e->pixel * (IMAGE / 2), 4000);
    if (status != GN_OK)
        return status;
    return gn_spot_light(&e->light, position, target, 0, GN_DEGREES(90), to_caster / 2, times * to_caster + 1000);
}

static gn_status build_edge(edge_scene *e, int spot)
{
    int32_t texels = between(16, 64);
    memset(e, 0, sizeof *e);
    e->ground = shape_new(0);
    e->settings = gn_default_settings(IMAGE, IMAGE, (uint16_t)texels);
    e->settings.format = GN_NO_COLOUR;
    e->settings.mask = 1;
    e->settings.reconstruction = &gn_silhouettes;
    e->test = choose_test(&e->settings); /* 5: plane bias, which takes the mean of unequal cells */
    random_direction(&e->a, &e->b);
    e->settings.warp = between(0, 1) ? &gn_rectilinear : 0;
    random_tables(&e->grid, &e->settings);
    gn_status status = spot ? light_by_lamp(e, texels) : light_by_sun(e, texels);
    e->rounding += e->settings.warp ? ROUNDING_WARPED : 0;
    e->objects[0].mesh = &e->ground.mesh;
    e->objects[1].mesh = &e->caster.mesh;
    e->scene.objects = e->objects;
    e->scene.object_count = 2;
    return status;
}

typedef struct edge_count {
    unsigned failures;
    uint64_t scenes, lit, shadowed, far, solids, skipped, warped;
    int64_t worst, worst_warped; /* 1/4096 texel: of wrong pixels with silhouettes, from the edge */
} edge_count;

/* The cell of a place on the map, 2^-12 of its side, by where texels' centres lie; the widest of it and the cells
 * beside it, whose points its lines lead to, 2^-12 as well. 0: the outer cells' lines lead to where the map knows
 * nothing. */
static int find_widest(const edge_scene *e, const uint16_t *places, int64_t at, int64_t *widest)
{
    int32_t texels = e->settings.map_width, cell = -1;
    if (!e->settings.warp) {
        *widest = 4096 / texels;
        cell = (int32_t)floor_divide(at * texels, 4096);
        return cell >= 2 && cell < texels - 2;
    }
    while (cell + 1 < texels && places[cell + 1] <= at - 1)
        cell++;
    if (cell < 2 || cell >= texels - 3)
        return 0;
    *widest = 0;
    for (int32_t i = cell - 1; i <= cell + 1; i++)
        *widest = places[i + 1] - places[i] > *widest ? places[i + 1] - places[i] : *widest;
    return 1;
}

/* Pixels by the exact edge. A pixel's distance is along x and y: the least move along both, in shares of the cells'
 * width and height, that brings it onto the edge. Points and places are rounded along x and y, so that is how far the
 * edge may be off. Returns the wrong ones beyond. */
static uint64_t judge_edge(const edge_scene *e, const frame *f, edge_count *count, int64_t *worst)
{
    uint64_t wrong = 0;
    int64_t from_corner = e->light.kind == GN_SPOT ? e->width : 0, texels = e->settings.map_width;
    for (int i = 0; i < IMAGE * IMAGE; i++) {
        /* twice the place on the ground */
        int64_t x = 2 * (int64_t)e->eye[0] + (int64_t)(2 * (i % IMAGE) + 1 - IMAGE) * e->pixel, width;
        int64_t y = 2 * (int64_t)e->eye[1] - (int64_t)(2 * (i / IMAGE) + 1 - IMAGE) * e->pixel, height;
        int64_t u = floor_divide((x + from_corner) * 4096, 2 * e->width);
        int64_t v = floor_divide((2 * (int64_t)e->width - y - from_corner) * 4096, 2 * e->width);
        if (!find_widest(e, e->grid.columns, u, &width) || !find_widest(e, e->grid.rows, v, &height)) {
            count->skipped++;
            continue;
        }
        int64_t side = e->a * (y - 2 * e->y) - e->b * (x - 2 * e->x);
        int expected = side > 0 ? 0 : 254, got = f->mask[i];
        count->lit += got == 254;
        count->shadowed += got == 0;
        if (got == expected)
            continue;
        /* in 1/4096 texel, rounded up */
        exact reach =
            e->settings.warp ? magnitude(e->a) * height + magnitude(e->b) * width : magnitude(e->a) + magnitude(e->b);
        reach *= 2 * e->width;
        int64_t distance =
            (int64_t)(((exact)magnitude(side) * (e->settings.warp ? 4096 : texels) * 4096 + reach - 1) / reach);
        *worst = distance > *worst ? distance : *worst;
        wrong += distance > 16 * (SIXTEENTH + e->rounding);
    }
    return wrong;
}

static void straight_edges_are_where_they_are(uint64_t cases, int spot)
{
    edge_count count = {0};
    uint64_t beyond_without = 0;
    int64_t without = 0;
    for (uint64_t n = 0; n < cases && count.failures < 5; n++) {
        edge_scene e;
        frame f, plain;
        memset(&f, 0, sizeof f);
        memset(&plain, 0, sizeof plain);
        gn_status status = build_edge(&e, spot);
        if (status == GN_OK)
            status = frame_start(&f, &e.scene, &e.settings);
        if (status == GN_OK && e.settings.warp)
            status = warp_frame(&f, &e.light, &e.camera, &e.grid);
        if (status == GN_OK)
            status = frame_render(&f, &e.light, &e.camera);
        int64_t worst = 0;
        uint64_t wrong = status == GN_OK ? judge_edge(&e, &f, &count, &worst) : 0;
        if ((status != GN_OK || wrong) && count.failures++ < 5)
            note("edge %llu: status %d, through (%ld, %ld) along (%ld, %ld), map %d, %d units a pixel, test %d: %llu "
                 "pixels wrong, up to %ld/4096 texel off",
                 (unsigned long long)n, (int)status, (long)e.x, (long)e.y, (long)e.a, (long)e.b,
                 (int)e.settings.map_width, (int)e.pixel, e.test, (unsigned long long)wrong, (long)worst);
        if (e.settings.warp)
            count.worst_warped = worst > count.worst_warped ? worst : count.worst_warped;
        else
            count.worst = worst > count.worst ? worst : count.worst;
        count.warped += e.settings.warp != 0;
        count.scenes++;
        count.far += (uint64_t)e.far;
        count.solids += e.caster.mesh.closed;
        e.settings.reconstruction = 0;
        if (status == GN_OK && n % 8 == 0 && !e.settings.warp && frame_start(&plain, &e.scene, &e.settings) == GN_OK &&
            frame_render(&plain, &e.light, &e.camera) == GN_OK) {
            edge_count ignored = {0};
            beyond_without += judge_edge(&e, &plain, &ignored, &without);
        }
        if (f.block && !frame_end(&f))
            count.failures++;
        if (plain.block && !frame_end(&plain))
            count.failures++;
        free_shape(&e.ground);
        free_shape(&e.caster);
    }
    ok(!count.failures,
       "straight edges under a %s: no pixel beyond 1/16 texel and rounding, %ld/4096 at most (%ld "
       "without silhouettes), in %llu scenes; %ld/4096 of a cell in %llu of warped maps",
       spot ? "spot light" : "sun", (long)count.worst, (long)without, (unsigned long long)(count.scenes - count.warped),
       (long)count.worst_warped, (unsigned long long)count.warped);
    ok(count.lit > 1000 * cases && count.shadowed > 1000 * cases && beyond_without > 10 * cases &&
           count.worst > 16 * 8 && count.worst_warped > 16 * 8 && count.warped > cases / 4 &&
           (spot || (count.far > cases / 8 && count.solids > cases / 4)),
       "%llu pixels lit, %llu shadowed, %llu at the map's border; %llu solids, %llu edges clipped; without silhouettes "
       "%llu pixels are wrong",
       (unsigned long long)count.lit, (unsigned long long)count.shadowed, (unsigned long long)count.skipped,
       (unsigned long long)count.solids, (unsigned long long)count.far, (unsigned long long)beyond_without);
}

/* ---- the slow twin ----------------------------------------------------------------------------------------------- */

enum { MOST_SHAPES = 4, TWIN_SIDE = 40 };

typedef struct crowd {
    shape shapes[MOST_SHAPES];
    gn_model models[MOST_SHAPES];
    gn_object objects[MOST_SHAPES];
    gn_scene scene;
    gn_light light;
    gn_settings settings;
    tables grid; /* with settings.warp */
} crowd;

/* How a scene's places are chosen. */
typedef struct stretch {
    int32_t low[3], high[3];
    int32_t step[3]; /* places on a grid meet, and lie on borders */
} stretch;

static void random_corner(int32_t p[3], const stretch *s)
{
    for (int i = 0; i < 3; i++) {
        p[i] = between(s->low[i], s->high[i]);
        p[i] -= p[i] % s->step[i];
    }
}

static void add_random_corner(shape *s, const stretch *where)
{
    int32_t p[3];
    random_corner(p, where);
    add_vertex(s, p[0], p[1], p[2]);
}

static void swap_places(int32_t *a, int32_t *b)
{
    int32_t v = *a;
    *a = *b;
    *b = v;
}

/* A box, a patch of a grid at different heights (of a large one most edges are no silhouettes), or triangles of
 * anything at few places: some twice, some without area, some points. */
static shape random_shape(const stretch *where)
{
    int how = between(0, 3);
    shape s = shape_new(how == 0);
    if (how == 0) {
        int32_t low[3], high[3];
        random_corner(low, where);
        random_corner(high, where);
        for (int i = 0; i < 3; i++) {
            if (low[i] > high[i])
                swap_places(&low[i], &high[i]);
            high[i] += low[i] == high[i];
        }
        add_box(&s, low, high);
    } else if (how == 1) {
        int32_t corner[3], across = between(64, 700), down = between(64, 700), n = between(0, 3) ? between(1, 3) : 9;
        random_corner(corner, where);
        for (int32_t i = 0; i < (n + 1) * (n + 1); i++)
            add_vertex(&s, corner[0] + i % (n + 1) * across, corner[1] + i / (n + 1) * down,
                       corner[2] - between(0, 3) * 1024);
        for (int32_t i = 0; i < n * n; i++) {
            uint32_t a = (uint32_t)(i % n + i / n * (n + 1)), below = a + (uint32_t)n + 1;
            add_triangle(&s, a, a + 1, below);
            add_triangle(&s, a + 1, below + 1, below);
        }
    } else {
        int corners = between(3, 7), triangles = between(1, 7);
        for (int i = 0; i < corners; i++)
            add_random_corner(&s, where);
        for (int i = 0; i < triangles; i++)
            add_triangle(&s, (uint32_t)between(0, corners - 1), (uint32_t)between(0, corners - 1),
                         (uint32_t)between(0, corners - 1));
    }
    if (between(0, 5))
        make_edges(&s);
    return s;
}

/* A directional light whose unit is 1/256 texel, or a spot light that may have anything before its near plane. */
static gn_status random_light(crowd *c, stretch *where)
{
    const gn_settings *s = &c->settings;
    int32_t width = 256 * s->map_width, height = 256 * s->map_height, out = between(0, 2) ? 600 : 1 << between(12, 23);
    if (between(0, 2)) {
        int32_t grid = between(0, 1) ? 128 : between(0, 1) ? 1 : 37;
        stretch all = {{-out, -out, -62000}, {width + out, height + out, -100}, {grid, grid, between(0, 1) ? 1024 : 1}};
        *where = all;
        c->light = grid_light(s->map_width, s->map_height);
        return GN_OK;
    }
    int32_t reach = 4000, position[3], target[3];
    stretch all = {{-reach, -reach, -reach}, {reach, reach, reach}, {1, 1, 1}};
    *where = all;
    for (int i = 0; i < 3; i++) {
        position[i] = between(-2 * reach, 2 * reach);
        target[i] = between(-reach / 2, reach / 2);
    }
    int32_t near_depth = between(20, 6000);
    return gn_spot_light(&c->light, position, target, 0, GN_DEGREES(between(20, 120)), near_depth,
                         near_depth + between(near_depth, 20000));
}

static void random_map_size(gn_settings *s)
{
    int how = between(0, 15);
    s->map_width = (uint16_t)between(2, how < 12 ? 16 : TWIN_SIDE);
    s->map_height = (uint16_t)between(2, how < 12 ? 16 : TWIN_SIDE);
    if (how == 0)
        s->map_width = s->map_height = 2;
    if (how == 1)
        s->map_width = 2;
    if (how == 2)
        s->map_height = 2;
}

static gn_status random_crowd(crowd *c)
{
    stretch where;
    memset(c, 0, sizeof *c);
    c->settings = gn_default_settings((uint16_t)between(20, 40), (uint16_t)between(20, 40), 2);
    random_map_size(&c->settings);
    gn_status status = random_light(c, &where);
    c->scene.objects = c->objects;
    c->scene.object_count = (uint32_t)between(1, MOST_SHAPES);
    for (uint32_t i = 0; i < c->scene.object_count; i++) {
        c->shapes[i] = random_shape(&where);
        c->objects[i].mesh = &c->shapes[i].mesh;
        if (between(0, 3))
            continue;
        int32_t axis[3] = {0, 0, 1};
        gn_model_identity(&c->models[i]);
        gn_model_scale(&c->models[i], between(0, 1) ? 65536 : -65536, 65536, between(0, 4) ? 60000 : 0);
        gn_model_rotate(&c->models[i], axis, (gn_angle)tap_random(&random_state));
        gn_model_translate(&c->models[i], between(0, 2000), between(0, 2000), -500);
        c->objects[i].model = &c->models[i];
    }
    c->settings.format = GN_NO_COLOUR;
    c->settings.mask = 1;
    c->settings.surface = (uint8_t)between(GN_CONSTANT, GN_SLOPE);
    c->settings.cull = (uint8_t)between(GN_CULL_AUTO, GN_CULL_FRONT);
    c->settings.layers = (uint8_t)between(GN_LAYERS_AUTO, GN_LAYERS_TWO);
    c->settings.slope = 1 << 16;
    c->settings.bias.value = 1 << 16;
    c->settings.receiver = between(0, 1) ? &gn_virtual : 0;
    c->settings.reconstruction = between(0, 3) ? &gn_silhouettes : &gn_silhouettes_smooth;
    c->settings.warp = between(0, 1) ? &gn_rectilinear : 0;
    random_tables(&c->grid, &c->settings);
    return status;
}

static void free_crowd(crowd *c)
{
    for (uint32_t i = 0; i < c->scene.object_count; i++)
        free_shape(&c->shapes[i]);
}

/* What the twin knows of a cell: the best point yet, by class, depth and byte. */
typedef struct twin_cell {
    int found;
    uint64_t rank;
} twin_cell;

typedef struct twin {
    twin_cell cells[TWIN_SIDE * TWIN_SIDE];
    gn_depth texels[TWIN_SIDE * TWIN_SIDE]; /* the nearest layer, before it is resolved */
    int64_t reach; /* four texels at 45 degrees; of a warped map, times a cell's width of fine texels */
    uint64_t edges, points, hidden, within, contested, apart, clipped;
} twin;

/* The way that a triangle's corners run as the light sees them: 1 counter-clockwise, -1 clockwise, 0 edge-on. */
static int facing_of(const gn_light *light, const gn_object *object, uint32_t triangle)
{
    int32_t world[3][3];
    exact volume = 0;
    const uint32_t *index = (const uint32_t *)object->mesh->indices + 3 * triangle;
    for (int i = 0; i < 3; i++)
        (void)gn_world_position(object, index[i], world[i]);
    for (int i = 0; i < 3; i++) {
        int j = (i + 1) % 3, k = (i + 2) % 3;
        exact n = (exact)(world[1][j] - world[0][j]) * (world[2][k] - world[0][k]) -
                  (exact)(world[1][k] - world[0][k]) * (world[2][j] - world[0][j]);
        volume += n * (light->kind == GN_SPOT ? light->position[i] - world[0][i] : -light->forward[i]);
    }
    return volume > 0 ? 1 : volume < 0 ? -1 : 0;
}

/* A texel's centre, of a warped map in fine texels. */
static gn_vertex centre_of(const crowd *c, int32_t column, int32_t row)
{
    gn_vertex v = {256 * (c->settings.warp ? c->grid.columns[column] : column) + 128,
                   256 * (c->settings.warp ? c->grid.rows[row] : row) + 128, 0};
    return v;
}

/* Does a segment touch a closed cell? Two convex sets do unless an axis parts them. */
static int touches(const crowd *c, const gn_vertex end[2], int32_t column, int32_t row)
{
    gn_vertex first = centre_of(c, column, row), last = centre_of(c, column + 1, row + 1);
    int64_t left = first.x, top = first.y, right = last.x, bottom = last.y;
    int64_t dx = end[1].x - end[0].x, dy = end[1].y - end[0].y;
    if ((end[0].x < left && end[1].x < left) || (end[0].x > right && end[1].x > right) ||
        (end[0].y < top && end[1].y < top) || (end[0].y > bottom && end[1].y > bottom))
        return 0;
    int before = 0, behind = 0;
    for (int i = 0; i < 4; i++) {
        int64_t side = dx * ((i & 2 ? bottom : top) - end[0].y) - dy * ((i & 1 ? right : left) - end[0].x);
        before += side < 0;
        behind += side > 0;
    }
    return before < 4 && behind < 4;
}

/* An edge's ends on the map: where they project to, or what clipping leaves of it as of its triangles, of a triangle
 * without area: its first corner is the first that is left. */
static int find_ends(twin *t, const gn_view *view, const gn_object *object, const uint32_t index[2], gn_vertex end[2])
{
    gn_place corner[3];
    gn_polygon polygon;
    for (int i = 0; i < 2; i++) {
        int32_t world[3];
        (void)gn_world_position(object, index[i], world);
        (void)gn_view_place(view, world, &corner[i]);
        gn_view_project(view, &corner[i], &end[i]);
    }
    if (end[0].depth && end[1].depth)
        return 1;
    t->clipped++;
    corner[2] = corner[1];
    gn_clip_triangle(&polygon, view, corner);
    if (polygon.count < 3)
        return 0;
    end[0] = end[1] = polygon.v[0];
    for (int32_t i = 1; i < polygon.count; i++)
        if (memcmp(&polygon.v[i], &end[0], sizeof end[0]) != 0)
            end[1] = polygon.v[i];
    return 1;
}

static int64_t depth_of(gn_depth stored)
{
    return (int64_t)(uint32_t)(stored | 1u) << (32 - GN_DEPTH_BITS);
}

/* The best of a cell's points: of edges that part the texels about them, a caster within reach from what lies far
 * behind; then the nearest to the light, a unit being two of the stored ones; then the smallest byte. Of meshes without
 * edges only those that part texels, and in place of the depth the square of the distance to the nearest far texel. */
static void draw_in_cell(twin *t, const crowd *c, const gn_vertex end[2], int winding, int alone, int32_t column,
                         int32_t row)
{
    gn_segment segment;
    gn_segment_point p;
    const gn_settings *s = &c->settings;
    gn_vertex first = centre_of(c, column, row), after = centre_of(c, column + 1, row + 1);
    gn_cell cell = {first.x - 128, first.y - 128, (after.x - first.x) / 256, (after.y - first.y) / 256,
                    s->warp ? &gn_rectilinear_cells : 0};
    gn_make_segment(&segment, &end[0], &end[1]);
    gn_segment_in_cell(&segment, &cell, &p);
    int64_t z = 2 * (int64_t)p.z, farthest = 0, near_caster = 0, far_off = 0, squared = INT64_MAX;
    int64_t dx = end[1].x - end[0].x, dy = end[1].y - end[0].y;
    /* half as far for half the width and half the height; an empty texel is always far behind */
    int64_t limit = z + t->reach * (cell.width + cell.height) / 2, last = depth_of((gn_depth)0xffffffffu) - 1;
    limit = limit < last ? limit : last;
    for (int i = 0; i < 4; i++) {
        int32_t texel_column = column + (i & 1), texel_row = row + (i >> 1);
        gn_vertex centre = centre_of(c, texel_column, texel_row);
        int64_t texel = depth_of(t->texels[texel_row * s->map_width + texel_column]);
        int64_t side = winding * (dx * (centre.y - end[0].y) - dy * (centre.x - end[0].x));
        int64_t x = p.x - 256 * (i & 1), y = p.y - 256 * (i >> 1);
        farthest = texel > farthest ? texel : farthest;
        near_caster += side < 0 && texel <= limit;
        if (side > 0 && texel > limit) {
            far_off++;
            squared = x * x + y * y < squared ? x * x + y * y : squared;
        }
    }
    /* behind all four, by more than their unit and the error of a point */
    if (z > farthest + ((int64_t)1 << (32 - GN_DEPTH_BITS)) - 1 + 65536) {
        t->hidden++;
        return;
    }
    int parts = near_caster && far_off;
    if (alone && !parts) {
        t->within++;
        return;
    }
    uint64_t key = alone ? (uint64_t)squared << 13 : (uint64_t)z / 2 + (parts ? 0 : UINT64_C(1) << 31);
    uint64_t most = ((uint64_t)1 << GN_DEPTH_BITS) - 2; /* one more stands for a cell without a point */
    key >>= 32 - GN_DEPTH_BITS;
    key = key > most ? most : key;
    t->apart += parts;
    int32_t x = (p.x + 8) / 16, y = (p.y + 8) / 16;
    uint64_t rank = key << 8 | (uint64_t)((y > 15 ? 15 : y) << 4 | (x > 15 ? 15 : x));
    twin_cell *best = &t->cells[row * s->map_width + column];
    t->contested += best->found && best->rank != rank;
    if (!best->found || rank < best->rank)
        best->rank = rank;
    t->points += !best->found;
    best->found = 1;
}

static void draw_edge(twin *t, const crowd *c, const gn_view *view, const gn_object *object, const uint32_t index[2],
                      int winding, int alone)
{
    gn_vertex end[2];
    const gn_settings *s = &c->settings;
    t->edges++;
    if (!find_ends(t, view, object, index, end))
        return;
    for (int32_t row = 0; row + 1 < s->map_height; row++)
        for (int32_t column = 0; column + 1 < s->map_width; column++)
            if (touches(c, end, column, row))
                draw_in_cell(t, c, end, winding, alone, column, row);
}

static void draw_twin(twin *t, const crowd *c, const gn_view *view)
{
    const gn_scene *scene = &c->scene;
    for (uint32_t o = 0; o < scene->object_count; o++) {
        const gn_object *object = &scene->objects[o];
        const gn_mesh *mesh = object->mesh;
        const uint32_t *index = mesh->indices;
        for (uint32_t e = 0; mesh->edges && e < mesh->edge_count; e++) {
            uint32_t half = mesh->edges[e].half[0], other = mesh->edges[e].half[1];
            uint32_t ends[2] = {index[half], index[next_corner(half)]};
            int winding = facing_of(&c->light, object, half / 3);
            if (other != GN_NO_HALF_EDGE) {
                int facing = facing_of(&c->light, object, (other & ~GN_SAME_DIRECTION) / 3);
                winding += other & GN_SAME_DIRECTION ? facing : -facing;
            }
            if (winding)
                draw_edge(t, c, view, object, ends, winding, 0);
        }
        for (uint32_t half = 0; !mesh->edges && half < 3 * mesh->triangle_count; half++) {
            uint32_t ends[2] = {index[half], index[next_corner(half)]};
            int facing = facing_of(&c->light, object, half / 3);
            if (facing)
                draw_edge(t, c, view, object, ends, facing, 1);
        }
    }
}

static void note_crowd(const crowd *c, uint64_t n)
{
    note("scene %llu: %s light, %smap %dx%d, surface %d, cull %d, layers %d, %lu objects", (unsigned long long)n,
         c->light.kind == GN_SPOT ? "spot" : "directional", c->settings.warp ? "warped " : "",
         (int)c->settings.map_width, (int)c->settings.map_height, (int)c->settings.surface, (int)c->settings.cull,
         (int)c->settings.layers, (unsigned long)c->scene.object_count);
}

/* Over the scene, whatever its light. */
static gn_status crowd_camera(gn_camera *camera)
{
    static const int32_t up[3] = {0, 1, 0};
    int32_t eye[3] = {3000, -2000, 9000}, target[3] = {1000, 1000, -3000};
    gn_status status = gn_look_at(camera, eye, target, up);
    return status == GN_OK ? gn_perspective(camera, GN_DEGREES(50), 400, 1 << 25) : status;
}

/* What comes before the layers. */
static gn_status begin_light(frame *f, const crowd *c)
{
    gn_camera camera;
    gn_status status = crowd_camera(&camera);
    if (status == GN_OK && c->settings.warp)
        status = warp_frame(f, &c->light, &camera, &c->grid);
    return status == GN_OK ? gn_light_begin(f->context, &c->light) : status;
}

/* The light pass in one region, and the twin over the layer that it leaves. */
static gn_status run_with_twin(frame *f, const crowd *c, twin *t)
{
    static const gn_bias reach = {GN_BIAS_TEXELS, 4 << 16};
    gn_status status = frame_start(f, &c->scene, &c->settings);
    uint32_t first, rows, stride;
    memset(t, 0, sizeof *t);
    if (status == GN_OK)
        status = begin_light(f, c);
    if (status == GN_OK)
        status = gn_light_layers(f->context, 0, 0);
    if (status != GN_OK)
        return status;
    const gn_depth *layer = gn_layer(f->context, 0, 0, 0, &first, &rows, &stride);
    for (uint32_t row = 0; row < rows; row++)
        memcpy(t->texels + row * c->settings.map_width, layer + row * stride,
               c->settings.map_width * sizeof *t->texels);
    t->reach = gn_make_bias(f->context, &reach);
    if (c->settings.warp) /* a texel of the mean size: GN_FINE / width by GN_FINE / height fine ones */
        t->reach = t->reach * 2 * c->settings.map_width * c->settings.map_height /
                   (GN_FINE * (c->settings.map_width + c->settings.map_height));
    draw_twin(t, c, &f->context->light_view);
    return gn_light_resolve(f->context, 0, 0);
}

static int same_as_twin(const frame *f, const crowd *c, const twin *t, uint64_t n)
{
    uint32_t stride;
    const uint8_t *map = gn_silhouette_map(f->context, &stride);
    int good = map != 0;
    for (uint32_t row = 0; good && row < c->settings.map_height; row++)
        for (uint32_t column = 0; column < c->settings.map_width; column++) {
            const twin_cell *cell = &t->cells[row * c->settings.map_width + column];
            unsigned expected = cell->found ? cell->rank & 255 : CENTRE, got = map[row * stride + column];
            if (got == expected)
                continue;
            if (good)
                note_crowd(c, n);
            note("    cell (%u, %u): got %02x, expected %02x", (unsigned)column, (unsigned)row, got, expected);
            good = 0;
        }
#if GN_STATISTICS
    gn_statistics s;
    gn_get_statistics(f->context, &s);
    if (good && (s.silhouette_edges != t->edges || s.silhouette_texels != t->points)) {
        note_crowd(c, n);
        note("    %llu edges, %llu cells; expected %llu, %llu", (unsigned long long)s.silhouette_edges,
             (unsigned long long)s.silhouette_texels, (unsigned long long)t->edges, (unsigned long long)t->points);
        good = 0;
    }
#endif
    return good;
}

/* ---- any order --------------------------------------------------------------------------------------------------- */

static void shuffle(uint32_t *v, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++)
        v[i] = i;
    for (uint32_t i = count; i > 1; i--) {
        uint32_t j = (uint32_t)between(0, i - 1), swap = v[i - 1];
        v[i - 1] = v[j];
        v[j] = swap;
    }
}

/* Triangles in another order, edges in another order and by their other half first. A triangle's corners keep theirs:
 * its plane is rounded at the first. */
static void reorder_shape(shape *s)
{
    uint32_t count = s->mesh.triangle_count, edges = s->mesh.edge_count;
    uint32_t *to = grown(0, (count + edges + 1) * 4), *indices = grown(0, (3 * count + 1) * 4);
    shuffle(to, count);
    for (uint32_t t = 0; t < count; t++)
        memcpy(indices + 3 * to[t], s->indices + 3 * t, 3 * sizeof *indices);
    memcpy(s->indices, indices, 3 * count * sizeof *indices);
    gn_mesh_edge *edge = edges_of(s);
    for (uint32_t e = 0; edge && e < edges; e++) {
        uint32_t same = edge[e].half[1] == GN_NO_HALF_EDGE ? 0 : edge[e].half[1] & GN_SAME_DIRECTION;
        for (int i = 0; i < 2; i++) {
            uint32_t half = edge[e].half[i];
            if (half == GN_NO_HALF_EDGE)
                continue;
            half &= ~GN_SAME_DIRECTION;
            edge[e].half[i] = 3 * to[half / 3] + half % 3 + (i ? same : 0);
        }
        if (edge[e].half[1] != GN_NO_HALF_EDGE && between(0, 1)) {
            uint32_t half = edge[e].half[0];
            edge[e].half[0] = edge[e].half[1] - same;
            edge[e].half[1] = half + same;
        }
    }
    shuffle(to, edges);
    for (uint32_t e = 0; edge && e < edges; e++) {
        gn_mesh_edge swap = edge[e];
        edge[e] = edge[to[e]];
        edge[to[e]] = swap;
    }
    free(to);
    free(indices);
}

static void reorder_crowd(crowd *c)
{
    for (uint32_t i = 0; i < c->scene.object_count; i++)
        reorder_shape(&c->shapes[i]);
    for (uint32_t i = c->scene.object_count; i > 1; i--) {
        uint32_t j = (uint32_t)between(0, i - 1);
        gn_object swap = c->objects[i - 1];
        c->objects[i - 1] = c->objects[j];
        c->objects[j] = swap;
    }
}

/* The light pass region by region in any order, each on any worker. */
static gn_status run_in_any_order(frame *f, const crowd *c)
{
    static uint32_t order[TWIN_SIDE];
    gn_settings s = c->settings;
    static const uint8_t few[] = {1, 2, 3, 7};
    s.map_rows = between(0, 3) ? few[between(0, 3)] : 0;
    s.workers = (uint8_t)between(1, 4);
    gn_status status = frame_start(f, &c->scene, &s);
    if (status == GN_OK)
        status = begin_light(f, c);
    shuffle(order, f->plan.light_regions);
    for (uint32_t i = 0; status == GN_OK && i < f->plan.light_regions; i++) {
        uint32_t worker = (uint32_t)between(0, s.workers - 1);
        status = gn_light_layers(f->context, order[i], worker);
        if (status == GN_OK)
            status = gn_light_resolve(f->context, order[i], worker);
    }
    return status;
}

static int same_maps(const frame *a, const frame *b, const crowd *c, uint64_t n)
{
    uint32_t stride[2];
    const uint8_t *map[2] = {gn_silhouette_map(a->context, &stride[0]), gn_silhouette_map(b->context, &stride[1])};
    for (uint32_t row = 0; row < c->settings.map_height; row++)
        for (uint32_t column = 0; column < c->settings.map_width; column++) {
            unsigned cell[2] = {map[0][row * stride[0] + column], map[1][row * stride[1] + column]};
            gn_depth texel[2] = {texel_at(a->context, column, row), texel_at(b->context, column, row)};
            if (cell[0] == cell[1] && texel[0] == texel[1])
                continue;
            note_crowd(c, n);
            note("    %d rows a region, cell (%u, %u): %02x, in one region %02x; depths %lu and %lu",
                 (int)b->plan.map_rows, (unsigned)column, (unsigned)row, cell[1], cell[0], (unsigned long)texel[1],
                 (unsigned long)texel[0]);
            return 0;
        }
    return 1;
}

static gn_status look_at_crowd(frame *f)
{
    gn_camera camera;
    gn_status status = crowd_camera(&camera);
    return status == GN_OK ? gn_camera_pass(f->context, &camera, frame_flush, f) : status;
}

static void maps_are_the_twins(uint64_t cases)
{
    static twin t;
    static crowd c;
    uint64_t scenes = 0, edges = 0, cells = 0, hidden = 0, within = 0, contested = 0, apart = 0, clipped = 0, spots = 0,
             rows = 0;
    uint64_t lit = 0, shadowed = 0, without = 0, warped = 0, warped_points = 0;
    unsigned failures = 0;
    for (uint64_t n = 0; n < cases && failures < 5; n++) {
        frame f, other;
        memset(&other, 0, sizeof other);
        gn_status status = random_crowd(&c);
        if (status == GN_OK)
            status = run_with_twin(&f, &c, &t);
        if (status != GN_OK) { /* settings that make no sense together, or a steep light */
            if (f.block)
                frame_end(&f);
            memset(&f, 0, sizeof f);
            free_crowd(&c);
            continue;
        }
        failures += !same_as_twin(&f, &c, &t, n);
        int moved = between(0, 1);
        if (moved)
            reorder_crowd(&c);
        status = run_in_any_order(&other, &c);
        failures += status != GN_OK || !same_maps(&f, &other, &c, n);
        rows += other.plan.light_regions > 1;
        if (!moved) {
            /* which of two triangles in one place is seen hangs on their order */
            status = look_at_crowd(&f);
            failures += status != GN_OK || look_at_crowd(&other) != GN_OK;
            if (status == GN_OK && memcmp(f.mask, other.mask, mask_bytes(&f)) != 0 && failures++ < 5) {
                note_crowd(&c, n);
                note("    another image with %d rows a region", (int)other.plan.map_rows);
            }
            count_mask(&f, &lit, &shadowed);
        }
        scenes++;
        edges += t.edges;
        cells += t.points;
        hidden += t.hidden;
        within += t.within;
        contested += t.contested;
        apart += t.apart;
        clipped += t.clipped;
        spots += c.light.kind == GN_SPOT;
        warped += c.settings.warp != 0;
        warped_points += c.settings.warp ? t.points : 0;
        for (uint32_t i = 0; i < c.scene.object_count; i++)
            without += c.shapes[i].mesh.edges == 0;
        if (!frame_end(&f) || (other.block && !frame_end(&other))) {
            note_crowd(&c, n);
            note("    wrote outside its block");
            failures++;
        }
        free_crowd(&c);
    }
    ok(!failures,
       "maps and counts are the slow twin's, in any order of triangles, edges, objects, regions and workers: %llu "
       "scenes, %llu edges, %llu cells",
       (unsigned long long)scenes, (unsigned long long)edges, (unsigned long long)cells);
    ok(scenes > cases / 4 && cells > 10 * scenes && hidden > scenes && within > scenes && contested > scenes &&
           apart > scenes && clipped > scenes / 2 && spots > scenes / 8 && rows > scenes / 4 && without > scenes / 8 &&
           lit > scenes && shadowed > scenes && warped > scenes / 4 && warped_points > cells / 8,
       "%llu warped maps with %llu cells; %llu points hidden, %llu within surfaces, %llu beside others, %llu of edges "
       "that part the texels, %llu edges "
       "clipped, %llu meshes "
       "without edges, %llu spot lights, %llu maps of regions; %llu pixels lit, %llu shadowed",
       (unsigned long long)warped, (unsigned long long)warped_points, (unsigned long long)hidden,
       (unsigned long long)within, (unsigned long long)contested, (unsigned long long)apart,
       (unsigned long long)clipped, (unsigned long long)without, (unsigned long long)spots, (unsigned long long)rows,
       (unsigned long long)lit, (unsigned long long)shadowed);
}

/* ---- by hand ----------------------------------------------------------------------------------------------------- */

/* A map of 16 x 16 under a grid light; places on it as the map has them, y down. */
enum { SIDE = 16, SHEETS = 4 };

typedef struct table {
    shape sheets[SHEETS];
    gn_object objects[SHEETS];
    gn_scene scene;
    gn_light light;
    gn_settings settings;
} table;

static void set_table(table *t, uint16_t width, uint16_t height)
{
    memset(t, 0, sizeof *t);
    t->scene.objects = t->objects;
    t->light = grid_light(width, height);
    t->settings = gn_default_settings(8, 8, SIDE);
    t->settings.map_width = width;
    t->settings.map_height = height;
    t->settings.surface = GN_CONSTANT;
    t->settings.reconstruction = &gn_silhouettes;
}

static shape *add_object(table *t, int closed)
{
    shape *s = &t->sheets[t->scene.object_count];
    *s = shape_new(closed);
    t->objects[t->scene.object_count++].mesh = &s->mesh;
    return s;
}

/* A level sheet over [x0, x1] x [y0, y1] of the map, so many units from the light's near side. */
static shape *lay_sheet(table *t, int32_t x0, int32_t y0, int32_t x1, int32_t y1, int32_t depth)
{
    int32_t height = 256 * t->settings.map_height;
    shape *s = add_object(t, 0);
    add_level(s, x0, height - y1, x1, height - y0, -depth, 1);
    make_edges(s);
    return s;
}

static void clear_table(table *t)
{
    for (uint32_t i = 0; i < t->scene.object_count; i++)
        free_shape(&t->sheets[i]);
}

/* The map in cells of the width of the table's; the counts. */
static gn_status draw_table(const table *t, uint8_t *cells, gn_statistics *counts)
{
    frame f;
    uint32_t stride;
    gn_status status = frame_start(&f, &t->scene, &t->settings);
    if (status == GN_OK)
        status = gn_light_pass(f.context, &t->light);
    if (status == GN_OK) {
        const uint8_t *map = gn_silhouette_map(f.context, &stride);
        for (uint32_t row = 0; row < t->settings.map_height; row++)
            memcpy(cells + row * t->settings.map_width, map + row * stride, t->settings.map_width);
        gn_get_statistics(f.context, counts);
    }
    if (f.block && !frame_end(&f))
        status = GN_TOO_SMALL;
    return status;
}

static int counted(uint64_t got, uint64_t expected)
{
#if GN_STATISTICS
    return got == expected;
#else
    (void)got, (void)expected;
    return 1;
#endif
}

/* Sides at 12/16 of cells 3 and 9 both ways. An upright side crosses the diagonals of a cell at 12/16 and 4/16 from
 * above, their middle is 8/16; corners are corners. Nothing else is drawn: not where the sheet's triangles join. */
static void is_a_square(const uint8_t *cells, unsigned *failures)
{
    for (int i = 0; i < SIDE * SIDE; i++) {
        int column = i % SIDE, row = i / SIDE, upright = column == 3 || column == 9, level = row == 3 || row == 9;
        int within = column >= 3 && column <= 9 && row >= 3 && row <= 9;
        int expected = !within ? CENTRE : upright && level ? 0xcc : upright ? 0x8c : level ? 0xc8 : CENTRE;
        if (cells[i] != expected && (*failures)++ < 5)
            note("cell (%d, %d): got %02x, expected %02x", column, row, cells[i], (unsigned)expected);
    }
}

static void a_square_by_hand(void)
{
    static uint8_t cells[SIDE * SIDE];
    gn_statistics counts;
    unsigned failures = 0;
    table t;
    set_table(&t, SIDE, SIDE);
    lay_sheet(&t, 1088, 1088, 2624, 2624, 1000);
    failures += draw_table(&t, cells, &counts) != GN_OK;
    is_a_square(cells, &failures);
    ok(!failures && counted(counts.silhouette_texels, 24) && counts.silhouette_edges == 4,
       "a square by hand: 24 cells, 4 edges");
    t.settings.map_rows = 5;
    failures += draw_table(&t, cells, &counts) != GN_OK;
    is_a_square(cells, &failures);
    ok(!failures && counted(counts.silhouette_texels, 24) && counts.silhouette_edges == 4, "the same in four regions");
    lay_sheet(&t, -4096, -4096, 8192, 8192, 700);
    failures += draw_table(&t, cells, &counts) != GN_OK;
    for (int i = 0; i < SIDE * SIDE; i++)
        failures += cells[i] != CENTRE;
    ok(!failures && counted(counts.silhouette_texels, 0) && counts.silhouette_edges == 8,
       "behind a larger sheet nothing of it is drawn");
    clear_table(&t);
}

/* An edge may lie a unit of 16 bits behind the surface that it borders: cutting and snapping leave that. */
static void a_hair_behind_is_not_hidden(void)
{
    static uint8_t cells[SIDE * SIDE];
    for (int behind = 0; behind < 3; behind++) {
        unsigned failures = 0;
        gn_statistics counts;
        table t;
        set_table(&t, SIDE, SIDE);
        lay_sheet(&t, -4096, -4096, 8192, 8192, 999);
        lay_sheet(&t, 1088, 1088, 2624, 2624, 999 + behind);
        failures += draw_table(&t, cells, &counts) != GN_OK;
        if (behind < 2)
            is_a_square(cells, &failures);
        else
            for (int i = 0; i < SIDE * SIDE; i++)
                failures += cells[i] != CENTRE;
        ok(!failures && counted(counts.silhouette_texels, behind < 2 ? 24 : 0), "%d units behind a sheet: %s", behind,
           behind < 2 ? "drawn" : "hidden");
        clear_table(&t);
    }
}

static void soups_draw_what_parts_texels(void)
{
    static uint8_t cells[SIDE * SIDE];
    gn_statistics counts;
    unsigned failures = 0;
    table t;
    set_table(&t, SIDE, SIDE);
    shape *s = lay_sheet(&t, 1088, 1088, 2624, 2624, 1000);
    free(edges_of(s));
    s->mesh.edges = 0;
    s->mesh.edge_count = 0;
    failures += draw_table(&t, cells, &counts) != GN_OK;
    is_a_square(cells, &failures);
    ok(!failures && counted(counts.silhouette_texels, 24) && counts.silhouette_edges == 6,
       "a square of two lone triangles: all edges count, but not the one between them is drawn");
    add_vertex(s, 500, 500, -2000);
    add_vertex(s, 500, 900, -2000);
    add_vertex(s, 500, 700, -4000);
    add_triangle(s, 4, 5, 6);
    failures += draw_table(&t, cells, &counts) != GN_OK;
    is_a_square(cells, &failures);
    ok(!failures && counts.silhouette_edges == 6, "those of a triangle that is edge-on neither count nor are drawn");
    clear_table(&t);
}

/* A sheet inside a solid: hidden by its top, not by its bottom, which is what the layer holds without front faces. */
static void culled_faces_hide_nothing(void)
{
    static uint8_t cells[SIDE * SIDE];
    static const int32_t low[3] = {-2000, -2000, -9000}, high[3] = {8000, 8000, -500};
    gn_statistics counts;
    unsigned failures = 0;
    table t;
    set_table(&t, SIDE, SIDE);
    shape *s = add_object(&t, 1);
    add_box(s, low, high);
    make_edges(s);
    lay_sheet(&t, 1088, 1088, 2624, 2624, 1000);
    failures += draw_table(&t, cells, &counts) != GN_OK;
    ok(!failures && counted(counts.silhouette_texels, 0), "a sheet inside a solid is hidden");
    t.settings.surface = GN_SECOND;
    t.settings.layers = GN_LAYERS_FIRST;
    t.settings.cull = GN_CULL_FRONT;
    failures += draw_table(&t, cells, &counts) != GN_OK;
    is_a_square(cells, &failures);
    ok(!failures && counted(counts.silhouette_texels, 24), "without front faces it is not");
    clear_table(&t);
}

/* Two upright edges in the cells of column 3, both with what casts the shadow to the right. */
static void the_nearest_edge_wins(void)
{
    static uint8_t cells[SIDE * SIDE];
    gn_statistics counts;
    for (int turned = 0; turned < 2; turned++) {
        unsigned failures = 0;
        table t;
        set_table(&t, SIDE, SIDE);
        lay_sheet(&t, 128 + 768 + (turned ? 64 : 192), -4096, 9000, 9000, 1000);
        lay_sheet(&t, 128 + 768 + (turned ? 192 : 64), -4096, 9000, 9000, 5000);
        failures += draw_table(&t, cells, &counts) != GN_OK;
        for (int row = 0; row < SIDE - 1; row++)
            failures += cells[row * SIDE + 3] != (turned ? 0x84 : 0x8c);
        ok(!failures && counted(counts.silhouette_texels, SIDE - 1), "of two edges in a cell the nearer one wins: %s",
           turned ? "the left" : "the right");
        clear_table(&t);
    }
}

/* A strip between centres is in no texel: its edges part nothing, and are drawn only where there is no other. */
static void edges_that_part_texels_come_first(void)
{
    static uint8_t cells[SIDE * SIDE];
    gn_statistics counts;
    for (int both = 0; both < 2; both++) {
        unsigned failures = 0;
        table t;
        set_table(&t, SIDE, SIDE);
        lay_sheet(&t, 128 + 768 + 64, -4096, 128 + 768 + 192, 9000, 1000);
        if (both)
            lay_sheet(&t, 128 + 768 + 96, -4096, 9000, 9000, 5000);
        failures += draw_table(&t, cells, &counts) != GN_OK;
        for (int row = 0; row < SIDE - 1; row++)
            failures += cells[row * SIDE + 3] != (both ? 0x86 : 0x84);
        ok(!failures, "a strip between two rows of centres: %s",
           both ? "the edge behind it, which parts them, wins" : "its edges are all there is");
        clear_table(&t);
    }
}

/* The sheet behind the strip, as deep as the light's box has room: nothing lies behind it but empty texels. */
static void empty_texels_are_far(void)
{
    static uint8_t cells[SIDE * SIDE];
    gn_statistics counts;
    unsigned failures = 0;
    for (int depth = 64000; depth < 65000; depth++) {
        table t;
        set_table(&t, SIDE, SIDE);
        lay_sheet(&t, 128 + 768 + 64, -4096, 128 + 768 + 192, 9000, 1000);
        lay_sheet(&t, 128 + 768 + 96, -4096, 9000, 9000, depth);
        failures += draw_table(&t, cells, &counts) != GN_OK;
        for (int row = 0; row < SIDE - 1; row++)
            failures += cells[row * SIDE + 3] != 0x86;
        clear_table(&t);
    }
    ok(!failures, "an empty texel is far behind an edge at any depth");
}

/* With mixed surfaces depths carry a mark. What lies just four texels behind an edge is as far in each region. */
static void marks_do_not_move_depths(void)
{
    static uint8_t cells[2][SIDE * SIDE];
    gn_statistics counts;
    unsigned failures = 0, won[2] = {0, 0};
    for (int behind = 1020; behind < 1030; behind++)
        for (int depth = 5000; depth < 5002; depth++) {
            table t;
            set_table(&t, SIDE, SIDE);
            lay_sheet(&t, -4096, 128 + 768 + 64, 9000, 128 + 768 + 192, 1000);
            lay_sheet(&t, -4096, -4096, 9000, 128 + 768 + 96, depth);
            lay_sheet(&t, -4096, -4096, 9000, 9000, depth + behind);
            t.settings.surface = GN_MIXED;
            failures += draw_table(&t, cells[0], &counts) != GN_OK;
            for (uint16_t rows = 1; rows < 6; rows++) {
                t.settings.map_rows = rows;
                failures += draw_table(&t, cells[1], &counts) != GN_OK;
                failures += memcmp(cells[0], cells[1], sizeof cells[0]) != 0;
            }
            won[cells[0][3 * SIDE] == 0x68]++;
            clear_table(&t);
        }
    ok(!failures && won[0] && won[1], "marks of mixed surfaces do not move depths: near enough in %u maps, far in %u",
       won[0], won[1]);
}

/* Whether a point is hidden hangs on the depth that hides it, not on its mark, and so not on the region's last row. */
static void marks_hide_nothing(void)
{
    static uint8_t cells[SIDE * SIDE];
    gn_statistics counts;
    unsigned failures = 0, drawn = 0, hidden = 0;
    for (int depth = 1000; depth < 1004; depth++)
        for (int behind = 0; behind < 5; behind++) {
            int first = -1;
            for (int how = 0; how < 12; how++) {
                table t;
                set_table(&t, SIDE, SIDE);
                shape *over = lay_sheet(&t, -4096, -4096, 9000, 9000, depth);
                lay_sheet(&t, 1088, 1088, 2624, 2624, depth + behind);
                over->mesh.closed = how & 1;
                t.settings.surface = GN_MIXED;
                t.settings.map_rows = (uint16_t)(how / 2);
                failures += draw_table(&t, cells, &counts) != GN_OK;
                int visible = cells[3 * SIDE + 3] == 0xcc;
                first = first < 0 ? visible : first;
                failures += visible != first;
                clear_table(&t);
            }
            drawn += first == 1;
            hidden += first == 0;
        }
    ok(!failures && drawn && hidden, "marks of mixed surfaces hide nothing: %u depths drawn, %u hidden", drawn, hidden);
}

/* A level sheet of 8 x 8 squares; its border stands first or last among its edges, which are 32 and 176. */
static void lay_grid(table *t, int32_t x, int32_t y, int32_t depth, int border_last)
{
    enum { N = 8, STEP = 160 };
    shape *s = add_object(t, 0);
    for (int32_t i = 0; i < (N + 1) * (N + 1); i++)
        add_vertex(s, x + i % (N + 1) * STEP, y + i / (N + 1) * STEP, -depth);
    for (uint32_t i = 0; i < N * N; i++) {
        uint32_t a = i % N + i / N * (N + 1), below = a + N + 1;
        add_triangle(s, a, a + 1, below);
        add_triangle(s, a + 1, below + 1, below);
    }
    make_edges(s);
    gn_mesh_edge *edge = edges_of(s);
    uint32_t count = s->mesh.edge_count, first = 0;
    for (uint32_t e = 0; e < count; e++)
        if ((edge[e].half[1] == GN_NO_HALF_EDGE) != border_last) {
            gn_mesh_edge swap = edge[first];
            edge[first++] = edge[e];
            edge[e] = swap;
        }
}

/* Silhouettes are looked for 32 edges at a time: meshes end and begin in the midst of that. */
static void no_edge_is_passed_over(void)
{
    static uint8_t cells[2][SIDE * SIDE];
    gn_statistics counts;
    unsigned failures = 0;
    for (int orders = 0; orders < 8; orders++) {
        table t;
        set_table(&t, SIDE, SIDE);
        for (int i = 0; i < 3; i++) {
            lay_grid(&t, 300 + 900 * i, 400 + 800 * i, 5000 - 1500 * i, orders >> i & 1);
            if (i == 1) /* a mesh of five edges in between */
                lay_sheet(&t, 200, 200, 700, 700, 500);
        }
        failures += draw_table(&t, cells[orders > 0], &counts) != GN_OK || counts.silhouette_edges != 3 * 32 + 4;
        failures += orders && memcmp(cells[0], cells[1], sizeof cells[0]) != 0;
        clear_table(&t);
    }
    ok(!failures, "no silhouette is passed over among many edges that are none");
}

static void long_thin_maps(void)
{
    static const uint16_t sizes[][2] = {{2, 2}, {2, GN_MAX_SIZE}, {GN_MAX_SIZE, 2}, {3, 1000}};
    for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; i++) {
        uint16_t width = sizes[i][0], height = sizes[i][1];
        int upright = width <= height;
        uint8_t *cells = grown(0, (size_t)width * height);
        gn_statistics counts;
        unsigned failures = 0;
        table t;
        set_table(&t, width, height);
        t.settings.map_rows = height > 2 ? 100 : 0;
        lay_sheet(&t, upright ? 128 + 192 : -900, upright ? -900 : 128 + 192, 1 << 21, 1 << 21, 1000);
        failures += draw_table(&t, cells, &counts) != GN_OK;
        for (int c = 0; c < width * height; c++) {
            int column = c % width, row = c / width, across = upright ? column : row;
            int cell = column < width - 1 && row < height - 1;
            failures += cells[c] != (!cell || across ? CENTRE : upright ? 0x8c : 0xc8);
        }
        ok(!failures && counted(counts.silhouette_texels, upright ? height - 1u : width - 1u), "a map of %u x %u",
           (unsigned)width, (unsigned)height);
        clear_table(&t);
        free(cells);
    }
}

/* Corners far beyond the guard band: what is left of the square's sides is where it was. */
static void clipped_sides_stay_where_they_are(void)
{
    static uint8_t cells[2][SIDE * SIDE];
    const int32_t all = 1 << 23;
    for (int side = 0; side < 4; side++) {
        gn_statistics counts;
        unsigned failures = 0;
        for (int far = 0; far < 2; far++) {
            table t;
            int32_t out = far ? all : 6000;
            set_table(&t, SIDE, SIDE);
            lay_sheet(&t, side == 0 ? 1088 : -out, side == 1 ? 1088 : -out, side == 2 ? 2624 : out,
                      side == 3 ? 2624 : out, 1000);
            failures += draw_table(&t, cells[far], &counts) != GN_OK || !counted(counts.silhouette_texels, SIDE - 1);
            clear_table(&t);
        }
        ok(!failures && memcmp(cells[0], cells[1], sizeof cells[0]) == 0 &&
               cells[0][side % 2 ? (side == 1 ? 3 : 9) * SIDE + 7 : 7 * SIDE + (side == 0 ? 3 : 9)] ==
                   (side % 2 ? 0xc8 : 0x8c),
           "a side that is clipped stays where it is: %d", side);
    }
}

/* ---- planning ---------------------------------------------------------------------------------------------------- */

static gn_status plan_of(const table *t, gn_plan *plan)
{
    memset(plan, 0, sizeof *plan);
    return gn_make_plan(plan, &t->scene, &t->settings);
}

static void planning(void)
{
    gn_plan with, without;
    table t;
    set_table(&t, 30, 20);
    t.settings.map_rows = 7;
    t.settings.workers = 2;
    shape *s = lay_sheet(&t, 100, 100, 900, 900, 1000);
    int planned = plan_of(&t, &with) == GN_OK;
    t.settings.reconstruction = 0;
    planned &= plan_of(&t, &without) == GN_OK;
    ok(planned && with.silhouette_bytes == 30 * 20 && without.silhouette_bytes == 0 &&
           with.map_bytes == without.map_bytes && with.camera_bytes >= without.camera_bytes + 30 * 20 &&
           with.camera_bytes < without.camera_bytes + 30 * 20 + 100 && with.light_bytes > without.light_bytes + 600,
       "a silhouette map costs a byte a texel, and more while it is drawn; without it nothing");
    t.settings.reconstruction = &gn_bilinear;
    planned = plan_of(&t, &without) == GN_OK;
    ok(planned && without.silhouette_bytes == 0, "other reconstructions draw none");
    t.settings.reconstruction = &gn_silhouettes;
    t.settings.shadow = GN_SHADOW_VOLUMES;
    planned = plan_of(&t, &without) == GN_OK;
    ok(planned && without.silhouette_bytes == 0, "nor do volumes");
    t.settings.shadow = GN_SHADOW_MAP;

    frame f;
    uint32_t stride;
    t.settings.reconstruction = 0;
    gn_status status = frame_start(&f, &t.scene, &t.settings);
    status = status == GN_OK ? gn_light_pass(f.context, &t.light) : status;
    ok(status == GN_OK && !gn_silhouette_map(f.context, &stride) && !gn_silhouette_map(0, &stride) && frame_end(&f),
       "without silhouettes there is no map");
    t.settings.reconstruction = &gn_silhouettes;
    status = frame_start(&f, &t.scene, &t.settings);
    int before = gn_silhouette_map(f.context, &stride) != 0;
    status = status == GN_OK ? gn_light_pass(f.context, &t.light) : status;
    ok(status == GN_OK && !before && gn_silhouette_map(f.context, &stride) && frame_end(&f),
       "nor before the first light pass");

    static const gn_reconstruction *const drawn[] = {&gn_silhouettes, &gn_silhouettes_smooth};
    for (int i = 0; i < 2; i++) {
        unsigned failures = 0;
        gn_mesh_edge *edges = edges_of(s), good = edges[1];
        uint32_t count = s->mesh.edge_count;
        t.settings.reconstruction = drawn[i];
        failures += plan_of(&t, &with) != GN_OK;
        edges[1].half[0] = 6; /* two triangles have half-edges 0 to 5 */
        failures += plan_of(&t, &with) != GN_BAD_MESH;
        edges[1] = good;
        edges[0].half[1] = 4; /* joins nothing */
        failures += plan_of(&t, &with) != GN_BAD_MESH;
        edges[0].half[1] = GN_NO_HALF_EDGE;
        s->mesh.edge_count--;
        failures += plan_of(&t, &with) != GN_BAD_MESH;
        t.settings.reconstruction = 0;
        failures += plan_of(&t, &with) != GN_OK;
        s->mesh.edge_count = count;
        t.settings.reconstruction = drawn[i];
        s->mesh.edges = 0;
        failures += plan_of(&t, &with) != GN_BAD_ARGUMENT;
        s->mesh.edge_count = 0;
        failures += plan_of(&t, &with) != GN_OK;
        s->mesh.edges = edges;
        s->mesh.edge_count = count;
        ok(!failures, "wrong edges are refused where they are drawn, no edges are not: %s", i ? "smooth" : "sharp");
    }
    t.settings.reconstruction = &gn_silhouettes;
    t.settings.map_width = 1;
    ok(plan_of(&t, &with) == GN_UNSUPPORTED, "a map without cells is refused");
    clear_table(&t);
}

/* ---- borders on real maps ---------------------------------------------------------------------------------------- */

/* The silhouette of a random polygon, seven texels square at a time. */
static void borders_of_polygons_meet(uint64_t cases)
{
    static uint8_t cells[SIDE * SIDE];
    static patch p;
    uint64_t sides = 0, slanted = 0, drawn = 0;
    unsigned failures = 0;
    gn_statistics counts;
    for (uint64_t n = 0; n < cases && failures < 5; n++) {
        int64_t outline[12][2];
        int32_t top[12], corners = between(3, 12);
        table t;
        set_table(&t, SIDE, SIDE);
        for (int i = 0; i < corners; i++) {
            /* a star about the middle, one corner a sector */
            gn_angle angle = (gn_angle)(((uint64_t)i << 32) / (uint64_t)corners);
            int64_t radius = between(100, 1900);
            outline[i][0] = 2048 + radius * gn_cosine(angle) / (1 << 30);
            outline[i][1] = 2048 + radius * gn_sine(angle) / (1 << 30);
            top[i] = -between(1000, 9000);
        }
        shape *s = add_object(&t, 0);
        add_prism(s, (const int64_t(*)[2])outline, top, corners, 0);
        make_edges(s);
        failures += draw_table(&t, cells, &counts) != GN_OK;
        random_patch(&p);
        p.warped = 0;
        p.width = p.height = MOST_SIDE;
        int32_t left = between(0, SIDE - MOST_SIDE), above = between(0, SIDE - MOST_SIDE);
        for (int32_t i = 0; i < MOST_SIDE * MOST_SIDE; i++) {
            int32_t column = i % MOST_SIDE, row = i / MOST_SIDE;
            int inside = column < MOST_SIDE - 1 && row < MOST_SIDE - 1;
            p.cells[i] = inside ? cells[(above + row) * SIDE + left + column] : CENTRE;
            drawn += p.cells[i] != CENTRE;
        }
        set_lookup(&p);
        check_sides(&p, &sides, &slanted, &failures);
        clear_table(&t);
    }
    ok(!failures && drawn > 5 * cases && slanted > 10 * cases,
       "borders along polygons meet on the sides between cells: %llu sides, %llu of lines at an angle",
       (unsigned long long)sides, (unsigned long long)slanted);
}

int main(int argc, char **argv)
{
    uint64_t cases = tap_cases(argc, argv, 8000);
    a_square_by_hand();
    a_hair_behind_is_not_hidden();
    soups_draw_what_parts_texels();
    culled_faces_hide_nothing();
    the_nearest_edge_wins();
    edges_that_part_texels_come_first();
    empty_texels_are_far();
    marks_do_not_move_depths();
    marks_hide_nothing();
    no_edge_is_passed_over();
    long_thin_maps();
    clipped_sides_stay_where_they_are();
    planning();
    quadrants_are_figure_5(500 * cases);
    places_beyond_the_cells_are_the_nearest_texels(50 * cases);
    borders_go_on_in_the_next_cell(cases);
    borders_of_polygons_meet(cases / 2);
    straight_edges_are_where_they_are(cases / 2, 0);
    straight_edges_are_where_they_are(cases / 4, 1);
    maps_are_the_twins(2 * cases);
    return tap_done();
}
