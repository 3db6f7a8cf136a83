#include "json.h"

#include "utf8.h"

#include <inttypes.h>
#include <math.h>

/* JSON is UTF-8: what is none becomes U+FFFD. */
static void quote(FILE *stream, const char *string)
{
    const uint8_t *at = (const uint8_t *)string;
    putc('"', stream);
    for (int size; *at; at += size ? size : 1) {
        size = utf8_size(at);
        if (!size)
            fputs("\\ufffd", stream);
        else if (*at == '"' || *at == '\\')
            fprintf(stream, "\\%c", *at);
        else if (*at < 32)
            fprintf(stream, "\\u%04x", (unsigned)*at);
        else
            fwrite(at, 1, (size_t)size, stream);
    }
    putc('"', stream);
}

static void indent(const json *j)
{
    for (int i = 0; i < j->depth; i++)
        fputs("  ", j->stream);
}

static void begin_line(json *j)
{
    fputs(j->members++ ? ",\n" : "\n", j->stream);
    indent(j);
}

static void begin_member(json *j, const char *name)
{
    if (!name)
        return;
    begin_line(j);
    quote(j->stream, name);
    fputs(": ", j->stream);
}

static void begin_inside(json *j, char bracket)
{
    putc(bracket, j->stream);
    j->depth++;
    j->members = 0;
}

static void end_inside(json *j, char bracket)
{
    j->depth--;
    j->members = 1; /* what is just closed is a member of what is outside */
    putc('\n', j->stream);
    indent(j);
    putc(bracket, j->stream);
    if (!j->depth)
        putc('\n', j->stream);
}

void json_open(json *j, const char *name)
{
    begin_member(j, name);
    begin_inside(j, '{');
}

void json_close(json *j)
{
    end_inside(j, '}');
}

void json_open_list(json *j, const char *name)
{
    begin_member(j, name);
    begin_inside(j, '[');
}

void json_open_item(json *j)
{
    begin_line(j);
    begin_inside(j, '{');
}

void json_close_list(json *j)
{
    end_inside(j, ']');
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
