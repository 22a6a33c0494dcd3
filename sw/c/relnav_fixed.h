/* SPDX-License-Identifier: Apache-2.0
 *
 * From the caller's numbers to the cores' integers, and back. The rules, and every bit, are those of relnav.quantise (Python):
 * ties to even, value = integer * 2^-frac. No libm. Compile without contraction (-std=c99 or -ffp-contract=off).
 */
#ifndef RELNAV_FIXED_H
#define RELNAV_FIXED_H

#include "relnav_core.h"

#ifdef __cplusplus
extern "C" {
#endif

enum {
    RELNAV_FRAC_MIN = -64,
    RELNAV_FRAC_MAX = 95,
    RELNAV_FRAC_AUTO = 127,   /**< the finest binary point that fits */
    RELNAV_WEIGHT_MAX = 65535,
    RELNAV_ROWS_MAX = 65535   /**< points or rows in a frame */
};

/** An array of the caller's, of either type. */
typedef struct {
    const double *doubles; /**< NULL: see floats */
    const float *floats;   /**< NULL too: there is none */
} relnav_reals;

static inline relnav_reals relnav_none(void)
{
    relnav_reals none = {NULL, NULL};
    return none;
}

static inline relnav_reals relnav_doubles(const double *values)
{
    relnav_reals reals = {values, NULL};
    return reals;
}

static inline relnav_reals relnav_floats(const float *values)
{
    relnav_reals reals = {NULL, values};
    return reals;
}

static inline int relnav_given(relnav_reals reals)
{
    return reals.doubles != NULL || reals.floats != NULL;
}

static inline double relnav_real(relnav_reals reals, size_t index)
{
    return reals.doubles != NULL ? reals.doubles[index] : (double)reals.floats[index];
}

/** The extremes of some values; begin with {0}, which stands for zeros. */
typedef struct {
    double low;
    double high;
    size_t row; /**< of the first value of the largest magnitude */
} relnav_range;

/** Widen a range by one row of an array (n, columns). RELNAV_NOT_FINITE. */
relnav_error relnav_widen(relnav_range *range, relnav_reals values, size_t columns, size_t row);

/** value * 2^frac, rounded. RELNAV_NOT_FINITE; RELNAV_TOO_LARGE: not in [-2^31, 2^31 - 1]; RELNAV_BAD_FRAC. */
relnav_error relnav_to_fixed(double value, int frac, int32_t *fixed);

/** The binary point for a range: wanted, or with RELNAV_FRAC_AUTO the largest that fits, 0 for zeros.
 * RELNAV_BAD_FRAC, RELNAV_TOO_LARGE; with RELNAV_FRAC_AUTO also RELNAV_TOO_SMALL: 24 bits are the least for the largest value. */
relnav_error relnav_choose_frac(const relnav_range *range, int wanted, int *frac);

/** The factor that makes weights 16-bit integers: 1 for integers up to 65535; else the largest power of two that fits where it makes
 * all of them integers; else 65535 / max. Without weights 1. *row: where RELNAV_BAD_WEIGHT, RELNAV_SMALL_WEIGHTS (max below 2^-900)
 * or RELNAV_LOST_WEIGHT is. */
relnav_error relnav_weight_scale(relnav_reals weights, size_t count, double *scale, size_t *row);

/** A weight as the core takes it, for a scale of relnav_weight_scale(); 1 where there are none. For another frame's scale also
 * RELNAV_BAD_WEIGHT, RELNAV_LOST_WEIGHT, RELNAV_TOO_LARGE (beyond 65535). */
relnav_error relnav_weight(relnav_reals weights, size_t row, double scale, uint32_t *weight);

/** Whether a frame of so many points or rows can be: RELNAV_EMPTY, RELNAV_TOO_LONG. */
relnav_error relnav_check_count(size_t count);

/** Whether a scale can be, whoever made it: RELNAV_BAD_FRAC; RELNAV_WRONG_SCALE: a factor of weights that is none. */
relnav_error relnav_check_scale(int frac, double weight_scale);

/** VARIANCE (binary32): the caller's variance at unit weight, at unit integer weight. 0: the core takes it from rss.
 * RELNAV_BAD_VARIANCE for what is negative, not finite or would be infinite, denormal or 0. */
relnav_error relnav_variance_word(double variance, double weight_scale, uint32_t *word);

/** The binary32 number with this bit pattern; count of them. */
float relnav_float(uint32_t word);
void relnav_copy_floats(float *to, const uint32_t *words, size_t count);

/** Whether all of them are finite. */
int relnav_finite(const float *values, size_t count);

/** Square root, correctly rounded; 0 for what is not positive. */
double relnav_sqrt(double value);

#ifdef __cplusplus
}
#endif

#endif
