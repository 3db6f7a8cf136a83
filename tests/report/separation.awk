# How far apart the surfaces of a scene lie in the map's depths: figure 6 of Wang & Molnar, drawn from the pixels of a frame
# (points.csv of slices.c).
#
#     awk -F , -v texel=UNITS -v title=TEXT -v picture=FILE.svg -f separation.awk points.csv
#
# UNITS: of the map a texel, as slices.c says. A pixel's difference is its own depth less the stored one, in texels. Three
# kinds: lit in truth; turned away from the light; shadowed in truth and turned to the light. Drawn: a body for each, as thick
# as the logarithm of the pixels at a difference; left of the line at 0 a pixel is lit, right of it shadowed. Printed: of each
# kind its share to the right of 0, and the differences between which 98 of 100 pixels lie.
function place(d) { # of a difference: linear about 0, then logarithms; 64 texels at the border
    size = d < 0 ? -d : d
    way = log(1 + 8 * size) / log(1 + 8 * 64)
    way = way > 1 ? 1 : way
    return 240 + (d < 0 ? -way : way) * 220
}

FNR == 1 || $6 == 65535 { next }
{
    kind = $7 == 0 ? 2 : $8 ? 1 : 3
    d = ($5 - $6) / texel
    bin = int(place(d) / 4)
    bins[kind, bin]++
    if (bins[kind, bin] > most) most = bins[kind, bin]
    all[kind]++
    beyond[kind] += $5 > $6
    fine = int(d * 100 + (d < 0 ? -.5 : .5)) # hundredths of a texel
    count[kind, fine]++
    if (fine < least[kind]) least[kind] = fine
    if (fine > largest[kind]) largest[kind] = fine
}

function quantile(kind, share,    sum, fine) {
    for (fine = least[kind]; fine <= largest[kind]; fine++) {
        sum += count[kind, fine]
        if (sum >= share * all[kind]) return fine / 100
    }
}

END {
    name[1] = "lit"
    name[2] = "turned away"
    name[3] = "shadowed, turned to the light"
    print "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 480 230\" width=\"480\" height=\"230\" " \
        "font-family=\"sans-serif\" font-size=\"12\"><rect width=\"480\" height=\"230\" fill=\"#fff\"/>" >picture
    print "<text x=\"8\" y=\"16\" font-weight=\"bold\">" title "</text>" >picture
    for (kind = 1; kind <= 3; kind++) {
        middle = 62 + 56 * (kind - 1)
        path = ""
        for (bin = 0; bin < 120; bin++) {
            high = (kind, bin) in bins ? 22 * log(1 + bins[kind, bin]) / log(1 + most) : 0
            if (high) path = path sprintf("M%d %.1fv%.1f", 4 * bin + 2, middle - high, 2 * high)
        }
        print "<path stroke=\"" (kind == 1 ? "#e0a000" : kind == 2 ? "#999" : "#222") "\" stroke-width=\"4\" d=\"" path "\"/>" >picture
        print "<text x=\"8\" y=\"" middle - 26 + (kind > 1 ? 6 : 8) "\">" name[kind] "</text>" >picture
        if (all[kind])
            printf "%s: %s: %d pixels, beyond the stored depth %.2f %%; 98 of 100 at %.2f to %.2f texels\n", title, name[kind],
                all[kind], 100 * beyond[kind] / all[kind], quantile(kind, .01), quantile(kind, .99)
    }
    print "<path stroke=\"#d00000\" stroke-width=\"1.5\" d=\"M240 24V206\"/>" >picture
    split("-64 -8 -1 0 1 8 64", mark, " ")
    for (i = 1; i <= 7; i++)
        print "<text text-anchor=\"middle\" x=\"" place(mark[i]) "\" y=\"222\">" mark[i] "</text>" >picture
    print "</svg>" >picture
}
