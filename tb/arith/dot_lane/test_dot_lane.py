# SPDX-License-Identifier: Apache-2.0
"""dot_lane against its model: random slot programs over a register file that they, a bus and a stream write.

The bench keeps the register file cycle by cycle: reads one clock after a write are tested as any others.
It disables terms that would break the promises of the microprogram: no exponent above the reference, no sum
outside the accumulator. Some runs break the first promise instead, and have to report it.
"""

from __future__ import annotations

import random
from dataclasses import dataclass, field
from pathlib import Path
from typing import NamedTuple

import pytest
from relnav.model.lane import DotLane, LaneOverflow, LaneValue

from tb.arith import random_mantissa
from tb.common.replay import run
from tb.common.vectors import pack, random_value, to_signed

WIDTHS = {
    "check": 1,
    "x_address": 6,
    "x_by_lane": 1,
    "y_address": 5,
    "y_by_lane": 1,
    "alternate": 1,
    "negate": 1,
    "enable": 1,
    "first": 1,
    "reference": 14,
    "own_reference": 1,
    "probing": 1,
    "probed_reference": 1,
    "round_raw": 1,
    "half": 1,
    "clamp": 1,
    "write": 1,
    "write_address": 5,
    "write_broadcast": 1,
    "write_raw": 1,
    "broadcast": 48,
    "stream_write": 1,
    "stream_address": 5,
    "stream_value": 48,
}
# fields that mean nothing by themselves and are random where nothing uses them
IDLE = {
    *(
        "x_address",
        "x_by_lane",
        "y_address",
        "y_by_lane",
        "alternate",
        "negate",
        "reference",
        "round_raw",
        "half",
        "clamp",
    ),
    *("write_address", "write_broadcast", "write_raw", "broadcast", "stream_address", "stream_value"),
}
REFERENCE, BEGIN, RAW, FORMAT, RESULT = 2, 4, 5, 6, 7  # cycles after the slot
UNTOUCHED = -4096  # the probe of a run without a term


class Register(NamedTuple):
    """What a register holds: not every zero mantissa has the flag, and the flag overrules a mantissa."""

    zero: bool
    exponent: int
    mantissa: int

    @property
    def word(self) -> int:
        return pack([(int(self.zero), 1), (self.exponent % (1 << 12), 12), (self.mantissa, 35)])

    @property
    def value(self) -> LaneValue:
        return (self.mantissa, self.exponent) if self.mantissa and not self.zero else (0, 0)


class Outcome(NamedTuple):
    """What a run leaves in the lane; None: not to be compared."""

    overflow: bool
    sum: int | None
    result: LaneValue | None


def random_register(rng: random.Random) -> Register:
    exponent = rng.randint(-900, 900) if rng.random() < 0.05 else rng.randint(-60, 60)
    kind = rng.random()
    if kind < 0.1:
        return Register(True, exponent, rng.choice([0, random_mantissa(rng)]))
    if kind < 0.15:
        return Register(False, exponent, 0)
    if kind < 0.3:
        return Register(False, exponent, random_value(rng, 35))
    if kind < 0.45:
        return Register(False, exponent, rng.choice([1 << 33, (1 << 34) - 1, -(1 << 34), -(1 << 33) - 1, -1]))
    return Register(False, exponent, random_mantissa(rng))


class Terms:
    """The terms of a run so far, and the model's sum of them."""

    def __init__(self, wide: bool) -> None:
        self.model = DotLane(wide)
        self.reference: int | None = None
        self.bank: list[LaneValue] = []
        self.operands: list[tuple[int, int, bool]] = []

    def begin(self, reference: int | None) -> None:
        self.reference = reference
        self.model.run(self.bank, self.operands, reference)

    def add(self, x: LaneValue, y: LaneValue, negate: bool) -> bool:
        """False, and nothing added, if the microprogram must not have such a term."""
        place = len(self.bank)
        self.bank += [x, y]
        self.operands.append((place, place + 1, negate))
        try:
            self.model.run(self.bank, self.operands, self.reference)
        except LaneOverflow:
            self.operands.pop()
            return False
        return True

    def above(self, exponent: int) -> bool:
        return self.model.reference is not None and exponent > self.model.reference


@dataclass
class Bench:
    """Stimulus of one lane and what it has to answer."""

    lane: int
    wide: bool
    rng: random.Random
    cycle: int = 0
    fields: dict[int, dict[str, int]] = field(default_factory=dict)
    writes: dict[int, tuple[int, Register]] = field(default_factory=dict)
    results: list[Register] = field(default_factory=list)
    stream: list[Register] = field(default_factory=list)
    probe: int = UNTOUCHED
    expected: dict[tuple[int, str], Outcome] = field(default_factory=dict)

    def put(self, cycle: int, **values: int) -> None:
        self.fields.setdefault(cycle, {}).update(values)

    def fill(self) -> None:
        """Write every register, then end whatever run was unknown."""
        for bank in (self.results, self.stream):
            bank += [random_register(self.rng) for _ in range(32)]
        for place in range(32):
            self.put(self.cycle, write=1, write_address=place, write_broadcast=1)
            self.put(self.cycle, broadcast=self.results[place].word)
            self.put(self.cycle, stream_write=1, stream_address=place, stream_value=self.stream[place].word)
            self.cycle += 1
        self.slot(first=True, chance=0.0)
        self.pause(8)

    def tick(self) -> None:
        """Writes of this cycle, planned and random; on to the next."""
        now = self.fields.get(self.cycle, {})
        if self.cycle in self.writes:
            place, register = self.writes[self.cycle]
            self.results[place] = register
        elif self.rng.random() < 0.3 and "write" not in now:
            place, register = self.rng.randrange(32), random_register(self.rng)
            self.put(self.cycle, write=1, write_address=place, write_broadcast=1, broadcast=register.word)
            self.results[place] = register
        if self.rng.random() < 0.3:
            place, register = self.rng.randrange(32), random_register(self.rng)
            self.put(self.cycle, stream_write=1, stream_address=place, stream_value=register.word)
            self.stream[place] = register
        self.cycle += 1

    def pause(self, cycles: int) -> None:
        for _ in range(cycles):
            self.tick()

    def slot(self, first: bool, chance: float, **values: int) -> tuple[Register, Register, bool]:
        """Choose a slot's operands; returns them with `negate`. The caller enables and ticks."""
        names = {"x_address": 6, "x_by_lane": 1, "y_address": 5, "y_by_lane": 1, "alternate": 1, "negate": 1}
        chosen = {name: self.rng.getrandbits(bits) for name, bits in names.items()} | values
        self.put(self.cycle, first=int(first), enable=int(self.rng.random() < chance), **chosen)
        by_lane = self.lane if chosen["x_by_lane"] else 0
        x_place = chosen["x_address"] ^ by_lane ^ chosen["alternate"]
        y_place = chosen["y_address"] ^ (self.lane if chosen["y_by_lane"] else 0)
        x = self.stream[x_place - 32] if x_place >= 32 else self.results[x_place]
        return x, self.results[y_place], bool(chosen["negate"])

    def dot(self) -> None:
        """One run of slots, twice if it is probed; then its result goes wherever there is a way for it."""
        length = self.rng.choice([1, 1, 2, 3, 4, 8])
        kind = self.rng.choice(["given", "own", "probed", "broken"])
        places = [
            {"x_address": self.rng.getrandbits(6), "y_address": self.rng.getrandbits(5)}
            for _ in range(length)
        ]
        if kind == "probed":
            self.probing_pass(places)
            self.pause(self.rng.choice([0, 0, 1, 3]))
        terms = Terms(self.wide)
        overflow = False
        rounded = self.rng.random() < 0.2  # for a raw result; the sum itself then holds half a unit more
        self.put(self.cycle + BEGIN, round_raw=int(rounded))
        for number, place in enumerate(places):
            x, y, negate = self.slot(first=number == 0, chance=0.9, **place)
            exponent = x.exponent + y.exponent
            if number == 0:
                terms.begin(self.reference(kind, exponent))
            self.put(self.cycle + REFERENCE, own_reference=int(kind == "own"), probing=0)
            if self.fields[self.cycle]["enable"] and not x.zero and not y.zero:
                if x.mantissa and y.mantissa:
                    fits = terms.add(x.value, y.value, negate)
                else:  # an unflagged zero would set the reference, and report an exponent above it
                    fits = terms.model.reference is not None and not terms.above(exponent)
                above = not fits and kind == "broken" and terms.above(exponent)
                overflow |= above
                self.put(self.cycle, enable=int(fits or above))
            self.tick()
        self.finish(terms.model, overflow, rounded)

    def reference(self, kind: str, exponent: int) -> int | None:
        """Give a run its reference; None is its own."""
        if kind == "own":
            self.put(self.cycle + REFERENCE, probed_reference=self.rng.getrandbits(1))
            return None
        if kind == "probed":
            self.put(self.cycle + REFERENCE, probed_reference=1)
            return self.probe
        given = exponent + self.rng.choice([0, 1, self.rng.randint(0, 90), self.rng.randint(0, 200)])
        self.put(self.cycle + REFERENCE, reference=given, probed_reference=0)
        return given

    def probing_pass(self, places: list[dict[str, int]]) -> None:
        """The first pass of a probed run."""
        for number, place in enumerate(places):
            x, y, _ = self.slot(first=number == 0, chance=0.9, **place)
            self.put(self.cycle + REFERENCE, probing=1, own_reference=self.rng.getrandbits(1))
            self.put(self.cycle + REFERENCE, probed_reference=self.rng.getrandbits(1))
            live = bool(self.fields[self.cycle]["enable"]) and not x.zero and not y.zero
            if number == 0:
                self.probe = UNTOUCHED
            if live:
                self.probe = max(self.probe, x.exponent + y.exponent)
            self.tick()

    def finish(self, model: DotLane, overflow: bool, rounded: bool) -> None:
        """The run's last slot was the cycle before: format, expectations, writes."""
        last = self.cycle - 1
        half, clamp = self.rng.random() < 0.3, self.rng.random() < 0.3
        self.put(last, check=1)
        self.put(last + FORMAT, half=int(half), clamp=int(clamp))
        known = not (overflow or rounded)
        result = model.result(half, clamp) if known else None
        total = model.narrow % (1 << 48) if known and -(1 << 47) <= model.narrow < 1 << 47 else None
        self.expected[last + RAW, "sum"] = Outcome(overflow, total, None)
        self.expected[last + RESULT, "result"] = Outcome(False, None, result)
        if result is not None and self.rng.random() < 0.6:
            self.store(last + RESULT, result, raw=0)
        try:
            raw = model.raw()
        except LaneOverflow:
            return
        if rounded and not overflow and self.rng.random() < 0.6:
            self.store(last + RAW, raw, raw=1)

    def store(self, cycle: int, value: LaneValue, raw: int) -> None:
        """Write a result into the register file, unless another one has that cycle."""
        if cycle in self.writes:
            return
        if value[0] == 0 and self.rng.random() < 0.9:
            return  # zeros make zeros, and soon nothing else
        place = self.rng.randrange(32)
        self.put(cycle, write=1, write_address=place, write_broadcast=0, write_raw=raw)
        mantissa, exponent = value
        self.writes[cycle] = place, Register(mantissa == 0, to_signed(exponent, 12), mantissa)

    def stimulus(self) -> list[int]:
        """A word a cycle."""
        found = []
        for cycle in range(max(self.cycle, *self.fields) + 1):
            now = self.fields.get(cycle, {})
            values = {n: self.rng.getrandbits(b) if n in IDLE else 0 for n, b in WIDTHS.items()} | now
            found.append(pack([(values[name], bits) for name, bits in WIDTHS.items()]))
        return found


@pytest.mark.parametrize(("lane", "wide"), [(0, 1), (0, 0), (1, 0), (2, 0)])
def test_dot_lane_matches_the_model(lane: int, wide: int, simulator: str, tmp_path: Path) -> None:
    bench = Bench(lane, bool(wide), random.Random(100 + 2 * lane + wide))
    bench.fill()
    for _ in range(3000):
        bench.dot()
        if bench.rng.random() < 0.2:
            bench.pause(bench.rng.randrange(1, 10))
    bench.pause(RESULT + 1)
    top = Path(__file__).parent / "dot_lane_replay.v"
    out = [1, 1, 48, 1, 48]
    stimulus = bench.stimulus()
    parameters = {"LANE": lane, "WIDE": wide}
    rows = run(top, ["arith"], simulator, tmp_path, stimulus, sum(WIDTHS.values()), out, parameters)
    compared = 0
    for cycle, (has_sum, above, total, has_result, result) in rows:
        if has_sum:
            wanted = bench.expected.pop((cycle, "sum"))
            assert above == wanted.overflow, cycle
            if wanted.sum is not None:
                assert total == wanted.sum, cycle
        if has_result:
            wanted = bench.expected.pop((cycle, "result"))
            if wanted.result is None:
                continue
            compared += 1
            mantissa, exponent = wanted.result
            assert (result >> 47, result % (1 << 35)) == (mantissa == 0, mantissa % (1 << 35)), cycle
            # the exponent of a zero does not matter
            assert not mantissa or (result >> 35) % (1 << 12) == exponent % (1 << 12), cycle
    assert not bench.expected
    assert compared > 2000
