/* Light that grazes a floor, and triangles that light or camera see edge-on.
 *
 * Seen from above: 48 pixels a metre, 10/3 m x 5/2 m = 8.33 m^2. A texel is t = 1/16 m; v = 0, the floor's x = 0, is a
 * border of texels. On the floor a row of texels is t / sin e long, and a point is deeper than its texel's centre by up
 * to 0.5 t cot e. What is more than the bias deeper is shadowed. The block keeps |z| < 0.5, a border of texels too, in
 * shadow; 1.5 m of the picture's 2.5 m stay lit. */
#include "hard.h"

#include <math.h>

static const double pi = 3.14159265358979323846;

/* ---- grazing light --------------------------------------------------------------------------------------------- */

static void build_grazing(builder *b, double degrees, int open)
{
    if (open) {
        build_sheet(b, 200, 200, 190);
        build_level(b, -1.95, 1.95, 0, -1.4, 1.4);
    } else {
        build_floor(b, 1.95, 1.4);
    }
    build_solid(b, 170, 120, 70);
    build_box(b, -1.4, -1.1, 0, 0.4, -0.5, 0.5);
    build_view_from_above(b, degrees);
}

/* midpoint_of_the_top: the block's top ends D behind a texel's centre. Light that meets the centre leaves through the
 * block's back side, D / cos e deeper, so that the middle is D / (2 cos e) deep: points of the top from D / (2 cos^2 e)
 * behind the centre on are dark, up to the edge or the end of the texel, half a row of t / sin e, whichever is less. A
 * column of pixels is 1/48 m x 1 m, 0.25 %; one more or less is allowed, as borders of texels may fall either way.
 *
 * A block 0.4 high has a shadow 0.4 cot e long. */
static int grazing_by_hand(const double p[3], double degrees)
{
    if (p[1] > 0.3)
        return BY_HAND_LIT;
    return lit_unless(in(p[0], -1.4, -1.1 + 0.4 / tan(degrees * pi / 180)) && fabs(p[2]) < 0.5);
}

#define SOLID_AND_BY_HAND(name, degrees)                                                                               \
    static void build_solid_##name(builder *b)                                                                         \
    {                                                                                                                  \
        build_grazing(b, degrees, 0);                                                                                  \
    }                                                                                                                  \
    static int name##_by_hand(const double p[3])                                                                       \
    {                                                                                                                  \
        return grazing_by_hand(p, degrees);                                                                            \
    }

#define SHEET(name, degrees)                                                                                           \
    static void build_sheet_##name(builder *b)                                                                         \
    {                                                                                                                  \
        build_grazing(b, degrees, 1);                                                                                  \
    }

SOLID_AND_BY_HAND(at_20, 20)
SOLID_AND_BY_HAND(at_10, 10)
SOLID_AND_BY_HAND(at_5, 5)
SOLID_AND_BY_HAND(at_2, 2)
SOLID_AND_BY_HAND(at_1, 1)
SOLID_AND_BY_HAND(at_tenth, 0.1)
SOLID_AND_BY_HAND(at_hundredth, 0.01)
SHEET(at_20, 20)
SHEET(at_5, 5)
SHEET(at_2, 2)
SHEET(at_hundredth, 0.01)

/* ---- edge-on triangles ----------------------------------------------------------------------------------------- */

static void build_noon_from(builder *b, double x)
{
    const double eye[3] = {x, 3, 3}, target[3] = {0, 0, 0};
    build_camera_orthographic(b, eye, target, 1.25);
    build_noon(b);
}

static void add_wall(builder *b, double lean)
{
    const double corners[4][3] = {{0.3, 0, 0.6}, {0.3, 0, -0.6}, {0.3 + lean, 0.8, -0.6}, {0.3 + lean, 0.8, 0.6}};
    build_sheet(b, 120, 150, 120);
    build_quad(b, corners);
    build_solid(b, 170, 120, 70);
    build_box(b, -0.9, -0.4, 0.4, 0.5, -0.5, 0.5);
}

static void build_edge_on(builder *b)
{
    build_floor(b, 1.95, 1.95);
    add_wall(b, 0);
    build_noon_from(b, 3);
}

/* 0.2 mm in 0.8 m: the wall's left side looks up to the sun by 0.014 degree. */
static void build_almost_edge_on(builder *b)
{
    build_floor(b, 1.95, 1.95);
    add_wall(b, 0.8 / 4096);
    build_noon_from(b, -3);
}

/* The plate's shadow lies below it; its upright sides look into the sun's direction exactly, and so may the wall. */
static int edge_on_by_hand(const double p[3])
{
    if (p[1] > 0.499 && p[0] < 0)
        return BY_HAND_LIT;
    return fabs(p[1]) > 0.001 ? BY_HAND_UNSAID : lit_unless(in(p[0], -0.9, -0.4) && fabs(p[2]) < 0.5);
}

/* A wall without thickness, e = 45, seen exactly edge-on. The floor d behind it is d root 2 along the light behind the
 * wall: a bias of 2 t lights it up to d = 2 t / root 2 = 0.088 m, over 1.2 m: 0.106 m^2, 1.27 %, of which the row of
 * texels on the wall's foot is the texel's. */
static void build_edge_on_camera(builder *b)
{
    const double corners[4][3] = {{0.2, 0, 0.6}, {0.2, 0, -0.6}, {0.2, 0.6, -0.6}, {0.2, 0.6, 0.6}};
    build_floor(b, 1.95, 1.95);
    build_sheet(b, 120, 150, 120);
    build_quad(b, corners);
    build_view_from_above(b, 45);
}

static int edge_on_camera_by_hand(const double p[3])
{
    return lit_unless(in(p[0], 0.2, 0.8) && fabs(p[2]) < 0.6);
}

/* Invariant 5: no plane shadows itself, with the nearest depth, no bias at all and virtual samples at every pixel. */
static void check_no_bias(hard_row *row)
{
    outcome kept = row->outcomes[COLUMN_ADAPTIVE], now;
    gn_settings s = method_settings(&row->packed, COLUMN_ADAPTIVE, 0);
    s.bias.value = 0;
    s.receiver = &gn_virtual_always;
    row->outcomes[COLUMN_ADAPTIVE] = (outcome){0};
    row_measure(row, COLUMN_ADAPTIVE, &s);
    now = row->outcomes[COLUMN_ADAPTIVE];
    if (!promise(row, now.ran && now.own_shadow == 0, 0, "%s_nearest_depth_without_a_bias_shadows_nothing_of_its_own",
                 row->about->name))
        say("%llu pixels", (unsigned long long)now.own_shadow);
    row_forget(&row->outcomes[COLUMN_ADAPTIVE]);
    row->outcomes[COLUMN_ADAPTIVE] = kept;
}

/* ---- the list -------------------------------------------------------------------------------------------------- */

#define GROUP "Grazing light, edge-on triangles"

static const hard_case cases[] = {
    {.name = "grazing_20_degrees",
     .group = GROUP,
     .flags = LONG,
     .title = "sun at 20 degrees, floor solid",
     .expected =
         "half a texel spans 1.37 texels: 2 texels suffice. Midpoint: the block's top near its back edge, 0.5 %",
     .advice = "As it should be.",
     .build = build_solid_at_20,
     .by_hand = at_20_by_hand,
     /* midpoint_of_the_top: D = 0.090 m, dark from 0.051 m to 0.090 m: 2 columns of pixels, 0.5 %. */
     .methods = {[COLUMN_MIDPOINT] = SHADOW(0.2, 0.8)}},
    {.name = "grazing_10_degrees",
     .group = GROUP,
     .flags = LONG | WITH_RECEIVERS,
     .title = "10 degrees",
     .expected =
         "constant, dual: acne where 2.84 texels are spanned, 10.6 %; midpoint 0.5 %; second depth, mixed, auto none",
     .receivers = "second, mixed + virtual: light behind the block's foot, up to the end of the foot's texel, 0.25 % "
                  "at most; the others none",
     .advice = "c texels serve down to atan(1 / 2c) above the surface: 2 texels 14 degrees, 8 texels 3.6. Virtual "
               "samples serve down to 0.",
     .build = build_solid_at_10,
     .by_hand = at_10_by_hand,
     /* Rows of 0.36 m, the last 0.053 m of each, 2 or 3 columns: 9 rows over 1.5 m, and one each before, behind and on
      * the block; column by column 10.6 %, two columns of 0.375 % more or less. Midpoint: D = 0.269 m, half a row 0.18
      * m, dark from 0.139 m to 0.18 m: 2 columns. tie_at_a_foot: a block's bottom is its second depth and lies in the
      * floor's plane. Where a texel's centre is in the foot, the floor's virtual sample ties with it, and what the
      * texel holds beyond the foot is lit. Here the foot ends 0.0037 m of v before the end of its texel: 0.021 m x 1 m,
      * 0.25 %. */
     .methods = {[COLUMN_CONSTANT] = SHADOW(9.9, 11.4),
                 [COLUMN_MIDPOINT] = SHADOW(0.2, 0.8),
                 [COLUMN_DUAL] = SHADOW(9.9, 11.4),
                 [COLUMN_AUTO] = LIGHT(0, 0.25),
                 [COLUMN_SECOND_VIRTUAL] = LIGHT(0, 0.25),
                 [COLUMN_MIXED_VIRTUAL] = LIGHT(0, 0.25)}},
    {.name = "grazing_5_degrees",
     .group = GROUP,
     .flags = WITH_RECEIVERS,
     .title = "5 degrees",
     .expected = "constant, dual: 25 %; midpoint 1.5 %; second depth, mixed, auto none",
     .receivers = "plane bias: 6 cm of the shadow's foot, 0.7 %; the others none",
     .advice = "As above.",
     .build = build_solid_at_5,
     .by_hand = at_5_by_hand,
     .picture = COLUMN_DUAL + 1,
     /* Rows of 0.717 m, the last 0.233 m of each: 5 over 1.5 m, one before the block, 0.12 m of its top: 2.1 m^2;
      * column by column 25.25 %, two columns more or less. Midpoint: D = 0.245 m, dark from 0.123 m on: 6 columns of 1
      * m, 1.5 %. Plane bias: half a texel of the floor is 5.7 t = 0.357 m, and 4 mm: what is less than that behind the
      * block's front at -1.4 is lit, from its back at -1.1 on: 0.06 m x 1 m, two or three columns. */
     .methods = {[COLUMN_CONSTANT] = SHADOW(24.4, 26.1),
                 [COLUMN_MIDPOINT] = SHADOW(1.2, 1.8),
                 [COLUMN_DUAL] = SHADOW(24.4, 26.1),
                 [COLUMN_PLANE_BIAS] = LIGHT(0.4, 0.8)}},
    {.name = "grazing_2_degrees",
     .group = GROUP,
     .flags = WITH_RECEIVERS,
     .title = "2 degrees",
     .expected = "constant, dual: all that is 2 texels behind one of two centres, 27.6 %; midpoint: what is nearer to "
                 "the slab's "
                 "end than to a centre, 6 %; second depth, mixed, auto none",
     .receivers = "slope: the block's top, whose texels have their centres on its front, 3.6 %; plane bias: 60 cm of "
                  "the shadow's foot, 7.1 %; the others none",
     .advice = "As above.",
     .build = build_solid_at_2,
     .by_hand = at_2_by_hand,
     /* Centres at x = -0.895 and 0.895. Constant: dark from -0.77 to 0 and 1.02 to 1.67 over 1.5 m, and 0.175 m of the
      * block's top, whose centre stands on its front: 2.3 m^2. Midpoint, the slab ends at 1.95: dark from 1.42 on, 0.37
      * m^2, and half of the block's top, 0.15 m^2: column by column 6.25 %. Slope: the front has next to none, the top
      * is 4 mm deeper at once: 0.3 m x 1 m, 3.6 %. Plane bias: half a texel is 0.895 m: -1.1 to -0.5, 7.1 %. */
     .methods = {[COLUMN_CONSTANT] = SHADOW(26.7, 28.3),
                 [COLUMN_MIDPOINT] = SHADOW(5.8, 6.7),
                 [COLUMN_DUAL] = SHADOW(26.7, 28.3),
                 [COLUMN_SLOPE] = SHADOW(3.2, 3.7),
                 [COLUMN_PLANE_BIAS] = LIGHT(6.6, 7.5)}},
    {.name = "grazing_1_degree",
     .group = GROUP,
     .flags = LONG | WITH_RECEIVERS,
     .title = "1 degree",
     .expected = "one row of texels for x < 0, its centre before all that is seen: constant, dual dark, 33 %; the "
                 "block's shadow there "
                 "is lit by the others, 13 %: the texel's",
     .receivers = "plane bias: 39 cm of the shadow beyond x = 0, 11 of them within 1/32 texel of the border, 3.4 %; "
                  "the others none",
     .advice =
         "What is lower than a texel per length of the floor no map resolves: `volumes`, or a light box around what "
         "matters.",
     .worse = 2.5, /* a cell is as long as all that is seen: of two corners half of 3 rows of 160 pixels each */
     .build = build_solid_at_1,
     .by_hand = at_1_by_hand,
     /* A row is 3.58 m long: its centre, x = -1.79, lies before all that is seen; constant, dual as at 0.1 degree.
      * Plane bias, 1.79 m: the row x > 0 holds the block's front at -1.4, so that 0 to 0.394 is lit, 1 m wide; up to
      * 0.112 m is within 1/32 texel of the row before: 0.282 m, 3.4 %. */
     .methods =
         {[COLUMN_CONSTANT] = SHADOW(30, 35), [COLUMN_DUAL] = SHADOW(30, 35), [COLUMN_PLANE_BIAS] = LIGHT(3.1, 3.7)}},
    {.name = "grazing_tenth",
     .group = GROUP,
     .flags = LONG,
     .title = "0.1 degree",
     .expected =
         "the row x < 0 holds the slab's side: constant, dual dark, 33 %. Second depth: the block's shadow, x < 0, is "
         "lit, 13 %: the texel's",
     .advice = "As above.",
     .worse = 2.5, /* as at 1 degree */
     .build = build_solid_at_tenth,
     .by_hand = at_tenth_by_hand,
     /* Dark from 2 t behind the slab's front, outside of what is seen, to 0, where lit: 2.5 m^2 beside the block and
      * 0.27 m^2 before it. The row x > 0 has its centre above the floor. */
     .methods = {[COLUMN_CONSTANT] = SHADOW(30, 35), [COLUMN_DUAL] = SHADOW(30, 35)}},
    {.name = "grazing_hundredth",
     .group = GROUP,
     .title = "0.01 degree",
     .expected =
         "the same; auto lights all of the shadow, 33 %: a plane steeper than the formats hold is never shadowed "
         "by a virtual sample",
     .advice = "As above.",
     .build = build_solid_at_hundredth,
     .by_hand = at_hundredth_by_hand,
     .picture = COLUMN_SECOND + 1,
     .methods = {[COLUMN_CONSTANT] = SHADOW(30, 35), [COLUMN_DUAL] = SHADOW(30, 35)}},
    {.name = "sheet_20_degrees",
     .group = GROUP,
     .flags = LONG | WITH_RECEIVERS,
     .title = "20 degrees, floor an open sheet",
     .expected = "second depth: half of the lit floor is dark, 42 %; midpoint 0.5 %; the others none",
     .receivers = "none errs",
     .advice = "Second depth is not for open meshes; `auto` takes mixed.",
     .build = build_sheet_at_20,
     .check = check_no_bias,
     .by_hand = at_20_by_hand,
     .picture = COLUMN_SECOND + 1,
     /* Midpoint: the block's top, as on the solid. */
     .methods = {[COLUMN_MIDPOINT] = SHADOW(0.2, 0.8), [COLUMN_SECOND] = SHADOW(38, 45)}},
    {.name = "sheet_5_degrees",
     .group = GROUP,
     .flags = WITH_RECEIVERS,
     .title = "5 degrees, sheet",
     .expected = "constant, dual, mixed with 2 texels: a quarter; second depth a third; midpoint 1.5 %; auto none",
     .receivers = "as on the solid",
     .advice = "Virtual samples take no bias for a plane, however flat the light.",
     .build = build_sheet_at_5,
     .check = check_no_bias,
     .by_hand = at_5_by_hand,
     .picture = COLUMN_MIXED + 1,
     /* As on the solid; for mixed without the block's top, 0.12 m^2. Second depth: half of 5.26 m^2. */
     .methods = {[COLUMN_CONSTANT] = SHADOW(24.4, 26.1),
                 [COLUMN_MIDPOINT] = SHADOW(1.2, 1.8),
                 [COLUMN_DUAL] = SHADOW(24.4, 26.1),
                 [COLUMN_SECOND] = SHADOW(28, 35),
                 [COLUMN_MIXED] = SHADOW(22, 26),
                 [COLUMN_PLANE_BIAS] = LIGHT(0.4, 0.8)}},
    {.name = "sheet_2_degrees",
     .group = GROUP,
     .flags = LONG | WITH_RECEIVERS,
     .title = "2 degrees, sheet",
     .expected = "constant, dual 27.6 %, mixed 25.5 %, second depth 30 %; midpoint 1.75 %; auto none",
     .receivers = "as on the solid",
     .advice = "As above.",
     .build = build_sheet_at_2,
     .check = check_no_bias,
     .by_hand = at_2_by_hand,
     /* Midpoint: half of the block's top, 7 columns of 1 m: 1.75 %. The others as on the solid. */
     .methods = {[COLUMN_CONSTANT] = SHADOW(26.7, 28.3),
                 [COLUMN_MIDPOINT] = SHADOW(1.4, 2.1),
                 [COLUMN_DUAL] = SHADOW(26.7, 28.3),
                 [COLUMN_SECOND] = SHADOW(28, 32),
                 [COLUMN_MIXED] = SHADOW(24, 27),
                 [COLUMN_SLOPE] = SHADOW(3.2, 3.7),
                 [COLUMN_PLANE_BIAS] = LIGHT(6.6, 7.5)}},
    {.name = "sheet_hundredth",
     .group = GROUP,
     .title = "0.01 degree, sheet",
     .expected = "no row of texels meets the sheet: all is lit, also the shadow for x < 0, 13 %: the texel's; auto "
                 "as on the solid",
     .advice = "As for solids.",
     .build = build_sheet_at_hundredth,
     .by_hand = at_hundredth_by_hand},
    {.name = "edge_on",
     .group = GROUP,
     .title = "wall exactly along the light",
     .expected = "no shadow but the plate's, none of the methods errs",
     .advice = "As it should be: shadowed, as N.L = 0.",
     .build = build_edge_on,
     .by_hand = edge_on_by_hand,
     .picture = COLUMN_AUTO + 1},
    {.name = "almost_edge_on",
     .group = GROUP,
     .title = "wall 0.014 degree from that, lit side",
     .expected = "the wall is lit: it lies between two columns of centres",
     .advice = "As it should be.",
     .build = build_almost_edge_on,
     .by_hand = edge_on_by_hand},
    {.name = "edge_on_camera",
     .group = GROUP,
     .title = "wall of no thickness, seen edge-on by the camera",
     .expected = "no pixel of the wall, but its shadow; constant: 2 texels of the shadow's foot are lit, 1.3 %",
     .advice = "A bias takes its own length from the foot of every shadow of a sheet.",
     .build = build_edge_on_camera,
     .by_hand = edge_on_camera_by_hand,
     .methods = {[COLUMN_CONSTANT] = LIGHT(0.5, 1.4)}},
};

const hard_list light_cases = {cases, COUNT(cases)};
