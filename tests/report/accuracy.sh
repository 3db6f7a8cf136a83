#!/bin/sh
# Compare shadow masks with the truth, for each method, map size and scene, and with the errors that the same methods
# have in double precision.
#
#     [METHODS='NAME...'] tests/report/accuracy.sh GNOMON TRUTH_FOLDER SCENE_FOLDER FIGURES_CSV [SIZE...]
#
# TRUTH_FOLDER holds NAME.pgm for every NAME.scene of SCENE_FOLDER (tests/report/truth.sh makes them). FIGURES_CSV has the
# columns scene,warp,map,method,false_shadow,false_light,total in per cent; `-` for scenes that have none. A method that it
# does not name is not compared. SIZEs of the map: 64 128 256 512 1024 unless named. METHODS: names of
# tests/report/methods.sh; those of docs/accuracy.md unless named. CSV=FILE in the environment also writes our figures
# there, in the same columns.
#
# Prints Markdown. Exit status: 0 all within the bar, 1 a cell or a mean is over it, 2 something could not be done.
# The bar of a cell: the csv's total + max(0.05 points, 4 % of it); of a mean over the scenes: the csv's x 1.03 + 0.01.
set -eu

here=$(dirname "$0")
# shellcheck source=SCRIPTDIR/methods.sh
. "$here/methods.sh"

if [ $# -lt 4 ]; then
    echo "usage: tests/report/accuracy.sh GNOMON TRUTH_FOLDER SCENE_FOLDER FIGURES_CSV|- [SIZE...]" >&2
    exit 2
fi
gnomon=$1
truth=$2
scenes=$3
figures=$4
shift 4
sizes=${*:-64 128 256 512 1024}

methods=${METHODS:-const:0.02 mid midc dual:0.02 dualc:0.02 sd2 sdf sdm:2 sd2+v3 sdf+v3 sdm:2+v3 dualct:2+v3 rpb:1:0.0005 \
    slope:2:0.0005 first:1e-4+v3 sdm:2+v3+sil4n}

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
trap 'exit 2' HUP INT TERM

for scene in "$scenes"/*.scene; do
    name=$(basename "$scene" .scene)
    if [ ! -f "$scene" ]; then
        echo "$scenes: holds no .scene file" >&2
        exit 2
    fi
    if [ ! -f "$truth/$name.pgm" ]; then
        echo "$truth/$name.pgm: missing; tests/report/truth.sh makes it" >&2
        exit 2
    fi
    for size in $sizes; do
        for method in $methods; do
            # shellcheck disable=SC2046 # the options are words
            "$gnomon" render "$scene" --map "$size" $(method_options "$method") --mask "$work/mask.pgm" >/dev/null || exit 2
            status=0
            "$gnomon" compare "$work/mask.pgm" "$truth/$name.pgm" --json "$work/compare.json" >/dev/null || status=$?
            [ $status -le 1 ] || exit 2
            awk -v row="$name $(warp_of "$method") $size ${method#*/}" '
                /^  "/ { gsub(/[",:]/, " "); value[$1] = $2 } # members of the outermost object
                END { print row, value["false_shadow_percent"], value["false_light_percent"], value["error_percent"], \
                      value["coverage_differs"] }' "$work/compare.json" >>"$work/results"
        done
    done
    if [ -t 2 ]; then echo "$name" >&2; fi
done

if [ -n "${CSV:-}" ]; then
    awk 'BEGIN { print "scene,warp,map,method,false_shadow,false_light,total" }
         { printf "%s,%s,%s,%s,%.5f,%.5f,%.5f\n", $1, $2, $3, $4, $5, $6, $7 }' "$work/results" >"$CSV"
fi

if [ "$figures" = - ]; then figures=/dev/null; fi
awk -v methods="$methods" -v sizes="$sizes" -f "$here/accuracy.awk" "$figures" "$work/results"
