#!/bin/sh
# every_stage_of_every_golden_scene_is_equal_on_every_target
set --
for target in $TARGET_DEPTHS; do
    set -- "$@" "$BUILD/hashes/$target.txt"
done
exec awk -f tests/golden/compare.awk tests/golden/hashes.txt "$@"
