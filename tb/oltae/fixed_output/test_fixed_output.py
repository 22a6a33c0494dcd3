# SPDX-License-Identifier: Apache-2.0
"""fixed_output against the lane model: half up, saturation at both ends, terms above the accumulator."""

from __future__ import annotations

import random
from pathlib import Path

from relnav.model.lane import DotLane
from relnav.words import LANE_ACC

from tb.common.replay import run
from tb.common.vectors import corners, pack, random_value

LATENCY = 1
HALF_BELOW = -(1 << 32) - 1  # half a bit below the least number: rounds up to it


def fixed(total: int, above: bool) -> list[int]:
    """[saturated, word]."""
    if above:
        return [1, 1 << 31 if total < 0 else (1 << 31) - 1]
    lane = DotLane()
    lane.acc = total
    word = lane.fixed() % (1 << 32)
    return [int(lane.saturated), word]


def play(simulator: str, folder: Path, sums: list[tuple[int, bool]]) -> None:
    """Compare every word and its cycle."""
    stimulus = [pack([(1, 1), (above, 1), (total, LANE_ACC)]) for total, above in sums]
    expected = [(cycle + LATENCY, fixed(*case)) for cycle, case in enumerate(sums)]
    top = Path(__file__).parent / "fixed_output_replay.v"
    assert run(top, ["oltae"], simulator, folder, stimulus, 2 + LANE_ACC, [1, 32], {}) == expected


def test_fixed_output_matches_the_model(simulator: str, tmp_path: Path) -> None:
    rng = random.Random(62)
    ends = [end + d for end in (-(1 << 32), 1 << 32) for d in range(-5, 6)]
    values = [*corners(LANE_ACC), *range(-9, 10), *ends, *(random_value(rng, LANE_ACC) for _ in range(4000))]
    play(simulator, tmp_path, [(v, above) for v in values if v != HALF_BELOW for above in (False, True)])


def test_half_below_the_least_number(simulator: str, tmp_path: Path) -> None:
    play(simulator, tmp_path, [(HALF_BELOW, False)])


def test_model_rounds_half_up() -> None:
    assert [fixed(total, False)[1] for total in (0, 1, 2, 3)] == [0, 1, 1, 2]
    assert [fixed(total, False)[1] for total in (-1, -2, -3)] == [0, 2**32 - 1, 2**32 - 1]
    assert fixed((1 << 32) - 2, False) == [0, 0x7FFFFFFF]
    assert fixed((1 << 32) - 1, False) == [1, 0x7FFFFFFF]
    assert fixed(-(1 << 32), False) == [0, 0x80000000]
    assert fixed(-(1 << 32) - 2, False) == [1, 0x80000000]
