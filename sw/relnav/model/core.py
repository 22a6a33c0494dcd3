# SPDX-License-Identifier: Apache-2.0
"""Bit-exact model of the OLTAE core (rtl/oltae/oltae_core.v): a quantised frame in, register words out."""

from __future__ import annotations

from collections.abc import Iterator
from typing import cast

from relnav import words
from relnav.model import pose_program as pose
from relnav.model import statistics_program as statistics
from relnav.model.binary32 import from_binary32
from relnav.model.butterfly import Butterfly, role
from relnav.model.centring import Centring
from relnav.model.gram import GramArray
from relnav.model.lane import LaneValue
from relnav.model.normaliser import Normaliser
from relnav.model.raw import CoreConfig, RawResult, results_from_words
from relnav.model.rom import scheduled
from relnav.model.solver import Solver
from relnav.quantise import QuantisedFrame
from relnav.result import FLAG_NAMES

# lane of a pair -> place in its slot's block of the stream bank
KIND_OF_LANE = (pose.KIND_T, pose.KIND_E, pose.KIND_B2, pose.KIND_F, pose.KIND_H, pose.KIND_P, pose.KIND_N)
LOW_KIND_OF_LANE = {
    0: statistics.KIND_T_LOW,
    2: statistics.KIND_B2_LOW,
    5: statistics.KIND_P_LOW,
    6: statistics.KIND_N_LOW,
}
MAX_POINTS = (1 << words.COUNT) - 1


def flag(name: str) -> int:
    """Bit of a flag."""
    return 1 << FLAG_NAMES.index(name)


class OltaeCore:
    """One core of the full or the lean build; frames are independent of one another."""

    def __init__(self, *, weighted: bool = True) -> None:
        self.weighted = weighted
        self.words = words.build(weighted)
        self.program = scheduled()

    def items(self, frame: QuantisedFrame, config: CoreConfig) -> Iterator[tuple[int, LaneValue, bool]]:
        """(stream address, value, low) of both drains, in the order of the moment stream."""
        gram = GramArray(self.weighted)
        gram.add(frame.a, frame.b, frame.w if self.weighted else None)
        centring, butterfly, normaliser = Centring(self.words), Butterfly(self.words), Normaliser()
        moments: list[tuple[int, int, int]] = []  # slot, lane, value: the second drain repeats the first
        for pair in gram.drain():
            centred = centring.run(gram.weight_sum, pair.moment, pair.first_i, pair.first_j)
            for tag, value in butterfly.push(role(pair.lane), centred, (pair.slot, pair.lane)):
                slot, lane = cast(tuple[int, int], tag)
                moments.append((slot, lane, value))
        for low in (False, True):
            for slot, lane, value in moments:
                kind = LOW_KIND_OF_LANE.get(lane) if low else KIND_OF_LANE[lane]
                if kind is not None:
                    yield 8 * slot + kind, normaliser.run(value, low, (lane == 2) - 2 * frame.frac), low
        first = [m + (gram.weight_sum << 15) for m in gram.first_moments]
        values = [(pose.ITEM_W, gram.weight_sum, 0)]
        values += [(8 * axis + pose.KIND_MA, first[2 * axis], -frame.frac) for axis in range(3)]
        values += [(pose.ITEM_MB + axis, first[2 * axis + 1], -frame.frac) for axis in range(3)]
        values.append((pose.ITEM_COUNT, gram.used_count, 0))
        variance = config.variance_word(frame.weight_scale) & 0x7FFFFFFF  # the hardware leaves its sign out
        values.append((pose.ITEM_VARIANCE, *from_binary32(variance)))
        for address, value, scale in values:
            yield address, normaliser.run(value, False, scale), False

    def refused(self, frame: QuantisedFrame) -> int:
        """Flags of a frame that is not solved, 0 for one that is."""
        if frame.n > MAX_POINTS:
            return flag("TOO_LONG")
        flags = flag("FEW_POINTS") if frame.n < 3 else 0
        if frame.w is not None and self.weighted and not frame.w.any():
            flags |= flag("ZERO_WEIGHT")
        return flags

    def run(self, frame: QuantisedFrame, config: CoreConfig | None = None) -> RawResult:
        """Register words after the frame; a failed frame has only its flags.

        Raises ValueError for integers that do not fit the ports.
        """
        config = config or CoreConfig()
        flags = self.refused(frame)
        if flags:
            return RawResult(flags=flags)
        solver = Solver(forbid_turns=config.forbid_turns, reapply=config.reapply and self.weighted)
        for address, value, low in self.items(frame, config):
            solver.hold(address, value, low)
        solver.run(self.program, whole=False)
        if solver.rank_deficient:
            return RawResult(flags=flag("RANK_DEFICIENT"))
        if solver.ill_conditioned:
            flags |= flag("ILL_CONDITIONED")
        if solver.saturated:
            flags |= flag("Q_SATURATED")
        found = solver.words()
        wanted = config.covariance and self.weighted  # the lean build has no covariances
        results = results_from_words([found.get(index, 0) for index in range(64)], covariance=wanted)
        total = int(frame.w.sum()) if frame.w is not None and self.weighted else frame.n
        return RawResult(points=frame.n, weight=total, turn=solver.turn, flags=flags, **results)  # type: ignore[arg-type]
