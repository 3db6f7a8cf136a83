/* Tables of warps: where the centres of a map's texels lie, so that there are many where the camera looks.
 *
 * What is important is summed up in bins of equal width across the map; the running sum, from 0 to 1, is the function
 * that warps the map's plane, linear within a bin. Texel i of n has its centre where that function is (i + 1/2) / n:
 * its inverse. Centres are those of fine columns (gn_grid.h).
 *
 * Rectilinear warp (Rosen, Rectilinear texture warping for fast adaptive shadow mapping, I3D 2012): one function for
 * all rows, one for all columns; an importance, gn_smooth_importance, gn_place_texels. Non-orthogonal warp (Milet,
 * Navratil & Zemcik, An improved non-orthogonal texture warping for better shadow rendering, WSCG 2015, section 3): a
 * function for each line, gn_bend_lines. Everything is exact but for roundings that are named. */
#ifndef GN_WARP_TABLE_H
#define GN_WARP_TABLE_H

#include "gn_grid.h"
#include "gnomon.h"

/* Numbers of samples -> importance c + 1/10 of their mean: a bin without samples is 11 times as wide as one of an even
 * map at most. Times 10 bins; where that is 2^31 or more, divided by 2^n and cut. bins <= GN_FINE. */
void gn_importance_of_counts(uint32_t *value, uint32_t bins);

/* Least distance of the samples in a bin, 0xffffffff: no sample -> importance nearest / distance (0: no sample) + 1/100
 * of the mean importance, in units of 2^-30, rounded; all 0 where there is no sample at all. bins <= GN_FINE. */
void gn_importance_of_distances(uint32_t *value, uint32_t bins);

/* Gaussian, sigma = smoothing count / 64 bins but less than 65536, cut beyond 3 sigma; weights are within 2^-11 of the
 * largest. What lies beyond the ends takes no part: the weights of the others sum up to 1. Below a quarter of a bin: as
 * it was; else times 2^n as well, so that the largest takes 32 bits. Cost: count * min(6 sigma, count). Memory:
 * scratch, 2 count. count <= GN_FINE. */
void gn_smooth_importance(uint32_t *value, uint32_t count, gn_q16_16 smoothing, uint32_t *scratch);

/* position[texel]: the fine column that contains the texel's centre, exactly; the right end of a gap where the running
 * sum is level. Where texels would share a column they move apart, evenly to both sides: strictly increasing, 0 to
 * GN_FINE - 1. An importance of 0 everywhere: evenly. Cost: bins + texels, twice if texels had to move.
 * 1 <= texels, bins <= GN_FINE. */
void gn_place_texels(uint16_t *position, uint32_t texels, const uint32_t *importance, uint32_t bins);

/* One half of the non-orthogonal warp: position[line * texels + texel], as of gn_place_texels, from the numbers of
 * samples count[line * bins + bin]. Each line has the mean function of the lines up to smoothing lines / 32 (cut to
 * whole lines) before and behind it, weighted by their numbers of samples; no sample in any of them: evenly.
 * Cost: lines * (bins + texels). Memory: sums, 2 bins. 1 <= lines, texels, bins <= GN_FINE. */
void gn_bend_lines(uint16_t *position, uint32_t texels, const uint16_t *count, uint32_t lines, uint32_t bins,
                   gn_q16_16 smoothing, uint32_t *sums);

#endif
