# SPDX-License-Identifier: Apache-2.0
"""rates_program: the word at every address, two clocks later, against the generator's text; run and rst."""

from __future__ import annotations

import random
import re
from pathlib import Path

from relnav.model import rates_rom as rom

from tb.common.replay import run
from tb.common.vectors import pack, unpack

SIZE = 1 << rom.ADDRESS
NAMES = [name for name, _ in rom.FIELDS]
BITS = [width for _, width in rom.FIELDS]
EARLY = [width for _, width in rom.EARLY]


def test_rates_program(simulator: str, tmp_path: Path) -> None:
    rng = random.Random(92)
    table = [0] * SIZE
    found = re.findall(rf"{rom.ADDRESS}'d(\d+): word <= {rom.WIDTH}'h(\w+);", rom.verilog())
    for address, word in found:
        table[int(address)] = int(word, 16)
    assert len(found) > 300
    plays = [(1, 0, 0)] + [(0, 1, address) for address in range(SIZE)]
    plays += [(int(rng.random() < 0.05), int(rng.random() < 0.9), rng.randrange(SIZE)) for _ in range(3000)]
    stimulus = [
        pack([(int(k > 0), 1), (clear, 1), (go, 1), (at, rom.ADDRESS)])
        for k, (clear, go, at) in enumerate(plays)
    ]
    expected = []
    word = held = 0
    for cycle, (clear, go, address) in enumerate(plays):
        if cycle:
            fields = dict(zip(NAMES, unpack(word, BITS), strict=True))
            expected.append((cycle, [*(fields[name] for name in rom.EARLY_FIELDS), held]))
        held = 0 if clear else word
        word = 0 if clear or not go else table[address]
    top = Path(__file__).parent / "rates_program_replay.v"
    got = run(top, ["ivisnav"], simulator, tmp_path, stimulus, 3 + rom.ADDRESS, [*EARLY, rom.WIDTH], {})
    for mine, theirs in zip(got, expected, strict=True):
        assert mine == theirs
