/* A silhouette map (Sen, Cammarano & Hanrahan 2003) as a picture over the depth map that it belongs to, as the middle
 * of their figure 9.
 *
 * A depth sample is a block of S x S pixels, grey by depth: 224 the nearest of the map down to 32 the farthest, 0 where
 * there is no surface. A cell lies between the centres of four blocks; its point is a red dot. From S = 8 on, the
 * points of two cells side by side, or one above the other, are joined by an orange line: a stretch of the shadow's
 * border. A cell whose point is its centre is taken for one without a point, as the map has no other mark.
 */
#ifndef SILHOUETTE_PICTURE_H
#define SILHOUETTE_PICTURE_H

#include "gnomon.h"
#include "image.h"

/* S: as large as lets the longer side have 2048 pixels at most, from 1 to 16. */
uint32_t silhouette_picture_block(uint32_t width, uint32_t height);

/* Depths: width x height, 2 x 2 or more, packed. Map: a byte a cell, low 4 bits x, high 4 bits y, in 1/16 texel from
 * the centre of the texel with the cell's number; (width - 1) x (height - 1) of them, `stride` bytes from row to row.
 * 8-bit colour; image_free() it. A position is shown at the pixel that holds it: one on a pixel's border at the pixel
 * to the right or below. */
image silhouette_picture(const gn_depth *depths, uint32_t width, uint32_t height, const uint8_t *map, uint32_t stride);

#endif
