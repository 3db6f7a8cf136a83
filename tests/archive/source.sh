#!/bin/sh
# What can be seen in the sources: the public header is C99 and C++, and no code of the core, also of paths that the
# embedded targets do not take, names a floating-point type or the heap.
. tests/tap.sh

header_is_c99() {
    echo '#include "gnomon.h"' | ${CC:-cc} -std=c99 -Wall -Wextra -Wpedantic -Werror -Icore -fsyntax-only -x c -
}

header_is_cpp() {
    echo '#include "gnomon.h"' | g++ -std=c++98 -Wall -Wextra -Wno-long-long -Werror -Icore -fsyntax-only -x c++ -
}

# stdint.h and stddef.h come first: they may name what is forbidden to us.
poisoned() {
    ${CC:-cc} -std=c99 -ffreestanding -fsyntax-only -include stdint.h -include stddef.h \
        -include tests/archive/poison.h "$1"
}

cppcheck_finds_nothing() {
    cppcheck --quiet --std=c99 --enable=warning,portability --error-exitcode=1 --inline-suppr \
        --suppress=normalCheckLevelMaxBranches --suppress=syntaxError:port/arm/semihosting.c -Icore core port/*.c \
        port/arm port/riscv port/linux
}

check "gnomon.h compiles as C99" header_is_c99
check "gnomon.h compiles as C++98" header_is_cpp
for source in core/*.c; do
    check "$source: no float, no heap" poisoned "$source"
done
check "cppcheck finds nothing in core and port" cppcheck_finds_nothing
finish
