# SPDX-License-Identifier: Apache-2.0
"""Bit-exact model of rtl/gram/centring.v: second central moments as integers."""

from __future__ import annotations

from dataclasses import dataclass

from relnav.words import LEAN, Build


@dataclass(frozen=True)
class Centring:
    """Centred moments W G - m_i m_j of one build (OLTAE paper, Eqs. 11-13, times W)."""

    words: Build = LEAN

    def run(self, weight_sum: int, moment: int, first_i: int, first_j: int) -> int:
        """W G - m_i m_j; W unsigned, G and m signed. OverflowError beyond the build's word lengths."""
        _fits("weight sum", weight_sum, 0, 1 << self.words.W)
        _fits("second moment", moment, -(1 << (self.words.M2 - 1)), 1 << (self.words.M2 - 1))
        for first in (first_i, first_j):
            _fits("first moment", first, -(1 << (self.words.M1 - 1)), 1 << (self.words.M1 - 1))
        return weight_sum * moment - first_i * first_j


def _fits(name: str, value: int, low: int, end: int) -> None:
    if not low <= value < end:
        raise OverflowError(f"{name} {value} does not fit its word")
