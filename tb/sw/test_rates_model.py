# SPDX-License-Identifier: Apache-2.0
"""The model of the rates engine: its residual against fractions, its results against the exact solution."""

from __future__ import annotations

import random
from dataclasses import replace
from fractions import Fraction

import numpy as np
import numpy.typing as npt
import pytest
from relnav.ivisnav.exact import ExactRates, Singular, solve
from relnav.ivisnav.quantise import QuantisedRows
from relnav.model.rates_engine import EngineResult, RatesEngine
from relnav.model.rates_explicit import explicit_rates
from relnav.model.rates_program import COVARIANCE, SIZE, Term
from relnav.model.rates_residual import ResidualUnit
from relnav.model.rates_scale import FrameScale

from tb.common.vectors import random_value
from tb.ivisnav.normal_equations import Rows, quantised, random_rows

FloatArray = npt.NDArray[np.float64]

RSS = SIZE
COV = SIZE + 1  # first word of the covariance
UPPER = np.triu_indices(SIZE)
SEEDS = range(12)


def word(value: float) -> int:
    return int(np.float32(value).view(np.uint32))


def engine_of(rows: Rows, variance: int) -> RatesEngine:
    sums = rows.sums()
    return RatesEngine(sums.moments, rows.scale(variance), sums.used_count, variance)


def run(rows: Rows, variance: int = 0) -> EngineResult:
    return engine_of(rows, variance).run()


def floats(result: EngineResult) -> FloatArray:
    """The result words, (28,) in the user's units, exact in double."""
    return np.array(result.words, np.uint32).view(np.float32).astype(np.float64)


def exactly(rows: Rows) -> ExactRates:
    return solve(QuantisedRows(rows.h, rows.y, rows.w, rows.frac_h, rows.frac_y))


def condition_of(rows: Rows) -> float:
    """cond of the weighted H."""
    return float(np.linalg.cond(np.sqrt(rows.w)[:, None] * rows.h))


def inverse_of(exact: ExactRates) -> FloatArray:
    """A^-1 (6, 6)."""
    return np.array([[float(value) for value in row] for row in exact.inverse])


def covariance(values: FloatArray) -> FloatArray:
    """(6, 6) of the upper triangle that the engine gives."""
    matrix = np.zeros((SIZE, SIZE))
    matrix[UPPER] = values[COV:]
    return np.triu(matrix) + np.triu(matrix, 1).T


# ---------------------------------------------------------------------- residual


def value_of(rate: np.float32) -> Fraction:
    """What the residual counts: below 2^-33 nothing."""
    return Fraction(float(rate)) if abs(rate) >= 2.0**-33 else Fraction(0)


@pytest.mark.parametrize("seed", SEEDS)
def test_residual_is_that_of_fractions(seed: int) -> None:
    """Every row, rounded once: within half a unit of the last place of the exact sum."""
    rng = random.Random(300 + seed)
    pairs = [(i, j) for i in range(SIZE + 1) for j in range(i, SIZE + 1)]
    moments = {pair: max(random_value(rng, 96), 1 - (1 << 95)) for pair in pairs}
    scale = FrameScale(rng.randint(0, 32), rng.randint(0, 32), rng.randint(1, 32))
    unit = ResidualUnit(moments, scale)
    rates = [np.float32(rng.choice([-1, 1]) * 2.0 ** rng.uniform(-36, 25.99)) for _ in range(SIZE)]
    for place, rate in enumerate(rates):
        unit.load(place, rate)
    assert not unit.overflow
    for row in range(SIZE + 1):
        columns = rng.sample(range(SIZE + 1), SIZE + 1)
        found = [unit.add(Term(row, c, c == columns[0], c == columns[-1])) for c in columns]
        assert found[:-1] == [None] * SIZE and found[-1] is not None
        right = Fraction(2) ** scale.right
        exact = moments[row, SIZE] * right
        for column, rate in enumerate(rates):
            exact -= moments[min(row, column), max(row, column)] * value_of(rate)
        exact *= Fraction(2) ** scale.moment(0, SIZE if row == SIZE else 0)
        assert abs(Fraction(float(found[-1])) - exact) <= Fraction(float(np.spacing(abs(found[-1])))) / 2


# ---------------------------------------------------------------------- rates


@pytest.mark.parametrize("seed", SEEDS)
def test_rates_are_the_exact_ones(seed: int) -> None:
    """Rates to 1e-6 of the largest, the covariance to what binary32 leaves; cond(H) within a factor of 2."""
    rng = random.Random(320 + seed)
    for wanted_condition in (1.5, 10.0, 100.0, 300.0):
        rows = random_rows(rng, wanted_condition, rng.choice([6, 7, 8, 30]), 1e-3)
        condition = condition_of(rows)
        variance = 10.0 ** rng.uniform(-6, 6)
        result, exact = run(rows, word(variance)), exactly(rows)
        assert not (result.rank_deficient or result.ill_conditioned)
        values, x = floats(result), exact.floats()
        assert np.abs(values[:SIZE] - x).max() <= 1e-6 * np.abs(x).max()
        wanted = inverse_of(exact) * float(np.float32(variance))
        deviations = np.sqrt(np.diag(wanted))
        error = (covariance(values) - wanted) / np.outer(deviations, deviations)
        assert np.abs(error).max() <= 1e-6 * condition**2
        estimated = float(np.uint32(result.condition).view(np.float32)) ** 0.5
        assert condition / 2 < estimated < condition * (1 + 1e-7 * condition**2)


@pytest.mark.parametrize("seed", SEEDS)
def test_rss_is_the_exact_one(seed: int) -> None:
    """To 1e-5 of it where the residuals are no smaller than binary32's noise; the covariance follows it."""
    rng = random.Random(340 + seed)
    rows = random_rows(rng, 20.0, rng.choice([8, 12, 30]), 0.1)
    values, exact = floats(run(rows)), exactly(rows)
    rss = float(exact.rss)
    assert abs(values[RSS] - rss) <= 1e-5 * rss
    wanted = inverse_of(exact) * rss / (int((rows.w > 0).sum()) - SIZE)
    deviations = np.sqrt(np.diag(wanted))
    error = (covariance(values) - wanted) / np.outer(deviations, deviations)
    assert np.abs(error).max() <= 1e-3


@pytest.mark.parametrize("seed", SEEDS)
def test_covariance_is_symmetric_and_positive_definite(seed: int) -> None:
    rng = random.Random(360 + seed)
    condition = 10.0 ** rng.uniform(0.2, 2.4)
    rows = random_rows(rng, condition, rng.choice([6, 9, 40]))
    engine = engine_of(rows, word(1.0))
    result = engine.run()
    assert not (result.rank_deficient or result.ill_conditioned)
    full = engine.S[COVARIANCE : COVARIANCE + SIZE].astype(np.float64)  # both triangles, before scaling
    deviations = np.sqrt(np.diag(full))
    correlation = full / np.outer(deviations, deviations)
    assert np.abs(correlation - correlation.T).max() <= 1e-6 * condition
    matrix = covariance(floats(result))
    assert np.all(np.diag(matrix) > 0)
    deviations = np.sqrt(np.diag(matrix))
    assert np.linalg.eigvalsh(matrix / np.outer(deviations, deviations)).min() > 0
    np.linalg.cholesky(matrix)


def moved(values: FloatArray, rate: int, rss: int, cov: int) -> FloatArray:
    """The results times powers of two."""
    powers = np.array([rate] * SIZE + [rss] + [cov] * len(UPPER[0]))
    return values * 2.0**powers


@pytest.mark.parametrize("variance", [0.0, 3.5])
@pytest.mark.parametrize("seed", SEEDS)
def test_powers_of_two_go_through(seed: int, variance: float) -> None:
    """2^k at h, y or all weights, in the integers or in the binary points: nothing but exponents change."""
    rng = random.Random(380 + seed)
    fine = random_rows(rng, 10.0 ** rng.uniform(0.2, 2.4), 9, 1e-3)
    # room above: h and y to 20 bits, weights to 9
    rows = replace(fine, h=fine.h >> 11, y=fine.y >> 11, w=fine.w % 500 + 1)
    base = run(rows, word(variance))
    assert not (base.rank_deficient or base.ill_conditioned)
    values = floats(base)
    k = rng.randint(1, 6)
    estimated = 0 if variance else 1
    # the rss takes y squared and the weights, the inverse h^-2 and 1/weights
    changes = [
        (replace(rows, h=rows.h << k), (-k, 0, -2 * k)),
        (replace(rows, y=rows.y << k), (k, 2 * k, 2 * k * estimated)),
        (replace(rows, w=rows.w << k), (0, k, k * estimated - k)),
        (replace(rows, frac_h=rows.frac_h + k), (k, 0, 2 * k)),
        (replace(rows, frac_y=rows.frac_y - k), (k, 2 * k, 2 * k * estimated)),
    ]
    for changed, powers in changes:
        result = run(changed, word(variance))
        assert np.array_equal(floats(result), moved(values, *powers))
        assert result.condition == base.condition
    if variance:
        doubled = run(rows, word(variance * 2.0**k))
        assert np.array_equal(floats(doubled), moved(values, 0, 0, k))


def equations(p: FloatArray, r: FloatArray) -> FloatArray:
    """Rows [r^; p x r^] of feature points p and vectors r, (n, 3) each."""
    unit = r / np.linalg.norm(r, axis=1)[:, None]
    return np.hstack((unit, np.cross(p, unit)))


def deficient_geometries() -> list[tuple[str, FloatArray]]:
    """Real geometries, and coefficients that leave a rate unseen."""
    g = np.random.default_rng(400)
    p, r = g.normal(size=(20, 3)), g.normal(size=(20, 3))
    along = g.normal(size=3)
    repeated = equations(p[:5], r[:5])
    return [
        ("all sight lines parallel", equations(p, np.tile(along, (20, 1)))),
        ("all sight lines through the origin", equations(p, p)),
        ("all sight lines through one point", equations(p, p - along)),
        ("all points on one line", equations(np.outer(g.normal(size=20), along), r)),
        ("one point", equations(np.tile(along, (20, 1)), r)),
        ("all in one plane", equations(p * [1, 1, 0], r * [1, 1, 0])),
        ("five rows, four times each", np.tile(repeated, (4, 1))),
        ("one column is zero", equations(p, r) * [1, 1, 1, 1, 0, 1]),
        ("two columns alike", equations(p, r)[:, [0, 1, 2, 3, 4, 3]]),
    ]


@pytest.mark.parametrize("seed", range(3))
@pytest.mark.parametrize(("name", "h"), deficient_geometries())
def test_rank_deficient_geometries_are_flagged(name: str, h: FloatArray, seed: int) -> None:
    """Rounding to integers hides the deficiency from exact arithmetic, but not from the engine.

    Where rounding has left a pivot above 2^-22 of its diagonal element, the condition says it.
    """
    rng = np.random.default_rng(410 + seed)
    w = rng.integers(1, 65536, len(h)) if seed else None
    rows = quantised(h * 10.0 ** rng.uniform(-3, 3), h @ rng.normal(size=SIZE), w)
    result = run(rows)
    assert result.rank_deficient or result.ill_conditioned, name
    if "column" in name:
        assert result.rank_deficient, name


def test_exactly_singular_integers_are_flagged() -> None:
    """Where exact arithmetic has no solution the engine has none."""
    rng = random.Random(420)
    for rank in range(SIZE):
        left = np.array([[rng.randint(-50, 50) for _ in range(rank)] for _ in range(10)], np.int64)
        right = np.array([[rng.randint(-50, 50) for _ in range(SIZE)] for _ in range(rank)], np.int64)
        h = left.reshape(10, rank) @ right.reshape(rank, SIZE)
        rows = Rows(h, np.arange(10), np.ones(10, np.int64), 8, 8)
        with pytest.raises(Singular):
            exactly(rows)
        assert run(rows).rank_deficient


def test_ends_of_the_integers() -> None:
    """Rows of 0 and -1, which have no size, and those of 2^31; y likewise; weights 1 and 65535."""
    eye = np.eye(SIZE, dtype=np.int64)
    low, high = -(1 << 31), (1 << 31) - 1
    mixed = np.where(eye == 1, high, low)
    for h in (-eye, eye, low * eye, high * eye, mixed):
        for y in (np.arange(SIZE) - SIZE, np.array([low, high, low, 0, -1, 1]), np.full(SIZE, -1)):
            for weight in (1, 65535):
                rows = Rows(np.vstack((h, h)), np.concatenate((y, y)), np.full(2 * SIZE, weight), 3, 5)
                result, exact = run(rows), exactly(rows)
                assert not (result.rank_deficient or result.ill_conditioned)
                x = exact.floats()
                assert np.abs(floats(result)[:SIZE] - x).max() <= 1e-6 * np.abs(x).max()
                assert floats(result)[RSS] <= 1e-6 * float(abs(rows.y).max()) ** 2 * weight * 4.0**-5


# ---------------------------------------------------------------------- the paper's order of operations


def explicit(rows: Rows) -> tuple[FloatArray, FloatArray]:
    sums = rows.sums()
    x, inverse = explicit_rates(sums.moments, rows.scale(0))
    assert x.dtype == inverse.dtype == np.float32
    return x.astype(np.float64), inverse.astype(np.float64)


@pytest.mark.parametrize("seed", SEEDS)
def test_explicit_rates_are_right_to_binary32(seed: int) -> None:
    """Against numpy in double: some units of the last place times cond(A)."""
    rng = random.Random(440 + seed)
    for wanted_condition in (1.0, 3.0, 30.0):
        rows = random_rows(rng, wanted_condition, rng.choice([6, 9, 30]), 1e-3)
        x, inverse = explicit(rows)
        h, y = np.ldexp(rows.h.astype(float), -rows.frac_h), np.ldexp(rows.y.astype(float), -rows.frac_y)
        a, b = h.T @ (rows.w[:, None] * h), h.T @ (rows.w * y)
        wanted_x, wanted = np.linalg.solve(a, b), np.linalg.inv(a)
        bound = 8 * 2.0**-24 * float(np.linalg.cond(a))
        assert np.linalg.norm(x - wanted_x) <= bound * np.linalg.norm(wanted_x)
        assert np.linalg.norm(inverse - wanted) <= bound * np.linalg.norm(wanted)


@pytest.mark.parametrize("seed", SEEDS)
def test_explicit_rates_are_never_better_than_the_engine(seed: int) -> None:
    """Ill-conditioned sets: the refinements take out what the inverse's rounding puts in, to 1e-5."""
    rng = random.Random(460 + seed)
    worse = []
    for condition in (30.0, 100.0, 300.0, 1000.0):
        rows = random_rows(rng, condition, rng.choice([6, 8, 20]), 1e-3)
        result, exact = run(rows), exactly(rows).floats()
        assert not result.rank_deficient
        if result.ill_conditioned:
            continue
        x, _ = explicit(rows)
        mine, theirs = (
            np.abs(found - exact).max() / np.abs(exact).max() for found in (floats(result)[:SIZE], x)
        )
        assert mine <= min(theirs, 1e-5)
        worse.append(theirs > 1e-5)
    assert any(worse)
