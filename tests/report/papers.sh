#!/bin/sh
# Make the pictures of docs/papers.md and print their figures.
#
#     tests/report/papers.sh BUILD -o FOLDER
#
# BUILD is the folder of `make BUILD=... all`, with OpenImageIO. Call it from the top of the project: it builds
# tests/report/stages.c, cells.c and mosaic.c. ROUNDS (3) times RUNS (9) frames are measured of each cell of the table of times.
set -eu

here=$(dirname "$0")
# shellcheck source=SCRIPTDIR/shots.sh
. "$here/shots.sh"

start_pictures "$@"
mkdir -p "$work/strict"

# ---- scenes --------------------------------------------------------------------------------------------------------

# box FILE X0 X1 Y0 Y1 Z0 Z1: one more closed box, of the eight vertices before its faces.
box() {
    awk -v numbers="$2 $3 $4 $5 $6 $7" 'BEGIN { split(numbers, side, " ")
        for (i = 0; i < 8; i++) print "v", side[1 + i % 2], side[3 + int(i / 2) % 2], side[5 + int(i / 4)]
        print "f -8 -6 -5 -7\nf -4 -3 -1 -2\nf -8 -7 -3 -4\nf -6 -2 -1 -5\nf -8 -4 -2 -6\nf -7 -5 -1 -3" }' >>"$work/$1"
}

for scene in torus2 pins pipes factory; do "$build/gnomon" procedural $scene -o "$work"; done
sed 's/^image.*/image 1024 1024/' "$work/pipes.scene" >"$work/pipes1024.scene"

# A table on a floor, legs 4 cm thick; the lamp stands 0.9 m above the table's top, 6.7 m off.
box floor.obj -4 4 -.2 0 -4 4
box table.obj -1.6 1.6 1.5 1.6 -1 1
for z in "-.87 -.83" ".83 .87"; do
    # shellcheck disable=SC2086 # two numbers
    {
        box table.obj -1.47 -1.43 0 1.5 $z
        box table.obj 1.43 1.47 0 1.5 $z
    }
done
cat >"$work/legs.scene" <<'END'
image 640 480
map 512
camera perspective eye 3.6 3.2 4.4 target 0 .5 0 up 0 1 0 fovy 40 near .1 far 500
light spot position 5 2.5 -4.4 target 0 .4 0 fovy 62 near 2 far 14
ambient .2
mesh floor.obj surface closed color .6 .6 .6
mesh table.obj surface closed color .8 .6 .4
END
sed 's/^light.*/light directional direction -5 -1.5 4.4/' "$work/legs.scene" >"$work/legs_sun.scene"

# A slab as thick as a ninth of a texel under a sun 30 degrees high; the same under a lamp.
box ground.obj -1.8 1.8 -.2 0 -1.4 1.4
box slab.obj -1.2 -.2 .5 .50625 -.7 .7
cat >"$work/slab.scene" <<'END'
image 640 480
map 64
camera perspective eye -1.2 3.4 3 target -.2 .15 0 up 0 1 0 fovy 40 near .1 far 500
light directional direction .866 -.5 0
ambient .2
mesh ground.obj surface closed color .6 .6 .6
mesh slab.obj surface closed color .8 .6 .4
END
sed 's/^light.*/light spot position -4 2.3 0 target 0 .2 0 fovy 60 near 1 far 8/' "$work/slab.scene" \
    >"$work/slab_spot.scene"

"$here/truth.sh" "$build/gnomon" "$work"/*.scene -o "$work"

# ---- figures of pixels ---------------------------------------------------------------------------------------------

# row MASK Y FROM COUNT: pixels of a row of a mask 640 wide, one a line.
row() {
    od -An -v -tu1 -j $((15 + 640 * $2 + $3)) -N "$4" "$1" | tr -s ' ' '\n' | sed '/^$/d'
}

# gap NAME SCENE: false light in the row in which the shadow of the rear left leg lies, from its foot on.
gap() {
    row "$work/$1.mask.pgm" 273 100 60 >"$work/row"
    row "$work/$2.pgm" 273 100 60 | paste "$work/row" - |
        awk '$1 != 255 && $1 >= 127 && $2 < 127 { n++ } END { print "    gap between leg and shadow: " n + 0 " pixels" }'
}

# counts SCENE OPTION...: how pixels were decided, % of those tested.
counts() {
    scene=$1
    shift
    "$build/gnomon" render "$work/$scene.scene" "$@" --stats "$work/stats.json"
    awk -F '[:,]' -v name="$scene $*" '/"pixels/ { gsub(/[" ]/, "", $1); count[$1] = $2 }
        END { printf "%s: %.1f %% of the pixels tested need virtual samples\n", name,
                  100 * count["pixels_virtual"] / count["pixels_tested"] }' "$work/stats.json"
}

second="--method second-depth"
virtual="--receiver virtual"

# shellcheck disable=SC2086 # words
{
    echo "== Wang & Molnar, figure 4: table, map 512"
    for scene in legs legs_sun; do
        for bias in 0.5 1 1.5 2 2.5 3 3.5 4 6 8 12; do
            shot bias$bias $scene --method constant --bias ${bias}t
            [ $scene = legs_sun ] || gap bias$bias legs
            [ $scene != legs ] || [ $bias != 2 ] || cp "$work/bias2.png" "$work/acne.png"
            [ $scene != legs ] || [ $bias != 8 ] || cp "$work/bias8.png" "$work/detached.png"
        done
        shot point $scene $second
        [ $scene = legs_sun ] || gap point legs
        shot virtual $scene $second $virtual
        [ $scene = legs_sun ] || gap virtual legs
        [ $scene = legs_sun ] || cp "$work/virtual.png" "$work/met.png"
    done
    for bias in 1 3 12; do shot large$bias legs --method constant --bias ${bias}t --map 2048; done
    gap large1 legs
    gap large3 legs
    join papers-table 3 acne@320x320+60+60 detached@320x320+60+60 met@320x320+60+60 \
        acne@40x40+120+250*8 detached@40x40+120+250*8 met@40x40+120+250*8

    echo "== figure 5: second depth by two layers and by culled front faces, map 512"
    for scene in legs pins pipes; do
        shot two $scene $second --layers two --cull none $virtual --map 512
        shot culled $scene $second --layers first --cull front $virtual --map 512
    done

    echo "== figure 7: slab, map 64"
    for scene in slab slab_spot; do
        shot point-$scene $scene $second
        shot virtual-$scene $scene $second $virtual
    done
    join papers-slab 2 point-slab@400x300+110+70 virtual-slab@400x300+110+70

    echo "== figure 9: virtual samples at every pixel, and only where the texels disagree"
    for scene in torus2 pins pipes; do
        for map in 64 128 256 512; do
            shot rule-$scene-$map $scene $second $virtual --map $map
            shot always-$scene-$map $scene $second --receiver virtual-always --map $map
        done
    done
    part="@120x80+180+240*3"
    join papers-curved 2 rule-pipes-128.difference$part always-pipes-128.difference$part

    echo "== figure 10: virtual samples lit where z < stored, and where z <= stored; map 128"
    "$work/stages" "$work/torus2.scene" $second $virtual --strict --map 128 -o "$work/strict" >/dev/null
    echo "torus2, z < stored: $(figures "$work/strict/mask.png" "$work/torus2.pgm")"
    mv "$work/difference.png" "$work/strict.png"
    shot equal torus2 $second $virtual --map 128
    join papers-strict 2 strict@300x225+180+90 equal.difference@300x225+180+90

    echo "== figure 12: pipes, image 1024 x 1024"
    for map in 1024 512 256 128 64; do
        shot pipes$map pipes1024 $second $virtual --map $map
        counts pipes1024 $second $virtual --map $map
        shot first$map pipes1024 --method constant --bias 2t --map $map
    done
    part="@260x220+420+520"
    join papers-pipes 3 pipes512$part pipes256$part pipes128$part

    echo "== Weiskopf & Ertl, figure 6: double torus, map 128"
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
}

# ---- Sen, Cammarano & Hanrahan 2003 ---------------------------------------------------------------------------------

"$here/papers_sen.sh" "$build" -o "$folder"

# ---- Milet, Navratil & Zemcik 2015 ----------------------------------------------------------------------------------

"$here/papers_milet.sh" "$build" -o "$folder"

# ---- times ---------------------------------------------------------------------------------------------------------

pin=
if command -v taskset >/dev/null; then pin="taskset -c ${CORE:-0}"; fi

# Least milliseconds of a frame, over all rounds; the configurations take turns.
echo "== table 1: factory, 1100 x 1100, least milliseconds of a frame"
round=0
while [ $round -lt "${ROUNDS:-3}" ]; do
    for how in nearest bilinear jitter4x4; do
        for method in constant dual; do
            for map in 256 2048; do
                # shellcheck disable=SC2086 # words
                $pin "$build/gnomon" bench "$work/factory.scene" --size 1100x1100 --method $method --bias 2t --map $map \
                    --reconstruct $how --runs "${RUNS:-9}" |
                    awk -v name="$how $method $map" '$1 == "frame" { print name, $3 }'
            done
        done
    done
    round=$((round + 1))
done | awk '{ name = $1 " " $2 " " $3 }
    !(name in least) || $4 < least[name] { least[name] = $4 }
    END { for (how in least) print how, least[how] }' | sort
