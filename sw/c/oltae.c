/* SPDX-License-Identifier: Apache-2.0 */
#include "oltae.h"

#include <string.h>

/* places in oltae_raw */
#define HEAD(name) ((offsetof(oltae_registers, name) - offsetof(oltae_registers, POINTS)) / sizeof(uint32_t))
#define WORD(name) ((offsetof(oltae_registers, name) - offsetof(oltae_registers, Q)) / sizeof(uint32_t))

#define FAILURES \
    (OLTAE_FLAGS_FEW_POINTS | OLTAE_FLAGS_RANK_DEFICIENT | OLTAE_FLAGS_ZERO_WEIGHT | OLTAE_FLAGS_TOO_LONG | \
     OLTAE_FLAGS_BAD_TLAST | OLTAE_FLAGS_WATCHDOG | OLTAE_FLAGS_UPSET)

enum { AXES = 3, MOST_BEATS = AXES + 1 }; /* of a point */

/** The register FRAC of a scale. */
static uint32_t frac_word(const oltae_scale *scale)
{
    return (uint32_t)scale->frac & OLTAE_FRAC_FRAC;
}

static uint32_t config_word(uint32_t config, const oltae_scale *scale)
{
    return (config & ~OLTAE_CONFIG_WEIGHTED) | (scale->weighted ? OLTAE_CONFIG_WEIGHTED : 0);
}

static relnav_error check_frame(const oltae_frame *frame)
{
    if (frame == NULL || !relnav_given(frame->a) || !relnav_given(frame->b)) {
        return RELNAV_NULL;
    }
    return relnav_check_count(frame->count);
}

/** A frame together with a scale that may be another's. */
static relnav_error check_scaled(const oltae_frame *frame, const oltae_scale *scale)
{
    relnav_error error = check_frame(frame);

    if (error != RELNAV_OK) {
        return error;
    }
    if (scale == NULL) {
        return RELNAV_NULL;
    }
    return !scale->weighted == !relnav_given(frame->w) ? relnav_check_scale(scale->frac, scale->weight_scale)
                                                       : RELNAV_WRONG_SCALE;
}

relnav_error oltae_init(oltae *device, relnav_port port)
{
    if (device == NULL) {
        return RELNAV_NULL;
    }
    memset(device, 0, sizeof *device);
    device->core.port = port;
    device->core.failures = FAILURES;
    device->core.config_offset = offsetof(oltae_registers, CONFIG);
    return relnav_identify(&device->core, OLTAE_ID_VALUE, OLTAE_VERSION_VALUE);
}

relnav_error oltae_choose(const oltae_frame *frame, int wanted, oltae_scale *scale, size_t *row)
{
    relnav_range range = {0};
    relnav_error error;
    size_t at = 0;

    if (row == NULL) {
        row = &at;
    }
    *row = 0;
    error = scale == NULL ? RELNAV_NULL : check_frame(frame);
    if (error != RELNAV_OK) {
        return error;
    }
    for (at = 0; at < frame->count; at++) {
        if (relnav_widen(&range, frame->a, AXES, at) != RELNAV_OK || relnav_widen(&range, frame->b, AXES, at) != RELNAV_OK) {
            *row = at;
            return RELNAV_NOT_FINITE;
        }
    }
    error = relnav_choose_frac(&range, wanted, &scale->frac);
    if (error != RELNAV_OK) {
        *row = range.row;
        return error;
    }
    scale->weighted = relnav_given(frame->w);
    return relnav_weight_scale(frame->w, frame->count, &scale->weight_scale, row);
}

relnav_error oltae_configure(oltae *device, uint32_t config, double variance, const oltae_scale *scale)
{
    static const struct {
        uint32_t config;
        uint32_t build;
    } options[] = {
        {OLTAE_CONFIG_WEIGHTED, OLTAE_BUILD_WEIGHTED},
        {OLTAE_CONFIG_COVARIANCE, OLTAE_BUILD_COVARIANCE},
        {OLTAE_CONFIG_REAPPLY, OLTAE_BUILD_REAPPLY},
    };
    uint32_t word;
    relnav_error error = device == NULL || scale == NULL ? RELNAV_NULL : relnav_check_scale(scale->frac, scale->weight_scale);
    size_t i;

    if (error == RELNAV_OK) {
        error = relnav_variance_word(variance, scale->weight_scale, &word);
    }
    if (error != RELNAV_OK) {
        return error;
    }
    config = config_word(config, scale);
    for (i = 0; i < sizeof options / sizeof options[0]; i++) {
        if ((config & options[i].config) != 0 && (device->core.build & options[i].build) == 0) {
            return RELNAV_NOT_BUILT;
        }
    }
    return relnav_set(&device->core, config, frac_word(scale), word, scale->weight_scale);
}

size_t oltae_beats(const oltae_frame *frame)
{
    return frame->count * (size_t)(relnav_given(frame->w) ? AXES + 1 : AXES);
}

/** The beats of a point; *count: how many. */
static relnav_error point_beats(const oltae_frame *frame, const oltae_scale *scale, size_t point, uint64_t *beats, size_t *count)
{
    size_t axis;

    *count = 0;
    if (scale->weighted) {
        uint32_t weight;
        relnav_error error = relnav_weight(frame->w, point, scale->weight_scale, &weight);

        if (error != RELNAV_OK) {
            return error;
        }
        beats[(*count)++] = weight;
    }
    for (axis = 0; axis < AXES; axis++) {
        int32_t a;
        int32_t b;
        relnav_error error = relnav_to_fixed(relnav_real(frame->a, AXES * point + axis), scale->frac, &a);

        if (error == RELNAV_OK) {
            error = relnav_to_fixed(relnav_real(frame->b, AXES * point + axis), scale->frac, &b);
        }
        if (error != RELNAV_OK) {
            return error;
        }
        beats[(*count)++] = (uint64_t)(uint32_t)b << 32 | (uint32_t)a;
    }
    return RELNAV_OK;
}

relnav_error oltae_fill(const oltae_frame *frame, const oltae_scale *scale, uint64_t *beats, size_t capacity)
{
    relnav_error error = beats == NULL ? RELNAV_NULL : check_scaled(frame, scale);
    size_t point;

    if (error == RELNAV_OK && (uintptr_t)beats % sizeof *beats != 0) {
        error = RELNAV_MISALIGNED;
    }
    if (error == RELNAV_OK && oltae_beats(frame) > capacity) {
        error = RELNAV_NO_SPACE;
    }
    for (point = 0; error == RELNAV_OK && point < frame->count; point++) {
        size_t count;

        error = point_beats(frame, scale, point, beats, &count);
        beats += count;
    }
    return error;
}

relnav_error oltae_push_frame(oltae *device, const oltae_frame *frame, const oltae_scale *scale)
{
    relnav_error error = device == NULL ? RELNAV_NULL : check_scaled(frame, scale);
    size_t point;

    if (error == RELNAV_OK) {
        error = relnav_check_set(&device->core, config_word(0, scale), OLTAE_CONFIG_WEIGHTED, frac_word(scale),
                                 scale->weight_scale);
    }
    if (error == RELNAV_OK) {
        error = relnav_begin_push(&device->core);
    }
    for (point = 0; error == RELNAV_OK && point < frame->count; point++) {
        uint64_t beats[MOST_BEATS];
        size_t count;

        error = point_beats(frame, scale, point, beats, &count);
        if (error == RELNAV_OK) {
            relnav_push_row(&device->core, beats, count, point + 1 == frame->count);
        } else {
            relnav_soft_reset(&device->core);
        }
    }
    return error == RELNAV_OK ? relnav_end_push(&device->core) : error;
}

relnav_error oltae_read_raw(const oltae *device, oltae_raw *raw)
{
    const relnav_core *core;
    relnav_error error;

    if (device == NULL || raw == NULL) {
        return RELNAV_NULL;
    }
    core = &device->core;
    error = relnav_read_twice(core, offsetof(oltae_registers, FRAME_FLAGS), 1, &raw->flags);
    if (error == RELNAV_OK) {
        error = relnav_read_twice(core, offsetof(oltae_registers, POINTS), sizeof raw->head / sizeof(uint32_t), raw->head);
    }
    if (error == RELNAV_OK) {
        error = relnav_read_twice(core, offsetof(oltae_registers, Q), sizeof raw->words / sizeof(uint32_t), raw->words);
    }
    return error == RELNAV_OK ? relnav_confirm(core) : error;
}

relnav_error oltae_read(const oltae *device, oltae_result *result)
{
    oltae_raw raw;
    relnav_error error;
    double scale;
    int covariance;

    if (result == NULL) {
        return RELNAV_NULL;
    }
    memset(result, 0, sizeof *result);
    error = oltae_read_raw(device, &raw);
    if (error != RELNAV_OK) {
        return error;
    }
    scale = device->core.weight_scale;
    covariance = (device->core.config & OLTAE_CONFIG_COVARIANCE) != 0;
    result->flags = raw.flags;
    result->count = raw.head[HEAD(POINTS)];
    result->weight = (double)raw.head[HEAD(WEIGHT)] / scale;
    result->turn = raw.head[HEAD(TURN)];
    result->cycles_q = raw.head[HEAD(CYCLES_Q)];
    result->cycles_pose = raw.head[HEAD(CYCLES_POSE)];
    result->cycles_all = raw.head[HEAD(CYCLES_ALL)];
    relnav_copy_floats(result->q, &raw.words[WORD(Q)], 3);
    memcpy(result->q_fixed, &raw.words[WORD(Q_FIXED)], sizeof result->q_fixed);
    relnav_copy_floats(result->rotation, &raw.words[WORD(R)], 9);
    relnav_copy_floats(result->translation, &raw.words[WORD(T)], 3);
    result->rss = (double)relnav_float(raw.words[WORD(RSS)]) / scale;
    result->condition = relnav_float(raw.words[WORD(CONDITION)]);
    result->determinant = (double)relnav_float(raw.words[WORD(DETERMINANT)]) / scale / scale / scale;
    if (covariance && relnav_finite(result->q, 3)) {
        relnav_copy_floats(result->q_cov, &raw.words[WORD(Q_COV)], 6);
    }
    if (covariance) {
        relnav_copy_floats(result->t_cov, &raw.words[WORD(T_COV)], 6);
    }
    return RELNAV_OK;
}

relnav_error oltae_solve(oltae *device, const oltae_frame *frame, uint32_t config, double variance, uint32_t polls,
                         oltae_result *result)
{
    oltae_scale scale;
    relnav_error error;

    if (result == NULL) {
        return RELNAV_NULL;
    }
    memset(result, 0, sizeof *result);
    error = oltae_choose(frame, RELNAV_FRAC_AUTO, &scale, NULL);
    if (error == RELNAV_OK) {
        error = oltae_configure(device, config, variance, &scale);
    }
    if (error == RELNAV_OK) {
        error = oltae_push_frame(device, frame, &scale);
    }
    if (error != RELNAV_OK) {
        return error;
    }
    error = relnav_wait(&device->core, polls);
    if (error != RELNAV_OK) {
        result->flags = relnav_frame_flags(&device->core);
        return relnav_settle(&device->core, error);
    }
    error = relnav_settle(&device->core, oltae_read(device, result));
    return error == RELNAV_OK && result->count != frame->count ? RELNAV_WRONG_FRAME : error;
}
