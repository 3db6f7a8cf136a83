/* Start-up of a RISC-V program in machine mode: stack pointer, painted stack, sections, trap handler, main. */
#include "../port.h"
#include "../sections.h"
#include "../stack.h"

int main(void);
void start(void);
void run(void);

/* gcc wants the extension Zicsr named for csr instructions, but knows no multilib with it: name it for one line. */
#ifdef __clang__
#define CSR(text) text
#else
#define CSR(text) ".option push\n.option arch, +zicsr\n" text "\n.option pop"
#endif

__attribute__((aligned(4), used)) static void trap(void)
{
    port_write("trap\n");
    port_exit(99);
}

__attribute__((used)) void run(void)
{
    stack_paint();
    sections_load();
    __asm__ volatile(CSR("csrw mtvec, %0") : : "r"(trap));
    port_exit(main());
}

__attribute__((naked, section(".start"))) void start(void)
{
    __asm__ volatile("la sp, stack_top\n j run");
}

/* Exact under QEMU's -icount shift=0; without -icount it follows the host's clock and means nothing. */
uint32_t port_instructions(void)
{
    uint32_t retired;
    __asm__ volatile(CSR("csrr %0, minstret") : "=r"(retired));
    return retired;
}
