#include "automatic_cost.h"

#include "cost_model.h"

/* Triangles are set up, texels and fragments covered; then each pixel finds its face, and what disagrees is sampled. */
static double cost_of_point_light(const gn_plan *plan, const gn_statistics *s)
{
    double layers = plan->layers == GN_LAYERS_TWO ? 1.4 : 1;
    double light = layers * (600.0 * (double)s->light_triangles + 15.0 * (double)s->light_texels);
    double camera = 800.0 * (double)s->camera_triangles + 12.0 * (double)s->camera_fragments;
    double test = 20.0 * (double)s->pixels_shaded + 159.0 * (double)s->pixels_tested +
                  230.0 * (double)s->pixels_virtual + 100.0 * (double)s->pixels_silhouette +
                  400.0 * (double)s->silhouette_edges;
    return light + camera + test;
}

double automatic_cost(const gn_settings *settings, const gn_plan *plan, const gn_statistics *statistics, int light_kind)
{
    double passes[LANE_PASSES] = {0}, all = 0;
    problem why;
    if (light_kind == GN_POINT || cost_model_m4(passes, settings, plan, statistics, 0, light_kind, &why))
        all = cost_of_point_light(plan, statistics);
    for (int i = 0; i < LANE_PASSES; i++)
        all += passes[i];
    return all / (double)(statistics->pixels_shaded ? statistics->pixels_shaded : 1);
}
