#include "choices.h"

#include <assert.h>
#include <stdio.h>

#define LENGTH(values) (sizeof values / sizeof *values)
/* An array of negative length where the table is too long. */
#define TABLE(values)                                                                                                  \
    {                                                                                                                  \
        values, (int)(LENGTH(values) + 0 * sizeof(char[LENGTH(values) <= CHOICES_MOST ? 1 : -1]))                      \
    }

static const choice shadows[] = {{"map", "GN_SHADOW_MAP", 0}, {"volumes", "GN_SHADOW_VOLUMES", 0}};

static const choice culls[] = {
    {"auto", "GN_CULL_AUTO", 0},
    {"none", "GN_CULL_NONE", 0},
    {"back", "GN_CULL_BACK", 0},
    {"front", "GN_CULL_FRONT", 0},
};

static const choice layers[] = {
    {"auto", "GN_LAYERS_AUTO", 0},
    {"first", "GN_LAYERS_FIRST", 0},
    {"two", "GN_LAYERS_TWO", 0},
};

static const choice surfaces[] = {
    {"constant", "GN_CONSTANT", 0}, {"midpoint", "GN_MIDPOINT", 0}, {"dual", "GN_DUAL", 0},
    {"second", "GN_SECOND", 0},     {"mixed", "GN_MIXED", 0},       {"slope", "GN_SLOPE", 0},
};

static const choice bias_units[] = {
    {"world", "GN_BIAS_WORLD", 0},
    {"texels", "GN_BIAS_TEXELS", 0},
    {"range", "GN_BIAS_RANGE", 0},
};

static const choice receivers[] = {
    {"point", "0", 0},
    {"plane-bias", "&gn_plane_bias", &gn_plane_bias},
    {"virtual", "&gn_virtual", &gn_virtual},
    {"virtual-always", "&gn_virtual_always", &gn_virtual_always},
};

static const choice reconstructions[] = {
    {"nearest", "0", 0},
    {"bilinear", "&gn_bilinear", &gn_bilinear},
    {"jitter4x4", "&gn_jitter_4x4", &gn_jitter_4x4},
    {"pcf3", "&gn_box_3x3", &gn_box_3x3},
    {"pcf5", "&gn_box_5x5", &gn_box_5x5},
    {"pcf7", "&gn_box_7x7", &gn_box_7x7},
    {"silhouette", "&gn_silhouettes", &gn_silhouettes},
    {"silhouette-smooth", "&gn_silhouettes_smooth", &gn_silhouettes_smooth},
    {"crossing", "&gn_crossings", &gn_crossings},
};

/* The first of these two is no word of --parameterise: without a fit and without a warp a map is uniform. */
static const choice fits[] = {
    {"uniform", "0", 0},
    {"dv", "&gn_desired_view", &gn_desired_view},
    {"msf", "&gn_minimal_frustum", &gn_minimal_frustum},
};

static const choice warps[] = {
    {"uniform", "0", 0},
    {"rectilinear", "&gn_rectilinear", &gn_rectilinear},
    {"rectilinear-distance", "&gn_rectilinear_distance", &gn_rectilinear_distance},
    {"nonorthogonal", "&gn_nonorthogonal", &gn_nonorthogonal},
    {"rectilinear-vertices", "&gn_rectilinear_vertices", &gn_rectilinear_vertices},
    {"nonorthogonal-vertices", "&gn_nonorthogonal_vertices", &gn_nonorthogonal_vertices},
};

static const choice faces[] = {
    {"none", "0", 0},
    {"six", "&gn_six_faces", &gn_six_faces},
    {"one", "&gn_one_face", &gn_one_face},
};

const choices choices_shadow = TABLE(shadows), choices_cull = TABLE(culls), choices_layers = TABLE(layers),
              choices_surface = TABLE(surfaces), choices_bias_unit = TABLE(bias_units),
              choices_receiver = TABLE(receivers), choices_reconstruction = TABLE(reconstructions),
              choices_fit = TABLE(fits), choices_warp = TABLE(warps), choices_faces = TABLE(faces);

int choices_number(const choices *of, const void *object)
{
    int number = 0;
    while (number < of->count && of->all[number].object != object)
        number++;
    assert(number < of->count);
    return number;
}

int choices_use_slope(const gn_settings *settings)
{
    return settings->surface == GN_SLOPE || settings->receiver == &gn_plane_bias;
}

int choices_have_silhouettes(const gn_settings *settings)
{
    const gn_reconstruction *how = settings->reconstruction;
    return settings->shadow == GN_SHADOW_MAP &&
           (how == &gn_silhouettes || how == &gn_silhouettes_smooth || how == &gn_crossings);
}

int choices_use_view(const gn_settings *settings)
{
    return settings->shadow == GN_SHADOW_MAP && (settings->fit || settings->warp);
}

int choices_have_one_face(const gn_settings *settings)
{
    return settings->shadow == GN_SHADOW_MAP && settings->faces == &gn_one_face;
}

void choices_parameterisation(const gn_settings *settings, char words[PARAMETERISATION_SIZE])
{
    const char *fit = choices_fit.all[choices_number(&choices_fit, settings->fit)].word;
    const char *warp = choices_warp.all[choices_number(&choices_warp, settings->warp)].word;
    if (settings->fit && settings->warp)
        snprintf(words, PARAMETERISATION_SIZE, "%s+%s", fit, warp);
    else
        snprintf(words, PARAMETERISATION_SIZE, "%s", settings->fit ? fit : warp);
}

int choices_use_edges(const gn_settings *settings)
{
    return settings->shadow == GN_SHADOW_VOLUMES || choices_have_silhouettes(settings);
}
