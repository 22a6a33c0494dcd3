/* SPDX-License-Identifier: Apache-2.0
 * Written by `python -m relnav.regtool` from registers/ivisnav.rdl; do not edit. */
#ifndef IVISNAV_REGISTERS_H
#define IVISNAV_REGISTERS_H

#include <stddef.h>
#include <stdint.h>

/* iVisNav registers, at IVISNAV_AT(base address). const members are read-only. */
typedef volatile struct {
    const uint32_t ID;                /* 0x000 ro  Identity */
    const uint32_t VERSION;           /* 0x004 ro  Version */
    const uint32_t BUILD;             /* 0x008 ro  Build */
    uint32_t CONTROL;                 /* 0x00C wo  Control */
    const uint32_t STATUS;            /* 0x010 ro  Status */
    uint32_t FLAGS;                   /* 0x014 w1c Flags */
    const uint32_t FRAME_FLAGS;       /* 0x018 ro  Flags of the last frame */
    uint32_t IRQ_ENABLE;              /* 0x01C rw  Interrupt enable */
    uint32_t IRQ_STATUS;              /* 0x020 w1c Interrupt status */
    const uint32_t reserved_024[1];
    uint32_t FRAC;                    /* 0x028 rw  Binary points */
    uint32_t VARIANCE;                /* 0x02C rw  Variance */
    const uint32_t reserved_030[4];
    uint32_t DATA_A;                  /* 0x040 rw  Beat, low word */
    uint32_t DATA_B;                  /* 0x044 rw  Beat, high word */
    uint32_t PUSH;                    /* 0x048 wo  Push */
    const uint32_t reserved_04c[5];
    const uint32_t ROWS;              /* 0x060 ro  Rows */
    const uint32_t WEIGHT;            /* 0x064 ro  Weight */
    const uint32_t CONDITION;         /* 0x068 ro  Condition */
    const uint32_t CYCLES_RATES;      /* 0x06C ro  Cycles to v and omega */
    const uint32_t reserved_070[1];
    const uint32_t CYCLES_ALL;        /* 0x074 ro  Cycles to all */
    const uint32_t reserved_078[34];
    const uint32_t V[3];              /* 0x100 ro  v */
    const uint32_t OMEGA[3];          /* 0x10C ro  omega */
    const uint32_t RSS;               /* 0x118 ro  Residual sum of squares */
    const uint32_t COV[21];           /* 0x11C ro  Covariance */
} ivisnav_registers;

#define IVISNAV_AT(base) ((ivisnav_registers *)(uintptr_t)(base))

#define IVISNAV_ID_VALUE UINT32_C(0x49564953)
#define IVISNAV_VERSION_VALUE UINT32_C(0x00000100)
#define IVISNAV_VERSION_PATCH UINT32_C(0x000000FF) /* patch */
#define IVISNAV_VERSION_PATCH_SHIFT 0
#define IVISNAV_VERSION_MINOR UINT32_C(0x0000FF00) /* minor */
#define IVISNAV_VERSION_MINOR_SHIFT 8
#define IVISNAV_VERSION_MAJOR UINT32_C(0x00FF0000) /* major */
#define IVISNAV_VERSION_MAJOR_SHIFT 16
#define IVISNAV_BUILD_VERIFY UINT32_C(0x00000008) /* results are verified by a second pass */
#define IVISNAV_BUILD_MANTISSA UINT32_C(0x0000FF00) /* bits of a mantissa */
#define IVISNAV_BUILD_MANTISSA_SHIFT 8
#define IVISNAV_CONTROL_SOFT_RESET UINT32_C(0x00000001) /* drop the frame at hand and any waiting push */
#define IVISNAV_CONTROL_ACKNOWLEDGE UINT32_C(0x00000002) /* DONE back to IDLE */
#define IVISNAV_STATUS_STATE UINT32_C(0x00000007) /* state machine */
#define IVISNAV_STATUS_STATE_SHIFT 0
#define IVISNAV_STATUS_BUSY UINT32_C(0x00000010) /* SEND_DATA, COMPUTE or VERIFY */
#define IVISNAV_STATUS_RATES_READY UINT32_C(0x00000020) /* v and omega of the last frame started can be read */
#define IVISNAV_STATUS_ALL_READY UINT32_C(0x00000080) /* covariance and rss can be read */
#define IVISNAV_STATUS_PUSH_READY UINT32_C(0x00000100) /* a PUSH would be taken */
#define IVISNAV_STATUS_FRAME UINT32_C(0xFFFF0000) /* frames completed, wraps */
#define IVISNAV_STATUS_FRAME_SHIFT 16
#define IVISNAV_FLAGS_FEW_ROWS UINT32_C(0x00000001) /* fewer than six rows */
#define IVISNAV_FLAGS_RANK_DEFICIENT UINT32_C(0x00000002) /* rows that do not span six dimensions */
#define IVISNAV_FLAGS_ZERO_WEIGHT UINT32_C(0x00000004) /* all weights are zero */
#define IVISNAV_FLAGS_TOO_LONG UINT32_C(0x00000008) /* more than 65535 rows */
#define IVISNAV_FLAGS_BAD_TLAST UINT32_C(0x00000010) /* last beat inside a row */
#define IVISNAV_FLAGS_BUSY_WRITE UINT32_C(0x00000020) /* a write to FRAC or VARIANCE of a busy core, or to DATA_A, DATA_B or PUSH while a push could not be taken */
#define IVISNAV_FLAGS_ILL_CONDITIONED UINT32_C(0x00000080) /* conditioning beyond what the arithmetic carries */
#define IVISNAV_FLAGS_WATCHDOG UINT32_C(0x00000100) /* the state machine was stuck and returned to IDLE */
#define IVISNAV_FLAGS_UPSET UINT32_C(0x00000400) /* a protection noticed an upset of the logic */
#define IVISNAV_FRAME_FLAGS_FEW_ROWS UINT32_C(0x00000001) /* fewer than six rows */
#define IVISNAV_FRAME_FLAGS_RANK_DEFICIENT UINT32_C(0x00000002) /* rows that do not span six dimensions */
#define IVISNAV_FRAME_FLAGS_ZERO_WEIGHT UINT32_C(0x00000004) /* all weights are zero */
#define IVISNAV_FRAME_FLAGS_TOO_LONG UINT32_C(0x00000008) /* more than 65535 rows */
#define IVISNAV_FRAME_FLAGS_BAD_TLAST UINT32_C(0x00000010) /* last beat inside a row */
#define IVISNAV_FRAME_FLAGS_BUSY_WRITE UINT32_C(0x00000020) /* a write to FRAC or VARIANCE of a busy core, or to DATA_A, DATA_B or PUSH while a push could not be taken */
#define IVISNAV_FRAME_FLAGS_ILL_CONDITIONED UINT32_C(0x00000080) /* conditioning beyond what the arithmetic carries */
#define IVISNAV_FRAME_FLAGS_WATCHDOG UINT32_C(0x00000100) /* the state machine was stuck and returned to IDLE */
#define IVISNAV_FRAME_FLAGS_UPSET UINT32_C(0x00000400) /* a protection noticed an upset of the logic */
#define IVISNAV_IRQ_ENABLE_DONE UINT32_C(0x00000001) /* on a completed frame */
#define IVISNAV_IRQ_ENABLE_ERROR UINT32_C(0x00000002) /* on any flag */
#define IVISNAV_IRQ_STATUS_DONE UINT32_C(0x00000001) /* a frame was completed */
#define IVISNAV_IRQ_STATUS_ERROR UINT32_C(0x00000002) /* a flag was raised */
#define IVISNAV_FRAC_FRAC_H UINT32_C(0x000000FF) /* of h */
#define IVISNAV_FRAC_FRAC_H_SHIFT 0
#define IVISNAV_FRAC_FRAC_Y UINT32_C(0x0000FF00) /* of y */
#define IVISNAV_FRAC_FRAC_Y_SHIFT 8
#define IVISNAV_PUSH_LAST UINT32_C(0x00000001) /* last beat of the frame */
#define IVISNAV_ROWS_VALUE UINT32_C(0x0000FFFF) /* n */
#define IVISNAV_ROWS_VALUE_SHIFT 0
#define IVISNAV_CYCLES_RATES_VALUE UINT32_C(0x0000FFFF) /* clock cycles */
#define IVISNAV_CYCLES_RATES_VALUE_SHIFT 0
#define IVISNAV_CYCLES_ALL_VALUE UINT32_C(0x0000FFFF) /* clock cycles */
#define IVISNAV_CYCLES_ALL_VALUE_SHIFT 0

enum {
    IVISNAV_STATE_IDLE = 0, /* no frame open, no result waiting */
    IVISNAV_STATE_SEND_DATA = 1, /* a frame is open */
    IVISNAV_STATE_COMPUTE = 2, /* the frame is complete and being solved */
    IVISNAV_STATE_DONE = 3, /* all results stand and are verified; held until acknowledged or the next frame's first beat */
    IVISNAV_STATE_VERIFY = 4, /* all results stand; they are computed a second time and compared */
};

/* The compiler stops here when the struct is not laid out as the hardware is. */
typedef char ivisnav_layout[(
    offsetof(ivisnav_registers, ID) == 0x000 &&
    offsetof(ivisnav_registers, VERSION) == 0x004 &&
    offsetof(ivisnav_registers, BUILD) == 0x008 &&
    offsetof(ivisnav_registers, CONTROL) == 0x00C &&
    offsetof(ivisnav_registers, STATUS) == 0x010 &&
    offsetof(ivisnav_registers, FLAGS) == 0x014 &&
    offsetof(ivisnav_registers, FRAME_FLAGS) == 0x018 &&
    offsetof(ivisnav_registers, IRQ_ENABLE) == 0x01C &&
    offsetof(ivisnav_registers, IRQ_STATUS) == 0x020 &&
    offsetof(ivisnav_registers, FRAC) == 0x028 &&
    offsetof(ivisnav_registers, VARIANCE) == 0x02C &&
    offsetof(ivisnav_registers, DATA_A) == 0x040 &&
    offsetof(ivisnav_registers, DATA_B) == 0x044 &&
    offsetof(ivisnav_registers, PUSH) == 0x048 &&
    offsetof(ivisnav_registers, ROWS) == 0x060 &&
    offsetof(ivisnav_registers, WEIGHT) == 0x064 &&
    offsetof(ivisnav_registers, CONDITION) == 0x068 &&
    offsetof(ivisnav_registers, CYCLES_RATES) == 0x06C &&
    offsetof(ivisnav_registers, CYCLES_ALL) == 0x074 &&
    offsetof(ivisnav_registers, V) == 0x100 &&
    offsetof(ivisnav_registers, OMEGA) == 0x10C &&
    offsetof(ivisnav_registers, RSS) == 0x118 &&
    offsetof(ivisnav_registers, COV) == 0x11C &&
    sizeof(ivisnav_registers) == 0x170
) ? 1 : -1];

#endif
