/* Which lanes there are. Weak: what is not linked is a null pointer. */
#include "lane.h"

#include <stdlib.h>
#include <string.h>

extern const lane lane_16 __attribute__((weak)), lane_32 __attribute__((weak));
extern const lane lane_16_counted __attribute__((weak)), lane_32_counted __attribute__((weak));
extern const lane lane_16_firmware __attribute__((weak)), lane_32_firmware __attribute__((weak));

const lane *lane_find(int depth_bits, int counts)
{
    if (counts)
        return depth_bits == 16 ? &lane_16_counted : depth_bits == 32 ? &lane_32_counted : 0;
    if (depth_bits == GN_DEPTH_BITS)
        return &lane_here;
    return depth_bits == 16 ? &lane_16 : depth_bits == 32 ? &lane_32 : 0;
}

const lane *lane_of_firmware(int depth_bits)
{
    return depth_bits == 16 ? &lane_16_firmware : &lane_32_firmware;
}

void lane_frame_free(lane_frame *f)
{
    free(f->mask);
    memset(f, 0, sizeof *f);
}
