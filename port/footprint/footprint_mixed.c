/* The job of footprint.c with mixed surfaces and virtual samples. */
#define FOOTPRINT_SURFACE GN_MIXED
#define FOOTPRINT_BIAS_TEXELS 2
#define FOOTPRINT_RECEIVER (&gn_virtual)
#include "footprint.c"
