# SPDX-License-Identifier: Apache-2.0
"""Bit-exact model of rtl/ivisnav/ivisnav_top.v: quantised rows in, register words out."""

from __future__ import annotations

from relnav import words
from relnav.ivisnav.quantise import QuantisedRows
from relnav.ivisnav.raw import FLAG_BITS, RawRates
from relnav.model.gram_ring import gram_ring
from relnav.model.rates_engine import RatesEngine
from relnav.model.rates_program import SIZE
from relnav.model.rates_scale import FrameScale
from relnav.model.raw import variance_word

LEAST_ROWS, MOST_ROWS = SIZE, (1 << words.COUNT) - 1


class RatesCore:
    """The core; frames leave nothing behind for the next."""

    def run(self, rows: QuantisedRows, variance: float = 0.0) -> RawRates:
        """Solve a frame. variance: of y at the user's unit weight; 0: from the residuals.

        Raises InputError for a variance that VARIANCE cannot hold.
        """
        word = variance_word(variance, rows.weight_scale)
        used = int((rows.w > 0).sum())
        refusals = _refusals(rows.n, used)
        if refusals:
            return RawRates(flags=sum(1 << FLAG_BITS[name] for name in refusals))
        sums = gram_ring(rows.h, rows.y, rows.w)
        scale = FrameScale.of(sums, rows.frac_h, rows.frac_y, word)
        result = RatesEngine(sums.moments, scale, used, word).run()
        if result.rank_deficient:
            return RawRates(flags=1 << FLAG_BITS["RANK_DEFICIENT"])
        if result.ill_conditioned:
            return RawRates(flags=1 << FLAG_BITS["ILL_CONDITIONED"], condition_word=result.condition)
        return RawRates(rows.n, used, sums.weight_sum, 0, result.condition, result.words)


def _refusals(n: int, used: int) -> list[str]:
    """The flags of a frame that the loader drops."""
    if n > MOST_ROWS:
        return ["TOO_LONG"]
    few = ["FEW_ROWS"] if n < LEAST_ROWS else []
    return few if used else [*few, "ZERO_WEIGHT"]
