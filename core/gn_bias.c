/* Depths along the light: from world units, texels or shares of the range to units of stored depth. */
#include "gn_context.h"

uint32_t gn_make_bias(const gn_context *context, const gn_bias *bias)
{
    const gn_light *light = &context->light;
    gn_scaled width = gn_scale(context->texels_across, -8), height = gn_scale(context->texels_down, -8);
    gn_scaled value = gn_scale(bias->value, bias->unit == GN_BIAS_RANGE ? -32 : bias->unit == GN_BIAS_TEXELS ? -16 : 0);
    if (bias->unit != GN_BIAS_RANGE) {
        /* world: the range's share of one world unit; texels: of one texel, mean of both axes */
        gn_scaled unit;
        if (light->kind == GN_DIRECTIONAL) {
            gn_scaled depth = gn_scale(light->box_depth, 0);
            unit = gn_scaled_divide(gn_scale(1, 0), depth);
            if (bias->unit == GN_BIAS_TEXELS) {
                gn_scaled u = gn_scaled_divide(gn_scale(light->box_width, -1), width);
                gn_scaled v = gn_scaled_divide(gn_scale(light->box_height, -1), height);
                unit = gn_scaled_multiply(unit, gn_scaled_add(u, v));
            }
        } else {
            /* dz/dw = f n / ((f - n) w^2) at w = sqrt(n f); a texel there is 2 tan w / N wide */
            gn_scaled range = gn_scale((int64_t)light->far_depth - light->near_depth, 0);
            unit = gn_scaled_divide(gn_scale(1, 0), range);
            if (bias->unit == GN_BIAS_TEXELS) {
                uint64_t product = gn_multiply_u((uint32_t)light->near_depth, (uint32_t)light->far_depth);
                gn_scaled w = gn_scale(gn_square_root(product << 4), -2);
                gn_scaled tangent = gn_scale(light->tan_half, -24);
                gn_scaled inverse = gn_scaled_add(gn_scaled_divide(tangent, width), gn_scaled_divide(tangent, height));
                unit = gn_scaled_multiply(unit, gn_scaled_multiply(w, inverse));
            }
        }
        value = gn_scaled_multiply(value, unit);
    }
    value = gn_scaled_multiply(value, gn_scale(GN_DEPTH_SPAN, 1));
    return gn_scaled_bits(value) > 32 ? 0xffffffffu : (uint32_t)gn_scaled_round(value, 0);
}
