/* Silhouette edges as a light sees them: where the triangles on an edge do not face it alike.
 *
 * Every triangle casts a shadow volume of its own; on an edge the sides of neighbours that face alike cancel. What is
 * left has a winding: the sum over the triangles of the edge's direction in them, times their facing. 0: no silhouette;
 * +-1: an open edge, or the other triangle casts nothing; +-2: one faces the light, one does not. The same sum serves
 * closed and open meshes, edges of more than two triangles, and solids turned inside out.
 *
 * Facing is decided exactly. Memory: 2 bits a triangle and 8 bytes an edge. */
#ifndef GN_SILHOUETTE_H
#define GN_SILHOUETTE_H

#include "gn_context.h"

typedef enum gn_facing {
    GN_CASTS_NOTHING = 0, /* edge-on, or before the near plane of a spot light */
    GN_FACES_LIGHT = 1,   /* its corners run counter-clockwise as the light sees them */
    GN_FACES_AWAY = 2,
    GN_CROSSES_NEAR = 3 /* the near plane of a spot light cuts it: it is treated on its own */
} gn_facing;

typedef struct gn_silhouette {
    uint32_t edge;                /* object << edge_bits | edge */
    uint16_t first_row, last_row; /* of the screen, that its sides cover; first > last: none */
} gn_silhouette;

/* Of a triangle of the scene by its number, objects one after the other. */
GN_INLINE gn_facing gn_facing_of(const uint8_t *facings, uint32_t triangle)
{
    return (gn_facing)(facings[triangle >> 2] >> 2 * (triangle & 3) & 3);
}

/* +1, -1, or 0 for what casts nothing with its neighbours. */
GN_INLINE int32_t gn_facing_sign(gn_facing facing)
{
    return facing == GN_FACES_LIGHT ? 1 : facing == GN_FACES_AWAY ? -1 : 0;
}

/* The way a triangle's corners run as the light sees them, exactly: 1 counter-clockwise, -1 clockwise, 0 edge-on. */
int gn_light_side(const gn_light *light, int32_t world[3][3]);

/* How far a point lies beyond the near plane of a spot light, in 2^-30 units. */
int64_t gn_beyond_near(const gn_light *light, const int32_t point[3]);

/* Fill facings (2 bits a triangle). *crossing: how many cross the near plane; with 0 for it that plane plays no part,
 * and every triangle faces the light or away, or is seen edge-on. GN_OUT_OF_RANGE: a vertex or a model. */
gn_status gn_find_facings(const gn_scene *scene, const gn_light *light, uint8_t *facings, uint32_t *crossing);

/* GN_BAD_MESH: an edge that does not exist or joins nothing, or fewer or more edges than the triangles ask for. */
gn_status gn_check_edges(const gn_mesh *mesh);

/* The vertices of a half-edge, from and to. */
void gn_half_edge_ends(const gn_mesh *mesh, uint32_t half, uint32_t ends[2]);

/* Check the edges of all meshes and list those with a winding. GN_BAD_MESH: as gn_check_edges. */
gn_status gn_list_silhouettes(const gn_scene *scene, const uint8_t *facings, uint32_t edge_bits, gn_silhouette *list,
                              uint32_t *count);

/* The ends of an edge as vertices of its mesh (ends may be 0), and its winding: positive where the first triangle's
 * direction counts. */
int32_t gn_edge_winding(const gn_mesh *mesh, const gn_mesh_edge *edge, const uint8_t *facings, uint32_t first_triangle,
                        uint32_t ends[2]);

#endif
