# SPDX-License-Identifier: Apache-2.0
"""A whole approach: images and scans of every frame, and the matched points of every consecutive pair."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from ..errors import InputError
from ..frames import Frame
from .bearing_angle import bearing_angle_image
from .camera import Camera, Ground, Pinhole
from .features import (
    BEARING_SIGMA,
    CAMERA_SIGMA,
    FEWEST,
    Features,
    View,
    detect,
    gate,
    locate,
    match,
)
from .lidar import Lidar, Mask, surface_of
from .mounting import CAMERA_MOUNTING, LIDAR_MOUNTING
from .raycast import RayCaster
from .terrain import Terrain
from .trajectory import BodyPose, Trajectory, approach, crp_of, relative_pose

Array = NDArray[np.float64]
Image = NDArray[np.uint8]

IMAGE_SOURCES = ("camera", "bearing-angle")
FEATURE_LIMIT = 800
LARGEST_WEIGHT = 65535


@dataclass(frozen=True, eq=False)
class Exposure:
    """One instant: image, scan and the features found, each with its 3-D place.

    Args:
        image: (h, w) grey levels. ranges: (h, w) m. features: in the image. points: (n, 3) m, body frame.
        variance: (n,) m^2 per axis. located: (n,) the scan gives a sound range there.
    """

    pose: BodyPose
    image: Image
    ranges: Array
    features: Features
    points: Array
    variance: Array
    located: Mask


@dataclass(frozen=True, eq=False)
class Pair:
    """Two consecutive frames, k - 1 and k.

    Args:
        frame: a of frame k - 1, b of frame k, weights 1 / variance up to the flight's common factor.
        uv_a, uv_b: (n, 2) pixels of the points in ``frame``.
        rejected: (m, 4) pixels u, v, u, v of gated matches.
        matches: unique mutual matches, of which ``frame`` keeps those located and not gated.
        R, t, q: the true pose.
    """

    frame: Frame
    uv_a: Array
    uv_b: Array
    rejected: Array
    matches: int
    variance: Array
    R: Array
    t: Array
    q: Array


@dataclass(frozen=True, eq=False)
class Flight:
    """What the sensors saw on the way down.

    Args:
        sigma: standard deviation per axis of one cloud's point at unit weight, m, the same for a and b.
    """

    terrain: Terrain
    trajectory: Trajectory
    images: str
    view: View
    lidar: Lidar
    seed: int
    exposures: list[Exposure]
    pairs: list[Pair]
    sigma: float


class Simulator:
    """Sensors on a terrain. Every random number comes from ``seed`` and the frame's index."""

    def __init__(self, terrain: Terrain, frames: int, images: str = "camera", seed: int = 1) -> None:
        if images not in IMAGE_SOURCES:
            raise InputError(f"images: {images!r} is none of {', '.join(IMAGE_SOURCES)}")
        if frames < 2:
            raise InputError(f"frames: {frames} is too few; a relative pose needs two")
        self.terrain, self.images, self.seed = terrain, images, seed
        self.trajectory = approach(terrain, frames)
        pinhole = Pinhole()
        self.lidar = Lidar(pinhole, LIDAR_MOUNTING)
        self.camera = Camera(pinhole, CAMERA_MOUNTING) if images == "camera" else None
        # a bearing-angle image is the scan's own grid, so it sits where the LiDAR sits
        self.view = (
            View(pinhole, CAMERA_MOUNTING, CAMERA_SIGMA)
            if self.camera
            else View(pinhole, LIDAR_MOUNTING, BEARING_SIGMA)
        )
        self._caster = RayCaster(terrain)
        self._ground = Ground(terrain, seed)

    def expose(self, k: int, pose: BodyPose) -> Exposure:
        """Frame k: scan, image, features and where on the ground they are."""
        rng = np.random.default_rng([self.seed, 2, k])
        ranges = self.lidar.scan(self._caster, pose, rng)
        if self.camera:
            image = self.camera.image(self._caster, self._ground, pose, rng)
        else:
            image = bearing_angle_image(self.lidar, ranges)
        features = detect(image, FEATURE_LIMIT)
        surface = surface_of(self.lidar, ranges)
        points, variance, located = locate(self.view, self.lidar.mounting, surface, features.uv)
        return Exposure(pose, image, ranges, features, points, variance, located)

    def pair(self, k: int, before: Exposure, after: Exposure) -> Pair:
        """The matched points of frames k - 1 and k.

        Raises:
            InputError: fewer than three matches: no pose would be determined.
        """
        chosen = match(before.features, after.features)
        i, j = chosen[before.located[chosen[:, 0]] & after.located[chosen[:, 1]]].T
        if len(i) < FEWEST:
            raise InputError(
                f"{self.terrain.name}: frames {k - 1} and {k}: only {len(i)} matched features with a range,"
                f" a pose needs {FEWEST}"
            )
        a, b, variance = before.points[i], after.points[j], before.variance[i] + after.variance[j]
        kept = gate(a, b, variance, np.random.default_rng([self.seed, 3, k]))
        uv_a, uv_b = before.features.uv[i], after.features.uv[j]
        rotation, translation = relative_pose(before.pose, after.pose)
        return Pair(
            frame=Frame(k, a[kept], b[kept]),
            uv_a=uv_a[kept],
            uv_b=uv_b[kept],
            rejected=np.hstack([uv_a, uv_b])[~kept],
            matches=len(chosen),
            variance=variance[kept],
            R=rotation,
            t=translation,
            q=crp_of(rotation),
        )

    def fly(self) -> Iterator[tuple[Exposure, Pair | None]]:
        """Frame by frame: the exposure, and its pair with the one before (none for the first)."""
        before: Exposure | None = None
        for k, pose in enumerate(self.trajectory.poses()):
            after = self.expose(k, pose)
            yield after, self.pair(k, before, after) if before else None
            before = after

    def collect(self, flown: list[tuple[Exposure, Pair | None]]) -> Flight:
        """The flight, its weights scaled by one factor to integers that the core takes as they are."""
        pairs = [pair for _, pair in flown if pair is not None]
        smallest = min(float(pair.variance.min()) for pair in pairs)
        weighted = [
            replace(pair, frame=replace(pair.frame, w=_integer_weights(pair.variance, smallest)))
            for pair in pairs
        ]
        # weight * variance is the same for every point; a and b have half each
        sigma = float(np.sqrt(LARGEST_WEIGHT * smallest / 2.0))
        return Flight(
            self.terrain, self.trajectory, self.images, self.view, self.lidar, self.seed,
            [exposure for exposure, _ in flown], weighted, sigma,
        )  # fmt: skip


def _integer_weights(variance: Array, smallest: float) -> Array:
    return np.maximum(np.rint(LARGEST_WEIGHT * smallest / variance), 1.0)
