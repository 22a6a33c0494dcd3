# SPDX-License-Identifier: Apache-2.0
"""moment_check: its algebra, and the RTL against the model; sound frames never differ, faulty ones do."""

from __future__ import annotations

import random
from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path

import pytest
from relnav import words
from relnav.model.gram import DRAIN_ORDER as PAIR_ORDER
from relnav.model.gram import pair_components
from relnav.model.gram_ring import DRAIN_ORDER as ITEM_ORDER
from relnav.model.moment_check import (
    ADDRESS_A,
    ADDRESS_B,
    ADDRESS_W,
    ARRAY,
    KEY_RING_WEIGHT,
    KEY_SUM,
    RING,
    Layout,
    P,
    coefficients,
    compare,
    predicted,
)

from tb.common.replay import run
from tb.common.vectors import corners, pack, random_value, to_signed

LOW, HIGH = -(1 << 31), (1 << 31) - 1
#: the largest |s|, and components whose folded s gives a square with much in both words
HEAVY = (HIGH, LOW, -1, 0x7FFFFFFF, 0x0000FFFF, -0x10000, 0x7FFF0000)
LATENCY = 20  # value_last to checked
RESIDUE_READY = 11  # last beat to the residue

Row = tuple[int, ...]
Sums = list[tuple[int, int]]
"""(key, integer)"""


@dataclass(frozen=True)
class Core:
    """One use of the check."""

    layout: Layout
    item_bits: int
    value_bits: int
    weighted: bool = True

    @property
    def beats(self) -> int:
        return len(self.layout.factors)


CORES = {
    "array": Core(ARRAY, words.build(True).M2, words.build(True).M1),
    "lean array": Core(ARRAY, words.build(False).M2, words.build(False).M1, weighted=False),
    "ring": Core(RING, 96, 33),
}
BOTH = pytest.mark.parametrize("core", CORES.values(), ids=CORES.keys())


def sums_of(core: Core, rows: Sequence[Row], weights: Sequence[int]) -> tuple[Sums, Sums]:
    """Second moments and other sums of a frame by definition, in the order of the drain."""

    def moment(i: int, j: int, shift: int) -> int:
        return sum(w * (u[i] - shift) * (u[j] - shift) for u, w in zip(rows, weights, strict=True))

    total = sum(weights)
    if core.layout is RING:
        return [(8 * i + j, moment(i, j, 0)) for i, j in ITEM_ORDER], [(KEY_RING_WEIGHT, total)]
    items = [
        (8 * slot + lane, moment(*pair_components(slot, lane), words.SHIFT)) for slot, lane in PAIR_ORDER
    ]
    means = [sum(w * u[i] for u, w in zip(rows, weights, strict=True)) for i in range(6)]
    values = [(ADDRESS_W, total)]
    values += [(address, means[2 * k]) for k, address in enumerate(ADDRESS_A)]
    values += [(address, means[2 * k + 1]) for k, address in enumerate(ADDRESS_B)]
    return items, values


def random_rows(rng: random.Random, core: Core, n: int) -> tuple[list[Row], list[int]]:
    def component() -> int:
        return rng.choice((random_value(rng, 32), rng.choice(corners(32)), rng.choice(HEAVY)))

    rows = [tuple(component() for _ in range(core.layout.components)) for _ in range(n)]
    if not core.weighted:
        return rows, [1] * n
    return rows, [rng.choice((0, 1, 65535, 32768, rng.getrandbits(16))) for _ in range(n)]


# ---------------------------------------------------------------------------------------- the algebra


@pytest.mark.parametrize("layout", [ARRAY, RING], ids=["array", "ring"])
def test_coefficients_see_every_bit_and_tell_sums_apart(layout: Layout) -> None:
    found = coefficients(layout)
    assert len(found) == (28 if layout is ARRAY else 29) + 2
    assert all(
        0 < c < 1 << 16 for c in found.values()
    )  # +-2^n times it is never 0; and the table has 16 bits
    kept = [c for key, c in found.items() if key != KEY_SUM]
    assert len(set(kept)) == len(kept)
    if layout is ARRAY:
        # a wrong sum of weights changes the value W and, through W 2^15, the six means
        means = sum(found[address] for address in (*ADDRESS_A, *ADDRESS_B))
        assert (found[ADDRESS_W] + (means << 15)) % P != 0


def test_a_flipped_bit_of_a_karatsuba_sum_is_seen() -> None:
    # high 2^32 + (both - high - low) 2^16 + low
    for change in ((1 << 32) - (1 << 16), 1 << 16, 1 - (1 << 16)):
        assert all((change << bit) % P for bit in range(48))
        assert change % 0xFFFF == (0 if change != 1 << 16 else 1)  # why the modulus is not 2^16 - 1


@BOTH
def test_the_sums_of_any_frame_agree_with_its_beats(core: Core) -> None:
    rng = random.Random(1)
    for n in (1, 2, 3, 7, 30) * 6:
        rows, weights = random_rows(rng, core, n)
        items, values = sums_of(core, rows, weights)
        table = coefficients(core.layout)
        drained = sum(table[key] * item for key, item in items)
        drained -= sum(table[key] * value for key, value in values)
        residue = predicted(core.layout, rows, weights)
        assert (drained - residue) % P == 0
        result = compare(core.layout, residue, items, values, core.value_bits)
        assert (result.sums[0] - drained + residue) % P == 0 == (result.sums[1] + result.sums[0]) % P
        assert not result.mismatch


@BOTH
def test_every_flipped_bit_of_every_sum_is_a_mismatch(core: Core) -> None:
    rng = random.Random(2)
    rows, weights = random_rows(rng, core, 9)
    items, values = sums_of(core, rows, weights)
    residue = predicted(core.layout, rows, weights)
    for sums, bits in ((items, core.item_bits), (values, core.value_bits)):
        for place, (key, value) in enumerate(sums):
            for bit in range(bits):
                wrong = [*sums]
                wrong[place] = (key, to_signed((value ^ 1 << bit) & (1 << bits) - 1, bits))
                both = (wrong, values) if sums is items else (items, wrong)
                assert compare(core.layout, residue, *both, core.value_bits).mismatch, (key, bit)


# ---------------------------------------------------------------------------------------------- the RTL


@dataclass
class Frame:
    """Beats of a frame, and drains."""

    rows: list[Row]
    weights: list[int]
    gap: int = 0
    """Up to so many idle clocks before a beat."""
    repeat: int = 1
    """Times that the rows come, one after the other."""
    drains: list[tuple[Sums, Sums]] = field(default_factory=list)
    mismatches: list[bool] = field(default_factory=list)
    with_clear: bool = False
    """The first beat comes with clear."""
    given_up: int = 0
    """Beats before the clear, and as many clocks before it (1..) as `cut` says."""
    cut: int = 1


Event = tuple[int, list[int]]


def play(core: Core, simulator: str, folder: Path, frames: Sequence[Frame]) -> None:
    """Every sum that is fed back, residue and verdict as the model says; verdicts as the frames say."""
    rng = random.Random(3)
    widths = [1, 1, 64, 2, 16, 1, 6, core.item_bits, 1, 6, 1, core.value_bits]
    names = ["clear", "beat", "data", "index", "weight", "item_valid", "item_key", "item"]
    names += ["value_valid", "value_key", "value_last", "value"]
    stimulus: list[int] = []
    last_beat = 0

    def clock(**given: int) -> None:
        # what is not valid is noise
        fields = {n: rng.getrandbits(b) for n, b in zip(names, widths, strict=True)}
        fields |= {"clear": 0, "beat": 0, "item_valid": 0, "value_valid": 0} | given
        stimulus.append(pack(zip((fields[n] for n in names), widths, strict=True)))

    def beat(row: Row, weight: int, index: int, **given: int) -> None:
        halves = [*row, rng.getrandbits(32)]  # with what is above y
        data = (halves[2 * index + 1] & 0xFFFFFFFF) << 32 | halves[2 * index] & 0xFFFFFFFF
        extra = {"weight": weight} if index == core.beats - 1 else {}
        clock(beat=1, data=data, index=index, **extra, **given)

    expected: list[Event] = []
    for frame in frames:
        if frame.given_up:
            rows, weights = random_rows(rng, core, 3)
            for k in range(frame.given_up):
                beat(rows[k // core.beats], weights[k // core.beats], k % core.beats)
            for _ in range(frame.cut - 1):
                clock()
        if not frame.with_clear:
            clock(clear=1)
        first = frame.with_clear
        plain = {(r, i): None for r in range(len(frame.rows)) for i in range(core.beats)}
        long = frame.repeat > 1
        words_held: list[int] = []
        for k in range(frame.repeat):
            if long and k > 1:
                stimulus.extend(words_held)
                continue
            start = len(stimulus)
            for r, i in plain:
                for _ in range(rng.randint(0, frame.gap)):
                    clock()
                beat(frame.rows[r], frame.weights[r], i, clear=int(first))
                first = False
            words_held = stimulus[start:]
        last_beat = len(stimulus) - 1
        residue = predicted(core.layout, frame.rows * frame.repeat, frame.weights * frame.repeat)
        for (items, values), mismatch in zip(frame.drains, frame.mismatches, strict=True):
            while len(stimulus) < last_beat + RESIDUE_READY - len(items) - len(values) + 1:
                clock()
            for key, item in items:
                for _ in range(rng.choice((0, 0, 0, 0, 1))):
                    clock()
                clock(item_valid=1, item_key=key, item=item)
            for place, (key, value) in enumerate(values):
                last = int(place == len(values) - 1)
                clock(value_valid=1, value_key=key, value=value, value_last=last)
            end = len(stimulus) - 1
            result = compare(core.layout, residue, items, values, core.value_bits)
            assert result.mismatch == mismatch
            for k, total in enumerate(result.sums):
                # clocks 7, 13, 19 after value_last
                expected.append((end + 7 + 6 * k, [0, 0, total % (1 << 40), residue]))
            expected.append((end + LATENCY, [1, int(mismatch), 0, residue]))
            for _ in range(LATENCY):
                clock()
    top = Path(__file__).parent / "moment_check_replay.v"
    parameters = {
        "RING": int(core.layout is RING),
        "ITEM_BITS": core.item_bits,
        "VALUE_BITS": core.value_bits,
    }
    got = run(top, ["gram"], simulator, folder, stimulus, sum(widths), [1, 1, 40, 50], parameters)
    for mine, theirs in zip(got, expected, strict=False):
        assert mine == theirs
    assert len(got) == len(expected)


def sound(core: Core, frame: Frame, drains: int = 1) -> Frame:
    """With what an array that works drains."""
    sums = sums_of(core, frame.rows, [w * frame.repeat for w in frame.weights])
    frame.drains = [sums] * drains
    frame.mismatches = [False] * drains
    return frame


@BOTH
def test_sound_frames_never_differ(core: Core, simulator: str, tmp_path: Path) -> None:
    rng = random.Random(4)
    frames = []
    for n in (1, 2, 3, 3, 4, 9, 40) * 6:
        frame = Frame(*random_rows(rng, core, n), rng.choice((0, 0, 1, 5)), with_clear=rng.random() < 0.3)
        frame.given_up = rng.choice((0, 0, rng.randint(1, 3 * core.beats)))
        frame.cut = rng.choice((1, 1, 2, 3, 5, 8, 11))
        frames.append(sound(core, frame, rng.choice((1, 1, 2, 3))))
    for value in (LOW, HIGH, -1, 0):
        equal = [(value,) * core.layout.components] * 4
        weights = [0, 1, 65535] if core.weighted else [1]
        frames += [sound(core, Frame(equal, [w] * 4)) for w in weights]
    play(core, simulator, tmp_path, frames)


def heaviest(core: Core) -> Row:
    """Of many rows the one with the largest t, which brings the residue's accumulator furthest."""
    rng = random.Random(5)
    rows = [tuple(rng.choice(HEAVY) for _ in range(core.layout.components)) for _ in range(3000)]
    rows += [tuple(random_value(rng, 32) for _ in range(core.layout.components)) for _ in range(3000)]
    return max(rows, key=lambda row: predicted(core.layout, [row], [1]))


@BOTH
def test_the_longest_frame(core: Core, simulator: str, tmp_path: Path) -> None:
    if simulator == "icarus":
        pytest.skip("long runs are Verilator's")
    row = heaviest(core)
    frame = Frame([row], [65535 if core.weighted else 1], repeat=65535)
    if core.weighted:
        assert predicted(core.layout, [row], [65535]) * 65535 >> 49  # the accumulator wraps, and again
    play(core, simulator, tmp_path, [sound(core, frame), sound(core, Frame([row] * 3, [1] * 3))])


@BOTH
def test_faults_are_noticed(core: Core, simulator: str, tmp_path: Path) -> None:
    rng = random.Random(6)
    frames = []

    def component() -> int:
        return random_value(rng, 32)

    def add(rows: list[Row], weights: list[int], drained: tuple[Sums, Sums]) -> None:
        frame = Frame(rows, weights, drains=[drained, sums_of(core, rows, weights)])
        frame.mismatches = [True, False]  # and the next drain of the same frame is sound
        frames.append(frame)

    for _ in range(12):
        n = rng.randint(2, 8)
        rows = [tuple(component() for _ in range(core.layout.components)) for _ in range(n)]
        weights = [rng.randint(1, 65535) if core.weighted else 1 for _ in rows]
        items, values = sums_of(core, rows, weights)
        k, bit = rng.randrange(len(items)), rng.randrange(core.item_bits)
        key, item = items[k]
        flipped = to_signed((item ^ 1 << bit) & (1 << core.item_bits) - 1, core.item_bits)
        add(rows, weights, ([*items[:k], (key, flipped), *items[k + 1 :]], values))
        add(rows, weights, ([*items[:k], *items[k + 1 :]], values))  # one lost
        add(rows, weights, ([*items[: k + 1], *items[k:]], values))  # one twice
        add(rows, weights, ([*items[: k - 1], (items[k - 1][0], item), *items[k:]], values))  # a wrong one
        key, value = values[-1]
        add(rows, weights, (items, [*values[:-1], (key, value ^ 1 << rng.randrange(core.value_bits - 1))]))
        # the array has lost, or repeated, or changed a row
        i, j = rng.sample(range(core.layout.components), 2)
        row = list(rows[0])
        row[i], row[j] = row[j], row[i]
        add(rows, weights, sums_of(core, rows[1:], weights[1:]))
        add(rows, weights, sums_of(core, [*rows, rows[0]], [*weights, weights[0]]))
        add(rows, weights, sums_of(core, [tuple(row), *rows[1:]], weights))
        add(rows, weights, sums_of(core, rows, [weights[0] ^ 1 << rng.randrange(16), *weights[1:]]))
    play(core, simulator, tmp_path, frames)
