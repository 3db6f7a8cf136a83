/* Packed scenes: what is packed comes back, also as a C header, and broken .gno files are refused with their place. */
#include "pack.h"
#include "sandbox.h"

static const char scene[] = "image 8 6\nmap 16 12\nambient 0.2\nlight directional direction 0 -1 0.1\n"
                            "camera perspective eye 0 5 9 target 0 0 0 up 0 1 0 fovy 40 near 1 far 99\n"
                            "mesh in.obj surface open color 1 0.5 0\n";

/* Offsets in the packed scene of one triangle: host/pack.h. */
enum {
    CAMERA = 44,
    LIGHT = 112,
    COUNTS = 200,
    MESH = 208,
    VERTICES = 220,
    INDICES = 256,
    PADDING = 262,
    OBJECT = 264,
    SIZE = 272
};

static uint8_t good[SIZE];

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
    FILE *file = fopen(sandbox_path("in.gno"), "rb");
    size_t size = file ? fread(good, 1, SIZE, file) : 0;
    ok(file && size == SIZE && fgetc(file) == EOF, "its_size_is_as_documented");
    if (file)
        fclose(file);
    static const uint8_t start[] = {'G', 'N', 'O', 'M', 1, 0, 0, 0, SIZE & 255, SIZE >> 8, 0, 0};
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
    FILE *file = fopen(sandbox_path("in-again.gno"), "rb");
    ok(status == EXIT_DONE && file && fread(bytes, 1, SIZE, file) == SIZE && memcmp(bytes, good, SIZE) == 0,
       "packing_a_packed_scene_changes_nothing");
    if (file)
        fclose(file);
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

static const struct {
    const char *promise;
    int at, size;
    uint32_t value;
    const char *where, *what;
} broken[] = {
    {"another_magic_number", 0, 1, 'X', ": byte 0", "GNOM"},
    {"another_version", 4, 4, 2, ": byte 4", "version 2"},
    {"a_wrong_size", 8, 4, SIZE + 1, ": byte 8", "says that it has 273 bytes"},
    {"an_image_of_no_width", 16, 2, 0, ": byte 16", "image width is 0"},
    {"an_image_of_4097_rows", 18, 2, 4097, ": byte 18", "image height"},
    {"a_map_of_no_width", 20, 2, 0, ": byte 20", "map width"},
    {"a_map_of_65535_rows", 22, 2, 65535, ": byte 22", "map height"},
    {"a_scale_beyond_all_doubles", 24, 4, 2000, ": byte 24", "scale"},
    {"a_method_flag_of_two", 33, 1, 2, ": byte 33", "method flag"},
    {"culling_without_a_method", 34, 1, 1, ": byte 34", "cull"},
    {"a_surface_without_a_method", 36, 1, 1, ": byte 36", "surface"},
    {"a_bias_without_a_method", 40, 4, 1, ": byte 40", "bias"},
    {"padding_that_is_not_zero", 38, 2, 1, ": byte 38", "padding"},
    {"an_unknown_projection", CAMERA, 1, 2, ": byte 44", "projection"},
    {"an_eye_out_of_range", CAMERA + 4, 4, 0x7fffffff, ": byte 48", "eye"},
    {"an_eye_of_the_least_number", CAMERA + 8, 4, 0x80000000, ": byte 52", "eye"},
    {"an_axis_longer_than_one", CAMERA + 16, 4, 0x7fffffff, ": byte 60", "axis"},
    {"axes_that_are_zero", CAMERA + 16, 4, 0, ": byte 60", "right angles"},
    {"axes_that_are_not_at_right_angles", CAMERA + 32, 4, 0x20000000, ": byte 60", "right angles"},
    {"a_field_of_view_of_zero", CAMERA + 52, 4, 0, ": byte 96", "tan_half"},
    {"a_field_of_view_too_wide", CAMERA + 52, 4, 0xffffffff, ": byte 96", "tan_half"},
    {"a_near_plane_at_zero", CAMERA + 60, 4, 0, ": byte 104", "near plane"},
    {"a_far_plane_before_the_near_one", CAMERA + 64, 4, 1, ": byte 108", "far plane"},
    {"an_unknown_kind_of_light", LIGHT, 1, 9, ": byte 112", "kind of light"},
    {"a_light_whose_axes_are_broken", LIGHT + 4, 4, 0, ": byte 116", "right angles"},
    {"a_light_whose_box_is_empty", LIGHT + 52, 4, 0, ": byte 164", "size of the light's box"},
    {"a_light_whose_box_is_negative", LIGHT + 60, 4, 0xffffffff, ": byte 172", "size of the light's box"},
    {"a_light_whose_box_is_far_away", LIGHT + 40, 4, 0x7fffffff, ": byte 152", "corner of the light's box"},
    {"no_meshes", COUNTS, 4, 0, ": byte 200", "number of meshes"},
    {"more_meshes_than_bytes", COUNTS, 4, 0x10000000, ": byte 200", "number of meshes"},
    {"one_mesh_too_many", COUNTS, 4, 2, ": byte 264", "ends within a mesh"},
    {"no_objects", COUNTS + 4, 4, 0, ": byte 204", "number of objects"},
    {"one_object_too_many", COUNTS + 4, 4, 2, ": byte 264", "bytes left for the objects"},
    {"a_mesh_without_vertices", MESH, 4, 0, ": byte 208", "vertex count"},
    {"more_vertices_than_bytes", MESH, 4, 0x7fffffff, ": byte 220", "ends within a mesh"},
    {"a_mesh_without_triangles", MESH + 4, 4, 0, ": byte 212", "triangle count"},
    {"more_triangles_than_bytes", MESH + 4, 4, 0x7fffffff, ": byte 220", "ends within a mesh"},
    {"indices_of_one_byte", MESH + 8, 1, 1, ": byte 216", "bytes an index"},
    {"indices_of_three_bytes", MESH + 8, 1, 3, ": byte 220", "bytes an index"},
    {"a_mesh_neither_closed_nor_open", MESH + 9, 1, 2, ": byte 217", "closed"},
    {"a_vertex_out_of_range", VERTICES + 12, 4, (1 << 24) + 1, ": byte 232", "vertex coordinate"},
    {"an_index_beyond_the_vertices", INDICES + 2, 2, 3, ": byte 258", "index"},
    {"padding_after_the_indices", PADDING, 1, 7, ": byte 262", "padding"},
    {"an_object_of_no_mesh", OBJECT, 4, 1, ": byte 264", "mesh of an object"},
    {"padding_after_a_colour", OBJECT + 7, 1, 1, ": byte 271", "padding"},
};

static void broken_files(void)
{
    uint8_t bytes[SIZE + 1];
    for (size_t i = 0; i < sizeof broken / sizeof *broken; i++) {
        memcpy(bytes, good, SIZE);
        put(bytes, (size_t)broken[i].at, broken[i].size, broken[i].value);
        put(bytes, 12, 4, crc32_of(bytes + 16, SIZE - 16));
        sandbox_write("in.gno", bytes, SIZE);
        ok(sandbox_refused(render_it("out.ppm"), "in.gno", broken[i].where, broken[i].what),
           "%s_is_refused_with_its_place", broken[i].promise);
    }
    memcpy(bytes, good, SIZE);
    bytes[VERTICES] ^= 1;
    sandbox_write("in.gno", bytes, SIZE);
    ok(sandbox_refused(render_it("out.ppm"), "in.gno", ": byte 12", "checksum"), "a_changed_bit_is_refused");
    memcpy(bytes, good, SIZE);
    bytes[SIZE] = 0;
    put(bytes, 8, 4, SIZE + 1);
    put(bytes, 12, 4, crc32_of(bytes + 16, SIZE + 1 - 16));
    sandbox_write("in.gno", bytes, SIZE + 1);
    ok(sandbox_refused(render_it("out.ppm"), "in.gno", ": byte 264", "9 bytes left"), "a_byte_too_many_is_refused");
}

/* Every shorter file, with and without a size and checksum that fit. */
static void truncated_files(void)
{
    int refused = 0;
    problem why;
    packed_scene packed;
    for (size_t size = 0; size < SIZE; size++)
        for (int fitting = 0; fitting < 2; fitting++) {
            uint8_t *bytes = malloc(size + 1); /* of its own, so that the address sanitizer sees reads beyond it */
            memcpy(bytes, good, size);
            if (fitting && size >= 16) {
                put(bytes, 8, 4, (uint32_t)size);
                put(bytes, 12, 4, crc32_of(bytes + 16, size - 16));
            }
            bytes[size] = 0;
            refused += pack_parse(&packed, "f", bytes, size, &why) == -1;
            packed_free(&packed);
            free(bytes);
        }
    ok(refused == 2 * SIZE, "a_file_cut_off_anywhere_is_refused");
}

int main(void)
{
    sandbox_open();
    make_good();
    round_trip();
    a_method_is_kept();
    broken_files();
    truncated_files();
    sandbox_close();
    return tap_done();
}
