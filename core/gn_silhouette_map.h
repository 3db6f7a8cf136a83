/* The light pass's share of silhouette maps (Sen et al. 2003, 3.1): which edges are silhouettes, their segments on the
 * map, and one point a cell.
 *
 * Of several segments in a cell one that separates the texels about it wins over one that does not, then the one that
 * is nearer to the light at its point, at equal depth the smaller byte: so the map does not depend on the order of
 * edges, on regions or on workers. A point that lies behind all four texels of its cell is hidden and not written: they
 * are the nearest layer's, before it is resolved; with front faces culled that layer holds back faces, and the test
 * lets more pass.
 *
 * Memory: that of gn_drawing.h, and during the light pass a depth a texel of a region and worker. */
#ifndef GN_SILHOUETTE_MAP_H
#define GN_SILHOUETTE_MAP_H

#include "gn_drawing.h"

#define GN_CELL_CENTRE 0x88u /* a cell without a silhouette: half a texel both ways */

extern const gn_drawing gn_draw_silhouettes;

#endif
