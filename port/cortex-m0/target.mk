# Arm Cortex-M0: no divider, no 32 x 32 -> 64 bit multiplier. QEMU's M0 boards have 16 KiB of RAM, too little for the
# golden scenes, so the ARMv6-M code runs on a Cortex-M3, which executes it instruction for instruction.
EMBEDDED_TARGETS += cortex-m0
cortex-m0_TOOL = arm-none-eabi-
cortex-m0_FLAGS = -mcpu=cortex-m0 -mthumb -mfloat-abi=soft
cortex-m0_PORT = $(ARM_PORT)
cortex-m0_LINK = $(call arm_link,port/cortex-m0/board.ld)
cortex-m0_RUN = $(ARM_RUN) -M mps2-an385
