/* The most stack ever in use, found by painting: start-up fills the free stack with a pattern, and what still holds it
 * at the end was never touched. The linker script gives the stack's ends. */
#ifndef STACK_H
#define STACK_H

/* Fill the stack below the caller with the pattern. Call it once, first of all. */
void stack_paint(void);

#endif
