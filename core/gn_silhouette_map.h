/* The light pass's share of silhouette maps (Sen et al. 2003, 3.1): which edges are silhouettes, their segments on the
 * map, and one point a cell.
 *
 * Of several segments in a cell the one that is nearest to the light at its point wins, at equal depth the smaller
 * byte: so the map does not depend on the order of edges, on regions or on workers. A point that lies behind all four
 * texels of its cell is hidden and not written: they are the nearest layer's, before it is resolved; with front faces
 * culled that layer holds back faces, and the test lets more pass. A region that ends within the map draws the nearest
 * depths of the row after it once more for its last cells.
 *
 * Memory: a byte a texel that stays; during the light pass a depth a texel of a region and worker, a row of depths a
 * worker, 2 bits a triangle and a bit an edge. */
#ifndef GN_SILHOUETTE_MAP_H
#define GN_SILHOUETTE_MAP_H

#include "gn_context.h"

#define GN_CELL_CENTRE 0x88u /* a cell without a silhouette: half a texel both ways */

/* What a reconstruction has the light pass draw beside depths. Linked only with it. */
struct gn_drawing {
    /* of gn_make_plan: edges that are wrong */
    gn_status (*check)(const gn_scene *scene);
    /* Take from the block, beginning at used, what stays between the passes, or what is needed in the light pass, and
     * return the sum. With a null context count alone. */
    uint64_t (*lay_out_head)(gn_context *context, uint64_t used, const gn_scene *scene, const gn_settings *settings);
    uint64_t (*lay_out_light)(gn_context *context, uint64_t used, const gn_plan *plan, const gn_settings *settings);
    gn_status (*begin)(gn_context *context);
    /* when the layers of a region are drawn, before they are resolved */
    void (*draw)(gn_context *context, uint32_t region, uint32_t worker);
};

/* What the context keeps for it. */
struct gn_drawn {
    uint8_t *map;       /* a byte a texel, rows as long as the map is wide */
    gn_depth *keys;     /* light pass: rank of the points that won, GN_FARTHEST none; a region's a worker */
    uint32_t reach;     /* light pass: of 2^32 */
    gn_depth *row;      /* light pass: the row after a region; one a worker */
    uint8_t *facings;   /* light pass: gn_find_facings */
    uint32_t *chosen;   /* light pass: a bit an edge of the scene, 1: a silhouette */
    uint32_t count;     /* of silhouettes */
    uint32_t map_bytes; /* of map */
};

extern const gn_drawing gn_draw_silhouettes;

#endif
