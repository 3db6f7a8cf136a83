#!/bin/sh
# What the set-up script promises, tried where nothing is installed and a false apt-get notes how it was called.
. tests/tap.sh

folder=$(mktemp -d)
trap 'rm -r "$folder"' EXIT
log=$folder/log
shell=$(command -v sh)
ln -s "$(command -v env)" "$folder/env"

# false_program NAME SCRIPT
false_program() {
    printf '#!%s\n%s\n' "$shell" "$2" >"$folder/$1"
    chmod +x "$folder/$1"
}
false_program apt-get "echo \"\$*\" >>$log"
false_program apt-cache 'exit 0'
false_program id 'echo 0'

set_up() {
    : >"$log"
    PATH=$folder "$shell" tests/setup.sh "$1"
}

forbidden() {
    output=$(SETUP=no set_up test 2>&1) && return 1
    echo "$output" | grep -q 'qemu-system-arm' && echo "$output" | grep -q 'gcc-powerpc-linux-gnu' && [ ! -s "$log" ]
}

says_what_and_why_first() {
    set_up demo | awk '/libopenimageio-dev: ..*/ { said = 1 } /^apt-get install/ { exit !said }'
}

installs() {
    set_up demo && grep -q 'install.* libopenimageio-dev' "$log" && ! grep -q 'arm-none-eabi' "$log"
}

updates_first_on_a_fresh_machine() {
    false_program apt-cache 'exit 1'
    set_up demo && head -n 1 "$log" | grep -q update
    fresh=$?
    false_program apt-cache 'exit 0'
    return $fresh
}

refuses_without_root() {
    false_program id 'echo 1000'
    output=$(set_up demo 2>&1) && return 1
    false_program id 'echo 0'
    echo "$output" | grep -q 'needs root or sudo'
}

refuses_unknown_jobs() {
    set_up everything
    [ $? = 2 ]
}

check "SETUP=no installs nothing, names what is missing and fails" forbidden
check "it says what is missing and why before it installs" says_what_and_why_first
check "it installs what the job needs and no more" installs
check "it fetches package lists where there are none" updates_first_on_a_fresh_machine
check "without root and sudo it says so and fails" refuses_without_root
check "an unknown job is refused" refuses_unknown_jobs
finish
