# SPDX-License-Identifier: Apache-2.0
"""Matched 3-D points of two frames: SIFT, unique mutual matches, range between pixels, gating.

Source: OLTAE paper, "Correspondence between two point-clouds using image features".
"""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from ..wahba import kabsch
from .camera import Pinhole
from .lidar import Mask, Surface
from .mounting import Mounting

Array = NDArray[np.float64]
Index = NDArray[np.int64]
Image = NDArray[np.uint8]

RATIO = 0.75  # Lowe's ratio test
# How well SIFT places a feature along one axis, pixels: measured on this simulation against the truth,
# over both terrains (camera 0.047-0.058, bearing-angle 0.21-0.26).
CAMERA_SIGMA = 0.06
BEARING_SIGMA = 0.25
FEWEST = 3  # below this the pose is singular


@dataclass(frozen=True, eq=False)
class Features:
    """SIFT key points of one image.

    Args:
        uv: (n, 2) pixels. size: (n,) pixels, diameter. descriptors: (n, 128) float32.
    """

    uv: Array
    size: Array
    descriptors: NDArray[np.float32]


def detect(image: Image, limit: int) -> Features:
    """The strongest ``limit`` SIFT features, one a place (SIFT repeats a place for each orientation)."""
    # without precise upscaling every place is a quarter of a pixel off, which rotation turns into a drift
    sift = cv2.SIFT.create(nfeatures=limit, enable_precise_upscale=True)
    points, descriptors = sift.detectAndCompute(image, None)
    if descriptors is None or len(points) == 0:
        return Features(np.zeros((0, 2)), np.zeros(0), np.zeros((0, 128), dtype=np.float32))
    uv = np.array([point.pt for point in points], dtype=np.float64)
    size = np.array([point.size for point in points], dtype=np.float64)
    _, first = np.unique(uv, axis=0, return_index=True)
    first.sort()
    return Features(uv[first], size[first], np.asarray(descriptors[first], dtype=np.float32))


def match(before: Features, after: Features, ratio: float = RATIO) -> Index:
    """Pairs (m, 2) of indices that pass the ratio test in both directions and choose each other."""
    if len(before.uv) < 2 or len(after.uv) < 2:
        return np.zeros((0, 2), dtype=np.int64)
    forward, there = _nearest(before.descriptors, after.descriptors, ratio)
    backward, back = _nearest(after.descriptors, before.descriptors, ratio)
    index = np.arange(len(forward))
    mutual = there & back[forward] & (backward[forward] == index)
    return np.column_stack([index[mutual], forward[mutual]])


def _nearest(query: NDArray[np.float32], train: NDArray[np.float32], ratio: float) -> tuple[Index, Mask]:
    """Index of the nearest of ``train`` for each of ``query``, and whether it is clearly the nearest."""
    # SIFT descriptors all have the same length to within rounding, but the exact distance costs nothing
    square = (query**2).sum(1)[:, None] + (train**2).sum(1)[None, :] - 2.0 * query @ train.T
    two = np.argpartition(square, 1, axis=1)[:, :2]
    values = np.take_along_axis(square, two, axis=1)
    order = np.argsort(values, axis=1)
    values = np.maximum(np.take_along_axis(values, order, axis=1), 0.0)
    nearest = np.take_along_axis(two, order, axis=1)[:, 0]
    return nearest.astype(np.int64), values[:, 0] < ratio**2 * values[:, 1]


@dataclass(frozen=True, eq=False)
class View:
    """The image's geometry and how well a feature is placed in it.

    Args:
        pixel_sigma: standard deviation of a feature's place along one axis, pixels.
    """

    pinhole: Pinhole
    mounting: Mounting
    pixel_sigma: float


def locate(view: View, lidar_mounting: Mounting, surface: Surface, uv: Array) -> tuple[Array, Array, Mask]:
    """Where the rays through image places meet the scanned surface.

    The camera's ray is followed to the depth guessed so far, that point is looked up in the scan, and the
    scan's depth there corrects the guess; the two mountings' parallax is small, so this settles at once.

    Args:
        uv: (n, 2) pixels of the view.

    Returns:
        Points (n, 3) m in the body frame; their variance (n,) m^2 per axis; a mask of those to be trusted.
        The variance is isotropic, as OLTAE's weights are: the larger of pixel and range error, so that bounds
        hold along every axis.
    """
    rays = view.mounting.directions_to_body(view.pinhole.directions(uv))
    with np.errstate(all="ignore"):
        guess = 1.0 / np.nanmedian(surface.inverse_depth) if np.isfinite(surface.inverse_depth).any() else 1.0
    depth = np.full(len(uv), guess)
    share, good = np.ones(len(uv)), np.zeros(len(uv), dtype=bool)
    for _ in range(4):
        seen = lidar_mounting.from_body(view.mounting.position + depth[:, None] * rays)
        measured, share, good = surface.at(surface.pinhole.project(seen))
        depth = np.where(good, depth * measured / seen[:, 2], depth)
    points = view.mounting.position + depth[:, None] * rays
    across = view.pixel_sigma / view.pinhole.focal * depth
    along = surface.depth_sigma * depth * np.sqrt(share)
    return points, np.maximum(across, along) ** 2, good


def gate(a: Array, b: Array, variance: Array, rng: np.random.Generator, *, trials: int = 200) -> Mask:
    """Which matches (n,) belong to one rigid motion b = R a + t.

    Seeded trials of triples find the motion with the smallest median residual (nothing need be known of
    the noise); then 4 robust standard deviations about the least-squares motion of those kept, repeated
    until it settles.

    Args:
        a, b: (n, 3) m. variance: (n,) m^2 per axis of b - R a.
    """
    n = len(a)
    if n <= FEWEST:
        return np.ones(n, dtype=bool)
    scale = np.sqrt(variance)
    best = np.full(n, np.inf)
    for _ in range(trials):
        pick = rng.choice(n, 3, replace=False)
        residual = _residual(a, b, *kabsch(a[pick], b[pick])) / scale
        if np.median(residual) < np.median(best):
            best = residual
    kept: Mask = best <= 3.0 * np.median(best)
    for _ in range(10):
        residual = _residual(a, b, *kabsch(a[kept], b[kept], 1.0 / variance[kept])) / scale
        # the median of the length of a 3-D unit normal vector is 1.538
        limit = 4.0 * np.median(residual[kept]) / 1.538
        now = residual <= max(limit, np.partition(residual, FEWEST - 1)[FEWEST - 1])
        if np.array_equal(now, kept):
            break
        kept = now
    return kept


def _residual(a: Array, b: Array, rotation: Array, translation: Array) -> Array:
    length: Array = np.linalg.norm(b - a @ rotation.T - translation, axis=1)
    return length
