/* Reconstruction by a crossing map (gn_crossing_map.h).
 *
 * The place lies in a cell between four texels. Where two neighbours' comparisons differ, the border of the shadow
 * crosses the side between them, at the map's crossing, or half-way where the map has none. Two sides: the border is
 * the straight line between their crossings. All four: two texels of one diagonal are lit, and each is cut off by the
 * line between the crossings on its own sides; what is shadowed stays joined. Both cells of a side have the same
 * crossing on it: borders of shadows are continuous. What lies right of a line, or below it, has the line.
 *
 * The line test is exact. A corner of a shadow within a cell is cut off along the line between its two
 * crossings. Cost: only points on which texels disagree read the map, 3 bytes. */
#include "gn_crossing_map.h"
#include "gn_quadrants.h"

/* How a cell's sides are crossed: top and bottom from the left, left and right from above, in 1/16 texel. */
typedef struct sides {
    int32_t top, bottom, left, right;
} sides;

static int32_t crossing_at(const gn_lookup *l, uint32_t at, unsigned shift)
{
    uint32_t code = (uint32_t)l->silhouettes[at] >> shift & 15;
    return (int32_t)(code ? code : GN_HALF_WAY);
}

/* Is a place within the triangle that cuts off a corner (1 right, + 2 below)? x, y: of the place in the cell. */
static int cuts_off(const sides *s, uint32_t corner, int32_t x, int32_t y, int32_t one)
{
    int32_t across = corner & 2 ? s->bottom : s->top, down = corner & 1 ? s->right : s->left;
    if (corner & 1) {
        across = 16 - across;
        x = one - x;
    }
    if (corner & 2) {
        down = 16 - down;
        y = one - y;
    }
    return 16 * (x * down + y * across) < across * down * one + (corner != 0);
}

/* The texel (1 right, + 2 below) whose answer a place takes. */
static uint32_t find_texel(const gn_lookup *l, uint32_t u, uint32_t v, uint32_t dark)
{
    uint32_t width = l->last_column + 1, at = (v >> l->bits) * width + (u >> l->bits);
    int32_t one = (int32_t)1 << l->bits, x = (int32_t)u & (one - 1), y = (int32_t)v & (one - 1);
    sides s = {crossing_at(l, at, 0), crossing_at(l, at + width, 0), crossing_at(l, at, 4), crossing_at(l, at + 1, 4)};
    switch (dark) {
    case 3: /* left and right differ */
    case 12:
        return 16 * y < s.left * one + (s.right - s.left) * x ? 0 : 2;
    case 5: /* top and bottom */
    case 10:
        return 16 * x < s.top * one + (s.bottom - s.top) * y ? 0 : 1;
    case 6: /* lit: upper left and lower right */
        return cuts_off(&s, 0, x, y, one) ? 0 : cuts_off(&s, 3, x, y, one) ? 3 : 1;
    case 9: /* upper right and lower left */
        return cuts_off(&s, 1, x, y, one) ? 1 : cuts_off(&s, 2, x, y, one) ? 2 : 0;
    }
    /* one texel against three */
    uint32_t odd = dark == 1 || dark == 14 ? 0 : dark == 2 || dark == 13 ? 1 : dark == 4 || dark == 11 ? 2 : 3;
    return cuts_off(&s, odd, x, y, one) ? odd : 3 - odd;
}

static uint32_t sample(const gn_lookup *l, gn_points *points, int32_t i, const gn_wide_plane *plane)
{
    uint32_t dark;
    if (!gn_disagree(l, points, i, plane, &dark))
        return dark;
    return dark >> find_texel(l, points->u[i], points->v[i], dark) & 1 ? GN_DARK : 0;
}

const gn_reconstruction gn_crossings = {gn_cascade_row, gn_vote_around,    sample, gn_colour_row, GN_DARK, 4, 4,
                                        gn_settle,      &gn_draw_crossings};
