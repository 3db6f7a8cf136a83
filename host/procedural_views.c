/* Other views of the procedural scenes: the same meshes under a camera and a light drawn from a seed. They are there to
 * show that nothing was tuned to the twelve.
 *
 * Candidates are drawn until a coarse ray-cast of one says that it is worth rendering: enough surface, enough of it
 * lit, enough of it in a cast shadow (not merely turned away from the light), and the eye not inside a solid. Positions
 * are rounded to what the scene file prints before they are judged. Double precision, no acceleration structure: 300
 * camera rays and as many shadow rays against all triangles, at most 10^7 intersections a candidate; a scene takes one
 * to six candidates on average. The ray-cast chooses views; it is no truth to measure by. */
#include "procedural.h"
#include "procedural_random.h"
#include "procedural_scene.h"

#include <errno.h>
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

#define CANDIDATES 1000
#define RAYS_ACROSS 20
#define RAYS_DOWN 15
#define START                                                                                                          \
    1e-6 /* where a ray from a surface begins, as a fraction of its direction's length: not at its own triangle */

/* ---- drawing a view --------------------------------------------------------------------------------------------- */

static double rounded(double v, double steps)
{
    return floor(v * steps + 0.5) / steps;
}

/* A vector of this length, in a random direction between two elevations (degrees above the horizon). */
static part_point draw_direction(twister *random, double length, double lowest, double highest)
{
    double azimuth = part_radians(twister_uniform(random, 0, 360));
    double elevation = part_radians(twister_uniform(random, lowest, highest));
    double level = length * cos(elevation);
    return (part_point){level * cos(azimuth), length * sin(elevation), level * sin(azimuth)};
}

static part_point position_around(part_point target, part_point offset)
{
    return (part_point){rounded(target.x + offset.x, 100), rounded(target.y + offset.y, 100),
                        rounded(target.z + offset.z, 100)};
}

static double distance(part_point a, part_point b)
{
    part_point d = part_minus(a, b);
    return sqrt(part_dot(d, d));
}

/* Replace the eye, and the light's direction or position, of the scene as it was built. */
static void draw_view(procedural_scene *scene, const procedural_camera *camera, const procedural_light *light,
                      twister *random)
{
    double away = distance(camera->eye, camera->target) * twister_uniform(random, 0.6, 1.2);
    scene->camera.eye = position_around(camera->target, draw_direction(random, away, 2, 50));
    if (light->is_spot) {
        double height = distance(light->position, light->target);
        scene->light.position = position_around(light->target, draw_direction(random, height, 20, 70));
    } else {
        part_point to_light = draw_direction(random, 1, 20, 70);
        scene->light.direction =
            (part_point){rounded(-to_light.x, 1000), rounded(-to_light.y, 1000), rounded(-to_light.z, 1000)};
    }
}

/* ---- rays ------------------------------------------------------------------------------------------------------- */

typedef struct facet {                       /* a triangle, ready to be met by rays */
    part_point corner, edge1, edge2, normal; /* normal: edge1 x edge2, outwards if closed */
    int closed;
} facet;

typedef struct soup {
    facet *facets;
    size_t count;
} soup;

typedef struct ray { /* origin + t direction */
    part_point origin, direction;
} ray;

/* All triangles of the scene. Returns 0, or -1 with errno ENOMEM. */
static int gather(soup *all, const procedural_scene *scene)
{
    size_t count = 0;
    for (int i = 0; i < scene->piece_count; i++)
        count += scene->pieces[i].mesh.triangle_count;
    all->count = 0;
    all->facets = malloc(count * sizeof *all->facets);
    if (!all->facets) {
        errno = ENOMEM;
        return -1;
    }
    for (int i = 0; i < scene->piece_count; i++) {
        const part_mesh *m = &scene->pieces[i].mesh;
        for (size_t k = 0; k < m->triangle_count; k++) {
            const int *t = m->triangles[k];
            facet *f = &all->facets[all->count++];
            f->corner = m->vertices[t[0]];
            f->edge1 = part_minus(m->vertices[t[1]], f->corner);
            f->edge2 = part_minus(m->vertices[t[2]], f->corner);
            f->normal = part_cross(f->edge1, f->edge2);
            f->closed = scene->pieces[i].closed;
        }
    }
    return 0;
}

/* The t at which the ray meets the facet, or -1 (Moeller & Trumbore, J. Graphics Tools 2(1), 1997, with the normal). */
static double meet(const facet *f, const ray *r)
{
    double along = part_dot(f->normal, r->direction);
    if (along == 0)
        return -1;
    part_point from_corner = part_minus(r->origin, f->corner);
    part_point side = part_cross(from_corner, r->direction);
    double u = -part_dot(f->edge2, side) / along, v = part_dot(f->edge1, side) / along;
    if (u < 0 || v < 0 || u + v > 1)
        return -1;
    return -part_dot(f->normal, from_corner) / along;
}

/* The first facet that the ray meets at *t in [START, limit], and where; 0 if there is none. */
static const facet *first_met(const soup *all, const ray *r, double limit, double *t)
{
    const facet *first = 0;
    *t = limit;
    for (size_t i = 0; i < all->count; i++) {
        double here = meet(&all->facets[i], r);
        if (here >= START && here <= *t) {
            first = &all->facets[i];
            *t = here;
        }
    }
    return first;
}

/* ---- judging a view --------------------------------------------------------------------------------------------- */

typedef struct tally { /* of camera rays; points turned away from the light or outside its frustum are surface only */
    int rays, surface, inside, lit, shadowed;
} tally;

typedef struct axes { /* orthonormal */
    part_point forward, side, up;
    double half; /* of the image's height at distance 1: tan(fovy / 2) */
} axes;

static axes look(part_point from, part_point to, double fovy)
{
    static const part_point upwards = {0, 1, 0}; /* no view here is steeper than 70 degrees */
    axes a;
    a.forward = part_unit(part_minus(to, from));
    a.side = part_unit(part_cross(a.forward, upwards));
    a.up = part_cross(a.side, a.forward);
    a.half = tan(part_radians(fovy) / 2);
    return a;
}

/* The ray from the point towards the light; *limit: the t of the light's near plane. Returns 0 outside a spot's
 * frustum. */
static int towards_light(const procedural_light *light, part_point point, ray *r, double *limit)
{
    r->origin = point;
    if (!light->is_spot) {
        r->direction = part_minus((part_point){0, 0, 0}, light->direction);
        *limit = HUGE_VAL;
        return 1;
    }
    axes a = look(light->position, light->target, light->fovy);
    part_point from_light = part_minus(point, light->position);
    double depth = part_dot(from_light, a.forward), reach = depth * a.half;
    r->direction = part_minus(light->position, point);
    *limit = (depth - light->near_depth) / depth;
    return depth >= light->near_depth && depth <= light->far_depth && fabs(part_dot(from_light, a.side)) <= reach &&
           fabs(part_dot(from_light, a.up)) <= reach;
}

/* Follow one camera ray. */
static void cast(const soup *all, const procedural_light *light, const ray *eye, tally *sum)
{
    double t, limit;
    ray shadow;
    const facet *seen = first_met(all, eye, HUGE_VAL, &t);
    sum->rays++;
    if (!seen)
        return;
    sum->surface++;
    double to_eye = -part_dot(seen->normal, eye->direction);
    if (seen->closed && to_eye < 0)
        sum->inside++;
    part_point d = eye->direction, o = eye->origin;
    part_point point = {o.x + t * d.x, o.y + t * d.y, o.z + t * d.z};
    if (!towards_light(light, point, &shadow, &limit) || (part_dot(seen->normal, shadow.direction) > 0) != (to_eye > 0))
        return;
    if (first_met(all, &shadow, limit, &t))
        sum->shadowed++;
    else
        sum->lit++;
}

static tally survey(const soup *all, const procedural_scene *scene)
{
    tally sum = {0, 0, 0, 0, 0};
    axes a = look(scene->camera.eye, scene->camera.target, scene->camera.fovy);
    for (int j = 0; j < RAYS_DOWN; j++)
        for (int i = 0; i < RAYS_ACROSS; i++) {
            double v = a.half * (1 - (2 * j + 1.0) / RAYS_DOWN);
            double u = a.half * ((2 * i + 1.0) / RAYS_ACROSS - 1) * PROCEDURAL_WIDTH / PROCEDURAL_HEIGHT;
            ray r = {scene->camera.eye,
                     {a.forward.x + u * a.side.x + v * a.up.x, a.forward.y + u * a.side.y + v * a.up.y,
                      a.forward.z + u * a.side.z + v * a.up.z}};
            cast(all, &scene->light, &r, &sum);
        }
    return sum;
}

/* Surface on half of the image; of the surface a fifth lit, a tenth in cast shadow, and next to nothing seen from
 * inside. */
static int is_worth_rendering(tally t)
{
    return 2 * t.surface >= t.rays && 5 * t.lit >= t.surface && 10 * t.shadowed >= t.surface &&
           50 * t.inside <= t.surface;
}

/* Draw until a view is found. Returns 0, or -1 with errno EDOM. */
static int find_view(procedural_scene *scene, const soup *all, twister *random)
{
    const procedural_camera camera = scene->camera;
    const procedural_light light = scene->light;
    for (int i = 0; i < CANDIDATES; i++) {
        draw_view(scene, &camera, &light, random);
        if (is_worth_rendering(survey(all, scene)))
            return 0;
    }
    errno = EDOM;
    return -1;
}

/* ---- the call --------------------------------------------------------------------------------------------------- */

/* Two digits: scenes with the same seed differ. */
static int change_view(procedural_scene *scene, unsigned seed, int index)
{
    const uint32_t key[] = {(uint32_t)seed, (uint32_t)index};
    twister random;
    soup all;
    twister_seed(&random, key, 2);
    if (gather(&all, scene))
        return -1;
    int result = find_view(scene, &all, &random);
    int error = errno;
    free(all.facets);
    errno = error;
    return result;
}

int procedural_write_view(const char *name, unsigned seed, const char *folder)
{
    char file[64], heading[128];
    procedural_scene scene;
    int index = procedural_index(name);
    if (index < 0)
        return -1;
    snprintf(file, sizeof file, "%s_view%u.scene", name, seed);
    snprintf(heading, sizeof heading, "%s, view %u: the same meshes, another camera and light", name, seed);
    int result = procedural_build(&scene, index);
    if (result == 0)
        result = change_view(&scene, seed, index);
    if (result == 0)
        result = procedural_save(&scene, file, heading, folder);
    int error = errno;
    procedural_free(&scene);
    errno = error;
    return result;
}
