#include "scene_file.h"

#include "file.h"
#include "memory.h"
#include "text.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { LARGEST_SIZE = 4096 };

typedef struct reader {
    scene_file *scene;
    text text;
    const char *directive; /* of the statement being read */
    long image_line, map_line, ambient_line;
    size_t mesh_capacity;
    problem *why;
} reader;

/* One key of a directive: `count` numbers, each from `least` to `most`; or a choice between two words. */
typedef struct key {
    const char *name;
    double *numbers;
    int count;
    double least, most;
    int required;
    const char *zero, *one; /* the two words, for a choice */
    int *choice;
    int found;
} key;

#define NUMBERS(name, numbers, count, least, most, required)                                                           \
    {                                                                                                                  \
        name, numbers, count, least, most, required, 0, 0, 0, 0                                                        \
    }
#define POINT(name, numbers, required) NUMBERS(name, numbers, 3, -1e9, 1e9, required)
#define DISTANCE(name, number) NUMBERS(name, number, 1, 1e-9, 1e9, 1)
#define FOVY(number) NUMBERS("fovy", number, 1, 0.5, 178, 1)

#define WRONG(r, ...) problem_at((r)->why, (r)->text.file, (r)->text.line, __VA_ARGS__)

static int read_number(reader *r, const char *name, double least, double most, double *number)
{
    word w;
    if (!text_next_word(&r->text, &w))
        return WRONG(r, "%s '%s' has too few numbers; expected a number from %g to %g", r->directive, name, least,
                     most);
    if (word_number(w, number))
        return WRONG(r, "'%s' is not a number; expected a number from %g to %g for '%s'", word_shown(w).text, least,
                     most, name);
    if (!(*number >= least && *number <= most))
        return WRONG(r, "%s %s is out of range; expected a number from %g to %g", name, word_shown(w).text, least,
                     most);
    return 0;
}

static int read_choice(reader *r, const key *k)
{
    word w;
    if (!text_next_word(&r->text, &w))
        return WRONG(r, "a word is missing after '%s'; expected '%s' or '%s'", k->name, k->zero, k->one);
    *k->choice = word_is(w, k->one);
    if (!*k->choice && !word_is(w, k->zero))
        return WRONG(r, "'%s' is not a value of '%s'; expected '%s' or '%s'", word_shown(w).text, k->name, k->zero,
                     k->one);
    return 0;
}

/* `scale` takes one number or three: one is repeated. */
static int spread_scale(reader *r, const key *k)
{
    word w;
    double ignored;
    k->numbers[2] = k->numbers[1] = k->numbers[0];
    if (!text_peek_word(&r->text, &w) || word_number(w, &ignored))
        return 0;
    return read_number(r, k->name, k->least, k->most, &k->numbers[1]) ||
                   read_number(r, k->name, k->least, k->most, &k->numbers[2])
               ? -1
               : 0;
}

static int read_key(reader *r, key *k)
{
    if (k->found)
        return WRONG(r, "'%s' is given twice; expected it once", k->name);
    k->found = 1;
    if (k->choice)
        return read_choice(r, k);
    for (int i = 0; i < k->count; i++)
        if (read_number(r, k->name, k->least, k->most, &k->numbers[i]))
            return -1;
    return strcmp(k->name, "scale") == 0 ? spread_scale(r, k) : 0;
}

static int read_keys(reader *r, key *keys, size_t count)
{
    word w;
    while (text_next_word(&r->text, &w)) {
        size_t i = 0;
        while (i < count && !word_is(w, keys[i].name))
            i++;
        if (i < count) {
            if (read_key(r, &keys[i]))
                return -1;
            continue;
        }
        char expected[256] = "";
        for (size_t j = 0; j < count; j++) {
            strcat(expected, j ? " " : "");
            strcat(expected, keys[j].name);
        }
        return WRONG(r, "unknown word '%s' after '%s'; expected one of: %s", word_shown(w).text, r->directive,
                     expected);
    }
    for (size_t i = 0; i < count; i++)
        if (keys[i].required && !keys[i].found)
            return WRONG(r, "'%s' is missing; expected %s with '%s'", keys[i].name, r->directive, keys[i].name);
    return 0;
}

#define READ_KEYS(r, keys) read_keys(r, keys, sizeof keys / sizeof *keys)

static int end_of_statement(reader *r)
{
    word w;
    if (text_next_word(&r->text, &w))
        return WRONG(r, "'%s' is too much; expected the end of the line", word_shown(w).text);
    return 0;
}

/* Remember the line of a directive that may stand only once. */
static int only_once(reader *r, long *line)
{
    if (*line)
        return WRONG(r, "a second '%s'; expected one (the first is in line %ld)", r->directive, *line);
    *line = r->text.line;
    return 0;
}

static int read_size(reader *r, int *size)
{
    double number;
    if (read_number(r, "size", 1, LARGEST_SIZE, &number))
        return -1;
    *size = (int)number;
    return number == floor(number) ? 0 : WRONG(r, "size %g is not whole; expected 1 to %d", number, LARGEST_SIZE);
}

static int read_image(reader *r)
{
    if (only_once(r, &r->image_line) || read_size(r, &r->scene->width) || read_size(r, &r->scene->height))
        return -1;
    return end_of_statement(r);
}

static int read_map(reader *r)
{
    word w;
    if (only_once(r, &r->map_line) || read_size(r, &r->scene->map_width))
        return -1;
    r->scene->map_height = r->scene->map_width;
    if (text_peek_word(&r->text, &w) && read_size(r, &r->scene->map_height))
        return -1;
    return end_of_statement(r);
}

static int read_ambient(reader *r)
{
    if (only_once(r, &r->ambient_line) || read_number(r, "ambient", 0, 1, &r->scene->ambient))
        return -1;
    return end_of_statement(r);
}

/* Is there an angle of more than about 1e-6 radians between the two, neither being zero? */
static int not_parallel(const double a[3], const double b[3])
{
    double x = a[1] * b[2] - a[2] * b[1], y = a[2] * b[0] - a[0] * b[2], z = a[0] * b[1] - a[1] * b[0];
    double aa = a[0] * a[0] + a[1] * a[1] + a[2] * a[2], bb = b[0] * b[0] + b[1] * b[1] + b[2] * b[2];
    return x * x + y * y + z * z > 1e-12 * aa * bb;
}

static int check_axes(reader *r, const double eye[3], const double target[3], const double *up, const char *from)
{
    double view[3] = {target[0] - eye[0], target[1] - eye[1], target[2] - eye[2]};
    if (view[0] == 0 && view[1] == 0 && view[2] == 0)
        return WRONG(r, "'%s' and 'target' are the same point; expected two points", from);
    if (up && !not_parallel(view, up))
        return WRONG(r, "'up' is zero or parallel to the view; expected another direction");
    return 0;
}

static int check_depths(reader *r, double near_depth, double far_depth)
{
    if (near_depth < far_depth)
        return 0;
    return WRONG(r, "near %g is not less than far %g; expected near < far", near_depth, far_depth);
}

static int read_camera(reader *r)
{
    scene_camera *camera = &r->scene->camera;
    word kind;
    if (only_once(r, &camera->line))
        return -1;
    if (!text_next_word(&r->text, &kind) || (!word_is(kind, "perspective") && !word_is(kind, "orthographic")))
        return WRONG(r, "'%s' is no kind of camera; expected 'perspective' or 'orthographic'", word_shown(kind).text);
    camera->orthographic = word_is(kind, "orthographic");
    double least_near = camera->orthographic ? -1e9 : 1e-9;
    key keys[] = {
        POINT("eye", camera->eye, 1),
        POINT("target", camera->target, 1),
        POINT("up", camera->up, 1),
        NUMBERS("near", &camera->near_depth, 1, least_near, 1e9, 1),
        NUMBERS("far", &camera->far_depth, 1, least_near, 1e9, 1),
        FOVY(&camera->fovy),
    };
    if (camera->orthographic)
        keys[5] = (key)DISTANCE("height", &camera->height);
    if (READ_KEYS(r, keys) || check_depths(r, camera->near_depth, camera->far_depth))
        return -1;
    return check_axes(r, camera->eye, camera->target, camera->up, "eye");
}

static int read_directional_light(reader *r, scene_light *light)
{
    static const double origin[3];
    key keys[] = {
        POINT("direction", light->direction, 1),
        POINT("up", light->up, 0),
    };
    if (READ_KEYS(r, keys))
        return -1;
    light->has_up = keys[1].found;
    if (light->direction[0] == 0 && light->direction[1] == 0 && light->direction[2] == 0)
        return WRONG(r, "'direction' is zero; expected the way the light travels");
    return check_axes(r, origin, light->direction, light->has_up ? light->up : 0, "direction");
}

static int read_spot_light(reader *r, scene_light *light)
{
    key keys[] = {
        POINT("position", light->position, 1), POINT("target", light->target, 1),  FOVY(&light->fovy),
        DISTANCE("near", &light->near_depth),  DISTANCE("far", &light->far_depth), POINT("up", light->up, 0),
    };
    light->spot = 1;
    if (READ_KEYS(r, keys) || check_depths(r, light->near_depth, light->far_depth))
        return -1;
    light->has_up = keys[5].found;
    return check_axes(r, light->position, light->target, light->has_up ? light->up : 0, "position");
}

static int read_point_light(reader *r, scene_light *light)
{
    key keys[] = {
        POINT("position", light->position, 1),
        DISTANCE("near", &light->near_depth),
        DISTANCE("far", &light->far_depth),
    };
    light->point = 1;
    return READ_KEYS(r, keys) || check_depths(r, light->near_depth, light->far_depth) ? -1 : 0;
}

static int read_light(reader *r)
{
    scene_light *light = &r->scene->light;
    word kind;
    if (only_once(r, &light->line))
        return -1;
    if (!text_next_word(&r->text, &kind))
        return WRONG(r, "the kind of light is missing; expected 'directional', 'spot' or 'point'");
    if (word_is(kind, "directional"))
        return read_directional_light(r, light);
    if (word_is(kind, "spot"))
        return read_spot_light(r, light);
    if (word_is(kind, "point"))
        return read_point_light(r, light);
    return WRONG(r, "'%s' is no kind of light; expected 'directional', 'spot' or 'point'", word_shown(kind).text);
}

/* The mesh's path as seen from where the program runs: the scene's folder, then the w. */
static char *path_beside(const char *scene, word w)
{
    const char *slash = strrchr(scene, '/');
    size_t folder = slash && w.start[0] != '/' ? (size_t)(slash - scene) + 1 : 0;
    char *path = memory_take(folder + w.length + 1, 1);
    memcpy(path, scene, folder);
    memcpy(path + folder, w.start, w.length);
    return path;
}

static int read_mesh(reader *r)
{
    scene_file *scene = r->scene;
    word path;
    if (!text_next_word(&r->text, &path))
        return WRONG(r, "the mesh's file is missing; expected mesh PATH.obj");
    scene->meshes = memory_grow(scene->meshes, &r->mesh_capacity, scene->mesh_count + 1, sizeof *scene->meshes);
    scene_mesh *mesh = &scene->meshes[scene->mesh_count++];
    *mesh = (scene_mesh){.line = r->text.line, .path = path_beside(r->text.file, path), .scale = {1, 1, 1}};
    double rotate[4] = {0, 1, 0, 0};
    key keys[] = {
        {"surface", 0, 0, 0, 0, 1, "open", "closed", &mesh->closed, 0},
        NUMBERS("color", mesh->color, 3, 0, 1, 1),
        NUMBERS("scale", mesh->scale, 1, -1e9, 1e9, 0),
        NUMBERS("rotate", rotate, 4, -1e9, 1e9, 0),
        POINT("translate", mesh->translate, 0),
    };
    if (READ_KEYS(r, keys))
        return -1;
    if (mesh->scale[0] == 0 || mesh->scale[1] == 0 || mesh->scale[2] == 0)
        return WRONG(r, "'scale' is zero; expected any other number");
    if (rotate[0] == 0 && rotate[1] == 0 && rotate[2] == 0)
        return WRONG(r, "the axis of 'rotate' is zero; expected a direction");
    memcpy(mesh->axis, rotate, sizeof mesh->axis);
    mesh->degrees = fmod(rotate[3], 360);
    return 0;
}

static int read_statement(reader *r)
{
    static const struct {
        const char *name;
        int (*read)(reader *r);
    } directives[] = {
        {"image", read_image}, {"map", read_map},         {"camera", read_camera},
        {"light", read_light}, {"ambient", read_ambient}, {"mesh", read_mesh},
    };
    word w;
    text_next_word(&r->text, &w);
    for (size_t i = 0; i < sizeof directives / sizeof *directives; i++) {
        r->directive = directives[i].name;
        if (word_is(w, r->directive))
            return directives[i].read(r);
    }
    return WRONG(r, "unknown directive '%s'; expected image, map, camera, light, ambient or mesh", word_shown(w).text);
}

static int check_complete(reader *r)
{
    const struct {
        const char *name, *expected;
        long line;
    } needed[] = {
        {"image", "image W H", r->image_line},
        {"map", "map W [H]", r->map_line},
        {"camera", "camera perspective|orthographic ...", r->scene->camera.line},
        {"light", "light directional|spot|point ...", r->scene->light.line},
        {"ambient", "ambient A", r->ambient_line},
        {"mesh", "mesh PATH.obj ...", (long)r->scene->mesh_count},
    };
    for (size_t i = 0; i < sizeof needed / sizeof *needed; i++)
        if (!needed[i].line)
            return WRONG(r, "the file ends without '%s'; expected %s", needed[i].name, needed[i].expected);
    return 0;
}

int scene_file_parse(scene_file *scene, const char *path, const char *bytes, size_t size, problem *why)
{
    memset(scene, 0, sizeof *scene);
    scene->path = memory_take(strlen(path) + 1, 1);
    strcpy(scene->path, path);
    const char *zero = memchr(bytes, 0, size);
    if (zero)
        return problem_at_byte(why, path, (size_t)(zero - bytes), "a zero byte; expected text");
    reader r = {.scene = scene, .text = text_of(path, bytes, size, 0), .why = why};
    while (text_next_statement(&r.text))
        if (read_statement(&r))
            return -1;
    return check_complete(&r);
}

int scene_file_read(scene_file *scene, const char *path, problem *why)
{
    file_content content;
    memset(scene, 0, sizeof *scene);
    if (file_read(&content, path, why))
        return -1;
    int result = scene_file_parse(scene, path, (const char *)content.bytes, content.size, why);
    free(content.bytes);
    return result;
}

void scene_file_free(scene_file *scene)
{
    for (size_t i = 0; i < scene->mesh_count; i++)
        free(scene->meshes[i].path);
    free(scene->meshes);
    free(scene->path);
    memset(scene, 0, sizeof *scene);
}
