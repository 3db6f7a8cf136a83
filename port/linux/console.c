/* The port for hosted systems: the same firmware as a program, natively or under qemu-user. */
#include "../port.h"

#include <stdio.h>
#include <stdlib.h>

void port_write(const char *text)
{
    fputs(text, stdout);
}

void port_exit(int status)
{
    exit(status);
}

uint32_t port_instructions(void)
{
    return 0;
}

uint32_t port_stack_used(void)
{
    return 0;
}
