#!/bin/sh
# Measure a frame of gnomon beside the same frame of OpenGL on the processor (Mesa llvmpipe), in turn, on one core.
#
#     tests/report/speed.sh GNOMON PEER SCENE...
#
# PEER is a program that knows `PEER SCENE --map N --method constant|dual --threads 1 --frames K --warmup K` and prints lines
# `light|camera|total ... median X min Y ...` in milliseconds, like peer_gl. Both run on core CORE (default 0) where taskset is
# there, one worker each, at the size in the scene file; MAP is 512, ROUNDS 7, FRAMES 11 a round unless the environment says otherwise.
#
# Prints Markdown: the least time over all rounds, the median of the rounds' medians, and the ratios gnomon / peer. Milliseconds
# drift with the machine's load; ratios of one run are what counts. Exit status: 0 all least totals within LIMIT (0.5) of the
# peer's, 1 one is over it, 2 something could not be done.
set -eu

here=$(dirname "$0")

if [ $# -lt 3 ]; then
    echo "usage: tests/report/speed.sh GNOMON PEER SCENE..." >&2
    exit 2
fi
gnomon=$1
peer=$2
shift 2

pin=
if command -v taskset >/dev/null; then pin="taskset -c ${CORE:-0}"; fi
map=${MAP:-512}
frames=${FRAMES:-11}

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
trap 'exit 2' HUP INT TERM

measure_peer() {
    $pin "$peer" "$1" --map "$map" --method "$2" --threads 1 --warmup 3 --frames "$frames" >"$work/peer" || exit 2
    awk -v row="$3 $2" '
        $1 == "scene" { triangles = $4 }
        $1 == "light" || $1 == "camera" || $1 == "total" {
            for (i = 2; i < NF; i++) {
                if ($i == "median") median[$1] = $(i + 1)
                if ($i == "min") least[$1] = $(i + 1)
            }
        }
        END { for (part in least) print "peer", row, part, median[part], least[part], triangles }' "$work/peer" >>"$work/times"
}

measure_ours() {
    $pin "$gnomon" bench "$1" --map "$map" --method "$2" --workers 1 --runs "$frames" --json "$work/bench.json" >/dev/null || exit 2
    awk -v row="$3 $2" '
        { gsub(/[",:{}]/, " ") }
        $1 == "light" || $1 == "camera" || $1 == "frame" { part = $1 == "frame" ? "total" : $1 }
        $1 == "median_ms" { median[part] = $2 }
        $1 == "least_ms" { least[part] = $2 }
        END { for (part in least) print "ours", row, part, median[part], least[part], 0 }' "$work/bench.json" >>"$work/times"
}

round=0
while [ $round -lt "${ROUNDS:-7}" ]; do
    round=$((round + 1))
    for scene in "$@"; do
        for method in constant dual; do
            name=$(basename "$scene" .scene)
            measure_peer "$scene" $method "$name"
            measure_ours "$scene" $method "$name"
        done
    done
    if [ -t 2 ]; then echo "round $round" >&2; fi
done

awk -v limit="${LIMIT:-0.5}" -f "$here/speed.awk" "$work/times"
