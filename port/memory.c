/* memcpy, memset and memmove for programs without a libc: compilers call them even where the source does not. Words
 * where both ends are aligned alike, bytes otherwise. */
#include <stddef.h>
#include <stdint.h>

void *memcpy(void *restrict to, const void *restrict from, size_t bytes);
void *memmove(void *to, const void *from, size_t bytes);
void *memset(void *to, int value, size_t bytes);

/* May alias anything, as char may. */
typedef uint32_t __attribute__((may_alias)) word;

#define WORD sizeof(word)

void *memcpy(void *restrict to, const void *restrict from, size_t bytes)
{
    unsigned char *t = to;
    const unsigned char *f = from;
    if ((((uintptr_t)t | (uintptr_t)f) % WORD) == 0) {
        for (; bytes >= WORD; bytes -= WORD, t += WORD, f += WORD)
            *(word *)(void *)t = *(const word *)(const void *)f;
    }
    while (bytes--)
        *t++ = *f++;
    return to;
}

void *memmove(void *to, const void *from, size_t bytes)
{
    unsigned char *t = to;
    const unsigned char *f = from;
    if ((uintptr_t)t <= (uintptr_t)f) {
        while (bytes--)
            *t++ = *f++;
    } else {
        while (bytes--)
            t[bytes] = f[bytes];
    }
    return to;
}

void *memset(void *to, int value, size_t bytes)
{
    unsigned char *t = to;
    unsigned char byte = (unsigned char)value;
    word pattern = byte * (word)0x01010101u;
    for (; bytes && (uintptr_t)t % WORD; bytes--)
        *t++ = byte;
    for (; bytes >= 4 * WORD; bytes -= 4 * WORD, t += 4 * WORD) {
        word *w = (word *)(void *)t;
        w[0] = w[1] = w[2] = w[3] = pattern;
    }
    while (bytes--)
        *t++ = byte;
    return to;
}
