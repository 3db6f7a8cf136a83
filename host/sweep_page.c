#include "sweep_page.h"

#include "frame.h"
#include "memory.h"
#include "page.h"
#include "sweep_measure.h"

#include <stdlib.h>
#include <string.h>

typedef struct page_job {
    const sweep_plan *plan;
    const sweep_scene *scenes;
    page_scene *shown;
    image *pictures, *truths;
    int scene_count;
} page_job;

/* As the scene looks, by a map large enough not to be seen. 0, or -1: no such picture can be made. */
static int take_picture(image *picture, const sweep_scene *scene, const char *size, int workers)
{
    sweep_choice choice;
    problem unused, *why = &unused;
    gn_settings settings;
    frame f = {.context = 0};
    packed_scene packed = scene->packed; /* edges are there, so nothing of it is written */
    sweep_choice_make(&choice, sweep_chain_find("mixed+virtual", strlen("mixed+virtual")), 2048, size, 0);
    int result = render_options_read(&settings, &packed, choice.values, why);
    settings.workers = (uint8_t)workers;
    settings.format = GN_RGB888;
    if (!result)
        result = frame_open(&f, &scene->packed.scene, &settings, 0, why) ||
                 frame_light_pass(&f, &scene->packed.light, why) || frame_camera_pass(&f, &scene->packed.camera, why);
    if (!result) {
        *picture = image_make(scene->width, scene->height, 3, IMAGE_U8);
        memcpy(picture->samples, f.colour, image_sample_count(picture));
    }
    frame_close(&f);
    return result ? -1 : 0;
}

static uint8_t *take_mask(void *context, const page_scene *shown, const sweep_row *row, problem *why)
{
    const page_job *j = context;
    return sweep_mask(&j->scenes[shown - j->shown], row, j->plan->image_text, why);
}

static void show_scenes(page_job *j, int workers)
{
    for (int i = 0; i < j->scene_count; i++) {
        const sweep_scene *s = &j->scenes[i];
        int none = take_picture(&j->pictures[i], s, j->plan->image_text, workers);
        j->truths[i] = (image){s->width, s->height, 1, IMAGE_U8, s->truth};
        j->shown[i] = (page_scene){s->name, none ? 0 : &j->pictures[i], &j->truths[i]};
    }
}

static int write_rows(page_job *j, const char *path, const char *command, const char *cost, problem *why)
{
    sweep_row *rows = memory_take(j->plan->count, sizeof *rows);
    page_input input = {.command = command,
                        .cost = cost,
                        .scenes = j->shown,
                        .scene_count = (size_t)j->scene_count,
                        .rows = rows,
                        .mask = take_mask,
                        .context = j};
    for (size_t i = 0; i < j->plan->count; i++)
        if (j->plan->cells[i].is_done)
            rows[input.row_count++] = j->plan->cells[i].row;
    int result = page_write(path, &input, why);
    free(rows);
    return result;
}

int sweep_page_write(const char *path, const sweep_plan *plan, const sweep_scene *scenes, int scene_count,
                     const char *command, const char *cost, int workers, problem *why)
{
    size_t count = (size_t)scene_count;
    page_job j = {.plan = plan,
                  .scenes = scenes,
                  .shown = memory_take(count, sizeof *j.shown),
                  .pictures = memory_take(count, sizeof *j.pictures),
                  .truths = memory_take(count, sizeof *j.truths),
                  .scene_count = scene_count};
    show_scenes(&j, workers);
    int result = write_rows(&j, path, command, cost, why);
    for (int i = 0; i < scene_count; i++)
        image_free(&j.pictures[i]);
    free(j.pictures);
    free(j.truths);
    free(j.shown);
    return result;
}
