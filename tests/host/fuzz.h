/* Runs a libFuzzer entry point without libFuzzer, as a test: a good input changed at random, a fixed seed, many times.
 * With libFuzzer: clang -fsanitize=fuzzer,address,undefined -DGNOMON_LIBFUZZER -Icore -Ihost -Itests fuzz_obj.c
 * host/[^m]*.c host/me*.c core/[a-z]*.c -pthread -lm. Crashes are found by the sanitizers' builds. */
#ifndef FUZZ_H
#define FUZZ_H

#include <stddef.h>
#include <stdint.h>

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size);

#ifndef GNOMON_LIBFUZZER
#include "core/tap.h"

#include <string.h>

/* Overwrite, remove, repeat or insert a few bytes; returns the new size, at most `most`. */
static size_t fuzz_change(uint8_t *bytes, size_t size, size_t most, uint64_t *state)
{
    static const char pieces[] = "0 1 -1 9999999999 1e308 nan / // # \\\n \t\r\n f v vt vn mesh light \377\177\200";
    for (int changes = 1 + (int)(tap_random(state) % 4); changes > 0 && size > 8; changes--) {
        uint64_t random = tap_random(state);
        size_t at = (size_t)(random >> 32) % size, length = 1 + (random >> 8) % 7, room = size - at;
        length = length < room ? length : room;
        if (random % 4 == 0) {
            bytes[at] = (uint8_t)(random >> 24);
        } else if (random % 4 == 1) {
            memmove(bytes + at, bytes + at + length, room - length);
            size -= length;
        } else if (random % 4 == 2 && size + length <= most) {
            memmove(bytes + at + length, bytes + at, room);
            size += length;
        } else {
            memcpy(bytes + at, pieces + (random >> 16) % (sizeof pieces - 8), length);
        }
    }
    return size;
}

static void fuzz_run(const char *promise, const uint8_t *good, size_t size, uint64_t cases)
{
    uint64_t state = 1;
    size_t most = size + 64;
    for (uint64_t i = 0; i < cases; i++) {
        uint8_t *bytes = malloc(most);
        memcpy(bytes, good, size);
        LLVMFuzzerTestOneInput(bytes, i ? fuzz_change(bytes, size, most, &state) : size);
        free(bytes);
    }
    ok(1, "%s", promise);
}
#endif

#endif
