/* SPDX-License-Identifier: Apache-2.0 */
#include "relnav_core.h"

#include "ivisnav_registers.h"
#include "oltae_registers.h"

/* This file goes by the names of OLTAE's registers. The compiler stops here when iVisNav's lie elsewhere. */
typedef oltae_registers shared_registers;

#define SAME_PLACE(name) (offsetof(oltae_registers, name) == offsetof(ivisnav_registers, name))

typedef char shared_layout[(
    SAME_PLACE(ID) && SAME_PLACE(VERSION) && SAME_PLACE(BUILD) && SAME_PLACE(CONTROL) && SAME_PLACE(STATUS) &&
    SAME_PLACE(FLAGS) && SAME_PLACE(FRAME_FLAGS) && SAME_PLACE(IRQ_ENABLE) && SAME_PLACE(IRQ_STATUS) && SAME_PLACE(FRAC) &&
    SAME_PLACE(VARIANCE) && SAME_PLACE(DATA_A) && SAME_PLACE(DATA_B) && SAME_PLACE(PUSH) &&
    OLTAE_CONTROL_SOFT_RESET == IVISNAV_CONTROL_SOFT_RESET && OLTAE_CONTROL_ACKNOWLEDGE == IVISNAV_CONTROL_ACKNOWLEDGE &&
    OLTAE_STATUS_BUSY == IVISNAV_STATUS_BUSY && OLTAE_STATUS_PUSH_READY == IVISNAV_STATUS_PUSH_READY &&
    OLTAE_STATUS_STATE == IVISNAV_STATUS_STATE && OLTAE_STATUS_ALL_READY == IVISNAV_STATUS_ALL_READY &&
    OLTAE_STATUS_FRAME == IVISNAV_STATUS_FRAME && OLTAE_PUSH_LAST == IVISNAV_PUSH_LAST &&
    (int)OLTAE_STATE_DONE == (int)IVISNAV_STATE_DONE &&
    OLTAE_IRQ_STATUS_DONE == IVISNAV_IRQ_STATUS_DONE && OLTAE_IRQ_STATUS_ERROR == IVISNAV_IRQ_STATUS_ERROR &&
    OLTAE_FLAGS_FEW_POINTS == IVISNAV_FLAGS_FEW_ROWS && OLTAE_FLAGS_RANK_DEFICIENT == IVISNAV_FLAGS_RANK_DEFICIENT &&
    OLTAE_FLAGS_ZERO_WEIGHT == IVISNAV_FLAGS_ZERO_WEIGHT && OLTAE_FLAGS_TOO_LONG == IVISNAV_FLAGS_TOO_LONG &&
    OLTAE_FLAGS_BAD_TLAST == IVISNAV_FLAGS_BAD_TLAST && OLTAE_FLAGS_BUSY_WRITE == IVISNAV_FLAGS_BUSY_WRITE && OLTAE_FLAGS_ILL_CONDITIONED == IVISNAV_FLAGS_ILL_CONDITIONED &&
    OLTAE_FLAGS_WATCHDOG == IVISNAV_FLAGS_WATCHDOG && OLTAE_FLAGS_UPSET == IVISNAV_FLAGS_UPSET &&
    OLTAE_IRQ_STATUS_DONE == RELNAV_DONE && OLTAE_IRQ_STATUS_ERROR == RELNAV_ERROR
) ? 1 : -1];

#define READ(core, name) RELNAV_READ(&(core)->port, shared_registers, name)
#define WRITE(core, name, word) RELNAV_WRITE(&(core)->port, shared_registers, name, word)

enum { READINGS = 3 }; /* pairs of readings before the bus counts as unsound */

const char *relnav_error_text(relnav_error error)
{
    static const char *const texts[RELNAV_ERRORS] = {
        [RELNAV_OK] = "ok",
        [RELNAV_PENDING] = "the frame is not solved yet",
        [RELNAV_TOO_FEW] = "too few points or rows",
        [RELNAV_RANK_DEFICIENT] = "the geometry leaves the result undetermined",
        [RELNAV_ZERO_WEIGHT] = "all weights are zero",
        [RELNAV_TOO_LONG] = "more than 65535 points or rows",
        [RELNAV_BAD_TLAST] = "the last beat came inside a point or row",
        [RELNAV_ILL_CONDITIONED] = "conditioning beyond what the arithmetic carries",
        [RELNAV_WATCHDOG] = "the core's state machine was stuck",
        [RELNAV_UPSET] = "the core noticed an upset of its logic",
        [RELNAV_NO_CORE] = "no such core at this address",
        [RELNAV_WRONG_VERSION] = "the core has another version than the driver",
        [RELNAV_NOT_BUILT] = "the core was built without what the configuration asks for",
        [RELNAV_BUSY] = "the core is busy: a frame is open; to drop it, stop the DMA and recover",
        [RELNAV_NOT_TAKEN] = "the core did not take what was written to it",
        [RELNAV_TIMEOUT] = "no result after the given number of polls",
        [RELNAV_UNSTEADY] = "two readings of a result never agree",
        [RELNAV_WRONG_FRAME] = "the result is not of the frame that was given",
        [RELNAV_NULL] = "a pointer or an array is missing",
        [RELNAV_MISALIGNED] = "an address is not aligned: 4 bytes for registers, 8 for beats",
        [RELNAV_WRONG_SCALE] = "the scale is not that of the frame, or not the one configured",
        [RELNAV_EMPTY] = "a frame without points or rows",
        [RELNAV_NOT_FINITE] = "a value is not finite",
        [RELNAV_TOO_LARGE] = "a value does not fit 32 bits at this binary point, or at any from -64 to 95",
        [RELNAV_TOO_SMALL] = "the largest value has less than 24 bits at binary point 95",
        [RELNAV_BAD_FRAC] = "a binary point outside -64 to 95",
        [RELNAV_BAD_WEIGHT] = "a weight is negative or not finite",
        [RELNAV_SMALL_WEIGHTS] = "the largest weight is too small to scale",
        [RELNAV_LOST_WEIGHT] = "a positive weight would round to 0 in 16 bits",
        [RELNAV_BAD_VARIANCE] = "the variance is negative, or at unit integer weight not a normal binary32 number",
        [RELNAV_ZERO_DIRECTION] = "a direction is zero",
        [RELNAV_NO_SPACE] = "the buffer is too short",
    };
    size_t index = (size_t)error;

    return index < RELNAV_ERRORS ? texts[index] : "unknown error";
}

static relnav_error check_port(const relnav_port *port)
{
#ifdef RELNAV_CALLBACKS
    if (port->read != NULL && port->write != NULL) {
        return RELNAV_OK;
    }
    if (port->read != NULL || port->write != NULL) {
        return RELNAV_NULL;
    }
#endif
    if (port->base == NULL) {
        return RELNAV_NULL;
    }
    return (uintptr_t)port->base % sizeof(uint32_t) == 0 ? RELNAV_OK : RELNAV_MISALIGNED;
}

/** What an answer that no working core gives means: the error, or RELNAV_NO_CORE where none answers any more. */
static relnav_error unless_gone(const relnav_core *core, relnav_error error)
{
    uint32_t id = READ(core, ID);

    return id == OLTAE_ID_VALUE || id == IVISNAV_ID_VALUE ? error : RELNAV_NO_CORE;
}

relnav_error relnav_identify(relnav_core *core, uint32_t id, uint32_t version)
{
    relnav_error error = check_port(&core->port);

    if (error != RELNAV_OK) {
        return error;
    }
    if (READ(core, ID) != id) {
        return RELNAV_NO_CORE;
    }
    /* patches keep the registers */
    if (READ(core, VERSION) >> OLTAE_VERSION_MINOR_SHIFT != version >> OLTAE_VERSION_MINOR_SHIFT) {
        return RELNAV_WRONG_VERSION;
    }
    core->build = READ(core, BUILD);
    core->weight_scale = 1.0;
    return RELNAV_OK;
}

uint32_t relnav_status(const relnav_core *core)
{
    return READ(core, STATUS);
}

uint32_t relnav_flags(const relnav_core *core)
{
    return READ(core, FLAGS);
}

uint32_t relnav_frame_flags(const relnav_core *core)
{
    return READ(core, FRAME_FLAGS);
}

void relnav_clear_flags(const relnav_core *core, uint32_t bits)
{
    WRITE(core, FLAGS, bits);
}

void relnav_enable_interrupts(const relnav_core *core, uint32_t events)
{
    WRITE(core, IRQ_ENABLE, events);
}

uint32_t relnav_take_interrupt(const relnav_core *core)
{
    uint32_t events = READ(core, IRQ_STATUS);

    WRITE(core, IRQ_STATUS, events);
    (void)READ(core, IRQ_STATUS); /* the write has arrived, the line is low: no second interrupt when the handler ends */
    return events;
}

void relnav_acknowledge(const relnav_core *core)
{
    WRITE(core, CONTROL, OLTAE_CONTROL_ACKNOWLEDGE);
}

void relnav_soft_reset(const relnav_core *core)
{
    WRITE(core, CONTROL, OLTAE_CONTROL_SOFT_RESET);
}

static relnav_error write_set(const relnav_core *core)
{
    uint32_t config = core->config;

    if (core->config_offset != 0) {
        relnav_write(&core->port, core->config_offset, config);
        config = relnav_read(&core->port, core->config_offset);
    }
    WRITE(core, FRAC, core->frac);
    WRITE(core, VARIANCE, core->variance);
    relnav_clear_flags(core, OLTAE_FLAGS_UPSET); /* of a configuration that is no more */
    if (config != core->config || READ(core, FRAC) != core->frac || READ(core, VARIANCE) != core->variance) {
        return unless_gone(core, RELNAV_NOT_TAKEN);
    }
    return RELNAV_OK;
}

relnav_error relnav_recover(const relnav_core *core)
{
    relnav_soft_reset(core);
    relnav_clear_flags(core, UINT32_MAX);
    (void)relnav_take_interrupt(core);
    return write_set(core);
}

relnav_error relnav_settle(const relnav_core *core, relnav_error error)
{
    if (error == RELNAV_WATCHDOG || error == RELNAV_UPSET || error == RELNAV_TIMEOUT) {
        (void)relnav_recover(core); /* where that fails, the next configuration says so */
    }
    return error;
}

relnav_error relnav_set(relnav_core *core, uint32_t config, uint32_t frac, uint32_t variance, double weight_scale)
{
    if ((relnav_status(core) & OLTAE_STATUS_BUSY) != 0) {
        return unless_gone(core, RELNAV_BUSY);
    }
    core->config = config;
    core->frac = frac;
    core->variance = variance;
    core->weight_scale = weight_scale;
    return write_set(core);
}

relnav_error relnav_begin(relnav_core *core)
{
    uint32_t status = relnav_status(core);

    if ((status & OLTAE_STATUS_BUSY) != 0) {
        return unless_gone(core, RELNAV_BUSY);
    }
    if ((relnav_flags(core) & OLTAE_FLAGS_UPSET) != 0) {
        return RELNAV_UPSET;
    }
    relnav_clear_flags(core, UINT32_MAX);
    if ((relnav_flags(core) & core->failures) != 0) { /* it would pass for the next frame's */
        return RELNAV_NOT_TAKEN;
    }
    core->frame = status & OLTAE_STATUS_FRAME;
    return RELNAV_OK;
}

relnav_error relnav_begin_push(relnav_core *core)
{
    relnav_error error = relnav_begin(core);

    if (error == RELNAV_OK && (relnav_status(core) & OLTAE_STATUS_PUSH_READY) == 0) {
        error = unless_gone(core, RELNAV_BUSY);
    }
    return error;
}

void relnav_push(const relnav_core *core, uint64_t beat, int last)
{
    WRITE(core, DATA_A, (uint32_t)(beat & UINT32_MAX));
    WRITE(core, DATA_B, (uint32_t)(beat >> 32));
    WRITE(core, PUSH, last ? OLTAE_PUSH_LAST : 0u);
}

void relnav_push_row(const relnav_core *core, const uint64_t *beats, size_t count, int last)
{
    size_t i;

    for (i = 0; i < count; i++) {
        relnav_push(core, beats[i], last && i + 1 == count);
    }
}

relnav_error relnav_end_push(const relnav_core *core)
{
    uint32_t flags = relnav_flags(core);

    /* a frame that the core gave up is relnav_poll()'s: its flag says why nothing more was taken */
    if ((flags & OLTAE_FLAGS_BUSY_WRITE) == 0 || relnav_failure(core, flags) != RELNAV_OK) {
        return RELNAV_OK;
    }
    relnav_soft_reset(core);
    return RELNAV_NOT_TAKEN;
}

relnav_error relnav_failure(const relnav_core *core, uint32_t flags)
{
    static const struct {
        uint16_t flag;
        uint16_t error;
    } failures[] = {/* of several, the first */
        {OLTAE_FLAGS_UPSET, RELNAV_UPSET},
        {OLTAE_FLAGS_WATCHDOG, RELNAV_WATCHDOG},
        {OLTAE_FLAGS_FEW_POINTS, RELNAV_TOO_FEW},
        {OLTAE_FLAGS_RANK_DEFICIENT, RELNAV_RANK_DEFICIENT},
        {OLTAE_FLAGS_ZERO_WEIGHT, RELNAV_ZERO_WEIGHT},
        {OLTAE_FLAGS_TOO_LONG, RELNAV_TOO_LONG},
        {OLTAE_FLAGS_BAD_TLAST, RELNAV_BAD_TLAST},
        {OLTAE_FLAGS_ILL_CONDITIONED, RELNAV_ILL_CONDITIONED},
    };
    size_t i;

    for (i = 0; i < sizeof failures / sizeof failures[0]; i++) {
        if ((flags & core->failures & failures[i].flag) != 0) {
            return (relnav_error)failures[i].error;
        }
    }
    return RELNAV_OK;
}

relnav_error relnav_poll(const relnav_core *core)
{
    uint32_t flags = relnav_flags(core); /* before STATUS: TOO_LONG rises while the frame is still swallowed */
    uint32_t status = relnav_status(core);

    /* Neither can be the frame's before: begin cleared the flags and noted the number of frames completed. What one reading says,
     * the rest of it and a second one must confirm: an upset of the read path must not pass for a result. */
    if ((status & OLTAE_STATUS_FRAME) != core->frame && (status & OLTAE_STATUS_STATE) == OLTAE_STATE_DONE &&
        (status & OLTAE_STATUS_ALL_READY) != 0) {
        return relnav_status(core) == status ? RELNAV_OK : RELNAV_PENDING;
    }
    if ((flags & core->failures) != 0 && (status & OLTAE_STATUS_BUSY) == 0) {
        relnav_error error = relnav_failure(core, flags & relnav_flags(core));

        return error != RELNAV_OK ? error : RELNAV_PENDING;
    }
    return RELNAV_PENDING;
}

relnav_error relnav_wait(const relnav_core *core, uint32_t polls)
{
    while (polls-- > 0) {
        relnav_error error = relnav_poll(core);

        if (error != RELNAV_PENDING) {
            return error;
        }
    }
    return RELNAV_TIMEOUT;
}

relnav_error relnav_read_twice(const relnav_core *core, size_t first, size_t count, uint32_t *words)
{
    unsigned reading;

    for (reading = 0; reading < READINGS; reading++) {
        uint32_t differences = 0;
        size_t i;

        for (i = 0; i < count; i++) {
            words[i] = relnav_read(&core->port, first + sizeof(uint32_t) * i);
        }
        for (i = 0; i < count; i++) {
            differences |= words[i] ^ relnav_read(&core->port, first + sizeof(uint32_t) * i);
        }
        if (differences == 0) {
            return RELNAV_OK;
        }
    }
    return RELNAV_UNSTEADY;
}

relnav_error relnav_confirm(const relnav_core *core)
{
    relnav_error error = relnav_failure(core, relnav_flags(core));
    uint32_t status = relnav_status(core);

    if (error != RELNAV_OK) {
        return error;
    }
    return (status & OLTAE_STATUS_FRAME) != core->frame && (status & OLTAE_STATUS_ALL_READY) != 0 &&
                   (status & OLTAE_STATUS_BUSY) == 0
               ? RELNAV_OK
               : RELNAV_PENDING;
}

relnav_error relnav_check_set(const relnav_core *core, uint32_t config, uint32_t mask, uint32_t frac, double weight_scale)
{
    /* equal, not nearly: it is the same number or another frame's */
    int same = !(weight_scale < core->weight_scale) && !(weight_scale > core->weight_scale);

    return same && frac == core->frac && ((config ^ core->config) & mask) == 0 ? RELNAV_OK : RELNAV_WRONG_SCALE;
}
