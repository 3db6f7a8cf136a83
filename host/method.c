#include "method.h"

const char *const method_words[METHOD_COUNT] = {"constant", "midpoint", "dual",       "second-depth", "mixed",
                                                "slope",    "adaptive", "silhouette", "auto",         "volumes"};

typedef struct preset {
    uint8_t surface;
    gn_bias bias;
    gn_q16_16 slope;
    const gn_receiver *receiver;
    const gn_reconstruction *reconstruction;
} preset;

#define NO_BIAS                                                                                                        \
    {                                                                                                                  \
        GN_BIAS_WORLD, 0                                                                                               \
    }
#define TEXELS(count)                                                                                                  \
    {                                                                                                                  \
        GN_BIAS_TEXELS, (count) << 16                                                                                  \
    }
#define OF_RANGE(share)                                                                                                \
    {                                                                                                                  \
        GN_BIAS_RANGE, (uint32_t)((share)*4294967296.0 + 0.5)                                                          \
    }

/* Adaptive: the nearest depth and virtual samples, as the depth bias of Dou et al. (JCGT 3(4), 2014). Silhouette:
 * mixed, virtual samples and the map of Sen et al. (2003). */
static const preset presets[] = {
    {GN_CONSTANT, TEXELS(2), 0, 0, 0},
    {GN_MIDPOINT, NO_BIAS, 0, 0, 0},
    {GN_DUAL, TEXELS(2), 0, 0, 0},
    {GN_SECOND, NO_BIAS, 0, 0, 0},
    {GN_MIXED, TEXELS(2), 0, 0, 0},
    {GN_SLOPE, OF_RANGE(0.0005), 2 << 16, 0, 0},
    {GN_CONSTANT, OF_RANGE(0.0001), 0, &gn_virtual, 0},
    {GN_MIXED, TEXELS(2), 0, &gn_virtual, &gn_silhouettes},
};

static const preset auto_of_solids = {GN_SECOND, NO_BIAS, 0, &gn_virtual, 0};
static const preset auto_of_sheets = {GN_MIXED, TEXELS(2), 0, &gn_virtual, 0};

/* Shadow volumes read no setting of a map: fixed ones, so that a scene is packed to the same bytes whatever it had
 * before. */
static const preset without_map = {GN_CONSTANT, NO_BIAS, 0, 0, 0};

static int all_meshes_are_closed(const packed_scene *packed)
{
    for (uint32_t i = 0; i < packed->scene.object_count; i++)
        if (!packed->objects[i].mesh->closed)
            return 0;
    return 1;
}

int method_surface(int method)
{
    return method <= METHOD_SILHOUETTE ? presets[method].surface : -1;
}

void method_use(gn_settings *settings, const packed_scene *packed, int method)
{
    const preset *p = method == METHOD_VOLUMES        ? &without_map
                      : method != METHOD_AUTO         ? &presets[method]
                      : all_meshes_are_closed(packed) ? &auto_of_solids
                                                      : &auto_of_sheets;
    settings->shadow = method == METHOD_VOLUMES ? GN_SHADOW_VOLUMES : GN_SHADOW_MAP;
    settings->cull = GN_CULL_AUTO; /* the plan picks the cheapest that give the surface */
    settings->layers = GN_LAYERS_AUTO;
    settings->surface = p->surface;
    settings->bias = p->bias;
    settings->slope = p->slope;
    settings->receiver = p->receiver;
    settings->reconstruction = p->reconstruction;
    settings->fit = 0;
    settings->warp = 0;
    settings->fit_depth = 0;
    settings->smoothing = 0;
}
