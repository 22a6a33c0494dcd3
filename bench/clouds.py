# SPDX-License-Identifier: Apache-2.0
"""Families of frames that are hard for the arithmetic; a case is reproduced by its family and number."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from zlib import crc32

import numpy as np
from numpy.random import Generator
from numpy.typing import NDArray
from relnav import golden
from relnav.attitude import FloatArray, rotation_of
from relnav.model.raw import CoreConfig
from relnav.quantise import FRAC_MAX, FRAC_MIN, INPUT_MAX, INPUT_MIN, QuantisedFrame

Integers = NDArray[np.int64]
Clouds = tuple[FloatArray, FloatArray]

MAX_POINTS = 65535


@dataclass(frozen=True, eq=False)
class Case:
    """One frame and the configuration it is run with."""

    family: str
    number: int
    frame: QuantisedFrame
    config: CoreConfig


def make_case(family: str, number: int) -> Case:
    """The case of that number of a family of `FAMILIES`; the same on every call."""
    rng = np.random.default_rng([crc32(family.encode()), number])
    a, b = FAMILIES[family](rng)
    frac = int(rng.integers(FRAC_MIN, FRAC_MAX + 1))
    weights = None if family == "climbed" else random_weights(rng, len(a))
    # on the scale of the integers, where that is a binary32 number: covariances stay in range
    variance = 0.0 if rng.random() < 0.3 else 2.0 ** rng.uniform(-10, 10) * 4.0**-frac
    variance = float(np.float32(variance)) if 1e-37 < variance < 1e37 else 0.0
    return Case(family, number, QuantisedFrame(fit(a), fit(b), weights, frac), CoreConfig(variance=variance))


# ---- parts


def fit(values: FloatArray) -> Integers:
    """Rounded and clipped to 32 bits."""
    return np.clip(np.rint(values), INPUT_MIN, INPUT_MAX).astype(np.int64)


def random_weights(rng: Generator, n: int) -> Integers | None:
    """None, all alike, log-uniform over 16 bits, uniform, or extremes. Never zero: that is another frame."""
    kind = rng.integers(8)
    if kind < 4:
        return None
    if kind == 4:
        return np.full(n, rng.choice([1, 2, 999, 65535]), dtype=np.int64)
    if kind == 5:
        return np.rint(2.0 ** rng.uniform(0, 15.99, n)).astype(np.int64)
    if kind == 6:
        return rng.integers(1, 65536, n)
    return rng.choice([1, 65535], n).astype(np.int64)


def points(rng: Generator, most: int = 200) -> int:
    """3 half the time, else log-uniform."""
    return 3 if rng.random() < 0.4 else int(np.exp(rng.uniform(np.log(3), np.log(most + 1))))


def angle(rng: Generator) -> float:
    """Radians: 0.01 to 180 degrees, uniform or log-uniform, round values now and then."""
    kind = rng.integers(4)
    if kind == 0:
        return float(np.radians(10.0 ** rng.uniform(-2, 2.2552)))
    if kind == 1:
        return float(
            np.radians(rng.choice([0.01, 1, 30, 45, 60, 89.999, 90, 90.001, 120, 137, 150, 179, 179.5]))
        )
    return float(np.radians(rng.uniform(0.01, 179.7)))


def turned(rng: Generator, theta: float) -> FloatArray:
    """R by theta about a random axis, or one near to x, y, z or a diagonal."""
    axis = rng.normal(size=3)
    kind = rng.integers(4)
    if kind == 0:
        axis = np.eye(3)[rng.integers(3)] + axis * rng.choice([0, 1e-9, 1e-4, 1e-2])
    if kind == 1:
        axis = rng.choice([-1, 1], 3) + axis * rng.choice([0, 1e-9, 1e-4, 1e-2])
    return rotation_of(float(np.cos(theta / 2)), axis / np.linalg.norm(axis) * np.sin(theta / 2))


def cloud(rng: Generator, n: int, ratios: FloatArray) -> FloatArray:
    """n points about the origin: an ellipsoid of the given axes, random or along x, y, z."""
    kind = rng.integers(4)
    if kind == 0:
        raw = rng.uniform(-1, 1, (n, 3))
    elif kind == 1:
        raw = rng.choice([-1.0, 1.0], (n, 3)) + 1e-3 * rng.normal(size=(n, 3))
    else:
        raw = np.clip(rng.normal(size=(n, 3)), -3, 3) / 3
    shaped = raw * ratios
    return shaped if rng.random() < 0.3 else shaped @ turned(rng, rng.uniform(0, np.pi)).T


def placed(
    rng: Generator, a: FloatArray, rotation: FloatArray, size: float, noise: float, far: bool
) -> Clouds:
    """a and b = R a + noise in bits, each moved on its own, far or not."""
    b = a @ rotation.T + noise * rng.normal(size=a.shape)
    room = max(2.0**31 - 2 * size, 0.0)
    reach = room if far else min(size * 10.0 ** rng.uniform(-3, 2), room)
    edge = rng.choice([-1.0, 1.0], (2, 3)) if far and rng.random() < 0.7 else rng.uniform(-1, 1, (2, 3))
    return a * size + edge[0] * reach, b * size + edge[1] * reach


def some_noise(rng: Generator) -> float:
    """None, or from far below a bit to a fifth of the cloud."""
    return 0.0 if rng.random() < 0.3 else float(10.0 ** rng.uniform(-9, -0.7))


def some_size(rng: Generator) -> float:
    """Extent in bits."""
    return float(2.0 ** rng.uniform(6, 29.5))


# ---- families


def round_clouds(rng: Generator) -> Clouds:
    """Axes within a factor of 2."""
    a = cloud(rng, points(rng), 2.0 ** -rng.uniform(0, 1, 3))
    return placed(rng, a, turned(rng, angle(rng)), some_size(rng), some_noise(rng), rng.random() < 0.3)


def shapes(rng: Generator) -> Clouds:
    """Axes that differ by up to 2^10: rods and plates."""
    a = cloud(rng, points(rng), 2.0 ** -rng.uniform(0, 10, 3))
    noise = some_noise(rng) * float(10.0 ** -rng.uniform(0, 4))
    return placed(rng, a, turned(rng, angle(rng)), some_size(rng), noise, rng.random() < 0.3)


def planar(rng: Generator) -> Clouds:
    """A plane, exact or nearly, one axis of it up to 50 x shorter."""
    ratios = np.array([1.0, 2.0 ** -rng.uniform(0, 6), rng.choice([0.0, 0.0, 1e-9, 1e-6, 1e-3])])
    a = cloud(rng, points(rng, 50), rng.permutation(ratios))
    return placed(rng, a, turned(rng, angle(rng)), some_size(rng), some_noise(rng), rng.random() < 0.3)


def rods(rng: Generator) -> Clouds:
    """Nearly collinear."""
    a = cloud(rng, points(rng, 50), rng.permutation(np.array([1.0, 10.0 ** -rng.uniform(0, 3.2), 1e-4])))
    return placed(rng, a, turned(rng, angle(rng)), float(2.0 ** rng.uniform(18, 30)), 0.0, rng.random() < 0.3)


def tiny_angles(rng: Generator) -> Clouds:
    """1e-9 to 1e-2 radians; below a bit, too."""
    a = cloud(rng, points(rng), 2.0 ** -rng.uniform(0, 2, 3))
    rotation = turned(rng, float(10.0 ** rng.uniform(-9, -2)))
    return placed(rng, a, rotation, some_size(rng), some_noise(rng) * 1e-3, rng.random() < 0.3)


def far_specks(rng: Generator) -> Clouds:
    """1 to 10 bits of extent at the ends of the range: the rounding is the shape."""
    a = cloud(rng, points(rng, 20), np.ones(3))
    return placed(rng, a, turned(rng, angle(rng)), rng.uniform(1, 10), 0.0, True)


def residual(rng: Generator) -> Clouds:
    """Every turn leaves about 120 degrees: near the quaternions (+-1, +-1, +-1, +-1) / 2."""
    half = rng.choice([-0.5, 0.5], 4) + rng.normal(size=4) * rng.choice([0, 1e-9, 1e-3, 0.1])
    half /= np.linalg.norm(half)
    a = cloud(rng, int(rng.choice([3, 3, 4, 5, 30])), 2.0 ** -rng.uniform(0, 3, 3))
    rotation = rotation_of(float(half[0]), half[1:])
    return placed(rng, a, rotation, some_size(rng), some_noise(rng), rng.random() < 0.3)


def boundary(rng: Generator) -> Clouds:
    """The two largest determinants nearly equal: bisected to the angle where the turn changes."""
    a = cloud(rng, points(rng, 30), 2.0 ** -rng.uniform(0, 3, 3))
    axis = rng.normal(size=3)
    axis /= np.linalg.norm(axis)
    ones = np.ones(len(a))

    def clouds(theta: float) -> FloatArray:
        rotated: FloatArray = a @ rotation_of(float(np.cos(theta / 2)), axis * np.sin(theta / 2)).T
        return rotated

    low, high = 0.0, float(rng.uniform(2.8, 3.1))
    for _ in range(int(rng.integers(20, 45))):
        middle = (low + high) / 2
        if golden.choose_turn(golden.moments(a, clouds(middle), ones)) == 0:
            low = middle
        else:
            high = middle
    rotation = rotation_of(float(np.cos(low / 2)), axis * np.sin(low / 2))
    return placed(rng, a, rotation, some_size(rng), 0.0, rng.random() < 0.3)


def ends(rng: Generator) -> Clouds:
    """Every component at an end of the range, or nearly."""
    values = np.array(
        [INPUT_MIN, INPUT_MAX, *rng.choice([0, -1, 1, INPUT_MIN + 1], rng.integers(0, 3))], float
    )
    n = points(rng, 100)
    a = rng.choice(values, (n, 3))
    if rng.random() < 0.3:
        return a, rng.choice(values, (n, 3))
    signs = rng.choice([-1.0, 1.0], 3)
    return a, a[:, rng.permutation(3)] * signs


def small_integers(rng: Generator) -> Clouds:
    """Few bits, so that determinants tie and residuals vanish exactly."""
    most = int(rng.choice([1, 2, 3, 10]))
    a = rng.integers(-most, most + 1, (points(rng, 20), 3)).astype(float)
    b = a[:, rng.permutation(3)] * rng.choice([-1.0, 1.0], 3) + rng.integers(-9, 10, 3)
    return a, b + (rng.integers(-1, 2, a.shape) if rng.random() < 0.5 else 0.0)


def unrelated(rng: Generator) -> Clouds:
    """No rotation fits."""
    n = points(rng, 30)
    return rng.uniform(INPUT_MIN, INPUT_MAX, (n, 3)), rng.uniform(INPUT_MIN, INPUT_MAX, (n, 3))


def near_180(rng: Generator) -> Clouds:
    """180 degrees less 1e-7 to 3e-1 degrees: q itself runs to infinity."""
    a = cloud(rng, points(rng), 2.0 ** -rng.uniform(0, 2, 3))
    rotation = turned(rng, float(np.pi - np.radians(10.0 ** rng.uniform(-7, -0.5))))
    return placed(rng, a, rotation, some_size(rng), some_noise(rng) * 1e-3, rng.random() < 0.3)


def many(rng: Generator) -> Clouds:
    """65535 points."""
    a = cloud(rng, MAX_POINTS, 2.0 ** -rng.uniform(0, 3, 3))
    rotation = turned(rng, angle(rng))
    return placed(rng, a, rotation, float(2.0 ** rng.uniform(16, 30)), some_noise(rng), rng.random() < 0.5)


def many_ends(rng: Generator) -> Clouds:
    """65535 points at the ends of the range."""
    a = rng.choice([float(INPUT_MIN), float(INPUT_MAX)], (MAX_POINTS, 3))
    return a, a[:, rng.permutation(3)] * rng.choice([-1.0, 1.0], 3)


# found by bench/hill_climb.py in earlier versions: kappa < 30, |q| < 10, yet errors above 1e-7
CLIMBED = (
    (
        (
            (2147481962, -2147482131, 2147482098),
            (2147481922, -2147482124, 2147483647),
            (2147482021, -2147482166, 2147482251),
        ),
        (
            (2147482013, 2147482073, 2147482086),
            (2147481842, 2147482207, 2147482105),
            (2147481951, 2147481918, 2147483644),
        ),
    ),
    (
        (
            (395747726, 531114114, -309099319),
            (395815462, 531161885, -309017830),
            (395841067, 530783580, -309059936),
        ),
        (
            (-898281820, 32468945, 371145174),
            (-898294657, 32351687, 371148035),
            (-898266727, 32378443, 371218813),
        ),
    ),
    (
        (
            (-515382348, -368426617, 1474343008),
            (-515457943, -368424100, 1474338560),
            (-515376421, -368428663, 1474342875),
            (-515374561, -368419037, 1474339667),
        ),
        (
            (1131100092, -93935233, 1106066291),
            (1131096381, -93932759, 1106023189),
            (1131094920, -93937096, 1106064845),
            (1131097269, -93927669, 1106063260),
        ),
    ),
)


def climbed(rng: Generator) -> Clouds:
    """One of `CLIMBED`."""
    a, b = CLIMBED[rng.integers(len(CLIMBED))]
    return np.array(a, dtype=np.float64), np.array(b, dtype=np.float64)


FAMILIES: dict[str, Callable[[Generator], Clouds]] = {
    "round": round_clouds,
    "shapes": shapes,
    "planar": planar,
    "rods": rods,
    "tiny angles": tiny_angles,
    "far specks": far_specks,
    "residual 120": residual,
    "turn boundary": boundary,
    "ends": ends,
    "small integers": small_integers,
    "unrelated": unrelated,
    "near 180": near_180,
    "many": many,
    "many ends": many_ends,
    "climbed": climbed,
}
# cases of a family beside the others; 1 where it is not named
SHARE = {"round": 4.0, "shapes": 3.0, "many": 0.005, "many ends": 0.003, "climbed": 0.02}
