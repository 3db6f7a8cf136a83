/* The simulator's heap. Running out of it ends the program with a message and exit status 2: every size asked for here
 * is in proportion to a file that was read or to an image that was checked to be at most 4096 x 4096. */
#ifndef MEMORY_H
#define MEMORY_H

#include <stddef.h>

/* count x size bytes, zeroed; never 0. */
void *memory_take(size_t count, size_t size);

/* Make room for at least `needed` elements, doubling; *capacity is in elements. Returns the new block. */
void *memory_grow(void *block, size_t *capacity, size_t needed, size_t size);

#endif
