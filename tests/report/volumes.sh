#!/bin/sh
# Compare shadow volumes with the exact truth, and say what they cost.
#
#     tests/report/volumes.sh GNOMON SCENE...
#
# Prints Markdown, a row a scene: pixels that see a surface; near a tie (truth differs 1/256 pixel beside the centre),
# in per cent; wrong near a tie; wrong elsewhere, which must be 0; silhouette edges; faces drawn; the overdraw factor O
# of Sen et al. 2003 (fragments of volumes over fragments of the scene). WORKERS in the environment: threads.
# Exit status: 0 equal wherever truth is not near a tie, and at most 0.3 % are near; 1 not so; 2 something could not be
# done.
set -eu

if [ $# -lt 2 ]; then
    echo "usage: tests/report/volumes.sh GNOMON SCENE..." >&2
    exit 2
fi
gnomon=$1
shift
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
trap 'exit 2' HUP INT TERM

# The first number of a name: outermost members come before those of the objects within.
number() {
    awk -v name="\"$2\":" '$1 == name { sub(/,$/, "", $2); print $2; exit }' "$1"
}

# The number of a name in the object "not_near".
elsewhere() {
    awk -v name="\"$2\":" '$1 == "\"not_near\":" { inside = 1 } inside && $1 == name { sub(/,$/, "", $2); print $2; exit }' "$1"
}

echo "| scene | surface | near, % | wrong near | wrong elsewhere | edges | faces | O |"
echo "|---|---|---|---|---|---|---|---|"
failed=0
for scene; do
    "$gnomon" truth "$scene" --mask "$work/truth.pgm" --near "$work/near.pgm" --workers "${WORKERS:-1}" >/dev/null || exit 2
    "$gnomon" render "$scene" --method volumes --mask "$work/mask.pgm" --stats "$work/stats.json" || exit 2
    "$gnomon" compare "$work/mask.pgm" "$work/truth.pgm" --near "$work/near.pgm" --json "$work/compare.json" \
        --max-error 100 --max-coverage 100 >/dev/null || exit 2
    c=$work/compare.json
    s=$work/stats.json
    wrong=$(($(number "$c" false_shadow) + $(number "$c" false_light)))
    apart=$(($(elsewhere "$c" false_shadow) + $(elsewhere "$c" false_light)))
    near=$(awk -F'[:,]' '/"near": *{/ { inside = 1 } inside && /"surface_pixels"/ { print $2 + 0; exit }' "$c")
    surface=$(number "$c" surface_pixels)
    printf '| %s | %d | %s | %d | %d | %d | %d | %.1f |\n' "$(basename "$scene" .scene)" "$surface" \
        "$(awk -v n="$near" -v s="$surface" 'BEGIN { printf "%.3f", 100 * n / s }')" $((wrong - apart)) $apart \
        "$(number "$s" silhouette_edges)" "$(number "$s" volume_faces)" "$(number "$s" overdraw)"
    if [ "$apart" -gt 0 ] || [ "$((1000 * near))" -gt "$((3 * surface))" ]; then
        failed=1
    fi
done
exit $failed
