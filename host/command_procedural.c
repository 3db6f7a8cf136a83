/* gnomon procedural: writes the built-in test scenes as .scene and OBJ files. */
#include "commands.h"
#include "options.h"
#include "procedural.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

const char procedural_summary[] = "write built-in test scenes as .scene and OBJ files";

enum { OUTPUT, VIEW, HELP, OPTION_COUNT };

static const option table[OPTION_COUNT] = {
    {"-o", "FOLDER", "where to write; made if it is missing (its parent must exist)"},
    {"--view", "SEED", "another camera and light, drawn from the seed: NAME_viewSEED.scene"},
    {"--help", 0, "this text"},
};

static void help(void)
{
    puts("usage: gnomon procedural NAME|all -o FOLDER [--view SEED]\n\n"
         "Write NAME.scene and its OBJ files into FOLDER. The names are:\n");
    for (int i = 0; i < procedural_count; i++)
        printf("  %s\n", procedural_names[i]);
    puts("");
    options_help(table, OPTION_COUNT, stdout);
    puts("\nExit status: 0 done, 2 bad usage or input.");
}

static int write_one(const char *name, const char *folder, const char *view, problem *why)
{
    long seed = 0;
    if (view && option_number("--view", view, 0, 0x7fffffff, &seed, why))
        return -1;
    errno = 0;
    if ((view ? procedural_write_view(name, (unsigned)seed, folder) : procedural_write(name, folder)) == 0)
        return 0;
    return problem_in(why, folder, "scene %s cannot be written: %s; expected a folder that can be written", name,
                      strerror(errno));
}

static int write_scenes(const char *name, const char *const values[], problem *why)
{
    int all = strcmp(name, "all") == 0, found = all;
    for (int i = 0; i < procedural_count; i++)
        found |= strcmp(name, procedural_names[i]) == 0;
    if (!found)
        return problem_of_usage(why, "unknown scene '%s'; expected all or one that gnomon procedural --help names",
                                name);
    if (!values[OUTPUT])
        return problem_of_usage(why, "no folder; expected -o FOLDER");
    if (mkdir(values[OUTPUT], 0777) != 0 && errno != EEXIST)
        return problem_in(why, values[OUTPUT], "cannot be made: %s; expected a folder whose parent exists",
                          strerror(errno));
    for (int i = 0; i < procedural_count; i++)
        if ((all || strcmp(name, procedural_names[i]) == 0) &&
            write_one(procedural_names[i], values[OUTPUT], values[VIEW], why))
            return -1;
    return 0;
}

int command_procedural(int argc, char **argv)
{
    const char *values[OPTION_COUNT];
    command_line line;
    problem why;
    int result = options_parse(table, OPTION_COUNT, argc, argv, values, &line, &why);
    if (!result && values[HELP]) {
        help();
        return EXIT_DONE;
    }
    if (!result && line.place_count != 1)
        result = problem_of_usage(&why, "%d names; expected one (gnomon procedural --help)", line.place_count);
    if (!result)
        result = write_scenes(line.places[0], values, &why);
    if (result)
        fprintf(stderr, "%s\n", why.text);
    return result ? EXIT_BAD_INPUT : EXIT_DONE;
}
