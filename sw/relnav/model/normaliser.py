# SPDX-License-Identifier: Apache-2.0
"""Bit-exact model of rtl/gram/normaliser.v: integer to lane float, rounding down."""

from __future__ import annotations

from relnav import words
from relnav.model.lane import ZERO, LaneValue, normalise

LOW_BITS = words.MANT - 1  # bits of a low limb


class Normaliser:
    """Mantissa of MANT bits and the LOW_BITS bits below it, each as a lane value (mantissa, exponent)."""

    def run(self, value: int, low: bool = False, scale: int = 0) -> LaneValue:
        """The lane value of value * 2^scale.

        low False: the mantissa is floor(value / 2^e) and its two top bits differ, the exponent is e + scale.
        low True:  the next 34 bits, floor(value / 2^(e-34)) mod 2^34 at exponent e - 34 + scale, not
                   normalised: high + low = value * 2^scale rounded down to 69 bits.
        A mantissa of 0 gives (0, 0). OverflowError if the exponent does not fit its word.
        """
        mantissa, shift = normalise(value, 0)
        if low:
            shift -= LOW_BITS
            below = value >> shift if shift >= 0 else value << -shift
            mantissa = below & ((1 << LOW_BITS) - 1)
        if mantissa == 0:
            return ZERO
        exponent = shift + scale
        if not -(1 << (words.EXPO - 1)) <= exponent < 1 << (words.EXPO - 1):
            raise OverflowError(f"exponent {exponent} does not fit {words.EXPO} bits")
        return mantissa, exponent
