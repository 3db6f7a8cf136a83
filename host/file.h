/* Whole files in, whole files out. Output goes to a temporary name in the same folder and is renamed when it is
 * complete, so that a failed run leaves no half-written file and an older one stays as it was. What is there already
 * and is no regular file (a pipe, or a link as /dev/stdout is one) is written directly. */
#ifndef FILE_H
#define FILE_H

#include "problem.h"

#include <stdint.h>
#include <stdio.h>

typedef struct file_content {
    uint8_t *bytes; /* followed by a zero byte that `size` does not count */
    size_t size;
} file_content;

/* Read a whole file of at most 2 GiB; free() .bytes afterwards. 0, or -1 and the problem. */
int file_read(file_content *content, const char *path, problem *why);

typedef struct file_output {
    FILE *stream;
    char *path;      /* as asked for */
    char *temporary; /* what is written to; the same as path if written directly */
} file_output;

/* Could a file of this name be written, as far as can be told before it is? Asked before long work. 0, or -1 and the
 * problem. */
int file_can_write(const char *path, problem *why);

/* Outputs that would overwrite each other, or an input (0 in either list: none is given), are refused; what is no
 * regular file (/dev/stdout) may be named twice. Only what the paths lead to counts, not how they are spelled. 0, or -1
 * and the problem. */
int file_check_distinct(const char *const outputs[], int output_count, const char *const inputs[], int input_count,
                        problem *why);

/* Name the temporary; .stream stays 0. For writers that open files by name. */
int file_output_name(file_output *output, const char *path, problem *why);

/* file_output_name, and open it. */
int file_output_open(file_output *output, const char *path, problem *why);

/* Close and rename; on any error that happened while writing, remove the temporary and say so. */
int file_output_finish(file_output *output, problem *why);

/* Close and remove. */
void file_output_abandon(file_output *output);

/* Does the path end in this extension (with its dot, lower case), in either case? */
int file_has_extension(const char *path, const char *extension);

#endif
