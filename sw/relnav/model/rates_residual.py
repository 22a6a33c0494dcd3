# SPDX-License-Identifier: Apache-2.0
"""The exact residual b - A x from integer moments and binary32 rates (rtl/ivisnav/residual_unit.v)."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from relnav.model.float32 import from_integer
from relnav.model.rates_program import SIZE, Term
from relnav.model.rates_scale import FrameScale
from relnav.words import RATE_BITS, RESIDUAL_UNIT

UNIT = -RESIDUAL_UNIT
"""Exponent of the sums' unit, in units of the moments: a rate's last bit that lies below is lost."""
EXPONENT_OFFSET = 127 + 23 + UNIT
"""Biased exponent of a rate whose last bit is the unit: the product is moved left by what is above it."""
LARGEST_EXPONENT = 126 + RATE_BITS
"""Biased exponent of the largest rate that fits."""


@dataclass
class ResidualUnit:
    """Sums of moments times rates, without rounding until the last term.

    moments: exact integers by (row, column), row <= column, 6 for y.
    """

    moments: dict[tuple[int, int], int]
    scale: FrameScale
    rates: list[int] = field(default_factory=lambda: [0] * SIZE)
    """binary32 words."""
    overflow: bool = False
    sums: list[int] = field(default_factory=lambda: [0] * (SIZE + 1))

    def load(self, place: int, value: np.float32) -> None:
        """Take a rate."""
        self.rates[place] = int(value.view(np.uint32))
        self.overflow |= (self.rates[place] >> 23 & 0xFF) > LARGEST_EXPONENT

    def add(self, term: Term) -> np.float32 | None:
        """One product; the residual as binary32 with the row's last one."""
        moment = self.moments[min(term.row, term.column), max(term.row, term.column)]
        if term.column == SIZE:
            product = moment << (127 + self.scale.right - EXPONENT_OFFSET) + 23
        else:
            word = self.rates[term.column]
            left = (word >> 23 & 0xFF) - EXPONENT_OFFSET
            fraction = (word & 0x7FFFFF) | 0x800000
            product = moment * fraction << left if 0 <= left <= LARGEST_EXPONENT - EXPONENT_OFFSET else 0
            product = product if word >> 31 else -product
        self.sums[term.row] = product + (0 if term.first else self.sums[term.row])
        if not term.last:
            return None
        right = SIZE if term.row == SIZE else 0
        return from_integer(self.sums[term.row], self.scale.moment(0, right) + UNIT)
