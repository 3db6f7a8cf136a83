/* The job of footprint.c by shadow volumes. */
#define FOOTPRINT_SHADOW GN_SHADOW_VOLUMES
#include "footprint.c"
