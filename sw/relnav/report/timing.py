# SPDX-License-Identifier: Apache-2.0
"""What the same poses cost in software on the machine at hand."""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import cv2
import numpy as np

from .. import golden
from ..frames import Frame
from ..wahba import kabsch

Solver = Callable[[Frame], object]


@dataclass(frozen=True)
class Timing:
    """Seconds a pose (median over frames and repeats) of a named solver, and what it gives."""

    name: str
    seconds: float
    gives: str


def time_solvers(frames: Sequence[Frame], repeats: int = 5) -> list[Timing]:
    """Median time of one pose, matched points in memory to result, one thread, over all frames."""
    threads = cv2.getNumThreads()
    cv2.setNumThreads(1)
    try:
        return [
            Timing("numpy, OLTAE (Eq. 25)", median_seconds(_attitude, frames, repeats), "q"),
            Timing("numpy, golden model", median_seconds(_golden, frames, repeats), "q, R, t, covariance"),
            Timing("numpy, SVD (Kabsch)", median_seconds(_kabsch, frames, repeats), "R, t"),
            Timing("OpenCV, estimateAffine3D", median_seconds(_opencv, frames, repeats), "R, t, unweighted"),
        ]
    finally:
        cv2.setNumThreads(threads)


def median_seconds(solver: Callable[[Any], object], frames: Sequence[Any], repeats: int) -> float:
    """Median time of one call over all frames and repeats."""
    solver(frames[0])  # the first call pays for imports and caches
    spent: list[float] = []
    for _ in range(repeats):
        for frame in frames:
            start = time.perf_counter()
            solver(frame)
            spent.append(time.perf_counter() - start)
    return float(np.median(spent))


def _attitude(frame: Frame) -> object:
    weights = np.ones(len(frame.a)) if frame.w is None else frame.w
    a_bar, b_bar = golden.centroids(frame.a, frame.b, weights)
    s, y = golden.sums_and_differences(golden.centre(frame.a, a_bar), golden.centre(frame.b, b_bar))
    return golden.solve(golden.normal_matrix(s, weights), golden.normal_vector(s, y, weights))


def _golden(frame: Frame) -> object:
    return golden.estimate(frame.a, frame.b, frame.w)


def _kabsch(frame: Frame) -> object:
    return kabsch(frame.a, frame.b, frame.w)


def _opencv(frame: Frame) -> object:
    # the closed form (Umeyama), not RANSAC: gating has been done
    return cv2.estimateAffine3D(frame.a, frame.b, force_rotation=True)
