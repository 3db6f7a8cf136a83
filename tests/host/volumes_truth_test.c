/* Shadow volumes against the exact truth: no pixel differs that is not near a change of the truth. Random scenes
 * (volume_scenes.h) and the twelve built-in ones.
 *
 * Near is what truth_make says: the answer hangs on a tie, or is another one 1/256 pixel left, right, above or below.
 * Of random scenes two kinds of pixels are told apart and bounded, not forbidden: where the renderer sees another
 * triangle than the truth does (two surfaces at one depth to within a few bits, or the near or far plane; nothing that
 * counting has to do with), and where the truth changes within 2/256 pixel all round, between the four points that near
 * looks at: corners are snapped to 1/256 pixel, which moves an edge by up to 0.71/256, and beside a corner by more.
 *
 * volumes_truth_test CASES SEED: so many random scenes from that seed on (one: what a failure prints). */
#include "frame.h"
#include "gn_context.h"
#include "gn_volumes.h"
#include "procedural.h"
#include "sandbox.h"
#include "truth_trace.h"
#include "volume_scenes.h"

enum { SHRINK = TAP_SLOWER > 1 ? 4 : 1 };

static int render(frame *f, packed_scene *packed, const gn_settings *settings, problem *why)
{
    return frame_open(f, &packed->scene, settings, 0, why) || frame_light_pass(f, &packed->light, why) ||
                   frame_camera_pass(f, &packed->camera, why)
               ? -1
               : 0;
}

/* ---- random scenes ----------------------------------------------------------------------------------------------- */

enum { OTHER_TRIANGLE, WITHIN_TWO, WRONG, KINDS };

typedef struct tally {
    uint64_t scenes, skipped, failed, pixels, near, lit, shadowed, kinds[KINDS];
    uint64_t views[2][2]; /* orthographic, spot */
    uint64_t inside, cut_by_light, clipped;
    uint64_t wrong_scenes;
} tally;

/* The number of the triangle that a pixel shows, counted over all objects; GN_NO_TRIANGLE where there is none. */
static uint32_t seen_by_renderer(const gn_context *context, size_t pixel)
{
    uint32_t identifier = context->workers[0].triangle[pixel];
    if (identifier == GN_NO_TRIANGLE)
        return identifier;
    uint32_t mask = ((uint32_t)1 << context->triangle_bits) - 1;
    return context->objects[identifier >> context->triangle_bits].first_triangle + (identifier & mask);
}

static int kind_of(const truth_scene *scene, const gn_context *context, int32_t x, int32_t y, uint8_t expected)
{
    truth_memory memory = {0};
    size_t pixel = (size_t)y * context->settings.width + (size_t)x;
    (void)truth_trace(scene, 256 * x + 128, 256 * y + 128, &memory);
    uint32_t seen = memory.surface ? memory.surface->number : GN_NO_TRIANGLE;
    if (seen != seen_by_renderer(context, pixel))
        return OTHER_TRIANGLE;
    for (int dy = -2; dy <= 2; dy++)
        for (int dx = -2; dx <= 2; dx++)
            if (truth_trace(scene, 256 * x + 128 + dx, 256 * y + 128 + dy, &memory).mask != expected)
                return WITHIN_TWO;
    return WRONG;
}

/* Returns how many are wrong. */
static uint64_t compare_pixels(tally *c, const volume_scene *s, const frame *f, const truth *t, uint64_t seed)
{
    truth_scene scene;
    problem why;
    uint64_t wrong = 0;
    int opened = 0;
    for (uint32_t y = 0; y < t->height; y++)
        for (uint32_t x = 0; x < t->width; x++) {
            size_t pixel = (size_t)y * t->width + x;
            if (t->near[pixel] || f->mask[pixel] == t->mask[pixel])
                continue;
            if (!opened && truth_scene_open(&scene, &s->packed, t->width, t->height, &why))
                return 1;
            opened = 1;
            int kind = kind_of(&scene, f->context, (int32_t)x, (int32_t)y, t->mask[pixel]);
            c->kinds[kind]++;
            if (kind == WRONG && wrong++ < 4)
                note("seed %llu, pixel %u %u: mask %u, expected %u; count %u; run: volumes_truth_test 1 %llu",
                     (unsigned long long)seed, x, y, f->mask[pixel], t->mask[pixel],
                     f->context->volumes->workers[0].count[pixel], (unsigned long long)seed);
        }
    if (opened)
        truth_scene_close(&scene);
    return wrong;
}

static void count_scene(tally *c, const volume_scene *s, const frame *f, const truth *t)
{
    c->scenes++;
    c->pixels += (uint64_t)t->width * t->height;
    c->near += t->near_count;
    c->lit += t->lit;
    c->shadowed += t->shadowed;
    c->views[s->packed.camera.projection == GN_ORTHOGRAPHIC][s->packed.light.kind == GN_SPOT]++;
    c->inside += (uint64_t)s->inside;
    c->cut_by_light += f->context->volumes->crossing != 0;
    int clips = 0;
    for (uint32_t i = 0; i < s->packed.scene.object_count; i++)
        clips |= f->context->objects[i].clips;
    c->clipped += (uint64_t)clips;
}

static void run_scene(tally *c, uint64_t seed)
{
    static volume_scene s;
    frame f = {0};
    truth t = {0};
    problem why = {.text = ""};
    if (volume_scene_make(&s, seed)) {
        gn_settings settings = s.packed.settings;
        settings.region_width = settings.width; /* all of the image stays with worker 0 */
        settings.region_height = settings.height;
        int failed = render(&f, &s.packed, &settings, &why) ||
                     truth_make(&t, &s.packed, settings.width, settings.height, 1, 1, &why);
        if (failed && c->failed++ < 5)
            note("seed %llu: %s", (unsigned long long)seed, why.text);
        if (!failed) {
            c->wrong_scenes += compare_pixels(c, &s, &f, &t, seed) != 0;
            count_scene(c, &s, &f, &t);
        }
        truth_free(&t);
        frame_close(&f);
    } else {
        c->skipped++;
    }
    volume_scene_free(&s);
}

static void random_scenes(uint64_t first, uint64_t count)
{
    tally c = {0};
    double start = frame_clock();
    for (uint64_t seed = first; seed < first + count; seed++)
        run_scene(&c, seed);
    note("%llu scenes (%llu skipped) in %.1f s; %llu pixels, %llu lit, %llu shadowed, %llu near",
         (unsigned long long)c.scenes, (unsigned long long)c.skipped, frame_clock() - start,
         (unsigned long long)c.pixels, (unsigned long long)c.lit, (unsigned long long)c.shadowed,
         (unsigned long long)c.near);
    note("not near but different: %llu wrong in %llu scenes, %llu with another triangle in view, %llu within 2/256 "
         "pixel",
         (unsigned long long)c.kinds[WRONG], (unsigned long long)c.wrong_scenes,
         (unsigned long long)c.kinds[OTHER_TRIANGLE], (unsigned long long)c.kinds[WITHIN_TWO]);
    note("perspective: %llu directional, %llu spot; orthographic: %llu, %llu; camera in a solid: %llu; clipped: %llu; "
         "cut by the light's near plane: %llu",
         (unsigned long long)c.views[0][0], (unsigned long long)c.views[0][1], (unsigned long long)c.views[1][0],
         (unsigned long long)c.views[1][1], (unsigned long long)c.inside, (unsigned long long)c.clipped,
         (unsigned long long)c.cut_by_light);
    ok(c.failed == 0, "core_and_truth_take_all_scenes");
    ok(c.kinds[WRONG] == 0, "no_pixel_of_random_scenes_differs_that_is_not_near_a_change_of_the_truth");
    ok(c.kinds[OTHER_TRIANGLE] <= c.pixels / 20000 + 4, "another_triangle_than_in_truth_is_seen_rarely");
    ok(c.kinds[WITHIN_TWO] <= c.pixels / 50000 + 4, "snapping_moves_edges_past_the_near_points_rarely");
    if (count < 100)
        return;
    ok(c.lit && c.shadowed && c.near < c.pixels / 20, "lit_and_shadowed_pixels_were_seen_and_few_were_near");
    ok(c.views[0][0] && c.views[0][1] && c.views[1][0] && c.views[1][1] && c.inside && c.clipped && c.cut_by_light,
       "all_kinds_of_cameras_lights_and_clipping_were_among_them");
}

/* ---- the built-in scenes ----------------------------------------------------------------------------------------- */

static int read_built_in(packed_scene *packed, const char *name, problem *why)
{
    char file[64];
    snprintf(file, sizeof file, "%s.scene", name);
    if (procedural_write(name, sandbox_folder))
        return problem_of_usage(why, "%s cannot be written", name);
    return packed_read(packed, sandbox_path(file), 0, why) || packed_make_edges(packed, 0, why) ? -1 : 0;
}

static gn_settings built_in_settings(const packed_scene *packed)
{
    gn_settings settings = packed->settings;
    settings.width = (uint16_t)(settings.width / SHRINK);
    settings.height = (uint16_t)(settings.height / SHRINK);
    settings.region_width = settings.region_height = 0;
    settings.shadow = GN_SHADOW_VOLUMES;
    settings.format = GN_NO_COLOUR;
    settings.mask = 1;
    settings.workers = 2;
    return settings;
}

static void report_built_in(const char *name, const frame *f, const truth *t)
{
    uint64_t wrong = 0, near_surface = 0;
    for (size_t i = 0; i < (size_t)t->width * t->height; i++) {
        near_surface += t->near[i] && t->mask[i] != TRUTH_NO_SURFACE;
        if (!t->near[i] && f->mask[i] != t->mask[i] && wrong++ < 4)
            note("%s: pixel %u %u: mask %u, expected %u", name, (unsigned)(i % t->width), (unsigned)(i / t->width),
                 f->mask[i], t->mask[i]);
    }
    double percent = 100.0 * (double)near_surface / (double)t->surface;
    note("%s: %llu lit, %llu shadowed; %llu near, %.3f %% of the surface; %llu wrong", name, (unsigned long long)t->lit,
         (unsigned long long)t->shadowed, (unsigned long long)near_surface, percent, (unsigned long long)wrong);
    ok(wrong == 0, "%s_is_the_truth_but_where_it_changes", name);
    ok(t->lit && t->shadowed, "%s_has_light_and_shadow", name);
    if (SHRINK == 1)
        ok(percent <= 0.3, "%s_changes_near_at_most_3_pixels_in_1000", name);
}

static void built_in_scenes(void)
{
    sandbox_open();
    for (int i = 0; i < procedural_count; i++) {
        const char *name = procedural_names[i];
        packed_scene packed = {0};
        frame f = {0};
        truth t = {0};
        problem why = {.text = ""};
        int failed = read_built_in(&packed, name, &why);
        gn_settings settings = built_in_settings(&packed);
        failed = failed || render(&f, &packed, &settings, &why) ||
                 truth_make(&t, &packed, settings.width, settings.height, 2, 1, &why);
        if (!failed)
            report_built_in(name, &f, &t);
        else if (!ok(0, "%s_is_rendered", name))
            note("%s", why.text);
        truth_free(&t);
        frame_close(&f);
        packed_free(&packed);
    }
    sandbox_close();
}

int main(int argc, char **argv)
{
    uint64_t count = tap_cases(argc, argv, 4000);
    random_scenes(argc > 2 ? strtoull(argv[2], 0, 10) : 1, count);
    if (argc <= 2)
        built_in_scenes();
    return tap_done();
}
