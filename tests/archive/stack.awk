# The most stack each public function can need, from gcc's call graph (-fcallgraph-info=su), read from standard input.
# Prints
#
#     FUNCTION BYTES           each function whose name starts with gn_, and main
#     deepest BYTES FUNCTION
#     recursion FUNCTION       a function that can come back to itself
#     dynamic FUNCTION         its frame has no fixed size
#     indirect FUNCTION        calls through a pointer that comes from outside: what it calls is not in the sum
#     outside FUNCTION         called, but not in the core
#
# A pointer within the core can only point at the static functions of its file that nothing calls by name: they count as
# called. A function outside the core counts as OUTSIDE bytes; the deepest, division of 64 bits in libgcc, takes less.

BEGIN { OUTSIDE = 96 }

# node: { title: "NAME" label: "..\nFILE..\nN bytes (static)" }
$1 == "node:" {
    name = quoted($0, "title: ")
    if (match($0, /[0-9]+ bytes \([a-z,]+/)) {
        text = substr($0, RSTART, RLENGTH)
        frame[name] = text + 0
        if (text !~ /\(static$/)
            print "dynamic", name
    }
}

# edge: { sourcename: "CALLER" targetname: "CALLED" .. }
$1 == "edge:" {
    caller = quoted($0, "sourcename: ")
    called = quoted($0, "targetname: ")
    if (!((caller, called) in edge)) {
        edge[caller, called] = 1
        calls[caller, ++call_count[caller]] = called
        has_caller[called] = 1
    }
}

function quoted(line, key,    rest) {
    rest = substr(line, index(line, key "\"") + length(key) + 1)
    return substr(rest, 1, index(rest, "\"") - 1)
}

# Let every call through a pointer reach the static functions (FILE:NAME) of its file that have no other caller.
function resolve_pointers(    caller, name, file, found) {
    for (caller in frame) {
        if (!((caller, "__indirect_call") in edge))
            continue
        file = caller
        found = 0
        if (sub(/:.*/, "", file)) {
            for (name in frame) {
                if (index(name, file ":") == 1 && !(name in has_caller)) {
                    calls[caller, ++call_count[caller]] = name
                    found = 1
                }
            }
        }
        if (!found)
            print "indirect", caller
    }
}

# Deepest stack of a function and all it calls.
function depth(name,    i, called, most, d) {
    if (name in known)
        return known[name]
    if (!(name in frame)) {
        if (name != "__indirect_call")
            print "outside", name
        return known[name] = OUTSIDE
    }
    if (name in open) {
        print "recursion", name
        return 0
    }
    open[name] = 1
    most = 0
    for (i = 1; i <= call_count[name]; i++) {
        called = calls[name, i]
        d = depth(called)
        if (d > most)
            most = d
    }
    delete open[name]
    return known[name] = frame[name] + most
}

END {
    resolve_pointers()
    for (name in frame) {
        bytes = depth(name)
        if (name ~ /^gn_/ || name == "main")
            print name, bytes
        if (bytes > deepest && name != "main") {
            deepest = bytes
            deepest_name = name
        }
    }
    print "deepest", deepest, deepest_name
}
