/* The job of footprint.c with bilinear reconstruction. */
#define FOOTPRINT_RECONSTRUCTION (&gn_bilinear)
#include "footprint.c"
