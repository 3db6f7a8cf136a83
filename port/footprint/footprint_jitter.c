/* The job of footprint.c with a 4 x 4 jitter matrix. */
#define FOOTPRINT_RECONSTRUCTION (&gn_jitter_4x4)
#include "footprint.c"
