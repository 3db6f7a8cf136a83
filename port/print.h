/* Numbers as text on the port's console. */
#ifndef PRINT_H
#define PRINT_H

#include <stdint.h>

void write_decimal(uint32_t value);

#endif
