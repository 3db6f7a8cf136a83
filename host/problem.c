#include "problem.h"

#include <stdarg.h>
#include <stdio.h>

/* Append the formatted message to what stands in the text already; an overlong one is cut, never an error. */
static int append(problem *why, int used, const char *format, va_list arguments)
{
    size_t at = used < 0 ? 0 : (size_t)used;
    if (at < sizeof why->text)
        vsnprintf(why->text + at, sizeof why->text - at, format, arguments);
    return -1;
}

int problem_at(problem *why, const char *file, long line, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    append(why, snprintf(why->text, sizeof why->text, "%s:%ld: ", file, line), format, arguments);
    va_end(arguments);
    return -1;
}

int problem_at_byte(problem *why, const char *file, size_t offset, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    append(why, snprintf(why->text, sizeof why->text, "%s: byte %zu: ", file, offset), format, arguments);
    va_end(arguments);
    return -1;
}

int problem_in(problem *why, const char *file, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    append(why, snprintf(why->text, sizeof why->text, "%s: ", file), format, arguments);
    va_end(arguments);
    return -1;
}

int problem_of_usage(problem *why, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    append(why, snprintf(why->text, sizeof why->text, "gnomon: "), format, arguments);
    va_end(arguments);
    return -1;
}
