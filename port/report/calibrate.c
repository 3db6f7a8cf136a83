/* The frames that the cost model of the simulator is fitted to: all procedural scenes, several images and maps. */
#include "castle.h"
#include "colonnade.h"
#include "crowd.h"
#include "factory.h"
#include "fence.h"
#include "lshape.h"
#include "pins.h"
#include "pipes.h"
#include "room.h"
#include "sheets.h"
#include "table.h"
#include "torus2.h"

#define REPORT_SCENES                                                                                                  \
    SCENE(castle)                                                                                                      \
    SCENE(colonnade)                                                                                                   \
    SCENE(crowd)                                                                                                       \
    SCENE(factory)                                                                                                     \
    SCENE(fence)                                                                                                       \
    SCENE(lshape) SCENE(pins) SCENE(pipes) SCENE(room) SCENE(sheets) SCENE(table) SCENE(torus2)
#define REPORT_SIZES                                                                                                   \
    {80, 60, {32}}, {160, 120, {64, 128}},                                                                             \
    {                                                                                                                  \
        320, 240,                                                                                                      \
        {                                                                                                              \
            128, 256, 512                                                                                              \
        }                                                                                                              \
    }

#include "report.c"
