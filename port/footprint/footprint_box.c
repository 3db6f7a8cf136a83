/* The job of footprint.c with boxes of 5 x 5 texels. */
#define FOOTPRINT_RECONSTRUCTION (&gn_box_5x5)
#include "footprint.c"
