#!/bin/sh
# every_planted_fault_is_caught: a test that nothing can fail promises nothing.
#
#     tests/faults/faults.sh                    the quick faults of list.txt, each against the tests that it names
#     tests/faults/faults.sh --list [PATTERN]   all faults, or those whose names match, each against its tests
#     tests/faults/faults.sh --all [PATTERN]    the same, each against all tests: a table, in Markdown
#
# Sources are copied once; every fault is planted in a fresh copy of that, so the tree itself is never touched. One build
# of one depth, without OpenImageIO. JOBS: faults at a time, the machine's processors unless set.
. tests/tap.sh

mode=${1:-quick}
pattern=${2:-}
case $mode in
quick | --list | --all) ;;
*)
    echo "usage: tests/faults/faults.sh [--list | --all] [PATTERN]" >&2
    exit 2
    ;;
esac

folder=$(mktemp -d "${TMPDIR:-/tmp}/gnomon-faults-XXXXXX") || exit 1
trap 'rm -rf "$folder"' EXIT
trap 'exit 1' HUP INT TERM
list=$PWD/tests/faults/list.txt
plant=$PWD/tests/faults/plant.awk
clean=$folder/clean
jobs=${JOBS:-$(nproc)}
compiler=${CC:-cc}

# What a make that started us has set is not for the copies, and a fault may well leave something unused.
unset MAKEFLAGS MFLAGS MAKELEVEL MAKEOVERRIDES BUILD LANES LANE_CLANG GNOMON GNOMON_CASES WERROR
# A fault may well ask for endless memory.
# shellcheck disable=SC3045
ulimit -v 16000000

# ---- the list ------------------------------------------------------------------------------------------------------

has_vectors=$(echo | "$compiler" -march=native -dM -E - | grep -c __AVX2__)

# Lines `NUMBER FILE TESTS|NAME` of the faults that are asked for; TESTS joined by commas.
faults() {
    awk -v mode="$mode" -v pattern="$pattern" -v has_vectors="$has_vectors" '
        function finish() {
            if (name != "" && (mode != "quick" || quick) && (pattern == "" || name ~ pattern) && (has_vectors || !vectors))
                print number, file, tests "|" name
            name = ""
        }
        /^[^ #]/ { finish(); name = $0; number++; quick = vectors = 0; next }
        /^    [-+#]/ || NF == 0 { next }
        $1 == "in" {
            file = $2
            for (i = 3; i <= NF; i++) {
                quick = quick || $i == "quick"
                vectors = vectors || $i == "vectors"
            }
        }
        $1 == "caught" {
            tests = $3
            for (i = 4; i <= NF; i++)
                tests = tests "," $i
        }
        END { finish() }' "$list"
}

all_tests() {
    for source in tests/core/*_test.c tests/host/*_test.c tests/host/*_test.sh; do
        basename "$source" .c | sed 's/_test//'
    done
    echo hard
    echo hashes
}

# The tests that are needed.
tests_in_use() {
    if [ "$mode" = --all ]; then
        all_tests
    else
        faults | sed 's/|.*//; s/.* //' | tr , '\n' | sort -u
    fi
}

# ---- one test in one copy ------------------------------------------------------------------------------------------

# The cache of colours as small as a firmware's, so that triangles push each other out.
in_copy() {
    make -s --no-print-directory OIIO=no LANES=no CC="$compiler" CFLAGS="-O1 -UGN_COLOUR_CACHE" "$@" </dev/null
}

# What has to be compiled for a test.
program_of() {
    name=${1%%[:/]*}
    depth=16
    case $1 in
    */*) depth=${1#*/} ;;
    esac
    case $name in
    hard) echo "build/host-$depth/tests/hard/hard" ;;
    hashes | *.sh) echo build/gnomon ;;
    *)
        for source in "tests/core/${name}_test.c" "tests/host/${name}_test.c"; do
            [ -f "$source" ] && echo "build/host-$depth/${source%.c}"
        done
        ;;
    esac
}

run_hashes() {
    in_copy build/hashes/host-16.txt && sed -n 's/^hash /16 /p' build/hashes/host-16.txt >hashes.got &&
        grep '^16 ' tests/golden/hashes.txt | diff - hashes.got
}

# One broken promise is enough. Called in subshells alone.
run_test() {
    export TAP_STOP=1
    case $1 in
    hashes) run_hashes ;;
    *.sh) timeout 120 sh "tests/host/${1%.sh}_test.sh" ;;
    *:*)
        # shellcheck disable=SC2046
        timeout 120 "$(program_of "$1")" $(echo "${1#*:}" | tr : ' ')
        ;;
    *) timeout 120 "$(program_of "$1")" ;;
    esac
}

# build_and_run TEST: 0 passed, 1 failed, 2 cannot be built.
build_and_run() {
    program=$(program_of "$1")
    in_copy "${program:-no-test-named-$1}" >build.log 2>&1 || return 2
    run_test "$1" >test.log 2>&1 || return 1
}

# ---- one fault -----------------------------------------------------------------------------------------------------

# try NUMBER FILE TESTS: leaves `caught TEST...`, `survived` or `error TEXT` in $folder/NUMBER/result.
try() (
    result=$folder/$1/result
    cp -Rp "$clean" "$folder/$1/copy" && cd "$folder/$1/copy" || exit 1
    if ! awk -v number="$1" -f "$plant" "$list" "$2" >changed 2>why; then
        echo "error $(tr '\n' ' ' <why)" >"$result"
        exit
    fi
    cat changed >"$2"
    caught=
    [ "$mode" = --all ] && set -- "$1" "$2" "$(all_tests | tr '\n' ,)"
    for test in $(echo "$3" | tr , ' '); do
        build_and_run "$test"
        case $? in
        1) caught="$caught $test" ;;
        2)
            echo "error $test cannot be built: $(head -n 1 build.log)" >"$result"
            exit
            ;;
        esac
        if [ -n "$caught" ] && [ "$mode" != --all ]; then break; fi
    done
    if [ -n "$caught" ]; then echo "caught$caught"; else echo survived; fi >"$result"
)

# Take faults until none is left; mkdir tells who came first.
work() {
    faults | while IFS='|' read -r what name; do
        # shellcheck disable=SC2086
        set -- $what
        mkdir "$folder/$1" 2>/dev/null || continue
        try "$@"
        rm -rf "$folder/$1/copy"
        [ "$mode" = quick ] || echo "$name: $(cat "$folder/$1/result")" >&2
    done
}

try_all() {
    worker=0
    while [ "$worker" -lt "$jobs" ]; do
        work &
        worker=$((worker + 1))
    done
    wait
}

# ---- the clean tree ------------------------------------------------------------------------------------------------

prepare() {
    mkdir "$clean" && cp -Rp Makefile core host port tests "$clean" && cd "$clean" || return 1
    programs=
    for test in $(tests_in_use); do
        programs="$programs $(program_of "$test")"
    done
    # shellcheck disable=SC2086
    in_copy -j"$jobs" $programs
}

if ! prepared=$(prepare 2>&1); then
    printf '%s\n' "$prepared" | tail -n 30 | sed 's/^/# /'
    echo "not ok 1 - the tree is built before a fault is planted"
    echo "1..1"
    exit 1
fi

# What caught a fault has to pass without it. Asked at the end: of the tests that a fault names the first mostly does.
pass_when_clean() (
    cd "$clean" || exit 1
    sed -n 's/^caught //p' "$folder"/*/result | tr ' ' '\n' | sort -u | (
        failed=0
        while read -r test; do
            output=$(run_test "$test" 2>&1 </dev/null) && continue
            printf 'without a fault: %s\n%s\n' "$test" "$output" | grep -v '^ok' | tail -n 30
            failed=1
        done
        exit $failed
    )
)

# ---- what came of it -----------------------------------------------------------------------------------------------

# shellcheck disable=SC2317
was_caught() {
    cat "$folder/$1/result"
    echo "alone: tests/faults/faults.sh --list '^$2\$'"
    grep -q '^caught' "$folder/$1/result"
}

print_row() {
    echo "| $2 | $3 | $(sed 's/^caught //; s/^survived$/**nothing**/; s/ /, /g' "$folder/$1/result") |"
    grep -q '^caught' "$folder/$1/result"
}

try_all
faults >"$folder/faults"
if [ "$mode" = --all ]; then
    pass_when_clean >&2 || exit 1
    survivors=0
    printf '| fault | where | caught by |\n|---|---|---|\n'
    while IFS='|' read -r what name; do
        # shellcheck disable=SC2086
        set -- $what
        print_row "$1" "$name" "$2" || survivors=$((survivors + 1))
    done <"$folder/faults"
    echo "$survivors of $(wc -l <"$folder/faults" | tr -d ' ') not caught" >&2
    exit $((survivors > 0))
fi
check "what caught them passes without a fault" pass_when_clean
while IFS='|' read -r what name; do
    # shellcheck disable=SC2086
    set -- $what
    check "$name ($2)$(sed -n 's/^caught/: caught by/p' "$folder/$1/result")" was_caught "$1" "$name"
done <"$folder/faults"
finish
