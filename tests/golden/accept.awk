# Makes the file of golden hashes out of what the firmware printed.
#
#     awk -f accept.awk TARGET-16.txt TARGET-32.txt >hashes.txt

BEGIN {
    print "# DEPTH SCENE METHOD STAGE HASH. Written by `make accept-hashes`; changes only together with GN_BITS_VERSION and a"
    print "# line in docs/changes.md that says why."
}
FNR == 1 {
    depth = FILENAME
    sub(/\.txt$/, "", depth)
    sub(/.*-/, "", depth)
}
$1 == "hash" { print depth, $2, $3, $4, $5 }
