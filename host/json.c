#include "json.h"

#include <inttypes.h>
#include <math.h>

static void quote(FILE *stream, const char *string)
{
    putc('"', stream);
    for (const unsigned char *c = (const unsigned char *)string; *c; c++)
        if (*c == '"' || *c == '\\')
            fprintf(stream, "\\%c", *c);
        else if (*c < 32)
            fprintf(stream, "\\u%04x", (unsigned)*c);
        else
            putc(*c, stream);
    putc('"', stream);
}

static void indent(const json *j)
{
    for (int i = 0; i < j->depth; i++)
        fputs("  ", j->stream);
}

static void begin_member(json *j, const char *name)
{
    if (!name)
        return;
    fputs(j->members++ ? ",\n" : "\n", j->stream);
    indent(j);
    quote(j->stream, name);
    fputs(": ", j->stream);
}

void json_open(json *j, const char *name)
{
    begin_member(j, name);
    putc('{', j->stream);
    j->depth++;
    j->members = 0;
}

void json_close(json *j)
{
    j->depth--;
    j->members = 1; /* the object just closed is a member of the one outside */
    putc('\n', j->stream);
    indent(j);
    putc('}', j->stream);
    if (!j->depth)
        putc('\n', j->stream);
}

void json_string(json *j, const char *name, const char *value)
{
    begin_member(j, name);
    quote(j->stream, value);
}

void json_integer(json *j, const char *name, int64_t value)
{
    begin_member(j, name);
    fprintf(j->stream, "%" PRId64, value);
}

void json_number(json *j, const char *name, double value)
{
    begin_member(j, name);
    if (isfinite(value))
        fprintf(j->stream, "%.9g", value);
    else
        fputs("null", j->stream);
}

void json_boolean(json *j, const char *name, int value)
{
    begin_member(j, name);
    fputs(value ? "true" : "false", j->stream);
}

void json_hash(json *j, const char *name, uint64_t value)
{
    begin_member(j, name);
    fprintf(j->stream, "\"%016" PRIx64 "\"", value);
}
