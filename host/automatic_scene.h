/* What a scene contains and what its view shows, as far as the choice of a method hangs on it. */
#ifndef AUTOMATIC_SCENE_H
#define AUTOMATIC_SCENE_H

#include "packed.h"

typedef struct automatic_scene {
    /* Objects with triangles; open ones are flat where all their corners lie in one plane, to two units: floors, walls.
     */
    uint32_t closed, flat, open;
    uint8_t light; /* gn_light_kind */
    double share;  /* of the light's plane that the smallest rectangle about what is seen takes; 1: a point light */
    /* Pixels between texels that disagree, % of those that see a surface, with silhouettes and a map of
     * AUTOMATIC_PROBE texels a side: of the whole plane, and msf+rectilinear. What errors are in proportion to. A
     * point light: both uniform. */
    double uniform_border, fitted_border;
} automatic_scene;

enum { AUTOMATIC_PROBE = 128 };

/* base: sizes of the image, faces of a point light. Renders two frames; the meshes must have edges. 0, or -1
 * and the problem. */
int automatic_scene_make(automatic_scene *scene, const packed_scene *packed, const gn_settings *base, problem *why);

/* Do all its corners lie in one plane, to two units? Meshes of one triangle do. */
int automatic_mesh_is_flat(const gn_mesh *mesh);

/* "3 solids, 1 flat mesh, a sun of whose plane the view takes 12 %": at most 128 bytes. */
void automatic_scene_text(const automatic_scene *scene, char *text, size_t size);

#endif
