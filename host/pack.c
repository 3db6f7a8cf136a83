#include "pack.h"

#include "adjacency.h"
#include "choices.h"
#include "file.h"
#include "memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { VERSION = 4, BODY = 16, MESHES = 220, LARGEST_PLANE = 1 << 28, LARGEST_HALF_HEIGHT = 1 << 26, UNIT = 1 << 30 };
enum { LARGEST_SLOPE = 64 << 16, LEAST_SMOOTHING = 1 << 10, LARGEST_SMOOTHING = 64 << 16 };

static uint32_t crc32_of(const uint8_t *bytes, size_t size)
{
    uint32_t crc = 0xffffffff;
    for (size_t i = 0; i < size; i++) {
        crc ^= bytes[i];
        for (int bit = 0; bit < 8; bit++)
            crc = crc >> 1 ^ (0xedb88320 & (0 - (crc & 1)));
    }
    return ~crc;
}

/* ---- writing --------------------------------------------------------------------------------------------------- */

typedef struct writer {
    uint8_t *bytes;
    size_t size, capacity;
} writer;

static void put(writer *w, uint32_t value, int bytes)
{
    w->bytes = memory_grow(w->bytes, &w->capacity, w->size + 4, 1);
    for (int i = 0; i < bytes; i++)
        w->bytes[w->size++] = (uint8_t)(value >> (8 * i));
}

static void put_numbers(writer *w, const int32_t *numbers, size_t count)
{
    for (size_t i = 0; i < count; i++)
        put(w, (uint32_t)numbers[i], 4);
}

/* All zero where the scene has no method. */
static void put_method(writer *w, const gn_settings *s)
{
    put(w, s->cull, 1);
    put(w, s->layers, 1);
    put(w, s->surface, 1);
    put(w, s->bias.unit, 1);
    put(w, s->shadow, 1);
    put(w, (uint32_t)choices_number(&choices_receiver, s->receiver), 1);
    put(w, s->bias.value, 4);
    put(w, (uint32_t)s->slope, 4);
    put(w, (uint32_t)choices_number(&choices_reconstruction, s->reconstruction), 1);
    put(w, (uint32_t)choices_number(&choices_fit, s->fit), 1);
    put(w, (uint32_t)choices_number(&choices_warp, s->warp), 1);
    put(w, s->fit_depth, 1);
    put(w, (uint32_t)s->smoothing, 4);
}

static void put_settings(writer *w, const packed_scene *packed)
{
    static const gn_settings none;
    const gn_settings *s = &packed->settings;
    put(w, s->width, 2);
    put(w, s->height, 2);
    put(w, s->map_width, 2);
    put(w, s->map_height, 2);
    put(w, (uint32_t)packed->scale, 4);
    put(w, packed->scene.ambient, 2);
    put(w, packed->scene.background.r, 1);
    put(w, packed->scene.background.g, 1);
    put(w, packed->scene.background.b, 1);
    put(w, (uint32_t)packed->has_method, 1);
    put_method(w, packed->has_method ? s : &none);
}

static void put_camera(writer *w, const gn_camera *c)
{
    put(w, c->projection, 4);
    put_numbers(w, c->eye, 3);
    put_numbers(w, c->right, 3);
    put_numbers(w, c->up, 3);
    put_numbers(w, c->forward, 3);
    put(w, c->tan_half, 4);
    put_numbers(w, (const int32_t[]){c->half_height, c->near_depth, c->far_depth}, 3);
}

static void put_light(writer *w, const gn_light *l, const gn_settings *s)
{
    put(w, l->kind, 1);
    put(w, (uint32_t)choices_number(&choices_faces, s->faces), 1);
    put(w, 0, 2);
    put_numbers(w, l->right, 3);
    put_numbers(w, l->up, 3);
    put_numbers(w, l->forward, 3);
    put_numbers(w, (const int32_t[]){l->box_u, l->box_v, l->box_z, l->box_width, l->box_height, l->box_depth}, 6);
    put_numbers(w, l->position, 3);
    put(w, l->tan_half, 4);
    put_numbers(w, (const int32_t[]){l->near_depth, l->far_depth}, 2);
}

static void put_mesh(writer *w, const gn_mesh *mesh)
{
    put(w, mesh->vertex_count, 4);
    put(w, mesh->triangle_count, 4);
    put(w, mesh->index_size, 1);
    put(w, mesh->closed, 1);
    put(w, 0, 2);
    put(w, mesh->edge_count, 4);
    put_numbers(w, &mesh->vertices[0][0], 3 * (size_t)mesh->vertex_count);
    for (size_t i = 0; i < 3 * (size_t)mesh->triangle_count; i++)
        if (mesh->index_size == 2)
            put(w, ((const uint16_t *)mesh->indices)[i], 2);
        else
            put(w, ((const uint32_t *)mesh->indices)[i], 4);
    put(w, 0, (int)(-w->size & 3));
    for (uint32_t i = 0; i < mesh->edge_count; i++) {
        put(w, mesh->edges[i].half[0], 4);
        put(w, mesh->edges[i].half[1], 4);
    }
}

int pack_write(const packed_scene *packed, const char *path, problem *why)
{
    writer w = {0};
    file_output output;
    put(&w, 0x4d4f4e47, 4); /* "GNOM" */
    put(&w, VERSION, 4);
    put(&w, 0, 4);
    put(&w, 0, 4);
    put_settings(&w, packed);
    put_camera(&w, &packed->camera);
    put_light(&w, &packed->light, &packed->settings);
    put(&w, packed->mesh_count, 4);
    put(&w, packed->scene.object_count, 4);
    for (uint32_t i = 0; i < packed->mesh_count; i++)
        put_mesh(&w, &packed->meshes[i]);
    for (uint32_t i = 0; i < packed->scene.object_count; i++) {
        const gn_object *object = &packed->objects[i];
        put(&w, (uint32_t)(object->mesh - packed->meshes), 4);
        put(&w, object->colour.r, 1);
        put(&w, object->colour.g, 1);
        put(&w, object->colour.b, 1);
        put(&w, 0, 1);
    }
    size_t size = w.size;
    uint32_t crc = crc32_of(w.bytes + BODY, size - BODY);
    w.size = 8;
    put(&w, (uint32_t)size, 4);
    put(&w, crc, 4);
    int result = size > 0x7fffffff ? problem_in(why, path, "would be larger than 2 GiB; expected a smaller scene")
                                   : file_output_open(&output, path, why);
    if (!result) {
        fwrite(w.bytes, 1, size, output.stream);
        result = file_output_finish(&output, why);
    }
    free(w.bytes);
    return result;
}

/* ---- reading --------------------------------------------------------------------------------------------------- */

typedef struct reader {
    const char *file;
    const uint8_t *bytes;
    size_t size, at;
    problem *why;
} reader;

#define WRONG(r, ...) problem_at_byte((r)->why, (r)->file, (r)->at, __VA_ARGS__)

/* `bytes` more bytes as a number; the caller has made sure that they are there. */
static uint32_t get(reader *r, int bytes)
{
    uint32_t value = 0;
    for (int i = 0; i < bytes; i++)
        value |= (uint32_t)r->bytes[r->at++] << (8 * i);
    return value;
}

/* Two's complement, without relying on how a cast rounds. */
static int32_t get_signed(reader *r)
{
    uint32_t value = get(r, 4);
    return value <= INT32_MAX ? (int32_t)value : -(int32_t)(UINT32_MAX - value) - 1;
}

/* A number that must lie in a range; -1 and the problem if it does not. */
static int get_ranged(reader *r, const char *what, int bytes, uint32_t least, uint32_t most, uint32_t *value)
{
    *value = get(r, bytes);
    if (*value >= least && *value <= most)
        return 0;
    r->at -= (size_t)bytes;
    return WRONG(r, "%s is %u; expected %u to %u", what, (unsigned)*value, (unsigned)least, (unsigned)most);
}

static int get_signed_ranged(reader *r, const char *what, int32_t least, int32_t most, int32_t *value)
{
    *value = get_signed(r);
    if (*value >= least && *value <= most)
        return 0;
    r->at -= 4;
    return WRONG(r, "%s is %d; expected %d to %d", what, (int)*value, (int)least, (int)most);
}

static int get_byte(reader *r, const char *what, uint32_t most, uint8_t *value)
{
    uint32_t number;
    if (get_ranged(r, what, 1, 0, most, &number))
        return -1;
    *value = (uint8_t)number;
    return 0;
}

static int get_zeros(reader *r, int bytes)
{
    uint32_t zero;
    return get_ranged(r, "padding", bytes, 0, 0, &zero);
}

static int get_point(reader *r, const char *what, int32_t most, int32_t point[3])
{
    for (int i = 0; i < 3; i++)
        if (get_signed_ranged(r, what, -most, most, &point[i]))
            return -1;
    return 0;
}

static double dot(const gn_q2_30 a[3], const gn_q2_30 b[3])
{
    double sum = 0;
    for (int i = 0; i < 3; i++)
        sum += ldexp(a[i], -30) * ldexp(b[i], -30);
    return sum;
}

/* right, up and forward: of length one and at right angles to 2^-20. */
static int get_axes(reader *r, gn_q2_30 right[3], gn_q2_30 up[3], gn_q2_30 forward[3])
{
    size_t start = r->at;
    if (get_point(r, "axis", UNIT, right) || get_point(r, "axis", UNIT, up) || get_point(r, "axis", UNIT, forward))
        return -1;
    double error = fmax(fmax(fabs(dot(right, right) - 1), fabs(dot(up, up) - 1)), fabs(dot(forward, forward) - 1));
    error = fmax(error, fmax(fmax(fabs(dot(right, up)), fabs(dot(up, forward))), fabs(dot(forward, right))));
    if (error <= ldexp(1, -20))
        return 0;
    r->at = start;
    return WRONG(r, "the axes are no unit vectors at right angles; expected them to 2^-20");
}

static int get_size(reader *r, const char *what, uint16_t *size)
{
    uint32_t value;
    if (get_ranged(r, what, 2, 1, GN_MAX_SIZE, &value))
        return -1;
    *size = (uint16_t)value;
    return 0;
}

/* The core takes no larger bias in world units. */
static int get_bias(reader *r, int has_method, gn_bias *bias)
{
    uint32_t most = !has_method ? 0 : bias->unit == GN_BIAS_WORLD ? LARGEST_PLANE : UINT32_MAX;
    return get_ranged(r, "bias", 4, 0, most, &bias->value);
}

/* A byte that is the number of a choice; the first of them where there is no method. */
static int get_choice(reader *r, const char *what, const choices *of, int has_method, uint8_t *number)
{
    return get_byte(r, what, has_method ? (uint32_t)of->count - 1 : 0, number);
}

/* The depth is fitted where there is a fit, and functions are smoothed where there is a warp. */
static int get_parameterisation(reader *r, int has_method, gn_settings *s)
{
    uint8_t fit, warp;
    if (get_choice(r, "fit", &choices_fit, has_method, &fit) ||
        get_choice(r, "warp", &choices_warp, has_method, &warp) || get_byte(r, "fitted depth", fit != 0, &s->fit_depth))
        return -1;
    s->fit = choices_fit.all[fit].object;
    s->warp = choices_warp.all[warp].object;
    if (get_signed_ranged(r, "smoothing", 0, warp ? LARGEST_SMOOTHING : 0, &s->smoothing))
        return -1;
    if (s->smoothing == 0 || s->smoothing >= LEAST_SMOOTHING)
        return 0;
    r->at -= 4;
    return WRONG(r, "smoothing is %d; expected 0, or %d to %d", (int)s->smoothing, LEAST_SMOOTHING, LARGEST_SMOOTHING);
}

static int get_method(reader *r, packed_scene *packed)
{
    gn_settings *s = &packed->settings;
    uint8_t has_method, receiver, reconstruction;
    if (get_byte(r, "method flag", 1, &has_method))
        return -1;
    packed->has_method = has_method;
    if (get_choice(r, "cull", &choices_cull, has_method, &s->cull) ||
        get_choice(r, "layers", &choices_layers, has_method, &s->layers) ||
        get_choice(r, "surface", &choices_surface, has_method, &s->surface) ||
        get_choice(r, "unit of the bias", &choices_bias_unit, has_method, &s->bias.unit) ||
        get_choice(r, "shadow", &choices_shadow, has_method, &s->shadow) ||
        get_choice(r, "receiver", &choices_receiver, has_method, &receiver) || get_bias(r, has_method, &s->bias) ||
        get_signed_ranged(r, "slope", 0, has_method ? LARGEST_SLOPE : 0, &s->slope) ||
        get_choice(r, "reconstruction", &choices_reconstruction, has_method, &reconstruction))
        return -1;
    s->receiver = choices_receiver.all[receiver].object;
    s->reconstruction = choices_reconstruction.all[reconstruction].object;
    return get_parameterisation(r, has_method, s);
}

static int get_settings(reader *r, packed_scene *packed)
{
    uint16_t width, height, map_width, map_height;
    int32_t scale;
    if (get_size(r, "image width", &width) || get_size(r, "image height", &height) ||
        get_size(r, "map width", &map_width) || get_size(r, "map height", &map_height) ||
        get_signed_ranged(r, "scale", -128, 128, &scale))
        return -1;
    packed->settings = gn_default_settings(width, height, map_width);
    packed->settings.map_height = map_height;
    packed->scale = scale;
    packed->scene.ambient = (uint16_t)get(r, 2);
    packed->scene.background.r = (uint8_t)get(r, 1);
    packed->scene.background.g = (uint8_t)get(r, 1);
    packed->scene.background.b = (uint8_t)get(r, 1);
    return get_method(r, packed);
}

static int get_planes(reader *r, int least_near, int32_t *near_depth, int32_t *far_depth)
{
    return get_signed_ranged(r, "near plane", least_near, LARGEST_PLANE - 1, near_depth) ||
                   get_signed_ranged(r, "far plane", *near_depth + 1, LARGEST_PLANE, far_depth)
               ? -1
               : 0;
}

static int get_camera(reader *r, gn_camera *c)
{
    if (get_byte(r, "projection", GN_ORTHOGRAPHIC, &c->projection) || get_zeros(r, 3) ||
        get_point(r, "eye coordinate", GN_EYE_MAX, c->eye) || get_axes(r, c->right, c->up, c->forward))
        return -1;
    int perspective = c->projection == GN_PERSPECTIVE;
    if (get_ranged(r, "tan_half", 4, perspective ? 1u << 16 : 0, perspective ? 64u << 24 : UINT32_MAX, &c->tan_half) ||
        get_signed_ranged(r, "half height", perspective ? INT32_MIN : 1, perspective ? INT32_MAX : LARGEST_HALF_HEIGHT,
                          &c->half_height))
        return -1;
    return get_planes(r, perspective ? 1 : -LARGEST_PLANE, &c->near_depth, &c->far_depth);
}

/* The fields of the other kind of light are stored, and not looked at. */
static void get_numbers(reader *r, int32_t *numbers[], size_t count)
{
    for (size_t i = 0; i < count; i++)
        *numbers[i] = get_signed(r);
}

/* Only lights with a direction have axes. */
static int get_light_axes(reader *r, gn_light *l)
{
    if (l->kind != GN_POINT)
        return get_axes(r, l->right, l->up, l->forward);
    get_numbers(r, (int32_t *[]){&l->right[0], &l->right[1], &l->right[2]}, 3);
    get_numbers(r, (int32_t *[]){&l->up[0], &l->up[1], &l->up[2]}, 3);
    get_numbers(r, (int32_t *[]){&l->forward[0], &l->forward[1], &l->forward[2]}, 3);
    return 0;
}

/* A point light has maps of faces, and no other has. */
static int get_faces(reader *r, int point, gn_settings *s)
{
    uint32_t number;
    if (get_ranged(r, "faces", 1, point, point ? (uint32_t)choices_faces.count - 1 : 0, &number))
        return -1;
    s->faces = choices_faces.all[number].object;
    return 0;
}

static int get_light(reader *r, gn_light *l, gn_settings *s)
{
    int32_t *box_corner[] = {&l->box_u, &l->box_v, &l->box_z},
            *box_size[] = {&l->box_width, &l->box_height, &l->box_depth};
    if (get_byte(r, "kind of light", GN_POINT, &l->kind) || get_faces(r, l->kind == GN_POINT, s) || get_zeros(r, 2) ||
        get_light_axes(r, l))
        return -1;
    if (l->kind != GN_DIRECTIONAL) {
        int spot = l->kind == GN_SPOT;
        get_numbers(r, box_corner, 3);
        get_numbers(r, box_size, 3);
        if (get_point(r, "position coordinate", GN_EYE_MAX, l->position) ||
            get_ranged(r, "tan_half", 4, spot ? 1u << 16 : 0, spot ? 64u << 24 : UINT32_MAX, &l->tan_half))
            return -1;
        return get_planes(r, 1, &l->near_depth, &l->far_depth);
    }
    for (int i = 0; i < 3; i++)
        if (get_signed_ranged(r, "corner of the light's box", -LARGEST_PLANE, LARGEST_PLANE, box_corner[i]))
            return -1;
    for (int i = 0; i < 3; i++)
        if (get_signed_ranged(r, "size of the light's box", 1, LARGEST_PLANE, box_size[i]))
            return -1;
    get_numbers(r, (int32_t *[]){&l->position[0], &l->position[1], &l->position[2]}, 3);
    l->tan_half = get(r, 4);
    get_numbers(r, (int32_t *[]){&l->near_depth, &l->far_depth}, 2);
    return 0;
}

static int get_vertices(reader *r, gn_mesh *mesh)
{
    int32_t(*vertices)[3] = memory_take(mesh->vertex_count, sizeof *vertices);
    mesh->vertices = (const int32_t(*)[3])vertices;
    for (uint32_t v = 0; v < mesh->vertex_count; v++)
        if (get_point(r, "vertex coordinate", GN_WORLD_MAX, vertices[v]))
            return -1;
    return 0;
}

static int get_indices(reader *r, gn_mesh *mesh)
{
    size_t count = 3 * (size_t)mesh->triangle_count;
    void *indices = memory_take(count, mesh->index_size);
    mesh->indices = indices;
    for (size_t i = 0; i < count; i++) {
        uint32_t vertex;
        if (get_ranged(r, "index", mesh->index_size, 0, mesh->vertex_count - 1, &vertex))
            return -1;
        if (mesh->index_size == 2)
            ((uint16_t *)indices)[i] = (uint16_t)vertex;
        else
            ((uint32_t *)indices)[i] = vertex;
    }
    return get_zeros(r, (int)(-r->at & 3));
}

static int same_place(const gn_mesh *mesh, uint32_t corner, uint32_t other)
{
    const int32_t *a = mesh->vertices[adjacency_vertex(mesh, corner)];
    const int32_t *b = mesh->vertices[adjacency_vertex(mesh, other)];
    return a[0] == b[0] && a[1] == b[1] && a[2] == b[2];
}

enum { LEFT_OUT, EXPECTED, SEEN };

/* What becomes of each half-edge: those of triangles with two corners at one place are LEFT_OUT of all edges. */
static uint8_t *make_half_edge_list(const gn_mesh *mesh)
{
    uint8_t *list = memory_take(mesh->triangle_count, 3);
    for (uint32_t h = 0; h < 3 * mesh->triangle_count; h += 3)
        if (!same_place(mesh, h, h + 1) && !same_place(mesh, h + 1, h + 2) && !same_place(mesh, h + 2, h))
            memset(list + h, EXPECTED, 3);
    return list;
}

/* Tick off the half-edge that was read last. */
static int take_half_edge(reader *r, const gn_mesh *mesh, uint8_t *list, uint32_t half)
{
    uint32_t most = 3 * mesh->triangle_count - 1;
    if (half <= most && list[half] == EXPECTED) {
        list[half] = SEEN;
        return 0;
    }
    r->at -= 4;
    if (half > most)
        return WRONG(r, "half-edge is %u; expected 0 to %u", (unsigned)half, (unsigned)most);
    if (list[half] == SEEN)
        return WRONG(r, "half-edge %u stands in another edge already; expected it in one", (unsigned)half);
    return WRONG(r, "half-edge %u is of a triangle with two corners at one place; expected none of those",
                 (unsigned)half);
}

/* Have both half-edges the same two ends, and do they run as the flag says? */
static int check_ends(reader *r, const gn_mesh *mesh, const gn_mesh_edge *edge)
{
    uint32_t direction = edge->half[1] & GN_SAME_DIRECTION;
    uint32_t a = edge->half[0], b = edge->half[1] & ~GN_SAME_DIRECTION;
    uint32_t start = direction ? b : adjacency_end(b), end = direction ? adjacency_end(b) : b;
    if (same_place(mesh, a, start) && same_place(mesh, adjacency_end(a), end))
        return 0;
    r->at -= 8;
    return WRONG(r, "half-edges %u and %u make no edge; expected them to run between the same two places, in %s",
                 (unsigned)a, (unsigned)b, direction ? "the same direction" : "opposite directions");
}

static int get_edge(reader *r, const gn_mesh *mesh, uint8_t *list, gn_mesh_edge *edge)
{
    edge->half[0] = get(r, 4);
    if (take_half_edge(r, mesh, list, edge->half[0]))
        return -1;
    edge->half[1] = get(r, 4);
    if (edge->half[1] == GN_NO_HALF_EDGE)
        return 0;
    if (take_half_edge(r, mesh, list, edge->half[1] & ~GN_SAME_DIRECTION))
        return -1;
    return check_ends(r, mesh, edge);
}

/* All that gn_mesh_edge promises, so that the core may rely on it. The mesh's vertices and indices are there. */
static int get_edges(reader *r, gn_mesh *mesh)
{
    if (!mesh->edge_count)
        return 0;
    gn_mesh_edge *edges = memory_take(mesh->edge_count, sizeof *edges);
    uint8_t *list = make_half_edge_list(mesh);
    int result = 0;
    mesh->edges = edges;
    for (uint32_t i = 0; i < mesh->edge_count && !result; i++)
        result = get_edge(r, mesh, list, &edges[i]);
    const uint8_t *missing = memchr(list, EXPECTED, 3 * (size_t)mesh->triangle_count);
    if (!result && missing)
        result = WRONG(r, "half-edge %u stands in no edge of its mesh; expected it in one", (unsigned)(missing - list));
    free(list);
    return result;
}

/* 64 bits: a count that was read may be anything. */
static uint64_t mesh_bytes(const gn_mesh *mesh)
{
    uint64_t bytes = 12 * (uint64_t)mesh->vertex_count + 3 * (uint64_t)mesh->triangle_count * mesh->index_size;
    return bytes + (-bytes & 3) + 8 * (uint64_t)mesh->edge_count;
}

static int get_mesh(reader *r, gn_mesh *mesh)
{
    if (r->size - r->at < 16)
        return WRONG(r, "the file ends within a mesh; expected 16 bytes more");
    uint32_t index_size;
    if (get_ranged(r, "vertex count", 4, 1, INT32_MAX, &mesh->vertex_count) ||
        get_ranged(r, "triangle count", 4, 1, INT32_MAX, &mesh->triangle_count) ||
        get_ranged(r, "bytes an index", 1, 2, 4, &index_size) || get_byte(r, "closed", 1, &mesh->closed) ||
        get_zeros(r, 2))
        return -1;
    if (index_size == 3)
        return WRONG(r, "3 bytes an index; expected 2 or 4");
    mesh->index_size = (uint8_t)index_size;
    uint64_t most = 3 * (uint64_t)mesh->triangle_count;
    if (get_ranged(r, "edge count", 4, 0, most < UINT32_MAX ? (uint32_t)most : UINT32_MAX, &mesh->edge_count))
        return -1;
    if (mesh_bytes(mesh) > r->size - r->at)
        return WRONG(r,
                     "the file ends within a mesh of %u vertices, %u triangles and %u edges; expected %llu bytes more",
                     (unsigned)mesh->vertex_count, (unsigned)mesh->triangle_count, (unsigned)mesh->edge_count,
                     (unsigned long long)mesh_bytes(mesh));
    return get_vertices(r, mesh) || get_indices(r, mesh) || get_edges(r, mesh) ? -1 : 0;
}

static int get_object(reader *r, packed_scene *packed, gn_object *object)
{
    uint32_t mesh;
    if (get_ranged(r, "mesh of an object", 4, 0, packed->mesh_count - 1, &mesh))
        return -1;
    object->mesh = &packed->meshes[mesh];
    object->colour.r = (uint8_t)get(r, 1);
    object->colour.g = (uint8_t)get(r, 1);
    object->colour.b = (uint8_t)get(r, 1);
    return get_zeros(r, 1);
}

static int get_meshes_and_objects(reader *r, packed_scene *packed)
{
    uint32_t objects, meshes;
    uint32_t most = (uint32_t)((r->size - r->at) / 8); /* no mesh and no object is smaller than 8 bytes */
    if (get_ranged(r, "number of meshes", 4, 1, most, &meshes) ||
        get_ranged(r, "number of objects", 4, 1, most, &objects))
        return -1;
    packed->meshes = memory_take(meshes, sizeof *packed->meshes);
    packed->mesh_count = meshes;
    for (uint32_t i = 0; i < meshes; i++)
        if (get_mesh(r, &packed->meshes[i]))
            return -1;
    if (r->size - r->at != 8 * (size_t)objects)
        return WRONG(r, "%zu bytes left for the objects; expected %zu", r->size - r->at, 8 * (size_t)objects);
    packed->objects = memory_take(objects, sizeof *packed->objects);
    packed->scene.objects = packed->objects;
    packed->scene.object_count = objects;
    for (uint32_t i = 0; i < objects; i++)
        if (get_object(r, packed, &packed->objects[i]))
            return -1;
    return 0;
}

int pack_is_packed(const uint8_t *bytes, size_t size)
{
    return size >= 4 && memcmp(bytes, "GNOM", 4) == 0;
}

static int check_frame(reader *r)
{
    if (!pack_is_packed(r->bytes, r->size))
        return WRONG(r, "is no packed scene; expected it to start with GNOM");
    if (r->size < MESHES) {
        r->at = r->size;
        return WRONG(r, "the file ends within its header; expected at least %d bytes", MESHES);
    }
    r->at = 4;
    uint32_t version = get(r, 4), bytes = get(r, 4), crc = get(r, 4);
    r->at = 4;
    if (version != VERSION)
        return WRONG(r, "version %u; expected %d", (unsigned)version, VERSION);
    r->at = 8;
    if (bytes != r->size)
        return WRONG(r, "the file says that it has %u bytes, and has %zu; expected the same", (unsigned)bytes, r->size);
    r->at = 12;
    if (crc != crc32_of(r->bytes + BODY, r->size - BODY))
        return WRONG(r, "the checksum is wrong; expected an unchanged file");
    r->at = BODY;
    return 0;
}

int pack_parse(packed_scene *packed, const char *file, const uint8_t *bytes, size_t size, problem *why)
{
    reader r = {.file = file, .bytes = bytes, .size = size, .why = why};
    memset(packed, 0, sizeof *packed);
    packed->largest_rounding = -1;
    if (check_frame(&r) || get_settings(&r, packed) || get_camera(&r, &packed->camera) ||
        get_light(&r, &packed->light, &packed->settings))
        return -1;
    return get_meshes_and_objects(&r, packed);
}
