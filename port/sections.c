#include "sections.h"

#include <stdint.h>

/* The linker script's, all aligned to words. */
extern uint32_t data_start[], data_end[], bss_start[], bss_end[];
extern const uint32_t data_load[];

/* volatile: the compiler must not call memcpy and memset for it. */
static uintptr_t words_between(const volatile uint32_t *start, const volatile uint32_t *end)
{
    return ((uintptr_t)end - (uintptr_t)start) / sizeof *start;
}

void sections_load(void)
{
    volatile uint32_t *to = data_start;
    const uint32_t *from = data_load;
    for (uintptr_t words = words_between(data_start, data_end); words; words--)
        *to++ = *from++;
    to = bss_start;
    for (uintptr_t words = words_between(bss_start, bss_end); words; words--)
        *to++ = 0;
}
