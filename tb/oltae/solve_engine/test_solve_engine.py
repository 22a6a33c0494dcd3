# SPDX-License-Identifier: Apache-2.0
"""solve_engine against its model: random clouds, angles, noise, shapes; every written word and its cycle order."""

from __future__ import annotations

import random
from pathlib import Path

import pytest

from relnav.model import pose_program as pose
from relnav.model.lane import LaneValue
from relnav.model.rom import scheduled
from relnav.model.solver import Solver
from tb.common.vectors import pack
from tb.gram.replay import run
from tb.oltae.moments import Moments, items, random_cloud

PERIOD = 170  # cycles from one frame's first item to the next one's
WIDTHS = [6, 32, 1, 1, 1, 1, 2, 1, 1, 1]


def packed(value: LaneValue) -> int:
    """A lane value as the hardware's 48-bit word."""
    mantissa, exponent = value
    return int(mantissa == 0) << 47 | (exponent % (1 << 12)) << 35 | mantissa % (1 << 35)


@pytest.mark.parametrize("frames", [60])
def test_solve_engine_matches_the_model(frames: int, simulator: str, tmp_path: Path) -> None:
    rng = random.Random(frames)
    program = scheduled()
    stimulus: list[int] = []
    expected = []
    for _ in range(frames):
        forbid = rng.random() < 0.2
        cloud: Moments = random_cloud(rng)
        solver = Solver(forbid_turns=forbid)
        words = []
        for number, (address, value) in enumerate(items(cloud)):
            solver.load(address, value)
            words.append(pack([(int(forbid), 1), (1, 1), (int(number == 0), 1), (address, 5), (packed(value), 48)]))
        solver.run(program)
        expected.append(solver)
        stimulus += words + [int(forbid) << 55] * (PERIOD - len(words))
    top = Path(__file__).parent / "solve_engine_replay.v"
    rows = run(top, simulator, tmp_path, stimulus, 56, WIDTHS, {})
    for number, solver in enumerate(expected):
        words = solver.words()
        got: dict[int, int] = {}
        for cycle, (index, data, _q, _pose, _all, chosen, turn, rank, ill, saturated) in rows:
            if cycle // PERIOD != number:
                continue
            if chosen:
                assert (turn, rank, ill) == (solver.turn, solver.rank_deficient, solver.ill_conditioned), number
            else:
                got[index] = data
                last_saturated = saturated
        assert got == words, number
        assert last_saturated == solver.saturated, number
    assert pose.P == 12
