#include "gn_silhouette.h"

void gn_half_edge_ends(const gn_mesh *mesh, uint32_t half, uint32_t ends[2])
{
    uint32_t index[3], triangle = half / 3, corner = half - 3 * triangle;
    gn_triangle_indices(mesh, triangle, index);
    ends[0] = index[corner];
    ends[1] = index[corner == 2 ? 0 : corner + 1];
}

int gn_light_side(const gn_light *light, int32_t world[3][3])
{
    int32_t to_light[3];
    int64_t n[3];
    gn_normal(n, world);
    gn_to_light(to_light, light, world[0]);
    return gn_dot_sign(n, to_light);
}

int64_t gn_beyond_near(const gn_light *light, const int32_t point[3])
{
    int64_t w = 0;
    for (int i = 0; i < 3; i++)
        w += gn_multiply(point[i] - light->position[i], light->forward[i]);
    return w - gn_multiply(light->near_depth, 1 << 30);
}

static gn_facing find_facing(const gn_light *light, int32_t world[3][3], int cuts)
{
    int side = gn_light_side(light, world);
    if (side == 0)
        return GN_CASTS_NOTHING;
    if (cuts && light->kind == GN_SPOT) {
        int beyond = 0; /* corners at or beyond the near plane */
        for (int i = 0; i < 3; i++)
            beyond += gn_beyond_near(light, world[i]) >= 0;
        if (beyond < 3)
            return beyond ? GN_CROSSES_NEAR : GN_CASTS_NOTHING;
    }
    return side > 0 ? GN_FACES_LIGHT : GN_FACES_AWAY;
}

gn_status gn_find_facings(const gn_scene *scene, const gn_light *light, uint8_t *facings, uint32_t *crossing)
{
    uint32_t number = 0, cut = 0;
    for (uint32_t o = 0; o < scene->object_count; o++) {
        const gn_object *object = &scene->objects[o];
        if (object->model && gn_check_model(object->model) != GN_OK)
            return GN_OUT_OF_RANGE;
        for (uint32_t t = 0; t < object->mesh->triangle_count; t++, number++) {
            int32_t world[3][3];
            uint32_t shift = 2 * (number & 3);
            if (gn_triangle_world(object, t, world) != GN_OK)
                return GN_OUT_OF_RANGE;
            uint32_t facing = find_facing(light, world, crossing != 0);
            cut += facing == GN_CROSSES_NEAR;
            facings[number >> 2] = (uint8_t)((facings[number >> 2] & ~(3u << shift)) | facing << shift);
        }
    }
    if (crossing)
        *crossing = cut;
    return GN_OK;
}

int32_t gn_edge_winding(const gn_mesh *mesh, const gn_mesh_edge *edge, const uint8_t *facings, uint32_t first_triangle,
                        uint32_t ends[2])
{
    if (ends)
        gn_half_edge_ends(mesh, edge->half[0], ends);
    int32_t winding = gn_facing_sign(gn_facing_of(facings, first_triangle + edge->half[0] / 3));
    if (edge->half[1] == GN_NO_HALF_EDGE)
        return winding;
    uint32_t other = edge->half[1] & ~GN_SAME_DIRECTION;
    int32_t sign = gn_facing_sign(gn_facing_of(facings, first_triangle + other / 3));
    return edge->half[1] & GN_SAME_DIRECTION ? winding + sign : winding - sign;
}

static int same_place(const int32_t a[3], const int32_t b[3])
{
    return a[0] == b[0] && a[1] == b[1] && a[2] == b[2];
}

/* Half-edges that must stand in the edges: all but those of triangles with two corners in one place. */
static uint32_t count_half_edges(const gn_mesh *mesh)
{
    uint32_t count = 0;
    for (uint32_t t = 0; t < mesh->triangle_count; t++) {
        uint32_t i[3];
        gn_triangle_indices(mesh, t, i);
        const int32_t(*v)[3] = mesh->vertices;
        if (!same_place(v[i[0]], v[i[1]]) && !same_place(v[i[1]], v[i[2]]) && !same_place(v[i[2]], v[i[0]]))
            count += 3;
    }
    return count;
}

/* Does the second half-edge join the same places as the first, in the direction that it says? */
static int joins(const gn_mesh *mesh, const gn_mesh_edge *edge)
{
    uint32_t a[2], b[2], other = edge->half[1] & ~GN_SAME_DIRECTION;
    int same = (edge->half[1] & GN_SAME_DIRECTION) != 0;
    gn_half_edge_ends(mesh, edge->half[0], a);
    gn_half_edge_ends(mesh, other, b);
    return same_place(mesh->vertices[a[0]], mesh->vertices[b[same ? 0 : 1]]) &&
           same_place(mesh->vertices[a[1]], mesh->vertices[b[same ? 1 : 0]]);
}

gn_status gn_check_edges(const gn_mesh *mesh)
{
    if ((uintptr_t)mesh->edges % 4)
        return GN_BAD_MESH;
    uint32_t last = 3 * mesh->triangle_count, count = 0;
    if (mesh->edge_count && !mesh->edges)
        return GN_BAD_ARGUMENT;
    for (uint32_t i = 0; i < mesh->edge_count; i++) {
        const gn_mesh_edge *edge = &mesh->edges[i];
        if (edge->half[0] >= last)
            return GN_BAD_MESH;
        count++;
        if (edge->half[1] == GN_NO_HALF_EDGE)
            continue;
        if ((edge->half[1] & ~GN_SAME_DIRECTION) >= last || !joins(mesh, edge))
            return GN_BAD_MESH;
        count++;
    }
    return count == count_half_edges(mesh) || count == last ? GN_OK : GN_BAD_MESH;
}

gn_status gn_list_silhouettes(const gn_scene *scene, const uint8_t *facings, uint32_t edge_bits, gn_silhouette *list,
                              uint32_t *count)
{
    uint32_t first = 0;
    *count = 0;
    for (uint32_t o = 0; o < scene->object_count; o++) {
        const gn_mesh *mesh = scene->objects[o].mesh;
        /* instances of one mesh mostly follow each other: check it once */
        gn_status status = o && mesh == scene->objects[o - 1].mesh ? GN_OK : gn_check_edges(mesh);
        if (status != GN_OK)
            return status;
        for (uint32_t e = 0; e < mesh->edge_count; e++) {
            if (gn_edge_winding(mesh, &mesh->edges[e], facings, first, 0) == 0)
                continue;
            gn_silhouette silhouette = {o << edge_bits | e, 0, 0};
            list[(*count)++] = silhouette;
        }
        first += mesh->triangle_count;
    }
    return GN_OK;
}
