# SPDX-License-Identifier: Apache-2.0
"""integer_to_float against exact integers: four widths, all lengths, ties, both ends of binary32."""

from __future__ import annotations

import random
from itertools import product
from pathlib import Path

import numpy as np
from relnav.model.float32 import from_integer, word_from_integer

from tb.common.replay import run
from tb.common.vectors import corners, pack, to_signed

LATENCY = 4
BITS = (64, 83, 98, 144)
COUNTS = {"icarus": 6_000, "verilator": 40_000}


def random_magnitude(rng: random.Random) -> int:
    """24 bits kept, a rest that is a tie, beside one or any, of any length up to 144 bits."""
    length = rng.randrange(1, 145)
    if rng.random() < 0.3 or length < 26:
        return rng.getrandbits(length) | 1 << (length - 1)
    kept = rng.getrandbits(24) | 1 << 23 if rng.random() < 0.7 else (1 << 24) - 1 - rng.randrange(3)
    rest = length - 24
    low = rng.choice([0, 1, 1 << (rest - 1), (1 << (rest - 1)) + 1, (1 << (rest - 1)) - 1, (1 << rest) - 1])
    if rng.random() < 0.3:
        low ^= 1 << rng.randrange(rest)
    return kept << rest | low


def random_scale(rng: random.Random, value: int) -> int:
    """Any, or one that brings the value to an end of binary32's range."""
    kind = rng.randrange(5)
    if kind == 0:
        return rng.randrange(-2048, 2048)
    if kind == 1:
        return rng.randrange(-200, 100)
    top = -abs(value).bit_length()
    return top + (rng.randrange(126, 131) if kind == 2 else rng.randrange(-152, -122))


def test_integer_to_float_rounds_once(simulator: str, tmp_path: Path) -> None:
    rng = random.Random(75)
    edges = [value for bits in BITS for value in corners(bits)]
    values = [(value, rng.choice([0, -40, random_scale(rng, value)])) for value in edges]
    values += list(product((0, 1, -1, -2), (-2048, -149, -150, -126, 127, 128, 2047)))
    for _ in range(COUNTS[simulator]):
        value = random_magnitude(rng) * rng.choice([1, -1])
        if rng.random() < 0.5:
            # the other widths must see short values as they are, and long ones cut
            value >>= max(0, value.bit_length() - rng.choice(BITS) + 1)
        values.append((value, random_scale(rng, value)))
    stimulus, expected = [], []
    for value, scale in values:
        value = to_signed(value, 144)
        while rng.random() < 0.05:
            stimulus.append(rng.getrandbits(156))
        cut = [to_signed(value, bits) for bits in BITS]
        fields = [word_from_integer(low, scale, flush) for low in cut for flush in (True, False)]
        expected.append((len(stimulus) + LATENCY, fields))
        stimulus.append(pack([(1, 1), (scale, 12), (value, 144)]))
    top = Path(__file__).parent / "integer_to_float_replay.v"
    got = run(top, ["arith", "gram"], simulator, tmp_path, stimulus, 157, [32] * 8, {})
    assert len(got) == len(expected)
    for mine, theirs, operand in zip(got, expected, values, strict=True):
        assert mine == theirs, operand


def test_model_agrees_with_numpy() -> None:
    """Integers below 2^53 and scales at which double is exact: double to single is the one rounding."""
    rng = random.Random(76)
    for _ in range(20_000):
        value = random_magnitude(rng) % (1 << 53) * rng.choice([1, -1])
        scale = rng.choice([rng.randrange(-220, 100), rng.randrange(-152, -122) - abs(value).bit_length()])
        with np.errstate(all="ignore"):
            single = np.float32(np.ldexp(np.float64(value), scale))
        gradual = from_integer(value, scale, flush=False)
        assert gradual.view(np.uint32) == single.view(np.uint32), (value, scale)
        normal = not np.isfinite(single) or abs(single) >= np.finfo(np.float32).tiny
        flushed = from_integer(value, scale)
        assert np.signbit(flushed) == np.signbit(single)
        assert flushed == (single if normal else 0)
