/* The light pass's share of crossing maps: where a silhouette crosses the sides of the cells between texels.
 *
 * A byte a texel, of the two sides that run from its centre: low 4 bits to the texel on its right, high 4 bits to the
 * one below. 1 to 15: a crossing at so many sixteenths from this texel, to the nearest but 0 and 16, which are 1 and
 * 15; 0: none.
 *
 * A side lies between two texels, one on the caster's side of an edge that crosses it, by the edge's winding. The
 * crossing counts if that texel is nearer to the light than the other, and the edge as well. Of several the one that
 * comes nearest to the farther texel stays: the outermost of the shadow. Which texel that is is the same for all of
 * them, so it is the largest code, or the smallest: the map does not depend on the order of edges, on regions or on
 * workers, and no depth is kept with a crossing. Folds within a surface come out inwards of its border, so every edge
 * of every triangle may be drawn, and meshes do without edges.
 *
 * Places that lie on an edge exactly belong to its right, on a level edge below it, as in gn_raster.h. Crossings and
 * their depths are found as quotients with remainders, exactly. The lowest bit of a depth may be a mark (mixed
 * surfaces) and is left out.
 *
 * Memory: that of gn_drawing.h. Cost: a division a row and a column of texels that an edge passes, another where its
 * crossing would stay. */
#ifndef GN_CROSSING_MAP_H
#define GN_CROSSING_MAP_H

#include "gn_drawing.h"

#define GN_HALF_WAY 8u /* where a side is taken to be crossed that has no crossing */

extern const gn_drawing gn_draw_crossings;

#endif
