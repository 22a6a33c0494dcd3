# SPDX-License-Identifier: Apache-2.0
"""The low-rate camera: the plate's pose from matched points, and the projections rho from that pose.

The camera sees fiducials whose places on the plate are known; the OLTAE core makes the pose b = R a + t of
them (a: plate, b: sensor). Each beam then meets the plane that this pose puts the plate in. Between images
the pose is carried on with the rates of the frames before.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ..attitude import FloatArray
from ..frames import Frame
from .beacons import Beacons
from .phase import Sample


@dataclass(frozen=True)
class Camera:
    """every: frames between images; fiducials: points on the plate; noise: m, one axis of one point.

    size: half the side of the plate's square, m.
    """

    every: int = 10
    fiducials: int = 12
    noise: float = 5e-4
    size: float = 1.0

    def pattern(self) -> FloatArray:
        """Places a (n, 3) of the fiducials on the plate, m: two rings, so that no three lie on a line."""
        angles = 2.0 * np.pi * np.arange(self.fiducials) / self.fiducials
        radii = np.where(np.arange(self.fiducials) % 2, 0.6, 1.0) * self.size
        return np.column_stack((radii * np.cos(angles), radii * np.sin(angles), np.zeros_like(angles)))

    def photograph(self, sample: Sample, rng: np.random.Generator) -> Frame:
        """Matched points of one image: a exact, b with noise."""
        a = self.pattern()
        noise = self.noise * rng.normal(size=a.shape)
        b = a @ about_z(sample.angle).T + [0.0, 0.0, sample.distance] + noise
        return Frame(sample.frame.name, a, b)


@dataclass(frozen=True, eq=False)
class PlatePose:
    """Plate to sensor: R (3, 3), t (3,) m, the plate's centre."""

    R: FloatArray
    t: FloatArray

    def displacements(self, beacons: Beacons) -> FloatArray:
        """rho (n, 3) m: where each beam meets the plate's plane, from its centre, in the sensor's axes."""
        normal = self.R[:, 2]
        ranges = (self.t - beacons.origins) @ normal / (beacons.unit @ normal)
        found: FloatArray = beacons.origins + ranges[:, None] * beacons.unit - self.t
        return found

    def moved(self, v: FloatArray, omega: FloatArray, time: float) -> PlatePose:
        """The pose after a time in s at constant rates (m/s, rad/s, sensor axes)."""
        return PlatePose(rotation(omega * time) @ self.R, self.t + v * time)


def about_z(angle: float) -> FloatArray:
    """Rotation (3, 3) by angle, rad, counter-clockwise about z."""
    return rotation(np.array([0.0, 0.0, angle]))


def rotation(vector: FloatArray) -> FloatArray:
    """Rotation (3, 3) about a vector (3,) by its length, rad (Rodrigues)."""
    angle = float(np.linalg.norm(vector))
    if angle == 0.0:
        return np.eye(3)
    x, y, z = vector / angle
    cross = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    turned: FloatArray = np.eye(3) + np.sin(angle) * cross + (1.0 - np.cos(angle)) * (cross @ cross)
    return turned


def image_indices(samples: Sequence[Sample], camera: Camera) -> list[int]:
    """Frames at which the camera takes an image."""
    return list(range(0, len(samples), camera.every))
