# Arm Cortex-M4 without its FPU, on QEMU's mps2-an386.
EMBEDDED_TARGETS += cortex-m4
cortex-m4_TOOL = arm-none-eabi-
cortex-m4_FLAGS = -mcpu=cortex-m4 -mthumb -mfloat-abi=soft
cortex-m4_PORT = $(ARM_PORT)
cortex-m4_LINK = $(call arm_link,port/cortex-m4/board.ld)
cortex-m4_RUN = $(ARM_RUN) -M mps2-an386
