# SPDX-License-Identifier: Apache-2.0
"""Rows for the benches: random H of a wanted condition, rings, and integers as a driver would make them."""

from __future__ import annotations

import random
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
from relnav.model.gram_ring import RingSums, gram_ring
from relnav.model.rates_scale import FrameScale

FloatArray = npt.NDArray[np.float64]
IntArray = npt.NDArray[np.int64]


@dataclass(frozen=True)
class Rows:
    """One frame of integers: h (n, 6), y (n,), w (n,), and their binary points."""

    h: IntArray
    y: IntArray
    w: IntArray
    frac_h: int
    frac_y: int

    def sums(self) -> RingSums:
        """The exact sums."""
        return gram_ring(self.h, self.y, self.w)

    def scale(self, variance: int) -> FrameScale:
        """Their powers of two."""
        return FrameScale.of(self.sums(), self.frac_h, self.frac_y, variance)


def quantised(h: FloatArray, y: FloatArray, w: IntArray | None = None, bits: int = 31) -> Rows:
    """The finest binary points at which |value| < 2^bits."""

    def frac(values: FloatArray) -> int:
        largest = float(np.abs(values).max())
        return bits - int(np.frexp(largest)[1]) if largest else 0

    frac_h, frac_y = frac(h), frac(y)
    limit = (1 << 31) - 1
    return Rows(
        np.minimum(np.rint(np.ldexp(h, frac_h)), limit).astype(np.int64),
        np.minimum(np.rint(np.ldexp(y, frac_y)), limit).astype(np.int64),
        np.ones(len(y), np.int64) if w is None else w,
        frac_h,
        frac_y,
    )


def random_rows(rng: random.Random, condition: float, n: int, noise: float = 0.0) -> Rows:
    """H with singular values from 1 to 1/condition, random rates and weights."""
    generator = np.random.default_rng(rng.getrandbits(32))
    u, _, v = np.linalg.svd(generator.normal(size=(n, 6)), full_matrices=False)
    between = generator.uniform(1.0 / condition, 1.0, 4)
    h = u * np.concatenate(([1.0], between, [1.0 / condition])) @ v
    y = h @ generator.normal(size=6) + noise * generator.normal(size=n)
    w = generator.integers(1, 65536, n) if rng.random() < 0.5 else None
    return quantised(h * 2.0 ** rng.randint(-20, 20), y * 2.0 ** rng.randint(-20, 20), w)
