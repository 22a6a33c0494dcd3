# SPDX-License-Identifier: Apache-2.0
"""The OLTAE core after a reset: its frames and its model for tb/common/core_bench."""

from __future__ import annotations

import os
from collections.abc import Sequence
from dataclasses import replace
from typing import Any, ClassVar

from relnav.driver import Feed, OltaeDriver, beats_of
from relnav.model.core import OltaeCore
from relnav.model.raw import CoreConfig, RawResult
from relnav.quantise import QuantisedFrame
from relnav.result import FAILURES

from tb.common.core_bench import CoreBench
from tb.oltae.frames import observe, random_frame

FULL = os.environ.get("FULL", "1") == "1"
PLAIN = CoreConfig(covariance=FULL)


class Bench(CoreBench):
    """OLTAE in either build."""

    DRIVER = OltaeDriver
    GROUPS: ClassVar = {"q": range(3), "pose": range(6, 18), "all": range(18, 34)}
    EMPTY = RawResult()
    BEATS, LEAST, FEW = 3, 3, "FEW_POINTS"
    FAILURES = FAILURES
    LOCKED = ("CONFIG", "FRAC", "VARIANCE")
    KINDS = ({}, {"weights": True}) if FULL else ({},)

    def __init__(self, dut: Any, seed: int) -> None:
        super().__init__(dut, seed)
        self.model = OltaeCore(weighted=FULL)

    def good(self, n: int | None = None, weights: bool = False) -> QuantisedFrame:
        while True:
            frame = random_frame(self.rng, n or 4, weights, "pose")
            if not self.model.run(frame).flags:
                return frame

    def expected(self, frame: QuantisedFrame) -> RawResult:
        return self.model.run(frame, PLAIN)

    def prepare(self, driver: OltaeDriver, frame: QuantisedFrame) -> OltaeDriver:
        driver.configure(PLAIN, frac=frame.frac, weighted=frame.w is not None)
        return driver

    def beats(self, frame: QuantisedFrame) -> list[int]:
        return beats_of(frame)

    def tail(self, frame: QuantisedFrame, rows: int) -> QuantisedFrame:
        assert frame.w is None
        return replace(frame, a=frame.a[-rows:], b=frame.b[-rows:])

    def like(self, first: QuantisedFrame, frame: QuantisedFrame) -> QuantisedFrame:
        return replace(frame, frac=first.frac)

    def words(self, raw: RawResult) -> Sequence[int]:
        return raw.result_words()

    async def solve(
        self, frame: QuantisedFrame, feed: Feed = "stream", config: CoreConfig = PLAIN
    ) -> RawResult:
        polls = 500 + frame.n
        found: RawResult = await self.check(
            lambda driver: driver.solve(frame, config, feed=feed, polls=polls),
            self.model.run(frame, config),
            tell(frame, config),
        )
        observe(frame, config, feed, found)
        return found


def tell(frame: QuantisedFrame, config: CoreConfig) -> str:
    """Everything to run it again."""
    points = "" if frame.n > 20 else f" a={frame.a.tolist()} b={frame.b.tolist()}"
    weights = None if frame.w is None else frame.w.tolist()[:20]
    return f"{config} n={frame.n} frac={frame.frac}{points} w={weights}"
