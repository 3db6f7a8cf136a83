/* The simulator's command line: picks the command. */
#include "commands.h"
#include "gnomon.h"

#include <stdio.h>
#include <string.h>

static const struct {
    const char *name, *summary;
    int (*run)(int argc, char **argv);
} commands[] = {
    {"render", render_summary, command_render},    {"truth", truth_summary, command_truth},
    {"compare", compare_summary, command_compare}, {"pack", pack_summary, command_pack},
    {"bench", bench_summary, command_bench},       {"procedural", procedural_summary, command_procedural},
    {"sweep", sweep_summary, command_sweep},
};

enum { COMMANDS = sizeof commands / sizeof *commands };

static void help(FILE *stream)
{
    fputs("gnomon " GN_VERSION
          ": hard and filtered shadows in integer arithmetic, the simulator\n\nusage: gnomon COMMAND ...\n\n",
          stream);
    for (int i = 0; i < COMMANDS; i++)
        fprintf(stream, "  %-12s %s\n", commands[i].name, commands[i].summary);
    fputs("\n`gnomon COMMAND --help` says more. A first picture:\n\n"
          "  gnomon procedural lshape -o /tmp\n"
          "  gnomon render /tmp/lshape.scene -o /tmp/lshape.ppm\n\n"
          "Exit status: 0 done, 1 compared and differs, 2 bad usage or input.\n",
          stream);
}

int main(int argc, char **argv)
{
    if (argc < 2) {
        help(stderr);
        return EXIT_BAD_INPUT;
    }
    if (strcmp(argv[1], "--help") == 0 || strcmp(argv[1], "-h") == 0 || strcmp(argv[1], "help") == 0) {
        help(stdout);
        return EXIT_DONE;
    }
    if (strcmp(argv[1], "--version") == 0) {
        printf("gnomon %s, bits version %d, %d-bit depth\n", GN_VERSION, GN_BITS_VERSION, GN_DEPTH_BITS);
        return EXIT_DONE;
    }
    for (int i = 0; i < COMMANDS; i++)
        if (strcmp(argv[1], commands[i].name) == 0)
            return commands[i].run(argc - 2, argv + 2);
    fprintf(stderr,
            "gnomon: unknown command '%s'; expected render, truth, compare, pack, bench, procedural or sweep (gnomon "
            "--help)\n",
            argv[1]);
    return EXIT_BAD_INPUT;
}
