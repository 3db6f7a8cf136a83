/* The scenes of a sweep: read once, with edges, shared by all workers; and their exact truths, kept in the folder.
 */
#ifndef SWEEP_SCENE_H
#define SWEEP_SCENE_H

#include "packed.h"
#include "problem.h"

typedef struct sweep_scene {
    const char *path;
    char name[60];          /* no two scenes have the same */
    uint64_t hash;          /* of all that the picture hangs on */
    uint32_t width, height; /* of the image */
    packed_scene packed;
    uint8_t *truth; /* a mask; 0 before sweep_scene_truth() */
    uint64_t surface, lit, shadowed;
} sweep_scene;

/* Read them; size: of the image, 0: each scene's own. sweep_scenes_free() them, also after an error. 0, or -1 and the
 * problem. */
int sweep_scenes_read(sweep_scene *scenes, int count, const char *const paths[], const long size[2], problem *why);

/* The truth of NAME.truth.pgm in the folder, where that is of this scene and size; else cast, and written there. 0, or
 * -1 and the problem. */
int sweep_scene_truth(sweep_scene *scene, const char *folder, int workers, problem *why);

void sweep_scenes_free(sweep_scene *scenes, int count);

/* FOLDER/NAME, with END behind it; free() it. */
char *sweep_path(const char *folder, const char *name, const char *end);

#endif
