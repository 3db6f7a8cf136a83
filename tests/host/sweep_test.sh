#!/bin/sh
# gnomon sweep: its rows are what render, truth and compare say one by one, in one order whatever the workers, and an
# interrupted sweep goes on to the same rows. GNOMON: the simulator.
set -u
. "$(dirname "$0")/../simulator.sh"

# column NAME FILE: a line each for the rows. No text of a sweep has a comma.
column() {
    awk -F, -v name="$1" 'NR == 1 { for (i = 1; i <= NF; i++) if ($i == name) at = i; next } { print $at }' "$2"
}

# cell COLUMN CHAIN MAP FILE: of its first row.
cell() {
    awk -F, -v name="$1" -v chain="$2" -v map="$3" '
        NR == 1 { for (i = 1; i <= NF; i++) at[$i] = i; next }
        $at["chain"] == chain && $at["map"] == map { print $at[name]; exit }' "$4"
}

# All columns but the host's time, the only one that differs from run to run.
timeless() {
    awk -F, -v OFS=, 'NR == 1 { for (i = 1; i <= NF; i++) if ($i == "host_ratio") at = i } NR > 1 { $at = "" } { print }' "$1"
}

same_rows() {
    timeless "$1" >"$folder/1.csv" && timeless "$2" >"$folder/2.csv" && diff "$folder/1.csv" "$folder/2.csv"
}

# equal GOT EXPECTED: numbers, to seven digits.
equal() {
    awk -v a="$1" -v b="$2" 'BEGIN {
        d = a - b; if (d < 0) d = -d; m = b < 0 ? -b : b
        if (a == "" || b == "" || d > 1e-7 * (m > 1 ? m : 1)) { print "got " a ", expected " b; exit 1 } }'
}

# number NAME FILE: the first of that name in JSON.
number() {
    awk -v name="\"$1\":" '$1 == name { sub(/,$/, "", $2); print $2; exit }' "$2"
}

"$gnomon" procedural all -o "$folder" >/dev/null
scene=$folder/fence.scene
table=$folder/table.scene

# ---- rows ----------------------------------------------------------------------------------------------------------

check "a_sweep_is_done" status 0 sweep "$scene" -o "$folder/a" --depths 16 --maps 32,120 --budgets 9K,32K --size 48x40
csv=$folder/a/sweep.csv
check "it_leaves_these_files" test "$(find "$folder/a" -type f ! -name index.html | sed 's/.*\///' | sort | tr '\n' ' ')" = "fence.truth.pgm sweep.csv sweep.json "
check "31_chains_have_a_map_at_4_sizes_and_volumes_a_row" test "$(column chain "$csv" | wc -l)" = 125
check "json_has_as_many" test "$(grep -c '"key":' "$folder/a/sweep.json")" = 125
"$gnomon" truth "$scene" --size 48x40 --mask "$folder/truth.pgm" >/dev/null
check "the_truth_is_kept" sh -c "[ \"\$(tail -c 1920 '$folder/a/fence.truth.pgm' | cksum)\" = \"\$(tail -c 1920 '$folder/truth.pgm' | cksum)\" ]"

# says_what_others_say CHAIN MAP: the columns of a row are what render and compare say of its options.
says_what_others_say() {
    options=$(cell options "$1" "$2" "$csv")
    # shellcheck disable=SC2086
    "$gnomon" render "$scene" $options --mask "$folder/mask.pgm" --stats "$folder/stats.json" || return 1
    "$gnomon" compare "$folder/mask.pgm" "$folder/truth.pgm" --json "$folder/compare.json" >/dev/null
    for name in false_shadow:false_shadow_percent false_light:false_light_percent error:error_percent; do
        equal "$(cell "${name%:*}" "$1" "$2" "$csv")" "$(number "${name#*:}" "$folder/compare.json")" || return 1
    done
    equal "$(cell mean_absolute_error "$1" "$2" "$csv")" "$(awk -v e="$(number mean_absolute_error "$folder/compare.json")" 'BEGIN { printf "%.9g", 100 * e }')" || return 1
    awk '/"error_to_edge"/ { inside = 1 } inside' "$folder/compare.json" >"$folder/edge.json"
    equal "$(cell edge_band "$1" "$2" "$csv")" "$(number in_edge_band_percent "$folder/edge.json")" || return 1
    equal "$(cell interior "$1" "$2" "$csv")" "$(number in_interior_percent "$folder/edge.json")" || return 1
    for name in pixels:pixels_shaded tested:pixels_tested $3; do
        equal "$(cell "${name%:*}" "$1" "$2" "$csv")" "$(number "${name#*:}" "$folder/stats.json")" || return 1
    done
}
cascade="outside:pixels_outside agreed:pixels_agreed virtual:pixels_virtual fractional:pixels_fractional"
check "a_row_of_constant_is_what_render_and_compare_say" says_what_others_say constant 32 ""
check "a_row_of_the_best_bias_is" says_what_others_say constant-best 32 ""
check "a_row_of_plane_bias_is" says_what_others_say plane-bias 120 "$cascade"
check "a_row_of_a_filter_is" says_what_others_say pcf5 32 "$cascade"
check "a_row_of_silhouettes_is" says_what_others_say silhouette/msf+rectilinear 120 "$cascade silhouette:pixels_silhouette p_percent:silhouette_percent"
check "a_row_of_a_warp_is" says_what_others_say mixed+virtual/dv+nonorthogonal 32 "$cascade"
check "a_row_of_volumes_is" says_what_others_say volumes 0 "overdraw:overdraw"
check "filters_are_wrong_by_fractions" sh -c "[ '$(cell error pcf5 32 "$csv")' != '$(cell mean_absolute_error pcf5 32 "$csv")' ]"
check "a_hard_mask_is_wrong_by_whole_pixels" equal "$(cell mean_absolute_error silhouette 32 "$csv")" "$(cell error silhouette 32 "$csv")"
check "something_is_wrong_and_something_right" sh -c "echo '$(cell error constant 32 "$csv")' | awk '{ exit !(\$1 > 0 && \$1 < 100) }'"

# Sen et al. 2003, section 4: 4 + 3 x 8 P bytes a pixel for 4; 5.5 O for 4.
check "bandwidth_of_a_map_is_1" equal "$(cell bandwidth mixed 32 "$csv")" 1
check "bandwidth_of_silhouettes_is_1_and_6_P" equal "$(cell bandwidth silhouette 32 "$csv")" "$(echo "$(cell p_percent silhouette 32 "$csv")" | awk '{ printf "%.9g", 1 + 6 * $1 / 100 }')"
check "bandwidth_of_volumes_is_5.5_O_over_4" equal "$(cell bandwidth volumes 0 "$csv")" "$(echo "$(cell overdraw volumes 0 "$csv")" | awk '{ printf "%.9g", 5.5 * $1 / 4 }')"
check "the_model_says_nothing_of_filters" test -z "$(cell bandwidth pcf5 32 "$csv")"

# Where a lane counts (LANE_CLANG), operations stand in all rows; the cost model's instructions always.
check "all_rows_have_operations_or_none" test "$(column loads "$csv" | sed 's/[0-9][0-9]*/n/' | sort -u | wc -l)" = 1
check "all_rows_have_instructions" sh -c "! awk -F, 'NR > 1 { for (i = 34; i <= 37; i++) if (\$i == \"\") print }' '$csv' | grep ."
per_pixel() {
    equal "$(cell m4_pixel "$1" "$2" "$csv")" "$(awk -v v="$(cell m4_view "$1" "$2" "$csv")" -v l="$(cell m4_light "$1" "$2" "$csv")" \
        -v c="$(cell m4_camera "$1" "$2" "$csv")" -v p="$(cell pixels "$1" "$2" "$csv")" 'BEGIN { printf "%.9g", (v + l + c) / p }')"
}
check "instructions_a_pixel_are_of_all_passes" per_pixel silhouette/msf+rectilinear 120
check "without_a_view_pass_none_are_of_it" equal "$(cell m4_view mixed 32 "$csv")" 0

# ---- the best bias --------------------------------------------------------------------------------------------------

# No power of two from 1/8 to 32 texels is better.
no_power_of_two_is_better() {
    best=$(cell error constant-best "$1" "$csv")
    for bias in 0.125 0.25 0.5 1 2 4 8 16 32; do
        "$gnomon" render "$scene" --method constant --bias ${bias}t --map "$1" --size 48x40 --mask "$folder/mask.pgm"
        "$gnomon" compare "$folder/mask.pgm" "$folder/truth.pgm" --json "$folder/compare.json" >/dev/null
        awk -v best="$best" -v other="$(number error_percent "$folder/compare.json")" -v bias="$bias" 'BEGIN {
            if (best > other + 1e-7) { print "bias " bias ": " other ", best: " best; exit 1 } }' || return 1
    done
}
check "the_best_bias_is_no_worse_than_powers_of_two" no_power_of_two_is_better 32
check "nor_at_another_size" no_power_of_two_is_better 120
check "the_bias_is_that_of_the_options" test "$(cell options constant-best 32 "$csv" | sed 's/.*--bias \(.*\)t --map.*/\1/')" = "$(cell bias constant-best 32 "$csv")"

# ---- budgets --------------------------------------------------------------------------------------------------------

# is_largest_for BUDGET CHAIN: its map fits, and one of a texel more does not.
is_largest_for() {
    map=$(awk -F, -v budget="$1" -v chain="$2" '$6 == budget && $2 == chain { print $5 }' "$csv")
    status 0 sweep "$scene" -o "$folder/beyond" --depths 16 --methods "$2" --maps "$map,$((map + 1))" --budgets none --size 48x40 || return 1
    fits=$(cell resident_bytes "$2" "$map" "$folder/beyond/sweep.csv")
    beyond=$(cell resident_bytes "$2" $((map + 1)) "$folder/beyond/sweep.csv")
    echo "map $map: $fits, one more: $beyond"
    rm -r "$folder/beyond"
    [ "$fits" -le "$1" ] && [ "$beyond" -gt "$1" ]
}
for chain in constant silhouette crossing/msf+rectilinear mixed+virtual/dv+nonorthogonal; do
    check "the_largest_map_of_9K_by_$chain" is_largest_for 9216 $chain
done
# A row of the map has so many texels beyond its end: 0 in a firmware's core, 16 in that of a processor with vectors.
padding=$(($(cell resident_bytes constant 32 "$csv") / 64 - 32))
check "a_map_has_two_bytes_a_texel" test $padding = 0 -o $padding = 16
check "that_of_silhouettes_one_more" sh -c "extra=\$(($(cell resident_bytes silhouette 32 "$csv") - $(cell resident_bytes constant 32 "$csv")))
    [ \$extra -ge 1024 ] && [ \$extra -le 1152 ]"
# 2 n (n + padding) <= 32768
wide=$([ $padding = 0 ] && echo 128 || echo 120)
check "32K_hold_a_map_of_$wide" test "$(awk -F, '$6 == 32768 && $2 == "mixed" { print $5 }' "$csv")" = "$wide"
check "a_map_that_was_asked_for_as_well_has_the_same_row" sh -c "'$gnomon' sweep '$scene' -o '$folder/twins' --depths 16 --methods mixed,constant --maps $wide --budgets 32K --size 48x40 >'$folder/out' &&
    [ \$(awk -F, -v OFS=, '\$2 == \"mixed\" { \$6 = \$NF = \"\"; print }' '$folder/twins/sweep.csv' | wc -l) = 2 ] &&
    [ \$(awk -F, -v OFS=, '\$2 == \"mixed\" { \$6 = \$NF = \"\"; print }' '$folder/twins/sweep.csv' | uniq | wc -l) = 1 ]"
check "but_for_the_budget" test "$(awk -F, '$2 == "mixed" { print $6 }' "$folder/twins/sweep.csv" | tr '\n' ' ')" = "0 32768 "

# ---- order, interruption ----------------------------------------------------------------------------------------------

few="--depths 16 --maps 32,64 --budgets 9K --size 32x24 --methods constant,constant-best,slope,midpoint,dual,second-depth,mixed,adaptive,plane-bias,mixed+virtual,bilinear,silhouette,crossing,mixed+virtual/dv,silhouette/msf+rectilinear,volumes"
# shellcheck disable=SC2086
check "one_worker" status 0 sweep "$scene" "$table" -o "$folder/one" $few --workers 1
# shellcheck disable=SC2086
check "seven_workers" status 0 sweep "$scene" "$table" -o "$folder/seven" $few --workers 7
check "make_the_same_rows_in_the_same_order" same_rows "$folder/one/sweep.csv" "$folder/seven/sweep.csv"

# interrupted_by SIGNAL STATUS: begun from a cut line, stopped when ten rows are there, and then it goes on.
interrupted_by() {
    rm -rf "$folder/cut"
    mkdir "$folder/cut"
    head -c 1000 "$folder/one/sweep.csv" >"$folder/cut/sweep.csv"
    (
        until [ -e "$folder/cut/sweep.csv" ] && [ "$(wc -l <"$folder/cut/sweep.csv")" -gt 10 ]; do sleep 0.01; done
        kill -s "$1" "$(cat "$folder/pid")"
    ) &
    # shellcheck disable=SC2086
    sh -c 'echo $$ >"$0"; exec "$@"' "$folder/pid" "$gnomon" sweep "$scene" "$table" -o "$folder/cut" $few --workers 2 >"$folder/out" 2>"$folder/err"
    got=$?
    wait
    [ $got = "$2" ] || { echo "exit status $got, expected $2"; return 1; }
    lines=$(wc -l <"$folder/cut/sweep.csv")
    [ "$lines" -gt 10 ] && [ "$lines" -lt 93 ] || { echo "$lines lines"; return 1; }
    [ ! -s "$folder/out" ] && [ ! -e "$folder/cut/sweep.json" ] && nothing_left || return 1
    # shellcheck disable=SC2086
    status 0 sweep "$scene" "$table" -o "$folder/cut" $few 2>"$folder/err2" || return 1
    grep -q "rows were measured before" "$folder/err2" && same_rows "$folder/one/sweep.csv" "$folder/cut/sweep.csv"
}
# Not INT: who runs this in the background has it ignored, and a shell cannot undo that.
check "interrupted_it_goes_on" interrupted_by TERM 143
check "and_says_how" grep -q "the same command goes on from there" "$folder/err"
check "killed_it_goes_on" interrupted_by KILL 137
cut_line_is_dropped() {
    size=$(($(wc -c <"$folder/one/sweep.csv") / 2))
    head -c $size "$folder/one/sweep.csv" >"$folder/cut/sweep.csv"
    # shellcheck disable=SC2086
    status 0 sweep "$scene" "$table" -o "$folder/cut" $few && same_rows "$folder/one/sweep.csv" "$folder/cut/sweep.csv"
}
check "a_cut_line_is_dropped" cut_line_is_dropped
more_is_added() {
    # shellcheck disable=SC2086
    status 0 sweep "$scene" "$table" -o "$folder/cut" ${few%,volumes},jitter4x4,volumes && [ "$(wc -l <"$folder/cut/sweep.csv")" = 99 ]
}
check "more_is_added_to_what_is_there" more_is_added
check "a_cut_first_line_too" sh -c "printf 'scene,ch' >'$folder/cut/sweep.csv' &&
    '$gnomon' sweep '$table' -o '$folder/cut' --depths 16 --methods volumes --size 8x6 && [ \$(wc -l <'$folder/cut/sweep.csv') = 2 ]"

# A sweep that is stopped in the middle of its work still has the folder.
two_at_once_are_refused() {
    rm -rf "$folder/both"
    # shellcheck disable=SC2086
    "$gnomon" sweep "$scene" "$table" -o "$folder/both" $few --workers 1 >"$folder/first" 2>&1 &
    first=$!
    until [ -e "$folder/both/sweep.csv" ] && [ "$(wc -l <"$folder/both/sweep.csv")" -gt 2 ]; do sleep 0.01; done
    kill -s STOP $first
    # shellcheck disable=SC2086
    refuses "another gnomon sweep" sweep "$scene" "$table" -o "$folder/both" $few --workers 1
    refused=$?
    kill -s CONT $first
    wait $first && [ $refused = 0 ] && same_rows "$folder/one/sweep.csv" "$folder/both/sweep.csv"
}
check "two_at_once_are_refused" two_at_once_are_refused

# ---- odd scenes -------------------------------------------------------------------------------------------------------

mkdir "$folder/other"
cp "$folder"/fence* "$folder/other"
check "two_scenes_may_have_one_name" status 0 sweep "$scene" "$folder/other/fence.scene" -o "$folder/names" --depths 16 --maps 16 --budgets none --size 1x1 --methods constant,silhouette,silhouette/msf+rectilinear,volumes
check "the_second_gets_a_number" test "$(column scene "$folder/names/sweep.csv" | uniq | tr '\n' ' ')" = "fence fence-2 "
sed 's/^light.*/light point position 0 6 0 near 0.5 far 60/' "$scene" >"$folder/point.scene"
check "a_point_light_has_maps" status 0 sweep "$folder/point.scene" -o "$folder/point" --depths 16 --maps 24 --budgets none --size 12x10
check "17_chains_without_fits_warps_volumes" test "$(column chain "$folder/point/sweep.csv" | wc -l)" = 17
check "14_and_volumes_are_left_out_and_json_says_why" sh -c "[ \$(grep -c '\"reason\": \"fits and warps take no point light\"' '$folder/point/sweep.json') = 14 ] &&
    [ \$(grep -c '\"reason\": \"shadow volumes take no point light\"' '$folder/point/sweep.json') = 1 ]"
sed 's/^camera.*/camera perspective eye 0 5 0 target 0 50 1 up 0 1 0 fovy 40 near 1 far 100/' "$scene" >"$folder/nothing.scene"
check "no_surface_may_be_seen" status 0 sweep "$folder/nothing.scene" -o "$folder/nothing" --depths 16 --maps 24 --budgets none --size 12x10 --methods constant,constant-best,silhouette/dv,volumes
check "then_errors_are_empty" test "$(column error "$folder/nothing/sweep.csv" | tr -d '\n')" = ""
sed 's/^light.*/light directional direction 0.3 1 0.1/' "$scene" >"$folder/dark.scene"
check "nothing_may_be_lit" status 0 sweep "$folder/dark.scene" -o "$folder/dark" --depths 16 --maps 24 --budgets none --size 12x10 --methods constant,constant-best,silhouette/dv,volumes
check "then_no_shadow_is_false" test "$(column false_shadow "$folder/dark/sweep.csv" | sort -u)" = 0

sweep_of_odd_scenes="--depths 16 --maps none --budgets 9K --methods constant,silhouette,volumes --size 12x10"
# shellcheck disable=SC2086
check "scenes_of_all_kinds_share_a_page" status 0 sweep "$folder/point.scene" "$folder/nothing.scene" "$scene" -o "$folder/mixed" $sweep_of_odd_scenes
check "means_are_over_scenes_with_a_surface" grep -q "wrong in the mean" "$folder/mixed/index.html"
# Of a name 47 bytes are kept, here 23 letters of two and half of the next.
letters=$(printf '\303\244%.0s' 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16 17 18 19 20 21 22 23)
cp "$scene" "$folder/$letters$letters.scene"
odd=$(printf 'it\377s <b>,"c')
cp "$scene" "$folder/$odd.scene"
# shellcheck disable=SC2086
check "names_may_be_odd" status 0 sweep "$folder/$letters$letters.scene" "$folder/$odd.scene" -o "$folder/odd" $sweep_of_odd_scenes
check "half_a_letter_becomes_an_underscore" test -e "$folder/odd/${letters}_.truth.pgm"
check "what_is_no_letter_too" test -e "$folder/odd/it_s <b>,\"c.truth.pgm"
check "json_holds_none" grep -q 'it.ufffds <b>,."c.scene"' "$folder/odd/sweep.json"
check "the_command_can_be_typed_again" grep -q "c.scene&#39; -o " "$folder/odd/index.html"

# ---- refusals -----------------------------------------------------------------------------------------------------------

new=$folder/new
check "no_folder_is_refused" refuses "no folder" sweep "$scene"
check "a_scene_that_is_not_there" refuses "missing.scene" sweep "$folder/missing.scene" -o "$new"
check "a_scene_given_twice" refuses "given twice" sweep "$scene" "$folder/other/../fence.scene" -o "$new"
check "a_folder_without_a_parent" refuses "cannot be made" sweep "$scene" -o "$folder/no/new" --depths 16
check "a_file_instead_of_a_folder" refuses "expected" sweep "$scene" -o "$scene" --depths 16
check "an_unknown_chain" refuses "unknown chain 'mixd'" sweep "$scene" -o "$new" --methods mixed,mixd
check "a_chain_given_twice" refuses "mixed twice" sweep "$scene" -o "$new" --methods mixed,mixed
check "a_size_given_twice" refuses "64 twice" sweep "$scene" -o "$new" --maps 64,64
check "a_size_out_of_range" refuses "'4097'" sweep "$scene" -o "$new" --maps 64,4097
check "no_size_at_all" refuses "leave no map" sweep "$scene" -o "$new" --maps none --budgets none
check "bytes_in_another_unit" refuses "'32G'" sweep "$scene" -o "$new" --budgets 32G
check "an_unknown_depth" refuses "--depths 24" sweep "$scene" -o "$new" --depths 24
check "a_budget_that_no_map_fits" refuses "the smallest, 2 x 2, takes $((4 * (2 + padding)))" sweep "$scene" -o "$new" --depths 16 --budgets 7
mkdir -p "$folder/taken/index.html" "$folder/foreign"
check "a_folder_in_the_pages_place" refuses "is a folder" sweep "$scene" -o "$folder/taken" --depths 16
check "before_anything_is_measured" test ! -e "$folder/taken/sweep.csv"
printf 'notes' >"$folder/foreign/sweep.csv"
check "what_is_no_start_of_a_journal" refuses "other columns" sweep "$scene" -o "$folder/foreign" --depths 16
check "stays" grep -q notes "$folder/foreign/sweep.csv"
# shellcheck disable=SC2086
check "a_journal_of_another_size_of_image" refuses "another content" sweep "$scene" "$table" -o "$folder/cut" --depths 16 --methods volumes --size 8x7
sed 's/^light.*/light directional direction 0.3 -1 0.1/' "$scene" >"$folder/other/fence.scene"
check "a_journal_of_a_scene_that_has_changed" refuses "another content" sweep "$folder/other/fence.scene" -o "$folder/a" --depths 16 --maps 32,120 --budgets 9K,32K --size 48x40
check "a_journal_of_other_rows" refuses "no row of this sweep" sweep "$scene" -o "$folder/a" --depths 16 --maps 32 --budgets none --size 48x40
check "a_journal_of_other_columns" sh -c "cp '$csv' '$folder/kept' && sed -i '1s/bias/bais/' '$csv'"
check "is_refused" refuses "other columns" sweep "$scene" -o "$folder/a" --depths 16 --maps 32,120 --budgets 9K,32K --size 48x40
check "and_left_as_it_is" grep -q bais "$csv"

check "nothing_is_left_behind_by_any" nothing_left
finish
