# SPDX-License-Identifier: Apache-2.0
"""to_binary32 against its model, and the model against numpy's rounding."""

from __future__ import annotations

import random
from pathlib import Path

import numpy as np
from relnav.model.binary32 import from_binary32, to_binary32
from relnav.model.lane import LaneValue

from tb.arith import normalised_mantissas, random_mantissa, word
from tb.common.replay import run
from tb.common.vectors import pack

LATENCY = 2
SMALLEST = -126 - 33  # exponent of mantissa 2^33 that gives the smallest normal number
LARGEST = 127 - 33


def ties(rng: random.Random) -> list[int]:
    """Mantissas halfway between two binary32 numbers, odd and even, and their neighbours."""
    kept = [rng.getrandbits(23) | 1 << 23 for _ in range(1000)]
    kept += [(1 << 24) - 1, (1 << 24) - 2, 1 << 23, (1 << 23) + 1]
    found = [(k << 10) + (1 << 9) + d for k in kept for d in (-1, 0, 1)]
    return found + [-m for m in found]


def values(rng: random.Random) -> list[LaneValue]:
    """Corners and ties at every edge of the exponent, and random values over the whole of it."""
    mantissas = [0, *normalised_mantissas(), *ties(rng)]
    edges = [end + d for end in (SMALLEST, LARGEST) for d in (-2, -1, 0, 1, 2)] + [-2048, 2047, 0, -33]
    found = [(m, rng.choice(edges)) for m in mantissas for _ in range(3)]
    found += [
        (m, e) for m in (1 << 33, (1 << 34) - 1, -(1 << 34), -(1 << 33) - 1, -(1 << 34) + 511) for e in edges
    ]
    found += [(random_mantissa(rng), rng.randint(SMALLEST - 3, LARGEST + 3)) for _ in range(15000)]
    found += [(random_mantissa(rng), rng.randint(-2048, 2047)) for _ in range(3000)]
    return [(m, e if m else 0) for m, e in found]


def test_to_binary32_matches_the_model(simulator: str, tmp_path: Path) -> None:
    rng = random.Random(47)
    stimulus, expected = [], []
    for value in values(rng):
        while rng.random() < 0.1:
            stimulus.append(rng.getrandbits(48))
        expected.append((len(stimulus) + LATENCY, [to_binary32(value)]))
        # the mantissa and the exponent of a zero do not matter
        stimulus.append(pack([(1, 1), (word(value) if value[0] else 1 << 47 | rng.getrandbits(47), 48)]))
    top = Path(__file__).parent / "to_binary32_replay.v"
    got = run(top, ["arith"], simulator, tmp_path, stimulus, 49, [32], {})
    assert len(got) == len(expected)
    for mine, theirs in zip(got, expected, strict=True):
        assert mine == theirs


def test_model_rounds_as_numpy_does() -> None:
    """Everywhere but below the smallest normal number, where numpy has denormals and the hardware zero."""
    smallest = float(np.finfo(np.float32).tiny)
    for mantissa, exponent in values(random.Random(48)):
        if exponent + 34 > 1023 or exponent < -1000:
            continue  # not a double
        exact = mantissa * 2.0**exponent
        with np.errstate(over="ignore", under="ignore"):
            rounded = int(np.float32(exact).view(np.uint32))
        found = to_binary32((mantissa, exponent))
        if abs(exact) >= smallest or mantissa == 0:
            assert found == rounded
        else:
            assert found & 0x7FFFFFFF in (0, 0x00800000 if rounded & 0x7FFFFFFF == 0x00800000 else 0)
            assert found >> 31 == rounded >> 31


def test_words_come_back() -> None:
    rng = random.Random(49)
    for _ in range(3000):
        pattern = rng.getrandbits(1) << 31 | rng.randrange(1, 255) << 23 | rng.getrandbits(23)
        mantissa, exponent = from_binary32(pattern)
        assert to_binary32((mantissa << 10, exponent - 10)) == pattern
