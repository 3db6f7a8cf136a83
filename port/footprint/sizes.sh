#!/bin/sh
# Prints flash and stack of the core by target, and the RAM of a typical job. Fails where Cortex-M4 exceeds a limit.
#
#     sizes.sh BUILD TARGET-DEPTH...
set -u
build=$1
shift
flash_limit=$((24 * 1024))
volumes_flash_limit=$((34 * 1024))
ram_limit=$((96 * 1024))
failed=0

tool_of() {
    case $1 in
    cortex*) echo arm-none-eabi- ;;
    rv32*) echo riscv64-unknown-elf- ;;
    esac
}

echo "Core, bytes           flash  static RAM  deepest stack"
for target; do
    sizes=$("$(tool_of "$target")size" -t "$build/$target/libgnomon.a" | tail -n 1)
    # shellcheck disable=SC2086 # words: text data bss
    set -- $sizes
    flash=$(($1 + $2))
    stack=$(cat "$build/objects/$target/core/"*.ci | awk -f tests/archive/stack.awk | awk '$1 == "deepest" { print $2 }')
    printf '%-20s %6d %11d %14s\n' "$target" "$flash" $(($2 + $3)) "$stack"
done
echo "Flash: the whole archive, every method; what a program does not use is not linked."
echo

# flash_of PROGRAM LIMIT: the functions and tables of the archive that a program holds.
flash_of() {
    {
        arm-none-eabi-nm --defined-only "$build/cortex-m4-16/libgnomon.a" | awk 'NF == 3 { print "core", $3 }'
        arm-none-eabi-nm -S "$build/cortex-m4-16/footprint/$1.elf" | awk 'NF == 4 { print "linked", $4, $2 }'
    } | awk -v limit="$2" '
        function hexadecimal(text,    value, i) {
            for (i = 1; i <= length(text); i++)
                value = 16 * value + index("0123456789abcdef", substr(text, i, 1)) - 1
            return value
        }
        $1 == "core" { core[$2] = 1 }
        $1 == "linked" && $2 in core { bytes += hexadecimal($3) }
        END {
            printf "Flash of the core %d bytes (at most %d)\n", bytes, limit
            exit bytes > limit
        }'
}

# ram_of PROGRAM
ram_of() {
    awk -v limit=$ram_limit '
        $1 == "ram" {
            printf "RAM: context %d + other statics %d + stack %d = %d bytes (at most %d)\n", $3, $5, $7, $9, limit
            fits = $9 <= limit
        }
        END {
            if (!fits)
                print "the footprint program failed or needs more"
            exit !fits
        }' "$build/cortex-m4-16/footprint/$1.txt"
}

echo "Cortex-M4, 1,000 triangles in flash, image 320 x 240, map 128 x 128, second depth, 16 bits:"
flash_of footprint $flash_limit || failed=1
ram_of footprint || failed=1
echo "The same by shadow volumes:"
flash_of footprint_volumes $volumes_flash_limit || failed=1
ram_of footprint_volumes || failed=1
exit $failed
