#!/bin/sh
# Make the pictures of Weiskopf & Ertl 2003 in docs/papers.md and print their figures.
#
#     tests/report/papers_weiskopf.sh BUILD -o FOLDER
#
# As papers_wang.sh. ROUNDS (3) times RUNS (9) frames are measured of each cell of the table of times.
set -eu

here=$(dirname "$0")
# shellcheck source=SCRIPTDIR/shots.sh
. "$here/shots.sh"

start_pictures "$@"
build_program slices "$work/slices"

# ---- scenes --------------------------------------------------------------------------------------------------------

twelve="lshape torus2 factory table pipes pins crowd castle room sheets fence colonnade"
for scene in $twelve; do "$build/gnomon" procedural "$scene" -o "$work"; done

# A solid of eight sides over a floor, under a sun overhead: figure 1. Its profile in x and y, extruded along z.
awk 'BEGIN {
    n = split("-1.5 .9 -1 1.7 -.3 1.2 .4 1.8 1.2 1.5 1.6 .8 .7 .45 -.7 .6", at, " ") / 2
    for (z = -1; z <= 1; z += 2)
        for (i = 0; i < n; i++) print "v", at[2 * i + 1], at[2 * i + 2], z
    for (i = 1; i <= n; i++) { k = i % n + 1; print "f", i, k, k + n, i + n }
    for (i = 2; i < n; i++) { print "f 1", i + 1, i; print "f", n + 1, n + i, n + i + 1 }
}' >"$work/solid.obj"
awk 'BEGIN { print "v -2 0 -2\nv 2 0 -2\nv 2 0 2\nv -2 0 2\nv -2 -.3 -2\nv 2 -.3 -2\nv 2 -.3 2\nv -2 -.3 2"
    print "f 1 4 3 2\nf 5 6 7 8\nf 4 8 7 3\nf 1 2 6 5\nf 1 5 8 4\nf 2 3 7 6" }' >"$work/ground.obj"
cat >"$work/solid.scene" <<'END'
image 640 480
map 48
camera perspective eye -1 4.5 4.5 target 0 .6 0 up 0 1 0 fovy 46 near .1 far 500
light directional direction 0 -1 0
ambient .2
mesh ground.obj surface closed color .6 .6 .6
mesh solid.obj surface closed color .8 .6 .4
END
"$here/truth.sh" "$build/gnomon" "$work"/*.scene -o "$work"

# The hard cases that the figures are, as the test writes them.
cases="unshadowing silhouette near_receiver background steep_receiver"
${MAKE:-make} -s BUILD="$build" "$build/host-16/tests/hard/hard" >/dev/null
# shellcheck disable=SC2086 # words
"$build/host-16/tests/hard/hard" --write "$work" $cases
for scene in $cases; do "$build/gnomon" truth "$work/$scene.gno" --mask "$work/$scene.pgm" >/dev/null; done

second="--method second-depth"
virtual="--receiver virtual"
midpoint="--method midpoint --layers two"

# mean OPTION...: false shadow + false light, means over the twelve scenes.
mean() {
    for scene in $twelve; do shot mean "$scene" "$@"; done |
        awk '{ for (i = 3; i <= NF; i++) if ($i == "+") { shadow += $(i - 1); light += $(i + 1) } }
            END { printf "%.2f + %.2f = %.2f\n", shadow / NR, light / NR, (shadow + light) / NR }'
}

# shellcheck disable=SC2086 # words
{
    echo "== figure 1: the midpoint"
    slice papers-midpoint solid.scene $midpoint --cull none --row 23 --show first,second,map,pixels --window -.5,48,-1,29 --scale 10

    echo "== figure 2: unshadowing, self-shadowing; midpoint and dual"
    slice papers-unshadowing unshadowing.gno $midpoint --cull none --row 31 --window 22,22,44,34 --scale 12
    slice papers-unshadowing-dual unshadowing.gno --method dual --bias 2t --row 31 --window 22,22,44,34 --scale 12
    slice papers-silhouette silhouette.gno $midpoint --cull none --row 31 --window 19,26,36,26 --scale 12
    slice papers-silhouette-dual silhouette.gno --method dual --bias 2t --row 31 --window 19,26,36,26 --scale 12

    echo "== figure 3: a large constant bias; dual with the same"
    slice papers-near near_receiver.gno --method constant --bias 8t --column 31 --window 17,28,52,20 --scale 12
    slice papers-near-dual near_receiver.gno --method dual --bias 8t --column 31 --window 17,28,52,20 --scale 12

    echo "== figure 4: midpoint without back faces; dual"
    slice papers-background background.gno $midpoint --cull back --row 8 --window -.5,16,8,17.5 --scale 20
    slice papers-background-dual background.gno --method dual --bias 2t --row 8 --window -.5,16,8,17.5 --scale 20
    slice papers-steep steep_receiver.gno $midpoint --cull back --row 31 --window 22,18,48,20 --scale 16
    slice papers-steep-dual steep_receiver.gno --method dual --bias 2t --row 31 --window 22,18,48,20 --scale 16
    slice papers-steep-second steep_receiver.gno $second --layers two --cull none --row 31 --window 22,18,48,20 --scale 16
    for scene in $cases; do
        shot $scene $scene $midpoint --cull none
        shot $scene $scene $midpoint --cull back
        shot $scene $scene --method dual --layers two --cull none --bias 2t
        shot $scene $scene --method dual --bias 2t
        shot $scene $scene --method dual --bias 8t
        shot $scene $scene --method constant --bias 2t
        shot $scene $scene --method constant --bias 8t
    done

    echo "== figure 5: the L, map 32"
    shot l-a lshape --method volumes
    shot l-b lshape $midpoint --cull none --map 32
    shot l-c lshape --method dual --bias 2t --cull none --layers two --map 32
    shot l-d lshape --method constant --bias 4t --map 32
    shot l-e lshape $midpoint --cull back --map 32
    shot l-f lshape --method dual --bias 2t --map 32
    shot l-g lshape $second $virtual --map 32
    part="@460x320+90+40"
    join papers-l 3 l-a$part l-b.difference$part l-c.difference$part l-d.difference$part l-e.difference$part l-f.difference$part

    echo "== figure 6: double torus, map 128"
    for how in nearest bilinear; do
        for map in 64 128 256; do
            shot constant-$how-$map torus2 --method constant --bias 2t --reconstruct $how --map $map
            shot midpoint-$how-$map torus2 --method midpoint --cull none --reconstruct $how --map $map
            shot dual-$how-$map torus2 --method dual --bias 2t --reconstruct $how --map $map
            shot second-$how-$map torus2 --method mixed $virtual --reconstruct $how --map $map
        done
    done
    part="@200x140+240+170"
    join papers-torus 3 constant-nearest-128$part midpoint-nearest-128$part dual-nearest-128$part \
        constant-bilinear-128$part midpoint-bilinear-128$part dual-bilinear-128$part

    echo "== figure 7: factory, 4 x 4 jitter, map 512"
    for bias in 2 6 10 20; do
        shot constant$bias factory --method constant --bias ${bias}t --reconstruct jitter4x4 --map 512
        shot dual$bias factory --method dual --bias ${bias}t --reconstruct jitter4x4 --map 512
    done
    shot midpoint factory --method midpoint --cull none --reconstruct jitter4x4 --map 512
    shot second factory $second $virtual --reconstruct jitter4x4 --map 512
    shot dualv factory --method dual --bias 2t $virtual --reconstruct jitter4x4 --map 512
    part="@180x200+60+150"
    join papers-factory 3 constant6$part midpoint$part dual6$part

    echo "== sections 4 and 7: offsets, map 256, means of the twelve scenes"
    for bias in .5 1 2 4 8 16 32 64 128; do
        for method in constant dual; do echo "$method, $bias texels: $(mean --method $method --bias ${bias}t --map 256)"; done
    done
    for cull in none back; do
        echo "midpoint, cull $cull: $(mean $midpoint --cull $cull --map 256)"
        echo "dual, 8 texels, cull $cull: $(mean --method dual --layers two --bias 8t --cull $cull --map 256)"
    done
    echo "second depth where closed, else dual; virtual samples: $(mean --method mixed $virtual --map 256)"
    for scene in $twelve; do
        for how in "$midpoint --cull none" "--method dual --layers two --cull none --bias 0.999r"; do
            "$build/gnomon" render "$work/$scene.scene" $how --map 256 --mask "$work/x.pgm" --hash | grep '^map ' >>"$work/maps"
        done
        uniq "$work/maps" | wc -l | sed "s/^ *1\$/$scene: midpoint is dual with the largest offset/"
        rm "$work/maps"
    done
}

# options_of METHOD: of table 1.
options_of() {
    case $1 in
    midpoint) echo "$midpoint --cull none" ;;
    *) echo "--method $1 --bias 2t" ;;
    esac
}

# ---- times ---------------------------------------------------------------------------------------------------------

pin=
if command -v taskset >/dev/null; then pin="taskset -c ${CORE:-0}"; fi

# Least milliseconds of a frame, over all rounds; the configurations take turns.
echo "== table 1: factory, 1100 x 1100, least milliseconds of a frame"
round=0
while [ $round -lt "${ROUNDS:-3}" ]; do
    for how in nearest bilinear jitter4x4; do
        for method in constant midpoint dual; do
            for map in 256 2048; do
                # shellcheck disable=SC2046,SC2086 # words
                $pin "$build/gnomon" bench "$work/factory.scene" --size 1100x1100 $(options_of $method) --map $map \
                    --reconstruct $how --runs "${RUNS:-9}" |
                    awk -v name="$how $method $map" '$1 == "frame" { print name, $3 }'
            done
        done
    done
    round=$((round + 1))
done | awk '{ name = $1 " " $2 " " $3 }
    !(name in least) || $4 < least[name] { least[name] = $4 }
    END { for (how in least) print how, least[how] }' | sort

start_counting || exit 0
echo "== table 1: factory, 1100 x 1100, million instructions: all"
for how in nearest bilinear jitter4x4; do
    for method in constant midpoint dual; do
        for map in 256 2048; do
            # shellcheck disable=SC2046 # words
            instructions "$how $method $map" fitted=0 rounds=0 -- factory.scene --size 1100x1100 \
                $(options_of $method) --map $map --reconstruct $how
        done
    done
done
