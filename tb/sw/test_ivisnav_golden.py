# SPDX-License-Identifier: Apache-2.0
"""iVisNav's models: normal equations, QR and rational arithmetic agree; flags; covariance is the errors'."""

from __future__ import annotations

from fractions import Fraction

import numpy as np
import pytest
from relnav.attitude import FloatArray
from relnav.ivisnav import exact, golden, paper_fixed
from relnav.ivisnav.beacons import (
    Beacons,
    alternate_ring,
    radial_ring,
    same_handed_ring,
    table_ii,
    turned_ring,
)
from relnav.ivisnav.quantise import Equations, equations, metres_per_second, quantise_equations
from relnav.ivisnav.rows import RateFrame, make_rate_frame

F0, DT = 20e6, 0.01
FACTOR = metres_per_second(F0, DT)


def observed(beacons: Beacons, distance: float, x: FloatArray, noise: FloatArray | float = 0.0) -> RateFrame:
    y = beacons.matrix(distance) @ x
    return make_rate_frame(beacons.directions, beacons.displacements(distance), (y + noise) / FACTOR)


def random_equations(seed: int, n: int, w: bool = True) -> Equations:
    rng = np.random.default_rng(seed)
    weights = rng.integers(1, 9, n) if w else None
    frame = make_rate_frame(
        rng.normal(size=(n, 3)), rng.normal(size=(n, 3)), rng.normal(size=n) / 99, weights
    )
    return equations(frame, F0, DT)


@pytest.mark.parametrize("n", [6, 7, 40])
def test_three_ways_agree(n: int) -> None:
    for seed in range(5):
        e = random_equations(seed, n)
        by_qr, by_normal, rational = (
            golden.orthogonal(e),
            golden.normal_equations(e),
            exact.solve(quantise_equations(e)),
        )
        cond = golden.condition(e)
        size = np.abs(by_qr.x).max()
        np.testing.assert_allclose(by_normal.x, by_qr.x, atol=1e-15 * cond**2 * size)
        np.testing.assert_allclose(rational.floats(), by_qr.x, atol=1e-8 * cond * size)
        inverse = np.array([[float(value) for value in row] for row in rational.inverse])
        np.testing.assert_allclose(inverse, by_qr.inverse, atol=1e-7 * cond * np.abs(inverse).max())
        assert float(rational.rss) == pytest.approx(by_qr.rss, rel=1e-6, abs=1e-12)


def test_exact_solution_solves_the_integers() -> None:
    e = random_equations(9, 7)
    rows = quantise_equations(e)
    found = exact.solve(rows)
    g = exact.moments(rows)
    x = [value * Fraction(2) ** (rows.frac_y - rows.frac_h) for value in found.x]
    assert [sum(g[i][j] * x[j] for j in range(6)) for i in range(6)] == [g[i][6] for i in range(6)]
    scale = Fraction(2) ** (-2 * rows.frac_h)
    for i in range(6):
        row = [sum(g[i][k] * scale * found.inverse[k][j] for k in range(6)) for j in range(6)]
        assert row == [int(i == j) for j in range(6)]
    residuals = [
        int(y) - sum(int(h) * v for h, v in zip(row, x, strict=True))
        for row, y in zip(rows.h, rows.y, strict=True)
    ]
    rss = sum(int(w) * r * r for w, r in zip(rows.w, residuals, strict=True))
    assert rss * Fraction(2) ** (-2 * rows.frac_y) == found.rss


def test_exactly_singular() -> None:
    frame = make_rate_frame(np.eye(3)[[0, 1, 2, 0, 1, 2]], np.zeros((6, 3)), np.zeros(6))
    with pytest.raises(exact.Singular):
        exact.solve(quantise_equations(equations(frame, F0, DT)))


def test_pivots_are_exchanged() -> None:
    # r . e_x is zero in every row but two of equal and opposite p: A stays regular without a good order
    e = random_equations(11, 6)
    h = e.h.copy()
    h[:, 0] = [0, 0, 0, 0, 0, 1e-3]
    changed = Equations(h, e.y, e.w, 1.0, e.frame)
    found = exact.solve(quantise_equations(changed)).floats()
    np.testing.assert_allclose(found, golden.orthogonal(changed).x, rtol=1e-3)


def test_rates_come_back() -> None:
    x = np.array([0.1, -0.2, 0.3, 0.4, 0.5, -0.6])
    for n in (6, 8, 12):
        result = golden.estimate(equations(observed(alternate_ring(0.5, count=n), 2.0, x), F0, DT))
        assert result.flags == () and result.v is not None and result.omega is not None
        np.testing.assert_allclose(np.concatenate((result.v, result.omega)), x, rtol=1e-12)
        assert result.cycles is None and result.n == n


def test_flags() -> None:
    x = np.zeros(6)
    good = observed(alternate_ring(0.5), 2.0, x)
    for frame, flag in (
        (make_rate_frame(good.r[:5], good.p[:5], good.dphi[:5]), "FEW_ROWS"),
        (make_rate_frame(np.zeros((0, 3)), np.zeros((0, 3)), []), "FEW_ROWS"),
        (make_rate_frame(good.r, good.p, good.dphi, np.zeros(6)), "ZERO_WEIGHT"),
        (make_rate_frame(good.r, good.p, good.dphi, [1, 1, 1, 1, 1, 0]), "RANK_DEFICIENT"),
        (observed(table_ii(), 2.0, x), "RANK_DEFICIENT"),
        (observed(radial_ring(0.5), 2.0, x), "RANK_DEFICIENT"),
        (observed(same_handed_ring(0.5), 2.0, x), "ILL_CONDITIONED"),
        (observed(turned_ring(0.15), 5.0, x), "ILL_CONDITIONED"),
    ):
        result = golden.estimate(equations(frame, F0, DT))
        assert result.flags == (flag,) and result.failed
        assert result.v is result.omega is result.cov is result.rss is None
        assert (result.condition is not None) == (flag == "ILL_CONDITIONED")
    many = make_rate_frame(*(np.ones((65536, 3)),) * 2, np.zeros(65536))
    assert golden.estimate(equations(many, F0, DT)).flags == ("TOO_LONG",)


def test_covariance_is_the_errors() -> None:
    rng = np.random.default_rng(1)
    beacons, sigma = alternate_ring(0.5, count=12), 1e-3
    x = np.array([0, 0, 0.1, 0, 0, 0.2])
    errors, given, estimated = [], None, []
    for _ in range(3000):
        e = equations(observed(beacons, 1.5, x, sigma * rng.normal(size=12)), F0, DT)
        result = golden.estimate(e, variance=sigma**2)
        assert result.v is not None and result.omega is not None and result.cov is not None
        errors.append(np.concatenate((result.v, result.omega)) - x)
        given = result.cov
        unscaled = golden.estimate(e).cov
        assert unscaled is not None
        estimated.append(unscaled)
    assert given is not None
    np.testing.assert_allclose(
        np.sqrt(np.diag(np.cov(np.array(errors).T))), np.sqrt(np.diag(given)), rtol=0.05
    )
    np.testing.assert_allclose(np.diag(np.mean(estimated, axis=0)), np.diag(given), rtol=0.05)


def test_no_degrees_of_freedom_no_covariance() -> None:
    result = golden.estimate(equations(observed(alternate_ring(0.5), 2.0, np.ones(6)), F0, DT))
    assert result.cov is None and result.to_json()["cov"] is None
    assert result.to_json()["rss"] == pytest.approx(0.0, abs=1e-25)


def test_weights_and_their_covariance_say_the_same() -> None:
    rng = np.random.default_rng(2)
    beacons = alternate_ring(0.5, count=8)
    frame = observed(beacons, 2.0, np.ones(6), 1e-3 * rng.normal(size=8))
    weights = np.array([1.0, 2, 4, 8, 1, 2, 4, 8])
    sigma = 1e-5  # rad at unit weight
    weighted = make_rate_frame(frame.r, frame.p, frame.dphi, weights)
    whitened = make_rate_frame(frame.r, frame.p, frame.dphi, sigma=np.diag(sigma**2 / weights))
    variance = (FACTOR * sigma) ** 2
    one = golden.estimate(equations(weighted, F0, DT), variance=variance)
    two = golden.estimate(equations(whitened, F0, DT), variance=1.0)
    assert one.v is not None and two.v is not None and one.cov is not None and two.cov is not None
    np.testing.assert_allclose(two.v, one.v, rtol=1e-11)
    np.testing.assert_allclose(two.cov, one.cov, rtol=1e-9, atol=1e-18)
    assert one.rss is not None and two.rss == pytest.approx(one.rss / variance, rel=1e-9)
    assert two.condition == pytest.approx(one.condition, rel=1e-9)


RADII, DISTANCES = (0.15, 0.5, 1.0), (1.0, 2.0, 5.0)


@pytest.mark.parametrize(
    ("ring", "low", "high"),
    [
        (alternate_ring, 5.8, 49),
        (turned_ring, 31, 2430),
        (same_handed_ring, 8e3, 7e5),
        (radial_ring, 1e14, np.inf),
    ],
)
def test_conditions_of_the_rings(ring: object, low: float, high: float) -> None:
    """cond(H) of every parameter set, as its description has it."""
    assert callable(ring)
    found = [np.linalg.cond(ring(radius).matrix(distance)) for radius in RADII for distance in DISTANCES]
    assert low <= min(found) and max(found) <= high
    ranks = {int(np.linalg.matrix_rank(ring(radius).matrix(2.0), tol=1e-9)) for radius in RADII}
    assert ranks == ({5} if ring is radial_ring else {6})


def test_table_ii_has_rank_3() -> None:
    for distance in DISTANCES:
        for normalised in (False, True):
            matrix = table_ii(normalised).matrix(distance)
            assert np.linalg.matrix_rank(matrix, tol=1e-9) == 3
    norms = np.linalg.norm(table_ii(False).directions, axis=1)
    assert norms.min() == pytest.approx(0.966, abs=1e-3) and norms.max() == pytest.approx(1.036, abs=1e-3)
    assert np.linalg.norm(table_ii().directions, axis=1) == pytest.approx(1.0)


# ---- the paper's arithmetic


def test_the_papers_arithmetic() -> None:
    """A phase in Q15.16 is lost; scaled by 2^10 it leaves a few percent; the order alone costs little."""
    rng = np.random.default_rng(3)
    beacons = alternate_ring(0.5)
    errors: dict[float, list[FloatArray]] = {1.0: [], 1024.0: []}
    ours = []
    for _ in range(10):
        x = np.array([0, 0, rng.uniform(0.05, 0.2), 0, 0, rng.uniform(0.05, 0.3)])
        frame = observed(beacons, 2.0, x)
        for scale, found in errors.items():
            result = paper_fixed.solve(frame, F0, DT, scale)
            assert result.x is not None and not result.overflow
            found.append(np.abs(result.x[[2, 5]] / x[[2, 5]] - 1))
        rows = quantise_equations(equations(frame, F0, DT))
        explicit = paper_fixed.explicit_inverse(rows)
        ours.append(np.abs(explicit[[2, 5]] / exact.solve(rows).floats()[[2, 5]] - 1))
    assert np.max(errors[1.0]) > 0.95 and np.max(errors[1024.0]) < 0.03
    assert np.max(ours) < 6e-6


def test_the_papers_inverse() -> None:
    rng = np.random.default_rng(4)
    root = rng.normal(size=(8, 6))
    a = (root.T @ root).astype(np.float32)
    inverse = paper_fixed.invert(a)
    assert inverse is not None and inverse.dtype == np.float32
    np.testing.assert_allclose(inverse @ a.astype(float), np.eye(6), atol=1e-4)
    assert paper_fixed.invert(np.zeros((6, 6), np.float32)) is None


def test_overflow_and_weights_of_the_paper() -> None:
    frame = observed(alternate_ring(0.5), 2.0, np.ones(6))
    assert paper_fixed.solve(frame, F0, DT, 2.0**22).overflow
    weighted = make_rate_frame(frame.r, frame.p, frame.dphi, [2.0] * 6)
    one, two = paper_fixed.solve(frame, F0, DT, 1024.0).x, paper_fixed.solve(weighted, F0, DT, 1024.0).x
    assert one is not None and two is not None and np.array_equal(one, two)
    assert paper_fixed.solve(observed(table_ii(), 1.0, np.ones(6)), F0, DT, 1.0).scale == 1.0
