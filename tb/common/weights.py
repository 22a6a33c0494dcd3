# SPDX-License-Identifier: Apache-2.0
"""Weights of random frames."""

from __future__ import annotations

import random
from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray


def random_weights(rng: random.Random, n: int) -> NDArray[np.int64]:
    """Weights 0..65535: all alike, few, extreme, or any."""
    draws: list[Callable[[], int]] = [
        lambda: 1,
        lambda: 65535,
        lambda: rng.choice([0, 1]),
        lambda: rng.choice([0, 1, 65535]),
        lambda: rng.randint(1, 9),
        lambda: rng.randint(0, 65535),
    ]
    draw = rng.choice(draws)
    return np.array([draw() for _ in range(n)], dtype=np.int64)
