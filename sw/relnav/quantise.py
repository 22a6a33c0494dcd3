# SPDX-License-Identifier: Apache-2.0
"""From the user's floats to the integers the core takes: one binary point and one weight scale a frame."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Protocol

import numpy as np
import numpy.typing as npt

from .attitude import FloatArray
from .frames import Frame

IntArray = npt.NDArray[np.int64]

FRAC_MIN, FRAC_MAX = -64, 95  # the FRAC register's range
INPUT_MIN, INPUT_MAX = -(1 << 31), (1 << 31) - 1
WEIGHT_MAX = (1 << 16) - 1
LEAST_BITS = 24  # below binary32's own precision the largest value would be a silent approximation


class Weighted(Protocol):
    """A frame of any core: weights (n,) or None, and the error that names a row."""

    @property
    def w(self) -> FloatArray | None:
        """Weights >= 0."""

    def error(self, point: int, reason: str) -> Exception:
        """The error for a row (0-based)."""


@dataclass(frozen=True, eq=False)
class QuantisedFrame:
    """One frame as the core is fed.

    a, b:          (n, 3) integers of 32 bits; value = integer * 2^-frac
    w:             (n,) integers 0..65535, or None (unweighted mode)
    frac:          binary point shared by a and b, -64..95
    weight_scale:  w = round(weight_scale * the user's weight)
    name:          the frame's label
    """

    a: IntArray
    b: IntArray
    w: IntArray | None
    frac: int
    weight_scale: float = 1.0
    name: str | int = 0

    @property
    def n(self) -> int:
        """Points in the frame."""
        return len(self.a)

    def values(self) -> tuple[FloatArray, FloatArray]:
        """a, b (n, 3) as floats: what the integers stand for, exact in double."""
        return np.ldexp(self.a.astype(np.float64), -self.frac), np.ldexp(
            self.b.astype(np.float64), -self.frac
        )


def quantise(frame: Frame) -> QuantisedFrame:
    """The finest shared binary point that fits 32 bits; weights 0..65535 unchanged if integer, else scaled.

    Raises InputError, naming the row, for values that no binary point from -64 to 95 fits and for a positive
    weight that would round to 0.
    """
    frac = choose_frac(frame)
    weights, scale = quantise_weights(frame)
    a = np.rint(np.ldexp(frame.a, frac)).astype(np.int64)
    b = np.rint(np.ldexp(frame.b, frac)).astype(np.int64)
    return QuantisedFrame(a, b, weights, frac, scale, frame.name)


def choose_frac(frame: Frame) -> int:
    """The largest FRAC at which every value, rounded, lies in [-2^31, 2^31 - 1]; 0 for a frame of zeros."""
    if len(frame.a) == 0:
        return 0
    low = float(min(frame.a.min(), frame.b.min()))
    high = float(max(frame.a.max(), frame.b.max()))
    return finest_frac(low, high, lambda reason: _extreme(frame, reason))


def finest_frac(low: float, high: float, refuse: Callable[[str], Exception]) -> int:
    """The largest binary point, -64..95, at which low to high, rounded, fit 32 bits; 0 where both are 0.

    Raises what refuse makes of the reason, a phrase about the largest value, where there is none.
    """
    largest = max(-low, high)
    if largest == 0.0:
        return 0
    # largest = mantissa * 2^exponent, mantissa in [1/2, 1): frac = 32 - exponent is at most one too many for
    # a positive value, right for -2^k, and rounding up to 2^31 may cost one more.
    frac = min(32 - int(np.frexp(largest)[1]), FRAC_MAX)
    while frac >= FRAC_MIN and not (
        np.rint(np.ldexp(low, frac)) >= INPUT_MIN and np.rint(np.ldexp(high, frac)) <= INPUT_MAX
    ):
        frac -= 1
    if frac < FRAC_MIN:
        raise refuse("too large: no binary point from -64 to 95 fits it in 32 bits")
    if np.ldexp(largest, frac) < 2.0 ** (LEAST_BITS - 1):
        raise refuse(
            f"the frame's largest value, too small: binary point 95 leaves it under {LEAST_BITS} bits"
        )
    return frac


def quantise_weights(frame: Weighted) -> tuple[IntArray | None, float]:
    """(integer weights or None, weight_scale).

    Integers up to 65535 keep scale 1. Other weights take the largest power of two that fits when it makes
    them all integers (so 0.25 or 98304 stay exact), else 65535 / max.
    """
    if frame.w is None:
        return None, 1.0
    weights = frame.w
    largest = float(weights.max(initial=0.0))
    if largest <= WEIGHT_MAX and bool(np.all(weights == np.rint(weights))):
        return weights.astype(np.int64), 1.0
    if largest < 2.0**-900:  # 65535 / max, and what has to be divided by it later, would leave double's range
        reason = f"w = {largest!r} is the frame's largest weight, too small to scale"
        raise frame.error(int(np.argmax(weights)), reason)
    exponent = 16 - int(np.frexp(largest)[1])
    if np.ldexp(largest, exponent) > WEIGHT_MAX:
        exponent -= 1
    scale = float(np.ldexp(1.0, exponent))
    if not np.all(np.ldexp(weights, exponent) == np.rint(np.ldexp(weights, exponent))):
        scale = WEIGHT_MAX / largest
    scaled = np.minimum(np.rint(weights * scale), WEIGHT_MAX).astype(np.int64)
    lost = np.flatnonzero((weights > 0) & (scaled == 0))
    if lost.size:
        row = int(lost[0])
        reason = f"would round to 0 in the 16 bits of a weight: the frame's largest is {largest!r}"
        raise frame.error(row, f"w = {float(weights[row])!r} {reason}")
    return scaled, scale


def _extreme(frame: Frame, reason: str) -> Exception:
    """The error for the largest value's row."""
    both = np.hstack((frame.a, frame.b))
    row, column = np.unravel_index(int(np.argmax(np.abs(both))), both.shape)
    name = ("ax", "ay", "az", "bx", "by", "bz")[int(column)]
    return frame.error(int(row), f"{name} = {float(both[row, column])!r} is {reason}")
