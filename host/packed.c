#include "packed.h"

#include "file.h"
#include "pack.h"
#include "quantise.h"

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

void packed_free(packed_scene *packed)
{
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
