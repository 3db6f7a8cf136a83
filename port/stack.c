#include "stack.h"
#include "port.h"

extern uint32_t stack_bottom[], stack_top[]; /* the linker script's */

#define PATTERN 0xc0de57acu
#define MARGIN 64 /* bytes below our own frame's variable that are left alone: saved registers may be there */

void stack_paint(void)
{
    uint32_t here = 0;
    uintptr_t end = (uintptr_t)&here - MARGIN;
    /* volatile: or the compiler may call memset, whose own frame would be painted. */
    for (volatile uint32_t *word = stack_bottom; (uintptr_t)word < end; word++)
        *word = PATTERN;
}

uint32_t port_stack_used(void)
{
    const volatile uint32_t *word = stack_bottom;
    while ((uintptr_t)word < (uintptr_t)stack_top && *word == PATTERN)
        word++;
    return (uint32_t)((uintptr_t)stack_top - (uintptr_t)word);
}
