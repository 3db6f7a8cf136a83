/* What a frame of each chain costs on a target: renders scenes that lie in flash, the passes between marks where
 * count_plugin.c counts instructions. Prints, of each frame,
 *
 *     plan SCENE CHAIN WxH MAP NAME N ...         what gn_make_plan said
 *     case SCENE CHAIN WxH MAP PASS               view (where there is one), light, camera, in the order of marks
 *
 * Files that include this one choose other scenes and sizes, or have most frames planned alone. */
#include "chains.h"
#include "gnomon.h"
#include "port.h"
#include "print.h"

#include <stddef.h>

#ifndef REPORT_SCENES
#include "fence.h"
#include "lshape.h"
#include "pins.h"
#include "pipes.h"
#include "table.h"
#include "torus2.h"

#define REPORT_SCENES SCENE(lshape) SCENE(torus2) SCENE(table) SCENE(pipes) SCENE(pins) SCENE(fence)
#define REPORT_SIZES                                                                                                   \
    {                                                                                                                  \
        160, 120,                                                                                                      \
        {                                                                                                              \
            64, 128                                                                                                    \
        }                                                                                                              \
    }
#endif

typedef struct packed {
    const char *name;
    const gn_scene *scene;
    const gn_camera *camera;
    const gn_light *light;
} packed;

/* 0: the frame is only planned. */
#ifndef REPORT_RENDERS
#define REPORT_RENDERS(frame, plan) 1
#endif

#define SCENE(name) {#name, &name##_scene, &name##_camera, &name##_light},
static const packed scenes[] = {REPORT_SCENES};

enum { MOST_MAPS = 4 };

typedef struct size {
    uint16_t width, height;
    uint16_t maps[MOST_MAPS]; /* up to the first 0 */
} size;

static const size sizes[] = {REPORT_SIZES};

#define COUNT(array) (sizeof(array) / sizeof *(array))

static uint64_t memory[3 * 128 * 1024];

/* One frame: what is rendered, and how. */
typedef struct frame {
    const packed *scene;
    const chain *by;
    uint16_t width, height, map;
} frame;

__attribute__((noinline)) void mark_begin(void);
__attribute__((noinline)) void mark_end(void);

void mark_begin(void)
{
    __asm__ volatile("");
}

void mark_end(void)
{
    __asm__ volatile("");
}

static void write_frame(const char *what, const frame *f)
{
    port_write(what);
    port_write(" ");
    port_write(f->scene->name);
    port_write(" ");
    port_write(f->by->name);
    port_write(" ");
    write_decimal(f->width);
    port_write("x");
    write_decimal(f->height);
    port_write(" ");
    write_decimal(f->map);
}

static void write_number(const char *name, uint64_t value)
{
    port_write(" ");
    port_write(name);
    port_write(" ");
    write_decimal((uint32_t)value);
}

static void write_plan(const frame *f, const gn_plan *p)
{
    write_frame("plan", f);
    write_number("bytes", p->bytes);
    write_number("map_bytes", p->map_bytes);
    write_number("silhouette_bytes", p->silhouette_bytes);
    write_number("warp_bytes", p->warp_bytes);
    port_write("\n");
}

static void begin(const frame *f, const char *pass)
{
    write_frame("case", f);
    port_write(" ");
    port_write(pass);
    port_write("\n");
    mark_begin();
}

static void end(const frame *f, gn_status status)
{
    mark_end();
    if (status == GN_OK)
        return;
    write_frame("error", f);
    write_number("status -", (uint64_t)(-(int)status));
    port_write("\n");
    port_exit(1);
}

static int discard(void *user, const gn_pixels *p)
{
    (void)user;
    (void)p;
    return 0;
}

static void render(const frame *f, gn_context *context, const gn_plan *plan)
{
    int volumes = f->by->shadow == GN_SHADOW_VOLUMES;
    const gn_light *light = f->scene->light;
    const gn_camera *camera = f->scene->camera;
    if (plan->view_rounds) {
        begin(f, "view");
        end(f, gn_view_pass(context, camera, light));
    }
    begin(f, "light");
    end(f, volumes ? gn_volumes_light(context, light) : gn_light_pass(context, light));
    begin(f, "camera");
    end(f, volumes ? gn_volumes_pass(context, camera, discard, 0) : gn_camera_pass(context, camera, discard, 0));
}

static void report(const frame *f)
{
    gn_settings settings = chain_settings(f->by, f->width, f->height, f->map ? f->map : 1);
    gn_plan plan = {0};
    gn_context *context;
    if (gn_make_plan(&plan, f->scene->scene, &settings) != GN_OK ||
        gn_init(&context, f->scene->scene, &settings, memory, sizeof memory) != GN_OK) {
        write_frame("error", f);
        write_number("no plan or no room for bytes", plan.bytes);
        port_write("\n");
        port_exit(2);
    }
    write_plan(f, &plan);
    if (REPORT_RENDERS(f, &plan))
        render(f, context, &plan);
}

/* All maps of a chain; shadow volumes have none: 0, once. */
static void report_maps(frame *f, const size *of)
{
    f->width = of->width;
    f->height = of->height;
    f->map = 0;
    if (f->by->shadow == GN_SHADOW_VOLUMES)
        report(f);
    for (unsigned m = 0; f->by->shadow == GN_SHADOW_MAP && m < MOST_MAPS && of->maps[m]; m++) {
        f->map = of->maps[m];
        report(f);
    }
}

int main(void)
{
    for (unsigned s = 0; s < COUNT(scenes); s++)
        for (uint32_t c = 0; c < chain_count; c++)
            for (unsigned i = 0; i < COUNT(sizes); i++) {
                frame f = {&scenes[s], &chains[c], 0, 0, 0};
                report_maps(&f, &sizes[i]);
            }
    return 0;
}
