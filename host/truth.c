#include "truth.h"

#include "memory.h"
#include "progress.h"
#include "truth_trace.h"

#include <pthread.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_WORKERS = 64, PIXEL = 256 };

const char *const truth_reason_names[TRUTH_REASON_COUNT] = {
    "none",          "eye-edge",     "eye-depth",   "eye-plane",   "light-side",
    "light-frustum", "shadow-touch", "shadow-edge", "shadow-near", "shadow-within",
};

/* ---- rows ------------------------------------------------------------------------------------------------------ */

typedef struct job {
    truth *t;
    const truth_scene *scene;
    uint32_t next; /* row */
    progress shown;
    pthread_mutex_t lock;
} job;

/* Does the answer change 1/256 pixel beside the centre? */
static int is_near(const truth_scene *scene, int32_t x, int32_t y, uint8_t mask, truth_memory *memory)
{
    static const int32_t beside[4][2] = {{-1, 0}, {1, 0}, {0, -1}, {0, 1}};
    for (int i = 0; i < 4; i++)
        if (truth_trace(scene, x + beside[i][0], y + beside[i][1], memory).mask != mask)
            return 1;
    return 0;
}

/* A row starts with an empty memory, so that counts too are the same for any number of workers. */
static truth cast_row(const job *j, uint32_t row)
{
    truth counts = {0};
    truth_memory memory = {0};
    int32_t y = (int32_t)row * PIXEL + PIXEL / 2;
    for (uint32_t column = 0; column < j->t->width; column++) {
        int32_t x = (int32_t)column * PIXEL + PIXEL / 2;
        size_t pixel = (size_t)row * j->t->width + column;
        truth_answer answer = truth_trace(j->scene, x, y, &memory);
        int tie = answer.reason != TRUTH_NO_TIE;
        j->t->mask[pixel] = answer.mask;
        j->t->reasons[pixel] = (uint8_t)answer.reason;
        j->t->ties[pixel] = (uint8_t)tie;
        counts.lit += answer.mask == TRUTH_LIT;
        counts.shadowed += answer.mask == TRUTH_SHADOWED;
        counts.tie_count += (uint64_t)tie;
        if (!j->t->near)
            continue;
        int near_pixel = tie || is_near(j->scene, x, y, answer.mask, &memory);
        j->t->near[pixel] = near_pixel ? 255 : 0;
        counts.near_count += (uint64_t)near_pixel;
    }
    counts.exact_decisions = memory.exact_decisions;
    return counts;
}

static void add_counts(truth *t, const truth *row)
{
    t->lit += row->lit;
    t->shadowed += row->shadowed;
    t->surface = t->lit + t->shadowed;
    t->tie_count += row->tie_count;
    t->near_count += row->near_count;
    t->exact_decisions += row->exact_decisions;
}

static void *work(void *user)
{
    job *j = user;
    truth counts = {0};
    for (;;) {
        pthread_mutex_lock(&j->lock);
        add_counts(j->t, &counts);
        uint32_t row = j->next < j->t->height ? j->next++ : j->t->height;
        progress_show(&j->shown, row, j->t->height);
        pthread_mutex_unlock(&j->lock);
        if (row == j->t->height)
            return 0;
        counts = cast_row(j, row);
    }
}

/* Cast all rows; this thread is one of the workers. A thread that cannot be started is done without. */
static void cast_rows(truth *t, const truth_scene *scene, int workers)
{
    job j = {.t = t, .scene = scene, .shown = progress_start("truth")};
    pthread_t threads[MOST_WORKERS];
    int started = 0;
    pthread_mutex_init(&j.lock, 0);
    while (started < workers - 1 && pthread_create(&threads[started], 0, work, &j) == 0)
        started++;
    work(&j);
    for (int i = 0; i < started; i++)
        pthread_join(threads[i], 0);
    pthread_mutex_destroy(&j.lock);
    progress_end(&j.shown);
}

int truth_make(truth *t, const packed_scene *packed, uint32_t width, uint32_t height, int workers, int with_near,
               problem *why)
{
    truth_scene scene;
    size_t pixels = (size_t)width * height;
    memset(t, 0, sizeof *t);
    if (workers < 1 || workers > MOST_WORKERS)
        return problem_of_usage(why, "%d workers; expected 1 to %d", workers, MOST_WORKERS);
    int result = truth_scene_open(&scene, packed, width, height, why);
    if (!result) {
        t->width = width;
        t->height = height;
        t->triangles = scene.tree.triangle_count;
        t->mask = memory_take(pixels, 1);
        t->ties = memory_take(pixels, 1);
        t->reasons = memory_take(pixels, 1);
        t->near = with_near ? memory_take(pixels, 1) : 0;
        cast_rows(t, &scene, workers);
    }
    truth_scene_close(&scene);
    return result;
}

void truth_free(truth *t)
{
    free(t->mask);
    free(t->ties);
    free(t->reasons);
    free(t->near);
    memset(t, 0, sizeof *t);
}
