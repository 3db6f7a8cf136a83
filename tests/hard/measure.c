/* One method on one scene, and what is wrong with its mask. */
#include "hard.h"

#include "choices.h"
#include "memory.h"
#include "method.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

const char *const method_names[COLUMN_ALL] = {"constant", "midpoint",   "dual",           "second_depth",  "mixed",
                                              "auto",     "volumes",    "second_virtual", "mixed_virtual", "adaptive",
                                              "slope",    "plane_bias", "filter",         "silhouettes",   "crossings"};

gn_settings method_settings(const packed_scene *packed, int method, unsigned flags)
{
    static const int presets[COLUMN_ALL] = {GN_CONSTANT, GN_MIDPOINT,       GN_DUAL,          GN_SECOND,
                                            GN_MIXED,    METHOD_AUTO,       METHOD_VOLUMES,   GN_SECOND,
                                            GN_MIXED,    METHOD_ADAPTIVE,   GN_SLOPE,         GN_CONSTANT,
                                            METHOD_AUTO, METHOD_SILHOUETTE, METHOD_SILHOUETTE};
    gn_settings s = packed->settings;
    s.mask = 1;
    s.format = GN_NO_COLOUR;
    method_use(&s, packed, presets[method]);
    if (method == COLUMN_CONSTANT || method == COLUMN_DUAL || method == COLUMN_MIXED ||
        method == COLUMN_MIXED_VIRTUAL || method >= COLUMN_SILHOUETTES)
        s.bias = packed->settings.bias;
    if (method == COLUMN_SECOND_VIRTUAL || method == COLUMN_MIXED_VIRTUAL)
        s.receiver = &gn_virtual;
    if (method == COLUMN_PLANE_BIAS) {
        s.receiver = &gn_plane_bias;
        s.slope = 1 << 16;
        s.bias = (gn_bias){GN_BIAS_RANGE, 2147484}; /* 0.0005, as of slope */
    }
    if (method == COLUMN_FILTER)
        s.reconstruction = &gn_box_5x5;
    if (method == COLUMN_CROSSINGS)
        s.reconstruction = &gn_crossings;
    if (method == COLUMN_MIDPOINT && flags & CULL_BACK)
        s.cull = GN_CULL_BACK;
    if (method == COLUMN_DUAL && flags & CULL_NONE)
        s.cull = GN_CULL_NONE;
    return s;
}

/* Copied out of the frame, which may have more rows. */
static uint8_t *keep(const uint8_t *from, size_t bytes)
{
    uint8_t *copy = memory_take(bytes, 1);
    memcpy(copy, from, bytes);
    return copy;
}

int method_render(packed_scene *packed, const gn_settings *settings, uint8_t **mask, uint8_t **colour, problem *why)
{
    frame f;
    gn_settings s = *settings;
    size_t count = (size_t)s.width * s.height;
    s.format = colour ? GN_RGB888 : GN_NO_COLOUR;
    if (choices_use_edges(&s) && packed_make_edges(packed, 0, why))
        return -1;
    int result = frame_open(&f, &packed->scene, &s, 0, why) ||
                         frame_view_pass(&f, &packed->camera, &packed->light, why) ||
                         frame_light_pass(&f, &packed->light, why) || frame_camera_pass(&f, &packed->camera, why)
                     ? -1
                     : 0;
    if (!result && mask)
        *mask = keep(f.mask, count);
    if (!result && colour)
        *colour = keep(f.colour, 3 * count);
    frame_close(&f);
    return result;
}

double percent_of(const hard_row *row, uint64_t count)
{
    return row->truth.surface ? 100.0 * (double)count / (double)row->truth.surface : 0;
}

void measure(hard_row *row, outcome *o, int method)
{
    const truth *t = &row->truth;
    comparison c;
    comparison_make(&c, &(comparison_input){t->width, t->height, o->mask, t->mask, row->near, COMPARISON_EDGE_BAND});
    const comparison_figures *f = &c.not_near;
    o->false_shadow = f->false_shadow.pixels;
    o->false_light = f->false_light.pixels;
    o->shadow_percent = percent_of(row, o->false_shadow);
    o->light_percent = percent_of(row, o->false_light);
    o->coverage = f->coverage;
    o->own_shadow = o->own_light = 0;
    for (size_t i = 0; i < (size_t)t->width * t->height; i++) {
        if (row->near[i] || o->mask[i] == t->mask[i] || o->mask[i] == 255 || t->mask[i] == 255)
            continue;
        int radius = method == COLUMN_FILTER ? FILTER_RADIUS : method >= COLUMN_SILHOUETTES ? 1 : 0;
        int explained = radius ? footprint_differs_about(&row->footprint, i, t->mask[i], radius)
                               : footprint_differs(&row->footprint, i, t->mask[i]);
        if (!explained)
            *(t->mask[i] ? &o->own_shadow : &o->own_light) += 1;
    }
}

/* ---- rows ------------------------------------------------------------------------------------------------------ */

static void check_truth(hard_row *row)
{
    const truth *t = &row->truth;
    const hard_case *c = row->about;
    size_t count = (size_t)t->width * t->height, differ = 0, asked = 0, wrong = 0, first = 0;
    promise(row, c->flags & NO_LIGHT ? t->lit == 0 : t->lit > 0, 0, "%s_has_%s_pixel", c->name,
            c->flags & NO_LIGHT ? "no_lit" : "a_lit");
    promise(row, c->flags & NO_SHADOW ? t->shadowed == 0 : t->shadowed > 0, 0, "%s_has_%s_pixel", c->name,
            c->flags & NO_SHADOW ? "no_shadowed" : "a_shadowed");
    for (size_t i = 0; i < count; i++) {
        if (row->near[i])
            continue;
        differ += row->footprint.mask[i] != t->mask[i];
        if (!c->by_hand || t->mask[i] == 255)
            continue;
        double point[3];
        for (int k = 0; k < 3; k++)
            point[k] = (row->footprint.points[i][k] - row->origin[k]) / row->unit;
        int expected = c->by_hand(point);
        if (expected == BY_HAND_UNSAID)
            continue;
        asked++;
        if (expected != t->mask[i] && !wrong++)
            first = i;
    }
    if (!promise(row, differ == 0, 0, "%s_is_seen_alike_by_a_second_ray_caster", c->name))
        say("%zu pixels differ", differ);
    if (c->by_hand && !promise(row, wrong == 0 && asked > 0, 0, "%s_has_the_truth_worked_out_by_hand", c->name))
        say("%zu of %zu pixels differ, the first at %zu, %zu: expected %d, got %d", wrong, asked, first % t->width,
            first / t->width, t->mask[first] ? 0 : 254, t->mask[first]);
}

int row_begin(hard_row *row, void (*build)(builder *b), int with_near)
{
    builder b;
    build_begin(&b);
    build(&b);
    int failed = build_finish(&b, &row->packed);
    row->unit = b.unit;
    memcpy(row->origin, b.origin, sizeof row->origin);
    gn_status status = b.status;
    build_free(&b);
    if (!promise(row, !failed, 0, "%s_is_within_the_ranges", row->about->name)) {
        say("status %d", status);
        return -1;
    }
    return row_begin_packed(row, with_near, row->about->build == build);
}

int row_begin_packed(hard_row *row, int with_near, int with_checks)
{
    problem why;
    const gn_settings *s = &row->packed.settings;
    footprint_make(&row->footprint, &row->packed);
    int failed = truth_make(&row->truth, &row->packed, s->width, s->height, 1, with_near, &why);
    if (!promise(row, !failed, 0, "%s_has_a_truth", row->about->name)) {
        say("%s", why.text);
        return -1;
    }
    size_t count = (size_t)s->width * s->height;
    row->near = memory_take(count, 1);
    int count_ties = row->about->flags & COUNT_TIES;
    for (size_t i = 0; i < count; i++)
        row->near[i] = !count_ties && (row->truth.ties[i] || (row->truth.near && row->truth.near[i])) ? 255 : 0;
    if (with_checks)
        check_truth(row);
    return 0;
}

void row_forget(outcome *o)
{
    free(o->mask);
    memset(o, 0, sizeof *o);
}

void row_remark(hard_row *row, const char *format, ...)
{
    size_t used = strlen(row->remark);
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(row->remark + used, sizeof row->remark - used, format, arguments);
    va_end(arguments);
}

void row_measure(hard_row *row, int method, const gn_settings *settings)
{
    outcome *o = &row->outcomes[method];
    problem why;
    row_forget(o);
    if (method_render(&row->packed, settings, &o->mask, 0, &why)) {
        snprintf(o->refusal, sizeof o->refusal, "%.150s", why.text);
        return;
    }
    o->ran = 1;
    measure(row, o, method);
}

void row_end(hard_row *row)
{
    for (int i = 0; i < COLUMN_ALL; i++) {
        free(row->outcomes[i].mask);
        row->outcomes[i].mask = 0;
    }
    free(row->near);
    row->near = 0;
    footprint_free(&row->footprint);
    truth_free(&row->truth);
    packed_free(&row->packed);
}
