# SPDX-License-Identifier: Apache-2.0
"""Random frames of integer rows for the iVisNav core: every kind of geometry, weight and binary point."""

from __future__ import annotations

import random

import numpy as np
from numpy.typing import NDArray
from relnav.ivisnav.quantise import QuantisedRows
from relnav.ivisnav.raw import RawRates
from relnav.model.raw import variance_word
from relnav.quantise import INPUT_MAX, INPUT_MIN

from coverage import points
from tb.common.weights import random_weights

Integers = NDArray[np.int64]
FRACS = (-64, -63, -1, 0, 1, 31, 94, 95)
VARIANCES = (0.0, 0.0, 1.0, 1e-12, 3e20)


def random_rows(rng: random.Random, n: int | None = None, kind: str | None = None) -> QuantisedRows:
    """A frame of n rows (default: few); kind is a key of KINDS, None leaves it to chance."""
    n = n or rng.choice([6, 6, 7, 8, 12, 20])
    numpy = np.random.default_rng(rng.getrandbits(32))
    h, y = KINDS[kind or rng.choice(list(KINDS))](rng, numpy, n)
    fracs = [rng.choice(FRACS) if rng.random() < 0.5 else rng.randint(-64, 95) for _ in "hy"]
    return QuantisedRows(h, y, random_weights(rng, n), *fracs)


def observe(frame: QuantisedRows, variance: float, feed: str, result: RawRates) -> None:
    """Count a frame whose result was right (coverage/points.py)."""
    points.frame(
        "ivisnav_top",
        n=frame.n,
        weights=frame.w.tolist(),
        feed=feed,
        fracs=[frame.frac_h, frame.frac_y],
        variance=variance_word(variance, frame.weight_scale),
        flags=result.flag_names,
        words=result.words,
        condition=result.condition_word or None,
    )


def _fit(values: NDArray[np.float64]) -> Integers:
    return np.clip(np.rint(values), INPUT_MIN, INPUT_MAX).astype(np.int64)


def _rates(rng: random.Random, numpy: np.random.Generator, n: int) -> tuple[Integers, Integers]:
    """Rows of a moving body, seen from near or far, with noise or none."""
    r = numpy.normal(size=(n, 3)) * (1, 1, rng.choice([0.1, 1.0, 3.0])) + rng.choice([0.0, 1.0])
    r /= np.linalg.norm(r, axis=1)[:, None]
    p = numpy.normal(size=(n, 3)) * rng.choice([0.3, 1.0, 4.0])
    h = np.hstack((r, np.cross(p, r)))
    y = h @ numpy.normal(size=6) + numpy.normal(size=n) * rng.choice([0.0, 1e-6, 1e-3, 0.1])
    return tuple(_fit(part * (2.0 ** rng.uniform(12, 31) / np.abs(part).max())) for part in (h, y))  # type: ignore[return-value]


def _random(rng: random.Random, numpy: np.random.Generator, n: int) -> tuple[Integers, Integers]:
    """Unrelated numbers of all 32 bits."""
    return numpy.integers(INPUT_MIN, INPUT_MAX + 1, (n, 6)), numpy.integers(INPUT_MIN, INPUT_MAX + 1, n)


def _extreme(rng: random.Random, numpy: np.random.Generator, n: int) -> tuple[Integers, Integers]:
    """Every component at one of the ends, now and then in between."""
    values = [INPUT_MIN, INPUT_MAX] + rng.choice([[], [0], [-1, 0, 1], [INPUT_MIN] * 4])
    return numpy.choice(values, (n, 6)), numpy.choice(values, n)


def _small(rng: random.Random, numpy: np.random.Generator, n: int) -> tuple[Integers, Integers]:
    """Few bits: singular sets, zeros, exact solutions."""
    most = rng.choice([1, 2, 7])
    h = numpy.integers(-most, most + 1, (n, 6))
    if rng.random() < 0.3:
        h[:, rng.randrange(6)] = 0
    y = h @ numpy.integers(-3, 4, 6) if rng.random() < 0.5 else numpy.integers(-most, most + 1, n)
    return h, y


def _thin(rng: random.Random, numpy: np.random.Generator, n: int) -> tuple[Integers, Integers]:
    """Columns of very different size, or nearly alike: conditioning from good to hopeless."""
    h = numpy.normal(size=(n, 6)) * 2.0**28
    if rng.random() < 0.5:
        h *= 2.0 ** -numpy.uniform(0, rng.choice([4, 12, 20]), 6)
    else:
        h[:, 5] = h[:, 4] + h[:, 5] * 2.0 ** -rng.uniform(1, 26)
    return _fit(h), _fit(numpy.normal(size=n) * 2.0 ** rng.uniform(2, 28))


KINDS = {"rates": _rates, "random": _random, "extreme": _extreme, "small": _small, "thin": _thin}
