# SPDX-License-Identifier: Apache-2.0
"""Microprogram of the solve engine: terms, dot products, in-order scheduling and the ROM image.

One slot is one term a cycle, broadcast to the four lanes. Lane k works on turn k (0 none, 1 x, 2 y, 3 z)
and, after the turn is chosen, on matrix row k. A dot product is a run of consecutive slots; its result can
be read ``LATENCY`` cycles after its last slot. The scheduler places dot products in the order written, each
at the first cycle where its operands, the write port and the divider are free: the RTL has no interlock, so
the schedule is the proof.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property

LATENCY = 8  # last slot -> first slot that can read the result
RAW_LATENCY = 6  # the same for a raw result, which skips normalisation
RECIPROCAL_LATENCY = 11  # readable dot result -> readable reciprocal
STREAM = 32  # X addresses from here on are the moment stream's bank

LANES = 4
ALL = frozenset(range(LANES))
TURN = 4  # broadcast from the lane of the chosen turn

# result kinds
NORMAL, RAW, FIXED = range(3)
# reference exponents
(
    OWN,
    REF_MOMENT,
    REF_CROSS,
    REF_QUATERNION,
    REF_UNIT,
    REF_CENTROID,
    REF_ROTATED,
    REF_FIXED,
    REF_PROBED,
    REF_NEWTON,
    REF_IMAGE,
    REF_FORM,
    REF_COFACTOR,
) = range(13)
# register whose exponent maximum is tracked
NO_TRACK, TRACK_QUATERNION, TRACK_CENTROID, TRACK_AFRESH = range(4)
# divider start
NO_DIVIDE, DIVIDE, DIVIDE_UNTURNED, DIVIDE_TURNED = range(4)
# result output
NO_OUTPUT, SINGLE, TRIPLE, TRIPLE_COLUMN, PAIR, THIRD = range(6)
# places of the queue that an output fills: lane 0 alone, or lanes 1 to 3
OUTPUT_PLACES = {SINGLE: (0,), TRIPLE: (0, 1, 2), TRIPLE_COLUMN: (0, 1, 2), PAIR: (1, 2), THIRD: (2,)}
# write
NO_WRITE, PRIVATE, BROADCAST = range(3)


def lanes(*members: int) -> frozenset[int]:
    """A set of lanes."""
    return frozenset(members)


@dataclass(frozen=True)
class Term:
    """One product x*y. ``x``/``y`` addresses are XORed with the lane's number where ``*_by_lane``.

    Lanes in ``alternate`` flip address bit 0 of x, lanes in ``negate`` subtract, lanes not in ``enable`` add
    nothing. ``only_estimated`` terms count only where the variance is estimated from the residual,
    ``only_first`` ones only without re-application.
    """

    x: int
    y: int
    negate: frozenset[int] = frozenset()
    enable: frozenset[int] = ALL
    alternate: frozenset[int] = frozenset()
    x_by_lane: bool = False
    y_by_lane: bool = False
    only_estimated: bool = False
    only_first: bool = False


Operands = tuple[tuple[int, int, bool], ...]
"""(X address, Y address, negate) of the terms that count in a lane."""


@dataclass
class Dot:
    """A dot product: its terms and what happens with the sum."""

    name: str
    terms: list[Term]
    kind: int = NORMAL
    half: bool = False
    clamp: bool = False
    reference: int = OWN
    write: int = PRIVATE
    source: int = 0
    dest: int = 0
    turn_dest: bool = False
    only_turned: bool = False
    choose_turn: bool = False
    track: int = NO_TRACK
    divide: int = NO_DIVIDE
    divide_dest: int | None = None
    output: int = NO_OUTPUT
    output_index: int = 0
    mark: str = ""
    earliest: int = 0
    cycle: int = field(default=-1)

    @property
    def latency(self) -> int:
        """Last slot to first readable cycle."""
        return RAW_LATENCY if self.kind == RAW else LATENCY

    @property
    def end(self) -> int:
        """Cycle of the last slot."""
        return self.cycle + self.slots - 1

    @property
    def slots(self) -> int:
        """Slots used: a probed dot product runs twice."""
        return len(self.terms) * (2 if self.reference == REF_PROBED else 1)

    @cached_property
    def operands(self) -> dict[tuple[bool, bool], list[Operands]]:
        """What each lane adds up, by (variance estimated, re-application), then by lane.

        The addresses and signs that the RTL decodes in every slot, decoded once.
        """

        def of_lane(lane: int, estimated: bool, reapply: bool) -> Operands:
            return tuple(
                (
                    term.x ^ (lane if term.x_by_lane else 0) ^ int(lane in term.alternate),
                    term.y ^ (lane if term.y_by_lane else 0),
                    lane in term.negate,
                )
                for term in self.terms
                if lane in term.enable
                and (estimated or not term.only_estimated)
                and not (reapply and term.only_first)
            )

        cases = [(estimated, reapply) for estimated in (False, True) for reapply in (False, True)]
        return {case: [of_lane(lane, *case) for lane in range(LANES)] for case in cases}

    @cached_property
    def used(self) -> list[list[int]]:
        """By turn: the lanes whose sums anything takes. The others' need not be computed."""
        if self.choose_turn or self.write == PRIVATE:
            return [list(range(LANES))] * LANES
        lanes = {place + (self.output != SINGLE) for place in OUTPUT_PLACES.get(self.output, ())}
        if self.kind == FIXED:
            lanes = {0}
        broadcast = self.write == BROADCAST or self.divide != NO_DIVIDE
        sources = [(turn if self.source == TURN else self.source) for turn in range(LANES)]
        return [sorted(lanes | ({source} if broadcast else set())) for source in sources]
