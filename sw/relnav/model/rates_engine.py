# SPDX-License-Identifier: Apache-2.0
"""Bit-exact model of rtl/ivisnav/rates_engine.v: the program's operations on six lanes of binary32."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from relnav.model.float32 import Floats, add, divide, from_integer, multiply, subtract
from relnav.model.rates_program import (
    FREEDOM,
    LANES,
    SIZE,
    Bank,
    Bus,
    Operation,
    Track,
    Y,
    program,
)
from relnav.model.rates_residual import ResidualUnit
from relnav.model.rates_scale import FrameScale
from relnav.words import CONDITION_LIMIT, CONVERGED, LOGARITHM, PIVOT_BITS

ONE, ZERO = np.float32(1.0), np.float32(0.0)


@dataclass(frozen=True)
class EngineResult:
    """What a frame leaves. words: by result index, binary32 patterns; condition: cond(H)^2, pattern."""

    rank_deficient: bool
    ill_conditioned: bool
    condition: int
    words: tuple[int, ...]


@dataclass
class RatesEngine:
    """One frame's run.

    moments:  28 exact integers by (row, column), row <= column, 6 for y
    used:     rows of positive weight
    variance: the VARIANCE register, a binary32 word
    """

    moments: dict[tuple[int, int], int]
    scale: FrameScale
    used: int
    variance: int = 0
    S: Floats = field(default_factory=lambda: np.zeros((32, SIZE), np.float32))
    A: Floats = field(default_factory=lambda: np.zeros((8, SIZE), np.float32))
    P: Floats = field(default_factory=lambda: np.zeros((8, SIZE), np.float32))
    residuals: Floats = field(default_factory=lambda: np.zeros(8, np.float32))
    reciprocal: np.float32 = ZERO
    largest: dict[Bank, int] = field(default_factory=dict)
    sizes: dict[Track, int] = field(
        default_factory=lambda: {Track.FIRST_STEP: 0, Track.STEP: 0, Track.RATE: 0}
    )
    """Logarithms of the largest seen."""
    condition: int = 0
    rank_deficient: bool = False
    largest_inverse: int = 0
    """Word of the largest diagonal element of the inverse so far."""

    def run(self) -> EngineResult:
        """All of it; a frame without result still goes through, its words mean nothing then."""
        for (row, column), moment in self.moments.items():
            value = from_integer(moment, self.scale.moment(row, column))
            for lane, address in ((row, column), (column, row)):
                if lane < SIZE:
                    self.A[address, lane] = value
        self.A[FREEDOM, 0] = from_integer(self.used - SIZE, 0)
        diagonal = [int(self.A[k, k].view(np.uint32)) for k in LANES]
        self.largest[Bank.A] = _largest(diagonal)
        residual = ResidualUnit(self.moments, self.scale)
        words: dict[int, int] = {}
        for operation in program():
            if isinstance(operation, Operation):
                self._operate(operation, residual, words)
            elif (value_now := residual.add(operation)) is not None:
                self.residuals[operation.row] = value_now
        first, step, rate = (self.sizes[track] for track in (Track.FIRST_STEP, Track.STEP, Track.RATE))
        finite = max(first, step, rate) < 0xFF << 3
        stalled = not finite or (step != 0 and 2 * step - first - rate > -CONVERGED)
        ill = residual.overflow or stalled or self.condition > CONDITION_LIMIT
        return EngineResult(
            self.rank_deficient, ill, self.condition, tuple(words[index] for index in sorted(words))
        )

    # ------------------------------------------------------------------ one operation

    def _operate(self, step: Operation, residual: ResidualUnit, words: dict[int, int]) -> None:
        bus = self._bus(step)
        x: Floats = np.full(SIZE, ONE) if step.x[0] == Bank.NONE else self._memory(step.x[0])[step.x[1]]
        product = multiply(x, self._factor(step, bus))
        if step.dest is not None:
            c: Floats = np.full(SIZE, ZERO) if step.c[0] == Bank.NONE else self._memory(step.c[0])[step.c[1]]
            total = subtract(c, product) if step.subtract else add(c, product)
            kept = sorted(step.lanes)
            self.S[step.dest, kept] = total[kept]
        if step.product is not None:
            self.P[step.product] = product
        if step.divide:
            self.reciprocal = np.float32(divide(np.asarray([ONE]), np.asarray([bus]))[0])
        if step.load is not None:
            residual.load(step.load, bus)
        if step.track != Track.NONE:
            self._track(step, bus)
        if step.output is not None:
            words[step.output] = scaled_word(bus, self.scale.output(step.scale))

    def _memory(self, bank: Bank) -> Floats:
        return {Bank.S: self.S, Bank.A: self.A, Bank.P: self.P}[bank]

    def _own(self, bus: Bus) -> Floats:
        """What each lane reads for the bus."""
        address = bus.address + (self.largest[bus.bank] if bus.indexed else 0)
        row: Floats = self._memory(bus.bank)[address]
        return row

    def _bus(self, step: Operation) -> np.float32:
        if step.bus is None:
            return ZERO
        value: np.float32 = self._own(step.bus)[step.bus.lane]
        return ZERO if step.clamp and np.signbit(value) else value

    def _factor(self, step: Operation, bus: np.float32) -> Floats:
        if step.y == Y.OWN:
            assert step.bus is not None
            return self._own(step.bus)
        chosen = bus
        if step.y == Y.ONE:
            chosen = ONE
        elif step.y == Y.ZERO:
            chosen = ZERO
        elif step.y == Y.RECIPROCAL:
            chosen = self.reciprocal
        elif step.y == Y.RESIDUAL:
            assert step.bus is not None
            chosen = self.residuals[step.bus.address]
        elif step.y == Y.VARIANCE and not self.scale.estimated:
            chosen = np.uint32(self.variance).view(np.float32)
        return np.full(SIZE, chosen)

    def _track(self, step: Operation, bus: np.float32) -> None:
        word = int(bus.view(np.uint32))
        exponent = word >> 23 & 0xFF
        if step.track == Track.PIVOT:
            assert step.bus is not None
            first = int(self.A[step.bus.lane, step.bus.lane].view(np.uint32)) >> 23 & 0xFF
            noise = word >> 31 == 1 or exponent == 0 or exponent == 255 or exponent + PIVOT_BITS < first
            self.rank_deficient |= noise
        elif step.track == Track.DIAGONAL:
            assert step.bus is not None
            # they come from lane 5 down; the first of equals stays
            if step.bus.lane == SIZE - 1 or word & 0x7FFFFFFF > self.largest_inverse:
                self.largest_inverse = word & 0x7FFFFFFF
                self.largest[Bank.S] = step.bus.lane
        elif step.track == Track.CONDITION:
            self.condition = word
        else:
            self.sizes[step.track] = max(self.sizes[step.track], (word & 0x7FFFFFFF) >> LOGARITHM)


def _largest(words: list[int]) -> int:
    """Place of the largest diagonal element, the first of equals."""
    return max(LANES, key=lambda k: (words[k] & 0x7FFFFFFF, -k))


def scaled_word(value: np.float32, scale: int) -> int:
    """value * 2^scale by its exponent alone: below 2^-126 zero, above the largest infinity, of its sign."""
    word = int(value.view(np.uint32))
    exponent = word >> 23 & 0xFF
    if exponent in (0, 0xFF):
        return word & 0x80000000 if exponent == 0 else word
    exponent += scale
    if exponent <= 0:
        return word & 0x80000000
    if exponent >= 0xFF:
        return (word & 0x80000000) | 0x7F800000
    return (word & 0x807FFFFF) | exponent << 23
