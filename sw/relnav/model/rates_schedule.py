# SPDX-License-Identifier: Apache-2.0
"""List scheduler of the rates' program: gives every operation its cycle, and so proves it free of hazards.

Cycle 0 is that of the first moment at the engine. The RTL has no interlock: what an operation reads is ready
because the schedule says so. Lane operations and residual terms are issued one a cycle each.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Hashable
from dataclasses import dataclass
from functools import cache

from relnav.model.gram_ring import DRAIN_ORDER
from relnav.model.rates_program import (
    FREEDOM,
    LANES,
    SIZE,
    Bank,
    Bus,
    Mark,
    Operation,
    Step,
    Track,
    Y,
    program,
)

# Cycles after its issue in which an operation reads (its bus operand at once)
FACTOR = 1  # x, and what of y is special
ADDEND = 4  # c, a clock before the product is there
PLACE = -1  # the index of an indexed bus operand goes into the address before
# Issue to first cycle in which what was written can be read
PRODUCT = 6  # P: own, bus, float_multiply, the memory
SUM = 10  # S: own, bus, float_multiply, float_add, the memory
RECIPROCAL = 13  # own, bus, float_divide
LOAD = 3  # a rate in the residual unit: own, bus, its memory
RESIDUAL = 14  # last term to the residual's memory
TRACK = 3  # own, bus, what looks at it
MOMENT = 5  # a moment at the engine to its float in the lanes
FIRST = 3  # first cycle with a word of the program

Resource = Hashable


@dataclass(frozen=True)
class Access:
    """A resource and when it is touched, from the issue on: the read, or the first cycle it can be read."""

    resource: Resource
    offset: int


def bus_addresses(bus: Bus) -> list[int]:
    """What an indexed operand may read."""
    return [bus.address + j for j in LANES] if bus.indexed else [bus.address]


def reads(step: Step) -> list[Access]:
    """Everything a step reads."""
    if not isinstance(step, Operation):
        row, column = min(step.row, step.column), max(step.row, step.column)
        moments = [Access(("moment", row, column), 0)]
        accumulator = [] if step.first else [Access(("sum", step.row), 0)]
        return [*moments, *accumulator, Access(("rate", step.column), 0)]
    found = []
    lanes = step.lanes
    if step.x[0] != Bank.NONE:
        found += [Access((step.x[0], lane, step.x[1]), FACTOR) for lane in lanes]
    if step.c[0] != Bank.NONE:
        found += [Access((step.c[0], lane, step.c[1]), ADDEND) for lane in lanes]
    bus = step.bus
    if step.y == Y.RECIPROCAL:
        found.append(Access("reciprocal", FACTOR))
    elif step.y == Y.RESIDUAL:
        assert bus is not None
        found.append(Access(("residual", bus.address), FACTOR))
    elif bus is not None:
        readers = lanes if step.y == Y.OWN else [bus.lane]
        found += [Access((bus.bank, lane, a), 0) for lane in readers for a in bus_addresses(bus)]
        if bus.indexed:
            found.append(Access(("largest", bus.bank), PLACE))
    if step.mark == Mark.RATES:
        found += [Access(("track", track), 0) for track in Track]
    if step.mark != Mark.NONE:
        found.append(Access("outputs", 0))
    return found


def writes(step: Step) -> list[Access]:
    """Everything a step writes."""
    if not isinstance(step, Operation):
        accumulator = [Access(("sum", step.row), 1)]
        return [*accumulator, Access(("residual", step.row), RESIDUAL)] if step.last else accumulator
    found = []
    if step.product is not None:
        found += [Access((Bank.P, lane, step.product), PRODUCT) for lane in LANES]
    if step.dest is not None:
        found += [Access((Bank.S, lane, step.dest), SUM) for lane in step.lanes]
    if step.divide:
        found.append(Access("reciprocal", RECIPROCAL))
    if step.load is not None:
        found.append(Access(("rate", step.load), LOAD))
    if step.track == Track.DIAGONAL:
        found.append(Access(("largest", Bank.S), TRACK))
    if step.track != Track.NONE:
        found.append(Access(("track", step.track), TRACK))
    if step.output is not None:
        found.append(Access("outputs", 1))
    return found


def arrivals() -> dict[Resource, int]:
    """Cycle from which each moment can be read: in the lanes as float, in the residual unit as integer."""
    ready: dict[Resource, int] = {}
    for number, (row, column) in enumerate(DRAIN_ORDER):
        ready["moment", row, column] = number + 1
        for lane, address in ((row, column), (column, row)):
            if lane < SIZE:
                ready[Bank.A, lane, address] = number + MOMENT
    ready[Bank.A, 0, FREEDOM] = len(DRAIN_ORDER) + MOMENT
    diagonal = max(number for number, (row, column) in enumerate(DRAIN_ORDER) if row == column < SIZE)
    ready["largest", Bank.A] = diagonal + MOMENT
    ready["rate", SIZE] = 0
    return ready


Edge = tuple[int, int]
"""Number of the later step, and how many cycles after this one it may be issued at the earliest."""


def dependences(steps: tuple[Step, ...]) -> list[list[Edge]]:
    """By step: what must come after it, in the meaning of the program's order."""
    edges: list[list[Edge]] = [[] for _ in steps]
    last_write: dict[Resource, tuple[int, int]] = {}
    readers: dict[Resource, list[tuple[int, int]]] = defaultdict(list)
    for number, step in enumerate(steps):
        for read in reads(step):
            if read.resource in last_write:
                writer, latency = last_write[read.resource]
                edges[writer].append((number, latency - read.offset))
            readers[read.resource].append((number, read.offset))
        for write in writes(step):
            # what is written at the end of a cycle may still be read in it
            for reader, offset in readers.pop(write.resource, []):
                if reader != number:
                    edges[reader].append((number, offset - write.offset + 1))
            if write.resource in last_write:
                writer, latency = last_write[write.resource]
                if writer != number:
                    edges[writer].append((number, latency - write.offset + 1))
            last_write[write.resource] = (number, write.offset)
    return edges


@dataclass(frozen=True)
class Schedule:
    """The steps of the program and their cycles."""

    steps: tuple[Step, ...]
    cycles: tuple[int, ...]

    def cycle(self, mark: Mark) -> int:
        """Cycle of the operation with the mark."""
        found = (
            cycle
            for step, cycle in zip(self.steps, self.cycles, strict=True)
            if isinstance(step, Operation) and step.mark == mark
        )
        return next(found)


@cache
def schedule() -> Schedule:
    """Greedy: in each cycle, of the steps that are ready, the one with the longest way still to go."""
    steps = program()
    edges = dependences(steps)
    order = range(len(steps))
    height = [0] * len(steps)
    for number in reversed(order):  # edges lead forwards
        base = 1 if steps[number].urgent else -10_000
        height[number] = max([base, *(height[later] + max(delay, 0) for later, delay in edges[number])])
    waiting = [0] * len(steps)
    for number in order:
        for later, _ in edges[number]:
            waiting[later] += 1
    ready_at = arrivals()
    earliest = [
        max([FIRST, *(ready_at[r.resource] - r.offset for r in reads(step) if r.resource in ready_at)])
        for step in steps
    ]
    cycles = [-1] * len(steps)
    open_steps = {number for number in order if waiting[number] == 0}
    cycle = 0
    while open_steps:
        for kind in (True, False):
            fit = [n for n in open_steps if isinstance(steps[n], Operation) == kind and earliest[n] <= cycle]
            if not fit:
                continue
            chosen = max(fit, key=lambda n: (height[n], -n))
            open_steps.remove(chosen)
            cycles[chosen] = cycle
            for later, delay in edges[chosen]:
                earliest[later] = max(earliest[later], cycle + delay)
                waiting[later] -= 1
                if waiting[later] == 0:
                    open_steps.add(later)
        cycle += 1
    return Schedule(steps, tuple(cycles))
