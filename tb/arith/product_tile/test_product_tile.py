# SPDX-License-Identifier: Apache-2.0
"""product_tile against Python's integers: every pair of corners, random operands, one a cycle."""

from __future__ import annotations

import random
from itertools import product
from pathlib import Path

from tb.common.replay import run
from tb.common.vectors import corners, pack, random_value

LATENCY = 3
# each limb at its ends: 18 bits signed above, 17 unsigned below
LIMBS = [
    high << 17 | low for high, low in product((-1 << 17, -1, 0, 1, (1 << 17) - 1), (0, 1, (1 << 17) - 1))
]


def test_product_tile_is_exact(simulator: str, tmp_path: Path) -> None:
    rng = random.Random(41)
    pairs = list(product(LIMBS, LIMBS))
    edge = corners(35)
    pairs += [(rng.choice(edge), rng.choice(edge)) for _ in range(4000)]
    pairs += [(random_value(rng, 35), rng.getrandbits(35) - (1 << 34)) for _ in range(6000)]
    stimulus, expected = [], []
    for x, y in pairs:
        while rng.random() < 0.2:
            stimulus.append(rng.getrandbits(70))
        expected.append((len(stimulus) + LATENCY, [x * y % (1 << 70)]))
        stimulus.append(pack([(1, 1), (x, 35), (y, 35)]))
    top = Path(__file__).parent / "product_tile_replay.v"
    assert run(top, ["arith"], simulator, tmp_path, stimulus, 71, [70], {}) == expected
