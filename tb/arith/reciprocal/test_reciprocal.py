# SPDX-License-Identifier: Apache-2.0
"""reciprocal against its model, and the model against exact fractions."""

from __future__ import annotations

import random
from fractions import Fraction
from pathlib import Path

from relnav.model.lane import LaneValue
from relnav.model.reciprocal import HUGE, reciprocal
from relnav.words import RECIPROCAL_NUMERATOR

from tb.arith import normalised_mantissas, random_mantissa, word
from tb.common.replay import run
from tb.common.vectors import pack

LATENCY = (RECIPROCAL_NUMERATOR - 31) // 3 + 1  # a clock a digit, three bits each, and the result


def operands(rng: random.Random, count: int) -> list[LaneValue]:
    """Corners, zero, divisors at the digits' thresholds, random values."""
    mantissas = [0, *normalised_mantissas()]
    # 2^34 / m near a choice between two digits in any place; the smallest divisors leave the least room
    for place in (8**n for n in range(10)):
        for _ in range(count // 10):
            first = place if rng.random() < 0.5 else max(place, 2 * place - 9)
            quotient = (rng.randrange(first, 2 * place) + rng.uniform(0.35, 0.65)) / place
            mantissas += [sign * round((1 << 34) / quotient) for sign in (-1, 1)]
    mantissas = [m for m in mantissas if m in (0, -1 << 34) or 1 << 33 <= (m if m >= 0 else ~m) < 1 << 34]
    mantissas += [random_mantissa(rng) for _ in range(count)]
    return [(m, rng.choice([0, rng.randint(-1900, 1900)]) if m else 0) for m in mantissas]


def test_reciprocal_matches_the_model(simulator: str, tmp_path: Path) -> None:
    """With and without pauses, anew at the cycle of the last result, and while busy."""
    rng = random.Random(45)
    stimulus: list[int] = []
    expected = []

    def wait(cycles: int) -> None:
        stimulus.extend(rng.getrandbits(48) for _ in range(cycles))

    for value in operands(rng, 4000):
        if rng.random() < 0.1:  # interrupted
            other = (random_mantissa(rng), 0)
            stimulus.append(pack([(1, 1), (word(other), 48)]))
            wait(rng.randrange(0, LATENCY - 1))
        start = len(stimulus)
        stimulus.append(pack([(1, 1), (word(value) if value[0] else 1 << 47 | rng.getrandbits(47), 48)]))
        wait(LATENCY - 1 + (rng.randrange(0, 5) if rng.random() < 0.3 else 0))
        mantissa, exponent = reciprocal(value)
        expected.append((start + LATENCY, [word((mantissa, exponent))]))
    top = Path(__file__).parent / "reciprocal_replay.v"
    got = run(top, ["arith"], simulator, tmp_path, stimulus, 49, [48], {})
    assert len(got) == len(expected)
    for mine, theirs in zip(got, expected, strict=True):
        assert mine == theirs


def test_model_truncates_towards_zero() -> None:
    for value in operands(random.Random(46), 3000):
        if value[0] == 0:
            assert reciprocal(value) == HUGE
            continue
        mantissa, exponent = reciprocal(value)
        exact = 1 / (value[0] * Fraction(2) ** value[1])
        unit = Fraction(2) ** (-value[1] - RECIPROCAL_NUMERATOR)
        found = mantissa * Fraction(2) ** exponent
        assert (found > 0) == (exact > 0)
        assert 0 <= abs(exact) - abs(found) < unit
        assert 1 << 32 <= abs(mantissa) <= 1 << 33  # one bit below normalised
