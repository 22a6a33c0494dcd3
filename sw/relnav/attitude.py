# SPDX-License-Identifier: Apache-2.0
"""Attitude conversions in the convention of the OLTAE paper.

R = (I + Q)^-1 (I - Q) with Q = [q x] (paper, Eq. 3): a positive q3 turns vectors by a NEGATIVE angle about z.
Quaternions are scalar first and of R itself (v' = R v), so vector / scalar = -q.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

FloatArray = npt.NDArray[np.float64]

IDENTITY: FloatArray = np.eye(3)

# The 180 degree turns about x, y, z as the diagonals of their rotation matrices; index 0 is no turn.
TURN_SIGNS: tuple[tuple[int, int, int], ...] = ((1, 1, 1), (1, -1, -1), (-1, 1, -1), (-1, -1, 1))
TURN_NAMES: tuple[str, ...] = ("none", "x", "y", "z")


def skew(v: FloatArray) -> FloatArray:
    """[v x], (3, 3), of v (3,): skew(v) @ u = v x u (paper, Eq. 4)."""
    x, y, z = v
    return np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])


def cayley(q: FloatArray) -> FloatArray:
    """R (3, 3) of the Gibbs vector q (3,) (paper, Eq. 3), expanded: no inverse is taken."""
    squared = float(q @ q)
    return ((1.0 - squared) * IDENTITY + 2.0 * np.outer(q, q) - 2.0 * skew(q)) / (1.0 + squared)


def rotation_of(scalar: float, vector: FloatArray) -> FloatArray:
    """R (3, 3) of an unnormalised (D, N), q = N / D; D = 0 (180 degrees) is as good as any."""
    size = scalar * scalar + float(vector @ vector)
    left = (scalar * scalar - float(vector @ vector)) * IDENTITY
    return (left + 2.0 * np.outer(vector, vector) - 2.0 * scalar * skew(vector)) / size


def quaternion_of(rotation: FloatArray) -> FloatArray:
    """Unit quaternion (4,), scalar first and never negative, of R (3, 3); sound at 180 degrees.

    The matrix 4 p p^T is linear in R (Shepperd 1978); its longest column is p times a number
    that is never small. An R rounded to binary32 gives p to the same accuracy.
    """
    r = rotation
    x, y, z = r[2, 1] - r[1, 2], r[0, 2] - r[2, 0], r[1, 0] - r[0, 1]
    trace = r[0, 0] + r[1, 1] + r[2, 2]
    outer = np.empty((4, 4))
    outer[0] = 1.0 + trace, x, y, z
    outer[1:, 0] = x, y, z
    outer[1:, 1:] = r + r.T + (1.0 - trace) * IDENTITY
    column = outer[:, int(np.argmax(np.diag(outer)))]
    quaternion: FloatArray = column / np.linalg.norm(column)
    return -quaternion + 0.0 if quaternion[0] < 0 else quaternion + 0.0


def turn_back(turn: int, scalar: float, vector: FloatArray) -> tuple[float, FloatArray]:
    """(D, N) of R' T from (D, N) of R', T the 180 degree turn (1, 2, 3 = x, y, z): a signed permutation."""
    if turn == 0:
        return scalar, vector
    k = turn - 1
    i, j = (k + 1) % 3, (k + 2) % 3
    back = np.empty(3)
    # (0, -e_k) (D, N) = (N_k, -D e_k - e_k x N)
    back[k], back[i], back[j] = -scalar, vector[j], -vector[i]
    return float(vector[k]), back


def angle_of(rotation: FloatArray) -> float:
    """Rotation angle of R (3, 3), radians, 0 to pi."""
    quaternion = quaternion_of(rotation)
    return 2.0 * float(np.arctan2(np.linalg.norm(quaternion[1:]), quaternion[0]))
