/* The options that say how shadows are made, shared by render, bench and pack: a named method, or its parts.
 *
 * A command's table starts with RENDER_OPTIONS; its own options follow at RENDER_OPTION_COUNT.
 */
#ifndef RENDER_OPTIONS_H
#define RENDER_OPTIONS_H

#include "options.h"
#include "packed.h"

enum {
    RENDER_HEAD_METHOD,
    RENDER_METHOD,
    RENDER_BUDGET_BYTES,
    RENDER_BUDGET_ERROR,
    RENDER_NO_TRIAL,
    RENDER_PARAMETERISE,
    RENDER_SMOOTHING,
    RENDER_FIT_DEPTH,
    RENDER_FACES,
    RENDER_CULL,
    RENDER_LAYERS,
    RENDER_SURFACE,
    RENDER_BIAS,
    RENDER_SLOPE,
    RENDER_RECEIVER,
    RENDER_RECONSTRUCT,
    RENDER_HEAD_SIZES,
    RENDER_MAP,
    RENDER_SIZE,
    RENDER_OPTION_COUNT
};

enum { WORK_HEAD, WORK_WORKERS, WORK_REGION, WORK_MAP_ROWS, WORK_OPTION_COUNT };

/* clang-format off */
#define RENDER_OPTIONS \
    {0, 0, "How shadows are made:"}, \
    {"--method", "NAME", \
     "constant, midpoint, dual, second-depth, mixed, slope, adaptive, silhouette\n" \
     "or auto: a preset of the options below. adaptive: constant, bias 0.0001r,\n" \
     "receiver virtual. silhouette: mixed, receiver virtual, reconstruct\n" \
     "silhouette. auto (the default): second-depth where every mesh is closed,\n" \
     "else mixed; receiver virtual. volumes: shadow volumes, right at every pixel\n" \
     "but ties, and without a map: none of the options below"}, \
    {"--budget-bytes", "N", \
     "with auto: choose method and map for this scene and view: the one that errs\n" \
     "least of those that keep at most N bytes between the passes (32K, 1M)"}, \
    {"--budget-error", "E", \
     "the same: the one of fewest bytes that is wrong at no more than E % of the\n" \
     "pixels that see a surface; with both budgets the cheapest that keeps both"}, \
    {"--no-trial", 0, \
     "with a budget: choose by measured tables alone instead of rendering candidates\n" \
     "and comparing them with the truth, which takes seconds"}, \
    {"--parameterise", "NAME", \
     "uniform (the default): the map covers the light's frustum evenly. To spend\n" \
     "texels where the camera looks, a fit: dv, the bounds of what it sees, or msf,\n" \
     "the smallest rectangle around that; or a warp: rectilinear, columns and rows\n" \
     "as wide as few pixels see them; rectilinear-distance, as they are far from\n" \
     "the camera; nonorthogonal, each row and then each column by itself; or one\n" \
     "of each: msf+rectilinear. rectilinear-vertices and nonorthogonal-vertices\n" \
     "warp vertices alone, as graphics hardware does: for comparison, wrong on\n" \
     "large triangles. nonorthogonal takes no reconstruction but nearest, and the\n" \
     "receivers point, virtual and virtual-always"}, \
    {"--smoothing", "F", \
     "of a warp: the width of its smoothing over the usual one, 1/64 to 64; default\n" \
     "1"}, \
    {"--fit-depth", 0, \
     "with a fit: a directional light's depths fitted as well, to what the camera\n" \
     "sees; nearer to the light than that is at the near end"}, \
    {"--faces", "N", \
     "maps of a point light in memory: six (the default), one for each face of a cube\n" \
     "about it, or one at a time: less memory, more time, the same picture"}, \
    {"--cull", "WHICH", \
     "auto, none, back or front faces of closed meshes in the light pass.\n" \
     "auto: what the virtual surface asks for"}, \
    {"--layers", "WHICH", \
     "auto, first or two: depths kept a texel in the light pass. auto: the\n" \
     "fewest that give the virtual surface"}, \
    {"--virtual-surface", "NAME", \
     "what a pixel is compared with (z1, z2: nearest and second depth, b: bias):\n" \
     "constant z1 + b; midpoint (z1 + z2) / 2; dual z1 + min((z2 - z1) / 2, b);\n" \
     "second z2 + b, or z1 + b with front faces culled; mixed: second where the\n" \
     "nearest mesh is closed, else dual;\n" \
     "slope z1 + F (m - z1) + b, m: the least z + half a texel of its own slope"}, \
    {"--bias", "B", \
     "in world units (0.1), in texels (2t) or in units of the light's depth\n" \
     "range (0.02r); not for midpoint. Default: 2t; slope 0.0005r;\n" \
     "adaptive 0.0001r; second 0"}, \
    {"--slope", "F", \
     "the factor F of the virtual surface slope (default 2) and of the receiver\n" \
     "plane-bias (default 1; with both, one for both): 0 to 64, in\n" \
     "steps of 1/65536"}, \
    {"--receiver", "NAME", \
     "what is compared: point: the pixel's own depth; plane-bias: the same less\n" \
     "F times half a texel of its triangle's slope; virtual: where texels about\n" \
     "it disagree, the depth of its triangle's plane at their centres;\n" \
     "virtual-always: that depth at every pixel. Default: as the method says,\n" \
     "else point"}, \
    {"--reconstruct", "NAME", \
     "nearest (the default): one texel decides; fractions of light: bilinear, of\n" \
     "the 4 texels about the point; jitter4x4, of 16, one of each cell; pcf3,\n" \
     "pcf5, pcf7, of so many texels squared. silhouette: hard borders along the\n" \
     "meshes' silhouettes through the texels, from a second map of a byte a texel;\n" \
     "silhouette-smooth: the same borders in five steps, a quarter of a texel wide;\n" \
     "crossing: hard borders as well, from where silhouettes cross the ways between\n" \
     "texels"}, \
    {0, 0, "Sizes (the scene file has defaults):"}, \
    {"--map", "N", "the shadow map's size: N or WxH, each from 1 to 4096"}, \
    {"--size", "WxH", "the image's size, each from 1 to 4096"}

/* How the work is cut: for commands that render. */
#define WORK_OPTIONS \
    {0, 0, "How the work is done (never changes the result):"}, \
    {"--workers", "N", "threads, 1 to 64; default 1"}, \
    {"--region", "WxH", "pixels the camera pass works on at a time: memory against time"}, \
    {"--map-rows", "N", "rows of the map the light pass works on at a time: memory against time"}
/* clang-format on */

/* Settings of a scene and a command line: settings->mask, ->workers and the regions are left as they are by default.
 * Shadow volumes and silhouettes: gives meshes the edges that they lack. 0, or -1 and the problem. */
int render_options_read(gn_settings *settings, packed_scene *packed, const char *const values[], problem *why);

/* Workers and regions; values from WORK_HEAD on. 0, or -1 and the problem. */
int work_options_read(gn_settings *settings, const char *const values[], problem *why);

#endif
