# Print the tables of accuracy.sh: figures.csv first, then lines of
# SCENE WARP MAP METHOD FALSE_SHADOW FALSE_LIGHT TOTAL COVERAGE.
BEGIN {
    method_count = split(methods, method)
    size_count = split(sizes, size)
}

# A method as tests/report/methods.sh names it.
function name_of(warp, how) {
    return warp == "none" ? how : warp "/" how
}

/^scene,/ { next }

# A line of figures.csv; of a method that it names every cell needs its own.
/,/ {
    split($0, field, ",")
    name = name_of(field[2], field[4])
    reference[field[1], field[3], name] = field[7]
    known[name] = 1
    compared = 1
    next
}

{
    if (!($1 in seen)) {
        seen[$1] = 1
        scene[++scene_count] = $1
    }
    name = name_of($2, $4)
    shadow[$1, $3, name] = $5
    light[$1, $3, name] = $6
    total[$1, $3, name] = $7
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

function signed(difference,    text) {
    text = sprintf("%+.3f", difference)
    return text == "-0.000" ? "+0.000" : text
}

# Compare the scenes' cells with their bars; keep the worst of a method.
function compare(map, name,    s, key, difference, share) {
    for (s = 1; s <= scene_count; s++) {
        key = scene[s] SUBSEP map SUBSEP name
        if (!(key in reference)) {
            print "no reference for " scene[s] ", map " map ", " name >"/dev/stderr"
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
            worst = sprintf("%s %d %s, %.0f %%", scene[s], map, signed(difference), 100 * share)
        }
    }
}

END {
    if (!scene_count) {
        print "no results" >"/dev/stderr"
        exit 2
    }

    print "Mean over the " scene_count " scenes, per cent of the pixels that see a surface: false shadow + false light = " \
        "total" (compared ? " (difference to double precision)" : "") "; by size of the map:"
    print ""
    line = "| method |"
    rule = "|---|"
    for (z = 1; z <= size_count; z++) {
        line = line " " size[z] " |"
        rule = rule "---|"
    }
    print line (compared ? " worst cell: difference, share of what is allowed |" : "")
    print rule (compared ? "---|" : "")
    for (m = 1; m <= method_count; m++) {
        line = "| " method[m] " |"
        worst_share = -1000
        for (z = 1; z <= size_count; z++) {
            ours = mean(total, size[z], method[m])
            line = line sprintf(" %.2f + %.2f = %.3f", mean(shadow, size[z], method[m]), mean(light, size[z], method[m]),
                                ours)
            if (method[m] in known) {
                means++
                compare(size[z], method[m])
                theirs = mean(reference, size[z], method[m])
                mark = ours > theirs * 1.03 + 0.01 ? " **over**" : ""
                over_count += mark != ""
                line = line " (" signed(ours - theirs) ")" mark
            }
            line = line " |"
        }
        print line (method[m] in known ? " " worst " |" : compared ? " - |" : "")
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
    if (compared && !means) {
        print "no method of the reference is among those measured" >"/dev/stderr"
        exit 2
    }
    if (compared)
        print over_count ? over_count " over the bar." : "All " means * scene_count " cells and " means + 0 \
            " means are within the bar."
    exit over_count > 0
}
