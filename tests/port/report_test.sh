#!/bin/sh
# docs_report_is_what_the_code_does: errors of every chain, bytes of every plan, and of two targets flash and some passes
. tests/tap.sh

recorded=docs/report/targets.csv
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
fresh=$folder/fresh.csv

measure() {
    set --
    for scene in $REPORT_SCENES; do
        set -- "$@" "$BUILD/golden/$scene.scene"
    done
    "$BUILD/report/targets" "$BUILD/report-check" "$BUILD/report" "$@" --csv "$fresh" --model yes >"$folder/model"
}

# model FRAMES frames, MEAN % mean error, WORST % worst
predict() {
    cat "$folder/model"
    awk '$1 == "model" { fits = $2 >= 90 && $4 <= 4 && $8 <= 10 } END { exit !fits }' "$folder/model"
}

# compare RECORDED: how much must be compared hangs on which compilers are the recorded ones: three scenes with 31 rows
# of four figures, and flash of 366 rows.
compare() {
    instructions=0
    for target in $REPORT_CHECKED; do
        ! grep -qxF "# $target: $(cat "$BUILD/report/$target.version")" "$recorded" ||
            instructions=$((instructions + 3 * 31 * 4 + 366))
    done
    awk -v bytes=366 -v instructions=$instructions -f tests/report/targets_check.awk "$1" "$fresh"
}

# finds TEXT AWK-PROGRAM: what the program makes of the recorded rows is not accepted, and the message has the text.
finds() {
    awk -F, -v OFS=, "$2" "$recorded" >"$folder/planted.csv"
    ! cmp -s "$recorded" "$folder/planted.csv" || { echo "nothing was planted"; return 1; }
    ! compare "$folder/planted.csv" >"$folder/out" || { echo "accepted"; return 1; }
    cat "$folder/out"
    grep -qF "$1" "$folder/out"
}

check "every chain is measured anew" measure
check "the cost model is within 4 % of the Cortex-M4's instructions in the mean, and within 10 % of every frame" predict
check "no error is larger and no cost has grown beyond docs/report (make report)" compare "$recorded"
check "a larger error is found" \
    finds "fence crossing 64 error" '$1 == "fence" && $2 == "crossing" && $3 == 64 { $6 -= 0.001 } { print }'
check "larger plans are found" finds "pins dual 128 bytes" '$1 == "pins" && $2 == "dual" && $3 == 128 { $11 /= 1.02 } { print }'
check "a row that is no longer recorded is found" \
    finds "not in the report: lshape volumes 0" '!($1 == "lshape" && $2 == "volumes") { print }'
check "a row that is no longer measured is found" \
    finds "not measured: torus constant 64" '{ print } $1 == "torus2" && $2 == "constant" && $3 == 64 { $1 = "torus"; print }'
if grep -qxF "# cortex-m4: $(cat "$BUILD/report/cortex-m4.version")" "$recorded"; then
    check "more instructions are found" finds "lshape constant 64 cortex-m4_light" \
        '$1 == "lshape" && $2 == "constant" && $3 == 64 { $14 /= 1.02 } { print }'
    check "more flash is found" finds "lshape volumes 0 cortex-m4_flash" \
        '$1 == "lshape" && $2 == "volumes" { $17 /= 1.02 } { print }'
fi
finish
