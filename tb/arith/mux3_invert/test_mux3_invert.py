# SPDX-License-Identifier: Apache-2.0
"""mux3_invert: each input by each select, complemented or not, each bit alone and among random ones."""

from __future__ import annotations

import random
from itertools import product
from pathlib import Path

import pytest

from tb.common.replay import run
from tb.common.vectors import pack


@pytest.mark.parametrize("width", [1, 30])
def test_mux3_invert(simulator: str, tmp_path: Path, width: int) -> None:
    rng = random.Random(width)
    everything = (1 << width) - 1
    cases = [
        tuple((everything ^ flip if chosen == k else 0) ^ (everything if inverted else 0) for k in range(3))
        for chosen in range(3)
        for inverted in (False, True)
        for flip in (0, *(1 << bit for bit in range(width)))
    ]
    cases += [tuple(rng.getrandbits(width) for _ in range(3)) for _ in range(300)]
    plays = list(product(range(3), range(2), cases))
    rng.shuffle(plays)
    stimulus = [
        pack([(1, 1), (select, 2), (invert, 1), *((value, width) for value in reversed(inputs))])
        for select, invert, inputs in plays
    ]
    expected = [
        (cycle, [inputs[select] ^ (everything if invert else 0)])
        for cycle, (select, invert, inputs) in enumerate(plays)
    ]
    top = Path(__file__).parent / "mux3_invert_replay.v"
    got = run(top, ["arith"], simulator, tmp_path, stimulus, 4 + 3 * width, [width], {"WIDTH": width})
    assert got == expected
