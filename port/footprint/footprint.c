/* How much memory a typical job takes: 1,000 triangles in flash, a map of 128 x 128, an image of 320 x 240, second
 * depth, the nearest texel at the point's own depth; or what the files that include it choose. Linked into a RAM of
 * RAM_LIMIT bytes (board.ld), so that running at all proves that it fits. Prints
 *
 *     ram plan N statics N stack N whole N      bytes
 *     building all N rows-32 N rows-16 N        of the context while the map is made, in one region or by so many rows
 */
#include "footprint.h"
#include "gnomon.h"
#include "port.h"
#include "print.h"

/* Known when compiled, so that only one method is linked. */
#ifndef FOOTPRINT_SHADOW
#define FOOTPRINT_SHADOW GN_SHADOW_MAP
#endif
#ifndef FOOTPRINT_SURFACE
#define FOOTPRINT_SURFACE GN_SECOND
#define FOOTPRINT_BIAS_TEXELS 0
#endif
#ifndef FOOTPRINT_RECEIVER
#define FOOTPRINT_RECEIVER 0
#endif
#ifndef FOOTPRINT_RECONSTRUCTION
#define FOOTPRINT_RECONSTRUCTION 0
#endif
#ifndef FOOTPRINT_FIT
#define FOOTPRINT_FIT 0
#define FOOTPRINT_WARP 0
#define FOOTPRINT_VIEW_PASS 0
#endif
#ifndef FOOTPRINT_WARP
#define FOOTPRINT_WARP 0
#endif
#ifndef FOOTPRINT_VIEW_PASS
#define FOOTPRINT_VIEW_PASS 1
#endif
#ifndef FOOTPRINT_CASTERS
#define FOOTPRINT_CASTERS 0
#define FOOTPRINT_STATIC_OBJECTS 0
#endif
#ifndef FOOTPRINT_MAP
#define FOOTPRINT_MAP 128
#endif
/* Rows of a region of the map and of the image; 0: as gn_make_plan takes them. */
#ifndef FOOTPRINT_MAP_ROWS
#define FOOTPRINT_MAP_ROWS 0
#define FOOTPRINT_IMAGE_ROWS 0
#endif

enum { RAM_LIMIT = 96 * 1024, STACK = 4096, STATICS = 1024 };

static uint64_t memory[(RAM_LIMIT - STACK - STATICS) / sizeof(uint64_t)];

extern uint8_t data_start[], bss_end[]; /* the linker script's */

static uint32_t lit, shadowed;

static int count_mask(void *user, const gn_pixels *p)
{
    (void)user;
    for (uint32_t i = 0; i < (uint32_t)p->width * p->height; i++) {
        lit += p->mask[i] == 254;
        shadowed += p->mask[i] == 0;
    }
    return 0;
}

static void write_bytes(const char *name, uint32_t bytes)
{
    port_write(name);
    write_decimal(bytes);
}

static gn_settings settings_with(uint16_t map_rows)
{
    gn_settings settings = gn_default_settings(320, 240, FOOTPRINT_MAP);
    settings.mask = 1;
    settings.shadow = FOOTPRINT_SHADOW;
    settings.surface = FOOTPRINT_SURFACE;
    settings.bias.value = FOOTPRINT_BIAS_TEXELS << 16;
    settings.receiver = FOOTPRINT_RECEIVER;
    settings.reconstruction = FOOTPRINT_RECONSTRUCTION;
    settings.fit = FOOTPRINT_FIT;
    settings.warp = FOOTPRINT_WARP;
    settings.casters = FOOTPRINT_CASTERS;
    settings.static_objects = FOOTPRINT_STATIC_OBJECTS;
    settings.region_height = FOOTPRINT_IMAGE_ROWS;
    settings.map_rows = map_rows;
    return settings;
}

static void write_building(const char *name, uint16_t map_rows)
{
    gn_settings settings = settings_with(map_rows);
    gn_plan plan = {0};
    (void)gn_make_plan(&plan, &footprint_scene, &settings);
    write_bytes(name, (uint32_t)plan.light_bytes);
}

static gn_status light_pass(gn_context *context)
{
    if (FOOTPRINT_VIEW_PASS) {
        gn_status status = gn_view_pass(context, &footprint_camera, &footprint_light);
        if (status != GN_OK)
            return status;
    }
    return FOOTPRINT_SHADOW == GN_SHADOW_VOLUMES ? gn_volumes_light(context, &footprint_light)
                                                 : gn_light_pass(context, &footprint_light);
}

static gn_status camera_pass(gn_context *context)
{
    return FOOTPRINT_SHADOW == GN_SHADOW_VOLUMES ? gn_volumes_pass(context, &footprint_camera, count_mask, 0)
                                                 : gn_camera_pass(context, &footprint_camera, count_mask, 0);
}

int main(void)
{
    gn_settings settings = settings_with(FOOTPRINT_MAP_ROWS);
    gn_plan plan;
    gn_context *context;
    if (gn_make_plan(&plan, &footprint_scene, &settings) != GN_OK || plan.triangles != 1000)
        return 1;
    if (gn_init(&context, &footprint_scene, &settings, memory, sizeof memory) != GN_OK)
        return 2;
    if (light_pass(context) != GN_OK)
        return 3;
    if (camera_pass(context) != GN_OK || lit == 0 || shadowed == 0)
        return 4;

    uint32_t statics = (uint32_t)((uintptr_t)bss_end - (uintptr_t)data_start - sizeof memory);
    uint32_t stack = port_stack_used();
    uint32_t whole = (uint32_t)plan.bytes + statics + stack;
    write_bytes("ram plan ", (uint32_t)plan.bytes);
    write_bytes(" statics ", statics);
    write_bytes(" stack ", stack);
    write_bytes(" whole ", whole);
    write_building("\nbuilding all ", 0);
    write_building(" rows-32 ", 32);
    write_building(" rows-16 ", 16);
    port_write("\n");
    return whole <= RAM_LIMIT ? 0 : 5;
}
