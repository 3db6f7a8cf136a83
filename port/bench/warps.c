/* Cases of fits and warps: the rounds of the view pass, what ends them, and whole frames. */
#include "bench.h"

#include "port.h"
#include "print.h"

typedef struct chain {
    const char *name;
    const gn_fit *fit;
    const gn_warp *warp;
} chain;

static const chain chains[] = {
    {"uniform", 0, 0},
    {"dv", &gn_desired_view, 0},
    {"msf", &gn_minimal_frustum, 0},
    {"rectilinear", 0, &gn_rectilinear},
    {"distance", 0, &gn_rectilinear_distance},
    {"nonorthogonal", 0, &gn_nonorthogonal},
    {"msf-rectilinear", &gn_minimal_frustum, &gn_rectilinear},
    {"dv-nonorthogonal", &gn_desired_view, &gn_nonorthogonal},
};

/* Which of chains. */
enum { UNIFORM, DV, MSF, RECTILINEAR, DISTANCE, NONORTHOGONAL, BEST, CHAINS = COUNT(chains) };

enum { WIDTH = 320, HEIGHT = 240, MAP_SIDE = 128 };

static gn_settings settings_of(const chain *by, uint16_t width)
{
    gn_settings settings = gn_default_settings(width, (uint16_t)(width / 4 * 3), MAP_SIDE);
    settings.surface = GN_SECOND;
    settings.receiver = &gn_virtual;
    settings.fit = by->fit;
    settings.warp = by->warp;
    return settings;
}

/* The case of one step of one scene. */
static void write_step(const char *scene, const chain *by, const char *step, uint32_t number)
{
    port_write("case ");
    port_write(scene);
    port_write("-");
    port_write(by->name);
    port_write(step);
    write_decimal(number);
    port_write("\n");
}

/* At most a fit and two rounds of a warp. */
static const char *const rounds[] = {"-round1-", "-round2-", "-round3-"};
static const char *const ends[] = {"-end1-", "-end2-", "-end3-"};

/* Vertices and bins; of each round all regions; its end. */
static void measure_view_steps(const char *name, const chain *by, const gn_plan *plan, uint16_t width,
                               const gn_camera *camera, const gn_light *light)
{
    write_step(name, by, "-begin-", width);
    mark_begin();
    gn_status status = gn_view_begin(context, camera, light);
    mark_end();
    for (uint32_t round = 0; status == GN_OK && round < plan->view_rounds; round++) {
        write_step(name, by, rounds[round], width);
        mark_begin();
        for (uint32_t i = 0; status == GN_OK && i < plan->camera_regions; i++)
            status = gn_view_region(context, i, 0);
        mark_end();
        require(status == GN_OK, "view regions");
        write_step(name, by, ends[round], width);
        mark_begin();
        status = gn_view_end(context);
        mark_end();
    }
    require(status == GN_OK, "view pass");
}

static void measure_view(const char *name, const gn_scene *scene, const chain *by, uint16_t width,
                         const gn_camera *camera, const gn_light *light)
{
    gn_settings settings = settings_of(by, width);
    gn_plan plan;
    prepare(scene, &settings, &plan);
    measure_view_steps(name, by, &plan, width, camera, light);
}

static void measure_passes(const golden_scene *g, const chain *by, const char *light_suffix, const char *camera_suffix)
{
    write_step(g->name, by, light_suffix, WIDTH);
    mark_begin();
    gn_status status = gn_light_pass(context, g->light);
    mark_end();
    require(status == GN_OK, "light pass");
    write_step(g->name, by, camera_suffix, WIDTH);
    mark_begin();
    status = gn_camera_pass(context, g->camera, discard, 0);
    mark_end();
    require(status == GN_OK, "camera pass");
}

static void measure_frame(const golden_scene *g, const chain *by)
{
    gn_settings settings = settings_of(by, WIDTH);
    gn_plan plan;
    prepare(g->scene, &settings, &plan);
    if (plan.view_rounds)
        measure_view_steps(g->name, by, &plan, WIDTH, g->camera, g->light);
    measure_passes(g, by, "-light-", "-camera-");
}

static void measure_silhouettes(const golden_scene *g, const chain *by)
{
    gn_settings settings = settings_of(by, WIDTH);
    gn_plan plan;
    settings.reconstruction = &gn_silhouettes;
    prepare(g->scene, &settings, &plan);
    require(!plan.view_rounds || gn_view_pass(context, g->camera, g->light) == GN_OK, "view pass");
    measure_passes(g, by, "-silhouettes-light-", "-silhouettes-camera-");
}

/* The warp by distance has the light and camera pass of that by counts, about. */
static void measure_scene(const golden_scene *g)
{
    for (unsigned i = 0; i < CHAINS; i++)
        if (i != DISTANCE && i != NONORTHOGONAL)
            measure_frame(g, &chains[i]);
    measure_view(g->name, g->scene, &chains[DISTANCE], WIDTH, g->camera, g->light);
    measure_silhouettes(g, &chains[UNIFORM]);
    measure_silhouettes(g, &chains[BEST]);
}

/* The room in two sizes: a pixel of each round. */
static void measure_view_pixels(const view *v, const char *name)
{
    gn_scene scene = scene_of(room, 2);
    gn_camera camera;
    gn_light light;
    set_up_view(v, &scene, &camera, &light);
    for (unsigned i = DV; i <= NONORTHOGONAL; i++)
        for (uint16_t width = WIDTH / 2; width <= WIDTH; width = (uint16_t)(width + WIDTH / 2))
            measure_view(name, &scene, &chains[i], width, &camera, &light);
}

/* A pixel of the camera pass, all texels agreeing but at one border of the shadow. */
static void measure_camera_pixels(const chain *by, const char *suffix, const gn_receiver *by_plane,
                                  const gn_reconstruction *reconstruction)
{
    gn_scene scene = scene_of(room, 2);
    gn_camera camera;
    gn_light light;
    set_up_view(&views[0], &scene, &camera, &light);
    for (uint16_t width = WIDTH / 2; width <= WIDTH; width = (uint16_t)(width + WIDTH / 2)) {
        gn_settings settings = settings_of(by, width);
        settings.receiver = by_plane;
        settings.reconstruction = reconstruction;
        if (width < WIDTH) { /* once is enough */
            look_at_view(&scene, &settings, &camera, &light);
            require(lit > shadowed / 4 && shadowed > lit / 4, "a view with light and shadow");
        }
        write_step("room", by, suffix, width);
        measure_camera_pass(&scene, &settings, &camera, &light);
    }
}

void measure_warps(void)
{
    static const uint8_t pixels_of[] = {UNIFORM, DV, RECTILINEAR, NONORTHOGONAL};
    measure_view_pixels(&views[0], "sun");
    measure_view_pixels(&views[2], "spot");
    for (unsigned i = 0; i < COUNT(pixels_of); i++) {
        const chain *by = &chains[pixels_of[i]];
        measure_camera_pixels(by, "-point-", 0, 0);
        measure_camera_pixels(by, "-virtual-", &gn_virtual, 0);
        if (pixels_of[i] != NONORTHOGONAL)
            measure_camera_pixels(by, "-silhouettes-", &gn_virtual, &gn_silhouettes);
    }
    for (unsigned i = 0; i < GOLDEN_SCENES; i++)
        measure_scene(&golden[i]);
}
