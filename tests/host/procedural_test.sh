#!/bin/sh
# The built-in scenes are those of gen.py byte for byte (POSIX cksum of its output under CPython 3.11 stands below), their
# closed meshes are closed, their views keep the meshes, and a failure leaves nothing half written.
# GNOMON: the simulator, build/gnomon unless set.
. tests/tap.sh

GNOMON=${GNOMON:-build/gnomon}
folder=$(mktemp -d "${TMPDIR:-/tmp}/gnomon-procedural-XXXXXX") || exit 1
trap 'rm -rf "$folder"' EXIT
trap 'exit 1' HUP INT TERM

checksums() {
    cat <<'END'
3571506137 292 torus2.scene
628710062 52 torus2_plane.obj
2687695456 156089 torus2_tori.obj
1274799553 294 lshape.scene
1417670456 316 lshape_L.obj
2844744414 180 lshape_plane.obj
886696892 249 factory.scene
2535363560 463906 factory_all.obj
3535283552 320 table.scene
3934752109 180 table_floor.obj
1279022634 1234 table_table.obj
3212570891 287 pipes.scene
3747368150 180 pipes_floor.obj
4108257747 613468 pipes_pipes.obj
4194182171 323 pins.scene
3902191836 180 pins_lane.obj
1779611701 175768 pins_pins.obj
3837927416 294 crowd.scene
4223067250 639951 crowd_people.obj
206370788 402 crowd_set.obj
4059391282 300 castle.scene
3625022843 33498 castle_castle.obj
987945769 196 castle_ground.obj
1820390074 330 room.scene
391638097 7046 room_shell.obj
3963768979 70270 room_things.obj
38799373 398 sheets.scene
90247670 18027 sheets_curtain.obj
2991449407 539 sheets_floor.obj
2009495540 120354 sheets_leaves.obj
1607317411 958 sheets_stem.obj
3720111577 307 fence.scene
3679298685 13608 fence_fence.obj
72804656 180 fence_ground.obj
1113389307 249 colonnade.scene
191343632 225720 colonnade_all.obj
END
}

# same EXPECTED GOT: two texts are equal
same() {
    [ "$1" = "$2" ] && return
    printf 'expected:\n%s\ngot:\n%s\n' "$1" "$2"
    return 1
}

# ---- the twelve ----------------------------------------------------------------------------------------------------

has_checksum() {
    same "$1 $2 $3" "$(cd "$folder/all" && cksum "$3")"
}

nothing_else_is_there() {
    same "$(checksums | cut -d ' ' -f 3 | LC_ALL=C sort)" "$(ls -A "$folder/all" | LC_ALL=C sort)"
}

# A closed mesh uses every edge equally often in both directions once equal positions are one vertex, and its volume is
# positive when it is counter-clockwise from outside.
is_closed_and_faces_outwards() {
    awk '
    function edge(a, b) { if (a < b) balance[a, b]++; else if (b < a) balance[b, a]-- }
    $1 == "v" {
        for (i = 2; i <= 4; i++)
            if ($i == 0) $i = "0"               # -0 too
        key = $2 " " $3 " " $4
        if (!(key in merged)) merged[key] = ++positions
        vertex[++vertices] = merged[key]
        x[vertices] = $2; y[vertices] = $3; z[vertices] = $4
    }
    $1 == "f" {
        triangles++
        a = $2; b = $3; c = $4
        edge(vertex[a], vertex[b]); edge(vertex[b], vertex[c]); edge(vertex[c], vertex[a])
        volume += x[a] * (y[b] * z[c] - z[b] * y[c]) - y[a] * (x[b] * z[c] - z[b] * x[c]) \
                + z[a] * (x[b] * y[c] - y[b] * x[c])
    }
    END {
        for (e in balance)
            if (balance[e] != 0) open++
        printf "%d triangles, expected some; %d open edges, expected 0; volume %g, expected > 0\n", triangles, open,
               volume / 6
        exit !(triangles > 0 && open == 0 && volume > 0)
    }' "$1"
}

closed_meshes() {
    awk '$1 == "mesh" && $4 == "closed" { print $2 }' "$folder"/all/*.scene
}

# The check itself: without its last triangle a box is open, with all turned round it faces inwards.
open_and_inverted_meshes_are_noticed() {
    sed '$d' "$folder/all/lshape_plane.obj" >"$folder/open.obj"
    awk '$1 == "f" { print $1, $2, $4, $3; next } { print }' "$folder/all/lshape_plane.obj" >"$folder/inverted.obj"
    exits 1 is_closed_and_faces_outwards "$folder/open.obj" &&
        exits 1 is_closed_and_faces_outwards "$folder/inverted.obj"
}

one_alone_is_the_same() {
    "$GNOMON" procedural room -o "$folder/one" &&
        same "$(cd "$folder/all" && cksum room*)" "$(cd "$folder/one" && cksum -- *)"
}

check "all twelve scenes are written" "$GNOMON" procedural all -o "$folder/all"
while read -r crc size file; do
    check "$file has the bytes of gen.py" has_checksum "$crc" "$size" "$file"
done <<END
$(checksums)
END
check "nothing else is in the folder" nothing_else_is_there
for mesh in $(closed_meshes); do
    check "$mesh is closed and faces outwards" is_closed_and_faces_outwards "$folder/all/$mesh"
done
check "nineteen meshes are marked closed" same 19 "$(closed_meshes | wc -l | tr -d ' ')"
check "a mesh that is open or inside out would be noticed" open_and_inverted_meshes_are_noticed
check "a scene written alone is the same" one_alone_is_the_same

# ---- failures ------------------------------------------------------------------------------------------------------

an_unknown_name_writes_nothing() {
    exits 2 "$GNOMON" procedural teapot -o "$folder/unknown" && same "" "$(ls -A "$folder/unknown" 2>/dev/null)"
}

# Files end at 50 KB here: pipes_pipes.obj cannot be written.
limited() (
    trap '' XFSZ
    ulimit -f 100
    "$GNOMON" procedural pipes -o "$1"
)

a_full_disk_leaves_no_half_written_file() {
    exits 2 limited "$folder/full" && same pipes_floor.obj "$(ls -A "$folder/full")"
}

a_full_disk_leaves_older_files_as_they_were() {
    before=$(cd "$folder/all" && cksum pipes*)
    exits 2 limited "$folder/all" && same "$before" "$(cd "$folder/all" && cksum pipes*)" && nothing_else_is_there
}

check "an unknown name is refused and writes nothing" an_unknown_name_writes_nothing
check "a full disk leaves no half-written file" a_full_disk_leaves_no_half_written_file
check "a full disk leaves older files as they were" a_full_disk_leaves_older_files_as_they_were

# ---- views ---------------------------------------------------------------------------------------------------------

write_views() {
    "$GNOMON" procedural "$1" --view 1 -o "$folder/views" && "$GNOMON" procedural "$1" --view 2 -o "$folder/views" &&
        "$GNOMON" procedural "$1" --view 1 -o "$folder/again"
}

only_camera_and_light_change() {
    grep -v '^[#cl]' "$folder/all/$1.scene" >"$folder/plain"
    for view in 1 2; do
        grep -v '^[#cl]' "$folder/views/$1_view$view.scene" | diff "$folder/plain" - || return
    done
    same "$(cd "$folder/all" && cksum "$1"_*.obj)" "$(cd "$folder/views" && cksum "$1"_*.obj)"
}

seeds_decide() {
    cmp "$folder/views/$1_view1.scene" "$folder/again/$1_view1.scene" || return
    for line in camera light; do
        for view in "$folder/all/$1.scene" "$folder/views/$1_view1.scene" "$folder/views/$1_view2.scene"; do
            grep "^$line" "$view"
        done
    done | LC_ALL=C sort -u >"$folder/lines"
    same 6 "$(wc -l <"$folder/lines" | tr -d ' ')"
}

# Elevations as the header promises them, give or take the rounding of positions.
camera_and_light_stand_where_promised() {
    awk '
    function elevation(x, y, z) { return atan2(y, sqrt(x * x + z * z)) * 45 / atan2(1, 1) }
    function expect(what, degrees, low, high) {
        printf "%s at %.1f degrees, expected %d to %d\n", what, degrees, low, high
        bad += degrees < low - 0.5 || degrees > high + 0.5
        seen++
    }
    $1 == "camera" { expect("camera", elevation($4 - $8, $5 - $9, $6 - $10), 2, 50) }
    $2 == "spot" { expect("light", elevation($4 - $8, $5 - $9, $6 - $10), 20, 70) }
    $2 == "directional" { expect("light", elevation(-$4, -$5, -$6), 20, 70) }
    END { exit bad > 0 || seen != 2 }' "$1"
}

for scene in lshape table castle; do
    check "views of $scene are written" write_views $scene
    check "views of $scene change camera and light alone" only_camera_and_light_change $scene
    check "views of $scene are decided by the seed" seeds_decide $scene
    for view in 1 2; do
        check "camera and light of view $view of $scene stand where promised" \
            camera_and_light_stand_where_promised "$folder/views/${scene}_view$view.scene"
    done
done
finish
