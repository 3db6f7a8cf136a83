/* `--method auto` with a budget: what it sees in a scene, the bytes of its candidates, and the order in which it takes
 * them. Expected figures are worked out by hand. */
#include "automatic_search.h"
#include "memory.h"
#include "packed.h"
#include "sandbox.h"

#include <math.h>

static const char cube[] = "v -1 -1 -1\nv 1 -1 -1\nv 1 1 -1\nv -1 1 -1\nv -1 -1 1\nv 1 -1 1\nv 1 1 1\nv -1 1 1\n"
                           "f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 4 8 7 3\nf 1 5 8 4\nf 2 3 7 6\n";
static const char square[] = "v -5 0 -5\nv -5 0 5\nv 5 0 5\nv 5 0 -5\nf 1 2 3 4\n";
static const char bent[] = "v -5 0 -5\nv -5 0 5\nv 5 0 5\nv 5 1 -5\nf 1 2 3\nf 1 3 4\n";

#define VIEW                                                                                                           \
    "image 64 64\nmap 64\nambient 0.2\ncamera orthographic eye 0 10 0 target 0 0 0 up 0 0 -1 height 5 near 1 far 20\n"
#define SUN "light directional direction 0 -1 0\n"
#define POINT_LIGHT "light point position 0 4 0 near 0.1 far 20\n"
#define SOLID "mesh in-cube.obj surface closed color 1 1 1\n"
#define FLAT "mesh in-square.obj surface open color 1 1 1\n"
#define BENT "mesh in-bent.obj surface open color 1 1 1\n"

/* packed_free() it. */
static packed_scene read_scene(const char *text)
{
    packed_scene packed;
    problem why;
    sandbox_write_text("in.scene", text);
    if (packed_read(&packed, sandbox_path("in.scene"), 0, &why) || packed_make_edges(&packed, 0, &why)) {
        note("%s", why.text);
        exit(1);
    }
    packed.settings.workers = 1;
    return packed;
}

static automatic_scene look_at(const char *text)
{
    packed_scene packed = read_scene(text);
    automatic_scene scene;
    problem why;
    if (automatic_scene_make(&scene, &packed, &packed.settings, &why)) {
        note("%s", why.text);
        exit(1);
    }
    packed_free(&packed);
    return scene;
}

static int holds(const automatic_scene *scene, unsigned closed, unsigned flat, unsigned open)
{
    int good = scene->closed == closed && scene->flat == flat && scene->open == open;
    if (!good)
        note("got %u closed, %u flat, %u open; expected %u, %u, %u", (unsigned)scene->closed, (unsigned)scene->flat,
             (unsigned)scene->open, closed, flat, open);
    return good;
}

static int suits(const automatic_scene *scene, int second, int mixed)
{
    return automatic_surface_suits(AUTOMATIC_SECOND, scene) == second &&
           automatic_surface_suits(AUTOMATIC_MIXED, scene) == mixed && automatic_surface_suits(AUTOMATIC_DUAL, scene);
}

static void what_a_scene_contains(void)
{
    automatic_scene solid = look_at(VIEW SUN SOLID), on_floor = look_at(VIEW SUN SOLID FLAT),
                    open = look_at(VIEW SUN SOLID FLAT BENT BENT), point = look_at(VIEW POINT_LIGHT SOLID FLAT);
    ok(holds(&solid, 1, 0, 0) && suits(&solid, 1, 0), "solids_alone_need_one_layer");
    ok(holds(&on_floor, 1, 1, 0) && suits(&on_floor, 1, 1), "a_solid_on_a_flat_floor_may_need_two");
    ok(holds(&open, 1, 1, 2) && suits(&open, 0, 1), "open_meshes_need_two");
    ok(automatic_placement_suits(AUTOMATIC_UNIFORM, &point) && !automatic_placement_suits(AUTOMATIC_DV, &point) &&
           automatic_placement_suits(AUTOMATIC_DV, &solid),
       "a_point_light_takes_no_fit");
}

static void flat_meshes(void)
{
    /* in the plane 4x = 3z, then one corner off it: by a unit, by 5 units of distance */
    static int32_t corners[5][3] = {{0, 0, 0}, {3000, 0, 4000}, {3000, 7000, 4000}, {0, 7000, 0}, {1500, 3500, 2000}};
    gn_mesh mesh = {.vertices = (const int32_t(*)[3])corners, .vertex_count = 5, .triangle_count = 4};
    ok(automatic_mesh_is_flat(&mesh), "corners_in_one_plane_are_flat");
    corners[4][0]++;
    ok(automatic_mesh_is_flat(&mesh), "a_unit_off_by_rounding_is_flat");
    corners[4][0] += 6;
    ok(!automatic_mesh_is_flat(&mesh), "farther_off_is_not_flat");
    mesh.vertex_count = 3;
    ok(automatic_mesh_is_flat(&mesh), "a_triangle_is_flat");
}

/* The camera sees 5 x 5 of a floor of 10 x 10, whose light's box is 10.2 x 10.2. The centres of 64 pixels span 63/64 of
 * the 5; a fit may add a texel of 128 on each side. */
static void how_much_the_view_takes(void)
{
    automatic_scene scene = look_at(VIEW SUN FLAT);
    double least = pow(5 * 63.0 / 64 / 10.2, 2), most = pow(5 * 128.0 / 126 / 10.2, 2);
    if (!ok(scene.share >= least && scene.share <= most, "the_share_of_the_plane_is_what_the_camera_sees"))
        note("got %g, expected %g to %g", scene.share, least, most);
    ok(scene.uniform_border == 0 && scene.fitted_border == 0, "a_floor_alone_has_no_borders");
}

typedef struct filling {
    int test, placement, shape;
    uint64_t bytes;
    int width, height; /* with 16 bits of depth */
    int width_32, height_32;
    const char *name;
} filling;

/* A texel has 2 (4) bytes, and one more with silhouettes or crossings; a warp by columns and rows 2 bytes each. */
static const filling fillings[] = {
    {AUTOMATIC_VIRTUAL, AUTOMATIC_UNIFORM, AUTOMATIC_SQUARE, 32768, 128, 128, 90, 90, "depths_alone"},
    {AUTOMATIC_VIRTUAL, AUTOMATIC_UNIFORM, AUTOMATIC_SQUARE, 32767, 127, 127, 90, 90, "a_byte_less"},
    {AUTOMATIC_SILHOUETTE, AUTOMATIC_UNIFORM, AUTOMATIC_SQUARE, 32768, 104, 104, 80, 80, "with_silhouettes"},
    {AUTOMATIC_CROSSING, AUTOMATIC_MSF_RECTILINEAR, AUTOMATIC_SQUARE, 32768, 103, 103, 80, 80, "and_a_warp"},
    {AUTOMATIC_CROSSING, AUTOMATIC_DV, AUTOMATIC_SQUARE, 32768, 104, 104, 80, 80, "a_fit_has_no_table"},
    {AUTOMATIC_VIRTUAL, AUTOMATIC_UNIFORM, AUTOMATIC_SQUARE + 2, 32768, 180, 90, 128, 64, "twice_as_wide"},
    {AUTOMATIC_VIRTUAL, AUTOMATIC_UNIFORM, AUTOMATIC_SQUARE - 2, 32768, 90, 180, 64, 128, "twice_as_high"},
};

static void largest_maps(void)
{
    packed_scene packed = read_scene(VIEW SUN SOLID FLAT);
    for (size_t i = 0; i < sizeof fillings / sizeof *fillings; i++) {
        const filling *f = &fillings[i];
        automatic_candidate c = {AUTOMATIC_MIXED, (uint8_t)f->test, (uint8_t)f->placement, 0, 0};
        int fits = automatic_fill(&c, f->shape, f->bytes, &packed, &packed.settings);
        int width = GN_DEPTH_BITS == 16 ? f->width : f->width_32,
            height = GN_DEPTH_BITS == 16 ? f->height : f->height_32;
        if (!ok(fits && c.width == width && c.height == height, "the_largest_map_%s", f->name))
            note("got %d x %d, expected %d x %d", c.width, c.height, width, height);
    }
    automatic_candidate c = {AUTOMATIC_MIXED, AUTOMATIC_VIRTUAL, AUTOMATIC_UNIFORM, 0, 0};
    const uint64_t texel = sizeof(gn_depth);
    ok(!automatic_fill(&c, AUTOMATIC_SQUARE, 4 * texel - 1, &packed, &packed.settings) &&
           automatic_fill(&c, AUTOMATIC_SQUARE, 4 * texel, &packed, &packed.settings),
       "virtual_samples_need_two_by_two_texels");
    ok(automatic_least_bytes(&packed, &packed.settings) == texel, "the_least_map_is_a_texel");
    /* 2 bits a triangle of 12 and 2, 8 bytes an edge: the cube has 12 and 6 diagonals, the floor 4 and 1 */
    const automatic_candidate volumes = {0, 0, 0, 0, 0};
    ok(automatic_bytes(&volumes, &packed, &packed.settings) == (14 + 3) / 4 + 8 * (18 + 5),
       "shadow_volumes_keep_facings_and_edges");
    packed_free(&packed);
    packed = read_scene(VIEW POINT_LIGHT SOLID FLAT);
    ok(automatic_fill(&c, AUTOMATIC_SQUARE, 6 * texel * 100 * 100, &packed, &packed.settings) && c.width == 100 &&
           c.height == 100,
       "a_point_light_has_six_maps");
    ok(automatic_least_bytes(&packed, &packed.settings) == 6 * texel * 9 * 9,
       "of_a_texel_and_a_border_of_four_on_each_side");
    packed_free(&packed);
}

/* Bytes, error and cost of results, and which is taken. */
static size_t taken(uint64_t bytes, double error, const double results[][3], size_t count)
{
    const automatic_budget budget = {bytes, error};
    size_t best = 0;
    automatic_result all[8];
    memset(all, 0, sizeof all);
    for (size_t i = 0; i < count; i++) {
        all[i].bytes = (uint64_t)results[i][0];
        all[i].error = results[i][1];
        all[i].cost = results[i][2];
        if (automatic_compare(&budget, &all[i], &all[best]) < 0)
            best = i;
    }
    return best;
}

static void which_is_taken(void)
{
    static const double results[][3] = {{100, 3, 10}, {200, 2, 90}, {300, 1, 50}, {300, 1, 40}, {400, 0.5, 60}};
    const size_t count = sizeof results / sizeof *results;
    ok(taken(300, -1, results, count) == 3, "bytes_alone_take_the_least_error_and_of_equals_the_cheaper");
    ok(taken(299, -1, results, count) == 1, "more_bytes_than_the_budget_are_not_taken");
    ok(taken(0, 2.5, results, count) == 1, "error_alone_takes_the_fewest_bytes");
    ok(taken(400, 2.5, results, count) == 3, "both_take_the_cheapest");
    ok(taken(400, 3, results, count) == 0, "also_where_it_errs_more");
    ok(taken(250, 0.1, results, count) == 4, "what_keeps_no_budget_comes_by_error");
}

int main(void)
{
    sandbox_open();
    sandbox_write_text("in-cube.obj", cube);
    sandbox_write_text("in-square.obj", square);
    sandbox_write_text("in-bent.obj", bent);
    what_a_scene_contains();
    flat_meshes();
    how_much_the_view_takes();
    largest_maps();
    which_is_taken();
    sandbox_close();
    return tap_done();
}
