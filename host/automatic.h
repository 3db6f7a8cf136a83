/* `--method auto` with a budget: the cheapest way to the shadows of this scene and view within so many bytes, or with
 * so much error.
 *
 *     automatic.c            the options, and the line that says what was chosen and why
 *     automatic_search.[ch]  which candidates are tried, and which is taken
 *     automatic_trial.[ch]   a candidate on this scene, against its truth
 *     automatic_cost.[ch]    what it costs a small machine
 *     automatic_chain.[ch]   candidates: settings, bytes, what the tables expect
 *     automatic_table.[ch]   measured on other scenes: generated
 *     automatic_scene.[ch]   what the scene contains
 *
 * Tables alone cannot tell the best candidates apart: which of them suits a view hangs on how its edges happen to lie
 * on the texels (docs/accuracy.md). So they only say what is worth a trial.
 */
#ifndef AUTOMATIC_H
#define AUTOMATIC_H

#include "render_options.h"

/* After render_options_read, of the same values: without a budget nothing; else replace the choices of *settings, its
 * image, workers and faces kept, and say which and why in a line on standard error. Trials take 30 to 100 frames and
 * the truth once: some seconds. Gives meshes their edges. 0, or -1 and the problem: options that go with no budget, a
 * budget that no map fits. */
int automatic_options_read(gn_settings *settings, packed_scene *packed, const char *const values[], problem *why);

#endif
