# SPDX-License-Identifier: Apache-2.0
"""Bit-exact model of the binary32 units (rtl/arith/float_*.v, integer_to_float.v): IEEE-754, ties to even.

One rule for `flush` (the RTL's DENORMALS = 0): denormal operands count as zero of their sign, then the IEEE
result is made, and where that is denormal it becomes zero of its sign. A value from 2^-126 - 2^-150 on is
therefore 2^-126: that is what IEEE rounds it to. Every NaN is 0x7FC00000.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import numpy.typing as npt

Floats = npt.NDArray[np.float32]

NAN = 0x7FC00000
INFINITY = 0x7F800000


def _flushed(values: Floats) -> Floats:
    """Denormals made zero of their sign, all else as it is; any shape."""
    words = values.view(np.uint32)
    denormal = (words & np.uint32(INFINITY)) == 0
    return np.where(denormal, words & np.uint32(0x80000000), words).view(np.float32)


def _operate(operation: Callable[[Floats, Floats], Floats], x: Floats, y: Floats, flush: bool) -> Floats:
    """An operation of numpy, which is IEEE's, with the flush rule around it and canonical NaNs."""
    x, y = np.asarray(x, np.float32), np.asarray(y, np.float32)
    if flush:
        x, y = _flushed(x), _flushed(y)
    with np.errstate(all="ignore"):
        result = np.asarray(operation(x, y), np.float32)
    if flush:
        result = _flushed(result)
    return np.where(np.isnan(result), np.uint32(NAN), result.view(np.uint32)).view(np.float32)


def multiply(x: Floats, y: Floats, flush: bool = True) -> Floats:
    """x y, element by element; float32 of any one shape, within half an ulp."""
    return _operate(np.multiply, x, y, flush)


def add(x: Floats, y: Floats, flush: bool = True) -> Floats:
    """x + y, element by element; float32 of any one shape, within half an ulp."""
    return _operate(np.add, x, y, flush)


def subtract(x: Floats, y: Floats, flush: bool = True) -> Floats:
    """x - y, element by element; float32 of any one shape, within half an ulp."""
    return _operate(np.subtract, x, y, flush)


def divide(x: Floats, y: Floats, flush: bool = True) -> Floats:
    """x / y, element by element; float32 of any one shape, within half an ulp."""
    return _operate(np.divide, x, y, flush)


def from_integer(value: int, scale: int, flush: bool = True) -> np.float32:
    """value * 2^scale, exact integers of any size, rounded once: within half an ulp, or 2^-150."""
    return np.uint32(word_from_integer(value, scale, flush)).view(np.float32)


def word_from_integer(value: int, scale: int, flush: bool = True) -> int:
    """The 32 bits of `from_integer`."""
    sign = 0x80000000 if value < 0 else 0
    magnitude = abs(value)
    # the unit of the last place kept, as a power of two: 24 bits, or IEEE's smallest
    unit = max(magnitude.bit_length() - 24 + scale, -149)
    drop = unit - scale
    kept = magnitude >> drop if drop > 0 else magnitude << -drop
    if drop > 0:
        rest, half = magnitude & ((1 << drop) - 1), 1 << (drop - 1)
        kept += rest > half or (rest == half and kept & 1)
    # kept 2^unit: the hidden one, and a carry out of 24 bits, move the exponent up by themselves
    word = ((unit + 149) << 23) + kept if kept else 0
    if word >= INFINITY:
        word = INFINITY
    if flush and word < 1 << 23:
        word = 0
    return sign | word
