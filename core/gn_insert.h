/* A depth into one texel of the layers, by any way of insertion. */
#ifndef GN_INSERT_H
#define GN_INSERT_H

#include "gn_layers.h"

/* rise: h of GN_INSERT_RISING. */
GN_INLINE void gn_insert(const gn_layer_target *t, int32_t at, uint32_t z, uint32_t rise)
{
    gn_depth *z1 = t->first + at, v = gn_cut_layer(z, t->how, t->open);
    if (t->how == GN_INSERT_FIRST) {
        gn_insert_first(z1, v);
        return;
    }
    gn_depth *z2 = t->second + (at - t->second_offset);
    if (t->how == GN_INSERT_RISING) {
        gn_insert_first(z1, v);
        gn_insert_first(z2, gn_cut_layer(gn_risen(z, rise), t->how, t->open));
    } else if (t->how == GN_INSERT_TWICE) {
        gn_insert_twice(z1, z2, v);
    } else {
        gn_insert_two(z1, z2, v);
    }
}

/* The same of a depth that may be out of range: held within it, and so is what it rises to. */
GN_INLINE void gn_insert_wide(const gn_layer_target *t, int32_t at, int64_t z, uint32_t rise)
{
    gn_insert(t, at, gn_saturate(z), z < 0 ? gn_saturate(z + rise) : rise);
}

#endif
