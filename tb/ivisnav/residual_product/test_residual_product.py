# SPDX-License-Identifier: Apache-2.0
"""residual_product against integers: every limb at its ends, both ends of the moments, long carries."""

from __future__ import annotations

import random
from itertools import product
from pathlib import Path

from tb.common.replay import run
from tb.common.vectors import corners, pack, random_value, to_signed

LATENCY = 4
LIMB, LIMBS = 17, 6
COUNTS = {"icarus": 8_000, "verilator": 60_000}
SIGNIFICANDS = (0, 1 << 23, (1 << 23) + 1, (1 << 24) - 2, (1 << 24) - 1, 0xAAAAAA, 0xD55555)


def moment_of(limbs: tuple[int, ...]) -> int:
    """The integer of its limbs, the lowest first; the highest is signed."""
    return sum(limb << LIMB * k for k, limb in enumerate(limbs))


def corner_moments() -> list[int]:
    """Powers of two and their neighbours, and all limbs at an end of their range."""
    low = (0, (1 << LIMB) - 1)
    top = (-1024, -1023, -1, 0, 1, 1023)
    limbs = [moment_of((*rest, high)) for *rest, high in product(*[low] * (LIMBS - 1), top)]
    single = [
        moment_of((0,) * k + (limb,) + (0,) * (LIMBS - 1 - k))
        for k in range(LIMBS - 1)
        for limb in (1, (1 << 16) - 1, 1 << 16, (1 << 16) + 1, (1 << LIMB) - 1)
    ]
    return sorted({*corners(96), *limbs, *single})


def random_significand(rng: random.Random) -> int:
    """A rate's: the leading one set, a few bits on top or runs of ones."""
    value = rng.getrandbits(23)
    low = rng.randrange(24)
    return 1 << 23 | rng.choice([value, value >> low << low, value | (1 << low) - 1])


def random_moment(rng: random.Random) -> int:
    """Any length, or limbs each at an end or anywhere."""
    if rng.random() < 0.5:
        return random_value(rng, 96)
    ends = [0, (1 << LIMB) - 1]
    rest = [rng.choice([*ends, rng.getrandbits(LIMB)]) for _ in range(LIMBS - 1)]
    return moment_of((*rest, rng.choice([-1024, 1023, rng.randrange(-1024, 1024)])))


def test_residual_product_is_exact(simulator: str, tmp_path: Path) -> None:
    rng = random.Random(201)
    operands = list(product(corner_moments(), SIGNIFICANDS))
    assert (-(1 << 95), (1 << 24) - 1) in operands
    operands += [(random_moment(rng), random_significand(rng)) for _ in range(COUNTS[simulator])]
    stimulus, expected = [], []
    for moment, significand in operands:
        while rng.random() < 0.05:
            stimulus.append(rng.getrandbits(120))
        expected.append((len(stimulus) + LATENCY, moment * significand))
        stimulus.append(pack([(1, 1), (moment, 96), (significand, 24)]))
    top = Path(__file__).parent / "residual_product_replay.v"
    got = run(top, ["ivisnav"], simulator, tmp_path, stimulus, 121, [120], {})
    assert len(got) == len(expected)
    for (cycle, (found,)), theirs, operand in zip(got, expected, operands, strict=True):
        assert (cycle, to_signed(found, 120)) == theirs, operand
