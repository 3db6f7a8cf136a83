/* A procedural scene before it is written: camera, light and meshes. Used inside host/procedural*.c only. */
#ifndef PROCEDURAL_SCENE_H
#define PROCEDURAL_SCENE_H

#include "procedural_parts.h"

#define PROCEDURAL_WIDTH 640
#define PROCEDURAL_HEIGHT 480
#define PROCEDURAL_PIECES 4

typedef struct procedural_camera { /* perspective, up = +y */
    part_point eye, target;
    double fovy; /* degrees */
    double near_depth, far_depth;
} procedural_camera;

typedef struct procedural_light {
    int is_spot;
    part_point direction;        /* directional: the way light travels */
    part_point position, target; /* spot, with the rest */
    double fovy;                 /* degrees */
    double near_depth, far_depth;
} procedural_light;

typedef struct procedural_piece {
    const char *tag;    /* the mesh is NAME_TAG.obj */
    int closed;         /* 0 or 1 */
    const char *colour; /* as the scene file has it */
    part_mesh mesh;
} procedural_piece;

typedef struct procedural_scene {
    const char *name;
    procedural_camera camera;
    procedural_light light;
    procedural_piece pieces[PROCEDURAL_PIECES];
    int piece_count;
} procedural_scene;

/* The position of name in procedural_names, or -1 with errno EINVAL. */
int procedural_index(const char *name);

/* Make scene number index. Free it with procedural_free, also after a failure. Returns 0, or -1 with errno ENOMEM. */
int procedural_build(procedural_scene *scene, int index);
void procedural_free(procedural_scene *scene);

/* Write the meshes and then FOLDER/FILE, whose first line is a comment that says heading. Returns 0, or -1 with errno.
 */
int procedural_save(const procedural_scene *scene, const char *file, const char *heading, const char *folder);

#endif
