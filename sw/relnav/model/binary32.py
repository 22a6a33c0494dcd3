# SPDX-License-Identifier: Apache-2.0
"""Bit-exact model of the lane-value to IEEE-754 binary32 conversion (rtl/arith/to_binary32.v)."""

from __future__ import annotations

from relnav.model.lane import LaneValue

INFINITY = 0x7F800000


def to_binary32(value: LaneValue) -> int:
    """Round a lane value to binary32, ties to even; overflow gives infinity, below 2**-126 signed 0."""
    mantissa, exponent = value
    if mantissa == 0:
        return 0
    sign = 0x80000000 if mantissa < 0 else 0
    magnitude = abs(mantissa)
    bits = magnitude.bit_length()
    biased = exponent + bits - 1 + 127
    drop = bits - 24
    if drop > 0:
        kept = magnitude >> drop
        rest = magnitude & ((1 << drop) - 1)
        half = 1 << (drop - 1)
        if rest > half or (rest == half and kept & 1):
            kept += 1
    else:
        kept = magnitude << -drop
    if kept == 1 << 24:
        kept >>= 1
        biased += 1
    if biased >= 255:
        return sign | INFINITY
    if biased <= 0:
        return sign
    return sign | biased << 23 | (kept & 0x7FFFFF)


def from_binary32(word: int) -> LaneValue:
    """The lane value of a finite binary32 pattern (mantissa of 24 bits, not normalised); denormals give 0."""
    biased = word >> 23 & 0xFF
    if biased == 0:
        return (0, 0)
    mantissa = (word & 0x7FFFFF) | 0x800000
    return (-mantissa if word >> 31 else mantissa, biased - 150)
