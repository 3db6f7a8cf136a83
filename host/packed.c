#include "packed.h"

#include "adjacency.h"
#include "file.h"
#include "pack.h"
#include "quantise.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static int quantise_file(packed_scene *packed, const char *path, const file_content *content, int verbose, problem *why)
{
    scene_file scene;
    int result = scene_file_parse(&scene, path, (const char *)content->bytes, content->size, why);
    if (!result)
        result = quantise(packed, &scene, verbose, why);
    scene_file_free(&scene);
    return result;
}

int packed_read(packed_scene *packed, const char *path, int verbose, problem *why)
{
    file_content content;
    memset(packed, 0, sizeof *packed);
    if (file_read(&content, path, why))
        return -1;
    int result = pack_is_packed(content.bytes, content.size) || file_has_extension(path, ".gno")
                     ? pack_parse(packed, path, content.bytes, content.size, why)
                     : quantise_file(packed, path, &content, verbose, why);
    free(content.bytes);
    return result;
}

static void notice_edges(uint32_t mesh, adjacency_counts counts)
{
    if (counts.open)
        fprintf(stderr, "gnomon: notice: mesh %u has %u open edges\n", (unsigned)mesh, (unsigned)counts.open);
    if (counts.same_direction)
        fprintf(stderr, "gnomon: notice: mesh %u has %u edges between triangles of opposite winding\n", (unsigned)mesh,
                (unsigned)counts.same_direction);
    if (counts.non_manifold)
        fprintf(stderr, "gnomon: notice: mesh %u has %u edges with more than two triangles\n", (unsigned)mesh,
                (unsigned)counts.non_manifold);
    if (counts.left_out)
        fprintf(stderr, "gnomon: notice: mesh %u has %u triangles with two corners at one place\n", (unsigned)mesh,
                (unsigned)counts.left_out);
}

int packed_make_edges(packed_scene *packed, int verbose, problem *why)
{
    for (uint32_t i = 0; i < packed->mesh_count; i++) {
        gn_mesh *mesh = &packed->meshes[i];
        if (mesh->edges)
            continue;
        if (mesh->triangle_count > ADJACENCY_MOST_TRIANGLES)
            return problem_of_usage(why, "mesh %u has %u triangles; expected at most %u where its edges are asked for",
                                    (unsigned)i, (unsigned)mesh->triangle_count, ADJACENCY_MOST_TRIANGLES);
        adjacency_counts counts = adjacency_make(mesh);
        if (verbose)
            notice_edges(i, counts);
    }
    return 0;
}

void packed_drop_edges(packed_scene *packed)
{
    for (uint32_t i = 0; i < packed->mesh_count; i++) {
        free((void *)packed->meshes[i].edges);
        packed->meshes[i].edges = 0;
        packed->meshes[i].edge_count = 0;
    }
}

void packed_free(packed_scene *packed)
{
    packed_drop_edges(packed);
    for (uint32_t i = 0; i < packed->mesh_count; i++) {
        free((void *)packed->meshes[i].vertices);
        free((void *)packed->meshes[i].indices);
    }
    free(packed->meshes);
    free(packed->objects);
    memset(packed, 0, sizeof *packed);
}

uint64_t packed_vertex_count(const packed_scene *packed)
{
    uint64_t count = 0;
    for (uint32_t i = 0; i < packed->scene.object_count; i++)
        count += packed->objects[i].mesh->vertex_count;
    return count;
}

uint64_t packed_triangle_count(const packed_scene *packed)
{
    uint64_t count = 0;
    for (uint32_t i = 0; i < packed->scene.object_count; i++)
        count += packed->objects[i].mesh->triangle_count;
    return count;
}
