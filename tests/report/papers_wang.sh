#!/bin/sh
# Make the pictures of Wang & Molnar 1994 in docs/papers.md and print their figures.
#
#     tests/report/papers_wang.sh BUILD -o FOLDER
#
# BUILD is the folder of `make BUILD=... all`, with OpenImageIO. Call it from the top of the project: it builds programs of
# tests/report. Instructions are counted where valgrind is (calls.awk, papers_milet.sh).
set -eu

here=$(dirname "$0")
# shellcheck source=SCRIPTDIR/shots.sh
. "$here/shots.sh"

start_pictures "$@"
build_program slices "$work/slices"
build_program planes "$work/planes"
mkdir -p "$work/strict"

# ---- scenes --------------------------------------------------------------------------------------------------------

# box FILE X0 X1 Y0 Y1 Z0 Z1: one more closed box, of the eight vertices before its faces.
box() {
    awk -v numbers="$2 $3 $4 $5 $6 $7" 'BEGIN { split(numbers, side, " ")
        for (i = 0; i < 8; i++) print "v", side[1 + i % 2], side[3 + int(i / 2) % 2], side[5 + int(i / 4)]
        print "f -8 -6 -5 -7\nf -4 -3 -1 -2\nf -8 -7 -3 -4\nf -6 -2 -1 -5\nf -8 -4 -2 -6\nf -7 -5 -1 -3" }' >>"$work/$1"
}

for scene in torus2 pins pipes castle crowd sheets fence; do "$build/gnomon" procedural $scene -o "$work"; done
for scene in pipes castle; do
    sed 's/^image.*/image 1024 1024/' "$work/$scene.scene" >"$work/${scene}1024.scene"
done
sed 's/^image.*/image 640 512/' "$work/pins.scene" >"$work/bowling.scene"
# All meshes open: the paper's non-solids.
sed 's/ surface closed/ surface open/' "$work/castle.scene" >"$work/open.scene"

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

# The floor alone, that nothing shadows.
sed '/table.obj/d; s/^image.*/image 320 240/' "$work/legs_sun.scene" >"$work/bare.scene"

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

# A low table, to be cut through a leg, under the same sun; small, for figure 1.
box low.obj -1 -.2 .7 .8 -.6 .6
for z in "-.6 -.53" ".53 .6"; do
    # shellcheck disable=SC2086 # two numbers
    {
        box low.obj -1 -.93 0 .7 $z
        box low.obj -.27 -.2 0 .7 $z
    }
done
sed 's/slab/low/; s/^map.*/map 128/' "$work/slab.scene" >"$work/low.scene"
sed 's/^image.*/image 320 240/; s/^map.*/map 240/' "$work/low.scene" >"$work/small.scene"

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
    echo "== figure 1: the two passes, map 240, bias 4 texels"
    slice papers-passes small.scene --method constant --bias 4t
    shot small small --method constant --bias 4t
    rm "$folder/papers-passes.svg"
    for picture in map own stored; do cp "$work/papers-passes/$picture.png" "$work/$picture.png"; done
    "$work/mosaic" "$work/answer.png" 1 "$work/small.mask.pgm"
    join papers-passes 5 map small own stored answer
    awk -F , 'NR > 1 && $7 { n++; wrong += ($5 <= $6) != $9 }
        END { print n " pixels turned to the light; compared by hand, other than the frame: " wrong + 0 }' \
        "$work/papers-passes/points.csv"

    echo "== figures 2 and 3: a floor and a leg"
    slice papers-mismatch low.scene --method constant --bias .25t --column 89 --window 87,9,12,13 --scale 24
    slice papers-bias low.scene --method constant --bias 2t --column 89 --window 87,9,12,13 --scale 24
    slice papers-bias-leg low.scene --method constant --bias 8t --column 89 --window 70,16,26,18 --scale 17

    echo "== section 2: least bias with which a filter leaves a floor lit, sun 12.7 degrees high, map 512"
    for how in nearest bilinear pcf3 jitter4x4 pcf5 pcf7; do
        for bias in 1 1.5 2 2.5 3 3.5 4 4.5 5 5.5 6 6.5 7 7.5 8 8.5 9 9.5 10 10.5 11 11.5 12 13 14 15 15.5 16 18 20; do
            "$build/gnomon" render "$work/bare.scene" --map 512 --method constant --bias ${bias}t --reconstruct $how \
                --mask "$work/bare.mask.pgm"
            if cmp -s "$work/bare.mask.pgm" "$work/bare.pgm"; then
                echo "$how: $bias texels"
                break
            fi
        done
    done

    echo "== figure 4: table, map 512"
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

    echo "== figure 5: pipes, map 128, row 64: second depth"
    slice papers-second pipes.scene $second $virtual --layers two --cull none --map 128 --row 64 \
        --window 7,114,3,61 --scale 7 --show map,dark --thickness .3

    echo "== figure 6: castle, map 512: depths of pixels less the stored one"
    for which in first second; do
        how="--method constant --bias 0t"
        [ $which = first ] || how="$second --layers two --cull none"
        texel=$(slice papers-$which-depths castle.scene $how --map 512 | sed 's/.*a texel is \([0-9.]*\) .*/\1/')
        awk -F , -v texel="$texel" -v title="$which depth" -v picture="$folder/papers-$which-depths.svg" \
            -f "$here/separation.awk" "$work/papers-$which-depths/points.csv"
    done

    echo "== section 3.1: second depth by two layers and by culled front faces, map 512"
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
    slice papers-thin slab.scene $second --window 24.5,9,6.5,15 --scale 24
    echo "== figure 8: a pixel's virtual samples"
    slice papers-virtual slab.scene $second $virtual --window 23.5,5,15.5,8 --scale 48 --pixel 268,210

    echo "== figure 9: virtual samples at every pixel, and only where the texels disagree"
    for scene in torus2 pins pipes; do
        for map in 64 128 256 512; do
            shot rule-$scene-$map $scene $second $virtual --map $map
            shot always-$scene-$map $scene $second --receiver virtual-always --map $map
        done
    done
    part="@120x80+180+240*3"
    join papers-curved 2 rule-pipes-128.difference$part always-pipes-128.difference$part
    slice papers-tangent pipes.scene $second --receiver virtual-always --layers two --cull none --map 128 --row 64 \
        --window 62,16,16,24 --scale 16 --pixel 383,259

    echo "== section 3.3: non-solids, map 256"
    for bias in 0t .25t .5t 1t 2t 4t; do shot sheets sheets $second $virtual --bias $bias --map 256; done
    shot open open $second $virtual --map 256
    mv "$work/open.mask.pgm" "$work/second.pgm"
    shot open open --method constant --bias 0t $virtual --map 256
    cmp "$work/second.pgm" "$work/open.mask.pgm" && echo "castle, all meshes open: second depth is first depth, bit for bit"

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


    echo "== figure 11: planes by matrices, map 512"
    for scene in castle pipes pins torus2 crowd; do
        printf '%s: %s\n' $scene "$("$work/planes" "$work/$scene.scene" --map 512)"
    done

    echo "== section 4.1: fence"
    for map in 64 128 256 512 1024; do
        shot fence fence --method constant --bias 2t --map $map
        shot fence fence $second --map $map
        shot fence fence $second $virtual --map $map
    done

    echo "== figures 13 to 15: sample images, map 512, no bias"
    for scene in pipes1024 castle1024 bowling; do
        shot $scene $scene $second $virtual --map 512
        counts $scene $second $virtual --map 512
    done
    for scene in pipes castle pins; do
        "$build/gnomon" render "$work/$scene.scene" $second $virtual --map 512 --size 320x256 -o "$work/sample-$scene.png"
    done
    join papers-samples 3 sample-pipes sample-castle sample-pins

    start_counting || exit 0
    echo "== section 4.2: million instructions of the first pass, map 512: column map"
    for scene in pipes castle; do
        instructions "$scene, first depth" fitted=0 rounds=0 -- $scene.scene --method constant --map 512 --size 64x64
        instructions "$scene, first depth, back faces culled" fitted=0 rounds=0 -- $scene.scene --method constant --cull back \
            --map 512 --size 64x64
        instructions "$scene, second depth, front faces culled" fitted=0 rounds=0 -- $scene.scene $second --map 512 --size 64x64
        instructions "$scene, second depth, two layers" fitted=0 rounds=0 -- $scene.scene $second --layers two --cull none \
            --map 512 --size 64x64
    done
}
