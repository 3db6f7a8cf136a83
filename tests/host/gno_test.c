/* Packed scenes: what is packed comes back, also as a C header, and broken .gno files are refused with their place. */
#include "frame.h"
#include "pack.h"
#include "sandbox.h"

static const char scene[] = "image 8 6\nmap 16 12\nambient 0.2\nlight directional direction 0 -1 0.1\n"
                            "camera perspective eye 0 5 9 target 0 0 0 up 0 1 0 fovy 40 near 1 far 99\n"
                            "mesh in.obj surface open color 1 0.5 0\n";

/* Offsets in the packed scene of one triangle: host/pack.h. */
enum {
    METHOD = 34,
    CAMERA = 56,
    LIGHT = 124,
    COUNTS = 212,
    MESH = 220,
    EDGE_COUNT = 232,
    VERTICES = 236,
    INDICES = 272,
    PADDING = 278,
    OBJECT = 280,
    SIZE = 288
};

/* The same in that of three triangles, packed with their edges: two share an edge, the third has no area. */
enum { EDGED_INDICES = 284, EDGES = 304, EDGED_OBJECT = 344, EDGED_SIZE = 352, EDGE_WORDS = 10 };

/* chosen: the first, packed with a method. */
static uint8_t good[SIZE], edged[EDGED_SIZE], chosen[SIZE];

static uint32_t crc32_of(const uint8_t *bytes, size_t size)
{
    uint32_t crc = 0xffffffff;
    for (size_t i = 0; i < 8 * size; i++) {
        uint32_t bit = (crc ^ (uint32_t)(bytes[i / 8] >> (i % 8))) & 1;
        crc = crc >> 1 ^ (bit ? 0xedb88320 : 0);
    }
    return ~crc;
}

static void put(uint8_t *bytes, size_t at, int size, uint32_t value)
{
    for (int i = 0; i < size; i++)
        bytes[at + (size_t)i] = (uint8_t)(value >> (8 * i));
}

static uint32_t get(const uint8_t *bytes, size_t at, int size)
{
    uint32_t value = 0;
    for (int i = 0; i < size; i++)
        value |= (uint32_t)bytes[at + (size_t)i] << (8 * i);
    return value;
}

/* The whole file, of exactly this size? */
static int read_back(const char *name, uint8_t *bytes, size_t size)
{
    FILE *file = fopen(sandbox_path(name), "rb");
    int same = file && fread(bytes, 1, size, file) == size && fgetc(file) == EOF;
    if (file)
        fclose(file);
    return same;
}

static int render_it(const char *output)
{
    const char *arguments[] = {sandbox_path("in.gno"), "-o", sandbox_path(output), 0};
    return sandbox_run(command_render, arguments);
}

/* Pack the scene; its bytes are then what the broken ones are made of. */
static void make_good(void)
{
    sandbox_write_text("in.scene", scene);
    sandbox_write_text("in.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    const char *arguments[] = {sandbox_path("in.scene"), "-o", sandbox_path("in.gno"), 0};
    if (!ok(sandbox_run(command_pack, arguments) == EXIT_DONE, "a_scene_can_be_packed"))
        note("%s", sandbox_message);
    ok(read_back("in.gno", good, SIZE), "its_size_is_as_documented");
    static const uint8_t start[] = {'G', 'N', 'O', 'M', 4, 0, 0, 0, SIZE & 255, SIZE >> 8, 0, 0};
    static const uint8_t sizes[] = {8, 0, 6, 0, 16, 0, 12, 0, 23, 0, 0, 0, 13107 & 255, 13107 >> 8};
    static const uint8_t object[] = {0, 0, 0, 0, 255, 128, 0, 0};
    ok(memcmp(good, start, sizeof start) == 0 && memcmp(good + 16, sizes, sizeof sizes) == 0 &&
           memcmp(good + OBJECT, object, sizeof object) == 0,
       "its_bytes_are_as_documented");
}

static int same_pictures(const char *a, const char *b)
{
    char bytes[2][1000];
    size_t sizes[2] = {0, 0};
    const char *names[2] = {a, b};
    for (int i = 0; i < 2; i++) {
        FILE *file = fopen(sandbox_path(names[i]), "rb");
        sizes[i] = file ? fread(bytes[i], 1, sizeof bytes[i], file) : 0;
        if (file)
            fclose(file);
    }
    return sizes[0] && sizes[0] == sizes[1] && memcmp(bytes[0], bytes[1], sizes[0]) == 0;
}

static void round_trip(void)
{
    const char *from_scene[] = {sandbox_path("in.scene"), "-o", sandbox_path("in-1.ppm"), 0};
    int status = sandbox_run(command_render, from_scene);
    ok(status == EXIT_DONE && render_it("in-2.ppm") == EXIT_DONE && same_pictures("in-1.ppm", "in-2.ppm"),
       "a_packed_scene_renders_to_the_same_picture");
    const char *again[] = {sandbox_path("in.gno"), "-o", sandbox_path("in-again.gno"), 0};
    uint8_t bytes[SIZE];
    status = sandbox_run(command_pack, again);
    ok(status == EXIT_DONE && read_back("in-again.gno", bytes, SIZE) && memcmp(bytes, good, SIZE) == 0,
       "packing_a_packed_scene_changes_nothing");
}

static int pack_edged(const char *input, const char *output, const char *option)
{
    const char *arguments[] = {sandbox_path(input), "-o", sandbox_path(output), option, 0};
    int status = sandbox_run(command_pack, arguments);
    if (status != EXIT_DONE)
        note("%s", sandbox_message);
    return status == EXIT_DONE;
}

static void edges_are_packed(void)
{
    static const uint32_t pairs[EDGE_WORDS] = {0, GN_NO_HALF_EDGE, 1, 3, 2, GN_NO_HALF_EDGE, 4, GN_NO_HALF_EDGE,
                                               5, GN_NO_HALF_EDGE};
    char text[sizeof scene + 1];
    uint8_t bytes[EDGED_SIZE];
    int same = 1;
    strcpy(text, scene);
    memcpy(strstr(text, "in.obj"), "in.ob2", 6);
    sandbox_write_text("in-edged.scene", text);
    sandbox_write_text("in.ob2", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nf 1 2 3\nf 3 2 4\nf 1 4 4\n");
    ok(pack_edged("in-edged.scene", "in-edged.gno", "--edges") && read_back("in-edged.gno", edged, EDGED_SIZE),
       "edges_have_the_documented_size");
    for (int i = 0; i < EDGE_WORDS; i++)
        same = same && get(edged, (size_t)(EDGES + 4 * i), 4) == pairs[i];
    ok(same && get(edged, EDGE_COUNT, 4) == EDGE_WORDS / 2, "edges_stand_where_documented");
    ok(pack_edged("in-edged.gno", "in-again.gno", "--edges") && read_back("in-again.gno", bytes, EDGED_SIZE) &&
           memcmp(bytes, edged, EDGED_SIZE) == 0,
       "packing_them_again_changes_nothing");
    ok(pack_edged("in-edged.gno", "in-again.gno", 0) && read_back("in-again.gno", bytes, EDGED_SIZE - 40) &&
           get(bytes, EDGE_COUNT, 4) == 0 && memcmp(bytes + VERTICES, edged + VERTICES, EDGES - VERTICES) == 0,
       "they_are_left_out_where_nobody_asks_for_them");
    ok(pack_edged("in-again.gno", "in-again.gno", "--edges") && read_back("in-again.gno", bytes, EDGED_SIZE) &&
           memcmp(bytes, edged, EDGED_SIZE) == 0,
       "a_packed_scene_without_edges_gets_the_same_ones");
}

static void volumes_are_kept(void)
{
    problem why;
    packed_scene packed, back;
    int done = packed_read(&packed, sandbox_path("in.gno"), 0, &why) == 0 && packed_make_edges(&packed, 0, &why) == 0 &&
               packed.meshes[0].edge_count == 3;
    packed.has_method = 1;
    packed.settings.shadow = GN_SHADOW_VOLUMES;
    done = done && pack_write(&packed, sandbox_path("in-volumes.gno"), &why) == 0;
    ok(done && packed_read(&back, sandbox_path("in-volumes.gno"), 0, &why) == 0 &&
           back.settings.shadow == GN_SHADOW_VOLUMES && back.meshes[0].edge_count == 3 &&
           memcmp(back.meshes[0].edges, packed.meshes[0].edges, 3 * sizeof(gn_mesh_edge)) == 0,
       "shadow_volumes_and_edges_come_back");
    packed_free(&packed);
    packed_free(&back);
}

/* What `gnomon render --hash` prints. */
static void print_hashes(const char *input, const char *method, char text[300])
{
    const char *arguments[] = {sandbox_path(input), "--hash", method, 0};
    int status = sandbox_run(command_render, arguments);
    FILE *file = fopen(sandbox_path("in-output"), "rb");
    text[file ? fread(text, 1, 299, file) : 0] = 0;
    if (file)
        fclose(file);
    if (status != EXIT_DONE)
        note("%s", sandbox_message);
}

/* Of the scene as it is, with the edges that it has. */
static stage_hash hash_of_silhouettes(const packed_scene *packed)
{
    frame f;
    problem why;
    stage_hash hash = 0;
    if (frame_open(&f, &packed->scene, &packed->settings, 0, &why) == 0 &&
        frame_light_pass(&f, &packed->light, &why) == 0)
        hash = frame_hash_silhouettes(&f);
    frame_close(&f);
    return hash;
}

/* Two triangles that share an edge: without edges the core draws it, too. */
static void silhouettes_get_edges(void)
{
    char whole[300], without[300], named[300];
    problem why;
    packed_scene packed;
    int done = pack_edged("in-edged.scene", "in-joined.gno", "--method=silhouette") &&
               packed_read(&packed, sandbox_path("in-joined.gno"), 0, &why) == 0;
    stage_hash hash = hash_of_silhouettes(&packed);
    packed_drop_edges(&packed);
    ok(done && hash && hash != hash_of_silhouettes(&packed), "edges_matter_to_silhouettes");
    done = pack_write(&packed, sandbox_path("in-without.gno"), &why) == 0;
    packed_free(&packed);
    print_hashes("in-joined.gno", 0, whole);
    print_hashes("in-without.gno", 0, without);
    print_hashes("in-edged.gno", "--method=silhouette", named);
    ok(done && strstr(whole, "silhouettes ") && strcmp(whole, without) == 0,
       "a_file_that_lacks_them_is_rendered_with_them");
    ok(strcmp(whole, named) == 0, "as_is_one_without_a_method_by_that_name");
}

/* What silhouettes are packed with, and a file that has none: host/pack.h. One triangle has three open edges. */
static void silhouettes_are_kept(void)
{
    enum { WITH_EDGES = SIZE + 3 * 8 };
    uint8_t bytes[WITH_EDGES], again[WITH_EDGES], without[SIZE];
    problem why;
    packed_scene packed;
    int done = pack_edged("in.scene", "in-silhouettes.gno", "--method=silhouette");
    ok(done && read_back("in-silhouettes.gno", bytes, WITH_EDGES) && get(bytes, EDGE_COUNT, 4) == 3 &&
           bytes[METHOD - 1] == 1 && bytes[METHOD + 2] == 4 && bytes[39] == 2 && bytes[48] == 6,
       "silhouettes_stand_where_documented_and_bring_edges");
    done = packed_read(&packed, sandbox_path("in-silhouettes.gno"), 0, &why) == 0 && packed.has_method &&
           packed.settings.surface == GN_MIXED && packed.settings.receiver == &gn_virtual &&
           packed.settings.reconstruction == &gn_silhouettes && packed.meshes[0].edge_count == 3;
    ok(done && pack_edged("in-silhouettes.gno", "in-again.gno", 0) && read_back("in-again.gno", again, WITH_EDGES) &&
           memcmp(again, bytes, WITH_EDGES) == 0,
       "they_come_back_and_are_packed_again_to_the_same_bytes");
    packed_drop_edges(&packed);
    ok(pack_write(&packed, sandbox_path("in-without.gno"), &why) == 0 && read_back("in-without.gno", without, SIZE) &&
           without[48] == 6 && get(without, EDGE_COUNT, 4) == 0 && pack_edged("in-without.gno", "in-again.gno", 0) &&
           read_back("in-again.gno", again, WITH_EDGES) && memcmp(again, bytes, WITH_EDGES) == 0,
       "a_file_of_silhouettes_that_lacks_edges_is_read_and_gets_them");
    packed_free(&packed);
    ok(pack_edged("in-silhouettes.gno", "in-again.gno", "--reconstruct=nearest") &&
           read_back("in-again.gno", without, SIZE) && without[48] == 0 && get(without, EDGE_COUNT, 4) == 0,
       "another_reconstruction_leaves_the_edges_out");
}

/* The numbers between the braces that follow a name, in order; returns how many there are. */
static int numbers_after(const char *text, const char *name, long *numbers, int most)
{
    const char *at = strstr(text, name);
    int count = 0;
    at = at ? strchr(at, '{') : 0;
    for (const char *end = at ? strstr(at, "};") : 0; at && at < end && count < most;) {
        char *after;
        long number = strtol(at, &after, 10);
        if (after != at)
            numbers[count++] = number;
        at = after != at ? after : at + 1;
    }
    return count;
}

/* A tetrahedron, the one mesh of a scene: a file of bytes and a header of C. */
static void a_closed_mesh_is_kept(void)
{
    static const char mesh[] = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";
    static const uint16_t corners[12] = {0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3};
    static char header[20000];
    char text[sizeof scene + 2];
    long numbers[20];
    problem why;
    packed_scene packed;
    const char *to_file[] = {sandbox_path("in-closed.scene"), "-o", sandbox_path("in-closed.gno"), 0};
    const char *to_header[] = {sandbox_path("in-closed.scene"), "-o", sandbox_path("in-closed.h"), 0};
    snprintf(text, sizeof text, "%.*smesh in.ob3 surface closed color 1 1 1\n", (int)(strstr(scene, "mesh") - scene),
             scene);
    sandbox_write_text("in-closed.scene", text);
    sandbox_write_text("in.ob3", mesh);
    int done = sandbox_run(command_pack, to_file) == EXIT_DONE && sandbox_run(command_pack, to_header) == EXIT_DONE;
    done = done && packed_read(&packed, sandbox_path("in-closed.gno"), 0, &why) == 0;
    if (!ok(done && packed.mesh_count == 1 && packed.meshes[0].closed && packed.meshes[0].triangle_count == 4 &&
                packed.meshes[0].vertex_count == 4 && packed.meshes[0].index_size == 2 &&
                memcmp(packed.meshes[0].indices, corners, sizeof corners) == 0,
            "a_closed_mesh_and_its_corners_come_back")) {
        note("%s", sandbox_message);
        return;
    }
    FILE *file = fopen(sandbox_path("in-closed.h"), "r");
    header[file ? fread(header, 1, sizeof header - 1, file) : 0] = 0;
    if (file)
        fclose(file);
    int same = numbers_after(header, "_indices_0[", numbers, 20) == 12;
    for (int i = 0; same && i < 12; i++)
        same = numbers[i] == corners[i];
    ok(same, "a_header_holds_its_corners");
    same = numbers_after(header, "_vertices_0[", numbers, 20) == 12;
    for (int i = 0; same && i < 12; i++)
        same = numbers[i] == packed.meshes[0].vertices[i / 3][i % 3];
    ok(same, "and_its_vertices");
    packed_free(&packed);
}

static void a_method_is_kept(void)
{
    problem why;
    packed_scene packed;
    const char *arguments[] = {
        sandbox_path("in.scene"), "-o", sandbox_path("in-dual.gno"), "--method", "dual", "--bias", "3t", "--map=32", 0};
    ok(sandbox_run(command_pack, arguments) == EXIT_DONE &&
           packed_read(&packed, sandbox_path("in-dual.gno"), 0, &why) == 0 && packed.has_method &&
           packed.settings.surface == GN_DUAL && packed.settings.bias.unit == GN_BIAS_TEXELS &&
           packed.settings.bias.value == 3 << 16 && packed.settings.map_width == 32 && packed.settings.width == 8,
       "method_bias_and_sizes_are_packed_with_the_scene");
    packed_free(&packed);
}

/* Bytes of the table in host/pack.h: cull and layers left to the plan, slope, world units, map, plane-bias; a bias of
 * half a world unit of 2^23; a slope of 3.5 and 0.66 / 2^16, rounded; pcf5. */
static void all_of_a_method_is_packed(void)
{
    static const uint8_t bytes[] = {0, 0, 5, 0, 0, 1, 0, 0, 0x40, 0, 1, 0x80, 3, 0, 4, 2, 1, 1, 0, 0x80, 2, 0};
    const char *first[] = {sandbox_path("in.scene"),
                           "-o",
                           sandbox_path("in-chosen.gno"),
                           "--method=slope",
                           "--receiver=plane-bias",
                           "--slope=3.50001",
                           "--reconstruct=pcf5",
                           "--bias=0.5",
                           "--parameterise=rectilinear+msf",
                           "--smoothing=2.5",
                           "--fit-depth",
                           0};
    const char *again[] = {sandbox_path("in-chosen.gno"), "-o", sandbox_path("in-again.gno"), 0};
    uint8_t back[SIZE];
    problem why;
    packed_scene packed;
    ok(sandbox_run(command_pack, first) == EXIT_DONE && read_back("in-chosen.gno", chosen, SIZE) &&
           memcmp(chosen + METHOD, bytes, sizeof bytes) == 0 && chosen[METHOD - 1] == 1,
       "all_of_a_method_stands_where_documented");
    ok(sandbox_run(command_pack, again) == EXIT_DONE && read_back("in-again.gno", back, SIZE) &&
           memcmp(back, chosen, SIZE) == 0,
       "and_stays_there_when_packed_again");
    ok(packed_read(&packed, sandbox_path("in-chosen.gno"), 0, &why) == 0 && packed.settings.surface == GN_SLOPE &&
           packed.settings.receiver == &gn_plane_bias && packed.settings.reconstruction == &gn_box_5x5 &&
           packed.settings.slope == (7 << 15) + 1 && packed.settings.bias.unit == GN_BIAS_WORLD &&
           packed.settings.bias.value == 1 << 22 && packed.settings.fit == &gn_minimal_frustum &&
           packed.settings.warp == &gn_rectilinear && packed.settings.fit_depth == 1 &&
           packed.settings.smoothing == 5 << 15,
       "and_comes_back");
    packed_free(&packed);
}

/* Numbers of the table in host/pack.h. */
static void every_receiver_and_reconstruction_comes_back(void)
{
    static const gn_receiver *const receivers[] = {0, &gn_plane_bias, &gn_virtual, &gn_virtual_always};
    static const gn_reconstruction *const reconstructions[] = {
        0,           &gn_bilinear,    &gn_jitter_4x4,         &gn_box_3x3,  &gn_box_5x5,
        &gn_box_7x7, &gn_silhouettes, &gn_silhouettes_smooth, &gn_crossings};
    int right = 0;
    for (uint8_t i = 0; i < 4; i++)
        for (uint8_t k = 0; k < 9; k++) {
            uint8_t bytes[SIZE], back[SIZE];
            problem why;
            packed_scene packed;
            memcpy(bytes, chosen, SIZE);
            bytes[39] = i;
            bytes[48] = k;
            put(bytes, 12, 4, crc32_of(bytes + 16, SIZE - 16));
            int good_one = pack_parse(&packed, "f", bytes, SIZE, &why) == 0 &&
                           packed.settings.receiver == receivers[i] &&
                           packed.settings.reconstruction == reconstructions[k] &&
                           pack_write(&packed, sandbox_path("in-again.gno"), &why) == 0 &&
                           read_back("in-again.gno", back, SIZE) && memcmp(back, bytes, SIZE) == 0;
            packed_free(&packed);
            right += good_one;
            if (!good_one)
                note("receiver %d, reconstruction %d", i, k);
        }
    ok(right == 36, "every_receiver_and_reconstruction_comes_back_and_is_written_as_it_was");
}

static void every_fit_and_warp_comes_back(void)
{
    static const gn_fit *const fits[] = {0, &gn_desired_view, &gn_minimal_frustum};
    static const gn_warp *const warps[] = {0,
                                           &gn_rectilinear,
                                           &gn_rectilinear_distance,
                                           &gn_nonorthogonal,
                                           &gn_rectilinear_vertices,
                                           &gn_nonorthogonal_vertices};
    int right = 0;
    for (uint8_t i = 0; i < 3; i++)
        for (uint8_t k = 0; k < 6; k++) {
            uint8_t bytes[SIZE], back[SIZE];
            problem why;
            packed_scene packed;
            memcpy(bytes, chosen, SIZE);
            bytes[49] = i;
            bytes[50] = k;
            bytes[51] = i > 0;
            put(bytes, 52, 4, k ? 1024u + k : 0);
            put(bytes, 12, 4, crc32_of(bytes + 16, SIZE - 16));
            int good_one = pack_parse(&packed, "f", bytes, SIZE, &why) == 0 && packed.settings.fit == fits[i] &&
                           packed.settings.warp == warps[k] && packed.settings.fit_depth == (i > 0) &&
                           packed.settings.smoothing == (k ? 1024 + k : 0) &&
                           pack_write(&packed, sandbox_path("in-again.gno"), &why) == 0 &&
                           read_back("in-again.gno", back, SIZE) && memcmp(back, bytes, SIZE) == 0;
            packed_free(&packed);
            right += good_one;
            if (!good_one)
                note("fit %d, warp %d", i, k);
        }
    ok(right == 18, "every_fit_and_warp_comes_back_and_is_written_as_it_was");
}

/* What belongs to a fit or a warp that is not there. */
static void nothing_is_left_of_no_fit_and_no_warp(void)
{
    static const struct {
        const char *promise, *what;
        uint8_t fit, warp, depth;
        uint32_t smoothing;
    } cases[] = {{"a_fitted_depth_without_a_fit", "byte 51: fitted depth is 1; expected 0 to 0", 0, 1, 1, 0},
                 {"smoothing_without_a_warp", "byte 52: smoothing is 65536; expected 0 to 0", 1, 0, 1, 65536}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        uint8_t bytes[SIZE];
        problem why;
        packed_scene packed;
        memcpy(bytes, chosen, SIZE);
        bytes[49] = cases[i].fit;
        bytes[50] = cases[i].warp;
        bytes[51] = cases[i].depth;
        put(bytes, 52, 4, cases[i].smoothing);
        put(bytes, 12, 4, crc32_of(bytes + 16, SIZE - 16));
        int refused = pack_parse(&packed, "f", bytes, SIZE, &why) == -1;
        packed_free(&packed);
        if (!ok(refused && strstr(why.text, cases[i].what), "%s_is_refused_with_its_place", cases[i].promise))
            note("%s", refused ? why.text : "read");
    }
}

typedef struct change {
    const char *promise;
    int at, size;
    uint32_t value;
    const char *where, *what;
} change;

static const change broken[] = {
    {"another_magic_number", 0, 1, 'X', ": byte 0", "GNOM"},
    {"the_version_before", 4, 4, 3, ": byte 4", "version 3; expected 4"},
    {"a_version_to_come", 4, 4, 5, ": byte 4", "version 5; expected 4"},
    {"a_wrong_size", 8, 4, SIZE + 1, ": byte 8", "says that it has 289 bytes"},
    {"an_image_of_no_width", 16, 2, 0, ": byte 16", "image width is 0"},
    {"an_image_of_4097_rows", 18, 2, 4097, ": byte 18", "image height"},
    {"a_map_of_no_width", 20, 2, 0, ": byte 20", "map width"},
    {"a_map_of_65535_rows", 22, 2, 65535, ": byte 22", "map height"},
    {"a_scale_beyond_all_doubles", 24, 4, 2000, ": byte 24", "scale"},
    {"a_method_flag_of_two", 33, 1, 2, ": byte 33", "method flag"},
    {"culling_without_a_method", 34, 1, 1, ": byte 34", "cull"},
    {"a_surface_without_a_method", 36, 1, 1, ": byte 36", "surface"},
    {"a_bias_without_a_method", 40, 4, 1, ": byte 40", "bias"},
    {"volumes_without_a_method", 38, 1, 1, ": byte 38", "shadow"},
    {"a_receiver_without_a_method", 39, 1, 1, ": byte 39", "receiver is 1; expected 0 to 0"},
    {"a_slope_without_a_method", 44, 4, 1, ": byte 44", "slope is 1; expected 0 to 0"},
    {"a_reconstruction_without_a_method", 48, 1, 1, ": byte 48", "reconstruction is 1; expected 0 to 0"},
    {"a_fit_without_a_method", 49, 1, 1, ": byte 49", "fit is 1; expected 0 to 0"},
    {"a_warp_without_a_method", 50, 1, 1, ": byte 50", "warp is 1; expected 0 to 0"},
    {"a_fitted_depth_without_a_method", 51, 1, 1, ": byte 51", "fitted depth is 1; expected 0 to 0"},
    {"smoothing_without_a_method", 52, 4, 65536, ": byte 52", "smoothing is 65536; expected 0 to 0"},
    {"an_unknown_projection", CAMERA, 1, 2, ": byte 56", "projection"},
    {"an_eye_out_of_range", CAMERA + 4, 4, 0x7fffffff, ": byte 60", "eye"},
    {"an_eye_of_the_least_number", CAMERA + 8, 4, 0x80000000, ": byte 64", "eye"},
    {"an_axis_longer_than_one", CAMERA + 16, 4, 0x7fffffff, ": byte 72", "axis"},
    {"axes_that_are_zero", CAMERA + 16, 4, 0, ": byte 72", "right angles"},
    {"axes_that_are_not_at_right_angles", CAMERA + 32, 4, 0x20000000, ": byte 72", "right angles"},
    {"a_field_of_view_of_zero", CAMERA + 52, 4, 0, ": byte 108", "tan_half"},
    {"a_field_of_view_too_wide", CAMERA + 52, 4, 0xffffffff, ": byte 108", "tan_half"},
    {"a_near_plane_at_zero", CAMERA + 60, 4, 0, ": byte 116", "near plane"},
    {"a_far_plane_before_the_near_one", CAMERA + 64, 4, 1, ": byte 120", "far plane"},
    {"an_unknown_kind_of_light", LIGHT, 1, 9, ": byte 124", "kind of light"},
    {"a_kind_that_no_light_has_yet", LIGHT, 1, 3, ": byte 124", "kind of light"},
    {"faces_of_a_light_that_has_none", LIGHT + 1, 1, 1, ": byte 125", "faces"},
    {"a_point_light_without_faces", LIGHT, 1, GN_POINT, ": byte 125", "faces"},
    {"a_light_whose_axes_are_broken", LIGHT + 4, 4, 0, ": byte 128", "right angles"},
    {"a_light_whose_box_is_empty", LIGHT + 52, 4, 0, ": byte 176", "size of the light's box"},
    {"a_light_whose_box_is_negative", LIGHT + 60, 4, 0xffffffff, ": byte 184", "size of the light's box"},
    {"a_light_whose_box_is_far_away", LIGHT + 40, 4, 0x7fffffff, ": byte 164", "corner of the light's box"},
    {"no_meshes", COUNTS, 4, 0, ": byte 212", "number of meshes"},
    {"more_meshes_than_bytes", COUNTS, 4, 0x10000000, ": byte 212", "number of meshes"},
    {"one_mesh_too_many", COUNTS, 4, 2, ": byte 280", "ends within a mesh"},
    {"no_objects", COUNTS + 4, 4, 0, ": byte 216", "number of objects"},
    {"one_object_too_many", COUNTS + 4, 4, 2, ": byte 280", "bytes left for the objects"},
    {"a_mesh_without_vertices", MESH, 4, 0, ": byte 220", "vertex count"},
    {"more_vertices_than_bytes", MESH, 4, 0x7fffffff, ": byte 236", "ends within a mesh"},
    {"a_mesh_without_triangles", MESH + 4, 4, 0, ": byte 224", "triangle count"},
    {"more_triangles_than_bytes", MESH + 4, 4, 0x7fffffff, ": byte 236", "ends within a mesh"},
    {"indices_of_one_byte", MESH + 8, 1, 1, ": byte 228", "bytes an index"},
    {"indices_of_three_bytes", MESH + 8, 1, 3, ": byte 232", "bytes an index"},
    {"padding_in_a_mesh", MESH + 10, 2, 1, ": byte 230", "padding"},
    {"more_edges_than_half-edges", EDGE_COUNT, 4, 4, ": byte 232", "edge count is 4; expected 0 to 3"},
    {"edges_that_are_missing", EDGE_COUNT, 4, 3, ": byte 236", "ends within a mesh"},
    {"a_mesh_neither_closed_nor_open", MESH + 9, 1, 2, ": byte 229", "closed"},
    {"a_vertex_out_of_range", VERTICES + 12, 4, (1 << 24) + 1, ": byte 248", "vertex coordinate"},
    {"an_index_beyond_the_vertices", INDICES + 2, 2, 3, ": byte 274", "index"},
    {"padding_after_the_indices", PADDING, 1, 7, ": byte 278", "padding"},
    {"an_object_of_no_mesh", OBJECT, 4, 1, ": byte 280", "mesh of an object"},
    {"padding_after_a_colour", OBJECT + 7, 1, 1, ": byte 287", "padding"},
};

static const change broken_methods[] = {
    {"an_unknown_cull", METHOD, 1, 4, ": byte 34", "cull is 4; expected 0 to 3"},
    {"an_unknown_number_of_layers", METHOD + 1, 1, 3, ": byte 35", "layers is 3; expected 0 to 2"},
    {"an_unknown_surface", METHOD + 2, 1, 6, ": byte 36", "surface is 6; expected 0 to 5"},
    {"an_unknown_unit", METHOD + 3, 1, 3, ": byte 37", "unit of the bias is 3; expected 0 to 2"},
    {"an_unknown_way_to_make_shadows", METHOD + 4, 1, 2, ": byte 38", "shadow is 2; expected 0 to 1"},
    {"an_unknown_receiver", METHOD + 5, 1, 4, ": byte 39", "receiver is 4; expected 0 to 3"},
    {"a_bias_beyond_the_world", 40, 4, (1 << 28) + 1, ": byte 40", "bias is 268435457; expected 0 to 268435456"},
    {"a_slope_above_64", 44, 4, (64 << 16) + 1, ": byte 44", "slope is 4194305; expected 0 to 4194304"},
    {"a_slope_below_0", 44, 4, 0xffffffff, ": byte 44", "slope is -1; expected 0 to 4194304"},
    {"an_unknown_reconstruction", 48, 1, 200, ": byte 48", "reconstruction is 200; expected 0 to 8"},
    {"an_unknown_fit", 49, 1, 3, ": byte 49", "fit is 3; expected 0 to 2"},
    {"an_unknown_warp", 50, 1, 6, ": byte 50", "warp is 6; expected 0 to 5"},
    {"a_fitted_depth_of_two", 51, 1, 2, ": byte 51", "fitted depth is 2; expected 0 to 1"},
    {"smoothing_above_64", 52, 4, (64 << 16) + 1, ": byte 52", "smoothing is 4194305; expected 0 to 4194304"},
    {"smoothing_below_a_64th", 52, 4, 1023, ": byte 52", "smoothing is 1023; expected 0, or 1024 to 4194304"},
};

static const change broken_edges[] = {
    {"an_edge_too_few", EDGE_COUNT, 4, 4, ": byte 336", "half-edge 5 stands in no edge"},
    {"an_edge_too_many", EDGE_COUNT, 4, 6, ": byte 344", "half-edge 0 stands in another edge already"},
    {"more_edges_than_bytes", EDGE_COUNT, 4, 9, ": byte 236", "and 9 edges"},
    {"a_half-edge_beyond_the_triangles", EDGES, 4, 9, ": byte 304", "half-edge is 9; expected 0 to 8"},
    {"an_edge_without_a_half-edge", EDGES, 4, GN_NO_HALF_EDGE, ": byte 304", "expected 0 to 8"},
    {"a_first_half-edge_with_a_flag", EDGES, 4, GN_SAME_DIRECTION, ": byte 304", "expected 0 to 8"},
    {"a_second_half-edge_beyond_the_triangles", EDGES + 12, 4, 9, ": byte 316", "half-edge is 9; expected 0 to 8"},
    {"one_with_the_flag", EDGES + 12, 4, 9 | GN_SAME_DIRECTION, ": byte 316", "half-edge is 9; expected 0 to 8"},
    {"one_that_is_almost_none", EDGES + 12, 4, GN_NO_HALF_EDGE - 1, ": byte 316", "expected 0 to 8"},
    {"a_half-edge_in_two_edges", EDGES + 8, 4, 0, ": byte 312", "half-edge 0 stands in another edge already"},
    {"a_half-edge_paired_with_itself", EDGES + 4, 4, 0, ": byte 308", "half-edge 0 stands in another edge already"},
    {"a_half-edge_left_out", EDGES + 12, 4, GN_NO_HALF_EDGE, ": byte 344", "half-edge 3 stands in no edge"},
    {"a_half-edge_of_a_triangle_without_area", EDGES, 4, 6, ": byte 304", "two corners at one place"},
    {"a_wrong_direction", EDGES + 12, 4, 3 | GN_SAME_DIRECTION, ": byte 312", "expected them to run"},
    {"a_pair_with_one_end_in_common", EDGES + 4, 4, 2, ": byte 304", "half-edges 0 and 2 make no edge"},
    {"a_pair_without_a_common_end", EDGES + 4, 4, 5, ": byte 304", "half-edges 0 and 5 make no edge"},
};

static int change_is_refused(const uint8_t *whole, size_t size, const change *c)
{
    uint8_t bytes[EDGED_SIZE];
    memcpy(bytes, whole, size);
    put(bytes, (size_t)c->at, c->size, c->value);
    put(bytes, 12, 4, crc32_of(bytes + 16, size - 16));
    sandbox_write("in.gno", bytes, size);
    return sandbox_refused(render_it("out.ppm"), "in.gno", c->where, c->what);
}

static void broken_files(void)
{
    uint8_t bytes[SIZE + 1];
    for (size_t i = 0; i < sizeof broken / sizeof *broken; i++)
        ok(change_is_refused(good, SIZE, &broken[i]), "%s_is_refused_with_its_place", broken[i].promise);
    for (size_t i = 0; i < sizeof broken_edges / sizeof *broken_edges; i++)
        ok(change_is_refused(edged, EDGED_SIZE, &broken_edges[i]), "%s_is_refused_with_its_place",
           broken_edges[i].promise);
    for (size_t i = 0; i < sizeof broken_methods / sizeof *broken_methods; i++)
        ok(change_is_refused(chosen, SIZE, &broken_methods[i]), "%s_is_refused_with_its_place",
           broken_methods[i].promise);
    memcpy(bytes, good, SIZE);
    bytes[VERTICES] ^= 1;
    sandbox_write("in.gno", bytes, SIZE);
    ok(sandbox_refused(render_it("out.ppm"), "in.gno", ": byte 12", "checksum"), "a_changed_bit_is_refused");
    memcpy(bytes, good, SIZE);
    bytes[SIZE] = 0;
    put(bytes, 8, 4, SIZE + 1);
    put(bytes, 12, 4, crc32_of(bytes + 16, SIZE + 1 - 16));
    sandbox_write("in.gno", bytes, SIZE + 1);
    ok(sandbox_refused(render_it("out.ppm"), "in.gno", ": byte 280", "9 bytes left"), "a_byte_too_many_is_refused");
}

/* A scene with its size and checksum put right; 0 if it is accepted. */
static int parse(uint8_t *bytes, size_t size)
{
    problem why;
    packed_scene packed;
    put(bytes, 8, 4, (uint32_t)size);
    put(bytes, 12, 4, crc32_of(bytes + 16, size - 16));
    int result = pack_parse(&packed, "f", bytes, size, &why);
    packed_free(&packed);
    return result;
}

/* The second triangle turned round: half-edge 3 then runs as half-edge 1 does. */
static void both_directions(void)
{
    uint8_t bytes[EDGED_SIZE];
    memcpy(bytes, edged, EDGED_SIZE);
    put(bytes, EDGED_INDICES + 6, 4, 1 | 2 << 16);
    ok(parse(bytes, EDGED_SIZE) == -1, "two_half-edges_of_one_direction_are_refused_without_the_flag");
    put(bytes, EDGES + 12, 4, 3 | GN_SAME_DIRECTION);
    ok(parse(bytes, EDGED_SIZE) == 0, "and_accepted_with_it");
    memcpy(bytes, edged, EDGED_SIZE);
    put(bytes, EDGES + 12, 4, GN_NO_HALF_EDGE);
    put(bytes, EDGES + 36, 4, 3);
    ok(parse(bytes, EDGED_SIZE) == -1, "half-edges_paired_with_strangers_are_refused");
}

/* Where a half-edge of the two triangles that have an area starts and ends. */
static uint32_t start_of(uint32_t half)
{
    return get(edged, EDGED_INDICES + 2 * half, 2);
}

static uint32_t end_of(uint32_t half)
{
    return start_of(half < 3 ? (half + 1) % 3 : 3 + (half + 1) % 3);
}

/* What gn_mesh_edge promises, for that mesh. */
static int promise_holds(const uint8_t *bytes)
{
    int uses[6] = {0};
    for (int i = 0; i < EDGE_WORDS / 2; i++) {
        uint32_t a = get(bytes, (size_t)(EDGES + 8 * i), 4), second = get(bytes, (size_t)(EDGES + 8 * i + 4), 4);
        uint32_t b = second % GN_SAME_DIRECTION, same = second / GN_SAME_DIRECTION;
        if (a >= 6 || (second != GN_NO_HALF_EDGE && b >= 6))
            return 0;
        uses[a]++;
        if (second == GN_NO_HALF_EDGE)
            continue;
        uses[b]++;
        if (same ? start_of(a) != start_of(b) || end_of(a) != end_of(b)
                 : start_of(a) != end_of(b) || end_of(a) != start_of(b))
            return 0;
    }
    for (int i = 0; i < 6; i++)
        if (uses[i] != 1)
            return 0;
    return 1;
}

/* Edges in another order are as good, and so is each one turned round; one word more or less is a mistake or is not. */
static void random_edges(void)
{
    uint64_t state = 1;
    int accepted = 0, wrong = 0, cases = 200000;
    for (int i = 0; i < cases && !wrong; i++) {
        uint8_t bytes[EDGED_SIZE];
        uint64_t random = tap_random(&state);
        memcpy(bytes, edged, EDGED_SIZE);
        for (int swaps = 0; swaps < 6; swaps++) {
            uint64_t r = tap_random(&state);
            size_t a = EDGES + 8 * (r % 5), b = EDGES + 8 * ((r >> 16) % 5), size = r >> 32 & 1 ? 8 : 4;
            uint32_t first = get(bytes, a, 4), second = get(bytes, a + 4, 4);
            put(bytes, a, 4, get(bytes, b, 4)), put(bytes, b, 4, first);
            if (size == 8)
                put(bytes, a + 4, 4, get(bytes, b + 4, 4)), put(bytes, b + 4, 4, second);
        }
        if (random % 4 == 0)
            put(bytes, EDGES + 4 * ((random >> 8) % EDGE_WORDS), 4,
                (uint32_t)((random >> 16) % 7) | (random >> 32 & 1 ? GN_SAME_DIRECTION : 0));
        int result = parse(bytes, EDGED_SIZE);
        wrong = (result == 0) != promise_holds(bytes);
        accepted += result == 0;
        if (wrong)
            note("case %d: %s", i, result ? "refused" : "accepted");
    }
    ok(!wrong && accepted > 100 && accepted < cases - 100,
       "edges_changed_at_random_are_accepted_where_they_keep_the_promise_alone");
}

/* Every shorter file, with and without a size and checksum that fit. */
static int refused_when_cut_off(const uint8_t *whole, size_t whole_size)
{
    size_t refused = 0;
    problem why;
    packed_scene packed;
    for (size_t size = 0; size < whole_size; size++)
        for (int fitting = 0; fitting < 2; fitting++) {
            uint8_t *bytes = malloc(size + 1); /* of its own, so that the address sanitizer sees reads beyond it */
            memcpy(bytes, whole, size);
            if (fitting && size >= 16) {
                put(bytes, 8, 4, (uint32_t)size);
                put(bytes, 12, 4, crc32_of(bytes + 16, size - 16));
            }
            bytes[size] = 0;
            refused += pack_parse(&packed, "f", bytes, size, &why) == -1;
            packed_free(&packed);
            free(bytes);
        }
    return refused == 2 * whole_size;
}

static void truncated_files(void)
{
    ok(refused_when_cut_off(good, SIZE), "a_file_cut_off_anywhere_is_refused");
    ok(refused_when_cut_off(chosen, SIZE), "a_file_with_a_method_cut_off_anywhere_is_refused");
    ok(refused_when_cut_off(edged, EDGED_SIZE), "a_file_with_edges_cut_off_anywhere_is_refused");
}

int main(void)
{
    sandbox_open();
    make_good();
    round_trip();
    a_method_is_kept();
    all_of_a_method_is_packed();
    every_receiver_and_reconstruction_comes_back();
    every_fit_and_warp_comes_back();
    nothing_is_left_of_no_fit_and_no_warp();
    edges_are_packed();
    volumes_are_kept();
    silhouettes_are_kept();
    silhouettes_get_edges();
    a_closed_mesh_is_kept();
    broken_files();
    both_directions();
    random_edges();
    truncated_files();
    sandbox_close();
    return tap_done();
}
