/* The board's timer, for port_instructions. */
#ifndef TIMER_H
#define TIMER_H

void timer_start(void);

#endif
