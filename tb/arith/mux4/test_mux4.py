# SPDX-License-Identifier: Apache-2.0
"""mux4: each input by each select, each bit alone and among random ones."""

from __future__ import annotations

import random
from pathlib import Path

import pytest

from tb.common.replay import run
from tb.common.vectors import pack


@pytest.mark.parametrize("width", [1, 28])
def test_mux4(simulator: str, tmp_path: Path, width: int) -> None:
    rng = random.Random(width)
    everything = (1 << width) - 1
    cases = [
        tuple((everything ^ flip if chosen == k else 0) ^ (everything if inverted else 0) for k in range(4))
        for chosen in range(4)
        for inverted in (False, True)
        for flip in (0, *(1 << bit for bit in range(width)))
    ]
    cases += [tuple(rng.getrandbits(width) for _ in range(4)) for _ in range(300)]
    plays = [(select, inputs) for inputs in cases for select in range(4)]
    rng.shuffle(plays)
    stimulus = [
        pack([(1, 1), (select, 2), *((value, width) for value in reversed(inputs))])
        for select, inputs in plays
    ]
    expected = [(cycle, [inputs[select]]) for cycle, (select, inputs) in enumerate(plays)]
    top = Path(__file__).parent / "mux4_replay.v"
    got = run(top, ["arith"], simulator, tmp_path, stimulus, 3 + 4 * width, [width], {"WIDTH": width})
    assert got == expected
