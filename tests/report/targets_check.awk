# Holds docs/report/targets.csv against what was measured anew.
#
#     awk -v instructions=N -v bytes=N -f targets_check.awk RECORDED FRESH
#
# Exit status 1 where a row is missing in either file, an error is larger than recorded, or bytes, flash or instructions
# have grown by more than 1 %. Flash and instructions count only where the compiler's version is the recorded one, and
# of FRESH only what is not empty. instructions, bytes: how many such figures there must be at least, so that nothing
# passes because nothing was measured; said at the end: how many were.

BEGIN { FS = "," }

FNR == 1 { file++ }

/^# / {
    target = $0
    sub(/^# /, "", target)
    sub(/:.*/, "", target)
    version[file, target] = $0
    next
}

!(file in names) {
    names[file] = $0
    columns = NF
    for (i = 1; i <= NF; i++)
        name[i] = $i
    next
}

{
    key = $1 " " $2 " " $3
    rows[file]++
    if (file == 1)
        recorded[key] = $0
    else
        compare(key)
}

function complain(text) {
    print text
    failed = 1
}

function target_of(column) {
    return column ~ /_(view|light|camera|pixel|flash)$/ ? substr(column, 1, match(column, /_[a-z]+$/) - 1) : ""
}

function compare(key,    was, i, target, allowed) {
    if (!(key in recorded)) {
        complain("not in the report: " key)
        return
    }
    split(recorded[key], was, ",")
    delete recorded[key]
    for (i = 4; i <= columns; i++) {
        target = target_of(name[i])
        if ($i == "" || (target && version[1, target] != version[2, target]))
            continue
        if (was[i] == "") {
            complain(key " " name[i] ": " $i ", nothing is recorded")
            continue
        }
        if (target)
            instructions_seen++
        else if (name[i] == "bytes")
            bytes_seen++
        allowed = target || name[i] ~ /bytes$/ ? was[i] * 1.01 : was[i]
        if (name[i] != "pixels" && $i + 0 > allowed + 0)
            complain(key " " name[i] ": " $i ", recorded " was[i])
        if (name[i] == "pixels" && $i != was[i])
            complain(key " pixels: " $i ", recorded " was[i])
    }
}

END {
    if (names[1] != names[2])
        complain("other columns: " names[1] "; " names[2])
    for (key in recorded)
        complain("not measured: " key)
    if (!rows[1])
        complain("nothing is recorded")
    if (bytes_seen < bytes)
        complain(bytes_seen + 0 " plans compared, expected " bytes)
    if (instructions_seen < instructions)
        complain(instructions_seen + 0 " instruction counts and flash sizes compared, expected " instructions)
    print rows[2] " rows, " bytes_seen + 0 " plans, " instructions_seen + 0 " instruction counts and flash sizes"
    exit failed
}
