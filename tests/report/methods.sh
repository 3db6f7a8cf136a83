# shellcheck shell=sh
# The options of `gnomon render` that make a method of the accuracy tables; for scripts of this folder to read with `.`.
#
# Names: those of figures.csv (docs/accuracy.md says what they mean). Behind plus signs a receiver (`+v3` virtual samples
# where the texels about the point disagree, `+always` at every pixel) and a reconstruction (`+bilinear`, `+jitter4x4`,
# `+pcf3` and so on; `+sil4n` and `+sil` silhouette maps, of which figures.csv knows the first alone, as its `+sil4` lets
# the last edge win; `+cross` crossing maps). Any other word is a preset: --method WORD.
#
# Before all that a fit, a warp or both may stand, and a stroke: `msf+rtwc/sdm:2+v3`. `dv`, `msf`; `rtwc` rectilinear by
# counts, `rtw` by distance, `notw` non-orthogonal, `rtwc-vertices` and `notw-vertices` of vertices alone; behind a colon
# the smoothing (`dv+notw:4`). Without them the map is uniform; figures.csv calls that `none`.

# surface_options NAME: of what stands before the first plus sign. Nothing for a preset.
surface_options() {
    numbers=${1#*:}
    case $1 in
    const:*) echo "--virtual-surface constant --bias ${numbers}r --layers first --cull none" ;;
    constt:*) echo "--virtual-surface constant --bias ${numbers}t --layers first --cull none" ;;
    slope:*) echo "--virtual-surface slope --slope ${numbers%:*} --bias ${numbers#*:}r --layers first --cull none" ;;
    rpb:*) echo "--virtual-surface constant --slope ${numbers%:*} --bias ${numbers#*:}r --layers first --cull none" ;;
    first:*) echo "--virtual-surface constant --bias ${numbers}r --layers first --cull none" ;;
    mid) echo "--virtual-surface midpoint --layers two --cull none" ;;
    midc) echo "--virtual-surface midpoint --layers two --cull back" ;;
    dual:*) echo "--virtual-surface dual --bias ${numbers}r --layers two --cull none" ;;
    dualc:*) echo "--virtual-surface dual --bias ${numbers}r --layers two --cull back" ;;
    dualct:*) echo "--virtual-surface dual --bias ${numbers}t --layers two --cull back" ;;
    sd2) echo "--virtual-surface second --layers two --cull none" ;;
    sdf) echo "--virtual-surface second --layers first --cull front" ;;
    sdm:*) echo "--virtual-surface mixed --bias ${numbers}t --layers two --cull none" ;;
    esac
}

# receiver_of NAME
receiver_of() {
    case $1 in
    *+v3*) echo virtual ;;
    *+always*) echo virtual-always ;;
    rpb:*) echo plane-bias ;;
    *) echo point ;;
    esac
}

# reconstruction_of NAME
reconstruction_of() {
    case $1 in
    *+sil | *+sil4n) echo silhouette ;;
    *+cross) echo crossing ;;
    *+v3 | *+always) echo nearest ;;
    *+*) echo "${1##*+}" ;; # what it does not know the simulator refuses
    *) echo nearest ;;
    esac
}

# warp_of NAME: what stands before the stroke; none.
warp_of() {
    case $1 in
    */*) echo "${1%%/*}" ;;
    *) echo none ;;
    esac
}

# parameterisation_options WARP
parameterisation_options() {
    words=$(echo "${1%%:*}" | sed 's/rtwc/rectilinear/; s/rtw$/rectilinear-distance/; s/notw/nonorthogonal/')
    case $1 in
    none) ;; # what is uniform anyway, and for shadow volumes
    *:*) echo "--parameterise $words --smoothing ${1#*:}" ;;
    *) echo "--parameterise $words" ;;
    esac
}

# method_options NAME
method_options() {
    how=${1#*/}
    surface=$(surface_options "${how%%+*}")
    if [ -n "$surface" ]; then
        echo "$surface --receiver $(receiver_of "$how") --reconstruct $(reconstruction_of "$how")" \
            "$(parameterisation_options "$(warp_of "$1")")"
    else
        echo "--method $how $(parameterisation_options "$(warp_of "$1")")"
    fi
}
