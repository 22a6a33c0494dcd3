# SPDX-License-Identifier: Apache-2.0
"""butterfly against its model: order, cycle, tag and value of every item, with and without gaps."""

from __future__ import annotations

import random
from pathlib import Path

import pytest
from relnav.model.butterfly import Butterfly, Role, role
from relnav.words import FULL, LEAN, Build

from tb.common.replay import run
from tb.common.vectors import corners, pack, random_value

TAG = 8
LATENCY = 4  # from the flags
FLAGS = {Role.FIRST: 8, Role.SECOND: 4, Role.PLAIN: 2}


@pytest.mark.parametrize("words", [LEAN, FULL], ids=["lean", "full"])
def test_butterfly_matches_the_model(words: Build, simulator: str, tmp_path: Path) -> None:
    rng = random.Random(21)
    bits = words.CENTRED
    low = 48 if words is LEAN else 64
    in_widths = [4, TAG, bits, bits]
    # items of the centring fit one bit less than CENTRED; the butterfly itself wraps, which is tested too
    edge = corners(bits)
    model = Butterfly(words)
    stimulus: list[int] = []
    expected: list[tuple[int, list[int]]] = []

    def operand() -> int:
        return rng.choice(edge) if rng.random() < 0.5 else random_value(rng, bits)

    def rubbish() -> int:
        return rng.getrandbits(TAG + 2 * bits)

    def push(kind: Role | None, item: int) -> None:
        """One item; None: a value item."""
        tag = rng.getrandbits(TAG)
        noise = rng.getrandbits(bits)
        cycle = len(stimulus) + LATENCY
        fields = [FLAGS[kind] if kind else 1, tag, item if kind else noise, noise if kind else item]
        stimulus.append(pack(zip(fields, in_widths, strict=True)))
        leaving = model.push(kind, item, tag) if kind else [(tag, item)]
        for place, (out_tag, value) in enumerate(leaving):
            assert isinstance(out_tag, int)
            expected.append((cycle + place - len(leaving) + 1, [out_tag, value % (1 << bits)]))

    def gap(chance: float) -> None:
        while rng.random() < chance:
            stimulus.append(rubbish())

    for _ in range(3000):
        chance = rng.choice([0.0, 0.0, 0.5])  # back to back, or with gaps
        gap(chance)
        kind = rng.random()
        if kind < 0.5:
            first = operand()
            second = rng.choice([first, -first, first + 1, first - 1, operand(), operand()])
            push(Role.FIRST, first)
            gap(chance)
            push(Role.SECOND, max(-(1 << (bits - 1)), min(second, (1 << (bits - 1)) - 1)))
        else:
            push(Role.PLAIN if kind < 0.8 else None, operand())
    parameters = {"LOW": low, "HIGH": bits - low, "TAG": TAG}
    top = Path(__file__).parent / "butterfly_replay.v"
    got = run(top, ["gram"], simulator, tmp_path, stimulus, sum(in_widths), [TAG, bits], parameters)
    assert len(got) == len(expected)
    for mine, theirs in zip(got, expected, strict=True):
        assert mine == theirs


def test_model_on_a_slot() -> None:
    model = Butterfly(LEAN)
    items = [10, 3, 5, 6, 7, -1, -4]
    out = [pair for lane, value in enumerate(items) for pair in model.push(role(lane), value, lane)]
    assert out == [(0, 13), (1, 7), (2, 5), (3, 13), (4, -1), (5, -5), (6, 3)]


def test_model_refuses_an_item_between_first_and_second() -> None:
    model = Butterfly(LEAN)
    model.push(Role.FIRST, 1)
    with pytest.raises(ValueError, match="second item"):
        model.push(Role.PLAIN, 2)
