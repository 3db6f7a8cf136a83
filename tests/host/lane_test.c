/* Lanes against the program's own frames: the same bits whichever core renders, with any regions and workers, and
 * figures that do not depend on how a frame was cut. */
#include "frame.h"
#include "lane.h"
#include "procedural.h"
#include "render_options.h"
#include "sandbox.h"

#if defined __SANITIZE_ADDRESS__ || (defined GN_CHECKED && GN_CHECKED)
static const char size[] = "80x60";
#else
static const char size[] = "160x120";
#endif

/* The options of a chain beside sizes. */
typedef struct chain {
    const char *method, *reconstruct, *parameterise;
} chain;

static const chain chains[] = {
    {"constant", 0, 0},        {"mixed", "pcf3", 0}, {"silhouette", 0, "msf+rectilinear"},
    {"second-depth", 0, "dv"}, {"slope", 0, 0},      {"dual", "crossing", 0},
    {"volumes", 0, 0},
};

enum { CHAINS = sizeof chains / sizeof *chains };

static void values_of(const char *values[RENDER_OPTION_COUNT], const chain *c)
{
    memset(values, 0, RENDER_OPTION_COUNT * sizeof *values);
    values[RENDER_METHOD] = c->method;
    values[RENDER_RECONSTRUCT] = c->reconstruct;
    values[RENDER_PARAMETERISE] = c->parameterise;
    values[RENDER_SIZE] = size;
    if (strcmp(c->method, "volumes") != 0)
        values[RENDER_MAP] = "96x64";
}

static int read_scene(packed_scene *packed, const char *name)
{
    char file[64];
    problem why;
    snprintf(file, sizeof file, "%s.scene", name);
    if (procedural_write(name, sandbox_folder) || packed_read(packed, sandbox_path(file), 0, &why) ||
        packed_make_edges(packed, 0, &why)) {
        note("%s cannot be made", name);
        return -1;
    }
    return 0;
}

/* With three workers and regions that are no lane's. */
static int render_frame(frame *f, packed_scene *packed, const char *const values[], problem *why)
{
    gn_settings settings;
    if (render_options_read(&settings, packed, values, why))
        return -1;
    settings.mask = 1;
    settings.workers = 3;
    settings.region_width = 48;
    settings.region_height = 20;
    settings.map_rows = 24;
    return frame_open(f, &packed->scene, &settings, 0, why) ||
                   frame_view_pass(f, &packed->camera, &packed->light, why) ||
                   frame_light_pass(f, &packed->light, why) || frame_camera_pass(f, &packed->camera, why)
               ? -1
               : 0;
}

/* How many pixels of the mask lie between the two values, both included. */
static uint32_t pixels_between(const lane_frame *f, int least, int most)
{
    uint32_t count = 0;
    for (size_t i = 0; i < (size_t)f->width * f->height; i++)
        count += f->mask[i] >= least && f->mask[i] <= most;
    return count;
}

static int mask_is(const lane_frame *f, const uint8_t *mask)
{
    return memcmp(f->mask, mask, (size_t)f->width * f->height) == 0;
}

static void check_chain(const lane *l, packed_scene *packed, const char *scene, const chain *c)
{
    const char *values[RENDER_OPTION_COUNT];
    frame f = {.context = 0};
    lane_frame got = {.mask = 0};
    problem why = {""};
    values_of(values, c);
    int done = l->render(&got, packed, values, 1, &why) == 0 && render_frame(&f, packed, values, &why) == 0;
    if (!done)
        note("%s", why.text);
    uint32_t shadowed = done ? pixels_between(&got, 0, 126) : 0, lit = done ? pixels_between(&got, 127, 254) : 0;
    int same = done && (l->depth_bits != GN_DEPTH_BITS || mask_is(&got, f.mask));
    int counted = done && (l->counts || got.statistics.pixels_shaded == shadowed + lit);
    if (!ok(same && counted && shadowed > 100 && lit > 100, "%s_%s_of_lane_%d%s_is_the_program's", scene, got.settings,
            l->depth_bits, l->counts ? "_counted" : ""))
        note("same %d, counted %d, %u shadowed, %u lit", same, counted, (unsigned)shadowed, (unsigned)lit);
    frame_close(&f);
    lane_frame_free(&got);
}

int main(void)
{
    packed_scene packed = {.mesh_count = 0};
    sandbox_open();
    if (ok(read_scene(&packed, "lshape") == 0, "there_is_a_scene"))
        for (int i = 0; i < CHAINS; i++)
            check_chain(lane_find(GN_DEPTH_BITS, 0), &packed, "lshape", &chains[i]);
    packed_free(&packed);
    sandbox_close();
    return tap_done();
}
