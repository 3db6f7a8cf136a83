#include "automatic_scene.h"

#include "automatic_chain.h"
#include "automatic_trial.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

typedef struct vector {
    double x, y, z;
} vector;

/* Differences of coordinates of 25 bits and their products are exact in doubles. */
static vector between(const int32_t a[3], const int32_t b[3])
{
    return (vector){(double)b[0] - a[0], (double)b[1] - a[1], (double)b[2] - a[2]};
}

static vector cross(vector a, vector b)
{
    return (vector){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

static double length(vector a)
{
    return sqrt(a.x * a.x + a.y * a.y + a.z * a.z);
}

/* The vertex that scores highest. */
static uint32_t farthest(const gn_mesh *mesh,
                         double (*score)(const int32_t *vertex, const int32_t *a, const int32_t *b), const int32_t *a,
                         const int32_t *b)
{
    uint32_t best = 0;
    for (uint32_t i = 1; i < mesh->vertex_count; i++)
        if (score(mesh->vertices[i], a, b) > score(mesh->vertices[best], a, b))
            best = i;
    return best;
}

static double distance(const int32_t *vertex, const int32_t *a, const int32_t *b)
{
    (void)b;
    return length(between(a, vertex));
}

/* Times the length of ab: from the line through them. */
static double from_line(const int32_t *vertex, const int32_t *a, const int32_t *b)
{
    return length(cross(between(a, b), between(a, vertex)));
}

/* The plane through the first vertex, the one farthest from it, and the one farthest from their line: rounded vertices
 * are less than two units from a plane that they lay in. */
int automatic_mesh_is_flat(const gn_mesh *mesh)
{
    if (!mesh->vertex_count)
        return 1;
    const int32_t *a = mesh->vertices[0], *b = mesh->vertices[farthest(mesh, distance, a, a)],
                  *c = mesh->vertices[farthest(mesh, from_line, a, b)];
    vector normal = cross(between(a, b), between(a, c));
    double most = 2 * length(normal);
    for (uint32_t i = 0; i < mesh->vertex_count; i++) {
        vector to = between(a, mesh->vertices[i]);
        if (fabs(to.x * normal.x + to.y * normal.y + to.z * normal.z) > most)
            return 0;
    }
    return 1;
}

static void count_objects(automatic_scene *scene, const packed_scene *packed)
{
    for (uint32_t i = 0; i < packed->scene.object_count; i++) {
        const gn_mesh *mesh = packed->scene.objects[i].mesh;
        if (!mesh->triangle_count)
            continue;
        if (mesh->closed)
            scene->closed++;
        else if (automatic_mesh_is_flat(mesh))
            scene->flat++;
        else
            scene->open++;
    }
}

static int probe(automatic_scene *scene, const packed_scene *packed, const gn_settings *base, int placement,
                 double *border, problem *why)
{
    automatic_candidate candidate = {AUTOMATIC_MIXED, AUTOMATIC_SILHOUETTE, (uint8_t)placement, AUTOMATIC_PROBE,
                                     AUTOMATIC_PROBE};
    automatic_result result;
    if (automatic_render(&candidate, packed, base, 0, &result, &scene->share, why))
        return -1;
    const gn_statistics *s = &result.statistics;
    *border = s->pixels_shaded ? 100.0 * (double)s->pixels_silhouette / (double)s->pixels_shaded : 0;
    return 0;
}

int automatic_scene_make(automatic_scene *scene, const packed_scene *packed, const gn_settings *base, problem *why)
{
    memset(scene, 0, sizeof *scene);
    scene->light = packed->light.kind;
    scene->share = 1;
    count_objects(scene, packed);
    int fitted = scene->light == GN_POINT ? AUTOMATIC_UNIFORM : AUTOMATIC_MSF_RECTILINEAR;
    return probe(scene, packed, base, AUTOMATIC_UNIFORM, &scene->uniform_border, why) ||
                   probe(scene, packed, base, fitted, &scene->fitted_border, why)
               ? -1
               : 0;
}

void automatic_scene_text(const automatic_scene *scene, char *text, size_t size)
{
    static const char *const lights[] = {"sun", "spot light", "point light"};
    static const struct {
        const char *one, *more;
    } words[] = {{"solid", "solids"}, {"flat mesh", "flat meshes"}, {"open mesh", "open meshes"}};
    const uint32_t counts[] = {scene->closed, scene->flat, scene->open};
    size_t used = 0;
    for (int i = 0; i < 3; i++)
        if (counts[i])
            used += (size_t)snprintf(text + used, size - used, "%s%u %s", used ? ", " : "", (unsigned)counts[i],
                                     counts[i] == 1 ? words[i].one : words[i].more);
    snprintf(text + used, size - used, "%s%s", used ? ", a " : "nothing, a ", lights[scene->light]);
    used = strlen(text);
    if (scene->light != GN_POINT)
        snprintf(text + used, size - used, " of whose plane the view takes %.2g %%", 100 * scene->share);
}
