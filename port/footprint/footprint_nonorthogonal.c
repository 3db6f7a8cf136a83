/* The job of footprint.c with virtual samples on a fitted map with a non-orthogonal warp, whose tables are as large as
 * two maps: 80 x 80 texels are what fits. */
#define FOOTPRINT_MAP 80
#define FOOTPRINT_RECEIVER (&gn_virtual)
#define FOOTPRINT_FIT (&gn_desired_view)
#define FOOTPRINT_WARP (&gn_nonorthogonal)
#include "footprint.c"
