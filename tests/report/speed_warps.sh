#!/bin/sh
# Measure frames with fits and warps beside those of the uniform map, in turn, on one core.
#
#     tests/report/speed_warps.sh GNOMON SCENE...
#
# One worker, virtual samples, at the size in the scene file; MAP is 512, ROUNDS 7, FRAMES 11 a round unless the
# environment says otherwise. Prints Markdown: of each scene the least times of the passes over all rounds in
# milliseconds, and their sum on the uniform map's. Milliseconds drift with the machine's load; ratios of one
# run are what counts. Exit status: 0 done, 2 something could not be done.
set -eu

if [ $# -lt 2 ]; then
    echo "usage: tests/report/speed_warps.sh GNOMON SCENE..." >&2
    exit 2
fi
gnomon=$1
shift

pin=
if command -v taskset >/dev/null; then pin="taskset -c ${CORE:-0}"; fi
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
trap 'exit 2' HUP INT TERM

# measure SCENE CHAIN [OPTIONS]: lines of SCENE CHAIN PASS LEAST.
measure() {
    scene=$1
    chain=$2
    shift 2
    $pin "$gnomon" bench "$scene" --map "${MAP:-512}" "$@" --workers 1 --runs "${FRAMES:-11}" \
        --json "$work/bench.json" >/dev/null || exit 2
    awk -v row="$(basename "$scene" .scene) $chain" '
        { gsub(/[",:{}]/, " ") }
        $1 == "view" || $1 == "light" || $1 == "camera" || $1 == "frame" { part = $1 }
        $1 == "least_ms" { print row, part, $2 }' "$work/bench.json" >>"$work/times"
}

round=0
while [ $round -lt "${ROUNDS:-7}" ]; do
    round=$((round + 1))
    for scene; do
        for chain in uniform dv msf rectilinear rectilinear-distance msf+rectilinear dv+nonorthogonal; do
            measure "$scene" $chain --method auto --parameterise $chain
        done
        for chain in uniform msf+rectilinear; do
            measure "$scene" $chain,silhouettes --method silhouette --parameterise $chain
        done
    done
done

awk '
    BEGIN { rows = 0 }
    !(($1, $2) in seen) {
        seen[$1, $2] = 1
        scene[rows] = $1
        chain[rows++] = $2
    }
    {
        key = $1 SUBSEP $2 SUBSEP $3
        if (!(key in least) || $4 < least[key])
            least[key] = $4
    }
    function sum(key) {
        return least[key "view"] + least[key "light"] + least[key "camera"]
    }
    END {
        print "| scene | map | view | light | camera | **sum on uniform** |"
        print "|---|---|---|---|---|---|"
        for (i = 0; i < rows; i++) {
            key = scene[i] SUBSEP chain[i] SUBSEP
            base = scene[i] SUBSEP (chain[i] ~ /silhouettes/ ? "uniform,silhouettes" : "uniform") SUBSEP
            printf "| %s | %s | %.1f | %.1f | %.1f | **%.2f** |\n", scene[i], chain[i], least[key "view"],
                least[key "light"], least[key "camera"], sum(key) / sum(base)
        }
    }' "$work/times"
