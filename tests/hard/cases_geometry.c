/* Meshes that make trouble: slivers, needles, T-junctions, faces in one plane, solids that touch, cross, hold one
 * another or are inside out, sheets before solids.
 *
 * Unless said otherwise seen from above: 48 pixels a metre, 10/3 m x 5/2 m = 8.33 m^2; t = 1/16 m is 3 pixels. */
#include "hard.h"

#include <math.h>

static const double root_3 = 1.7320508075688772;

/* ---- slivers, needles, T-junctions ----------------------------------------------------------------------------- */

/* A slab whose top is a fan of 300 triangles from one corner: most are narrower than a pixel for most of their length,
 * and those near the corner have less area than one in 2^-10 of its texels. A depth inside a triangle lies between
 * those of its corners, and a corner snapped by 1/512 texel is off by that much: slivers are as good as the whole. */
static void build_fan(builder *b)
{
    enum { PIECES = 150 };
    build_solid(b, 200, 200, 190);
    uint32_t low[4], first = build_vertex(b, -1.9, 0, 1.4), last = 0;
    for (int i = 0; i < 4; i++)
        low[i] = build_vertex(b, i == 1 || i == 2 ? 1.9 : -1.9, -0.5, i < 2 ? 1.4 : -1.4);
    build_triangle(b, low[0], low[2], low[1]);
    build_triangle(b, low[0], low[3], low[2]);
    for (int i = 0; i <= 2 * PIECES; i++) {
        double right = i < PIECES ? 1.9 : 1.9 - 3.8 * (i - PIECES) / PIECES;
        double back = i < PIECES ? 1.4 - 2.8 * i / PIECES : -1.4;
        uint32_t next = build_vertex(b, right, 0, back);
        if (i > 0) {
            build_triangle(b, first, last, next);
            build_triangle(b, i <= PIECES ? low[1] : low[2], next, last);
        } else {
            build_triangle(b, low[0], next, first);
            build_triangle(b, low[0], low[1], next);
        }
        if (i == PIECES)
            build_triangle(b, low[1], low[2], next);
        last = next;
    }
    build_triangle(b, low[2], low[3], last);
    build_triangle(b, low[3], low[0], first);
    build_triangle(b, low[3], first, last);
    build_solid(b, 170, 120, 70);
    build_box(b, -0.9, -0.4, 0, 0.5, -0.5, 0.5);
    build_view_from_above(b, 45);
}

static int fan_by_hand(const double p[3])
{
    return p[1] > 0.4 ? BY_HAND_LIT : lit_unless(in(p[0], -0.9, 0.1) && fabs(p[2]) < 0.5);
}

/* Facets of half a texel; the image is small for the sake of the ray caster. Front and back of a sphere meet at its
 * silhouette under the terminator, so that second depth may err there by a texel. */
static void build_fine_sphere(builder *b)
{
    build_floor(b, 1.9, 1.4);
    build_solid(b, 170, 120, 70);
    build_sphere(b, -0.5, 0.7, 0, 0.5, 24, 40);
    build_view_from_above(b, 45);
    b->width = 80;
    b->height = 60;
}

/* A needle 3.8 m long and 0.05 m wide at one end, 0.5 m above the floor: thinner than a texel. */
static const double needle[3][2] = {{-1.6, -1.2}, {1.1, 1.15}, {1.15, 1.1}}; /* x, z */

static void build_needle(builder *b)
{
    build_floor(b, 1.9, 1.4);
    build_sheet(b, 170, 120, 70);
    for (int i = 0; i < 3; i++)
        build_vertex(b, needle[i][0], 0.5, needle[i][1]);
    build_triangle(b, 0, 1, 2);
    build_view_from_above(b, 45);
}

static int needle_by_hand(const double p[3])
{
    if (p[1] > 0.4)
        return BY_HAND_LIT;
    int inside = 1;
    for (int i = 0; i < 3; i++) {
        const double *from = needle[i], *to = needle[(i + 1) % 3];
        double x = p[0] - 0.5, side = (to[0] - from[0]) * (p[2] - from[1]) - (to[1] - from[1]) * (x - from[0]);
        inside &= side < 0;
    }
    return lit_unless(inside);
}

/* A turned sheet in two halves; their common edge is one edge on one side and 16 on the other. A corner on the edge is
 * rounded off it by less than 1/256 texel, so that a gap is met by a centre once in some 256 texels of edge: of 24
 * texels, 0.1; one texel is 0.05 % of the image. The camera's gaps likewise. */
static void build_t_junctions(builder *b)
{
    enum { PIECES = 16 };
    build_floor(b, 1.9, 1.4);
    build_sheet(b, 170, 120, 70);
    uint32_t a = build_vertex(b, -0.8, 0.7, -0.7), c = build_vertex(b, -0.1, 0.7, -0.7);
    uint32_t d = build_vertex(b, -0.1, 0.7, 0.7), e = build_vertex(b, -0.8, 0.7, 0.7), f = build_vertex(b, 0.6, 0.7, 0);
    build_triangle(b, a, d, c);
    build_triangle(b, a, e, d);
    uint32_t last = c;
    for (int i = 1; i <= PIECES; i++) {
        uint32_t next = i == PIECES ? d : build_vertex(b, -0.1, 0.7, -0.7 + 1.4 * i / PIECES);
        build_triangle(b, last, next, f);
        last = next;
    }
    build_turn(b, 0, 1, 31, -0.4, 0, 0);
    build_view_from_above(b, 45);
}

/* ---- faces in one plane ---------------------------------------------------------------------------------------- */

static void build_coplanar(builder *b, int open)
{
    if (open) {
        build_sheet(b, 200, 200, 190);
        build_level(b, -1.9, 0.3, 0, -1.4, 1.4);
        build_sheet(b, 180, 200, 180);
        build_level(b, -0.3, 1.9, 0, -1.4, 1.4);
    } else {
        build_solid(b, 200, 200, 190);
        build_box(b, -1.9, 0.3, -0.5, 0, -1.4, 1.4);
        build_solid(b, 180, 200, 180);
        build_box(b, -0.3, 1.9, -0.5, 0, -1.4, 1.4);
    }
    build_solid(b, 170, 120, 70);
    build_box(b, -1.4, -1.1, 0, 0.3, -0.4, 0.4);
    build_view_from_above(b, 30);
}

static void build_coplanar_sheets(builder *b)
{
    build_coplanar(b, 1);
}

static void build_coplanar_solids(builder *b)
{
    build_coplanar(b, 0);
}

static int coplanar_by_hand(const double p[3])
{
    return p[1] > 0.2 ? BY_HAND_LIT : lit_unless(in(p[0], -1.4, -1.1 + 0.3 * root_3) && fabs(p[2]) < 0.4);
}

/* ---- solids that touch ----------------------------------------------------------------------------------------- */

static void build_block(builder *b, double turn)
{
    build_floor(b, 1.9, 1.4);
    build_solid(b, 170, 120, 70);
    build_box(b, -0.8, -0.2, 0, 0.4, -0.3, 0.3);
    build_turn(b, 0, 1, turn, -0.5, 0, 0);
    build_view_from_above(b, 45);
    b->map_width = b->map_height = 32;
}

static void build_aligned_block(builder *b)
{
    build_block(b, 0);
}

static void build_turned_block(builder *b)
{
    build_block(b, 30);
}

/* From the foot of its front to the back of its top + 0.4 cot 45. */
static int aligned_block_by_hand(const double p[3])
{
    return p[1] > 0.3 ? BY_HAND_LIT : lit_unless(in(p[0], -0.8, 0.2) && fabs(p[2]) < 0.3);
}

/* A square bar on its edge, along z at x = 0.13, map 16, e = 60. On the map v = x sin 60, distances from the contact
 * are a for a point of the floor and c for its texel's centre, positive away from the light. The floor has depth a cot
 * 60 = 0.577 a, the right underside -0.268 c, the left one, seen through the bar, -3.73 |c|. The contact stands at
 * 0.450 t of a texel: c = 0.05 t, and points before the contact (a < 0) are nearer than what is stored where 0.577 |a|
 * > 0.268 c: all but 0.006 of the 0.1126 from the texel's border on: 0.123 m of the floor, 1.6 m wide, in the shadow of
 * the overhang that begins 0.169 m before the contact. Seen from 25 degrees: 0.0832 m^2, 192 pixels; the picture has
 * about 14000 of surface. */
static void build_bar(builder *b)
{
    const double bar[4][2] = {{0.13, 0}, {0.53, 0.4}, {0.13, 0.8}, {-0.27, 0.4}};
    const double eye[3] = {-4, 1.8652306, 0}, target[3] = {0, 0.2, 0};
    build_floor(b, 1.95, 1.95);
    build_solid(b, 170, 120, 70);
    build_prism(b, bar, 4, -0.8, 0.8);
    build_camera_orthographic(b, eye, target, 1.25);
    build_low_sun(b, 60);
    b->map_width = b->map_height = 16;
}

static int bar_by_hand(const double p[3])
{
    if (fabs(p[1]) > 0.0001)
        return BY_HAND_UNSAID;
    return lit_unless(in(p[0], -0.27 + 0.4 / root_3, 0.53 + 0.4 / root_3) && fabs(p[2]) < 0.8);
}

/* ---- solids that cross, hold one another, or are inside out ---------------------------------------------------- */

/* A wedge comes out of the floor at x = 0 and rises by 0.0875 (5 degrees) to 0.07 at x = 0.8; e = 45. On the map, from
 * the crossing: the wedge has depth 0.839 v, the floor v. Texels' centres at f = 0.5 t, 1.5 t, ... either side; false
 * shadow where a point a is behind what its texel holds:
 *
 *     mixed holds the second front: a > f / 0.839: 0.41 + 0.21 + 0.02 t of the wedge; a < 0.839 f: 0.42 + 0.26 + 0.1 t
 * of the floor: 0.052 m + 0.069 m, 1.6 m wide: 2.3 %; in pixels, 1/48 m, of which a texel has four or five, 7 columns
 * of 1.6 m are behind: 2.8 %
 *     midpoint, dual hold the middle of the fronts, 0.92 v: a > 1.096 f: 1.3 t of the wedge; a < 0.92 f: 1.56 t of the
 * floor: 0.106 m + 0.138 m: 4.7 %; 15 columns: 6.0 %
 *
 * one column, 0.4 %, more or less. Constant: the shadow behind the wedge is 0.07 m long and at most 0.1
 * m, 1.6 t, behind its top: lost, 1.3 % (3.4 pixels, 4 where the centres fall so: 1.6 %), less what is the texel's. */
static void build_crossing(builder *b)
{
    const double wedge[4][2] = {{-0.8, -0.3}, {0.8, -0.3}, {0.8, 0.07}, {-0.8, -0.07}};
    build_floor(b, 1.9, 1.4);
    build_solid(b, 170, 120, 70);
    build_prism(b, wedge, 4, -0.8, 0.8);
    build_view_from_above(b, 45);
}

static int crossing_by_hand(const double p[3])
{
    return p[1] > 0.0001 ? BY_HAND_LIT : lit_unless(in(p[0], 0.8, 0.87) && fabs(p[2]) < 0.8);
}

static void build_nested(builder *b)
{
    build_floor(b, 1.9, 1.4);
    build_solid(b, 170, 120, 70);
    build_box(b, -0.9, -0.1, 0, 0.8, -0.4, 0.4);
    build_solid(b, 120, 150, 120);
    build_box(b, -0.8, -0.2, 0.1, 0.7, -0.3, 0.3);
    build_view_from_above(b, 45);
}

static int nested_by_hand(const double p[3])
{
    return p[1] > 0.7 ? BY_HAND_LIT : lit_unless(in(p[0], -0.9, 0.7) && fabs(p[2]) < 0.4);
}

static void build_inside_out(builder *b)
{
    build_floor(b, 1.9, 1.4);
    build_solid(b, 170, 120, 70);
    build_box(b, -1.2, -0.4, 0, 0.5, -0.5, 0.5);
    build_invert(b);
    build_view_from_above(b, 30);
}

static int inside_out_by_hand(const double p[3])
{
    return p[1] > 0.4 ? BY_HAND_LIT : lit_unless(in(p[0], -1.2, -0.4 + 0.5 * root_3) && fabs(p[2]) < 0.5);
}

/* ---- sheets before solids -------------------------------------------------------------------------------------- */

static void build_canopy(builder *b)
{
    build_floor(b, 1.9, 1.4);
    build_sheet(b, 170, 120, 70);
    build_level(b, -0.9, -0.1, 0.6, -0.5, 0.5);
    build_view_from_above(b, 45);
}

static int canopy_by_hand(const double p[3])
{
    return p[1] > 0.5 ? BY_HAND_LIT : lit_unless(in(p[0], -0.3, 0.5) && fabs(p[2]) < 0.5);
}

static void build_poster(builder *b)
{
    build_floor(b, 1.9, 1.4);
    build_sheet(b, 170, 120, 70);
    build_level(b, -0.9, -0.1, 1.0 / 64, -0.5, 0.5);
    build_view_from_above(b, 30);
}

static int poster_by_hand(const double p[3])
{
    if (p[1] > 0.01)
        return BY_HAND_LIT;
    return lit_unless(in(p[0], -0.9 + root_3 / 64, -0.1 + root_3 / 64) && fabs(p[2]) < 0.5);
}

/* ---- a sheet that is bent towards the light ---------------------------------------------------------------------- */

/* A valley of eight strips along z, slopes -0.8 to 0.8 in steps of 1.6/7 = 0.229, under an overhead sun; a plate over
 * it. The creases stand one pixel behind a border of texels, half a pixel before the texel's centre: the column of
 * pixels between border and crease is compared at a centre on the next strip, which lies 0.229 / 96 m = 2.4 mm above
 * its own plane. 1e-4 of the range are 0.8 mm. Seven columns of 160, 4.375 %, are dark unless a bias exceeds 2.4 mm.
 */
static double valley_crease(int i)
{
    return i == 0 ? -1.9 : i == 8 ? 1.9 : (24 * (i - 4) + 1) / 48.0;
}

static void build_valley(builder *b)
{
    double height = 0.7;
    build_sheet(b, 200, 200, 190);
    for (int i = 0; i < 8; i++) {
        double x0 = valley_crease(i), x1 = valley_crease(i + 1), next = height + (x1 - x0) * 1.6 * (i - 3.5) / 7;
        const double strip[4][3] = {{x0, height, 1.4}, {x1, next, 1.4}, {x1, next, -1.4}, {x0, height, -1.4}};
        build_quad(b, strip);
        height = next;
    }
    build_solid(b, 170, 120, 70);
    build_box(b, -0.9, -0.6, 1.3, 1.4, -0.4, 0.4);
    build_camera_orthographic(b, (const double[3]){0, 3.2, 2.4}, (const double[3]){0, 0, 0}, 1.25);
    build_noon(b);
}

static int valley_by_hand(const double p[3])
{
    return p[1] > 1.2 ? BY_HAND_LIT : lit_unless(in(p[0], -0.9, -0.6) && fabs(p[2]) < 0.4);
}

/* What is dark stands on the texel's account (footprint.h), whose centre is on the next strip: so all of it counts. */
static void check_valley(hard_row *row)
{
    static const struct {
        int method;
        double least, most;
    } expected[] = {{COLUMN_SECOND_VIRTUAL, 4.2, 4.5},
                    {COLUMN_ADAPTIVE, 4.2, 4.5},
                    {COLUMN_MIXED_VIRTUAL, 0, 0.05},
                    {COLUMN_AUTO, 0, 0.05}};
    for (size_t i = 0; i < COUNT(expected); i++) {
        double got = row->outcomes[expected[i].method].shadow_percent;
        if (!promise(row, got >= expected[i].least && got <= expected[i].most, 0,
                     "%s_%s_shadows_its_creases_as_derived", row->about->name, method_names[expected[i].method]))
            say("%.3f %%, expected %g to %g", got, expected[i].least, expected[i].most);
    }
}

/* ---- the list -------------------------------------------------------------------------------------------------- */

#define GROUP "Meshes"

static const hard_case cases[] = {
    {.name = "fan",
     .group = GROUP,
     .flags = LONG,
     .title = "floor of 300 slivers, down to a thousandth of a pixel",
     .expected = "as with two triangles: none errs",
     .advice = "Slivers cost time only, unless they are edge-on as well.",
     .build = build_fan,
     .by_hand = fan_by_hand},
    {.name = "fine_sphere",
     .group = GROUP,
     .flags = LONG | WITH_RECEIVERS,
     .title = "sphere, facets of half a texel",
     .expected = "none errs but along the terminator",
     .receivers = "none errs but along the terminator",
     .advice = "Facets need not be larger than texels.",
     .build = build_fine_sphere,
     /* A facet seen by the light at an angle below atan(1 / 4) spans more than 2 t in half a texel; those are within 14
      * degrees of the terminator, of which the camera above, 45 degrees from the light, sees half a ring: 0.5 m x pi x
      * 0.24 x 0.5 m x sin 45 / 2 = 0.066 m^2 of the sphere: 0.8 %. */
     .methods = {[COLUMN_CONSTANT] = {0, 0.8, 0, 0.8, 0},
                 [COLUMN_MIDPOINT] = {0, 0.8, 0, 0.8, 0},
                 [COLUMN_DUAL] = {0, 0.8, 0, 0.8, 0},
                 [COLUMN_SECOND] = {0, 0.8, 0, 0.8, 0},
                 [COLUMN_MIXED] = {0, 0.8, 0, 0.8, 0},
                 [COLUMN_AUTO] = {0, 0.8, 0, 0.8, 0},
                 [COLUMN_SECOND_VIRTUAL] = {0, 0.8, 0, 0.8, 0},
                 [COLUMN_MIXED_VIRTUAL] = {0, 0.8, 0, 0.8, 0},
                 [COLUMN_ADAPTIVE] = {0, 0.8, 0, 0.8, 0},
                 [COLUMN_SLOPE] = {0, 0.8, 0, 0.8, 0},
                 [COLUMN_PLANE_BIAS] = {0, 0.8, 0, 0.8, 0},
                 [COLUMN_FILTER] = {0, 0.8, 0, 0.8, 0}}},
    {.name = "needle",
     .group = GROUP,
     .flags = WITH_RECEIVERS,
     .title = "needle across the map, up to 0.8 texels wide",
     .expected = "the shadow breaks up: the texel's. Second depth: half of the needle's lit texels, at most 0.6 %",
     .receivers = "adaptive: beside the pieces of the shadow, 1.9 % at most; the others none",
     .advice = "What is thinner than a texel casts a broken shadow: a larger map, or `volumes`.",
     .build = build_needle,
     .by_hand = needle_by_hand,
     .picture = COLUMN_MIXED + 1,
     /* Adaptive, half_texel_before_a_shadow (cases_papers.c): 3.6 m x 0.044 m. */
     .methods = {[COLUMN_SECOND] = SHADOW(0, 0.6), [COLUMN_ADAPTIVE] = SHADOW(0, 1.9)}},
    {.name = "t_junctions",
     .group = GROUP,
     .flags = WITH_RECEIVERS,
     .title = "sheet with 15 T-junctions on a slanted edge",
     .expected = "at most a texel leaks. Second depth: half of the sheet",
     .receivers = "adaptive: before the shadow, 1.3 % at most; the others as above, also second depth",
     .advice = "Harmless at this size; weld them where a leak must not be.",
     .build = build_t_junctions,
     /* The sheet: 0.7 x 1.4 + 0.7 x 1.4 / 2 = 1.47 m^2, 17.6 %. */
     .methods = {[COLUMN_CONSTANT] = {0, 0.06, 0, 0.06, 0},
                 [COLUMN_MIDPOINT] = {0, 0.06, 0, 0.06, 0},
                 [COLUMN_DUAL] = {0, 0.06, 0, 0.06, 0},
                 [COLUMN_SECOND] = {7.5, 10, 0, 0.06, 0},
                 [COLUMN_MIXED] = {0, 0.06, 0, 0.06, 0},
                 [COLUMN_AUTO] = {0, 0.06, 0, 0.06, 0},
                 [COLUMN_SECOND_VIRTUAL] = {0, 0.06, 0, 0.06, 0},
                 [COLUMN_MIXED_VIRTUAL] = {0, 0.06, 0, 0.06, 0},
                 [COLUMN_ADAPTIVE] = {0, 1.3, 0, 0.06, 0},
                 [COLUMN_SLOPE] = {0, 0.06, 0, 0.06, 0},
                 [COLUMN_PLANE_BIAS] = {0, 0.06, 0, 0.06, 0},
                 [COLUMN_FILTER] = ANYTHING}},
    {.name = "coplanar_sheets",
     .group = GROUP,
     .title = "two sheets in one plane, overlapping",
     .expected = "all that uses the second surface: half of the overlap's texels are dark, 7.5 %; second depth half of "
                 "all, 46 %; auto none",
     .receivers = "second, mixed + virtual none; adaptive: two columns before the block, 0.37 %",
     .advice = "Remove doubled faces; else `constant`, virtual samples and `volumes` serve.",
     .build = build_coplanar_sheets,
     .by_hand = coplanar_by_hand,
     .flags = COUNT_TIES | LONG | WITH_RECEIVERS,
     .picture = COLUMN_MIXED + 1,
     /* The overlap, v from -0.15 to 0.15, holds the centres of four rows of texels, each six columns of pixels, of
      * which the three behind the centre are dark, as no gap leaves no bias: 12 of 160 columns. Virtual samples tie
      * with the other sheet's depth, and are lit. Adaptive: two columns of pixels stand behind the centre of the last
      * row before the block and before its foot, 0.74 m wide (without half a texel at the ends). */
     .methods = {[COLUMN_MIDPOINT] = SHADOW(7, 8),
                 [COLUMN_DUAL] = SHADOW(7, 8),
                 [COLUMN_SECOND] = SHADOW(43, 49),
                 [COLUMN_MIXED] = SHADOW(7, 8),
                 [COLUMN_ADAPTIVE] = SHADOW(0.3, 0.42)}},
    {.name = "coplanar_solids",
     .group = GROUP,
     .title = "two solids, tops in one plane, overlapping",
     .expected = "midpoint, dual, mixed: half of the overlap's texels, 7.5 to 9.4 %; second depth, auto none",
     .receivers = "the same",
     .advice = "Second depth looks at back faces only: `auto` takes it where all is closed.",
     .build = build_coplanar_solids,
     .by_hand = coplanar_by_hand,
     .flags = COUNT_TIES | WITH_RECEIVERS,
     /* As the sheets; and one row more, whose centre sees one solid's end just behind the other's top. */
     .methods = {[COLUMN_MIDPOINT] = SHADOW(7.4, 9.5),
                 [COLUMN_DUAL] = SHADOW(7.4, 9.5),
                 [COLUMN_MIXED] = SHADOW(7.4, 9.5),
                 [COLUMN_ADAPTIVE] = SHADOW(0.3, 0.42)}},
    {.name = "aligned_block",
     .group = GROUP,
     .flags = LONG,
     .title = "block on a floor, along the light, map 32",
     .expected = "no leak along the contact but of auto, 0.2 % at most",
     .advice = "A solid's bottom ties with what it stands on: let solids sink in.",
     .build = build_aligned_block,
     .by_hand = aligned_block_by_hand,
     /* tie_at_a_foot (cases_light.c): the foot ends 0.0164 m of v before its texel: 0.023 m x 0.6 m. */
     .methods = {[COLUMN_AUTO] = LIGHT(0, 0.17)}},
    {.name = "turned_block",
     .group = GROUP,
     .flags = WITH_RECEIVERS,
     .title = "the same turned by 30 degrees",
     .expected = "second depth, mixed, auto: light within half a texel behind the contact, 1.3 % at most",
     .receivers = "second, mixed + virtual: as second depth; adaptive: before the contact, 1.3 % at most",
     .advice = "Let solids sink into what they stand on; dual does not leak here.",
     .build = build_turned_block,
     .picture = COLUMN_SECOND + 1,
     /* A centre on the block's foot holds the foot's own depth, which is greater than that of points nearer to the
      * light: two edges of 0.6 m, t / 2 sin 45 = 0.088 m wide: 0.106 m^2. At the upright edges beside the light the
      * block is 2.31 w thick at a distance w from them: constant lights what lies behind less than 2 t, two triangles
      * of 0.076 m x 0.177 m / 2, 0.16 %; fronts that fall by less than half a texel shadow themselves within 0.03 m
      * (midpoint 0.06 m) of them on the top, 0.06 m deep: less than 0.1 %. */
     .methods = {[COLUMN_CONSTANT] = LIGHT(0, 0.2),
                 [COLUMN_MIDPOINT] = SHADOW(0, 0.1),
                 [COLUMN_SECOND] = {0, 0.1, 0.01, 1.3, 0},
                 [COLUMN_MIXED] = {0, 0.1, 0.01, 1.3, 0},
                 [COLUMN_AUTO] = {0, 0.1, 0.01, 1.3, 0},
                 [COLUMN_SECOND_VIRTUAL] = {0, 0.1, 0.01, 1.3, 0},
                 [COLUMN_MIXED_VIRTUAL] = {0, 0.1, 0.01, 1.3, 0},
                 [COLUMN_ADAPTIVE] = SHADOW(0, 1.3),
                 [COLUMN_SLOPE] = LIGHT(0, 0.3)}},
    {.name = "bar",
     .group = GROUP,
     .flags = WITH_RECEIVERS,
     .title = "square bar on its edge, map 16",
     .expected = "second depth, mixed, auto: 12 cm before the contact are lit, 1.4 %",
     .receivers = "second, mixed + virtual: as second depth, for the overhang is less than a texel and all four "
                  "centres are lit; adaptive: before the shadow, 1.6 % at most",
     .advice = "As above: under an overhang that ends in a contact.",
     .build = build_bar,
     .by_hand = bar_by_hand,
     .picture = COLUMN_SECOND + 1,
     /* Constant, 2 t = 0.5: where the bar is less than that thick along the light: 0.052 m of the shadow's front edge.
      The bar begins 0.59 t before the contact: four centres, 0.05 t behind it and 0.95 t before it, are lit at the
      * depth of every point between, and none is asked for its plane. Adaptive: half a texel, 0.144 m, 1.6 m wide. */
     .methods = {[COLUMN_CONSTANT] = LIGHT(0, 0.7),
                 [COLUMN_SECOND] = LIGHT(1, 1.7),
                 [COLUMN_MIXED] = LIGHT(1, 1.7),
                 [COLUMN_AUTO] = LIGHT(1, 1.7),
                 [COLUMN_SECOND_VIRTUAL] = LIGHT(0.8, 1.7),
                 [COLUMN_MIXED_VIRTUAL] = LIGHT(0.8, 1.7),
                 [COLUMN_ADAPTIVE] = SHADOW(0, 1.6)}},
    {.name = "crossing",
     .group = GROUP,
     .flags = WITH_RECEIVERS,
     .title = "wedge that rises out of the floor at 5 degrees",
     .expected =
         "midpoint, dual: false shadow along the crossing, 6.0 %; mixed 2.8 %; second depth, auto none. Constant: the "
         "wedge's shadow is lost",
     .receivers = "none errs: at its texel's centre each front is nearer than or equal to the second",
     .advice =
         "Where solids cross flatly, second depth is right (`auto` for closed scenes), or mixed with virtual samples.",
     .build = build_crossing,
     .by_hand = crossing_by_hand,
     .picture = COLUMN_DUAL + 1,
     .methods = {[COLUMN_CONSTANT] = LIGHT(0.2, 1.6),
                 [COLUMN_MIDPOINT] = SHADOW(5.6, 6),
                 [COLUMN_DUAL] = SHADOW(5.6, 6),
                 [COLUMN_MIXED] = SHADOW(2.4, 3.2)}},
    {.name = "nested",
     .group = GROUP,
     .flags = LONG,
     .title = "solid inside a solid, walls 1.6 texels",
     .expected = "none errs",
     .advice = "Walls need half a texel for second depth, a whole one for midpoint and dual.",
     .build = build_nested,
     .by_hand = nested_by_hand,
     /* The same, 0.012 m x 0.8 m. */
     .methods = {[COLUMN_AUTO] = LIGHT(0, 0.12)}},
    {.name = "inside_out",
     .group = GROUP,
     .flags = WITH_RECEIVERS,
     .title = "block marked closed, but inside out",
     .expected = "second depth: half of its top is dark, 4.8 %; auto none; dual: thin leaks behind it",
     .receivers = "mixed + virtual: behind the foot, 0.3 % at most; the others none, second depth neither",
     .advice = "`--verbose` names meshes that are inside out.",
     .build = build_inside_out,
     .by_hand = inside_out_by_hand,
     .picture = COLUMN_SECOND + 1,
     /* Midpoint: towards the back edge of the top, a quarter of a texel on the map, 0.03 m x 1 m: 0.4 %. With virtual
        samples the top ties with itself. Mixed, tie_at_a_foot (cases_light.c): 0.025 m x 1 m. */
     .methods = {[COLUMN_MIDPOINT] = SHADOW(0, 0.4),
                 [COLUMN_DUAL] = LIGHT(0, 0.3),
                 [COLUMN_SECOND] = SHADOW(4, 5.6),
                 [COLUMN_MIXED_VIRTUAL] = LIGHT(0, 0.3)}},
    {.name = "canopy",
     .group = GROUP,
     .flags = LONG,
     .title = "open sheet over a solid floor",
     .expected = "second depth: half of the sheet, 4.8 %; the others none",
     .advice = "`auto` takes mixed.",
     .build = build_canopy,
     .by_hand = canopy_by_hand,
     .methods = {[COLUMN_SECOND] = SHADOW(4, 5.6)}},
    {.name = "poster",
     .group = GROUP,
     .flags = LONG | WITH_RECEIVERS,
     .title = "open sheet 1/4 texel before a solid",
     .expected = "midpoint, dual, mixed: a third of the sheet, 3.2 %; second depth half; auto none",
     .receivers = "slope, plane bias: the poster's shadow is lost, 0.4 %; the others none",
     .advice = "Lay it on the solid (culled away by it), or farther off: half the gap must exceed half a texel's "
               "slope; or take virtual samples.",
     .build = build_poster,
     .by_hand = poster_by_hand,
     .picture = COLUMN_MIXED + 1,
     /* Half of the gap along the light is t / 4; points more than 0.25 / root 3 = 0.144 t behind the centre are dark, 2
      * of 6 pixels of a texel. Constant: its shadow, 0.027 m, is lost. */
     .methods = {[COLUMN_CONSTANT] = LIGHT(0, 0.4),
                 [COLUMN_MIDPOINT] = SHADOW(2.5, 4.9),
                 [COLUMN_DUAL] = SHADOW(2.5, 4.9),
                 [COLUMN_SECOND] = SHADOW(4, 5.6),
                 [COLUMN_MIXED] = SHADOW(2.5, 4.9),
                 [COLUMN_SLOPE] = LIGHT(0, 0.4),
                 [COLUMN_PLANE_BIAS] = LIGHT(0, 0.4)}},
    {.name = "valley",
     .group = GROUP,
     .flags = WITH_RECEIVERS,
     .title = "valley of eight strips, an open sheet",
     .expected = "second depth: what is deeper than a texel's centre, a column of pixels in three (32 bits: up to "
                 "half); the others none",
     .receivers =
         "without a bias (second depth; of adaptive 0.8 mm) a column at each crease, 4.4 %: the texel's; with 2 "
         "texels (mixed, auto) none",
     .advice = "Open meshes that bend towards the light need a bias, which `auto` has.",
     .build = build_valley,
     .by_hand = valley_by_hand,
     .check = check_valley,
     .picture = COLUMN_SECOND_VIRTUAL + 1,
     /* One column of a texel's three is behind its centre, one on it: a tie, which in 32 bits goes either way. */
     .methods = {[COLUMN_SECOND] = SHADOW(30, 50)}},
};

const hard_list geometry_cases = {cases, COUNT(cases)};
