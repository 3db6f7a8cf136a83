#!/bin/sh
# Compare methods with and without silhouette maps: what they gain, and every cell in which they lose.
#
#     [METHODS='NAME...'] tests/report/silhouettes.sh GNOMON TRUTH_FOLDER SCENE_FOLDER [SIZE...]
#
# TRUTH_FOLDER holds NAME.pgm for every NAME.scene of SCENE_FOLDER. METHODS: names of tests/report/methods.sh, without
# `+sil`. SIZEs of the map: 64 128 256 512 1024 unless named. CSV=FILE in the environment also writes all figures there.
#
# Prints Markdown. Exit status: 0 nothing lost, 1 a scene's error is larger with silhouettes by more than 0.1 points at a
# map of 128 or more, 2 something could not be done.
set -eu

if [ $# -lt 3 ]; then
    echo "usage: tests/report/silhouettes.sh GNOMON TRUTH_FOLDER SCENE_FOLDER [SIZE...]" >&2
    exit 2
fi
gnomon=$1
truth=$2
scenes=$3
shift 3
sizes=${*:-64 128 256 512 1024}
methods=${METHODS:-sdm:2+v3 sdm:2 sd2+v3 sd2 sdf+v3 dualct:2+v3 const:0.005 first:1e-4+v3}
pairs=
for method in $methods; do pairs="$pairs $method $method+sil"; done

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
trap 'exit 2' HUP INT TERM

# shellcheck disable=SC2086 # the sizes are words
CSV=$work/figures.csv METHODS=$pairs "$(dirname "$0")/accuracy.sh" "$gnomon" "$truth" "$scenes" - $sizes >/dev/null || exit 2
if [ -n "${CSV:-}" ]; then cp "$work/figures.csv" "$CSV"; fi

awk -F, -v methods="$methods" -v sizes="$sizes" '
    NR > 1 {
        total[$1, $3, $4] = $7
        sum[$3, $4] += $7
        if (!($1 in seen)) {
            seen[$1] = 1
            scene[++scenes] = $1
        }
    }
    END {
        size_count = split(sizes, size, " ")
        method_count = split(methods, method, " ")
        print "Mean over the " scenes " scenes, total %: without silhouettes, with them, factor; by size of the map:"
        print ""
        line = "| method |"
        rule = "|---|"
        for (z = 1; z <= size_count; z++) {
            line = line " " size[z] " |"
            rule = rule "---|"
        }
        print line " largest loss |"
        print rule "---|"
        for (m = 1; m <= method_count; m++) {
            line = "| " method[m] " |"
            worst = 0
            worst_text = "none"
            for (z = 1; z <= size_count; z++) {
                without = sum[size[z], method[m]] / scenes
                with = sum[size[z], method[m] "+sil"] / scenes
                line = line sprintf(" %.3f, %.3f, %s |", without, with, with > 0 ? sprintf("%.1f", without / with) : "-")
                for (s = 1; s <= scenes; s++) {
                    before = total[scene[s], size[z], method[m]]
                    after = total[scene[s], size[z], method[m] "+sil"]
                    cells++
                    if (after <= before)
                        continue
                    loss = after - before
                    lost[++losses] = sprintf("| %s | %d | %s | %.3f | %.3f | %+.3f |", method[m], size[z], scene[s], before,
                                             after, loss)
                    if (loss > worst) {
                        worst = loss
                        worst_text = sprintf("%s %d %+.3f", scene[s], size[z], loss)
                    }
                    over += size[z] >= 128 && loss > 0.1
                }
            }
            print line " " worst_text " |"
        }
        print ""
        print losses + 0 " of " cells " cells are worse with silhouettes" (losses ? ":" : ".")
        if (losses) {
            print ""
            print "| method | map | scene | without | with | loss |"
            print "|---|---|---|---|---|---|"
            for (l = 1; l <= losses; l++)
                print lost[l]
        }
        print ""
        print over + 0 " of them by more than 0.1 points at 128 or more."
        exit over > 0
    }' "$work/figures.csv"
