# SPDX-License-Identifier: Apache-2.0
"""rates_lane against its header's cycles: an operation a clock, operands of all memories, all they hold."""

from __future__ import annotations

import random
from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
from relnav.model.float32 import add, multiply, subtract
from relnav.model.rates_program import Bank
from relnav.model.rates_schedule import ADDEND, FACTOR, PRODUCT, SUM

from tb.common.replay import run
from tb.common.vectors import pack

ONE = 0x3F800000
DEPTH = {Bank.S: 32, Bank.A: 8, Bank.P: 8}
WRITE_PRODUCT, WRITE_SUM = PRODUCT - 1, SUM - 1  # clocks; what is written can be read in the next
SPECIAL = (0, 1 << 31, ONE, 0xBF800000, 0x7F800000, 0xFF800000, 0x7FC00000, 1, 0x00800000, 0x7F7FFFFF)
COUNTS = {"icarus": 6_000, "verilator": 20_000}


def calculated(operation: str, x: int, y: int) -> int:
    """A word of two words."""
    function = {"*": multiply, "+": add, "-": subtract}[operation]
    operands = np.array([[x], [y]], np.uint32).view(np.float32)
    return int(function(operands[0], operands[1]).view(np.uint32)[0])


@dataclass(frozen=True)
class Step:
    """One operation: own is read at once, x and y a clock later, c, product and sum act later still."""

    x: tuple[Bank, int] = (Bank.NONE, 0)
    own: tuple[Bank, int] = (Bank.S, 0)
    y: int | None = 0
    """A word, or None for the lane's own."""
    c: tuple[Bank, int] = (Bank.NONE, 0)
    subtract: bool = False
    product: int | None = None
    dest: int | None = None
    moment: tuple[int, int] | None = None
    """Address and word, written meanwhile."""


@dataclass
class Lane:
    """What the memories hold, clock by clock."""

    memory: dict[Bank, list[int | None]] = field(
        default_factory=lambda: {bank: [None] * depth for bank, depth in DEPTH.items()}
    )
    owns: list[int | None] = field(default_factory=list)
    """Of each operation, by clock."""
    operands: dict[int, tuple[int, int]] = field(default_factory=dict)
    addends: dict[int, int] = field(default_factory=dict)
    sums: dict[int, int] = field(default_factory=dict)

    def read(self, place: tuple[Bank, int], none: int) -> int:
        """A word that must have been written."""
        if place[0] == Bank.NONE:
            return none
        word = self.memory[place[0]][place[1]]
        assert word is not None
        return word

    def clock(self, steps: Sequence[Step], now: int) -> int | None:
        """Reads and writes of clock `now`; the word on the bus, if it has one."""
        step = steps[now]
        self.owns.append(self.memory[step.own[0]][step.own[1]])
        shown = None
        if now >= FACTOR:
            earlier = steps[now - FACTOR]
            shown = self.owns[now - FACTOR]
            y = shown if earlier.y is None else earlier.y
            assert y is not None
            self.operands[now - FACTOR] = self.read(earlier.x, ONE), y
        writes: list[tuple[Bank, int, int]] = []
        if now >= ADDEND:
            self.addends[now - ADDEND] = self.read(steps[now - ADDEND].c, 0)
        if (number := now - WRITE_PRODUCT) >= 0:
            earlier = steps[number]
            product = calculated("*", *self.operands[number])
            self.sums[number] = calculated("-" if earlier.subtract else "+", self.addends[number], product)
            if earlier.product is not None:
                writes.append((Bank.P, earlier.product, product))
        if now >= WRITE_SUM:
            earlier = steps[now - WRITE_SUM]
            if earlier.dest is not None:
                writes.append((Bank.S, earlier.dest, self.sums[now - WRITE_SUM]))
        if step.moment is not None:
            writes.append((Bank.A, *step.moment))
        for bank, address, word in writes:
            self.memory[bank][address] = word
        return shown


def words(steps: Sequence[Step], looks: Sequence[bool]) -> list[int]:
    """The stimulus: each field in its clock. What is not written has an address all the same, any."""
    rng = random.Random(215)

    def given(address: int | None, bank: Bank) -> int:
        return rng.randrange(DEPTH[bank]) if address is None else address

    stimulus = []
    for now, (step, look) in enumerate(zip(steps, looks, strict=True)):
        factor = steps[now - FACTOR] if now >= FACTOR else Step()
        addend = steps[now - ADDEND] if now >= ADDEND else Step()
        product = steps[now - WRITE_PRODUCT] if now >= WRITE_PRODUCT else Step()
        last = steps[now - WRITE_SUM] if now >= WRITE_SUM else Step()
        address, moment = step.moment or (given(None, Bank.A), rng.getrandbits(32))
        fields = [(int(look), 1), (int(step.moment is not None), 1), (address, 3), (moment, 32)]
        fields += [(int(step.own[0] == Bank.A), 1), (step.own[1], 5), (factor.x[0], 2), (factor.x[1], 5)]
        fields += [(int(factor.y is None), 1), (factor.y or 0, 32)]
        fields += [(int(product.product is not None), 1), (given(product.product, Bank.P), 3)]
        fields += [(addend.c[0], 2), (addend.c[1], 5), (int(product.subtract), 1)]
        fields += [(int(last.dest is not None), 1), (given(last.dest, Bank.S), 5)]
        stimulus.append(pack(fields))
    return stimulus


def random_word(rng: random.Random) -> int:
    """A number near 1, so that sums cancel and round; now and then any, or a special one."""
    kind = rng.random()
    if kind < 0.03:
        return rng.choice(SPECIAL)
    if kind < 0.06:
        return rng.getrandbits(32)
    fraction = rng.getrandbits(23) >> rng.choice([0, 0, 18]) << rng.choice([0, 0, 18]) & 0x7FFFFF
    return rng.getrandbits(1) << 31 | rng.randint(121, 132) << 23 | fraction


def filled(rng: random.Random) -> list[Step]:
    """Every place of every memory gets a word."""
    steps = [Step(y=random_word(rng), dest=k, product=k % 8) for k in range(DEPTH[Bank.S])]
    steps += [Step(moment=(k, random_word(rng))) for k in range(DEPTH[Bank.A])]
    return steps + [Step()] * SUM


def random_steps(rng: random.Random, count: int) -> list[Step]:
    """Few addresses for a while, so that what was just written is soon read, or read as it is written."""
    steps: list[Step] = []
    few = 1
    for number in range(count):
        if number % 100 == 0:
            few = rng.choice([1, 2, 4, 32])

        def place(*banks: Bank, among: int = few) -> tuple[Bank, int]:
            bank = rng.choice(banks)
            return bank, rng.randrange(min(among, DEPTH[bank])) if bank != Bank.NONE else 0

        fresh = rng.random() < 0.3
        x = (Bank.NONE, 0) if fresh else place(Bank.NONE, Bank.S, Bank.A, Bank.P, Bank.P)
        c = (Bank.NONE, 0) if fresh else place(Bank.NONE, Bank.S, Bank.S, Bank.A)
        dest = place(Bank.S)[1] if rng.random() < 0.7 else None
        steps.append(
            Step(
                x=x,
                own=place(Bank.S, Bank.A),
                y=None if rng.random() < 0.4 and not fresh else random_word(rng),
                c=c,
                subtract=rng.random() < 0.5,
                product=place(Bank.P)[1] if rng.random() < 0.5 else None,
                dest=dest,
                moment=(place(Bank.A)[1], random_word(rng)) if rng.random() < 0.1 else None,
            )
        )
    return steps


def everything() -> list[Step]:
    """All memories onto the bus at last; the products by way of the sums. Nothing may be on its way."""
    steps = [Step(own=(Bank.S, k)) for k in range(32)] + [Step(own=(Bank.A, k)) for k in range(8)]
    steps += [Step(x=(Bank.P, k), y=ONE, dest=k) for k in range(8)] + [Step()] * SUM
    steps += [Step(x=(bank, k), y=ONE, dest=k) for bank in (Bank.S, Bank.A) for k in range(8)]
    return steps + [Step()] * SUM + [Step(own=(Bank.S, k)) for k in range(8)] + [Step()] * FACTOR


def check(steps: list[Step], simulator: str, folder: Path) -> Lane:
    lane = Lane()
    expected: list[tuple[int, list[int]]] = []
    looks = []
    for now in range(len(steps)):
        shown = lane.clock(steps, now)
        looks.append(shown is not None)
        if shown is not None:
            expected.append((now, [shown]))
    top = Path(__file__).parent / "rates_lane_replay.v"
    folders = ["ivisnav", "arith"]
    got = run(top, folders, simulator, folder, words(steps, looks), 133, [32], {})
    assert len(got) == len(expected)
    for mine, theirs in zip(got, expected, strict=True):
        assert mine == theirs
    return lane


def test_random_operations(simulator: str, tmp_path: Path) -> None:
    rng = random.Random(212)
    steps = [*filled(rng), *random_steps(rng, COUNTS[simulator]), *everything()]
    lane = check(steps, simulator, tmp_path)
    finite = [word >> 23 & 0xFF not in (0, 255) for word in lane.sums.values()]
    assert sum(finite) > len(finite) // 2  # NaNs and zeros have not taken over


def test_documented_cycles(simulator: str, tmp_path: Path) -> None:
    """Products, sums and moments read back at every distance from their making, by every port."""
    rng = random.Random(213)
    steps = filled(rng)
    for distance in range(SUM + 3):
        # the sum, by all three of its ports
        for x, own, c in (
            (Bank.S, Bank.A, Bank.NONE),
            (Bank.NONE, Bank.S, Bank.NONE),
            (Bank.NONE, Bank.A, Bank.S),
        ):
            steps.append(Step(x=(Bank.A, 1), y=random_word(rng), dest=3, product=3))
            steps += [Step()] * distance
            steps.append(Step(x=(x, 3), own=(own, 3), y=None, c=(c, 3), dest=4))
            steps += [Step()] * SUM
            steps.append(Step(own=(Bank.S, 4)))
        # the product
        steps.append(Step(x=(Bank.A, 2), y=random_word(rng), product=5))
        steps += [Step()] * distance
        steps += [Step(x=(Bank.P, 5), y=ONE, c=(Bank.A, 1), subtract=True, dest=6), *[Step()] * SUM]
        steps.append(Step(own=(Bank.S, 6)))
        # a moment written around the clock in which it is x, own, or c
        for after in range(ADDEND + 3):
            moments = [
                Step(moment=(7, random_word(rng))) if k == after else Step() for k in range(ADDEND + 3)
            ]
            reader = Step(
                x=(Bank.A, 7), own=(Bank.A, 7), y=None, c=(Bank.A, 7), dest=8, moment=moments[1].moment
            )
            steps += [moments[0], reader, *moments[2:], *[Step()] * SUM, Step(own=(Bank.S, 8))]
    check([*steps, *everything()], simulator, tmp_path)


def test_specials(simulator: str, tmp_path: Path) -> None:
    """Every two special values as x y and as c +- 1 y."""
    steps = filled(random.Random(214))
    for number, (x, y) in enumerate((x, y) for x in SPECIAL for y in SPECIAL):
        steps.append(Step(moment=(number % 8, x)))
        steps.append(Step(x=(Bank.A, number % 8), y=y, dest=number % 16))
        for minus in (False, True):
            steps.append(Step(y=y, c=(Bank.A, number % 8), subtract=minus, dest=16 + 8 * minus + number % 8))
        if number % 8 == 7:
            steps += [Step()] * SUM
            steps += [Step(own=(Bank.S, k)) for k in range(32)]
    check([*steps, *[Step()] * SUM, *everything()], simulator, tmp_path)
