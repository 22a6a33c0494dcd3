# SPDX-License-Identifier: Apache-2.0
"""The iVisNav core after a reset: its frames and its model for tb/common/core_bench."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import ClassVar

from relnav.driver import Feed
from relnav.ivisnav.driver import IvisnavDriver, beats_of
from relnav.ivisnav.quantise import QuantisedRows
from relnav.ivisnav.raw import FAILURES, RESULT_WORDS, RawRates
from relnav.model.rates_core import RatesCore

from tb.common.core_bench import CoreBench
from tb.ivisnav.frames import observe, random_rows


class Bench(CoreBench):
    """iVisNav. Frames are fed with VARIANCE 0 but by `solve`."""

    DRIVER = IvisnavDriver
    GROUPS: ClassVar = {"rates": range(6), "all": range(6, 28)}
    EMPTY = RawRates(words=(0,) * RESULT_WORDS)
    BEATS, LEAST, FEW = 4, 6, "FEW_ROWS"
    FAILURES = FAILURES
    LOCKED = ("FRAC", "VARIANCE")

    model = RatesCore()

    def good(self, n: int | None = None) -> QuantisedRows:
        while True:
            frame = random_rows(self.rng, n or 8, "rates")
            if not self.model.run(frame, 0.0).flags:
                return frame

    def expected(self, frame: QuantisedRows) -> RawRates:
        return self.model.run(frame, 0.0)

    def prepare(self, driver: IvisnavDriver, frame: QuantisedRows) -> IvisnavDriver:
        driver.configure(frac_h=frame.frac_h, frac_y=frame.frac_y)
        return driver

    def beats(self, frame: QuantisedRows) -> list[int]:
        return beats_of(frame)

    def tail(self, frame: QuantisedRows, rows: int) -> QuantisedRows:
        return replace(frame, h=frame.h[-rows:], y=frame.y[-rows:], w=frame.w[-rows:])

    def like(self, first: QuantisedRows, frame: QuantisedRows) -> QuantisedRows:
        return replace(frame, frac_h=first.frac_h, frac_y=first.frac_y)

    def words(self, raw: RawRates) -> Sequence[int]:
        assert raw.words is not None
        return list(raw.words)

    async def solve(self, frame: QuantisedRows, feed: Feed = "stream", variance: float = 0.0) -> RawRates:
        expected = self.model.run(frame, variance)
        found: RawRates = await self.check(
            lambda driver: driver.solve(frame, variance, feed=feed, polls=500 + frame.n),
            expected,
            tell(frame, variance),
        )
        if "ILL_CONDITIONED" in found.flag_names:
            assert found.condition_word == expected.condition_word, tell(frame, variance)
        observe(frame, variance, feed, found)
        return found


def tell(frame: QuantisedRows, variance: float) -> str:
    """Everything to run it again."""
    rows = "" if frame.n > 20 else f" h={frame.h.tolist()} y={frame.y.tolist()}"
    fracs = f"frac_h={frame.frac_h} frac_y={frame.frac_y}"
    return f"variance={variance} n={frame.n} {fracs}{rows} w={frame.w.tolist()[:20]}"
