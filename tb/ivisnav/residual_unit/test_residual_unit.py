# SPDX-License-Identifier: Apache-2.0
"""residual_unit against ResidualUnit: exact sums of terms in any order, at any distance, in their cycle."""

from __future__ import annotations

import random
from collections.abc import Iterator
from dataclasses import dataclass, field
from itertools import product
from pathlib import Path

import numpy as np
from relnav.model.rates_program import SIZE, Term
from relnav.model.rates_residual import EXPONENT_OFFSET, LARGEST_EXPONENT, ResidualUnit
from relnav.model.rates_scale import FrameScale

from tb.common.replay import run
from tb.common.vectors import pack, random_value, to_signed

LATENCY = 9
SUM = 184
ROWS = SIZE + 1
PAIRS = [(row, column) for row in range(ROWS) for column in range(row, ROWS)]
LARGEST = (1 << 95) - 1  # moment
LARGEST_RATE = LARGEST_EXPONENT << 23 | 0x7FFFFF
RIGHTS = range(-32, 31)
SIGN = 1 << 31
COUNTS = {"icarus": 4_000, "verilator": 40_000}  # terms

Moment = tuple[int, int, int]
"""Row, column, value."""
Load = tuple[int, int]
"""Place, word."""


def scale_of(right: int) -> FrameScale:
    """Sizes that differ by `right`."""
    return FrameScale(max(right + 2, 0), max(2, -right), 32)


@dataclass
class Play:
    """Stimulus, clock by clock, and what the unit must say in each of them."""

    right: int = 0
    stimulus: list[int] = field(default_factory=list)
    overflows: list[bool] = field(default_factory=list)
    residuals: dict[int, tuple[int, int]] = field(default_factory=dict)
    """(row, sum) by clock."""
    open_rows: set[int] = field(default_factory=set)
    """Rows that have terms, and may go on."""
    model: ResidualUnit = field(init=False)

    def __post_init__(self) -> None:
        """Everything is zero, written in the clocks it takes."""
        self.model = ResidualUnit(dict.fromkeys(PAIRS, 0), scale_of(self.right))
        for number, pair in enumerate(PAIRS):
            self.clock(clear=number == 0, moment=(*pair, 0), load=(number % SIZE, 0))

    def clock(
        self,
        *,
        clear: bool = False,
        moment: Moment | None = None,
        load: Load | None = None,
        term: Term | None = None,
    ) -> None:
        """One clock. The term reads what was there before it; a clear drops what is on its way."""
        now = len(self.stimulus)
        self.model.scale = scale_of(self.right)
        self.overflows.append(self.model.overflow)
        if term is not None and not clear:
            self.model.add(term)
            self.open_rows.add(term.row)
            if term.last:
                self.residuals[now + LATENCY] = term.row, self.model.sums[term.row]
        if moment is not None:
            self.model.moments[moment[0], moment[1]] = moment[2]
        if load is not None:
            self.model.load(load[0], np.uint32(load[1]).view(np.float32))
        if clear:
            self.model.overflow = False
            self.open_rows.clear()
            self.residuals = {clock: said for clock, said in self.residuals.items() if clock <= now}
        at_row, at_column, value = moment or (0, 0, 0)
        place, word = load or (0, 0)
        t = term or Term(0, 0, False, False)
        fields = [
            (int(now > 0), 1),
            (int(clear), 1),
            (int(moment is not None), 1),
            (at_row, 3),
            (at_column, 3),
        ]
        fields += [(value, 96), (self.right, 7), (int(load is not None), 1), (place, 3), (word, 32)]
        fields += [(int(term is not None), 1), (t.row, 3), (t.column, 3), (int(t.first), 1), (int(t.last), 1)]
        self.stimulus.append(pack(fields))

    def row(self, row: int) -> None:
        """All seven terms of a row."""
        for column in range(ROWS):
            self.clock(term=Term(row, column, column == 0, column == SIZE))

    def check(self, simulator: str, folder: Path) -> None:
        """Simulate, with time for the last residual, and compare."""
        for _ in range(LATENCY + 1):
            self.clock()
        top = Path(__file__).parent / "residual_unit_replay.v"
        got = run(top, ["ivisnav"], simulator, folder, self.stimulus, 158, [1, 1, 3, SUM], {})
        assert [clock for clock, _ in got] == list(range(1, len(self.stimulus)))
        for clock, (overflow, valid, row, value) in got:
            assert overflow == self.overflows[clock], clock
            said = (row, to_signed(value, SUM)) if valid else None
            assert said == self.residuals.get(clock), clock


def random_moment(rng: random.Random) -> int:
    kind = rng.randrange(8)
    if kind == 0:
        return rng.choice([LARGEST, -LARGEST])
    if kind < 3:  # sums of these cancel
        return rng.choice([1, -1, 1 << 61, 1 << 62, -(1 << 62), (1 << 62) - 1])
    return max(random_value(rng, 96), -LARGEST)


def random_rate(rng: random.Random) -> int:
    near = [EXPONENT_OFFSET + d for d in (-1, 0, 1)] + [LARGEST_EXPONENT + d for d in (-1, 0, 1)]
    exponent = rng.choice([0, 255, 127, *near, *(rng.randint(*near[:: len(near) - 1]) for _ in range(6))])
    fraction = rng.choice([0, 0x7FFFFF, 0x400000, rng.getrandbits(23)])
    return rng.choice([0, SIGN]) | exponent << 23 | fraction


def by_rows(rng: random.Random) -> list[Term]:
    """Rows one after the other, the columns in any order."""
    terms = []
    for row in rng.sample(range(ROWS), rng.randint(1, ROWS)):
        columns = rng.sample(range(ROWS), ROWS)
        terms += [Term(row, c, c == columns[0], c == columns[-1]) for c in columns]
    return terms


def by_columns(rng: random.Random) -> list[Term]:
    """Rows in turn."""
    rows = rng.sample(range(ROWS), rng.randint(1, ROWS))
    columns = rng.sample(range(ROWS), rng.randint(1, ROWS))
    return [Term(row, c, c == columns[0], c == columns[-1]) for c in columns for row in rows]


def anyhow(rng: random.Random) -> list[Term]:
    """Any row, any column; sums shown on the way, ended or not."""
    return [
        Term(rng.randrange(ROWS), rng.randrange(ROWS), rng.random() < 0.2, rng.random() < 0.4)
        for _ in range(rng.randint(1, 40))
    ]


def random_terms(rng: random.Random, count: int) -> Iterator[Term]:
    for _ in range(count // 20):
        yield from rng.choice([by_rows, by_columns, anyhow])(rng)


def test_random_terms(simulator: str, tmp_path: Path) -> None:
    """Moments and rates change in any clock: at random, in the clock before their use, and in that of it."""
    rng = random.Random(205)
    play = Play()
    gaps, writes = 0.0, 0.0
    terms = random_terms(rng, COUNTS[simulator])
    for number, term in enumerate(terms):
        if number % 50 == 0:
            gaps, writes = rng.choice([0.0, 0.1, 0.6]), rng.choice([0.0, 0.3, 1.0])
        if number % 10 == 0:
            play.right = rng.choice(RIGHTS)

        def change(own: float, used: Term = term, share: float = writes) -> tuple[Moment | None, Load | None]:
            """Something to write; with chance `own` it is what the term uses."""
            pair = min(used.row, used.column), max(used.row, used.column)
            if rng.random() >= own:
                pair = rng.choice(PAIRS)
            place = used.column if used.column < SIZE and rng.random() < own else rng.randrange(SIZE)
            moment = (*pair, random_moment(rng)) if rng.random() < share else None
            return moment, (place, random_rate(rng)) if rng.random() < share else None

        while rng.random() < gaps:
            moment, load = change(0.5)
            play.clock(clear=rng.random() < 0.02, moment=moment, load=load)
        if term.row not in play.open_rows:  # nothing there, or dropped by a clear
            term = Term(term.row, term.column, True, term.last)
        moment, load = change(0.2)
        play.clock(clear=rng.random() < 0.004, moment=moment, load=load, term=term)
    assert len(play.residuals) > COUNTS[simulator] // 10
    play.check(simulator, tmp_path)


def test_written_in_the_clock_before(simulator: str, tmp_path: Path) -> None:
    """Each term's moment, then its rate, a clock ahead and in the very clock, which is too late."""
    rng = random.Random(206)
    play = Play()
    for (row, column), late in product(product(range(ROWS), repeat=2), (False, True)):
        moment = min(row, column), max(row, column), rng.randint(-LARGEST, LARGEST)
        load = (column, rng.choice([0, SIGN]) | 127 << 23 | rng.getrandbits(23)) if column < SIZE else None
        term = Term(row, column, True, True)
        if late:
            play.clock(term=term, moment=moment, load=load)
            play.clock(term=term)
        else:
            play.clock(moment=moment)
            play.clock(term=term, load=load)
            play.clock(term=term)
    play.check(simulator, tmp_path)


def test_clear_drops_what_is_on_its_way(simulator: str, tmp_path: Path) -> None:
    """A clear 0 to 12 clocks after a row's last term; the row begins anew right behind it."""
    rng = random.Random(207)
    play = Play()
    for pair in PAIRS:
        play.clock(moment=(*pair, rng.randint(-LARGEST, LARGEST)))
    for place in range(SIZE):
        play.clock(load=(place, 127 << 23 | rng.getrandbits(23)))
    for distance, full in product(range(13), (False, True)):
        play.clock(load=(0, (LARGEST_EXPONENT + 1) << 23))
        play.clock(load=(0, 127 << 23))
        play.row(3)
        for _ in range(distance):
            play.clock(term=Term(5, 1, True, True) if full else None)
        play.clock(clear=True, term=Term(5, 2, True, True) if full else None)
        play.row(3)
        play.row(5)
        for _ in range(12):
            play.clock()
    # a rate too large in the clock of a clear is forgotten
    play.clock(clear=True, load=(1, (LARGEST_EXPONENT + 1) << 23))
    play.check(simulator, tmp_path)


def test_corners(simulator: str, tmp_path: Path) -> None:
    """Accumulators at both ends, every place of the right-hand side, every exponent of a rate."""
    play = Play()
    # the largest sums: all seven terms of one sign
    for moment, rate_sign in product((LARGEST, -LARGEST), (0, SIGN)):
        for pair in PAIRS:
            play.clock(moment=(*pair, -moment if pair[1] == SIZE and rate_sign == 0 else moment))
        for place in range(SIZE):
            play.clock(load=(place, rate_sign | LARGEST_RATE))
        for play.right in (30, -32):
            for row in range(ROWS):
                play.row(row)
    # the right-hand side alone
    for sign in (1, -1):
        for row in range(ROWS):
            play.clock(moment=(row, SIZE, sign * LARGEST if row % 2 else sign * 3))
        for play.right in RIGHTS:
            for row in range(ROWS):
                play.clock(term=Term(row, SIZE, True, True))
    # a carry, and a borrow, through everything: 2^k - 1 and 1, then back
    play.right = -32
    for place in range(2):
        play.clock(load=(place, SIGN | EXPONENT_OFFSET << 23))
    for moment, other in ((LARGEST, 1), (-LARGEST, -1), (-1, 1), (1, -1), (1, -2), (0, -1), (-1, 0)):
        play.clock(moment=(0, 0, moment))
        play.clock(moment=(0, 1, other))
        for exponent in (EXPONENT_OFFSET, EXPONENT_OFFSET + 38, EXPONENT_OFFSET + 39, LARGEST_EXPONENT):
            for place in range(2):
                play.clock(load=(place, SIGN | exponent << 23))
            for columns in ((0, 1), (1, 0), (1, 1, 0), (0, 1, 1)):
                for column in columns:
                    play.clock(term=Term(0, column, column == columns[0], True))
    # exponents, of either sign: too small is zero, too large is zero and says so
    play.clock(moment=(0, 0, -LARGEST))
    for exponent, fraction, sign in product(range(256), (0, 0x7FFFFF), (0, SIGN)):
        play.clock(clear=exponent % 16 == 0, load=(0, sign | exponent << 23 | fraction))
        play.clock(term=Term(0, 0, True, True))
    limit = (1 << SUM - 1) - 1
    assert max(abs(value) for _, value in play.residuals.values()) < limit
    play.check(simulator, tmp_path)


def test_overflow_begins_at_the_largest_rate() -> None:
    """The flag's threshold is 2^26, that of zero 2^-33."""
    unit = ResidualUnit(dict.fromkeys(PAIRS, 1), scale_of(0))
    for value, overflow in ((2.0**26, True), (-(2.0**26), True), (2.0**26 - 4, False), (np.inf, True)):
        unit.overflow = False
        unit.load(0, np.float32(value))
        assert unit.overflow == overflow
    for rate, kept in ((2.0**-33, True), (np.nextafter(np.float32(2.0**-33), np.float32(0)), False)):
        unit.load(0, np.float32(rate))
        unit.add(Term(0, 0, True, True))
        assert (unit.sums[0] != 0) == kept
