# SPDX-License-Identifier: Apache-2.0
"""In-order list scheduler of the solve microprogram: gives every dot product its cycle, and so proves it."""

from __future__ import annotations

from collections.abc import Iterable

from relnav.model.assembler import (
    DIVIDE_TURNED,
    FIXED,
    NO_DIVIDE,
    NO_OUTPUT,
    NO_WRITE,
    OUTPUT_PLACES,
    PRIVATE,
    RAW,
    RECIPROCAL_LATENCY,
    REF_CENTROID,
    REF_FORM,
    REF_IMAGE,
    REF_QUATERNION,
    REF_ROTATED,
    SINGLE,
    TRACK_AFRESH,
    TRACK_CENTROID,
    TRACK_QUATERNION,
    Dot,
)

DIVIDER_BUSY = 11  # cycles from one start to the next
# references that a tracked scale enters
SCALED = {
    TRACK_QUATERNION: (REF_QUATERNION, REF_ROTATED, REF_IMAGE, REF_FORM),
    TRACK_AFRESH: (REF_QUATERNION, REF_ROTATED),
    TRACK_CENTROID: (REF_CENTROID, REF_ROTATED),
}
FIXED_STORE, FLOAT_STORE = 6, 9  # last slot -> cycle of the (first) result memory write


def addresses(address: int, by_lane: bool, enabled: Iterable[int]) -> set[int]:
    """Registers that the enabled lanes read."""
    return {address ^ lane for lane in enabled} if by_lane else {address}


def reads(dot: Dot) -> list[set[int]]:
    """Registers each slot reads, X and Y together."""
    found = []
    for term in dot.terms:
        x = addresses(term.x, term.x_by_lane, term.enable)
        if term.alternate:
            x |= {a ^ 1 for a in x}
        found.append(x | addresses(term.y, term.y_by_lane, term.enable))
    return found  # a probed dot product reads them twice: ready for the first pass is ready for the second


def writes(dot: Dot) -> set[int]:
    """Registers the dot product may write (without its reciprocal)."""
    if dot.write == NO_WRITE:
        return set()
    return {dot.dest, dot.dest | 8} if dot.turn_dest else {dot.dest}


def stores(dot: Dot, cycle: int) -> set[int]:
    """Cycles in which the result memory is written, if the dot product starts at ``cycle``."""
    end = cycle + dot.slots - 1
    if dot.kind == FIXED:
        return {end + FIXED_STORE}
    if dot.output == NO_OUTPUT:
        return set()
    return {end + FLOAT_STORE + k for k in OUTPUT_PLACES[dot.output]}


class Scheduler:
    """Places dot products; ``ready`` maps a register to the first cycle in which it can be read."""

    def __init__(self, ready: dict[int, int], references: dict[int, int]) -> None:
        self.ready = dict(ready)
        self.references = dict(references)
        self.next_slot = 0
        self.busy_writes: set[int] = set()  # cycles (in units of readable-at) in which a result is written
        self.divider_free = 0
        self.output_free = 0
        self.busy_stores: set[int] = set()  # cycles in which the result memory is written

    def fits(self, dot: Dot, cycle: int) -> bool:
        """Whether the dot product can start at ``cycle``."""
        if cycle < self.references.get(dot.reference, 0):
            return False
        if any(self.ready.get(a, 0) > cycle + slot for slot, read in enumerate(reads(dot)) for a in read):
            return False
        done = cycle + dot.slots - 1 + dot.latency
        if dot.write != NO_WRITE and done in self.busy_writes:
            return False
        if dot.divide != NO_DIVIDE and (
            (done < self.divider_free and dot.divide != DIVIDE_TURNED)
            or done + RECIPROCAL_LATENCY in self.busy_writes
        ):
            return False
        if stores(dot, cycle) & self.busy_stores:
            return False
        return not (dot.output != NO_OUTPUT and done < self.output_free)

    def place(self, dot: Dot) -> None:
        """Give ``dot`` its cycle."""
        assert dot.kind != RAW or dot.write == PRIVATE, "a raw result leaves before the bus"
        cycle = max(self.next_slot, dot.earliest)
        while not self.fits(dot, cycle):
            cycle += 1
        dot.cycle = cycle
        self.next_slot = dot.end + 1
        done = dot.end + dot.latency
        if dot.write != NO_WRITE:
            self.busy_writes.add(done)
        for register in writes(dot):
            self.ready[register] = done
        if dot.divide != NO_DIVIDE:
            self.divider_free = done + DIVIDER_BUSY
            self.busy_writes.add(done + RECIPROCAL_LATENCY)
            assert dot.divide_dest is not None
            self.ready[dot.divide_dest] = done + RECIPROCAL_LATENCY
        for reference in SCALED.get(dot.track, ()):
            self.references[reference] = max(self.references.get(reference, 0), done)
        self.busy_stores |= stores(dot, dot.cycle)
        if dot.output != NO_OUTPUT:
            self.output_free = done + (1 if dot.output == SINGLE else 3)

    def run(self, dots: Iterable[Dot]) -> list[Dot]:
        """Place all; returns them in order."""
        placed = list(dots)
        for dot in placed:
            self.place(dot)
        return placed
