/* The named methods of the command line: presets of everything that settings say about how shadows are made. */
#ifndef METHOD_H
#define METHOD_H

#include "packed.h"

/* The first ones are virtual surfaces, in the order of gn_surface. */
enum { METHOD_ADAPTIVE = GN_SLOPE + 1, METHOD_SILHOUETTE, METHOD_AUTO, METHOD_VOLUMES, METHOD_COUNT };

extern const char *const method_words[METHOD_COUNT];

/* The virtual surface that the method names; -1: none, as METHOD_AUTO takes what suits the scene and METHOD_VOLUMES
 * has no map. */
int method_surface(int method);

/* Set shadow, cull, layers, surface, bias, slope, receiver and reconstruction, and no fit and no warp; nothing else of
 * *settings. */
void method_use(gn_settings *settings, const packed_scene *packed, int method);

#endif
