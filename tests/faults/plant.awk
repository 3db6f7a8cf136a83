# Plants one fault of tests/faults/list.txt in a copy of its file. Exit status 1, and the reason on standard error, where
# a text that it replaces does not stand in the file exactly once.
#
#     awk -v number=N -f plant.awk list.txt FILE >CHANGED

function complain(text) {
    printf "tests/faults/list.txt: '%s' no longer applies to %s: %s; bring the list up to date\n", name, FILENAME,
        text | "cat 1>&2"
    failed = 1
}

# How often the text stands in a line.
function count(line, text,    n, at) {
    while ((at = index(line, text)) > 0) {
        n++
        line = substr(line, at + length(text))
    }
    return n + 0
}

FNR == 1 { file++ }

file == 1 && /^[^ #]/ { block++ }
file == 1 && block == number {
    if (/^[^ #]/)
        name = $0
    else if (/^    -/)
        old[++changes] = substr($0, 6)
    else if (/^    \+/)
        new[changes] = substr($0, 6)
}
file == 1 { next }

{
    line = $0
    for (i = 1; i <= changes; i++) {
        found[i] += count(line, old[i])
        at = index($0, old[i])
        if (at && index(line, old[i]))
            $0 = substr($0, 1, at - 1) new[i] substr($0, at + length(old[i]))
    }
    print
}

END {
    if (!changes)
        complain("nothing to replace")
    for (i = 1; i <= changes; i++)
        if (found[i] != 1)
            complain("'" old[i] "' stands there " found[i] + 0 " times, expected once")
    exit failed
}
