/* Lanes: several cores in one simulator, so that one run can compare them.
 *
 * A lane is the core compiled once, for 16 or 32 bits of depth, with the parts of the simulator that name its objects
 * (lane.c, choices, method, render_options, settings_report). Every program has the lane of its own depth; the others
 * are objects of their own whose symbols are local but for the lane itself (Makefile), and lane_find says which are
 * there. A lane renders frames as a small machine would: one worker, regions as gn_make_plan chooses them, colours of
 * 16 bits and no mask, all passes; the mask comes from one frame more.
 *
 * A lane that counts has a core compiled by clang as plain 32-bit code (GN_WIDE_DIVIDE 0, no vectors, no loop unrolled)
 * in which every basic block adds up what it does (count_operations.awk). Its times say nothing.
 */
#ifndef LANE_H
#define LANE_H

#include "packed.h"

/* In a pass, as the compiler's intermediate code has them, whatever their width: multiplies, and divisions by a
 * constant; divisions and remainders by anything else; additions and subtractions; reads from and writes to memory,
 * local arrays included, of a block that is copied its words of 32 bits; shifts, logic, comparisons, selections, jumps
 * and calls. Addresses, conversions and variables that need no memory are none. */
typedef enum lane_operation {
    LANE_MULTIPLY,
    LANE_DIVIDE,
    LANE_ADD,
    LANE_LOAD,
    LANE_STORE,
    LANE_OTHER,
    LANE_OPERATIONS
} lane_operation;

/* LANE_CAMERA holds the light pass as well where a point light has one map at a time. */
typedef enum lane_pass { LANE_VIEW, LANE_LIGHT, LANE_CAMERA, LANE_PASSES } lane_pass;

typedef struct lane_frame {
    /* Of the settings with one worker, RGB565 and no mask, by a core without statistics and with planes and colours for
     * 64 triangles (GN_COLOUR_CACHE): a firmware's, but for pointers of this machine's size (of 64 bits: 168 to 450
     * bytes more than of 32). */
    gn_plan plan;
    /* Of one frame of these regions. A lane that counts operations does not count these: zeros but for map_bytes and
     * silhouette_edges. */
    gn_statistics statistics;
    uint32_t width, height;
    uint8_t *mask;               /* width x height, as settings.mask has it; free() it */
    double seconds[LANE_PASSES]; /* of processor time, least of the runs; 0 for a pass that is not */
    uint64_t operations[LANE_PASSES][LANE_OPERATIONS]; /* of one frame; zeros in a lane that does not count */
    char settings[512];                                /* settings_report_text, or "shadow volumes" */
} lane_frame;

/* values: RENDER_OPTION_COUNT of them (render_options.h), RENDER_METHOD among them. packed: only read, so that threads
 * may share it; its meshes have edges (packed_make_edges). Of packed->settings only the sizes count.
 * Both return 0, or -1 and the problem: also what makes no sense together. */
typedef struct lane {
    int depth_bits, counts;

    /* Render `runs` frames, 0 or more, and one for the mask; 0 leaves statistics, seconds and operations zero.
     * lane_frame_free() it; after an error there is nothing to free. */
    int (*render)(lane_frame *f, const packed_scene *packed, const char *const values[], int runs, problem *why);

    /* The same without the mask, runs 1 or more: nothing to free. */
    int (*measure)(lane_frame *f, const packed_scene *packed, const char *const values[], int runs, problem *why);

    /* lane_frame.plan alone, for sizes that fit a budget. */
    int (*plan)(gn_plan *plan, const packed_scene *packed, const char *const values[], problem *why);
} lane;

/* The lane of 16 or 32 bits of depth, one that counts operations or not; 0: it is not in this program. */
const lane *lane_find(int depth_bits, int counts);

void lane_frame_free(lane_frame *f);

/* ---- between lane.c and lanes.c -------------------------------------------------------------------------------- */

/* In every lane's object, by another name in all but the program's own. */
extern const lane lane_here;

/* The lane whose plans are a firmware's; 0: not in this program, then plans are those of lane_here. */
const lane *lane_of_firmware(int depth_bits);

#endif
