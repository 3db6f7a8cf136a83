#include "automatic_cost.h"

double automatic_cost(const gn_settings *settings, const gn_plan *plan, const gn_statistics *s)
{
    double light = 600.0 * (double)s->light_triangles + 15.0 * (double)s->light_texels;
    if (plan->layers == GN_LAYERS_TWO)
        light *= 1.4;
    double camera = 800.0 * (double)s->camera_triangles + 12.0 * (double)s->camera_fragments;
    double view = plan->view_rounds * (camera + 30.0 * (double)s->view_samples);
    double test = 20.0 * (double)s->pixels_shaded + 20.0 * (double)s->pixels_tested +
                  230.0 * (double)s->pixels_virtual + 100.0 * (double)s->pixels_silhouette +
                  400.0 * (double)s->silhouette_edges;
    if (settings->shadow == GN_SHADOW_VOLUMES)
        light = 700.0 * plan->triangles + 7000.0 * (double)s->volume_faces + 20.0 * (double)s->volume_fragments;
    return (view + light + camera + test) / ((double)settings->width * settings->height);
}
