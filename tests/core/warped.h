/* Maps with columns and rows of any width: after a view pass the tables of a rectilinear warp are written over. */
#ifndef WARPED_H
#define WARPED_H

#include "gn_parameterisation.h"
#include "scenes.h"

enum { MOST_TEXELS = 256 };

typedef struct tables {
    uint16_t columns[MOST_TEXELS], rows[MOST_TEXELS];
} tables;

/* Strictly increasing: evenly, of steps that differ little, or of very unequal ones, many of a single fine texel. */
static TAP_UNUSED void random_steps(uint16_t *table, int32_t count)
{
    int32_t total = 1, sum[MOST_TEXELS + 1], how = between(0, 3);
    for (int32_t i = 0; i <= count; i++) {
        total += how == 0                    ? 1
                 : how == 1 || between(0, 2) ? between(1, 8)
                 : how == 2                  ? 1 << between(0, 10)
                                             : between(0, 1) << 12;
        sum[i] = total;
    }
    for (int32_t i = 0; i < count; i++) /* the first weight and the last are the borders' */
        table[i] = (uint16_t)(i + (int64_t)(GN_FINE - count) * sum[i] / total);
}

static TAP_UNUSED void random_tables(tables *t, const gn_settings *settings)
{
    random_steps(t->columns, settings->map_width);
    random_steps(t->rows, settings->map_height);
}

/* A view pass, so that the light pass may follow, and the tables in place of those that it made. */
static TAP_UNUSED gn_status warp_frame(frame *f, const gn_light *light, const gn_camera *camera, const tables *t)
{
    gn_status status = gn_view_pass(f->context, camera, light);
    if (status != GN_OK)
        return status;
    memcpy(f->context->fitting->columns, t->columns, f->settings.map_width * sizeof *t->columns);
    memcpy(f->context->fitting->rows, t->rows, f->settings.map_height * sizeof *t->rows);
    return GN_OK;
}

#endif
