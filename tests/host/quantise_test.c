/* From a scene file to integers: scale, rounding, transforms and biases, against figures worked out by hand. */
#include "quantise.h"
#include "sandbox.h"

#define CAMERA "camera perspective eye 0 5 9 target 0 0 0 up 0 1 0 fovy 90 near 1 far 99\n"
#define SUN "light directional direction 0 -1 0.1\n"
#define HEAD "image 8 6\nmap 16\nambient 0.5\n"

static packed_scene packed;
static problem why;

/* Quantise a scene with in.obj beside it; 0 on success. */
static int quantised(const char *text, const char *obj)
{
    packed_free(&packed);
    sandbox_write_text("in.scene", text);
    sandbox_write_text("in.obj", obj);
    why.text[0] = 0;
    return packed_read(&packed, sandbox_path("in.scene"), 0, &why);
}

static int vertex_is(uint32_t index, int32_t x, int32_t y, int32_t z)
{
    if (!packed.mesh_count || index >= packed.meshes[0].vertex_count)
        return 0;
    const int32_t *v = packed.meshes[0].vertices[index];
    if (v[0] != x || v[1] != y || v[2] != z)
        note("vertex %u is %d %d %d, expected %d %d %d", (unsigned)index, (int)v[0], (int)v[1], (int)v[2], (int)x,
             (int)y, (int)z);
    return v[0] == x && v[1] == y && v[2] == z;
}

static int triangle_is(uint16_t a, uint16_t b, uint16_t c)
{
    const uint16_t *i = packed.mesh_count ? packed.meshes[0].indices : 0;
    return i && packed.meshes[0].index_size == 2 && i[0] == a && i[1] == b && i[2] == c;
}

static void the_scale(void)
{
    static const char scene[] = HEAD CAMERA SUN "mesh in.obj surface open color 1 .5 0\n";
    ok(quantised(scene, "v 0 0 0\nv 4 0 0\nv 0 3 1\nf 1 2 3\n") == 0 && packed.scale == 22 &&
           vertex_is(1, 1 << 24, 0, 0) && vertex_is(2, 0, 3 << 22, 1 << 22) && packed.largest_rounding == 0,
       "a_largest_coordinate_of_a_power_of_two_becomes_2_to_the_24");
    ok(quantised(scene, "v 0 0 0\nv -4.0000001 0 0\nv 0 3 1\nf 1 2 3\n") == 0 && packed.scale == 21 &&
           vertex_is(1, -(1 << 23), 0, 0),
       "a_little_more_halves_the_scale");
    ok(packed.largest_rounding > 0.9e-7 && packed.largest_rounding < 1.1e-7, "the_largest_rounding_is_reported");
    ok(quantised(scene, "v 0 0 0\nv 4 0.00000011920928955078125 0\nv -0.00000011920928955078125 1 1\nf 1 2 3\n") == 0 &&
           vertex_is(1, 1 << 24, 1, 0) && vertex_is(2, -1, 1 << 22, 1 << 22),
       "half_a_unit_is_rounded_away_from_zero");
    ok(packed.scene.ambient == 32768 && packed.objects[0].colour.r == 255 && packed.objects[0].colour.g == 128 &&
           packed.objects[0].colour.b == 0,
       "colours_and_ambient_are_rounded_half_up");
    ok(packed.camera.eye[1] == 5 << 22 && packed.camera.near_depth == 1 << 22 && packed.camera.tan_half == 1 << 24,
       "the_camera_has_the_scale_of_the_scene");
}

static void transforms(void)
{
    static const char mesh[] = "v 1 0 0\nv 0 1 0\nv 0 0 4\nf 1 2 3\n";
    ok(quantised(HEAD CAMERA SUN
                 "mesh in.obj surface open color 1 1 1 translate 1 2 -0.5 rotate 0 0 2 90 scale 2 3 1\n",
                 mesh) == 0 &&
           packed.scale == 22 && vertex_is(0, 1 << 22, 4 << 22, -(1 << 21)) &&
           vertex_is(1, -(2 << 22), 2 << 22, -(1 << 21)) && vertex_is(2, 1 << 22, 2 << 22, 7 << 21),
       "a_mesh_is_scaled_then_rotated_then_moved");
    ok(triangle_is(0, 1, 2), "corners_stay_in_order");
    ok(quantised(HEAD CAMERA SUN "mesh in.obj surface open color 1 1 1 scale -1 1 1\n", mesh) == 0 &&
           triangle_is(0, 2, 1) && vertex_is(0, -(1 << 22), 0, 0),
       "a_mirrored_mesh_has_its_corners_swapped");
    ok(quantised(HEAD CAMERA SUN "mesh in.obj surface open color 1 1 1 scale -1 -1 1\n", mesh) == 0 &&
           triangle_is(0, 1, 2),
       "a_mesh_mirrored_twice_has_not");
}

static void ranges(void)
{
    static const char mesh[] = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    static const char end[] = SUN "mesh in.obj surface open color 1 1 1\n";
    char text[1000];
    snprintf(text, sizeof text, HEAD "camera perspective eye 0 8 0 target 0 0 0 up 0 0 1 fovy 40 near 1 far 99\n%s",
             end);
    ok(quantised(text, mesh) == 0 && packed.scale == 24 && packed.camera.eye[1] == 1 << 27,
       "an_eye_at_eight_times_the_largest_coordinate_costs_nothing");
    snprintf(text, sizeof text, HEAD "camera perspective eye 0 32 0 target 0 0 0 up 0 0 1 fovy 40 near 1 far 99\n%s",
             end);
    ok(quantised(text, mesh) == 0 && packed.scale == 22 && vertex_is(1, 1 << 22, 0, 0),
       "an_eye_at_32_times_leaves_22_bits");
    snprintf(text, sizeof text, HEAD "camera perspective eye 0 33 0 target 0 0 0 up 0 0 1 fovy 40 near 1 far 99\n%s",
             end);
    ok(quantised(text, mesh) == -1 && strstr(why.text, ":4: ") && strstr(why.text, "expected at most 32"),
       "an_eye_farther_away_is_refused");
    ok(quantised(HEAD "camera perspective eye 0 5 5 target 0 0 0 up 0 1 0 fovy 40 near 0.001 far 1e9\n" SUN
                      "mesh in.obj surface open color 1 1 1\n",
                 mesh) == 0 &&
           packed.camera.near_depth == 16777 && packed.camera.far_depth == 1 << 28,
       "planes_beyond_the_range_are_clamped");
    ok(quantised(HEAD "camera perspective eye 0 5 5 target 0 0 0 up 0 1 0 fovy 40 near 0.000000001 far 9\n" SUN
                      "mesh in.obj surface open color 1 1 1\n",
                 mesh) == -1 &&
           strstr(why.text, ":4: near") && strstr(why.text, "expected at least"),
       "a_near_plane_too_near_for_the_formats_is_refused");
    ok(quantised(HEAD "camera orthographic eye 0 5 5 target 0 0 0 up 0 1 0 height 16 near -2 far 90\n" SUN
                      "mesh in.obj surface open color 1 1 1\n",
                 mesh) == 0 &&
           packed.scale == 23 && packed.camera.half_height == 1 << 26 && packed.camera.near_depth == -(2 << 23),
       "an_image_higher_than_the_range_lowers_the_scale");
}

static void biases(void)
{
    gn_bias b;
    ok(quantise_bias(&b, "0.5", 4, &why) == 0 && b.unit == GN_BIAS_WORLD && b.value == 8,
       "a_bias_in_world_units_is_scaled");
    ok(quantise_bias(&b, "2t", 4, &why) == 0 && b.unit == GN_BIAS_TEXELS && b.value == 2 << 16,
       "a_bias_in_texels_is_q16_16");
    ok(quantise_bias(&b, "0.25r", 4, &why) == 0 && b.unit == GN_BIAS_RANGE && b.value == 1u << 30,
       "a_bias_of_the_range_is_q0_32");
    ok(quantise_bias(&b, "0", 4, &why) == 0 && b.value == 0, "no_bias_is_a_bias");
    static const char *const bad[] = {"",    "t",  "r",      "-1",  "1x",  "1 t",  "nan",
                                      "0x1", "1r", "65536t", "1e9", "1tt", "-0.1r"};
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++)
        ok(quantise_bias(&b, bad[i], 4, &why) == -1 && strstr(why.text, "expected"), "the_bias_'%s'_is_refused",
           bad[i]);
}

#define TETRAHEDRON "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\n"

static void closed_meshes(void)
{
    static const char scene[] = HEAD CAMERA SUN "mesh in.obj surface closed color 1 1 1\n";
    ok(quantised(scene, TETRAHEDRON "f 1 4 3\n") == 0 && packed.meshes[0].closed, "a_tetrahedron_is_closed");
    ok(quantised(scene, TETRAHEDRON "v 0 0 0\nv 0 0 1.0\nv -0 1 0\nf 5 6 7\n") == 0, "equal_positions_are_merged");
    ok(quantised(scene, TETRAHEDRON) == -1 && strstr(why.text, "in.scene:6: ") && strstr(why.text, "is not closed"),
       "a_tetrahedron_without_a_face_is_not_closed");
    ok(quantised(scene, TETRAHEDRON "f 1 3 4\n") == -1 && strstr(why.text, "is not closed"),
       "a_face_the_wrong_way_round_is_not_closed");
    ok(quantised(scene, TETRAHEDRON "f 1 4 3\nv 2 0 0\nv 2 1 0\nv 2 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n") == 0,
       "edges_of_more_than_two_triangles_are_allowed");
    ok(quantised(scene, TETRAHEDRON "f 1 4 3\nf 1 1 2\n") == 0, "degenerate_triangles_do_not_open_a_mesh");
}

static void wide_indices(void)
{
    static char text[65537 * 12 + 100];
    size_t at = 0;
    for (int i = 0; i < 65537; i++)
        at += (size_t)sprintf(text + at, "v %d %d 0\n", i % 256, i / 256);
    sprintf(text + at, "f 1 2 300\n");
    ok(quantised(HEAD CAMERA SUN "mesh in.obj surface open color 1 1 1\n", text) == 0 &&
           packed.meshes[0].index_size == 4 && ((const uint32_t *)packed.meshes[0].indices)[2] == 299,
       "more_than_65536_vertices_take_indices_of_32_bits");
    ok(strcpy(strstr(text, "v 0 256 0\n"), "f 1 2 300\n") &&
           quantised(HEAD CAMERA SUN "mesh in.obj surface open color 1 1 1\n", text) == 0 &&
           packed.meshes[0].vertex_count == 65536 && packed.meshes[0].index_size == 2,
       "65536_vertices_take_indices_of_16_bits");
}

int main(void)
{
    sandbox_open();
    the_scale();
    transforms();
    ranges();
    biases();
    closed_meshes();
    wide_indices();
    packed_free(&packed);
    sandbox_close();
    return tap_done();
}
