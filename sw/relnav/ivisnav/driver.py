# SPDX-License-Identifier: Apache-2.0
"""Driver of the iVisNav core, for any bus of relnav.driver.Bus."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from relnav.driver import POLLS, CoreDriver, CoreStatus, Feed, join
from relnav.model.raw import variance_word
from relnav.registers import Ivisnav

from .quantise import QuantisedRows
from .raw import FAILURES, RESULT_WORDS, RawRates


@dataclass(frozen=True)
class Build:
    """The BUILD register: what this core was built with. Without verify, results are computed once only."""

    verify: bool
    mantissa: int


@dataclass(frozen=True)
class Status(CoreStatus):
    """STATUS of iVisNav."""

    rates_ready: bool


def beats_of(rows: QuantisedRows) -> list[int]:
    """The 64-bit beats of a frame, four a row: {h1, h0} {h3, h2} {h5, h4} {w, y}."""
    last = join(rows.y, rows.w & 0xFFFF)[:, None]
    beats: list[int] = np.hstack((join(rows.h[:, 0::2], rows.h[:, 1::2]), last)).ravel().tolist()
    return beats


class IvisnavDriver(CoreDriver[Status]):
    """One iVisNav core. `solve` does all of it; the steps are there for who wants something in between."""

    MAP = Ivisnav
    NAME = "iVisNav"
    ROWS = "rows"
    STATUS = Status
    FAILURE_BITS = Ivisnav.FLAGS.encode(**dict.fromkeys(FAILURES, 1))

    def identify(self) -> Build:
        """Check that this is an iVisNav core of our version; raises BackendError that says what was found."""
        build = Ivisnav.BUILD.decode(self.check_identity())
        return Build(verify=bool(build["VERIFY"]), mantissa=build["MANTISSA"])

    def configure(
        self, *, frac_h: int, frac_y: int, variance: float = 0.0, weight_scale: float = 1.0
    ) -> None:
        """Set FRAC and VARIANCE for the next frames.

        frac_h, frac_y: binary places of h and y; variance: of y at the user's unit weight, 0: from rss;
        weight_scale: of `QuantisedRows`. Raises BackendError while a frame is open.
        """
        word = variance_word(variance, weight_scale)
        points = Ivisnav.FRAC.encode(FRAC_H=frac_h, FRAC_Y=frac_y)
        self.check_unlocked()
        self.write_checked(Ivisnav.FRAC, points)
        self.write_checked(Ivisnav.VARIANCE, word)

    def result(self) -> RawRates:
        """The registers of the frame that was solved last, with its flags and cycles."""
        return RawRates(
            n=self.read(Ivisnav.ROWS),
            weight=self.read(Ivisnav.WEIGHT),
            flags=self.read(Ivisnav.FRAME_FLAGS),
            condition_word=self.read(Ivisnav.CONDITION),
            words=tuple(self.result_words(Ivisnav.V, RESULT_WORDS)),
            cycles_rates=self.read(Ivisnav.CYCLES_RATES),
            cycles_all=self.read(Ivisnav.CYCLES_ALL),
        )

    def solve(
        self, rows: QuantisedRows, variance: float = 0.0, *, feed: Feed = "stream", polls: int = POLLS
    ) -> RawRates:
        """Configure, feed, wait, read. variance: of y at the user's unit weight; 0: from the residuals.

        A frame that failed has its flags and no numbers, but the condition where that is the reason.
        Raises UpsetError for numbers that are not to be believed: `recover`, and give the frame again.
        """
        self.configure(
            frac_h=rows.frac_h, frac_y=rows.frac_y, variance=variance, weight_scale=rows.weight_scale
        )
        result = self.finish(self.feed(beats_of(rows), feed), polls, self.result)
        if result is not None:
            return result
        flags = self.read_twice(self.frame_flags)
        told = Ivisnav.FLAGS.ILL_CONDITIONED.get(flags)
        condition = self.read_twice(lambda: self.read(Ivisnav.CONDITION)) if told else 0
        return RawRates(flags=flags, condition_word=condition)
