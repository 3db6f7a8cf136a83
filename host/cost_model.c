#include "cost_model.h"

#include <assert.h>
#include <math.h>
#include <string.h>

/* A frame in the words of the features: how its settings make shadows, as 0 or 1, and what was counted. */
typedef struct frame_kind {
    int spot;
    int one, two, slope, second;    /* layers; slope: one and what slopes accumulate; second: back faces alone */
    int uniform, fitted;            /* uniform: no fit and no warp; fitted: a fit and no warp */
    int rectilinear, nonorthogonal; /* warps */
    int distance, minimal, fit;     /* the rectilinear warp by distance, the minimal frustum, any fit */
    int point, plane_bias, voting;  /* receivers */
    int bilinear, jitter, box;      /* reconstructions */
    int silhouettes, smooth, crossings;
    double box_side;          /* texels */
    double map, side, pixels; /* texels of the map, its columns and rows, pixels of the image */
} frame_kind;

static frame_kind kind_of(const gn_settings *s, const gn_plan *plan, int light_kind)
{
    frame_kind k = {0};
    const gn_reconstruction *how = s->reconstruction;
    k.spot = light_kind != GN_DIRECTIONAL; /* a point light's faces are spots */
    k.slope = s->surface == GN_SLOPE;
    k.two = plan->layers == GN_LAYERS_TWO;
    k.one = !k.two && !k.slope;
    k.second = k.one && s->surface == GN_SECOND;
    k.distance = s->warp == &gn_rectilinear_distance;
    k.rectilinear = s->warp == &gn_rectilinear || k.distance;
    k.nonorthogonal = s->warp == &gn_nonorthogonal;
    k.fit = s->fit != 0;
    k.minimal = s->fit == &gn_minimal_frustum;
    k.fitted = s->fit && !s->warp;
    k.uniform = !s->fit && !s->warp;
    k.plane_bias = s->receiver == &gn_plane_bias;
    k.voting = s->receiver && !k.plane_bias;
    k.point = !s->receiver;
    k.bilinear = how == &gn_bilinear;
    k.jitter = how == &gn_jitter_4x4;
    k.box_side = how == &gn_box_3x3 ? 3 : how == &gn_box_5x5 ? 5 : how == &gn_box_7x7 ? 7 : 0;
    k.box = k.box_side > 0;
    k.smooth = how == &gn_silhouettes_smooth;
    k.silhouettes = how == &gn_silhouettes || k.smooth;
    k.crossings = how == &gn_crossings;
    k.map = (double)s->map_width * s->map_height;
    k.side = s->map_width + s->map_height;
    k.pixels = (double)s->width * s->height;
    return k;
}

static void put(cost_features *f, const char *name, double value)
{
    assert(f->count < COST_MOST_FEATURES);
    f->name[f->count] = name;
    f->value[f->count++] = value;
}

/* Rows of triangles are not counted. Of triangles of one shape they grow with the root of the area. */
static double rows_of(double triangles, double centres)
{
    return sqrt(triangles * centres);
}

/* ---- with operations --------------------------------------------------------------------------------------------- */

static void put_operations(cost_features *f, const uint64_t operations[LANE_OPERATIONS])
{
    static const char *const names[LANE_OPERATIONS] = {"multiplies", "divides", "adds", "loads", "stores", "others"};
    for (int i = 0; i < LANE_OPERATIONS; i++)
        put(f, names[i], (double)operations[i]);
    f->sums = f->count;
}

static void correct_view(cost_features *f, const frame_kind *k, const gn_plan *plan, const gn_statistics *n)
{
    double rounds = plan->view_rounds, triangles = (double)n->camera_triangles, fragments = (double)n->camera_fragments;
    put(f, "fragments", rounds * fragments);
    put(f, "pixels", rounds * k->pixels);
    put(f, "triangles set up", rounds * triangles);
    put(f, "rows of triangles", rounds * rows_of(triangles, fragments));
}

static void correct_light(cost_features *f, const frame_kind *k, const gn_plan *plan, const gn_statistics *n)
{
    double triangles = (double)n->light_triangles, texels = (double)n->light_texels, rows = rows_of(triangles, texels);
    put(f, "texels of triangles, one layer", texels * k->one);
    put(f, "texels of triangles, two layers", texels * k->two);
    put(f, "texels of triangles, slope", texels * k->slope);
    put(f, "texels of triangles, non-orthogonal", texels * k->nonorthogonal);
    put(f, "the map, one layer", k->map * k->one);
    put(f, "the map, back faces", k->map * k->second);
    put(f, "the map, two layers", k->map * k->two);
    put(f, "the map, slope", k->map * k->slope);
    put(f, "the map, silhouettes", k->map * k->silhouettes);
    put(f, "the map, crossings", k->map * k->crossings);
    put(f, "triangles", plan->triangles);
    put(f, "triangles set up", triangles);
    put(f, "triangles set up, rectilinear", triangles * k->rectilinear);
    put(f, "rows of triangles", rows);
    put(f, "rows of triangles, rectilinear", rows * k->rectilinear);
    put(f, "edges, silhouettes or crossings", (double)plan->edges * (k->silhouettes || k->crossings));
}

static void correct_camera(cost_features *f, const frame_kind *k, const gn_plan *plan, const gn_statistics *n)
{
    double shaded = (double)n->pixels_shaded, open = (double)n->pixels_virtual;
    put(f, "fragments", (double)n->camera_fragments);
    put(f, "pixels", k->pixels);
    put(f, "triangles", plan->triangles);
    put(f, "triangles set up", (double)n->camera_triangles);
    put(f, "pixels shaded", shaded);
    put(f, "pixels shaded, spot light", shaded * k->spot);
    put(f, "pixels, receiver, spot light", k->pixels * !k->point * k->spot);
    put(f, "pixels, bilinear", k->pixels * k->bilinear);
    put(f, "pixels, jitter", k->pixels * k->jitter);
    put(f, "texels, boxes", k->pixels * k->box_side * k->box_side);
    put(f, "pixels, smooth silhouettes", k->pixels * k->smooth);
    put(f, "pixels with virtual samples", open);
    put(f, "pixels with virtual samples, spot light", open * k->spot);
    put(f, "pixels decided by silhouettes", (double)n->pixels_silhouette);
    put(f, "pixels decided by smooth silhouettes", (double)n->pixels_silhouette * k->smooth);
}

/* ---- without ----------------------------------------------------------------------------------------------------- */

/* What every region draws of the camera's triangles: in the camera pass once, in the view pass once a round. */
static void put_visibility(cost_features *f, const frame_kind *k, const gn_plan *plan, const gn_statistics *n,
                           double times)
{
    double triangles = (double)n->camera_triangles, fragments = (double)n->camera_fragments;
    put(f, "triangles", times * plan->triangles);
    put(f, "triangles set up", times * triangles);
    put(f, "rows of triangles", times * rows_of(triangles, fragments));
    put(f, "fragments", times * fragments);
    put(f, "pixels", times * k->pixels);
}

static void sum_view(cost_features *f, const frame_kind *k, const gn_plan *plan, const gn_statistics *n)
{
    double samples = (double)n->view_samples;
    put(f, "vertices", plan->vertices);
    put_visibility(f, k, plan, n, plan->view_rounds);
    put(f, "pixels, spot light", plan->view_rounds * k->pixels * k->spot);
    put(f, "samples, minimal frustum", samples * k->minimal);
    put(f, "samples, rectilinear", samples * k->rectilinear);
    put(f, "samples, by distance", samples * k->distance);
    put(f, "samples, non-orthogonal", samples * k->nonorthogonal);
    put(f, "the minimal frustum's hull", k->minimal);
    put(f, "columns and rows, rectilinear", k->side * k->rectilinear);
    put(f, "texels, non-orthogonal", k->side * k->side * k->nonorthogonal);
}

static void sum_layers(cost_features *f, const frame_kind *k, const gn_plan *plan, const gn_statistics *n)
{
    double triangles = (double)n->light_triangles, texels = (double)n->light_texels, rows = rows_of(triangles, texels);
    put(f, "vertices", plan->vertices);
    put(f, "vertices, spot light", (double)plan->vertices * k->spot);
    put(f, "vertices, a fit or a warp", (double)plan->vertices * !k->uniform);
    put(f, "triangles", (double)plan->triangles * plan->light_regions);
    put(f, "triangles set up", triangles);
    put(f, "triangles set up, two layers", triangles * k->two);
    put(f, "triangles set up, slope", triangles * k->slope);
    put(f, "triangles set up, rectilinear", triangles * k->rectilinear);
    put(f, "triangles set up, non-orthogonal", triangles * k->nonorthogonal);
    put(f, "rows of triangles", rows);
    put(f, "rows of triangles, rectilinear", rows * k->rectilinear);
    put(f, "rows of triangles, non-orthogonal", rows * k->nonorthogonal);
    put(f, "texels of triangles, one layer", texels * k->one);
    put(f, "texels of triangles, two layers", texels * k->two);
    put(f, "texels of triangles, slope", texels * k->slope);
    put(f, "texels of triangles, non-orthogonal", texels * k->nonorthogonal);
    put(f, "the map, one layer", k->map * (k->one && !k->second));
    put(f, "the map, back faces", k->map * k->second);
    put(f, "the map, two layers", k->map * k->two);
    put(f, "the map, slope", k->map * k->slope);
}

static void sum_silhouettes(cost_features *f, const frame_kind *k, const gn_plan *plan, const gn_statistics *n)
{
    double either = k->silhouettes || k->crossings;
    double edges = (double)n->silhouette_edges, cells = (double)n->silhouette_texels;
    put(f, "silhouettes or crossings: triangles", plan->triangles * either);
    put(f, "silhouettes: the map", k->map * k->silhouettes);
    put(f, "silhouettes: edges", edges * k->silhouettes);
    put(f, "silhouettes: cells", cells * k->silhouettes);
    put(f, "crossings: the map", k->map * k->crossings);
    put(f, "crossings: edges", edges * k->crossings);
    put(f, "crossings: texels", cells * k->crossings);
}

/* The place of a point on the map, and the comparison with the nearest texel. */
static void sum_look_ups(cost_features *f, const frame_kind *k, const gn_statistics *n)
{
    double sun = !k->spot, receives = !k->point, tested = (double)n->pixels_tested;
    put(f, "pixels tested", tested);
    put(f, "pixels tested, even, spot light", tested * k->uniform * k->spot);
    put(f, "pixels, even, receiver", k->pixels * k->uniform * receives * sun);
    put(f, "pixels, even, receiver, spot light", k->pixels * k->uniform * receives * k->spot);
    put(f, "pixels, fitted", k->pixels * k->fitted * sun);
    put(f, "pixels, fitted, spot light", k->pixels * k->fitted * k->spot);
    put(f, "pixels, rectilinear", k->pixels * k->rectilinear * sun);
    put(f, "pixels, rectilinear, spot light", k->pixels * k->rectilinear * k->spot);
    put(f, "pixels, non-orthogonal", k->pixels * k->nonorthogonal * sun);
    put(f, "pixels, non-orthogonal, spot light", k->pixels * k->nonorthogonal * k->spot);
}

/* What receivers and reconstructions do about it. */
static void sum_cascade(cost_features *f, const frame_kind *k, const gn_statistics *n)
{
    double triangles = (double)n->camera_triangles, open = (double)n->pixels_virtual;
    double asked = open + (double)n->pixels_silhouette;
    put(f, "planes, plane bias", triangles * k->plane_bias);
    put(f, "pixels, plane bias", k->pixels * k->plane_bias);
    put(f, "planes, virtual samples", rows_of(triangles, asked) * k->voting);
    put(f, "pixels with virtual samples", open);
    put(f, "pixels with virtual samples, warps", open * (k->rectilinear || k->nonorthogonal));
    put(f, "virtual samples of filters", (double)n->virtual_samples * (k->bilinear || k->jitter || k->box));
    put(f, "pixels, bilinear", k->pixels * k->bilinear);
    put(f, "pixels, jitter", k->pixels * k->jitter);
    put(f, "texels, boxes", k->pixels * k->box_side * k->box_side);
    put(f, "pixels, smooth silhouettes", k->pixels * k->smooth);
    put(f, "pixels decided by silhouettes", (double)n->pixels_silhouette);
}

static void sum_camera(cost_features *f, const frame_kind *k, const gn_plan *plan, const gn_statistics *n)
{
    double shaded = (double)n->pixels_shaded;
    put(f, "vertices", plan->vertices);
    put_visibility(f, k, plan, n, 1);
    put(f, "pixels shaded", shaded);
    put(f, "pixels shaded, spot light", shaded * k->spot);
    put(f, "colours", rows_of((double)n->camera_triangles, shaded));
}

static void sum_volumes_light(cost_features *f, const frame_kind *k, const gn_plan *plan)
{
    put(f, "triangles", plan->triangles);
    put(f, "triangles, spot light", (double)plan->triangles * k->spot);
    put(f, "edges", plan->edges);
}

static void sum_volumes_camera(cost_features *f, const frame_kind *k, const gn_plan *plan, const gn_statistics *n)
{
    double faces = (double)n->volume_faces, fragments = (double)n->volume_fragments;
    sum_camera(f, k, plan, n);
    put(f, "silhouettes", (double)n->silhouette_edges);
    put(f, "faces of volumes", faces);
    put(f, "rows of volumes", rows_of(faces, fragments));
    put(f, "fragments of volumes", fragments);
}

/* ---- both -------------------------------------------------------------------------------------------------------- */

static void sum_job(cost_features *f, cost_job job, const frame_kind *k, const gn_plan *plan, const gn_statistics *n)
{
    switch (job) {
    case COST_VIEW:
        sum_view(f, k, plan, n);
        break;
    case COST_LIGHT:
        sum_layers(f, k, plan, n);
        sum_silhouettes(f, k, plan, n);
        break;
    case COST_CAMERA:
        sum_camera(f, k, plan, n);
        sum_look_ups(f, k, n);
        sum_cascade(f, k, n);
        break;
    case COST_VOLUMES_LIGHT:
        sum_volumes_light(f, k, plan);
        break;
    default:
        sum_volumes_camera(f, k, plan, n);
    }
    f->sums = f->count;
}

static void correct_volumes_camera(cost_features *f, const frame_kind *k, const gn_statistics *n)
{
    put(f, "pixels", k->pixels);
    put(f, "pixels shaded, spot light", (double)n->pixels_shaded * k->spot);
    put(f, "fragments of volumes", (double)n->volume_fragments);
}

static void correct_job(cost_features *f, cost_job job, const frame_kind *k, const gn_plan *plan,
                        const gn_statistics *n)
{
    if (job == COST_VIEW)
        correct_view(f, k, plan, n);
    else if (job == COST_LIGHT)
        correct_light(f, k, plan, n);
    else if (job == COST_CAMERA)
        correct_camera(f, k, plan, n);
    else if (job == COST_VOLUMES_CAMERA)
        correct_volumes_camera(f, k, n);
}

static cost_job job_of(lane_pass pass, const gn_settings *settings)
{
    if (pass == LANE_VIEW)
        return COST_VIEW;
    if (settings->shadow == GN_SHADOW_VOLUMES)
        return pass == LANE_LIGHT ? COST_VOLUMES_LIGHT : COST_VOLUMES_CAMERA;
    return pass == LANE_LIGHT ? COST_LIGHT : COST_CAMERA;
}

cost_job cost_model_features(cost_features *features, lane_pass pass, const gn_settings *settings, const gn_plan *plan,
                             const gn_statistics *statistics, const uint64_t operations[LANE_OPERATIONS],
                             int light_kind)
{
    cost_job job = job_of(pass, settings);
    frame_kind k = kind_of(settings, plan, light_kind);
    features->count = 0;
    if (operations) {
        put_operations(features, operations);
        correct_job(features, job, &k, plan, statistics);
    } else {
        sum_job(features, job, &k, plan, statistics);
    }
    return job;
}

static double predict(lane_pass pass, const gn_settings *settings, const gn_plan *plan, const gn_statistics *statistics,
                      const uint64_t operations[LANE_OPERATIONS], int light_kind)
{
    cost_features f;
    cost_job job = cost_model_features(&f, pass, settings, plan, statistics, operations, light_kind);
    const cost_coefficient *table = cost_model_table[operations != 0][job];
    double sum = 0;
    for (int i = 0; i < f.count; i++) {
        assert(strcmp(f.name[i], table[i].name) == 0);
        sum += f.value[i] * table[i].instructions;
    }
    return sum > 0 ? sum : 0;
}

int cost_model_m4(double instructions[LANE_PASSES], const gn_settings *settings, const gn_plan *plan,
                  const gn_statistics *statistics, const uint64_t operations[LANE_PASSES][LANE_OPERATIONS],
                  int light_kind, problem *why)
{
    if (light_kind == GN_POINT && (!operations || settings->faces != &gn_six_faces))
        return problem_of_usage(why,
                                "no cost model of point lights; expected six maps, and operations that are counted");
    if (settings->warp == &gn_rectilinear_vertices || settings->warp == &gn_nonorthogonal_vertices)
        return problem_of_usage(why, "no cost model of warps of vertices alone; expected another warp");
    for (int pass = 0; pass < LANE_PASSES; pass++)
        instructions[pass] =
            pass == LANE_VIEW && !plan->view_rounds
                ? 0
                : predict((lane_pass)pass, settings, plan, statistics, operations ? operations[pass] : 0, light_kind);
    return 0;
}
