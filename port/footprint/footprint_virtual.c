/* The job of footprint.c with virtual samples. */
#define FOOTPRINT_RECEIVER (&gn_virtual)
#include "footprint.c"
