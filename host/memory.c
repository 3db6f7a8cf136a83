#include "memory.h"

#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

static void out_of_memory(size_t count, size_t size)
{
    fprintf(stderr, "gnomon: out of memory: %zu elements of %zu bytes\n", count, size);
    exit(2);
}

void *memory_take(size_t count, size_t size)
{
    void *block = calloc(count ? count : 1, size ? size : 1);
    if (!block)
        out_of_memory(count, size);
    return block;
}

void *memory_grow(void *block, size_t *capacity, size_t needed, size_t size)
{
    if (needed <= *capacity)
        return block;
    size_t count = *capacity ? *capacity : 64;
    while (count < needed && count <= SIZE_MAX / 2)
        count *= 2;
    if (count < needed || count > SIZE_MAX / size)
        out_of_memory(needed, size);
    block = realloc(block, count * size);
    if (!block)
        out_of_memory(count, size);
    *capacity = count;
    return block;
}
