# SPDX-License-Identifier: Apache-2.0
"""rates_engine against its model, frame after frame without a reset: every word, in its cycle."""

from __future__ import annotations

import random
from pathlib import Path

import numpy as np
from relnav.model.rates_engine import EngineResult, RatesEngine
from relnav.model.rates_program import Mark, Operation
from relnav.model.rates_schedule import schedule

from tb.common.replay import run
from tb.common.vectors import pack
from tb.ivisnav.normal_equations import Rows, quantised, random_rows

FRAME = 480  # clocks given to a frame
WRITE = 3  # operation to write


def beats(rows: Rows, variance: int, *, reset: bool, length: int = FRAME) -> list[int]:
    """Stimulus of one frame: an idle clock, its items, and time to solve."""
    sums = rows.sums()
    items = list(sums.items())
    words = []
    for clock in range(length):
        valid = 1 <= clock <= len(items)
        row, column, moment = items[clock - 1] if valid else (0, 0, 0)
        fields = [
            (int(reset and clock == 0), 1),
            (int(valid), 1),
            (row, 3),
            (column, 3),
            (int(clock == len(items)), 1),
            (moment, 96),
            (sums.h_bits, 6),
            (sums.y_bits, 6),
            (sums.weight_bits, 6),
            (sums.used_count, 16),
            (rows.frac_h, 8),
            (rows.frac_y, 8),
            (variance, 32),
        ]
        words.append(pack(fields))
    return words


def engine(rows: Rows, variance: int) -> EngineResult:
    """The model's run."""
    sums = rows.sums()
    return RatesEngine(sums.moments, rows.scale(variance), sums.used_count, variance).run()


def expected(result: EngineResult, start: int) -> list[tuple[int, list[int]]]:
    """(clock, [write, index, data, marks, condition]) of everything the engine says; `start`: first item."""
    placed = schedule()
    said = []
    for step, cycle in zip(placed.steps, placed.cycles, strict=True):
        if isinstance(step, Operation) and step.output is not None:
            late = step.mark == Mark.ALL or step.output >= 6
            if late and result.ill_conditioned:
                continue
            marks = {Mark.NONE: 0, Mark.RATES: 0b1000, Mark.ALL: 0b0100}[step.mark]
            condition = result.condition if step.mark == Mark.RATES else 0
            if step.mark == Mark.RATES and result.ill_conditioned:
                marks = 0b0001
            said.append((start + cycle + WRITE, [1, step.output, result.words[step.output], 0, 0]))
            if marks:
                said.append((start + cycle + WRITE + 1, [0, 0, 0, marks, condition]))
    return sorted(said)


def check(frames: list[tuple[Rows, int]], simulator: str, folder: Path) -> list[EngineResult]:
    stimulus: list[int] = []
    wanted: list[tuple[int, list[int]]] = []
    results = []
    refused = []
    for rows, variance in frames:
        start = len(stimulus) + 1
        result = engine(rows, variance)
        results.append(result)
        stimulus += beats(rows, variance, reset=False)
        if result.rank_deficient:
            refused.append((start, start + FRAME))
        else:
            wanted += expected(result, start)
    top = Path(__file__).parent / "rates_engine_replay.v"
    found = run(top, ["ivisnav", "arith", "gram"], simulator, folder, stimulus, 187, [1, 6, 32, 4, 32], {})
    for first, last in refused:  # says so once, and nothing else
        said = [fields for clock, fields in found if first <= clock < last]
        assert said == [[0, 0, 0, 0b0010, 0]]
    assert [f for f in found if not any(a <= f[0] < b for a, b in refused)] == wanted
    return results


def word(value: float) -> int:
    return int(np.float32(value).view(np.uint32))


def test_random_frames(simulator: str, tmp_path: Path) -> None:
    rng = random.Random(7)
    frames = []
    count = 150 if simulator == "verilator" else 25
    for number in range(count):
        condition = 10.0 ** rng.uniform(0, 3.6 if number % 4 == 0 else 2.7)
        variance = 0 if rng.random() < 0.5 else word(10.0 ** rng.uniform(-12, 3))
        frames.append((random_rows(rng, condition, rng.choice([6, 7, 8, 20]), 1e-4), variance))
    results = check(frames, simulator, tmp_path)
    good = [r for r in results if not (r.ill_conditioned or r.rank_deficient)]
    assert len(good) > len(results) // 2 and len(good) < len(results)


def test_corners(simulator: str, tmp_path: Path) -> None:
    rng = random.Random(8)
    six = np.eye(6)
    full = np.full((6, 6), float(-(1 << 31))) + np.diag([2.0**32 - 1] * 6)
    y = np.array([1.0, -1.0, 0.0, 2.0, 0.5, -0.25])
    deficient = np.vstack((six[:5], six[:5]))
    frames = [
        (quantised(six, y), 0),  # exact
        (quantised(six, np.zeros(6)), word(1.0)),  # no rates
        (quantised(deficient, np.arange(10.0)), 0),  # rank 5
        (random_rows(rng, 10.0, 6), 0),  # a good one after it
        (Rows(full.astype(np.int64), np.full(6, (1 << 31) - 1), np.full(6, 65535), -64, 95), word(3e38)),
        (Rows(full.astype(np.int64), np.full(6, -(1 << 31)), np.full(6, 65535), 95, -64), word(1e-38)),
        (Rows(six.astype(np.int64), np.arange(6), np.ones(6, np.int64), 0, 0), 0),  # smallest integers
        (Rows(np.zeros((6, 6), np.int64), np.arange(6), np.ones(6, np.int64), 0, 0), 0),
        (Rows(six.astype(np.int64), np.full(6, -1), np.ones(6, np.int64), 3, 4), word(2.0)),
        (quantised(np.vstack((six, six)) * 3, np.ones(12), np.array([65535, 1] * 6)), 0),
        (quantised(np.vstack((six, 0 * six)), np.ones(12), np.array([0] * 6 + [65535] * 6)), 0),
        (random_rows(rng, 1e9, 8), 0),
        (random_rows(rng, 2500.0, 8), 0),
        (random_rows(rng, 5.0, 8), 0),
    ]
    check(frames, simulator, tmp_path)


def test_reset_in_the_middle(simulator: str, tmp_path: Path) -> None:
    """A frame cut at any cycle leaves nothing behind."""
    rng = random.Random(9)
    stimulus: list[int] = []
    wanted = []
    for cut in (1, 3, 20, 29, 60, 150, 200, 290, 295, 297, 323, 324, 325, 326, 380):
        broken = beats(random_rows(rng, 20.0, 8), 0, reset=True, length=cut)
        stimulus += broken
        rows = random_rows(rng, 20.0, 8)
        start = len(stimulus) + 1
        wanted.append((start, expected(engine(rows, 0), start)))
        stimulus += beats(rows, 0, reset=True)
    top = Path(__file__).parent / "rates_engine_replay.v"
    found = run(top, ["ivisnav", "arith", "gram"], simulator, tmp_path, stimulus, 187, [1, 6, 32, 4, 32], {})
    for start, said in wanted:
        assert [f for f in found if start <= f[0] < start + FRAME - 1] == said
    assert all(said for _, said in wanted)  # no comparison of nothing with nothing
