#!/bin/sh
# Compare `gnomon truth` with another program's masks: a table of pixels that differ, and how many of them are near.
#
#     tests/report/truth_peers.sh GNOMON PEER SCENE...
#
# PEER is a program that knows `PEER SCENE --frames 1 --dump MASK.pgm` and shares nothing with gnomon (peer_embree casts
# rays with Embree in single precision). Masks are 0 shadowed, 254 lit, 255 no surface. Near: the truth is another 1/256
# pixel beside the centre, or hangs on a tie. Exit status 1 if more than 0.02 % of a scene's pixels differ.
set -eu

if [ $# -lt 3 ]; then
    echo "usage: tests/report/truth_peers.sh GNOMON PEER SCENE..." >&2
    exit 2
fi
gnomon=$1
peer=$2
shift 2
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

# samples MASK.pgm: without the header.
samples() {
    tail -c "$pixels" "$folder/$1"
}

# places FILE FILE: byte offsets where they differ.
places() {
    cmp -l "$1" "$2" | awk '{ print $1 }'
}

echo "| scene | pixels | near | differ | % | of them near | not near |"
echo "|---|---|---|---|---|---|---|"
failed=0
for scene in "$@"; do
    "$gnomon" truth "$scene" --mask "$folder/truth.pgm" --near "$folder/near.pgm" >/dev/null
    "$peer" "$scene" --frames 1 --dump "$folder/peer.pgm" >/dev/null </dev/null
    pixels=$(awk 'NR == 2 { print $1 * $2; exit }' "$folder/truth.pgm")
    for mask in truth near peer; do
        samples $mask.pgm >"$folder/$mask"
    done
    head -c "$pixels" /dev/zero >"$folder/nothing"
    places "$folder/near" "$folder/nothing" >"$folder/near.places" || true
    places "$folder/truth" "$folder/peer" >"$folder/differ.places" || true
    awk -v scene="$(basename "$scene" .scene)" -v pixels="$pixels" '
        FILENAME ~ /near/ { near[$1] = 1; all++; next }
        { differ++; both += $1 in near }
        END {
            printf "| %s | %d | %d | %d | %.4f | %d | %d |\n", scene, pixels, all, differ, 100 * differ / pixels, both,
                differ - both
            exit differ * 5000 > pixels
        }' "$folder/near.places" "$folder/differ.places" || failed=1
done
exit $failed
