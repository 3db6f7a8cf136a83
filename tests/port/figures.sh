#!/bin/sh
# the_core_keeps_to_its_figures: instructions, flash and RAM
. tests/tap.sh

instructions() {
    set --
    for target in cortex-m4 cortex-m0 rv32imc; do
        set -- "$@" "$BUILD/bench/$target.count"
    done
    awk -f port/bench/table.awk "$@"
}

flash() {
    port/footprint/sizes.sh "$BUILD" $EMBEDDED_DEPTHS
}

check "no instruction count on Cortex-M4 exceeds its limit (make bench-targets)" instructions
check "flash of the core and RAM of the typical job stay within their limits (make sizes)" flash
finish
