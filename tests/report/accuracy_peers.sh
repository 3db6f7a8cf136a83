#!/bin/sh
# Compare shadow masks with another program's truth: a table of false shadow + false light, a row for each method and map
# size, a column for each scene.
#
#     [METHODS='NAME...'] [SIZES='SIZE...'] tests/report/accuracy_peers.sh GNOMON PEER SCENE...
#
# PEER is a program that knows `PEER SCENE --frames 1 --dump MASK.pgm` (tests/report/truth_peers.sh). METHODS: names of
# tests/report/methods.sh; SIZES of the map: 256 1024. Per cent of the pixels that see a surface. The last column is the
# largest difference of a total to the one against `gnomon truth`, in points.
#
# Exit status: 0 done, 1 a total differs from the one against `gnomon truth` by more than 0.02 points, 2 something could
# not be done.
set -eu

here=$(dirname "$0")
# shellcheck source=SCRIPTDIR/methods.sh
. "$here/methods.sh"

if [ $# -lt 3 ]; then
    echo "usage: tests/report/accuracy_peers.sh GNOMON PEER SCENE..." >&2
    exit 2
fi
gnomon=$1
peer=$2
shift 2
methods=${METHODS:-constt:2 slope:2:0.0005 rpb:1:0.0005 dualct:2+v3 sd2+v3 sdm:2+v3 first:1e-4+v3 sdm:2+v3+sil}
sizes=${SIZES:-256 1024}

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
trap 'exit 2' HUP INT TERM

# errors TRUTH: false shadow, false light and their sum, of mask.pgm.
errors() {
    status=0
    "$gnomon" compare "$work/mask.pgm" "$1" --json "$work/compare.json" >/dev/null || status=$?
    [ $status -le 1 ] || return 2
    awk '/^  "/ { gsub(/[",:]/, " "); value[$1] = $2 } # members of the outermost object
         END { print value["false_shadow_percent"], value["false_light_percent"], value["error_percent"] }' \
        "$work/compare.json"
}

for scene in "$@"; do
    name=$(basename "$scene" .scene)
    "$gnomon" truth "$scene" --mask "$work/exact.pgm" >/dev/null || exit 2
    "$peer" "$scene" --frames 1 --dump "$work/peer.pgm" >/dev/null </dev/null || exit 2
    for size in $sizes; do
        for method in $methods; do
            # shellcheck disable=SC2046 # the options are words
            "$gnomon" render "$scene" --map "$size" $(method_options "$method") --mask "$work/mask.pgm" >/dev/null || exit 2
            against_peer=$(errors "$work/peer.pgm") || exit 2
            exact=$(errors "$work/exact.pgm") || exit 2
            echo "$name $size $method $against_peer $exact" >>"$work/results"
        done
    done
    if [ -t 2 ]; then echo "$name" >&2; fi
done

awk -v methods="$methods" -v sizes="$sizes" '
    !($1 in seen) { seen[$1] = 1; scene[++scenes] = $1 }
    {
        cell[$1, $2, $3] = sprintf(" %.2f + %.2f |", $4, $5)
        difference = $6 > $9 ? $6 - $9 : $9 - $6
        if (difference > worst[$2, $3])
            worst[$2, $3] = difference
        failed = failed || difference > 0.02
    }
    END {
        line = "| method | map |"
        rule = "|---|---|"
        for (s = 1; s <= scenes; s++) {
            line = line " " scene[s] " |"
            rule = rule "---|"
        }
        print line " to exact truth |"
        print rule "---|"
        method_count = split(methods, method)
        size_count = split(sizes, size)
        for (m = 1; m <= method_count; m++)
            for (z = 1; z <= size_count; z++) {
                line = "| " method[m] " | " size[z] " |"
                for (s = 1; s <= scenes; s++)
                    line = line cell[scene[s], size[z], method[m]]
                printf "%s %.3f |\n", line, worst[size[z], method[m]]
            }
        exit failed
    }' "$work/results"
