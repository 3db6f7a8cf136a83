# RISC-V rv32i: neither multiplier nor divider. On QEMU's virt board.
EMBEDDED_TARGETS += rv32i
rv32i_TOOL = riscv64-unknown-elf-
rv32i_FLAGS = -march=rv32i -mabi=ilp32 -mcmodel=medany
rv32i_PORT = $(RISCV_PORT)
rv32i_LINK = $(RISCV_LINK)
rv32i_RUN = $(RISCV_RUN)
