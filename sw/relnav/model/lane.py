# SPDX-License-Identifier: Apache-2.0
"""Bit-exact model of one float dot lane (rtl/arith/dot_lane.v).

A lane value is ``(mantissa, exponent)`` = mantissa * 2**exponent with a signed 35-bit mantissa; zero is
``(0, 0)``. A dot product is accumulated in fixed point whose unit is set by a reference exponent: the
products are exact, each is aligned with one floor, the sum is exact, and one more floor makes the result's
mantissa.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from relnav import words

LaneValue = tuple[int, int]

MANT = words.MANT
DROP = words.LANE_DROP
ACC = words.LANE_ACC
RAW = words.LANE_RAW
SHIFTS = 128  # alignment shifts stop at SHIFTS - 1: nothing but the sign is left
ZERO: LaneValue = (0, 0)
ONE: LaneValue = (1 << (MANT - 2), -(MANT - 2))


class LaneOverflow(ArithmeticError):
    """The microprogram broke its promise about a reference exponent; the RTL would be wrong too."""


def normalise(value: int, exponent: int, mant_bits: int = MANT) -> LaneValue:
    """Floor ``value * 2**exponent`` to a normalised lane value (two top mantissa bits differ)."""
    if value == 0:
        return ZERO
    magnitude_bits = (value if value >= 0 else ~value).bit_length()
    shift = magnitude_bits - (mant_bits - 1)
    mantissa = value >> shift if shift >= 0 else value << -shift
    return mantissa, exponent + shift


def wrapped(exponent: int) -> int:
    """The exponent as its EXPO bits hold it: only what follows from 1/0 ever leaves them."""
    half = 1 << (words.EXPO - 1)
    return (exponent + half) % (2 * half) - half


Operands = Iterable[tuple[int, int, bool]]
"""(X address, Y address, negate) of each term."""


class DotLane:
    """One lane: a dot product of registers.

    A wide lane drops no product bits: its accumulator's unit is 2**DROP finer.
    """

    __slots__ = ("acc", "drop", "limit", "reference", "saturated")

    def __init__(self, wide: bool = False) -> None:
        self.drop = 0 if wide else DROP  # product bits below the accumulator's unit
        self.limit = 1 << ((words.LANE_WIDE_ACC if wide else ACC) - 1)
        self.acc = 0
        self.reference: int | None = None
        self.saturated = False

    def run(self, bank: Sequence[LaneValue], operands: Operands, reference: int | None) -> None:
        """acc = sum of +/- floor(x*y / 2**(reference + drop)).

        ``reference`` None means: the exponent of the first term that is not zero. The microprogram must not
        overflow the accumulator, nor give a term above the reference.
        """
        acc, drop, limit = 0, self.drop, self.limit
        for x_address, y_address, negate in operands:
            x, x_exponent = bank[x_address]
            y, y_exponent = bank[y_address]
            if not x or not y:
                continue
            exponent = x_exponent + y_exponent
            if reference is None:
                reference = exponent
            shift = reference - exponent
            if shift < 0:
                raise LaneOverflow(f"term exponent {exponent} above the reference {reference}")
            aligned = (x * y) >> (drop + (shift if shift < SHIFTS else SHIFTS - 1))
            acc += -aligned if negate else aligned
            if not -limit <= acc < limit:
                raise LaneOverflow("accumulator overflow")
        self.acc = acc
        self.reference = reference

    def run_probed(self, bank: Sequence[LaneValue], operands: Operands) -> None:
        """The same with the largest exponent of the terms as reference: found by a first pass."""
        exponents = [bank[x][1] + bank[y][1] for x, y, _ in operands if bank[x][0] and bank[y][0]]
        self.run(bank, operands, max(exponents, default=None))

    def run_fixed(self, bank: Sequence[LaneValue], operands: Operands, reference: int) -> None:
        """The same for a fixed-point output, one product: above the reference it saturates."""
        ((x_address, y_address, _),) = operands
        (x, x_exponent), (y, y_exponent) = bank[x_address], bank[y_address]
        if not x or not y or x_exponent + y_exponent <= reference:
            self.run(bank, operands, reference)
            return
        self.saturated = True
        self.reference = reference
        top = DROP - self.drop + ACC - 1
        self.acc = -1 << top if (x < 0) != (y < 0) else 1 << (top - 1)

    def result(self, half: bool = False, clamp: bool = False) -> LaneValue:
        """Normalised sum; ``half`` divides by two, ``clamp`` makes a negative sum zero."""
        if self.reference is None or (clamp and self.acc < 0):
            return ZERO
        mantissa, exponent = normalise(self.acc, self.reference + self.drop)
        return (mantissa, wrapped(exponent - half)) if mantissa else ZERO

    @property
    def narrow(self) -> int:
        """The sum in units of a narrow lane."""
        return self.acc >> (DROP - self.drop)

    def raw(self) -> LaneValue:
        """Sum in the fixed format ``narrow >> LANE_RAW``, rounded: keeps the exponent common to a block."""
        if self.reference is None:
            return ZERO
        half = 1 << (RAW - 1 + DROP - self.drop)  # the accumulator begins with it
        mantissa = (self.acc + half) >> (DROP - self.drop) >> RAW
        if not -(1 << (MANT - 1)) <= mantissa < 1 << (MANT - 1):
            raise LaneOverflow("raw result too wide")
        return mantissa, wrapped(self.reference + DROP + RAW)

    def fixed(self) -> int:
        """Q15.16 of an accumulator whose narrow unit is 2**-17: half up, saturated to 32 bits."""
        value = (self.narrow + 1) >> 1
        clipped = max(-(1 << 31), min((1 << 31) - 1, value))
        # what rounds into the range from below has left it all the same
        self.saturated |= clipped != value or self.narrow < -(1 << 32)
        return clipped
