/* The linker script's sections at start-up. */
#ifndef SECTIONS_H
#define SECTIONS_H

/* Copy the initial values of .data from flash and clear .bss. */
void sections_load(void);

#endif
