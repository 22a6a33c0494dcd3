# SPDX-License-Identifier: Apache-2.0
# ruff: noqa: E501, N801, RUF012
"""Written by `python -m relnav.regtool` from registers/*.rdl; do not edit."""

from enum import IntEnum

from relnav.registermap import Field, Register


class Ivisnav:
    """iVisNav registers."""

    SIZE = 0x170

    class State(IntEnum):
        """Values of state."""

        IDLE = 0  # no frame open, no result waiting
        SEND_DATA = 1  # a frame is open
        COMPUTE = 2  # the frame is complete and being solved
        DONE = 3  # all results stand and are verified; held until acknowledged or the next frame's first beat
        VERIFY = 4  # all results stand; they are computed a second time and compared

    class ID(Register):
        """Identity. Reads "IVIS". A driver checks it before anything else."""

        ADDRESS = 0x000
        ACCESS = "ro"
        RESET = 0x49564953
        VALUE = Field(0, 32)
        FIELDS = {"VALUE": VALUE}

    class VERSION(Register):
        """Version. Of the release."""

        ADDRESS = 0x004
        ACCESS = "ro"
        RESET = 0x00000100
        PATCH = Field(0, 8)
        MINOR = Field(8, 8)
        MAJOR = Field(16, 8)
        FIELDS = {"PATCH": PATCH, "MINOR": MINOR, "MAJOR": MAJOR}

    class BUILD(Register):
        """Build. Parameters this core was built with."""

        ADDRESS = 0x008
        ACCESS = "ro"
        VERIFY = Field(3, 1)
        MANTISSA = Field(8, 8)
        FIELDS = {"VERIFY": VERIFY, "MANTISSA": MANTISSA}

    class CONTROL(Register):
        """Control. Writing 1 acts once."""

        ADDRESS = 0x00C
        ACCESS = "wo"
        RESET = 0x00000000
        SOFT_RESET = Field(0, 1)
        ACKNOWLEDGE = Field(1, 1)
        FIELDS = {"SOFT_RESET": SOFT_RESET, "ACKNOWLEDGE": ACKNOWLEDGE}

    class STATUS(Register):
        """Status."""

        ADDRESS = 0x010
        ACCESS = "ro"
        STATE = Field(0, 3)
        BUSY = Field(4, 1)
        RATES_READY = Field(5, 1)
        ALL_READY = Field(7, 1)
        PUSH_READY = Field(8, 1)
        FRAME = Field(16, 16)
        FIELDS = {
            "STATE": STATE,
            "BUSY": BUSY,
            "RATES_READY": RATES_READY,
            "ALL_READY": ALL_READY,
            "PUSH_READY": PUSH_READY,
            "FRAME": FRAME,
        }

    class FLAGS(Register):
        """Flags. Sticky; write 1 to clear. A flag that rises in the clock of its clearing stays."""

        ADDRESS = 0x014
        ACCESS = "w1c"
        RESET = 0x00000000
        FEW_ROWS = Field(0, 1)
        RANK_DEFICIENT = Field(1, 1)
        ZERO_WEIGHT = Field(2, 1)
        TOO_LONG = Field(3, 1)
        BAD_TLAST = Field(4, 1)
        BUSY_WRITE = Field(5, 1)
        ILL_CONDITIONED = Field(7, 1)
        WATCHDOG = Field(8, 1)
        UPSET = Field(10, 1)
        FIELDS = {
            "FEW_ROWS": FEW_ROWS,
            "RANK_DEFICIENT": RANK_DEFICIENT,
            "ZERO_WEIGHT": ZERO_WEIGHT,
            "TOO_LONG": TOO_LONG,
            "BAD_TLAST": BAD_TLAST,
            "BUSY_WRITE": BUSY_WRITE,
            "ILL_CONDITIONED": ILL_CONDITIONED,
            "WATCHDOG": WATCHDOG,
            "UPSET": UPSET,
        }

    class FRAME_FLAGS(Register):
        """Flags of the last frame. The same bits, cleared by the next frame's first beat."""

        ADDRESS = 0x018
        ACCESS = "ro"
        FEW_ROWS = Field(0, 1)
        RANK_DEFICIENT = Field(1, 1)
        ZERO_WEIGHT = Field(2, 1)
        TOO_LONG = Field(3, 1)
        BAD_TLAST = Field(4, 1)
        BUSY_WRITE = Field(5, 1)
        ILL_CONDITIONED = Field(7, 1)
        WATCHDOG = Field(8, 1)
        UPSET = Field(10, 1)
        FIELDS = {
            "FEW_ROWS": FEW_ROWS,
            "RANK_DEFICIENT": RANK_DEFICIENT,
            "ZERO_WEIGHT": ZERO_WEIGHT,
            "TOO_LONG": TOO_LONG,
            "BAD_TLAST": BAD_TLAST,
            "BUSY_WRITE": BUSY_WRITE,
            "ILL_CONDITIONED": ILL_CONDITIONED,
            "WATCHDOG": WATCHDOG,
            "UPSET": UPSET,
        }

    class IRQ_ENABLE(Register):
        """Interrupt enable."""

        ADDRESS = 0x01C
        ACCESS = "rw"
        RESET = 0x00000000
        DONE = Field(0, 1)
        ERROR = Field(1, 1)
        FIELDS = {"DONE": DONE, "ERROR": ERROR}

    class IRQ_STATUS(Register):
        """Interrupt status. Sticky; write 1 to clear. irq is the level of |(IRQ_ENABLE & IRQ_STATUS)."""

        ADDRESS = 0x020
        ACCESS = "w1c"
        RESET = 0x00000000
        DONE = Field(0, 1)
        ERROR = Field(1, 1)
        FIELDS = {"DONE": DONE, "ERROR": ERROR}

    class FRAC(Register):
        """Binary points. Locked while busy. Fractional places of the inputs, each signed, -64 to 95; a write with either outside that is ignored."""

        ADDRESS = 0x028
        ACCESS = "rw"
        RESET = 0x00000000
        FRAC_H = Field(0, 8, signed=True)
        FRAC_Y = Field(8, 8, signed=True)
        FIELDS = {"FRAC_H": FRAC_H, "FRAC_Y": FRAC_Y}

    class VARIANCE(Register):
        """Variance. Locked while busy. Of y at unit weight, in the square of y's unit, binary32; 0: use rss / (n - 6), n counting the rows of positive weight. Not checked (the drivers do): below 2^-126 it counts as 0; where it is negative or not finite the covariance means nothing, without a flag."""

        ADDRESS = 0x02C
        ACCESS = "rw"
        RESET = 0x00000000
        VALUE = Field(0, 32)
        FIELDS = {"VALUE": VALUE}

    class DATA_A(Register):
        """Beat, low word. Low word of the beat to push: h0, h2, h4 or y."""

        ADDRESS = 0x040
        ACCESS = "rw"
        RESET = 0x00000000
        VALUE = Field(0, 32)
        FIELDS = {"VALUE": VALUE}

    class DATA_B(Register):
        """Beat, high word. High word of the beat to push: h1, h3, h5 or the 16-bit weight."""

        ADDRESS = 0x044
        ACCESS = "rw"
        RESET = 0x00000000
        VALUE = Field(0, 32)
        FIELDS = {"VALUE": VALUE}

    class PUSH(Register):
        """Push. Any write pushes the beat {DATA_B, DATA_A}, as if it had come by the stream."""

        ADDRESS = 0x048
        ACCESS = "wo"
        RESET = 0x00000000
        LAST = Field(0, 1)
        FIELDS = {"LAST": LAST}

    class ROWS(Register):
        """Rows. n of the frame whose results stand."""

        ADDRESS = 0x060
        ACCESS = "ro"
        VALUE = Field(0, 16)
        FIELDS = {"VALUE": VALUE}

    class WEIGHT(Register):
        """Weight. Sum of the weights of that frame."""

        ADDRESS = 0x064
        ACCESS = "ro"
        VALUE = Field(0, 32)
        FIELDS = {"VALUE": VALUE}

    class CONDITION(Register):
        """Condition. Estimate of the square of H's condition number, of the last frame that was solved or refused as ill conditioned."""

        ADDRESS = 0x068
        ACCESS = "ro"
        VALUE = Field(0, 32)
        FIELDS = {"VALUE": VALUE}

    class CYCLES_RATES(Register):
        """Cycles to v and omega. From the last accepted beat to the registers holding them."""

        ADDRESS = 0x06C
        ACCESS = "ro"
        VALUE = Field(0, 16)
        FIELDS = {"VALUE": VALUE}

    class CYCLES_ALL(Register):
        """Cycles to all. The same for covariance and rss."""

        ADDRESS = 0x074
        ACCESS = "ro"
        VALUE = Field(0, 16)
        FIELDS = {"VALUE": VALUE}

    class V(Register):
        """v. Relative velocity, in the unit of y."""

        ADDRESS = 0x100
        ACCESS = "ro"
        COUNT = 3
        VALUE = Field(0, 32)
        FIELDS = {"VALUE": VALUE}

    class OMEGA(Register):
        """omega. Relative angular velocity, in the unit of y over that of p."""

        ADDRESS = 0x10C
        ACCESS = "ro"
        COUNT = 3
        VALUE = Field(0, 32)
        FIELDS = {"VALUE": VALUE}

    class RSS(Register):
        """Residual sum of squares. Weighted, of y - H x."""

        ADDRESS = 0x118
        ACCESS = "ro"
        VALUE = Field(0, 32)
        FIELDS = {"VALUE": VALUE}

    class COV(Register):
        """Covariance. Of (v, omega): upper triangle, row-major: 11 12 .. 16 22 .. 66."""

        ADDRESS = 0x11C
        ACCESS = "ro"
        COUNT = 21
        VALUE = Field(0, 32)
        FIELDS = {"VALUE": VALUE}


class Oltae:
    """OLTAE registers."""

    SIZE = 0x188

    class Turn(IntEnum):
        """Values of turn."""

        NONE = 0  # Eq. 25 of the points as they are
        X = 1  # a was turned by 180 degrees about x first
        Y = 2  # the same about y
        Z = 3  # the same about z

    class State(IntEnum):
        """Values of state."""

        IDLE = 0  # no frame open, no result waiting
        LOAD = 1  # a frame is open
        COMPUTE = 2  # the frame is complete and being solved
        DONE = 3  # all results stand and are verified; held until acknowledged or the next frame's first beat
        VERIFY = 4  # all results stand; they are computed a second time and compared

    class ID(Register):
        """Identity. Reads "OLTE". A driver checks it before anything else."""

        ADDRESS = 0x000
        ACCESS = "ro"
        RESET = 0x4F4C5445
        VALUE = Field(0, 32)
        FIELDS = {"VALUE": VALUE}

    class VERSION(Register):
        """Version. Of the release."""

        ADDRESS = 0x004
        ACCESS = "ro"
        RESET = 0x00000100
        PATCH = Field(0, 8)
        MINOR = Field(8, 8)
        MAJOR = Field(16, 8)
        FIELDS = {"PATCH": PATCH, "MINOR": MINOR, "MAJOR": MAJOR}

    class BUILD(Register):
        """Build. Parameters this core was built with."""

        ADDRESS = 0x008
        ACCESS = "ro"
        WEIGHTED = Field(0, 1)
        COVARIANCE = Field(1, 1)
        REAPPLY = Field(2, 1)
        VERIFY = Field(3, 1)
        MANTISSA = Field(8, 8)
        FIELDS = {
            "WEIGHTED": WEIGHTED,
            "COVARIANCE": COVARIANCE,
            "REAPPLY": REAPPLY,
            "VERIFY": VERIFY,
            "MANTISSA": MANTISSA,
        }

    class CONTROL(Register):
        """Control. Writing 1 acts once."""

        ADDRESS = 0x00C
        ACCESS = "wo"
        RESET = 0x00000000
        SOFT_RESET = Field(0, 1)
        ACKNOWLEDGE = Field(1, 1)
        FIELDS = {"SOFT_RESET": SOFT_RESET, "ACKNOWLEDGE": ACKNOWLEDGE}

    class STATUS(Register):
        """Status."""

        ADDRESS = 0x010
        ACCESS = "ro"
        STATE = Field(0, 3)
        BUSY = Field(4, 1)
        Q_READY = Field(5, 1)
        POSE_READY = Field(6, 1)
        ALL_READY = Field(7, 1)
        PUSH_READY = Field(8, 1)
        FRAME = Field(16, 16)
        FIELDS = {
            "STATE": STATE,
            "BUSY": BUSY,
            "Q_READY": Q_READY,
            "POSE_READY": POSE_READY,
            "ALL_READY": ALL_READY,
            "PUSH_READY": PUSH_READY,
            "FRAME": FRAME,
        }

    class FLAGS(Register):
        """Flags. Sticky; write 1 to clear. A flag that rises in the clock of its clearing stays."""

        ADDRESS = 0x014
        ACCESS = "w1c"
        RESET = 0x00000000
        FEW_POINTS = Field(0, 1)
        RANK_DEFICIENT = Field(1, 1)
        ZERO_WEIGHT = Field(2, 1)
        TOO_LONG = Field(3, 1)
        BAD_TLAST = Field(4, 1)
        BUSY_WRITE = Field(5, 1)
        Q_SATURATED = Field(6, 1)
        ILL_CONDITIONED = Field(7, 1)
        WATCHDOG = Field(8, 1)
        NOT_BUILT = Field(9, 1)
        UPSET = Field(10, 1)
        FIELDS = {
            "FEW_POINTS": FEW_POINTS,
            "RANK_DEFICIENT": RANK_DEFICIENT,
            "ZERO_WEIGHT": ZERO_WEIGHT,
            "TOO_LONG": TOO_LONG,
            "BAD_TLAST": BAD_TLAST,
            "BUSY_WRITE": BUSY_WRITE,
            "Q_SATURATED": Q_SATURATED,
            "ILL_CONDITIONED": ILL_CONDITIONED,
            "WATCHDOG": WATCHDOG,
            "NOT_BUILT": NOT_BUILT,
            "UPSET": UPSET,
        }

    class FRAME_FLAGS(Register):
        """Flags of the last frame. The same bits, cleared by the next frame's first beat."""

        ADDRESS = 0x018
        ACCESS = "ro"
        FEW_POINTS = Field(0, 1)
        RANK_DEFICIENT = Field(1, 1)
        ZERO_WEIGHT = Field(2, 1)
        TOO_LONG = Field(3, 1)
        BAD_TLAST = Field(4, 1)
        BUSY_WRITE = Field(5, 1)
        Q_SATURATED = Field(6, 1)
        ILL_CONDITIONED = Field(7, 1)
        WATCHDOG = Field(8, 1)
        NOT_BUILT = Field(9, 1)
        UPSET = Field(10, 1)
        FIELDS = {
            "FEW_POINTS": FEW_POINTS,
            "RANK_DEFICIENT": RANK_DEFICIENT,
            "ZERO_WEIGHT": ZERO_WEIGHT,
            "TOO_LONG": TOO_LONG,
            "BAD_TLAST": BAD_TLAST,
            "BUSY_WRITE": BUSY_WRITE,
            "Q_SATURATED": Q_SATURATED,
            "ILL_CONDITIONED": ILL_CONDITIONED,
            "WATCHDOG": WATCHDOG,
            "NOT_BUILT": NOT_BUILT,
            "UPSET": UPSET,
        }

    class IRQ_ENABLE(Register):
        """Interrupt enable."""

        ADDRESS = 0x01C
        ACCESS = "rw"
        RESET = 0x00000000
        DONE = Field(0, 1)
        ERROR = Field(1, 1)
        FIELDS = {"DONE": DONE, "ERROR": ERROR}

    class IRQ_STATUS(Register):
        """Interrupt status. Sticky; write 1 to clear. irq is the level of |(IRQ_ENABLE & IRQ_STATUS)."""

        ADDRESS = 0x020
        ACCESS = "w1c"
        RESET = 0x00000000
        DONE = Field(0, 1)
        ERROR = Field(1, 1)
        FIELDS = {"DONE": DONE, "ERROR": ERROR}

    class CONFIG(Register):
        """Configuration. Locked while busy. A bit that this build has not reads as 0."""

        ADDRESS = 0x024
        ACCESS = "rw"
        RESET = 0x00000008
        WEIGHTED = Field(0, 1)
        FORBID_TURNS = Field(1, 1)
        REAPPLY = Field(2, 1)
        COVARIANCE = Field(3, 1)
        FIELDS = {
            "WEIGHTED": WEIGHTED,
            "FORBID_TURNS": FORBID_TURNS,
            "REAPPLY": REAPPLY,
            "COVARIANCE": COVARIANCE,
        }

    class FRAC(Register):
        """Binary point. Locked while busy. Fractional places of the inputs, signed, -64 to 95; a write outside that is ignored."""

        ADDRESS = 0x028
        ACCESS = "rw"
        RESET = 0x00000000
        FRAC = Field(0, 8, signed=True)
        FIELDS = {"FRAC": FRAC}

    class VARIANCE(Register):
        """Variance. Locked while busy. sa^2 + sb^2 at unit weight, binary32; 0: use rss / (3n - 6), n counting the points of positive weight. Not checked (the drivers do): below 2^-126 it counts as 0; where it is negative or not finite the covariances mean nothing, without a flag."""

        ADDRESS = 0x02C
        ACCESS = "rw"
        RESET = 0x00000000
        VALUE = Field(0, 32)
        FIELDS = {"VALUE": VALUE}

    class DATA_A(Register):
        """Beat, low word. a of the coordinate to push, or the weight."""

        ADDRESS = 0x040
        ACCESS = "rw"
        RESET = 0x00000000
        VALUE = Field(0, 32)
        FIELDS = {"VALUE": VALUE}

    class DATA_B(Register):
        """Beat, high word. b of the coordinate to push."""

        ADDRESS = 0x044
        ACCESS = "rw"
        RESET = 0x00000000
        VALUE = Field(0, 32)
        FIELDS = {"VALUE": VALUE}

    class PUSH(Register):
        """Push. Any write pushes the beat {DATA_B, DATA_A}, as if it had come by the stream."""

        ADDRESS = 0x048
        ACCESS = "wo"
        RESET = 0x00000000
        LAST = Field(0, 1)
        FIELDS = {"LAST": LAST}

    class POINTS(Register):
        """Points. n of the frame whose results stand."""

        ADDRESS = 0x060
        ACCESS = "ro"
        VALUE = Field(0, 16)
        FIELDS = {"VALUE": VALUE}

    class WEIGHT(Register):
        """Weight. Sum of the weights; n when unweighted."""

        ADDRESS = 0x064
        ACCESS = "ro"
        VALUE = Field(0, 32)
        FIELDS = {"VALUE": VALUE}

    class TURN(Register):
        """Turn. The 180-degree turn that was taken."""

        ADDRESS = 0x068
        ACCESS = "ro"
        AXIS = Field(0, 2)
        FIELDS = {"AXIS": AXIS}

    class CYCLES_Q(Register):
        """Cycles to q. From the last accepted beat to the register holding q."""

        ADDRESS = 0x06C
        ACCESS = "ro"
        VALUE = Field(0, 16)
        FIELDS = {"VALUE": VALUE}

    class CYCLES_POSE(Register):
        """Cycles to R and t. The same for R and t."""

        ADDRESS = 0x070
        ACCESS = "ro"
        VALUE = Field(0, 16)
        FIELDS = {"VALUE": VALUE}

    class CYCLES_ALL(Register):
        """Cycles to all. The same for covariance, rss and the rest."""

        ADDRESS = 0x074
        ACCESS = "ro"
        VALUE = Field(0, 16)
        FIELDS = {"VALUE": VALUE}

    class Q(Register):
        """q. Rodrigues vector. R = (I+Q)^-1 (I-Q): a positive q3 turns by a NEGATIVE angle about z."""

        ADDRESS = 0x100
        ACCESS = "ro"
        COUNT = 3
        VALUE = Field(0, 32)
        FIELDS = {"VALUE": VALUE}

    class Q_FIXED(Register):
        """q in Q15.16. The papers' format, saturated."""

        ADDRESS = 0x10C
        ACCESS = "ro"
        COUNT = 3
        VALUE = Field(0, 32, signed=True)
        FIELDS = {"VALUE": VALUE}

    class R(Register):
        """Rotation. Row-major, b = R a + t."""

        ADDRESS = 0x118
        ACCESS = "ro"
        COUNT = 9
        VALUE = Field(0, 32)
        FIELDS = {"VALUE": VALUE}

    class T(Register):
        """Translation. In the unit of the inputs."""

        ADDRESS = 0x13C
        ACCESS = "ro"
        COUNT = 3
        VALUE = Field(0, 32)
        FIELDS = {"VALUE": VALUE}

    class RSS(Register):
        """Residual sum of squares. Weighted, of b - R a - t; never negative."""

        ADDRESS = 0x148
        ACCESS = "ro"
        VALUE = Field(0, 32)
        FIELDS = {"VALUE": VALUE}

    class CONDITION(Register):
        """Condition. Estimate of the condition number of M."""

        ADDRESS = 0x14C
        ACCESS = "ro"
        VALUE = Field(0, 32)
        FIELDS = {"VALUE": VALUE}

    class DETERMINANT(Register):
        """Determinant. det M of the turn taken."""

        ADDRESS = 0x150
        ACCESS = "ro"
        VALUE = Field(0, 32)
        FIELDS = {"VALUE": VALUE}

    class SPARE(Register):
        """Spare. Reads as 0."""

        ADDRESS = 0x154
        ACCESS = "ro"
        VALUE = Field(0, 32)
        FIELDS = {"VALUE": VALUE}

    class Q_COV(Register):
        """Covariance of q. Upper triangle, row-major: 11 12 13 22 23 33. Without meaning where Q is not finite, or CONFIG.COVARIANCE is 0."""

        ADDRESS = 0x158
        ACCESS = "ro"
        COUNT = 6
        VALUE = Field(0, 32)
        FIELDS = {"VALUE": VALUE}

    class T_COV(Register):
        """Covariance of t. Upper triangle, row-major."""

        ADDRESS = 0x170
        ACCESS = "ro"
        COUNT = 6
        VALUE = Field(0, 32)
        FIELDS = {"VALUE": VALUE}
