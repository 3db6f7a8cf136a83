#include "render_options.h"

#include "choices.h"
#include "method.h"
#include "quantise.h"
#include "status.h"

#include <string.h>

/* Change *number to that of the value's choice, if there is a value. 0, or -1 and the problem. */
static int read_choice(const char *name, const char *value, const choices *of, int *number, problem *why)
{
    const char *words[CHOICES_MOST];
    for (int i = 0; i < of->count; i++)
        words[i] = of->all[i].word;
    if (value)
        *number = option_choice(name, value, words, of->count, why);
    return *number < 0 ? -1 : 0;
}

/* What is only planned is told from what nobody knows: by its start, as parameterisations combine. */
static int read_parameterisation(const char *value, problem *why)
{
    static const char *const built[] = {"uniform"};
    static const char *const planned[] = {"dv", "msf", "rectilinear", "nonorthogonal"};
    if (!value || option_choice("--parameterise", value, built, 1, why) == 0)
        return 0;
    for (size_t i = 0; i < sizeof planned / sizeof *planned; i++)
        if (strncmp(value, planned[i], strlen(planned[i])) == 0)
            return problem_of_usage(why, "--parameterise %s is not built yet; expected one that --help names", value);
    return -1;
}

static int refuse_for_volumes(const char *name, problem *why)
{
    return problem_of_usage(why, "%s has no meaning for shadow volumes; expected a method with a shadow map", name);
}

/* A virtual surface by its own name stands for the method of that name. */
static int read_method(gn_settings *settings, const packed_scene *packed, const char *const values[], problem *why)
{
    int method = METHOD_AUTO, surface = GN_CONSTANT;
    if (values[RENDER_METHOD])
        method = option_choice("--method", values[RENDER_METHOD], method_words, METHOD_COUNT, why);
    if (method < 0)
        return -1;
    if (values[RENDER_SURFACE]) {
        if (!values[RENDER_METHOD] && settings->shadow == GN_SHADOW_VOLUMES)
            return refuse_for_volumes("--virtual-surface", why);
        if (read_choice("--virtual-surface", values[RENDER_SURFACE], &choices_surface, &surface, why))
            return -1;
        if (values[RENDER_METHOD] && surface != method_surface(method))
            return problem_of_usage(why, "--virtual-surface %s contradicts --method %s; expected one of the two",
                                    values[RENDER_SURFACE], values[RENDER_METHOD]);
        if (!values[RENDER_METHOD])
            method = surface;
    }
    if (values[RENDER_METHOD] || values[RENDER_SURFACE] || !packed->has_method)
        method_use(settings, packed, method);
    return 0;
}

static int read_light_pass(gn_settings *settings, const char *const values[], problem *why)
{
    int cull = settings->cull, layers = settings->layers;
    if (read_choice("--cull", values[RENDER_CULL], &choices_cull, &cull, why) ||
        read_choice("--layers", values[RENDER_LAYERS], &choices_layers, &layers, why))
        return -1;
    settings->cull = (uint8_t)cull;
    settings->layers = (uint8_t)layers;
    return 0;
}

/* The factor of a receiver's plane is 1 where none is known yet: that of a virtual surface serves both. */
static void use_receiver(gn_settings *settings, const gn_receiver *receiver)
{
    int known = choices_use_slope(settings);
    settings->receiver = receiver;
    if (!choices_use_slope(settings))
        settings->slope = 0;
    else if (!known)
        settings->slope = 1 << 16;
}

static int read_camera_pass(gn_settings *settings, const char *const values[], problem *why)
{
    int receiver = choices_number(&choices_receiver, settings->receiver);
    int reconstruction = choices_number(&choices_reconstruction, settings->reconstruction);
    if (read_choice("--receiver", values[RENDER_RECEIVER], &choices_receiver, &receiver, why) ||
        read_choice("--reconstruct", values[RENDER_RECONSTRUCT], &choices_reconstruction, &reconstruction, why))
        return -1;
    use_receiver(settings, choices_receiver.all[receiver].object);
    settings->reconstruction = choices_reconstruction.all[reconstruction].object;
    return 0;
}

static int read_amounts(gn_settings *settings, const packed_scene *packed, const char *const values[], problem *why)
{
    double slope;
    if (values[RENDER_SLOPE]) {
        if (!choices_use_slope(settings))
            return problem_of_usage(why, "--slope has no meaning here; expected the virtual surface 'slope' or the "
                                         "receiver 'plane-bias'");
        if (option_decimal("--slope", values[RENDER_SLOPE], 64, &slope, why))
            return -1;
        settings->slope = (gn_q16_16)(slope * 65536 + 0.5);
    }
    if (!values[RENDER_BIAS])
        return 0;
    if (settings->surface == GN_MIDPOINT)
        return problem_of_usage(why, "--bias has no meaning for the virtual surface 'midpoint'; expected another one");
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
                   {RENDER_SLOPE, "--slope"},
                   {RENDER_MAP, "--map"},
                   {RENDER_RECEIVER, "--receiver"},
                   {RENDER_RECONSTRUCT, "--reconstruct"},
                   {RENDER_PARAMETERISE, "--parameterise"}};
    for (size_t i = 0; i < sizeof of_maps / sizeof *of_maps; i++)
        if (values[of_maps[i].option])
            return refuse_for_volumes(of_maps[i].name, why);
    return 0;
}

static int refuse_small_map(const gn_settings *s, problem *why)
{
    return problem_of_usage(
        why,
        "the receiver %s with the reconstruction %s, but the map is %d x %d; expected 2 x 2 texels or more, or point "
        "and nearest",
        choices_receiver.all[choices_number(&choices_receiver, s->receiver)].word,
        choices_reconstruction.all[choices_number(&choices_reconstruction, s->reconstruction)].word, s->map_width,
        s->map_height);
}

/* The same rules as gn_make_plan, in words. */
static int check_combination(const gn_settings *s, const packed_scene *packed, problem *why)
{
    gn_plan plan;
    gn_status status = gn_make_plan(&plan, &packed->scene, s);
    if (status == GN_UNSUPPORTED && (s->receiver || s->reconstruction) && (s->map_width < 2 || s->map_height < 2))
        return refuse_small_map(s, why);
    if (status == GN_UNSUPPORTED)
        return problem_of_usage(
            why, "the virtual surface '%s' makes no sense with --layers %s and --cull %s; expected %s",
            choices_surface.all[s->surface].word, choices_layers.all[s->layers].word, choices_cull.all[s->cull].word,
            s->surface == GN_CONSTANT || s->surface == GN_SLOPE ? "one layer (first)"
            : s->surface == GN_SECOND                           ? "two layers, or the first one with front faces culled"
            : s->surface == GN_MIXED                            ? "two layers without culling"
                                                                : "two layers, and no culling of front faces");
    if (status != GN_OK)
        return problem_of_usage(why, "the core refuses the scene: %s", status_text(status));
    return 0;
}

int render_options_read(gn_settings *settings, packed_scene *packed, const char *const values[], problem *why)
{
    *settings = packed->settings;
    if (read_parameterisation(values[RENDER_PARAMETERISE], why) || read_method(settings, packed, values, why))
        return -1;
    int volumes = settings->shadow == GN_SHADOW_VOLUMES;
    if ((volumes && check_volumes(values, why)) || read_light_pass(settings, values, why) ||
        read_camera_pass(settings, values, why) || read_amounts(settings, packed, values, why) ||
        read_sizes(settings, values, why) || (choices_use_edges(settings) && packed_make_edges(packed, 0, why)))
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
