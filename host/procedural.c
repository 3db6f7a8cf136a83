/* Procedural scenes as files: the scene format of docs/design.md, one OBJ file a mesh. */
#include "procedural.h"
#include "procedural_scene.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#define FILE_NAME_ROOM 64 /* for the longest name of a scene, its tag, and a view's number */

/* ---- files that appear when they are complete ------------------------------------------------------------------- */

typedef struct draft {
    FILE *file;
    char *path, *temporary; /* the temporary name carries the process id: runs side by side do not meet */
} draft;

/* FOLDER/FILE followed by suffix and number, where suffix is not empty. To be freed. */
static char *path_of(const char *folder, const char *file, const char *suffix, long number)
{
    size_t room = strlen(folder) + strlen(file) + strlen(suffix) + 32;
    char *path = malloc(room);
    if (path && *suffix)
        snprintf(path, room, "%s/%s%s%ld", folder, file, suffix, number);
    else if (path)
        snprintf(path, room, "%s/%s", folder, file);
    return path;
}

/* Rename the draft, or remove it where error (an errno) is not 0 or something went wrong while writing. */
static int draft_close(draft *d, int error)
{
    if (d->file && ferror(d->file) && !error)
        error = errno ? errno : EIO; /* of the last write that failed: nothing else was called since draft_open */
    if (d->file && fclose(d->file) && !error)
        error = errno;
    if (!error && rename(d->temporary, d->path))
        error = errno;
    if (error && d->file)
        remove(d->temporary);
    free(d->path);
    free(d->temporary);
    if (!error)
        return 0;
    errno = error;
    return -1;
}

/* Returns 0, and then draft_close has to follow; or -1 with errno set. */
static int draft_open(draft *d, const char *folder, const char *file)
{
    d->file = 0;
    d->path = path_of(folder, file, "", 0);
    d->temporary = path_of(folder, file, ".part", (long)getpid());
    if (d->path && d->temporary)
        d->file = fopen(d->temporary, "wb");
    if (!d->file) {
        draft_close(d, d->path && d->temporary ? errno : ENOMEM);
        return -1;
    }
    errno = 0;
    return 0;
}

/* ---- OBJ -------------------------------------------------------------------------------------------------------- */

/* Part after part: its vertices, then its triangles, counted from 1 over the whole file. */
static void print_mesh(FILE *file, const part_mesh *m)
{
    for (size_t i = 0; i < m->part_count; i++) {
        const part_start all = {m->vertex_count, m->triangle_count};
        part_start from = m->parts[i], to = i + 1 < m->part_count ? m->parts[i + 1] : all;
        for (size_t k = from.vertex; k < to.vertex; k++) {
            const part_point *v = &m->vertices[k];
            fprintf(file, "v %.9g %.9g %.9g\n", v->x, v->y, v->z);
        }
        for (size_t k = from.triangle; k < to.triangle; k++) {
            const int *t = m->triangles[k];
            fprintf(file, "f %d %d %d\n", 1 + t[0], 1 + t[1], 1 + t[2]);
        }
    }
}

static void mesh_file(char name[FILE_NAME_ROOM], const procedural_scene *scene, const procedural_piece *piece)
{
    snprintf(name, FILE_NAME_ROOM, "%s_%s.obj", scene->name, piece->tag);
}

static int write_mesh(const procedural_scene *scene, const procedural_piece *piece, const char *folder)
{
    char file[FILE_NAME_ROOM];
    draft d;
    mesh_file(file, scene, piece);
    if (draft_open(&d, folder, file))
        return -1;
    print_mesh(d.file, &piece->mesh);
    return draft_close(&d, 0);
}

/* ---- the scene -------------------------------------------------------------------------------------------------- */

static void print_point(FILE *file, const char *key, part_point p)
{
    fprintf(file, " %s %g %g %g", key, p.x, p.y, p.z);
}

static void print_frustum(FILE *file, double fovy, double near_depth, double far_depth)
{
    fprintf(file, " fovy %g near %g far %g\n", fovy, near_depth, far_depth);
}

static void print_camera(FILE *file, const procedural_camera *c)
{
    fputs("camera perspective", file);
    print_point(file, "eye", c->eye);
    print_point(file, "target", c->target);
    print_point(file, "up", (part_point){0, 1, 0});
    print_frustum(file, c->fovy, c->near_depth, c->far_depth);
}

static void print_light(FILE *file, const procedural_light *l)
{
    if (l->is_spot) {
        fputs("light spot", file);
        print_point(file, "position", l->position);
        print_point(file, "target", l->target);
        print_frustum(file, l->fovy, l->near_depth, l->far_depth);
    } else {
        fputs("light directional", file);
        print_point(file, "direction", l->direction);
        fputs("\n", file);
    }
}

static void print_scene(FILE *file, const procedural_scene *scene, const char *heading)
{
    fprintf(file, "# %s\nimage %d %d\nmap 256\n", heading, PROCEDURAL_WIDTH, PROCEDURAL_HEIGHT);
    print_camera(file, &scene->camera);
    print_light(file, &scene->light);
    fputs("ambient 0.2\n", file);
    for (int i = 0; i < scene->piece_count; i++) {
        const procedural_piece *piece = &scene->pieces[i];
        char mesh[FILE_NAME_ROOM];
        mesh_file(mesh, scene, piece);
        fprintf(file, "mesh %s surface %s color %s\n", mesh, piece->closed ? "closed" : "open", piece->colour);
    }
}

int procedural_save(const procedural_scene *scene, const char *file, const char *heading, const char *folder)
{
    draft d;
    for (int i = 0; i < scene->piece_count; i++)
        if (write_mesh(scene, &scene->pieces[i], folder))
            return -1;
    if (draft_open(&d, folder, file))
        return -1;
    print_scene(d.file, scene, heading);
    return draft_close(&d, 0);
}

int procedural_write(const char *name, const char *folder)
{
    char file[FILE_NAME_ROOM], heading[FILE_NAME_ROOM];
    procedural_scene scene;
    int index = procedural_index(name);
    if (index < 0)
        return -1;
    snprintf(file, sizeof file, "%s.scene", name);
    snprintf(heading, sizeof heading, "%s (generated by gen.py)", name); /* the original's words: its bytes are kept */
    int result = procedural_build(&scene, index);
    if (result == 0)
        result = procedural_save(&scene, file, heading, folder);
    int error = errno;
    procedural_free(&scene);
    errno = error;
    return result;
}
