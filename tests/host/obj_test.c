/* The OBJ reader: what it takes, and that it refuses broken files with file and line. */
#include "obj.h"
#include "sandbox.h"

static const char scene[] = "image 8 8\nmap 8\nambient 0.2\nlight directional direction 0 -1 0.1\n"
                            "camera perspective eye 0 5 9 target 0 0 0 up 0 1 0 fovy 40 near 1 far 99\n"
                            "mesh in.obj surface open color 1 1 1\n";

#define TRIANGLE "v 0 0 0\nv 1 0 0\nv 0 1 0\n"

/* The triangles as text, "0 1 2; 0 2 3;", or the problem. */
static const char *parsed(const char *text)
{
    static char shown[1200];
    obj_mesh mesh;
    problem why;
    size_t at = 0;
    shown[0] = 0;
    if (obj_parse(&mesh, "f", text, strlen(text), &why))
        snprintf(shown, sizeof shown, "%s", why.text);
    else
        for (size_t t = 0; t < mesh.triangle_count; t++)
            at += (size_t)snprintf(shown + at, sizeof shown - at, "%u %u %u;", (unsigned)mesh.triangles[t][0],
                                   (unsigned)mesh.triangles[t][1], (unsigned)mesh.triangles[t][2]);
    obj_free(&mesh);
    return shown;
}

static void gives(const char *text, const char *triangles, const char *promise)
{
    const char *got = parsed(text);
    if (!ok(strcmp(got, triangles) == 0, "%s", promise))
        note("got %s, expected %s", got, triangles);
}

static void good_files(void)
{
    gives(TRIANGLE "f 1 2 3\n", "0 1 2;", "a_triangle_is_read");
    gives(TRIANGLE "v 1 1 0\nv 2 2 0\nf 1 2 4 5 3\n", "0 1 3;0 3 4;0 4 2;",
          "a_polygon_becomes_a_fan_from_its_first_corner");
    gives(TRIANGLE "vt 0 0\nvn 0 0 1\nf 1/1 2/1 3/1\nf 1//1 2//1 3//1\nf 1/1/1 2/1/1 3/1/1\n", "0 1 2;0 1 2;0 1 2;",
          "corners_may_name_texture_coordinates_and_normals");
    gives(TRIANGLE "f -3 -2 -1\nv 5 5 5\nf -1 -2 -3\n", "0 1 2;3 2 1;",
          "negative_indices_count_from_the_last_vertex_so_far");
    gives(TRIANGLE "vt 0 0\nvn 0 0 1\nf -3/-1/-1 2//-1 3/-1\n", "0 1 2;", "corners_of_one_face_may_differ_in_kind");
    gives("v 0 0 0\r\nv 1 0 0\r\nv 0 1 0\r\nf 1 2 3\r\n", "0 1 2;", "lines_may_end_with_carriage_return_and_line_feed");
    gives("v\t0\t0  0 \t\nv 1 0 0\t\n  v 0 1 0\n\tf  1\t2 3  \t", "0 1 2;", "tabs_and_trailing_blanks_are_blanks");
    gives(TRIANGLE "f 1 \\\n2 \\\r\n3\n", "0 1 2;", "a_backslash_continues_the_line");
    gives("v 0 0 0 # first\n# v\nv 1 0 0\nv 0 1 0\nf 1 2 3 # all\n", "0 1 2;", "comments_end_at_the_line");
    gives("mtllib a.mtl\no thing\ng a b\nusemtl red\ns off\n" TRIANGLE "vp 1 2\nl 1 2\np 1\ncurv 0 1\nf 1 2 3\n",
          "0 1 2;", "unknown_directives_are_ignored");
    gives("v 0 0 0 1\nv 1 0 0 0.5 0.5 0.5\nv 0 1 0 1 0 0 1\nf 1 2 3", "0 1 2;", "a_vertex_may_carry_w_and_colour");
    gives(TRIANGLE "f 1 1 2\n", "0 0 1;", "degenerate_triangles_are_kept");
    gives("\xef\xbb\xbf" TRIANGLE "f 1 2 3\n", "0 1 2;", "a_byte_order_mark_is_skipped");
    gives("v +1. -.5e+1 1E-3\nv 1 0 0\nv 0 1 0\nf +1 +2 +3", "0 1 2;", "numbers_may_have_signs_and_exponents");
}

static void positions_are_exact(void)
{
    static const char text[] = "v 0.1 -2.5 3e2 9\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    obj_mesh mesh;
    problem why;
    int result = obj_parse(&mesh, "f", text, strlen(text), &why);
    ok(!result && mesh.position_count == 3 && mesh.positions[0][0] == 0.1 && mesh.positions[0][1] == -2.5 &&
           mesh.positions[0][2] == 300,
       "positions_are_the_nearest_doubles");
    obj_free(&mesh);
}

static const struct {
    const char *promise, *text, *where, *what;
} broken[] = {
    {"an_empty_file", "", ":1", "without a face"},
    {"a_file_of_comments", "# a\n# b\n", ":3", "without a face"},
    {"vertices_without_faces", TRIANGLE, ":4", "without a face"},
    {"a_vertex_without_numbers", "v\nf 1 1 1\n", ":1", "0 numbers"},
    {"a_vertex_of_one_number", "v 1\n", ":1", "1 numbers"},
    {"a_vertex_of_two_numbers", TRIANGLE "v 1 2\n", ":4", "2 numbers"},
    {"a_vertex_of_eight_numbers", "v 1 2 3 4 5 6 7 8\n", ":1", "more than 7"},
    {"a_word_for_a_coordinate", "v 0 0 zero\n", ":1", "'zero' is not a number"},
    {"a_number_with_a_tail", "v 0 0 1.5m\n", ":1", "'1.5m' is not a number"},
    {"a_decimal_comma", "v 0 0 1,5\n", ":1", "'1,5' is not a number"},
    {"a_hexadecimal_number", "v 0 0 0x10\n", ":1", "'0x10' is not a number"},
    {"infinity", "v 0 0 inf\n", ":1", "'inf' is not a number"},
    {"not_a_number", "v nan 0 0\n", ":1", "'nan' is not a number"},
    {"a_number_beyond_double", "v 0 0 1e999\n", ":1", "'1e999' is not a number"},
    {"a_coordinate_beyond_the_limit", "v 0 0 2e12\n", ":1", "too large"},
    {"two_signs", "v 0 0 --1\n", ":1", "'--1' is not a number"},
    {"an_exponent_without_digits", "v 0 0 1e\n", ":1", "'1e' is not a number"},
    {"a_word_after_the_coordinates", "v 0 0 0 red\n", ":1", "'red' is not a number"},
    {"a_face_without_corners", TRIANGLE "f\n", ":4", "0 corners"},
    {"a_face_of_two_corners", TRIANGLE "f 1 2\n", ":4", "2 corners"},
    {"index_zero", TRIANGLE "f 0 1 2\n", ":4", "vertex 0 does not exist"},
    {"an_index_beyond_the_vertices", TRIANGLE "f 1 2 4\n", ":4", "vertex 4 does not exist"},
    {"a_vertex_that_comes_later", "v 0 0 0\nv 1 0 0\nf 1 2 3\nv 0 1 0\n", ":3", "vertex 3 does not exist"},
    {"a_negative_index_before_the_first", TRIANGLE "f -4 -2 -1\n", ":4", "vertex -4 does not exist"},
    {"a_face_before_all_vertices", "f 1 2 3\n", ":1", "vertex 1 does not exist"},
    {"an_index_beyond_64_bits", TRIANGLE "f 1 2 99999999999999999999\n", ":4", "not a corner"},
    {"an_index_of_2_to_the_32_plus_1", TRIANGLE "f 1 2 4294967297\n", ":4", "does not exist"},
    {"a_word_for_an_index", TRIANGLE "f 1 2 x\n", ":4", "'x' is not a corner"},
    {"a_fraction_for_an_index", TRIANGLE "f 1 2 3.0\n", ":4", "'3.0' is not a corner"},
    {"a_corner_that_ends_with_a_slash", TRIANGLE "f 1/ 2/ 3/\n", ":4", "not a corner"},
    {"a_corner_that_ends_with_two_slashes", TRIANGLE "f 1// 2// 3//\n", ":4", "not a corner"},
    {"a_corner_of_four_parts", TRIANGLE "vt 0 0\nvn 0 0 1\nf 1/1/1/1 2 3\n", ":6", "not a corner"},
    {"a_corner_without_its_vertex", TRIANGLE "vt 0 0\nf /1 2 3\n", ":5", "not a corner"},
    {"a_texture_coordinate_that_does_not_exist", TRIANGLE "f 1/1 2/1 3/1\n", ":4", "texture coordinate 1"},
    {"a_texture_index_beyond_the_last", TRIANGLE "vt 0 0\nf 1/1 2/1 3/2\n", ":5", "texture coordinate 2"},
    {"a_normal_that_does_not_exist", TRIANGLE "f 1//1 2//1 3//1\n", ":4", "normal 1 does not exist"},
    {"a_normal_index_before_the_first", TRIANGLE "vn 0 0 1\nf 1//-2 2 3\n", ":5", "normal -2 does not exist"},
    {"a_normal_of_two_numbers", TRIANGLE "vn 0 1\nf 1 2 3\n", ":4", "normal has 2 numbers"},
    {"a_texture_coordinate_without_numbers", TRIANGLE "vt\nf 1 2 3\n", ":4", "0 numbers"},
    {"a_word_in_a_normal", TRIANGLE "vn 0 1 up\nf 1 2 3\n", ":4", "'up' is not a number"},
    {"a_broken_continued_line", TRIANGLE "f 1 \\\n2 \\\nx\n", ":6", "'x' is not a corner"},
    {"a_line_cut_off", TRIANGLE "f 1 2 3\nf 1 2", ":5", "2 corners"},
};

static void broken_files(void)
{
    sandbox_write_text("in.scene", scene);
    for (size_t i = 0; i < sizeof broken / sizeof *broken; i++) {
        sandbox_write_text("in.obj", broken[i].text);
        const char *arguments[] = {sandbox_path("in.scene"), "-o", sandbox_path("out.ppm"), 0};
        int status = sandbox_run(command_render, arguments);
        ok(sandbox_refused(status, "in.obj", broken[i].where, broken[i].what), "%s_is_refused_with_file_and_line",
           broken[i].promise);
    }
    sandbox_write("in.obj", "v 0 0 0\nv 1\0 0 0\n", 17);
    const char *arguments[] = {sandbox_path("in.scene"), "-o", sandbox_path("out.ppm"), 0};
    int status = sandbox_run(command_render, arguments);
    ok(sandbox_refused(status, "in.obj", ": byte 11", "zero byte"), "a_zero_byte_is_refused_with_its_place");
    sandbox_write_text("in.obj", TRIANGLE "f 1 2 3\n");
    ok(sandbox_run(command_render, arguments) == EXIT_DONE && sandbox_has("out.ppm"),
       "the_same_scene_with_a_good_mesh_renders");
}

int main(void)
{
    good_files();
    positions_are_exact();
    sandbox_open();
    broken_files();
    sandbox_close();
    return tap_done();
}
