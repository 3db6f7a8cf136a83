/* A small JSON writer: objects, lists of objects, numbers and strings, two blanks a level. */
#ifndef JSON_H
#define JSON_H

#include <stdint.h>
#include <stdio.h>

typedef struct json {
    FILE *stream;
    int depth;
    int members; /* of the innermost object so far */
} json;

/* name 0: the outermost object. */
void json_open(json *j, const char *name);
void json_close(json *j);

/* A list of objects, each opened by json_open_item() and closed by json_close(). */
void json_open_list(json *j, const char *name);
void json_open_item(json *j);
void json_close_list(json *j);

void json_string(json *j, const char *name, const char *value);
void json_integer(json *j, const char *name, int64_t value);
void json_number(json *j, const char *name, double value);
void json_boolean(json *j, const char *name, int value);
void json_hash(json *j, const char *name, uint64_t value); /* a string of 16 hexadecimal digits */

#endif
