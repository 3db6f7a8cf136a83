/* The exact answer for one point of the image: what its eye ray sees, and whether light gets there. */
#ifndef TRUTH_TRACE_H
#define TRUTH_TRACE_H

#include "packed.h"
#include "truth.h"
#include "truth_bvh.h"

enum { TRUTH_MOST_PLANES = 6, TRUTH_SHADOWED = 0, TRUTH_LIT = 254, TRUTH_NO_SURFACE = 255 };

typedef struct truth_scene {
    truth_view view;
    truth_triangle *triangles; /* of some area, in the order of the leaves */
    bvh tree;
    truth_plane planes[TRUTH_MOST_PLANES]; /* a spot light's frustum */
    int plane_count;
} truth_scene;

/* Take the world's triangles, camera and light of a packed scene, and check all their ranges. truth_scene_close() it,
 * also after an error. 0, or -1 and the problem. */
int truth_scene_open(truth_scene *scene, const packed_scene *packed, uint32_t width, uint32_t height, problem *why);
void truth_scene_close(truth_scene *scene);

/* One worker's memory: triangles that the latest points met are likely to meet the next one. They save time and change
 * no answer. */
typedef struct truth_memory {
    const truth_triangle *surface, *blocker;
    uint64_t exact_decisions;
} truth_memory;

typedef struct truth_answer {
    uint8_t mask; /* 0, 254, 255 */
    truth_reason reason;
} truth_answer;

/* x, y: 1/256 pixels from the upper left corner; a pixel's centre is at 256 i + 128. */
truth_answer truth_trace(const truth_scene *scene, int32_t x, int32_t y, truth_memory *memory);

#endif
