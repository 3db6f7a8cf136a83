/* What a board supplies to the programs of this folder. The core needs none of it: it needs memory, and memcpy, memset
 * and memmove (port/memory.c where there is no libc). */
#ifndef PORT_H
#define PORT_H

#include <stdint.h>

/* Send text, ended by 0, to whoever watches. */
void port_write(const char *text);

/* Stop. status: 0 all is well, 1 to 127 not; seen by whoever started the program. */
void port_exit(int status) __attribute__((noreturn));

/* Instructions executed so far, modulo 2^32; differences count. 0 where nothing counts them. */
uint32_t port_instructions(void);

/* Most bytes of stack in use at any time since start-up; 0 where it is not known. */
uint32_t port_stack_used(void);

#endif
