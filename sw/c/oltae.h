/* SPDX-License-Identifier: Apache-2.0
 *
 * Driver of the OLTAE core: the pose b = R a + t of matched points a, b.
 *
 * Lengths are in the caller's unit. R is row-major and turns vectors: v' = R v. q is the paper's: R = (I+Q)^-1 (I-Q), Q = [q x], so that
 * |q| is the tangent of half the angle and a positive q3 turns by a NEGATIVE angle about z. Symmetric 3 x 3 matrices are their upper
 * triangles 11 12 13 22 23 33.
 *
 *     oltae_init, then per frame either oltae_solve or
 *     oltae_choose, oltae_configure,
 *     oltae_push_frame, or oltae_fill, relnav_begin and a DMA of the buffer,
 *     relnav_wait, or relnav_poll after the interrupt, oltae_read.
 *
 * Each of these, where a pointer or an array that it needs is NULL: RELNAV_NULL. relnav_... functions do not look.
 */
#ifndef OLTAE_H
#define OLTAE_H

#include "oltae_registers.h"
#include "relnav_core.h"
#include "relnav_fixed.h"

#ifdef __cplusplus
extern "C" {
#endif

/** One OLTAE core. */
typedef struct {
    relnav_core core;
} oltae;

/** Matched points of one frame. */
typedef struct {
    size_t count;
    relnav_reals a; /**< (count, 3): x y z of each point, caller's unit */
    relnav_reals b; /**< likewise */
    relnav_reals w; /**< (count): weights >= 0, inverse variances up to one factor; relnav_none(): unweighted */
} oltae_frame;

/** How a frame becomes integers. */
typedef struct {
    int frac;            /**< a, b = integer * 2^-frac */
    double weight_scale; /**< integer weight = rounded(weight_scale * w) */
    int weighted;
} oltae_scale;

/** Register words of one frame. Results are binary32 but Q_FIXED, which is Q15.16. */
typedef struct {
    uint32_t flags;   /**< FRAME_FLAGS */
    uint32_t head[6]; /**< from POINTS on */
    uint32_t words[(sizeof(oltae_registers) - offsetof(oltae_registers, Q)) / sizeof(uint32_t)]; /**< from Q on */
} oltae_raw;

/** One frame's pose. */
typedef struct {
    uint32_t flags;        /**< OLTAE_FRAME_FLAGS_...; Q_SATURATED, ILL_CONDITIONED, BUSY_WRITE, NOT_BUILT leave the numbers */
    uint32_t count;        /**< points */
    uint32_t turn;         /**< OLTAE_TURN_...: the half turn given to a before solving */
    double weight;         /**< sum of w */
    float q[3];
    int32_t q_fixed[3];    /**< q * 2^16, saturated */
    float rotation[9];     /**< R, row-major */
    float translation[3];  /**< t, caller's unit */
    double rss;            /**< sum of w |b - R a - t|^2 */
    float condition;       /**< estimate of the condition number of M */
    double determinant;    /**< of M; weights^3 unit^6 */
    float q_cov[6];        /**< covariance of q; 0 where CONFIG.COVARIANCE was off, and where q is not finite */
    float t_cov[6];        /**< covariance of t, unit^2; 0 where CONFIG.COVARIANCE was off */
    uint32_t cycles_q;     /**< clocks from the last beat to q */
    uint32_t cycles_pose;  /**< to R and t */
    uint32_t cycles_all;   /**< to everything */
} oltae_result;

/** Check that there is an OLTAE core of our version. RELNAV_NO_CORE, RELNAV_WRONG_VERSION, RELNAV_MISALIGNED. Writes nothing to the
 * core. device->core.build says what it was built with; without OLTAE_BUILD_VERIFY its results are computed once only. */
relnav_error oltae_init(oltae *device, relnav_port port);

/** The binary point (wanted, or RELNAV_FRAC_AUTO) and the weights' scale of a frame. The errors are those of "what the caller gave";
 * *row (may be NULL) says where. */
relnav_error oltae_choose(const oltae_frame *frame, int wanted, oltae_scale *scale, size_t *row);

/** Set CONFIG, FRAC and VARIANCE for the next frames.
 * config: of OLTAE_CONFIG_FORBID_TURNS, _REAPPLY, _COVARIANCE; _WEIGHTED follows from the scale.
 * variance: sigma_a^2 + sigma_b^2 at unit weight, unit^2; 0: the core takes rss / (3n - 6).
 * RELNAV_BUSY, RELNAV_NOT_BUILT, RELNAV_NOT_TAKEN, RELNAV_BAD_VARIANCE; RELNAV_BAD_FRAC, RELNAV_WRONG_SCALE for a scale that is none. */
relnav_error oltae_configure(oltae *device, uint32_t config, double variance, const oltae_scale *scale);

/** 64-bit beats of a frame: three a point, and one in front with the weight. */
size_t oltae_beats(const oltae_frame *frame);

/** Write a frame's beats into a buffer for the stream, in order: {w}, {b_x, a_x}, {b_y, a_y}, {b_z, a_z}, a in the low 32 bits. A DMA
 * that moves bytes in order needs a little-endian processor, and tlast on the last beat. capacity: in beats.
 * RELNAV_EMPTY, RELNAV_TOO_LONG, RELNAV_NO_SPACE, RELNAV_MISALIGNED. For another frame's scale RELNAV_WRONG_SCALE, or what the first
 * number that does not fit it says; then the buffer holds part of a frame. */
relnav_error oltae_fill(const oltae_frame *frame, const oltae_scale *scale, uint64_t *beats, size_t capacity);

/** Give the core a frame by its registers, beat by beat. The errors of relnav_begin() and of oltae_fill(), RELNAV_WRONG_SCALE also where
 * another scale is configured; after an error the core holds no part of the frame. RELNAV_NOT_TAKEN: a write was refused. */
relnav_error oltae_push_frame(oltae *device, const oltae_frame *frame, const oltae_scale *scale);

/** The words of the frame that was solved last, each read twice. RELNAV_UNSTEADY, what FLAGS say afterwards, or RELNAV_PENDING: the
 * frame that was begun last is not completed, its results are provisional or there are none. */
relnav_error oltae_read_raw(const oltae *device, oltae_raw *raw);

/** oltae_read_raw() in the caller's units. */
relnav_error oltae_read(const oltae *device, oltae_result *result);

/** Choose, configure, push, wait, read; relnav_settle() after an error, so that the next frame may come at once.
 * RELNAV_WRONG_FRAME: the core counted other points. After an error the result is all zeros but for the flags of a frame
 * that the core gave up. polls: of relnav_wait(). */
relnav_error oltae_solve(oltae *device, const oltae_frame *frame, uint32_t config, double variance, uint32_t polls,
                         oltae_result *result);

#ifdef __cplusplus
}
#endif

#endif
