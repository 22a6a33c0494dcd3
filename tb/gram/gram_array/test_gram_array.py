# SPDX-License-Identifier: Apache-2.0
"""gram_array against its model and against the definition, every bit of every pair, with its latency."""

from __future__ import annotations

import json
import random
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import pytest
from relnav import words
from relnav.model.gram import DRAIN_ORDER, GramArray, exact_moments, pair_components

from sim.runner import build_and_test, sources
from tb.common.flips import draw, registers
from tb.common.vectors import corners, random_value, to_signed

HERE = Path(__file__).resolve().parent
LOW, HIGH = -(1 << 31), (1 << 31) - 1
CHECKED = 27  # clocks after pair_last: 7 to the last of value_feeder's sums, 20 to its check

Vector = tuple[int, int, int]
Line = list[int | str]


@dataclass
class Points:
    """`count` equal points of weight w with up to `gap` idle clocks before a beat."""

    a: Vector
    b: Vector
    w: int = 1
    count: int = 1
    gap: int = 0


@dataclass
class Frame:
    """A frame and what goes around it."""

    points: list[Points]
    weighted: bool = False
    clear_ahead: int = 1  # clocks from clear to the first beat; 0: with it
    checks: int = 0  # drains whose check is waited for: the first, and that many less one again
    redrains: int = 0  # after those, without a check
    given_up: int = 0  # beats of a point given up before (with a clear of their own)
    abrupt: bool = False  # the clear comes in the clock after the last beat given up
    cut: int = 0  # a whole frame before this one, cut off by clear about so many clocks after its last beat
    reset: bool = False  # rst after what was given up


def words_of(points: Points) -> str:
    return " ".join(
        f"{(b & 0xFFFFFFFF) << 32 | a & 0xFFFFFFFF:x}" for a, b in zip(points.a, points.b, strict=True)
    )


def stimulus(frames: Sequence[Frame]) -> str:
    lines = []
    for frame in frames:
        mode = int(frame.weighted)
        junk = Points((HIGH, LOW, HIGH), (LOW, HIGH, LOW))
        if frame.cut:
            lines.append(f"2 0 1 {mode} 0 0 0")
            lines.append(f"6 4 {frame.cut:x} 3 {words_of(junk)}")
        if frame.given_up:
            lines.append(f"2 0 1 {mode} 0 0 0")
            lines += [f"0 1 0 1 {words_of(junk)}"] * 2
            kind = 7 if frame.abrupt else 4
            lines.append(f"{kind} {frame.given_up:x} 0 1 {words_of(junk)}")
        if frame.reset and not (frame.abrupt and frame.given_up):
            lines.append("5 0 0 0 0 0 0")
        if not (frame.abrupt and frame.given_up):
            lines.append(f"2 0 {frame.clear_ahead:x} {mode} 0 0 0")
        for k, points in enumerate(frame.points):
            kind = int(k == len(frame.points) - 1)
            lines.append(f"{kind} {points.count:x} {points.gap:x} {points.w:x} {words_of(points)}")
        waits = ["8 0 0 0 0 0 0", "9 0 0 0 0 0 0"] * frame.checks
        lines += waits[: 2 * frame.checks - 1] if waits else []
        lines += ["3 0 0 0 0 0 0"] * frame.redrains
    return "\n".join(lines) + "\n"


def latency(weighted_build: bool, weighted: bool) -> int:
    """Clocks from the last beat to the first pair, as the header of gram_array.v says."""
    return 7 if not weighted_build else 12 if weighted else 9


def expected(frame: Frame, weighted_build: bool) -> list[Line]:
    """Lines of the response to one frame, checked against the definition on the way."""
    model = GramArray(weighted_build)
    for p in frame.points:
        repeat = [p.w] * p.count if frame.weighted else None
        model.add([p.a] * p.count, [p.b] * p.count, repeat)
    second, first, weight = exact_moments(
        [p.a for p in frame.points],
        [p.b for p in frame.points],
        [(p.w if frame.weighted else 1) * p.count for p in frame.points],
    )
    assert model.first_moments == first
    assert model.weight_sum == weight
    assert model.point_count == sum(p.count for p in frame.points)
    lines: list[Line] = []
    for run in range(max(frame.checks, 1) + frame.redrains):
        start = 5 if run else latency(weighted_build, frame.weighted)
        if not run:
            lines += [["sums", weight, model.point_count], ["first", *first]]
        for k, pair in enumerate(model.drain()):
            i, j = pair_components(pair.slot, pair.lane)
            assert (pair.moment, pair.first_i, pair.first_j) == (second[i][j], first[i], first[j])
            assert (pair.slot, pair.lane) == DRAIN_ORDER[k]
            lines.append(
                [
                    "pair",
                    start + k,
                    pair.slot,
                    pair.lane,
                    int(pair.last),
                    pair.moment,
                    pair.first_i,
                    pair.first_j,
                ]
                + [weight, model.point_count, *first]
            )
        if run < frame.checks:
            lines.append(["waited", start + len(DRAIN_ORDER) - 1 + CHECKED, 0])
    return lines


def response(file: Path, weighted_build: bool) -> list[Line]:
    """The lines of a response; a drain that clear cut off is left out."""
    build = words.build(weighted_build)
    text = file.read_text().splitlines()
    assert text[-1] == "end"
    lines: list[Line] = []
    pairs: list[Line] = []

    def moments(word: str) -> list[int]:
        return [to_signed(int(word, 16) >> (build.M1 * k), build.M1) for k in range(6)]

    for line in text[:-1]:
        match line.split():
            case ["pair", clock, slot, lane, last, moment, i, j, weight, count, first]:
                pairs.append(
                    [
                        "pair",
                        int(clock),
                        int(slot),
                        int(lane),
                        int(last),
                        to_signed(int(moment, 16), build.M2),
                    ]
                    + [to_signed(int(word, 16), build.M1) for word in (i, j)]
                    + [int(weight, 16), int(count, 16), *moments(first)]
                )
                if len(pairs) == len(DRAIN_ORDER):
                    lines += pairs
                    pairs = []
            case ["sums", weight, count]:
                lines.append(["sums", int(weight, 16), int(count, 16)])
            case ["first", first]:
                lines.append(["first", *moments(first)])
            case ["clear"]:
                pairs = []
            case ["waited", clock, mismatch]:
                lines.append(["waited", int(clock), int(mismatch)])
            case ["checked", _, mismatch]:
                assert mismatch == "0"
            case _:
                raise AssertionError(f"what is {line!r}?")
    assert not pairs
    return lines


def play(simulator: str, tmp_path: Path, weighted_build: bool, frames: Sequence[Frame]) -> None:
    (tmp_path / "stimulus.txt").write_text(stimulus(frames))
    build_and_test(
        "gram_array_player",
        [*sources("gram", "trust"), HERE / "gram_array_player.v"],
        "gram_array_bench",
        simulator=simulator,
        parameters={"WEIGHTED": int(weighted_build)},
        plusargs=[f"+stimulus={tmp_path}/stimulus.txt", f"+response={tmp_path}/response.txt"],
        public=False,
    )
    want = [line for frame in frames for line in expected(frame, weighted_build)]
    got = response(tmp_path / "response.txt", weighted_build)
    for k, (g, w) in enumerate(zip(got, want, strict=False)):
        assert g == w, f"line {k}"
    assert len(got) == len(want)


def random_points(rng: random.Random, n: int, gap: int = 0, weighted: bool = False) -> list[Points]:
    def component() -> int:
        return rng.choice((random_value(rng, 32), rng.choice(corners(32))))

    def vector() -> Vector:
        return component(), component(), component()

    def weight() -> int:
        return rng.choice((0, 1, 65535, 32768, rng.getrandbits(16))) if weighted else 1

    return [Points(vector(), vector(), weight(), 1, gap) for _ in range(n)]


EXTREMES = [((LOW,) * 3, (LOW,) * 3), ((HIGH,) * 3, (HIGH,) * 3), ((LOW, HIGH, LOW), (HIGH, LOW, HIGH))]
BUILDS = pytest.mark.parametrize("weighted_build", [False, True], ids=["lean", "weighted"])


@BUILDS
def test_frames_follow_each_other_without_a_reset(
    simulator: str, tmp_path: Path, weighted_build: bool
) -> None:
    rng = random.Random(3)
    frames = []
    for n in (3, 4, 5, 1, 2, 17, 3, 100):
        for gap in (0, 1, 5):
            weighted = weighted_build and rng.random() < 0.6
            frames.append(
                Frame(
                    random_points(rng, n, gap, weighted),
                    weighted,
                    clear_ahead=rng.choice((0, 0, 1, 1, 4)),
                    checks=rng.choice((0, 0, 1, 2, 3)),
                    redrains=rng.choice((0, 0, 1, 2)),
                    given_up=rng.choice((0, 0, 1, 2, 3)),
                    cut=rng.choice((0, 0, 1, 2, 3, 4, 5, 7, 9, 12, 19)),
                    abrupt=rng.random() < 0.5,
                    reset=rng.random() < 0.2,
                )
            )
    play(simulator, tmp_path, weighted_build, frames)


@BUILDS
def test_a_thousand_points(simulator: str, tmp_path: Path, weighted_build: bool) -> None:
    rng = random.Random(5)
    frames = [Frame(random_points(rng, 1000), checks=1), Frame(random_points(rng, 1000, 3), redrains=1)]
    if weighted_build:
        frames.insert(1, Frame(random_points(rng, 1000, 0, True), True, clear_ahead=0, checks=2))
        frames.append(Frame(random_points(rng, 1000, 4, True), True, checks=1))
    play(simulator, tmp_path, weighted_build, frames)


@BUILDS
@pytest.mark.parametrize("n", [3, 4, 65535])
def test_extremes(simulator: str, tmp_path: Path, weighted_build: bool, n: int) -> None:
    if n > 1000 and simulator == "icarus":
        pytest.skip("long runs are Verilator's")
    frames = []
    for a, b in EXTREMES:
        frames.append(Frame([Points(a, b, 1, n)], checks=1))
        if weighted_build:
            weights = (65535,) if n > 1000 else (0, 1, 32767, 32768, 65535)
            frames += [Frame([Points(a, b, w, n)], True, checks=1) for w in weights]
    play(simulator, tmp_path, weighted_build, frames)


#: registers between the beats and the pairs, with their widths
REGISTERS = registers(
    """
    dut.u_first: a0 64, a1 64, a2 64, b0 64, b1 64, b2 64, a 48, b 48, valid 1
    dut.u_counter.g_weights: sum 32
    dut.g_weights.u_digits: pause 2, valid_1 1, valid_2 1, index_1 2, index_2 2, limbs_1 64, limbs_2 64
    dut.g_weights.u_digits: past_limbs_2 64, upper_a 17, digit_b_3 16, second 1, second_index 2
    dut.g_weights.u_digits.u_value_a.u_low: product 33, total 48
    dut.u_window: own_valid 1, own_address 3, held 98, next_valid 1, next_address 3, trailing 1
    dut.u_own: write 1, write_address 3, product_valid 1, product_address 3
    dut.u_next: write 1, write_address 3, product_valid 1, product_address 3
    dut.u_drain: prepare 1, busy 1, lane 3, slot 2, own_slot 2, next_slot 2, high_select 2
    dut.u_recombine: difference 48, middle 48, moment 96
    dut.u_tags: valid_1 1, pair_valid 1, slot_1 2, pair_slot 2, pair_lane 3
    """
    + "\n".join(
        f"dut.g_lane[{lane}].u_lane.{cell}: x_factor 16, y_factor 16, product 32, addend 48, sum 48"
        for lane in (0, 2, 3, 6)
        for cell in ("u_high", "u_low", "u_both")
    )
)
FLIPPED = 60  # frames with a flip, after one without (in which Icarus has unknown values still)


def test_what_a_flipped_register_changes_is_noticed(simulator: str, tmp_path: Path) -> None:
    if simulator == "verilator":
        pytest.skip("registers are flipped in Icarus")
    rng = random.Random(7)
    frames = [Frame(random_points(rng, 6, 0, True), True, checks=1) for _ in range(FLIPPED + 1)]
    # clocks after the clear: the last beat is taken in the 34th, the last pair comes 32 later
    flips = draw(rng, REGISTERS, FLIPPED, 66)
    (tmp_path / "stimulus.txt").write_text(stimulus(frames))
    build_and_test(
        "gram_array_player",
        [*sources("gram", "trust"), HERE / "gram_array_player.v"],
        "gram_array_bench",
        simulator=simulator,
        parameters={"WEIGHTED": 1},
        plusargs=[f"+stimulus={tmp_path}/stimulus.txt", f"+response={tmp_path}/response.txt"],
        env={"FLIPS": json.dumps(flips)},
        public=False,
    )
    parts = (tmp_path / "response.txt").read_text().split("clear\n")
    changed = 0
    for frame, flip, part in zip(frames[1:], flips, parts[-FLIPPED:], strict=True):
        pairs = [line for line in expected(frame, True) if line[0] == "pair"]
        want = [[*line[2:4], line[5], line[8], *line[10:]] for line in pairs]
        got: list[Line] = []
        for words_of_line in (line.split() for line in part.splitlines()):
            if words_of_line[0] == "pair":
                _, _, slot, lane, _, moment, _, _, weight, _, first = words_of_line
                means = [to_signed(int(first, 16) >> (64 * k), 64) for k in range(6)]
                got.append([int(slot), int(lane), to_signed(int(moment, 16), 96), int(weight, 16), *means])
        if got != want:
            changed += 1
            assert "waited" not in part or part.split("waited")[1].split()[1] == "1", flip
    assert changed > FLIPPED // 4


def test_word_header_is_current() -> None:
    assert words.HEADER.read_text() == words.verilog(), "run `python -m relnav.words`"
