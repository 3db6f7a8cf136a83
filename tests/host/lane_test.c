/* Lanes: every core in this program renders what the golden hashes say, the program's own frames are the same with any
 * regions and workers, and a lane that counts its operations renders as the one that does not, and counts what can be
 * worked out. */
#include "frame.h"
#include "lane.h"
#include "procedural.h"
#include "render_options.h"
#include "sandbox.h"

#include <inttypes.h>
#include <pthread.h>

/* ---- scenes and chains ------------------------------------------------------------------------------------------- */

/* Rendered as the golden firmware does (port/methods.h); golden: its name there, or 0. lamp: by a point light. */
typedef struct chain {
    const char *golden, *method, *receiver, *reconstruct, *parameterise, *smoothing, *bias, *layers, *faces;
    int lamp;
} chain;

static const chain chains[] = {
    {.golden = "midpoint", .method = "midpoint"},
    {.golden = "dual", .method = "dual", .bias = "2t"},
    {.golden = "second-two", .method = "second-depth", .receiver = "point", .layers = "two"},
    {.golden = "mixed", .method = "mixed", .receiver = "point"},
    {.golden = "virtual", .method = "second-depth", .receiver = "virtual"},
    {.golden = "pcf5", .method = "second-depth", .receiver = "virtual", .reconstruct = "pcf5"},
    {.golden = "silhouette", .method = "silhouette"},
    {.golden = "warped-silhouette", .method = "silhouette", .parameterise = "msf+rectilinear"},
    {.golden = "dv-nonorthogonal", .method = "second-depth", .receiver = "virtual", .parameterise = "dv+nonorthogonal"},
    {.golden = "volumes", .method = "volumes"},
    {.method = "constant"},
    {.method = "slope", .reconstruct = "jitter4x4", .parameterise = "rectilinear-distance", .smoothing = "2"},
    {.method = "mixed", .receiver = "virtual", .reconstruct = "crossing"},
    {.method = "silhouette", .lamp = 1},
    {.method = "mixed", .reconstruct = "pcf3", .faces = "one", .lamp = 1},
};

enum { CHAINS = sizeof chains / sizeof *chains, SILHOUETTE = 6, CONSTANT = 10, MAP = 128 };

static void values_of(const char *values[RENDER_OPTION_COUNT], const chain *c)
{
    memset(values, 0, RENDER_OPTION_COUNT * sizeof *values);
    values[RENDER_METHOD] = c->method;
    values[RENDER_RECEIVER] = c->receiver;
    values[RENDER_RECONSTRUCT] = c->reconstruct;
    values[RENDER_PARAMETERISE] = c->parameterise;
    values[RENDER_SMOOTHING] = c->smoothing;
    values[RENDER_BIAS] = c->bias;
    values[RENDER_LAYERS] = c->layers;
    values[RENDER_FACES] = c->faces;
    values[RENDER_SIZE] = "160x120";
    if (strcmp(c->method, "volumes") != 0)
        values[RENDER_MAP] = "128";
}

static int read_scene(packed_scene *packed, const char *name)
{
    char file[64];
    problem why;
    snprintf(file, sizeof file, "%s.scene", name);
    return procedural_write(name, sandbox_folder) || packed_read(packed, sandbox_path(file), 0, &why) ||
                   packed_make_edges(packed, 0, &why)
               ? -1
               : 0;
}

/* ---- masks ------------------------------------------------------------------------------------------------------- */

/* tests/golden/hashes.txt: DEPTH SCENE METHOD STAGE HASH. 0: not there. */
static stage_hash golden_mask(int depth_bits, const char *scene, const char *method)
{
    char line[256], start[128];
    stage_hash hash = 0;
    FILE *file = fopen("tests/golden/hashes.txt", "r");
    snprintf(start, sizeof start, "%d %s %s mask ", depth_bits, scene, method);
    while (file && fgets(line, sizeof line, file))
        if (strncmp(line, start, strlen(start)) == 0)
            hash = strtoull(line + strlen(start), 0, 16);
    if (file)
        fclose(file);
    return hash;
}

static stage_hash hash_of(const lane_frame *f)
{
    stage_hash hash = stage_hash_init();
    for (size_t i = 0; i < (size_t)f->width * f->height; i++)
        hash = stage_hash_u8(hash, f->mask[i]);
    return hash;
}

/* How many pixels of the mask lie between the two values, both included. */
static uint32_t pixels_between(const lane_frame *f, int least, int most)
{
    uint32_t count = 0;
    for (size_t i = 0; i < (size_t)f->width * f->height; i++)
        count += f->mask[i] >= least && f->mask[i] <= most;
    return count;
}

/* Of the program's own core with three workers, and regions that are no lane's. */
static int render_own(frame *f, packed_scene *packed, const char *const values[], problem *why)
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

/* Of the program's own core, or of the lane of that depth that does not count: that lane itself has neither. */
static int is_other(const lane *l, const lane_frame *got, packed_scene *packed, const char *const values[])
{
    frame f = {.context = 0};
    lane_frame plain = {.mask = 0};
    const lane *other = lane_find(l->depth_bits, 0);
    size_t size = (size_t)got->width * got->height;
    problem why;
    int same = other == l;
    if (l->depth_bits == GN_DEPTH_BITS)
        same = render_own(&f, packed, values, &why) == 0 && memcmp(got->mask, f.mask, size) == 0;
    else if (other && other != l)
        same = other->render(&plain, packed, values, 0, &why) == 0 && memcmp(got->mask, plain.mask, size) == 0;
    frame_close(&f);
    lane_frame_free(&plain);
    return same;
}

/* A map of 128 x 128 texels, six of them, or none; the program's own core has more where it draws with vectors. */
static int plan_is_good(const lane *l, const lane_frame *got, const packed_scene *packed, const chain *c,
                        const char *const values[])
{
    size_t maps = strcmp(c->method, "volumes") == 0 ? 0 : c->lamp && !c->faces ? 6 : 1;
    gn_plan plan;
    problem why;
    return l->plan(&plan, packed, values, &why) == 0 && plan.bytes == got->plan.bytes &&
           (!lane_of_firmware(l->depth_bits) || plan.map_bytes == maps * MAP * MAP * (size_t)l->depth_bits / 8);
}

/* A lamp beside the camera. */
static void put_lamp(packed_scene *packed)
{
    const int32_t *eye = packed->camera.eye;
    int32_t place[3] = {-eye[0] / 2, eye[1], eye[2] / 2};
    gn_point_light(&packed->light, place, GN_WORLD_MAX / 256, 4 * GN_WORLD_MAX);
    packed->settings.faces = &gn_six_faces;
}

static void check_chain(const lane *l, const packed_scene *scene, const char *name, const chain *c)
{
    packed_scene own = *scene, *packed = &own;
    const char *values[RENDER_OPTION_COUNT];
    lane_frame got = {.mask = 0};
    problem why = {""};
    values_of(values, c);
    if (c->lamp)
        put_lamp(packed);
    int done = l->render(&got, packed, values, 2, &why) == 0;
    if (!done)
        note("%s", why.text);
    uint32_t shadowed = done ? pixels_between(&got, 0, 126) : 0, lit = done ? pixels_between(&got, 127, 254) : 0;
    int golden = done && (!c->golden || hash_of(&got) == golden_mask(l->depth_bits, name, c->golden));
    int other = done && is_other(l, &got, packed, values);
    int plan = done && plan_is_good(l, &got, packed, c, values);
    int counted = done && (l->counts || got.statistics.pixels_shaded == shadowed + lit);
    if (!ok(golden && other && plan && counted && shadowed > 100 && lit > 100, "%s, lane of %d bits%s, %s%s", name,
            l->depth_bits, l->counts ? " that counts" : "", c->lamp ? "lamp, " : "", got.settings))
        note("as the golden hash: %d; as another core: %d; plan: %d; pixels counted: %d; %u shadowed, %u lit", golden,
             other, plan, counted, (unsigned)shadowed, (unsigned)lit);
    lane_frame_free(&got);
}

/* ---- operations -------------------------------------------------------------------------------------------------- */

typedef struct counting {
    const lane *of;
    const packed_scene *packed;
    const char *values[RENDER_OPTION_COUNT];
    lane_frame frame;
    int result;
    problem why;
} counting;

static void *count(void *user)
{
    counting *c = user;
    c->result = c->of->render(&c->frame, c->packed, (const char *const *)c->values, 1, &c->why);
    return 0;
}

/* Each thread counts its own frames: two at once count what one alone does. */
static void check_threads(const lane *l, const packed_scene *packed)
{
    counting jobs[3] = {{.of = l, .packed = packed}};
    pthread_t thread;
    values_of(jobs[0].values, &chains[SILHOUETTE]);
    jobs[1] = jobs[2] = jobs[0];
    count(&jobs[0]);
    int started = pthread_create(&thread, 0, count, &jobs[1]) == 0;
    count(&jobs[2]);
    if (started)
        pthread_join(thread, 0);
    int same = started && !jobs[0].result && !jobs[1].result && !jobs[2].result;
    for (int i = 1; i < 3 && same; i++)
        same = memcmp(jobs[i].frame.operations, jobs[0].frame.operations, sizeof jobs[0].frame.operations) == 0;
    ok(same, "two_threads_count_what_one_does_%d", l->depth_bits);
    for (int i = 0; i < 3; i++)
        lane_frame_free(&jobs[i].frame);
}

/* Of a frame of this many rows whose camera looks away. */
static int count_background(lane_frame *f, const lane *l, const packed_scene *packed, const char *size)
{
    packed_scene away = *packed;
    counting job = {.of = l, .packed = &away};
    for (int i = 0; i < 3; i++) {
        away.camera.right[i] = -packed->camera.right[i];
        away.camera.forward[i] = -packed->camera.forward[i];
    }
    values_of(job.values, &chains[CONSTANT]);
    job.values[RENDER_SIZE] = size;
    count(&job);
    *f = job.frame;
    if (job.result)
        note("%s", job.why.text);
    return job.result;
}

/* Nothing to be seen: twice as many rows are twice as many regions, and each divides by what is no constant four times:
 * for the number of columns, for its own column and row (gn_find_region), and for its band of bins
 * (gn_rasterise_region). Each pixel more has its nearness and its triangle cleared and its colour written. */
static void check_background(const lane *l, const packed_scene *packed)
{
    lane_frame low, high;
    int result = count_background(&low, l, packed, "160x160") | count_background(&high, l, packed, "160x320");
    const uint64_t *a = low.operations[LANE_CAMERA], *b = high.operations[LANE_CAMERA];
    uint64_t regions = high.plan.camera_regions - low.plan.camera_regions, pixels = 160 * 160;
    uint64_t divides = b[LANE_DIVIDE] - a[LANE_DIVIDE], stores = b[LANE_STORE] - a[LANE_STORE];
    if (!ok(!result && regions > 0 && divides == 4 * regions && stores >= 3 * pixels && stores < 6 * pixels,
            "a_region_divides_four_times_%d", l->depth_bits))
        note("%" PRIu64 " regions, %" PRIu64 " divides, %" PRIu64 " stores", regions, divides, stores);
    lane_frame_free(&low);
    lane_frame_free(&high);
}

/* ---- plans ------------------------------------------------------------------------------------------------------- */

/* A receiver with planes needs 40 bytes an entry of GN_COLOUR_CACHE (gnomon.h), and a firmware has 64 of them. */
static void check_plan(const lane *l, const packed_scene *packed)
{
    gn_plan point = {0}, planes = {0};
    const char *values[RENDER_OPTION_COUNT];
    problem why;
    values_of(values, &(chain){.method = "dual", .receiver = "point"});
    int result = l->plan(&point, packed, values, &why);
    values_of(values, &(chain){.method = "dual", .receiver = "virtual"});
    result |= l->plan(&planes, packed, values, &why);
    if (!ok(!result && planes.camera_bytes - point.camera_bytes == 64 * 40, "plans_are_a_firmware's_%d", l->depth_bits))
        note("%zu bytes, %zu with planes", point.camera_bytes, planes.camera_bytes);
}

/* ---- all --------------------------------------------------------------------------------------------------------- */

/* Does make say that it is there? Where the test runs alone nobody does. */
static int is_promised(int depth_bits, int counts)
{
    const char *lanes = getenv("LANES"), *counter = getenv("LANE_CLANG");
    int others = lanes && strcmp(lanes, "yes") == 0;
    return counts ? others && counter && *counter : others || depth_bits == GN_DEPTH_BITS;
}

static void check_lane(int depth_bits, int counts, packed_scene *packed, const char *scene)
{
    const lane *l = lane_find(depth_bits, counts);
    if (!l) {
        ok(!is_promised(depth_bits, counts), "%s, no lane of %d bits%s", scene, depth_bits,
           counts ? " that counts" : "");
        return;
    }
    for (int i = 0; i < CHAINS; i++)
        check_chain(l, packed, scene, &chains[i]);
    if (lane_of_firmware(depth_bits))
        check_plan(l, packed);
    if (counts) {
        check_threads(l, packed);
        check_background(l, packed);
    }
}

int main(void)
{
    static const char *const scenes[] = {"lshape", "torus2"};
    sandbox_open();
    ok(lane_find(GN_DEPTH_BITS, 0) && !lane_find(8, 0) && !lane_find(8, 1), "there_is_the_program's_own_lane");
    for (int i = 0; i < 2; i++) {
        packed_scene packed = {.mesh_count = 0};
        if (ok(read_scene(&packed, scenes[i]) == 0, "there_is_the_scene_%s", scenes[i]))
            for (int counts = 0; counts < 2; counts++) {
                check_lane(16, counts, &packed, scenes[i]);
                check_lane(32, counts, &packed, scenes[i]);
            }
        packed_free(&packed);
    }
    sandbox_close();
    return tap_done();
}
