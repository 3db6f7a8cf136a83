/* What the test of docs/report counts anew: the plan of every frame, and passes of those that take no time. */
#define REPORT_RENDERS(frame, plan) ((plan)->triangles < 1000 && (frame)->map != 128)

#include "report.c"
