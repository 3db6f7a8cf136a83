/* gnomon render: a scene in, a shadowed image, masks, depth layers, hashes and statistics out. */
#include "automatic.h"
#include "choices.h"
#include "commands.h"
#include "file.h"
#include "frame.h"
#include "grid_picture.h"
#include "image.h"
#include "json.h"
#include "render_options.h"
#include "settings_report.h"
#include "silhouette_picture.h"
#include "warp_report.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

const char render_summary[] = "render a scene with shadows, from a .scene or .gno file";

enum {
    OUTPUT_HEAD = RENDER_OPTION_COUNT,
    OUTPUT_IMAGE,
    OUTPUT_MASK,
    OUTPUT_DEPTH,
    OUTPUT_SECOND_DEPTH,
    OUTPUT_MAP,
    OUTPUT_SILHOUETTES,
    OUTPUT_GRID,
    OUTPUT_STATS,
    OUTPUT_HASH,
    WORK,
    VERBOSE = WORK + WORK_OPTION_COUNT,
    HELP,
    OPTION_COUNT
};

static const option table[OPTION_COUNT] = {
    RENDER_OPTIONS,
    {0, 0, "What is written (.ppm, .pgm, .pfm; with OpenImageIO also .png, .exr and others):"},
    {"-o", "FILE", "the image, 8 bits a channel"},
    {"--mask", "FILE", "8-bit grey: 0 shadowed to 254 lit, 255 no surface"},
    {"--depth", "FILE",
     "nearest depths as seen by the light, 16-bit grey; .pfm, .exr: 0 near to 1 far.\n"
     "Of a point light the six maps one below the other: +x, -x, +y, -y, +z, -z"},
    {"--second-depth", "FILE", "second nearest depths, where the method keeps two layers"},
    {"--map-image", "FILE", "the depths that pixels are compared with, made of the layers"},
    {"--silhouettes", "FILE",
     "the silhouette map over the depths that pixels are compared with (near:\n"
     "bright), 1 to 16 pixels a texel: red points, joined by orange lines from 8\n"
     "pixels on. Of --reconstruct silhouette and silhouette-smooth"},
    {"--grid", "FILE",
     "where the texels lie: lines through their centres, orange along columns and\n"
     "blue along rows, over the depths of the light's whole plane; a red frame is\n"
     "what the map covers. With a fit or a warp"},
    {"--stats", "FILE.json", "sizes, memory, counts and times"},
    {"--hash", 0,
     "print a hash for each stage: warp and silhouettes where there are,\n"
     "layers, map, mask, colour"},
    WORK_OPTIONS,
    {"--verbose", 0, "say on standard error what was read, planned and tested"},
    {"--help", 0, "this text"},
};

typedef struct job {
    const char *scene_path;
    const char *values[OPTION_COUNT];
    packed_scene packed;
    gn_settings settings;
    frame frame;
    problem why;
} job;

static void help(void)
{
    puts("usage: gnomon render SCENE [options]\n\n"
         "Render SCENE (a .scene text file with its OBJ meshes, or a .gno file from `gnomon pack`) and write what is\n"
         "asked for; at least one output is needed. Example:\n\n"
         "  gnomon render lshape.scene -o lshape.ppm --method dual --map 512\n");
    options_help(table, OPTION_COUNT, stdout);
    puts("\nExit status: 0 done, 2 bad usage or input, or an output cannot be written (no file is left half-written; "
         "those\n"
         "written before it stay).");
}

static int wants_layers(const job *j)
{
    return j->values[OUTPUT_DEPTH] || j->values[OUTPUT_SECOND_DEPTH] || j->values[OUTPUT_MAP] ||
           j->values[OUTPUT_SILHOUETTES] || j->values[OUTPUT_HASH];
}

/* Depths go to files of floats as they are, to others as 16 bits. */
static image_sample depth_sample(const char *path)
{
    return file_has_extension(path, ".pfm") || file_has_extension(path, ".exr") ? IMAGE_F32 : IMAGE_U16;
}

/* Everything that can be refused before the work starts. */
static int check_outputs(job *j)
{
    static const int depths[] = {OUTPUT_DEPTH, OUTPUT_SECOND_DEPTH, OUTPUT_MAP};
    const char **values = j->values;
    int any =
        values[OUTPUT_IMAGE] || values[OUTPUT_MASK] || values[OUTPUT_GRID] || values[OUTPUT_STATS] || wants_layers(j);
    if (!any)
        return problem_of_usage(&j->why, "nothing to write; expected -o FILE or another output (gnomon render --help)");
    if (values[OUTPUT_IMAGE] && image_can_write(values[OUTPUT_IMAGE], 3, IMAGE_U8, &j->why))
        return -1;
    if (values[OUTPUT_MASK] && image_can_write(values[OUTPUT_MASK], 1, IMAGE_U8, &j->why))
        return -1;
    for (int i = 0; i < 3; i++) {
        const char *path = values[depths[i]];
        if (path && image_can_write(path, 1, depth_sample(path), &j->why))
            return -1;
    }
    if (values[OUTPUT_SILHOUETTES] && image_can_write(values[OUTPUT_SILHOUETTES], 3, IMAGE_U8, &j->why))
        return -1;
    if (values[OUTPUT_GRID] && image_can_write(values[OUTPUT_GRID], 3, IMAGE_U8, &j->why))
        return -1;
    if (values[OUTPUT_STATS] && file_can_write(values[OUTPUT_STATS], &j->why))
        return -1;
    return file_check_distinct(values + OUTPUT_IMAGE, OUTPUT_STATS - OUTPUT_IMAGE + 1, &j->scene_path, 1, &j->why);
}

static void say_what_was_read(const job *j)
{
    const packed_scene *p = &j->packed;
    const gn_plan *plan = &j->frame.plan;
    fprintf(stderr, "%s: %" PRIu64 " triangles, %" PRIu64 " vertices; a world unit is 2^%d", j->scene_path,
            packed_triangle_count(p), packed_vertex_count(p), p->scale);
    if (p->largest_rounding >= 0)
        fprintf(stderr, ", largest rounding of a vertex %.3g world units", p->largest_rounding);
    if (j->settings.shadow == GN_SHADOW_VOLUMES) {
        fprintf(stderr, "\nshadow volumes, %" PRIu32 " edges; %zu bytes\n", plan->edges, plan->bytes);
        return;
    }
    fputs("\n", stderr);
    settings_report_text(stderr, &j->settings, plan, p->scale);
    fprintf(stderr, "; %zu bytes, of them %zu for the map", plan->bytes, plan->map_bytes);
    if (plan->silhouette_bytes)
        fprintf(stderr, ", %zu for its silhouettes", plan->silhouette_bytes);
    if (plan->warp_bytes)
        fprintf(stderr, ", %zu for where its texels lie", plan->warp_bytes);
    fputs("\n", stderr);
}

/* Does the test of a pixel run in the stages that the counts tell apart? */
static int has_stages(const gn_settings *s)
{
    return s->shadow == GN_SHADOW_MAP && (s->receiver || s->reconstruction);
}

/* P of Sen et al. 2003, section 4 and table 1. */
static double share_of_silhouettes(const gn_statistics *s)
{
    return s->pixels_shaded ? (double)s->pixels_silhouette / (double)s->pixels_shaded : 0;
}

/* O of the same. */
static double overdraw(const gn_statistics *s)
{
    return s->camera_fragments ? (double)s->volume_fragments / (double)s->camera_fragments : 0;
}

static void say_what_was_tested(const frame *f)
{
    gn_statistics s;
    gn_get_statistics(f->context, &s);
    fprintf(stderr, "%" PRIu64 " pixels tested", s.pixels_tested);
    if (has_stages(&f->settings))
        fprintf(stderr,
                ": %" PRIu64 " outside of the light, %" PRIu64 " decided by the point's depth, %" PRIu64
                " by virtual samples; %" PRIu64 " partly lit; %" PRIu64 " texels read, %" PRIu64 " virtual samples",
                s.pixels_outside, s.pixels_agreed, s.pixels_virtual, s.pixels_fractional, s.texels_read,
                s.virtual_samples);
    fputs("\n", stderr);
    if (f->settings.faces)
        fprintf(stderr, "%" PRIu64 " faces drawn, %" PRIu64 " skipped\n", s.faces_drawn, s.faces_skipped);
    if (choices_have_silhouettes(&f->settings))
        fprintf(stderr,
                "%" PRIu64 " silhouette edges, %" PRIu64 " texels with a point or crossing of one; %" PRIu64
                " pixels decided by them, %.3g %% of those shaded\n",
                s.silhouette_edges, s.silhouette_texels, s.pixels_silhouette, 100 * share_of_silhouettes(&s));
}

/* ---- outputs --------------------------------------------------------------------------------------------------- */

static int write_depths(job *j, const char *path, const gn_depth *depths)
{
    image im = image_make(j->settings.map_width, j->frame.map_rows, 1, depth_sample(path));
    size_t count = image_sample_count(&im);
    for (size_t i = 0; i < count; i++)
        if (im.sample == IMAGE_F32)
            ((float *)im.samples)[i] = (float)ldexp(depths[i], -GN_DEPTH_BITS);
        else
            ((uint16_t *)im.samples)[i] = (uint16_t)(depths[i] >> (GN_DEPTH_BITS - 16));
    int result = image_write(&im, path, &j->why);
    image_free(&im);
    return result;
}

static int write_silhouettes(job *j, const char *path)
{
    uint32_t stride;
    const uint8_t *map = gn_silhouette_map(j->frame.context, &stride);
    image im = silhouette_picture(j->frame.map, j->settings.map_width, j->frame.map_rows, map, stride);
    int result = image_write(&im, path, &j->why);
    image_free(&im);
    return result;
}

/* The light's whole plane as a uniform map, and nothing else of a frame. */
static int open_plane(job *j, frame *plane)
{
    uint16_t size[2];
    grid_picture_size(&j->packed.light, size);
    gn_settings settings = gn_default_settings(1, 1, size[0]);
    settings.map_height = size[1];
    settings.surface = GN_CONSTANT;
    settings.workers = j->settings.workers;
    return frame_open(plane, &j->packed.scene, &settings, 1, &j->why) ||
                   frame_light_pass(plane, &j->packed.light, &j->why)
               ? -1
               : 0;
}

static int write_grid(job *j, const char *path)
{
    frame plane;
    int result = open_plane(j, &plane);
    if (!result) {
        uint32_t(*places)[2] = frame_texel_places(&j->frame);
        image im = grid_picture(plane.map, plane.settings.map_width, plane.settings.map_height, &j->frame.rectangle,
                                places, j->settings.map_width, j->settings.map_height);
        result = image_write(&im, path, &j->why);
        image_free(&im);
        free(places);
    }
    frame_close(&plane);
    return result;
}

static int write_pixels(job *j, const char *path, uint8_t *pixels, uint32_t channels)
{
    image im = {j->settings.width, j->settings.height, channels, IMAGE_U8, pixels};
    return image_write(&im, path, &j->why);
}

/* Bytes that the test of a pixel reads, by the model of Sen et al. 2003, section 4, and over those of a shadow map.
 * Near a silhouette 3 points are read (of a crossing map 3 bytes as well; smooth borders read more); a point of theirs
 * has 8 bytes. A fragment of a shadow volume reads a depth and a stencil value, and writes half of the latter. */
static void write_bandwidth(json *j, const frame *f, const gn_statistics *s)
{
    enum { DEPTH = 4, POINTS = 3, POINT = 8 };
    int silhouettes = choices_have_silhouettes(&f->settings);
    if (!silhouettes && f->settings.shadow != GN_SHADOW_VOLUMES)
        return;
    double own_depth = sizeof(gn_depth), points = POINTS * share_of_silhouettes(s), volumes = 5.5 * overdraw(s);
    json_open(j, "bandwidth");
    json_integer(j, "shadow_map_bytes_a_pixel", DEPTH);
    if (silhouettes) {
        json_number(j, "silhouette_map_bytes_a_pixel", DEPTH + POINT * points);
        json_number(j, "ratio", (DEPTH + POINT * points) / DEPTH);
        json_integer(j, "own_shadow_map_bytes_a_pixel", sizeof(gn_depth));
        json_number(j, "own_silhouette_map_bytes_a_pixel", own_depth + points);
        json_number(j, "own_ratio", (own_depth + points) / own_depth);
    } else {
        json_number(j, "shadow_volumes_bytes_a_pixel", volumes);
        json_number(j, "ratio", volumes / DEPTH);
    }
    json_close(j);
}

static void write_statistics(json *j, const frame *f)
{
    gn_statistics s;
    gn_get_statistics(f->context, &s);
    json_open(j, "counts");
    json_integer(j, "light_triangles", (int64_t)s.light_triangles);
    json_integer(j, "light_texels", (int64_t)s.light_texels);
    if (choices_use_view(&f->settings))
        json_integer(j, "view_samples", (int64_t)s.view_samples);
    json_integer(j, "camera_triangles", (int64_t)s.camera_triangles);
    json_integer(j, "camera_fragments", (int64_t)s.camera_fragments);
    json_integer(j, "pixels_shaded", (int64_t)s.pixels_shaded);
    json_integer(j, "pixels_tested", (int64_t)s.pixels_tested);
    if (has_stages(&f->settings)) {
        json_integer(j, "pixels_outside", (int64_t)s.pixels_outside);
        json_integer(j, "pixels_agreed", (int64_t)s.pixels_agreed);
        json_integer(j, "pixels_virtual", (int64_t)s.pixels_virtual);
        json_integer(j, "pixels_fractional", (int64_t)s.pixels_fractional);
        json_integer(j, "texels_read", (int64_t)s.texels_read);
        json_integer(j, "virtual_samples", (int64_t)s.virtual_samples);
    }
    if (choices_have_silhouettes(&f->settings)) {
        json_integer(j, "silhouette_edges", (int64_t)s.silhouette_edges);
        json_integer(j, "silhouette_texels", (int64_t)s.silhouette_texels);
        json_integer(j, "pixels_silhouette", (int64_t)s.pixels_silhouette);
        json_number(j, "silhouette_percent", 100 * share_of_silhouettes(&s));
    }
    if (f->settings.shadow == GN_SHADOW_VOLUMES) {
        json_integer(j, "silhouette_edges", (int64_t)s.silhouette_edges);
        json_integer(j, "volume_faces", (int64_t)s.volume_faces);
        json_integer(j, "volume_fragments", (int64_t)s.volume_fragments);
        json_number(j, "overdraw", overdraw(&s));
    }
    if (f->settings.faces) {
        json_integer(j, "faces_drawn", (int64_t)s.faces_drawn);
        json_integer(j, "faces_skipped", (int64_t)s.faces_skipped);
    }
    json_close(j);
    write_bandwidth(j, f, &s);
}

static void write_range(json *j, const char *name, const double range[2])
{
    json_open(j, name);
    json_number(j, "least", range[0]);
    json_number(j, "largest", range[1]);
    json_close(j);
}

static void write_warp(json *j, const job *of)
{
    const gn_settings *s = &of->settings;
    if (!choices_use_view(s))
        return;
    uint32_t(*places)[2] = frame_texel_places(&of->frame);
    warp_report report = warp_report_make(&of->frame.rectangle, &of->packed.light, places, s->map_width, s->map_height);
    free(places);
    json_open(j, "light_plane");
    json_number(j, "covered_percent", 100 * report.share);
    json_number(j, "angle_degrees", report.angle);
    write_range(j, "column_magnification", report.columns);
    write_range(j, "row_magnification", report.rows);
    json_close(j);
}

static void write_plan(json *j, const gn_settings *s, const gn_plan *plan, int scale)
{
    json_open(j, "settings");
    json_integer(j, "width", s->width);
    json_integer(j, "height", s->height);
    json_integer(j, "depth_bits", GN_DEPTH_BITS);
    settings_report_json(j, s, plan, scale);
    json_integer(j, "workers", s->workers);
    json_integer(j, "region_width", plan->region_width);
    json_integer(j, "region_height", plan->region_height);
    json_integer(j, "map_rows", plan->map_rows);
    json_close(j);
    json_open(j, "bytes");
    json_integer(j, "all", (int64_t)plan->bytes);
    json_integer(j, "map", (int64_t)plan->map_bytes);
    if (plan->silhouette_bytes)
        json_integer(j, "silhouettes", (int64_t)plan->silhouette_bytes);
    if (plan->view_bytes) {
        json_integer(j, "warp", (int64_t)plan->warp_bytes);
        json_integer(j, "view_pass", (int64_t)plan->view_bytes);
    }
    json_integer(j, "light_pass", (int64_t)plan->light_bytes);
    json_integer(j, "camera_pass", (int64_t)plan->camera_bytes);
    json_close(j);
}

/* Of a point light with one map at a time none stays. */
static int has_silhouettes_to_show(const frame *f)
{
    return choices_have_silhouettes(&f->settings) && !choices_have_one_face(&f->settings);
}

static void write_hashes(json *j, const frame *f)
{
    json_open(j, "hashes");
    if (choices_use_view(&f->settings))
        json_hash(j, "warp", frame_hash_warp(f));
    if (!choices_have_one_face(&f->settings)) {
        json_hash(j, "layers", frame_hash_layers(f));
        json_hash(j, "map", frame_hash_map(f));
    }
    if (has_silhouettes_to_show(f))
        json_hash(j, "silhouettes", frame_hash_silhouettes(f));
    json_hash(j, "mask", frame_hash_mask(f));
    json_hash(j, "colour", frame_hash_colour(f));
    json_close(j);
}

static int write_stats_file(job *j)
{
    file_output output;
    if (file_output_open(&output, j->values[OUTPUT_STATS], &j->why))
        return -1;
    json w = {.stream = output.stream};
    json_open(&w, 0);
    json_string(&w, "scene", j->scene_path);
    json_string(&w, "version", GN_VERSION);
    json_integer(&w, "bits_version", GN_BITS_VERSION);
    json_integer(&w, "triangles", j->frame.plan.triangles);
    json_integer(&w, "vertices", j->frame.plan.vertices);
    json_integer(&w, "scale_exponent", j->packed.scale);
    if (j->packed.largest_rounding >= 0)
        json_number(&w, "largest_rounding_world_units", j->packed.largest_rounding);
    write_plan(&w, &j->settings, &j->frame.plan, j->packed.scale);
    write_statistics(&w, &j->frame);
    write_warp(&w, j);
    if (j->values[OUTPUT_HASH])
        write_hashes(&w, &j->frame);
    json_open(&w, "milliseconds");
    if (choices_use_view(&j->settings))
        json_number(&w, "view_pass", 1e3 * j->frame.view_seconds);
    json_number(&w, "light_pass", 1e3 * j->frame.light_seconds);
    json_number(&w, "camera_pass", 1e3 * j->frame.camera_seconds);
    json_close(&w);
    json_close(&w);
    return file_output_finish(&output, &j->why);
}

static void print_hashes(const frame *f)
{
    if (choices_use_view(&f->settings))
        printf("warp %016" PRIx64 "\n", frame_hash_warp(f));
    if (!choices_have_one_face(&f->settings)) {
        printf("layers %016" PRIx64 "\n", frame_hash_layers(f));
        printf("map %016" PRIx64 "\n", frame_hash_map(f));
    }
    if (has_silhouettes_to_show(f))
        printf("silhouettes %016" PRIx64 "\n", frame_hash_silhouettes(f));
    printf("mask %016" PRIx64 "\n", frame_hash_mask(f));
    printf("colour %016" PRIx64 "\n", frame_hash_colour(f));
}

static int write_outputs(job *j)
{
    const char **values = j->values;
    frame *f = &j->frame;
    if (values[OUTPUT_DEPTH] && write_depths(j, values[OUTPUT_DEPTH], f->layers[0]))
        return -1;
    if (values[OUTPUT_SECOND_DEPTH] && write_depths(j, values[OUTPUT_SECOND_DEPTH], f->layers[1]))
        return -1;
    if (values[OUTPUT_MAP] && write_depths(j, values[OUTPUT_MAP], f->map))
        return -1;
    if (values[OUTPUT_SILHOUETTES] && write_silhouettes(j, values[OUTPUT_SILHOUETTES]))
        return -1;
    if (values[OUTPUT_GRID] && write_grid(j, values[OUTPUT_GRID]))
        return -1;
    if (values[OUTPUT_MASK] && write_pixels(j, values[OUTPUT_MASK], f->mask, 1))
        return -1;
    if (values[OUTPUT_IMAGE] && write_pixels(j, values[OUTPUT_IMAGE], f->colour, 3))
        return -1;
    if (values[OUTPUT_STATS] && write_stats_file(j))
        return -1;
    if (values[OUTPUT_HASH])
        print_hashes(f);
    return 0;
}

/* ---- the command ----------------------------------------------------------------------------------------------- */

static int render(job *j)
{
    if (packed_read(&j->packed, j->scene_path, j->values[VERBOSE] != 0, &j->why) ||
        render_options_read(&j->settings, &j->packed, j->values, &j->why) ||
        work_options_read(&j->settings, j->values + WORK, &j->why) ||
        automatic_options_read(&j->settings, &j->packed, j->values, &j->why))
        return -1;
    j->settings.mask = j->values[OUTPUT_MASK] || j->values[OUTPUT_HASH];
    j->settings.format = j->values[OUTPUT_IMAGE] || j->values[OUTPUT_HASH] ? GN_RGB888 : GN_NO_COLOUR;
    if (frame_open(&j->frame, &j->packed.scene, &j->settings, wants_layers(j), &j->why))
        return -1;
    if (j->values[VERBOSE])
        say_what_was_read(j);
    if (j->settings.shadow == GN_SHADOW_VOLUMES &&
        (j->values[OUTPUT_DEPTH] || j->values[OUTPUT_SECOND_DEPTH] || j->values[OUTPUT_MAP]))
        return problem_of_usage(&j->why, "shadow volumes have no map to write; expected a method with a shadow map");
    if (choices_have_one_face(&j->settings) && (j->values[OUTPUT_DEPTH] || j->values[OUTPUT_SECOND_DEPTH] ||
                                                j->values[OUTPUT_MAP] || j->values[OUTPUT_SILHOUETTES]))
        return problem_of_usage(&j->why, "with --faces one no map stays to be written; expected --faces six");
    if (j->values[OUTPUT_SILHOUETTES] && !choices_have_silhouettes(&j->settings))
        return problem_of_usage(&j->why,
                                "--silhouettes, but no silhouette map is made; expected --reconstruct silhouette or "
                                "silhouette-smooth, as --method silhouette has");
    if (j->values[OUTPUT_SILHOUETTES] && j->settings.reconstruction == &gn_crossings)
        return problem_of_usage(&j->why,
                                "--silhouettes, but the map is one of crossings; expected --reconstruct silhouette or "
                                "silhouette-smooth");
    if (j->values[OUTPUT_GRID] && !choices_use_view(&j->settings))
        return problem_of_usage(&j->why,
                                "--grid, but the map is uniform; expected --parameterise with a fit or a warp");
    if (j->values[OUTPUT_SECOND_DEPTH] && j->frame.layer_count < 2)
        return problem_of_usage(&j->why,
                                "--second-depth, but the method keeps one layer; expected a method with two layers");
    if (frame_view_pass(&j->frame, &j->packed.camera, &j->packed.light, &j->why) ||
        frame_light_pass(&j->frame, &j->packed.light, &j->why) ||
        frame_camera_pass(&j->frame, &j->packed.camera, &j->why))
        return -1;
    if (j->values[VERBOSE])
        say_what_was_tested(&j->frame);
    return write_outputs(j);
}

int command_render(int argc, char **argv)
{
    job j = {.scene_path = 0};
    command_line line;
    int result = options_parse(table, OPTION_COUNT, argc, argv, j.values, &line, &j.why);
    if (!result && j.values[HELP]) {
        help();
        return EXIT_DONE;
    }
    if (!result && line.place_count != 1)
        result = problem_of_usage(&j.why, "%d scenes; expected one (gnomon render --help)", line.place_count);
    if (!result) {
        j.scene_path = line.places[0];
        result = check_outputs(&j) || render(&j) ? -1 : 0;
    }
    if (result)
        fprintf(stderr, "%s\n", j.why.text);
    frame_close(&j.frame);
    packed_free(&j.packed);
    return result ? EXIT_BAD_INPUT : EXIT_DONE;
}
