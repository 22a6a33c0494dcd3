# SPDX-License-Identifier: Apache-2.0
"""solve_engine against its model: random clouds, angles, noise, shapes; every word and its order."""

from __future__ import annotations

import random
from pathlib import Path

import pytest
from relnav.model.lane import LaneValue
from relnav.model.rom import DRAIN_LATENCY, scheduled
from relnav.model.solver import Solver

from tb.common.replay import run
from tb.common.vectors import pack
from tb.oltae.moments import items, random_cloud

PERIOD = 1100  # cycles from one frame's first item to the next one's
WIDTHS = [6, 32, 1, 1, 1, 1, 2, 1, 1, 1]


def packed(value: LaneValue) -> int:
    """A lane value as the hardware's 48-bit word."""
    mantissa, exponent = value
    return int(mantissa == 0) << 47 | (exponent % (1 << 12)) << 35 | mantissa % (1 << 35)


@pytest.mark.parametrize("frames", [40])
def test_solve_engine_matches_the_model(frames: int, simulator: str, tmp_path: Path) -> None:
    rng = random.Random(frames)
    program = scheduled()
    stimulus: list[int] = []
    expected = []
    for _ in range(frames):
        forbid = rng.random() < 0.2
        cloud = random_cloud(rng)
        reapply = rng.random() < 0.4
        solver = Solver(forbid_turns=forbid, reapply=reapply)
        idle = int(reapply) << 57 | int(forbid) << 56
        frame = [idle] * PERIOD
        stream = items(cloud)
        # the second drain answers `redrain` as late as the hardware ever does
        first_low = sum(not item.low for item in stream)
        for number, item in enumerate(stream):
            if item.address < 0:
                continue
            solver.hold(item.address, item.value, item.low)
            cycle = number if not item.low else program.redrain + DRAIN_LATENCY + number - first_low
            if item.low and reapply:
                cycle += program.return_cycle - program.call_cycle
            frame[cycle] = idle | pack(
                [
                    (1, 1),
                    (int(number == 0), 1),
                    (int(item.low), 1),
                    (item.address, 5),
                    (packed(item.value), 48),
                ]
            )
        solver.run(program)
        expected.append(solver)
        stimulus += frame
    top = Path(__file__).parent / "solve_engine_replay.v"
    rows = run(top, ["arith", "oltae"], simulator, tmp_path, stimulus, 58, WIDTHS, {})
    for number, solver in enumerate(expected):
        got: dict[int, int] = {}
        marks = [0, 0, 0]
        last_saturated = 0
        for cycle, (index, data, *done, chosen, turn, rank, ill, saturated) in rows:
            if cycle // PERIOD != number:
                continue
            if chosen:
                assert (turn, rank, ill) == (solver.turn, solver.rank_deficient, solver.ill_conditioned), (
                    number
                )
            else:
                got[index] = data
                marks = [mark + bit for mark, bit in zip(marks, done, strict=True)]
                last_saturated = saturated
        assert got == solver.words(), number
        assert marks == [1, 1, 1]
        assert last_saturated == solver.saturated, number
