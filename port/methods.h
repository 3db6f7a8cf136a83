/* The methods of the golden firmware (firmware.c): what its scenes are rendered by. */
#ifndef METHODS_H
#define METHODS_H

#include "gnomon.h"

enum { WIDTH = 160, HEIGHT = 120, MAP = 128 };

/* A scene as it was packed; or MOVED: seen by an orthographic camera, its last object turned and mirrored by a model
 * matrix, and a spot light's near plane pushed into it; or SOUP: its last object's mesh without edges; or a point
 * light in place of its own, LAMP_BEHIND most of it, or LAMP_WITHIN: near its middle. */
typedef enum staging { AS_PACKED, MOVED, SOUP, LAMP_BEHIND, LAMP_WITHIN } staging;

typedef struct method {
    const char *name;
    gn_surface surface;
    gn_cull cull;
    gn_layers layers;
    gn_format format;
    gn_bias bias;
    gn_q16_16 slope;
    const gn_receiver *receiver;
    const gn_reconstruction *reconstruction;
    const gn_fit *fit;
    const gn_warp *warp;
    gn_q16_16 smoothing;
    uint8_t fit_depth;
    gn_shadow shadow;
    const gn_faces *faces;
    const gn_casters *casters; /* all objects but the last stand still */
    staging staging;
} method;

extern const method methods[];
extern const uint32_t method_count;

/* Small regions: the same pictures, of several regions of map and image. */
gn_settings settings_of(const method *by, int small_regions);

#endif
