# Adds up what `prove` printed and ends with the line `N passed, M failed`. A test file that died or broke off without a
# failed test counts as one failure. Exit status 1 unless every run of prove passed something and failed nothing.

/^Files=[0-9]+, Tests=[0-9]+/ {
    split($2, part, /[=,]/)
    tests += part[2]
    runs++
}

# The summary report: `FILE (Wstat: W Tests: T Failed: F)`, followed by its parse errors.
/\(Wstat: .* Tests: [0-9]+ Failed: [0-9]+\)/ {
    failures = $0
    sub(/.*Failed: /, "", failures)
    failures += 0
    wait_status = $0
    sub(/.*Wstat: /, "", wait_status)
    failed += failures
    died_without_a_failure = failures == 0
    if (died_without_a_failure)
        broken++
}

/^Result: / && $2 != "PASS" { bad_result = 1 }

END {
    if (bad_result && failed + broken == 0)
        broken = 1
    printf "%d passed, %d failed\n", tests - failed, failed + broken
    exit failed + broken > 0 || tests == 0 || runs < expected_runs
}
