# Turns docs/report/targets.csv into docs/report/README.md: means over the scenes, a row a chain.
#
#     awk -f targets_table.awk targets.csv

BEGIN { FS = "," }

# `# TARGET: VERSION`, of each that was counted
/^# / {
    versions[++target_count] = substr($0, 3)
    targets[target_count] = substr($0, 3, index($0, ":") - 3)
    next
}

!columns {
    for (columns = 1; columns <= NF; columns++)
        column[$columns] = columns
    next
}

{
    if (!seen_chain[$2]++)
        chains[++chain_count] = $2
    if (!seen_scene[$1]++)
        scenes = scenes (scenes ? ", " : "") $1
    key = $2 SUBSEP $3
    count[key]++
    for (name in column)
        sum[key, name] += $column[name]
}

function mean(chain, map, name) {
    return sum[chain, map, name] / count[chain, map]
}

# Shadow volumes have one row, of map 0.
function map_of(chain, map) {
    return (chain, 0) in count ? 0 : map
}

function thousands(number,    text, out) {
    text = sprintf("%.0f", number)
    for (out = ""; length(text) > 3; text = substr(text, 1, length(text) - 3))
        out = "," substr(text, length(text) - 2) out
    return text out
}

function header(    i) {
    printf "| chain |"
    for (i = 1; i <= target_count; i++)
        printf " %s |", targets[i]
    printf "\n|---|"
    for (i = 1; i <= target_count; i++)
        printf "---|"
    printf "\n"
}

# One table: a figure of every target, over `unit`.
function by_target(title, figure, map, unit,    c, t, m) {
    printf "\n## %s\n\n", title
    header()
    for (c = 1; c <= chain_count; c++) {
        m = map_of(chains[c], map)
        printf "| %s |", chains[c]
        for (t = 1; t <= target_count; t++)
            printf " %s |", thousands(mean(chains[c], m, targets[t] "_" figure) / unit)
        printf "\n"
    }
}

END {
    print "# Every chain on small targets"
    print ""
    print "Means over the golden scenes (" scenes "), image 160 x 120, 16 bits of depth. Written by `make report` from"
    print "[targets.csv](targets.csv), which has every scene, both maps, every pass; [index.html](index.html) shows errors"
    print "against bytes and against instructions on Cortex-M4 (open it from the disk). Instructions, not cycles, counted"
    print "under QEMU. Chains are those of `gnomon sweep` ([sweep.md](../sweep.md))."
    print ""
    print "Compilers:"
    print ""
    for (i = 1; i <= target_count; i++)
        print "    " versions[i]
    print ""
    print "## Error and memory"
    print ""
    print "Error: wrong pixels, % of those that see a surface, against the exact truth; filters: mean absolute error, % of"
    print "white. Bytes of the whole context, of which the map and what belongs to it stay between the passes."
    print ""
    print "| chain | wrong, map 64 | map 128 | mean absolute error, map 128 | context, map 64 | map 128 | of it stay, map 128 |"
    print "|---|---|---|---|---|---|---|"
    for (c = 1; c <= chain_count; c++) {
        chain = chains[c]
        printf "| %s | %.2f | %.2f | %.2f | %s | %s | %s |\n", chain, mean(chain, map_of(chain, 64), "error"),
            mean(chain, map_of(chain, 128), "error"), mean(chain, map_of(chain, 128), "mean_absolute_error"),
            thousands(mean(chain, map_of(chain, 64), "bytes")), thousands(mean(chain, map_of(chain, 128), "bytes")),
            thousands(mean(chain, map_of(chain, 128), "resident_bytes"))
    }
    by_target("Instructions a pixel, all passes, map 128", "pixel", 128, 1)
    by_target("View pass, thousands of instructions a frame, map 128", "view", 128, 1000)
    by_target("Light pass, thousands of instructions a frame, map 128", "light", 128, 1000)
    by_target("Camera pass, thousands of instructions a frame, map 128", "camera", 128, 1000)
    by_target("Flash, bytes", "flash", 128, 1)
    print ""
    print "Flash: what of the core and of the compiler's library a program links that renders by this chain alone."
}
