/* gnomon pack: the quantised scene as a .gno file or as a C header. */
#include "automatic.h"
#include "choices.h"
#include "commands.h"
#include "file.h"
#include "pack.h"
#include "render_options.h"

#include <inttypes.h>
#include <stdio.h>

const char pack_summary[] = "turn a scene into a .gno file, or into a C header for firmware";

enum { OUTPUT_HEAD = RENDER_OPTION_COUNT, OUTPUT, EDGES, VERBOSE, HELP, OPTION_COUNT };

static const option table[OPTION_COUNT] = {
    RENDER_OPTIONS,
    {0, 0, "What is written:"},
    {"-o", "FILE",
     "FILE.gno: one block of bytes (layout: host/pack.h);\n"
     "NAME.h: C arrays with NAME_scene, NAME_camera, NAME_light, NAME_settings"},
    {"--edges", 0,
     "with the edges that shadow volumes and silhouettes need (8 bytes each, about 12 a\n"
     "triangle); always with --method volumes and with silhouettes, else left out"},
    {"--verbose", 0, "notices about meshes on standard error"},
    {"--help", 0, "this text"},
};

static void help(void)
{
    puts("usage: gnomon pack SCENE -o FILE.gno|NAME.h [options]\n\n"
         "Round SCENE to the integers of the core and write it with its camera, light and settings. Example:\n\n"
         "  gnomon pack lshape.scene -o lshape.h --method second-depth --size 320x240 --map 128\n");
    options_help(table, OPTION_COUNT, stdout);
    puts("\nExit status: 0 done, 2 bad usage or input (then nothing is written).");
}

/* What was asked for alone: edges that a .gno file brings take flash where nothing reads them. */
static int choose_edges(packed_scene *packed, const char *const values[], problem *why)
{
    if (values[EDGES] || choices_use_edges(&packed->settings))
        return packed_make_edges(packed, values[VERBOSE] != 0, why);
    packed_drop_edges(packed);
    return 0;
}

static int pack(packed_scene *packed, const char *scene, const char *const values[], problem *why)
{
    const char *path = values[OUTPUT];
    if (!path)
        return problem_of_usage(why, "no output; expected -o FILE.gno or -o NAME.h");
    int header = file_has_extension(path, ".h");
    if (!header && !file_has_extension(path, ".gno"))
        return problem_in(why, path, "has another extension; expected .gno or .h");
    if (packed_read(packed, scene, values[VERBOSE] != 0, why))
        return -1;
    int chosen = 0;
    for (int i = RENDER_METHOD; i <= RENDER_RECONSTRUCT; i++)
        chosen |= values[i] != 0;
    if (render_options_read(&packed->settings, packed, values, why) ||
        automatic_options_read(&packed->settings, packed, values, why))
        return -1;
    packed->has_method |= chosen;
    if (choose_edges(packed, values, why))
        return -1;
    if (header ? pack_write_header(packed, path, scene, why) : pack_write(packed, path, why))
        return -1;
    printf("%s: %" PRIu64 " triangles, %" PRIu64 " vertices; a world unit is 2^%d", path, packed_triangle_count(packed),
           packed_vertex_count(packed), packed->scale);
    if (packed->largest_rounding >= 0)
        printf(", largest rounding of a vertex %.3g world units", packed->largest_rounding);
    puts("");
    return 0;
}

int command_pack(int argc, char **argv)
{
    const char *values[OPTION_COUNT];
    command_line line;
    problem why;
    packed_scene packed = {.mesh_count = 0};
    int result = options_parse(table, OPTION_COUNT, argc, argv, values, &line, &why);
    if (!result && values[HELP]) {
        help();
        return EXIT_DONE;
    }
    if (!result && line.place_count != 1)
        result = problem_of_usage(&why, "%d scenes; expected one (gnomon pack --help)", line.place_count);
    if (!result)
        result = pack(&packed, line.places[0], values, &why);
    if (result)
        fprintf(stderr, "%s\n", why.text);
    packed_free(&packed);
    return result ? EXIT_BAD_INPUT : EXIT_DONE;
}
