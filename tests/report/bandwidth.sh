#!/bin/sh
# How many pixels silhouette maps decide, and the bandwidth model of Sen et al. 2003, section 4.
#
#     tests/report/bandwidth.sh GNOMON SCENE... [-- SIZE...]
#
# Prints Markdown, a row a scene: P, the share of shaded pixels whose four texels disagree, in per cent, for each SIZE of
# the map (64 128 256 512 1024); then for a map of 512 the bytes a pixel reads, over those of a plain shadow map: in the
# paper's model 4 + 24 P bytes against 4, in our own formats; then O, the overdraw of shadow volumes, and their bytes over
# those of a shadow map, 5.5 O against 4. Method: silhouette.
set -eu

sizes="64 128 256 512 1024"
gnomon=${1:-}
scenes=
if [ $# -gt 0 ]; then shift; fi
while [ $# -gt 0 ]; do
    if [ "$1" = -- ]; then
        shift
        sizes=$*
        break
    fi
    scenes="$scenes
$1"
    shift
done
if [ -z "$scenes" ] || [ -z "$sizes" ]; then
    echo "usage: tests/report/bandwidth.sh GNOMON SCENE... [-- SIZE...]" >&2
    exit 2
fi
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
trap 'exit 2' HUP INT TERM

# number NAME: of the statistics.
number() {
    awk -v name="\"$1\":" '$1 == name { sub(/,$/, "", $2); print $2; exit }' "$work/stats.json"
}

header="| scene |"
rule="|---|"
for size in $sizes; do
    header="$header P $size |"
    rule="$rule---|"
done
echo "$header ratio at 512, the paper's | ours | O | ratio of volumes |"
echo "$rule---|---|---|---|"
echo "$scenes" | while read -r scene; do
    [ -n "$scene" ] || continue
    line="| $(basename "$scene" .scene) |"
    for size in $sizes; do
        "$gnomon" render "$scene" --method silhouette --map "$size" --stats "$work/stats.json" </dev/null || exit 2
        line="$line $(printf %.1f "$(number silhouette_percent)") |"
    done
    "$gnomon" render "$scene" --method silhouette --map 512 --stats "$work/stats.json" </dev/null || exit 2
    line="$line $(printf '%.2f | %.2f' "$(number ratio)" "$(number own_ratio)") |"
    "$gnomon" render "$scene" --method volumes --stats "$work/stats.json" </dev/null || exit 2
    echo "$line $(printf '%.1f | %.1f' "$(number overdraw)" "$(number ratio)") |"
done
