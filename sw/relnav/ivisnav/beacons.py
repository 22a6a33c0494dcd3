# SPDX-License-Identifier: Apache-2.0
"""Beacon geometries: where beams start, where they point, where they meet the plate.

Axes of the sensor body: beacons in z = 0, the plate in z = distance, its centre on the z axis (r_c of Eq. 5).
Whether H = [r^, rho x r^] has rank 6 is the geometry's doing alone:

* all beams from one point (Eq. 5 read literally: r_i = r_c + rho_i): rho x r^ = -r_c x r^, rank 3;
* beacons on a ring, their beams in planes through the axis: no beam has a moment about z, rank 5 at most;
* Table II's beams on a ring, all turned the same way: cond(H) beyond 8e3, ill-conditioned;
* the same turned clockwise and counter-clockwise in turn: cond(H) 31 to 2420;
* a regular ring, skewed by +SKEW and -SKEW in turn: cond(H) 5.8 to 49 (each for .15 to 1 m at 1 to 5 m).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..attitude import FloatArray

TABLE_II = np.array(
    [
        [0.87264, 0.4977, 0.1367],
        [0.8927, -0.5082, 0.1304],
        [-0.0007, -0.9915, 0.1372],
        [-0.8586, -0.4957, 0.1391],
        [-0.8168, 0.4957, 0.1412],
        [0.0001, 0.9999, 0.1249],
    ]
)
"""The paper's directions as printed (6, 3): not unit vectors, norms 0.966 to 1.036."""

SKEW = 0.25  # tangential slope of the regular ring
TURN = 0.6  # rad about z, of Table II's beams


@dataclass(frozen=True, eq=False)
class Beacons:
    """Beams as calibrated in the sensor body. origins (n, 3) m; directions (n, 3), z > 0, as given."""

    name: str
    origins: FloatArray
    directions: FloatArray

    @property
    def unit(self) -> FloatArray:
        """r^ (n, 3)."""
        unit: FloatArray = self.directions / np.linalg.norm(self.directions, axis=1, keepdims=True)
        return unit

    def ranges(self, distance: float) -> FloatArray:
        """k (n,) m along each unit direction to the plate z = distance."""
        found: FloatArray = (distance - self.origins[:, 2]) / self.unit[:, 2]
        return found

    def displacements(self, distance: float) -> FloatArray:
        """rho (n, 3) m of the projections from the plate's centre (0, 0, distance), in the body's axes."""
        found: FloatArray = self.origins + self.ranges(distance)[:, None] * self.unit - [0.0, 0.0, distance]
        return found

    def matrix(self, distance: float) -> FloatArray:
        """H (n, 6) of Eq. 8 with unit directions."""
        return np.hstack((self.unit, np.cross(self.displacements(distance), self.unit)))


def table_ii(normalised: bool = True) -> Beacons:
    """Table II from one point, as Eq. 5 has it: rank 3. normalised: directions made unit beforehand."""
    directions = TABLE_II / np.linalg.norm(TABLE_II, axis=1)[:, None] if normalised else TABLE_II.copy()
    name = "Table II, normalised" if normalised else "Table II as printed"
    return Beacons(name, np.zeros((len(TABLE_II), 3)), directions)


def radial_ring(radius: float) -> Beacons:
    """Table II's beams from a ring, each in the plane through its beacon and the axis: rank 5."""
    return _table_ii_ring("radial ring", radius, np.zeros(len(TABLE_II)))


def same_handed_ring(radius: float, turn: float = TURN) -> Beacons:
    """The same, every beam turned about z by turn (rad): v_z and omega_z nearly in one fixed ratio."""
    return _table_ii_ring("same-handed ring", radius, np.full(len(TABLE_II), turn))


def turned_ring(radius: float, turn: float = TURN) -> Beacons:
    """The same, turned by +turn and -turn alternately around the ring."""
    turns = np.empty(len(TABLE_II))
    turns[np.argsort(_azimuths())] = turn * (-1.0) ** np.arange(len(TABLE_II))
    return _table_ii_ring("alternately turned ring", radius, turns)


def alternate_ring(radius: float, skew: float = SKEW, tilt: float = 0.0, count: int = 6) -> Beacons:
    """A regular ring that points ahead, with tangential slopes of +skew and -skew in turn; count even.

    tilt: slope outwards, the same for all.
    """
    angles = 2.0 * np.pi * np.arange(count) / count
    zero = np.zeros(count)
    outwards = np.column_stack((np.cos(angles), np.sin(angles), zero))
    along = np.column_stack((-np.sin(angles), np.cos(angles), zero))
    slopes = skew * (-1.0) ** np.arange(count)
    directions = tilt * outwards + slopes[:, None] * along + [0.0, 0.0, 1.0]
    return Beacons("alternately skewed ring", radius * outwards, directions)


def _azimuths() -> FloatArray:
    azimuths: FloatArray = np.arctan2(TABLE_II[:, 1], TABLE_II[:, 0])
    return azimuths


def _table_ii_ring(name: str, radius: float, turns: FloatArray) -> Beacons:
    at, unit = _azimuths(), table_ii().unit
    across = np.hypot(unit[:, 0], unit[:, 1])
    directions = np.column_stack((across * np.cos(at + turns), across * np.sin(at + turns), unit[:, 2]))
    return Beacons(name, radius * np.column_stack((np.cos(at), np.sin(at), np.zeros_like(at))), directions)
