/* SPDX-License-Identifier: Apache-2.0
 *
 * Driver of the iVisNav core: the rates x = (v, omega) of a target from rows y = h x, h = [r; p x r].
 *
 * v in m/s, omega in rad/s: the target's against the sensor, in the axes of r and p; a point at p from the target's centre moves with
 * v + omega x p. r is the unit vector from the sensor to the place where a beam meets the target, p in m its place from the centre, y in
 * m/s the range rate, positive when the range grows: y = ivisnav_metres_per_second(f0, dt) * phase difference in rad.
 *
 *     ivisnav_init, then per frame either ivisnav_solve or
 *     ivisnav_choose, ivisnav_configure,
 *     ivisnav_push_frame, or ivisnav_fill, relnav_begin and a DMA of the buffer,
 *     relnav_wait, or relnav_poll after the interrupt, ivisnav_read.
 *
 * Each of these, where a pointer or an array that it needs is NULL: RELNAV_NULL. relnav_... functions do not look.
 */
#ifndef IVISNAV_H
#define IVISNAV_H

#include "ivisnav_registers.h"
#include "relnav_core.h"
#include "relnav_fixed.h"

#ifdef __cplusplus
extern "C" {
#endif

/** One iVisNav core. */
typedef struct {
    relnav_core core;
} ivisnav;

/** Rows of one frame. */
typedef struct {
    size_t count;
    relnav_reals h; /**< (count, 6): r (1), p x r (m); see ivisnav_row() */
    relnav_reals y; /**< (count): m/s */
    relnav_reals w; /**< (count): weights >= 0, inverse variances up to one factor; relnav_none(): all 1 */
} ivisnav_frame;

/** How a frame becomes integers. */
typedef struct {
    int frac_h;          /**< h = integer * 2^-frac_h */
    int frac_y;          /**< y = integer * 2^-frac_y */
    double weight_scale; /**< integer weight = rounded(weight_scale * w) */
} ivisnav_scale;

/** Register words of one frame. Results are binary32. */
typedef struct {
    uint32_t flags;      /**< FRAME_FLAGS */
    uint32_t head[4];    /**< from ROWS on */
    uint32_t cycles_all;
    uint32_t words[(sizeof(ivisnav_registers) - offsetof(ivisnav_registers, V)) / sizeof(uint32_t)]; /**< from V on */
} ivisnav_raw;

/** One frame's rates. */
typedef struct {
    uint32_t flags;        /**< IVISNAV_FRAME_FLAGS_...; with BUSY_WRITE alone there are numbers */
    uint32_t count;        /**< rows */
    double weight;         /**< sum of w */
    double condition;      /**< estimate of cond(sqrt(W) H), also after RELNAV_ILL_CONDITIONED */
    float v[3];            /**< m/s */
    float omega[3];        /**< rad/s */
    double rss;            /**< sum of w (y - h x)^2 */
    float covariance[21];  /**< of (v, omega): upper triangle, row-major; not finite where neither variance nor freedom scale it */
    uint32_t cycles_rates; /**< clocks from the last beat to v and omega */
    uint32_t cycles_all;   /**< to everything */
} ivisnav_result;

/** Check that there is an iVisNav core of our version. RELNAV_NO_CORE, RELNAV_WRONG_VERSION, RELNAV_MISALIGNED. Writes nothing to the
 * core. device->core.build says what it was built with; without IVISNAV_BUILD_VERIFY its results are computed once only. */
relnav_error ivisnav_init(ivisnav *device, relnav_port port);

/** c / (4 pi f0 dt): range rate of one radian an interval. f0: modulation frequency, Hz; dt: interval, s. Not finite where one of them is 0:
 * ivisnav_choose() then says RELNAV_NOT_FINITE of the range rates. */
double ivisnav_metres_per_second(double f0, double dt);

/** A row of h from a beam: r of any length but zero, p in m. RELNAV_NOT_FINITE (also of the products), RELNAV_ZERO_DIRECTION. */
relnav_error ivisnav_row(const double r[3], const double p[3], double h[6]);

/** The binary points (wanted, or RELNAV_FRAC_AUTO) and the weights' scale of a frame. The errors are those of "what the caller gave";
 * *row (may be NULL) says where. */
relnav_error ivisnav_choose(const ivisnav_frame *frame, int wanted_h, int wanted_y, ivisnav_scale *scale, size_t *row);

/** Set FRAC and VARIANCE for the next frames. variance: of y at unit weight, (m/s)^2; 0: the core takes rss / (n - 6).
 * RELNAV_BUSY, RELNAV_NOT_TAKEN, RELNAV_BAD_VARIANCE; RELNAV_BAD_FRAC, RELNAV_WRONG_SCALE for a scale that is none. */
relnav_error ivisnav_configure(ivisnav *device, double variance, const ivisnav_scale *scale);

/** 64-bit beats of a frame: four a row. */
size_t ivisnav_beats(const ivisnav_frame *frame);

/** Write a frame's beats into a buffer for the stream, in order: {h1, h0}, {h3, h2}, {h5, h4}, {w, y}, the second in the low 32 bits. A
 * DMA that moves bytes in order needs a little-endian processor, and tlast on the last beat. capacity: in beats.
 * RELNAV_EMPTY, RELNAV_TOO_LONG, RELNAV_NO_SPACE, RELNAV_MISALIGNED. For another frame's scale what the first number that does not fit
 * it says; then the buffer holds part of a frame. */
relnav_error ivisnav_fill(const ivisnav_frame *frame, const ivisnav_scale *scale, uint64_t *beats, size_t capacity);

/** Give the core a frame by its registers, beat by beat. The errors of relnav_begin() and of ivisnav_fill(), RELNAV_WRONG_SCALE where
 * another scale is configured; after an error the core holds no part of the frame. RELNAV_NOT_TAKEN: a write was refused. */
relnav_error ivisnav_push_frame(ivisnav *device, const ivisnav_frame *frame, const ivisnav_scale *scale);

/** The words of the frame that was solved last, each read twice. RELNAV_UNSTEADY, what FLAGS say afterwards, or RELNAV_PENDING: the
 * frame that was begun last is not completed, its results are provisional or there are none. */
relnav_error ivisnav_read_raw(const ivisnav *device, ivisnav_raw *raw);

/** ivisnav_read_raw() in the caller's units. */
relnav_error ivisnav_read(const ivisnav *device, ivisnav_result *result);

/** Choose, configure, push, wait, read; relnav_settle() after an error, so that the next frame may come at once.
 * RELNAV_WRONG_FRAME: the core counted other rows. After an error the result is all zeros but for the flags, and the condition where
 * that is the reason, of a frame that the core gave up. polls: of relnav_wait(). */
relnav_error ivisnav_solve(ivisnav *device, const ivisnav_frame *frame, double variance, uint32_t polls, ivisnav_result *result);

#ifdef __cplusplus
}
#endif

#endif
