/* Console and exit of QEMU's virt board: a 16550 UART and the SiFive test device. */
#include "../port.h"

static volatile uint8_t *const uart = (volatile uint8_t *)0x10000000u;
enum { TRANSMIT = 0, LINE_STATUS = 5, TRANSMIT_EMPTY = 0x20 };

static volatile uint32_t *const test_device = (volatile uint32_t *)0x00100000u;
#define TEST_PASS 0x5555u
#define TEST_FAIL 0x3333u

void port_write(const char *text)
{
    for (; *text; text++) {
        while (!(uart[LINE_STATUS] & TRANSMIT_EMPTY)) {
        }
        uart[TRANSMIT] = (uint8_t)*text;
    }
}

void port_exit(int status)
{
    *test_device = status ? (uint32_t)status << 16 | TEST_FAIL : TEST_PASS;
    for (;;) {
    }
}
