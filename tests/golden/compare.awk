# Compares the stage hashes of all targets with the golden ones and with each other. Prints TAP, one test a stage, and
# one that shadow volumes, which store no depth, and warps, which are made before one is stored, do not depend on its
# bits.
#
#     awk -f compare.awk hashes.txt TARGET-DEPTH.txt ...
#
# hashes.txt: lines `DEPTH SCENE METHOD STAGE HASH`; the others: what the firmware printed, `hash SCENE METHOD STAGE HASH`.

FNR == 1 {
    file++
    target = FILENAME
    sub(/.*\//, "", target)
    sub(/\.txt$/, "", target)
    depth = target
    sub(/.*-/, "", depth)
    sub(/-[0-9]+$/, "", target)
    if (file > 1)
        targets[depth] = targets[depth] " " target
}

/^#/ { next }

FILENAME == ARGV[1] {
    key = $1 " " $2 " " $3 " " $4
    golden[key] = $5
    if (!(key in known))
        keys[++key_count] = key
    known[key] = 1
    next
}

$1 == "hash" {
    key = depth " " $2 " " $3 " " $4
    if (!(key in known))
        keys[++key_count] = key
    known[key] = 1
    found[key, target] = $5
}

$1 == "error" { errors[depth " " target] = $0 }

# One test: every target of the key's depth has the golden hash. Without one, the first target's.
function compare(number, key,    part, names, n, i, wrong, expected) {
    split(key, part, " ")
    n = split(targets[part[1]], names, " ")
    wrong = key in golden ? "" : "\n#   not among the golden hashes"
    expected = key in golden ? golden[key] : found[key, names[1]]
    for (i = 1; i <= n; i++) {
        if (!((key, names[i]) in found))
            wrong = wrong "\n#   " names[i] ": missing"
        else if (found[key, names[i]] != expected)
            wrong = wrong "\n#   " names[i] ": got " found[key, names[i]] ", expected " expected
    }
    printf "%s %d - %s bits, %s, %s, %s: %s on%s%s\n", wrong == "" ? "ok" : "not ok", number, part[1], part[2], part[3],
        part[4], expected, targets[part[1]], wrong
    return wrong != ""
}

function compare_depths(number,    i, other, wrong, count) {
    for (i = 1; i <= key_count; i++) {
        other = keys[i]
        if (other !~ /^16 [^ ]+ volumes/ && other !~ /^16 .* warp$/)
            continue
        sub(/^16/, "32", other)
        count++
        if (hash_of(keys[i]) == "" || hash_of(keys[i]) != hash_of(other))
            wrong = wrong "\n#   " keys[i] ": " hash_of(keys[i]) ", with 32 bits: " hash_of(other)
    }
    printf "%s %d - shadow volumes and warps do not depend on the bits of a depth%s\n", wrong == "" && count ? "ok" : "not ok",
        number, wrong
    return wrong != "" || !count
}

# What the first target of the key's depth printed.
function hash_of(key,    part, names) {
    split(key, part, " ")
    split(targets[part[1]], names, " ")
    return found[key, names[1]]
}

END {
    for (i = 1; i <= key_count; i++)
        failed += compare(i, keys[i])
    failed += compare_depths(i++)
    for (e in errors) {
        print "not ok " i++ " - " e ": " errors[e]
        failed++
    }
    if (key_count == 0) {
        print "not ok " i++ " - there are hashes to compare"
        failed++
    }
    print "1.." i - 1
    exit failed > 0
}
