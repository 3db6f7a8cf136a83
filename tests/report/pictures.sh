#!/bin/sh
# Make the pictures of docs/ from the built-in scenes.
#
#     tests/report/pictures.sh GNOMON GNOMON32 -o FOLDER
#
# GNOMON and GNOMON32 keep depth in 16 and 32 bits and write PNG. oiiotool crops, enlarges without smoothing, and puts pictures side by side.
set -eu

here=$(dirname "$0")

if [ $# -ne 4 ] || [ "$3" != -o ]; then
    echo "usage: tests/report/pictures.sh GNOMON GNOMON32 -o FOLDER" >&2
    exit 2
fi
gnomon=$1
gnomon32=$2
folder=$4
command -v oiiotool >/dev/null || {
    echo "oiiotool is missing; the package openimageio-tools has it" >&2
    exit 2
}

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
trap 'exit 2' HUP INT TERM
mkdir -p "$folder"

"$gnomon" procedural all -o "$work"
"$gnomon" procedural colonnade --view 2 -o "$work"
# Light 5.5 degrees above an open ground; a spot light whose near plane is a thousandth of a unit away.
sed 's/^light.*/light directional direction 1 -0.1 0.3/' "$work/torus2.scene" >"$work/low.scene"
sed 's/near 0.25 far 9/near 0.001 far 9/' "$work/room.scene" >"$work/near.scene"
"$here/truth.sh" "$gnomon" "$work"/*.scene -o "$work"

# shot PROGRAM OUT SCENE CROP OPTION...: OUT.png and OUT.difference.png, cropped.
shot() {
    program=$1
    out=$2
    scene=$3
    crop=$4 # WIDTHxHEIGHT+X+Y
    shift 4
    "$program" render "$work/$scene.scene" "$@" -o "$work/shot.png" --mask "$work/shot.pgm" >/dev/null
    "$gnomon" compare "$work/shot.pgm" "$work/$scene.pgm" --difference "$work/difference.png" >"$work/out" || true
    printf '%s %s: %s\n' "$scene" "$*" "$(sed -n 2p "$work/out")"
    oiiotool "$work/shot.png" --cut "$crop" -o "$work/$out.png"
    oiiotool "$work/difference.png" --cut "$crop" -o "$work/$out.difference.png"
}

# join OUT COLUMNSxROWS PICTURE...: OUT.png of the folder. No metadata: oiiotool's would name this machine's folders, and
# make every run's file another.
join() {
    out=$1
    shape=$2
    shift 2
    pictures=
    for picture; do pictures="$pictures $work/$picture.png"; done
    # shellcheck disable=SC2086 # words; the folder is mktemp's
    oiiotool $pictures --mosaic:pad=4 "$shape" --nosoftwareattrib --eraseattrib '.*' -o "$folder/$out.png"
}

for scene in castle room pipes pins factory torus2; do
    "$gnomon" render "$work/$scene.scene" --map 1024 --size 400x300 -o "$work/contact_$scene.png"
done
join contact 3x2 contact_castle contact_room contact_pipes contact_pins contact_factory contact_torus2

# 32 KiB each: the best of the biases tried from 0.25t to 32t, and the best chain.
shot "$gnomon" a colonnade 640x480+0+0 --method constant --bias 1.5t --map 128
shot "$gnomon" b colonnade 640x480+0+0 --method silhouette --parameterise msf+rectilinear --map 103
join readme 3x1 b a.difference b.difference

shot "$gnomon" a fence 400x240+240+120 --method second-depth --map 256
shot "$gnomon" b fence 400x240+240+120 --method second-depth --map 1024
join limits-edges 2x2 a a.difference b b.difference

shot "$gnomon" a crowd 400x240+0+200 --method constant --bias 0.005r --map 256
shot "$gnomon" b room 400x240+240+200 --method constant --bias 0.02r --map 256
join limits-constant 2x2 a a.difference b b.difference

shot "$gnomon" a torus2 400x240+100+40 --method second-depth --map 256
shot "$gnomon" b torus2 400x240+100+40 --method mixed --map 256
join limits-second 2x2 a a.difference b b.difference

shot "$gnomon" a colonnade_view2 400x240+0+20 --method midpoint --layers two --cull none --map 256
shot "$gnomon" b colonnade_view2 400x240+0+20 --method midpoint --layers two --cull back --map 256
join limits-midpoint 2x2 a a.difference b b.difference

shot "$gnomon" a low 400x240+100+40 --method mixed --bias 2t --map 256
shot "$gnomon" b low 400x240+100+40 --method mixed --bias 8t --map 256
join limits-grazing 2x2 a a.difference b b.difference

shot "$gnomon" a near 400x240+100+200 --method mixed --map 256
shot "$gnomon32" b near 400x240+100+200 --method mixed --map 256
join limits-range 2x2 a a.difference b b.difference

# Where a solid curves away from the light its own back, the second depth, comes within a texel of its front.
for map in 256 1024; do
    shot "$gnomon" $map low 100x60+200+60 --method mixed --bias 8t --map $map
    for picture in $map $map.difference; do
        oiiotool "$work/$picture.png" --resample:interp=0 400x240 -o "$work/large.png"
        mv "$work/large.png" "$work/$picture.png"
    done
done
join limits-crease 2x2 256 256.difference 1024 1024.difference

# One pixel on the line where two solids meet.
shot "$gnomon" volumes colonnade_view2 50x30+320+174 --method volumes
for picture in volumes volumes.difference; do
    oiiotool "$work/$picture.png" --resample:interp=0 400x240 -o "$work/large.png"
    mv "$work/large.png" "$work/$picture.png"
done
join limits-volumes 2x1 volumes volumes.difference
