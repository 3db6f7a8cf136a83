/* Command lines by table: `--name VALUE`, `--name=VALUE`, `--name`, and what is left over. */
#ifndef OPTIONS_H
#define OPTIONS_H

#include "problem.h"

#include <stddef.h>
#include <stdio.h>

typedef struct option {
    const char *name;     /* with its dashes; 0 heads a group of the help text with `help` */
    const char *argument; /* what the help text calls its value; 0: it takes none */
    const char *help;     /* lines after the first are indented */
} option;

enum { OPTIONS_MOST_PLACES = 64 };

typedef struct command_line {
    const char *places[OPTIONS_MOST_PLACES]; /* what is no option, in order */
    int place_count;
} command_line;

/* Sort arguments into values[i] (of table[i]; 0 if not given, "" if it takes none) and places. Each option at most
 * once;
 * `--` ends the options. 0, or -1 and the problem. */
int options_parse(const option *table, size_t count, int argc, char **argv, const char **values, command_line *line,
                  problem *why);

void options_help(const option *table, size_t count, FILE *stream);

/* A whole number within a range. 0, or -1 and the problem. */
int option_number(const char *name, const char *value, long least, long most, long *number, problem *why);

/* A decimal number within a range. 0, or -1 and the problem. */
int option_decimal(const char *name, const char *value, double least, double most, double *number, problem *why);

/* `N` or `WxH`, each from 1 to most. 0, or -1 and the problem. */
int option_size(const char *name, const char *value, int one_number, long most, long size[2], problem *why);

/* One of `count` words; its index, or -1 and the problem. */
int option_choice(const char *name, const char *value, const char *const words[], int count, problem *why);

#endif
