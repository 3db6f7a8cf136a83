/* Small scenes and frames for tests of the core: meshes that grow on the heap, and a context with its images.
 *
 * A frame's block lies between guard bytes: frame_end says whether anything outside it was written. */
#ifndef SCENES_H
#define SCENES_H

#include "gn_context.h"
#include "tap.h"

#include <string.h>

/* ---- random numbers -------------------------------------------------------------------------------------------- */

static uint64_t random_state = 3;

static TAP_UNUSED int32_t between(int64_t low, int64_t high)
{
    return (int32_t)(low + (int64_t)(tap_random(&random_state) % ((uint64_t)(high - low) + 1)));
}

/* ---- shapes ---------------------------------------------------------------------------------------------------- */

typedef struct shape {
    int32_t (*vertices)[3];
    uint32_t *indices;
    gn_mesh mesh;
} shape;

static void *grown(void *old, size_t bytes)
{
    void *p = realloc(old, bytes);
    if (!p)
        abort();
    return p;
}

static TAP_UNUSED shape shape_new(int closed)
{
    shape s;
    memset(&s, 0, sizeof s);
    s.mesh.index_size = 4;
    s.mesh.closed = (uint8_t)closed;
    return s;
}

static TAP_UNUSED uint32_t add_vertex(shape *s, int32_t x, int32_t y, int32_t z)
{
    uint32_t n = s->mesh.vertex_count++;
    s->vertices = grown(s->vertices, (n + 1) * sizeof *s->vertices);
    s->vertices[n][0] = x, s->vertices[n][1] = y, s->vertices[n][2] = z;
    s->mesh.vertices = (const int32_t(*)[3])s->vertices;
    return n;
}

static TAP_UNUSED void add_triangle(shape *s, uint32_t a, uint32_t b, uint32_t c)
{
    uint32_t n = s->mesh.triangle_count++;
    s->indices = grown(s->indices, 3 * (n + 1) * sizeof *s->indices);
    s->indices[3 * n] = a, s->indices[3 * n + 1] = b, s->indices[3 * n + 2] = c;
    s->mesh.indices = s->indices;
}

/* Two triangles a, b, c and a, c, d: counter-clockwise seen from where that is the order. */
static TAP_UNUSED void add_quad(shape *s, const int32_t a[3], const int32_t b[3], const int32_t c[3],
                                const int32_t d[3])
{
    uint32_t i = add_vertex(s, a[0], a[1], a[2]);
    add_vertex(s, b[0], b[1], b[2]);
    add_vertex(s, c[0], c[1], c[2]);
    add_vertex(s, d[0], d[1], d[2]);
    add_triangle(s, i, i + 1, i + 2);
    add_triangle(s, i, i + 2, i + 3);
}

/* A level rectangle at height z; up: counter-clockwise from above. */
static TAP_UNUSED void add_level(shape *s, int32_t x0, int32_t y0, int32_t x1, int32_t y1, int32_t z, int up)
{
    int32_t a[3] = {x0, y0, z}, b[3] = {x1, y0, z}, c[3] = {x1, y1, z}, d[3] = {x0, y1, z};
    if (up)
        add_quad(s, a, b, c, d);
    else
        add_quad(s, a, d, c, b);
}

/* A closed box, counter-clockwise from outside. */
static TAP_UNUSED void add_box(shape *s, const int32_t low[3], const int32_t high[3])
{
    static const uint8_t face[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                                       {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
    uint32_t first = s->mesh.vertex_count;
    for (int i = 0; i < 8; i++)
        add_vertex(s, i & 1 ? high[0] : low[0], i & 2 ? high[1] : low[1], i & 4 ? high[2] : low[2]);
    for (int i = 0; i < 6; i++) {
        add_triangle(s, first + face[i][0], first + face[i][1], first + face[i][2]);
        add_triangle(s, first + face[i][0], first + face[i][2], first + face[i][3]);
    }
}

static TAP_UNUSED void shape_free(shape *s)
{
    free(s->vertices);
    free(s->indices);
    memset(s, 0, sizeof *s);
}

/* ---- frames ---------------------------------------------------------------------------------------------------- */

enum { GUARD_BYTES = 256 };

typedef struct frame {
    uint8_t *block; /* guard, memory, guard */
    size_t bytes;
    gn_context *context;
    gn_plan plan;
    gn_settings settings;
    uint8_t *colour, *mask; /* whole images; mask: 0 unless settings.mask */
    int regions;            /* flushed */
    int bad_flush;          /* a region outside the image, or without what was asked for */
    int stop_after;         /* 0: never */
} frame;

static TAP_UNUSED size_t pixel_bytes(const frame *f)
{
    return f->settings.format == GN_RGB888 ? 3 : f->settings.format == GN_RGB565 ? 2 : 0;
}

static TAP_UNUSED size_t colour_bytes(const frame *f)
{
    return (size_t)f->settings.width * f->settings.height * pixel_bytes(f);
}

static TAP_UNUSED size_t mask_bytes(const frame *f)
{
    return (size_t)f->settings.width * f->settings.height;
}

/* Plan, allocate, init. */
static TAP_UNUSED gn_status frame_start(frame *f, const gn_scene *scene, const gn_settings *settings)
{
    memset(f, 0, sizeof *f);
    f->settings = *settings;
    gn_status status = gn_make_plan(&f->plan, scene, settings);
    if (status != GN_OK)
        return status;
    f->bytes = f->plan.bytes;
    f->block = grown(0, f->bytes + 2 * GUARD_BYTES);
    memset(f->block, 0xa5, f->bytes + 2 * GUARD_BYTES);
    f->colour = grown(0, colour_bytes(f) + 1);
    memset(f->colour, 0x5a, colour_bytes(f) + 1);
    if (settings->mask) {
        f->mask = grown(0, mask_bytes(f));
        memset(f->mask, 0x5a, mask_bytes(f));
    }
    return gn_init(&f->context, scene, settings, f->block + GUARD_BYTES, f->bytes);
}

/* Was nothing outside the block written? Frees it. */
static TAP_UNUSED int frame_end(frame *f)
{
    int intact = !f->bad_flush;
    for (size_t i = 0; f->block && i < GUARD_BYTES; i++)
        intact &= f->block[i] == 0xa5 && f->block[GUARD_BYTES + f->bytes + i] == 0xa5;
    free(f->block);
    free(f->colour);
    free(f->mask);
    memset(f, 0, sizeof *f);
    return intact;
}

/* Put a region into the frame's images. */
static TAP_UNUSED int frame_flush(void *user, const gn_pixels *p)
{
    frame *f = user;
    size_t pixel = pixel_bytes(f);
    f->regions++;
    if (p->x + p->width > f->settings.width || p->y + p->height > f->settings.height || p->width < 1 || p->height < 1 ||
        (pixel != 0) != (p->colour != 0) || f->settings.mask != (p->mask != 0)) {
        f->bad_flush = 1;
        return 1;
    }
    for (size_t row = 0; row < p->height; row++) {
        size_t to = (p->y + row) * f->settings.width + p->x;
        if (pixel)
            memcpy(f->colour + to * pixel, (const uint8_t *)p->colour + row * p->width * pixel, p->width * pixel);
        if (p->mask)
            memcpy(f->mask + to, p->mask + row * p->width, p->width);
    }
    return f->stop_after && f->regions == f->stop_after;
}

/* Both passes. */
static TAP_UNUSED gn_status frame_render(frame *f, const gn_light *light, const gn_camera *camera)
{
    gn_status status = gn_light_pass(f->context, light);
    return status == GN_OK ? gn_camera_pass(f->context, camera, frame_flush, f) : status;
}

/* Lit and shadowed pixels of the mask. */
static TAP_UNUSED void count_mask(const frame *f, uint64_t *lit, uint64_t *shadowed)
{
    for (size_t i = 0; i < mask_bytes(f); i++) {
        *lit += f->mask[i] == 254;
        *shadowed += f->mask[i] == 0;
    }
}

/* A texel of the map, or of a layer between layers and resolve. */
static TAP_UNUSED gn_depth texel_at(const gn_context *context, uint32_t column, uint32_t row)
{
    return context->map[row * context->map_stride + column];
}

/* ---- lights on a grid ------------------------------------------------------------------------------------------ */

/* A light that looks down z on x, y in [0, 256 width) x [0, 256 height): a world unit is 1/256 texel, y up on the map.
 * World z = 0 is at depth 0, z = -65535 at the end of the range, and a world unit is one unit of 16-bit depth, exactly:
 * a stored 32-bit depth is 65536 d + 32768 at a distance d. */
static TAP_UNUSED gn_light grid_light(uint32_t width, uint32_t height)
{
    gn_light light;
    memset(&light, 0, sizeof light);
    light.kind = GN_DIRECTIONAL;
    light.right[0] = 1 << 30;
    light.up[1] = 1 << 30;
    light.forward[2] = -(1 << 30);
    light.box_width = (int32_t)(256 * width);
    light.box_height = (int32_t)(256 * height);
    light.box_depth = 65535;
    return light;
}

/* What a stored depth of d units of that light is. */
static TAP_UNUSED gn_depth grid_depth(uint32_t d)
{
    return (gn_depth)((65536 * d + 32768) >> (32 - GN_DEPTH_BITS));
}

/* A bias of d units. */
static TAP_UNUSED gn_depth grid_bias(uint32_t d)
{
    return (gn_depth)((65536 * d) >> (32 - GN_DEPTH_BITS));
}

#endif
