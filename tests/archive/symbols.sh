#!/bin/sh
# What the core archive contains and calls, on every embedded target (all of them without floating-point hardware, so
# that any float would show as a call).
. tests/tap.sh

tool_of() {
    case $1 in
    cortex*) echo arm-none-eabi- ;;
    rv32*) echo riscv64-unknown-elf- ;;
    esac
}

# Helpers of libgcc that compute with integers: products, quotients, shifts, counts of bits; jump tables and register
# saving of the compilers.
integer_helpers='
    __aeabi_lmul __aeabi_idiv __aeabi_idivmod __aeabi_uidiv __aeabi_uidivmod __aeabi_ldivmod __aeabi_uldivmod
    __aeabi_llsl __aeabi_llsr __aeabi_lasr __aeabi_lcmp __aeabi_ulcmp
    __mulsi3 __muldi3 __divsi3 __udivsi3 __modsi3 __umodsi3 __divdi3 __udivdi3 __moddi3 __umoddi3
    __ashldi3 __ashrdi3 __lshrdi3 __clzsi2 __clzdi2 __ctzsi2 __ctzdi2
    __gnu_thumb1_case_sqi __gnu_thumb1_case_uqi __gnu_thumb1_case_shi __gnu_thumb1_case_uhi __gnu_thumb1_case_si'

# Symbols that the archive calls and does not define.
outside() {
    "$(tool_of "$1")nm" "$BUILD/$1/libgnomon.a" | awk '
        NF == 2 && $1 == "U" { called[$2] = 1 }
        NF == 3 { defined[$3] = 1 }
        END { for (name in called) if (!(name in defined)) print name }' | sort
}

# none_matches TARGET PATTERN: fails, and lists them, where names that the archive calls match.
none_matches() {
    ! outside "$1" | grep -E "$2"
}

float='^__aeabi_(f|d|h|c[fd]|i2|ui2|l2|ul2).*|^__(add|sub|mul|div|neg|eq|ne|lt|le|gt|ge|cmp|unord|fix|fixuns|float|floatun|extend|trunc|pow)[a-z]*[hsdtx]f[a-z0-9]*$|^(sin|cos|tan|sqrt|pow|floor|ceil|fabs|exp|log)f?$'
heap='^(malloc|calloc|realloc|free|aligned_alloc|posix_memalign|_?sbrk|alloca)$'

only_what_is_allowed() {
    outside "$1" | awk -v helpers="$integer_helpers memcpy memset memmove" '
        BEGIN { n = split(helpers, name); for (i = 1; i <= n; i++) allowed[name[i]] = 1 }
        !($1 in allowed) && $1 !~ /^__riscv_(save|restore)_/ { print; bad = 1 }
        END { exit bad }'
}

# Variables would make contexts depend on each other.
no_variables() {
    "$(tool_of "$1")size" -t "$BUILD/$1/libgnomon.a" | tail -n 1 | awk '{ print; exit $2 + $3 != 0 }'
}

has_functions() {
    "$(tool_of "$1")nm" "$BUILD/$1/libgnomon.a" | grep -q ' T gn_camera_pass$'
}

for target in $EMBEDDED_DEPTHS; do
    check "$target: the archive holds the core" has_functions "$target"
    check "$target: no float helper" none_matches "$target" "$float"
    check "$target: no heap" none_matches "$target" "$heap"
    check "$target: nothing from outside but memcpy, memset, memmove and integer helpers" only_what_is_allowed "$target"
    check "$target: no .data, no .bss" no_variables "$target"
    # shellcheck disable=SC2046
    echo "# $target calls" $(outside "$target")
done
finish
