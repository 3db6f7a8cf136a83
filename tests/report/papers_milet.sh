#!/bin/sh
# Make the pictures of Milet et al. 2015 in docs/papers.md, and the one of docs/parameterisations.md, and print their
# figures.
#
#     tests/report/papers_milet.sh BUILD -o FOLDER
#
# As papers_wang.sh. SCENES (../shared/scenes): a folder with castle_sun, fence_truck_grazing and dragon_spotlight; those
# that are not there are left out. Instructions are counted where valgrind is (shots.sh).
set -eu

here=$(dirname "$0")
# shellcheck source=SCRIPTDIR/shots.sh
. "$here/shots.sh"
# shellcheck source=SCRIPTDIR/methods.sh
. "$here/methods.sh"

start_pictures "$@"
build_program warps "$work/warps"
others=${SCENES:-../shared/scenes}
ours="castle colonnade room" # for the paper's observatory, Sponza and conference room
twelve="lshape torus2 factory table pipes pins crowd castle room sheets fence colonnade"
surface=sdm:2+v3
limited=dualct:2+v3

for scene in $twelve; do "$build/gnomon" procedural "$scene" -o "$work"; done
# A part of the castle that is a twelfth of its picture: what the camera sees is a small part of the light's plane.
sed 's/^camera.*/camera perspective eye 9.5 8.5 12.5 target 3.5 0 1.5 up 0 1 0 fovy 12 near 0.1 far 500/' \
    "$work/castle.scene" >"$work/detail.scene"
found=
for scene in castle_sun fence_truck_grazing dragon_spotlight; do
    [ -f "$others/$scene.scene" ] || continue
    sed "s|^mesh |mesh $(cd "$others" && pwd)/|" "$others/$scene.scene" >"$work/$scene.scene"
    found="$found $scene"
done
"$here/truth.sh" "$build/gnomon" "$work"/*.scene -o "$work"

# look NAME SCENE METHOD OPTION...: the pictures of warps.c in the work folder's NAME, and what it counted.
look() {
    name=$1
    scene=$2
    how=$3
    shift 3
    mkdir -p "$work/$name"
    echo "$scene, $how $*:"
    # shellcheck disable=SC2046 # words
    "$work/warps" "$work/$scene.scene" $(method_options "$how") "$@" -o "$work/$name"
}

# total SCENE METHOD OPTION...: false shadow + false light, per cent of the surface.
total() {
    scene=$1
    how=$2
    shift 2
    # shellcheck disable=SC2046 # words
    "$build/gnomon" render "$work/$scene.scene" $(method_options "$how") "$@" --mask "$work/total.pgm"
    "$build/gnomon" compare "$work/total.pgm" "$work/$scene.pgm" --json "$work/total.json" >/dev/null || [ $? -eq 1 ]
    awk -F '[:,]' '!done && /"error_percent"/ { print $2 + 0; done = 1 }' "$work/total.json"
}

# means SIZE SCENES METHOD...: a row of Markdown for each method: each scene, and the mean.
means() {
    size=$1
    scenes=$2
    shift 2
    for how; do
        for scene in $scenes; do total "$scene" "$how" --map "$size"; done |
            awk -v name="$how, $size" '{ line = line sprintf(" %.2f |", $1); sum += $1 }
                END { printf "| %s |%s %.3f |\n", name, line, sum / NR }'
    done
}

# ---- docs/parameterisations.md -------------------------------------------------------------------------------------

echo "== grids, map 64"
for warp in dv+rtwc msf+rtwc dv+notw; do look grid-$warp castle $warp/$surface --map 64; done
part="@340x330+30+36"
join parameterisations-grids 3 grid-dv+rtwc/plane$part grid-msf+rtwc/plane$part grid-dv+notw/plane$part

# ---- docs/papers.md ------------------------------------------------------------------------------------------------

# shellcheck disable=SC2046,SC2086 # words
{
    echo "== figures 2, 4, 5 and 6: map 256"
    for scene in $ours; do
        for warp in none dv+rtw dv+rtwc dv+notw dv+notw:4; do
            look "$scene-$warp" "$scene" "$warp/$surface" --map 256
        done
        look "$scene-rough" "$scene" "dv+notw:0.015625/$surface" --map 256
    done
    look few-rtw castle "dv+rtwc/$surface" --map 64
    cp "$work/few-rtw/curves.svg" "$folder/papers-warp-curves.svg"
    look rows castle "dv+notw/$surface" --map 24
    cp "$work/rows/rows.svg" "$folder/papers-warp-rows.svg"
    join papers-warp-grid 1 few-rtw/plane@320x285+25+65
    look few-notw castle "dv+notw/$surface" --map 64
    join papers-warp-unused 2 few-rtw/unused few-notw/unused
    join papers-warp-functions 4 castle-dv+notw/before castle-rough/functions castle-dv+notw/functions castle-dv+notw/rows \
        room-dv+notw/before room-rough/functions room-dv+notw/functions room-dv+notw/rows
    join papers-warp-samples 3 castle-dv+notw/before castle-dv+rtwc/after castle-dv+notw/after \
        colonnade-dv+notw/before colonnade-dv+rtwc/after colonnade-dv+notw/after
    join papers-warp-maps 4 castle-none/map castle-dv+rtw/map castle-dv+notw/map castle-dv+notw/flat

    echo "== teaser and figure 7: map 256"
    for scene in $ours; do
        for warp in none dv msf dv+rtw dv+rtwc msf+rtwc dv+notw; do
            shot "$scene-$warp" "$scene" $(method_options "$warp/$surface") --map 256
        done
        shot "$scene-volumes" "$scene" --method volumes
    done
    part="@200x150+60+325*2"
    join papers-warp-teaser 3 castle-volumes$part castle-none.difference$part castle-dv+rtw.difference$part \
        castle-dv+notw.difference$part castle-dv.difference$part castle-msf.difference$part
    castle="@260x195+60+285"
    colonnade="@260x195+40+250"
    room="@260x195+200+260"
    join papers-warp-scenes 3 colonnade-none.difference$colonnade colonnade-dv+rtw.difference$colonnade \
        colonnade-dv+notw.difference$colonnade castle-none.difference$castle castle-dv+rtw.difference$castle \
        castle-dv+notw.difference$castle room-none.difference$room room-dv+rtw.difference$room room-dv+notw.difference$room

    echo "== order of the methods: | method, map | $twelve | mean |"
    for size in 64 256 1024; do
        means $size "$twelve" $surface dv/$surface msf/$surface dv+rtw/$surface dv+rtwc/$surface msf+rtwc/$surface \
            rtwc/$surface notw/$surface dv+notw/$surface msf+notw/$surface dv+notw:4/$surface
    done
    echo "== the same, a small part of the castle, and other scenes: | method, map | detail$found | mean |"
    for size in 256 1024; do
        means $size "detail$found" $surface dv/$surface msf/$surface dv+rtw/$surface dv+rtwc/$surface dv+notw/$surface \
            msf+notw/$surface
    done

    echo "== a wider window, map 256: | method, map | $twelve | mean |"
    means 256 "$twelve" dv+notw:0.015625/$surface dv+notw:0.25/$surface dv+notw:2/$surface dv+notw:4/$surface \
        dv+notw:8/$surface dv+notw:16/$surface dv+notw:32/$surface dv+rtwc:0.015625/$surface
    for scene in $twelve; do
        for how in dv+notw:32/$surface dv+rtwc:0.015625/$surface; do
            "$build/gnomon" render "$work/$scene.scene" $(method_options "$how") --map 256 --hash \
                -o "$work/x.png" --mask "$work/x.pgm" | grep -E '^(warp|layers|map) ' >"$work/hash-${how%%:*}"
        done
        cmp -s "$work/hash-dv+notw" "$work/hash-dv+rtwc" && echo "$scene: one map" || echo "$scene: another map"
    done

    echo "== vertices alone, map 256: | method, map | $twelve | mean |"
    means 256 "$twelve" dv+rtwc/$limited dv+notw/$limited dv+rtwc-vertices/$limited dv+notw-vertices/$limited \
        dv+notw-vertices:4/$limited dv+notw-vertices:16/$limited
    for warp in dv+notw dv+rtwc-vertices dv+notw-vertices; do
        shot "torn-$warp" room $(method_options "$warp/$surface") --map 256
    done
    part="@400x300+120+150"
    join papers-warp-vertices 3 torn-dv+notw$part torn-dv+rtwc-vertices$part torn-dv+notw-vertices$part
}

# ---- instructions --------------------------------------------------------------------------------------------------

start_counting || exit 0
echo "== tables 1, 2 and 3: map 512, 1024 x 1024 pixels, million instructions: | scene, method | seen | again | fit | warp | map \
| test | shares of the last four, % ||||  their sum | all |"
for scene in $ours; do
    for warp in none dv msf dv+rtw dv+rtwc dv+notw; do
        case $warp in
        none) count="fitted=0 rounds=0" ;;
        *notw) count="fitted=1 rounds=3" ;;
        *rtw*) count="fitted=1 rounds=2" ;;
        *) count="fitted=1 rounds=1" ;;
        esac
        # shellcheck disable=SC2046,SC2086 # words
        instructions "$scene, $warp" $count -- "$scene.scene" $(method_options "$warp/constt:2") --map 512 --size 1024x1024
    done
    instructions "$scene, volumes" fitted=0 rounds=0 -- "$scene.scene" --method volumes --size 1024x1024
done
