/* Point lights: which face and texel a pixel's point lies on, against long double; maps with borders, against a cast of
 * every texel; one map at a time, skipped faces, regions, workers and orders, against each other, bit for bit. Cases of
 * places: 20000, or GNOMON_CASES. */
#include "gn_drawing.h"
#include "gn_point_light.h"
#include "point_scene.h"

/* ---- places ------------------------------------------------------------------------------------------------------ */

typedef struct tally {
    unsigned cases, lit, unlit, failures;
    real texels, depth, nearness;
} tally;

static void check_point(tally *t, const frame *f, const gn_points *points, uint32_t q, const real v[3], real error,
                        const gn_light *light, uint32_t border)
{
    real ratio[2], margin, m = 0;
    int face = face_of(v, ratio, &margin);
    for (int i = 0; i < 3; i++)
        m = fmaxl(m, fabsl(v[i]));
    int nowhere = points->u[0] == GN_NOWHERE;
    t->cases++;
    if (m < light->near_depth - error || m > light->far_depth * (1 + ldexpl(1, -16)) + error) {
        t->unlit++;
        t->failures += !nowhere || points->z[0] != 0xffffffffu || q != 0;
        return;
    }
    if (m < light->near_depth + error || m > light->far_depth - error)
        return;
    t->lit++;
    const gn_settings *settings = &f->settings;
    real column = ldexpl((int32_t)points->u[0], -GN_FACE_BITS) + 0.5L,
         row = ldexpl((int32_t)points->v[0], -GN_FACE_BITS) + 0.5L;
    uint32_t found = (uint32_t)(row / settings->map_height);
    row -= found * settings->map_height;
    /* on one face, whichever that is, and never nearer to its end than its border */
    real beyond_x = fabsl(column - settings->map_width / 2.0L) - (settings->map_width / 2.0L - border);
    real beyond_y = fabsl(row - settings->map_height / 2.0L) - (settings->map_height / 2.0L - border);
    if (nowhere || found >= FACES || beyond_x > 0.001L || beyond_y > 0.001L) {
        t->failures++;
        return;
    }
    if ((int)found != face) {
        t->failures += margin > 4 * error;
        return;
    }
    real half = settings->map_width / 2.0L - border, places = half * (4 * error / m + ldexpl(1, -17)) + ldexpl(3, -16);
    real wrong = fmaxl(fabsl(column - settings->map_width / 2.0L - half * ratio[0]),
                       fabsl(row - settings->map_height / 2.0L - half * ratio[1]));
    real n = light->near_depth, far_depth = light->far_depth, share = far_depth / (far_depth - n);
    real z = ldexpl(GN_DEPTH_GUARD + GN_DEPTH_SPAN * share * (1 - n / m), 1),
         of_z = fabsl(z - points->z[0]) / ldexpl(1, 32);
    real length = sqrtl(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]), near_by = fabsl(ldexpl(q, -30) * length / n - 1);
    t->texels = fmaxl(t->texels, wrong / places);
    t->depth = fmaxl(t->depth, of_z / (share * (2 * error / m + ldexpl(1, -17)) + ldexpl(1, -14)));
    t->nearness = fmaxl(t->nearness, near_by / (4 * error / m + ldexpl(1, -10)));
}

/* Random distances along random pixels' rays, in scenes that do not matter. */
static void points_lie_on_the_face_of_their_largest_coordinate(uint64_t cases)
{
    stage s;
    tally t = {0};
    set_stage(&s);
    s.settings.region_width = WIDTH;
    for (uint64_t i = 0; i < cases; i++) {
        frame f;
        gn_camera camera;
        gn_settings settings = s.settings;
        settings.reconstruction = reconstructions[i % RECONSTRUCTIONS];
        set_camera(&camera, (int)(i % 5));
        if (camera.projection == GN_ORTHOGRAPHIC)
            continue; /* W is not a distance */
        if (frame_start(&f, &s.scene, &settings) != GN_OK || gn_light_faces(f.context, &s.light) != GN_OK ||
            gn_camera_begin(f.context, &camera) != GN_OK) {
            t.failures++;
            frame_end(&f);
            break;
        }
        const gn_shading *shading = &f.context->shading;
        real unit = ldexpl(camera.near_depth, shading->w_shift - 31);
        real error = ((WIDTH + HEIGHT) / 4.0L + 8) * s.light.near_depth / shading->near_w;
        uint32_t texels = settings.reconstruction ? settings.reconstruction->votes : 4, border = 1;
        while ((2 * border - 1) * (2 * border - 1) < texels)
            border++;
        for (int k = 0; k < 400; k++) {
            gn_points points;
            uint32_t q = (uint32_t)tap_random(&random_state) >> between(1, 12);
            real w = q * unit, tangent = ldexpl(camera.tan_half, -24), v[3];
            points.x = between(0, WIDTH - 1), points.y = between(0, HEIGHT - 1), points.count = 1;
            real x = (2 * points.x + 1 - WIDTH) * w * tangent / HEIGHT,
                 y = (HEIGHT - 2 * points.y - 1) * w * tangent / HEIGHT;
            for (int a = 0; a < 3; a++)
                v[a] = camera.eye[a] - s.light.position[a] +
                       ldexpl(w * camera.forward[a] + x * camera.right[a] + y * camera.up[a], -30);
            gn_start_points(f.context, &points);
            gn_find_points(f.context, &points, &q);
            check_point(&t, &f, &points, q, v, error, &s.light, border);
        }
        t.failures += !frame_end(&f);
    }
    free_stage(&s);
    note("%u points: %u in range, %u beyond; errors over their bounds: place "
         "%.3Lf, "
         "depth %.3Lf, distance %.3Lf",
         t.cases, t.lit, t.unlit, t.texels, t.depth, t.nearness);
    ok(t.failures == 0 && t.lit > 100 && t.unlit > 100, "points_lie_on_one_face_that_of_their_largest_coordinate");
    ok(t.texels <= 1 && t.depth <= 1 && t.nearness <= 1, "at_the_place_depth_and_distance_of_long_double");
}

static uint32_t find_face(const gn_shading *s, const uint32_t place[3], uint32_t magnitude[3])
{
    gn_face_place p = gn_find_face(s, place[0], place[1], place[2]);
    for (int i = 0; i < 3; i++)
        magnitude[i] = p.magnitude[i];
    return p.face;
}

/* Points exactly between faces, and the two that are a unit to the side. */
static void ties_have_a_rule(void)
{
    gn_shading s;
    memset(&s, 0, sizeof s);
    s.near_w = 100;
    s.far_w = 100000;
    unsigned wrong = 0;
    for (int i = 0; i < 8; i++) {
        int32_t v[3] = {i & 1 ? -5000 : 5000, i & 2 ? -5000 : 5000, i & 4 ? -5000 : 5000};
        uint32_t place[3] = {(uint32_t)v[0], (uint32_t)v[1], (uint32_t)v[2]}, m[3];
        wrong += find_face(&s, place, m) != (uint32_t)(i & 1) || m[0] != 5000 || m[1] != 5000 || m[2] != 5000;
        place[0] = 100, place[1] = (uint32_t)v[1], place[2] = (uint32_t)v[2];
        wrong += find_face(&s, place, m) != (uint32_t)(2 + (i >> 1 & 1)) || m[0] != 5000 || m[1] != 5000 || m[2] != 100;
        place[1] = (uint32_t)(v[1] > 0 ? v[1] - 1 : v[1] + 1);
        wrong += find_face(&s, place, m) != (uint32_t)(4 + (i >> 2)) || m[0] != 5000 || m[1] != 100 || m[2] != 4999;
    }
    ok(wrong == 0, "of_equal_coordinates_the_first_has_the_point");
    uint32_t near_by[3] = {99, 3, 4}, on_near[3] = {3, 0u - 100u, 4}, on_far[3] = {100000, 3, 100000},
             beyond[3] = {3, 100001, 4}, m[3];
    ok(find_face(&s, near_by, m) == GN_NO_FACE && find_face(&s, on_near, m) == 3 && find_face(&s, on_far, m) == 0 &&
           find_face(&s, beyond, m) == GN_NO_FACE,
       "near_and_far_belong_to_what_is_lit");
}

/* ---- maps -------------------------------------------------------------------------------------------------------- */

/* Nearest depth along a texel's ray beyond the near plane, and whether a texel's width decides on it. */
static real cast(const gn_scene *scene, const int32_t from[3], const real d[3], real near_depth, int *open)
{
    real least = 0;
    for (uint32_t o = 0; o < scene->object_count; o++)
        for (uint32_t t = 0; t < scene->objects[o].mesh->triangle_count; t++) {
            int32_t world[3][3];
            real inside = 0;
            (void)gn_triangle_world(&scene->objects[o], t, world);
            real w = meet(world, from, d, &inside);
            if (w < near_depth * 0.999L || inside < -0.02L)
                continue;
            *open |= (inside < 0.02L || w < near_depth * 1.001L) && (least == 0 || w < least * 1.01L);
            if (inside >= 0 && w >= near_depth && (least == 0 || w < least))
                least = w;
        }
    return least;
}

/* Every texel, those of the border too, holds what lies on its own ray. */
static void borders_hold_true_depths(void)
{
    stage s;
    frame f;
    unsigned compared[2] = {0, 0}, wrong[2] = {0, 0}, casters = 0;
    set_stage(&s);
    gn_settings settings = s.settings;
    settings.surface = GN_CONSTANT;
    settings.bias.value = 0;
    settings.reconstruction = &gn_box_7x7; /* four texels of border */
    enum { BORDER = 4 };
    ok(frame_start(&f, &s.scene, &settings) == GN_OK && gn_light_faces(f.context, &s.light) == GN_OK,
       "six_maps_are_drawn");
    for (uint32_t face = 0; face < FACES; face++)
        for (uint32_t row = 0; row < MAP; row++)
            for (uint32_t column = 0; column < MAP; column++) {
                real half = MAP / 2.0L - BORDER, x = (column + 0.5L - MAP / 2.0L) / half,
                     y = (row + 0.5L - MAP / 2.0L) / half;
                int axis = (int)face / 2, sign = face & 1 ? -1 : 1, open = 0;
                real d[3];
                d[axis] = sign;
                d[(axis + 1) % 3] = -sign * x;
                d[(axis + 2) % 3] = -y;
                real w = cast(&s.scene, centre, d, s.light.near_depth, &open), n = s.light.near_depth,
                     far_depth = s.light.far_depth;
                if (open)
                    continue;
                const gn_depth *texel =
                    f.context->point->map + (size_t)(face * MAP + row) * f.context->map_stride + column;
                real z = (GN_DEPTH_GUARD + GN_DEPTH_SPAN * far_depth / (far_depth - n) * (1 - n / w)) / 0x80000000u;
                int outer = fabsl(x) > 1 || fabsl(y) > 1;
                compared[outer]++;
                casters += w < REACH / 2;
                if (w == 0 ? *texel != GN_FARTHEST : fabsl(ldexpl(*texel, -GN_DEPTH_BITS) - z) > 0.001L)
                    wrong[outer]++;
            }
    note("texels within the faces: %u, %u wrong; in their borders: %u, %u wrong; %u hold near casters", compared[0],
         wrong[0], compared[1], wrong[1], casters);
    ok(compared[0] > 3000 && compared[1] > 1000 && casters > 1000 && wrong[0] + wrong[1] == 0,
       "every_texel_of_a_face_and_of_its_border_holds_the_depth_on_its_ray");
    ok(frame_end(&f), "and_nothing_beside_the_block_was_written");
    free_stage(&s);
}

/* The outermost texels of a face: of use only to the light pass. */
static void set_ring(gn_context *context, gn_depth value, uint8_t drawn)
{
    gn_point *point = context->point;
    for (uint32_t row = 0; row < FACES * MAP; row++)
        for (uint32_t column = 0; column < MAP; column++)
            if (column == 0 || column == MAP - 1 || row % MAP == 0 || row % MAP == MAP - 1) {
                point->map[row * context->map_stride + column] = value;
                if (context->drawn)
                    point->drawn_map[row * MAP + column] = drawn;
            }
}

static void no_reconstruction_reads_the_end_of_a_face(void)
{
    stage s;
    set_stage(&s);
    unsigned differ = 0, pixels = 0;
    for (int i = 1; i < RECONSTRUCTIONS; i++)
        for (int which = 0; which < 5; which++) {
            frame f;
            gn_camera camera;
            gn_settings settings = s.settings;
            settings.reconstruction = reconstructions[i];
            set_camera(&camera, which);
            if (render(&f, &s, &settings, &camera) != GN_OK) {
                differ++;
                frame_end(&f);
                continue;
            }
            uint8_t *mask = grown(0, mask_bytes(&f));
            memcpy(mask, f.mask, mask_bytes(&f));
            set_ring(f.context, 0, 0x12);
            differ += gn_camera_pass(f.context, &camera, frame_flush, &f) != GN_OK;
            for (size_t k = 0; k < mask_bytes(&f); k++)
                differ += mask[k] != f.mask[k];
            set_ring(f.context, GN_FARTHEST, 0xef);
            differ += gn_camera_pass(f.context, &camera, frame_flush, &f) != GN_OK;
            for (size_t k = 0; k < mask_bytes(&f); k++)
                differ += mask[k] != f.mask[k];
            pixels += (unsigned)mask_bytes(&f);
            free(mask);
            differ += !frame_end(&f);
        }
    ok(differ == 0 && pixels > 0, "no_reconstruction_reads_the_outermost_texels_of_a_face");
    free_stage(&s);
}

/* ---- pictures ---------------------------------------------------------------------------------------------------- */

static void one_map_at_a_time_gives_the_same_picture(void)
{
    stage s;
    set_stage(&s);
    unsigned cases = 0, differ = 0;
    uint64_t lit = 0, shadowed = 0;
    size_t six_bytes = 0, one_bytes = 0;
    for (int receiver = 0; receiver < RECEIVERS; receiver++)
        for (int i = 0; i < RECONSTRUCTIONS; i++)
            for (int surface = GN_CONSTANT; surface <= GN_SLOPE; surface++) {
                frame six, one;
                gn_camera camera;
                gn_settings settings = s.settings;
                settings.receiver = receivers[receiver];
                settings.reconstruction = reconstructions[i];
                settings.surface = (uint8_t)surface;
                settings.slope = 2 << 16;
                settings.format = cases % 2 ? GN_RGB565 : GN_RGB888;
                settings.region_width = (uint16_t)(cases % 3 ? 37 : 0);
                settings.map_rows = (uint16_t)(cases % 4 ? 0 : 11);
                set_camera(&camera, (int)(cases % 5));
                int good = render(&six, &s, &settings, &camera) == GN_OK;
                settings.faces = &gn_one_face;
                good &= render(&one, &s, &settings, &camera) == GN_OK;
                cases++;
                differ += !good || !same_pictures(&six, &one);
                if (good) {
                    count_mask(&six, &lit, &shadowed);
                    six_bytes = six.plan.map_bytes;
                    one_bytes = one.plan.map_bytes;
                }
                differ += !frame_end(&six) | !frame_end(&one);
            }
    note("%u pictures, %llu pixels lit, %llu shadowed", cases, (unsigned long long)lit, (unsigned long long)shadowed);
    ok(differ == 0 && lit > 10000 && shadowed > 10000, "one_map_at_a_time_gives_the_pictures_of_six_bit_for_bit");
    ok(six_bytes == 6 * one_bytes && one_bytes > 0, "and_the_plan_says_six_times_the_bytes_for_six_maps");
    free_stage(&s);
}

/* The faces in any order, their regions on any worker. */
static gn_status draw_in_another_order(frame *f, const stage *s)
{
    static const uint32_t order[FACES] = {3, 0, 5, 1, 4, 2};
    for (uint32_t i = 0; i < FACES; i++) {
        uint32_t regions = 0;
        gn_status status = gn_light_face(f->context, &s->light, order[i], &regions);
        for (uint32_t k = regions; status == GN_OK && k-- > 0;) {
            status = gn_light_layers(f->context, k, k % 3);
            if (status == GN_OK)
                status = gn_light_resolve(f->context, k, k % 3);
        }
        if (status != GN_OK)
            return status;
    }
    return GN_OK;
}

static gn_status see_in_another_order(frame *f, const gn_camera *camera)
{
    gn_status status = gn_camera_begin(f->context, camera);
    for (uint32_t i = f->plan.camera_regions; status == GN_OK && i-- > 0;) {
        gn_pixels pixels;
        status = gn_camera_region(f->context, i, i % 3, f->context->colour_buffer, f->context->mask_buffer, &pixels);
        if (status == GN_OK)
            (void)frame_flush(f, &pixels);
    }
    return status;
}

static void reverse_triangles(shape *s)
{
    for (uint32_t a = 0, b = s->mesh.triangle_count - 1; a < b; a++, b--)
        for (int i = 0; i < 3; i++) {
            uint32_t index = s->indices[3 * a + (uint32_t)i];
            s->indices[3 * a + (uint32_t)i] = s->indices[3 * b + (uint32_t)i];
            s->indices[3 * b + (uint32_t)i] = index;
        }
    free(edges_of(s));
    make_edges(s);
}

static void no_order_changes_a_pixel(void)
{
    stage s;
    set_stage(&s);
    unsigned orders = 0, passes = 0, triangles = 0;
    for (int i = 0; i < RECONSTRUCTIONS; i++) {
        frame plain, other;
        gn_camera camera;
        gn_settings settings = s.settings;
        settings.reconstruction = reconstructions[i];
        set_camera(&camera, i % 5);
        int good = render(&plain, &s, &settings, &camera) == GN_OK;
        settings.map_rows = 7;
        settings.region_width = 41;
        settings.region_height = 9;
        good &= frame_start(&other, &s.scene, &settings) == GN_OK && draw_in_another_order(&other, &s) == GN_OK &&
                see_in_another_order(&other, &camera) == GN_OK;
        orders += !good || !same_pictures(&plain, &other);
        /* in one pass, which leaves out the faces that light nothing in view */
        good &= gn_point_pass(other.context, &s.light, &camera, frame_flush, &other) == GN_OK;
        passes += !good || !same_pictures(&plain, &other);
        orders += !frame_end(&other);
        reverse_triangles(&s.sphere);
        reverse_triangles(&s.boxes);
        good = render(&other, &s, &settings, &camera) == GN_OK;
        triangles += !good || memcmp(plain.mask, other.mask, mask_bytes(&plain)) != 0;
        orders += !frame_end(&plain) | !frame_end(&other);
    }
    ok(orders == 0, "no_order_of_faces_regions_and_workers_changes_a_pixel");
    ok(passes == 0, "and_the_pass_that_leaves_out_faces_gives_the_same_pictures");
    ok(triangles == 0, "and_so_does_the_opposite_order_of_triangles");
    free_stage(&s);
}

static uint64_t skipped_so_far(const frame *f)
{
    gn_statistics statistics;
    gn_get_statistics(f->context, &statistics);
    return statistics.faces_skipped;
}

/* One box above the light and a floor below it: nothing on four sides. */
static void skipped_faces_change_no_pixel(void)
{
    static const int32_t low[3] = {-900, 2000, -900}, high[3] = {800, 2600, 700}, zero[3] = {0, 0, 0},
                         eye[3] = {1500, 2500, 6000}, up[3] = {0, 1, 0};
    stage s;
    frame f;
    gn_camera camera;
    uint32_t skips = 0, expected = 0, wrong = 0;
    set_stage(&s);
    shape box = shape_new(1);
    add_box(&box, low, high);
    make_edges(&box);
    shape floor = shape_new(0);
    const int32_t a[3] = {-2000, -3000, -2000}, b[3] = {-2000, -3000, 2000}, c[3] = {2000, -3000, 2000},
                  d[3] = {2000, -3000, -2000};
    add_quad(&floor, a, b, c, d);
    gn_object objects[2] = {{&box.mesh, 0, {200, 100, 50}}, {&floor.mesh, 0, {255, 255, 255}}};
    s.scene.objects = objects;
    s.scene.object_count = 2;
    (void)gn_point_light(&s.light, zero, 100, 20000);
    memset(&camera, 0, sizeof camera);
    (void)gn_look_at(&camera, eye, zero, up);
    (void)gn_perspective(&camera, GN_DEGREES(75), 100, 40000);
    s.settings.reconstruction = &gn_silhouettes;
    int good = frame_start(&f, &s.scene, &s.settings) == GN_OK;
    for (uint32_t face = 0; good && face < FACES; face++) {
        uint32_t regions = 99;
        good = gn_light_face(f.context, &s.light, face, &regions) == GN_OK;
        skips |= (uint32_t)(regions == 0) << face;
        for (uint32_t i = 0; good && i < regions; i++)
            good = gn_light_layers(f.context, i, 0) == GN_OK && gn_light_resolve(f.context, i, 0) == GN_OK;
    }
    expected = 0x33; /* all but -y and +y */
    ok(good && skips == expected, "faces_that_no_caster_reaches_are_skipped");
#if GN_STATISTICS
    ok(good && skipped_so_far(&f) == 4, "and_counted");
#endif
    good = good && gn_camera_pass(f.context, &camera, frame_flush, &f) == GN_OK;
    uint8_t *mask = grown(0, mask_bytes(&f));
    memcpy(mask, f.mask, mask_bytes(&f));
    /* all regions of all faces all the same */
    for (uint32_t face = 0; good && face < FACES; face++) {
        uint32_t regions;
        good = gn_light_face(f.context, &s.light, face, &regions) == GN_OK;
        size_t texels = (size_t)MAP * f.context->map_stride;
        gn_depth *before = grown(0, texels * sizeof *before);
        uint8_t *drawn = grown(0, (size_t)MAP * MAP);
        memcpy(before, f.context->map, texels * sizeof *before);
        memcpy(drawn, f.context->drawn->map, (size_t)MAP * MAP);
        for (uint32_t i = 0; good && i < f.plan.light_regions; i++)
            good = gn_light_layers(f.context, i, 0) == GN_OK && gn_light_resolve(f.context, i, 0) == GN_OK;
        if (!regions)
            for (uint32_t i = 0; i < MAP * MAP; i++) {
                size_t at = i / MAP * f.context->map_stride + i % MAP;
                wrong += before[at] != f.context->map[at] || drawn[i] != f.context->drawn->map[i];
            }
        free(before);
        free(drawn);
    }
    good = good && gn_camera_pass(f.context, &camera, frame_flush, &f) == GN_OK;
    uint64_t lit = 0, shadowed = 0;
    count_mask(&f, &lit, &shadowed);
    note("%u texels differ; %llu pixels lit, %llu shadowed", wrong, (unsigned long long)lit,
         (unsigned long long)shadowed);
    ok(good && wrong == 0 && memcmp(mask, f.mask, mask_bytes(&f)) == 0 && lit > 50 && shadowed > 50,
       "a_skipped_face_has_the_map_that_drawing_it_makes");
    unsigned differ = 0;
    for (int i = 0; i < RECONSTRUCTIONS; i++) {
        frame six, one;
        s.settings.reconstruction = reconstructions[i];
        s.settings.faces = &gn_six_faces;
        good &= render(&six, &s, &s.settings, &camera) == GN_OK;
        s.settings.faces = &gn_one_face;
        good &= render(&one, &s, &s.settings, &camera) == GN_OK;
        differ += !good || !same_pictures(&six, &one);
        differ += !frame_end(&six) | !frame_end(&one);
    }
    ok(differ == 0, "and_with_one_map_what_skipped_faces_light_is_lit_as_well");
    free(mask);
    ok(frame_end(&f), "nothing_beside_the_block_was_written_by_either");
    free(edges_of(&box));
    shape_free(&box);
    shape_free(&floor);
    free_stage(&s);
}

/* Of a plane that goes across three faces no pixel is shadowed by it, and no colour jumps. */
static void a_lone_plane_across_three_faces_has_no_seam(void)
{
    static const int32_t light_place[3] = {1000, 2000, 3000}, eye[3] = {-5000, -3000, 9000},
                         target[3] = {90000, 91000, 92000}, up[3] = {0, 0, 1};
    const int32_t a[3] = {600000, -180000, -180000}, b[3] = {-180000, 600000, -180000},
                  c[3] = {-180000, -180000, 600000};
    stage s;
    gn_camera camera;
    set_stage(&s);
    shape plane = shape_new(0);
    uint32_t first = add_vertex(&plane, a[0], a[1], a[2]);
    add_vertex(&plane, b[0], b[1], b[2]);
    add_vertex(&plane, c[0], c[1], c[2]);
    add_triangle(&plane, first, first + 1, first + 2);
    make_edges(&plane);
    gn_object object = {&plane.mesh, 0, {255, 255, 255}};
    s.scene.objects = &object;
    s.scene.object_count = 1;
    (void)gn_point_light(&s.light, light_place, 1000, 1000000);
    memset(&camera, 0, sizeof camera);
    (void)gn_look_at(&camera, eye, target, up);
    (void)gn_perspective(&camera, GN_DEGREES(80), 500, 2000000);
    unsigned pixels = 0, dark = 0, jumps = 0, bad = 0, wrong = 0, cases = 0, faces = 0;
    for (int receiver = 0; receiver < RECEIVERS; receiver++)
        for (int i = 0; i < RECONSTRUCTIONS; i++)
            for (int surface = GN_CONSTANT; surface <= GN_SLOPE; surface++) {
                frame f;
                gn_settings settings = s.settings;
                settings.receiver = receivers[receiver];
                settings.reconstruction = reconstructions[i];
                settings.surface = (uint8_t)surface;
                settings.map_width = settings.map_height = 64;
                settings.slope = 4 << 16;
                int by_point = receiver < 2; /* a bias is all that they have: as a filter asks for */
                settings.bias.unit = GN_BIAS_TEXELS;
                settings.bias.value = by_point ? 12 << 16 : 0;
                if (by_point && surface == GN_MIDPOINT)
                    continue; /* takes none */
                cases++;
                if (render(&f, &s, &settings, &camera) != GN_OK) {
                    bad++;
                    frame_end(&f);
                    continue;
                }
                for (int y = 0; y < HEIGHT; y++)
                    for (int x = 0; x < WIDTH; x++) {
                        size_t k = (size_t)y * WIDTH + (size_t)x;
                        if (f.mask[k] == 255)
                            continue;
                        pixels++;
                        dark += f.mask[k] != 254;
                        int beside = x ? f.colour[3 * k] - f.colour[3 * k - 3] : 0;
                        jumps += x && f.mask[k - 1] != 255 && (beside < -3 || beside > 3);
                    }
                bad += !frame_end(&f);
            }
    /* the same by hand: N.L of the plane x + y + z = 240000 */
    frame f;
    gn_settings settings = s.settings;
    uint32_t seen = 0;
    if (render(&f, &s, &settings, &camera) == GN_OK)
        for (int y = 0; y < HEIGHT; y++)
            for (int x = 0; x < WIDTH; x++) {
                size_t k = (size_t)y * WIDTH + (size_t)x;
                real d[3], sum = 0, at_eye = 0, v[3], square = 0, ratio[2], margin, h = 0;
                real half = ldexpl(camera.tan_half, -24), right = (2 * x + 1 - WIDTH) * half / HEIGHT,
                     top = (HEIGHT - 2 * y - 1) * half / HEIGHT;
                for (int i = 0; i < 3; i++) {
                    d[i] = ldexpl(camera.forward[i] + right * camera.right[i] + top * camera.up[i], -30);
                    sum += d[i];
                    at_eye += camera.eye[i];
                }
                if (f.mask[k] == 255)
                    continue;
                for (int i = 0; i < 3; i++) {
                    v[i] = camera.eye[i] + d[i] * (240000 - at_eye) / sum - light_place[i];
                    square += v[i] * v[i];
                    h += v[i] / sqrtl(3);
                }
                seen |= 1u << face_of(v, ratio, &margin);
                real ambient = 9000 / 65535.0L, expected = 255 * (ambient + (1 - ambient) * h / sqrtl(square));
                wrong += fabsl(f.colour[3 * k] - expected) > 1.01L;
                faces++;
            }
    bad += !frame_end(&f);
    note("%u pictures, %u pixels: %u not fully lit, %u jumps of colour", cases, pixels, dark, jumps);
    ok(bad == 0 && pixels > 1000 * cases && dark == 0, "a_plane_across_three_faces_is_all_lit_by_every_method");
    ok(jumps == 0, "and_no_colour_jumps_from_a_pixel_to_the_next");
    ok(faces > 1000 && seen == 0x15 && wrong == 0, "its_colours_are_those_of_long_double_on_all_three");
    free(edges_of(&plane));
    shape_free(&plane);
    free_stage(&s);
}

/* Where one caster has moved, the faces that it left and entered are enough. */
static void faces_stay_while_the_light_does(void)
{
    stage s;
    frame f, anew;
    gn_camera camera;
    uint32_t regions;
    set_stage(&s);
    static const int32_t low[3] = {REACH / 4, -REACH / 20, -REACH / 20}, high[3] = {REACH / 3, REACH / 20, REACH / 20};
    shape box = shape_new(1);
    gn_model model;
    add_box(&box, low, high);
    gn_model_identity(&model);
    gn_object objects[4] = {s.objects[0], s.objects[1], s.objects[2], {&box.mesh, &model, {9, 9, 9}}};
    s.scene.objects = objects;
    s.scene.object_count = 4;
    set_camera(&camera, 4);
    int good = frame_start(&f, &s.scene, &s.settings) == GN_OK && gn_light_faces(f.context, &s.light) == GN_OK &&
               gn_camera_pass(f.context, &camera, frame_flush, &f) == GN_OK;
    uint8_t *mask = grown(0, mask_bytes(&f));
    memcpy(mask, f.mask, mask_bytes(&f));
    (void)gn_model_translate(&model, -REACH * 3 / 5, 0, 0); /* from +x to -x */
    for (uint32_t face = 0; good && face < 2; face++) {
        good = gn_light_face(f.context, &s.light, face, &regions) == GN_OK;
        for (uint32_t i = 0; good && i < regions; i++)
            good = gn_light_layers(f.context, i, 0) == GN_OK && gn_light_resolve(f.context, i, 0) == GN_OK;
    }
    good = good && gn_camera_pass(f.context, &camera, frame_flush, &f) == GN_OK;
    good = render(&anew, &s, &s.settings, &camera) == GN_OK && good;
    ok(good && same_pictures(&f, &anew) && memcmp(mask, f.mask, mask_bytes(&f)) != 0,
       "two_faces_drawn_anew_are_enough_for_a_caster_that_moves_from_one_to_the_other");
    /* another light forgets all */
    gn_light moved = s.light;
    moved.position[1]++;
    good = gn_light_face(f.context, &moved, 0, &regions) == GN_OK;
    for (uint32_t i = 0; good && i < regions; i++)
        good = gn_light_layers(f.context, i, 0) == GN_OK && gn_light_resolve(f.context, i, 0) == GN_OK;
    ok(good && gn_camera_begin(f.context, &camera) == GN_NOT_READY, "a_light_that_has_moved_needs_all_six_again");
    free(mask);
    ok(frame_end(&f) && frame_end(&anew), "nothing_beside_the_blocks_was_written");
    shape_free(&box);
    free_stage(&s);
}

/* ---- statuses ---------------------------------------------------------------------------------------------------- */

static void lights_are_made(void)
{
    static const int32_t far_off[3] = {0, GN_EYE_MAX + 1, 0};
    gn_light light;
    memset(&light, 0x7f, sizeof light);
    ok(gn_point_light(&light, centre, 5, 900) == GN_OK && light.kind == GN_POINT && light.near_depth == 5 &&
           light.far_depth == 900 && memcmp(light.position, centre, sizeof centre) == 0,
       "a_point_light_has_a_position_and_depths");
    ok(gn_point_light(0, centre, 5, 900) == GN_BAD_ARGUMENT && gn_point_light(&light, 0, 5, 900) == GN_BAD_ARGUMENT,
       "null_is_a_bad_argument");
    ok(gn_point_light(&light, far_off, 5, 900) == GN_OUT_OF_RANGE &&
           gn_point_light(&light, centre, 0, 900) == GN_OUT_OF_RANGE &&
           gn_point_light(&light, centre, 900, 900) == GN_OUT_OF_RANGE &&
           gn_point_light(&light, centre, 1, (1 << 28) + 1) == GN_OUT_OF_RANGE && light.far_depth == 900,
       "places_and_depths_have_ranges_and_a_refused_light_stays_as_it_is");
    ok(gn_point_light(&light, light.position, 7, 70) == GN_OK && light.position[1] == centre[1],
       "a_position_may_be_the_lights_own");
}

static void statuses(void)
{
    static const int32_t down[3] = {0, -1, 0};
    stage s;
    frame f;
    gn_camera camera;
    gn_light sun, bad;
    uint32_t regions;
    set_stage(&s);
    set_camera(&camera, 0);
    (void)gn_directional_light(&sun, down, 0);
    (void)gn_fit_light(&sun, &s.scene);
    gn_settings settings = s.settings;
    settings.faces = 0;
    ok(frame_start(&f, &s.scene, &settings) == GN_OK, "a_context_without_faces_is_made");
    ok(gn_light_pass(f.context, &s.light) == GN_UNSUPPORTED && gn_light_faces(f.context, &s.light) == GN_UNSUPPORTED &&
           gn_light_face(f.context, &s.light, 0, &regions) == GN_UNSUPPORTED &&
           gn_point_pass(f.context, &s.light, &camera, frame_flush, &f) == GN_UNSUPPORTED,
       "it_takes_no_point_light");
    ok(gn_camera_begin(f.context, &camera) == GN_NOT_READY, "and_is_not_ready_for_a_camera");
    frame_end(&f);

    ok(frame_start(&f, &s.scene, &s.settings) == GN_OK, "a_context_with_six_faces_is_made");
    ok(gn_light_pass(f.context, &s.light) == GN_UNSUPPORTED, "gn_light_pass_is_for_other_lights");
    ok(gn_light_faces(0, &s.light) == GN_BAD_ARGUMENT && gn_light_faces(f.context, 0) == GN_BAD_ARGUMENT &&
           gn_light_faces(f.context, &sun) == GN_BAD_ARGUMENT &&
           gn_light_face(f.context, &s.light, 6, &regions) == GN_BAD_ARGUMENT &&
           gn_light_face(f.context, &s.light, 0, 0) == GN_BAD_ARGUMENT &&
           gn_light_face(f.context, &sun, 0, &regions) == GN_BAD_ARGUMENT &&
           gn_point_pass(f.context, &sun, &camera, frame_flush, &f) == GN_BAD_ARGUMENT &&
           gn_point_pass(f.context, &s.light, &camera, 0, &f) == GN_BAD_ARGUMENT,
       "bad_arguments_are_said");
    bad = s.light;
    bad.near_depth = 0;
    ok(gn_light_faces(f.context, &bad) == GN_OUT_OF_RANGE, "a_near_depth_of_0_is_out_of_range");
    bad = s.light;
    bad.position[2] = INT32_MIN;
    ok(gn_light_faces(f.context, &bad) == GN_OUT_OF_RANGE && gn_camera_begin(f.context, &camera) == GN_NOT_READY,
       "a_position_out_of_range_is_said_and_leaves_nothing");
    int good = 1;
    for (uint32_t face = 0; good && face < 5; face++) {
        good = gn_light_face(f.context, &s.light, face, &regions) == GN_OK;
        for (uint32_t i = 0; good && i < regions; i++)
            good = gn_light_layers(f.context, i, 0) == GN_OK && gn_light_resolve(f.context, i, 0) == GN_OK;
    }
    ok(good && gn_camera_begin(f.context, &camera) == GN_NOT_READY, "five_faces_are_not_ready");
    ok(gn_light_face(f.context, &s.light, 5, &regions) == GN_OK && regions == f.plan.light_regions &&
           gn_camera_begin(f.context, &camera) == GN_NOT_READY && gn_light_layers(f.context, 0, 0) == GN_OK &&
           gn_camera_begin(f.context, &camera) == GN_NOT_READY && gn_light_resolve(f.context, 0, 0) == GN_OK,
       "nor_is_a_sixth_whose_region_is_not_done");
    ok(gn_camera_pass(f.context, &camera, frame_flush, &f) == GN_OK &&
           gn_camera_pass(f.context, &camera, frame_flush, &f) == GN_OK,
       "six_are_for_any_number_of_camera_passes");
    f.regions = 0;
    f.stop_after = 1;
    ok(gn_point_pass(f.context, &s.light, &camera, frame_flush, &f) == GN_STOPPED && f.regions == 1,
       "a_flush_may_stop_the_pass");
    f.stop_after = 0;
    ok(gn_camera_begin(f.context, &camera) == GN_NOT_READY, "after_gn_point_pass_no_map_is_left");
    /* other lights in the same context: as in one without faces */
    frame plain;
    ok(gn_light_faces(f.context, &s.light) == GN_OK && gn_camera_pass(f.context, &camera, frame_flush, &f) == GN_OK,
       "which_six_maps_bring_back");
    settings = s.settings;
    settings.faces = 0;
    good = frame_start(&plain, &s.scene, &settings) == GN_OK && frame_render(&plain, &sun, &camera) == GN_OK &&
           frame_render(&f, &sun, &camera) == GN_OK;
    ok(good && same_pictures(&plain, &f), "another_light_in_the_same_context_is_as_without_faces");
    ok(frame_end(&f) && frame_end(&plain), "nothing_beside_the_blocks_was_written_by_any_of_it");

    settings = s.settings;
    settings.faces = &gn_one_face;
    ok(frame_start(&f, &s.scene, &settings) == GN_OK && gn_light_faces(f.context, &s.light) == GN_UNSUPPORTED &&
           gn_light_face(f.context, &s.light, 0, &regions) == GN_UNSUPPORTED,
       "with_one_map_there_is_gn_point_pass_alone");
    f.stop_after = 1;
    ok(gn_point_pass(f.context, &s.light, &camera, frame_flush, &f) == GN_STOPPED && f.regions == 1 &&
           gn_camera_begin(f.context, &camera) == GN_NOT_READY,
       "its_flush_may_stop_it_too");
    frame_end(&f);

    settings = s.settings;
    settings.fit = &gn_desired_view;
    if (frame_start(&f, &s.scene, &settings) == GN_OK)
        ok(gn_light_faces(f.context, &s.light) == GN_UNSUPPORTED &&
               gn_point_pass(f.context, &s.light, &camera, frame_flush, &f) == GN_UNSUPPORTED,
           "a_fit_takes_no_point_light");
    frame_end(&f);
    settings = s.settings;
    settings.reconstruction = &gn_box_7x7;
    settings.map_width = 8;
    ok(frame_start(&f, &s.scene, &settings) == GN_OK && gn_light_faces(f.context, &s.light) == GN_UNSUPPORTED,
       "a_map_that_is_all_border_is_refused");
    frame_end(&f);
    settings.map_width = 9;
    ok(frame_start(&f, &s.scene, &settings) == GN_OK && gn_light_faces(f.context, &s.light) == GN_OK &&
           gn_camera_pass(f.context, &camera, frame_flush, &f) == GN_OK,
       "one_with_a_texel_more_is_not");
    ok(frame_end(&f), "and_nothing_beside_its_block_was_written");
    free_stage(&s);
}

int main(int argc, char **argv)
{
    lights_are_made();
    statuses();
    ties_have_a_rule();
    points_lie_on_the_face_of_their_largest_coordinate(tap_cases(argc, argv, 20000) / 400);
    borders_hold_true_depths();
    no_reconstruction_reads_the_end_of_a_face();
    one_map_at_a_time_gives_the_same_picture();
    no_order_changes_a_pixel();
    skipped_faces_change_no_pixel();
    a_lone_plane_across_three_faces_has_no_seam();
    faces_stay_while_the_light_does();
    return tap_done();
}
