# What the Cortex-M targets share: sources of the port, how to link, how to run.

ARM_PORT = port/arm/start.c port/arm/semihosting.c port/arm/mps2_timer.c port/stack.c port/sections.c \
	port/memory.c

# $(call arm_link,BOARD.ld)
arm_link = -nostdlib -T $(1) -Lport -Wl,--gc-sections -Wl,--no-warn-rwx-segments

# Semihosting writes to standard output; an instruction takes 2^6 ns, which the boards' timers can resolve.
ARM_RUN = timeout 900 qemu-system-arm -display none -serial none -monitor none -chardev stdio,id=console \
	-semihosting-config enable=on,target=native,chardev=console -icount shift=6
