# Turns the counts of bench.c into a table, one column a target.
#
#     awk -f table.awk TARGET.count ...
#
# A file holds what the program printed (`case NAME`) and what the plugin printed (`region K instructions N`), one line
# each a case, in the same order. Exit status 1 where a figure of the first target exceeds its limit.

FNR == 1 {
    target = FILENAME
    sub(/.*\//, "", target)
    sub(/\.count$/, "", target)
    targets[++target_count] = target
    cases = 0
}
$1 == "case" { name[cases++] = $2 }
$1 == "region" { counted[target, name[$2]] = $4 }

# Instructions of case a less those of case b.
function less(t, a, b) {
    if (!((t, a) in counted) || !((t, b) in counted)) {
        print "no count for " t " " a " or " b > "/dev/stderr"
        failed = 1
        exit
    }
    return counted[t, a] - counted[t, b]
}

# Four more quads over 320 columns, less four more over 160: rows, edges and set-up cancel.
function texel(t, layers, how,    wide, narrow) {
    wide = less(t, layers "-wide-" how "-8", layers "-wide-" how "-4")
    narrow = less(t, layers "-narrow-" how "-8", layers "-narrow-" how "-4")
    return (wide - narrow) / (4 * 160 * 320)
}

function pixel(t, view) {
    return less(t, view "-320", view "-160") / (320 * 240 - 160 * 120)
}

function figure(t, row) {
    if (row == 1) return texel(t, "one", "pass")
    if (row == 2) return texel(t, "one", "fail")
    if (row == 3) return texel(t, "two", "pass")
    if (row == 4) return texel(t, "two", "fail")
    if (row == 5) return less(t, "one-map-320", "one-map-160") / (160 * 320)
    if (row == 6) return less(t, "two-map-320", "two-map-160") / (160 * 320)
    if (row == 7) return less(t, "one-small-128", "one-small-64") / 64
    if (row == 8) return less(t, "two-small-128", "two-small-64") / 64
    if (row == 9) return less(t, "rejected-128", "rejected-64") / 64
    if (row == 10) return less(t, "vertices-768", "vertices-384") / 384
    if (row == 11) return pixel(t, "perspective-directional-rgb888")
    if (row == 12) return pixel(t, "perspective-directional-rgb565")
    if (row == 13) return pixel(t, "perspective-spot-rgb888")
    if (row == 14) return pixel(t, "orthographic-directional-rgb888")
    return pixel(t, "orthographic-spot-rgb888")
}

function label(row, text, limit) {
    labels[row] = text
    limits[row] = limit
}

END {
    if (failed)
        exit 1
    label(1, "texel, one layer, nearer than all before", 9)
    label(2, "texel, one layer, farther")
    label(3, "texel, two layers, nearer than all before", 15)
    label(4, "texel, two layers, farther than both", 15)
    label(5, "texel of the map, one layer: clear and resolve")
    label(6, "texel of the map, two layers: clear and resolve")
    label(7, "triangle of 8 texels, one layer, all in", 650)
    label(8, "triangle of 8 texels, two layers, all in")
    label(9, "triangle rejected: back face of a closed mesh", 45)
    label(10, "vertex, light pass")
    label(11, "pixel, perspective, directional, RGB888", 80)
    label(12, "pixel, perspective, directional, RGB565", 80)
    label(13, "pixel, perspective, spot, RGB888")
    label(14, "pixel, orthographic, directional, RGB888")
    rows = 15
    label(15, "pixel, orthographic, spot, RGB888")

    print "Instructions (not cycles), 16-bit depth"
    printf "%-50s", ""
    for (i = 1; i <= target_count; i++)
        printf "%12s", targets[i]
    printf "%12s\n", "at most"
    for (row = 1; row <= rows; row++) {
        printf "%-50s", labels[row]
        for (i = 1; i <= target_count; i++)
            printf "%12.1f", figure(targets[i], row)
        if (limits[row] == "") {
            print ""
            continue
        }
        over = figure(targets[1], row) > limits[row]
        printf "%12d%s\n", limits[row], over ? "  EXCEEDED" : ""
        if (over)
            failed = 1
    }
    print "Limits are for " targets[1] ". Map: 320 x 320; pixels: screen-filling quad, half in shadow, 320 x 240 less 160 x 120."
    exit failed
}
