/* Ranges and number formats: near and far planes, both ends of coordinates, scales, places far from the origin,
 * triangles through the planes, eyes and lights inside solids.
 *
 * "The block" is one of 0.5 m x 0.5 m x 1 m on a slab, sun at 45 degrees: no method errs there but by the texel's
 * width. */
#include "hard.h"

#include <math.h>
#include <string.h>

static void add_block(builder *b)
{
    build_floor(b, 1.9, 1.4);
    build_solid(b, 170, 120, 70);
    build_box(b, -0.75, -0.25, 0, 0.5, -0.5, 0.5);
}

static int block_by_hand(const double p[3])
{
    if (in(p[1], 0.0001, 0.499))
        return BY_HAND_UNSAID; /* a side, seen from aslant */
    return p[1] > 0.4 ? BY_HAND_LIT : lit_unless(in(p[0], -0.75, 0.25) && fabs(p[2]) < 0.5);
}

/* ---- spot lights: near to far ---------------------------------------------------------------------------------- */

/* A spot light 16 m away, 60 degrees high, 15 degrees wide, far plane at 18 m. A plate 1 to 1.2 m above the floor: seen
 * from the light at (x0, y0) a point of height y falls on the floor at x0 + (x - x0) y0 / (y0 - y). */
static const double spot_x = -8, spot_y = 13.856406460551018;

static void build_far_spot(builder *b, double ratio)
{
    const double position[3] = {spot_x, spot_y, 0}, target[3] = {0, 0, 0};
    build_floor(b, 1.9, 1.4);
    build_solid(b, 170, 120, 70);
    build_box(b, -0.7, -0.1, 1, 1.2, -0.5, 0.5);
    build_camera_above(b, 0, 0, 1.25);
    build_spot(b, position, target, 15, 18 / ratio, 18);
}

static void build_spot_100(builder *b)
{
    build_far_spot(b, 100);
}

static void build_spot_1000(builder *b)
{
    build_far_spot(b, 1000);
}

static void build_spot_10000(builder *b)
{
    build_far_spot(b, 10000);
}

static int far_spot_by_hand(const double p[3])
{
    if (p[1] > 1.1)
        return BY_HAND_LIT;
    double low = spot_y / (spot_y - 1), high = spot_y / (spot_y - 1.2), z = fabs(p[2]);
    if (in(z, 0.5 * low, 0.5 * high))
        return BY_HAND_UNSAID;
    return lit_unless(in(p[0], spot_x + (-0.7 - spot_x) * low, spot_x + (-0.1 - spot_x) * high) && z < 0.5 * low);
}

/* Units of 1/65536 of the stored depth (docs/number-formats.md: 2 Z / 65536) on the rays through the shadow that can be
 * seen, x from -0.1 to 0.65, 0.82 m^2, 9.8 %:
 *
 *     near : far    floor               plate, below        plate, above        2 texels
 *     1 : 100       65450 to 65468      65392 to 65411      65380 to 65398      54
 *     1 : 1000      65527.1 to 65528.8  65521.3 to 65523.2  65520.1 to 65521.9  17
 *     1 : 10^4      65534.66 to .83     65534.09 to .27     65533.96 to 4.15    5.4
 *
 * Constant: the bias exceeds the 7 units between plate and floor at 1 : 1000 already. At 1 : 10^4 floor and plate fall
 * into one unit, 65534, and ties are lit: all of the shadow is lost in 16 bits; in part for those that look at the
 * plate's upper side too, which leaves that unit at x = 0.1. 32 bits hold them all apart.
 *
 * From x = 1.45 on the floor is at 65535, an odd unit, as is the slab's underside: `mixed`, whose mark takes the lowest
 * bit of z2, has to give it back, or the floor shadows itself there (6.2 %). */
#if GN_DEPTH_BITS == 16
#define SPOT_10000_SECOND LIGHT(8, 9.9)
#define SPOT_10000_MIDDLE                                                                                              \
    {                                                                                                                  \
        0, 0.5, 4, 9.9, 0                                                                                              \
    }
#define SPOT_10000_MIXED LIGHT(8, 9.9)
#else
#define SPOT_10000_SECOND                                                                                              \
    {                                                                                                                  \
        0, 0, 0, 0, 0                                                                                                  \
    }
#define SPOT_10000_MIDDLE                                                                                              \
    {                                                                                                                  \
        0, 0, 0, 0, 0                                                                                                  \
    }
#define SPOT_10000_MIXED                                                                                               \
    {                                                                                                                  \
        0, 0, 0, 0, 0                                                                                                  \
    }
#endif

/* A spot light of 178 degrees, 3 cm above the floor, and a box half as high: tan 89 = 57, a texel is 0.054 m on the
 * floor. A point of the floor is shadowed if the way to the light passes through the box. */
static void build_wide_spot(builder *b)
{
    const double position[3] = {0, 0.03, 0}, target[3] = {0, 0, 0};
    build_floor(b, 1.9, 1.4);
    build_solid(b, 170, 120, 70);
    build_box(b, 0.3, 0.35, 0, 0.015, -0.05, 0.05);
    build_camera_above(b, 0, 0, 1.25);
    build_spot(b, position, target, 178, 0.005, 0.05);
}

static int wide_spot_by_hand(const double p[3])
{
    if (p[1] > 0.001)
        return BY_HAND_LIT;
    /* 1/2 of the way is as high as the box; 0.3 / x of it as far as the box's front */
    return lit_unless(in(p[0], 0.3, 0.7) && fabs(p[2]) * fmax(0.5, 0.3 / p[0]) < 0.05);
}

/* ---- coordinates at both ends ---------------------------------------------------------------------------------- */

static void finish_block(builder *b, double unit)
{
    b->unit = unit;
    add_block(b);
    build_view_from_above(b, 45);
}

/* The slab's corners are at +-2^24 exactly. */
static void build_world_limit(builder *b)
{
    finish_block(b, 16777216 / 1.9);
}

static void build_thousandth(builder *b)
{
    finish_block(b, 16777.216 / 1.9);
}

/* 4 m are 64 world integers, the least box of a light; a texel is one. */
static void build_least_box(builder *b)
{
    b->unit = 16;
    build_floor(b, 1.875, 1.375);
    build_solid(b, 170, 120, 70);
    build_box(b, -0.75, -0.25, 0, 0.5, -0.5, 0.5);
    build_view_from_above(b, 45);
}

/* A light's box of 2^28 world integers around a scene of 2^25: with map 1024 a texel is 0.03 m. */
static void build_largest_box(builder *b)
{
    finish_block(b, 16777216 / 1.9);
    double side = 268435456 / b->unit;
    build_sun_box(b, 0, 0, side, side, -side / 2, side);
    b->map_width = b->map_height = 1024;
}

static void build_far_from_origin(builder *b)
{
    static const int32_t origin[3] = {16777216 - 17000, -16777216 + 9000, 16777216 - 13000};
    memcpy(b->origin, origin, sizeof origin);
    b->unit = 16777.216 / 1.9;
    add_block(b);
    build_camera_above(b, 0, 0, 1.25);
    build_sun(b, 1, -1, 0);
}

/* An orthographic eye at 2^27. */
static void build_far_eye(builder *b)
{
    finish_block(b, BUILD_METRE);
    int32_t eye[3] = {0, 1 << 27, 0}, target[3] = {0, 0, 0}, up[3] = {0, 0, -1};
    gn_status status = gn_look_at(&b->camera, eye, target, up);
    if (status == GN_OK)
        status = gn_orthographic(&b->camera, 5 * BUILD_METRE / 4, 1, 1 << 28);
    b->status = b->status == GN_OK ? status : b->status;
}

/* A perspective eye at 2^27 = 256 m and the narrowest opening, 0.5 degree, which sees 2.23 m there. A reciprocal errs
 * by 2^-18, 1 mm of 256 m. */
static void build_far_perspective(builder *b)
{
    finish_block(b, 1 << 19);
    int32_t eye[3] = {0, 1 << 27, 0}, target[3] = {0, 0, 0}, up[3] = {0, 0, -1};
    gn_status status = gn_look_at(&b->camera, eye, target, up);
    if (status == GN_OK)
        status = gn_perspective(&b->camera, (gn_angle)(0x100000000 / 720 + 1), 200 << 19, 300 << 19);
    b->status = b->status == GN_OK ? status : b->status;
}

/* A spot light with two coordinates at 2^27 = 256 m, 45 degrees high, 362 m away and 0.75 degree wide: 4.74 m at the
 * slab. Nearly a sun: what falls 0.5 m further there falls less than 2 mm further here. */
static void build_distant_spot(builder *b)
{
    const double position[3] = {-256, 256, 0}, target[3] = {0, 0, 0};
    b->unit = 1 << 19;
    add_block(b);
    build_camera_above(b, 0, 0, 1.25);
    build_spot(b, position, target, 0.75, 340, 400);
}

static int distant_spot_by_hand(const double p[3])
{
    if (in(fabs(p[2]), 0.49, 0.51) || in(p[0], 0.24, 0.26))
        return BY_HAND_UNSAID;
    return fabs(p[2]) < 1 && fabs(p[0]) < 1 ? block_by_hand(p) : BY_HAND_UNSAID;
}

/* Perspective, near : far = 1 : 10^4. */
static void build_near_eye(builder *b, double near_depth)
{
    const double eye[3] = {-1.5, 2.2, 2.2}, target[3] = {-0.1, 0, 0};
    add_block(b);
    build_camera_perspective(b, eye, target, 45, near_depth, 10);
    build_low_sun(b, 45);
}

static void build_camera_10000(builder *b)
{
    build_near_eye(b, 0.001);
}

/* ---- through the planes, behind the eye and the light ---------------------------------------------------------- */

/* The eye stands on the slab, between a panel over its head that reaches from behind to before it, and the block. */
static void build_through_near(builder *b)
{
    const double eye[3] = {-1.2, 0.5, 0.1}, target[3] = {1, 0.1, 0};
    build_floor(b, 1.9, 1.4);
    build_solid(b, 170, 120, 70);
    build_box(b, 0.25, 0.5, 0, 0.3, -0.4, 0.4);
    build_solid(b, 120, 150, 120);
    build_box(b, -1.7, -0.8, 0.6, 0.75, -0.5, 0.5);
    build_camera_perspective(b, eye, target, 70, 0.05, 20);
    build_low_sun(b, 45);
}

static int through_near_by_hand(const double p[3])
{
    if (p[1] > 0.0001)
        return p[1] > 0.299 && p[1] < 0.301 && fabs(p[2]) < 0.3999 && in(p[0], 0.2501, 0.4999) ? BY_HAND_LIT
                                                                                               : BY_HAND_UNSAID;
    return p[1] < -0.0001
               ? BY_HAND_UNSAID
               : lit_unless((in(p[0], 0.25, 0.8) && fabs(p[2]) < 0.4) || (in(p[0], -1.1, -0.05) && fabs(p[2]) < 0.5));
}

/* A spot light 1 m above the floor that looks down, 90 degrees wide, its near plane at y = 0.7. What is higher casts no
 * shadow: the box above the light, the plate at 0.8. The box from 0.6 to 0.8 is cut there: its section, x from 0.2 to
 * 0.3, |z| < 0.1, shadows x from 0.667 to 1, |z| < 0.333: 0.222 m^2, 2.7 %. Through the section the light sees the
 * box's inside first: dual, which culls it, finds the floor lit; mixed takes the floor for the solid's back and
 * compares it with itself: a tie, which is lit in 16 bits; 32 bits are more than the point's depth is good for, and the
 * last of them decides. */
#if GN_DEPTH_BITS == 16
#define CUT_MIXED LIGHT(1.8, 2.9)
#else
#define CUT_MIXED LIGHT(0, 2.9)
#endif
static void build_cut_by_light(builder *b)
{
    const double position[3] = {0, 1, 0}, target[3] = {0, 0, 0};
    build_floor(b, 1.9, 1.4);
    build_solid(b, 170, 120, 70);
    build_box(b, 0.2, 0.3, 0.6, 0.8, -0.1, 0.1);
    build_box(b, -0.3, -0.2, 0.8, 0.85, -0.1, 0.1);
    build_box(b, -0.3, 0.3, 1.3, 1.5, -0.9, -0.7);
    build_camera_above(b, 0, 0, 1.25);
    build_spot(b, position, target, 90, 0.3, 1.3);
}

static int cut_by_light_by_hand(const double p[3])
{
    if (p[1] > 0.001)
        return BY_HAND_UNSAID;
    if (fabs(p[0]) > 1 || fabs(p[2]) > 1)
        return BY_HAND_SHADOWED; /* outside of the frustum */
    if (in(p[0], 2.0 / 3, 1) && fabs(p[2]) < 1.0 / 3)
        return BY_HAND_SHADOWED;
    return in(p[0], 0.499, 2.0 / 3) && fabs(p[2]) < 0.334 ? BY_HAND_UNSAID : BY_HAND_LIT;
}

static void build_camera_inside(builder *b)
{
    const double eye[3] = {-1.2, 0.8, 0.1}, target[3] = {1, 0.3, 0};
    build_solid(b, 200, 180, 150);
    build_box(b, -1.5, 1.4, 0, 1.2, -1.2, 1.2);
    build_camera_perspective(b, eye, target, 70, 0.05, 20);
    build_low_sun(b, 45);
}

static int all_dark_by_hand(const double p[3])
{
    (void)p;
    return BY_HAND_SHADOWED;
}

static void build_light_inside(builder *b)
{
    const double position[3] = {0, 1.6, 0}, target[3] = {0, 0, 0};
    build_floor(b, 1.9, 1.4);
    build_solid(b, 220, 200, 120);
    build_box(b, -0.2, 0.2, 1.4, 1.8, -0.2, 0.2);
    build_camera_above(b, 0, 0, 1.25);
    build_spot(b, position, target, 90, 0.05, 2);
}

/* ---- one step beyond the ranges -------------------------------------------------------------------------------- */

static void at_and_beyond(hard_row *row, const char *what, gn_status at, gn_status beyond)
{
    promise(row, at == GN_OK, 0, "limits_%s_is_accepted_at_the_limit", what);
    promise(row, beyond == GN_OUT_OF_RANGE, 0, "limits_%s_is_refused_one_step_beyond", what);
}

/* A plan for one triangle, with settings that are in their ranges but for what a caller puts there. */
static gn_status plan_of(int32_t coordinate, const gn_settings *settings)
{
    int32_t vertices[3][3] = {{0, 0, 0}, {coordinate, 0, 0}, {0, -coordinate, 5}};
    static const uint16_t indices[3] = {0, 1, 2};
    gn_mesh mesh = {.vertices = (const int32_t(*)[3])vertices,
                    .indices = indices,
                    .vertex_count = 3,
                    .triangle_count = 1,
                    .index_size = 2};
    gn_object object = {.mesh = &mesh};
    gn_scene scene = {.objects = &object, .object_count = 1};
    gn_plan plan;
    return gn_make_plan(&plan, &scene, settings);
}

static gn_status plan_vertex(int32_t coordinate)
{
    gn_settings settings = gn_default_settings(8, 8, 8);
    return plan_of(coordinate, &settings);
}

static gn_status plan_image(uint16_t width, uint16_t height)
{
    gn_settings settings = gn_default_settings(width, height, 8);
    return plan_of(9, &settings);
}

static gn_status plan_map(uint16_t width, uint16_t height)
{
    gn_settings settings = gn_default_settings(8, 8, width);
    settings.map_height = height;
    return plan_of(9, &settings);
}

static gn_status plan_workers(uint8_t workers)
{
    gn_settings settings = gn_default_settings(8, 8, 8);
    settings.workers = workers;
    return plan_of(9, &settings);
}

/* The triangle's corners have x = -2^24: m, shift and t are chosen so that they stay within the world, and only the
 * model's own ranges count. */
static gn_status fit_to_model(int32_t m, int32_t t, uint8_t shift)
{
    static const int32_t vertices[3][3] = {{-16777216, 0, 0}, {-16777216, 9, 0}, {-16777216, 0, 9}};
    static const uint16_t indices[3] = {0, 1, 2};
    static const int32_t direction[3] = {1, -1, 0};
    gn_mesh mesh = {.vertices = vertices, .indices = indices, .vertex_count = 3, .triangle_count = 1, .index_size = 2};
    gn_model model = {.m = {{m, 0, 0}, {0, 1, 0}, {0, 0, 1}}, .t = {t, 0, 0}, .shift = shift};
    gn_object object = {.mesh = &mesh, .model = &model};
    gn_scene scene = {.objects = &object, .object_count = 1};
    gn_light light;
    gn_status status = gn_directional_light(&light, direction, 0);
    return status == GN_OK ? gn_fit_light(&light, &scene) : GN_BAD_ARGUMENT;
}

static gn_status shine_along(int32_t x)
{
    gn_light light;
    const int32_t direction[3] = {x, -5, 0};
    return gn_directional_light(&light, direction, 0);
}

static gn_status look_from(int32_t x)
{
    gn_camera camera;
    const int32_t eye[3] = {x, 0, 0}, target[3] = {0, 0, 0}, up[3] = {0, 1, 0};
    return gn_look_at(&camera, eye, target, up);
}

static gn_status open_perspective(double degrees, int32_t near_depth, int32_t far_depth)
{
    gn_camera camera;
    return gn_perspective(&camera, (gn_angle)(int64_t)llround(degrees / 360 * 4294967296.0), near_depth, far_depth);
}

static gn_status open_orthographic(int32_t half_height, int32_t near_depth, int32_t far_depth)
{
    gn_camera camera;
    return gn_orthographic(&camera, half_height, near_depth, far_depth);
}

static gn_status aim_spot(int32_t x, double degrees)
{
    gn_light light;
    const int32_t position[3] = {x, 0, 0}, target[3] = {0, 5, 0};
    return gn_spot_light(&light, position, target, 0, (gn_angle)(int64_t)llround(degrees / 360 * 4294967296.0), 1000,
                         100000);
}

static gn_status open_spot(int32_t near_depth, int32_t far_depth)
{
    gn_light light;
    const int32_t position[3] = {9, 0, 0}, target[3] = {0, 5, 0};
    return gn_spot_light(&light, position, target, 0, GN_DEGREES(40), near_depth, far_depth);
}

/* Both passes of the block with another box or other planes. */
static gn_status render_status(void (*change)(packed_scene *packed, int32_t value), int32_t value)
{
    builder b;
    packed_scene packed;
    problem why;
    frame f;
    gn_status status = GN_OK;
    build_begin(&b);
    finish_block(&b, BUILD_METRE);
    b.width = b.height = b.map_width = b.map_height = 8;
    if (build_finish(&b, &packed) == 0) {
        change(&packed, value);
        gn_settings settings = method_settings(&packed, COLUMN_AUTO, 0);
        if (frame_open(&f, &packed.scene, &settings, 0, &why) == 0) {
            gn_pixels pixels;
            uint8_t mask[64];
            status = gn_light_pass(f.context, &packed.light);
            if (status == GN_OK)
                status = gn_camera_begin(f.context, &packed.camera);
            for (uint32_t i = 0; status == GN_OK && i < f.plan.camera_regions; i++)
                status = gn_camera_region(f.context, i, 0, 0, mask, &pixels);
        } else {
            status = GN_BAD_ARGUMENT;
        }
        frame_close(&f);
    }
    build_free(&b);
    packed_free(&packed);
    return status;
}

static void change_box_width(packed_scene *packed, int32_t value)
{
    packed->light.box_width = value;
}

static void change_box_height(packed_scene *packed, int32_t value)
{
    packed->light.box_height = value;
}

static void change_box_v(packed_scene *packed, int32_t value)
{
    packed->light.box_v = value;
}

/* Deep enough a box for what then lies far behind its front. */
static void change_box_z(packed_scene *packed, int32_t value)
{
    packed->light.box_z = value;
    packed->light.box_depth = 1 << 28;
}

static void change_spot_planes(packed_scene *packed, int32_t value)
{
    static const int32_t position[3] = {0, 4 * BUILD_METRE, 0}, target[3] = {0, 0, 0};
    (void)gn_spot_light(&packed->light, position, target, 0, GN_DEGREES(90), 200, value);
}

static void change_box_u(packed_scene *packed, int32_t value)
{
    packed->light.box_u = value;
}

static void change_planes(packed_scene *packed, int32_t value)
{
    (void)gn_perspective(&packed->camera, GN_DEGREES(40), 200, value);
}

/* The scene ends 6 m behind the box's front, 393,216 integers, 6144 boxes of 64. An orthographic camera's own depth
 * counts as well: 2 m. */
static void change_box_depth(packed_scene *packed, int32_t value)
{
    (void)gn_orthographic(&packed->camera, 81920, 3 * BUILD_METRE, 5 * BUILD_METRE);
    packed->light.box_depth = value;
}

static void change_vertex(packed_scene *packed, int32_t value)
{
    int32_t(*vertices)[3] = (int32_t(*)[3])packed->meshes[0].vertices;
    vertices[0][0] = value;
}

/* The limits are those that core/gnomon.h states. */
static void run_limits(hard_row *row)
{
    int32_t world = 1 << 24, eye = 1 << 27, depth = 1 << 28, model = 1 << 30;
    at_and_beyond(row, "vertex", plan_vertex(world), plan_vertex(world + 1));
    at_and_beyond(row, "image_width", plan_image(4096, 8), plan_image(4097, 8));
    at_and_beyond(row, "image_height", plan_image(8, 4096), plan_image(8, 4097));
    at_and_beyond(row, "least_image_width", plan_image(1, 8), plan_image(0, 8));
    at_and_beyond(row, "least_image_height", plan_image(8, 1), plan_image(8, 0));
    at_and_beyond(row, "map_width", plan_map(4096, 8), plan_map(4097, 8));
    at_and_beyond(row, "map_height", plan_map(8, 4096), plan_map(8, 4097));
    at_and_beyond(row, "least_map_width", plan_map(1, 8), plan_map(0, 8));
    at_and_beyond(row, "least_map_height", plan_map(8, 1), plan_map(8, 0));
    at_and_beyond(row, "workers", plan_workers(64), plan_workers(65));
    at_and_beyond(row, "least_workers", plan_workers(1), plan_workers(0));
    at_and_beyond(row, "model_factor", fit_to_model(model, 0, 30), fit_to_model(model + 1, 0, 30));
    at_and_beyond(row, "negative_model_factor", fit_to_model(-model, 0, 30), fit_to_model(-model - 1, 0, 30));
    at_and_beyond(row, "model_translation", fit_to_model(model, model, 24), fit_to_model(model, model + 1, 24));
    at_and_beyond(row, "negative_model_translation", fit_to_model(-model, -model, 24),
                  fit_to_model(-model, -model - 1, 24));
    at_and_beyond(row, "model_shift", fit_to_model(model, 0, 62), fit_to_model(model, 0, 63));
    at_and_beyond(row, "direction", shine_along(eye), shine_along(eye + 1));
    at_and_beyond(row, "spot_far_plane", open_spot(1000, depth), open_spot(1000, depth + 1));
    at_and_beyond(row, "spot_nearest_plane", open_spot(1, 1000), open_spot(0, 1000));
    at_and_beyond(row, "spot_far_to_near", render_status(change_spot_planes, 200 << 20),
                  render_status(change_spot_planes, (200 << 20) + 1));
    at_and_beyond(row, "eye", look_from(eye), look_from(eye + 1));
    at_and_beyond(row, "negative_eye", look_from(-eye), look_from(-eye - 1));
    at_and_beyond(row, "widest_camera", open_perspective(178, 1000, 2000), open_perspective(178.001, 1000, 2000));
    at_and_beyond(row, "narrowest_camera", open_perspective(0.5, 1000, 2000), open_perspective(0.499, 1000, 2000));
    at_and_beyond(row, "far_plane", open_perspective(40, 1000, depth), open_perspective(40, 1000, depth + 1));
    at_and_beyond(row, "nearest_plane", open_perspective(40, 1, 1000), open_perspective(40, 0, 1000));
    at_and_beyond(row, "half_height", open_orthographic(1 << 26, 0, 64), open_orthographic((1 << 26) + 1, 0, 64));
    at_and_beyond(row, "least_half_height", open_orthographic(1, 0, 64), open_orthographic(0, 0, 64));
    at_and_beyond(row, "orthographic_planes", open_orthographic(9, -depth, depth), open_orthographic(9, -depth - 1, 0));
    at_and_beyond(row, "orthographic_depth", open_orthographic(9, 0, 64), open_orthographic(9, 0, 63));
    at_and_beyond(row, "spot_place", aim_spot(eye, 40), aim_spot(eye + 1, 40));
    at_and_beyond(row, "widest_spot", aim_spot(9, 178), aim_spot(9, 178.001));
    at_and_beyond(row, "narrowest_spot", aim_spot(9, 0.5), aim_spot(9, 0.499));
    at_and_beyond(row, "box_width", render_status(change_box_width, depth), render_status(change_box_width, depth + 1));
    at_and_beyond(row, "least_box_width", render_status(change_box_width, 64), render_status(change_box_width, 63));
    at_and_beyond(row, "box_height", render_status(change_box_height, depth),
                  render_status(change_box_height, depth + 1));
    at_and_beyond(row, "least_box_height", render_status(change_box_height, 64), render_status(change_box_height, 63));
    at_and_beyond(row, "box_u", render_status(change_box_u, -depth), render_status(change_box_u, -depth - 1));
    at_and_beyond(row, "box_v", render_status(change_box_v, -depth), render_status(change_box_v, -depth - 1));
    at_and_beyond(row, "box_z", render_status(change_box_z, -depth), render_status(change_box_z, -depth - 1));
    at_and_beyond(row, "box_depth", render_status(change_box_depth, depth), render_status(change_box_depth, depth + 1));
    at_and_beyond(row, "least_box_depth", render_status(change_box_depth, 64), render_status(change_box_depth, 63));
    at_and_beyond(row, "far_to_near", render_status(change_planes, 200 << 20),
                  render_status(change_planes, (200 << 20) + 1));
    /* a vertex that moves beyond the world after the plan was made */
    at_and_beyond(row, "vertex_of_a_pass", render_status(change_vertex, world), GN_OUT_OF_RANGE);
    row_remark(row, "%d limits, two promises each.", (row->met + row->unmet) / 2);
}

/* ---- the list -------------------------------------------------------------------------------------------------- */

#define GROUP "Numbers"

static const hard_case cases[] = {
    {.name = "spot_100",
     .group = GROUP,
     .flags = LONG | WITH_RECEIVERS,
     .title = "spot light 16 m away, near : far = 1 : 100",
     .expected = "none errs",
     .receivers = "none errs",
     .advice = "As it should be.",
     .build = build_spot_100,
     .by_hand = far_spot_by_hand},
    {.name = "spot_1000",
     .group = GROUP,
     .flags = LONG | WITH_RECEIVERS,
     .title = "1 : 1000",
     .expected = "constant: no shadow, 9.8 %: 2 texels at the near end are 3.7 m at the far end; the others none",
     .receivers =
         "a bias in shares of the range, 0.0001 or 0.0005, is more than the metre between plate and floor: no shadow",
     .advice =
         "A bias in texels is converted at sqrt(near far): for spot lights give it in metres, or take second depth.",
     .build = build_spot_1000,
     .by_hand = far_spot_by_hand,
     /* Stored depth at w of 16 m: the range's share of a metre is near / w^2 = 6e-5. */
     .methods = {[COLUMN_CONSTANT] = LIGHT(8, 9.9),
                 [COLUMN_ADAPTIVE] = LIGHT(8, 9.9),
                 [COLUMN_SLOPE] = LIGHT(8, 9.9),
                 [COLUMN_PLANE_BIAS] = LIGHT(8, 9.9)}},
    {.name = "spot_10000",
     .group = GROUP,
     .title = "1 : 10^4",
     .expected =
         "16 bits: floor and plate, a metre apart, have one depth: no shadow, 9.8 %; midpoint, dual in part. 32 bits: "
         "none but constant, and auto, whose votes forgive 2^-16 of the range",
     .advice = "Near planes as far out as the scene allows; else `GN_DEPTH_BITS=32`.",
     .build = build_spot_10000,
     .by_hand = far_spot_by_hand,
     .picture = COLUMN_MIXED + 1,
     /* Where virtual samples may follow, points vote as if they were nearer by 2^-16 of the range, in 32 bits as well.
      */
     .methods = {[COLUMN_CONSTANT] = LIGHT(8, 9.9),
                 [COLUMN_MIDPOINT] = SPOT_10000_MIDDLE,
                 [COLUMN_DUAL] = SPOT_10000_MIDDLE,
                 [COLUMN_SECOND] = SPOT_10000_SECOND,
                 [COLUMN_MIXED] = SPOT_10000_MIXED,
                 [COLUMN_AUTO] = LIGHT(8, 9.9)}},
    {.name = "wide_spot",
     .group = GROUP,
     .title = "spot light of 178 degrees, 3 cm above a floor",
     .expected = "constant: no shadow, 0.7 %; the others none",
     .advice = "As for 1 : 1000.",
     .build = build_wide_spot,
     .by_hand = wide_spot_by_hand,
     /* 2 t at sqrt(near far) = 16 mm are 57 mm, more than all of the depth. The shadow: 0.35 m x 0.17 m or so. Second
      * depth: half a texel behind the foot's edges, as of the turned block: 0.15 m x 0.027 m. */
     .methods = {[COLUMN_CONSTANT] = LIGHT(0.2, 0.9),
                 [COLUMN_SECOND] = LIGHT(0, 0.05),
                 [COLUMN_MIXED] = LIGHT(0, 0.05),
                 [COLUMN_AUTO] = LIGHT(0, 0.05)}},
    {.name = "distant_spot",
     .group = GROUP,
     .flags = LONG,
     .title = "spot light at 2^27, 0.75 degree",
     .expected = "as under a sun: none errs",
     .advice = "As it should be.",
     .build = build_distant_spot,
     .by_hand = distant_spot_by_hand,
     /* tie_at_a_foot (cases_light.c). */
     .methods = {[COLUMN_AUTO] = LIGHT(0, 0.3)}},
    {.name = "world_limit",
     .group = GROUP,
     .title = "the block, corners at +-2^24",
     .expected = "none errs",
     .advice = "As it should be.",
     .build = build_world_limit,
     .by_hand = block_by_hand},
    {.name = "thousandth",
     .group = GROUP,
     .flags = LONG,
     .title = "the block 10^-3 of that",
     .expected = "none errs",
     .advice = "A scene needs some 10,000 integers; the simulator scales it into the range by itself.",
     .build = build_thousandth,
     .by_hand = block_by_hand},
    {.name = "least_box",
     .group = GROUP,
     .title = "the block in a light's box of 64 integers",
     .expected = "none errs",
     .advice = "A texel may be as small as a world integer.",
     .build = build_least_box,
     .by_hand = block_by_hand},
    {.name = "largest_box",
     .group = GROUP,
     .title = "the block in a light's box of 2^28, map 1024",
     .expected = "none errs",
     .advice = "As it should be.",
     .build = build_largest_box,
     .by_hand = block_by_hand,
     .flags = LONG},
    {.name = "far_from_origin",
     .group = GROUP,
     .title = "the block of 10^-3 in the corner of the world",
     .expected = "none errs",
     .advice = "As it should be: places are integers, and equal everywhere.",
     .build = build_far_from_origin,
     .by_hand = block_by_hand},
    {.name = "far_eye",
     .group = GROUP,
     .title = "orthographic eye at 2^27",
     .expected = "none errs",
     .advice = "As it should be.",
     .build = build_far_eye,
     .by_hand = block_by_hand},
    {.name = "far_perspective",
     .group = GROUP,
     .title = "perspective eye at 2^27, 0.5 degree",
     .expected = "none errs",
     .advice = "As it should be.",
     .build = build_far_perspective,
     .by_hand = block_by_hand},
    {.name = "camera_10000",
     .group = GROUP,
     .title = "camera, near : far = 1 : 10^4",
     .expected = "none errs",
     .advice = "The camera's depth has 30 bits of 1 / w.",
     .build = build_camera_10000,
     .by_hand = block_by_hand},
    {.name = "through_near",
     .group = GROUP,
     .title = "floor and panel through the camera's near plane",
     .expected = "none errs",
     .advice = "As it should be.",
     .build = build_through_near,
     .by_hand = through_near_by_hand,
     .picture = COLUMN_AUTO + 1,
     /* The panel's top back edge, 0.25 t on the map, for the midpoint. */
     .methods = {[COLUMN_MIDPOINT] = SHADOW(0, 0.5)}},
    {.name = "cut_by_light",
     .group = GROUP,
     .title = "solid cut by a light's near plane, another behind the light",
     .expected = "dual, mixed: the cut's shadow is lit, 2.7 %; the others none",
     .advice = "Keep solids on one side of a light's near plane, or take second depth.",
     .build = build_cut_by_light,
     .by_hand = cut_by_light_by_hand,
     .picture = COLUMN_DUAL + 1,
     .methods = {[COLUMN_DUAL] = LIGHT(1.8, 2.9), [COLUMN_MIXED] = CUT_MIXED}},
    {.name = "camera_inside",
     .group = GROUP,
     .title = "camera inside a solid; all is dark",
     .expected = "second depth, mixed: half of the floor and the far wall are lit, 28 %; auto all of them; constant, "
                 "dual: a strip "
                 "below the ceiling, 1 %",
     .receivers = "second, mixed + virtual: all of the floor and the far wall, 55.1 %, as they tie with themselves; "
                  "the others none",
     .advice = "A room is not a solid seen from outside: give its walls thickness, or mark it open.",
     .build = build_camera_inside,
     .by_hand = all_dark_by_hand,
     .flags = NO_LIGHT | WITH_RECEIVERS,
     .picture = COLUMN_SECOND + 1,
     /* They are the back faces that the map holds, compared with themselves: of each texel the half nearer to the light
      * is lit. The floor fills 38.3 % of the picture, the far wall 16.8 %: 27.6 %; pixel by pixel 28.0 %. The floor's
      * nearest row of texels, 5.5 %, is cut by the picture's edge: what its half gives or takes is 1.4 %. Constant,
      * dual: what is within 2 t of the ceiling along the light, 0.088 m of the far wall's 1.2 m; it fills 1/8 of the
      * picture: 1 %. */
     .methods = {[COLUMN_CONSTANT] = LIGHT(0.5, 1.5),
                 [COLUMN_DUAL] = LIGHT(0.5, 1.5),
                 [COLUMN_SECOND] = LIGHT(26.6, 29.4),
                 [COLUMN_MIXED] = LIGHT(26.6, 29.4),
                 [COLUMN_AUTO] = LIGHT(52, 57),
                 [COLUMN_SECOND_VIRTUAL] = LIGHT(52, 57),
                 [COLUMN_MIXED_VIRTUAL] = LIGHT(52, 57),
                 [COLUMN_FILTER] = LIGHT(40, 57)}},
    {.name = "light_inside",
     .group = GROUP,
     .title = "spot light inside a solid; all is dark",
     .expected = "dual, mixed: all in the frustum is lit, 92 %; the others none",
     .advice = "Lamps: move the near plane beyond the shade, or mark it open.",
     .build = build_light_inside,
     .by_hand = all_dark_by_hand,
     .flags = NO_LIGHT,
     /* The light sees the inside of the lamp, back faces; behind them the floor. The frustum is 3.2 m wide on the
      * floor, the picture 3.33 m; the lamp hides 2 %. */
     .methods = {[COLUMN_DUAL] = LIGHT(85, 96), [COLUMN_MIXED] = LIGHT(85, 96)}},
    {.name = "limits",
     .group = GROUP,
     .title = "at limits that core/gnomon.h states, and one step beyond",
     .expected = "accepted; `GN_OUT_OF_RANGE`.",
     .advice = "No number wraps or crashes later.",
     .run = run_limits},
};

const hard_list number_cases = {cases, COUNT(cases)};
