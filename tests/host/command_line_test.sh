#!/bin/sh
# The simulator's command line: exit statuses, help, outputs, refusals; results that do not depend on how work is cut.
# GNOMON: the simulator; CC: a compiler for the packed header.
set -u
cd "$(dirname "$0")/../.." || exit 1
. tests/tap.sh

gnomon=${GNOMON:-build/gnomon}
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

nothing_left() {
    left=$(find "$folder" -name 'new*' -o -name '.[0-9]*')
    [ -z "$left" ] || { echo "left behind: $left"; return 1; }
}

hash_of() {
    "$gnomon" render "$@" --hash
}

# same_hashes A B: both are hashes of four stages, and equal.
same_hashes() {
    printf '%s\n' "$1" "$2"
    [ "$(printf '%s\n' "$1" | grep -cE '^(layers|map|mask|colour) [0-9a-f]{16}$')" = 4 ] && [ "$1" = "$2" ]
}

for command in render truth compare pack bench procedural; do
    check "help_of_${command}_names_its_use_and_status_2" sh -c "'$gnomon' $command --help | grep -q 'usage: gnomon $command' &&
        '$gnomon' $command --help | grep -q '2 bad usage'"
    check "${command}_without_arguments_is_bad_usage" status 2 $command
    check "${command}_refuses_an_unknown_option" refuses "unknown option '--wrong'" $command --wrong
done
check "help_lists_the_commands" sh -c "'$gnomon' --help | grep -q procedural"
check "no_command_is_bad_usage" status 2
check "an_unknown_command_is_bad_usage" refuses "unknown command 'rendre'" rendre
check "a_planned_command_is_named_as_such" refuses "not built yet" sweep

check "a_procedural_scene_is_written" status 0 procedural lshape -o "$folder/made"
check "an_unknown_procedural_scene_is_refused" refuses "unknown scene 'none'" procedural none -o "$folder"
check "a_folder_that_cannot_be_made_is_refused" refuses "cannot be made" procedural lshape -o "$folder/no/where"
check "procedural_without_folder_is_refused" refuses "no folder" procedural lshape

scene=$folder/made/lshape.scene
check "all_outputs_are_written" status 0 render "$scene" -o "$folder/a.ppm" --mask "$folder/a.pgm" --depth "$folder/z1.pgm" \
    --second-depth "$folder/z2.pfm" --map-image "$folder/map.pgm" --stats "$folder/a.json" --method mixed --map 64 --size 80x60
for file in a.ppm a.pgm z1.pgm z2.pfm map.pgm a.json; do
    check "${file}_is_there" test -s "$folder/$file"
done
check "the_picture_has_its_size" sh -c "head -c 9 '$folder/a.ppm' | tail -n 1 | grep -qx '80 60'"
check "statistics_name_what_was_chosen" sh -c "grep -q '\"virtual_surface\": \"mixed\"' '$folder/a.json' &&
    grep -q '\"layers\": \"two\"' '$folder/a.json' && grep -q '\"pixels_tested\": [1-9]' '$folder/a.json' &&
    grep -q 'largest_rounding_world_units' '$folder/a.json'"
check "a_mask_equals_itself" status 0 compare "$folder/a.pgm" "$folder/a.pgm"
check "bench_measures" status 0 bench "$scene" --runs 2 --size 40x30 --map 32 --json "$folder/bench.json"
check "bench_writes_json" grep -q '"median_ms"' "$folder/bench.json"
check "which_names_the_map" sh -c "grep -q '\"shadow\": \"map\"' '$folder/bench.json' && grep -q '\"map_width\": 32' '$folder/bench.json'"
check "bench_prints_the_map" sh -c "'$gnomon' bench '$scene' --runs 1 --size 40x30 --map 32 |
    grep -q 'shadow map 32 x 32, virtual surface second, layers'"
check "bench_of_volumes_names_them_and_no_map" sh -c "'$gnomon' bench '$scene' --runs 1 --size 40x30 --method volumes \
    --json '$folder/volumes.json' >'$folder/printed' && grep -q 'shadow volumes, region' '$folder/printed' &&
    grep -q '\"shadow\": \"volumes\"' '$folder/volumes.json' &&
    ! grep -qE 'map|virtual|layers|cull' '$folder/printed' '$folder/volumes.json'"

for method in constant midpoint dual second-depth mixed auto; do
    one=$(hash_of "$scene" --method $method --size 100x75 --map 60x44)
    check "${method}_does_not_depend_on_workers" same_hashes "$one" \
        "$(hash_of "$scene" --method $method --size 100x75 --map 60x44 --workers 3)"
    check "${method}_does_not_depend_on_regions" same_hashes "$one" \
        "$(hash_of "$scene" --method $method --size 100x75 --map 60x44 --region 32x7 --map-rows 5 --workers 2)"
done

check "a_scene_is_packed" status 0 pack "$scene" -o "$folder/lshape.gno"
check "a_packed_scene_has_the_same_hashes" same_hashes "$(hash_of "$scene")" "$(hash_of "$folder/lshape.gno")"
check "a_scene_is_packed_as_c" status 0 pack "$scene" -o "$folder/l-shape.h" --size 32x24 --map 32
cat >"$folder/use.c" <<'END'
#include "l-shape.h"
int main(void)
{
    gn_plan plan;
    return gn_make_plan(&plan, &l_shape_scene, &l_shape_settings) == GN_OK && l_shape_camera.far_depth > 0 &&
           l_shape_light.box_width > 0 && plan.triangles == 32 && l_shape_settings.width == 32 ? 0 : 1;
}
END
check "packed_c_compiles_without_a_warning" ${CC:-cc} -std=c99 -pedantic -Wall -Wextra -Werror -Icore -I"$folder" \
    "$folder/use.c" core/*.c -o "$folder/use"
check "packed_c_holds_the_scene" "$folder/use"

check "packed_c_has_no_edges_unless_asked_for" sh -c "! grep -q edge '$folder/l-shape.h'"

# Two closed meshes, and an open one: a sheet whose last triangle is turned round, and one triangle of no area.
cp "$scene" "$folder/made/edged.scene"
echo 'mesh sheet.obj surface open color 1 1 1' >>"$folder/made/edged.scene"
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nv 0 2 0\nf 1 2 3\nf 3 2 4\nf 4 3 5\nf 1 1 2\n' >"$folder/made/sheet.obj"
check "a_scene_is_packed_as_c_with_edges" status 0 pack "$folder/made/edged.scene" -o "$folder/edged.h" --edges
check "and_from_a_packed_scene" status 0 pack "$folder/made/edged.scene" -o "$folder/edged.gno" --edges
check "which_has_the_same_hashes" same_hashes "$(hash_of "$folder/made/edged.scene")" "$(hash_of "$folder/edged.gno")"
cat >"$folder/edges.c" <<'END'
#include "edged.h"
static int is(const gn_mesh_edge *edge, uint32_t first, uint32_t second)
{
    return edge->half[0] == first && edge->half[1] == second;
}
int main(void)
{
    const gn_mesh *m = edged_meshes;
    const gn_mesh_edge *e = m[2].edges;
    return 2 * m[0].edge_count == 3 * m[0].triangle_count && 2 * m[1].edge_count == 3 * m[1].triangle_count &&
           e == edged_edges_2 && m[2].edge_count == 7 && is(e, 0, GN_NO_HALF_EDGE) && is(e + 1, 1, 3) &&
           is(e + 4, 5, GN_SAME_DIRECTION | 6) && !edged_settings.shadow ? 0 : 1;
}
END
check "packed_edges_compile_without_a_warning" ${CC:-cc} -std=c99 -pedantic -Wall -Wextra -Wconversion -Werror -Icore \
    -I"$folder" "$folder/edges.c" -o "$folder/edges"
check "packed_edges_are_those_of_the_meshes" "$folder/edges"
printf 'v 0 0 0\nv 1 0 0\nf 1 1 2\n' >"$folder/made/sheet.obj"
check "a_mesh_of_no_area_is_packed_with_edges" status 0 pack "$folder/made/edged.scene" -o "$folder/none.h" --edges
echo '#include "none.h"
int main(void) { return !(none_meshes[2].edges && none_meshes[2].edge_count == 0 && none_scene.ambient && none_light.forward[1] &&
    none_camera.far_depth && none_settings.width); }' >"$folder/none.c"
check "and_has_none_that_count" sh -c "${CC:-cc} -std=c99 -pedantic -Wall -Wextra -Werror -Icore -I'$folder' '$folder/none.c' \
    -o '$folder/none' && '$folder/none'"
check "edges_worth_a_notice_are_noticed" sh -c "'$gnomon' pack '$folder/made/edged.scene' -o '$folder/none.gno' --edges \
    --verbose 2>&1 | grep -qx 'gnomon: notice: mesh 2 has 1 triangles with two corners at one place'"

# Shadow volumes read no setting of a map: none of a former method is left.
check "a_scene_is_packed_with_volumes" status 0 pack "$scene" --method volumes -o "$folder/volumes.gno"
check "and_by_way_of_a_packed_scene_without_a_method" status 0 pack "$folder/lshape.gno" --method volumes -o "$folder/again.gno"
check "to_the_same_bytes" cmp "$folder/volumes.gno" "$folder/again.gno"
check "a_packed_scene_of_a_method_is_packed" status 0 pack "$scene" --method dual --bias 3t --layers two -o "$folder/dual.gno"
check "and_once_more_with_volumes" status 0 pack "$folder/dual.gno" --method volumes -o "$folder/again.gno"
check "to_the_same_bytes_too" cmp "$folder/volumes.gno" "$folder/again.gno"
check "volumes_of_a_packed_scene_are_not_left_for_a_surface" refuses "--virtual-surface has no meaning for shadow volumes" \
    render "$folder/volumes.gno" --virtual-surface dual -o "$folder/new.ppm"
check "but_for_a_method" same_hashes "$(hash_of "$folder/volumes.gno" --method dual)" "$(hash_of "$scene" --method dual)"

mkdir "$folder/folder.ppm"
check "two_scenes_are_refused" refuses "2 scenes" render "$scene" "$scene" -o "$folder/new.ppm"
check "nothing_to_write_is_refused" refuses "nothing to write" render "$scene"
check "an_option_without_its_value_is_refused" refuses "lacks its value" render "$scene" -o
check "an_option_given_twice_is_refused" refuses "given twice" render "$scene" --map 8 --map=9 -o "$folder/new.ppm"
check "an_unknown_method_is_refused" refuses "--method best" render "$scene" --method best -o "$folder/new.ppm"
for method in slope adaptive silhouette; do
    check "method_${method}_is_not_built_yet" refuses "not built yet" render "$scene" --method $method -o "$folder/new.ppm"
done
check "slope_surface_is_not_built_yet" refuses "not built yet" render "$scene" --virtual-surface slope -o "$folder/new.ppm"
check "virtual_receivers_are_not_built_yet" refuses "not built yet" render "$scene" --receiver virtual -o "$folder/new.ppm"
check "pcf_is_not_built_yet" refuses "not built yet" render "$scene" --reconstruct pcf3 -o "$folder/new.ppm"
check "msf_is_not_built_yet" refuses "not built yet" render "$scene" --parameterise msf+rectilinear -o "$folder/new.ppm"
check "an_unknown_receiver_is_refused" refuses "expected point" render "$scene" --receiver x -o "$folder/new.ppm"
check "surface_against_method_is_refused" refuses "contradicts" render "$scene" --method dual --virtual-surface second \
    -o "$folder/new.ppm"
check "a_bias_of_second_depth_is_refused" refuses "has no meaning" render "$scene" --method second-depth --bias 1t \
    -o "$folder/new.ppm"
check "a_negative_bias_is_refused" refuses "bias '-1t'" render "$scene" --method dual --bias -1t -o "$folder/new.ppm"
check "constant_with_two_layers_is_refused" refuses "makes no sense" render "$scene" --method constant --layers two \
    -o "$folder/new.ppm"
check "dual_with_one_layer_is_refused" refuses "makes no sense" render "$scene" --method dual --layers first -o "$folder/new.ppm"
check "midpoint_without_front_faces_is_refused" refuses "makes no sense" render "$scene" --method midpoint --cull front \
    -o "$folder/new.ppm"
check "mixed_without_back_faces_is_refused" refuses "makes no sense" render "$scene" --method mixed --cull back \
    -o "$folder/new.ppm"
check "a_second_layer_that_is_not_kept_is_refused" refuses "keeps one layer" render "$scene" --method constant \
    --second-depth "$folder/new.pgm"
check "a_map_of_4097_is_refused" refuses "--map 4097" render "$scene" --map 4097 -o "$folder/new.ppm"
check "a_size_of_one_number_is_refused" refuses "--size 8" render "$scene" --size 8 -o "$folder/new.ppm"
check "no_workers_are_refused" refuses "--workers 0" render "$scene" --workers 0 -o "$folder/new.ppm"
check "65_workers_are_refused" refuses "--workers 65" render "$scene" --workers 65 -o "$folder/new.ppm"
check "an_unknown_extension_is_refused" refuses "expected .ppm" render "$scene" -o "$folder/new.nonsense"
check "a_grey_picture_is_refused" refuses "expected .ppm" render "$scene" -o "$folder/new.pgm"
check "a_missing_folder_is_refused" refuses "cannot be written" render "$scene" -o "$folder/none/new.ppm"
check "a_scene_that_is_missing_is_refused" refuses "cannot be opened" render "$folder/none.scene" -o "$folder/new.ppm"
check "a_folder_as_a_scene_is_refused" refuses "is a folder" render "$folder" -o "$folder/new.ppm"
check "a_folder_as_output_is_refused" refuses "is a folder" render "$scene" -o "$folder/folder.ppm"
check "pack_to_another_extension_is_refused" refuses "expected .gno or .h" pack "$scene" -o "$folder/new.bin"
check "zero_runs_are_refused" refuses "--runs 0" bench "$scene" --runs 0

if "$gnomon" render "$scene" -o "$folder/png.png" 2>"$folder/err"; then
    check "png_is_written_where_openimageio_is_present" test -s "$folder/png.png"
else
    check "png_without_openimageio_says_what_to_install" grep -q "install libopenimageio-dev and rebuild" "$folder/err"
fi

echo old >"$folder/kept.ppm"
cat >"$folder/broken.scene" <<'END'
image 8 8
mapp 8
END
check "a_broken_scene_is_refused_with_its_line" refuses "broken.scene:2: unknown directive 'mapp'" render "$folder/broken.scene" \
    -o "$folder/kept.ppm"
check "an_older_picture_is_kept" grep -qx old "$folder/kept.ppm"
check "output_to_a_device_is_written_directly" sh -c "'$gnomon' render '$scene' --size 8x6 --stats /dev/stdout |
    grep -q '\"width\": 8'"
check "one_file_for_two_outputs_is_refused" refuses "two outputs at once" render "$scene" -o "$folder/new.ppm" \
    --stats "$folder/new.ppm"
check "a_scene_is_not_overwritten" refuses "would be overwritten" render "$scene" --stats "$scene"
check "nor_by_bench" refuses "would be overwritten" bench "$scene" --runs 1 --json "$scene"
check "the_scene_is_as_it_was" grep -q camera "$scene"
check "one_bad_output_stops_the_others" refuses "cannot be written" render "$scene" -o "$folder/new.ppm" \
    --mask "$folder/none/new.pgm"
finish
