/* The job of footprint.c on a map that is fitted to what the camera sees. */
#define FOOTPRINT_FIT (&gn_desired_view)
#include "footprint.c"
