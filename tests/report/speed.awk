# Print the table of speed.sh from lines of: WHO SCENE METHOD PART MEDIAN LEAST TRIANGLES, one a round.
{
    if (!(($2, $3) in seen)) {
        seen[$2, $3] = 1
        row[++row_count] = $2 SUBSEP $3
    }
    if ($7)
        triangles[$2] = $7
    key = $1 SUBSEP $2 SUBSEP $3 SUBSEP $4
    n = ++count[key]
    median[key, n] = $5 + 0
    if (n == 1 || $6 + 0 < least[key])
        least[key] = $6 + 0
}

# The median of the rounds' medians.
function middle(key,    n, i, j, t, sorted) {
    n = count[key]
    for (i = 1; i <= n; i++) {
        t = median[key, i]
        for (j = i; j > 1 && sorted[j - 1] > t; j--)
            sorted[j] = sorted[j - 1]
        sorted[j] = t
    }
    return n % 2 ? sorted[(n + 1) / 2] : (sorted[n / 2] + sorted[n / 2 + 1]) / 2
}

function key_of(who, r, part) {
    return who SUBSEP row[r] SUBSEP part
}

function times(who, r) {
    return sprintf("%.1f + %.1f = %.1f", least[key_of(who, r, "light")], least[key_of(who, r, "camera")],
                   least[key_of(who, r, "total")])
}

function ratio(r, part) {
    return least[key_of("ours", r, part)] / least[key_of("peer", r, part)]
}

END {
    if (!row_count) {
        print "no times" >"/dev/stderr"
        exit 2
    }
    print "| scene (triangles) | method | llvmpipe: light + camera = total | gnomon | ratio light | ratio camera | **ratio total** |" \
        " ratio of medians |"
    print "|---|---|---|---|---|---|---|---|"
    for (r = 1; r <= row_count; r++) {
        split(row[r], name, SUBSEP)
        total = ratio(r, "total")
        over += total > limit
        printf "| %s (%d) | %s | %s | %s | %.2f | %.2f | **%.2f** | %.2f |\n", name[1], triangles[name[1]], name[2],
            times("peer", r), times("ours", r), ratio(r, "light"), ratio(r, "camera"), total,
            middle(key_of("ours", r, "total")) / middle(key_of("peer", r, "total"))
    }
    print ""
    printf "%d rounds, least times in milliseconds. ", count[key_of("ours", 1, "total")]
    print over ? over " totals are over " limit "." : "Every total is within " limit " of llvmpipe's."
    exit over > 0
}
