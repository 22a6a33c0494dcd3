# SPDX-License-Identifier: Apache-2.0
"""The soak's model that tells coverage/points.py what it sees, once each clock has been compared."""

from __future__ import annotations

from collections.abc import Sequence

from coverage import points
from tb.soak.cores import Core, Settings
from tb.soak.reference import (
    COMPUTE,
    DONE,
    RESULTS,
    RST,
    STATES,
    TREADY,
    TVALID,
    VERIFY,
    Reference,
    Totals,
)


class Observed(Reference):
    """`Reference`, and the cover points of frames, flags and state x event."""

    def __init__(self, core: Core, totals: Totals, behind: int) -> None:
        self._settings = Settings(0, 0, 0)
        super().__init__(core, totals, behind)

    def clock(self, now: int, seen: int, wdata: int, rdata: int, tdata: int, address: int) -> None:
        top, totals, state, started = self.core.top, self.totals, self.state, self.started
        soft, acknowledge, flags = self.soft_reset, self.acknowledge, self.flags
        read, hard = self.araddr, bool(seen & RST) and not self.was_reset
        before = (totals.reads, totals.beats, totals.pushes)
        raised = dict(totals.flags)
        super().clock(now, seen, wdata, rdata, tdata, address)
        if not started:
            return
        happened = []
        if hard:
            happened.append("hard reset")
        if not seen & RST:
            if totals.reads > before[0]:
                known = read in self.name_of
                happened.append(
                    "refused read" if not known else "result read" if read >= RESULTS else "register read"
                )
            if totals.beats > before[1]:
                happened.append("beat")
            elif seen & TVALID and not seen & TREADY:
                happened.append("beat waits")
            if soft:
                happened.append("soft reset")
            if acknowledge:
                happened.append("acknowledge")
            verified = state == VERIFY and self.state == DONE
            if verified or (state == COMPUTE and self._refused(raised)):
                self._frame()
        for what in happened:
            points.event(top, STATES[state], what)
        risen = [name for name, count in totals.flags.items() if count > raised.get(name, 0)]
        points.flag(top, risen)
        gone = [name for name, bit in self.bits.items() if flags & bit and not self.flags & bit]
        if not seen & RST:
            points.flag(top, gone, "cleared")

    def _refused(self, raised: dict[str, int]) -> bool:
        """Whether the frame at hand was found to have no solution in this clock."""
        refusals = ("RANK_DEFICIENT", "ILL_CONDITIONED")
        new = any(self.totals.flags[name] > raised.get(name, 0) for name in refusals)
        return new and self.solved is not None and not self.solved.words

    def _write(self, busy: bool, push_waits: bool, push_open: bool) -> tuple[bool, int, int]:
        state, was_push = STATES[self.state], self.push_valid
        name = self.name_of.get(self.awaddr)
        result = super()._write(busy, push_waits, push_open)
        locked, cleared, _ = result
        what = "register write"
        if name is None:
            what = "refused write"
        elif locked:
            what = "locked write"
        elif self.push_valid and not was_push:
            what = "push"
        elif cleared & self.flags:
            what = "flags cleared"
        points.event(self.core.top, state, what)
        return result

    def _solve(self, now: int) -> None:
        self._settings = Settings(self.config, self.frac, self.variance)
        super()._solve(now)

    def _frame(self) -> None:
        """The frame at hand has come to its end."""
        core, solved, settings = self.core, self.solved, self._settings
        assert solved is not None
        weights: Sequence[int] | None = None
        fracs = [settings.frac & 0xFF]
        if not core.in_front:
            weights = [row[-1] >> 32 & 0xFFFF for row in self.rows]
            fracs.append(settings.frac >> 8 & 0xFF)
        elif self.weighted:
            weights = [row[0] & 0xFFFF for row in self.rows]
        extra = solved.extra if solved.words or "ILL_CONDITIONED" in solved.flags else None
        points.frame(
            core.top,
            n=len(self.rows),
            weights=weights,
            feed="registers" if self.from_push else "stream",
            fracs=[byte - 256 if byte & 128 else byte for byte in fracs],
            variance=settings.variance,
            flags=solved.flags,
            words=solved.words or None,
            condition=None if core.in_front else extra,
            turn=solved.extra if core.in_front else 0,
            config=(bool(settings.config & 2), bool(settings.config & 4), bool(settings.config & 8)),
        )
