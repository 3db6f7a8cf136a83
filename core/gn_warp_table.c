/* See gn_warp_table.h. */
#include "gn_warp_table.h"
#include "gn_fixed.h"

/* ---- importance ------------------------------------------------------------------------------------------------ */

/* (c + total / (10 bins)) times 10 bins: below 2^49. to may be count. */
static void weigh_counts(uint32_t *to, const uint32_t *count, uint32_t bins)
{
    uint64_t total = 0;
    uint32_t most = 0;
    for (uint32_t b = 0; b < bins; b++) {
        total += count[b];
        most = count[b] > most ? count[b] : most;
    }
    uint32_t high = (uint32_t)((gn_multiply_u(most, 10 * bins) + total) >> 31);
    unsigned shift = high ? 32 - gn_leading_zeros(high) : 0;
    for (uint32_t b = 0; b < bins; b++)
        to[b] = (uint32_t)((gn_multiply_u(count[b], 10 * bins) + total) >> shift);
}

void gn_importance_of_counts(uint32_t *value, uint32_t bins)
{
    GN_ASSERT(bins && bins <= GN_FINE);
    weigh_counts(value, value, bins);
}

void gn_importance_of_distances(uint32_t *value, uint32_t bins)
{
    uint64_t total = 0;
    uint32_t nearest = UINT32_MAX;
    GN_ASSERT(bins && bins <= GN_FINE);
    for (uint32_t b = 0; b < bins; b++) {
        value[b] += !value[b]; /* at the eye: as near as can be told */
        nearest = value[b] < nearest ? value[b] : nearest;
    }
    for (uint32_t b = 0; b < bins; b++) {
        value[b] = value[b] == UINT32_MAX ? 0 : gn_divide(((uint64_t)nearest << 30) + value[b] / 2, value[b]);
        total += value[b];
    }
    uint32_t floor_value = gn_divide(total + 50 * bins, 100 * bins);
    for (uint32_t b = 0; b < bins; b++)
        value[b] += floor_value;
}

/* ---- smoothing ------------------------------------------------------------------------------------------------- */

/* exp(-x^2 / 2) at x = k / 16, times 2^16 - 1; the last only for what lies between it and x = 3. */
static const uint16_t gaussian[3 * 16 + 2] = {65535, 65407, 65025, 64393, 63519, 62412, 61085, 59554, 57834, 55946,
                                              53908, 51741, 49468, 47111, 44691, 42230, 39749, 37268, 34805, 32379,
                                              30004, 27695, 25464, 23322, 21276, 19334, 17501, 15780, 14173, 12680,
                                              11300, 10031, 8869,  7812,  6854,  5989,  5214,  4521,  3905,  3360,
                                              2879,  2458,  2090,  1770,  1494,  1255,  1051,  876,   728,   602};

/* sigma: 16 fraction bits. distance <= 3 sigma. */
static uint32_t weight_at(uint32_t distance, uint32_t sigma)
{
    uint32_t x = gn_divide((uint64_t)distance << 28, sigma), k = x >> 8; /* sixteenths, 8 fraction bits */
    return gaussian[k] - (((uint32_t)(gaussian[k] - gaussian[k + 1]) * (x & 255)) >> 8);
}

/* The ends are met here alone. Sums stay below 2^62: at most 2^14 weights of 16 bits. */
static uint32_t smoothed_at(const uint32_t *value, uint32_t count, uint32_t at, const uint32_t *weight, uint32_t radius)
{
    uint64_t sum = gn_multiply_u(value[at], weight[0]);
    uint32_t weights = weight[0];
    for (uint32_t d = 1; d <= radius; d++) {
        if (d <= at) {
            sum += gn_multiply_u(value[at - d], weight[d]);
            weights += weight[d];
        }
        if (d < count - at) {
            sum += gn_multiply_u(value[at + d], weight[d]);
            weights += weight[d];
        }
    }
    return gn_divide(sum + weights / 2, weights);
}

void gn_smooth_importance(uint32_t *value, uint32_t count, gn_q16_16 smoothing, uint32_t *scratch)
{
    GN_ASSERT(count && count <= GN_FINE);
    if (smoothing <= 0)
        return;
    uint64_t wide = gn_multiply_u((uint32_t)smoothing, count) >> 6;
    uint32_t sigma = wide > UINT32_MAX ? UINT32_MAX : (uint32_t)wide;
    uint32_t radius = (uint32_t)(gn_multiply_u(sigma, 3) >> 16);
    if (sigma < 1 << 14)
        return;
    radius = radius < count ? radius : count - 1;
    uint32_t *weight = scratch + count;
    uint32_t all = 0;
    for (uint32_t at = 0; at < count; at++)
        all |= value[at];
    unsigned shift = all ? gn_leading_zeros(all) : 0;
    for (uint32_t at = 0; at < count; at++)
        scratch[at] = value[at] << shift;
    for (uint32_t d = 0; d <= radius; d++)
        weight[d] = weight_at(d, sigma);
    for (uint32_t at = 0; at < count; at++)
        value[at] = smoothed_at(scratch, count, at, weight, radius);
}

/* ---- the inverse of the running sum ---------------------------------------------------------------------------- */

/* All sums are times twice the number of texels: below 2^46 a bin, 2^59 in all. */
typedef struct inverse {
    const uint32_t *importance;
    uint32_t bin, scale;
    uint32_t columns, bins; /* as GN_FINE : bins, without a common factor of 2^n */
    uint64_t step, target;  /* of a texel; of the next texel's centre */
    uint64_t below, rise;   /* running sum at the left end of the bin; what the bin adds */
} inverse;

static void start_inverse(inverse *s, const uint32_t *importance, uint32_t bins, uint32_t texels, uint64_t total)
{
    s->importance = importance;
    s->bin = 0;
    s->scale = 2 * texels;
    s->columns = GN_FINE;
    s->bins = bins;
    for (; !((s->columns | s->bins) & 1); s->columns >>= 1)
        s->bins >>= 1;
    s->step = 2 * total;
    s->target = total;
    s->below = 0;
    s->rise = gn_multiply_u(importance[0], s->scale);
}

/* floor(n / d), below 2^14: n < 2^60, d < 2^59. */
#if GN_WIDE_DIVIDE
GN_INLINE uint32_t short_quotient(uint64_t n, uint64_t d)
{
    return (uint32_t)(n / d);
}
#else
static uint32_t short_quotient(uint64_t n, uint64_t d)
{
    uint32_t quotient = 0, bit = 1;
    if (!(n >> 32))
        return d >> 32 ? 0 : (uint32_t)n / (uint32_t)d;
    for (; d << 1 <= n; d <<= 1)
        bit <<= 1;
    for (; bit; bit >>= 1, d >>= 1)
        if (n >= d) {
            n -= d;
            quotient |= bit;
        }
    return quotient;
}
#endif

/* floor(GN_FINE x) for the largest x, 0 <= x < 1, where the running sum is not above the texel's:
 * GN_FINE / bins (bin + (target - below) / rise), whole columns left of the bin first. */
static uint32_t next_place(inverse *s)
{
    while (s->target - s->below >= s->rise) {
        s->below += s->rise;
        s->rise = gn_multiply_u(s->importance[++s->bin], s->scale);
    }
    uint32_t left = s->bin * s->columns, whole = left / s->bins;
    uint64_t rest = (left - whole * s->bins) * s->rise + (s->target - s->below) * s->columns;
    s->target += s->step;
    return whole + short_quotient(rest, s->bins * s->rise);
}

/* Columns left of a texel that no texel has taken if those before it stand closely packed. Strictly increasing
 * positions are room that never falls. */
static uint32_t next_room(inverse *s, uint32_t texel, uint32_t most)
{
    uint32_t place = next_place(s), room = place > texel ? place - texel : 0;
    return room < most ? room : most;
}

void gn_place_texels(uint16_t *position, uint32_t texels, const uint32_t *importance, uint32_t bins)
{
    inverse s;
    uint64_t total = 0;
    uint32_t most = GN_FINE - texels, room = 0, falls = 0;
    GN_ASSERT(texels && texels <= GN_FINE && bins && bins <= GN_FINE);
    for (uint32_t b = 0; b < bins; b++)
        total += importance[b];
    if (!total) {
        for (uint32_t i = 0; i < texels; i++)
            position[i] = (uint16_t)((2 * i + 1) * GN_FINE / (2 * texels));
        return;
    }

    start_inverse(&s, importance, bins, texels, total);
    for (uint32_t i = 0; i < texels; i++) {
        uint32_t next = next_room(&s, i, most);
        falls |= next < room;
        room = next;
        position[i] = (uint16_t)room;
    }
    if (falls) {
        /* Half-way between what never falls and is nowhere less, and what never falls and is nowhere more: the same
         * from the left and from the right. The first is made anew, texel by texel. */
        for (uint32_t i = texels - 1; i--;)
            position[i] = position[i] < position[i + 1] ? position[i] : position[i + 1];
        start_inverse(&s, importance, bins, texels, total);
        room = 0;
        for (uint32_t i = 0; i < texels; i++) {
            uint32_t next = next_room(&s, i, most);
            room = next > room ? next : room;
            position[i] = (uint16_t)((position[i] + room) / 2);
        }
    }
    for (uint32_t i = 0; i < texels; i++)
        position[i] = (uint16_t)(position[i] + i);
}

/* ---- a function for each line ---------------------------------------------------------------------------------- */

/* Offsets o = g / N - x (paper, equation 4) of lines that are weighted by their numbers of samples N have the mean
 * sum(g) / sum(N) - x: that of the sum of their counts. The tenth of a line's mean that is added to each bin sums up
 * the same way. So counts are summed over neighbours, and the result is monotone as it is. */
void gn_bend_lines(uint16_t *position, uint32_t texels, const uint16_t *count, uint32_t lines, uint32_t bins,
                   gn_q16_16 smoothing, uint32_t *sums)
{
    uint32_t *importance = sums + bins; /* sums: below 2^29 */
    GN_ASSERT(lines && lines <= GN_FINE && bins && bins <= GN_FINE);
    uint64_t wide = gn_multiply_u(smoothing > 0 ? (uint32_t)smoothing : 0, lines) >> 21;
    uint32_t reach = wide < lines ? (uint32_t)wide : lines;
    for (uint32_t b = 0; b < bins; b++)
        sums[b] = 0;
    /* `line` comes into reach of the line `reach` before it. */
    for (uint32_t line = 0; line < lines + reach; line++) {
        if (line < lines)
            for (uint32_t b = 0; b < bins; b++)
                sums[b] += count[line * bins + b];
        if (line > 2 * reach)
            for (uint32_t b = 0; b < bins; b++)
                sums[b] -= count[(line - 2 * reach - 1) * bins + b];
        if (line >= reach) {
            weigh_counts(importance, sums, bins);
            gn_place_texels(position + (line - reach) * texels, texels, importance, bins);
        }
    }
}
