#!/bin/sh
# Make truth masks: which pixel is truly lit, by exact ray casting.
#
#     tests/report/truth.sh GNOMON SCENE... -o FOLDER
#
# Masks are 0 shadowed, 254 lit, 255 no surface; FOLDER/NAME.pgm belongs to NAME.scene.
set -eu

usage() {
    echo "usage: tests/report/truth.sh GNOMON SCENE... -o FOLDER" >&2
    exit 2
}

gnomon=${1:-}
[ $# -ge 4 ] || usage
shift
scenes=
folder=
while [ $# -gt 0 ]; do
    case $1 in
    -o)
        [ $# -eq 2 ] || usage
        folder=$2
        shift
        ;;
    *.scene) scenes="$scenes
$1" ;;
    *) usage ;;
    esac
    shift
done
if [ -z "$folder" ] || [ -z "$scenes" ]; then usage; fi

mkdir -p "$folder"
echo "$scenes" | while read -r scene; do
    [ -n "$scene" ] || continue
    "$gnomon" truth "$scene" --mask "$folder/$(basename "$scene" .scene).pgm" >/dev/null </dev/null
done
