# SPDX-License-Identifier: Apache-2.0
"""Ray casting on the terrain by Embree (trimesh and embreex)."""

from __future__ import annotations

import numpy as np
import trimesh
from numpy.typing import NDArray
from trimesh.ray.ray_pyembree import RayMeshIntersector

from .terrain import Terrain

Array = NDArray[np.float64]


class RayCaster:
    """The terrain's triangles in an Embree scene.

    Embree picks the triangle in single precision; the hit is then recomputed on that triangle's plane in
    double, so ranges carry no rounding of their own.
    """

    def __init__(self, terrain: Terrain) -> None:
        vertices, faces = terrain.mesh()
        self._origin = vertices.mean(axis=0)  # keeps single precision where the terrain is
        corners = (vertices - self._origin)[faces]
        self._corner = corners[:, 0]
        self._normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        mesh = trimesh.Trimesh(vertices - self._origin, faces, process=False)
        self._scene = RayMeshIntersector(mesh)

    def cast(self, origin: Array, directions: Array) -> Array:
        """Distance along each ray, in units of its direction's length; NaN where the sky is hit.

        Args:
            origin: (3,) m, world. directions: (..., 3), world.
        """
        rays = directions.reshape(-1, 3)
        local = origin - self._origin
        triangle = self._scene.intersects_first(np.broadcast_to(local, rays.shape), rays)
        hit = np.flatnonzero(triangle >= 0)
        normal = self._normal[triangle[hit]]
        height = np.einsum("ij,ij->i", self._corner[triangle[hit]] - local, normal)
        with np.errstate(divide="ignore", invalid="ignore"):
            along = height / np.einsum("ij,ij->i", rays[hit], normal)
        distance = np.full(len(rays), np.nan)
        distance[hit] = np.where(np.isfinite(along) & (along > 0), along, np.nan)
        return distance.reshape(directions.shape[:-1])
