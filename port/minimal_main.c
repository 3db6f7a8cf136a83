/* The smallest whole program: a box on a slab under a directional light, drawn in characters on the port's console, the
 * denser the brighter. The expected picture stands in docs/porting.md. */
#include "gnomon.h"
#include "port.h"

enum { WIDTH = 72, HEIGHT = 36, MAP = 64, M = 1000000 /* a metre in world units */ };

/* A cube of one metre; bit 0 of a corner's number is x, bit 1 y, bit 2 z. */
static const int32_t corners[8][3] = {
    {-M / 2, -M / 2, -M / 2}, {M / 2, -M / 2, -M / 2}, {-M / 2, M / 2, -M / 2}, {M / 2, M / 2, -M / 2},
    {-M / 2, -M / 2, M / 2},  {M / 2, -M / 2, M / 2},  {-M / 2, M / 2, M / 2},  {M / 2, M / 2, M / 2},
};
static const uint16_t triangles[12][3] = {
    {0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, /* back, front: counter-clockwise from outside */
    {0, 1, 5}, {0, 5, 4}, {2, 6, 7}, {2, 7, 3}, /* bottom, top */
    {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}, /* left, right */
};
static const gn_mesh cube = {corners, triangles, 8, 12, sizeof(uint16_t), 1, 0, 0};

/* In units of 1/1024: a slab of 6 x 0.25 x 6 metres whose top is at y = 0, and a box of 1.5 x 2 x 1 on it. */
static const gn_model slab = {{{6144, 0, 0}, {0, 256, 0}, {0, 0, 6144}}, {0, -M / 8, 0}, 10};
static const gn_model box = {{{1536, 0, 0}, {0, 2048, 0}, {0, 0, 1024}}, {0, M, 0}, 10};
static const gn_object objects[] = {{&cube, &slab, {128, 160, 128}}, {&cube, &box, {200, 200, 200}}};
static const gn_scene scene = {objects, 2, {0, 0, 0}, 65535 / 5};

static uint64_t memory[8 * 1024];
static char screen[HEIGHT][WIDTH + 1];

/* Called with each finished region. A board would send p->colour to its display; returning 1 would stop the frame. */
static int flush(void *user, const gn_pixels *p)
{
    const uint8_t *rgb = p->colour;
    (void)user;
    for (int y = 0; y < p->height; y++) {
        for (int x = 0; x < p->width; x++, rgb += 3)
            screen[p->y + y][p->x + x] = " .:-=+*#"[rgb[1] / 32];
    }
    return 0;
}

int main(void)
{
    static const int32_t eye[3] = {3 * M, 6 * M, 7 * M}, target[3] = {-M * 3 / 10, M * 3 / 10, 0}, up[3] = {0, 1, 0};
    static const int32_t down[3] = {-5, -6, 4};
    gn_settings settings = gn_default_settings(WIDTH, HEIGHT, MAP);
    gn_plan plan;
    gn_context *context;
    gn_camera camera;
    gn_light light;
    if (gn_make_plan(&plan, &scene, &settings) != GN_OK || plan.bytes > sizeof memory)
        return 1;
    if (gn_init(&context, &scene, &settings, memory, sizeof memory) != GN_OK ||
        gn_look_at(&camera, eye, target, up) != GN_OK || gn_perspective(&camera, GN_DEGREES(28), M, 30 * M) != GN_OK ||
        gn_directional_light(&light, down, 0) != GN_OK || gn_fit_light(&light, &scene) != GN_OK)
        return 2;
    if (gn_light_pass(context, &light) != GN_OK || gn_camera_pass(context, &camera, flush, 0) != GN_OK)
        return 3;
    for (int y = 0; y < HEIGHT; y++) {
        port_write(screen[y]);
        port_write("\n");
    }
    return 0;
}
