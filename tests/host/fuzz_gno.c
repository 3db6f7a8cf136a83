/* Any bytes as a packed scene, their size and checksum put right first: no crash,
 * and the core renders what is accepted. */
#include "frame.h"
#include "fuzz.h"
#include "pack.h"

#include <stdlib.h>
#include <string.h>

static void put(uint8_t *at, uint32_t value)
{
    for (int i = 0; i < 4; i++)
        at[i] = (uint8_t)(value >> (8 * i));
}

static uint32_t crc32_of(const uint8_t *bytes, size_t size)
{
    uint32_t crc = 0xffffffff;
    for (size_t i = 0; i < 8 * size; i++)
        crc = crc >> 1 ^ (((crc ^ (uint32_t)(bytes[i / 8] >> (i % 8))) & 1) ? 0xedb88320 : 0);
    return ~crc;
}

static uint64_t drawn; /* pictures that were rendered to their end */

static void draw(packed_scene *packed, gn_shadow shadow)
{
    frame f;
    problem why;
    packed->settings.shadow = (uint8_t)shadow;
    if (frame_open(&f, &packed->scene, &packed->settings, 1, &why) == 0 &&
        frame_view_pass(&f, &packed->camera, &packed->light, &why) == 0 &&
        frame_light_pass(&f, &packed->light, &why) == 0)
        drawn += frame_camera_pass(&f, &packed->camera, &why) == 0;
    frame_close(&f);
}

/* Small pictures only, for speed. A refusal is fine, as long as it is one that the core documents for scenes. */
static void render(packed_scene *packed)
{
    problem why;
    gn_plan plan;
    packed->settings.shadow = GN_SHADOW_MAP;
    gn_status status = gn_make_plan(&plan, &packed->scene, &packed->settings);
    if (status != GN_OK && status != GN_UNSUPPORTED)
        abort();
    packed->settings.width = packed->settings.height = packed->settings.map_width = packed->settings.map_height = 24;
    packed->settings.mask = 1;
    if (status == GN_OK)
        draw(packed, GN_SHADOW_MAP);
    if (packed_make_edges(packed, 0, &why) == 0)
        draw(packed, GN_SHADOW_VOLUMES);
}

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size)
{
    packed_scene packed;
    problem why;
    uint8_t *copy = calloc(size + 1, 1);
    memcpy(copy, bytes, size);
    if (size >= 16) {
        put(copy + 8, (uint32_t)size);
        put(copy + 12, crc32_of(copy + 16, size - 16));
    }
    if (pack_parse(&packed, "fuzz", copy, size, &why) == 0)
        render(&packed);
    packed_free(&packed);
    free(copy);
    return 0;
}

#ifndef GNOMON_LIBFUZZER
enum { GOOD_SIZE = 316 };

/* A scene of a triangle and its back, with their edges: an upright view along -z, a light from above. */
static size_t make_good(uint8_t good[GOOD_SIZE])
{
    static const uint8_t indices[] = {0, 0, 1, 0, 2, 0, 2, 0, 1, 0, 0, 0};
    static const uint32_t edges[] = {0, 4, 1, 3, 2, 5};
    memset(good, 0, GOOD_SIZE);
    memcpy(good, "GNOM\4", 5);
    good[16] = good[18] = good[20] = good[22] = 8;
    put(good + 72, 1 << 30), put(good + 88, 1 << 30), put(good + 104, 0xc0000000); /* camera: right, up, forward */
    put(good + 108, 1 << 24), put(good + 116, 16), put(good + 120, 1000);
    put(good + 128, 1 << 30), put(good + 148, 1 << 30), put(good + 156, 0xc0000000);
    for (int i = 0; i < 3; i++) /* the box: its corner and its size */
        put(good + 164 + 4 * i, 0xfffffc00), put(good + 176 + 4 * i, 0x800);
    put(good + 212, 1), put(good + 216, 1), put(good + 220, 3), put(good + 224, 2), put(good + 228, 2);
    put(good + 232, 3), put(good + 248, 100), put(good + 264, 100); /* the edges; the second and third corner */
    put(good + 244, -200u), put(good + 256, -200u), put(good + 268, -300u);
    memcpy(good + 272, indices, sizeof indices);
    for (int i = 0; i < 6; i++)
        put(good + 284 + 4 * i, edges[i]);
    return GOOD_SIZE;
}

/* The same scene with a method: no culling or layers named, a bias of two texels, a slope of 2. */
static void choose(uint8_t good[GOOD_SIZE], gn_surface surface, uint8_t receiver, uint8_t reconstruction)
{
    good[33] = 1;
    good[36] = (uint8_t)surface;
    good[37] = GN_BIAS_TEXELS;
    good[39] = receiver;
    put(good + 40, 2 << 16), put(good + 44, 2 << 16);
    good[48] = reconstruction;
}

static void parameterise(uint8_t good[GOOD_SIZE], uint8_t fit, uint8_t warp)
{
    good[49] = fit;
    good[50] = warp;
    good[51] = fit != 0;
    put(good + 52, warp ? 1 << 16 : 0);
}

/* The objects follow the indices then. */
static size_t leave_out_edges(uint8_t good[GOOD_SIZE])
{
    enum { EDGES = 284, OBJECTS = GOOD_SIZE - 8 };
    put(good + 232, 0);
    memmove(good + EDGES, good + OBJECTS, GOOD_SIZE - OBJECTS);
    return EDGES + GOOD_SIZE - OBJECTS;
}

int main(int argc, char **argv)
{
    static const uint8_t surfaces[] = {GN_SLOPE, GN_MIXED, GN_CONSTANT, GN_SECOND, GN_DUAL, GN_MIDPOINT};
    uint8_t good[GOOD_SIZE];
    size_t size = make_good(good);
    uint64_t cases = tap_cases(argc, argv, TAP_SLOWER * 20000);
    fuzz_run("changed_packed_scenes_never_crash_the_reader", good, size, cases);
    for (uint8_t i = 0; i < 7; i++) {
        choose(good, surfaces[i % 6], i % 4, i);
        fuzz_run("nor_do_those_with_a_method", good, size, cases / 6);
    }
    for (uint8_t i = 1; i < 6; i++) {
        choose(good, GN_MIXED, 2, i == 1 ? 6 : 0);
        parameterise(good, i % 3, i);
        fuzz_run("nor_do_those_with_a_fit_or_a_warp", good, size, cases / 6);
    }
    parameterise(good, 0, 0);
    choose(good, surfaces[0], 2, 6);
    size = leave_out_edges(good);
    fuzz_run("nor_do_those_with_silhouettes_and_no_edges", good, size, cases / 6);
    ok(drawn > cases / 10, "many_of_them_are_rendered");
    return tap_done();
}
#endif
