#!/bin/sh
# The stack that the core needs is known: no recursion, no frame of unknown size, no unknown callee but the caller's
# flush; and what was measured by painting does not exceed what the call graph says.
. tests/tap.sh

analyse() {
    cat "$BUILD/objects/$1/core/"*.ci | awk -f tests/archive/stack.awk
}

# none TARGET WORD: no line of the analysis starts with the word.
none() {
    ! analyse "$1" | grep "^$2 "
}

only_flush_is_called_through_a_pointer() {
    ! analyse "$1" | grep '^indirect ' | grep -v -e '^indirect gn_camera_pass$' -e '^indirect gn_volumes_pass$' \
        -e '^indirect gn_point_pass$'
}

# Start-up calls main, and the exit asks the debugger, in the allowance.
measured_is_no_deeper() {
    allowance=128
    measured=$(awk '$1 == "memory" { print $5 }' "$BUILD/hashes/$1.txt")
    computed=$(cat "$BUILD/objects/$1/core/"*.ci "$BUILD/objects/$1/port/firmware.ci" \
        "$BUILD/objects/$1/port/methods.ci" |
        awk -f tests/archive/stack.awk | awk '$1 == "main" { print $2 }')
    echo "painted ${measured:-nothing}, computed $computed for main and all it calls"
    [ "${measured:-0}" -gt 0 ] && [ "$measured" -le $((computed + allowance)) ]
}

for target in $EMBEDDED_DEPTHS; do
    check "$target: no recursion" none "$target" recursion
    check "$target: every frame has a fixed size" none "$target" dynamic
    check "$target: every function that a pointer may mean is in the sum" none "$target" unreached
    check "$target: every pointer that the sum knows exists" none "$target" stale
    check "$target: only the flush callback is called through a pointer" only_flush_is_called_through_a_pointer "$target"
    check "$target: the stack in use was no deeper than the call graph says" measured_is_no_deeper "$target"
    echo "# $target: $(analyse "$target" | grep '^deepest ')"
done
finish
