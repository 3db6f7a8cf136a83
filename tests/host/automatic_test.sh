#!/bin/sh
# `--method auto` with a budget, from the command line: budgets are kept, what is said is true, and what was chosen is
# what is rendered and packed. GNOMON: the simulator.
set -u
. "$(dirname "$0")/../simulator.sh"

# auto SCENE ARGUMENT...: render it small with a budget; mask, statistics and what is said stay in the folder.
auto() {
    "$gnomon" render "$@" --method auto --size 64x48 --mask "$folder/mask.pgm" --stats "$folder/stats.json" 2>"$folder/said"
    result=$?
    cat "$folder/said"
    return $result
}

# A number of the statistics; of `name` twice the first.
number() {
    awk -v name="$1" '{ gsub(/[",:]/, " ") } $1 == name && !n++ { print $2 }' "$folder/stats.json"
}

# What stays between the passes: texels of 2 bytes, silhouettes, where the texels of a warp lie.
resident() {
    echo $((2 * $(number map_width) * $(number map_height) + $(number silhouettes) + $(number warp) + 0))
}

# Wrong pixels of the mask against the truth, %.
error_of_mask() {
    "$gnomon" truth "$1" --size 64x48 --mask "$folder/truth.pgm" >/dev/null &&
        "$gnomon" compare "$folder/mask.pgm" "$folder/truth.pgm" --json "$folder/compared.json" >/dev/null
    awk '{ gsub(/[",:]/, " ") } $1 == "error_percent" && !n++ { print $2 }' "$folder/compared.json"
}

# The per cent that the line says.
error_said() {
    sed -n 's/.*KiB: \([0-9.e-]*\) % wrong on this view.*/\1/p; s/.*bytes: \([0-9.e-]*\) % wrong on this view.*/\1/p' "$folder/said"
}

# holds EXPRESSION: awk finds it true.
holds() {
    awk "BEGIN { exit !($1) }" || { echo "not true: $1"; return 1; }
}

one_line() {
    cat "$folder/said"
    [ "$(wc -l <"$folder/said")" = 1 ] && grep -q "^auto: " "$folder/said"
}

"$gnomon" procedural lshape -o "$folder" >/dev/null
"$gnomon" procedural fence -o "$folder" >/dev/null
"$gnomon" procedural sheets -o "$folder" >/dev/null
lshape=$folder/lshape.scene

# ---- bytes ----

last=100
for kilobytes in 1 2 4 8; do
    auto "$folder/fence.scene" --budget-bytes ${kilobytes}K >/dev/null
    check "${kilobytes}K_are_kept" holds "$(resident) <= 1024 * $kilobytes && $(resident) > 1024 * $kilobytes * 0.9"
    check "in_${kilobytes}K_what_is_said_is_true" test "$(error_said)" = "$(error_of_mask "$folder/fence.scene" | awk '{ printf "%.3g", $1 }')"
    check "${kilobytes}K_err_no_more_than_half_of_them" holds "$(error_of_mask "$folder/fence.scene") <= $last"
    last=$(error_of_mask "$folder/fence.scene")
done
check "one_line_is_said" one_line
check "bytes_are_bytes" sh -c "'$gnomon' render '$lshape' --size 8x6 --budget-bytes 600 --mask '$folder/a.pgm' 2>'$folder/a' &&
    '$gnomon' render '$lshape' --size 8x6 --budget-bytes 600K --mask '$folder/a.pgm' 2>'$folder/b' && ! cmp -s '$folder/a' '$folder/b'"

# ---- error ----

for error in 20 5 1; do
    auto "$folder/sheets.scene" --budget-error $error >/dev/null
    check "an_error_of_${error}_is_kept" holds "$(error_of_mask "$folder/sheets.scene") <= $error"
    bytes=$(resident)
    auto "$folder/sheets.scene" --budget-error $error --budget-bytes $((bytes * 3 / 4)) >/dev/null
    check "three_quarters_of_its_bytes_do_not_keep_it" holds "$(error_of_mask "$folder/sheets.scene") > $error"
    check "that_nothing_keeps_both_is_said" grep -q "^auto: nothing keeps the budget; " "$folder/said"
done
auto "$folder/sheets.scene" --budget-bytes 16K --budget-error 5 >/dev/null
check "both_budgets_are_kept" holds "$(resident) <= 16384 && $(error_of_mask "$folder/sheets.scene") <= 5"
cheap=$(sed -n 's/.* \([0-9]*\) instructions a pixel.*/\1/p' "$folder/said")
auto "$folder/sheets.scene" --budget-bytes 16K >/dev/null
check "cheaper_than_the_least_error" holds "$cheap < $(sed -n 's/.* \([0-9]*\) instructions a pixel.*/\1/p' "$folder/said")"

# ---- only what a scene needs ----

cat >"$folder/floor.obj" <<'END'
v -5 0 -5
v -5 0 5
v 5 0 5
v 5 0 -5
f 1 2 3 4
END
for direction in "0 -1 0.2" "0 1 0.2"; do
    cat >"$folder/floor.scene" <<END
image 64 48
map 64
camera perspective eye 0 6 9 target 0 0 0 up 0 1 0 fovy 40 near 1 far 50
light directional direction $direction
ambient 0.2
mesh floor.obj surface open color 1 1 1
END
    auto "$folder/floor.scene" --budget-bytes 32K >/dev/null
    check "a_floor_alone_under_light_$direction has_the_least_map" holds "$(resident) == 2 && $(number all) < 200000"
done
auto "$lshape" --budget-bytes 8K >/dev/null
check "solids_have_one_layer_without_front_faces" grep -q '"layers": "first"' "$folder/stats.json"
check "of_culled_faces" grep -qE '"cull": "(front|back)"' "$folder/stats.json"

{
    sed 's/^light.*/light point position 1 4 1 near 0.1 far 30/' "$folder/floor.scene"
    echo "mesh lshape_L.obj surface closed color 1 1 1"
} >"$folder/point.scene"
auto "$folder/point.scene" --budget-bytes 16K >/dev/null
check "a_point_light_has_six_maps_within_the_bytes" holds "12 * $(number map_width) * $(number map_height) + $(number silhouettes) + 0 <= 16384 && $(number map_width) > 24"
check "no_fit_and_no_warp" grep -q '"parameterisation": "uniform"' "$folder/stats.json"
check "refuses_fewer_bytes_than_six_maps_have" refuses "expected 972 or more" render "$folder/point.scene" --mask "$folder/new.pgm" --budget-bytes 971

# 604 triangles: 151 bytes for how they face, and at most 8 x 906 for their edges.
auto "$folder/fence.scene" --budget-bytes 8K --budget-error 0.1 >/dev/null
check "shadow_volumes_where_no_map_keeps_the_error" grep -q '"shadow": "volumes"' "$folder/stats.json"

# 32 triangles and 48 edges have 8 + 384 bytes; a map of 16 x 16 texels has 512.
auto "$lshape" --budget-bytes 500 >/dev/null
check "shadow_volumes_where_no_map_of_use_fits" grep -q '"shadow": "volumes"' "$folder/stats.json"
auto "$lshape" --budget-bytes 391 >/dev/null
check "a_small_map_where_they_do_not_fit" holds "$(resident) > 300 && $(resident) <= 391"

# ---- by the tables alone ----

auto "$lshape" --budget-bytes 8K --no-trial >/dev/null
check "without_a_trial_bytes_are_kept" holds "$(resident) <= 8192 && $(resident) > 8192 * 0.9"
check "without_a_trial_no_error_is_claimed" sh -c "grep -q 'not tried' '$folder/said' && ! grep -q 'on this view' '$folder/said'"

"$gnomon" render "$lshape" --size 64x48 --budget-bytes 2K --mask "$folder/1.pgm" --workers 1 2>"$folder/1"
"$gnomon" render "$lshape" --size 64x48 --budget-bytes 2K --mask "$folder/2.pgm" --workers 2 --region 20x7 --map-rows 5 2>"$folder/2"
check "how_the_work_is_cut_changes_nothing" cmp "$folder/1" "$folder/2"

# ---- what is chosen is what is packed ----

for scene in fence sheets; do
    "$gnomon" pack "$folder/$scene.scene" -o "$folder/$scene.gno" --size 64x48 --method auto --budget-bytes 4K >/dev/null 2>"$folder/packed"
    check "pack_says_it_of_${scene}_as_well" grep -q "^auto: " "$folder/packed"
    "$gnomon" render "$folder/$scene.gno" --hash >"$folder/of_packed"
    "$gnomon" render "$folder/$scene.scene" --size 64x48 --method auto --budget-bytes 4K --hash >"$folder/of_scene" 2>/dev/null
    check "packed_${scene}_is_rendered_as_it_was_chosen" cmp "$folder/of_packed" "$folder/of_scene"
done
"$gnomon" pack "$folder/fence.scene" -o "$folder/fence.h" --size 64x48 --method auto --budget-bytes 4K >/dev/null 2>&1
"$gnomon" render "$folder/fence.gno" --mask "$folder/mask.pgm" --stats "$folder/stats.json"
check "a_header_has_the_size_of_the_map" sh -c "grep -q 'map_width = $(number map_width),' '$folder/fence.h' && grep -q 'map_height = $(number map_height),' '$folder/fence.h'"
check "bench_takes_a_budget" status 0 bench "$lshape" --size 32x24 --runs 1 --method auto --budget-bytes 2K

# ---- refusals ----

for bytes in 0 -1 K 1.5K 12k 32KB 1e3 "" 5000M; do
    check "refuses_${bytes}_bytes" refuses "--budget-bytes $bytes" render "$lshape" --mask "$folder/new.pgm" --budget-bytes "$bytes"
done
for error in -1 -0.1 101 nan inf x ""; do
    check "refuses_an_error_of_$error" refuses "--budget-error $error" render "$lshape" --mask "$folder/new.pgm" --budget-error="$error"
done
check "refuses_fewer_bytes_than_a_texel_has" refuses "expected 2 or more" render "$lshape" --mask "$folder/new.pgm" --budget-bytes 1
check "refuses_another_method" refuses "--budget-bytes with dual; expected --method auto" \
    render "$lshape" --mask "$folder/new.pgm" --method dual --budget-bytes 4K
check "refuses_the_method_of_a_file" refuses "the method of the file" render "$folder/fence.gno" --mask "$folder/new.pgm" --budget-error 1
check "refuses_a_map" refuses "--budget-error with --map" render "$lshape" --mask "$folder/new.pgm" --map 64 --budget-error 1
check "refuses_a_reconstruction" refuses "with --reconstruct" pack "$lshape" -o "$folder/new.gno" --reconstruct pcf3 --budget-error 1
check "refuses_no_trial_without_a_budget" refuses "--no-trial" render "$lshape" --mask "$folder/new.pgm" --no-trial

check "nothing_is_left_behind_by_any" nothing_left
finish
