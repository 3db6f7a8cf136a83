/* The scene format: one directive a line, key-value pairs in any order after it, `#` starts a comment. World units,
 * right-handed, angles in degrees.
 *
 *     image  W H
 *     map    W [H]
 *     camera perspective  eye x y z  target x y z  up x y z  fovy D    near N far F
 *     camera orthographic eye x y z  target x y z  up x y z  height H  near N far F
 *     light  directional  direction x y z  [up x y z]
 *     light  spot   position x y z  target x y z  [up x y z]  fovy D  near N far F
 *     light  point  position x y z  near N far F                                   (for `gnomon truth` alone)
 *     ambient A
 *     mesh   PATH.obj  surface closed|open  color r g b
 *            [scale s | scale sx sy sz]  [rotate ax ay az D]  [translate x y z]
 *
 * Every directive must be there once (mesh: at least once). Ranges: images and maps 1 to 4096, fovy 0.5 to 178, colours
 * and ambient 0 to 1, coordinates up to 1e9, 0 < near < far (orthographic: near < far).
 */
#ifndef SCENE_FILE_H
#define SCENE_FILE_H

#include "problem.h"

#include <stddef.h>

typedef struct scene_camera {
    long line;
    int orthographic;
    double eye[3], target[3], up[3];
    double fovy;   /* degrees, perspective */
    double height; /* world units, orthographic */
    double near_depth, far_depth;
} scene_camera;

typedef struct scene_light {
    long line;
    int spot, point;                      /* neither: directional */
    double direction[3];                  /* directional */
    double position[3], target[3], up[3]; /* spot (position: and point; up: and directional) */
    double fovy, near_depth, far_depth;   /* spot (depths: and point) */
    int has_up;
} scene_light;

typedef struct scene_mesh {
    long line;
    char *path; /* with the scene's folder before it */
    int closed;
    double color[3];
    double scale[3], axis[3], degrees, translate[3];
} scene_mesh;

typedef struct scene_file {
    char *path;
    int width, height, map_width, map_height;
    scene_camera camera;
    scene_light light;
    double ambient;
    scene_mesh *meshes;
    size_t mesh_count;
} scene_file;

/* Read a scene (not its meshes); scene_file_free() it afterwards, also after an error. 0, or -1 and the problem. */
int scene_file_read(scene_file *scene, const char *path, problem *why);

/* The same from memory: `size` bytes followed by a zero byte; `path` is for messages and for the folder of the meshes.
 */
int scene_file_parse(scene_file *scene, const char *path, const char *bytes, size_t size, problem *why);

void scene_file_free(scene_file *scene);

#endif
