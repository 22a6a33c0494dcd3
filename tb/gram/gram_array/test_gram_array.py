# SPDX-License-Identifier: Apache-2.0
"""gram_array against its model and against the definition, every bit of every pair, with its latency."""

from __future__ import annotations

import random
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import pytest
from relnav import words
from relnav.model.gram import DRAIN_ORDER, GramArray, exact_moments, pair_components

from sim.runner import build_and_test, sources
from tb.common.vectors import corners, random_value, to_signed

HERE = Path(__file__).resolve().parent
LOW, HIGH = -(1 << 31), (1 << 31) - 1

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
    redrains: int = 0
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
    for run in range(frame.redrains + 1):
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
    assert not pairs
    return lines


def play(simulator: str, tmp_path: Path, weighted_build: bool, frames: Sequence[Frame]) -> None:
    (tmp_path / "stimulus.txt").write_text(stimulus(frames))
    build_and_test(
        "gram_array_player",
        [*sources("gram"), HERE / "gram_array_player.v"],
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
    frames = [Frame(random_points(rng, 1000)), Frame(random_points(rng, 1000, 3), redrains=1)]
    if weighted_build:
        frames.insert(1, Frame(random_points(rng, 1000, 0, True), True, clear_ahead=0))
        frames.append(Frame(random_points(rng, 1000, 4, True), True))
    play(simulator, tmp_path, weighted_build, frames)


@BUILDS
@pytest.mark.parametrize("n", [3, 4, 65535])
def test_extremes(simulator: str, tmp_path: Path, weighted_build: bool, n: int) -> None:
    if n > 1000 and simulator == "icarus":
        pytest.skip("long runs are Verilator's")
    frames = []
    for a, b in EXTREMES:
        frames.append(Frame([Points(a, b, 1, n)]))
        if weighted_build:
            weights = (65535,) if n > 1000 else (0, 1, 32767, 32768, 65535)
            frames += [Frame([Points(a, b, w, n)], True) for w in weights]
    play(simulator, tmp_path, weighted_build, frames)


def test_word_header_is_current() -> None:
    assert words.HEADER.read_text() == words.verilog(), "run `python -m relnav.words`"
