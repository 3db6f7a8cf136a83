/* Silhouettes within texels: where a map of one point a cell (Sen et al. 2003) knows the border of a shadow, and where
 * it cannot, as in their figure 7.
 *
 * Level sheets over a floor, so that every border on the map is the outline of one of them, moved. A place's answer
 * comes from the points of its cell and of the four about it: all of them lie less than 2 texels off along each axis.
 * If one edge alone comes so near, each of these points lies on it but for rounding to 1/16 texel: the answer is right
 * beyond 1/16 texel from the edge, and 1/64 for what vertices, depths and pixels are rounded by. Where two come so
 * near, one point may stand for both: corners, crossings, gaps. There nothing is promised but that no surface is spoilt
 * (check_borders in hard.c) and, for the tip of a corner, how much is lost.
 *
 * 48 pixels a metre, a texel 1/16 m. The camera looks down at 45 degrees from where the sun sets: it sees a sheet h
 * high over the floor h before it, and its shadow behind it. A square texel of the map is 9 pixels of the floor,
 * whatever the height of the sun: at 45 degrees it is longer by root 2 and foreshortened by as much. */
#include "hard.h"

#include <math.h>
#include <string.h>

static const double pi = 3.14159265358979323846;

enum { MOST_SHEETS = 2, MOST_CORNERS = 4 };

typedef struct outline {
    double corners[MOST_CORNERS][2]; /* x, z; clockwise from above */
    int count;
    double height;
} outline;

/* What the latest case built, for its truth by hand. */
static struct {
    outline sheets[MOST_SHEETS];
    int count;
    double sun; /* degrees above the horizon */
} scene;

static void begin_scene(builder *b, double sun)
{
    const double eye[3] = {4, 4, 0}, target[3] = {0, 0, 0};
    memset(&scene, 0, sizeof scene);
    scene.sun = sun;
    build_floor(b, 1.9, 1.9);
    build_camera_orthographic(b, eye, target, 1.25);
    if (sun == 90)
        build_noon(b);
    else
        build_low_sun(b, sun);
}

static void add_sheet(builder *b, const outline *sheet)
{
    uint32_t v[MOST_CORNERS];
    scene.sheets[scene.count++] = *sheet;
    build_sheet(b, 170, 120, 70);
    for (int i = 0; i < sheet->count; i++)
        v[i] = build_vertex(b, sheet->corners[i][0], sheet->height, sheet->corners[i][1]);
    for (int i = 2; i < sheet->count; i++)
        build_triangle(b, v[0], v[i], v[i - 1]);
}

/* A rectangle about (x, 0), turned about its middle; x, z: half of its sides. */
static outline rectangle(double middle, double height, double x, double z, double degrees)
{
    double c = cos(degrees * pi / 180), s = sin(degrees * pi / 180);
    outline o = {{{0, 0}}, 4, height};
    for (int i = 0; i < 4; i++) {
        double dx = i == 1 || i == 2 ? x : -x, dz = i < 2 ? -z : z;
        o.corners[i][0] = middle + dx * c - dz * s;
        o.corners[i][1] = dx * s + dz * c;
    }
    return o;
}

static int is_in(const outline *o, double x, double z)
{
    int inside = 1;
    for (int i = 0; i < o->count; i++) {
        const double *from = o->corners[i], *to = o->corners[i + 1 < o->count ? i + 1 : 0];
        inside &= (to[0] - from[0]) * (z - from[1]) - (to[1] - from[1]) * (x - from[0]) > 0;
    }
    return inside;
}

/* The shadow of a sheet on what lies h below it is the sheet, h cot(sun) further on. */
static int by_hand(const double p[3])
{
    double cot = tan((90 - scene.sun) * pi / 180);
    if (p[1] < -0.001)
        return BY_HAND_UNSAID;
    for (int i = 0; i < scene.count; i++) {
        double above = scene.sheets[i].height - p[1];
        if (above > 0.001 && is_in(&scene.sheets[i], p[0] - above * cot, p[2]))
            return BY_HAND_SHADOWED;
    }
    return BY_HAND_LIT;
}

/* ---- where one edge is alone ------------------------------------------------------------------------------------- */

static const double texel = 1.0 / 16;

/* The place of a point on the map, in texels. */
static void on_map(double x, double y, double z, double map[2])
{
    double sun = scene.sun * pi / 180;
    map[0] = z / texel;
    map[1] = (x * sin(sun) + y * cos(sun)) / texel;
}

/* Does a segment come within a square of 2 texels to either side of a place? Slabs. */
static int comes_near(const double a[2], const double b[2], const double place[2])
{
    double first = 0, last = 1;
    for (int k = 0; k < 2; k++) {
        double from = a[k] - place[k], way = b[k] - a[k];
        if (fabs(way) < 1e-9) {
            if (fabs(from) > 2)
                return 0;
            continue;
        }
        double t0 = (-2 - from) / way, t1 = (2 - from) / way;
        first = fmax(first, fmin(t0, t1));
        last = fmin(last, fmax(t0, t1));
    }
    return first <= last;
}

static int edges_near(const double p[3])
{
    double place[2], a[2], b[2];
    int count = 0;
    on_map(p[0], p[1], p[2], place);
    for (int s = 0; s < scene.count; s++) {
        const outline *o = &scene.sheets[s];
        for (int i = 0; i < o->count; i++) {
            const double *from = o->corners[i], *to = o->corners[i + 1 < o->count ? i + 1 : 0];
            on_map(from[0], o->height, from[1], a);
            on_map(to[0], o->height, to[1], b);
            count += comes_near(a, b, place);
        }
    }
    return count;
}

/* Is a border of the truth within 5/64 texel, on the map? */
static int is_at_border(const double p[3])
{
    double sine = sin(scene.sun * pi / 180), reach = 5.0 / 64 * texel;
    int here = by_hand(p);
    for (int i = 0; i < 16; i++) {
        double angle = i * pi / 8;
        const double q[3] = {p[0] + reach * cos(angle) / sine, p[1], p[2] + reach * sin(angle)};
        if (by_hand(q) != here)
            return 1;
    }
    return 0;
}

/* Wrong pixels about which one edge is alone or none is, and more than 5/64 texel from a border; all: pixels about
 * which one edge is alone. */
static size_t wrong_at_lone_edges(const hard_row *row, int method, size_t *all)
{
    const truth *t = &row->truth;
    size_t wrong = 0;
    *all = 0;
    for (size_t i = 0; i < (size_t)t->width * t->height; i++) {
        double p[3];
        for (int k = 0; k < 3; k++)
            p[k] = (row->footprint.points[i][k] - row->origin[k]) / row->unit;
        if (row->near[i] || t->mask[i] == 255)
            continue;
        int edges = edges_near(p);
        if (edges > 1)
            continue;
        *all += edges == 1;
        wrong += row->outcomes[method].mask[i] != t->mask[i] && !is_at_border(p);
    }
    return wrong;
}

/* Without silhouettes up to half a texel about an edge is wrong: of a metre of it at any angle but the map's own a
 * quarter of a texel in the mean, 36 pixels. least: what the case's edges that are alone must give; 0: there are none.
 */
static void check_edges(hard_row *row, size_t least)
{
    size_t all, wrong = wrong_at_lone_edges(row, COLUMN_MIXED_VIRTUAL, &all);
    if (least && !promise(row, wrong >= least, 0, "%s_mixed_virtual_errs_along_edges", row->about->name))
        say("%zu of %zu pixels, expected at least %zu", wrong, all, least);
    for (int method = COLUMN_SILHOUETTES; method <= COLUMN_CROSSINGS; method++) {
        wrong = wrong_at_lone_edges(row, method, &all);
        if (!promise(row, wrong == 0, 0, "%s_%s_follows_an_edge_that_is_alone", row->about->name, method_names[method]))
            say("%zu of %zu pixels are wrong", wrong, all);
    }
}

/* ---- the scenes -------------------------------------------------------------------------------------------------- */

/* Figure 7, two silhouettes cross in a texel: the shadows of two rectangles, 0.5 and 0.8 m high, form a cross on the
 * floor, and the higher one's lies across the lower one. */
static void build_cross(builder *b)
{
    begin_scene(b, 45);
    outline lower = rectangle(-0.5, 0.5, 0.8, 0.2, 25), upper = rectangle(-0.8, 0.8, 0.8, 0.2, -35);
    add_sheet(b, &lower);
    add_sheet(b, &upper);
}

/* Four long sides of 1.6 m, of which crossings and corners take half: 3 m, at least half a metre of it in sight. */
static void check_cross(hard_row *row)
{
    check_edges(row, 18);
}

/* Figure 7, two silhouettes pass each other in a texel: two rectangles side by side, a gap of 0.6 texels between them.
 */
static void build_gap(builder *b)
{
    begin_scene(b, 45);
    double c = cos(20 * pi / 180), s = sin(20 * pi / 180), way = 0.3 + 0.3 * texel;
    for (int side = -1; side <= 1; side += 2) {
        outline o = rectangle(-0.3, 0.5, 0.5, 0.3, 20);
        for (int i = 0; i < 4; i++) {
            o.corners[i][0] -= side * way * s;
            o.corners[i][1] += side * way * c;
        }
        add_sheet(b, &o);
    }
}

/* Two long sides of 1 m and four short ones of 0.6 m, less a quarter of a metre for corners each. */
static void check_gap(hard_row *row)
{
    check_edges(row, 18);
}

/* Figure 7, a corner that is lost: 20 degrees sharp, pointing along the map's diagonal. */
static const double tip[3][2] = {{0.3, 0.75}, {-0.87, -0.333}, {-0.43, -0.667}};

static void build_tip(builder *b)
{
    begin_scene(b, 45);
    outline o = {{{0, 0}}, 3, 0.6};
    memcpy(o.corners, tip, sizeof tip);
    add_sheet(b, &o);
}

/* As far as the sheet is narrower than a texel's diagonal on the map it may hold no centre: then nothing is known of
 * it. Its angle there comes from its corners; a triangle of that width w has the area w^2 / (4 tan(angle / 2)). The
 * other two corners may each lose a cell and the halves of two more: 2 texels. A texel is 9 pixels. */
static void check_tip(hard_row *row)
{
    double at[3][2], way[2][2], length[2];
    for (int i = 0; i < 3; i++)
        on_map(tip[i][0], 0.6, tip[i][1], at[i]);
    for (int i = 0; i < 2; i++) {
        for (int k = 0; k < 2; k++)
            way[i][k] = at[i + 1][k] - at[0][k];
        length[i] = hypot(way[i][0], way[i][1]);
    }
    double angle = acos((way[0][0] * way[1][0] + way[0][1] * way[1][1]) / (length[0] * length[1]));
    double lost = 9 * (2 / (4 * tan(angle / 2)) + 2 * 2);
    check_edges(row, 18);
    for (int method = COLUMN_SILHOUETTES; method <= COLUMN_CROSSINGS; method++) {
        const truth *t = &row->truth;
        size_t wrong = 0;
        for (size_t i = 0; i < (size_t)t->width * t->height; i++) {
            double p[3];
            for (int k = 0; k < 3; k++)
                p[k] = (row->footprint.points[i][k] - row->origin[k]) / row->unit;
            wrong += !row->near[i] && row->outcomes[method].mask[i] != t->mask[i] && edges_near(p) > 1;
        }
        if (!promise(row, (double)wrong <= lost, 0, "%s_%s_loses_the_corners_as_derived", row->about->name,
                     method_names[method]))
            say("%zu pixels are wrong at corners, expected at most %.1f", wrong, lost);
    }
}

/* All four edges run through centres of texels, at odd multiples of 1/32 m, under a sun overhead. */
static void build_on_centres(builder *b)
{
    begin_scene(b, 90);
    outline o = {
        {{-7 / 32.0, -15 / 32.0}, {9 / 32.0, -15 / 32.0}, {9 / 32.0, 17 / 32.0}, {-7 / 32.0, 17 / 32.0}}, 4, 0.5};
    add_sheet(b, &o);
}

/* Half a texel is wrong along edges on two sides, the ones that the fill rule gives to the wrong texel or, on the
 * others, to the right one: 0.5 + 1 m less 4 texels at the corners, 1 m, half a texel: 1/32 m^2, 51 pixels. */
static void check_on_centres(hard_row *row)
{
    check_edges(row, 40);
}

/* A bar of 0.6 texels: half of it lies between the centres. Nowhere is an edge of it alone: nothing but pixels near it
 * may be wrong. */
static void build_thin_bar(builder *b)
{
    begin_scene(b, 45);
    outline o = rectangle(-0.3, 0.6, 0.5, 0.3 * texel, 33);
    add_sheet(b, &o);
}

static void check_thin_bar(hard_row *row)
{
    check_edges(row, 0);
}

/* A half-plane whose corners lie 100 m away, beyond the light's box and what is drawn without clipping; an edge goes
 * aslant through the view. */
static void build_beyond(builder *b)
{
    begin_scene(b, 45);
    outline o = {{{-100, -100}, {-0.3 - 20, -100}, {-0.3 + 20, 100}, {-100, 100}}, 4, 0.5};
    add_sheet(b, &o);
}

/* 3.3 m of edge, at 11 degrees to rows of texels. */
static void check_beyond(hard_row *row)
{
    check_edges(row, 60);
}

/* ---- the list -------------------------------------------------------------------------------------------------- */

#define GROUP "Silhouettes"

/* Second depth of open sheets is the row `canopy`, adaptive before a shadow half_texel_before_a_shadow
 * (cases_papers.c). */
#define SHEETS                                                                                                         \
    {                                                                                                                  \
        [COLUMN_SECOND] = ANYTHING, [COLUMN_ADAPTIVE] = ANYTHING                                                       \
    }

static const hard_case cases[] = {
    {.name = "silhouettes_cross",
     .group = GROUP,
     .flags = WITH_RECEIVERS,
     .source = "Sen fig. 7",
     .title = "two silhouettes cross in a texel: two sheets, one over the other",
     .expected = "the texel's; second depth: half of the sheets, as of the canopy",
     .receivers = "silhouettes, crossings: right but within 2 texels of corners and crossings",
     .advice = "One point a cell keeps one of two silhouettes: a larger map, or `volumes`.",
     .build = build_cross,
     .by_hand = by_hand,
     .check = check_cross,
     .picture = COLUMN_SILHOUETTES + 1,
     /* Midpoint, as in W&E figure 4a: a texel whose centre lies beside the lower sheet holds the middle of the upper
      * one and the floor, 0.4, and lights what it holds of the lower one, at 0.5: half a texel, 1/32 m, along its two
      * long sides as far as they lie in shadow, 0.4 m / sin 60 each: 0.029 m^2, 47 pixels of 19200. */
     .methods = {[COLUMN_MIDPOINT] = LIGHT(0, 0.25), [COLUMN_SECOND] = ANYTHING, [COLUMN_ADAPTIVE] = ANYTHING}},
    {.name = "silhouettes_pass",
     .group = GROUP,
     .flags = WITH_RECEIVERS,
     .source = "Sen fig. 7",
     .title = "two silhouettes pass each other: a gap of 0.6 texels",
     .expected = "the texel's: the gap is lit in pieces; second depth as above",
     .receivers = "silhouettes, crossings: right but within 2 texels of the gap and of corners",
     .advice = "As above: what is narrower than a texel comes in pieces.",
     .build = build_gap,
     .by_hand = by_hand,
     .check = check_gap,
     .picture = COLUMN_SILHOUETTES + 1,
     .methods = SHEETS},
    {.name = "silhouettes_corner",
     .group = GROUP,
     .flags = WITH_RECEIVERS,
     .source = "Sen fig. 7",
     .title = "a sharp corner",
     .expected = "the texel's; second depth: half of the sheets, as of the canopy",
     .receivers = "silhouettes, crossings: right but for the tip, where the sheet is narrower than a texel's diagonal",
     .advice = "As above.",
     .build = build_tip,
     .by_hand = by_hand,
     .check = check_tip,
     .picture = COLUMN_SILHOUETTES + 1,
     .methods = SHEETS},
    {.name = "silhouettes_on_centres",
     .group = GROUP,
     .flags = WITH_RECEIVERS,
     .title = "edges through centres of texels",
     .expected = "the texel's: half a texel along two sides",
     .receivers = "silhouettes, crossings: right but within 2 texels of corners",
     .advice = "As it should be: cells are closed, an edge on a border is in those on both sides.",
     .build = build_on_centres,
     .by_hand = by_hand,
     .check = check_on_centres,
     .methods = SHEETS},
    {.name = "silhouettes_thin_bar",
     .group = GROUP,
     .flags = WITH_RECEIVERS,
     .title = "bar of 0.6 texels",
     .expected = "the texel's: its shadow breaks up; second depth as above",
     .receivers = "silhouettes, crossings: right where a row of centres lies in it; the rest is the texel's",
     .advice = "As above.",
     .build = build_thin_bar,
     .by_hand = by_hand,
     .check = check_thin_bar,
     .picture = COLUMN_SILHOUETTES + 1,
     .methods = SHEETS},
    {.name = "silhouettes_beyond",
     .group = GROUP,
     .flags = WITH_RECEIVERS,
     .title = "sheet whose corners lie 100 m beyond the light's box of 4 m",
     .expected = "the texel's; second depth: half of the sheets, as of the canopy",
     .receivers = "silhouettes, crossings: right: clipped edges keep their line",
     .advice = "As it should be.",
     .build = build_beyond,
     .by_hand = by_hand,
     .check = check_beyond,
     .methods = SHEETS},
};

const hard_list silhouette_cases = {cases, COUNT(cases)};
