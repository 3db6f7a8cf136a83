/* The job of footprint_silhouette.c on the smallest frustum's map, warped by counts of what the camera sees. */
#define FOOTPRINT_SURFACE GN_MIXED
#define FOOTPRINT_BIAS_TEXELS 2
#define FOOTPRINT_RECEIVER (&gn_virtual)
#define FOOTPRINT_RECONSTRUCTION (&gn_silhouettes)
#define FOOTPRINT_FIT (&gn_minimal_frustum)
#define FOOTPRINT_WARP (&gn_rectilinear)
#define FOOTPRINT_MAP_ROWS 32
#define FOOTPRINT_IMAGE_ROWS 6
#include "footprint.c"
