# Hosted targets: the firmware as a program of the build machine by several compilers, as a 32-bit one, and on a
# big-endian machine under qemu-user.
HOSTED_TARGETS += gcc-O0 gcc-O3 clang i686 powerpc

gcc-O0_CC = gcc
gcc-O0_FLAGS = -O0

gcc-O3_CC = gcc
gcc-O3_FLAGS = -O3

clang_CC = clang
clang_FLAGS = -O2

i686_CC = i686-linux-gnu-gcc
i686_FLAGS = -O2
i686_LINK = -static
i686_RUN = qemu-i386

powerpc_CC = powerpc-linux-gnu-gcc
powerpc_FLAGS = -O2
powerpc_LINK = -static
powerpc_RUN = qemu-ppc
