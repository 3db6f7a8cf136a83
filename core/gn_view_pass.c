/* Fits and warps: see gnomon.h. */
#include "gnomon.h"

struct gn_fit {
    int unused;
};

struct gn_warp {
    int unused;
};

const gn_fit gn_desired_view = {0}, gn_minimal_frustum = {0};
const gn_warp gn_rectilinear = {0}, gn_rectilinear_distance = {0}, gn_nonorthogonal = {0};
const gn_warp gn_rectilinear_vertices = {0}, gn_nonorthogonal_vertices = {0};

gn_status gn_view_pass(gn_context *context, const gn_camera *camera, const gn_light *light)
{
    (void)context, (void)camera, (void)light;
    return GN_UNSUPPORTED;
}

gn_status gn_view_begin(gn_context *context, const gn_camera *camera, const gn_light *light)
{
    (void)context, (void)camera, (void)light;
    return GN_UNSUPPORTED;
}

gn_status gn_view_region(gn_context *context, uint32_t region, uint32_t worker)
{
    (void)context, (void)region, (void)worker;
    return GN_UNSUPPORTED;
}

gn_status gn_view_end(gn_context *context)
{
    (void)context;
    return GN_UNSUPPORTED;
}

gn_status gn_get_rectangle(const gn_context *context, gn_rectangle *rectangle)
{
    (void)context, (void)rectangle;
    return GN_UNSUPPORTED;
}

int gn_texel_place(const gn_context *context, uint32_t column, uint32_t row, uint32_t place[2])
{
    (void)context, (void)column, (void)row, (void)place;
    return 0;
}
