/* The job of footprint.c with a bias by the receiver's plane. */
#define FOOTPRINT_RECEIVER (&gn_plane_bias)
#include "footprint.c"
