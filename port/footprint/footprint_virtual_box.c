/* The job of footprint.c with virtual samples and boxes of 5 x 5 texels. */
#define FOOTPRINT_RECEIVER (&gn_virtual)
#define FOOTPRINT_RECONSTRUCTION (&gn_box_5x5)
#include "footprint.c"
