/* A slice through a scene along the light, with what the map holds and what becomes of the pixels: the papers' drawings
 * of depths, made from a frame of gnomon. Figures of docs/papers.md.
 *
 *     slices SCENE TRUTH -o FOLDER [--column N | --row N] [--window ALONG,WIDTH,DEEP,HEIGHT] [--scale N]
 *            [--show WORD,WORD...] [--pixel X,Y] [--thickness T] [options of gnomon render]
 *
 * For directional lights. The slice is the plane through the centres of a column (the default: the middle one) or a row
 * of texels; lengths are texels, depths too. Written into FOLDER:
 *
 *     slice.svg   light comes from above. Grey: closed meshes cut open; black lines: surfaces; pale blue: borders of
 *                 texels. What --show asks for, by default map,pixels: first, second: the layers, blue and green; map:
 *                 the depth that pixels are compared with, orange, a step a texel; pixels: those within T texels (0.2)
 *                 of the slice: o lit, a black dot shadowed, a red square false shadow, a blue one false light; dark:
 *                 a bold black line where pixels are shadowed, right or wrong.
 *                 --pixel: the plane of the triangle that a pixel sees, and its virtual samples, as rings at the
 *                 centres of the two texels about it
 *     map.png     the depths that pixels are compared with
 *     own.png     the depth of each pixel as the light sees it, on the same scale
 *     stored.png  of the texel that holds each pixel
 *     points.csv  every pixel on the map: x, y, u, v in texels, own depth and stored one in units of the map, whether
 *                 it faces the light, lit in truth, lit by the frame
 *
 * On standard output where the slice's surfaces lie, and how many units of the map a texel is. Exit status: 0 done, 2
 * bad usage or input. */
#include "depth_picture.h"
#include "file.h"
#include "frame.h"
#include "gn_cascade.h"
#include "memory.h"
#include "render_options.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { OUTPUT = RENDER_OPTION_COUNT, COLUMN, ROW, WINDOW, SCALE, SHOW, PIXEL, THICKNESS, OPTION_COUNT };

static const option table[OPTION_COUNT] = {
    RENDER_OPTIONS,
    {"-o", "FOLDER", "where the files go"},
    {"--column", "N", "of the map, to cut along"},
    {"--row", "N", "of the map"},
    {"--window", "A,W,D,H", "what slice.svg shows, in texels"},
    {"--scale", "N", "pixels a texel"},
    {"--show", "WORDS", "first, second, map, pixels, dark"},
    {"--pixel", "X,Y", "whose virtual samples are shown"},
    {"--thickness", "T", "of the slice, for pixels"},
};

/* ---- pixels on the map ----------------------------------------------------------------------------------------- */

/* In texels, from the centre of the first one; depths from the light's near end. */
typedef struct point {
    double u, v, z;
    uint32_t stored_bits, own_bits; /* as the map holds depths */
    uint32_t triangle;
    uint8_t on_map, faces_light;
} point;

/* What the wrapped receiver writes: its callbacks carry no pointer of ours, and there is one worker. */
static struct {
    point *points;
    int32_t width;
    double texel; /* a texel as a depth, of 2^32 */
    gn_receiver_plane plane;
    int32_t plane_x, plane_y;
} seen;

static void keep_points(const gn_context *context, gn_worker *worker, gn_points *points)
{
    uint32_t bits = gn_point_bits(context);
    for (int32_t i = 0; i < points->count; i++) {
        if (points->triangle[i] == GN_NO_TRIANGLE || points->u[i] == GN_NOWHERE)
            continue;
        point *p = &seen.points[(size_t)points->y * (size_t)seen.width + (size_t)(points->x + i)];
        const gn_receiver_plane *plane = gn_find_plane(context, worker, points->triangle[i], 0);
        p->on_map = 1;
        p->faces_light = plane->faces_light;
        p->triangle = points->triangle[i];
        p->u = ldexp((int32_t)points->u[i], -(int)bits);
        p->v = ldexp((int32_t)points->v[i], -(int)bits);
        p->z = points->z[i] / seen.texel;
        p->own_bits = gn_cut(points->z[i]);
        if (points->x + i == seen.plane_x && points->y == seen.plane_y)
            seen.plane = *plane;
    }
}

/* ---- the slice ------------------------------------------------------------------------------------------------- */

/* A piece of a surface: along the map's column or row, and depth; in texels. */
typedef struct piece {
    double a[2], z[2];
    uint8_t used;
} piece;

typedef struct job {
    const char *folder;
    packed_scene packed;
    gn_settings settings;
    frame plain, frame; /* with the receiver that keeps points, and as asked for */
    image truth;
    int by_row;
    long line;        /* the column or row */
    double window[4]; /* along from, width, deep from, height */
    double scale, thickness;
    int first, second, map, pixels, dark; /* shown */
    piece *pieces;
    size_t piece_count, piece_room, first_of_mesh;
    problem why;
} job;

/* Along, across and depth of a vertex, in texels. */
static void place_of(const job *j, const gn_vertex *v, double out[3])
{
    double x = (v->x - 128) / 256.0, y = (v->y - 128) / 256.0;
    out[0] = j->by_row ? x : y;
    out[1] = j->by_row ? y : x;
    out[2] = 2.0 * v->depth / seen.texel;
}

/* Vertices lie at 1/256 texel, so the slice, 1/1024 beside the centres, meets none. */
static double across_of(const job *j)
{
    return (double)j->line + 1.0 / 1024;
}

/* Where an edge meets the slice; the same number for both triangles on it. */
static void meet(const double p[3], const double q[3], double across, double *along, double *z)
{
    int swap = p[0] > q[0] || (p[0] == q[0] && p[1] > q[1]);
    const double *a = swap ? q : p, *b = swap ? p : q;
    double share = (across - a[1]) / (b[1] - a[1]);
    *along = a[0] + share * (b[0] - a[0]);
    *z = a[2] + share * (b[2] - a[2]);
}

static void cut_triangle(job *j, double corner[3][3])
{
    piece p = {{0, 0}, {0, 0}, 0};
    int ends = 0;
    double across = across_of(j);
    for (int i = 0; i < 3; i++) {
        const double *a = corner[i], *b = corner[(i + 1) % 3];
        if ((a[1] < across) != (b[1] < across) && ends < 2) {
            meet(a, b, across, &p.a[ends], &p.z[ends]);
            ends++;
        }
    }
    if (ends != 2)
        return;
    j->pieces = memory_grow(j->pieces, &j->piece_room, j->piece_count + 1, sizeof *j->pieces);
    j->pieces[j->piece_count++] = p;
}

static void cut_object(job *j, const gn_object *object)
{
    const gn_view *view = &j->plain.context->light_view;
    for (uint32_t t = 0; t < object->mesh->triangle_count; t++) {
        int32_t world[3][3];
        double corner[3][3];
        int inside = gn_triangle_world(object, t, world) == GN_OK;
        for (int i = 0; i < 3 && inside; i++) {
            gn_place place;
            gn_vertex v;
            inside = gn_view_place(view, world[i], &place) == GN_OK;
            if (inside)
                gn_view_project(view, &place, &v);
            inside = inside && v.depth != 0;
            if (inside)
                place_of(j, &v, corner[i]);
        }
        if (inside)
            cut_triangle(j, corner);
    }
}

/* ---- SVG ------------------------------------------------------------------------------------------------------- */

static double x_of(const job *j, double along)
{
    return (along - j->window[0]) * j->scale;
}

static double y_of(const job *j, double z)
{
    return (z - j->window[2]) * j->scale;
}

static int is_shown(const job *j, double along, double z)
{
    return along >= j->window[0] && along <= j->window[0] + j->window[1] && z >= j->window[2] &&
           z <= j->window[2] + j->window[3];
}

/* The piece that goes on where another ends, or 0; its near end is made its first. */
static piece *next_piece(job *j, double along, double z)
{
    for (size_t i = j->first_of_mesh; i < j->piece_count; i++) {
        piece *p = &j->pieces[i];
        for (int end = 0; end < 2 && !p->used; end++)
            if (p->a[end] == along && p->z[end] == z) {
                if (end) {
                    piece turned = {{p->a[1], p->a[0]}, {p->z[1], p->z[0]}, 0};
                    *p = turned;
                }
                return p;
            }
    }
    return 0;
}

/* Outlines of what the slice cuts of a mesh, as one path. */
static void draw_outlines(job *j, FILE *out, int closed)
{
    fprintf(out, "<path class=\"%s\" d=\"", closed ? "solid" : "sheet");
    for (size_t i = j->first_of_mesh; i < j->piece_count; i++) {
        piece *p = &j->pieces[i];
        if (p->used)
            continue;
        fprintf(out, "M%.1f %.1f", x_of(j, p->a[0]), y_of(j, p->z[0]));
        for (; p; p = next_piece(j, p->a[1], p->z[1])) {
            p->used = 1;
            fprintf(out, "L%.1f %.1f", x_of(j, p->a[1]), y_of(j, p->z[1]));
        }
    }
    fprintf(out, "\"/>\n");
}

static void draw_meshes(job *j, FILE *out)
{
    double least = 1e9, most = -1e9;
    for (uint32_t i = 0; i < j->packed.scene.object_count; i++) {
        const gn_object *object = &j->packed.scene.objects[i];
        j->first_of_mesh = j->piece_count;
        cut_object(j, object);
        draw_outlines(j, out, object->mesh->closed);
    }
    for (size_t i = 0; i < j->piece_count; i++)
        for (int end = 0; end < 2; end++) {
            least = fmin(least, j->pieces[i].z[end]);
            most = fmax(most, j->pieces[i].z[end]);
        }
    printf("%s %ld: %zu pieces, depths %.1f to %.1f texels; a texel is %.3f units of the map\n",
           j->by_row ? "row" : "column", j->line, j->piece_count, least, most, ldexp(seen.texel, GN_DEPTH_BITS - 32));
}

static size_t texel_at(const job *j, long along)
{
    size_t width = j->settings.map_width;
    return j->by_row ? (size_t)j->line * width + (size_t)along : (size_t)along * width + (size_t)j->line;
}

static long length_of(const job *j)
{
    return j->by_row ? j->settings.map_width : j->settings.map_height;
}

static double in_texels(gn_depth depth)
{
    return ldexp((double)depth + 0.5, 32 - GN_DEPTH_BITS) / seen.texel;
}

static void draw_borders(const job *j, FILE *out)
{
    fprintf(out, "<path class=\"border\" d=\"");
    for (long k = (long)floor(j->window[0]); k <= j->window[0] + j->window[1]; k++)
        fprintf(out, "M%.1f 0V%.0f", x_of(j, (double)k + .5), j->window[3] * j->scale);
    fprintf(out, "\"/>\n");
}

/* A step a texel, with a tick at its centre, where the light sampled it. */
static void draw_depths(const job *j, FILE *out, const gn_depth *depths, const char *class)
{
    fprintf(out, "<path class=\"%s\" d=\"", class);
    for (long k = 0; k < length_of(j); k++) {
        gn_depth depth = depths[texel_at(j, k)];
        double z = in_texels(depth);
        if (depth == GN_FARTHEST || !is_shown(j, (double)k, z))
            continue;
        fprintf(out, "M%.1f %.1fh%.1fM%.1f %.1fv-5", x_of(j, (double)k - .46), y_of(j, z), .92 * j->scale,
                x_of(j, (double)k), y_of(j, z) + 2.5);
    }
    fprintf(out, "\"/>\n");
}

static int is_lit(const image *mask, size_t at)
{
    return ((const uint8_t *)mask->samples)[at] >= 127;
}

/* Pixels in the slice, at most one of a kind in each square of 5 x 5. */
static void draw_pixels(const job *j, FILE *out)
{
    static const char *const kinds[4] = {
        "<circle class=\"lit\" cx=\"%.1f\" cy=\"%.1f\" r=\"2\"/>\n",
        "<rect class=\"falsely-lit\" x=\"%.1f\" y=\"%.1f\" width=\"4.4\" height=\"4.4\"/>\n",
        "<rect class=\"falsely-dark\" x=\"%.1f\" y=\"%.1f\" width=\"4.4\" height=\"4.4\"/>\n",
        "<circle class=\"shadowed\" cx=\"%.1f\" cy=\"%.1f\" r=\"2\"/>\n"};
    enum { SQUARE = 5 };
    size_t columns = (size_t)(j->window[1] * j->scale) / SQUARE + 2,
           rows = (size_t)(j->window[3] * j->scale) / SQUARE + 2;
    uint8_t *taken = memory_take(columns * rows, 1);
    image mask = {j->settings.width, j->settings.height, 1, IMAGE_U8, j->frame.mask};
    for (size_t at = 0; at < (size_t)mask.width * mask.height; at++) {
        const point *p = &seen.points[at];
        double along = j->by_row ? p->u : p->v, across = j->by_row ? p->v : p->u;
        if (!p->on_map || fabs(across - (double)j->line) > j->thickness || !is_shown(j, along, p->z))
            continue;
        int kind = 2 * !is_lit(&mask, at) + !is_lit(&j->truth, at);
        double x = x_of(j, along), y = y_of(j, p->z);
        uint8_t *square = taken + (size_t)(y / SQUARE) * columns + (size_t)(x / SQUARE);
        if (*square >> kind & 1)
            continue;
        *square |= (uint8_t)(1 << kind);
        if (j->dark && kind >= 2)
            fprintf(out, "<circle class=\"dark\" cx=\"%.1f\" cy=\"%.1f\" r=\"2.6\"/>\n", x, y);
        else if (j->pixels)
            fprintf(out, kinds[kind], kind == 1 || kind == 2 ? x - 2.2 : x, kind == 1 || kind == 2 ? y - 2.2 : y);
    }
    free(taken);
}

/* The plane on the slice, and its depths at the centres of the texels about the pixel. */
static void draw_plane(const job *j, FILE *out)
{
    if (seen.plane_x < 0 || !seen.plane.exists)
        return;
    const point *p = &seen.points[(size_t)seen.plane_y * (size_t)seen.width + (size_t)seen.plane_x];
    const gn_wide_plane *plane = &seen.plane.plane;
    double along = j->by_row ? p->u : p->v;
    long first = (long)floor(along);
    double depth[2];
    for (int i = 0; i < 2; i++) {
        long column = j->by_row ? first + i : j->line, row = j->by_row ? j->line : first + i;
        depth[i] = (double)gn_wide_depth(plane, (int32_t)column, (int32_t)row) / seen.texel;
    }
    fprintf(out, "<path class=\"plane\" d=\"M%.1f %.1fL%.1f %.1f\"/>\n", x_of(j, (double)first - .5),
            y_of(j, 1.5 * depth[0] - .5 * depth[1]), x_of(j, (double)first + 1.5),
            y_of(j, 1.5 * depth[1] - .5 * depth[0]));
    for (int i = 0; i < 2; i++)
        fprintf(out, "<circle class=\"sample\" cx=\"%.1f\" cy=\"%.1f\" r=\"5\"/>\n", x_of(j, (double)(first + i)),
                y_of(j, depth[i]));
    fprintf(out, "<circle class=\"camera\" cx=\"%.1f\" cy=\"%.1f\" r=\"4\"/>\n", x_of(j, along), y_of(j, p->z));
    printf("pixel %d, %d: at %.3f, depth %.3f texels; virtual samples %.3f, %.3f\n", (int)seen.plane_x,
           (int)seen.plane_y, along, p->z, depth[0], depth[1]);
}

static const char style[] = "<style>\n"
                            ".solid{fill:#e4e4e4;fill-rule:evenodd;stroke:#000;stroke-width:1}\n"
                            ".sheet{fill:none;stroke:#000;stroke-width:1}\n"
                            ".border{fill:none;stroke:#bcd6ff;stroke-width:1}\n"
                            ".first{fill:none;stroke:#2060d0;stroke-width:1.6}\n"
                            ".second{fill:none;stroke:#10903a;stroke-width:1.6}\n"
                            ".map{fill:none;stroke:#f08000;stroke-width:2.4}\n"
                            ".lit{fill:#fff;stroke:#000;stroke-width:.8}\n"
                            ".shadowed,.dark,.camera{fill:#000}\n"
                            ".falsely-dark{fill:#e00000}\n"
                            ".falsely-lit{fill:#1850f0}\n"
                            ".plane{fill:none;stroke:#a000a0;stroke-width:1.4;stroke-dasharray:5 3}\n"
                            ".sample{fill:none;stroke:#a000a0;stroke-width:2}\n"
                            "</style>\n";

static void draw_slice(job *j, FILE *out)
{
    double width = j->window[1] * j->scale, height = j->window[3] * j->scale;
    fprintf(out,
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 %.0f %.0f\" width=\"%.0f\" height=\"%.0f\">\n%s",
            width, height, width, height, style);
    fprintf(out, "<rect width=\"%.0f\" height=\"%.0f\" fill=\"#fff\"/>\n", width, height);
    draw_borders(j, out);
    draw_meshes(j, out);
    if (j->first)
        draw_depths(j, out, j->frame.layers[0], "first");
    if (j->second)
        draw_depths(j, out, j->frame.layers[1], "second");
    if (j->map)
        draw_depths(j, out, j->frame.map, "map");
    draw_pixels(j, out);
    draw_plane(j, out);
    fprintf(out, "</svg>\n");
}

/* ---- files ----------------------------------------------------------------------------------------------------- */

static int open_output(job *j, file_output *output, const char *name)
{
    char path[1024];
    snprintf(path, sizeof path, "%s/%s", j->folder, name);
    return file_output_open(output, path, &j->why);
}

static int write_slice(job *j)
{
    file_output output;
    if (open_output(j, &output, "slice.svg"))
        return -1;
    draw_slice(j, output.stream);
    return file_output_finish(&output, &j->why);
}

static int write_points(job *j)
{
    file_output output;
    image mask = {j->settings.width, j->settings.height, 1, IMAGE_U8, j->frame.mask};
    if (open_output(j, &output, "points.csv"))
        return -1;
    fprintf(output.stream, "x,y,u,v,own,stored,faces,truth,answer\n");
    for (size_t at = 0; at < (size_t)mask.width * mask.height; at++) {
        const point *p = &seen.points[at];
        if (p->on_map)
            fprintf(output.stream, "%zu,%zu,%.3f,%.3f,%u,%u,%d,%d,%d\n", at % mask.width, at / mask.width, p->u, p->v,
                    p->own_bits, p->stored_bits, p->faces_light, is_lit(&j->truth, at), is_lit(&mask, at));
    }
    return file_output_finish(&output, &j->why);
}

static int write_image(job *j, const char *name, image *im)
{
    char path[1024];
    snprintf(path, sizeof path, "%s/%s", j->folder, name);
    int result = image_write(im, path, &j->why);
    image_free(im);
    return result;
}

/* Depths of pixels, the own or the stored, as depth_picture shows those of the map, whose range they are given by two
 * pixels more below the picture. */
static int write_depths(job *j, const char *name, int stored)
{
    uint32_t width = j->settings.width, height = j->settings.height;
    size_t count = (size_t)width * height, texels = (size_t)j->settings.map_width * j->settings.map_height;
    gn_depth *depths = memory_take(count + width, sizeof *depths), least = GN_FARTHEST, most = 0;
    for (size_t i = 0; i < texels; i++) {
        least = j->frame.map[i] < least ? j->frame.map[i] : least;
        most = j->frame.map[i] != GN_FARTHEST && j->frame.map[i] > most ? j->frame.map[i] : most;
    }
    for (size_t i = 0; i < count + width; i++)
        depths[i] = GN_FARTHEST;
    for (size_t i = 0; i < count; i++) {
        const point *p = &seen.points[i];
        uint32_t depth = stored ? p->stored_bits : p->own_bits;
        if (p->on_map && depth != GN_FARTHEST)
            depths[i] = (gn_depth)(depth < least ? least : depth > most ? most : depth);
    }
    depths[count] = least;
    depths[count + (width > 1)] = most;
    image im = depth_picture(depths, width, height + 1, 1);
    im.height--;
    free(depths);
    return write_image(j, name, &im);
}

/* ---- the program ----------------------------------------------------------------------------------------------- */

static void find_stored(job *j)
{
    long columns = j->settings.map_width, rows = j->settings.map_height;
    for (size_t at = 0; at < (size_t)j->settings.width * j->settings.height; at++) {
        point *p = &seen.points[at];
        long column = (long)floor(p->u + .5), row = (long)floor(p->v + .5);
        column = column < 0 ? 0 : column >= columns ? columns - 1 : column;
        row = row < 0 ? 0 : row >= rows ? rows - 1 : row;
        if (p->on_map)
            p->stored_bits = j->frame.map[row * columns + column];
    }
}

static int draw_frame(job *j, frame *f, const gn_settings *settings, int keep_layers)
{
    if (frame_open(f, &j->packed.scene, settings, keep_layers, &j->why) ||
        frame_light_pass(f, &j->packed.light, &j->why))
        return -1;
    if (!seen.texel) {
        gn_bias one = {GN_BIAS_TEXELS, 1 << 16};
        seen.texel = gn_make_bias(f->context, &one);
    }
    return frame_camera_pass(f, &j->packed.camera, &j->why);
}

static int draw_frames(job *j)
{
    gn_settings plain = j->settings;
    gn_receiver wrapped = gn_virtual;
    wrapped.prepare = keep_points;
    wrapped.sunlit = wrapped.spotlit = 0; /* short cuts, past prepare */
    plain.receiver = &wrapped;
    plain.reconstruction = 0;
    seen.width = plain.width;
    seen.points = memory_take((size_t)plain.width * plain.height, sizeof *seen.points);
    if (draw_frame(j, &j->plain, &plain, 0) || draw_frame(j, &j->frame, &j->settings, 1))
        return -1;
    find_stored(j);
    return 0;
}

static int read_numbers(job *j, const char *name, const char *value, int count, double *out)
{
    char rest[2] = "";
    int found = count == 4 ? sscanf(value, "%lf,%lf,%lf,%lf%1s", &out[0], &out[1], &out[2], &out[3], rest)
                           : sscanf(value, "%lf,%lf%1s", &out[0], &out[1], rest);
    if (found == count)
        return 0;
    return problem_of_usage(&j->why, "%s %s; expected %d numbers with commas between", name, value, count);
}

static int has_word(const char *words, const char *word)
{
    size_t length = strlen(word);
    for (const char *at = words; at; at = strchr(at, ',') ? strchr(at, ',') + 1 : 0)
        if (!strncmp(at, word, length) && (at[length] == 0 || at[length] == ','))
            return 1;
    return 0;
}

static int read_options(job *j, const char *const values[])
{
    const char *words = values[SHOW] ? values[SHOW] : "map,pixels";
    long line = -1;
    double place[2] = {-1, -1};
    j->by_row = values[ROW] != 0;
    j->scale = 24;
    j->thickness = .2;
    seen.plane_x = seen.plane_y = -1;
    j->first = has_word(words, "first");
    j->second = has_word(words, "second");
    j->map = has_word(words, "map");
    j->pixels = has_word(words, "pixels");
    j->dark = has_word(words, "dark");
    const char *name = j->by_row ? "--row" : "--column", *value = values[j->by_row ? ROW : COLUMN];
    long most = (j->by_row ? j->settings.map_height : j->settings.map_width) - 1;
    if ((value && option_number(name, value, 0, most, &line, &j->why)) ||
        (values[SCALE] && option_decimal("--scale", values[SCALE], .25, 1000, &j->scale, &j->why)) ||
        (values[THICKNESS] && option_decimal("--thickness", values[THICKNESS], 0, 100, &j->thickness, &j->why)) ||
        (values[PIXEL] && read_numbers(j, "--pixel", values[PIXEL], 2, place)))
        return -1;
    seen.plane_x = (int32_t)place[0];
    seen.plane_y = (int32_t)place[1];
    j->line = line < 0 ? most / 2 : line;
    j->window[0] = -.5;
    j->window[1] = (double)length_of(j);
    j->window[2] = 0;
    j->window[3] = (double)j->packed.light.box_depth / j->packed.light.box_height * j->settings.map_height;
    if (values[WINDOW] && read_numbers(j, "--window", values[WINDOW], 4, j->window))
        return -1;
    return 0;
}

static int run(job *j, const char *scene, const char *truth, const char *const values[])
{
    if (packed_read(&j->packed, scene, 0, &j->why) || render_options_read(&j->settings, &j->packed, values, &j->why) ||
        image_read_mask(&j->truth, truth, &j->why) || read_options(j, values))
        return -1;
    if (j->packed.light.kind != GN_DIRECTIONAL || j->settings.fit || j->settings.warp)
        return problem_in(&j->why, scene,
                          "a slice needs a directional light and a map that is neither fitted nor warped");
    if (j->truth.width != j->settings.width || j->truth.height != j->settings.height)
        return problem_in(&j->why, truth, "is %u x %u; expected the image's %u x %u", j->truth.width, j->truth.height,
                          j->settings.width, j->settings.height);
    j->settings.mask = 1;
    j->settings.format = GN_NO_COLOUR;
    if (draw_frames(j))
        return -1;
    if (j->second && j->frame.layer_count < 2)
        return problem_of_usage(&j->why, "--show second: there is one layer; expected --layers two");
    image map = depth_picture(j->frame.map, j->settings.map_width, j->settings.map_height, 1);
    return write_slice(j) || write_points(j) || write_image(j, "map.png", &map) || write_depths(j, "own.png", 0) ||
                   write_depths(j, "stored.png", 1)
               ? -1
               : 0;
}

int main(int argc, char **argv)
{
    const char *values[OPTION_COUNT];
    command_line line;
    job j = {.folder = 0};
    int result = options_parse(table, OPTION_COUNT, argc - 1, argv + 1, values, &line, &j.why);
    if (!result && (line.place_count != 2 || !values[OUTPUT]))
        result = problem_of_usage(&j.why, "%d files; expected SCENE TRUTH -o FOLDER", line.place_count);
    if (!result) {
        j.folder = values[OUTPUT];
        result = run(&j, line.places[0], line.places[1], values);
    }
    if (result)
        fprintf(stderr, "%s\n", j.why.text);
    frame_close(&j.plain);
    frame_close(&j.frame);
    packed_free(&j.packed);
    image_free(&j.truth);
    free(seen.points);
    free(j.pieces);
    return result ? 2 : 0;
}
