# SPDX-License-Identifier: Apache-2.0
"""normaliser against its model, and the model against exact fractions."""

from __future__ import annotations

import random
from fractions import Fraction
from pathlib import Path

import pytest
from relnav.model.normaliser import Normaliser
from relnav.words import FULL, LEAN, MANT, Build

from tb.common.replay import run
from tb.common.vectors import corners, pack, random_value

TAG = 8
LATENCY = 3
SCALES = (-1700, 1700)  # no exponent leaves its 12 bits


def values(bits: int, rng: random.Random) -> list[int]:
    """Corners, random values of every length, values with long runs of equal bits (low limbs of 0)."""
    runs = []
    for _ in range(4000):
        value = 0
        while value.bit_length() < bits - 1 and rng.random() < 0.97:
            length = rng.randrange(1, 60)
            value = (value << length) | (((1 << length) - 1) if rng.random() < 0.5 else 0)
        value &= (1 << (bits - 1)) - 1
        runs.append(value if rng.random() < 0.5 else -value - 1)
    return [*corners(bits), *runs, *(random_value(rng, bits) for _ in range(6000))]


@pytest.mark.parametrize("words", [LEAN, FULL], ids=["lean", "full"])
def test_normaliser_matches_the_model(words: Build, simulator: str, tmp_path: Path) -> None:
    rng = random.Random(31)
    bits = words.CENTRED
    in_widths = [1, 1, TAG, 12, bits]
    model = Normaliser()
    stimulus, expected = [], []
    for value in values(bits, rng):
        for low in (0, 1):
            if rng.random() < 0.1:
                stimulus.append(rng.getrandbits(sum(in_widths) - 1))
            tag, scale = rng.getrandbits(TAG), rng.choice([0, rng.randint(*SCALES)])
            mantissa, exponent = model.run(value, bool(low), scale)
            fields = [tag, int(mantissa == 0), mantissa % (1 << 35), exponent % (1 << 12)]
            expected.append((len(stimulus) + LATENCY, fields))
            stimulus.append(pack(zip([1, low, tag, scale, value], in_widths, strict=True)))
    top = Path(__file__).parent / "normaliser_replay.v"
    parameters = {"BITS": bits, "TAG": TAG}
    got = run(top, ["gram"], simulator, tmp_path, stimulus, sum(in_widths), [TAG, 1, 35, 12], parameters)
    assert len(got) == len(expected)
    for mine, theirs in zip(got, expected, strict=True):
        assert mine == theirs


@pytest.mark.parametrize("words", [LEAN, FULL], ids=["lean", "full"])
def test_model_rounds_down_and_normalises(words: Build) -> None:
    model = Normaliser()
    for value in values(words.CENTRED, random.Random(32)):
        mantissa, exponent = model.run(value, scale=5)
        if value == 0:
            assert (mantissa, exponent) == (0, 0)
            continue
        assert -(1 << (MANT - 1)) <= mantissa < 1 << (MANT - 1)
        assert (mantissa >> (MANT - 1)) & 1 != (mantissa >> (MANT - 2)) & 1
        unit = Fraction(2) ** exponent
        assert mantissa * unit <= 32 * value < (mantissa + 1) * unit
        low, low_exponent = model.run(value, low=True, scale=5)
        assert 0 <= low < 1 << 34
        assert low == 0 or low_exponent == exponent - 34
        rest = 32 * value - mantissa * unit - low * unit / 2**34
        assert 0 <= rest < unit / 2**34


def test_model_refuses_an_exponent_that_does_not_fit() -> None:
    with pytest.raises(OverflowError, match="12 bits"):
        Normaliser().run(1, scale=2047 + 34)
