/* What each stage of the shadow test does to each pixel, as pictures: the figures of docs/shadow-test.md.
 *
 *     stages SCENE -o FOLDER [--strict] [options of gnomon render]
 *
 * The receiver is wrapped in one that looks at a block before and after the cascade's virtual samples (gn_cascade.h),
 * so the pictures are of the frame that `gnomon render` draws with the same options. Written into FOLDER:
 *
 *     texels.png    where the points lie: texels of the map as a chessboard, from the nearest to the light, bright, to
 *                   the farthest
 *     votes.png     what the point's own depth decides: light grey lit, dark grey shadowed, orange open
 *     samples.png   what virtual samples make of the open ones: green lit, purple shadowed, yellow partly lit
 *     mask.png      the lit parts, 0 to 254, as --mask
 *
 * In all but the mask: blue grey turned away from the light, blue outside its box or frustum, nearly black no surface.
 * On standard output the counts, which must be those of the core's statistics (exit status 1 if not, 2 bad usage or
 * input).
 *
 * --strict: virtual samples lit where z < stored, as in figure 10 of Wang & Molnar; gnomon has z <= stored. */
#include "frame.h"
#include "gn_cascade.h"
#include "image.h"
#include "memory.h"
#include "render_options.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { OUTPUT = RENDER_OPTION_COUNT, STRICT, OPTION_COUNT };

static const option table[OPTION_COUNT] = {
    RENDER_OPTIONS,
    {"-o", "FOLDER", "where the pictures go"},
    {"--strict", 0, "virtual samples: z < stored"},
};

/* ---- recording ------------------------------------------------------------------------------------------------- */

typedef enum state {
    NO_SURFACE,
    TURNED_AWAY,
    OUTSIDE,
    VOTED_LIT,
    VOTED_SHADOWED,
    OPEN,
    SAMPLED_LIT,
    SAMPLED_SHADOWED,
    SAMPLED_PARTLY,
    STATE_COUNT
} state;

typedef struct pixel {
    uint8_t state;
    uint8_t texel; /* 0 or 1 of the chessboard */
    uint32_t depth;
} pixel;

/* What the wrapped objects read and write: the cascade's callbacks carry no pointer of ours, and there is one worker.
 */
static struct {
    const gn_receiver *receiver;
    const gn_reconstruction *how;
    const gn_context *context;
    gn_worker *worker;
    pixel *pixels;
    int32_t width;
} recording;

/* By the plane itself: z < stored is z + 1 <= stored, the same plane one stored unit farther. */
static uint32_t sample_strictly(const gn_lookup *lookup, gn_points *points, int32_t i, const gn_wide_plane *nearer)
{
    const gn_receiver_plane *plane = gn_find_plane(recording.context, recording.worker, points->triangle[i], 0);
    gn_wide_plane farther = plane->exists ? plane->plane : *nearer;
    farther.base += (int64_t)1 << (32 - GN_DEPTH_BITS);
    return recording.how->sample(lookup, points, i, &farther);
}

static pixel *recorded(const gn_points *points, int32_t i)
{
    return recording.pixels + (size_t)points->y * (size_t)recording.width + (size_t)(points->x + i);
}

static state voted(const gn_lookup *lookup, const gn_points *points, int32_t i)
{
    if (points->triangle[i] == GN_NO_TRIANGLE)
        return NO_SURFACE;
    if (!gn_find_plane(recording.context, recording.worker, points->triangle[i], 0)->faces_light)
        return TURNED_AWAY;
    if (points->u[i] == GN_NOWHERE)
        return OUTSIDE;
    return points->dark[i] == 0 ? VOTED_LIT : points->dark[i] == lookup->whole ? VOTED_SHADOWED : OPEN;
}

static void prepare(const gn_context *context, gn_worker *worker, gn_points *points)
{
    recording.context = context;
    recording.worker = worker;
    if (recording.receiver->prepare)
        recording.receiver->prepare(context, worker, points);
}

static void vote(const gn_lookup *lookup, gn_points *points)
{
    recording.how->vote(lookup, points);
    for (int32_t i = 0; i < points->count; i++) {
        pixel *p = recorded(points, i);
        p->state = (uint8_t)voted(lookup, points, i);
        p->depth = points->z[i];
        p->texel = (uint8_t)((gn_texel(points->u[i], lookup->last_column, lookup->bits) ^
                              gn_texel(points->v[i], lookup->last_row, lookup->bits)) &
                             1);
    }
}

/* Called where there are open points. */
static void resample(const gn_context *context, gn_worker *worker, const gn_lookup *lookup, gn_points *points,
                     gn_sample *sample)
{
    recording.receiver->resample(context, worker, lookup, points, sample);
    for (int32_t i = 0; i < points->count; i++) {
        pixel *p = recorded(points, i);
        uint32_t dark = points->dark[i];
        if (p->state == OPEN)
            p->state = dark == 0 ? SAMPLED_LIT : dark == lookup->whole ? SAMPLED_SHADOWED : SAMPLED_PARTLY;
    }
}

/* ---- pictures -------------------------------------------------------------------------------------------------- */

typedef uint8_t colour[3];

static struct {
    uint32_t nearest, farthest;
} depths;

static void find_depths(size_t count)
{
    depths.nearest = 0xffffffffu;
    depths.farthest = 0;
    for (size_t i = 0; i < count; i++) {
        const pixel *p = &recording.pixels[i];
        if (p->state < VOTED_LIT)
            continue;
        depths.nearest = p->depth < depths.nearest ? p->depth : depths.nearest;
        depths.farthest = p->depth > depths.farthest ? p->depth : depths.farthest;
    }
}

static void paint_texels(const pixel *p, uint8_t *out)
{
    uint64_t range = (uint64_t)depths.farthest - depths.nearest + 1;
    int bright = 245 - (int)(125 * (uint64_t)(p->depth - depths.nearest) / range);
    memset(out, p->texel ? bright : bright * 3 / 4, 3);
}

static const colour grounds[VOTED_LIT] = {
    [NO_SURFACE] = {12, 12, 16}, [TURNED_AWAY] = {62, 62, 88}, [OUTSIDE] = {70, 110, 200}};

static void paint_votes(const pixel *p, uint8_t *out)
{
    static const colour colours[STATE_COUNT] = {[VOTED_LIT] = {215, 215, 215},
                                                [VOTED_SHADOWED] = {95, 95, 95},
                                                [SAMPLED_LIT] = {255, 150, 0},
                                                [SAMPLED_SHADOWED] = {255, 150, 0},
                                                [SAMPLED_PARTLY] = {255, 150, 0}};
    memcpy(out, colours[p->state], 3);
}

static void paint_samples(const pixel *p, uint8_t *out)
{
    static const colour colours[STATE_COUNT] = {[VOTED_LIT] = {215, 215, 215},
                                                [VOTED_SHADOWED] = {95, 95, 95},
                                                [SAMPLED_LIT] = {40, 170, 60},
                                                [SAMPLED_SHADOWED] = {150, 30, 160},
                                                [SAMPLED_PARTLY] = {250, 220, 0}};
    memcpy(out, colours[p->state], 3);
}

typedef struct job {
    const char *folder;
    packed_scene packed;
    gn_settings settings;
    frame frame;
    problem why;
} job;

static int write_picture(job *j, const char *name, const image *im)
{
    char path[1024];
    snprintf(path, sizeof path, "%s/%s.png", j->folder, name);
    return image_write(im, path, &j->why);
}

static int paint(job *j, const char *name, void (*brush)(const pixel *p, uint8_t *out))
{
    image im = image_make(j->settings.width, j->settings.height, 3, IMAGE_U8);
    size_t count = (size_t)im.width * im.height;
    for (size_t i = 0; i < count; i++) {
        const pixel *p = &recording.pixels[i];
        uint8_t *out = (uint8_t *)im.samples + 3 * i;
        if (p->state < VOTED_LIT)
            memcpy(out, grounds[p->state], 3);
        else
            brush(p, out);
    }
    int result = write_picture(j, name, &im);
    image_free(&im);
    return result;
}

static int write_pictures(job *j)
{
    find_depths((size_t)j->settings.width * j->settings.height);
    image mask = {j->settings.width, j->settings.height, 1, IMAGE_U8, j->frame.mask};
    return paint(j, "texels", paint_texels) || paint(j, "votes", paint_votes) || paint(j, "samples", paint_samples) ||
                   write_picture(j, "mask", &mask)
               ? -1
               : 0;
}

/* ---- counts ---------------------------------------------------------------------------------------------------- */

/* 1 if what was seen is what the core counted. */
static int counts_agree(const job *j)
{
    uint64_t seen[STATE_COUNT] = {0};
    size_t count = (size_t)j->settings.width * j->settings.height;
    for (size_t i = 0; i < count; i++)
        seen[recording.pixels[i].state]++;
    uint64_t voted = seen[VOTED_LIT] + seen[VOTED_SHADOWED];
    uint64_t sampled = seen[SAMPLED_LIT] + seen[SAMPLED_SHADOWED] + seen[SAMPLED_PARTLY];
    printf("surface %" PRIu64 "; turned away %" PRIu64 ", outside %" PRIu64 "\n", count - seen[NO_SURFACE],
           seen[TURNED_AWAY], seen[OUTSIDE]);
    printf("by the point's depth %" PRIu64 ": lit %" PRIu64 ", shadowed %" PRIu64 "\n", voted, seen[VOTED_LIT],
           seen[VOTED_SHADOWED]);
    printf("by virtual samples %" PRIu64 ": lit %" PRIu64 ", shadowed %" PRIu64 ", partly lit %" PRIu64 "\n", sampled,
           seen[SAMPLED_LIT], seen[SAMPLED_SHADOWED], seen[SAMPLED_PARTLY]);
    gn_statistics s;
    gn_get_statistics(j->frame.context, &s);
    if (s.pixels_agreed == voted && s.pixels_virtual == sampled && s.pixels_outside == seen[OUTSIDE] &&
        s.pixels_shaded == count - seen[NO_SURFACE] && s.pixels_fractional == seen[SAMPLED_PARTLY])
        return 1;
    fprintf(stderr,
            "stages: the core counted agreed %" PRIu64 ", virtual %" PRIu64 ", outside %" PRIu64 ", shaded %" PRIu64
            ", fractional %" PRIu64 "; expected the counts above\n",
            s.pixels_agreed, s.pixels_virtual, s.pixels_outside, s.pixels_shaded, s.pixels_fractional);
    return 0;
}

/* ---- the program ----------------------------------------------------------------------------------------------- */

static int run(job *j, const char *scene, int strict, const char *const values[])
{
    if (packed_read(&j->packed, scene, 0, &j->why) || render_options_read(&j->settings, &j->packed, values, &j->why))
        return -1;
    const gn_receiver *receiver = j->settings.receiver;
    if (!receiver || !receiver->votes || !receiver->resample)
        return problem_of_usage(&j->why, "the receiver has no votes that virtual samples follow; expected --receiver "
                                         "virtual");
    recording.receiver = receiver;
    recording.how = j->settings.reconstruction ? j->settings.reconstruction : receiver->nearest;
    gn_reconstruction wrapped_how = *recording.how;
    wrapped_how.vote = vote;
    if (strict)
        wrapped_how.sample = sample_strictly;
    gn_receiver wrapped = *receiver;
    wrapped.prepare = prepare;
    wrapped.resample = resample;
    wrapped.sunlit = wrapped.spotlit = 0; /* short cuts, past prepare and vote */
    wrapped.nearest = &wrapped_how;
    recording.width = j->settings.width;
    recording.pixels = memory_take((size_t)j->settings.width * j->settings.height, sizeof *recording.pixels);
    j->settings.receiver = &wrapped;
    j->settings.reconstruction = j->settings.reconstruction ? &wrapped_how : 0;
    j->settings.mask = 1;
    j->settings.format = GN_NO_COLOUR;
    if (frame_open(&j->frame, &j->packed.scene, &j->settings, 0, &j->why) ||
        frame_view_pass(&j->frame, &j->packed.camera, &j->packed.light, &j->why) ||
        frame_light_pass(&j->frame, &j->packed.light, &j->why) ||
        frame_camera_pass(&j->frame, &j->packed.camera, &j->why))
        return -1;
    return write_pictures(j);
}

int main(int argc, char **argv)
{
    const char *values[OPTION_COUNT];
    command_line line;
    job j = {.folder = 0};
    int agree = 0, result = options_parse(table, OPTION_COUNT, argc - 1, argv + 1, values, &line, &j.why);
    if (!result && (line.place_count != 1 || !values[OUTPUT]))
        result = problem_of_usage(&j.why, "%d scenes; expected SCENE -o FOLDER [--strict] [options of gnomon render]",
                                  line.place_count);
    if (!result) {
        j.folder = values[OUTPUT];
        result = run(&j, line.places[0], values[STRICT] != 0, values);
    }
    if (result)
        fprintf(stderr, "%s\n", j.why.text);
    else
        agree = counts_agree(&j);
    frame_close(&j.frame);
    packed_free(&j.packed);
    free(recording.pixels);
    return result ? 2 : !agree;
}
