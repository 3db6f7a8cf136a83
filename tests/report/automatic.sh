#!/bin/sh
# Is `--method auto --budget-bytes` dominated? For each scene and budget: its error beside the least of all rows of a
# sweep that keep the same or fewer bytes. Dominated is what errs more than 1.2 times that. Shadow volumes, which have no
# map, take no part.
#
#     tests/report/automatic.sh GNOMON TRUTH SWEEP.csv SCENE...     # TRUTH/SCENE.pgm: masks of gnomon truth
#
# BUDGETS ("32 128 512", KiB), OPTIONS (for instance --no-trial). Prints a line a scene and budget, and the sums; exit
# status 1 where auto is dominated.
set -eu
gnomon=$1 truth=$2 sweep=$3
shift 3
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

# number NAME FILE: of JSON; of equal names the first, 0 where there is none.
number() {
    awk -v name="$1" '{ gsub(/[",:]/, " ") } $1 == name && !n++ { found = $2 } END { print found + 0 }' "$2"
}

for scene; do
    name=$(basename "$scene" .scene)
    faces=1
    grep -q '^light *point' "$scene" && faces=6
    for kilobytes in ${BUDGETS:-32 128 512}; do
        # shellcheck disable=SC2086
        "$gnomon" render "$scene" --method auto --budget-bytes "${kilobytes}K" ${OPTIONS:-} --mask "$folder/mask.pgm" \
            --stats "$folder/stats.json" 2>"$folder/said"
        "$gnomon" compare "$folder/mask.pgm" "$truth/$name.pgm" --json "$folder/compared.json" >/dev/null || [ $? = 1 ] # they differ
        bytes=$(($(number map_width "$folder/stats.json") * $(number map_height "$folder/stats.json") * 2 * faces +
            $(number silhouettes "$folder/stats.json") + $(number warp "$folder/stats.json")))
        echo "$name,$kilobytes,$bytes,$(number error_percent "$folder/compared.json"),$(sed 's/auto: //; s/, map .*//; s/, / /g' "$folder/said")"
    done
done >"$folder/auto.csv"

awk -F , '
    NR == FNR && FNR == 1 { for (i = 1; i <= NF; i++) column[$i] = i; next }
    NR == FNR {
        if ($column["depth_bits"] == 16 && $column["map"] > 0) {
            n = ++count[$column["scene"]]
            rival[$column["scene"], n] = $column["chain"]
            rival_bytes[$column["scene"], n] = $column["resident_bytes"]
            rival_error[$column["scene"], n] = $column["error"]
        }
        next
    }
    {
        best = 0
        for (i = 1; i <= count[$1]; i++)
            if (rival_bytes[$1, i] <= $3 && (!best || rival_error[$1, i] < rival_error[$1, best]))
                best = i
        if (!best) {
            print $1 ": not in the sweep"
            next
        }
        least = rival_error[$1, best]
        ratio = least > 0 ? $4 / least : $4 > 0 ? 99 : 1
        printf "%-20s %4d KiB  %8.4f  %8.4f  %5.2f %s  %s; %s\n", $1, $2, $4, least, ratio, (ratio > 1.2 ? "*" : " "), $5, rival[$1, best]
        rows++
        dominated += ratio > 1.2
        if (ratio > worst)
            worst = ratio
        logs += log(ratio > 0.01 ? ratio : 0.01)
        error += $4
        best_error += least
    }
    END {
        if (!rows)
            exit 2
        printf "%d of %d dominated, worst %.2f, geometric mean %.2f; mean error %.4f, of the best of the sweep %.4f\n", \
            dominated, rows, worst, exp(logs / rows), error / rows, best_error / rows
        exit dominated > 0
    }' "$sweep" "$folder/auto.csv"
