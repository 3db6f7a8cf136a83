#include "frame.h"

#include "choices.h"
#include "memory.h"
#include "status.h"

#include <pthread.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { MOST_WORKERS = 64 };

double frame_clock(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

/* ---- the queue of regions -------------------------------------------------------------------------------------- */

typedef gn_status (*job)(frame *f, uint32_t region, uint32_t worker);

typedef struct queue {
    frame *f;
    job run;
    uint32_t next, count;
    gn_status status; /* the first that is not GN_OK */
    pthread_mutex_t lock;
} queue;

typedef struct thread {
    queue *q;
    uint32_t number;
    pthread_t id;
} thread;

/* The next region, or count when all are taken or one failed. */
static uint32_t take_region(queue *q, gn_status status)
{
    pthread_mutex_lock(&q->lock);
    if (status != GN_OK && q->status == GN_OK)
        q->status = status;
    uint32_t region = q->status == GN_OK && q->next < q->count ? q->next++ : q->count;
    pthread_mutex_unlock(&q->lock);
    return region;
}

static void *work(void *user)
{
    thread *w = user;
    gn_status status = GN_OK;
    for (;;) {
        uint32_t region = take_region(w->q, status);
        if (region == w->q->count)
            return 0;
        status = w->q->run(w->q->f, region, w->number);
    }
}

/* Run all regions on the frame's workers; this thread is worker 0. A thread that cannot be started is done without. */
static gn_status run_regions(frame *f, job run, uint32_t count)
{
    queue q = {.f = f, .run = run, .count = count, .status = GN_OK};
    thread threads[MOST_WORKERS];
    uint32_t started = 1, wanted = f->settings.workers < count ? f->settings.workers : count;
    pthread_mutex_init(&q.lock, 0);
    threads[0] = (thread){.q = &q, .number = 0};
    for (; started < wanted; started++) {
        threads[started] = (thread){.q = &q, .number = started};
        if (pthread_create(&threads[started].id, 0, work, &threads[started]) != 0)
            break;
    }
    work(&threads[0]);
    for (uint32_t i = 1; i < started; i++)
        pthread_join(threads[i].id, 0);
    pthread_mutex_destroy(&q.lock);
    return q.status;
}

/* ---- passes ---------------------------------------------------------------------------------------------------- */

static void keep_rows(const frame *f, gn_depth *plane, uint32_t layer, uint32_t region, uint32_t worker)
{
    uint32_t first_row, rows, stride, width = f->settings.map_width;
    const gn_depth *from = plane ? gn_layer(f->context, layer, region, worker, &first_row, &rows, &stride) : 0;
    if (!from)
        return;
    first_row += f->face * f->settings.map_height;
    for (uint32_t y = 0; y < rows; y++)
        memcpy(plane + (size_t)(first_row + y) * width, from + (size_t)y * stride, width * sizeof *plane);
}

static gn_status run_light_region(frame *f, uint32_t region, uint32_t worker)
{
    gn_status status = gn_light_layers(f->context, region, worker);
    if (status != GN_OK)
        return status;
    if (f->keep_layers) {
        keep_rows(f, f->layers[0], 0, region, worker);
        keep_rows(f, f->layers[1], 1, region, worker);
    }
    status = gn_light_resolve(f->context, region, worker);
    if (status == GN_OK && f->keep_layers)
        keep_rows(f, f->map, 0, region, worker);
    return status;
}

static gn_status run_view_region(frame *f, uint32_t region, uint32_t worker)
{
    return gn_view_region(f->context, region, worker);
}

static void copy_region(const frame *f, const gn_pixels *p)
{
    size_t width = f->settings.width;
    for (size_t y = 0; y < p->height; y++) {
        size_t to = (p->y + y) * width + p->x, from = y * p->width;
        if (p->colour)
            memcpy(f->colour + 3 * to, (const uint8_t *)p->colour + 3 * from, 3 * (size_t)p->width);
        if (p->mask)
            memcpy(f->mask + to, p->mask + from, p->width);
    }
}

/* Regions as wide as the image go straight to their rows. */
static gn_status run_camera_region(frame *f, uint32_t region, uint32_t worker)
{
    gn_pixels pixels;
    size_t row = (size_t)region * f->plan.region_height * f->settings.width;
    gn_status (*render)(gn_context *, uint32_t, uint32_t, void *, uint8_t *, gn_pixels *) =
        f->settings.shadow == GN_SHADOW_VOLUMES ? gn_volumes_region : gn_camera_region;
    if (f->plan.region_width == f->settings.width)
        return render(f->context, region, worker, f->colour ? f->colour + 3 * row : 0, f->mask ? f->mask + row : 0,
                      &pixels);
    gn_status status = render(f->context, region, worker, f->worker_colour[worker], f->worker_mask[worker], &pixels);
    if (status == GN_OK)
        copy_region(f, &pixels);
    return status;
}

static int refused(const frame *f, gn_status status, const char *pass, problem *why)
{
    if (status == GN_OK)
        return 0;
    /* what else a point light does not take is refused before there is a frame */
    if (status == GN_UNSUPPORTED && f->light.kind == GN_POINT)
        return problem_of_usage(why,
                                "a map of %d x %d is too small for a point light; expected a border of up to 4 texels "
                                "on each side, as the reconstruction reads, and a texel more",
                                f->settings.map_width, f->settings.map_height);
    return problem_of_usage(why, "the %s pass failed: %s (status %d)", pass, status_text(status), (int)status);
}

int frame_view_pass(frame *f, const gn_camera *camera, const gn_light *light, problem *why)
{
    if (!choices_use_view(&f->settings))
        return 0;
    double start = frame_clock();
    gn_status status = gn_view_begin(f->context, camera, light);
    for (int round = 0; round < f->plan.view_rounds && status == GN_OK; round++) {
        status = run_regions(f, run_view_region, f->plan.camera_regions);
        if (status == GN_OK)
            status = gn_view_end(f->context);
    }
    if (status == GN_OK)
        status = gn_get_rectangle(f->context, &f->rectangle);
    f->view_seconds = frame_clock() - start;
    return refused(f, status, "view", why);
}

/* Of a face that no caster reaches, whose map was not drawn. */
static void keep_empty_face(frame *f)
{
    size_t texels = (size_t)f->settings.map_width * f->settings.map_height;
    gn_depth *planes[] = {f->layers[0], f->layers[1], f->map};
    for (int i = 0; i < 3; i++)
        if (planes[i])
            memset(planes[i] + f->face * texels, 0xff, texels * sizeof *planes[i]);
}

static gn_status draw_faces(frame *f)
{
    enum { FACES = 6 };
    gn_status status = GN_OK;
    for (f->face = 0; f->face < FACES && status == GN_OK; f->face++) {
        uint32_t regions = 0;
        status = gn_light_face(f->context, &f->light, f->face, &regions);
        if (status == GN_OK && !regions)
            keep_empty_face(f);
        else if (status == GN_OK)
            status = run_regions(f, run_light_region, regions);
    }
    f->face = 0;
    return status;
}

static gn_status draw_map(frame *f)
{
    gn_status status = gn_light_begin(f->context, &f->light);
    return status == GN_OK ? run_regions(f, run_light_region, f->plan.light_regions) : status;
}

int frame_light_pass(frame *f, const gn_light *light, problem *why)
{
    double start = frame_clock();
    gn_status status = GN_OK;
    f->light = *light;
    if (f->settings.shadow == GN_SHADOW_VOLUMES)
        status = gn_volumes_light(f->context, light);
    else if (light->kind != GN_POINT)
        status = draw_map(f);
    else if (!choices_have_one_face(&f->settings))
        status = draw_faces(f);
    f->light_seconds = frame_clock() - start;
    return refused(f, status, "light", why);
}

static int take_pixels(void *user, const gn_pixels *pixels)
{
    copy_region(user, pixels);
    return 0;
}

int frame_camera_pass(frame *f, const gn_camera *camera, problem *why)
{
    double start = frame_clock();
    int volumes = f->settings.shadow == GN_SHADOW_VOLUMES,
        all = f->light.kind == GN_POINT && choices_have_one_face(&f->settings);
    gn_status status = all       ? gn_point_pass(f->context, &f->light, camera, take_pixels, f)
                       : volumes ? gn_volumes_begin(f->context, camera)
                                 : gn_camera_begin(f->context, camera);
    if (status == GN_OK && !all)
        status = run_regions(f, run_camera_region, f->plan.camera_regions);
    f->camera_seconds = frame_clock() - start;
    return refused(f, status, "camera", why);
}

uint32_t (*frame_texel_places(const frame *f))[2]
{
    uint32_t width = f->settings.map_width, height = f->settings.map_height;
    uint32_t(*places)[2] = memory_take((size_t)width * height, sizeof *places);
    for (uint32_t row = 0; row < height; row++)
        for (uint32_t column = 0; column < width; column++)
            gn_texel_place(f->context, column, row, places[(size_t)row * width + column]);
    return places;
}

/* ---- memory ---------------------------------------------------------------------------------------------------- */

static void allocate_image(frame *f)
{
    const gn_settings *s = &f->settings;
    size_t region = (size_t)f->plan.region_width * f->plan.region_height;
    size_t rows = ((size_t)s->height + f->plan.region_height - 1) / f->plan.region_height * f->plan.region_height;
    if (s->format == GN_RGB888)
        f->colour = memory_take(rows * s->width, 3);
    if (s->mask)
        f->mask = memory_take(rows * s->width, 1);
    f->worker_colour = memory_take(MOST_WORKERS, sizeof *f->worker_colour);
    f->worker_mask = memory_take(MOST_WORKERS, sizeof *f->worker_mask);
    if (f->plan.region_width == s->width)
        return;
    for (int i = 0; i < s->workers; i++) {
        f->worker_colour[i] = f->colour ? memory_take(region, 3) : 0;
        f->worker_mask[i] = f->mask ? memory_take(region, 1) : 0;
    }
}

int frame_open(frame *f, const gn_scene *scene, const gn_settings *settings, int keep_layers, problem *why)
{
    memset(f, 0, sizeof *f);
    f->settings = *settings;
    if (f->settings.workers > 1 && !f->settings.map_rows) /* or the light pass is one job */
        f->settings.map_rows = (uint16_t)((f->settings.map_height + f->settings.workers - 1) / f->settings.workers);
    /* a volume's side is set up anew for every region that it crosses */
    if (f->settings.shadow == GN_SHADOW_VOLUMES && !f->settings.region_height)
        f->settings.region_height = (uint16_t)((f->settings.height + f->settings.workers - 1) / f->settings.workers);
    gn_status status = gn_make_plan(&f->plan, scene, &f->settings);
    if (status != GN_OK)
        return problem_of_usage(why, "the core refuses the scene: %s", status_text(status));
    f->memory = memory_take(f->plan.bytes / 8 + 1, 8); /* malloc's alignment is GN_ALIGNMENT or more */
    status = gn_init(&f->context, scene, &f->settings, f->memory, f->plan.bytes);
    if (status != GN_OK)
        return problem_of_usage(why, "the core cannot start: %s", status_text(status));
    allocate_image(f);
    f->keep_layers = keep_layers;
    f->layer_count = settings->shadow == GN_SHADOW_VOLUMES ? 0 : f->plan.layers == GN_LAYERS_TWO ? 2 : 1;
    if (choices_have_one_face(settings))
        f->layer_count = 0;
    f->map_rows = f->settings.map_height * (settings->faces == &gn_six_faces ? 6u : 1u);
    size_t texels = (size_t)f->settings.map_width * f->map_rows;
    if (keep_layers && f->layer_count)
        f->map = memory_take(texels, sizeof *f->map);
    for (int i = 0; keep_layers && i < f->layer_count; i++)
        f->layers[i] = memory_take(texels, sizeof *f->layers[i]);
    return 0;
}

void frame_close(frame *f)
{
    for (int i = 0; i < MOST_WORKERS; i++) {
        free(f->worker_colour ? f->worker_colour[i] : 0);
        free(f->worker_mask ? f->worker_mask[i] : 0);
    }
    free(f->worker_colour);
    free(f->worker_mask);
    free(f->colour);
    free(f->mask);
    free(f->layers[0]);
    free(f->layers[1]);
    free(f->map);
    free(f->memory);
    memset(f, 0, sizeof *f);
}

/* ---- hashes ---------------------------------------------------------------------------------------------------- */

/* Depths, or as many zeros where there is no such layer. */
static stage_hash hash_depths(const frame *f, stage_hash hash, const gn_depth *depths)
{
    size_t count = (size_t)f->settings.map_width * f->map_rows;
    for (size_t i = 0; i < count; i++) {
        gn_depth depth = depths ? depths[i] : 0;
        hash = GN_DEPTH_BITS == 16 ? stage_hash_u16(hash, (uint16_t)depth) : stage_hash_u32(hash, depth);
    }
    return hash;
}

static stage_hash hash_bytes(const uint8_t *bytes, size_t count)
{
    stage_hash hash = stage_hash_init();
    for (size_t i = 0; i < count; i++)
        hash = stage_hash_u8(hash, bytes[i]);
    return hash;
}

stage_hash frame_hash_layers(const frame *f)
{
    return hash_depths(f, hash_depths(f, stage_hash_init(), f->layers[0]), f->layers[1]);
}

stage_hash frame_hash_map(const frame *f)
{
    return hash_depths(f, stage_hash_init(), f->map);
}

stage_hash frame_hash_silhouettes(const frame *f)
{
    stage_hash hash = stage_hash_init();
    uint32_t stride;
    const uint8_t *map = gn_silhouette_map(f->context, &stride);
    size_t beyond = map != 0; /* the last row and column have no cells, but sides */
    map = map ? map : gn_crossing_map(f->context, &stride);
    for (size_t row = 0; map && row + beyond < f->map_rows; row++)
        for (size_t column = 0; column + beyond < f->settings.map_width; column++)
            hash = stage_hash_u8(hash, map[row * stride + column]);
    return hash;
}

stage_hash frame_hash_warp(const frame *f)
{
    stage_hash hash = stage_hash_init();
    const gn_rectangle *r = &f->rectangle;
    const int32_t numbers[6] = {r->cosine, r->sine, r->low[0], r->low[1], r->size[0], r->size[1]};
    for (int i = 0; i < 6; i++)
        hash = stage_hash_u32(hash, (uint32_t)numbers[i]);
    uint32_t(*places)[2] = frame_texel_places(f);
    size_t count = (size_t)f->settings.map_width * f->settings.map_height;
    for (size_t i = 0; i < count; i++)
        hash = stage_hash_u32(stage_hash_u32(hash, places[i][0]), places[i][1]);
    free(places);
    return hash;
}

stage_hash frame_hash_mask(const frame *f)
{
    return hash_bytes(f->mask, (size_t)f->settings.width * f->settings.height);
}

stage_hash frame_hash_colour(const frame *f)
{
    return hash_bytes(f->colour, 3 * (size_t)f->settings.width * f->settings.height);
}
