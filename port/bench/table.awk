# Turns the counts of bench.c and edges.c into a table, one column a target.
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

function count(t, a) {
    if ((t, a) in counted)
        return counted[t, a]
    print "no count for " t " " a > "/dev/stderr"
    failed = 1
    exit
}

# Instructions of case a less those of case b.
function less(t, a, b) {
    return count(t, a) - count(t, b)
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

# A pixel that the first comparison decides: what a method adds to the nearest texel.
function added(t, where, method) {
    return pixel(t, where "-" method) - pixel(t, where "-point")
}

# Every pixel between four texels that disagree.
function open_pixel(t, with, without) {
    return pixel(t, "open-sun-" with) - pixel(t, "open-sun-" without)
}

# 352 more silhouette edges of the same triangles, in the same cells.
function drawn(t, how) {
    return less(t, how "-384", how "-32") / 352
}

# A vertex 0.3 texel from the centre of one both ways. An edge of n texels along an axis touches n + 1 cells; a diagonal
# one passes through the corners of cells, all four of which count: 3 n + 1. Of 352 edges 224 are along an axis.
function cells(texels) {
    return (224 * (texels + 1) + 128 * (3 * texels + 1)) / 352
}

# Of triangles that the light sees edge-on, what silhouettes cost: 176 edges more of the same 128, 128 more triangles.
function looked_at(t) {
    return less(t, "edge-on-lone-silhouette-128", "edge-on-silhouette-128") / (384 - 208)
}

function faced(t,    grid) {
    grid = less(t, "edge-on-silhouette-256", "edge-on-silhouette-128") - less(t, "edge-on-plain-256", "edge-on-plain-128")
    return (grid - 208 * looked_at(t)) / 128
}

# Light passes with silhouettes, percent of those without.
function light_share(t, scene, how) {
    return 100 * count(t, scene "-light-" how "-128") / count(t, scene "-light-plain-128")
}

function mean_light_share(t, how,    names, n, i, sum) {
    n = split("lshape torus2 table pipes pins fence", names, " ")
    for (i = 1; i <= n; i++)
        sum += light_share(t, names[i], how)
    return sum / n
}

function frame(t, a) {
    return count(t, a "-160") / (160 * 120)
}

function mean_frame(t, method,    names, n, i, sum) {
    n = split("lshape torus2 table pipes pins fence", names, " ")
    for (i = 1; i <= n; i++)
        sum += frame(t, names[i] "-" method)
    return sum / n
}

# 126 more triangles over the same pixels, by planes less by points.
function plane(t, light) {
    return (less(t, light "-virtual-128", light "-virtual-2") - less(t, light "-point-128", light "-point-2")) / 126
}

# What four more quads with two sides each add over half the columns; quads with a cap and a lid each, by volumes less
# by a map.
function side_fragment(t, how,    wide, narrow) {
    wide = less(t, "side-wide-" how "-8", "side-wide-" how "-4")
    narrow = less(t, "side-narrow-" how "-8", "side-narrow-" how "-4")
    return (wide - narrow) / (4 * 2 * 160 * 240)
}

function quads_behind(t, by) {
    return less(t, "cap-wide-" by "-8", "cap-wide-" by "-4") - less(t, "cap-narrow-" by "-8", "cap-narrow-" by "-4")
}

# Mean over the golden scenes of a step of a chain of fit and warp, 320 x 240.
function mean_step(t, chain, step,    names, n, i, sum) {
    n = split("lshape torus2 table pipes pins fence", names, " ")
    for (i = 1; i <= n; i++)
        sum += count(t, names[i] "-" chain "-" step "-320")
    return sum / n
}

# Every step of a view pass.
function mean_view(t, chain,    step, sum) {
    for (step = 1; step <= 3; step++)
        if ((t, "lshape-" chain "-round" step "-320") in counted)
            sum += mean_step(t, chain, "round" step) + mean_step(t, chain, "end" step)
    return sum ? sum + mean_step(t, chain, "begin") : 0
}

# view, light, camera or frame of whole frames, on that of the uniform map; rest: "silhouettes-" or empty.
function frames(t, chain, part, rest) {
    if (part == "frame")
        return mean_view(t, chain) + mean_step(t, chain, rest "light") + mean_step(t, chain, rest "camera")
    return part == "view" ? mean_view(t, chain) : mean_step(t, chain, rest part)
}

function figure(t, kind, a, b) {
    if (kind == "texel") return texel(t, a, b)
    if (kind == "map") return less(t, a "-320", a "-160") / (160 * 320)
    if (kind == "small") return less(t, a "-128", a "-64") / 64
    if (kind == "vertex") return less(t, "vertices-768", "vertices-384") / 384
    if (kind == "pixel") return pixel(t, a)
    if (kind == "added") return added(t, a, b)
    if (kind == "frame") return frame(t, a)
    if (kind == "step") return mean_step(t, a, b) / 1000
    if (kind == "view") return mean_view(t, a) / 1000
    if (kind == "of-uniform") return 100 * frames(t, a, b) / frames(t, "uniform", b)
    if (kind == "of-silhouettes") return 100 * frames(t, a, b, "silhouettes-") / frames(t, "uniform", b, "silhouettes-")
    if (kind == "pass") return count(t, a) / 1000
    if (kind == "mean") return mean_frame(t, a)
    if (kind == "plane") return plane(t, a)
    if (kind == "open") return open_pixel(t, a, b)
    if (kind == "drawn") return drawn(t, a)
    if (kind == "cell") return (drawn(t, a "-long") - drawn(t, a "-short")) / (cells(16) - cells(1))
    if (kind == "looked") return looked_at(t)
    if (kind == "faced") return faced(t)
    if (kind == "share") return a == "mean" ? mean_light_share(t, b) : light_share(t, a, b)
    if (kind == "side") return side_fragment(t, a)
    if (kind == "cap") return (quads_behind(t, "volumes") - quads_behind(t, "map")) / (4 * 2 * 160 * 240)
    # more silhouette edges of the same grid of 128 triangles
    if (kind == "edge") return less(t, a "-384", a "-32") / (384 - 32)
    if (kind == "facing") return less(t, a "-256", a "-128") / 128
    print "no figure is called " kind > "/dev/stderr"
    failed = 1
    exit
}

# One line: what it says, the most that the first target may take (empty: any), and the figure with what it is taken of.
function row(text, limit, kind, a, b,    i, over) {
    printf "%-54s", text
    for (i = 1; i <= target_count; i++)
        printf "%12.1f", figure(targets[i], kind, a, b)
    if (limit == "") {
        print ""
        return
    }
    over = figure(targets[1], kind, a, b) > limit
    printf "%12d%s\n", limit, over ? "  EXCEEDED" : ""
    if (over)
        failed = 1
}

END {
    print "Instructions (not cycles), 16-bit depth"
    printf "%-54s", ""
    for (i = 1; i <= target_count; i++)
        printf "%12s", targets[i]
    printf "%12s\n", "at most"

    row("texel, one layer, nearer than all before", 9, "texel", "one", "pass")
    row("texel, one layer, farther", "", "texel", "one", "fail")
    row("texel, two layers, nearer than all before", 15, "texel", "two", "pass")
    row("texel, two layers, farther than both", 15, "texel", "two", "fail")
    row("texel, slope, nearer than all before", "", "texel", "slope", "pass")
    row("texel, slope, farther", "", "texel", "slope", "fail")
    row("texel of the map, one layer: clear and resolve", "", "map", "one-map")
    row("texel of the map, two layers: clear and resolve", "", "map", "two-map")
    row("texel of the map, slope: clear and resolve", "", "map", "slope-map")
    row("triangle of 8 texels, one layer, all in", 650, "small", "one-small")
    row("triangle of 8 texels, two layers, all in", "", "small", "two-small")
    row("triangle of 8 texels, slope, all in", "", "small", "slope-small")
    row("triangle rejected: back face of a closed mesh", 45, "small", "rejected")
    row("vertex, light pass", "", "vertex")
    row("pixel, perspective, directional, RGB888", 80, "pixel", "perspective-directional-rgb888")
    row("pixel, perspective, directional, RGB565", 80, "pixel", "perspective-directional-rgb565")
    row("pixel, perspective, spot, RGB888", "", "pixel", "perspective-spot-rgb888")
    row("pixel, orthographic, directional, RGB888", "", "pixel", "orthographic-directional-rgb888")
    row("pixel, orthographic, spot, RGB888", "", "pixel", "orthographic-spot-rgb888")

    print "What a pixel costs over point and nearest where all texels agree"
    row("virtual samples, lit, directional", 14, "added", "lit-sun", "virtual")
    row("virtual samples, shadowed, directional", 14, "added", "dark-sun", "virtual")
    row("virtual samples, lit, spot", "", "added", "lit-spot", "virtual")
    row("virtual samples, shadowed, spot", "", "added", "dark-spot", "virtual")
    row("virtual samples always, lit", "", "added", "lit-sun", "virtual-always")
    row("plane bias, lit", "", "added", "lit-sun", "plane-bias")
    row("bilinear, lit", "", "added", "lit-sun", "bilinear")
    row("bilinear, shadowed", "", "added", "dark-sun", "bilinear")
    row("bilinear, virtual samples, lit", "", "added", "lit-sun", "bilinear-virtual")
    row("4x4 jitter, lit", "", "added", "lit-sun", "jitter4x4")
    row("3x3, lit", "", "added", "lit-sun", "pcf3")
    row("5x5, lit", "", "added", "lit-sun", "pcf5")
    row("7x7, lit", "", "added", "lit-sun", "pcf7")
    row("silhouettes, lit", "", "added", "lit-sun", "silhouette")
    row("silhouettes, virtual samples, lit", "", "added", "lit-sun", "silhouette-virtual")
    row("plane of a receiver, directional", "", "plane", "planes-sun")
    row("plane of a receiver, spot", "", "plane", "planes-spot")

    print "A pixel of the whole camera pass, mean over the six golden scenes, 160 x 120, map 128"
    row("point, nearest", "", "mean", "point")
    row("virtual samples", "", "mean", "virtual")
    row("virtual samples always", "", "mean", "virtual-always")
    row("plane bias", "", "mean", "plane-bias")
    row("bilinear", "", "mean", "bilinear")
    row("bilinear, virtual samples", "", "mean", "bilinear-virtual")
    row("4x4 jitter", "", "mean", "jitter4x4")
    row("4x4 jitter, virtual samples", "", "mean", "jitter4x4-virtual")
    row("3x3", "", "mean", "pcf3")
    row("5x5", "", "mean", "pcf5")
    row("5x5, virtual samples", "", "mean", "pcf5-virtual")
    row("7x7", "", "mean", "pcf7")
    row("silhouettes", "", "mean", "silhouette")
    row("silhouettes, virtual samples", "", "mean", "silhouette-virtual")
    row("smooth silhouettes, virtual samples", "", "mean", "smooth-virtual")
    row("crossings, virtual samples", "", "mean", "crossing-virtual")

    print "Silhouette maps: a pixel between four texels that disagree"
    row("virtual samples over point", "", "open", "virtual", "point")
    row("silhouettes over point", "", "open", "silhouette", "point")
    row("virtual samples and silhouettes over virtual samples", "", "open", "silhouette-virtual", "virtual")
    row("virtual samples and smooth silhouettes over these", "", "open", "smooth-virtual", "virtual")
    row("virtual samples and crossings over these", "", "open", "crossing-virtual", "virtual")
    print "and in the light pass"
    row("texel of the map, two layers and silhouettes", "", "map", "silhouette-map")
    row("triangle, facing", "", "faced")
    row("edge that is no silhouette", "", "looked")
    row("silhouette edge of 1 texel, 2.7 cells", "", "drawn", "drawn-short")
    row("silhouette edge of 16 texels, 28.6 cells", "", "drawn", "drawn-long")
    row("cell more of an edge, with its share of rows", "", "cell", "drawn")
    row("crossings: edge of 1 texel", "", "drawn", "crossing-short")
    row("crossings: edge of 16 texels", "", "drawn", "crossing-long")
    row("light pass, mixed, percent of that without: lshape", "", "share", "lshape", "silhouette")
    row("torus2", "", "share", "torus2", "silhouette")
    row("table", "", "share", "table", "silhouette")
    row("pipes", "", "share", "pipes", "silhouette")
    row("pins", "", "share", "pins", "silhouette")
    row("fence", "", "share", "fence", "silhouette")
    row("mean", "", "share", "mean", "silhouette")
    row("mean, crossings", "", "share", "mean", "crossing")

    print "Shadow volumes"
    row("a pixel of lshape's whole camera pass", 210, "frame", "lshape-volumes")
    row("by a map: the same", "", "frame", "lshape-point")
    row("a pixel of pins' whole camera pass", 2640, "frame", "pins-volumes")
    row("by a map: the same", "", "frame", "pins-point")
    row("side, a pixel compared, before it", 27, "side", "before")
    row("side, a pixel compared, behind it", 20, "side", "behind")
    row("cap or lid, a pixel", 6, "cap")
    row("silhouette edge, its rows found", 1930, "edge", "sides-off")
    row("the same, and a side within the screen", 7200, "edge", "sides-within")
    row("the same, and a side that leaves it", "", "edge", "sides-leaving")
    row("the same with side and lid, spot", "", "edge", "sides-spot")
    row("triangle, light pass, directional", 800, "facing", "facing-sun")
    row("triangle, light pass, spot", "", "facing", "facing-spot")

    print "Fits and warps: a round of the view pass, a pixel"
    for (warp = 1; warp <= split("dv msf rectilinear distance nonorthogonal", warp_row, " "); warp++)
        row(warp_row[warp] ", directional", "", "pixel", "sun-" warp_row[warp] "-round1")
    row("nonorthogonal, second round, directional", "", "pixel", "sun-nonorthogonal-round2")
    row("dv, spot", "", "pixel", "spot-dv-round1")
    row("rectilinear, spot", "", "pixel", "spot-rectilinear-round1")
    print "a pixel of the camera pass"
    for (receiver = 1; receiver <= split("point virtual silhouettes", receivers, " "); receiver++)
        for (warp = 1; warp <= split("uniform dv rectilinear nonorthogonal", warp_row, " "); warp++)
            if (receivers[receiver] != "silhouettes" || warp_row[warp] != "nonorthogonal")
                row(warp_row[warp] ", " receivers[receiver], "", "pixel", "room-" warp_row[warp] "-" receivers[receiver])
    print "and the light pass, as above on a uniform map"
    row("texel, rectilinear, one layer", "", "texel", "rectilinear-one", "pass")
    row("texel, rectilinear, two layers", "", "texel", "rectilinear-two", "pass")
    row("texel, nonorthogonal, one layer", "", "texel", "nonorthogonal-one", "pass")
    row("texel, nonorthogonal, two layers", "", "texel", "nonorthogonal-two", "pass")
    row("triangle of 8 texels, rectilinear, one layer", "", "small", "rectilinear-one-small")
    row("triangle of 8 texels, rectilinear, two layers", "", "small", "rectilinear-two-small")
    row("triangle of 8 texels, nonorthogonal, one layer", "", "small", "nonorthogonal-one-small")
    row("triangle of 8 texels, nonorthogonal, two layers", "", "small", "nonorthogonal-two-small")
    print "thousands, mean over the six golden scenes, 320 x 240, map 128, virtual samples"
    row("view pass begins: vertices, bins", "", "step", "dv", "begin")
    row("one round, dv", "", "step", "dv", "round1")
    row("fit, dv", "", "step", "dv", "end1")
    row("fit, msf: the hull and its rectangle", "", "step", "msf", "end1")
    row("tables, rectilinear by counts", "", "step", "rectilinear", "end1")
    row("tables, rectilinear by distance", "", "step", "distance", "end1")
    row("tables, nonorthogonal, bands", "", "step", "dv-nonorthogonal", "end2")
    row("tables, nonorthogonal, columns", "", "step", "dv-nonorthogonal", "end3")
    for (warp = 1; warp <= split("dv msf rectilinear msf-rectilinear dv-nonorthogonal", warp_row, " "); warp++)
        row("view pass, " warp_row[warp], "", "view", warp_row[warp])
    row("light pass, uniform", "", "step", "uniform", "light")
    row("camera pass, uniform", "", "step", "uniform", "camera")
    print "per cent of the uniform map's"
    for (warp = 1; warp <= split("dv msf rectilinear msf-rectilinear dv-nonorthogonal", warp_row, " "); warp++) {
        row(warp_row[warp] ": light pass", "", "of-uniform", warp_row[warp], "light")
        row("camera pass", "", "of-uniform", warp_row[warp], "camera")
        row("frame", "", "of-uniform", warp_row[warp], "frame")
    }
    row("silhouettes, msf-rectilinear: frame", "", "of-silhouettes", "msf-rectilinear", "frame")
    print "Static casters: light pass of pins, spot light; the lane and 11 pins stand, a ball rolls; thousands"
    for (map = 128; map <= 256; map *= 2) {
        for (surface = 1; surface <= split("second mixed", surfaces, " "); surface++) {
            row(surfaces[surface] " depth, map " map ": all objects", "", "pass", "ball-" surfaces[surface] "-all-" map)
            row("static objects drawn and kept, the ball inserted", "", "pass", "ball-" surfaces[surface] "-anew-" map)
            row("the ball inserted", "", "pass", "ball-" surfaces[surface] "-kept-" map)
        }
    }
    print "Limits are for " targets[1] ". Map: 320 x 320; pixels: screen-filling quad, half in shadow or all of one kind,"
    print "320 x 240 less 160 x 120."
    exit failed
}
