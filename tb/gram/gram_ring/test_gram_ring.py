# SPDX-License-Identifier: Apache-2.0
"""gram_ring against its model and against the definition, every bit of every item, with its latency."""

from __future__ import annotations

import json
import random
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import pytest
from relnav.model.gram_ring import DRAIN_ORDER, exact_sums, gram_ring

from sim.runner import build_and_test, sources
from tb.common.flips import draw, registers
from tb.common.vectors import corners, random_value, to_signed

HERE = Path(__file__).resolve().parent
LOW, HIGH = -(1 << 31), (1 << 31) - 1
FIRST_ITEM = 20  # clocks after the last beat, as the header of gram_ring.v says
AGAIN = 7  # clocks from redrain to the first item
CHECKED = 21  # clocks after item_last
REDRAIN, CHECK, WAIT, RST, CLEAR, BEAT, LAST = 64, 32, 16, 8, 4, 2, 1  # the player's kinds

Row = tuple[int, ...]
"""h0 .. h5, y, w"""
Line = list[int | str]
JUNK: Row = (HIGH, LOW, HIGH, LOW, HIGH, LOW, HIGH, 65535)


@dataclass
class Frame:
    """A frame and what goes before it."""

    rows: list[Row]
    gap: int = 0  # up to so many idle clocks before a beat
    pause: int = 0  # idle clocks after the last item of the frame before
    clear_ahead: int = 1  # clocks from clear to the first beat; 0: with it
    reset: bool = False  # rst in place of clear
    cut: int | None = None
    """Another frame before this one, cut off by clear: idle clocks between its last beat and what follows."""
    given_up: int = 0
    """Beats after the first row of the frame cut off, in 1..7; 0: it was a whole frame of two rows."""
    checks: int = 0  # drains whose check is waited for: the first, and that many less one again


def beats_of(row: Row) -> list[int]:
    """The four 64-bit words of a row; what lies above the weight is noise."""
    h0, h1, h2, h3, h4, h5, y, w = (v & 0xFFFFFFFF for v in row)
    noise = (h0 ^ 0x5AA5) & 0xFFFF
    return [h1 << 32 | h0, h3 << 32 | h2, h5 << 32 | h4, noise << 48 | w << 32 | y]


def stimulus(rng: random.Random, frames: Sequence[Frame]) -> str:
    lines: list[str] = []

    def present(delay: int, kind: int, index: int = 0, data: int = 0) -> None:
        lines.append(f"{delay:x} {kind:x} {index} {data:x}\n")

    wait = 0
    for frame in frames:
        delay = frame.pause
        if frame.cut is not None:
            beats = [word for row in (JUNK, JUNK, JUNK) for word in beats_of(row)]
            for k, word in enumerate(beats[: 4 + (frame.given_up or 4)]):
                last = LAST if k == 7 and not frame.given_up else 0
                present(0 if k else delay, BEAT | last | (0 if k else CLEAR | wait), k % 4, word)
            delay, wait = frame.cut, 0
        first = BEAT
        if frame.reset or frame.clear_ahead:
            present(delay, (RST if frame.reset else CLEAR) | wait)
            delay = max(frame.clear_ahead - 1, 0)
        else:
            first |= CLEAR | wait
        for k, row in enumerate(frame.rows):
            for index, word in enumerate(beats_of(row)):
                last = LAST if k == len(frame.rows) - 1 and index == 3 else 0
                start = k == index == 0
                gap = rng.randint(0, frame.gap) if frame.gap else 0
                present(delay if start else gap, (first if start else BEAT) | last, index, word)
        for k in range(frame.checks):
            if k:
                present(rng.choice((0, 0, 1, 7)), REDRAIN)
            present(0, CHECK)
        wait = 0 if frame.checks else WAIT
    if wait:
        present(0, WAIT)
    return "".join(lines)


def expected(frame: Frame) -> list[Line]:
    """Lines of the response to one frame, checked against the definition on the way."""
    h, y, w = [row[:6] for row in frame.rows], [row[6] for row in frame.rows], [row[7] for row in frame.rows]
    sums = gram_ring(h, y, w)
    if len(frame.rows) <= 1000:
        assert sums.moments == exact_sums(h, y, w)
        assert sums.weight_sum == sum(w)
        assert sums.used_count == sum(k > 0 for k in w)
    counts = [sums.weight_sum, sums.row_count, sums.used_count]
    bits = [sums.h_bits, sums.y_bits, sums.weight_bits]
    lines: list[Line] = [] if frame.gap else [["last", 8 * (len(frame.rows) - 1) + 3]]
    for drain in range(max(frame.checks, 1)):
        start = AGAIN if drain else FIRST_ITEM
        held: list[Line] = [["sums", *counts], ["bits", *bits]]
        lines += held
        for k, (row, column, moment) in enumerate(sums.items()):
            assert (row, column) == DRAIN_ORDER[k]
            last = int(k == len(DRAIN_ORDER) - 1)
            lines.append(["item", start + k, row, column, last, moment, *counts, *bits])
        if frame.checks:
            lines.append(["waited", start + len(DRAIN_ORDER) - 1 + CHECKED, 0])
    return lines


def response(file: Path) -> list[list[Line]]:
    """The lines of each frame that was not cut off."""
    text = file.read_text().splitlines()
    assert text[-1] == "end"
    frames: list[list[Line]] = [[]]
    for line in text[:-1]:
        match line.split():
            case ["item", clock, row, column, last, moment, weight, rows, used, h, y, w]:
                where: Line = [int(clock), int(row), int(column), int(last), to_signed(int(moment, 16), 96)]
                counts = [int(word, 16) for word in (weight, rows, used)]
                frames[-1].append(["item", *where, *counts, int(h), int(y), int(w)])
            case ["sums", *counts_read]:
                frames[-1].append(["sums", *(int(word, 16) for word in counts_read)])
            case ["bits" | "last" as kind, *numbers]:
                frames[-1].append([kind, *map(int, numbers)])
            case ["clear"]:
                frames.append([])
            case ["waited", clock, mismatch]:
                frames[-1].append(["waited", int(clock), int(mismatch)])
            case ["checked", _, mismatch]:
                assert mismatch == "0"
            case _:
                raise AssertionError(f"what is {line!r}?")
    return [lines for lines in frames if sum(line[0] == "item" for line in lines) >= len(DRAIN_ORDER)]


def play(simulator: str, tmp_path: Path, frames: Sequence[Frame]) -> None:
    (tmp_path / "stimulus.txt").write_text(stimulus(random.Random(1), frames))
    build_and_test(
        "gram_ring_player",
        [*sources("gram", "trust"), HERE / "gram_ring_player.v"],
        "gram_ring_bench",
        simulator=simulator,
        plusargs=[f"+stimulus={tmp_path}/stimulus.txt", f"+response={tmp_path}/response.txt"],
        public=False,
    )
    got = response(tmp_path / "response.txt")
    for k, (frame, lines) in enumerate(zip(frames, got, strict=False)):
        lines = [line for line in lines if line[0] != "last" or not frame.gap]
        want = expected(frame)
        for g, w in zip(lines, want, strict=False):
            assert g == w, f"frame {k}: {frame}"
        assert len(lines) == len(want), f"frame {k}"
    assert len(got) == len(frames)


#: limbs at their ends: the low one -2^15, 2^15 - 1, -1, 0, with and without a carry into 2^15
EDGES = [
    to_signed(upper << 16 | lower, 32)
    for upper in (0, 1, 0x7FFE, 0x7FFF, 0x8000, 0x8001, 0xFFFF)
    for lower in (0, 1, 0x7FFF, 0x8000, 0x8001, 0xFFFF)
]
WEIGHTS = (0, 1, 2, 32767, 32768, 32769, 65534, 65535)


def random_rows(rng: random.Random, n: int) -> list[Row]:
    def component() -> int:
        return rng.choice((random_value(rng, 32), rng.choice(corners(32)), rng.choice(EDGES)))

    def weight() -> int:
        return rng.choice((rng.choice(WEIGHTS), rng.getrandbits(16)))

    return [(*(component() for _ in range(7)), weight()) for _ in range(n)]


def test_frames_follow_each_other_without_a_reset(simulator: str, tmp_path: Path) -> None:
    rng = random.Random(3)
    frames = [
        Frame(
            random_rows(rng, n),
            gap,
            pause=rng.choice((0, 0, 0, 1, 3)),
            clear_ahead=rng.choice((0, 0, 1, 1, 2, 5)),
            reset=rng.random() < 0.1,
            checks=rng.choice((0, 1, 2, 3)),
        )
        for n in (6, 7, 50, 1, 2, 6, 6)
        for gap in (0, 0, 1, 2, 9)
    ]
    play(simulator, tmp_path, frames)


def test_clear_at_any_time(simulator: str, tmp_path: Path) -> None:
    rng = random.Random(4)
    frames = [
        Frame(random_rows(rng, rng.choice((1, 2, 3))), cut=cut, clear_ahead=ahead)
        for cut in range(46)  # item_last comes 47 clocks after the last beat
        for ahead in (0, rng.randint(1, 9))
    ]
    frames += [
        Frame(random_rows(rng, 2), cut=cut, given_up=beats, clear_ahead=rng.choice((0, 0, 1)), reset=reset)
        for beats in range(1, 8)
        for cut in range(12)
        for reset in (False, cut % 3 == 0)
    ]
    play(simulator, tmp_path, frames)


def test_corner_operands(simulator: str, tmp_path: Path) -> None:
    rng = random.Random(5)
    frames = [
        Frame([(*(rng.choice(EDGES) for _ in range(7)), w)], checks=1) for w in WEIGHTS for _ in range(12)
    ]
    frames += [Frame([(value,) * 7 + (w,)] * 2, checks=1) for w in (1, 32768, 65535) for value in EDGES]
    frames.append(Frame([(LOW, HIGH, -1, 0, 1, LOW, HIGH, 0)] * 3))  # no weight at all
    frames.append(Frame([(0, -1, 0, -1, 0, -1, LOW, 1)]))  # h_bits 0
    frames.append(Frame([(HIGH, 0, 0, 0, 0, 0, -1, 1)]))  # y_bits 0
    frames += [Frame([(1 << k, 0, -1 << k, 0, 0, 0, -1 << (31 - k), 1 << (k & 15))]) for k in range(31)]
    play(simulator, tmp_path, frames)


def test_two_thousand_rows(simulator: str, tmp_path: Path) -> None:
    rng = random.Random(6)
    play(
        simulator,
        tmp_path,
        [Frame(random_rows(rng, 1500), checks=2), Frame(random_rows(rng, 500), 3, checks=1)],
    )


@pytest.mark.parametrize(
    "row",
    [
        (LOW,) * 7 + (65535,),
        (HIGH,) * 7 + (65535,),
        (LOW, HIGH) * 3 + (LOW, 65535),
        (0x7FFF8000, -0x7FFF8000, 0x7FFF7FFF, -0x80000000, 0x00008000, -0x8000, 0x7FFF8000, 65535),
    ],
    ids=["low", "high", "mixed", "limbs"],
)
def test_the_longest_frame(simulator: str, tmp_path: Path, row: Row) -> None:
    if simulator == "icarus":
        pytest.skip("long runs are Verilator's")
    play(simulator, tmp_path, [Frame([row] * 65535, checks=2)])


#: registers between the beats and the items, with their widths
REGISTERS = registers(
    """
    dut.u_beats: active 1, step 3, shown 64, weight 16
    dut.u_value_a.u_low: product 33, total 48
    dut.u_counter.g_weights: sum 32
    dut.u_operands: a_1 34, b_3 34, ring 238
    dut: valid_1 1, valid_2 1, second_1 1, second_2 1, index_1 2, index_2 2
    dut: slot_valid 1, slot 2, slot_set 1, slot_fresh 1, first_row 1, top_read 48
    dut.u_control: write 1, write_address 3, product_address 3
    dut.u_drain: looking 1, item 5, fetching 1, fetch_lane 3, fetch_slot 2, turns 7, turn_slot 2
    dut.u_drain: read_lane 2, reading 1, row 3, column 3
    dut.u_recombine: difference 48, middle 48, moment 96
    dut: item_1 1, item_valid 1, place_1 6, item_row 3, item_column 3
    """
    + "\n".join(
        f"dut.g_lane[{lane}].u_lane.{cell}: x_factor 16, y_factor 16, product 32, addend 48, sum 48"
        for lane in (0, 3, 5, 6)
        for cell in ("u_high", "u_low", "u_both")
    )
)
FLIPPED = 60  # frames with a flip, after one without (in which Icarus has unknown values still)


def test_what_a_flipped_register_changes_is_noticed(simulator: str, tmp_path: Path) -> None:
    if simulator == "verilator":
        pytest.skip("registers are flipped in Icarus")
    rng = random.Random(7)
    frames = [Frame(random_rows(rng, 5), checks=1) for _ in range(FLIPPED + 1)]
    # clocks after the clear: the last beat is taken in the 36th, the last item comes 47 later
    flips = draw(rng, REGISTERS, FLIPPED, 82)
    (tmp_path / "stimulus.txt").write_text(stimulus(rng, frames))
    build_and_test(
        "gram_ring_player",
        [*sources("gram", "trust"), HERE / "gram_ring_player.v"],
        "gram_ring_bench",
        simulator=simulator,
        plusargs=[f"+stimulus={tmp_path}/stimulus.txt", f"+response={tmp_path}/response.txt"],
        env={"FLIPS": json.dumps(flips)},
        public=False,
    )
    parts = (tmp_path / "response.txt").read_text().split("clear\n")
    changed = 0
    for frame, flip, part in zip(frames[1:], flips, parts[-FLIPPED:], strict=True):
        want = [line[2:4] + line[5:7] for line in expected(frame) if line[0] == "item"]
        got: list[Line] = []
        for words in (line.split() for line in part.splitlines()):
            if words[0] == "item":
                _, _, row, column, _, moment, weight, *_ = words
                got.append([int(row), int(column), to_signed(int(moment, 16), 96), int(weight, 16)])
        if got != want:
            changed += 1
            assert "waited" not in part or part.split("waited")[1].split()[1] == "1", flip
    assert changed > FLIPPED // 4
