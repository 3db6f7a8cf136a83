/* The job of footprint.c with mixed surfaces, virtual samples and silhouettes. Map and silhouettes take 48 KiB, so that
 * image and light pass take smaller regions. */
#define FOOTPRINT_SURFACE GN_MIXED
#define FOOTPRINT_BIAS_TEXELS 2
#define FOOTPRINT_RECEIVER (&gn_virtual)
#define FOOTPRINT_RECONSTRUCTION (&gn_silhouettes)
#define FOOTPRINT_MAP_ROWS 32
#define FOOTPRINT_IMAGE_ROWS 6
#include "footprint.c"
