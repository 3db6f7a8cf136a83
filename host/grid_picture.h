/* A parameterised map as a picture: the grid of its texels over the depths of the light's whole plane.
 *
 * Depths are grey, as in depth_picture.h, one pixel each. Through the centres of texels run lines, orange along columns
 * and blue along rows: of every column and row of a small map, of larger ones of every k-th and of the last, 65 at most
 * each way. A red frame is the rectangle that the map covers. So where lines are close, texels are small.
 */
#ifndef GRID_PICTURE_H
#define GRID_PICTURE_H

#include "gnomon.h"
#include "image.h"

enum { GRID_PICTURE_SIDE = 1024 }; /* pixels of the plane's longer side */

/* The picture's size: the light's box, or its square frustum, with a longer side of GRID_PICTURE_SIDE. */
void grid_picture_size(const gn_light *light, uint16_t size[2]);

/* Depths: width x height, of a uniform map of the plane. places: gn_texel_place of every texel, columns x rows.
 * 8-bit colour; image_free() it. A position is shown at the pixel that holds it, and not at all beyond the plane. */
image grid_picture(const gn_depth *depths, uint32_t width, uint32_t height, const gn_rectangle *rectangle,
                   uint32_t (*places)[2], uint32_t columns, uint32_t rows);

#endif
