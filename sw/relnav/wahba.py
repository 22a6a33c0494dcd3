# SPDX-License-Identifier: Apache-2.0
"""Two known solutions of Wahba's problem, to check OLTAE against: both minimise sum of w |b - R a - t|^2."""

from __future__ import annotations

import numpy as np

from .attitude import IDENTITY, FloatArray, rotation_of
from .golden import centre, centroids, translation


def kabsch(a: FloatArray, b: FloatArray, w: FloatArray | None = None) -> tuple[FloatArray, FloatArray]:
    """(R, t) by the singular value decomposition (Kabsch 1976; Arun et al. 1987). a, b (n, 3), w (n,)."""
    profile, a_bar, b_bar = _profile(a, b, w)
    u, _, vt = np.linalg.svd(profile)
    rotation = u @ np.diag((1.0, 1.0, np.sign(np.linalg.det(u @ vt)))) @ vt
    return rotation, translation(a_bar, b_bar, rotation)


def davenport(a: FloatArray, b: FloatArray, w: FloatArray | None = None) -> tuple[FloatArray, FloatArray]:
    """(R, t) by the q-method (Davenport 1968): the eigenvector of the largest eigenvalue of K (4, 4)."""
    profile, a_bar, b_bar = _profile(a, b, w)
    k = np.empty((4, 4))
    k[:3, :3] = profile + profile.T - np.trace(profile) * IDENTITY
    # Wahba's attitude matrix and the paper's q share one sign: (vector, scalar) of the eigenvector is (N, D).
    k[:3, 3] = k[3, :3] = (
        profile[1, 2] - profile[2, 1],
        profile[2, 0] - profile[0, 2],
        profile[0, 1] - profile[1, 0],
    )
    k[3, 3] = np.trace(profile)
    vector = np.linalg.eigh(k)[1][:, -1]
    rotation = rotation_of(float(vector[3]), vector[:3])
    return rotation, translation(a_bar, b_bar, rotation)


def _profile(a: FloatArray, b: FloatArray, w: FloatArray | None) -> tuple[FloatArray, FloatArray, FloatArray]:
    """sum of w db da^T (3, 3), and the centroids."""
    weights = np.ones(len(a)) if w is None else w
    a_bar, b_bar = centroids(a, b, weights)
    return (centre(b, b_bar) * weights[:, None]).T @ centre(a, a_bar), a_bar, b_bar
