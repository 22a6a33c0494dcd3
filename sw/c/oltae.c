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

relnav_error oltae_init(oltae *device, relnav_port port)
{
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
    if (frame->count == 0) {
        return RELNAV_EMPTY;
    }
    if (frame->count > RELNAV_ROWS_MAX) {
        return RELNAV_TOO_LONG;
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
    relnav_error error = relnav_variance_word(variance, scale->weight_scale, &word);
    size_t i;

    if (error != RELNAV_OK) {
        return error;
    }
    config &= ~OLTAE_CONFIG_WEIGHTED;
    if (scale->weighted) {
        config |= OLTAE_CONFIG_WEIGHTED;
    }
    for (i = 0; i < sizeof options / sizeof options[0]; i++) {
        if ((config & options[i].config) != 0 && (device->core.build & options[i].build) == 0) {
            return RELNAV_NOT_BUILT;
        }
    }
    return relnav_set(&device->core, config, (uint32_t)scale->frac & OLTAE_FRAC_FRAC, word, scale->weight_scale);
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
        beats[(*count)++] = relnav_weight(frame->w, point, scale->weight_scale);
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
    relnav_error error = oltae_beats(frame) > capacity ? RELNAV_NO_SPACE : RELNAV_OK;
    size_t point;

    for (point = 0; error == RELNAV_OK && point < frame->count; point++) {
        size_t count;

        error = point_beats(frame, scale, point, beats, &count);
        beats += count;
    }
    return error;
}

relnav_error oltae_push_frame(oltae *device, const oltae_frame *frame, const oltae_scale *scale)
{
    relnav_error error = frame->count == 0 ? RELNAV_EMPTY : relnav_begin_push(&device->core);
    size_t point;

    for (point = 0; error == RELNAV_OK && point < frame->count; point++) {
        uint64_t beats[MOST_BEATS];
        size_t count;
        size_t beat;

        error = point_beats(frame, scale, point, beats, &count);
        for (beat = 0; error == RELNAV_OK && beat < count; beat++) {
            relnav_push(&device->core, beats[beat], point + 1 == frame->count && beat + 1 == count);
        }
        if (error != RELNAV_OK) {
            relnav_soft_reset(&device->core);
        }
    }
    return error;
}

relnav_error oltae_read_raw(const oltae *device, oltae_raw *raw)
{
    const relnav_core *core = &device->core;
    relnav_error error = relnav_read_twice(core, offsetof(oltae_registers, FRAME_FLAGS), 1, &raw->flags);

    if (error == RELNAV_OK) {
        error = relnav_read_twice(core, offsetof(oltae_registers, POINTS), sizeof raw->head / sizeof(uint32_t), raw->head);
    }
    if (error == RELNAV_OK) {
        error = relnav_read_twice(core, offsetof(oltae_registers, Q), sizeof raw->words / sizeof(uint32_t), raw->words);
    }
    return error == RELNAV_OK ? relnav_failure(core, relnav_flags(core)) : error;
}

relnav_error oltae_read(const oltae *device, oltae_result *result)
{
    double scale = device->core.weight_scale;
    int covariance = (device->core.config & OLTAE_CONFIG_COVARIANCE) != 0;
    oltae_raw raw;
    relnav_error error = oltae_read_raw(device, &raw);

    memset(result, 0, sizeof *result);
    if (error != RELNAV_OK) {
        return error;
    }
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
    relnav_error error = oltae_choose(frame, RELNAV_FRAC_AUTO, &scale, NULL);

    memset(result, 0, sizeof *result);
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
