#include "options.h"

#include "text.h"

#include <string.h>

/* Index of the option that the argument names, up to a '='; -1 if there is none. */
static int find(const option *table, size_t count, const char *argument)
{
    size_t length = strcspn(argument, "=");
    for (size_t i = 0; i < count; i++)
        if (table[i].name && strlen(table[i].name) == length && memcmp(table[i].name, argument, length) == 0)
            return (int)i;
    return -1;
}

static int take_place(command_line *line, const char *argument, problem *why)
{
    if (line->place_count == OPTIONS_MOST_PLACES)
        return problem_of_usage(why, "too many arguments; expected at most %d", OPTIONS_MOST_PLACES);
    line->places[line->place_count++] = argument;
    return 0;
}

int options_parse(const option *table, size_t count, int argc, char **argv, const char **values, command_line *line,
                  problem *why)
{
    int only_places = 0;
    memset(values, 0, count * sizeof *values);
    memset(line, 0, sizeof *line);
    for (int i = 0; i < argc; i++) {
        const char *argument = argv[i], *equals = strchr(argument, '=');
        if (only_places || argument[0] != '-' || !argument[1]) {
            if (take_place(line, argument, why))
                return -1;
            continue;
        }
        only_places = strcmp(argument, "--") == 0;
        if (only_places)
            continue;
        int index = find(table, count, argument);
        if (index < 0)
            return problem_of_usage(why, "unknown option '%s'; expected one that --help names", argument);
        const option *o = &table[index];
        if (values[index])
            return problem_of_usage(why, "%s is given twice; expected it once", o->name);
        if (!o->argument && equals)
            return problem_of_usage(why, "%s takes no value; expected it alone", o->name);
        if (o->argument && !equals && i + 1 == argc)
            return problem_of_usage(why, "%s lacks its value; expected %s %s", o->name, o->name, o->argument);
        values[index] = !o->argument ? "" : equals ? equals + 1 : argv[++i];
    }
    return 0;
}

void options_help(const option *table, size_t count, FILE *stream)
{
    enum { COLUMN = 30 };
    for (size_t i = 0; i < count; i++) {
        if (!table[i].name) {
            fprintf(stream, "\n%s\n", table[i].help);
            continue;
        }
        int used = fprintf(stream, "  %s %s", table[i].name, table[i].argument ? table[i].argument : "");
        if (used > COLUMN - 2)
            used = fprintf(stream, "\n") - 1;
        fprintf(stream, "%*s", COLUMN - used, "");
        for (const char *c = table[i].help; *c; c++) {
            putc(*c, stream);
            if (*c == '\n')
                fprintf(stream, "%*s", COLUMN, "");
        }
        putc('\n', stream);
    }
}

int option_number(const char *name, const char *value, long least, long most, long *number, problem *why)
{
    word w = {value, strlen(value)};
    if (word_integer(w, number) || *number < least || *number > most)
        return problem_of_usage(why, "%s %s; expected a whole number from %ld to %ld", name, value, least, most);
    return 0;
}

int option_decimal(const char *name, const char *value, double least, double most, double *number, problem *why)
{
    if (word_number((word){value, strlen(value)}, number) || *number < least || *number > most)
        return problem_of_usage(why, "%s %s; expected a number from %g to %g", name, value, least, most);
    return 0;
}

int option_size(const char *name, const char *value, int one_number, long most, long size[2], problem *why)
{
    const char *x = strchr(value, 'x');
    word first = {value, x ? (size_t)(x - value) : strlen(value)},
         second = {x ? x + 1 : value, x ? strlen(x + 1) : first.length};
    if ((!x && !one_number) || word_integer(first, &size[0]) || word_integer(second, &size[1]) || size[0] < 1 ||
        size[0] > most || size[1] < 1 || size[1] > most)
        return problem_of_usage(why, "%s %s; expected %sWxH, each from 1 to %ld", name, value,
                                one_number ? "N or " : "", most);
    return 0;
}

int option_choice(const char *name, const char *value, const char *const words[], int count, problem *why)
{
    char expected[400] = "";
    for (int i = 0; i < count; i++) {
        if (strcmp(value, words[i]) == 0)
            return i;
        strncat(expected, i ? ", " : "", sizeof expected - strlen(expected) - 1);
        strncat(expected, words[i], sizeof expected - strlen(expected) - 1);
    }
    return problem_of_usage(why, "%s %s; expected one of: %s", name, value, expected);
}
