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

# What four more quads with two sides each add over half the columns; quads with a cap and
# a lid each, by volumes less by a map.
function side_fragment(t, how,    wide, narrow) {
    wide = less(t, "side-wide-" how "-8", "side-wide-" how "-4")
    narrow = less(t, "side-narrow-" how "-8", "side-narrow-" how "-4")
    return (wide - narrow) / (4 * 2 * 160 * 240)
}

function quads_behind(t, by) {
    return less(t, "cap-wide-" by "-8", "cap-wide-" by "-4") - less(t, "cap-narrow-" by "-8", "cap-narrow-" by "-4")
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
    if (row == 15) return pixel(t, "orthographic-spot-rgb888")
    if (row == 16) return counted[t, "lshape-volumes-160"] / (160 * 120)
    if (row == 17) return counted[t, "lshape-map-160"] / (160 * 120)
    if (row == 18) return counted[t, "pins-volumes-160"] / (160 * 120)
    if (row == 19) return counted[t, "pins-map-160"] / (160 * 120)
    if (row == 20) return side_fragment(t, "before")
    if (row == 21) return side_fragment(t, "behind")
    if (row == 22) return (quads_behind(t, "volumes") - quads_behind(t, "map")) / (4 * 2 * 160 * 240)
    # 352 more silhouette edges from the same grid of 128 triangles
    if (row == 23) return less(t, "sides-off-384", "sides-off-32") / 352
    if (row == 24) return less(t, "sides-within-384", "sides-within-32") / 352
    if (row == 25) return less(t, "sides-leaving-384", "sides-leaving-32") / 352
    if (row == 26) return less(t, "sides-spot-384", "sides-spot-32") / 352
    if (row == 27) return less(t, "facing-sun-256", "facing-sun-128") / 128
    return less(t, "facing-spot-256", "facing-spot-128") / 128
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
    label(15, "pixel, orthographic, spot, RGB888")
    label(16, "volumes: a pixel of lshape's whole camera pass", 210)
    label(17, "a map: the same")
    label(18, "volumes: a pixel of pins' whole camera pass", 2640)
    label(19, "a map: the same")
    label(20, "volumes: side, a pixel compared, before it", 27)
    label(21, "volumes: side, a pixel compared, behind it", 20)
    label(22, "volumes: cap or lid, a pixel", 6)
    label(23, "volumes: silhouette edge, its rows found", 1930)
    label(24, "volumes: the same, and a side within the screen", 7200)
    label(25, "volumes: the same, and a side that leaves it")
    label(26, "volumes: the same with side and lid, spot")
    label(27, "volumes: triangle, light pass, directional", 800)
    rows = 28
    label(28, "volumes: triangle, light pass, spot")

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
