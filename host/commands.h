/* The commands of the simulator. Each takes what follows its name on the command line and returns the exit status. */
#ifndef COMMANDS_H
#define COMMANDS_H

enum { EXIT_DONE = 0, EXIT_DIFFERS = 1, EXIT_BAD_INPUT = 2 };

int command_render(int argc, char **argv);
int command_compare(int argc, char **argv);
int command_pack(int argc, char **argv);
int command_bench(int argc, char **argv);
int command_procedural(int argc, char **argv);
int command_truth(int argc, char **argv);
int command_sweep(int argc, char **argv);

/* What `gnomon` and `gnomon --help` say of each, in one line. */
extern const char render_summary[], compare_summary[], pack_summary[], bench_summary[], procedural_summary[],
    truth_summary[], sweep_summary[];

#endif
