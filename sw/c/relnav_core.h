/* SPDX-License-Identifier: Apache-2.0
 *
 * What the drivers of both cores share: access to the registers, identity, interrupts, frames, waiting, errors.
 * No heap, no libc but <stdint.h>, <stddef.h>, <string.h>. One core, one thread; only relnav_take_interrupt() is for the handler.
 *
 * Registers are reached through a base address. With RELNAV_CALLBACKS defined (for every file alike) a port may instead have a
 * pair of functions: a simulator, a mock, a bus that is not memory.
 */
#ifndef RELNAV_CORE_H
#define RELNAV_CORE_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/** What a function has to say; relnav_error_text() says it in words. */
typedef enum {
    RELNAV_OK = 0,
    RELNAV_PENDING, /**< the frame is not solved yet */

    /* the core gave the frame up: a flag of FLAGS */
    RELNAV_TOO_FEW,
    RELNAV_RANK_DEFICIENT,
    RELNAV_ZERO_WEIGHT,
    RELNAV_TOO_LONG,
    RELNAV_BAD_TLAST,
    RELNAV_ILL_CONDITIONED,
    RELNAV_WATCHDOG, /**< recover: relnav_recover() */
    RELNAV_UPSET,    /**< likewise */

    /* between the processor and the core */
    RELNAV_NO_CORE, /**< an address with nothing behind it may abort the processor instead */
    RELNAV_WRONG_VERSION,
    RELNAV_NOT_BUILT,
    RELNAV_BUSY,
    RELNAV_NOT_TAKEN,
    RELNAV_TIMEOUT,
    RELNAV_UNSTEADY,
    RELNAV_WRONG_FRAME,

    /* what the caller gave */
    RELNAV_NULL,
    RELNAV_MISALIGNED,
    RELNAV_WRONG_SCALE,
    RELNAV_EMPTY,
    RELNAV_NOT_FINITE,
    RELNAV_TOO_LARGE,
    RELNAV_TOO_SMALL,
    RELNAV_BAD_FRAC,
    RELNAV_BAD_WEIGHT,
    RELNAV_SMALL_WEIGHTS,
    RELNAV_LOST_WEIGHT,
    RELNAV_BAD_VARIANCE,
    RELNAV_ZERO_DIRECTION,
    RELNAV_NO_SPACE,

    RELNAV_ERRORS /**< how many there are */
} relnav_error;

/** One line of English, never NULL. */
const char *relnav_error_text(relnav_error error);

/* ------------------------------------------------------------------------------------------------ access */

/** Where a core's registers are. read, write: both or neither; with both, base is not looked at. They get context, which is the
 * caller's own, and the byte offset of a register, below 4096; a write is over when write returns. */
typedef struct {
    volatile uint32_t *base;
#ifdef RELNAV_CALLBACKS
    uint32_t (*read)(void *context, uint32_t offset);
    void (*write)(void *context, uint32_t offset, uint32_t word);
    void *context;
#endif
} relnav_port;

/** The port of a memory-mapped core; the address, a multiple of 4, must be mapped as device memory. */
static inline relnav_port relnav_at(uintptr_t base)
{
    relnav_port port = {0};
    port.base = (volatile uint32_t *)base;
    return port;
}

/** The register at a byte offset. */
static inline uint32_t relnav_read(const relnav_port *port, size_t offset)
{
#ifdef RELNAV_CALLBACKS
    if (port->read != NULL) {
        return port->read(port->context, (uint32_t)offset);
    }
#endif
    return port->base[offset / sizeof(uint32_t)];
}

/** Write the register at a byte offset. */
static inline void relnav_write(const relnav_port *port, size_t offset, uint32_t word)
{
#ifdef RELNAV_CALLBACKS
    if (port->write != NULL) {
        port->write(port->context, (uint32_t)offset, word);
        return;
    }
#endif
    port->base[offset / sizeof(uint32_t)] = word;
}

/** Registers by their names in a generated header; writing one that is read-only, a const member, does not compile. */
#define RELNAV_READ(port, map, name) relnav_read((port), offsetof(map, name))
#define RELNAV_WRITE(port, map, name, word) \
    ((void)sizeof(((map *)0)->name = 0u), relnav_write((port), offsetof(map, name), (word)))

/* ------------------------------------------------------------------------------------------------- cores */

/** What every core has. Set by the core's init function, not to be written by the caller. */
typedef struct {
    relnav_port port;
    uint32_t build;         /**< BUILD: OLTAE_BUILD_... */
    uint32_t failures;      /**< flags that end a frame without a result */
    uint32_t config_offset; /**< of CONFIG; 0: the core has none */
    uint32_t config;        /**< CONFIG, FRAC and VARIANCE as configured */
    uint32_t frac;
    uint32_t variance;
    double weight_scale; /**< of the frames as configured */
    uint32_t frame;      /**< STATUS.FRAME before the frame at hand */
} relnav_core;

/** Events of the interrupt. */
enum {
    RELNAV_DONE = 1, /**< a frame was completed */
    RELNAV_ERROR = 2 /**< a flag was raised */
};

/** What the core's init function does: check ID and VERSION (major and minor), read BUILD. Nothing is written.
 * core: failures and config_offset set, all else 0. RELNAV_NULL (a port without address or functions), RELNAV_MISALIGNED,
 * RELNAV_NO_CORE, RELNAV_WRONG_VERSION. */
relnav_error relnav_identify(relnav_core *core, uint32_t id, uint32_t version);

/** The registers STATUS, FLAGS (sticky) and FRAME_FLAGS (of the last frame): see OLTAE_STATUS_..., OLTAE_FLAGS_... */
uint32_t relnav_status(const relnav_core *core);
uint32_t relnav_flags(const relnav_core *core);
uint32_t relnav_frame_flags(const relnav_core *core);
void relnav_clear_flags(const relnav_core *core, uint32_t bits);

/** The events of RELNAV_DONE | RELNAV_ERROR that raise the interrupt; 0: none. Pending ones are kept. */
void relnav_enable_interrupts(const relnav_core *core, uint32_t events);

/** For the handler: the events that are pending; clears them, and so the interrupt line falls. */
uint32_t relnav_take_interrupt(const relnav_core *core);

/** State DONE back to IDLE. Not needed before the next frame, and not before relnav_poll() has seen DONE. */
void relnav_acknowledge(const relnav_core *core);

/** Drop the frame at hand; configuration, flags and results stay. Stop a DMA first. */
void relnav_soft_reset(const relnav_core *core);

/** After RELNAV_WATCHDOG, RELNAV_UPSET or RELNAV_TIMEOUT, and where the core stays RELNAV_BUSY: its watchdog ends COMPUTE and VERIFY,
 * but waits for ever in LOAD for the rest of a frame, such as that of a program that was restarted. Soft reset, flags and interrupts
 * cleared, the configuration written again. Stop a DMA first; the frame has to be given again. RELNAV_NOT_TAKEN, RELNAV_NO_CORE. */
relnav_error relnav_recover(const relnav_core *core);

/** relnav_recover() after one of the first three errors, nothing after any other. Returns the error. */
relnav_error relnav_settle(const relnav_core *core, relnav_error error);

/** Set CONFIG (where there is one), FRAC and VARIANCE, as register words. RELNAV_BUSY while a frame is open, RELNAV_NOT_TAKEN;
 * RELNAV_NO_CORE instead of either where ID is no core's any more. */
relnav_error relnav_set(relnav_core *core, uint32_t config, uint32_t frac, uint32_t variance, double weight_scale);

/* ------------------------------------------------------------------------------------------------ frames */

/** Before a frame's first beat, and before a DMA is started: clears the sticky flags. RELNAV_BUSY while a frame is open (RELNAV_NO_CORE
 * where ID is no core's any more); RELNAV_UPSET where the core noticed one since it was configured; RELNAV_NOT_TAKEN where a flag stays. */
relnav_error relnav_begin(relnav_core *core);

/** relnav_begin() for a frame by relnav_push(): RELNAV_BUSY also where no push would be taken. */
relnav_error relnav_begin_push(relnav_core *core);

/** One beat by the registers; last ends the frame. No look at PUSH_READY is needed in between. */
void relnav_push(const relnav_core *core, uint64_t beat, int last);

/** After the last push of a frame: RELNAV_NOT_TAKEN where the core refused a write (BUSY_WRITE), so that its frame is another one. It is
 * dropped. Not where a flag gives the frame up already. */
relnav_error relnav_end_push(const relnav_core *core);

/** The beats of one point or row; last: no other follows. */
void relnav_push_row(const relnav_core *core, const uint64_t *beats, size_t count, int last);

/** Look once at the frame that was begun: RELNAV_OK when it is solved (and verified), RELNAV_PENDING, or why it failed. */
relnav_error relnav_poll(const relnav_core *core);

/** relnav_poll() until there is an answer, polls times at most: RELNAV_TIMEOUT. A poll reads two registers or more. After its last beat a
 * frame is solved, or given up by the core's watchdog, within 4200 clocks: 1000 polls are plenty where a reading takes three or more. */
relnav_error relnav_wait(const relnav_core *core, uint32_t polls);

/** The error that flags stand for; RELNAV_OK for flags that leave a result. */
relnav_error relnav_failure(const relnav_core *core, uint32_t flags);

/** Read count registers from offset first, each twice; RELNAV_UNSTEADY where two readings never agree. */
relnav_error relnav_read_twice(const relnav_core *core, size_t first, size_t count, uint32_t *words);

/** Whether the words just read are a result: what FLAGS say, or RELNAV_PENDING where the frame begun is not completed. */
relnav_error relnav_confirm(const relnav_core *core);

/** RELNAV_WRONG_SCALE where CONFIG's bits under mask, FRAC or the weights' scale are configured otherwise. */
relnav_error relnav_check_set(const relnav_core *core, uint32_t config, uint32_t mask, uint32_t frac, double weight_scale);

#ifdef __cplusplus
}
#endif

#endif
