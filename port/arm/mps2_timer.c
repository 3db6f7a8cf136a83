/* Instructions from the first CMSDK timer of the MPS2 boards: 25 MHz, counting down. Under QEMU's -icount shift=6 an
 * instruction takes 64 ns, that is 1.6 ticks; without -icount the timer follows the host's clock and means nothing. */
#include "../port.h"
#include "timer.h"

static volatile uint32_t *const timer = (volatile uint32_t *)0x40000000u;
enum { CONTROL, VALUE, RELOAD };

void timer_start(void)
{
    timer[RELOAD] = 0xffffffffu;
    timer[VALUE] = 0xffffffffu;
    timer[CONTROL] = 1;
}

uint32_t port_instructions(void)
{
    /* 5/8 of the ticks. The remainder of 8 is lost: the sum wraps at 2^32 x 5/8, some 2.7e9 instructions. */
    uint32_t ticks = 0u - timer[VALUE];
    return ticks / 8 * 5 + ticks % 8 * 5 / 8;
}
