# SPDX-License-Identifier: Apache-2.0
"""sum_normaliser against the lane's `normalise`: every number of sign bits, corners, runs of equal bits."""

from __future__ import annotations

import random
from pathlib import Path

from relnav.model.lane import normalise
from relnav.words import LANE_ACC, MANT

from tb.common.replay import run
from tb.common.vectors import corners, pack, random_value

LATENCY = 1


def sums(rng: random.Random) -> list[int]:
    """Corners, random values of every length, and a sign change followed by another at every distance."""
    twice = [(1 << i) - (1 << j) for i in range(LANE_ACC) for j in range(i)]
    signed = [v if rng.random() < 0.5 else ~v for v in twice]
    return [*corners(LANE_ACC), *signed, *(random_value(rng, LANE_ACC) for _ in range(8000))]


def test_sum_normaliser_matches_the_model(simulator: str, tmp_path: Path) -> None:
    rng = random.Random(43)
    stimulus: list[int] = []
    expected = []
    for value in sums(rng):
        mantissa, exponent = normalise(value, 0)
        left = LANE_ACC - MANT - exponent if value else LANE_ACC - 1
        expected.append((len(stimulus) + LATENCY, [mantissa % (1 << MANT), left]))
        stimulus.append(pack([(1, 1), (value, LANE_ACC)]))
        while rng.random() < 0.2:
            stimulus.append(rng.getrandbits(LANE_ACC))
    top = Path(__file__).parent / "sum_normaliser_replay.v"
    assert run(top, ["arith"], simulator, tmp_path, stimulus, 49, [MANT, 6], {}) == expected


def test_model_keeps_the_leading_bits() -> None:
    for value in sums(random.Random(44)):
        mantissa, exponent = normalise(value, 0)
        if value == 0:
            assert mantissa == 0
            continue
        assert -(1 << 34) <= mantissa < 1 << 34
        assert (mantissa >> 34) & 1 != (mantissa >> 33) & 1
        assert mantissa == (value >> exponent if exponent >= 0 else value << -exponent)
