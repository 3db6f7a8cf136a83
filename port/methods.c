#include "methods.h"

/* Biases: two texels, parts of the light's depth range; slopes: one and two; twice the usual smoothing. */
#define TEXELS_2                                                                                                       \
    {                                                                                                                  \
        GN_BIAS_TEXELS, 2 << 16                                                                                        \
    }
#define RANGE_50TH                                                                                                     \
    {                                                                                                                  \
        GN_BIAS_RANGE, 0xffffffffu / 50                                                                                \
    }
#define RANGE_2000TH                                                                                                   \
    {                                                                                                                  \
        GN_BIAS_RANGE, 0xffffffffu / 2000                                                                              \
    }
enum { SLOPE_1 = 1 << 16, SLOPE_2 = 2 << 16, SMOOTHING_2 = 2 << 16 };

/* Every virtual surface, receiver, reconstruction, fit, kind of warp and of faces, over maps that each must be right
 * for, in both staging. */
const method methods[] = {
    {.name = "constant", .cull = GN_CULL_NONE, .layers = GN_LAYERS_FIRST, .format = GN_RGB888, .bias = RANGE_50TH},
    {.name = "midpoint", .surface = GN_MIDPOINT, .cull = GN_CULL_NONE, .layers = GN_LAYERS_TWO, .format = GN_RGB565},
    {.name = "dual",
     .surface = GN_DUAL,
     .cull = GN_CULL_BACK,
     .layers = GN_LAYERS_TWO,
     .format = GN_RGB888,
     .bias = TEXELS_2},
    {.name = "second-front",
     .surface = GN_SECOND,
     .cull = GN_CULL_FRONT,
     .layers = GN_LAYERS_FIRST,
     .format = GN_RGB888},
    {.name = "second-two", .surface = GN_SECOND, .cull = GN_CULL_NONE, .layers = GN_LAYERS_TWO, .format = GN_RGB565},
    {.name = "mixed",
     .surface = GN_MIXED,
     .cull = GN_CULL_NONE,
     .layers = GN_LAYERS_TWO,
     .format = GN_RGB888,
     .bias = TEXELS_2},
    {.name = "slope", .surface = GN_SLOPE, .format = GN_RGB888, .bias = RANGE_2000TH, .slope = SLOPE_2},
    {.name = "virtual", .surface = GN_SECOND, .format = GN_RGB888, .receiver = &gn_virtual},
    {.name = "always-moved",
     .surface = GN_MIXED,
     .format = GN_RGB565,
     .bias = TEXELS_2,
     .receiver = &gn_virtual_always,
     .staging = MOVED},
    {.name = "kept-moved", /* the hashes of always-moved */
     .surface = GN_MIXED,
     .format = GN_RGB565,
     .bias = TEXELS_2,
     .receiver = &gn_virtual_always,
     .casters = &gn_static_casters,
     .staging = MOVED},
    {.name = "plane-bias", .format = GN_RGB888, .bias = RANGE_2000TH, .slope = SLOPE_1, .receiver = &gn_plane_bias},
    {.name = "bilinear",
     .surface = GN_DUAL,
     .format = GN_RGB565,
     .bias = TEXELS_2,
     .receiver = &gn_virtual,
     .reconstruction = &gn_bilinear},
    {.name = "jitter", .format = GN_RGB888, .bias = RANGE_50TH, .reconstruction = &gn_jitter_4x4},
    {.name = "jitter-moved",
     .surface = GN_SECOND,
     .format = GN_RGB888,
     .receiver = &gn_virtual,
     .reconstruction = &gn_jitter_4x4,
     .staging = MOVED},
    {.name = "pcf3", .format = GN_RGB565, .bias = RANGE_2000TH, .receiver = &gn_virtual, .reconstruction = &gn_box_3x3},
    {.name = "pcf5", .surface = GN_SECOND, .format = GN_RGB888, .receiver = &gn_virtual, .reconstruction = &gn_box_5x5},
    {.name = "pcf7-moved",
     .format = GN_RGB565,
     .bias = RANGE_2000TH,
     .slope = SLOPE_1,
     .receiver = &gn_plane_bias,
     .reconstruction = &gn_box_7x7,
     .staging = MOVED},
    {.name = "silhouette",
     .surface = GN_MIXED,
     .format = GN_RGB888,
     .bias = TEXELS_2,
     .receiver = &gn_virtual,
     .reconstruction = &gn_silhouettes},
    {.name = "silhouette-moved",
     .surface = GN_SECOND,
     .format = GN_RGB565,
     .reconstruction = &gn_silhouettes,
     .staging = MOVED},
    {.name = "silhouette-soup",
     .surface = GN_DUAL,
     .format = GN_RGB888,
     .bias = TEXELS_2,
     .receiver = &gn_virtual_always,
     .reconstruction = &gn_silhouettes,
     .staging = SOUP},
    {.name = "smooth",
     .surface = GN_SECOND,
     .format = GN_RGB565,
     .receiver = &gn_virtual,
     .reconstruction = &gn_silhouettes_smooth},
    {.name = "crossing-moved",
     .surface = GN_MIXED,
     .format = GN_RGB888,
     .bias = TEXELS_2,
     .receiver = &gn_virtual,
     .reconstruction = &gn_crossings,
     .staging = MOVED},
    {.name = "dv", .surface = GN_SECOND, .format = GN_RGB888, .receiver = &gn_virtual, .fit = &gn_desired_view},
    {.name = "msf-moved",
     .surface = GN_MIXED,
     .format = GN_RGB565,
     .bias = TEXELS_2,
     .receiver = &gn_virtual,
     .fit = &gn_minimal_frustum,
     .fit_depth = 1,
     .staging = MOVED},
    {.name = "dv-rectilinear",
     .surface = GN_DUAL,
     .format = GN_RGB565,
     .bias = TEXELS_2,
     .receiver = &gn_virtual,
     .reconstruction = &gn_box_3x3,
     .fit = &gn_desired_view,
     .warp = &gn_rectilinear,
     .smoothing = SMOOTHING_2},
    {.name = "msf-distance",
     .format = GN_RGB888,
     .bias = RANGE_2000TH,
     .slope = SLOPE_1,
     .receiver = &gn_plane_bias,
     .fit = &gn_minimal_frustum,
     .warp = &gn_rectilinear_distance},
    {.name = "dv-nonorthogonal",
     .surface = GN_SECOND,
     .format = GN_RGB888,
     .receiver = &gn_virtual,
     .fit = &gn_desired_view,
     .warp = &gn_nonorthogonal},
    {.name = "warped-silhouette",
     .surface = GN_MIXED,
     .format = GN_RGB888,
     .bias = TEXELS_2,
     .receiver = &gn_virtual,
     .reconstruction = &gn_silhouettes,
     .fit = &gn_minimal_frustum,
     .warp = &gn_rectilinear},
    {.name = "vertices", .format = GN_RGB565, .bias = RANGE_50TH, .warp = &gn_nonorthogonal_vertices},
    {.name = "silhouette-lamp",
     .surface = GN_MIXED,
     .format = GN_RGB888,
     .bias = TEXELS_2,
     .receiver = &gn_virtual,
     .reconstruction = &gn_silhouettes,
     .faces = &gn_six_faces,
     .staging = LAMP_BEHIND},
    {.name = "dual-lamp",
     .surface = GN_DUAL,
     .format = GN_RGB565,
     .bias = TEXELS_2,
     .faces = &gn_six_faces,
     .staging = LAMP_WITHIN},
    {.name = "pcf3-lamp",
     .surface = GN_SECOND,
     .format = GN_RGB565,
     .receiver = &gn_virtual,
     .reconstruction = &gn_box_3x3,
     .faces = &gn_one_face,
     .staging = LAMP_BEHIND},
    {.name = "volumes", .format = GN_RGB888, .shadow = GN_SHADOW_VOLUMES},
    {.name = "volumes-moved", .format = GN_RGB565, .shadow = GN_SHADOW_VOLUMES, .staging = MOVED},
};

const uint32_t method_count = sizeof methods / sizeof *methods;

gn_settings settings_of(const method *by, int small_regions)
{
    gn_settings settings = gn_default_settings(WIDTH, HEIGHT, MAP);
    settings.shadow = (uint8_t)by->shadow;
    settings.surface = (uint8_t)by->surface;
    settings.cull = (uint8_t)by->cull;
    settings.layers = (uint8_t)by->layers;
    settings.format = (uint8_t)by->format;
    settings.bias = by->bias;
    settings.slope = by->slope;
    settings.receiver = by->receiver;
    settings.reconstruction = by->reconstruction;
    settings.fit = by->fit;
    settings.warp = by->warp;
    settings.smoothing = by->smoothing;
    settings.fit_depth = by->fit_depth;
    settings.faces = by->faces;
    settings.casters = by->casters;
    settings.mask = 1;
    if (small_regions) {
        settings.map_rows = 24;
        settings.region_width = 48;
        settings.region_height = 16;
    }
    return settings;
}
