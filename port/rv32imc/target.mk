# RISC-V rv32imc: a multiplier and compressed instructions. On QEMU's virt board.
EMBEDDED_TARGETS += rv32imc
rv32imc_TOOL = riscv64-unknown-elf-
rv32imc_FLAGS = -march=rv32imc -mabi=ilp32 -mcmodel=medany
rv32imc_PORT = $(RISCV_PORT)
rv32imc_LINK = $(RISCV_LINK)
rv32imc_RUN = $(RISCV_RUN)
