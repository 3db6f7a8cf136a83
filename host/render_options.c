#include "render_options.h"

#include "choices.h"
#include "method.h"
#include "quantise.h"
#include "status.h"

#include <stdio.h>
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

/* The number of the word of that length; 0, which no option names, where it is none of them. */
static int find_word(const choices *of, const char *word, size_t length)
{
    int number = of->count - 1;
    while (number > 0 && (strlen(of->all[number].word) != length || memcmp(of->all[number].word, word, length) != 0))
        number--;
    return number;
}

static void list_words(const choices *of, char *list, size_t size)
{
    for (int i = 1; i < of->count; i++) {
        size_t length = strlen(list);
        snprintf(list + length, size - length, "%s%s", i > 1 ? ", " : "", of->all[i].word);
    }
}

static int refuse_parameterisation(const char *value, const char *reason, problem *why)
{
    char fits[64] = "", warps[256] = "";
    list_words(&choices_fit, fits, sizeof fits);
    list_words(&choices_warp, warps, sizeof warps);
    return problem_of_usage(why,
                            "--parameterise %s %s; expected uniform, a fit (%s), a warp (%s), or a fit and a warp with "
                            "+ between them",
                            value, reason, fits, warps);
}

/* A part of --parameterise, of that length: a fit or a warp, of which there is none yet. */
static int take_part(gn_settings *settings, const char *value, const char *part, size_t length, problem *why)
{
    int fit = find_word(&choices_fit, part, length), warp = find_word(&choices_warp, part, length);
    if (!fit && !warp)
        return refuse_parameterisation(value, "names something else", why);
    if (fit && settings->fit)
        return refuse_parameterisation(value, "names two fits", why);
    if (warp && settings->warp)
        return refuse_parameterisation(value, "names two warps", why);
    if (fit)
        settings->fit = choices_fit.all[fit].object;
    else
        settings->warp = choices_warp.all[warp].object;
    return 0;
}

/* One that is named forgets all of the one before. */
static int read_parameterisation(gn_settings *settings, const char *value, problem *why)
{
    if (!value)
        return 0;
    settings->fit = 0;
    settings->warp = 0;
    settings->fit_depth = 0;
    settings->smoothing = 0;
    if (strcmp(value, choices_fit.all[0].word) == 0)
        return 0;
    for (const char *part = value;; part++) {
        size_t length = strcspn(part, "+");
        if (take_part(settings, value, part, length, why))
            return -1;
        part += length;
        if (!*part)
            return 0;
    }
}

static int read_smoothing(gn_settings *settings, const char *value, problem *why)
{
    double smoothing;
    if (!settings->warp)
        return problem_of_usage(why, "--smoothing has no meaning here; expected a warp (--parameterise rectilinear)");
    if (option_decimal("--smoothing", value, 1.0 / 64, 64, &smoothing, why))
        return -1;
    settings->smoothing = (gn_q16_16)(smoothing * 65536 + 0.5);
    return 0;
}

static int read_view_pass(gn_settings *settings, const char *const values[], problem *why)
{
    if (read_parameterisation(settings, values[RENDER_PARAMETERISE], why) ||
        (values[RENDER_SMOOTHING] && read_smoothing(settings, values[RENDER_SMOOTHING], why)))
        return -1;
    if (values[RENDER_FIT_DEPTH] && !settings->fit)
        return problem_of_usage(why, "--fit-depth has no meaning here; expected a fit (--parameterise dv or msf)");
    if (values[RENDER_FIT_DEPTH])
        settings->fit_depth = 1;
    return 0;
}

/* A point light has no volumes, no view pass, and maps of its own. */
static int read_faces(gn_settings *settings, const packed_scene *packed, const char *value, problem *why)
{
    int point = packed->light.kind == GN_POINT, faces = choices_number(&choices_faces, settings->faces);
    if (value && !point)
        return problem_of_usage(why, "--faces has no meaning here; expected a scene with a point light");
    if (point && settings->shadow == GN_SHADOW_VOLUMES)
        return problem_of_usage(why, "shadow volumes take no point light; expected a method with a shadow map");
    if (point && choices_use_view(settings))
        return problem_of_usage(why, "--parameterise takes no point light; expected uniform");
    if (read_choice("--faces", value, &choices_faces, &faces, why))
        return -1;
    if (value && !faces)
        return problem_of_usage(why, "--faces none, but the light is a point light; expected six or one");
    settings->faces = choices_faces.all[faces].object;
    return 0;
}

static int read_amounts(gn_settings *settings, const packed_scene *packed, const char *const values[], problem *why)
{
    double slope;
    if (values[RENDER_SLOPE]) {
        if (!choices_use_slope(settings))
            return problem_of_usage(why, "--slope has no meaning here; expected the virtual surface 'slope' or the "
                                         "receiver 'plane-bias'");
        if (option_decimal("--slope", values[RENDER_SLOPE], 0, 64, &slope, why))
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
                   {RENDER_PARAMETERISE, "--parameterise"},
                   {RENDER_SMOOTHING, "--smoothing"},
                   {RENDER_FIT_DEPTH, "--fit-depth"}};
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

/* Is it the fit or the warp that the core does not take with the rest? */
static int parameterisation_is_refused(const gn_settings *s, const packed_scene *packed)
{
    gn_settings uniform = *s;
    gn_plan plan;
    uniform.fit = 0;
    uniform.warp = 0;
    uniform.fit_depth = 0;
    uniform.smoothing = 0;
    return choices_use_view(s) && gn_make_plan(&plan, &packed->scene, &uniform) == GN_OK;
}

static int refuse_combination(const gn_settings *s, problem *why)
{
    char words[PARAMETERISATION_SIZE];
    choices_parameterisation(s, words);
    return problem_of_usage(
        why,
        "--parameterise %s makes no sense with the virtual surface %s, the receiver %s and the reconstruction %s; "
        "expected another surface than slope, point, virtual or virtual-always, and nearest",
        words, choices_surface.all[s->surface].word,
        choices_receiver.all[choices_number(&choices_receiver, s->receiver)].word,
        choices_reconstruction.all[choices_number(&choices_reconstruction, s->reconstruction)].word);
}

/* The same rules as gn_make_plan, in words. */
static int check_combination(const gn_settings *s, const packed_scene *packed, problem *why)
{
    gn_plan plan;
    gn_status status = gn_make_plan(&plan, &packed->scene, s);
    if (status == GN_UNSUPPORTED && (s->receiver || s->reconstruction) && (s->map_width < 2 || s->map_height < 2))
        return refuse_small_map(s, why);
    if (status == GN_UNSUPPORTED && parameterisation_is_refused(s, packed))
        return refuse_combination(s, why);
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
    if (read_method(settings, packed, values, why))
        return -1;
    int volumes = settings->shadow == GN_SHADOW_VOLUMES;
    if ((volumes && check_volumes(values, why)) || read_view_pass(settings, values, why) ||
        read_light_pass(settings, values, why) || read_camera_pass(settings, values, why) ||
        read_faces(settings, packed, values[RENDER_FACES], why) || read_amounts(settings, packed, values, why) ||
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
