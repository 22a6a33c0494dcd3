# SPDX-License-Identifier: Apache-2.0
"""Random frames of integers for the whole core: every kind of cloud, weight and binary point."""

from __future__ import annotations

import random

import numpy as np
from numpy.typing import NDArray
from relnav.model.raw import CoreConfig, RawResult
from relnav.quantise import INPUT_MAX, INPUT_MIN, QuantisedFrame

from coverage import points
from tb.common.weights import random_weights

Integers = NDArray[np.int64]
FRACS = (-64, -63, -1, 0, 1, 31, 94, 95)
ANGLES = (0.0, 1e-6, 1.0, 60.0, 90.0, 120.0, 137.0, 179.0, 179.9999, 180.0)


def random_frame(
    rng: random.Random, n: int | None = None, weights: bool | None = None, kind: str | None = None
) -> QuantisedFrame:
    """A frame of n points (default: few); kind is a key of KINDS, weights None leaves both to chance."""
    n = n or rng.choice([3, 3, 4, 5, 7, 12])
    numpy = np.random.default_rng(rng.getrandbits(32))
    a, b = KINDS[kind or rng.choice(list(KINDS))](rng, numpy, n)
    weighted = rng.random() < 0.5 if weights is None else weights
    frac = rng.choice(FRACS) if rng.random() < 0.5 else rng.randint(-64, 95)
    return QuantisedFrame(a, b, random_weights(rng, n) if weighted else None, frac)


def random_config(rng: random.Random, full: bool = True) -> CoreConfig:
    """Turns forbidden or not, variance given or not; re-applied and with covariances where that is built."""
    variance = rng.choice([0.0, 0.0, 1.0, 1e-12, 3e20])
    reapply, covariance = full and rng.random() < 0.4, full and rng.random() < 0.8
    return CoreConfig(rng.random() < 0.25, reapply, covariance, variance)


def observe(frame: QuantisedFrame, config: CoreConfig, feed: str, result: RawResult) -> None:
    """Count a frame whose result was right (coverage/points.py)."""
    points.frame(
        "oltae_top",
        n=frame.n,
        weights=None if frame.w is None else frame.w.tolist(),
        feed=feed,
        fracs=[frame.frac],
        variance=config.variance_word(frame.weight_scale),
        flags=result.flag_names,
        words=None if result.failed else result.result_words(),
        turn=result.turn,
        config=(config.forbid_turns, config.reapply, config.covariance),
    )


def rotation(rng: np.random.Generator, degrees: float) -> NDArray[np.float64]:
    """About a random axis, half the time one of x, y, z."""
    axis = np.eye(3)[rng.integers(3)] if rng.random() < 0.5 else rng.normal(size=3)
    x, y, z = axis / np.linalg.norm(axis)
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    turned: NDArray[np.float64] = (
        np.eye(3) + np.sin(np.radians(degrees)) * cross + (1 - np.cos(np.radians(degrees))) * cross @ cross
    )
    return turned


def _fit(values: NDArray[np.float64]) -> Integers:
    return np.clip(np.rint(values), INPUT_MIN, INPUT_MAX).astype(np.int64)


def _pose(rng: random.Random, numpy: np.random.Generator, n: int) -> tuple[Integers, Integers]:
    """A cloud of any size and shape, turned by any angle, moved, with noise or none."""
    size = 2.0 ** rng.uniform(3, 28)
    shape = np.diag(rng.choice([(1, 1, 1), (1, 1, 0.1), (1, 0.01, 0.01), (1, 1, 0)]))
    a = numpy.normal(size=(n, 3)) @ shape * size
    angle = rng.choice(ANGLES) if rng.random() < 0.5 else rng.uniform(0, 180)
    b = a @ rotation(numpy, angle).T + numpy.normal(size=3) * size * rng.choice([0, 1])
    noise = rng.choice([0.0, 1e-6, 1e-3, 0.1])
    return _fit(a), _fit(b + numpy.normal(size=(n, 3)) * noise * size)


def _far(rng: random.Random, numpy: np.random.Generator, n: int) -> tuple[Integers, Integers]:
    """A small cloud at the end of the range."""
    size = 2.0 ** rng.uniform(2, 20)
    a = numpy.normal(size=(n, 3)) * size
    b = a @ rotation(numpy, rng.uniform(0, 180)).T
    corner = 2.0**31 - 6 * size
    return _fit(a + corner * numpy.choice([-1, 1], 3)), _fit(b + corner * numpy.choice([-1, 1], 3))


def _extreme(rng: random.Random, numpy: np.random.Generator, n: int) -> tuple[Integers, Integers]:
    """Every component at one of the ends, now and then in between."""
    values = [INPUT_MIN, INPUT_MAX] + rng.choice([[], [0], [-1, 0, 1], [INPUT_MIN] * 4])
    return numpy.choice(values, (n, 3)), numpy.choice(values, (n, 3))


def _small(rng: random.Random, numpy: np.random.Generator, n: int) -> tuple[Integers, Integers]:
    """Few bits: ties between the turns, singular sets, zeros."""
    most = rng.choice([1, 2, 7])
    a = numpy.integers(-most, most + 1, (n, 3))
    if rng.random() < 0.5:
        return a, a * numpy.choice([-1, 1], 3) + numpy.integers(-3, 4, 3)
    return a, numpy.integers(-most, most + 1, (n, 3))


def _random(rng: random.Random, numpy: np.random.Generator, n: int) -> tuple[Integers, Integers]:
    """Unrelated clouds."""
    return numpy.integers(INPUT_MIN, INPUT_MAX + 1, (n, 3)), numpy.integers(INPUT_MIN, INPUT_MAX + 1, (n, 3))


KINDS = {"pose": _pose, "far": _far, "extreme": _extreme, "small": _small, "random": _random}
