/* gnomon: hard and filtered shadows in integer arithmetic, for machines without a GPU and often without an FPU.
 *
 * Synopsis (the whole of it: a scene in, shadowed pixels out):
 *
 *     #include "gnomon.h"
 *
 *     static int flush(void *user, const gn_pixels *p)       // send p->width x p->height pixels to the display
 *     { display_write(p->x, p->y, p->width, p->height, p->colour); (void)user; return 0; }
 *
 *     static uint64_t memory[12 * 1024];                      // gn_plan says how many bytes are needed
 *
 *     gn_settings settings = gn_default_settings(320, 240, 128);
 *     gn_plan plan;
 *     gn_context *context;
 *     gn_camera camera;
 *     gn_light light;
 *     if (gn_make_plan(&plan, &scene, &settings) != GN_OK || plan.bytes > sizeof memory) return 1;
 *     gn_init(&context, &scene, &settings, memory, sizeof memory);
 *     gn_look_at(&camera, eye, target, up);
 *     gn_perspective(&camera, GN_DEGREES(40), near, far);
 *     gn_directional_light(&light, direction, 0);
 *     gn_fit_light(&light, &scene);
 *     gn_light_pass(context, &light);                         // once for a light and casters that stand still
 *     gn_camera_pass(context, &camera, flush, 0);             // as often as the camera moves
 *
 * No heap, no float, no globals, no recursion; of libc only memcpy and memset, which compilers call by themselves.
 * Scenes and meshes are const and may stay in flash. Number formats, ranges and error bounds: docs/number-formats.md.
 * Version policy: GN_BITS_VERSION changes whenever a pixel or a map value of any scene changes.
 */
#ifndef GNOMON_H
#define GNOMON_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#define GN_VERSION "0.1.0"
#define GN_BITS_VERSION 3

/* Bits of a stored depth, 16 or 32: trades map memory against depth resolution. 16-bit layers are the upper half of
 * the 32-bit ones, bit for bit (but for GN_MIXED, which marks the lowest bit). The library and its users must be
 * compiled with the same value. */
#ifndef GN_DEPTH_BITS
#define GN_DEPTH_BITS 16
#endif
#if GN_DEPTH_BITS == 16
typedef uint16_t gn_depth;
#elif GN_DEPTH_BITS == 32
typedef uint32_t gn_depth;
#else
#error "GN_DEPTH_BITS must be 16 or 32"
#endif

/* 1: count triangles, texels and pixels (a few additions a span); 0: gn_get_statistics reports zeros but for map_bytes
 * and silhouette_edges, at no cost. */
#ifndef GN_STATISTICS
#define GN_STATISTICS 0
#endif

/* ---- status codes ---------------------------------------------------------------------------------------------- */

typedef enum gn_status {
    GN_OK = 0,
    GN_STOPPED = -1,      /* the flush callback asked to stop: the frame is incomplete, the context still good */
    GN_BAD_ARGUMENT = -2, /* a null pointer, an unknown enumerator, a region or worker that does not exist */
    GN_OUT_OF_RANGE = -3, /* a number outside the range that its comment states */
    GN_TOO_SMALL = -4,    /* the memory block is smaller than gn_plan.bytes */
    GN_MISALIGNED = -5,   /* the memory block is not aligned to GN_ALIGNMENT */
    GN_BAD_MESH = -6,     /* an index beyond the vertices, an index size other than 2 and 4, or wrong edges */
    GN_TOO_MANY = -7,     /* objects x triangles do not fit 32-bit identifiers, or a size overflows */
    GN_UNSUPPORTED = -8,  /* settings that make no sense together */
    GN_NOT_READY = -9     /* called out of order, for instance a camera region before gn_camera_begin */
} gn_status;

/* ---- numbers --------------------------------------------------------------------------------------------------- */

typedef int32_t gn_q2_30;  /* signed, 30 fraction bits: components of unit vectors */
typedef int32_t gn_q16_16; /* signed, 16 fraction bits */
typedef uint32_t gn_q8_24; /* unsigned, 24 fraction bits: tangents, up to 128 */
typedef uint32_t gn_angle; /* 2^32 is a full turn */

/* Whole degrees (0 to 359) as a gn_angle, rounded to nearest. */
#define GN_DEGREES(d) ((gn_angle)((((uint64_t)(d) << 32) + 180u) / 360u))

/* World coordinates are integers in a unit that the caller chooses. Vertices (after the model matrix) must lie within
 * +-GN_WORLD_MAX, eyes, targets and light positions within +-GN_EYE_MAX. Use as much of the range as the scene allows.
 */
#define GN_WORLD_MAX ((int32_t)1 << 24)
#define GN_EYE_MAX ((int32_t)1 << 27)
#define GN_MAX_SIZE 4096 /* of maps and images, each side */

typedef struct gn_rgb {
    uint8_t r, g, b;
} gn_rgb;

/* ---- the scene (const, may be in flash) ------------------------------------------------------------------------ */

/* An edge and the triangles on it, as half-edges: 3 triangle + corner runs from that corner to the triangle's next one.
 * half[1]: the other triangle's, with GN_SAME_DIRECTION added where both run the same way (two triangles of opposite
 * winding); GN_NO_HALF_EDGE where there is none. Every half-edge of a mesh stands in exactly one edge, but those of
 * triangles with two corners in one place, which may be left out; an edge of more than two triangles is several pairs.
 * Half-edges are paired by the places of their ends, not by the numbers of the vertices. */
typedef struct gn_mesh_edge {
    uint32_t half[2];
} gn_mesh_edge;

#define GN_NO_HALF_EDGE 0xffffffffu
#define GN_SAME_DIRECTION 0x80000000u

/* Triangles over shared vertices. closed: counter-clockwise from outside, every edge used equally often in both
 * directions; may be culled in the light pass. Not closed: two-sided, never culled. */
typedef struct gn_mesh {
    const int32_t (*vertices)[3]; /* model coordinates, |v| <= GN_WORLD_MAX */
    const void *indices;          /* three a triangle, uint16_t or uint32_t, aligned to their size */
    uint32_t vertex_count;
    uint32_t triangle_count;
    uint8_t index_size;        /* 2 or 4 bytes */
    uint8_t closed;            /* 0 or 1 */
    const gn_mesh_edge *edges; /* for shadow volumes and silhouette maps, made by `gnomon pack --edges`; else 0 */
    uint32_t edge_count;
} gn_mesh;

/* world = floor((m v + 2^(shift-1)) / 2^shift) + t: |m| <= 2^30, shift 0..62, t in world units. A negative determinant
 * mirrors the mesh; its facing is mirrored with it. */
typedef struct gn_model {
    int32_t m[3][3];
    int32_t t[3]; /* |t| <= 2^30 */
    uint8_t shift;
} gn_model;

typedef struct gn_object {
    const gn_mesh *mesh;
    const gn_model *model; /* 0: identity. May change between passes (animation) */
    gn_rgb colour;
} gn_object;

typedef struct gn_scene {
    const gn_object *objects;
    uint32_t object_count;
    gn_rgb background; /* of pixels that see no surface */
    uint16_t ambient;  /* fraction of 65535: colour = c (ambient + (1 - ambient) max(N.L, 0) lit), rounded half up */
} gn_scene;

/* ---- cameras and lights ---------------------------------------------------------------------------------------- */

typedef enum gn_projection { GN_PERSPECTIVE = 0, GN_ORTHOGRAPHIC = 1 } gn_projection;

typedef struct gn_camera {
    uint8_t projection; /* gn_projection */
    int32_t eye[3];
    gn_q2_30 right[3], up[3], forward[3]; /* orthonormal; right x up = -forward */
    gn_q8_24 tan_half;                    /* perspective: tan(fovy/2), 2^-8 to 64 */
    int32_t half_height;                  /* orthographic: half the height of the image, world units, 1 to 2^26 */
    /* Planes along forward; they clip. Perspective: 0 < near < far <= 2^28, far / near <= 2^20, and near at least
     * 16 / min(1, tan x, tan y) units with the eye within GN_WORLD_MAX, more in proportion to a farther eye.
     * Orthographic: -2^28 <= near, near + 64 <= far <= 2^28. */
    int32_t near_depth, far_depth;
} gn_camera;

typedef enum gn_light_kind { GN_DIRECTIONAL = 0, GN_SPOT = 1, GN_POINT = 2 } gn_light_kind;

typedef struct gn_light {
    uint8_t kind;                         /* gn_light_kind */
    gn_q2_30 right[3], up[3], forward[3]; /* forward: the way light travels */
    /* directional: the box that the map covers, in world units along right (u), up (v) and forward (z) */
    int32_t box_u, box_v, box_z;              /* smallest u, smallest v, smallest z; |.| <= 2^28 */
    int32_t box_width, box_height, box_depth; /* 64 to 2^28 */
    /* spot: a square frustum; point: six of 90 degrees, without axes */
    int32_t position[3];
    gn_q8_24 tan_half;             /* spot: tan(fovy/2), 2^-8 to 64 */
    int32_t near_depth, far_depth; /* as in gn_camera, perspective, and far / (far - near) < 2^10 */
} gn_light;

/* Set eye and axes of a camera that looks from eye to target. Touches nothing else of *camera.
 * eye, target: |.| <= GN_EYE_MAX; up: any vector not parallel to the view, |.| <= GN_EYE_MAX.
 * GN_OUT_OF_RANGE: eye equals target, up is parallel to the view, or a coordinate is too large. */
gn_status gn_look_at(gn_camera *camera, const int32_t eye[3], const int32_t target[3], const int32_t up[3]);

/* Make the camera perspective. fovy: full vertical angle, 1/2 to 178 degrees; near and far as in gn_camera; their ratio
 * and the least near plane, which depends on the eye, are checked by the passes. GN_OUT_OF_RANGE: an angle or depth. */
gn_status gn_perspective(gn_camera *camera, gn_angle fovy, int32_t near_depth, int32_t far_depth);

/* Make the camera orthographic; ranges as in gn_camera. GN_OUT_OF_RANGE: a number outside its range. */
gn_status gn_orthographic(gn_camera *camera, int32_t half_height, int32_t near_depth, int32_t far_depth);

/* Make a directional light. direction: the way light travels, any length, |.| <= GN_EYE_MAX; up: 0 for the default,
 * which is +y, or +z where |y| of the direction exceeds 0.999. The box is left empty: gn_fit_light sets it. */
gn_status gn_directional_light(gn_light *light, const int32_t direction[3], const int32_t up[3]);

/* Fit the box of a directional light to all vertices of the scene: width = height = 1.02 x the larger extent in u and
 * v about the centre, depth 1.02 x the extent in z, at
 * least 1/256 of the width. A firmware whose casters move may set a larger box itself; points
 * outside the box are lit. Reads every vertex. GN_OUT_OF_RANGE: a vertex beyond GN_WORLD_MAX or a bad model;
 * GN_BAD_ARGUMENT: null pointers. */
gn_status gn_fit_light(gn_light *light, const gn_scene *scene);

/* Make a spot light. Up as for gn_directional_light. fovy: full angle, 1/2 to 178 degrees.
 * GN_OUT_OF_RANGE: a coordinate, angle or depth outside its range, or target equal to position. */
gn_status gn_spot_light(gn_light *light, const int32_t position[3], const int32_t target[3], const int32_t up[3],
                        gn_angle fovy, int32_t near_depth, int32_t far_depth);

/* Make a point light. It lights what lies between two cubes about it, near <= max(|x|, |y|, |z|) <= far, and what is
 * within the inner one casts no shadow. Such lights need settings.faces.
 * GN_OUT_OF_RANGE: a coordinate or depth outside its range. */
gn_status gn_point_light(gn_light *light, const int32_t position[3], int32_t near_depth, int32_t far_depth);

/* Build a model matrix: start with identity; each call acts after what is there already. A scale of 0 flattens; the
 * axis is any vector but 0. Written only on GN_OK. Error of one call: 2^-27 of the matrix. */
void gn_model_identity(gn_model *model);
gn_status gn_model_scale(gn_model *model, gn_q16_16 x, gn_q16_16 y, gn_q16_16 z);
gn_status gn_model_rotate(gn_model *model, const int32_t axis[3], gn_angle angle); /* right-handed about axis */
gn_status gn_model_translate(gn_model *model, int32_t x, int32_t y, int32_t z);

/* Sine and cosine, |error| <= 2^-29; the angle's unit is 2^-32 turns. */
gn_q2_30 gn_sine(gn_angle angle);
gn_q2_30 gn_cosine(gn_angle angle);

/* ---- settings: the choices of docs/design.md ------------------------------------------------------------------- */

/* How a pixel learns whether it is shadowed. */
typedef enum gn_shadow {
    GN_SHADOW_MAP = 0, /* gn_light_pass, gn_camera_pass */
    GN_SHADOW_VOLUMES  /* exact at every sample, no map: gn_volumes_light, gn_volumes_pass; meshes with edges */
} gn_shadow;

typedef enum gn_cull { GN_CULL_AUTO = 0, GN_CULL_NONE, GN_CULL_BACK, GN_CULL_FRONT } gn_cull;
typedef enum gn_layers { GN_LAYERS_AUTO = 0, GN_LAYERS_FIRST, GN_LAYERS_TWO } gn_layers;

/* What the one map holds when the light pass is done; z1, z2: nearest and second nearest depth. */
typedef enum gn_surface {
    GN_CONSTANT = 0, /* z1 + bias */
    GN_MIDPOINT,     /* (z1 + z2) / 2                                   (Woo 1992) */
    GN_DUAL,         /* z1 + min((z2 - z1) / 2, bias)                    (Weiskopf & Ertl 2003, eq. 2) */
    GN_SECOND,       /* z2 + bias, open meshes counting twice; or z1 with front faces culled (Wang & Molnar 1994) */
    GN_MIXED,        /* z2 where the nearest layer is closed, dual where it is open */
    GN_SLOPE         /* z1 + slope (m - z1) + bias; m: least z + half a texel of its own slope, of all triangles */
} gn_surface;

/* The fit: which rectangle of the light's plane the map covers; none (0): what the light does. Linked only where named.
 * A context with a fit or a warp needs gn_view_pass before gn_light_pass. docs/parameterisations.md. */
typedef struct gn_fit gn_fit;
extern const gn_fit gn_desired_view;    /* the bounds of what the camera sees (DV: Rosen 2012) */
extern const gn_fit gn_minimal_frustum; /* the smallest rectangle about it, turned (MSF: Stamminger & Drettakis 2002) */

/* The warp: where on that rectangle the texels lie, so that more of them lie where the camera sees more; none (0):
 * evenly. Rectilinear: columns and rows of unequal width, planes stay linear (Rosen 2012). Non-orthogonal: a function
 * of its own for each row and each column (Milet et al. 2015), twice the map's texels in 16-bit numbers; with no
 * receiver or virtual samples, the nearest texel and any surface but GN_SLOPE. Texels are evaluated where they lie:
 * triangles stay straight. */
typedef struct gn_warp gn_warp;
extern const gn_warp gn_rectilinear;          /* driven by how many pixels a column or row has */
extern const gn_warp gn_rectilinear_distance; /* driven by the nearest point's distance to the eye */
extern const gn_warp gn_nonorthogonal;
/* Only triangles' corners are moved, as a GPU does it, and large triangles are wrong: for comparison. */
extern const gn_warp gn_rectilinear_vertices, gn_nonorthogonal_vertices;

/* The receiver: the depth with which a pixel is compared. Each is linked only where it is named; none (0): the depth
 * of the pixel's own point. All but that take the plane of the triangle that the pixel sees, as the light pass draws
 * it: 40 bytes an entry of GN_COLOUR_CACHE and worker. docs/shadow-test.md. */
typedef struct gn_receiver gn_receiver;
extern const gn_receiver gn_plane_bias; /* the point's depth less settings.slope times half a texel of its plane's slope
                                         */
extern const gn_receiver gn_virtual;    /* where the texels about the point disagree on its depth, the plane's depth at
                                         * the texels' centres (Wang & Molnar 1994, 3.2) */
extern const gn_receiver gn_virtual_always; /* that depth at every pixel */

/* The reconstruction: what is made of the comparisons. Each is linked only where it is named; none (0): the texel that
 * holds the point decides. Filters give a fraction of light, in 254 steps, by percentage-closer filtering (Reeves et
 * al. 1987): comparisons are weighted, never depths. Texels beyond the map are those of its border. */
typedef struct gn_reconstruction gn_reconstruction;
extern const gn_reconstruction gn_bilinear;   /* the four texels about the point, by its place between them */
extern const gn_reconstruction gn_jitter_4x4; /* 16 texels, one from each cell of 4 x 4, picked by a fixed matrix */
extern const gn_reconstruction gn_box_3x3, gn_box_5x5, gn_box_7x7; /* the texels about the point's own, alike */

/* A silhouette map (Sen, Cammarano & Hanrahan 2003): hard shadows whose borders follow the silhouettes of the meshes
 * through the texels, and not the texels' sides. The light pass draws the silhouette edges of all meshes into a map of
 * one byte a texel. Meshes need edges; of one without (a triangle soup) the edges of every triangle are drawn
 * where they separate depths, at up to three tenths more error. smooth: the same borders a quarter of a texel wide, in
 * five steps of light. docs/shadow-test.md. */
extern const gn_reconstruction gn_silhouettes, gn_silhouettes_smooth;

/* A crossing map: the same end by the places where silhouettes cross the sides between texels, two to a byte, instead
 * of a point a cell. Straight borders come out straight, corners within a texel are cut off. No depths are kept while
 * it is made, and of several silhouettes the outermost stays, so meshes without edges do as well, with more work in the
 * light pass and somewhat less exact borders. docs/shadow-test.md. */
extern const gn_reconstruction gn_crossings;

/* Point lights: six maps, one a face of a cube about the light, each wider than its face by a texel or more, so that
 * filters and silhouettes go on across the cube's edges. None (0): directional and spot lights only. Linked only
 * where named. docs/point-lights.md. */
typedef struct gn_faces gn_faces;
extern const gn_faces gn_six_faces; /* six maps in memory, that stay for any number of camera passes */
extern const gn_faces gn_one_face;  /* one at a time: gn_point_pass alone. A bit, with filters a byte a pixel more */

/* Casters that stand still: the layers of the scene's first settings.static_objects objects are kept, and a light pass
 * inserts the others into them. The maps are those without it, bit for bit. None (0): every light pass draws all.
 * Linked only where named. The static objects are drawn anew when the light, one of their models or what the view pass
 * finds has changed. Maps of silhouettes and crossings are drawn every time. Not with gn_one_face. docs/design.md. */
typedef struct gn_casters gn_casters;
extern const gn_casters gn_static_casters; /* one more map in memory, of two layers two: plan.static_bytes */

typedef enum gn_bias_unit {
    GN_BIAS_WORLD = 0, /* whole world units along the light (spot: converted at w = sqrt(near far)) */
    GN_BIAS_TEXELS,    /* Q16.16: the depth of so many texels at 45 degrees */
    GN_BIAS_RANGE      /* Q0.32: fraction of the light's stored depth range */
} gn_bias_unit;

typedef struct gn_bias {
    uint8_t unit;   /* gn_bias_unit */
    uint32_t value; /* never negative */
} gn_bias;

typedef enum gn_format {
    GN_NO_COLOUR = 0, /* masks only */
    GN_RGB888,        /* three bytes a pixel: r, g, b */
    GN_RGB565         /* one uint16_t a pixel, native byte order; each channel rounded half up */
} gn_format;

typedef struct gn_settings {
    uint16_t width, height;         /* image, 1 to GN_MAX_SIZE */
    uint16_t map_width, map_height; /* shadow map, 1 to GN_MAX_SIZE */
    uint16_t region_width,
        region_height; /* camera regions; 0: chosen. Trades RAM (8 bytes a pixel and worker; volumes 18) against time */
    uint16_t map_rows; /* rows of a light region; 0: the whole map. Trades RAM of the second layer against time */
    uint8_t cull, layers, surface; /* gn_cull, gn_layers, gn_surface */
    uint8_t format;                /* gn_format */
    uint8_t mask;                  /* 1: also deliver masks: 0 shadowed ... 254 lit, 255 no surface */
    uint8_t workers;               /* how many regions may be rendered at once, 1 to 64 */
    uint8_t shadow;  /* gn_shadow; with volumes map sizes, cull, layers, surface and bias are checked and say nothing */
    gn_bias bias;    /* of all surfaces but GN_MIDPOINT */
    gn_q16_16 slope; /* of GN_SLOPE and gn_plane_bias: 0 to 64 */
    const gn_receiver *receiver;             /* 0: the point. Says nothing with volumes */
    const gn_reconstruction *reconstruction; /* 0: the nearest texel. The same */
    const gn_fit *fit;                       /* 0: the light's own box or frustum. The same */
    const gn_warp *warp;                     /* 0: texels of one size. The same */
    gn_q16_16 smoothing;                     /* of warps: times the usual window; 1/64 to 64, 0: 1 */
    uint8_t fit_depth;         /* 1: with a fit of directional lights, stored depths span what the camera sees; what is
                                * nearer to the light is taken to be at the near end. More depth resolution. Says nothing
                                * without a fit or with a spot light, whose depths are good where they are near */
    const gn_faces *faces;     /* for point lights, else 0. Says nothing with volumes */
    const gn_casters *casters; /* 0: all may move. Says nothing with volumes */
    uint32_t static_objects;   /* of gn_static_casters: so many objects from the first on stand still, mostly */
} gn_settings;

/* Second depth, the point, the nearest texel, everything else left to gn_make_plan and no bias: the least that a scene
 * of closed meshes needs. With settings.receiver = &gn_virtual it is Wang & Molnar's. */
gn_settings gn_default_settings(uint16_t width, uint16_t height, uint16_t map_size);

typedef struct gn_plan {
    size_t bytes;                 /* of the whole block: the maximum of the passes */
    size_t map_bytes;             /* of it: the shadow map or six, which stay between the passes */
    size_t silhouette_bytes;      /* of it: the silhouette or crossing map, which stays as well; 0 without */
    size_t light_bytes;           /* needed during the light pass, map included */
    size_t camera_bytes;          /* needed during the camera pass, map included */
    size_t view_bytes;            /* needed during the view pass, which has no map; 0 without one */
    size_t warp_bytes;            /* of the block: where the texels lie, which stays between the passes; 0 without */
    size_t static_bytes;          /* of the block: what gn_static_casters keeps; 0 without */
    uint32_t triangles, vertices; /* of all objects; a mesh used twice counts twice */
    uint32_t edges;               /* the same; 0 where meshes have none */
    uint32_t light_regions, camera_regions;
    uint16_t region_width, region_height, map_rows; /* as chosen */
    uint8_t cull, layers;                           /* as chosen: never AUTO */
    uint8_t view_rounds;                            /* of the view pass: 0 without, up to 3 */
} gn_plan;

#define GN_ALIGNMENT 8

typedef struct gn_context gn_context;

/* Say what the scene needs, and check every mesh (indices, ranges); nothing is written but *plan. GN_UNSUPPORTED:
 * settings that make no sense together, volumes and a mesh without edges, a receiver or
 * a reconstruction and a map that is less than 2 texels wide or high, or static casters and gn_one_face.
 * GN_OUT_OF_RANGE: also, more static objects than there are. GN_BAD_MESH: also, with silhouettes or crossings, edges
 * that do not exist, join nothing, or are too few or too many. */
gn_status gn_make_plan(gn_plan *plan, const gn_scene *scene, const gn_settings *settings);

/* Take the block; the scene (not the settings) must outlive the context. Nothing outside the block is ever written.
 * GN_TOO_SMALL, GN_MISALIGNED, or what gn_make_plan returns. */
gn_status gn_init(gn_context **context, const gn_scene *scene, const gn_settings *settings, void *memory, size_t bytes);

/* ---- view pass (settings.fit, settings.warp) --------------------------------------------------------------------- */

/* See what the camera sees from the light: visibility region by region, each visible point's place on the light's
 * plane, and from all of them the fit and the warp, for the light passes that follow. No image is kept. light: that of
 * the light pass. To be done anew when camera, light or models have moved; the shadow map is lost. Points that the
 * camera of another pass sees beyond the fit are lit, with spot lights unlit.
 * GN_UNSUPPORTED: neither fit nor warp, or shadow volumes; GN_OUT_OF_RANGE: as for gn_light_pass and gn_camera_pass. */
gn_status gn_view_pass(gn_context *context, const gn_camera *camera, const gn_light *light);

/* The same in steps: begin; then plan.view_rounds times: all camera regions, in any order, on any worker, and end,
 * which ends the round. GN_NOT_READY: out of this order; GN_BAD_ARGUMENT: no such region or worker. */
gn_status gn_view_begin(gn_context *context, const gn_camera *camera, const gn_light *light);
gn_status gn_view_region(gn_context *context, uint32_t region, uint32_t worker);
gn_status gn_view_end(gn_context *context);

/* The rectangle of the light's plane that the map covers, after a view pass. The plane is the light's box or frustum,
 * places count from its upper left corner in 2^-30 of its larger side, x to the right, y down. gn_get_rectangle:
 * GN_UNSUPPORTED: neither fit nor warp; GN_NOT_READY: no view pass yet. */
typedef struct gn_rectangle {
    gn_q2_30 cosine, sine; /* of the angle from x to the rectangle's rows */
    int32_t low[2];        /* least x cosine + y sine, and least y cosine - x sine */
    int32_t size[2];
} gn_rectangle;
gn_status gn_get_rectangle(const gn_context *context, gn_rectangle *rectangle);

/* Where the centre of a texel lies in that rectangle: from its upper left corner, in 2^-32 of its sides. Without a
 * warp the centre of a uniform map's. 0: no such texel. */
int gn_texel_place(const gn_context *context, uint32_t column, uint32_t row, uint32_t place[2]);

/* ---- light pass ------------------------------------------------------------------------------------------------ */

/* Render the shadow map. It stays valid for any number of camera passes.
 * GN_OUT_OF_RANGE: the light or a model is outside its ranges, a vertex beyond GN_WORLD_MAX, or the scene more than
 * 8192 times as deep as the light's box. GN_UNSUPPORTED: a point light.
 * GN_NOT_READY: a fit or a warp, and no view pass. */
gn_status gn_light_pass(gn_context *context, const gn_light *light);

/* The same in steps: begin; then for every region in any order, on any worker (0 .. workers-1, each used by one thread
 * at a time): layers, then resolve. Regions are independent jobs; all must be done before gn_camera_begin, which ends
 * the light pass. GN_NOT_READY: out of this order; GN_BAD_ARGUMENT: no such region or worker. */
gn_status gn_light_begin(gn_context *context, const gn_light *light);
gn_status gn_light_layers(gn_context *context, uint32_t region, uint32_t worker);
gn_status gn_light_resolve(gn_context *context, uint32_t region, uint32_t worker);

/* The light pass of a point light with gn_six_faces, in place of gn_light_pass: every face that a caster reaches. The
 * camera pass is that of the other lights.
 * GN_BAD_ARGUMENT: not a point light; GN_UNSUPPORTED: settings.faces is not &gn_six_faces, shadow volumes, a fit or a
 * warp, or a map too small for its border; GN_OUT_OF_RANGE: as for gn_light_pass. */
gn_status gn_light_faces(gn_context *context, const gn_light *light);

/* The same in steps: for each of the faces 0 to 5 (towards +x, -x, +y, -y, +z, -z), in any order, this in place of
 * gn_light_begin; then the regions. *regions: plan.light_regions, or 0 where no caster reaches the face: then it is
 * done. Faces stay while the light stands still; where one caster moves, those that it leaves, enters or crosses are
 * enough. Until the camera pass gn_layer and the map of silhouettes or crossings are those of the latest face. */
gn_status gn_light_face(gn_context *context, const gn_light *light, uint32_t face, uint32_t *regions);

/* Between layers and resolve: the first (0) or second (1; of GN_SLOPE: m) layer of the region on that worker, after
 * resolve (0): the map. Row i of the region starts at index i * *stride. 0 if there is no such layer. GN_MIXED marks
 * open texels in the lowest bit. */
const gn_depth *gn_layer(const gn_context *context, uint32_t layer, uint32_t region, uint32_t worker,
                         uint32_t *first_row, uint32_t *rows, uint32_t *stride);

/* After the light pass with gn_silhouettes: a byte a cell. Cell (column, row), at row * *stride + column, lies between
 * the centres of texels (column, row) and (column + 1, row + 1). Low 4 bits: x, high 4 bits: y of a point of the
 * silhouette that passes through it, in 1/16 texel from the cell's upper left corner; 0x88, the centre, where there is
 * none. Cells that are not between four texels (the last column and the last row) hold 0x88. 0 without, and before the
 * first light pass. */
const uint8_t *gn_silhouette_map(const gn_context *context, uint32_t *stride);

/* After the light pass with gn_crossings: a byte a texel, texel (column, row) at row * *stride + column. Low 4 bits:
 * where a silhouette crosses the way from the texel's centre to the centre of the next texel to the right, high 4 bits:
 * to the one below, in 1/16 of the way, 1 to 15; 0: nowhere, which is read as 8. There is nothing beyond the last
 * column and the last row: 0. 0 without, and before the first light pass. */
const uint8_t *gn_crossing_map(const gn_context *context, uint32_t *stride);

/* ---- camera pass ----------------------------------------------------------------------------------------------- */

typedef struct gn_pixels {
    uint16_t x, y, width, height; /* place in the image; rows are packed, width pixels each */
    const void *colour;           /* gn_format; 0 with GN_NO_COLOUR */
    const uint8_t *mask;          /* 0 unless settings.mask */
} gn_pixels;

/* Called once a region. Return 0 to go on, anything else to stop the frame (GN_STOPPED). */
typedef int (*gn_flush)(void *user, const gn_pixels *pixels);

/* Render the image, region by region, left to right and top to bottom, each into the same buffer of the context.
 * GN_NOT_READY: no complete light pass; GN_OUT_OF_RANGE: as for gn_light_pass, of the camera; GN_STOPPED. */
gn_status gn_camera_pass(gn_context *context, const gn_camera *camera, gn_flush flush, void *user);

/* The same in steps, for an RTOS or double-buffered DMA: begin once; then each region, in any order, on any worker,
 * into colour and mask buffers of the caller (plan.region_width x plan.region_height pixels; 0: not wanted; RGB565:
 * aligned to 2 bytes, else GN_MISALIGNED). Describes what was rendered in *pixels. */
gn_status gn_camera_begin(gn_context *context, const gn_camera *camera);
gn_status gn_camera_region(gn_context *context, uint32_t region, uint32_t worker, void *colour, uint8_t *mask,
                           gn_pixels *pixels);

/* ---- point lights in one pass (settings.faces) ------------------------------------------------------------------- */

/* Light pass and camera pass of a point light in one, for a light or casters that move, and the only one with
 * gn_one_face: that draws a face's map, tests all pixels that it lights, and goes on to the next. Faces without casters
 * are skipped, and faces that light nothing in view. Worker 0 does it all; no map stays. Statuses: as for gn_light_face
 * and gn_camera_pass. */
gn_status gn_point_pass(gn_context *context, const gn_light *light, const gn_camera *camera, gn_flush flush,
                        void *user);

/* ---- shadow volumes (settings.shadow GN_SHADOW_VOLUMES) ---------------------------------------------------------- */

/* In place of the light pass: decide exactly which way every triangle faces, and find the silhouette edges. To be done
 * anew whenever a model has changed; none may change before the last region of a frame is done. GN_UNSUPPORTED: the
 * context was not made for volumes (and the light and camera passes, where it was), or a point light; GN_BAD_MESH:
 * edges that do not exist, join nothing, or are too few or too many; GN_BAD_ARGUMENT, GN_OUT_OF_RANGE: as for
 * gn_light_pass. */
gn_status gn_volumes_light(gn_context *context, const gn_light *light);

/* In place of the camera pass and its steps; same arguments and statuses. A pixel is shadowed where the volumes that
 * triangles cast hold its point (Crow 1977), counted behind the point, so that the camera may stand in shadow. */
gn_status gn_volumes_pass(gn_context *context, const gn_camera *camera, gn_flush flush, void *user);
gn_status gn_volumes_begin(gn_context *context, const gn_camera *camera);
gn_status gn_volumes_region(gn_context *context, uint32_t region, uint32_t worker, void *colour, uint8_t *mask,
                            gn_pixels *pixels);

/* ---- statistics (GN_STATISTICS 1) ------------------------------------------------------------------------------ */

typedef struct gn_statistics {
    /* set up in the light pass, each region counted, with silhouettes also the row after it; covered by them */
    uint64_t light_triangles, light_texels;
    uint64_t view_samples;     /* pixels that the view passes saw on the light's plane, each once */
    uint64_t camera_triangles; /* set up in the camera pass, each region counted */
    uint64_t camera_fragments; /* covered by them */
    uint64_t pixels_shaded;    /* pixels that see a surface */
    uint64_t pixels_tested;    /* of them, turned to the light: looked up in the map, or counted in volumes */
    /* With a receiver or a reconstruction, how far down the cascade of docs/shadow-test.md: outside, agreed and virtual
     * make up pixels_tested, but for fractions and silhouettes by a point's own depth. */
    uint64_t pixels_outside;               /* of the light's box or frustum: no texel read */
    uint64_t pixels_agreed;                /* all texels agreed on the point's depth */
    uint64_t pixels_virtual;               /* decided by virtual samples */
    uint64_t pixels_fractional;            /* partly lit, by whatever samples */
    uint64_t texels_read, virtual_samples; /* depths compared in all; of them with virtual samples */
    /* decided by the silhouette or crossing map: P of Sen et al. is this over pixels_shaded */
    uint64_t pixels_silhouette;
    uint64_t silhouette_edges;  /* of the latest light pass, or gn_volumes_light */
    uint64_t silhouette_texels; /* bytes of the map that hold a point or a crossing, summed over the light passes */
    uint64_t volume_faces;      /* set up in the camera pass, each region counted */
    uint64_t volume_fragments;  /* covered by them; over camera_fragments: the overdraw factor O of Sen et al. */
    uint64_t faces_drawn, faces_skipped; /* of point lights */
    uint64_t map_bytes;
} gn_statistics;

/* Sum over all workers since gn_init. */
void gn_get_statistics(const gn_context *context, gn_statistics *statistics);

#ifdef __cplusplus
}
#endif
#endif
