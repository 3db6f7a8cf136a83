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

# flash_of PROGRAM: the functions and tables of the archive that it holds.
flash_of() {
    {
        arm-none-eabi-nm --defined-only "$build/cortex-m4-16/libgnomon.a" | awk 'NF == 3 { print "core", $3 }'
        arm-none-eabi-nm -S "$build/cortex-m4-16/footprint/$1.elf" | awk 'NF == 4 { print "linked", $4, $2 }'
    } | awk '
        function hexadecimal(text,    value, i) {
            for (i = 1; i <= length(text); i++)
                value = 16 * value + index("0123456789abcdef", substr(text, i, 1)) - 1
            return value
        }
        $1 == "core" { core[$2] = 1 }
        $1 == "linked" && $2 in core { bytes += hexadecimal($3) }
        END { print bytes + 0 }'
}

# job TEXT PROGRAM [FLASH LIMIT]: one line. What the program printed says that it ran, and in how much RAM.
job() {
    flash=$(flash_of "$2")
    awk -v text="$1" -v flash="$flash" -v flash_limit="${3:-0}" -v ram_limit=$ram_limit '
        $1 == "ram" {
            printf "%-40s %6d%9s %8d %8d %6d %6d\n", text, flash, flash_limit ? flash_limit : "", $3, $5, $7, $9
            ran = 1
            fits = flash && (!flash_limit || flash <= flash_limit) && $9 <= ram_limit
        }
        END {
            if (!ran)
                print text ": the program failed"
            else if (!fits)
                print text ": EXCEEDED"
            exit !fits
        }' "$build/cortex-m4-16/footprint/$2.txt" || failed=1
}

# building TEXT PROGRAM: one line. What the light pass needs, by the rows of its regions.
building() {
    awk -v text="$1" '$1 == "building" { printf "%-36s %8d %11d %11d\n", text, $3, $5, $7; ran = 1 } END { exit !ran }' \
        "$build/cortex-m4-16/footprint/$2.txt" || failed=1
}

echo "Cortex-M4, 1,000 triangles in flash, image 320 x 240, 16 bits, bytes; at most $ram_limit of RAM"
printf '%-40s %6s%9s %8s %8s %6s %6s\n' "" flash "at most" context statics stack RAM
job "map 128 x 128, second depth, point" footprint $flash_limit
job "the same with virtual samples" footprint_virtual
job "with a bias by the receiver's plane" footprint_plane_bias
job "bilinear" footprint_bilinear
job "4 x 4 jitter" footprint_jitter
job "box 5 x 5" footprint_box
job "box 5 x 5 with virtual samples" footprint_virtual_box
job "mixed surfaces with virtual samples" footprint_mixed
job "the same with silhouettes, small regions" footprint_silhouette
job "the same with crossings, small regions" footprint_crossing
job "second depth, point, desired view" footprint_fit
job "msf+rectilinear, mixed, silhouettes" footprint_rectilinear
job "dv+nonorthogonal, map 80 x 80, virtual" footprint_nonorthogonal
job "map 96 x 96, static casters" footprint_static
job "shadow volumes" footprint_volumes $volumes_flash_limit
echo
echo "Silhouettes take $(($(flash_of footprint_silhouette) - $(flash_of footprint_mixed))) bytes of flash, \
crossings $(($(flash_of footprint_crossing) - $(flash_of footprint_mixed)))."
echo "Context while the map is made           whole  by 32 rows  by 16 rows"
building "mixed" footprint_mixed
building "mixed with silhouettes" footprint_silhouette
building "mixed with crossings" footprint_crossing
exit $failed
