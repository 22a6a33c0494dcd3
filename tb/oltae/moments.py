# SPDX-License-Identifier: Apache-2.0
"""Exact centred moments of random clouds, and the moment stream they make: the solve engine's stimulus."""

from __future__ import annotations

import math
import random
from collections.abc import Sequence
from dataclasses import dataclass

from relnav.model import pose_program as pose
from relnav.model import statistics_program as statistics
from relnav.model.lane import LaneValue
from relnav.model.normaliser import Normaliser

Points = list[list[int]]


@dataclass
class Moments:
    """Integer points, weights and the binary point of a frame."""

    a: Points
    b: Points
    w: list[int]
    frac: int
    variance: LaneValue = (0, 0)


def rotation(axis: Sequence[float], angle: float) -> list[list[float]]:
    """Rodrigues' formula for a unit axis."""
    x, y, z = axis
    c, s = math.cos(angle), math.sin(angle)
    v = 1 - c
    return [
        [c + x * x * v, x * y * v - z * s, x * z * v + y * s],
        [y * x * v + z * s, c + y * y * v, y * z * v - x * s],
        [z * x * v - y * s, z * y * v + x * s, c + z * z * v],
    ]


def random_cloud(rng: random.Random) -> Moments:
    """Points of random number, shape, size, offset, rotation, noise and weights, as 32-bit integers."""
    n = rng.choice([3, 4, 10, 50])
    axis = [rng.gauss(0, 1) for _ in range(3)]
    length = math.sqrt(sum(x * x for x in axis))
    r = rotation(
        [x / length for x in axis],
        rng.choice([0.0, 1e-6, 0.01, 1.0, 1.9, 3.0, math.pi, rng.uniform(0, math.pi)]),
    )
    size = 2.0 ** rng.uniform(4, 28)
    shape = [rng.choice([1.0, 1.0, 0.1, 1e-3]) for _ in range(3)]
    offset = [rng.uniform(-1, 1) * rng.choice([0, 2.0**29]) for _ in range(3)]
    shift = [rng.uniform(-1, 1) * size for _ in range(3)]
    noise = size * rng.choice([0, 1e-5, 0.05])

    def clip(x: float) -> int:
        return max(-(1 << 31), min((1 << 31) - 1, round(x)))

    a, b = [], []
    for _ in range(n):
        p = [rng.gauss(0, 0.5) * size * s for s in shape]
        a.append([clip(p[i] + offset[i]) for i in range(3)])
        b.append(
            [
                clip(sum(r[i][j] * p[j] for j in range(3)) + shift[i] + noise * rng.gauss(0, 1))
                for i in range(3)
            ]
        )
    w = [1] * n if rng.random() < 0.5 else [rng.randrange(1, 1 << 16) for _ in range(n)]
    variance = rng.choice([(0, 0), (1 << 33, rng.randint(-60, 20))])
    return Moments(a, b, w, rng.choice([0, 16, -64, 95]), variance)


@dataclass(frozen=True)
class Item:
    """One item of the moment stream: where it goes, what it is; low limbs come in a second drain."""

    address: int
    value: LaneValue
    low: bool = False


def items(cloud: Moments) -> list[Item]:
    """Both drains in the order in which the moment stream delivers them."""
    w, frac = cloud.w, cloud.frac
    total = sum(w)
    columns = [[p[i] for p in points] for i in range(3) for points in (cloud.a, cloud.b)]

    def first(u: list[int]) -> int:
        return sum(k * x for k, x in zip(w, u, strict=True))

    def central(u: list[int], v: list[int]) -> int:
        return total * sum(k * x * y for k, x, y in zip(w, u, v, strict=True)) - first(u) * first(v)

    a, b = columns[0::2], columns[1::2]
    pairs: list[
        tuple[int, int | None, int | None, int, int]
    ] = []  # slot, place, place of the low limb, value, doubling
    for i in range(3):
        sa, sb = central(a[i], a[i]), central(b[i], b[i])
        pairs.append((i, pose.KIND_T, statistics.KIND_T_LOW, sa + sb, 0))
        pairs.append((i, pose.KIND_E, None, sa - sb, 0))
        pairs.append((i, pose.KIND_B2, statistics.KIND_B2_LOW, central(b[i], a[i]), 1))
    for i in (0, 2, 1):
        j = (i + 1) % 3
        sa, sb = central(a[i], a[j]), central(b[i], b[j])
        bij, bji = central(b[i], a[j]), central(b[j], a[i])
        pairs.append((i, pose.KIND_F, None, sa + sb, 0))
        pairs.append((i, pose.KIND_H, None, sa - sb, 0))
        pairs.append((i, pose.KIND_P, statistics.KIND_P_LOW, bij + bji, 0))
        pairs.append((i, pose.KIND_N, statistics.KIND_N_LOW, bij - bji, 0))
    normaliser = Normaliser()
    found = [
        Item(8 * i + p, normaliser.run(v, False, d - 2 * frac)) for i, p, _, v, d in pairs if p is not None
    ]
    found.append(Item(pose.ITEM_W, normaliser.run(total)))
    found += [Item(8 * i + pose.KIND_MA, normaliser.run(first(a[i]), False, -frac)) for i in range(3)]
    found += [Item(pose.ITEM_MB + i, normaliser.run(first(b[i]), False, -frac)) for i in range(3)]
    found.append(Item(pose.ITEM_COUNT, normaliser.run(len(w))))
    found.append(Item(pose.ITEM_VARIANCE, cloud.variance))
    for i, _, p, v, d in pairs:
        value = normaliser.run(v, True, d - 2 * frac)
        found.append(Item(8 * i + p if p is not None else -1, value, low=True))
    return found
