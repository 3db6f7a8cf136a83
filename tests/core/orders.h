/* For tests that layers do not depend on order: a light pass whose regions are shared by threads, and a scene in
 * another order. */
#ifndef ORDERS_H
#define ORDERS_H

#include "scenes.h"

#include <pthread.h>
#include <stdlib.h>

enum { MOST_OBJECTS = 4 };

typedef struct random_scene {
    shape shapes[MOST_OBJECTS];
    gn_model models[MOST_OBJECTS];
    gn_object objects[MOST_OBJECTS];
    gn_scene scene;
} random_scene;

typedef struct job {
    gn_context *context;
    uint32_t worker, workers;
    gn_status status;
} job;

static void *run_regions(void *argument)
{
    job *j = argument;
    for (uint32_t region = j->worker; region < j->context->plan.light_regions; region += j->workers) {
        gn_status status = gn_light_layers(j->context, region, j->worker);
        if (status == GN_OK)
            status = gn_light_resolve(j->context, region, j->worker);
        if (status != GN_OK)
            j->status = status;
    }
    return 0;
}

static TAP_UNUSED gn_status light_pass_on_threads(gn_context *context, const gn_light *light, uint32_t workers)
{
    pthread_t thread[8];
    job jobs[8];
    gn_status status = gn_light_begin(context, light);
    if (status != GN_OK)
        return status;
    for (uint32_t i = 0; i < workers; i++) {
        job j = {context, i, workers, GN_OK};
        jobs[i] = j;
        if (pthread_create(&thread[i], 0, run_regions, &jobs[i]))
            abort();
    }
    for (uint32_t i = 0; i < workers; i++) {
        pthread_join(thread[i], 0);
        status = jobs[i].status != GN_OK ? jobs[i].status : status;
    }
    return status;
}

/* Permute triangles and objects, turn triangles' corners. */
static TAP_UNUSED void shuffle(random_scene *r)
{
    for (uint32_t o = 0; o < r->scene.object_count; o++) {
        shape *s = &r->shapes[o];
        for (uint32_t i = s->mesh.triangle_count; i-- > 1;) {
            uint32_t j = (uint32_t)between(0, i);
            for (uint32_t k = 0; k < 3; k++) {
                uint32_t index = s->indices[3 * i + k];
                s->indices[3 * i + k] = s->indices[3 * j + k];
                s->indices[3 * j + k] = index;
            }
        }
    }
    for (uint32_t o = r->scene.object_count; o-- > 1;) {
        uint32_t j = (uint32_t)between(0, o);
        gn_object object = r->objects[o];
        r->objects[o] = r->objects[j];
        r->objects[j] = object;
    }
}

/* All layers, surfaces and culls that go together; slopes last. */
enum { LAYER_CHOICES = 14, SLOPE_CHOICES = 3 };
static const uint8_t layer_choices[LAYER_CHOICES][3] = {
    {GN_CONSTANT, GN_LAYERS_FIRST, GN_CULL_NONE},  {GN_CONSTANT, GN_LAYERS_FIRST, GN_CULL_BACK},
    {GN_CONSTANT, GN_LAYERS_FIRST, GN_CULL_FRONT}, {GN_MIDPOINT, GN_LAYERS_TWO, GN_CULL_NONE},
    {GN_MIDPOINT, GN_LAYERS_TWO, GN_CULL_BACK},    {GN_DUAL, GN_LAYERS_TWO, GN_CULL_NONE},
    {GN_DUAL, GN_LAYERS_TWO, GN_CULL_BACK},        {GN_SECOND, GN_LAYERS_TWO, GN_CULL_NONE},
    {GN_SECOND, GN_LAYERS_TWO, GN_CULL_BACK},      {GN_SECOND, GN_LAYERS_FIRST, GN_CULL_FRONT},
    {GN_MIXED, GN_LAYERS_TWO, GN_CULL_NONE},       {GN_SLOPE, GN_LAYERS_FIRST, GN_CULL_NONE},
    {GN_SLOPE, GN_LAYERS_FIRST, GN_CULL_BACK},     {GN_SLOPE, GN_LAYERS_AUTO, GN_CULL_FRONT},
};

/* One of the first so many, in regions of random height, with a random bias and slope; the image is a square. */
static inline gn_settings random_layers(int choices, uint16_t image, int32_t width, int32_t height)
{
    const uint8_t *c = layer_choices[between(0, choices - 1)];
    gn_settings s = gn_default_settings(image, image, 1);
    s.map_width = (uint16_t)width;
    s.map_height = (uint16_t)height;
    s.surface = c[0];
    s.layers = c[1];
    s.cull = c[2];
    s.map_rows = (uint16_t)between(0, height);
    s.bias.unit = GN_BIAS_WORLD;
    s.bias.value = (uint32_t)(between(0, 3) ? between(0, 300) : between(0, 70000));
    s.slope = between(0, 1) ? between(0, 4 << 16) : between(0, 64 << 16);
    return s;
}

#endif
