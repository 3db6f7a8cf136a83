#!/bin/sh
# gnomon truth on the command line: outputs, counts, workers, refusals, point lights; and that the renderer agrees.
# GNOMON: the simulator.
set -u
. "$(dirname "$0")/../simulator.sh"

# says TEXT FILE
says() {
    grep -qF -- "$1" "$2" || { cat "$2"; return 1; }
}

"$gnomon" procedural lshape -o "$folder" >/dev/null
scene=$folder/lshape.scene
cast() {
    status 0 truth "$scene" --size 96x64 "$@" >"$folder/printed" 2>"$folder/err"
}

check "all_outputs_are_written" cast --mask "$folder/a.pgm" --near "$folder/near.pgm" --ties "$folder/a.txt" --json "$folder/a.json"
check "nothing_is_said_on_standard_error" test ! -s "$folder/err"
check "two_lines_of_counts_are_printed" sh -c "[ \$(wc -l <'$folder/printed') = 2 ] &&
    grep -qE '^surface [1-9][0-9]* pixels, lit [1-9][0-9]* \\([0-9.]+ %\\), shadowed [1-9][0-9]* \\([0-9.]+ %\\)\$' '$folder/printed' &&
    grep -qE '^ties [0-9]+ \\([0-9.]+ %\\), near [0-9]+ \\([0-9.]+ %\\)\$' '$folder/printed'"
check "the_mask_has_its_size" sh -c "[ \"\$(head -n 2 '$folder/a.pgm' | tail -n 1)\" = '96 64' ]"
check "the_mask_is_0_254_and_255" sh -c "[ \"\$(tail -c 6144 '$folder/a.pgm' | od -An -v -tu1 -w1 | sort -un | tr -d ' \\n')\" = 0254255 ]"
check "near_is_0_and_255" sh -c "tail -c 6144 '$folder/near.pgm' | od -An -v -tu1 -w1 | sort -un | tr -d ' \\n' | grep -qxE '0(255)?'"
for name in surface_pixels lit shadowed ties near exact_decisions seconds eye-edge shadow-within; do
    check "json_names_$name" says "\"$name\":" "$folder/a.json"
done
check "ties_are_a_picture_too" cast --ties "$folder/ties.pgm"
check "the_picture_of_ties_is_there" test -s "$folder/ties.pgm"
check "without_near_none_is_counted" sh -c "! grep -q near '$folder/printed'"
check "three_workers_run" cast --workers 3 --mask "$folder/b.pgm" --near "$folder/near3.pgm"
check "their_mask_is_the_same" cmp "$folder/a.pgm" "$folder/b.pgm"
check "their_near_is_the_same" cmp "$folder/near.pgm" "$folder/near3.pgm"
check "a_packed_scene_is_packed" status 0 pack "$scene" -o "$folder/packed.gno"
check "its_truth_is_cast" status 0 truth "$folder/packed.gno" --size 96x64 --mask "$folder/c.pgm"
check "and_is_the_same" cmp "$folder/a.pgm" "$folder/c.pgm"
check "the_renderer_makes_a_mask" status 0 render "$scene" --size 96x64 --map 2048 --mask "$folder/render.pgm"
check "it_is_the_truth_but_for_1_per_cent" status 0 compare "$folder/render.pgm" "$folder/a.pgm" --max-error 1

# A ray exactly through an edge: an orthographic camera above the border of a square.
cat >"$folder/square.obj" <<'END'
v -1 0 -1
v -1 0 1
v 1 0 1
v 1 0 -1
f 1 2 3 4
END
cat >"$folder/edge.scene" <<'END'
image 1 1
map 16
ambient 0.2
camera orthographic eye 1 4 0.5 target 1 0 0.5 up 0 0 -1 height 1 near 1 far 9
light directional direction 0 -1 0
mesh square.obj surface open color 1 1 1
END
check "an_edge_is_cast" status 0 truth "$folder/edge.scene" --ties "$folder/edge.txt"
check "its_tie_is_listed" sh -c "[ \"\$(cat '$folder/edge.txt')\" = '0 0 eye-edge' ]"

sed 's/^light.*/light point position 0 2 0 near 0.5 far 3/; s/^image.*/image 8 8/; s/height 1/height 3/' "$folder/edge.scene" >"$folder/point.scene"
check "a_point_light_is_cast" status 0 truth "$folder/point.scene" --mask "$folder/point.pgm"
check "a_point_light_is_packed" status 0 pack "$folder/point.scene" -o "$folder/point.gno"
check "and_cast_as_before" status 0 truth "$folder/point.gno" --mask "$folder/packed.pgm"
check "with_the_same_answers" cmp "$folder/point.pgm" "$folder/packed.pgm"

check "no_scene_is_refused" refuses "0 scenes" truth
check "a_missing_scene_is_refused" refuses "cannot be" truth "$folder/none.scene" --mask "$folder/new.pgm"
check "65_workers_are_refused" refuses "--workers" truth "$scene" --workers 65 --mask "$folder/new.pgm"
check "a_size_of_0_is_refused" refuses "--size" truth "$scene" --size 0x5 --mask "$folder/new.pgm"
check "an_unknown_kind_of_picture_is_refused" refuses "new.xyz" truth "$scene" --mask "$folder/new.xyz"
check "one_file_for_two_outputs_is_refused" refuses "two outputs at once" truth "$scene" --mask "$folder/new.pgm" --near "$folder/new.pgm"
check "also_where_it_is_spelled_in_another_way" refuses "two outputs at once" truth "$scene" --ties "$folder/new.pgm" \
    --mask "$folder/../${folder##*/}/new.pgm"
check "a_scene_is_not_overwritten" refuses "would be overwritten" truth "$scene" --json "$scene"
check "and_is_as_it_was" grep -q camera "$scene"
check "a_device_may_be_named_twice" status 0 truth "$scene" --size 8x6 --ties "$folder/two.txt" --json /dev/null
check "a_full_disk_is_refused" status 2 truth "$scene" --size 8x6 --mask "$folder/stays.pgm" --json /dev/full
check "which_leaves_what_was_written_before" test -s "$folder/stays.pgm"
check "as_the_help_says" sh -c "'$gnomon' truth --help | grep -q 'no file is left half-written'"
check "a_folder_that_is_not_there_is_refused" refuses "nowhere" truth "$scene" --mask "$folder/new.pgm" --ties "$folder/nowhere/new.txt"
check "nothing_is_left_behind_by_any" nothing_left
finish
