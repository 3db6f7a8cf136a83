#!/bin/sh
# Prints what of the core and of the compiler's library each chain links on a target: `flash CHAIN BYTES`.
#
#     flash.sh BUILD TARGET TOOL FLAGS... <CHAINS
#
# CHAINS: their names, in the order of chains.c. Functions and tables that a program that renders by the chain refers
# to; without its own, memcpy and memset.
set -eu
build=$1
target=$2
tool=$3
shift 3
objects=$build/objects/$target/port
program=$build/report/$target.linked

number=0
while read -r name; do
    "${tool}gcc" "$@" -nostdlib -Wl,--gc-sections -Wl,-e,frame_$number -Wl,--no-warn-rwx-segments \
        "$objects/report/linked.o" "$build/$target/libgnomon.a" "$objects/memory.o" -lgcc -o "$program"
    "${tool}nm" -S "$program" | awk -v name="$name" '
        function hexadecimal(text,    value, i) {
            for (i = 1; i <= length(text); i++)
                value = 16 * value + index("0123456789abcdef", substr(text, i, 1)) - 1
            return value
        }
        NF == 4 && $4 !~ /^(frame_[0-9]+|memcpy|memset|memmove)$/ && !seen[$1 $2]++ { bytes += hexadecimal($2) }
        END { print "flash", name, bytes }'
    number=$((number + 1))
done
rm -f "$program"
