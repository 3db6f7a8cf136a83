/* The job of footprint.c on a smaller map, and what the slab makes of it is kept. */
#define FOOTPRINT_MAP 96
#define FOOTPRINT_CASTERS (&gn_static_casters)
#define FOOTPRINT_STATIC_OBJECTS 1
#include "footprint.c"
