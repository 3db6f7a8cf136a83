#!/bin/sh
# Install what a job needs and the machine lacks (Debian, Ubuntu).
#
#     tests/setup.sh demo     the simulator with every picture format
#     tests/setup.sh test     that, and compilers and emulators of all targets
#
# Says what is missing, and what for, before it installs anything; uses apt-get, as root or through sudo. SETUP=no in the
# environment forbids installing: then it names what is missing and fails.
set -u

job=${1:-}
case $job in
demo | test) ;;
*)
    echo "usage: tests/setup.sh demo|test" >&2
    exit 2
    ;;
esac

missing=
reasons=

# need PACKAGES REASON COMMAND...: the packages are needed unless the command succeeds.
need() {
    packages=$1
    reason=$2
    shift 2
    "$@" >/dev/null 2>&1 && return
    missing="$missing $packages"
    reasons="$reasons
  $packages: $reason"
}

can() {
    command -v "$1"
}

# Compile and link an empty program: a compiler may be there without its libc.
builds_programs() {
    echo 'int main(void) { return 0; }' | "$1" -x c - -o /dev/null
}

need "gcc libc6-dev" "compiles everything" builds_programs cc
need "pkg-config" "finds OpenImageIO" can pkg-config
need "g++" "compiles the bridge to OpenImageIO" can g++
need "libopenimageio-dev" "reads and writes PNG, EXR and other pictures" pkg-config --exists OpenImageIO

if [ "$job" = test ]; then
    need "perl" "brings prove, which runs the tests" can prove
    need "gcc libc6-dev" "compiles for comparison with clang" can gcc
    need "clang" "compiles for comparison with gcc" can clang
    need "gcc-arm-none-eabi" "compiles for Cortex-M4 and Cortex-M0" can arm-none-eabi-gcc
    need "qemu-system-arm" "runs programs for Cortex-M" can qemu-system-arm
    need "gcc-riscv64-unknown-elf" "compiles for rv32imc and rv32i" can riscv64-unknown-elf-gcc
    need "qemu-system-misc" "runs programs for RISC-V" can qemu-system-riscv32
    need "gcc-i686-linux-gnu libc6-dev-i386-cross" "compiles for 32-bit x86" builds_programs i686-linux-gnu-gcc
    need "gcc-powerpc-linux-gnu libc6-dev-powerpc-cross" "compiles for a big-endian machine" \
        builds_programs powerpc-linux-gnu-gcc
    need "qemu-user" "runs programs for 32-bit x86 and PowerPC" can qemu-ppc
    need "cppcheck" "checks the sources" can cppcheck
fi

[ -z "$missing" ] && exit 0

echo "make $job needs packages that are not installed:$reasons"

if [ "${SETUP:-yes}" = no ]; then
    echo "SETUP=no forbids installing them. To do it yourself: apt-get install --no-install-recommends$missing" >&2
    exit 1
fi
if ! can apt-get >/dev/null; then
    echo "There is no apt-get here: install them, or what your system calls them, and run make $job again." >&2
    exit 1
fi
as_root=
if [ "$(id -u)" != 0 ]; then
    if ! can sudo >/dev/null; then
        echo "Installing needs root or sudo. As root: apt-get install --no-install-recommends$missing" >&2
        exit 1
    fi
    as_root=sudo
fi

update() {
    echo "apt-get update"
    $as_root apt-get -q update
}

install() {
    echo "apt-get install --no-install-recommends$missing"
    # shellcheck disable=SC2086 # the packages are separate words
    $as_root env DEBIAN_FRONTEND=noninteractive apt-get -q -y install --no-install-recommends $missing
}

# Exact names: where no list knows g++, apt takes it for a pattern, which other packages match.
known() {
    for package in $missing; do
        apt-cache show "?exact-name($package)" >/dev/null 2>&1 || return 1
    done
}

# A fresh machine has no package lists, an old one has stale ones: the first shows before, the second after.
known || update || exit 1
install || { update && install; } || exit 1
