/* What a context holds, and how its block is laid out: the head, the object states and the map stay; what follows is
 * shared by the two passes in turn (gn_plan.c). */
#ifndef GN_CONTEXT_H
#define GN_CONTEXT_H

#include "gn_grid.h"
#include "gn_vector.h"
#include "gn_view.h"
#include "gnomon.h"

#define GN_NO_TRIANGLE 0xffffffffu
#define GN_FARTHEST ((gn_depth)0xffffffffu) /* what an empty texel holds */

typedef struct gn_drawing gn_drawing;
typedef struct gn_drawn gn_drawn;
typedef struct gn_fitting gn_fitting;
struct gn_points;

/* gn_light_pass.c: what is done with a triangle that has a corner beyond the planes or the guard band. */
typedef void gn_insert_beyond(const gn_context *context, struct gn_layer_target *t, const gn_object *object,
                              uint32_t triangle, int culled, const gn_window *window);

/* Colour pairs of triangles in view, kept per worker: a direct-mapped cache, a power of two. Trades RAM (24 bytes an
 * entry) against time; never changes a pixel. */
#ifndef GN_COLOUR_CACHE
#define GN_COLOUR_CACHE 64
#endif
#if GN_COLOUR_CACHE < 1 || (GN_COLOUR_CACHE & (GN_COLOUR_CACHE - 1)) != 0
#error "GN_COLOUR_CACHE must be a power of two"
#endif

typedef struct gn_object_state {
    uint32_t first_vertex;   /* of the object in the vertex array */
    uint32_t first_triangle; /* of the object in the whole scene */
    uint8_t mirrored;        /* the model matrix turns front into back */
    uint8_t clips;           /* some vertex cannot be projected in the current pass */
} gn_object_state;

/* value(x, y) = a + b's product with W: a(x, y) + floor(W b(x, y) / 2^32), each affine in the pixel, modulo 2^32. With
 * a perspective camera only b varies over the image, with an orthographic one only a. */
typedef struct gn_linear {
    uint32_t a, a_dx, a_dy;
    uint32_t b, b_dx, b_dy;
} gn_linear;

/* From (x, y, Q) to light space. */
typedef struct gn_shading {
    gn_linear coordinate[3]; /* directional: u, v, depth; spot: (X + W) / 2, (Y + W) / 2, W; point: x, y, z */
    uint32_t nothing;        /* Q where there is no surface */
    uint8_t w_shift;         /* W = 2^(61 - w_shift) / Q */
    uint8_t position_bits;   /* fraction bits of u and v in texels */
    uint8_t depth_bits;      /* fraction bits of depth in units of 1/65536 */
    uint8_t trusted; /* gn_inside: whether every point of the scene lies inside the light's box: no test needed */
    uint32_t near_w, far_w; /* spot, point: in the unit of coordinate[2] */
} gn_shading;

typedef enum gn_phase {
    GN_PHASE_NONE,
    GN_PHASE_VIEW, /* of the view pass */
    GN_PHASE_LIGHT,
    GN_PHASE_CAMERA_FAILED,
    GN_PHASE_CAMERA,
    GN_PHASE_VOLUMES_LIGHT, /* silhouettes are listed */
    GN_PHASE_VOLUMES
} gn_phase;
typedef enum gn_progress { GN_REGION_UNTOUCHED, GN_REGION_LAYERS, GN_REGION_DONE } gn_progress;

typedef struct gn_colour_pair {
    uint32_t triangle;
    uint32_t lit, unlit; /* as written to the image; lit: full light */
    uint32_t distance; /* directional: N.L in 2^-16; spot: N.L = distance (near / |point - light| in 2^-30) 2^-shift */
    uint8_t distance_shift;
    uint8_t faces_light; /* camera and light are on the same side */
} gn_colour_pair;

typedef struct gn_worker {
    gn_depth *second; /* light pass: second layer of a light region */
    uint32_t *q;      /* camera pass: Q, later what the shadow test leaves */
    uint32_t *triangle;
    gn_colour_pair *colours;
    struct gn_receiver_plane *planes; /* camera pass; 0 without a receiver */
    uint8_t *fraction;                /* camera pass: lit parts of 254 of a row; 0 without a reconstruction */
    gn_statistics statistics;
} gn_worker;

struct gn_context {
    const gn_scene *scene;
    gn_settings settings;
    gn_plan plan;
    gn_object_state *objects;
    gn_worker *workers;
    gn_depth *map;
    uint32_t map_stride; /* texels from row to row */
    uint8_t *shared;     /* where the two passes take turns */
    gn_vertex *vertices;
    uint32_t triangle_bits;     /* identifier = object << triangle_bits | triangle */
    struct gn_volumes *volumes; /* 0 with shadow maps */
    gn_drawn *drawn;            /* gn_drawing.h; 0 without */
    struct gn_point *point;     /* gn_point_light.h; 0 without settings.faces */
    gn_fitting *fitting;        /* gn_parameterisation.h; 0 without a fit and a warp */
    const gn_grid *grid;        /* where the texels of a warped map lie; 0: evenly */

    gn_insert_beyond *insert_clamped; /* gn_fit_depth.c, in place of clipping; 0: triangles are clipped */
    gn_light light;
    gn_view light_view;
    uint8_t point_light;                 /* 1: light and light_view are those of a face of one */
    uint32_t bias;                       /* in units of a 32-bit depth */
    uint8_t light_trusted;               /* gn_inside */
    uint8_t keeps;                       /* gn_static_casters.c: 1: what it keeps is set up */
    uint8_t phase;                       /* gn_phase: whose turn it is to use the shared part */
    uint8_t *progress;                   /* gn_progress of each light region, written by whoever renders it */
    uint32_t tan_squared;                /* spot: of half the opening, 19 fraction bits */
    uint32_t texels_across, texels_down; /* spot: so many would be on its whole plane; 8 fraction bits */

    gn_camera camera;
    gn_view camera_view;
    gn_shading shading;
    uint32_t *bin_first; /* first item of each bin; one more at the end */
    uint32_t *bin_items; /* triangle identifiers */
    uint32_t bands, bin_count;
    uint8_t bin_levels;
    void *colour_buffer; /* of gn_camera_pass */
    uint8_t *mask_buffer;
};

GN_INLINE void gn_triangle_indices(const gn_mesh *mesh, uint32_t triangle, uint32_t index[3])
{
    if (mesh->index_size == 2) {
        const uint16_t *i = (const uint16_t *)mesh->indices + 3 * (size_t)triangle;
        index[0] = i[0], index[1] = i[1], index[2] = i[2];
    } else {
        const uint32_t *i = (const uint32_t *)mesh->indices + 3 * (size_t)triangle;
        index[0] = i[0], index[1] = i[1], index[2] = i[2];
    }
}

/* What settings.faces brings (gn_point_light.c). */
struct gn_faces {
    uint8_t count; /* maps in memory */
    /* Take what stays between the passes, as gn_drawing's hooks do. */
    uint64_t (*lay_out)(gn_context *context, uint64_t used, const gn_plan *plan, const gn_settings *settings);
    /* gn_camera_begin and gn_find_points of a point light */
    gn_status (*camera_begin)(gn_context *context, const gn_camera *camera);
    void (*find_points)(const gn_context *context, struct gn_points *points, uint32_t *q);
};

/* Point lights: may a triangle of the objects [first, end) cover a texel of the face that has begun? */
typedef int gn_covers(const gn_context *context, uint32_t first, uint32_t end);

/* What settings.casters brings (gn_static_casters.c). */
struct gn_casters {
    /* of gn_make_plan, when the map is planned: set plan->static_bytes, check the settings */
    gn_status (*plan)(gn_plan *plan, const gn_scene *scene, const gn_settings *settings);
    /* gn_light_begin: in place of gn_transform_scene */
    gn_status (*begin)(gn_context *context, int *inside);
    /* gn_light_layers: in place of clearing; leaves static objects in the rows [row, end), and the others to be drawn
     */
    void (*start)(gn_context *context, struct gn_layer_target *t, uint32_t row, uint32_t end);
    /* gn_nearest_row: the same with a single row, of one layer */
    void (*start_row)(gn_context *context, struct gn_layer_target *t, uint32_t row);
    /* point lights: may any object cover a texel of the face that has begun? */
    int (*reach)(gn_context *context, gn_covers *covers);
};

/* World position of a vertex. GN_OUT_OF_RANGE beyond GN_WORLD_MAX. */
gn_status gn_world_position(const gn_object *object, uint32_t vertex, int32_t world[3]);

/* Of a triangle's corners; its normal, |n| <= 2^53, by the way that they run; the way from a point to the light; and
 * whether camera and light are on the same side of a triangle with that normal and a point on it, exactly. */
gn_status gn_triangle_world(const gn_object *object, uint32_t triangle, int32_t world[3][3]);
void gn_normal(int64_t n[3], int32_t world[3][3]);
void gn_to_light(int32_t to_light[3], const gn_light *light, const int32_t point[3]);
int gn_seen_lit(const gn_context *context, const int64_t n[3], const int32_t point[3]);

/* GN_OUT_OF_RANGE where a number of the model is outside its stated range. */
gn_status gn_check_model(const gn_model *model);

/* a x b, |a|, |b| <= 2^30. */
void gn_cross(int64_t n[3], const int32_t a[3], const int32_t b[3]);

/* Sign of n . v, exactly: |n| <= 2^61, |v| <= 2^30. */
int gn_dot_sign(const int64_t n[3], const int32_t v[3]);

/* Where the vertices of a scene lie: all inside the screen; and with half a pixel and more than a point's error of
 * depth to spare, so that the four pixels about any of their points exist. Those of objects with a model are not known
 * to: they may move before the next pass. */
typedef enum gn_inside { GN_NOT_INSIDE, GN_INSIDE, GN_WELL_INSIDE } gn_inside;
#define GN_SPARE 160              /* 1/256 pixel */
#define GN_SPARE_DEPTH (1u << 17) /* of 2^31 */

/* Transform all vertices of the scene for a view; sets the objects' states. *largest_w: of all vertices in front;
 * *inside: a gn_inside. */
gn_status gn_transform_scene(gn_context *context, const gn_view *view, int32_t *largest_w, int *inside);

/* The places of a triangle's corners, for clipping. */
void gn_triangle_places(const gn_view *view, const gn_object *object, uint32_t triangle, gn_place corner[3]);

/* Maps in memory: a point light may have six, one below the other. */
GN_INLINE uint32_t gn_map_count(const gn_settings *settings)
{
    return settings->faces ? settings->faces->count : 1;
}

/* Whether the light pass keeps two depths a texel: two layers, or the accumulator of slopes beside the first. */
GN_INLINE int gn_has_second(const gn_plan *plan, const gn_settings *settings)
{
    return plan->layers == GN_LAYERS_TWO || settings->surface == GN_SLOPE;
}

/* Take bytes from the block, aligned, and count them; without a block count alone. */
void *gn_take(uint8_t *base, uint64_t *used, uint64_t bytes);

/* gn_light_pass.c: the nearest depths of one row of the map once more, into map_stride depths, without marks. */
void gn_nearest_row(gn_context *context, uint32_t worker, int32_t row, gn_depth *depths);

/* Lay out the shared part of the block for one pass; returns its size. With a null context only the size. */
uint64_t gn_lay_out_light(gn_context *context, const gn_plan *plan, const gn_settings *settings);
uint64_t gn_lay_out_camera(gn_context *context, const gn_plan *plan, const gn_settings *settings);

/* gn_bias.c: a bias under the context's light, in units of a 32-bit depth; 0xffffffff where it exceeds the range. */
uint32_t gn_make_bias(const gn_context *context, const gn_bias *bias);

/* gn_shading.c, gn_shade.c: constants of a pair of camera and light, and the shadow test of one row. Afterwards q[i] is
 * negative as a signed number where the pixel is shadowed; where it is lit, with a spot light near / distance, Q2.30.
 * Without a map: gn_set_farthest makes what visibility needs, and a spot light's gn_falloff_row leaves every pixel lit.
 */
gn_status gn_make_shading(gn_context *context, int32_t largest_w);
void gn_set_farthest(gn_context *context, int32_t largest_w);
void gn_shade_row(const gn_context *context, uint32_t *q, int32_t x, int32_t y, int32_t count);
void gn_falloff_row(const gn_context *context, uint32_t *q, int32_t x, int32_t y, int32_t count);

/* gn_lambert.c, gn_colour.c: the colours of a triangle; the colours and the mask of one row. Returns the number of
 * pixels that see a surface; *tested: of these, turned to the light. colour or mask may be 0. */
void gn_make_pair(const gn_context *context, gn_colour_pair *pair, uint32_t triangle);
void gn_clear_colours(gn_worker *worker);
typedef uint32_t gn_colour_shader(const gn_context *context, gn_worker *worker, const uint32_t *lit,
                                  const uint32_t *triangle, int32_t count, void *colour, uint8_t *mask,
                                  uint32_t *tested);
gn_colour_shader gn_colour_row;

/* The pair of a triangle, from the worker's cache; the pixels of a row that see a surface, as gn_colour_row counts
 * them; one pixel: returns the place of the next. */
const gn_colour_pair *gn_find_pair(const gn_context *context, gn_worker *worker, uint32_t triangle);
uint32_t gn_count_seen(const gn_context *context, gn_worker *worker, const uint32_t *triangle, int32_t count,
                       uint32_t *tested);
GN_INLINE uint8_t *gn_write_pixel(uint8_t *out, uint32_t colour, uint8_t format)
{
    if (format == GN_RGB565) {
        *(uint16_t *)(void *)out = (uint16_t)colour;
        return out + 2;
    }
    out[0] = (uint8_t)colour;
    out[1] = (uint8_t)(colour >> 8);
    out[2] = (uint8_t)(colour >> 16);
    return out + 3;
}

/* gn_region.c: what a camera's begin needs by either method; check the arguments of a region's step and say where it
 * lies (*colour becomes 0 where none is wanted); colours and mask of one of its rows. */
gn_status gn_begin_regions(gn_context *context, const gn_camera *camera, int32_t *largest_w);
gn_status gn_find_region(const gn_context *context, uint32_t region, uint32_t worker, gn_phase phase, void **colour,
                         uint8_t *mask, gn_pixels *pixels, gn_window *window);
void gn_colour_region_row(const gn_context *context, gn_worker *worker, void *colour, uint8_t *mask, uint32_t row,
                          uint32_t width);

/* Render and flush every region, by a step that is known where this is inlined. */
typedef gn_status gn_region_step(gn_context *context, uint32_t region, uint32_t worker, void *colour, uint8_t *mask,
                                 gn_pixels *pixels);
GN_INLINE gn_status gn_flush_regions(gn_context *context, gn_region_step *step, gn_flush flush, void *user)
{
    gn_status status = GN_OK;
    for (uint32_t i = 0; status == GN_OK && i < context->plan.camera_regions; i++) {
        gn_pixels pixels;
        status = step(context, i, 0, context->colour_buffer, context->mask_buffer, &pixels);
        if (status == GN_OK && flush(user, &pixels))
            status = GN_STOPPED;
    }
    return status;
}

/* gn_visibility.c, gn_bins.c: depth and triangle for a region, from the triangles in its bins. */
void gn_rasterise_region(gn_context *context, gn_worker *worker, const gn_window *window);
gn_status gn_make_bins(gn_context *context, const gn_view *view);
void gn_count_bins(const gn_plan *plan, const gn_settings *settings, uint32_t *bands, uint32_t *levels, uint32_t *bins);

#endif
