/* Frames that the cost model was not fitted to: other cameras and lights of some procedural scenes (`gnomon procedural
 * NAME --view 21`), in other sizes. */
#include "castle_view21.h"
#include "factory_view21.h"
#include "fence_view21.h"
#include "pins_view21.h"
#include "room_view21.h"
#include "table_view21.h"

#define REPORT_SCENES                                                                                                  \
    SCENE(castle_view21)                                                                                               \
    SCENE(factory_view21) SCENE(fence_view21) SCENE(pins_view21) SCENE(room_view21) SCENE(table_view21)
#define REPORT_SIZES                                                                                                   \
    {128, 128, {100}},                                                                                                 \
    {                                                                                                                  \
        480, 270,                                                                                                      \
        {                                                                                                              \
            192                                                                                                        \
        }                                                                                                              \
    }

#include "report.c"
