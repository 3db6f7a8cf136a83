#!/bin/sh
# the_smallest_program_draws_the_same_picture_everywhere
. tests/tap.sh

for target in $MINIMAL_DEPTHS; do
    check "the smallest program draws the expected picture on $target" \
        diff tests/port/minimal_main.expected "$BUILD/$target/minimal_main.txt"
done

picture_in_the_manual() {
    sed -n '/<!-- minimal_main -->/,/<!-- end -->/p' docs/porting.md | sed '1,2d;$d' | sed '$d' |
        diff tests/port/minimal_main.expected -
}
check "docs/porting.md shows that picture" picture_in_the_manual
finish
