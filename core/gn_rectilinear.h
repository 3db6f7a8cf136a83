/* What rectilinear warps share (gn_grid.c). */
#ifndef GN_RECTILINEAR_H
#define GN_RECTILINEAR_H

#include "gn_parameterisation.h"

uint64_t gn_rectilinear_bytes(const gn_settings *settings);
void gn_lay_out_rectilinear(gn_context *context, uint16_t *tables);

/* From importances of the columns, then of the rows, to the tables; scratch: gn_warp_scratch words. */
void gn_end_rectilinear(gn_context *context, uint32_t *importance, uint32_t *scratch);

GN_INLINE uint64_t gn_warp_scratch(const gn_settings *s)
{
    return 2 * (uint64_t)(s->map_width > s->map_height ? s->map_width : s->map_height);
}

#endif
