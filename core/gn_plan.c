/* Planning: what a scene needs, checked and laid out before anything is rendered. */
#include "gn_cascade.h"
#include "gn_drawing.h"
#include "gn_parameterisation.h"
#include "gn_volumes.h"

gn_settings gn_default_settings(uint16_t width, uint16_t height, uint16_t map_size)
{
    gn_settings s = {0};
    s.width = width;
    s.height = height;
    s.map_width = s.map_height = map_size;
    s.surface = GN_SECOND;
    s.format = GN_RGB888;
    s.workers = 1;
    s.bias.unit = GN_BIAS_TEXELS;
    return s;
}

static gn_status check_settings(const gn_settings *s)
{
    if (s->width < 1 || s->width > GN_MAX_SIZE || s->height < 1 || s->height > GN_MAX_SIZE || s->map_width < 1 ||
        s->map_width > GN_MAX_SIZE || s->map_height < 1 || s->map_height > GN_MAX_SIZE || s->workers < 1 ||
        s->workers > 64 || s->region_width > GN_MAX_SIZE || s->region_height > GN_MAX_SIZE || s->map_rows > GN_MAX_SIZE)
        return GN_OUT_OF_RANGE;
    if (s->cull > GN_CULL_FRONT || s->layers > GN_LAYERS_TWO || s->surface > GN_SLOPE || s->format > GN_RGB565 ||
        s->mask > 1 || s->bias.unit > GN_BIAS_RANGE || s->shadow > GN_SHADOW_VOLUMES)
        return GN_BAD_ARGUMENT;
    if ((s->bias.unit == GN_BIAS_WORLD && s->bias.value > (1u << 28)) || s->slope < 0 || s->slope > (64 << 16))
        return GN_OUT_OF_RANGE;
    return GN_OK;
}

static gn_status check_mesh(const gn_mesh *mesh)
{
    if (!mesh || (mesh->vertex_count && !mesh->vertices) || (mesh->triangle_count && !mesh->indices))
        return GN_BAD_ARGUMENT;
    if ((mesh->index_size != 2 && mesh->index_size != 4) || mesh->closed > 1)
        return GN_BAD_MESH;
    if ((uintptr_t)mesh->indices % mesh->index_size)
        return GN_BAD_MESH;
    if (mesh->vertex_count >= (1u << 28) || mesh->triangle_count >= (1u << 28))
        return GN_TOO_MANY;
    for (uint32_t v = 0; v < mesh->vertex_count; v++)
        for (int i = 0; i < 3; i++)
            if (mesh->vertices[v][i] < -GN_WORLD_MAX || mesh->vertices[v][i] > GN_WORLD_MAX)
                return GN_OUT_OF_RANGE;
    for (uint32_t t = 0; t < mesh->triangle_count; t++) {
        uint32_t index[3];
        gn_triangle_indices(mesh, t, index);
        if (index[0] >= mesh->vertex_count || index[1] >= mesh->vertex_count || index[2] >= mesh->vertex_count)
            return GN_BAD_MESH;
    }
    return GN_OK;
}

/* Whether all meshes are closed, and the bits of a triangle's and an edge's number. */
typedef struct counts {
    int closed;
    uint32_t triangle_bits, edge_bits;
} counts;

/* Count and check the scene. */
static gn_status check_scene(const gn_scene *scene, gn_plan *plan, counts *c)
{
    uint64_t triangles = 0, vertices = 0, edges = 0;
    uint32_t most = 1, most_edges = 1;
    c->closed = 1;
    if (scene->object_count && !scene->objects)
        return GN_BAD_ARGUMENT;
    for (uint32_t i = 0; i < scene->object_count; i++) {
        const gn_object *object = &scene->objects[i];
        gn_status status = GN_OK;
        /* instances of one mesh mostly follow each other: check it once */
        if (i == 0 || object->mesh != scene->objects[i - 1].mesh)
            status = check_mesh(object->mesh);
        if (status == GN_OK && object->model)
            status = gn_check_model(object->model);
        if (status != GN_OK)
            return status;
        triangles += object->mesh->triangle_count;
        vertices += object->mesh->vertex_count;
        edges += object->mesh->edge_count;
        if (object->mesh->triangle_count > most)
            most = object->mesh->triangle_count;
        if (object->mesh->edge_count > most_edges)
            most_edges = object->mesh->edge_count;
        if (!object->mesh->closed)
            c->closed = 0;
    }
    c->triangle_bits = gn_bits_for(most);
    c->edge_bits = gn_bits_for(most_edges);
    /* the highest identifier is kept for "no triangle" */
    if (gn_bits_for(scene->object_count + 1) + c->triangle_bits > 32 || triangles >= (1u << 28) ||
        vertices >= (1u << 28) || edges >= (1u << 30))
        return GN_TOO_MANY;
    plan->triangles = (uint32_t)triangles;
    plan->vertices = (uint32_t)vertices;
    plan->edges = (uint32_t)edges;
    return GN_OK;
}

/* The cheapest layers that give the surface, unless named; refuse what makes no sense. */
static gn_status choose_layers(gn_plan *plan, const gn_settings *s, int all_closed)
{
    int back_layer = s->surface == GN_SECOND && s->layers != GN_LAYERS_TWO &&
                     (s->cull == GN_CULL_FRONT || (all_closed && s->cull == GN_CULL_AUTO));
    if (s->surface == GN_SECOND && s->layers == GN_LAYERS_FIRST && s->cull == GN_CULL_AUTO)
        back_layer = 1;
    int one = s->surface == GN_CONSTANT || s->surface == GN_SLOPE || back_layer;
    plan->layers = s->layers ? s->layers : (one ? GN_LAYERS_FIRST : GN_LAYERS_TWO);
    plan->cull = s->cull;
    if (s->cull == GN_CULL_AUTO)
        plan->cull = back_layer ? GN_CULL_FRONT : s->surface == GN_DUAL ? GN_CULL_BACK : GN_CULL_NONE;
    if ((plan->layers == GN_LAYERS_FIRST) != one)
        return GN_UNSUPPORTED;
    if (plan->layers == GN_LAYERS_TWO && plan->cull == GN_CULL_FRONT)
        return GN_UNSUPPORTED;
    if (s->surface == GN_MIXED && plan->cull != GN_CULL_NONE)
        return GN_UNSUPPORTED;
    if ((s->receiver || s->reconstruction) && (s->map_width < 2 || s->map_height < 2))
        return GN_UNSUPPORTED;
    return GN_OK;
}

/* Shadow volumes need every mesh's edges, and a number for each. */
static gn_status check_volumes(const gn_scene *scene, const counts *c)
{
    for (uint32_t i = 0; i < scene->object_count; i++)
        if (scene->objects[i].mesh->triangle_count && !scene->objects[i].mesh->edges)
            return GN_UNSUPPORTED;
    return gn_bits_for(scene->object_count) + c->edge_bits > 32 ? GN_TOO_MANY : GN_OK;
}

/* Sizes are summed in 64 bits: on a 32-bit machine a plan may exceed the address space. */
static uint64_t align_up(uint64_t bytes)
{
    return (bytes + GN_ALIGNMENT - 1) / GN_ALIGNMENT * GN_ALIGNMENT;
}

void *gn_take(uint8_t *base, uint64_t *used, uint64_t bytes)
{
    void *p = base ? base + (size_t)*used : 0;
    *used = align_up(*used + bytes);
    return p;
}

const gn_drawing *gn_find_drawing(const gn_settings *settings)
{
    return settings->shadow == GN_SHADOW_MAP && settings->reconstruction ? settings->reconstruction->drawing : 0;
}

const gn_parameterisation *gn_find_parameterisation(const gn_settings *settings)
{
    if (settings->shadow != GN_SHADOW_MAP)
        return 0;
    return settings->fit ? settings->fit->hooks : settings->warp ? settings->warp->hooks : 0;
}

/* Texels from one row of the map to the next. */
static uint32_t map_stride(const gn_settings *settings)
{
    return settings->map_width + GN_ROW_PADDING;
}

/* What shadow volumes keep between the passes. */
static uint64_t lay_out_volumes(gn_context *context, uint64_t from, const gn_plan *plan, const gn_settings *settings)
{
    uint8_t *base = (uint8_t *)context;
    uint64_t used = from;
    gn_volumes *volumes = gn_take(base, &used, sizeof *volumes);
    gn_volumes_worker *workers = gn_take(base, &used, (uint64_t)settings->workers * sizeof *workers);
    uint8_t *facings = gn_take(base, &used, ((uint64_t)plan->triangles + 3) / 4);
    gn_silhouette *silhouettes = gn_take(base, &used, (uint64_t)plan->edges * sizeof *silhouettes);
    if (context) {
        gn_volumes empty = {0};
        *volumes = empty;
        volumes->workers = workers;
        volumes->facings = facings;
        volumes->silhouettes = silhouettes;
        context->volumes = volumes;
    }
    for (uint32_t i = 0; i < settings->workers; i++) {
        uint64_t pixels = (uint64_t)plan->region_width * plan->region_height;
        int64_t *point = gn_take(base, &used, pixels * sizeof *point);
        uint16_t *count = gn_take(base, &used, pixels * sizeof *count);
        gn_seen_plane *planes = gn_take(base, &used, GN_COLOUR_CACHE * sizeof *planes);
        if (context) {
            workers[i].point = point;
            workers[i].count = count;
            workers[i].planes = planes;
        }
    }
    return used - from;
}

/* Head of the block: what stays between the passes. Returns its size; plan->view_bytes: of what stays in a view pass.
 */
static uint64_t lay_out_head(gn_context *context, const gn_scene *scene, const gn_settings *settings,
                             const gn_plan *plan)
{
    int volumes = settings->shadow == GN_SHADOW_VOLUMES;
    uint8_t *base = (uint8_t *)context;
    uint64_t used = align_up(sizeof(gn_context));
    gn_object_state *objects = gn_take(base, &used, (uint64_t)scene->object_count * sizeof *objects);
    gn_worker *workers = gn_take(base, &used, (uint64_t)settings->workers * sizeof *workers);
    uint8_t *progress = gn_take(base, &used, plan->light_regions);
    const gn_parameterisation *parameterisation = gn_find_parameterisation(settings);
    if (parameterisation)
        used = parameterisation->lay_out_head(context, used, settings);
    gn_depth *map = gn_take(base, &used, plan->map_bytes + plan->static_bytes);
    if (context) {
        context->objects = objects;
        context->workers = workers;
        context->progress = progress;
        context->map = map;
        context->map_stride = map_stride(settings);
        context->volumes = 0;
        context->drawn = 0;
    }
    const gn_drawing *drawing = gn_find_drawing(settings);
    if (drawing)
        used = drawing->lay_out_head(context, used, settings);
    if (settings->faces)
        used = settings->faces->lay_out(context, used, plan, settings);
    if (volumes)
        used += lay_out_volumes(context, used, plan, settings);
    if (context)
        context->shared = base + (size_t)used;
    return used;
}

uint64_t gn_lay_out_light(gn_context *context, const gn_plan *plan, const gn_settings *settings)
{
    uint8_t *base = context ? context->shared : 0;
    uint64_t used = 0;
    gn_vertex *vertices = gn_take(base, &used, (uint64_t)plan->vertices * sizeof *vertices);
    if (context)
        context->vertices = vertices;
    for (uint32_t i = 0; gn_has_second(plan, settings) && i < settings->workers; i++) {
        gn_depth *second = gn_take(base, &used, (uint64_t)plan->map_rows * map_stride(settings) * sizeof *second);
        if (context)
            context->workers[i].second = second;
    }
    const gn_drawing *drawing = gn_find_drawing(settings);
    return drawing ? drawing->lay_out_light(context, used, plan, settings) : used;
}

uint64_t gn_lay_out_camera(gn_context *context, const gn_plan *plan, const gn_settings *settings)
{
    uint8_t *base = context ? context->shared : 0;
    uint64_t used = 0;
    uint32_t bands, levels, bins, pixels = (uint32_t)plan->region_width * plan->region_height;
    int maps = settings->shadow == GN_SHADOW_MAP, receives = maps && settings->receiver;
    int filters = maps && settings->reconstruction && settings->reconstruction->whole != GN_DARK;
    gn_count_bins(plan, settings, &bands, &levels, &bins);
    gn_vertex *vertices = gn_take(base, &used, (uint64_t)plan->vertices * sizeof *vertices);
    uint32_t *first = gn_take(base, &used, bins ? ((uint64_t)bins + 1) * 4 : 0);
    uint32_t *items = gn_take(base, &used, bins ? (uint64_t)plan->triangles * 4 : 0);
    uint64_t pixel_bytes = settings->format == GN_RGB888 ? 3 : settings->format == GN_RGB565 ? 2 : 0;
    void *colour = gn_take(base, &used, pixels * pixel_bytes);
    uint8_t *mask = gn_take(base, &used, settings->mask ? pixels : 0);
    if (context) {
        context->vertices = vertices;
        context->bin_first = first;
        context->bin_items = items;
        context->bands = bands;
        context->bin_levels = (uint8_t)levels;
        context->bin_count = bins;
        context->colour_buffer = pixel_bytes ? colour : 0;
        context->mask_buffer = settings->mask ? mask : 0;
    }
    for (uint32_t i = 0; i < settings->workers; i++) {
        uint64_t plane = ((uint64_t)pixels + GN_ROW_PADDING) * 4;
        uint32_t *q = gn_take(base, &used, plane), *triangle = gn_take(base, &used, plane);
        gn_colour_pair *colours = gn_take(base, &used, GN_COLOUR_CACHE * sizeof *colours);
        gn_receiver_plane *planes = gn_take(base, &used, receives ? GN_COLOUR_CACHE * sizeof *planes : 0);
        uint8_t *fraction = gn_take(base, &used, filters ? plan->region_width : 0);
        if (context) {
            context->workers[i].planes = receives ? planes : 0;
            context->workers[i].fraction = filters ? fraction : 0;
            context->workers[i].q = q;
            context->workers[i].triangle = triangle;
            context->workers[i].colours = colours;
        }
    }
    return used;
}

gn_status gn_make_plan(gn_plan *plan, const gn_scene *scene, const gn_settings *settings)
{
    if (!plan || !scene || !settings)
        return GN_BAD_ARGUMENT;
    gn_plan p = {0};
    counts c;
    gn_status status = check_settings(settings);
    if (status == GN_OK)
        status = check_scene(scene, &p, &c);
    if (status == GN_OK)
        status =
            settings->shadow == GN_SHADOW_VOLUMES ? check_volumes(scene, &c) : choose_layers(&p, settings, c.closed);
    const gn_drawing *drawing = gn_find_drawing(settings);
    if (status == GN_OK && drawing)
        status = drawing->check(scene);
    if (status != GN_OK)
        return status;
    /* Regions of about 2560 pixels: 20 KiB a worker. Whole rows keep spans long. */
    uint32_t width = settings->region_width ? settings->region_width : settings->width > 2560 ? 2560 : settings->width;
    width = width > settings->width ? settings->width : width;
    uint32_t height = settings->region_height ? settings->region_height : width > 2560 ? 1 : 2560 / width;
    height = height > settings->height ? settings->height : height;
    uint32_t rows =
        settings->map_rows && settings->map_rows < settings->map_height ? settings->map_rows : settings->map_height;
    p.region_width = (uint16_t)width;
    p.region_height = (uint16_t)height;
    p.map_rows = (uint16_t)rows;
    p.light_regions = (settings->map_height + rows - 1) / rows;
    p.camera_regions = (settings->width + width - 1) / width * ((settings->height + height - 1) / height);
    size_t all_rows = (size_t)settings->map_height * gn_map_count(settings);
    p.map_bytes = map_stride(settings) * all_rows * sizeof(gn_depth);
    if (settings->shadow == GN_SHADOW_VOLUMES)
        p.map_bytes = p.light_regions = 0;
    if (settings->casters)
        status = settings->casters->plan(&p, scene, settings);
    if (status != GN_OK)
        return status;
    uint64_t head = lay_out_head(0, scene, settings, &p), light = head, camera = head;
    light += settings->shadow == GN_SHADOW_VOLUMES ? 0 : gn_lay_out_light(0, &p, settings);
    camera += gn_lay_out_camera(0, &p, settings);
    if (light > SIZE_MAX || camera > SIZE_MAX)
        return GN_TOO_MANY;
    if (drawing)
        p.silhouette_bytes = settings->map_width * all_rows;
    p.light_bytes = (size_t)light;
    p.camera_bytes = (size_t)camera;
    p.bytes = p.light_bytes > p.camera_bytes ? p.light_bytes : p.camera_bytes;
    const gn_parameterisation *parameterisation = gn_find_parameterisation(settings);
    if (parameterisation)
        status = parameterisation->plan(&p, settings, head);
    if (status == GN_OK)
        *plan = p;
    return status;
}

gn_status gn_init(gn_context **context, const gn_scene *scene, const gn_settings *settings, void *memory, size_t bytes)
{
    gn_plan plan;
    if (!context || !memory)
        return GN_BAD_ARGUMENT;
    gn_status status = gn_make_plan(&plan, scene, settings);
    if (status != GN_OK)
        return status;
    if ((uintptr_t)memory % GN_ALIGNMENT)
        return GN_MISALIGNED;
    if (bytes < plan.bytes)
        return GN_TOO_SMALL;
    gn_context *c = memory;
    gn_context empty = {0};
    *c = empty;
    c->scene = scene;
    c->settings = *settings;
    if (settings->shadow == GN_SHADOW_VOLUMES) { /* no map to receive from */
        c->settings.receiver = 0;
        c->settings.reconstruction = 0;
    }
    c->plan = plan;
    lay_out_head(c, scene, settings, &plan);
    gn_plan counted;
    counts found;
    (void)check_scene(scene, &counted, &found);
    c->triangle_bits = found.triangle_bits;
    if (c->volumes)
        c->volumes->edge_bits = found.edge_bits;
    uint32_t first_vertex = 0, first_triangle = 0;
    for (uint32_t i = 0; i < scene->object_count; i++) {
        gn_object_state state = {first_vertex, first_triangle, 0, 0};
        c->objects[i] = state;
        first_vertex += scene->objects[i].mesh->vertex_count;
        first_triangle += scene->objects[i].mesh->triangle_count;
    }
    for (uint32_t i = 0; i < settings->workers; i++) {
        gn_worker worker = {0};
        c->workers[i] = worker;
    }
    *context = c;
    return GN_OK;
}

void gn_get_statistics(const gn_context *context, gn_statistics *statistics)
{
    gn_statistics sum = {0};
    for (uint32_t i = 0; i < context->settings.workers; i++) {
        const gn_statistics *s = &context->workers[i].statistics;
        sum.light_triangles += s->light_triangles;
        sum.light_texels += s->light_texels;
        sum.view_samples += s->view_samples;
        sum.camera_triangles += s->camera_triangles;
        sum.camera_fragments += s->camera_fragments;
        sum.pixels_shaded += s->pixels_shaded;
        sum.pixels_tested += s->pixels_tested;
        sum.pixels_outside += s->pixels_outside;
        sum.pixels_agreed += s->pixels_agreed;
        sum.pixels_virtual += s->pixels_virtual;
        sum.pixels_fractional += s->pixels_fractional;
        sum.texels_read += s->texels_read;
        sum.virtual_samples += s->virtual_samples;
        sum.pixels_silhouette += s->pixels_silhouette;
        sum.silhouette_texels += s->silhouette_texels;
        sum.volume_faces += s->volume_faces;
        sum.faces_drawn += s->faces_drawn;
        sum.faces_skipped += s->faces_skipped;
        sum.volume_fragments += s->volume_fragments;
    }
    sum.silhouette_edges = context->volumes ? context->volumes->silhouette_count : 0;
    if (context->drawn)
        sum.silhouette_edges = context->drawn->count;
    sum.map_bytes = context->plan.map_bytes;
    *statistics = sum;
}
