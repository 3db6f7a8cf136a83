#!/bin/sh
# Make the pictures of Sen, Cammarano & Hanrahan 2003 in docs/papers.md and print their figures.
#
#     tests/report/papers_sen.sh BUILD -o FOLDER
#
# As papers_wang.sh. ROUNDS (3) times RUNS (9) frames are measured of each cell of the table of times.
set -eu

here=$(dirname "$0")
# shellcheck source=SCRIPTDIR/shots.sh
. "$here/shots.sh"

start_pictures "$@"
build_program cells "$work/cells"

# ---- scenes seen from above ----------------------------------------------------------------------------------------

# sheet FILE A B A B ...: one more flat sheet, half a unit above the floor, clockwise; A to the right, B downwards, in
# texels from the middle of the map.
sheet() {
    file=$1
    shift
    awk -v numbers="$*" 'BEGIN { n = split(numbers, at, " ")
        for (i = 1; i < n; i += 2) print "v", -at[i], 0.5, -at[i + 1]
        printf "f"
        for (i = n / 2; i > 0; i--) printf " %d", -i
        print "" }' >>"$work/$file"
}

# turned FILE TIMES A B A B ...: a sheet, turned clockwise by so many quarters.
turned() {
    file=$1
    times=$2
    shift 2
    # shellcheck disable=SC2046 # numbers
    sheet "$file" $(echo "$*" | awk -v times="$times" '{ for (i = 1; i < NF; i += 2) {
        a = $i; b = $(i + 1)
        for (t = 0; t < times; t++) { c = a; a = -b; b = c }
        print a, b } }')
}

# above NAME TEXELS SIDE PIXELS: NAME.scene: a floor as large as a map of so many texels, under the sheets of NAME.obj, if
# there are, and a sun overhead. The camera looks down from below the sheets at the middle of the map, SIDE texels.
above() {
    awk -v texels="$2" 'BEGIN { s = texels / 2.04
        print "v", -s, 0, -s "\nv", s, 0, -s "\nv", s, 0, s "\nv", -s, 0, s "\nf 1 4 3 2" }' >"$work/$1.floor.obj"
    cat >"$work/$1.scene" <<END_OF_SCENE
image $4 $4
map $2
camera orthographic eye 0 3 0 target 0 0 0 up 0 0 1 height $3 near 2.7 far 4
light directional direction 0 -1 0
ambient .2
mesh $1.floor.obj surface open color .6 .6 .6
END_OF_SCENE
    [ ! -f "$work/$1.obj" ] || echo "mesh $1.obj surface open color .8 .6 .4" >>"$work/$1.scene"
}

# look NAME SCENE OPTION...: the pictures of cells.c in the work folder's NAME, and what it counted.
look() {
    name=$1
    scene=$2
    shift 2
    mkdir -p "$work/$name"
    [ -f "$work/$scene.pgm" ] || "$here/truth.sh" "$build/gnomon" "$work/$scene.scene" -o "$work"
    printf '%-6s %s\n' "$name" "$("$work/cells" "$work/$scene.scene" "$work/$scene.pgm" -o "$work/$name" --method silhouette "$@")"
}

echo "== figures 3 and 4: points of edges"
build_program segments "$work/segments"
mkdir -p "$work/segments.out"
"$work/segments" -o "$work/segments.out"
cp "$work/segments.out/generate.svg" "$folder/papers-generate.svg"
cp "$work/segments.out/cases.svg" "$folder/papers-cases.svg"

echo "== figure 2: all results of the four tests"
one="-1.9 -1.9 1.22 -1.9 -1.82 1.9 -1.9 1.9"
half="-1.9 -1.9 1.9 -1.9 1.9 -.45 -1.9 .1"
quarter="-1.9 -1.9 -.2 -1.9 .15 -.1 -1.9 .3"
opposite="1.9 1.9 .3 1.9 .15 -.1 1.9 -.3"
three="-1.9 -1.9 1.9 -1.9 1.9 -1.22 -1.9 1.82"
all="-1.9 -1.9 1.9 -1.9 1.9 1.9 -1.9 1.9"
pictures=
for corners in A0 B0 B1 B2 B3 C0 C1 C2 C3 D0 D1 E0 E1 E2 E3 F0; do
    letter=${corners%?}
    quarters=${corners#?}
    # shellcheck disable=SC2086 # numbers
    case $letter in
    B) turned $corners.obj "$quarters" $one ;;
    C) turned $corners.obj "$quarters" $half ;;
    D)
        turned $corners.obj "$quarters" $quarter
        turned $corners.obj "$quarters" $opposite
        ;;
    E) turned $corners.obj "$quarters" $three ;;
    F) sheet $corners.obj $all ;;
    esac
    above $corners 4 2 100
    look $corners $corners --letters --label "$letter"
    pictures="$pictures $corners/after"
done
# shellcheck disable=SC2086 # words
join papers-corners 8 $pictures

echo "== figure 5: skewed quadrants"
sheet five.obj -2.8 -2.8 -.3 -2.8 -.1 -1 .15 -.1 -1 .15 -2.8 .5
sheet five.obj 2.8 2.8 .6 2.8 .35 1 .15 -.1 1 -.3 2.8 -.1
above five 6 3 300
look five five
join papers-quadrants 2 five/quadrants five/after

echo "== figure 7: artefacts"
sheet cross.obj -2.8 -2.8 -.9 -2.8 .2 2.8 -2.8 2.8
sheet cross.obj -2.7 .9 2.8 -.3 2.8 2.7 -2.7 2.7
sheet gap.obj -2.8 -2.8 1.9 -2.8 -2.6 2.8 -2.8 2.8
sheet gap.obj 2.8 2.8 -1.9 2.8 2.6 -2.8 2.8 -2.8
sheet spike.obj -2.8 -1.3 2.2 .1 -2.8 1.5
for scene in cross gap spike; do
    above $scene 6 4 200
    look $scene $scene
done
join papers-artefacts 3 cross/truth gap/truth spike/truth cross/after gap/after spike/after

echo "== figure 10: a grid that is warped"
# disc NAME SIDES: an ellipse, 4.8 by 4.2 texels.
disc() {
    # shellcheck disable=SC2046 # numbers
    sheet "$1.obj" $(awk -v sides="$2" 'BEGIN { for (i = 0; i < sides; i++) {
        angle = i * 6.28318531 / sides
        printf "%.4f %.4f ", .15 + 2.4 * cos(angle), .1 + 2.1 * sin(angle) } }')
    above "$1" 8 7 280
    look "$1" "$1"
}
disc disc 24
echo "== section 5: the same disc of more sides"
for sides in 8 12 48 96 192; do disc disc$sides $sides; done
join papers-grid 2 disc/texels disc/warped

# ---- scenes --------------------------------------------------------------------------------------------------------

for scene in torus2 crowd castle fence pins table pipes factory lshape; do
    "$build/gnomon" procedural $scene -o "$work"
done
sed 's/^camera.*/camera perspective eye 2.6 2.6 5.6 target .222 .402 -1.027 up 0 1 0 fovy 3 near 0.1 far 500/' \
    "$work/pins.scene" >"$work/strike.scene"
for scene in torus2 crowd castle fence pins table pipes factory lshape strike; do
    "$here/truth.sh" "$build/gnomon" "$work/$scene.scene" -o "$work"
done
standard="--method constant --bias 2t"

# counts SCENE MAP: as table 1.
counts() {
    "$build/gnomon" render "$work/$1.scene" --method silhouette --map "$2" --stats "$work/stats.json"
    "$build/gnomon" render "$work/$1.scene" --method volumes --stats "$work/volumes.json"
    awk -F '[:,]' -v name="$1" -v map="$2" '{ gsub(/[" ]/, "", $1) }
        FILENAME ~ /volumes/ { if ($1 == "overdraw" && !("O" in n)) n["O"] = $2; next }
        !($1 in n) { n[$1] = $2 + 0 }
        END { p = n["pixels_silhouette"] / n["pixels_shaded"]
              printf "%s, map %d: triangles %d, silhouette edges %d, silhouette fill %d of %d, P %.1f %%, O %.2f; 1 + 6 P %.2f; texels of the map with a point %.1f %% of those written\n", name,
                  map, n["triangles"], n["silhouette_edges"], n["pixels_silhouette"], n["pixels_shaded"], 100 * p, n["O"], 1 + 6 * p,
                  100 * n["silhouette_texels"] / n["light_texels"] }' \
        "$work/stats.json" "$work/volumes.json"
}

# shellcheck disable=SC2086 # words
{
    echo "== figure 1: two tori, map 128"
    shot standard torus2 $standard --map 128
    shot volumes torus2 --method volumes
    shot silhouette torus2 --method silhouette --map 128
    part="@310x180+200+210"
    join papers-sen 3 standard$part volumes$part silhouette$part

    echo "== figure 6 and table 1: map 512"
    for scene in crowd castle; do
        shot standard-$scene $scene $standard --map 512
        shot mixed-$scene $scene --method mixed --receiver virtual --map 512
        shot silhouette-$scene $scene --method silhouette --map 512
        shot volumes-$scene $scene --method volumes
    done
    crowd="@200x120+150+190*2"
    castle="@200x120+50+345*2"
    join papers-scenes 2 standard-crowd$crowd silhouette-crowd$crowd standard-castle$castle silhouette-castle$castle
    for scene in crowd castle fence pins torus2 table pipes factory lshape; do counts $scene 512; done

    echo "== figure 8: crowd, map 128"
    shot coarse crowd $standard --map 128
    shot exact crowd --method volumes
    shot torn crowd --method silhouette --map 128
    part="@106x60+155+200*3"
    join papers-torn 3 coarse$part exact$part torn$part

    echo "== figure 9: pins, map 512"
    for scene in pins strike; do
        shot standard-$scene $scene $standard --map 512
        shot mixed-$scene $scene --method mixed --receiver virtual --map 512
        shot silhouette-$scene $scene --method silhouette --map 512
    done
    look strike strike --map 512
    part="@320x360+190+30"
    join papers-strike 3 standard-strike$part strike/scene$part silhouette-strike$part

    echo "== section 4: bias"
    for scene in pins castle; do
        for bias in 0.5 2 4; do
            shot bias $scene --method constant --bias ${bias}t --map 512
            shot bias $scene --method constant --bias ${bias}t --reconstruct silhouette --map 512
            shot bias $scene --method constant --bias ${bias}t --receiver virtual --reconstruct silhouette --map 512
        done
    done
}

# ---- times ---------------------------------------------------------------------------------------------------------

pin=
if command -v taskset >/dev/null; then pin="taskset -c ${CORE:-0}"; fi

# Least milliseconds of a frame, over all rounds; the methods take turns.
echo "== table 1: map 512, least milliseconds of a frame"
round=0
while [ $round -lt "${ROUNDS:-3}" ]; do
    for scene in crowd castle; do
        for how in "$standard --map 512" "--method volumes" "--method silhouette --map 512"; do
            # shellcheck disable=SC2086 # words
            $pin "$build/gnomon" bench "$work/$scene.scene" $how --runs "${RUNS:-9}" |
                awk -v name="$scene $how" '$1 == "frame" { print $3, name }'
        done
    done
    round=$((round + 1))
done | awk '{ time = $1; sub(/^[^ ]* /, "") }
    !($0 in least) || time < least[$0] { least[$0] = time }
    END { for (name in least) print name ": " least[name] }' | sort

start_counting || exit 0
echo "== table 1: map 512, million instructions: all"
for scene in crowd castle; do
    for how in "$standard --map 512" "--method volumes" "--method silhouette --map 512"; do
        # shellcheck disable=SC2086 # words
        instructions "$scene $how" fitted=0 rounds=0 -- "$scene.scene" $how
    done
done
