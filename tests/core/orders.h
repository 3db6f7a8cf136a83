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

#endif
