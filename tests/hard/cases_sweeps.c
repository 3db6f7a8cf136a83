/* Sweeps: one scene, many maps, images, ways to cut the work, directions and places of the light. The worst counts, not
 * the mean; the table's figures are those of the worst. */
#include "hard.h"

#include "memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double pi = 3.14159265358979323846;

/* What the scene's builder takes besides the builder. */
static struct {
    double azimuth;          /* degrees, of the light about y */
    double shift_u, shift_v; /* of the light's box, texels */
} light = {0, 0, 0};

static struct {
    uint16_t width, height, map_width, map_height;
} sizes = {160, 120, 64, 64};

static void add_scene(builder *b)
{
    build_floor(b, 1.9, 1.4);
    build_solid(b, 170, 120, 70);
    build_box(b, -0.8, -0.2, 0, 0.4, -0.3, 0.3);
    build_turn(b, 0, 1, 17, -0.5, 0, 0);
    size_t first = build_vertex_count(b);
    const double wedge[3][2] = {{0.3, 0.2}, {1.1, 0.2}, {0.7, 0.8}};
    build_prism(b, wedge, 3, -0.5, 0.2);
    build_turn(b, first, 1, -40, 0.7, 0, 0);
    build_camera_above(b, 0, 0, 1.25);
    b->width = sizes.width;
    b->height = sizes.height;
    b->map_width = sizes.map_width;
    b->map_height = sizes.map_height;
}

/* 45 degrees high; the box is 4 m wide wherever the light comes from: t = 1/16 m on a map of 64. */
static void build_scene(builder *b)
{
    double a = light.azimuth * pi / 180, step_u = 4.0 / sizes.map_width, step_v = 4.0 / sizes.map_height;
    add_scene(b);
    build_sun(b, cos(a), -1, sin(a));
    build_sun_box(b, light.shift_u * step_u, light.shift_v * step_v, 4.2, 4.2, -4, 8);
}

static void reset(void)
{
    memset(&light, 0, sizeof light);
    sizes.width = 160, sizes.height = 120, sizes.map_width = sizes.map_height = 64;
}

/* Keep the worse of two outcomes. Returns 1 if it is the new one. */
static int keep_worst(outcome *worst, const outcome *now)
{
    double before = worst->ran ? worst->shadow_percent + worst->light_percent : -1;
    if (!now->ran || now->shadow_percent + now->light_percent <= before)
        return 0;
    row_forget(worst);
    *worst = *now;
    worst->mask = 0;
    return 1;
}

/* Own errors, or of volumes all errors, in per cent. */
static double own_percent(const hard_row *row, const outcome *o, int method)
{
    uint64_t count = method == COLUMN_VOLUMES ? o->false_shadow + o->false_light : o->own_shadow + o->own_light;
    return percent_of(row, count);
}

/* What the methods may err by on their own in this scene on a map of 64, in per cent of 8.33 m^2, t = 0.066 m:
 *
 * constant, dual: a roof of the wedge (56 degrees steep, 0.28 m^2 seen from above) that light grazes below 14 degrees
 * spans more than 2 t in half a texel: at most half of it is dark, 1.7 %. Near upright edges solids are thinner than 2
 * t along the light: four corners of (2 t)^2 / 2 at most, 0.035 m^2, 0.4 %; midpoint: half a texel along the edges of
 * the tops, some 4 m: 0.13 m^2, 1.6 %; second depth, mixed: half a texel behind the contact of the block, 2.4 m, of
 * which half is away from the light: t / 2 sin 45 = 0.047 m: 0.056 m^2, 0.7 %; and along edges that fall sideways (the
 * wedge), 0.5 % as of the L. */
static const double own_limit[COLUMN_COUNT] = {2.1, 1.6, 2.1, 1.2, 1.2, 1.2, 0};

/* ---- 360 directions ---------------------------------------------------------------------------------------------- */

static void run_directions(hard_row *row)
{
    outcome worst[COLUMN_COUNT];
    double worst_own[COLUMN_COUNT] = {0};
    int worst_at[COLUMN_COUNT] = {0}, lit = 1, failed = 0;
    memset(worst, 0, sizeof worst);
    reset();
    sizes.width = 80, sizes.height = 60;
    for (int degrees = 0; degrees < 360; degrees += hard_is_short() ? 45 : 1) {
        light.azimuth = degrees;
        if (row_begin(row, build_scene, 1)) {
            failed = 1;
            row_end(row);
            break;
        }
        lit &= row->truth.lit > 0 && row->truth.shadowed > 0;
        for (int method = 0; method < COLUMN_COUNT; method++) {
            gn_settings s = method_settings(&row->packed, method, 0);
            row_measure(row, method, &s);
            outcome *o = &row->outcomes[method];
            worst_own[method] = fmax(worst_own[method], own_percent(row, o, method));
            if (keep_worst(&worst[method], o))
                worst_at[method] = degrees;
        }
        row_end(row);
    }
    promise(row, lit && !failed, 0, "%s_have_lit_and_shadowed_pixels", row->about->name);
    memcpy(row->outcomes, worst, sizeof worst);
    for (int method = 0; method < COLUMN_COUNT; method++) {
        if (!worst[method].ran)
            continue;
        if (!promise(row, worst_own[method] <= own_limit[method], 0, "%s_%s_errs_as_derived", row->about->name,
                     method_names[method]))
            say("of its own %.3f %%, expected at most %g; worst at %d degrees", worst_own[method], own_limit[method],
                worst_at[method]);
        row_remark(row, "%s%s %d", method ? ", " : "Worst at: ", method_names[method], worst_at[method]);
    }
    row_remark(row, " degrees.");
    reset();
}

/* ---- the light moves by less than a texel ------------------------------------------------------------------------ */

/* What was seen of a pixel on the way of the light's box through a texel. */
enum {
    WAS_LIT = 1,
    WAS_SHADOWED = 2,
    TEXEL_ERRED = 4, /* once the truth was another at the texel's centre, at most half a texel away */
    COLUMN_ERRED = 8 /* once it was wrong without that */
};

/* A pixel may flip where the truth's edge is within half a texel of it, t / 2 sideways and t / (2 sin 45) along the
 * light on the floor: then the centre of some texel that the box's way brings there is beyond the edge (footprint.h).
 * All others flip by the method's own errors. These have a place of their own that does not move with the texels, so
 * that all 32 places of the box together may hold no more than own_limit allows for one, of which the roof's 1.7 % is
 * left out: at this azimuth its far side is turned away from the light by 3 degrees and its near side faces it.
 *
 * Of how many pixels may flip: shadow edges of 10 m in all, 0.093 m of floor about each, 0.93 m^2. */
static const double own_flip_limit[COLUMN_COUNT] = {0.4, 1.6, 0.4, 1.2, 1.2, 1.2, 0};
static const double flip_limit = 11;

/* Add what a mask says to what was seen before. */
static void look_for_flips(hard_row *row, const outcome *o, uint8_t *seen, size_t count)
{
    for (size_t i = 0; o->ran && i < count; i++) {
        if (o->mask[i] == 255 || row->truth.mask[i] == 255 || row->near[i])
            continue;
        seen[i] |= o->mask[i] ? WAS_LIT : WAS_SHADOWED;
        if (o->mask[i] != row->truth.mask[i])
            seen[i] |= footprint_differs(&row->footprint, i, row->truth.mask[i]) ? TEXEL_ERRED : COLUMN_ERRED;
    }
}

static void check_flips(hard_row *row, int method, const uint8_t *seen, size_t count, uint64_t surface)
{
    size_t flipped = 0, own = 0;
    for (size_t i = 0; i < count; i++) {
        int flips = seen[i] & WAS_LIT && seen[i] & WAS_SHADOWED;
        flipped += flips;
        own += flips && !(seen[i] & TEXEL_ERRED);
    }
    double all_percent = 100.0 * (double)flipped / (double)surface;
    double apart_percent = 100.0 * (double)own / (double)surface;
    if (!promise(row, apart_percent <= own_flip_limit[method], 0, "%s_%s_flips_within_half_a_texel_of_an_edge",
                 row->about->name, method_names[method]))
        say("%.3f %% flip elsewhere, expected at most %g", apart_percent, own_flip_limit[method]);
    promise(row, all_percent <= (method == COLUMN_VOLUMES ? 0 : flip_limit), 0, "%s_%s_flips_as_derived",
            row->about->name, method_names[method]);
    row_remark(row, "%s%s %.1f (%.2f)", method ? ", " : "Flip (of these elsewhere): ", method_names[method],
               all_percent, apart_percent);
}

/* Truth stays the same, as a sun has no place. Pixels that are answered differently on the way through a texel. */
static void run_translation(hard_row *row)
{
    enum { STEPS = 16, PIXELS = 160 * 120 };
    uint8_t *seen = memory_take((size_t)COLUMN_COUNT * PIXELS, 1);
    outcome worst[COLUMN_COUNT];
    double worst_own[COLUMN_COUNT] = {0};
    int same_truth = 1;
    uint64_t surface = 1;
    uint8_t *first = memory_take(PIXELS, 1); /* the truth before anything moves */
    memset(worst, 0, sizeof worst);
    reset();
    for (int step = 0; step < 2 * STEPS; step += hard_is_short() ? 8 : 1) {
        light.shift_u = step < STEPS ? step / 16.0 : 0;
        light.shift_v = step < STEPS ? 0 : (step - STEPS) / 16.0;
        if (row_begin(row, build_scene, 1)) {
            row_end(row);
            break;
        }
        if (step == 0)
            memcpy(first, row->truth.mask, PIXELS);
        surface = row->truth.surface;
        same_truth &= memcmp(first, row->truth.mask, PIXELS) == 0;
        for (int method = 0; method < COLUMN_COUNT; method++) {
            gn_settings s = method_settings(&row->packed, method, 0);
            row_measure(row, method, &s);
            outcome *o = &row->outcomes[method];
            worst_own[method] = fmax(worst_own[method], own_percent(row, o, method));
            look_for_flips(row, o, seen + (size_t)method * PIXELS, PIXELS);
            keep_worst(&worst[method], o);
        }
        row_end(row);
    }
    promise(row, same_truth, 0, "%s_leaves_the_truth_as_it_is", row->about->name);
    memcpy(row->outcomes, worst, sizeof worst);
    for (int method = 0; method < COLUMN_COUNT; method++) {
        if (!worst[method].ran)
            continue;
        check_flips(row, method, seen + (size_t)method * PIXELS, PIXELS, surface);
        promise(row, worst_own[method] <= own_limit[method], 0, "%s_%s_errs_as_derived", row->about->name,
                method_names[method]);
    }
    row_remark(row, " %%.");
    free(seen);
    free(first);
    reset();
}

/* ---- maps and images of all sizes -------------------------------------------------------------------------------- */

static void run_maps(hard_row *row)
{
    static const uint16_t maps[][2] = {{1, 1},   {1, 4096},  {4096, 1},   {3, 5},      {17, 1000},
                                       {64, 64}, {255, 257}, {1024, 512}, {4096, 4096}};
    double total[COUNT(maps)][COLUMN_COUNT] = {{0}};
    size_t last = hard_is_short() ? COUNT(maps) - 3 : COUNT(maps);
    reset();
    for (size_t i = 0; i < last; i++) {
        sizes.map_width = maps[i][0];
        sizes.map_height = maps[i][1];
        if (row_begin(row, build_scene, 1)) {
            row_end(row);
            break;
        }
        for (int method = 0; method < COLUMN_VOLUMES; method++) {
            gn_settings s = method_settings(&row->packed, method, 0);
            row_measure(row, method, &s);
            const outcome *o = &row->outcomes[method];
            total[i][method] = o->shadow_percent + o->light_percent;
            if (method == COLUMN_AUTO && (maps[i][0] < 2 || maps[i][1] < 2)) {
                promise(row, !o->ran, 0, "%s_%ux%u_%s_is_refused", row->about->name, maps[i][0], maps[i][1],
                        method_names[method]);
                continue;
            }
            promise(row, o->ran && o->coverage == 0, 0, "%s_%ux%u_%s_renders", row->about->name, maps[i][0], maps[i][1],
                    method_names[method]);
            if (i >= 5)
                promise(row, own_percent(row, o, method) <= own_limit[method], 0, "%s_%ux%u_%s_errs_as_derived",
                        row->about->name, maps[i][0], maps[i][1], method_names[method]);
        }
        if (row->outcomes[COLUMN_AUTO].ran)
            row_remark(row, ", %ux%u %.1f", maps[i][0], maps[i][1], total[i][COLUMN_AUTO]);
        else
            row_remark(row, "%s%ux%u", i ? ", " : "`auto`: refused: ", maps[i][0], maps[i][1]);
        row_end(row);
    }
    row_remark(row, " %%.");
    /* Errors along edges go with the side of a texel: 1/64 of it, and a pixel's share where none is left. */
    for (int method = 0; method < COLUMN_VOLUMES && last == COUNT(maps); method++)
        promise(row, total[last - 1][method] <= total[5][method] / 16, 0, "%s_%s_errs_less_on_a_larger_map",
                row->about->name, method_names[method]);
    reset();
}

static void run_images(hard_row *row)
{
    static const uint16_t images[][2] = {{1, 1}, {17, 3}, {3, 17}, {161, 119}, {4096, 1}, {1, 4096}};
    outcome worst[COLUMN_COUNT];
    memset(worst, 0, sizeof worst);
    reset();
    for (size_t i = 0; i < (hard_is_short() ? 4 : COUNT(images)); i++) {
        sizes.width = images[i][0];
        sizes.height = images[i][1];
        if (row_begin(row, build_scene, 1)) {
            row_end(row);
            break;
        }
        for (int method = 0; method < COLUMN_COUNT; method++) {
            gn_settings s = method_settings(&row->packed, method, 0);
            row_measure(row, method, &s);
            const outcome *o = &row->outcomes[method];
            /* of a single pixel a per cent says nothing: the errors of a picture 4096 pixels wide are along one line */
            int is_line = images[i][1] < 100 || images[i][0] < 100;
            promise(row,
                    o->ran && o->coverage == 0 &&
                        ((is_line && method != COLUMN_VOLUMES) || own_percent(row, o, method) <= own_limit[method]),
                    0, "%s_%ux%u_%s_errs_as_derived", row->about->name, images[i][0], images[i][1],
                    method_names[method]);
            if (images[i][0] == 161)
                keep_worst(&worst[method], o);
        }
        row_end(row);
    }
    memcpy(row->outcomes, worst, sizeof worst);
    reset();
}

/* ---- ways to cut the work ---------------------------------------------------------------------------------------- */

/* Invariant 4: the result depends neither on regions nor on workers. */
static void run_cuts(hard_row *row)
{
    static const struct {
        uint16_t width, height, map_rows;
        uint8_t workers;
    } cuts[] = {{1, 120, 1, 1}, {7, 5, 7, 2}, {33, 17, 13, 3}, {160, 1, 64, 5}, {161, 121, 63, 64}, {0, 0, 0, 4}};
    reset();
    if (row_begin(row, build_scene, 1)) {
        row_end(row);
        return;
    }
    for (int method = 0; method < COLUMN_ALL; method++) {
        if (method >= COLUMN_COUNT && method < COLUMN_SILHOUETTES)
            continue;
        gn_settings s = method_settings(&row->packed, method, 0);
        row_measure(row, method, &s);
        for (size_t i = 0; row->outcomes[method].ran && i < COUNT(cuts); i++) {
            uint8_t *mask = 0;
            problem why;
            s.region_width = cuts[i].width;
            s.region_height = cuts[i].height;
            s.map_rows = cuts[i].map_rows;
            s.workers = cuts[i].workers;
            int failed = method_render(&row->packed, &s, &mask, 0, &why);
            if (!promise(row, !failed && memcmp(mask, row->outcomes[method].mask, 160 * 120) == 0, 0,
                         "%s_%s_regions_%ux%u_map_rows_%u_workers_%u_are_equal", row->about->name, method_names[method],
                         cuts[i].width, cuts[i].height, cuts[i].map_rows, cuts[i].workers))
                say("%s", failed ? why.text : "the masks differ");
            free(mask);
        }
    }
    row_end(row);
}

/* ---- the list -------------------------------------------------------------------------------------------------- */

#define GROUP "Sweeps"

static const hard_case cases[] = {
    {.name = "directions",
     .group = GROUP,
     .title = "360 directions of the light, 45 degrees high",
     .expected = "edges of half a texel; of their own at most 2.1 % (constant, dual: a roof in grazing light), second "
                 "depth 1.2 %.",
     .advice = "No direction stands out; where a texel's side lies along a shadow's edge all of it is right or wrong "
               "at once.",
     .run = run_directions},
    {.name = "translation",
     .group = GROUP,
     .title = "light's box moved by 1/16 texel, 32 places",
     .expected = "pixels flip within half a texel of an edge, and where a method errs on its own: at most 0.4 % "
                 "(constant, dual), 1.6 % (midpoint), 1.2 %.",
     .advice = "A box that is fitted anew makes edges crawl: set it once, or move it by whole texels.",
     .run = run_translation},
    {.name = "maps",
     .group = GROUP,
     .title = "maps from 1x1 to 4096x4096",
     .expected = "errors go with the side of a texel.",
     .advice = "The figures are those of the last map.",
     .run = run_maps},
    {.name = "images",
     .group = GROUP,
     .title = "images of 1x1, 17x3, 3x17, 161x119, 4096x1, 1x4096",
     .expected = "161x119: own errors as for 160x120; all: surfaces are those of the truth, and volumes agree with it.",
     .advice = "The figures are those of 161x119.",
     .run = run_images},
    {.name = "cuts",
     .group = GROUP,
     .title = "regions, rows of the map, 1 to 64 workers",
     .expected = "every mask equal, bit for bit",
     .advice = "Regions trade memory for time only.",
     .run = run_cuts},
};

const hard_list sweep_cases = {cases, COUNT(cases)};
