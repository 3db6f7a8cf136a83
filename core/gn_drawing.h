/* What silhouette maps and crossing maps share of the light pass: which edges of the scene's meshes are silhouettes,
 * their segments on the map, and the depths of a region that they are drawn over.
 *
 * The depths are the nearest layer's, before it is resolved. A region that ends within the map draws the nearest depths
 * of the row after it once more for its last row of cells.
 *
 * On a warped map (gn_grid.h) segments count in fine texels, and cells are as wide and high as their centres lie apart.
 *
 * Not drawn: the border of what a spot light's near plane cuts off, which is no edge of a mesh. An edge of more than
 * two triangles is drawn pair by pair, even where the sum over all of them is no silhouette.
 *
 * Memory: a byte a texel that stays; during the light pass a row of depths a worker, 2 bits a triangle and a bit an
 * edge. */
#ifndef GN_DRAWING_H
#define GN_DRAWING_H

#include "gn_context.h"
#include "gn_segment.h"

/* What a reconstruction has the light pass draw beside depths. Linked only with it. */
struct gn_drawing {
    /* of gn_make_plan: edges that are wrong */
    gn_status (*check)(const gn_scene *scene);
    /* Take from the block, beginning at used, what stays between the passes, or what is needed in the light pass, and
     * return the sum. With a null context count alone. */
    uint64_t (*lay_out_head)(gn_context *context, uint64_t used, const gn_settings *settings);
    uint64_t (*lay_out_light)(gn_context *context, uint64_t used, const gn_plan *plan, const gn_settings *settings);
    gn_status (*begin)(gn_context *context);
    /* when the layers of a region are drawn, before they are resolved */
    void (*draw)(gn_context *context, uint32_t region, uint32_t worker);
    uint8_t empty; /* what a texel holds where nothing is drawn */
};

/* What the context keeps for it. */
struct gn_drawn {
    uint8_t *map;     /* a byte a texel, rows as long as the map is wide */
    gn_depth *keys;   /* gn_silhouette_map.c, light pass: rank of the points that won; a region's a worker */
    uint32_t reach;   /* gn_silhouette_map.c, light pass: how far behind an edge a texel is its caster's, of 2^32 */
    gn_depth *row;    /* light pass: the row after a region; one a worker */
    uint8_t *facings; /* light pass: gn_find_facings */
    uint32_t *chosen; /* light pass: a bit an edge of the scene, 1: a silhouette */
    uint32_t count;   /* of silhouettes */
};

/* The hooks that serve any of them: check, lay_out_head, lay_out_light, begin. */
gn_status gn_check_drawing(const gn_scene *scene);
uint64_t gn_lay_out_drawn(gn_context *context, uint64_t used, const gn_settings *settings);
uint64_t gn_lay_out_drawing(gn_context *context, uint64_t used, const gn_plan *plan, const gn_settings *settings);
gn_status gn_begin_drawing(gn_context *context);

/* An edge as it is drawn. */
typedef struct gn_stroke {
    gn_segment segment;
    int32_t dx, dy; /* the segment's way, or its opposite: what casts the shadow lies where dx y < dy x */
    int alone;      /* of a triangle whose neighbours are not known: it need not be a silhouette */
} gn_stroke;

typedef struct gn_canvas gn_canvas;
typedef void gn_draw_stroke(const gn_canvas *c, const gn_stroke *s);

struct gn_canvas {
    gn_draw_stroke *draw;
    uint8_t *map;           /* of the region's first row; rows are width long */
    const gn_depth *texels; /* the same; rows are stride long */
    const gn_depth *beyond; /* the row after the region; 0 where the map ends with it */
    int32_t width;          /* of the map */
    int32_t stride;
    int32_t first, end; /* rows of the region, [first, end) */
    gn_cells cells;     /* between the map's columns, and the region's rows and the one after it */
    gn_depth *keys;     /* gn_silhouette_map.c: rank of the points in map */
    uint32_t reach;     /* gn_silhouette_map.c: of gn_drawn; on a warped map for a cell of one fine texel */
};

/* The canvas of a region, but for draw, keys and reach. */
void gn_begin_canvas(gn_context *context, uint32_t region, uint32_t worker, gn_canvas *c);

/* Depths of a row, or of the one after the region. */
GN_INLINE const gn_depth *gn_canvas_row(const gn_canvas *c, int32_t row)
{
    return row < c->end ? c->texels + (row - c->first) * c->stride : c->beyond;
}

/* All edges that gn_begin_drawing chose. */
void gn_draw_silhouette_edges(const gn_context *context, const gn_canvas *c);

#endif
