# SPDX-License-Identifier: Apache-2.0
"""Bit-exact model of the reciprocal divider (rtl/arith/reciprocal.v)."""

from __future__ import annotations

from relnav import words
from relnav.model.lane import LaneValue

PAD = 5
# Stands for 1/0: overflows binary32 and saturates Q15.16, and keeps the exponent of q (600 below to 714
# above) in its 12 bits.
HUGE: LaneValue = (1 << (words.MANT - 2), 1200)


def reciprocal(value: LaneValue) -> LaneValue:
    """1/value: quotient floor(2**61 / |mantissa|), sign restored; 1/0 gives HUGE.

    |mantissa| in [2**33, 2**34] for a normalised value, so the quotient is in [2**27, 2**28] and its relative
    error below 2**-27; five zero bits are appended to use the lane format.
    """
    mantissa, exponent = value
    if mantissa == 0:
        return HUGE
    quotient = (1 << words.RECIPROCAL_NUMERATOR) // abs(mantissa)
    result = quotient << PAD
    return (result if mantissa > 0 else -result, -exponent - words.RECIPROCAL_NUMERATOR - PAD)
