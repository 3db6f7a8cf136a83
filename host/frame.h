/* One frame: a context of the core, its memory, worker threads, and the whole image and map put together from regions.
 *
 * Regions are independent jobs; `workers` threads take them one after the other from a queue. The result is the same
 * for any number of workers.
 */
#ifndef FRAME_H
#define FRAME_H

#include "gnomon.h"
#include "problem.h"
#include "stage_hash.h"

typedef struct frame {
    gn_settings settings;
    gn_plan plan;
    gn_context *context;
    gn_rectangle rectangle; /* what the map covers of the light's plane, after a view pass */
    void *memory;
    uint8_t *colour; /* width x height x 3, rows from the top; 0 with GN_NO_COLOUR */
    uint8_t *mask;   /* width x height; 0 unless settings.mask */
    int keep_layers; /* 1: fill layers[] and map while the light pass runs */
    int layer_count;
    /* map_width x map_rows, the height, or six times that: a point light's faces one below the other. 0 where no map
     * stays: with shadow volumes, and of a point light with one map at a time */
    gn_depth *layers[2], *map;
    uint32_t map_rows;
    uint32_t face;                                      /* whose map is drawn */
    gn_light light;                                     /* of the latest light pass */
    double view_seconds, light_seconds, camera_seconds; /* of the latest passes; 0 without a view pass */
    uint8_t **worker_colour, **worker_mask;             /* a region each, where regions are narrower than the image */
} frame;

/* Plan and allocate. scene must outlive the frame. frame_close() it, also after an error. 0, or -1 and the problem. */
int frame_open(frame *f, const gn_scene *scene, const gn_settings *settings, int keep_layers, problem *why);

/* For the light pass that follows; nothing where the map is neither fitted nor warped. */
int frame_view_pass(frame *f, const gn_camera *camera, const gn_light *light, problem *why);

/* After a view pass: where each texel lies in f->rectangle (gn_texel_place), map_width x map_height; free() it. */
uint32_t (*frame_texel_places(const frame *f))[2];

/* Of a point light with one map at a time the camera pass draws the maps as well. */
int frame_light_pass(frame *f, const gn_light *light, problem *why);
int frame_camera_pass(frame *f, const gn_camera *camera, problem *why);

void frame_close(frame *f);

/* Hashes of the stages (host/stage_hash.h); layers and map need keep_layers, the others colour and mask. */
stage_hash frame_hash_layers(const frame *f);
stage_hash frame_hash_map(const frame *f);
/* Of the cells between texels, or of all texels of a map of crossings; of nothing where there is neither. */
stage_hash frame_hash_silhouettes(const frame *f);
/* After a view pass: of the rectangle that the map covers, and of where its texels lie. */
stage_hash frame_hash_warp(const frame *f);
stage_hash frame_hash_mask(const frame *f);
stage_hash frame_hash_colour(const frame *f);

/* Seconds on a clock that only runs forward. */
double frame_clock(void);

#endif
