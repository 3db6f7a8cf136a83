#!/bin/sh
# Make docs/stability.md and its pictures: the hard cases of tests/hard, what each method does to them.
#
#     tests/report/stability.sh HARD -o DOCS
#
# HARD is the program of the hard cases, build/host-16/tests/hard/hard (`make build/host-16/tests/hard/hard`); DOCS the
# folder docs. oiiotool puts the pictures side by side. Exit status 1 if a case has not come out as derived; then, and where
# anything else fails, DOCS stays as it was.
set -eu

if [ $# -ne 3 ] || [ "$2" != -o ]; then
    echo "usage: tests/report/stability.sh HARD -o DOCS" >&2
    exit 2
fi
hard=$1
docs=$3
command -v oiiotool >/dev/null || {
    echo "oiiotool is missing; the package openimageio-tools has it" >&2
    exit 2
}

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
trap 'exit 2' HUP INT TERM
mkdir "$work/done"

# join OUT COLUMNSxROWS CASE...: the cases' pictures, each beside its difference. No metadata: oiiotool's would name this
# machine's folders, and make every run's file another.
join() {
    out=$1
    shape=$2
    shift 2
    pairs=
    "$hard" --pictures "$work" "$@"
    for name; do
        oiiotool "$work/$name.ppm" "$work/$name.difference.ppm" --mosaic:pad=2 2x1 -o "$work/$name.png"
        pairs="$pairs $work/$name.png"
    done
    # shellcheck disable=SC2086 # words; the folder is mktemp's
    oiiotool $pairs --mosaic:pad=6 "$shape" --nosoftwareattrib --eraseattrib '.*' -o "$work/done/stability-$out.png"
}

join papers 2x5 table_acne table_detached thin_slab unshadowing silhouette near_receiver background steep_receiver \
    l_shape
cat >"$work/1.caption" <<'END'
![the papers' figures](pictures/stability-papers.png)

Row by row, each with its difference: table with too small a bias (constant) and with too large a one; slab thinner than what a texel
spans (second depth), slope below an edge (midpoint); wedge with a sharp silhouette (midpoint), plate nearer to the floor than the bias
(constant); a receiver's edge and a steep receiver (midpoint without back faces); the L (constant).
END

join light 2x2 grazing_5_degrees grazing_hundredth sheet_20_degrees edge_on
cat >"$work/2.caption" <<'END'
![grazing light](pictures/stability-light.png)

Sun 5 degrees high on a solid (dual: bands where 2 texels do not suffice) and 0.01 degree (second depth: one row of texels for half of the
floor); 20 degrees on a sheet (second depth), a wall along the light (auto).
END

join meshes 2x4 needle coplanar_sheets turned_block bar crossing inside_out poster valley
cat >"$work/3.caption" <<'END'
![meshes](pictures/stability-meshes.png)

Needle thinner than a texel (mixed), doubled sheets (mixed); turned block and bar on its edge, light behind and before the contact (second
depth); wedge out of the floor (dual), block inside out (second depth); sheet close before a solid (mixed), bent sheet
(second depth with virtual samples and no bias).
END

join silhouettes 2x2 silhouettes_cross silhouettes_pass silhouettes_corner silhouettes_thin_bar
cat >"$work/4.caption" <<'END'
![silhouettes within texels](pictures/stability-silhouettes.png)

With silhouettes: two that cross, two that pass each other; a sharp corner, a bar of 0.6 texels. What is left is at crossings, corners and
where two borders share a texel.
END

join numbers 2x2 spot_10000 through_near cut_by_light camera_inside
cat >"$work/5.caption" <<'END'
![numbers](pictures/stability-numbers.png)

Spot light with planes 1 : 10^4, 16 bits (mixed): no shadow; floor and panel through the near
plane (auto); solids cut by the light's near plane (dual), inside a solid (second depth).
END

# Each group's picture below its table.
illustrate() {
    awk -v folder="$work" '
    function picture(    file, line, found) {
        file = folder "/" group++ ".caption"
        while ((getline line <file) > 0) {
            print line
            found = 1
        }
        if (found)
            print ""
    }
    /^## / { picture() }
    { print }
    END { print ""; picture() }' | cat -s
}

# On its own, as the status of a pipe is that of its last command.
"$hard" --table >"$work/table"

{
    cat <<'END'
# Stability: the hard cases

What is known to break shadow maps, on purpose and one at a time: a scene of a few solids each, an outcome that was worked out by hand, and
what each method gives. The scenes and the derivations are `tests/hard`, and run with `make test`; this page is made by

    make build/host-16/tests/hard/hard && tests/report/stability.sh build/host-16/tests/hard/hard -o docs

`hard CASE...` runs some alone, `hard --write FOLDER` writes the scenes for `gnomon render`.

Columns are methods: false shadow + false light against the exact truth, % of the pixels that see a surface, ties of the truth and pixels
near one left out (but counted for faces in one plane, which are about them); 16 bits of depth, image 160 x 120, map 64 x 64 (t = 1/16 m,
three pixels) unless the case says otherwise; the sphere and the 360 directions have images of 80 x 60. Bias of
constant, dual and mixed 2 texels; `auto` is second depth where all is closed, else mixed, with virtual samples.

A second table has the cases that virtual samples change, and their rivals: adaptive (nearest depth, 0.0001 of the range, virtual samples),
slope (2 x half a texel's slope and 0.0005 of the range), plane bias (half a texel of the receiver and the same), and `auto` filtered over
5 x 5 texels: there a pixel is right where it is wholly lit or wholly shadowed as in the truth, and its error its own where the truth is one
at all 25 centres. Its last columns are mixed with virtual samples and a silhouette map (`--method silhouette`), or a crossing map.

These two are run on every scene of the page but the scene files and the sweeps. They choose among the samples of the four texels about a
point, so an error is their own where the truth is one at the centres of all texels within one of the pixel's. Promised of every scene: no
such pixel is wrong that is right without them; in all no more than 0.4 % is wrong beside what is wrong without them (a corner of a shadow
that is cut off; up to 2.5 % where a texel is as long as what is seen); masks are equal whatever the regions and workers. Promised where one
edge alone is within 2 texels: no pixel is wrong that lies farther than 1/16 texel, and 1/64 for rounding, from the border.

**Bold: errors of the method's own.** A map answers for the centres of its texels. Where the truth at the texel's centre, moved along the
light onto the receiver's plane, differs from the truth at the pixel, the error is the texel's: only a larger map helps. All others are the
method's: acne, a bias that is too large, a leak. What a case expects are errors of that kind; every promise is one line of the test, also
that there is no more of them. "The others none": no errors of their own, or the fraction of a per cent that the case's comment derives. The
columns have both kinds, so that they may show more than what is expected. In the row of the L, constant, midpoint and dual are compared
with one another; amounts are not derived. `-`: not run. `volumes` is to agree with the truth in every pixel that is not near a tie.

The promises allow for pixels that fall on either side of a texel's border; the ranges and their derivations are in the comments of
`tests/hard/cases_*.c`. A case that comes out as derived may well err: what to do then is in the last column, the causes are in
[limits.md](limits.md).

W&M: Wang & Molnar, *Second-Depth Shadow Mapping*, 1994. W&E: Weiskopf & Ertl, *Shadow Mapping Based on Dual Depth Layers*, 2003. What their
figures claim came out, with two qualifications: in W&E fig. 2a the centre of the texel is lit, so that dual mapping halves an error that is
not its own; in fig. 4b, where midpoint fails and dual does not, 2 texels show acne on the same face where it is lit.
END
    cat "$work/table"
} >"$work/plain"
illustrate <"$work/plain" >"$work/stability.md"
sed -n '/^## A slow camera move/,$p' "$docs/stability.md" >"$work/move" # of stability_frames.sh
[ ! -s "$work/move" ] || { echo && cat "$work/move"; } >>"$work/stability.md"

if grep '\*\*Not met' "$work/stability.md" >&2; then
    echo "not as derived: $docs is left as it was" >&2
    exit 1
fi
mkdir -p "$docs/pictures"
mv "$work"/done/*.png "$docs/pictures"
mv "$work/stability.md" "$docs/stability.md"
