/* From a scene file to integers: one power-of-two scale for the whole scene.
 *
 * Every `mesh` line becomes one object whose vertices are world positions already (scale, rotate and translate in
 * double, sine and cosine from the core so that every machine gets the same bits; rounded once, half away from zero).
 * The largest coordinate falls into (2^23, 2^24]; where an eye, target, light or image height would leave the core's
 * range the scale is lowered to 22 significant bits at worst, and what needs more than that is refused. Near and far
 * planes beyond the core's range are clamped to it: no vertex can lie there (docs/number-formats.md).
 */
#ifndef QUANTISE_H
#define QUANTISE_H

#include "packed.h"
#include "scene_file.h"

/* Read the scene's meshes and fill *packed; packed_free() it afterwards, also after an error. 0, or -1 and the problem.
 */
int quantise(packed_scene *packed, const scene_file *scene, int verbose, problem *why);

/* `B` (world units), `Bt` (texels) or `Br` (units of the light's depth range) as a bias; scale as in packed_scene.
 * Rounded half up. 0, or -1 and the problem. */
int quantise_bias(gn_bias *bias, const char *string, int scale, problem *why);

#endif
