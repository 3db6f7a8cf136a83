#!/bin/sh
# Compare masks of fitted and warped maps with the truth, and with the errors that the same methods have in double
# precision; and say what the best chain gains over a uniform map.
#
#     tests/report/parameterisations.sh GNOMON TRUTH_FOLDER SCENE_FOLDER FIGURES_CSV|-
#
# Arguments, environment (CSV) and the bar are those of tests/report/accuracy.sh, names those of tests/report/methods.sh.
# First every fit and warp at 256, with SURFACES (constt:2 dualct:2+v3 sdm:2+v3); then the best chain, the minimal frustum
# with the rectilinear warp by counts, beside uniform maps, with and without silhouettes, at SIZES (64 128 256 512 1024);
# last what that chain makes of the error of uniform maps, scene by scene.
#
# Prints Markdown. Exit status: 0 all within the bar, 1 a cell or a mean is over it, 2 something could not be done.
set -eu

here=$(dirname "$0")
if [ $# -ne 4 ]; then
    echo "usage: tests/report/parameterisations.sh GNOMON TRUTH_FOLDER SCENE_FOLDER FIGURES_CSV|-" >&2
    exit 2
fi
sizes=${SIZES:-64 128 256 512 1024}
surfaces=${SURFACES:-constt:2 dualct:2+v3 sdm:2+v3}
warps='dv msf dv+rtw dv+rtwc msf+rtwc dv+notw dv+notw:4'
uniform=sdm:2+v3
chain=msf+rtwc/sdm:2+v3+sil4n

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
trap 'exit 2' HUP INT TERM
result=0

# compare METHODS CSV ARGUMENT...: the tables of accuracy.sh.
compare() {
    methods=$1
    csv=$2
    shift 2
    status=0
    METHODS=$methods CSV=$csv "$here/accuracy.sh" "$@" || status=$?
    [ $status -le 1 ] || exit 2
    [ $status -eq 0 ] || result=1
}

methods=
for surface in $surfaces; do
    methods="$methods $surface"
    for warp in $warps; do
        methods="$methods $warp/$surface"
    done
done
echo "## Fits and warps at 256"
echo
compare "$methods" "$work/warps.csv" "$@" 256

echo
echo "## The best chain"
echo
# shellcheck disable=SC2086 # sizes are words
compare "$uniform $uniform+sil4n ${chain%+sil4n} $chain" "$work/chain.csv" "$@" $sizes

echo
echo "## Uniform against the best chain"
echo
echo "Total per cent of $uniform on a uniform map, of $chain, and how many times less that is:"
echo
awk -F, -v sizes="$sizes" -v uniform="none $uniform" -v chain="${chain%%/*} ${chain#*/}" '
    function factor(before, after) {
        return after > 0 ? sprintf("%.1f", before / after) : before > 0 ? "all" : "-"
    }
    FNR == 1 { next }
    !($1 in seen) { seen[$1] = 1; scene[++scenes] = $1 }
    { total[$1, $3, $2 " " $4] = $7 }
    END {
        size_count = split(sizes, size, " ")
        line = "| scene |"
        rule = "|---|"
        for (z = 1; z <= size_count; z++) {
            line = line " " size[z] " |"
            rule = rule "---|"
        }
        print line
        print rule
        for (s = 1; s <= scenes; s++) {
            line = "| " scene[s] " |"
            for (z = 1; z <= size_count; z++) {
                before = total[scene[s], size[z], uniform]
                after = total[scene[s], size[z], chain]
                sum[z, 1] += before
                sum[z, 2] += after
                worse += after > before
                line = line sprintf(" %.2f, %.2f, %s |", before, after, factor(before, after))
            }
            print line
        }
        line = "| mean |"
        for (z = 1; z <= size_count; z++)
            line = line sprintf(" %.2f, %.2f, %s |", sum[z, 1] / scenes, sum[z, 2] / scenes, factor(sum[z, 1], sum[z, 2]))
        print line
        print ""
        print worse + 0 " of " scenes * size_count " cells are worse by it."
    }' "$work/chain.csv"

if [ -n "${CSV:-}" ]; then
    cat "$work/warps.csv" >"$CSV"
    awk 'FNR > 1' "$work/chain.csv" >>"$CSV"
fi
exit $result
