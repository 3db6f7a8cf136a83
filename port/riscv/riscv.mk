# What the RISC-V targets share: sources of the port, how to link, how to run.

RISCV_PORT = port/riscv/start.c port/riscv/virt_console.c port/stack.c port/sections.c port/memory.c
RISCV_LINK = -nostdlib -T port/riscv/virt.ld -Lport -Wl,--gc-sections -Wl,--no-warn-rwx-segments

# The UART writes to standard output; minstret counts instructions.
RISCV_RUN = timeout 900 qemu-system-riscv32 -M virt -bios none -display none -monitor none -serial stdio -icount shift=0
