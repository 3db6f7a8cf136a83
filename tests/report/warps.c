/* How fits and warps spread what a camera sees over the texels of a map: figures of docs/papers.md and
 * docs/parameterisations.md.
 *
 *     warps SCENE -o FOLDER [options of gnomon render]
 *
 * The frame is drawn twice: without the warp, by a receiver that keeps each point's place on the map before it does
 * what virtual samples do, and then as asked for, to see where the warp's tables send these places. Written into
 * FOLDER:
 *
 *     plane.png      the light's whole plane, the brighter the more pixels see a place; lines through the centres of
 *                    texels, orange along columns and blue along rows; a red frame: what the map covers
 *     unused.png     the same without lines: what the map covers by its texels, blue those that no pixel falls into
 *     before.png     pixels of each texel, if the map were not warped; black: none
 *     after.png      of the map as it is
 *     map.png        the depths of the map as it is
 *     flat.png       of the map without the warp
 *     rows.png       non-orthogonal: pixels of each texel when rows are warped, and columns not yet
 *     functions.png  non-orthogonal: the function of each row; yellow moves to the right, blue to the left
 *     rows.svg       non-orthogonal: pixels of five rows about the middle, where they fall into the map before and
 * after these rows are warped; below, how many fall into each column of texels, of all rows curves.svg     rectilinear:
 * the functions of columns and of rows, from a place on the plane to one on the map
 *
 * Pixels of a texel are shown on a scale of logarithms that is the same for all pictures. On standard output: how
 * unevenly pixels fall into texels, which is the standard deviation over the mean, the share of texels into which none
 * falls, and pixels a texel that pixels share with others, on the mean of pixels. Exit status: 0 done, 2 bad usage or
 * input. */
#include "depth_picture.h"
#include "file.h"
#include "frame.h"
#include "gn_parameterisation.h"
#include "memory.h"
#include "render_options.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { OUTPUT = RENDER_OPTION_COUNT, OPTION_COUNT };
enum { SIDE = 400, LINES = 32, ONE = 1 << 30 };

static const option options[OPTION_COUNT] = {RENDER_OPTIONS, {"-o", "FOLDER", "where the pictures go"}};

/* ---- samples --------------------------------------------------------------------------------------------------- */

/* On what the map covers, in 2^-30 of its sides. */
typedef struct place {
    uint32_t x, y;
} place;

/* What the wrapped receiver writes: its callbacks carry no pointer of ours, and there is one worker. */
static struct {
    place *places;
    size_t count;
} seen;

static uint32_t share_of(uint32_t texels, uint32_t count, uint32_t bits)
{
    uint64_t from_border = (uint64_t)texels + ((uint64_t)1 << (bits - 1));
    uint64_t share = (from_border << (30 - bits)) / count;
    return share < ONE ? (uint32_t)share : ONE - 1;
}

static void keep_places(const gn_context *context, gn_worker *worker, gn_points *points)
{
    uint32_t bits = gn_point_bits(context);
    (void)worker;
    for (int32_t i = 0; i < points->count; i++) {
        if (points->triangle[i] == GN_NO_TRIANGLE || points->u[i] == GN_NOWHERE)
            continue;
        seen.places[seen.count].x = share_of(points->u[i], context->settings.map_width, bits);
        seen.places[seen.count++].y = share_of(points->v[i], context->settings.map_height, bits);
    }
}

typedef struct job {
    const char *folder;
    packed_scene packed;
    gn_settings settings;
    frame flat, frame; /* without the warp, and as asked for */
    gn_rectangle rectangle;
    uint32_t columns, rows;
    problem why;
} job;

static int draw(job *j, frame *f, const gn_settings *settings, int keep_layers)
{
    return frame_open(f, &j->packed.scene, settings, keep_layers, &j->why) ||
                   frame_view_pass(f, &j->packed.camera, &j->packed.light, &j->why) ||
                   frame_light_pass(f, &j->packed.light, &j->why)
               ? -1
               : 0;
}

static int draw_frames(job *j)
{
    gn_settings flat = j->settings;
    gn_receiver wrapped = gn_virtual;
    wrapped.prepare = keep_places;
    wrapped.sunlit = wrapped.spotlit = 0; /* short cuts, past prepare */
    flat.warp = 0;
    flat.receiver = &wrapped;
    flat.reconstruction = 0;
    flat.mask = 1;
    flat.format = GN_NO_COLOUR;
    seen.places = memory_take((size_t)flat.width * flat.height, sizeof *seen.places);
    if (draw(j, &j->flat, &flat, 1) || frame_camera_pass(&j->flat, &j->packed.camera, &j->why) ||
        draw(j, &j->frame, &j->settings, 1))
        return -1;
    gn_whole_plane(&j->rectangle, &j->packed.light);
    if (j->settings.fit)
        j->rectangle = j->flat.rectangle;
    return 0;
}

/* ---- where samples fall ---------------------------------------------------------------------------------------- */

typedef enum stage { BEFORE, ROWS, AFTER } stage;

/* From a place in 2^-30 to one in texels from the first centre, linear between centres; at the borders the map ends
 * half a texel further. */
static double find_place(const uint16_t *table, uint32_t count, uint32_t share)
{
    double fine = ldexp(share, GN_FINE_BITS - 30) - 0.5;
    uint32_t next = 0;
    while (next < count && table[next] <= fine)
        next++;
    if (next == 0)
        return (fine - table[0]) / (2 * table[0] + 1);
    double from = table[next - 1], width = next < count ? table[next] - from : 2 * (GN_FINE - from) - 1;
    return next - 1 + (fine - from) / width;
}

static uint32_t find_texel(const uint16_t *table, uint32_t count, uint32_t share)
{
    double texel = floor(find_place(table, count, share) + 0.5);
    return (uint32_t)fmin(fmax(texel, 0), count - 1);
}

static const uint16_t *band_of(const job *j, const gn_grid *grid, uint32_t share)
{
    return grid->across + (size_t)((uint64_t)share * j->rows >> 30) * j->columns;
}

/* The texel that a sample falls into, at a stage of the warp. */
static size_t texel_of(const job *j, const place *p, stage at)
{
    const gn_grid *grid = at == BEFORE ? 0 : j->frame.context->grid;
    uint32_t column = (uint32_t)((uint64_t)p->x * j->columns >> 30), row = (uint32_t)((uint64_t)p->y * j->rows >> 30);
    if (grid) {
        column = find_texel(grid->columns ? grid->columns : band_of(j, grid, p->y), j->columns, p->x);
        const uint16_t *down = grid->rows ? grid->rows : grid->down + (size_t)column * j->rows;
        row = at == ROWS ? row : find_texel(down, j->rows, p->y);
    }
    return (size_t)row * j->columns + column;
}

static uint32_t *count_samples(const job *j, stage at)
{
    uint32_t *counts = memory_take((size_t)j->columns * j->rows, sizeof *counts);
    memset(counts, 0, (size_t)j->columns * j->rows * sizeof *counts);
    for (size_t i = 0; i < seen.count; i++)
        counts[texel_of(j, &seen.places[i], at)]++;
    return counts;
}

static double unevenness(const double *counts, size_t n)
{
    double sum = 0, squares = 0;
    for (size_t i = 0; i < n; i++) {
        sum += counts[i];
        squares += counts[i] * counts[i];
    }
    return sqrt(squares / (double)n - sum / (double)n * (sum / (double)n)) / (sum / (double)n);
}

static void report(const job *j, const char *name, const uint32_t *counts)
{
    size_t n = (size_t)j->columns * j->rows, empty = 0;
    double *texels = memory_take(n, sizeof *texels), *columns = memory_take(j->columns, sizeof *columns);
    double squares = 0;
    for (size_t i = 0; i < j->columns; i++)
        columns[i] = 0;
    for (size_t i = 0; i < n; i++) {
        texels[i] = counts[i];
        columns[i % j->columns] += counts[i];
        squares += (double)counts[i] * counts[i];
        empty += !counts[i];
    }
    printf("    %-8s unevenness %.2f, of whole columns %.2f; texels without pixels %.1f %%; a pixel shares its texel "
           "with %.1f\n",
           name, unevenness(texels, n), unevenness(columns, j->columns), 100.0 * (double)empty / (double)n,
           squares / (double)seen.count);
    free(texels);
    free(columns);
}

/* ---- pictures -------------------------------------------------------------------------------------------------- */

static int write_picture(job *j, const char *name, image *im)
{
    char path[1024];
    snprintf(path, sizeof path, "%s/%s.png", j->folder, name);
    int result = image_write(im, path, &j->why);
    image_free(im);
    return result;
}

/* 0 black; from 40 for one to 255 for 256 and more, of what would be spread evenly, as logarithms. */
static uint8_t brightness(double count)
{
    double bright = count > 0 ? 40 + 215 * log2(1 + count) / 8 : 0;
    return (uint8_t)fmin(bright, 255);
}

static int write_counts(job *j, const char *name, const uint32_t *counts)
{
    image im = image_make(j->columns, j->rows, 3, IMAGE_U8);
    for (size_t i = 0; i < (size_t)im.width * im.height; i++)
        memset((uint8_t *)im.samples + 3 * i, brightness(counts[i]), 3);
    return write_picture(j, name, &im);
}

/* From shares of the rectangle's sides to a pixel of the plane. */
static pixel pixel_of(const job *j, double across, double down)
{
    const gn_rectangle *r = &j->rectangle;
    double along = r->low[0] + across * r->size[0], beside = r->low[1] + down * r->size[1];
    double x = along * r->cosine - beside * r->sine, y = along * r->sine + beside * r->cosine;
    return (pixel){(int32_t)floor(ldexp(x * SIDE, -60)), (int32_t)floor(ldexp(y * SIDE, -60))};
}

static pixel centre_of(const job *j, uint32_t (*places)[2], uint32_t column, uint32_t row)
{
    const uint32_t *p = places[(size_t)row * j->columns + column];
    return pixel_of(j, ldexp(p[0], -32), ldexp(p[1], -32));
}

static uint32_t next_line(uint32_t number, uint32_t count)
{
    uint32_t step = (count + LINES - 1) / LINES, next = number + step;
    return number + 1 < count && next >= count ? count - 1 : next;
}

static void draw_grid(const job *j, image *im)
{
    static const uint8_t orange[3] = {255, 128, 0}, blue[3] = {0, 128, 255};
    uint32_t(*places)[2] = frame_texel_places(&j->frame);
    for (uint32_t i = 0; i < j->columns; i = next_line(i, j->columns))
        for (uint32_t k = 1; k < j->rows; k++)
            depth_picture_line(im, centre_of(j, places, i, k - 1), centre_of(j, places, i, k), orange);
    for (uint32_t k = 0; k < j->rows; k = next_line(k, j->rows))
        for (uint32_t i = 1; i < j->columns; i++)
            depth_picture_line(im, centre_of(j, places, i - 1, k), centre_of(j, places, i, k), blue);
    free(places);
}

static void draw_frame(const job *j, image *im)
{
    static const double corners[5][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0, 0}};
    static const uint8_t red[3] = {255, 0, 0};
    for (int i = 0; i < 4; i++)
        depth_picture_line(im, pixel_of(j, corners[i][0], corners[i][1]),
                           pixel_of(j, corners[i + 1][0], corners[i + 1][1]), red);
}

/* The plane with samples as bright dots. */
static image make_plane(const job *j)
{
    image im = image_make(SIDE, SIDE, 3, IMAGE_U8);
    uint32_t *counts = memory_take((size_t)SIDE * SIDE, sizeof *counts);
    memset(counts, 0, (size_t)SIDE * SIDE * sizeof *counts);
    for (size_t i = 0; i < seen.count; i++) {
        pixel p = pixel_of(j, ldexp(seen.places[i].x, -30), ldexp(seen.places[i].y, -30));
        if (p.x >= 0 && p.x < SIDE && p.y >= 0 && p.y < SIDE)
            counts[p.y * SIDE + p.x]++;
    }
    for (size_t i = 0; i < (size_t)SIDE * SIDE; i++)
        memset((uint8_t *)im.samples + 3 * i, brightness(counts[i]), 3);
    free(counts);
    return im;
}

static int write_plane(job *j)
{
    image im = make_plane(j);
    if (j->settings.fit || j->settings.warp)
        draw_grid(j, &im);
    draw_frame(j, &im);
    return write_picture(j, "plane", &im);
}

/* What the map covers, SIDE x SIDE, each place as the texel is that holds it. */
static int write_unused(job *j, const uint32_t *counts)
{
    image im = image_make(SIDE, SIDE, 3, IMAGE_U8);
    for (uint32_t y = 0; y < SIDE; y++)
        for (uint32_t x = 0; x < SIDE; x++) {
            place p = {(uint32_t)((uint64_t)(2 * x + 1) * ONE / (2 * SIDE)),
                       (uint32_t)((uint64_t)(2 * y + 1) * ONE / (2 * SIDE))};
            size_t at = texel_of(j, &p, AFTER);
            int odd = (int)((at % j->columns + at / j->columns) & 1);
            uint8_t *out = (uint8_t *)im.samples + 3 * ((size_t)y * SIDE + x);
            uint8_t bright = brightness(counts[at]);
            memset(out, odd ? bright : bright * 7 / 8, 3);
            if (!counts[at]) {
                out[1] = odd ? 90 : 60;
                out[2] = odd ? 230 : 200;
            }
        }
    return write_picture(j, "unused", &im);
}

/* Offsets of the rows' functions: full colour at a quarter of the map's width. */
static int write_functions(job *j, const gn_grid *grid)
{
    image im = image_make(j->columns, j->rows, 3, IMAGE_U8);
    for (uint32_t y = 0; y < j->rows; y++)
        for (uint32_t x = 0; x < j->columns; x++) {
            uint32_t share = (2 * x + 1) * (ONE / 2 / j->columns);
            double to = find_place(grid->across + (size_t)y * j->columns, j->columns, share);
            double offset = (to - x) / j->columns;
            uint8_t bright = (uint8_t)fmin(255, fabs(offset) * 4 * 255);
            uint8_t *out = (uint8_t *)im.samples + 3 * ((size_t)y * j->columns + x);
            out[0] = out[1] = offset > 0 ? bright : 0;
            out[2] = offset > 0 ? 0 : bright;
        }
    return write_picture(j, "functions", &im);
}

static int begin_drawing(job *j, const char *name, int width, int height, file_output *output)
{
    char path[1024];
    snprintf(path, sizeof path, "%s/%s.svg", j->folder, name);
    if (file_output_open(output, path, &j->why))
        return -1;
    fprintf(output->stream,
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 %d %d\" width=\"%d\" height=\"%d\">"
            "<rect width=\"%d\" height=\"%d\" fill=\"#fff\"/>\n",
            width, height, width, height, width, height);
    return 0;
}

static int end_drawing(job *j, file_output *output)
{
    fprintf(output->stream, "</svg>\n");
    return file_output_finish(output, &j->why);
}

enum { PANEL = 360, BETWEEN = 24, ROW_COUNT = 5, ROW_HEIGHT = 22, BAR = 70 };

static double largest_column(const double *columns, uint32_t count)
{
    double most = 0;
    for (uint32_t i = 0; i < count; i++)
        most = fmax(most, columns[i]);
    return most;
}

/* Texels and the bars below them: pixels of each column, on one scale for both panels. */
static void draw_columns(const job *j, FILE *out, double left, const double *columns, double most)
{
    double width = (double)PANEL / j->columns, bottom = ROW_COUNT * ROW_HEIGHT + 8 + BAR;
    fprintf(out, "<path fill=\"none\" stroke=\"#999\" d=\"");
    for (uint32_t i = 0; i <= j->columns; i++)
        fprintf(out, "M%.1f 2v%d", left + i * width, ROW_COUNT * ROW_HEIGHT);
    for (int i = 0; i <= ROW_COUNT; i++)
        fprintf(out, "M%.1f %dh%d", left, 2 + i * ROW_HEIGHT, PANEL);
    fprintf(out, "\"/>\n<path fill=\"#777\" d=\"");
    for (uint32_t i = 0; i < j->columns; i++)
        fprintf(out, "M%.1f %.1fh%.1fv-%.1fh-%.1fz", left + i * width + 1, bottom, width - 2, BAR * columns[i] / most,
                width - 2);
    fprintf(out, "\"/>\n");
}

/* Before and after the rows are warped. */
static int write_rows(job *j, const gn_grid *grid)
{
    file_output output;
    uint32_t first = (j->rows - ROW_COUNT) / 2;
    double *columns[2] = {memory_take(j->columns, sizeof(double)), memory_take(j->columns, sizeof(double))};
    if (begin_drawing(j, "rows", 2 * PANEL + BETWEEN + 4, ROW_COUNT * ROW_HEIGHT + BAR + 12, &output))
        return -1;
    for (size_t i = 0; i < seen.count; i++)
        for (int warped = 0; warped < 2; warped++)
            columns[warped][texel_of(j, &seen.places[i], warped ? ROWS : BEFORE) % j->columns]++;
    double most = fmax(largest_column(columns[0], j->columns), largest_column(columns[1], j->columns));
    for (int warped = 0; warped < 2; warped++)
        draw_columns(j, output.stream, 2 + warped * (PANEL + BETWEEN), columns[warped], most);
    fprintf(output.stream, "<path stroke=\"#1850f0\" stroke-width=\"2.4\" stroke-linecap=\"round\" d=\"");
    for (size_t i = 0; i < seen.count; i++) {
        const place *p = &seen.places[i];
        if ((uint32_t)i * 2654435761u >> 25) /* one of 128, from all over the picture (Knuth's multiplier) */
            continue;
        double row = ldexp(p->y, -30) * j->rows - first, x = ldexp(p->x, -30) * j->columns;
        double to = find_place(band_of(j, grid, p->y), j->columns, p->x) + .5;
        if (row < 0 || row >= ROW_COUNT)
            continue;
        fprintf(output.stream, "M%.1f %.1fh0M%.1f %.1fh0", 2 + x * PANEL / j->columns, 2 + row * ROW_HEIGHT,
                2 + PANEL + BETWEEN + to * PANEL / j->columns, 2 + row * ROW_HEIGHT);
    }
    fprintf(output.stream, "\"/>\n");
    free(columns[0]);
    free(columns[1]);
    return end_drawing(j, &output);
}

static void draw_curve(FILE *out, double left, const uint16_t *places, uint32_t count)
{
    enum { STEPS = 180, SQUARE = 180 };
    fprintf(
        out,
        "<path fill=\"none\" stroke=\"#999\" d=\"M%.1f 2h%dv%dh-%dzl%d %d\"/><path fill=\"none\" stroke=\"#e06000\" "
        "stroke-width=\"2\" d=\"",
        left, SQUARE, SQUARE, SQUARE, SQUARE, SQUARE);
    for (int i = 0; i <= STEPS; i++) {
        uint32_t share = (uint32_t)((uint64_t)i * (ONE - 1) / STEPS);
        double to = (find_place(places, count, share) + .5) / count;
        fprintf(out, "%c%.1f %.1f", i ? 'L' : 'M', left + (double)i * SQUARE / STEPS, 2 + to * SQUARE);
    }
    fprintf(out, "\"/>\n");
}

static int write_curves(job *j, const gn_grid *grid)
{
    file_output output;
    if (begin_drawing(j, "curves", 388, 184, &output))
        return -1;
    draw_curve(output.stream, 2, grid->columns, j->columns);
    draw_curve(output.stream, 206, grid->rows, j->rows);
    return end_drawing(j, &output);
}

static int write_stage(job *j, const char *name, stage at)
{
    uint32_t *counts = count_samples(j, at);
    report(j, name, counts);
    int result = write_counts(j, name, counts);
    if (!result && at == AFTER)
        result = write_unused(j, counts);
    free(counts);
    return result;
}

static int write_pictures(job *j)
{
    const gn_grid *grid = j->frame.context->grid;
    image map = depth_picture(j->frame.map, j->columns, j->rows, 1);
    image flat = depth_picture(j->flat.map, j->columns, j->rows, 1);
    if (write_picture(j, "map", &map) || write_picture(j, "flat", &flat) || write_plane(j) ||
        write_stage(j, "before", BEFORE))
        return -1;
    if (grid && grid->across && (write_stage(j, "rows", ROWS) || write_functions(j, grid) || write_rows(j, grid)))
        return -1;
    if (grid && grid->columns && grid->rows && write_curves(j, grid))
        return -1;
    return write_stage(j, "after", AFTER);
}

/* ---- the program ----------------------------------------------------------------------------------------------- */

static int run(job *j, const char *scene, const char *const values[])
{
    if (packed_read(&j->packed, scene, 0, &j->why) || render_options_read(&j->settings, &j->packed, values, &j->why))
        return -1;
    j->columns = j->settings.map_width;
    j->rows = j->settings.map_height;
    if (draw_frames(j))
        return -1;
    if (!seen.count)
        return problem_in(&j->why, scene, "no pixel sees a surface within the light's reach; expected one");
    return write_pictures(j);
}

int main(int argc, char **argv)
{
    const char *values[OPTION_COUNT];
    command_line line;
    job j = {.folder = 0};
    int result = options_parse(options, OPTION_COUNT, argc - 1, argv + 1, values, &line, &j.why);
    if (!result && (line.place_count != 1 || !values[OUTPUT]))
        result = problem_of_usage(&j.why, "%d scenes; expected SCENE -o FOLDER [options of gnomon render]",
                                  line.place_count);
    if (!result) {
        j.folder = values[OUTPUT];
        result = run(&j, line.places[0], values);
    }
    if (result)
        fprintf(stderr, "%s\n", j.why.text);
    frame_close(&j.flat);
    frame_close(&j.frame);
    packed_free(&j.packed);
    free(seen.places);
    return result ? 2 : 0;
}
