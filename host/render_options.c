#include "render_options.h"

#include "quantise.h"

#include <string.h>

static const char *const surfaces[] = {"constant", "midpoint", "dual", "second", "mixed"};
static const char *const culls[] = {"auto", "none", "back", "front"};
static const char *const layer_names[] = {"auto", "first", "two"};

enum { METHOD_AUTO = 5, METHOD_VOLUMES = 6, METHODS_BUILT = 7, METHODS = 10 };

/* In the order of gn_surface, then auto and volumes, then those of docs/design.md that are not built yet. */
static const char *const methods[METHODS] = {"constant", "midpoint", "dual",  "second-depth", "mixed",
                                             "auto",     "volumes",  "slope", "adaptive",     "silhouette"};

/* The only choice that exists, and what is planned beside it. */
static int read_only_choice(const char *name, const char *value, const char *built, const char *const planned[],
                            problem *why)
{
    if (!value || strcmp(value, built) == 0)
        return 0;
    for (; *planned; planned++)
        if (strncmp(value, *planned, strlen(*planned)) == 0)
            return problem_of_usage(why, "%s %s is not built yet; expected %s", name, value, built);
    return problem_of_usage(why, "%s %s; expected %s", name, value, built);
}

static int read_fixed_choices(const char *const values[], problem *why)
{
    static const char *const parameterisations[] = {"dv", "msf", "rectilinear", "nonorthogonal", 0};
    static const char *const receivers[] = {"plane-bias", "virtual", 0};
    static const char *const reconstructions[] = {"bilinear", "jitter4x4", "pcf", "silhouette", 0};
    return read_only_choice("--parameterise", values[RENDER_PARAMETERISE], "uniform", parameterisations, why) ||
                   read_only_choice("--receiver", values[RENDER_RECEIVER], "point", receivers, why) ||
                   read_only_choice("--reconstruct", values[RENDER_RECONSTRUCT], "nearest", reconstructions, why)
               ? -1
               : 0;
}

static int all_meshes_are_closed(const packed_scene *packed)
{
    for (uint32_t i = 0; i < packed->scene.object_count; i++)
        if (!packed->objects[i].mesh->closed)
            return 0;
    return 1;
}

/* A method leaves culling and layers to the plan, which picks the cheapest that give its surface. Shadow volumes read
 * no setting of a map: fixed ones, so that a scene is packed to the same bytes whatever it had before. */
static void use_method(gn_settings *settings, const packed_scene *packed, int method)
{
    settings->shadow = method == METHOD_VOLUMES ? GN_SHADOW_VOLUMES : GN_SHADOW_MAP;
    settings->cull = GN_CULL_AUTO;
    settings->layers = GN_LAYERS_AUTO;
    if (method == METHOD_VOLUMES) {
        settings->bias = (gn_bias){GN_BIAS_WORLD, 0};
        settings->surface = GN_CONSTANT;
        return;
    }
    settings->bias = (gn_bias){GN_BIAS_TEXELS, 2 << 16};
    settings->surface = (uint8_t)method;
    if (method == METHOD_AUTO) {
        /* Mixed bounds its bias by half the way to the next surface, so it can afford one that also serves grazing
         * light. */
        settings->surface = all_meshes_are_closed(packed) ? GN_SECOND : GN_MIXED;
        settings->bias.value = 8 << 16;
    }
}

static int refuse_for_volumes(const char *name, problem *why)
{
    return problem_of_usage(why, "%s has no meaning for shadow volumes; expected a method with a shadow map", name);
}

static int read_method(gn_settings *settings, const packed_scene *packed, const char *const values[], problem *why)
{
    int method = METHOD_AUTO, surface = -1;
    if (values[RENDER_METHOD]) {
        method = option_choice("--method", values[RENDER_METHOD], methods, METHODS, why);
        if (method >= METHODS_BUILT)
            return problem_of_usage(why,
                                    "--method %s is not built yet; expected constant, midpoint, dual, second-depth, "
                                    "mixed, auto or volumes",
                                    values[RENDER_METHOD]);
        if (method < 0)
            return -1;
    }
    if (values[RENDER_SURFACE]) {
        if (!values[RENDER_METHOD] && settings->shadow == GN_SHADOW_VOLUMES)
            return refuse_for_volumes("--virtual-surface", why);
        surface = option_choice("--virtual-surface", values[RENDER_SURFACE], surfaces, 5, why);
        if (strcmp(values[RENDER_SURFACE], "slope") == 0)
            return problem_of_usage(why, "--virtual-surface slope is not built yet; expected one of the others");
        if (surface < 0)
            return -1;
        if (values[RENDER_METHOD] && surface != method)
            return problem_of_usage(why, "--virtual-surface %s contradicts --method %s; expected one of the two",
                                    values[RENDER_SURFACE], values[RENDER_METHOD]);
        method = surface;
    }
    if (values[RENDER_METHOD] || values[RENDER_SURFACE] || !packed->has_method)
        use_method(settings, packed, method);
    return 0;
}

static int read_parts(gn_settings *settings, const packed_scene *packed, const char *const values[], problem *why)
{
    int cull = settings->cull, layers = settings->layers;
    if (values[RENDER_CULL])
        cull = option_choice("--cull", values[RENDER_CULL], culls, 4, why);
    if (cull >= 0 && values[RENDER_LAYERS])
        layers = option_choice("--layers", values[RENDER_LAYERS], layer_names, 3, why);
    if (cull < 0 || layers < 0)
        return -1;
    settings->cull = (uint8_t)cull;
    settings->layers = (uint8_t)layers;
    if (!values[RENDER_BIAS])
        return 0;
    if (settings->surface == GN_MIDPOINT || settings->surface == GN_SECOND)
        return problem_of_usage(why,
                                "--bias has no meaning for the virtual surface '%s'; expected constant, dual or mixed",
                                render_surface_name(settings->surface));
    return quantise_bias(&settings->bias, values[RENDER_BIAS], packed->scale, why);
}

static int read_sizes(gn_settings *settings, const char *const values[], problem *why)
{
    long size[2];
    if (values[RENDER_MAP]) {
        if (option_size("--map", values[RENDER_MAP], 1, GN_MAX_SIZE, size, why))
            return -1;
        settings->map_width = (uint16_t)size[0];
        settings->map_height = (uint16_t)size[1];
    }
    if (values[RENDER_SIZE]) {
        if (option_size("--size", values[RENDER_SIZE], 0, GN_MAX_SIZE, size, why))
            return -1;
        settings->width = (uint16_t)size[0];
        settings->height = (uint16_t)size[1];
    }
    return 0;
}

/* Shadow volumes have no map. */
static int check_volumes(const char *const values[], problem *why)
{
    static const struct {
        int option;
        const char *name;
    } of_maps[] = {{RENDER_CULL, "--cull"},
                   {RENDER_LAYERS, "--layers"},
                   {RENDER_BIAS, "--bias"},
                   {RENDER_MAP, "--map"},
                   {RENDER_RECEIVER, "--receiver"},
                   {RENDER_RECONSTRUCT, "--reconstruct"},
                   {RENDER_PARAMETERISE, "--parameterise"}};
    for (size_t i = 0; i < sizeof of_maps / sizeof *of_maps; i++)
        if (values[of_maps[i].option])
            return refuse_for_volumes(of_maps[i].name, why);
    return 0;
}

/* The same rules as gn_make_plan, in words. */
static int check_combination(const gn_settings *s, const packed_scene *packed, problem *why)
{
    gn_plan plan;
    gn_status status = gn_make_plan(&plan, &packed->scene, s);
    if (status == GN_UNSUPPORTED)
        return problem_of_usage(
            why, "the virtual surface '%s' makes no sense with --layers %s and --cull %s; expected %s",
            render_surface_name(s->surface), render_layers_name(s->layers), render_cull_name(s->cull),
            s->surface == GN_CONSTANT ? "one layer (first)"
            : s->surface == GN_SECOND ? "two layers, or the first one with front faces culled"
            : s->surface == GN_MIXED  ? "two layers without culling"
                                      : "two layers, and no culling of front faces");
    if (status != GN_OK)
        return problem_of_usage(why, "the core refuses the scene: %s", render_status_text(status));
    return 0;
}

int render_options_read(gn_settings *settings, packed_scene *packed, const char *const values[], problem *why)
{
    *settings = packed->settings;
    if (read_fixed_choices(values, why) || read_method(settings, packed, values, why) ||
        (settings->shadow == GN_SHADOW_VOLUMES && check_volumes(values, why)) ||
        read_parts(settings, packed, values, why) || read_sizes(settings, values, why) ||
        (settings->shadow == GN_SHADOW_VOLUMES && packed_make_edges(packed, 0, why)))
        return -1;
    return check_combination(settings, packed, why);
}

int work_options_read(gn_settings *settings, const char *const values[], problem *why)
{
    long number, size[2];
    if (values[WORK_WORKERS]) {
        if (option_number("--workers", values[WORK_WORKERS], 1, 64, &number, why))
            return -1;
        settings->workers = (uint8_t)number;
    }
    if (values[WORK_REGION]) {
        if (option_size("--region", values[WORK_REGION], 0, GN_MAX_SIZE, size, why))
            return -1;
        settings->region_width = (uint16_t)size[0];
        settings->region_height = (uint16_t)size[1];
    }
    if (values[WORK_MAP_ROWS]) {
        if (option_number("--map-rows", values[WORK_MAP_ROWS], 1, GN_MAX_SIZE, &number, why))
            return -1;
        settings->map_rows = (uint16_t)number;
    }
    return 0;
}

const char *render_shadow_name(const gn_settings *settings)
{
    return settings->shadow == GN_SHADOW_VOLUMES ? "volumes" : "map";
}

const char *render_surface_name(int surface)
{
    return surface >= 0 && surface <= GN_MIXED ? surfaces[surface] : "?";
}

const char *render_cull_name(int cull)
{
    return cull >= 0 && cull <= GN_CULL_FRONT ? culls[cull] : "?";
}

const char *render_layers_name(int layers)
{
    return layers >= 0 && layers <= GN_LAYERS_TWO ? layer_names[layers] : "?";
}

const char *render_status_text(gn_status status)
{
    switch (status) {
    case GN_OK:
        return "done";
    case GN_STOPPED:
        return "stopped";
    case GN_BAD_ARGUMENT:
        return "an argument is none that it knows";
    case GN_OUT_OF_RANGE:
        return "a number is out of range";
    case GN_TOO_SMALL:
        return "the memory block is too small";
    case GN_MISALIGNED:
        return "the memory block is not aligned";
    case GN_BAD_MESH:
        return "a mesh refers to vertices or edges that do not exist";
    case GN_TOO_MANY:
        return "too many objects or triangles";
    case GN_UNSUPPORTED:
        return "settings that make no sense together";
    case GN_NOT_READY:
        return "called out of order";
    }
    return "an unknown status";
}
