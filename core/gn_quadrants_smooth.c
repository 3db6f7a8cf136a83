/* Silhouettes with smooth borders: four places about the point, each in a quadrant of its cell, count alike. A rotated
 * square (a place in each of four columns and rows), so borders along the map's axes have all five steps of light. The
 * places stay in the point's cell, where the comparisons of its four texels hold; what lies in a cell whose texels
 * agree is not smoothed. Cost: only points on which texels disagree pay for four quadrants. */
#include "gn_quadrants.h"

enum { PLACES = 4 };

static void vote(const gn_lookup *lookup, gn_points *points)
{
    const gn_lookup l = *lookup;
    for (int32_t i = 0; i < points->count; i++) {
        uint32_t u = points->u[i], z = points->z[i];
        if (u == GN_NOWHERE) {
            points->dark[i] = gn_dark_nowhere(&l, z);
            continue;
        }
        uint32_t found = gn_look(&l, u, points->v[i], gn_cut(z));
        gn_vote_is(points, i, found == GN_DARK ? PLACES : found, PLACES);
    }
}

/* A place moved by a distance, held in its cell. */
GN_INLINE uint32_t move(uint32_t place, int32_t distance, uint32_t bits)
{
    uint32_t first = place >> bits << bits, last = first + (((uint32_t)1 << bits) - 1);
    uint32_t to = place + (uint32_t)distance;
    if (distance < 0)
        return to - first > last - first ? first : to;
    return to - first > last - first ? last : to;
}

static uint32_t sample(const gn_lookup *l, gn_points *points, int32_t i, const gn_wide_plane *plane)
{
    uint32_t u = points->u[i], v = points->v[i], dark, shadowed = 0;
    if (!gn_disagree(l, points, i, plane, &dark))
        return dark ? PLACES : 0;
    int32_t across = 1 << (l->bits - 3), along = across / 3; /* 1/8 texel, and a third of it */
    const int32_t dx[PLACES] = {-along, across, along, -across}, dy[PLACES] = {-across, -along, across, along};
    for (int k = 0; k < PLACES; k++)
        shadowed += dark >> gn_find_quadrant(l, move(u, dx[k], l->bits), move(v, dy[k], l->bits)) & 1;
    return shadowed;
}

const gn_reconstruction gn_silhouettes_smooth = {
    gn_cascade_row, vote, sample, gn_colour_fractions, PLACES, 4, 4, gn_settle, &gn_draw_silhouettes};
