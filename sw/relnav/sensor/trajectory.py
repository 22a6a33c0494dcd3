# SPDX-License-Identifier: Apache-2.0
"""The approach: translation along two axes, rotation about one, all at constant rates.

Source: OLTAE paper, "Simulation and functional verification" (25 frames at 1 Hz, motion in q3, tx, tz).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .mounting import rotation_about
from .terrain import Terrain

Array = NDArray[np.float64]

NOMINAL_FRAMES = 25


@dataclass(frozen=True, eq=False)
class BodyPose:
    """body -> world: world = rotation @ body + position (m)."""

    rotation: Array
    position: Array

    def to_world(self, points: Array) -> Array:
        """Points (..., 3) m from the body frame to the world frame."""
        return points @ self.rotation.T + self.position


@dataclass(frozen=True, eq=False)
class Trajectory:
    """Constant rates in the body frame, so that t between frames is (-vx dt, 0, -vz dt), the same for all.

    Args:
        start: (3,) m, world.
        velocity: (3,) m/s along the body's axes, y component 0.
        yaw_start: rad. yaw_rate: rad/s about z. dt: s. frames: count.
    """

    start: Array
    velocity: Array
    yaw_start: float
    yaw_rate: float
    dt: float
    frames: int

    def poses(self) -> list[BodyPose]:
        """The body's pose at every frame."""
        poses: list[BodyPose] = []
        position = self.start
        for k in range(self.frames):
            rotation = rotation_about(2, self.yaw_start + k * self.yaw_rate * self.dt)
            if k:
                position = position + rotation @ (self.velocity * self.dt)
            poses.append(BodyPose(rotation, position))
        return poses


def relative_pose(before: BodyPose, after: BodyPose) -> tuple[Array, Array]:
    """R (3, 3) and t (3,) m of b = R a + t (Eq. 1): a in the frame before, b in the frame after."""
    rotation = after.rotation.T @ before.rotation
    return rotation, after.rotation.T @ (before.position - after.position)


def crp_of(rotation: Array) -> Array:
    """q (3,) of R = (I+Q)^-1 (I-Q), Eq. 3: a positive q3 turns vectors by a NEGATIVE angle about z."""
    vector = np.array(
        [
            rotation[1, 2] - rotation[2, 1],
            rotation[2, 0] - rotation[0, 2],
            rotation[0, 1] - rotation[1, 0],
        ]
    )
    return np.asarray(vector / (1.0 + np.trace(rotation)))


def approach(terrain: Terrain, frames: int) -> Trajectory:
    """An approach that fits the terrain: from 30 % to 12 % of its span above the highest ground.

    Rates are those of the nominal 25 frames; a longer flight goes the same way more slowly.
    """
    steps = max(frames, NOMINAL_FRAMES) - 1
    dt = 1.0
    span = terrain.span
    along, down = 0.12 * span, 0.18 * span
    yaw = np.deg2rad(48.0)
    centre = terrain.centre
    start = np.array([centre[0] - along / 2, centre[1], terrain.highest_within(span / 6) + 0.30 * span])
    velocity = np.array([along, 0.0, -down]) / (steps * dt)
    return Trajectory(start, velocity, float(-yaw / 2), float(yaw / (steps * dt)), dt, frames)
