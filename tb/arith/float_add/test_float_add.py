# SPDX-License-Identifier: Apache-2.0
"""float_add against numpy: all pairs of special values, random, halfway and cancelling pairs, one a clock."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from relnav.model.float32 import add, subtract

from tb.arith.floats import (
    Pairs,
    all_pairs,
    check,
    general_pairs,
    halfway_sums,
    join,
    play_pairs,
    special_words,
)

LATENCY = 4
COUNTS = {"icarus": 15_000, "verilator": 1_040_000}  # of either kind


def single_bits() -> Pairs:
    """Each bit alone below each distance: what decides a tie, of either sign."""
    large = np.array([0x3F800000, 0x3F800001, 0x3FFFFFFF], np.uint32)
    distance, bit, sign = np.meshgrid(np.arange(32), np.arange(24), np.arange(2), indexing="ij")
    fraction = (1 << bit) & 0x7FFFFF  # bit 23: none
    small = (sign << 31 | (127 - distance) << 23 | fraction).astype(np.uint32).ravel()
    return np.tile(large, len(small)), np.repeat(small, len(large))


def test_float_add_is_ieee(simulator: str, tmp_path: Path) -> None:
    """Sums and differences in turn; every pair of special values both ways."""
    rng = np.random.default_rng(72)
    count = COUNTS[simulator]
    special = all_pairs(special_words())
    x, y = join(special, special, general_pairs(rng, count), halfway_sums(rng, count), single_bits())
    control = (rng.random(len(x)) < 0.98) + 2 * rng.integers(0, 2, len(x), dtype=np.uint8)
    control[: 2 * len(special[0])] = np.repeat(np.array([1, 3], np.uint8), len(special[0]))
    top = Path(__file__).parent / "float_add_replay.v"
    flushed, gradual = play_pairs(top, simulator, tmp_path, (x, y), control.astype(np.uint8), LATENCY)
    valid = control & 1 == 1
    x, y, minus = x[valid], y[valid], control[valid] > 1
    for name, operation, which in (("sum", add, ~minus), ("difference", subtract, minus)):
        check(f"{name}, DENORMALS = 0", flushed[which], x[which], y[which], operation, True)
        check(f"{name}, DENORMALS = 1", gradual[which], x[which], y[which], operation, False)
