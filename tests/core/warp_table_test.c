/* Tables of warps, against what they are meant to be: positions against an exact twin that goes the other way, from
 * fine columns to texels, in 128 bits; importances, smoothing and bent lines against the definitions in long double.
 * Cases: 1000, fewer of slow ones, or GNOMON_CASES. */
#include "gn_fixed.h"
#include "gn_warp_table.h"
#include "tap.h"

#include <math.h>
#include <string.h>

/* The sources a second time, under other names: as a machine compiles them that does not divide 64 by 64 bits. */
#undef GN_WARP_TABLE_H
#undef GN_WIDE_DIVIDE
#define GN_WIDE_DIVIDE 0
#define gn_importance_of_counts small_importance_of_counts
#define gn_importance_of_distances small_importance_of_distances
#define gn_smooth_importance small_smooth_importance
#define gn_place_texels small_place_texels
#define gn_bend_lines small_bend_lines
#include "gn_warp_table.c"
#undef gn_importance_of_counts
#undef gn_importance_of_distances
#undef gn_smooth_importance
#undef gn_place_texels
#undef gn_bend_lines

__extension__ typedef __int128 exact;
typedef long double real;

enum { FINE = GN_FINE, GUARD = 0x5a5a };

static uint64_t random_state = 6, cases;

static uint32_t between(uint32_t low, uint32_t high)
{
    return low + (uint32_t)(tap_random(&random_state) % ((uint64_t)(high - low) + 1));
}

/* 1 to most, of every order, and often a power of two. */
static uint32_t random_size(uint32_t most)
{
    uint32_t order = (uint32_t)1 << between(0, 13), size = between(0, 1) ? order : between(1, order);
    return size < most ? size : most;
}

/* Kinds of what is given; each with any number of bins. */
enum { EVEN, ANY, ORDERS, SPARSE, ONE, HILL, EXTREME, KINDS };

static uint32_t random_value(uint32_t kind, uint32_t b, uint32_t bins, uint32_t most, uint32_t chosen)
{
    real x = ((real)b - chosen) / (1 + bins / 16);
    switch (kind) {
    case EVEN:
        return chosen % most + 1;
    case ANY:
        return between(0, most);
    case ORDERS:
        return between(0, most) >> between(0, 31);
    case SPARSE:
        return between(0, 15) ? 0 : between(0, most);
    case ONE:
        return b == chosen ? most : 0;
    case HILL:
        return (uint32_t)(most / (1 + x * x));
    default:
        return between(0, 1) ? most : 0;
    }
}

static void random_values(uint32_t *value, uint32_t bins, uint32_t most)
{
    uint32_t kind = between(0, KINDS - 1), chosen = between(0, bins - 1);
    for (uint32_t b = 0; b < bins; b++)
        value[b] = random_value(kind, b, bins, most, chosen);
}

/* ---- positions ------------------------------------------------------------------------------------------------- */

static uint16_t position[FINE + 1], other[FINE + 1];
static uint32_t value[FINE + 1], mirrored[FINE], scratch[2 * FINE + 1];

/* Strictly increasing and in range; the forward table, made by counting, takes each centre back to its texel. */
static int is_grid(const uint16_t *p, uint32_t texels)
{
    static uint16_t forward[FINE];
    uint32_t texel = 0;
    for (uint32_t i = 0; i < texels; i++)
        if (p[i] >= FINE || (i && p[i] <= p[i - 1])) {
            note("    texel %u of %u: position %u after %u; expected rising, below %d", i, texels, p[i],
                 i ? p[i - 1] : 0, FINE);
            return 0;
        }
    for (uint32_t column = 0; column < FINE; column++) {
        texel += column == p[texel];
        forward[column] = (uint16_t)(texel - 1);
        if (texel == texels)
            texel--;
    }
    for (uint32_t i = 0; i + 1 < texels; i++)
        if (forward[p[i]] != i || forward[p[i + 1] - 1] != i) {
            note("    texel %u of %u is not found back", i, texels);
            return 0;
        }
    return 1;
}

/* Texels that would share a column: half-way (down) between the greatest room up to there and the least from there on.
 */
static void twin_apart(uint16_t *p, uint32_t texels)
{
    static int32_t room[FINE], least[FINE];
    const int32_t most = (int32_t)(FINE - texels);
    int32_t greatest = 0;
    for (uint32_t i = texels; i--;) {
        room[i] = p[i] - (int32_t)i;
        room[i] = room[i] < 0 ? 0 : room[i] > most ? most : room[i];
        least[i] = i + 1 < texels && least[i + 1] < room[i] ? least[i + 1] : room[i];
    }
    for (uint32_t i = 0; i < texels; i++) {
        greatest = room[i] > greatest ? room[i] : greatest;
        p[i] = (uint16_t)((greatest + least[i]) / 2 + (int32_t)i);
    }
}

/* The last column whose left end has no more than (i + 1/2) / texels of the sum to its left. */
static void twin_place(uint16_t *p, uint32_t texels, const uint32_t *v, uint32_t bins)
{
    uint64_t total = 0, below = 0;
    uint32_t column = 0, bin = 0;
    for (uint32_t b = 0; b < bins; b++)
        total += v[b];
    for (uint32_t i = 0; i < texels; i++) {
        for (; column < FINE; column++) {
            /* The running sum at column / FINE, times FINE. */
            for (; bin < column * bins / FINE; bin++)
                below += v[bin];
            exact sum = (exact)below * FINE + (exact)(column * bins % FINE) * v[bin];
            if (total ? sum * 2 * texels > (exact)(2 * i + 1) * total * FINE
                      : (uint64_t)column * 2 * texels > (uint64_t)(2 * i + 1) * FINE)
                break;
        }
        p[i] = (uint16_t)(column - 1);
    }
    twin_apart(p, texels);
}

static int same_positions(const uint16_t *got, const uint16_t *expected, uint32_t texels, uint32_t within)
{
    for (uint32_t i = 0; i < texels; i++)
        if ((uint32_t)abs(got[i] - expected[i]) > within) {
            note("    texel %u of %u: got %u, expected %u within %u", i, texels, got[i], expected[i], within);
            return 0;
        }
    return 1;
}

static int places(uint32_t texels, uint32_t bins)
{
    static uint16_t small[FINE];
    for (uint32_t i = 0; i <= FINE; i++)
        position[i] = GUARD;
    gn_place_texels(position, texels, value, bins);
    small_place_texels(small, texels, value, bins);
    twin_place(other, texels, value, bins);
    return position[texels] == GUARD && is_grid(position, texels) && same_positions(position, other, texels, 0) &&
           same_positions(small, other, texels, 0);
}

static void positions_are_the_inverse_to_the_column(void)
{
    uint64_t failed = 0, moved = 0;
    for (uint64_t n = 0; n < cases && failed < 10; n++) {
        uint32_t bins = random_size(FINE), texels = random_size(FINE);
        random_values(value, bins, between(0, 1) ? UINT32_MAX : between(1, 1000));
        if (!places(texels, bins)) {
            failed++;
            note("    case %llu: %u bins, %u texels", (unsigned long long)n, bins, texels);
        }
        for (uint32_t i = 0; i + 1 < texels; i++)
            moved += position[i + 1] == position[i] + 1;
    }
    ok(!failed && (moved || cases < 100), "positions_are_the_inverse_to_the_column");
}

static void degenerate_importances_give_a_grid(void)
{
    static const uint32_t sizes[] = {1, 2, 3, 64, 100, 1000, FINE - 1, FINE};
    unsigned failed = 0;
    for (unsigned s = 0; s < 8; s++)
        for (unsigned t = 0; t < 8; t++)
            for (unsigned kind = 0; kind < 6; kind++) {
                uint32_t bins = sizes[s];
                for (uint32_t b = 0; b < bins; b++)
                    value[b] = kind < 2 ? 0 : kind == 2 ? UINT32_MAX : kind == 3 ? b & 1 : 0;
                if (kind == 1)
                    value[0] = UINT32_MAX;
                if (kind == 4)
                    value[bins - 1] = 1;
                if (kind == 5)
                    value[bins / 2] = 65535;
                failed += !places(sizes[t], bins);
            }
    ok(!failed, "degenerate_importances_give_a_grid");
}

/* By hand: a bin that holds all, of a quarter of the columns, has four texels at 1/8, 3/8, 5/8, 7/8 of it; as many
 * texels as columns in it stand closely, without a gap; one texel is in its middle. */
static void one_bin_takes_all_texels(void)
{
    const uint32_t from = FINE / 2, width = FINE / 4;
    uint32_t failed = 0;
    memset(value, 0, sizeof value);
    value[2] = 7;
    gn_place_texels(position, 4, value, 4);
    for (uint32_t i = 0; i < 4; i++)
        failed += position[i] != from + (2 * i + 1) * width / 8;
    gn_place_texels(position, width, value, 4);
    for (uint32_t i = 0; i < width; i++)
        failed += position[i] != from + i;
    gn_place_texels(position, 1, value, 4);
    failed += position[0] != from + width / 2;
    /* Twice as many as there are columns: as many beyond its left end as beyond its right one. */
    value[2] = 0;
    value[1] = 7;
    gn_place_texels(position, 2 * width, value, 4);
    for (uint32_t i = 0; i < 2 * width; i++)
        failed += position[i] != width / 2 + i;
    ok(!failed, "one_bin_takes_all_texels");
}

/* Centres of a uniform map: column floor(FINE (i + 1/2) / texels). */
static void even_importance_is_the_identity(void)
{
    uint32_t failed = 0;
    for (uint32_t texels = 1; texels <= FINE; texels += texels < 70 ? 1 : between(1, 97)) {
        uint32_t bins = between(0, 1) ? texels : random_size(FINE), v = between(0, 2) ? between(1, UINT32_MAX) : 0;
        for (uint32_t b = 0; b < bins; b++)
            value[b] = v;
        if (between(0, 1)) {
            for (uint32_t b = 0; b < bins; b++)
                value[b] &= 0xffffff;
            gn_importance_of_counts(value, bins);
        }
        gn_place_texels(position, texels, value, bins);
        for (uint32_t i = 0; i < texels; i++)
            failed += position[i] != (i * 2 + 1) * FINE / (2 * texels);
    }
    ok(!failed, "even_importance_is_the_identity");
}

/* A column's mirror image is the column before it where a centre is at a column's end: 1. Nowhere a level sum, whose
 * right end is meant. */
static void mirrored_importance_gives_mirrored_positions(void)
{
    uint64_t failed = 0;
    for (uint64_t n = 0; n < cases && failed < 10; n++) {
        uint32_t bins = random_size(FINE), texels = random_size(FINE);
        random_values(value, bins, 65535);
        gn_importance_of_counts(value, bins);
        for (uint32_t b = 0; b < bins; b++)
            mirrored[bins - 1 - b] = value[b];
        gn_place_texels(position, texels, value, bins);
        gn_place_texels(other, texels, mirrored, bins);
        for (uint32_t i = 0; i < texels / 2; i++) {
            uint16_t swap = other[i];
            other[i] = other[texels - 1 - i];
            other[texels - 1 - i] = swap;
        }
        for (uint32_t i = 0; i < texels; i++)
            other[i] = (uint16_t)(FINE - 1 - other[i]);
        failed += !same_positions(other, position, texels, 1);
    }
    ok(!failed, "mirrored_importance_gives_mirrored_positions");
}

/* Centres are at unit steps of the running sum: a bin of k such steps has floor(k) or ceil(k) of them. Bins are of
 * whole columns, and texels need not move: even one bin's columns are enough for all. */
static void more_important_bins_have_more_texels(void)
{
    uint64_t failed = 0, compared = 0;
    for (uint64_t n = 0; n < cases && failed < 10; n++) {
        uint32_t bins = (uint32_t)1 << between(0, 7), texels = between(1, FINE / bins), held[128] = {0};
        random_values(value, bins, between(1, 65535));
        gn_place_texels(position, texels, value, bins);
        uint64_t total = 0;
        for (uint32_t b = 0; b < bins; b++)
            total += value[b];
        if (!total)
            continue;
        for (uint32_t i = 0; i < texels; i++)
            held[position[i] / (FINE / bins)]++;
        for (uint32_t b = 0; b < bins; b++) {
            uint64_t least = (uint64_t)texels * value[b] / total;
            failed += held[b] < least || held[b] > least + 1;
            for (uint32_t c = 0; c < bins; c++) {
                failed += value[b] >= value[c] && held[b] + 1 < held[c];
                compared += value[b] > value[c] && held[b] > held[c];
            }
        }
    }
    ok(!failed && (compared || cases < 100), "more_important_bins_have_more_texels");
}

/* ---- importance ------------------------------------------------------------------------------------------------ */

static void importance_of_counts_is_count_and_tenth_of_mean(void)
{
    uint64_t failed = 0;
    for (uint64_t n = 0; n < cases && failed < 10; n++) {
        uint32_t bins = random_size(FINE), most = 0;
        static real expected[FINE];
        real mean = 0;
        random_values(value, bins, between(0, 1) ? 1 << 24 : between(0, 1) ? UINT32_MAX : 3);
        value[bins] = GUARD;
        for (uint32_t b = 0; b < bins; b++)
            mean += (real)value[b] / bins;
        for (uint32_t b = 0; b < bins; b++) {
            expected[b] = value[b] + mean / 10;
            most = expected[b] > expected[most] ? b : most;
        }
        gn_importance_of_counts(value, bins);
        real scale = 10 * bins;
        while (expected[most] * scale >= 2147483648.0L)
            scale /= 2;
        failed += value[bins] != GUARD;
        for (uint32_t b = 0; b < bins; b++) {
            real cut = expected[b] * scale - value[b];
            failed += cut < -1e-6L || cut >= 1 + 1e-6L || (scale == 10 * bins && cut > 1e-6L);
        }
    }
    ok(!failed, "importance_of_counts_is_count_and_tenth_of_mean");
}

static void importance_of_distances_is_nearest_over_distance(void)
{
    static const uint32_t by_hand[4] = {100, 400, UINT32_MAX, 200};
    const real one = (real)(1 << 30);
    uint64_t failed = 0;
    memcpy(value, by_hand, sizeof by_hand);
    gn_importance_of_distances(value, 4);
    /* 1, 1/4, 0, 1/2: mean 7/16 */
    for (int b = 0; b < 4; b++)
        failed += fabsl(value[b] / one - ((b == 2 ? 0 : 100.0L / by_hand[b]) + 7 / 1600.0L)) > 1 / one;

    for (uint64_t n = 0; n < cases && failed < 10; n++) {
        uint32_t bins = random_size(FINE), nearest = UINT32_MAX, none = 0;
        static real expected[FINE];
        real mean = 0;
        random_values(value, bins, between(0, 1) ? UINT32_MAX - 1 : 1 << 20);
        value[bins] = GUARD;
        for (uint32_t b = 0; b < bins; b++) {
            if (!between(0, 3) || n % 16 == 0)
                value[b] = UINT32_MAX;
            else if (!value[b])
                value[b] = 1;
            none += value[b] == UINT32_MAX;
            nearest = value[b] < nearest ? value[b] : nearest;
        }
        for (uint32_t b = 0; b < bins; b++) {
            expected[b] = value[b] == UINT32_MAX ? 0 : (real)nearest / value[b];
            mean += expected[b] / bins;
        }
        gn_importance_of_distances(value, bins);
        failed += value[bins] != GUARD;
        for (uint32_t b = 0; b < bins; b++) {
            failed += none == bins && value[b];
            /* Rounded, as is 1/100 of the mean of rounded ones. */
            failed += fabsl(value[b] - (expected[b] + mean / 100) * one) > 1 + 0.005L + 1e-6L;
        }
    }
    /* At the eye: as near as can be told. */
    value[0] = 0;
    value[1] = 2;
    gn_importance_of_distances(value, 2);
    failed += fabsl(value[1] / one - (0.5L + 0.0075L)) > 1 / one;
    ok(!failed, "importance_of_distances_is_nearest_over_distance");
}

/* ---- smoothing ------------------------------------------------------------------------------------------------- */

/* Weights of the table are those of exp within h^2 / 8 for the chord (h = 1/16, second derivative 1) and 2.5 / 65535
 * for roundings and a distance that is cut; what that can move the mean by depends on the values' range. */
static void smoothing_is_a_gaussian(void)
{
    static uint32_t before[FINE];
    uint64_t failed = 0, changed = 0;
    for (uint64_t n = 0; n < cases / 4 && failed < 10; n++) {
        uint32_t count = random_size(n % 16 ? 256 : FINE);
        gn_q16_16 smoothing = (gn_q16_16)(between(0, 3) ? between(1, 8 << 16) : between(0, INT32_MAX));
        real sigma = (real)smoothing / 65536 * count / 64;
        random_values(value, count, between(0, 1) ? UINT32_MAX : 1 << 20);
        memcpy(before, value, count * sizeof *value);
        value[count] = GUARD;
        scratch[2 * count] = GUARD;
        gn_smooth_importance(value, count, smoothing, scratch);
        failed += value[count] != GUARD || scratch[2 * count] != GUARD;
        if (sigma < 0.25L) {
            failed += memcmp(before, value, count * sizeof *value) != 0;
            continue;
        }
        real scale = 1;
        uint32_t most = 0;
        for (uint32_t b = 0; b < count; b++)
            most = before[b] > most ? before[b] : most;
        while (most && most * scale * 2 <= UINT32_MAX)
            scale *= 2;
        sigma = floorl(sigma * 65536) / 65536;
        sigma = sigma < 65536 ? sigma : 65536 - 1 / 65536.0L;
        /* Some of the places: it is slow. */
        for (uint32_t at = between(0, 7); at < count; at += count < 300 ? 1 : 97) {
            real sum = 0, weights = 0;
            uint32_t used = 0, low = UINT32_MAX, high = 0;
            for (uint32_t b = 0; b < count; b++) {
                real d = (real)b - at, w = expl(-d * d / (2 * sigma * sigma));
                if (fabsl(d) > 3 * sigma)
                    continue;
                sum += w * before[b];
                weights += w;
                used++;
                low = before[b] < low ? before[b] : low;
                high = before[b] > high ? before[b] : high;
            }
            real bound = (1 / 2048.0L + 2.5L / 65535) * used * (high - low) * scale / weights + 0.5L + 1e-6L;
            real error = fabsl(value[at] - sum * scale / weights);
            changed += value[at] != before[at] * scale;
            if (error > bound) {
                failed++;
                note("    case %llu, bin %u of %u, sigma %.3Lf: got %u, expected %.1Lf within %.1Lf",
                     (unsigned long long)n, at, count, sigma, value[at], sum * scale / weights, bound);
            }
        }
    }
    ok(!failed && (changed || cases < 100), "smoothing_is_a_gaussian");
}

static void smoothing_keeps_what_is_even_and_mirrors(void)
{
    uint64_t failed = 0;
    for (uint64_t n = 0; n < cases / 4 && failed < 10; n++) {
        uint32_t count = random_size(512), even = between(0, UINT32_MAX) | 0x80000000u;
        gn_q16_16 smoothing = (gn_q16_16)between(1, 32768) * 128;
        for (uint32_t b = 0; b < count; b++)
            value[b] = even;
        gn_smooth_importance(value, count, smoothing, scratch);
        for (uint32_t b = 0; b < count; b++)
            failed += value[b] != even;

        random_values(value, count, UINT32_MAX);
        for (uint32_t b = 0; b < count; b++)
            mirrored[count - 1 - b] = value[b];
        gn_smooth_importance(value, count, smoothing, scratch);
        gn_smooth_importance(mirrored, count, smoothing, scratch);
        for (uint32_t b = 0; b < count; b++)
            failed += mirrored[count - 1 - b] != value[b];
    }
    value[0] = 5, value[1] = 0;
    gn_smooth_importance(value, 2, 0, scratch);
    gn_smooth_importance(value, 2, -65536, scratch);
    failed += value[0] != 5 || value[1] != 0;
    ok(!failed, "smoothing_keeps_what_is_even_and_mirrors");
}

/* ---- bent lines ------------------------------------------------------------------------------------------------ */

enum { CELLS = 64 * FINE };

static uint16_t count_of[CELLS], bent[CELLS + 1], expected_of[CELLS];
static uint32_t sums[2 * FINE + 1];

/* The paper's way: every line's own offset to the identity, its mean over lines, the inverse of identity + offset.
 * Ends of bins: offset_of[line * (bins + 1) + b]. */
static void twin_bend(uint32_t texels, uint32_t lines, uint32_t bins, real smoothing)
{
    static real offset_of[2 * CELLS], samples[FINE], g[FINE + 1];
    int32_t reach = smoothing * lines / 32 < lines ? (int32_t)floorl(smoothing * lines / 32) : (int32_t)lines;
    for (uint32_t line = 0; line < lines; line++) {
        real *offset = offset_of + line * (bins + 1), sum = 0;
        samples[line] = 0;
        for (uint32_t b = 0; b < bins; b++)
            samples[line] += count_of[line * bins + b];
        for (uint32_t b = 0; b <= bins; b++) {
            offset[b] = samples[line] > 0 ? sum / (samples[line] * 1.1L) - (real)b / bins : 0;
            sum += b < bins ? count_of[line * bins + b] + samples[line] / bins / 10 : 0;
        }
    }
    for (int32_t line = 0; line < (int32_t)lines; line++) {
        real weights = 0;
        memset(g, 0, sizeof g);
        for (int32_t l = line - reach; l <= line + reach; l++)
            if (l >= 0 && l < (int32_t)lines && samples[l] > 0) {
                weights += samples[l];
                for (uint32_t b = 0; b <= bins; b++)
                    g[b] += samples[l] * offset_of[l * (int32_t)(bins + 1) + (int32_t)b];
            }
        for (uint32_t b = 0; b <= bins; b++)
            g[b] = (weights > 0 ? g[b] / weights : 0) + (real)b / bins;
        uint16_t *p = expected_of + (uint32_t)line * texels;
        for (uint32_t i = 0, b = 0; i < texels; i++) {
            real target = (i + 0.5L) / texels;
            while (b < bins - 1 && g[b + 1] <= target)
                b++;
            p[i] = (uint16_t)fminl(FINE - 1, floorl(FINE * (b + (target - g[b]) / (g[b + 1] - g[b])) / bins));
        }
        twin_apart(p, texels);
    }
}

static int bends(uint32_t texels, uint32_t lines, uint32_t bins, gn_q16_16 smoothing)
{
    bent[lines * texels] = sums[2 * bins] = GUARD;
    gn_bend_lines(bent, texels, count_of, lines, bins, smoothing, sums);
    if (bent[lines * texels] != GUARD || sums[2 * bins] != GUARD) {
        note("    written beyond the end");
        return 0;
    }
    for (uint32_t line = 0; line < lines; line++)
        if (!is_grid(bent + line * texels, texels)) {
            note("    line %u of %u, %u bins, smoothing %ld / 65536", line, lines, bins, (long)smoothing);
            return 0;
        }
    return 1;
}

static void random_counts(uint32_t lines, uint32_t bins)
{
    uint32_t most = between(0, 2) ? between(1, 200) : 65535;
    for (uint32_t line = 0; line < lines; line++) {
        random_values(value, bins, most);
        uint32_t empty = !between(0, 2);
        for (uint32_t b = 0; b < bins; b++)
            count_of[line * bins + b] = empty ? 0 : (uint16_t)value[b];
    }
}

/* Off by one column where the two fall on different sides of a column's end: 64 bits here, 2^-30 of the largest
 * importance there. */
static void bent_lines_are_the_papers_mean_of_offsets(void)
{
    uint64_t failed = 0, texels_seen = 0, off = 0;
    for (uint64_t n = 0; n < cases / 8 && failed < 10; n++) {
        uint32_t lines = random_size(200), bins = random_size(n % 8 ? 200 : FINE), texels = random_size(200);
        bins = bins * lines > CELLS ? CELLS / lines : bins;
        gn_q16_16 smoothing = (gn_q16_16)(between(0, 3) ? between(0, 4 << 16) : between(0, INT32_MAX));
        random_counts(lines, bins);
        failed += !bends(texels, lines, bins, smoothing);
        twin_bend(texels, lines, bins, (real)smoothing / 65536);
        if (!same_positions(bent, expected_of, lines * texels, 1)) {
            failed++;
            note("    case %llu: %u lines, %u bins, %u texels, smoothing %ld / 65536", (unsigned long long)n, lines,
                 bins, texels, (long)smoothing);
        }
        texels_seen += lines * texels;
        for (uint32_t i = 0; i < lines * texels; i++)
            off += bent[i] != expected_of[i];
    }
    note("%llu of %llu texels off by one column", (unsigned long long)off, (unsigned long long)texels_seen);
    ok(!failed && off * 1000 <= texels_seen, "bent_lines_are_the_papers_mean_of_offsets");
}

/* "In extreme case, our solution converts to the RTW algorithm" (4.1). */
static void all_lines_in_reach_are_the_rectilinear_warp(void)
{
    uint64_t failed = 0;
    for (uint64_t n = 0; n < cases / 8 && failed < 10; n++) {
        uint32_t lines = random_size(200), bins = random_size(200), texels = random_size(200);
        random_counts(lines, bins);
        failed += !bends(texels, lines, bins, 32 << 16);
        memset(value, 0, sizeof value);
        for (uint32_t i = 0; i < lines * bins; i++)
            value[i % bins] += count_of[i];
        gn_importance_of_counts(value, bins);
        gn_place_texels(position, texels, value, bins);
        for (uint32_t line = 0; line < lines; line++)
            failed += !same_positions(bent + line * texels, position, texels, 0);
    }
    ok(!failed, "all_lines_in_reach_are_the_rectilinear_warp");
}

/* One line has samples: lines up to 64 / 32 away from it, times smoothing, have its function, all others are even. */
static void lines_out_of_reach_are_even(void)
{
    enum { N = 64 };
    static const struct {
        uint32_t reach;
        gn_q16_16 smoothing;
    } by_hand[] = {{0, 0}, {0, -65536}, {0, 0x7fff}, {1, 0x8000}, {2, 0x10000}, {3, 0x18000}, {20, 10 << 16}};
    uint32_t failed = 0;
    for (unsigned c = 0; c < sizeof by_hand / sizeof *by_hand; c++)
        for (uint32_t line = 0; line < N; line++) {
            memset(count_of, 0, sizeof count_of);
            count_of[line * N + 5] = 65535;
            failed += !bends(N, N, N, by_hand[c].smoothing);
            for (uint32_t l = 0; l < N; l++) {
                uint32_t away = l > line ? l - line : line - l, even = 1;
                for (uint32_t i = 0; i < N; i++)
                    even &= bent[l * N + i] == (2 * i + 1) * FINE / (2 * N);
                failed += even != (away > by_hand[c].reach);
            }
        }
    ok(!failed, "lines_out_of_reach_are_even");
}

static void degenerate_counts_give_a_grid(void)
{
    unsigned failed = 0;
    static const uint32_t shapes[][3] = {{1, 1, 1}, {1, FINE, FINE}, {64, 64, FINE}, {64, FINE, 64},
                                         {3, 7, 5}, {200, 2, 2},     {FINE, 64, 64}, {FINE, 1, 1}};
    for (unsigned s = 0; s < sizeof shapes / sizeof *shapes; s++)
        for (unsigned kind = 0; kind < 6; kind++)
            for (gn_q16_16 smoothing = 0; smoothing <= 32 << 16; smoothing = 4 * smoothing + 0x4000) {
                uint32_t lines = shapes[s][0], bins = shapes[s][1], texels = shapes[s][2];
                for (uint32_t l = 0; l < lines; l++)
                    for (uint32_t b = 0; b < bins; b++) {
                        uint16_t *c = count_of + l * bins + b;
                        *c = kind == 1 || (kind == 2 && b == 0) || (kind == 3 && b == bins - 1) ? 65535 : 0;
                        if (kind == 4 && l == lines / 2 && b == bins / 2)
                            *c = 1;
                        if (kind == 5 && l % 2 && b % 2)
                            *c = 65535;
                    }
                failed += !bends(texels, lines, bins, smoothing);
                if (kind <= 1)
                    for (uint32_t i = 0; i < lines * texels; i++)
                        failed += bent[i] != (2 * (i % texels) + 1) * FINE / (2 * texels);
            }
    ok(!failed, "degenerate_counts_give_a_grid");
}

int main(int argc, char **argv)
{
    cases = tap_cases(argc, argv, 1000);
    positions_are_the_inverse_to_the_column();
    degenerate_importances_give_a_grid();
    one_bin_takes_all_texels();
    even_importance_is_the_identity();
    mirrored_importance_gives_mirrored_positions();
    more_important_bins_have_more_texels();
    importance_of_counts_is_count_and_tenth_of_mean();
    importance_of_distances_is_nearest_over_distance();
    smoothing_is_a_gaussian();
    smoothing_keeps_what_is_even_and_mirrors();
    bent_lines_are_the_papers_mean_of_offsets();
    all_lines_in_reach_are_the_rectilinear_warp();
    lines_out_of_reach_are_even();
    degenerate_counts_give_a_grid();
    return tap_done();
}
