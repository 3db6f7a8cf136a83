# For shell tests: prints results as TAP. Source it, call check for each promise, end with finish.

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
    fi
}

finish() {
    echo "1..$tap_count"
    exit $tap_failed
}
