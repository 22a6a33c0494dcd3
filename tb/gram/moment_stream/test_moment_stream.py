# SPDX-License-Identifier: Apache-2.0
"""moment_stream against the models of its parts: drains of 21 pairs, values between them, gaps."""

from __future__ import annotations

import random
from dataclasses import dataclass, field
from pathlib import Path

import pytest
from relnav.model.butterfly import Butterfly, role
from relnav.model.centring import Centring
from relnav.model.normaliser import Normaliser
from relnav.words import FULL, LEAN, Build

from tb.common.replay import run
from tb.common.vectors import corners, pack, random_value

TAG = 6  # {value, slot, lane}
FIELDS = (
    *("pair", "value_valid", "low", "tag", "value_tag", "scale", "value_scale"),
    *("w", "g", "i", "j", "value"),
)


@dataclass
class Scenario:
    """Stimulus of a replay and what has to come out of it, cycle by cycle."""

    words: Build
    value_bits: int
    rng: random.Random
    stimulus: list[int] = field(default_factory=list)
    expected: list[tuple[int, list[int]]] = field(default_factory=list)

    def __post_init__(self) -> None:
        words = self.words
        self.latency = 10 if words is LEAN else 11
        self.widths = [1, 1, 1, TAG, TAG, 12, 12, words.W, words.M2, words.M1, words.M1, self.value_bits]
        self.centring, self.butterfly = Centring(words), Butterfly(words)

    def word(self, low: int, **known: int) -> None:
        """One cycle; what is not named is random, save the valid bits."""
        fields = [known.get(n, self.rng.getrandbits(b)) for n, b in zip(FIELDS, self.widths, strict=True)]
        fields[:3] = [known.get("pair", 0), known.get("value_valid", 0), low]
        self.stimulus.append(pack(zip(fields, self.widths, strict=True)))

    def item(self, back: int, tag: int, value: int, low: int, scale: int) -> None:
        mantissa, exponent = Normaliser().run(value, bool(low), scale)
        cycle = len(self.stimulus) + self.latency - back
        self.expected.append((cycle, [tag, int(mantissa == 0), mantissa % (1 << 35), exponent % (1 << 12)]))

    def pair(self, slot: int, lane: int, operands: tuple[int, int, int, int], low: int, scale: int) -> None:
        tag = 8 * slot + lane
        leaving = self.butterfly.push(role(lane), self.centring.run(*operands), tag)
        for place, (out_tag, value) in enumerate(leaving):
            assert isinstance(out_tag, int)
            self.item(len(leaving) - 1 - place, out_tag, value, low, scale)
        w, g, i, j = operands
        self.word(low, pair=1, tag=tag, scale=scale % 4096, w=w, g=g, i=i, j=j)

    def value(self, low: int) -> None:
        tag, scale = 32 + self.rng.randrange(32), self.rng.randint(-200, 200)
        corner = self.rng.choice(corners(self.value_bits))
        value = self.rng.choice([corner, random_value(self.rng, self.value_bits)])
        self.item(0, tag, value, low, scale)
        self.word(low, value_valid=1, value_tag=tag, value_scale=scale % 4096, value=value)

    def operands(self, last: tuple[int, int, int, int] | None) -> tuple[int, int, int, int]:
        words, rng = self.words, self.rng
        kind = rng.random()
        if kind < 0.2 and last:  # the same again: differences of 0 and near it
            w, g, i, j = last
            half = 1 << (words.M2 - 1)
            return w, max(-half, min(g + rng.choice([0, 0, 1, -1]), half - 1)), i, j
        if kind < 0.5:
            bits = (words.M2, words.M1, words.M1)
            ends = [rng.choice([-(1 << (b - 1)), (1 << (b - 1)) - 1, 0, 1, -1]) for b in bits]
            return rng.choice([1, (1 << words.W) - 1]), ends[0], ends[1], ends[2]
        return (
            random_value(rng, words.W, signed=False),
            random_value(rng, words.M2),
            random_value(rng, words.M1),
            random_value(rng, words.M1),
        )

    def drain(self, gaps: float) -> None:
        """One pass of 21 pairs, perhaps with gaps; values only where they may come."""
        rng, last = self.rng, None
        low, scale = rng.randrange(2), rng.randint(-200, 200)
        for slot in range(3):
            for lane in range(7):
                while rng.random() < gaps:
                    if lane not in (1, 4, 6) and rng.random() < 0.5:
                        self.value(low)
                    else:
                        self.word(low)
                last = self.operands(last)
                self.pair(slot, lane, last, low, scale)
        for _ in range(rng.choice([0, 0, 1, 8, 21])):
            self.value(low)


@pytest.mark.parametrize("narrow_value", [False, True], ids=["value-whole", "value-narrow"])
@pytest.mark.parametrize("words", [LEAN, FULL], ids=["lean", "full"])
def test_moment_stream_matches_the_models(
    words: Build, narrow_value: bool, simulator: str, tmp_path: Path
) -> None:
    value_bits = words.M1 + 2 if narrow_value else words.CENTRED
    scenario = Scenario(words, value_bits, random.Random(41))
    for number in range(400):
        scenario.drain(0.0 if number % 2 else 0.3)
    parameters = {"W": words.W, "M1": words.M1, "M2": words.M2, "CENTRED": words.CENTRED, "VALUE": value_bits}
    top = Path(__file__).parent / "moment_stream_replay.v"
    got = run(
        top,
        ["gram"],
        simulator,
        tmp_path,
        scenario.stimulus,
        sum(scenario.widths),
        [TAG, 1, 35, 12],
        parameters,
    )
    assert len(got) == len(scenario.expected)
    for mine, theirs in zip(got, scenario.expected, strict=True):
        assert mine == theirs
