/* Start-up of a Cortex-M: vector table, painted stack, sections, main. */
#include "../port.h"
#include "../sections.h"
#include "../stack.h"
#include "timer.h"

int main(void);
void reset(void);

extern uint32_t stack_top[]; /* the linker script's */

/* An ARMv6-M core faults at unaligned words. The larger core that runs its code here does so where bit 3 of its
 * Configuration and Control Register is set. (Compilers use unaligned words in code for the larger cores.) */
static void trap_unaligned_words(void)
{
#if defined __ARM_ARCH_6M__
    *(volatile uint32_t *)0xe000ed14u |= 1u << 3;
#endif
}

void reset(void)
{
    stack_paint();
    sections_load();
    trap_unaligned_words();
    timer_start();
    port_exit(main());
}

static void fault(void)
{
    port_write("fault\n");
    port_exit(99);
}

/* Initial stack pointer, reset, then the other 14 exceptions; the programs use no interrupts. */
__attribute__((section(".vectors"), used)) static const uintptr_t vectors[16] = {
    (uintptr_t)stack_top, (uintptr_t)reset, (uintptr_t)fault, (uintptr_t)fault, (uintptr_t)fault, (uintptr_t)fault,
    (uintptr_t)fault,     (uintptr_t)fault, (uintptr_t)fault, (uintptr_t)fault, (uintptr_t)fault, (uintptr_t)fault,
    (uintptr_t)fault,     (uintptr_t)fault, (uintptr_t)fault, (uintptr_t)fault,
};
