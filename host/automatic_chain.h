/* The candidates of `--method auto` with a budget: which settings they are, how large a map fits how many bytes, and
 * what the tables expect of them.
 *
 * A candidate is a virtual surface, a test, a placement of texels and a map. Resident bytes are those that stay between
 * the passes on a small machine: the map, silhouettes, and the tables of a warp; of shadow volumes the facing of
 * triangles and the silhouette edges.
 */
#ifndef AUTOMATIC_CHAIN_H
#define AUTOMATIC_CHAIN_H

#include "automatic_scene.h"

/* What texels hold. Nearest: one layer of all triangles, and a bias. Second: one layer, of what closed meshes turn away
 * from the light; what is flat casts nothing to speak of. Dual and mixed: two layers. */
enum { AUTOMATIC_NEAREST, AUTOMATIC_DUAL, AUTOMATIC_SECOND, AUTOMATIC_MIXED, AUTOMATIC_SURFACES };

/* How a pixel is compared, from cheap to dear: with its own depth, with virtual samples, with those and a second map.
 */
enum { AUTOMATIC_POINT, AUTOMATIC_VIRTUAL, AUTOMATIC_SILHOUETTE, AUTOMATIC_CROSSING, AUTOMATIC_TESTS };

/* Where texels lie. WIDE and NARROW: smoothed over 4 times and a quarter of the usual width. */
enum {
    AUTOMATIC_UNIFORM,
    AUTOMATIC_DV,
    AUTOMATIC_MSF,
    AUTOMATIC_RECTILINEAR,
    AUTOMATIC_DV_RECTILINEAR,
    AUTOMATIC_MSF_RECTILINEAR,
    AUTOMATIC_DV_DISTANCE,
    AUTOMATIC_MEASURED_PLACEMENTS,
    AUTOMATIC_MSF_DISTANCE = AUTOMATIC_MEASURED_PLACEMENTS,
    AUTOMATIC_NARROW,
    AUTOMATIC_WIDE,
    AUTOMATIC_PLACEMENTS
};

typedef struct automatic_candidate {
    uint8_t surface, test, placement;
    uint16_t width, height; /* of the map; 0: shadow volumes */
} automatic_candidate;

/* base: sizes of the image, faces of a point light; its other choices are replaced. */
gn_settings automatic_settings(const automatic_candidate *candidate, const gn_settings *base);

/* "second, virtual, silhouettes, msf+rectilinear": at most 96 bytes, as the options say it. */
void automatic_candidate_text(const automatic_candidate *candidate, char *text, size_t size);

/* Does this surface suit what the scene is made of? */
int automatic_surface_suits(int surface, const automatic_scene *scene);

/* A point light takes neither fits nor warps. */
int automatic_placement_suits(int placement, const automatic_scene *scene);

/* Resident bytes; 0: the core refuses the candidate. */
uint64_t automatic_bytes(const automatic_candidate *candidate, const packed_scene *packed, const gn_settings *base);

/* Sides of a map are in one of these proportions. */
enum { AUTOMATIC_SQUARE = 4, AUTOMATIC_SHAPES = 9 };

/* log2 of columns over rows. */
double automatic_shape(int shape);

/* The candidate with the largest map of this shape that fits into so many resident bytes. 0: none does. */
int automatic_fill(automatic_candidate *candidate, int shape, uint64_t bytes, const packed_scene *packed,
                   const gn_settings *base);

/* % of the pixels that see a surface. */
double automatic_expected_error(const automatic_candidate *candidate, const automatic_scene *scene);

/* Instructions of a Cortex-M4 a pixel of a frame, the mean over the scenes of the tables. */
double automatic_expected_cost(const automatic_candidate *candidate);

#endif
