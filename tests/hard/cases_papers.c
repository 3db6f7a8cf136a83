/* The hard cases of the two papers that the methods come from.
 *
 * Wang & Molnar, Second-Depth Shadow Mapping, UNC TR94-019, 1994 (W&M); Weiskopf & Ertl, Shadow Mapping Based on Dual
 * Depth Layers, Eurographics 2003 (W&E). Lengths in metres. t is the side of a texel, on the map; e the height of the
 * sun above the horizon. build_low_sun puts the light's axes so that a point of the floor y = 0 has v = x sin e and
 * depth z = x cos e: a texel's height t on the map is a depth of t cot e on the floor. The camera above has 48 pixels a
 * metre and sees 10/3 m x 5/2 m = 8.33 m^2; a texel of 1/16 m is 3 pixels.
 */
#include "hard.h"

#include <math.h>

static const double root_3 = 1.7320508075688772;

static gn_bias texels(double count)
{
    return (gn_bias){GN_BIAS_TEXELS, (uint32_t)lround(65536 * count)};
}

/* ---- W&M, figure 4: a table, its legs on the floor --------------------------------------------------------------- */

/* Map 128: t = 1/32, legs 2 t thick. */
static void build_table(builder *b, double bias)
{
    build_floor(b, 1.8, 1.4);
    build_solid(b, 170, 120, 70);
    build_box(b, -1, -0.2, 0.7, 0.8, -0.6, 0.6);
    for (int i = 0; i < 4; i++) {
        double x = i & 1 ? -0.2625 : -1, z = i & 1 ? 0.5375 : 0.35; /* no leg stands in another's shadow */
        z = i & 2 ? z : -z - 0.0625;
        build_box(b, x, x + 0.0625, 0, 0.7, z, z + 0.0625);
    }
    build_view_from_above(b, 30);
    b->map_width = b->map_height = 128;
    b->bias = texels(bias);
}

/* cot 30 = root 3 shifts the shadow of height y by y root 3: the top, 0.7 to 0.8 high, covers x from -1 + 0.7 root 3 to
 * -0.2 + 0.8 root 3; a leg, 0 to 0.7 high, x from its front to its back + 0.7 root 3. */
static int table_by_hand(const double p[3])
{
    if (p[1] > 0.01)
        return p[1] > 0.79 ? BY_HAND_LIT : BY_HAND_UNSAID;
    int top = in(p[0], -1 + 0.7 * root_3, -0.2 + 0.8 * root_3) && fabs(p[2]) < 0.6;
    int back_legs = in(p[0], -0.2625, -0.2 + 0.7 * root_3) && in(fabs(p[2]), 0.5375, 0.6);
    int front_legs = in(p[0], -1, -0.9375 + 0.7 * root_3) && in(fabs(p[2]), 0.35, 0.4125);
    return lit_unless(top || back_legs || front_legs);
}

/* Midpoint: the table's top ends 0.47 rows behind a texel's centre, D = 0.94 t; dark from 0.67 D (cases_light.c) on, x
 * from -0.2098 to -0.2: no column of pixels has its centre there (-0.2187, -0.1979).
 *
 * 1/4 t is less than what half a texel spans, 0.5 t cot 30 = 0.87 t: a point more than 0.25 / root 3 = 0.144 t behind
 * its texel's centre is shadowed. Pixels stand t/3 apart on the map, so 1 in 3 is; all surfaces seen are level, and 82
 * to 88 % of the image is lit: 27 to 30 % of it. */
static void build_table_acne(builder *b)
{
    build_table(b, 0.25);
}

/* A point d behind a leg is (d + 2 t) / cos e along the light behind the leg's front, and lit while that is less than
 * the bias: d < 8 t cos 30 - 2 t = 4.93 t = 0.154 m, over a leg's width of 2 t = 0.0625 m, behind the two legs whose
 * backs can be seen: 0.0193 m^2 of 8.33 m^2, 0.23 %. */
static void build_table_detached(builder *b)
{
    build_table(b, 8);
}

/* A ramp that falls 22 degrees away from a sun 30 degrees high: 8 degrees to the light, so that half a texel spans
 * 0.5 cot 8 = 3.56 t. Legs lose their shadows from 2 t / cos 30 = 2.31 t on. */
static void build_table_and_ramp(builder *b)
{
    build_table(b, 2);
    const double outline[3][2] = {{-1.6, 0}, {-0.8, 0}, {-1.6, 0.8 * 0.40402622583}};
    build_solid(b, 120, 150, 120);
    build_prism(b, outline, 3, 0.7, 1.2);
}

static int ramp_by_hand(const double p[3])
{
    /* the ramp's shadow: its ridge at x = -1.6, 0.323 high, reaches x = -1.04, within the ramp's own foot */
    return p[1] > 0.001 && p[0] < -0.7 ? BY_HAND_UNSAID : table_by_hand(p);
}

/* Below 3.56 t the ramp shows acne, above 2.31 t a leg has lost the foot of its shadow: every bias is wrong somewhere.
 */
static void check_no_bias_suits(hard_row *row)
{
    double least = 100, at = 0;
    for (double bias = 0.125; bias < 40; bias *= sqrt(2)) {
        gn_settings s = method_settings(&row->packed, COLUMN_CONSTANT, 0);
        outcome kept = row->outcomes[COLUMN_CONSTANT];
        row->outcomes[COLUMN_CONSTANT] = (outcome){0};
        s.bias = texels(bias);
        row_measure(row, COLUMN_CONSTANT, &s);
        const outcome *o = &row->outcomes[COLUMN_CONSTANT];
        double own = percent_of(row, o->own_shadow + o->own_light);
        promise(row, own > 0, 0, "%s_bias_of_%.3g_texels_errs", row->about->name, bias);
        if (own < least)
            least = own, at = bias;
        row_forget(&row->outcomes[COLUMN_CONSTANT]);
        row->outcomes[COLUMN_CONSTANT] = kept;
    }
    row_remark(row, "Best of 1/8 to 32 texels: %.2g texels, %.2f %% of its own.", at, least);
}

/* ---- W&M, figure 7: a solid thinner than what a texel spans ------------------------------------------------------ */

static const double thin = 0.1 / 16; /* t / 10 */

static void build_thin_slab(builder *b)
{
    build_floor(b, 1.8, 1.4);
    build_solid(b, 170, 120, 70);
    build_box(b, -1.2, -0.2, 0.5, 0.5 + thin, -0.7, 0.7);
    build_view_from_above(b, 30);
}

static int thin_slab_by_hand(const double p[3])
{
    if (p[1] > 0.4)
        return BY_HAND_LIT;
    return lit_unless(in(p[0], -1.2 + 0.5 * root_3, -0.2 + (0.5 + thin) * root_3) && fabs(p[2]) < 0.7);
}

/* ---- W&E, figure 2 ----------------------------------------------------------------------------------------------- */

/* (a) A slope of 8:1 falls to the left, under a plate whose edge, x = 0.03, lies just left of the centre of a texel
 * (0 to 1/16, centre 1/32). The sun stands overhead. */
static void build_unshadowing(builder *b)
{
    const double slope[4][2] = {{-0.1, -0.8}, {0.5, -0.8}, {0.5, 0.8}, {0.1, 0.8}};
    const double plate[4][2] = {{-0.6, 1}, {0.03, 1}, {0.03, 1.1}, {-0.55, 1.1}};
    const double eye[3] = {-4, 0, 0}, target[3] = {0, 0, 0};
    build_solid(b, 200, 200, 190);
    build_prism(b, slope, 4, -1, 1);
    build_solid(b, 170, 120, 70);
    build_prism(b, plate, 4, -1.2, 1.2);
    build_camera_orthographic(b, eye, target, 1.25);
    build_noon(b);
}

static int unshadowing_by_hand(const double p[3])
{
    return p[1] > 0.9 ? BY_HAND_LIT : lit_unless(p[1] < 8 * 0.03);
}

/* The texel's centre is lit, at a height of 8/32 = 0.25. Where the bias exceeds 0.25, all that the texel holds is lit,
 * down to x = 0: 0.24 m of the slope in height, 2 m wide. With 2 t = 0.125 only what is less than that below 0.25: 0.24
 * - 0.125 = 0.115 m. 48 pixels a metre; a row of 96 pixels more or less for the rounding of heights to pixels. */
static void check_unshadowing(hard_row *row)
{
    static const double heights[COLUMN_COUNT] = {0.115, 0.24, 0.115, 0.24, 0.24, 0.24, 0};
    for (int method = 0; method < COLUMN_VOLUMES; method++) {
        double expected = heights[method] * 2 * 48 * 48;
        if (!promise(row, fabs((double)row->outcomes[method].false_light - expected) <= 97, 0,
                     "%s_%s_unshadows_%.3f_m_of_the_slope", row->about->name, method_names[method], heights[method]))
            say("%.0f pixels expected, got %llu", expected, (unsigned long long)row->outcomes[method].false_light);
    }
}

/* (b) A wedge whose front falls 45 degrees towards a sharp edge at x = 0.625, a border of texels; its back falls 3 in
 * 4, so that the thickness grows by 1/4 of the distance d from the edge. Sun overhead; the camera looks straight at the
 * front, 48 pixels a metre. Heights above the edge: a point d, its texel's centre at d': d'(1 - 1/8) for the midpoint,
 * 3/4 d' for the second depth. A point is shadowed where d is less than that:
 *
 *     d' = 0.5 t, 1.5 t, 2.5 t, 3.5 t: midpoint 0.4375 + 0.3125 + 0.1875 + 0.0625 = 1 t; second depth 0.375 + 0.125 =
 * 0.5 t
 *
 * of the front, 1.6 m wide and foreshortened by nothing (root 2 x d): 0.141 and 0.071 m^2 of 8.33: 1.70 and 0.85 %. */
static void build_silhouette(builder *b)
{
    const double wedge[3][2] = {{0.625, 0.4}, {-0.575, 1.6}, {-0.575, 1.3}};
    const double eye[3] = {3, 3, 0}, target[3] = {0, 0, 0};
    build_floor(b, 1.95, 1.95);
    build_solid(b, 170, 120, 70);
    build_prism(b, wedge, 3, -0.8, 0.8);
    build_camera_orthographic(b, eye, target, 1.25);
    build_noon(b);
}

static int silhouette_by_hand(const double p[3])
{
    return p[1] > 0.01 ? BY_HAND_LIT : lit_unless(in(p[0], -0.575, 0.625) && fabs(p[2]) < 0.8);
}

/* ---- W&E, figure 3: a receiver nearer to its occluder than the bias ---------------------------------------------- */

/* A plate 2 t thick, 2 t above the floor; e = 60. Its front is 4 t / sin 60 = 4.6 t before the floor along the light.
 * The shadow can be seen for 4 t cot 60 = 0.144 m behind it, over 1.6 m: 0.231 m^2, 2.8 %, of which half a texel all
 * round may be the texel's: (0.144 - 0.036)(1.6 - 0.063) = 0.166 m^2, 2.0 %. */
static void build_near_receiver(builder *b)
{
    build_floor(b, 1.8, 1.4);
    build_solid(b, 170, 120, 70);
    build_box(b, -0.8, 0.4, 2.0 / 16, 4.0 / 16, -0.8, 0.8);
    build_view_from_above(b, 60);
    b->bias = texels(8);
}

static int near_receiver_by_hand(const double p[3])
{
    if (p[1] > 0.2)
        return BY_HAND_LIT;
    return lit_unless(in(p[0], -0.8 + 0.125 / root_3, 0.4 + 0.25 / root_3) && fabs(p[2]) < 0.8);
}

/* ---- W&E, figure 4: the midpoint without back faces -------------------------------------------------------------- */

/* (a) Map 16: t = 1/4. The block's top, y = 1.1, ends at x = -0.37, just right of the centre of the texel from -0.5 to
 * -0.25. That centre sees the plate, y = 1.7, and then the floor: their middle, 0.85, is below the block's top, which
 * is lit from -0.37 to -0.25, over 1 m (four texels). Seen from 45 degrees: 0.12 x 0.707 m^2 = 195 pixels, 1.0 % of
 * 19200. With bias 2 t = 0.5 the limit is 1.7 - 0.5 = 1.2, above the block. Sides lean inwards, so that none is edge-on
 * to the sun. */
static void build_background(builder *b)
{
    const double block[4][2] = {{-0.3, 0.9}, {0.4, 0.9}, {0.4, 1.1}, {-0.37, 1.1}};
    const double plate[4][2] = {{-0.65, 1.6}, {0.1, 1.6}, {0.1, 1.7}, {-0.7, 1.7}};
    const double eye[3] = {-4, 4, 0}, target[3] = {0, 0, 0};
    build_floor(b, 1.95, 1.95);
    build_solid(b, 120, 150, 120);
    build_prism(b, block, 4, -0.5, 0.5);
    build_solid(b, 170, 120, 70);
    build_prism(b, plate, 4, -1, 1);
    build_camera_orthographic(b, eye, target, 1.25);
    build_noon(b);
    b->map_width = b->map_height = 16;
}

static int background_by_hand(const double p[3])
{
    if (p[1] > 1.699)
        return BY_HAND_LIT;
    if (in(p[1], 1.099, 1.101))
        return lit_unless(p[0] < 0.1);
    if (p[1] > 0.001)
        return BY_HAND_SHADOWED; /* the sides lean inwards */
    return lit_unless((in(p[0], -0.7, 0.1) && fabs(p[2]) < 1) || (in(p[0], -0.37, 0.4) && fabs(p[2]) < 0.5));
}

/* (b) A face of slope 16:1, y = 16 (x - 0.02), under a plate at 0.85 to 0.87, 1.5 m of its 2.4 m. The texel from 0 to
 * 1/16 holds the face from -0.32 to 0.68, its centre stands at 0.18: the middle to the plate, (0.87 + 0.18) / 2 =
 * 0.525, is below 0.525 to 0.68, which is lit: 0.155 m. The next texel's centre sees the solid's top at 0.84: nothing
 * of it is lit. The texel before has its middle at (0.87 - 0.82) / 2 = 0.025, above all it holds. Of 2.09 m x 2.4 m
 * = 5.02 m^2 seen, 4.6 %; within 1/32 texel of the border, 0.031 m, nobody can say which texel it is: 3.7 %.
 *
 * Constant bias 2 t = 0.125: above 0.87 - 0.125 all is lit, 0.745 to 0.84, where the texel's centre, beyond the top, is
 * above the plate: 0.095 m, the texel's error. Dual bounds that by half the gap to the solid's top. Where the face is
 * lit (0.9 m) both show acne, as 2 t are less than 8 t: what is 0.125 below a texel's centre, 0.375 m of each metre and
 * 0.68 m of all that is seen: 0.61 m^2, 12 %. */
static void build_steep_receiver(builder *b)
{
    const double face[4][2] = {{-0.0675, -1.4}, {0.5, -1.4}, {0.5, 0.84}, {0.0725, 0.84}};
    const double plate[4][2] = {{-0.6, 0.85}, {0.3, 0.85}, {0.3, 0.87}, {-0.59, 0.87}};
    const double eye[3] = {-4, 0, 0}, target[3] = {0, 0, 0};
    build_solid(b, 200, 200, 190);
    build_prism(b, face, 4, -1.2, 1.2);
    build_solid(b, 170, 120, 70);
    build_prism(b, plate, 4, -0.75, 0.75);
    build_camera_orthographic(b, eye, target, 1.25);
    build_noon(b);
}

static int steep_receiver_by_hand(const double p[3])
{
    return p[0] < -0.1 ? BY_HAND_LIT : lit_unless(fabs(p[2]) < 0.75);
}

/* ---- W&E, figure 5: an L over a plane, map far too small --------------------------------------------------------- */

/* Map 32: t = 1/8. The upright leans 20 degrees over the base, so that the base is in shadow near the crease; the front
 * leans back by 25 degrees: it is lit, and falls steeply to its lower edge. */
static void build_l_shape(builder *b)
{
    const double outline[6][2] = {{0.3, 0.3}, {0.3, 1.2}, {0, 1.2}, {0, 0}, {1.2, 0}, {1.2, 0.3}};
    const double eye[3] = {3, 3, 4}, target[3] = {0, 0.8, 0};
    build_solid(b, 120, 170, 130);
    build_box(b, -1.95, 1.95, -0.5, 0, -1.95, 1.95);
    build_solid(b, 180, 140, 90);
    build_prism(b, outline, 6, -0.4, 0.4);
    build_turn(b, 0, 2, -20, 0, 0, 0);
    build_turn(b, 0, 0, -25, 0, 0, 0);
    for (size_t i = 0; i < build_vertex_count(b); i++)
        b->meshes[b->mesh_count - 1].vertices[i][0] -= 0.5, b->meshes[b->mesh_count - 1].vertices[i][1] += 1.4;
    build_camera_orthographic(b, eye, target, 1.25);
    build_noon(b);
    b->map_width = b->map_height = 32;
    b->bias = texels(4);
}

/* What the paper says of its pictures. */
static void check_l_shape(hard_row *row)
{
    outcome plain[2];
    static const int methods[2] = {COLUMN_MIDPOINT, COLUMN_DUAL};
    for (int i = 0; i < 2; i++) {
        outcome culled = row->outcomes[methods[i]];
        row->outcomes[methods[i]] = (outcome){0};
        gn_settings s = method_settings(&row->packed, methods[i], CULL_NONE);
        row_measure(row, methods[i], &s);
        plain[i] = row->outcomes[methods[i]];
        row_forget(&row->outcomes[methods[i]]);
        row->outcomes[methods[i]] = culled;
        promise(row, plain[i].own_shadow > 4 * culled.own_shadow, 0,
                "%s_%s_shadows_its_silhouettes_unless_back_faces_are_culled", row->about->name,
                method_names[methods[i]]);
    }
    promise(row, row->outcomes[COLUMN_MIDPOINT].own_light > 0, 0, "%s_midpoint_unshadows_when_back_faces_are_culled",
            row->about->name);
    promise(row, row->outcomes[COLUMN_CONSTANT].own_light > 4 * row->outcomes[COLUMN_DUAL].own_light, 0,
            "%s_constant_lights_the_crease", row->about->name);
    const outcome *o = row->outcomes;
    uint64_t dual = o[COLUMN_DUAL].own_shadow + o[COLUMN_DUAL].own_light;
    promise(row,
            dual <= o[COLUMN_CONSTANT].own_shadow + o[COLUMN_CONSTANT].own_light &&
                dual <= o[COLUMN_MIDPOINT].own_shadow + o[COLUMN_MIDPOINT].own_light,
            0, "%s_dual_without_back_faces_errs_least", row->about->name);
    row_remark(row, "Without culling: midpoint %.1f + %.1f, dual %.1f + %.1f.", plain[0].shadow_percent,
               plain[0].light_percent, plain[1].shadow_percent, plain[1].light_percent);
}

/* ---- the list -------------------------------------------------------------------------------------------------- */

#define GROUP "The papers' figures"

static const hard_case cases[] = {
    {.name = "table_acne",
     .group = GROUP,
     .flags = LONG | WITH_RECEIVERS,
     .source = "W&M fig. 4",
     .title = "table on a floor, bias 1/4 texel",
     .expected = "constant, dual: acne on a third of what is lit; the others none",
     .receivers = "adaptive: a strip before the foot of shadows, 0.6 % at most; the others none",
     .advice = "A constant bias must exceed half a texel's slope: 0.5 cot e texels for light e above the surface.",
     .build = build_table_acne,
     .by_hand = table_by_hand,
     .picture = COLUMN_CONSTANT + 1,
     /* half_texel_before_a_shadow: adaptive holds the nearest depth. A lit point of the floor behind its texel's centre
      * is behind what that holds; where the next row is shadowed it is behind that, too, and all four texels vote for
      * shadow. At most half a row, t / 2 sin e, along the front edges of shadows: 1.2 m of the top and 0.25 m of legs,
      * 0.031 m: 0.55 %, a pixel's share more. */
     .methods =
         {[COLUMN_CONSTANT] = SHADOW(26, 31), [COLUMN_DUAL] = SHADOW(26, 31), [COLUMN_ADAPTIVE] = SHADOW(0.05, 0.65)}},
    {.name = "table_detached",
     .group = GROUP,
     .source = "W&M fig. 4",
     .title = "the same, bias 8 texels",
     .expected = "constant: the shadows leave the legs, 15 cm; the others none",
     .advice = "A constant bias lights what is nearer than it behind its occluder. Dual bounds it by half the gap.",
     .build = build_table_detached,
     .by_hand = table_by_hand,
     .picture = COLUMN_CONSTANT + 1,
     .methods = {[COLUMN_CONSTANT] = LIGHT(0.1, 0.35)}},
    {.name = "table_and_ramp",
     .group = GROUP,
     .source = "W&M, section 2",
     .title = "the same and a ramp 8 degrees to the light",
     .expected = "no constant bias is right: 2 texels leave acne on the ramp, 1.3 %; second depth needs none. "
                 "Midpoint: the ramp's "
                 "end, 0.7 % at most.",
     .receivers = "the same",
     .advice = "For scenes of solids: second depth, which `auto` takes.",
     .build = build_table_and_ramp,
     .by_hand = ramp_by_hand,
     .check = check_no_bias_suits,
     .flags = LONG | WITH_RECEIVERS,
     /* The ramp, 0.8 m x 0.5 m: a texel's half spans 3.56 t, of which 2 t are forgiven: (3.56 - 2) / 7.12 of it is
      * dark, 0.088 m^2, 1.05 %; a row of texels is t / sin 8 = 0.22 m long, so the ramp has 3 or 4 of them and the
      * figure is good to one: 0.26 % each, 1.3 % at most and the share of a pixel, 1.5 %. 2 t is less than the 2.31 t
      * at which a leg loses its shadow. Midpoint: the ramp is thin only where it ends; its last row at most, half of
      * it: 0.22 m x 0.5 m / 2, 0.7 %. */
     .methods = {[COLUMN_CONSTANT] = SHADOW(0.7, 1.5),
                 [COLUMN_MIDPOINT] = SHADOW(0, 0.7),
                 [COLUMN_DUAL] = SHADOW(0.7, 1.5),
                 [COLUMN_ADAPTIVE] = SHADOW(0.05, 0.65)}},
    {.name = "thin_slab",
     .group = GROUP,
     .flags = WITH_RECEIVERS,
     .source = "W&M fig. 7",
     .title = "slab 1/10 texel thick, sun at 30 degrees",
     .expected = "second depth, mixed and midpoint: a third to a half of its top shadows itself; auto none",
     .receivers = "none errs",
     .advice =
         "Second depth needs solids thicker than half a texel, 0.5 t cos e. Thin ones: `dual`, or mark them open and "
         "take `mixed`; or virtual samples, as `auto` has them.",
     .build = build_thin_slab,
     .by_hand = thin_slab_by_hand,
     .picture = COLUMN_SECOND + 1,
     /* A point d behind its texel's centre on the map is d cot 30 deeper, the back of the slab 2 x t / 10: shadowed
      * from d = 0.1155 t on, midpoint 0.0577 t; pixels are t / 6 apart: 2 or 3 of 6. The top is 1 m x 1.4 m, 16.8 %.
      * With virtual samples the top is compared at the centre, where its own depth is less than the slab's back. */
     .methods =
         {[COLUMN_MIDPOINT] = SHADOW(5, 8.5), [COLUMN_SECOND] = SHADOW(5, 8.5), [COLUMN_MIXED] = SHADOW(5, 8.5)}},
    {.name = "unshadowing",
     .group = GROUP,
     .source = "W&E fig. 2a",
     .title = "slope of 8:1 that falls under the edge of its occluder",
     .expected =
         "midpoint, second depth: 24 cm of the slope lit; constant, dual 2 texels: 11.5 cm. The texel's own error: its "
         "centre is lit",
     .advice = "The smaller bias errs less where the edge of a shadow falls on a slope.",
     .build = build_unshadowing,
     .by_hand = unshadowing_by_hand,
     .check = check_unshadowing,
     .picture = COLUMN_MIDPOINT + 1,
     .methods = {[COLUMN_CONSTANT] = SHADOW(5.5, 6.7), [COLUMN_DUAL] = SHADOW(5.5, 6.7)}},
    {.name = "silhouette",
     .group = GROUP,
     .flags = WITH_RECEIVERS,
     .source = "W&E fig. 2b",
     .title = "wedge that falls to a sharp silhouette",
     .expected = "midpoint: self-shadow, one texel in all (1.7 %); second depth, mixed: half of that; auto none",
     .receivers = "none errs",
     .advice = "Solids with sharp edges towards the light: virtual samples, or `dual`, which culls back faces.",
     .build = build_silhouette,
     .by_hand = silhouette_by_hand,
     .picture = COLUMN_MIDPOINT + 1,
     /* Virtual samples: at the centre the front is nearer than the back, however thin the wedge. */
     .methods =
         {[COLUMN_MIDPOINT] = SHADOW(1.4, 2), [COLUMN_SECOND] = SHADOW(0.7, 1), [COLUMN_MIXED] = SHADOW(0.7, 1)}},
    {.name = "near_receiver",
     .group = GROUP,
     .flags = LONG | WITH_RECEIVERS,
     .source = "W&E fig. 3",
     .title = "plate 4 texels over a floor, bias 8 texels",
     .expected = "constant: no shadow at all (2.0 to 2.8 %); the others none",
     .receivers = "none errs",
     .advice = "As for the table's legs: a bias larger than the gap takes the shadow away.",
     .build = build_near_receiver,
     .by_hand = near_receiver_by_hand,
     .picture = COLUMN_CONSTANT + 1,
     .methods = {[COLUMN_CONSTANT] = LIGHT(2, 2.8)}},
    {.name = "background",
     .group = GROUP,
     .source = "W&E fig. 4a",
     .title = "edge of a receiver far above the floor (midpoint without back faces)",
     .expected = "midpoint: a strip of 12 cm along the edge lit (1.0 %); the others none",
     .advice = "Midpoint with `--cull back` sees the background beyond an edge; `dual` is made for culling.",
     .build = build_background,
     .by_hand = background_by_hand,
     .flags = CULL_BACK,
     .picture = COLUMN_MIDPOINT + 1,
     .methods = {[COLUMN_MIDPOINT] = LIGHT(0.85, 1.2)}},
    {.name = "steep_receiver",
     .group = GROUP,
     .source = "W&E fig. 4b",
     .title = "receiver of slope 16:1 close below its occluder (midpoint without back faces)",
     .expected =
         "midpoint: 15.5 cm lit (4.6 %); second depth, mixed, auto none. Constant and dual: acne where lit (12 %)",
     .receivers = "second + virtual, mixed + virtual, adaptive none. Slope: one texel, whose centre is level, 2.9 %; "
                  "plane bias: its half texel, 0.5 m, takes the shadow, 9.4 %",
     .advice = "As above. No bias in texels suits faces that are nearly along the light; second depth needs none.",
     .worse =
         1.25, /* a texel spans 1 m of the face, 48 x 3 pixels; half of it at two corners, of 11566 that are seen */
     .build = build_steep_receiver,
     .by_hand = steep_receiver_by_hand,
     .flags = CULL_BACK | WITH_RECEIVERS,
     .picture = COLUMN_MIDPOINT + 1,
     /* Slope: the texel whose centre sees the solid's level top has no slope, and holds the face from 0.68 to 0.84,
      * where lit 0.9 m wide: 0.144 m^2, 2.9 %, less 0.031 m at the border 2.3 %. Plane bias: half a texel of the face
      * is 8 t = 0.5 m, and 0.0005 of the range 4 mm: all above 0.366 is lit, up to 0.68, 1.5 m wide: 9.4 %, less 0.031
      * m at two borders 7.5 %. */
     .methods = {[COLUMN_CONSTANT] = SHADOW(11.5, 13),
                 [COLUMN_MIDPOINT] = LIGHT(3.5, 4.9),
                 [COLUMN_DUAL] = SHADOW(11.5, 13),
                 [COLUMN_SLOPE] = SHADOW(2.2, 2.95),
                 [COLUMN_PLANE_BIAS] = LIGHT(7.4, 9.5)}},
    {.name = "l_shape",
     .group = GROUP,
     .source = "W&E fig. 5",
     .title = "leaning L over a plane, map 32, bias 4 texels (midpoint without back faces)",
     .expected =
         "self-shadow at the silhouettes unless back faces are culled, then midpoint lights what is shadowed; constant "
         "lights the crease; dual without back faces errs least.",
     .receivers = "second + virtual as second depth; of the others no amount is derived",
     .advice =
         "Dual without back faces (the default of `dual`) is the best of the paper's methods. Second depth lights the "
         "crease by up to half a texel, where front and back meet.",
     .build = build_l_shape,
     .check = check_l_shape,
     .flags = CULL_BACK | WITH_RECEIVERS,
     .picture = COLUMN_CONSTANT + 1,
     /* Second depth: edges that fall sideways by up to 0.47 leave less than 0.47 x t/2 of thickness within 0.12 t of
      * them, on some 2.5 m: 0.5 %. A texel whose centre lies before the crease holds the L's bottom; half a texel, 1/16
      * m, of a crease of 0.8 m: 0.05 m^2 at most, 0.6 %. */
     .methods = {[COLUMN_CONSTANT] = ANYTHING,
                 [COLUMN_MIDPOINT] = ANYTHING,
                 [COLUMN_DUAL] = ANYTHING,
                 [COLUMN_SECOND] = {0, 0.5, 0, 0.6, 0},
                 [COLUMN_MIXED] = {0, 0.5, 0, 0.6, 0},
                 [COLUMN_AUTO] = {0, 0.5, 0, 0.6, 0},
                 [COLUMN_SECOND_VIRTUAL] = {0, 0.5, 0, 0.6, 0},
                 [COLUMN_MIXED_VIRTUAL] = {0, 0.5, 0, 0.6, 0},
                 [COLUMN_ADAPTIVE] = ANYTHING,
                 [COLUMN_SLOPE] = ANYTHING,
                 [COLUMN_PLANE_BIAS] = ANYTHING,
                 [COLUMN_FILTER] = ANYTHING}},
};

const hard_list papers_cases = {cases, COUNT(cases)};
