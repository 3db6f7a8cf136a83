#include "truth_wide.h"

#include <assert.h>
#include <math.h>

static void trim(wide *a)
{
    while (a->length && !a->limb[a->length - 1])
        a->length--;
    if (!a->length)
        a->sign = 0;
}

wide wide_of(int64_t number)
{
    wide a = {.sign = number < 0 ? -1 : number > 0, .length = 2};
    uint64_t magnitude = number < 0 ? 0 - (uint64_t)number : (uint64_t)number;
    a.limb[0] = (uint32_t)magnitude;
    a.limb[1] = (uint32_t)(magnitude >> 32);
    trim(&a);
    return a;
}

wide wide_negate(wide a)
{
    a.sign = -a.sign;
    return a;
}

static int compare_magnitudes(const wide *a, const wide *b)
{
    if (a->length != b->length)
        return a->length < b->length ? -1 : 1;
    for (int i = a->length - 1; i >= 0; i--)
        if (a->limb[i] != b->limb[i])
            return a->limb[i] < b->limb[i] ? -1 : 1;
    return 0;
}

int wide_compare(wide a, wide b)
{
    if (a.sign != b.sign)
        return a.sign < b.sign ? -1 : 1;
    return a.sign * compare_magnitudes(&a, &b);
}

/* a + b of one sign; a is the longer one. */
static wide add_magnitudes(const wide *a, const wide *b)
{
    wide sum = *a;
    uint64_t carry = 0;
    for (int i = 0; i < a->length; i++) {
        carry += (uint64_t)a->limb[i] + (i < b->length ? b->limb[i] : 0);
        sum.limb[i] = (uint32_t)carry;
        carry >>= 32;
    }
    if (carry) {
        assert(sum.length < WIDE_LIMBS);
        sum.limb[sum.length++] = (uint32_t)carry;
    }
    return sum;
}

/* |a| - |b| with a's sign, where |a| > |b|. */
static wide subtract_magnitudes(const wide *a, const wide *b)
{
    wide difference = *a;
    uint32_t borrow = 0;
    for (int i = 0; i < a->length; i++) {
        uint64_t subtrahend = (uint64_t)(i < b->length ? b->limb[i] : 0) + borrow;
        borrow = a->limb[i] < subtrahend;
        difference.limb[i] = (uint32_t)(a->limb[i] - subtrahend);
    }
    trim(&difference);
    return difference;
}

wide wide_add(wide a, wide b)
{
    if (!a.sign)
        return b;
    if (!b.sign)
        return a;
    if (a.sign == b.sign)
        return a.length >= b.length ? add_magnitudes(&a, &b) : add_magnitudes(&b, &a);
    int order = compare_magnitudes(&a, &b);
    if (order == 0)
        return wide_of(0);
    return order > 0 ? subtract_magnitudes(&a, &b) : subtract_magnitudes(&b, &a);
}

wide wide_subtract(wide a, wide b)
{
    return wide_add(a, wide_negate(b));
}

wide wide_multiply(wide a, wide b)
{
    uint32_t limb[2 * WIDE_LIMBS] = {0};
    wide product = {.sign = a.sign * b.sign, .length = a.length + b.length};
    for (int i = 0; i < a.length; i++) {
        uint64_t carry = 0;
        for (int k = 0; k < b.length; k++) {
            carry += (uint64_t)a.limb[i] * b.limb[k] + limb[i + k];
            limb[i + k] = (uint32_t)carry;
            carry >>= 32;
        }
        limb[i + b.length] = (uint32_t)carry;
    }
    while (product.length && !limb[product.length - 1])
        product.length--;
    assert(product.length <= WIDE_LIMBS);
    for (int i = 0; i < product.length; i++)
        product.limb[i] = limb[i];
    return product;
}

double wide_to_double(wide a)
{
    double value = 0;
    for (int i = a.length - 1, taken = 0; i >= 0 && taken < 4; i--, taken++)
        value += ldexp(a.limb[i], 32 * i);
    return a.sign * value;
}

wide wide_dot(const wide a[3], const wide b[3])
{
    wide xy = wide_add(wide_multiply(a[0], b[0]), wide_multiply(a[1], b[1]));
    return wide_add(xy, wide_multiply(a[2], b[2]));
}
