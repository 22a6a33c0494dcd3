# SPDX-License-Identifier: Apache-2.0
"""Where a sensor sits on the spacecraft, and rotations to write it down with."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


def rotation_about(axis: int, angle: float) -> Array:
    """(3, 3) rotation by ``angle`` rad about coordinate axis 0, 1 or 2 (right-handed, turns vectors)."""
    c, s = np.cos(angle), np.sin(angle)
    matrix = np.eye(3)
    i, j = (axis + 1) % 3, (axis + 2) % 3
    matrix[i, i] = matrix[j, j] = c
    matrix[i, j], matrix[j, i] = -s, s
    return matrix


# Sensor frame: x right, y down in the image, z along the optical axis. Body frame: z up.
# Half a turn about x makes the axis look down.
LOOKING_DOWN = rotation_about(0, np.pi)


@dataclass(frozen=True, eq=False)
class Mounting:
    """body = rotation @ sensor + position.

    Args:
        rotation: (3, 3).
        position: (3,) m, of the sensor's origin in the body frame.
    """

    rotation: Array
    position: Array

    def to_body(self, points: Array) -> Array:
        """Points (..., 3) m from the sensor frame to the body frame."""
        return points @ self.rotation.T + self.position

    def from_body(self, points: Array) -> Array:
        """Points (..., 3) m from the body frame to the sensor frame."""
        return (points - self.position) @ self.rotation

    def directions_to_body(self, directions: Array) -> Array:
        """Directions (..., 3) from the sensor frame to the body frame."""
        return directions @ self.rotation.T


def looking_down(position: tuple[float, float, float], tilt_deg: tuple[float, float, float]) -> Mounting:
    """A sensor that looks down the body's -z, up to small mounting angles (deg about x, y, z)."""
    rx, ry, rz = np.deg2rad(tilt_deg)
    tilt = rotation_about(2, rz) @ rotation_about(1, ry) @ rotation_about(0, rx)
    return Mounting(tilt @ LOOKING_DOWN, np.array(position, dtype=np.float64))


# Side by side on one deck, each with its own small error of alignment.
CAMERA_MOUNTING = looking_down((0.60, 0.25, -0.40), (0.4, -0.3, 0.5))
LIDAR_MOUNTING = looking_down((-0.45, -0.30, -0.35), (-0.3, 0.2, -0.6))
