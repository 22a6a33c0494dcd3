"""Bit-exact model of one float dot lane (rtl/arith/dot_lane.v).

A lane value is ``(mantissa, exponent)`` = mantissa * 2**exponent with a signed 35-bit mantissa; zero is ``(0, 0)``.
A dot product is accumulated in fixed point whose unit is set by a reference exponent: the products are exact, each
is aligned with one floor, the sum is exact, and one more floor makes the result's mantissa.
"""

from __future__ import annotations

from dataclasses import dataclass

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


@dataclass
class DotLane:
    """Accumulator of one lane. The reference is given, or the first enabled, non-zero term's.

    A wide lane drops no product bits: its accumulator's unit is 2**DROP finer.
    """

    wide: bool = False
    acc: int = 0
    reference: int | None = None
    saturated: bool = False

    def clear(self, reference: int | None) -> None:
        """Begin a dot product; ``reference`` None means: that of the first enabled, non-zero term."""
        self.acc = 0
        self.reference = reference

    @property
    def drop(self) -> int:
        """Product bits below the accumulator's unit."""
        return 0 if self.wide else DROP

    def add(self, value: int) -> None:
        """Accumulate; the microprogram must not overflow the accumulator."""
        self.acc += value
        bits = words.LANE_WIDE_ACC if self.wide else ACC
        if not -(1 << (bits - 1)) <= self.acc < 1 << (bits - 1):
            raise LaneOverflow("accumulator overflow")

    def term(self, x: LaneValue, y: LaneValue, negate: bool) -> None:
        """acc +/-= floor(x*y / 2**(reference + drop))."""
        if x[0] == 0 or y[0] == 0:
            return
        exponent = x[1] + y[1]
        if self.reference is None:
            self.reference = exponent
        shift = self.reference - exponent
        if shift < 0:
            raise LaneOverflow(f"term exponent {exponent} above the reference {self.reference}")
        aligned = (x[0] * y[0]) >> self.drop >> (shift if shift < SHIFTS else SHIFTS - 1)
        self.add(-aligned if negate else aligned)

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
        """Sum in the fixed format ``narrow >> LANE_RAW``: keeps the exponent common to a block."""
        if self.reference is None:
            return ZERO
        mantissa = self.narrow >> RAW
        if not -(1 << (MANT - 1)) <= mantissa < 1 << (MANT - 1):
            raise LaneOverflow("raw result too wide")
        return mantissa, wrapped(self.reference + DROP + RAW)

    def overflows(self, x: LaneValue, y: LaneValue) -> bool:
        """Fixed-point output only: a term above the accumulator saturates."""
        if x[0] == 0 or y[0] == 0 or self.reference is None or x[1] + y[1] <= self.reference:
            return False
        self.saturated = True
        self.acc = -1 << (DROP - self.drop + ACC - 1) if (x[0] < 0) != (y[0] < 0) else 1 << (DROP - self.drop + ACC - 2)
        return True

    def fixed(self) -> int:
        """Q15.16 of an accumulator whose narrow unit is 2**-17: half up, saturated to 32 bits."""
        value = (self.narrow + 1) >> 1
        clipped = max(-(1 << 31), min((1 << 31) - 1, value))
        self.saturated |= clipped != value
        return clipped
