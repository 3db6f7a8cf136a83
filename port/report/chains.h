/* The chains of the report: whole ways to shadow a frame, from the surface to the parameterisation, by the names that
 * `gnomon sweep` has for them. */
#ifndef CHAINS_H
#define CHAINS_H

#include "gnomon.h"

typedef struct chain {
    const char *name;
    gn_surface surface;
    gn_bias bias;
    gn_q16_16 slope;
    const gn_receiver *receiver;
    const gn_reconstruction *reconstruction;
    const gn_fit *fit;
    const gn_warp *warp;
    gn_shadow shadow; /* volumes: without a map, so once a scene and image */
} chain;

extern const chain chains[];
extern const uint32_t chain_count;

/* As a small machine takes it: RGB565, no mask, one worker, regions as planned. */
gn_settings chain_settings(const chain *by, uint16_t width, uint16_t height, uint16_t map);

#endif
