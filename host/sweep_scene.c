#include "sweep_scene.h"

#include "choices.h"
#include "file.h"
#include "image.h"
#include "memory.h"
#include "stage_hash.h"
#include "truth.h"
#include "utf8.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

char *sweep_path(const char *folder, const char *name, const char *end)
{
    size_t room = strlen(folder) + strlen(name) + strlen(end) + 2;
    char *path = memory_take(room, 1);
    snprintf(path, room, "%s/%s%s", folder, name, end);
    return path;
}

/* ---- names ----------------------------------------------------------------------------------------------------- */

static int is_taken(const sweep_scene *scenes, int count, const char *name)
{
    for (int i = 0; i < count; i++)
        if (strcmp(scenes[i].name, name) == 0)
            return 1;
    return 0;
}

/* The file's name without folder and extension. A name becomes part of file names and of CSV: what cannot be printed,
 * or is no UTF-8 (after the cut of a long name as well), becomes underscores. The second of two equal ones ends in -2,
 * and so on. */
static void name_scene(sweep_scene *scenes, int index)
{
    enum { ROOM_OF_NUMBER = 12 };
    sweep_scene *s = &scenes[index];
    const char *slash = strrchr(s->path, '/'), *start = slash ? slash + 1 : s->path, *dot = strrchr(start, '.');
    size_t length = dot && dot != start ? (size_t)(dot - start) : strlen(start), most = sizeof s->name - ROOM_OF_NUMBER;
    length = length < most ? length : most - 1;
    memcpy(s->name, start, length);
    for (size_t i = 0, size; i < length; i += size) {
        size = (size_t)utf8_size((const uint8_t *)s->name + i);
        if (size && (unsigned char)s->name[i] >= 32 && s->name[i] != 127)
            continue;
        s->name[i] = '_';
        size = 1;
    }
    for (int number = 2; is_taken(scenes, index, s->name); number++)
        snprintf(s->name + length, ROOM_OF_NUMBER, "-%d", number);
}

static int check_distinct(const sweep_scene *scenes, int index, problem *why)
{
    struct stat a, b;
    if (stat(scenes[index].path, &a) != 0)
        return 0; /* the reader says it better */
    for (int i = 0; i < index; i++)
        if (stat(scenes[i].path, &b) == 0 && a.st_dev == b.st_dev && a.st_ino == b.st_ino)
            return problem_in(why, scenes[index].path, "is given twice; expected every scene once");
    return 0;
}

/* ---- the hash -------------------------------------------------------------------------------------------------- */

static stage_hash hash_integers(stage_hash hash, const int32_t *numbers, size_t count)
{
    for (size_t i = 0; i < count; i++)
        hash = stage_hash_u32(hash, (uint32_t)numbers[i]);
    return hash;
}

static stage_hash hash_mesh(stage_hash hash, const gn_mesh *m)
{
    hash = stage_hash_u32(stage_hash_u32(hash, m->vertex_count), m->triangle_count);
    hash = stage_hash_u8(hash, m->closed);
    hash = hash_integers(hash, (const int32_t *)m->vertices, 3 * (size_t)m->vertex_count);
    for (size_t i = 0; i < 3 * (size_t)m->triangle_count; i++)
        hash = stage_hash_u32(hash, m->index_size == 2 ? ((const uint16_t *)m->indices)[i]
                                                       : ((const uint32_t *)m->indices)[i]);
    return hash;
}

static stage_hash hash_model(stage_hash hash, const gn_model *m)
{
    if (!m)
        return stage_hash_u8(hash, 0);
    hash = hash_integers(stage_hash_u8(hash, 1), m->m[0], 9);
    return stage_hash_u8(hash_integers(hash, m->t, 3), m->shift);
}

static stage_hash hash_camera(stage_hash hash, const gn_camera *c)
{
    const int32_t numbers[] = {(int32_t)c->tan_half, c->half_height, c->near_depth, c->far_depth};
    hash = hash_integers(stage_hash_u8(hash, c->projection), c->eye, 3);
    hash = hash_integers(hash_integers(hash_integers(hash, c->right, 3), c->up, 3), c->forward, 3);
    return hash_integers(hash, numbers, 4);
}

static stage_hash hash_light(stage_hash hash, const gn_light *l)
{
    const int32_t numbers[] = {
        l->box_u,      l->box_v,    l->box_z, l->box_width, l->box_height, l->box_depth, (int32_t)l->tan_half,
        l->near_depth, l->far_depth};
    hash = hash_integers(stage_hash_u8(hash, l->kind), l->position, 3);
    hash = hash_integers(hash_integers(hash_integers(hash, l->right, 3), l->up, 3), l->forward, 3);
    return hash_integers(hash, numbers, 9);
}

/* Colours are left out: they change no shadow. */
static uint64_t hash_scene(const sweep_scene *s)
{
    const packed_scene *p = &s->packed;
    stage_hash hash = stage_hash_u32(stage_hash_u32(stage_hash_init(), s->width), s->height);
    for (const char *c = GN_VERSION; *c; c++)
        hash = stage_hash_u8(hash, (uint8_t)*c);
    hash = stage_hash_u8(hash, GN_BITS_VERSION);
    hash = stage_hash_u8(hash, (uint8_t)choices_number(&choices_faces, p->settings.faces));
    hash = hash_light(hash_camera(hash, &p->camera), &p->light);
    for (uint32_t i = 0; i < p->scene.object_count; i++)
        hash = hash_model(hash_mesh(hash, p->objects[i].mesh), p->objects[i].model);
    return hash;
}

/* ---- reading --------------------------------------------------------------------------------------------------- */

static int read_scene(sweep_scene *s, const long size[2], problem *why)
{
    if (packed_read(&s->packed, s->path, 0, why) || packed_make_edges(&s->packed, 0, why))
        return -1;
    s->width = size[0] ? (uint32_t)size[0] : s->packed.settings.width;
    s->height = size[0] ? (uint32_t)size[1] : s->packed.settings.height;
    s->hash = hash_scene(s);
    return 0;
}

int sweep_scenes_read(sweep_scene *scenes, int count, const char *const paths[], const long size[2], problem *why)
{
    for (int i = 0; i < count; i++) {
        scenes[i].path = paths[i];
        if (check_distinct(scenes, i, why) || read_scene(&scenes[i], size, why))
            return -1;
        name_scene(scenes, i);
    }
    return 0;
}

void sweep_scenes_free(sweep_scene *scenes, int count)
{
    for (int i = 0; i < count; i++) {
        packed_free(&scenes[i].packed);
        free(scenes[i].truth);
    }
}

/* ---- the truth ------------------------------------------------------------------------------------------------- */

/* The head of a PGM of 8 bits, which says in a comment what it is the truth of. */
static void write_head(const sweep_scene *s, char head[100])
{
    snprintf(head, 100, "P5\n# truth %016" PRIx64 "\n%" PRIu32 " %" PRIu32 "\n255\n", s->hash, s->width, s->height);
}

/* 1: it was there, and of this scene. */
static int take_kept(sweep_scene *s, const char *path)
{
    file_content content;
    problem unused;
    char head[100];
    size_t pixels = (size_t)s->width * s->height;
    write_head(s, head);
    if (file_read(&content, path, &unused))
        return 0;
    int good = content.size == strlen(head) + pixels && memcmp(content.bytes, head, strlen(head)) == 0;
    if (good) {
        s->truth = memory_take(pixels, 1);
        memcpy(s->truth, content.bytes + strlen(head), pixels);
    }
    free(content.bytes);
    return good;
}

static int keep(const sweep_scene *s, const char *path, problem *why)
{
    file_output output;
    char head[100];
    write_head(s, head);
    if (file_output_open(&output, path, why))
        return -1;
    fputs(head, output.stream);
    fwrite(s->truth, 1, (size_t)s->width * s->height, output.stream);
    return file_output_finish(&output, why);
}

static int cast(sweep_scene *s, const char *path, int workers, problem *why)
{
    truth t = {.mask = 0};
    int result = truth_make(&t, &s->packed, s->width, s->height, workers, 0, why);
    if (!result) {
        s->truth = t.mask;
        t.mask = 0;
        result = keep(s, path, why);
    }
    truth_free(&t);
    return result;
}

static void count_pixels(sweep_scene *s)
{
    enum { NOTHING = 255 };
    for (size_t i = 0; i < (size_t)s->width * s->height; i++) {
        s->surface += s->truth[i] != NOTHING;
        s->shadowed += s->truth[i] == 0;
    }
    s->lit = s->surface - s->shadowed;
}

int sweep_scene_truth(sweep_scene *scene, const char *folder, int workers, problem *why)
{
    char *path = sweep_path(folder, scene->name, ".truth.pgm");
    int result = take_kept(scene, path) ? 0 : cast(scene, path, workers, why);
    free(path);
    if (!result)
        count_pixels(scene);
    return result;
}
