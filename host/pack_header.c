/* The packed scene as C arrays: see pack.h. The header includes gnomon.h and nothing else; it compiles as C99. */
#include "pack.h"

#include "choices.h"
#include "file.h"

#include <ctype.h>
#include <inttypes.h>
#include <string.h>

typedef struct source {
    FILE *stream;
    char name[64]; /* the prefix of every identifier */
} source;

/* The file's name without folder and extension, as a C identifier. */
static void make_name(char name[64], const char *path)
{
    const char *base = strrchr(path, '/');
    size_t length = 0;
    base = base ? base + 1 : path;
    if (isdigit((unsigned char)*base))
        name[length++] = '_';
    for (; *base && *base != '.' && length < 40; base++)
        name[length++] = isalnum((unsigned char)*base) && (unsigned char)*base < 128 ? *base : '_';
    if (!length)
        name[length++] = '_';
    name[length] = 0;
}

static void write_vertices(const source *s, uint32_t number, const gn_mesh *mesh)
{
    fprintf(s->stream, "static const int32_t %s_vertices_%" PRIu32 "[%" PRIu32 "][3] = {\n", s->name, number,
            mesh->vertex_count);
    for (uint32_t v = 0; v < mesh->vertex_count; v++)
        fprintf(s->stream, "%s{%" PRId32 ", %" PRId32 ", %" PRId32 "},%s", v % 4 ? " " : "    ", mesh->vertices[v][0],
                mesh->vertices[v][1], mesh->vertices[v][2], v % 4 == 3 || v + 1 == mesh->vertex_count ? "\n" : "");
    fputs("};\n\n", s->stream);
}

static void write_indices(const source *s, uint32_t number, const gn_mesh *mesh)
{
    fprintf(s->stream, "static const uint%d_t %s_indices_%" PRIu32 "[3 * %" PRIu32 "] = {\n", 8 * mesh->index_size,
            s->name, number, mesh->triangle_count);
    for (uint32_t t = 0; t < mesh->triangle_count; t++) {
        uint32_t corners[3];
        for (uint32_t i = 0; i < 3; i++)
            corners[i] = mesh->index_size == 2 ? ((const uint16_t *)mesh->indices)[3 * t + i]
                                               : ((const uint32_t *)mesh->indices)[3 * t + i];
        fprintf(s->stream, "%s%" PRIu32 ", %" PRIu32 ", %" PRIu32 ",%s", t % 6 ? " " : "    ", corners[0], corners[1],
                corners[2], t % 6 == 5 || t + 1 == mesh->triangle_count ? "\n" : "");
    }
    fputs("};\n\n", s->stream);
}

static void write_edge(const source *s, const gn_mesh_edge *edge)
{
    uint32_t second = edge->half[1];
    fprintf(s->stream, "{{%" PRIu32 ", ", edge->half[0]);
    if (second == GN_NO_HALF_EDGE)
        fputs("GN_NO_HALF_EDGE}},", s->stream);
    else
        fprintf(s->stream, "%s%" PRIu32 "}},", second & GN_SAME_DIRECTION ? "GN_SAME_DIRECTION | " : "",
                second & ~GN_SAME_DIRECTION);
}

/* C has no array of no elements: where a mesh's edges are none at all, one stands there that is not counted. */
static void write_edges(const source *s, uint32_t number, const gn_mesh *mesh)
{
    fprintf(s->stream, "static const gn_mesh_edge %s_edges_%" PRIu32 "[%" PRIu32 "] = {\n", s->name, number,
            mesh->edge_count ? mesh->edge_count : 1);
    if (!mesh->edge_count)
        fputs("    {{GN_NO_HALF_EDGE, GN_NO_HALF_EDGE}},\n", s->stream);
    for (uint32_t e = 0; e < mesh->edge_count; e++) {
        fputs(e % 6 ? " " : "    ", s->stream);
        write_edge(s, &mesh->edges[e]);
        fputs(e % 6 == 5 || e + 1 == mesh->edge_count ? "\n" : "", s->stream);
    }
    fputs("};\n\n", s->stream);
}

static void write_mesh(const source *s, uint32_t number, const gn_mesh *mesh)
{
    fprintf(s->stream,
            "    {.vertices = %s_vertices_%" PRIu32 ", .indices = %s_indices_%" PRIu32 ", .vertex_count = %" PRIu32
            ",\n     .triangle_count = %" PRIu32 ", .index_size = %d, .closed = %d",
            s->name, number, s->name, number, mesh->vertex_count, mesh->triangle_count, mesh->index_size, mesh->closed);
    if (mesh->edges)
        fprintf(s->stream, ",\n     .edges = %s_edges_%" PRIu32 ", .edge_count = %" PRIu32, s->name, number,
                mesh->edge_count);
    fputs("},\n", s->stream);
}

static void write_meshes(const source *s, const packed_scene *packed)
{
    for (uint32_t i = 0; i < packed->mesh_count; i++) {
        write_vertices(s, i, &packed->meshes[i]);
        write_indices(s, i, &packed->meshes[i]);
        if (packed->meshes[i].edges)
            write_edges(s, i, &packed->meshes[i]);
    }
    fprintf(s->stream, "static const gn_mesh %s_meshes[%" PRIu32 "] = {\n", s->name, packed->mesh_count);
    for (uint32_t i = 0; i < packed->mesh_count; i++)
        write_mesh(s, i, &packed->meshes[i]);
    fputs("};\n\n", s->stream);
}

static void write_scene(const source *s, const packed_scene *packed)
{
    const gn_scene *scene = &packed->scene;
    fprintf(s->stream, "static const gn_object %s_objects[%" PRIu32 "] = {\n", s->name, scene->object_count);
    for (uint32_t i = 0; i < scene->object_count; i++) {
        const gn_object *object = &packed->objects[i];
        fprintf(s->stream, "    {.mesh = &%s_meshes[%d], .colour = {%d, %d, %d}},\n", s->name,
                (int)(object->mesh - packed->meshes), object->colour.r, object->colour.g, object->colour.b);
    }
    fprintf(s->stream,
            "};\n\nstatic const gn_scene %s_scene = {\n    .objects = %s_objects,\n    .object_count = %" PRIu32
            ",\n    .background = {%d, %d, %d},\n    .ambient = %d,\n};\n\n",
            s->name, s->name, scene->object_count, scene->background.r, scene->background.g, scene->background.b,
            scene->ambient);
}

static void write_vector(const source *s, const char *field, const int32_t v[3])
{
    fprintf(s->stream, "    .%s = {%" PRId32 ", %" PRId32 ", %" PRId32 "},\n", field, v[0], v[1], v[2]);
}

static void write_camera(const source *s, const gn_camera *c)
{
    fprintf(s->stream, "static const gn_camera %s_camera = {\n    .projection = %s,\n", s->name,
            c->projection == GN_PERSPECTIVE ? "GN_PERSPECTIVE" : "GN_ORTHOGRAPHIC");
    write_vector(s, "eye", c->eye);
    write_vector(s, "right", c->right);
    write_vector(s, "up", c->up);
    write_vector(s, "forward", c->forward);
    fprintf(s->stream,
            "    .tan_half = %" PRIu32 "u,\n    .half_height = %" PRId32 ",\n    .near_depth = %" PRId32
            ",\n    .far_depth = %" PRId32 ",\n};\n\n",
            c->projection == GN_PERSPECTIVE ? c->tan_half : 0, c->projection == GN_PERSPECTIVE ? 0 : c->half_height,
            c->near_depth, c->far_depth);
}

static void write_light(const source *s, const gn_light *l)
{
    fprintf(s->stream, "static const gn_light %s_light = {\n    .kind = %s,\n", s->name,
            l->kind == GN_POINT  ? "GN_POINT"
            : l->kind == GN_SPOT ? "GN_SPOT"
                                 : "GN_DIRECTIONAL");
    if (l->kind != GN_POINT) {
        write_vector(s, "right", l->right);
        write_vector(s, "up", l->up);
        write_vector(s, "forward", l->forward);
    }
    if (l->kind != GN_DIRECTIONAL) {
        write_vector(s, "position", l->position);
        if (l->kind == GN_SPOT)
            fprintf(s->stream, "    .tan_half = %" PRIu32 "u,\n", l->tan_half);
        fprintf(s->stream, "    .near_depth = %" PRId32 ",\n    .far_depth = %" PRId32 ",\n", l->near_depth,
                l->far_depth);
    } else {
        fprintf(s->stream,
                "    .box_u = %" PRId32 ",\n    .box_v = %" PRId32 ",\n    .box_z = %" PRId32
                ",\n    .box_width = %" PRId32 ",\n    .box_height = %" PRId32 ",\n    .box_depth = %" PRId32 ",\n",
                l->box_u, l->box_v, l->box_z, l->box_width, l->box_height, l->box_depth);
    }
    fputs("};\n\n", s->stream);
}

/* Naming one links it; the default has no name. */
static void write_object(const source *s, const char *field, const choices *of, const void *object)
{
    if (object)
        fprintf(s->stream, "    .%s = %s,\n", field, of->all[choices_number(of, object)].identifier);
}

static void write_settings(const source *s, const gn_settings *settings)
{
    fprintf(s->stream,
            "static const gn_settings %s_settings = {\n    .width = %d,\n    .height = %d,\n    .map_width = %d,\n"
            "    .map_height = %d,\n    .cull = %s,\n    .layers = %s,\n    .surface = %s,\n    .format = GN_RGB888,\n"
            "    .workers = 1,\n",
            s->name, settings->width, settings->height, settings->map_width, settings->map_height,
            choices_cull.all[settings->cull].identifier, choices_layers.all[settings->layers].identifier,
            choices_surface.all[settings->surface].identifier);
    if (settings->shadow == GN_SHADOW_VOLUMES)
        fputs("    .shadow = GN_SHADOW_VOLUMES,\n", s->stream);
    fprintf(s->stream, "    .bias = {%s, %" PRIu32 "u},\n", choices_bias_unit.all[settings->bias.unit].identifier,
            settings->bias.value);
    if (settings->slope)
        fprintf(s->stream, "    .slope = %" PRId32 ",\n", settings->slope);
    write_object(s, "receiver", &choices_receiver, settings->receiver);
    write_object(s, "reconstruction", &choices_reconstruction, settings->reconstruction);
    write_object(s, "fit", &choices_fit, settings->fit);
    write_object(s, "warp", &choices_warp, settings->warp);
    write_object(s, "faces", &choices_faces, settings->faces);
    if (settings->fit_depth)
        fputs("    .fit_depth = 1,\n", s->stream);
    if (settings->smoothing)
        fprintf(s->stream, "    .smoothing = %" PRId32 ",\n", settings->smoothing);
    fputs("};\n\n", s->stream);
}

int pack_write_header(const packed_scene *packed, const char *path, const char *from, problem *why)
{
    source s;
    file_output output;
    const char *base = strrchr(from, '/');
    if (file_output_open(&output, path, why))
        return -1;
    make_name(s.name, path);
    s.stream = output.stream;
    fprintf(s.stream,
            "/* Written by `gnomon pack` from %s: %" PRIu64 " triangles, %" PRIu64 " vertices;\n"
            " * one world unit is 2^%d. Include it in one file. */\n",
            base ? base + 1 : from, packed_triangle_count(packed), packed_vertex_count(packed), packed->scale);
    fprintf(s.stream, "#ifndef GNOMON_SCENE_%s\n#define GNOMON_SCENE_%s\n\n#include \"gnomon.h\"\n\n", s.name, s.name);
    write_meshes(&s, packed);
    write_scene(&s, packed);
    write_camera(&s, &packed->camera);
    write_light(&s, &packed->light);
    write_settings(&s, &packed->settings);
    fputs("#endif\n", s.stream);
    return file_output_finish(&output, why);
}
