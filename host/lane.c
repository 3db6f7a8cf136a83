#include "lane.h"

#include "choices.h"
#include "memory.h"
#include "render_options.h"
#include "settings_report.h"
#include "status.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#ifndef LANE_COUNTS
#define LANE_COUNTS 0
#endif
#if LANE_COUNTS
#include "lane_counter.h"
__thread uint64_t lane_counters[LANE_COUNTERS];
enum { COUNTERS_ARE_KINDS = 1 / (LANE_COUNTERS == (int)LANE_OPERATIONS) }; /* no constant where they are not */
#endif

/* ---- settings -------------------------------------------------------------------------------------------------- */

static int check_edges(const packed_scene *packed, problem *why)
{
    for (uint32_t i = 0; i < packed->mesh_count; i++)
        if (!packed->meshes[i].edges)
            return problem_of_usage(why, "mesh %u has no edges; expected them to be made before", (unsigned)i);
    return 0;
}

/* What packed->settings point to belongs to the program's own core, or to nobody where they were packed. */
static int read_settings(gn_settings *settings, const packed_scene *packed, const char *const values[], problem *why)
{
    packed_scene own = *packed;
    const gn_settings *sizes = &packed->settings;
    own.has_method = 0;
    own.settings = gn_default_settings(sizes->width, sizes->height, sizes->map_width);
    own.settings.map_height = sizes->map_height;
    own.settings.faces = packed->light.kind == GN_POINT ? &gn_six_faces : 0;
    if (!values[RENDER_METHOD])
        return problem_of_usage(why, "no method; expected a lane to be told one");
    if (check_edges(packed, why) || render_options_read(settings, &own, values, why))
        return -1;
    settings->format = GN_RGB565;
    return 0;
}

static int plan_here(gn_plan *plan, const packed_scene *packed, const char *const values[], problem *why)
{
    gn_settings settings;
    if (read_settings(&settings, packed, values, why))
        return -1;
    gn_status status = gn_make_plan(plan, &packed->scene, &settings);
    return status == GN_OK ? 0 : problem_of_usage(why, "the core refuses the scene: %s", status_text(status));
}

static int plan(gn_plan *plan, const packed_scene *packed, const char *const values[], problem *why)
{
    const lane *firmware = lane_of_firmware(GN_DEPTH_BITS);
    return (firmware && firmware != &lane_here ? firmware->plan : plan_here)(plan, packed, values, why);
}

/* ---- frames ---------------------------------------------------------------------------------------------------- */

typedef struct job {
    const packed_scene *packed;
    gn_settings settings;
    gn_context *context;
    void *memory;
    uint8_t *mask; /* of the whole image; 0: pixels are not kept */
} job;

static int open_job(job *j, const packed_scene *packed, const gn_settings *settings, problem *why)
{
    gn_plan plan;
    *j = (job){.packed = packed, .settings = *settings};
    gn_status status = gn_make_plan(&plan, &packed->scene, settings);
    if (status == GN_OK) {
        j->memory = memory_take(plan.bytes / GN_ALIGNMENT + 1, GN_ALIGNMENT);
        status = gn_init(&j->context, &packed->scene, settings, j->memory, plan.bytes);
    }
    return status == GN_OK ? 0 : problem_of_usage(why, "the core cannot start: %s", status_text(status));
}

/* A firmware would send them to its display. */
static int take_pixels(void *user, const gn_pixels *p)
{
    const job *j = user;
    for (size_t y = 0; j->mask && y < p->height; y++)
        memcpy(j->mask + (p->y + y) * j->settings.width + p->x, p->mask + y * p->width, p->width);
    return 0;
}

static gn_status view_pass(job *j)
{
    const packed_scene *packed = j->packed;
    return choices_use_view(&j->settings) ? gn_view_pass(j->context, &packed->camera, &packed->light) : GN_OK;
}

static gn_status light_pass(job *j)
{
    const gn_light *light = &j->packed->light;
    if (j->settings.shadow == GN_SHADOW_VOLUMES)
        return gn_volumes_light(j->context, light);
    if (light->kind != GN_POINT)
        return gn_light_pass(j->context, light);
    return choices_have_one_face(&j->settings) ? GN_OK : gn_light_faces(j->context, light);
}

static gn_status camera_pass(job *j)
{
    const packed_scene *packed = j->packed;
    if (j->settings.shadow == GN_SHADOW_VOLUMES)
        return gn_volumes_pass(j->context, &packed->camera, take_pixels, j);
    if (packed->light.kind == GN_POINT && choices_have_one_face(&j->settings))
        return gn_point_pass(j->context, &packed->light, &packed->camera, take_pixels, j);
    return gn_camera_pass(j->context, &packed->camera, take_pixels, j);
}

static const struct {
    gn_status (*run)(job *j);
    const char *name;
} passes[LANE_PASSES] = {{view_pass, "view"}, {light_pass, "light"}, {camera_pass, "camera"}};

static int is_left_out(const job *j, int pass)
{
    return (pass == LANE_VIEW && !choices_use_view(&j->settings)) ||
           (pass == LANE_LIGHT && choices_have_one_face(&j->settings));
}

static int refused(const job *j, gn_status status, const char *pass, problem *why)
{
    if (status == GN_UNSUPPORTED && j->packed->light.kind == GN_POINT)
        return problem_of_usage(why, "a map of %d x %d is too small for a point light; expected a larger one",
                                j->settings.map_width, j->settings.map_height);
    return problem_of_usage(why, "the %s pass failed: %s (status %d)", pass, status_text(status), (int)status);
}

/* Seconds that this thread was at work: other threads of the machine do not count. */
static double thread_clock(void)
{
    struct timespec now;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

/* A frame; f: its times, where they are less than those before, and its operations. */
static int render_frame(lane_frame *f, job *j, int first, problem *why)
{
    for (int pass = 0; pass < LANE_PASSES; pass++) {
        if (is_left_out(j, pass))
            continue;
#if LANE_COUNTS
        memset(lane_counters, 0, sizeof lane_counters);
#endif
        double start = thread_clock();
        gn_status status = passes[pass].run(j);
        double seconds = thread_clock() - start;
        if (status != GN_OK)
            return refused(j, status, passes[pass].name, why);
        if (first || seconds < f->seconds[pass])
            f->seconds[pass] = seconds;
#if LANE_COUNTS
        memcpy(f->operations[pass], lane_counters, sizeof lane_counters);
#endif
    }
    return 0;
}

static int render_counted(lane_frame *f, const packed_scene *packed, const gn_settings *settings, int runs,
                          problem *why)
{
    job j;
    int result = open_job(&j, packed, settings, why);
    for (int run = 0; run < runs && !result; run++) {
        result = render_frame(f, &j, run == 0, why);
        if (!result && run == 0) /* sums since the start */
            gn_get_statistics(j.context, &f->statistics);
    }
    free(j.memory);
    return result;
}

static int render_mask(lane_frame *f, const packed_scene *packed, const gn_settings *settings, problem *why)
{
    job j;
    lane_frame unused;
    gn_settings masked = *settings;
    masked.format = GN_NO_COLOUR;
    masked.mask = 1;
    int result = open_job(&j, packed, &masked, why);
    j.mask = f->mask = memory_take(f->height, f->width);
    if (!result)
        result = render_frame(&unused, &j, 1, why);
    free(j.memory);
    return result;
}

static void write_settings(lane_frame *f, const gn_settings *settings, int scale)
{
    if (settings->shadow == GN_SHADOW_VOLUMES) {
        snprintf(f->settings, sizeof f->settings, "shadow volumes");
        return;
    }
    FILE *text = fmemopen(f->settings, sizeof f->settings, "w");
    if (text) {
        settings_report_text(text, settings, &f->plan, scale);
        fclose(text);
    }
}

/* 0, or -1 and nothing to free. */
static int begin(lane_frame *f, gn_settings *settings, const packed_scene *packed, const char *const values[],
                 problem *why)
{
    memset(f, 0, sizeof *f);
    if (read_settings(settings, packed, values, why) || plan(&f->plan, packed, values, why))
        return -1;
    f->width = settings->width;
    f->height = settings->height;
    write_settings(f, settings, packed->scale);
    return 0;
}

static int measure(lane_frame *f, const packed_scene *packed, const char *const values[], int runs, problem *why)
{
    gn_settings settings;
    return begin(f, &settings, packed, values, why) || render_counted(f, packed, &settings, runs, why) ? -1 : 0;
}

static int render(lane_frame *f, const packed_scene *packed, const char *const values[], int runs, problem *why)
{
    gn_settings settings;
    if (begin(f, &settings, packed, values, why))
        return -1;
    if ((!runs || !render_counted(f, packed, &settings, runs, why)) && !render_mask(f, packed, &settings, why))
        return 0;
    lane_frame_free(f);
    return -1;
}

const lane lane_here = {GN_DEPTH_BITS, LANE_COUNTS, render, measure, plan};
