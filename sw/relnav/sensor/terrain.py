# SPDX-License-Identifier: Apache-2.0
"""Elevation grids: reading them, and the triangle mesh made of them."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..errors import InputError

Array = NDArray[np.float64]

EARTH_METRES_PER_DEGREE = 111_195.0  # mean sphere, 6371.0 km
DEFAULT_NAME = "jacksboro_fault_dem.npz"


@dataclass(frozen=True, eq=False)
class Terrain:
    """A height field z(x, y) in metres, z up; NaN where nothing is known.

    Args:
        name: short name for titles.
        x: (nx,) m, rising.
        y: (ny,) m, rising.
        z: (ny, nx) m.
    """

    name: str
    x: Array
    y: Array
    z: Array

    @property
    def span(self) -> float:
        """The shorter side of the grid, m."""
        return float(min(self.x[-1] - self.x[0], self.y[-1] - self.y[0]))

    @property
    def spacing(self) -> float:
        """Mean distance of neighbouring posts, m."""
        return float(0.5 * (np.diff(self.x).mean() + np.diff(self.y).mean()))

    @property
    def centre(self) -> Array:
        """(2,) m, the middle of the grid."""
        return np.array([self.x[0] + self.x[-1], self.y[0] + self.y[-1]]) / 2.0

    def highest_within(self, radius: float) -> float:
        """The highest point, m, of the square of half-width ``radius`` about the centre."""
        column = np.abs(self.x - self.centre[0]) <= radius
        row = np.abs(self.y - self.centre[1]) <= radius
        patch = self.z[np.ix_(row, column)]
        return float(np.nanmax(patch if np.isfinite(patch).any() else self.z))

    def index_of(self, xy: Array) -> tuple[Array, Array]:
        """Fractional (column, row) of points (..., 2) m; clipped to the grid, as the axes may be uneven."""
        column: Array = np.interp(xy[..., 0], self.x, np.arange(self.x.size, dtype=float))
        row: Array = np.interp(xy[..., 1], self.y, np.arange(self.y.size, dtype=float))
        return column, row

    @cached_property
    def slope(self) -> tuple[Array, Array]:
        """dz/dx and dz/dy, (ny, nx) each; 0 where unknown."""
        dz_dy, dz_dx = np.gradient(self.z, self.y, self.x)
        return np.asarray(np.nan_to_num(dz_dx)), np.asarray(np.nan_to_num(dz_dy))

    def mesh(self) -> tuple[Array, NDArray[np.int64]]:
        """Vertices (m, 3) m and triangles (f, 3), two a cell; cells that touch a NaN are left out."""
        rows, columns = self.z.shape
        xx, yy = np.meshgrid(self.x, self.y)
        vertices = np.column_stack([xx.ravel(), yy.ravel(), self.z.ravel()])
        index = np.arange(rows * columns).reshape(rows, columns)
        a, b, c, d = (index[:-1, :-1], index[:-1, 1:], index[1:, 1:], index[1:, :-1])
        faces = np.concatenate(
            [np.stack(corner, axis=-1).reshape(-1, 3) for corner in ((a, b, c), (a, c, d))]
        )
        known = np.isfinite(vertices[:, 2])
        faces = faces[known[faces].all(axis=1)]
        new_index = np.cumsum(known) - 1
        return vertices[known], new_index[faces]


def load_terrain(path: Path | None = None) -> Terrain:
    """Read an elevation grid; without a path, the elevation data that matplotlib's wheel carries.

    Accepted .npz contents: ``x_km, y_km, z_km``; ``x, y, z`` (m); ``elevation, dx, dy`` (m, row 0 is
    the north edge); the same with ``xmin, xmax, ymin, ymax`` in degrees. z is (len(y), len(x)).

    Raises:
        InputError: one line, when the file cannot be read or is no such grid.
    """
    if path is None:
        import matplotlib.cbook as cbook

        path = Path(str(cbook.get_sample_data(DEFAULT_NAME, asfileobj=False)))
    arrays = _read_npz(path)
    try:
        x, y, z = _axes(arrays)
    except TypeError as error:
        raise InputError(f"{path}: no terrain: {error}") from None
    except KeyError as missing:
        raise InputError(
            f"{path}: no terrain: array {missing} is missing (has {', '.join(sorted(arrays)) or 'nothing'})"
        ) from None
    return _checked(path, x, y, z)


def _read_npz(path: Path) -> dict[str, NDArray[Any]]:
    if not path.is_file():
        raise InputError(f"{path}: no such terrain file")
    try:
        loaded = np.load(path, allow_pickle=False)
        if isinstance(loaded, np.ndarray):
            raise InputError(f"{path}: a single array; a terrain is an .npz with named arrays")
        with loaded:
            return {key: loaded[key] for key in loaded.files}
    except InputError:
        raise
    except Exception as error:  # a damaged archive raises from zipfile, zlib, struct and numpy alike
        raise InputError(f"{path}: not a readable .npz: {error or type(error).__name__}") from None


def _axes(arrays: dict[str, NDArray[Any]]) -> tuple[NDArray[Any], NDArray[Any], NDArray[Any]]:
    if "z_km" in arrays:
        return arrays["x_km"] * 1e3, arrays["y_km"] * 1e3, arrays["z_km"] * 1e3
    if "z" in arrays:
        return arrays["x"], arrays["y"], arrays["z"]
    z = arrays["elevation"]
    dx, dy = _number(arrays, "dx"), _number(arrays, "dy")
    if z.ndim != 2:
        return np.zeros(0), np.zeros(0), z
    if {"xmin", "xmax", "ymin", "ymax"} <= arrays.keys():
        # degrees: square in angle, so east-west shrinks with the cosine of the latitude
        latitude = np.deg2rad((_number(arrays, "ymin") + _number(arrays, "ymax")) / 2.0)
        dx *= EARTH_METRES_PER_DEGREE * float(np.cos(latitude))
        dy *= EARTH_METRES_PER_DEGREE
    return np.arange(z.shape[1]) * dx, np.arange(z.shape[0]) * dy, z[::-1]


def _number(arrays: dict[str, NDArray[Any]], name: str) -> float:
    if arrays[name].shape != () or not np.issubdtype(arrays[name].dtype, np.number):
        raise TypeError(f"{name} must be a single number")
    return float(arrays[name])


def _checked(path: Path, x: NDArray[Any], y: NDArray[Any], z: NDArray[Any]) -> Terrain:
    if z.ndim != 2 or min(z.shape) < 2:
        raise InputError(f"{path}: heights must be a 2-D grid of at least 2 x 2, not shape {z.shape}")
    if x.shape != (z.shape[1],) or y.shape != (z.shape[0],):
        raise InputError(f"{path}: heights are {z.shape} but the axes y, x have shapes {y.shape}, {x.shape}")
    if not all(np.issubdtype(array.dtype, np.number) and not np.iscomplexobj(array) for array in (x, y, z)):
        raise InputError(f"{path}: terrain arrays must be real numbers")
    x, y, z = x.astype(np.float64), y.astype(np.float64), z.astype(np.float64)
    if x[0] > x[-1]:
        x, z = x[::-1], z[:, ::-1]
    if y[0] > y[-1]:
        y, z = y[::-1], z[::-1]
    if not (np.all(np.diff(x) > 0) and np.all(np.diff(y) > 0)):  # also catches NaN in an axis
        raise InputError(f"{path}: an axis of the terrain is not strictly monotonic")
    z = np.where(np.isfinite(z), z, np.nan)
    if np.isfinite(z).mean() < 0.25:
        raise InputError(f"{path}: less than a quarter of the heights is finite")
    name = path.stem.replace("dem_", "").replace("_dem", "").replace("_", " ")
    return Terrain(name, x, y, np.ascontiguousarray(z))
