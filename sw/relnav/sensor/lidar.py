# SPDX-License-Identifier: Apache-2.0
"""A scanning LiDAR with the camera's field of view, and the range at a place between its pixels."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .camera import Pinhole
from .mounting import Mounting
from .raycast import RayCaster
from .trajectory import BodyPose

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]


@dataclass(frozen=True, eq=False)
class Lidar:
    """One range a pixel.

    Args:
        range_noise: standard deviation as a share of the range. range_floor: m, added in quadrature.
    """

    pinhole: Pinhole
    mounting: Mounting
    range_noise: float = 1.6e-4
    range_floor: float = 0.05

    def sigma(self, ranges: Array) -> Array:
        """Standard deviation of a measured range, m."""
        return np.hypot(self.range_noise * ranges, self.range_floor)

    def scan(self, caster: RayCaster, body: BodyPose, rng: np.random.Generator) -> Array:
        """Ranges (height, width) m with noise; NaN where nothing returns."""
        rays = self.mounting.directions_to_body(self._unit_rays()) @ body.rotation.T
        ranges = caster.cast(body.to_world(self.mounting.position), rays)
        return ranges + self.sigma(ranges) * rng.standard_normal(ranges.shape)

    def points(self, ranges: Array) -> Array:
        """The scan as points (height, width, 3) m in the body frame."""
        return self.mounting.to_body(ranges[..., None] * self._unit_rays())

    def _unit_rays(self) -> Array:
        rays = self.pinhole.grid()
        return np.asarray(rays / np.linalg.norm(rays, axis=-1, keepdims=True))


@dataclass(frozen=True, eq=False)
class Surface:
    """A scan as a surface that can be asked between its pixels.

    1/depth is interpolated bilinearly, which is exact on a plane.

    Args:
        inverse_depth: (height, width) 1/m along the optical axis; NaN where nothing returned.
        depth_sigma: share of the depth, of one pixel.
    """

    pinhole: Pinhole
    inverse_depth: Array
    depth_sigma: float

    # A cell is torn when its depths differ by more than a slope of this many to one (83 degrees) explains.
    STEEPEST = 8.0

    def at(self, uv: Array) -> tuple[Array, Array, Mask]:
        """Depth (n,) m at pixel coordinates (n, 2), the share of one pixel's variance left by averaging (n,),
        and whether the answer is to be trusted: inside the scan, all four returns there, no jump in depth."""
        rows, columns = self.inverse_depth.shape
        finite = np.isfinite(uv).all(axis=1)
        inside = finite & (uv >= 0).all(axis=1) & (uv[:, 0] <= columns - 1) & (uv[:, 1] <= rows - 1)
        place = np.where(inside[:, None], uv, 0.0)
        corner = np.minimum(place.astype(int), [columns - 2, rows - 2])
        fu, fv = (place - corner).T
        share = np.stack([(1 - fu) * (1 - fv), fu * (1 - fv), (1 - fu) * fv, fu * fv])
        c, r = corner.T
        cell = np.stack([self.inverse_depth[r + dr, c + dc] for dr, dc in ((0, 0), (0, 1), (1, 0), (1, 1))])
        there = inside & np.isfinite(cell).all(axis=0)
        cell = np.where(there, cell, 1.0)
        jump = cell.max(axis=0) / cell.min(axis=0) - 1.0
        smooth = jump <= self.STEEPEST * np.sqrt(2.0) / self.pinhole.focal + 6.0 * self.depth_sigma
        return 1.0 / (share * cell).sum(axis=0), (share**2).sum(axis=0), there & smooth


def surface_of(lidar: Lidar, ranges: Array) -> Surface:
    """The interpolable surface of a scan."""
    length = np.linalg.norm(lidar.pinhole.grid(), axis=-1)
    sigma = float(np.nanmedian(lidar.sigma(ranges) / ranges)) if np.isfinite(ranges).any() else 0.0
    return Surface(lidar.pinhole, length / ranges, sigma)
