/* The scene reader: what it takes, and that it refuses broken files with file and line. */
#include "sandbox.h"
#include "scene_file.h"

#define IMAGE "image 8 6\n"
#define MAP "map 16\n"
#define CAMERA "camera perspective eye 0 5 9 target 0 0 0 up 0 1 0 fovy 40 near 1 far 99\n"
#define LIGHT "light directional direction 0 -1 0.1\n"
#define AMBIENT "ambient 0.2\n"
#define MESH "mesh in.obj surface open color 1 1 1\n"
#define BEFORE_MESH IMAGE MAP CAMERA LIGHT AMBIENT
#define WITHOUT_CAMERA IMAGE MAP LIGHT AMBIENT MESH
#define WITHOUT_LIGHT IMAGE MAP CAMERA AMBIENT MESH

static scene_file parsed(const char *text)
{
    scene_file scene;
    problem why = {""};
    if (!ok(scene_file_parse(&scene, "folder/s.scene", text, strlen(text), &why) == 0, "the_scene_is_taken"))
        note("%s", why.text);
    return scene;
}

static int is(const double v[3], double x, double y, double z)
{
    return v[0] == x && v[1] == y && v[2] == z;
}

static void a_perspective_scene(void)
{
    scene_file s = parsed("# a comment\n\n  image 640 480 # sizes\nmap 256 128\r\n"
                          "camera perspective far 99 near .5 up 0 1 0 target 1 2 3 fovy 40 eye 0 5 -9\n"
                          "light directional direction 0 -1 0.5\nambient 0.25\n"
                          "mesh a.obj color .1 .2 .3 surface closed\n"
                          "mesh sub/b.obj surface open color 1 1 1 translate 1 2 3 scale 2 rotate 0 0 1 90\n"
                          "mesh /abs/c.obj scale 1 -2 3 surface open color 0 0 0\n");
    ok(s.width == 640 && s.height == 480 && s.map_width == 256 && s.map_height == 128, "sizes_are_read");
    ok(!s.camera.orthographic && s.camera.fovy == 40 && s.camera.near_depth == 0.5 && s.camera.far_depth == 99 &&
           is(s.camera.eye, 0, 5, -9) && is(s.camera.target, 1, 2, 3) && is(s.camera.up, 0, 1, 0),
       "keys_may_come_in_any_order");
    ok(!s.light.spot && is(s.light.direction, 0, -1, 0.5) && !s.light.has_up && s.ambient == 0.25, "the_light_is_read");
    ok(s.mesh_count == 3 && s.meshes[0].closed && is(s.meshes[0].color, .1, .2, .3) && is(s.meshes[0].scale, 1, 1, 1) &&
           is(s.meshes[0].translate, 0, 0, 0) && s.meshes[0].degrees == 0 && s.meshes[0].line == 8,
       "a_mesh_has_defaults");
    ok(s.mesh_count == 3 && !s.meshes[1].closed && is(s.meshes[1].scale, 2, 2, 2) && is(s.meshes[1].axis, 0, 0, 1) &&
           s.meshes[1].degrees == 90 && is(s.meshes[1].translate, 1, 2, 3) && is(s.meshes[2].scale, 1, -2, 3),
       "scale_takes_one_number_or_three");
    ok(s.mesh_count == 3 && strcmp(s.meshes[0].path, "folder/a.obj") == 0 &&
           strcmp(s.meshes[1].path, "folder/sub/b.obj") == 0 && strcmp(s.meshes[2].path, "/abs/c.obj") == 0,
       "paths_are_relative_to_the_scene_file");
    scene_file_free(&s);
}

static void an_orthographic_scene_with_a_spot_light(void)
{
    scene_file s = parsed(IMAGE "map 64\ncamera orthographic eye 0 5 9 target 0 0 0 up 0 1 0 height 7 near -3 far 99\n"
                                "light spot position 0 9 0 target 0 0 0 up 1 0 0 fovy 60 near 2 far 20\n" AMBIENT MESH);
    ok(s.camera.orthographic && s.camera.height == 7 && s.camera.near_depth == -3, "an_orthographic_camera_is_read");
    ok(s.light.spot && s.light.has_up && is(s.light.up, 1, 0, 0) && is(s.light.position, 0, 9, 0) &&
           s.light.fovy == 60 && s.light.near_depth == 2 && s.light.far_depth == 20,
       "a_spot_light_is_read");
    ok(s.map_width == 64 && s.map_height == 64, "one_number_makes_a_square_map");
    scene_file_free(&s);
}

static const struct {
    const char *promise, *text, *where, *what;
} broken[] = {
    {"an_empty_file", "", ":1", "without 'image'"},
    {"an_unknown_directive", "imige 8 8\n", ":1", "unknown directive 'imige'"},
    {"a_scene_without_map", IMAGE CAMERA LIGHT AMBIENT MESH, ":6", "without 'map'"},
    {"a_scene_without_camera", WITHOUT_CAMERA, ":6", "without 'camera'"},
    {"a_scene_without_light", WITHOUT_LIGHT, ":6", "without 'light'"},
    {"a_scene_without_ambient", IMAGE MAP CAMERA LIGHT MESH, ":6", "without 'ambient'"},
    {"a_scene_without_mesh", BEFORE_MESH, ":6", "without 'mesh'"},
    {"a_second_image", IMAGE IMAGE, ":2", "a second 'image'"},
    {"a_second_map", MAP "\n" MAP, ":3", "the first is in line 1"},
    {"a_second_camera", CAMERA CAMERA, ":2", "a second 'camera'"},
    {"a_second_light", LIGHT LIGHT, ":2", "a second 'light'"},
    {"a_second_ambient", AMBIENT AMBIENT, ":2", "a second 'ambient'"},
    {"an_image_without_height", "image 8\n", ":1", "too few numbers"},
    {"an_image_of_three_numbers", "image 8 8 8\n", ":1", "'8' is too much"},
    {"an_image_of_no_width", "image 0 8\n", ":1", "out of range"},
    {"an_image_above_4096", "image 8 4097\n", ":1", "out of range"},
    {"a_fraction_of_a_pixel", "image 8.5 8\n", ":1", "not whole"},
    {"a_word_for_a_size", "image 8 eight\n", ":1", "'eight' is not a number"},
    {"a_map_of_negative_size", "map -8\n", ":1", "out of range"},
    {"a_map_of_three_numbers", "map 8 8 8\n", ":1", "too much"},
    {"a_map_without_size", "map\n", ":1", "too few numbers"},
    {"ambient_above_one", "ambient 1.01\n", ":1", "out of range"},
    {"negative_ambient", "ambient -0.1\n", ":1", "out of range"},
    {"infinite_ambient", "ambient inf\n", ":1", "'inf' is not a number"},
    {"a_camera_of_no_kind", "camera\n", ":1", "no kind of camera"},
    {"a_camera_of_unknown_kind", "camera fisheye eye 0 0 0\n", ":1", "'fisheye' is no kind of camera"},
    {"an_unknown_key", "camera perspective eye 0 0 0 target 0 0 -1 tilt 3\n", ":1", "unknown word 'tilt'"},
    {"a_key_given_twice", "camera perspective eye 0 0 0 eye 0 0 1\n", ":1", "'eye' is given twice"},
    {"a_camera_without_eye", "camera perspective target 0 0 0 up 0 1 0 fovy 40 near 1 far 9\n", ":1",
     "'eye' is missing"},
    {"a_camera_without_fovy", "camera perspective eye 0 0 9 target 0 0 0 up 0 1 0 near 1 far 9\n", ":1",
     "'fovy' is missing"},
    {"height_of_a_perspective_camera", "camera perspective eye 0 0 9 height 3\n", ":1", "unknown word 'height'"},
    {"fovy_of_an_orthographic_camera", "camera orthographic eye 0 0 9 fovy 30\n", ":1", "unknown word 'fovy'"},
    {"a_point_of_two_numbers", "camera perspective eye 0 0 target 0 0 0\n", ":1", "'target' is not a number"},
    {"fovy_of_180_degrees", "camera perspective fovy 180\n", ":1", "out of range"},
    {"fovy_of_zero", "camera perspective fovy 0\n", ":1", "out of range"},
    {"a_near_plane_of_zero", "camera perspective near 0\n", ":1", "out of range"},
    {"near_beyond_far", "camera perspective eye 0 0 9 target 0 0 0 up 0 1 0 fovy 40 near 9 far 1\n", ":1",
     "near 9 is not less"},
    {"eye_at_the_target", "camera perspective eye 1 2 3 target 1 2 3 up 0 1 0 fovy 40 near 1 far 9\n", ":1",
     "same point"},
    {"up_along_the_view", "camera perspective eye 0 9 0 target 0 0 0 up 0 1 0 fovy 40 near 1 far 9\n", ":1",
     "parallel"},
    {"up_of_zero", "camera perspective eye 0 9 0 target 0 0 0 up 0 0 0 fovy 40 near 1 far 9\n", ":1", "parallel"},
    {"a_coordinate_too_large", "camera perspective eye 0 0 1e10\n", ":1", "out of range"},
    {"a_height_of_zero", "camera orthographic height 0\n", ":1", "out of range"},
    {"a_light_of_no_kind", "light\n", ":1", "the kind of light is missing"},
    {"a_light_of_unknown_kind", "light area\n", ":1", "'area' is no kind of light"},
    {"a_light_without_direction", "light directional\n", ":1", "'direction' is missing"},
    {"a_direction_of_zero", "light directional direction 0 0 0\n", ":1", "zero"},
    {"a_light_whose_up_is_its_direction", "light directional direction 0 2 0 up 0 1 0\n", ":1", "parallel"},
    {"a_position_of_a_directional_light", "light directional position 0 0 0\n", ":1", "unknown word 'position'"},
    {"a_spot_light_without_far", "light spot position 0 9 0 target 0 0 0 fovy 60 near 2\n", ":1", "'far' is missing"},
    {"a_spot_light_at_its_target", "light spot position 0 9 0 target 0 9 0 fovy 60 near 2 far 9\n", ":1", "same point"},
    {"a_point_light_whose_near_is_too_near", WITHOUT_LIGHT "light point position 0 9 0 near 1e-9 far 9\n", ":6",
     "near"},
    {"a_broken_point_light", "light point position 0 9 0 near 1\n", ":1", "'far' is missing"},
    {"a_mesh_without_file", "mesh\n", ":1", "file is missing"},
    {"a_mesh_without_surface", "mesh in.obj color 1 1 1\n", ":1", "'surface' is missing"},
    {"a_mesh_without_color", "mesh in.obj surface open\n", ":1", "'color' is missing"},
    {"a_surface_of_another_word", "mesh in.obj surface shut color 1 1 1\n", ":1", "'shut' is not a value of 'surface'"},
    {"a_surface_of_no_word", "mesh in.obj color 1 1 1 surface\n", ":1", "missing after 'surface'"},
    {"a_color_above_one", "mesh in.obj surface open color 1 1 1.5\n", ":1", "out of range"},
    {"a_scale_of_zero", "mesh in.obj surface open color 1 1 1 scale 0\n", ":1", "'scale' is zero"},
    {"a_scale_of_two_numbers", "mesh in.obj surface open color 1 1 1 scale 1 2\n", ":1", "too few numbers"},
    {"a_rotation_without_axis", "mesh in.obj surface open color 1 1 1 rotate 0 0 0 90\n", ":1", "axis"},
    {"a_rotation_of_three_numbers", "mesh in.obj surface open color 1 1 1 rotate 0 1 0 translate 1 2 3\n", ":1",
     "'translate' is not a number"},
    {"a_mesh_that_is_missing", BEFORE_MESH "mesh in-none.obj surface open color 1 1 1\n", ":6", "cannot be opened"},
    {"an_open_mesh_called_closed", BEFORE_MESH "mesh in.obj surface closed color 1 1 1\n", ":6", "is not closed"},
    {"a_camera_too_far_from_a_small_scene",
     IMAGE MAP "camera perspective eye 0 500 0 target 0 0 0 up 0 0 1 fovy 40 near 1 far 999\n" LIGHT AMBIENT MESH, ":3",
     "too large for a scene"},
    {"planes_that_round_to_the_same",
     IMAGE MAP
     "camera perspective eye 0 5 9 target 0 0 0 up 0 1 0 fovy 40 near 1 far 1.00000000001\n" LIGHT AMBIENT MESH,
     ":3", "the same after rounding"},
};

static int render_it(void)
{
    const char *arguments[] = {sandbox_path("in.scene"), "-o", sandbox_path("out.ppm"), 0};
    return sandbox_run(command_render, arguments);
}

static void broken_files(void)
{
    sandbox_write_text("in.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    for (size_t i = 0; i < sizeof broken / sizeof *broken; i++) {
        sandbox_write_text("in.scene", broken[i].text);
        ok(sandbox_refused(render_it(), "in.scene", broken[i].where, broken[i].what),
           "%s_is_refused_with_file_and_line", broken[i].promise);
    }
    sandbox_write("in.scene", "image 8\0 8\n", 11);
    ok(sandbox_refused(render_it(), "in.scene", ": byte 7", "zero byte"), "a_zero_byte_is_refused_with_its_place");
    unlink(sandbox_path("in.scene"));
    ok(sandbox_refused(render_it(), "in.scene", "", "cannot be opened"), "a_scene_that_is_missing_is_refused");
    sandbox_write_text("in.scene", BEFORE_MESH MESH);
    if (!ok(render_it() == EXIT_DONE && sandbox_has("out.ppm"), "the_good_scene_beside_them_renders"))
        note("%s", sandbox_message);
}

int main(void)
{
    a_perspective_scene();
    an_orthographic_scene_with_a_spot_light();
    sandbox_open();
    broken_files();
    sandbox_close();
    return tap_done();
}
