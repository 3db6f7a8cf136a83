# shellcheck shell=sh
# Frames, their figures, and pictures made of them; for scripts of this folder, which set `here` to it, to read with `.`.

# start_pictures BUILD -o FOLDER: the script's own arguments. Builds the programs `stages` and `mosaic`, and sets
#
#     build     the folder of `make BUILD=... all`, with OpenImageIO
#     work      a folder for what is in between: scenes, NAME.pgm the truth of NAME.scene; removed at the end
#     folder    where finished pictures go
start_pictures() {
    if [ $# -ne 3 ] || [ "$2" != -o ]; then
        echo "usage: $0 BUILD -o FOLDER" >&2
        exit 2
    fi
    build=$1
    folder=$3
    work=$(mktemp -d)
    trap 'rm -rf "$work"' EXIT
    trap 'exit 2' HUP INT TERM
    mkdir -p "$folder"
    build_program stages "$work/stages"
    build_program mosaic "$work/mosaic"
}

# build_program NAME OUT: tests/report/NAME.c with the core and the simulator, but for its main. At the top of the project. It
# finds OpenImageIO where the simulator does (host/oiio.h).
build_program() {
    ${MAKE:-make} --no-print-directory -s BUILD="$build" "$build/objects/host-16/tests/report/$1.o" >/dev/null
    objects=$(find "$build/objects/host-16/core" "$build/objects/host-16/host" -name '*.o' ! -name main.o)
    # shellcheck disable=SC2086 # words: no folder of ours has blanks
    ${CC:-cc} -pthread "$build/objects/host-16/tests/report/$1.o" $objects -lm -ldl "-Wl,-rpath,$(cd "$build" && pwd)" -o "$2"
}

# figures MASK TRUTH: false shadow + false light in per cent of the surface, mean absolute error in per cent.
figures() {
    "$build/gnomon" compare "$1" "$2" --difference "$work/difference.png" --json "$work/figures.json" >/dev/null ||
        [ $? -eq 1 ]
    awk -F '[:,]' '!done && /"false_shadow_percent"/ { shadow = $2 } !done && /"false_light_percent"/ { light = $2 }
        !done && /"mean_absolute_error"/ { printf "%.3f + %.3f; mean absolute error %.3f\n", shadow, light, 100 * $2
            done = 1 }' "$work/figures.json"
}

# shot NAME SCENE OPTION...: of SCENE.scene or SCENE.gno: NAME.png, NAME.mask.pgm and NAME.difference.png of the work folder;
# one line of figures.
shot() {
    name=$1
    scene=$2
    shift 2
    file=$work/$scene.scene
    [ -f "$file" ] || file=$work/$scene.gno
    "$build/gnomon" render "$file" "$@" -o "$work/$name.png" --mask "$work/$name.mask.pgm"
    printf '%-14s %-70s %s\n' "$scene" "$*" "$(figures "$work/$name.mask.pgm" "$work/$scene.pgm")"
    mv "$work/difference.png" "$work/$name.difference.png"
}

# slice OUT FILE OPTION...: OUT.svg of the folder, and the other files of slices.c in the work folder's OUT; a line of where
# it lies.
slice() {
    out=$1
    file=$2
    shift 2
    mkdir -p "$work/$out"
    printf '%-14s %s\n' "$file" "$("$work/slices" "$work/$file" "$work/${file%.*}.pgm" -o "$work/$out" "$@")"
    mv "$work/$out/slice.svg" "$folder/$out.svg"
}

# start_counting: `counted`, a simulator for any machine of this kind, which valgrind knows; COUNTED names one that is built
# already. Returns 1 where instructions cannot be counted.
start_counting() {
    command -v valgrind >/dev/null && command -v callgrind_annotate >/dev/null || return 1
    counted=${COUNTED:-$work/counted/gnomon}
    [ -x "$counted" ] || ${MAKE:-make} -s BUILD="$work/counted" HOST_ARCH= OIIO=no SETUP=no "$work/counted/gnomon" >/dev/null
}

# instructions NAME ASSIGNMENT... -- FILE OPTION...: a row of calls.awk.
instructions() {
    name=$1
    variables=
    shift
    while [ "$1" != -- ]; do
        variables="$variables -v $1"
        shift
    done
    file=$2
    shift 2
    valgrind --tool=callgrind --callgrind-out-file="$work/calls" --compress-strings=no --compress-pos=no "$counted" render \
        "$work/$file" "$@" --mask "$work/x.pgm" >/dev/null 2>&1
    # shellcheck disable=SC2086,SC2154 # words; the script's own folder
    awk -v name="$name" $variables -f "$here/calls.awk" "$work/calls"
}

# join OUT COLUMNS PICTURE[@PART]...: OUT.png of the folder, from pictures of the work folder (mosaic.c).
join() {
    out=$1
    columns=$2
    shift 2
    parts=
    for part; do
        case $part in
        *@*) parts="$parts $work/${part%@*}.png@${part#*@}" ;;
        *) parts="$parts $work/$part.png" ;;
        esac
    done
    # shellcheck disable=SC2086 # words; the folder is mktemp's
    "$work/mosaic" "$work/$out.png" "$columns" $parts
    mv "$work/$out.png" "$folder/$out.png"
}
