#include "automatic_chain.h"

#include "automatic_table.h"
#include "choices.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { ONE = 1 << 16 };

typedef struct texels {
    const gn_fit *fit;
    const gn_warp *warp;
    gn_q16_16 smoothing;
    int like; /* the one that was measured */
} texels;

static const texels placements[AUTOMATIC_PLACEMENTS] = {
    {0, 0, 0, AUTOMATIC_UNIFORM},
    {&gn_desired_view, 0, 0, AUTOMATIC_DV},
    {&gn_minimal_frustum, 0, 0, AUTOMATIC_MSF},
    {0, &gn_rectilinear, 0, AUTOMATIC_RECTILINEAR},
    {&gn_desired_view, &gn_rectilinear, 0, AUTOMATIC_DV_RECTILINEAR},
    {&gn_minimal_frustum, &gn_rectilinear, 0, AUTOMATIC_MSF_RECTILINEAR},
    {&gn_desired_view, &gn_rectilinear_distance, 0, AUTOMATIC_DV_DISTANCE},
    {&gn_minimal_frustum, &gn_rectilinear_distance, 0, AUTOMATIC_DV_DISTANCE},
    {&gn_minimal_frustum, &gn_rectilinear, ONE / 4, AUTOMATIC_MSF_RECTILINEAR},
    {&gn_minimal_frustum, &gn_rectilinear, 4 * ONE, AUTOMATIC_MSF_RECTILINEAR},
};

/* Columns to rows. */
static const struct {
    uint8_t columns, rows;
} shapes[AUTOMATIC_SHAPES] = {{1, 4}, {1, 3}, {1, 2}, {2, 3}, {1, 1}, {3, 2}, {2, 1}, {3, 1}, {4, 1}};

/* ---- settings -------------------------------------------------------------------------------------------------- */

static void use_surface(gn_settings *s, const automatic_candidate *candidate)
{
    static const uint8_t surfaces[AUTOMATIC_SURFACES] = {GN_CONSTANT, GN_DUAL, GN_SECOND, GN_MIXED};
    int adaptive = candidate->surface == AUTOMATIC_NEAREST && candidate->test != AUTOMATIC_POINT;
    s->surface = surfaces[candidate->surface];
    s->layers = GN_LAYERS_AUTO;
    s->cull = GN_CULL_AUTO;
    s->bias.unit = adaptive ? GN_BIAS_RANGE : GN_BIAS_TEXELS; /* 0.0001 of the range, as --method adaptive; 2 texels */
    s->bias.value = adaptive ? 429497 : 2 * ONE;
    if (candidate->surface == AUTOMATIC_SECOND) {
        s->layers = GN_LAYERS_FIRST;
        s->cull = GN_CULL_FRONT;
        s->bias.unit = GN_BIAS_WORLD;
        s->bias.value = 0;
    }
}

gn_settings automatic_settings(const automatic_candidate *candidate, const gn_settings *base)
{
    gn_settings s = *base;
    const texels *p = &placements[candidate->placement];
    s.fit_depth = 0;
    s.slope = 0;
    s.fit = p->fit;
    s.warp = p->warp;
    s.smoothing = p->smoothing;
    s.receiver = candidate->test == AUTOMATIC_POINT ? 0 : &gn_virtual;
    s.reconstruction = candidate->test == AUTOMATIC_SILHOUETTE ? &gn_silhouettes
                       : candidate->test == AUTOMATIC_CROSSING ? &gn_crossings
                                                               : 0;
    use_surface(&s, candidate);
    s.shadow = candidate->width ? GN_SHADOW_MAP : GN_SHADOW_VOLUMES;
    if (candidate->width) {
        s.map_width = candidate->width;
        s.map_height = candidate->height;
    } else {
        s.surface = GN_CONSTANT; /* what --method volumes leaves behind */
        s.bias.unit = GN_BIAS_WORLD;
        s.bias.value = 0;
    }
    return s;
}

void automatic_candidate_text(const automatic_candidate *candidate, char *text, size_t size)
{
    static const char *const surfaces[] = {"nearest depth", "dual", "second depth in one layer", "mixed"},
                             *const tests[] = {"point", "virtual", "silhouette", "crossing"};
    gn_settings none = {0}, s = automatic_settings(candidate, &none);
    char words[PARAMETERISATION_SIZE];
    if (!candidate->width) {
        snprintf(text, size, "shadow volumes");
        return;
    }
    choices_parameterisation(&s, words);
    snprintf(text, size, "%s, %s, %s", surfaces[candidate->surface], tests[candidate->test], words);
    size_t used = strlen(text);
    if (s.smoothing)
        snprintf(text + used, size - used, ", smoothing %g", ldexp(s.smoothing, -16));
}

/* ---- what suits ------------------------------------------------------------------------------------------------ */

int automatic_surface_suits(int surface, const automatic_scene *scene)
{
    if (surface == AUTOMATIC_SECOND)
        return scene->closed && !scene->open;
    if (surface == AUTOMATIC_MIXED)
        return scene->flat || scene->open;
    return 1;
}

int automatic_placement_suits(int placement, const automatic_scene *scene)
{
    return placement == AUTOMATIC_UNIFORM || scene->light != GN_POINT;
}

/* ---- bytes ----------------------------------------------------------------------------------------------------- */

/* A face of a point light has a border of up to 4 texels on each side, which only the passes ask for. */
static int is_too_small(const gn_settings *s)
{
    enum { LEAST_FACE = 9 };
    return s->faces && s->shadow == GN_SHADOW_MAP && (s->map_width < LEAST_FACE || s->map_height < LEAST_FACE);
}

uint64_t automatic_bytes(const automatic_candidate *candidate, const packed_scene *packed, const gn_settings *base)
{
    gn_settings s = automatic_settings(candidate, base);
    gn_plan plan;
    s.workers = 1;
    if (is_too_small(&s))
        return 0;
    if (gn_make_plan(&plan, &packed->scene, &s) != GN_OK)
        return 0;
    if (s.shadow == GN_SHADOW_VOLUMES)
        return ((uint64_t)plan.triangles + 3) / 4 + (uint64_t)plan.edges * 8;
    /* not plan.map_bytes: on machines with vectors rows are padded */
    uint64_t maps = s.faces == &gn_six_faces ? 6 : 1;
    return maps * s.map_width * s.map_height * sizeof(gn_depth) + plan.silhouette_bytes + plan.warp_bytes;
}

double automatic_shape(int shape)
{
    return log2((double)shapes[shape].columns / shapes[shape].rows);
}

static void shape_map(automatic_candidate *candidate, int shape, uint32_t longer)
{
    uint32_t columns = shapes[shape].columns, rows = shapes[shape].rows, most = columns > rows ? columns : rows;
    candidate->width = (uint16_t)((longer * columns + most / 2) / most);
    candidate->height = (uint16_t)((longer * rows + most / 2) / most);
}

int automatic_fill(automatic_candidate *candidate, int shape, uint64_t bytes, const packed_scene *packed,
                   const gn_settings *base)
{
    uint32_t fits = 0, low = 0, high = GN_MAX_SIZE + 1;
    while (high - low > 1) {
        uint32_t middle = (low + high) / 2;
        shape_map(candidate, shape, middle);
        uint64_t taken = candidate->width && candidate->height ? automatic_bytes(candidate, packed, base) : 0;
        if (taken <= bytes) { /* also what is too small for the core: it is too small for the budget as well */
            low = middle;
            if (taken)
                fits = middle;
        } else
            high = middle;
    }
    shape_map(candidate, shape, fits);
    return fits != 0;
}

/* ---- what the tables expect ------------------------------------------------------------------------------------ */

static double expect(const automatic_measure *m, const automatic_scene *scene, double side)
{
    enum { LEAST_BORDER = -7 }; /* log2 of a hundredth of a per cent */
    double uniform = fmax(log2(scene->uniform_border), LEAST_BORDER),
           fitted = fmax(log2(scene->fitted_border), LEAST_BORDER);
    return m->level + m->size * log2(side / 128) + m->uniform * uniform + m->fitted * fitted;
}

static int is_measured(const automatic_measure *m)
{
    return m->level != 0 || m->size != 0;
}

/* Of what stands in no table: the test before it with the same placement, and the step between the two tests with
 * uniform texels. Maps of silhouettes gain nothing where they are far smaller than those of the tables, but err no more
 * than without. */
static double expect_test(int test, int like, const automatic_scene *scene, double side)
{
    const automatic_measure *m = &automatic_table[test][like], *uniform = &automatic_table[test][AUTOMATIC_UNIFORM];
    int before = test == AUTOMATIC_POINT ? AUTOMATIC_VIRTUAL : AUTOMATIC_SILHOUETTE;
    double error = is_measured(m) ? expect(m, scene, side)
                                  : expect(&automatic_table[before][like], scene, side) + expect(uniform, scene, side) -
                                        expect(&automatic_table[before][AUTOMATIC_UNIFORM], scene, side);
    return test > AUTOMATIC_VIRTUAL ? fmin(error, expect(&automatic_table[AUTOMATIC_VIRTUAL][like], scene, side))
                                    : error;
}

double automatic_expected_error(const automatic_candidate *candidate, const automatic_scene *scene)
{
    double side = sqrt((double)candidate->width * candidate->height), nearest = 0;
    if (!candidate->width)
        return 0;
    if (candidate->test == AUTOMATIC_POINT && candidate->surface == AUTOMATIC_NEAREST)
        nearest = expect(&automatic_table_constant, scene, side) -
                  expect(&automatic_table[AUTOMATIC_POINT][AUTOMATIC_UNIFORM], scene, side);
    double error = exp2(nearest + expect_test(candidate->test, placements[candidate->placement].like, scene, side));
    return error < 100 ? error : 100;
}

double automatic_expected_cost(const automatic_candidate *candidate)
{
    int like = placements[candidate->placement].like;
    const automatic_measure *m = &automatic_table[candidate->test][like],
                            *uniform = &automatic_table[candidate->test][AUTOMATIC_UNIFORM];
    int before = candidate->test == AUTOMATIC_POINT ? AUTOMATIC_VIRTUAL : AUTOMATIC_SILHOUETTE;
    if (m->cost > 0)
        return m->cost;
    return automatic_table[before][like].cost + uniform->cost - automatic_table[before][AUTOMATIC_UNIFORM].cost;
}
