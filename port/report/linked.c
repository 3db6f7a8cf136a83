/* What a program links that renders frames by one chain: a function for each, of which a linker that collects unused
 * sections keeps the one that is its entry (port/report/flash.sh). Not to be run. */
#include "chains.c"

/* Known when compiled: flattened, a chain's function refers to what this chain names and to no other. */
#define FRAME(number)                                                                                                  \
    void frame_##number(const gn_scene *, const gn_camera *, const gn_light *, gn_flush, void *, size_t);              \
    __attribute__((flatten)) void frame_##number(const gn_scene *scene, const gn_camera *camera,                       \
                                                 const gn_light *light, gn_flush flush, void *memory, size_t bytes)    \
    {                                                                                                                  \
        render(&chains[number], scene, camera, light, flush, memory, bytes);                                           \
    }

static void render(const chain *by, const gn_scene *scene, const gn_camera *camera, const gn_light *light,
                   gn_flush flush, void *memory, size_t bytes)
{
    gn_settings settings = chain_settings(by, 160, 120, 128);
    gn_context *context;
    if (gn_init(&context, scene, &settings, memory, bytes) != GN_OK)
        return;
    if (by->fit || by->warp)
        gn_view_pass(context, camera, light);
    if (by->shadow == GN_SHADOW_VOLUMES) {
        gn_volumes_light(context, light);
        gn_volumes_pass(context, camera, flush, 0);
    } else {
        gn_light_pass(context, light);
        gn_camera_pass(context, camera, flush, 0);
    }
}

/* clang-format off */
FRAME(0) FRAME(1) FRAME(2) FRAME(3) FRAME(4) FRAME(5) FRAME(6) FRAME(7) FRAME(8) FRAME(9)
FRAME(10) FRAME(11) FRAME(12) FRAME(13) FRAME(14) FRAME(15) FRAME(16) FRAME(17) FRAME(18) FRAME(19)
FRAME(20) FRAME(21) FRAME(22) FRAME(23) FRAME(24) FRAME(25) FRAME(26) FRAME(27) FRAME(28) FRAME(29)
FRAME(30)
    /* clang-format on */

    /* All of them. */
    typedef char number_of_frames[sizeof chains / sizeof *chains == 31 ? 1 : -1];
