/* What warps share. */
#ifndef GN_WARPS_H
#define GN_WARPS_H

#include "gn_parameterisation.h"

/* gn_grid.c: of gn_warp, of rectilinear ones. */
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

/* A receiver's plane allows for a texel's centre half a texel away from its triangle; so much more where texels are
 * width fine ones wide, units of z. */
int64_t gn_wide_slack(const gn_lookup *l, const gn_points *points, int32_t i, int32_t width);

/* gn_rectilinear.c, gn_nonorthogonal.c: their rounds of the view pass, and the latter's tables. */
extern const gn_round gn_round_of_counts, gn_rounds_of_bands[2];
uint64_t gn_nonorthogonal_bytes(const gn_settings *settings);
void gn_lay_out_nonorthogonal(gn_context *context, uint16_t *tables);

/* The column of texels of a place in fine texels, and *u: where it is between the columns. */
uint32_t gn_find_bent_column(const gn_grid *grid, uint32_t *u, uint32_t v, uint32_t bits, gn_interval *interval);

#endif
