# For shell tests of the simulator: from the project's folder, with $gnomon and a $folder of their own, which is removed
# at the end. Brings tests/tap.sh. GNOMON: the simulator.
# shellcheck shell=sh
cd "$(dirname "$0")/../.." || exit 1
. tests/tap.sh

gnomon=${GNOMON:-build/gnomon}
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

# Neither what refused commands were told to write, which tests call new, nor temporaries (host/file.h).
nothing_left() {
    left=$(find "$folder" -name 'new*' -o -name '.[0-9]*')
    [ -z "$left" ] || { echo "left behind: $left"; return 1; }
}
