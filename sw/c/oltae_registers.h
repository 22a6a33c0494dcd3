/* SPDX-License-Identifier: Apache-2.0
 * Written by `python -m relnav.regtool` from registers/oltae.rdl; do not edit. */
#ifndef OLTAE_REGISTERS_H
#define OLTAE_REGISTERS_H

#include <stddef.h>
#include <stdint.h>

/* OLTAE registers, at OLTAE_AT(base address). const members are read-only. */
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
    uint32_t CONFIG;                  /* 0x024 rw  Configuration */
    uint32_t FRAC;                    /* 0x028 rw  Binary point */
    uint32_t VARIANCE;                /* 0x02C rw  Variance */
    const uint32_t reserved_030[4];
    uint32_t DATA_A;                  /* 0x040 rw  Beat, low word */
    uint32_t DATA_B;                  /* 0x044 rw  Beat, high word */
    uint32_t PUSH;                    /* 0x048 wo  Push */
    const uint32_t reserved_04c[5];
    const uint32_t POINTS;            /* 0x060 ro  Points */
    const uint32_t WEIGHT;            /* 0x064 ro  Weight */
    const uint32_t TURN;              /* 0x068 ro  Turn */
    const uint32_t CYCLES_Q;          /* 0x06C ro  Cycles to q */
    const uint32_t CYCLES_POSE;       /* 0x070 ro  Cycles to R and t */
    const uint32_t CYCLES_ALL;        /* 0x074 ro  Cycles to all */
    const uint32_t reserved_078[34];
    const uint32_t Q[3];              /* 0x100 ro  q */
    const uint32_t Q_FIXED[3];        /* 0x10C ro  q in Q15.16 */
    const uint32_t R[9];              /* 0x118 ro  Rotation */
    const uint32_t T[3];              /* 0x13C ro  Translation */
    const uint32_t RSS;               /* 0x148 ro  Residual sum of squares */
    const uint32_t CONDITION;         /* 0x14C ro  Condition */
    const uint32_t DETERMINANT;       /* 0x150 ro  Determinant */
    const uint32_t SPARE;             /* 0x154 ro  Spare */
    const uint32_t Q_COV[6];          /* 0x158 ro  Covariance of q */
    const uint32_t T_COV[6];          /* 0x170 ro  Covariance of t */
} oltae_registers;

#define OLTAE_AT(base) ((oltae_registers *)(uintptr_t)(base))

#define OLTAE_ID_VALUE UINT32_C(0x4F4C5445)
#define OLTAE_VERSION_VALUE UINT32_C(0x00000100)
#define OLTAE_VERSION_PATCH UINT32_C(0x000000FF) /* patch */
#define OLTAE_VERSION_PATCH_SHIFT 0
#define OLTAE_VERSION_MINOR UINT32_C(0x0000FF00) /* minor */
#define OLTAE_VERSION_MINOR_SHIFT 8
#define OLTAE_VERSION_MAJOR UINT32_C(0x00FF0000) /* major */
#define OLTAE_VERSION_MAJOR_SHIFT 16
#define OLTAE_BUILD_WEIGHTED UINT32_C(0x00000001) /* weighted frames */
#define OLTAE_BUILD_COVARIANCE UINT32_C(0x00000002) /* covariances of q and t */
#define OLTAE_BUILD_REAPPLY UINT32_C(0x00000004) /* re-application (Wahba's optimum) */
#define OLTAE_BUILD_VERIFY UINT32_C(0x00000008) /* results are verified by a second pass */
#define OLTAE_BUILD_MANTISSA UINT32_C(0x0000FF00) /* bits of a mantissa */
#define OLTAE_BUILD_MANTISSA_SHIFT 8
#define OLTAE_CONTROL_SOFT_RESET UINT32_C(0x00000001) /* drop the frame at hand and any waiting push */
#define OLTAE_CONTROL_ACKNOWLEDGE UINT32_C(0x00000002) /* DONE back to IDLE */
#define OLTAE_STATUS_STATE UINT32_C(0x00000007) /* state machine */
#define OLTAE_STATUS_STATE_SHIFT 0
#define OLTAE_STATUS_BUSY UINT32_C(0x00000010) /* LOAD, COMPUTE or VERIFY */
#define OLTAE_STATUS_Q_READY UINT32_C(0x00000020) /* q of the last frame started can be read */
#define OLTAE_STATUS_POSE_READY UINT32_C(0x00000040) /* R and t can be read */
#define OLTAE_STATUS_ALL_READY UINT32_C(0x00000080) /* covariance, rss and the rest can be read */
#define OLTAE_STATUS_PUSH_READY UINT32_C(0x00000100) /* a PUSH would be taken */
#define OLTAE_STATUS_FRAME UINT32_C(0xFFFF0000) /* frames completed, wraps */
#define OLTAE_STATUS_FRAME_SHIFT 16
#define OLTAE_FLAGS_FEW_POINTS UINT32_C(0x00000001) /* fewer than three points */
#define OLTAE_FLAGS_RANK_DEFICIENT UINT32_C(0x00000002) /* collinear or coincident points */
#define OLTAE_FLAGS_ZERO_WEIGHT UINT32_C(0x00000004) /* all weights are zero */
#define OLTAE_FLAGS_TOO_LONG UINT32_C(0x00000008) /* more than 65535 points */
#define OLTAE_FLAGS_BAD_TLAST UINT32_C(0x00000010) /* last beat inside a point */
#define OLTAE_FLAGS_BUSY_WRITE UINT32_C(0x00000020) /* a write to CONFIG, FRAC or VARIANCE of a busy core, or to DATA_A, DATA_B or PUSH while a push could not be taken */
#define OLTAE_FLAGS_Q_SATURATED UINT32_C(0x00000040) /* a component of q left Q15.16 */
#define OLTAE_FLAGS_ILL_CONDITIONED UINT32_C(0x00000080) /* conditioning beyond what the arithmetic carries */
#define OLTAE_FLAGS_WATCHDOG UINT32_C(0x00000100) /* the state machine was stuck and returned to IDLE */
#define OLTAE_FLAGS_NOT_BUILT UINT32_C(0x00000200) /* CONFIG asked for something this build has not */
#define OLTAE_FLAGS_UPSET UINT32_C(0x00000400) /* a protection noticed an upset of the logic */
#define OLTAE_FRAME_FLAGS_FEW_POINTS UINT32_C(0x00000001) /* fewer than three points */
#define OLTAE_FRAME_FLAGS_RANK_DEFICIENT UINT32_C(0x00000002) /* collinear or coincident points */
#define OLTAE_FRAME_FLAGS_ZERO_WEIGHT UINT32_C(0x00000004) /* all weights are zero */
#define OLTAE_FRAME_FLAGS_TOO_LONG UINT32_C(0x00000008) /* more than 65535 points */
#define OLTAE_FRAME_FLAGS_BAD_TLAST UINT32_C(0x00000010) /* last beat inside a point */
#define OLTAE_FRAME_FLAGS_BUSY_WRITE UINT32_C(0x00000020) /* a write to CONFIG, FRAC or VARIANCE of a busy core, or to DATA_A, DATA_B or PUSH while a push could not be taken */
#define OLTAE_FRAME_FLAGS_Q_SATURATED UINT32_C(0x00000040) /* a component of q left Q15.16 */
#define OLTAE_FRAME_FLAGS_ILL_CONDITIONED UINT32_C(0x00000080) /* conditioning beyond what the arithmetic carries */
#define OLTAE_FRAME_FLAGS_WATCHDOG UINT32_C(0x00000100) /* the state machine was stuck and returned to IDLE */
#define OLTAE_FRAME_FLAGS_NOT_BUILT UINT32_C(0x00000200) /* CONFIG asked for something this build has not */
#define OLTAE_FRAME_FLAGS_UPSET UINT32_C(0x00000400) /* a protection noticed an upset of the logic */
#define OLTAE_IRQ_ENABLE_DONE UINT32_C(0x00000001) /* on a completed frame */
#define OLTAE_IRQ_ENABLE_ERROR UINT32_C(0x00000002) /* on any flag */
#define OLTAE_IRQ_STATUS_DONE UINT32_C(0x00000001) /* a frame was completed */
#define OLTAE_IRQ_STATUS_ERROR UINT32_C(0x00000002) /* a flag was raised */
#define OLTAE_CONFIG_WEIGHTED UINT32_C(0x00000001) /* a beat with the 16-bit weight precedes each point */
#define OLTAE_CONFIG_FORBID_TURNS UINT32_C(0x00000002) /* never turn a by 180 degrees first */
#define OLTAE_CONFIG_REAPPLY UINT32_C(0x00000004) /* solve once more on the turned moments */
#define OLTAE_CONFIG_COVARIANCE UINT32_C(0x00000008) /* compute the covariances */
#define OLTAE_FRAC_FRAC UINT32_C(0x000000FF) /* two's complement */
#define OLTAE_FRAC_FRAC_SHIFT 0
#define OLTAE_PUSH_LAST UINT32_C(0x00000001) /* last beat of the frame */
#define OLTAE_POINTS_VALUE UINT32_C(0x0000FFFF) /* n */
#define OLTAE_POINTS_VALUE_SHIFT 0
#define OLTAE_TURN_AXIS UINT32_C(0x00000003) /* axis */
#define OLTAE_TURN_AXIS_SHIFT 0
#define OLTAE_CYCLES_Q_VALUE UINT32_C(0x0000FFFF) /* clock cycles */
#define OLTAE_CYCLES_Q_VALUE_SHIFT 0
#define OLTAE_CYCLES_POSE_VALUE UINT32_C(0x0000FFFF) /* clock cycles */
#define OLTAE_CYCLES_POSE_VALUE_SHIFT 0
#define OLTAE_CYCLES_ALL_VALUE UINT32_C(0x0000FFFF) /* clock cycles */
#define OLTAE_CYCLES_ALL_VALUE_SHIFT 0

enum {
    OLTAE_TURN_NONE = 0, /* Eq. 25 of the points as they are */
    OLTAE_TURN_X = 1, /* a was turned by 180 degrees about x first */
    OLTAE_TURN_Y = 2, /* the same about y */
    OLTAE_TURN_Z = 3, /* the same about z */
};

enum {
    OLTAE_STATE_IDLE = 0, /* no frame open, no result waiting */
    OLTAE_STATE_LOAD = 1, /* a frame is open */
    OLTAE_STATE_COMPUTE = 2, /* the frame is complete and being solved */
    OLTAE_STATE_DONE = 3, /* all results stand and are verified; held until acknowledged or the next frame's first beat */
    OLTAE_STATE_VERIFY = 4, /* all results stand; they are computed a second time and compared */
};

/* The compiler stops here when the struct is not laid out as the hardware is. */
typedef char oltae_layout[(
    offsetof(oltae_registers, ID) == 0x000 &&
    offsetof(oltae_registers, VERSION) == 0x004 &&
    offsetof(oltae_registers, BUILD) == 0x008 &&
    offsetof(oltae_registers, CONTROL) == 0x00C &&
    offsetof(oltae_registers, STATUS) == 0x010 &&
    offsetof(oltae_registers, FLAGS) == 0x014 &&
    offsetof(oltae_registers, FRAME_FLAGS) == 0x018 &&
    offsetof(oltae_registers, IRQ_ENABLE) == 0x01C &&
    offsetof(oltae_registers, IRQ_STATUS) == 0x020 &&
    offsetof(oltae_registers, CONFIG) == 0x024 &&
    offsetof(oltae_registers, FRAC) == 0x028 &&
    offsetof(oltae_registers, VARIANCE) == 0x02C &&
    offsetof(oltae_registers, DATA_A) == 0x040 &&
    offsetof(oltae_registers, DATA_B) == 0x044 &&
    offsetof(oltae_registers, PUSH) == 0x048 &&
    offsetof(oltae_registers, POINTS) == 0x060 &&
    offsetof(oltae_registers, WEIGHT) == 0x064 &&
    offsetof(oltae_registers, TURN) == 0x068 &&
    offsetof(oltae_registers, CYCLES_Q) == 0x06C &&
    offsetof(oltae_registers, CYCLES_POSE) == 0x070 &&
    offsetof(oltae_registers, CYCLES_ALL) == 0x074 &&
    offsetof(oltae_registers, Q) == 0x100 &&
    offsetof(oltae_registers, Q_FIXED) == 0x10C &&
    offsetof(oltae_registers, R) == 0x118 &&
    offsetof(oltae_registers, T) == 0x13C &&
    offsetof(oltae_registers, RSS) == 0x148 &&
    offsetof(oltae_registers, CONDITION) == 0x14C &&
    offsetof(oltae_registers, DETERMINANT) == 0x150 &&
    offsetof(oltae_registers, SPARE) == 0x154 &&
    offsetof(oltae_registers, Q_COV) == 0x158 &&
    offsetof(oltae_registers, T_COV) == 0x170 &&
    sizeof(oltae_registers) == 0x188
) ? 1 : -1];

#endif
