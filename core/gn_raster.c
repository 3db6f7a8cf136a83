/* Triangle set-up: the gradients of a plane from one reciprocal of its area. */
#include "gn_raster.h"

/* v = mantissa 2^(32 - shift), the mantissa's top bit set; v != 0, v < 2^63. */
typedef struct normalised {
    uint32_t mantissa;
    int32_t shift;
} normalised;

GN_INLINE normalised normalise(uint64_t v)
{
    uint32_t high = (uint32_t)(v >> 32), low = (uint32_t)v;
    normalised n;
    if (high) {
        unsigned zeros = gn_leading_zeros(high); /* at least 1 */
        n.mantissa = (high << zeros) | (low >> (32 - zeros));
        n.shift = (int32_t)zeros;
    } else {
        unsigned zeros = gn_leading_zeros(low);
        n.mantissa = low << zeros;
        n.shift = 32 + (int32_t)zeros;
    }
    return n;
}

GN_INLINE uint64_t magnitude(int64_t v)
{
    return v < 0 ? 0u - (uint64_t)v : (uint64_t)v;
}

/* |n| / area = result 2^(*shift), result in [2^30, 2^32) or 0: three truncations, relative error below 2^-29. */
GN_INLINE uint32_t quotient(int64_t n, uint32_t reciprocal, int32_t area_shift, int32_t *shift)
{
    if (n == 0) {
        *shift = 0;
        return 0;
    }
    normalised v = normalise(magnitude(n));
    *shift = area_shift - v.shift - 31;
    return (uint32_t)(gn_multiply_u(v.mantissa, reciprocal) >> 32);
}

/* The numerators of the two gradients and the reciprocal of the area. */
typedef struct slopes {
    int64_t nx, ny;
    uint32_t reciprocal;
    int32_t area_shift;
} slopes;

GN_INLINE slopes make_slopes(const gn_vertex *v0, const gn_vertex *v1, const gn_vertex *v2, int64_t area)
{
    int32_t dx1 = v1->x - v0->x, dy1 = v1->y - v0->y, dz1 = (int32_t)(v1->depth - v0->depth);
    int32_t dx2 = v2->x - v0->x, dy2 = v2->y - v0->y, dz2 = (int32_t)(v2->depth - v0->depth);
    slopes s;
    s.nx = gn_multiply(dz1, dy2) + gn_multiply(-dz2, dy1);
    s.ny = gn_multiply(dz2, dx1) + gn_multiply(-dz1, dx2);
    normalised a = normalise(magnitude(area));
    s.reciprocal = gn_reciprocal_exact(a.mantissa);
    s.area_shift = a.shift;
    return s;
}

/* Where time matters less than flash. */
static GN_COLD void find_slopes(slopes *s, const gn_vertex *v0, const gn_vertex *v1, const gn_vertex *v2, int64_t area)
{
    *s = make_slopes(v0, v1, v2, area);
}

/* round(512 |n| / A) with n's sign; 0 and *steep where that reaches 2^30. */
GN_INLINE uint32_t depth_gradient(int64_t n, const slopes *s, int *steep)
{
    int32_t shift;
    uint32_t q = quotient(n, s->reciprocal, s->area_shift, &shift);
    int32_t right = -9 - shift;
    if (q == 0 || right > 32)
        return 0;
    if (right < 1) {
        *steep = 1;
        return 0;
    }
    uint32_t g = ((q >> (right - 1)) + 1) >> 1;
    if (g >> 30)
        *steep = 1;
    return n < 0 ? 0u - g : g;
}

static uint32_t farthest_depth(const gn_vertex *v0, const gn_vertex *v1, const gn_vertex *v2)
{
    uint32_t farthest = v0->depth;
    farthest = v1->depth > farthest ? v1->depth : farthest;
    return v2->depth > farthest ? v2->depth : farthest;
}

int gn_make_depth_plane(gn_depth_plane *plane, const gn_vertex *v0, const gn_vertex *v1, const gn_vertex *v2,
                        int64_t area)
{
    slopes s = make_slopes(v0, v1, v2, area);
    int steep = 0;
    uint32_t gx = depth_gradient(s.nx, &s, &steep), gy = depth_gradient(s.ny, &s, &steep);
    if (GN_UNLIKELY(steep)) {
        plane->base = 2 * farthest_depth(v0, v1, v2);
        plane->dx = plane->dy = 0;
        return 1;
    }
    plane->base = 2 * v0->depth + (uint32_t)gn_rise_from(v0, (int32_t)gx, (int32_t)gy);
    plane->dx = gx;
    plane->dy = gy;
    return 0;
}

/* round(512 |n| / A) with n's sign; *sheer where that may reach 2^40. */
static GN_COLD int64_t steep_gradient(int64_t n, const slopes *s, int *sheer)
{
    int32_t shift;
    uint64_t q = quotient(n, s->reciprocal, s->area_shift, &shift);
    int32_t left = shift + 9;
    if (q == 0 || left < -32)
        return 0;
    if (left > 8) {
        *sheer = 1;
        return 0;
    }
    q = left < 0 ? ((q >> (-left - 1)) + 1) >> 1 : q << left;
    return n < 0 ? -(int64_t)q : (int64_t)q;
}

GN_COLD int gn_make_steep_plane(gn_wide_plane *plane, const gn_vertex *v0, const gn_vertex *v1, const gn_vertex *v2,
                                int64_t area)
{
    slopes s;
    find_slopes(&s, v0, v1, v2, area);
    int sheer = 0;
    plane->dx = steep_gradient(s.nx, &s, &sheer);
    plane->dy = steep_gradient(s.ny, &s, &sheer);
    if (sheer) {
        plane->base = 2 * (int64_t)farthest_depth(v0, v1, v2);
        plane->dx = plane->dy = 0;
        return 1;
    }
    int64_t shift = (128 - v0->x) * plane->dx + (128 - v0->y) * plane->dy;
    plane->base = 2 * (int64_t)v0->depth + gn_floor_shift_64(shift, 8);
    return 0;
}

/* round(512 2^k |n| / A) with n's sign, k <= 14; *sheer where that may reach 2^48. */
static GN_COLD int64_t far_gradient(int64_t n, const slopes *s, int32_t k, int *sheer)
{
    int32_t shift;
    uint64_t q = quotient(n, s->reciprocal, s->area_shift, &shift);
    int32_t left = shift + 9 + k;
    if (q == 0 || left < -32)
        return 0;
    if (left > 16) {
        *sheer = 1;
        return 0;
    }
    q = left < 0 ? ((q >> (-left - 1)) + 1) >> 1 : q << left;
    return n < 0 ? -(int64_t)q : (int64_t)q;
}

GN_COLD int gn_make_far_plane(gn_wide_plane *plane, const gn_vertex *v0, const gn_vertex *v1, const gn_vertex *v2,
                              int64_t area, uint32_t shift)
{
    slopes s;
    find_slopes(&s, v0, v1, v2, area);
    int sheer = 0;
    int32_t x = 128 - v0->x, y = 128 - v0->y;
    plane->dx = far_gradient(s.nx, &s, (int32_t)shift, &sheer);
    plane->dy = far_gradient(s.ny, &s, (int32_t)shift, &sheer);
    if (sheer) {
        plane->base = (int64_t)farthest_depth(v0, v1, v2) << (shift + 1);
        plane->dx = plane->dy = 0;
        return 1;
    }
    /* |x|, |y| < 2^21, and from the first centre to any other it is below 1.5 x 2^20: products below 2^61 */
    plane->base = ((int64_t)v0->depth << (shift + 1)) + x * gn_floor_shift_64(plane->dx, 8) +
                  y * gn_floor_shift_64(plane->dy, 8) +
                  gn_floor_shift_64(x * (plane->dx & 255) + y * (plane->dy & 255), 8);
    return 0;
}

/* floor(2^32 |n| / A) with n's sign: Q a 1/256 pixel, 32 fraction bits; *steep where that reaches 2^54. */
static GN_NOINLINE uint64_t q_gradient(int64_t n, const slopes *s, int *steep)
{
    int32_t shift;
    uint64_t q = quotient(n, s->reciprocal, s->area_shift, &shift);
    shift += 32;
    if (q == 0 || shift <= -32)
        return 0;
    if (shift > 31) {
        *steep = 1;
        return 0;
    }
    uint64_t g = shift < 0 ? q >> -shift : q << shift;
    if (g >> 54)
        *steep = 1;
    return n < 0 ? 0u - g : g;
}

void gn_make_q_plane(gn_q_plane *plane, const gn_vertex *v0, const gn_vertex *v1, const gn_vertex *v2, int64_t area)
{
    slopes s;
    find_slopes(&s, v0, v1, v2, area);
    int steep = 0;
    uint64_t gx = q_gradient(s.nx, &s, &steep), gy = q_gradient(s.ny, &s, &steep);
    if (GN_UNLIKELY(steep)) {
        uint32_t farthest = v0->depth;
        farthest = v1->depth < farthest ? v1->depth : farthest;
        farthest = v2->depth < farthest ? v2->depth : farthest;
        plane->base = (uint64_t)farthest << 32;
        plane->dx = plane->dy = 0;
        return;
    }
    plane->base =
        ((uint64_t)v0->depth << 32) + (uint64_t)(int64_t)(128 - v0->x) * gx + (uint64_t)(int64_t)(128 - v0->y) * gy;
    plane->dx = gx << 8;
    plane->dy = gy << 8;
}
