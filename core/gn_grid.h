/* The grid of a warped map: where its texels lie.
 *
 * A warped map is some of the texels of a uniform map of GN_FINE x GN_FINE over the same rectangle of the light's
 * plane: those in some of its columns and rows. So the top-left rule, planes and virtual samples are those of a uniform
 * map, bit for bit, at unequal steps. */
#ifndef GN_GRID_H
#define GN_GRID_H

#include <stdint.h>

#define GN_FINE_BITS 12
#define GN_FINE (1 << GN_FINE_BITS)

typedef struct gn_grid {
    /* rectilinear: the fine column (row) at whose centre each column (row) of texels lies, strictly increasing */
    const uint16_t *columns, *rows;
    /* non-orthogonal, else 0: fine column of texel column i in band b of GN_FINE / rows fine rows, at [b columns + i];
     * fine row of texel row j in texel column i, at [i rows + j] */
    const uint16_t *across, *down;
} gn_grid;

#endif
