/* What is wrong with an input, in one line: FILE:LINE: what is wrong; what was expected.
 *
 * Readers fill a problem and return -1; the command prints it and stops. Every function here returns -1, so that a
 * reader can write `return problem_at(...)`.
 */
#ifndef PROBLEM_H
#define PROBLEM_H

#include <stddef.h>

typedef struct problem {
    char text[1024];
} problem;

/* FILE:LINE: message */
int problem_at(problem *why, const char *file, long line, const char *format, ...);

/* FILE: byte OFFSET: message (binary files) */
int problem_at_byte(problem *why, const char *file, size_t offset, const char *format, ...);

/* FILE: message (the file as a whole) */
int problem_in(problem *why, const char *file, const char *format, ...);

/* gnomon: message (the command line) */
int problem_of_usage(problem *why, const char *format, ...);

#endif
