# SPDX-License-Identifier: Apache-2.0
"""wide_aligner against Python's shift: every shift of corners and random values, complemented or not."""

from __future__ import annotations

import random
from pathlib import Path

from tb.common.replay import run
from tb.common.vectors import corners, pack, random_value

BITS = 70


def test_wide_aligner_floors(simulator: str, tmp_path: Path) -> None:
    rng = random.Random(42)
    stimulus: list[int] = []
    expected = []
    for shift in range(96):
        for value in [*corners(BITS), *(random_value(rng, BITS) for _ in range(40))]:
            invert = rng.getrandbits(1)
            moved = value >> shift
            expected.append((len(stimulus), [(~moved if invert else moved) % (1 << BITS)]))
            stimulus.append(pack([(1, 1), (value, BITS), (invert, 1), (shift, 7)]))
    top = Path(__file__).parent / "wide_aligner_replay.v"
    assert run(top, ["arith"], simulator, tmp_path, stimulus, 1 + BITS + 8, [BITS], {}) == expected
