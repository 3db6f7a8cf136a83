# Print the tables of accuracy.sh: figures.csv first, then lines of
# SCENE WARP MAP METHOD FALSE_SHADOW FALSE_LIGHT TOTAL COVERAGE.
BEGIN {
    method_count = split(methods, method)
    size_count = split(sizes, size)
}

/^scene,/ { next }

/,/ {
    split($0, field, ",")
    if (field[2] == "none")
        reference[field[1], field[3], field[4]] = field[7]
    next
}

{
    if (!($1 in seen)) {
        seen[$1] = 1
        scene[++scene_count] = $1
    }
    shadow[$1, $3, $4] = $5
    light[$1, $3, $4] = $6
    total[$1, $3, $4] = $7
    if ($8 > coverage)
        coverage = $8
}

function larger(a, b) {
    return a > b ? a : b
}

# The mean of one column over the scenes.
function mean(values, map, name,    s, sum) {
    for (s = 1; s <= scene_count; s++)
        sum += values[scene[s], map, name]
    return sum / scene_count
}

END {
    if (!scene_count) {
        print "no results" >"/dev/stderr"
        exit 2
    }
    compared = (scene[1], size[1], method[1]) in reference

    print "Mean over the " scene_count " scenes, per cent of the pixels that see a surface:"
    print ""
    line = "| method | map | false shadow | false light | total |"
    rule = "|---|---|---|---|---|"
    if (compared) {
        line = line " double precision | difference | worst scene: difference, share of what is allowed |"
        rule = rule "---|---|---|"
    }
    print line
    print rule
    for (m = 1; m <= method_count; m++)
        for (z = 1; z <= size_count; z++) {
            line = sprintf("| %s | %s | %.3f | %.3f | %.3f |", method[m], size[z], mean(shadow, size[z], method[m]),
                           mean(light, size[z], method[m]), mean(total, size[z], method[m]))
            if (compared) {
                worst_share = -1000
                for (s = 1; s <= scene_count; s++) {
                    key = scene[s] SUBSEP size[z] SUBSEP method[m]
                    if (!(key in reference)) {
                        print "no reference for " scene[s] ", map " size[z] ", " method[m] >"/dev/stderr"
                        exit 2
                    }
                    difference = total[key] - reference[key]
                    share = difference / larger(0.05, 0.04 * reference[key])
                    if (share > 1) {
                        over[key] = 1
                        over_count++
                    }
                    if (share > worst_share) {
                        worst_share = share
                        worst = sprintf("%s %+.3f, %.0f %%", scene[s], difference, 100 * share)
                    }
                }
                ours = mean(total, size[z], method[m])
                theirs = mean(reference, size[z], method[m])
                mark = ours > theirs * 1.03 + 0.01 ? " **over**" : ""
                over_count += mark != ""
                line = line sprintf(" %.3f | %+.3f%s | %s |", theirs, ours - theirs, mark, worst)
            }
            print line
        }

    print ""
    print "Per scene, total per cent" (compared ? "; a cell over its bar is bold, with the figure of double precision" : "") ":"
    print ""
    line = "| method | map |"
    rule = "|---|---|"
    for (s = 1; s <= scene_count; s++) {
        line = line " " scene[s] " |"
        rule = rule "---|"
    }
    print line
    print rule
    for (m = 1; m <= method_count; m++)
        for (z = 1; z <= size_count; z++) {
            line = "| " method[m] " | " size[z] " |"
            for (s = 1; s <= scene_count; s++) {
                key = scene[s] SUBSEP size[z] SUBSEP method[m]
                line = line (key in over ? sprintf(" **%.2f** (%.2f) |", total[key], reference[key]) \
                                         : sprintf(" %.2f |", total[key]))
            }
            print line
        }

    print ""
    print "At most " coverage + 0 " pixels of a scene see a surface in one of the two masks only."
    if (compared)
        print over_count ? over_count " over the bar." : "All " method_count * size_count * scene_count \
            " cells and " method_count * size_count " means are within the bar."
    exit over_count > 0
}
