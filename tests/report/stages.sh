#!/bin/sh
# Make the pictures of docs/shadow-test.md and print their figures.
#
#     tests/report/stages.sh BUILD -o FOLDER
#
# BUILD is the folder of `make BUILD=... all`, with OpenImageIO. Call it from the top of the project: it builds
# tests/report/stages.c, cells.c and mosaic.c.
set -eu

here=$(dirname "$0")
# shellcheck source=SCRIPTDIR/shots.sh
. "$here/shots.sh"

start_pictures "$@"
build_program cells "$work/cells"
mkdir -p "$work/second" "$work/mixed" "$work/bilinear" "$work/sun"
for scene in room torus2 table crowd sheets pins castle; do "$build/gnomon" procedural $scene -o "$work"; done
# The foot of a chair in the room, and the shadow of the castle's wall, from near by.
near() {
    sed "s/^image.*/image 400 300/; s/^camera.*/camera perspective $3 up 0 1 0 near .1 far 500/" "$work/$1.scene" \
        >"$work/$2.scene"
}
near room chair "eye -3.3 2.2 4.6 target -1.49 0 2.326 fovy 12"
near castle wall "eye 9.5 8.5 12.5 target 6.22 0 1.573 fovy 2"
"$here/truth.sh" "$build/gnomon" "$work"/*.scene -o "$work"

second="--method second-depth"
first="--virtual-surface constant --bias 0r"
virtual="--receiver virtual"

echo "== points compared, map 128"
# shellcheck disable=SC2086 # words
{
    shot first room $first --map 128
    shot second room $second --map 128
    shot cured room $second $virtual --map 128
    shot mixed room --method mixed $virtual --map 128
    join shadow-test-acne 2 first@300x225+300+200 second@300x225+300+200

    echo "== stages, map 128"
    echo "room, second depth"
    "$work/stages" "$work/room.scene" $second $virtual --map 128 -o "$work/second"
    echo "room, mixed"
    "$work/stages" "$work/room.scene" --method mixed $virtual --map 128 -o "$work/mixed"
    echo "room, mixed, bilinear"
    "$work/stages" "$work/room.scene" --method mixed $virtual --reconstruct bilinear --map 128 -o "$work/bilinear"
    echo "torus2, mixed"
    "$work/stages" "$work/torus2.scene" --method mixed $virtual --map 128 -o "$work/sun"
    join shadow-test-texels 2 mixed/texels@300x200+0+210 sun/texels@300x200+180+90
    join shadow-test-votes 2 second/votes@400x300+0+160 mixed/votes@400x300+0+160
    join shadow-test-samples 2 second/samples@400x300+0+160 mixed/samples@400x300+0+160

    echo "== fractions, map 128"
    for how in bilinear jitter4x4 pcf3 pcf5 pcf7; do
        shot $how room --method mixed $virtual --reconstruct $how --map 128
    done
    part="@100x75+285+395*4"
    join shadow-test-fractions 2 mixed$part bilinear$part jitter4x4$part pcf5$part

    shot nearest room --method mixed $virtual --map 256
    join shadow-test-result 2 mixed@400x300+200+180 mixed.difference@400x300+200+180

    echo "== silhouettes"
    silhouette="--method silhouette"
    for scene in room chair; do
        mkdir -p "$work/$scene"
        echo "$scene: $("$work/cells" "$work/$scene.scene" "$work/$scene.pgm" $silhouette --map 128 -o "$work/$scene")"
    done
    join shadow-test-cells 2 chair/before chair/after
    for how in nearest silhouette silhouette-smooth; do
        shot sharp-$how room --method mixed $virtual --reconstruct $how --map 128
    done
    part="@100x75+285+395*3"
    join shadow-test-smooth 3 sharp-nearest$part sharp-silhouette$part sharp-silhouette-smooth$part
    part="@400x300+200+180"
    join shadow-test-gain 2 sharp-nearest.difference$part sharp-silhouette.difference$part
    "$build/gnomon" render "$work/room.scene" $silhouette --map 128 --silhouettes "$work/map.png"
    join shadow-test-silhouettes 2 map@400x300+1240+1260 chair/scene
    shot wall wall $silhouette --map 512
    mkdir -p "$work/wall"
    echo "wall: $("$work/cells" "$work/wall.scene" "$work/wall.pgm" $silhouette --map 512 -o "$work/wall")"
    join shadow-test-two-edges 2 wall/truth wall/after

    echo "== memory, room, bytes: map, silhouettes, light pass, camera pass, all"
    for map in 64 128 256 512; do
        for how in "--method mixed $virtual" "--method mixed $virtual --map-rows 16" "$silhouette" \
            "$silhouette --map-rows 16"; do
            "$build/gnomon" render "$work/room.scene" $how --map $map --size 320x240 --stats "$work/stats.json"
            awk -F '[:,]' -v name="$map $how" '{ gsub(/[" ]/, "", $1) } !($1 in n) { n[$1] = $2 + 0 }
                END { print name ": " n["map"], n["silhouettes"], n["light_pass"], n["camera_pass"], n["all"] }' \
                "$work/stats.json"
        done
    done

    echo "== a 5 x 5 filter and its bias, map 256"
    for scene in torus2 table crowd; do
        for slope in 1 3 5; do
            for how in nearest pcf5; do
                shot slope$slope-$how $scene --virtual-surface constant --receiver plane-bias --slope $slope \
                    --bias 0.0005r --reconstruct $how --map 256
            done
        done
        for how in nearest pcf5; do
            shot adaptive-$how $scene --method adaptive --reconstruct $how --map 256
            shot mixed-$how $scene --method mixed $virtual --reconstruct $how --map 256
        done
        [ $scene != torus2 ] || join shadow-test-kernel 3 slope1-pcf5@200x230+240+150 slope5-pcf5@200x230+240+150 \
            mixed-pcf5@200x230+240+150
    done

    echo "== rivals on one scene, map 256"
    for scene in crowd sheets; do
        shot rival $scene $second $virtual --map 256
        shot rival $scene --method mixed $virtual --map 256
        shot rival $scene --method adaptive --map 256
        shot rival $scene --method slope --map 256
        shot rival $scene --virtual-surface constant --receiver plane-bias --slope 1 --bias 0.0005r --map 256
        shot rival $scene --method mixed --receiver virtual-always --map 256
    done

    echo "== curved open meshes, map 256"
    for bias in 0t 0.25t 0.5t 1t 2t 4t; do shot curved sheets $second $virtual --bias $bias --map 256; done

    echo "== statistics: per cent of the pixels tested; texels read a pixel"
    for scene in room torus2 pins; do
        for map in 64 128 256 512 1024; do
            "$build/gnomon" render "$work/$scene.scene" --map $map --stats "$work/stats.json"
            awk -F '[:,]' -v name="$scene $map" '/"pixels|"texels/ { gsub(/[" ]/, "", $1); count[$1] = $2 }
                END { tested = count["pixels_tested"] / 100
                      printf "%s: outside %.1f, agreed %.1f, virtual %.1f; texels read %.2f\n", name,
                          count["pixels_outside"] / tested, count["pixels_agreed"] / tested,
                          count["pixels_virtual"] / tested, count["texels_read"] / tested / 100 }' "$work/stats.json"
        done
    done
}
