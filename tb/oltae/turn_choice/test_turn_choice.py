# SPDX-License-Identifier: Apache-2.0
"""turn_choice against its definition: ties, forbidden turns, negative determinants, both thresholds."""

from __future__ import annotations

import random
from pathlib import Path

from relnav.words import ILL_BITS, LANE_ACC, RANK_BITS

from tb.common.replay import run
from tb.common.vectors import corners, pack, random_value

LATENCY = 2
NOISE = 1 << RANK_BITS


def choice(determinants: list[int], forbid: bool) -> list[int]:
    """[turn, rank deficient, ill conditioned]."""
    compared = [d >> RANK_BITS for d in determinants]
    turn = 0 if forbid else compared.index(max(compared))
    best = compared[turn]
    return [turn, int(best < 1), int(1 <= best < 1 << (ILL_BITS - RANK_BITS))]


def determinants(rng: random.Random) -> list[int]:
    """Four random ones, corners, near one another, tied but for their noise, or near a threshold."""
    kind = rng.randrange(5)
    if kind == 0:
        return [random_value(rng, LANE_ACC) for _ in range(4)]
    if kind == 1:
        return [rng.choice(corners(LANE_ACC)) for _ in range(4)]
    if kind == 2:
        threshold = 1 << rng.choice([RANK_BITS, ILL_BITS])
        return [threshold + rng.choice([-NOISE, -1, 0, 1, NOISE]) for _ in range(4)]
    base = random_value(rng, LANE_ACC - 1) >> RANK_BITS << RANK_BITS
    unequal = kind - 3
    return [base + NOISE * rng.randint(-unequal, unequal) + rng.randrange(NOISE) for _ in range(4)]


def test_turn_choice(simulator: str, tmp_path: Path) -> None:
    rng = random.Random(61)
    stimulus: list[int] = []
    made: dict[int, list[int]] = {}  # cycle -> choice

    def cycle(valid: int, forbid: bool, dets: list[int]) -> None:
        stimulus.append(pack([(valid, 1), (forbid, 1), *((d, LANE_ACC) for d in dets)]))

    for _ in range(1500):  # `forbid` is constant from a frame's determinants to its choice
        forbid = rng.random() < 0.3
        for _ in range(rng.choice([1, 1, 2, 5])):
            dets = determinants(rng)
            made[len(stimulus) + LATENCY] = choice(dets, forbid)
            cycle(1, forbid, dets)
        for _ in range(rng.choice([1, 1, 4])):
            cycle(0, forbid, determinants(rng))
    top = Path(__file__).parent / "turn_choice_replay.v"
    rows = run(top, ["oltae"], simulator, tmp_path, stimulus, 2 + 4 * LANE_ACC, [1, 2, 1, 1], {})
    assert [cycle for cycle, _ in rows][: len(stimulus) - 2] == list(range(2, len(stimulus)))
    held: list[int] = []
    for number, (chosen, *fields) in rows:
        assert chosen == (number in made), number
        held = made.get(number, held)
        assert fields == held, number
