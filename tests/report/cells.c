/* What a silhouette map makes of each pixel, as pictures: figures of docs/papers.md and docs/shadow-test.md.
 *
 *     cells SCENE TRUTH -o FOLDER [--letters] [--label LETTER] [options of gnomon render]
 *
 * TRUTH is the mask of `gnomon truth`. Receiver and reconstruction are wrapped (gn_cascade.h), so the pictures are of
 * the frame that `gnomon render` draws with the same options. Written into FOLDER, all as the camera sees them:
 *
 *     truth.png      the exact shadow, its border black
 *     before.png     each pixel as the texel that holds it decides
 *     after.png      as the reconstruction decides
 *     quadrants.png  which of a cell's four corners answers: upper left blue, upper right yellow, lower left green,
 *                    lower right violet
 *     texels.png     a chessboard of the texels that hold the pixels; the border of the exact shadow
 *     warped.png     a chessboard of the texels whose quadrants hold them; the same
 *     scene.png      the frame; every point of the silhouette map a red disc of a tenth of a texel, as the light sees
 * it
 *
 * The first four have the borders of cells in light blue, and points in red. In before.png and after.png grey: all four
 * corners of the cell agree; orange: they do not. --letters: L lit, S shadowed at the corners in after.png. --label: a
 * letter, A to F, in its corner. On standard output how many pixels silhouettes decide and how many they change, and
 * how many in empty cells among empty ones take another corner's answer than the nearest texel's; exit status 1 if the
 * core counted otherwise, 2 bad usage or input. */
#include "frame.h"
#include "gn_around.h"
#include "image.h"
#include "memory.h"
#include "render_options.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { OUTPUT = RENDER_OPTION_COUNT, LETTERS, LABEL, OPTION_COUNT };

static const option table[OPTION_COUNT] = {
    RENDER_OPTIONS,
    {"-o", "FOLDER", "where the pictures go"},
    {"--letters", 0, "L and S at the corners of cells"},
    {"--label", "LETTER", "A to F, into a corner of after.png"},
};

/* ---- recording ------------------------------------------------------------------------------------------------- */

#define NO_QUADRANT 4
#define NO_POINT 0x88

typedef struct pixel {
    double u, v; /* in texels, from the centre of the first one */
    uint8_t on_map, mixed;
    uint8_t before; /* of mixed pixels: 1 shadowed */
    uint8_t corner; /* 1: the texel that holds it says shadowed */
    uint8_t quadrant;
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
    gn_depth *one_dark; /* a map whose texels are all lit */
} recording;

/* The corner whose answer a place takes, 1 right, + 2 below: asked of the reconstruction with one corner dark at a
 * time.
 */
static uint8_t find_quadrant(const gn_lookup *lookup, uint32_t u, uint32_t v)
{
    static gn_points probe;
    const gn_wide_plane level = {(int64_t)1 << 31, 0, 0};
    uint32_t column = u >> lookup->bits, row = v >> lookup->bits;
    if (column >= lookup->last_column || row >= lookup->last_row)
        return NO_QUADRANT;
    gn_lookup fake = *lookup;
    fake.map = recording.one_dark;
    fake.stride = lookup->last_column + 1;
    probe.u[0] = u;
    probe.v[0] = v;
    for (uint32_t k = 0; k < 4; k++) {
        gn_depth *texel = recording.one_dark + (row + k / 2) * fake.stride + column + k % 2;
        *texel = 0;
        uint32_t dark = recording.how->sample(&fake, &probe, 0, &level);
        *texel = (gn_depth)-1;
        if (dark)
            return (uint8_t)k;
    }
    return NO_QUADRANT;
}

static pixel *recorded(const gn_points *points, int32_t i)
{
    return recording.pixels + (size_t)points->y * (size_t)recording.width + (size_t)(points->x + i);
}

static void prepare(const gn_context *context, gn_worker *worker, gn_points *points)
{
    recording.context = context;
    recording.worker = worker;
    if (recording.receiver->prepare)
        recording.receiver->prepare(context, worker, points);
}

static double in_texels(uint32_t place, uint32_t bits)
{
    return (double)(int32_t)place / (double)((uint32_t)1 << bits);
}

static void vote(const gn_lookup *lookup, gn_points *points)
{
    recording.how->vote(lookup, points);
    for (int32_t i = 0; i < points->count; i++) {
        pixel *p = recorded(points, i);
        uint32_t u = points->u[i], v = points->v[i];
        if (points->triangle[i] == GN_NO_TRIANGLE || u == GN_NOWHERE ||
            !gn_find_plane(recording.context, recording.worker, points->triangle[i], 0)->faces_light)
            continue;
        gn_wide_plane level = {points->z[i], 0, 0};
        p->on_map = 1;
        p->u = in_texels(u, lookup->bits);
        p->v = in_texels(v, lookup->bits);
        p->corner = gn_sample_nearest(lookup, points, i, &level) != 0;
        p->quadrant = find_quadrant(lookup, u, v);
    }
}

static uint32_t sample(const gn_lookup *lookup, gn_points *points, int32_t i, const gn_wide_plane *plane)
{
    uint32_t dark = recording.how->sample(lookup, points, i, plane);
    pixel *p = recorded(points, i);
    p->mixed = p->on_map && points->reconstructed[i];
    p->before = gn_sample_nearest(lookup, points, i, plane) != 0;
    return dark;
}

/* ---- what is painted ------------------------------------------------------------------------------------------- */

typedef uint8_t colour[3];

typedef struct job {
    const char *folder, *label;
    int letters;
    packed_scene packed;
    gn_settings settings;
    frame frame;
    image truth;
    const uint8_t *cells;
    uint32_t stride;
    problem why;
} job;

enum { BORDERS = 1, POINTS = 2, LARGE_POINTS = 4, LINE = 8 };

typedef void brush(const job *j, size_t at, uint8_t *out);

static const colour agreed[2] = {{215, 215, 215}, {95, 95, 95}}, decided[2] = {{255, 205, 125}, {150, 90, 10}};

static int is_lit(uint8_t mask)
{
    return mask >= 127;
}

static void paint_truth(const job *j, size_t at, uint8_t *out)
{
    memcpy(out, agreed[!is_lit(((const uint8_t *)j->truth.samples)[at])], 3);
}

static void paint_before(const job *j, size_t at, uint8_t *out)
{
    const pixel *p = &recording.pixels[at];
    memcpy(out, p->mixed ? decided[p->before] : agreed[!is_lit(j->frame.mask[at])], 3);
}

static void paint_after(const job *j, size_t at, uint8_t *out)
{
    memcpy(out, (recording.pixels[at].mixed ? decided : agreed)[!is_lit(j->frame.mask[at])], 3);
}

static void paint_quadrant(const job *j, size_t at, uint8_t *out)
{
    static const colour colours[NO_QUADRANT + 1] = {
        {140, 175, 230}, {240, 220, 120}, {150, 205, 150}, {205, 155, 215}, {230, 230, 230}};
    (void)j;
    memcpy(out, colours[recording.pixels[at].quadrant], 3);
}

static void paint_square(int32_t column, int32_t row, uint8_t *out)
{
    memset(out, (column ^ row) & 1 ? 230 : 170, 3);
}

static void paint_texel(const job *j, size_t at, uint8_t *out)
{
    const pixel *p = &recording.pixels[at];
    (void)j;
    paint_square((int32_t)floor(p->u + .5), (int32_t)floor(p->v + .5), out);
}

static void paint_warped(const job *j, size_t at, uint8_t *out)
{
    const pixel *p = &recording.pixels[at];
    if (p->quadrant == NO_QUADRANT)
        paint_texel(j, at, out);
    else
        paint_square((int32_t)floor(p->u) + p->quadrant % 2, (int32_t)floor(p->v) + p->quadrant / 2, out);
}

static void paint_scene(const job *j, size_t at, uint8_t *out)
{
    memcpy(out, j->frame.colour + 3 * at, 3);
}

/* Do two pixels lie in different cells? */
static int cell_differs(const pixel *a, const pixel *b)
{
    return a->on_map && b->on_map && (floor(a->u) != floor(b->u) || floor(a->v) != floor(b->v));
}

static int truth_differs(const job *j, size_t a, size_t b)
{
    const uint8_t *mask = j->truth.samples;
    return mask[a] != 255 && mask[b] != 255 && is_lit(mask[a]) != is_lit(mask[b]);
}

/* Is it within a part of a texel of a cell's point? */
static int is_near_point(const job *j, const pixel *p, double reach)
{
    for (int32_t k = 0; p->on_map && k < 9; k++) {
        int32_t column = (int32_t)floor(p->u) + k % 3 - 1, row = (int32_t)floor(p->v) + k / 3 - 1;
        if (column < 0 || row < 0 || column > j->settings.map_width - 2 || row > j->settings.map_height - 2)
            continue;
        uint8_t point = j->cells[(size_t)row * j->stride + (size_t)column];
        double x = p->u - column - (point & 15) / 16., y = p->v - row - (point >> 4) / 16.;
        if (point != NO_POINT && x * x + y * y <= reach * reach)
            return 1;
    }
    return 0;
}

static void paint_over(const job *j, uint32_t x, uint32_t y, int over, uint8_t *out)
{
    static const colour border = {90, 150, 255}, black = {0, 0, 0}, red = {225, 0, 0};
    size_t at = (size_t)y * j->settings.width + x, below = at + j->settings.width;
    const pixel *p = recording.pixels;
    int last_column = x + 1 == j->settings.width, last_row = y + 1 == j->settings.height;
    if ((over & BORDERS) &&
        ((!last_column && cell_differs(&p[at], &p[at + 1])) || (!last_row && cell_differs(&p[at], &p[below]))))
        memcpy(out, border, 3);
    if ((over & LINE) && ((!last_column && truth_differs(j, at, at + 1)) || (!last_row && truth_differs(j, at, below))))
        memcpy(out, black, 3);
    if ((over & (POINTS | LARGE_POINTS)) && is_near_point(j, &p[at], over & POINTS ? .1 : .2))
        memcpy(out, red, 3);
}

/* ---- letters --------------------------------------------------------------------------------------------------- */

/* Five columns of seven rows, the left one in the highest of five bits. */
static const struct glyph {
    char letter;
    uint8_t row[7];
} glyphs[] = {{'A', {14, 17, 17, 31, 17, 17, 17}}, {'B', {30, 17, 17, 30, 17, 17, 30}},
              {'C', {14, 17, 16, 16, 16, 17, 14}}, {'D', {30, 17, 17, 17, 17, 17, 30}},
              {'E', {31, 16, 16, 30, 16, 16, 31}}, {'F', {31, 16, 16, 30, 16, 16, 16}},
              {'L', {16, 16, 16, 16, 16, 16, 31}}, {'S', {15, 16, 16, 14, 1, 1, 30}}};

enum { GLYPHS = sizeof glyphs / sizeof *glyphs, TIMES = 2, GLYPH_WIDTH = 5 * TIMES, GLYPH_HEIGHT = 7 * TIMES };

/* Black on a white ground, from a corner; what is beyond the picture is not drawn. */
static void draw_letter(image *im, char letter, int32_t left, int32_t top)
{
    uint32_t g = 0;
    while (g < GLYPHS - 1 && glyphs[g].letter != letter)
        g++;
    for (int32_t y = -TIMES; y < GLYPH_HEIGHT + TIMES; y++)
        for (int32_t x = -TIMES; x < GLYPH_WIDTH + TIMES; x++) {
            int inside = x >= 0 && y >= 0 && x < GLYPH_WIDTH && y < GLYPH_HEIGHT;
            int ink = inside && (glyphs[g].row[y / TIMES] >> (4 - x / TIMES) & 1);
            if (left + x >= 0 && top + y >= 0 && left + x < (int32_t)im->width && top + y < (int32_t)im->height)
                memset((uint8_t *)im->samples + 3 * ((size_t)(top + y) * im->width + (size_t)(left + x)), ink ? 0 : 255,
                       3);
        }
}

/* What the texels say whose centres the picture shows: at the pixel nearest to each. */
static void draw_corners(const job *j, image *im)
{
    size_t texels = (size_t)j->settings.map_width * j->settings.map_height, count = (size_t)im->width * im->height;
    double *least = memory_take(texels, sizeof *least);
    size_t *nearest = memory_take(texels, sizeof *nearest);
    for (size_t t = 0; t < texels; t++)
        least[t] = .01;
    for (size_t at = 0; at < count; at++) {
        const pixel *p = &recording.pixels[at];
        double column = floor(p->u + .5), row = floor(p->v + .5), x = p->u - column, y = p->v - row;
        if (!p->on_map || column < 0 || row < 0 || column >= j->settings.map_width || row >= j->settings.map_height)
            continue;
        size_t t = (size_t)row * j->settings.map_width + (size_t)column;
        if (x * x + y * y < least[t]) {
            least[t] = x * x + y * y;
            nearest[t] = at;
        }
    }
    for (size_t t = 0; t < texels; t++)
        if (least[t] < .01)
            draw_letter(im, recording.pixels[nearest[t]].corner ? 'S' : 'L',
                        (int32_t)(nearest[t] % im->width) - GLYPH_WIDTH / 2,
                        (int32_t)(nearest[t] / im->width) - GLYPH_HEIGHT / 2);
    free(least);
    free(nearest);
}

/* ---- pictures -------------------------------------------------------------------------------------------------- */

static int paint(job *j, const char *name, brush *paint_pixel, int over)
{
    char path[1024];
    image im = image_make(j->settings.width, j->settings.height, 3, IMAGE_U8);
    for (uint32_t y = 0; y < im.height; y++)
        for (uint32_t x = 0; x < im.width; x++) {
            size_t at = (size_t)y * im.width + x;
            uint8_t *out = (uint8_t *)im.samples + 3 * at;
            if (j->frame.mask[at] == 255)
                memset(out, 12, 3);
            else
                paint_pixel(j, at, out);
            paint_over(j, x, y, over, out);
        }
    if (paint_pixel == paint_after && j->letters)
        draw_corners(j, &im);
    if (paint_pixel == paint_after && j->label)
        draw_letter(&im, j->label[0], 2 * TIMES, 2 * TIMES);
    snprintf(path, sizeof path, "%s/%s.png", j->folder, name);
    int result = image_write(&im, path, &j->why);
    image_free(&im);
    return result;
}

static int write_pictures(job *j)
{
    return paint(j, "truth", paint_truth, BORDERS | LINE | POINTS) ||
                   paint(j, "before", paint_before, BORDERS | POINTS) ||
                   paint(j, "after", paint_after, BORDERS | POINTS) ||
                   paint(j, "quadrants", paint_quadrant, BORDERS | POINTS) || paint(j, "texels", paint_texel, LINE) ||
                   paint(j, "warped", paint_warped, LINE) || paint(j, "scene", paint_scene, LARGE_POINTS)
               ? -1
               : 0;
}

/* ---- counts ---------------------------------------------------------------------------------------------------- */

static int is_empty(const job *j, int32_t column, int32_t row)
{
    if (column < 0 || row < 0 || column > j->settings.map_width - 2 || row > j->settings.map_height - 2)
        return 1;
    return j->cells[(size_t)row * j->stride + (size_t)column] == NO_POINT;
}

/* Pixels of cells that have no point and whose neighbours have none: the nearest texel is to answer. Returns how many
 * another corner answers. */
static uint64_t count_moved(const job *j, uint64_t *empty)
{
    uint64_t moved = 0;
    *empty = 0;
    for (size_t at = 0; at < (size_t)j->settings.width * j->settings.height; at++) {
        const pixel *p = &recording.pixels[at];
        int32_t column = (int32_t)floor(p->u), row = (int32_t)floor(p->v);
        if (!p->on_map || p->quadrant == NO_QUADRANT || !is_empty(j, column, row) || !is_empty(j, column - 1, row) ||
            !is_empty(j, column + 1, row) || !is_empty(j, column, row - 1) || !is_empty(j, column, row + 1))
            continue;
        ++*empty;
        moved += p->quadrant != (p->u - column >= .5) + 2 * (p->v - row >= .5);
    }
    return moved;
}

/* 1 if what was seen is what the core counted. */
static int counts_agree(const job *j)
{
    uint64_t mixed = 0, changed = 0, wrong[2] = {0};
    size_t count = (size_t)j->settings.width * j->settings.height;
    for (size_t at = 0; at < count; at++) {
        const pixel *p = &recording.pixels[at];
        int after = !is_lit(j->frame.mask[at]), truth = !is_lit(((const uint8_t *)j->truth.samples)[at]);
        mixed += p->mixed;
        changed += p->mixed && p->before != after;
        wrong[0] += p->mixed && p->before != truth;
        wrong[1] += p->mixed && after != truth;
    }
    printf("decided by silhouettes %" PRIu64 ", changed %" PRIu64 "; of those decided wrong before %" PRIu64
           ", after %" PRIu64 "\n",
           mixed, changed, wrong[0], wrong[1]);
    uint64_t empty, moved = count_moved(j, &empty);
    printf("without points about them %" PRIu64 ", of these not the nearest texel's %" PRIu64 "\n", empty, moved);
    gn_statistics s;
    gn_get_statistics(j->frame.context, &s);
    if (s.pixels_silhouette == mixed)
        return 1;
    fprintf(stderr, "cells: the core counted silhouette %" PRIu64 "; expected %" PRIu64 "\n", s.pixels_silhouette,
            mixed);
    return 0;
}

/* ---- the program ----------------------------------------------------------------------------------------------- */

static int render(job *j)
{
    const gn_receiver *receiver = j->settings.receiver;
    recording.receiver = receiver;
    recording.how = &gn_silhouettes;
    gn_reconstruction wrapped_how = gn_silhouettes;
    wrapped_how.vote = vote;
    wrapped_how.sample = sample;
    gn_receiver wrapped = *receiver;
    wrapped.prepare = prepare;
    wrapped.sunlit = wrapped.spotlit = 0; /* short cuts, past prepare and vote */
    recording.width = j->settings.width;
    recording.pixels = memory_take((size_t)j->settings.width * j->settings.height, sizeof *recording.pixels);
    size_t texels = (size_t)j->settings.map_width * j->settings.map_height;
    recording.one_dark = memory_take(texels, sizeof *recording.one_dark);
    memset(recording.one_dark, 255, texels * sizeof *recording.one_dark);
    j->settings.receiver = &wrapped;
    j->settings.reconstruction = &wrapped_how;
    j->settings.mask = 1;
    j->settings.format = GN_RGB888;
    if (frame_open(&j->frame, &j->packed.scene, &j->settings, 0, &j->why) ||
        frame_view_pass(&j->frame, &j->packed.camera, &j->packed.light, &j->why) ||
        frame_light_pass(&j->frame, &j->packed.light, &j->why) ||
        frame_camera_pass(&j->frame, &j->packed.camera, &j->why))
        return -1;
    j->cells = gn_silhouette_map(j->frame.context, &j->stride);
    return write_pictures(j);
}

static int run(job *j, const char *scene, const char *truth, const char *const values[])
{
    if (packed_read(&j->packed, scene, 0, &j->why) || render_options_read(&j->settings, &j->packed, values, &j->why) ||
        image_read_mask(&j->truth, truth, &j->why))
        return -1;
    if (j->settings.reconstruction != &gn_silhouettes || !j->settings.receiver || !j->settings.receiver->votes)
        return problem_of_usage(&j->why, "no silhouettes, or a receiver without votes; expected --method silhouette");
    if (j->truth.width != j->settings.width || j->truth.height != j->settings.height)
        return problem_in(&j->why, truth, "is %u x %u; expected the image's %u x %u", j->truth.width, j->truth.height,
                          j->settings.width, j->settings.height);
    return render(j);
}

int main(int argc, char **argv)
{
    const char *values[OPTION_COUNT];
    command_line line;
    job j = {.folder = 0};
    int agree = 0, result = options_parse(table, OPTION_COUNT, argc - 1, argv + 1, values, &line, &j.why);
    if (!result && (line.place_count != 2 || !values[OUTPUT]))
        result = problem_of_usage(&j.why, "%d files; expected SCENE TRUTH -o FOLDER", line.place_count);
    if (!result) {
        j.folder = values[OUTPUT];
        j.label = values[LABEL];
        j.letters = values[LETTERS] != 0;
        result = run(&j, line.places[0], line.places[1], values);
    }
    if (result)
        fprintf(stderr, "%s\n", j.why.text);
    else
        agree = counts_agree(&j);
    frame_close(&j.frame);
    packed_free(&j.packed);
    image_free(&j.truth);
    free(recording.pixels);
    free(recording.one_dark);
    return result ? 2 : !agree;
}
