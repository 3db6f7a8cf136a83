/* What rectilinear warps share (gn_grid.c). */
#ifndef GN_RECTILINEAR_H
#define GN_RECTILINEAR_H

#include "gn_parameterisation.h"

uint64_t gn_rectilinear_bytes(const gn_settings *settings);
void gn_lay_out_rectilinear(gn_context *context, uint16_t *tables);

/* Columns and rows: so many words are summed up. */
GN_INLINE uint32_t gn_warp_lines(const gn_settings *s)
{
    return (uint32_t)s->map_width + s->map_height;
}

/* Bytes of a round's sums, and of what gn_end_rectilinear needs behind them. */
uint64_t gn_rectilinear_sums(const gn_settings *settings);

/* From importances of the columns, then of the rows, to the tables. */
void gn_end_rectilinear(gn_context *context, uint32_t *importance);

#endif
