# SPDX-License-Identifier: Apache-2.0
"""value_feeder: order, addresses, scales, the correction W 2^15, the variance and its denormals."""

from __future__ import annotations

import random
from pathlib import Path

import pytest
from relnav.model import pose_program as pose
from relnav.model.binary32 import from_binary32
from relnav.words import COUNT, LIMB, Build, build

from tb.common.replay import run
from tb.common.vectors import corners, pack, random_value

ADDRESSES = [
    pose.ITEM_W,
    *(8 * axis + pose.KIND_MA for axis in range(3)),
    *(pose.ITEM_MB + axis for axis in range(3)),
    pose.ITEM_COUNT,
    pose.ITEM_VARIANCE,
]
VARIANCES = [0, 1, 0x007FFFFF, 0x00800000, 0x00800001, 0x3F800000, 0x7F7FFFFF]  # denormals among them


def values(weight: int, count: int, moments: list[int], scale: int, variance: int) -> list[tuple[int, int]]:
    """(integer, exponent of its unit) in the order of ADDRESSES; `moments` are a_x b_x a_y b_y a_z b_z."""
    shifted = [m + (weight << (LIMB - 1)) for m in moments]
    axes = [(m, scale) for m in shifted[0::2] + shifted[1::2]]
    mantissa, _ = from_binary32(variance)
    return [(weight, 0), *axes, (count, 0), (mantissa, (variance >> 23) - 150)]


def frame(rng: random.Random, words: Build) -> tuple[int, int, list[int], int, int]:
    """Random or extreme sums whose corrected moments fit M1 bits."""
    weight = rng.choice([1, (1 << words.W) - 1, random_value(rng, words.W, signed=False)])
    correction, half = weight << (LIMB - 1), 1 << (words.M1 - 1)
    highest = half - 1 - correction
    moments = []
    for _ in range(6):
        any_moment = rng.choice([*corners(words.M1)[:: rng.randint(1, 9)], random_value(rng, words.M1)])
        moments.append(min(rng.choice([any_moment, any_moment, -correction, highest, -half]), highest))
    count = rng.choice([0, 3, (1 << COUNT) - 1, rng.getrandbits(COUNT)])
    variance = rng.choice([*VARIANCES, rng.randrange(0x7F800000)])
    return weight, count, moments, rng.choice([-95, 64, 0, rng.randint(-95, 64)]), variance


@pytest.mark.parametrize("weighted", [0, 1], ids=["lean", "full"])
def test_value_feeder(weighted: int, simulator: str, tmp_path: Path) -> None:
    rng = random.Random(65)
    words = build(bool(weighted))
    widths = [1, 1, words.W, COUNT, *[words.M1] * 6, 12, 32]
    stimulus: list[int] = []
    expected = []
    for _ in range(400):
        weight, count, moments, scale, variance = frame(rng, words)
        held = [weight, count, *reversed(moments), scale, variance]
        start = len(stimulus) + 1
        cut = rng.randrange(11) if rng.random() < 0.1 else 9  # a new frame's `clear`
        for cycle in range(-1, 10 + rng.choice([0, 0, 1, 5])):
            clear = cycle == cut != 9
            stimulus.append(pack(zip([clear, cycle == 0, *held], widths, strict=True)))
        sent = values(weight, count, moments, scale, variance)
        for place, (address, (value, unit)) in enumerate(zip(ADDRESSES, sent, strict=True)):
            if place < cut:
                fields = [address, value % (1 << words.M1), unit % (1 << 12)]
                expected.append((start + 1 + place, fields))
    top = Path(__file__).parent / "value_feeder_replay.v"
    parameters = {"WEIGHTED": weighted}
    out = [5, words.M1, 12]
    got = run(top, ["gram"], simulator, tmp_path, stimulus, sum(widths), out, parameters)
    assert len(got) == len(expected)
    for mine, theirs in zip(got, expected, strict=True):
        assert mine == theirs
