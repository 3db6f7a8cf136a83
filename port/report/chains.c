#include "chains.h"

/* Biases and slopes of the named methods of `gnomon render`: two texels, and parts of the light's depth range. */
#define TEXELS_2                                                                                                       \
    {                                                                                                                  \
        GN_BIAS_TEXELS, 2 << 16                                                                                        \
    }
#define RANGE_2000TH                                                                                                   \
    {                                                                                                                  \
        GN_BIAS_RANGE, 2147484                                                                                         \
    }
#define RANGE_10000TH                                                                                                  \
    {                                                                                                                  \
        GN_BIAS_RANGE, 429497                                                                                          \
    }
enum { SLOPE_1 = 1 << 16, SLOPE_2 = 2 << 16 };

/* Mixed surfaces, virtual samples. */
#define MIXED_VIRTUAL .surface = GN_MIXED, .bias = TEXELS_2, .receiver = &gn_virtual
#define SILHOUETTE MIXED_VIRTUAL, .reconstruction = &gn_silhouettes
#define CROSSING MIXED_VIRTUAL, .reconstruction = &gn_crossings

const chain chains[] = {
    {.name = "constant", .bias = TEXELS_2},
    {.name = "slope", .surface = GN_SLOPE, .bias = RANGE_2000TH, .slope = SLOPE_2},
    {.name = "midpoint", .surface = GN_MIDPOINT},
    {.name = "dual", .surface = GN_DUAL, .bias = TEXELS_2},
    {.name = "second-depth", .surface = GN_SECOND},
    {.name = "mixed", .surface = GN_MIXED, .bias = TEXELS_2},
    {.name = "adaptive", .bias = RANGE_10000TH, .receiver = &gn_virtual},
    {.name = "plane-bias", .bias = TEXELS_2, .slope = SLOPE_1, .receiver = &gn_plane_bias},
    {.name = "second-depth+virtual", .surface = GN_SECOND, .receiver = &gn_virtual},
    {.name = "mixed+virtual", MIXED_VIRTUAL},
    {.name = "bilinear", MIXED_VIRTUAL, .reconstruction = &gn_bilinear},
    {.name = "jitter4x4", MIXED_VIRTUAL, .reconstruction = &gn_jitter_4x4},
    {.name = "pcf5", MIXED_VIRTUAL, .reconstruction = &gn_box_5x5},
    {.name = "silhouette", SILHOUETTE},
    {.name = "silhouette-smooth", MIXED_VIRTUAL, .reconstruction = &gn_silhouettes_smooth},
    {.name = "crossing", CROSSING},
    {.name = "mixed+virtual/dv", MIXED_VIRTUAL, .fit = &gn_desired_view},
    {.name = "mixed+virtual/msf", MIXED_VIRTUAL, .fit = &gn_minimal_frustum},
    {.name = "mixed+virtual/rectilinear", MIXED_VIRTUAL, .warp = &gn_rectilinear},
    {.name = "mixed+virtual/dv+rectilinear-distance",
     MIXED_VIRTUAL,
     .fit = &gn_desired_view,
     .warp = &gn_rectilinear_distance},
    {.name = "mixed+virtual/dv+rectilinear", MIXED_VIRTUAL, .fit = &gn_desired_view, .warp = &gn_rectilinear},
    {.name = "mixed+virtual/msf+rectilinear", MIXED_VIRTUAL, .fit = &gn_minimal_frustum, .warp = &gn_rectilinear},
    {.name = "mixed+virtual/dv+nonorthogonal", MIXED_VIRTUAL, .fit = &gn_desired_view, .warp = &gn_nonorthogonal},
    {.name = "silhouette/dv", SILHOUETTE, .fit = &gn_desired_view},
    {.name = "silhouette/msf", SILHOUETTE, .fit = &gn_minimal_frustum},
    {.name = "silhouette/rectilinear", SILHOUETTE, .warp = &gn_rectilinear},
    {.name = "silhouette/dv+rectilinear-distance",
     SILHOUETTE,
     .fit = &gn_desired_view,
     .warp = &gn_rectilinear_distance},
    {.name = "silhouette/dv+rectilinear", SILHOUETTE, .fit = &gn_desired_view, .warp = &gn_rectilinear},
    {.name = "silhouette/msf+rectilinear", SILHOUETTE, .fit = &gn_minimal_frustum, .warp = &gn_rectilinear},
    {.name = "crossing/msf+rectilinear", CROSSING, .fit = &gn_minimal_frustum, .warp = &gn_rectilinear},
    {.name = "volumes", .shadow = GN_SHADOW_VOLUMES},
};

const uint32_t chain_count = sizeof chains / sizeof *chains;

gn_settings chain_settings(const chain *by, uint16_t width, uint16_t height, uint16_t map)
{
    gn_settings settings = gn_default_settings(width, height, map);
    settings.format = GN_RGB565;
    settings.surface = (uint8_t)by->surface;
    settings.bias.unit = by->bias.unit;
    settings.bias.value = by->bias.value;
    settings.slope = by->slope;
    settings.receiver = by->receiver;
    settings.reconstruction = by->reconstruction;
    settings.fit = by->fit;
    settings.warp = by->warp;
    settings.shadow = (uint8_t)by->shadow;
    return settings;
}
