# SPDX-License-Identifier: Apache-2.0
"""The golden model against SVD, Davenport, the paper's other forms of the solution, and exact arithmetic."""

from __future__ import annotations

from fractions import Fraction

import numpy as np
import pytest
from relnav import exact, golden, wahba
from relnav.attitude import IDENTITY, TURN_NAMES, FloatArray, cayley, quaternion_of, rotation_of, skew
from relnav.frames import make_frame
from relnav.quantise import quantise

ANGLES = (0.0, 1.0, 60.0, 89.0, 120.0, 150.0, 179.9, 180.0)


def points(
    seed: int, degrees: float, n: int = 30, noise: float = 0.0, offset: float = 0.0
) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray, FloatArray]:
    """a, b, w, R, t."""
    rng = np.random.default_rng(seed)
    axis = rng.normal(size=3)
    axis /= np.linalg.norm(axis)
    half = np.radians(degrees) / 2
    rotation, t = rotation_of(np.cos(half), np.sin(half) * axis), rng.normal(size=3)
    a = rng.normal(size=(n, 3)) + offset * rng.normal(size=3)
    b = golden.transform(a, rotation, t) + noise * rng.normal(size=(n, 3))
    return a, b, rng.integers(1, 256, n).astype(float), rotation, t


@pytest.mark.parametrize("degrees", ANGLES)
@pytest.mark.parametrize("weighted", [False, True])
def test_clean_points_give_the_true_pose_as_svd_and_davenport_do(degrees: float, weighted: bool) -> None:
    a, b, w, rotation, t = points(3, degrees)
    weights = w if weighted else None
    result = golden.estimate(a, b, weights)
    assert result.flags in ((), ("Q_SATURATED",)) and result.R is not None and result.t is not None
    for found, shift in (
        (result.R, result.t),
        wahba.kabsch(a, b, weights),
        wahba.davenport(a, b, weights),
    ):
        np.testing.assert_allclose(found, rotation, atol=5e-14)
        np.testing.assert_allclose(shift, t, atol=5e-14)
    assert result.rss is not None and 0.0 <= result.rss < 1e-24
    assert (result.turn == "none") == (degrees < 90.0)


def test_every_form_of_the_solution_in_the_paper_agrees() -> None:
    a, b, w, _, _ = points(5, 40.0, noise=1e-2)
    a_bar, b_bar = golden.centroids(a, b, w)
    s, y = golden.sums_and_differences(golden.centre(a, a_bar), golden.centre(b, b_bar))
    q = golden.solve(golden.normal_matrix(s, w), golden.normal_vector(s, y, w))
    h = golden.design_matrix(s)
    np.testing.assert_allclose(golden.batch_solution(h, y, w), q, rtol=1e-12)
    together, t = golden.solve_together(a, b, w)
    np.testing.assert_allclose(together, q, rtol=1e-12)
    np.testing.assert_allclose(t, golden.translation(a_bar, b_bar, cayley(q)), rtol=1e-11)
    alpha, beta = 3.0, 0.25
    scaled = golden.scale(s, y, alpha, beta)
    q_scaled = golden.solve(golden.normal_matrix(scaled[0], w), golden.normal_vector(*scaled, w))
    np.testing.assert_allclose(golden.unscale(q_scaled, alpha, beta), q, rtol=1e-12)
    m = golden.moments(a, b, w)
    np.testing.assert_allclose(golden.moment_matrix(m), golden.normal_matrix(s, w), rtol=1e-12)
    np.testing.assert_allclose(golden.moment_vector(m), golden.normal_vector(s, y, w), rtol=1e-11)
    result = golden.estimate(a, b, w)
    assert result.q is not None and result.turn == "none"
    np.testing.assert_allclose(result.q, q, rtol=1e-12)


def test_residual_is_what_equation_25_minimises() -> None:
    a, b, w, _, _ = points(6, 70.0, noise=1e-2)
    q, t = golden.solve_together(a, b, w)
    t_star = (IDENTITY + skew(q)) @ t
    r = golden.residual(a, b, q, t_star)
    np.testing.assert_allclose(
        r, (b - golden.transform(a, cayley(q), t)) @ (IDENTITY + skew(q)).T, atol=1e-13
    )
    gradient = np.concatenate([w @ np.cross(b + a, r), w @ r])
    assert np.abs(gradient).max() < 1e-9


@pytest.mark.parametrize("degrees", ANGLES[1:])
def test_residual_sum_and_cost_agree(degrees: float) -> None:
    a, b, w, _, _ = points(7, degrees, noise=1e-2, offset=3.0)
    result = golden.estimate(a, b, w)
    assert result.R is not None and result.t is not None
    m = golden.moments(a, b, w)
    assert result.rss == pytest.approx(golden.cost(a, b, w, result.R, result.t), rel=1e-10)
    assert result.rss == pytest.approx(golden.residual_sum(m, result.R), rel=1e-8)


@pytest.mark.parametrize("degrees", ANGLES[1:])
def test_reapplied_is_wahbas_optimum(degrees: float) -> None:
    a, b, w, _, _ = points(8, degrees, n=60, noise=5e-2)
    best_rotation, best_t = wahba.kabsch(a, b, w)
    once, twice = golden.estimate(a, b, w), golden.estimate(a, b, w, reapplied=True)
    assert once.R is not None and twice.R is not None and twice.rss is not None and once.rss is not None
    best = golden.cost(a, b, w, best_rotation, best_t)
    assert twice.rss == pytest.approx(best, rel=1e-7)
    assert once.rss >= twice.rss * (1 - 1e-12)
    assert twice.turn == once.turn
    assert np.abs(twice.R - best_rotation).max() < 0.02 * max(np.abs(once.R - best_rotation).max(), 1e-6)


@pytest.mark.parametrize("degrees", ANGLES)
@pytest.mark.parametrize("options", [{}, {"reapply": True}])
@pytest.mark.parametrize("weighted", [False, True])
def test_against_exact_arithmetic(degrees: float, options: dict[str, bool], weighted: bool) -> None:
    a, b, w, _, _ = points(9, degrees, noise=1e-3, offset=100.0)
    quantised = quantise(make_frame(a, b, w if weighted else None))
    values = quantised.values()
    result = golden.estimate(*values, w if weighted else None, reapplied="reapply" in options)
    truth = exact.solve(quantised, **options)
    assert result.R is not None and result.t is not None and result.determinant is not None
    assert result.turn == TURN_NAMES[truth.turn]
    np.testing.assert_allclose(result.R, np.array(truth.R, float), atol=2e-15)
    np.testing.assert_allclose(result.t, np.array(truth.t, float), atol=2e-13)
    assert result.rss == pytest.approx(float(truth.rss), rel=1e-9)
    assert result.determinant == pytest.approx(float(truth.determinant), rel=1e-10)
    assert result.condition is not None and truth.kappa <= result.condition <= 9 * truth.kappa * (1 + 1e-12)
    if truth.q is not None and result.q is not None:
        np.testing.assert_allclose(result.q, np.array(truth.q, float), rtol=1e-9)


def test_exact_solution_is_exact() -> None:
    """A rational rotation of integer points comes back as itself, at 180 degrees too."""
    a = np.array([[1, 2, 3], [-4, 0, 2], [5, -1, 1], [0, 3, -7]])
    cases: tuple[tuple[int, tuple[int, int, int]], ...] = ((3, (1, -2, 1)), (0, (2, -1, 2)), (1, (7, 3, -5)))
    for quaternion in cases:
        rotation = exact.rotation_of(quaternion[0], quaternion[1])
        size = quaternion[0] ** 2 + sum(v * v for v in quaternion[1])
        b = (a @ np.array([[int(x * size) for x in row] for row in rotation]).T) + size * np.array([1, -2, 3])
        frame = quantise(make_frame(a * size, b))
        solution = exact.solve(frame)
        assert rotation == solution.R and solution.rss == 0
        assert solution.t == [size, -2 * size, 3 * size]
        expected = None if quaternion[0] == 0 else [Fraction(v, quaternion[0]) for v in quaternion[1]]
        assert solution.q == expected


def test_exact_kappa() -> None:
    assert exact.kappa([[3, 0, 0], [0, 5, 0], [0, 0, 7]]) == pytest.approx(7 / 3)
    assert exact.kappa([[1, 0, 0], [0, 1, 0], [0, 0, Fraction(1, 10**40)]]) == pytest.approx(1e40)
    assert exact.kappa([[1, 0, 0], [0, 1, 0], [0, 0, 0]]) == np.inf


def test_forbidden_turn_is_the_paper_as_it_stands() -> None:
    a, b, w, rotation, _ = points(11, 150.0)
    result = golden.estimate(a, b, w, forbid_turns=True)
    assert result.turn == "none" and result.R is not None
    np.testing.assert_allclose(result.R, rotation, atol=1e-12)


def test_q_is_none_at_180_and_the_rest_stands() -> None:
    a = np.array([[1.0, 2, 3], [-4, 0, 2], [5, -1, 1], [0, 3, -7]])
    result = golden.estimate(a, a * [-1, -1, 1])
    assert result.q is None and result.q_cov is None and result.t_cov is not None
    assert result.flags == ("Q_SATURATED",) and result.turn == "z"
    assert result.quaternion is not None and result.R is not None
    np.testing.assert_allclose(result.quaternion, [0, 0, 0, 1], atol=1e-15)
    np.testing.assert_allclose(quaternion_of(result.R), result.quaternion)


LINE = np.outer(np.arange(6.0), [1.0, 2.0, -1.0]) + [5.0, 5.0, 5.0]


@pytest.mark.parametrize(
    ("a", "b", "w", "flag"),
    [
        (np.eye(3)[:2], np.eye(3)[:2], None, "FEW_POINTS"),
        (np.zeros((0, 3)), np.zeros((0, 3)), None, "FEW_POINTS"),
        (np.eye(3), np.eye(3), np.zeros(3), "ZERO_WEIGHT"),
        (np.zeros((65536, 3)), np.zeros((65536, 3)), None, "TOO_LONG"),
        (np.ones((5, 3)), np.ones((5, 3)), None, "RANK_DEFICIENT"),
        (np.zeros((5, 3)), np.zeros((5, 3)), None, "RANK_DEFICIENT"),
        (LINE, LINE, None, "RANK_DEFICIENT"),
        (LINE / 3.0, LINE / 3.0 @ cayley(np.array([0.1, 0.2, 0.3])).T, None, "RANK_DEFICIENT"),
        (np.eye(3), np.eye(3), np.array([1.0, 1.0, 0.0]), "RANK_DEFICIENT"),
    ],
)
def test_frames_without_a_pose(a: FloatArray, b: FloatArray, w: FloatArray | None, flag: str) -> None:
    result = golden.estimate(a, b, w)
    assert result.flags == (flag,) and result.failed and result.n == len(a)
    values = result.to_json()
    assert all(values[key] is None for key in ("q", "quaternion", "R", "t", "q_cov", "t_cov", "rss", "turn"))


def test_near_a_line_is_flagged() -> None:
    rng = np.random.default_rng(4)
    a = LINE + 1e-3 * rng.normal(size=LINE.shape)
    result = golden.estimate(a, a)
    assert result.flags == ("ILL_CONDITIONED",) and result.R is not None


def test_units_and_weight_units() -> None:
    """Scaling lengths scales t, rss and t_cov only; scaling weights scales rss, W and det only."""
    a, b, w, _, _ = points(12, 100.0, noise=1e-2)
    base = golden.estimate(a, b, w)
    for length, weight in ((1e20, 1.0), (1e-20, 1.0), (1.0, 1e-200), (1.0, 1e200)):
        other = golden.estimate(a * length, b * length, w * weight)
        for name, factor in (("q", 1.0), ("q_cov", 1.0), ("t", length), ("t_cov", length**2)):
            np.testing.assert_allclose(getattr(other, name), getattr(base, name) * factor, rtol=1e-9)
        assert base.rss is not None and other.rss == pytest.approx(base.rss * length**2 * weight, rel=1e-9)


@pytest.mark.parametrize(
    ("q", "expected", "saturated"),
    [
        ((1.0, -0.5, 2.0**-17 * 1.5), (1.0, -0.5, 2.0**-16), False),
        ((32768.0, 0.0, 0.0), (32768.0 - 2.0**-16, 0.0, 0.0), True),
        ((-32768.0, 0.0, 0.0), (-32768.0, 0.0, 0.0), False),
        ((np.inf, -np.inf, np.nan), (32768.0 - 2.0**-16, -32768.0, 0.0), True),
    ],
)
def test_q_fixed(q: tuple[float, ...], expected: tuple[float, ...], saturated: bool) -> None:
    value, flag = golden.to_q_fixed(np.array(q))
    assert tuple(value) == expected and flag is saturated
