/* A QEMU TCG plugin that counts the instructions a program executes between two functions.
 *
 *     -plugin count_plugin.so,begin=ADDRESS,end=ADDRESS[,functions=on]
 *
 * Each time the program counter comes to begin, a region starts; at end it stops, and one line
 * `region K instructions N` a region goes to standard error; with functions=on each is followed by what its functions
 * took of it, lines `function N NAME`, the dearest first. The two calls themselves add a handful of instructions,
 * always the same: take differences.
 *
 * Blocks of translated code are counted as a whole when they begin. That is what single instructions come to where no
 * block is left in its middle, by an exception or an access to a device: functions=on counts every instruction, ten
 * times slower, and gives the same sums.
 *
 * Debian packages QEMU without qemu-plugin.h; the few declarations needed are written out here. Loaded into QEMU, which
 * is under the GNU GPL version 2; this file is under the MIT licence like the rest, which is compatible with it. */
#include <inttypes.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* 1 up to QEMU 8, 2 from QEMU 9 on, which adds to counters inline by other functions: there blocks call back. */
#ifndef PLUGIN_API
#define PLUGIN_API 1
#endif

#define EXPORT __attribute__((visibility("default")))

typedef uint64_t plugin_id;
struct qemu_plugin_tb;
struct qemu_plugin_insn;
enum { CALLBACK_USES_NO_REGISTERS = 0, INLINE_ADD = 0 };

void qemu_plugin_register_vcpu_tb_trans_cb(plugin_id, void (*)(plugin_id, struct qemu_plugin_tb *));
#if PLUGIN_API == 1
void qemu_plugin_register_vcpu_tb_exec_inline(struct qemu_plugin_tb *, int, void *, uint64_t);
#else
void qemu_plugin_register_vcpu_tb_exec_cb(struct qemu_plugin_tb *, void (*)(unsigned, void *), int, void *);
#endif
void qemu_plugin_register_vcpu_insn_exec_cb(struct qemu_plugin_insn *, void (*)(unsigned, void *), int, void *);
size_t qemu_plugin_tb_n_insns(const struct qemu_plugin_tb *);
struct qemu_plugin_insn *qemu_plugin_tb_get_insn(const struct qemu_plugin_tb *, size_t);
uint64_t qemu_plugin_insn_vaddr(const struct qemu_plugin_insn *);
const char *qemu_plugin_insn_symbol(const struct qemu_plugin_insn *);

EXPORT int qemu_plugin_version = PLUGIN_API;
EXPORT int qemu_plugin_install(plugin_id id, const void *info, int argc, char **argv);

enum { MAX_FUNCTIONS = 1024 };

static uint64_t begin = UINT64_MAX, end = UINT64_MAX;
static int list_functions;

static int inside;
static uint64_t executed;      /* since the program began; of every block that has begun, all */
static uint64_t before_region; /* of them before the region that is open */
static int region_count;

static struct function {
    const char *name;
    uint64_t executed;
} functions[MAX_FUNCTIONS];
static int function_count;

/* Called at an instruction with so many of its block, itself included, counted and still to come. */
static void open_region(unsigned cpu, void *still_to_come)
{
    (void)cpu;
    inside = 1;
    before_region = executed - (uintptr_t)still_to_come;
}

static int by_count(const void *a, const void *b)
{
    const struct function *f = *(struct function *const *)a, *g = *(struct function *const *)b;
    return (f->executed < g->executed) - (f->executed > g->executed);
}

static void report_region(uint64_t instructions)
{
    struct function *order[MAX_FUNCTIONS];
    fprintf(stderr, "region %d instructions %" PRIu64 "\n", region_count++, instructions);
    for (int i = 0; i < function_count; i++)
        order[i] = &functions[i];
    qsort(order, (size_t)function_count, sizeof *order, by_count);
    for (int i = 0; i < function_count && order[i]->executed; i++) {
        if (list_functions)
            fprintf(stderr, "function %" PRIu64 " %s\n", order[i]->executed, order[i]->name);
        order[i]->executed = 0;
    }
}

static void close_region(unsigned cpu, void *still_to_come)
{
    (void)cpu;
    if (inside)
        report_region(executed - (uintptr_t)still_to_come - before_region);
    inside = 0;
}

static void count_instruction(unsigned cpu, void *function)
{
    (void)cpu;
    executed++;
    if (inside)
        ((struct function *)function)->executed++;
}

#if PLUGIN_API == 1
static void count_block(struct qemu_plugin_tb *block)
{
    qemu_plugin_register_vcpu_tb_exec_inline(block, INLINE_ADD, &executed, qemu_plugin_tb_n_insns(block));
}
#else
static void count_instructions(unsigned cpu, void *instructions)
{
    (void)cpu;
    executed += (uintptr_t)instructions;
}

static void count_block(struct qemu_plugin_tb *block)
{
    qemu_plugin_register_vcpu_tb_exec_cb(block, count_instructions, CALLBACK_USES_NO_REGISTERS,
                                         (void *)(uintptr_t)qemu_plugin_tb_n_insns(block));
}
#endif

static struct function *find_function(const char *name)
{
    if (!name)
        name = "(no symbol)";
    for (int i = 0; i < function_count; i++) {
        if (strcmp(functions[i].name, name) == 0)
            return &functions[i];
    }
    if (function_count == MAX_FUNCTIONS)
        return &functions[MAX_FUNCTIONS - 1];
    functions[function_count].name = strdup(name);
    return &functions[function_count++];
}

/* Called before the count of the instruction itself where single ones are counted. */
static void watch_address(struct qemu_plugin_insn *instruction, uint64_t address, size_t still_to_come)
{
    void *count = (void *)(uintptr_t)(list_functions ? 0 : still_to_come);
    if (address == end)
        qemu_plugin_register_vcpu_insn_exec_cb(instruction, close_region, CALLBACK_USES_NO_REGISTERS, count);
    if (address == begin)
        qemu_plugin_register_vcpu_insn_exec_cb(instruction, open_region, CALLBACK_USES_NO_REGISTERS, count);
}

static void watch_block(plugin_id id, struct qemu_plugin_tb *block)
{
    size_t instructions = qemu_plugin_tb_n_insns(block);
    (void)id;
    if (!list_functions)
        count_block(block);
    for (size_t i = 0; i < instructions; i++) {
        struct qemu_plugin_insn *instruction = qemu_plugin_tb_get_insn(block, i);
        watch_address(instruction, qemu_plugin_insn_vaddr(instruction), instructions - i);
        if (list_functions)
            qemu_plugin_register_vcpu_insn_exec_cb(instruction, count_instruction, CALLBACK_USES_NO_REGISTERS,
                                                   find_function(qemu_plugin_insn_symbol(instruction)));
    }
}

int qemu_plugin_install(plugin_id id, const void *info, int argc, char **argv)
{
    (void)info;
    for (int i = 0; i < argc; i++) {
        if (strncmp(argv[i], "begin=", 6) == 0)
            begin = strtoull(argv[i] + 6, NULL, 0);
        else if (strncmp(argv[i], "end=", 4) == 0)
            end = strtoull(argv[i] + 4, NULL, 0);
        else if (strcmp(argv[i], "functions=on") == 0)
            list_functions = 1;
        else
            return 1;
    }
    qemu_plugin_register_vcpu_tb_trans_cb(id, watch_block);
    return 0;
}
