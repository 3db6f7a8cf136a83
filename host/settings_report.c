#include "settings_report.h"

#include "choices.h"

#include <math.h>

/* In the unit of the option: world units of the scene file, texels, or shares of the light's depth range. */
static double bias_of(const gn_bias *bias, int scale)
{
    int exponent = bias->unit == GN_BIAS_TEXELS ? -16 : bias->unit == GN_BIAS_RANGE ? -32 : -scale;
    return ldexp(bias->value, exponent);
}

static const char *word_of(const choices *of, const void *object)
{
    return of->all[choices_number(of, object)].word;
}

void settings_report_text(FILE *stream, const gn_settings *s, const gn_plan *plan, int scale)
{
    static const char *const units[] = {"", "t", "r"};
    char words[PARAMETERISATION_SIZE];
    fprintf(stream, "virtual surface %s, layers %s, cull %s", choices_surface.all[s->surface].word,
            choices_layers.all[plan->layers].word, choices_cull.all[plan->cull].word);
    if (s->surface != GN_MIDPOINT)
        fprintf(stream, ", bias %g%s", bias_of(&s->bias, scale), units[s->bias.unit]);
    if (choices_use_slope(s))
        fprintf(stream, ", slope %g", ldexp(s->slope, -16));
    fprintf(stream, ", receiver %s, reconstruction %s", word_of(&choices_receiver, s->receiver),
            word_of(&choices_reconstruction, s->reconstruction));
    if (s->faces)
        fprintf(stream, ", faces %s", word_of(&choices_faces, s->faces));
    if (!choices_use_view(s))
        return;
    choices_parameterisation(s, words);
    fprintf(stream, ", parameterisation %s%s", words, s->fit_depth ? ", depth fitted" : "");
    if (s->smoothing)
        fprintf(stream, ", smoothing %g", ldexp(s->smoothing, -16));
}

void settings_report_json(json *j, const gn_settings *s, const gn_plan *plan, int scale)
{
    char words[PARAMETERISATION_SIZE];
    json_string(j, "shadow", choices_shadow.all[s->shadow].word);
    if (s->shadow != GN_SHADOW_MAP)
        return;
    json_integer(j, "map_width", s->map_width);
    json_integer(j, "map_height", s->map_height);
    json_string(j, "virtual_surface", choices_surface.all[s->surface].word);
    json_string(j, "layers", choices_layers.all[plan->layers].word);
    json_string(j, "cull", choices_cull.all[plan->cull].word);
    if (s->surface != GN_MIDPOINT) {
        json_number(j, "bias", bias_of(&s->bias, scale));
        json_string(j, "bias_unit", choices_bias_unit.all[s->bias.unit].word);
    }
    if (choices_use_slope(s))
        json_number(j, "slope", ldexp(s->slope, -16));
    json_string(j, "receiver", word_of(&choices_receiver, s->receiver));
    json_string(j, "reconstruction", word_of(&choices_reconstruction, s->reconstruction));
    choices_parameterisation(s, words);
    json_string(j, "parameterisation", words);
    if (s->faces)
        json_string(j, "faces", word_of(&choices_faces, s->faces));
    if (s->fit)
        json_integer(j, "fit_depth", s->fit_depth);
    if (s->warp)
        json_number(j, "smoothing", s->smoothing ? ldexp(s->smoothing, -16) : 1);
}
