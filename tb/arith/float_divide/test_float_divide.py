# SPDX-License-Identifier: Apache-2.0
"""float_divide against numpy: special values, random and nearly halfway quotients; and its protocol."""

from __future__ import annotations

import random
from pathlib import Path

import numpy as np
from relnav.model.float32 import divide

from tb.arith.floats import (
    all_pairs,
    check,
    general_pairs,
    halfway_quotients,
    join,
    play_pairs,
    special_words,
)
from tb.common.replay import run
from tb.common.vectors import pack

LATENCY = {True: 11, False: 14}
"""By flush."""
COUNTS = {"icarus": 10_000, "verilator": 1_040_000}


def test_float_divide_is_ieee(simulator: str, tmp_path: Path) -> None:
    """A pair a clock to as many dividers as it takes, each used again in the cycle of its result."""
    rng = np.random.default_rng(73)
    half = COUNTS[simulator] // 2
    x, y = join(all_pairs(special_words()), general_pairs(rng, half), halfway_quotients(rng, half))
    control = (rng.random(len(x)) < 0.98).astype(np.uint8)
    control[: len(special_words()) ** 2] = 1
    top = Path(__file__).parent / "float_divide_many.v"
    flushed, gradual = play_pairs(top, simulator, tmp_path, (x, y), control, LATENCY[False])
    x, y = x[control == 1], y[control == 1]
    check("DENORMALS = 0", flushed, x, y, divide, True)
    check("DENORMALS = 1", gradual, x, y, divide, False)


def test_float_divide_restarts(simulator: str, tmp_path: Path) -> None:
    """Starts at any distance, most while busy; operands change every clock; one result a whole division."""
    rng = random.Random(74)
    x, y = halfway_quotients(np.random.default_rng(74), 20_000)
    floats = x.view(np.float32), y.view(np.float32)
    quotients = {flush: divide(*floats, flush).view(np.uint32).tolist() for flush in LATENCY}
    starts, at = [], 0
    for _ in range(4000):
        starts.append(at)
        at += rng.choice([*LATENCY.values(), *range(1, 17)])
    begun = set(starts)
    operands = list(zip(x.tolist(), y.tolist(), strict=True))[:at]
    stimulus = [pack([(int(n in begun), 1), (a, 32), (b, 32)]) for n, (a, b) in enumerate(operands)]
    expected = {
        flush: [
            (n + latency, quotients[flush][n])
            for n, after in zip(starts, [*starts[1:], 1 << 30], strict=True)
            if after >= n + latency and n < len(stimulus)
        ]
        for flush, latency in LATENCY.items()
    }
    top = Path(__file__).parent / "float_divide_replay.v"
    got = run(top, ["arith"], simulator, tmp_path, stimulus, 65, [1, 32, 1, 32], {})
    assert [(cycle, flushed) for cycle, (done, flushed, _, _) in got if done] == expected[True]
    assert [(cycle, gradual) for cycle, (_, _, done, gradual) in got if done] == expected[False]
