# For shell tests: prints results as TAP. Source it, call check for each promise, end with finish. With TAP_STOP in the
# environment the first broken promise is the last one tried.
# shellcheck shell=sh disable=SC2154

tap_count=0
tap_failed=0

# check DESCRIPTION COMMAND...: passes if the command succeeds; otherwise its output is shown.
check() {
    tap_description=$1
    shift
    tap_count=$((tap_count + 1))
    if tap_output=$("$@" 2>&1); then
        echo "ok $tap_count - $tap_description"
    else
        echo "not ok $tap_count - $tap_description"
        printf '%s\n' "$tap_output" | sed 's/^/#   /'
        echo "#   again: $0"
        tap_failed=1
        [ -z "${TAP_STOP:-}" ] || exit 1
    fi
}

# exits STATUS COMMAND...: the command ends with this exit status.
exits() {
    wanted=$1
    shift
    "$@"
    got=$?
    [ $got = "$wanted" ] || { echo "exit status $got, expected $wanted: $*"; return 1; }
}

# Of the simulator, with what the test has set: $gnomon, $folder for temporary files, nothing_left.

# status N ARGUMENT...: the simulator ends with this exit status.
status() {
    wanted=$1
    shift
    exits "$wanted" "$gnomon" "$@"
}

# refuses TEXT ARGUMENT...: exit status 2, a message with this text and "expected", nothing printed, nothing_left.
refuses() {
    text=$1
    shift
    status 2 "$@" >"$folder/out" 2>"$folder/err" || { cat "$folder/err"; return 1; }
    cat "$folder/err"
    grep -qF -- "$text" "$folder/err" && grep -q expected "$folder/err" && [ ! -s "$folder/out" ] && nothing_left
}

finish() {
    echo "1..$tap_count"
    exit $tap_failed
}
