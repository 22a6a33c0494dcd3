# SPDX-License-Identifier: Apache-2.0
"""rates_monitor, every clock, against its header: each threshold a step either side, NaN, infinity, zero."""

from __future__ import annotations

import random
from dataclasses import dataclass, field
from itertools import product
from pathlib import Path

import numpy as np
from relnav.model.rates_engine import RatesEngine
from relnav.model.rates_program import LANES, SIZE, Bank, Bus, Operation, Track
from relnav.model.rates_scale import FrameScale
from relnav.words import CONDITION_LIMIT, CONVERGED, LOGARITHM, PIVOT_BITS

from tb.common.replay import run
from tb.common.vectors import pack

SIGN = 1 << 31
MAGNITUDE = SIGN - 1
ONE = 0x3F800000
INFINITY = 0x7F800000
NAN = 0x7FC00000
WIDTHS = [3, 3, 1, 1, 1, 32]
SIZES = (Track.FIRST_STEP, Track.STEP, Track.RATE)
EIGHTH = 1 << LOGARITHM
FRAMES = {"icarus": 400, "verilator": 2_000}


@dataclass
class Monitor:
    """What has counted so far. The bus counts two clocks later, a moment in the next."""

    exponents: list[int] = field(default_factory=lambda: [0] * SIZE)
    largest: int = 0
    moment_place: int = 0
    largest_inverse: int = 0
    inverse_place: int = 0
    rank_deficient: bool = False
    sizes: dict[Track, int] = field(default_factory=lambda: dict.fromkeys(SIZES, 0))
    condition: int = 0
    seen: tuple[Track, int, int] = (Track.NONE, 0, 0)
    """What was on the bus a clock ago."""

    def outputs(self) -> list[int]:
        """In the order of the wrapper's fields."""
        first, step, rate = (self.sizes[kind] for kind in SIZES)
        finite = all(size >> 3 < 255 for size in (first, step, rate))
        stalled = not finite or (step > 0 and 2 * step - first - rate > -CONVERGED)
        excessive = self.condition > CONDITION_LIMIT  # signs and NaN too
        doubts = [int(x) for x in (self.rank_deficient, stalled, excessive)]
        return [self.moment_place, self.inverse_place, *doubts, self.condition]

    def clock(self, clear: bool, diagonal: tuple[int, int] | None, bus: tuple[Track, int, int]) -> None:
        """diagonal: place and word. bus: what is tracked, lane, word."""
        track, lane, word = self.seen
        exponent, magnitude = word >> 23 & 0xFF, word & MAGNITUDE
        if track == Track.PIVOT:
            small = exponent + PIVOT_BITS < self.exponents[lane]
            self.rank_deficient |= word >> 31 == 1 or exponent in (0, 255) or small
        elif track == Track.DIAGONAL and (lane == SIZE - 1 or magnitude > self.largest_inverse):
            self.largest_inverse, self.inverse_place = magnitude, lane
        elif track in SIZES:
            self.sizes[track] = max(self.sizes[track], magnitude // EIGHTH)
        elif track == Track.CONDITION:
            self.condition = word
        if clear:
            self.rank_deficient = False
            self.sizes = dict.fromkeys(SIZES, 0)
        if diagonal is not None:
            place, moment = diagonal
            self.exponents[place] = moment >> 23
            if place == 0 or moment > self.largest:
                self.largest, self.moment_place = moment, place
        self.seen = bus


IDLE = (Track.NONE, 0, 0)


@dataclass
class Play:
    """Stimulus and expected outputs by clock."""

    monitor: Monitor = field(default_factory=Monitor)
    stimulus: list[int] = field(default_factory=list)
    expected: list[tuple[int, list[int]]] = field(default_factory=list)
    known: bool = False
    """All state has been written once."""

    def __post_init__(self) -> None:
        """Give everything a value."""
        self.frame([ONE] * SIZE)
        for lane in reversed(LANES):
            self.clock(bus=(Track.DIAGONAL, lane, ONE))
        self.clock(bus=(Track.CONDITION, 0, ONE))
        self.rest()
        self.known = True

    def clock(
        self,
        clear: bool = False,
        diagonal: tuple[int, int] | None = None,
        bus: tuple[Track, int, int] = IDLE,
    ) -> None:
        """One clock; the outputs are those before it."""
        if self.known:
            self.expected.append((len(self.stimulus), self.monitor.outputs()))
        place, moment = diagonal or (0, 0)
        head = [
            (int(self.known), 1),
            (int(clear), 1),
            (int(diagonal is not None), 1),
            (place, 3),
            (moment, 32),
        ]
        self.stimulus.append(pack([*head, (bus[0], 3), (bus[1], 3), (bus[2], 32)]))
        self.monitor.clock(clear, diagonal, bus)

    def frame(self, diagonal: list[int], gaps: random.Random | None = None) -> None:
        """Clear, and the moments' diagonal, with idle clocks between where `gaps` is given."""
        self.clock(clear=True)
        for place, moment in enumerate(diagonal):
            while gaps is not None and gaps.random() < 0.3:
                self.clock()
            self.clock(diagonal=(place, moment))

    def rest(self) -> None:
        """Until the last word has counted."""
        for _ in range(3):
            self.clock()

    def check(self, simulator: str, folder: Path) -> None:
        self.rest()
        top = Path(__file__).parent / "rates_monitor_replay.v"
        got = run(top, ["ivisnav"], simulator, folder, self.stimulus, 76, WIDTHS, {})
        assert len(got) == len(self.expected)
        for mine, theirs in zip(got, self.expected, strict=True):
            assert mine == theirs


def test_pivots(simulator: str, tmp_path: Path) -> None:
    """Every exponent of a diagonal element, pivots around 2^-22 of it, and those that are no pivots."""
    rng = random.Random(208)
    play = Play()
    seen = set()
    for first in range(256):
        for step in (-PIVOT_BITS - 1, -PIVOT_BITS, -PIVOT_BITS + 1, 0):
            lane = rng.randrange(SIZE)
            diagonal = [rng.getrandbits(31) for _ in LANES]
            diagonal[lane] = first << 23 | rng.getrandbits(23)
            play.frame(diagonal)
            exponent = max(first + step, 0)
            play.clock(bus=(Track.PIVOT, lane, exponent << 23 | rng.choice([0, 0x7FFFFF])))
            play.rest()
            seen.add((step, play.monitor.rank_deficient))
    assert {(-PIVOT_BITS - 1, True), (-PIVOT_BITS, False), (0, False)} <= seen
    bad = [0, 1, 0x7FFFFF, INFINITY, NAN, INFINITY | 1, MAGNITUDE, SIGN, ONE | SIGN, NAN | SIGN]
    for word, lane in product([*bad, ONE, 0x00800000, INFINITY - 1], LANES):
        play.frame([0] * SIZE)
        play.clock(bus=(Track.PIVOT, lane, word))
        play.clock(bus=(Track.PIVOT, lane, ONE))  # a good one forgives nothing
        play.rest()
        assert play.monitor.rank_deficient == (word in bad)
    play.check(simulator, tmp_path)


def test_largest_elements(simulator: str, tmp_path: Path) -> None:
    """The first of equals stays; both directions; neighbours, infinities and NaNs; frame after frame."""
    rng = random.Random(209)
    play = Play()
    words = [0, 1, 0x00800000, ONE, ONE + 1, INFINITY - 1, INFINITY, NAN, MAGNITUDE]
    for number in range(300):
        few = rng.sample(words, 2) if number % 2 else words
        diagonal = [rng.choice(few) for _ in LANES]
        inverse = [rng.choice(few) | rng.choice([0, SIGN]) for _ in LANES]
        play.frame(diagonal, rng)
        assert play.monitor.moment_place == diagonal.index(max(diagonal))
        for lane in reversed(LANES):
            while rng.random() < 0.2:
                play.clock(bus=(Track.NONE, rng.randrange(SIZE), NAN))
            play.clock(bus=(Track.DIAGONAL, lane, inverse[lane]))
        play.rest()
        sizes = [word & MAGNITUDE for word in inverse]
        assert play.monitor.inverse_place == SIZE - 1 - sizes[::-1].index(max(sizes))
    play.check(simulator, tmp_path)


def test_convergence(simulator: str, tmp_path: Path) -> None:
    """step^2 / first step against the rate: an eighth of an octave either side; not finite; zeros."""
    rng = random.Random(210)
    play = Play()
    stalls = set()

    def sizes(first: int, step: int, rate: int) -> bool:
        """The three sizes among smaller ones, in any order; whether it has stalled."""
        play.clock(clear=True)
        words = [(kind, size * EIGHTH) for kind, size in zip(SIZES, (first, step, rate), strict=True)]
        words += [(kind, word // 2) for kind, word in words]
        rng.shuffle(words)
        for kind, word in words:
            low = rng.choice([0, EIGHTH - 1]) if word % EIGHTH == 0 else 0
            play.clock(bus=(kind, rng.randrange(SIZE), word | low | rng.choice([0, SIGN])))
        play.rest()
        return play.monitor.outputs()[3] == 1

    for _ in range(200):
        step = rng.randrange(8, 8 * 220)
        rate = rng.randrange(max(8, step - 400), min(2039, step + 400))
        for more in (-1, 0, 1):
            first = 2 * step - rate + CONVERGED + more
            if 0 <= first < 2040:
                stalls.add((more, sizes(first, step, rate)))
    assert stalls == {(-1, True), (0, False), (1, False)}
    for first, step, rate in product((0, 1, 1016, 2039, 2040, 2047), repeat=3):
        sizes(first, step, rate)
    assert not sizes(0, 0, 0)  # nothing to refine
    assert not sizes(2039, 0, 0)
    assert sizes(0, 1, 0)
    for kind, word in product(SIZES, (INFINITY, INFINITY | SIGN, NAN, NAN | SIGN, INFINITY | 1, MAGNITUDE)):
        play.clock(clear=True)
        for lane in LANES:
            play.clock(bus=(kind, lane, word if lane == 2 else ONE))
        play.rest()
        assert play.monitor.outputs()[3] == 1
    play.check(simulator, tmp_path)


def test_condition(simulator: str, tmp_path: Path) -> None:
    """The limit and its neighbours; a clear keeps the last frame's."""
    play = Play()
    assert int(np.float32(2000.0**2).view(np.uint32)) == CONDITION_LIMIT
    for step, excessive in ((-1, 0), (0, 0), (1, 1), (EIGHTH, 1)):
        play.clock(bus=(Track.CONDITION, 0, CONDITION_LIMIT + step))
        play.rest()
        assert play.monitor.outputs()[4] == excessive
    for word in (0, ONE, INFINITY - 1, INFINITY, NAN, MAGNITUDE, SIGN, ONE | SIGN, NAN | SIGN):
        play.clock(bus=(Track.CONDITION, 5, word))
        play.rest()
        play.clock(clear=True)
        play.rest()
    play.check(simulator, tmp_path)


def random_word(rng: random.Random, centre: int) -> int:
    if rng.random() < 0.01:
        return rng.choice([0, SIGN, 1, INFINITY, NAN])
    exponent = min(max(centre + rng.randint(-3, 3), 1), 254)
    return exponent << 23 | rng.choice([0, 0x7FFFFF, rng.getrandbits(23)]) | rng.choice([0, 0, 0, SIGN])


def test_random_frames(simulator: str, tmp_path: Path) -> None:
    """A word a clock, a clear anywhere; the engine's model agrees wherever a frame ends undisturbed."""
    rng = random.Random(211)
    play = Play()
    compared = 0
    for _ in range(FRAMES[simulator]):
        base = rng.randint(30, 220)
        diagonal = [random_word(rng, base) & MAGNITUDE for _ in LANES]
        play.frame(diagonal)
        if rng.random() < 0.5:
            play.rest()
        events = [
            (Track.PIVOT, k, random_word(rng, base - rng.choice([0, 5, 20])) & MAGNITUDE) for k in LANES
        ]
        events += [(Track.DIAGONAL, k, random_word(rng, base)) for k in reversed(LANES)]
        octaves = rng.randint(6, 20)
        for kind, lower in zip(SIZES, (octaves, octaves * 3 // 2, 0), strict=True):
            events += [(kind, k, random_word(rng, base - lower)) for k in LANES]
        events.append((Track.CONDITION, 0, random_word(rng, CONDITION_LIMIT >> 23)))
        disturbed = False
        for event in events:
            while rng.random() < 0.1:
                play.clock(bus=(Track.NONE, rng.randrange(SIZE), rng.getrandbits(32)))
            clear = rng.random() < 0.005
            disturbed |= clear
            play.clock(clear=clear, bus=event)
        if rng.random() < 0.5:
            play.rest()
            if not disturbed:
                compare(play.monitor, diagonal, events)
                compared += 1
    assert compared > FRAMES[simulator] // 4
    play.check(simulator, tmp_path)


def compare(monitor: Monitor, diagonal: list[int], events: list[tuple[Track, int, int]]) -> None:
    """The model of the engine has kept the same."""
    engine = RatesEngine({}, FrameScale(0, 0, 0), 6)
    np.fill_diagonal(engine.A[:SIZE], np.array(diagonal, np.uint32).view(np.float32))
    for track, lane, word in events:
        step = Operation("", bus=Bus(Bank.S, 0, lane), track=track)
        engine._track(step, np.uint32(word).view(np.float32))
    assert engine.sizes == monitor.sizes
    assert engine.rank_deficient == monitor.rank_deficient
    assert engine.condition == monitor.condition
    assert engine.largest[Bank.S] == monitor.inverse_place
