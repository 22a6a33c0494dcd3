# SPDX-License-Identifier: Apache-2.0
"""What the benches of rtl/arith share."""

from __future__ import annotations

import random

from relnav.model.lane import LaneValue

from tb.common.vectors import pack

LARGEST = 1 << 34  # magnitude of the lowest mantissa


def word(value: LaneValue) -> int:
    """A lane value as the hardware's 48 bits."""
    mantissa, exponent = value
    return pack([(int(mantissa == 0), 1), (exponent % (1 << 12), 12), (mantissa, 35)])


def normalised_mantissas() -> list[int]:
    """The ends of both ranges of normalised mantissas, and bit patterns that make long carries."""
    half = LARGEST // 2
    near = [d for power in range(34) for d in ((1 << power) - 1, 1 << power, (1 << power) + 1)]
    positive = {half, LARGEST - 1, *(half + d for d in near), *(LARGEST - 1 - d for d in near)}
    negative = {-LARGEST, -half - 1, *(-half - 1 - d for d in near), *(-LARGEST + d for d in near)}
    return sorted(
        [m for m in positive if half <= m < LARGEST] + [m for m in negative if -LARGEST <= m < -half]
    )


def random_mantissa(rng: random.Random) -> int:
    """A normalised mantissa, one in four with runs of equal bits."""
    magnitude = rng.getrandbits(33) | 1 << 33
    if rng.random() < 0.25:
        low = rng.randrange(1, 33)
        magnitude = (magnitude >> low << low) | (rng.choice([0, (1 << low) - 1]))
    return magnitude if rng.random() < 0.5 else ~magnitude
