# SPDX-License-Identifier: Apache-2.0
"""result_queue: every kind of output, back to back, marks, both strides, resets under way."""

from __future__ import annotations

import random
from pathlib import Path

from relnav.model import assembler as asm
from relnav.model.binary32 import to_binary32
from relnav.model.lane import ZERO, LaneValue

from tb.arith import random_mantissa, word
from tb.common.replay import run
from tb.common.vectors import pack

LATENCY = 2
WIDTHS = [1, 1, 1, 1, 3, 6, 3, 48, 48, 48, 48]


def random_result(rng: random.Random) -> LaneValue:
    return ZERO if rng.random() < 0.1 else (random_mantissa(rng), rng.randint(-200, 150))


def test_result_queue(simulator: str, tmp_path: Path) -> None:
    rng = random.Random(63)
    stimulus: list[int] = []
    expected: dict[int, list[int]] = {}  # cycle -> index, mark, word

    def cycle(clear: int, enter: int, kind: int, index: int, mark: int, results: list[LaneValue]) -> None:
        places = sum(1 << place for place in asm.OUTPUT_PLACES[kind])
        fields = [clear, enter, kind == asm.SINGLE, kind == asm.TRIPLE_COLUMN, places, index, mark]
        stimulus.append(pack(zip([*fields, *map(word, results)], WIDTHS, strict=True)))
        if clear:  # what would leave from the next clock on does not
            for lost in [at for at in expected if at > len(stimulus) - 1]:
                del expected[lost]

    def any_fields() -> tuple[int, int, int, list[LaneValue]]:
        results = [random_result(rng) for _ in range(4)]
        return rng.choice(list(asm.OUTPUT_PLACES)), rng.randrange(64), rng.randrange(8), results

    for _ in range(3000):
        kind, index, mark, results = any_fields()
        places = asm.OUTPUT_PLACES[kind]
        for place in places:
            at = (index + place * (3 if kind == asm.TRIPLE_COLUMN else 1)) % 64
            value = results[0 if kind == asm.SINGLE else place + 1]
            last = mark if place == places[-1] else 0
            expected[len(stimulus) + LATENCY + place] = [at, last, to_binary32(value)]
        cycle(int(rng.random() < 0.02), 1, kind, index, mark, results)
        # the schedule lets the next ones enter when the last place has been taken
        for _ in range(places[-1] + rng.choice([0, 0, 1, 4])):
            cycle(int(rng.random() < 0.03), 0, *any_fields())
    top = Path(__file__).parent / "result_queue_replay.v"
    got = run(top, ["arith", "oltae"], simulator, tmp_path, stimulus, sum(WIDTHS), [6, 3, 32], {})
    assert len(got) == len(expected)
    for mine, theirs in zip(got, expected.items(), strict=True):
        assert mine == theirs
