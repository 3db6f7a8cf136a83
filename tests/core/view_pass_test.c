/* The view pass: what the camera sees is found pixel by pixel, by definition, and summed up slowly; what the pass has
 * summed up is that, bit for bit, whatever regions, workers and their order. Places on the light's plane against double
 * precision; fits hold all of them; what is left of a fit or a warp where nothing, one texel or one column is seen;
 * maps of all shapes; models, lights and cameras that move between the passes; statuses, plans and memory. Cases: 600
 * scenes, or GNOMON_CASES. */
#include "gn_hull.h"
#include "gn_warp_table.h"
#include "points.h"
#include "warps.h"

#include <math.h>
#include <pthread.h>

enum { WIDTH = 40, HEIGHT = 30, PIXELS = WIDTH * HEIGHT };

/* ---- scenes ----------------------------------------------------------------------------------------------------- */

typedef struct world {
    shape ground, things;
    gn_model model;
    gn_object objects[2];
    gn_scene scene;
} world;

/* Ground about the origin, a few boxes on it; with a model that may move them. */
static void make_world(world *w)
{
    memset(w, 0, sizeof *w);
    w->ground = shape_new(0);
    w->things = shape_new(1);
    int32_t half = between(300, 1500), tilt = between(0, 2) ? 0 : between(-200, 200);
    int32_t a[3] = {-half, -half, -tilt}, b[3] = {half, -half, tilt}, c[3] = {half, half, tilt},
            d[3] = {-half, half, -tilt};
    add_quad(&w->ground, a, b, c, d);
    for (int i = between(0, 4); i > 0; i--) {
        int32_t low[3] = {between(-800, 600), between(-800, 600), between(0, 300)}, high[3];
        for (int k = 0; k < 3; k++)
            high[k] = low[k] + between(20, 400);
        add_box(&w->things, low, high);
    }
    gn_model_identity(&w->model);
    gn_rgb grey = {200, 180, 160};
    w->objects[0].mesh = &w->ground.mesh;
    w->objects[1].mesh = &w->things.mesh;
    w->objects[1].model = &w->model;
    w->objects[0].colour = w->objects[1].colour = grey;
    w->scene.objects = w->objects;
    w->scene.object_count = 2;
    w->scene.ambient = 10000;
}

static void free_world(world *w)
{
    shape_free(&w->ground);
    shape_free(&w->things);
}

/* One time in three a box that is not square, or does not hold everything. */
static gn_status some_light(gn_light *light, const gn_scene *scene)
{
    gn_status status = random_light_above(light, scene, between(0, 1));
    if (status == GN_OK && light->kind == GN_DIRECTIONAL && between(0, 2) == 0) {
        light->box_u += between(0, light->box_width / 2);
        light->box_v += between(0, light->box_height / 2);
        light->box_width = light->box_width / between(1, 4) + 64;
        light->box_height = light->box_height / between(1, 4) + 64;
    }
    return status;
}

static gn_settings some_settings(void)
{
    gn_settings s = gn_default_settings(WIDTH, HEIGHT, 1);
    s.map_width = (uint16_t)(between(0, 3) ? between(2, 70) : 1 << between(0, 8));
    s.map_height = (uint16_t)(between(0, 3) ? between(2, 70) : 1 << between(0, 8));
    s.format = GN_NO_COLOUR;
    s.mask = 1;
    s.surface = GN_MIDPOINT;
    s.fit = fits[between(0, 2)];
    s.warp = between(0, 3) || !s.fit ? warps[between(0, 2)] : 0;
    s.smoothing = between(0, 1) ? 0 : between(1 << 10, 4 << 16);
    return s;
}

static void note_settings(uint64_t n, const gn_settings *s, const gn_light *light)
{
    note("scene %llu: %s, %s, %s light, map %dx%d", (unsigned long long)n, fit_name(s->fit), warp_name(s->warp),
         light->kind == GN_SPOT ? "spot" : "directional", (int)s->map_width, (int)s->map_height);
}

/* ---- samples, one by one ---------------------------------------------------------------------------------------- */

typedef struct sample {
    int seen;      /* on the light's plane */
    uint32_t x, y; /* on the rectangle of this round, 2^-30 of its sides */
    int64_t u, v;  /* the same in fine texels, bits fraction bits */
    int bits;
    uint32_t w, q;
    int surface;
} sample;

static int64_t floor_divide(int64_t n, int64_t d)
{
    return n / d - (n % d < 0);
}

/* (x cosine + y sine), all 2^-30, rounded half up. */
static int64_t turned(int64_t x, int64_t y, int32_t cosine, int32_t sine)
{
    __extension__ typedef __int128 exact;
    exact sum = (exact)x * cosine + (exact)y * sine + (1 << 29);
    return (int64_t)(sum >> 30);
}

/* A spot light's rectangle may reach beyond the frustum. */
static int is_in_frustum(const gn_fitting *f, uint32_t left, uint32_t top)
{
    const gn_rectangle *r = &f->rectangle;
    int64_t x = r->low[0] + floor_divide((int64_t)left * r->size[0], 1 << 30);
    int64_t y = r->low[1] + floor_divide((int64_t)top * r->size[1], 1 << 30);
    int64_t across = turned(x, y, r->cosine, -r->sine), down = turned(y, x, r->cosine, r->sine);
    return !f->fitted || (across >= 0 && across < 1 << 30 && down >= 0 && down < 1 << 30);
}

/* All pixels of a round that has begun and whose one region is the image. */
static void find_samples(gn_context *context, sample samples[PIXELS])
{
    static gn_context fine;
    gn_window window = {0, 0, WIDTH, HEIGHT};
    gn_fitting *f = context->fitting;
    fine = *context; /* its view is that of a map of GN_FINE */
    fine.settings.map_width = fine.settings.map_height = GN_FINE;
    gn_rasterise_region(context, &context->workers[0], &window);
    int first_with_fit = f && f->round == 0 && context->settings.fit;
    for (int32_t i = 0; i < PIXELS; i++) {
        sample *s = &samples[i];
        memset(s, 0, sizeof *s);
        s->q = context->workers[0].q[i];
        if (context->workers[0].triangle[i] == 0xffffffffu)
            continue;
        s->surface = 1;
        s->w = s->q;
        if (!context->camera_view.affine)
            gn_row_of_w(&s->w, 1, context->shading.w_shift);
        point p = find_point(&fine, i % WIDTH, i / WIDTH, s->q);
        s->u = p.u;
        s->v = p.v;
        s->bits = p.bits;
        if (p.where != ON_MAP)
            continue;
        s->x = (uint32_t)(p.u << (18 - p.bits));
        s->y = (uint32_t)(p.v << (18 - p.bits));
        s->seen = 1;
        if (context->light.kind == GN_SPOT)
            s->seen = !f || is_in_frustum(f, s->x, s->y);
        else if (first_with_fit) { /* measured in the larger side */
            int64_t larger = f->light.box_width > f->light.box_height ? f->light.box_width : f->light.box_height;
            s->seen = s->x < ((uint64_t)f->light.box_width << 30) / (uint64_t)larger &&
                      s->y < ((uint64_t)f->light.box_height << 30) / (uint64_t)larger;
        }
    }
}

typedef struct sums_count {
    unsigned failures;
    uint64_t rounds, samples, spots, empty, fitted, grown;
} sums_count;

/* Bounds and extents of all samples. */
static int check_fit_sums(const gn_context *context, const sample samples[PIXELS])
{
    uint32_t bounds[4] = {1u << 30, 1u << 30, 0, 0};
    static gn_extent extents[GN_HULL_COLUMNS];
    memset(extents, 0xff, sizeof extents);
    for (int i = 0; i < PIXELS; i++) {
        const sample *s = &samples[i];
        if (!s->seen)
            continue;
        bounds[0] = s->x < bounds[0] ? s->x : bounds[0];
        bounds[1] = s->y < bounds[1] ? s->y : bounds[1];
        bounds[2] = s->x > bounds[2] ? s->x : bounds[2];
        bounds[3] = s->y > bounds[3] ? s->y : bounds[3];
        uint16_t *margin = extents[s->x >> 18].margin;
        uint32_t row = s->y >> 15;
        margin[0] = (uint16_t)(row < margin[0] ? row : margin[0]);
        margin[1] = (uint16_t)(32767 - row < margin[1] ? 32767 - row : margin[1]);
    }
    if (context->settings.fit == &gn_desired_view)
        return memcmp(bounds, context->fitting->sums, sizeof bounds) == 0;
    const gn_extent *got = (const gn_extent *)(const void *)context->fitting->sums;
    for (int i = 0; i < GN_HULL_COLUMNS; i++) {
        int none = extents[i].margin[0] == 0xffff; /* then any number of GN_HULL_ROWS or more will do */
        for (int k = 0; k < 2; k++)
            if (none ? got[i].margin[k] < GN_HULL_ROWS : got[i].margin[k] != extents[i].margin[k])
                return 0;
    }
    return 1;
}

static uint32_t bin_of(uint32_t place, uint32_t bins)
{
    return (uint32_t)((uint64_t)place * bins >> 30);
}

/* Columns and rows: numbers of samples, or the least distances. */
static int check_rectilinear_sums(const gn_context *context, const sample samples[PIXELS])
{
    uint32_t width = context->settings.map_width, height = context->settings.map_height;
    const uint32_t *got = (const uint32_t *)(const void *)context->fitting->sums;
    int by_distance = context->settings.warp == &gn_rectilinear_distance;
    uint32_t *expected = grown(0, (width + height) * sizeof *expected);
    for (uint32_t i = 0; i < width + height; i++)
        expected[i] = by_distance ? 0xffffffffu : 0;
    for (int i = 0; i < PIXELS; i++) {
        const sample *s = &samples[i];
        if (!s->seen)
            continue;
        uint32_t at[2] = {bin_of(s->x, width), width + bin_of(s->y, height)};
        uint32_t distance = context->camera_view.affine ? 1 : s->w;
        for (int k = 0; k < 2; k++) {
            if (!by_distance)
                expected[at[k]]++;
            else if (distance < expected[at[k]])
                expected[at[k]] = distance;
        }
    }
    int good = memcmp(expected, got, (width + height) * sizeof *expected) == 0;
    free(expected);
    return good;
}

/* The texel of a place in fine texels, by a table: the one whose border, half-way between centres, is the last before
 * it. Places count from the first border with bits fraction bits. */
static uint32_t texel_of(const uint16_t *table, int32_t count, int64_t place, int bits)
{
    int32_t i = 0;
    int64_t twice = 2 * place - ((int64_t)1 << bits); /* from the first fine centre */
    while (i + 1 < count && twice >= ((int64_t)(table[i] + table[i + 1]) << bits))
        i++;
    return (uint32_t)i;
}

/* Samples of each band by columns, or of each column by bands. */
static uint32_t *count_bent(const gn_context *context, const sample samples[PIXELS], int second)
{
    uint32_t width = context->settings.map_width, height = context->settings.map_height;
    uint32_t *count = grown(0, width * height * sizeof *count);
    memset(count, 0, width * height * sizeof *count);
    for (int i = 0; i < PIXELS; i++) {
        const sample *s = &samples[i];
        if (!s->seen)
            continue;
        uint32_t band = (uint32_t)((s->v >> s->bits) * height / GN_FINE);
        if (!second) {
            count[band * width + bin_of(s->x, width)]++;
            continue;
        }
        uint32_t column = texel_of(context->fitting->columns + band * width, (int32_t)width, s->u, s->bits);
        count[column * height + bin_of(s->y, height)]++;
    }
    return count;
}

static int check_bent_sums(const gn_context *context, const sample samples[PIXELS], int second)
{
    uint32_t texels = (uint32_t)context->settings.map_width * context->settings.map_height;
    const uint16_t *got = (const uint16_t *)(const void *)context->fitting->sums;
    uint32_t *expected = count_bent(context, samples, second);
    int wrong = 0;
    for (uint32_t i = 0; i < texels; i++)
        wrong += got[i] != expected[i];
    free(expected);
    return wrong == 0;
}

/* What came of them: the lines that these counts bend, with the settings' smoothing. */
static int check_bent_tables(const gn_context *context, const sample samples[PIXELS], int second)
{
    const gn_settings *s = &context->settings;
    uint32_t lines = second ? s->map_width : s->map_height, bins = second ? s->map_height : s->map_width;
    uint32_t *expected = count_bent(context, samples, second), *scratch = grown(0, bins * 8);
    uint16_t *count = grown(0, lines * bins * sizeof *count), *table = grown(0, lines * bins * sizeof *table);
    for (uint32_t i = 0; i < lines * bins; i++)
        count[i] = (uint16_t)expected[i];
    gn_bend_lines(table, bins, count, lines, bins, s->smoothing ? s->smoothing : 1 << 16, scratch);
    int good =
        memcmp(table, second ? context->fitting->rows : context->fitting->columns, lines * bins * sizeof *table) == 0;
    free(expected);
    free(scratch);
    free(count);
    free(table);
    return good;
}

/* What the pass made of the sums, by the functions that warp_table_test holds. */
static int check_tables(const gn_context *context, const sample samples[PIXELS])
{
    const gn_settings *s = &context->settings;
    uint32_t sides[2] = {s->map_width, s->map_height}, longer = sides[0] > sides[1] ? sides[0] : sides[1];
    const uint16_t *tables[2] = {context->fitting->columns, context->fitting->rows};
    uint32_t *value = grown(0, longer * 4), *scratch = grown(0, longer * 8);
    uint16_t *table = grown(0, longer * 2);
    int good = 1;
    for (int axis = 0; axis < 2; axis++) {
        memset(value, 0, longer * 4);
        for (int i = 0; i < PIXELS; i++)
            if (samples[i].seen)
                value[bin_of(axis ? samples[i].y : samples[i].x, sides[axis])]++;
        gn_importance_of_counts(value, sides[axis]);
        gn_smooth_importance(value, sides[axis], s->smoothing ? s->smoothing : 1 << 16, scratch);
        gn_place_texels(table, sides[axis], value, sides[axis]);
        good &= memcmp(table, tables[axis], sides[axis] * sizeof *table) == 0;
    }
    free(value);
    free(scratch);
    free(table);
    return good;
}

/* The desired view: bounds, no narrower than 1/1024 of the plane, and a texel more on each side, of maps below ten an
 * eighth. Where the formats cannot hold the light's view of that, the narrower side is doubled about its middle: *grown
 * times. */
static int check_desired_view(const gn_context *context, const sample samples[PIXELS], int *grown_by)
{
    const gn_rectangle *r = &context->fitting->rectangle;
    uint32_t texels[2] = {context->settings.map_width, context->settings.map_height};
    int64_t low[2] = {1 << 30, 1 << 30}, high[2] = {-1, -1}, wide[2];
    for (int axis = 0; axis < 2; axis++) {
        for (int i = 0; i < PIXELS; i++) {
            int64_t at = axis ? samples[i].y : samples[i].x;
            if (!samples[i].seen)
                continue;
            low[axis] = at < low[axis] ? at : low[axis];
            high[axis] = at > high[axis] ? at : high[axis];
        }
        int64_t size = high[axis] - low[axis] + 1, least = size < 1 << 20 ? 1 << 20 : size;
        wide[axis] = texels[axis] < 10 ? least + least / 4 : least + 2 * least / (texels[axis] - 2) + 1;
        low[axis] -= (wide[axis] - size) / 2;
    }
    for (*grown_by = 0; *grown_by < 20; ++*grown_by) {
        if (r->low[0] == low[0] && r->low[1] == low[1] && r->size[0] == wide[0] && r->size[1] == wide[1])
            return r->sine == 0 && r->cosine == 1 << 30;
        int narrower = wide[1] < wide[0];
        low[narrower] -= wide[narrower] / 2;
        wide[narrower] *= 2;
    }
    return 0;
}

static int has_samples(const sample samples[PIXELS])
{
    for (int i = 0; i < PIXELS; i++)
        if (samples[i].seen)
            return 1;
    return 0;
}

/* One scene: after each round's one region its sums, and after the round what came of them. */
static void compare_rounds(uint64_t n, sums_count *count)
{
    static sample samples[PIXELS];
    world w;
    frame f;
    gn_light light = {0};
    gn_camera camera;
    gn_settings s = some_settings();
    s.region_height = HEIGHT;
    make_world(&w);
    gn_status status = frame_start(&f, &w.scene, &s);
    if (status == GN_OK)
        status = random_camera(&camera);
    if (status == GN_OK)
        status = some_light(&light, &w.scene);
    if (status == GN_OK)
        status = gn_view_begin(f.context, &camera, &light);
    for (uint32_t round = 0; status == GN_OK && round < f.plan.view_rounds; round++) {
        int fit_round = s.fit && round == 0, second = s.warp == &gn_nonorthogonal && round + 1 == f.plan.view_rounds;
        int grown_by = 0;
        find_samples(f.context, samples);
        status = gn_view_region(f.context, 0, 0);
        int good = fit_round                     ? check_fit_sums(f.context, samples)
                   : s.warp == &gn_nonorthogonal ? check_bent_sums(f.context, samples, second)
                                                 : check_rectilinear_sums(f.context, samples);
        if (status == GN_OK)
            status = gn_view_end(f.context);
        if (fit_round && s.fit == &gn_desired_view && has_samples(samples))
            good &= check_desired_view(f.context, samples, &grown_by);
        if (!fit_round && s.warp == &gn_rectilinear)
            good &= check_tables(f.context, samples);
        if (!fit_round && s.warp == &gn_nonorthogonal)
            good &= check_bent_tables(f.context, samples, second);
        if ((!good || status != GN_OK) && count->failures++ < 5) {
            note_settings(n, &s, &light);
            note("round %u: other sums, or another fit or table, status %d", (unsigned)round, (int)status);
        }
        count->rounds++;
        count->grown += grown_by != 0;
        count->empty += (uint64_t)!has_samples(samples);
        for (int i = 0; i < PIXELS; i++)
            count->samples += (uint64_t)samples[i].seen;
    }
    if (s.warp && status == GN_OK)
        count->failures += !tables_are_monotone(f.context);
    count->spots += light.kind == GN_SPOT;
    count->fitted += f.context && f.context->fitting->fitted;
    if (status != GN_OK && count->failures++ < 5)
        note("scene %llu: status %d", (unsigned long long)n, (int)status);
    if (!frame_end(&f) && count->failures++ < 5)
        note("scene %llu: wrote outside its block", (unsigned long long)n);
    free_world(&w);
}

static void sums_are_those_of_all_pixels(uint64_t cases)
{
    sums_count c;
    memset(&c, 0, sizeof c);
    for (uint64_t n = 0; n < cases && c.failures < 5; n++)
        compare_rounds(n, &c);
    ok(!c.failures, "sums, fits and tables are those of all pixels, one by one: %llu rounds",
       (unsigned long long)c.rounds);
    ok(c.samples > 100 * c.rounds && c.spots > cases / 4 && c.fitted > cases / 4 && c.empty && c.grown < cases / 20,
       "%llu samples, %llu spot lights, %llu fits, %llu of them grown, %llu rounds without a sample",
       (unsigned long long)c.samples, (unsigned long long)c.spots, (unsigned long long)c.fitted,
       (unsigned long long)c.grown, (unsigned long long)c.empty);
}

/* ---- places in double precision --------------------------------------------------------------------------------- */

static double dot(const double a[3], const gn_q2_30 axis[3])
{
    return (a[0] * axis[0] + a[1] * axis[1] + a[2] * axis[2]) / (1 << 30);
}

typedef struct place {
    double p[3];   /* in the world */
    double x, y;   /* on the light's plane, of its larger side */
    double unit;   /* of the world, there */
    double inside; /* how far inside what the light reaches, of the plane's side or of the depth; negative: outside */
    double error;  /* what places may err by (docs/number-formats.md) */
} place;

/* The point that a pixel sees, from its Q, and its place on the light's plane. */
static place find_place(const gn_context *context, const gn_light *light, int32_t pixel, uint32_t q)
{
    const gn_camera *c = &context->camera;
    place at;
    double across = pixel % WIDTH + 0.5 - WIDTH / 2., down = pixel / WIDTH + 0.5 - HEIGHT / 2., p[3], away = 0, w;
    if (c->projection == GN_PERSPECTIVE) {
        double near_w = context->camera_view.near_w, unit = context->camera_view.unit.m;
        unit *= exp2(context->camera_view.unit.e);
        w = near_w / unit * 1073741824.0 / q;
        across *= 2 * w * c->tan_half / 16777216.0 / HEIGHT;
        down *= 2 * w * c->tan_half / 16777216.0 / HEIGHT;
    } else {
        w = c->far_depth - ((double)q - 1024) * ((double)c->far_depth - c->near_depth) / ((1 << 30) - 1024.0);
        across *= 2. * c->half_height / HEIGHT;
        down *= 2. * c->half_height / HEIGHT;
    }
    for (int i = 0; i < 3; i++) {
        p[i] = c->eye[i] + (across * c->right[i] - down * c->up[i] + w * c->forward[i]) / (1 << 30);
        away += (p[i] - c->eye[i]) * (p[i] - c->eye[i]);
    }
    away = sqrt(away);
    memcpy(at.p, p, sizeof p);
    if (light->kind == GN_SPOT) {
        double from[3] = {p[0] - light->position[0], p[1] - light->position[1], p[2] - light->position[2]};
        double depth = dot(from, light->forward), tangent = light->tan_half / 16777216.0;
        at.x = (1 + dot(from, light->right) / (tangent * depth)) / 2;
        at.y = (1 - dot(from, light->up) / (tangent * depth)) / 2;
        at.inside = fmin(fmin(fmin(at.x, 1 - at.x), fmin(at.y, 1 - at.y)),
                         fmin(depth / light->near_depth - 1, 1 - depth / light->far_depth));
        at.unit = 1 / (2 * tangent * depth);
        at.error = (away / (tangent * depth) + 1) / 30000;
        return at;
    }
    double side = light->box_width > light->box_height ? light->box_width : light->box_height;
    at.x = (dot(p, light->right) - light->box_u) / side;
    at.y = (light->box_v + light->box_height - dot(p, light->up)) / side;
    at.inside = fmin(fmin(at.x, light->box_width / side - at.x), fmin(at.y, light->box_height / side - at.y));
    at.inside = fmin(at.inside, (dot(p, light->forward) - light->box_z) / light->box_depth);
    at.unit = 1 / side;
    at.error = (away / side + 1) / 30000 + away / light->box_depth / 30000;
    return at;
}

typedef struct fit_count {
    unsigned failures;
    uint64_t held, turned, smaller, tight, viewed;
} fit_count;

/* Where a place lies in a rectangle, of its sides. */
static void place_in(const gn_rectangle *r, const place *at, double share[2])
{
    double one = 1 << 30, cosine = r->cosine / one, sine = r->sine / one;
    share[0] = (at->x * cosine + at->y * sine - r->low[0] / one) / (r->size[0] / one);
    share[1] = (at->y * cosine - at->x * sine - r->low[1] / one) / (r->size[1] / one);
}

/* Of the samples' bounds along a rectangle's axes, each so many cells of gn_hull.h wider. */
static double area_of_samples(const sample samples[PIXELS], const gn_rectangle *r, double cells)
{
    double low[2] = {4, 4}, high[2] = {-4, -4}, one = 1 << 30, cosine = r->cosine / one, sine = r->sine / one;
    for (int i = 0; i < PIXELS; i++) {
        double x = samples[i].x / one, y = samples[i].y / one;
        double at[2] = {x * cosine + y * sine, y * cosine - x * sine};
        for (int k = 0; samples[i].seen && k < 2; k++) {
            low[k] = fmin(low[k], at[k]);
            high[k] = fmax(high[k], at[k]);
        }
    }
    return (high[0] - low[0] + cells / GN_HULL_COLUMNS) * (high[1] - low[1] + cells / GN_HULL_ROWS);
}

/* The light's view of a fit takes points to where they lie in the rectangle: the points and a box's sides are rounded
 * to whole units of the world. */
static int check_view(gn_context *context, const gn_light *light, const gn_rectangle *r, const sample samples[PIXELS],
                      uint64_t *checked)
{
    const gn_view *view = &context->light_view;
    if (gn_light_begin(context, light) != GN_OK)
        return 0;
    for (int32_t i = 0; i < PIXELS; i++) {
        gn_place projected;
        gn_vertex v;
        double share[2];
        int32_t position[3];
        if (!samples[i].surface)
            continue;
        place at = find_place(context, light, i, samples[i].q);
        if (at.inside < 0.01)
            continue;
        for (int k = 0; k < 3; k++)
            position[k] = (int32_t)floor(at.p[k] + 0.5);
        if (gn_view_place(view, position, &projected) != GN_OK)
            return 0;
        gn_view_project(view, &projected, &v);
        place_in(r, &at, share);
        for (int k = 0; k < 2; k++) {
            double got = (k ? v.y : v.x) / (2. * (k ? view->half_height : view->half_width));
            double unit = at.unit / (r->size[k] / 1073741824.0);
            if (unit > 0.01)
                continue;
            ++*checked;
            if (v.depth == 0 || fabs(got - share[k]) > 4 * unit + 0.001) {
                note("pixel %d: at %.5f of side %d of the view, at %.5f of the rectangle, a unit is %.5f", i, got, k,
                     share[k], unit);
                return 0;
            }
        }
    }
    return 1;
}

/* A fit holds all that is surely seen with a texel to each side; and DV no more than a texel beside what may be. */
static void check_fit(uint64_t n, fit_count *count, double area[2])
{
    static sample samples[PIXELS];
    uint64_t seed = random_state;
    for (int which = 1; which <= 2; which++) {
        world w;
        frame f;
        gn_light light = {0};
        gn_camera camera;
        gn_rectangle r = {0, 0, {0, 0}, {0, 0}};
        gn_settings s = some_settings();
        random_state = seed; /* both fits of the same */
        int side = between(10, 80);
        s.map_width = s.map_height = (uint16_t)side;
        s.fit = fits[which];
        s.warp = 0;
        s.region_height = HEIGHT;
        make_world(&w);
        gn_status status = frame_start(&f, &w.scene, &s);
        if (status == GN_OK)
            status = random_camera(&camera);
        if (status == GN_OK)
            status = some_light(&light, &w.scene);
        if (status == GN_OK)
            status = gn_view_begin(f.context, &camera, &light);
        if (status == GN_OK) {
            find_samples(f.context, samples);
            status = gn_view_region(f.context, 0, 0);
        }
        if (status == GN_OK)
            status = gn_view_end(f.context);
        if (status == GN_OK)
            status = gn_get_rectangle(f.context, &r);
        int fitted = status == GN_OK && f.context->fitting->fitted;
        double least[2] = {1, 1}, most[2] = {0, 0}, error = 0, texel = 1. / side;
        for (int i = 0; fitted && i < PIXELS; i++) {
            if (!samples[i].surface)
                continue;
            place at = find_place(f.context, &light, i, samples[i].q);
            double share[2], slack[2] = {at.error / (r.size[0] / 1073741824.0), at.error / (r.size[1] / 1073741824.0)};
            if (at.inside < -at.error) {
                if (samples[i].seen && count->failures++ < 5)
                    note("scene %llu: pixel %d is beyond the light, and counts", (unsigned long long)n, i);
                continue;
            }
            place_in(&r, &at, share);
            for (int k = 0; k < 2; k++) {
                least[k] = fmin(least[k], share[k]);
                most[k] = fmax(most[k], share[k]);
                error = fmax(error, slack[k]);
            }
            if (at.inside < at.error)
                continue;
            count->held++;
            for (int k = 0; k < 2; k++)
                if ((share[k] < texel * 0.999 - slack[k] || share[k] > 1 - texel * 0.999 + slack[k]) &&
                    count->failures++ < 5) {
                    note_settings(n, &s, &light);
                    note("pixel %d lies at %.5f of side %d, a texel is %.5f, errors %.5f", i, share[k], k, texel,
                         slack[k]);
                }
        }
        int grown_by = 0;
        if (fitted && which == 1)
            count->failures += !check_desired_view(f.context, samples, &grown_by);
        for (int k = 0; fitted && which == 1 && !grown_by && k < 2; k++)
            if (r.size[k] > (1 << 21) && error < 0.05 && most[k] > least[k]) { /* not held at the least side */
                count->tight++;
                if ((least[k] > texel + 2 * error || most[k] < 1 - texel - 2 * error) && count->failures++ < 5) {
                    note_settings(n, &s, &light);
                    note("side %d: samples from %.5f to %.5f, a texel is %.5f, errors %.5f", k, least[k], most[k],
                         texel, error);
                }
            }
        count->turned += fitted && r.sine != 0;
        if (fitted && !check_view(f.context, &light, &r, samples, &count->viewed) && count->failures++ < 5)
            note_settings(n, &s, &light);
        area[which - 1] = fitted ? area_of_samples(samples, &r, which == 1 ? 2 : 0) : 9;
        if (status != GN_OK && count->failures++ < 5)
            note("scene %llu: status %d", (unsigned long long)n, (int)status);
        count->failures += !frame_end(&f);
        free_world(&w);
    }
}

static void fits_hold_what_is_seen(uint64_t cases)
{
    fit_count c;
    memset(&c, 0, sizeof c);
    for (uint64_t n = 0; n < cases && c.failures < 5; n++) {
        double area[2];
        check_fit(n, &c, area);
        c.smaller += area[1] < 0.9 * area[0];
        /* the one is the least about whole cells, the other's bounds are at most two cells less than these' */
        if (area[1] < 9 && area[1] > area[0] && c.failures++ < 5)
            note("scene %llu: the minimal frustum's area is %.8f, the desired view's %.8f", (unsigned long long)n,
                 area[1], area[0]);
    }
    ok(!c.failures, "fits hold what is seen, and a texel to each side: %llu pixels", (unsigned long long)c.held);
    ok(c.held > 50 * cases && c.turned > cases / 4 && c.smaller > cases / 8 && c.tight > cases / 4 &&
           c.viewed > 50 * cases,
       "%llu turned, %llu much smaller than the desired view, of which %llu sides are tight",
       (unsigned long long)c.turned, (unsigned long long)c.smaller, (unsigned long long)c.tight);
}

/* ---- regions, workers, order ------------------------------------------------------------------------------------ */

static uint64_t hash_found(const gn_context *context)
{
    const gn_fitting *f = context->fitting;
    const uint8_t *bytes = (const uint8_t *)&f->rectangle;
    uint64_t h = 1;
    for (size_t i = 0; i < sizeof f->rectangle; i++)
        h = (h ^ bytes[i]) * UINT64_C(0x100000001b3);
    for (size_t i = 0; i < context->plan.warp_bytes / 2; i++)
        h = (h ^ f->columns[i]) * UINT64_C(0x100000001b3); /* rows follow */
    return h;
}

typedef struct job {
    gn_context *context;
    uint32_t worker, workers;
    gn_status status;
} job;

/* Every workers-th region, the last one first. */
static void *see_regions(void *argument)
{
    job *j = argument;
    for (uint32_t i = j->context->plan.camera_regions; i-- > 0;)
        if (i % j->workers == j->worker) {
            gn_status status = gn_view_region(j->context, i, j->worker);
            j->status = status != GN_OK ? status : j->status;
        }
    return 0;
}

static gn_status view_pass_on_threads(gn_context *context, const gn_camera *camera, const gn_light *light)
{
    uint32_t workers = context->settings.workers;
    gn_status status = gn_view_begin(context, camera, light);
    for (uint32_t round = 0; status == GN_OK && round < context->plan.view_rounds; round++) {
        pthread_t thread[8];
        job jobs[8];
        for (uint32_t i = 0; i < workers; i++) {
            job j = {context, i, workers, GN_OK};
            jobs[i] = j;
            if (pthread_create(&thread[i], 0, see_regions, &jobs[i]))
                abort();
        }
        for (uint32_t i = 0; i < workers; i++) {
            pthread_join(thread[i], 0);
            status = jobs[i].status != GN_OK ? jobs[i].status : status;
        }
        if (status == GN_OK)
            status = gn_view_end(context);
    }
    return status;
}

static void what_is_found_does_not_depend_on_regions_and_workers(uint64_t cases)
{
    uint64_t different = 0, last = 0;
    unsigned failures = 0;
    for (uint64_t n = 0; n < cases; n++) {
        world w;
        gn_light light = {0};
        gn_camera camera;
        gn_settings settings = some_settings();
        uint64_t first = 0;
        make_world(&w);
        gn_status made = random_camera(&camera);
        if (made == GN_OK)
            made = some_light(&light, &w.scene);
        for (int variant = 0; variant < 4; variant++) { /* regions, workers, and a pass after another one */
            gn_settings s = settings;
            gn_camera other = camera;
            frame f;
            if (variant) {
                s.region_width = (uint16_t)between(1, WIDTH);
                s.region_height = (uint16_t)between(1, HEIGHT);
                s.workers = (uint8_t)(variant == 2 ? between(2, 8) : 1);
            }
            gn_status status = made == GN_OK ? frame_start(&f, &w.scene, &s) : made;
            other.eye[0] += 300;
            if (status == GN_OK && variant == 3) /* leaves nothing behind */
                status = gn_view_pass(f.context, &other, &light);
            if (status == GN_OK && variant == 3)
                status = gn_light_pass(f.context, &light);
            if (status == GN_OK)
                status = variant == 2 ? view_pass_on_threads(f.context, &camera, &light)
                                      : gn_view_pass(f.context, &camera, &light);
            uint64_t hash = status == GN_OK ? hash_found(f.context) : 0;
            if (variant == 0)
                first = hash;
            if ((status != GN_OK || hash != first) && failures++ < 3) {
                note_settings(n, &s, &light);
                note("variant %d: another fit or table, status %d", variant, (int)status);
            }
            failures += !frame_end(&f);
        }
        different += first != last;
        last = first;
        free_world(&w);
    }
    ok(!failures && different > cases * 3 / 4, "what is found does not depend on regions, workers, order: %llu differ",
       (unsigned long long)different);
}

/* ---- little or nothing seen ------------------------------------------------------------------------------------- */

static int is_whole(const gn_rectangle *r)
{
    return r->cosine == 1 << 30 && r->sine == 0 && r->low[0] == 0 && r->low[1] == 0 && r->size[0] == 1 << 30 &&
           r->size[1] == 1 << 30;
}

/* Texel i of n lies at the centre of an n-th of the side, cut to a fine texel. */
static int is_even(const uint16_t *table, int32_t count)
{
    for (int32_t i = 0; i < count; i++)
        if (table[i] != (2 * i + 1) * GN_FINE / (2 * count))
            return 0;
    return 1;
}

static void nothing_seen_leaves_the_whole_plane(void)
{
    for (int empty = 0; empty < 2; empty++)
        for (int fit = 0; fit < 3; fit++)
            for (int warp = -1; warp < 3; warp++) {
                world w;
                frame f;
                gn_light light;
                gn_camera camera;
                gn_rectangle r;
                int32_t eye[3] = {0, -2000, 2000}, target[3] = {0, -4000, 4000}, up[3] = {0, 0, 1};
                int32_t direction[3] = {100, 300, -1000};
                uint64_t lit = 0, shadowed = 0;
                if (fit == 0 && warp < 0)
                    continue;
                gn_settings s = gn_default_settings(WIDTH, HEIGHT, 20);
                s.map_height = 33;
                s.mask = 1;
                s.surface = GN_CONSTANT;
                s.bias.value = 2 << 16;
                s.fit = fits[fit];
                s.warp = warp < 0 ? 0 : warps[warp];
                make_world(&w);
                if (empty)
                    w.scene.object_count = 0;
                gn_directional_light(&light, direction, 0);
                gn_fit_light(&light, &w.scene);
                gn_look_at(&camera, eye, target, up);
                gn_perspective(&camera, GN_DEGREES(50), 100, 1 << 16);
                gn_status status = frame_start(&f, &w.scene, &s);
                if (status == GN_OK)
                    status = gn_view_pass(f.context, &camera, &light);
                int good = status == GN_OK && gn_get_rectangle(f.context, &r) == GN_OK && is_whole(&r);
                for (int32_t band = 0; good && warp >= 0 && band < (warp == 2 ? 33 : 1); band++)
                    good &= is_even(f.context->fitting->columns + 20 * band, 20);
                for (int32_t column = 0; good && warp >= 0 && column < (warp == 2 ? 20 : 1); column++)
                    good &= is_even(f.context->fitting->rows + 33 * column, 33);
                /* and another camera's picture is that of the whole plane */
                int32_t middle[3] = {0, 0, 0};
                gn_look_at(&camera, eye, middle, up);
                if (status == GN_OK)
                    status = frame_render(&f, &light, &camera);
                count_mask(&f, &lit, &shadowed);
                good &= status == GN_OK && (empty || lit > 10);
                ok(good && frame_end(&f), "%s: %s, %s: the whole plane, evenly",
                   empty ? "no object" : "a camera that looks away", fit_name(s.fit), warp_name(s.warp));
                free_world(&w);
            }
}

/* All that is seen is one tiny triangle, or a wall that stands in the light's direction. */
static void little_seen_is_still_a_map(uint64_t cases)
{
    uint64_t tiny = 0, walls = 0, lit = 0, dark = 0, seen = 0;
    unsigned failures = 0;
    for (uint64_t n = 0; n < cases; n++) {
        shape s = shape_new(0);
        gn_object object = {&s.mesh, 0, {9, 9, 9}};
        gn_scene scene = {&object, 1, {0, 0, 0}, 0};
        frame f;
        gn_light light;
        gn_camera camera;
        int wall = between(0, 1), spot = between(0, 1);
        int32_t x = between(-700, 700), y = between(-700, 700), size = wall ? 500 : between(1, 3);
        int32_t position[3] = {x, y, 3000}, target[3] = {x, y, 0}, down[3] = {0, 0, -1}, up[3] = {0, 1, 0};
        /* something far off, so that the plane is large */
        add_vertex(&s, -1000, -1000, -600), add_vertex(&s, 1000, 1000, -600), add_vertex(&s, 999, 1000, -600);
        add_vertex(&s, x, y, 0), add_vertex(&s, x + size, y, wall ? 300 : 0);
        add_vertex(&s, x + (wall ? 0 : size), y + (wall ? 0 : size), 400 * wall);
        add_triangle(&s, 0, 1, 2);
        add_triangle(&s, 3, 4, 5);
        gn_settings settings = some_settings();
        settings.receiver = settings.map_width > 1 && settings.map_height > 1 ? &gn_virtual_always : 0;
        settings.surface = GN_CONSTANT;
        gn_directional_light(&light, down, up);
        gn_status status = gn_fit_light(&light, &scene);
        if (spot)
            status = gn_spot_light(&light, position, target, up, GN_DEGREES(80), 300, 6000);
        int32_t eye[3] = {x + 20, y - (wall ? 900 : 20), wall ? 200 : 40}, at[3] = {x + size / 2, y, wall ? 200 : 0};
        int32_t upright[3] = {0, 0, 1};
        if (status == GN_OK)
            status = gn_look_at(&camera, eye, at, upright);
        if (status == GN_OK)
            status = gn_perspective(&camera, GN_DEGREES(40), 40, 1 << 14);
        if (wall)
            camera.far_depth = 1200; /* not the thing far off */
        if (status == GN_OK)
            status = frame_start(&f, &scene, &settings);
        if (status == GN_OK)
            status = gn_view_pass(f.context, &camera, &light);
        if (status == GN_OK && settings.warp)
            failures += !tables_are_monotone(f.context);
        if (status == GN_OK)
            status = frame_render(&f, &light, &camera);
        if (status != GN_OK && failures++ < 5) {
            note_settings(n, &settings, &light);
            note("%s: status %d", wall ? "wall" : "tiny triangle", (int)status);
        }
        if (status == GN_OK) {
            uint64_t before = lit + dark, dark_before = dark;
            count_mask(&f, &lit, &dark);
            seen += lit + dark > before;
            failures += !wall && settings.receiver && dark != dark_before;
            tiny += (uint64_t)!wall;
            walls += (uint64_t)wall;
        }
        failures += !frame_end(&f);
        shape_free(&s);
    }
    ok(!failures && tiny > cases / 4 && walls > cases / 4 && seen > cases / 2 && lit > cases / 2,
       "one texel or one column seen: %llu tiny triangles, %llu walls along the light; %llu pixels lit, %llu not",
       (unsigned long long)tiny, (unsigned long long)walls, (unsigned long long)lit, (unsigned long long)dark);
}

/* ---- all shapes, and all that moves ----------------------------------------------------------------------------- */

static const gn_receiver *const receivers[] = {0, &gn_plane_bias, &gn_virtual, &gn_virtual_always};
static const gn_reconstruction *const reconstructions[] = {
    &gn_bilinear,           &gn_box_3x3,  &gn_box_5x5, &gn_box_7x7, &gn_jitter_4x4, &gn_silhouettes,
    &gn_silhouettes_smooth, &gn_crossings};

/* The mask, by one more pass. */
static uint64_t hash_mask(const frame *f)
{
    uint64_t h = 1;
    for (size_t i = 0; i < mask_bytes(f); i++)
        h = (h ^ f->mask[i]) * UINT64_C(0x100000001b3);
    return h;
}

/* Models move between all passes, the camera pass has another camera, the light pass another light of the same kind.
 * Nothing is right then, but all of it is defined: the same twice, and nothing beyond the map is read (sanitized builds
 * say so). */
static void whatever_moves_is_defined(uint64_t cases)
{
    static const gn_warp *const all[] = {&gn_rectilinear, &gn_rectilinear_distance, &gn_nonorthogonal,
                                         &gn_rectilinear_vertices, &gn_nonorthogonal_vertices};
    uint64_t lit = 0, shadowed = 0, beyond = 0;
    unsigned failures = 0, refused = 0;
    for (uint64_t n = 0; n < cases; n++) {
        static const uint16_t sides[] = {1, 2, 3, 5, 64, 300, 4096};
        world w;
        gn_light light[2];
        gn_camera camera[2];
        gn_settings s = some_settings();
        gn_model still, moved[2];
        uint64_t hash[2] = {0, 0};
        s.map_width = sides[between(0, 6)];
        s.map_height = s.map_width == 4096 ? sides[between(0, 3)] : sides[between(0, 6)];
        s.warp = between(0, 4) || !s.fit ? all[between(0, 4)] : 0;
        s.surface = (uint8_t)between(GN_CONSTANT, GN_SLOPE);
        s.slope = 1 << 16;
        s.receiver = receivers[between(0, 3)];
        s.reconstruction = between(0, 1) ? 0 : reconstructions[between(0, 7)];
        s.map_rows = (uint16_t)(between(0, 1) ? 0 : between(1, s.map_height));
        make_world(&w);
        still = w.model;
        for (int i = 0; i < 2; i++) {
            moved[i] = still;
            (void)gn_model_translate(&moved[i], between(-500, 500), between(-500, 500), between(-200, 500));
        }
        int spot = between(0, 1);
        gn_status made = random_camera(&camera[0]);
        if (made == GN_OK)
            made = random_camera(&camera[1]);
        for (int i = 0; made == GN_OK && i < 2; i++)
            made = random_light_above(&light[i], &w.scene, spot);
        for (int time = 0; time < 2; time++) {
            frame f;
            w.model = still;
            gn_status status = made == GN_OK ? frame_start(&f, &w.scene, &s) : made;
            if (status == GN_UNSUPPORTED) {
                refused++;
                break;
            }
            if (status == GN_OK)
                status = gn_view_pass(f.context, &camera[0], &light[0]);
            w.model = moved[0];
            if (status == GN_OK)
                status = gn_light_pass(f.context, &light[0]);
            w.model = moved[1];
            if (status == GN_OK)
                status = gn_camera_pass(f.context, &camera[1], frame_flush, &f);
            if (status == GN_OK)
                status = frame_render(&f, &light[1], &camera[1]); /* and all anew but the view */
            hash[time] = status == GN_OK ? hash_mask(&f) : (uint64_t)status;
            if (status == GN_OK)
                count_mask(&f, &lit, &shadowed);
            beyond += status == GN_OUT_OF_RANGE; /* a fit that is too narrow for this camera or light */
            if (status != GN_OK && status != GN_OUT_OF_RANGE && failures++ < 5) {
                note_settings(n, &s, &light[0]);
                note("status %d", (int)status);
            }
            failures += !frame_end(&f);
        }
        failures += hash[0] != hash[1];
        free_world(&w);
    }
    ok(!failures && lit > 50 * cases && shadowed > 20 * cases && refused < cases * 3 / 4 && beyond < cases / 20,
       "whatever moves between the passes: the same twice; %llu pixels lit, %llu shadowed; %u of %llu refused",
       (unsigned long long)lit, (unsigned long long)shadowed, refused, (unsigned long long)cases);
}

/* ---- spot lights ------------------------------------------------------------------------------------------------- */

/* Open ground alone, larger than the cone: what a fit changes of it. Beyond the frustum, also within a turned
 * rectangle, it is unlit; within, colours are the uniform map's but for a unit, but at the border. */
static void a_spot_lights_fall_off_is_that_of_its_frustum(uint64_t cases)
{
    uint64_t lit = 0, unlit = 0, within = 0, border = 0;
    unsigned failures = 0;
    for (uint64_t n = 0; n < cases; n++) {
        static sample samples[PIXELS];
        shape ground = shape_new(0);
        gn_object object = {&ground.mesh, 0, {255, 255, 255}};
        gn_scene scene = {&object, 1, {0, 0, 0}, 0};
        frame f, uniform;
        gn_light light;
        gn_camera camera;
        gn_rectangle r = {0, 0, {0, 0}, {0, 0}};
        int32_t eye[3] = {between(-1500, 1500), between(-1500, -600), between(300, 2000)}, up[3] = {0, 0, 1};
        int32_t target[3] = {between(-600, 600), between(-500, 600), 0};
        int32_t position[3] = {between(-600, 600), between(-600, 600), between(900, 2500)};
        int32_t aim[3] = {between(-300, 300), between(-300, 300), 0};
        add_level(&ground, -9000, -9000, 9000, 9000, 0, 1);
        gn_settings s = some_settings(), plain;
        s.map_width = (uint16_t)between(12, 70);
        s.map_height = (uint16_t)between(12, 70);
        s.format = GN_RGB888;
        s.surface = GN_CONSTANT;
        s.region_height = HEIGHT;
        s.receiver = &gn_virtual_always;
        s.bias.unit = GN_BIAS_RANGE;
        s.bias.value = 1u << 24;
        plain = s;
        plain.fit = 0;
        plain.warp = 0;
        gn_status status = gn_look_at(&camera, eye, target, up);
        if (status == GN_OK)
            status = gn_perspective(&camera, GN_DEGREES(between(20, 60)), 100, 1 << 15);
        if (status == GN_OK)
            status = gn_spot_light(&light, position, aim, 0, GN_DEGREES(between(20, 60)), 200, 8000);
        if (status == GN_OK)
            status = frame_start(&f, &scene, &s);
        if (status == GN_OK)
            status = frame_start(&uniform, &scene, &plain);
        if (status == GN_OK)
            status = gn_view_pass(f.context, &camera, &light);
        if (status == GN_OK)
            status = frame_render(&f, &light, &camera);
        if (status == GN_OK)
            status = frame_render(&uniform, &light, &camera);
        if (status == GN_OK)
            status = gn_get_rectangle(f.context, &r);
        if (status == GN_OK) /* what each pixel sees */
            status = gn_camera_begin(uniform.context, &camera);
        if (status == GN_OK)
            find_samples(uniform.context, samples);
        for (int i = 0; status == GN_OK && i < PIXELS; i++) {
            if (!samples[i].surface)
                continue;
            place at = find_place(uniform.context, &light, i, samples[i].q);
            double share[2];
            int near_border = fabs(at.inside) <= at.error, wrong = 0;
            place_in(&r, &at, share);
            border += (uint64_t)near_border;
            if (near_border)
                continue;
            within += at.inside < 0 && share[0] > 0 && share[0] < 1 && share[1] > 0 && share[1] < 1;
            wrong = f.mask[i] != (at.inside > 0 ? 254 : 0) || f.mask[i] != uniform.mask[i];
            lit += f.mask[i] == 254;
            unlit += f.mask[i] == 0;
            for (int k = 0; k < 3; k++)
                wrong |= abs(f.colour[3 * i + k] - uniform.colour[3 * i + k]) > 1;
            if (wrong && failures++ < 5) {
                note_settings(n, &s, &light);
                note("pixel (%d, %d), %.4f inside: mask %d, uniform %d; colour %d, uniform %d", i % WIDTH, i / WIDTH,
                     at.inside, (int)f.mask[i], (int)uniform.mask[i], (int)f.colour[3 * i], (int)uniform.colour[3 * i]);
            }
        }
        if (status != GN_OK && failures++ < 5)
            note("scene %llu: status %d", (unsigned long long)n, (int)status);
        failures += !frame_end(&f) || !frame_end(&uniform);
        shape_free(&ground);
    }
    ok(!failures, "a fitted spot light's ground is that of the uniform map");
    ok(lit > 50 * cases && unlit > 50 * cases && within > cases && border < (lit + unlit) / 100,
       "%llu pixels lit, %llu unlit, of which %llu within the rectangle; %llu at the frustum's border",
       (unsigned long long)lit, (unsigned long long)unlit, (unsigned long long)within, (unsigned long long)border);
}

/* ---- statuses, plans, memory ------------------------------------------------------------------------------------ */

static gn_status plan_of(gn_plan *plan, const gn_settings *s)
{
    shape ground = shape_new(0);
    gn_object object = {&ground.mesh, 0, {0, 0, 0}};
    gn_scene scene = {&object, 1, {0, 0, 0}, 0};
    add_level(&ground, -100, -100, 100, 100, 0, 1);
    gn_status status = gn_make_plan(plan, &scene, s);
    shape_free(&ground);
    return status;
}

static void settings_are_refused(void)
{
    static const gn_warp *const bent[] = {&gn_nonorthogonal, &gn_nonorthogonal_vertices};
    static const gn_reconstruction *const all[] = {
        &gn_bilinear,           &gn_box_3x3,  &gn_box_5x5, &gn_box_7x7, &gn_jitter_4x4, &gn_silhouettes,
        &gn_silhouettes_smooth, &gn_crossings};
    gn_settings plain = gn_default_settings(32, 32, 16), s;
    gn_plan plan;
    int good = 1;
    for (int b = 0; b < 2; b++) {
        for (size_t i = 0; i < sizeof all / sizeof all[0]; i++) {
            s = plain;
            s.warp = bent[b];
            s.reconstruction = all[i];
            good &= plan_of(&plan, &s) == GN_UNSUPPORTED;
            s.warp = &gn_rectilinear;
            good &= plan_of(&plan, &s) != GN_UNSUPPORTED;
        }
        s = plain;
        s.warp = bent[b];
        s.surface = GN_SLOPE;
        good &= plan_of(&plan, &s) == GN_UNSUPPORTED;
        s.surface = GN_DUAL;
        good &= plan_of(&plan, &s) == GN_OK;
        s.receiver = &gn_plane_bias;
        good &= plan_of(&plan, &s) == GN_UNSUPPORTED;
        s.receiver = &gn_virtual;
        good &= plan_of(&plan, &s) == GN_OK;
        s.receiver = &gn_virtual_always;
        good &= plan_of(&plan, &s) == GN_OK;
    }
    ok(good, "non-orthogonal warps refuse reconstructions, slopes and plane bias, and nothing else");
    static const struct {
        gn_q16_16 smoothing;
        gn_status status;
    } range[] = {{0, GN_OK},
                 {1 << 10, GN_OK},
                 {64 << 16, GN_OK},
                 {(1 << 10) - 1, GN_OUT_OF_RANGE},
                 {-1, GN_OUT_OF_RANGE},
                 {1, GN_OUT_OF_RANGE},
                 {(64 << 16) + 1, GN_OUT_OF_RANGE}};
    good = 1;
    for (size_t i = 0; i < sizeof range / sizeof range[0]; i++) {
        s = plain;
        s.warp = &gn_rectilinear;
        s.smoothing = range[i].smoothing;
        good &= plan_of(&plan, &s) == range[i].status;
    }
    ok(good, "smoothing is 1/64 to 64, or 0");
    s = plain;
    s.fit = &gn_desired_view;
    s.fit_depth = 2;
    ok(plan_of(&plan, &s) == GN_BAD_ARGUMENT, "fit_depth is 0 or 1");
    s = plain;
    s.fit = &gn_desired_view;
    s.receiver = &gn_virtual;
    s.map_height = 1;
    ok(plan_of(&plan, &s) == GN_UNSUPPORTED, "a receiver and a map of one row");
}

static void plans_say_what_is_needed(void)
{
    gn_settings s = gn_default_settings(64, 48, 20);
    gn_plan plain, plan;
    s.map_height = 30;
    int good = plan_of(&plain, &s) == GN_OK && plain.view_bytes == 0 && plain.warp_bytes == 0 && plain.view_rounds == 0;
    ok(good, "neither fit nor warp: no view pass, no bytes");
    for (int fit = 0; fit < 3; fit++)
        for (int warp = -1; warp < 3; warp++) {
            if (fit == 0 && warp < 0)
                continue;
            s.fit = fits[fit];
            s.warp = warp < 0 ? 0 : warps[warp];
            good = plan_of(&plan, &s) == GN_OK;
            size_t tables = warp < 0 ? 0 : warp < 2 ? 2 * (20 + 30) : 4 * 20 * 30;
            good &= plan.warp_bytes == tables && plan.view_rounds == (fit > 0) + (warp < 0 ? 0 : warp < 2 ? 1 : 2);
            good &=
                plan.map_bytes == plain.map_bytes && plan.bytes >= plan.view_bytes && plan.bytes >= plan.light_bytes &&
                plan.bytes >= plan.camera_bytes && plan.view_bytes > 0 &&
                (plan.bytes == plan.view_bytes || plan.bytes == plan.light_bytes || plan.bytes == plan.camera_bytes);
            good &= plan.light_bytes >= plain.light_bytes + tables && plan.camera_bytes >= plain.camera_bytes + tables;
            ok(good, "%s, %s: %u rounds, %lu bytes of tables, %lu for the view pass", fit_name(s.fit),
               warp_name(s.warp), (unsigned)plan.view_rounds, (unsigned long)plan.warp_bytes,
               (unsigned long)plan.view_bytes);
        }
}

/* Every call out of its order. */
static void calls_out_of_order_are_refused(void)
{
    world w;
    frame f, plain;
    gn_light light, bad_light;
    gn_camera camera, bad_camera;
    gn_rectangle r;
    gn_pixels pixels;
    uint32_t centre[2];
    int32_t direction[3] = {100, 300, -1000}, eye[3] = {0, -2000, 2000}, middle[3] = {0, 0, 0}, up[3] = {0, 0, 1};
    gn_settings s = gn_default_settings(WIDTH, HEIGHT, 20), volumes;
    s.mask = 1;
    s.surface = GN_MIDPOINT;
    s.region_height = 10;
    make_world(&w);
    gn_directional_light(&light, direction, 0);
    gn_fit_light(&light, &w.scene);
    gn_look_at(&camera, eye, middle, up);
    gn_perspective(&camera, GN_DEGREES(50), 100, 1 << 16);
    bad_light = light;
    bad_light.box_width = 0;
    bad_camera = camera;
    bad_camera.near_depth = 0;
    int good = frame_start(&plain, &w.scene, &s) == GN_OK;
    good &= gn_view_begin(plain.context, &camera, &light) == GN_UNSUPPORTED;
    good &= gn_view_pass(plain.context, &camera, &light) == GN_UNSUPPORTED;
    good &= gn_view_region(plain.context, 0, 0) == GN_UNSUPPORTED && gn_view_end(plain.context) == GN_UNSUPPORTED;
    good &= gn_get_rectangle(plain.context, &r) == GN_UNSUPPORTED && !gn_texel_place(plain.context, 0, 0, centre);
    ok(good && frame_end(&plain), "without a fit or a warp there is no view pass");
    volumes = s;
    volumes.shadow = GN_SHADOW_VOLUMES;
    volumes.fit = &gn_desired_view;
    w.scene.object_count = 0;
    good = frame_start(&plain, &w.scene, &volumes) == GN_OK;
    good &= gn_view_begin(plain.context, &camera, &light) == GN_UNSUPPORTED;
    ok(good && frame_end(&plain), "nor with shadow volumes");
    w.scene.object_count = 2;
    s.fit = &gn_minimal_frustum;
    s.warp = &gn_nonorthogonal;
    good = frame_start(&f, &w.scene, &s) == GN_OK && f.plan.camera_regions == 3 && f.plan.view_rounds == 3;
    gn_context *c = f.context;
    good &= gn_light_begin(c, &light) == GN_NOT_READY && gn_light_pass(c, &light) == GN_NOT_READY;
    good &= gn_camera_begin(c, &camera) == GN_NOT_READY && gn_get_rectangle(c, &r) == GN_NOT_READY;
    good &= gn_view_region(c, 0, 0) == GN_NOT_READY && gn_view_end(c) == GN_NOT_READY;
    good &= !gn_texel_place(c, 0, 0, centre);
    ok(good, "nothing before the view pass");
    good = gn_view_begin(0, &camera, &light) == GN_BAD_ARGUMENT && gn_view_begin(c, 0, &light) == GN_BAD_ARGUMENT &&
           gn_view_begin(c, &camera, 0) == GN_BAD_ARGUMENT && gn_view_end(0) == GN_BAD_ARGUMENT &&
           gn_view_region(0, 0, 0) == GN_BAD_ARGUMENT && gn_get_rectangle(c, 0) == GN_BAD_ARGUMENT &&
           gn_get_rectangle(0, &r) == GN_BAD_ARGUMENT;
    good &= gn_view_begin(c, &bad_camera, &light) == GN_OUT_OF_RANGE && gn_view_region(c, 0, 0) == GN_NOT_READY;
    good &= gn_view_begin(c, &camera, &bad_light) == GN_OUT_OF_RANGE && gn_view_end(c) == GN_NOT_READY;
    ok(good, "null pointers, a bad camera, a bad light");
    for (int round = 0; round < 3; round++) {
        if (round == 0)
            good = gn_view_begin(c, &camera, &light) == GN_OK;
        good &= gn_view_region(c, 3, 0) == GN_BAD_ARGUMENT && gn_view_region(c, 0, 1) == GN_BAD_ARGUMENT;
        good &= gn_camera_begin(c, &camera) == GN_NOT_READY && gn_light_layers(c, 0, 0) == GN_NOT_READY;
        good &= gn_get_rectangle(c, &r) == GN_NOT_READY;
        for (uint32_t i = 3; i-- > 0;)
            good &= gn_view_region(c, i, 0) == GN_OK;
        good &= gn_view_end(c) == GN_OK;
        good &= gn_camera_begin(c, &camera) == GN_NOT_READY;
    }
    ok(good, "three rounds, regions and workers that do not exist, no other pass in between");
    good = gn_view_region(c, 0, 0) == GN_NOT_READY && gn_view_end(c) == GN_NOT_READY;
    good &= gn_get_rectangle(c, &r) == GN_OK && gn_texel_place(c, 19, 19, centre) &&
            !gn_texel_place(c, 20, 0, centre) && !gn_texel_place(c, 0, 20, centre);
    good &= frame_render(&f, &light, &camera) == GN_OK && frame_render(&f, &light, &camera) == GN_OK;
    ok(good, "then light and camera passes, as often as wanted");
    good = gn_view_begin(c, &camera, &light) == GN_OK && gn_camera_begin(c, &camera) == GN_NOT_READY &&
           gn_camera_region(c, 0, 0, 0, f.mask, &pixels) == GN_NOT_READY && gn_light_begin(c, &light) == GN_NOT_READY;
    good &= gn_view_region(c, 0, 0) == GN_NOT_READY; /* the light pass has ended it */
    good &= gn_view_pass(c, &camera, &light) == GN_OK && gn_camera_begin(c, &camera) == GN_NOT_READY;
    good &= frame_render(&f, &light, &camera) == GN_OK;
    ok(good, "a second view pass takes the map away until the next light pass");
    good = gn_view_begin(c, &bad_camera, &light) == GN_OUT_OF_RANGE && gn_light_pass(c, &light) == GN_NOT_READY;
    ok(good && frame_end(&f), "one that failed leaves no fit");
    free_world(&w);
}

static void a_block_of_the_least_size_will_do(uint64_t cases)
{
    unsigned failures = 0;
    for (uint64_t n = 0; n < cases; n++) {
        world w;
        frame f;
        gn_context *context;
        gn_settings s = some_settings();
        s.workers = (uint8_t)between(1, 4);
        make_world(&w);
        gn_status status = frame_start(&f, &w.scene, &s);
        failures += status != GN_OK;
        failures += gn_init(&context, &w.scene, &s, f.block + GUARD_BYTES, f.bytes - 1) != GN_TOO_SMALL;
        failures += gn_init(&context, &w.scene, &s, f.block + GUARD_BYTES + 1, f.bytes) != GN_MISALIGNED;
        failures += !frame_end(&f);
        free_world(&w);
    }
    ok(!failures, "a byte less is too small, a byte off is misaligned");
}

int main(int argc, char **argv)
{
    uint64_t cases = tap_cases(argc, argv, 600);
    settings_are_refused();
    plans_say_what_is_needed();
    calls_out_of_order_are_refused();
    nothing_seen_leaves_the_whole_plane();
    sums_are_those_of_all_pixels(cases);
    fits_hold_what_is_seen(cases);
    what_is_found_does_not_depend_on_regions_and_workers(cases / 2);
    little_seen_is_still_a_map(cases);
    whatever_moves_is_defined(cases);
    a_spot_lights_fall_off_is_that_of_its_frustum(cases / 4);
    a_block_of_the_least_size_will_do(cases / 10);
    return tap_done();
}
