#!/bin/sh
# The simulator's command line: exit statuses, help, outputs, refusals; results that do not depend on how work is cut.
# GNOMON: the simulator; CC: a compiler for the packed header.
set -u
. "$(dirname "$0")/../simulator.sh"

hash_of() {
    "$gnomon" render "$@" --hash
}

# same_hashes A B: both are hashes of four stages (of five with silhouettes), and equal.
same_hashes() {
    printf '%s\n' "$1" "$2"
    [ "$(printf '%s\n' "$1" | grep -cE '^(layers|map|mask|colour) [0-9a-f]{16}$')" = 4 ] && [ "$1" = "$2" ]
}

# What the statistics say of the settings: surface, layers, cull, bias and its unit, slope, receiver, reconstruction.
settings_of() {
    "$gnomon" render "$@" --size 8x6 --stats /dev/stdout | awk '
        function shown(name) { return name in value ? value[name] : "-" }
        { gsub(/[",:]/, " "); value[$1] = $2 }
        END {
            bias = "bias" in value ? sprintf("%.5g %s", value["bias"], value["bias_unit"]) : "-"
            print shown("virtual_surface"), shown("layers"), shown("cull"), bias, shown("slope"), shown("receiver"), \
                shown("reconstruction")
        }'
}

# chosen SETTINGS ARGUMENT...: these are the settings.
chosen() {
    expected=$1
    shift
    got=$(settings_of "$@")
    [ "$got" = "$expected" ] || { echo "got: $got, expected: $expected"; return 1; }
}

# count_of NAME FILE: of the statistics.
count_of() {
    awk -v name="$1" '{ gsub(/[",:]/, " ") } $1 == name { print $2 }' "$2"
}

for command in render truth compare pack bench procedural sweep; do
    check "help_of_${command}_names_its_use_and_status_2" sh -c "'$gnomon' $command --help | grep -q 'usage: gnomon $command' &&
        '$gnomon' $command --help | grep -q '2 bad usage'"
    check "${command}_without_arguments_is_bad_usage" status 2 $command
    check "${command}_refuses_an_unknown_option" refuses "unknown option '--wrong'" $command --wrong
done
check "help_lists_the_commands" sh -c "'$gnomon' --help | grep -q procedural"
check "no_command_is_bad_usage" status 2
check "an_unknown_command_is_bad_usage" refuses "unknown command 'rendre'" rendre

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
    ! grep -qE 'map|virtual|layers|cull|bias|receiver|reconstruction' '$folder/printed' '$folder/volumes.json'"

while read -r options; do
    # shellcheck disable=SC2086 # the options are words
    set -- "$scene" --method $options --size 100x75 --map 60x44
    name=$(echo "$options" | tr ' ' '_')
    one=$(hash_of "$@")
    check "${name}_does_not_depend_on_workers" same_hashes "$one" "$(hash_of "$@" --workers 3)"
    check "${name}_does_not_depend_on_regions" same_hashes "$one" \
        "$(hash_of "$@" --region 32x7 --map-rows 5 --workers 2)"
done <<'END'
constant
midpoint
dual
second-depth
mixed
auto
slope
adaptive
constant --receiver plane-bias --reconstruct jitter4x4
second-depth --receiver virtual --reconstruct bilinear
mixed --receiver virtual-always --reconstruct pcf5
dual --receiver point --reconstruct pcf3
mixed --receiver virtual --reconstruct pcf7
silhouette
silhouette --receiver point
constant --receiver virtual-always --reconstruct silhouette
midpoint --reconstruct silhouette-smooth
mixed --receiver virtual --reconstruct crossing
second-depth --reconstruct crossing
auto --parameterise dv
mixed --receiver virtual --parameterise msf --fit-depth
constant --receiver plane-bias --reconstruct pcf3 --parameterise rectilinear-distance
silhouette --parameterise msf+rectilinear --smoothing 4
silhouette --reconstruct crossing --parameterise dv+rectilinear
mixed --receiver virtual --parameterise dv+nonorthogonal
dual --parameterise dv+rectilinear-vertices
constant --parameterise nonorthogonal-vertices
END

# Methods are presets; what is named beside them wins.
sheet=$folder/made/sheet.scene
sed '/^mesh/,$d' "$scene" >"$sheet"
echo 'mesh open.obj surface open color 1 1 1' >>"$sheet"
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n' >"$folder/made/open.obj"
check "auto_of_closed_meshes_is_second_depth_with_virtual_samples" chosen "second first front 0 world - virtual nearest" "$scene"
check "auto_of_a_sheet_is_mixed_with_virtual_samples" chosen "mixed two none 2 texels - virtual nearest" "$sheet"
while IFS='|' read -r options expected; do
    # shellcheck disable=SC2086 # the options are words
    check "$(echo "$options chooses $expected" | tr -s ' ' '_')" chosen "$expected" "$scene" $options
done <<'END'
--method constant|constant first none 2 texels - point nearest
--method midpoint|midpoint two none - - point nearest
--method dual|dual two back 2 texels - point nearest
--method second-depth|second first front 0 world - point nearest
--method mixed|mixed two none 2 texels - point nearest
--method slope|slope first none 0.0005 range 2 point nearest
--method adaptive|constant first none 0.0001 range - virtual nearest
--method silhouette|mixed two none 2 texels - virtual silhouette
--method auto|second first front 0 world - virtual nearest
--method adaptive --virtual-surface constant|constant first none 0.0001 range - virtual nearest
--method adaptive --receiver point --bias 1t|constant first none 1 texels - point nearest
--method dual --bias 0.25|dual two back 0.25 world - point nearest
--method second-depth --bias 0.01r|second first front 0.01 range - point nearest
--method slope --slope 0.5|slope first none 0.0005 range 0.5 point nearest
--method slope --receiver plane-bias|slope first none 0.0005 range 2 plane-bias nearest
--method slope --receiver plane-bias --slope 64|slope first none 0.0005 range 64 plane-bias nearest
--method constant --receiver plane-bias|constant first none 2 texels 1 plane-bias nearest
--method dual --receiver virtual-always --reconstruct jitter4x4|dual two back 2 texels - virtual-always jitter4x4
--receiver plane-bias|second first front 0 world 1 plane-bias nearest
--receiver plane-bias --slope 0|second first front 0 world 0 plane-bias nearest
--receiver point|second first front 0 world - point nearest
--reconstruct bilinear|second first front 0 world - virtual bilinear
--reconstruct pcf3|second first front 0 world - virtual pcf3
--reconstruct pcf5 --receiver point|second first front 0 world - point pcf5
--reconstruct pcf7 --virtual-surface mixed|mixed two none 2 texels - point pcf7
--reconstruct silhouette|second first front 0 world - virtual silhouette
--method dual --reconstruct silhouette|dual two back 2 texels - point silhouette
--method silhouette --virtual-surface mixed --bias 1t|mixed two none 1 texels - virtual silhouette
--method silhouette --receiver plane-bias --slope 2|mixed two none 2 texels 2 plane-bias silhouette
--method silhouette --reconstruct nearest|mixed two none 2 texels - virtual nearest
--method silhouette --reconstruct silhouette-smooth|mixed two none 2 texels - virtual silhouette-smooth
--virtual-surface slope|slope first none 0.0005 range 2 point nearest
--virtual-surface constant --bias 0.02r --layers first --cull none|constant first none 0.02 range - point nearest
--virtual-surface constant --bias 3t --layers first --cull none|constant first none 3 texels - point nearest
--virtual-surface slope --slope 2 --bias 0.0005r --layers first --cull none|slope first none 0.0005 range 2 point nearest
--virtual-surface constant --receiver plane-bias --slope 1 --bias 0.0005r --layers first --cull none|constant first none 0.0005 range 1 plane-bias nearest
--virtual-surface midpoint --layers two --cull none|midpoint two none - - point nearest
--virtual-surface midpoint --layers two --cull back|midpoint two back - - point nearest
--virtual-surface dual --bias 0.02r --layers two --cull none|dual two none 0.02 range - point nearest
--virtual-surface dual --bias 0.02r --layers two --cull back|dual two back 0.02 range - point nearest
--virtual-surface dual --bias 2t --layers two --cull back --receiver virtual|dual two back 2 texels - virtual nearest
--virtual-surface second --layers two --cull none|second two none 0 world - point nearest
--virtual-surface second --layers two --cull none --receiver virtual|second two none 0 world - virtual nearest
--virtual-surface second --layers first --cull front --receiver virtual|second first front 0 world - virtual nearest
--virtual-surface mixed --bias 2t --layers two --cull none --receiver virtual|mixed two none 2 texels - virtual nearest
--virtual-surface constant --bias 0.0001r --layers first --cull none --receiver virtual|constant first none 0.0001 range - virtual nearest
--parameterise uniform --reconstruct nearest --receiver point|second first front 0 world - point nearest
END

# What a map is fitted and warped with, as it is packed (host/pack.h): fit, warp, fitted depth, smoothing in 16.16 bits.
# parameterised BYTES ARGUMENT...
parameterised() {
    expected=$1
    shift
    "$gnomon" pack "$@" -o "$folder/parameterised.gno" >/dev/null || return 1
    got=$(od -An -v -tu1 -j49 -N7 "$folder/parameterised.gno" | tr -s ' ' | sed 's/^ //')
    [ "$got" = "$expected" ] || { echo "got: $got, expected: $expected"; return 1; }
}
while IFS='|' read -r options expected; do
    # shellcheck disable=SC2086 # the options are words
    check "$(echo "parameterise $options" | tr ' ' '_')" parameterised "$expected" "$scene" --parameterise $options
done <<'END'
uniform|0 0 0 0 0 0 0
dv|1 0 0 0 0 0 0
msf|2 0 0 0 0 0 0
rectilinear|0 1 0 0 0 0 0
rectilinear-distance|0 2 0 0 0 0 0
nonorthogonal|0 3 0 0 0 0 0
rectilinear-vertices|0 4 0 0 0 0 0
nonorthogonal-vertices|0 5 0 0 0 0 0
dv+rectilinear|1 1 0 0 0 0 0
rectilinear+dv|1 1 0 0 0 0 0
msf+rectilinear-distance|2 2 0 0 0 0 0
rectilinear-vertices+msf|2 4 0 0 0 0 0
dv+nonorthogonal --smoothing 4|1 3 0 0 0 4 0
nonorthogonal --smoothing 0.015625|0 3 0 0 4 0 0
rectilinear --smoothing 64|0 1 0 0 0 64 0
dv --fit-depth|1 0 1 0 0 0 0
msf+rectilinear --fit-depth --smoothing 1.5|2 1 1 0 128 1 0
END
check "a_parameterisation_is_kept" parameterised "2 1 1 0 128 1 0" "$folder/parameterised.gno"
check "also_with_another_receiver" parameterised "2 1 1 0 128 1 0" "$folder/parameterised.gno" --receiver point
check "its_depth_and_its_smoothing_go_with_it" parameterised "1 1 0 0 0 0 0" "$folder/parameterised.gno" --parameterise dv+rectilinear
check "a_method_forgets_it" parameterised "0 0 0 0 0 0 0" "$folder/parameterised.gno" --method mixed

# What a packed scene has stays until something else is named.
check "a_slope_is_packed" status 0 pack "$scene" -o "$folder/slope.gno" --method slope --slope 3
check "and_comes_back" chosen "slope first none 0.0005 range 3 point nearest" "$folder/slope.gno"
check "it_serves_a_receiver_too" chosen "slope first none 0.0005 range 3 plane-bias pcf3" "$folder/slope.gno" \
    --receiver plane-bias --reconstruct pcf3
check "another_method_forgets_it" chosen "constant first none 2 texels 1 plane-bias nearest" "$folder/slope.gno" \
    --method constant --receiver plane-bias
check "a_receiver_is_packed" status 0 pack "$scene" -o "$folder/receiver.gno" --receiver plane-bias --slope 5 \
    --reconstruct pcf5
check "and_comes_back_too" chosen "second first front 0 world 5 plane-bias pcf5" "$folder/receiver.gno"
check "its_slope_goes_with_it" chosen "second first front 0 world - virtual pcf5" "$folder/receiver.gno" --receiver virtual
check "and_leaves_nothing_behind" sh -c "'$gnomon' pack '$folder/receiver.gno' -o '$folder/again.gno' --receiver virtual &&
    '$gnomon' pack '$scene' -o '$folder/virtual.gno' --receiver virtual --reconstruct pcf5 &&
    cmp '$folder/again.gno' '$folder/virtual.gno'"
check "a_method_forgets_receiver_and_reconstruction" chosen "mixed two none 2 texels - point nearest" "$folder/receiver.gno" \
    --method mixed
check "a_point_is_packed_where_it_is_named" status 0 pack "$scene" -o "$folder/point.gno" --receiver point
check "and_stays_a_point" chosen "second first front 0 world - point nearest" "$folder/point.gno"

# Fractions of light, and how far pixels came.
# mask_values ARGUMENT...: the values of a mask, in order, but for lit and no surface.
mask_values() {
    "$gnomon" render "$@" --size 100x75 --map 32 --mask "$folder/values.pgm" --stats "$folder/values.json" &&
        tail -c 7500 "$folder/values.pgm" | od -An -v -tu1 -w1 | awk '$1 != 254 && $1 != 255 { print $1 + 0 }' | sort -nu |
        tr '\n' ' '
}
check "a_nearest_texel_gives_no_fraction" test "$(mask_values "$scene" --method mixed)" = "0 "
ninths="0 28 56 85 113 141 169 198 226 " # floor((254 k + 4) / 9)
check "pcf3_gives_ninths" test "$(mask_values "$scene" --method mixed --reconstruct pcf3)" = "$ninths"
check "they_are_counted" test "$(count_of pixels_fractional "$folder/values.json")" -gt 0
check "no_virtual_sample_is_taken_of_a_point" test "$(count_of virtual_samples "$folder/values.json")" = 0
mask_values "$scene" --method mixed --receiver virtual --reconstruct pcf3 >"$folder/printed"
check "virtual_samples_are_counted" test "$(count_of virtual_samples "$folder/values.json")" -gt 0
check "every_pixel_tested_is_in_one_stage" test "$(count_of pixels_tested "$folder/values.json")" = \
    $(($(count_of pixels_outside "$folder/values.json") + $(count_of pixels_agreed "$folder/values.json") + \
        $(count_of pixels_virtual "$folder/values.json")))
check "smooth_silhouettes_give_quarters" test "$(mask_values "$scene" --method silhouette --reconstruct silhouette-smooth)" = \
    "0 64 127 191 " # floor((254 k + 2) / 4)
check "a_nearest_texel_of_a_point_has_no_stages" sh -c "'$gnomon' render '$scene' --method mixed --size 8x6 \
    --stats '$folder/a.json' && grep -q pixels_tested '$folder/a.json' && ! grep -q pixels_agreed '$folder/a.json'"
"$gnomon" render "$scene" --size 100x75 --map 32 --stats "$folder/values.json" --method slope --receiver virtual \
    --reconstruct pcf5 --verbose 2>"$folder/said"
check "verbose_names_the_settings" grep -q "^virtual surface slope, layers first, cull none, bias 0.0005r, slope 2, receiver \
virtual, reconstruction pcf5; " "$folder/said"
check "and_the_counts_of_the_stages" grep -qx "$(count_of pixels_tested "$folder/values.json") pixels tested: \
$(count_of pixels_outside "$folder/values.json") outside of the light, \
$(count_of pixels_agreed "$folder/values.json") decided by the point's depth, \
$(count_of pixels_virtual "$folder/values.json") by virtual samples; \
$(count_of pixels_fractional "$folder/values.json") partly lit; \
$(count_of texels_read "$folder/values.json") texels read, \
$(count_of virtual_samples "$folder/values.json") virtual samples" "$folder/said"
check "bench_names_receiver_and_reconstruction" sh -c "'$gnomon' bench '$scene' --runs 1 --size 40x30 --map 32 \
    --method adaptive --reconstruct bilinear --json '$folder/bench.json' >'$folder/printed' &&
    grep -q 'bias 0.0001r, receiver virtual, reconstruction bilinear, region' '$folder/printed' &&
    grep -q '\"receiver\": \"virtual\"' '$folder/bench.json' && grep -q '\"reconstruction\": \"bilinear\"' '$folder/bench.json'"

# Silhouette maps. Each figure of the statistics that is made of others is worked out again.
# agrees NAME FORMULA FILE: the statistic is what awk makes of the formula, in which v["name"] is another statistic.
agrees() {
    awk -v name="$1" '{ gsub(/[",:]/, " ") } NF >= 2 { v[$1] = $2 } END {
        got = v[name]
        wanted = '"$2"'
        if (got == "" || got - wanted > 1e-6 || wanted - got > 1e-6) { print name, got, "expected", wanted; exit 1 }
    }' "$3"
}
check "a_silhouette_map_is_drawn" status 0 render "$scene" --method silhouette --size 100x75 --map 128x96 \
    --silhouettes "$folder/sil.ppm" --stats "$folder/sil.json" --mask "$folder/sil.pgm"
check "with_16_pixels_a_texel" sh -c "head -n 2 '$folder/sil.ppm' | tail -n 1 | grep -qx '2048 1536'"
tail -c $((3 * 2048 * 1536)) "$folder/sil.ppm" | od -An -v -tu1 -w3 | sort | uniq -c >"$folder/colours"
check "in_grey_red_and_orange" awk '{ grey = $2 == $3 && $3 == $4; red = $2 == 255 && $3 == 0; orange = $2 == 255 && $3 == 128 && $4 == 0
    if (grey) greys++; else if (red || orange) { if (red) reds = $1; else oranges = $1 } else exit 1 }
    END { exit !(greys > 9 && reds > 900 && oranges > 900) }' "$folder/colours"
check "a_point_is_no_more_than_nine_red_pixels" test "$(awk '$2 == 255 && $3 == 0 { print $1 }' "$folder/colours")" -le \
    $((9 * $(count_of silhouette_texels "$folder/sil.json")))
check "pixels_are_lit_and_shadowed" sh -c "for value in 0 254; do
    [ \$(tail -c 7500 '$folder/sil.pgm' | od -An -v -tu1 -w1 | grep -cx ' *'\$value) -gt 500 ] || exit 1; done"
"$gnomon" render "$scene" --size 100x75 --method volumes --stats "$folder/volumes.json"
check "silhouette_edges_are_those_of_volumes" test "$(count_of silhouette_edges "$folder/sil.json")" -gt 9 -a \
    "$(count_of silhouette_edges "$folder/sil.json")" = "$(count_of silhouette_edges "$folder/volumes.json")"
check "texels_with_silhouettes_are_counted" test "$(count_of silhouette_texels "$folder/sil.json")" -gt 100
check "some_pixels_are_decided_by_them" test "$(count_of pixels_silhouette "$folder/sil.json")" -gt 50
check "and_no_more_than_come_that_far" test "$(count_of pixels_silhouette "$folder/sil.json")" -le \
    "$(count_of pixels_virtual "$folder/sil.json")"
check "in_per_cent_of_those_shaded" agrees silhouette_percent '100 * v["pixels_silhouette"] / v["pixels_shaded"]' "$folder/sil.json"
# Sen et al. 2003, section 4: a depth of 4 bytes, near silhouettes 3 points of 8 bytes; ours: 3 of 1 byte.
check "a_shadow_map_takes_4_bytes_a_pixel" agrees shadow_map_bytes_a_pixel 4 "$folder/sil.json"
check "silhouettes_take_24_p_more" agrees silhouette_map_bytes_a_pixel '4 + 24 * v["silhouette_percent"] / 100' "$folder/sil.json"
check "which_is_a_ratio" agrees ratio '1 + 6 * v["silhouette_percent"] / 100' "$folder/sil.json"
check "our_depths_have_their_size" agrees own_shadow_map_bytes_a_pixel 'v["depth_bits"] / 8' "$folder/sil.json"
check "our_points_have_a_byte" agrees own_silhouette_map_bytes_a_pixel \
    'v["depth_bits"] / 8 + 3 * v["silhouette_percent"] / 100' "$folder/sil.json"
check "which_is_another_ratio" agrees own_ratio '1 + 24 / v["depth_bits"] * v["silhouette_percent"] / 100' "$folder/sil.json"
check "volumes_take_5_and_a_half_bytes_a_fragment" agrees shadow_volumes_bytes_a_pixel '5.5 * v["overdraw"]' "$folder/volumes.json"
check "and_have_their_ratio" agrees ratio '5.5 / 4 * v["overdraw"]' "$folder/volumes.json"
check "the_silhouette_map_takes_a_byte_a_texel" agrees silhouettes '128 * 96' "$folder/sil.json"
check "without_silhouettes_nothing_is_said_of_them" sh -c "'$gnomon' render '$scene' --method mixed --receiver virtual --size 8x6 \
    --stats '$folder/a.json' --hash >'$folder/printed' && ! grep -qE 'silhouette|bandwidth' '$folder/a.json' '$folder/printed'"
hash_of "$scene" --method silhouette --stats "$folder/sil.json" --map 40 --size 8x6 --verbose >"$folder/printed" 2>"$folder/said"
check "silhouettes_have_a_hash" sh -c "[ \$(grep -cE '^silhouettes [0-9a-f]{16}$' '$folder/printed') = 1 ] &&
    grep -q \$(sed -n 's/^silhouettes //p' '$folder/printed') '$folder/sil.json'"
check "which_another_scene_changes" test "$(sed -n 's/^silhouettes //p' "$folder/printed")" != \
    "$(hash_of "$sheet" --method silhouette --map 40 --size 8x6 | sed -n 's/^silhouettes //p')"
check "verbose_names_their_memory" grep -q "reconstruction silhouette; [0-9]* bytes, of them [0-9]* for the map, \
$(count_of silhouettes "$folder/sil.json") for its silhouettes$" "$folder/said"
check "and_their_counts" grep -q "^$(count_of silhouette_edges "$folder/sil.json") silhouette edges, \
$(count_of silhouette_texels "$folder/sil.json") texels with a point or crossing of one; \
$(count_of pixels_silhouette "$folder/sil.json") pixels decided by them, [0-9.]* % of those shaded$" "$folder/said"
check "bench_takes_silhouettes" sh -c "'$gnomon' bench '$scene' --runs 1 --size 40x30 --map 32 --method silhouette \
    --json '$folder/bench.json' | grep -q 'receiver virtual, reconstruction silhouette, region' &&
    grep -q '\"reconstruction\": \"silhouette\"' '$folder/bench.json'"
hash_of "$scene" --method silhouette --reconstruct crossing --stats "$folder/cross.json" --map 40 --size 8x6 >"$folder/crossed"
check "crossings_have_a_hash" sh -c "[ \$(grep -cE '^silhouettes [0-9a-f]{16}$' '$folder/crossed') = 1 ] &&
    grep -q \$(sed -n 's/^silhouettes //p' '$folder/crossed') '$folder/cross.json'"
check "which_is_not_that_of_silhouettes" test "$(sed -n 's/^silhouettes //p' "$folder/crossed")" != \
    "$(sed -n 's/^silhouettes //p' "$folder/printed")"
"$gnomon" render "$scene" --method silhouette --reconstruct crossing --stats "$folder/cross.json" --map 40 --size 8x6
check "their_map_takes_a_byte_a_texel" agrees silhouettes '40 * 40' "$folder/cross.json"
check "of_the_same_edges" test "$(count_of silhouette_edges "$folder/cross.json")" = "$(count_of silhouette_edges "$folder/sil.json")"
check "texels_with_crossings_are_counted" test "$(count_of silhouette_texels "$folder/cross.json")" -gt 30
check "a_scene_is_packed_with_silhouettes" status 0 pack "$scene" -o "$folder/sil.gno" --method silhouette
check "which_has_the_hashes_of_the_method" same_hashes "$(hash_of "$scene" --method silhouette)" "$(hash_of "$folder/sil.gno")"
check "its_edges_serve_volumes" same_hashes "$(hash_of "$scene" --method volumes)" "$(hash_of "$folder/sil.gno" --method volumes)"

# Fits and warps: what the statistics and the picture say of them.
warped="--method silhouette --parameterise msf+rectilinear --size 100x75 --map 64x48"
# shellcheck disable=SC2086 # the options are words
check "a_grid_is_drawn" status 0 render "$scene" $warped --grid "$folder/grid.ppm" --stats "$folder/grid.json" --mask "$folder/grid.pgm"
check "of_the_light's_square_box" sh -c "head -n 2 '$folder/grid.ppm' | tail -n 1 | grep -qx '1024 1024'"
tail -c $((3 * 1024 * 1024)) "$folder/grid.ppm" | od -An -v -tu1 -w3 | sort | uniq -c >"$folder/colours"
check "in_grey_orange_blue_and_red" awk '{ grey = $2 == $3 && $3 == $4
    if (grey) greys++; else if ($2 == 255 && $3 == 128 && $4 == 0) columns = $1; else if ($2 == 0 && $3 == 128 && $4 == 255) rows = $1
    else if ($2 == 255 && $3 == 0 && $4 == 0) frame = $1; else exit 1 }
    END { exit !(greys > 9 && columns > 5000 && rows > 5000 && frame > 500) }' "$folder/colours"
check "its_pixels_are_lit_and_shadowed" sh -c "for value in 0 254; do
    [ \$(tail -c 7500 '$folder/grid.pgm' | od -An -v -tu1 -w1 | grep -cx ' *'\$value) -gt 500 ] || exit 1; done"
check "statistics_name_fit_and_warp" sh -c "grep -q '\"parameterisation\": \"msf+rectilinear\"' '$folder/grid.json' &&
    grep -q '\"smoothing\": 1' '$folder/grid.json' && grep -q '\"fit_depth\": 0' '$folder/grid.json'"
check "the_view_pass_sees_all_pixels_of_a_light_about_the_scene" agrees view_samples 'v["pixels_shaded"]' "$folder/grid.json"
check "tables_take_2_bytes_a_column_and_row" agrees warp '2 * (64 + 48)' "$folder/grid.json"
check "the_view_pass_takes_memory" test "$(count_of view_pass "$folder/grid.json" | head -n 1)" -gt 1000
check "the_map_covers_a_part_of_the_plane" agrees covered_percent \
    '(got > 1 && got < 99 ? got : -1)' "$folder/grid.json"
# least_and_largest NAME FILE: of a magnification
least_and_largest() {
    awk -v name="$1" '{ gsub(/[",:{]/, " ") } $1 == name { found = 3 } found-- > 0 && NF == 2 { printf "%.3f ", $2 }' "$2"
}
for axis in column row; do
    check "${axis}s_are_magnified_and_reduced" sh -c "set -- $(least_and_largest ${axis}_magnification "$folder/grid.json")
        echo \"\$1 \$2\" | awk '{ exit !(\$1 > 0 && \$1 < 0.95 && \$2 > 1.05) }'"
done
"$gnomon" render "$scene" --parameterise dv --size 100x75 --map 64 --stats "$folder/dv.json" --hash >"$folder/dv" --verbose \
    2>"$folder/said"
check "a_fit_alone_magnifies_nothing" test "$(least_and_largest column_magnification "$folder/dv.json")" = "1.000 1.000 "
check "nor_turns_anything" agrees angle_degrees 0 "$folder/dv.json"
check "verbose_names_it" grep -q "receiver virtual, reconstruction nearest, parameterisation dv; " "$folder/said"
check "the_warp_has_a_hash" sh -c "[ \$(grep -cE '^warp [0-9a-f]{16}$' '$folder/dv') = 1 ] &&
    grep -q \$(sed -n 's/^warp //p' '$folder/dv') '$folder/dv.json'"
check "which_another_camera_changes" sh -c "sed 's/^camera perspective eye [^ ]*/camera perspective eye 1.5/' '$scene' >'$folder/made/aside.scene'
    '$gnomon' render '$folder/made/aside.scene' --parameterise dv --size 100x75 --map 64 --hash >'$folder/aside' &&
    [ \$(grep -c '^warp' '$folder/aside') = 1 ] && ! grep -q \$(sed -n 's/^warp //p' '$folder/dv') '$folder/aside'"
check "a_uniform_map_has_nothing_of_it" sh -c "'$gnomon' render '$scene' --size 8x6 --stats '$folder/a.json' --hash >'$folder/printed' &&
    grep -q '\"parameterisation\": \"uniform\"' '$folder/a.json' &&
    ! grep -qE 'warp|light_plane|view_pass|view_samples|smoothing|fit_depth' '$folder/a.json' '$folder/printed'"
check "bench_measures_the_view_pass" sh -c "'$gnomon' bench '$scene' --runs 2 --size 40x30 --map 32 --parameterise dv+nonorthogonal \
    --smoothing 4 --json '$folder/bench.json' >'$folder/printed' && grep -q '^view  *[0-9]' '$folder/printed' &&
    grep -q 'reconstruction nearest, parameterisation dv+nonorthogonal, smoothing 4, region' '$folder/printed' &&
    grep -q '\"view\"' '$folder/bench.json' && grep -q '\"smoothing\": 4' '$folder/bench.json'"
check "and_none_of_a_uniform_map" sh -c "! '$gnomon' bench '$scene' --runs 1 --size 40x30 --map 32 | grep -q '^view'"
# shellcheck disable=SC2086 # the options are words
check "fits_and_warps_are_packed" status 0 pack "$scene" $warped --smoothing 2 -o "$folder/warped.gno"
# shellcheck disable=SC2086 # the options are words
check "which_have_the_same_hashes" same_hashes "$(hash_of "$scene" $warped --smoothing 2)" "$(hash_of "$folder/warped.gno")"

check "a_scene_is_packed" status 0 pack "$scene" -o "$folder/lshape.gno"
check "a_packed_scene_has_the_same_hashes" same_hashes "$(hash_of "$scene")" "$(hash_of "$folder/lshape.gno")"
check "what_does_not_say_how_shadows_are_made_packs_no_method" sh -c "'$gnomon' pack '$scene' -o '$folder/again.gno' \
    --size 640x480 && cmp '$folder/again.gno' '$folder/lshape.gno'"
check "a_scene_is_packed_as_c" status 0 pack "$scene" -o "$folder/l-shape.h" --size 32x24 --map 32
check "the_core_compiles" sh -c "mkdir '$folder/core' && core=\$PWD/core && cd '$folder/core' && ${CC:-cc} -std=c99 -c \"\$core\"/*.c"
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
    "$folder/use.c" "$folder"/core/*.o -o "$folder/use"
check "packed_c_holds_the_scene" "$folder/use"

check "a_method_is_packed_as_c" status 0 pack "$scene" -o "$folder/chosen.h" --method slope --receiver plane-bias --slope 3.5 \
    --bias 2t --reconstruct pcf5 --size 32x24 --map 48x64 --parameterise msf+rectilinear --smoothing 2 --fit-depth
check "and_virtual_samples_of_a_packed_scene" status 0 pack "$folder/lshape.gno" -o "$folder/samples.h" \
    --reconstruct jitter4x4 --receiver virtual-always
cat >"$folder/chosen.c" <<'END'
#include "chosen.h"
#include "samples.h"
int main(void)
{
    const gn_settings *s = &chosen_settings, *t = &samples_settings;
    gn_plan plan;
    int first = s->surface == GN_SLOPE && s->slope == 7 << 15 && s->bias.unit == GN_BIAS_TEXELS &&
                s->bias.value == 2 << 16 && s->receiver == &gn_plane_bias && s->reconstruction == &gn_box_5x5 &&
                s->fit == &gn_minimal_frustum && s->warp == &gn_rectilinear && s->fit_depth == 1 && s->smoothing == 2 << 16 &&
                s->map_width == 48 && s->map_height == 64 && s->shadow == GN_SHADOW_MAP;
    int second = t->surface == GN_SECOND && !t->slope && !t->bias.value && t->receiver == &gn_virtual_always &&
                 t->reconstruction == &gn_jitter_4x4;
    return first && second && gn_make_plan(&plan, &chosen_scene, s) == GN_OK &&
           gn_make_plan(&plan, &samples_scene, t) == GN_OK && chosen_camera.far_depth == samples_camera.far_depth &&
           chosen_light.kind == samples_light.kind ? 0 : 1;
}
END
check "silhouettes_are_packed_as_c" status 0 pack "$scene" -o "$folder/edges_too.h" --reconstruct silhouette --size 32x24 --map 32
cat >"$folder/silhouettes.c" <<'END'
#include "edges_too.h"
int main(void)
{
    gn_plan plan;
    return edges_too_settings.reconstruction == &gn_silhouettes && edges_too_meshes[0].edges == edges_too_edges_0 &&
           2 * edges_too_meshes[0].edge_count == 3 * edges_too_meshes[0].triangle_count &&
           gn_make_plan(&plan, &edges_too_scene, &edges_too_settings) == GN_OK && plan.silhouette_bytes == 32 * 32 &&
           edges_too_camera.far_depth > 0 && edges_too_light.box_width > 0 ? 0 : 1;
}
END
check "and_compile_without_a_warning" ${CC:-cc} -std=c99 -pedantic -Wall -Wextra -Werror -Icore -I"$folder" \
    "$folder/silhouettes.c" "$folder"/core/*.o -o "$folder/silhouettes"
check "with_edges_and_a_map" "$folder/silhouettes"
check "they_compile_without_a_warning" ${CC:-cc} -std=c99 -pedantic -Wall -Wextra -Werror -Icore -I"$folder" "$folder/chosen.c" \
    "$folder"/core/*.o -o "$folder/chosen"
check "and_have_the_same_settings" "$folder/chosen"
while read -r option word identifier; do
    check "${word}_is_called_${identifier}_in_c" sh -c "'$gnomon' pack '$scene' -o '$folder/none.h' --method dual --$option $word &&
        grep -q '^    \.[a-z]* = &$identifier,' '$folder/none.h' && [ \$(grep -c '&gn_' '$folder/none.h') = 1 ]"
done <<'END'
receiver plane-bias gn_plane_bias
receiver virtual gn_virtual
receiver virtual-always gn_virtual_always
reconstruct bilinear gn_bilinear
reconstruct jitter4x4 gn_jitter_4x4
reconstruct pcf3 gn_box_3x3
reconstruct pcf5 gn_box_5x5
reconstruct pcf7 gn_box_7x7
reconstruct silhouette gn_silhouettes
reconstruct silhouette-smooth gn_silhouettes_smooth
reconstruct crossing gn_crossings
parameterise dv gn_desired_view
parameterise msf gn_minimal_frustum
parameterise rectilinear gn_rectilinear
parameterise rectilinear-distance gn_rectilinear_distance
parameterise nonorthogonal gn_nonorthogonal
parameterise rectilinear-vertices gn_rectilinear_vertices
parameterise nonorthogonal-vertices gn_nonorthogonal_vertices
END
check "a_point_and_a_nearest_texel_are_not_named_in_c" sh -c "'$gnomon' pack '$scene' -o '$folder/none.h' --method dual &&
    grep -q GN_DUAL '$folder/none.h' && ! grep -qE 'slope|receiver|reconstruction|fit|warp|smoothing' '$folder/none.h'"

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
    -I"$folder" "$folder/edges.c" "$folder"/core/*.o -o "$folder/edges"
check "packed_edges_are_those_of_the_meshes" "$folder/edges"
printf 'v 0 0 0\nv 1 0 0\nf 1 1 2\n' >"$folder/made/sheet.obj"
check "a_mesh_of_no_area_is_packed_with_edges" status 0 pack "$folder/made/edged.scene" -o "$folder/none.h" --edges
echo '#include "none.h"
int main(void) { return !(none_meshes[2].edges && none_meshes[2].edge_count == 0 && none_scene.ambient && none_light.forward[1] &&
    none_camera.far_depth && none_settings.width); }' >"$folder/none.c"
check "and_has_none_that_count" sh -c "${CC:-cc} -std=c99 -pedantic -Wall -Wextra -Werror -Icore -I'$folder' '$folder/none.c' \
    '$folder'/core/*.o -o '$folder/none' && '$folder/none'"
check "edges_worth_a_notice_are_noticed" sh -c "'$gnomon' pack '$folder/made/edged.scene' -o '$folder/none.gno' --edges \
    --verbose 2>&1 | grep -qx 'gnomon: notice: mesh 2 has 1 triangles with two corners at one place'"

# Shadow volumes read no setting of a map: none of a former method is left.
check "a_scene_is_packed_with_volumes" status 0 pack "$scene" --method volumes -o "$folder/volumes.gno"
check "and_by_way_of_a_packed_scene_without_a_method" status 0 pack "$folder/lshape.gno" --method volumes -o "$folder/again.gno"
check "to_the_same_bytes" cmp "$folder/volumes.gno" "$folder/again.gno"
check "a_packed_scene_of_a_method_is_packed" status 0 pack "$scene" --method dual --bias 3t --layers two \
    --receiver plane-bias --slope 3 --reconstruct pcf5 -o "$folder/dual.gno"
check "and_once_more_with_volumes" status 0 pack "$folder/dual.gno" --method volumes -o "$folder/again.gno"
check "to_the_same_bytes_too" cmp "$folder/volumes.gno" "$folder/again.gno"
check "volumes_of_a_packed_scene_are_not_left_for_a_surface" refuses "--virtual-surface has no meaning for shadow volumes" \
    render "$folder/volumes.gno" --virtual-surface dual -o "$folder/new.ppm"
check "a_method_may_be_named_twice" chosen "dual two back 2 texels - point nearest" "$folder/volumes.gno" --method dual \
    --virtual-surface dual
check "but_for_a_method" same_hashes "$(hash_of "$folder/volumes.gno" --method dual)" "$(hash_of "$scene" --method dual)"

mkdir "$folder/folder.ppm"
check "two_scenes_are_refused" refuses "2 scenes" render "$scene" "$scene" -o "$folder/new.ppm"
check "nothing_to_write_is_refused" refuses "nothing to write" render "$scene"
check "an_option_without_its_value_is_refused" refuses "lacks its value" render "$scene" -o
check "an_option_given_twice_is_refused" refuses "given twice" render "$scene" --map 8 --map=9 -o "$folder/new.ppm"
check "an_unknown_method_is_refused" refuses "--method best" render "$scene" --method best -o "$folder/new.ppm"
check "pcf9_is_refused" refuses "--reconstruct pcf9; expected one of: nearest, bilinear, jitter4x4, pcf3, pcf5, pcf7, silhouette, silhouette-smooth, crossing" \
    render "$scene" --reconstruct pcf9 -o "$folder/new.ppm"
for method in mixed auto adaptive volumes; do
    check "silhouettes_of_${method}_are_refused" refuses "--silhouettes, but no silhouette map is made; expected --reconstruct silhouette or silhouette-smooth" \
        render "$scene" --method $method --silhouettes "$folder/new.ppm" -o "$folder/new-too.ppm"
done
check "silhouettes_of_a_filter_are_refused" refuses "expected --reconstruct silhouette or silhouette-smooth" render "$scene" \
    --method silhouette --reconstruct pcf3 --silhouettes "$folder/new.ppm"
check "crossings_have_no_picture" refuses "the map is one of crossings; expected --reconstruct silhouette or silhouette-smooth" \
    render "$scene" --method silhouette --reconstruct crossing --silhouettes "$folder/new.ppm"
check "grey_silhouettes_are_refused" refuses "expected .ppm" render "$scene" --method silhouette --silhouettes "$folder/new.pgm"
check "silhouettes_in_a_missing_folder_are_refused" refuses "cannot be written" render "$scene" --method silhouette \
    --silhouettes "$folder/none/new.ppm" -o "$folder/new.ppm"
check "silhouettes_and_an_image_in_one_file_are_refused" refuses "two outputs at once" render "$scene" --method silhouette \
    --silhouettes "$folder/new.ppm" -o "$folder/new.ppm"
words="expected uniform, a fit (dv, msf), a warp (rectilinear, rectilinear-distance, nonorthogonal, rectilinear-vertices, \
nonorthogonal-vertices), or a fit and a warp with + between them"
while IFS='|' read -r name problem; do
    check "$(echo "${name:-nothing} as a parameterisation is refused" | tr ' ' '_')" refuses "--parameterise $name $problem; $words" \
        render "$scene" --parameterise "$name" -o "$folder/new.ppm"
done <<'END'
best|names something else
|names something else
+|names something else
dv+|names something else
+rectilinear|names something else
dv rectilinear|names something else
dv+rectilinear+|names something else
uniform+dv|names something else
rectilinear+uniform|names something else
rectilinear-|names something else
dv+dv|names two fits
dv+rectilinear+msf|names two fits
rectilinear+rectilinear|names two warps
nonorthogonal+dv+rectilinear|names two warps
END
check "smoothing_without_a_warp_is_refused" refuses "--smoothing has no meaning here; expected a warp" render "$scene" \
    --parameterise dv --smoothing 2 -o "$folder/new.ppm"
check "a_fitted_depth_without_a_fit_is_refused" refuses "--fit-depth has no meaning here; expected a fit" render "$scene" \
    --parameterise rectilinear --fit-depth -o "$folder/new.ppm"
for smoothing in 0 0.015624 64.1 -1 wide; do
    check "a_smoothing_of_${smoothing}_is_refused" refuses "--smoothing $smoothing; expected a number from 0.015625 to 64" render \
        "$scene" --parameterise rectilinear --smoothing "$smoothing" -o "$folder/new.ppm"
done
for reconstruction in bilinear jitter4x4 pcf3 silhouette silhouette-smooth crossing; do
    check "nonorthogonal_with_${reconstruction}_is_refused" refuses "--parameterise dv+nonorthogonal makes no sense with the virtual \
surface second, the receiver virtual and the reconstruction $reconstruction; expected another surface than slope" render "$scene" \
        --parameterise dv+nonorthogonal --reconstruct $reconstruction -o "$folder/new.ppm"
done
check "nonorthogonal_with_a_plane_bias_is_refused" refuses "makes no sense with the virtual surface second, the receiver plane-bias" \
    render "$scene" --parameterise nonorthogonal --receiver plane-bias -o "$folder/new.ppm"
check "nonorthogonal_with_slope_is_refused" refuses "makes no sense with the virtual surface slope, the receiver point" render \
    "$scene" --parameterise nonorthogonal --method slope -o "$folder/new.ppm"
check "a_grid_of_a_uniform_map_is_refused" refuses "--grid, but the map is uniform; expected --parameterise" render "$scene" \
    --grid "$folder/new.ppm"
check "a_grey_grid_is_refused" refuses "expected .ppm" render "$scene" --parameterise dv --grid "$folder/new.pgm"
check "a_grid_and_a_map_in_one_file_are_refused" refuses "two outputs at once" render "$scene" --parameterise dv \
    --grid "$folder/new.ppm" -o "$folder/new.ppm"
check "an_unknown_receiver_is_refused" refuses "--receiver x; expected one of: point, plane-bias, virtual, virtual-always" \
    render "$scene" --receiver x -o "$folder/new.ppm"
check "an_unknown_surface_is_refused" refuses "--virtual-surface adaptive; expected one of: constant, midpoint, dual, second," \
    render "$scene" --virtual-surface adaptive -o "$folder/new.ppm"
check "surface_against_method_is_refused" refuses "contradicts" render "$scene" --method dual --virtual-surface second \
    -o "$folder/new.ppm"
check "another_surface_than_adaptive_has_is_refused" refuses "--virtual-surface slope contradicts --method adaptive" render \
    "$scene" --method adaptive --virtual-surface slope -o "$folder/new.ppm"
check "a_surface_beside_auto_is_refused" refuses "contradicts --method auto" render "$scene" --method auto \
    --virtual-surface second -o "$folder/new.ppm"
check "a_bias_of_midpoint_is_refused" refuses "has no meaning for the virtual surface 'midpoint'" render "$scene" \
    --method midpoint --bias 1t -o "$folder/new.ppm"
check "a_slope_of_nothing_is_refused" refuses "--slope has no meaning here; expected the virtual surface 'slope' or the receiver" \
    render "$scene" --method mixed --receiver virtual --slope 2 -o "$folder/new.ppm"
for slope in 64.00001 -0.1 2x ''; do
    check "a_slope_of_${slope:-nothing_at_all}_is_refused" refuses "--slope $slope; expected a number from 0 to 64" render "$scene" \
        --method slope --slope "$slope" -o "$folder/new.ppm"
done
for option in '--parameterise dv' '--parameterise uniform' '--smoothing 2' --fit-depth '--receiver virtual' '--reconstruct pcf3' '--reconstruct silhouette' '--reconstruct crossing' '--slope 2'; do
    # shellcheck disable=SC2086 # the option and its value
    check "$(echo "$option" | tr ' ' '_')_with_volumes_is_refused" refuses "${option% *} has no meaning for shadow volumes" \
        render "$scene" --method volumes $option -o "$folder/new.ppm"
done
check "a_receiver_of_one_column_is_refused" refuses "the receiver virtual with the reconstruction nearest, but the map is 1 x 8; expected" \
    render "$scene" --map 1x8 -o "$folder/new.ppm"
check "a_reconstruction_of_one_row_is_refused" refuses "the receiver point with the reconstruction pcf3, but the map is 8 x 1; expected" \
    render "$scene" --map 8x1 --method dual --reconstruct pcf3 -o "$folder/new.ppm"
check "silhouettes_of_one_row_are_refused" refuses "the receiver virtual with the reconstruction silhouette, but the map is 8 x 1; expected" \
    render "$scene" --map 8x1 --method silhouette -o "$folder/new.ppm"
check "a_point_takes_a_map_of_one_texel" status 0 render "$scene" --map 1 --receiver point -o "$folder/a.ppm"
check "a_negative_bias_is_refused" refuses "bias '-1t'" render "$scene" --method dual --bias -1t -o "$folder/new.ppm"
check "constant_with_two_layers_is_refused" refuses "makes no sense" render "$scene" --method constant --layers two \
    -o "$folder/new.ppm"
check "slope_with_two_layers_is_refused" refuses "the virtual surface 'slope' makes no sense with --layers two" render "$scene" \
    --method slope --layers two -o "$folder/new.ppm"
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

png_comes_back() {
    status 0 render "$scene" --mask "$folder/png.pgm" -o "$folder/png.ppm" &&
        status 0 render "$scene" --mask "$folder/mask.png" -o "$folder/png.png" &&
        test -s "$folder/png.png" && status 0 compare "$folder/mask.png" "$folder/png.pgm"
}
if [ -e "$(dirname "$gnomon")/gnomon-oiio.so" ]; then
    check "png_is_written_and_read_where_openimageio_is_present" png_comes_back
else
    check "png_without_openimageio_says_what_to_install" refuses "install libopenimageio-dev and rebuild" render "$scene" \
        -o "$folder/png.png"
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
ln -s linked.json "$folder/link.json"
echo old >"$folder/linked.json"
check "output_to_a_link_is_written_through_it" sh -c "'$gnomon' render '$scene' --size 8x6 --stats '$folder/link.json' &&
    [ -L '$folder/link.json' ] && '$gnomon' render '$scene' --size 9x6 --stats '$folder/link.json' &&
    [ -L '$folder/link.json' ] && grep -q '\"width\": 9' '$folder/linked.json'"
check "one_file_for_two_outputs_is_refused" refuses "two outputs at once" render "$scene" -o "$folder/new.ppm" \
    --stats "$folder/new.ppm"
check "a_scene_is_not_overwritten" refuses "would be overwritten" render "$scene" --stats "$scene"
check "nor_by_bench" refuses "would be overwritten" bench "$scene" --runs 1 --json "$scene"
check "the_scene_is_as_it_was" grep -q camera "$scene"
check "one_bad_output_stops_the_others" refuses "cannot be written" render "$scene" -o "$folder/new.ppm" \
    --mask "$folder/none/new.pgm"
# Point lights.
point=$folder/made/point.scene
sed 's/^light.*/light point position 2 4 1 near 0.2 far 60/' "$scene" >"$point"
check "a_point_light_is_rendered" status 0 render "$point" --size 100x75 --map 64 --method silhouette --mask "$folder/six.pgm" \
    --depth "$folder/faces.pgm" --silhouettes "$folder/faces.ppm" --stats "$folder/six.json"
check "its_six_maps_lie_one_below_the_other" sh -c "head -n 2 '$folder/faces.pgm' | tail -n 1 | grep -qx '64 384'"
check "and_none_of_them_is_missing" sh -c "[ \$(tail -c $((2 * 64 * 384)) '$folder/faces.pgm' | od -An -v -tx2 -w2 | grep -c 0000) = 0 ]"
check "lit_and_shadowed_pixels_are_there" sh -c "for value in 0 254; do
    [ \$(tail -c 7500 '$folder/six.pgm' | od -An -v -tu1 -w1 | grep -cx ' *'\$value) -gt 200 ] || exit 1; done"
check "one_map_at_a_time_makes_the_same_mask" sh -c "'$gnomon' render '$point' --size 100x75 --map 64 --method silhouette \
    --faces one --mask '$folder/one.pgm' --stats '$folder/one.json' && cmp '$folder/six.pgm' '$folder/one.pgm'"
check "in_a_sixth_of_the_map" test "$(count_of map "$folder/six.json")" = "$((6 * $(count_of map "$folder/one.json")))"
check "all_faces_are_counted" test "$(($(count_of faces_drawn "$folder/six.json") + $(count_of faces_skipped "$folder/six.json")))" = 6
check "workers_and_regions_change_no_hash" sh -c "[ \"\$('$gnomon' render '$point' --hash --map 64 --size 80x60)\" = \
    \"\$('$gnomon' render '$point' --hash --map 64 --size 80x60 --workers 3 --region 17x13 --map-rows 5)\" ]"
check "a_packed_point_light_is_the_same" sh -c "'$gnomon' pack '$point' -o '$folder/point.gno' --method silhouette --faces one --size 100x75 --map 64 &&
    '$gnomon' render '$folder/point.gno' --mask '$folder/packed.pgm' --verbose 2>&1 | grep 'faces one' &&
    cmp '$folder/six.pgm' '$folder/packed.pgm'"
check "a_header_names_its_faces" sh -c "'$gnomon' pack '$point' -o '$folder/point.h' && grep -q 'kind = GN_POINT' '$folder/point.h' &&
    grep -q 'faces = &gn_six_faces' '$folder/point.h'"
check "a_point_light_is_measured" status 0 bench "$point" --runs 1 --size 40x30 --map 32 --faces one
check "volumes_take_no_point_light" refuses "shadow volumes take no point light" render "$point" --method volumes -o "$folder/new.ppm"
check "nor_does_a_fit" refuses "takes no point light" render "$point" --parameterise dv -o "$folder/new.ppm"
check "other_lights_have_no_faces" refuses "expected a scene with a point light" render "$scene" --faces six -o "$folder/new.ppm"
check "a_point_light_has_some" refuses "expected six or one" render "$point" --faces none -o "$folder/new.ppm"
check "of_one_map_at_a_time_none_is_written" refuses "no map stays" render "$point" --faces one --depth "$folder/new.pgm"
check "a_map_that_is_all_border_is_refused" refuses "too small for a point light" render "$point" --map 4 -o "$folder/new.ppm"
check "nothing_is_left_behind_by_any" nothing_left

finish
