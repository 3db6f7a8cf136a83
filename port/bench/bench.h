/* What the cases of bench.c and edges.c share: a scene, a light, a camera, and a pass between the marks. */
#ifndef BENCH_H
#define BENCH_H

#include "gnomon.h"

enum { VIEWS = 5, TESTS = 16, GOLDEN_SCENES = 6, LSHAPE = 0, PINS = 4 };

enum {
    MAP = 320,
    TEXEL = 4096,           /* world units */
    HALF = MAP / 2 * TEXEL, /* the map covers +-HALF in x and y */
    DEPTH = 1 << 20,        /* and +-DEPTH in z; the light looks along -z */
    QUADS = 8
};

#define COUNT(array) (sizeof(array) / sizeof *(array))

/* count_plugin.c counts between them. */
void mark_begin(void);
void mark_end(void);

extern gn_context *context;
void require(int condition, const char *what);
void write_case(const char *name, const char *suffix, uint32_t number);

extern const gn_rgb grey;
gn_scene scene_of(const gn_object *objects, uint32_t count);
void prepare(const gn_scene *scene, const gn_settings *settings, gn_plan *plan);

/* ---- light pass ---- */

extern const uint16_t quad_indices[2][3]; /* of corners 0 1 2 and 0 2 3 */

void light_along_minus_z(gn_light *light);
gn_settings light_settings(gn_surface surface);
void measure_light_pass_of(const gn_scene *scene, const gn_settings *settings, const gn_light *light);
void measure_light_pass(const gn_scene *scene, const gn_settings *settings);

/* ---- camera pass ---- */

extern const int32_t receiver[4][3];

typedef struct view {
    const char *name;
    int orthographic, spot;
    gn_format format;
} view;

extern const view views[VIEWS];

/* What a pixel is compared with and how, over second depth, or what goes with a bias. */
typedef struct test {
    const char *name; /* between hyphens */
    gn_surface surface;
    const gn_receiver *receiver;
    const gn_reconstruction *reconstruction;
} test;

extern const test tests[TESTS];

typedef struct golden_scene {
    const char *name;
    const gn_scene *scene;
    const gn_camera *camera;
    const gn_light *light;
} golden_scene;

extern const golden_scene golden[GOLDEN_SCENES];

void set_up_view(const view *v, const gn_scene *scene, gn_camera *camera, gn_light *light);
gn_settings room_settings(const view *v, uint16_t width, uint32_t bias_texels);
int discard(void *user, const gn_pixels *p);

/* The pixels of a whole view, in lit and shadowed. */
extern uint32_t lit, shadowed;
void look_at_view(const gn_scene *scene, const gn_settings *settings, const gn_camera *camera, const gn_light *light);
void measure_camera_pass(const gn_scene *scene, const gn_settings *settings, const gn_camera *camera,
                         const gn_light *light);

extern const gn_object room[2];

/* ---- edges.c ---- */

void measure_planes(const char *name, const view *v);
void measure_silhouette_maps(void);
void measure_volumes(void);

/* ---- warps.c ---- */

void measure_warps(void);

/* ---- casters.c ---- */

void measure_casters(void);

#endif
