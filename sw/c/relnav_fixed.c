/* SPDX-License-Identifier: Apache-2.0 */
#include "relnav_fixed.h"

#include <string.h>

enum {
    FRACTION_BITS = 52, /* of binary64 */
    EXPONENT_BIAS = 1023,
    EXPONENT_MAX = 0x7FF,
    INPUT_BITS = 32,
    LEAST_BITS = 24, /* of a frame's largest value: binary32's own precision */
    WEIGHT_BITS = 16
};

#define INPUT_LIMIT (UINT64_C(1) << (INPUT_BITS - 1))
#define LEAST_WEIGHT 0x1p-900 /* 65535 / max, and what has to be divided by it later, would leave double's range */

/* What rounds to a normal, finite binary32: from half a step below 2^-126 to less than half a step beyond the largest. */
#define LEAST_FLOAT 0x1.fffffep-127
#define BEYOND_FLOAT 0x1.ffffffp+127

/** magnitude = mantissa * 2^exponent; mantissa < 2^53, normalised or that of a denormal. */
typedef struct {
    uint64_t mantissa;
    int exponent;
    int negative;
} parts;

/** Whether value is finite; then its parts. */
static int take_apart(double value, parts *of)
{
    uint64_t bits;
    int field;

    memcpy(&bits, &value, sizeof bits);
    field = (int)(bits >> FRACTION_BITS) & EXPONENT_MAX;
    of->negative = (bits >> 63) != 0;
    of->mantissa = bits & ((UINT64_C(1) << FRACTION_BITS) - 1);
    if (field != 0) {
        of->mantissa |= UINT64_C(1) << FRACTION_BITS;
    }
    of->exponent = (field != 0 ? field : 1) - EXPONENT_BIAS - FRACTION_BITS;
    return field != EXPONENT_MAX;
}

/** The e of |value| = m * 2^e with m in [1/2, 1); value finite, not 0. */
static int binary_exponent(double value)
{
    parts of;
    int exponent;

    (void)take_apart(value, &of);
    for (exponent = of.exponent; of.mantissa != 0; of.mantissa >>= 1) {
        exponent++;
    }
    return exponent;
}

/** 2^exponent, exponent in -1022..1023. */
static double power_of_two(int exponent)
{
    uint64_t bits = (uint64_t)(exponent + EXPONENT_BIAS) << FRACTION_BITS;
    double value;

    memcpy(&value, &bits, sizeof value);
    return value;
}

/** relnav_to_fixed() for any power of two that can matter to a double. */
static relnav_error round_scaled(double value, int power, int32_t *fixed)
{
    parts of;
    uint64_t magnitude;
    int shift;

    if (!take_apart(value, &of)) {
        return RELNAV_NOT_FINITE;
    }
    shift = of.exponent + power;
    if (of.mantissa == 0 || shift < -FRACTION_BITS - 1) { /* below a half */
        magnitude = 0;
    } else if (shift < 0) {
        uint64_t one = UINT64_C(1) << -shift;
        uint64_t rest = of.mantissa & (one - 1);

        magnitude = of.mantissa >> -shift;
        if (2 * rest > one || (2 * rest == one && (magnitude & 1) != 0)) {
            magnitude++;
        }
    } else {
        if (shift >= INPUT_BITS || of.mantissa > INPUT_LIMIT >> shift) {
            return RELNAV_TOO_LARGE;
        }
        magnitude = of.mantissa << shift;
    }
    if (magnitude > INPUT_LIMIT - (of.negative ? 0 : 1)) {
        return RELNAV_TOO_LARGE;
    }
    *fixed = (int32_t)(of.negative ? -(int64_t)magnitude : (int64_t)magnitude);
    return RELNAV_OK;
}

relnav_error relnav_to_fixed(double value, int frac, int32_t *fixed)
{
    return frac < RELNAV_FRAC_MIN || frac > RELNAV_FRAC_MAX ? RELNAV_BAD_FRAC : round_scaled(value, frac, fixed);
}

static double larger(const relnav_range *range)
{
    return range->high > -range->low ? range->high : -range->low;
}

relnav_error relnav_widen(relnav_range *range, relnav_reals values, size_t columns, size_t row)
{
    size_t i;

    for (i = columns * row; i < columns * (row + 1); i++) {
        double value = relnav_real(values, i);
        parts of;

        if (!take_apart(value, &of)) {
            return RELNAV_NOT_FINITE;
        }
        if ((of.negative ? -value : value) > larger(range)) {
            range->row = row;
        }
        if (value > range->high) {
            range->high = value;
        } else if (value < range->low) {
            range->low = value;
        }
    }
    return RELNAV_OK;
}

static relnav_error check_range(const relnav_range *range, int frac)
{
    int32_t fixed;
    relnav_error error = relnav_to_fixed(range->low, frac, &fixed);

    return error != RELNAV_OK ? error : relnav_to_fixed(range->high, frac, &fixed);
}

relnav_error relnav_choose_frac(const relnav_range *range, int wanted, int *frac)
{
    double largest = larger(range);
    int exponent;
    int finest;

    if (wanted != RELNAV_FRAC_AUTO) {
        if (wanted < RELNAV_FRAC_MIN || wanted > RELNAV_FRAC_MAX) {
            return RELNAV_BAD_FRAC;
        }
        *frac = wanted;
        return check_range(range, wanted);
    }
    *frac = 0;
    if (!(largest > 0.0)) {
        return RELNAV_OK;
    }
    exponent = binary_exponent(largest);
    finest = INPUT_BITS - exponent;
    if (finest > RELNAV_FRAC_MAX) {
        finest = RELNAV_FRAC_MAX;
    }
    /* At most one too many for a positive value, right for -2^k; rounding up to 2^31 may cost one more. */
    while (finest >= RELNAV_FRAC_MIN && check_range(range, finest) != RELNAV_OK) {
        finest--;
    }
    if (finest < RELNAV_FRAC_MIN) {
        return RELNAV_TOO_LARGE;
    }
    if (exponent + finest < LEAST_BITS) {
        return RELNAV_TOO_SMALL;
    }
    *frac = finest;
    return RELNAV_OK;
}

/** Whether every weight times a power of two is an integer of 31 bits. */
static int all_integers(relnav_reals weights, size_t count, int exponent)
{
    double factor = power_of_two(exponent);
    size_t i;

    for (i = 0; i < count; i++) {
        double weight = relnav_real(weights, i);
        int32_t integer;

        /* equal, not nearly: the question is whether rounding changed anything */
        if (round_scaled(weight, exponent, &integer) != RELNAV_OK || weight * factor < (double)integer ||
            weight * factor > (double)integer) {
            return 0;
        }
    }
    return 1;
}

relnav_error relnav_weight_scale(relnav_reals weights, size_t count, double *scale, size_t *row)
{
    relnav_range range = {0};
    int exponent;
    size_t i;

    *scale = 1.0;
    if (!relnav_given(weights)) {
        return RELNAV_OK;
    }
    for (i = 0; i < count; i++) {
        if (relnav_widen(&range, weights, 1, i) != RELNAV_OK || range.low < 0.0) {
            *row = i;
            return RELNAV_BAD_WEIGHT;
        }
    }
    if (range.high <= (double)RELNAV_WEIGHT_MAX && all_integers(weights, count, 0)) {
        return RELNAV_OK;
    }
    if (range.high < LEAST_WEIGHT) {
        *row = range.row;
        return RELNAV_SMALL_WEIGHTS;
    }
    exponent = WEIGHT_BITS - binary_exponent(range.high);
    if (range.high * power_of_two(exponent) > (double)RELNAV_WEIGHT_MAX) {
        exponent--;
    }
    *scale = all_integers(weights, count, exponent) ? power_of_two(exponent) : (double)RELNAV_WEIGHT_MAX / range.high;
    for (i = 0; i < count; i++) {
        uint32_t weight;
        relnav_error error = relnav_weight(weights, i, *scale, &weight);

        if (error != RELNAV_OK) {
            *row = i;
            return error;
        }
    }
    return RELNAV_OK;
}

relnav_error relnav_weight(relnav_reals weights, size_t row, double scale, uint32_t *weight)
{
    double value;
    int32_t integer;

    *weight = 1;
    if (!relnav_given(weights)) {
        return RELNAV_OK;
    }
    value = relnav_real(weights, row);
    if (!(value >= 0.0)) {
        return RELNAV_BAD_WEIGHT;
    }
    if (round_scaled(value * scale, 0, &integer) != RELNAV_OK || integer > RELNAV_WEIGHT_MAX) {
        return RELNAV_TOO_LARGE;
    }
    if (value > 0.0 && integer == 0) {
        return RELNAV_LOST_WEIGHT;
    }
    *weight = (uint32_t)integer;
    return RELNAV_OK;
}

relnav_error relnav_check_count(size_t count)
{
    if (count == 0) {
        return RELNAV_EMPTY;
    }
    return count <= RELNAV_ROWS_MAX ? RELNAV_OK : RELNAV_TOO_LONG;
}

relnav_error relnav_check_scale(int frac, double weight_scale)
{
    parts of;

    if (frac < RELNAV_FRAC_MIN || frac > RELNAV_FRAC_MAX) {
        return RELNAV_BAD_FRAC;
    }
    return take_apart(weight_scale, &of) && weight_scale > 0.0 ? RELNAV_OK : RELNAV_WRONG_SCALE;
}

relnav_error relnav_variance_word(double variance, double weight_scale, uint32_t *word)
{
    double value = variance * weight_scale;
    float rounded = 0.0F;

    if (value >= LEAST_FLOAT && value < BEYOND_FLOAT) {
        rounded = (float)value;
    } else if (variance < 0.0 || variance > 0.0 || value != value) {
        return RELNAV_BAD_VARIANCE;
    }
    memcpy(word, &rounded, sizeof *word);
    return RELNAV_OK;
}

float relnav_float(uint32_t word)
{
    float value;

    memcpy(&value, &word, sizeof value);
    return value;
}

void relnav_copy_floats(float *to, const uint32_t *words, size_t count)
{
    memcpy(to, words, count * sizeof *to);
}

int relnav_finite(const float *values, size_t count)
{
    size_t i;

    for (i = 0; i < count; i++) {
        parts of;

        if (!take_apart((double)values[i], &of)) {
            return 0;
        }
    }
    return 1;
}

double relnav_sqrt(double value)
{
    parts of;
    uint64_t root = 0;
    uint64_t rest = 0;
    int bit;

    if (!(value > 0.0)) {
        return 0.0;
    }
    if (!take_apart(value, &of)) { /* infinite */
        return value;
    }
    while (of.mantissa >> FRACTION_BITS == 0) { /* a denormal */
        of.mantissa <<= 1;
        of.exponent--;
    }
    if ((of.exponent & 1) != 0) {
        of.mantissa <<= 1;
        of.exponent--;
    }
    /* mantissa in [2^52, 2^54): digit by digit, two of its bits each, to a root of 54 bits, of which the last rounds. */
    for (bit = 52; bit >= -54; bit -= 2) {
        uint64_t next = bit >= 0 ? of.mantissa >> bit & 3 : 0;

        rest = rest << 2 | next;
        root <<= 1;
        if (rest > 2 * root) {
            rest -= 2 * root + 1;
            root++;
        }
    }
    /* root^2 <= mantissa * 2^54: the root's unit is 2^(exponent / 2 - 27); it never lies half way. */
    root = (root + 1) >> 1;
    return (double)root * power_of_two(of.exponent / 2 - 26);
}
