/* The cascade of the shadow test against its definition: every pixel of random views tested once more, texel by texel,
 * for each receiver and each reconstruction, under both kinds of light. Maps are disturbed after the light pass, so
 * that texels disagree, tie, and are missed by one unit everywhere; votes, virtual samples, filters, fractions, colours
 * and statistics then have to be the twin's. So on warped maps, with columns and rows of any width. Cases: 80000 views,
 * or GNOMON_CASES. */
#include "gn_cascade.h"
#include "points.h"
#include "quadrants.h"
#include "scenes.h"
#include "warped.h"

#include <math.h>

typedef long double real;

#define EMPTY ((gn_depth)0xffffffffu)

/* ---- what can be chosen ---------------------------------------------------------------------------------------- */

typedef enum filter { NEAREST, BILINEAR, JITTER, BOX_3, BOX_5, BOX_7, SILHOUETTES, SMOOTH, FILTERS } filter;
typedef enum receiver { POINT, PLANE_BIAS, THREE_WAY, ALWAYS, RECEIVERS } receiver;

static const gn_reconstruction *const reconstructions[FILTERS] = {
    0, &gn_bilinear, &gn_jitter_4x4, &gn_box_3x3, &gn_box_5x5, &gn_box_7x7, &gn_silhouettes, &gn_silhouettes_smooth};
static const gn_receiver *const receivers[RECEIVERS] = {0, &gn_plane_bias, &gn_virtual, &gn_virtual_always};
static const char *const filter_names[FILTERS] = {"nearest", "bilinear", "4x4 jitter",  "3x3 box",
                                                  "5x5 box", "7x7 box",  "silhouettes", "smooth silhouettes"};
static const char *const receiver_names[RECEIVERS] = {"point", "plane bias", "virtual", "virtual always"};

/* ---- the twin -------------------------------------------------------------------------------------------------- */

static int64_t clamped(int64_t v, int64_t last)
{
    return v < 0 ? 0 : v > last ? last : v;
}

static int64_t floor_divide(int64_t n, int64_t d)
{
    int64_t q = n / d;
    return q - (n - q * d < 0);
}

/* What a comparison is made with: one depth, or a plane at the texel's centre. */
typedef struct tested {
    const gn_context *context;
    const gn_wide_plane *plane; /* 0: z */
    uint32_t z;
} tested;

static uint64_t ties, misses; /* comparisons of equal depths, and of a depth one unit behind */

/* Is the texel lit? Those beyond the map are its border's. */
static int is_lit(const tested *t, int64_t column, int64_t row)
{
    const gn_settings *s = &t->context->settings;
    column = clamped(column, s->map_width - 1);
    row = clamped(row, s->map_height - 1);
    uint32_t z = t->z;
    if (t->plane) {
        const gn_grid *grid = t->context->grid; /* planes are in fine texels */
        int64_t fine_column = grid ? grid->columns[column] : column, fine_row = grid ? grid->rows[row] : row;
        int64_t depth = t->plane->base + fine_column * t->plane->dx + fine_row * t->plane->dy;
        z = depth < 0 ? 0 : depth > 0xffffffff ? 0xffffffffu : (uint32_t)depth;
    }
    z >>= 32 - GN_DEPTH_BITS;
    gn_depth stored = texel_at(t->context, (uint32_t)column, (uint32_t)row);
    ties += z == stored;
    misses += z == stored + 1u;
    return z <= stored;
}

/* Bayer's ordered dither, by its recursion: two bits of interleaved place, the low ones first. */
static int dither(int column, int row)
{
    int value = 0;
    for (int bit = 0; bit < 2; bit++) {
        int x = column >> bit & 1, y = row >> bit & 1;
        value = 4 * value + (2 * (x ^ y) + y);
    }
    return value;
}

/* Lit shares of *whole. */
static int filtered(filter how, const tested *t, const point *p, int32_t x, int32_t y, int *whole)
{
    int64_t one = (int64_t)1 << p->bits, column = floor_divide(p->u, one), row = floor_divide(p->v, one);
    int lit = 0;
    if (how == NEAREST) {
        *whole = 1;
        return is_lit(t, column, row);
    }
    if (how == BILINEAR) {
        /* between the centres, weights in 1/256 */
        int64_t u = p->u - one / 2, v = p->v - one / 2;
        column = floor_divide(u, one);
        row = floor_divide(v, one);
        int right = (int)((u - column * one) * 256 / one), below = (int)((v - row * one) * 256 / one);
        *whole = 65536;
        return (256 - right) * (256 - below) * is_lit(t, column, row) +
               right * (256 - below) * is_lit(t, column + 1, row) + (256 - right) * below * is_lit(t, column, row + 1) +
               right * below * is_lit(t, column + 1, row + 1);
    }
    if (how == JITTER) {
        *whole = 16;
        for (int cell_y = 0; cell_y < 4; cell_y++)
            for (int cell_x = 0; cell_x < 4; cell_x++) {
                int turned_x = (cell_x + x) % 4, turned_y = (cell_y + y) % 4;
                /* in 1/32 texel: cells begin two texels before the point */
                int across = 32 * (cell_x - 2) + 2 * dither(turned_x, turned_y) + 1;
                int down = 32 * (cell_y - 2) + 2 * dither((turned_y + 2) % 4, turned_x) + 1;
                lit += is_lit(t, floor_divide(p->u + across * (one / 32), one),
                              floor_divide(p->v + down * (one / 32), one));
            }
        return lit;
    }
    /* about the point's own texel, the nearest on the map */
    int radius = how == BOX_3 ? 1 : how == BOX_5 ? 2 : 3;
    column = clamped(column, t->context->settings.map_width - 1);
    row = clamped(row, t->context->settings.map_height - 1);
    *whole = (2 * radius + 1) * (2 * radius + 1);
    for (int64_t r = row - radius; r <= row + radius; r++)
        for (int64_t c = column - radius; c <= column + radius; c++)
            lit += is_lit(t, c, r);
    return lit;
}

/* From a place in fine texels to one in texels, both from the map's corner: between two centres in proportion, and
 * from the outermost ones half a texel to the map's ends. Rounded down. */
static int64_t place_in_texels(const uint16_t *centres, int32_t count, int64_t place, int bits)
{
    int64_t one = (int64_t)1 << bits, half = one / 2;
    int32_t i = -1;
    place -= half;
    while (i + 1 < count && centres[i + 1] * one <= place)
        i++;
    if (i < 0)
        return half + floor_divide(place - centres[0] * one, 2 * centres[0] + 1);
    int64_t wide = i + 1 < count ? centres[i + 1] - centres[i] : 2 * (GN_FINE - centres[i]) - 1;
    return half + i * one + (place - centres[i] * one) / wide;
}

/* Twice the width of a texel: the mean of the ways to both neighbours; at the border the one that there is. */
static uint64_t twice_width(const uint16_t *centres, int32_t count, int64_t texel)
{
    int64_t i = clamped(texel, count - 1);
    int before = i > 0 ? centres[i] - centres[i - 1] : 0, after = i + 1 < count ? centres[i + 1] - centres[i] : 0;
    return (uint64_t)(before + after + (before ? 0 : after) + (after ? 0 : before));
}

typedef enum vote { ALL_DARK, MIXED, ALL_LIT } vote;

/* Where the light's box holds all vertices well inside, a point at its border is one that visibility has put on its ray
 * but not on its triangle (gn_shade.h): the texels of some number on are as good as any, but the same everywhere. */
static vote vote_of_any_four(const tested *t, uint32_t column, uint32_t row)
{
    uint32_t width = t->context->settings.map_width, last = width * (t->context->settings.map_height - 1u) - 2;
    uint32_t first = row * width + column;
    int lit = 0;
    first = first > last ? last : first;
    for (uint32_t i = 0; i < 4; i++) {
        uint32_t number = first + i % 2 + i / 2 * width;
        lit += is_lit(t, number % width, number / width);
    }
    return lit == 4 ? ALL_LIT : lit ? MIXED : ALL_DARK;
}

/* Wang & Molnar's rule over the four texels about the point. In the border's outer half texel the four nearest ones
 * lie to one side and cannot say that it is dark. */
static vote vote_of_four(const tested *t, const point *p)
{
    const gn_settings *s = &t->context->settings;
    int64_t one = (int64_t)1 << p->bits;
    int64_t column = floor_divide(p->u - one / 2, one), row = floor_divide(p->v - one / 2, one);
    int64_t first_column = clamped(column, s->map_width - 2), first_row = clamped(row, s->map_height - 2);
    int border = first_column != column || first_row != row, lit = 0;
    if (border && t->context->light.kind == GN_DIRECTIONAL && t->context->shading.trusted == GN_WELL_INSIDE &&
        !t->context->grid)
        return vote_of_any_four(t, (uint32_t)(p->u - one / 2) >> p->bits, (uint32_t)(p->v - one / 2) >> p->bits);
    for (int i = 0; i < 4; i++)
        lit += is_lit(t, first_column + i % 2, first_row + i / 2);
    return lit == 4 ? ALL_LIT : lit == 0 && !border ? ALL_DARK : MIXED;
}

typedef struct verdict {
    int lit, whole; /* shares */
    int outside, resampled, depths, virtual_depths;
    int reconstructed; /* by silhouettes */
} verdict;

static uint32_t less(uint32_t z, uint64_t bias)
{
    return z > bias ? (uint32_t)(z - bias) : 0;
}

/* A cell of the silhouette map; beyond it there are centres. */
static uint8_t cell_at(const gn_context *context, int64_t column, int64_t row)
{
    uint32_t stride;
    const uint8_t *map = gn_silhouette_map(context, &stride);
    int exists =
        column >= 0 && row >= 0 && column < context->settings.map_width - 1 && row < context->settings.map_height - 1;
    return exists ? map[row * stride + column] : 0x88;
}

/* Of the cells before, at and after a place's along one axis; of a warped map those at the ends stand for others. */
static void find_sizes(const uint16_t *centres, int64_t cell, int32_t count, int64_t size[3])
{
    for (int i = 0; i < 3; i++) {
        int64_t at = clamped(cell + i - 1, count - 2);
        size[i] = centres ? centres[at + 1] - centres[at] : 1;
    }
}

/* Lit shares where the four texels about a point disagree: the texel in whose quadrant it lies, or four places about
 * it. In the border's outer half texel there is no cell. */
static int by_silhouettes(filter how, const tested *t, const point *p, verdict *v)
{
    const gn_settings *s = &t->context->settings;
    int64_t one = (int64_t)1 << p->bits, x = p->u - one / 2, y = p->v - one / 2;
    int64_t column = floor_divide(x, one), row = floor_divide(y, one);
    int corner[4], sum = 0, line, shares = how == SMOOTH ? 4 : 1;
    v->whole = shares;
    if (column < 0 || row < 0 || column >= s->map_width - 1 || row >= s->map_height - 1)
        return shares * is_lit(t, floor_divide(p->u, one), floor_divide(p->v, one));
    for (int i = 0; i < 4; i++)
        sum += corner[i] = is_lit(t, column + i % 2, row + i / 2);
    if (sum == 0 || sum == 4)
        return sum ? shares : 0;
    uint8_t cells[5] = {cell_at(t->context, column, row), cell_at(t->context, column + 1, row),
                        cell_at(t->context, column, row + 1), cell_at(t->context, column - 1, row),
                        cell_at(t->context, column, row - 1)};
    cell_sizes sizes;
    const gn_grid *grid = t->context->grid;
    find_sizes(grid ? grid->columns : 0, column, s->map_width, sizes.width);
    find_sizes(grid ? grid->rows : 0, row, s->map_height, sizes.height);
    v->reconstructed = 1;
    x -= column * one;
    y -= row * one;
    if (how == SILHOUETTES)
        return corner[find_region_of(cells, &sizes, p->bits, x, y, &line)];
    sum = 0;
    for (int i = 0; i < 4; i++) {
        vector place = find_one_of_four(i, p->bits, x, y);
        sum += corner[find_region_of(cells, &sizes, p->bits, place.x, place.y, &line)];
    }
    return sum;
}

/* What a plane's slack grows by on a warped map: of its parts (gn_receiver_plane.c) the one by how far outside its
 * triangle it is asked grows with the larger side of the cell between four texels that holds the point. */
static int64_t slack_of_wide(const gn_context *context, const gn_receiver_plane *plane, const point *p)
{
    const gn_grid *grid = context->grid;
    const gn_settings *s = &context->settings;
    int64_t one = (int64_t)1 << p->bits, width[3], height[3], h = gn_rise(plane->plane.dx, plane->plane.dy);
    int64_t outside = plane->slack - 0x8000 - h / 256 * 2;
    if (!grid || !plane->exists || outside < 0)
        return 0;
    find_sizes(grid->columns, clamped(floor_divide(p->u - one / 2, one), s->map_width - 2), s->map_width, width);
    find_sizes(grid->rows, clamped(floor_divide(p->v - one / 2, one), s->map_height - 2), s->map_height, height);
    return outside * ((width[1] > height[1] ? width[1] : height[1]) - 1);
}

static int is_drawn(filter how)
{
    return how == SILHOUETTES || how == SMOOTH;
}

static verdict judge(gn_context *context, filter how, receiver who, const point *p, uint32_t triangle, int32_t x,
                     int32_t y)
{
    static const int depths[FILTERS] = {1, 4, 16, 9, 25, 49, 4, 4};
    verdict v = {0, 1, 0, 0, 0, 0, 0};
    const gn_receiver_plane *plane = who == POINT ? 0 : gn_find_plane(context, &context->workers[0], triangle, 0);
    tested t = {context, 0, p->z};
    if (p->where != ON_MAP) {
        v.outside = 1;
        v.lit = p->where == BESIDE_LIT;
        return v;
    }
    if (who == PLANE_BIAS) {
        int64_t dx = plane->plane.dx, dy = plane->plane.dy;
        uint64_t across = (uint64_t)(dx < 0 ? -dx : dx), down = (uint64_t)(dy < 0 ? -dy : dy), h = (across + down) / 2;
        if (context->grid) {
            const gn_settings *s = &context->settings;
            across *= twice_width(context->grid->columns, s->map_width, floor_divide(p->u, (int64_t)1 << p->bits));
            down *= twice_width(context->grid->rows, s->map_height, floor_divide(p->v, (int64_t)1 << p->bits));
            h = (across + down) / 4;
        }
        h = h > 0xffffffff ? 0xffffffff : h;
        t.z = less(p->z, h * (uint32_t)context->settings.slope >> 16);
    }
    if (who == THREE_WAY)
        t.z = less(p->z, GN_POINT_ERROR);
    int open = who == ALWAYS;
    if (!open && is_drawn(how)) {
        vote by = vote_of_four(&t, p);
        v.whole = how == SMOOTH ? 4 : 1;
        v.lit = by == ALL_LIT ? v.whole : by == MIXED && who != THREE_WAY ? by_silhouettes(how, &t, p, &v) : 0;
        v.depths = depths[how];
        open = by == MIXED && who == THREE_WAY;
    } else if (!open && who == THREE_WAY && how == NEAREST) {
        vote by = vote_of_four(&t, p);
        v.lit = by == ALL_LIT;
        v.depths = 4;
        open = by == MIXED;
    } else if (!open) {
        v.lit = filtered(how, &t, p, x, y, &v.whole);
        v.depths = depths[how];
        open = who == THREE_WAY && v.lit > 0 && v.lit < v.whole;
    }
    if (open) {
        gn_wide_plane nearer = plane->plane;
        nearer.base -= plane->slack + slack_of_wide(context, plane, p);
        t.plane = plane->exists ? &nearer : 0;
        v.lit = is_drawn(how) ? by_silhouettes(how, &t, p, &v) : filtered(how, &t, p, x, y, &v.whole);
        v.resampled = 1;
        v.virtual_depths = depths[how];
        v.depths += depths[how];
    }
    return v;
}

/* ---- random views ---------------------------------------------------------------------------------------------- */

enum { MOST_OBJECTS = 3, MOST_PIXELS = 1024, NEAR = 1000 };

typedef struct view {
    shape shapes[MOST_OBJECTS];
    gn_object objects[MOST_OBJECTS];
    gn_scene scene;
    gn_light light;
    gn_camera camera;
    gn_settings settings;
    filter how;
    receiver who;
    tables grid; /* with settings.warp */
} view;

/* Large triangles about the origin; one far away now and then, which leaves places on the map few fraction bits. */
static void make_scene(view *v)
{
    v->scene.object_count = (uint32_t)between(1, MOST_OBJECTS);
    v->scene.objects = v->objects;
    v->scene.ambient = (uint16_t)between(0, 65535);
    v->scene.background.g = 77;
    for (uint32_t o = 0; o < v->scene.object_count; o++) {
        shape *s = &v->shapes[o];
        int corners = between(3, 9), triangles = between(1, 6), level = between(0, 3) == 0;
        *s = shape_new(between(0, 1));
        for (int i = 0; i < corners; i++)
            add_vertex(s, between(-NEAR, NEAR), level ? 0 : between(-NEAR, NEAR), between(-NEAR, NEAR));
        for (int i = 0; i < triangles; i++)
            add_triangle(s, (uint32_t)between(0, corners - 1), (uint32_t)between(0, corners - 1),
                         (uint32_t)between(0, corners - 1));
        if (between(0, 4) == 0) {
            int32_t away = 1 << between(16, 23);
            uint32_t far_corner = add_vertex(s, between(-away, away), between(-away, away), between(-away, away));
            add_triangle(s, 0, 1, far_corner);
        }
        v->objects[o].mesh = &s->mesh;
        v->objects[o].colour.r = (uint8_t)between(0, 255);
        v->objects[o].colour.g = (uint8_t)between(0, 255);
        v->objects[o].colour.b = 255;
    }
}

static gn_status make_views(view *v)
{
    static const int32_t up[3] = {0, 1, 0};
    int32_t eye[3], target[3], direction[3], position[3];
    gn_status status;
    for (int i = 0; i < 3; i++) {
        eye[i] = between(-4 * NEAR, 4 * NEAR);
        position[i] = between(-4 * NEAR, 4 * NEAR);
        target[i] = between(-NEAR / 3, NEAR / 3);
        direction[i] = between(-100, 100);
    }
    status = gn_look_at(&v->camera, eye, target, up);
    if (status == GN_OK)
        status = between(0, 2) ? gn_perspective(&v->camera, GN_DEGREES(between(15, 90)), 400, 1 << 25)
                               : gn_orthographic(&v->camera, between(NEAR / 4, 2 * NEAR), -20 * NEAR, 1 << 25);
    if (status != GN_OK)
        return status;
    if (between(0, 1))
        return gn_spot_light(&v->light, position, target, 0, GN_DEGREES(between(20, 120)), between(20, 1000),
                             between(3 * NEAR, 12 * NEAR));
    status = gn_directional_light(&v->light, direction, 0);
    if (status == GN_OK)
        status = gn_fit_light(&v->light, &v->scene);
    if (status == GN_OK && between(0, 1)) { /* a box of its own, which leaves points out on all sides */
        v->light.box_width = between(64, 3 * NEAR);
        v->light.box_height = between(64, 3 * NEAR);
        v->light.box_depth = between(64, 3 * NEAR);
        v->light.box_u = between(-NEAR, 0);
        v->light.box_v = between(-NEAR, 0);
        v->light.box_z = between(-2 * NEAR, 0);
    }
    return status;
}

static void make_settings(view *v, uint8_t format)
{
    static const uint8_t surfaces[] = {GN_CONSTANT, GN_SECOND, GN_MIDPOINT, GN_SLOPE};
    int wide = between(0, 7) == 0; /* more than one block of points */
    gn_settings s = gn_default_settings((uint16_t)(wide ? between(129, 300) : between(4, 40)),
                                        (uint16_t)(wide ? between(1, 3) : between(4, 24)), 1);
    s.map_width = (uint16_t)(between(0, 3) ? between(2, 24) : between(25, 200));
    s.map_height = (uint16_t)(between(0, 3) ? between(2, 24) : between(25, 200));
    s.region_height = s.height; /* one region: the worker then knows the whole image */
    s.region_width = s.width;
    s.surface = surfaces[between(0, 3)];
    s.cull = GN_CULL_NONE;
    s.mask = 1;
    s.format = format;
    s.slope = between(0, 2) ? between(0, 4 << 16) : between(0, 1) ? 64 << 16 : 1 << 16;
    do {
        v->how = (filter)between(0, FILTERS - 1);
        v->who = (receiver)between(0, RECEIVERS - 1);
        s.warp = between(0, 3) ? 0 : &gn_rectilinear;
    } while (v->how == NEAREST && v->who == POINT && !s.warp); /* which is no cascade */
    random_tables(&v->grid, &s);
    s.receiver = receivers[v->who];
    s.reconstruction = reconstructions[v->how];
    v->settings = s;
}

static void free_view(view *v)
{
    for (int i = 0; i < MOST_OBJECTS; i++)
        shape_free(&v->shapes[i]);
}

/* Bring texels about what they are compared with: a visible plane's depth there, give or take a unit or a few; or
 * empty, or anything. */
static void disturb(gn_context *context, const uint32_t *triangle, int32_t pixels)
{
    gn_worker *worker = &context->workers[0];
    for (uint32_t row = 0; row < context->settings.map_height; row++)
        for (uint32_t column = 0; column < context->settings.map_width; column++) {
            gn_depth *texel = &context->map[row * context->map_stride + column];
            int how = between(0, 15);
            uint32_t seen = triangle[between(0, pixels - 1)];
            if (how == 0)
                *texel = EMPTY;
            else if (how == 1)
                *texel = (gn_depth)tap_random(&random_state);
            else if (how < 14 && seen != GN_NO_TRIANGLE) {
                gn_wide_plane plane = gn_find_plane(context, worker, seen, 0)->plane;
                int64_t fine_column = context->grid ? context->grid->columns[column] : column;
                int64_t fine_row = context->grid ? context->grid->rows[row] : row;
                int64_t z = plane.base + fine_column * plane.dx + fine_row * plane.dy;
                z -= how < 8 ? gn_find_plane(context, worker, seen, 0)->slack : 0;
                z += how % 6 < 2 ? 0 : (int64_t)between(-3, 3) * (how % 6 < 4 ? 65536 : 1);
                *texel = (gn_depth)((z < 0 ? 0 : z > 0xffffffff ? 0xffffffff : z) >> (32 - GN_DEPTH_BITS));
            }
        }
}

/* Any byte in any cell, or what was drawn. */
static void disturb_cells(gn_context *context)
{
    uint32_t stride;
    uint8_t *map = (uint8_t *)(uintptr_t)gn_silhouette_map(context, &stride);
    for (uint32_t row = 0; row + 1 < context->settings.map_height; row++)
        for (uint32_t column = 0; column + 1 < context->settings.map_width; column++)
            if (between(0, 1))
                map[row * stride + column] = (uint8_t)between(0, 255);
}

/* ---- masks and statistics -------------------------------------------------------------------------------------- */

typedef struct tally {
    unsigned failures;
    uint64_t views[RECEIVERS][FILTERS];
    uint64_t pixels, lit, shadowed, partly, outside, resampled, reconstructed, unseen, away;
    uint64_t spots, trusted, boxes, orthographic, coarse, at_border, wide, odd, warped;
} tally;

static void note_view(const view *v, uint64_t n)
{
    note("view %llu: %s light, %s camera, %s receiver, %s, image %dx%d, %smap %dx%d", (unsigned long long)n,
         v->light.kind == GN_SPOT ? "spot" : "directional",
         v->camera.projection == GN_PERSPECTIVE ? "perspective" : "orthographic", receiver_names[v->who],
         filter_names[v->how], (int)v->settings.width, (int)v->settings.height, v->settings.warp ? "warped " : "",
         (int)v->settings.map_width, (int)v->settings.map_height);
}

/* floor((254 k + n / 2) / n) */
static unsigned mask_of(int lit, int whole)
{
    return (unsigned)((254 * (int64_t)lit + whole / 2) / whole);
}

static void compare_pixels(const view *v, frame *f, const uint32_t *q, const uint32_t *triangle, uint64_t n,
                           gn_statistics *expected, int *odd, tally *count)
{
    gn_context *context = f->context;
    for (int32_t i = 0; i < v->settings.width * v->settings.height; i++) {
        int32_t x = i % v->settings.width, y = i / v->settings.width;
        unsigned got = f->mask[i];
        if (triangle[i] == GN_NO_TRIANGLE) {
            count->unseen++;
            if (got != 255 && count->failures++ < 5)
                note("view %llu, pixel (%d, %d) sees nothing: mask %u, expected 255", (unsigned long long)n, (int)x,
                     (int)y, got);
            continue;
        }
        expected->pixels_shaded++;
        if (!gn_find_pair(context, &context->workers[0], triangle[i])->faces_light) {
            count->away++;
            if (got != 0 && count->failures++ < 5)
                note("view %llu, pixel (%d, %d) is turned away: mask %u, expected 0", (unsigned long long)n, (int)x,
                     (int)y, got);
            continue;
        }
        point p = find_point(context, x, y, q[i]);
        if (p.beside) { /* what it is compared with says nothing: that it is the same everywhere, vector_test shows */
            *odd = 1;
            continue;
        }
        if (context->grid && p.where == ON_MAP) {
            p.u = place_in_texels(context->grid->columns, v->settings.map_width, p.u, p.bits);
            p.v = place_in_texels(context->grid->rows, v->settings.map_height, p.v, p.bits);
        }
        verdict e = judge(context, v->how, v->who, &p, triangle[i], x, y);
        unsigned mask = mask_of(e.lit, e.whole);
        int partly = e.lit > 0 && e.lit < e.whole;
        expected->pixels_tested++;
        expected->pixels_outside += (uint64_t)e.outside;
        expected->pixels_virtual += (uint64_t)e.resampled;
        expected->pixels_fractional += (uint64_t)partly;
        expected->pixels_silhouette += (uint64_t)e.reconstructed;
        expected->pixels_agreed += (uint64_t)(!e.outside && !e.resampled && !partly && !e.reconstructed);
        count->reconstructed += (uint64_t)e.reconstructed;
        /* without virtual samples the texels are compared once more */
        expected->texels_read += (uint64_t)e.depths + (e.reconstructed && !e.resampled ? 4 : 0);
        expected->virtual_samples += (uint64_t)e.virtual_depths;
        count->pixels++;
        count->lit += e.lit == e.whole;
        count->shadowed += e.lit == 0;
        count->partly += (uint64_t)partly;
        count->outside += (uint64_t)e.outside;
        count->resampled += (uint64_t)e.resampled;
        int64_t half = (int64_t)1 << (p.bits - 1);
        count->at_border +=
            p.where == ON_MAP && (p.u < half || p.v < half || p.u >> p.bits == v->settings.map_width - 1 ||
                                  p.v >> p.bits == v->settings.map_height - 1);
        if (got != mask && count->failures++ < 5) {
            note_view(v, n);
            note("    pixel (%d, %d), texel (%.4f, %.4f), z %lu: mask %u, expected %u: %d of %d shares%s%s", (int)x,
                 (int)y, (double)p.u / (double)(2 * half), (double)p.v / (double)(2 * half), (unsigned long)p.z, got,
                 mask, e.lit, e.whole, e.outside ? ", outside" : "", e.resampled ? ", by virtual samples" : "");
        }
    }
}

static int same_count(const char *what, uint64_t got, uint64_t expected, const view *v, uint64_t n)
{
    if (got == expected)
        return 1;
    note_view(v, n);
    note("    %s: got %llu, expected %llu", what, (unsigned long long)got, (unsigned long long)expected);
    return 0;
}

/* Each pixel that is tested is outside, agreed on, decided by virtual samples, or partly lit at its point's depth. */
static void compare_statistics(const view *v, const frame *f, uint64_t n, const gn_statistics *e, tally *count)
{
#if GN_STATISTICS
    gn_statistics s;
    gn_get_statistics(f->context, &s);
    int good = same_count("pixels_shaded", s.pixels_shaded, e->pixels_shaded, v, n) &&
               same_count("pixels_tested", s.pixels_tested, e->pixels_tested, v, n) &&
               same_count("pixels_outside", s.pixels_outside, e->pixels_outside, v, n) &&
               same_count("pixels_agreed", s.pixels_agreed, e->pixels_agreed, v, n) &&
               same_count("pixels_virtual", s.pixels_virtual, e->pixels_virtual, v, n) &&
               same_count("pixels_fractional", s.pixels_fractional, e->pixels_fractional, v, n) &&
               same_count("pixels_silhouette", s.pixels_silhouette, e->pixels_silhouette, v, n) &&
               same_count("texels_read", s.texels_read, e->texels_read, v, n) &&
               same_count("virtual_samples", s.virtual_samples, e->virtual_samples, v, n);
    uint64_t sum = s.pixels_outside + s.pixels_agreed + s.pixels_virtual;
    sum += v->who == THREE_WAY || v->who == ALWAYS ? 0 : is_drawn(v->how) ? s.pixels_silhouette : s.pixels_fractional;
    good = good && same_count("the sum over stages", sum, s.pixels_tested, v, n);
    count->failures += !good;
#else
    (void)v, (void)f, (void)n, (void)e, (void)count;
#endif
}

static void compare_view(uint64_t n, tally *count)
{
    static uint32_t q[MOST_PIXELS], triangle[MOST_PIXELS];
    static view v;
    frame f;
    gn_statistics expected;
    int odd = 0;
    memset(&v, 0, sizeof v);
    memset(&f, 0, sizeof f);
    memset(&expected, 0, sizeof expected);
    make_scene(&v);
    make_settings(&v, GN_NO_COLOUR);
    gn_status status = make_views(&v);
    if (status == GN_OK)
        status = frame_start(&f, &v.scene, &v.settings);
    if (status == GN_OK && v.settings.warp)
        status = warp_frame(&f, &v.light, &v.camera, &v.grid);
    if (status == GN_OK)
        status = gn_light_pass(f.context, &v.light);
    if (status == GN_OK)
        status = gn_camera_begin(f.context, &v.camera);
    if (status == GN_OK) {
        gn_context *context = f.context;
        int32_t pixels = v.settings.width * v.settings.height;
        gn_window window = {0, 0, v.settings.width, v.settings.height};
        gn_pixels region;
        gn_rasterise_region(context, &context->workers[0], &window);
        memcpy(q, context->workers[0].q, (size_t)pixels * 4);
        memcpy(triangle, context->workers[0].triangle, (size_t)pixels * 4);
        if (v.who != POINT)
            disturb(context, triangle, pixels);
        if (is_drawn(v.how))
            disturb_cells(context);
        status = gn_camera_region(context, 0, 0, 0, f.mask, &region);
        compare_pixels(&v, &f, q, triangle, n, &expected, &odd, count);
        if (!odd)
            compare_statistics(&v, &f, n, &expected, count);
        count->odd += (uint64_t)odd;
        count->views[v.who][v.how]++;
        count->spots += v.light.kind == GN_SPOT;
        count->trusted += v.light.kind == GN_DIRECTIONAL && context->shading.trusted;
        count->boxes += v.light.kind == GN_DIRECTIONAL && !context->shading.trusted;
        count->orthographic += context->camera_view.affine;
        count->coarse += v.light.kind == GN_DIRECTIONAL && context->shading.position_bits < 8;
        count->wide += v.settings.width > 128;
        count->warped += v.settings.warp != 0;
    }
    if (f.block && !frame_end(&f) && count->failures++ < 5)
        note("view %llu: wrote outside its block", (unsigned long long)n);
    free_view(&v);
}

static void masks_are_the_definition(uint64_t cases)
{
    static tally count;
    uint64_t views = 0, fewest = UINT64_MAX;
    for (uint64_t n = 0; n < cases && count.failures < 5; n++)
        compare_view(n, &count);
    for (int r = 0; r < RECEIVERS; r++)
        for (int h = 0; h < FILTERS; h++) {
            views += count.views[r][h];
            if (r != POINT || h != NEAREST)
                fewest = count.views[r][h] < fewest ? count.views[r][h] : fewest;
        }
    ok(!count.failures, "masks and statistics are the definition's, in %llu views, %llu pixels",
       (unsigned long long)views, (unsigned long long)count.pixels);
    ok(views > cases * 3 / 4 && fewest > cases / 60 && count.lit > 2 * cases && count.shadowed > cases &&
           count.partly > 2 * cases && count.resampled > 2 * cases && count.reconstructed > cases / 2 &&
           count.outside > cases && count.unseen > 5 * cases && count.away > 2 * cases && count.at_border > cases &&
           ties > cases && misses > cases / 8,
       "%llu pixels lit, %llu shadowed, %llu partly lit, %llu by virtual samples, %llu by silhouettes, %llu outside, "
       "%llu at the border; "
       "%llu comparisons of equal depths, %llu one unit behind",
       (unsigned long long)count.lit, (unsigned long long)count.shadowed, (unsigned long long)count.partly,
       (unsigned long long)count.resampled, (unsigned long long)count.reconstructed, (unsigned long long)count.outside,
       (unsigned long long)count.at_border, (unsigned long long)ties, (unsigned long long)misses);
    ok(count.spots > cases / 5 && count.trusted > cases / 20 && count.boxes > cases / 20 &&
           count.orthographic > cases / 5 && count.coarse > cases / 400 && count.wide > cases / 20 &&
           count.odd < cases / 1000 && count.warped > cases / 8,
       "%llu spot lights, %llu boxes around all, %llu that leave points out, %llu orthographic cameras, %llu with few "
       "bits of place, %llu wider than a block, %llu warped maps",
       (unsigned long long)count.spots, (unsigned long long)count.trusted, (unsigned long long)count.boxes,
       (unsigned long long)count.orthographic, (unsigned long long)count.coarse, (unsigned long long)count.wide,
       (unsigned long long)count.warped);
}

/* ---- by hand --------------------------------------------------------------------------------------------------- */

/* A floor seen from just above, half a texel a pixel, beneath a caster over the first columns (or rows) of a map of
 * 16 x 16: pixel x has its point at texel x / 2 + 1/4, and 1/512 more so that no weight hangs on a rounding. */
enum { SIDE = 16, TEXEL = 1024, FLOOR = 2000, CASTER = 1000 };

typedef struct floor_scene {
    shape ground, caster;
    gn_object objects[2];
    gn_scene scene;
    gn_light light;
    gn_camera camera;
} floor_scene;

static gn_status build_floor(floor_scene *f, int edge, int down)
{
    static const int32_t up[3] = {0, 1, 0};
    int32_t eye[3] = {SIDE * TEXEL / 2 + 2, SIDE * TEXEL / 2 - 2, -FLOOR + 500}, target[3] = {eye[0], eye[1], -FLOOR};
    int32_t end = edge * TEXEL, all = 2 * SIDE * TEXEL;
    memset(f, 0, sizeof *f);
    f->ground = shape_new(0);
    f->caster = shape_new(0);
    add_level(&f->ground, -all, -all, all, all, -FLOOR, 1);
    if (down) /* row 0 is the largest y */
        add_level(&f->caster, -all, SIDE * TEXEL - end, all, all, -CASTER, 1);
    else
        add_level(&f->caster, -all, -all, end, all, -CASTER, 1);
    f->objects[0].mesh = &f->ground.mesh;
    f->objects[1].mesh = &f->caster.mesh;
    f->scene.objects = f->objects;
    f->scene.object_count = edge ? 2 : 1;
    f->light = grid_light(SIDE, SIDE);
    f->light.box_width = f->light.box_height = SIDE * TEXEL;
    gn_status status = gn_look_at(&f->camera, eye, target, up);
    return status == GN_OK ? gn_orthographic(&f->camera, SIDE * TEXEL / 2, 1, 4000) : status;
}

static gn_settings floor_settings(filter how, receiver who)
{
    gn_settings s = gn_default_settings(2 * SIDE, 2 * SIDE, SIDE);
    s.format = GN_NO_COLOUR;
    s.mask = 1;
    s.surface = GN_CONSTANT;
    s.slope = 1 << 16;
    s.receiver = receivers[who];
    s.reconstruction = reconstructions[how];
    return s;
}

/* Masks of pixels 0 to 20 across an edge after so many texels, worked out by hand. Bilinear: 1/4 and 3/4 of 254, that
 * is floor(63.5 + 1/2), floor(190.5 + 1/2). Boxes: of n x n taps, n for each lit column; those beyond the map count as
 * the border's. 4 x 4: the places of 4 cells along the row, each lit from matrix value 4 or 12 on.
 * Silhouettes: the edge itself, from which all points are farther than 1/8 texel. */
typedef struct edge_by_hand {
    filter how;
    int edge;
    uint8_t masks[21];
} edge_by_hand;

static const edge_by_hand edges_by_hand[] = {
    {NEAREST, 8, {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 254, 254, 254, 254, 254}},
    {BILINEAR, 8, {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 64, 191, 254, 254, 254, 254}},
    {JITTER, 8, {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 32, 95, 127, 127, 159, 222, 254, 254}},
    {BOX_3, 8, {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 85, 85, 169, 169, 254, 254, 254}},
    {BOX_5, 8, {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 51, 51, 102, 102, 152, 152, 203, 203, 254}},
    {BOX_7, 8, {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 36, 36, 73, 73, 109, 109, 145, 145, 181, 181, 218}},
    {NEAREST, 1, {0, 0, 254, 254, 254, 254, 254, 254, 254, 254, 254, 254, 254, 254, 254, 254, 254, 254, 254, 254, 254}},
    {BILINEAR, 1, {0,   64,  191, 254, 254, 254, 254, 254, 254, 254, 254,
                   254, 254, 254, 254, 254, 254, 254, 254, 254, 254}},
    {JITTER, 1, {95,  127, 127, 159, 222, 254, 254, 254, 254, 254, 254,
                 254, 254, 254, 254, 254, 254, 254, 254, 254, 254}},
    {BOX_3, 1, {85, 85, 169, 169, 254, 254, 254, 254, 254, 254, 254, 254, 254, 254, 254, 254, 254, 254, 254, 254, 254}},
    {BOX_5, 1, {102, 102, 152, 152, 203, 203, 254, 254, 254, 254, 254,
                254, 254, 254, 254, 254, 254, 254, 254, 254, 254}},
    {BOX_7, 1, {109, 109, 145, 145, 181, 181, 218, 218, 254, 254, 254,
                254, 254, 254, 254, 254, 254, 254, 254, 254, 254}},
    {SILHOUETTES, 8, {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 254, 254, 254, 254, 254}},
    {SMOOTH, 8, {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 254, 254, 254, 254, 254}},
    {SILHOUETTES, 1, {0,   0,   254, 254, 254, 254, 254, 254, 254, 254, 254,
                      254, 254, 254, 254, 254, 254, 254, 254, 254, 254}},
    {SMOOTH, 1, {0, 0, 254, 254, 254, 254, 254, 254, 254, 254, 254, 254, 254, 254, 254, 254, 254, 254, 254, 254, 254}},
};

static void edges_are_filtered_by_hand(void)
{
    for (size_t n = 0; n < sizeof edges_by_hand / sizeof edges_by_hand[0]; n++) {
        const edge_by_hand *e = &edges_by_hand[n];
        unsigned failures = 0;
        for (int who = POINT; who < RECEIVERS; who++)
            for (int down = 0; down < 2; down++) {
                floor_scene scene;
                frame f;
                gn_settings s = floor_settings(e->how, (receiver)who);
                gn_status status = build_floor(&scene, e->edge, down);
                if (status == GN_OK)
                    status = frame_start(&f, &scene.scene, &s);
                if (status == GN_OK)
                    status = frame_render(&f, &scene.light, &scene.camera);
                failures += status != GN_OK;
                for (int i = 0; status == GN_OK && i < 21 * 2 * SIDE; i++) {
                    int along = i % 21, other = i / 21, expected = e->masks[along];
                    int got = f.mask[down ? along * 2 * SIDE + other : other * 2 * SIDE + along];
                    if (got != expected && failures++ < 3)
                        note("%s, %s receiver, pixel %d %s, %d: got %d, expected %d", filter_names[e->how],
                             receiver_names[who], along, down ? "down" : "across", other, got, expected);
                }
                if (status == GN_OK && !frame_end(&f))
                    failures++;
                shape_free(&scene.ground);
                shape_free(&scene.caster);
            }
        ok(!failures, "%s over an edge after %d texels, by hand, with all receivers", filter_names[e->how], e->edge);
    }
}

/* A level floor over a map that holds one depth, in 16-bit units from the floor's own: lit from which on? Points and
 * virtual samples at the same unit are lit, one farther is not. For the three-way rule the point lies one unit nearer.
 */
static void ties_are_lit_at_each_stage(void)
{
    for (int who = POINT; who < RECEIVERS; who++)
        for (int how = NEAREST; how < FILTERS; how++) {
            unsigned failures = 0;
            for (int units = -4; units <= 3; units++) {
                floor_scene scene;
                frame f;
                gn_settings s = floor_settings((filter)how, (receiver)who);
                gn_status status = build_floor(&scene, 0, 0);
                if (status == GN_OK)
                    status = frame_start(&f, &scene.scene, &s);
                if (status == GN_OK)
                    status = gn_light_pass(f.context, &scene.light);
                /* in 32 bits half a unit more: points and planes then do not hang on their last bits */
                gn_depth stored =
                    (gn_depth)(grid_depth(FLOOR) + (gn_depth)units * grid_bias(1) + (GN_DEPTH_BITS == 32 ? 20000 : 0));
                for (uint32_t i = 0; status == GN_OK && i < SIDE * SIDE; i++)
                    f.context->map[i / SIDE * f.context->map_stride + i % SIDE] = stored;
                if (status == GN_OK)
                    status = gn_camera_pass(f.context, &scene.camera, frame_flush, &f);
                int least = who == THREE_WAY ? -1 : 0, expected = units >= least ? 254 : 0;
                failures += status != GN_OK;
                for (size_t i = 0; status == GN_OK && i < mask_bytes(&f); i++)
                    if (f.mask[i] != expected && failures++ < 3)
                        note("%s, %s receiver, map %d units from the floor, pixel %d: got %d, expected %d",
                             filter_names[how], receiver_names[who], units, (int)i, (int)f.mask[i], expected);
                if (status == GN_OK && !frame_end(&f))
                    failures++;
                shape_free(&scene.ground);
                shape_free(&scene.caster);
            }
            ok(!failures, "ties are lit: %s receiver, %s", receiver_names[who], filter_names[how]);
        }
}

/* One texel apart from the rest opens the vote: then the plane decides, by its own depth less its slack of half a unit,
 * in 16 bits the same unit. */
static void open_votes_ask_the_plane(void)
{
    for (int units = -3; units <= 1; units++) {
        floor_scene scene;
        frame f;
        gn_settings s = floor_settings(NEAREST, THREE_WAY);
        unsigned failures = 0, lit = 0;
        gn_status status = build_floor(&scene, 0, 0);
        if (status == GN_OK)
            status = frame_start(&f, &scene.scene, &s);
        if (status == GN_OK)
            status = gn_light_pass(f.context, &scene.light);
        gn_depth stored = (gn_depth)(grid_depth(FLOOR) + (gn_depth)units * grid_bias(1));
        /* every second texel each way is empty, and so is one of any four: no vote is all dark */
        for (uint32_t i = 0; status == GN_OK && i < SIDE * SIDE; i++)
            f.context->map[i / SIDE * f.context->map_stride + i % SIDE] = i % 2 && i / SIDE % 2 ? EMPTY : stored;
        if (status == GN_OK)
            status = gn_camera_pass(f.context, &scene.camera, frame_flush, &f);
        for (int i = 0; status == GN_OK && i < 4 * SIDE * SIDE; i++) {
            int column = i % (2 * SIDE) / 2, row = i / (2 * SIDE) / 2;
            /* the point is one unit nearer for the vote, the plane half a unit for itself */
            int expected = units >= -1 && GN_DEPTH_BITS == 16 ? 254
                           : column % 2 && row % 2            ? 254
                           : units >= 0                       ? 254
                                                              : 0;
            if (GN_DEPTH_BITS == 32 && units == -1) /* the point errs by less than a unit: either way */
                continue;
            lit += f.mask[i] == 254;
            if (f.mask[i] != expected && failures++ < 3)
                note("map %d units from the floor, pixel (%d, %d): got %d, expected %d", units, i % (2 * SIDE),
                     i / (2 * SIDE), (int)f.mask[i], expected);
        }
        ok(!failures && status == GN_OK && (lit > 0 || units == -1) && frame_end(&f),
           "an open vote asks the plane: map %d units from the floor", units);
        shape_free(&scene.ground);
        shape_free(&scene.caster);
    }
}

/* ---- other ways to the same masks ------------------------------------------------------------------------------ */

/* Both passes; what each pixel of the one region sees. */
static gn_status render_view(frame *f, const view *v, uint32_t *q, uint32_t *triangle)
{
    gn_pixels region;
    gn_window window = {0, 0, v->settings.width, v->settings.height};
    gn_status status = frame_start(f, &v->scene, &v->settings);
    if (status == GN_OK && v->settings.warp)
        status = warp_frame(f, &v->light, &v->camera, &v->grid);
    if (status == GN_OK)
        status = gn_light_pass(f->context, &v->light);
    if (status == GN_OK)
        status = gn_camera_begin(f->context, &v->camera);
    if (status != GN_OK)
        return status;
    gn_rasterise_region(f->context, &f->context->workers[0], &window);
    memcpy(q, f->context->workers[0].q, mask_bytes(f) * 4);
    memcpy(triangle, f->context->workers[0].triangle, mask_bytes(f) * 4);
    return gn_camera_region(f->context, 0, 0, 0, f->mask, &region);
}

/* The cascade finds points by itself: with a bias of nothing it gives what the test of a row in one go gives. */
static void a_bias_of_nothing_is_no_receiver(uint64_t cases)
{
    static uint32_t q[MOST_PIXELS], triangle[MOST_PIXELS];
    static view v;
    uint64_t views = 0, lit = 0, shadowed = 0, beside = 0;
    unsigned failures = 0;
    for (uint64_t n = 0; n < cases && failures < 5; n++) {
        frame plain, biased;
        memset(&v, 0, sizeof v);
        memset(&plain, 0, sizeof plain);
        memset(&biased, 0, sizeof biased);
        make_scene(&v);
        make_settings(&v, GN_NO_COLOUR);
        v.settings.receiver = 0;
        v.settings.reconstruction = 0;
        gn_status status = make_views(&v);
        if (status == GN_OK)
            status = render_view(&plain, &v, q, triangle);
        v.settings.receiver = &gn_plane_bias;
        v.settings.slope = 0;
        v.settings.surface = v.settings.surface == GN_SLOPE ? GN_CONSTANT : v.settings.surface;
        if (status == GN_OK && plain.settings.surface != GN_SLOPE)
            status = render_view(&biased, &v, q, triangle);
        for (size_t i = 0; biased.mask && status == GN_OK && i < mask_bytes(&biased); i++) {
            point p =
                find_point(biased.context, (int32_t)(i % v.settings.width), (int32_t)(i / v.settings.width), q[i]);
            if (p.where == ON_MAP && triangle[i] != GN_NO_TRIANGLE &&
                (p.beside || p.u < 0 || p.v < 0 || p.u >> p.bits >= fine_size(biased.context, v.settings.map_width) ||
                 p.v >> p.bits >= fine_size(biased.context, v.settings.map_height))) {
                beside++; /* on its ray but not on its triangle (gn_shade.h) */
                continue;
            }
            lit += biased.mask[i] == 254;
            shadowed += biased.mask[i] == 0;
            if (plain.mask[i] != biased.mask[i] && failures++ < 5) {
                note_view(&v, n);
                note("    pixel %lu: without a receiver %u, with a bias of nothing %u", (unsigned long)i,
                     (unsigned)plain.mask[i], (unsigned)biased.mask[i]);
            }
        }
        views += biased.mask && status == GN_OK;
        if ((plain.block && !frame_end(&plain)) || (biased.block && !frame_end(&biased)))
            failures++;
        free_view(&v);
    }
    ok(!failures && views > cases / 2 && lit > cases && shadowed > cases,
       "a bias of nothing is no receiver: %llu pixels lit, %llu shadowed in %llu views", (unsigned long long)lit,
       (unsigned long long)shadowed, (unsigned long long)views);
    note("%llu pixels' points lay beside a map that holds all vertices", (unsigned long long)beside);
}

/* Turn the order of objects and of each one's triangles around. */
static void reverse_order(view *v)
{
    for (uint32_t o = 0; o < v->scene.object_count; o++) {
        shape *s = &v->shapes[o];
        for (uint32_t i = 0, j = s->mesh.triangle_count; i + 1 < j--; i++)
            for (int k = 0; k < 3; k++) {
                uint32_t index = s->indices[3 * i + (uint32_t)k];
                s->indices[3 * i + (uint32_t)k] = s->indices[3 * j + (uint32_t)k];
                s->indices[3 * j + (uint32_t)k] = index;
            }
    }
    for (uint32_t i = 0, j = v->scene.object_count; i + 1 < j--; i++) {
        gn_object object = v->objects[i];
        v->objects[i] = v->objects[j];
        v->objects[j] = object;
    }
}

/* The identifier that a triangle has got now that all orders are turned around. */
static uint32_t reversed(const gn_context *context, uint32_t triangle)
{
    uint32_t object = triangle >> context->triangle_bits, i = triangle & ((1u << context->triangle_bits) - 1);
    object = context->scene->object_count - 1 - object;
    return object << context->triangle_bits | (context->scene->objects[object].mesh->triangle_count - 1 - i);
}

static void masks_do_not_depend_on_the_order_of_triangles(uint64_t cases)
{
    static uint32_t q[2][MOST_PIXELS], triangle[2][MOST_PIXELS];
    static view v;
    uint64_t same = 0, tied = 0, partly = 0, many = 0;
    unsigned failures = 0;
    for (uint64_t n = 0; n < cases && failures < 5; n++) {
        frame f[2];
        memset(&v, 0, sizeof v);
        memset(f, 0, sizeof f);
        make_scene(&v);
        make_settings(&v, GN_NO_COLOUR);
        gn_status status = make_views(&v);
        for (int turned = 0; status == GN_OK && turned < 2; turned++) {
            if (turned)
                reverse_order(&v);
            status = render_view(&f[turned], &v, q[turned], triangle[turned]);
        }
        for (size_t i = 0; status == GN_OK && i < mask_bytes(&f[0]); i++) {
            uint32_t before = triangle[0][i], after = triangle[1][i];
            /* of two at one depth the lower number is seen: the only thing that order may decide */
            if (before == GN_NO_TRIANGLE ? after != before : after != reversed(f[1].context, before)) {
                tied++;
                failures += q[0][i] != q[1][i];
                continue;
            }
            same++;
            partly += f[0].mask[i] > 0 && f[0].mask[i] < 254;
            if (f[0].mask[i] != f[1].mask[i] && failures++ < 5) {
                note_view(&v, n);
                note("    pixel %lu: %u, with the order turned around %u", (unsigned long)i, (unsigned)f[0].mask[i],
                     (unsigned)f[1].mask[i]);
            }
        }
        many += status == GN_OK && (v.scene.object_count > 1 || v.shapes[0].mesh.triangle_count > 1);
        for (int i = 0; i < 2; i++)
            if (f[i].block && !frame_end(&f[i]))
                failures++;
        free_view(&v);
    }
    ok(!failures && many > cases / 2 && partly > cases / 2 && same > 100 * tied,
       "masks do not depend on the order of triangles and objects: %llu pixels, %llu of them partly lit, %llu ties",
       (unsigned long long)same, (unsigned long long)partly, (unsigned long long)tied);
}

int main(int argc, char **argv)
{
    uint64_t cases = tap_cases(argc, argv, 80000);
    edges_are_filtered_by_hand();
    ties_are_lit_at_each_stage();
    open_votes_ask_the_plane();
    masks_are_the_definition(cases);
    a_bias_of_nothing_is_no_receiver(cases / 4);
    masks_do_not_depend_on_the_order_of_triangles(cases / 8);
    return tap_done();
}
