/* One scene file at three scales, through the simulator's reader and quantiser (host/quantise.h): the block on its slab
 * in metres, in units of a kilometre and of a millimetre, and in units of 1/1024 and 1024 metres.
 *
 * The quantiser multiplies by the power of two that brings the largest coordinate, 1.9 m, into (2^23, 2^24]. Powers of
 * two cancel: the integers are the same, and so is every mask. By 10^-3 and 10^3 a metre becomes another number of
 * integers, 8.59 or 8.19 million in place of 8.39, and all is rounded anew, by half an integer. */
#include "hard.h"

#include "memory.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static const double scales[] = {1, 1.0 / 1024, 1024, 0.001, 1000};

enum { POWERS_OF_TWO = 3 /* the first three of scales */ };

/* Corners of the slab and of the block, metres: eight each, x fastest, then y. */
static const double boxes[2][3][2] = {{{-1.9, 1.9}, {-0.5, 0}, {-1.4, 1.4}}, {{-0.75, -0.25}, {0, 0.5}, {-0.5, 0.5}}};

/* Counter-clockwise from outside. */
static const char faces[] = "f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n";

static int write_box(const char *path, int which, double scale)
{
    FILE *file = fopen(path, "w");
    if (!file)
        return -1;
    for (int i = 0; i < 8; i++)
        fprintf(file, "v %.17g %.17g %.17g\n", scale * boxes[which][0][i & 1], scale * boxes[which][1][i >> 1 & 1],
                scale * boxes[which][2][i >> 2]);
    fputs(faces, file);
    return fclose(file);
}

/* The camera stands above and to the front; the sun at 45 degrees has the quantiser's box, a square of 1.02 times what
 * the scene is wide. */
static int write_scene(const char *path, double s)
{
    FILE *file = fopen(path, "w");
    if (!file)
        return -1;
    fprintf(file,
            "image 160 120\nmap 64\nambient 0.3\nlight directional direction 1 -1 0\n"
            "camera perspective eye %.17g %.17g %.17g target 0 0 0 up 0 1 0 fovy 40 near %.17g far %.17g\n"
            "mesh slab.obj surface closed color 0.8 0.8 0.75\nmesh block.obj surface closed color 0.7 0.5 0.3\n",
            -1.1 * s, 3.1 * s, 2.3 * s, 0.5 * s, 20 * s);
    return fclose(file);
}

/* Write the scene to a temporary folder, read it, remove it. 0 on success. */
static int read_scaled(packed_scene *packed, double scale, problem *why)
{
    static const char *const names[] = {"slab.obj", "block.obj", "hard.scene"};
    char folder[300], paths[COUNT(names)][340];
    const char *base = getenv("TMPDIR");
    snprintf(folder, sizeof folder, "%.250s/gnomon-hard-XXXXXX", base ? base : "/tmp");
    problem_in(why, folder, "cannot write a scene; expected a folder for temporary files");
    if (!mkdtemp(folder))
        return -1;
    for (size_t i = 0; i < COUNT(names); i++)
        snprintf(paths[i], sizeof paths[i], "%s/%s", folder, names[i]);
    int failed = write_box(paths[0], 0, scale) || write_box(paths[1], 1, scale) || write_scene(paths[2], scale) ||
                 packed_read(packed, paths[2], 0, why);
    for (size_t i = 0; i < COUNT(names); i++)
        unlink(paths[i]);
    rmdir(folder);
    return failed ? -1 : 0;
}

static int block_by_hand(const double p[3])
{
    int shadowed = p[0] > -0.75 && p[0] < 0.25 && fabs(p[2]) < 0.5;
    if (fabs(p[1]) < 1e-6)
        return shadowed ? BY_HAND_SHADOWED : BY_HAND_LIT;
    return p[1] > 0.499999 ? BY_HAND_LIT : BY_HAND_UNSAID;
}

/* What the first scale gave. */
typedef struct first_result {
    outcome outcomes[COLUMN_COUNT];
    uint8_t *masks[COLUMN_COUNT], *truth, *near;
    size_t count;
} first_result;

static void keep_first(const hard_row *row, first_result *first)
{
    first->count = (size_t)row->truth.width * row->truth.height;
    first->truth = memory_take(first->count, 1);
    first->near = memory_take(first->count, 1);
    memcpy(first->truth, row->truth.mask, first->count);
    memcpy(first->near, row->near, first->count);
    for (int method = 0; method < COLUMN_COUNT; method++) {
        first->outcomes[method] = row->outcomes[method];
        first->masks[method] = memory_take(first->count, 1);
        if (row->outcomes[method].ran)
            memcpy(first->masks[method], row->outcomes[method].mask, first->count);
    }
}

/* Pixels that differ and are not near a tie at either scale. */
static size_t differing(const hard_row *row, const first_result *first, const uint8_t *a, const uint8_t *b)
{
    size_t count = 0;
    for (size_t i = 0; i < first->count; i++)
        count += a[i] != b[i] && !row->near[i] && !first->near[i];
    return count;
}

/* Masks: equal in every pixel, or in every pixel that is not near a tie; and so the errors. */
static void check_scale(hard_row *row, const first_result *first, size_t which)
{
    const char *name = row->about->name;
    promise(row, differing(row, first, first->truth, row->truth.mask) == 0, 0, "%s_%g_has_the_same_truth", name,
            scales[which]);
    for (int method = 0; method < COLUMN_COUNT; method++) {
        const outcome *o = &row->outcomes[method], *f = &first->outcomes[method];
        if (!promise(row, o->ran && f->ran, 0, "%s_%g_%s_renders", name, scales[which], method_names[method]))
            continue;
        size_t other = which < POWERS_OF_TWO ? (size_t)memcmp(o->mask, first->masks[method], first->count) != 0
                                             : differing(row, first, o->mask, first->masks[method]);
        if (!promise(row, other == 0, 0, "%s_%g_%s_gives_an_equal_mask", name, scales[which], method_names[method]))
            say("%zu pixels differ", other);
        promise(row, o->false_shadow == f->false_shadow && o->false_light == f->false_light, 0,
                "%s_%g_%s_gives_equal_errors", name, scales[which], method_names[method]);
    }
}

static void run_scales(hard_row *row)
{
    first_result first;
    memset(&first, 0, sizeof first);
    for (size_t i = 0; i < COUNT(scales); i++) {
        problem why;
        memset(&row->packed, 0, sizeof row->packed);
        int failed = read_scaled(&row->packed, scales[i], &why);
        row->unit = scales[i] * ldexp(1, row->packed.scale);
        memset(row->origin, 0, sizeof row->origin);
        if (!promise(row, !failed, 0, "%s_%g_is_read", row->about->name, scales[i]))
            say("%s", why.text);
        if (failed || row_begin_packed(row, 1, 1)) {
            row_end(row);
            break;
        }
        for (int method = 0; method < COLUMN_COUNT; method++) {
            gn_settings s = method_settings(&row->packed, method, 0);
            row_measure(row, method, &s);
        }
        if (i == 0)
            keep_first(row, &first);
        else
            check_scale(row, &first, i);
        row_end(row);
    }
    for (int method = 0; method < COLUMN_COUNT; method++)
        free(first.masks[method]);
    free(first.truth);
    free(first.near);
}

static const hard_case cases[] = {
    {.name = "scaled_files",
     .group = "Numbers",
     .title = "the block as a scene file, in metres, 10^-3 and 10^3, 2^-10 and 2^10 times that",
     .expected = "equal errors; equal masks, but for pixels near a tie at 10^-3 and 10^3",
     .advice = "The unit of a scene file does not matter: the simulator scales the scene into the range.",
     .by_hand = block_by_hand,
     .run = run_scales},
};

const hard_list file_cases = {cases, COUNT(cases)};
