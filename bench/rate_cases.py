# SPDX-License-Identifier: Apache-2.0
"""Frames of rows for the iVisNav core; a case is reproduced by its family and number."""

from __future__ import annotations

from collections.abc import Callable
from zlib import crc32

import numpy as np
from numpy.random import Generator
from relnav.attitude import FloatArray
from relnav.ivisnav.beacons import Beacons, alternate_ring, turned_ring
from relnav.ivisnav.quantise import QuantisedRows, metres_per_second, quantise_rows
from relnav.ivisnav.rows import make_rate_frame

Cell = tuple[str, float, float, bool]
"""Ring of `RINGS`, its radius and distance, m, and whether its rows have weights of 1 to 65535."""

F0, DT = 20e6, 0.01  # the paper's sensor: Hz, s
RADII, DISTANCES = (0.15, 0.5, 1.0), (1.0, 2.0, 5.0)  # m

RINGS: dict[str, Callable[[Generator, float], Beacons]] = {
    "alternately skewed": lambda rng, radius: alternate_ring(
        radius, rng.uniform(0.08, 0.5), rng.uniform(-0.2, 0.2)
    ),
    "alternately turned": lambda rng, radius: turned_ring(radius, rng.uniform(0.3, 1.2)),
}

WIDTH = 31  # bits of a quantised value, without its sign


def ring_rows(cell: Cell, number: int) -> QuantisedRows:
    """Six beams on a ring; v_z and omega_z of 0.01 to 1 of either sign, the other rates 0."""
    name, radius, distance, weighted = cell
    rng = np.random.default_rng([crc32(name.encode()), round(1e3 * radius), round(distance), number])
    beacons = RINGS[name](rng, radius)
    x = np.zeros(6)
    x[[2, 5]] = 10.0 ** rng.uniform(-2, 0, 2) * rng.choice([-1.0, 1.0], 2)
    weights = rng.integers(1, 65536, 6).astype(np.float64) if weighted else None
    return quantised(beacons, distance, beacons.matrix(distance) @ x, weights)


def quantised(beacons: Beacons, distance: float, y: FloatArray, weights: FloatArray | None) -> QuantisedRows:
    """Rows of the beacons' range rates y (n,) m/s, as the driver makes them."""
    dphi = y / metres_per_second(F0, DT)
    frame = make_rate_frame(beacons.directions, beacons.displacements(distance), dphi, weights)
    return quantise_rows(frame, F0, DT)


def random_rows(condition: float, number: int) -> QuantisedRows:
    """H = U S V^T of 6 to 20 rows, U and V random, S from 1 to 1 / condition; noise half of the time."""
    rng = np.random.default_rng([round(1e3 * condition), number])
    n = int(rng.integers(6, 21))
    u, _, v = np.linalg.svd(rng.normal(size=(n, 6)), full_matrices=False)
    between = rng.uniform(0.0, 1.0, 4)
    # spread evenly, by octaves, or all four beside one of the ends
    kind = rng.integers(4)
    values = (
        1.0 + between * (1.0 / condition - 1.0)
        if kind == 0
        else condition**-between
        if kind == 1
        else condition ** -(between * 0.1 + (0.9 if kind == 2 else 0.0))
    )
    h = u * np.concatenate(([1.0], values, [1.0 / condition])) @ v
    x = rng.normal(size=6) * 10.0 ** rng.uniform(-2, 0, 6)
    y = h @ x
    if rng.random() < 0.5:
        y += np.linalg.norm(y) * 10.0 ** rng.uniform(-6, -1) * rng.normal(size=n)
    return rows_of(h, y)


def rows_of(h: FloatArray, y: FloatArray) -> QuantisedRows:
    """h (n, 6) and y (n,) as integers of 32 bits, without weights."""
    fracs = [WIDTH - int(np.frexp(np.abs(values).max())[1]) for values in (h, y)]
    limit = (1 << WIDTH) - 1
    integers = [
        np.minimum(np.rint(np.ldexp(values, frac)), limit).astype(np.int64)
        for values, frac in zip((h, y), fracs, strict=True)
    ]
    return QuantisedRows(integers[0], integers[1], np.ones(len(y), np.int64), fracs[0], fracs[1])


def noisy_rows(number: int, least: int, most: int) -> tuple[QuantisedRows, FloatArray, float]:
    """(rows, true rates (6,), variance of y at the user's unit weight) of a ring with noise.

    least, most: rows, an even number between them. Noise of 1e-5 to 1e-2 of the range rates' rms.
    """
    rng = np.random.default_rng([least, most, number])
    count = 2 * int(rng.integers(least // 2, most // 2 + 1))
    radius, distance = rng.uniform(0.15, 1.0), rng.uniform(1.0, 5.0)
    beacons = alternate_ring(radius, rng.uniform(0.2, 0.5), rng.uniform(-0.2, 0.2), count)
    x = rng.normal(size=6)
    y = beacons.matrix(distance) @ x
    weights = 2.0 ** rng.uniform(0, 8, count).round() if rng.random() < 0.5 else None
    sigma = 10.0 ** rng.uniform(-5, -2) * float(np.sqrt(np.mean(y**2)))
    spread = sigma / np.sqrt(1.0 if weights is None else weights)
    return quantised(beacons, distance, y + spread * rng.normal(size=count), weights), x, sigma**2


def residual_rows(noise: float, number: int) -> QuantisedRows:
    """A ring of 12 beams, noise relative to the rms of the range rates."""
    rng = np.random.default_rng([round(-np.log10(noise)), number])
    beacons, distance = alternate_ring(rng.uniform(0.15, 1.0), count=12), rng.uniform(1.0, 5.0)
    y = beacons.matrix(distance) @ rng.normal(size=6)
    return quantised(beacons, distance, y + noise * np.sqrt(np.mean(y**2)) * rng.normal(size=12), None)
