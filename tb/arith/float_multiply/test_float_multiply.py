# SPDX-License-Identifier: Apache-2.0
"""float_multiply against numpy: special values, random, halfway and end-of-range pairs, one a clock."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from relnav.model.float32 import multiply

from tb.arith.floats import all_pairs, check, general_pairs, halfway_products, join, play_pairs, special_words

LATENCY = 3
COUNTS = {"icarus": 30_000, "verilator": 1_040_000}


def test_float_multiply_is_ieee(simulator: str, tmp_path: Path) -> None:
    rng = np.random.default_rng(71)
    half = COUNTS[simulator] // 2
    x, y = join(all_pairs(special_words()), general_pairs(rng, half), halfway_products(rng, half))
    control = (rng.random(len(x)) < 0.98).astype(np.uint8)
    control[: len(special_words()) ** 2] = 1
    top = Path(__file__).parent / "float_multiply_replay.v"
    flushed, gradual = play_pairs(top, simulator, tmp_path, (x, y), control, LATENCY)
    x, y = x[control == 1], y[control == 1]
    check("DENORMALS = 0", flushed, x, y, multiply, True)
    check("DENORMALS = 1", gradual, x, y, multiply, False)
