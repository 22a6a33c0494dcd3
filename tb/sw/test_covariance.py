# SPDX-License-Identifier: Apache-2.0
"""Covariances: their signs, that their two forms agree, and that they predict the errors."""

from __future__ import annotations

import numpy as np
import pytest
from relnav import golden
from relnav.attitude import FloatArray, cayley, rotation_of


def small_rotation(rotation: FloatArray) -> FloatArray:
    """theta of exp([theta x]), for small theta."""
    d = (rotation - rotation.T) / 2
    return np.array([d[2, 1], d[0, 2], d[1, 0]])


@pytest.mark.parametrize("degrees", [1.0, 60.0, 120.0, 150.0])
def test_signs_of_the_jacobians(degrees: float) -> None:
    rng = np.random.default_rng(int(degrees))
    axis = rng.normal(size=3)
    q = axis / np.linalg.norm(axis) * np.tan(np.radians(degrees) / 2)
    dq = 1e-7 * rng.normal(size=3)
    theta = small_rotation(cayley(q) @ cayley(q + dq).T)  # R true = exp([theta x]) R estimated
    size = np.abs(theta).max()
    np.testing.assert_allclose(golden.attitude_jacobian(q) @ dq, theta, atol=2e-6 * size)
    np.testing.assert_allclose(golden.gibbs_jacobian(q) @ theta, dq, atol=2e-6 * np.abs(dq).max())
    np.testing.assert_allclose(golden.gibbs_jacobian(q) @ golden.attitude_jacobian(q), np.eye(3), atol=1e-14)


def attitude_of(degrees: float, *, forbid_turns: bool) -> tuple[golden.Moments, golden.Attitude]:
    rng = np.random.default_rng(5)
    axis = rng.normal(size=3)
    half = np.radians(degrees) / 2
    rotation = rotation_of(np.cos(half), np.sin(half) * axis / np.linalg.norm(axis))
    a = rng.normal(size=(25, 3)) + [1.0, -2.0, 0.5]
    m = golden.moments(a, a @ rotation.T, rng.uniform(1.0, 200.0, 25))
    return m, golden.solve_moments(m, forbid_turns)


@pytest.mark.parametrize("degrees", [1.0, 60.0, 120.0, 170.0])
@pytest.mark.parametrize("forbid_turns", [False, True])
def test_both_forms_agree(degrees: float, forbid_turns: bool) -> None:
    """Through theta and through q; and, without a turn, L P L^T gives back what G was given."""
    m, attitude = attitude_of(degrees, forbid_turns=forbid_turns)
    p_theta = golden.attitude_covariance(attitude, 0.01)
    q = attitude.vector / attitude.scalar
    jacobian = golden.gibbs_jacobian(q)
    q_cov = jacobian @ p_theta @ jacobian.T
    direct = golden.translation_covariance(p_theta, attitude.rotation @ m.mean_a, 0.01, m.weight)
    for covariance, gibbs, mean in (
        (q_cov, q, m.mean_a),
        (
            golden.gibbs_covariance(attitude.matrix, attitude.q_turned, 0.01),
            attitude.q_turned,
            attitude.turned.mean_a,
        ),
    ):
        through_q = golden.translation_covariance_gibbs(covariance, gibbs, mean, 0.01, m.weight)
        np.testing.assert_allclose(through_q, direct, rtol=1e-9, atol=1e-12 * np.abs(direct).max())
    if attitude.turn == 0:
        np.testing.assert_allclose(q_cov, golden.gibbs_covariance(attitude.matrix, q, 0.01), rtol=1e-9)


@pytest.mark.parametrize("given", [True, False], ids=["sigma", "rss"])
@pytest.mark.parametrize(
    ("degrees", "reapplied"), [(1.0, False), (60.0, False), (120.0, False), (120.0, True), (175.0, False)]
)
def test_predicted_covariance_is_the_scatter(degrees: float, reapplied: bool, given: bool) -> None:
    """Weights over 2^8. dq^T P^-1 dq has mean 3 and, of 500 trials, a standard error of 3.7 %; likewise t."""
    rng = np.random.default_rng(6)
    trials, n, sigma = 500, 40, 2e-4
    axis = rng.normal(size=3)
    half = np.radians(degrees) / 2
    rotation = rotation_of(np.cos(half), np.sin(half) * axis / np.linalg.norm(axis))
    a, t, w = rng.normal(size=(n, 3)) + 0.5, rng.normal(size=3), 2.0 ** rng.uniform(0.0, 8.0, n)
    b = golden.transform(a, rotation, t)
    variance = 5.0 * sigma**2  # sigma_b = 2 sigma_a
    chi = np.zeros(3)
    for _ in range(trials):
        noise = rng.normal(size=(2, n, 3)) * sigma / np.sqrt(w)[:, None]
        result = golden.estimate(
            a + noise[0], b + 2 * noise[1], w, variance=variance if given else 0.0, reapplied=reapplied
        )
        assert (
            result.R is not None
            and result.t is not None
            and result.q_cov is not None
            and result.q is not None
        )
        assert result.t_cov is not None and result.rss is not None
        dq = golden.gibbs_jacobian(result.q) @ small_rotation(rotation @ result.R.T)
        dt = result.t - t
        scatter = dq @ np.linalg.solve(result.q_cov, dq), dt @ np.linalg.solve(result.t_cov, dt)
        chi += np.array([*scatter, result.rss])
    np.testing.assert_allclose(chi[:2] / (3 * trials), 1.0, atol=0.13)
    # rss / (3n - 6) is the unit variance: of Wahba's optimum exactly, of Eq. 25 up to the order of 1 / n.
    assert chi[2] / trials / (3 * n - 6) == pytest.approx(variance, rel=0.03)
