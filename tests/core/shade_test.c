/* The camera pass: a pixel's place in light space, the shadow test, the colour; against long double.
 *
 * A pixel's point is E + w d with w from Q by a short reciprocal, whose error of -2^-18 to 2^-21 moves the point along
 * its ray; a spot light's own reciprocal adds 2^-18 of u, v and 1/w. What else is lost is rounding: of the expressions'
 * constants (2^-27 of their terms) and of their steps (half a unit each, over half the image at most). Cases: 40000, or
 * GNOMON_CASES. */
#include "gn_lambert.h"
#include "scenes.h"

#include <math.h>

#define gn_shade_row tested_shade_row
#define gn_falloff_row tested_falloff_row
#define gn_row_of_w tested_row_of_w
#define gn_over_distance tested_over_distance
void gn_shade_row(const gn_context *context, uint32_t *q, int32_t x, int32_t y, int32_t count);
void gn_falloff_row(const gn_context *context, uint32_t *q, int32_t x, int32_t y, int32_t count);
#include "gn_shade.c" /* for compare */
#undef gn_shade_row
#undef gn_falloff_row
#undef gn_row_of_w
#undef gn_over_distance

typedef long double real;
__extension__ typedef __int128 exact;

static const int32_t y_up[3] = {0, 1, 0};

static real dot(const real a[3], const real b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static real along(const gn_q2_30 axis[3], const real v[3])
{
    real a[3] = {ldexpl(axis[0], -30), ldexpl(axis[1], -30), ldexpl(axis[2], -30)};
    return dot(a, v);
}

/* ---- exact views ----------------------------------------------------------------------------------------------- */

/* The point at distance w along a pixel's ray. */
static void point_of_pixel(real p[3], const gn_camera *camera, const gn_settings *s, real column, real row, real w)
{
    real half = camera->projection == GN_PERSPECTIVE ? w * ldexpl(camera->tan_half, -24) : camera->half_height;
    real x = (2 * (column + 0.5L) - s->width) / s->height * half, y = (s->height - 2 * (row + 0.5L)) / s->height * half;
    for (int i = 0; i < 3; i++)
        p[i] = camera->eye[i] + ldexpl(w * camera->forward[i] + x * camera->right[i] + y * camera->up[i], -30);
}

/* u and v in texels, depth in 16-bit units as stored (32768 of 2^31 each), and for spot lights w. */
static void place_in_light(real out[4], const gn_light *light, const gn_settings *s, const real p[3])
{
    if (light->kind == GN_DIRECTIONAL) {
        out[0] = (along(light->right, p) - light->box_u) * s->map_width / light->box_width;
        out[1] = s->map_height - (along(light->up, p) - light->box_v) * s->map_height / light->box_height;
        real z = GN_DEPTH_GUARD + (along(light->forward, p) - light->box_z) * GN_DEPTH_SPAN / light->box_depth;
        out[2] = ldexpl(z, -15);
        out[3] = 1;
        return;
    }
    real relative[3] = {p[0] - light->position[0], p[1] - light->position[1], p[2] - light->position[2]};
    real tangent = ldexpl(light->tan_half, -24), w = along(light->forward, relative);
    real n = light->near_depth, f = light->far_depth;
    out[0] = (1 + along(light->right, relative) / (w * tangent)) / 2 * s->map_width;
    out[1] = (1 - along(light->up, relative) / (w * tangent)) / 2 * s->map_height;
    out[2] = ldexpl(GN_DEPTH_GUARD + GN_DEPTH_SPAN * f / (f - n) * (1 - n / w), -15);
    out[3] = w;
}

/* ---- random views ---------------------------------------------------------------------------------------------- */

/* Cameras and lights around a scene of +-extent. */
static gn_status random_views(gn_camera *camera, gn_light *light, const gn_scene *scene, int32_t extent)
{
    int32_t eye[3], position[3], target[3], direction[3];
    for (int i = 0; i < 3; i++) {
        eye[i] = between(-4 * (int64_t)extent, 4 * (int64_t)extent);
        position[i] = between(-3 * (int64_t)extent, 3 * (int64_t)extent);
        target[i] = between(-extent / 2, extent / 2);
        direction[i] = between(-1000, 1000);
    }
    memset(camera, 0, sizeof *camera);
    gn_status status = gn_look_at(camera, eye, target, y_up);
    if (status == GN_OK)
        status = between(0, 2)
                     ? gn_perspective(camera, GN_DEGREES(between(5, 120)), extent >> between(1, 8), 12 * extent)
                     : gn_orthographic(camera, extent >> between(0, 3), -8 * extent, 8 * extent);
    if (status != GN_OK)
        return status;
    if (between(0, 1))
        return gn_spot_light(light, position, target, 0, GN_DEGREES(between(10, 140)), extent >> between(1, 6),
                             8 * extent);
    status = gn_directional_light(light, direction, 0);
    return status == GN_OK ? gn_fit_light(light, scene) : status;
}

static void small_cube(shape *s, int32_t extent)
{
    int32_t low[3] = {-extent, -extent, -extent}, high[3] = {extent, extent, extent};
    *s = shape_new(1);
    add_box(s, low, high);
}

/* ---- a pixel's place ------------------------------------------------------------------------------------------- */

typedef struct places {
    unsigned failures;
    uint64_t points[4]; /* perspective or orthographic, directional or spot */
    real texels[4], depth[4], of_bound;
} places;

/* The shader's answer for one pixel: u, v in texels, depth in 16-bit units. 0: outside a spot light's frustum. */
static int shaded_place(real out[3], const gn_context *context, uint32_t q, int32_t x, int32_t y, uint32_t *w)
{
    const gn_shading *s = &context->shading;
    gn_runner r[3] = {gn_start_row(&s->coordinate[0], x, y), gn_start_row(&s->coordinate[1], x, y),
                      gn_start_row(&s->coordinate[2], x, y)};
    *w = q;
    if (!context->camera_view.affine)
        tested_row_of_w(w, 1, s->w_shift);
    uint32_t value[3] = {gn_step(&r[0], *w), gn_step(&r[1], *w), gn_step(&r[2], *w)};
    if (context->light.kind == GN_DIRECTIONAL) {
        for (int i = 0; i < 3; i++)
            out[i] = ldexpl((int32_t)value[i], -(i < 2 ? s->position_bits : s->depth_bits));
        return 1;
    }
    if (value[2] - s->near_w > s->far_w - s->near_w || value[0] >= value[2] || value[1] >= value[2])
        return 0;
    unsigned k = gn_leading_zeros(value[2]);
    uint32_t reciprocal = gn_reciprocal(value[2] << k);
    for (int i = 0; i < 2; i++)
        out[i] = ldexpl((uint32_t)(gn_multiply_u(value[i] << k, reciprocal) >> 32), -30) *
                 (i ? context->settings.map_height : context->settings.map_width);
    uint32_t nearness = (uint32_t)(gn_multiply_u(s->near_w << k, reciprocal) >> 32);
    nearness = nearness > 1u << 30 ? 1u << 30 : nearness;
    uint64_t behind = gn_multiply_u(context->light_view.depth_scale, (1u << 30) - nearness);
    out[2] = ldexpl(GN_DEPTH_GUARD + (real)(behind >> context->light_view.depth_shift), -15);
    return 1;
}

static void check_point(places *count, const gn_context *context, uint64_t n)
{
    const gn_settings *s = &context->settings;
    const gn_camera *camera = &context->camera;
    const gn_shading *shading = &context->shading;
    int32_t x = between(0, s->width - 1), y = between(0, s->height - 1);
    int affine = context->camera_view.affine, spot = context->light.kind == GN_SPOT;
    uint32_t least = affine ? 1 << 10 : shading->nothing + shading->nothing / 64, w_got;
    real camera_unit = ldexpl(context->camera_view.unit.m, context->camera_view.unit.e); /* view units a world unit */
    /* as many near as far ones */
    uint32_t q = affine ? (uint32_t)between(least, 1 << 30)
                        : (uint32_t)((real)least * expl(logl(ldexpl(1, 30) / least) * between(0, 100000) / 100000.0L));
    real w = affine ? camera->far_depth - ((real)camera->far_depth - camera->near_depth) * ((real)q - (1 << 10)) /
                                              ((1 << 30) - (1 << 10))
                    : ldexpl(context->camera_view.near_w, 30) / q / camera_unit;
    real p[3], expected[4], moved[4], got[3];
    point_of_pixel(p, camera, s, x, y, w);
    place_in_light(expected, &context->light, s, p);
    /* only what lies in the map concerns the test */
    if (expected[0] < 1 || expected[0] > s->map_width - 1 || expected[1] < 1 || expected[1] > s->map_height - 1 ||
        expected[2] < 2 || expected[2] > 65534 || (spot && expected[3] < context->light.near_depth * 1.01L))
        return;
    int kind = 2 * affine + spot;
    if (!shaded_place(got, context, q, x, y, &w_got)) {
        if (count->failures++ < 5)
            note("case %llu: outside the frustum, expected %.3Lf, %.3Lf, %.3Lf", (unsigned long long)n, expected[0],
                 expected[1], expected[2]);
        return;
    }
    /* the reciprocal's error, and W's last unit */
    real slip = affine ? 0 : ldexpl(1, -18) + 1.0L / w_got;
    point_of_pixel(p, camera, s, x, y, w * (1 - slip));
    place_in_light(moved, &context->light, s, p);
    real eye[3] = {camera->eye[0], camera->eye[1], camera->eye[2]}, at_eye[4];
    real steps = 2 + (s->width + s->height) / 4.0L; /* units lost by steps */
    if (!spot)
        place_in_light(at_eye, &context->light, s, eye);
    count->points[kind]++;
    for (int i = 0; i < 3; i++) {
        real bound = 1.05L * fabsl(moved[i] - expected[i]);
        if (!spot) {
            real terms = fabsl(at_eye[i]) + fabsl(expected[i] - at_eye[i]);
            if (affine) /* the eye, the far plane's distance, and back */
                terms += fabsl(along(i == 0   ? context->light.right
                                     : i == 1 ? context->light.up
                                              : context->light.forward,
                                     (const real[3]){camera->forward[0], camera->forward[1], camera->forward[2]})) *
                         ldexpl(fabsl((real)camera->far_depth), -30) * 2 *
                         (i == 0   ? (real)s->map_width / context->light.box_width
                          : i == 1 ? (real)s->map_height / context->light.box_height
                                   : 65536.0L / context->light.box_depth);
            bound += ldexpl(steps, -(i < 2 ? shading->position_bits : shading->depth_bits)) + ldexpl(terms, -26);
        } else {
            /* of X, Y, W in view units: steps and terms; of u, v: 2^-18 of themselves */
            real unit = ldexpl(context->light_view.unit.m, context->light_view.unit.e);
            real span = 0;
            if (affine)
                span += 2 * fabsl((real)camera->far_depth);
            for (int a = 0; a < 3; a++)
                span += fabsl(eye[a] - context->light.position[a]) + fabsl(p[a] - eye[a]);
            real tangent = ldexpl(context->light.tan_half, -24), smallest = tangent < 1 ? tangent : 1;
            /* view units a unit of the expressions */
            real step = (real)context->light_view.near_w / shading->near_w;
            real units = ldexpl(span * unit / smallest, -26) + 2 + steps * step;
            real of_w = units / (expected[3] * unit);
            real nearness = context->light.near_depth / expected[3];
            real scale =
                65536.0L * context->light.far_depth / ((real)context->light.far_depth - context->light.near_depth);
            bound += i < 2 ? 2 * of_w * (i ? s->map_height : s->map_width) + 1.08L * ldexpl(expected[i], -18)
                           : scale * nearness * (1.08L * ldexpl(1, -18) + of_w + 1.0L / context->light_view.near_w) +
                                 ldexpl(scale, -28);
        }
        real error = fabsl(got[i] - expected[i]);
        count->of_bound = fmaxl(count->of_bound, error / bound);
        if (i < 2)
            count->texels[kind] = fmaxl(count->texels[kind], error);
        else
            count->depth[kind] = fmaxl(count->depth[kind], error);
        if (!(error <= bound) && count->failures++ < 5)
            note("case %llu, pixel (%d, %d), Q %lu, %s camera, %s light: %s is %.5Lf, expected %.5Lf within %.5Lf",
                 (unsigned long long)n, (int)x, (int)y, (unsigned long)q, affine ? "orthographic" : "perspective",
                 spot ? "spot" : "directional",
                 i == 0   ? "u"
                 : i == 1 ? "v"
                          : "depth",
                 got[i], expected[i], bound);
    }
}

static void places_in_light_space_keep_their_bounds(uint64_t cases)
{
    static const char *const kinds[] = {"perspective, directional", "perspective, spot", "orthographic, directional",
                                        "orthographic, spot"};
    places count;
    memset(&count, 0, sizeof count);
    uint64_t refused = 0;
    for (uint64_t n = 0; n < cases / 8 && count.failures < 5; n++) {
        shape cube;
        gn_object object;
        gn_scene scene;
        gn_camera camera;
        gn_light light;
        frame f;
        int32_t extent = between(0, 1) ? 1 << between(16, 23) : between(1 << 20, 1 << 23);
        small_cube(&cube, extent);
        memset(&object, 0, sizeof object);
        memset(&scene, 0, sizeof scene);
        object.mesh = &cube.mesh;
        scene.objects = &object;
        scene.object_count = 1;
        gn_settings s = gn_default_settings((uint16_t)between(1, 1024), (uint16_t)between(1, 1024), 1);
        s.format = GN_NO_COLOUR;
        s.map_width = (uint16_t)(1 << between(4, 9));
        s.map_height = (uint16_t)between(16, 512);
        if (s.width > 4 * s.height || s.height > 4 * s.width)
            s.width = s.height;
        gn_status status = random_views(&camera, &light, &scene, extent);
        if (status == GN_OK)
            status = frame_start(&f, &scene, &s);
        if (status == GN_OK) {
            status = gn_light_pass(f.context, &light);
            if (status == GN_OK)
                status = gn_camera_begin(f.context, &camera);
            for (int i = 0; i < 40 && status == GN_OK; i++)
                check_point(&count, f.context, n);
            frame_end(&f);
        }
        refused += status != GN_OK;
        shape_free(&cube);
    }
    ok(!count.failures, "a pixel's place in light space keeps its bound, at most %.3Lf of it", count.of_bound);
    for (int i = 0; i < 4; i++)
        ok(count.points[i] > cases / 20, "%s: %llu points, at most %.5Lf texels and %.4Lf of 65536 units of depth off",
           kinds[i], (unsigned long long)count.points[i], count.texels[i], count.depth[i]);
    ok(refused * 20 < cases / 8, "%llu views were refused", (unsigned long long)refused);
}

/* ---- colours --------------------------------------------------------------------------------------------------- */

/* Lit wherever the light is on the camera's side: a bias that no depth exceeds. */
static gn_settings lit_settings(uint16_t width, uint16_t height, uint8_t format)
{
    gn_settings s = gn_default_settings(width, height, 1);
    s.surface = GN_CONSTANT;
    s.bias.unit = GN_BIAS_RANGE;
    s.bias.value = 0xffffffffu;
    s.format = format;
    s.mask = 1;
    return s;
}

static void channels(int out[3], const frame *f, size_t i)
{
    if (f->settings.format == GN_RGB888) {
        for (int c = 0; c < 3; c++)
            out[c] = f->colour[3 * i + (size_t)c];
    } else {
        uint16_t v;
        memcpy(&v, f->colour + 2 * i, 2);
        out[0] = v >> 11, out[1] = v >> 5 & 63, out[2] = v & 31;
    }
}

/* The light pass, and then a map of texels that nothing or everything is behind: with a reconstruction pixels are
 * partly lit. */
static gn_status render_partly_lit(frame *f, const gn_light *light, const gn_camera *camera)
{
    gn_status status = gn_light_pass(f->context, light);
    for (uint32_t i = 0; status == GN_OK && f->settings.reconstruction && i < 64; i++)
        f->context->map[i / 8 * f->context->map_stride + i % 8] = (gn_depth)(between(0, 1) ? 0 : 0xffffffffu);
    return status == GN_OK ? gn_camera_pass(f->context, camera, frame_flush, f) : status;
}

/* Big triangles of any attitude, some of them closed to the light, under both kinds of light, fully lit or partly. */
static void colours_are_lambert(uint64_t cases)
{
    static const uint16_t ambients[] = {0, 65535, 20000, 1, 32768};
    static const gn_reconstruction *const how[] = {0, &gn_bilinear, &gn_box_7x7};
    uint64_t lit = 0, unlit = 0, partly[2] = {0, 0}, exact_channels = 0, all = 0;
    unsigned failures = 0;
    real worst[2] = {0, 0};
    /* 4 units of 2^-16 of 255 (N.L 2, its lit part and the intensity 1/2 each, ambient 1); spot: and 2^-11 of N.L */
    const real bound[2] = {4 * 255 / 65536.0L, 4 * 255 / 65536.0L + 255 / 2048.0L};
    for (uint64_t n = 0; n < cases / 8 && failures < 5; n++) {
        shape s = shape_new(between(0, 1));
        gn_object object;
        gn_scene scene;
        gn_camera camera;
        gn_light light;
        frame f;
        enum { SIZE = 1 << 20 };
        uint32_t corner[3];
        for (int i = 0; i < 3; i++)
            corner[i] = add_vertex(&s, between(-SIZE, SIZE), between(-SIZE, SIZE), between(-SIZE, SIZE));
        add_triangle(&s, corner[0], corner[1], corner[2]);
        memset(&object, 0, sizeof object);
        memset(&scene, 0, sizeof scene);
        object.mesh = &s.mesh;
        object.colour.r = (uint8_t)between(0, 255);
        object.colour.g = (uint8_t)between(0, 255);
        object.colour.b = 255;
        scene.objects = &object;
        scene.object_count = 1;
        scene.background.g = 77;
        scene.ambient = n % 6 < 5 ? ambients[n % 6] : (uint16_t)between(0, 65535);
        gn_settings settings = lit_settings(8, 8, n & 1 ? GN_RGB888 : GN_RGB565);
        settings.reconstruction = how[n / 2 % 3];
        settings.map_width = settings.map_height = settings.reconstruction ? 8 : 1;
        gn_status status = random_views(&camera, &light, &scene, SIZE);
        if (status == GN_OK && light.kind == GN_SPOT && n % 8 == 0)
            light.tan_half = (uint32_t)between(2 << 24, 57 << 24);
        if (status == GN_OK)
            status = frame_start(&f, &scene, &settings);
        if (status != GN_OK) {
            shape_free(&s);
            continue;
        }
        status = render_partly_lit(&f, &light, &camera);
        /* the plane, exactly enough */
        real v[3][3], e[2][3], normal[3], to_camera[3], to_light[3];
        for (int i = 0; i < 3; i++)
            for (int a = 0; a < 3; a++)
                v[i][a] = s.vertices[i][a];
        for (int a = 0; a < 3; a++) {
            e[0][a] = v[1][a] - v[0][a];
            e[1][a] = v[2][a] - v[0][a];
            to_camera[a] = camera.projection == GN_PERSPECTIVE ? camera.eye[a] - v[0][a] : -camera.forward[a];
            to_light[a] = light.kind == GN_SPOT ? light.position[a] - v[0][a] : -light.forward[a];
        }
        for (int a = 0; a < 3; a++)
            normal[a] = e[0][(a + 1) % 3] * e[1][(a + 2) % 3] - e[0][(a + 2) % 3] * e[1][(a + 1) % 3];
        real length = sqrtl(dot(normal, normal)), side = dot(normal, to_light) * dot(normal, to_camera);
        for (int i = 0; status == GN_OK && i < 64; i++) {
            if (f.mask[i] == 255)
                continue;
            real p[3], a[3], b[3], d[3], cosine = 0, place[4];
            point_of_pixel(a, &camera, &settings, i % 8, i / 8, 0);
            point_of_pixel(b, &camera, &settings, i % 8, i / 8, 1024);
            for (int k = 0; k < 3; k++)
                d[k] = b[k] - a[k];
            real from[3] = {v[0][0] - a[0], v[0][1] - a[1], v[0][2] - a[2]};
            real t = dot(normal, from) / dot(normal, d);
            for (int k = 0; k < 3; k++)
                p[k] = a[k] + t * d[k];
            place_in_light(place, &light, &settings, p);
            if (fabsl(dot(normal, d)) < 0.02L * length * sqrtl(dot(d, d)))
                continue; /* all but edge-on: snapping moves the plane */
            real border = 0.001L * settings.map_width, last = settings.map_width - border;
            if (light.kind == GN_SPOT && (place[0] < border || place[0] > last || place[1] < border ||
                                          place[1] > last || place[2] < 2 || place[2] > 65534))
                continue; /* at the frustum's border, or beyond */
            if (side > 0 && light.kind == GN_DIRECTIONAL)
                cosine = fabsl(dot(normal, to_light)) / length / sqrtl(dot(to_light, to_light));
            if (side > 0 && light.kind == GN_SPOT) {
                real l[3] = {light.position[0] - p[0], light.position[1] - p[1], light.position[2] - p[2]};
                cosine = fabsl(dot(normal, to_light)) / length / sqrtl(dot(l, l));
            }
            /* what part of it is lit, is for cascade_test to say */
            int expected_mask = side > 0 ? (settings.reconstruction ? f.mask[i] : 254) : 0;
            cosine *= expected_mask / 254.0L;
            partly[light.kind] += expected_mask > 0 && expected_mask < 254;
            lit += side > 0;
            unlit += !(side > 0);
            if (f.mask[i] != expected_mask && failures++ < 5)
                note("case %llu, pixel %d: mask %u, expected %d", (unsigned long long)n, i, (unsigned)f.mask[i],
                     expected_mask);
            real ambient = scene.ambient / 65535.0L, intensity = ambient + (1 - ambient) * cosine;
            int got[3], top[3] = {255, 255, 255};
            if (settings.format == GN_RGB565)
                top[0] = top[2] = 31, top[1] = 63;
            channels(got, &f, (size_t)i);
            real value[3] = {object.colour.r, object.colour.g, object.colour.b};
            for (int k = 0; k < 3; k++) {
                real x = value[k] / 255 * intensity * top[k], rounded = floorl(x + 0.5L);
                real beyond = fabsl(got[k] - x) - 0.5L; /* of rounding to nearest */
                all++;
                exact_channels += (real)got[k] == rounded;
                worst[light.kind] = fmaxl(worst[light.kind], beyond);
                if (!(beyond <= bound[light.kind]) && failures++ < 5)
                    note("case %llu, pixel %d, %s light, format %d, channel %d: got %d, expected %.3Lf",
                         (unsigned long long)n, i, light.kind == GN_SPOT ? "spot" : "directional", (int)settings.format,
                         k, got[k], x);
            }
        }
        if (!frame_end(&f))
            failures++;
        shape_free(&s);
    }
    ok(!failures, "colours are Lambert's within their bounds, masks equal, in %llu scenes",
       (unsigned long long)cases / 8);
    ok(lit > 500 && unlit > 500 && partly[0] > 500 && partly[1] > 500 && exact_channels * 100 > all * 99,
       "%llu lit and %llu turned-away pixels, %llu and %llu (spot) partly lit; %.3f %% of the channels are rounded "
       "right",
       (unsigned long long)lit, (unsigned long long)unlit, (unsigned long long)partly[0], (unsigned long long)partly[1],
       100.0 * (double)exact_channels / (double)all);
    note("farthest beyond rounding: %.4Lf of a step (directional), %.4Lf (spot); at most %.4Lf, %.4Lf", worst[0],
         worst[1], bound[0], bound[1]);
}

/* ---- facing ---------------------------------------------------------------------------------------------------- */

static int sign_of(exact v)
{
    return v > 0 ? 1 : v < 0 ? -1 : 0;
}

static void exact_normal(exact n[3], const shape *s)
{
    exact a[3], b[3];
    for (int i = 0; i < 3; i++) {
        a[i] = (exact)s->vertices[1][i] - s->vertices[0][i];
        b[i] = (exact)s->vertices[2][i] - s->vertices[0][i];
    }
    for (int i = 0; i < 3; i++)
        n[i] = a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3];
}

static exact exact_dot(const exact n[3], const int32_t v[3])
{
    return n[0] * v[0] + n[1] * v[1] + n[2] * v[2];
}

/* Lights in the plane of a triangle as large as the world, or one unit beside it. */
static void facing_is_decided_exactly(uint64_t cases)
{
    unsigned failures = 0;
    uint64_t in_plane = 0, beside = 0, lit = 0, unlit = 0, unseen = 0;
    for (uint64_t n = 0; n < cases / 4 && failures < 5; n++) {
        shape s = shape_new(0);
        gn_object object;
        gn_scene scene;
        gn_camera camera;
        gn_light light;
        frame f;
        exact normal[3];
        int directional = n & 1;
        /* corners p0, p0 + a, p0 + b */
        int32_t bits = between(12, 22), p0[3], a[3], b[3], middle[3], eye[3], to_light[3], to_camera[3];
        for (int i = 0; i < 3; i++) {
            p0[i] = between(-(1 << 22), 1 << 22);
            a[i] = between(-(1 << bits), 1 << bits);
            b[i] = between(-(1 << bits), 1 << bits);
            middle[i] = p0[i] + (a[i] + b[i]) / 3;
            eye[i] = between(-(1 << 25), 1 << 25);
        }
        add_vertex(&s, p0[0], p0[1], p0[2]);
        add_vertex(&s, p0[0] + a[0], p0[1] + a[1], p0[2] + a[2]);
        add_vertex(&s, p0[0] + b[0], p0[1] + b[1], p0[2] + b[2]);
        add_triangle(&s, 0, 1, 2);
        exact_normal(normal, &s);
        memset(&object, 0, sizeof object);
        memset(&scene, 0, sizeof scene);
        memset(&camera, 0, sizeof camera);
        memset(&light, 0, sizeof light);
        object.mesh = &s.mesh;
        scene.objects = &object;
        scene.object_count = 1;
        gn_status status = gn_look_at(&camera, eye, middle, y_up);
        if (status == GN_OK)
            status = gn_perspective(&camera, GN_DEGREES(1), 1 << 12, 1 << 28);
        if (directional) {
            /* forward is a multiple of a, which lies in the plane, and then one unit beside it */
            real length = sqrtl((real)a[0] * a[0] + (real)a[1] * a[1] + (real)a[2] * a[2]);
            int32_t k = length >= 1 ? (int32_t)(1073741824.0L / length) : 0;
            if (status == GN_OK)
                status = k ? gn_directional_light(&light, a, 0) : GN_OUT_OF_RANGE;
            for (int i = 0; i < 3; i++)
                light.forward[i] = k * a[i] + (between(0, 2) ? 0 : between(-1, 1));
            if (status == GN_OK)
                status = gn_fit_light(&light, &scene);
            light.box_depth = light.box_width; /* seen edge-on */
            for (int i = 0; i < 3; i++)
                to_light[i] = -light.forward[i];
        } else {
            int32_t position[3], m = between(-3, 3), k = between(-3, 3);
            if (m == 0 && k == 0)
                m = -1;
            for (int i = 0; i < 3; i++)
                position[i] = p0[i] + m * a[i] + k * b[i] + (between(0, 2) ? 0 : between(-1, 1));
            if (status == GN_OK)
                status = gn_spot_light(&light, position, middle, 0, GN_DEGREES(150), 1 << 6, 1 << 26);
            for (int i = 0; i < 3; i++)
                to_light[i] = position[i] - p0[i];
        }
        for (int i = 0; i < 3; i++)
            to_camera[i] = eye[i] - p0[i];
        int light_side = sign_of(exact_dot(normal, to_light)), camera_side = sign_of(exact_dot(normal, to_camera));
        gn_settings settings = lit_settings(1, 1, GN_NO_COLOUR);
        if (status == GN_OK)
            status = frame_start(&f, &scene, &settings);
        if (status == GN_OK) {
            status = frame_render(&f, &light, &camera);
            int expected = light_side != 0 && light_side == camera_side ? 254 : 0;
            if (status != GN_OK || f.mask[0] == 255) {
                unseen++;
            } else {
                in_plane += light_side == 0;
                beside += light_side != 0;
                lit += expected == 254;
                unlit += expected == 0;
                if (f.mask[0] != expected && failures++ < 5)
                    note("case %llu, %s light, on side %d of the plane, camera on side %d: mask %u, expected %d",
                         (unsigned long long)n, directional ? "directional" : "spot", light_side, camera_side,
                         (unsigned)f.mask[0], expected);
            }
            if (!frame_end(&f))
                failures++;
        }
        shape_free(&s);
    }
    ok(!failures, "facing is decided exactly, in %llu triangles with the light in their plane and %llu beside it",
       (unsigned long long)in_plane, (unsigned long long)beside);
    ok(in_plane > cases / 40 && beside > cases / 40 && lit > cases / 40 && unlit > cases / 40,
       "%llu lit, %llu unlit, %llu not seen", (unsigned long long)lit, (unsigned long long)unlit,
       (unsigned long long)unseen);
}

/* ---- colours by hand ------------------------------------------------------------------------------------------- */

static void colour_by_hand(const char *what, uint16_t ambient, uint8_t format, int turned, int32_t dx, int32_t dz,
                           gn_rgb c, int r, int g, int b)
{
    shape s = shape_new(0);
    gn_object object = {&s.mesh, 0, {0, 0, 0}};
    gn_scene scene = {&object, 1, {1, 2, 3}, 0};
    gn_camera camera;
    gn_light light;
    frame f;
    int32_t direction[3] = {dx, 0, dz}, eye[3] = {0, 0, turned ? -10000 : 10000}, target[3] = {0, 0, 0};
    int got[3] = {-1, -1, -1};
    add_level(&s, -9000, -9000, 9000, 9000, 0, 1);
    object.colour = c;
    scene.ambient = ambient;
    memset(&camera, 0, sizeof camera);
    gn_settings settings = lit_settings(1, 1, format);
    gn_status status = gn_look_at(&camera, eye, target, y_up);
    if (status == GN_OK)
        status = gn_perspective(&camera, GN_DEGREES(40), 1000, 100000);
    if (status == GN_OK)
        status = gn_directional_light(&light, direction, 0);
    light.box_u = light.box_v = light.box_z = -20000;
    light.box_width = light.box_height = light.box_depth = 40000;
    if (status == GN_OK)
        status = frame_start(&f, &scene, &settings);
    if (status == GN_OK) {
        status = frame_render(&f, &light, &camera);
        channels(got, &f, 0);
        frame_end(&f);
    }
    if (!ok(status == GN_OK && got[0] == r && got[1] == g && got[2] == b, "%s", what))
        note("status %d, got %d %d %d, expected %d %d %d", (int)status, got[0], got[1], got[2], r, g, b);
    shape_free(&s);
}

static void colours_by_hand(void)
{
    gn_rgb c = {200, 101, 3}, white = {255, 255, 255};
    /* 3-4-5: N.L = 4/5 */
    colour_by_hand("full light, no ambient", 0, GN_RGB888, 0, 0, -1, c, 200, 101, 3);
    colour_by_hand("cosine 0.8, no ambient", 0, GN_RGB888, 0, 3, -4, c, 160, 81, 2);
    colour_by_hand("cosine 0.6, no ambient", 0, GN_RGB888, 0, -4, -3, c, 120, 61, 2);
    colour_by_hand("turned away, no ambient", 0, GN_RGB888, 1, 3, -4, c, 0, 0, 0);
    colour_by_hand("two-sided", 0, GN_RGB888, 1, 3, 4, c, 160, 81, 2);
    colour_by_hand("ambient only, turned away", 65535, GN_RGB888, 1, 3, -4, c, 200, 101, 3);
    colour_by_hand("ambient only, lit", 65535, GN_RGB888, 0, 3, -4, c, 200, 101, 3);
    colour_by_hand("ambient 0.2, turned away", 13107, GN_RGB888, 1, 3, -4, c, 40, 20, 1);
    colour_by_hand("ambient 0.2, cosine 0.8: 0.84", 13107, GN_RGB888, 0, 3, -4, c, 168, 85, 3);
    colour_by_hand("RGB565 white", 0, GN_RGB565, 0, 0, -1, white, 31, 63, 31);
    colour_by_hand("RGB565, cosine 0.8: 24.8, 50.4, 24.8", 0, GN_RGB565, 0, 3, -4, white, 25, 50, 25);
    colour_by_hand("RGB565 of a colour: 24.3, 24.95, 0.36", 0, GN_RGB565, 0, 0, -1, c, 24, 25, 0);
    colour_by_hand("light along the surface", 0, GN_RGB888, 0, 1, 0, c, 0, 0, 0);
}

/* 2^16 is full light. The unit's fraction 65535 means 1: as much is added from one half on. */
static void intensities_are_rounded(uint64_t cases)
{
    gn_scene scene = {0, 0, {0, 0, 0}, 0};
    gn_context context;
    uint64_t failures = 0;
    memset(&context, 0, sizeof context);
    context.scene = &scene;
    for (uint64_t n = 0; n < cases; n++) {
        uint32_t cosine = (uint32_t)between(0, 0x10000), got;
        scene.ambient = (uint16_t)(n % 3 ? between(0, 65535) : 65535);
        real ambient = scene.ambient + (scene.ambient >= 32768 ? 1 : 0);
        got = gn_intensity(&context, cosine);
        failures += got != (uint32_t)floorl(ambient + (65536 - ambient) * cosine / 65536 + 0.5L);
    }
    ok(!failures, "intensities are rounded to the nearest unit: %llu of %llu are not", (unsigned long long)failures,
       (unsigned long long)cases);
}

/* ---- whole frames against rays --------------------------------------------------------------------------------- */

/* Plates over a floor: is the light hidden from a point on the floor? */
typedef struct plate {
    int32_t x0, z0, x1, z1, y;
} plate;

/* One bit a plate. */
static unsigned hidden(const plate *plates, int count, const gn_light *light, const real p[3])
{
    unsigned by = 0;
    for (int i = 0; i < count; i++) {
        real t, x, z;
        if (light->kind == GN_SPOT) {
            t = (plates[i].y - p[1]) / (light->position[1] - p[1]);
            x = p[0] + t * (light->position[0] - p[0]);
            z = p[2] + t * (light->position[2] - p[2]);
        } else {
            t = (plates[i].y - p[1]) / -light->forward[1];
            x = p[0] - t * light->forward[0];
            z = p[2] - t * light->forward[2];
        }
        if (x > plates[i].x0 && x < plates[i].x1 && z > plates[i].z0 && z < plates[i].z1)
            by |= 1u << i;
    }
    return by;
}

/* Floor pixels farther than two texels from a shadow's edge are lit or shadowed as a ray says. */
static void shadows_fall_where_rays_say(uint64_t cases)
{
    static const uint8_t surfaces[] = {GN_CONSTANT, GN_DUAL, GN_SECOND, GN_MIDPOINT, GN_MIXED};
    uint64_t lit[2] = {0, 0}, shadowed[2] = {0, 0}, outside = 0;
    unsigned failures = 0;
    for (uint64_t n = 0; n < cases / 20 && failures < 5; n++) {
        enum { SIZE = 1 << 20, PLATES = 3 };
        shape floor_shape = shape_new(0), boxes = shape_new(1);
        plate plates[PLATES];
        int32_t a[3] = {-SIZE, 0, -SIZE}, b[3] = {-SIZE, 0, SIZE}, c[3] = {SIZE, 0, SIZE}, d[3] = {SIZE, 0, -SIZE};
        gn_object objects[2] = {{&floor_shape.mesh, 0, {255, 255, 255}}, {&boxes.mesh, 0, {255, 0, 0}}};
        gn_scene scene = {objects, 2, {0, 0, 0}, 0};
        gn_camera camera;
        gn_light light;
        frame f;
        uint8_t surface = surfaces[n % 5];
        if (surface == GN_SECOND) { /* which leaves open surfaces without any bias */
            int32_t low[3] = {-SIZE, -SIZE / 2, -SIZE}, high[3] = {SIZE, 0, SIZE};
            floor_shape.mesh.closed = 1;
            add_box(&floor_shape, low, high);
        } else {
            add_quad(&floor_shape, a, b, c, d);
        }
        for (int i = 0; i < PLATES; i++) { /* closed, flat boxes high above the floor */
            plate *p = &plates[i];
            p->x0 = between(-SIZE, SIZE / 2);
            p->z0 = between(-SIZE, SIZE / 2);
            p->x1 = p->x0 + between(SIZE / 8, SIZE / 2);
            p->z1 = p->z0 + between(SIZE / 8, SIZE / 2);
            p->y = between(SIZE / 4, SIZE / 2);
            int32_t low[3] = {p->x0, p->y, p->z0}, high[3] = {p->x1, p->y + SIZE / 500, p->z1};
            add_box(&boxes, low, high);
        }
        memset(&camera, 0, sizeof camera);
        int32_t eye[3] = {between(-2 * SIZE, 2 * SIZE), between(SIZE / 16, SIZE / 5), between(-2 * SIZE, 2 * SIZE)};
        int32_t target[3] = {between(-SIZE / 2, SIZE / 2), 0, between(-SIZE / 2, SIZE / 2)};
        int32_t direction[3] = {between(-100, 100), -100, between(-100, 100)};
        int32_t position[3] = {between(-SIZE / 2, SIZE / 2), 2 * SIZE, between(-SIZE / 2, SIZE / 2)};
        gn_settings s = gn_default_settings(48, 32, 256);
        s.map_height = n & 2 ? 256 : 200;
        s.surface = surface;
        s.mask = 1;
        s.region_height = (uint16_t)between(0, 32);
        s.bias.unit = GN_BIAS_TEXELS;
        s.bias.value = 4 << 16;
        gn_status status = gn_look_at(&camera, eye, target, y_up);
        if (status == GN_OK)
            status = n % 3 ? gn_perspective(&camera, GN_DEGREES(50), SIZE / 64, 16 * SIZE)
                           : gn_orthographic(&camera, SIZE / 4, 0, 8 * SIZE);
        if (status == GN_OK)
            status = n & 1 ? gn_spot_light(&light, position, target, 0, GN_DEGREES(between(25, 70)), SIZE / 2, 4 * SIZE)
                           : gn_directional_light(&light, direction, 0);
        if (status == GN_OK && !(n & 1))
            status = gn_fit_light(&light, &scene);
        if (status == GN_OK)
            status = frame_start(&f, &scene, &s);
        if (status == GN_OK)
            status = frame_render(&f, &light, &camera);
        if (status != GN_OK && failures++ < 5)
            note("case %llu: status %d", (unsigned long long)n, (int)status);
        for (int i = 0; status == GN_OK && i < 48 * 32; i++) {
            real from[3], to[3], p[3], place[4], q[3];
            unsigned any = 0, all = ~0u;
            point_of_pixel(from, &camera, &s, i % 48, i / 48, 0);
            point_of_pixel(to, &camera, &s, i % 48, i / 48, SIZE);
            real t = from[1] / (from[1] - to[1]);
            for (int k = 0; k < 3; k++)
                p[k] = from[k] + t * (to[k] - from[k]);
            p[1] = 0;
            if (!(t > 0) || fabsl(p[0]) > SIZE - 5000 || fabsl(p[2]) > SIZE - 5000 || t * SIZE > 8 * (real)SIZE)
                continue; /* not on the floor */
            if (camera.projection == GN_PERSPECTIVE ? t * SIZE < SIZE / 60 : t * SIZE < SIZE / 100)
                continue;
            int behind = 0; /* a box before the floor: eyes stay below all plates, but rays may start beyond */
            for (int k = 0; k < PLATES; k++)
                behind |= from[1] > plates[k].y - SIZE / 100;
            if (behind)
                continue;
            place_in_light(place, &light, &s, p);
            if (light.kind == GN_SPOT &&
                (place[0] < -3 || place[0] > 259 || place[1] < -3 || place[1] > s.map_height + 3)) {
                outside++;
                if (f.mask[i] != 0 && failures++ < 5)
                    note("case %llu, pixel (%d, %d): mask %u outside the light's frustum, expected 0",
                         (unsigned long long)n, i % 48, i / 48, (unsigned)f.mask[i]);
                continue;
            }
            if (place[0] < 3 || place[0] > 253 || place[1] < 3 || place[1] > s.map_height - 3)
                continue;
            /* a texel on the floor is at most so wide */
            real texel = 2 *
                         (light.kind == GN_SPOT ? 4 * (real)SIZE * ldexpl(light.tan_half, -24) / s.map_height
                                                : (real)light.box_width / s.map_height) *
                         2;
            for (int k = 0; k < 9; k++) {
                q[0] = p[0] + (k % 3 - 1) * texel;
                q[1] = 0;
                q[2] = p[2] + (k / 3 - 1) * texel;
                any |= hidden(plates, PLATES, &light, q);
                all &= hidden(plates, PLATES, &light, q);
            }
            if (any && !all)
                continue; /* near an edge */
            int kind = light.kind == GN_SPOT;
            lit[kind] += !all;
            shadowed[kind] += all != 0;
            if (f.mask[i] != (all ? 0 : 254) && failures++ < 5)
                note("case %llu, pixel (%d, %d), %s light, %s camera, surface %d: mask %u, expected %d; texel %.2Lf, "
                     "%.2Lf",
                     (unsigned long long)n, i % 48, i / 48, kind ? "spot" : "directional",
                     camera.projection == GN_PERSPECTIVE ? "perspective" : "orthographic", (int)s.surface,
                     (unsigned)f.mask[i], all ? 0 : 254, place[0], place[1]);
        }
        if (f.block && !frame_end(&f))
            failures++;
        shape_free(&floor_shape);
        shape_free(&boxes);
    }
    ok(!failures, "shadows fall where rays say, in %llu frames", (unsigned long long)cases / 20);
    ok(lit[0] > 1000 && lit[1] > 1000 && shadowed[0] > 300 && shadowed[1] > 300 && outside > 100,
       "directional: %llu lit, %llu shadowed; spot: %llu lit, %llu shadowed, %llu outside the frustum",
       (unsigned long long)lit[0], (unsigned long long)shadowed[0], (unsigned long long)lit[1],
       (unsigned long long)shadowed[1], (unsigned long long)outside);
}

/* A wall just before the far plane of a short range, half of it behind a plate: depth may round beyond the range, but
 * must not begin again at the near plane. */
static void walls_at_the_far_plane_stay_shadowed(uint64_t cases)
{
    uint64_t wrong = 0, lit = 0, shadowed = 0;
    for (uint64_t n = 0; n < cases / 50; n++) {
        enum { NEAR = 1 << 20 };
        int32_t far_depth = NEAR + (NEAR >> between(0, 4)) + between(0, NEAR / 16);
        shape wall = shape_new(0), cover = shape_new(0);
        gn_object objects[2] = {{&wall.mesh, 0, {255, 255, 255}}, {&cover.mesh, 0, {255, 0, 0}}};
        gn_scene scene = {objects, 2, {0, 0, 0}, 0};
        gn_camera camera;
        gn_light light;
        frame f;
        int32_t origin[3] = {0, 0, 0}, target[3] = {0, 0, -1000};
        memset(&camera, 0, sizeof camera);
        gn_settings s = gn_default_settings(32, 8, 64);
        s.surface = GN_CONSTANT;
        s.bias.unit = GN_BIAS_RANGE;
        s.bias.value = 1 << 20;
        s.mask = 1;
        gn_status status = gn_spot_light(&light, origin, target, 0, GN_DEGREES(60), NEAR, far_depth);
        /* the camera stands between plate and wall */
        int32_t eye[3] = {0, 0, -NEAR - NEAR / 200}, at[3] = {0, 0, -2 * NEAR};
        if (status == GN_OK)
            status = gn_look_at(&camera, eye, at, y_up);
        if (status == GN_OK)
            status = gn_orthographic(&camera, NEAR / 8, 0, 2 * NEAR);
        add_level(&wall, -8 * NEAR, -8 * NEAR, 8 * NEAR, 8 * NEAR, -far_depth + between(1, 12), 1);
        /* from the light it hides the wall's x < 0 */
        add_level(&cover, -NEAR / 2, -NEAR / 2, 0, NEAR / 2, -NEAR - NEAR / 1000, 1);
        if (status == GN_OK)
            status = frame_start(&f, &scene, &s);
        if (status == GN_OK)
            status = frame_render(&f, &light, &camera);
        if (status != GN_OK && wrong++ < 5)
            note("case %llu: status %d", (unsigned long long)n, (int)status);
        for (int i = 0; status == GN_OK && i < 32 * 8; i++) {
            real p[3];
            point_of_pixel(p, &camera, &s, i % 32, i / 32, far_depth + (real)eye[2]);
            lit += f.mask[i] == 254;
            if (p[0] < -far_depth / 50.0L) {
                shadowed++;
                if (f.mask[i] != 0 && wrong++ < 5)
                    note("case %llu, far / near %.4Lf, pixel (%d, %d): mask %u, expected 0", (unsigned long long)n,
                         far_depth / (real)NEAR, i % 32, i / 32, (unsigned)f.mask[i]);
            }
        }
        if (status == GN_OK)
            frame_end(&f);
        shape_free(&wall);
        shape_free(&cover);
    }
    ok(!wrong, "walls at the far plane stay shadowed");
    ok(shadowed > 1000 && lit > 1000, "%llu shadowed, %llu lit", (unsigned long long)shadowed, (unsigned long long)lit);
}

/* ---- ties ------------------------------------------------------------------------------------------------------ */

/* Depths as the light pass stores them: the map's own depth is lit, the next one behind it is not. */
static void ties_are_lit(uint64_t cases)
{
    uint64_t shadowed = 0, own = 0;
    for (uint64_t n = 0; n < cases; n++) {
        uint32_t bits = (uint32_t)between(0, 14), z = (uint32_t)between(0, (1 << (16 + bits)) - 1);
        uint32_t step = GN_DEPTH_BITS == 16 ? 1 : 1u << (16 - bits);
        gn_depth stored = (gn_depth)(GN_DEPTH_BITS == 16 ? z >> bits : z << (16 - bits));
        own += (int32_t)gn_compare(gn_cut_raw(z, bits), stored) < 0;
        shadowed += stored < step || (int32_t)gn_compare(gn_cut_raw(z, bits), (gn_depth)(stored - step)) < 0;
    }
    ok(!own, "what lies at the map's own depth is lit: %llu of %llu are not", (unsigned long long)own,
       (unsigned long long)cases);
    ok(shadowed == cases, "what lies one step behind it is not: %llu of %llu", (unsigned long long)shadowed,
       (unsigned long long)cases);
}

int main(int argc, char **argv)
{
    uint64_t cases = tap_cases(argc, argv, 40000);
    colours_by_hand();
    intensities_are_rounded(cases);
    ties_are_lit(cases);
    places_in_light_space_keep_their_bounds(cases);
    colours_are_lambert(cases);
    facing_is_decided_exactly(cases);
    shadows_fall_where_rays_say(cases);
    walls_at_the_far_plane_stay_shadowed(cases);
    return tap_done();
}
