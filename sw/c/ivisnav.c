/* SPDX-License-Identifier: Apache-2.0 */
#include "ivisnav.h"

#include <string.h>

/* places in ivisnav_raw */
#define HEAD(name) ((offsetof(ivisnav_registers, name) - offsetof(ivisnav_registers, ROWS)) / sizeof(uint32_t))
#define WORD(name) ((offsetof(ivisnav_registers, name) - offsetof(ivisnav_registers, V)) / sizeof(uint32_t))

#define FAILURES \
    (IVISNAV_FLAGS_FEW_ROWS | IVISNAV_FLAGS_RANK_DEFICIENT | IVISNAV_FLAGS_ZERO_WEIGHT | IVISNAV_FLAGS_TOO_LONG | \
     IVISNAV_FLAGS_BAD_TLAST | IVISNAV_FLAGS_ILL_CONDITIONED | IVISNAV_FLAGS_WATCHDOG | IVISNAV_FLAGS_UPSET)

#define SPEED_OF_LIGHT 299792458.0 /* m/s */
#define PI 3.14159265358979323846

enum { COLUMNS = 6, ROW_BEATS = COLUMNS / 2 + 1 };

/** The register FRAC of a scale. */
static uint32_t frac_word(const ivisnav_scale *scale)
{
    return ((uint32_t)scale->frac_h << IVISNAV_FRAC_FRAC_H_SHIFT & IVISNAV_FRAC_FRAC_H) |
           ((uint32_t)scale->frac_y << IVISNAV_FRAC_FRAC_Y_SHIFT & IVISNAV_FRAC_FRAC_Y);
}

static relnav_error check_frame(const ivisnav_frame *frame)
{
    if (frame == NULL || !relnav_given(frame->h) || !relnav_given(frame->y)) {
        return RELNAV_NULL;
    }
    return relnav_check_count(frame->count);
}

static relnav_error check_scale(const ivisnav_scale *scale)
{
    relnav_error error = scale == NULL ? RELNAV_NULL : relnav_check_scale(scale->frac_h, scale->weight_scale);

    return error == RELNAV_OK ? relnav_check_scale(scale->frac_y, scale->weight_scale) : error;
}

/** A frame together with a scale that may be another's. */
static relnav_error check_scaled(const ivisnav_frame *frame, const ivisnav_scale *scale)
{
    relnav_error error = check_frame(frame);

    return error == RELNAV_OK ? check_scale(scale) : error;
}

relnav_error ivisnav_init(ivisnav *device, relnav_port port)
{
    if (device == NULL) {
        return RELNAV_NULL;
    }
    memset(device, 0, sizeof *device);
    device->core.port = port;
    device->core.failures = FAILURES;
    return relnav_identify(&device->core, IVISNAV_ID_VALUE, IVISNAV_VERSION_VALUE);
}

double ivisnav_metres_per_second(double f0, double dt)
{
    return SPEED_OF_LIGHT / (4.0 * PI) / f0 / dt;
}

relnav_error ivisnav_row(const double r[3], const double p[3], double h[6])
{
    relnav_range lengths = {0};
    relnav_range row = {0};
    double largest;
    double length;
    size_t i;

    if (r == NULL || p == NULL || h == NULL) {
        return RELNAV_NULL;
    }
    if (relnav_widen(&lengths, relnav_doubles(r), 3, 0) != RELNAV_OK) {
        return RELNAV_NOT_FINITE;
    }
    largest = lengths.high > -lengths.low ? lengths.high : -lengths.low;
    if (!(largest > 0.0)) {
        return RELNAV_ZERO_DIRECTION;
    }
    for (i = 0; i < 3; i++) { /* so no square leaves double's range */
        h[i] = r[i] / largest;
    }
    length = relnav_sqrt(h[0] * h[0] + h[1] * h[1] + h[2] * h[2]);
    for (i = 0; i < 3; i++) {
        h[i] /= length;
    }
    h[3] = p[1] * h[2] - p[2] * h[1];
    h[4] = p[2] * h[0] - p[0] * h[2];
    h[5] = p[0] * h[1] - p[1] * h[0];
    return relnav_widen(&row, relnav_doubles(h), COLUMNS, 0);
}

relnav_error ivisnav_choose(const ivisnav_frame *frame, int wanted_h, int wanted_y, ivisnav_scale *scale, size_t *row)
{
    relnav_range h = {0};
    relnav_range y = {0};
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
        if (relnav_widen(&h, frame->h, COLUMNS, at) != RELNAV_OK || relnav_widen(&y, frame->y, 1, at) != RELNAV_OK) {
            *row = at;
            return RELNAV_NOT_FINITE;
        }
    }
    error = relnav_choose_frac(&h, wanted_h, &scale->frac_h);
    if (error != RELNAV_OK) {
        *row = h.row;
        return error;
    }
    error = relnav_choose_frac(&y, wanted_y, &scale->frac_y);
    if (error != RELNAV_OK) {
        *row = y.row;
        return error;
    }
    return relnav_weight_scale(frame->w, frame->count, &scale->weight_scale, row);
}

relnav_error ivisnav_configure(ivisnav *device, double variance, const ivisnav_scale *scale)
{
    uint32_t word;
    relnav_error error = device == NULL ? RELNAV_NULL : check_scale(scale);

    if (error == RELNAV_OK) {
        error = relnav_variance_word(variance, scale->weight_scale, &word);
    }
    return error == RELNAV_OK ? relnav_set(&device->core, 0, frac_word(scale), word, scale->weight_scale) : error;
}

size_t ivisnav_beats(const ivisnav_frame *frame)
{
    return frame->count * ROW_BEATS;
}

static relnav_error row_beats(const ivisnav_frame *frame, const ivisnav_scale *scale, size_t row, uint64_t beats[ROW_BEATS])
{
    int32_t fixed;
    uint32_t weight;
    relnav_error error = RELNAV_OK;
    size_t i;

    memset(beats, 0, ROW_BEATS * sizeof *beats);
    for (i = 0; error == RELNAV_OK && i < COLUMNS; i++) {
        error = relnav_to_fixed(relnav_real(frame->h, COLUMNS * row + i), scale->frac_h, &fixed);
        if (error == RELNAV_OK) {
            beats[i / 2] |= (uint64_t)(uint32_t)fixed << 32 * (i % 2);
        }
    }
    if (error == RELNAV_OK) {
        error = relnav_to_fixed(relnav_real(frame->y, row), scale->frac_y, &fixed);
    }
    if (error == RELNAV_OK) {
        error = relnav_weight(frame->w, row, scale->weight_scale, &weight);
    }
    if (error == RELNAV_OK) {
        beats[COLUMNS / 2] = (uint64_t)weight << 32 | (uint32_t)fixed;
    }
    return error;
}

relnav_error ivisnav_fill(const ivisnav_frame *frame, const ivisnav_scale *scale, uint64_t *beats, size_t capacity)
{
    relnav_error error = beats == NULL ? RELNAV_NULL : check_scaled(frame, scale);
    size_t row;

    if (error == RELNAV_OK && (uintptr_t)beats % sizeof *beats != 0) {
        error = RELNAV_MISALIGNED;
    }
    if (error == RELNAV_OK && ivisnav_beats(frame) > capacity) {
        error = RELNAV_NO_SPACE;
    }
    for (row = 0; error == RELNAV_OK && row < frame->count; row++) {
        error = row_beats(frame, scale, row, beats + ROW_BEATS * row);
    }
    return error;
}

relnav_error ivisnav_push_frame(ivisnav *device, const ivisnav_frame *frame, const ivisnav_scale *scale)
{
    relnav_error error = device == NULL ? RELNAV_NULL : check_scaled(frame, scale);
    size_t row;

    if (error == RELNAV_OK) {
        error = relnav_check_set(&device->core, 0, 0, frac_word(scale), scale->weight_scale);
    }
    if (error == RELNAV_OK) {
        error = relnav_begin_push(&device->core);
    }
    for (row = 0; error == RELNAV_OK && row < frame->count; row++) {
        uint64_t beats[ROW_BEATS];

        error = row_beats(frame, scale, row, beats);
        if (error == RELNAV_OK) {
            relnav_push_row(&device->core, beats, ROW_BEATS, row + 1 == frame->count);
        } else {
            relnav_soft_reset(&device->core);
        }
    }
    return error == RELNAV_OK ? relnav_end_push(&device->core) : error;
}

relnav_error ivisnav_read_raw(const ivisnav *device, ivisnav_raw *raw)
{
    const relnav_core *core;
    relnav_error error;

    if (device == NULL || raw == NULL) {
        return RELNAV_NULL;
    }
    core = &device->core;
    error = relnav_read_twice(core, offsetof(ivisnav_registers, FRAME_FLAGS), 1, &raw->flags);
    if (error == RELNAV_OK) {
        error = relnav_read_twice(core, offsetof(ivisnav_registers, ROWS), sizeof raw->head / sizeof(uint32_t), raw->head);
    }
    if (error == RELNAV_OK) {
        error = relnav_read_twice(core, offsetof(ivisnav_registers, CYCLES_ALL), 1, &raw->cycles_all);
    }
    if (error == RELNAV_OK) {
        error = relnav_read_twice(core, offsetof(ivisnav_registers, V), sizeof raw->words / sizeof(uint32_t), raw->words);
    }
    return error == RELNAV_OK ? relnav_confirm(core) : error;
}

relnav_error ivisnav_read(const ivisnav *device, ivisnav_result *result)
{
    ivisnav_raw raw;
    relnav_error error;
    double scale;

    if (result == NULL) {
        return RELNAV_NULL;
    }
    memset(result, 0, sizeof *result);
    error = ivisnav_read_raw(device, &raw);
    if (error != RELNAV_OK) {
        return error;
    }
    scale = device->core.weight_scale;
    result->flags = raw.flags;
    result->count = raw.head[HEAD(ROWS)];
    result->weight = (double)raw.head[HEAD(WEIGHT)] / scale;
    result->condition = relnav_sqrt((double)relnav_float(raw.head[HEAD(CONDITION)]));
    result->cycles_rates = raw.head[HEAD(CYCLES_RATES)];
    result->cycles_all = raw.cycles_all;
    relnav_copy_floats(result->v, &raw.words[WORD(V)], 3);
    relnav_copy_floats(result->omega, &raw.words[WORD(OMEGA)], 3);
    result->rss = (double)relnav_float(raw.words[WORD(RSS)]) / scale;
    relnav_copy_floats(result->covariance, &raw.words[WORD(COV)], 21);
    return RELNAV_OK;
}

relnav_error ivisnav_solve(ivisnav *device, const ivisnav_frame *frame, double variance, uint32_t polls, ivisnav_result *result)
{
    ivisnav_scale scale;
    relnav_error error;

    if (result == NULL) {
        return RELNAV_NULL;
    }
    memset(result, 0, sizeof *result);
    error = ivisnav_choose(frame, RELNAV_FRAC_AUTO, RELNAV_FRAC_AUTO, &scale, NULL);
    if (error == RELNAV_OK) {
        error = ivisnav_configure(device, variance, &scale);
    }
    if (error == RELNAV_OK) {
        error = ivisnav_push_frame(device, frame, &scale);
    }
    if (error != RELNAV_OK) {
        return error;
    }
    error = relnav_wait(&device->core, polls);
    if (error != RELNAV_OK) {
        result->flags = relnav_frame_flags(&device->core);
        if (error == RELNAV_ILL_CONDITIONED) {
            uint32_t square = RELNAV_READ(&device->core.port, ivisnav_registers, CONDITION);

            result->condition = relnav_sqrt((double)relnav_float(square));
        }
        return relnav_settle(&device->core, error);
    }
    error = relnav_settle(&device->core, ivisnav_read(device, result));
    return error == RELNAV_OK && result->count != frame->count ? RELNAV_WRONG_FRAME : error;
}
