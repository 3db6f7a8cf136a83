/* What a view pass made of a map, in figures. */
#ifndef WARP_REPORT_H
#define WARP_REPORT_H

#include "gnomon.h"

typedef struct warp_report {
    double share; /* area of the rectangle that the map covers, over that of the light's box or frustum */
    double angle; /* from the plane's rows to the rectangle's, in degrees */
    /* Least and largest magnification: how many times as close neighbours lie as in a uniform map of the rectangle.
     * 1 and 1 without a warp, or where there is one column or row. */
    double columns[2], rows[2];
} warp_report;

/* places: gn_texel_place of every texel, columns x rows. */
warp_report warp_report_make(const gn_rectangle *rectangle, const gn_light *light, uint32_t (*places)[2],
                             uint32_t columns, uint32_t rows);

#endif
